// part_surfaces.c - surfaces divided in pieces of one part, and what bounds these
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/part_entities_int.h"

typedef struct {
  uint32_t entity, part, first; // first element of the piece
  uint32_t label;
} SurfacePiece;

static int surface_order(const void *x, const void *y)
{
  const SurfacePiece *a = x, *b = y;
  if (a->entity != b->entity) return a->entity < b->entity ? -1 : 1;
  if (a->part != b->part) return a->part < b->part ? -1 : 1;
  return a->first < b->first ? -1 : a->first > b->first;
}

typedef Vec(SurfacePiece) SurfacePieces;

// Label the surface elements (from 0) by entity and part, in order of first elements.
static uint32_t *label_by_part(const Division *d, SurfacePieces *pieces)
{
  const Mesh *m = d->m;
  uint32_t *label = mem_alloc((d->ids.nelem - d->ids.surface0) * sizeof *label), *to = label;
  Map seen = {0};
  for (uint32_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (elem_dim(k->type) != 2) continue;
    for (size_t i = 0; i < k->n; i++) {
      bool added;
      uint32_t fresh = (uint32_t)pieces->len;
      *to = *map_slot(&seen, (uint64_t)k->entity << 32 | k->part[i], fresh, &added);
      if (added) vec_push(pieces, ((SurfacePiece){k->entity, k->part[i], (uint32_t)(to - label), fresh}));
      to++;
    }
  }
  map_free(&seen);
  return label;
}

// The labels divided into connected components.
static void part_components(const Division *d, uint32_t *label, SurfacePieces *pieces)
{
  CellGraph g;
  size_t n = d->ids.nelem - d->ids.surface0;
  cell_graph_make(&g, d->m, &d->ids, &d->uses);
  uint32_t *all = mem_alloc(g.n * sizeof *all), *component = mem_alloc(g.n * sizeof *component);
  for (size_t c = 0; c < g.n; c++) all[c] = c < n ? label[c] : NONE;
  uint32_t count = cell_graph_components(&g, all, component);
  SurfacePiece *old = pieces->data;
  *pieces = (SurfacePieces){0};
  uint32_t *name = mem_alloc(count * sizeof *name);
  memset(name, 0xff, count * sizeof *name);
  for (size_t c = 0; c < n; c++) {
    uint32_t *k = &name[component[c]];
    if (*k == NONE) {
      *k = (uint32_t)pieces->len;
      vec_push(pieces, ((SurfacePiece){old[label[c]].entity, old[label[c]].part, (uint32_t)c, *k}));
    }
    label[c] = *k;
  }
  free(old);
  free(name);
  free(all);
  free(component);
  cell_graph_free(&g);
}

void division__surfaces(Division *d)
{
  SurfacePieces pieces = {0};
  size_t n = d->ids.nelem - d->ids.surface0;
  uint32_t *label = label_by_part(d, &pieces);
  if (d->topology) part_components(d, label, &pieces);
  if (pieces.len) qsort(pieces.data, pieces.len, sizeof *pieces.data, surface_order);
  uint32_t *rank = mem_alloc(pieces.len * sizeof *rank);
  for (size_t i = 0; i < pieces.len; i++) {
    rank[pieces.data[i].label] = (uint32_t)i;
    uint32_t set = part_sets__get(&d->sets, &pieces.data[i].part, 1);
    vec_push(&d->piece[2], ((Piece){.entity = pieces.data[i].entity, .set = set, .ends = {NONE, NONE}}));
  }
  for (size_t c = 0; c < n; c++) d->of[d->ids.surface0 + c] = rank[label[c]];
  free(rank);
  free(label);
  vec_free(&pieces);
}

// ---- bounds ------------------------------------------------------------
// Does the element run the edge from node a to node b?
static bool runs(const Division *d, uint32_t elem, uint32_t a, uint32_t b)
{
  ElemType type;
  const uint32_t *v = elem_ids_nodes(&d->ids, d->m, elem, &type);
  int n = elem_corners(type);
  for (int c = 0; c < n; c++)
    if (v[c] == a && v[c + 1 == n ? 0 : c + 1] == b) return true;
  return false;
}

static void add_bound(Division *d, uint32_t elem, const Link *l)
{
  int id = (int)l->piece + 1;
  vec_push(&d->bound, ((Bound){d->of[elem], runs(d, elem, l->node[0], l->node[1]) ? id : -id}));
}

// Uses i .. j-1 of one edge; seam may be NULL.
static void bound_edge(Division *d, size_t i, size_t j, const Link *seam)
{
  const EdgeUse *u = d->uses.use;
  for (size_t k = i; k < j; k++) {
    if (u[k].elem < d->ids.surface0) continue;
    bool inner = false;
    for (size_t q = i; q < j; q++)
      inner |= q != k && u[q].elem >= d->ids.surface0 && d->of[u[q].elem] == d->of[u[k].elem];
    if (inner) continue;
    if (seam) add_bound(d, u[k].elem, seam);
    for (size_t q = i; q < j && u[q].elem < d->ids.surface0; q++)
      add_bound(d, u[k].elem, &d->curves.link.data[u[q].elem - d->ids.line0]);
  }
}

static int bound_order(const void *x, const void *y)
{
  const Bound *a = x, *b = y;
  if (a->surface != b->surface) return a->surface < b->surface ? -1 : 1;
  if (abs(a->curve) != abs(b->curve)) return abs(a->curve) < abs(b->curve) ? -1 : 1;
  return (a->curve < b->curve) - (a->curve > b->curve);
}

void division__bounds(Division *d)
{
  size_t seam = 0; // they were found in the order of the edges
  for (size_t i = 0, j; i < d->uses.n; i = j) {
    j = edge_uses_end(&d->uses, i);
    const EdgeUse *u = &d->uses.use[i];
    const Link *s = seam < d->seams.link.len ? &d->seams.link.data[seam] : NULL;
    bool here = s && MIN(s->node[0], s->node[1]) == u->lower && MAX(s->node[0], s->node[1]) == u->upper;
    bound_edge(d, i, j, here ? s : NULL);
    seam += here;
  }
  if (d->bound.len) qsort(d->bound.data, d->bound.len, sizeof *d->bound.data, bound_order);
  size_t kept = 0;
  for (size_t i = 0; i < d->bound.len; i++)
    if (!kept || memcmp(&d->bound.data[kept - 1], &d->bound.data[i], sizeof *d->bound.data) != 0)
      d->bound.data[kept++] = d->bound.data[i];
  d->bound.len = kept;
}
