// coherence.c - merging equal points, curves and faces
// SPDX-License-Identifier: MIT
//
// Runs after every transform, so it is incremental: what was added or changed since the last run (m->dirty) is compared with
// indexes of all the rest, that persist: points by grid cell, curves by control points, faces by their set of curves.
#include "base/base.h"

#include "model/coherence_int.h"

// ---- what was merged ----------------------------------------------------------------------------------------------------

void merged__free(Merged *g)
{
  for (int d = 0; d < 3; d++) {
    map_free(&g->to[d]);
    vec_free(&g->gone[d]);
  }
}

int merged__tag(const Merged *g, int dim, int tag)
{
  for (;;) {
    uint32_t to = g->to[dim].len ? map_get(&g->to[dim], (uint64_t)tag__abs(tag)) : NONE;
    if (to == NONE) return tag;
    int survivor = to & 1 ? -(int)(to >> 1) : (int)(to >> 1);
    tag = tag < 0 ? -survivor : survivor;
  }
}

// The sign in the lowest bit, so that no value is NONE.
void coherence__record(Merged *g, int dim, int gone, int stays)
{
  map_set(&g->to[dim], (uint64_t)gone, (uint32_t)tag__abs(stays) << 1 | (stays < 0));
  vec_push(&g->gone[dim], gone);
}

void coherence__replace(const Merged *g, int dim, int *tag, size_t n)
{
  for (size_t i = 0; i < n; i++) tag[i] = merged__tag(g, dim, tag[i]);
}

int coherence__by_value(const void *a, const void *b)
{
  int x = *(const int *)a, y = *(const int *)b;
  return (x > y) - (x < y);
}

void coherence__sort_unique(IntVec *v)
{
  bool ascending = true;
  for (size_t i = 1; i < v->len && ascending; i++) ascending = v->data[i - 1] < v->data[i];
  if (ascending) return;
  if (v->len) qsort(v->data, v->len, sizeof *v->data, coherence__by_value);
  size_t n = 0;
  for (size_t i = 0; i < v->len; i++)
    if (!n || v->data[n - 1] != v->data[i]) v->data[n++] = v->data[i];
  v->len = n;
}

void coherence__groups_follow(Model *m, int dim, const Merged *g)
{
  for (size_t i = 0; i < m->group[dim].len; i++)
    coherence__replace(g, dim, m->group[dim].data[i]->entity.data, m->group[dim].data[i]->entity.len);
}

void coherence__recount(Model *m, Kind k)
{
  if (m->set.old_newreg || m->set.opencascade) model__recount(m, k);
}

// ---- curves -----------------------------------------------------------------------------------------------------------

// Where start, centre and end are in line the plane decides which half circle it is.
static bool plane_matters(const Model *m, const Curve *c)
{
  if (c->arc || (c->type != CURVE_CIRCLE && c->type != CURVE_ELLIPSE)) return false;
  Vec3 o = point__get(m, c->point[1])->xyz;
  Vec3 a = vec3_sub(point__get(m, c->begin)->xyz, o), b = vec3_sub(point__get(m, c->end)->xyz, o);
  return vec3_length(vec3_cross(a, b)) <= 1e-12 * vec3_length(a) * vec3_length(b);
}

static int curve_control(const Curve *c, int i, bool back)
{
  if (back && c->type == CURVE_ELLIPSE && c->npoint == 4 && (i == 1 || i == 2)) return c->point[i];
  return c->point[back ? c->npoint - 1 - i : i];
}

static uint64_t control_hash(const Curve *c, bool back)
{
  uint64_t h = hash__mix((uint64_t)c->type, (uint64_t)c->npoint);
  for (int i = 0; i < c->npoint; i++) h = hash__mix(h, (uint64_t)(uint32_t)curve_control(c, i, back));
  return h;
}

// The same for a curve and its reverse.
static uint64_t curve_hash(const Curve *c)
{
  uint64_t a = control_hash(c, false), b = control_hash(c, true);
  return a < b ? a : b;
}

void model__forget_curve(Model *m, Curve *c)
{
  if (m->curve_on) chains__unlink(&m->curve_key, curve_hash(c), table__find(&m->curve, c->tag));
}

