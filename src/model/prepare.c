// prepare.c - a model checked and made ready for meshing
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/str.h"
#include "model/curve_int.h"

void model__restore_points(Model *m)
{
  for (size_t i = 0; i < m->moved.len; i++) {
    Point *p = point__get(m, m->moved.data[i].tag);
    if (p) p->xyz = m->moved.data[i].xyz;
  }
  vec_clear(&m->moved);
}

// ---- loops --------------------------------------------------------------------------------------------------------------

// A loop that was sorted once and has lost a curve since is sorted no more.
static void unsort(Model *m, Loop *l)
{
  for (int i = 0; l->sorted && i < l->ncurve; i++) {
    Curve *c = model_curve(m, l->curve[i]);
    if (c) c->in_loops--;
  }
  l->sorted = false;
}

static bool report_unknown_curve(Model *m, Loop *l, Diag *diag)
{
  for (int i = 0; i < l->ncurve; i++) {
    if (model_curve(m, l->curve[i])) continue;
    if (!l->reported && !model__refused(m, KIND_CURVE, l->curve[i]))
      diag_error(diag, l->loc, "curve loop %d uses curve %d, which does not exist", l->tag, tag__abs(l->curve[i]));
    l->reported = true;
    unsort(m, l);
    return true;
  }
  return false;
}

static bool prepare_loop(Model *m, Loop *l, bool used, Diag *diag)
{
  if (used) return !report_unknown_curve(m, l, diag) && loop__verify(m, l, diag);
  if (l->sorted || l->lost) return true; // nothing rests on it, and it was good when it was made
  Diag *child = diag_child(diag);
  bool good = !report_unknown_curve(m, l, child) && loop__verify(m, l, child);
  if (!good && diag_count(child)) diag_warning(diag, l->loc, "%s (no surface uses it)", diag_get(child, 0)->text);
  diag_free(child);
  return true;
}

// Loops that are open by themselves may close together: a boundary listed in parts, as in Plane Surface(1) = {hole, left, right}.
// They become one.
static void join_open_loops(Model *m, Face *f, Diag *diag)
{
  IntVec curve = {0}, kept = {0};
  int nopen = 0;
  size_t at = 0;
  for (int k = 0; k < f->nloop; k++) {
    Loop *l = model_loop(m, f->loop[k]);
    LoopState state = l ? loop__sort(m, l, true, diag) : LOOP_UNKNOWN_CURVE;
    if (state == LOOP_UNKNOWN_CURVE) nopen = INT32_MIN;
    if (state != LOOP_OPEN) {
      vec_push(&kept, f->loop[k]);
      continue;
    }
    if (!nopen++) {
      at = kept.len;
      vec_push(&kept, 0);
    }
    for (int i = 0; i < l->ncurve; i++) vec_push(&curve, f->loop[k] < 0 ? -l->curve[i] : l->curve[i]);
  }
  if (nopen > 1) {
    Diag *child = diag_child(diag);
    int tag = loop__make_open(m, curve.data, (int)curve.len, f->loc);
    Loop *joint = model_loop(m, tag);
    if (loop__sort(m, joint, true, child) == LOOP_OK) {
      for (int k = 0; k < f->nloop; k++) {
        Loop *l = model_loop(m, f->loop[k]);
        if (!l->sorted) l->reported = true; // closed by the others
      }
      kept.data[at] = tag;
      memcpy(f->loop, kept.data, kept.len * sizeof *f->loop);
      f->nloop = (int)kept.len;
    } else {
      joint->reported = true;
    }
    diag_free(child);
  }
  vec_free(&curve);
  vec_free(&kept);
}

static bool prepare_loops(Model *m, Diag *diag)
{
  Map used = {0};
  bool good = true;
  for (size_t i = 0; i < model_faces(m); i++) {
    Face *f = model_face_at(m, i);
    if (f->type == FACE_PLANE && f->nloop > 1) join_open_loops(m, f, diag);
  }
  for (size_t i = 0; i < model_faces(m); i++) {
    const Face *f = model_face_at(m, i);
    for (int k = 0; k < f->nloop; k++) map_set(&used, (uint64_t)tag__abs(f->loop[k]), 1);
  }
  Table *both[2] = {&m->loop, &m->hidden};
  for (int k = 0; k < 2; k++) {
    table__sort(both[k]);
    for (size_t i = 0; i < both[k]->live; i++) {
      Loop *l = table__at(both[k], i);
      good &= prepare_loop(m, l, map_get(&used, (uint64_t)l->tag) != NONE, diag);
    }
  }
  map_free(&used);
  return good;
}

// ---- curves -------------------------------------------------------------------------------------------------------------

