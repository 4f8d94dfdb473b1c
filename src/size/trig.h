// trig.h - sine and cosine without branches for moderate arguments, so that scattered ones cost no mispredictions
// SPDX-License-Identifier: MIT
#ifndef SIZE_TRIG_H
#define SIZE_TRIG_H

#include "base/base.h"

#include <math.h>

#define TRIG_MOST 1e5 // arguments up to this; larger ones are for the C library

// sin(x + quarter pi/2) for |x| <= TRIG_MOST, within 1 ulp. x is reduced by the nearest multiple n of pi/2, of which two parts of 33 bits
// are subtracted exactly and the rest goes to the tail; then Taylor's series of both functions on [-pi/4, pi/4], truncated
// below 2^-58.
static inline double trig_quarter(double x, int quarter)
{
  const double round = 0x1.8p52;
  double shifted = x * 0x1.45f306dc9c883p-1 + round, n = shifted - round;
  double r = x - n * 0x1.921fb544p0, w = n * 0x1.0b4611a6p-34, t = r - w;
  double y = t - (n * 0x1.3198a2e037073p-69 - ((r - t) - w));
  double tail = (t - y) - (n * 0x1.3198a2e037073p-69 - ((r - t) - w));
  double z = y * y, half = z / 2;
  double s = y + (z * y * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880 + z * (-1.0 / 39916800 +
             z * (1.0 / 6227020800.0 - z * (1.0 / 1307674368000.0 - z / 355687428096000.0))))))) + tail * (1 - half));
  double big = 1 - half;
  double c = big + (((1 - big) - half) + (z * z * (1.0 / 24 - z * (1.0 / 720 - z * (1.0 / 40320 - z * (1.0 / 3628800 -
             z * (1.0 / 479001600 - z * (1.0 / 87178291200.0 - z / 20922789888000.0)))))) - y * tail));
  uint64_t bits; // the low bits of `shifted` are those of n
  memcpy(&bits, &shifted, sizeof bits);
  bits += (uint64_t)quarter;
  uint64_t odd = -(bits & 1), sign = (bits & 2) << 62, from_s, from_c;
  memcpy(&from_s, &s, sizeof from_s);
  memcpy(&from_c, &c, sizeof from_c);
  uint64_t out = ((from_s & ~odd) | (from_c & odd)) ^ sign;
  double v;
  memcpy(&v, &out, sizeof v);
  return v;
}

static inline double trig_sin(double x) { return fabs(x) <= TRIG_MOST ? trig_quarter(x, 0) : sin(x); }
static inline double trig_cos(double x) { return fabs(x) <= TRIG_MOST ? trig_quarter(x, 1) : cos(x); }

// The same for n values; in vector lanes where all are moderate.
static inline void trig_batch(const double *x, size_t n, int quarter, double *out)
{
  double most = 0;
  for (size_t i = 0; i < n; i++) most = fabs(x[i]) <= most ? most : fabs(x[i]); // nan stays
  if (most <= TRIG_MOST) {
    for (size_t i = 0; i < n; i++) out[i] = trig_quarter(x[i], quarter);
  } else {
    for (size_t i = 0; i < n; i++) out[i] = quarter ? trig_cos(x[i]) : trig_sin(x[i]);
  }
}

#endif
