// test_quad.c - recombination: no triangle, nothing inverted, indices that add up, what is locked stays
// SPDX-License-Identifier: MIT
#include "unit.h"

#include "base/map.h"
#include "geom/quality_quad.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"
#include "quad_meshes.h"

static void init(QuadMesh *m, uint32_t rows, double jitter, double grade, uint64_t seed)
{
  LatticeMesh lm = lattice_mesh(rows, jitter, grade, seed);
  quad_mesh_init(m, lm.xy.data, NULL, lm.xy.len / 2, lm.tri.data, lm.tri.len / 3, NULL, 0);
  lattice_free(&lm);
}

static void expect_good(const QuadMesh *m)
{
  uint32_t where;
  QuadVerdict v = quad_check(m, &where);
  if (v != QUAD_GOOD) fail_msg("%s (%u)", quad_verdict_text(v), where);
}

static double area(const QuadMesh *m)
{
  double sum = 0;
  for (size_t e = 0; e < quad_mesh_elements(m); e++) {
    uint32_t n = quad_mesh_corners(m, e);
    for (uint32_t i = 0; i < n; i++)
      sum += 0.5 * vec2_cross(m->xy.data[m->vertex.data[4 * e + i]], m->xy.data[m->vertex.data[4 * e + (i + 1) % n]]);
  }
  return sum;
}

static void test_measures(void **state)
{
  (void)state;
  Vec2 a = {0, 0}, b = {1, 0}, c = {1, 1}, d = {0, 1};
  assert_float_equal(quad_eta(a, b, c, d), 1, 1e-15);
  assert_float_equal(quad_scaled_jacobian(a, b, c, d), 1, 1e-15);
  assert_float_equal(quad_eta(a, b, (Vec2){1.5, sqrt(0.75)}, (Vec2){0.5, sqrt(0.75)}), 2.0 / 3, 1e-12);
  assert_true(quad_eta_signed(a, d, c, b) < 0);
  assert_true(quad_scaled_jacobian(a, d, c, b) < 0);
  assert_true(quad_eta_signed((Vec2){0.9, 0.9}, b, c, d) < 0);
}

// Every variant on every kind of mesh: valid, same area, and without triangles except for the greedy one.
static void test_variants(void **state)
{
  (void)state;
  for (int alg = QUAD_GREEDY; alg <= QUAD_SPLIT; alg++)
    for (uint32_t k = 0; k < 6; k++) {
      QuadMesh m;
      QuadReport r;
      init(&m, 8 + 2 * k, 0.08 * (k % 3), k % 2 ? 0.4 : 0, k);
      bool even = quad_mesh_triangles(&m) % 2 == 0;
      QuadParams p = quad_params_default();
      p.algorithm = (QuadAlgorithm)alg;
      quad_recombine(&m, &p, &r);
      expect_good(&m);
      assert_float_equal(area(&m), 1, 1e-12);
      assert_int_equal(r.triangles, quad_mesh_triangles(&m));
      assert_int_equal(r.quads + r.triangles, quad_mesh_elements(&m));
      if (alg == QUAD_BLOSSOM) assert_int_equal(r.triangles, even ? 0 : 1);
      if (alg >= QUAD_FULL_GREEDY) assert_int_equal(r.triangles, 0);
      quad_mesh_free(&m);
    }
}

static double worst_shape(const QuadMesh *m)
{
  double worst = 1;
  for (size_t e = 0; e < quad_mesh_elements(m); e++) worst = fmin(worst, quad__shape(m->xy.data, &m->vertex.data[4 * e]));
  return worst;
}

// Clean-up and smoothing never make the worst element worse.
static void test_worst_never_worse(void **state)
{
  (void)state;
  for (uint32_t k = 0; k < 20; k++) {
    QuadMesh m;
    QuadReport r = {0};
    init(&m, 10 + k, 0.012 * k, k % 2 ? 0.6 : 0, k);
    quad_match_blossom(&m, &r);
    double worst = worst_shape(&m);
    for (int step = 0; step < 4; step++) {
      if (step % 2) quad_smooth(&m, 2);
      else quad_clean(&m, 1, &r);
      double now = worst_shape(&m);
      assert_true(now >= worst - 1e-12);
      worst = now;
    }
    quad_cut_bad(&m, 0);
    expect_good(&m);
    quad_mesh_free(&m);
  }
}

