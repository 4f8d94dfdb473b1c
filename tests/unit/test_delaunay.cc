// test_delaunay.cc - edges equal CGAL's, for points and for constraints
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <set>
#include <vector>

#include "unit.h" // after CGAL: its macros would get in the way

extern "C" {
#include "base/rng.h"
#include "tri/tri.h"
}

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Delaunay_triangulation_2<Kernel> Delaunay;
typedef CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::Exact_predicates_tag> Constrained;
typedef std::pair<std::pair<double, double>, std::pair<double, double>> Edge;

static Edge make_edge(double ax, double ay, double bx, double by)
{
  auto a = std::make_pair(ax, ay), b = std::make_pair(bx, by);
  return a < b ? Edge(a, b) : Edge(b, a);
}

static std::vector<Edge> our_edges(const Tri *m, bool segments)
{
  std::vector<Edge> v;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    if (m->twin[e] < e || tri_org(m, e) == TRI_INF || tri_dest(m, e) == TRI_INF || (segments && !tri_is_segment(m, e))) continue;
    const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
    v.push_back(make_edge(a[0], a[1], b[0], b[1]));
  }
  std::sort(v.begin(), v.end());
  return v;
}

template <class T> static std::vector<Edge> cgal_edges(const T &t)
{
  std::vector<Edge> v;
  for (auto e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
    auto s = t.segment(*e);
    v.push_back(make_edge(s.source().x(), s.source().y(), s.target().x(), s.target().y()));
  }
  std::sort(v.begin(), v.end());
  return v;
}

static void edges_of_random_points(void **)
{
  Rng r = {9};
  for (size_t n : {3, 10, 100, 1000, 30000}) {
    std::vector<double> xy;
    std::vector<Kernel::Point_2> p;
    for (size_t i = 0; i < n; i++) {
      double x = rng_double(&r), y = n == 1000 ? 1e-3 * rng_double(&r) : rng_double(&r);
      xy.push_back(x), xy.push_back(y);
      p.emplace_back(x, y);
    }
    Tri m;
    TriBuild how = {};
    how.reorder = true;
    assert_int_equal(tri_build(&m, xy.data(), n, &how), TRI_BUILD_GOOD);
    Delaunay d(p.begin(), p.end());
    assert_true(our_edges(&m, false) == cgal_edges(d));
    tri_free(&m);
  }
}

// Chains of short segments that do not cross: a random polygon, star-shaped, in a cloud of points.
static void edges_of_constraints(void **)
{
  Rng r = {10};
  for (int round = 0; round < 5; round++) {
    size_t n = 300, cloud = 2000;
    std::vector<double> xy;
    std::vector<uint32_t> ends;
    for (size_t i = 0; i < n; i++) {
      double a = 6.283185307179586 * (double)i / (double)n, d = 0.2 + 0.8 * rng_double(&r);
      xy.push_back(d * cos(a)), xy.push_back(d * sin(a));
      ends.push_back((uint32_t)i), ends.push_back((uint32_t)((i + 1) % n));
    }
    for (size_t i = 0; i < cloud; i++) xy.push_back(2 * rng_double(&r) - 1), xy.push_back(2 * rng_double(&r) - 1);
    Tri m;
    TriBuild how = {};
    assert_int_equal(tri_build(&m, xy.data(), n + cloud, &how), TRI_BUILD_GOOD);
    assert_int_equal(tri_insert_segments(&m, ends.data(), NULL, n, NULL), 0);
    assert_int_equal(tri_check(&m, TRI_CHECK_ALL, NULL), 0);
    Constrained c;
    std::vector<Constrained::Vertex_handle> v;
    for (size_t i = 0; i < n + cloud; i++) v.push_back(c.insert(Kernel::Point_2(xy[2 * i], xy[2 * i + 1])));
    for (size_t i = 0; i < n; i++) c.insert_constraint(v[ends[2 * i]], v[ends[2 * i + 1]]);
    assert_true(our_edges(&m, false) == cgal_edges(c));
    std::vector<Edge> want;
    for (size_t i = 0; i < n; i++)
      want.push_back(make_edge(xy[2 * ends[2 * i]], xy[2 * ends[2 * i] + 1], xy[2 * ends[2 * i + 1]], xy[2 * ends[2 * i + 1] + 1]));
    std::sort(want.begin(), want.end());
    assert_true(our_edges(&m, true) == want);
    tri_free(&m);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(edges_of_random_points), cmocka_unit_test(edges_of_constraints)};
  return unit_run(tests);
}
