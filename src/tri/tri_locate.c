// tri_locate.c - point location by walking
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_int.h"

// A half-edge of a finite triangle to start from: beside `e` if that is one, else the first there is.
static EdgeId finite_start(const Tri *m, EdgeId e)
{
  if (e != NONE && e < 3 * m->nt && !tri_is_free(m, tri_of(e))) {
    if (!tri_is_ghost(m, tri_of(e))) return e;
    for (int i = 0; i < 3; i++, e = tri_next(e))
      if (tri_org(m, e) != TRI_INF && tri_dest(m, e) != TRI_INF) return m->twin[e];
  }
  for (TriId t = 0; t < m->nt; t++)
    if (!tri_is_free(m, t) && !tri_is_ghost(m, t)) return 3 * t;
  return NONE;
}

static bool same_point(const double *a, const double *b) { return a[0] == b[0] && a[1] == b[1]; }

// p is in the closed triangle of e. Say where exactly.
static TriLoc within(Tri *m, const double p[2], EdgeId *e)
{
  EdgeId f = *e, on = NONE;
  for (int i = 0; i < 3; i++, f = tri_next(f)) {
    const double *a = tri_xy(m, tri_org(m, f));
    if (same_point(a, p)) {
      *e = f;
      return TRI_ON_VERTEX;
    }
    if (orient2d_count(a, tri_xy(m, tri_dest(m, f)), p, &m->count) == 0) on = f;
  }
  if (on == NONE) return TRI_IN_FACE;
  *e = on;
  return TRI_ON_EDGE;
}

// Where the ray from the origin q of *e to p leaves q.
typedef enum {
  LEAVE_ALONG,   // along the edge *e
  LEAVE_ACROSS,  // into a triangle, whose side opposite to q is *e
  LEAVE_OUTSIDE, // outside the hull; *e is the hull edge of a ghost at q that p sees
} Leave;

static Leave leave(Tri *m, const double *p, EdgeId *e)
{
  EdgeId first = *e, f = first, seen = NONE;
  const double *q = tri_xy(m, tri_org(m, f));
  do {
    VertId x = tri_dest(m, f), y = tri_apex(m, f);
    int s = x == TRI_INF ? 0 : orient2d_count(q, tri_xy(m, x), p, &m->count);
    if (x == TRI_INF) { // the ghost's hull edge runs y -> q
      if (orient2d_count(tri_xy(m, y), q, p, &m->count) > 0) seen = tri_prev(f);
    } else if (s == 0 && (lex_compare(q, tri_xy(m, x)) < 0) == (lex_compare(q, p) < 0)) {
      *e = f;
      return LEAVE_ALONG;
    } else if (s > 0 && y == TRI_INF) seen = f;
    else if (s > 0 && orient2d_count(q, tri_xy(m, y), p, &m->count) < 0) {
      *e = tri_next(f);
      return LEAVE_ACROSS;
    }
    f = tri_ccw(m, f);
  } while (f != first);
  DCHECK(seen != NONE);
  *e = seen;
  return LEAVE_OUTSIDE;
}

// From the edge *f (right end to left end) that the ray q p enters, on to the triangle of p, or to a vertex on the ray, from
// which the walk goes on: then *f leaves it, and the result is TRI_ON_VERTEX.
static TriLoc cross(Tri *m, const double *q, const double *p, EdgeId *f)
{
  for (;;) {
    m->walk_steps++;
    VertId a = tri_org(m, *f), b = tri_dest(m, *f);
    if (orient2d_count(tri_xy(m, a), tri_xy(m, b), p, &m->count) >= 0) return within(m, p, f);
    EdgeId g = m->twin[*f];
    VertId c = tri_apex(m, g);
    *f = g;
    if (c == TRI_INF) return TRI_OUTSIDE;
    int s = orient2d_count(q, p, tri_xy(m, c), &m->count);
    if (s == 0) {
      *f = tri_prev(g);
      return TRI_ON_VERTEX;
    }
    *f = s > 0 ? tri_next(g) : tri_prev(g);
  }
}

// The straight walk: along the segment from the origin of e to p, through vertices, edges and triangles. Each step gets
// nearer to p, so it ends on every triangulation.
static TriLoc walk_straight(Tri *m, const double p[2], EdgeId e, EdgeId *out)
{
  TriLoc loc = TRI_ON_VERTEX;
  while (loc == TRI_ON_VERTEX && !same_point(tri_xy(m, tri_org(m, e)), p)) {
    const double *q = tri_xy(m, tri_org(m, e));
    switch (leave(m, p, &e)) {
    case LEAVE_OUTSIDE: loc = TRI_OUTSIDE; break;
    case LEAVE_ACROSS: loc = cross(m, q, p, &e); break;
    case LEAVE_ALONG: {
      const double *x = tri_xy(m, tri_dest(m, e));
      if (same_point(x, p) || (lex_compare(q, x) < 0) == (lex_compare(x, p) < 0)) e = tri_next(e); // p is x or beyond
      else loc = TRI_ON_EDGE;
      break;
    }
    }
  }
  *out = e;
  return loc;
}

TriLoc tri_locate(Tri *m, const double p[2], EdgeId start, EdgeId *out)
{
  DCHECK(m->dim == 2);
  EdgeId e = finite_start(m, start == NONE ? m->last : start);
  m->walks++;
  TriLoc loc;
  // Every visibility walk ends on a Delaunay triangulation; on others it may cycle, so it gets a number of steps after
  // which the straight walk takes over.
  uint64_t limit = 64 + 4 * (uint64_t)sqrt((double)m->nt);
  EdgeId from = NONE; // the edge we came in by
  for (uint64_t steps = 0;; steps++) {
    if (steps > limit) {
      loc = walk_straight(m, p, e, &e);
      break;
    }
    EdgeId f = NONE;
    EdgeId h = e;
    for (int i = 0; i < 3; i++, h = tri_next(h))
      if (h != from &&
          orient2d_count(tri_xy(m, tri_org(m, h)), tri_xy(m, tri_dest(m, h)), p, &m->count) < 0) {
        f = h;
        break;
      }
    if (f == NONE) {
      loc = within(m, p, &e);
      break;
    }
    m->walk_steps++;
    e = from = m->twin[f];
    if (tri_apex(m, e) == TRI_INF) {
      loc = TRI_OUTSIDE;
      break;
    }
  }
  m->last = e;
  *out = e;
  return loc;
}
