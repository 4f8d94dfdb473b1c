// split.c - curves cut in parts, at control points or anywhere
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/curve_int.h"

// Put `part` (head to tail) in the place of curve `tag` in a list of signed tags. Returns the new list in the arena.
static int *replaced(Model *m, const int *list, int *n, int tag, const IntVec *part)
{
  int hits = 0;
  for (int i = 0; i < *n; i++) hits += tag__abs(list[i]) == tag;
  if (!hits) return NULL;
  int size = *n + hits * ((int)part->len - 1);
  int *out = arena_alloc(&m->arena, (size_t)MAX(size, 1) * sizeof *out), k = 0;
  for (int i = 0; i < *n; i++) {
    if (tag__abs(list[i]) != tag) {
      out[k++] = list[i];
      continue;
    }
    for (size_t j = 0; j < part->len; j++) out[k++] = list[i] >= 0 ? part->data[j] : -part->data[part->len - 1 - j];
  }
  *n = size;
  return out;
}

static bool replace_in_vec(Model *m, IntVec *v, int tag, const IntVec *part)
{
  int n = (int)v->len;
  int *list = replaced(m, v->data, &n, tag, part);
  if (!list) return false;
  vec_clear(v);
  for (int k = 0; k < n; k++) vec_push(v, list[k]);
  return true;
}

void model__replace_curve(Model *m, int tag, const IntVec *part)
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
    if (f->tag == DEAD_TAG) continue;
    face__count_uses(m, f, 1);
    replace_in_vec(m, &f->embedded_curves, tag, part);
  }
  for (size_t i = 0; i < m->group[1].len; i++) replace_in_vec(m, &m->group[1].data[i]->entity, tag, part);
}

static bool is_closed(const Curve *c) { return c->npoint > 2 && c->point[0] == c->point[c->npoint - 1]; }

// Where to cut, ascending. The ends of an open curve are no cuts; the end of a closed one is. Points that are not on the curve are
// passed over.
static void cuts_of(const Curve *c, const int *point, size_t n, IntVec *at, SrcLoc loc, Diag *diag)
{
  for (size_t i = 0; i < n; i++) {
    int k = -1;
    for (int j = 0; j < c->npoint; j++)
      if (c->point[j] == point[i]) k = j;
    if (k < 0) {
      diag_warning(diag, loc, "cannot split curve %d at point %d, which is none of its control points", c->tag, point[i]);
      continue;
    }
    if (!is_closed(c) && (k == 0 || k == c->npoint - 1)) continue;
    size_t pos = 0;
    while (pos < at->len && at->data[pos] < k) pos++;
    if (pos < at->len && at->data[pos] == k) continue;
    vec_push(at, k);
    memmove(at->data + pos + 1, at->data + pos, (at->len - 1 - pos) * sizeof(int));
    at->data[pos] = k;
  }
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
  model__unprepare(m);
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
  cuts_of(c, point, n, &at, loc, diag);
  bool closed = is_closed(c) && at.len; // a closed curve without a cut stays as it is, with a new number
  IntVec run = {0};
  if (!closed) {
    vec_push(&at, c->npoint - 1);
    put_part(m, c, 0, at.data[0], &run, &part, loc);
  }
  for (size_t i = 0; i + 1 < at.len; i++) put_part(m, c, at.data[i], at.data[i + 1], &run, &part, loc);
  if (closed) put_part(m, c, vec_last(&at), at.data[0] + c->npoint - 1, &run, &part, loc);
  model__replace_curve(m, tag, &part);
  curve__drop(m, tag);
  for (size_t i = 0; i < part.len; i++) vec_push(out, part.data[i]);
  vec_free(&run);
  vec_free(&at);
  vec_free(&part);
  return true;
}

// ---- anywhere -----------------------------------------------------------------------------------------------------------

Pieces *pieces__copy(Model *m, const Pieces *p, bool back)
{
  size_t n = (size_t)p->npiece * (size_t)(p->degree + 1), k = (size_t)p->npiece + 1;
  Pieces *q = arena_dup(&m->arena, p, sizeof *p);
  q->knot = arena_dup(&m->arena, p->knot, k * sizeof *p->knot);
  q->control = arena_dup(&m->arena, p->control, n * sizeof *p->control);
  for (size_t i = 0; back && i < k; i++) q->knot[i] = 1 - p->knot[k - 1 - i];
  for (size_t i = 0; back && i < n; i++) q->control[i] = p->control[n - 1 - i];
  return q;
}

