// size.c - the size at a place of an entity: the least of all wishes, between bounds, times the factor
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "size/size.h"

#include <math.h>

#include "size/size_int.h"

// Diagonal of the model's box as Gmsh takes it: a box flat in x or y is widened by the other extent, z may be flat.
static double model_diagonal(const Model *m)
{
  Box3 b = model_bounds(m);
  if (!(b.lo.x <= b.hi.x)) return 1;
  double dx = b.hi.x - b.lo.x, dy = b.hi.y - b.lo.y, dz = b.hi.z - b.lo.z;
  bool flat_x = dx == 0, flat_y = dy == 0;
  if (flat_x && flat_y && dz == 0) return 2 * sqrt(3.0);
  if (flat_x) dx = 2 * sqrt(dy * dy + dz * dz);
  if (flat_y) dy = 2 * (flat_x ? dx : sqrt(dx * dx + dz * dz));
  return sqrt(dx * dx + dy * dy + dz * dz);
}

static void list_curves_of_points(SizeField *s)
{
  const Model *m = s->model;
  size_t np = model_points(m), nc = model_curves(m);
  Map index = {0};
  map_reserve(&index, np);
  for (size_t k = 0; k < np; k++) map_set(&index, (uint64_t)model_point_at(m, k)->tag, (uint32_t)k);
  vec_resize(&s->curve_first, np + 2);
  memset(s->curve_first.data, 0, (np + 2) * sizeof(uint32_t));
  vec_resize(&s->curve_list, 2 * nc);
  // Count into place k+2, sum up, fill through place k+1: it ends as the first of k+1.
  for (int pass = 0; pass < 2; pass++) {
    for (size_t k = 0; k < nc; k++) {
      const Curve *c = model_curve_at(m, k);
      int end[2] = {c->begin, c->end};
      for (int i = 0; i < 2; i++) {
        uint32_t p = map_get(&index, (uint64_t)end[i]);
        if (p == NONE) continue;
        if (pass == 0) s->curve_first.data[p + 2]++;
        else s->curve_list.data[s->curve_first.data[p + 1]++] = (uint32_t)k;
      }
    }
    for (size_t k = 2; pass == 0 && k < np + 2; k++) s->curve_first.data[k] += s->curve_first.data[k - 1];
  }
  map_free(&index);
}

SizeField *size_new(const Model *model, const Options *o, const FieldSet *fields, Diag *diag)
{
  SizeField *s = mem_zalloc(sizeof *s);
  s->model = model;
  s->options = o;
  s->fields = fields;
  s->diagonal = model_diagonal(model);
  s->factor = o->Mesh_MeshSizeFactor;
  s->lo = o->Mesh_MeshSizeMin;
  s->hi = o->Mesh_MeshSizeMax;
  s->per_turn = o->Mesh_MeshSizeFromCurvature;
  s->from_points = o->Mesh_MeshSizeFromPoints;
  s->parametric = o->Mesh_MeshSizeFromParametricPoints;
  s->gradation = o->Mesh_SizeGradation > 0 ? MAX(o->Mesh_SizeGradation - 1, 1e-3) : 0;
  s->root = NONE;
  if (s->per_turn > 0) list_curves_of_points(s);
  bool good = true;
  if (fields && fields->background_view >= 0)
    good = (s->root = size__compile_view(s, fields->background_view, fields->background_view_loc, diag)) != NONE;
  else if (fields && fields->background >= 0 && !field_exists(fields, fields->background))
    diag_warning(diag, fields->background_loc, "there is no field %d: the background field is ignored", fields->background);
  else if (fields && fields->background >= 0)
    good = (s->root = size__compile(s, fields->background, fields->background_loc, diag)) != NONE;
  if (s->lo > s->hi) {
    diag_error(diag, NO_LOC, "Mesh.MeshSizeMin (%g) is larger than Mesh.MeshSizeMax (%g)", s->lo, s->hi);
    good = false;
  }
  if (good) return s;
  size_free(s);
  return NULL;
}

