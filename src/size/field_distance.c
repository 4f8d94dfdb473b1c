// field_distance.c - fields of the distance to points and curves: Distance, Extend, BoundaryLayer, AttractorAnisoCurve
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "size/size_int.h"

typedef struct {
  Nearest *tree;
  Map faces;               // tags: inside them the distance is 0; Extend: only in these
  bool in_faces;
  double size, ratio, thickness, far; // BoundaryLayer
  double dist[2], lc[2];   // AttractorAnisoCurve
  double power;            // Extend
} Distance;

static void unknown_entity(const Node *n, const char *kind, double tag, SrcLoc loc, Diag *diag)
{
  diag_warning(diag, loc, "field %d (%s) names %s %g, which does not exist", n->field->id, field__type(n->field->kind)->name,
               kind, tag);
}

// Gmsh's samples: at equal parameters, the ends left out.
static void add_samples(Distance *d, const Model *m, uint32_t k, int sampling)
{
  const Curve *c = model_curve_at(m, k);
  for (int i = 1; i < sampling - 1; i++) {
    double u = (double)i / (sampling - 1);
    Vec3 p = curve_point(m, c, u);
    nearest_add(d->tree, p, p, 0, k, u, u);
  }
}

static void add_curves(SizeField *s, Node *n, Distance *d, int sampling, Diag *diag)
{
  const FieldValue *v = field__value(n->field, "CurvesList");
  for (size_t i = 0; i < v->nlist; i++) {
    uint32_t k = size__curve_index(s->model, (int)v->list[i]);
    if (k == NONE) unknown_entity(n, "curve", v->list[i], v->loc, diag);
    else if (sampling > 2) add_samples(d, s->model, k, sampling);
    else size__add_curve(d->tree, s->model, k);
  }
}

static void add_points(SizeField *s, Node *n, Distance *d, Diag *diag)
{
  const FieldValue *v = field__value(n->field, "PointsList");
  for (size_t i = 0; i < v->nlist; i++) {
    const Point *p = model_point(s->model, (int)v->list[i]);
    if (!p) unknown_entity(n, "point", v->list[i], v->loc, diag);
    else nearest_add(d->tree, p->xyz, p->xyz, 0, NONE - 1, 0, 0);
  }
}

static void add_faces(SizeField *s, Node *n, Distance *d, bool boundaries, Diag *diag)
{
  const FieldValue *v = field__value(n->field, "SurfacesList");
  for (size_t i = 0; i < v->nlist; i++) {
    const Face *f = model_face(s->model, (int)v->list[i]);
    if (!f) {
      unknown_entity(n, "surface", v->list[i], v->loc, diag);
      continue;
    }
    d->in_faces = true;
    map_set(&d->faces, (uint64_t)f->tag, 1);
    for (int k = 0; boundaries && k < f->nloop; k++) {
      const Loop *loop = model_loop(s->model, f->loop[k]);
      for (int j = 0; loop && j < loop->ncurve; j++) {
        uint32_t c = size__curve_index(s->model, loop->curve[j]);
        if (c != NONE) size__add_curve(d->tree, s->model, c);
      }
    }
  }
}

static Distance *new_distance(SizeField *s, Node *n)
{
  Distance *d = n->data = mem_zalloc(sizeof *d);
  d->tree = size__pieces_new(s->model);
  return d;
}

static void finish(Node *n, Distance *d, Diag *diag)
{
  nearest_build(d->tree);
  if (!nearest_count(d->tree))
    diag_warning(diag, n->field->loc, "field %d (%s) has no points and no curves: it gives no size", n->field->id,
                 field__type(n->field->kind)->name);
}

static void release_distance(Node *n)
{
  Distance *d = n->data;
  if (!d) return;
  nearest_free(d->tree);
  map_free(&d->faces);
}

// Distances to the tree, from the place found last.
static void distances(SizeEval *e, const Node *n, const Places *p, size_t count, double limit, double *out)
{
  const Distance *d = n->data;
  uint32_t *hint = &e->hint[n - e->s->node];
  for (size_t i = 0; i < count; i++) {
    NearestHit hit = nearest_query(d->tree, (Vec3){p->x[i], p->y[i], p->z[i]}, limit, *hint);
    *hint = hit.leaf;
    out[i] = fmin(hit.distance, NO_SIZE);
  }
}

// ---- Distance -----------------------------------------------------------------------------------------------------------

