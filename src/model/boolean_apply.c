// boolean_apply.c - the faces that a Boolean operation makes take the place of those it was given
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/boolean_int.h"

typedef struct {
  Boolean *b;
  int *point;   // per node: tag, or 0
  Map made;     // curve, from and to of a run -> signed tag of a curve that runs so
  Map reused;   // tags of source curves that stay
  IntVec idle;  // points whose place another took
  bool anew;    // curves were made
} Apply;

static uint64_t key_of(const Run *r, bool turned)
{
  uint64_t h = hash__mix(hash__mix(17, turned ? r->to : r->from), turned ? r->from : r->to);
  return hash__mix(h, r->edge);
}

// ---- what stays -----------------------------------------------------------------------------------------------------------

static uint32_t node_near(const Boolean *b, Vec2 p)
{
  for (uint32_t v = 0; v < b->a.node.len; v++)
    if (vec2_length(vec2_sub(b->a.node.data[v], p)) <= b->tol) return v;
  return NONE;
}

// Where `from` stands on a curve, `to` takes its place.
static void replace_point(Model *m, Curve *c, int from, int to)
{
  Point *p = point__get(m, from), *q = point__get(m, to);
  model__forget_curve(m, c);
  for (int i = 0; i < c->npoint; i++) {
    if (c->point[i] != from) continue;
    c->point[i] = to;
    p->uses--;
    q->uses++;
  }
  int *end[2] = {&c->begin, &c->end};
  for (int i = 0; i < 2; i++) {
    if (*end[i] != from) continue;
    *end[i] = to;
    p->uses--;
    q->uses++;
  }
  vec_push(&m->dirty[1], c->tag);
}

// The end points of curves stand at nodes. Of several at one node the first listed takes the place of all.
static void known_points(Apply *a)
{
  Boolean *b = a->b;
  for (size_t i = 0; i < b->source.len; i++) {
    Curve *c = model_curve(b->m, b->source.data[i]);
    for (int end = 0; end < 2; end++) {
      uint32_t v = node_near(b, end ? b->curve[i].q : b->curve[i].p);
      int tag = end ? c->end : c->begin;
      if (v == NONE || a->point[v] == tag) continue;
      if (!a->point[v]) {
        a->point[v] = tag;
        continue;
      }
      replace_point(b->m, c, tag, a->point[v]);
      vec_push(&a->idle, tag);
    }
  }
}

// Its outlines are the boundary of the face, curve for curve: nothing happened to it.
static bool is_unchanged(const Boolean *b, size_t first, const Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(b->m, f, &curve, &start);
  size_t n = 0;
  bool same = true;
  for (size_t k = first; same && k < b->outline.len && b->outline.data[k].piece == b->outline.data[first].piece; k++)
    for (size_t i = 0; same && i < b->outline.data[k].run.len; i++, n++) {
      const Run *r = &b->outline.data[k].run.data[i];
      bool found = false;
      for (size_t j = 0; j < curve.len && r->whole && !found; j++) found = tag__abs(curve.data[j]) == b->source.data[r->curve];
      same = found;
    }
  same = same && n == curve.len;
  vec_free(&curve);
  vec_free(&start);
  return same;
}

static size_t unchanged_input(const Boolean *b, size_t first)
{
  for (size_t i = 0; i < b->input.len; i++)
    if (is_unchanged(b, first, b->input.data[i].face)) return i;
  return SIZE_MAX;
}

// ---- making -----------------------------------------------------------------------------------------------------------------

static int point_of(Apply *a, uint32_t node)
{
  Boolean *b = a->b;
  if (!a->point[node]) {
    int tag = model__next_tag(b->m, KIND_POINT);
    point__make(b->m, tag, face_from_plane(b->input.data[0].face, b->a.node.data[node]), 0, b->loc);
    a->point[node] = tag;
  }
  return a->point[node];
}

static int new_curve(Apply *a, const Run *r)
{
  Boolean *b = a->b;
  Model *m = b->m;
  int pair[2] = {point_of(a, r->from), point_of(a, r->to)}, tag = model__next_tag(m, KIND_CURVE);
  const ArrCurve *k = &b->curve[r->curve];
  a->anew = true;
  if (k->kind == ARR_LINE) {
    curve__make(m, tag, CURVE_LINE, pair, 2, pair[0], pair[1], b->loc);
    return tag;
  }
  Arc arc = b->arc[r->curve];
  double w = arc.t1 - arc.t0, t0 = arc.t0 + r->u0 * w, t1 = arc.t0 + r->u1 * w;
  arc.t0 = t0;
  arc.t1 = t1;
  if (t1 < t0) { // arcs run forward: against their plane
    arc.b = vec3_scale(-1, arc.b);
    arc.t0 = -t0;
    arc.t1 = -t1;
  }
  bool circle = fabs(vec3_length(arc.a) - vec3_length(arc.b)) <= 1e-13 * vec3_length(arc.a);
  Curve *c = curve__make(m, tag, circle ? CURVE_CIRCLE : CURVE_ELLIPSE, pair, 2, pair[0], pair[1], b->loc);
  c->arc = arena_dup(&m->arena, &arc, sizeof arc);
  return tag;
}

