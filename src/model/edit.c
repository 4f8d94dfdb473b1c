// edit.c - making points, curves, loops, faces and volumes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_int.h"

// ---- without checks -------------------------------------------------------------------------------------------------

Point *point__make(Model *m, int tag, Vec3 xyz, double lc, SrcLoc loc)
{
  Point *p = table__add(&m->point, tag);
  p->xyz = xyz;
  p->lc = lc > 0 && lc < LC_UNSET ? lc : LC_UNSET;
  p->loc = loc;
  m->extent = box3_with(m->extent, xyz);
  model__note_tag(m, KIND_POINT, tag);
  vec_push(&m->dirty[0], tag);
  return p;
}

Curve *curve__make(Model *m, int tag, CurveType type, const int *point, int npoint, int begin, int end, SrcLoc loc)
{
  Curve *c = table__add(&m->curve, tag);
  c->type = type;
  c->point = arena_dup(&m->arena, point, (size_t)npoint * sizeof *point);
  c->npoint = npoint;
  c->begin = begin;
  c->end = end;
  c->loc = loc;
  c->coef = 1;
  if (m->sphere && type != CURVE_CIRCLE && type != CURVE_ELLIPSE) c->sphere = sphere__of_points(m, point, npoint);
  for (int i = 0; i < npoint; i++) point__get(m, point[i])->uses++;
  point__get(m, begin)->uses++;
  point__get(m, end)->uses++;
  model__note_tag(m, KIND_CURVE, tag);
  vec_push(&m->dirty[1], tag);
  return c;
}

void curve__drop(Model *m, int tag)
{
  Curve *c = table__get(&m->curve, tag);
  model__forget_curve(m, c);
  for (int i = 0; i < c->npoint; i++) point__get(m, c->point[i])->uses--;
  point__get(m, c->begin)->uses--;
  point__get(m, c->end)->uses--;
  curve__release(c);
  table__remove(&m->curve, tag);
}

int loop__make_open(Model *m, const int *curve, int ncurve, SrcLoc loc)
{
  int tag = (int)m->hidden.live;
  while (table__find(&m->hidden, tag) != NONE) tag++;
  Loop *l = table__add(&m->hidden, tag);
  l->tag = tag + HIDDEN_LOOP;
  l->curve = arena_dup(&m->arena, curve, (size_t)ncurve * sizeof *curve);
  l->ncurve = ncurve;
  l->loc = loc;
  return l->tag;
}

int loop__make_hidden(Model *m, const int *curve, int ncurve, SrcLoc loc)
{
  int tag = loop__make_open(m, curve, ncurve, loc);
  model_loop(m, tag)->sorted = true;
  for (int i = 0; i < ncurve; i++) model_curve(m, curve[i])->in_loops++;
  return tag;
}

void face__count_uses(Model *m, const Face *f, int delta)
{
  for (int i = 0; i < f->nloop; i++) {
    const Loop *l = model_loop(m, f->loop[i]);
    for (int j = 0; l && j < l->ncurve; j++) {
      Curve *c = model_curve(m, l->curve[j]);
      if (c) c->uses += (uint32_t)delta;
    }
  }
}

void face__copy_meshing(Face *to, const Face *from)
{
  to->recombine = from->recombine;
  to->recombine_angle = from->recombine_angle;
  to->algorithm = from->algorithm;
  to->size_from_boundary = from->size_from_boundary;
  to->smoother = from->smoother;
}

Face *face__make(Model *m, int tag, FaceType type, const int *loop, int nloop, SrcLoc loc)
{
  Face *f = table__add(&m->face, tag);
  f->type = type;
  f->loop = arena_dup(&m->arena, loop, (size_t)nloop * sizeof *loop);
  f->nloop = nloop;
  f->loc = loc;
  f->recombine_angle = 45;
  f->size_from_boundary = -1;
  face__count_uses(m, f, 1);
  model__note_tag(m, KIND_FACE, tag);
  vec_push(&m->dirty[2], tag);
  return f;
}

static bool loop_in_use(const Model *m, int tag)
{
  for (uint32_t s = 0; s < m->face.used; s++) {
    const Face *f = table__slot(&m->face, s);
    for (int k = 0; f->tag != DEAD_TAG && k < f->nloop; k++)
      if (tag__abs(f->loop[k]) == tag) return true;
  }
  return false;
}

static void drop_loop(Model *m, Table *t, Loop *l, int tag)
{
  for (int j = 0; l->sorted && j < l->ncurve; j++) model_curve(m, l->curve[j])->in_loops--;
  table__remove(t, tag);
}

