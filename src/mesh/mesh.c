// mesh.c - building and querying the mesh structure
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh.h"

typedef struct {
  int dim, nodes, corners, order;
  const char *name;
} ElemInfo;

// By type.
static const ElemInfo elem_info[] = {
    [ELEM_POINT] = {0, 1, 1, 1, "point"},
    [ELEM_LINE2] = {1, 2, 2, 1, "line"},
    [ELEM_LINE3] = {1, 3, 2, 2, "3-node line"},
    [ELEM_LINE4] = {1, 4, 2, 3, "4-node line"},
    [ELEM_LINE5] = {1, 5, 2, 4, "5-node line"},
    [ELEM_TRI3] = {2, 3, 3, 1, "triangle"},
    [ELEM_TRI6] = {2, 6, 3, 2, "6-node triangle"},
    [ELEM_TRI9] = {2, 9, 3, 3, "9-node triangle"},
    [ELEM_TRI10] = {2, 10, 3, 3, "10-node triangle"},
    [ELEM_TRI15] = {2, 15, 3, 4, "15-node triangle"},
    [ELEM_QUAD4] = {2, 4, 4, 1, "quadrangle"},
    [ELEM_QUAD8] = {2, 8, 4, 2, "8-node quadrangle"},
    [ELEM_QUAD9] = {2, 9, 4, 2, "9-node quadrangle"},
    [ELEM_QUAD12] = {2, 12, 4, 3, "12-node quadrangle"},
    [ELEM_QUAD16] = {2, 16, 4, 3, "16-node quadrangle"},
    [ELEM_QUAD25] = {2, 25, 4, 4, "25-node quadrangle"},
};

static const ElemInfo *info(ElemType t)
{
  static const ElemInfo unknown = {-1, 0, 0, 0, "unknown element"};
  return (size_t)t < ARRAY_LEN(elem_info) && elem_info[t].name ? &elem_info[t] : &unknown;
}

int elem_dim(ElemType t) { return info(t)->dim; }
int elem_nodes(ElemType t) { return info(t)->nodes; }
int elem_corners(ElemType t) { return info(t)->corners; }
int elem_order(ElemType t) { return info(t)->order; }
const char *elem_name(ElemType t) { return info(t)->name; }

Mesh *mesh_new(void) { return mem_zalloc(sizeof(Mesh)); }

void mesh_free(Mesh *m)
{
  if (!m) return;
  for (size_t i = 0; i < m->nentity; i++) {
    vec_free(&m->entity[i].physical);
    vec_free(&m->entity[i].boundary);
    vec_free(&m->entity[i].embedded);
    vec_free(&m->entity[i].parts);
  }
  for (size_t i = 0; i < m->nblock; i++) {
    free(m->block[i].node);
    free(m->block[i].part);
  }
  for (size_t i = 0; i < m->ngroup; i++) free(m->group[i].name);
  for (size_t i = 0; i < m->nperiodic; i++) {
    vec_free(&m->periodic[i].slave_node);
    vec_free(&m->periodic[i].master_node);
  }
  free(m->xyz);
  free(m->node_entity);
  free(m->node_u);
  free(m->node_number);
  free(m->entity);
  free(m->block);
  free(m->group);
  free(m->periodic);
  free(m);
}

uint32_t mesh_add_entity(Mesh *m, int dim, int tag)
{
  mem_grow(&m->entity, &m->entity_cap, m->nentity + 1, sizeof *m->entity);
  MeshEntity *e = &m->entity[m->nentity];
  *e = (MeshEntity){.dim = dim, .tag = tag};
  e->lo = box3_empty().lo;
  e->hi = box3_empty().hi;
  return (uint32_t)m->nentity++;
}

static void reserve_nodes(Mesh *m, size_t want)
{
  if (want <= m->node_cap) return;
  mem_grow(&m->xyz, &m->node_cap, want, 3 * sizeof *m->xyz);
  m->node_entity = mem_realloc(m->node_entity, m->node_cap * sizeof *m->node_entity);
  m->node_u = mem_realloc(m->node_u, m->node_cap * sizeof *m->node_u);
}