void size_free(SizeField *s)
{
  if (!s) return;
  for (uint32_t k = 0; k < s->nnode; k++) {
    Node *n = &s->node[k];
    if (n->ops->release) n->ops->release(n);
    free(n->data);
    free(n->in);
  }
  free(s->node);
  map_free(&s->node_of);
  cones_free(s->cones);
  vec_free(&s->curve_first);
  vec_free(&s->curve_list);
  free(s);
}

SizeEval *size_eval_new(const SizeField *s)
{
  SizeEval *e = mem_zalloc(sizeof *e);
  e->s = s;
  e->memo = mem_zalloc((s->nnode + 1) * sizeof *e->memo);
  e->hint = mem_alloc((s->nnode + 1) * sizeof *e->hint);
  for (uint32_t k = 0; k < s->nnode; k++) e->hint[k] = NONE;
  e->serial = 1;
  return e;
}

void size_eval_free(SizeEval *e)
{
  if (!e) return;
  for (size_t i = 0; i < e->spare.len; i++) free(e->spare.data[i]);
  vec_free(&e->spare);
  free(e->stack);
  free(e->memo);
  free(e->hint);
  free(e);
}

bool size_has_field(const SizeField *s) { return s->root != NONE; }
double size_diagonal(const SizeField *s) { return s->diagonal; }
double size_gradation(const SizeField *s) { return s->gradation; }

// ---- the parts ------------------------------------------------------------------------------------------------------

static double point_lc(const SizeField *s, int tag)
{
  const Point *p = model_point(s->model, tag);
  return p ? p->lc : LC_UNSET;
}

// Linear, and exact at both ends: one of them may be LC_UNSET, beside which the other would be lost in rounding.
static double between(double a, double b, double t) { return a == b ? a : t >= 1 ? b : a + t * (b - a); }

// Between control points, linear in the parameter, where the user asks for the sizes of all of them.
static double lc_between_controls(const SizeField *s, const Curve *c, double u)
{
  double t = u * (c->npoint - 1);
  int i = MIN((int)t, c->npoint - 2);
  double a = point_lc(s, c->point[i]), b = point_lc(s, c->point[i + 1]);
  return between(a, b, t - i);
}

static bool has_inner_controls(const Curve *c)
{
  return c->npoint > 2 && c->type != CURVE_CIRCLE && c->type != CURVE_ELLIPSE;
}

static double curve_lc(const SizeField *s, const Curve *c, double u)
{
  if (s->parametric && has_inner_controls(c)) return lc_between_controls(s, c, u);
  double a = point_lc(s, c->begin), b = point_lc(s, c->end);
  if (a >= LC_UNSET && b >= LC_UNSET) return s->diagonal / 10;
  return between(a, b, u);
}

static double curvature_size(const SizeField *s, const Curve *c, double u)
{
  double k = curve_curvature(s->model, c, u);
  return k > 0 ? 2 * M_PI / (k * s->per_turn) : NO_SIZE;
}

double size__of_curve(const SizeField *s, const Curve *c, double u)
{
  double h = s->diagonal;
  if (s->from_points) h = fmin(h, curve_lc(s, c, u));
  if (s->per_turn > 0) h = fmin(h, curvature_size(s, c, u));
  return h;
}

// Index of a point in the order of model_point_at.
static size_t point_index(const Model *m, int tag)
{
  size_t lo = 0, hi = model_points(m);
  while (lo < hi) {
    size_t mid = (lo + hi) / 2;
    if (model_point_at(m, mid)->tag < tag) lo = mid + 1;
    else hi = mid;
  }
  return lo;
}

static double size_of_point(const SizeField *s, const Point *p)
{
  double h = s->diagonal;
  if (s->from_points) h = fmin(h, p->lc >= LC_UNSET ? s->diagonal / 10 : p->lc);
  if (s->per_turn > 0) {
    size_t k = point_index(s->model, p->tag);
    for (uint32_t i = s->curve_first.data[k]; i < s->curve_first.data[k + 1]; i++) {
      const Curve *c = model_curve_at(s->model, s->curve_list.data[i]);
      h = fmin(h, curvature_size(s, c, c->begin == p->tag ? 0 : 1));
    }
  }
  return h;
}

