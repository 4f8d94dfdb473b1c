// partition_stats.c - what the report says of a partition: sizes of the parts, edges between them, neighbours
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/partition_stats.h"

#include "base/map.h"
#include "mesh/cell_graph.h"
#include "mesh/part_nodes.h"

static void count_elements(PartitionStats *s, const Mesh *m)
{
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (!k->part || elem_dim(k->type) == 0) continue;
    for (size_t i = 0; i < k->n; i++) {
      PartInfo *p = &s->part[k->part[i] - 1];
      if (elem_dim(k->type) == 1)
        p->lines++;
      else if (elem_corners(k->type) == 3)
        p->triangles++;
      else
        p->quads++;
    }
  }
}

static void count_cut(PartitionStats *s, const CellGraph *g, const uint32_t *part)
{
  for (uint32_t c = 0; c < g->n; c++)
    for (uint32_t i = g->start[c]; i < g->start[c + 1]; i++) {
      if (part[g->next[i]] == part[c]) continue;
      s->part[part[c] - 1].cut++;
      s->cut += g->next[i] > c;
    }
}

// Edges and pieces by the dual graph.
static void walk_graph(PartitionStats *s, const Mesh *m)
{
  ElemIds ids;
  CellGraph g;
  cell_graph_of_mesh(&g, &ids, m);
  uint32_t *part = mem_alloc(g.n * sizeof *part), *component = mem_alloc(g.n * sizeof *component);
  for (size_t c = 0, b = 0; c < g.n; c++) {
    size_t e = g.elem[c];
    if (!(b < m->nblock && ids.base[b] <= e && e < ids.base[b + 1])) b = elem_ids_block(&ids, m, e);
    part[c] = m->block[b].part[e - ids.base[b]];
  }
  count_cut(s, &g, part);
  uint32_t n = cell_graph_components(&g, part, component);
  s->pieces = n;
  bool *seen = mem_zalloc(n);
  for (size_t c = 0; c < g.n; c++) {
    if (seen[component[c]]) continue;
    seen[component[c]] = true;
    s->part[part[c] - 1].pieces++;
  }
  free(seen);
  free(part);
  free(component);
  cell_graph_free(&g);
  elem_ids_free(&ids);
}

static void count_neighbours(PartitionStats *s, const PartNodes *nodes)
{
  Map seen = {0};
  for (size_t i = 0; i < nodes->list.len; i += 1 + nodes->list.data[i]) {
    const uint32_t *part = &nodes->list.data[i + 1];
    s->shared_nodes++;
    for (uint32_t a = 0; a < nodes->list.data[i]; a++)
      for (uint32_t b = a + 1; b < nodes->list.data[i]; b++) {
        bool added;
        map_slot(&seen, map_pair(part[a], part[b]), 0, &added);
        if (!added) continue;
        s->part[part[a] - 1].neighbours++;
        s->part[part[b] - 1].neighbours++;
      }
  }
  map_free(&seen);
}

static void count_ghosts(PartitionStats *s, const Mesh *m)
{
  Ghosts g;
  ghosts_make(&g, m);
  for (size_t i = 0; i < g.part.len; i++) s->part[g.part.data[i] - 1].ghosts++;
  ghosts_free(&g);
}

void partition_stats_make(PartitionStats *s, const Mesh *m)
{
  *s = (PartitionStats){.n = m->nparts, .part = mem_zalloc(m->nparts * sizeof(PartInfo)), .least = SIZE_MAX};
  PartNodes nodes;
  count_elements(s, m);
  walk_graph(s, m);
  part_nodes_make(&nodes, m);
  count_neighbours(s, &nodes);
  count_ghosts(s, m);
  size_t total = 0;
  for (uint32_t k = 0; k < s->n; k++) {
    PartInfo *p = &s->part[k];
    p->elements = nodes.dim == 2 ? p->triangles + p->quads : p->lines;
    total += p->elements;
    s->least = MIN(s->least, p->elements);
    s->most = MAX(s->most, p->elements);
    s->neighbours = MAX(s->neighbours, p->neighbours);
  }
  s->mean = (double)total / s->n;
  s->imbalance = total ? (double)s->most / s->mean - 1 : 0;
  part_nodes_free(&nodes);
}

void partition_stats_free(PartitionStats *s) { free(s->part); }
