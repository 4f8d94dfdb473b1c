// spline.c - OpenCASCADE's splines, whose shape is fixed when they are made: Bezier pieces between two points
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/curve_int.h"

static Pieces *new_pieces(Model *m, int degree, int npiece)
{
  Pieces *p = arena_alloc(&m->arena, sizeof *p);
  p->degree = degree;
  p->npiece = npiece;
  p->smooth = true;
  p->knot = arena_alloc(&m->arena, ((size_t)npiece + 1) * sizeof *p->knot);
  p->control = arena_alloc(&m->arena, (size_t)npiece * (size_t)(degree + 1) * sizeof *p->control);
  return p;
}

// Derivative at t[0] of the polynomial through n points.
static Vec3 lagrange_slope(const double *t, const Vec3 *x, int n)
{
  Vec3 d = {0, 0, 0};
  for (int i = 1; i < n; i++) {
    double w = 1 / (t[i] - t[0]);
    for (int k = 1; k < n; k++)
      if (k != i) w *= (t[0] - t[k]) / (t[i] - t[k]);
    d = vec3_add(d, vec3_scale(w, vec3_sub(x[i], x[0])));
  }
  return d;
}

// Derivatives of the cubic spline through x, twice differentiable, of which the first and the last are given.
static void inner_slopes(const double *t, const Vec3 *x, int n, Vec3 *slope)
{
  double *factor = mem_alloc((size_t)n * sizeof *factor);
  factor[0] = 0;
  for (int i = 1; i + 1 < n; i++) {
    double before = 1 / (t[i] - t[i - 1]), after = 1 / (t[i + 1] - t[i]);
    Vec3 right = vec3_add(vec3_scale(3 * before * before, vec3_sub(x[i], x[i - 1])), vec3_scale(3 * after * after, vec3_sub(x[i + 1], x[i])));
    double pivot = 2 * (before + after) - before * factor[i - 1];
    factor[i] = after / pivot;
    slope[i] = vec3_scale(1 / pivot, vec3_sub(right, vec3_scale(before, slope[i - 1])));
  }
  for (int i = n - 2; i > 0; i--) slope[i] = vec3_sub(slope[i], vec3_scale(factor[i], slope[i + 1]));
  free(factor);
}

// Cubic, twice differentiable through all points. At the ends it has the direction of the cubic through the four nearest points, closed
// curves at both ends that of the first four.
static Pieces *through(Model *m, const Vec3 *x, int n, bool closed, bool by_chords)
{
  double *t = mem_alloc((size_t)n * sizeof *t), back_t[4];
  Vec3 *slope = mem_alloc((size_t)n * sizeof *slope), back_x[4];
  t[0] = 0;
  for (int i = 1; i < n; i++) t[i] = t[i - 1] + (by_chords ? vec3_distance(x[i - 1], x[i]) : 1);
  int near = MIN(closed ? n - 1 : n, 4);
  for (int i = 0; i < near; i++) {
    back_t[i] = t[n - 1 - i];
    back_x[i] = x[n - 1 - i];
  }
  slope[0] = lagrange_slope(t, x, near);
  slope[n - 1] = closed ? slope[0] : lagrange_slope(back_t, back_x, near);
  inner_slopes(t, x, n, slope);
  Pieces *p = new_pieces(m, 3, n - 1);
  for (int i = 0; i + 1 < n; i++) {
    double third = (t[i + 1] - t[i]) / 3;
    Vec3 *b = p->control + 4 * (size_t)i;
    b[0] = x[i];
    b[1] = vec3_add(x[i], vec3_scale(third, slope[i]));
    b[2] = vec3_sub(x[i + 1], vec3_scale(third, slope[i + 1]));
    b[3] = x[i + 1];
    p->knot[i] = t[i] / t[n - 1];
  }
  p->knot[n - 1] = 1;
  free(t);
  free(slope);
  return p;
}

Pieces *pieces__through(Model *m, const Vec3 *x, int n) { return through(m, x, n, false, false); }