// An embedded line through the square: each of its edges is an edge of the result, its ends where they were.
static void test_locked(void **state)
{
  (void)state;
  LatticeMesh lm = lattice_mesh(16, 0.1, 0, 9);
  U32Vec locked = {0};
  size_t nv = lm.xy.len / 2;
  // Row 8 of the lattice, but for its first and last edge.
  for (uint32_t v = 0; v + 1 < nv; v++) {
    double y = lm.xy.data[2 * v + 1], z = lm.xy.data[2 * v + 3], x = lm.xy.data[2 * v];
    if (fabs(y - 0.5) < 0.02 && fabs(z - 0.5) < 0.02 && x > 0.05 && x < 0.9) {
      vec_push(&locked, v);
      vec_push(&locked, v + 1);
    }
  }
  assert_true(locked.len > 10);
  for (int alg = QUAD_GREEDY; alg <= QUAD_FULL_BLOSSOM; alg++) {
    QuadMesh m;
    QuadParams p = quad_params_default();
    p.algorithm = (QuadAlgorithm)alg;
    quad_mesh_init(&m, lm.xy.data, NULL, nv, lm.tri.data, lm.tri.len / 3, locked.data, locked.len / 2);
    quad_recombine(&m, &p, NULL);
    expect_good(&m);
    Map edge = {0};
    for (size_t s = 0; s < m.vertex.len; s++) {
      size_t e = s / 4, n = quad_mesh_corners(&m, e);
      if (s % 4 < n) map_set(&edge, map_pair(m.vertex.data[s], m.vertex.data[4 * e + (s % 4 + 1) % n]), 1);
    }
    size_t halves = alg >= QUAD_FULL_GREEDY ? 2 : 1;
    assert_int_equal(m.locked.len, halves * locked.len);
    for (size_t k = 0; k < m.locked.len; k += 2)
      assert_int_equal(map_get(&edge, map_pair(m.locked.data[k], m.locked.data[k + 1])), 1);
    for (size_t v = 0; v < m.xy.len; v++) {
      uint32_t from = m.from.data[v];
      if (!m.fixed.data[v] || from == NONE) continue;
      assert_true(m.xy.data[v].x == lm.xy.data[2 * from] && m.xy.data[v].y == lm.xy.data[2 * from + 1]);
    }
    map_free(&edge);
    quad_mesh_free(&m);
  }
  lattice_free(&lm);
  vec_free(&locked);
}

static bool on_circle(void *ctx, uint32_t a, uint32_t b, Vec2 *p)
{
  const QuadMesh *m = ctx;
  Vec2 mid = vec2_add(m->xy.data[a], m->xy.data[b]);
  *p = vec2_scale(1 / vec2_length(mid), mid);
  return true;
}

// New vertices on the boundary are put on the geometry and say whose edge they halve.
static void test_middles_on_the_curve(void **state)
{
  (void)state;
  enum { N = 12 };
  double xy[2 * N + 2] = {0};
  uint32_t tri[3 * N];
  for (uint32_t i = 0; i < N; i++) {
    xy[2 * i] = cos(2 * acos(-1) * i / N), xy[2 * i + 1] = sin(2 * acos(-1) * i / N);
    tri[3 * i] = N, tri[3 * i + 1] = i, tri[3 * i + 2] = (i + 1) % N;
  }
  QuadMesh m, before;
  quad_mesh_init(&m, xy, NULL, N + 1, tri, N, NULL, 0);
  quad_mesh_init(&before, xy, NULL, N + 1, tri, N, NULL, 0);
  QuadParams p = quad_params_default();
  p.algorithm = QUAD_FULL_BLOSSOM;
  p.middle = on_circle;
  p.ctx = &before;
  quad_recombine(&m, &p, NULL);
  expect_good(&m);
  size_t middles = 0;
  for (size_t v = 0; v < m.xy.len; v++) {
    if (m.parent.data[2 * v] == NONE) continue;
    middles++;
    assert_int_equal((m.parent.data[2 * v] + 1) % N == m.parent.data[2 * v + 1] ||
                         (m.parent.data[2 * v + 1] + 1) % N == m.parent.data[2 * v], 1);
    assert_float_equal(vec2_length(m.xy.data[v]), 1, 1e-12);
  }
  assert_int_equal(middles, N);
  quad_mesh_free(&m);
  quad_mesh_free(&before);
}

