// tri_polish.c - small faces: every vertex and every edge by trial, judged by what the whole mesh is worth
// SPDX-License-Identifier: MIT
//
// The cost of a mesh is the mean over triangles of what their shape costs plus a multiple of the mean over edges of what their length
// costs. An operation that changes the numbers of both is judged by sums from which the present means are subtracted, element by
// element: to first order their difference is that of the means [Dinkelbach67].
#include "base/base.h"
#include "tri/tri_polish.h"

enum { ROUNDS = 8, SWEEPS = 3 };
#define LEAST_GAIN 0.003
#define LEAST_PROGRESS 1e-4 // of the cost, in a round without operations
#define HOPE 0.3            // after the first settling, a trial may cost this share more than what was there, or it is given up
// What falls short of the reference: how its weight changes from round to round.
#define HARDER 1.3
#define SOFTER 0.9
// What MeshAdapt places vertices by at the end: the weight of the tail, and a factor for that of lengths.
#define LAST_TAIL 4.0
#define LAST_LENGTHS 3.2

// Cost of a star or a patch, largest 1/kappa_4^2, how far the worst edge is out of [2/3, 4/3].
typedef struct {
  double sum, worst, range;
} Worth;

double polish__size(Polish *q, VertId v, const double *p) { return refine__wanted(q->field, q->r, p, q->r->size[v]); }

// The means, and the weights that follow from them. Returns the cost.
static double measure(Polish *q)
{
  const Refiner *r = q->r;
  const Tri *m = r->m;
  double shape = 0, loss = 0, length = 0, ntri = 0, nedge = 0;
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    double g = metric_quality(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]));
    shape += polish__shape(q, 1 / g), loss += 1 - g;
    ntri++;
    for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
      double share = tri_is_segment(m, e) ? 1 : 0.5;
      VertId a = tri_org(m, e), b = tri_dest(m, e);
      length += share * polish__length(metric_length_graded(tri_xy(m, a), tri_xy(m, b), r->size[a], r->size[b]));
      nedge += share;
    }
  }
  q->shape = shape / ntri, q->loss = loss / ntri, q->length = length / nedge;
  q->weight = q->more_length * POLISH_LENGTHS * ntri / nedge;
  q->lift = POLISH_ANGLE * ntri;
  return q->shape + q->more_length * POLISH_LENGTHS * q->length;
}

// A mean that falls short of the reference counts more from now on, one that does not less again. True if one falls short.
static bool press(Polish *q)
{
  const PolishGoal *g = q->goal;
  bool longer = q->length > g->reference.length + POLISH_SLACK, flatter = q->loss > 1 - g->reference.gamma + POLISH_SLACK;
  q->more_length = longer ? q->more_length * HARDER : fmax(g->more_length, q->more_length * SOFTER);
  q->more_gamma = flatter ? q->more_gamma * HARDER : fmax(g->more_gamma, q->more_gamma * SOFTER);
  return longer || flatter;
}

// ---- vertices -------------------------------------------------------------------------------------------------------

static Worth star_worth(Polish *q, const Star *s, double px, double py, double h)
{
  Worth w = {0, 0, 1};
  double ux = s->x[0] - px, uy = s->y[0] - py, lu = sqrt(ux * ux + uy * uy);
  q->work++;
  for (int j = 0; j < s->n; j++) {
    double vx = s->x[j + 1] - px, vy = s->y[j + 1] - py, lv = sqrt(vx * vx + vy * vy);
    double d = ux * vy - uy * vx, b = s->base[j];
    double f = d > 0 ? lu * lv * b * (lu + lv + b) / (4 * d * d) : INFINITY;
    double l = lu * metric_density(h, s->h[j]), out = l > METRIC_LONG ? l / METRIC_LONG : METRIC_SHORT / l;
    w.sum += polish__shape(q, f) + q->weight * polish__length(l);
    w.worst = f > w.worst ? f : w.worst;
    w.range = out > w.range ? out : w.range;
    ux = vx, uy = vy, lu = lv;
  }
  return w;
}

// worst < 1e8 leaves the sign of every area beyond doubt in floating point.
static bool is_better(Worth n, Worth than, double worst, double range)
{
  return n.sum < than.sum - 1e-9 && n.worst <= worst && n.worst < 1e8 && n.range <= range;
}

// Pattern search for vertex v, first with steps of `first` sizes; no triangle above the larger of `limit` and the worst of the star.
static bool relocate(Polish *q, VertId v, double limit, double first)
{
  static const double way[6][2] = {{1, 0}, {.5, .8660254}, {-.5, .8660254}, {-1, 0}, {-.5, -.8660254}, {.5, -.8660254}};
  Refiner *r = q->r;
  Star s;
  double *at = r->m->xy + 2 * (size_t)v, p[2] = {at[0], at[1]}, h = r->size[v], step = first * h;
  if (!star_gather(r, v, &s)) return false;
  Worth best = star_worth(q, &s, p[0], p[1], h), start = best;
  double worst = fmax(start.worst, limit);
  int from = 0;
  for (int k = 0; k < 16 && step > 0.008 * h;) {
    int i = 0;
    for (; i < 6; i++) {
      const double *d = way[(from + i) % 6];
      Worth n = star_worth(q, &s, p[0] + step * d[0], p[1] + step * d[1], h);
      if (!is_better(n, best, worst, start.range)) continue;
      p[0] += step * d[0], p[1] += step * d[1];
      best = n, from = (from + i) % 6;
      break;
    }
    if (i == 6) step *= 0.4;
    else k++;
  }
  if (p[0] == at[0] && p[1] == at[1]) return false;
  h = polish__size(q, v, p);
  if (!is_better(star_worth(q, &s, p[0], p[1], h), start, worst, start.range)) return false;
  at[0] = p[0], at[1] = p[1];
  r->size[v] = h;
  r->stats->moves++;
  return true;
}

