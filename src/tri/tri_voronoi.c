// tri_voronoi.c - the Voronoi diagram as the dual of a Delaunay triangulation
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri.h"

// Circumcentre of a, b, c, relative to a for accuracy.
static void circumcentre(const double *a, const double *b, const double *c, double *o)
{
  double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
  double bl = bx * bx + by * by, cl = cx * cx + cy * cy, d = 2 * (bx * cy - by * cx);
  o[0] = a[0] + (cy * bl - by * cl) / d;
  o[1] = a[1] + (bx * cl - cx * bl) / d;
}

// The direction in which the Voronoi edge across the hull edge a -> b (the outside on its left) goes to infinity.
static void outward(const Tri *m, EdgeId h, double *ray)
{
  const double *a = tri_xy(m, tri_org(m, h)), *b = tri_xy(m, tri_dest(m, h));
  ray[0] = a[1] - b[1];
  ray[1] = b[0] - a[0];
}

// Append the centres around the origin v of `first`, counterclockwise. Around a hull vertex two ghosts follow each other,
// (v, inf, z) for the hull edge z -> v, then (v, b, inf) for v -> b; the finite triangles come after them.
static void add_cell(const Tri *m, EdgeId first, const uint32_t *centre_of, TriVoronoi *out, VertId v, uint32_t *k)
{
  EdgeId e = first;
  do {
    if (tri_dest(m, e) == TRI_INF) {
      EdgeId after = tri_cw(m, e); // in the ghost of v -> b
      out->open[v] = 1;
      outward(m, tri_prev(e), out->ray + 4 * (size_t)v);
      outward(m, after, out->ray + 4 * (size_t)v + 2);
      first = tri_ccw(m, e);
      break;
    }
    e = tri_ccw(m, e);
  } while (e != first);
  e = first;
  do {
    if (!tri_is_ghost(m, tri_of(e))) out->corners[(*k)++] = centre_of[tri_of(e)];
    e = tri_ccw(m, e);
  } while (e != first);
}

void tri_voronoi(const Tri *m, TriVoronoi *out)
{
  uint32_t *centre_of = mem_alloc(m->nt * sizeof *centre_of), n = 0, k = 0;
  EdgeId *at = mem_alloc(m->nv * sizeof *at);
  for (VertId v = 0; v < m->nv; v++) at[v] = NONE;
  out->centre = mem_alloc(2 * (size_t)m->nt * sizeof *out->centre);
  for (TriId t = 0; t < m->nt; t++) {
    if (tri_is_free(m, t)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    for (uint32_t i = 0; i < 3; i++)
      if (v[i] != TRI_INF) at[v[i]] = 3 * t + i;
    if (tri_is_ghost(m, t)) continue;
    circumcentre(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), out->centre + 2 * (size_t)n);
    centre_of[t] = n++;
  }
  out->ncentres = n;
  out->start = mem_alloc(((size_t)m->nv + 1) * sizeof *out->start);
  out->corners = mem_alloc(3 * (size_t)n * sizeof *out->corners);
  out->open = mem_zalloc(m->nv);
  out->ray = mem_zalloc(4 * (size_t)m->nv * sizeof *out->ray);
  for (VertId v = 0; v < m->nv; v++) {
    out->start[v] = k;
    if (at[v] != NONE) add_cell(m, at[v], centre_of, out, v, &k);
  }
  out->start[m->nv] = k;
  free(at);
  free(centre_of);
}

void tri_voronoi_free(TriVoronoi *v)
{
  free(v->centre);
  free(v->start);
  free(v->corners);
  free(v->open);
  free(v->ray);
}
