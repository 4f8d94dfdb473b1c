// remove.c - deleting shapes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_int.h"

static void delete_point(Model *m, int tag)
{
  Point *p = point__get(m, tag);
  if (!p || p->uses) return;
  model__forget_point(m, p);
  table__remove(&m->point, tag);
  if (tag == m->max[KIND_POINT]) m->max[KIND_POINT]--;
}

// Loops that listed a deleted curve: what they say is void until someone makes a curve of that tag anew.
static void loops_lose(Model *m, int tag)
{
  Table *both[2] = {&m->loop, &m->hidden};
  for (int k = 0; k < 2; k++)
    for (uint32_t s = 0; s < both[k]->used; s++) {
      Loop *l = table__slot(both[k], s);
      if (l->tag == DEAD_TAG || !l->sorted) continue;
      bool lists = false;
      for (int i = 0; i < l->ncurve && !lists; i++) lists = tag__abs(l->curve[i]) == tag;
      for (int i = 0; lists && i < l->ncurve; i++) model_curve(m, l->curve[i])->in_loops--;
      if (!lists) continue;
      l->sorted = false;
      l->lost = true;
    }
}

static void delete_curve(Model *m, int tag, bool recursive)
{
  Curve *c = table__get(&m->curve, tag);
  if (!c || c->uses) return;
  int begin = c->begin, end = c->end, n = recursive ? c->npoint : 0;
  int *point = n ? c->point : NULL; // the arena keeps it
  if (c->in_loops) loops_lose(m, tag);
  curve__drop(m, tag);
  if (tag == m->max[KIND_CURVE]) m->max[KIND_CURVE]--;
  if (!recursive) return;
  delete_point(m, begin);
  delete_point(m, end);
  for (int i = 0; i < n; i++) delete_point(m, point[i]);
}

static void delete_face(Model *m, int tag, bool recursive)
{
  Face *f = table__get(&m->face, tag);
  if (!f || f->uses) return;
  IntVec curve = {0}, start = {0};
  if (recursive) face_boundary(m, f, &curve, &start);
  if (recursive) face__drop_whole(m, tag);
  else face__drop(m, tag);
  if (tag == m->max[KIND_FACE]) m->max[KIND_FACE]--;
  for (size_t i = 0; i < curve.len; i++) delete_curve(m, tag__abs(curve.data[i]), true);
  vec_free(&curve);
  vec_free(&start);
}

static void delete_volume(Model *m, int tag, bool recursive)
{
  Volume *v = table__get(&m->volume, tag);
  if (!v) return;
  int *face = v->face, n = v->nface;
  for (int i = 0; i < n; i++) model_face(m, face[i])->uses--;
  table__remove(&m->volume, tag);
  if (tag == m->max[KIND_VOLUME]) m->max[KIND_VOLUME]--;
  for (int i = 0; recursive && i < n; i++) delete_face(m, tag__abs(face[i]), true);
}

void model_delete(Model *m, const Shape *shape, size_t n, bool recursive)
{
  model__unprepare(m);
  for (size_t i = 0; i < n; i++) {
    int tag = tag__abs(shape[i].tag);
    if (shape[i].dim == 0) delete_point(m, tag);
    if (shape[i].dim == 1) delete_curve(m, tag, recursive);
    if (shape[i].dim == 2) delete_face(m, tag, recursive);
    if (shape[i].dim == 3) delete_volume(m, tag, recursive);
  }
}