static void drop_hidden_loops(Model *m, const Face *f)
{
  for (int i = 0; i < f->nloop; i++)
    if (tag__abs(f->loop[i]) >= HIDDEN_LOOP) drop_loop(m, &m->hidden, model_loop(m, f->loop[i]), tag__abs(f->loop[i]) - HIDDEN_LOOP);
}

static void drop_named_loops(Model *m, const int *loop, int n)
{
  for (int i = 0; i < n; i++) {
    Loop *l = table__get(&m->loop, tag__abs(loop[i]));
    if (l && !loop_in_use(m, l->tag)) drop_loop(m, &m->loop, l, l->tag);
  }
  model__recount(m, KIND_LOOP);
}

void face__drop_loops(Model *m, Face *f)
{
  const int *loop = f->loop; // the arena keeps it
  int n = f->nloop;
  face__count_uses(m, f, -1);
  drop_hidden_loops(m, f);
  f->nloop = 0;
  drop_named_loops(m, loop, n);
}

void face__drop(Model *m, int tag)
{
  Face *f = table__get(&m->face, tag);
  model__forget_face(m, f);
  face__count_uses(m, f, -1);
  drop_hidden_loops(m, f);
  if (f->embedded_points.len + f->embedded_curves.len) m->nembedded--;
  if (f->ncorner) m->ncorners--;
  vec_free(&f->embedded_points);
  vec_free(&f->embedded_curves);
  table__remove(&m->face, tag);
}

void face__drop_whole(Model *m, int tag)
{
  const Face *f = table__get(&m->face, tag);
  const int *loop = f->loop; // the arena keeps it
  int n = f->nloop;
  face__drop(m, tag);
  if (m->set.opencascade) drop_named_loops(m, loop, n);
}

Volume *volume__make(Model *m, int tag, const int *face, int nface, SrcLoc loc)
{
  Volume *v = table__add(&m->volume, tag);
  v->face = arena_dup(&m->arena, face, (size_t)nface * sizeof *face);
  v->nface = nface;
  v->loc = loc;
  for (int i = 0; i < nface; i++) model_face(m, face[i])->uses++;
  model__note_tag(m, KIND_VOLUME, tag);
  return v;
}

// ---- checks ---------------------------------------------------------------------------------------------------------

enum { TAG_LIMIT = HIDDEN_LOOP - 1 };

int tag__claim(Model *m, Kind k, int tag, SrcLoc loc, Diag *diag)
{
  if (tag == -1) tag = model__next_tag(m, k);
  if (tag < 0 || tag > TAG_LIMIT) {
    diag_error(diag, loc, "%s tag %d is not between 0 and %d", kind__name(k), tag, TAG_LIMIT);
    return -1;
  }
  const Table *t = model__table(m, k);
  uint32_t s = table__find(t, tag);
  if (s == NONE) return tag;
  SrcLoc made = NO_LOC;
  const void *item = table__slot(t, s);
  switch (k) {
  case KIND_POINT: made = ((const Point *)item)->loc; break;
  case KIND_CURVE: made = ((const Curve *)item)->loc; break;
  case KIND_LOOP: made = ((const Loop *)item)->loc; break;
  case KIND_FACE: made = ((const Face *)item)->loc; break;
  case KIND_SURFACE_LOOP: made = ((const SurfaceLoop *)item)->loc; break;
  case KIND_VOLUME: made = ((const Volume *)item)->loc; break;
  case KIND_GROUP:
  case KIND_COUNT: break;
  }
  diag_error(diag, loc, "%s %d exists already", kind__name(k), tag);
  if (made.line) diag_note(diag, made, "%s %d was made here", kind__name(k), tag);
  return -1;
}

static void no_such(const Model *m, Kind k, int tag, const char *user, SrcLoc loc, Diag *diag)
{
  const Table *t = model__table(m, k);
  tag = tag__abs(tag);
  if (!t->live) {
    diag_error(diag, loc, "%s uses %s %d, but there is no %s yet", user, kind__name(k), tag, kind__name(k));
    return;
  }
  diag_error(diag, loc, "%s uses %s %d, which does not exist (there are %zu, the largest is %d)", user, kind__name(k), tag,
             t->live, m->max[k]);
}

static int refuse(Model *m, Kind k, int tag)
{
  model__refuse(m, k, tag);
  return -1;
}

static const char *curve_word(CurveType t)
{
  static const char *const words[] = {"Line", "Line", "Circle", "Ellipse", "Spline", "BSpline", "Bezier", "Nurbs"};
  return words[t];
}

