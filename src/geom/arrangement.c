// arrangement.c - cycles and faces of curves in the plane, once they are cut
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/arrangement_int.h"

// ---- cycles -----------------------------------------------------------------------------------------------------------------

typedef struct {
  uint32_t half;
  double angle, bend;
} Leaving;

// Direction and signed curvature (to the left) with which a half-edge leaves its node.
static Leaving leaving(const ArrBuilder *b, uint32_t half)
{
  const ArrEdge *e = &b->a->edge.data[half / 2];
  const ArrCurve *c = &b->curve[e->curve];
  bool back = half & 1;
  Leaving l = {half, 0, 0};
  Vec2 d;
  if (c->kind == ARR_ARC) {
    double w = c->t1 - c->t0, t = c->t0 + w * (back ? e->u1 : e->u0), sign = (w < 0) == back ? 1 : -1;
    d = vec2_scale(sign, vec2_sub(vec2_scale(cos(t), c->b), vec2_scale(sin(t), c->a)));
    Vec2 dd = vec2_scale(-1, vec2_add(vec2_scale(cos(t), c->a), vec2_scale(sin(t), c->b)));
    double speed = vec2_length(d);
    l.bend = vec2_cross(d, dd) / (speed * speed * speed);
  } else if (c->kind == ARR_LINE) {
    d = back ? vec2_sub(c->p, c->q) : vec2_sub(c->q, c->p);
  } else {
    Vec2 dd, ignored, p = arr__spline_at(c, back ? e->u1 : e->u0, &d, &dd);
    double speed = vec2_length(d);
    if (back) d = vec2_scale(-1, d);
    if (!(speed > 0)) { // control points that coincide
      double w = (e->u1 - e->u0) / 64;
      d = vec2_sub(arr__spline_at(c, back ? e->u1 - w : e->u0 + w, &ignored, &dd), p);
      speed = INFINITY;
    }
    l.bend = vec2_cross(d, dd) / (speed * speed * speed);
  }
  l.angle = atan2(d.y, d.x);
  return l;
}

static int compare_leaving(const void *x, const void *y)
{
  const Leaving *a = x, *b = y;
  if (a->angle != b->angle) return a->angle < b->angle ? -1 : 1;
  return (a->half > b->half) - (a->half < b->half);
}

static int compare_bend(const void *x, const void *y)
{
  const Leaving *a = x, *b = y;
  if (a->bend != b->bend) return a->bend < b->bend ? -1 : 1;
  return (a->half > b->half) - (a->half < b->half);
}

// Counter-clockwise round the node: by angle, and by bend where curves leave in one direction.
static void sort_leaving(Leaving *l, size_t n)
{
  const double close = 1e-6;
  for (size_t i = 0; i < n; i++)
    if (l[i].angle > PI - close) l[i].angle -= 2 * PI; // so that no bundle is torn apart at the seam
  qsort(l, n, sizeof *l, compare_leaving);
  for (size_t i = 0, j; i < n; i = j) {
    for (j = i + 1; j < n && l[j].angle - l[j - 1].angle <= close; j++) {}
    if (j > i + 1) qsort(l + i, j - i, sizeof *l, compare_bend);
  }
}

static void link_cycles(ArrBuilder *b)
{
  Arrangement *a = b->a;
  size_t nh = 2 * a->edge.len;
  U32Vec start = {0};
  vec_resize(&start, a->node.len + 1);
  for (size_t i = 0; i <= a->node.len; i++) start.data[i] = 0;
  for (size_t e = 0; e < a->edge.len; e++) {
    start.data[a->edge.data[e].from + 1]++;
    start.data[a->edge.data[e].to + 1]++;
  }
  for (size_t i = 0; i < a->node.len; i++) start.data[i + 1] += start.data[i];
  Leaving *all = mem_alloc((nh + 1) * sizeof *all);
  uint32_t *fill = mem_alloc((a->node.len + 1) * sizeof *fill);
  for (size_t i = 0; i < a->node.len; i++) fill[i] = start.data[i];
  for (uint32_t h = 0; h < nh; h++) all[fill[h & 1 ? a->edge.data[h / 2].to : a->edge.data[h / 2].from]++] = leaving(b, h);
  vec_resize(&a->next, nh);
  for (size_t v = 0; v < a->node.len; v++) {
    Leaving *l = all + start.data[v];
    size_t n = start.data[v + 1] - start.data[v];
    sort_leaving(l, n);
    for (size_t i = 0; i < n; i++) a->next.data[l[i].half ^ 1] = l[(i + n - 1) % n].half;
  }
  free(fill);
  free(all);
  vec_free(&start);
}

enum { CHORDS = 512 }; // of a full turn, where curves are followed by chords

static size_t steps_of(const ArrCurve *c, const ArrEdge *e)
{
  if (c->kind == ARR_LINE) return 1;
  if (c->kind == ARR_SPLINE) return 1 + (size_t)((double)(c->npoint - 1) * (e->u1 - e->u0));
  return 4 + (size_t)(CHORDS * fabs(c->t1 - c->t0) * (e->u1 - e->u0) / (2 * PI));
}

static double edge_area(const ArrCurve *c, const ArrEdge *e)
{
  Vec2 p = arr_curve_at(c, e->u0), q = arr_curve_at(c, e->u1);
  if (c->kind == ARR_LINE) return vec2_cross(p, q) / 2;
  if (c->kind == ARR_ARC)
    return (vec2_cross(c->c, vec2_sub(q, p)) + vec2_cross(c->a, c->b) * (c->t1 - c->t0) * (e->u1 - e->u0)) / 2;
  return arr__spline_area(c, e->u0, e->u1) / 2;
}

