// sphere.c - curves drawn in the plane of a stereographic projection, as cubic pieces close to the sphere
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/curve_int.h"

int model_set_polar_sphere(Model *m, int tag, int centre, int pole, SrcLoc loc, Diag *diag)
{
  const Point *c = model_point(m, centre), *p = model_point(m, pole);
  if (!c || !p) {
    diag_error(diag, loc, "PolarSphere %d uses point %d, which does not exist", tag, c ? pole : centre);
    return -1;
  }
  double radius = vec3_distance(c->xyz, p->xyz);
  if (!(radius > 0)) {
    diag_error(diag, loc, "PolarSphere %d has no radius: points %d and %d coincide", tag, centre, pole);
    return -1;
  }
  PolarSphere s = {tag, centre, pole, c->xyz, radius};
  m->sphere = arena_dup(&m->arena, &s, sizeof s);
  return tag;
}

bool model_has_polar_sphere(const Model *m) { return m->sphere != NULL; }

const PolarSphere *sphere__of_points(const Model *m, const int *point, int n)
{
  const PolarSphere *s = n ? point__get(m, point[0])->sphere : NULL;
  for (int i = 1; s && i < n; i++)
    if (point__get(m, point[i])->sphere != s) return NULL;
  return s;
}

// ---- from the plane to the sphere ---------------------------------------------------------------------------------------

typedef struct {
  const PolarSphere *sphere;
  const CurveShape *plane; // control points have z = 0
  int piece;
  DoubleVec knot;
  Vec(Vec3) control;
} Lift;

// Position on the sphere and derivative by the parameter of the piece.
static Vec3 lifted(const Lift *l, double s, Vec3 *d)
{
  Vec3 t, p = bezier__at(shape__control(l->plane, l->piece), l->plane->degree, s, &t, NULL);
  double q = p.x * p.x + p.y * p.y, w = 1 + q, dq = 2 * (p.x * t.x + p.y * t.y), r = l->sphere->radius;
  *d = (Vec3){r * 2 * (p.x * dq / w - t.x) / w, r * 2 * (p.y * dq / w - t.y) / w, -r * 2 * dq / (w * w)};
  return polar_point(l->sphere, (Vec2){p.x, p.y});
}

// Cubics that have the curve's ends and derivatives there; halved until they are within 1e-11 radii of it.
static void lift(Lift *l, double a, double b, double u0, double u1, int depth)
{
  Vec3 da, db, pa = lifted(l, a, &da), pb = lifted(l, b, &db);
  Vec3 c[4] = {pa, vec3_add(pa, vec3_scale((b - a) / 3, da)), vec3_sub(pb, vec3_scale((b - a) / 3, db)), pb};
  double off = 0;
  for (int k = 1; k < 4; k++) {
    Vec3 ignored, x = lifted(l, a + 0.25 * k * (b - a), &ignored);
    off = fmax(off, vec3_distance(x, bezier__at(c, 3, 0.25 * k, NULL, NULL)));
  }
  if (off > 1e-11 * l->sphere->radius && depth > 0) {
    double mid = (a + b) / 2, u = (u0 + u1) / 2;
    lift(l, a, mid, u0, u, depth - 1);
    lift(l, mid, b, u, u1, depth - 1);
    return;
  }
  vec_push(&l->knot, u1);
  for (int k = 0; k < 4; k++) vec_push(&l->control, c[k]);
}

void sphere__lift(const PolarSphere *sphere, CurveShape *h)
{
  Lift l = {.sphere = sphere, .plane = h};
  vec_push(&l.knot, 0);
  for (l.piece = 0; l.piece < h->npiece; l.piece++) lift(&l, 0, 1, h->knot[l.piece], h->knot[l.piece + 1], 12);
  free(h->knot);
  free(h->control);
  h->degree = 3;
  h->npiece = (int)(l.knot.len - 1);
  h->uniform = false;
  h->knot = l.knot.data;
  h->control = l.control.data;
  h->knot[h->npiece] = 1;
}
