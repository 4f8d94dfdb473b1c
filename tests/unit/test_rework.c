// test_rework.c - rework of the worst triangles, polishing of small faces: nothing gets worse, the boundary stays
// SPDX-License-Identifier: MIT
#include "unit.h"

#include "base/mem.h"
#include "base/rng.h"
#include "tri/refine_int.h"

#include <string.h>

enum { SIDES = 40, INSIDE = 300 };

// A polygon about the origin whose corners lie between radius 0.7 and 1, and `inside` random points within 0.6. The corners come first.
static void make_polygon(Tri *m, Rng *rng, size_t inside)
{
  DoubleVec xy = {0};
  U32Vec ends = {0};
  for (uint32_t i = 0; i < SIDES; i++) {
    double radius = 0.7 + 0.3 * rng_double(rng), angle = 2 * M_PI * i / SIDES;
    vec_push(&xy, radius * cos(angle)), vec_push(&xy, radius * sin(angle));
    vec_push(&ends, i), vec_push(&ends, (i + 1) % SIDES);
  }
  while (xy.len < 2 * (SIDES + inside)) {
    double x = 1.2 * rng_double(rng) - 0.6, y = 1.2 * rng_double(rng) - 0.6;
    if (hypot(x, y) < 0.6) vec_push(&xy, x), vec_push(&xy, y);
  }
  tri_init(m);
  TriBuild how = {.reorder = false};
  assert_int_equal(tri_build(m, xy.data, xy.len / 2, &how), TRI_BUILD_GOOD);
  assert_int_equal(tri_insert_segments(m, ends.data, NULL, SIDES, NULL), 0);
  tri_carve(m, &(TriCarve){.even_odd = true});
  vec_free(&xy), vec_free(&ends);
}

static double worst_of(const Tri *m)
{
  double worst = 1;
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    worst = fmin(worst, metric_quality(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2])));
  }
  return worst;
}

static void check_mesh(Tri *m, const double *corners)
{
  TriCheck c;
  assert_int_equal(tri_check(m, TRI_CHECK_LINKS | TRI_CHECK_ORIENT | TRI_CHECK_EULER | TRI_CHECK_AREA, &c), 0);
  assert_memory_equal(m->xy, corners, 2 * SIDES * sizeof *corners);
  for (uint32_t i = 0; i < SIDES; i++) {
    EdgeId e = tri_find_edge(m, i, (i + 1) % SIDES);
    assert_true(e != NONE && tri_is_segment(m, e) && m->seg[e] == i);
  }
}

static void assert_same(const Tri *a, const Tri *b)
{
  assert_true(a->nt == b->nt && a->nv == b->nv);
  assert_memory_equal(a->xy, b->xy, 2 * a->nv * sizeof *a->xy);
  assert_memory_equal(a->vert, b->vert, 3 * a->nt * sizeof *a->vert);
}

static void rework(Tri *m, double least, TriRefineStats *stats)
{
  TriRefineParams p = tri_refine_defaults();
  Refiner r = {.m = m, .p = &p, .stats = stats, .max_vertices = TRI_MAX_VERTICES};
  refine__initial_sizes(&r);
  refine__prepare(&r, SIDES);
  refine__rework(&r, least, 400, 4);
  refine__drop_isolated(&r, SIDES);
  refine__release(&r);
}

static void place_circumcentres(Tri *m)
{
  TriRefineParams p = tri_refine_defaults();
  p.algorithm = REFINE_DELAUNAY, p.optimize = p.smoothing = 0;
  tri_refine(m, &p);
}

static void test_rework_makes_nothing_worse(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 8; seed++) {
    Rng rng = {seed};
    Tri m, again;
    make_polygon(&m, &rng, seed % 2 ? INSIDE : 0); // random points: most triangles are bad; or circumcentres: most are fair
    if (seed % 2 == 0) place_circumcentres(&m);
    tri_copy(&again, &m);
    double corners[2 * SIDES], before = worst_of(&m);
    memcpy(corners, m.xy, sizeof corners);
    TriRefineStats stats = {.outcome = REFINE_DONE}, same = stats;
    rework(&m, 0.95, &stats);
    check_mesh(&m, corners);
    assert_true(worst_of(&m) >= before);
    assert_true(stats.moves > 0);
    rework(&again, 0.95, &same);
    assert_same(&m, &again);
    tri_free(&m), tri_free(&again);
  }
}

// A mesh that leaves nothing to be reworked is left alone.
static void test_rework_of_good_triangles_changes_nothing(void **state)
{
  (void)state;
  Rng rng = {3};
  Tri m, before;
  make_polygon(&m, &rng, INSIDE);
  tri_copy(&before, &m);
  TriRefineParams p = tri_refine_defaults();
  TriRefineStats stats = {.outcome = REFINE_DONE};
  Refiner r = {.m = &m, .p = &p, .stats = &stats, .max_vertices = TRI_MAX_VERTICES};
  refine__initial_sizes(&r);
  refine__prepare(&r, SIDES);
  refine__rework(&r, 0.9 * worst_of(&m), 400, 4);
  assert_same(&m, &before);
  refine__release(&r);
  tri_free(&m), tri_free(&before);
}

static double even_size(void *ctx, Vec2 p)
{
  (void)p;
  return *(double *)ctx;
}

// From about ten triangles to a thousand: those made several times, and those made once.
static void test_small_faces_get_no_worse_triangle(void **state)
{
  (void)state;
  const RefineAlgorithm algorithms[] = {REFINE_ADAPT, REFINE_DELAUNAY, REFINE_FRONTAL};
  for (int k = 0; k < 18; k++) {
    Rng rng = {(uint64_t)k + 1};
    Tri empty, plain, mesh, again;
    make_polygon(&empty, &rng, 0);
    double corners[2 * SIDES], h[] = {0.5, 0.2, 0.08};
    memcpy(corners, empty.xy, sizeof corners);
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = algorithms[k % 3], p.size = even_size, p.size_ctx = &h[k / 3 % 3], p.extend_from_boundary = k < 9;
    tri_copy(&mesh, &empty), tri_copy(&again, &empty), tri_copy(&plain, &empty);
    tri_refine(&mesh, &p), tri_refine(&again, &p);
    p.optimize = p.smoothing = 0;
    tri_refine(&plain, &p);
    check_mesh(&mesh, corners);
    assert_same(&mesh, &again);
    assert_true(worst_of(&mesh) >= worst_of(&plain) * (1 - 1e-12));
    tri_free(&empty), tri_free(&plain), tri_free(&mesh), tri_free(&again);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_rework_makes_nothing_worse),
      cmocka_unit_test(test_rework_of_good_triangles_changes_nothing),
      cmocka_unit_test(test_small_faces_get_no_worse_triangle),
  };
  return unit_run(tests);
}
