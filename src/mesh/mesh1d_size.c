// mesh1d_size.c - counts and places of nodes by the size integral, and the limit on the growth of sizes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "base/map.h"
#include "base/mem.h"
#include "mesh/mesh1d_int.h"

typedef struct {
  const Mesher1d *d;
  const Curve *c;
  SizeEval *eval;
  double end_h[2];   // sizes at the end points: the smaller of the curve's and the point's
  bool straight;
  double length;     // of a straight curve, its speed
} Along;

static double speed_at(const Along *a, double t)
{
  return a->straight ? a->length : vec3_length(curve_deriv(a->d->m, a->c, t));
}

enum { CHUNK = 64 };

// Sizes and speeds at n parameters.
static void sample(const Along *a, const double *t, size_t n, double *h, double *speed)
{
  Vec3 p[CHUNK];
  for (size_t from = 0; from < n; from += CHUNK) {
    size_t m = MIN(n - from, (size_t)CHUNK);
    for (size_t i = 0; i < m; i++) p[i] = curve_point(a->d->m, a->c, t[from + i]);
    size_on_curve_batch(a->eval, a->c, t + from, p, m, h + from);
  }
  for (size_t i = 0; i < n; i++) {
    if (t[i] <= 0) h[i] = a->end_h[0];
    if (t[i] >= 1) h[i] = a->end_h[1];
    speed[i] = speed_at(a, t[i]);
  }
}

static void density(void *ctx, const double *t, size_t n, double *f)
{
  const Along *a = ctx;
  double h[CHUNK], v[CHUNK];
  for (size_t from = 0; from < n; from += CHUNK) {
    size_t m = MIN(n - from, (size_t)CHUNK);
    sample(a, t + from, m, h, v);
    for (size_t i = 0; i < m; i++) f[from + i] = v[i] / h[i];
  }
}

// ---- limited growth as Gmsh samples it --------------------------------------------------------------------------------------
//
// Where sizes grow too fast the count depends on the samples, and compatible counts need compatible samples: trapezoids halved
// until a cell and its halves agree to the precision, at least 6 times.

typedef struct {
  double t0, t1, h[3], v[3]; // ends and middle
  uint32_t next;
} Trapezoid;
typedef Vec(Trapezoid) TrapezoidVec;

enum { LEAST_LEVEL = 6, LAST_LEVEL = 30 };

static bool is_fine(const Trapezoid *z, int level, double precision)
{
  if (level < LEAST_LEVEL) return false;
  if (level >= LAST_LEVEL) return true;
  double w = z->t1 - z->t0, f0 = z->v[0] / z->h[0], f1 = z->v[1] / z->h[1], f2 = z->v[2] / z->h[2];
  return fabs(w / 2 * (f0 + f2) - w / 4 * (f0 + 2 * f1 + f2)) < precision;
}

static void halve(TrapezoidVec *z, uint32_t k)
{
  Trapezoid a = z->data[k], b = a;
  a.t1 = b.t0 = (a.t0 + a.t1) / 2;
  a.h[2] = b.h[0] = a.h[1];
  a.v[2] = b.v[0] = a.v[1];
  a.next = (uint32_t)z->len;
  z->data[k] = a;
  vec_push(z, b);
}

static void fill_middles(const Along *a, TrapezoidVec *z, const U32Vec *list)
{
  double t[CHUNK], h[CHUNK], v[CHUNK];
  for (size_t from = 0; from < list->len; from += CHUNK) {
    size_t m = MIN(list->len - from, (size_t)CHUNK);
    for (size_t i = 0; i < m; i++) {
      const Trapezoid *c = &z->data[list->data[from + i]];
      t[i] = (c->t0 + c->t1) / 2;
    }
    sample(a, t, m, h, v);
    for (size_t i = 0; i < m; i++) {
      Trapezoid *c = &z->data[list->data[from + i]];
      c->h[1] = h[i];
      c->v[1] = v[i];
    }
  }
}

