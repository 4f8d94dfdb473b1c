// extrude_occ.c - sweeping as OpenCASCADE does it
// SPDX-License-Identifier: MIT
//
// What the shapes of a statement share is swept once, and nothing is merged with what was there before. Numbers are taken in the
// order measured: per curve the sides at its begin and end, then its copy; per face the faces that its curves sweep, then its copy.
// Controls of splines and centres of arcs are no points of the copies.
#include "base/base.h"

#include "model/curve_int.h"

#define TURN 6.28318530717958648

typedef struct {
  Model *m;
  const Sweep *sweep;
  Affine full;
  Layers layers;
  double tol;
  SrcLoc loc;
  Diag *diag;
  Map top[2];  // of points and curves: their images
  Map side[2]; // of points and curves: what they sweep, 0 if they stay
} Prism;

static bool is_full_turn(const Prism *j) { return j->sweep->rotate && fabs(fabs(j->sweep->angle) - TURN) <= 1e-12 * TURN; }

static int image_of(const Prism *j, int dim, int tag)
{
  uint32_t to = map_get(&j->top[dim], (uint64_t)tag);
  return to == NONE ? tag : (int)to;
}

// ---- points ---------------------------------------------------------------------------------------------------------------

static Vec3 unit_axis(const Sweep *s) { return vec3_scale(1 / vec3_length(s->axis), s->axis); }

static bool stays(const Prism *j, Vec3 p)
{
  if (!j->sweep->rotate) return vec3_length(j->sweep->shift) <= j->tol;
  return vec3_length(vec3_cross(unit_axis(j->sweep), vec3_sub(p, j->sweep->centre))) <= j->tol;
}

static Arc arc_of(const Sweep *s, Vec3 p)
{
  Vec3 k = unit_axis(s), centre = vec3_add(s->centre, vec3_scale(vec3_dot(vec3_sub(p, s->centre), k), k));
  Vec3 a = vec3_sub(p, centre), b = vec3_cross(s->angle < 0 ? vec3_scale(-1, k) : k, a);
  return (Arc){centre, a, b, 0, fabs(s->angle)};
}

// The curve from the point to its image, 0 if it stays.
static int sweep_point(Prism *j, int from)
{
  Model *m = j->m;
  uint32_t known = map_get(&j->side[0], (uint64_t)from);
  if (known != NONE) return (int)known;
  Vec3 p = point__get(m, from)->xyz;
  if (stays(j, p)) {
    map_set(&j->side[0], (uint64_t)from, 0);
    return 0;
  }
  int to = from;
  if (!is_full_turn(j)) {
    to = model__copy_point(m, from, j->loc);
    model__point_moves(m, point__get(m, to), affine_apply(&j->full, p));
  }
  int pair[2] = {from, to};
  Curve *c = curve__make(m, model__next_tag(m, KIND_CURVE), j->sweep->rotate ? CURVE_CIRCLE : CURVE_LINE, pair, 2, from, to, j->loc);
  Arc arc = j->sweep->rotate ? arc_of(j->sweep, p) : (Arc){0};
  if (j->sweep->rotate) c->arc = arena_dup(&m->arena, &arc, sizeof arc);
  c->extruded_point = from;
  c->layers = j->layers;
  map_set(&j->top[0], (uint64_t)from, (uint32_t)to);
  map_set(&j->side[0], (uint64_t)from, (uint32_t)c->tag);
  return c->tag;
}

// ---- curves ---------------------------------------------------------------------------------------------------------------

static int copy_curve(Prism *j, int tag)
{
  Model *m = j->m;
  Curve *c = model_curve(m, tag);
  int end[2] = {image_of(j, 0, c->begin), image_of(j, 0, c->end)};
  Arc *arc;
  Pieces *pieces;
  bool bent = curve__build(m, c, j->diag) && curve__image(m, c, &j->full, &arc, &pieces);
  Curve *to = curve__make(m, model__next_tag(m, KIND_CURVE), bent ? c->type : CURVE_LINE, end, 2, end[0], end[1], j->loc);
  if (bent) {
    to->arc = arc;
    to->pieces = pieces;
  }
  if (j->layers.n) {
    to->copy_of = tag;
    vec_push(&m->layered, to->tag);
  }
  return to->tag;
}

// The face that a curve sweeps, 0 if it stays.
static int sweep_curve(Prism *j, int tag)
{
  Model *m = j->m;
  uint32_t known = map_get(&j->side[1], (uint64_t)tag);
  if (known != NONE) return (int)known;
  int begin = sweep_point(j, model_curve(m, tag)->begin), end = sweep_point(j, model_curve(m, tag)->end), face = 0;
  if (begin || end) {
    int top = is_full_turn(j) ? tag : copy_curve(j, tag), side[4] = {tag}, n = 1;
    map_set(&j->top[1], (uint64_t)tag, (uint32_t)top);
    if (end) side[n++] = end;
    side[n++] = -top;
    if (begin) side[n++] = -begin;
    face = model__next_tag(m, KIND_FACE);
    int loop = loop__make_hidden(m, side, n, j->loc);
    Face *f = face__make(m, face, FACE_FILLING, &loop, 1, j->loc);
    f->extruded_curve = tag;
    f->extruded_side[0] = begin;
    f->extruded_side[1] = end;
    f->extruded_top = top;
    f->layers = j->layers;
    wire__note(m, face);
  }
  map_set(&j->side[1], (uint64_t)tag, (uint32_t)face);
  return face;
}

