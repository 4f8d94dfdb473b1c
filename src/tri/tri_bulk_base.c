// tri_bulk_base.c - many points at once: the smallest parts, and points on one line
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_bulk.h"

// Is p more extreme than q in the sense of BulkHull?
static inline bool beats(const double *p, const double *q, int which)
{
  int axis = which >> 1;
  if (p[axis] != q[axis]) return (p[axis] > q[axis]) == (which & 1);
  return axis == 0 ? p[1] < q[1] : p[0] > q[0];
}

// The extremes of the first vertex alone, then of one more at a time, which a hull edge e leaves.
static inline BulkHull hull_of(const double *p, VertId v, EdgeId e)
{
  return (BulkHull){{p[0], p[0], p[1], p[1]}, {v, v, v, v}, {e, e, e, e}};
}

static inline void widen(const Bulk *m, BulkHull *x, VertId v, EdgeId e)
{
  const double *p = bulk_at(m, v);
  for (int i = 0; i < 4; i++)
    if (beats(p, bulk_at(m, x->v[i]), i)) {
      x->at[i] = p[i >> 1];
      x->v[i] = v;
      x->e[i] = e;
    }
}

BulkHull bulk_extremes(const Bulk *m, EdgeId h)
{
  BulkHull x = hull_of(bulk_at(m, m->vert[h]), m->vert[h], h);
  for (EdgeId f = bulk_hull_next(m, h); f != h; f = bulk_hull_next(m, f)) widen(m, &x, m->vert[f], f);
  return x;
}

static int compare_points(const void *a, const void *b)
{
  const double *p = *(const double *const *)a, *q = *(const double *const *)b;
  return lex_compare(p, q);
}

// Two ghosts (a, b, inf) and (b, a, inf) for each edge of the vertices on one line: a chain glued to itself.
BulkHull bulk_chain(Bulk *m, VertId lo, VertId hi)
{
  size_t n = hi - lo;
  const double **p = mem_alloc(n * sizeof *p);
  for (size_t i = 0; i < n; i++) p[i] = bulk_at(m, lo + (VertId)i);
  qsort(p, n, sizeof *p, compare_points);
  for (size_t i = 0; i + 1 < n; i++) {
    VertId a = (VertId)((p[i] - m->xy) / 2), b = (VertId)((p[i + 1] - m->xy) / 2);
    TriId s = 2 * lo + 2 * (TriId)i, t = s + 1;
    bulk_set(m, s, a, b, TRI_INF);
    bulk_set(m, t, b, a, TRI_INF);
    bulk_link(m, 3 * s, 3 * t);
    if (i > 0) { // b -> inf of the pair before with inf -> a of this one, on both sides
      bulk_link(m, 3 * (s - 2) + 1, 3 * s + 2);
      bulk_link(m, 3 * (t - 2) + 2, 3 * t + 1);
    }
  }
  TriId s = 2 * lo, last = 2 * hi - 4;
  bulk_link(m, 3 * s + 2, 3 * (s + 1) + 1);
  bulk_link(m, 3 * last + 1, 3 * (last + 1) + 2);
  free(p);
  return bulk_extremes(m, 3 * s);
}

static BulkHull pair(Bulk *m, VertId a)
{
  VertId b = a + 1;
  TriId s = 2 * a, t = s + 1;
  bulk_set(m, s, a, b, TRI_INF);
  bulk_set(m, t, b, a, TRI_INF);
  bulk_link(m, 3 * s, 3 * t);
  bulk_link(m, 3 * s + 1, 3 * t + 2);
  bulk_link(m, 3 * s + 2, 3 * t + 1);
  const double *p = bulk_at(m, a), *q = bulk_at(m, b);
  if (UNLIKELY((p[0] == q[0]) | (p[1] == q[1]))) {
    BulkHull x = hull_of(p, a, 3 * s);
    widen(m, &x, b, 3 * t);
    return x;
  }
  uint32_t right = q[0] > p[0], up = q[1] > p[1];
  return (BulkHull){{MIN(p[0], q[0]), MAX(p[0], q[0]), MIN(p[1], q[1]), MAX(p[1], q[1])},
                    {b - right, a + right, b - up, a + up},
                    {3 * t - 3 * right, 3 * s + 3 * right, 3 * t - 3 * up, 3 * s + 3 * up}};
}

