// edge_table.c - the distinct edges of a mesh, and copies of a mesh with room for nodes on its edges and in its elements
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/edge_table.h"

#include "mesh/periodic.h"

static void find_loose(EdgeTable *t, const Mesh *m)
{
  t->loose = mem_zalloc(m->nentity + 1);
  bool lists = false;
  for (size_t i = 0; i < m->nentity; i++) {
    t->loose[i] = m->entity[i].dim == 1;
    lists |= m->entity[i].dim == 2 && m->entity[i].boundary.len;
  }
  for (size_t i = 0; i < m->nentity; i++) {
    const MeshEntity *f = &m->entity[i];
    for (size_t k = 0; f->dim == 2 && k < f->boundary.len + f->embedded.len; k++) {
      int tag = k < f->boundary.len ? f->boundary.data[k] : f->embedded.data[k - f->boundary.len];
      uint32_t e = mesh_find_entity(m, 1, abs(tag));
      if (e != NONE) t->loose[e] = false;
    }
  }
  for (size_t i = 0; !lists && i < m->nentity; i++) t->loose[i] = false;
}

static void push_edge(EdgeTable *t, uint32_t a, uint32_t b, uint32_t entity, double ua, double ub)
{
  mem_grow(&t->edge, &t->cap, t->n + 1, sizeof *t->edge);
  t->edge[t->n++] = (MeshEdge){a, b, entity, ua, ub};
}

static void add_edge(EdgeTable *t, uint32_t a, uint32_t b, uint32_t entity, double ua, double ub)
{
  bool added;
  map_slot(&t->index, map_pair(a, b), (uint32_t)t->n, &added);
  if (added) push_edge(t, a, b, entity, ua, ub);
}

// Parameter of node v, an end of the k-th of n line elements of a curve.
static double parameter(const Mesh *m, uint32_t entity, uint32_t v, bool far_end)
{
  return m->node_entity[v] == entity ? m->node_u[v] : far_end ? 1 : 0;
}

static void add_line_block(EdgeTable *t, const Mesh *m, const MeshBlock *b)
{
  size_t per = (size_t)elem_nodes(b->type);
  bool backwards = false; // a reversed curve's elements still follow it, each with its nodes swapped
  if (b->n > 1) backwards = b->node[0] == b->node[per + 1] && b->node[1] != b->node[per];
  for (size_t k = 0; k < b->n; k++) {
    uint32_t v = b->node[k * per + backwards], w = b->node[k * per + !backwards];
    double ua = parameter(m, b->entity, v, k > 0), ub = parameter(m, b->entity, w, true);
    if (!(ua < ub)) ua = ub = NAN; // a single reversed element, or a mesh whose parameters are not known
    if (t->loose[b->entity]) {
      map_set(&t->loose_index, (uint64_t)b->entity << 32 | b->node[k * per], (uint32_t)t->n);
      push_edge(t, v, w, b->entity, ua, ub);
    } else {
      add_edge(t, v, w, b->entity, ua, ub);
    }
  }
}

// An edge of another face without a line on it is shared if it is on the rim of this face. `met` counts these by their nodes.
static void add_surface_block(EdgeTable *t, const Mesh *m, const MeshBlock *b, Map *met)
{
  size_t per = (size_t)elem_nodes(b->type), c = (size_t)elem_corners(b->type);
  for (size_t k = 0; k < b->n; k++)
    for (size_t i = 0; i < c; i++) {
      uint32_t v = b->node[k * per + i], w = b->node[k * per + (i + 1) % c];
      bool added;
      uint32_t e = *map_slot(&t->index, map_pair(v, w), (uint32_t)t->n, &added);
      if (added) push_edge(t, MIN(v, w), MAX(v, w), b->entity, NAN, NAN);
      else if (t->edge[e].entity != b->entity && m->entity[t->edge[e].entity].dim == 2) ++*map_slot(met, map_pair(v, w), 0, NULL);
    }
}

