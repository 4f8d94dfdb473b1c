// mesh1d_int.h - what the parts of 1D meshing share
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH1D_INT_H
#define MESH_MESH1D_INT_H

#include "geom/quadrature.h"
#include "mesh/mesh1d.h"

// One curve while its count is being settled.
typedef enum {
  RULE_NONE,       // no mesh
  RULE_SIZE,       // by the size integral
  RULE_GRADED,     // the same, with the growth of the size limited
  RULE_LAW,        // transfinite
  RULE_LAYERS,     // extruded point
  RULE_COPY,       // of another curve
} CurveRule;

// Samples of a curve whose size is limited in growth: parameter, speed |x'|, size, and the running integral of speed/size.
typedef struct {
  size_t n;
  double *t, *speed, *h, *sum, *s; // s: arc length from the begin
} Samples;

typedef struct {
  const Curve *c;
  CurveRule rule;
  double a;          // adimensional length
  uint32_t segments; // so many are wanted
  uint32_t least;    // at least so many
  bool fixed;        // parity must not change it
  bool parity;       // the number of segments has to stay even (or odd)
  Integral q;        // RULE_SIZE
  Samples g;         // RULE_GRADED
} CurveWork;

typedef struct {
  const Model *m;
  const Options *opt;
  const SizeField *size;
  Diag *diag;
  CurveMeetings *meet; // where curves may be split; NULL: that is an error
  Mesh1d *g;
  CurveWork *work;   // per curve
  SizeEval **eval;   // per worker
  Diag **sink;       // per curve, made by its worker where there is something to say
  int workers;
} Mesher1d;

// Count of segments that the size asks for on curve k: fills the work's q or g, a and segments. mesh1d_size.c
void mesh1d__measure(Mesher1d *d, size_t k, SizeEval *eval);
// Segments that a curve of its kind gets at least, by Mesh.MinimumCurveNodes and the like. mesh1d_size.c
uint32_t mesh1d__least_segments(const Model *m, const Options *opt, const Curve *c);
// Make all sizes of graded curves agree at shared points, growing by at most `slope` (Mesh.SizeGradation). mesh1d_size.c
void mesh1d__grade_all(Mesher1d *d, double slope);
// Nodes of a curve measured: fills g->curve[k], releases q and g.
void mesh1d__place(Mesher1d *d, size_t k, SizeEval *eval);
void mesh1d__release(CurveWork *w);

// Even numbers of segments around every recombined face. mesh1d_parity.c
void mesh1d__settle_parity(Mesher1d *d);

// The last step: find and remove crossings of edges. Places where curves may be split are gathered, unless `meet` is NULL. False when
// there are any, and after errors. mesh1d_untangle.c
bool mesh1d__untangle(Mesh1d *g, const Options *opt, CurveMeetings *meet, Diag *diag);

// Give g->curve[k] room for n nodes.
void mesh1d__resize(CurveMesh *cm, uint32_t n);
// Positions from parameters, with the end points' own coordinates.
void mesh1d__positions(const Model *m, const Curve *c, CurveMesh *cm);

#endif
