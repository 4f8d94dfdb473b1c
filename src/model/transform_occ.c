// transform_occ.c - moving curves and faces as OpenCASCADE does it
// SPDX-License-Identifier: MIT
//
// What is moved parts from what stays: a boundary that others have too is copied. The shapes of the statement keep their numbers
// and what they share; what bounds them is numbered anew, shape for shape, from the largest number on that is left when the old
// boundary is gone. Controls of splines and centres of arcs are no points of what comes out.
#include "base/base.h"

#include "model/curve_int.h"

// A curve that is moved: what it was, its image, and its new number.
typedef struct {
  Curve was;
  bool line, listed, gone; // gone: the old one
  Arc *arc;
  Pieces *pieces;
  int tag;
} MovedCurve;

typedef struct {
  int tag;
  Vec3 xyz;
  double lc;
} NewPoint;

typedef struct {
  int face;
  IntVec curve, start; // its boundary as it was
  IntVec wire;         // the same curves in the order in which OpenCASCADE lists them
} MovedFace;

typedef struct {
  Model *m;
  const Affine *map;
  Diag *diag;
  Vec(MovedCurve) curve;
  Vec(NewPoint) point;
  Vec(MovedFace) face;
  Map curve_at, point_at; // old number -> index
} Mover;

static Vec3 turned(const Affine *a, Vec3 v) { return vec3_sub(affine_apply(a, v), affine_apply(a, (Vec3){0, 0, 0})); }

bool curve__image(Model *m, const Curve *c, const Affine *a, Arc **arc, Pieces **pieces)
{
  const CurveShape *h = c->shape;
  *arc = NULL;
  *pieces = NULL;
  if (!h) return false;
  if (h->kind == SHAPE_ARC) {
    Arc image = {affine_apply(a, h->centre), turned(a, h->a), turned(a, h->b), h->t0, h->t1};
    *arc = arena_dup(&m->arena, &image, sizeof image);
    return true;
  }
  size_t n = (size_t)h->npiece * (size_t)(h->degree + 1);
  Pieces p = {.degree = h->degree, .npiece = h->npiece, .smooth = c->pieces && c->pieces->smooth,
              .knot = arena_dup(&m->arena, h->knot, ((size_t)h->npiece + 1) * sizeof *h->knot),
              .control = arena_dup(&m->arena, h->control, n * sizeof *h->control)};
  for (size_t i = 0; i < n; i++) p.control[i] = affine_apply(a, p.control[i]);
  *pieces = arena_dup(&m->arena, &p, sizeof p);
  return true;
}

// ---- what there is to move ----------------------------------------------------------------------------------------------------

static void gather_point(Mover *v, int tag)
{
  bool fresh;
  map_slot(&v->point_at, (uint64_t)tag, (uint32_t)v->point.len, &fresh);
  const Point *p = point__get(v->m, tag);
  if (fresh) vec_push(&v->point, ((NewPoint){0, affine_apply(v->map, p->xyz), p->lc}));
}

static bool gather_curve(Mover *v, int tag, bool listed)
{
  bool fresh;
  uint32_t *at = map_slot(&v->curve_at, (uint64_t)tag, (uint32_t)v->curve.len, &fresh);
  if (!fresh) {
    v->curve.data[*at].listed |= listed;
    return true;
  }
  Curve *c = model_curve(v->m, tag);
  if (!curve__build(v->m, c, v->diag)) return false;
  MovedCurve k = {.was = *c, .listed = listed};
  k.line = !curve__image(v->m, c, v->map, &k.arc, &k.pieces);
  vec_push(&v->curve, k);
  gather_point(v, c->begin);
  gather_point(v, c->end);
  return true;
}

void face__wires(const Model *m, const Face *f, const IntVec *curve, const IntVec *start, IntVec *out)
{
  for (size_t l = 0; l + 1 < start->len; l++) {
    const Loop *loop = start->len == (size_t)f->nloop + 1 ? model_loop(m, f->loop[l]) : NULL;
    int from = start->data[l], n = start->data[l + 1] - from;
    bool known = loop && loop->wire && loop->nwire == n;
    for (int i = 0; i < n; i++) {
      int tag = curve->data[from + i];
      for (int k = 0; known && k < n; k++)
        if (tag__abs(curve->data[from + k]) == loop->wire[i]) tag = curve->data[from + k];
      vec_push(out, tag);
    }
  }
}