// Those met twice are within this face, as they are within another: two edges between the same nodes.
static void add_own_edges(EdgeTable *t, const MeshBlock *b, const Map *met)
{
  size_t per = (size_t)elem_nodes(b->type), c = (size_t)elem_corners(b->type);
  for (size_t k = 0; k < b->n; k++)
    for (size_t i = 0; i < c; i++) {
      uint32_t v = b->node[k * per + i], w = b->node[k * per + (i + 1) % c], times = map_get(met, map_pair(v, w));
      if (times == NONE || times < 2) continue;
      bool added;
      map_slot(&t->own[b->entity], map_pair(v, w), (uint32_t)t->n, &added);
      if (added) push_edge(t, MIN(v, w), MAX(v, w), b->entity, NAN, NAN);
    }
}

// Blocks from, ... to - 1 are those of a face.
static void add_face(EdgeTable *t, const Mesh *m, size_t from, size_t to)
{
  Map met = {0};
  for (size_t i = from; i < to; i++) add_surface_block(t, m, &m->block[i], &met);
  if (met.len && !t->own) t->own = mem_zalloc(m->nentity * sizeof *t->own);
  for (size_t i = from; i < to && met.len; i++) add_own_edges(t, &m->block[i], &met);
  map_free(&met);
}

void edge_table_make(EdgeTable *t, const Mesh *m)
{
  *t = (EdgeTable){0};
  find_loose(t, m);
  for (size_t i = 0; i < m->nblock; i++)
    if (elem_dim(m->block[i].type) == 1) add_line_block(t, m, &m->block[i]);
  t->nentity = m->nentity;
  for (size_t i = 0, end; i < m->nblock; i = end) {
    for (end = i + 1; end < m->nblock && m->block[end].entity == m->block[i].entity;) end++;
    if (elem_dim(m->block[i].type) == 2) add_face(t, m, i, end);
  }
}

void edge_table_free(EdgeTable *t)
{
  map_free(&t->index);
  free(t->edge);
  free(t->loose);
  for (size_t i = 0; t->own && i < t->nentity; i++) map_free(&t->own[i]);
  free(t->own);
  map_free(&t->loose_index);
  *t = (EdgeTable){0};
}

uint32_t edge_table_find(const EdgeTable *t, uint32_t entity, uint32_t a, uint32_t b)
{
  uint32_t own = t->own && entity != NONE && t->own[entity].len ? map_get(&t->own[entity], map_pair(a, b)) : NONE;
  return own != NONE ? own : map_get(&t->index, map_pair(a, b));
}

// Of a curve's line element {a, b}.
static uint32_t find_line(const EdgeTable *t, uint32_t curve, uint32_t a, uint32_t b)
{
  return t->loose[curve] ? map_get(&t->loose_index, (uint64_t)curve << 32 | a) : edge_table_find(t, NONE, a, b);
}

Vec3 edge_table_point(const EdgeTable *t, const Mesh *m, const Model *model, uint32_t e, double s, double *u)
{
  const MeshEdge *edge = &t->edge[e];
  *u = (1 - s) * edge->ua + s * edge->ub;
  const Curve *c = NULL;
  if (model && *u >= 0 && *u <= 1 && m->entity[edge->entity].dim == 1) c = model_curve(model, m->entity[edge->entity].tag);
  if (c && !curve_is_straight(model, c)) return curve_point(model, c, *u);
  return vec3_add(vec3_scale(1 - s, mesh_xyz(m, edge->a)), vec3_scale(s, mesh_xyz(m, edge->b)));
}

