// arrangement.h - the faces into which curves divide the plane: straight segments, arcs of ellipses, and chains that nothing may cut
// SPDX-License-Identifier: MIT
#ifndef GEOM_ARRANGEMENT_H
#define GEOM_ARRANGEMENT_H

#include "base/base.h"
#include "base/mem.h"
#include "geom/vec.h"

typedef enum { ARR_LINE, ARR_ARC, ARR_CHAIN } ArrKind;

typedef struct {
  ArrKind kind;
  Vec2 p, q;           // ends, at u = 0 and 1
  Vec2 c, a, b;        // ARR_ARC: c + cos t a + sin t b,  t from t0 to t1, up to a full turn
  double t0, t1;
  const Vec2 *point;   // ARR_CHAIN: samples from p to q, both included; the caller's
  size_t npoint;
} ArrCurve;

// A piece of a curve between neighbouring nodes. Pieces that coincide are one edge: further curves are in `also`.
typedef struct {
  uint32_t from, to;   // nodes
  uint32_t curve;
  double u0, u1;
  U32Vec also;
} ArrEdge;

typedef enum { ARR_GOOD, ARR_CUTS_CHAIN, ARR_INCONSISTENT } ArrOutcome;

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
  uint32_t culprit[2]; // ARR_CUTS_CHAIN: the chain, and what meets it
} Arrangement;

// Points closer than tol are one; curves that pass a node within tol pass through it. Curves may overlap, coincide and touch.
// Intersections are exact up to rounding for lines, and found by bisection between samples for arcs with arcs.
// O(n^2) boxes of n curves, O(k log k) for k edges. Zero-initialize; release with arrangement_free.
ArrOutcome arrangement_build(Arrangement *a, const ArrCurve *curve, size_t n, double tol);
void arrangement_free(Arrangement *a);

Vec2 arr_curve_at(const ArrCurve *c, double u); // chains: by rank of sample

#endif