// A strip of an odd number of triangles keeps exactly one.
static void test_odd(void **state)
{
  (void)state;
  double xy[2 * 9];
  uint32_t tri[3 * 7];
  for (uint32_t i = 0; i < 9; i++) xy[2 * i] = 0.5 * i, xy[2 * i + 1] = i % 2;
  for (uint32_t i = 0; i < 7; i++) tri[3 * i] = i, tri[3 * i + 1] = i % 2 ? i + 2 : i + 1, tri[3 * i + 2] = i % 2 ? i + 1 : i + 2;
  for (uint32_t i = 0; i < 7; i++) {
    uint32_t t = tri[3 * i + 1];
    tri[3 * i + 1] = tri[3 * i + 2], tri[3 * i + 2] = t;
  }
  QuadMesh m;
  QuadReport r;
  QuadParams p = quad_params_default();
  quad_mesh_init(&m, xy, NULL, 9, tri, 7, NULL, 0);
  quad_recombine(&m, &p, &r);
  expect_good(&m);
  assert_int_equal(r.triangles, 1);
  assert_int_equal(r.odd_parts, 1);
  assert_int_equal(r.quads, 3);
  quad_mesh_free(&m);
}

// Four triangles round a vertex on the boundary whose dual graph is a star: no perfect matching, and yet two quads.
static void test_no_perfect_matching(void **state)
{
  (void)state;
  double xy[] = {0, 0, 2, 0, 1, 1.7, 1, -1.2, 2.6, 1.4, -0.6, 1.4};
  uint32_t tri[] = {0, 1, 2, 0, 3, 1, 1, 4, 2, 0, 2, 5};
  QuadMesh m;
  QuadReport r;
  QuadParams p = quad_params_default();
  quad_mesh_init(&m, xy, NULL, 6, tri, 4, NULL, 0);
  quad_recombine(&m, &p, &r);
  expect_good(&m);
  assert_int_equal(r.triangles, 0);
  quad_mesh_free(&m);
}

// The triangles that the greedy method leaves are brought together, all but one of an odd number, and nothing is turned over.
static void test_repair(void **state)
{
  (void)state;
  size_t brought = 0;
  for (uint32_t k = 0; k < 24; k++) {
    QuadMesh m;
    QuadReport r = {0};
    init(&m, 6 + k, 0.01 * k, k % 2 ? 0.5 : 0, 77 + k);
    quad_match_greedy(&m, 45);
    size_t before = quad_mesh_triangles(&m);
    quad_repair(&m, &r);
    expect_good(&m);
    assert_float_equal(area(&m), 1, 1e-12);
    assert_int_equal(quad_mesh_triangles(&m), before % 2);
    assert_int_equal(r.repaired, before / 2);
    brought += r.repaired;
    quad_mesh_free(&m);
  }
  assert_true(brought > 20);
}