static bool is_closed_bspline(const Curve *c)
{
  return c->type == CURVE_BSPLINE && c->npoint > 2 && c->point[0] == c->point[c->npoint - 1];
}

// The point of a closed periodic B-spline moves onto its start when nothing else uses it.
static void move_to_start(Model *m, Curve *c)
{
  Point *p = point__get(m, c->begin);
  uint32_t own = 2;
  for (int i = 0; i < c->npoint; i++) own += c->point[i] == c->begin;
  if (p->uses != own) return;
  CurveShape *h = c->shape;
  MovedPoint was = {p->tag, p->xyz};
  vec_push(&m->moved, was);
  p->xyz = h->begin = h->end = h->control[0];
}

static bool prepare_curves(Model *m, Diag *diag)
{
  bool good = true;
  size_t n = model_curves(m);
  for (size_t i = 0; i < n; i++) good &= curve__build(m, model_curve_at(m, i), diag);
  for (size_t i = 0; i < n; i++) {
    Curve *c = model_curve_at(m, i);
    if (c->shape && is_closed_bspline(c)) move_to_start(m, c);
  }
  return good;
}

// With a map, the map says which way the master runs, whatever its sign.
static void orient_master(const Model *m, Curve *c)
{
  Affine map;
  memcpy(map.m, c->affine, sizeof map.m);
  int from = curve__from(m, c->periodic_master), to = curve__to(m, c->periodic_master);
  Vec3 a = affine_apply(&map, model_point(m, from)->xyz), b = affine_apply(&map, model_point(m, to)->xyz);
  Vec3 p = model_point(m, c->begin)->xyz, q = model_point(m, c->end)->xyz;
  double as_written = vec3_distance(a, p) + vec3_distance(b, q), turned = vec3_distance(a, q) + vec3_distance(b, p);
  if (turned < 1e-3 * as_written) c->periodic_master = -c->periodic_master;
}

static void check_periodic(Model *m, Diag *diag)
{
  for (size_t i = 0; m->nperiodic && i < model_curves(m); i++) {
    Curve *c = model_curve_at(m, i);
    if (!c->periodic_master) continue;
    if (model_curve(m, c->periodic_master)) {
      if (c->affine) orient_master(m, c);
      continue;
    }
    diag_warning(diag, c->loc, "the master %d of periodic curve %d does not exist any more", tag__abs(c->periodic_master), c->tag);
    c->periodic_master = 0;
  }
  for (size_t i = 0; i < m->layered.len; i++) {
    Curve *c = table__get(&m->curve, m->layered.data[i]);
    if (c && c->copy_of && (!model_curve(m, c->copy_of) || tag__abs(c->copy_of) == c->tag)) c->copy_of = 0;
  }
}

// ---- faces ----------------------------------------------------------------------------------------------------------------

// What an extrusion wrote into a face follows its loop, whose curves coherence may have renamed: {source, end side, -top,
// -begin side}.
static void refresh_extruded(Model *m, Face *f)
{
  if (!f->extruded_curve) return;
  const Loop *l = model_loop(m, f->loop[0]);
  bool begin = f->extruded_side[0] != 0, end = f->extruded_side[1] != 0;
  if (f->nloop != 1 || l->ncurve != 2 + begin + end) {
    f->extruded_curve = 0;
    return;
  }
  int k = 0;
  f->extruded_curve = l->curve[k++];
  if (end) f->extruded_side[1] = l->curve[k++];
  f->extruded_top = -l->curve[k++];
  if (begin) f->extruded_side[0] = -l->curve[k];
}

static bool check_corners(Model *m, Face *f, Diag *diag)
{
  if (!f->ncorner) return true;
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  bool good = true;
  for (int k = 0; k < f->ncorner && good; k++) {
    bool found = false;
    for (size_t i = 0; i < curve.len && !found; i++) found = curve__from(m, curve.data[i]) == f->corner[k];
    if (found) continue;
    good = false;
    diag_warning(diag, f->loc, "corner %d of transfinite surface %d is not on its boundary; the surface is meshed freely", f->corner[k],
                 f->tag);
    f->transfinite = false;
  }
  vec_free(&curve);
  vec_free(&start);
  return good;
}

static void keep_existing(const Model *m, int dim, IntVec *list)
{
  size_t n = 0;
  for (size_t i = 0; i < list->len; i++) {
    bool twice = false;
    for (size_t k = 0; k < n && list->len < 256 && !twice; k++) twice = list->data[k] == list->data[i];
    if (!twice && model_has(m, dim, list->data[i])) list->data[n++] = list->data[i];
  }
  list->len = n;
}

