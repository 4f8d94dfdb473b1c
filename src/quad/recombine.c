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
  return (QuadParams){.algorithm = QUAD_BLOSSOM, .angle = 45, .cleanup = 10, .smoothing = 10, .min_eta = 0.01};
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

void quad_match_greedy(QuadMesh *m, double angle)
{
  size_t n;
  Pair *pair = find_pairs(m, &n);
  uint8_t *used = mem_zalloc(quad_mesh_elements(m) + 1);
  if (n) qsort(pair, n, sizeof *pair, better_pair);
  for (size_t i = 0; i < n && pair[i].eta > 0 && pair[i].eta >= 1 - angle / 90; i++) {
    if (used[pair[i].side / 4] || used[pair[i].twin / 4]) continue;
    used[pair[i].side / 4] = used[pair[i].twin / 4] = 1;
    merge(m, pair[i].side, pair[i].twin);
  }
  free(pair);
  free(used);
  quad_mesh_compact(m);
}

// ---- optimal

void quad_match_blossom(QuadMesh *m, QuadReport *report)
{
  QuadDual d;
  uint32_t *twin = quad_mesh_twins(m);
  quad_dual_init(&d, m, twin);
  report->odd_parts = d.odd_parts;
  double t = time_cpu();
  BlossomGraph g = quad_dual_graph(&d);
  BlossomResult *r = blossom_solve(&g);
  uint32_t where = NONE;
  BlossomVerdict verdict = blossom_check(&g, r, &where);
  if (verdict != BLOSSOM_OK) check_context(blossom_verdict_text(verdict), where);
  CHECK(verdict == BLOSSOM_OK);
  report->matching_seconds = time_cpu() - t;
  report->matching_cost = r->cost;
  for (uint32_t k = 0; k < g.m; k++)
    if (d.side.data[k] != NONE && r->mate_edge[d.edge.data[2 * (size_t)k]] == k) merge(m, d.side.data[k], twin[d.side.data[k]]);
  blossom_free(r);
  quad_dual_free(&d);
  free(twin);
  quad_mesh_compact(m);
}

// ---- splitting

static uint32_t add_vertex(QuadMesh *m, Vec2 p, bool fixed, uint32_t a, uint32_t b)
{
  vec_push(&m->xy, p);
  vec_push(&m->fixed, fixed);
  vec_push(&m->from, NONE);
  vec_push(&m->parent, a);
  vec_push(&m->parent, b);
  return (uint32_t)m->xy.len - 1;
}

static uint32_t split_side(QuadMesh *m, const QuadParams *p, uint32_t a, uint32_t b, bool locked)
{
  Vec2 mid = vec2_scale(0.5, vec2_add(m->xy.data[a], m->xy.data[b])), on;
  uint32_t fa = m->from.data[a], fb = m->from.data[b];
  if (locked && p->middle && p->middle(p->ctx, fa, fb, &on)) mid = on;
  return locked ? add_vertex(m, mid, true, fa, fb) : add_vertex(m, mid, false, NONE, NONE);
}

// The point that makes the best of the n corners' quads: the mean of the corners does on convex elements.
static uint32_t add_centre(QuadMesh *m, const uint32_t *v, uint32_t n)
{
  Vec2 c = {0, 0};
  for (uint32_t i = 0; i < n; i++) c = vec2_add(c, m->xy.data[v[i]]);
  return add_vertex(m, vec2_scale(1.0 / n, c), false, NONE, NONE);
}

void quad_split_all(QuadMesh *m, const QuadParams *p)
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

void quad_recombine(QuadMesh *m, const QuadParams *p, QuadReport *report)
{
  QuadReport ignored;
  if (!report) report = &ignored;
  *report = (QuadReport){0};
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
  bool split = p->algorithm == QUAD_FULL_GREEDY || p->algorithm == QUAD_FULL_BLOSSOM || p->algorithm == QUAD_SPLIT;
  if (p->cleanup) quad_clean(m, p->cleanup, report);
  if (p->smoothing) quad_smooth(m, p->smoothing);
  report->cut = quad_cut_bad(m, split ? 0 : p->min_eta);
  if (split) {
    quad_split_all(m, p);
    if (p->cleanup) quad_clean(m, p->cleanup, report);
    if (p->smoothing) quad_smooth(m, p->smoothing);
    report->cut += quad_cut_bad(m, 0);
  }
  report->triangles = quad_mesh_triangles(m);
  report->quads = quad_mesh_elements(m) - report->triangles;
}
