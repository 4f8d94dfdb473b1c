// transform.c - affine maps, moving shapes, copies of shapes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_int.h"

// ---- maps -----------------------------------------------------------------------------------------------------------

Affine affine_translation(Vec3 d)
{
  return (Affine){{1, 0, 0, d.x, 0, 1, 0, d.y, 0, 0, 1, d.z, 0, 0, 0, 1}};
}

// The map q -> L q + (p - L p) that fixes p.
static Affine about(const double l[9], Vec3 p)
{
  Affine a = {{l[0], l[1], l[2], 0, l[3], l[4], l[5], 0, l[6], l[7], l[8], 0, 0, 0, 0, 1}};
  Vec3 q = affine_apply(&a, p);
  a.m[3] = p.x - q.x;
  a.m[7] = p.y - q.y;
  a.m[11] = p.z - q.z;
  return a;
}

Affine affine_rotation(Vec3 axis, Vec3 centre, double angle)
{
  Vec3 k = vec3_scale(1 / vec3_length(axis), axis);
  double c = cos(angle), s = sin(angle), d = 1 - c; // Rodrigues
  double l[9] = {c + k.x * k.x * d,       k.x * k.y * d - k.z * s, k.x * k.z * d + k.y * s,
                 k.y * k.x * d + k.z * s, c + k.y * k.y * d,       k.y * k.z * d - k.x * s,
                 k.z * k.x * d - k.y * s, k.z * k.y * d + k.x * s, c + k.z * k.z * d};
  return about(l, centre);
}

Affine affine_symmetry(double a, double b, double c, double d)
{
  double f = -2 / (a * a + b * b + c * c);
  return (Affine){{1 + f * a * a, f * a * b, f * a * c, f * a * d, f * b * a, 1 + f * b * b, f * b * c, f * b * d, f * c * a,
                   f * c * b, 1 + f * c * c, f * c * d, 0, 0, 0, 1}};
}

Affine affine_dilation(Vec3 centre, Vec3 factor)
{
  double l[9] = {factor.x, 0, 0, 0, factor.y, 0, 0, 0, factor.z};
  return about(l, centre);
}

Vec3 affine_apply(const Affine *a, Vec3 p)
{
  const double *t = a->m;
  return (Vec3){t[0] * p.x + t[1] * p.y + t[2] * p.z + t[3], t[4] * p.x + t[5] * p.y + t[6] * p.z + t[7],
                t[8] * p.x + t[9] * p.y + t[10] * p.z + t[11]};
}

// A plane's normal goes by the cofactors of the linear part, so that handedness follows.
static Vec3 apply_to_normal(const Affine *a, Vec3 n)
{
  const double *t = a->m;
  Vec3 x = {t[0], t[4], t[8]}, y = {t[1], t[5], t[9]}, z = {t[2], t[6], t[10]};
  Vec3 yz = vec3_cross(y, z), zx = vec3_cross(z, x), xy = vec3_cross(x, y);
  return vec3_add(vec3_scale(n.x, yz), vec3_add(vec3_scale(n.y, zx), vec3_scale(n.z, xy)));
}

// ---- what a list of shapes stands on ----------------------------------------------------------------------------------

typedef struct {
  const Model *m;
  Map seen; // dim << 32 | tag
  IntVec *point, *curve;
} Under;

static bool first_time(Under *u, int dim, int tag)
{
  bool added;
  map_slot(&u->seen, (uint64_t)dim << 32 | (uint32_t)tag, 1, &added);
  return added;
}

static void under_point(Under *u, int tag)
{
  if (first_time(u, 0, tag)) vec_push(u->point, tag);
}

static void under_curve(Under *u, int tag)
{
  tag = tag__abs(tag);
  if (!first_time(u, 1, tag)) return;
  const Curve *c = model_curve(u->m, tag);
  if (!c) return;
  if (u->curve) vec_push(u->curve, tag);
  for (int i = 0; i < c->npoint; i++) under_point(u, c->point[i]);
  under_point(u, c->begin);
  under_point(u, c->end);
}

static void under_face(Under *u, int tag)
{
  tag = tag__abs(tag);
  if (!first_time(u, 2, tag)) return;
  const Face *f = model_face(u->m, tag);
  for (int i = 0; f && i < f->nloop; i++) {
    const Loop *l = model_loop(u->m, f->loop[i]);
    for (int j = 0; j < l->ncurve; j++) under_curve(u, l->curve[j]);
  }
}

