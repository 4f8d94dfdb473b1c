// mesh_edges.h - which surface elements share which edges, face by face
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH_EDGES_H
#define MESH_MESH_EDGES_H

#include "mesh/mesh.h"

// Half-edge h of a block: its corner i of element k is base[block] + k * corners + i, and runs from that corner to the next
// one. Blocks that are not of dimension 2 have no half-edges. Free with mesh_edges_free.
typedef struct {
  size_t n;         // half-edges in all
  size_t *base;     // nblock + 1 entries
  uint32_t *twin;   // per half-edge: the one run the other way in the same face; NONE on the face's boundary; EDGE_BAD
                    // where two elements run it the same way or more than two have it
} MeshEdges;

#define EDGE_BAD (NONE - 1)

typedef struct {
  uint32_t block, corner;
  size_t element;
  uint32_t a, b;    // nodes at its beginning and its end
} HalfEdge;

// O(n) for nodes of bounded degree; 8 bytes of scratch per half-edge of the largest face.
void mesh_edges_make(MeshEdges *e, const Mesh *m);
void mesh_edges_free(MeshEdges *e);
// The half-edge of an index: O(log of the number of blocks).
HalfEdge mesh_edges_at(const MeshEdges *e, const Mesh *m, size_t h);

#endif
