// test_intersect.cc - pairs of meeting segments against exact constructions of CGAL, segment by segment
// SPDX-License-Identifier: MIT
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <set>
#include <vector>

#include "unit.h"

extern "C" {
#include "base/rng.h"
#include "geom/intersect.h"
}

typedef CGAL::Exact_predicates_inexact_constructions_kernel K;

namespace {

struct Soup {
  std::vector<double> xy;
  std::vector<uint32_t> end;
};

void add(Soup &s, double ax, double ay, double bx, double by)
{
  uint32_t v = (uint32_t)(s.xy.size() / 2);
  s.xy.insert(s.xy.end(), {ax, ay, bx, by});
  s.end.insert(s.end.end(), {v, v + 1});
}

K::Point_2 at(const Soup &s, uint32_t v)
{
  return K::Point_2(s.xy[2 * v], s.xy[2 * v + 1]);
}

// By CGAL: segments with a common point, unless that is one point and an end of both.
bool meet(const Soup &s, uint32_t i, uint32_t j)
{
  K::Point_2 a = at(s, s.end[2 * i]), b = at(s, s.end[2 * i + 1]), c = at(s, s.end[2 * j]), d = at(s, s.end[2 * j + 1]);
  if (a == b || c == d || !CGAL::do_intersect(K::Segment_2(a, b), K::Segment_2(c, d))) return false;
  K::Point_2 shared, p, q;
  if (a == c) shared = a, p = b, q = d;
  else if (a == d) shared = a, p = b, q = c;
  else if (b == c) shared = b, p = a, q = d;
  else if (b == d) shared = b, p = a, q = c;
  else return true;
  // A second common point only if they lie on one line and run the same way from the shared end.
  return CGAL::collinear(shared, p, q) && !CGAL::collinear_are_strictly_ordered_along_line(p, shared, q);
}

void compare(const Soup &s)
{
  uint32_t n = (uint32_t)(s.end.size() / 2);
  std::vector<std::pair<uint32_t, uint32_t>> want;
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = i + 1; j < n; j++)
      if (meet(s, i, j)) want.push_back({i, j});
  SegPairVec got = {0, 0, 0};
  assert_true(segments_intersect(s.xy.data(), s.end.data(), n, 1000000, &got));
  assert_int_equal(got.len, want.size());
  for (size_t k = 0; k < want.size(); k++) {
    assert_int_equal(got.data[k].a, want[k].first);
    assert_int_equal(got.data[k].b, want[k].second);
  }
  vec_free(&got);
}

void random_segments(void **)
{
  Rng rng = {1};
  for (int round = 0; round < 20; round++) {
    Soup s;
    double len = round % 2 ? 0.1 : 1;
    for (int i = 0; i < 300; i++) {
      double x = rng_double(&rng), y = rng_double(&rng);
      add(s, x, y, x + len * (rng_double(&rng) - 0.5), y + len * (rng_double(&rng) - 0.5));
    }
    compare(s);
  }
}

// On a small grid everything that is degenerate happens often.
void segments_on_a_grid(void **)
{
  Rng rng = {2};
  for (int round = 0; round < 60; round++) {
    Soup s;
    uint32_t size = 3 + (uint32_t)round % 8;
    for (int i = 0; i < 60; i++)
      add(s, rng_below(&rng, size), rng_below(&rng, size), rng_below(&rng, size), rng_below(&rng, size));
    compare(s);
  }
}

// A closed chain shares vertices; walking on a grid it crosses and overlaps itself.
void chains_with_common_vertices(void **)
{
  Rng rng = {3};
  for (int round = 0; round < 60; round++) {
    Soup s;
    uint32_t n = 40, size = round % 2 ? 6 : 1000;
    for (uint32_t i = 0; i < n; i++) {
      s.xy.push_back(rng_below(&rng, size));
      s.xy.push_back(rng_below(&rng, size));
      s.end.push_back(i);
      s.end.push_back((i + 1) % n);
    }
    compare(s);
  }
}

void nearly_touching(void **)
{
  Rng rng = {4};
  Soup s;
  for (int i = 0; i < 200; i++) {
    // A segment, and one that ends within an ulp of it.
    double x = rng_double(&rng), y = rng_double(&rng), dx = rng_double(&rng) - 0.5, dy = rng_double(&rng) - 0.5;
    double t = rng_double(&rng), px = x + t * dx, py = std::nextafter(y + t * dy, rng_below(&rng, 2) ? 10. : -10.);
    add(s, x, y, x + dx, y + dy);
    add(s, px, py, px + dy, py - dx);
  }
  compare(s);
}

void many_pairs_are_cut_off(void **)
{
  Soup s;
  for (int i = 0; i < 100; i++) {
    add(s, 0, i, 100, i);
    add(s, i, 0, i, 100);
  }
  SegPairVec got = {0, 0, 0};
  assert_false(segments_intersect(s.xy.data(), s.end.data(), 200, 50, &got));
  assert_int_equal(got.len, 50);
  vec_free(&got);
  assert_true(segments_intersect(s.xy.data(), s.end.data(), 1, 50, &got));
  assert_true(segments_intersect(nullptr, nullptr, 0, 50, &got));
}

} // namespace

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(random_segments),
    cmocka_unit_test(segments_on_a_grid),
    cmocka_unit_test(chains_with_common_vertices),
    cmocka_unit_test(nearly_touching),
    cmocka_unit_test(many_pairs_are_cut_off),
  };
  return unit_run(tests);
}
