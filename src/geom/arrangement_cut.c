// arrangement_cut.c - where curves in the plane meet, and the pieces between
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/arrangement_int.h"

// ---- curves -------------------------------------------------------------------------------------------------------------

Vec2 arr_curve_at(const ArrCurve *c, double u)
{
  if (u <= 0) return c->p;
  if (u >= 1) return c->q;
  if (c->kind == ARR_LINE) return vec2_add(c->p, vec2_scale(u, vec2_sub(c->q, c->p)));
  if (c->kind == ARR_ARC) {
    double t = c->t0 + u * (c->t1 - c->t0);
    return vec2_add(c->c, vec2_add(vec2_scale(cos(t), c->a), vec2_scale(sin(t), c->b)));
  }
  Vec2 d1, d2;
  return arr__spline_at(c, u, &d1, &d2);
}

void arr__slope(const ArrCurve *c, double u, Vec2 *d1)
{
  Vec2 d2;
  if (c->kind == ARR_LINE)
    *d1 = vec2_sub(c->q, c->p);
  else if (c->kind == ARR_SPLINE)
    (void)arr__spline_at(c, u, d1, &d2);
  else {
    double w = c->t1 - c->t0, t = c->t0 + u * w;
    *d1 = vec2_scale(w, vec2_sub(vec2_scale(cos(t), c->b), vec2_scale(sin(t), c->a)));
  }
}

// Coordinates of p in the axes of an arc; the arc's ellipse is x^2 + y^2 = 1.
static Vec2 in_axes(const ArrCurve *c, Vec2 p)
{
  Vec2 d = vec2_sub(p, c->c);
  double det = vec2_cross(c->a, c->b);
  return (Vec2){vec2_cross(d, c->b) / det, vec2_cross(c->a, d) / det};
}

// Parameter of angle t on an arc, between 0 and 1 if it is on it; an end is taken when it is nearer than the other side of a gap.
static double of_angle(const ArrCurve *c, double t)
{
  double w = c->t1 - c->t0, lo = fmin(c->t0, c->t1), hi = fmax(c->t0, c->t1);
  t -= 2 * PI * floor((t - lo) / (2 * PI));
  if (t > hi) t = t - hi < lo + 2 * PI - t ? hi : lo;
  return (t - c->t0) / w;
}

static double nearest(const ArrCurve *c, Vec2 p)
{
  if (c->kind == ARR_ARC) {
    Vec2 x = in_axes(c, p);
    return fmax(0, fmin(1, of_angle(c, atan2(x.y, x.x))));
  }
  if (c->kind == ARR_SPLINE) return arr__spline_nearest(c, p);
  Vec2 d = vec2_sub(c->q, c->p);
  double dd = vec2_dot(d, d);
  return dd > 0 ? fmax(0, fmin(1, vec2_dot(vec2_sub(p, c->p), d) / dd)) : 0;
}

ArrBox arr__box(const ArrCurve *c, double tol)
{
  ArrBox b = {{fmin(c->p.x, c->q.x), fmin(c->p.y, c->q.y)}, {fmax(c->p.x, c->q.x), fmax(c->p.y, c->q.y)}};
  if (c->kind == ARR_ARC) { // of the whole ellipse
    double x = hypot(c->a.x, c->b.x), y = hypot(c->a.y, c->b.y);
    b = (ArrBox){{c->c.x - x, c->c.y - y}, {c->c.x + x, c->c.y + y}};
  }
  for (int i = 0; c->kind == ARR_SPLINE && i < c->npiece * (c->degree + 1); i++) {
    b.lo[0] = fmin(b.lo[0], c->control[i].x), b.hi[0] = fmax(b.hi[0], c->control[i].x);
    b.lo[1] = fmin(b.lo[1], c->control[i].y), b.hi[1] = fmax(b.hi[1], c->control[i].y);
  }
  for (int k = 0; k < 2; k++) b.lo[k] -= tol, b.hi[k] += tol;
  return b;
}

static bool apart(const ArrBox *a, const ArrBox *b)
{
  return a->hi[0] < b->lo[0] || b->hi[0] < a->lo[0] || a->hi[1] < b->lo[1] || b->hi[1] < a->lo[1];
}

// ---- cuts -----------------------------------------------------------------------------------------------------------------

uint32_t arr__node(ArrBuilder *b, Vec2 p)
{
  for (size_t i = 0; i < b->a->node.len; i++)
    if (vec2_length(vec2_sub(b->a->node.data[i], p)) <= b->reach.data[i]) return (uint32_t)i;
  vec_push(&b->a->node, p);
  vec_push(&b->reach, b->tol);
  return (uint32_t)b->a->node.len - 1;
}

