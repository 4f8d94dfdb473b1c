// msh4.c - writer of MSH 4.1, ASCII and binary
// SPDX-License-Identifier: MIT
//
// Elements keep their entity's orientation; a group's sign stands in $Entities. One block per entity (nodes) and per
// entity and type (elements); numbers are consecutive in both.
#include "base/base.h"

#include "out/msh4_int.h"

static void write_entity(Enc *e, const Selection *s, const MeshEntity *t)
{
  bool empty = !(t->lo.x <= t->hi.x);
  Vec3 lo = empty ? (Vec3){0, 0, 0} : vec3_scale(s->scale, t->lo), hi = empty ? lo : vec3_scale(s->scale, t->hi);
  put_int(e, t->tag);
  put_vec(e, s->scale < 0 && t->dim ? hi : lo);
  if (t->dim) put_vec(e, s->scale < 0 ? lo : hi);
  put_tags(e, &t->physical);
  // Embedded curves are left out: Gmsh does not write them, and warns of tags it does not know there.
  if (t->dim) put_tags(e, &t->boundary);
  end_line(e);
}

static void write_entities(Enc *e, const Selection *s)
{
  const Mesh *m = s->mesh;
  size_t count[3] = {0, 0, 0};
  for (size_t i = 0; i < m->nentity; i++) {
    if (m->entity[i].parts.len) continue;
    count[m->entity[i].dim]++;
  }
  writer_str(e->w, "$Entities\n");
  for (int d = 0; d < 3; d++) put_size(e, count[d]);
  put_size(e, 0);
  end_line(e);
  for (size_t i = 0; i < m->nentity; i++)
    if (!m->entity[i].parts.len) write_entity(e, s, &m->entity[i]);
  writer_str(e->w, e->binary ? "\n$EndEntities\n" : "$EndEntities\n");
}

// Nodes from, from + 1, ... of the selection; with a parameter after the coordinates.
typedef struct {
  const Selection *s;
  size_t from;
  bool parameter;
} NodeItems;

static uint64_t number_of(const NodeItems *t, size_t k)
{
  return t->s->number[t->s->node[t->from + k]] + t->s->node0;
}

static char *put_numbers(char *p, const void *ctx, size_t from, size_t to)
{
  const NodeItems *t = ctx;
  for (size_t k = from; k < to; k++) p = put_char(put_u64(p, number_of(t, k)), '\n');
  return p;
}

static char *put_binary_numbers(char *p, const void *ctx, size_t from, size_t to)
{
  const NodeItems *t = ctx;
  for (size_t k = from; k < to; k++, p += 8) {
    uint64_t tag = number_of(t, k);
    memcpy(p, &tag, 8);
  }
  return p;
}

static char *put_places(char *p, const void *ctx, size_t from, size_t to)
{
  const NodeItems *t = ctx;
  for (size_t k = t->from + from; k < t->from + to; k++) {
    p = put_xyz(p, select__xyz(t->s, k));
    if (t->parameter) p = put_double(put_char(p, ' '), t->s->mesh->node_u[t->s->node[k]]);
    p = put_char(p, '\n');
  }
  return p;
}

static char *put_binary_places(char *p, const void *ctx, size_t from, size_t to)
{
  const NodeItems *t = ctx;
  for (size_t k = t->from + from; k < t->from + to; k++) {
    Vec3 x = select__xyz(t->s, k);
    p = (char *)memcpy(p, &x, sizeof x) + sizeof x;
    if (t->parameter) p = (char *)memcpy(p, &t->s->mesh->node_u[t->s->node[k]], 8) + 8;
  }
  return p;
}

// Nodes from..to-1 of the selection are those of one entity.
static void write_node_block(Enc *e, const Selection *s, size_t from, size_t to, bool parametric)
{
  const Mesh *m = s->mesh;
  const MeshEntity *t = &m->entity[m->node_entity[s->node[from]]];
  bool u = parametric && t->dim == 1;
  for (size_t k = from; u && k < to; k++) u = !isnan(m->node_u[s->node[k]]);
  put_int(e, t->dim);
  put_int(e, t->tag);
  put_int(e, u);
  put_size(e, to - from);
  end_line(e);
  NodeItems items = {s, from, u};
  writer_items(e->w, to - from, NUMBER_MAX_TEXT, e->binary ? put_binary_numbers : put_numbers, &items);
  writer_items(e->w, to - from, 4 * NUMBER_MAX_TEXT, e->binary ? put_binary_places : put_places, &items);
}

