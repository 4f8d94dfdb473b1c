// edge_uses.h - which elements of a mesh, lines and surface elements of all entities alike, have which edges
// SPDX-License-Identifier: MIT
#ifndef MESH_EDGE_USES_H
#define MESH_EDGE_USES_H

#include "mesh/mesh.h"

// Elements are numbered through all blocks from 0: those of block b from base[b] on. As blocks go by
// dimension, lines are line0 .. surface0-1 and surface elements surface0 .. nelem-1.
typedef struct {
  size_t nelem, line0, surface0;
  size_t *base; // nblock + 1 entries
} ElemIds;

// O(nblock); release with elem_ids_free.
void elem_ids_make(ElemIds *ids, const Mesh *m);
void elem_ids_free(ElemIds *ids);
// The block of an element; O(log nblock).
uint32_t elem_ids_block(const ElemIds *ids, const Mesh *m, size_t elem);
// Its nodes, and its type.
const uint32_t *elem_ids_nodes(const ElemIds *ids, const Mesh *m, size_t elem, ElemType *type);

typedef struct {
  uint32_t lower, upper; // nodes at its ends
  uint32_t elem;
} EdgeUse;

// Every edge, corner to corner, of every element: by lower node, upper node, element. Uses of one edge so
// stand side by side.
typedef struct {
  size_t n;
  EdgeUse *use;
} EdgeUses;

// O(n) for nodes of bounded degree.
void edge_uses_make(EdgeUses *u, const Mesh *m, const ElemIds *ids);
void edge_uses_free(EdgeUses *u);
// One after the last use of the edge that use[i] is of.
static inline size_t edge_uses_end(const EdgeUses *u, size_t i)
{
  size_t j = i + 1;
  while (j < u->n && u->use[j].lower == u->use[i].lower && u->use[j].upper == u->use[i].upper) j++;
  return j;
}

#endif