static int curve_of(Apply *a, const Run *r)
{
  if (r->whole) return r->back ? -a->b->source.data[r->curve] : a->b->source.data[r->curve];
  uint32_t known = map_get(&a->made, key_of(r, false));
  if (known != NONE) return (int)known;
  known = map_get(&a->made, key_of(r, true));
  if (known != NONE) return -(int)known;
  int tag = new_curve(a, r);
  map_set(&a->made, key_of(r, false), (uint32_t)tag);
  return tag;
}

static int new_face(Apply *a, size_t first, int tag)
{
  Boolean *b = a->b;
  IntVec loop = {0}, curve = {0};
  uint32_t piece = b->outline.data[first].piece;
  for (size_t k = first; k < b->outline.len && b->outline.data[k].piece == piece; k++) {
    vec_clear(&curve);
    for (size_t i = 0; i < b->outline.data[k].run.len; i++) vec_push(&curve, curve_of(a, &b->outline.data[k].run.data[i]));
    vec_push(&loop, loop__make_hidden(b->m, curve.data, (int)curve.len, b->loc));
  }
  face__make(b->m, tag, FACE_PLANE, loop.data, (int)loop.len, b->loc);
  vec_free(&loop);
  vec_free(&curve);
  return tag;
}

// Edges with one piece on both sides lie in its face.
static void embed_inner(Apply *a, uint32_t piece, int face)
{
  Boolean *b = a->b;
  for (uint32_t e = 0; e < b->a.edge.len && b->op == BOOLEAN_FRAGMENTS; e++) {
    uint32_t f = b->a.face.data[b->a.cycle.data[2 * e]], g = b->a.face.data[b->a.cycle.data[2 * e + 1]];
    if (f != g || b->piece[f] != piece) continue;
    const ArrEdge *g2 = &b->a.edge.data[e];
    Run r = {.curve = g2->curve, .edge = e, .from = g2->from, .to = g2->to, .u0 = g2->u0, .u1 = g2->u1,
             .whole = g2->u0 == 0 && g2->u1 == 1};
    int tag = tag__abs(curve_of(a, &r));
    model_embed(b->m, 1, &tag, 1, face, b->loc, b->diag);
  }
}

// ---- removing ---------------------------------------------------------------------------------------------------------------

static void note_reused(Apply *a)
{
  Boolean *b = a->b;
  for (size_t k = 0; k < b->outline.len; k++)
    for (size_t i = 0; i < b->outline.data[k].run.len; i++) {
      const Run *r = &b->outline.data[k].run.data[i];
      if (r->whole) map_set(&a->reused, (uint64_t)b->source.data[r->curve], 1);
    }
  for (uint32_t e = 0; e < b->a.edge.len && b->op == BOOLEAN_FRAGMENTS; e++) { // cutting curves live on by themselves
    const ArrEdge *g = &b->a.edge.data[e];
    if (g->u0 == 0 && g->u1 == 1) map_set(&a->reused, (uint64_t)b->source.data[g->curve], 1);
  }
}

// The faces that go, their curves that nothing uses, and what of their points neither. Nodes of the result stay.
static void remove_inputs(Apply *a, const bool *stays)
{
  Boolean *b = a->b;
  Model *m = b->m;
  for (size_t v = 0; v < b->a.node.len; v++)
    if (a->point[v]) point__get(m, a->point[v])->uses++;
  for (size_t i = 0; i < b->input.len; i++)
    if (b->input.data[i].drop && !stays[i] && !b->input.data[i].face->uses) face__drop(m, b->input.data[i].tag);
  ShapeVec gone = {0};
  for (size_t i = 0; i < b->source.len; i++) {
    int tag = b->source.data[i];
    bool cutter = false, drop = true;
    for (size_t k = 0; k < b->cutter.len; k++)
      if (b->cutter.data[k].tag == tag) cutter = true, drop = b->cutter.data[k].drop;
    bool mine = cutter && drop;
    for (size_t k = 0; k < b->bounds.data[i].len && !cutter; k++) mine = mine || b->input.data[b->bounds.data[i].data[k]].drop;
    if (mine && map_get(&a->reused, (uint64_t)tag) == NONE) vec_push(&gone, ((Shape){1, tag}));
  }
  model_delete(m, gone.data, gone.len, true);
  vec_free(&gone);
  for (size_t v = 0; v < b->a.node.len; v++)
    if (a->point[v]) point__get(m, a->point[v])->uses--;
  model__recount(m, KIND_FACE);
  model__recount(m, KIND_CURVE);
}

