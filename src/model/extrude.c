// extrude.c - sweeping points, curves and faces
// SPDX-License-Identifier: MIT
//
// Tags are taken in Gmsh's order, on which scripts rely. A curve: its copy (curve tag, points of all controls and two ends), the
// side at its begin (point, curve tag, centre of a rotation), the side at its end likewise, the face. A face: its copy, then
// each of its curves as above; then the copy gets a fresh tag.
#include "base/base.h"

#include "model/model_int.h"

typedef struct {
  Model *m;
  const Sweep *sweep;
  Affine full;       // the whole sweep
  Layers layers;     // in the model's arena
  double tol;
  SrcLoc loc;
  double thickness;  // not 0: along the normals of the curves, so far; < 0: against them
  Map normal_at;     // point -> index of its mean normal
  Vec(Vec3) normal;
} Job;

static Affine part_of(const Sweep *s, double f)
{
  Affine a = s->rotate ? affine_rotation(s->axis, s->centre, f * s->angle) : affine_translation(vec3_scale(f, s->shift));
  if (s->rotate && s->translate) { // first the shift, then the turn
    Vec3 d = affine_apply(&a, vec3_scale(f, s->shift)), o = affine_apply(&a, (Vec3){0, 0, 0});
    a.m[3] += d.x - o.x;
    a.m[7] += d.y - o.y;
    a.m[11] += d.z - o.z;
  }
  return a;
}

// ---- along normals (Extrude {Curve{..}; Layers{..}}) --------------------------------------------------------------------
// At corners of up to 100 degrees the far end is as far from both curves as the layers are thick; at sharper ones it is so far from the point.
#define MITRE 1.2855752193730785 // 2 cos 50 degrees

// Unit normal of a curve at u, to the right of its sense in the plane of x and y.
static Vec3 normal_of(const Model *m, const Curve *c, double u, bool back)
{
  Vec3 t = curve_deriv(m, c, u);
  double l = hypot(t.x, t.y), sign = back ? -1 : 1;
  return l > 0 ? (Vec3){sign * t.y / l, -sign * t.x / l, 0} : (Vec3){0, 0, 0};
}

static void add_normal(Job *j, int point, Vec3 n)
{
  bool fresh;
  uint32_t *slot = map_slot(&j->normal_at, (uint64_t)point, (uint32_t)j->normal.len, &fresh);
  if (fresh) vec_push(&j->normal, ((Vec3){0, 0, 0}));
  j->normal.data[*slot] = vec3_add(j->normal.data[*slot], n);
}

static Vec3 moved_along_normal(const Job *j, int point)
{
  uint32_t k = map_get(&j->normal_at, (uint64_t)point);
  Vec3 n = k == NONE ? (Vec3){0, 0, 0} : j->normal.data[k], p = point__get(j->m, point)->xyz;
  double l = vec3_length(n); // twice the cosine of half the turn where two curves meet
  if (!(l > 0)) return p;
  return vec3_add(p, vec3_scale(j->thickness / l * (l > MITRE && l < 2 ? 2 / l : 1), n));
}

// Mean normals at the ends of all curves of the statement; false (reported) for anything else than curves in planes of constant z.
static bool collect_normals(Job *j, const Shape *shape, size_t n, SrcLoc loc, Diag *diag)
{
  for (size_t i = 0; i < n; i++) {
    Curve *c = shape[i].dim == 1 ? model_curve(j->m, shape[i].tag) : NULL;
    if (!c) {
      diag_error(diag, loc, "Extrude without a vector (along the normals) takes curves alone here");
      return false;
    }
    if (!curve__build(j->m, c, diag)) return false;
    Box3 b = curve_bounds(j->m, c);
    if (b.hi.z - b.lo.z > 1e-9 * vec3_distance(b.lo, b.hi)) {
      diag_error(diag, loc, "Extrude along the normals: curve %d is not in a plane of constant z", c->tag);
      return false;
    }
    add_normal(j, c->begin, normal_of(j->m, c, 0, shape[i].tag < 0));
    add_normal(j, c->end, normal_of(j->m, c, 1, shape[i].tag < 0));
  }
  return true;
}

