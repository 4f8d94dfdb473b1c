// tri_refine.c - the entry of refinement, its sizes, and the insertion of points into a constrained Delaunay triangulation
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/refine.h"

#include "tri/refine_int.h"

TriRefineParams tri_refine_defaults(void)
{
  return (TriRefineParams){.algorithm = REFINE_FRONTAL, .extend_from_boundary = true, .smoothing = 1, .optimize = 1};
}

// ---- sizes ------------------------------------------------------------------------------------------------------

static double ask_size(const Refiner *r, const double *p)
{
  return r->p->size(r->p->size_ctx, (Vec2){p[0], p[1]});
}

// Each initial vertex carries the mean length of the segments at it: where a long one meets a short one, the triangles between
// must be a compromise. Vertices without segments, such as embedded points, carry their shortest edge.
static void carry_from_boundary(Refiner *r)
{
  const Tri *m = r->m;
  double *sum = mem_zalloc(m->nv * sizeof *sum);
  uint32_t *count = mem_zalloc(m->nv * sizeof *count);
  for (VertId v = 0; v < m->nv; v++) r->carried[v] = INFINITY;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    if (!tri_is_inside(m, tri_of(e))) continue;
    VertId a = tri_org(m, e), b = tri_dest(m, e);
    double d = sqrt(metric_distance2(tri_xy(m, a), tri_xy(m, b)));
    r->carried[a] = fmin(r->carried[a], d), r->carried[b] = fmin(r->carried[b], d);
    if (tri_is_segment(m, e)) sum[a] += d, sum[b] += d, count[a]++, count[b]++;
  }
  for (VertId v = 0; v < m->nv; v++) {
    if (count[v]) r->carried[v] = sum[v] / count[v];
    if (r->p->vertex_size) r->carried[v] = fmin(r->carried[v], r->p->vertex_size[v]);
    if (!isfinite(r->carried[v])) r->carried[v] = 1; // an isolated vertex, which nobody will ask
    if (r->p->carried_factor > 0) r->carried[v] *= r->p->carried_factor;
  }
  free(sum);
  free(count);
}

// Triangles of the wanted sizes at the vertices of the empty mesh, as far as these tell.
static double expected_triangles(const Refiner *r)
{
  const Tri *m = r->m;
  double sum = 0;
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    const double *a = tri_xy(m, v[0]), *b = tri_xy(m, v[1]), *c = tri_xy(m, v[2]);
    double h = (r->size[v[0]] + r->size[v[1]] + r->size[v[2]]) / 3;
    sum += fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / (sqrt(3) / 2 * h * h);
  }
  return sum;
}

// As many sizes as the triangulation has room for vertices.
static void sizes_for_vertices(Refiner *r)
{
  if (r->cap_v >= r->m->cap_v) return;
  r->cap_v = r->m->cap_v;
  r->size = mem_realloc(r->size, (size_t)r->cap_v * sizeof *r->size);
  if (r->carried) r->carried = mem_realloc(r->carried, (size_t)r->cap_v * sizeof *r->carried);
}

void refine__reserve(Refiner *r)
{
  enum { WORTH = 1 << 14 };
  r->expected = expected_triangles(r);
  double n = 1.05 * fmin(r->expected, 2 * (double)r->max_vertices);
  if (!(n > WORTH && n < UINT32_MAX / 4)) return;
  tri_reserve(r->m, r->m->nv + (size_t)n / 2, r->m->nt + (size_t)n);
  sizes_for_vertices(r);
}

void refine__initial_sizes(Refiner *r)
{
  const Tri *m = r->m;
  r->cap_v = m->cap_v > m->nv ? m->cap_v : m->nv;
  r->size = mem_alloc((size_t)r->cap_v * sizeof *r->size);
  if (r->p->extend_from_boundary || !r->p->size) {
    r->carried = mem_alloc((size_t)r->cap_v * sizeof *r->carried);
    carry_from_boundary(r);
  }
  for (VertId v = 0; v < m->nv; v++) {
    double h = r->carried ? r->carried[v] : INFINITY;
    if (r->p->size) h = fmin(h, ask_size(r, tri_xy(m, v)));
    if (!r->carried && r->p->vertex_size) h = fmin(h, r->p->vertex_size[v]);
    r->size[v] = h;
  }
}

double refine__size_at(Refiner *r, const double *p, TriId t, double *carried)
{
  double h = INFINITY;
  *carried = 0;
  if (r->carried) *carried = h = refine__linear(r->m, r->carried, t, p);
  if (r->p->size) h = fmin(h, ask_size(r, p));
  return h;
}

