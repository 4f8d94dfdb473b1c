// mesh1d_untangle.c - edges of the 1D mesh that cross: split and snapped to their curves, or a true crossing of the curves
// SPDX-License-Identifier: MIT
//
// [book §4.3], Figure 4.3: curves that come close without touching may have edges that cross. Those are halved on their curve, and
// all edges are looked at again, until none cross. If the curves themselves meet, no splitting helps: that is an error. Only
// curves of a common face matter; faces in one plane are looked at together.
#include "base/base.h"

#include <math.h>

#include "base/map.h"
#include "base/mem.h"
#include "mesh/mesh1d_untangle_int.h"

enum { MOST_PAIRS = 1000000 };

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

// ---- pairs of edges -------------------------------------------------------------------------------------------------------

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

// One pair of edges: a true crossing, or marked for halving. True if something is to be done about it.
static bool treat_pair(Untangler *t, const Plane *plane, const Edges *e, const SegPair *pair)
{
  uint32_t ka = e->curve.data[pair->a], kb = e->curve.data[pair->b], ea = e->edge.data[pair->a], eb = e->edge.data[pair->b];
  if (ka == NONE || kb == NONE) {
    uint32_t k = ka == NONE ? kb : ka;
    return k != NONE && untangle__meet_at_point(t, model_curve_at(t->g->model, k), (int)(ka == NONE ? ea : eb));
  }
  if (ka != kb && !untangle__share_a_face(t, ka, kb) && !(t->opt->Mesh_Heal && t->meet)) return false;
  const Model *m = t->g->model;
  const Curve *a = model_curve_at(m, ka), *b = model_curve_at(m, kb);
  const uint32_t *end = e->end.data;
  const double *xy = e->xy.data;
  const double *p[4] = {xy + 2 * (size_t)end[2 * pair->a], xy + 2 * (size_t)end[2 * pair->a + 1],
                        xy + 2 * (size_t)end[2 * pair->b], xy + 2 * (size_t)end[2 * pair->b + 1]};
  Meeting meeting = {.a = ka, .b = kb, .how = pair->how, .u = -1, .v = -1};
  if (untangle__is_line(a) && untangle__is_line(b)) {
    meeting.at = meeting_point(plane->frame, p[0], p[1], p[2], p[3], pair->how);
    untangle__curves_meet(t, plane->frame, &meeting);
    return true;
  }
  const CurveMesh *ma = &t->g->curve[ka], *mb = &t->g->curve[kb];
  Piece pa = {a, ma->u[ea], ma->u[ea + 1]}, pb = {b, mb->u[eb], mb->u[eb + 1]};
  bool adjacent = ka == kb && (ea + 1 == eb || eb + 1 == ea);
  if (!adjacent && untangle__pieces_meet(t, plane->frame, &pa, &pb, &meeting)) {
    untangle__curves_meet(t, plane->frame, &meeting);
    return true;
  }
  if (untangle__may_split(t, ka, kb, SEG_TOUCH) && untangle__meet_at_ends(t, a, b)) return true;
  if (!untangle__is_line(a)) mark(t, ka, ea);
  if (!untangle__is_line(b)) mark(t, kb, eb);
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
    if (t->reported > UNTANGLE_MOST_REPORTED) diag_note(t->diag, NO_LOC, "and %d more crossings", t->reported - UNTANGLE_MOST_REPORTED);
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

bool mesh1d__untangle(Mesh1d *g, const Options *opt, CurveMeetings *meet, Diag *diag)
{
  Box3 b = model_bounds(g->model);
  double size = b.lo.x <= b.hi.x ? vec3_distance(b.lo, b.hi) : 1;
  Untangler t = {.g = g, .opt = opt, .diag = diag, .meet = meet, .near = 1e-12 * size, .at_end = opt->Geometry_Tolerance * size};
  t.split = mem_zalloc((g->ncurve + 1) * sizeof *t.split);
  untangle__find_planes(&t);
  bool good = !untangle__meet_embedded_points(&t) && run_rounds(&t);
  for (size_t k = 0; k < g->ncurve; k++) free(t.split[k]);
  free(t.split);
  untangle__free_planes(&t);
  return good;
}
