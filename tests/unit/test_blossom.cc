// test_blossom.cc - matching: certificates, brute force on small graphs, LEMON on random and mesh graphs
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <cstdlib>

#include "dual_graphs.h"

#include "unit.h"

namespace {

void expect_certified(const Graph &g, const BlossomResult *r)
{
  BlossomGraph v = g.view();
  uint32_t where = 0;
  BlossomVerdict verdict = blossom_check(&v, r, &where);
  if (verdict != BLOSSOM_OK) fail_msg("n=%u: %s at %u", g.n, blossom_verdict_text(verdict), where);
}

void test_brute_force(void **)
{
  Rng rng = {7};
  for (int k = 0; k < 3000; k++) {
    uint32_t n = 1 + rng_below(&rng, 12), m = rng_below(&rng, 3 * n + 1);
    int32_t range = k % 3 == 0 ? 2 : k % 3 == 1 ? 20 : 100000;
    Graph g = random_graph(&rng, n, m, range);
    BlossomGraph v = g.view();
    BlossomResult *r = blossom_solve(&v);
    expect_certified(g, r);
    uint32_t matched;
    int64_t cost;
    brute(g, &matched, &cost);
    assert_int_equal(r->unmatched, n - matched);
    if (r->unmatched == 0) assert_int_equal(r->cost, cost);
    else assert_non_null(r->barrier);
    blossom_free(r);
  }
}

void expect_lemon(const Graph &g)
{
  BlossomGraph v = g.view();
  BlossomResult *r = blossom_solve(&v);
  expect_certified(g, r);
  assert_int_equal(r->unmatched, 0);
  assert_true(r->cost == lemon_cost(g));
  blossom_free(r);
}

// With few different costs there are many ties and blossoms within blossoms.
void test_random_against_lemon(void **)
{
  Rng rng = {11};
  for (int k = 0; k < 120; k++) {
    uint32_t n = 2 * (5 + rng_below(&rng, k % 10 == 0 ? 500 : 60));
    int32_t range = k % 4 == 0 ? 1 : k % 4 == 1 ? 5 : 10000;
    Graph g = random_graph(&rng, n, n * (1 + rng_below(&rng, 4)), range);
    add_cycle(&g, &rng, range);
    expect_lemon(g);
  }
}

// Where there are no odd cycles, the fractional start is the whole solution: no blossom is left for the search.
void test_bipartite_needs_no_blossom(void **)
{
  Rng rng = {31};
  for (int k = 0; k < 12; k++) {
    uint32_t w = 20 + 2 * (uint32_t)k, range = k % 3 == 0 ? 0 : k % 3 == 1 ? 3 : 10000;
    Graph g;
    g.n = w * w;
    for (uint32_t v = 0; v < g.n; v++) {
      if (v % w + 1 < w) g.add(v, v + 1, (int32_t)rng_below(&rng, range + 1));
      if (v + w < g.n) g.add(v, v + w, (int32_t)rng_below(&rng, range + 1));
    }
    BlossomGraph view = g.view();
    BlossomResult *r = blossom_solve(&view);
    assert_int_equal(r->stats.start_free, 0);
    assert_int_equal(r->nblossom, 0);
    blossom_free(r);
    expect_lemon(g);
  }
}

// Rings of odd length joined in pairs by one dear edge each: every ring is an odd cycle of the start, and a blossom in the end.
void test_odd_rings(void **)
{
  Graph g;
  for (uint32_t k = 0; k < 40; k++) {
    uint32_t len = 3 + 2 * (k / 2 % 5), first = g.n;
    g.n += len;
    for (uint32_t i = 0; i < len; i++) g.add(first + i, first + (i + 1) % len, 1);
    if (k % 2) g.add(first, first - 1, 50);
  }
  BlossomGraph view = g.view();
  BlossomResult *r = blossom_solve(&view);
  assert_int_equal(r->stats.start_free, 40);
  assert_true(r->nblossom > 0);
  blossom_free(r);
  expect_lemon(g);
}

void test_meshes_against_lemon(void **)
{
  for (uint32_t k = 0; k < 24; k++) expect_lemon(mesh_graph(4 + 2 * k, 0.002 * (k % 5), k % 3 == 2 ? 0.5 : 0, k));
}

// The dual of a regular lattice of w x h parallelograms, all costs equal but for a few, and a few edges across: nearly all edges
// are tight, and trees grow over whole regions.
Graph regular_lattice(Rng *rng, uint32_t w, uint32_t h)
{
  Graph g;
  g.n = 2 * w * h;
  uint32_t rare = 2 + rng_below(rng, 60);
  auto join = [&](uint32_t u, uint32_t v) {
    g.add(u, v, rng_below(rng, rare) ? 5 : (int32_t)rng_below(rng, rng_below(rng, 2) ? 12 : 100));
  };
  for (uint32_t k = 0; k < w * h; k++) {
    join(2 * k, 2 * k + 1);
    if (k % w + 1 < w) join(2 * k + 1, 2 * k + 2);
    if (k + w < w * h) join(2 * k + 1, 2 * (k + w));
  }
  for (uint32_t k = rng_below(rng, 8); k > 0; k--) {
    uint32_t u = rng_below(rng, g.n);
    join(u, k % 2 ? rng_below(rng, g.n) : u ^ 1);
  }
  return g;
}

void test_regions(void **)
{
  Rng rng = {37};
  uint64_t regions = 0;
  for (uint32_t k = 0; k < 60; k++) {
    uint32_t w = 20 + rng_below(&rng, 2 + 2 * k), h = 20 + rng_below(&rng, 2 + 2 * k);
    Graph g = regular_lattice(&rng, w, h);
    BlossomGraph view = g.view();
    BlossomResult *r = blossom_solve(&view);
    expect_certified(g, r);
    assert_int_equal(r->unmatched, 0);
    regions += r->stats.region;
    blossom_free(r);
    if (k % 6 == 0) expect_lemon(g);
  }
  assert_true(regions > 1000);
}

// What `make check-blossom` runs: 150 random graphs and 150 duals of meshes, sizes spread evenly on a logarithmic scale up to 50,000.
void test_long(void **)
{
  if (!std::getenv("TEST_BLOSSOM_LONG")) return;
  Rng rng = {23};
  for (int k = 0; k < 150; k++) {
    uint32_t n = 2 * (uint32_t)std::lround(5 * std::pow(5000.0, k / 149.0));
    int32_t range = k % 3 == 0 ? 3 : k % 3 == 1 ? 1000 : 1000000;
    Graph g = random_graph(&rng, n, n * (1 + rng_below(&rng, 3)), range);
    add_cycle(&g, &rng, range);
    expect_lemon(g);
    uint32_t rows = (uint32_t)std::lround(std::sqrt(n / 1.732)) + 2;
    expect_lemon(mesh_graph(rows, k % 5 == 0 ? 0 : std::pow(10.0, -3 + 2.3 * rng_double(&rng)), k % 4 == 3 ? 0.6 : 0, (uint64_t)k));
  }
}

void test_large_mesh_is_certified(void **)
{
  Graph g = mesh_graph(100, 0.001, 0, 3);
  BlossomGraph v = g.view();
  BlossomResult *r = blossom_solve(&v);
  expect_certified(g, r);
  assert_int_equal(r->unmatched, 0);
  BlossomResult *again = blossom_solve(&v);
  assert_memory_equal(r->mate, again->mate, g.n * sizeof *r->mate);
  assert_memory_equal(r->y, again->y, g.n * sizeof *r->y);
  blossom_free(r);
  blossom_free(again);
}

// Odd components hung on few vertices: as many unmatched as the barrier says.
void test_barrier(void **)
{
  Graph star;
  star.n = 9;
  for (uint32_t v = 1; v < 9; v++) star.add(0, v, (int32_t)v);
  Graph triangles; // three triangles at one vertex
  triangles.n = 10;
  for (uint32_t k = 0; k < 3; k++) {
    uint32_t a = 1 + 3 * k;
    triangles.add(a, a + 1, 1), triangles.add(a + 1, a + 2, 1), triangles.add(a, a + 2, 1), triangles.add(0, a, 5);
  }
  const Graph *all[2] = {&star, &triangles};
  const uint32_t unmatched[2] = {7, 2};
  for (int k = 0; k < 2; k++) {
    BlossomGraph v = all[k]->view();
    BlossomResult *r = blossom_solve(&v);
    assert_int_equal(r->unmatched, unmatched[k]);
    expect_certified(*all[k], r);
    blossom_free(r);
  }
}

// The checker notices every kind of lie.
void test_check_refuses(void **)
{
  Graph g = mesh_graph(12, 0.01, 0, 5);
  BlossomGraph v = g.view();
  BlossomResult *r = blossom_solve(&v);
  expect_certified(g, r);
  r->cost++;
  assert_int_equal(blossom_check(&v, r, NULL), BLOSSOM_BAD_MATE);
  r->cost--;
  r->y[3] += r->scale;
  assert_int_not_equal(blossom_check(&v, r, NULL), BLOSSOM_OK);
  r->y[3] -= 2 * r->scale;
  assert_int_equal(blossom_check(&v, r, NULL), BLOSSOM_LOOSE_MATCH);
  r->y[3] += r->scale;
  uint32_t w = r->mate[0];
  r->mate[0] = (w + 1) % g.n;
  assert_int_equal(blossom_check(&v, r, NULL), BLOSSOM_BAD_MATE);
  r->mate[0] = w;
  if (r->nblossom) {
    r->z[0] = -1;
    assert_int_equal(blossom_check(&v, r, NULL), BLOSSOM_NEGATIVE_Z);
  }
  blossom_free(r);
}

void test_empty(void **)
{
  Graph g;
  BlossomGraph v = g.view();
  BlossomResult *r = blossom_solve(&v);
  assert_int_equal(r->unmatched, 0);
  expect_certified(g, r);
  blossom_free(r);
}

} // namespace

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_brute_force),          cmocka_unit_test(test_random_against_lemon),
      cmocka_unit_test(test_meshes_against_lemon), cmocka_unit_test(test_large_mesh_is_certified),
      cmocka_unit_test(test_barrier),              cmocka_unit_test(test_check_refuses),
      cmocka_unit_test(test_bipartite_needs_no_blossom), cmocka_unit_test(test_odd_rings),
      cmocka_unit_test(test_empty),                cmocka_unit_test(test_regions),
      cmocka_unit_test(test_long),
  };
  return unit_run(tests);
}