// The loops of a face whose boundary has these parts; `wire` as of face__wires.
int *loop__make_parts(Model *m, const IntVec *curve, const IntVec *start, const IntVec *wire, SrcLoc loc)
{
  int *loop = arena_alloc(&m->arena, start->len * sizeof *loop);
  for (size_t l = 0; l + 1 < start->len; l++) {
    size_t from = (size_t)start->data[l], n = (size_t)start->data[l + 1] - from;
    int *order = arena_alloc(&m->arena, (n + 1) * sizeof *order);
    for (size_t i = 0; i < n; i++) order[i] = tag__abs(wire->data[from + i]);
    loop[l] = loop__make_hidden(m, curve->data + from, (int)n, loc);
    model_loop(m, loop[l])->wire = order;
    model_loop(m, loop[l])->nwire = (int)n;
  }
  return loop;
}

static bool gather(Mover *v, const Shape *shape, size_t n)
{
  bool good = true;
  for (size_t i = 0; i < n && good; i++) {
    int tag = tag__abs(shape[i].tag);
    if (shape[i].dim == 1) good = gather_curve(v, tag, true);
    if (shape[i].dim != 2) continue;
    MovedFace f = {.face = tag};
    face_boundary(v->m, model_face(v->m, tag), &f.curve, &f.start);
    face__wires(v->m, model_face(v->m, tag), &f.curve, &f.start, &f.wire);
    vec_push(&v->face, f);
    for (size_t k = 0; k < f.curve.len && good; k++) good = gather_curve(v, tag__abs(f.curve.data[k]), false);
  }
  return good;
}

// ---- out with the old ---------------------------------------------------------------------------------------------------------

// Faces outside keep a copy in the place of a listed curve of theirs.
static void leave_copy(Model *m, const MovedCurve *k)
{
  const Curve *c = &k->was;
  Curve *stays = curve__make(m, m->max[KIND_CURVE] + 1, c->type, c->point, c->npoint, c->begin, c->end, c->loc);
  int tag = stays->tag;
  *stays = *c;
  stays->tag = tag;
  stays->uses = stays->in_loops = 0;
  stays->shape = NULL;
  IntVec part = {0};
  vec_push(&part, tag);
  model__replace_curve(m, c->tag, &part);
  vec_free(&part);
}

static void release_curve(Mover *v, int tag)
{
  MovedCurve *k = &v->curve.data[map_get(&v->curve_at, (uint64_t)tag)];
  const Curve *c = model_curve(v->m, tag);
  if (!c || k->gone || k->tag == tag) return; // with a shape before, or moved itself
  if (c->uses && k->listed) leave_copy(v->m, k);
  if (model_curve(v->m, tag)->uses) return;
  k->gone = true;
  curve__drop(v->m, tag);
  const Shape end[2] = {{0, k->was.begin}, {0, k->was.end}};
  model_delete(v->m, end, 2, false); // but for those in use
}

static void release_face(Mover *v, const MovedFace *f)
{
  for (size_t i = 0; i < f->curve.len; i++) release_curve(v, tag__abs(f->curve.data[i]));
}

// ---- in with the new ----------------------------------------------------------------------------------------------------------

static int new_point(Mover *v, int old, SrcLoc loc)
{
  NewPoint *p = &v->point.data[map_get(&v->point_at, (uint64_t)old)];
  if (p->tag) return p->tag;
  p->tag = v->m->max[KIND_POINT] + 1;
  point__make(v->m, p->tag, p->xyz, p->lc, loc);
  return p->tag;
}

