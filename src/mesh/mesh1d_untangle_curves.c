// mesh1d_untangle_curves.c - do curves themselves meet, and where: to be split there, or an error
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "mesh/mesh1d_untangle_int.h"

static bool is_common_end(const Model *m, const Curve *a, const Curve *b, Vec3 p, double near)
{
  int ends[2] = {a->begin, a->end};
  for (int i = 0; i < 2; i++)
    if ((ends[i] == b->begin || ends[i] == b->end) && vec3_distance(model_point(m, ends[i])->xyz, p) <= near) return true;
  return false;
}

// Newton's iteration for a(u) = b(v) in the frame's plane from the middles, kept inside both pieces.
bool untangle__pieces_meet(const Untangler *t, const Face *frame, const Piece *a, const Piece *b, Meeting *meeting)
{
  const Model *m = t->g->model;
  double u = (a->lo + a->hi) / 2, v = (b->lo + b->hi) / 2;
  for (int it = 0; it < 60; it++) {
    Vec3 p = curve_point(m, a->c, u), q = curve_point(m, b->c, v);
    if (vec3_distance(p, q) <= t->near) {
      meeting->u = u, meeting->v = v, meeting->at = p;
      return !is_common_end(m, a->c, b->c, p, 10 * t->near);
    }
    Vec2 r = face_to_plane(frame, q), o = face_to_plane(frame, p), d = vec2_sub(r, o);
    Vec3 da = curve_deriv(m, a->c, u), db = curve_deriv(m, b->c, v);
    Vec2 ta = {vec3_dot(da, frame->axis_u), vec3_dot(da, frame->axis_v)};
    Vec2 tb = {vec3_dot(db, frame->axis_u), vec3_dot(db, frame->axis_v)};
    double det = vec2_cross(ta, tb);
    if (det == 0) return false;
    double nu = fmin(fmax(u + vec2_cross(d, tb) / det, a->lo), a->hi);
    double nv = fmin(fmax(v + vec2_cross(d, ta) / det, b->lo), b->hi);
    if (nu == u && nv == v) return false;
    u = nu, v = nv;
  }
  return false;
}

static void report_crossing(Untangler *t, const Curve *a, const Curve *b, Vec3 at, SegMeet how)
{
  if (t->reported++ >= UNTANGLE_MOST_REPORTED) return;
  if (a == b) {
    diag_error(t->diag, a->loc, "curve %d %s itself at (%.10g, %.10g)", a->tag, how == SEG_CROSS ? "crosses" : "touches", at.x, at.y);
    return;
  }
  const char *verb = how == SEG_CROSS ? "crosses" : how == SEG_TOUCH ? "touches" : "overlaps";
  diag_error(t->diag, b->loc, "curve %d %s curve %d at (%.10g, %.10g), where they have no common point",
             b->tag, verb, a->tag, at.x, at.y);
  diag_note(t->diag, a->loc, "curve %d is made here", a->tag);
}

// If curve ka is embedded in a face that kb bounds, that is what to say.
static bool report_leaving(Untangler *t, uint32_t ka, uint32_t kb, Vec3 at)
{
  if (untangle__lists_meet(&t->bounds_of[ka], &t->bounds_of[kb])) return false;
  if (!untangle__lists_meet(&t->faces_of[ka], &t->bounds_of[kb])) return false;
  if (t->reported++ >= UNTANGLE_MOST_REPORTED) return true;
  const Model *m = t->g->model;
  const Curve *a = model_curve_at(m, ka), *b = model_curve_at(m, kb);
  size_t i = 0;
  while (!untangle__lists_meet(&(U32Vec){.data = &t->faces_of[ka].data[i], .len = 1}, &t->bounds_of[kb])) i++;
  diag_error(t->diag, a->loc, "curve %d, embedded in surface %d, leaves it through curve %d at (%.10g, %.10g)", a->tag,
             model_face_at(m, t->faces_of[ka].data[i])->tag, b->tag, at.x, at.y);
  diag_note(t->diag, b->loc, "curve %d is made here", b->tag);
  return true;
}

static void push_meeting(Untangler *t, const Curve *c, double u, Vec3 at, int point)
{
  vec_push(t->meet, ((CurveMeeting){c->tag, point, u, at}));
}

