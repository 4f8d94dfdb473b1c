// filling_mesh.h - meshing a surface that is not plane in a plane that stands for its parameters
// SPDX-License-Identifier: MIT
#ifndef MESH_FILLING_MESH_H
#define MESH_FILLING_MESH_H

#include "base/base.h"
#include "mesh/face_graph.h"
#include "mesh/filling.h"
#include "mesh/mesh2d.h"

// From the plane in which a face is meshed to space: the face's own plane, or (filling not NULL) that of filling_to_plane.
typedef struct {
  const Face *face;
  const Filling *filling;
  SizeEval *eval;
  const Mesh1d *curves; // for the lengths of edges on the boundary; NULL if they do not say how long those inside are to be
} FaceMap;
Vec3 face_map_point(const FaceMap *map, Vec2 q);

// Is f a filling that is not plane, and has it nothing embedded? Then *s describes it.
bool filling_wanted(Filling *s, const Model *m, const Face *f);
// Move the vertices of the graph of the face to the plane of the filling.
void filling_place(const Filling *s, const Mesh2dInput *in, const Face *f, const EdgeNodes *en, FaceGraph *g);
// Wanted edge length at a place of that plane, so that edges come out as long as asked for on the surface, or as those on the boundary
// are if these are shorter (each side counts the more, the nearer it is); ctx: a FaceMap. O(log n).
double filling_size(void *ctx, Vec2 q);

#endif
