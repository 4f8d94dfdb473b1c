// mesh_shapes.h - the shape measures of [book §4.1] over the triangles of a mesh
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH_SHAPES_H
#define MESH_MESH_SHAPES_H

#include "mesh/mesh.h"

enum { SHAPES = 5 }; // kappa_1 to kappa_5, in this order

typedef struct {
  size_t triangles;
  double min[SHAPES], mean[SHAPES];
  size_t inner_edges; // edges between two triangles of a face
  size_t obtuse;      // those of them with opposite angles of more than pi together: linear finite elements for the Laplacian have a
                      // positive entry off the diagonal there and may break the discrete maximum principle [book §4.1]
} MeshShapes;

// Straight-sided triangles of the corners. O(n); pairs the edges of the mesh (mesh_edges.h) for that alone.
void mesh_shapes_make(MeshShapes *s, const Mesh *m);

#endif