static void copy_entities(Mesh *out, const Mesh *m)
{
  for (size_t i = 0; i < m->nentity; i++) {
    const MeshEntity *from = &m->entity[i];
    uint32_t id = mesh_add_entity(out, from->dim, from->tag);
    MeshEntity *to = &out->entity[id];
    to->lo = from->lo;
    to->hi = from->hi;
    for (size_t k = 0; k < from->physical.len; k++) vec_push(&to->physical, from->physical.data[k]);
    for (size_t k = 0; k < from->boundary.len; k++) vec_push(&to->boundary, from->boundary.data[k]);
    for (size_t k = 0; k < from->embedded.len; k++) vec_push(&to->embedded, from->embedded.data[k]);
  }
  out->volumes_grouped = m->volumes_grouped;
  for (size_t i = 0; i < m->ngroup; i++) mesh_add_group(out, m->group[i].dim, m->group[i].tag, m->group[i].name);
}

// Old nodes, edges and blocks by entity: item[start[i]] .. item[start[i+1]] in ascending order.
typedef struct {
  uint32_t *start, *item;
} Bucket;

static void bucket_make(Bucket *b, size_t nentity, size_t n, uint32_t (*entity)(const void *, size_t), const void *ctx)
{
  b->start = mem_zalloc((nentity + 2) * sizeof *b->start);
  b->item = mem_alloc(n * sizeof *b->item);
  for (size_t i = 0; i < n; i++) b->start[entity(ctx, i) + 2]++;
  for (size_t i = 0; i < nentity; i++) b->start[i + 2] += b->start[i + 1];
  for (size_t i = 0; i < n; i++) b->item[b->start[entity(ctx, i) + 1]++] = (uint32_t)i;
}

static void bucket_free(Bucket *b)
{
  free(b->start);
  free(b->item);
}

static uint32_t entity_of_node(const void *m, size_t i) { return ((const Mesh *)m)->node_entity[i]; }
static uint32_t entity_of_edge(const void *t, size_t i) { return ((const EdgeTable *)t)->edge[i].entity; }
static uint32_t entity_of_block(const void *m, size_t i) { return ((const Mesh *)m)->block[i].entity; }

typedef struct {
  Enriched *out;
  const Mesh *m;
  const EdgeTable *t;
  int per_edge;
} Copier;

static void copy_node(const Copier *c, uint32_t v)
{
  if (c->out->node[v] == NONE)
    c->out->node[v] = mesh_add_node(c->out->mesh, mesh_xyz(c->m, v), c->m->node_entity[v], c->m->node_u[v]);
}

static uint32_t add_nodes(const Copier *c, uint32_t entity, int n)
{
  uint32_t first = (uint32_t)c->out->mesh->nnode;
  for (int k = 0; k < n; k++) mesh_add_node(c->out->mesh, (Vec3){0, 0, 0}, entity, NAN);
  return first;
}

static void copy_entity(const Copier *c, uint32_t entity, const Bucket *node, const Bucket *edge)
{
  bool curve = c->m->entity[entity].dim == 1;
  if (!curve)
    for (uint32_t i = node->start[entity]; i < node->start[entity + 1]; i++) copy_node(c, node->item[i]);
  for (uint32_t i = edge->start[entity]; i < edge->start[entity + 1]; i++) {
    const MeshEdge *e = &c->t->edge[edge->item[i]];
    if (curve && c->m->node_entity[e->a] == entity) copy_node(c, e->a);
    c->out->edge[edge->item[i]] = add_nodes(c, entity, c->per_edge);
  }
  for (uint32_t i = node->start[entity]; i < node->start[entity + 1]; i++) copy_node(c, node->item[i]);
}

