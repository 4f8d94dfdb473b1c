// part_entities.c - a partitioned mesh on entities of its parts: the mesh made of the pieces
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/part_entities_int.h"

#include "base/str.h"

static void copy_ints(IntVec *to, const IntVec *from)
{
  for (size_t i = 0; i < from->len; i++) vec_push(to, from->data[i]);
}

// ---- division ------------------------------------------------------------
static uint32_t *new_none(size_t n)
{
  uint32_t *a = mem_alloc(n * sizeof *a);
  if (n) memset(a, 0xff, n * sizeof *a);
  return a;
}

static void division_make(Division *d, const Mesh *m, bool topology)
{
  *d = (Division){.m = m, .topology = topology};
  elem_ids_make(&d->ids, m);
  if (topology) edge_uses_make(&d->uses, m, &d->ids);
  d->of = new_none(d->ids.nelem);
  d->node_piece = new_none(m->nnode);
  d->end_piece = new_none(m->nnode);
  d->node_dim = mem_alloc(m->nnode);
  if (m->nnode) memset(d->node_dim, 0xff, m->nnode);
  d->ends = mem_zalloc(m->nnode * sizeof *d->ends);
  division__surfaces(d);
  division__curves(d);
  division__nodes(d);
  if (topology) division__bounds(d);
}

static void chains_free(Chains *c)
{
  vec_free(&c->link);
  free(c->first);
  free(c->next);
}

static void division_free(Division *d)
{
  elem_ids_free(&d->ids);
  edge_uses_free(&d->uses);
  part_sets__free(&d->sets);
  for (int dim = 0; dim < 3; dim++) vec_free(&d->piece[dim]);
  chains_free(&d->curves);
  chains_free(&d->seams);
  free(d->of);
  free(d->node_piece);
  free(d->node_dim);
  free(d->ends);
  free(d->end_piece);
  vec_free(&d->node);
  vec_free(&d->bound);
}

// ---- entities ------------------------------------------------------------
typedef struct {
  const Division *d;
  Mesh *out;
  uint32_t *entity;  // of m's, their index now
  uint32_t first[3]; // index of the first piece of each dimension
  int first_tag[3];
} Assembly;

static void copy_entity(Assembly *a, uint32_t e)
{
  const MeshEntity *from = &a->d->m->entity[e];
  a->entity[e] = mesh_add_entity(a->out, from->dim, from->tag);
  MeshEntity *to = &a->out->entity[a->entity[e]];
  to->lo = from->lo;
  to->hi = from->hi;
  copy_ints(&to->physical, &from->physical);
  copy_ints(&to->boundary, &from->boundary);
  copy_ints(&to->embedded, &from->embedded);
}

static void add_piece(Assembly *a, int dim, uint32_t index)
{
  const Piece *p = &a->d->piece[dim].data[index];
  const MeshEntity *parent = &a->d->m->entity[p->entity];
  uint32_t at = mesh_add_entity(a->out, dim, a->first_tag[dim] + (int)index);
  MeshEntity *e = &a->out->entity[at];
  e->parent_dim = parent->dim;
  e->parent_tag = parent->tag;
  e->saved = p->between && parent->physical.len;
  if (!p->between) copy_ints(&e->physical, &parent->physical);
  uint32_t n;
  const uint32_t *part = part_sets__at(&a->d->sets, p->set, &n);
  for (uint32_t i = 0; i < n; i++) vec_push(&e->parts, (int)part[i]);
  for (int k = 0; dim == 1 && k < 2; k++)
    if (p->ends[k] != NONE) vec_push(&e->boundary, (k ? -1 : 1) * (a->first_tag[0] + (int)p->ends[k]));
}

static void add_bounds(Assembly *a)
{
  for (size_t i = 0; i < a->d->bound.len; i++) {
    const Bound *b = &a->d->bound.data[i];
    int tag = a->first_tag[1] + abs(b->curve) - 1;
    vec_push(&a->out->entity[a->first[2] + b->surface].boundary, b->curve < 0 ? -tag : tag);
  }
}

static void make_entities(Assembly *a)
{
  const Mesh *m = a->d->m;
  uint32_t e = 0;
  for (int dim = 0; dim < 3; dim++) {
    a->first_tag[dim] = 1;
    for (; e < m->nentity && m->entity[e].dim == dim; e++) {
      a->first_tag[dim] = MAX(a->first_tag[dim], m->entity[e].tag + 1);
      copy_entity(a, e);
    }
    a->first[dim] = (uint32_t)a->out->nentity;
    for (uint32_t i = 0; i < a->d->piece[dim].len; i++) add_piece(a, dim, i);
  }
  add_bounds(a);
}

