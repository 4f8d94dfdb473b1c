// tri_rework.c - the worst triangles by trial: flip, collapse or split an edge, let the neighbourhood settle, keep what is better
// SPDX-License-Identifier: MIT
//
// Shapes and lengths have one common worth, so that trials which add or remove a vertex compare with those that do not: it is 0 in a
// lattice whose edges have the length wanted.
#include "base/base.h"
#include "tri/tri_trial.h"

// How much the lengths of edges count against the shapes of triangles.
#define LENGTH_WEIGHT 0.5
#define LEAST_GAIN 0.01
#define HOPE 1.4 // a trial that is worse than this times what was there, after its first round, is given up

typedef Vec(uint32_t) Times;

// A trial, and what has been tried.
typedef struct {
  Trial trial;
  Times changed, tried; // by vertex and by triangle: after which of the reworkings
  uint32_t now;
} Rework;

// Worth of the patch: shapes and lengths, the largest 1/kappa_4^2, how far the worst edge is out of [2/3, 4/3].
typedef struct {
  double sum, worst, range;
} Worth;

// ---- worth ---------------------------------------------------------------------------------------------------------

static Worth worth(const Trial *s)
{
  const Refiner *r = s->r;
  const Tri *m = r->m;
  TriId tri[TRIAL_PATCH + 8];
  Worth w = {0, 0, 1};
  int n = refine__trial_patch(s, tri);
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
    if (pass < 2) refine__trial_flips(s);
    if (pass == 0 && worth(s).sum > HOPE * limit) break;
  }
  r->floor = floor;
}

static bool apply(Trial *s, EdgeId e, TrialOperation op, double limit)
{
  if (!refine__trial_apply(s, e, op)) return false;
  settle(s, limit);
  return true;
}

// ---- the worst first -----------------------------------------------------------------------------------------------

static void grow(Times *t, size_t n)
{
  while (t->len < n) vec_push(t, 0);
}

// Has nothing near t changed since it was tried in vain?
static bool is_hopeless(const Rework *s, TriId t)
{
  const Tri *m = s->trial.r->m;
  if (t >= s->tried.len || s->tried.data[t] == 0) return false;
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
    VertId near[2] = {m->vert[e], tri_apex(m, m->twin[e])};
    for (int k = 0; k < 2; k++)
      if (near[k] != TRI_INF && near[k] < s->changed.len && s->changed.data[near[k]] > s->tried.data[t]) return false;
  }
  return true;
}

static void note_failure(Rework *s, TriId t)
{
  grow(&s->tried, (size_t)t + 1);
  s->tried.data[t] = s->now;
}

// After a change that is kept: whatever has a vertex of the patch may be tried again.
static void note_change(Rework *s)
{
  s->now++;
  grow(&s->changed, s->trial.r->m->nv);
  for (int i = 0; i < s->trial.nvert; i++) s->changed.data[s->trial.vertex[i].v] = s->now;
}

static bool is_gain(const Refiner *r, Worth before, Worth after, double least)
{
  return before.sum - after.sum > least && after.worst <= MAX(before.worst, r->floor) && after.range <= before.range;
}

// Long edges are not collapsed, short ones not split.
static bool is_worth_a_trial(const Refiner *r, EdgeId e, TrialOperation op)
{
  const Tri *m = r->m;
  VertId a = tri_org(m, e), b = tri_dest(m, e);
  if (op == TRIAL_SETTLE || op == TRIAL_FLIP) return true;
  double length = metric_length(tri_xy(m, a), tri_xy(m, b), r->size[a], r->size[b]);
  return op == TRIAL_SPLIT ? length >= 1 : length <= 1;
}

// What gains most, with the sizes of vertices kept. TRIAL_COUNT if nothing does.
static TrialOperation find_best(Refiner *r, TriId t, Trial *s, EdgeId *edge)
{
  TrialOperation best = TRIAL_COUNT;
  double gain = LEAST_GAIN;
  r->keep_sizes = true;
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
    if (tri_is_segment(r->m, e) || !refine__trial_save(s, r, e)) continue;
    Worth before = worth(s);
    for (TrialOperation op = TRIAL_SETTLE; op < TRIAL_COUNT; op++) {
      if (!is_worth_a_trial(r, e, op)) continue;
      if (apply(s, e, op, before.sum)) {
        Worth after = worth(s);
        if (is_gain(r, before, after, gain)) gain = before.sum - after.sum, best = op, *edge = e;
      }
      refine__trial_restore(s);
    }
  }
  r->keep_sizes = false;
  return best;
}

// Do what is best for triangle t; false if nothing helps.
static bool rework(Refiner *r, TriId t, Rework *s)
{
  EdgeId edge = NONE;
  Trial *trial = &s->trial;
  TrialOperation best = find_best(r, t, trial, &edge);
  if (best != TRIAL_COUNT && refine__trial_save(trial, r, edge)) {
    Worth before = worth(trial);
    if (apply(trial, edge, best, before.sum) && is_gain(r, before, worth(trial), LEAST_GAIN)) {
      note_change(s);
      return true;
    }
    refine__trial_restore(trial);
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
  Rework *s = mem_zalloc(sizeof *s);
  s->trial.r = r, s->now = 1;
  for (int k = 0; k < rounds; k++) {
    vec_clear(&bad);
    for (TriId t = 0; t < m->nt; t++) {
      if (!tri_is_inside(m, t)) continue;
      const uint32_t *v = m->vert + 3 * (size_t)t;
      if (metric_is_surely(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), least)) continue;
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
