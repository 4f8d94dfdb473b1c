// boundary_layer_plan.c - chains of columns along the boundary of a face
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/boundary_layer_int.h"

#define PI 3.14159265358979323846

// ---- loops as runs of segments -------------------------------------------------------------------------------------------
typedef struct {
  uint32_t curve, from, to; // nodes `from` and `to` of the curve's mesh
  Vec2 a, b;
  const LayerField *field;  // or NULL
} Seg;
typedef Vec(Seg) SegVec;

static bool contains(const IntVec *v, int tag)
{
  for (size_t i = 0; i < v->len; i++)
    if (v->data[i] == tag) return true;
  return false;
}

static const LayerField *field_of(const Planner *p, const Face *f, int curve)
{
  for (size_t i = 0; i < p->b->nfield; i++) {
    const LayerField *lf = &p->b->field[i];
    if (lf->height.len && contains(&lf->curves, curve) && !contains(&lf->excluded, f->tag)) return lf;
  }
  return NULL;
}

static void add_curve_segments(const Planner *p, const Face *f, int tag, SegVec *seg)
{
  uint32_t k = mesh1d_index(p->curves, tag);
  const CurveMesh *cm = &p->curves->curve[k];
  const LayerField *lf = field_of(p, f, abs(tag));
  for (uint32_t i = 0; i + 1 < cm->n; i++) {
    uint32_t from = tag >= 0 ? i : cm->n - 1 - i, to = tag >= 0 ? i + 1 : cm->n - 2 - i;
    vec_push(seg, ((Seg){k, from, to, face_to_plane(f, cm->p[from]), face_to_plane(f, cm->p[to]), lf}));
  }
}

static double area_of(const SegVec *seg)
{
  double sum = 0;
  for (size_t i = 0; i < seg->len; i++) sum += vec2_cross(vec2_sub(seg->data[i].a, seg->data[0].a), vec2_sub(seg->data[i].b, seg->data[0].a));
  return sum;
}

static void turn_round(SegVec *seg)
{
  for (size_t i = 0; i < seg->len; i++) {
    Seg *s = &seg->data[i];
    *s = (Seg){s->curve, s->to, s->from, s->b, s->a, s->field};
  }
  for (size_t i = 0; i < seg->len / 2; i++) {
    Seg swap = seg->data[i];
    seg->data[i] = seg->data[seg->len - 1 - i];
    seg->data[seg->len - 1 - i] = swap;
  }
}

// ---- columns ---------------------------------------------------------------------------------------------------------
static Vec2 unit(Vec2 v)
{
  double l = vec2_length(v);
  return l > 0 ? vec2_scale(1 / l, v) : v;
}

static Vec2 left_of(Vec2 d) { return (Vec2){-d.y, d.x}; }
static Vec2 rotated(Vec2 v, double angle)
{
  double c = cos(angle), s = sin(angle);
  return (Vec2){c * v.x - s * v.y, s * v.x + c * v.y};
}

static int point_tag(const Planner *p, const Seg *s)
{
  const Curve *c = model_curve_at(p->m, s->curve);
  if (s->from == 0) return c->begin;
  return s->from + 1 == p->curves->curve[s->curve].n ? c->end : 0;
}

// Cells of a fan that turns by `angle` at the beginning of segment s: 0 if there is to be none.
static int wanted_cells(const Planner *p, const Seg *s, double angle)
{
  if (angle >= 0) return 0;
  int tag = point_tag(p, s);
  for (size_t i = 0; i < s->field->fans.len; i++)
    if (tag && s->field->fans.data[i] == tag) {
      double n = i < s->field->fan_size.len ? s->field->fan_size.data[i] : p->opt->Mesh_BoundaryLayerFanElements * -angle / PI;
      return n < 1 ? 1 : n > 1000 ? 1000 : (int)(n + 0.5);
    }
  if (angle > -150 * PI / 180) return 0;
  return (int)(p->opt->Mesh_BoundaryLayerFanElements * -angle / PI + 0.5) + 1;
}

static double first_at_point(const LayerField *f, int tag)
{
  for (size_t i = 0; i < f->sized.len; i++)
    if (f->sized.data[i] == tag) return f->first.data[i];
  return f->height.data[0];
}