void enrich(Enriched *out, const Mesh *m, const EdgeTable *t, int per_edge, int (*cell_nodes)(ElemType, void *), void *ctx)
{
  *out = (Enriched){mesh_new(), mem_alloc(m->nnode * sizeof(uint32_t)), mem_alloc(t->n * sizeof(uint32_t)),
                    mem_zalloc(m->nblock * sizeof(uint32_t *))};
  copy_entities(out->mesh, m);
  for (size_t i = 0; i < m->nnode; i++) out->node[i] = NONE;
  Bucket node, edge, block;
  bucket_make(&node, m->nentity, m->nnode, entity_of_node, m);
  bucket_make(&edge, m->nentity, t->n, entity_of_edge, t);
  bucket_make(&block, m->nentity, m->nblock, entity_of_block, m);
  Copier c = {out, m, t, per_edge};
  for (uint32_t entity = 0; entity < m->nentity; entity++) {
    copy_entity(&c, entity, &node, &edge);
    for (uint32_t i = block.start[entity]; i < block.start[entity + 1]; i++) {
      const MeshBlock *b = &m->block[block.item[i]];
      if (elem_dim(b->type) != 2) continue;
      uint32_t *cell = out->cell[block.item[i]] = mem_alloc(b->n * sizeof *cell);
      int per_cell = cell_nodes(b->type, ctx);
      for (size_t k = 0; k < b->n; k++) cell[k] = add_nodes(&c, entity, per_cell);
    }
  }
  bucket_free(&node);
  bucket_free(&edge);
  bucket_free(&block);
}

void enriched_free(Enriched *e, const Mesh *m)
{
  for (size_t i = 0; i < m->nblock; i++) free(e->cell[i]);
  free(e->cell);
  free(e->node);
  free(e->edge);
}

static uint32_t added_node(const Enriched *e, const EdgeTable *t, int per_edge, uint32_t edge, uint32_t a, int k)
{
  return e->edge[edge] + (uint32_t)(t->edge[edge].a == a ? k : per_edge - 1 - k);
}

uint32_t enriched_at(const Enriched *e, const EdgeTable *t, int per_edge, uint32_t entity, uint32_t a, uint32_t b, int k)
{
  return added_node(e, t, per_edge, edge_table_find(t, entity, a, b), a, k);
}

uint32_t enriched_on_line(const Enriched *e, const EdgeTable *t, int per_edge, uint32_t curve, uint32_t a, uint32_t b, int k)
{
  return added_node(e, t, per_edge, find_line(t, curve, a, b), a, k);
}

uint32_t *enriched_block(Enriched *e, uint32_t entity, ElemType type, size_t n)
{
  uint32_t b = mesh_add_block(e->mesh, entity, type, n);
  return e->mesh->block[b].node;
}

// Pairs of the nodes added to edge i of the slave.
static void pair_edge(const Enriched *e, const EdgeTable *t, int per_edge, const Map *master_of, size_t i, MeshPeriodic *p)
{
  uint32_t a = map_get(master_of, t->edge[i].a), b = map_get(master_of, t->edge[i].b);
  if (a == NONE || b == NONE || edge_table_find(t, NONE, a, b) == NONE) return;
  for (int k = 0; k < per_edge; k++) {
    uint32_t slave = e->edge[i] + (uint32_t)k, master = enriched_at(e, t, per_edge, NONE, a, b, k);
    vec_push(&p->slave_node, slave);
    vec_push(&p->master_node, master);
    if (p->has_affine) periodic_place(e->mesh, p->affine, slave, master);
  }
}

void enrich_periodic(const Enriched *e, const Mesh *m, const EdgeTable *t, int per_edge)
{
  for (size_t r = 0; r < m->nperiodic; r++) {
    const MeshPeriodic *old = &m->periodic[r];
    MeshPeriodic *p = mesh_add_periodic(e->mesh, old->dim, old->tag, old->master);
    p->has_affine = old->has_affine;
    for (int k = 0; k < 16; k++) p->affine[k] = old->affine[k];
    Map master_of = {0};
    for (size_t i = 0; i < old->slave_node.len; i++) {
      map_set(&master_of, old->slave_node.data[i], old->master_node.data[i]);
      vec_push(&p->slave_node, e->node[old->slave_node.data[i]]);
      vec_push(&p->master_node, e->node[old->master_node.data[i]]);
    }
    uint32_t entity = mesh_find_entity(m, old->dim, old->tag);
    if (old->dim == 1)
      for (size_t i = 0; i < t->n; i++)
        if (t->edge[i].entity == entity) pair_edge(e, t, per_edge, &master_of, i, p);
    map_free(&master_of);
  }
}