static void samples_alloc(Samples *g, size_t n)
{
  g->n = n;
  g->t = mem_zalloc(5 * n * sizeof(double));
  g->speed = g->t + n;
  g->h = g->speed + n;
  g->sum = g->h + n;
  g->s = g->sum + n;
}

static void sample_recursively(const Along *a, double precision, Samples *g)
{
  TrapezoidVec z = {0};
  U32Vec open = {0}, list = {0};
  double t[2] = {0, 1}, h[2], v[2];
  sample(a, t, 2, h, v);
  vec_push(&z, ((Trapezoid){0, 1, {h[0], 0, h[1]}, {v[0], 0, v[1]}, NONE}));
  vec_push(&open, 0);
  fill_middles(a, &z, &open);
  for (int level = 0; open.len && z.len < (1u << 22); level++) {
    vec_clear(&list);
    for (size_t i = 0; i < open.len; i++) {
      uint32_t k = open.data[i];
      if (is_fine(&z.data[k], level, precision)) continue;
      vec_push(&list, k);
      vec_push(&list, (uint32_t)z.len);
      halve(&z, k);
    }
    fill_middles(a, &z, &list);
    U32Vec swap = open;
    open = list;
    list = swap;
  }
  samples_alloc(g, 2 * z.len + 1);
  size_t n = 0;
  for (uint32_t k = 0; k != NONE; k = z.data[k].next) {
    const Trapezoid *c = &z.data[k];
    for (int i = n ? 1 : 0; i < 3; i++, n++) {
      g->t[n] = i == 0 ? c->t0 : i == 1 ? (c->t0 + c->t1) / 2 : c->t1;
      g->h[n] = c->h[i];
      g->speed[n] = c->v[i];
    }
  }
  vec_free(&z);
  vec_free(&open);
  vec_free(&list);
}

// Forward and backward until nothing changes [book §4.3]. The sizes of both ends may only get smaller.
static void limit_growth(Samples *g, double slope)
{
  bool changed = true;
  for (int it = 0; changed && it < 2000; it++) {
    changed = false;
    for (size_t i = 1; i < g->n; i++) {
      double most = slope * g->speed[i] * (g->t[i] - g->t[i - 1]);
      if (g->h[i] - g->h[i - 1] > 1.01 * most) g->h[i] = g->h[i - 1] + most, changed = true;
    }
    for (size_t i = g->n - 1; i > 0; i--) {
      double most = slope * g->speed[i - 1] * (g->t[i] - g->t[i - 1]);
      if (g->h[i - 1] - g->h[i] > 1.01 * most) g->h[i - 1] = g->h[i] + most, changed = true;
    }
  }
}

static double sum_trapezoids(Samples *g)
{
  g->sum[0] = 0;
  for (size_t i = 1; i < g->n; i++) {
    double f0 = g->speed[i - 1] / g->h[i - 1], f1 = g->speed[i] / g->h[i];
    g->sum[i] = g->sum[i - 1] + (g->t[i] - g->t[i - 1]) * (f0 + f1) / 2;
  }
  return g->sum[g->n - 1];
}

// ---- our own limit (Mesh.SizeGradation): sizes linear in arc length between samples, integrated exactly ---------------------

static void arc_lengths(Samples *g)
{
  for (size_t i = 1; i < g->n; i++) g->s[i] = g->s[i - 1] + (g->t[i] - g->t[i - 1]) * (g->speed[i] + g->speed[i - 1]) / 2;
}

// One sweep each way with exact slopes; true if an end's size went down.
static bool sweep(Samples *g, double slope)
{
  double first = g->h[0], last = g->h[g->n - 1];
  for (size_t i = 1; i < g->n; i++) g->h[i] = fmin(g->h[i], g->h[i - 1] + slope * (g->s[i] - g->s[i - 1]));
  for (size_t i = g->n - 1; i > 0; i--) g->h[i - 1] = fmin(g->h[i - 1], g->h[i] + slope * (g->s[i] - g->s[i - 1]));
  return g->h[0] < first || g->h[g->n - 1] < last;
}

