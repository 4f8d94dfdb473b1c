// recombine.c - triangles to quads: greedy and optimal merging, all-quad splitting
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "base/stats.h"
#include "quad/blossom.h"
#include "quad/quad_dual.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

QuadParams quad_params_default(void)
{
  return (QuadParams){.algorithm = QUAD_BLOSSOM, .angle = 45, .cleanup = 10, .smoothing = 5, .min_eta = 0.01};
}

static void merge(QuadMesh *m, uint32_t s, uint32_t t)
{
  uint32_t q[4];
  quad__merged(m, s, t, q);
  for (int i = 0; i < 4; i++) m->vertex.data[s / 4 * 4 + (uint32_t)i] = q[i];
  m->vertex.data[t / 4 * 4] = NONE;
}

// ---- greedy

typedef struct {
  double eta;
  uint32_t side, twin;
} Pair;

static int better_pair(const void *a, const void *b)
{
  const Pair *p = a, *q = b;
  if (p->eta != q->eta) return p->eta > q->eta ? -1 : 1;
  return p->side < q->side ? -1 : p->side > q->side;
}

// Free edges between two triangles, each once.
static Pair *find_pairs(const QuadMesh *m, size_t *n)
{
  uint32_t *twin = quad_mesh_twins(m);
  uint8_t *locked = quad__locked_sides(m, twin);
  Vec(Pair) pair = {0};
  for (uint32_t s = 0; s < m->vertex.len; s++) {
    uint32_t t = twin[s], q[4];
    if (t == NONE || t < s || locked[s] || quad_mesh_is_quad(m, s / 4) || quad_mesh_is_quad(m, t / 4)) continue;
    quad__merged(m, s, t, q);
    vec_push(&pair, ((Pair){quad__eta(m, q), s, t}));
  }
  free(twin);
  free(locked);
  *n = pair.len;
  return pair.data;
}

// Which triangles the greedy method has put together.
typedef struct {
  const uint32_t *twin;
  double *eta;      // by side: of the pair over it; -1 if it is not allowed
  uint32_t *over;   // by element: the side over which it is merged, or NONE
  uint32_t *seen;   // by element: stamp of the search that came by
  uint32_t stamp;
} Greedy;

static void match_sides(Greedy *g, uint32_t s)
{
  g->over[s / 4] = s;
  g->over[g->twin[s] / 4] = g->twin[s];
}

// Give the triangle e a partner: a single neighbour, or one whose own partner finds another one in the same way, `depth` times at
// most. Neighbours are tried from the best pair to the worst.
static bool find_partner(Greedy *g, uint32_t e, int depth)
{
  uint32_t side[3] = {4 * e, 4 * e + 1, 4 * e + 2};
  for (int i = 1; i < 3; i++)
    for (int j = i; j > 0 && g->eta[side[j]] > g->eta[side[j - 1]]; j--) {
      uint32_t t = side[j];
      side[j] = side[j - 1];
      side[j - 1] = t;
    }
  for (int i = 0; i < 3 && g->eta[side[i]] >= 0; i++) {
    uint32_t f = g->twin[side[i]] / 4;
    if (g->seen[f] == g->stamp) continue;
    if (g->over[f] != NONE && depth == 0) continue;
    g->seen[f] = g->stamp;
    if (g->over[f] == NONE || find_partner(g, g->twin[g->over[f]] / 4, depth - 1)) {
      match_sides(g, side[i]);
      return true;
    }
  }
  return false;
}

enum { GREEDY_DEPTH = 6 };

// Single triangles that a short exchange with their neighbours makes pairs of, the shortest first.
static void exchange_pairs(Greedy *g, size_t ne)
{
  for (int depth = 1; depth <= GREEDY_DEPTH; depth++)
    for (uint32_t e = 0; e < ne; e++) {
      if (g->over[e] != NONE) continue;
      g->seen[e] = ++g->stamp;
      find_partner(g, e, depth);
    }
}

void quad_match_greedy(QuadMesh *m, double angle)
{
  size_t n, ne = quad_mesh_elements(m);
  Pair *pair = find_pairs(m, &n);
  uint32_t *twin = quad_mesh_twins(m);
  Greedy g = {.twin = twin, .eta = mem_alloc((4 * ne + 1) * sizeof *g.eta), .over = mem_alloc((ne + 1) * sizeof *g.over),
              .seen = mem_zalloc((ne + 1) * sizeof *g.seen)};
  for (size_t s = 0; s < 4 * ne; s++) g.eta[s] = -1;
  for (size_t e = 0; e < ne; e++) g.over[e] = NONE;
  if (n) qsort(pair, n, sizeof *pair, better_pair);
  for (size_t i = 0; i < n && pair[i].eta > 0 && pair[i].eta >= 1 - angle / 90; i++) {
    g.eta[pair[i].side] = g.eta[pair[i].twin] = pair[i].eta;
    if (g.over[pair[i].side / 4] == NONE && g.over[pair[i].twin / 4] == NONE) match_sides(&g, pair[i].side);
  }
  exchange_pairs(&g, ne);
  for (uint32_t e = 0; e < ne; e++)
    if (g.over[e] != NONE && twin[g.over[e]] > g.over[e]) merge(m, g.over[e], twin[g.over[e]]);
  free(pair);
  free(twin);
  free(g.eta);
  free(g.over);
  free(g.seen);
  quad_mesh_compact(m);
}