static void cut_at(ArrBuilder *b, size_t i, uint32_t node)
{
  ArrCuts *c = &b->cut[i];
  for (size_t k = 0; k < c->len; k++)
    if (c->data[k].node == node) return;
  vec_push(c, ((ArrCut){nearest(&b->curve[i], b->a->node.data[node]), node}));
}

void arr__meet(ArrBuilder *b, size_t i, size_t j, Vec2 p)
{
  uint32_t node = arr__node(b, p);
  cut_at(b, i, node);
  cut_at(b, j, node);
}

// Points of scripts have few digits: the ends of an arc may be a little off its ellipse. What meets it there meets it in its end.
void arr__widen_ends(ArrBuilder *b, size_t i)
{
  const ArrCurve *c = &b->curve[i];
  if (c->kind != ARR_ARC) return;
  double most = 1e-3 * vec2_length(vec2_sub(c->p, c->q));
  for (int end = 0; end < 2; end++) {
    double t = end ? c->t1 : c->t0;
    Vec2 p = end ? c->q : c->p, on = vec2_add(c->c, vec2_add(vec2_scale(cos(t), c->a), vec2_scale(sin(t), c->b)));
    double *reach = &b->reach.data[arr__node(b, p)];
    *reach = fmax(*reach, fmin(most, 4 * vec2_length(vec2_sub(on, p))));
  }
}

static bool within(double u, double slack) { return u >= -slack && u <= 1 + slack; }

static void line_line(ArrBuilder *b, size_t i, size_t j)
{
  const ArrCurve *x = &b->curve[i], *y = &b->curve[j];
  Vec2 d = vec2_sub(x->q, x->p), e = vec2_sub(y->q, y->p), r = vec2_sub(y->p, x->p);
  double det = vec2_cross(d, e), ld = vec2_length(d), le = vec2_length(e);
  if (fabs(det) <= 1e-12 * ld * le) return; // parallel: where they overlap an end of one is on the other
  double u = vec2_cross(r, e) / det, v = vec2_cross(r, d) / det;
  if (within(u, b->tol / ld) && within(v, b->tol / le)) arr__meet(b, i, j, arr_curve_at(x, u));
}

static void line_arc(ArrBuilder *b, size_t i, size_t j) // i the line
{
  const ArrCurve *l = &b->curve[i], *c = &b->curve[j];
  Vec2 d = vec2_sub(l->q, l->p), n = {-d.y, d.x};
  double ld = vec2_length(d);
  n = vec2_scale(1 / ld, n);
  double x = vec2_dot(n, c->a), y = vec2_dot(n, c->b), r = hypot(x, y), h = vec2_dot(n, vec2_sub(l->p, c->c));
  if (fabs(h) > r + b->tol) return;
  double middle = atan2(y, x), half = acos(fmax(-1, fmin(1, h / r)));
  bool touches = r - fabs(h) <= b->tol * 1e-3; // else two points, however close
  for (int k = 0; k < (touches ? 1 : 2); k++) {
    double t = touches ? middle + (h < 0 ? PI : 0) : middle + (k ? half : -half);
    double u = of_angle(c, t);
    Vec2 p = vec2_add(c->c, vec2_add(vec2_scale(cos(t), c->a), vec2_scale(sin(t), c->b)));
    if (vec2_length(vec2_sub(arr_curve_at(c, u), p)) > b->tol) continue; // off the arc
    if (within(vec2_dot(vec2_sub(p, l->p), d) / (ld * ld), b->tol / ld)) arr__meet(b, i, j, p);
  }
}

// How far x's point at u is off y's ellipse, in y's radii; with the sign of its side.
static double off_ellipse(const ArrCurve *x, const ArrCurve *y, double u)
{
  Vec2 p = in_axes(y, arr_curve_at(x, u));
  return sqrt(p.x * p.x + p.y * p.y) - 1;
}

static double root(const ArrCurve *x, const ArrCurve *y, double a, double b)
{
  double fa = off_ellipse(x, y, a);
  for (int k = 0; k < 60; k++) {
    double mid = (a + b) / 2, f = off_ellipse(x, y, mid);
    if ((f < 0) == (fa < 0))
      a = mid;
    else
      b = mid;
  }
  return (a + b) / 2;
}

// Where |off_ellipse| is least between a and b (it has one extremum there).
static double least(const ArrCurve *x, const ArrCurve *y, double a, double b)
{
  for (int k = 0; k < 80; k++) {
    double c = a + (b - a) / 3, d = b - (b - a) / 3;
    if (fabs(off_ellipse(x, y, c)) < fabs(off_ellipse(x, y, d)))
      b = d;
    else
      a = c;
  }
  return (a + b) / 2;
}

