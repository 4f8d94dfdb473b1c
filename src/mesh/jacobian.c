// jacobian.c - certified bounds of the Jacobian of curved elements
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/jacobian.h"

#include <string.h>

// Bezier coefficients on a triangle of degree d: c[i][j] belongs to the bivariate Bernstein polynomial of indices (i, j, d-i-j);
// on a quadrangle of degree d in each direction: to B_i(x) B_j(y).
enum { MAX_DEGREE = 7, DEPTH = 14 };
typedef struct {
  double c[MAX_DEGREE + 1][MAX_DEGREE + 1];
} Coefs;

static double binomial(int n, int k)
{
  double r = 1;
  for (int i = 1; i <= k; i++) r = r * (n - k + i) / i;
  return r;
}

static double power(double x, int n)
{
  double r = 1;
  while (n-- > 0) r *= x;
  return r;
}

static double bernstein(int n, int i, double x) { return binomial(n, i) * power(x, i) * power(1 - x, n - i); }

static double bernstein_at(int corners, int p, const uint8_t basis[2], const uint8_t place[2])
{
  double x = place[0] / (double)p, y = place[1] / (double)p;
  if (corners == 4) return bernstein(p, basis[0], x) * bernstein(p, basis[1], y);
  int i = basis[0], j = basis[1];
  return binomial(p, i) * binomial(p - i, j) * power(x, i) * power(y, j) * power(1 - x - y, p - i - j);
}

// Inverse of an n x n matrix by Gauss-Jordan with row pivoting; the matrices are small and well conditioned.
static void invert(int n, double a[ELEM_MAX_NODES][ELEM_MAX_NODES], double inv[ELEM_MAX_NODES][ELEM_MAX_NODES])
{
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) inv[i][j] = i == j;
  for (int k = 0; k < n; k++) {
    int pivot = k;
    for (int i = k + 1; i < n; i++)
      if (fabs(a[i][k]) > fabs(a[pivot][k])) pivot = i;
    for (int j = 0; j < n; j++) {
      double s = a[k][j], r = inv[k][j];
      a[k][j] = a[pivot][j];
      a[pivot][j] = s;
      inv[k][j] = inv[pivot][j];
      inv[pivot][j] = r;
    }
    double f = 1 / a[k][k];
    for (int j = 0; j < n; j++) {
      a[k][j] *= f;
      inv[k][j] *= f;
    }
    for (int i = 0; i < n; i++) {
      double g = a[i][k];
      if (i == k || g == 0) continue;
      for (int j = 0; j < n; j++) {
        a[i][j] -= g * a[k][j];
        inv[i][j] -= g * inv[k][j];
      }
    }
  }
}

void bezier_basis_init(BezierBasis *b, ElemType complete)
{
  *b = (BezierBasis){.type = complete, .corners = elem_corners(complete), .order = elem_order(complete)};
  b->n = elem_lattice(complete, b->ij);
  double a[ELEM_MAX_NODES][ELEM_MAX_NODES];
  for (int place = 0; place < b->n; place++)
    for (int basis = 0; basis < b->n; basis++)
      a[place][basis] = bernstein_at(b->corners, b->order, b->ij[basis], b->ij[place]);
  invert(b->n, a, b->to_bezier);
}

typedef Vec3 Control[5][5];

static void control_points(const BezierBasis *b, const Vec3 *node, Control c)
{
  for (int a = 0; a < b->n; a++) {
    Vec3 s = {0, 0, 0};
    for (int k = 0; k < b->n; k++) s = vec3_add(s, vec3_scale(b->to_bezier[a][k], vec3_sub(node[k], node[0])));
    c[b->ij[a][0]][b->ij[a][1]] = s;
  }
}

static double triple(Vec3 a, Vec3 b, Vec3 n) { return vec3_dot(vec3_cross(a, b), n); }

// Products of the derivatives' Bernstein polynomials; degree 2(p-1) on triangles.
static int triangle_coefs(int p, Control x, Vec3 n, Coefs *out)
{
  int m = p - 1, d = 2 * m;
  for (int i1 = 0; i1 <= m; i1++)
    for (int j1 = 0; i1 + j1 <= m; j1++)
      for (int i2 = 0; i2 <= m; i2++)
        for (int j2 = 0; i2 + j2 <= m; j2++) {
          Vec3 du = vec3_sub(x[i1 + 1][j1], x[i1][j1]), dv = vec3_sub(x[i2][j2 + 1], x[i2][j2]);
          int i = i1 + i2, j = j1 + j2;
          double w = binomial(m, i1) * binomial(m - i1, j1) * binomial(m, i2) * binomial(m - i2, j2) /
                     (binomial(d, i) * binomial(d - i, j));
          out->c[i][j] += (double)(p * p) * w * triple(du, dv, n);
        }
  return d;
}

// Degree 2p-1 in each direction on quadrangles.
static int quad_coefs(int p, Control x, Vec3 n, Coefs *out)
{
  int d = 2 * p - 1;
  for (int i1 = 0; i1 < p; i1++)
    for (int j1 = 0; j1 <= p; j1++)
      for (int i2 = 0; i2 <= p; i2++)
        for (int j2 = 0; j2 < p; j2++) {
          Vec3 du = vec3_sub(x[i1 + 1][j1], x[i1][j1]), dv = vec3_sub(x[i2][j2 + 1], x[i2][j2]);
          int i = i1 + i2, j = j1 + j2;
          double w = binomial(p - 1, i1) * binomial(p, i2) * binomial(p, j1) * binomial(p - 1, j2) /
                     (binomial(d, i) * binomial(d, j));
          out->c[i][j] += (double)(p * p) * w * triple(du, dv, n);
        }
  return d;
}

