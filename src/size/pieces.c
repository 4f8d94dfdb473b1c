// pieces.c - curves of the model cut into pieces for a search of the nearest
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "size/size_int.h"

// Newton's iteration on the squared distance, from the projection on the chord, kept in the piece; both ends are tried too.
static double on_piece(void *ctx, uint32_t k, double u0, double u1, Vec3 p, double *best_u)
{
  const Model *m = ctx;
  const Curve *c = model_curve_at(m, k);
  Vec3 e0 = vec3_sub(curve_point(m, c, u0), p), e1 = vec3_sub(curve_point(m, c, u1), p);
  double d0 = vec3_dot(e0, e0), d1 = vec3_dot(e1, e1), best = d0;
  *best_u = u0;
  if (d1 < best) best = d1, *best_u = u1;
  Vec3 chord = vec3_sub(e1, e0);
  double l2 = vec3_dot(chord, chord), t = l2 > 0 ? -vec3_dot(e0, chord) / l2 : 0.5;
  double lo = u0, hi = u1, u = u0 + fmin(fmax(t, 0.0), 1.0) * (u1 - u0);
  for (int it = 0; it < 40; it++) {
    Vec3 r = vec3_sub(curve_point(m, c, u), p), d = curve_deriv(m, c, u);
    double d2 = vec3_dot(r, r), g = vec3_dot(r, d);
    if (d2 < best) best = d2, *best_u = u;
    if (g > 0) hi = u;
    else lo = u;
    double slope = vec3_dot(d, d) + vec3_dot(r, curve_deriv2(m, c, u)), next = slope > 0 ? u - g / slope : (lo + hi) / 2;
    if (!(next >= lo && next <= hi)) next = (lo + hi) / 2;
    if (fabs(next - u) <= 1e-9 * (u1 - u0)) { // quadratic: the next step is exact to rounding
      r = vec3_sub(curve_point(m, c, next), p);
      d2 = vec3_dot(r, r);
      if (d2 < best) best = d2, *best_u = next;
      break;
    }
    u = next;
  }
  return best;
}

Nearest *size__pieces_new(const Model *m)
{
  return nearest_new(on_piece, (void *)(uintptr_t)m);
}

// How far the curve may leave its chord between u0 and u1: max|x''| du^2 / 8, from x'' at three places.
static double bulge_bound(const Model *m, const Curve *c, double u0, double u1)
{
  double most = 0;
  for (int i = 0; i < 3; i++) most = fmax(most, vec3_length(curve_deriv2(m, c, u0 + (u1 - u0) * i / 2)));
  return 1.25 * most * (u1 - u0) * (u1 - u0) / 8;
}

static void add_bent(Nearest *n, const Model *m, const Curve *c, uint32_t k)
{
  int pieces = c->type == CURVE_CIRCLE ? MAX((int)ceil(curve_angle(m, c) * 8 / M_PI), 2)
             : c->type == CURVE_ELLIPSE ? 16 : 8 * MAX(c->npoint - 1, 1);
  Vec3 a = curve_point(m, c, 0);
  for (int i = 0; i < pieces; i++) {
    double u0 = (double)i / pieces, u1 = (double)(i + 1) / pieces;
    Vec3 b = curve_point(m, c, u1);
    nearest_add(n, a, b, bulge_bound(m, c, u0, u1), k, u0, u1);
    a = b;
  }
}

void size__add_curve(Nearest *n, const Model *m, uint32_t k)
{
  const Curve *c = model_curve_at(m, k);
  if (curve_is_straight(m, c)) {
    nearest_add(n, curve_point(m, c, 0), curve_point(m, c, 1), 0, k, 0, 1);
  } else if (c->type == CURVE_POLYLINE && !c->joined) {
    for (int i = 0; i + 1 < c->npoint; i++) {
      double u0 = (double)i / (c->npoint - 1), u1 = (double)(i + 1) / (c->npoint - 1);
      nearest_add(n, curve_point(m, c, u0), curve_point(m, c, u1), 0, k, u0, u1);
    }
  } else {
    add_bent(n, m, c, k);
  }
}

uint32_t size__curve_index(const Model *m, int tag)
{
  size_t lo = 0, hi = model_curves(m);
  if (tag < 0) tag = -tag;
  while (lo < hi) {
    size_t mid = (lo + hi) / 2;
    if (model_curve_at(m, mid)->tag < tag) lo = mid + 1;
    else hi = mid;
  }
  return lo < model_curves(m) && model_curve_at(m, lo)->tag == tag ? (uint32_t)lo : NONE;
}