// First height at a node of a curve: from end to end linear in the parameter.
static double first_at_node(const Planner *p, const LayerField *f, uint32_t curve, uint32_t node)
{
  if (!f->sized.len) return f->height.data[0];
  const Curve *c = model_curve_at(p->m, curve);
  double u = p->curves->curve[curve].u[node], a = first_at_point(f, c->begin), b = first_at_point(f, c->end);
  return u <= 0 ? a : u >= 1 ? b : a + u * (b - a);
}

static void push_column(const Planner *p, Chain *c, const Seg *s, bool at_end, Vec2 dir)
{
  uint32_t node = at_end ? s->to : s->from;
  vec_push(&c->col, ((Column){.curve = s->curve, .index = node, .base = at_end ? s->b : s->a, .dir = dir, .s = 1,
                              .first = first_at_node(p, c->field, s->curve, node), .on = NONE}));
}

// Where quadrangles are wanted two cells of the fan have one at its tip: their number is even, and two turn by less than 120 degrees.
static int fan_cells(const Planner *p, const Seg *s, double angle, bool quads)
{
  int n = wanted_cells(p, s, angle);
  if (!n || !quads) return n;
  n = MAX(n, (int)ceil(-angle / (PI / 3)));
  return n + n % 2;
}

// Columns at the node between two layered segments.
static void add_inner(const Planner *p, Chain *c, const Seg *before, const Seg *s)
{
  Vec2 d = unit(vec2_sub(before->b, before->a)), e = unit(vec2_sub(s->b, s->a));
  double angle = atan2(vec2_cross(d, e), vec2_dot(d, e));
  if (angle > PI - 1e-9) angle = -PI; // the tip of a slit
  int fan = fan_cells(p, s, angle, c->quads);
  if (fan) {
    for (int k = 0; k <= fan; k++) push_column(p, c, s, false, k == fan ? left_of(e) : rotated(left_of(d), angle * k / fan));
    return;
  }
  Vec2 mean = unit(vec2_add(left_of(d), left_of(e)));
  double share = fmax(vec2_dot(mean, left_of(d)), 0.05);
  push_column(p, c, s, false, vec2_scale(1 / share, mean));
}

static bool may_change(const Planner *p, const Curve *c)
{
  if (c->transfinite || c->periodic_master || c->copy_of || c->layers.n || c->compound > 0) return false;
  for (size_t k = 0; k < model_curves(p->m); k++) {
    const Curve *o = model_curve_at(p->m, k);
    if (abs(o->periodic_master) == c->tag || abs(o->copy_of) == c->tag) return false;
  }
  return true;
}

// The end column of an open chain at node q, where the layered segment leaves in direction `along` (into the chain) with the face
// on the side of `normal`; `next` is the boundary segment that goes on from there, in direction `away` from q.
static void set_end(const Planner *p, Chain *c, Column *k, Vec2 along, Vec2 normal, const Seg *next, Vec2 away, uint32_t at)
{
  double angle = atan2(vec2_dot(away, normal), vec2_dot(away, along)); // inside the face, from the layer to what goes on
  if (angle < -0.02) angle += 2 * PI;
  const Curve *curve = model_curve_at(p->m, next->curve);
  const double deg = PI / 180;
  if (!next->field && angle > 25 * deg && angle < 155 * deg && curve_is_straight(p->m, curve) && may_change(p, curve)) {
    k->on = next->curve;
    k->on_end = at != 0;
    k->dir = vec2_scale(1 / sin(angle), away);
    double room = 0.4 * curve_length(p->m, curve);
    k->s = fmin(1, room / (chain__thickness(c) * vec2_length(k->dir)));
  } else if (angle >= 150 * deg) {
    k->open = true;
    k->dir = normal;
  } else if (c->quads && angle > 50 * deg) { // halfway: the corner between layers and curve is left to the rest
    k->open = true;
    k->dir = vec2_add(normal, vec2_scale(1 / tan(angle / 2), along));
  } else {
    k->collapsed = true;
    k->s = 0;
  }
}

