// curve_measure.c - length, bounding box and nearest point of curves
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/curve_int.h"

#include <float.h>

#define PI 3.14159265358979323846

// ---- length -----------------------------------------------------------------------------------------------------------

// Gauss-Legendre with 10 nodes on [-1, 1] (the positive ones): exact to degree 19.
static const double gauss_x[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                                  0.9739065285171717};
static const double gauss_w[5] = {0.2955242247147529, 0.2692667193099964, 0.2190863625159820, 0.1494513491505806,
                                  0.0666713443086881};

typedef struct {
  const CurveShape *h;
  int piece;
} Speed;

// |x'| with respect to the parameter of the piece, or to the angle of an arc.
static double speed(const Speed *f, double s)
{
  const CurveShape *h = f->h;
  if (h->kind == SHAPE_ARC) return vec3_length(vec3_sub(vec3_scale(cos(s), h->b), vec3_scale(sin(s), h->a)));
  Vec3 d;
  bezier__at(shape__control(h, f->piece), h->degree, s, &d, NULL);
  return vec3_length(d);
}

static double gauss(const Speed *f, double a, double b)
{
  double mid = (a + b) / 2, half = (b - a) / 2, sum = 0;
  for (int i = 0; i < 5; i++) sum += gauss_w[i] * (speed(f, mid - half * gauss_x[i]) + speed(f, mid + half * gauss_x[i]));
  return sum * half;
}

// Halve until two halves agree with the whole.
static double integrate(const Speed *f, double a, double b, double whole, double tolerance, int depth)
{
  double mid = (a + b) / 2, left = gauss(f, a, mid), right = gauss(f, mid, b);
  if (depth == 0 || fabs(left + right - whole) <= tolerance) return left + right;
  return integrate(f, a, mid, left, tolerance, depth - 1) + integrate(f, mid, b, right, tolerance, depth - 1);
}

// What rounding leaves of the differences of the control points: no halving finds more.
static double rounding(const Vec3 *b, int degree)
{
  double size = 0;
  for (int i = 0; i <= degree; i++) size = fmax(size, fabs(b[i].x) + fabs(b[i].y) + fabs(b[i].z));
  return degree * DBL_EPSILON * size;
}

double curve_length(const Model *m, const Curve *c)
{
  const CurveShape *h = c->shape;
  if (!h || h->straight) return vec3_distance(curve__begin(m, c), curve__end(m, c));
  if (h->kind == SHAPE_ARC) {
    if (h->circle) return vec3_length(h->a) * fabs(h->t1 - h->t0);
    Speed f = {h, 0};
    double whole = gauss(&f, h->t0, h->t1);
    return fabs(integrate(&f, h->t0, h->t1, whole, 1e-14 * fabs(whole), 40));
  }
  double sum = 0, lost = 0; // Neumaier: thousands of pieces may add up
  for (int i = 0; i < h->npiece; i++) {
    Speed f = {h, i};
    const Vec3 *b = shape__control(h, i);
    double whole = h->degree == 1 ? 0 : gauss(&f, 0, 1);
    double tolerance = 1e-14 * whole + rounding(b, h->degree);
    double part = h->degree == 1 ? vec3_distance(b[0], b[1]) : integrate(&f, 0, 1, whole, tolerance, 40);
    double t = sum + part;
    lost += fabs(sum) >= part ? (sum - t) + part : (part - t) + sum;
    sum = t;
  }
  return sum + lost;
}

// ---- bounds -----------------------------------------------------------------------------------------------------------

static double component(Vec3 v, int d) { return d == 0 ? v.x : d == 1 ? v.y : v.z; }

