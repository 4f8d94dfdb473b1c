// query.c - boundaries, bounding boxes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_int.h"

static void push(ShapeVec *out, int dim, int tag)
{
  Shape s = {dim, tag};
  vec_push(out, s);
}

// OpenCASCADE lists a loop from the first curve of its wire on, the way that one runs: turns a loop that a Boolean operation made.
static void turn_as_listed(int *curve, size_t n, int first)
{
  for (size_t turns = 0; turns < n && tag__abs(curve[0]) != first; turns++) {
    int c = curve[0];
    memmove(curve, curve + 1, (n - 1) * sizeof *curve);
    curve[n - 1] = c;
  }
  if (n == 0 || curve[0] >= 0) return;
  for (size_t i = 0; i < n; i++) curve[i] = -curve[i];
  for (size_t i = 1, k = n - 1; i < k; i++, k--) {
    int c = curve[i];
    curve[i] = curve[k];
    curve[k] = c;
  }
}

static void boundary_of(const Model *m, Shape s, ShapeVec *out)
{
  bool back = s.tag < 0;
  if (s.dim == 1) {
    push(out, 0, curve__from(m, s.tag));
    push(out, 0, curve__to(m, s.tag));
  }
  if (s.dim == 2) {
    IntVec curve = {0}, start = {0};
    const Face *f = model_face(m, s.tag);
    face_boundary(m, f, &curve, &start);
    for (size_t k = 0; k + 1 < start.len && start.len - 1 == (size_t)f->nloop; k++) {
      const Loop *l = model_loop(m, f->loop[k]);
      if (l && l->wire) turn_as_listed(curve.data + start.data[k], (size_t)(start.data[k + 1] - start.data[k]), l->wire[0]);
    }
    for (size_t i = 0; i < curve.len; i++) push(out, 1, back ? -curve.data[i] : curve.data[i]);
    vec_free(&curve);
    vec_free(&start);
  }
  if (s.dim == 3) {
    const Volume *v = table__get(&m->volume, tag__abs(s.tag));
    for (int i = 0; i < v->nface; i++) push(out, 2, back ? -v->face[i] : v->face[i]);
  }
}

static int by_shape(const void *a, const void *b)
{
  const Shape *p = a, *q = b;
  int x = tag__abs(p->tag), y = tag__abs(q->tag);
  if (p->dim != q->dim) return (p->dim > q->dim) - (p->dim < q->dim);
  return x != y ? (x > y) - (x < y) : (p->tag > q->tag) - (p->tag < q->tag);
}

// Keep what occurs an odd number of times, each once, by tag.
static void combine(ShapeVec *v, size_t from)
{
  if (v->len > from) qsort(v->data + from, v->len - from, sizeof *v->data, by_shape);
  size_t n = from;
  for (size_t i = from; i < v->len;) {
    size_t k = i;
    while (k < v->len && v->data[k].dim == v->data[i].dim && tag__abs(v->data[k].tag) == tag__abs(v->data[i].tag)) k++;
    if ((k - i) % 2) v->data[n++] = v->data[i];
    i = k;
  }
  v->len = n;
}

static bool exists(const Model *m, Shape s, const char *what, SrcLoc loc, Diag *diag)
{
  if (model_has(m, s.dim, s.tag)) return true;
  Kind k = dim__kind(s.dim);
  if (!model__refused(m, k, s.tag))
    diag_error(diag, loc, "%s of %s %d, which does not exist", what, kind__name(k), tag__abs(s.tag));
  return false;
}

bool model_boundary(const Model *m, const Shape *shape, size_t n, bool combined, bool oriented, ShapeVec *out, SrcLoc loc,
                    Diag *diag)
{
  size_t from = out->len;
  for (size_t i = 0; i < n; i++) {
    if (!exists(m, shape[i], "boundary", loc, diag)) return false;
    boundary_of(m, shape[i], out);
  }
  if (combined) combine(out, from);
  for (size_t i = from; !oriented && i < out->len; i++) out->data[i].tag = tag__abs(out->data[i].tag);
  return true;
}

