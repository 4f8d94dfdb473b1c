// mesh_edges.c - which surface elements share which edges, face by face
// SPDX-License-Identifier: MIT
//
// Face by face, half-edges are gathered by their lower node (a counting sort over the face's own nodes); within a node's few
// entries those of equal upper node are matched.
#include "base/base.h"

#include "mesh/mesh_edges.h"

// A use of an edge: its upper node, the half-edge counted from the face's first, and a last bit that says that it runs downwards.
// Their order is that of the numbers.
typedef uint64_t Use;

static uint32_t use_half(Use u) { return (uint32_t)u >> 1; }

static int use_order(const void *x, const void *y)
{
  const Use *a = x, *b = y;
  return *a < *b ? -1 : *a > *b;
}

static void sort_uses(Use *u, size_t n)
{
  if (n > 24) {
    qsort(u, n, sizeof *u, use_order);
    return;
  }
  for (size_t i = 1; i < n; i++) {
    Use x = u[i];
    size_t j = i;
    for (; j > 0 && u[j - 1] > x; j--) u[j] = u[j - 1];
    u[j] = x;
  }
}

// Uses u[0..n) of one edge in the face whose half-edges have the twins twin[], numbered from `base`.
static void match(uint32_t *twin, size_t base, const Use *u, size_t n)
{
  if (n == 1)
    twin[use_half(u[0])] = NONE;
  else if (n == 2 && ((u[0] ^ u[1]) & 1)) {
    twin[use_half(u[0])] = (uint32_t)base + use_half(u[1]);
    twin[use_half(u[1])] = (uint32_t)base + use_half(u[0]);
  } else
    for (size_t i = 0; i < n; i++) twin[use_half(u[i])] = EDGE_BAD;
}

// What is at hand for a face.
typedef struct {
  uint32_t *at;     // per node of the mesh, all 0 between faces: uses it is the lower node of, then where the next one goes
  U32Vec lower;     // the face's nodes that are the lower one of an edge, as they appear
  Use *use;
} Gather;

static void count_uses(Gather *g, const MeshBlock *k)
{
  size_t nodes = (size_t)elem_nodes(k->type), corners = (size_t)elem_corners(k->type);
  for (size_t i = 0; i < k->n; i++) {
    const uint32_t *v = k->node + i * nodes;
    for (size_t c = 0; c < corners; c++) {
      uint32_t a = v[c], b = v[c + 1 == corners ? 0 : c + 1], low = MIN(a, b);
      if (UNLIKELY(!g->at[low]++)) vec_push(&g->lower, low);
    }
  }
}

static void place_uses(Gather *g, const MeshBlock *k, uint64_t half)
{
  size_t nodes = (size_t)elem_nodes(k->type), corners = (size_t)elem_corners(k->type);
  for (size_t i = 0; i < k->n; i++) {
    const uint32_t *v = k->node + i * nodes;
    for (size_t c = 0; c < corners; c++, half++) {
      uint32_t a = v[c], b = v[c + 1 == corners ? 0 : c + 1];
      g->use[g->at[MIN(a, b)]++] = (uint64_t)MAX(a, b) << 32 | half << 1 | (a > b);
    }
  }
}

// Blocks first .. last-1 are those of a face.
static void pair_face(MeshEdges *e, const Mesh *m, uint32_t first, uint32_t last, Gather *g)
{
  size_t base = e->base[first];
  vec_clear(&g->lower);
  for (uint32_t b = first; b < last; b++) count_uses(g, &m->block[b]);
  uint32_t sum = 0;
  for (size_t i = 0; i < g->lower.len; i++) {
    uint32_t n = g->at[g->lower.data[i]];
    g->at[g->lower.data[i]] = sum;
    sum += n;
  }
  for (uint32_t b = first; b < last; b++) place_uses(g, &m->block[b], e->base[b] - base);
  uint32_t from = 0; // `at` is now where the node's uses end
  for (size_t i = 0; i < g->lower.len; i++) {
    uint32_t to = g->at[g->lower.data[i]];
    g->at[g->lower.data[i]] = 0;
    sort_uses(g->use + from, to - from);
    for (uint32_t j = from, k; j < to; j = k) {
      for (k = j + 1; k < to && g->use[k] >> 32 == g->use[j] >> 32;) k++;
      match(e->twin + base, base, g->use + j, k - j);
    }
    from = to;
  }
}

void mesh_edges_make(MeshEdges *e, const Mesh *m)
{
  e->base = mem_alloc((m->nblock + 1) * sizeof *e->base);
  e->n = 0;
  size_t most = 0;
  for (uint32_t b = 0, first = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (k->entity != m->block[first].entity) first = b;
    e->base[b] = e->n;
    if (elem_dim(k->type) == 2) e->n += k->n * (size_t)elem_corners(k->type);
    most = MAX(most, e->n - e->base[first]);
  }
  e->base[m->nblock] = e->n;
  CHECK(e->n < EDGE_BAD / 2);
  e->twin = mem_alloc(e->n * sizeof *e->twin);
  Gather g = {mem_zalloc((m->nnode + 1) * sizeof *g.at), {0}, mem_alloc(most * sizeof *g.use)};
  vec_reserve(&g.lower, m->nnode);
  for (uint32_t b = 0, end; b < m->nblock; b = end) {
    for (end = b + 1; end < m->nblock && m->block[end].entity == m->block[b].entity;) end++;
    if (elem_dim(m->block[b].type) == 2) pair_face(e, m, b, end, &g);
  }
  free(g.at);
  free(g.use);
  vec_free(&g.lower);
}

void mesh_edges_free(MeshEdges *e)
{
  free(e->base);
  free(e->twin);
}

HalfEdge mesh_edges_at(const MeshEdges *e, const Mesh *m, size_t h)
{
  size_t lo = 0, hi = m->nblock; // base[lo] <= h < base[hi]
  while (hi - lo > 1) {
    size_t mid = (lo + hi) / 2;
    if (e->base[mid] <= h)
      lo = mid;
    else
      hi = mid;
  }
  const MeshBlock *k = &m->block[lo];
  size_t corners = (size_t)elem_corners(k->type), r = h - e->base[lo];
  HalfEdge x = {.block = (uint32_t)lo, .corner = (uint32_t)(r % corners), .element = r / corners};
  const uint32_t *v = k->node + x.element * (size_t)elem_nodes(k->type);
  x.a = v[x.corner];
  x.b = v[(x.corner + 1) % corners];
  return x;
}
