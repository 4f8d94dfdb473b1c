// mesh1d_cross.c - edges of the 1D mesh that cross: split and snapped to their curves, or a true crossing of the curves
// SPDX-License-Identifier: MIT
//
// [book §4.3], Figure 4.3: curves that come close without touching may have edges that cross. Those are halved on their curve, and
// all edges are looked at again, until none cross. If the curves themselves meet, no splitting helps: that is an error. Only
// curves of a common face matter; faces in one plane are looked at together.
#include "base/base.h"

#include <math.h>

#include "base/map.h"
#include "base/mem.h"
#include "geom/intersect.h"
#include "mesh/mesh1d_int.h"

// A plane with faces in it.
typedef struct {
  const Face *frame;
  U32Vec face, curve; // indices; curves ascending and each once
} Plane;
typedef Vec(Plane) PlaneVec;

typedef struct {
  Mesh1d *g;
  const Options *opt;
  Diag *diag;
  CurveMeetings *meet;  // where curves may be split; NULL: nowhere
  double near;          // curves nearer than this meet
  double at_end;        // a place nearer to an end than this is the end, where curves are split
  PlaneVec plane;
  U32Vec *faces_of, *bounds_of; // per curve, ascending: the faces it is on, and those of them that it bounds
  uint8_t **split;      // per curve: edges to be halved in this round, or NULL
  int reported;
} Untangler;

enum { MOST_REPORTED = 10, MOST_PAIRS = 1000000 };

// ---- planes -----------------------------------------------------------------------------------------------------------------