// The curve at the far end of layers along the normals: straight if the curve is, else a spline through places in equal steps of the
// parameter. Numbers of points are left out as Gmsh does, which copies the control points and drops them.
static int offset_curve(Job *j, int signed_tag)
{
  enum { PLACES = 23 }; // a prime, so that they seldom are where nodes come to be
  Model *m = j->m;
  const Curve *c = model_curve(m, signed_tag);
  bool back = signed_tag < 0, straight = c->type == CURVE_LINE;
  int tag = model__next_tag(m, KIND_CURVE), from = back ? c->end : c->begin, to = back ? c->begin : c->end;
  Vec3 x[PLACES + 1];
  for (int i = 1; i < PLACES && !straight; i++) {
    double u = back ? 1 - (double)i / PLACES : (double)i / PLACES;
    x[i] = vec3_add(curve_point(m, c, u), vec3_scale(j->thickness, normal_of(m, c, u, back)));
  }
  x[0] = moved_along_normal(j, from);
  x[PLACES] = moved_along_normal(j, to);
  m->max[KIND_POINT] += c->npoint;
  int end[2] = {model__copy_point(m, from, j->loc), model__copy_point(m, to, j->loc)};
  for (int i = 0; i < 2; i++) model__point_moves(m, point__get(m, end[i]), x[i * PLACES]);
  Curve *top = curve__make(m, tag, straight ? CURVE_LINE : CURVE_SPLINE, end, 2, end[0], end[1], j->loc);
  if (!straight) top->pieces = pieces__through(m, x, PLACES + 1);
  return tag;
}

static bool stays(const Job *j, int point)
{
  Vec3 p = point__get(j->m, point)->xyz, q = j->thickness != 0 ? moved_along_normal(j, point) : affine_apply(&j->full, p);
  return fabs(p.x - q.x) <= j->tol && fabs(p.y - q.y) <= j->tol && fabs(p.z - q.z) <= j->tol;
}

static void move_point(const Job *j, int point, const Affine *a) { model__move_points(j->m, &point, 1, a); }

static Vec3 onto_axis(const Sweep *s, Vec3 p)
{
  Vec3 k = vec3_scale(1 / vec3_length(s->axis), s->axis);
  return vec3_add(s->centre, vec3_scale(vec3_dot(vec3_sub(p, s->centre), k), k));
}

static Curve *swept_arc(Job *j, int from, int to)
{
  Model *m = j->m;
  int tag = model__next_tag(m, KIND_CURVE);
  int centre = model__copy_point(m, from, j->loc);
  model__point_moves(m, point__get(m, centre), onto_axis(j->sweep, point__get(m, from)->xyz));
  int point[3] = {from, centre, to};
  Curve *c = curve__make(m, tag, CURVE_CIRCLE, point, 3, from, to, j->loc);
  if (fabs(j->sweep->angle) > 3.14) { // the points alone would not say which half circle
    c->has_plane = true;
    c->plane = vec3_scale(j->sweep->angle < 0 ? -1 : 1, j->sweep->axis);
  }
  return c;
}

static Curve *swept_screw(Job *j, int from, int first)
{
  Model *m = j->m;
  int steps = MAX(m->set.spline_points, 1);
  int tag = model__next_tag(m, KIND_CURVE);
  IntVec point = {0};
  vec_push(&point, from);
  Vec3 p = point__get(m, from)->xyz;
  for (int i = 1; i <= steps; i++) {
    int q = i == 1 ? first : model__copy_point(m, from, j->loc);
    Affine a = part_of(j->sweep, (double)i / steps);
    model__point_moves(m, point__get(m, q), affine_apply(i == steps ? &j->full : &a, p));
    vec_push(&point, q);
  }
  Curve *c = curve__make(m, tag, CURVE_SPLINE, point.data, (int)point.len, from, vec_last(&point), j->loc);
  vec_free(&point);
  return c;
}

// The curve swept by a point, from the point to its image; 0 when the point stays.
static int sweep_point(Job *j, int from)
{
  Model *m = j->m;
  int to = model__copy_point(m, from, j->loc);
  if (stays(j, from)) return 0;
  Curve *c;
  if (j->sweep->rotate && j->sweep->translate) {
    c = swept_screw(j, from, to);
  } else {
    if (j->thickness != 0) model__point_moves(m, point__get(m, to), moved_along_normal(j, from));
    else move_point(j, to, &j->full);
    int pair[2] = {from, to};
    c = j->sweep->rotate ? swept_arc(j, from, to)
                         : curve__make(m, model__next_tag(m, KIND_CURVE), CURVE_LINE, pair, 2, from, to, j->loc);
  }
  c->extruded_point = from;
  c->layers = j->layers;
  return c->tag;
}

// The face swept by a curve (0 if it stays), its copy in *top.
static int sweep_curve(Job *j, int curve, int *top)
{
  Model *m = j->m;
  if (j->thickness != 0) {
    *top = offset_curve(j, curve);
  } else {
    *top = model__copy_curve(m, curve, j->loc);
    model__transform_shape(m, 1, *top, &j->full);
  }
  int begin = sweep_point(j, curve__from(m, curve));
  int end = sweep_point(j, curve__to(m, curve));
  if (!begin && !end) return 0;
  if (j->layers.n) {
    model_curve(m, *top)->copy_of = curve;
    vec_push(&m->layered, *top);
  }
  int side[4], n = 0;
  side[n++] = curve;
  if (end) side[n++] = end;
  side[n++] = -*top;
  if (begin) side[n++] = -begin;
  int tag = model__next_tag(m, KIND_FACE);
  int loop = loop__make_hidden(m, side, n, j->loc);
  Face *f = face__make(m, tag, FACE_FILLING, &loop, 1, j->loc);
  f->extruded_curve = curve;
  f->extruded_side[0] = begin;
  f->extruded_side[1] = end;
  f->extruded_top = *top;
  f->layers = j->layers;
  return tag;
}