static void points_of(const Model *m, Shape s, IntVec *out)
{
  if (s.dim == 0) {
    vec_push(out, tag__abs(s.tag));
    return;
  }
  if (s.dim == 1) {
    vec_push(out, curve__from(m, s.tag));
    vec_push(out, curve__to(m, s.tag));
    return;
  }
  ShapeVec part = {0};
  boundary_of(m, s, &part);
  for (size_t i = 0; i < part.len; i++) points_of(m, part.data[i], out);
  vec_free(&part);
}

static int by_value(const void *a, const void *b)
{
  int x = *(const int *)a, y = *(const int *)b;
  return (x > y) - (x < y);
}

bool model_points_of(const Model *m, const Shape *shape, size_t n, ShapeVec *out, SrcLoc loc, Diag *diag)
{
  for (size_t i = 0; i < n; i++) {
    if (!exists(m, shape[i], "points", loc, diag)) return false;
    IntVec point = {0};
    points_of(m, shape[i], &point);
    if (point.len) qsort(point.data, point.len, sizeof(int), by_value);
    for (size_t k = 0; k < point.len; k++)
      if (!k || point.data[k] != point.data[k - 1]) push(out, 0, point.data[k]);
    vec_free(&point);
  }
  return true;
}

// ---- boxes ------------------------------------------------------------------------------------------------------------

static Box3 join(Box3 a, Box3 b)
{
  if (b.lo.x > b.hi.x) return a;
  return box3_with(box3_with(a, b.lo), b.hi);
}

static Box3 curve_box(Model *m, int tag)
{
  Curve *c = model_curve(m, tag);
  Diag *silent = diag_new(false);
  Box3 b = box3_empty();
  if (curve__build(m, c, silent)) b = curve_bounds(m, c); // anew: its points may have moved
  diag_free(silent);
  return b;
}

static Box3 shape_box(Model *m, Shape s)
{
  Box3 b = box3_empty();
  if (s.dim == 0) return box3_with(b, model_point(m, s.tag)->xyz);
  if (s.dim == 1) return curve_box(m, s.tag);
  ShapeVec part = {0};
  boundary_of(m, s, &part);
  for (size_t i = 0; i < part.len; i++) b = join(b, shape_box(m, part.data[i]));
  vec_free(&part);
  return b;
}

void model_in_box(Model *m, int dim, Box3 box, IntVec *out)
{
  model__unprepare(m);
  IntVec all = {0};
  model_all(m, dim, &all);
  for (size_t i = 0; i < all.len; i++) {
    Box3 b = shape_box(m, (Shape){dim, all.data[i]});
    if (b.lo.x >= box.lo.x && b.lo.y >= box.lo.y && b.lo.z >= box.lo.z && b.hi.x <= box.hi.x && b.hi.y <= box.hi.y &&
        b.hi.z <= box.hi.z)
      vec_push(out, all.data[i]);
  }
  vec_free(&all);
}

bool model_box_of(Model *m, const Shape *shape, size_t n, Box3 *box, SrcLoc loc, Diag *diag)
{
  model__unprepare(m);
  *box = box3_empty();
  for (size_t i = 0; i < n; i++) {
    if (!exists(m, shape[i], "bounding box", loc, diag)) return false;
    *box = join(*box, shape_box(m, shape[i]));
  }
  return true;
}

Box3 model_bounds(const Model *m)
{
  Box3 b = box3_empty();
  size_t n = model_points(m);
  for (size_t i = 0; i < n; i++) b = box3_with(b, model_point_at(m, i)->xyz);
  n = model_curves(m);
  for (size_t i = 0; i < n; i++) {
    const Curve *c = model_curve_at(m, i);
    if (c->type != CURVE_LINE && c->type != CURVE_POLYLINE && c->shape) b = join(b, curve_bounds(m, c));
  }
  return b;
}