// ---- together ---------------------------------------------------------------------------------------------------------

static void note_fault(SizeEval *e, double value, Vec3 at, Where w)
{
  if (e->fault.set) return;
  e->fault.set = true;
  e->fault.field = e->s->root == NONE ? NULL : e->s->node[e->s->root].field;
  e->fault.value = value;
  e->fault.at = at;
  e->fault.where = w;
}

static double clamp_and_scale(const SizeField *s, double h)
{
  if (h < s->lo) h = s->lo;
  if (h > s->hi) h = s->hi;
  return h * s->factor;
}

// The size wanted by `geometry` (points, curvature, D) and by the field's value v.
static double combine(SizeEval *e, double geometry, double v, Vec3 at, Where w)
{
  const SizeField *s = e->s;
  double h = clamp_and_scale(s, v < geometry ? v : geometry);
  if (LIKELY(h > 0 && v < INFINITY)) return h;
  if (h > 0 && v == v) { // a division by zero: no size there
    if (!e->infinite.set) e->infinite = (Fault){.set = true, .value = v, .at = at, .where = w};
    return h;
  }
  note_fault(e, v, at, w);
  return clamp_and_scale(s, geometry);
}

static double with_field(SizeEval *e, double geometry, Vec3 at, Where w)
{
  const SizeField *s = e->s;
  if (s->root == NONE) return clamp_and_scale(s, geometry);
  return combine(e, geometry, size__at(e, s->root, w, at), at, w);
}

double size_at_point(SizeEval *e, const Point *p)
{
  return with_field(e, size_of_point(e->s, p), p->xyz, (Where){0, p->tag});
}

double size_on_curve(SizeEval *e, const Curve *c, double u, Vec3 p)
{
  return with_field(e, size__of_curve(e->s, c, u), p, (Where){1, c->tag});
}

double size_in_face(SizeEval *e, const Face *f, Vec3 p)
{
  double h = with_field(e, e->s->diagonal, p, (Where){2, f ? f->tag : 0});
  return e->s->cones ? cones_at(e->s->cones, p, h) : h;
}

// Field values at n places, in blocks.
static void field_batch(SizeEval *e, Where w, const Vec3 *p, size_t n, double *v)
{
  double x[BATCH], y[BATCH], z[BATCH];
  for (size_t from = 0; from < n; from += BATCH) {
    size_t m = MIN(n - from, (size_t)BATCH);
    for (size_t i = 0; i < m; i++) x[i] = p[from + i].x, y[i] = p[from + i].y, z[i] = p[from + i].z;
    Places at = {x, y, z, ++e->serial};
    size__eval(e, e->s->root, w, &at, m, v + from);
  }
}

void size_on_curve_batch(SizeEval *e, const Curve *c, const double *u, const Vec3 *p, size_t n, double *h)
{
  const SizeField *s = e->s;
  Where w = {1, c->tag};
  if (s->root == NONE) {
    for (size_t i = 0; i < n; i++) h[i] = clamp_and_scale(s, size__of_curve(s, c, u[i]));
    return;
  }
  field_batch(e, w, p, n, h);
  for (size_t i = 0; i < n; i++) h[i] = combine(e, size__of_curve(s, c, u[i]), h[i], p[i], w);
}

void size_in_face_batch(SizeEval *e, const Face *f, const Vec3 *p, size_t n, double *h)
{
  const SizeField *s = e->s;
  Where w = {2, f ? f->tag : 0};
  if (s->root == NONE) {
    for (size_t i = 0; i < n; i++) h[i] = clamp_and_scale(s, s->diagonal);
  } else {
    field_batch(e, w, p, n, h);
    for (size_t i = 0; i < n; i++) h[i] = combine(e, s->diagonal, h[i], p[i], w);
  }
  for (size_t i = 0; s->cones && i < n; i++) h[i] = cones_at(s->cones, p[i], h[i]);
}

