// mesh1d.c - which rule meshes which curve, and the order of things
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh1d.h"

#include <math.h>

#include "base/map.h"
#include "base/mem.h"
#include "base/thread.h"
#include "mesh/mesh1d_int.h"

// ---- rules --------------------------------------------------------------------------------------------------------------

// Meshed as part of another curve.
static bool is_follower(const Curve *c) { return c && c->joined && c->joined != c->tag; }

static CurveRule rule_of(const Mesher1d *d, const Curve *c)
{
  bool none = c->degenerate || c->dissolved || is_follower(c);
  double length = none ? 0 : curve_length(d->m, c);
  if (!(length > 0) || length <= d->opt->Mesh_ToleranceEdgeLength) return RULE_NONE;
  if (c->copy_of || c->periodic_master) return RULE_COPY;
  if (c->extruded_point && c->layers.n > 0) return RULE_LAYERS;
  return c->transfinite > 0 ? RULE_LAW : RULE_SIZE;
}

// Flexible counts follow the size factor [Mesh.FlexibleTransfinite].
static uint32_t law_segments(const Mesher1d *d, const Curve *c)
{
  int n = c->transfinite;
  if (d->opt->Mesh_FlexibleTransfinite) n = (int)fmin(n / d->opt->Mesh_MeshSizeFactor, 1e9);
  return (uint32_t)MAX(n - 1, 1);
}

static uint32_t layer_segments(const Layers *l)
{
  uint32_t n = 0;
  for (int i = 0; i < l->n; i++) n += (uint32_t)MAX(l->count[i], 0);
  return MAX(n, 1u);
}

// A loop of one curve needs three edges and one of two curves two on each, to enclose anything.
static void raise_least_counts(Mesher1d *d)
{
  for (size_t k = 0; k < model_faces(d->m); k++) {
    const Face *f = model_face_at(d->m, k);
    for (int i = 0; i < f->nloop; i++) {
      const Loop *loop = model_loop(d->m, f->loop[i]);
      int n = 0;
      for (int j = 0; loop && j < loop->ncurve; j++) n += !is_follower(model_curve(d->m, loop->curve[j]));
      for (int j = 0; n <= 2 && loop && j < loop->ncurve; j++) {
        uint32_t c = mesh1d_index(d->g, loop->curve[j]);
        if (c != NONE) d->work[c].least = MAX(d->work[c].least, n == 1 ? 3u : 2u);
      }
    }
  }
}

// Two lines between the same points, both in loops, are the sides of a crack: it opens where each has a node of its own.
static void open_cracks(Mesher1d *d)
{
  Map line = {0}; // ends -> the first line between them that is in a loop
  for (size_t k = 0; k < model_faces(d->m); k++) {
    const Face *f = model_face_at(d->m, k);
    for (int i = 0; i < f->nloop; i++) {
      const Loop *loop = model_loop(d->m, f->loop[i]);
      for (int j = 0; loop && j < loop->ncurve; j++) {
        uint32_t c = mesh1d_index(d->g, loop->curve[j]);
        if (c == NONE || d->work[c].c->type != CURVE_LINE) continue;
        uint32_t other = *map_slot(&line, map_pair((uint32_t)d->work[c].c->begin, (uint32_t)d->work[c].c->end), c, NULL);
        if (other != c) d->work[c].least = MAX(d->work[c].least, 2u), d->work[other].least = MAX(d->work[other].least, 2u);
      }
    }
  }
  map_free(&line);
}

static uint32_t master_of(const Mesher1d *d, size_t k)
{
  const Curve *c = d->work[k].c;
  return mesh1d_index(d->g, c->copy_of ? c->copy_of : c->periodic_master);
}

