// tri_renumber.c - vertices and triangles in the order of a space-filling curve, so that sweeps over a mesh stay in the caches
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "geom/hilbert.h"
#include "tri/refine_int.h"

// Memory that arrays pass through. Fresh pages are dear: half-edges change places with it, the rest is copied there and back.
typedef struct {
  void *block;
  size_t bytes;
} Spare;

static void *spare_block(Spare *s, size_t bytes)
{
  if (s->bytes < bytes) {
    free(s->block);
    s->block = mem_alloc_large(bytes);
    s->bytes = bytes;
  }
  return s->block;
}

// Entries first .. end-1 of x become those of order[0 .. end-first); it has n.
static void permute_doubles(double *x, size_t n, Spare *spare, const uint32_t *order, VertId first, VertId end, size_t width)
{
  const double *from = memcpy(spare_block(spare, n * width * sizeof *x), x, n * width * sizeof *x);
  for (VertId k = first; k < end; k++)
    for (size_t i = 0; i < width; i++) x[width * k + i] = from[width * order[k - first] + i];
}

// place[t]: where triangle t goes: by the least rank of its vertices, triangles of equal rank as they stand; what is not
// inside goes last. start: scratch of nv + 2 entries.
static void place_triangles(const Tri *m, const uint32_t *rank, uint32_t *start, uint32_t *place)
{
  memset(start, 0, ((size_t)m->nv + 2) * sizeof *start);
  for (TriId t = 0; t < m->nt; t++) {
    const uint32_t *v = m->vert + 3 * (size_t)t;
    place[t] = tri_is_inside(m, t) ? MIN(rank[v[0]], MIN(rank[v[1]], rank[v[2]])) : m->nv;
    start[place[t] + 1]++;
  }
  for (VertId k = 0; k <= m->nv; k++) start[k + 1] += start[k];
  for (TriId t = 0; t < m->nt; t++) place[t] = start[place[t]]++;
}

// Vertices get the numbers of rank.
static void move_corners(Tri *m, Spare *spare, const uint32_t *place, const uint32_t *rank)
{
  uint32_t *to = spare_block(spare, 3 * (size_t)m->cap_t * sizeof *to), *from = m->vert;
  for (TriId t = 0; t < m->nt; t++)
    for (size_t i = 0; i < 3; i++) {
      VertId v = from[3 * (size_t)t + i];
      to[3 * (size_t)place[t] + i] = v < TRI_MAX_VERTICES ? rank[v] : v;
    }
  m->vert = to;
  *spare = (Spare){from, 3 * (size_t)m->cap_t * sizeof *from};
}

static void move_twins(Tri *m, Spare *spare, const uint32_t *place)
{
  uint32_t *to = spare_block(spare, 3 * (size_t)m->cap_t * sizeof *to), *from = m->twin;
  for (TriId t = 0; t < m->nt; t++) {
    bool used = !tri_is_free(m, t);
    for (size_t i = 0; i < 3; i++) {
      EdgeId o = from[3 * (size_t)t + i];
      to[3 * (size_t)place[t] + i] = used && o != NONE ? 3 * place[tri_of(o)] + o % 3 : o;
    }
  }
  m->twin = to;
  *spare = (Spare){from, 3 * (size_t)m->cap_t * sizeof *from};
}

// Few edges are segments: pairs of their half-edges and ids.
static void take_segments(const Tri *m, U32Vec *list)
{
  for (TriId t = 0; t < m->nt; t++)
    for (EdgeId e = 3 * t; !tri_is_free(m, t) && e < 3 * t + 3; e++)
      if (tri_is_segment(m, e)) vec_push(list, e), vec_push(list, m->seg[e]);
}

static void put_segments(Tri *m, const U32Vec *list, const uint32_t *place)
{
  for (size_t i = 0; i < list->len; i += 2) {
    EdgeId e = list->data[i];
    m->seg[3 * place[tri_of(e)] + e % 3] = list->data[i + 1];
  }
}

// Triangle t goes to place[t], vertex v gets the number rank[v].
static void move_triangles(Tri *m, Spare *spare, const uint32_t *place, const uint32_t *rank)
{
  move_corners(m, spare, place, rank);
  move_twins(m, spare, place);
  uint32_t *copy = spare_block(spare, m->nt * sizeof *copy);
  if (m->region) {
    memcpy(copy, m->region, m->nt * sizeof *copy);
    for (TriId t = 0; t < m->nt; t++) m->region[place[t]] = copy[t];
  }
  uint8_t *flag = memcpy(copy, m->flag, m->nt);
  for (TriId t = 0; t < m->nt; t++) m->flag[place[t]] = flag[t];
  // The free list, in the order of the slots.
  m->free_list = NONE, m->nfree = 0;
  for (TriId t = m->nt; t-- > 0;)
    if (tri_is_free(m, t)) m->twin[3 * (size_t)t] = m->free_list, m->free_list = t, m->nfree++;
}

// Numbers for the vertices from `first` on: along the curve, those in use. order[k - first]: which becomes k; it may be the same array as
// curve. Returns the number of vertices then.
static VertId number_vertices(const Refiner *r, VertId first, const uint32_t *curve, uint32_t *order, uint32_t *rank)
{
  const Tri *m = r->m;
  bool all = r->stats->collapses == 0; // what else leaves isolated vertices was there before
  if (!all) {
    memset(rank, 0, m->nv * sizeof *rank);
    for (EdgeId e = 0; e < 3 * m->nt; e++)
      if (m->vert[e] < TRI_MAX_VERTICES && !tri_is_free(m, tri_of(e))) rank[m->vert[e]] = 1;
  }
  VertId next = first;
  for (VertId k = 0; k < m->nv; k++) {
    VertId v = curve[k];
    if (v < first) rank[v] = v;
    else if (all || rank[v]) order[next - first] = v, rank[v] = next++;
  }
  return next;
}

void refine__renumber(Refiner *r, VertId first)
{
  Tri *m = r->m;
  if (m->nv == first) return;
  size_t n = m->nv;
  U32Vec segments = {0};
  Spare spare = {0};
  if (m->seg) { // its memory will do until the end
    take_segments(m, &segments);
    spare = (Spare){m->seg, 3 * (size_t)m->cap_t * sizeof *m->seg};
  }
  uint32_t *curve = mem_alloc(n * sizeof *curve), *rank = mem_alloc(n * sizeof *rank);
  uint32_t *place = mem_alloc(m->nt * sizeof *place);
  hilbert_sort(m->xy, n, curve, NULL, spare_block(&spare, 2 * n * sizeof(uint64_t)), 1);
  for (VertId k = 0; k < n; k++) rank[curve[k]] = k;
  place_triangles(m, rank, spare_block(&spare, (n + 2) * sizeof *place), place);
  VertId next = number_vertices(r, first, curve, curve, rank);
  move_triangles(m, &spare, place, rank);
  permute_doubles(m->xy, n, &spare, curve, first, next, 2);
  permute_doubles(r->size, n, &spare, curve, first, next, 1);
  if (r->carried) permute_doubles(r->carried, n, &spare, curve, first, next, 1);
  if (m->seg) {
    m->seg = spare_block(&spare, 3 * (size_t)m->cap_t * sizeof *m->seg);
    put_segments(m, &segments, place);
    spare.block = NULL;
  }
  m->nv = next;
  free(m->hint);
  m->hint = NULL;
  vec_free(&segments);
  free(curve), free(rank), free(place), free(spare.block);
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
