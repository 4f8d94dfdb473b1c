// msh2.c - writers of MSH 2.2, ASCII and binary, and of MSH 1
// SPDX-License-Identifier: MIT
//
// Elements are listed by shape (points, lines, triangles, quadrangles) and within it by entity. An element of k physical
// groups is written k times under k numbers, and reversed where its entity is in the group with a minus sign. When all is saved
// regardless of groups (Mesh.SaveAll), every element is written once, with physical tag 0, as Gmsh does.
#include "base/base.h"

#include <inttypes.h>

#include "out/msh2_int.h"

static Run run_of(const Selection *s, uint32_t b)
{
  Run r = {.block = &s->mesh->block[b]};
  r.entity = &s->mesh->entity[r.block->entity];
  r.grouped = s->grouped && r.entity->physical.len > 0;
  r.copies = r.grouped ? (int)r.entity->physical.len : 1;
  r.nodes = elem_symmetry(r.block->type, 0, true, r.reversed);
  return r;
}

// Call body for every saved block in the order of the file.
static void each_run(const Selection *s, void (*body)(void *ctx, const Run *r), void *ctx)
{
  for (int corners = 1; corners <= 4; corners++)
    for (size_t i = 0; i < s->nblock; i++)
      if (elem_corners(s->mesh->block[s->block[i]].type) == corners) {
        Run r = run_of(s, s->block[i]);
        body(ctx, &r);
      }
}

typedef struct {
  Writer *w;
  const Selection *s;
  uint64_t number;
  bool binary;
} Out;

static void count_run(void *ctx, const Run *r) { *(size_t *)ctx += r->block->n * (size_t)r->copies; }

// Item k of a run is copy k % copies of element k / copies; items are numbered from first.
typedef struct {
  const Selection *s;
  const Run *run;
  uint64_t first;
} RunItems;

static char *put_elements(char *p, const void *ctx, size_t from, size_t to)
{
  const RunItems *t = ctx;
  const Run *r = t->run;
  const uint32_t *node = r->block->node + from / (size_t)r->copies * (size_t)r->nodes;
  int c = (int)(from % (size_t)r->copies);
  for (size_t i = from; i < to; i++) {
    int phys = physical_of(r, c);
    p = put_u64(p, t->first + i);
    p = put_u64(put_char(p, ' '), r->block->type);
    p = put_u64((char *)memcpy(p, " 2 ", 3) + 3, (uint64_t)abs(phys));
    p = put_u64(put_char(p, ' '), (uint64_t)r->entity->tag);
    p = phys < 0 ? put_node_numbers(p, t->s, node, r->reversed, (size_t)r->nodes, t->s->node0)
                 : put_node_numbers(p, t->s, node, NULL, (size_t)r->nodes, t->s->node0);
    p = put_char(p, '\n');
    if (++c == r->copies) c = 0, node += r->nodes;
  }
  return p;
}

static inline char *put_records(char *p, const RunItems *t, size_t from, size_t to, int nodes)
{
  const Run *r = t->run;
  const uint32_t *node = r->block->node + from / (size_t)r->copies * (size_t)nodes;
  int c = (int)(from % (size_t)r->copies);
  for (size_t i = from; i < to; i++) {
    int phys = physical_of(r, c);
    int32_t rec[3 + ELEM_MAX_NODES] = {(int32_t)(t->first + i), abs(phys), r->entity->tag};
    size_t size = (3 + (size_t)nodes) * sizeof *rec;
    for (int k = 0; k < nodes; k++)
      rec[3 + k] = (int32_t)(t->s->number[node[phys < 0 ? r->reversed[k] : k]] + t->s->node0);
    p = (char *)memcpy(p, rec, size) + size;
    if (++c == r->copies) c = 0, node += nodes;
  }
  return p;
}

static char *put_binary_elements(char *p, const void *ctx, size_t from, size_t to)
{
  const RunItems *t = ctx;
  return t->run->nodes == 3 ? put_records(p, t, from, to, 3) : put_records(p, t, from, to, t->run->nodes);
}

static void write_run(void *ctx, const Run *r)
{
  Out *o = ctx;
  size_t n = r->block->n * (size_t)r->copies;
  if (o->s->parts && r->block->part) {
    msh2_part__write_run(o->w, o->s, r, o->number, o->binary);
    o->number += n;
    return;
  }
  const int32_t head[3] = {(int32_t)r->block->type, (int32_t)n, 2};
  if (o->binary) writer_bytes(o->w, head, sizeof head);
  writer_items(o->w, n, 22 * ((size_t)r->nodes + 5), o->binary ? put_binary_elements : put_elements,
               &(RunItems){o->s, r, o->number});
  o->number += n;
}

// " dim tag [u]" of $ParametricNodes
static char *put_parameter(char *p, const Mesh *m, uint32_t node)
{
  const MeshEntity *e = &m->entity[m->node_entity[node]];
  // Parameters of faces are not kept, and a node of dimension 2 must have two: such nodes are given as free in space.
  int dim = e->dim == 2 || (e->dim == 1 && isnan(m->node_u[node])) ? 3 : e->dim;
  p = put_u64(put_char(p, ' '), (uint64_t)dim);
  p = put_u64(put_char(p, ' '), (uint64_t)e->tag);
  return dim == 1 ? put_double(put_char(p, ' '), m->node_u[node]) : p;
}

static char *put_nodes(char *p, const void *ctx, size_t from, size_t to)
{
  const Selection *s = ctx;
  for (size_t k = from; k < to; k++) {
    p = put_u64(p, s->number[s->node[k]] + s->node0);
    p = put_char(put_xyz(put_char(p, ' '), select__xyz(s, k)), '\n');
  }
  return p;
}

