// model_check.c - the invariants of a model, for tests
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_check.h"

#include <stdarg.h>

#include "model/model_int.h"

typedef struct {
  const Model *m;
  Str *why;
  int faults;
} Check;

static void PRINTF_LIKE(2, 3) fault(Check *k, const char *fmt, ...)
{
  if (++k->faults > 10) return;
  char text[200];
  va_list ap;
  va_start(ap, fmt);
  vsnprintf(text, sizeof text, fmt, ap);
  va_end(ap);
  str_printf(k->why, "%s\n", text);
}

static void check_table(Check *k, Kind kind)
{
  const Table *t = model__table(k->m, kind);
  size_t live = 0;
  int before = -1;
  table__sort((Table *)t);
  if (t->order.len != t->live) fault(k, "%s: %zu in order, %zu alive", kind__name(kind), t->order.len, t->live);
  for (size_t i = 0; i < t->order.len; i++) {
    int tag;
    memcpy(&tag, table__at(t, i), sizeof tag);
    if (tag <= before) fault(k, "%s %d follows %d", kind__name(kind), tag, before);
    if (table__find(t, tag) != t->order.data[i]) fault(k, "%s %d is not found by its tag", kind__name(kind), tag);
    if (tag > k->m->max[kind]) fault(k, "%s %d is beyond the maximum %d", kind__name(kind), tag, k->m->max[kind]);
    before = tag;
    live++;
  }
  if (live != t->live) fault(k, "%s: %zu counted, %zu alive", kind__name(kind), live, t->live);
}

static void count_point(Check *k, Map *uses, int tag, int curve)
{
  if (!model_point(k->m, tag)) {
    fault(k, "curve %d refers to point %d, which is gone", curve, tag);
    return;
  }
  bool added;
  (*map_slot(uses, (uint64_t)(uint32_t)tag, 0, &added))++;
}

static void check_points(Check *k)
{
  Map uses = {0};
  for (size_t i = 0; i < model_curves(k->m); i++) {
    const Curve *c = model_curve_at(k->m, i);
    for (int j = 0; j < c->npoint; j++) count_point(k, &uses, c->point[j], c->tag);
    if (c->begin != c->point[0] || c->end != c->point[c->npoint - 1]) fault(k, "curve %d does not end at its ends", c->tag);
    count_point(k, &uses, c->begin, c->tag);
    count_point(k, &uses, c->end, c->tag);
  }
  for (size_t i = 0; i < model_points(k->m); i++) {
    const Point *p = model_point_at(k->m, i);
    uint32_t n = map_get(&uses, (uint64_t)p->tag);
    if (n == NONE) n = 0;
    if (n != p->uses) fault(k, "point %d is used %u times, not %u", p->tag, n, p->uses);
  }
  map_free(&uses);
}

static void count_loop(Check *k, const Loop *l, Map *in)
{
  int first = 0;
  for (int i = 0; l->sorted && i < l->ncurve; i++) {
    const Curve *c = model_curve(k->m, l->curve[i]);
    if (!c) {
      fault(k, "sorted loop %d lists curve %d, which is gone", l->tag, l->curve[i]);
      return;
    }
    bool added;
    (*map_slot(in, (uint64_t)c->tag, 0, &added))++;
    if (l->tag >= HIDDEN_LOOP) continue; // copies close at the next coherence
    if (i && curve__to(k->m, l->curve[i - 1]) != curve__from(k->m, l->curve[i]) &&
        curve__to(k->m, l->curve[i - 1]) != curve__from(k->m, l->curve[first]))
      fault(k, "sorted loop %d breaks between %d and %d", l->tag, l->curve[i - 1], l->curve[i]);
    if (i && curve__to(k->m, l->curve[i - 1]) != curve__from(k->m, l->curve[i])) first = i;
  }
}

