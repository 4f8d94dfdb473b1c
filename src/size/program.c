// program.c - fields compiled to nodes that refer to earlier nodes, and their evaluation in batches
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "size/size_int.h"

static const FieldOps *ops_of(FieldKind k)
{
  switch (k) {
  case FIELD_DISTANCE: return &ops_distance;
  case FIELD_THRESHOLD: return &ops_threshold;
  case FIELD_BOX: return &ops_box;
  case FIELD_BALL: return &ops_ball;
  case FIELD_CYLINDER: return &ops_cylinder;
  case FIELD_FRUSTUM: return &ops_frustum;
  case FIELD_MATHEVAL: return &ops_math;
  case FIELD_MATHEVAL_ANISO: return &ops_metric;
  case FIELD_PARAM: return &ops_param;
  case FIELD_MIN:
  case FIELD_MIN_ANISO:
  case FIELD_INTERSECT_ANISO: return &ops_min;
  case FIELD_MAX: return &ops_max;
  case FIELD_RESTRICT: return &ops_restrict;
  case FIELD_CONSTANT: return &ops_constant;
  case FIELD_MEAN: return &ops_mean;
  case FIELD_GRADIENT: return &ops_gradient;
  case FIELD_CURVATURE: return &ops_curvature;
  case FIELD_LAPLACIAN: return &ops_laplacian;
  case FIELD_MAX_EIGEN_HESSIAN: return &ops_hessian;
  case FIELD_LONLAT: return &ops_lonlat;
  case FIELD_STRUCTURED: return &ops_structured;
  case FIELD_POSTVIEW: return &ops_view;
  case FIELD_EXTEND: return &ops_extend;
  case FIELD_OCTREE: return &ops_same;
  case FIELD_AUTOMATIC: return &ops_automatic;
  case FIELD_ATTRACTOR_ANISO: return &ops_attractor_aniso;
  case FIELD_BOUNDARY_LAYER: return &ops_layer;
  case FIELD_KINDS: break;
  }
  UNREACHABLE();
}

// ---- compilation ------------------------------------------------------------------------------------------------------

// The fields being built, innermost first: meeting one again is a cycle.
struct OpenField {
  const Field *field;
  const OpenField *outer;
  int depth;
};

enum { MAX_DEPTH = 500 };

static void report_cycle(const OpenField *path, const Field *again, SrcLoc loc, Diag *diag)
{
  diag_error(diag, loc, "field %d refers to itself", again->id);
  for (const OpenField *o = path; o; o = o->outer) {
    if (o->field == again) break;
    diag_note(diag, o->field->loc, "by way of field %d (%s)", o->field->id, field__type(o->field->kind)->name);
  }
}

static void drop_node(Node *n)
{
  if (n->ops->release) n->ops->release(n);
  free(n->data);
  free(n->in);
}

// Build and append; NONE after an error.
static uint32_t finish_node(SizeField *s, Node *n, Diag *diag)
{
  if (!n->ops->build(s, n, diag)) return drop_node(n), NONE;
  size_t cap = s->cap_node;
  mem_grow(&s->node, &cap, (size_t)s->nnode + 1, sizeof *s->node);
  s->cap_node = (uint32_t)cap;
  s->node[s->nnode] = *n;
  return s->nnode++;
}

uint32_t size__compile(SizeField *s, int id, SrcLoc from, Diag *diag)
{
  const Field *f = field__find(s->fields, id);
  if (!f) return diag_error(diag, from, "there is no field %d", id), NONE;
  uint32_t done = map_get(&s->node_of, (uint64_t)id);
  if (done != NONE) return s->node[done].shared = true, done;
  for (const OpenField *o = s->open; o; o = o->outer)
    if (o->field == f) return report_cycle(s->open, f, from, diag), NONE;
  OpenField here = {f, s->open, s->open ? s->open->depth + 1 : 1};
  if (here.depth > MAX_DEPTH) {
    diag_error(diag, from, "fields refer to each other more than %d deep", MAX_DEPTH);
    return NONE;
  }
  s->open = &here;
  Node n = {.field = f, .ops = ops_of(f->kind)};
  uint32_t k = finish_node(s, &n, diag);
  s->open = here.outer;
  if (k != NONE) map_set(&s->node_of, (uint64_t)id, k);
  return k;
}

uint32_t size__compile_view(SizeField *s, int index, SrcLoc from, Diag *diag)
{
  if (index < 0 || (size_t)index >= s->fields->view.len) {
    diag_error(diag, from, "there is no View[%d] for the background mesh: %zu views are known", index, s->fields->view.len);
    return NONE;
  }
  Node n = {.ops = &ops_view};
  return finish_node(s, &n, diag);
}

bool size__refer(SizeField *s, Node *n, int id, SrcLoc loc, Diag *diag)
{
  uint32_t k = size__compile(s, id, loc, diag);
  if (k == NONE) return false;
  n->in = mem_realloc(n->in, (n->nin + 1) * sizeof *n->in);
  n->in[n->nin++] = k;
  s->node[k].users++;
  return true;
}

// ---- evaluation ---------------------------------------------------------------------------------------------------------

double *size__scratch(SizeEval *e, size_t n)
{
  if (e->used + n > e->cap) {
    // What was handed out before stays where it is until the evaluation that took it is over.
    if (e->stack) vec_push(&e->spare, e->stack);
    e->cap = MAX(2 * (e->cap + n), (size_t)64 * BATCH);
    e->stack = mem_alloc(e->cap * sizeof *e->stack);
    e->used = 0;
  }
  double *p = e->stack + e->used;
  e->used += n;
  return p;
}

void size__eval(SizeEval *e, uint32_t k, Where w, const Places *p, size_t count, double *out)
{
  const Node *n = &e->s->node[k];
  if (!n->shared) {
    n->ops->eval(e, n, w, p, count, out);
    return;
  }
  Memo *m = &e->memo[k];
  if (m->serial != p->serial || m->where.dim != w.dim || m->where.tag != w.tag) {
    n->ops->eval(e, n, w, p, count, m->value);
    m->serial = p->serial;
    m->where = w;
  }
  memcpy(out, m->value, count * sizeof *out);
}

double size__at(SizeEval *e, uint32_t k, Where w, Vec3 p)
{
  double out;
  Places at = {&p.x, &p.y, &p.z, ++e->serial};
  size__eval(e, k, w, &at, 1, &out);
  return out;
}
