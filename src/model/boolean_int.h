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

// Part of an outline: an edge of the arrangement or, in a union, several of one line, arc or spline. u0, u1 in the direction of the run.
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

// A face of the result as OpenCASCADE lists it: its wires, the outer one first; `wire` says where each begins among the runs.
typedef struct {
  uint32_t outline; // of its outer boundary
  Vec(Run) run;
  U32Vec wire;
} Listing;

typedef struct {
  Model *m;
  BooleanOp op;
  SrcLoc loc;
  Diag *diag;
  Arena arena;
  Vec(BooleanInput) input;
  Vec(Cutter) cutter;    // curves among the shapes
  IntVec point;          // points among the shapes
  Vec(Vec3) place;       // where these are
  IntVec at_node;        // per node: its point in the end, or 0
  Face frame;            // the plane of all: origin, normal and axes
  Map index;             // curve tag -> rank in source
  IntVec source;         // tags of all curves
  Vec(U32Vec) bounds;    // per source: ranks of the inputs it bounds, once for each time
  ArrCurve *curve;       // per source
  double tol;            // what is closer is one point
  Arc *arc;              // per source, of arcs
  Pieces **spline;       // per source, of splines
  Arrangement a;
  size_t words;
  uint64_t *in;          // per face of the arrangement: set of inputs
  uint32_t *piece;       // per face: its piece of the result, or NONE
  uint32_t *degree;      // per node: ends of boundary edges
  Vec(Outline) outline;  // by piece, the outer one first
  U32Vec *pieces;        // per source: half-edges along it
  bool *merged;          // per node: several points are there
  Vec(Listing) listing;  // the faces of the result in order
} Boolean;

// boolean.c
bool boolean__inside(const Boolean *b, uint32_t face, size_t input);
uint32_t boolean__piece_of(const Boolean *b, uint32_t half); // NONE: not in the result
Run boolean__run_of(const Boolean *b, uint32_t half);
double boolean__run_area(const Boolean *b, uint32_t half);
uint32_t boolean__node_near(const Boolean *b, Vec2 p);

// boolean_order.c
void boolean__list_pieces(Boolean *b);
void boolean__order(Boolean *b); // fills `listing`, and `images` of the inputs
void boolean__list_as_input(Boolean *b, size_t listed, size_t input); // a listed face that is this input: by its own wires

typedef struct {
  Boolean *b;
  int *point;     // per node: tag, or 0
  double *lc;     // per node: size of its point
  bool *fresh;    // per node: several points meet there and one stays as it is: the result has a point of its own
  bool *keep_curve; // per source: keeps its number though its last input goes
  size_t *same;     // per listed face: input that is it, curve for curve; or SIZE_MAX
  bool *kept;       // per listed face: is that input, which stays
  uint32_t *owner;  // per listed face: input whose tag it takes, or NONE
  bool *anew;     // per source: whole, but with a new number
  int *own;       // per source: its tag, if its only piece takes that though it is made anew; or 0
  int most_own;   // the largest of these
  Map made;       // curve, from and to of a run -> signed tag of a curve that runs so
  Map reused;     // tags of source curves that stay
  IntVec idle;    // points whose place another took
} BooleanApply;

// boolean_number.c: what keeps its number. Fills `point`, `fresh`, `lc` there, `idle`, `same`, `kept`, `owner`, `keep_curve`; numbered: a tag was asked for.
void boolean__plan(BooleanApply *a, bool numbered);
bool boolean__reuses(const BooleanApply *a, const Run *r); // may be the source curve itself
uint32_t boolean__piece_at(const Boolean *b, size_t listed);
Run boolean__inner_run(const Boolean *b, uint32_t edge);
bool boolean__is_inner(const Boolean *b, uint32_t edge, uint32_t piece); // one piece on both sides: it lies in its face

// boolean_apply.c
bool boolean__apply(Boolean *b, int tag, ShapeVec *out);

#endif
