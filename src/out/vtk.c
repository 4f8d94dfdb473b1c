// vtk.c - legacy VTK files: unstructured grids, ASCII and binary
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/out_int.h"

int vtk__cell_type(ElemType t)
{
  switch (t) {
  case ELEM_POINT: return 1;
  case ELEM_LINE2: return 3;
  case ELEM_TRI3: return 5;
  case ELEM_QUAD4: return 9;
  case ELEM_LINE3: return 21;
  case ELEM_TRI6: return 22;
  case ELEM_QUAD8: return 23;
  case ELEM_QUAD9: return 28;
  case ELEM_LINE4:
  case ELEM_LINE5: return 68; // Lagrange cells of any order
  case ELEM_TRI10:
  case ELEM_TRI15: return 69;
  case ELEM_QUAD16:
  case ELEM_QUAD25: return 70;
  case ELEM_TRI9:
  case ELEM_QUAD12: return 0;
  }
  return 0;
}

const char *vtk__refuses(const Selection *s)
{
  for (size_t i = 0; i < s->nblock; i++)
    if (!vtk__cell_type(s->mesh->block[s->block[i]].type))
      return "VTK has no incomplete elements of order 3 (use Mesh.SecondOrderIncomplete = 0)";
  return NULL;
}

// perm: vtk[i] = ours[perm[i]]. Lagrange quadrangles list each edge from the lower to the higher coordinate and the
// interior row by row; Lagrange triangles are as ours, up to order 4.
int vtk__order(ElemType t, uint8_t perm[ELEM_MAX_NODES])
{
  uint8_t ij[ELEM_MAX_NODES][2];
  int n = elem_lattice(t, ij), p = elem_order(t), k = 4;
  for (int i = 0; i < n; i++) perm[i] = (uint8_t)i;
  if (vtk__cell_type(t) != 70) return n;
  int want[ELEM_MAX_NODES][2] = {{0, 0}, {p, 0}, {p, p}, {0, p}};
  for (int e = 0; e < 4; e++)
    for (int i = 1; i < p; i++, k++) {
      want[k][0] = e == 0 || e == 2 ? i : e == 1 ? p : 0;
      want[k][1] = e == 1 || e == 3 ? i : e == 2 ? p : 0;
    }
  for (int j = 1; j < p; j++)
    for (int i = 1; i < p; i++, k++) {
      want[k][0] = i;
      want[k][1] = j;
    }
  for (int a = 0; a < n; a++)
    for (int b = 0; b < n; b++)
      if (ij[b][0] == want[a][0] && ij[b][1] == want[a][1]) perm[a] = (uint8_t)b;
  return n;
}

static char *put_binary_points(char *p, const void *ctx, size_t from, size_t to)
{
  for (size_t k = from; k < to; k++, p += 24) {
    const Vec3 x = select__xyz(ctx, k);
    uint64_t b[3];
    memcpy(b, &x, sizeof b);
    for (int i = 0; i < 3; i++) b[i] = __builtin_bswap64(b[i]);
    memcpy(p, b, sizeof b);
  }
  return p;
}

typedef struct {
  const Selection *s;
  const MeshBlock *block;
  uint8_t order[ELEM_MAX_NODES]; // of the nodes (vtk__order)
  int nodes;
} CellItems;

static char *put_cells(char *p, const void *ctx, size_t from, size_t to)
{
  const CellItems *t = ctx;
  const uint32_t *node = t->block->node + from * (size_t)t->nodes;
  for (size_t j = from; j < to; j++, node += t->nodes) {
    p = put_u64(p, (uint64_t)t->nodes);
    p = put_char(put_node_numbers(p, t->s, node, t->order, (size_t)t->nodes, 0), '\n');
  }
  return p;
}

static inline char *put_records(char *p, const CellItems *t, size_t from, size_t to, int nodes)
{
  const uint32_t *node = t->block->node + from * (size_t)nodes;
  for (size_t j = from; j < to; j++, node += nodes) {
    uint32_t rec[1 + ELEM_MAX_NODES] = {__builtin_bswap32((uint32_t)nodes)};
    for (int a = 0; a < nodes; a++) rec[1 + a] = __builtin_bswap32(t->s->number[node[t->order[a]]]);
    p = (char *)memcpy(p, rec, ((size_t)nodes + 1) * 4) + ((size_t)nodes + 1) * 4;
  }
  return p;
}

static char *put_binary_cells(char *p, const void *ctx, size_t from, size_t to)
{
  const CellItems *t = ctx;
  return t->nodes == 3 ? put_records(p, t, from, to, 3) : put_records(p, t, from, to, t->nodes);
}

