// boolean_int.h - between the two halves of Boolean operations: what the result is, and how it gets into the model
// SPDX-License-Identifier: MIT
#ifndef MODEL_BOOLEAN_INT_H
#define MODEL_BOOLEAN_INT_H

#include "geom/arrangement.h"
#include "model/curve_int.h"

typedef struct {
  Face *face;
  int tag;
  bool object, tool, drop;
  size_t images; // pieces of the result that lie in it
} BooleanInput;

typedef struct {
  int tag;
  bool drop;
} Cutter;

// Part of an outline: an edge of the arrangement or, in a union, several of one line or arc. u0, u1 in the direction of the run.
typedef struct {
  uint32_t curve, edge, from, to;
  double u0, u1;
  bool back, whole; // against the curve; all of it
} Run;

typedef struct {
  uint32_t piece;
  double area;
  Vec(Run) run;
} Outline;

typedef struct {
  Model *m;
  BooleanOp op;
  SrcLoc loc;
  Diag *diag;
  Arena arena;
  Vec(BooleanInput) input;
  Vec(Cutter) cutter;    // curves among the shapes
  Map index;             // curve tag -> rank in source
  IntVec source;         // tags of all curves
  Vec(U32Vec) bounds;    // per source: ranks of the inputs it bounds, once for each time
  ArrCurve *curve;       // per source
  double tol;            // what is closer is one point
  Arc *arc;              // per source, of arcs
  Arrangement a;
  size_t words;
  uint64_t *in;          // per face of the arrangement: set of inputs
  uint32_t *piece;       // per face: its piece of the result, or NONE
  uint32_t *degree;      // per node: ends of boundary edges
  Vec(Outline) outline;  // by piece, the outer one first
  U32Vec order;          // outer outlines in the order of the new faces
} Boolean;

bool boolean__apply(Boolean *b, int tag, ShapeVec *out);

#endif
