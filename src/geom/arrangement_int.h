// arrangement_int.h - what the steps of building an arrangement share
// SPDX-License-Identifier: MIT
#ifndef GEOM_ARRANGEMENT_INT_H
#define GEOM_ARRANGEMENT_INT_H

#include "geom/arrangement.h"

#define PI 3.14159265358979323846

typedef struct {
  double lo[2], hi[2];
} ArrBox;

typedef struct {
  double u;
  uint32_t node;
} ArrCut;
typedef Vec(ArrCut) ArrCuts;

typedef struct {
  Arrangement *a;
  const ArrCurve *curve;
  size_t n;
  double tol;
  ArrCuts *cut; // per curve
} ArrBuilder;

// The box of a curve, larger by tol on all sides; of an arc that of its whole ellipse.
ArrBox arr__box(const ArrCurve *c, double tol);

// The node at p: one within the tolerance, or a new one. O(nodes)
uint32_t arr__node(ArrBuilder *b, Vec2 p);

// Find all intersections: they become nodes, and cuts of their curves. False if a chain is cut (a->culprit). O(n^2)
bool arr__intersect(ArrBuilder *b);

// Pieces of curves between their cuts; those that coincide become one edge.
void arr__make_edges(ArrBuilder *b);

#endif