static bool same_controls(const Curve *a, const Curve *b, bool back)
{
  for (int i = 0; i < a->npoint; i++)
    if (a->point[i] != curve_control(b, i, back)) return false;
  for (int i = 0; i < a->nknot; i++) {
    double t = back ? b->knot[0] + b->knot[b->nknot - 1] - b->knot[b->nknot - 1 - i] : b->knot[i];
    if (a->knot[i] != t) return false;
  }
  return true;
}

static Vec3 arc_point(const Arc *a, double s)
{
  double t = a->t0 + s * (a->t1 - a->t0);
  return vec3_add(a->centre, vec3_add(vec3_scale(cos(t), a->a), vec3_scale(sin(t), a->b)));
}

static bool same_arc(const Arc *a, const Arc *b, bool back)
{
  if (!a || !b) return a == b;
  double tol = 1e-9 * fmax(vec3_length(a->a), vec3_length(a->b));
  for (int i = 1; i < 4; i++)
    if (vec3_distance(arc_point(a, i / 4.0), arc_point(b, back ? 1 - i / 4.0 : i / 4.0)) > tol) return false;
  return true;
}

static bool same_pieces(const Pieces *a, const Pieces *b, bool back)
{
  if (!a || !b) return a == b;
  if (a->degree != b->degree || a->npiece != b->npiece) return false;
  int n = a->npiece * (a->degree + 1);
  double tol = 0;
  for (int i = 0; i < n; i++) tol = fmax(tol, vec3_distance(a->control[i], a->control[0]));
  for (int i = 0; i < n; i++)
    if (vec3_distance(a->control[i], b->control[back ? n - 1 - i : i]) > 1e-9 * tol) return false;
  return true;
}

static bool same_way(const Curve *a, const Curve *b, bool back)
{
  return same_controls(a, b, back) && same_arc(a->arc, b->arc, back) && same_pieces(a->pieces, b->pieces, back);
}

// 1: the same curve, -1: its reverse, 0: another.
static int same_curve(const Model *m, const Curve *a, const Curve *b)
{
  if (a->type != b->type || a->npoint != b->npoint || a->nknot != b->nknot) return 0;
  bool planes = plane_matters(m, a) || plane_matters(m, b);
  Vec3 na = a->has_plane ? a->plane : (Vec3){0, 0, 1}, nb = b->has_plane ? b->plane : (Vec3){0, 0, 1};
  double along = planes ? vec3_dot(na, nb) / (vec3_length(na) * vec3_length(nb)) : 1;
  if (same_way(a, b, false) && along > 1 - 1e-9) return 1;
  return same_way(a, b, true) && (!planes || along < -1 + 1e-9) ? -1 : 0;
}

// Does the mesh of curve `from` come, copy by copy, from that of curve `to`?
static bool copied_from(const Model *m, int from, int to)
{
  for (size_t steps = 0; from && steps <= m->curve.live; steps++) {
    if (tag__abs(from) == to) return true;
    const Curve *c = model_curve(m, from);
    from = c ? c->copy_of : 0;
  }
  return false;
}

// Layers as seen from the other end.
static Layers reversed_layers(Model *m, const Layers *l)
{
  Layers r = {l->n, arena_alloc(&m->arena, (size_t)l->n * sizeof *r.count),
              arena_alloc(&m->arena, (size_t)l->n * sizeof *r.height), l->recombine};
  for (int i = 0; i < l->n; i++) {
    r.count[i] = l->count[l->n - 1 - i];
    r.height[i] = i + 1 == l->n ? 1 : 1 - l->height[l->n - 2 - i];
  }
  return r;
}

// What survives takes over how to mesh it if it does not know itself.
static void inherit(Model *m, Curve *stays, const Curve *gone, int sign)
{
  if (stays->transfinite || stays->copy_of || (stays->extruded_point && stays->layers.n)) return;
  stays->transfinite = gone->transfinite;
  stays->law = gone->law;
  stays->coef = sign < 0 && gone->law != LAW_BUMP && gone->coef > 0 ? 1 / gone->coef : gone->coef;
  stays->extruded_point = gone->extruded_point;
  if (gone->layers.n) stays->layers = sign < 0 ? reversed_layers(m, &gone->layers) : gone->layers;
  if (!copied_from(m, gone->copy_of, stays->tag)) stays->copy_of = sign * gone->copy_of;
}