// ---- groups of parts ------------------------------------------------------------
static void piece_group_name(Str *s, const MeshEntity *e, int physical)
{
  s->len = 0;
  for (size_t i = 0; i < e->parts.len; i++) str_printf(s, "%s%d", i ? "," : "_part{", e->parts.data[i]);
  str_printf(s, "}_physical{%d}_dim{%d}", physical, e->dim);
}

// Tag of the group of that name, which is new with the next tag or known.
static int group_tag(Mesh *m, Names *names, const char *name, int dim, int *next_tag)
{
  uint32_t known = names_get(names, name);
  if (known != NONE) return (int)known;
  names_set(names, name, (uint32_t)*next_tag);
  mesh_add_group(m, dim, *next_tag, name);
  return (*next_tag)++;
}

static int group_order(const void *x, const void *y)
{
  const MeshGroup *a = x, *b = y;
  return a->dim != b->dim ? (a->dim < b->dim ? -1 : 1) : (a->tag > b->tag) - (a->tag < b->tag);
}

// Groups of pieces instead of their parents': a piece keeps the sign it has in its parent's group.
static void make_groups(const Assembly *a)
{
  Mesh *out = a->out;
  Names names = {0};
  Str name = {0};
  int next_tag = 1;
  for (size_t g = 0; g < out->ngroup; g++) next_tag = MAX(next_tag, out->group[g].tag + 1);
  for (int dim = 2; dim >= 0; dim--)
    for (size_t i = 0; i < a->d->piece[dim].len; i++) {
      MeshEntity *e = &out->entity[a->first[dim] + i];
      const IntVec *of = &a->d->m->entity[a->d->piece[dim].data[i].entity].physical;
      vec_clear(&e->physical);
      for (size_t k = 0; k < MAX(of->len, (size_t)1); k++) {
        int physical = of->len ? of->data[k] : 0;
        piece_group_name(&name, e, physical);
        int tag = group_tag(out, &names, str_text(&name), dim, &next_tag);
        vec_push(&e->physical, physical < 0 ? -tag : tag);
      }
    }
  qsort(out->group, out->ngroup, sizeof *out->group, group_order);
  names_free(&names);
  str_free(&name);
}

// ---- elements ------------------------------------------------------------
// Elements of one block of m, or of none, on one piece.
typedef struct {
  uint32_t entity, block, piece; // index in out; block of m or NONE; piece of its dimension
  ElemType type;
  size_t n;
  uint32_t to; // block of out
} Share;

static int share_order(const void *x, const void *y)
{
  const Share *a = x, *b = y;
  if (a->entity != b->entity) return a->entity < b->entity ? -1 : 1;
  return a->type < b->type ? -1 : a->type > b->type;
}

static int block_order(const void *x, const void *y)
{
  const Share *a = x, *b = y;
  return a->block < b->block ? -1 : a->block > b->block;
}

typedef Vec(Share) Shares;

static Shares list_shares(const Assembly *a)
{
  const Division *d = a->d;
  const Mesh *m = d->m;
  Shares s = {0};
  for (uint32_t b = 0; b < m->nblock; b++) {
    int dim = elem_dim(m->block[b].type);
    size_t first = s.len;
    Map seen = {0};
    for (size_t i = 0; i < m->block[b].n; i++) {
      uint32_t piece = d->of[d->ids.base[b] + i];
      bool added = false;
      uint32_t at = s.len > first && vec_last(&s).piece == piece
                        ? (uint32_t)s.len - 1
                        : *map_slot(&seen, piece, (uint32_t)s.len, &added);
      if (added) vec_push(&s, ((Share){a->first[dim] + piece, b, piece, m->block[b].type, 0, NONE}));
      s.data[at].n++;
    }
    map_free(&seen);
  }
  for (int dim = 0; dim < 2; dim++)
    for (uint32_t i = 0; i < d->piece[dim].len; i++) {
      const Piece *p = &d->piece[dim].data[i];
      if (p->between) vec_push(&s, ((Share){a->first[dim] + i, NONE, i, p->type, p->n, NONE}));
    }
  return s;
}

// The elements of block b go to the blocks of the shares.
static void deal(const Assembly *a, uint32_t b, const Share *share, size_t n, uint32_t *block_of,
                 size_t *filled)
{
  const MeshBlock *from = &a->d->m->block[b];
  size_t nodes = (size_t)elem_nodes(from->type);
  for (size_t i = 0; i < n; i++) block_of[share[i].piece] = share[i].to;
  for (size_t i = 0; i < from->n; i++) {
    uint32_t to = block_of[a->d->of[a->d->ids.base[b] + i]];
    MeshBlock *k = &a->out->block[to];
    memcpy(k->node + filled[to] * nodes, from->node + i * nodes, nodes * sizeof *k->node);
    k->part[filled[to]++] = from->part[i];
  }
}

