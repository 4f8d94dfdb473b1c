// arrangement_spline.c - splines in arrangements: places on them, and where they meet other curves
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/arrangement_int.h"

#include "geom/knots.h"

Vec2 arr__spline_at(const ArrCurve *c, double u, Vec2 *d1, Vec2 *d2)
{
  int k = knots_piece(c->knot, c->npiece, u), n = c->degree;
  double wide = c->knot[k + 1] - c->knot[k], s = (u - c->knot[k]) / wide;
  Vec2 d[ARR_MOST_DEGREE + 1];
  memcpy(d, c->control + (size_t)k * (size_t)(n + 1), (size_t)(n + 1) * sizeof *d);
  *d1 = *d2 = (Vec2){0, 0};
  for (int r = n; r > 0; r--) {
    if (r == 2) *d2 = vec2_scale(n * (n - 1) / (wide * wide), vec2_add(vec2_sub(d[2], d[1]), vec2_sub(d[0], d[1])));
    if (r == 1) *d1 = vec2_scale(n / wide, vec2_sub(d[1], d[0]));
    for (int i = 0; i < r; i++) d[i] = vec2_add(vec2_scale(1 - s, d[i]), vec2_scale(s, d[i + 1]));
  }
  return d[0];
}

double arr__spline_nearest(const ArrCurve *c, Vec2 p)
{
  double best = INFINITY, u = 0, step = 1.0 / (double)(c->npoint - 1);
  for (size_t i = 0; i + 1 < c->npoint; i++) {
    Vec2 d = vec2_sub(c->point[i + 1], c->point[i]);
    double dd = vec2_dot(d, d), s = dd > 0 ? fmax(0, fmin(1, vec2_dot(vec2_sub(p, c->point[i]), d) / dd)) : 0;
    double dist = vec2_length(vec2_sub(vec2_add(c->point[i], vec2_scale(s, d)), p));
    if (dist >= best) continue;
    best = dist;
    u = ((double)i + s) * step;
  }
  double lo = fmax(0, u - step), hi = fmin(1, u + step);
  for (int k = 0; k < 30; k++) { // (c(u) - p) c'(u) = 0
    Vec2 d1, d2, r = vec2_sub(arr__spline_at(c, u, &d1, &d2), p);
    double slope = vec2_dot(d1, d1) + vec2_dot(r, d2);
    if (!(slope > 0)) slope = vec2_dot(d1, d1);
    if (!(slope > 0)) break;
    double to = fmax(lo, fmin(hi, u - vec2_dot(r, d1) / slope));
    if (to == u) break;
    u = to;
  }
  return u;
}

// Twice the area between the origin and the part [u0, u1]: Gauss's rule of five places on each piece, exact up to degree 5.
double arr__spline_area(const ArrCurve *c, double u0, double u1)
{
  static const double at[5] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
  static const double weight[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  double sum = 0;
  for (int k = 0; k < c->npiece; k++) {
    double a = fmax(u0, c->knot[k]), b = fmin(u1, c->knot[k + 1]);
    for (int i = 0; i < 5 && a < b; i++) {
      Vec2 d1, d2, p = arr__spline_at(c, (a + b) / 2 + at[i] * (b - a) / 2, &d1, &d2);
      sum += weight[i] * (b - a) / 2 * vec2_cross(p, d1);
    }
  }
  return sum;
}

// From a crossing of chords to that of the curves: Newton's method in both parameters. False if it leads nowhere near.
static bool settle(const ArrCurve *x, const ArrCurve *y, double *u, double *v, double reach_u, double reach_v, double tol)
{
  double u0 = *u, v0 = *v;
  for (int k = 0; k < 40; k++) {
    Vec2 dx, dy, ignored, r = vec2_sub(arr__spline_at(x, *u, &dx, &ignored), arr_curve_at(y, *v));
    arr__slope(y, *v, &dy);
    double det = vec2_cross(dx, dy);
    if (det == 0) break;
    double to_u = fmax(0, fmin(1, *u - vec2_cross(r, dy) / det)), to_v = fmax(0, fmin(1, *v - vec2_cross(r, dx) / det));
    if (to_u == *u && to_v == *v) break;
    *u = to_u;
    *v = to_v;
  }
  Vec2 r = vec2_sub(arr_curve_at(x, *u), arr_curve_at(y, *v));
  return vec2_length(r) <= tol && fabs(*u - u0) <= reach_u && fabs(*v - v0) <= reach_v;
}

void arr__spline_meets(ArrBuilder *b, size_t i, size_t j)
{
  const ArrCurve *x = &b->curve[i], *y = &b->curve[j];
  size_t n = y->kind == ARR_LINE ? 1 : y->kind == ARR_ARC ? 256 : y->npoint - 1, m = x->npoint - 1;
  ArrBox box = arr__box(x, b->tol);
  for (size_t k = 0; k < n; k++) {
    Vec2 p = arr_curve_at(y, (double)k / (double)n), q = arr_curve_at(y, (double)(k + 1) / (double)n), e = vec2_sub(q, p);
    double bulge = y->kind == ARR_LINE ? 0 : vec2_length(e) / 2;
    if (fmax(p.x, q.x) + bulge < box.lo[0] || fmin(p.x, q.x) - bulge > box.hi[0] || fmax(p.y, q.y) + bulge < box.lo[1] ||
        fmin(p.y, q.y) - bulge > box.hi[1])
      continue;
    for (size_t l = 0; l < m; l++) {
      Vec2 d = vec2_sub(x->point[l + 1], x->point[l]), r = vec2_sub(p, x->point[l]);
      double det = vec2_cross(d, e);
      if (det == 0) continue;
      double u = vec2_cross(r, e) / det, v = vec2_cross(r, d) / det, slack = 0.1; // the curves bulge from their chords
      if (!(u >= -slack && u <= 1 + slack && v >= -slack && v <= 1 + slack)) continue;
      u = fmax(0, fmin(1, ((double)l + u) / (double)m));
      v = fmax(0, fmin(1, ((double)k + v) / (double)n));
      if (settle(x, y, &u, &v, 4.0 / (double)m, y->kind == ARR_LINE ? 1 : 4.0 / (double)n, b->tol)) arr__meet(b, i, j, arr_curve_at(x, u));
    }
  }
}

bool arr__same_spline(const ArrBuilder *b, const ArrCurve *x, const ArrCurve *y)
{
  if (x->kind != ARR_SPLINE || y->kind != ARR_SPLINE || x->npoint != y->npoint) return false;
  bool forward = vec2_length(vec2_sub(x->point[1], y->point[1])) <= b->tol;
  for (size_t i = 0; i < x->npoint; i++)
    if (vec2_length(vec2_sub(x->point[i], y->point[forward ? i : y->npoint - 1 - i])) > b->tol) return false;
  return true;
}
