// part_points.c - nodes onto the pieces of entities, and points where pieces and seams end
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/part_entities_int.h"

static void put(Division *d, uint32_t node, int dim, uint32_t piece)
{
  d->node_dim[node] = (uint8_t)dim;
  d->node_piece[node] = piece;
}

// A node inside a surface goes with the first element of that surface, others with the first element at all.
static void on_surfaces(Division *d)
{
  const Mesh *m = d->m;
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (elem_dim(k->type) != 2) continue;
    size_t nodes = (size_t)elem_nodes(k->type);
    const uint32_t *of = d->of + d->ids.base[b];
    for (size_t i = 0; i < k->n; i++)
      for (size_t c = 0; c < nodes; c++) {
        uint32_t v = k->node[i * nodes + c], now = d->node_piece[v];
        if (now == NONE || (m->node_entity[v] == k->entity && d->piece[2].data[now].entity != k->entity))
          put(d, v, 2, of[i]);
      }
  }
}

static void on_seams(Division *d)
{
  for (uint32_t p = 0; p < d->piece[1].len; p++) {
    const Piece *q = &d->piece[1].data[p];
    size_t n = q->between ? q->n * (size_t)elem_nodes(q->type) : 0;
    for (size_t i = 0; i < n; i++) put(d, d->node.data[q->first + i], 1, p);
  }
}

static void on_curves(Division *d)
{
  const Mesh *m = d->m;
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (elem_dim(k->type) != 1) continue;
    size_t nodes = (size_t)elem_nodes(k->type);
    for (size_t i = 0; i < k->n; i++)
      for (size_t c = 0; c < nodes; c++) {
        uint32_t v = k->node[i * nodes + c];
        if (d->node_dim[v] == 1 && !d->piece[1].data[d->node_piece[v]].between) continue;
        put(d, v, 1, d->of[d->ids.base[b] + i]);
      }
  }
}

// ---- points ------------------------------------------------------------
static uint32_t point_piece(Division *d, Map *seen, uint32_t entity, uint32_t set)
{
  bool added;
  uint32_t p = *map_slot(seen, (uint64_t)entity << 32 | set, (uint32_t)d->piece[0].len, &added);
  if (added) vec_push(&d->piece[0], ((Piece){.entity = entity, .set = set, .ends = {NONE, NONE}}));
  return p;
}

// Points of the model are in the part of their element, or where they have none, of what lies about them.
static void on_points(Division *d)
{
  const Mesh *m = d->m;
  Map seen = {0};
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    for (size_t i = 0; elem_dim(k->type) == 0 && i < k->n; i++) {
      uint32_t p = point_piece(d, &seen, k->entity, part_sets__get(&d->sets, &k->part[i], 1));
      d->of[d->ids.base[b] + i] = p;
      put(d, k->node[i], 0, p);
    }
  }
  for (uint32_t v = 0; v < m->nnode; v++) {
    uint32_t e = m->node_entity[v], now = d->node_piece[v];
    if (m->entity[e].dim != 0 || now == NONE || d->node_dim[v] == 0) continue;
    uint32_t n, part = part_sets__at(&d->sets, d->piece[d->node_dim[v]].data[now].set, &n)[0];
    put(d, v, 0, point_piece(d, &seen, e, part_sets__get(&d->sets, &part, 1)));
  }
  map_free(&seen);
}

// All parts of the links at a node.
static uint32_t parts_at(Division *d, const Chains *c, uint32_t node)
{
  uint32_t k = c->first[node], set = c->link.data[k / 2].set;
  for (; k != NONE; k = c->next[k]) set = part_sets__union(&d->sets, set, c->link.data[k / 2].set);
  return set;
}

// The points at which pieces and seams end, on the curve or surface they lie on. A point of the model has one
// of its own for seams.
static void add_end(Division *d, uint32_t v)
{
  uint32_t line = d->curves.first[v], seam = d->seams.first[v], entity = d->m->node_entity[v];
  bool of_model = d->m->entity[entity].dim == 0;
  if (of_model && seam == NONE) return;
  uint32_t set = parts_at(d, seam != NONE ? &d->seams : &d->curves, v), piece = (uint32_t)d->piece[0].len;
  if (of_model)
    entity = line != NONE ? d->curves.link.data[line / 2].entity : d->seams.link.data[seam / 2].entity;
  vec_push(&d->piece[0], ((Piece){.entity = entity,
                                  .set = set,
                                  .between = true,
                                  .type = ELEM_POINT,
                                  .first = d->node.len,
                                  .n = 1,
                                  .ends = {NONE, NONE}}));
  vec_push(&d->node, v);
  d->end_piece[v] = piece;
  if (!of_model) put(d, v, 0, piece);
}

void division__nodes(Division *d)
{
  const Mesh *m = d->m;
  on_surfaces(d);
  on_seams(d);
  on_curves(d);
  on_points(d);
  for (uint32_t v = 0; v < m->nnode; v++)
    if (d->ends[v]) add_end(d, v);
  for (size_t i = 0; i < d->piece[1].len; i++) {
    Piece *p = &d->piece[1].data[i];
    for (int k = 0; k < 2; k++)
      if (p->ends[k] != NONE) p->ends[k] = p->between ? d->end_piece[p->ends[k]] : d->node_piece[p->ends[k]];
  }
}
