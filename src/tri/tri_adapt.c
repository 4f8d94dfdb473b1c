// tri_adapt.c - MeshAdapt: long edges split, short edges collapsed, edges flipped, vertices repositioned
// SPDX-License-Identifier: MIT
//
// The empty mesh is first saturated: the longest edge is cut again and again, the point being inserted by
// Bowyer-Watson unless another vertex is too near. That is the variant with a filter of [book §4.4.3], the cavity being the filter.
// Then come sweeps of the four local modifications until no edge is too long or too short.
#include "base/base.h"
#include "tri/refine_int.h"

#define NEAREST 0.8       // adimensional distance within which a vertex forbids another, while saturating
#define AT 0.42           // where an edge is cut then: cuts in the middle leave squares in two, which nothing can improve
#define LONG 1.4142135623730951  // the sweeps keep edges in [sqrt(1/2), sqrt(2)]: cutting a long one in two makes no short
#define SHORT 0.7071067811865475 // one, and there are fewer triangles than with [2/3, 4/3] [book §4.4.3]
#define LEAST_QUALITY 0.3 // kappa_4^2 that a split or a collapse must leave to every triangle, unless it was worse
enum { NKEYS = 128, MAX_SWEEPS = 10 };

typedef struct {
  EdgeId e;
  VertId a, b;
} LongEdge;

typedef struct {
  Refiner *r;
  int top;
  Vec(LongEdge) stack[NKEYS];
} Queue;

static double length_of(const Refiner *r, VertId a, VertId b)
{
  return metric_length(tri_xy(r->m, a), tri_xy(r->m, b), r->size[a], r->size[b]);
}

// ---- saturation --------------------------------------------------------------------------------------------------

static void consider(Queue *q, EdgeId e)
{
  const Tri *m = q->r->m;
  if (tri_is_segment(m, e)) return;
  LongEdge g = {e, tri_org(m, e), tri_dest(m, e)};
  double l = length_of(q->r, g.a, g.b) / METRIC_LONG;
  if (l <= 1) return;
  int k = refine__key(l, 22, NKEYS);
  vec_push(&q->stack[k], g);
  if (k > q->top) q->top = k;
}

static bool take(Queue *q, LongEdge *g)
{
  const Tri *m = q->r->m;
  for (; q->top >= 0; q->top--) {
    while (q->stack[q->top].len) {
      *g = vec_pop(&q->stack[q->top]);
      if (m->vert[g->e] == g->a && tri_dest(m, g->e) == g->b && !tri_is_segment(m, g->e)) return true;
    }
  }
  return false;
}

static bool crowded(const Refiner *r, const double *p, double h)
{
  for (size_t i = 0; i < r->rim.len; i++) {
    VertId u = r->rim.data[i].a;
    if (metric_length(p, tri_xy(r->m, u), h, r->size[u]) < NEAREST) return true;
  }
  return false;
}

void refine__saturate(Refiner *r)
{
  Tri *m = r->m;
  Queue q = {.r = r, .top = -1};
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (m->twin[e] > e && tri_is_inside(m, tri_of(e))) consider(&q, e);
  LongEdge g;
  while (take(&q, &g) && refine__go_on(r)) {
    const double *a = tri_xy(m, g.a), *b = tri_xy(m, g.b);
    double p[2] = {a[0] + AT * (b[0] - a[0]), a[1] + AT * (b[1] - a[1])}, carried;
    EdgeId blocked;
    TriId t = refine__walk(m, p, tri_of(g.e), &blocked);
    if (t == NONE || !refine__cavity(r, p, t, true)) continue;
    double h = refine__size_at(r, p, t, &carried);
    if (crowded(r, p, h)) continue;
    refine__commit(r, h, carried);
    for (size_t i = 0; i < r->rim.len; i++) consider(&q, 3 * r->rim.data[i].tri), consider(&q, 3 * r->rim.data[i].tri + 1);
  }
  for (int k = 0; k < NKEYS; k++) vec_free(&q.stack[k]);
}

// ---- sweeps ------------------------------------------------------------------------------------------------------

void refine__added_vertex(Refiner *r, VertId v, double size, double carried)
{
  if (v >= r->cap_v) {
    r->cap_v = r->m->cap_v;
    r->size = mem_realloc(r->size, r->cap_v * sizeof *r->size);
    if (r->carried) r->carried = mem_realloc(r->carried, r->cap_v * sizeof *r->carried);
    r->fixed = mem_realloc(r->fixed, r->cap_v * sizeof *r->fixed);
    r->awake = mem_realloc(r->awake, r->cap_v * sizeof *r->awake);
    r->excess = mem_realloc(r->excess, r->cap_v * sizeof *r->excess);
  }
  r->size[v] = size;
  if (r->carried) r->carried[v] = carried;
  r->fixed[v] = false, r->awake[v] = 1, r->excess[v] = 0;
}

// Would the four triangles of e split at p be fair, or no worse than the two now?
static bool split_is_good(const Tri *m, EdgeId e, const double *p)
{
  const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
  const double *c = tri_xy(m, tri_apex(m, e)), *d = tri_xy(m, tri_apex(m, m->twin[e]));
  double now = MIN(metric_quality(a, b, c), metric_quality(b, a, d));
  double least = MIN(LEAST_QUALITY, now);
  return metric_quality(a, p, c) >= least && metric_quality(p, b, c) >= least && metric_quality(b, p, d) >= least &&
         metric_quality(p, a, d) >= least;
}

static size_t split_long(Refiner *r)
{
  Tri *m = r->m;
  size_t n = 0;
  EdgeId end = 3 * m->nt;
  for (EdgeId e = 0; e < end && refine__go_on(r); e++) {
    if (m->twin[e] <= e || tri_is_free(m, tri_of(e)) || tri_is_segment(m, e) || !tri_is_inside(m, tri_of(e))) continue;
    VertId a = tri_org(m, e), b = tri_dest(m, e);
    if (length_of(r, a, b) <= LONG) continue;
    const double *pa = tri_xy(m, a), *pb = tri_xy(m, b);
    double p[2] = {0.5 * (pa[0] + pb[0]), 0.5 * (pa[1] + pb[1])}, carried;
    if (!split_is_good(m, e, p)) continue;
    double h = refine__size_at(r, p, tri_of(e), &carried);
    VertId v = tri_split_edge(m, p, e);
    if (v == NONE) continue;
    refine__added_vertex(r, v, h, carried);
    refine__wake_around(r, v);
    r->stats->inserted++, n++;
  }
  return n;
}

static size_t collapse_short(Refiner *r)
{
  Tri *m = r->m;
  size_t n = 0;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    if (tri_is_free(m, tri_of(e)) || !tri_is_inside(m, tri_of(e)) || tri_is_segment(m, e)) continue;
    VertId a = tri_org(m, e), b = tri_dest(m, e);
    if (length_of(r, a, b) < SHORT) n += refine__collapse(r, e, LEAST_QUALITY, LONG);
  }
  return n;
}

void refine__adapt(Refiner *r)
{
  for (int k = 0; k < MAX_SWEEPS; k++) {
    size_t changes = split_long(r) + collapse_short(r);
    refine__flips(r);
    refine__smooth(r, 2);
    if (changes == 0 || r->stats->outcome != REFINE_DONE) break;
  }
}
