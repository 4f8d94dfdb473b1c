// tri_rework.c - the worst triangles by trial: flip, collapse or split an edge, let the neighbourhood settle, keep what is better
// SPDX-License-Identifier: MIT
//
// A trial may change the triangles about the four vertices of an edge and nothing else. These are saved before, so that whatever was
// done is undone by putting the records back. Shapes and lengths have one common worth, so that trials which add or remove a vertex
// compare with those that do not: it is 0 in a lattice whose edges have the length wanted.
#include "base/base.h"
#include "tri/refine_int.h"

enum { MAX_PATCH = 96 };

// How much the lengths of edges count against the shapes of triangles.
#define LENGTH_WEIGHT 0.5
#define LEAST_GAIN 0.01
#define HOPE 1.4 // a trial that is worse than this times what was there, after its first round, is given up

typedef struct {
  TriId t;
  uint32_t vert[3], twin[3], seg[3], region;
  uint8_t flag;
} SavedTriangle;

typedef struct {
  VertId v;
  double xy[2], size, carried;
  EdgeId hint;
  int16_t excess;
  bool fixed;
} SavedVertex;

typedef Vec(uint32_t) Times;

typedef struct {
  Refiner *r;
  Times changed, tried; // by vertex and by triangle: after which of the reworkings
  uint32_t now;
  VertId core[5]; // vertices that may move
  int ncore;
  int npatch, ntri;  // the first npatch triangles are the patch, then come its neighbours and the next free ones
  int nvert;
  SavedTriangle tri[3 * MAX_PATCH + 4];
  SavedVertex vertex[3 * MAX_PATCH];
  uint32_t nt, nv, nfree;
  TriId free_list;
  EdgeId last;
  TriRefineStats stats;
} Trial;

// Worth of the patch: shapes and lengths, the largest 1/kappa_4^2, how far the worst edge is out of [2/3, 4/3].
typedef struct {
  double sum, worst, range;
} Worth;

typedef enum { OP_SETTLE, OP_FLIP, OP_COLLAPSE, OP_COLLAPSE_BACK, OP_SPLIT, OP_COUNT } Operation;

// ---- saving and restoring ------------------------------------------------------------------------------------------

static bool save_triangle(Trial *s, TriId t)
{
  const Tri *m = s->r->m;
  for (int i = 0; i < s->ntri; i++)
    if (s->tri[i].t == t) return true;
  if (s->ntri == (int)ARRAY_LEN(s->tri)) return false;
  SavedTriangle *x = &s->tri[s->ntri++];
  x->t = t, x->flag = m->flag[t], x->region = m->region ? m->region[t] : 0;
  for (int i = 0; i < 3; i++)
    x->vert[i] = m->vert[3 * t + (uint32_t)i], x->twin[i] = m->twin[3 * t + (uint32_t)i], x->seg[i] = m->seg[3 * t + (uint32_t)i];
  return true;
}

static bool save_vertex(Trial *s, VertId v)
{
  const Refiner *r = s->r;
  if (v == TRI_INF) return true;
  for (int i = 0; i < s->nvert; i++)
    if (s->vertex[i].v == v) return true;
  if (s->nvert == (int)ARRAY_LEN(s->vertex)) return false;
  s->vertex[s->nvert++] = (SavedVertex){v, {tri_xy(r->m, v)[0], tri_xy(r->m, v)[1]}, r->size[v], r->carried ? r->carried[v] : 0,
                                        r->m->hint[v], r->excess[v], r->fixed[v]};
  return true;
}

