// field_shape.c - fields that are formulas of the place: Box, Ball, Cylinder, Frustum
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "size/size_int.h"

typedef struct {
  double in, out;       // VIn, VOut
  Vec3 lo, hi;          // Box
  Vec3 centre, axis;    // Ball, Cylinder
  double radius, thickness, axis2;
} Shape;

static Vec3 option_vec3(const Field *f, const char *x, const char *y, const char *z)
{
  return (Vec3){field__number(f, x), field__number(f, y), field__number(f, z)};
}

static Shape *new_shape(Node *n)
{
  Shape *d = n->data = mem_zalloc(sizeof *d);
  d->in = field__number(n->field, "VIn");
  d->out = field__number(n->field, "VOut");
  return d;
}

// The value at a distance `beyond` >= 0 outside a shape with a transition layer.
static double in_layer(const Shape *d, double beyond)
{
  if (beyond <= 0) return d->in;
  return beyond < d->thickness ? d->in + (d->out - d->in) * (beyond / d->thickness) : d->out;
}

// ---- Box --------------------------------------------------------------------------------------------------------------

static bool build_box(SizeField *s, Node *n, Diag *diag)
{
  (void)s, (void)diag;
  Shape *d = new_shape(n);
  d->lo = option_vec3(n->field, "XMin", "YMin", "ZMin");
  d->hi = option_vec3(n->field, "XMax", "YMax", "ZMax");
  d->thickness = field__number(n->field, "Thickness");
  return true;
}

static void eval_box(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  (void)e, (void)w;
  const Shape *d = n->data;
  for (size_t i = 0; i < count; i++) {
    double dx = fmax(fmax(d->lo.x - p->x[i], p->x[i] - d->hi.x), 0);
    double dy = fmax(fmax(d->lo.y - p->y[i], p->y[i] - d->hi.y), 0);
    double dz = fmax(fmax(d->lo.z - p->z[i], p->z[i] - d->hi.z), 0);
    out[i] = in_layer(d, sqrt(dx * dx + dy * dy + dz * dz));
  }
}

const FieldOps ops_box = {build_box, eval_box, NULL, NULL};

// ---- Ball -------------------------------------------------------------------------------------------------------------

static bool build_ball(SizeField *s, Node *n, Diag *diag)
{
  (void)s, (void)diag;
  Shape *d = new_shape(n);
  d->centre = option_vec3(n->field, "XCenter", "YCenter", "ZCenter");
  d->radius = field__number(n->field, "Radius");
  d->thickness = field__number(n->field, "Thickness");
  return true;
}

static void eval_ball(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  (void)e, (void)w;
  const Shape *d = n->data;
  for (size_t i = 0; i < count; i++) {
    double r = vec3_distance((Vec3){p->x[i], p->y[i], p->z[i]}, d->centre);
    out[i] = r < d->radius ? d->in : in_layer(d, fmax(r - d->radius, 1e-300));
  }
}

const FieldOps ops_ball = {build_ball, eval_ball, NULL, NULL};

// ---- Cylinder -----------------------------------------------------------------------------------------------------------

static bool build_cylinder(SizeField *s, Node *n, Diag *diag)
{
  (void)s;
  Shape *d = new_shape(n);
  d->centre = option_vec3(n->field, "XCenter", "YCenter", "ZCenter");
  d->axis = option_vec3(n->field, "XAxis", "YAxis", "ZAxis");
  d->radius = field__number(n->field, "Radius");
  d->axis2 = vec3_dot(d->axis, d->axis);
  if (d->axis2 > 0) return true;
  diag_error(diag, field__value(n->field, "ZAxis")->loc, "field %d (Cylinder): the axis has no length", n->field->id);
  return false;
}

static void eval_cylinder(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  (void)e, (void)w;
  const Shape *d = n->data;
  for (size_t i = 0; i < count; i++) {
    Vec3 v = vec3_sub((Vec3){p->x[i], p->y[i], p->z[i]}, d->centre);
    double along = vec3_dot(v, d->axis) / d->axis2;
    double r2 = vec3_dot(v, v) - along * along * d->axis2;
    out[i] = fabs(along) < 1 && r2 < d->radius * d->radius ? d->in : d->out;
  }
}

const FieldOps ops_cylinder = {build_cylinder, eval_cylinder, NULL, NULL};

// ---- Frustum ------------------------------------------------------------------------------------------------------------

typedef struct {
  Vec3 from, axis;
  double axis2;
  double inner_r[2], outer_r[2], inner_v[2], outer_v[2];
} Frustum;

static bool build_frustum(SizeField *s, Node *n, Diag *diag)
{
  (void)s;
  const Field *f = n->field;
  Frustum *d = n->data = mem_zalloc(sizeof *d);
  d->from = option_vec3(f, "X1", "Y1", "Z1");
  d->axis = vec3_sub(option_vec3(f, "X2", "Y2", "Z2"), d->from);
  d->axis2 = vec3_dot(d->axis, d->axis);
  d->inner_r[0] = field__number(f, "InnerR1"), d->inner_r[1] = field__number(f, "InnerR2");
  d->outer_r[0] = field__number(f, "OuterR1"), d->outer_r[1] = field__number(f, "OuterR2");
  d->inner_v[0] = field__number(f, "InnerV1"), d->inner_v[1] = field__number(f, "InnerV2");
  d->outer_v[0] = field__number(f, "OuterV1"), d->outer_v[1] = field__number(f, "OuterV2");
  if (d->axis2 > 0) return true;
  diag_error(diag, f->loc, "field %d (Frustum): both ends of the axis are the same place", f->id);
  return false;
}

static double between(const double end[2], double t)
{
  return end[0] + (end[1] - end[0]) * t;
}

static void eval_frustum(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  (void)e, (void)w;
  const Frustum *d = n->data;
  for (size_t i = 0; i < count; i++) {
    Vec3 v = vec3_sub((Vec3){p->x[i], p->y[i], p->z[i]}, d->from);
    double t = vec3_dot(v, d->axis) / d->axis2;
    double r = sqrt(fmax(vec3_dot(v, v) - t * t * d->axis2, 0));
    double inner = between(d->inner_r, t), outer = between(d->outer_r, t);
    out[i] = NO_SIZE;
    if (t < 0 || t > 1 || r < inner || r > outer) continue;
    double a = between(d->inner_v, t), b = between(d->outer_v, t);
    out[i] = outer > inner ? a + (b - a) * (r - inner) / (outer - inner) : a;
  }
}

const FieldOps ops_frustum = {build_frustum, eval_frustum, NULL, NULL};
