// recombine.c - triangles to quads: greedy and optimal merging, all-quad splitting
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "base/stats.h"
#include "geom/hilbert.h"
#include "quad/blossom.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

// Costs of the matching: 1 - eta in units of 1/COST_UNIT, eta taken with its sign so that of two bad quads the less bad is
// preferred. Leaving two neighbouring boundary triangles costs more than any rearrangement of quads can save nearby.
enum { COST_UNIT = 1 << 14, COST_EXTRA = 1 << 20, COST_ODD = 1 << 21 };

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

// The dual graph of [book §5.2.4]: a vertex for each triangle (numbered along a Hilbert curve: the solver likes neighbours in
// the graph to be neighbours in memory), an edge for each free edge between two of them.
typedef struct {
  U32Vec edge;
  IntVec cost;
  U32Vec side;     // by edge: a side of the mesh to merge over; NONE for extra edges
  uint32_t n;
  uint32_t *rank;  // by element: vertex of the graph, NONE for quads
} Dual;

static void dual_edge(Dual *d, uint32_t u, uint32_t v, int cost, uint32_t side)
{
  vec_push(&d->edge, u);
  vec_push(&d->edge, v);
  vec_push(&d->cost, cost);
  vec_push(&d->side, side);
}

static void number_triangles(const QuadMesh *m, Dual *d)
{
  size_t ne = quad_mesh_elements(m);
  double *centre = mem_alloc((2 * ne + 1) * sizeof *centre);
  uint32_t *order = mem_alloc((ne + 1) * sizeof *order);
  d->rank = mem_alloc((ne + 1) * sizeof *d->rank);
  for (size_t e = 0; e < ne; e++) {
    const uint32_t *v = &m->vertex.data[4 * e];
    Vec2 a = m->xy.data[v[0]], b = m->xy.data[v[1]], c = m->xy.data[v[2]];
    centre[2 * e] = (a.x + b.x + c.x) / 3;
    centre[2 * e + 1] = (a.y + b.y + c.y) / 3;
  }
  hilbert_order(centre, ne, order);
  for (size_t i = 0; i < ne; i++) d->rank[order[i]] = quad_mesh_is_quad(m, order[i]) ? NONE : d->n++;
  free(centre);
  free(order);
}

// Extra edges [book §5.2.4]: between triangles that follow each other along the locked sides round a vertex. Turning round the
// vertex from one locked side to the next, the first and the last triangle of the fan are joined.
static void extra_edges(const QuadMesh *m, const uint32_t *twin, const uint8_t *locked, Dual *d)
{
  for (uint32_t s = 0; s < m->vertex.len; s++) {
    uint32_t e = s / 4;
    if (quad_mesh_is_quad(m, e) || s % 4 == 3 || !locked[s]) continue;
    // From side s, which leaves the vertex, turn counterclockwise until the side that comes back to it is locked.
    uint32_t f = e, in = 4 * e + (s % 4 + 2) % 3, steps = 0;
    while (!locked[in] && !quad_mesh_is_quad(m, twin[in] / 4) && steps++ < m->vertex.len) {
      f = twin[in] / 4;
      in = 4 * f + (twin[in] % 4 + 2) % 3;
    }
    if (f != e && locked[in]) dual_edge(d, d->rank[e], d->rank[f], COST_EXTRA, NONE);
  }
}

static uint32_t find(uint32_t *set, uint32_t x)
{
  while (set[x] != x) x = set[x] = set[set[x]];
  return x;
}

// One more vertex for each part with an odd number of triangles, joined to its triangles on locked sides: the one matched
// with it is left over. Returns the number of such parts.
static uint32_t odd_parts(const QuadMesh *m, const uint8_t *locked, Dual *d)
{
  uint32_t n = d->n, odd = 0;
  uint32_t *set = mem_alloc(((size_t)n + 1) * sizeof *set), *dummy = mem_alloc(((size_t)n + 1) * sizeof *dummy);
  uint8_t *parity = mem_zalloc((size_t)n + 1);
  for (uint32_t v = 0; v < n; v++) set[v] = v;
  for (size_t k = 0; k < d->side.len; k++) set[find(set, d->edge.data[2 * k])] = find(set, d->edge.data[2 * k + 1]);
  for (uint32_t v = 0; v < n; v++) parity[find(set, v)] ^= 1;
  for (uint32_t v = 0; v < n; v++) dummy[v] = set[v] == v && parity[v] ? d->n + odd++ : NONE;
  for (size_t e = 0; odd && e < quad_mesh_elements(m); e++) {
    if (d->rank[e] == NONE) continue;
    uint32_t part = dummy[find(set, d->rank[e])];
    if (part != NONE && (locked[4 * e] || locked[4 * e + 1] || locked[4 * e + 2]))
      dual_edge(d, d->rank[e], part, COST_ODD, NONE);
  }
  d->n += odd;
  free(set);
  free(dummy);
  free(parity);
  return odd;
}

static void build_dual(const QuadMesh *m, const uint32_t *twin, Dual *d, QuadReport *report)
{
  uint8_t *locked = quad__locked_sides(m, twin);
  number_triangles(m, d);
  for (uint32_t s = 0; s < m->vertex.len; s++) {
    uint32_t t = twin[s], q[4];
    if (t == NONE || t < s || locked[s] || quad_mesh_is_quad(m, s / 4) || quad_mesh_is_quad(m, t / 4)) continue;
    quad__merged(m, s, t, q);
    dual_edge(d, d->rank[s / 4], d->rank[t / 4], (int)lround(COST_UNIT * (1 - quad__eta(m, q))), s);
  }
  report->odd_parts = odd_parts(m, locked, d);
  extra_edges(m, twin, locked, d);
  free(locked);
}

void quad_match_blossom(QuadMesh *m, QuadReport *report)
{
  Dual d = {0};
  uint32_t *twin = quad_mesh_twins(m);
  build_dual(m, twin, &d, report);
  double t = time_cpu();
  BlossomGraph g = {d.n, (uint32_t)d.cost.len, d.edge.data, d.cost.data};
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
  vec_free(&d.edge);
  vec_free(&d.cost);
  vec_free(&d.side);
  free(d.rank);
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
