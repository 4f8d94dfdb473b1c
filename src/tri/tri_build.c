// tri_build.c - the Delaunay triangulation of many points
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_int.h"

#include "geom/hilbert.h"

// Two ghosts for each edge of points on one line, order[0..n) being sorted along it: a chain that is glued to itself.
static void build_chain(Tri *m, const uint32_t *order, size_t n)
{
  tri_reserve(m, m->nv, 2 * n);
  for (size_t i = 0; i + 1 < n; i++) {
    TriId s = tri__new(m), t = tri__new(m); // (a, b, inf) and (b, a, inf)
    CHECK(s == 2 * i && t == s + 1);
    VertId a = order[i], b = order[i + 1];
    uint32_t v[6] = {a, b, TRI_INF, b, a, TRI_INF};
    memcpy(m->vert + 3 * (size_t)s, v, sizeof v);
    tri__link(m, 3 * s, 3 * t);
    if (i > 0) { // b -> inf of the last pair with inf -> a of this one, on both sides
      tri__link(m, 3 * (s - 2) + 1, 3 * s + 2);
      tri__link(m, 3 * (t - 2) + 2, 3 * t + 1);
    }
  }
  if (n < 2) return;
  TriId last = m->nt - 2;
  tri__link(m, 2, 3 + 1);                         // inf -> first, first -> inf
  tri__link(m, 3 * last + 1, 3 * (last + 1) + 2); // last -> inf, inf -> last
}

// The first triangle, counterclockwise, with its three ghosts.
static void build_first(Tri *m, VertId a, VertId b, VertId c)
{
  if (orient2d(tri_xy(m, a), tri_xy(m, b), tri_xy(m, c)) < 0) {
    VertId t = b;
    b = c;
    c = t;
  }
  for (int i = 0; i < 4; i++) tri__new(m);
  uint32_t v[12] = {a, b, c, b, a, TRI_INF, c, b, TRI_INF, a, c, TRI_INF};
  memcpy(m->vert, v, sizeof v);
  for (uint32_t i = 0; i < 3; i++) tri__link(m, i, 3 + 3 * i);
  for (uint32_t i = 0; i < 3; i++) tri__link(m, 3 + 3 * i + 2, 3 + 3 * ((i + 1) % 3) + 1); // inf->dest, org->inf
  m->last = 0;
}

static bool find_bad(const double *xy, size_t n, uint32_t *bad)
{
  for (size_t i = 0; i < 2 * n; i++)
    if (!isfinite(xy[i])) {
      *bad = (uint32_t)(i / 2);
      return true;
    }
  return false;
}

// Drop later ones of equal points from order, and note them.
static size_t drop_duplicates(const double *xy, uint32_t *order, size_t n, TriBuild *how, uint32_t *first)
{
  size_t k = 0;
  for (size_t i = 0; i < n; i++) {
    uint32_t v = order[i];
    if (k > 0 && lex_compare(xy + 2 * (size_t)order[k - 1], xy + 2 * (size_t)v) == 0) {
      if (first) first[v] = order[k - 1];
      if (how->duplicates) vec_push(how->duplicates, v);
    } else {
      if (first) first[v] = v;
      order[k++] = v;
    }
  }
  return k;
}

static int compare_u32(const void *a, const void *b)
{
  uint32_t x, y;
  memcpy(&x, a, sizeof x);
  memcpy(&y, b, sizeof y);
  return (x > y) - (x < y);
}

// Gather the points in the given order into an array of their own.
static double *gather(const double *xy, const uint32_t *order, size_t n)
{
  double *to = mem_alloc(2 * n * sizeof *to);
  for (size_t i = 0; i < n; i++) memcpy(to + 2 * i, xy + 2 * (size_t)order[i], 2 * sizeof *to);
  return to;
}

static void build_in_order(Tri *m, uint32_t *order, size_t n)
{
  if (n < 2) {
    m->dim = n == 0 ? 255 : 0;
    return;
  }
  size_t k = 2;
  while (k < n && orient2d_count(tri_xy(m, order[0]), tri_xy(m, order[1]), tri_xy(m, order[k]), &m->count) == 0) k++;
  if (k == n) {
    m->dim = 1;
    // Along the line, points are ordered as by coordinates.
    for (size_t i = 1; i < n; i++) { // the Hilbert order is nearly sorted or reversed in long runs
      uint32_t v = order[i];
      size_t j = i;
      for (; j > 0 && lex_compare(tri_xy(m, order[j - 1]), tri_xy(m, v)) > 0; j--) order[j] = order[j - 1];
      order[j] = v;
    }
    build_chain(m, order, n);
    return;
  }
  m->dim = 2;
  tri_reserve(m, m->nv, 2 * n);
  build_first(m, order[0], order[1], order[k]);
  TriCavity c = {0};
  uint32_t nv = m->nv;
  for (size_t i = 2; i < n; i++) {
    if (i == k) continue;
    EdgeId e;
    const double *p = tri_xy(m, order[i]);
    TriLoc loc = tri_locate(m, p, NONE, &e);
    CHECK(tri_cavity(m, &c, p, loc, e) == TRI_INSERTED);
    m->nv = order[i]; // the vertex is there already: let tri_commit take it
    tri_commit(m, &c);
    m->nv = nv;
  }
  tri_cavity_free(&c);
}

TriBuildResult tri_build(Tri *m, double *xy, size_t n, TriBuild *how)
{
  TriBuildResult bad = n > TRI_MAX_VERTICES ? TRI_BUILD_TOO_MANY
                       : find_bad(xy, n, &how->bad) ? TRI_BUILD_NOT_FINITE
                                                    : TRI_BUILD_GOOD;
  if (bad != TRI_BUILD_GOOD) {
    if (how->take) free(xy);
    return bad;
  }
  uint32_t *order = mem_alloc(n * sizeof *order);
  hilbert_order(xy, n, order);
  size_t first_duplicate = how->duplicates ? how->duplicates->len : 0;
  size_t nd = drop_duplicates(xy, order, n, how, how->vertex_of);
  if (how->duplicates && how->duplicates->len > first_duplicate)
    qsort(how->duplicates->data + first_duplicate, how->duplicates->len - first_duplicate, sizeof(uint32_t), compare_u32);
  tri_init(m);
  if (how->reorder) {
    m->xy = gather(xy, order, nd);
    m->nv = m->cap_v = (uint32_t)nd;
    if (how->vertex_of) {
      uint32_t *rank = mem_alloc(n * sizeof *rank);
      for (size_t i = 0; i < nd; i++) rank[order[i]] = (uint32_t)i;
      for (size_t i = 0; i < n; i++) how->vertex_of[i] = rank[how->vertex_of[i]];
      free(rank);
    }
    for (size_t i = 0; i < nd; i++) order[i] = (uint32_t)i;
    if (how->take) free(xy);
  } else {
    if (how->take) m->xy = xy;
    else {
      m->xy = mem_alloc(2 * n * sizeof *m->xy);
      if (n) memcpy(m->xy, xy, 2 * n * sizeof *m->xy);
    }
    m->nv = m->cap_v = (uint32_t)n;
  }
  build_in_order(m, order, nd);
  free(order);
  return TRI_BUILD_GOOD;
}
