// bench_constrained.cc - our constrained Delaunay triangulation and CGAL's of the points and segments of a .poly file
// SPDX-License-Identifier: MIT
//   bench_constrained file.poly [rounds]   median processor time of each (points numbered from 0, no attributes)
#include "base/base.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <fstream>
#include <vector>

extern "C" {
#include "base/mem.h"
#include "base/stats.h"
#include "tri/tri.h"
}

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>,
                                             CGAL::Constrained_triangulation_face_base_2<Kernel>> Storage;
typedef CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage, CGAL::Exact_predicates_tag> Constrained;

struct Graph {
  std::vector<double> xy;
  std::vector<uint32_t> ends;
};

static bool read(const char *path, Graph *g)
{
  std::ifstream f(path);
  size_t n, m, id;
  int dim, attributes, marks;
  if (!(f >> n >> dim >> attributes >> marks)) return false;
  g->xy.resize(2 * n);
  for (size_t i = 0; i < n; i++) f >> id >> g->xy[2 * i] >> g->xy[2 * i + 1];
  f >> m >> marks;
  g->ends.resize(2 * m);
  for (size_t i = 0; i < m; i++) f >> id >> g->ends[2 * i] >> g->ends[2 * i + 1];
  return !f.fail();
}

struct Sample {
  double cpu, points;
  size_t triangles, crossings;
};

static Sample run_ours(const Graph &g)
{
  size_t n = g.xy.size() / 2, m = g.ends.size() / 2;
  double *xy = (double *)mem_alloc(2 * n * sizeof *xy);
  memcpy(xy, g.xy.data(), 2 * n * sizeof *xy);
  Tri t;
  TriBuild how = {};
  how.reorder = how.take = true;
  how.threads = 1;
  Sample s = {};
  double c = time_cpu();
  std::vector<uint32_t> vertex(n), ends(2 * m);
  how.vertex_of = vertex.data();
  if (tri_build(&t, xy, n, &how) != TRI_BUILD_GOOD) exit(1);
  s.points = time_cpu() - c;
  for (size_t i = 0; i < 2 * m; i++) ends[i] = vertex[g.ends[i]];
  s.crossings = tri_insert_segments(&t, ends.data(), NULL, m, NULL);
  s.cpu = time_cpu() - c;
  for (TriId i = 0; i < t.nt; i++) s.triangles += !tri_is_free(&t, i) && !tri_is_ghost(&t, i);
  tri_free(&t);
  return s;
}

// All points first, along a Hilbert curve, then the constraints between their vertices: CGAL's own quick way
// (Constrained_triangulation_2's insert_constraints of index pairs).
static Sample run_cgal(const Graph &g)
{
  size_t n = g.xy.size() / 2, m = g.ends.size() / 2;
  std::vector<Kernel::Point_2> p;
  std::vector<std::pair<size_t, size_t>> e;
  for (size_t i = 0; i < n; i++) p.emplace_back(g.xy[2 * i], g.xy[2 * i + 1]);
  for (size_t i = 0; i < m; i++) e.emplace_back(g.ends[2 * i], g.ends[2 * i + 1]);
  Sample s = {};
  double c = time_cpu();
  Constrained t;
  t.insert_constraints(p.begin(), p.end(), e.begin(), e.end());
  s.cpu = time_cpu() - c;
  s.triangles = t.number_of_faces();
  return s;
}

static bool quicker(const Sample &a, const Sample &b) { return a.cpu < b.cpu; }

int main(int argc, char **argv)
{
  Graph g;
  if (argc < 2 || !read(argv[1], &g)) {
    fprintf(stderr, "bench_constrained: cannot read the points and segments\n");
    return 1;
  }
  int rounds = argc > 2 ? (int)strtol(argv[2], nullptr, 10) : 5;
  std::vector<Sample> a, b;
  std::vector<double> ratio;
  for (int i = 0; i < rounds; i++) {
    a.push_back(run_ours(g));
    b.push_back(run_cgal(g));
    ratio.push_back(a.back().cpu / b.back().cpu);
  }
  std::sort(a.begin(), a.end(), quicker);
  std::sort(b.begin(), b.end(), quicker);
  std::sort(ratio.begin(), ratio.end());
  const Sample &x = a[a.size() / 2], &y = b[b.size() / 2];
  printf("%zu points, %zu segments: ours %.3f s (%.3f s for the points; %zu triangles, %zu crossings), "
         "CGAL %.3f s (%zu triangles), median of ratios %.2f\n",
         g.xy.size() / 2, g.ends.size() / 2, x.cpu, x.points, x.triangles, x.crossings, y.cpu, y.triangles,
         ratio[ratio.size() / 2]);
  return 0;
}
