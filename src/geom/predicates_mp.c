// predicates_mp.c - the predicates by MPFR, at a precision computed from the exponents
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/predicates_int.h"

#include <mpfr.h>

#include "geom/predicates.h"

// A difference of two doubles is a multiple of 2^low and below 2^high in magnitude, where 2^low is the lowest bit of
// any coordinate and 2^(high-1) bounds the coordinates; so it needs high - low bits, a product of `degree` of them degree
// times that, and a sum of up to 12 such products four more. At that precision MPFR rounds nothing.
static mpfr_prec_t precision_for(const double *q, int n, int degree)
{
  int low = 2000, high = -2000;
  for (int i = 0; i < n; i++) {
    if (q[i] == 0) continue;
    int e;
    frexp(q[i], &e); // |q| in [2^(e-1), 2^e), a multiple of 2^(e-53)
    low = MIN(low, MAX(e - 53, -1074));
    high = MAX(high, e + 1);
  }
  return high < low ? MPFR_PREC_MIN + 53 : degree * (high - low) + 4;
}

// r = a - b
static void difference(mpfr_t r, double a, double b)
{
  mpfr_set_d(r, a, MPFR_RNDN);
  mpfr_sub_d(r, r, b, MPFR_RNDN);
}

int predicates__products_mp(const double *q)
{
  mpfr_prec_t bits = precision_for(q, 8, 2);
  bits = MAX(bits, (mpfr_prec_t)64);
  mpfr_t x[4];
  for (int i = 0; i < 4; i++) {
    mpfr_init2(x[i], bits);
    difference(x[i], q[2 * i], q[2 * i + 1]);
  }
  mpfr_mul(x[0], x[0], x[1], MPFR_RNDN);
  mpfr_mul(x[2], x[2], x[3], MPFR_RNDN);
  int s = mpfr_cmp(x[0], x[2]);
  for (int i = 0; i < 4; i++) mpfr_clear(x[i]);
  return (s > 0) - (s < 0);
}

int orient2d_mp(const double *a, const double *b, const double *c)
{
  double q[8] = {a[0], c[0], b[1], c[1], a[1], c[1], b[0], c[0]};
  return predicates__products_mp(q);
}

int cross_mp(const double *a, const double *b, const double *c, const double *d)
{
  double q[8] = {b[0], a[0], d[1], c[1], b[1], a[1], d[0], c[0]};
  return predicates__products_mp(q);
}

int dot_mp(const double *a, const double *b, const double *p)
{
  double q[8] = {a[0], p[0], b[0], p[0], p[1], a[1], b[1], p[1]};
  return predicates__products_mp(q);
}

int incircle_fixed(const double *a, const double *b, const double *c, const double *d, int bits)
{
  const double *p[3] = {a, b, c};
  mpfr_t x[3], y[3], l[3], sum, t;
  mpfr_prec_t prec = bits;
  mpfr_inits2(prec, sum, t, (mpfr_ptr)0);
  for (int i = 0; i < 3; i++) {
    mpfr_inits2(prec, x[i], y[i], l[i], (mpfr_ptr)0);
    difference(x[i], p[i][0], d[0]);
    difference(y[i], p[i][1], d[1]);
    mpfr_sqr(l[i], x[i], MPFR_RNDN);
    mpfr_sqr(t, y[i], MPFR_RNDN);
    mpfr_add(l[i], l[i], t, MPFR_RNDN);
  }
  mpfr_set_zero(sum, 1);
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    mpfr_mul(t, x[j], y[k], MPFR_RNDN);
    mpfr_mul(t, t, l[i], MPFR_RNDN);
    mpfr_add(sum, sum, t, MPFR_RNDN);
    mpfr_mul(t, x[k], y[j], MPFR_RNDN);
    mpfr_mul(t, t, l[i], MPFR_RNDN);
    mpfr_sub(sum, sum, t, MPFR_RNDN);
  }
  int s = mpfr_sgn(sum);
  for (int i = 0; i < 3; i++) mpfr_clears(x[i], y[i], l[i], (mpfr_ptr)0);
  mpfr_clears(sum, t, (mpfr_ptr)0);
  return (s > 0) - (s < 0);
}

int incircle_mp(const double *a, const double *b, const double *c, const double *d)
{
  double q[8] = {a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]};
  mpfr_prec_t bits = precision_for(q, 8, 4);
  return incircle_fixed(a, b, c, d, (int)MAX(bits, (mpfr_prec_t)64));
}

// y = (ay 2 (bx - ax) + (by - ay) (u + v - 2 ax)) / (2 (bx - ax)): the numerator, and w = bx - ax; t is scratch.
static void height(mpfr_t y, mpfr_t w, mpfr_t t, const double *a, const double *b, double u, double v)
{
  difference(y, b[1], a[1]);
  difference(t, u, a[0]);
  mpfr_add_d(t, t, v, MPFR_RNDN);
  mpfr_sub_d(t, t, a[0], MPFR_RNDN);
  mpfr_mul(y, y, t, MPFR_RNDN);
  difference(w, b[0], a[0]);
  mpfr_mul_d(t, w, a[1], MPFR_RNDN);
  mpfr_mul_ui(t, t, 2, MPFR_RNDN);
  mpfr_add(y, y, t, MPFR_RNDN);
}

int segments_order_at_mp(const double *a, const double *b, const double *c, const double *d, double u, double v)
{
  double q[10] = {a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1], u, v};
  mpfr_prec_t bits = precision_for(q, 10, 3) + 16; // each factor below is less than eight times a coordinate
  bits = MAX(bits, (mpfr_prec_t)64);
  mpfr_t y0, y1, w0, w1, t;
  mpfr_inits2(bits, y0, y1, w0, w1, t, (mpfr_ptr)0);
  height(y0, w0, t, a, b, u, v);
  height(y1, w1, t, c, d, u, v);
  mpfr_mul(y0, y0, w1, MPFR_RNDN);
  mpfr_mul(y1, y1, w0, MPFR_RNDN);
  int s = mpfr_cmp(y0, y1);
  mpfr_clears(y0, y1, w0, w1, t, (mpfr_ptr)0);
  return (s > 0) - (s < 0);
}