static double sum_linear(Samples *g)
{
  g->sum[0] = 0;
  for (size_t i = 1; i < g->n; i++) {
    double ds = g->s[i] - g->s[i - 1], a = g->h[i - 1], b = g->h[i], x = (b - a) / a;
    double per = fabs(x) < 1e-8 ? (1 - x / 2) / a : log1p(x) / (b - a);
    g->sum[i] = g->sum[i - 1] + ds * per;
  }
  return g->sum[g->n - 1];
}

// Segments for an adimensional length; up to 0.01 more than a whole number does not add one, rounding of that included.
static uint32_t segments_for(double a, uint32_t least)
{
  double n = floor(a + 0.99 - 1e-9);
  return n > least ? (n < 4e9 ? (uint32_t)n : UINT32_MAX) : least;
}

void mesh1d__grade_all(Mesher1d *d, double slope)
{
  const Model *m = d->m;
  Map index = {0};
  size_t np = model_points(m);
  double *at = mem_alloc((np + 1) * sizeof *at);
  for (size_t k = 0; k < np; k++) {
    map_set(&index, (uint64_t)model_point_at(m, k)->tag, (uint32_t)k);
    at[k] = INFINITY;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t k = 0; k < d->g->ncurve; k++) {
      CurveWork *w = &d->work[k];
      if (w->rule != RULE_GRADED) continue;
      Samples *g = &w->g;
      double *begin = &at[map_get(&index, (uint64_t)w->c->begin)], *end = &at[map_get(&index, (uint64_t)w->c->end)];
      g->h[0] = fmin(g->h[0], *begin);
      g->h[g->n - 1] = fmin(g->h[g->n - 1], *end);
      sweep(g, slope);
      if (g->h[0] < *begin) *begin = g->h[0], changed = true;
      if (g->h[g->n - 1] < *end) *end = g->h[g->n - 1], changed = true;
    }
  }
  free(at);
  map_free(&index);
  for (size_t k = 0; k < d->g->ncurve; k++) {
    CurveWork *w = &d->work[k];
    if (w->rule != RULE_GRADED) continue;
    w->a = sum_linear(&w->g);
    w->segments = segments_for(w->a, w->least);
  }
}

// ---- measuring ------------------------------------------------------------------------------------------------------------------

// Cells to begin with: enough to see a field's details of 1/64 of the curve, as Gmsh does, and the pieces of splines.
static size_t first_cells(const Along *a)
{
  size_t n = a->straight ? 1 : a->c->joined ? 16 : a->c->type == CURVE_CIRCLE ? 2 : a->c->type == CURVE_ELLIPSE ? 4 : (size_t)MAX(a->c->npoint - 1, 2);
  return size_has_field(a->d->size) ? MAX(n, (size_t)16) : n;
}

// True if the size grows faster than `slope` somewhere between two neighbouring values.
static bool grows_too_fast(const Along *a, const Integral *q, double slope)
{
  double h0 = 0, v0 = 0, t0 = 0;
  for (size_t i = 0; i < q->n; i++) {
    for (int k = 0; k < 5; k++) {
      if (k == 0 && i > 0) continue;
      double t = q->t[i] + (q->t[i + 1] - q->t[i]) * k / 4, v = speed_at(a, t), h = v / q->f[5 * i + (size_t)k];
      if (!(v > 0)) h = h0;
      if ((i || k) && fabs(h - h0) > 1.01 * slope * (t - t0) * fmax(v, v0) + 1e-13 * h) return true;
      h0 = h, v0 = v, t0 = t;
    }
  }
  return false;
}

uint32_t mesh1d__least_segments(const Model *m, const Options *o, const Curve *c)
{
  if (c->joined) return 1;
  switch (c->type) {
  case CURVE_LINE:
  case CURVE_POLYLINE: return (uint32_t)MAX(o->Mesh_MinimumLineNodes - 1, 1);
  case CURVE_CIRCLE:
  case CURVE_ELLIPSE: {
    double turn = fabs(curve_angle(m, c)) / (2 * M_PI);
    return (uint32_t)MAX((int)(0.99 + MAX(o->Mesh_MinimumCircleNodes - 1, 0) * turn), 1);
  }
  case CURVE_SPLINE:
  case CURVE_BSPLINE:
  case CURVE_BEZIER:
  case CURVE_NURBS: return (uint32_t)MAX(o->Mesh_MinimumCurveNodes - 1, 1);
  }
  UNREACHABLE();
}

