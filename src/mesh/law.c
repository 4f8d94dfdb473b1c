// law.c - transfinite laws: where nodes stand on a curve as fractions of its length
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "geom/quadrature.h"
#include "mesh/mesh1d.h"

static void uniform(uint32_t n, double *s)
{
  for (uint32_t k = 0; k < n; k++) s[k] = (double)k / (n - 1);
}

// Successive segments in the ratio r: s_k = (r^k - 1) / (r^(n-1) - 1). Written with expm1 for r near 1 and through 1/r where
// r^(n-1) would overflow.
static void progression(double r, uint32_t n, double *s)
{
  double l = log(r);
  if (l > 0) {
    for (uint32_t k = 0; k < n; k++) s[k] = exp(l * ((double)k - (n - 1))) * expm1(-l * k) / expm1(-l * (n - 1));
  } else {
    for (uint32_t k = 0; k < n; k++) s[k] = expm1(l * k) / expm1(l * (n - 1));
  }
}

// Size along the curve proportional to 1 + (b-1) (1-2s)^2.
static void bump(double b, uint32_t n, double *s)
{
  double a = sqrt(fabs(b - 1)), reach = b < 1 ? atanh(a) : atan(a);
  for (uint32_t k = 0; k < n; k++) {
    double q = -1 + 2.0 * k / (n - 1);
    s[k] = 0.5 * (1 + (b < 1 ? tanh(q * reach) : tan(q * reach)) / a);
  }
}

// Clustering at the begin, stronger the nearer b > 1 is to 1: the one-sided stretching of [Roberts71]. b < 1 mirrors 1/b.
static void beta(double b, uint32_t n, double *s)
{
  bool mirror = b < 1;
  if (mirror) b = 1 / b;
  double ratio = (b + 1) / (b - 1);
  for (uint32_t k = 0; k < n; k++) {
    double e = mirror ? (double)k / (n - 1) : 1 - (double)k / (n - 1), g = pow(ratio, e);
    double v = ((b + 1) - (b - 1) * g) / (g + 1); // 0 at e = 1, 1 at e = 0
    s[k] = mirror ? 1 - v : v;
  }
}

void law_fractions(TransfiniteLaw law, double coef, uint32_t n, double *s)
{
  CHECK(n >= 2);
  bool plain = !(coef > 0) || coef == 1 || !isfinite(coef);
  switch (plain ? LAW_UNIFORM : law) {
  case LAW_UNIFORM: uniform(n, s); break;
  case LAW_PROGRESSION: progression(coef, n, s); break;
  case LAW_BUMP: bump(coef, n, s); break;
  case LAW_BETA: beta(coef, n, s); break;
  }
  s[0] = 0;
  s[n - 1] = 1;
}

// ---- fractions of the length to parameters ---------------------------------------------------------------------------------

typedef struct {
  const Model *m;
  const Curve *c;
} Speed;

static void speed_at(void *ctx, const double *t, size_t n, double *f)
{
  const Speed *s = ctx;
  for (size_t i = 0; i < n; i++) f[i] = vec3_length(curve_deriv(s->m, s->c, t[i]));
}

void curve_at_fractions(const Model *m, const Curve *c, const double *s, uint32_t n, double *u)
{
  bool linear = c->type == CURVE_LINE || c->type == CURVE_CIRCLE;
  if (linear) {
    memcpy(u, s, n * sizeof *u);
    return;
  }
  Integral q;
  Speed ctx = {m, c};
  size_t cells = (size_t)MAX(c->npoint - 1, 1);
  integral_make(&q, speed_at, &ctx, cells, 1e-13 * curve_length(m, c), 1 << 16);
  double *target = mem_alloc(n * sizeof *target);
  for (uint32_t k = 0; k < n; k++) target[k] = s[k] * integral_total(&q);
  integral_inverse(&q, target, n, u);
  for (uint32_t k = 0; k < n; k++) {
    if (s[k] <= 0) u[k] = 0;
    if (s[k] >= 1) u[k] = 1;
  }
  free(target);
  integral_free(&q);
}
