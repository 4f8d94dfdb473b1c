// tri_attempt.c - a face meshed: once, or, where it is small, several times, and the best mesh polished
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/tri_polish.h"

// Slots for triangles of a face below which all its meshes are polished, polishing is brief, several meshes are polished.
enum { TINY = 60, SMALL = 165, REPEATED = 300 };
// How many meshes are polished; how often polishing is repeated with more weight on what got worse.
enum { POLISHED = 4, RAISES = 2 };
// Positions measured for one mesh: brief, of several, once. 0.1 us each.
enum { WORK_BRIEF = 3000, WORK_OF_SEVERAL = 14000, WORK_ONCE = 40000 };
// By how much more weight polishing is repeated.
#define RAISED 2.5
// With fewer triangles than this share of the first mesh's, a dip of the size field has been missed.
#define DIP_MISSED 0.6
// 1/gamma of the worst triangle: what it may end as, in terms of that of the first mesh before it was optimized.
#define ABOVE_WORST (1 + 1 / 60.)

// What vertices are placed by, in terms of the sizes: with few triangles, chance decides how well they fit.
static const double scales[] = {1, 0.9, 1.1, 0.95, 1.05, 0.975, 1.025};

static void clear_user_bits(Tri *m)
{
  for (TriId t = 0; t < m->nt; t++) m->flag[t] &= (uint8_t)~(REFINE_SMALL | REFINE_STUCK);
}

static bool is_lattice(const TriRefineParams *p)
{
  return p->algorithm == REFINE_FRONT_QUAD || p->algorithm == REFINE_PACK;
}

static void place_vertices(Refiner *r, VertId given)
{
  Tri *m = r->m;
  free(m->hint); // insertion need not keep it up
  m->hint = NULL;
  clear_user_bits(m);
  switch (r->p->algorithm) {
  case REFINE_EMPTY: break;
  case REFINE_ADAPT: refine__saturate(r); break;
  case REFINE_DELAUNAY: refine__delaunay(r, REFINE_LIMIT_SIZE); break;
  case REFINE_FRONTAL: refine__frontal(r); break;
  case REFINE_FRONT_QUAD: refine__front_quad(r, false); break;
  case REFINE_PACK: refine__front_quad(r, true); break;
  }
  clear_user_bits(m);
  refine__renumber(r, given);
  refine__prepare(r, given);
  if (r->p->algorithm == REFINE_ADAPT && r->stats->outcome == REFINE_DONE) {
    refine__adapt(r);
    refine__renumber(r, given);
    refine__prepare(r, given);
  }
  if (r->p->algorithm == REFINE_EMPTY || r->stats->outcome == REFINE_CANCELLED) return;
  if (!is_lattice(r->p)) refine__smooth(r, r->p->smoothing); // these have been smoothed their own way
  refine__optimize(r, r->p->optimize);
}

static double *copied(const double *x, size_t n)
{
  double *y = x ? mem_alloc(n * sizeof *y) : NULL;
  if (x) memcpy(y, x, n * sizeof *y);
  return y;
}

// The mesh out of the empty one, its vertices placed by `scale` times the sizes.
static void attempt(Refiner *r, VertId given, double scale)
{
  const TriRefineParams *p = r->p;
  TriRefineParams scaled = *p;
  ScaledSize size = {p->size, p->size_ctx, scale};
  double *wanted = scale != 1 ? copied(r->size, given) : NULL;
  if (scale != 1) {
    if (p->size) scaled.size = size_scaled, scaled.size_ctx = &size;
    for (VertId v = 0; v < given; v++) {
      r->size[v] *= scale;
      if (r->carried) r->carried[v] *= scale;
    }
    r->p = &scaled;
  }
  if (p->algorithm != REFINE_EMPTY) refine__reserve(r);
  place_vertices(r, given);
  r->p = p;
  if (wanted) memcpy(r->size, wanted, given * sizeof *wanted);
  free(wanted);
}

static bool can_be_polished(const Refiner *r)
{
  const TriRefineParams *p = r->p;
  return p->algorithm != REFINE_EMPTY && !is_lattice(p) && r->stats->outcome == REFINE_DONE && p->optimize > 0 &&
         r->m->nt < REFINE_POLISHED;
}

void refine__release(Refiner *r)
{
  free(r->size), free(r->carried), free(r->fixed), free(r->awake), free(r->excess);
  vec_free(&r->rim), vec_free(&r->dead), vec_free(&r->stack);
}

// ---- several meshes of one face -------------------------------------------------------------------------------------

// A mesh of its own.
typedef struct {
  Tri m;
  TriRefineStats stats;
  Refiner r;
} Other;

static Other *other_mesh(const Refiner *r, const Tri *start, VertId given, double scale)
{
  Other *o = mem_zalloc(sizeof *o);
  tri_copy(&o->m, start);
  o->stats = (TriRefineStats){.outcome = REFINE_DONE, .split = r->stats->split};
  o->r = (Refiner){.m = &o->m, .p = r->p, .stats = &o->stats, .max_vertices = r->max_vertices};
  refine__initial_sizes(&o->r);
  attempt(&o->r, given, scale);
  return o;
}

