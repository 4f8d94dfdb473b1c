// boundary_layer.c - boundary layers of all faces, and the nodes on curves that they share
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/boundary_layer_int.h"

enum { MAX_RECONCILE = 60 };

// ---- ends on curves: one height for all faces ------------------------------------------------------------------------------
typedef struct {
  double s, first;
  const LayerField *field;
  double length; // of the column at s = 1
} End;

// Ends of a curve by 2 * curve + (at its end).
static bool agree(const Planner *p, End *end)
{
  bool changed = false;
  for (size_t i = 0; i < p->b->nface; i++)
    for (size_t j = 0; j < p->b->face[i].chain.len; j++) {
      Chain *c = &p->b->face[i].chain.data[j];
      for (size_t k = 0; k < c->col.len; k++) {
        Column *col = &c->col.data[k];
        if (col->on == NONE || c->dropped) continue;
        End *e = &end[2 * col->on + col->on_end];
        if (!e->field) *e = (End){col->s, col->first, c->field, vec2_length(col->dir)};
        double length = vec2_length(col->dir);
        if (e->field != c->field || fabs(length - e->length) > 1e-9 * length) { // two laws on one curve: the second gives way
          *col = (Column){.curve = col->curve, .index = col->index, .base = col->base, .dir = col->dir, .on = NONE, .collapsed = true};
          changed = true;
          continue;
        }
        if (col->s > e->s) changed = true;
        e->s = col->s = fmin(col->s, e->s);
      }
    }
  return changed;
}

static void settle_all(const Planner *p, End *end)
{
  for (size_t i = 0; i < p->b->nface; i++) layers__find_room(&p->b->face[i]);
  for (int round = 0; round < MAX_RECONCILE; round++) {
    for (size_t i = 0; i < p->b->nface; i++) layers__settle(&p->b->face[i]);
    bool changed = agree(p, end);
    changed = agree(p, end) || changed; // those met before the least one
    if (!changed) return;
  }
  for (size_t i = 0; i < p->b->nface; i++)
    for (size_t j = 0; j < p->b->face[i].chain.len; j++) p->b->face[i].chain.data[j].dropped = true;
}

// The nodes of a curve with layers at one or both ends: theirs, and of the others those that are not too near to them.
static void replace_nodes(const Planner *p, uint32_t k, const End *at_begin, const End *at_end)
{
  const CurveMesh *cm = &p->curves->curve[k];
  const Curve *c = model_curve_at(p->m, k);
  double length = curve_length(p->m, c);
  DoubleVec s = {0}, height[2] = {{0}, {0}};
  vec_push(&s, 0);
  const End *end[2] = {at_begin, at_end};
  double top[2] = {0, 0};
  for (int i = 0; i < 2; i++) {
    if (!end[i]->field || !(end[i]->s > 0)) continue;
    vec_resize(&height[i], end[i]->field->height.len);
    column__heights(end[i]->field, end[i]->first, end[i]->s, height[i].data);
    top[i] = end[i]->length * vec_last(&height[i]);
  }
  for (size_t i = 0; i < height[0].len; i++) vec_push(&s, end[0]->length * height[0].data[i] / length);
  double lo = top[0] / length, hi = 1 - top[1] / length;
  for (uint32_t i = 1; i + 1 < cm->n; i++) {
    double at = vec3_distance(cm->p[0], cm->p[i]) / length;
    double before = at - vec3_distance(cm->p[0], cm->p[i - 1]) / length, after = vec3_distance(cm->p[0], cm->p[i + 1]) / length - at;
    if (at > lo + 0.5 * before && at < hi - 0.5 * after) vec_push(&s, at);
  }
  for (size_t i = height[1].len; i-- > 0;) vec_push(&s, 1 - end[1]->length * height[1].data[i] / length);
  vec_free(&height[0]);
  vec_free(&height[1]);
  vec_push(&s, 1);
  double *u = mem_alloc(s.len * sizeof *u);
  curve_at_fractions(p->m, c, s.data, (uint32_t)s.len, u);
  u[0] = 0;
  u[s.len - 1] = 1;
  mesh1d_set(p->curves, k, u, (uint32_t)s.len);
  free(u);
  vec_free(&s);
}

