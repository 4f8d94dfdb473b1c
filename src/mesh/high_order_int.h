// high_order_int.h - a curved mesh in the making, and what its steps share
// SPDX-License-Identifier: MIT
#ifndef MESH_HIGH_ORDER_INT_H
#define MESH_HIGH_ORDER_INT_H

#include "mesh/high_order.h"

#include "base/mem.h"
#include "mesh/edge_table.h"
#include "mesh/jacobian.h"

// A curved mesh is its straight one and, for every edge, the displacements of its order-1 nodes from the straight places.
typedef struct {
  const Mesh *m;
  const HighOrder *how;
  EdgeTable table;
  int per_edge;
  Vec3 *shift;       // per_edge per edge, from a to b
  double *u;         // parameters of the same nodes, NAN where not on a curve
  bool *bent;        // per edge: has a displacement
  BezierBasis basis[2]; // of triangles and quadrangles
  Enriched e;
} Elevator;

// A surface element of the straight mesh.
typedef struct {
  const uint32_t *corner;
  uint32_t edge[4];
  int corners;
} Cell;
typedef Vec(Cell) CellVec;

static inline bool high_order__on_curve(const Elevator *v, uint32_t e)
{
  return v->m->entity[v->table.edge[e].entity].dim == 1;
}

// All surface elements, in the order of blocks; the caller frees the vector.
CellVec high_order__cells(const Elevator *v);

// Whether an edge of c has a displacement.
bool high_order__bent(const Elevator *v, const Cell *c);

// All nodes of the complete element on c, in the order of its type, and the normal of its corners. O(p^3) of order p
void high_order__nodes(const Elevator *v, const Cell *c, Vec3 *node, Vec3 *normal);

// Let displacements into the edges around folded elements, and where that does not unfold them draw edges nearer to straight
// (report->folded, straightened). O(n) for a look, and the rings around what is folded.
void high_order__unfold(Elevator *v, const CellVec *cell, HighOrderReport *report);

// A new mesh of m's corners alone, of order 1, without the nodes that only higher order needs. O(n)
Mesh *high_order__corners(const Mesh *m);

#endif
