// coherence_face.c - merging faces with the same boundary
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/coherence_int.h"

static uint64_t loop_key(const Loop *l)
{
  uint64_t sum = 0; // of a set: the order does not count
  for (int i = 0; i < l->ncurve; i++) sum += hash__mix(1, (uint64_t)tag__abs(l->curve[i]));
  return sum;
}

static uint64_t face_hash(const Model *m, const Face *f)
{
  uint64_t sum = 0;
  for (int i = 0; i < f->nloop; i++) sum += loop_key(model_loop(m, f->loop[i]));
  return hash__mix(2, sum);
}

void model__forget_face(Model *m, Face *f)
{
  if (m->face_on) chains__unlink(&m->face_key, face_hash(m, f), table__find(&m->face, f->tag));
}

static void boundary_set(const Model *m, const Face *f, IntVec *out)
{
  vec_clear(out);
  for (int i = 0; i < f->nloop; i++) {
    const Loop *l = model_loop(m, f->loop[i]);
    for (int j = 0; j < l->ncurve; j++) vec_push(out, tag__abs(l->curve[j]));
  }
  if (out->len) qsort(out->data, out->len, sizeof(int), coherence__by_value);
}

static bool same_face(const Model *m, const Face *a, const Face *b)
{
  IntVec p = {0}, q = {0};
  boundary_set(m, a, &p);
  boundary_set(m, b, &q);
  bool same = p.len == q.len && memcmp(p.data, q.data, p.len * sizeof(int)) == 0;
  vec_free(&p);
  vec_free(&q);
  return same;
}

static void find_equal_faces(Model *m, Merged *g)
{
  if (!m->face_on) {
    m->face_on = true;
    vec_clear(&m->dirty[2]);
    table__sort(&m->face);
    for (size_t i = 0; i < m->face.live; i++) vec_push(&m->dirty[2], ((Face *)table__at(&m->face, i))->tag);
  }
  coherence__sort_unique(&m->dirty[2]);
  for (size_t i = 0; i < m->dirty[2].len; i++) {
    Face *f = table__get(&m->face, m->dirty[2].data[i]);
    if (!f || merged__tag(g, 2, f->tag) != f->tag) continue;
    model__forget_face(m, f);
    uint64_t h = face_hash(m, f) & ~(uint64_t)1;
    uint32_t s = map_get(&m->face_key.head, h), next;
    bool gone = false;
    for (; s != NONE && !gone; s = next) {
      next = m->face_key.next.data[s];
      Face *e = table__slot(&m->face, s);
      if (!same_face(m, e, f)) continue;
      gone = e->tag < f->tag;
      Face *out = gone ? f : e, *in = gone ? e : f;
      if (!gone) model__forget_face(m, e);
      coherence__record(g, 2, out->tag, in->tag);
    }
    if (!gone) chains__link(&m->face_key, h, table__find(&m->face, f->tag));
  }
  vec_clear(&m->dirty[2]);
}

void coherence__faces(Model *m, Merged *g)
{
  find_equal_faces(m, g);
  if (!g->gone[2].len) return;
  coherence__groups_follow(m, 2, g);
  for (uint32_t s = 0; m->ncopied && s < m->face.used; s++) {
    Face *f = table__slot(&m->face, s);
    if (f->tag == DEAD_TAG) continue;
    if (f->copy_of) f->copy_of = merged__tag(g, 2, f->copy_of);
    if (f->periodic_master) f->periodic_master = merged__tag(g, 2, f->periodic_master);
  }
  for (uint32_t s = 0; s < m->volume.used; s++) {
    Volume *v = table__slot(&m->volume, s);
    if (v->tag == DEAD_TAG) continue;
    for (int i = 0; i < v->nface; i++) {
      int to = merged__tag(g, 2, v->face[i]);
      if (to == v->face[i]) continue;
      model_face(m, v->face[i])->uses--;
      model_face(m, to)->uses++;
      v->face[i] = to;
    }
  }
  for (uint32_t s = 0; s < m->surface_loop.used; s++) {
    SurfaceLoop *l = table__slot(&m->surface_loop, s);
    if (l->tag != DEAD_TAG) coherence__replace(g, 2, l->face, (size_t)l->nface);
  }
  for (size_t i = 0; i < g->gone[2].len; i++) face__drop(m, g->gone[2].data[i]);
  coherence__recount(m, KIND_FACE);
}