static void write_cells(Writer *w, const Selection *s, bool binary)
{
  size_t total = 0;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    total += k->n * (size_t)(elem_nodes(k->type) + 1);
  }
  writer_printf(w, "CELLS %zu %zu\n", s->nelem, total);
  for (size_t i = 0; i < s->nblock; i++) {
    CellItems items = {.s = s, .block = &s->mesh->block[s->block[i]]};
    items.nodes = vtk__order(items.block->type, items.order);
    writer_items(w, items.block->n, 12 * ((size_t)items.nodes + 2), binary ? put_binary_cells : put_cells, &items);
  }
  writer_char(w, '\n');
}

// The same bytes n times.
static void write_repeated(Writer *w, const char *text, size_t len, size_t n)
{
  enum { ROOM = 1 << 14 };
  char many[ROOM];
  size_t at_once = MIN(n, ROOM / len);
  for (size_t i = 0; i < at_once; i++) memcpy(many + i * len, text, len);
  for (; n; n -= MIN(n, at_once)) writer_bytes(w, many, MIN(n, at_once) * len);
}

// One integer per cell, the same for all of a block.
static void write_per_block(Writer *w, const Selection *s, bool binary, int (*value)(const Mesh *m, const MeshBlock *k))
{
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    int v = value(s->mesh, k);
    uint32_t bytes = __builtin_bswap32((uint32_t)v);
    char text[16];
    int len = snprintf(text, sizeof text, "%d\n", v);
    write_repeated(w, binary ? (const char *)&bytes : text, binary ? sizeof bytes : (size_t)len, k->n);
  }
  if (binary) writer_char(w, '\n');
}

static int type_value(const Mesh *m, const MeshBlock *k)
{
  (void)m;
  return vtk__cell_type(k->type);
}

static int group_value(const Mesh *m, const MeshBlock *k)
{
  int tag = select__physical(&m->entity[k->entity]);
  return tag ? tag : -1;
}

static int entity_value(const Mesh *m, const MeshBlock *k) { return m->entity[k->entity].tag; }

static void write_part_numbers(Writer *w, const Selection *s, bool binary)
{
  writer_str(w, "SCALARS partition int 1\nLOOKUP_TABLE default\n");
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    for (size_t j = 0; j < k->n; j++) {
      char *p0 = writer_reserve(w, 32), *p = p0;
      uint32_t b = __builtin_bswap32(k->part[j]);
      p = binary ? (char *)memcpy(p, &b, sizeof b) + sizeof b : put_char(put_u64(p, k->part[j]), '\n');
      writer_commit(w, (size_t)(p - p0));
    }
  }
  if (binary) writer_char(w, '\n');
}

static void write_measure(Writer *w, const Selection *s, bool binary, Measure what)
{
  double *value = cell_data__values(s, what);
  writer_printf(w, "SCALARS %s double 1\nLOOKUP_TABLE default\n", mesh_measure_name(what));
  for (size_t i = 0; i < s->nelem; i++) {
    char *p0 = writer_reserve(w, 64), *p = p0;
    if (binary) {
      uint64_t b;
      memcpy(&b, &value[i], sizeof b);
      b = __builtin_bswap64(b);
      p = (char *)memcpy(p, &b, sizeof b) + sizeof b;
    } else {
      p = put_char(put_double(p, value[i]), '\n');
    }
    writer_commit(w, (size_t)(p - p0));
  }
  if (binary) writer_char(w, '\n');
  free(value);
}

void vtk__write(Writer *w, const Selection *s, const OutOptions *o)
{
  writer_printf(w, "# vtk DataFile Version 3.0\n%.200s\n%s\nDATASET UNSTRUCTURED_GRID\n",
                o->title ? o->title : "meshgen", o->binary ? "BINARY" : "ASCII");
  writer_printf(w, "POINTS %zu double\n", s->nnode);
  if (o->binary)
    writer_items(w, s->nnode, 3 * sizeof(double), put_binary_points, s);
  else
    select__write_points(w, s, "");
  writer_char(w, '\n');
  write_cells(w, s, o->binary);
  writer_printf(w, "CELL_TYPES %zu\n", s->nelem);
  write_per_block(w, s, o->binary, type_value);
  writer_printf(w, "%sCELL_DATA %zu\n", o->binary ? "" : "\n", s->nelem);
  if (mesh_is_grouped(s->mesh)) {
    writer_str(w, "SCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n");
    write_per_block(w, s, o->binary, group_value);
  }
  writer_str(w, "SCALARS GeometricalEntityIds int 1\nLOOKUP_TABLE default\n");
  write_per_block(w, s, o->binary, entity_value);
  if (s->mesh->nparts) write_part_numbers(w, s, o->binary);
  for (Measure what = 0; cell_data__next(o, &what); what++) write_measure(w, s, o->binary, what);
}
