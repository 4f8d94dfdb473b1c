// subdivide.h - meshes made finer, or all quadrangles, by splitting every element
// SPDX-License-Identifier: MIT
#ifndef MESH_SUBDIVIDE_H
#define MESH_SUBDIVIDE_H

#include "base/base.h"
#include "base/diag.h"
#include "mesh/mesh.h"
#include "model/model.h"

typedef enum {
  SUBDIVIDE_HALVE,       // every edge halved: line to 2, triangle to 4 triangles, quadrangle to 4 (RefineMesh)
  SUBDIVIDE_QUADS,       // triangle to 3 quadrangles about its centre, quadrangle to 4 (Mesh.SubdivisionAlgorithm = 1)
  SUBDIVIDE_BARYCENTRIC, // triangle to 3 triangles about its centre, quadrangle to 4; edges stay (= 3)
} Subdivision;

// A new mesh; m (of first order) is left as it is. New nodes on curves lie on the curve at the middle parameter, if `model`
// is not NULL; all others in the middle of edges and centres of corners. Where parts of elements would turn over, as thin ones at
// curves do, nodes stay nearer to the chords, with a warning. Orientation, groups and periodic pairs are carried over. O(n) expected.
Mesh *mesh_subdivide(const Mesh *m, Subdivision how, const Model *model, Diag *diag);

#endif
