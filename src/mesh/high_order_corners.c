// high_order_corners.c - a mesh brought back to its corners
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/high_order_int.h"

static int none_inside(ElemType type, void *ctx)
{
  (void)type;
  (void)ctx;
  return 0;
}

// Blocks of m by corners alone; used[n]: whether node n is a corner.
static MeshBlock *corner_blocks(const Mesh *m, bool *used)
{
  MeshBlock *block = mem_alloc((m->nblock + 1) * sizeof *block);
  for (size_t i = 0; i < m->nblock; i++) {
    const MeshBlock *b = &m->block[i];
    int dim = elem_dim(b->type), c = elem_corners(b->type), per = elem_nodes(b->type);
    ElemType type = dim < 1 ? ELEM_POINT : dim == 1 ? ELEM_LINE2 : c == 3 ? ELEM_TRI3 : ELEM_QUAD4;
    block[i] = (MeshBlock){.entity = b->entity, .type = type, .n = b->n};
    block[i].node = mem_alloc((size_t)c * b->n * sizeof(uint32_t));
    for (size_t k = 0; k < b->n; k++)
      for (int j = 0; j < c; j++) {
        uint32_t v = b->node[(size_t)per * k + (size_t)j];
        block[i].node[(size_t)c * k + (size_t)j] = v;
        used[v] = true;
      }
  }
  return block;
}

// Nodes of m that are used, to arrays of their own; by old node the new one, or NONE.
static uint32_t *squeeze_nodes(const Mesh *m, const bool *used, Mesh *to)
{
  uint32_t *id = mem_alloc((m->nnode + 1) * sizeof *id);
  to->xyz = mem_alloc(3 * m->nnode * sizeof *to->xyz);
  to->node_entity = mem_alloc(m->nnode * sizeof *to->node_entity);
  to->node_u = mem_alloc(m->nnode * sizeof *to->node_u);
  to->nnode = 0;
  for (size_t n = 0; n < m->nnode; n++) {
    id[n] = used[n] ? (uint32_t)to->nnode : NONE;
    if (!used[n]) continue;
    size_t k = to->nnode++;
    memcpy(&to->xyz[3 * k], &m->xyz[3 * n], 3 * sizeof *m->xyz);
    to->node_entity[k] = m->node_entity[n];
    to->node_u[k] = m->node_u[n];
  }
  return id;
}

static void copy_periodic(Mesh *to, const Mesh *m, const uint32_t *id, const uint32_t *node)
{
  for (size_t r = 0; r < m->nperiodic; r++) {
    const MeshPeriodic *old = &m->periodic[r];
    MeshPeriodic *p = mesh_add_periodic(to, old->dim, old->tag, old->master);
    p->has_affine = old->has_affine;
    memcpy(p->affine, old->affine, sizeof p->affine);
    for (size_t i = 0; i < old->slave_node.len; i++) {
      uint32_t s = id[old->slave_node.data[i]], t = id[old->master_node.data[i]];
      if (s == NONE || t == NONE) continue;
      vec_push(&p->slave_node, node[s]);
      vec_push(&p->master_node, node[t]);
    }
  }
}

Mesh *high_order__corners(const Mesh *m)
{
  bool *used = mem_zalloc(m->nnode + 1);
  Mesh straight = *m;
  straight.block = corner_blocks(m, used);
  uint32_t *id = squeeze_nodes(m, used, &straight);
  straight.nperiodic = 0;
  for (size_t i = 0; i < m->nblock; i++) {
    MeshBlock *b = &straight.block[i];
    for (size_t k = 0; k < b->n * (size_t)elem_nodes(b->type); k++) b->node[k] = id[b->node[k]];
  }
  EdgeTable none = {0};
  Enriched e;
  enrich(&e, &straight, &none, 0, none_inside, NULL);
  for (size_t i = 0; i < m->nblock; i++) {
    const MeshBlock *b = &straight.block[i];
    uint32_t *to = enriched_block(&e, b->entity, b->type, b->n);
    for (size_t k = 0; k < b->n * (size_t)elem_nodes(b->type); k++) to[k] = e.node[b->node[k]];
  }
  copy_periodic(e.mesh, m, id, e.node);
  enriched_free(&e, m);
  for (size_t i = 0; i < m->nblock; i++) free(straight.block[i].node);
  free(straight.block);
  free(straight.xyz);
  free(straight.node_entity);
  free(straight.node_u);
  free(used);
  free(id);
  return e.mesh;
}