int model_add_point(Model *m, int tag, Vec3 xyz, double lc, SrcLoc loc, Diag *diag)
{
  model__unprepare(m);
  tag = tag__claim(m, KIND_POINT, tag, loc, diag);
  if (tag < 0) return -1;
  if (!isfinite(xyz.x) || !isfinite(xyz.y) || !isfinite(xyz.z)) {
    diag_error(diag, loc, "coordinates of point %d are not finite (%g, %g, %g)", tag, xyz.x, xyz.y, xyz.z);
    return refuse(m, KIND_POINT, tag);
  }
  const PolarSphere *s = m->sphere;
  point__make(m, tag, s ? polar_point(s, (Vec2){xyz.x, xyz.y}) : xyz, lc, loc)->sphere = s;
  return tag;
}

// All points known? One message for the first that is not.
static bool points_exist(Model *m, CurveType type, int tag, const int *point, size_t n, SrcLoc loc, Diag *diag)
{
  for (size_t i = 0; i < n; i++) {
    if (table__find(&m->point, point[i]) != NONE) continue;
    if (model__refused(m, KIND_POINT, point[i]) && point[i] >= 0) return false;
    char user[48];
    snprintf(user, sizeof user, "%s %d", curve_word(type), tag);
    if (point[i] < 0)
      diag_error(diag, loc, "%s: a point has no sign, but %d was given", user, point[i]);
    else
      no_such(m, KIND_POINT, point[i], user, loc, diag);
    return false;
  }
  return true;
}

static bool count_is_right(CurveType type, int tag, size_t npoint, size_t nknot, SrcLoc loc, Diag *diag)
{
  size_t least = type == CURVE_CIRCLE || type == CURVE_ELLIPSE ? 3 : 2;
  size_t most = type == CURVE_CIRCLE ? 3 : type == CURVE_ELLIPSE ? 4 : INT32_MAX;
  if (npoint < least || npoint > most) {
    if (type == CURVE_CIRCLE)
      diag_error(diag, loc, "Circle %d needs 3 points {start, centre, end}, not %zu", tag, npoint);
    else if (type == CURVE_ELLIPSE)
      diag_error(diag, loc, "Ellipse %d needs 4 points {start, centre, on the major axis, end}, not %zu", tag, npoint);
    else
      diag_error(diag, loc, "%s %d needs at least 2 points, not %zu", curve_word(type), tag, npoint);
    return false;
  }
  if (type == CURVE_NURBS && (nknot < npoint + 2 || nknot > 2 * npoint)) {
    diag_error(diag, loc, "Nurbs %d has %zu points and %zu knots; there must be (points + degree + 1) knots, degree from 1 to "
                          "points - 1", tag, npoint, nknot);
    return false;
  }
  return true;
}

static bool knots_are_right(int tag, const double *knot, size_t n, SrcLoc loc, Diag *diag)
{
  for (size_t i = 0; i + 1 < n; i++)
    if (!(knot[i] <= knot[i + 1])) {
      diag_error(diag, loc, "knots of Nurbs %d must not decrease, but %g is followed by %g", tag, knot[i], knot[i + 1]);
      return false;
    }
  if (n && !(knot[n - 1] > knot[0])) {
    diag_error(diag, loc, "knots of Nurbs %d are all the same", tag);
    return false;
  }
  return true;
}

// An arc that is none is an error where it is written, also if it is deleted later; warnings can wait for the mesher.
static bool arc_is_good(Model *m, Curve *c, Diag *diag)
{
  if (c->type != CURVE_CIRCLE && c->type != CURVE_ELLIPSE) return true;
  Diag *quiet = diag_child(diag);
  bool good = curve__build(m, c, quiet);
  diag_free(quiet);
  if (!good) curve__build(m, c, diag);
  curve__release(c);
  return good;
}

