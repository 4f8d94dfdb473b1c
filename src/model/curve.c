// curve.c - curves as maps from [0, 1]: position, derivatives, curvature
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/curve_int.h"

#include "geom/knots.h"

enum { MAX_STACK_DEGREE = 15 };

// de Casteljau; the last two rows give the derivatives.
Vec3 bezier__at(const Vec3 *b, int degree, double s, Vec3 *d1, Vec3 *d2)
{
  Vec3 on_stack[MAX_STACK_DEGREE + 1], *w = degree > MAX_STACK_DEGREE ? mem_alloc((size_t)(degree + 1) * sizeof *w) : on_stack;
  memcpy(w, b, (size_t)(degree + 1) * sizeof *w);
  if (d1) *d1 = (Vec3){0, 0, 0};
  if (d2) *d2 = (Vec3){0, 0, 0};
  for (int r = degree; r >= 1; r--) { // w[0..r] is a Bezier polygon of degree r whose value at s is sought
    if (r == 2 && d2)
      *d2 = vec3_scale(degree * (degree - 1), vec3_add(vec3_sub(w[2], vec3_scale(2, w[1])), w[0]));
    if (r == 1 && d1) *d1 = vec3_scale(degree, vec3_sub(w[1], w[0]));
    for (int i = 0; i < r; i++)
      w[i] = (Vec3){w[i].x + s * (w[i + 1].x - w[i].x), w[i].y + s * (w[i + 1].y - w[i].y), w[i].z + s * (w[i + 1].z - w[i].z)};
  }
  Vec3 p = w[0];
  if (w != on_stack) free(w);
  return p;
}

int shape__piece(const CurveShape *h, double u, double *s, double *width)
{
  int i;
  if (h->uniform) {
    i = (int)(u * h->npiece);
    i = MAX(0, MIN(i, h->npiece - 1));
    *s = u * h->npiece - i;
    *width = 1.0 / h->npiece;
    return i;
  }
  int a = knots_piece(h->knot, h->npiece, u);
  *width = h->knot[a + 1] - h->knot[a];
  *s = (u - h->knot[a]) / *width;
  return a;
}

Vec3 curve_point(const Model *m, const Curve *c, double u)
{
  if (u <= 0) return curve__begin(m, c);
  if (u >= 1) return curve__end(m, c);
  const CurveShape *h = c->shape;
  if (!h) {
    Vec3 p = curve__begin(m, c), q = curve__end(m, c);
    return vec3_add(p, vec3_scale(u, vec3_sub(q, p)));
  }
  if (h->kind == SHAPE_ARC) {
    double t = h->t0 + u * (h->t1 - h->t0);
    return vec3_add(h->centre, vec3_add(vec3_scale(cos(t), h->a), vec3_scale(sin(t), h->b)));
  }
  double s, width;
  int i = shape__piece(h, u, &s, &width);
  Vec3 p = bezier__at(shape__control(h, i), h->degree, s, NULL, NULL);
  return c->sphere ? polar_point(c->sphere, polar_plane(c->sphere, p)) : p;
}

static void derivatives(const Model *m, const Curve *c, double u, Vec3 *d1, Vec3 *d2)
{
  const CurveShape *h = c->shape;
  *d2 = (Vec3){0, 0, 0};
  if (!h) {
    *d1 = vec3_sub(curve__end(m, c), curve__begin(m, c));
    return;
  }
  if (h->kind == SHAPE_ARC) {
    double w = h->t1 - h->t0, t = h->t0 + u * w;
    *d1 = vec3_scale(w, vec3_sub(vec3_scale(cos(t), h->b), vec3_scale(sin(t), h->a)));
    *d2 = vec3_scale(-w * w, vec3_add(vec3_scale(cos(t), h->a), vec3_scale(sin(t), h->b)));
    return;
  }
  double s, width;
  int i = shape__piece(h, u, &s, &width);
  bezier__at(shape__control(h, i), h->degree, s, d1, d2);
  *d1 = vec3_scale(1 / width, *d1);
  *d2 = vec3_scale(1 / (width * width), *d2);
}

Vec3 curve_deriv(const Model *m, const Curve *c, double u)
{
  Vec3 d1, d2;
  derivatives(m, c, u, &d1, &d2);
  return d1;
}

Vec3 curve_deriv2(const Model *m, const Curve *c, double u)
{
  Vec3 d1, d2;
  derivatives(m, c, u, &d1, &d2);
  return d2;
}

double curve_curvature(const Model *m, const Curve *c, double u)
{
  const CurveShape *h = c->shape;
  if (!h || h->straight) return 0;
  if (h->kind == SHAPE_ARC && h->circle) return 1 / vec3_length(h->a);
  Vec3 d1, d2;
  derivatives(m, c, u, &d1, &d2);
  double speed = vec3_length(d1);
  return speed > 0 ? vec3_length(vec3_cross(d1, d2)) / (speed * speed * speed) : 0;
}

bool curve_is_straight(const Model *m, const Curve *c)
{
  (void)m;
  const CurveShape *h = c->shape;
  return h ? h->straight : c->type == CURVE_LINE;
}

double curve_angle(const Model *m, const Curve *c)
{
  (void)m;
  const CurveShape *h = c->shape;
  return h && h->kind == SHAPE_ARC ? fabs(h->t1 - h->t0) : 0;
}
