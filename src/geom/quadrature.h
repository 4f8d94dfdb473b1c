// quadrature.h - integrals of a positive function over [0,1], and where they reach given values
// SPDX-License-Identifier: MIT
#ifndef GEOM_QUADRATURE_H
#define GEOM_QUADRATURE_H

#include "base/base.h"

// f[i] = the function at t[i], for n places at once.
typedef void (*IntegrandBatch)(void *ctx, const double *t, size_t n, double *f);

// The running integral of a function over [0,1]: cells [t[i], t[i+1]] with five equidistant values each, on which the function
// is taken as the polynomial of degree 4 through them.
typedef struct {
  size_t n;     // cells
  double *t;    // n + 1
  double *f;    // 5 * n
  double *sum;  // n + 1: the integral from 0 to t[i]
} Integral;

// Halve cells, beginning with `ncell` equal ones, until Simpson's rule on a cell and on its halves agree to `tolerance`
// (absolute, per cell), or the cell is 2^-40 wide, or there are max_cells. Values are asked for in batches, a level at a time.
// For smooth functions the sum is good to far better than `tolerance`, since the two are extrapolated. Free with integral_free.
void integral_make(Integral *q, IntegrandBatch f, void *ctx, size_t ncell, double tolerance, size_t max_cells);
void integral_free(Integral *q);

static inline double integral_total(const Integral *q) { return q->sum[q->n]; }
// The integral from 0 to t.
double integral_upto(const Integral *q, double t);
// Where the integral from 0 reaches each of target[n], ascending within [0, total]: by bisected Newton to rounding. O(n + cells).
void integral_inverse(const Integral *q, const double *target, size_t n, double *t);
// The interpolated function at t.
double integral_value(const Integral *q, double t);

#endif
