// mesh_index.h - irregular vertices of the faces of quadrangles, by their index
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH_INDEX_H
#define MESH_MESH_INDEX_H

#include "mesh/mesh.h"

// The index of a vertex inside a face is 1/4 for each quadrangle less than four around it; on the boundary, for each one less than two
// (two more for every further time the boundary passes through it) [book §5.1.4].
enum { INDEX_LEAST = -4, INDEX_MOST = 2, INDICES = INDEX_MOST - INDEX_LEAST + 1 };

typedef struct {
  size_t faces;             // those of quadrangles alone; the others are left out
  size_t inside[INDICES];   // vertices by four times their index, from INDEX_LEAST (and less) to INDEX_MOST
  size_t boundary[INDICES];
  long sum4;                // four times the sum of all indices
  long euler;               // V - E + F of these faces; four times it is equal to sum4 [book eq. 1.9]
} MeshIndices;

// O(n). Corners of elements of higher order count, not the nodes between.
void mesh_indices_make(MeshIndices *s, const Mesh *m);

#endif
