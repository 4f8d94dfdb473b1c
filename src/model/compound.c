// compound.c - faces that are meshed as one (Compound Surface): who goes with whom, and which curves between them dissolve
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_int.h"

// Which faces a curve bounds: two at most are remembered, and how often it was met.
typedef struct {
  const Curve *curve;
  Face *face[2];
  int uses;
} Between;
typedef Vec(Between) BetweenVec;

static bool is_member(const Group *g, int tag)
{
  for (size_t i = 0; i < g->entity.len; i++)
    if (tag__abs(g->entity.data[i]) == tag) return true;
  return false;
}

static bool in_some_group(const Model *m, int dim, int tag)
{
  for (size_t i = 0; i < model_groups(m); i++) {
    const Group *g = model_group_at(m, i);
    if (g->dim == dim && is_member(g, tag)) return true;
  }
  return false;
}

bool model__same_groups(const Model *m, int dim, int a, int b)
{
  for (size_t i = 0; i < model_groups(m); i++) {
    const Group *g = model_group_at(m, i);
    if (g->dim == dim && is_member(g, a) != is_member(g, b)) return false;
  }
  return true;
}

static bool may_unite(const Face *f)
{
  return f->compound > 0 && f->planar && !f->transfinite && !(f->extruded_curve && f->layers.n) && !f->copy_of && !f->periodic_master;
}

static bool same_plane(const Face *a, const Face *b, double tolerance)
{
  return fabs(vec3_dot(a->normal, b->normal)) > 1 - 1e-12 && fabs(vec3_dot(vec3_sub(b->origin, a->origin), a->normal)) <= tolerance;
}

static bool may_dissolve(const Model *m, const Between *b, double tolerance)
{
  const Curve *c = b->curve;
  Face *f = b->face[0], *g = b->face[1];
  return b->uses == 2 && f != g && f->compound == g->compound && may_unite(f) && may_unite(g) && !f->recombine == !g->recombine &&
         f->algorithm == g->algorithm && same_plane(f, g, tolerance) && model__same_groups(m, 2, f->tag, g->tag) &&
         !in_some_group(m, 1, c->tag);
}

static void find_uses(const Model *m, BetweenVec *all)
{
  Map at = {0};
  for (size_t k = 0; k < model_faces(m); k++) {
    Face *f = model_face_at(m, k);
    IntVec curve = {0}, start = {0};
    face_boundary(m, f, &curve, &start);
    for (size_t i = 0; i < curve.len + f->embedded_curves.len; i++) {
      bool embedded = i >= curve.len, fresh;
      int tag = tag__abs(embedded ? f->embedded_curves.data[i - curve.len] : curve.data[i]);
      uint32_t *slot = map_slot(&at, (uint64_t)tag, (uint32_t)all->len, &fresh);
      if (fresh) vec_push(all, ((Between){.curve = model_curve(m, tag)}));
      Between *b = &all->data[*slot];
      if (b->uses < 2) b->face[b->uses] = f;
      b->uses += embedded ? 3 : 1; // an embedded curve is there to stay
    }
    vec_free(&curve);
    vec_free(&start);
  }
  map_free(&at);
}

static Face *leader_of(const Model *m, Face *f)
{
  while (f->united != f->tag && f->united) f = model_face(m, f->united);
  return f;
}

void model__unite_faces(Model *m, double tolerance, Diag *diag)
{
  for (size_t k = 0; k < model_faces(m); k++) model_face_at(m, k)->united = 0;
  for (size_t k = 0; k < model_curves(m); k++) model_curve_at(m, k)->dissolved = false;
  if (!m->ncompound[2]) return;
  BetweenVec all = {0};
  find_uses(m, &all);
  tolerance *= vec3_distance(m->extent.lo, m->extent.hi);
  for (size_t i = 0; i < all.len; i++) {
    const Between *b = &all.data[i];
    if (!may_dissolve(m, b, tolerance)) continue;
    model_curve(m, b->curve->tag)->dissolved = true;
    Face *f = leader_of(m, b->face[0]), *g = leader_of(m, b->face[1]);
    Face *first = f->tag < g->tag ? f : g, *second = f->tag < g->tag ? g : f;
    first->united = second->united = first->tag;
  }
  for (size_t k = 0; k < model_faces(m); k++) { // straight to the leader
    Face *f = model_face_at(m, k);
    if (f->united) f->united = leader_of(m, f)->tag;
    else if (f->compound)
      diag_warning(diag, f->loc, "surface %d of a compound is meshed on its own: it has no neighbour in its plane and its physical groups, "
                   "or is structured", f->tag);
  }
  vec_free(&all);
}

// Head to tail, one closed loop after the other; curves that are run both ways come last, forth and back.
static void put_in_loops(const Model *m, IntVec *curve)
{
  IntVec out = {0}, twice = {0};
  bool *used = mem_zalloc(curve->len + 1);
  for (size_t i = 0; i < curve->len; i++)
    for (size_t k = i + 1; k < curve->len && !used[i]; k++) {
      if (used[k] || curve->data[k] != -curve->data[i]) continue;
      used[i] = used[k] = true;
      vec_push(&twice, curve->data[i]);
      vec_push(&twice, curve->data[k]);
    }
  for (size_t i = 0; i < curve->len; i++) {
    if (used[i]) continue;
    int start = curve__from(m, curve->data[i]);
    for (size_t k = i; k < curve->len;) {
      used[k] = true;
      vec_push(&out, curve->data[k]);
      int at = curve__to(m, curve->data[k]);
      if (at == start) break;
      for (k = i; k < curve->len && (used[k] || curve__from(m, curve->data[k]) != at);) k++;
    }
  }
  for (size_t i = 0; i < twice.len; i++) vec_push(&out, twice.data[i]);
  vec_free(&twice);
  vec_free(curve);
  free(used);
  *curve = out;
}

void face_boundary_united(const Model *m, const Face *f, IntVec *curve)
{
  IntVec part = {0}, start = {0};
  vec_clear(curve);
  for (size_t k = 0; k < model_faces(m); k++) {
    const Face *g = model_face_at(m, k);
    if (g != f && (!f->united || g->united != f->tag)) continue;
    face_boundary(m, g, &part, &start);
    int sign = vec3_dot(f->normal, g->normal) < 0 ? -1 : 1; // all as f is turned
    for (size_t i = 0; i < part.len; i++)
      if (!model_curve(m, part.data[i])->dissolved) vec_push(curve, sign * part.data[i]);
  }
  put_in_loops(m, curve);
  vec_free(&part);
  vec_free(&start);
}
