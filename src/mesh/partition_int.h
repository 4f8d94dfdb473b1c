// partition_int.h - what the files partition*.c share
// SPDX-License-Identifier: MIT
#ifndef MESH_PARTITION_INT_H
#define MESH_PARTITION_INT_H

#include "mesh/cell_graph.h"

// part[c] of 0 .. n-1 for the cells of g, and their weights (NULL: all 1).
typedef struct {
  const CellGraph *g;
  uint32_t n;
  uint32_t *part;
  const int32_t *weight;
} Parts;

static inline uint64_t parts__weight(const Parts *p, size_t cell)
{
  return p->weight ? (uint64_t)p->weight[cell] : 1;
}
// Weight of each part; the caller frees.
uint64_t *parts__weights(const Parts *p);

// Give each empty part a cell of the heaviest one, which stays connected if it was. There are at least n
// cells.
void parts__fill_empty(Parts *p);
// Let pieces that are apart from the heaviest of their part join the neighbour they share most edges with, if
// that does not become heavier than `limit`, or than the heaviest part is now.
void parts__join_pieces(Parts *p, double limit);

#endif
