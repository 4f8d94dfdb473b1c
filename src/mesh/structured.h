// structured.h - faces meshed as grids: transfinite ones and swept ones
// SPDX-License-Identifier: MIT
#ifndef MESH_STRUCTURED_H
#define MESH_STRUCTURED_H

#include "base/base.h"
#include "mesh/edge_nodes.h"
#include "mesh/grid.h"
#include "mesh/mesh2d.h"

// A face marked transfinite, from the nodes on its boundary: a grid between 3 or 4 corners. Places as Gmsh 4.8 has them: Coons
// interpolation by the accumulated lengths of the sides s1-s2 and s2-s3 (with three corners of the means of s1-s2 and s1-s3),
// in space, and in the parameters of a filling of four curves. False if the face is not marked, or cannot be such a grid
// (counts of opposite sides differ, holes, corners not on the boundary, embedded entities, cells that stay folded even
// after smoothing): the last ones with a warning, and `out` is untouched. O(nodes).
bool structured_face(const Mesh2dInput *in, const Face *f, const EdgeNodes *en, FaceMesh *out, Diag *diag);

// A face made by Extrude with Layers: the nodes of the swept curve carried along. False (with a warning unless it is no such face) if the
// curves around it do not have the nodes the layers ask for.
bool extruded_face(const Mesh2dInput *in, const Face *f, const EdgeNodes *en, FaceMesh *out, Diag *diag);

// Turn a grid into the mesh of a face; its own nodes are numbered already. Allocates the elements.
void face_mesh_from_grid(FaceMesh *out, const GridCells *g, bool quads);
// Does every element of a plane face have a positive orientation (quadrangles at every corner)? Exact.
bool face_mesh_valid(const FaceMesh *fm, const Face *f, const EdgeNodes *en);

#endif