uint32_t mesh_add_node(Mesh *m, Vec3 p, uint32_t entity, double u)
{
  reserve_nodes(m, m->nnode + 1);
  size_t i = m->nnode++;
  m->xyz[3 * i] = p.x;
  m->xyz[3 * i + 1] = p.y;
  m->xyz[3 * i + 2] = p.z;
  m->node_entity[i] = entity;
  m->node_u[i] = u;
  return (uint32_t)i;
}

uint32_t mesh_add_nodes(Mesh *m, const Vec3 *p, size_t n, uint32_t entity)
{
  reserve_nodes(m, m->nnode + n);
  size_t first = m->nnode;
  m->nnode += n;
  if (n) memcpy(m->xyz + 3 * first, p, n * sizeof *p);
  for (size_t i = first; i < m->nnode; i++) m->node_entity[i] = entity;
  for (size_t i = first; i < m->nnode; i++) m->node_u[i] = NAN;
  return (uint32_t)first;
}

uint32_t mesh_add_block(Mesh *m, uint32_t entity, ElemType type, size_t n)
{
  return mesh_take_block(m, entity, type, n, mem_alloc(n * (size_t)elem_nodes(type) * sizeof(uint32_t)));
}

uint32_t mesh_take_block(Mesh *m, uint32_t entity, ElemType type, size_t n, uint32_t *node)
{
  mem_grow(&m->block, &m->block_cap, m->nblock + 1, sizeof *m->block);
  m->block[m->nblock] = (MeshBlock){.entity = entity, .type = type, .n = n, .node = node};
  return (uint32_t)m->nblock++;
}

void mesh_add_group(Mesh *m, int dim, int tag, const char *name)
{
  mem_grow(&m->group, &m->group_cap, m->ngroup + 1, sizeof *m->group);
  m->group[m->ngroup++] = (MeshGroup){dim, tag, name ? mem_strdup(name) : NULL};
}

MeshPeriodic *mesh_add_periodic(Mesh *m, int dim, int tag, int master)
{
  mem_grow(&m->periodic, &m->periodic_cap, m->nperiodic + 1, sizeof *m->periodic);
  m->periodic[m->nperiodic] = (MeshPeriodic){.dim = dim, .tag = tag, .master = master};
  return &m->periodic[m->nperiodic++];
}

uint32_t mesh_find_entity(const Mesh *m, int dim, int tag)
{
  size_t lo = 0, hi = m->nentity;
  while (lo < hi) {
    size_t mid = (lo + hi) / 2;
    const MeshEntity *e = &m->entity[mid];
    if (e->dim < dim || (e->dim == dim && e->tag < tag))
      lo = mid + 1;
    else
      hi = mid;
  }
  return lo < m->nentity && m->entity[lo].dim == dim && m->entity[lo].tag == tag ? (uint32_t)lo : NONE;
}

const MeshGroup *mesh_find_group(const Mesh *m, int dim, int tag)
{
  for (size_t i = 0; i < m->ngroup; i++)
    if (m->group[i].dim == dim && m->group[i].tag == tag) return &m->group[i];
  return NULL;
}

size_t mesh_count(const Mesh *m, int dim)
{
  size_t n = 0;
  for (size_t i = 0; i < m->nblock; i++)
    if (elem_dim(m->block[i].type) == dim) n += m->block[i].n;
  return n;
}

size_t mesh_count_corners(const Mesh *m, int corners)
{
  size_t n = 0;
  for (size_t i = 0; i < m->nblock; i++)
    if (elem_corners(m->block[i].type) == corners) n += m->block[i].n;
  return n;
}

bool mesh_is_grouped(const Mesh *m)
{
  for (size_t i = 0; i < m->nentity; i++)
    if (m->entity[i].physical.len) return true;
  return m->volumes_grouped;
}
