// filling.c - the surface that fills three or four curves (Surface, Ruled Surface): transfinite interpolation of them
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/filling.h"

// Arcs about one centre with one radius, of a face that is not plane?
static void find_sphere(Filling *s, const Face *f)
{
  s->sphere = !f->planar;
  for (int k = 0; k < s->n && s->sphere; k++) {
    const Curve *c = s->curve[k];
    const Point *centre = c->type == CURVE_CIRCLE && c->npoint == 3 ? model_point(s->model, c->point[1]) : NULL;
    s->sphere = centre != NULL;
    if (!centre) break;
    double r = vec3_distance(centre->xyz, s->corner[k]);
    if (k == 0) {
      s->centre = centre->xyz;
      s->radius = r;
    }
    s->sphere = vec3_distance(centre->xyz, s->centre) <= 1e-6 * r && fabs(r - s->radius) <= 1e-6 * r;
  }
}

// ---- surfaces of revolution ------------------------------------------------------------------------------------------------
static Vec3 side(const Filling *s, int k, double t);

static Vec3 turn_about(const Filling *s, Vec3 p, double angle)
{
  Vec3 d = vec3_sub(p, s->centre);
  double c = cos(angle), n = sin(angle), h = vec3_dot(d, s->axis) * (1 - c);
  Vec3 q = vec3_add(vec3_scale(c, d), vec3_scale(n, vec3_cross(s->axis, d)));
  return vec3_add(s->centre, vec3_add(q, vec3_scale(h, s->axis)));
}

// Where a place of the parameters comes from: how far along the curve that is turned, and which share of the angle.
static Vec2 turned_from(const Filling *s, double u, double v)
{
  if (s->n == 4) return (Vec2){u, v};
  double along = s->apex == 0 ? u : u - v, rim = s->apex == 0 ? u : 1 - u + v;
  return (Vec2){along, rim > 0 ? fmin(v / rim, 1) : 0};
}

// A face that Extrude has swept round an axis: read the axis off an arc that a point has drawn, and believe it if it takes the first curve
// to the one at the far end.
static void find_revolution(Filling *s, const Face *f)
{
  if (f->planar || !f->extruded_curve || s->curve[0]->tag != abs(f->extruded_curve)) return;
  bool at_end = f->extruded_side[1] != 0;
  int k = at_end ? 1 : s->n - 1, top = at_end ? 2 : 1;
  const Curve *c = s->curve[k];
  const Point *centre = c->type == CURVE_CIRCLE && c->npoint == 3 ? model_point(s->model, c->point[1]) : NULL;
  if (!centre) return;
  bool with = s->reversed[k] != at_end; // the arc's own sense is that of the motion
  Vec3 a = curve_point(s->model, c, with ? 0 : 1), along = vec3_scale(with ? 1 : -1, curve_deriv(s->model, c, with ? 0 : 1));
  s->centre = centre->xyz;
  s->axis = vec3_cross(vec3_sub(a, s->centre), along);
  s->axis = vec3_scale(1 / vec3_length(s->axis), s->axis);
  s->angle = curve_angle(s->model, c);
  s->apex = at_end ? 0 : 1;
  s->turned = true;
  double tolerance = 1e-6 * (curve_length(s->model, c) + curve_length(s->model, s->curve[0]));
  for (int i = 0; i <= 4; i++) {
    double t = i / 4.0;
    s->turned = s->turned && vec3_distance(turn_about(s, side(s, 0, t), s->angle), side(s, top, 1 - t)) <= tolerance;
  }
}

// A rectangle of the mean lengths of opposite curves, or the triangle of the three lengths (of sides 1 if they make none).
static void set_flat(Filling *s)
{
  double l[4];
  for (int k = 0; k < s->n; k++) l[k] = curve_length(s->model, s->curve[k]);
  if (s->n == 4) {
    double w = 0.5 * (l[0] + l[2]), h = 0.5 * (l[1] + l[3]);
    s->flat[1] = (Vec2){w, 0};
    s->flat[2] = (Vec2){w, h};
    s->flat[3] = (Vec2){0, h};
    return;
  }
  double x = (l[0] * l[0] + l[2] * l[2] - l[1] * l[1]) / (2 * l[0]), y2 = l[2] * l[2] - x * x;
  if (!(y2 > 1e-4 * l[2] * l[2])) {
    x = 0.5 * l[0];
    y2 = 0.75 * l[0] * l[0];
  }
  s->flat[1] = (Vec2){l[0], 0};
  s->flat[2] = (Vec2){x, sqrt(y2)};
}