// A curve of the face's own boundary is no embedded one.
static void drop_boundary(const Model *m, Face *f)
{
  IntVec curve = {0}, start = {0};
  if (f->embedded_curves.len) face_boundary(m, f, &curve, &start);
  size_t n = 0;
  for (size_t i = 0; i < f->embedded_curves.len; i++) {
    bool bounds = false;
    for (size_t k = 0; k < curve.len && !bounds; k++) bounds = tag__abs(curve.data[k]) == f->embedded_curves.data[i];
    if (!bounds) f->embedded_curves.data[n++] = f->embedded_curves.data[i];
  }
  f->embedded_curves.len = n;
  vec_free(&curve);
  vec_free(&start);
}

static bool loops_are_sorted(const Model *m, const Face *f)
{
  for (int k = 0; k < f->nloop; k++) {
    const Loop *l = model_loop(m, f->loop[k]);
    if (!l || !l->sorted) return false;
  }
  return true;
}

static bool prepare_faces(Model *m, double tolerance, Diag *diag)
{
  bool good = true;
  size_t n = model_faces(m);
  for (size_t i = 0; i < n; i++) {
    Face *f = model_face_at(m, i);
    refresh_extruded(m, f);
    if (!loops_are_sorted(m, f)) {
      good = false;
      continue;
    }
    good &= face__build(m, f, tolerance, diag);
    check_corners(m, f, diag);
    if (m->nembedded) {
      keep_existing(m, 0, &f->embedded_points);
      keep_existing(m, 1, &f->embedded_curves);
      drop_boundary(m, f);
    }
    if (f->periodic_master && !model_face(m, f->periodic_master)) f->periodic_master = 0;
  }
  return good;
}

// ---- groups ---------------------------------------------------------------------------------------------------------------

static void report_missing(const Group *g, const IntVec *missing, Diag *diag)
{
  Str list = {0};
  for (size_t i = 0; i < missing->len && i < 5; i++) str_printf(&list, "%s%d", i ? ", " : "", missing->data[i]);
  if (missing->len > 5) str_printf(&list, " and %zu more", missing->len - 5);
  const char *quote = g->name ? "\"" : "";
  diag_warning(diag, g->loc, "physical %s %d%s%s%s%s names %s %s, which %s not exist", dim__name(g->dim), g->tag, g->name ? " " : "", quote,
               g->name ? g->name : "", quote, dim__name(g->dim), str_text(&list), missing->len > 1 ? "do" : "does");
  str_free(&list);
}

// Members that exist, each once.
static void prepare_group(Model *m, Group *g, Diag *diag)
{
  Map seen = {0};
  IntVec missing = {0};
  size_t n = 0;
  for (size_t i = 0; i < g->entity.len; i++) {
    int tag = g->entity.data[i];
    bool added;
    map_slot(&seen, (uint64_t)tag__abs(tag), 1, &added);
    if (!added) continue;
    if (model_has(m, g->dim, tag))
      g->entity.data[n++] = tag;
    else if (!model__refused(m, dim__kind(g->dim), tag))
      vec_push(&missing, tag__abs(tag));
  }
  g->entity.len = n;
  if (missing.len) report_missing(g, &missing, diag);
  vec_free(&missing);
  map_free(&seen);
}

bool model_needs_prepare(const Model *m) { return m->parted; }

// Products of four coordinates, which predicates need, must not overflow.
static bool places_in_reach(Model *m, Diag *diag)
{
  static const double reach = 1e60;
  const Box3 *b = &m->extent;
  if (!model_points(m) || (fmin(b->lo.x, fmin(b->lo.y, b->lo.z)) >= -reach && fmax(b->hi.x, fmax(b->hi.y, b->hi.z)) <= reach)) return true;
  for (size_t i = 0; i < model_points(m); i++) {
    const Point *p = model_point_at(m, i);
    if (fmax(fabs(p->xyz.x), fmax(fabs(p->xyz.y), fabs(p->xyz.z))) <= reach) continue;
    diag_error(diag, p->loc, "point %d is at (%g, %g, %g): coordinates beyond %g cannot be computed with", p->tag, p->xyz.x, p->xyz.y,
               p->xyz.z, reach);
    return false;
  }
  return true;
}

bool model_prepare(Model *m, double tolerance, Diag *diag)
{
  (void)model_points(m); // sort all tables now: readers may be many
  (void)model_volumes(m);
  model__unprepare(m);
  if (!places_in_reach(m, diag)) return false;
  bool good = prepare_loops(m, diag);
  good &= prepare_curves(m, diag);
  good &= prepare_faces(m, tolerance, diag);
  check_periodic(m, diag);
  for (size_t i = 0; i < model_groups(m); i++) prepare_group(m, model_group_at(m, i), diag);
  if (good) model__unite_faces(m, tolerance, diag);
  if (good) model__join_curves(m, diag);
  m->parted = false;
  return good;
}