static void under(Under *u, const Shape *shape, size_t n)
{
  for (size_t i = 0; i < n; i++) {
    int tag = tag__abs(shape[i].tag);
    if (shape[i].dim == 0) under_point(u, tag);
    if (shape[i].dim == 1) under_curve(u, tag);
    if (shape[i].dim == 2) under_face(u, tag);
    if (shape[i].dim == 3) {
      const Volume *v = table__get(&u->m->volume, tag);
      for (int j = 0; v && j < v->nface; j++) under_face(u, v->face[j]);
    }
  }
}

static bool shapes_exist(const Model *m, const Shape *shape, size_t n, const char *doing, SrcLoc loc, Diag *diag)
{
  bool good = true;
  for (size_t i = 0; i < n; i++) {
    if (model_has(m, shape[i].dim, shape[i].tag)) continue;
    good = false;
    Kind k = dim__kind(shape[i].dim);
    if (model__refused(m, k, shape[i].tag)) continue;
    diag_error(diag, loc, "cannot %s %s %d: it does not exist", doing, kind__name(k), tag__abs(shape[i].tag));
    break;
  }
  return good;
}

// ---- moving -----------------------------------------------------------------------------------------------------------

void model__move_points(Model *m, const int *tag, size_t n, const Affine *a)
{
  for (size_t i = 0; i < n; i++) {
    Point *p = point__get(m, tag[i]);
    model__point_moves(m, p, affine_apply(a, p->xyz));
  }
}

static void move_arc(Arc *arc, const Affine *a)
{
  Vec3 x = affine_apply(a, vec3_add(arc->centre, arc->a)), y = affine_apply(a, vec3_add(arc->centre, arc->b));
  arc->centre = affine_apply(a, arc->centre);
  arc->a = vec3_sub(x, arc->centre);
  arc->b = vec3_sub(y, arc->centre);
}

// Arcs whose plane their points do not give (half circles) need a normal of their own once they were turned.
static void turn_planes(Model *m, const IntVec *curve, const Affine *a)
{
  for (size_t i = 0; i < curve->len; i++) {
    Curve *c = model_curve(m, curve->data[i]);
    if (c->arc) {
      move_arc(c->arc, a);
      continue;
    }
    if (c->pieces) {
      int count = c->pieces->npiece * (c->pieces->degree + 1);
      for (int k = 0; k < count; k++) c->pieces->control[k] = affine_apply(a, c->pieces->control[k]);
      continue;
    }
    if (c->type != CURVE_CIRCLE && c->type != CURVE_ELLIPSE) continue;
    Vec3 n = apply_to_normal(a, c->has_plane ? c->plane : (Vec3){0, 0, 1});
    double length = vec3_length(n);
    if (!(length > 0)) continue;
    n = vec3_scale(1 / length, n);
    if (!c->has_plane && n.x == 0 && n.y == 0 && n.z > 0) continue;
    model__forget_curve(m, c);
    c->plane = n;
    c->has_plane = true;
    vec_push(&m->dirty[1], c->tag);
  }
}

static void transform_known(Model *m, const Shape *shape, size_t n, const Affine *a)
{
  IntVec point = {0}, curve = {0};
  Under u = {m, {0}, &point, &curve};
  under(&u, shape, n);
  map_free(&u.seen);
  model__move_points(m, point.data, point.len, a);
  turn_planes(m, &curve, a);
  vec_free(&point);
  vec_free(&curve);
}

static bool is_finite(const Affine *a)
{
  for (int i = 0; i < 16; i++)
    if (!isfinite(a->m[i])) return false;
  return true;
}

bool model_transform(Model *m, const Shape *shape, size_t n, const Affine *a, SrcLoc loc, Diag *diag)
{
  model__unprepare(m);
  if (!is_finite(a)) {
    diag_error(diag, loc, "this transformation has no finite coefficients (an axis or a normal of length 0?)");
    return false;
  }
  if (!shapes_exist(m, shape, n, "transform", loc, diag)) return false;
  bool apart = m->set.opencascade; // points, and volumes for their faces, take along what is on them
  for (size_t i = 0; i < n; i++) apart = apart && (shape[i].dim == 1 || shape[i].dim == 2);
  if (apart) return transform__opencascade(m, shape, n, a, diag);
  transform_known(m, shape, n, a);
  if (m->set.auto_coherence && !m->set.opencascade) model_coherence(m, diag);
  return true;
}

void model__transform_shape(Model *m, int dim, int tag, const Affine *a)
{
  Shape s = {dim, tag};
  transform_known(m, &s, 1, a);
}

// ---- copies -----------------------------------------------------------------------------------------------------------

