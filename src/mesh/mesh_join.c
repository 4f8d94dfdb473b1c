// mesh_join.c - parts of a mesh, read from files of their own, put together again; nodes left out
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_join.h"

#include "base/map.h"

// ---- nodes left out ------------------------------------------------------------
// Pairs lose those of which a node is gone.
static void renumber_pairs(MeshPeriodic *p, const uint32_t *to)
{
  size_t kept = 0;
  for (size_t k = 0; k < p->slave_node.len; k++) {
    uint32_t a = to[p->slave_node.data[k]], b = to[p->master_node.data[k]];
    if (a == NONE || b == NONE) continue;
    p->slave_node.data[kept] = a;
    p->master_node.data[kept++] = b;
  }
  p->slave_node.len = p->master_node.len = kept;
}

void mesh_drop_unused(Mesh *m, const bool *unused)
{
  uint32_t *to = mem_alloc(m->nnode * sizeof *to), kept = 0;
  uint64_t *number = mem_alloc(m->nnode * sizeof *number);
  for (size_t v = 0; v < m->nnode; v++) to[v] = unused[v] ? NONE : 0;
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; i < m->block[b].n * (size_t)elem_nodes(m->block[b].type); i++)
      to[m->block[b].node[i]] = 0;
  for (size_t v = 0; v < m->nnode; v++) {
    if (to[v] == NONE) continue;
    to[v] = kept;
    number[kept] = mesh_node_number(m, (uint32_t)v);
    memmove(m->xyz + 3 * (size_t)kept, m->xyz + 3 * v, 3 * sizeof *m->xyz);
    m->node_entity[kept] = m->node_entity[v];
    m->node_u[kept] = m->node_u[v];
    kept++;
  }
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; i < m->block[b].n * (size_t)elem_nodes(m->block[b].type); i++)
      m->block[b].node[i] = to[m->block[b].node[i]];
  for (size_t i = 0; i < m->nperiodic; i++) renumber_pairs(&m->periodic[i], to);
  free(m->node_number);
  m->node_number = number;
  m->nnode = kept;
  free(to);
}

// ---- joining ------------------------------------------------------------
typedef struct {
  Mesh *const *part;
  size_t n;
  Mesh *out;
  Map node;          // number -> node of out
  uint32_t **entity; // per mesh and entity: that of out
  uint32_t **to;     // per mesh and node: that of out
} Join;

static int entity_order(const void *x, const void *y)
{
  const MeshEntity *a = x, *b = y;
  return a->dim != b->dim ? (a->dim < b->dim ? -1 : 1) : (a->tag > b->tag) - (a->tag < b->tag);
}

static void add_new(IntVec *to, const IntVec *from)
{
  for (size_t i = 0; i < from->len; i++) {
    bool known = false;
    for (size_t k = 0; k < to->len; k++) known |= to->data[k] == from->data[i];
    if (!known) vec_push(to, from->data[i]);
  }
}

static void join_entities(Join *j)
{
  Mesh *out = j->out;
  for (size_t p = 0; p < j->n; p++) {
    size_t sorted = out->nentity;
    for (size_t i = 0; i < j->part[p]->nentity; i++) {
      const MeshEntity *e = &j->part[p]->entity[i];
      size_t count = out->nentity;
      out->nentity = sorted; // what came before this mesh is in order
      uint32_t at = mesh_find_entity(out, e->dim, e->tag);
      out->nentity = count;
      if (at == NONE) at = mesh_add_entity(out, e->dim, e->tag);
      MeshEntity *to = &out->entity[at];
      Box3 box = box3_with(box3_with((Box3){to->lo, to->hi}, e->lo), e->hi);
      if (e->lo.x <= e->hi.x) {
        to->lo = box.lo;
        to->hi = box.hi;
      }
      add_new(&to->physical, &e->physical);
      add_new(&to->boundary, &e->boundary);
      add_new(&to->embedded, &e->embedded);
    }
    if (out->nentity) qsort(out->entity, out->nentity, sizeof *out->entity, entity_order);
  }
  for (size_t p = 0; p < j->n; p++) {
    const Mesh *m = j->part[p];
    j->entity[p] = mem_alloc(m->nentity * sizeof *j->entity[p]);
    for (size_t i = 0; i < m->nentity; i++)
      j->entity[p][i] = mesh_find_entity(out, m->entity[i].dim, m->entity[i].tag);
  }
}

