// mesh_index.c - irregular vertices of the faces of quadrangles, by their index
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_index.h"

#include "mesh/mesh_edges.h"

// Of the face at hand.
typedef struct {
  const Mesh *m;
  const MeshEdges *edges;
  uint8_t *valence, *rim; // by node: elements, and boundary edges; 0 between faces
  U32Vec node;            // those with elements
  size_t sides, borders;
} Face;

static void look_at(Face *f, uint32_t b)
{
  const MeshBlock *k = &f->m->block[b];
  size_t nodes = (size_t)elem_nodes(k->type), h = f->edges->base[b];
  for (size_t i = 0; i < k->n; i++)
    for (size_t c = 0; c < 4; c++, h++) {
      uint32_t v = k->node[i * nodes + c], w = k->node[i * nodes + (c + 1) % 4];
      if (!f->valence[v]) vec_push(&f->node, v);
      if (f->valence[v] < 255) f->valence[v]++;
      f->sides++;
      if (f->edges->twin[h] < EDGE_BAD) continue;
      f->borders++;
      f->rim[v] = (uint8_t)MIN(f->rim[v] + 1, 255);
      f->rim[w] = (uint8_t)MIN(f->rim[w] + 1, 255);
    }
}

static void count(Face *f, MeshIndices *s)
{
  for (size_t i = 0; i < f->node.len; i++) {
    uint32_t v = f->node.data[i];
    int index = 4 - f->rim[v] - f->valence[v];
    s->sum4 += index;
    (f->rim[v] ? s->boundary : s->inside)[MAX(index, INDEX_LEAST) - INDEX_LEAST]++;
    f->rim[v] = f->valence[v] = 0;
  }
  s->euler += (long)f->node.len - (long)(f->sides + f->borders) / 2 + (long)f->sides / 4;
  s->faces++;
  vec_clear(&f->node);
  f->sides = f->borders = 0;
}

void mesh_indices_make(MeshIndices *s, const Mesh *m)
{
  *s = (MeshIndices){0};
  if (!mesh_count_corners(m, 4)) return;
  MeshEdges edges;
  mesh_edges_make(&edges, m);
  Face f = {.m = m, .edges = &edges, .valence = mem_zalloc(m->nnode + 1), .rim = mem_zalloc(m->nnode + 1)};
  for (uint32_t b = 0, end; b < m->nblock; b = end) {
    bool quads = true;
    size_t n = 0;
    for (end = b; end < m->nblock && m->block[end].entity == m->block[b].entity; end++) {
      n += m->block[end].n;
      quads = quads && (elem_corners(m->block[end].type) == 4 || !m->block[end].n);
    }
    if (!quads || !n) continue;
    for (uint32_t k = b; k < end; k++) look_at(&f, k);
    count(&f, s);
  }
  vec_free(&f.node);
  free(f.valence);
  free(f.rim);
  mesh_edges_free(&edges);
}
