// filling.c - the surface that fills three or four curves (Surface, Ruled Surface): transfinite interpolation of them
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/filling.h"

bool filling_init(Filling *s, const Model *m, const Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  *s = (Filling){.model = m, .n = (int)curve.len};
  bool good = start.len == 2 && (curve.len == 3 || curve.len == 4);
  for (size_t k = 0; k < curve.len && good; k++) {
    const Curve *c = s->curve[k] = model_curve(m, curve.data[k]);
    s->reversed[k] = curve.data[k] < 0;
    const Point *p = c ? model_point(m, s->reversed[k] ? c->end : c->begin) : NULL;
    good = p != NULL;
    if (good) s->corner[k] = p->xyz;
  }
  vec_free(&curve);
  vec_free(&start);
  return good;
}

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

Vec3 filling_point(const Filling *s, double u, double v)
{
  u = fmin(fmax(u, 0), 1);
  v = fmin(fmax(v, 0), s->n == 3 ? u : 1);
  if (s->n == 3) return triangle_point(s, u, v);
  const Vec3 *c = s->corner;
  Vec3 sum = vec3_add(vec3_scale(1 - u, side(s, 3, 1 - v)), vec3_scale(u, side(s, 1, v)));
  sum = vec3_add(sum, vec3_add(vec3_scale(1 - v, side(s, 0, u)), vec3_scale(v, side(s, 2, 1 - u))));
  Vec3 flat = vec3_add(vec3_scale((1 - u) * (1 - v), c[0]), vec3_scale(u * (1 - v), c[1]));
  flat = vec3_add(flat, vec3_add(vec3_scale(u * v, c[2]), vec3_scale((1 - u) * v, c[3])));
  return vec3_sub(sum, flat);
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
