// arrangement.h - the faces into which curves divide the plane: straight segments, arcs of ellipses, and splines
// SPDX-License-Identifier: MIT
#ifndef GEOM_ARRANGEMENT_H
#define GEOM_ARRANGEMENT_H

#include "base/base.h"
#include "base/mem.h"
#include "geom/vec.h"

typedef enum { ARR_LINE, ARR_ARC, ARR_SPLINE } ArrKind;
enum { ARR_MOST_DEGREE = 40 };

typedef struct {
  ArrKind kind;
  Vec2 p, q;           // ends, at u = 0 and 1
  Vec2 c, a, b;        // ARR_ARC: c + cos t a + sin t b,  t from t0 to t1, up to a full turn
  double t0, t1;
  // ARR_SPLINE, all the caller's: Bezier pieces of one degree, up to ARR_MOST_DEGREE, between npiece + 1 knots from 0 to 1; and samples
  // from p to q, both included, even in u, whose chords tell where to look for what meets it
  const Vec2 *control, *point;
  const double *knot;
  int degree, npiece;
  size_t npoint;
} ArrCurve;

// A piece of a curve between neighbouring nodes. Pieces that coincide are one edge: further curves are in `also`.
typedef struct {
  uint32_t from, to;   // nodes
  uint32_t curve;
  double u0, u1;
  U32Vec also;
} ArrEdge;

// Half-edge 2e runs along edge e, 2e + 1 against it. Each belongs to one cycle, with its face on the left.
typedef struct {
  Vec(Vec2) node;
  Vec(ArrEdge) edge;
  U32Vec next;         // by half-edge: the following one of its cycle
  U32Vec cycle;        // by half-edge
  U32Vec first;        // by cycle: a half-edge
  DoubleVec area;      // by cycle, signed: > 0 round a face, else round a hole of one (or along dangling edges)
  U32Vec face;         // by cycle: 0 the unbounded face, else 1 + the rank of its positive cycle
  uint32_t nface;      // with the unbounded one
} Arrangement;

// Points closer than tol are one; curves that pass a node within tol pass through it. Curves may overlap, coincide and touch.
// Intersections are exact up to rounding for lines, found by bisection between samples for arcs with arcs, and by Newton's method from
// crossing chords for splines, which may touch others unnoticed.
// O(n^2) boxes of n curves, O(k log k) for k edges. Zero-initialize; release with arrangement_free.
void arrangement_build(Arrangement *a, const ArrCurve *curve, size_t n, double tol);
void arrangement_free(Arrangement *a);

// The point at parameter u.
Vec2 arr_curve_at(const ArrCurve *c, double u);

#endif
