// bench_quads.cc - time of the matching solver against LEMON's, on dual graphs of nearly uniform triangle lattices
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <lemon/matching.h>
#include <lemon/smart_graph.h>

extern "C" {
#include "geom/quality_quad.h"
#include "quad/blossom.h"
#include "quad/quad_mesh.h"
}
#include "../unit/quad_meshes.h"
#include <ctime>

static double cpu()
{
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

struct Graph {
  uint32_t n = 0;
  std::vector<uint32_t> edge;
  std::vector<int32_t> cost;
  void add(uint32_t u, uint32_t v, int32_t c)
  {
    edge.push_back(u);
    edge.push_back(v);
    cost.push_back(c);
  }
};

// Costs 10000 (1 - eta), and extra edges along the boundary, as for recombination.
static Graph mesh_graph(uint32_t rows, double jitter, uint64_t seed)
{
  LatticeMesh lm = lattice_mesh(rows, jitter, 0, seed);
  QuadMesh m;
  quad_mesh_init(&m, lm.xy.data, NULL, lm.xy.len / 2, lm.tri.data, lm.tri.len / 3, NULL, 0);
  uint32_t *twin = quad_mesh_twins(&m), last = NONE;
  const uint32_t *v = m.vertex.data;
  const Vec2 *p = m.xy.data;
  Graph g;
  g.n = (uint32_t)quad_mesh_elements(&m);
  for (uint32_t s = 0; s < m.vertex.len; s++) {
    uint32_t t = twin[s], e = s / 4, f = t / 4;
    if (s % 4 == 3) continue;
    if (t == NONE) {
      if (last != NONE && last != e) g.add(last, e, 1000000);
      last = e;
    } else if (t > s) {
      double eta = quad_eta(p[v[s]], p[v[4 * f + (t % 4 + 2) % 3]], p[v[4 * e + (s % 4 + 1) % 3]],
                            p[v[4 * e + (s % 4 + 2) % 3]]);
      g.add(e, f, (int32_t)std::lround(10000 * (1 - eta)));
    }
  }
  free(twin);
  quad_mesh_free(&m);
  lattice_free(&lm);
  if (g.n % 2) g.add(0, g.n++, 0);
  return g;
}

static double lemon_time(const Graph &g, int64_t *cost)
{
  lemon::SmartGraph lg;
  std::vector<lemon::SmartGraph::Node> node;
  for (uint32_t i = 0; i < g.n; i++) node.push_back(lg.addNode());
  lemon::SmartGraph::EdgeMap<int> weight(lg);
  for (size_t e = 0; e < g.cost.size(); e++) weight[lg.addEdge(node[g.edge[2 * e]], node[g.edge[2 * e + 1]])] = -g.cost[e];
  double t = cpu();
  lemon::MaxWeightedPerfectMatching<lemon::SmartGraph> solver(lg, weight);
  solver.run();
  t = cpu() - t;
  *cost = 0;
  for (size_t e = 0; e < g.cost.size(); e++) *cost += solver.matching(lg.edgeFromId((int)e)) ? g.cost[e] : 0;
  return t;
}

// Arguments: largest number of triangles, and up to which LEMON is run.
int main(int argc, char **argv)
{
  double most = argc > 1 ? std::strtod(argv[1], NULL) : 3e5, lemon_most = argc > 2 ? std::strtod(argv[2], NULL) : 3.5e4;
  std::printf("%10s %8s %10s %10s %10s %8s %8s\n", "triangles", "jitter", "solve s", "check s", "LEMON s", "ratio", "swept/n");
  for (double jitter : {0.01, 0.2})
    for (double n = 1000; n <= most; n *= std::sqrt(10.0)) {
      Graph g = mesh_graph((uint32_t)std::lround(std::sqrt(n / 1.732)), jitter, 1);
      BlossomGraph view = {g.n, (uint32_t)g.cost.size(), g.edge.data(), g.cost.data()};
      double t = cpu();
      BlossomResult *r = blossom_solve(&view);
      double solved = cpu() - t;
      if (blossom_check(&view, r, NULL) != BLOSSOM_OK || r->unmatched) return 1;
      double checked = cpu() - t - solved;
      std::printf("%10u %8g %10.4f %10.4f", g.n, jitter, solved, checked);
      int64_t cost = r->cost;
      double lemon = g.n <= lemon_most ? lemon_time(g, &cost) : 0;
      if (lemon > 0) std::printf(" %10.4f %8.1f", lemon, lemon / solved);
      else std::printf(" %10s %8s", "-", "-");
      std::printf(" %8.1f%s\n", (double)r->stats.swept / g.n, cost == r->cost ? "" : "  COSTS DIFFER");
      std::fflush(stdout);
      blossom_free(r);
    }
  return 0;
}