// A node that several have is on the entity of least dimension. False if it is not at one place.
static bool join_nodes(Join *j, unsigned long long *number)
{
  Mesh *out = j->out;
  Vec(uint64_t) numbers = {0};
  bool good = true;
  for (size_t p = 0; p < j->n && good; p++) {
    const Mesh *m = j->part[p];
    j->to[p] = mem_alloc(m->nnode * sizeof *j->to[p]);
    for (uint32_t v = 0; v < m->nnode && good; v++) {
      bool added;
      uint32_t e = j->entity[p][m->node_entity[v]];
      *number = mesh_node_number(m, v);
      uint32_t at = j->to[p][v] = *map_slot(&j->node, *number, (uint32_t)out->nnode, &added);
      if (added) {
        mesh_add_node(out, mesh_xyz(m, v), e, m->node_u[v]);
        vec_push(&numbers, *number);
        continue;
      }
      good = memcmp(out->xyz + 3 * (size_t)at, m->xyz + 3 * (size_t)v, 3 * sizeof *m->xyz) == 0;
      if (out->entity[e].dim >= out->entity[out->node_entity[at]].dim) continue;
      out->node_entity[at] = e;
      out->node_u[at] = m->node_u[v];
    }
  }
  out->node_number = numbers.data;
  return good;
}

// An element, told by its nodes.
static uint64_t element_key(const uint32_t *v, int n)
{
  uint64_t key = (uint64_t)n;
  for (int i = 0; i < n; i++) {
    key = (key ^ v[i]) * 0x9e3779b97f4a7c15u;
    key ^= key >> 32;
  }
  return key >> 1;
}

// Add the block's elements that out's block does not have; before: elements that it had of other meshes, by
// key.
static void add_elements(Join *j, size_t p, const MeshBlock *from, MeshBlock *to, Map *before)
{
  int n = elem_nodes(from->type);
  uint32_t fresh = (uint32_t)to->n;
  for (size_t i = 0; i < from->n; i++) {
    uint32_t *v = to->node + to->n * (size_t)n;
    for (int k = 0; k < n; k++) v[k] = j->to[p][from->node[i * (size_t)n + (size_t)k]];
    uint32_t twin = map_get(before, element_key(v, n));
    if (twin != NONE && twin < fresh && memcmp(to->node + twin * (size_t)n, v, (size_t)n * sizeof *v) == 0)
      continue;
    if (to->part) to->part[to->n] = from->part ? from->part[i] : 0;
    map_set(before, element_key(v, n), (uint32_t)to->n++);
  }
}

// A block of a mesh, and the entity it is on in the whole one.
typedef struct {
  uint32_t entity;
  ElemType type;
  size_t part, block;
} BlockKey;

static int key_order(const void *x, const void *y)
{
  const BlockKey *a = x, *b = y;
  if (a->entity != b->entity) return a->entity < b->entity ? -1 : 1;
  if (a->type != b->type) return a->type < b->type ? -1 : 1;
  if (a->part != b->part) return a->part < b->part ? -1 : 1;
  return a->block < b->block ? -1 : a->block > b->block;
}