// The extremes of a convex polygon of n vertices; hull edges g, g + 3 .. leave them. Without branches, but
// for ties.
static inline BulkHull polygon_extremes(const Bulk *m, const VertId *v, uint32_t n, EdgeId g)
{
  BulkHull x = {.v = {0}};
  int tie = 0;
  for (int i = 0; i < 2; i++) {
    double lowest = bulk_at(m, v[0])[i], highest = lowest;
    uint32_t low = 0, high = 0;
    for (uint32_t k = 1; k < n; k++) {
      double q = bulk_at(m, v[k])[i];
      tie |= (q == lowest) | (q == highest);
      low = q < lowest ? k : low;
      high = q > highest ? k : high;
      lowest = MIN(q, lowest);
      highest = MAX(q, highest);
    }
    x.at[2 * i] = lowest, x.at[2 * i + 1] = highest;
    x.v[2 * i] = v[low], x.v[2 * i + 1] = v[high];
    x.e[2 * i] = g + 3 * low, x.e[2 * i + 1] = g + 3 * high;
  }
  if (UNLIKELY(tie)) {
    x = hull_of(bulk_at(m, v[0]), v[0], g);
    for (uint32_t k = 1; k < n; k++) widen(m, &x, v[k], g + 3 * k);
  }
  return x;
}

// Ghosts in the slots from t on around the convex polygon of n vertices; their twins' half-edges are given.
static inline void set_ghosts(Bulk *m, TriId t, const VertId *v, uint32_t n, const EdgeId *inner)
{
  for (uint32_t k = 0; k < n; k++) {
    uint32_t next = k + 1 < n ? k + 1 : 0;
    bulk_set(m, t + k, v[next], v[k], TRI_INF);
    bulk_link(m, 3 * (t + k), inner[k]);
    bulk_link(m, 3 * (t + k) + 2, 3 * (t + next) + 1); // inf -> dest with dest -> inf
  }
}

static void set_triangle(Bulk *m, TriId t, VertId a, VertId b, VertId c)
{
  bulk_set(m, t, a, b, c);
  set_ghosts(m, t + 1, (VertId[3]){a, b, c}, 3, (EdgeId[3]){3 * t, 3 * t + 1, 3 * t + 2});
}

void bulk_triangle(Bulk *m, TriId t, VertId a, VertId b, VertId c)
{
  if (orient2d(bulk_at(m, a), bulk_at(m, b), bulk_at(m, c)) > 0) set_triangle(m, t, a, b, c);
  else set_triangle(m, t, b, a, c);
}

// A triangle with a vertex d inside, in the slots from t on.
static BulkHull set_fan(Bulk *m, TriId t, const VertId v[3], VertId d)
{
  for (uint32_t k = 0; k < 3; k++) {
    uint32_t next = k < 2 ? k + 1 : 0;
    bulk_set(m, t + k, v[k], v[next], d);
    bulk_link(m, 3 * (t + k) + 1, 3 * (t + next) + 2);
  }
  set_ghosts(m, t + 3, v, 3, (EdgeId[3]){3 * t, 3 * t + 3, 3 * t + 6});
  return polygon_extremes(m, (VertId[3]){v[1], v[2], v[0]}, 3, 3 * (t + 3));
}

// A convex quadrilateral with the diagonal v[0] v[2].
static BulkHull set_quad(Bulk *m, TriId t, const VertId v[4])
{
  bulk_set(m, t, v[0], v[1], v[2]);
  bulk_set(m, t + 1, v[0], v[2], v[3]);
  bulk_link(m, 3 * t + 2, 3 * t + 3);
  set_ghosts(m, t + 2, v, 4, (EdgeId[4]){3 * t, 3 * t + 1, 3 * t + 4, 3 * t + 5});
  return polygon_extremes(m, (VertId[4]){v[1], v[2], v[3], v[0]}, 4, 3 * (t + 2));
}

// The sign of l - r as far as the filter can tell, without a branch.
static inline int sign_of_difference(double l, double r)
{
  double det = l - r, tol = ORIENT_BOUND * (fabs(l) + fabs(r)) + ORIENT_TINY;
  return (det > tol) - (-det > tol);
}

// Signs of the orientations of p0 p1 p3, p1 p2 p3, p2 p0 p3 and p0 p1 p2, none 0, and of the incircle
// determinant of p0, p1, p2 and p3, ties broken. false: three are on one line.
typedef struct {
  int ab, bc, ca, abc, in;
} FourSigns;

