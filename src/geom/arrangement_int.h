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
  DoubleVec reach; // per node: what is nearer is this node; more than tol where arcs miss their ends
} ArrBuilder;

// The box of a curve, larger by tol on all sides; of an arc that of its whole ellipse.
ArrBox arr__box(const ArrCurve *c, double tol);

// The node at p: one within reach, or a new one. O(nodes)
uint32_t arr__node(ArrBuilder *b, Vec2 p);

void arr__widen_ends(ArrBuilder *b, size_t i); // the reach of the nodes at the ends of an arc

// Find all intersections: they become nodes, and cuts of their curves. O(n^2)
void arr__intersect(ArrBuilder *b);
void arr__meet(ArrBuilder *b, size_t i, size_t j, Vec2 p); // curves i and j, at p
void arr__slope(const ArrCurve *c, double u, Vec2 *d1);    // derivative by u

// arrangement_spline.c
Vec2 arr__spline_at(const ArrCurve *c, double u, Vec2 *d1, Vec2 *d2);
double arr__spline_nearest(const ArrCurve *c, Vec2 p);
double arr__spline_area(const ArrCurve *c, double u0, double u1); // twice the area to the origin
void arr__spline_meets(ArrBuilder *b, size_t i, size_t j);        // i the spline
bool arr__same_spline(const ArrBuilder *b, const ArrCurve *x, const ArrCurve *y);

// Pieces of curves between their cuts; those that coincide become one edge.
void arr__make_edges(ArrBuilder *b);

#endif
