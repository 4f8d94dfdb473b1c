// dual_graphs.h - graphs for tests and benches of the matching solver: random ones, duals of meshes; LEMON and brute force
// SPDX-License-Identifier: MIT
#ifndef DUAL_GRAPHS_H
#define DUAL_GRAPHS_H

#include "base/base.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <lemon/matching.h>
#include <lemon/smart_graph.h>

extern "C" {
#include "base/rng.h"
#include "quad/blossom.h"
#include "quad/quad_dual.h"
#include "quad/quad_mesh.h"
#include "quad_meshes.h"
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
  BlossomGraph view() const { return {n, (uint32_t)cost.size(), edge.data(), cost.data()}; }
};

inline Graph random_graph(Rng *r, uint32_t n, uint32_t m, int32_t range)
{
  Graph g;
  g.n = n;
  for (uint32_t i = 0; i < m; i++)
    g.add(rng_below(r, n), rng_below(r, n), (int32_t)rng_below(r, 2 * (uint32_t)range + 1) - range);
  return g;
}

// A cycle through all vertices makes a perfect matching certain when n is even.
inline void add_cycle(Graph *g, Rng *r, int32_t range)
{
  for (uint32_t v = 0; v < g->n; v++) g->add(v, (v + 1) % g->n, (int32_t)rng_below(r, (uint32_t)range + 1));
}

// Largest cardinality and, for it, least cost, over sets of vertices.
inline void brute(const Graph &g, uint32_t *matched, int64_t *cost)
{
  const int64_t no = INT64_MAX;
  std::vector<int64_t> best((size_t)1 << g.n, no);
  best[0] = 0;
  *matched = 0, *cost = 0;
  for (size_t set = 0; set < best.size(); set++) {
    if (best[set] == no) continue;
    uint32_t k = (uint32_t)__builtin_popcountll(set);
    if (k > *matched || (k == *matched && best[set] < *cost)) *matched = k, *cost = best[set];
    for (size_t e = 0; e < g.cost.size(); e++) {
      size_t bits = ((size_t)1 << g.edge[2 * e]) | ((size_t)1 << g.edge[2 * e + 1]);
      if (g.edge[2 * e] == g.edge[2 * e + 1] || (set & bits)) continue;
      best[set | bits] = std::min(best[set | bits], best[set] + g.cost[e]);
    }
  }
}

// The dual graph of a mesh of triangles as recombination makes it; a vertex more if their number is odd.
inline Graph dual_graph(const QuadMesh *m)
{
  uint32_t *twin = quad_mesh_twins(m);
  QuadDual d;
  quad_dual_init(&d, m, twin);
  Graph g;
  g.n = d.n;
  g.edge.assign(d.edge.data, d.edge.data + d.edge.len);
  g.cost.assign(d.cost.data, d.cost.data + d.cost.len);
  quad_dual_free(&d);
  free(twin);
  return g;
}

// The same of a lattice of triangles.
inline Graph mesh_graph(uint32_t rows, double jitter, double grade, uint64_t seed)
{
  LatticeMesh lm = lattice_mesh(rows, jitter, grade, seed);
  QuadMesh m;
  quad_mesh_init(&m, lm.xy.data, NULL, lm.xy.len / 2, lm.tri.data, lm.tri.len / 3, NULL, 0);
  Graph g = dual_graph(&m);
  quad_mesh_free(&m);
  lattice_free(&lm);
  return g;
}

// Least cost of a perfect matching by LEMON; INT64_MIN if there is none. *seconds (may be NULL): what `clock` says of the search.
inline int64_t lemon_cost(const Graph &g, double (*clock)() = nullptr, double *seconds = nullptr)
{
  lemon::SmartGraph lg;
  std::vector<lemon::SmartGraph::Node> node;
  for (uint32_t i = 0; i < g.n; i++) node.push_back(lg.addNode());
  lemon::SmartGraph::EdgeMap<int64_t> weight(lg);
  for (size_t e = 0; e < g.cost.size(); e++)
    if (g.edge[2 * e] != g.edge[2 * e + 1])
      weight[lg.addEdge(node[g.edge[2 * e]], node[g.edge[2 * e + 1]])] = -(int64_t)g.cost[e];
  lemon::MaxWeightedPerfectMatching<lemon::SmartGraph, lemon::SmartGraph::EdgeMap<int64_t>> solver(lg, weight);
  double t = clock ? clock() : 0;
  bool perfect = solver.run();
  if (seconds) *seconds = clock() - t;
  return perfect ? -solver.matchingWeight() : INT64_MIN;
}

#endif