bool filling_init(Filling *s, const Model *m, const Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  *s = (Filling){.model = m, .n = (int)curve.len};
  bool good = f->type == FACE_FILLING && start.len == 2 && (curve.len == 3 || curve.len == 4);
  for (size_t k = 0; k < curve.len && good; k++) {
    const Curve *c = s->curve[k] = model_curve(m, curve.data[k]);
    s->reversed[k] = curve.data[k] < 0;
    const Point *p = c ? model_point(m, s->reversed[k] ? c->end : c->begin) : NULL;
    good = p != NULL;
    if (good) s->corner[k] = p->xyz;
  }
  vec_free(&curve);
  vec_free(&start);
  if (!good) return false;
  find_revolution(s, f);
  if (!s->turned) find_sphere(s, f);
  set_flat(s);
  return true;
}

// ---- places ----------------------------------------------------------------------------------------------------------------
// Point of the k-th side at t in the sense of the loop.
static Vec3 side(const Filling *s, int k, double t)
{
  return curve_point(s->model, s->curve[k], s->reversed[k] ? 1 - t : t);
}

static Vec3 triangle_point(const Filling *s, double u, double v)
{
  const Vec3 *c = s->corner;
  Vec3 a = vec3_sub(vec3_add(side(s, 0, u - v), side(s, 2, 1 - v)), c[0]);
  Vec3 b = vec3_sub(vec3_add(side(s, 1, v), side(s, 0, u)), c[1]);
  Vec3 d = vec3_sub(vec3_add(side(s, 2, 1 - u), side(s, 1, 1 - u + v)), c[2]);
  return vec3_add(vec3_scale(1 - u, a), vec3_add(vec3_scale(u - v, b), vec3_scale(v, d)));
}

static Vec3 quad_point(const Filling *s, double u, double v)
{
  const Vec3 *c = s->corner;
  Vec3 sum = vec3_add(vec3_scale(1 - u, side(s, 3, 1 - v)), vec3_scale(u, side(s, 1, v)));
  sum = vec3_add(sum, vec3_add(vec3_scale(1 - v, side(s, 0, u)), vec3_scale(v, side(s, 2, 1 - u))));
  Vec3 flat = vec3_add(vec3_scale((1 - u) * (1 - v), c[0]), vec3_scale(u * (1 - v), c[1]));
  flat = vec3_add(flat, vec3_add(vec3_scale(u * v, c[2]), vec3_scale((1 - u) * v, c[3])));
  return vec3_sub(sum, flat);
}

Vec3 filling_point(const Filling *s, double u, double v)
{
  u = fmin(fmax(u, 0), 1);
  v = fmin(fmax(v, 0), s->n == 3 ? u : 1);
  if (s->turned) {
    Vec2 from = turned_from(s, u, v);
    return turn_about(s, side(s, 0, from.x), from.y * s->angle);
  }
  Vec3 p = s->n == 3 ? triangle_point(s, u, v) : quad_point(s, u, v);
  if (!s->sphere) return p;
  Vec3 d = vec3_sub(p, s->centre);
  double l = vec3_length(d);
  return l > 0 ? vec3_add(s->centre, vec3_scale(s->radius / l, d)) : p;
}

Vec2 filling_to_plane(const Filling *s, Vec2 uv)
{
  if (s->n == 4) return (Vec2){uv.x * s->flat[2].x, uv.y * s->flat[2].y};
  return vec2_add(vec2_scale(uv.x - uv.y, s->flat[1]), vec2_scale(uv.y, s->flat[2]));
}

Vec2 filling_from_plane(const Filling *s, Vec2 q)
{
  if (s->n == 4) return (Vec2){q.x / s->flat[2].x, q.y / s->flat[2].y};
  double v = q.y / s->flat[2].y;
  return (Vec2){(q.x - v * s->flat[2].x) / s->flat[1].x + v, v};
}

double filling_stretch(const Filling *s, Vec2 q)
{
  double w = s->flat[1].x, h = s->flat[2].y, e = 1e-3;
  Vec2 c = s->n == 3 ? (Vec2){(s->flat[1].x + s->flat[2].x) / 3, h / 3} : (Vec2){w / 2, h / 2};
  q = vec2_add(q, vec2_scale(4 * e, vec2_sub(c, q))); // so that the differences stay inside
  Vec3 at[4];
  const Vec2 step[4] = {{e * w, 0}, {-e * w, 0}, {0, e * h}, {0, -e * h}};
  for (int k = 0; k < 4; k++) {
    Vec2 uv = filling_from_plane(s, vec2_add(q, step[k]));
    at[k] = filling_point(s, uv.x, uv.y);
  }
  double area = vec3_length(vec3_cross(vec3_sub(at[0], at[1]), vec3_sub(at[2], at[3]))) / (4 * e * w * e * h);
  return fmin(fmax(sqrt(area), 0.1), 10);
}

Vec2 filling_side(const Filling *s, int k, double t)
{
  switch (k) {
  case 0: return (Vec2){t, 0};
  case 1: return (Vec2){1, t};
  case 2: return (Vec2){1 - t, s->n == 3 ? 1 - t : 1};
  default: return (Vec2){0, 1 - t};
  }
}
