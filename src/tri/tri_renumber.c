// tri_renumber.c - vertices and triangles in the order of a space-filling curve, so that sweeps over a mesh stay in the caches
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "geom/hilbert.h"
#include "tri/refine_int.h"

// Entries first .. end-1 of *x become those of order[first .. end-1], in memory of cap entries that takes the place of *x.
static void permute_doubles(double **x, const uint32_t *order, VertId first, VertId end, size_t cap, size_t width)
{
  double *to = mem_alloc_large(cap * width * sizeof *to), *from = *x;
  memcpy(to, from, width * first * sizeof *to);
  for (VertId k = first; k < end; k++)
    for (size_t i = 0; i < width; i++) to[width * k + i] = from[width * order[k] + i];
  *x = to;
  free(from);
}

// place[t]: where triangle t goes: by the least rank of its vertices, triangles of equal rank as they stand; what is not
// inside goes last.
static uint32_t *place_triangles(const Tri *m, const uint32_t *rank)
{
  uint32_t *key = mem_alloc(m->nt * sizeof *key), *start = mem_zalloc(((size_t)m->nv + 2) * sizeof *start);
  for (TriId t = 0; t < m->nt; t++) {
    const uint32_t *v = m->vert + 3 * (size_t)t;
    key[t] = tri_is_inside(m, t) ? MIN(rank[v[0]], MIN(rank[v[1]], rank[v[2]])) : m->nv;
    start[key[t] + 1]++;
  }
  for (VertId k = 0; k <= m->nv; k++) start[k + 1] += start[k];
  for (TriId t = 0; t < m->nt; t++) key[t] = start[key[t]]++;
  free(start);
  return key;
}

// Half-edges of *x go with their triangles to *spare, which changes places with it.
static void permute_edges(uint32_t **x, uint32_t **spare, const uint32_t *place, TriId nt)
{
  uint32_t *from = *x, *to = *spare;
  for (TriId t = 0; t < nt; t++) memcpy(to + 3 * (size_t)place[t], from + 3 * (size_t)t, 3 * sizeof *to);
  *x = to, *spare = from;
}

// Triangle t goes to place[t], vertex v gets the number rank[v].
static void move_triangles(Tri *m, const uint32_t *place, const uint32_t *rank)
{
  for (TriId t = 0; t < m->nt; t++) {
    if (tri_is_free(m, t)) continue;
    for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
      TriId over = tri_of(m->twin[e]);
      if (m->twin[e] != NONE) m->twin[e] = 3 * place[over] + (m->twin[e] - 3 * over);
      if (m->vert[e] < TRI_MAX_VERTICES) m->vert[e] = rank[m->vert[e]];
    }
  }
  uint32_t *spare = mem_alloc_large(3 * (size_t)m->cap_t * sizeof *spare);
  permute_edges(&m->vert, &spare, place, m->nt);
  permute_edges(&m->twin, &spare, place, m->nt);
  if (m->seg) permute_edges(&m->seg, &spare, place, m->nt);
  if (m->region) {
    memcpy(spare, m->region, m->nt * sizeof *spare);
    for (TriId t = 0; t < m->nt; t++) m->region[place[t]] = spare[t];
  }
  uint8_t *flag = memcpy(spare, m->flag, m->nt);
  for (TriId t = 0; t < m->nt; t++) m->flag[place[t]] = flag[t];
  free(spare);
  // The free list, in the order of the slots.
  m->free_list = NONE, m->nfree = 0;
  for (TriId t = m->nt; t-- > 0;)
    if (tri_is_free(m, t)) m->twin[3 * (size_t)t] = m->free_list, m->free_list = t, m->nfree++;
}

void refine__renumber(Refiner *r, VertId first)
{
  Tri *m = r->m;
  if (m->nv == first) return;
  uint32_t *curve = mem_alloc(m->nv * sizeof *curve), *rank = mem_alloc(m->nv * sizeof *rank);
  hilbert_order(m->xy, m->nv, curve);
  for (VertId k = 0; k < m->nv; k++) rank[curve[k]] = k;
  uint32_t *place = place_triangles(m, rank);
  // The first vertices keep their numbers; the others follow along the curve, those in use.
  uint32_t *order = mem_alloc(m->nv * sizeof *order);
  memset(rank, 0, m->nv * sizeof *rank);
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (m->vert[e] < TRI_MAX_VERTICES && !tri_is_free(m, tri_of(e))) rank[m->vert[e]] = 1;
  VertId next = first;
  for (VertId k = 0; k < m->nv; k++) {
    VertId v = curve[k];
    if (v < first) rank[v] = v;
    else if (rank[v]) order[next] = v, rank[v] = next++;
  }
  move_triangles(m, place, rank);
  free(place);
  permute_doubles(&m->xy, order, first, next, m->cap_v, 2);
  permute_doubles(&r->size, order, first, next, r->cap_v, 1);
  if (r->carried) permute_doubles(&r->carried, order, first, next, r->cap_v, 1);
  m->nv = next;
  free(m->hint);
  m->hint = NULL;
  free(curve), free(rank), free(order);
}

void refine__drop_isolated(Refiner *r, VertId first)
{
  Tri *m = r->m;
  uint32_t *to = mem_alloc(m->nv * sizeof *to);
  VertId next = 0;
  for (VertId v = 0; v < m->nv; v++) {
    to[v] = next;
    if (v >= first && m->hint[v] == NONE) continue;
    m->hint[next] = m->hint[v];
    m->xy[2 * (size_t)next] = m->xy[2 * (size_t)v], m->xy[2 * (size_t)next + 1] = m->xy[2 * (size_t)v + 1];
    r->size[next] = r->size[v];
    if (r->carried) r->carried[next] = r->carried[v];
    next++;
  }
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (m->vert[e] < TRI_MAX_VERTICES && !tri_is_free(m, tri_of(e))) m->vert[e] = to[m->vert[e]];
  m->nv = next;
  free(to);
}
