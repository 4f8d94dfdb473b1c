// tri_check.c - the validator
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_int.h"

typedef struct {
  const Tri *m;
  TriCheck *out;
} Checker;

static void violation(Checker *c, unsigned rule, EdgeId e)
{
  if (c->out->count++ == 0) {
    c->out->rule = rule;
    c->out->e = e;
  }
}

static bool vertex_in_range(const Tri *m, VertId v) { return v == TRI_INF || v < m->nv; }

static void check_half_edge(Checker *c, EdgeId e)
{
  const Tri *m = c->m;
  EdgeId g = m->twin[e];
  if (!vertex_in_range(m, m->vert[e]) || g >= 3 * m->nt || tri_is_free(m, tri_of(g)) || m->twin[g] != e || g == e)
    violation(c, TRI_CHECK_LINKS, e);
  else if (m->vert[g] != tri_dest(m, e) || m->vert[e] != tri_dest(m, g)) violation(c, TRI_CHECK_LINKS, e);
  else if (tri_is_segment(m, e) != tri_is_segment(m, g) || (tri_is_segment(m, e) && m->seg[e] != m->seg[g]))
    violation(c, TRI_CHECK_LINKS, e);
}

static void check_links(Checker *c)
{
  const Tri *m = c->m;
  uint32_t nfree = 0, n = 0;
  for (TriId t = 0; t < m->nt; t++) {
    if (tri_is_free(m, t)) {
      nfree++;
      continue;
    }
    const uint32_t *v = m->vert + 3 * (size_t)t;
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) violation(c, TRI_CHECK_LINKS, 3 * t);
    for (EdgeId e = 3 * t; e < 3 * t + 3; e++) check_half_edge(c, e);
  }
  for (TriId t = m->free_list; t != NONE && n <= nfree; t = m->twin[3 * (size_t)t]) {
    if (t >= m->nt || !tri_is_free(m, t)) {
      violation(c, TRI_CHECK_LINKS, 3 * t);
      break;
    }
    n++;
  }
  if (n != nfree || nfree != m->nfree) violation(c, TRI_CHECK_LINKS, NONE);
  for (VertId v = 0; m->hint && v < m->nv; v++) {
    EdgeId e = m->hint[v];
    if (e != NONE && (e >= 3 * m->nt || m->vert[e] != v || tri_is_free(m, tri_of(e)))) violation(c, TRI_CHECK_LINKS, e);
  }
}

// Finite triangles turn left. Two hull edges in a row, seen from inside, do not turn right.
static void check_orientation(Checker *c)
{
  const Tri *m = c->m;
  for (TriId t = 0; t < m->nt; t++) {
    const uint32_t *v = m->vert + 3 * (size_t)t;
    if (tri_is_free(m, t)) continue;
    if (!tri_is_ghost(m, t)) {
      if (orient2d(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2])) <= 0) violation(c, TRI_CHECK_ORIENT, 3 * t);
      continue;
    }
    EdgeId e = 3 * t;
    while (tri_apex(m, e) != TRI_INF) e = tri_next(e); // a -> b, the outside on its left
    VertId a = m->vert[e], b = tri_dest(m, e), z = tri_apex(m, m->twin[tri_prev(e)]); // z -> a is the hull edge before
    if (a == TRI_INF || b == TRI_INF || z == TRI_INF) violation(c, TRI_CHECK_ORIENT, e);
    else if (orient2d(tri_xy(m, z), tri_xy(m, a), tri_xy(m, b)) > 0) violation(c, TRI_CHECK_ORIENT, e);
  }
}

// With rule LINKS, one orbit of half-edges per vertex and V - E + F = 2 make a sphere.
static void check_euler(Checker *c)
{
  const Tri *m = c->m;
  uint8_t *seen = mem_zalloc(3 * (size_t)m->nt);
  uint8_t *used = mem_zalloc((size_t)m->nv + 1); // the last is infinity
  size_t orbits = 0, vertices = 0, triangles = 0;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    if (tri_is_free(m, tri_of(e))) continue;
    triangles += e % 3 == 0;
    if (seen[e]) continue;
    orbits++;
    VertId v = m->vert[e] == TRI_INF ? m->nv : m->vert[e];
    if (used[v]) violation(c, TRI_CHECK_EULER, e);
    else vertices++;
    used[v] = 1;
    for (EdgeId f = e; !seen[f]; f = tri_ccw(m, f)) seen[f] = 1;
  }
  if (triangles && vertices + triangles != triangles / 2 * 3 + 2) violation(c, TRI_CHECK_EULER, NONE);
  if (triangles % 2) violation(c, TRI_CHECK_EULER, NONE);
  (void)orbits;
  free(seen);
  free(used);
}

static void check_delaunay(Checker *c)
{
  const Tri *m = c->m;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    EdgeId g = m->twin[e];
    if (tri_is_free(m, tri_of(e)) || g < e || tri_is_segment(m, e)) continue;
    VertId v[4] = {m->vert[e], m->vert[g], tri_apex(m, e), tri_apex(m, g)};
    if (v[0] == TRI_INF || v[1] == TRI_INF || v[2] == TRI_INF || v[3] == TRI_INF) continue;
    if (incircle_perturbed(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), tri_xy(m, v[3]), NULL) > 0)
      violation(c, TRI_CHECK_DELAUNAY, e);
  }
}

// Twice the area of the triangles against that inside the hull edges. n terms, each with a relative error of a few eps of
// the square of the extent.
static void check_area(Checker *c)
{
  const Tri *m = c->m;
  long double sum = 0, hull = 0, extent = 0;
  const double *o = m->xy;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    TriId t = tri_of(e);
    if (tri_is_free(m, t)) continue;
    if (tri_is_ghost(m, t)) {
      if (tri_apex(m, e) != TRI_INF) continue;
      const double *a = tri_xy(m, tri_dest(m, e)), *b = tri_xy(m, m->vert[e]);
      long double ax = (long double)a[0] - o[0], ay = (long double)a[1] - o[1];
      long double bx = (long double)b[0] - o[0], by = (long double)b[1] - o[1];
      hull += ax * by - ay * bx;
      extent = fmaxl(extent, fmaxl(fabsl(ax), fabsl(ay)));
    } else if (e % 3 == 0) {
      const double *p = tri_xy(m, m->vert[e]), *q = tri_xy(m, m->vert[e + 1]), *r = tri_xy(m, m->vert[e + 2]);
      sum += ((long double)q[0] - p[0]) * ((long double)r[1] - p[1]) - ((long double)q[1] - p[1]) * ((long double)r[0] - p[0]);
    }
  }
  if (fabsl(sum - hull) > 0x1p-60L * 8 * (long double)(m->nt + 8) * extent * extent) violation(c, TRI_CHECK_AREA, NONE);
}

size_t tri_check(const Tri *m, unsigned rules, TriCheck *out)
{
  TriCheck local;
  Checker c = {m, out ? out : &local};
  *c.out = (TriCheck){0, NONE, 0};
  check_links(&c); // the others need it
  if (c.out->count) return c.out->count;
  if (rules & TRI_CHECK_ORIENT) check_orientation(&c);
  if (rules & TRI_CHECK_EULER) check_euler(&c);
  if (rules & TRI_CHECK_DELAUNAY) check_delaunay(&c);
  if (rules & TRI_CHECK_AREA) check_area(&c);
  return c.out->count;
}
