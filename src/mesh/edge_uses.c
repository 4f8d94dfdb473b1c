// edge_uses.c - which elements of a mesh, lines and surface elements of all entities alike, have which edges
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/edge_uses.h"

void elem_ids_make(ElemIds *ids, const Mesh *m)
{
  ids->base = mem_alloc((m->nblock + 1) * sizeof *ids->base);
  ids->nelem = ids->line0 = ids->surface0 = 0;
  for (size_t b = 0; b < m->nblock; b++) {
    ids->base[b] = ids->nelem;
    ids->nelem += m->block[b].n;
    if (elem_dim(m->block[b].type) == 0) ids->line0 = ids->nelem;
    if (elem_dim(m->block[b].type) <= 1) ids->surface0 = ids->nelem;
  }
  ids->base[m->nblock] = ids->nelem;
}

void elem_ids_free(ElemIds *ids) { free(ids->base); }

uint32_t elem_ids_block(const ElemIds *ids, const Mesh *m, size_t elem)
{
  size_t lo = 0, hi = m->nblock;
  while (hi - lo > 1) {
    size_t mid = (lo + hi) / 2;
    if (ids->base[mid] <= elem)
      lo = mid;
    else
      hi = mid;
  }
  return (uint32_t)lo;
}

const uint32_t *elem_ids_nodes(const ElemIds *ids, const Mesh *m, size_t elem, ElemType *type)
{
  uint32_t b = elem_ids_block(ids, m, elem);
  *type = m->block[b].type;
  return m->block[b].node + (elem - ids->base[b]) * (size_t)elem_nodes(*type);
}

// Edges of an element: a line has one.
static int edges_of(ElemType t) { return elem_dim(t) == 0 ? 0 : elem_dim(t) == 1 ? 1 : elem_corners(t); }

static bool before(const EdgeUse *a, const EdgeUse *b)
{
  return a->upper != b->upper ? a->upper < b->upper : a->elem < b->elem;
}

static int use_order(const void *x, const void *y) { return before(x, y) ? -1 : before(y, x); }

static void sort_uses(EdgeUse *u, size_t n)
{
  if (n > 24) {
    qsort(u, n, sizeof *u, use_order);
    return;
  }
  for (size_t i = 1; i < n; i++) {
    EdgeUse x = u[i];
    size_t j = i;
    for (; j > 0 && before(&x, &u[j - 1]); j--) u[j] = u[j - 1];
    u[j] = x;
  }
}

// Count the uses of each lower node into at[node + 1], or with `use` place them at at[node]++.
static void each_edge(const Mesh *m, const ElemIds *ids, size_t *at, EdgeUse *use)
{
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    int nodes = elem_nodes(k->type), corners = elem_corners(k->type), edges = edges_of(k->type);
    for (size_t i = 0; i < k->n; i++) {
      const uint32_t *v = k->node + i * (size_t)nodes;
      for (int c = 0; c < edges; c++) {
        uint32_t p = v[c], q = v[c + 1 == corners ? 0 : c + 1], low = MIN(p, q);
        if (use)
          use[at[low]++] = (EdgeUse){low, MAX(p, q), (uint32_t)(ids->base[b] + i)};
        else
          at[low + 1]++;
      }
    }
  }
}

void edge_uses_make(EdgeUses *u, const Mesh *m, const ElemIds *ids)
{
  size_t *at = mem_zalloc((m->nnode + 1) * sizeof *at);
  each_edge(m, ids, at, NULL);
  for (size_t i = 0; i < m->nnode; i++) at[i + 1] += at[i];
  u->n = at[m->nnode];
  u->use = mem_alloc(u->n * sizeof *u->use);
  each_edge(m, ids, at, u->use); // at[i] now ends the uses of node i
  for (size_t i = 0, from = 0; i < m->nnode; from = at[i++]) sort_uses(u->use + from, at[i] - from);
  free(at);
}

void edge_uses_free(EdgeUses *u) { free(u->use); }