void refine__size_vertex(Refiner *r, VertId v, double carried)
{
  sizes_for_vertices(r);
  if (r->carried) r->carried[v] = carried;
  r->size[v] = fmin(r->carried ? carried : INFINITY, r->p->size ? ask_size(r, tri_xy(r->m, v)) : INFINITY);
}

double refine__size_inside(const Refiner *r, TriId t)
{
  const uint32_t *v = r->m->vert + 3 * (size_t)t;
  const double *a = tri_xy(r->m, v[0]), *b = tri_xy(r->m, v[1]), *c = tri_xy(r->m, v[2]);
  double p[2] = {(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3};
  return ask_size(r, p);
}

// ---- the insertion engine -----------------------------------------------------------------------------------------

TriId refine__walk(const Tri *m, const double *p, TriId t, EdgeId *blocked)
{
  // Every edge crossed is locally Delaunay, so the power of p to the triangles' circles decreases: the walk ends.
  EdgeId from = NONE;
  for (;;) {
    EdgeId e = 3 * t, out = NONE;
    for (int i = 0; i < 3; i++, e++) {
      if (e == from) continue;
      if (orient2d(tri_xy(m, m->vert[e]), tri_xy(m, tri_dest(m, e)), p) < 0) {
        out = e;
        break;
      }
    }
    if (out == NONE) return t;
    if (tri_is_segment(m, out)) {
      *blocked = out;
      return NONE;
    }
    from = m->twin[out];
    t = tri_of(from);
  }
}

// Is p inside the circle of triangle t?
static inline bool in_conflict(Tri *m, TriId t, const double *p)
{
  const uint32_t *v = m->vert + 3 * (size_t)t;
  return incircle_perturbed(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), p, &m->count) > 0;
}

static bool is_corner(const Tri *m, TriId t, const double *p)
{
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
    const double *a = tri_xy(m, m->vert[e]);
    if (a[0] == p[0] && a[1] == p[1]) return true;
  }
  return false;
}

// Half-edge o waits outside the cavity. Its triangle is asked for now, to be there when its turn comes.
static inline void put_off(Refiner *r, EdgeId o)
{
  __builtin_prefetch(&r->m->vert[o]);
  vec_push(&r->stack, o);
}

// Is the segment under o, which bounds the cavity, in the way: p on it, or too near?
static bool segment_in_way(const Tri *m, EdgeId o, const double *p, bool clear)
{
  const double *a = tri_xy(m, tri_dest(m, o)), *b = tri_xy(m, m->vert[o]);
  if (orient2d(a, b, p) <= 0) return true;
  return clear && (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]) < 0;
}

bool refine__cavity(Refiner *r, const double *p, TriId t, bool clear)
{
  Tri *m = r->m;
  if (is_corner(m, t, p)) return false;
  r->at[0] = p[0], r->at[1] = p[1];
  vec_clear(&r->rim), vec_clear(&r->dead), vec_clear(&r->stack);
  vec_push(&r->dead, t);
  for (int i = 2; i >= 0; i--) put_off(r, m->twin[3 * t + i]);
  // The triangles of the cavity form a tree, since no vertex is inside: walking it depth first, counterclockwise about each
  // triangle, gives the sides in order. p sees them all: where it lies in the circle of a triangle, and beyond one edge of it, it is
  // on the inner side of the other two, as the three caps of the circle have only corners in common.
  while (r->stack.len) {
    EdgeId o = vec_pop(&r->stack);
    TriId over = tri_of(o);
    bool seg = m->flag[over] >> (o - 3 * over) & 1;
    if (!seg && in_conflict(m, over, p)) {
      vec_push(&r->dead, over);
      put_off(r, m->twin[tri_prev(o)]);
      put_off(r, m->twin[tri_next(o)]);
      continue;
    }
    if (UNLIKELY(seg) && segment_in_way(m, o, p, clear)) return false;
    RimSide side = {.a = tri_dest(m, o), .outer = o, .seg = seg ? m->seg[o] : NONE, .is_seg = seg};
    DCHECK(orient2d(tri_xy(m, side.a), tri_xy(m, m->vert[o]), p) > 0);
    vec_push(&r->rim, side);
  }
  return true;
}

static void more_vertices(Refiner *r)
{
  Tri *m = r->m;
  if (m->nv + 1 > m->cap_v) tri_reserve(m, (size_t)m->nv + m->nv / 2 + 64, m->cap_t);
  sizes_for_vertices(r);
}

