// face_graph.c - the plane straight-line graph of a face, and the empty mesh made of it
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/face_graph.h"

void face_graph_free(FaceGraph *g)
{
  map_free(&g->local);
  map_free(&g->has_curve);
  map_free(&g->middle);
  vec_free(&g->middle_node);
  vec_free(&g->middle_xy);
  vec_free(&g->node);
  vec_free(&g->xy);
  vec_free(&g->ends);
  vec_free(&g->curve);
  vec_free(&g->embedded);
}

static uint32_t graph_vertex(FaceGraph *g, const Face *f, const EdgeNodes *en, uint32_t node)
{
  bool added;
  uint32_t *slot = map_slot(&g->local, node, (uint32_t)g->node.len, &added);
  if (added) {
    Vec2 q = face_to_plane(f, en->xyz[node]);
    vec_push(&g->node, node);
    vec_push(&g->xy, q.x);
    vec_push(&g->xy, q.y);
  }
  return *slot;
}

// What a graph is built from.
typedef struct {
  const Model *model;
  const Mesh1d *curves;
  const EdgeNodes *nodes;
} Source;

static void add_middle(FaceGraph *g, const Face *f, const EdgeNodes *en, uint32_t a, uint32_t b, uint32_t node)
{
  Vec2 q = face_to_plane(f, en->xyz[node]);
  map_set(&g->middle, map_pair(a, b), (uint32_t)g->middle_node.len);
  vec_push(&g->middle_node, node);
  vec_push(&g->middle_xy, q.x);
  vec_push(&g->middle_xy, q.y);
}

typedef struct {
  FaceGraph *g;
  const Source *s;
  const Face *frame;
} Adding;

static void graph_add_curve(void *ctx, int tag, bool embedded)
{
  const Adding *to = ctx;
  const Source *s = to->s;
  const Face *f = to->frame;
  FaceGraph *g = to->g;
  bool fresh;
  map_slot(&g->has_curve, (uint64_t)abs(tag), 1, &fresh);
  if (!fresh) return;
  size_t k = mesh1d_index(s->curves, tag);
  const CurveMesh *cm = &s->curves->curve[k];
  for (size_t i = 0, step = g->coarse ? 2 : 1; i + 1 < cm->n; i += step) {
    uint32_t a = graph_vertex(g, f, s->nodes, edge_nodes_at(s->nodes, s->model, s->curves, k, i));
    uint32_t b = graph_vertex(g, f, s->nodes, edge_nodes_at(s->nodes, s->model, s->curves, k, i + step));
    if (g->coarse) add_middle(g, f, s->nodes, a, b, edge_nodes_at(s->nodes, s->model, s->curves, k, i + 1));
    vec_push(&g->ends, a);
    vec_push(&g->ends, b);
    vec_push(&g->curve, tag < 0 ? -tag : tag);
    vec_push(&g->embedded, embedded);
  }
}

static void graph_add_point(void *ctx, uint32_t node)
{
  const Adding *to = ctx;
  graph_vertex(to->g, to->frame, to->s->nodes, node);
}

static int compare_abs(const void *a, const void *b)
{
  int x = abs(*(const int *)a), y = abs(*(const int *)b);
  return (x > y) - (x < y);
}

static void visit_embedded(const Model *m, const Face *f, const FaceVisitor *v, void *ctx, const IntVec *bounding)
{
  for (size_t i = 0; i < f->embedded_curves.len; i++) {
    int tag = f->embedded_curves.data[i];
    if (!bounding->len || !bsearch(&tag, bounding->data, bounding->len, sizeof tag, compare_abs)) v->curve(ctx, tag, true);
  }
  for (size_t i = 0; i < f->embedded_points.len; i++) {
    uint32_t node = edge_nodes_point(m, f->embedded_points.data[i]);
    if (node != NONE) v->point(ctx, node);
  }
}

void face_graph_visit(const Model *m, const Face *f, const FaceVisitor *v, void *ctx)
{
  IntVec curve = {0}, start = {0};
  if (f->united) face_boundary_united(m, f, &curve);
  else face_boundary(m, f, &curve, &start);
  qsort(curve.data, curve.len, sizeof *curve.data, compare_abs);
  for (size_t i = 0, j; i < curve.len; i = j) {
    for (j = i; j < curve.len && abs(curve.data[j]) == abs(curve.data[i]);) j++;
    v->curve(ctx, curve.data[i], (j - i) % 2 == 0);
  }
  visit_embedded(m, f, v, ctx, &curve);
  for (size_t k = 0; f->united && k < model_faces(m); k++)
    if (model_face_at(m, k) != f && model_face_at(m, k)->united == f->tag) visit_embedded(m, model_face_at(m, k), v, ctx, &curve);
  vec_free(&curve);
  vec_free(&start);
}