void mesh1d__measure(Mesher1d *d, size_t k, SizeEval *eval)
{
  CurveWork *w = &d->work[k];
  const Curve *c = w->c;
  Along a = {d, c, eval, {0, 0}, curve_is_straight(d->m, c) && c->type == CURVE_LINE, 0};
  if (a.straight) a.length = curve_length(d->m, c);
  const Point *end[2] = {model_point(d->m, c->begin), model_point(d->m, c->end)};
  double on_curve[2];
  for (int i = 0; i < 2; i++) {
    on_curve[i] = size_on_curve(eval, c, i, curve_point(d->m, c, i));
    a.end_h[i] = fmin(on_curve[i], size_at_point(eval, end[i]));
  }
  w->least = MAX(w->least, mesh1d__least_segments(d->m, d->opt, c));
  double own = size_gradation(d->size), slope = own > 0 ? own : sqrt(d->opt->Mesh_SmoothRatio) - 1;
  bool jump = a.end_h[0] < on_curve[0] * (1 - 1e-9) || a.end_h[1] < on_curve[1] * (1 - 1e-9);
  double precision = d->opt->Mesh_LcIntegrationPrecision; // of sums; places inside cells need more
  if (own == 0 && !jump) {
    integral_make(&w->q, density, &a, first_cells(&a), precision / 100, 1 << 18);
    if (!grows_too_fast(&a, &w->q, slope)) {
      w->rule = RULE_SIZE;
      w->a = integral_total(&w->q);
      w->segments = segments_for(w->a, w->least);
      return;
    }
    integral_free(&w->q);
  }
  w->rule = RULE_GRADED;
  sample_recursively(&a, precision, &w->g);
  if (own > 0) {
    arc_lengths(&w->g); // sums follow when all curves are limited together
    return;
  }
  limit_growth(&w->g, slope);
  w->a = sum_trapezoids(&w->g);
  w->segments = segments_for(w->a, w->least);
}

// ---- placing ---------------------------------------------------------------------------------------------------------------------

void mesh1d__release(CurveWork *w)
{
  integral_free(&w->q);
  free(w->g.t);
  w->g = (Samples){0};
}

void mesh1d__resize(CurveMesh *cm, uint32_t n)
{
  cm->n = n;
  cm->u = mem_realloc(cm->u, n * sizeof *cm->u);
  cm->p = mem_realloc(cm->p, n * sizeof *cm->p);
  cm->h = mem_realloc(cm->h, n * sizeof *cm->h);
}

void mesh1d__positions(const Model *m, const Curve *c, CurveMesh *cm)
{
  for (uint32_t i = 0; i < cm->n; i++) cm->p[i] = curve_point(m, c, cm->u[i]);
  const Point *begin = model_point(m, c->begin), *end = model_point(m, c->end);
  cm->p[0] = begin->xyz;
  cm->p[cm->n - 1] = end->xyz;
}

static void place_exactly(CurveWork *w, CurveMesh *cm)
{
  uint32_t n = cm->n;
  double *target = cm->h; // room that is free until the sizes come
  for (uint32_t i = 0; i < n; i++) target[i] = w->a * i / (n - 1);
  integral_inverse(&w->q, target, n, cm->u);
}