// ---- optimal

void quad_match_blossom(QuadMesh *m, QuadReport *report)
{
  QuadDual d;
  uint32_t *twin = quad_mesh_twins(m);
  quad_dual_init(&d, m, twin);
  report->odd_parts = d.odd_parts;
  double t = time_thread();
  BlossomGraph g = quad_dual_graph(&d);
  BlossomResult *r = blossom_solve(&g);
  uint32_t where = NONE;
  BlossomVerdict verdict = blossom_check(&g, r, &where);
  if (verdict != BLOSSOM_OK) check_context(blossom_verdict_text(verdict), where);
  CHECK(verdict == BLOSSOM_OK);
  report->matching_seconds = time_thread() - t;
  report->matching_cost = r->cost;
  for (uint32_t k = 0; k < g.m; k++)
    if (d.side.data[k] != NONE && r->mate_edge[d.edge.data[2 * (size_t)k]] == k) merge(m, d.side.data[k], twin[d.side.data[k]]);
  blossom_free(r);
  quad_dual_free(&d);
  free(twin);
  quad_mesh_compact(m);
}

// ---- splitting

static uint32_t split_side(QuadMesh *m, const QuadParams *p, uint32_t a, uint32_t b, bool locked)
{
  Vec2 mid = vec2_scale(0.5, vec2_add(m->xy.data[a], m->xy.data[b])), on;
  uint32_t fa = m->from.data[a], fb = m->from.data[b];
  if (locked && p->middle && p->middle(p->ctx, fa, fb, &on)) mid = on;
  uint32_t v = quad__add_vertex(m, mid, (const uint32_t[2]){a, b}, 2);
  if (!locked) return v;
  m->fixed.data[v] = 1;
  m->parent.data[2 * v] = fa, m->parent.data[2 * v + 1] = fb;
  return v;
}

// The point that makes the best of the n corners' quads: the mean of the corners does on convex elements.
static uint32_t add_centre(QuadMesh *m, const uint32_t *v, uint32_t n)
{
  Vec2 c = {0, 0};
  for (uint32_t i = 0; i < n; i++) c = vec2_add(c, m->xy.data[v[i]]);
  return quad__add_vertex(m, vec2_scale(1.0 / n, c), v, n);
}

static void split_all(QuadMesh *m, const QuadParams *p)
{
  size_t ne = quad_mesh_elements(m), len = 0;
  uint32_t *twin = quad_mesh_twins(m), *mid = mem_alloc((4 * ne + 1) * sizeof *mid);
  uint8_t *locked = quad__locked_sides(m, twin);
  U32Vec out = {0}, lock = {0};
  for (uint32_t s = 0; s < 4 * ne; s++) {
    uint32_t e = s / 4, n = quad_mesh_corners(m, e);
    len += s % 4 < n;
    if (s % 4 >= n || (twin[s] != NONE && twin[s] < s)) continue;
    uint32_t a = m->vertex.data[s], b = m->vertex.data[4 * e + (s % 4 + 1) % n];
    mid[s] = split_side(m, p, a, b, locked[s]);
    if (twin[s] != NONE) mid[twin[s]] = mid[s];
    if (twin[s] != NONE && locked[s]) {
      uint32_t half[4] = {a, mid[s], mid[s], b};
      for (int k = 0; k < 4; k++) vec_push(&lock, half[k]);
    }
  }
  vec_reserve(&out, 4 * len);
  for (size_t e = 0; e < ne; e++) {
    uint32_t n = quad_mesh_corners(m, e), v[4];
    for (uint32_t i = 0; i < n; i++) v[i] = m->vertex.data[4 * e + i];
    uint32_t c = add_centre(m, v, n);
    for (uint32_t i = 0; i < n; i++) {
      uint32_t q[4] = {v[i], mid[4 * e + i], c, mid[4 * e + (i + n - 1) % n]};
      for (int k = 0; k < 4; k++) vec_push(&out, q[k]);
    }
  }
  vec_free(&m->vertex);
  vec_free(&m->locked);
  m->vertex.data = out.data, m->vertex.len = out.len, m->vertex.cap = out.cap;
  m->locked = lock;
  free(twin);
  free(mid);
  free(locked);
}

