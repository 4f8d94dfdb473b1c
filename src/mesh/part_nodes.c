// part_nodes.c - what parts of a mesh share: nodes of several parts, and elements beside others (ghosts)
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/part_nodes.h"

static int largest_dim(const Mesh *m)
{
  int dim = 0;
  for (size_t b = 0; b < m->nblock; b++)
    if (m->block[b].n) dim = MAX(dim, elem_dim(m->block[b].type));
  return dim;
}

typedef struct {
  uint32_t node, part;
} NodePart;

static int pair_order(const void *x, const void *y)
{
  const NodePart *a = x, *b = y;
  if (a->node != b->node) return a->node < b->node ? -1 : 1;
  return a->part < b->part ? -1 : a->part > b->part;
}

typedef struct {
  PartNodes *p;
  Vec(NodePart) pair; // of nodes of several parts
} Gather;

// The first part of a node, or that there is another.
static void see(Gather *g, uint32_t node, uint32_t part)
{
  uint32_t *of = &g->p->of[node];
  if (*of == 0)
    *of = part;
  else if (*of != part)
    *of = PART_NODES_SEVERAL;
}

static void collect(Gather *g, uint32_t node, uint32_t part)
{
  if (g->p->of[node] == PART_NODES_SEVERAL) vec_push(&g->pair, ((NodePart){node, part}));
}

static void each_corner(Gather *g, const Mesh *m, void (*body)(Gather *, uint32_t, uint32_t))
{
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (!k->part || elem_dim(k->type) != g->p->dim) continue;
    int nodes = elem_nodes(k->type), corners = elem_corners(k->type);
    for (size_t i = 0; i < k->n; i++)
      for (int c = 0; c < corners; c++) body(g, k->node[i * (size_t)nodes + (size_t)c], k->part[i]);
  }
}

void part_nodes_make(PartNodes *p, const Mesh *m)
{
  *p = (PartNodes){.dim = largest_dim(m), .of = mem_zalloc(m->nnode * sizeof(uint32_t))};
  Gather g = {.p = p};
  each_corner(&g, m, see);
  each_corner(&g, m, collect);
  if (g.pair.len) qsort(g.pair.data, g.pair.len, sizeof *g.pair.data, pair_order);
  for (size_t i = 0, j; i < g.pair.len; i = j) {
    uint32_t node = g.pair.data[i].node, head = (uint32_t)p->list.len;
    vec_push(&p->list, 0);
    for (j = i; j < g.pair.len && g.pair.data[j].node == node; j++)
      if (j == i || g.pair.data[j].part != g.pair.data[j - 1].part) vec_push(&p->list, g.pair.data[j].part);
    p->list.data[head] = (uint32_t)(p->list.len - head - 1);
    p->of[node] = PART_NODES_SEVERAL | head;
  }
  vec_free(&g.pair);
}

void part_nodes_free(PartNodes *p)
{
  free(p->of);
  vec_free(&p->list);
}

// Add the parts at a node but the element's own to those the element has so far, which stay ascending.
static void add_parts(Ghosts *g, GhostCell *cell, const uint32_t *part, uint32_t n, uint32_t own)
{
  for (uint32_t i = 0; i < n; i++) {
    if (part[i] == own) continue;
    uint32_t at = cell->n;
    while (at > 0 && g->part.data[cell->first + at - 1] > part[i]) at--;
    if (at > 0 && g->part.data[cell->first + at - 1] == part[i]) continue;
    vec_push(&g->part, 0);
    uint32_t *to = g->part.data + cell->first + at;
    memmove(to + 1, to, (cell->n - at) * sizeof *to);
    *to = part[i];
    cell->n++;
  }
}

void ghosts_make(Ghosts *g, const Mesh *m)
{
  PartNodes p;
  *g = (Ghosts){0};
  part_nodes_make(&p, m);
  for (uint32_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (!k->part || elem_dim(k->type) != p.dim) continue;
    int nodes = elem_nodes(k->type), corners = elem_corners(k->type);
    for (uint32_t i = 0; i < k->n; i++) {
      GhostCell cell = {b, i, (uint32_t)g->part.len, 0};
      for (int c = 0; c < corners; c++) {
        uint32_t node = k->node[i * (size_t)nodes + (size_t)c], n;
        if (!(p.of[node] & PART_NODES_SEVERAL)) continue;
        const uint32_t *part = part_nodes_at(&p, node, &n);
        add_parts(g, &cell, part, n, k->part[i]);
      }
      if (cell.n) vec_push(&g->cell, cell);
    }
  }
  part_nodes_free(&p);
}

void ghosts_free(Ghosts *g)
{
  vec_free(&g->cell);
  vec_free(&g->part);
}
