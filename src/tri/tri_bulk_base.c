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

static void set_triangle(Bulk *m, TriId t, VertId a, VertId b, VertId c)
{
  bulk_set(m, t, a, b, c);
  bulk_set(m, t + 1, b, a, TRI_INF);
  bulk_set(m, t + 2, c, b, TRI_INF);
  bulk_set(m, t + 3, a, c, TRI_INF);
  for (uint32_t i = 0; i < 3; i++) {
    EdgeId ghost = 3 * (t + 1 + i), after = 3 * (t + 1 + (i + 1) % 3);
    bulk_link(m, 3 * t + i, ghost);
    bulk_link(m, ghost + 2, after + 1); // inf -> dest with dest -> inf
  }
}

void bulk_triangle(Bulk *m, TriId t, VertId a, VertId b, VertId c)
{
  if (orient2d(bulk_at(m, a), bulk_at(m, b), bulk_at(m, c)) > 0) set_triangle(m, t, a, b, c);
  else set_triangle(m, t, b, a, c);
}

// The extremes of a triangle a, b, c whose coordinates all differ, without branches; hull edge g leaves b, and the next two
// c and a.
static inline void triangle_extremes(BulkHull *x, const double *a, const double *b, const double *c, const VertId v[3],
                                     EdgeId g)
{
  for (int i = 0; i < 2; i++) {
    uint32_t low = c[i] < b[i], high = c[i] > b[i];
    double lowest = MIN(b[i], c[i]), highest = MAX(b[i], c[i]);
    low = a[i] < lowest ? 2 : low;
    high = a[i] > highest ? 2 : high;
    x->at[2 * i] = MIN(a[i], lowest);
    x->at[2 * i + 1] = MAX(a[i], highest);
    x->v[2 * i] = v[low];
    x->v[2 * i + 1] = v[high];
    x->e[2 * i] = g + 3 * low;
    x->e[2 * i + 1] = g + 3 * high;
  }
}

BulkHull bulk_base(Bulk *m, VertId lo, VertId hi)
{
  if (hi - lo == 1) return hull_of(bulk_at(m, lo), lo, NONE);
  if (hi - lo == 2) return pair(m, lo);
  int s = orient2d_count(bulk_at(m, lo), bulk_at(m, lo + 1), bulk_at(m, lo + 2), &m->count);
  if (s == 0) return bulk_chain(m, lo, hi);
  VertId a = lo + (s < 0), b = lo + (s > 0), c = lo + 2;
  set_triangle(m, 2 * lo, a, b, c);
  EdgeId g = 3 * (2 * lo + 1);
  const double *p = bulk_at(m, a), *q = bulk_at(m, b), *r = bulk_at(m, c);
  BulkHull x;
  if (UNLIKELY((p[0] == q[0]) | (q[0] == r[0]) | (r[0] == p[0]) | (p[1] == q[1]) | (q[1] == r[1]) | (r[1] == p[1]))) {
    x = hull_of(q, b, g);
    widen(m, &x, c, g + 3);
    widen(m, &x, a, g + 6);
  } else triangle_extremes(&x, p, q, r, (VertId[3]){b, c, a}, g);
  return x;
}
