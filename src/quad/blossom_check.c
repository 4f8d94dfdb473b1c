// blossom_check.c - the certificate of a matching: feasible duals, complementary slackness, equal objectives
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "base/mem.h"
#include "quad/blossom.h"

// The forest of vertices (0 .. n-1) and blossoms (n ..). `sum` is the z of a blossom and of all that hold it; `head` the
// top of the heavy path through a node [Sleator1983], by which ancestors are found in O(log n) steps.
typedef struct {
  uint32_t n, total;
  const uint32_t *parent; // as in BlossomResult
  int64_t *sum;
  uint32_t *size, *depth, *head, *heavy;
} Family;

static uint32_t up(const Family *f, uint32_t x) { return f->parent[x] == NONE ? NONE : f->n + f->parent[x]; }

static BlossomVerdict family_build(Family *f, const BlossomResult *r, uint32_t *where)
{
  for (uint32_t i = 0; i < f->total; i++) {
    uint32_t p = f->parent[i];
    *where = i;
    if (p != NONE && (p >= r->nblossom || (i >= f->n && p >= i - f->n))) return BLOSSOM_BAD_FAMILY;
    f->size[i] = i < f->n;
    f->heavy[i] = NONE;
  }
  // What a blossom holds comes after it, vertices last of all in this order: vertices, then blossoms downwards.
  for (uint32_t i = 0; i < f->n; i++)
    if (up(f, i) != NONE) f->size[up(f, i)] += 1;
  for (uint32_t i = f->total; i-- > f->n;) {
    *where = i - f->n;
    if (f->size[i] % 2 == 0) return BLOSSOM_BAD_FAMILY;
    if (r->z[i - f->n] < 0) return BLOSSOM_NEGATIVE_Z;
    if (up(f, i) != NONE) f->size[up(f, i)] += f->size[i];
  }
  for (uint32_t i = 0; i < f->total; i++) {
    uint32_t p = up(f, i);
    if (p != NONE && (f->heavy[p] == NONE || f->size[i] > f->size[f->heavy[p]])) f->heavy[p] = i;
  }
  for (uint32_t k = 0; k < f->total; k++) {
    uint32_t i = k < r->nblossom ? f->n + k : k - r->nblossom, p = up(f, i);
    f->depth[i] = p == NONE ? 0 : f->depth[p] + 1;
    f->sum[i] = (p == NONE ? 0 : f->sum[p]) + (i >= f->n ? r->z[i - f->n] : 0);
    f->head[i] = p != NONE && f->heavy[p] == i ? f->head[p] : i;
  }
  return BLOSSOM_OK;
}

// Smallest blossom that holds both u and v, or NONE.
static uint32_t common(const Family *f, uint32_t u, uint32_t v)
{
  while (f->head[u] != f->head[v]) {
    if (f->depth[f->head[u]] < f->depth[f->head[v]]) {
      uint32_t t = u;
      u = v;
      v = t;
    }
    u = up(f, f->head[u]);
    if (u == NONE) return NONE;
  }
  return f->depth[u] < f->depth[v] ? u : v;
}

static BlossomVerdict check_matching(const BlossomGraph *g, const BlossomResult *r, uint32_t *where)
{
  uint32_t unmatched = 0;
  int64_t cost = 0;
  for (uint32_t v = 0; v < g->n; v++) {
    uint32_t w = r->mate[v], e = r->mate_edge[v];
    *where = v;
    if (w == NONE && e == NONE) {
      unmatched++;
      continue;
    }
    if (w >= g->n || e >= g->m || w == v || r->mate[w] != v || r->mate_edge[w] != e) return BLOSSOM_BAD_MATE;
    uint32_t a = g->edge[2 * (size_t)e], b = g->edge[2 * (size_t)e + 1];
    if (!((a == v && b == w) || (a == w && b == v))) return BLOSSOM_BAD_MATE;
    if (v < w) cost += g->cost[e];
  }
  return unmatched == r->unmatched && cost == r->cost ? BLOSSOM_OK : BLOSSOM_BAD_MATE;
}

static BlossomVerdict check_edges(const BlossomGraph *g, const BlossomResult *r, const Family *f, uint32_t *where)
{
  for (uint32_t e = 0; e < g->m; e++) {
    uint32_t u = g->edge[2 * (size_t)e], v = g->edge[2 * (size_t)e + 1];
    if (u == v) continue;
    uint32_t c = common(f, u, v);
    int64_t both = c == NONE ? 0 : 2 * f->sum[c];
    int64_t slack = r->scale * (int64_t)g->cost[e] - r->y[u] - r->y[v] - f->sum[u] - f->sum[v] + both;
    *where = e;
    if (slack < 0) return BLOSSOM_NEGATIVE_SLACK;
    if (r->mate_edge[u] == e && slack != 0) return BLOSSOM_LOOSE_MATCH;
  }
  return BLOSSOM_OK;
}