void face_graph_add(FaceGraph *g, const Model *m, const Face *f, const Mesh1d *curves, const EdgeNodes *nodes)
{
  static const FaceVisitor visitor = {graph_add_curve, graph_add_point};
  const Source s = {m, curves, nodes};
  Adding to = {g, &s, g->frame ? g->frame : f};
  face_graph_visit(m, f, &visitor, &to);
}

static SrcLoc curve_loc(const Model *m, int tag)
{
  const Curve *c = model_curve(m, tag);
  return c ? c->loc : NO_LOC;
}

static void report_crossing(const Model *m, const Face *f, const FaceGraph *g, const TriSegEvent *e, Diag *diag)
{
  int a = g->curve.data[e->a], b = e->b == NONE ? 0 : g->curve.data[e->b];
  Vec3 p = face_from_plane(f, (Vec2){e->p[0], e->p[1]});
  const char *what = e->what == TRI_SEG_CROSSES ? "crosses" : "runs along";
  if (a == b)
    diag_error(diag, curve_loc(m, a), "curve %d %s itself at (%g, %g, %g), on surface %d", a, what, p.x, p.y, p.z, f->tag);
  else
    diag_error(diag, curve_loc(m, a), "curve %d %s curve %d at (%g, %g, %g), on surface %d", a, what, b, p.x, p.y, p.z,
               f->tag);
  if (a != b && b) diag_note(diag, curve_loc(m, b), "curve %d is defined here", b);
}

// Force the segments; false after errors. One message per pair of curves, three at most.
static bool recover(Tri *t, const FaceGraph *g, const Model *m, const Face *f, Diag *diag)
{
  TriSegEvents events = {0};
  tri_insert_segments(t, g->ends.data, NULL, g->curve.len, &events);
  int said = 0;
  Map pairs = {0};
  for (size_t i = 0; i < events.len; i++) {
    const TriSegEvent *e = &events.data[i];
    if (e->what == TRI_SEG_CROSSES || e->what == TRI_SEG_OVERLAPS) {
      bool fresh;
      uint32_t ca = (uint32_t)g->curve.data[e->a], cb = e->b == NONE ? 0 : (uint32_t)g->curve.data[e->b];
      map_slot(&pairs, map_pair(ca, cb), 1, &fresh);
      if (fresh && said++ < 3) report_crossing(m, f, g, e, diag);
    } else if (e->what == TRI_SEG_VERTEX) {
      Vec3 p = face_from_plane(f, (Vec2){tri_xy(t, e->v)[0], tri_xy(t, e->v)[1]});
      if (said++ < 3)
        diag_error(diag, curve_loc(m, g->curve.data[e->a]),
                   "curve %d passes through a node that is not its own at (%g, %g, %g), on surface %d",
                   g->curve.data[e->a], p.x, p.y, p.z, f->tag);
    }
  }
  map_free(&pairs);
  vec_free(&events);
  return said == 0;
}

// Do the loops of f run along the curve? Then they do so twice, or it would bound f.
static bool in_loops(const Model *m, const Face *f, int tag)
{
  IntVec curve = {0}, start = {0};
  bool found = false;
  if (f->united) face_boundary_united(m, f, &curve);
  else face_boundary(m, f, &curve, &start);
  for (size_t i = 0; i < curve.len && !found; i++) found = abs(curve.data[i]) == tag;
  vec_free(&curve);
  vec_free(&start);
  return found;
}