static bool same_vec(Vec3 a, Vec3 b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

// Equal frames up to the sense of the normal: the coordinates in one are those in the other, perhaps mirrored.
static bool same_plane(const Face *a, const Face *b)
{
  return same_vec(a->origin, b->origin) && same_vec(a->axis_u, b->axis_u) &&
         (same_vec(a->axis_v, b->axis_v) || same_vec(a->axis_v, vec3_scale(-1, b->axis_v)));
}

static void add_curve_of_face(Untangler *t, Plane *plane, uint32_t face, int tag, bool bounds)
{
  uint32_t k = mesh1d_index(t->g, tag);
  if (k == NONE || t->g->curve[k].n < 2) return;
  U32Vec *on = &t->faces_of[k];
  if (!on->len || vec_last(on) != face) vec_push(on, face);
  on = &t->bounds_of[k];
  if (bounds && (!on->len || vec_last(on) != face)) vec_push(on, face);
  vec_push(&plane->curve, k);
}

static int by_index(const void *a, const void *b)
{
  uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
  return x < y ? -1 : x > y;
}

static void keep_each_once(U32Vec *v)
{
  if (!v->len) return;
  qsort(v->data, v->len, sizeof *v->data, by_index);
  size_t n = 1;
  for (size_t i = 1; i < v->len; i++)
    if (v->data[i] != v->data[n - 1]) v->data[n++] = v->data[i];
  v->len = n;
}

// Planes are few where faces are many: the last ones used are looked at first.
static Plane *plane_of(Untangler *t, const Face *f)
{
  for (size_t i = t->plane.len; i > 0; i--)
    if (same_plane(t->plane.data[i - 1].frame, f)) return &t->plane.data[i - 1];
  vec_push(&t->plane, ((Plane){.frame = f}));
  return &vec_last(&t->plane);
}

static void find_planes(Untangler *t)
{
  const Model *m = t->g->model;
  for (uint32_t k = 0; k < model_faces(m); k++) {
    const Face *f = model_face_at(m, k);
    if (f->type != FACE_PLANE || !f->planar) continue;
    Plane *plane = plane_of(t, f);
    vec_push(&plane->face, k);
    for (int i = 0; i < f->nloop; i++) {
      const Loop *loop = model_loop(m, f->loop[i]);
      for (int j = 0; loop && j < loop->ncurve; j++) add_curve_of_face(t, plane, k, loop->curve[j], true);
    }
    for (size_t i = 0; i < f->embedded_curves.len; i++) add_curve_of_face(t, plane, k, f->embedded_curves.data[i], false);
  }
  for (size_t i = 0; i < t->plane.len; i++) keep_each_once(&t->plane.data[i].curve);
}

static bool meet_in_list(const U32Vec *x, const U32Vec *y)
{
  for (size_t i = 0, j = 0; i < x->len && j < y->len;) {
    if (x->data[i] == y->data[j]) return true;
    if (x->data[i] < y->data[j]) i++;
    else j++;
  }
  return false;
}

static bool share_a_face(const Untangler *t, uint32_t a, uint32_t b)
{
  return meet_in_list(&t->faces_of[a], &t->faces_of[b]);
}

// Whether two curves are split where they meet. Healing splits all; else embedded ones are, unless one of them would leave the face
// through the other, which bounds it.
static bool may_split(const Untangler *t, uint32_t a, uint32_t b, SegMeet how)
{
  if (!t->meet || model_curve_at(t->g->model, a)->joined || model_curve_at(t->g->model, b)->joined) return false;
  if (t->opt->Mesh_Heal) return true;
  if (how == SEG_OVERLAP) return false;
  if (meet_in_list(&t->bounds_of[a], &t->bounds_of[b])) return false;
  return how == SEG_TOUCH || !(meet_in_list(&t->bounds_of[a], &t->faces_of[b]) || meet_in_list(&t->faces_of[a], &t->bounds_of[b]));
}

// ---- the edges of a plane ---------------------------------------------------------------------------------------------------

typedef struct {
  DoubleVec xy;
  U32Vec end;           // 2 per edge
  U32Vec curve, edge;   // of each edge; of a probe around a point NONE and the point's tag
} Edges;

static void edges_free(Edges *e)
{
  vec_free(&e->xy);
  vec_free(&e->end);
  vec_free(&e->curve);
  vec_free(&e->edge);
}

static uint32_t add_vertex(Edges *e, const Face *frame, Vec3 p)
{
  Vec2 q = face_to_plane(frame, p);
  vec_push(&e->xy, q.x);
  vec_push(&e->xy, q.y);
  return (uint32_t)(e->xy.len / 2 - 1);
}

static uint32_t end_vertex(Edges *e, Map *seen, const Face *frame, int tag, Vec3 p)
{
  bool fresh;
  uint32_t *v = map_slot(seen, (uint64_t)tag, NONE, &fresh);
  if (fresh) *v = add_vertex(e, frame, p);
  return *v;
}

// A cross of two short edges about a point, to be met by curves that pass so near that they have to be cut there.
static void add_probe(const Untangler *t, Edges *e, const Face *frame, int tag)
{
  Vec2 q = face_to_plane(frame, model_point(t->g->model, tag)->xyz);
  for (int i = 0; i < 2; i++) {
    double dx = i ? 0 : t->at_end / 2, dy = i ? t->at_end / 2 : 0;
    for (int side = -1; side <= 1; side += 2) {
      vec_push(&e->xy, q.x + side * dx);
      vec_push(&e->xy, q.y + side * dy);
      vec_push(&e->end, (uint32_t)(e->xy.len / 2 - 1));
    }
    vec_push(&e->curve, NONE);
    vec_push(&e->edge, (uint32_t)tag);
  }
}

// Probes about all points of the plane's curves and those embedded in its faces.
static void add_probes(const Untangler *t, const Plane *plane, Edges *e)
{
  const Model *m = t->g->model;
  Map seen = {0};
  IntVec tag = {0};
  for (size_t i = 0; i < plane->curve.len; i++) {
    const Curve *c = model_curve_at(m, plane->curve.data[i]);
    vec_push(&tag, c->begin);
    vec_push(&tag, c->end);
  }
  for (size_t i = 0; i < plane->face.len; i++) {
    const IntVec *p = &model_face_at(m, plane->face.data[i])->embedded_points;
    for (size_t k = 0; k < p->len; k++) vec_push(&tag, p->data[k]);
  }
  for (size_t i = 0; i < tag.len; i++) {
    bool fresh;
    map_slot(&seen, (uint64_t)tag.data[i], 1, &fresh);
    if (fresh) add_probe(t, e, plane->frame, tag.data[i]);
  }
  map_free(&seen);
  vec_free(&tag);
}

static void collect_edges(const Untangler *t, const Plane *plane, Edges *e)
{
  Map seen = {0};
  for (size_t i = 0; i < plane->curve.len; i++) {
    uint32_t k = plane->curve.data[i];
    const Curve *c = model_curve_at(t->g->model, k);
    const CurveMesh *cm = &t->g->curve[k];
    uint32_t a = end_vertex(e, &seen, plane->frame, c->begin, cm->p[0]);
    for (uint32_t n = 1; n < cm->n; n++) {
      uint32_t b = n + 1 < cm->n ? add_vertex(e, plane->frame, cm->p[n])
                                 : end_vertex(e, &seen, plane->frame, c->end, cm->p[n]);
      vec_push(&e->end, a);
      vec_push(&e->end, b);
      vec_push(&e->curve, k);
      vec_push(&e->edge, n - 1);
      a = b;
    }
  }
  map_free(&seen);
}

// ---- do the curves themselves meet? -----------------------------------------------------------------------------------------

typedef struct {
  const Curve *c;
  double lo, hi;  // parameters of the edge
} Piece;

static bool is_common_end(const Model *m, const Curve *a, const Curve *b, Vec3 p, double near)
{
  int ends[2] = {a->begin, a->end};
  for (int i = 0; i < 2; i++)
    if ((ends[i] == b->begin || ends[i] == b->end) && vec3_distance(model_point(m, ends[i])->xyz, p) <= near) return true;
  return false;
}

// Newton's iteration for a(u) = b(v) in the frame's plane from the middles, kept inside both pieces. True if they meet, in *at.
// Then the pieces shrink to it.
static bool pieces_meet(const Model *m, const Face *frame, Piece *a, Piece *b, double near, Vec3 *at)
{
  double u = (a->lo + a->hi) / 2, v = (b->lo + b->hi) / 2;
  for (int it = 0; it < 60; it++) {
    Vec3 p = curve_point(m, a->c, u), q = curve_point(m, b->c, v);
    *at = p;
    if (vec3_distance(p, q) <= near) {
      a->lo = a->hi = u;
      b->lo = b->hi = v;
      return true;
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
  if (t->reported++ >= MOST_REPORTED) return;
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
  if (meet_in_list(&t->bounds_of[ka], &t->bounds_of[kb]) || !meet_in_list(&t->faces_of[ka], &t->bounds_of[kb])) return false;
  if (t->reported++ >= MOST_REPORTED) return true;
  const Model *m = t->g->model;
  const Curve *a = model_curve_at(m, ka), *b = model_curve_at(m, kb);
  size_t i = 0;
  while (!meet_in_list(&(U32Vec){.data = &t->faces_of[ka].data[i], .len = 1}, &t->bounds_of[kb])) i++;
  diag_error(t->diag, a->loc, "curve %d, embedded in surface %d, leaves it through curve %d at (%.10g, %.10g)", a->tag,
             model_face_at(m, t->faces_of[ka].data[i])->tag, b->tag, at.x, at.y);
  diag_note(t->diag, b->loc, "curve %d is made here", b->tag);
  return true;
}

static bool is_line(const Curve *c)
{
  return c->type == CURVE_LINE;
}

static void push_meeting(Untangler *t, const Curve *c, double u, Vec3 at, int point)
{
  vec_push(t->meet, ((CurveMeeting){c->tag, point, u, at}));
}

// If the point lies on the curve away from its ends, the curve is to be cut there.
static bool meet_at_point(Untangler *t, const Curve *c, int point)
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

// The same of both end points of b. Returns how many.
static int meet_at_ends(Untangler *t, const Curve *a, const Curve *b)
{
  if (a == b) return 0;
  return meet_at_point(t, a, b->begin) + (b->end != b->begin && meet_at_point(t, a, b->end));
}

static bool box_has(const Box3 *b, Vec3 p, double d)
{
  return p.x >= b->lo.x - d && p.x <= b->hi.x + d && p.y >= b->lo.y - d && p.y <= b->hi.y + d && p.z >= b->lo.z - d && p.z <= b->hi.z + d;
}

// What prescribes the nodes of a curve forbids to cut it.
static bool is_prescribed(const Curve *c)
{
  return c->transfinite > 0 || c->layers.n || c->copy_of || c->periodic_master || c->joined || c->degenerate || c->dissolved;
}

// Points embedded in a face that lie on a curve of it: the curve is cut there. O(points times curves), of boxes.
static void meet_embedded_points(Untangler *t, const Face *f)
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
      if (p && box_has(&box, p->xyz, t->at_end)) meet_at_point(t, c, p->tag);
    }
  }
  vec_free(&tag);
  vec_free(&start);
}

