// heal.c - curves that meet are split there in the model, until a 1D mesh comes out without crossings
// SPDX-License-Identifier: MIT
//
// What the 1D mesh finds to meet is cut exactly, in parts of the same curves with common end points; rounding of the new points
// may make parts meet others anew, so the mesh is made and looked at again.
#include "base/base.h"

#include <math.h>

#include "base/mem.h"
#include "mesh/heal_faces.h"
#include "mesh/mesh1d.h"
#include "model/model_edit.h"

typedef struct {
  Model *m;
  FieldSet *fields;
  double near;      // places nearer than this are one
  CurveMeetings *meet;
  bool faces_done;
} Healer;

static int by_place(const void *a, const void *b)
{
  const CurveMeeting *p = *(CurveMeeting *const *)a, *q = *(CurveMeeting *const *)b;
  if (p->at.x != q->at.x) return p->at.x < q->at.x ? -1 : 1;
  if (p->at.y != q->at.y) return p->at.y < q->at.y ? -1 : 1;
  if (p->at.z != q->at.z) return p->at.z < q->at.z ? -1 : 1;
  return (p->point < q->point) - (p->point > q->point); // known points first
}

// The end of the curve at that place, or 0.
static int end_at(const Healer *h, const CurveMeeting *c)
{
  const Curve *curve = model_curve(h->m, c->curve);
  if (vec3_distance(model_point(h->m, curve->begin)->xyz, c->at) <= h->near) return curve->begin;
  return vec3_distance(model_point(h->m, curve->end)->xyz, c->at) <= h->near ? curve->end : 0;
}

// The size at a new point: what its curves would have had there, if their ends say.
static double size_there(const Model *m, const CurveMeeting *c)
{
  const Curve *curve = model_curve(m, c->curve);
  double a = model_point(m, curve->begin)->lc, b = model_point(m, curve->end)->lc;
  return a < LC_UNSET && b < LC_UNSET ? a + c->u * (b - a) : LC_UNSET;
}

// Every meeting gets a point: places nearer than `near` share one, an end of a curve if there is one.
static void give_points(Healer *h, Diag *diag)
{
  size_t n = h->meet->len;
  CurveMeeting **order = mem_alloc(n * sizeof *order);
  for (size_t i = 0; i < n; i++) {
    CurveMeeting *c = order[i] = &h->meet->data[i];
    if (!c->point) c->point = end_at(h, c);
    if (c->point) c->at = model_point(h->m, c->point)->xyz;
  }
  qsort(order, n, sizeof *order, by_place);
  for (int known = 1; known >= 0; known--) // ends of curves give their points to places nearby, then new points do
    for (size_t i = 0; i < n; i++) {
      CurveMeeting *c = order[i];
      if (known && !c->point) continue;
      if (!c->point) {
        c->point = model_add_point(h->m, -1, c->at, size_there(h->m, c), model_curve(h->m, c->curve)->loc, diag);
      }
      Point *p = model_point(h->m, c->point);
      if (!known) p->lc = fmin(p->lc, size_there(h->m, c));
      for (int way = -1; way <= 1; way += 2)
        for (size_t j = i + (size_t)way; j < n && fabs(order[j]->at.x - c->at.x) <= h->near; j += (size_t)way)
          if (!order[j]->point && vec3_distance(order[j]->at, c->at) <= h->near) order[j]->point = c->point;
    }
  free(order);
}

static int by_curve(const void *a, const void *b)
{
  const CurveMeeting *p = a, *q = b;
  if (p->curve != q->curve) return p->curve < q->curve ? -1 : 1;
  if (p->u != q->u) return p->u < q->u ? -1 : 1;
  return (p->point > q->point) - (p->point < q->point);
}

// Does the curve go away from a place and come back to it between parameters u and v, rather than stay there?
static bool goes_round(const Healer *h, const Curve *curve, double u, double v)
{
  enum { LOOKS = 8 };
  Vec3 at = curve_point(h->m, curve, u);
  for (int k = 1; k < LOOKS; k++)
    if (vec3_distance(curve_point(h->m, curve, u + (v - u) * k / LOOKS), at) > 10 * h->near) return true;
  return false;
}