static TriId fresh_triangle(Tri *m)
{
  if (m->nfree) {
    TriId t = m->free_list;
    m->free_list = m->twin[3 * (size_t)t];
    m->nfree--;
    return t;
  }
  if (m->nt + 1 > m->cap_t) tri_reserve(m, m->cap_v, (size_t)m->nt + m->nt / 2 + 64);
  return m->nt++;
}

VertId refine__commit(Refiner *r, double size, double carried)
{
  Tri *m = r->m;
  if (m->nv + 1 > m->cap_v || m->nv + 1 > r->cap_v) more_vertices(r);
  VertId v = m->nv++;
  m->xy[2 * (size_t)v] = r->at[0], m->xy[2 * (size_t)v + 1] = r->at[1];
  r->size[v] = size;
  if (r->carried) r->carried[v] = carried;
  size_t n = r->rim.len;
  DCHECK(n == r->dead.len + 2);
  RimSide *rim = r->rim.data;
  for (size_t i = 0; i < r->dead.len; i++) rim[i].tri = r->dead.data[i];
  rim[n - 2].tri = fresh_triangle(m), rim[n - 1].tri = fresh_triangle(m);
  uint32_t region = m->region ? m->region[rim[0].tri] : 0;
  for (size_t i = 0; i < n; i++) {
    RimSide *s = &rim[i], *next = &rim[i + 1 < n ? i + 1 : 0], *prev = &rim[i ? i - 1 : n - 1];
    EdgeId e = 3 * s->tri;
    m->vert[e] = s->a, m->vert[e + 1] = next->a, m->vert[e + 2] = v;
    m->twin[e] = s->outer, m->twin[e + 1] = 3 * next->tri + 2, m->twin[e + 2] = 3 * prev->tri + 1;
    m->twin[s->outer] = e;
    m->flag[s->tri] = s->is_seg ? TRI_SEG_0 : 0;
    if (s->is_seg) m->seg[e] = s->seg;
    if (m->region) m->region[s->tri] = region;
  }
  r->stats->inserted++;
  return v;
}

bool refine__go_on(Refiner *r)
{
  if (r->stats->outcome != REFINE_DONE) return false;
  if (r->m->nv >= r->max_vertices) {
    r->stats->outcome = REFINE_LIMIT;
    return false;
  }
  if ((++r->ticks & 0x3fff) == 0 && r->p->cancel && r->p->cancel(r->p->cancel_ctx, -1)) {
    r->stats->outcome = REFINE_CANCELLED;
    return false;
  }
  return true;
}

// ---- entry -------------------------------------------------------------------------------------------------------

// Split segments to conform. What *p says of each initial vertex says nothing of the new ones; *near and *size are for the caller to free.
static void conform(Refiner *r, TriRefineParams *p, uint32_t **near, double **size)
{
  VertId initial = r->m->nv, nv;
  refine__conform(r);
  nv = r->m->nv;
  if (p->cross_near) {
    *near = mem_alloc((nv + 1) * sizeof **near);
    for (VertId v = 0; v < nv; v++) (*near)[v] = v < initial ? p->cross_near[v] : NONE;
    p->cross_near = *near;
  }
  if (p->vertex_size) {
    *size = mem_alloc((nv + 1) * sizeof **size);
    for (VertId v = 0; v < nv; v++) (*size)[v] = v < initial ? p->vertex_size[v] : INFINITY;
    p->vertex_size = *size;
  }
}

TriRefineStats tri_refine(Tri *m, const TriRefineParams *params)
{
  TriRefineParams own = *params, *p = &own;
  uint32_t *near = NULL;
  double *vertex_size = NULL;
  TriRefineStats stats = {.outcome = REFINE_DONE};
  if (m->dim != 2) return stats;
  size_t cap = p->max_triangles ? p->max_triangles / 2 : TRI_MAX_VERTICES;
  Refiner r = {.m = m, .p = p, .stats = &stats, .max_vertices = MIN(cap, (size_t)TRI_MAX_VERTICES)};
  if (p->conforming) conform(&r, p, &near, &vertex_size);
  VertId given = m->nv;
  refine__make_mesh(&r, given);
  if (p->min_angle > 0 && stats.outcome == REFINE_DONE) {
    tri_legalize_all(m);
    refine__min_angle(&r, p->min_angle, given);
  }
  m->last = 0;
  if (p->sizes_out) {
    *p->sizes_out = r.size;
    r.size = NULL;
  }
  refine__release(&r);
  free(near);
  free(vertex_size);
  return stats;
}