// Points of the nodes that came to nothing.
static void remove_idle_points(Apply *a)
{
  for (size_t v = 0; v < a->b->a.node.len; v++) {
    Shape s = {0, a->point[v]};
    if (s.tag) model_delete(a->b->m, &s, 1, false);
  }
  for (size_t i = 0; i < a->idle.len; i++) {
    Shape s = {0, a->idle.data[i]};
    model_delete(a->b->m, &s, 1, false);
  }
  vec_free(&a->idle);
  model__recount(a->b->m, KIND_POINT);
}

// ---- all ----------------------------------------------------------------------------------------------------------------------

// The tag of the one input that is dropped and comes out as this piece only, if it is free.
static int preserved(const Boolean *b, const Outline *o)
{
  for (size_t i = 0; i < b->input.len; i++) {
    const BooleanInput *in = &b->input.data[i];
    if (!in->drop || in->images != 1 || model_face(b->m, in->tag)) continue;
    for (uint32_t f = 1; f < b->a.nface; f++)
      if (b->piece[f] == o->piece && b->in[f * b->words + i / 64] >> (i % 64) & 1) return in->tag;
  }
  return 0;
}

static void output_cutters(Apply *a, ShapeVec *out)
{
  Boolean *b = a->b;
  for (size_t k = 0; k < b->cutter.len; k++)
    for (uint32_t e = 0; e < b->a.edge.len; e++) {
      const ArrEdge *g = &b->a.edge.data[e];
      bool mine = b->source.data[g->curve] == b->cutter.data[k].tag;
      for (size_t i = 0; i < g->also.len && !mine; i++) mine = b->source.data[g->also.data[i]] == b->cutter.data[k].tag;
      if (!mine) continue;
      Run r = {.curve = g->curve, .edge = e, .from = g->from, .to = g->to, .u0 = g->u0, .u1 = g->u1, .whole = g->u0 == 0 && g->u1 == 1};
      vec_push(out, ((Shape){1, tag__abs(curve_of(a, &r))}));
    }
}

static void copy_arcs(Boolean *b)
{
  b->arc = arena_alloc(&b->arena, (b->source.len + 1) * sizeof *b->arc);
  for (size_t i = 0; i < b->source.len; i++) {
    const CurveShape *h = model_curve(b->m, b->source.data[i])->shape;
    b->arc[i] = h && h->kind == SHAPE_ARC ? (Arc){h->centre, h->a, h->b, h->t0, h->t1} : (Arc){.t0 = 0};
  }
}

bool boolean__apply(Boolean *b, int tag, ShapeVec *out)
{
  if (tag >= 0 && model_face(b->m, tag)) {
    bool goes = false;
    for (size_t i = 0; i < b->input.len; i++) goes = goes || (b->input.data[i].tag == tag && b->input.data[i].drop);
    if (!goes) return tag__claim(b->m, KIND_FACE, tag, b->loc, b->diag) >= 0;
  }
  Apply a = {.b = b, .point = mem_zalloc((b->a.node.len + 1) * sizeof *a.point)};
  Face frame = *b->input.data[0].face; // its plane outlives it
  known_points(&a);
  copy_arcs(b);
  note_reused(&a);
  bool *stays = mem_zalloc((b->input.len + 1) * sizeof *stays);
  size_t *same = mem_alloc((b->order.len + 1) * sizeof *same);
  for (size_t k = 0; k < b->order.len; k++) {
    same[k] = unchanged_input(b, b->order.data[k]);
    if (same[k] != SIZE_MAX) stays[same[k]] = tag < 0;
  }
  remove_inputs(&a, stays);
  b->input.data[0].face = &frame;
  IntVec made = {0};
  for (size_t k = 0; k < b->order.len; k++) {
    const Outline *o = &b->outline.data[b->order.data[k]];
    bool kept = same[k] != SIZE_MAX && stays[same[k]];
    int t = kept ? b->input.data[same[k]].tag : tag >= 0 && k == 0 ? tag : tag >= 0 ? 0 : preserved(b, o);
    if (!kept && t) new_face(&a, b->order.data[k], t);
    if (t) vec_push(out, ((Shape){2, t}));
    vec_push(&made, t);
  }
  for (size_t k = 0; k < b->order.len; k++) { // the others take what tags are free then
    if (!made.data[k]) {
      made.data[k] = new_face(&a, b->order.data[k], model__next_tag(b->m, KIND_FACE));
      vec_push(out, ((Shape){2, made.data[k]}));
    }
    embed_inner(&a, b->outline.data[b->order.data[k]].piece, made.data[k]);
  }
  output_cutters(&a, out);
  remove_idle_points(&a);
  if (a.anew && !b->m->boolean_noted) {
    diag_warning(b->diag, b->loc, "curves and points made by Boolean operations have numbers of their own order, not OpenCASCADE's: choose them by "
                                  "Boundary{..} or In BoundingBox{..}");
    b->m->boolean_noted = true;
  }
  vec_free(&made);
  free(same);
  free(stays);
  map_free(&a.made);
  map_free(&a.reused);
  free(a.point);
  return true;
}