// An extrusion that closes on itself makes its first curve a copy of the last: of such a ring the first curve is meshed on its own.
static void open_rings(Mesher1d *d)
{
  uint32_t *seen = mem_zalloc((d->g->ncurve + 1) * sizeof *seen); // k + 1 of the walk that was here
  for (uint32_t k = 0; k < d->g->ncurve; k++) {
    uint32_t at = k;
    while (at != NONE && d->work[at].rule == RULE_COPY && !seen[at]) {
      seen[at] = k + 1;
      at = master_of(d, at);
    }
    // Back on this walk's own trail: a ring, entered at its member of the lowest index met.
    if (at == NONE || d->work[at].rule != RULE_COPY || seen[at] != k + 1) continue;
    uint32_t least = at;
    for (uint32_t i = master_of(d, at); i != at; i = master_of(d, i)) least = MIN(least, i);
    d->work[least].rule = d->work[least].c->transfinite > 0 ? RULE_LAW : RULE_SIZE;
  }
  free(seen);
}

static void choose_rules(Mesher1d *d)
{
  for (size_t k = 0; k < d->g->ncurve; k++) {
    CurveWork *w = &d->work[k];
    w->c = model_curve_at(d->m, k);
    w->rule = rule_of(d, w->c);
  }
  open_rings(d);
  for (size_t k = 0; k < d->g->ncurve; k++) {
    CurveWork *w = &d->work[k];
    w->fixed = w->rule != RULE_SIZE && !(w->rule == RULE_LAW && d->opt->Mesh_FlexibleTransfinite);
    if (w->rule == RULE_LAW) w->segments = law_segments(d, w->c);
    if (w->rule == RULE_LAYERS) w->segments = layer_segments(&w->c->layers);
  }
  raise_least_counts(d);
  open_cracks(d);
}

// ---- in parallel ------------------------------------------------------------------------------------------------------------

static void measure_one(void *ctx, size_t k, int worker)
{
  Mesher1d *d = ctx;
  if (d->work[k].rule != RULE_SIZE) return;
  mesh1d__measure(d, k, d->eval[worker]);
  Diag *sink = diag_child(d->diag);
  if (size_eval_report(d->eval[worker], sink)) {
    diag_note(sink, d->work[k].c->loc, "met while meshing curve %d", d->work[k].c->tag);
    d->sink[k] = sink;
  } else if (size_eval_warn(d->eval[worker], sink)) {
    d->sink[k] = sink;
  } else {
    diag_free(sink);
  }
}

static void place_law(const Mesher1d *d, const CurveWork *w, CurveMesh *cm)
{
  mesh1d__resize(cm, w->segments + 1);
  double *s = cm->h; // free until the sizes come
  law_fractions(w->c->law, w->c->coef, cm->n, s);
  curve_at_fractions(d->m, w->c, s, cm->n, cm->u);
}

static void place_layers(const CurveWork *w, CurveMesh *cm)
{
  const Layers *l = &w->c->layers;
  mesh1d__resize(cm, w->segments + 1);
  uint32_t at = 0;
  cm->u[at++] = 0;
  double from = 0;
  for (int i = 0; i < l->n; i++) {
    for (int k = 1; k <= l->count[i]; k++) cm->u[at++] = from + (l->height[i] - from) * k / l->count[i];
    from = l->height[i];
  }
  if (at == 1) at++;
  cm->u[at - 1] = 1;
}

// Where counts are prescribed the size at a node is the mean length of its edges.
static void sizes_from_edges(CurveMesh *cm)
{
  double before = vec3_distance(cm->p[0], cm->p[1]);
  for (uint32_t i = 0; i < cm->n; i++) {
    double after = i + 1 < cm->n ? vec3_distance(cm->p[i], cm->p[i + 1]) : before;
    cm->h[i] = (before + after) / 2;
    before = after;
  }
}

static void place_one(void *ctx, size_t k, int worker)
{
  Mesher1d *d = ctx;
  CurveWork *w = &d->work[k];
  CurveMesh *cm = &d->g->curve[k];
  if (w->rule == RULE_SIZE || w->rule == RULE_GRADED) {
    mesh1d__place(d, k, d->eval[worker]);
  } else if (w->rule == RULE_LAW || w->rule == RULE_LAYERS) {
    if (w->rule == RULE_LAW) place_law(d, w, cm);
    else place_layers(w, cm);
    mesh1d__positions(d->m, w->c, cm);
    sizes_from_edges(cm);
  }
}

// ---- copies --------------------------------------------------------------------------------------------------------------------