// The part [s0, s1] of a Bezier piece: de Casteljau cut at s1, then at s0.
static void bezier_part(const Vec3 *b, int degree, double s0, double s1, Vec3 *out)
{
  memcpy(out, b, (size_t)(degree + 1) * sizeof *out);
  for (int r = 1; s1 < 1 && r <= degree; r++)
    for (int i = degree; i >= r; i--) out[i] = vec3_add(out[i - 1], vec3_scale(s1, vec3_sub(out[i], out[i - 1])));
  double t = s1 > 0 ? s0 / s1 : 0;
  for (int r = 1; t > 0 && r <= degree; r++)
    for (int i = 0; i <= degree - r; i++) out[i] = vec3_add(out[i], vec3_scale(t, vec3_sub(out[i + 1], out[i])));
}

Pieces *pieces__between(Model *m, const CurveShape *h, double a, double b)
{
  double s0, s1, width;
  int i0 = shape__piece(h, a, &s0, &width), i1 = shape__piece(h, b, &s1, &width);
  if (s1 <= 0 && i1 > i0) i1--, s1 = 1;
  if (s0 >= 1 && i0 < i1) i0++, s0 = 0;
  size_t per = (size_t)h->degree + 1;
  Pieces *p = arena_alloc(&m->arena, sizeof *p);
  p->degree = h->degree;
  p->npiece = i1 - i0 + 1;
  p->smooth = false; // that is not looked into
  p->knot = arena_alloc(&m->arena, ((size_t)p->npiece + 1) * sizeof *p->knot);
  p->control = arena_alloc(&m->arena, (size_t)p->npiece * per * sizeof *p->control);
  for (int i = i0; i <= i1; i++) {
    p->knot[i - i0] = i == i0 ? 0 : (h->knot[i] - a) / (b - a);
    bezier_part(shape__control(h, i), h->degree, i == i0 ? s0 : 0, i == i1 ? s1 : 1, p->control + (size_t)(i - i0) * per);
  }
  p->knot[p->npiece] = 1;
  return p;
}

// What is left of a transfinite curve's counts on a part that has a share of its length.
static void share_count(Curve *part, const Curve *whole, double share)
{
  if (!whole->transfinite) return;
  part->transfinite = MAX((int)((whole->transfinite - 1) * share + 0.5), 1) + 1;
  part->law = whole->law == LAW_PROGRESSION ? LAW_PROGRESSION : LAW_UNIFORM;
  part->coef = whole->law == LAW_PROGRESSION ? whole->coef : 1;
}

// Give a new curve between two points the shape between two parameters; lines have none.
static void take_part(Model *m, Curve *part, const CurveShape *h, double a, double b)
{
  if (!h) return;
  if (h->kind == SHAPE_PIECES) {
    part->pieces = pieces__between(m, h, a, b);
    if (part->pieces->degree == 1 && part->pieces->npiece == 1) part->pieces = NULL, part->type = CURVE_LINE;
    return;
  }
  Arc arc = {h->centre, h->a, h->b, h->t0 + a * (h->t1 - h->t0), h->t0 + b * (h->t1 - h->t0)};
  part->arc = arena_dup(&m->arena, &arc, sizeof arc);
}

static double length_between(const Model *m, const Curve *c, double a, double b)
{
  double sum = 0;
  Vec3 p = curve_point(m, c, a);
  for (int i = 1; i <= 16; i++) {
    Vec3 q = curve_point(m, c, a + (b - a) * i / 16);
    sum += vec3_distance(p, q);
    p = q;
  }
  return sum;
}

// Nobody is a copy of the curve any more, nor it of another.
static void drop_copies(Model *m, Curve *c)
{
  for (uint32_t s = 0; s < m->curve.used; s++) {
    Curve *d = table__slot(&m->curve, s);
    if (d->tag == DEAD_TAG) continue;
    if (tag__abs(d->periodic_master) == c->tag) d->periodic_master = 0;
    if (tag__abs(d->copy_of) == c->tag) d->copy_of = 0;
  }
  c->periodic_master = c->copy_of = c->extruded_point = 0;
  c->affine = NULL;
  c->layers.n = 0;
}