int model__copy_point(Model *m, int tag, SrcLoc loc)
{
  const Point *p = point__get(m, tag);
  int copy = model__next_tag(m, KIND_POINT);
  point__make(m, copy, p->xyz, p->lc, loc);
  return copy;
}

static void copy_curve_mesh(Model *m, Curve *to, const Curve *from, bool reversed)
{
  to->transfinite = from->transfinite;
  to->law = from->law;
  to->coef = reversed && from->law != LAW_BUMP && from->coef > 0 ? 1 / from->coef : from->coef;
  to->reverse_mesh = from->reverse_mesh;
  to->degenerate = from->degenerate;
  if (from->extruded_point && from->layers.n) {
    to->layers = from->layers;
    to->extruded_point = from->extruded_point;
  }
  (void)m;
}

// The copy of a curve (run backwards when its tag is negative): a new tag first, then points for all control points and
// two more for the ends, which are there for the tags' sake alone: the next coherence merges them.
int model__copy_curve(Model *m, int signed_tag, SrcLoc loc)
{
  const Curve *c = model_curve(m, signed_tag);
  bool back = signed_tag < 0;
  int tag = model__next_tag(m, KIND_CURVE), n = c->npoint;
  int *point = mem_alloc((size_t)n * sizeof *point);
  for (int i = 0; i < n; i++) point[i] = c->point[back ? n - 1 - i : i];
  if (back && c->type == CURVE_ELLIPSE && n == 4) { // the centre and the axis keep their places
    point[1] = c->point[1];
    point[2] = c->point[2];
  }
  for (int i = 0; i < n; i++) point[i] = model__copy_point(m, point[i], loc);
  (void)model__copy_point(m, back ? c->end : c->begin, loc);
  (void)model__copy_point(m, back ? c->begin : c->end, loc);
  Curve *d = curve__make(m, tag, c->type, point, n, point[0], point[n - 1], loc);
  free(point);
  if (c->nknot) {
    d->nknot = c->nknot;
    d->knot = arena_dup(&m->arena, c->knot, (size_t)c->nknot * sizeof *c->knot);
    for (int i = 0; back && i < c->nknot; i++) d->knot[i] = c->knot[0] + c->knot[c->nknot - 1] - c->knot[c->nknot - 1 - i];
  }
  if (c->pieces) d->pieces = pieces__copy(m, c->pieces, back);
  if (c->arc) {
    d->arc = arena_dup(&m->arena, c->arc, sizeof *c->arc);
    if (back) d->arc->t0 = c->arc->t1, d->arc->t1 = c->arc->t0;
    if (m->set.copy_meshing) copy_curve_mesh(m, d, c, back);
    return tag;
  }
  d->has_plane = c->has_plane || (back && (c->type == CURVE_CIRCLE || c->type == CURVE_ELLIPSE));
  d->plane = c->has_plane ? c->plane : (Vec3){0, 0, 1};
  if (back) d->plane = vec3_scale(-1, d->plane);
  if (!d->has_plane) d->plane = (Vec3){0, 0, 0};
  if (m->set.copy_meshing) copy_curve_mesh(m, d, c, back);
  return tag;
}

// The copy of a face: a new tag first, then copies of its curves in order, run as the face runs them; one hidden loop.
int model__copy_face(Model *m, int signed_tag, SrcLoc loc)
{
  const Face *f = model_face(m, signed_tag);
  int tag = model__next_tag(m, KIND_FACE);
  int before = m->max[KIND_FACE];
  model__note_tag(m, KIND_FACE, tag); // the curves' tags come after it
  IntVec curve = {0}, start = {0}, copy = {0};
  face_boundary(m, f, &curve, &start);
  for (size_t i = 0; i < curve.len; i++) vec_push(&copy, model__copy_curve(m, curve.data[i], loc));
  // Each copied curve has ends of its own; they become one point each at the next coherence, and the loop closes then.
  int loop = loop__make_hidden(m, copy.data, (int)copy.len, loc);
  m->max[KIND_FACE] = before;
  Face *g = face__make(m, tag, f->type, &loop, 1, loc);
  if (m->set.copy_meshing) {
    g->transfinite = f->transfinite && !f->ncorner;
    g->arrangement = f->arrangement;
    face__copy_meshing(g, f);
  }
  vec_free(&curve);
  vec_free(&start);
  vec_free(&copy);
  return tag;
}

// OpenCASCADE copies a shape whole: what its curves shared, their copies share.
typedef struct {
  Model *m;
  Map copy; // dim << 32 | tag -> tag of the copy
  SrcLoc loc;
} Whole;