static void check_curves(Check *k)
{
  Map in = {0}, uses = {0};
  const Table *both[2] = {&k->m->loop, &k->m->hidden};
  for (int t = 0; t < 2; t++)
    for (uint32_t s = 0; s < both[t]->used; s++) {
      const Loop *l = table__slot(both[t], s);
      if (l->tag != DEAD_TAG) count_loop(k, l, &in);
    }
  for (size_t i = 0; i < model_faces(k->m); i++) {
    const Face *f = model_face_at(k->m, i);
    for (int j = 0; j < f->nloop; j++) {
      const Loop *l = model_loop(k->m, f->loop[j]);
      if (!l) fault(k, "surface %d refers to loop %d, which is gone", f->tag, f->loop[j]);
      for (int c = 0; l && c < l->ncurve; c++) {
        bool added;
        if (!model_curve(k->m, l->curve[c])) fault(k, "surface %d has curve %d, which is gone", f->tag, l->curve[c]);
        (*map_slot(&uses, (uint64_t)tag__abs(l->curve[c]), 0, &added))++;
      }
    }
  }
  for (size_t i = 0; i < model_curves(k->m); i++) {
    const Curve *c = model_curve_at(k->m, i);
    uint32_t a = map_get(&in, (uint64_t)c->tag), b = map_get(&uses, (uint64_t)c->tag);
    if ((a == NONE ? 0 : a) != c->in_loops) fault(k, "curve %d is in %u loops, not %u", c->tag, a == NONE ? 0 : a, c->in_loops);
    if ((b == NONE ? 0 : b) != c->uses) fault(k, "curve %d is used %u times, not %u", c->tag, b == NONE ? 0 : b, c->uses);
  }
  map_free(&in);
  map_free(&uses);
}

static void check_volumes(Check *k)
{
  Map uses = {0};
  for (uint32_t s = 0; s < k->m->volume.used; s++) {
    const Volume *v = table__slot(&k->m->volume, s);
    for (int i = 0; v->tag != DEAD_TAG && i < v->nface; i++) {
      bool added;
      if (!model_face(k->m, v->face[i])) fault(k, "volume %d has surface %d, which is gone", v->tag, v->face[i]);
      (*map_slot(&uses, (uint64_t)tag__abs(v->face[i]), 0, &added))++;
    }
  }
  for (size_t i = 0; i < model_faces(k->m); i++) {
    const Face *f = model_face_at(k->m, i);
    uint32_t n = map_get(&uses, (uint64_t)f->tag);
    if ((n == NONE ? 0 : n) != f->uses) fault(k, "surface %d is used %u times, not %u", f->tag, n == NONE ? 0 : n, f->uses);
  }
  map_free(&uses);
}

static bool same_points(const Curve *a, const Curve *b)
{
  if (a->type != b->type || a->npoint != b->npoint || a->has_plane || b->has_plane || a->arc || b->arc) return false;
  bool forward = true, back = a->type != CURVE_ELLIPSE;
  for (int i = 0; i < a->npoint; i++) {
    forward = forward && a->point[i] == b->point[i];
    back = back && a->point[i] == b->point[a->npoint - 1 - i];
  }
  return (forward || back) && a->nknot == 0 && b->nknot == 0;
}

static void check_coherence(Check *k)
{
  const Model *m = k->m;
  double tol = m->point.live ? m->set.tolerance * vec3_distance(m->extent.lo, m->extent.hi) : 0;
  for (size_t i = 0; i < model_points(m); i++)
    for (size_t j = i + 1; j < model_points(m); j++) {
      Vec3 a = model_point_at(m, i)->xyz, b = model_point_at(m, j)->xyz;
      if (fabs(a.x - b.x) <= tol && fabs(a.y - b.y) <= tol && fabs(a.z - b.z) <= tol)
        fault(k, "points %d and %d coincide", model_point_at(m, i)->tag, model_point_at(m, j)->tag);
    }
  for (size_t i = 0; i < model_curves(m); i++)
    for (size_t j = i + 1; j < model_curves(m); j++)
      if (same_points(model_curve_at(m, i), model_curve_at(m, j)))
        fault(k, "curves %d and %d are the same", model_curve_at(m, i)->tag, model_curve_at(m, j)->tag);
}

bool model_check(const Model *m, bool coherent, Str *why)
{
  Check k = {m, why, 0};
  for (int kind = 0; kind < KIND_GROUP; kind++) check_table(&k, (Kind)kind);
  check_points(&k);
  check_curves(&k);
  check_volumes(&k);
  if (coherent) check_coherence(&k);
  return k.faults == 0;
}
