// field_combine.c - fields made of other fields: Threshold, Min, Max, Restrict, Constant, Octree
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "size/size_int.h"

// ---- Threshold ----------------------------------------------------------------------------------------------------------

typedef struct {
  double near, far, small, large; // DistMin, DistMax, SizeMin, SizeMax
  bool sigmoid, stop;
} Threshold;

static bool build_threshold(SizeField *s, Node *n, Diag *diag)
{
  const Field *f = n->field;
  Threshold *d = n->data = mem_zalloc(sizeof *d);
  d->near = field__number(f, "DistMin");
  d->far = field__number(f, "DistMax");
  d->small = field__number(f, "SizeMin");
  d->large = field__number(f, "SizeMax");
  d->sigmoid = field__number(f, "Sigmoid") != 0;
  d->stop = field__number(f, "StopAtDistMax") != 0;
  const FieldValue *in = field__value(f, "InField");
  if (d->near > d->far) {
    diag_error(diag, field__value(f, "DistMin")->loc, "field %d (Threshold): DistMin (%g) is larger than DistMax (%g)",
               f->id, d->near, d->far);
    return false;
  }
  if (!size__refer(s, n, (int)in->number, in->loc, diag)) return false;
  Node *from = &s->node[n->in[0]];
  from->thresholds++;
  from->far = from->thresholds > 1 ? fmax(from->far, d->far) : d->far;
  return true;
}

static void eval_threshold(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  const Threshold *d = n->data;
  size__eval(e, n->in[0], w, p, count, out);
  double width = d->far - d->near;
  for (size_t i = 0; i < count; i++) {
    double r = (out[i] - d->near) / width;
    if (out[i] >= d->far) {
      out[i] = d->stop ? NO_SIZE : d->large;
    } else if (out[i] <= d->near) {
      out[i] = d->small;
    } else if (d->sigmoid) {
      double s = exp(12 * r - 6);
      s = s / (1 + s);
      out[i] = d->small * (1 - s) + d->large * s;
    } else {
      out[i] = d->small * (1 - r) + d->large * r; // nan of the inner field goes through
    }
  }
}

const FieldOps ops_threshold = {build_threshold, eval_threshold, NULL, NULL};

// ---- Min, Max -------------------------------------------------------------------------------------------------------------

static bool build_list(SizeField *s, Node *n, Diag *diag)
{
  const FieldValue *v = field__value(n->field, "FieldsList");
  for (size_t i = 0; i < v->nlist; i++) {
    if ((int)v->list[i] == n->field->id) continue; // Gmsh skips a mention of itself
    if (!field_exists(s->fields, (int)v->list[i])) {
      diag_warning(diag, v->loc, "field %d (%s): there is no field %g; it is left out", n->field->id,
                   field__type(n->field->kind)->name, v->list[i]);
      continue;
    }
    if (!size__refer(s, n, (int)v->list[i], v->loc, diag)) return false;
  }
  if (n->nin) return true;
  diag_warning(diag, n->field->loc, "field %d (%s) has no other fields in its FieldsList: it gives no size", n->field->id,
               field__type(n->field->kind)->name);
  return true;
}

static void eval_extreme(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out, bool least)
{
  for (size_t i = 0; i < count; i++) out[i] = NO_SIZE;
  double v[BATCH];
  for (uint32_t k = 0; k < n->nin; k++) {
    size__eval(e, n->in[k], w, p, count, v);
    for (size_t i = 0; i < count; i++)
      if (k == 0 || v[i] != v[i] || (least ? v[i] < out[i] : v[i] > out[i])) out[i] = v[i];
  }
}

static void eval_min(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  eval_extreme(e, n, w, p, count, out, true);
}

static void eval_max(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  eval_extreme(e, n, w, p, count, out, false);
}

static bool extreme_constant(const SizeField *s, const Node *n, Where w, double *value, bool least)
{
  *value = NO_SIZE;
  for (uint32_t k = 0; k < n->nin; k++) {
    const Node *c = &s->node[n->in[k]];
    double v;
    if (!c->ops->constant || !c->ops->constant(s, c, w, &v)) return false;
    if (k == 0 || (least ? v < *value : v > *value)) *value = v;
  }
  return true;
}

static bool constant_min(const SizeField *s, const Node *n, Where w, double *value)
{
  return extreme_constant(s, n, w, value, true);
}

static bool constant_max(const SizeField *s, const Node *n, Where w, double *value)
{
  return extreme_constant(s, n, w, value, false);
}

const FieldOps ops_min = {build_list, eval_min, NULL, constant_min};
const FieldOps ops_max = {build_list, eval_max, NULL, constant_max};

// ---- Restrict, Constant: on which entities --------------------------------------------------------------------------------

typedef struct {
  Map on;          // (dim << 32 | tag) of the entities, present ones are in
  double in, out;  // Constant
} Entities;