static void put_ends_on_curves(const Planner *p, End *end)
{
  size_t n = model_curves(p->m);
  for (size_t k = 0; k < 2 * n; k++) end[k].field = NULL;
  for (size_t i = 0; i < p->b->nface; i++)
    for (size_t j = 0; j < p->b->face[i].chain.len; j++) {
      Chain *c = &p->b->face[i].chain.data[j];
      for (size_t k = 0; k < c->col.len && !c->dropped; k++) {
        Column *col = &c->col.data[k];
        if (col->on != NONE) end[2 * col->on + col->on_end] = (End){col->s, col->first, c->field, vec2_length(col->dir)};
      }
    }
  for (uint32_t k = 0; k < n; k++)
    if (end[2 * k].field || end[2 * k + 1].field) replace_nodes(p, k, &end[2 * k], &end[2 * k + 1]);
}

// ---- life --------------------------------------------------------------------------------------------------------------
static void report(const Planner *p)
{
  for (size_t i = 0; i < p->b->nface; i++) {
    const FaceLayers *f = &p->b->face[i];
    const Face *face = model_face_at(p->m, f->face);
    size_t dropped = 0, shortened = 0, all = 0;
    for (size_t j = 0; j < f->chain.len; j++) {
      const Chain *c = &f->chain.data[j];
      dropped += c->dropped;
      for (size_t k = 0; k < c->col.len; k++) shortened += !c->col.data[k].collapsed && c->col.data[k].s < 0.99;
      all += c->col.len;
    }
    if (dropped) diag_warning(p->diag, face->loc, "surface %d has no room for its boundary layers: it gets none", face->tag);
    log_debug(p->diag, "surface %d: %zu columns of boundary layers, %zu shortened", face->tag, all, shortened);
  }
}

// Curves that are meshed as part of another stand for the whole.
static void name_leaders(LayerField *f, const Model *m)
{
  for (size_t i = 0; i < f->curves.len; i++) {
    const Curve *c = model_curve(m, f->curves.data[i]);
    if (c && c->joined) f->curves.data[i] = c->joined;
  }
}

BoundaryLayers *boundary_layers_new(const Model *m, const FieldSet *fields, const Options *opt, Mesh1d *curves, Diag *diag)
{
  const int *id;
  size_t n = fields ? fields_boundary_layers(fields, &id) : 0;
  if (!n) return NULL;
  BoundaryLayers *b = mem_zalloc(sizeof *b);
  Planner p = {m, opt, b, curves, diag};
  b->field = mem_alloc(n * sizeof *b->field);
  for (size_t i = 0; i < n; i++) {
    LayerField *f = &b->field[b->nfield];
    if (layer_field__read(f, fields, id[i], diag)) {
      name_leaders(f, m);
      b->nfield++;
    } else {
      layer_field__free(f);
    }
  }
  b->face = mem_alloc(model_faces(m) * sizeof *b->face);
  for (size_t k = 0; k < model_faces(m); k++) {
    const Face *face = model_face_at(m, k);
    if (!layers__wanted(&p, face)) continue;
    FaceLayers *f = &b->face[b->nface++];
    *f = (FaceLayers){.face = k};
    layers__plan_face(&p, f, face);
  }
  End *end = mem_zalloc(2 * model_curves(m) * sizeof *end);
  settle_all(&p, end);
  put_ends_on_curves(&p, end);
  free(end);
  report(&p);
  return b;
}

void boundary_layers_free(BoundaryLayers *b)
{
  if (!b) return;
  for (size_t i = 0; i < b->nfield; i++) layer_field__free(&b->field[i]);
  for (size_t i = 0; i < b->nface; i++) {
    for (size_t j = 0; j < b->face[i].chain.len; j++) vec_free(&b->face[i].chain.data[j].col);
    vec_free(&b->face[i].chain);
    vec_free(&b->face[i].wall);
  }
  free(b->field);
  free(b->face);
  free(b);
}