static bool points_on_curves(Untangler *t)
{
  for (size_t i = 0; t->meet && i < model_faces(t->g->model); i++) {
    const Face *f = model_face_at(t->g->model, i);
    if (f->embedded_points.len && f->planar && !f->transfinite) meet_embedded_points(t, f);
  }
  return t->meet && t->meet->len;
}

// Where two edges that are on their curves meet: the ends of a touching or overlapping one, or the crossing.
static Vec3 meeting_point(const Face *frame, const double *a, const double *b, const double *c, const double *d, SegMeet how)
{
  double p[2] = {0, 0};
  if (how == SEG_CROSS) {
    segments_point(a, b, c, d, p);
  } else {
    // An end of one that lies on the other; of an overlap the larger of the smaller ends.
    const double *s0 = lex_compare(a, b) < 0 ? a : b, *t0 = lex_compare(c, d) < 0 ? c : d;
    const double *candidate[4] = {a, b, c, d}, *best = lex_compare(s0, t0) < 0 ? t0 : s0;
    for (int i = 0; how == SEG_TOUCH && i < 4; i++) {
      const double *x = i < 2 ? c : a, *y = i < 2 ? d : b, *q = candidate[i];
      if (orient2d(x, y, q) == 0 && in_diametral_circle(x, y, q) >= 0) best = q;
    }
    p[0] = best[0], p[1] = best[1];
  }
  return face_from_plane(frame, (Vec2){p[0], p[1]});
}

