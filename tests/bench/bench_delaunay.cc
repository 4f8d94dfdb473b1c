// bench_delaunay.cc - our Delaunay triangulation and CGAL's, side by side
// SPDX-License-Identifier: MIT
//   bench_delaunay [n [rounds [set]]]   the point sets at n points (default 1000000): median processor time of each
#include "base/base.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern "C" {
#include "base/mem.h"
#include "base/stats.h"
#include "point_sets.h"
#include "tri/tri.h"
}

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Delaunay_triangulation_2<Kernel> Delaunay;

struct Sample {
  double cpu, wall, bytes; // bytes a point at the peak, input included
  double steps, cavity, slow;
  size_t triangles;
  uint64_t hash;
};

static double peak_bytes()
{
  struct rusage u;
  getrusage(RUSAGE_SELF, &u);
  return 1024.0 * (double)u.ru_maxrss;
}

static Sample run_ours(int set, size_t n, int threads)
{
  Sample s = {};
  double before = peak_bytes();
  double *xy = (double *)mem_alloc(2 * n * sizeof *xy);
  point_set_fill(set, n, xy);
  Tri m;
  TriBuild how = {};
  how.reorder = how.take = true;
  how.threads = threads;
  double c = time_cpu(), w = time_wall();
  if (tri_build(&m, xy, n, &how) != TRI_BUILD_GOOD) exit(1);
  s.cpu = time_cpu() - c;
  s.wall = time_wall() - w;
  s.bytes = (peak_bytes() - before) / (double)n;
  for (TriId t = 0; t < m.nt; t++) s.triangles += !tri_is_ghost(&m, t);
  s.hash = 14695981039346656037u;
  for (size_t i = 0; i < 3 * (size_t)m.nt; i++) s.hash = (s.hash ^ m.vert[i]) * 1099511628211u;
  s.steps = m.walks ? (double)m.walk_steps / (double)m.walks : 0;
  s.slow = (double)(m.count.incircle_slow + m.count.orient_slow);
  return s;
}

static Sample run_cgal(int set, size_t n)
{
  Sample s = {};
  double before = peak_bytes();
  std::vector<double> xy(2 * n);
  point_set_fill(set, n, xy.data());
  std::vector<Kernel::Point_2> p;
  p.reserve(n);
  for (size_t i = 0; i < n; i++) p.emplace_back(xy[2 * i], xy[2 * i + 1]);
  std::vector<double>().swap(xy);
  double c = time_cpu(), w = time_wall();
  Delaunay d;
  d.insert(p.begin(), p.end());
  s.cpu = time_cpu() - c;
  s.wall = time_wall() - w;
  s.bytes = (peak_bytes() - before) / (double)n;
  s.triangles = d.number_of_faces();
  return s;
}

// In a process of its own, so that the peak is this run's.
template <class F> static Sample isolated(F run)
{
  int fd[2];
  if (pipe(fd)) exit(1);
  pid_t pid = fork();
  if (pid == 0) {
    Sample s = run();
    _exit(write(fd[1], &s, sizeof s) != (ssize_t)sizeof s);
  }
  Sample s;
  if (read(fd[0], &s, sizeof s) != (ssize_t)sizeof s) exit(1);
  close(fd[0]);
  close(fd[1]);
  int status;
  waitpid(pid, &status, 0);
  return s;
}

static Sample median(std::vector<Sample> v, bool wall = false)
{
  std::sort(v.begin(), v.end(), [=](const Sample &a, const Sample &b) { return wall ? a.wall < b.wall : a.cpu < b.cpu; });
  return v[v.size() / 2];
}

int main(int argc, char **argv)
{
  size_t n = argc > 1 ? (size_t)strtod(argv[1], nullptr) : 1000000;
  int rounds = argc > 2 ? (int)strtol(argv[2], nullptr, 10) : 5;
  int only = argc > 3 ? (int)strtol(argv[3], nullptr, 10) : -1;
  printf("%-20s %9s %9s %6s %8s %8s %7s %10s %8s %7s\n", "set", "ours s", "CGAL s", "ratio", "ours B/p", "CGAL B/p", "steps",
         "slow/point", "2 thr s", "speedup");
  for (int set = 0; set < POINT_SETS; set++) {
    if (only >= 0 && set != only) continue;
    std::vector<Sample> a, b, c;
    for (int i = 0; i < rounds; i++) {
      a.push_back(isolated([=] { return run_ours(set, n, 1); }));
      if (set != 5 || i == 0) b.push_back(isolated([=] { return run_cgal(set, n); })); // CGAL takes a minute for the line
      c.push_back(isolated([=] { return run_ours(set, n, 2); }));
    }
    Sample x = median(a), y = median(b), z = median(c, true), w = median(a, true);
    printf("%-20s %9.3f %9.3f %6.2f %8.1f %8.1f %7.2f %10.4f %8.3f %7.2f%s%s\n", point_set_names[set], x.cpu, y.cpu,
           x.cpu / y.cpu, x.bytes, y.bytes, x.steps, x.slow / (double)n, z.wall, w.wall / z.wall,
           x.triangles == y.triangles ? "" : "  COUNTS DIFFER", x.hash == z.hash ? "" : "  THREADS DIFFER");
    fflush(stdout);
  }
  return 0;
}