// The patch about edge e. False if it is too large.
static bool save(Trial *s, Refiner *r, EdgeId e)
{
  Tri *m = r->m;
  s->r = r, s->npatch = s->ntri = s->nvert = 0, s->ncore = 4;
  s->core[0] = tri_org(m, e), s->core[1] = tri_dest(m, e), s->core[2] = tri_apex(m, e), s->core[3] = tri_apex(m, m->twin[e]);
  for (int k = 0; k < 4; k++) {
    EdgeId first = m->hint[s->core[k]], f = first;
    do {
      if (tri_is_inside(m, tri_of(f)) && (s->ntri >= MAX_PATCH || !save_triangle(s, tri_of(f)))) return false;
      f = tri_ccw(m, f);
    } while (f != first);
  }
  s->npatch = s->ntri;
  for (int i = 0; i < s->npatch; i++)
    for (EdgeId f = 3 * s->tri[i].t; f < 3 * s->tri[i].t + 3; f++)
      if (!save_vertex(s, m->vert[f]) || !save_triangle(s, tri_of(m->twin[f]))) return false;
  TriId next = m->free_list;
  for (uint32_t k = 0; k < 2 && k < m->nfree; k++, next = m->twin[3 * (size_t)next])
    if (!save_triangle(s, next)) return false;
  s->nt = m->nt, s->nv = m->nv, s->nfree = m->nfree, s->free_list = m->free_list, s->last = m->last, s->stats = *r->stats;
  return true;
}

static void restore(Trial *s)
{
  Refiner *r = s->r;
  Tri *m = r->m;
  for (int i = 0; i < s->ntri; i++) {
    const SavedTriangle *x = &s->tri[i];
    m->flag[x->t] = x->flag;
    if (m->region) m->region[x->t] = x->region;
    for (uint32_t k = 0; k < 3; k++)
      m->vert[3 * x->t + k] = x->vert[k], m->twin[3 * x->t + k] = x->twin[k], m->seg[3 * x->t + k] = x->seg[k];
  }
  for (int i = 0; i < s->nvert; i++) {
    const SavedVertex *x = &s->vertex[i];
    m->xy[2 * (size_t)x->v] = x->xy[0], m->xy[2 * (size_t)x->v + 1] = x->xy[1];
    r->size[x->v] = x->size, m->hint[x->v] = x->hint, r->excess[x->v] = x->excess, r->fixed[x->v] = x->fixed;
    if (r->carried) r->carried[x->v] = x->carried;
  }
  m->nt = s->nt, m->nv = s->nv, m->nfree = s->nfree, m->free_list = s->free_list, m->last = s->last, *r->stats = s->stats;
  s->ncore = 4;
}

// The triangles of the patch as it is now. Returns how many.
static int patch_now(const Trial *s, TriId *out)
{
  const Tri *m = s->r->m;
  int n = 0;
  for (int i = 0; i < s->ntri; i++) {
    bool was_free = s->tri[i].flag & TRI_FREE;
    if ((i < s->npatch || was_free) && tri_is_inside(m, s->tri[i].t)) out[n++] = s->tri[i].t;
  }
  for (TriId t = s->nt; t < m->nt; t++)
    if (tri_is_inside(m, t)) out[n++] = t;
  return n;
}

// ---- worth ---------------------------------------------------------------------------------------------------------

static Worth worth(const Trial *s)
{
  const Refiner *r = s->r;
  const Tri *m = r->m;
  TriId tri[MAX_PATCH + 8];
  Worth w = {0, 0, 1};
  int n = patch_now(s, tri);
  for (int i = 0; i < n; i++) {
    const uint32_t *v = m->vert + 3 * (size_t)tri[i];
    double q = metric_quality(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]));
    double f = q > 0 ? 1 / q : INFINITY;
    w.sum += f * f - 1; // the square, so that one bad triangle does not pay for several fair ones
    if (f > w.worst) w.worst = f;
    for (int k = 0; k < 3; k++) { // an edge inside the patch is met twice
      VertId a = v[k], b = v[(k + 1) % 3];
      double l = metric_length(tri_xy(m, a), tri_xy(m, b), r->size[a], r->size[b]);
      w.sum += 0.5 * LENGTH_WEIGHT * (l + 1 / l - 2);
      double out = l > METRIC_LONG ? l / METRIC_LONG : METRIC_SHORT / l;
      if (out > w.range) w.range = out;
    }
  }
  return w;
}

// ---- operations ----------------------------------------------------------------------------------------------------