// Least and largest number of a node and of an element; they have gaps in a file of one part.
static void node_range(const Selection *s, uint64_t range[2])
{
  range[0] = range[1] = s->number[s->node[0]];
  for (size_t k = 0; k < s->nnode; k++) {
    range[0] = MIN(range[0], s->number[s->node[k]]);
    range[1] = MAX(range[1], s->number[s->node[k]]);
  }
}

static void write_nodes(Enc *e, const Selection *s, bool parametric)
{
  const uint32_t *owner = s->mesh->node_entity;
  size_t blocks = 0;
  for (size_t k = 0; k < s->nnode; k++) blocks += k == 0 || owner[s->node[k]] != owner[s->node[k - 1]];
  writer_str(e->w, "$Nodes\n");
  put_size(e, blocks);
  put_size(e, s->nnode);
  uint64_t range[2];
  node_range(s, range);
  put_size(e, s->node0 + range[0]);
  put_size(e, s->node0 + range[1]);
  end_line(e);
  for (size_t from = 0, to; from < s->nnode; from = to) {
    for (to = from + 1; to < s->nnode && owner[s->node[to]] == owner[s->node[from]];) to++;
    write_node_block(e, s, from, to, parametric);
  }
  writer_str(e->w, e->binary ? "\n$EndNodes\n" : "$EndNodes\n");
}

// Elements of a block, which are numbered from first.
typedef struct {
  const Selection *s;
  const MeshBlock *block;
  uint64_t first;
} ElementItems;

static char *put_elements(char *p, const void *ctx, size_t from, size_t to)
{
  const ElementItems *t = ctx;
  size_t nodes = (size_t)elem_nodes(t->block->type);
  const uint32_t *node = t->block->node + from * nodes;
  for (size_t i = from; i < to; i++, node += nodes)
    p = put_char(put_node_numbers(put_u64(p, t->first + i), t->s, node, NULL, nodes, t->s->node0), '\n');
  return p;
}

static inline char *put_records(char *p, const ElementItems *t, size_t from, size_t to, size_t nodes)
{
  const uint32_t *node = t->block->node + from * nodes;
  for (size_t i = from; i < to; i++) {
    uint64_t number = t->first + i;
    p = (char *)memcpy(p, &number, 8) + 8;
    for (size_t j = 0; j < nodes; j++, p += 8) {
      uint64_t v = t->s->number[*node++] + t->s->node0;
      memcpy(p, &v, 8);
    }
  }
  return p;
}

static char *put_binary_elements(char *p, const void *ctx, size_t from, size_t to)
{
  const ElementItems *t = ctx;
  return t->block->type == ELEM_TRI3 ? put_records(p, t, from, to, 3) // known to the compiler, so that it unrolls
                                     : put_records(p, t, from, to, (size_t)elem_nodes(t->block->type));
}

static void write_block_head(Enc *e, const Selection *s, const MeshBlock *k)
{
  const MeshEntity *t = &s->mesh->entity[k->entity];
  put_int(e, t->dim);
  put_int(e, t->tag);
  put_int(e, (int)k->type);
  put_size(e, k->n);
  end_line(e);
}

static void write_block(Enc *e, const Selection *s, const MeshBlock *k, uint64_t number)
{
  write_block_head(e, s, k);
  writer_items(e->w, k->n, 22 * ((size_t)elem_nodes(k->type) + 2), e->binary ? put_binary_elements : put_elements,
               &(ElementItems){s, k, number});
}

// Ghost cells have the numbers they have elsewhere.
static void write_ghost_block(Enc *e, const Selection *s, const MeshBlock *k, const uint64_t *number)
{
  size_t nodes = (size_t)elem_nodes(k->type);
  write_block_head(e, s, k);
  for (size_t i = 0; i < k->n; i++) {
    put_size(e, number[i] + s->elem0);
    for (size_t j = 0; j < nodes; j++) put_size(e, s->number[k->node[i * nodes + j]] + s->node0);
    end_line(e);
  }
}

