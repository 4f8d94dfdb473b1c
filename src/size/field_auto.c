// field_auto.c - AutomaticMeshSizeField: sizes from the curvature of curves and the width of narrow parts, of limited growth
// SPDX-License-Identifier: MIT
//
// Curves are sampled until neighbouring samples are not farther apart than the size found there. At each sample the size is the
// least of the bulk size, the one by curvature, and for every face beside it the distance straight across (a ray along the inner
// normal to the next curve) over the wanted number of elements. Between samples sizes grow with the distance: exactly the lower
// envelope of cones on them, so no background grid is needed. Corners do not count as narrow: a ray that ends on a curve
// which shares a point with its own is left out.
#include "base/base.h"

#include <math.h>

#include "geom/cones.h"
#include "size/size_int.h"

typedef struct {
  Cones *cones;
  double bulk;
} Automatic;

typedef struct {
  const SizeField *s;
  Nearest *tree;
  double per_circle, per_gap, bulk, lo, hi;
  bool features;
  Vec(Vec3) p;
  DoubleVec h;
  // the curve and face at hand
  const Face *face;
  const Curve *c;
  double sense; // +1: the face is on the left of the curve
} Sampler;

static bool share_a_point(const Curve *a, const Curve *b)
{
  return a != b && (a->begin == b->begin || a->begin == b->end || a->end == b->begin || a->end == b->end);
}

static double size_at_sample(const Sampler *a, double u, Vec3 p)
{
  const Model *m = a->s->model;
  double h = fmin(a->bulk, a->hi), k = curve_curvature(m, a->c, u);
  if (k > 0 && a->per_circle > 0) h = fmin(h, 2 * M_PI / (k * a->per_circle));
  if (a->features && a->per_gap > 0) {
    Vec3 d = curve_deriv(m, a->c, u);
    double len = vec3_length(d);
    if (len > 0) {
      Vec3 side = vec3_scale(1 / len, d), in = vec3_scale(a->sense, vec3_cross(a->face->normal, side));
      NearestHit hit = nearest_ray(a->tree, p, in, side, 1e-9 * a->s->diagonal, h * a->per_gap);
      if (hit.curve != NONE && !share_a_point(a->c, model_curve_at(m, hit.curve))) h = fmin(h, hit.distance / a->per_gap);
    }
  }
  return fmax(h, a->lo);
}

typedef struct {
  double u, h;
  Vec3 p;
} Sample;

static Sample take_sample(Sampler *a, double u)
{
  Sample s = {u, 0, curve_point(a->s->model, a->c, u)};
  // Just inside the ends: at a corner the normal is not the curve's alone.
  double v = fmin(fmax(u, 1e-6), 1 - 1e-6);
  s.h = size_at_sample(a, v, curve_point(a->s->model, a->c, v));
  vec_push(&a->p, s.p);
  vec_push(&a->h, s.h);
  return s;
}

static void refine(Sampler *a, Sample l, Sample r, int depth)
{
  if (depth >= 14 || (depth >= 3 && vec3_distance(l.p, r.p) <= fmin(l.h, r.h))) return;
  Sample m = take_sample(a, (l.u + r.u) / 2);
  refine(a, l, m, depth + 1);
  refine(a, m, r, depth + 1);
}

static void sample_face(Sampler *a, const Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(a->s->model, f, &curve, &start);
  a->face = f;
  for (size_t i = 0; i < curve.len; i++) {
    a->c = model_curve(a->s->model, curve.data[i]);
    if (!a->c || a->c->degenerate) continue;
    a->sense = curve.data[i] >= 0 ? 1 : -1;
    refine(a, take_sample(a, 0), take_sample(a, 1), 0);
  }
  vec_free(&curve);
  vec_free(&start);
}

static bool build_automatic(SizeField *s, Node *n, Diag *diag)
{
  (void)diag;
  Automatic *d = n->data = mem_zalloc(sizeof *d);
  const Field *f = n->field;
  Sampler a = {.s = s, .per_circle = field__number(f, "nPointsPerCircle"), .per_gap = field__number(f, "nPointsPerGap")};
  a.bulk = field__number(f, "hBulk");
  a.lo = field__number(f, "hMin");
  a.hi = field__number(f, "hMax");
  a.features = field__number(f, "features") != 0;
  if (!(a.bulk > 0)) a.bulk = s->diagonal / 10;
  if (!(a.hi > 0)) a.hi = a.bulk;
  if (!(a.lo > 0)) a.lo = a.bulk / 1000;
  double growth = field__number(f, "gradation");
  a.tree = size__pieces_new(s->model);
  for (uint32_t k = 0; k < model_curves(s->model); k++) size__add_curve(a.tree, s->model, k);
  nearest_build(a.tree);
  for (size_t k = 0; k < model_faces(s->model); k++) sample_face(&a, model_face_at(s->model, k));
  bool smooth = field__number(f, "smoothing") != 0;
  d->bulk = fmin(a.bulk, a.hi);
  d->cones = cones_new(a.p.data, a.h.data, a.p.len, smooth ? fmax(growth - 1, 1e-3) : 1);
  nearest_free(a.tree);
  vec_free(&a.p);
  vec_free(&a.h);
  return true;
}

static void eval_automatic(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  (void)e, (void)w;
  const Automatic *d = n->data;
  for (size_t i = 0; i < count; i++) out[i] = cones_at(d->cones, (Vec3){p->x[i], p->y[i], p->z[i]}, d->bulk);
}

static void release_automatic(Node *n)
{
  Automatic *d = n->data;
  if (d) cones_free(d->cones);
}

const FieldOps ops_automatic = {build_automatic, eval_automatic, release_automatic, NULL};