static bool in_patch(const TriId *tri, int n, TriId t)
{
  for (int i = 0; i < n; i++)
    if (tri[i] == t) return true;
  return false;
}

// Flip inside the patch what makes the worse of two triangles better.
static void flip_patch(Trial *s)
{
  Tri *m = s->r->m;
  TriId tri[MAX_PATCH + 8];
  int n = patch_now(s, tri);
  for (int i = 0; i < n; i++)
    for (EdgeId e = 3 * tri[i]; e < 3 * tri[i] + 3; e++) {
      EdgeId g = m->twin[e];
      if (tri_is_segment(m, e) || !in_patch(tri, n, tri_of(g))) continue;
      const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
      const double *c = tri_xy(m, tri_apex(m, e)), *d = tri_xy(m, tri_apex(m, g));
      double now = MIN(metric_quality(a, b, c), metric_quality(b, a, d));
      if (MIN(metric_quality(c, d, b), metric_quality(d, c, a)) <= now + 1e-6 || !tri_can_flip(m, e)) continue;
      refine__flip(s->r, e);
      s->r->stats->flips++;
    }
}

// Let the vertices of the edge, and flips among the triangles about them, find their best; given up when after the first round
// the worth is more than HOPE times `limit`.
static void settle(Trial *s, double limit)
{
  Refiner *r = s->r;
  double floor = r->floor;
  r->floor = INFINITY;
  for (int pass = 0; pass < 3; pass++) {
    for (int k = 0; k < s->ncore; k++)
      if (!r->fixed[s->core[k]] && (pass < 1 || !refine__relocate_worst(r, s->core[k]))) refine__relocate(r, s->core[k]);
    if (pass < 2) flip_patch(s);
    if (pass == 0 && worth(s).sum > HOPE * limit) break;
  }
  r->floor = floor;
}

static bool split(Trial *s, EdgeId e)
{
  Refiner *r = s->r;
  Tri *m = r->m;
  const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
  double p[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}, carried;
  if (m->nv >= r->max_vertices) return false;
  double h = refine__size_at(r, p, tri_of(e), &carried);
  VertId v = tri_split_edge(m, p, e);
  if (v == NONE) return false;
  refine__added_vertex(r, v, h, carried);
  r->stats->inserted++;
  s->core[s->ncore++] = v;
  return true;
}

static bool collapse(Trial *s, EdgeId e)
{
  Refiner *r = s->r;
  Tri *m = r->m;
  VertId a = tri_org(m, e);
  if (r->fixed[a] || !tri_can_collapse(m, e)) return false;
  tri_collapse(m, e);
  r->fixed[a] = true; // isolated now
  r->stats->collapses++;
  return true;
}

static bool apply(Trial *s, EdgeId e, Operation op, double limit)
{
  bool good = true;
  switch (op) {
  case OP_SETTLE: break;
  case OP_FLIP:
    good = tri_can_flip(s->r->m, e);
    if (good) refine__flip(s->r, e), s->r->stats->flips++;
    break;
  case OP_COLLAPSE: good = collapse(s, e); break;
  case OP_COLLAPSE_BACK: good = collapse(s, s->r->m->twin[e]); break;
  case OP_SPLIT: good = split(s, e); break;
  case OP_COUNT: good = false; break;
  }
  if (good) settle(s, limit);
  return good;
}

// ---- the worst first -----------------------------------------------------------------------------------------------

static void grow(Times *t, size_t n)
{
  while (t->len < n) vec_push(t, 0);
}

// Has nothing near t changed since it was tried in vain?
static bool is_hopeless(const Trial *s, TriId t)
{
  const Tri *m = s->r->m;
  if (t >= s->tried.len || s->tried.data[t] == 0) return false;
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
    VertId near[2] = {m->vert[e], tri_apex(m, m->twin[e])};
    for (int k = 0; k < 2; k++)
      if (near[k] != TRI_INF && near[k] < s->changed.len && s->changed.data[near[k]] > s->tried.data[t]) return false;
  }
  return true;
}