static Vec3 apply_affine(const double *a, Vec3 p)
{
  return (Vec3){a[0] * p.x + a[1] * p.y + a[2] * p.z + a[3], a[4] * p.x + a[5] * p.y + a[6] * p.z + a[7],
                a[8] * p.x + a[9] * p.y + a[10] * p.z + a[11]};
}

static void copy_parameters(const CurveMesh *from, CurveMesh *to, bool reversed)
{
  for (uint32_t i = 0; i < to->n; i++) {
    uint32_t j = reversed ? to->n - 1 - i : i;
    to->u[i] = reversed ? 1 - from->u[j] : from->u[j];
    to->h[i] = from->h[j];
  }
}

// The master's nodes carried over by the map; false if they do not fall on the curve.
static bool copy_mapped(Mesher1d *d, const Curve *c, const CurveMesh *from, CurveMesh *to, bool reversed)
{
  double allowed = fmax(1e-6 * curve_length(d->m, c), d->opt->Geometry_Tolerance * size_diagonal(d->size));
  for (uint32_t i = 0; i < to->n; i++) {
    uint32_t j = reversed ? to->n - 1 - i : i;
    Vec3 p = apply_affine(c->affine, from->p[j]);
    double u = i == 0 ? 0 : i + 1 == to->n ? 1 : curve_nearest(d->m, c, p);
    Vec3 on = curve_point(d->m, c, u);
    if (vec3_distance(p, on) > allowed) {
      diag_error(d->diag, c->loc, "curve %d is not the image of its periodic master %d: the map takes (%g, %g, %g) %g away from it",
                 c->tag, c->periodic_master, from->p[j].x, from->p[j].y, from->p[j].z, vec3_distance(p, on));
      return false;
    }
    to->u[i] = u;
    to->h[i] = from->h[j];
  }
  return true;
}

static bool copy_curve(Mesher1d *d, size_t k, size_t master, int signed_tag)
{
  const Curve *c = d->work[k].c;
  const CurveMesh *from = &d->g->curve[master];
  CurveMesh *to = &d->g->curve[k];
  if (from->n == 0) return true; // the copy of a curve without mesh has none
  mesh1d__resize(to, from->n);
  bool mapped = !c->copy_of && c->affine;
  if (mapped && !copy_mapped(d, c, from, to, signed_tag < 0)) return false;
  if (!mapped) copy_parameters(from, to, signed_tag < 0);
  for (uint32_t i = 1; i < to->n; i++) {
    if (to->u[i] > to->u[i - 1]) continue;
    diag_error(d->diag, c->loc, "curve %d cannot have the mesh of its periodic master %d: its nodes come in another order", c->tag,
               signed_tag);
    return false;
  }
  mesh1d__positions(d->m, c, to);
  return true;
}

// Follow masters to one that is meshed, then copy back along the way. There are no rings (open_rings).
static bool resolve_copy(Mesher1d *d, size_t k)
{
  CurveWork *w = &d->work[k];
  if (w->rule != RULE_COPY) return true;
  int tag = w->c->copy_of ? w->c->copy_of : w->c->periodic_master;
  uint32_t master = master_of(d, k);
  if (master == NONE) {
    diag_error(d->diag, w->c->loc, "curve %d copies the mesh of curve %d, which does not exist", w->c->tag, tag);
    return false;
  }
  if (!resolve_copy(d, master) || !copy_curve(d, k, master, tag)) return false;
  w->segments = d->g->curve[k].n ? d->g->curve[k].n - 1 : 0;
  w->rule = d->work[master].rule == RULE_NONE ? RULE_NONE : RULE_LAW; // done
  return true;
}

static bool resolve_copies(Mesher1d *d)
{
  bool good = true;
  for (size_t k = 0; k < d->g->ncurve; k++) good = resolve_copy(d, k) && good;
  return good;
}

// ---- limits ----------------------------------------------------------------------------------------------------------------------

