// part_nodes.h - what parts of a mesh share: nodes of several parts, and elements beside others (ghosts)
// SPDX-License-Identifier: MIT
#ifndef MESH_PART_NODES_H
#define MESH_PART_NODES_H

#include "mesh/mesh.h"

// The parts of the elements of the mesh's largest dimension around each corner node.
typedef struct {
  int dim;      // of these elements
  uint32_t *of; // per node: 0 none, its only part, or PART_NODES_SEVERAL and where they begin in `list`
  U32Vec list;  // of each node of several: how many, then the parts, ascending
} PartNodes;

#define PART_NODES_SEVERAL 0x80000000u

// O(n).
void part_nodes_make(PartNodes *p, const Mesh *m);
void part_nodes_free(PartNodes *p);
// The n parts at a node, valid as long as p is.
static inline const uint32_t *part_nodes_at(const PartNodes *p, uint32_t node, uint32_t *n)
{
  uint32_t v = p->of[node];
  if (!(v & PART_NODES_SEVERAL)) {
    *n = v != 0;
    return &p->of[node];
  }
  const uint32_t *at = p->list.data + (v & ~PART_NODES_SEVERAL);
  *n = at[0];
  return at + 1;
}

// An element of one part that has a node in common with elements of others: those see it as a ghost cell.
typedef struct {
  uint32_t block, index;
  uint32_t first, n; // the other parts, ascending, in `part` below
} GhostCell;

typedef struct {
  Vec(GhostCell) cell; // by block and index
  U32Vec part;
} Ghosts;

// Elements of the largest dimension. O(n).
void ghosts_make(Ghosts *g, const Mesh *m);
void ghosts_free(Ghosts *g);

#endif
