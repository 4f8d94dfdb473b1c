// mesh2d_joint.h - faces of one plane meshed as one triangulation, where boundary edges may have to be split
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH2D_JOINT_H
#define MESH_MESH2D_JOINT_H

#include "mesh/mesh2d.h"

// Mesh.MinimumAngle and Mesh.ConformingDelaunay split edges of the boundary, for all faces on a curve alike. So faces of one plane
// that share curves are meshed in one triangulation (face_cluster.h), and where that cannot be (curves shared between planes, faces
// that overlap, a crack with nodes on either side) in rounds, anew whenever another has split a curve, until all agree. The curves'
// meshes and `nodes` are changed to the result. Curves with prescribed nodes (transfinite, periodic and their masters, copied, layers)
// stay whole, and so do those of faces that are not triangulated freely (structured, with boundary layers, not plane), which are meshed
// afterwards as mesh2d_run does. Faces to be recombined stay triangles, with a warning.
// face[] as in mesh2d_run. Returns the number of faces that failed.
size_t mesh2d_joint_run(const Mesh2dInput *in, Mesh1d *curves, EdgeNodes *nodes, FaceMesh *face);

#endif