static bool build_distance(SizeField *s, Node *n, Diag *diag)
{
  Distance *d = new_distance(s, n);
  const FieldValue *sampling = field__value(n->field, "Sampling");
  add_points(s, n, d, diag);
  add_curves(s, n, d, sampling->given ? (int)sampling->number : 0, diag);
  add_faces(s, n, d, true, diag);
  finish(n, d, diag);
  return true;
}

static void eval_distance(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  const Distance *d = n->data;
  if (d->in_faces && w.dim == 2 && map_get(&d->faces, (uint64_t)w.tag) != NONE) {
    for (size_t i = 0; i < count; i++) out[i] = 0;
    return;
  }
  // Where only Thresholds look, nothing beyond the largest DistMax needs to be known.
  bool limited = n->thresholds && n->thresholds == n->users;
  distances(e, n, p, count, limited ? n->far : INFINITY, out);
}

const FieldOps ops_distance = {build_distance, eval_distance, release_distance, NULL};

// ---- Extend -------------------------------------------------------------------------------------------------------------

static bool build_extend(SizeField *s, Node *n, Diag *diag)
{
  Distance *d = new_distance(s, n);
  add_curves(s, n, d, 0, diag);
  add_faces(s, n, d, false, diag);
  d->thickness = field__number(n->field, "DistMax");
  d->far = field__number(n->field, "SizeMax");
  d->power = field__number(n->field, "Power");
  finish(n, d, diag);
  return true;
}

static void eval_extend(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  const Distance *d = n->data;
  const SizeField *s = e->s;
  uint32_t *hint = &e->hint[n - s->node];
  bool here = w.dim == 2 && (!d->in_faces || map_get(&d->faces, (uint64_t)w.tag) != NONE);
  for (size_t i = 0; i < count; i++) {
    out[i] = NO_SIZE;
    if (!here) continue;
    NearestHit hit = nearest_query(d->tree, (Vec3){p->x[i], p->y[i], p->z[i]}, INFINITY, *hint);
    *hint = hit.leaf;
    if (hit.curve == NONE) continue;
    double f = pow(fmin(fmax(1 - hit.distance / d->thickness, 0), 1), d->power);
    double on_curve = size__of_curve(s, model_curve_at(s->model, hit.curve), hit.u);
    out[i] = f * on_curve + (1 - f) * d->far;
  }
}

const FieldOps ops_extend = {build_extend, eval_extend, release_distance, NULL};

// ---- BoundaryLayer as a size ------------------------------------------------------------------------------------------------

static bool build_layer(SizeField *s, Node *n, Diag *diag)
{
  Distance *d = new_distance(s, n);
  add_curves(s, n, d, 0, diag);
  d->size = field__number(n->field, "Size");
  d->ratio = field__number(n->field, "Ratio");
  d->thickness = field__number(n->field, "Thickness");
  d->far = field__number(n->field, "SizeFar");
  finish(n, d, diag);
  return true;
}

static void eval_layer(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  (void)w;
  const Distance *d = n->data;
  double reach = d->thickness * d->ratio;
  distances(e, n, p, count, reach * (1 + 1e-12), out);
  for (size_t i = 0; i < count; i++)
    out[i] = out[i] > reach ? NO_SIZE : fmin(d->far, d->size + (d->ratio - 1) * out[i]);
}

const FieldOps ops_layer = {build_layer, eval_layer, release_distance, NULL};

// ---- AttractorAnisoCurve: the size across ---------------------------------------------------------------------------------------

static bool build_attractor_aniso(SizeField *s, Node *n, Diag *diag)
{
  Distance *d = new_distance(s, n);
  const FieldValue *sampling = field__value(n->field, "Sampling");
  add_curves(s, n, d, sampling->given ? (int)sampling->number : 0, diag);
  d->dist[0] = field__number(n->field, "DistMin"), d->dist[1] = field__number(n->field, "DistMax");
  d->lc[0] = field__number(n->field, "SizeMinNormal"), d->lc[1] = field__number(n->field, "SizeMaxNormal");
  finish(n, d, diag);
  return true;
}

static void eval_attractor_aniso(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  (void)w;
  const Distance *d = n->data;
  distances(e, n, p, count, INFINITY, out);
  for (size_t i = 0; i < count; i++) {
    double r = fmin(fmax((out[i] - d->dist[0]) / (d->dist[1] - d->dist[0]), 0), 1);
    out[i] = d->lc[0] + (d->lc[1] - d->lc[0]) * r;
  }
}

const FieldOps ops_attractor_aniso = {build_attractor_aniso, eval_attractor_aniso, release_distance, NULL};