static NOINLINE bool exact_four(Bulk *m, const double *const p[4], FourSigns *s)
{
  s->ab = orient2d_count(p[0], p[1], p[3], &m->count), s->bc = orient2d_count(p[1], p[2], p[3], &m->count);
  s->ca = orient2d_count(p[2], p[0], p[3], &m->count), s->abc = orient2d_count(p[0], p[1], p[2], &m->count);
  if (!(s->ab & s->bc & s->ca & s->abc)) return false;
  bool back = s->abc < 0;
  s->in = incircle_perturbed(p[back], p[!back], p[2], p[3], &m->count) * s->abc;
  return true;
}

static inline bool signs_of_four(Bulk *m, const double *const p[4], FourSigns *s)
{
  double ax = p[0][0] - p[3][0], ay = p[0][1] - p[3][1], bx = p[1][0] - p[3][0], by = p[1][1] - p[3][1];
  double cx = p[2][0] - p[3][0], cy = p[2][1] - p[3][1], al = ax * ax + ay * ay, bl = bx * bx + by * by, cl = cx * cx + cy * cy;
  double det = al * (bx * cy - cx * by) + bl * (cx * ay - ax * cy) + cl * (ax * by - bx * ay), sum = al + bl + cl;
  double tol = INCIRCLE_BOUND * (sum * sum) + (INCIRCLE_TINY * sum + INCIRCLE_TINY);
  s->ab = sign_of_difference(ax * by, ay * bx);
  s->bc = sign_of_difference(bx * cy, by * cx);
  s->ca = sign_of_difference(cx * ay, cy * ax);
  s->abc = sign_of_difference((p[0][0] - p[2][0]) * (p[1][1] - p[2][1]), (p[0][1] - p[2][1]) * (p[1][0] - p[2][0]));
  s->in = (det > tol) - (-det > tol);
  return LIKELY(s->ab & s->bc & s->ca & s->abc & s->in) || exact_four(m, p, s); // -1 and 1 have the lowest bit set
}

bool bulk_four(Bulk *m, VertId lo, BulkHull *hull)
{
  FourSigns s;
  if (!signs_of_four(m, (const double *[4]){bulk_at(m, lo), bulk_at(m, lo + 1), bulk_at(m, lo + 2), bulk_at(m, lo + 3)}, &s))
    return false;
  // a, b, c counterclockwise; exchange a and b if they are not. d is right of which of ab, bc, ca, and in
  // their circle?
  bool back = s.abc < 0;
  const VertId v[4] = {lo + back, lo + !back, lo + 2, lo + 3};
  unsigned ab = s.ab * s.abc < 0, bc = (back ? s.ca : s.bc) * s.abc < 0, ca = (back ? s.bc : s.ca) * s.abc < 0;
  unsigned beyond = ab | bc << 1 | ca << 2, inside = s.in * s.abc > 0;
  // The quadrilateral from one end of its diagonal; or the hull and the vertex inside.
  static const uint8_t quad[5][2][4] = {
    [1] = {{0, 3, 1, 2}, {3, 1, 2, 0}}, [2] = {{1, 3, 2, 0}, {3, 2, 0, 1}}, [4] = {{2, 3, 0, 1}, {3, 0, 1, 2}},
  };
  static const uint8_t fan[8][4] = {
    [0] = {0, 1, 2, 3}, [3] = {0, 3, 2, 1}, [5] = {3, 1, 2, 0}, [6] = {0, 1, 3, 2},
  };
  if (beyond == 1 || beyond == 2 || beyond == 4) {
    const uint8_t *q = quad[beyond][inside];
    *hull = set_quad(m, 2 * lo, (VertId[4]){v[q[0]], v[q[1]], v[q[2]], v[q[3]]});
  } else {
    const uint8_t *q = fan[beyond];
    *hull = set_fan(m, 2 * lo, (VertId[3]){v[q[0]], v[q[1]], v[q[2]]}, v[q[3]]);
  }
  return true;
}

BulkHull bulk_base(Bulk *m, VertId lo, VertId hi)
{
  if (hi - lo == 1) return hull_of(bulk_at(m, lo), lo, NONE);
  if (hi - lo == 2) return pair(m, lo);
  int s = orient2d_count(bulk_at(m, lo), bulk_at(m, lo + 1), bulk_at(m, lo + 2), &m->count);
  if (s == 0) return bulk_chain(m, lo, hi);
  VertId a = lo + (s < 0), b = lo + (s > 0), c = lo + 2;
  set_triangle(m, 2 * lo, a, b, c);
  return polygon_extremes(m, (VertId[3]){b, c, a}, 3, 3 * (2 * lo + 1));
}
