// msh2.c - writers of MSH 2.2, ASCII and binary, and of MSH 1
// SPDX-License-Identifier: MIT
//
// Elements are listed by shape (points, lines, triangles, quadrangles) and within it by entity. An element of k physical
// groups is written k times under k numbers, and reversed where its entity is in the group with a minus sign. When all is saved
// regardless of groups (Mesh.SaveAll), every element is written once, with physical tag 0, as Gmsh does.
#include "base/base.h"

#include <inttypes.h>

#include "out/out_int.h"

// Elements of one block as this version lists them.
typedef struct {
  const MeshBlock *block;
  const MeshEntity *entity;
  int copies;                      // how often each element is written
  bool grouped;                    // physical tags are written
  uint8_t reversed[ELEM_MAX_NODES];
  int nodes;
} Run;

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
} Out;

static int physical_of(const Run *r, int copy)
{
  return r->grouped ? r->entity->physical.data[copy] : 0;
}

static void count_run(void *ctx, const Run *r) { *(size_t *)ctx += r->block->n * (size_t)r->copies; }

static void ascii_run(void *ctx, const Run *r)
{
  Out *o = ctx;
  for (size_t i = 0; i < r->block->n; i++) {
    const uint32_t *node = r->block->node + i * (size_t)r->nodes;
    for (int c = 0; c < r->copies; c++) {
      int phys = physical_of(r, c);
      char *p0 = writer_reserve(o->w, 1024), *p = p0;
      p = put_u64(p, o->number++);
      p = put_char(p, ' ');
      p = put_u64(p, r->block->type);
      memcpy(p, " 2 ", 3);
      p = put_u64(p + 3, (uint64_t)abs(phys));
      p = put_char(p, ' ');
      p = put_u64(p, (uint64_t)r->entity->tag);
      for (int k = 0; k < r->nodes; k++) {
        p = put_char(p, ' ');
        p = put_u64(p, o->s->number[node[phys < 0 ? r->reversed[k] : k]] + o->s->node0);
      }
      p = put_char(p, '\n');
      writer_commit(o->w, (size_t)(p - p0));
    }
  }
}

static void binary_run(void *ctx, const Run *r)
{
  Out *o = ctx;
  const int32_t head[3] = {(int32_t)r->block->type, (int32_t)(r->block->n * (size_t)r->copies), 2};
  writer_bytes(o->w, head, sizeof head);
  for (size_t i = 0; i < r->block->n; i++) {
    const uint32_t *node = r->block->node + i * (size_t)r->nodes;
    for (int c = 0; c < r->copies; c++) {
      int32_t rec[3 + ELEM_MAX_NODES], phys = physical_of(r, c);
      size_t size = (3 + (size_t)r->nodes) * sizeof *rec;
      rec[0] = (int32_t)o->number++;
      rec[1] = abs(phys);
      rec[2] = r->entity->tag;
      for (int k = 0; k < r->nodes; k++)
        rec[3 + k] = (int32_t)(o->s->number[node[phys < 0 ? r->reversed[k] : k]] + o->s->node0);
      memcpy(writer_reserve(o->w, size), rec, size);
      writer_commit(o->w, size);
    }
  }
}

static char *put_node(char *p, uint64_t number, Vec3 x)
{
  p = put_u64(p, number);
  p = put_double(put_char(p, ' '), x.x);
  p = put_double(put_char(p, ' '), x.y);
  return put_double(put_char(p, ' '), x.z);
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

static void ascii_nodes(Writer *w, const Selection *s, bool parametric)
{
  for (size_t k = 0; k < s->nnode; k++) {
    char *p0 = writer_reserve(w, 256), *p = put_node(p0, k + s->node0, select__xyz(s, k));
    if (parametric) p = put_parameter(p, s->mesh, s->node[k]);
    p = put_char(p, '\n');
    writer_commit(w, (size_t)(p - p0));
  }
}

static void binary_nodes(Writer *w, const Selection *s)
{
  for (size_t k = 0; k < s->nnode; k++) {
    char *p = writer_reserve(w, 28);
    int32_t number = (int32_t)(k + s->node0);
    Vec3 x = select__xyz(s, k);
    memcpy(p, &number, 4);
    memcpy(p + 4, &x, 24);
    writer_commit(w, 28);
  }
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

void msh2__write(Writer *w, const Selection *s, const OutOptions *o)
{
  bool parametric = o->save_parametric && !o->binary;
  const char *nodes = parametric ? "ParametricNodes" : "Nodes";
  msh__write_format(w, "2.2", o);
  msh__write_names(w, s->mesh);
  writer_printf(w, "$%s\n%zu\n", nodes, s->nnode);
  if (o->binary)
    binary_nodes(w, s);
  else
    ascii_nodes(w, s, parametric);
  size_t n = 0;
  each_run(s, count_run, &n);
  writer_printf(w, "%s$End%s\n$Elements\n%zu\n", o->binary ? "\n" : "", nodes, n);
  each_run(s, o->binary ? binary_run : ascii_run, &(Out){w, s, s->elem0});
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
  ascii_nodes(w, s, false);
  size_t n = 0;
  each_run(s, count_run, &n);
  writer_printf(w, "$ENDNOD\n$ELM\n%zu\n", n);
  each_run(s, msh1_run, &(Out){w, s, s->elem0});
  writer_str(w, "$ENDELM\n");
}