bool size_is_constant(const SizeField *s, const Face *f, double *h)
{
  double v = NO_SIZE;
  if (s->cones || (f && f->sphere)) return false;
  if (s->root != NONE) {
    const Node *n = &s->node[s->root];
    if (!n->ops->constant || !n->ops->constant(s, n, (Where){2, f ? f->tag : 0}, &v)) return false;
    if (!(v > 0)) return false; // a fault is to be noted at a place
  }
  *h = clamp_and_scale(s, fmin(s->diagonal, v));
  return true;
}

// ---- growth inside faces ----------------------------------------------------------------------------------------------------

typedef struct {
  SizeEval *e;
  const Face *f;
  Vec(Vec3) p;
  DoubleVec h;
  size_t most;
} Sampling;

// Samples at the centres of a quadtree whose cells are not wider than the size in their centre.
static void sample_cell(Sampling *a, Vec2 centre, double half, int level)
{
  enum { LEAST_LEVEL = 4, LAST_LEVEL = 20 };
  Vec3 p = face_from_plane(a->f, centre);
  double h = size_in_face(a->e, a->f, p);
  if (level >= LAST_LEVEL || a->h.len >= a->most || (level >= LEAST_LEVEL && 2 * half <= h)) {
    vec_push(&a->p, p);
    vec_push(&a->h, h);
    return;
  }
  for (int k = 0; k < 4; k++)
    sample_cell(a, (Vec2){centre.x + (k & 1 ? half : -half) / 2, centre.y + (k & 2 ? half : -half) / 2}, half / 2, level + 1);
}

static void sample_face(Sampling *a, const Model *m, const Face *f)
{
  double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
  for (int i = 0; i < f->nloop; i++) {
    const Loop *loop = model_loop(m, f->loop[i]);
    for (int k = 0; loop && k < loop->ncurve; k++) {
      const Curve *c = model_curve(m, loop->curve[k]);
      if (!c) continue;
      for (int j = 0; j <= 16; j++) {
        Vec2 q = face_to_plane(f, curve_point(m, c, j / 16.0));
        lo[0] = fmin(lo[0], q.x), hi[0] = fmax(hi[0], q.x);
        lo[1] = fmin(lo[1], q.y), hi[1] = fmax(hi[1], q.y);
      }
    }
  }
  if (!(lo[0] <= hi[0])) return;
  a->f = f;
  a->most = a->h.len + ((size_t)1 << 20);
  sample_cell(a, (Vec2){(lo[0] + hi[0]) / 2, (lo[1] + hi[1]) / 2}, fmax(hi[0] - lo[0], hi[1] - lo[1]) / 2, 0);
}

void size_limit_growth(SizeField *s, const Vec3 *p, const double *h, size_t n)
{
  if (s->gradation <= 0 || s->cones) return;
  Sampling a = {0};
  for (size_t i = 0; i < n; i++) {
    vec_push(&a.p, p[i]);
    vec_push(&a.h, h[i]);
  }
  if (s->root != NONE) {
    a.e = size_eval_new(s);
    for (size_t k = 0; k < model_faces(s->model); k++) sample_face(&a, s->model, model_face_at(s->model, k));
    size_eval_free(a.e);
  }
  s->cones = cones_new(a.p.data, a.h.data, a.p.len, s->gradation);
  vec_free(&a.p);
  vec_free(&a.h);
}

double size_in_plane(void *ctx, Vec2 p)
{
  SizeInPlane *in = ctx;
  if (in->constant > 0) return in->constant;
  double h = size_in_face(in->eval, in->face, face_from_plane(in->face, p)) * face_plane_scale(in->face, p), same;
  if (in->constant == 0) in->constant = size_is_constant(in->eval->s, in->face, &same) ? h : -1;
  return h;
}

void size_in_plane_batch(void *ctx, const Vec2 *p, size_t n, double *h)
{
  SizeInPlane *in = ctx;
  Vec3 at[BATCH];
  for (size_t from = 0; from < n; from += BATCH) {
    size_t m = MIN(n - from, (size_t)BATCH);
    for (size_t i = 0; i < m; i++) at[i] = face_from_plane(in->face, p[from + i]);
    size_in_face_batch(in->eval, in->face, at, m, h + from);
    for (size_t i = 0; in->face->sphere && i < m; i++) h[from + i] *= face_plane_scale(in->face, p[from + i]);
  }
}