static void arc_arc(ArrBuilder *b, size_t i, size_t j)
{
  enum { SAMPLES = 720 };
  const ArrCurve *x = &b->curve[i], *y = &b->curve[j];
  double slack = b->tol / fmin(vec2_length(y->a), vec2_length(y->b)), f[SAMPLES + 1], most = 0;
  for (int k = 0; k <= SAMPLES; k++) {
    f[k] = off_ellipse(x, y, (double)k / SAMPLES);
    most = fmax(most, fabs(f[k]));
  }
  if (most <= slack) return; // of one ellipse: ends of one are on the other
  for (int k = 0; k < SAMPLES; k++) {
    double u0 = (double)k / SAMPLES, u1 = (double)(k + 1) / SAMPLES, u = NAN;
    if ((f[k] < 0) != (f[k + 1] < 0)) {
      u = root(x, y, u0, u1);
    } else if (k > 0 && fabs(f[k]) <= fabs(f[k - 1]) && fabs(f[k]) <= fabs(f[k + 1])) {
      u = least(x, y, u0 - 1.0 / SAMPLES, u1);
      if (fabs(off_ellipse(x, y, u)) > slack) u = NAN;
    }
    if (isnan(u)) continue;
    Vec2 p = arr_curve_at(x, u);
    if (vec2_length(vec2_sub(arr_curve_at(y, nearest(y, p)), p)) <= b->tol) arr__meet(b, i, j, p);
  }
}

void arr__intersect(ArrBuilder *b)
{
  ArrBox *box = mem_alloc((b->n + 1) * sizeof *box);
  for (size_t i = 0; i < b->n; i++) box[i] = arr__box(&b->curve[i], b->tol);
  for (size_t i = 0; i < b->n; i++)
    for (size_t j = i + 1; j < b->n; j++) {
      const ArrCurve *x = &b->curve[i], *y = &b->curve[j];
      if (apart(&box[i], &box[j]) || arr__same_spline(b, x, y)) continue;
      if (x->kind == ARR_SPLINE) {
        arr__spline_meets(b, i, j);
      } else if (y->kind == ARR_SPLINE) {
        arr__spline_meets(b, j, i);
      } else if (x->kind == ARR_LINE && y->kind == ARR_LINE) {
        line_line(b, i, j);
      } else if (x->kind == ARR_ARC && y->kind == ARR_ARC) {
        arc_arc(b, i, j);
      } else {
        line_arc(b, x->kind == ARR_LINE ? i : j, x->kind == ARR_LINE ? j : i);
      }
    }
  // nodes on curves: ends that touch, and overlaps
  for (size_t i = 0; i < b->n; i++)
    for (uint32_t v = 0; v < b->a->node.len; v++) {
      Vec2 p = b->a->node.data[v];
      if (p.x < box[i].lo[0] || p.x > box[i].hi[0] || p.y < box[i].lo[1] || p.y > box[i].hi[1]) continue;
      double u = nearest(&b->curve[i], p);
      if (vec2_length(vec2_sub(arr_curve_at(&b->curve[i], u), p)) <= b->reach.data[v]) cut_at(b, i, v);
    }
  free(box);
}

static int compare_cuts(const void *x, const void *y)
{
  const ArrCut *a = x, *b = y;
  return a->u != b->u ? (a->u > b->u) - (a->u < b->u) : (a->node > b->node) - (a->node < b->node);
}

static void add_edge(ArrBuilder *b, ArrEdge e)
{
  Vec2 mid = arr_curve_at(&b->curve[e.curve], (e.u0 + e.u1) / 2);
  for (size_t i = 0; i < b->a->edge.len; i++) {
    ArrEdge *o = &b->a->edge.data[i];
    bool same = (o->from == e.from && o->to == e.to) || (o->from == e.to && o->to == e.from);
    if (!same) continue;
    if (vec2_length(vec2_sub(arr_curve_at(&b->curve[o->curve], (o->u0 + o->u1) / 2), mid)) > 8 * b->tol) continue;
    vec_push(&o->also, e.curve);
    return;
  }
  vec_push(&b->a->edge, e);
}

void arr__make_edges(ArrBuilder *b)
{
  for (uint32_t i = 0; i < b->n; i++) {
    const ArrCurve *c = &b->curve[i];
    uint32_t from = arr__node(b, c->p), to = arr__node(b, c->q);
    ArrCuts *k = &b->cut[i];
    size_t n = 0;
    for (size_t j = 0; j < k->len; j++)
      if (k->data[j].node != from && k->data[j].node != to) k->data[n++] = k->data[j];
    k->len = n;
    if (n) qsort(k->data, n, sizeof *k->data, compare_cuts);
    ArrCut at = {0, from};
    for (size_t j = 0; j <= n; j++) {
      ArrCut next = j < n ? k->data[j] : (ArrCut){1, to};
      if (next.node != at.node || (n == 0 && c->kind != ARR_LINE))
        add_edge(b, (ArrEdge){.from = at.node, .to = next.node, .curve = i, .u0 = at.u, .u1 = next.u});
      at = next;
    }
  }
}
