// cell_graph.c - the dual graph of a mesh: its elements as vertices, joined where they share an edge
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/cell_graph.h"

typedef struct {
  uint32_t a, b;
} Link;

typedef Vec(Link) LinkVec;

typedef struct {
  const Mesh *m;
  const ElemIds *ids;
  CellGraph *g;
  uint32_t *at_node; // per node: the first cell there, or NONE
  LinkVec link;      // between cells, a < b
} Builder;

static void add_cell(Builder *b, size_t elem)
{
  b->g->cell[elem] = (uint32_t)b->g->n;
  b->g->elem[b->g->n++] = (uint32_t)elem;
}

static void touch_node(Builder *b, uint32_t node, uint32_t cell)
{
  if (b->at_node[node] == NONE) b->at_node[node] = cell;
}

static void add_surfaces(Builder *b)
{
  for (size_t e = b->ids->surface0; e < b->ids->nelem; e++) add_cell(b, e);
  size_t cell = 0;
  for (size_t i = 0; i < b->m->nblock; i++) {
    const MeshBlock *k = &b->m->block[i];
    if (elem_dim(k->type) != 2) continue;
    size_t nodes = (size_t)elem_nodes(k->type), corners = (size_t)elem_corners(k->type);
    for (size_t j = 0; j < k->n; j++, cell++)
      for (size_t c = 0; c < corners; c++) touch_node(b, k->node[j * nodes + c], (uint32_t)cell);
  }
}

// Surface elements across their edges; more than two on an edge are joined in a row. Lines find their surface
// element.
static void link_edges(Builder *b, const EdgeUses *uses)
{
  for (size_t i = 0, j; i < uses->n; i = j) {
    uint32_t before = NONE;
    j = edge_uses_end(uses, i);
    for (size_t k = j; k-- > i;) {
      uint32_t e = uses->use[k].elem;
      if (e < b->ids->surface0) {
        if (before != NONE) b->g->cell[e] = before;
      } else {
        uint32_t c = b->g->cell[e];
        if (before != NONE && before != c) vec_push(&b->link, ((Link){c, before}));
        before = c;
      }
    }
  }
}

// Lines without a surface element beside them are cells, joined through the first cell of each node.
static void add_lines(Builder *b)
{
  for (size_t e = b->ids->line0; e < b->ids->surface0; e++) {
    if (b->g->cell[e] != NONE) continue;
    ElemType type;
    const uint32_t *v = elem_ids_nodes(b->ids, b->m, e, &type);
    add_cell(b, e);
    for (int k = 0; k < 2; k++) {
      uint32_t there = b->at_node[v[k]], c = b->g->cell[e];
      if (there != NONE && there != c) vec_push(&b->link, ((Link){there, c}));
      touch_node(b, v[k], c);
    }
  }
}

// Points of no other element, such as centres of arcs, go with the first cell, and are cells only where
// nothing else is there.
static void add_points(Builder *b)
{
  bool only = b->g->n == 0;
  for (size_t e = 0; e < b->ids->line0; e++) {
    ElemType type;
    uint32_t node = elem_ids_nodes(b->ids, b->m, e, &type)[0];
    if (b->at_node[node] != NONE)
      b->g->cell[e] = b->at_node[node];
    else if (only)
      add_cell(b, e);
    else
      b->g->cell[e] = 0;
  }
}

// Both directions of every link, sorted and each once.
static void make_adjacency(CellGraph *g, const LinkVec *link)
{
  g->start = mem_zalloc((g->n + 2) * sizeof *g->start);
  g->next = mem_alloc(2 * link->len * sizeof *g->next);
  uint32_t *at = g->start + 1; // becomes start once all are placed
  for (size_t i = 0; i < link->len; i++) {
    at[link->data[i].a + 1]++;
    at[link->data[i].b + 1]++;
  }
  for (size_t c = 0; c < g->n; c++) at[c + 1] += at[c];
  for (size_t i = 0; i < link->len; i++) {
    g->next[at[link->data[i].a]++] = link->data[i].b;
    g->next[at[link->data[i].b]++] = link->data[i].a;
  }
  uint32_t kept = 0;
  for (size_t c = 0, from = 0; c < g->n; c++) {
    size_t to = g->start[c + 1], first = kept;
    g->start[c] = kept;
    for (size_t i = from; i < to; i++) {
      uint32_t x = g->next[i];
      size_t j = kept;
      while (j > first && g->next[j - 1] > x) j--;
      if (j > first && g->next[j - 1] == x) continue;
      memmove(g->next + j + 1, g->next + j, (kept - j) * sizeof *g->next);
      g->next[j] = x;
      kept++;
    }
    from = to;
  }
  g->start[g->n] = kept;
}

void cell_graph_make(CellGraph *g, const Mesh *m, const ElemIds *ids, const EdgeUses *uses)
{
  *g = (CellGraph){0};
  Builder b = {.m = m, .ids = ids, .g = g};
  g->elem = mem_alloc(ids->nelem * sizeof *g->elem);
  g->cell = mem_alloc(ids->nelem * sizeof *g->cell);
  b.at_node = mem_alloc(m->nnode * sizeof *b.at_node);
  if (ids->nelem) memset(g->cell, 0xff, ids->nelem * sizeof *g->cell);
  if (m->nnode) memset(b.at_node, 0xff, m->nnode * sizeof *b.at_node);
  add_surfaces(&b);
  link_edges(&b, uses);
  add_lines(&b);
  add_points(&b);
  make_adjacency(g, &b.link);
  vec_free(&b.link);
  free(b.at_node);
}

void cell_graph_of_mesh(CellGraph *g, ElemIds *ids, const Mesh *m)
{
  EdgeUses uses;
  elem_ids_make(ids, m);
  edge_uses_make(&uses, m, ids);
  cell_graph_make(g, m, ids, &uses);
  edge_uses_free(&uses);
}

void cell_graph_free(CellGraph *g)
{
  free(g->elem);
  free(g->cell);
  free(g->start);
  free(g->next);
}

uint32_t cell_graph_components(const CellGraph *g, const uint32_t *label, uint32_t *component)
{
  uint32_t *stack = mem_alloc(g->n * sizeof *stack), count = 0;
  if (g->n) memset(component, 0xff, g->n * sizeof *component);
  for (uint32_t first = 0; first < g->n; first++) {
    if (component[first] != NONE) continue;
    size_t top = 0;
    stack[top++] = first;
    component[first] = count;
    while (top) {
      uint32_t c = stack[--top];
      for (uint32_t i = g->start[c]; i < g->start[c + 1]; i++) {
        uint32_t d = g->next[i];
        if (component[d] != NONE || (label && label[d] != label[c])) continue;
        component[d] = count;
        stack[top++] = d;
      }
    }
    count++;
  }
  free(stack);
  return count;
}