static void trace_cycles(ArrBuilder *b)
{
  Arrangement *a = b->a;
  vec_resize(&a->cycle, a->next.len);
  for (size_t h = 0; h < a->next.len; h++) a->cycle.data[h] = NONE;
  for (uint32_t h = 0; h < a->next.len; h++) {
    if (a->cycle.data[h] != NONE) continue;
    double area = 0;
    uint32_t id = (uint32_t)a->first.len, g = h;
    do {
      const ArrEdge *e = &a->edge.data[g / 2];
      a->cycle.data[g] = id;
      area += (g & 1 ? -1 : 1) * edge_area(&b->curve[e->curve], e);
      g = a->next.data[g];
    } while (g != h);
    vec_push(&a->first, h);
    vec_push(&a->area, area);
  }
}

// ---- faces --------------------------------------------------------------------------------------------------------------------

// Turns of a cycle round p, by chords.
static double winding(const ArrBuilder *b, uint32_t cycle, Vec2 p)
{
  const Arrangement *a = b->a;
  double sum = 0;
  uint32_t h = a->first.data[cycle];
  do {
    const ArrEdge *e = &a->edge.data[h / 2];
    const ArrCurve *c = &b->curve[e->curve];
    size_t n = steps_of(c, e);
    Vec2 from = vec2_sub(arr_curve_at(c, e->u0), p);
    for (size_t i = 1; i <= n; i++) {
      Vec2 to = vec2_sub(arr_curve_at(c, e->u0 + (e->u1 - e->u0) * (double)i / (double)n), p);
      sum += (h & 1 ? -1 : 1) * atan2(vec2_cross(from, to), vec2_dot(from, to));
      from = to;
    }
    h = a->next.data[h];
  } while (h != a->first.data[cycle]);
  return sum / (2 * PI);
}

static uint32_t find(uint32_t *parent, uint32_t i)
{
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

static ArrBox cycle_box(const ArrBuilder *b, uint32_t cycle)
{
  const Arrangement *a = b->a;
  ArrBox box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  uint32_t h = a->first.data[cycle];
  do {
    ArrBox x = arr__box(&b->curve[a->edge.data[h / 2].curve], b->tol);
    for (int k = 0; k < 2; k++) {
      box.lo[k] = fmin(box.lo[k], x.lo[k]);
      box.hi[k] = fmax(box.hi[k], x.hi[k]);
    }
    h = a->next.data[h];
  } while (h != a->first.data[cycle]);
  return box;
}

static bool outside(const ArrBox *box, Vec2 p) { return p.x < box->lo[0] || p.x > box->hi[0] || p.y < box->lo[1] || p.y > box->hi[1]; }

// Cycles that go round nothing belong to the smallest face around their component.
static void nest(ArrBuilder *b)
{
  Arrangement *a = b->a;
  uint32_t *parent = mem_alloc((a->node.len + 1) * sizeof *parent);
  for (uint32_t i = 0; i < a->node.len; i++) parent[i] = i;
  for (size_t e = 0; e < a->edge.len; e++) parent[find(parent, a->edge.data[e].from)] = find(parent, a->edge.data[e].to);
  vec_resize(&a->face, a->first.len);
  a->nface = 1;
  double whole = 0;
  for (size_t k = 0; k < a->first.len; k++) whole = fmax(whole, fabs(a->area.data[k]));
  for (size_t k = 0; k < a->first.len; k++) a->face.data[k] = a->area.data[k] > 1e-14 * whole ? a->nface++ : 0;
  ArrBox *box = mem_alloc((a->first.len + 1) * sizeof *box);
  for (uint32_t k = 0; k < a->first.len; k++) box[k] = cycle_box(b, k);
  for (uint32_t k = 0; k < a->first.len; k++) {
    if (a->face.data[k]) continue;
    uint32_t v = a->edge.data[a->first.data[k] / 2].from, best = NONE;
    for (uint32_t o = 0; o < a->first.len; o++) {
      if (!(a->area.data[o] > 1e-14 * whole) || (best != NONE && a->area.data[o] >= a->area.data[best])) continue;
      if (outside(&box[o], a->node.data[v])) continue;
      if (find(parent, a->edge.data[a->first.data[o] / 2].from) == find(parent, v)) continue;
      if (winding(b, o, a->node.data[v]) > 0.5) best = o;
    }
    if (best != NONE) a->face.data[k] = a->face.data[best];
  }
  free(box);
  free(parent);
}

void arrangement_build(Arrangement *a, const ArrCurve *curve, size_t n, double tol)
{
  ArrBuilder b = {a, curve, n, tol, mem_zalloc((n + 1) * sizeof *b.cut), {0}};
  for (size_t i = 0; i < n; i++) {
    arr__node(&b, curve[i].p);
    arr__node(&b, curve[i].q);
  }
  for (size_t i = 0; i < n; i++) arr__widen_ends(&b, i);
  arr__intersect(&b);
  arr__make_edges(&b);
  link_cycles(&b);
  trace_cycles(&b);
  nest(&b);
  for (size_t i = 0; i < n; i++) vec_free(&b.cut[i]);
  free(b.cut);
  vec_free(&b.reach);
}

void arrangement_free(Arrangement *a)
{
  for (size_t i = 0; i < a->edge.len; i++) vec_free(&a->edge.data[i].also);
  vec_free(&a->node);
  vec_free(&a->edge);
  vec_free(&a->next);
  vec_free(&a->cycle);
  vec_free(&a->first);
  vec_free(&a->area);
  vec_free(&a->face);
}
