// tri_renumber.c - vertices and triangles in the order of a space-filling curve, so that sweeps over a mesh stay in the caches
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "geom/hilbert.h"
#include "tri/refine_int.h"

// Entries first .. end-1 of x become those of order[first .. end-1], out of n.
static void permute_doubles(double *x, const uint32_t *order, VertId first, VertId n, VertId end, size_t width)
{
  double *old = mem_alloc((n - first) * width * sizeof *old);
  memcpy(old, x + width * first, (n - first) * width * sizeof *old);
  for (VertId k = first; k < end; k++)
    for (size_t i = 0; i < width; i++) x[width * k + i] = old[width * (order[k] - first) + i];
  free(old);
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

static void permute_u32(uint32_t *x, const uint32_t *place, TriId nt, size_t width)
{
  uint32_t *old = mem_alloc((size_t)nt * width * sizeof *old);
  memcpy(old, x, (size_t)nt * width * sizeof *old);
  for (TriId t = 0; t < nt; t++)
    for (size_t i = 0; i < width; i++) x[width * place[t] + i] = old[width * t + i];
  free(old);
}

static void move_triangles(Tri *m, const uint32_t *place)
{
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (!tri_is_free(m, tri_of(e)) && m->twin[e] != NONE) m->twin[e] = 3 * place[tri_of(m->twin[e])] + m->twin[e] % 3;
  permute_u32(m->vert, place, m->nt, 3);
  permute_u32(m->twin, place, m->nt, 3);
  if (m->seg) permute_u32(m->seg, place, m->nt, 3);
  if (m->region) permute_u32(m->region, place, m->nt, 1);
  uint8_t *flag = mem_alloc(m->nt);
  memcpy(flag, m->flag, m->nt);
  for (TriId t = 0; t < m->nt; t++) m->flag[place[t]] = flag[t];
  free(flag);
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
  move_triangles(m, place);
  free(place);
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
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (m->vert[e] < TRI_MAX_VERTICES && !tri_is_free(m, tri_of(e))) m->vert[e] = rank[m->vert[e]];
  permute_doubles(m->xy, order, first, m->nv, next, 2);
  permute_doubles(r->size, order, first, m->nv, next, 1);
  if (r->carried) permute_doubles(r->carried, order, first, m->nv, next, 1);
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
