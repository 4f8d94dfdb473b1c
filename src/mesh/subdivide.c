// subdivide.c - meshes made finer, or all quadrangles, by splitting every element
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/subdivide.h"

#include "mesh/edge_table.h"

typedef struct {
  const Mesh *m;
  Subdivision how;
  EdgeTable table;
  Enriched e;
} Splitter;

static int centres(ElemType type, void *how)
{
  return type == ELEM_QUAD4 || *(const Subdivision *)how != SUBDIVIDE_HALVE;
}

static void place_nodes(Splitter *s, const Model *model)
{
  Mesh *out = s->e.mesh;
  if (s->how != SUBDIVIDE_BARYCENTRIC)
    for (uint32_t i = 0; i < s->table.n; i++) {
      double u;
      Vec3 p = edge_table_point(&s->table, s->m, model, i, 0.5, &u);
      mesh_set_node(out, s->e.edge[i], p, u);
    }
  for (size_t b = 0; b < s->m->nblock; b++) {
    const MeshBlock *from = &s->m->block[b];
    if (elem_dim(from->type) != 2 || !centres(from->type, &s->how)) continue;
    size_t c = (size_t)elem_corners(from->type);
    for (size_t k = 0; k < from->n; k++) {
      Vec3 sum = {0, 0, 0};
      for (size_t i = 0; i < c; i++) sum = vec3_add(sum, mesh_xyz(s->m, from->node[c * k + i]));
      mesh_set_node(out, s->e.cell[b][k], vec3_scale(1 / (double)c, sum), NAN);
    }
  }
}

static uint32_t middle(const Splitter *s, uint32_t a, uint32_t b) { return enriched_at(&s->e, &s->table, 1, a, b, 0); }

static uint32_t *add_block(Splitter *s, const MeshBlock *from, ElemType type, size_t parts)
{
  return enriched_block(&s->e, from->entity, type, parts * from->n);
}

static uint32_t *put3(uint32_t *to, uint32_t a, uint32_t b, uint32_t c)
{
  to[0] = a;
  to[1] = b;
  to[2] = c;
  return to + 3;
}

static uint32_t *put4(uint32_t *to, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
  to[0] = a;
  to[1] = b;
  to[2] = c;
  to[3] = d;
  return to + 4;
}

static void split_lines(Splitter *s, const MeshBlock *from)
{
  bool halve = s->how != SUBDIVIDE_BARYCENTRIC;
  uint32_t *to = add_block(s, from, ELEM_LINE2, halve ? 2 : 1);
  for (size_t k = 0; k < from->n; k++) {
    uint32_t a = from->node[2 * k], b = from->node[2 * k + 1];
    *to++ = s->e.node[a];
    if (halve) {
      *to++ = enriched_on_line(&s->e, &s->table, 1, from->entity, a, b, 0);
      to[0] = to[-1];
      to++;
    }
    *to++ = s->e.node[b];
  }
}

// One quadrangle, or two corners and the centre as a triangle, for each corner of each element.
static uint32_t *split_about_centres(const Splitter *s, const MeshBlock *from, const uint32_t *cell, uint32_t *to)
{
  size_t c = (size_t)elem_corners(from->type);
  for (size_t k = 0; k < from->n; k++)
    for (size_t i = 0; i < c; i++) {
      const uint32_t *v = from->node + c * k;
      uint32_t here = v[i], next = v[(i + 1) % c], before = v[(i + c - 1) % c];
      if (s->how == SUBDIVIDE_BARYCENTRIC)
        to = put3(to, s->e.node[here], s->e.node[next], cell[k]);
      else
        to = put4(to, s->e.node[here], middle(s, here, next), cell[k], middle(s, before, here));
    }
  return to;
}

static void halve_triangles(Splitter *s, const MeshBlock *from)
{
  uint32_t *to = add_block(s, from, ELEM_TRI3, 4);
  for (size_t k = 0; k < from->n; k++) {
    const uint32_t *v = from->node + 3 * k, *id = s->e.node;
    uint32_t ab = middle(s, v[0], v[1]), bc = middle(s, v[1], v[2]), ca = middle(s, v[2], v[0]);
    to = put3(to, id[v[0]], ab, ca);
    to = put3(to, ab, id[v[1]], bc);
    to = put3(to, ca, bc, id[v[2]]);
    to = put3(to, ab, bc, ca);
  }
}

static void split_entity(Splitter *s, size_t first, size_t end)
{
  // The triangles and quadrangles of one face come in up to two blocks, and may end in one of a single type.
  ElemType one = s->how == SUBDIVIDE_QUADS ? ELEM_QUAD4 : ELEM_TRI3;
  const MeshBlock *b = &s->m->block[first];
  if (s->how == SUBDIVIDE_HALVE) {
    for (size_t i = first; i < end; i++, b++)
      if (b->type == ELEM_TRI3)
        halve_triangles(s, b);
      else
        split_about_centres(s, b, s->e.cell[i], add_block(s, b, ELEM_QUAD4, 4));
    return;
  }
  size_t n = 0;
  for (size_t i = first; i < end; i++) n += s->m->block[i].n * (size_t)elem_corners(s->m->block[i].type);
  uint32_t *to = enriched_block(&s->e, b->entity, one, n);
  for (size_t i = first; i < end; i++) to = split_about_centres(s, &s->m->block[i], s->e.cell[i], to);
}

Mesh *mesh_subdivide(const Mesh *m, Subdivision how, const Model *model)
{
  Splitter s = {.m = m, .how = how};
  int per_edge = how != SUBDIVIDE_BARYCENTRIC;
  edge_table_make(&s.table, m);
  enrich(&s.e, m, &s.table, per_edge, centres, &how);
  place_nodes(&s, model);
  for (size_t i = 0, j; i < m->nblock; i = j) {
    const MeshBlock *b = &m->block[i];
    for (j = i + 1; j < m->nblock && m->block[j].entity == b->entity;) j++;
    if (elem_dim(b->type) == 0) {
      uint32_t *to = add_block(&s, b, ELEM_POINT, 1);
      for (size_t k = 0; k < b->n; k++) to[k] = s.e.node[b->node[k]];
    } else if (elem_dim(b->type) == 1) {
      split_lines(&s, b);
    } else {
      split_entity(&s, i, j);
    }
  }
  enrich_periodic(&s.e, m, &s.table, per_edge);
  enriched_free(&s.e, m);
  edge_table_free(&s.table);
  return s.e.mesh;
}