// How many matched edges leave each blossom: vertices inside minus twice the matched edges inside (those whose common
// blossom is inside it).
static BlossomVerdict check_blossoms(const BlossomResult *r, const Family *f, uint32_t *where)
{
  BlossomVerdict verdict = BLOSSOM_OK;
  uint32_t *inside = mem_zalloc(((size_t)f->total + 1) * sizeof *inside);
  for (uint32_t v = 0; v < f->n; v++) {
    uint32_t c = r->mate[v] == NONE || r->mate[v] < v ? NONE : common(f, v, r->mate[v]);
    if (c != NONE) inside[c]++;
  }
  for (uint32_t i = f->total; i-- > f->n;) {
    if (f->size[i] != 2 * inside[i] + 1) {
      *where = i - f->n;
      verdict = BLOSSOM_LOOSE_BLOSSOM;
    }
    if (up(f, i) != NONE) inside[up(f, i)] += inside[i];
  }
  free(inside);
  return verdict;
}

static BlossomVerdict check_optimum(const BlossomGraph *g, const BlossomResult *r, const Family *f, uint32_t *where)
{
  BlossomVerdict verdict = check_edges(g, r, f, where);
  if (verdict == BLOSSOM_OK) verdict = check_blossoms(r, f, where);
  if (verdict != BLOSSOM_OK) return verdict;
  int64_t dual = 0;
  for (uint32_t v = 0; v < g->n; v++) dual += r->y[v];
  for (uint32_t i = 0; i < r->nblossom; i++) dual += r->z[i];
  return dual == r->scale * r->cost ? BLOSSOM_OK : BLOSSOM_GAP;
}

static uint32_t find(uint32_t *set, uint32_t x)
{
  while (set[x] != x) x = set[x] = set[set[x]];
  return x;
}

// Count the odd components left when the barrier is removed.
static BlossomVerdict check_barrier(const BlossomGraph *g, const BlossomResult *r)
{
  uint32_t *set = mem_alloc(((size_t)g->n + 1) * sizeof *set);
  uint8_t *odd = mem_zalloc((size_t)g->n + 1);
  uint64_t removed = 0, components = 0;
  for (uint32_t v = 0; v < g->n; v++) set[v] = v;
  for (size_t e = 0; e < g->m; e++) {
    uint32_t u = g->edge[2 * e], v = g->edge[2 * e + 1];
    if (!r->barrier[u] && !r->barrier[v]) set[find(set, u)] = find(set, v);
  }
  for (uint32_t v = 0; v < g->n; v++) {
    removed += r->barrier[v];
    if (!r->barrier[v]) odd[find(set, v)] ^= 1;
  }
  for (uint32_t v = 0; v < g->n; v++) components += odd[v];
  free(set);
  free(odd);
  return components == removed + r->unmatched ? BLOSSOM_OK : BLOSSOM_BAD_BARRIER;
}

BlossomVerdict blossom_check(const BlossomGraph *g, const BlossomResult *r, uint32_t *where)
{
  uint32_t ignored;
  if (!where) where = &ignored;
  BlossomVerdict verdict = check_matching(g, r, where);
  if (verdict != BLOSSOM_OK) return verdict;
  if (r->unmatched) return r->barrier ? check_barrier(g, r) : BLOSSOM_BAD_BARRIER;
  Family f = {.n = g->n, .total = g->n + r->nblossom, .parent = r->parent};
  size_t total = (size_t)f.total + 1;
  f.sum = mem_alloc(total * sizeof *f.sum);
  f.size = mem_alloc(total * sizeof *f.size);
  f.depth = mem_alloc(total * sizeof *f.depth);
  f.head = mem_alloc(total * sizeof *f.head);
  f.heavy = mem_alloc(total * sizeof *f.heavy);
  verdict = family_build(&f, r, where);
  if (verdict == BLOSSOM_OK) verdict = check_optimum(g, r, &f, where);
  free(f.sum);
  free(f.size);
  free(f.depth);
  free(f.head);
  free(f.heavy);
  return verdict;
}

const char *blossom_verdict_text(BlossomVerdict v)
{
  switch (v) {
  case BLOSSOM_OK: return "optimal";
  case BLOSSOM_BAD_MATE: return "not a matching of the graph, or its cost is wrong";
  case BLOSSOM_BAD_FAMILY: return "blossoms are not nested odd sets";
  case BLOSSOM_NEGATIVE_Z: return "a blossom's dual is negative";
  case BLOSSOM_NEGATIVE_SLACK: return "an edge's slack is negative";
  case BLOSSOM_LOOSE_MATCH: return "a matched edge has slack";
  case BLOSSOM_LOOSE_BLOSSOM: return "a blossom is not left by exactly one matched edge";
  case BLOSSOM_GAP: return "primal and dual objectives differ";
  case BLOSSOM_BAD_BARRIER: return "the barrier does not prove maximum cardinality";
  }
  UNREACHABLE();
}
