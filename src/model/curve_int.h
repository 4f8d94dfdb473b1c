// curve_int.h - evaluation data of a curve, shared by the curve files
// SPDX-License-Identifier: MIT
#ifndef MODEL_CURVE_INT_H
#define MODEL_CURVE_INT_H

#include "model/model_int.h"

typedef enum { SHAPE_ARC, SHAPE_PIECES } ShapeKind;

// An arc  centre + cos t a + sin t b,  t from t0 to t1;  or Bezier pieces of one degree. Lines have none.
typedef struct {
  ShapeKind kind;
  Vec3 begin, end; // of the end points: the position at u = 0 and 1
  bool straight;
  // SHAPE_ARC
  Vec3 centre, a, b;
  double t0, t1;
  bool circle;
  // SHAPE_PIECES
  int degree, npiece;
  bool uniform;
  double *knot;   // u of the joints, npiece + 1
  Vec3 *control;  // npiece * (degree + 1)
} CurveShape;

// The piece that holds u, the local parameter in *s and du/ds in *width.
int shape__piece(const CurveShape *h, double u, double *s, double *width);
static inline const Vec3 *shape__control(const CurveShape *h, int piece)
{
  return h->control + (size_t)piece * (size_t)(h->degree + 1);
}
// Position and first two derivatives of a Bezier piece at s; d1, d2 may be NULL.
Vec3 bezier__at(const Vec3 *b, int degree, double s, Vec3 *d1, Vec3 *d2);

// Pieces of a shape of pieces between the parameters a and b (split.c).
Pieces *pieces__between(Model *m, const CurveShape *h, double a, double b);

// The image of a curve that is built, in the model's arena: an arc or pieces. False for a line, which its ends say all about.
bool curve__image(Model *m, const Curve *c, const Affine *a, Arc **arc, Pieces **pieces);

// Pieces in the plane of the sphere to cubic pieces in space.
void sphere__lift(const PolarSphere *sphere, CurveShape *h);

// The end points' positions.
static inline Vec3 curve__begin(const Model *m, const Curve *c)
{
  return c->shape ? ((const CurveShape *)c->shape)->begin : point__get(m, c->begin)->xyz;
}
static inline Vec3 curve__end(const Model *m, const Curve *c)
{
  return c->shape ? ((const CurveShape *)c->shape)->end : point__get(m, c->end)->xyz;
}

#endif