static bool check_total(Mesher1d *d)
{
  double total = 0, most = -1;
  size_t worst = 0;
  for (size_t k = 0; k < d->g->ncurve; k++) {
    const CurveWork *w = &d->work[k];
    double n = w->rule == RULE_SIZE || w->rule == RULE_GRADED ? fmax(w->a, w->segments) : w->segments;
    total += n;
    if (n > most) most = n, worst = k;
  }
  if (total <= d->opt->Mesh_MaxElements && total < 2e9) return true;
  const Curve *c = d->work[worst].c;
  diag_error(d->diag, c->loc, "the curves would get %.3g edges, more than Mesh.MaxElements = %g; curve %d alone %.3g", total,
             d->opt->Mesh_MaxElements, c->tag, most);
  Str why = {0};
  Vec3 p = curve_point(d->m, c, 0.5);
  size_responsible(d->eval[0], NULL, c, p, &why);
  diag_note(d->diag, NO_LOC, "in its middle (%g, %g) the size is fixed by %s", p.x, p.y, str_text(&why));
  str_free(&why);
  return false;
}

// What was met on the first curve of bad sizes; the others are counted.
static bool merge_messages(Mesher1d *d)
{
  int before = diag_errors(d->diag);
  size_t more = 0;
  bool warned = false;
  for (size_t k = 0; k < d->g->ncurve; k++) {
    if (!d->sink[k]) continue;
    bool bad = diag_errors(d->sink[k]) > 0, told = bad ? diag_errors(d->diag) > before : warned;
    more += bad && told;
    warned = warned || !bad;
    if (told) diag_free(d->sink[k]);
    else diag_merge(d->diag, d->sink[k]);
    d->sink[k] = NULL;
  }
  if (more) diag_note(d->diag, NO_LOC, "and the sizes on %zu more curves are bad", more);
  return diag_errors(d->diag) == before;
}

static bool mesh_curves(Mesher1d *d, int threads)
{
  choose_rules(d);
  thread_for(d->g->ncurve, threads, measure_one, d);
  if (!merge_messages(d)) return false;
  if (size_gradation(d->size) > 0) mesh1d__grade_all(d, size_gradation(d->size));
  if (!check_total(d)) return false;
  mesh1d__settle_parity(d);
  thread_for(d->g->ncurve, threads, place_one, d);
  return resolve_copies(d) && mesh1d__untangle(d->g, d->opt, d->meet, d->diag);
}

Mesh1d *mesh1d_new(const Model *m, const Options *opt, const SizeField *size, Diag *diag)
{
  return mesh1d_try(m, opt, size, NULL, diag);
}

Mesh1d *mesh1d_try(const Model *m, const Options *opt, const SizeField *size, CurveMeetings *meet, Diag *diag)
{
  Mesh1d *g = mem_zalloc(sizeof *g);
  g->model = m;
  g->ncurve = model_curves(m);
  g->curve = mem_zalloc((g->ncurve + 1) * sizeof *g->curve);
  int threads = opt->General_NumThreads;
  Mesher1d d = {.m = m, .opt = opt, .size = size, .diag = diag, .meet = meet, .g = g, .workers = thread_count(threads)};
  d.work = mem_zalloc((g->ncurve + 1) * sizeof *d.work);
  d.sink = mem_zalloc((g->ncurve + 1) * sizeof *d.sink);
  d.eval = mem_alloc((size_t)d.workers * sizeof *d.eval);
  for (int i = 0; i < d.workers; i++) d.eval[i] = size_eval_new(size);
  bool good = mesh_curves(&d, threads);
  for (int i = 0; i < d.workers; i++) size_eval_free(d.eval[i]);
  for (size_t k = 0; k < g->ncurve; k++) mesh1d__release(&d.work[k]);
  free(d.eval);
  free(d.sink);
  free(d.work);
  if (good) return g;
  mesh1d_free(g);
  return NULL;
}

void mesh1d_free(Mesh1d *g)
{
  if (!g) return;
  for (size_t k = 0; k < g->ncurve; k++) {
    free(g->curve[k].u);
    free(g->curve[k].p);
    free(g->curve[k].h);
  }
  free(g->curve);
  free(g);
}

// ---- access and changes ------------------------------------------------------------------------------------------------------------