static void mark(Untangler *t, uint32_t k, uint32_t edge)
{
  if (!t->split[k]) t->split[k] = mem_zalloc(t->g->curve[k].n);
  t->split[k][edge] = 1;
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

// Curves that truly meet at `at`, a at u and b at v: split there if they may be, else an error. Where ends lie on the other curve,
// only that is cut.
static void curves_meet(Untangler *t, const Plane *plane, uint32_t ka, uint32_t kb, double u, double v, Vec3 at, SegMeet how)
{
  const Model *m = t->g->model;
  const Curve *a = model_curve_at(m, ka), *b = model_curve_at(m, kb);
  if (may_split(t, ka, kb, how == SEG_CROSS ? SEG_TOUCH : how) && meet_at_ends(t, a, b) + meet_at_ends(t, b, a) > 0) return;
  if (!may_split(t, ka, kb, how == SEG_TOUCH ? SEG_CROSS : how)) {
    if (how != SEG_CROSS || (!report_leaving(t, ka, kb, at) && !report_leaving(t, kb, ka, at))) report_crossing(t, a, b, at, how);
    return;
  }
  if (is_line(a) && is_line(b)) lines_cross(m, plane->frame, a, b, &at);
  if (u < 0) u = curve_nearest(m, a, at), v = curve_nearest(m, b, at);
  push_meeting(t, a, u, at, 0);
  push_meeting(t, b, v, at, 0);
}

// One pair of edges: a true crossing, or marked for halving. True if something is to be done about it.
static bool treat_pair(Untangler *t, const Plane *plane, const Edges *e, const SegPair *pair)
{
  uint32_t ka = e->curve.data[pair->a], kb = e->curve.data[pair->b], ea = e->edge.data[pair->a], eb = e->edge.data[pair->b];
  if (ka == NONE || kb == NONE) {
    uint32_t k = ka == NONE ? kb : ka;
    return k != NONE && meet_at_point(t, model_curve_at(t->g->model, k), (int)(ka == NONE ? ea : eb));
  }
  if (ka != kb && !share_a_face(t, ka, kb) && !(t->opt->Mesh_Heal && t->meet)) return false;
  const Model *m = t->g->model;
  const Curve *a = model_curve_at(m, ka), *b = model_curve_at(m, kb);
  const uint32_t *end = e->end.data;
  const double *xy = e->xy.data;
  const double *p[4] = {xy + 2 * (size_t)end[2 * pair->a], xy + 2 * (size_t)end[2 * pair->a + 1],
                        xy + 2 * (size_t)end[2 * pair->b], xy + 2 * (size_t)end[2 * pair->b + 1]};
  if (is_line(a) && is_line(b)) {
    curves_meet(t, plane, ka, kb, -1, -1, meeting_point(plane->frame, p[0], p[1], p[2], p[3], pair->how), pair->how);
    return true;
  }
  const CurveMesh *ma = &t->g->curve[ka], *mb = &t->g->curve[kb];
  Piece pa = {a, ma->u[ea], ma->u[ea + 1]}, pb = {b, mb->u[eb], mb->u[eb + 1]};
  Vec3 at;
  bool adjacent = ka == kb && (ea + 1 == eb || eb + 1 == ea);
  if (!adjacent && pieces_meet(m, plane->frame, &pa, &pb, t->near, &at) && !is_common_end(m, a, b, at, 10 * t->near)) {
    curves_meet(t, plane, ka, kb, pa.lo, pb.lo, at, pair->how);
    return true;
  }
  if (may_split(t, ka, kb, SEG_TOUCH) && meet_at_ends(t, a, b) + meet_at_ends(t, b, a) > 0) return true;
  if (!is_line(a)) mark(t, ka, ea);
  if (!is_line(b)) mark(t, kb, eb);
  return true;
}

// ---- rounds ---------------------------------------------------------------------------------------------------------------------

// Look at one plane; the number of pairs that need something.
static size_t look_at_plane(Untangler *t, const Plane *plane, const Curve *first[2])
{
  Edges e = {0};
  SegPairVec pair = {0};
  size_t bad = 0;
  collect_edges(t, plane, &e);
  if (t->meet && t->opt->Mesh_Heal) add_probes(t, plane, &e);
  segments_intersect(e.xy.data, e.end.data, e.end.len / 2, MOST_PAIRS, &pair);
  for (size_t i = 0; i < pair.len; i++) {
    if (!treat_pair(t, plane, &e, &pair.data[i])) continue;
    uint32_t ka = e.curve.data[pair.data[i].a], kb = e.curve.data[pair.data[i].b];
    if (bad++ == 0 && ka != NONE && kb != NONE) {
      first[0] = model_curve_at(t->g->model, ka);
      first[1] = model_curve_at(t->g->model, kb);
    }
  }
  edges_free(&e);
  vec_free(&pair);
  return bad;
}

static void halve_marked(Untangler *t)
{
  for (size_t k = 0; k < t->g->ncurve; k++) {
    if (!t->split[k]) continue;
    for (uint32_t i = t->g->curve[k].n - 1; i > 0; i--) {
      if (!t->split[k][i - 1]) continue;
      mesh1d_split(t->g, k, i - 1, -1);
      t->g->nsplit++;
    }
    free(t->split[k]);
    t->split[k] = NULL;
  }
}

static bool run_rounds(Untangler *t)
{
  for (int round = 0;; round++) {
    size_t bad = 0;
    const Curve *first[2] = {NULL, NULL};
    for (size_t i = 0; i < t->plane.len; i++) bad += look_at_plane(t, &t->plane.data[i], first);
    if (t->reported > MOST_REPORTED) diag_note(t->diag, NO_LOC, "and %d more crossings", t->reported - MOST_REPORTED);
    if (t->reported || (t->meet && t->meet->len)) return false;
    if (!bad) return true;
    if (round >= t->opt->Mesh_MaxRetries) {
      diag_error(t->diag, first[1]->loc, "edges of curve %d and curve %d still cross after %d rounds of halving (Mesh.MaxRetries)",
                 first[1]->tag, first[0]->tag, round);
      diag_note(t->diag, first[0]->loc, "curve %d is made here", first[0]->tag);
      return false;
    }
    halve_marked(t);
    t->g->rounds++;
  }
}

bool mesh1d_untangle(Mesh1d *g, const Options *opt, Diag *diag)
{
  return mesh1d__untangle(g, opt, NULL, diag);
}

bool mesh1d__untangle(Mesh1d *g, const Options *opt, CurveMeetings *meet, Diag *diag)
{
  Box3 b = model_bounds(g->model);
  double size = b.lo.x <= b.hi.x ? vec3_distance(b.lo, b.hi) : 1;
  Untangler t = {.g = g, .opt = opt, .diag = diag, .meet = meet, .near = 1e-12 * size, .at_end = opt->Geometry_Tolerance * size};
  t.faces_of = mem_zalloc((g->ncurve + 1) * sizeof *t.faces_of);
  t.bounds_of = mem_zalloc((g->ncurve + 1) * sizeof *t.bounds_of);
  t.split = mem_zalloc((g->ncurve + 1) * sizeof *t.split);
  find_planes(&t);
  bool good = !points_on_curves(&t) && run_rounds(&t);
  for (size_t k = 0; k < g->ncurve; k++) {
    vec_free(&t.faces_of[k]);
    vec_free(&t.bounds_of[k]);
    free(t.split[k]);
  }
  for (size_t i = 0; i < t.plane.len; i++) {
    vec_free(&t.plane.data[i].face);
    vec_free(&t.plane.data[i].curve);
  }
  vec_free(&t.plane);
  free(t.faces_of);
  free(t.bounds_of);
  free(t.split);
  return good;
}