static void renumber_face(Model *m, int tag, int to)
{
  Face *old = table__get(&m->face, tag), copy = *old;
  table__remove(&m->face, tag);
  Face *f = table__add(&m->face, to);
  *f = copy;
  f->tag = to;
  model__note_tag(m, KIND_FACE, to);
  vec_push(&m->dirty[2], to);
}

static int sweep_face(Job *j, int face, int *top, IntVec *lateral)
{
  Model *m = j->m;
  *top = model__copy_face(m, face, j->loc);
  model__transform_shape(m, 2, *top, &j->full);
  IntVec curve = {0}, start = {0}, top_curve = {0};
  face_boundary(m, model_face(m, face), &curve, &start);
  const Loop *l = model_loop(m, model_face(m, *top)->loop[0]);
  for (int i = 0; i < l->ncurve; i++) vec_push(&top_curve, l->curve[i]);
  for (size_t i = 0; i < curve.len; i++) {
    int copy, side = sweep_curve(j, curve.data[i], &copy);
    if (side) vec_push(lateral, side);
    if (!j->layers.n || !side) continue;
    model_curve(m, top_curve.data[i])->copy_of = curve.data[i]; // the copy that survives
    vec_push(&m->layered, top_curve.data[i]);
  }
  int tag = model__next_tag(m, KIND_FACE);
  renumber_face(m, *top, tag);
  *top = tag;
  if (j->layers.n) {
    Face *f = model_face(m, tag);
    f->copy_of = face;
    f->copy_map = arena_dup(&m->arena, j->full.m, sizeof j->full.m);
    m->ncopied++;
  }
  IntVec shell = {0};
  vec_push(&shell, -face);
  vec_push(&shell, *top);
  for (size_t i = 0; i < lateral->len; i++) vec_push(&shell, lateral->data[i]);
  int volume = m->max[KIND_VOLUME] + 1; // counts alone, whatever OldNewReg
  volume__make(m, volume, shell.data, (int)shell.len, j->loc);
  vec_free(&shell);
  vec_free(&curve);
  vec_free(&start);
  vec_free(&top_curve);
  return volume;
}

// ---- the statement ------------------------------------------------------------------------------------------------------

static void put(ShapeVec *out, const Merged *g, int dim, int tag)
{
  Shape s = {dim, dim < 3 ? merged__tag(g, dim, tag) : tag};
  vec_push(out, s);
}

static void settle(Job *j, Merged *g)
{
  if (j->m->set.auto_coherence || j->m->set.opencascade) model__merge(j->m, g);
}

static void extrude_point(Job *j, int tag, ShapeVec *out)
{
  int side = sweep_point(j, tag), to = side ? model_curve(j->m, side)->end : tag;
  Merged g = {0};
  settle(j, &g);
  put(out, &g, 0, to);
  if (side) put(out, &g, 1, side);
  merged__free(&g);
}

// What bounds the swept face beside its source and its top, as it now is.
static void put_sides(const Job *j, int face, int source, int top, ShapeVec *out)
{
  if (!j->m->set.return_lateral) return;
  const Loop *l = model_loop(j->m, model_face(j->m, face)->loop[0]);
  for (int i = 0; i < l->ncurve; i++) {
    int c = l->curve[i];
    if (tag__abs(c) == tag__abs(source) || tag__abs(c) == tag__abs(top)) continue;
    Shape s = {1, c};
    vec_push(out, s);
  }
}

static void extrude_curve(Job *j, int tag, ShapeVec *out)
{
  int top, face = sweep_curve(j, tag, &top);
  Merged g = {0};
  settle(j, &g);
  tag = merged__tag(&g, 1, tag);
  if (!face) {
    put(out, &g, 1, tag);
  } else {
    put(out, &g, 1, top);
    put(out, &g, 2, face);
    int now = merged__tag(&g, 2, face);
    put_sides(j, now, tag, merged__tag(&g, 1, top), out);
  }
  merged__free(&g);
}

static void extrude_face(Job *j, int tag, ShapeVec *out)
{
  int top;
  IntVec lateral = {0};
  int volume = sweep_face(j, tag, &top, &lateral);
  Merged g = {0};
  settle(j, &g);
  put(out, &g, 2, top);
  put(out, &g, 3, volume);
  for (size_t i = 0; j->m->set.return_lateral && i < lateral.len; i++) put(out, &g, 2, lateral.data[i]);
  vec_free(&lateral);
  merged__free(&g);
}