// Cubic B-spline around n points, with single knots but where it begins: there a double one, halfway between the first two points.
static Pieces *around(Model *m, const Vec3 *x, int n)
{
  Pieces *p = new_pieces(m, 3, n - 1);
  for (int i = 0; i + 1 < n; i++) {
    // knots about the span i .. i + 1; the double knots are the ends of 0 .. n - 1
    double knot[6];
    for (int k = 0; k < 6; k++) {
      int j = i - 2 + k;
      knot[k] = j < 0 ? j + 1 : j > n - 1 ? j - 1 : j;
    }
    for (int low = 3; low >= 0; low--) {
      Vec3 d[4];
      for (int k = 0; k < 4; k++) d[k] = x[(i + k) % n];
      for (int r = 1; r <= 3; r++) {
        double u = r <= low ? i : i + 1;
        for (int k = 3; k >= r; k--) {
          double a = knot[k - 1], b = knot[k + 3 - r], f = (u - a) / (b - a);
          d[k] = vec3_add(vec3_scale(1 - f, d[k - 1]), vec3_scale(f, d[k]));
        }
      }
      p->control[4 * (size_t)i + (size_t)(3 - low)] = d[3];
    }
    p->knot[i] = (double)i / (n - 1);
  }
  p->knot[n - 1] = 1;
  return p;
}

static Pieces *one_bezier(Model *m, const Vec3 *x, int n)
{
  Pieces *p = new_pieces(m, n - 1, 1);
  memcpy(p->control, x, (size_t)n * sizeof *x);
  p->knot[0] = 0;
  p->knot[1] = 1;
  return p;
}

// What the built-in kernel makes of these points, which OpenCASCADE makes too.
static Pieces *as_built_in(Model *m, CurveType type, int tag, const int *point, int n, SrcLoc loc, Diag *diag)
{
  Curve c = {.tag = tag, .type = type, .point = (int *)point, .npoint = n, .begin = point[0], .end = point[n - 1], .loc = loc};
  if (!curve__build(m, &c, diag)) return NULL;
  const CurveShape *h = c.shape;
  Pieces *p = new_pieces(m, h->degree, h->npiece);
  memcpy(p->knot, h->knot, ((size_t)h->npiece + 1) * sizeof *p->knot);
  memcpy(p->control, h->control, (size_t)h->npiece * (size_t)(h->degree + 1) * sizeof *p->control);
  curve__release(&c);
  return p;
}

static bool points_apart(const int *point, const Vec3 *x, int n, int tag, SrcLoc loc, Diag *diag)
{
  for (int i = 0; i + 1 < n; i++) {
    if (vec3_distance(x[i], x[i + 1]) > 0) continue;
    diag_error(diag, loc, "Spline %d has two points in one place, %d and %d, one after the other", tag, point[i], point[i + 1]);
    return false;
  }
  return true;
}

bool spline__add(Model *m, CurveType type, int tag, const int *point, size_t npoint, SrcLoc loc, Diag *diag)
{
  int n = (int)npoint, ends[2] = {point[0], point[n - 1]};
  bool closed = ends[0] == ends[1] && n > 2;
  if (n == 2) {
    curve__make(m, tag, CURVE_LINE, point, 2, ends[0], ends[1], loc);
    return true;
  }
  Vec3 *x = mem_alloc(npoint * sizeof *x);
  for (int i = 0; i < n; i++) x[i] = point__get(m, point[i])->xyz;
  Pieces *p = NULL;
  if (type == CURVE_SPLINE) p = points_apart(point, x, n, tag, loc, diag) ? through(m, x, n, closed, true) : NULL;
  else if (type == CURVE_BEZIER) p = one_bezier(m, x, n);
  else if (!closed) p = as_built_in(m, type, tag, point, n, loc, diag);
  else {
    p = around(m, x, n - 1);
    ends[0] = ends[1] = model__next_tag(m, KIND_POINT);
    point__make(m, ends[0], p->control[0], 0, loc);
  }
  free(x);
  if (p) curve__make(m, tag, type, ends, 2, ends[0], ends[1], loc)->pieces = p;
  return p != NULL;
}