// Embedded curves must lie in the face: every segment needs a triangle of the face beside it. Two holes may have a curve in common,
// which is in no triangle then. Points may be left out.
static bool embedded_inside(const Tri *t, const FaceGraph *g, const Model *m, const Face *f, Diag *diag)
{
  bool *seen = mem_zalloc((g->node.len + g->curve.len) * sizeof *seen), good = true;
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    for (EdgeId e = 3 * k; e < 3 * k + 3; e++) {
      if (t->vert[e] < g->node.len) seen[t->vert[e]] = true;
      if (tri_is_segment(t, e)) seen[g->node.len + t->seg[e]] = true;
    }
  }
  int between = 0; // the last curve found between holes
  for (size_t i = 0; i < g->curve.len && good; i++) {
    if (seen[g->node.len + i]) continue;
    int tag = g->curve.data[i];
    if (tag == between || (g->embedded.data[i] && in_loops(m, f, tag))) {
      between = tag;
      seen[g->ends.data[2 * i]] = seen[g->ends.data[2 * i + 1]] = true;
      continue;
    }
    const double *p = &g->xy.data[2 * g->ends.data[2 * i]];
    Vec3 q = face_from_plane(f, (Vec2){p[0], p[1]});
    diag_error(diag, f->loc, "%s curve %d is outside surface %d near (%g, %g, %g)", g->embedded.data[i] ? "embedded" : "boundary", tag,
               f->tag, q.x, q.y, q.z);
    good = false;
  }
  for (size_t i = 0; i < g->node.len && good; i++) {
    if (seen[i]) continue;
    Vec3 q = face_from_plane(f, (Vec2){g->xy.data[2 * i], g->xy.data[2 * i + 1]});
    diag_warning(diag, f->loc, "embedded point at (%g, %g, %g) is outside surface %d: it is left out", q.x, q.y, q.z, f->tag);
  }
  free(seen);
  return good;
}

// The point or curve that vertex v is a node of.
static const char *owner_of(const FaceGraph *g, const Model *m, uint32_t v, int *tag)
{
  if (g->node.data[v] < model_points(m)) {
    *tag = model_point_at(m, g->node.data[v])->tag;
    return "point";
  }
  size_t i = 0;
  while (i + 1 < g->ends.len && g->ends.data[i] != v) i++;
  *tag = g->curve.data[i / 2];
  return "curve";
}

// Distinct nodes at one place cannot both be vertices: name the place.
static bool no_duplicates(const U32Vec *dup, const FaceGraph *g, const Model *m, const Face *f, Diag *diag)
{
  if (!dup->len) return true;
  uint32_t v = dup->data[0], w = 0;
  const double *xy = g->xy.data, *p = xy + 2 * v;
  while (w + 1 < g->node.len && (w == v || xy[2 * w] != p[0] || xy[2 * w + 1] != p[1])) w++;
  int tag[2];
  const char *owner[2] = {owner_of(g, m, w, &tag[0]), owner_of(g, m, v, &tag[1])};
  Vec3 q = face_from_plane(f, (Vec2){p[0], p[1]});
  diag_error(diag, f->loc, "surface %d has %zu node%s that coincide%s with others, the first at (%g, %g, %g): of %s %d and of %s %d",
             f->tag, dup->len, dup->len > 1 ? "s" : "", dup->len > 1 ? "" : "s", q.x, q.y, q.z, owner[0], tag[0], owner[1], tag[1]);
  diag_note(diag, NO_LOC, "curves that are to be joined must share their end points; Coherence; merges equal ones");
  return false;
}

bool face_graph_recover(const FaceGraph *g, const Model *m, const Face *f, Tri *t, Diag *diag)
{
  U32Vec dup = {0};
  TriBuild how = {.threads = 1, .duplicates = &dup};
  TriBuildResult r = tri_build(t, g->xy.data, g->node.len, &how);
  bool good = r == TRI_BUILD_GOOD;
  if (r == TRI_BUILD_NOT_FINITE)
    diag_error(diag, f->loc, "surface %d has a node whose coordinates are not finite numbers", f->tag);
  if (r == TRI_BUILD_TOO_MANY) diag_error(diag, f->loc, "surface %d has too many nodes", f->tag);
  good = good && no_duplicates(&dup, g, m, f, diag);
  vec_free(&dup);
  if (good && t->dim != 2) {
    diag_error(diag, f->loc, "surface %d has no area: its boundary nodes lie on a line", f->tag);
    good = false;
  }
  return good && recover(t, g, m, f, diag);
}

bool face_graph_mesh(const FaceGraph *g, const Model *m, const Face *f, Tri *t, Diag *diag)
{
  if (!face_graph_recover(g, m, f, t, diag)) return false;
  TriCarve carve = {.embedded = g->embedded.data, .even_odd = true};
  if (tri_carve(t, &carve) == 0) {
    diag_error(diag, f->loc, "surface %d has no area", f->tag);
    return false;
  }
  return embedded_inside(t, g, m, f, diag);
}