static int new_curve(Mover *v, int old)
{
  Model *m = v->m;
  MovedCurve *k = &v->curve.data[map_get(&v->curve_at, (uint64_t)old)];
  if (k->tag) return k->tag;
  int end[2] = {new_point(v, k->was.begin, k->was.loc), new_point(v, k->was.end, k->was.loc)};
  k->tag = k->listed ? old : m->max[KIND_CURVE] + 1;
  Curve *c = curve__make(m, k->tag, k->line ? CURVE_LINE : k->was.type, end, 2, end[0], end[1], k->was.loc);
  c->arc = k->arc;
  c->pieces = k->pieces;
  c->transfinite = k->was.transfinite;
  c->law = k->was.law;
  c->coef = k->was.coef;
  c->copy_of = k->was.copy_of;
  c->layers = k->was.layers;
  c->reverse_mesh = k->was.reverse_mesh;
  c->degenerate = k->was.degenerate;
  uint32_t from = k->was.extruded_point ? map_get(&v->point_at, (uint64_t)k->was.extruded_point) : NONE;
  if (from != NONE) c->extruded_point = v->point.data[from].tag;
  if (c->copy_of) vec_push(&m->layered, c->tag);
  return c->tag;
}

static void bound_face(Mover *v, const MovedFace *f)
{
  Face *face = model_face(v->m, f->face);
  if (face->extruded_curve && f->curve.len == 4) { // the sides come before what was swept and its copy
    new_curve(v, tag__abs(f->curve.data[3]));
    new_curve(v, tag__abs(f->curve.data[1]));
  }
  IntVec curve = {0}, wire = {0};
  for (size_t i = 0; i < f->wire.len; i++) vec_push(&wire, new_curve(v, tag__abs(f->wire.data[i])));
  for (size_t i = 0; i < f->curve.len; i++) {
    int tag = new_curve(v, tag__abs(f->curve.data[i]));
    vec_push(&curve, f->curve.data[i] < 0 ? -tag : tag);
  }
  face->loop = loop__make_parts(v->m, &curve, &f->start, &wire, face->loc);
  face->nloop = (int)f->start.len - 1;
  if (face->wire) {
    wire__forget(v->m, f->face);
    wire__note(v->m, f->face);
  }
  face__count_uses(v->m, face, 1);
  vec_push(&v->m->dirty[2], f->face);
  vec_free(&curve);
  vec_free(&wire);
}

// Copies of meshes go from curve to curve; those that went along have other numbers now.
static void follow_copies(Mover *v)
{
  for (size_t i = 0; i < v->curve.len; i++) {
    Curve *c = model_curve(v->m, v->curve.data[i].tag);
    uint32_t from = c->copy_of ? map_get(&v->curve_at, (uint64_t)tag__abs(c->copy_of)) : NONE;
    if (from != NONE) c->copy_of = c->copy_of < 0 ? -v->curve.data[from].tag : v->curve.data[from].tag;
  }
}

static void move_all(Mover *v, const Shape *shape, size_t n)
{
  size_t face = 0;
  for (size_t i = 0; i < v->face.len; i++) { // all at once: what the shapes of the statement share goes with the first
    Face *f = model_face(v->m, v->face.data[i].face);
    model__forget_face(v->m, f);
    face__drop_loops(v->m, f);
  }
  for (size_t i = 0; i < n; i++) {
    const MovedFace *f = shape[i].dim == 2 ? &v->face.data[face++] : NULL;
    if (f) release_face(v, f);
    else release_curve(v, tag__abs(shape[i].tag));
    model__recount(v->m, KIND_CURVE);
    model__recount(v->m, KIND_POINT);
    if (f) bound_face(v, f);
    else new_curve(v, tag__abs(shape[i].tag));
  }
  follow_copies(v);
}

bool transform__opencascade(Model *m, const Shape *shape, size_t n, const Affine *a, Diag *diag)
{
  Mover v = {.m = m, .map = a, .diag = diag};
  bool good = gather(&v, shape, n);
  if (good) move_all(&v, shape, n);
  for (size_t i = 0; i < v.face.len; i++) {
    vec_free(&v.face.data[i].curve);
    vec_free(&v.face.data[i].start);
    vec_free(&v.face.data[i].wire);
  }
  vec_free(&v.face);
  vec_free(&v.curve);
  vec_free(&v.point);
  map_free(&v.curve_at);
  map_free(&v.point_at);
  return good;
}