static void add_entity(Entities *d, int dim, int tag)
{
  map_set(&d->on, (uint64_t)dim << 32 | (uint32_t)(tag < 0 ? -tag : tag), 1);
}

static bool has_entity(const Entities *d, Where w)
{
  return w.dim >= 0 && map_get(&d->on, (uint64_t)w.dim << 32 | (uint32_t)w.tag) != NONE;
}

static void add_curve(Entities *d, const Model *m, int tag, bool boundary)
{
  const Curve *c = model_curve(m, tag);
  if (!c) return;
  add_entity(d, 1, c->joined ? c->joined : tag); // part of a compound: what is meshed is the whole
  if (!boundary) return;
  add_entity(d, 0, c->begin);
  add_entity(d, 0, c->end);
}

static void add_face(Entities *d, const Model *m, int tag, bool boundary, bool embedded)
{
  const Face *f = model_face(m, tag);
  if (!f) return;
  add_entity(d, 2, tag);
  for (int i = 0; boundary && i < f->nloop; i++) {
    const Loop *loop = model_loop(m, f->loop[i]);
    for (int k = 0; loop && k < loop->ncurve; k++) add_curve(d, m, loop->curve[k], true);
  }
  if (!embedded) return;
  for (size_t i = 0; i < f->embedded_points.len; i++) add_entity(d, 0, f->embedded_points.data[i]);
  for (size_t i = 0; i < f->embedded_curves.len; i++) add_curve(d, m, f->embedded_curves.data[i], true);
}

static void take_entities(const SizeField *s, Entities *d, const Field *f)
{
  bool boundary = field__number(f, "IncludeBoundary") != 0, embedded = field__number(f, "IncludeEmbedded") != 0;
  const FieldValue *v = field__value(f, "PointsList");
  for (size_t i = 0; i < v->nlist; i++) add_entity(d, 0, (int)v->list[i]);
  v = field__value(f, "CurvesList");
  for (size_t i = 0; i < v->nlist; i++) add_curve(d, s->model, (int)v->list[i], boundary);
  v = field__value(f, "SurfacesList");
  for (size_t i = 0; i < v->nlist; i++) add_face(d, s->model, (int)v->list[i], boundary, embedded);
}

static bool build_restrict(SizeField *s, Node *n, Diag *diag)
{
  Entities *d = n->data = mem_zalloc(sizeof *d);
  take_entities(s, d, n->field);
  const FieldValue *in = field__value(n->field, "InField");
  return size__refer(s, n, (int)in->number, in->loc, diag);
}

static void eval_restrict(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  if (has_entity(n->data, w)) {
    size__eval(e, n->in[0], w, p, count, out);
    return;
  }
  for (size_t i = 0; i < count; i++) out[i] = NO_SIZE;
}

static bool constant_restrict(const SizeField *s, const Node *n, Where w, double *value)
{
  const Node *in = &s->node[n->in[0]];
  if (has_entity(n->data, w)) return in->ops->constant && in->ops->constant(s, in, w, value);
  *value = NO_SIZE;
  return true;
}

static bool build_constant(SizeField *s, Node *n, Diag *diag)
{
  (void)diag;
  Entities *d = n->data = mem_zalloc(sizeof *d);
  take_entities(s, d, n->field);
  d->in = field__number(n->field, "VIn");
  d->out = field__number(n->field, "VOut");
  return true;
}

static void eval_constant(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  (void)e, (void)p;
  const Entities *d = n->data;
  double v = has_entity(d, w) ? d->in : d->out;
  for (size_t i = 0; i < count; i++) out[i] = v;
}

static bool constant_constant(const SizeField *s, const Node *n, Where w, double *value)
{
  (void)s;
  const Entities *d = n->data;
  *value = has_entity(d, w) ? d->in : d->out;
  return true;
}

static void release_entities(Node *n)
{
  Entities *d = n->data;
  if (d) map_free(&d->on);
}

const FieldOps ops_restrict = {build_restrict, eval_restrict, release_entities, constant_restrict};
const FieldOps ops_constant = {build_constant, eval_constant, release_entities, constant_constant};

// ---- Octree: the field itself -----------------------------------------------------------------------------------------------

static bool build_same(SizeField *s, Node *n, Diag *diag)
{
  const FieldValue *in = field__value(n->field, "InField");
  return size__refer(s, n, (int)in->number, in->loc, diag);
}

static void eval_same(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  size__eval(e, n->in[0], w, p, count, out);
}

static bool constant_same(const SizeField *s, const Node *n, Where w, double *value)
{
  const Node *in = &s->node[n->in[0]];
  return in->ops->constant && in->ops->constant(s, in, w, value);
}

const FieldOps ops_same = {build_same, eval_same, NULL, constant_same};
