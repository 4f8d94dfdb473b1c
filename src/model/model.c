// model.c - life of a model, reading it, tags
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_int.h"

Model *model_new(void)
{
  Model *m = mem_zalloc(sizeof *m);
  m->set = (ModelSettings){.tolerance = 1e-8,
                           .auto_coherence = 1,
                           .old_newreg = true,
                           .return_lateral = true,
                           .spline_points = 5};
  m->extent = box3_empty();
  table__init(&m->point, sizeof(Point));
  table__init(&m->curve, sizeof(Curve));
  table__init(&m->loop, sizeof(Loop));
  table__init(&m->hidden, sizeof(Loop));
  table__init(&m->face, sizeof(Face));
  table__init(&m->surface_loop, sizeof(SurfaceLoop));
  table__init(&m->volume, sizeof(Volume));
  return m;
}

static void release_contents(Model *m)
{
  table__sort(&m->curve);
  for (size_t i = 0; i < m->curve.live; i++) curve__release(table__at(&m->curve, i));
  table__sort(&m->face);
  for (size_t i = 0; i < m->face.live; i++) {
    Face *f = table__at(&m->face, i);
    vec_free(&f->embedded_points);
    vec_free(&f->embedded_curves);
  }
  Table *all[] = {&m->point, &m->curve, &m->loop, &m->hidden, &m->face, &m->surface_loop, &m->volume};
  for (size_t i = 0; i < ARRAY_LEN(all); i++) table__free(all[i]);
  model_delete_groups(m);
  for (int d = 0; d < 4; d++) {
    vec_free(&m->group[d]);
    vec_free(&m->dirty[d]);
  }
  vec_free(&m->pending_loop);
  vec_free(&m->wire);
  vec_free(&m->moved);
  vec_free(&m->joint);
  map_free(&m->refused);
  model__index_free(m);
  arena_free(&m->arena);
}

void model_free(Model *m)
{
  if (!m) return;
  release_contents(m);
  free(m);
}

void model_delete_all(Model *m)
{
  ModelSettings set = m->set;
  release_contents(m);
  Model *fresh = model_new();
  *m = *fresh;
  free(fresh);
  m->set = set;
}

ModelSettings *model_settings(Model *m) { return &m->set; }

// ---- reading ------------------------------------------------------------------------------------------------------

// Sorting is a cache: it changes nothing a reader can see, and has happened once model_prepare returned.
static size_t count(const Table *t)
{
  if (!t->ordered) table__sort((Table *)t);
  return t->live;
}

static void *at(const Table *t, size_t k)
{
  if (!t->ordered) table__sort((Table *)t);
  return table__at(t, k);
}

size_t model_points(const Model *m) { return count(&m->point); }
size_t model_curves(const Model *m) { return count(&m->curve); }
size_t model_loops(const Model *m) { return count(&m->loop); }
size_t model_faces(const Model *m) { return count(&m->face); }
size_t model_volumes(const Model *m) { return count(&m->volume); }
Point *model_point_at(const Model *m, size_t k) { return at(&m->point, k); }
Curve *model_curve_at(const Model *m, size_t k) { return at(&m->curve, k); }
Loop *model_loop_at(const Model *m, size_t k) { return at(&m->loop, k); }
Face *model_face_at(const Model *m, size_t k) { return at(&m->face, k); }
Point *model_point(const Model *m, int tag) { return table__get(&m->point, tag__abs(tag)); }
Curve *model_curve(const Model *m, int tag) { return table__get(&m->curve, tag__abs(tag)); }
Face *model_face(const Model *m, int tag) { return table__get(&m->face, tag__abs(tag)); }

Loop *model_loop(const Model *m, int tag)
{
  tag = tag__abs(tag);
  return tag >= HIDDEN_LOOP ? table__get(&m->hidden, tag - HIDDEN_LOOP) : table__get(&m->loop, tag);
}

Table *model__table(const Model *m, Kind k)
{
  const Table *t[KIND_COUNT] = {&m->point, &m->curve, &m->loop, &m->face, &m->surface_loop, &m->volume, NULL};
  return (Table *)t[k];
}

void model_all(const Model *m, int dim, IntVec *out)
{
  const Table *t = model__table(m, dim__kind(dim));
  size_t n = count(t);
  vec_reserve(out, out->len + n);
  for (size_t i = 0; i < n; i++) {
    int tag;
    memcpy(&tag, table__at(t, i), sizeof tag);
    vec_push(out, tag);
  }
}

bool model_has(const Model *m, int dim, int tag)
{
  return dim >= 0 && dim <= 3 && table__find(model__table(m, dim__kind(dim)), tag__abs(tag)) != NONE;
}

// ---- names ----------------------------------------------------------------------------------------------------------

const char *kind__name(Kind k)
{
  static const char *const names[KIND_COUNT] = {"point",        "curve",  "curve loop",     "surface",
                                                "surface loop", "volume", "physical group"};
  return names[k];
}

const char *dim__name(int dim) { return kind__name(dim__kind(dim)); }

// ---- tags -----------------------------------------------------------------------------------------------------------

int model_max_tag(const Model *m, Kind k) { return m->max[k]; }
void model_set_max_tag(Model *m, Kind k, int tag) { m->max[k] = tag; }

void model__note_tag(Model *m, Kind k, int tag)
{
  if (tag > m->max[k]) m->max[k] = tag;
}

int model_new_tag(const Model *m, Kind k)
{
  int max = m->max[k];
  if (k == KIND_GROUP || (k != KIND_POINT && m->set.old_newreg)) // newreg is new to all kinds but points
    for (int i = KIND_CURVE; i < KIND_COUNT; i++) max = MAX(max, m->max[i]);
  return max + 1;
}

int model__next_tag(const Model *m, Kind k) { return m->set.opencascade ? m->max[k] + 1 : model_new_tag(m, k); }

void model__recount(Model *m, Kind k)
{
  const Table *t = model__table(m, k);
  int tag = m->max[k];
  for (int steps = 0; steps < 4096 && tag > 0; steps++, tag--)
    if (table__find(t, tag) != NONE) {
      m->max[k] = tag;
      return;
    }
  size_t n = count(t);
  m->max[k] = 0;
  if (n) memcpy(&m->max[k], table__at(t, n - 1), sizeof(int));
}

void model__refuse(Model *m, Kind k, int tag)
{
  if (tag >= 0) map_set(&m->refused, (uint64_t)k << 32 | (uint32_t)tag, 1);
}

bool model__refused(const Model *m, Kind k, int tag)
{
  return m->refused.len && map_get(&m->refused, (uint64_t)k << 32 | (uint32_t)tag__abs(tag)) != NONE;
}
