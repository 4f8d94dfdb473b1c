// test_jacobian.c - Bezier bounds of Jacobians against dense samples
// SPDX-License-Identifier: MIT
#include "unit.h"

#include "base/mem.h"
#include "base/rng.h"
#include "mesh/jacobian.h"

static const ElemType complete[] = {ELEM_TRI3, ELEM_TRI6, ELEM_TRI10, ELEM_TRI15, ELEM_QUAD4, ELEM_QUAD9, ELEM_QUAD16, ELEM_QUAD25};

// Lagrange basis function of node k and its derivatives at (x, y), by its Bezier expansion's inverse: plain polynomial products
// in one variable on quadrangles, Silvester's products on triangles.
static double factor(int p, int i, double t) // product over m < i of (p t - m) / (i - m)
{
  double r = 1;
  for (int m = 0; m < i; m++) r *= (p * t - m) / (i - m);
  return r;
}

static double lagrange(int p, int i, double t)
{
  double r = 1;
  for (int m = 0; m <= p; m++)
    if (m != i) r *= (p * t - m) / (i - m);
  return r;
}

static double shape(const BezierBasis *b, int k, double x, double y)
{
  int p = b->order, i = b->ij[k][0], j = b->ij[k][1];
  if (b->corners == 4) return lagrange(p, i, x) * lagrange(p, j, y);
  return factor(p, i, x) * factor(p, j, y) * factor(p, p - i - j, 1 - x - y);
}

static Vec3 place(const BezierBasis *b, const Vec3 *node, double x, double y)
{
  Vec3 s = {0, 0, 0};
  for (int k = 0; k < b->n; k++) s = vec3_add(s, vec3_scale(shape(b, k, x, y), node[k]));
  return s;
}

// Jacobian along +z by central differences, relative to the straight element's mean.
static double sampled(const BezierBasis *b, const Vec3 *node, double x, double y)
{
  double h = 1e-5;
  Vec3 du = vec3_scale(0.5 / h, vec3_sub(place(b, node, x + h, y), place(b, node, x - h, y)));
  Vec3 dv = vec3_scale(0.5 / h, vec3_sub(place(b, node, x, y + h), place(b, node, x, y - h)));
  double mean = vec3_length(corners_normal(node, b->corners)) * (b->corners == 4 ? 0.5 : 1);
  return vec3_cross(du, dv).z / mean;
}

static double sampled_minimum(const BezierBasis *b, const Vec3 *node)
{
  enum { N = 24 };
  double min = INFINITY;
  for (int i = 0; i <= N; i++)
    for (int j = 0; j <= (b->corners == 3 ? N - i : N); j++)
      min = fmin(min, sampled(b, node, i / (double)N, j / (double)N));
  return min;
}

static void random_nodes(const BezierBasis *b, Rng *r, double noise, Vec3 *node)
{
  for (int k = 0; k < b->n; k++) {
    double x = b->ij[k][0] / (double)b->order, y = b->ij[k][1] / (double)b->order;
    node[k] = (Vec3){3 + 2 * x + 0.5 * y + noise * (rng_double(r) - 0.5), 1.5 * y + noise * (rng_double(r) - 0.5), 0};
  }
}

static void bounds_hold_the_minimum(void **state)
{
  (void)state;
  Rng r = {11};
  int folded = 0, good = 0;
  for (size_t t = 0; t < ARRAY_LEN(complete); t++) {
    BezierBasis b;
    bezier_basis_init(&b, complete[t]);
    for (int trial = 0; trial < 60; trial++) {
      Vec3 node[ELEM_MAX_NODES];
      double lo, hi;
      random_nodes(&b, &r, 0.9 * rng_double(&r) / b.order, node);
      double seen = sampled_minimum(&b, node);
      jacobian_bounds(&b, node, (Vec3){0, 0, 1}, 0.001, &lo, &hi);
      assert_true(lo <= seen + 1e-7);
      assert_true(lo <= hi + 1e-12);
      if (hi > 0) assert_true(seen - lo < 0.05);
      bool positive = jacobian_positive(&b, node, (Vec3){0, 0, 1});
      if (positive) assert_true(seen > -1e-7);
      if (seen > 0.02) assert_true(positive);
      if (seen < -1e-6) assert_false(positive);
      folded += seen < 0;
      good += seen > 0;
    }
  }
  assert_true(folded > 20 && good > 200);
}

static void affine_elements_have_jacobian_one(void **state)
{
  (void)state;
  for (size_t t = 0; t < ARRAY_LEN(complete); t++) {
    BezierBasis b;
    Rng r = {1};
    Vec3 node[ELEM_MAX_NODES];
    double lo, hi;
    bezier_basis_init(&b, complete[t]);
    random_nodes(&b, &r, 0, node);
    jacobian_bounds(&b, node, (Vec3){0, 0, 2}, 0.001, &lo, &hi);
    assert_true(fabs(lo - 1) < 1e-12 && fabs(hi - 1) < 1e-12);
    jacobian_bounds(&b, node, (Vec3){0, 0, -1}, 0.001, &lo, &hi);
    assert_true(fabs(hi + 1) < 1e-12);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bounds_hold_the_minimum),
      cmocka_unit_test(affine_elements_have_jacobian_one),
  };
  return unit_run(tests);
}
