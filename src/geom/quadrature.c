// quadrature.c - adaptive integration in cells of five values, kept for inversion
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/quadrature.h"

#include <math.h>

#include "base/mem.h"

typedef struct {
  double t0, width;
  double f[5];
  uint32_t next; // cell to the right, or NONE
} Cell;
typedef Vec(Cell) CellVec;

// Boole's rule: Simpson's on the cell and on its halves, extrapolated.
static double cell_sum(const Cell *c)
{
  return c->width / 90 * (7 * (c->f[0] + c->f[4]) + 32 * (c->f[1] + c->f[3]) + 12 * c->f[2]);
}

static bool is_resolved(const Cell *c, double tolerance)
{
  double coarse = c->width / 6 * (c->f[0] + 4 * c->f[2] + c->f[4]);
  double fine = c->width / 12 * (c->f[0] + 4 * c->f[1] + 2 * c->f[2] + 4 * c->f[3] + c->f[4]);
  return fabs(coarse - fine) <= tolerance + 1e-15 * fabs(fine) || c->width < 0x1p-40;
}

// Split cell k in the middle; its right half is appended. Their values at odd quarters are still to be had.
static void halve(CellVec *cells, uint32_t k)
{
  Cell a = cells->data[k], b = a;
  a.width = b.width = a.width / 2;
  b.t0 = a.t0 + a.width;
  b.f[0] = a.f[2], b.f[2] = a.f[3], b.f[4] = a.f[4];
  a.f[4] = a.f[2], a.f[2] = a.f[1];
  a.next = (uint32_t)cells->len;
  cells->data[k] = a;
  vec_push(cells, b);
}

// Values at the first and third quarter of the cells listed.
static void fill_quarters(CellVec *cells, const U32Vec *list, IntegrandBatch f, void *ctx, DoubleVec *scratch)
{
  size_t n = 2 * list->len;
  vec_resize(scratch, 2 * n);
  double *t = scratch->data, *v = t + n;
  for (size_t i = 0; i < list->len; i++) {
    const Cell *c = &cells->data[list->data[i]];
    t[2 * i] = c->t0 + 0.25 * c->width;
    t[2 * i + 1] = c->t0 + 0.75 * c->width;
  }
  f(ctx, t, n, v);
  for (size_t i = 0; i < list->len; i++) {
    Cell *c = &cells->data[list->data[i]];
    c->f[1] = v[2 * i];
    c->f[3] = v[2 * i + 1];
  }
}

static void first_cells(CellVec *cells, size_t n, IntegrandBatch f, void *ctx, DoubleVec *scratch)
{
  size_t m = 4 * n + 1;
  vec_resize(scratch, 2 * m);
  double *t = scratch->data, *v = t + m;
  for (size_t i = 0; i < m; i++) t[i] = (double)i / (double)(4 * n);
  f(ctx, t, m, v);
  for (size_t k = 0; k < n; k++) {
    Cell c = {t[4 * k], t[4 * k + 4] - t[4 * k], {0}, k + 1 < n ? (uint32_t)(k + 1) : NONE};
    memcpy(c.f, v + 4 * k, sizeof c.f);
    vec_push(cells, c);
  }
}

static void store(Integral *q, const CellVec *cells)
{
  q->n = cells->len;
  q->t = mem_alloc((7 * q->n + 2) * sizeof *q->t);
  q->sum = q->t + q->n + 1;
  q->f = q->sum + q->n + 1;
  size_t i = 0;
  q->sum[0] = 0;
  for (uint32_t k = 0; k != NONE; k = cells->data[k].next, i++) {
    const Cell *c = &cells->data[k];
    q->t[i] = c->t0;
    memcpy(q->f + 5 * i, c->f, sizeof c->f);
    q->sum[i + 1] = q->sum[i] + cell_sum(c);
  }
  q->t[i] = 1;
}

