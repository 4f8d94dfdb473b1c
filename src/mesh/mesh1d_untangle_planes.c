// mesh1d_untangle_planes.c - which curves are looked at together: those of faces in one plane
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/mem.h"
#include "mesh/mesh1d_untangle_int.h"

static bool same_vec(Vec3 a, Vec3 b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

// Equal frames up to the sense of the normal: the coordinates in one are those in the other, perhaps mirrored.
static bool same_plane(const Face *a, const Face *b)
{
  return same_vec(a->origin, b->origin) && same_vec(a->axis_u, b->axis_u) &&
         (same_vec(a->axis_v, b->axis_v) || same_vec(a->axis_v, vec3_scale(-1, b->axis_v)));
}

static void add_curve_of_face(Untangler *t, Plane *plane, uint32_t face, int tag, bool bounds)
{
  uint32_t k = mesh1d_index(t->g, tag);
  if (k == NONE || t->g->curve[k].n < 2) return;
  U32Vec *on = &t->faces_of[k];
  if (!on->len || vec_last(on) != face) vec_push(on, face);
  on = &t->bounds_of[k];
  if (bounds && (!on->len || vec_last(on) != face)) vec_push(on, face);
  vec_push(&plane->curve, k);
}

static int by_index(const void *a, const void *b)
{
  uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
  return x < y ? -1 : x > y;
}

static void keep_each_once(U32Vec *v)
{
  if (!v->len) return;
  qsort(v->data, v->len, sizeof *v->data, by_index);
  size_t n = 1;
  for (size_t i = 1; i < v->len; i++)
    if (v->data[i] != v->data[n - 1]) v->data[n++] = v->data[i];
  v->len = n;
}

// Planes are few where faces are many: the last ones used are looked at first.
static Plane *plane_of(Untangler *t, const Face *f)
{
  for (size_t i = t->plane.len; i > 0; i--)
    if (same_plane(t->plane.data[i - 1].frame, f)) return &t->plane.data[i - 1];
  vec_push(&t->plane, ((Plane){.frame = f}));
  return &vec_last(&t->plane);
}

void untangle__find_planes(Untangler *t)
{
  const Model *m = t->g->model;
  t->faces_of = mem_zalloc((t->g->ncurve + 1) * sizeof *t->faces_of);
  t->bounds_of = mem_zalloc((t->g->ncurve + 1) * sizeof *t->bounds_of);
  for (uint32_t k = 0; k < model_faces(m); k++) {
    const Face *f = model_face_at(m, k);
    if (f->type != FACE_PLANE || !f->planar) continue;
    Plane *plane = plane_of(t, f);
    vec_push(&plane->face, k);
    for (int i = 0; i < f->nloop; i++) {
      const Loop *loop = model_loop(m, f->loop[i]);
      for (int j = 0; loop && j < loop->ncurve; j++) add_curve_of_face(t, plane, k, loop->curve[j], true);
    }
    for (size_t i = 0; i < f->embedded_curves.len; i++) add_curve_of_face(t, plane, k, f->embedded_curves.data[i], false);
  }
  for (size_t i = 0; i < t->plane.len; i++) keep_each_once(&t->plane.data[i].curve);
}

void untangle__free_planes(Untangler *t)
{
  for (size_t k = 0; k < t->g->ncurve; k++) {
    vec_free(&t->faces_of[k]);
    vec_free(&t->bounds_of[k]);
  }
  for (size_t i = 0; i < t->plane.len; i++) {
    vec_free(&t->plane.data[i].face);
    vec_free(&t->plane.data[i].curve);
  }
  vec_free(&t->plane);
  free(t->faces_of);
  free(t->bounds_of);
}

bool untangle__lists_meet(const U32Vec *x, const U32Vec *y)
{
  for (size_t i = 0, j = 0; i < x->len && j < y->len;) {
    if (x->data[i] == y->data[j]) return true;
    if (x->data[i] < y->data[j]) i++;
    else j++;
  }
  return false;
}

bool untangle__share_a_face(const Untangler *t, uint32_t a, uint32_t b)
{
  return untangle__lists_meet(&t->faces_of[a], &t->faces_of[b]);
}

bool untangle__may_split(const Untangler *t, uint32_t a, uint32_t b, SegMeet how)
{
  if (!t->meet || model_curve_at(t->g->model, a)->joined || model_curve_at(t->g->model, b)->joined) return false;
  if (t->opt->Mesh_Heal) return true;
  if (how == SEG_OVERLAP) return false;
  if (untangle__lists_meet(&t->bounds_of[a], &t->bounds_of[b])) return false;
  if (how == SEG_TOUCH) return true;
  return !untangle__lists_meet(&t->bounds_of[a], &t->faces_of[b]) && !untangle__lists_meet(&t->faces_of[a], &t->bounds_of[b]);
}