static void place_graded(const CurveWork *w, CurveMesh *cm, bool linear)
{
  const Samples *g = &w->g;
  uint32_t n = cm->n;
  size_t cell = 1;
  for (uint32_t i = 1; i + 1 < n; i++) {
    double want = w->a * i / (n - 1);
    while (cell + 1 < g->n && g->sum[cell] < want) cell++;
    double part = g->sum[cell] - g->sum[cell - 1], x = part > 0 ? (want - g->sum[cell - 1]) / part : 0.5;
    double h0 = g->h[cell - 1], h1 = g->h[cell];
    if (linear && fabs(h1 - h0) > 1e-8 * h0) x = h0 * expm1(x * log(h1 / h0)) / (h1 - h0);
    cm->u[i] = g->t[cell - 1] + x * (g->t[cell] - g->t[cell - 1]);
    cm->h[i] = h0 + x * (h1 - h0);
  }
  cm->h[0] = g->h[0];
  cm->h[n - 1] = g->h[g->n - 1];
}

typedef struct {
  double ratio;
  uint32_t node;
} Close;

static int by_ratio(const void *a, const void *b)
{
  const Close *x = a, *y = b;
  if (x->ratio != y->ratio) return x->ratio < y->ratio ? -1 : 1;
  return x->node < y->node ? -1 : x->node > y->node;
}

// Interior nodes nearer to the one kept before than 0.3 of the size wanted half-way between them (before its growth was limited)
// go, as long as `least` segments remain; an even number of them if the parity is to stay.
static void drop_close_nodes(Mesher1d *d, const CurveWork *w, CurveMesh *cm, SizeEval *eval, bool even)
{
  Vec(Close) close = {0};
  uint32_t kept = 0;
  for (uint32_t i = 1; i + 1 < cm->n; i++) {
    double u = (cm->u[i] + cm->u[kept]) / 2, dist = vec3_distance(cm->p[i], cm->p[kept]);
    double h = size_on_curve(eval, w->c, u, curve_point(d->m, w->c, u));
    if (dist < 0.3 * h) vec_push(&close, ((Close){h / dist, i}));
    else kept = i;
  }
  size_t n = close.len;
  if (even && n % 2) n--;
  uint32_t spare = cm->n - 1 > w->least ? cm->n - 1 - w->least : 0;
  if (n > spare) n = even ? spare / 2 * 2 : spare;
  if (n) {
    qsort(close.data, close.len, sizeof *close.data, by_ratio);
    for (size_t i = 0; i < n; i++) cm->u[close.data[i].node] = NAN;
    uint32_t m = 0;
    for (uint32_t i = 0; i < cm->n; i++) {
      if (isnan(cm->u[i])) continue;
      cm->u[m] = cm->u[i], cm->p[m] = cm->p[i], cm->h[m] = cm->h[i];
      m++;
    }
    cm->n = m;
  }
  vec_free(&close);
}

// Parameters that rounding made equal are spread: only possible on curves of no extent in u.
static void make_increasing(CurveMesh *cm)
{
  for (uint32_t i = 1; i + 1 < cm->n; i++)
    if (!(cm->u[i] > cm->u[i - 1]) || !(cm->u[i] < 1)) cm->u[i] = cm->u[i - 1] + (1 - cm->u[i - 1]) / (cm->n - i);
}

void mesh1d__place(Mesher1d *d, size_t k, SizeEval *eval)
{
  CurveWork *w = &d->work[k];
  CurveMesh *cm = &d->g->curve[k];
  bool own = size_gradation(d->size) > 0;
  mesh1d__resize(cm, w->segments + 1);
  if (w->rule == RULE_SIZE) place_exactly(w, cm);
  else place_graded(w, cm, own);
  cm->u[0] = 0;
  cm->u[cm->n - 1] = 1;
  make_increasing(cm);
  mesh1d__positions(d->m, w->c, cm);
  if (w->rule == RULE_SIZE) {
    for (uint32_t i = 0; i < cm->n; i++) {
      double f = integral_value(&w->q, cm->u[i]);
      cm->h[i] = f > 0 ? vec3_length(curve_deriv(d->m, w->c, cm->u[i])) / f : size_on_curve(eval, w->c, cm->u[i], cm->p[i]);
    }
  } else if (!own) {
    drop_close_nodes(d, w, cm, eval, w->parity);
  }
  mesh1d__release(w);
}
