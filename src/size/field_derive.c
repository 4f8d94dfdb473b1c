// field_derive.c - fields by finite differences of another: Mean, Gradient, Curvature, Laplacian, MaxEigenHessian; and LonLat
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "size/size_int.h"

typedef struct {
  double delta;
  int kind;        // Gradient
  double radius;   // LonLat from stereographic coordinates; 0: from space
} Derive;

static bool build_derived(SizeField *s, Node *n, Diag *diag)
{
  Derive *d = n->data = mem_zalloc(sizeof *d);
  const FieldValue *in = field__value(n->field, "InField");
  if (n->ops == &ops_lonlat) {
    d->radius = field__number(n->field, "FromStereo") != 0 ? field__number(n->field, "RadiusStereo") : 0;
  } else {
    d->delta = field__number(n->field, "Delta");
    if (!(d->delta > 0)) d->delta = 1e-4 * s->diagonal;
  }
  if (n->ops == &ops_gradient) {
    d->kind = (int)field__number(n->field, "Kind");
    if (d->kind < 0 || d->kind > 3) {
      diag_error(diag, field__value(n->field, "Kind")->loc, "field %d (Gradient): Kind is 0, 1, 2 or 3, not %d", n->field->id,
                 d->kind);
      return false;
    }
  }
  return size__refer(s, n, (int)in->number, in->loc, diag);
}

// Values of the inner field at all places moved by (dx, dy, dz).
static void moved(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, Vec3 by, double *out)
{
  size_t mark = size__mark(e);
  double *q = size__scratch(e, 3 * count);
  for (size_t i = 0; i < count; i++) {
    q[i] = p->x[i] + by.x;
    q[count + i] = p->y[i] + by.y;
    q[2 * count + i] = p->z[i] + by.z;
  }
  Places at = {q, q + count, q + 2 * count, ++e->serial};
  size__eval(e, n->in[0], w, &at, count, out);
  size__release(e, mark);
}

static Vec3 axis(int i, double d)
{
  return (Vec3){i == 0 ? d : 0, i == 1 ? d : 0, i == 2 ? d : 0};
}

static void eval_mean(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  const Derive *d = n->data;
  double v[BATCH];
  moved(e, n, w, p, count, axis(0, 0), out);
  for (int k = 0; k < 6; k++) {
    moved(e, n, w, p, count, axis(k / 2, k % 2 ? -d->delta : d->delta), v);
    for (size_t i = 0; i < count; i++) out[i] += v[i];
  }
  for (size_t i = 0; i < count; i++) out[i] /= 7;
}

// Central difference along axis k, of places moved by `by`.
static void slope(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, int k, Vec3 by, double step, double *out)
{
  double v[BATCH];
  moved(e, n, w, p, count, vec3_add(by, axis(k, step)), out);
  moved(e, n, w, p, count, vec3_add(by, axis(k, -step)), v);
  for (size_t i = 0; i < count; i++) out[i] = (out[i] - v[i]) / (2 * step);
}

static void eval_gradient(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  const Derive *d = n->data;
  Vec3 here = {0, 0, 0};
  if (d->kind < 3) {
    slope(e, n, w, p, count, d->kind, here, d->delta / 2, out);
    return;
  }
  double g[3][BATCH];
  for (int k = 0; k < 3; k++) slope(e, n, w, p, count, k, here, d->delta / 2, g[k]);
  for (size_t i = 0; i < count; i++) out[i] = sqrt(g[0][i] * g[0][i] + g[1][i] * g[1][i] + g[2][i] * g[2][i]);
}

// Component k of the normalized gradient at places moved by `by`.
static void direction(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, int k, Vec3 by, double step, double *out)
{
  double g[3][BATCH];
  for (int i = 0; i < 3; i++) slope(e, n, w, p, count, i, by, step, g[i]);
  for (size_t i = 0; i < count; i++) {
    double len = sqrt(g[0][i] * g[0][i] + g[1][i] * g[1][i] + g[2][i] * g[2][i]);
    out[i] = len > 0 ? g[k][i] / len : 0;
  }
}

static void eval_curvature(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  const Derive *d = n->data;
  double a[BATCH], b[BATCH];
  for (size_t i = 0; i < count; i++) out[i] = 0;
  for (int k = 0; k < 3; k++) {
    direction(e, n, w, p, count, k, axis(k, d->delta / 2), d->delta / 2, a);
    direction(e, n, w, p, count, k, axis(k, -d->delta / 2), d->delta / 2, b);
    for (size_t i = 0; i < count; i++) out[i] += (a[i] - b[i]) / d->delta;
  }
}