static void finish_open(const Planner *p, Chain *c, const SegVec *seg, size_t first, size_t last)
{
  size_t n = seg->len;
  const Seg *s = &seg->data[first], *e = &seg->data[last % n];
  const Seg *before = &seg->data[(first + n - 1) % n], *after = &seg->data[(last + 1) % n];
  Vec2 d = unit(vec2_sub(s->b, s->a)), g = unit(vec2_sub(e->b, e->a));
  set_end(p, c, &c->col.data[0], d, left_of(d), before, unit(vec2_sub(before->a, before->b)), before->to);
  set_end(p, c, &vec_last(&c->col), vec2_scale(-1, g), left_of(g), after, unit(vec2_sub(after->b, after->a)), after->from);
}

// Chains of one loop; segment i of seg goes to segment i + 1.
static void add_chains(const Planner *p, FaceLayers *f, const SegVec *seg)
{
  size_t n = seg->len, start = n;
  for (size_t i = 0; i < n && start == n; i++)
    if (seg->data[i].field && seg->data[(i + n - 1) % n].field != seg->data[i].field) start = i;
  if (start == n) { // one field or none all round
    if (!n || !seg->data[0].field) return;
    Chain c = {.closed = true, .quads = f->quads, .field = seg->data[0].field};
    for (size_t i = 0; i < n; i++) add_inner(p, &c, &seg->data[(i + n - 1) % n], &seg->data[i]);
    vec_push(&f->chain, c);
    return;
  }
  for (size_t i = start; i < start + n;) {
    const LayerField *lf = seg->data[i % n].field;
    size_t j = i;
    while (j < start + n && seg->data[j % n].field == lf) j++;
    if (lf) {
      Chain c = {.quads = f->quads, .field = lf};
      push_column(p, &c, &seg->data[i % n], false, (Vec2){0, 0});
      for (size_t k = i + 1; k < j; k++) add_inner(p, &c, &seg->data[(k - 1) % n], &seg->data[k % n]);
      push_column(p, &c, &seg->data[(j - 1) % n], true, (Vec2){0, 0});
      finish_open(p, &c, seg, i % n, j - 1);
      vec_push(&f->chain, c);
    }
    i = j;
  }
}

static void add_walls(FaceLayers *f, const SegVec *seg)
{
  for (size_t i = 0; i < seg->len; i++) {
    const Seg *s = &seg->data[i];
    vec_push(&f->wall, ((Wall){s->a, s->b, s->curve, s->field != NULL}));
  }
}

static void add_embedded_points(const Planner *p, FaceLayers *f, const Face *face)
{
  for (size_t i = 0; i < face->embedded_points.len; i++) {
    const Point *q = model_point(p->m, face->embedded_points.data[i]);
    if (!q) continue;
    Vec2 at = face_to_plane(face, q->xyz);
    vec_push(&f->wall, ((Wall){at, at, NONE, false}));
  }
}

// ---- walks round the face -------------------------------------------------------------------------------------------------
// Loops may touch, and embedded curves, which have the face on both sides, may begin on them: at a point where several segments
// leave, the walk with the face on its left goes on along the first one to the right of the way back.
typedef struct {
  SegVec seg;      // of all loops, each with the face on its left
  IntVec start;    // point tag where it begins, 0 inside a curve
  U32Vec next;
} Walk;

static void add_ring(const Planner *p, Walk *w, const SegVec *seg)
{
  size_t first = w->seg.len;
  for (size_t i = 0; i < seg->len; i++) {
    vec_push(&w->seg, seg->data[i]);
    vec_push(&w->start, point_tag(p, &seg->data[i]));
    vec_push(&w->next, (uint32_t)(first + (i + 1) % seg->len));
  }
}

// There and back again.
static void collect_embedded(const Planner *p, const Face *face, Walk *w)
{
  for (size_t i = 0; i < face->embedded_curves.len; i++) {
    SegVec seg = {0};
    add_curve_segments(p, face, face->embedded_curves.data[i], &seg);
    add_curve_segments(p, face, -face->embedded_curves.data[i], &seg);
    add_ring(p, w, &seg);
    vec_free(&seg);
  }
}