static void note_failure(Trial *s, TriId t)
{
  grow(&s->tried, (size_t)t + 1);
  s->tried.data[t] = s->now;
}

// After a change that is kept: whatever has a vertex of the patch may be tried again.
static void note_change(Trial *s)
{
  s->now++;
  grow(&s->changed, s->r->m->nv);
  for (int i = 0; i < s->nvert; i++) s->changed.data[s->vertex[i].v] = s->now;
}

static bool is_gain(const Refiner *r, Worth before, Worth after, double least)
{
  return before.sum - after.sum > least && after.worst <= MAX(before.worst, r->floor) && after.range <= before.range;
}

// Long edges are not collapsed, short ones not split.
static bool is_worth_a_trial(const Refiner *r, EdgeId e, Operation op)
{
  const Tri *m = r->m;
  VertId a = tri_org(m, e), b = tri_dest(m, e);
  if (op == OP_SETTLE || op == OP_FLIP) return true;
  double length = metric_length(tri_xy(m, a), tri_xy(m, b), r->size[a], r->size[b]);
  return op == OP_SPLIT ? length >= 1 : length <= 1;
}

// What gains most, with the sizes of vertices kept. OP_COUNT if nothing does.
static Operation find_best(Refiner *r, TriId t, Trial *s, EdgeId *edge)
{
  Operation best = OP_COUNT;
  double gain = LEAST_GAIN;
  r->keep_sizes = true;
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
    if (tri_is_segment(r->m, e) || !save(s, r, e)) continue;
    Worth before = worth(s);
    for (Operation op = OP_SETTLE; op < OP_COUNT; op++) {
      if (!is_worth_a_trial(r, e, op)) continue;
      if (apply(s, e, op, before.sum)) {
        Worth after = worth(s);
        if (is_gain(r, before, after, gain)) gain = before.sum - after.sum, best = op, *edge = e;
      }
      restore(s);
    }
  }
  r->keep_sizes = false;
  return best;
}

// Do what is best for triangle t; false if nothing helps.
static bool rework(Refiner *r, TriId t, Trial *s)
{
  EdgeId edge = NONE;
  Operation best = find_best(r, t, s, &edge);
  if (best != OP_COUNT && save(s, r, edge)) {
    Worth before = worth(s);
    if (apply(s, edge, best, before.sum) && is_gain(r, before, worth(s), LEAST_GAIN)) {
      note_change(s);
      return true;
    }
    restore(s);
  }
  note_failure(s, t);
  return false;
}

typedef struct {
  double quality;
  TriId t;
} Bad;

static int worse_first(const void *a, const void *b)
{
  const Bad *x = a, *y = b;
  if (x->quality != y->quality) return x->quality < y->quality ? -1 : 1;
  return (x->t > y->t) - (x->t < y->t);
}

void refine__rework(Refiner *r, double least, size_t most, int rounds)
{
  Tri *m = r->m;
  Vec(Bad) bad = {0};
  Trial *s = mem_zalloc(sizeof *s);
  s->r = r, s->now = 1;
  for (int k = 0; k < rounds; k++) {
    vec_clear(&bad);
    for (TriId t = 0; t < m->nt; t++) {
      if (!tri_is_inside(m, t)) continue;
      const uint32_t *v = m->vert + 3 * (size_t)t;
      Bad b = {metric_quality(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2])), t};
      if (b.quality < least) vec_push(&bad, b);
    }
    if (!bad.len) break;
    qsort(bad.data, bad.len, sizeof *bad.data, worse_first);
    size_t better = 0;
    for (size_t i = 0; i < bad.len && i < most; i++) {
      TriId t = bad.data[i].t;
      if (tri_is_free(m, t) || is_hopeless(s, t)) continue;
      const uint32_t *v = m->vert + 3 * (size_t)t;
      if (metric_quality(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2])) < least) better += rework(r, t, s);
    }
    if (!better) break;
  }
  vec_free(&s->changed);
  vec_free(&s->tried);
  free(s);
  vec_free(&bad);
}