static void find_equal_curves(Model *m, Merged *g)
{
  if (!m->curve_on) {
    m->curve_on = true;
    map_reserve(&m->curve_key.head, m->curve.live);
    vec_clear(&m->dirty[1]);
    table__sort(&m->curve);
    for (size_t i = 0; i < m->curve.live; i++) vec_push(&m->dirty[1], ((Curve *)table__at(&m->curve, i))->tag);
  }
  coherence__sort_unique(&m->dirty[1]);
  for (size_t i = 0; i < m->dirty[1].len; i++) {
    Curve *c = table__get(&m->curve, m->dirty[1].data[i]);
    if (!c || merged__tag(g, 1, c->tag) != c->tag) continue;
    model__forget_curve(m, c);
    uint64_t h = curve_hash(c) & ~(uint64_t)1;
    uint32_t s = map_get(&m->curve_key.head, h), next;
    bool gone = false;
    for (; s != NONE && !gone; s = next) {
      next = m->curve_key.next.data[s];
      Curve *d = table__slot(&m->curve, s);
      int sign = same_curve(m, d, c);
      if (!sign) continue;
      gone = d->tag < c->tag;
      Curve *out = gone ? c : d, *in = gone ? d : c;
      inherit(m, in, out, sign);
      if (!gone) model__forget_curve(m, d);
      coherence__record(g, 1, out->tag, sign * in->tag);
    }
    if (!gone) chains__link(&m->curve_key, h, table__find(&m->curve, c->tag));
  }
  vec_clear(&m->dirty[1]);
}

static bool loop_changes(const Loop *l, const Merged *g)
{
  for (int i = 0; i < l->ncurve; i++)
    if (merged__tag(g, 1, l->curve[i]) != l->curve[i]) return true;
  return false;
}

// Faces whose boundary changes leave the index before it does, and come back as dirty.
static void face_announces(Model *m, Face *f, const Merged *g)
{
  bool change = false;
  for (int i = 0; i < f->nloop && !change; i++) change = loop_changes(model_loop(m, f->loop[i]), g);
  if (!change) return;
  model__forget_face(m, f);
  face__count_uses(m, f, -1);
  vec_push(&m->changed_face, f->tag);
}

static void loop_follows(Model *m, Loop *l, const Merged *g)
{
  for (int i = 0; i < l->ncurve; i++) {
    int to = merged__tag(g, 1, l->curve[i]);
    if (to == l->curve[i]) continue;
    if (l->sorted) {
      model_curve(m, l->curve[i])->in_loops--;
      model_curve(m, to)->in_loops++;
    }
    l->curve[i] = to;
  }
}

static void curve_lists_follow(Model *m, const Merged *g)
{
  coherence__groups_follow(m, 1, g);
  if (m->nperiodic)
    for (uint32_t s = 0; s < m->curve.used; s++) {
      Curve *c = table__slot(&m->curve, s);
      if (c->tag != DEAD_TAG && c->periodic_master) c->periodic_master = merged__tag(g, 1, c->periodic_master);
    }
  for (size_t i = 0; i < m->layered.len; i++) {
    Curve *c = table__get(&m->curve, m->layered.data[i]);
    if (c && c->copy_of) c->copy_of = merged__tag(g, 1, c->copy_of);
  }
  for (uint32_t s = 0; m->nembedded && s < m->face.used; s++) {
    Face *f = table__slot(&m->face, s);
    if (f->tag != DEAD_TAG) coherence__replace(g, 1, f->embedded_curves.data, f->embedded_curves.len);
  }
}

static bool still_used(const Model *m, const Merged *g)
{
  for (size_t i = 0; i < g->gone[1].len; i++) {
    const Curve *c = table__get(&m->curve, g->gone[1].data[i]);
    if (c->in_loops || c->uses) return true;
  }
  return false;
}