static Box3 arc_bounds(const CurveShape *h, Box3 box)
{
  double t0 = fmin(h->t0, h->t1), t1 = fmax(h->t0, h->t1);
  for (int d = 0; d < 3; d++) {
    double a = component(h->a, d), b = component(h->b, d);
    if (a == 0 && b == 0) continue;
    double t = atan2(b, a); // where a cos t + b sin t is largest; half a turn on it is least
    for (t -= PI * ceil((t - t0) / PI); t <= t1; t += PI) {
      if (t < t0) continue;
      box = box3_with(box, vec3_add(h->centre, vec3_add(vec3_scale(cos(t), h->a), vec3_scale(sin(t), h->b))));
    }
  }
  return box;
}

typedef struct {
  const Vec3 *b;
  int degree;
  Box3 *box;
} Visit;

// Where in (lo, hi) the polynomial with Bernstein coefficients f[0..n] vanishes, found by subdivision to rounding: the box takes
// the curve's points there.
static void roots(const double *f, int n, double lo, double hi, const Visit *v, int depth)
{
  bool pos = false, neg = false;
  for (int i = 0; i <= n; i++) {
    pos = pos || f[i] > 0;
    neg = neg || f[i] < 0;
  }
  if (!pos || !neg) return; // ends of pieces are visited anyway
  double mid = (lo + hi) / 2;
  if (depth == 0 || hi - lo < 1e-15) {
    *v->box = box3_with(*v->box, bezier__at(v->b, v->degree, mid, NULL, NULL));
    return;
  }
  double left[64], right[64], *l = left, *r = right, *heap = NULL;
  if (n >= 64) {
    heap = mem_alloc(2 * (size_t)(n + 1) * sizeof *heap);
    l = heap;
    r = heap + n + 1;
  }
  memcpy(r, f, (size_t)(n + 1) * sizeof *r);
  for (int k = 0; k <= n; k++) {
    l[k] = r[0];
    for (int i = 0; i < n - k; i++) r[i] = (r[i] + r[i + 1]) / 2;
  }
  roots(l, n, lo, mid, v, depth - 1);
  if (r[0] == 0) *v->box = box3_with(*v->box, bezier__at(v->b, v->degree, mid, NULL, NULL));
  roots(r, n, mid, hi, v, depth - 1);
  free(heap);
}

static bool inside(Box3 box, Vec3 p)
{
  return p.x >= box.lo.x && p.x <= box.hi.x && p.y >= box.lo.y && p.y <= box.hi.y && p.z >= box.lo.z && p.z <= box.hi.z;
}

static Box3 pieces_bounds(const CurveShape *h, Box3 box)
{
  int n = h->degree;
  for (int i = 0; i < h->npiece; i++) {
    const Vec3 *b = shape__control(h, i);
    box = box3_with(box3_with(box, b[0]), b[n]);
  }
  double *f = mem_alloc((size_t)(n + 1) * sizeof *f);
  for (int i = 0; i < h->npiece && n > 1; i++) {
    const Vec3 *b = shape__control(h, i);
    bool in = true;
    for (int k = 1; k < n && in; k++) in = inside(box, b[k]);
    if (in) continue; // the hull is in the box already
    Visit v = {b, n, &box};
    for (int d = 0; d < 3; d++) {
      for (int k = 0; k < n; k++) f[k] = component(b[k + 1], d) - component(b[k], d);
      roots(f, n - 1, 0, 1, &v, 60);
    }
  }
  free(f);
  return box;
}

Box3 curve_bounds(const Model *m, const Curve *c)
{
  Box3 box = box3_with(box3_with(box3_empty(), curve__begin(m, c)), curve__end(m, c));
  const CurveShape *h = c->shape;
  if (!h || h->straight) return box;
  return h->kind == SHAPE_ARC ? arc_bounds(h, box) : pieces_bounds(h, box);
}

// ---- nearest ------------------------------------------------------------------------------------------------------------

typedef struct {
  const CurveShape *h;
  int piece;
  Vec3 p;
  double best, best_s; // squared distance, and where
  int best_piece;
} Search;