static bool sweep_is_good(const Sweep *s, bool whole_turns, SrcLoc loc, Diag *diag)
{
  if (!s->translate && !s->rotate && !s->layers.n) {
    diag_error(diag, loc, "Extrude without a vector (along the normals) needs Layers");
    return false;
  }
  if (s->rotate && !(vec3_length(s->axis) > 0)) {
    diag_error(diag, loc, "the axis of this rotation has length 0");
    return false;
  }
  if (s->rotate && !s->translate && !(fabs(s->angle) <= (whole_turns ? 2 : 1) * 3.14159265358979323846 * (1 + 1e-12))) {
    diag_error(diag, loc, "cannot extrude by an angle of %g: an arc turns by %s at most; extrude in two steps", s->angle,
               whole_turns ? "2 pi" : "pi");
    return false;
  }
  bool against = !s->translate && !s->rotate && s->layers.height[0] < 0; // the normals
  for (int i = 0; i < s->layers.n; i++) {
    if (s->layers.count[i] < 1 || s->layers.count[i] > 100000000) {
      diag_error(diag, loc, "Layers: %d elements in layer %d; there must be at least 1", s->layers.count[i], i + 1);
      return false;
    }
    double below = i ? s->layers.height[i - 1] : 0;
    if (against ? s->layers.height[i] < below : s->layers.height[i] > below) continue;
    diag_error(diag, loc, "Layers: heights must increase, but %g is followed by %g", below, s->layers.height[i]);
    return false;
  }
  return true;
}

// Heights are shares of the whole, but lengths where there is no vector.
static Layers keep_layers(Model *m, const Layers *l, double unit)
{
  Layers k = *l;
  if (l->n) {
    k.count = arena_dup(&m->arena, l->count, (size_t)l->n * sizeof *l->count);
    k.height = arena_dup(&m->arena, l->height, (size_t)l->n * sizeof *l->height);
    for (int i = 0; i < l->n; i++) k.height[i] = l->height[i] / unit;
  }
  return k;
}

// Those of the shapes that there are. False (reported) if there is a volume among them.
static bool known_shapes(const Model *m, const Shape *shape, size_t n, ShapeVec *known, SrcLoc loc, Diag *diag)
{
  for (size_t i = 0; i < n; i++) {
    Kind k = dim__kind(shape[i].dim);
    if (shape[i].dim == 3) {
      diag_error(diag, loc, "cannot extrude a volume");
      return false;
    }
    if (model_has(m, shape[i].dim, shape[i].tag))
      vec_push(known, shape[i]);
    else if (!model__refused(m, k, shape[i].tag))
      diag_warning(diag, loc, "Extrude: there is no %s %d", kind__name(k), tag__abs(shape[i].tag));
  }
  return true;
}

bool model_extrude(Model *m, const Shape *shape, size_t n, const Sweep *sweep, ShapeVec *out, SrcLoc loc, Diag *diag)
{
  model__unprepare(m);
  if (!sweep_is_good(sweep, m->set.opencascade, loc, diag)) return false;
  bool vector = sweep->translate || sweep->rotate;
  Job j = {.m = m, .sweep = sweep, .loc = loc, .full = part_of(sweep, 1)};
  if (!vector) j.thickness = sweep->layers.height[sweep->layers.n - 1];
  j.layers = keep_layers(m, &sweep->layers, vector ? 1 : j.thickness);
  if (!vector && !collect_normals(&j, shape, n, loc, diag)) {
    map_free(&j.normal_at);
    vec_free(&j.normal);
    return false;
  }
  for (int i = 0; i < 12; i++)
    if (!isfinite(j.full.m[i])) {
      diag_error(diag, loc, "this extrusion is not finite");
      return false;
    }
  j.tol = m->point.live ? m->set.tolerance * vec3_distance(m->extent.lo, m->extent.hi) : 0;
  ShapeVec known = {0};
  bool good = known_shapes(m, shape, n, &known, loc, diag);
  if (good && m->set.opencascade && vector && !(sweep->rotate && sweep->translate))
    extrude__opencascade(m, known.data, known.len, sweep, &j.full, &j.layers, out, loc, diag);
  else
    for (size_t i = 0; good && i < known.len; i++) {
      if (known.data[i].dim == 0) extrude_point(&j, tag__abs(known.data[i].tag), out);
      if (known.data[i].dim == 1) extrude_curve(&j, known.data[i].tag, out);
      if (known.data[i].dim == 2) extrude_face(&j, tag__abs(known.data[i].tag), out);
    }
  vec_free(&known);
  map_free(&j.normal_at);
  vec_free(&j.normal);
  return good;
}