static void sweep(Polish *q)
{
  const Refiner *r = q->r;
  while (q->changed.len < r->m->nv) vec_push(&q->changed, 0);
  for (int pass = 0; pass < SWEEPS; pass++)
    for (VertId v = 0; v < r->m->nv; v++)
      if (!r->fixed[v] && q->work < q->budget && relocate(q, v, q->floor, pass ? 0.03 : 0.1)) q->changed.data[v] = q->now;
}

// ---- edges ----------------------------------------------------------------------------------------------------------

static Worth patch_worth(Polish *q)
{
  const Refiner *r = q->r;
  const Tri *m = r->m;
  TriId tri[TRIAL_PATCH + 8];
  Worth w = {0, 0, 1};
  int n = refine__trial_patch(&q->trial, tri);
  q->work += (uint64_t)n / 6;
  for (int i = 0; i < n; i++) {
    const uint32_t *v = m->vert + 3 * (size_t)tri[i];
    double g = metric_quality(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2])), f = g > 0 ? 1 / g : INFINITY;
    w.sum += polish__shape(q, f) - q->shape;
    w.worst = fmax(w.worst, f);
    for (int k = 0; k < 3; k++) { // an edge inside the patch is met twice
      VertId a = v[k], b = v[(k + 1) % 3];
      double l = metric_length_graded(tri_xy(m, a), tri_xy(m, b), r->size[a], r->size[b]);
      w.sum += 0.5 * q->weight * (polish__length(l) - q->length);
      w.range = fmax(w.range, l > METRIC_LONG ? l / METRIC_LONG : METRIC_SHORT / l);
    }
  }
  return w;
}

// Let the core find its place: quickly, and if the cost is then below `limit`, by searching.
static Worth settle(Polish *q, double limit)
{
  Refiner *r = q->r;
  Trial *s = &q->trial;
  double floor = r->floor;
  r->floor = INFINITY; // the operation may have made them bad at first
  for (int pass = 0; pass < 2; pass++) {
    for (int k = s->ncore; k-- > 0;)
      if (!r->fixed[s->core[k]]) refine__relocate(r, s->core[k]), q->work += 2;
    refine__trial_flips(s);
  }
  r->floor = floor;
  for (int k = 0; k < s->ncore; k++) // they have moved with the sizes of where they were
    if (!r->fixed[s->core[k]]) r->size[s->core[k]] = polish__size(q, s->core[k], tri_xy(r->m, s->core[k]));
  Worth w = patch_worth(q);
  if (w.sum > limit) return w;
  for (int pass = 0; pass < 2; pass++) {
    for (int k = s->ncore; k-- > 0;)
      if (!r->fixed[s->core[k]]) relocate(q, s->core[k], INFINITY, pass ? 0.03 : 0.1);
    if (pass == 0) refine__trial_flips(s);
  }
  return patch_worth(q);
}

static bool apply(Polish *q, EdgeId e, TrialOperation op)
{
  Trial *s = &q->trial;
  if (!refine__trial_apply(s, e, op)) return false;
  VertId v = s->core[4];
  if (op == TRIAL_SPLIT) q->r->size[v] = polish__size(q, v, tri_xy(q->r->m, v));
  return true;
}

// Clearly short edges are not split, long ones not collapsed.
static bool is_worth_a_trial(const Refiner *r, EdgeId e, TrialOperation op)
{
  const Tri *m = r->m;
  VertId a = tri_org(m, e), b = tri_dest(m, e);
  if (op == TRIAL_FLIP) return true;
  double l = metric_length_graded(tri_xy(m, a), tri_xy(m, b), r->size[a], r->size[b]);
  return op == TRIAL_SPLIT ? l >= 0.95 : l <= 1.05;
}

static void note_change(Polish *q)
{
  const Trial *s = &q->trial;
  q->now++;
  while (q->changed.len < q->r->m->nv) vec_push(&q->changed, 0);
  for (int i = 0; i < s->nvert; i++) q->changed.data[s->vertex[i].v] = q->now;
  for (int i = 0; i < s->ncore; i++) q->changed.data[s->core[i]] = q->now;
}