uint32_t mesh1d_index(const Mesh1d *g, int tag)
{
  if (tag < 0) tag = -tag;
  size_t lo = 0, hi = g->ncurve;
  while (lo < hi) {
    size_t mid = (lo + hi) / 2;
    if (model_curve_at(g->model, mid)->tag < tag) lo = mid + 1;
    else hi = mid;
  }
  return lo < g->ncurve && model_curve_at(g->model, lo)->tag == tag ? (uint32_t)lo : NONE;
}

CurveMesh *mesh1d_curve(const Mesh1d *g, int tag)
{
  uint32_t k = mesh1d_index(g, tag);
  return k == NONE ? NULL : &g->curve[k];
}

// The parameter between a and b that halves the length: bisection on the distances to both ends is not exact on bent pieces, so
// lengths by Gauss-Legendre with 5 points on either side.
static double arc(const Model *m, const Curve *c, double a, double b)
{
  static const double x[3] = {0, 0.5384693101056831, 0.9061798459386640};
  static const double w[3] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  double mid = (a + b) / 2, half = (b - a) / 2, sum = w[0] * vec3_length(curve_deriv(m, c, mid));
  for (int i = 1; i < 3; i++)
    sum += w[i] * (vec3_length(curve_deriv(m, c, mid - half * x[i])) + vec3_length(curve_deriv(m, c, mid + half * x[i])));
  return sum * half;
}

static double half_way(const Model *m, const Curve *c, double a, double b)
{
  double lo = a, hi = b;
  for (int i = 0; i < 30; i++) {
    double mid = (lo + hi) / 2;
    if (arc(m, c, a, mid) < arc(m, c, mid, b)) lo = mid;
    else hi = mid;
  }
  double u = (lo + hi) / 2;
  return u > a && u < b ? u : (a + b) / 2;
}

uint32_t mesh1d_split(Mesh1d *g, size_t k, uint32_t i, double u)
{
  CurveMesh *cm = &g->curve[k];
  const Curve *c = model_curve_at(g->model, k);
  bool even = !c->joined && (c->type == CURVE_LINE || c->type == CURVE_CIRCLE);
  if (u < 0) u = even ? (cm->u[i] + cm->u[i + 1]) / 2 : half_way(g->model, c, cm->u[i], cm->u[i + 1]);
  double t = (u - cm->u[i]) / (cm->u[i + 1] - cm->u[i]), h = cm->h[i] + t * (cm->h[i + 1] - cm->h[i]);
  mesh1d__resize(cm, cm->n + 1);
  uint32_t after = cm->n - 2 - i; // nodes behind the new one
  memmove(cm->u + i + 2, cm->u + i + 1, after * sizeof *cm->u);
  memmove(cm->p + i + 2, cm->p + i + 1, after * sizeof *cm->p);
  memmove(cm->h + i + 2, cm->h + i + 1, after * sizeof *cm->h);
  cm->u[i + 1] = u;
  cm->p[i + 1] = curve_point(g->model, c, u);
  cm->h[i + 1] = h;
  return i + 1;
}

void mesh1d_set(Mesh1d *g, size_t k, const double *u, uint32_t n)
{
  CurveMesh *cm = &g->curve[k];
  const Curve *c = model_curve_at(g->model, k);
  double *copy = mem_alloc(n * sizeof *copy);
  memcpy(copy, u, n * sizeof *copy);
  mesh1d__resize(cm, n);
  memcpy(cm->u, copy, n * sizeof *copy);
  free(copy);
  mesh1d__positions(g->model, c, cm);
  sizes_from_edges(cm);
}

void mesh1d_limit_faces(const Mesh1d *g, SizeField *size)
{
  if (size_gradation(size) <= 0) return;
  Vec(Vec3) p = {0};
  DoubleVec h = {0};
  for (size_t k = 0; k < g->ncurve; k++) {
    for (uint32_t i = 0; i < g->curve[k].n; i++) {
      vec_push(&p, g->curve[k].p[i]);
      vec_push(&h, g->curve[k].h[i]);
    }
  }
  size_limit_growth(size, p.data, h.data, p.len);
  vec_free(&p);
  vec_free(&h);
}