static Vec3 shape_at(const CurveShape *h, int piece, double s, Vec3 *d1, Vec3 *d2)
{
  if (h->kind == SHAPE_PIECES) return bezier__at(shape__control(h, piece), h->degree, s, d1, d2);
  double c = cos(s), n = sin(s);
  Vec3 r = vec3_add(vec3_scale(c, h->a), vec3_scale(n, h->b));
  *d1 = vec3_sub(vec3_scale(c, h->b), vec3_scale(n, h->a));
  *d2 = vec3_scale(-1, r);
  return vec3_add(h->centre, r);
}

static double offer(Search *q, double s, double *slope, double *bend)
{
  Vec3 d1, d2, x = shape_at(q->h, q->piece, s, &d1, &d2), r = vec3_sub(x, q->p);
  double dist = vec3_dot(r, r);
  *slope = vec3_dot(r, d1);
  *bend = vec3_dot(d1, d1) + vec3_dot(r, d2);
  if (dist < q->best) {
    q->best = dist;
    q->best_s = s;
    q->best_piece = q->piece;
  }
  return dist;
}

// Newton on (x - p) . x' = 0 kept in [a, b], where the slope changes sign from below to above.
static void polish(Search *q, double a, double b)
{
  double s = (a + b) / 2;
  for (int k = 0; k < 100 && b - a > 1e-16 * (fabs(a) + fabs(b)); k++) {
    double slope, bend;
    offer(q, s, &slope, &bend);
    if (slope == 0) return;
    if (slope < 0)
      a = s;
    else
      b = s;
    double next = bend > 0 ? s - slope / bend : a - 1;
    if (!(next > a && next < b)) next = (a + b) / 2;
    if (next == s) return;
    s = next;
  }
}

// Bounds of |x'|, |x''| and |x'''| on the whole piece.
typedef struct {
  double d1, d2, d3;
} Bounds3;

static Bounds3 derivative_bounds(const CurveShape *h, int piece)
{
  double m = fmax(vec3_length(h->a), vec3_length(h->b));
  if (h->kind == SHAPE_ARC) return (Bounds3){m, m, m};
  const Vec3 *c = shape__control(h, piece);
  int n = h->degree;
  Bounds3 k = {0, 0, 0};
  for (int i = 0; i < n; i++) {
    Vec3 d1 = vec3_sub(c[i + 1], c[i]);
    k.d1 = fmax(k.d1, n * vec3_length(d1));
    if (i + 2 > n) continue;
    Vec3 d2 = vec3_sub(vec3_sub(c[i + 2], c[i + 1]), d1);
    k.d2 = fmax(k.d2, n * (n - 1.0) * vec3_length(d2));
    if (i + 3 > n) continue;
    Vec3 d3 = vec3_sub(vec3_add(vec3_sub(c[i + 3], vec3_scale(3, c[i + 2])), vec3_scale(3, c[i + 1])), c[i]);
    k.d3 = fmax(k.d3, n * (n - 1.0) * (n - 2.0) * vec3_length(d3));
  }
  return k;
}

// Squared distances that differ by no more, relatively, are equal.
static const double TIE = 1e-12;

// Branch and bound: no point of [a, b] is nearer than the middle's distance less the largest speed times the half width. What
// remains is halved until the squared distance is certainly convex in it.
static void descend(Search *q, double a, double b, const Bounds3 *k, int depth)
{
  double mid = (a + b) / 2, half = (b - a) / 2;
  Vec3 d1, d2, x = shape_at(q->h, q->piece, mid, &d1, &d2), r = vec3_sub(x, q->p);
  double slope, bend, dist = sqrt(offer(q, mid, &slope, &bend));
  if (dist - k->d1 * half >= sqrt(q->best)) return;
  double sa, sb, ignored;
  offer(q, a, &sa, &ignored);
  offer(q, b, &sb, &ignored);
  double slow = vec3_length(d1) - k->d2 * half;
  double pull = vec3_dot(r, d2) - half * (dist * k->d3 + k->d1 * k->d2 + k->d1 * k->d3 * half);
  double least_bend = (slow > 0 ? slow * slow : 0) + pull;
  // No less than that by Taylor, either: the only bound where all of a circle is equally near.
  if (dist * dist - 2 * fabs(slope) * half + fmin(least_bend, 0) * half * half >= (1 - TIE) * q->best) return;
  if (depth == 0 || (slow > 0 && least_bend > 0)) {
    if (sa < 0 && sb > 0) polish(q, a, b);
    return;
  }
  bool left_first = slope > 0;
  descend(q, left_first ? a : mid, left_first ? mid : b, k, depth - 1);
  descend(q, left_first ? mid : a, left_first ? b : mid, k, depth - 1);
}