void integral_make(Integral *q, IntegrandBatch f, void *ctx, size_t ncell, double tolerance, size_t max_cells)
{
  CellVec cells = {0};
  U32Vec list = {0}, open = {0};
  DoubleVec scratch = {0};
  first_cells(&cells, ncell, f, ctx, &scratch);
  for (uint32_t k = 0; k < cells.len; k++) vec_push(&open, k);
  while (open.len && cells.len < max_cells) {
    vec_clear(&list);
    for (size_t i = 0; i < open.len && cells.len < max_cells; i++) {
      uint32_t k = open.data[i];
      if (is_resolved(&cells.data[k], tolerance)) continue;
      vec_push(&list, k);
      vec_push(&list, (uint32_t)cells.len);
      halve(&cells, k);
    }
    if (list.len) fill_quarters(&cells, &list, f, ctx, &scratch);
    U32Vec swap = open;
    open = list;
    list = swap;
  }
  store(q, &cells);
  vec_free(&cells);
  vec_free(&list);
  vec_free(&open);
  vec_free(&scratch);
}

void integral_free(Integral *q)
{
  free(q->t);
  *q = (Integral){0};
}

// ---- inside a cell: the quartic through its values, in x in [0,4] ---------------------------------------------------------

// Coefficients of the polynomial in x, by Newton's forward differences expanded.
static void quartic(const double f[5], double a[5])
{
  double d1 = f[1] - f[0], d2 = f[2] - 2 * f[1] + f[0], d3 = f[3] - 3 * f[2] + 3 * f[1] - f[0];
  double d4 = f[4] - 4 * f[3] + 6 * f[2] - 4 * f[1] + f[0];
  a[0] = f[0];
  a[1] = d1 - d2 / 2 + d3 / 3 - d4 / 4;
  a[2] = d2 / 2 - d3 / 2 + 11 * d4 / 24;
  a[3] = d3 / 6 - d4 / 4;
  a[4] = d4 / 24;
}

static double quartic_at(const double a[5], double x)
{
  return a[0] + x * (a[1] + x * (a[2] + x * (a[3] + x * a[4])));
}

static double quartic_sum(const double a[5], double x)
{
  return x * (a[0] + x * (a[1] / 2 + x * (a[2] / 3 + x * (a[3] / 4 + x * a[4] / 5))));
}

static size_t cell_of(const Integral *q, double t)
{
  size_t lo = 0, hi = q->n;
  while (hi - lo > 1) {
    size_t mid = (lo + hi) / 2;
    if (q->t[mid] <= t) lo = mid;
    else hi = mid;
  }
  return lo;
}

double integral_upto(const Integral *q, double t)
{
  if (t <= 0) return 0;
  if (t >= 1) return integral_total(q);
  size_t i = cell_of(q, t);
  double a[5], w = (q->t[i + 1] - q->t[i]) / 4;
  quartic(q->f + 5 * i, a);
  return q->sum[i] + w * quartic_sum(a, (t - q->t[i]) / w);
}

double integral_value(const Integral *q, double t)
{
  size_t i = cell_of(q, t);
  double a[5], w = (q->t[i + 1] - q->t[i]) / 4;
  quartic(q->f + 5 * i, a);
  return quartic_at(a, (t - q->t[i]) / w);
}

// x in [0,4] where the sum in the cell is `want`: Newton, kept in a shrinking bracket.
static double solve(const double a[5], double want, double total)
{
  double lo = 0, hi = 4, x = total > 0 ? 4 * want / total : 0;
  for (int it = 0; it < 60; it++) {
    double r = quartic_sum(a, x) - want, slope = quartic_at(a, x);
    if (r > 0) hi = x;
    else lo = x;
    double y = slope > 0 ? x - r / slope : lo;
    if (!(y > lo && y < hi)) y = (lo + hi) / 2;
    if (fabs(y - x) <= 4e-16 * 4) return y;
    x = y;
  }
  return x;
}

void integral_inverse(const Integral *q, const double *target, size_t n, double *t)
{
  size_t cell = 0, made = SIZE_MAX;
  double a[5] = {0};
  for (size_t k = 0; k < n; k++) {
    while (cell + 1 < q->n && q->sum[cell + 1] < target[k]) cell++;
    if (made != cell) quartic(q->f + 5 * cell, a);
    made = cell;
    double w = (q->t[cell + 1] - q->t[cell]) / 4;
    double total = q->sum[cell + 1] - q->sum[cell];
    t[k] = q->t[cell] + w * solve(a, fmax(target[k] - q->sum[cell], 0) / w, total / w);
  }
}
