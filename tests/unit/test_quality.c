// test_quality.c - shape measures against closed forms, the size integral against primitives
// SPDX-License-Identifier: MIT
#include "unit.h"

#include "base/rng.h"
#include "geom/quality.h"

static bool near(double a, double b, double tol) { return fabs(a - b) <= tol; }

static void test_equilateral_is_one(void **state)
{
  (void)state;
  for (int k = -20; k <= 20; k += 10) {
    double s = ldexp(1, k);
    TriShape t = shape_plane((Vec2){0, 0}, (Vec2){s, 0}, (Vec2){0.5 * s, 0.5 * sqrt(3) * s});
    assert_true(near(quality_kappa1(t), 1, 1e-14) && near(quality_kappa2(t), 1, 1e-14));
    assert_true(near(quality_kappa3(t), 1, 1e-14) && near(quality_kappa4(t), 1, 1e-14));
    assert_true(near(quality_kappa5(t), 1, 1e-14));
  }
}

static void test_flat_and_inverted(void **state)
{
  (void)state;
  TriShape flat = shape_plane((Vec2){0, 0}, (Vec2){1, 0}, (Vec2){3, 0});
  assert_true(quality_kappa1(flat) == 0 && quality_kappa2(flat) == 0 && quality_kappa3(flat) == 0);
  assert_true(quality_kappa4(flat) == 0 && quality_kappa5(flat) == 0);
  TriShape point = shape_plane((Vec2){1, 1}, (Vec2){1, 1}, (Vec2){1, 1});
  assert_true(quality_kappa1(point) == 0 && quality_kappa3(point) == 0 && quality_kappa5(point) == 0);
  TriShape inverted = shape_plane((Vec2){0, 0}, (Vec2){0, 1}, (Vec2){1, 0});
  assert_true(quality_kappa1(inverted) < 0 && quality_kappa2(inverted) < 0 && quality_kappa3(inverted) < 0);
  assert_true(quality_kappa4(inverted) < 0 && quality_kappa5(inverted) < 0);
}

static void test_measures_agree_with_angles(void **state)
{
  (void)state;
  Rng rng = {1};
  for (int i = 0; i < 10000; i++) {
    Vec2 p[3];
    for (int j = 0; j < 3; j++) p[j] = (Vec2){rng_double(&rng), rng_double(&rng)};
    TriShape t = shape_plane(p[0], p[1], p[2]);
    if (fabs(t.area) < 1e-4) continue;
    double angle[3], s[3], least;
    quality_angles(t, angle);
    assert_true(near(angle[0] + angle[1] + angle[2], 180, 1e-9));
    for (int j = 0; j < 3; j++) s[j] = sin(angle[j] / 57.295779513082321);
    least = fmin(angle[0], fmin(angle[1], angle[2])) / 57.295779513082321;
    double sign = t.area < 0 ? -1 : 1;
    assert_true(near(quality_gamma(t), sign * 4 * s[0] * s[1] * s[2] / (s[0] + s[1] + s[2]), 1e-9));
    assert_true(near(quality_kappa4(t) * quality_kappa4(t), fabs(quality_kappa3(t)), 1e-12));
    assert_true(near(quality_kappa1(t), sign * 2 / sqrt(3) * sin(least), 1e-9));
    TriShape u = shape_space((Vec3){p[0].x, p[0].y, 2}, (Vec3){p[1].x, p[1].y, 2}, (Vec3){p[2].x, p[2].y, 2},
                             (Vec3){0, 0, 1});
    assert_true(near(quality_gamma(u), quality_gamma(t), 1e-9));
  }
}

static void test_caps_are_worse_than_needles_for_kappa5(void **state)
{
  (void)state;
  TriShape needle = shape_plane((Vec2){0, 0}, (Vec2){0.01, 0}, (Vec2){0.005, 1});
  TriShape cap = shape_plane((Vec2){0, 0}, (Vec2){1, 0}, (Vec2){0.5, 0.01});
  assert_true(quality_kappa5(cap) < quality_kappa5(needle));
}

static void test_maximum_principle(void **state)
{
  (void)state;
  Vec2 p = {0, 0}, q = {1, 0};
  assert_false(quality_breaks_maximum_principle(p, q, (Vec2){0.5, 0.5}, (Vec2){0.5, -0.5})); // 90 + 90
  assert_true(quality_breaks_maximum_principle(p, q, (Vec2){0.5, 0.49}, (Vec2){0.5, -0.5}));
  assert_false(quality_breaks_maximum_principle(p, q, (Vec2){0.5, 0.3}, (Vec2){0.5, -3}));
}

static double linear_size(void *ctx, Vec2 p) { return *(double *)ctx * (1 + p.x); }
static double step_size(void *ctx, Vec2 p) { return *(double *)ctx * (p.x < 0.3 ? 1 : 10); }

static void test_edge_length(void **state)
{
  (void)state;
  double c = 0.25;
  double len = quality_edge_length((Vec2){0, 1}, (Vec2){3, 1}, linear_size, &c);
  assert_true(near(len, log(4) / c, 1e-6 * len));
  len = quality_edge_length((Vec2){0, 0}, (Vec2){1, 0}, step_size, &c);
  assert_true(near(len, (0.3 + 0.07) / c, 1e-3));
  assert_true(quality_tau_term(1) == 0 && near(quality_tau_term(0.5), quality_tau_term(2), 1e-15));
}

static void test_measure_of_a_hexagonal_patch(void **state)
{
  (void)state;
  double xy[14] = {0, 0};
  uint32_t tri[18];
  for (uint32_t i = 0; i < 6; i++) {
    xy[2 * (i + 1)] = cos(i * M_PI / 3), xy[2 * (i + 1) + 1] = sin(i * M_PI / 3);
    tri[3 * i] = 0, tri[3 * i + 1] = i + 1, tri[3 * i + 2] = (i + 1) % 6 + 1;
  }
  MeshQuality q = quality_measure(xy, 7, tri, 6, NULL, NULL);
  assert_true(q.ntri == 6 && q.nedge == 12 && q.nvert == 7);
  assert_true(near(q.gamma_min, 1, 1e-12) && near(q.angle_max, 60, 1e-9) && near(q.area, 1.5 * sqrt(3), 1e-12));
  assert_true(q.valence6 == 1 && q.nmaximum == 0 && q.ninverted == 0);
  xy[0] = 0.95;
  q = quality_measure(xy, 7, tri, 6, NULL, NULL);
  assert_true(q.gamma_min < 0.2 && (q.worst == 0 || q.worst == 5));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_equilateral_is_one),
      cmocka_unit_test(test_flat_and_inverted),
      cmocka_unit_test(test_measures_agree_with_angles),
      cmocka_unit_test(test_caps_are_worse_than_needles_for_kappa5),
      cmocka_unit_test(test_maximum_principle),
      cmocka_unit_test(test_edge_length),
      cmocka_unit_test(test_measure_of_a_hexagonal_patch),
  };
  return unit_run(tests);
}