static double nearest_on_segment(Vec3 a, Vec3 b, Vec3 p)
{
  Vec3 d = vec3_sub(b, a);
  double dd = vec3_dot(d, d);
  double s = dd > 0 ? vec3_dot(vec3_sub(p, a), d) / dd : 0;
  return fmax(0, fmin(1, s));
}

static double nearest_on_circle(const CurveShape *h, Vec3 p)
{
  double r2 = vec3_dot(h->a, h->a), w = h->t1 - h->t0;
  Vec3 d = vec3_sub(p, h->centre);
  double x = vec3_dot(d, h->a) / r2, y = vec3_dot(d, h->b) / r2;
  double t = x == 0 && y == 0 ? h->t0 : atan2(y, x), lo = fmin(h->t0, h->t1), hi = fmax(h->t0, h->t1);
  t -= 2 * PI * floor((t - lo) / (2 * PI)); // the turn that begins at lo
  if (t > hi) t = t - hi < lo + 2 * PI - t ? hi : lo;
  return fmax(0, fmin(1, (t - h->t0) / w));
}

// The end points may stand off the curve: they count as its ends all the same.
static double or_an_end(const Model *m, const Curve *c, Vec3 p, double u)
{
  double d = vec3_distance(p, curve_point(m, c, u)), begin = vec3_distance(p, curve__begin(m, c));
  if (begin < d) {
    d = begin;
    u = 0;
  }
  return vec3_distance(p, curve__end(m, c)) < d ? 1 : u;
}

static double nearest_inside(const CurveShape *h, Vec3 p)
{
  if (h->kind == SHAPE_ARC && h->circle) return nearest_on_circle(h, p);
  Search q = {.h = h, .p = p, .best = INFINITY};
  double slope, bend;
  if (h->kind == SHAPE_ARC) {
    offer(&q, h->t0, &slope, &bend);
    offer(&q, h->t1, &slope, &bend);
    Bounds3 k = derivative_bounds(h, 0);
    descend(&q, h->t0, h->t1, &k, 40);
    return fmax(0, fmin(1, (q.best_s - h->t0) / (h->t1 - h->t0)));
  }
  for (q.piece = 0; q.piece < h->npiece; q.piece++) {
    offer(&q, 0, &slope, &bend);
    offer(&q, 1, &slope, &bend);
  }
  for (q.piece = 0; q.piece < h->npiece; q.piece++) {
    if (h->degree == 1) {
      const Vec3 *b = shape__control(h, q.piece);
      offer(&q, nearest_on_segment(b[0], b[1], p), &slope, &bend);
    } else {
      Bounds3 k = derivative_bounds(h, q.piece);
      descend(&q, 0, 1, &k, 40);
    }
  }
  int i = q.best_piece;
  return fmax(0, fmin(1, h->knot[i] + q.best_s * (h->knot[i + 1] - h->knot[i])));
}

double curve_nearest(const Model *m, const Curve *c, Vec3 p)
{
  const CurveShape *h = c->shape;
  if (!h) return nearest_on_segment(curve__begin(m, c), curve__end(m, c), p);
  return or_an_end(m, c, p, nearest_inside(h, p));
}
