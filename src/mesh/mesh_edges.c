// mesh_edges.c - which surface elements share which edges, face by face
// SPDX-License-Identifier: MIT
//
// Half-edges are gathered by their lower node (a counting sort); within a node's few entries those of equal upper node and
// face are matched.
#include "base/base.h"

#include "mesh/mesh_edges.h"

typedef struct {
  uint32_t upper, face;
  uint32_t half;   // index of the half-edge
  uint32_t down;   // 1 if it runs from the upper to the lower node
} Use;

static int use_order(const void *x, const void *y)
{
  const Use *a = x, *b = y;
  if (a->upper != b->upper) return a->upper < b->upper ? -1 : 1;
  if (a->face != b->face) return a->face < b->face ? -1 : 1;
  return a->half < b->half ? -1 : a->half > b->half;
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
    for (; j > 0 && use_order(&u[j - 1], &x) > 0; j--) u[j] = u[j - 1];
    u[j] = x;
  }
}

// Uses u[0..n) of one edge in one face.
static void match(MeshEdges *e, const Use *u, size_t n)
{
  if (n == 1)
    e->twin[u[0].half] = NONE;
  else if (n == 2 && u[0].down != u[1].down) {
    e->twin[u[0].half] = u[1].half;
    e->twin[u[1].half] = u[0].half;
  } else
    for (size_t i = 0; i < n; i++) e->twin[u[i].half] = EDGE_BAD;
}

static void count_uses(const MeshBlock *k, uint32_t *start)
{
  int nodes = elem_nodes(k->type), corners = elem_corners(k->type);
  for (size_t i = 0; i < k->n; i++) {
    const uint32_t *v = k->node + i * (size_t)nodes;
    for (int c = 0; c < corners; c++) {
      uint32_t a = v[c], b = v[c + 1 == corners ? 0 : c + 1];
      start[(a < b ? a : b) + 1]++;
    }
  }
}

static void place_uses(const MeshBlock *k, size_t half, uint32_t *start, Use *use)
{
  int nodes = elem_nodes(k->type), corners = elem_corners(k->type);
  for (size_t i = 0; i < k->n; i++) {
    const uint32_t *v = k->node + i * (size_t)nodes;
    for (int c = 0; c < corners; c++, half++) {
      uint32_t a = v[c], b = v[c + 1 == corners ? 0 : c + 1];
      use[start[a < b ? a : b]++] = (Use){a < b ? b : a, k->entity, (uint32_t)half, a > b};
    }
  }
}

void mesh_edges_make(MeshEdges *e, const Mesh *m)
{
  e->base = mem_alloc((m->nblock + 1) * sizeof *e->base);
  e->n = 0;
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    e->base[b] = e->n;
    if (elem_dim(k->type) == 2) e->n += k->n * (size_t)elem_corners(k->type);
  }
  e->base[m->nblock] = e->n;
  CHECK(e->n < EDGE_BAD);
  e->twin = mem_alloc(e->n * sizeof *e->twin);
  uint32_t *start = mem_zalloc((m->nnode + 2) * sizeof *start);
  Use *use = mem_alloc(e->n * sizeof *use);
  for (size_t b = 0; b < m->nblock; b++)
    if (elem_dim(m->block[b].type) == 2) count_uses(&m->block[b], start);
  for (size_t i = 0; i < m->nnode; i++) start[i + 1] += start[i];
  for (size_t b = 0; b < m->nblock; b++)
    if (elem_dim(m->block[b].type) == 2) place_uses(&m->block[b], e->base[b], start, use);
  // start[i] is now where node i's uses end.
  for (size_t i = 0; i < m->nnode; i++) {
    uint32_t from = i ? start[i - 1] : 0, to = start[i];
    sort_uses(use + from, to - from);
    for (uint32_t j = from, k; j < to; j = k) {
      for (k = j + 1; k < to && use[k].upper == use[j].upper && use[k].face == use[j].face;) k++;
      match(e, use + j, k - j);
    }
  }
  free(use);
  free(start);
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
