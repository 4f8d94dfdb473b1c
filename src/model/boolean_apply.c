// boolean_apply.c - the faces that a Boolean operation makes take the place of those it was given
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/boolean_int.h"

static uint64_t key_of(const Run *r, bool turned)
{
  uint64_t h = hash__mix(hash__mix(17, turned ? r->to : r->from), turned ? r->from : r->to);
  return hash__mix(h, r->edge);
}

// ---- making
// -----------------------------------------------------------------------------------------------------------------

static int point_of(BooleanApply *a, uint32_t node)
{
  Boolean *b = a->b;
  if (!a->point[node]) {
    int tag = model__next_tag(b->m, KIND_POINT);
    point__make(b->m, tag, face_from_plane(&b->frame, b->a.node.data[node]), a->lc[node], b->loc);
    a->point[node] = tag;
  }
  return a->point[node];
}

static int new_curve(BooleanApply *a, const Run *r)
{
  Boolean *b = a->b;
  Model *m = b->m;
  int pair[2] = {point_of(a, r->from), point_of(a, r->to)}, tag = MAX(model__next_tag(m, KIND_CURVE), a->most_own + 1);
  if (a->own[r->curve]) tag = a->own[r->curve];
  const ArrCurve *k = &b->curve[r->curve];
  if (k->kind == ARR_SPLINE) {
    const Pieces *p = b->spline[r->curve];
    CurveShape whole = {.degree = p->degree, .npiece = p->npiece, .knot = p->knot, .control = p->control};
    Curve *c = curve__make(m, tag, CURVE_SPLINE, pair, 2, pair[0], pair[1], b->loc);
    c->pieces = pieces__between(m, &whole, r->u0, r->u1);
    return tag;
  }
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

static int curve_of(BooleanApply *a, const Run *r)
{
  int source = a->b->source.data[r->curve];
  if (boolean__reuses(a, r) && !a->anew[r->curve]) return r->back ? -source : source;
  uint32_t known = map_get(&a->made, key_of(r, false));
  if (known != NONE) return (int)known;
  known = map_get(&a->made, key_of(r, true));
  if (known != NONE) return -(int)known;
  Run along = *r;
  if (r->back) along.from = r->to, along.to = r->from, along.u0 = r->u1, along.u1 = r->u0, along.back = false;
  int tag = new_curve(a, &along);
  map_set(&a->made, key_of(&along, false), (uint32_t)tag);
  return r->back ? -tag : tag;
}

// Numbers are given in the order of the wires: curves, and points as they come along them.
static void number_runs(BooleanApply *a, const Listing *l)
{
  for (size_t i = 0; i < l->run.len; i++) curve_of(a, &l->run.data[i]);
}

// The rank of the wire that an outline is; NONE: a part of one, or several.
static uint32_t wire_of(const Listing *l, const Outline *o)
{
  for (size_t w = 0; w + 1 < l->wire.len; w++) {
    size_t from = l->wire.data[w], n = l->wire.data[w + 1] - from;
    for (size_t i = 0; i < n && n == o->run.len; i++)
      if (l->run.data[from + i].edge == o->run.data[0].edge) return (uint32_t)w;
  }
  return NONE;
}

// The loop of an outline, from the edge on that comes first in its wire, which is noted for the next
// operation on this face.
static int new_loop(BooleanApply *a, const Listing *l, const Outline *o, uint32_t wire)
{
  Model *m = a->b->m;
  size_t n = o->run.len, from = wire == NONE ? 0 : l->wire.data[wire], at = 0;
  for (size_t i = 0; i < n && wire != NONE; i++)
    if (o->run.data[i].edge == l->run.data[from].edge) at = i;
  IntVec curve = {0};
  for (size_t i = 0; i < n; i++) vec_push(&curve, curve_of(a, &o->run.data[(at + i) % n]));
  int tag = loop__make_hidden(m, curve.data, (int)n, a->b->loc);
  if (wire != NONE) {
    int *order = arena_alloc(&m->arena, n * sizeof *order);
    for (size_t i = 0; i < n; i++) order[i] = tag__abs(curve_of(a, &l->run.data[from + i]));
    Loop *loop = model_loop(m, tag);
    loop->wire = order;
    loop->nwire = (int)n;
  }
  vec_free(&curve);
  return tag;
}

static int new_face(BooleanApply *a, const Listing *l, int tag)
{
  Boolean *b = a->b;
  IntVec loop = {0};
  uint32_t piece = b->outline.data[l->outline].piece;
  for (size_t w = 0; w < l->wire.len; w++) // the last turn: what is no wire
    for (size_t k = l->outline; k < b->outline.len && b->outline.data[k].piece == piece; k++) {
      uint32_t own = wire_of(l, &b->outline.data[k]);
      if (own == (w + 1 < l->wire.len ? (uint32_t)w : NONE))
        vec_push(&loop, new_loop(a, l, &b->outline.data[k], own));
    }
  face__make(b->m, tag, FACE_PLANE, loop.data, (int)loop.len, b->loc);
  vec_free(&loop);
  return tag;
}

static void embed_inner(BooleanApply *a, uint32_t piece, int face)
{
  Boolean *b = a->b;
  for (uint32_t e = 0; e < b->a.edge.len; e++) {
    if (!boolean__is_inner(b, e, piece)) continue;
    Run r = boolean__inner_run(b, e);
    int tag = tag__abs(curve_of(a, &r));
    model_embed(b->m, 1, &tag, 1, face, b->loc, b->diag);
  }
}

// ---- removing
// ---------------------------------------------------------------------------------------------------------------

static void note_reused(BooleanApply *a)
{
  Boolean *b = a->b;
  for (size_t k = 0; k < b->outline.len; k++)
    for (size_t i = 0; i < b->outline.data[k].run.len; i++) {
      const Run *r = &b->outline.data[k].run.data[i];
      if (boolean__reuses(a, r)) map_set(&a->reused, (uint64_t)b->source.data[r->curve], 1);
    }
  for (uint32_t e = 0; e < b->a.edge.len && b->op == BOOLEAN_FRAGMENTS;
       e++) { // cutting curves live on by themselves
    const ArrEdge *g = &b->a.edge.data[e];
    if (g->u0 == 0 && g->u1 == 1 && !a->fresh[g->from] && !a->fresh[g->to]) map_set(&a->reused, (uint64_t)b->source.data[g->curve], 1);
  }
}

static bool goes(const Boolean *b, size_t source)
{
  for (size_t k = 0; k < b->cutter.len; k++)
    if (b->cutter.data[k].tag == b->source.data[source]) return b->cutter.data[k].drop;
  for (size_t k = 0; k < b->bounds.data[source].len; k++)
    if (b->input.data[b->bounds.data[source].data[k]].drop) return true;
  return false;
}

// A whole curve of the result that nothing but the inputs had, and that does not keep its number.
static void renew_curve(BooleanApply *a, size_t source, ShapeVec *gone)
{
  int tag = a->b->source.data[source];
  const Curve *c = model_curve(a->b->m, tag);
  if (c->uses || a->keep_curve[source]) return;
  a->anew[source] = true;
  vec_push(gone, ((Shape){1, tag}));
  if (a->b->bounds.data[source].len || a->b->pieces[source].len != 1) return;
  if (boolean__run_of(a->b, a->b->pieces[source].data[0]).curve != source) return;
  a->own[source] = tag; // a cutting curve in one piece
  a->most_own = MAX(a->most_own, tag);
}

// The faces that go, their curves that nothing uses, and what of their points neither. Nodes of the result
// stay.
static void remove_inputs(BooleanApply *a)
{
  Boolean *b = a->b;
  Model *m = b->m;
  for (size_t v = 0; v < b->a.node.len; v++)
    if (a->point[v]) point__get(m, a->point[v])->uses++;
  bool *stays = mem_zalloc((b->input.len + 1) * sizeof *stays);
  for (size_t k = 0; k < b->listing.len; k++)
    if (a->kept[k]) stays[a->same[k]] = true;
  for (size_t i = 0; i < b->input.len; i++)
    if (b->input.data[i].drop && !stays[i] && !b->input.data[i].face->uses) {
      wire__forget(m, b->input.data[i].tag);
      face__drop_whole(m, b->input.data[i].tag);
    }
  free(stays);
  ShapeVec gone = {0};
  for (size_t i = 0; i < b->source.len; i++) {
    if (!goes(b, i)) continue;
    if (map_get(&a->reused, (uint64_t)b->source.data[i]) == NONE)
      vec_push(&gone, ((Shape){1, b->source.data[i]}));
    else
      renew_curve(a, i, &gone);
  }
  model_delete(m, gone.data, gone.len, true);
  vec_free(&gone);
  for (size_t v = 0; v < b->a.node.len; v++) {
    if (!a->point[v]) continue;
    Point *p = point__get(m, a->point[v]);
    p->uses--;
    a->lc[v] = p->lc;
  }
  model__recount(m, KIND_FACE);
  model__recount(m, KIND_CURVE);
}

// Points that nothing else has get new numbers, in the order of the curves.
static void forget_points(BooleanApply *a)
{
  Boolean *b = a->b;
  for (size_t v = 0; v < b->a.node.len; v++) {
    const Point *p = a->point[v] ? point__get(b->m, a->point[v]) : NULL;
    if (!p || p->uses) continue;
    Shape s = {0, a->point[v]};
    model_delete(b->m, &s, 1, false);
    a->point[v] = 0;
  }
  for (size_t i = 0; i < a->idle.len; i++) {
    Shape s = {0, a->idle.data[i]};
    model_delete(b->m, &s, 1, false);
  }
  vec_free(&a->idle);
  model__recount(b->m, KIND_POINT);
}

// Points of the nodes that came to nothing.
static void remove_idle_points(BooleanApply *a)
{
  for (size_t v = 0; v < a->b->a.node.len; v++) {
    Shape s = {0, a->point[v]};
    if (s.tag) model_delete(a->b->m, &s, 1, false);
  }
  model__recount(a->b->m, KIND_POINT);
}

// ---- all
// ----------------------------------------------------------------------------------------------------------------------

// The pieces of the cutting curves; all == false: only those that get new numbers.
static void output_cutters(BooleanApply *a, bool all, ShapeVec *out)
{
  Boolean *b = a->b;
  for (size_t k = 0; k < b->cutter.len; k++)
    for (uint32_t e = 0; e < b->a.edge.len; e++) {
      const ArrEdge *g = &b->a.edge.data[e];
      bool mine = b->source.data[g->curve] == b->cutter.data[k].tag;
      for (size_t i = 0; i < g->also.len && !mine; i++)
        mine = b->source.data[g->also.data[i]] == b->cutter.data[k].tag;
      Run r = boolean__inner_run(b, e);
      if (!mine || (!all && a->own[r.curve])) continue;
      vec_push(out, ((Shape){1, tag__abs(curve_of(a, &r))}));
    }
}

// The shapes outlive the curves.
static void copy_shapes(Boolean *b)
{
  b->spline = arena_alloc(&b->arena, (b->source.len + 1) * sizeof *b->spline);
  b->arc = arena_alloc(&b->arena, (b->source.len + 1) * sizeof *b->arc);
  for (size_t i = 0; i < b->source.len; i++) {
    const CurveShape *h = model_curve(b->m, b->source.data[i])->shape;
    b->arc[i] = h && h->kind == SHAPE_ARC ? (Arc){h->centre, h->a, h->b, h->t0, h->t1} : (Arc){.t0 = 0};
    b->spline[i] = b->curve[i].kind == ARR_SPLINE ? pieces__between(b->m, h, 0, 1) : NULL;
  }
}

// How to mesh a face stays with it when nothing happened to it but new numbers.
static void copy_attributes(Face *to, const Face *from)
{
  face__copy_meshing(to, from);
  to->reverse_mesh = from->reverse_mesh;
}

// Tags of the listed faces: their owners', what was asked for, or what is free then.
static void choose_tags(const BooleanApply *a, int asked, int *tag)
{
  const Boolean *b = a->b;
  int next = model__next_tag(b->m, KIND_FACE);
  if (asked >= next) next = asked + 1;
  for (size_t k = 0; k < b->listing.len; k++) {
    if (!tag[k] && a->owner[k] != NONE && !model_face(b->m, b->input.data[a->owner[k]].tag))
      tag[k] = b->input.data[a->owner[k]].tag;
    if (!tag[k] && k == 0 && asked >= 0) tag[k] = asked;
    if (tag[k] >= next) next = tag[k] + 1;
  }
  for (size_t k = 0; k < b->listing.len; k++)
    if (!tag[k]) tag[k] = next++;
}

static bool tag_is_free(const Boolean *b, int tag)
{
  if (tag < 0 || !model_face(b->m, tag)) return true;
  for (size_t i = 0; i < b->input.len; i++)
    if (b->input.data[i].tag == tag && b->input.data[i].drop) return true;
  return false;
}

// The listed faces that are inputs unchanged which stay; the others are made: first what has a new number,
// then what has an old one.
static void make_faces(BooleanApply *a, const Face *old, int asked, ShapeVec *out)
{
  const bool *kept = a->kept;
  const size_t *same = a->same;
  Boolean *b = a->b;
  int *tag = mem_zalloc((b->listing.len + 1) * sizeof *tag);
  for (size_t k = 0; k < b->listing.len; k++)
    if (kept[k]) tag[k] = b->input.data[same[k]].tag;
  choose_tags(a, asked, tag);
  ShapeVec cut = {0};
  for (int owned = 0; owned < 2; owned++) {
    for (size_t k = 0; k < b->listing.len; k++)
      if (!kept[k] && (a->owner[k] != NONE) == (owned == 1)) number_runs(a, &b->listing.data[k]);
    vec_clear(&cut);
    output_cutters(a, owned == 1, &cut);
  }
  for (int owned = 1; owned >= 0; owned--)
    for (size_t k = 0; k < b->listing.len; k++) {
      if ((kept[k] || a->owner[k] != NONE) != (owned == 1)) continue;
      if (!kept[k]) new_face(a, &b->listing.data[k], tag[k]);
      if (!kept[k] && same[k] != SIZE_MAX) copy_attributes(model_face(b->m, tag[k]), &old[same[k]]);
    }
  for (size_t i = 0; i <= b->input.len; i++) // as the inputs that they have their numbers from, the others last
    for (size_t k = 0; k < b->listing.len; k++)
      if (a->owner[k] == (i < b->input.len ? (uint32_t)i : NONE)) vec_push(out, ((Shape){2, tag[k]}));
  for (size_t k = 0; k < b->listing.len; k++) embed_inner(a, boolean__piece_at(b, k), tag[k]);
  for (size_t i = 0; i < cut.len; i++) vec_push(out, cut.data[i]);
  vec_free(&cut);
  free(tag);
}

static void apply_free(BooleanApply *a)
{
  map_free(&a->made);
  map_free(&a->reused);
  free(a->point);
  free(a->lc);
  free(a->fresh);
  free(a->keep_curve);
  free(a->same);
  free(a->kept);
  free(a->owner);
  free(a->anew);
  free(a->own);
}

bool boolean__apply(Boolean *b, int tag, ShapeVec *out)
{
  if (!tag_is_free(b, tag)) return tag__claim(b->m, KIND_FACE, tag, b->loc, b->diag) >= 0;
  size_t nnode = b->a.node.len + 1, nsource = b->source.len + 1;
  BooleanApply a = {.b = b,
                    .point = mem_zalloc(nnode * sizeof(int)),
                    .lc = mem_zalloc(nnode * sizeof(double)),
                    .fresh = mem_zalloc(nnode * sizeof(bool)),
                    .keep_curve = mem_zalloc(nsource * sizeof(bool)),
                    .same = mem_alloc((b->listing.len + 1) * sizeof(size_t)),
                    .kept = mem_zalloc((b->listing.len + 1) * sizeof(bool)),
                    .owner = mem_alloc((b->listing.len + 1) * sizeof(uint32_t)),
                    .anew = mem_zalloc(nsource * sizeof(bool)),
                    .own = mem_zalloc(nsource * sizeof(int))};
  Face *old = mem_zalloc((b->input.len + 1) * sizeof *old);
  for (size_t i = 0; i < b->input.len; i++) old[i] = *b->input.data[i].face;
  boolean__plan(&a, tag >= 0);
  copy_shapes(b);
  note_reused(&a);
  remove_inputs(&a);
  forget_points(&a);
  make_faces(&a, old, tag, out);
  for (size_t v = 0; v < b->a.node.len; v++) vec_push(&b->at_node, a.point[v]);
  remove_idle_points(&a);
  apply_free(&a);
  free(old);
  return true;
}