// Do what gains most at edge e; false if nothing helps.
static bool improve_edge(Polish *q, EdgeId e)
{
  Refiner *r = q->r;
  Trial *s = &q->trial;
  if (!refine__trial_save(s, r, e)) return false;
  Worth before = patch_worth(q);
  double gain = LEAST_GAIN, limit = before.sum + 0.1 + HOPE * fabs(before.sum);
  TrialOperation best = TRIAL_COUNT;
  r->keep_sizes = true;
  for (TrialOperation op = TRIAL_FLIP; op < TRIAL_COUNT; op++) {
    if (!is_worth_a_trial(r, e, op)) continue;
    if (apply(q, e, op)) {
      Worth after = settle(q, limit);
      bool allowed = after.worst <= fmax(before.worst, q->floor) && after.range <= before.range;
      if (allowed && before.sum - after.sum > gain) gain = before.sum - after.sum, best = op;
    }
    refine__trial_restore(s);
  }
  if (best != TRIAL_COUNT && apply(q, e, best)) settle(q, limit), note_change(q);
  r->keep_sizes = false;
  return best != TRIAL_COUNT;
}

// Has nothing near e changed since it was tried in vain?
static bool is_hopeless(Polish *q, EdgeId e)
{
  const Tri *m = q->r->m;
  while (q->tried.len < 3 * (size_t)m->nt) vec_push(&q->tried, 0);
  const VertId near[4] = {tri_org(m, e), tri_dest(m, e), tri_apex(m, e), tri_apex(m, m->twin[e])};
  for (int k = 0; k < 4; k++)
    if (q->changed.data[near[k]] >= q->tried.data[e]) return false;
  return true;
}

// An edge, and what it and its triangles cost.
typedef struct {
  double cost;
  EdgeId e;
  VertId a, b;
} Dear;
typedef Vec(Dear) DearVec;

static int dearer_first(const void *a, const void *b)
{
  const Dear *x = a, *y = b;
  if (x->cost != y->cost) return x->cost > y->cost ? -1 : 1;
  return (x->e > y->e) - (x->e < y->e);
}

static void list_edges(const Polish *q, DearVec *out)
{
  const Refiner *r = q->r;
  const Tri *m = r->m;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    EdgeId g = m->twin[e];
    if (!tri_is_inside(m, tri_of(e)) || g < e || tri_is_segment(m, e)) continue;
    VertId va = tri_org(m, e), vb = tri_dest(m, e);
    const double *a = tri_xy(m, va), *b = tri_xy(m, vb), *c = tri_xy(m, tri_apex(m, e)), *d = tri_xy(m, tri_apex(m, g));
    double cost = polish__shape(q, 1 / metric_quality(a, b, c)) + polish__shape(q, 1 / metric_quality(b, a, d)) +
                  q->weight * polish__length(metric_length_graded(a, b, r->size[va], r->size[vb]));
    vec_push(out, ((Dear){cost, e, va, vb}));
  }
  if (out->len) qsort(out->data, out->len, sizeof *out->data, dearer_first);
}

// Every edge, the dearest first. Returns how many changed.
static size_t improve_edges(Polish *q)
{
  const Tri *m = q->r->m;
  DearVec edges = {0};
  size_t n = 0;
  list_edges(q, &edges);
  for (size_t i = 0; i < edges.len && q->work < q->budget; i++) {
    const Dear *d = &edges.data[i];
    EdgeId e = d->e;
    if (tri_is_free(m, tri_of(e)) || tri_org(m, e) != d->a || tri_dest(m, e) != d->b || is_hopeless(q, e)) continue;
    if (improve_edge(q, e)) n++;
    else q->tried.data[e] = q->now + 1;
  }
  vec_free(&edges);
  return n;
}

// MeshAdapt is the strategy by lengths: at the end, vertices are placed for these first.
static void favour_lengths(Polish *q)
{
  q->tail = LAST_TAIL, q->more_length = LAST_LENGTHS, q->more_gamma = 1;
  measure(q);
}

// ---- entry ----------------------------------------------------------------------------------------------------------

PolishedMesh refine__polish(Refiner *r, RefineField *field, const PolishGoal *goal, bool strict, uint64_t budget)
{
  Polish *q = mem_zalloc(sizeof *q);
  q->r = r, q->field = field, q->goal = goal, q->budget = budget, q->now = 1;
  q->tail = POLISH_TAIL, q->more_gamma = goal->more_gamma, q->more_length = goal->more_length;
  q->floor = strict ? fmin(r->worst, POLISH_TOLERATED) : POLISH_TOLERATED;
  refine__field_apply(field, r);
  double cost = measure(q);
  for (int k = 0; k < ROUNDS && q->work < q->budget; k++) {
    sweep(q);
    refine__flips(r);
    measure(q);
    q->now++;
    size_t changes = improve_edges(q);
    double now = measure(q);
    bool falls_short = press(q);
    if (changes == 0 && now > cost - LEAST_PROGRESS && !falls_short) break;
    cost = measure(q);
  }
  q->budget += budget / 4;
  if (r->p->algorithm == REFINE_ADAPT) favour_lengths(q);
  sweep(q);
  measure(q);
  polish__sharpen(q);
  vec_free(&q->changed);
  vec_free(&q->tried);
  free(q);
  PolishFigures made = polish__figures(r);
  return (PolishedMesh){made, polish__cost(&made, &goal->reference)};
}