// A closed B-spline's own point stays where it was moved to: at the start of the curve, which is an end of a part now.
static void keep_moved(Model *m, int point)
{
  for (size_t i = 0; i < m->moved.len; i++)
    if (m->moved.data[i].tag == point) m->moved.data[i--] = vec_pop(&m->moved);
}

void model_split_curve_at(Model *m, int tag, const CurveCut *cut, size_t n, IntVec *part)
{
  Curve *c = model_curve(m, tag), whole = *c;
  const CurveShape *h = c->shape;
  drop_copies(m, c);
  keep_moved(m, whole.begin);
  IntVec made = {0};
  double total = length_between(m, &whole, 0, 1);
  for (size_t i = 0; i <= n; i++) {
    double a = i ? cut[i - 1].u : 0, b = i < n ? cut[i].u : 1;
    int ends[2] = {i ? cut[i - 1].point : whole.begin, i < n ? cut[i].point : whole.end};
    int t = i ? model__next_tag(m, KIND_CURVE) : tag;
    if (i == 0) {
      c->shape = NULL; // the parts are cut from it; released below
      curve__drop(m, tag);
    }
    Curve *d = curve__make(m, t, whole.type, ends, 2, ends[0], ends[1], whole.loc);
    take_part(m, d, h, a, b);
    if (i == 0) d->uses = whole.uses, d->in_loops = whole.in_loops;
    share_count(d, &whole, total > 0 ? length_between(m, &whole, a, b) / total : 1);
    d->reverse_mesh = whole.reverse_mesh;
    d->compound = whole.compound;
    vec_push(&made, t);
  }
  whole.shape = (void *)h;
  curve__release(&whole);
  model__replace_curve(m, tag, &made);
  for (size_t i = 0; i < made.len; i++) vec_push(part, made.data[i]);
  vec_free(&made);
}

void model_forget_curve(Model *m, int tag)
{
  const IntVec none = {0};
  for (size_t i = 0; i < m->group[1].len; i++) replace_in_vec(m, &m->group[1].data[i]->entity, tag, &none);
  model_delete(m, &(Shape){1, tag}, 1, false);
}

void model_forget_face(Model *m, int tag)
{
  const IntVec none = {0};
  for (size_t i = 0; i < m->group[2].len; i++) replace_in_vec(m, &m->group[2].data[i]->entity, tag, &none);
  model_delete(m, &(Shape){2, tag}, 1, false);
}

static void copy_tags(IntVec *to, const IntVec *from)
{
  vec_clear(to);
  for (size_t i = 0; i < from->len; i++) vec_push(to, from->data[i]);
}

void model_set_face_boundary(Model *m, int face, const FaceBoundary *b)
{
  Face *f = model_face(m, face);
  model__forget_face(m, f);
  face__count_uses(m, f, -1);
  int loop = loop__make_hidden(m, b->bounds.data, (int)b->bounds.len, f->loc);
  f->loop = arena_dup(&m->arena, &loop, sizeof loop);
  f->nloop = 1;
  face__count_uses(m, f, 1);
  if (f->embedded_points.len + f->embedded_curves.len) m->nembedded--;
  copy_tags(&f->embedded_curves, &b->curves);
  copy_tags(&f->embedded_points, &b->points);
  if (f->embedded_points.len + f->embedded_curves.len) m->nembedded++;
  vec_push(&m->dirty[2], f->tag);
}

int model_add_face_part(Model *m, int face, const FaceBoundary *b)
{
  const Face *f = model_face(m, face);
  int loop = loop__make_hidden(m, b->bounds.data, (int)b->bounds.len, f->loc);
  Face *g = face__make(m, model__next_tag(m, KIND_FACE), f->type, &loop, 1, f->loc);
  face__copy_meshing(g, f);
  g->reverse_mesh = f->reverse_mesh;
  g->origin = f->origin, g->axis_u = f->axis_u, g->axis_v = f->axis_v, g->normal = f->normal;
  g->planar = f->planar;
  copy_tags(&g->embedded_curves, &b->curves);
  copy_tags(&g->embedded_points, &b->points);
  if (g->embedded_points.len + g->embedded_curves.len) m->nembedded++;
  for (size_t i = 0; i < m->group[2].len; i++) {
    IntVec *e = &m->group[2].data[i]->entity;
    for (size_t k = 0, n = e->len; k < n; k++)
      if (tag__abs(e->data[k]) == face) vec_push(e, e->data[k] < 0 ? -g->tag : g->tag);
  }
  return g->tag;
}