bool untangle__meet_at_point(Untangler *t, const Curve *c, int point)
{
  const Model *m = t->g->model;
  if (point == c->begin || point == c->end) return false;
  Vec3 p = model_point(m, point)->xyz;
  double u = curve_nearest(m, c, p);
  if (vec3_distance(curve_point(m, c, u), p) > t->at_end || vec3_distance(curve_point(m, c, 0), p) <= t->at_end ||
      vec3_distance(curve_point(m, c, 1), p) <= t->at_end)
    return false;
  push_meeting(t, c, u, p, point);
  return true;
}

static int ends_on(Untangler *t, const Curve *a, const Curve *b)
{
  if (a == b) return 0;
  return untangle__meet_at_point(t, a, b->begin) + (b->end != b->begin && untangle__meet_at_point(t, a, b->end));
}

bool untangle__meet_at_ends(Untangler *t, const Curve *a, const Curve *b) { return ends_on(t, a, b) + ends_on(t, b, a) > 0; }

static bool box_has(const Box3 *b, Vec3 p, double d)
{
  return p.x >= b->lo.x - d && p.x <= b->hi.x + d && p.y >= b->lo.y - d && p.y <= b->hi.y + d && p.z >= b->lo.z - d && p.z <= b->hi.z + d;
}

// What prescribes the nodes of a curve forbids to cut it.
static bool is_prescribed(const Curve *c)
{
  return c->transfinite > 0 || c->layers.n || c->copy_of || c->periodic_master || c->joined || c->degenerate || c->dissolved;
}

static void meet_points_of_face(Untangler *t, const Face *f)
{
  const Model *m = t->g->model;
  IntVec tag = {0}, start = {0};
  face_boundary(m, f, &tag, &start);
  for (size_t i = 0; i < f->embedded_curves.len; i++) vec_push(&tag, f->embedded_curves.data[i]);
  for (size_t i = 0; i < tag.len; i++) {
    const Curve *c = model_curve(m, tag.data[i]);
    if (!c || is_prescribed(c)) continue;
    Box3 box = curve_bounds(m, c);
    for (size_t k = 0; k < f->embedded_points.len; k++) {
      const Point *p = model_point(m, f->embedded_points.data[k]);
      if (p && box_has(&box, p->xyz, t->at_end)) untangle__meet_at_point(t, c, p->tag);
    }
  }
  vec_free(&tag);
  vec_free(&start);
}

bool untangle__meet_embedded_points(Untangler *t)
{
  for (size_t i = 0; t->meet && i < model_faces(t->g->model); i++) {
    const Face *f = model_face_at(t->g->model, i);
    if (f->embedded_points.len && f->planar && !f->transfinite) meet_points_of_face(t, f);
  }
  return t->meet && t->meet->len;
}

// Where two whole lines cross, rounded the same whichever of their edges are looked at. False if they only do by rounding.
static bool lines_cross(const Model *m, const Face *frame, const Curve *a, const Curve *b, Vec3 *at)
{
  Vec2 p[4];
  int end[4] = {a->begin, a->end, b->begin, b->end};
  for (int i = 0; i < 4; i++) p[i] = face_to_plane(frame, model_point(m, end[i])->xyz);
  const double *q[4] = {&p[0].x, &p[1].x, &p[2].x, &p[3].x};
  if (segments_meet(q[0], q[1], q[2], q[3]) != SEG_CROSS) return false;
  double x[2];
  segments_point(q[0], q[1], q[2], q[3], x);
  *at = face_from_plane(frame, (Vec2){x[0], x[1]});
  return true;
}

void untangle__curves_meet(Untangler *t, const Face *frame, const Meeting *meeting)
{
  const Model *m = t->g->model;
  uint32_t ka = meeting->a, kb = meeting->b;
  const Curve *a = model_curve_at(m, ka), *b = model_curve_at(m, kb);
  double u = meeting->u, v = meeting->v;
  Vec3 at = meeting->at;
  SegMeet how = meeting->how;
  if (untangle__may_split(t, ka, kb, how == SEG_CROSS ? SEG_TOUCH : how) && untangle__meet_at_ends(t, a, b)) return;
  if (!untangle__may_split(t, ka, kb, how == SEG_TOUCH ? SEG_CROSS : how)) {
    if (how != SEG_CROSS || (!report_leaving(t, ka, kb, at) && !report_leaving(t, kb, ka, at))) report_crossing(t, a, b, at, how);
    return;
  }
  if (untangle__is_line(a) && untangle__is_line(b)) lines_cross(m, frame, a, b, &at);
  if (u < 0) u = curve_nearest(m, a, at), v = curve_nearest(m, b, at);
  push_meeting(t, a, u, at, 0);
  push_meeting(t, b, v, at, 0);
}