static char *put_parametric_nodes(char *p, const void *ctx, size_t from, size_t to)
{
  const Selection *s = ctx;
  for (size_t k = from; k < to; k++) {
    p = put_xyz(put_char(put_u64(p, s->number[s->node[k]] + s->node0), ' '), select__xyz(s, k));
    p = put_char(put_parameter(p, s->mesh, s->node[k]), '\n');
  }
  return p;
}

static char *put_binary_nodes(char *p, const void *ctx, size_t from, size_t to)
{
  const Selection *s = ctx;
  for (size_t k = from; k < to; k++, p += 28) {
    int32_t number = (int32_t)(s->number[s->node[k]] + s->node0);
    Vec3 x = select__xyz(s, k);
    memcpy(p, &number, 4);
    memcpy(p + 4, &x, 24);
  }
  return p;
}

static bool all_numbered(const Selection *s, const U32Vec *v)
{
  for (size_t i = 0; i < v->len; i++)
    if (s->number[v->data[i]] == NONE) return false;
  return true;
}

static bool periodic_saved(const Selection *s, const MeshPeriodic *p)
{
  uint32_t a = mesh_find_entity(s->mesh, p->dim, p->tag), b = mesh_find_entity(s->mesh, p->dim, p->master);
  return a != NONE && b != NONE && s->entity[a] && s->entity[b] && all_numbered(s, &p->slave_node) &&
         all_numbered(s, &p->master_node);
}

static void write_periodic(Writer *w, const Selection *s)
{
  const Mesh *m = s->mesh;
  size_t n = 0;
  for (size_t i = 0; i < m->nperiodic; i++) n += periodic_saved(s, &m->periodic[i]);
  if (!n) return;
  writer_printf(w, "$Periodic\n%zu\n", n);
  for (size_t i = 0; i < m->nperiodic; i++) {
    const MeshPeriodic *p = &m->periodic[i];
    if (!periodic_saved(s, p)) continue;
    writer_printf(w, "%d %d %d\n", p->dim, p->tag, p->master);
    if (p->has_affine) {
      writer_str(w, "Affine");
      for (int k = 0; k < 16; k++) {
        writer_char(w, ' ');
        writer_double(w, k % 4 == 3 && k < 12 ? p->affine[k] * s->scale : p->affine[k]);
      }
      writer_char(w, '\n');
    }
    writer_printf(w, "%zu\n", p->slave_node.len);
    for (size_t k = 0; k < p->slave_node.len; k++)
      writer_printf(w, "%" PRIu64 " %" PRIu64 "\n", s->number[p->slave_node.data[k]] + s->node0,
                    s->number[p->master_node.data[k]] + s->node0);
  }
  writer_str(w, "$EndPeriodic\n");
}

typedef struct {
  const Selection *s;
  NumberedBlock *block;
  size_t n;
  uint64_t number;
} Numbering;

static void number_run(void *ctx, const Run *r)
{
  Numbering *g = ctx;
  g->block[g->n++] = (NumberedBlock){(uint32_t)(r->block - g->s->mesh->block), g->number, (size_t)r->copies};
  g->number += r->block->n * (size_t)r->copies;
}

static void write_element_data(Writer *w, const Selection *s, const OutOptions *o)
{
  Numbering g = {s, mem_alloc(s->nblock * sizeof *g.block), 0, s->elem0};
  each_run(s, number_run, &g);
  msh__write_element_data(w, s, g.block, g.n, o);
  free(g.block);
}

enum { NODE_ROOM = 7 * NUMBER_MAX_TEXT };

void msh2__write(Writer *w, const Selection *s, const OutOptions *o)
{
  bool parametric = o->save_parametric && !o->binary;
  const char *nodes = parametric ? "ParametricNodes" : "Nodes";
  msh__write_format(w, "2.2", o);
  msh__write_names(w, s->mesh);
  writer_printf(w, "$%s\n%zu\n", nodes, s->nnode);
  writer_items(w, s->nnode, NODE_ROOM, o->binary ? put_binary_nodes : parametric ? put_parametric_nodes : put_nodes, s);
  size_t n = 0;
  each_run(s, count_run, &n);
  writer_printf(w, "%s$End%s\n$Elements\n%zu\n", o->binary ? "\n" : "", nodes, n);
  each_run(s, write_run, &(Out){w, s, s->elem0, o->binary});
  writer_printf(w, "%s$EndElements\n", o->binary ? "\n" : "");
  write_periodic(w, s);
  if (o->cell_data) write_element_data(w, s, o);
}

static void msh1_run(void *ctx, const Run *r)
{
  Out *o = ctx;
  for (size_t i = 0; i < r->block->n; i++)
    for (int c = 0; c < r->copies; c++) {
      const uint32_t *node = r->block->node + i * (size_t)r->nodes;
      int phys = physical_of(r, c);
      writer_printf(o->w, "%" PRIu64 " %d %d %d %d", o->number++, (int)r->block->type, abs(phys), r->entity->tag, r->nodes);
      for (int k = 0; k < r->nodes; k++) {
        writer_char(o->w, ' ');
        writer_u64(o->w, o->s->number[node[phys < 0 ? r->reversed[k] : k]] + o->s->node0);
      }
      writer_char(o->w, '\n');
    }
}

void msh1__write(Writer *w, const Selection *s, const OutOptions *o)
{
  (void)o;
  writer_printf(w, "$NOD\n%zu\n", s->nnode);
  writer_items(w, s->nnode, NODE_ROOM, put_nodes, s);
  size_t n = 0;
  each_run(s, count_run, &n);
  writer_printf(w, "$ENDNOD\n$ELM\n%zu\n", n);
  each_run(s, msh1_run, &(Out){w, s, s->elem0, false});
  writer_str(w, "$ENDELM\n");
}