static void dirty_loops_follow(Model *m, const Merged *g)
{
  coherence__sort_unique(&m->dirty[2]);
  for (size_t i = 0; i < m->dirty[2].len; i++) {
    Face *f = table__get(&m->face, m->dirty[2].data[i]);
    if (f) face_announces(m, f, g);
  }
  bool exclusive = true; // are all loops of these faces theirs alone? then the others need no look
  for (size_t i = 0; i < m->changed_face.len; i++) {
    const Face *f = table__get(&m->face, m->changed_face.data[i]);
    for (int j = 0; j < f->nloop; j++) exclusive = exclusive && tag__abs(f->loop[j]) >= HIDDEN_LOOP;
  }
  if (exclusive)
    for (size_t i = 0; i < m->changed_face.len; i++) {
      const Face *f = table__get(&m->face, m->changed_face.data[i]);
      for (int j = 0; j < f->nloop; j++) loop_follows(m, model_loop(m, f->loop[j]), g);
      face__count_uses(m, f, 1);
      vec_push(&m->dirty[2], f->tag);
    }
  else
    for (size_t i = 0; i < m->changed_face.len; i++) // left to the walk over all faces
      face__count_uses(m, table__get(&m->face, m->changed_face.data[i]), 1);
  vec_clear(&m->changed_face);
}

static void all_loops_follow(Model *m, const Merged *g)
{
  for (uint32_t s = 0; s < m->face.used; s++) {
    Face *f = table__slot(&m->face, s);
    if (f->tag != DEAD_TAG) face_announces(m, f, g);
  }
  Table *both[2] = {&m->loop, &m->hidden};
  for (int k = 0; k < 2; k++)
    for (uint32_t s = 0; s < both[k]->used; s++) {
      Loop *l = table__slot(both[k], s);
      if (l->tag != DEAD_TAG) loop_follows(m, l, g);
    }
  for (size_t i = 0; i < m->changed_face.len; i++) {
    face__count_uses(m, table__get(&m->face, m->changed_face.data[i]), 1);
    vec_push(&m->dirty[2], m->changed_face.data[i]);
  }
  vec_clear(&m->changed_face);
}

static void merge_curves(Model *m, Merged *g)
{
  find_equal_curves(m, g);
  if (!g->gone[1].len) return;
  dirty_loops_follow(m, g);
  for (size_t i = 0; i < m->pending_loop.len; i++) {
    Loop *l = model_loop(m, m->pending_loop.data[i]);
    if (l && !l->sorted) loop_follows(m, l, g);
  }
  if (still_used(m, g)) all_loops_follow(m, g);
  curve_lists_follow(m, g);
  for (size_t i = 0; i < g->gone[1].len; i++) curve__drop(m, g->gone[1].data[i]);
  coherence__recount(m, KIND_CURVE);
}

// ---- all --------------------------------------------------------------------------------------------------------------

void model__merge(Model *m, Merged *report)
{
  coherence__points(m, report);
  merge_curves(m, report);
  coherence__faces(m, report);
  // A loop may have become closed.
  for (size_t i = 0; i < m->pending_loop.len;) {
    Loop *l = model_loop(m, m->pending_loop.data[i]);
    if (l && !l->sorted)
      i++;
    else
      m->pending_loop.data[i] = vec_pop(&m->pending_loop);
  }
}

void model_coherence(Model *m, Diag *diag)
{
  model__unprepare(m);
  Merged g = {0};
  model__merge(m, &g);
  size_t n = g.gone[0].len + g.gone[1].len + g.gone[2].len;
  if (n)
    log_debug(diag, "coherence removed %zu points, %zu curves, %zu surfaces", g.gone[0].len, g.gone[1].len, g.gone[2].len);
  merged__free(&g);
}

bool model_join_points(Model *m, const int *point, size_t n, SrcLoc loc, Diag *diag)
{
  for (size_t i = 0; i < n; i++)
    if (!point__get(m, point[i])) {
      diag_error(diag, loc, "point %d does not exist", point[i]);
      return false;
    }
  model__unprepare(m);
  for (size_t i = 1; i < n; i++) model__point_moves(m, point__get(m, point[i]), point__get(m, point[0])->xyz);
  model_coherence(m, diag);
  return true;
}

void model__index_free(Model *m)
{
  chains__clear(&m->cell);
  chains__clear(&m->curve_key);
  chains__clear(&m->face_key);
  vec_free(&m->changed_face);
  vec_free(&m->layered);
}
