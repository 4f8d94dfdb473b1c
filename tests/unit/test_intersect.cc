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
#include "geom/intersect_int.h"
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

// The same pairs by slabs alone.
void compare_slabs(const Soup &s, const SegPairVec *want)
{
  std::vector<Seg> seg;
  for (uint32_t i = 0; i < s.end.size() / 2; i++) {
    uint32_t a = s.end[2 * i], b = s.end[2 * i + 1];
    if (at(s, a) == at(s, b)) continue;
    if (lex_compare(&s.xy[2 * a], &s.xy[2 * b]) > 0) std::swap(a, b);
    seg.push_back({{s.xy[2 * a], s.xy[2 * a + 1], s.xy[2 * b], s.xy[2 * b + 1]}, {a, b}, i});
  }
  SegPairVec got = {0, 0, 0};
  assert_true(intersect__by_slabs(seg.data(), seg.size(), 1000000, &got));
  assert_int_equal(got.len, want->len);
  for (size_t k = 0; k < want->len; k++) {
    assert_int_equal(got.data[k].a, want->data[k].a);
    assert_int_equal(got.data[k].b, want->data[k].b);
    assert_int_equal(got.data[k].how, want->data[k].how);
  }
  vec_free(&got);
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
  compare_slabs(s, &got);
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

// Long segments side by side, close to each other and in any direction, with some across.
void long_and_parallel(void **)
{
  Rng rng = {5};
  for (int round = 0; round < 12; round++) {
    Soup s;
    double a = round * 0.37, dx = cos(a), dy = sin(a);
    for (int i = 0; i < 300; i++) {
      double off = i * 1e-5, from = round % 2 ? 0.1 * rng_double(&rng) : 0, to = 1 - (round % 3 ? 0.1 * rng_double(&rng) : 0);
      add(s, from * dx - off * dy, from * dy + off * dx, to * dx - off * dy, to * dy + off * dx);
    }
    for (int i = 0; i < 5; i++) add(s, 0.2 * i * dx, 0.2 * i * dy, 0.2 * i * dx - 2e-3 * dy, 0.2 * i * dy + 2e-3 * dx);
    compare(s);
  }
}

// Fans of one vertex, and copies of the same segment.
void stars_and_copies(void **)
{
  Rng rng = {6};
  for (int round = 0; round < 20; round++) {
    Soup s;
    s.xy.insert(s.xy.end(), {0.5, 0.5});
    for (uint32_t i = 1; i <= 60; i++) {
      s.xy.insert(s.xy.end(), {(double)rng_below(&rng, 9) / 8, (double)rng_below(&rng, 9) / 8});
      s.end.insert(s.end.end(), {0, i});
    }
    for (int i = 0; i < 20; i++) add(s, 0, 0.25, 1, 0.75 + 0.25 * (i % 2));
    compare(s);
  }
}

// What the trial by octagons would take 10^9 steps for.
void long_and_many(void **)
{
  enum { N = 30000 };
  Soup s;
  for (int i = 0; i < N; i++) add(s, 0, 1e-6 * i, 1, 0.3 + 1e-6 * i);
  add(s, 0.5, 0, 0.5, 1);
  SegPairVec got = {0, 0, 0};
  assert_true(segments_intersect(s.xy.data(), s.end.data(), N + 1, 1000000, &got));
  assert_int_equal(got.len, N);
  vec_free(&got);
}

void heights_are_exact(void **)
{
  Rng rng = {7};
  for (int i = 0; i < 2000; i++) {
    double p[8], u, v;
    double unit = i % 3 ? 1 : 1e-3; // small integers, or not
    for (double &c : p) c = unit * rng_below(&rng, 20);
    p[2] = p[0] + unit * (1 + rng_below(&rng, 9)), p[6] = p[4] + unit * (1 + rng_below(&rng, 9));
    u = std::fmax(p[0], p[4]), v = std::fmin(p[2], p[6]);
    if (u > v) continue;
    int sign = segments_order_at(p, p + 2, p + 4, p + 6, u, v);
    assert_int_equal(sign, segments_order_at_mp(p, p + 2, p + 4, p + 6, u, v));
    assert_int_equal(-sign, segments_order_at(p + 4, p + 6, p, p + 2, u, v));
    if (i % 3 == 0) continue;
    double x = (u + v) / 2, w0 = p[2] - p[0], w1 = p[6] - p[4]; // in integers
    double d = (p[1] * w0 + (p[3] - p[1]) * (x - p[0])) * w1 - (p[5] * w1 + (p[7] - p[5]) * (x - p[4])) * w0;
    assert_int_equal(sign, (d > 0) - (d < 0));
  }
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
    cmocka_unit_test(long_and_parallel),
    cmocka_unit_test(stars_and_copies),
    cmocka_unit_test(long_and_many),
    cmocka_unit_test(heights_are_exact),
    cmocka_unit_test(many_pairs_are_cut_off),
  };
  return unit_run(tests);
}