int model_add_curve(Model *m, CurveType type, int tag, const int *point, size_t npoint, const Vec3 *plane,
                    const double *knot, size_t nknot, SrcLoc loc, Diag *diag)
{
  tag = tag__claim(m, KIND_CURVE, tag, loc, diag);
  if (tag < 0) return -1;
  if (!count_is_right(type, tag, npoint, nknot, loc, diag) || !points_exist(m, type, tag, point, npoint, loc, diag) ||
      !knots_are_right(tag, knot, nknot, loc, diag))
    return refuse(m, KIND_CURVE, tag);
  int ellipse[4];
  if (type == CURVE_ELLIPSE && npoint == 3) { // its start is on the major axis
    ellipse[0] = ellipse[2] = point[0];
    ellipse[1] = point[1];
    ellipse[3] = point[2];
    point = ellipse;
    npoint = 4;
  }
  if (m->set.opencascade && (type == CURVE_SPLINE || type == CURVE_BSPLINE || type == CURVE_BEZIER))
    return spline__add(m, type, tag, point, npoint, loc, diag) ? tag : refuse(m, KIND_CURVE, tag);
  if (type == CURVE_LINE && npoint > 2) type = CURVE_POLYLINE;
  if (type == CURVE_LINE && m->sphere && sphere__of_points(m, point, 2)) type = CURVE_BSPLINE; // straight in the plane, not in space
  Curve *c = curve__make(m, tag, type, point, (int)npoint, point[0], point[npoint - 1], loc);
  if (plane) {
    c->has_plane = true;
    c->plane = *plane;
  }
  if (nknot) {
    c->knot = arena_dup(&m->arena, knot, nknot * sizeof *knot);
    c->nknot = (int)nknot;
  }
  if (!arc_is_good(m, c, diag)) {
    curve__drop(m, tag);
    return refuse(m, KIND_CURVE, tag);
  }
  if (type == CURVE_LINE && point[0] == point[1])
    diag_warning(diag, loc, "Line %d begins and ends at the same point %d: it has no length", tag, point[0]);
  return tag;
}

int model_add_compound_spline(Model *m, CurveType type, int tag, const int *curve, size_t ncurve, int samples, SrcLoc loc,
                              Diag *diag)
{
  tag = tag__claim(m, KIND_CURVE, tag, loc, diag);
  if (tag < 0) return -1;
  if (!ncurve || samples < 1 || samples > 1000000) {
    diag_error(diag, loc, !ncurve ? "Compound %s %d names no curve" : "Compound %s %d needs between 1 and 1000000 intervals",
               curve_word(type), tag);
    return refuse(m, KIND_CURVE, tag);
  }
  IntVec point = {0};
  bool good = true;
  for (size_t i = 0; i < ncurve && good; i++) {
    Curve *c = model_curve(m, curve[i]);
    if (!c) {
      char user[64];
      snprintf(user, sizeof user, "Compound %s %d", curve_word(type), tag);
      if (!model__refused(m, KIND_CURVE, curve[i])) no_such(m, KIND_CURVE, curve[i], user, loc, diag);
      good = false;
      break;
    }
    good = curve__build(m, c, diag);
    if (!good) break;
    int from = curve__from(m, curve[i]), to = curve__to(m, curve[i]);
    double lc0 = point__get(m, from)->lc, lc1 = point__get(m, to)->lc;
    if (!i) vec_push(&point, from);
    for (int k = 1; k < samples; k++) {
      double s = (double)k / samples, u = curve[i] < 0 ? 1 - s : s;
      double lc = lc0 < LC_UNSET && lc1 < LC_UNSET ? (1 - s) * lc0 + s * lc1 : LC_UNSET;
      int p = model__next_tag(m, KIND_POINT);
      point__make(m, p, curve_point(m, c, u), lc, loc);
      vec_push(&point, p);
    }
    vec_push(&point, to);
  }
  if (good) curve__make(m, tag, type, point.data, (int)point.len, point.data[0], vec_last(&point), loc);
  vec_free(&point);
  return good ? tag : refuse(m, KIND_CURVE, tag);
}

int model_add_loop(Model *m, int tag, const int *curve, size_t ncurve, SrcLoc loc, Diag *diag)
{
  tag = tag__claim(m, KIND_LOOP, tag, loc, diag);
  if (tag < 0) return -1;
  if (!ncurve) {
    diag_error(diag, loc, "curve loop %d names no curve", tag);
    return refuse(m, KIND_LOOP, tag);
  }
  Loop *l = table__add(&m->loop, tag);
  l->curve = arena_dup(&m->arena, curve, ncurve * sizeof *curve);
  l->ncurve = (int)ncurve;
  l->loc = loc;
  model__note_tag(m, KIND_LOOP, tag);
  if (loop__sort(m, l, true, diag) != LOOP_OK) vec_push(&m->pending_loop, tag);
  return tag;
}