// The cuts of one curve: ascending, none at its ends, none twice. One that crosses itself is cut twice at one point.
static size_t cuts_of(const Healer *h, const CurveMeeting *c, size_t n, CurveCut *cut)
{
  const Curve *curve = model_curve(h->m, c->curve);
  size_t k = 0;
  for (size_t i = 0; i < n; i++) {
    const double last = k ? cut[k - 1].u : 0;
    if (!(c[i].u > last && c[i].u < 1)) continue;
    if (c[i].point == (k ? cut[k - 1].point : curve->begin) && !goes_round(h, curve, last, c[i].u)) continue;
    cut[k++] = (CurveCut){c[i].u, c[i].point};
  }
  while (k && cut[k - 1].point == curve->end && !goes_round(h, curve, cut[k - 1].u, 1)) k--;
  return k;
}

// Split every curve at its meetings. The number of cuts made.
static size_t split_all(Healer *h, Diag *diag)
{
  CurveMeetings *c = h->meet;
  give_points(h, diag);
  qsort(c->data, c->len, sizeof *c->data, by_curve);
  CurveCut *cut = mem_alloc(c->len * sizeof *cut);
  size_t made = 0;
  for (size_t i = 0, j; i < c->len; i = j) {
    for (j = i; j < c->len && c->data[j].curve == c->data[i].curve;) j++;
    size_t n = cuts_of(h, c->data + i, j - i, cut);
    if (!n) continue;
    IntVec part = {0};
    model_split_curve_at(h->m, c->data[i].curve, cut, n, &part);
    if (h->fields) fields_add_parts(h->fields, 1, c->data[i].curve, part.data, part.len);
    vec_free(&part);
    made += n;
  }
  free(cut);
  return made;
}

// The mesh of the curves is free of crossings: now the faces. True when they need the curves meshed once more.
static bool faces_changed(Healer *h, const Options *opt, Mesh1d **g, SizeField **size, Diag *diag)
{
  size_t changed = 0;
  if (!opt->Mesh_Heal || h->faces_done) return false;
  h->faces_done = true;
  bool good = heal_faces(h->m, h->fields, *g, diag, &changed);
  if (good && !changed) return false;
  mesh1d_free(*g);
  *g = NULL;
  if (!good) return false;
  log_info(diag, "%zu surfaces bounded anew", changed);
  size_free(*size);
  *size = NULL;
  return model_prepare(h->m, opt->Geometry_Tolerance, diag);
}

// One round. True when it is over: with a mesh in *g, or after errors.
static bool heal_once(Healer *h, const Options *opt, SizeField **size, Mesh1d **g, int round, Diag *diag)
{
  Diag *sink = diag_child(diag); // only the last round's messages count
  CurveMeetings meet = {0};
  h->meet = &meet;
  bool last = round > opt->Mesh_MaxRetries;
  *size = size_new(h->m, opt, h->fields, sink);
  *g = *size ? mesh1d_try(h->m, opt, *size, last ? NULL : &meet, sink) : NULL;
  bool over = *g || !*size || !meet.len || diag_errors(sink) > 0;
  size_t cuts = 0;
  if (*g && faces_changed(h, opt, g, size, diag)) {
    diag_free(sink);
    vec_free(&meet);
    return false;
  }
  if (!over) {
    h->near = opt->Geometry_Tolerance * size_diagonal(*size);
    cuts = split_all(h, diag);
    log_info(diag, "curves meet: %zu cuts made in them, round %d", cuts, round + 1);
    size_free(*size);
    *size = NULL;
    if (opt->Mesh_Heal) model_coherence(h->m, diag);
    over = !model_prepare(h->m, opt->Geometry_Tolerance, diag);
  }
  vec_free(&meet);
  if (over) diag_merge(diag, sink);
  else diag_free(sink);
  if (over || cuts) return over;
  // Nothing to cut: what meets is reported as it stands.
  *size = size_new(h->m, opt, h->fields, diag);
  *g = *size ? mesh1d_new(h->m, opt, *size, diag) : NULL;
  return true;
}

Mesh1d *mesh1d_heal(Model *m, const Options *opt, FieldSet *fields, SizeField **size, Diag *diag)
{
  Healer h = {.m = m, .fields = fields};
  Mesh1d *g = NULL;
  *size = NULL;
  if (opt->Mesh_Heal) {
    model_coherence(m, diag);
    if (!model_prepare(m, opt->Geometry_Tolerance, diag)) return NULL;
  }
  for (int round = 0; !heal_once(&h, opt, size, &g, round, diag); round++) continue;
  return g;
}