static void element_range(const Selection *s, uint64_t range[2])
{
  const PartFile *p = s->parts;
  range[0] = 0;
  range[1] = s->nelem - 1;
  if (!p || !p->first) return;
  const uint64_t *ghost = p->ghost_number;
  range[0] = UINT64_MAX;
  range[1] = 0;
  for (size_t i = 0; i < s->nblock; i++) {
    size_t n = s->mesh->block[s->block[i]].n;
    bool ghosts = p->first[i] == UINT64_MAX;
    for (size_t k = 0; k < n; k += ghosts ? 1 : MAX(n - 1, (size_t)1)) {
      uint64_t number = ghosts ? *ghost++ : p->first[i] + k;
      range[0] = MIN(range[0], number);
      range[1] = MAX(range[1], number);
    }
  }
}

static void write_elements(Enc *e, const Selection *s)
{
  uint64_t range[2], number = s->elem0;
  const uint64_t *first = s->parts ? s->parts->first : NULL, *ghost = first ? s->parts->ghost_number : NULL;
  element_range(s, range);
  writer_str(e->w, "$Elements\n");
  put_size(e, s->nblock);
  put_size(e, s->nelem);
  put_size(e, s->elem0 + range[0]);
  put_size(e, s->elem0 + range[1]);
  end_line(e);
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    if (first && first[i] == UINT64_MAX) {
      write_ghost_block(e, s, k, ghost);
      ghost += k->n;
      continue;
    }
    if (first) number = s->elem0 + first[i];
    write_block(e, s, k, number);
    number += k->n;
  }
  writer_str(e->w, e->binary ? "\n$EndElements\n" : "$EndElements\n");
}

// Pairs of which both nodes are in the file.
static size_t pairs_saved(const Selection *s, const MeshPeriodic *p)
{
  size_t n = 0;
  for (size_t k = 0; k < p->slave_node.len; k++)
    n += s->number[p->slave_node.data[k]] != NONE && s->number[p->master_node.data[k]] != NONE;
  return n;
}

static void write_periodic(Enc *e, const Selection *s)
{
  const Mesh *m = s->mesh;
  size_t n = 0;
  for (size_t i = 0; i < m->nperiodic; i++) n += pairs_saved(s, &m->periodic[i]) > 0;
  if (!n) return;
  writer_str(e->w, "$Periodic\n");
  put_size(e, n);
  end_line(e);
  for (size_t i = 0; i < m->nperiodic; i++) {
    const MeshPeriodic *p = &m->periodic[i];
    size_t pairs = pairs_saved(s, p);
    if (!pairs) continue;
    put_int(e, p->dim);
    put_int(e, p->tag);
    put_int(e, p->master);
    end_line(e);
    put_size(e, p->has_affine ? 16 : 0);
    for (int k = 0; p->has_affine && k < 16; k++)
      put_real(e, k % 4 == 3 && k < 12 ? p->affine[k] * s->scale : p->affine[k]);
    end_line(e);
    put_size(e, pairs);
    end_line(e);
    for (size_t k = 0; k < p->slave_node.len; k++) {
      uint32_t a = s->number[p->slave_node.data[k]], b = s->number[p->master_node.data[k]];
      if (a == NONE || b == NONE) continue;
      put_size(e, a + s->node0);
      put_size(e, b + s->node0);
      end_line(e);
    }
  }
  writer_str(e->w, e->binary ? "\n$EndPeriodic\n" : "$EndPeriodic\n");
}

static void write_element_data(Writer *w, const Selection *s, const OutOptions *o)
{
  NumberedBlock *block = mem_alloc(s->nblock * sizeof *block);
  uint64_t number = s->elem0;
  for (size_t i = 0; i < s->nblock; number += s->mesh->block[s->block[i++]].n)
    block[i] = (NumberedBlock){s->block[i], number, 1};
  msh__write_element_data(w, s, block, s->nblock, o);
  free(block);
}

void msh4__write(Writer *w, const Selection *s, const OutOptions *o)
{
  Enc e = {w, o->binary, true};
  msh__write_format(w, "4.1", o);
  msh__write_names(w, s->mesh);
  write_entities(&e, s);
  if (s->parts) msh4_part__write_entities(&e, s);
  if (s->nnode) write_nodes(&e, s, o->save_parametric);
  if (s->nelem) write_elements(&e, s);
  write_periodic(&e, s);
  if (s->parts) msh4_part__write_ghosts(&e, s);
  if (o->cell_data && !(s->parts && s->parts->part)) write_element_data(w, s, o);
}