// ---- faces ----------------------------------------------------------------------------------------------------------------

static void append_images(const Prism *j, const IntVec *curve, IntVec *out)
{
  for (size_t i = 0; i < curve->len; i++) {
    int to = image_of(j, 1, tag__abs(curve->data[i]));
    vec_push(out, curve->data[i] < 0 ? -to : to);
  }
}

static int copy_face(Prism *j, int tag, const IntVec *curve, const IntVec *start, const IntVec *wire)
{
  Model *m = j->m;
  IntVec above = {0}, order = {0};
  append_images(j, curve, &above);
  append_images(j, wire, &order);
  const int *loop = loop__make_parts(m, &above, start, &order, j->loc);
  int top = model__next_tag(m, KIND_FACE);
  Face *f = face__make(m, top, model_face(m, tag)->type, loop, (int)start->len - 1, j->loc);
  if (j->layers.n) {
    f->copy_of = tag;
    f->copy_map = arena_dup(&m->arena, j->full.m, sizeof j->full.m);
    m->ncopied++;
  }
  wire__note(m, top);
  vec_free(&above);
  vec_free(&order);
  return top;
}

static void put(ShapeVec *out, int dim, int tag) { vec_push(out, ((Shape){dim, tag})); }

static void extrude_face(Prism *j, int tag, ShapeVec *out)
{
  Model *m = j->m;
  IntVec curve = {0}, start = {0}, wire = {0}, lateral = {0}, shell = {0};
  face_boundary(m, model_face(m, tag), &curve, &start);
  face__wires(m, model_face(m, tag), &curve, &start, &wire);
  for (size_t i = 0; i < wire.len; i++) {
    int side = sweep_curve(j, tag__abs(wire.data[i]));
    if (side) vec_push(&lateral, side);
  }
  int top = is_full_turn(j) ? tag : copy_face(j, tag, &curve, &start, &wire);
  vec_push(&shell, -tag);
  vec_push(&shell, top);
  for (size_t i = 0; i < lateral.len; i++) vec_push(&shell, lateral.data[i]);
  int volume = m->max[KIND_VOLUME] + 1;
  volume__make(m, volume, shell.data, (int)shell.len, j->loc);
  put(out, 2, top);
  put(out, 3, volume);
  for (size_t i = 0; m->set.return_lateral && i < lateral.len; i++) put(out, 2, lateral.data[i]);
  vec_free(&curve);
  vec_free(&start);
  vec_free(&wire);
  vec_free(&lateral);
  vec_free(&shell);
}

// ---- the statement --------------------------------------------------------------------------------------------------------

static void extrude_point(Prism *j, int tag, ShapeVec *out)
{
  int side = sweep_point(j, tag);
  put(out, 0, image_of(j, 0, tag));
  if (side) put(out, 1, side);
}

static void extrude_curve(Prism *j, int tag, ShapeVec *out)
{
  int face = sweep_curve(j, tag);
  put(out, 1, image_of(j, 1, tag));
  if (!face) return;
  put(out, 2, face);
  const Face *f = model_face(j->m, face);
  for (int i = 0; i < 2; i++)
    if (j->m->set.return_lateral && f->extruded_side[i]) put(out, 1, f->extruded_side[i]);
}

// Points that are listed share nothing with curves that are, nor curves with faces.
static void forget(Prism *j)
{
  for (int d = 0; d < 2; d++) {
    map_free(&j->top[d]);
    map_free(&j->side[d]);
    j->top[d] = j->side[d] = (Map){0};
  }
}

void extrude__opencascade(Model *m, const Shape *shape, size_t n, const Sweep *sweep, const Affine *full, const Layers *layers,
                          ShapeVec *out, SrcLoc loc, Diag *diag)
{
  Prism j = {.m = m, .sweep = sweep, .full = *full, .layers = *layers, .loc = loc, .diag = diag};
  j.tol = m->set.tolerance * vec3_distance(m->extent.lo, m->extent.hi);
  for (size_t i = 0; i < n; i++) {
    int tag = tag__abs(shape[i].tag);
    if (i && shape[i].dim != shape[i - 1].dim) forget(&j);
    if (shape[i].dim == 0) extrude_point(&j, tag, out);
    if (shape[i].dim == 1) extrude_curve(&j, tag, out);
    if (shape[i].dim == 2) extrude_face(&j, tag, out);
  }
  forget(&j);
}