static void eval_laplacian(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  const Derive *d = n->data;
  double v[BATCH];
  moved(e, n, w, p, count, axis(0, 0), out);
  for (size_t i = 0; i < count; i++) out[i] *= -6;
  for (int k = 0; k < 6; k++) {
    moved(e, n, w, p, count, axis(k / 2, k % 2 ? -d->delta : d->delta), v);
    for (size_t i = 0; i < count; i++) out[i] += v[i];
  }
  for (size_t i = 0; i < count; i++) out[i] /= d->delta * d->delta;
}

// Jacobi rotations: 3x3 symmetric, a few sweeps settle it.
double size__largest_eigenvalue(const double m[6], bool absolute)
{
  double a[3][3] = {{m[0], m[1], m[2]}, {m[1], m[3], m[4]}, {m[2], m[4], m[5]}};
  for (int sweep = 0; sweep < 12; sweep++) {
    for (int p = 0; p < 2; p++) {
      for (int q = p + 1; q < 3; q++) {
        if (a[p][q] == 0) continue;
        double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1)), c = 1 / sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; k++) {
          double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y, a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < 3; k++) {
          double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y, a[q][k] = s * x + c * y;
        }
      }
    }
  }
  double best = absolute ? fabs(a[0][0]) : a[0][0];
  for (int i = 1; i < 3; i++) best = fmax(best, absolute ? fabs(a[i][i]) : a[i][i]);
  return best;
}

static void eval_hessian(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  const Derive *d = n->data;
  double h[6][BATCH], v[BATCH], here[BATCH];
  static const int row[6] = {0, 0, 0, 1, 1, 2}, col[6] = {0, 1, 2, 1, 2, 2};
  moved(e, n, w, p, count, axis(0, 0), here);
  for (int k = 0; k < 6; k++) {
    // Diagonal entries: f(+) - 2 f + f(-); others: f(++) - f(+-) - f(-+) + f(--) over 4.
    bool diagonal = row[k] == col[k];
    for (size_t i = 0; i < count; i++) h[k][i] = diagonal ? -2 * here[i] : 0;
    for (int c = 0; c < (diagonal ? 2 : 4); c++) {
      double s = c % 2 ? -d->delta : d->delta, t = c / 2 ? -d->delta : d->delta;
      moved(e, n, w, p, count, diagonal ? axis(row[k], s) : vec3_add(axis(row[k], s), axis(col[k], t)), v);
      double weight = diagonal ? 1 : (s > 0) == (t > 0) ? 0.25 : -0.25;
      for (size_t i = 0; i < count; i++) h[k][i] += weight * v[i];
    }
  }
  double d2 = d->delta * d->delta;
  for (size_t i = 0; i < count; i++)
    out[i] = size__largest_eigenvalue((double[6]){h[0][i] / d2, h[1][i] / d2, h[2][i] / d2, h[3][i] / d2, h[4][i] / d2, h[5][i] / d2},
                                      true);
}

static void eval_lonlat(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  const Derive *d = n->data;
  size_t mark = size__mark(e);
  double *q = size__scratch(e, 3 * count);
  for (size_t i = 0; i < count; i++) {
    double x = p->x[i], y = p->y[i], z = p->z[i];
    if (d->radius > 0) {
      // From the plane of a stereographic projection back to the sphere.
      double r2 = d->radius * d->radius, s = 4 * r2 + x * x + y * y;
      z = d->radius * (4 * r2 - x * x - y * y) / s;
      x = 4 * r2 * x / s, y = 4 * r2 * y / s;
    }
    q[i] = atan2(y, x);
    double r = sqrt(x * x + y * y + z * z);
    q[count + i] = r > 0 ? asin(fmin(fmax(z / r, -1), 1)) : 0;
    q[2 * count + i] = 0;
  }
  Places at = {q, q + count, q + 2 * count, ++e->serial};
  size__eval(e, n->in[0], w, &at, count, out);
  size__release(e, mark);
}

const FieldOps ops_mean = {build_derived, eval_mean, NULL, NULL};
const FieldOps ops_gradient = {build_derived, eval_gradient, NULL, NULL};
const FieldOps ops_curvature = {build_derived, eval_curvature, NULL, NULL};
const FieldOps ops_laplacian = {build_derived, eval_laplacian, NULL, NULL};
const FieldOps ops_hessian = {build_derived, eval_hessian, NULL, NULL};
const FieldOps ops_lonlat = {build_derived, eval_lonlat, NULL, NULL};