// Sizes that ask for edges twice as long on one side: with them edges are nearer to what is wanted than without.
static void test_sizes(void **state)
{
  (void)state;
  double off[2];
  for (int known = 0; known < 2; known++) {
    QuadMesh m;
    QuadParams p = quad_params_default();
    init(&m, 24, 0.1, 0.5, 5);
    double *h = mem_alloc(m.xy.len * sizeof *h), sum = 0;
    for (size_t v = 0; v < m.xy.len; v++) h[v] = 0.03 + 0.03 * m.xy.data[v].x;
    if (known) quad_mesh_set_sizes(&m, h);
    free(h);
    quad_recombine(&m, &p, NULL);
    size_t n = 0;
    for (size_t s = 0; s < m.vertex.len; s++) {
      size_t e = s / 4, k = quad_mesh_corners(&m, e);
      if (s % 4 >= k) continue;
      Vec2 a = m.xy.data[m.vertex.data[s]], b = m.xy.data[m.vertex.data[4 * e + (s % 4 + 1) % k]];
      double x = log(vec2_length(vec2_sub(a, b)) / (0.03 + 0.015 * (a.x + b.x)));
      sum += x * x, n++;
    }
    off[known] = sum / (double)n;
    if (known) assert_float_equal(quad_mesh_size(&m, 0, m.xy.data[0]), 0.03 + 0.03 * m.xy.data[0].x, 1e-9);
    quad_mesh_free(&m);
  }
  assert_true(off[1] < 0.9 * off[0]);
}

// A quad with a straight corner on the boundary is never written: five take its place, or two triangles where they may stay.
static void test_cut(void **state)
{
  (void)state;
  double xy[] = {0, 0, 1, 0, 2, 0, 1, 1};
  uint32_t tri[] = {0, 1, 3, 1, 2, 3};
  for (int greedy = 0; greedy < 2; greedy++) {
    QuadMesh m;
    QuadReport r;
    QuadParams p = quad_params_default();
    quad_mesh_init(&m, xy, NULL, 4, tri, 2, NULL, 0);
    if (greedy) p.algorithm = QUAD_GREEDY;
    quad_recombine(&m, &p, &r);
    expect_good(&m);
    assert_float_equal(area(&m), 1, 1e-12);
    assert_int_equal(r.filled, greedy ? 0 : 1);
    assert_int_equal(r.triangles, greedy ? 2 : 0);
    quad_mesh_free(&m);
  }
}

static void test_check_refuses(void **state)
{
  (void)state;
  QuadMesh m;
  init(&m, 8, 0, 0, 1);
  quad_recombine(&m, &(QuadParams){.algorithm = QUAD_BLOSSOM}, NULL);
  expect_good(&m);
  uint32_t *v = m.vertex.data, old = v[1], where;
  v[1] = v[0];
  assert_int_equal(quad_check(&m, &where), QUAD_BAD_INDEX);
  v[1] = v[3], v[3] = old;
  assert_int_equal(quad_check(&m, &where), QUAD_INVERTED);
  quad_mesh_free(&m);
}

static void test_same_again(void **state)
{
  (void)state;
  QuadMesh a, b;
  init(&a, 24, 0.1, 0.3, 4);
  init(&b, 24, 0.1, 0.3, 4);
  QuadParams p = quad_params_default();
  quad_recombine(&a, &p, NULL);
  quad_recombine(&b, &p, NULL);
  assert_int_equal(a.vertex.len, b.vertex.len);
  assert_memory_equal(a.vertex.data, b.vertex.data, a.vertex.len * sizeof *a.vertex.data);
  assert_memory_equal(a.xy.data, b.xy.data, a.xy.len * sizeof *a.xy.data);
  quad_mesh_free(&a);
  quad_mesh_free(&b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_measures),   cmocka_unit_test(test_variants),
      cmocka_unit_test(test_worst_never_worse), cmocka_unit_test(test_locked),
      cmocka_unit_test(test_middles_on_the_curve), cmocka_unit_test(test_odd),
      cmocka_unit_test(test_no_perfect_matching), cmocka_unit_test(test_check_refuses), cmocka_unit_test(test_cut),
      cmocka_unit_test(test_same_again),  cmocka_unit_test(test_repair), cmocka_unit_test(test_sizes),
  };
  return unit_run(tests);
}