// The two halves of a row of n+1 coefficients.
static void halve_row(int n, const double *c, double *left, double *right)
{
  double w[MAX_DEGREE + 1];
  memcpy(w, c, sizeof *c * (size_t)(n + 1));
  for (int k = 0; k <= n; k++) {
    left[k] = w[0];
    right[n - k] = w[n - k];
    for (int i = 0; i < n - k; i++) w[i] = 0.5 * (w[i] + w[i + 1]);
  }
}

static void halve_quad(int d, bool along_x, const Coefs *c, Coefs *a, Coefs *b)
{
  for (int k = 0; k <= d; k++) {
    double row[MAX_DEGREE + 1], l[MAX_DEGREE + 1], r[MAX_DEGREE + 1];
    for (int i = 0; i <= d; i++) row[i] = along_x ? c->c[i][k] : c->c[k][i];
    halve_row(d, row, l, r);
    for (int i = 0; i <= d; i++) {
      *(along_x ? &a->c[i][k] : &a->c[k][i]) = l[i];
      *(along_x ? &b->c[i][k] : &b->c[k][i]) = r[i];
    }
  }
}

// Cut a triangle from its corner (0,0) to the middle of the opposite side: the halves keep that corner, each turned so that
// repeated cuts go round all sides.
static void halve_triangle(int d, const Coefs *c, Coefs *a, Coefs *b)
{
  for (int k = 0; k <= d; k++) { // row i + j = k, from (k, 0) to (0, k); k steps from the corner
    double row[MAX_DEGREE + 1], l[MAX_DEGREE + 1], r[MAX_DEGREE + 1];
    for (int j = 0; j <= k; j++) row[j] = c->c[k - j][j];
    halve_row(k, row, l, r);
    // Half a has the corners M, P00, P10, half b M, P01, P00.
    for (int j = 0; j <= k; j++) {
      a->c[d - k][k - j] = l[j]; // M is counted j times, P10 k-j, P00 d-k
      b->c[j][d - k] = r[j];     // M k-j, P01 j, P00 d-k
    }
  }
}

typedef struct {
  int corners, d;
  bool sign_only;
  double gap, scale, lo, hi;
} Search;

static bool corner_of(const Search *s, int i, int j)
{
  if (s->corners == 4) return (i == 0 || i == s->d) && (j == 0 || j == s->d);
  return (i == 0 && j == 0) || i == s->d || j == s->d;
}

static void search(Search *s, const Coefs *c, int depth)
{
  double lo = INFINITY, hi = INFINITY;
  for (int i = 0; i <= s->d; i++)
    for (int j = 0; j <= (s->corners == 3 ? s->d - i : s->d); j++) {
      lo = fmin(lo, c->c[i][j]);
      if (corner_of(s, i, j)) hi = fmin(hi, c->c[i][j]);
    }
  lo /= s->scale;
  hi /= s->scale;
  s->hi = fmin(s->hi, hi);
  if (lo >= s->lo) return; // cannot matter
  if (depth == DEPTH || s->hi <= 0 || (s->sign_only ? lo > 0 : s->hi - lo <= s->gap)) {
    s->lo = lo;
    return;
  }
  Coefs a = {0}, b = {0};
  if (s->corners == 4)
    halve_quad(s->d, depth % 2 == 0, c, &a, &b);
  else
    halve_triangle(s->d, c, &a, &b);
  search(s, &a, depth + 1);
  search(s, &b, depth + 1);
}

Vec3 corners_normal(const Vec3 *corner, int corners)
{
  if (corners == 3) return vec3_cross(vec3_sub(corner[1], corner[0]), vec3_sub(corner[2], corner[0]));
  return vec3_cross(vec3_sub(corner[2], corner[0]), vec3_sub(corner[3], corner[1]));
}

static void bounds(const BezierBasis *b, const Vec3 *node, Vec3 normal, bool sign_only, double gap, double *lo, double *hi)
{
  Control x;
  Coefs c = {0};
  control_points(b, node, x);
  double length = vec3_length(normal), area = vec3_length(corners_normal(node, b->corners));
  if (!(length > 0) || !(area > 0)) {
    *lo = *hi = 0;
    return;
  }
  normal = vec3_scale(1 / length, normal);
  Search s = {.corners = b->corners, .sign_only = sign_only, .gap = gap, .lo = INFINITY, .hi = INFINITY};
  s.d = b->corners == 3 ? triangle_coefs(b->order, x, normal, &c) : quad_coefs(b->order, x, normal, &c);
  s.scale = b->corners == 3 ? area : 0.5 * area;
  search(&s, &c, 0);
  *lo = s.lo;
  *hi = s.hi;
}

void jacobian_bounds(const BezierBasis *b, const Vec3 *node, Vec3 normal, double gap, double *lo, double *hi)
{
  bounds(b, node, normal, false, gap, lo, hi);
}

bool jacobian_positive(const BezierBasis *b, const Vec3 *node, Vec3 normal)
{
  double lo, hi;
  bounds(b, node, normal, true, 0, &lo, &hi);
  return lo > 0;
}