// Blocks of one entity and type.
static void join_block(Join *j, const BlockKey *key, size_t n)
{
  size_t room = 0;
  for (size_t i = 0; i < n; i++) room += j->part[key[i].part]->block[key[i].block].n;
  uint32_t k = mesh_add_block(j->out, key->entity, key->type, room);
  MeshBlock *to = &j->out->block[k];
  Map before = {0};
  to->n = 0;
  if (j->out->nparts) to->part = mem_alloc(room * sizeof *to->part);
  for (size_t i = 0; i < n; i++)
    add_elements(j, key[i].part, &j->part[key[i].part]->block[key[i].block], to, &before);
  map_free(&before);
}

static void join_blocks(Join *j)
{
  Vec(BlockKey) key = {0};
  for (size_t p = 0; p < j->n; p++)
    for (size_t b = 0; b < j->part[p]->nblock; b++) {
      const MeshBlock *k = &j->part[p]->block[b];
      vec_push(&key, ((BlockKey){j->entity[p][k->entity], k->type, p, b}));
    }
  if (key.len) qsort(key.data, key.len, sizeof *key.data, key_order);
  for (size_t i = 0, n; i < key.len; i += n) {
    for (n = 1; i + n < key.len && key.data[i + n].entity == key.data[i].entity &&
                key.data[i + n].type == key.data[i].type;)
      n++;
    join_block(j, key.data + i, n);
  }
  vec_free(&key);
}

static void join_groups(Join *j)
{
  Mesh *out = j->out;
  for (size_t p = 0; p < j->n; p++) {
    const Mesh *m = j->part[p];
    out->volumes_grouped |= m->volumes_grouped;
    for (size_t g = 0; g < m->ngroup; g++)
      if (!mesh_find_group(out, m->group[g].dim, m->group[g].tag))
        mesh_add_group(out, m->group[g].dim, m->group[g].tag, m->group[g].name);
  }
}

static void join_pairs(Join *j)
{
  Map seen = {0};
  for (size_t p = 0; p < j->n; p++)
    for (size_t i = 0; i < j->part[p]->nperiodic; i++) {
      const MeshPeriodic *from = &j->part[p]->periodic[i];
      MeshPeriodic *to = NULL;
      for (size_t k = 0; k < j->out->nperiodic; k++)
        if (j->out->periodic[k].dim == from->dim && j->out->periodic[k].tag == from->tag)
          to = &j->out->periodic[k];
      if (!to) {
        to = mesh_add_periodic(j->out, from->dim, from->tag, from->master);
        to->has_affine = from->has_affine;
        memcpy(to->affine, from->affine, sizeof to->affine);
      }
      for (size_t k = 0; k < from->slave_node.len; k++) {
        bool added;
        uint32_t a = j->to[p][from->slave_node.data[k]], b = j->to[p][from->master_node.data[k]];
        uint64_t link = (uint64_t)(to - j->out->periodic) << 32 | a;
        map_slot(&seen, link, b, &added);
        if (!added) continue;
        vec_push(&to->slave_node, a);
        vec_push(&to->master_node, b);
      }
    }
  map_free(&seen);
}

Mesh *mesh_join(Mesh *const *part, size_t n, unsigned long long *number)
{
  Join j = {.part = part, .n = n, .out = mesh_new()};
  j.entity = mem_zalloc(n * sizeof *j.entity);
  j.to = mem_zalloc(n * sizeof *j.to);
  bool partitioned = true;
  for (size_t p = 0; p < n; p++) {
    j.out->nparts = MAX(j.out->nparts, part[p]->nparts);
    partitioned = partitioned && (part[p]->nparts || !mesh_count(part[p], 2));
  }
  if (!partitioned) j.out->nparts = 0;
  join_entities(&j);
  bool good = join_nodes(&j, number);
  if (good) {
    join_blocks(&j);
    join_groups(&j);
    join_pairs(&j);
  }
  for (size_t p = 0; p < n; p++) {
    free(j.entity[p]);
    free(j.to[p]);
  }
  free(j.entity);
  free(j.to);
  map_free(&j.node);
  if (good) return j.out;
  mesh_free(j.out);
  return NULL;
}