static int whole_point(Whole *w, int tag)
{
  bool added;
  uint32_t *slot = map_slot(&w->copy, (uint64_t)(uint32_t)tag, 0, &added);
  if (added) *slot = (uint32_t)model__copy_point(w->m, tag, w->loc);
  return (int)*slot;
}

static int whole_curve(Whole *w, int signed_tag)
{
  Model *m = w->m;
  const Curve *c = model_curve(m, signed_tag);
  uint64_t key = (uint64_t)1 << 32 | (uint32_t)c->tag;
  uint32_t known = map_get(&w->copy, key);
  if (known != NONE) return signed_tag < 0 ? -(int)known : (int)known;
  (void)whole_point(w, curve__from(m, signed_tag));
  (void)whole_point(w, curve__to(m, signed_tag));
  int *point = mem_alloc((size_t)c->npoint * sizeof *point), tag = model__next_tag(m, KIND_CURVE);
  for (int i = 0; i < c->npoint; i++) point[i] = whole_point(w, c->point[i]);
  Curve *d = curve__make(m, tag, c->type, point, c->npoint, whole_point(w, c->begin), whole_point(w, c->end), w->loc);
  free(point);
  if (c->arc) d->arc = arena_dup(&m->arena, c->arc, sizeof *c->arc);
  if (c->nknot) d->knot = arena_dup(&m->arena, c->knot, (size_t)c->nknot * sizeof *c->knot);
  d->nknot = c->nknot;
  d->has_plane = c->has_plane;
  d->plane = c->plane;
  map_set(&w->copy, key, (uint32_t)tag);
  return signed_tag < 0 ? -tag : tag;
}

static int whole_face(Whole *w, int tag)
{
  Model *m = w->m;
  IntVec curve = {0}, start = {0}, wire = {0};
  const Face *f = model_face(m, tag);
  face_boundary(m, f, &curve, &start);
  face__wires(m, f, &curve, &start, &wire);
  for (size_t i = 0; i < wire.len; i++) wire.data[i] = whole_curve(w, wire.data[i]);
  for (size_t i = 0; i < curve.len; i++) curve.data[i] = whole_curve(w, curve.data[i]);
  const int *loop = loop__make_parts(m, &curve, &start, &wire, w->loc);
  int copy = model__next_tag(m, KIND_FACE);
  face__make(m, copy, f->type, loop, (int)start.len - 1, w->loc);
  wire__note(m, copy);
  vec_free(&wire);
  vec_free(&curve);
  vec_free(&start);
  return copy;
}

static int copy_whole(Model *m, Shape s, SrcLoc loc)
{
  Whole w = {m, {0}, loc};
  int copy = s.dim == 0 ? whole_point(&w, tag__abs(s.tag)) : s.dim == 1 ? whole_curve(&w, tag__abs(s.tag)) : whole_face(&w, tag__abs(s.tag));
  map_free(&w.copy);
  return copy;
}

// Duplicates of the faces' shared curves are made face by face and merged later, as in Gmsh.
static int copy_volume(Model *m, int tag, SrcLoc loc)
{
  const Volume *v = table__get(&m->volume, tag);
  int copy = model__next_tag(m, KIND_VOLUME);
  int before = m->max[KIND_VOLUME];
  model__note_tag(m, KIND_VOLUME, copy);
  IntVec face = {0};
  for (int i = 0; i < v->nface; i++) {
    int g = model__copy_face(m, v->face[i], loc);
    vec_push(&face, v->face[i] < 0 ? -g : g);
  }
  m->max[KIND_VOLUME] = before;
  volume__make(m, copy, face.data, (int)face.len, loc);
  vec_free(&face);
  return copy;
}

bool model_duplicate(Model *m, const Shape *shape, size_t n, ShapeVec *out, SrcLoc loc, Diag *diag)
{
  model__unprepare(m);
  if (!shapes_exist(m, shape, n, "copy", loc, diag)) return false;
  for (size_t i = 0; i < n; i++) {
    Shape s = shape[i];
    if (m->set.opencascade && s.dim < 3) {
      s.tag = copy_whole(m, s, loc);
      vec_push(out, s);
      continue;
    }
    if (s.dim == 0) s.tag = model__copy_point(m, tag__abs(s.tag), loc);
    if (s.dim == 1) s.tag = model__copy_curve(m, s.tag, loc);
    if (s.dim == 2) s.tag = model__copy_face(m, tag__abs(s.tag), loc);
    if (s.dim == 3) s.tag = copy_volume(m, tag__abs(s.tag), loc);
    vec_push(out, s);
  }
  return true;
}