// Cut along the diagonal whose worse triangle is the better one; a quad that no diagonal cuts into two positive triangles stays.
size_t quad_cut_bad(QuadMesh *m, double min_eta)
{
  size_t ne = quad_mesh_elements(m), cut = 0;
  for (size_t e = 0; e < ne; e++) {
    uint32_t v[4], best = NONE;
    double score = 0;
    for (int i = 0; i < 4; i++) v[i] = m->vertex.data[4 * e + (size_t)i];
    if (v[3] == NONE || (quad__convex(m->xy.data, v) && quad__eta(m, v) >= min_eta)) continue;
    for (uint32_t k = 0; k < 2; k++) {
      uint32_t a[4] = {v[k], v[k + 1], v[k + 2], NONE}, b[4] = {v[k], v[k + 2], v[(k + 3) % 4], NONE};
      if (!quad__convex(m->xy.data, a) || !quad__convex(m->xy.data, b)) continue;
      double worse = 2 + fmin(quad__shape(m->xy.data, a), quad__shape(m->xy.data, b));
      if (worse > score) best = k, score = worse;
    }
    if (best == NONE) continue;
    uint32_t a[4] = {v[best], v[best + 1], v[best + 2], NONE}, b[4] = {v[best], v[best + 2], v[(best + 3) % 4], NONE};
    for (size_t i = 0; i < 4; i++) m->vertex.data[4 * e + i] = a[i];
    for (size_t i = 0; i < 4; i++) vec_push(&m->vertex, b[i]);
    cut++;
  }
  return cut;
}

// ---- all together

// Quads worse than that, such as those that alone stand on a boundary vertex, become five if those are better: the clean-up finds ways to
// go on from there that it does not find from one.
static const double FILL_ETA = 0.35, FILL_LEAST = 0.05;

static void fill_bad(QuadMesh *m, const QuadParams *p, QuadReport *report)
{
  size_t n = p->cleanup ? quad_fill_bad(m, FILL_ETA, FILL_LEAST) : 0;
  n += quad_fill_bad(m, p->min_eta, p->min_eta);
  report->filled += n;
  if (n && p->cleanup) quad_clean(m, p->cleanup, report);
  if (n && p->smoothing) quad_smooth(m, p->smoothing);
}

// What is not convex is cut, and the triangles are brought together by other ways.
static void cut_bad(QuadMesh *m, const QuadParams *p, QuadReport *report)
{
  size_t n = quad_cut_bad(m, 0);
  report->cut += n;
  if (!n) return;
  size_t before = report->repaired;
  quad_repair(m, report);
  if (report->repaired > before && p->smoothing) quad_smooth(m, p->smoothing);
}

static void scale_sizes(QuadMesh *m, double factor)
{
  for (size_t v = 0; v < m->size.len; v++) {
    m->size.data[v].h *= factor;
    m->size.data[v].slope = vec2_scale(factor, m->size.data[v].slope);
  }
}

void quad_recombine(QuadMesh *m, const QuadParams *p, QuadReport *report)
{
  QuadReport ignored;
  if (!report) report = &ignored;
  *report = (QuadReport){0};
  bool split = p->algorithm == QUAD_FULL_GREEDY || p->algorithm == QUAD_FULL_BLOSSOM || p->algorithm == QUAD_SPLIT;
  if (split) scale_sizes(m, 2);
  switch (p->algorithm) {
  case QUAD_GREEDY:
  case QUAD_FULL_GREEDY: quad_match_greedy(m, p->angle); break;
  case QUAD_BLOSSOM:
  case QUAD_FULL_BLOSSOM:
    quad_match_blossom(m, report);
    quad_repair(m, report);
    break;
  case QUAD_SPLIT: break;
  }
  if (p->cleanup) quad_clean(m, p->cleanup, report);
  if (p->smoothing) quad_smooth(m, p->smoothing);
  if (p->algorithm == QUAD_GREEDY) {
    report->cut = quad_cut_bad(m, p->min_eta);
  } else if (!split) {
    fill_bad(m, p, report);
    cut_bad(m, p, report);
  } else {
    report->cut = quad_cut_bad(m, 0);
    split_all(m, p);
    scale_sizes(m, 0.5);
    if (p->cleanup) quad_clean(m, p->cleanup, report);
    if (p->smoothing) quad_smooth(m, p->smoothing);
    fill_bad(m, p, report);
    cut_bad(m, p, report);
  }
  for (size_t e = 0; e < quad_mesh_elements(m); e++) report->inverted += !quad__convex(m->xy.data, &m->vertex.data[4 * e]);
  report->triangles = quad_mesh_triangles(m);
  report->quads = quad_mesh_elements(m) - report->triangles;
}
