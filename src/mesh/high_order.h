// high_order.h - elements of order 2 to 4 with nodes on the curves, none of them folded
// SPDX-License-Identifier: MIT
#ifndef MESH_HIGH_ORDER_H
#define MESH_HIGH_ORDER_H

#include "base/base.h"
#include "base/diag.h"
#include "mesh/mesh.h"
#include "model/model.h"

enum { HIGH_ORDER_MAX = 4 };

typedef struct {
  int order;       // 1 to HIGH_ORDER_MAX
  bool incomplete; // no nodes inside elements (Mesh.SecondOrderIncomplete): 8-node quadrangles, 9-node triangles, ...
  bool linear;     // nodes on straight edges (Mesh.SecondOrderLinear)
} HighOrder;

typedef struct {
  size_t curved;       // edges of curves that are not straight
  size_t folded;       // elements that the curved edges folded at first
  size_t straightened; // edges of curves that had to be drawn nearer to their straight line to unfold the last of them
  double min_jacobian; // certified lower bound over all elements, relative to the straight element; INFINITY without elements
} HighOrderReport;

// A new mesh of the wanted order; m is left as it is. Edge nodes lie on the curves at equal parameter steps, others on straight
// edges, interior ones blended between them. Where that folds elements (Bezier bound of the Jacobian not positive), the
// curvature is let into the neighbouring edges; where even that does not unfold, edges are straightened step by step, with
// a warning. So every Jacobian of the result is positive if m's straight elements are valid. A mesh of higher order is brought
// back to its corners first. model may be NULL: then all edges are straight. O(n) plus the repair.
Mesh *mesh_set_order(const Mesh *m, const HighOrder *how, const Model *model, HighOrderReport *report, Diag *diag);

#endif