// Loops of a new face exist and name existing curves?
static bool loops_are_good(Model *m, int tag, const int *loop, size_t nloop, SrcLoc loc, Diag *diag)
{
  for (size_t i = 0; i < nloop; i++) {
    Loop *l = model_loop(m, loop[i]);
    if (!l) {
      char user[48];
      snprintf(user, sizeof user, "surface %d", tag);
      if (!model__refused(m, KIND_LOOP, loop[i])) no_such(m, KIND_LOOP, loop[i], user, loc, diag);
      return false;
    }
    for (size_t j = 0; j < i; j++)
      if (tag__abs(loop[j]) == l->tag) {
        diag_error(diag, loc, "surface %d names curve loop %d twice", tag, l->tag);
        return false;
      }
    if (l->sorted) continue;
    if (loop__sort(m, l, true, diag) != LOOP_UNKNOWN_CURVE) continue;
    for (int j = 0; j < l->ncurve; j++) {
      if (model_curve(m, l->curve[j])) continue;
      char user[48];
      snprintf(user, sizeof user, "curve loop %d", l->tag);
      if (!model__refused(m, KIND_CURVE, l->curve[j]) && !l->reported) {
        no_such(m, KIND_CURVE, l->curve[j], user, l->loc, diag);
        diag_note(diag, loc, "surface %d needs it", tag);
      }
      l->reported = true;
      break;
    }
    return false;
  }
  return true;
}

int model_add_face(Model *m, FaceType type, int tag, const int *loop, size_t nloop, SrcLoc loc, Diag *diag)
{
  tag = tag__claim(m, KIND_FACE, tag, loc, diag);
  if (tag < 0) return -1;
  const char *word = type == FACE_PLANE ? "Plane Surface" : "Surface";
  if (!nloop) {
    diag_error(diag, loc, "%s %d needs at least one curve loop", word, tag);
    return refuse(m, KIND_FACE, tag);
  }
  int *own = arena_dup(&m->arena, loop, nloop * sizeof *loop);
  for (size_t i = 0; i < nloop; i++) {
    int wire = model_loop(m, loop[i]) ? 0 : wire__loop(m, tag__abs(loop[i]), loc);
    if (wire) own[i] = loop[i] < 0 ? -wire : wire;
  }
  loop = own;
  if (!loops_are_good(m, tag, loop, nloop, loc, diag)) return refuse(m, KIND_FACE, tag);
  if (type == FACE_FILLING) {
    const Loop *l = model_loop(m, loop[0]);
    if (nloop > 1 || l->ncurve < 3 || l->ncurve > 4) {
      diag_error(diag, loc, nloop > 1 ? "Surface %d has holes; only Plane Surface can have them"
                                      : "Surface %d needs 3 or 4 boundary curves, not %d (Plane Surface takes any number)",
                 tag, l->ncurve);
      return refuse(m, KIND_FACE, tag);
    }
  }
  face__make(m, tag, type, loop, (int)nloop, loc);
  return tag;
}

// ---- volumes ----------------------------------------------------------------------------------------------------------

int model_add_surface_loop(Model *m, int tag, const int *face, size_t nface, SrcLoc loc, Diag *diag)
{
  tag = tag__claim(m, KIND_SURFACE_LOOP, tag, loc, diag);
  if (tag < 0) return -1;
  SurfaceLoop *l = table__add(&m->surface_loop, tag);
  l->face = arena_dup(&m->arena, face, nface * sizeof *face);
  l->nface = (int)nface;
  l->loc = loc;
  model__note_tag(m, KIND_SURFACE_LOOP, tag);
  return tag;
}

int model_add_volume(Model *m, int tag, const int *surface_loop, size_t n, SrcLoc loc, Diag *diag)
{
  tag = tag__claim(m, KIND_VOLUME, tag, loc, diag);
  if (tag < 0) return -1;
  IntVec face = {0};
  char user[48];
  snprintf(user, sizeof user, "volume %d", tag);
  for (size_t i = 0; i < n; i++) {
    const SurfaceLoop *l = table__get(&m->surface_loop, tag__abs(surface_loop[i]));
    if (!l) {
      if (!model__refused(m, KIND_SURFACE_LOOP, surface_loop[i])) no_such(m, KIND_SURFACE_LOOP, surface_loop[i], user, loc, diag);
      vec_free(&face);
      return refuse(m, KIND_VOLUME, tag);
    }
    for (int j = 0; j < l->nface; j++) {
      if (!model_face(m, l->face[j])) {
        if (!model__refused(m, KIND_FACE, l->face[j])) no_such(m, KIND_FACE, l->face[j], user, loc, diag);
        vec_free(&face);
        return refuse(m, KIND_VOLUME, tag);
      }
      vec_push(&face, l->face[j]);
    }
  }
  volume__make(m, tag, face.data, (int)face.len, loc);
  vec_free(&face);
  return tag;
}
