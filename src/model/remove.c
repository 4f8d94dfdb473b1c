// remove.c - deleting shapes, splitting curves
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
  face__drop(m, tag);
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
  if (m->moved.len) model__restore_points(m);
  for (size_t i = 0; i < n; i++) {
    int tag = tag__abs(shape[i].tag);
    if (shape[i].dim == 0) delete_point(m, tag);
    if (shape[i].dim == 1) delete_curve(m, tag, recursive);
    if (shape[i].dim == 2) delete_face(m, tag, recursive);
    if (shape[i].dim == 3) delete_volume(m, tag, recursive);
  }
}

// ---- splitting --------------------------------------------------------------------------------------------------------

// Put `part` (head to tail) in the place of curve `tag` in a list of signed tags. Returns the new list in the arena.
static int *replaced(Model *m, const int *list, int *n, int tag, const IntVec *part)
{
  int hits = 0;
  for (int i = 0; i < *n; i++) hits += tag__abs(list[i]) == tag;
  if (!hits) return NULL;
  int size = *n + hits * ((int)part->len - 1);
  int *out = arena_alloc(&m->arena, (size_t)size * sizeof *out), k = 0;
  for (int i = 0; i < *n; i++) {
    if (tag__abs(list[i]) != tag) {
      out[k++] = list[i];
      continue;
    }
    for (size_t j = 0; j < part->len; j++) out[k++] = list[i] > 0 ? part->data[j] : -part->data[part->len - 1 - j];
  }
  *n = size;
  return out;
}

static void replace_in_lists(Model *m, int tag, const IntVec *part)
{
  for (uint32_t s = 0; s < m->face.used; s++) {
    Face *f = table__slot(&m->face, s);
    if (f->tag == DEAD_TAG) continue;
    model__forget_face(m, f);
    face__count_uses(m, f, -1);
    vec_push(&m->dirty[2], f->tag);
  }
  Table *both[2] = {&m->loop, &m->hidden};
  for (int k = 0; k < 2; k++)
    for (uint32_t s = 0; s < both[k]->used; s++) {
      Loop *l = table__slot(both[k], s);
      if (l->tag == DEAD_TAG) continue;
      int n = l->ncurve;
      int *list = replaced(m, l->curve, &n, tag, part);
      if (!list) continue;
      for (int i = 0; l->sorted && i < l->ncurve; i++) model_curve(m, l->curve[i])->in_loops--;
      l->curve = list;
      l->ncurve = n;
      for (int i = 0; l->sorted && i < n; i++) model_curve(m, l->curve[i])->in_loops++;
    }
  for (uint32_t s = 0; s < m->face.used; s++) {
    Face *f = table__slot(&m->face, s);
    if (f->tag != DEAD_TAG) face__count_uses(m, f, 1);
  }
  for (size_t i = 0; i < m->group[1].len; i++) {
    IntVec *e = &m->group[1].data[i]->entity;
    int n = (int)e->len;
    int *list = replaced(m, e->data, &n, tag, part);
    if (!list) continue;
    vec_clear(e);
    for (int k = 0; k < n; k++) vec_push(e, list[k]);
  }
}

static bool is_closed(const Curve *c) { return c->npoint > 2 && c->point[0] == c->point[c->npoint - 1]; }

// Where to cut, ascending. The ends of an open curve are no cuts; the end of a closed one is.
static bool cuts_of(Model *m, const Curve *c, const int *point, size_t n, IntVec *at, SrcLoc loc, Diag *diag)
{
  for (size_t i = 0; i < n; i++) {
    int k = -1;
    for (int j = 0; j < c->npoint; j++)
      if (c->point[j] == point[i]) k = j;
    if (k < 0) {
      diag_error(diag, loc, model_point(m, point[i]) ? "cannot split curve %d at point %d, which is none of its control points"
                                                     : "cannot split curve %d at point %d, which does not exist",
                 c->tag, point[i]);
      return false;
    }
    if (!is_closed(c) && (k == 0 || k == c->npoint - 1)) continue;
    size_t pos = 0;
    while (pos < at->len && at->data[pos] < k) pos++;
    if (pos < at->len && at->data[pos] == k) continue;
    vec_push(at, k);
    memmove(at->data + pos + 1, at->data + pos, (at->len - 1 - pos) * sizeof(int));
    at->data[pos] = k;
  }
  return true;
}

// The curve through control points `from` to `to`; beyond the last, round again.
static void put_part(Model *m, const Curve *c, int from, int to, IntVec *run, IntVec *part, SrcLoc loc)
{
  vec_clear(run);
  for (int k = from; k <= to; k++) vec_push(run, c->point[k < c->npoint ? k : k - (c->npoint - 1)]);
  CurveType type = c->type == CURVE_POLYLINE && run->len == 2 ? CURVE_LINE : c->type;
  int t = model__next_tag(m, KIND_CURVE);
  curve__make(m, t, type, run->data, (int)run->len, run->data[0], vec_last(run), loc);
  vec_push(part, t);
}

bool model_split_curve(Model *m, int tag, const int *point, size_t n, IntVec *out, SrcLoc loc, Diag *diag)
{
  if (m->moved.len) model__restore_points(m);
  tag = tag__abs(tag);
  Curve *c = model_curve(m, tag);
  if (!c) {
    if (!model__refused(m, KIND_CURVE, tag)) diag_error(diag, loc, "cannot split curve %d: it does not exist", tag);
    return false;
  }
  if (c->type != CURVE_LINE && c->type != CURVE_POLYLINE && c->type != CURVE_SPLINE && c->type != CURVE_BSPLINE) {
    diag_error(diag, loc, "cannot split curve %d: only lines, splines and B-splines can be split", tag);
    return false;
  }
  IntVec at = {0}, part = {0};
  bool good = cuts_of(m, c, point, n, &at, loc, diag);
  if (good && at.len) {
    bool closed = is_closed(c);
    IntVec run = {0};
    if (!closed) {
      vec_push(&at, c->npoint - 1);
      put_part(m, c, 0, at.data[0], &run, &part, loc);
    }
    for (size_t i = 0; i + 1 < at.len; i++) put_part(m, c, at.data[i], at.data[i + 1], &run, &part, loc);
    if (closed) put_part(m, c, vec_last(&at), at.data[0] + c->npoint - 1, &run, &part, loc);
    vec_free(&run);
    replace_in_lists(m, tag, &part);
    curve__drop(m, tag);
    for (size_t i = 0; i < part.len; i++) vec_push(out, part.data[i]);
  }
  vec_free(&at);
  vec_free(&part);
  return good;
}