static void collect(const Planner *p, const Face *face, Walk *w)
{
  IntVec curve = {0}, start = {0};
  face_boundary(p->m, face, &curve, &start);
  for (size_t l = 0; l + 1 < start.len; l++) {
    SegVec seg = {0};
    for (int i = start.data[l]; i < start.data[l + 1]; i++) add_curve_segments(p, face, curve.data[i], &seg);
    double area = area_of(&seg);
    if (l == 0 ? area < 0 : area > 0) turn_round(&seg);
    add_ring(p, w, &seg);
    vec_free(&seg);
  }
  vec_free(&curve);
  vec_free(&start);
  collect_embedded(p, face, w);
}

// Angle from the way back along `in` clockwise to `out`, in (0, 2 pi].
static double clockwise(const Seg *in, const Seg *out)
{
  Vec2 back = vec2_sub(in->a, in->b), go = vec2_sub(out->b, out->a);
  double angle = -atan2(vec2_cross(back, go), vec2_dot(back, go));
  return angle > 1e-12 ? angle : angle + 2 * PI;
}

static void relink(const Walk *w, const U32Vec *out)
{
  U32Vec chosen = {0}, from = {0};
  for (uint32_t i = 0; i < w->next.len; i++) {
    bool here = false;
    for (size_t k = 0; k < out->len && !here; k++) here = w->next.data[i] == out->data[k];
    if (!here) continue;
    uint32_t best = out->data[0];
    for (size_t k = 1; k < out->len; k++)
      if (clockwise(&w->seg.data[i], &w->seg.data[out->data[k]]) < clockwise(&w->seg.data[i], &w->seg.data[best])) best = out->data[k];
    vec_push(&from, i);
    vec_push(&chosen, best);
  }
  bool distinct = true;
  for (size_t i = 0; i < chosen.len; i++)
    for (size_t k = 0; k < i; k++) distinct = distinct && chosen.data[i] != chosen.data[k];
  for (size_t i = 0; i < chosen.len && distinct; i++) w->next.data[from.data[i]] = chosen.data[i];
  vec_free(&chosen);
  vec_free(&from);
}

static void relink_all(const Walk *w)
{
  for (uint32_t i = 0; i < w->start.len; i++) {
    U32Vec out = {0};
    bool first = w->start.data[i] != 0;
    for (uint32_t k = 0; k < w->start.len && first; k++) {
      if (w->start.data[k] != w->start.data[i]) continue;
      if (k < i) first = false; // done already
      vec_push(&out, k);
    }
    if (first && out.len > 1) relink(w, &out);
    vec_free(&out);
  }
}

void layers__plan_face(const Planner *p, FaceLayers *f, const Face *face)
{
  Walk w = {0};
  f->quads = face->recombine || p->opt->Mesh_RecombineAll;
  collect(p, face, &w);
  relink_all(&w);
  bool *seen = mem_zalloc(w.seg.len);
  for (uint32_t i = 0; i < w.seg.len; i++) {
    SegVec ring = {0};
    for (uint32_t k = i; !seen[k]; k = w.next.data[k]) {
      seen[k] = true;
      vec_push(&ring, w.seg.data[k]);
    }
    add_chains(p, f, &ring);
    vec_free(&ring);
  }
  add_walls(f, &w.seg);
  add_embedded_points(p, f, face);
  free(seen);
  vec_free(&w.seg);
  vec_free(&w.start);
  vec_free(&w.next);
}

bool layers__wanted(const Planner *p, const Face *face)
{
  if (!face->planar || face->united || face->transfinite || (face->extruded_curve && face->layers.n)) return false;
  IntVec curve = {0}, start = {0};
  bool found = false;
  face_boundary(p->m, face, &curve, &start);
  for (size_t i = 0; i < curve.len && !found; i++) found = field_of(p, face, abs(curve.data[i])) != NULL;
  for (size_t i = 0; i < face->embedded_curves.len && !found; i++) found = field_of(p, face, abs(face->embedded_curves.data[i])) != NULL;
  vec_free(&curve);
  vec_free(&start);
  return found;
}