static void free_other(Other *o)
{
  if (!o) return;
  refine__release(&o->r);
  tri_free(&o->m);
  free(o);
}

// r's mesh becomes that of o.
static void take_other(Refiner *r, Other *o)
{
  Tri m = *r->m;
  *r->m = o->m, o->m = m;
  *r->stats = o->stats;
  Refiner old = *r;
  *r = o->r, r->m = old.m, r->stats = old.stats, r->p = old.p;
  o->r = old, o->r.m = &o->m, o->r.stats = &o->stats;
}

// A small face: what all its meshes have in common, and the best so far.
typedef struct {
  const Refiner *r; // the first mesh
  const Tri *start;
  VertId given;
  RefineField *field;
  PolishGoal goal;
  uint64_t work;
  Other *best; // NULL: none has been good enough
  double scale;
  PolishedMesh is;
} Choice;

// A mesh before it is polished: what placed its vertices, and what it costs.
typedef struct {
  double scale, cost;
  Other *mesh;
} Prospect;

static Prospect prospect(const Choice *c, double scale)
{
  Other *o = other_mesh(c->r, c->start, c->given, scale);
  refine__field_apply(c->field, &o->r);
  PolishFigures f = polish__figures(&o->r);
  return (Prospect){scale, o->m.nt < DIP_MISSED * c->r->m->nt ? INFINITY : polish__cost(&f, &c->goal.reference), o};
}

// The different meshes that the scales give, the cheapest first. Returns how many.
static size_t rank(const Choice *c, Prospect *p)
{
  size_t n = 0;
  for (size_t i = 0; i < ARRAY_LEN(scales); i++) {
    Prospect now = prospect(c, scales[i]);
    size_t k = n;
    while (k > 0 && p[k - 1].cost > now.cost) k--;
    if (isinf(now.cost) || (k > 0 && p[k - 1].cost == now.cost)) {
      free_other(now.mesh);
      continue;
    }
    memmove(p + k + 1, p + k, (n++ - k) * sizeof *p);
    p[k] = now;
  }
  return n;
}

// Polish a mesh, which is handed over; keep it if it is the best.
static void try_mesh(Choice *c, Other *o, double scale)
{
  PolishedMesh made = refine__polish(&o->r, c->field, &c->goal, false, c->work);
  if (made.figures.worst <= c->goal.bound && (!c->best || made.cost < c->is.cost)) {
    Other *old = c->best;
    c->best = o, c->is = made, c->scale = scale;
    o = old;
  }
  free_other(o);
}

// Give more weight to what the best mesh has worse than the reference. False if nothing is worse.
static bool raise_weights(Choice *c)
{
  PolishGoal *g = &c->goal;
  bool longer = c->is.figures.length > g->reference.length + POLISH_SLACK;
  bool flatter = c->is.figures.gamma < g->reference.gamma - POLISH_SLACK;
  if (longer) g->more_length *= RAISED;
  if (flatter) g->more_gamma *= RAISED;
  return longer || flatter;
}

static uint64_t work_for(uint32_t slots)
{
  return slots < SMALL ? WORK_BRIEF : slots < REPEATED ? WORK_OF_SEVERAL : WORK_ONCE;
}

static void choose_mesh(Refiner *r, const Tri *start, RefineField *field, VertId given)
{
  uint32_t slots = r->m->nt;
  bool small = slots < REPEATED;
  Prospect p[ARRAY_LEN(scales)];
  Choice c = {.r = r, .start = start, .given = given, .field = field, .work = work_for(slots)};
  refine__field_apply(field, r);
  double bound = fmax(r->worst, fmin(ABOVE_WORST * r->worst, POLISH_TOLERATED));
  c.goal = (PolishGoal){polish__figures(r), bound, 1, 1};
  size_t n = rank(&c, p), polished = slots < TINY ? n : MIN(n, small ? POLISHED : (size_t)1);
  for (size_t k = 0; k < polished; k++) try_mesh(&c, p[k].mesh, p[k].scale);
  for (size_t k = polished; k < n; k++) free_other(p[k].mesh);
  for (int k = 0; small && k < RAISES && c.best && raise_weights(&c); k++)
    try_mesh(&c, other_mesh(r, start, given, c.scale), c.scale);
  if (c.best) {
    take_other(r, c.best);
  } else {
    c.goal.more_gamma = c.goal.more_length = 1;
    refine__polish(r, field, &c.goal, true, c.work);
  }
  free_other(c.best);
}

void refine__make_mesh(Refiner *r, VertId given)
{
  Tri start;
  RefineField field;
  tri_copy(&start, r->m);
  refine__initial_sizes(r);
  refine__field_take(&field, r);
  attempt(r, given, 1);
  if (can_be_polished(r)) choose_mesh(r, &start, &field, given);
  if (r->stats->collapses) refine__drop_isolated(r, given);
  refine__field_free(&field);
  tri_free(&start);
}