static void make_blocks(const Assembly *a)
{
  const Division *d = a->d;
  Shares s = list_shares(a);
  if (s.len) qsort(s.data, s.len, sizeof *s.data, share_order);
  for (size_t i = 0; i < s.len; i++) {
    Share *h = &s.data[i];
    h->to = mesh_add_block(a->out, h->entity, h->type, h->n);
    MeshBlock *k = &a->out->block[h->to];
    if (h->block != NONE) k->part = mem_alloc(h->n * sizeof *k->part);
    if (h->block == NONE)
      memcpy(k->node, d->node.data + d->piece[elem_dim(h->type)].data[h->piece].first,
             h->n * (size_t)elem_nodes(h->type) * sizeof *k->node);
  }
  if (s.len) qsort(s.data, s.len, sizeof *s.data, block_order);
  size_t most = MAX(d->piece[0].len, MAX(d->piece[1].len, d->piece[2].len)),
         *filled = mem_zalloc(a->out->nblock * sizeof *filled);
  uint32_t *block_of = mem_alloc(most * sizeof *block_of);
  for (size_t i = 0, j; i < s.len && s.data[i].block != NONE; i = j) {
    for (j = i; j < s.len && s.data[j].block == s.data[i].block;) j++;
    deal(a, s.data[i].block, s.data + i, j - i, block_of, filled);
  }
  free(block_of);
  free(filled);
  vec_free(&s);
}

// ---- the rest ------------------------------------------------------------
static void copy_nodes(const Assembly *a)
{
  const Mesh *m = a->d->m;
  Mesh *out = a->out;
  out->nnode = out->node_cap = m->nnode;
  out->xyz = mem_alloc(3 * m->nnode * sizeof *out->xyz);
  out->node_u = mem_alloc(m->nnode * sizeof *out->node_u);
  out->node_entity = mem_alloc(m->nnode * sizeof *out->node_entity);
  if (m->nnode) memcpy(out->xyz, m->xyz, 3 * m->nnode * sizeof *out->xyz);
  if (m->nnode) memcpy(out->node_u, m->node_u, m->nnode * sizeof *out->node_u);
  for (size_t v = 0; v < m->nnode; v++) {
    uint32_t p = a->d->node_piece[v];
    out->node_entity[v] = p == NONE ? a->entity[m->node_entity[v]] : a->first[a->d->node_dim[v]] + p;
  }
}

static void copy_groups_and_pairs(Mesh *out, const Mesh *m)
{
  for (size_t i = 0; i < m->ngroup; i++)
    mesh_add_group(out, m->group[i].dim, m->group[i].tag, m->group[i].name);
  out->volumes_grouped = m->volumes_grouped;
  for (size_t i = 0; i < m->nperiodic; i++) {
    const MeshPeriodic *from = &m->periodic[i];
    MeshPeriodic *to = mesh_add_periodic(out, from->dim, from->tag, from->master);
    to->has_affine = from->has_affine;
    memcpy(to->affine, from->affine, sizeof to->affine);
    for (size_t k = 0; k < from->slave_node.len; k++) {
      vec_push(&to->slave_node, from->slave_node.data[k]);
      vec_push(&to->master_node, from->master_node.data[k]);
    }
  }
}

static void fill_boxes(Mesh *out)
{
  for (size_t b = 0; b < out->nblock; b++) {
    const MeshBlock *k = &out->block[b];
    MeshEntity *e = &out->entity[k->entity];
    Box3 box = {e->lo, e->hi};
    size_t n = k->n * (size_t)elem_nodes(k->type);
    for (size_t i = 0; i < n; i++) box = box3_with(box, mesh_xyz(out, k->node[i]));
    e->lo = box.lo;
    e->hi = box.hi;
  }
}

Mesh *mesh_part_entities(const Mesh *m, const PartEntityOptions *o)
{
  Division d;
  division_make(&d, m, o->topology);
  Assembly a = {.d = &d, .out = mesh_new(), .entity = mem_alloc(m->nentity * sizeof(uint32_t))};
  a.out->nparts = m->nparts;
  make_entities(&a);
  copy_groups_and_pairs(a.out, m);
  if (o->groups) make_groups(&a);
  make_blocks(&a);
  copy_nodes(&a);
  fill_boxes(a.out);
  free(a.entity);
  division_free(&d);
  return a.out;
}
