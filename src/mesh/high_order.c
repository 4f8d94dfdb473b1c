// high_order.c - elements of order 2 to 4: displacements of edges, and the mesh written with them
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/high_order_int.h"

static ElemType type_of(const HighOrder *how, int dim, int corners, bool incomplete)
{
  static const ElemType line[] = {ELEM_LINE2, ELEM_LINE3, ELEM_LINE4, ELEM_LINE5};
  static const ElemType tri[] = {ELEM_TRI3, ELEM_TRI6, ELEM_TRI10, ELEM_TRI15};
  static const ElemType quad[] = {ELEM_QUAD4, ELEM_QUAD9, ELEM_QUAD16, ELEM_QUAD25};
  int k = how->order - 1;
  if (dim == 0) return ELEM_POINT;
  if (dim == 1) return line[k];
  if (incomplete && corners == 3 && k == 2) return ELEM_TRI9;
  if (incomplete && corners == 4 && k == 1) return ELEM_QUAD8;
  if (incomplete && corners == 4 && k == 2) return ELEM_QUAD12;
  return corners == 3 ? tri[k] : quad[k];
}

static int added_inside(ElemType straight, void *ctx)
{
  const HighOrder *how = ctx;
  int c = elem_corners(straight);
  ElemType t = type_of(how, 2, c, how->incomplete);
  return elem_nodes(t) - c * how->order;
}

// ---- displacements ---------------------------------------------------------------------------------------------
static void bend_edges(Elevator *v, const Model *model, HighOrderReport *report)
{
  int p = v->how->order;
  for (uint32_t e = 0; e < v->table.n; e++) {
    const MeshEdge *edge = &v->table.edge[e];
    Vec3 a = mesh_xyz(v->m, edge->a), b = mesh_xyz(v->m, edge->b);
    for (int k = 0; k < v->per_edge; k++) {
      double s = (k + 1) / (double)p;
      size_t i = (size_t)v->per_edge * e + (size_t)k;
      Vec3 q = edge_table_point(&v->table, v->m, v->how->linear ? NULL : model, e, s, &v->u[i]);
      v->shift[i] = vec3_sub(q, vec3_add(vec3_scale(1 - s, a), vec3_scale(s, b)));
      if (vec3_length(v->shift[i]) > 1e-14 * vec3_distance(a, b)) v->bent[e] = true;
    }
    if (v->bent[e])
      report->curved++;
    else
      for (int k = 0; k < v->per_edge; k++) v->shift[(size_t)v->per_edge * e + (size_t)k] = (Vec3){0, 0, 0};
  }
}

// ---- output ------------------------------------------------------------------------------------------------------
static void place_edges(Elevator *v, const Model *model)
{
  for (uint32_t e = 0; e < v->table.n; e++) {
    const MeshEdge *edge = &v->table.edge[e];
    for (int k = 0; k < v->per_edge; k++) {
      size_t i = (size_t)v->per_edge * e + (size_t)k;
      double s = (k + 1) / (double)v->how->order, u;
      Vec3 p;
      if (high_order__on_curve(v, e) && v->u[i] >= 0) { // on the curve itself, not on a sum that rounds
        p = edge_table_point(&v->table, v->m, v->how->linear ? NULL : model, e, s, &u);
      } else {
        p = vec3_add(vec3_scale(1 - s, mesh_xyz(v->m, edge->a)), vec3_scale(s, mesh_xyz(v->m, edge->b)));
        p = vec3_add(p, v->shift[i]);
      }
      mesh_set_node(v->e.mesh, v->e.edge[e] + (uint32_t)k, p, v->u[i]);
    }
  }
}

static void write_lines(const Elevator *v, const MeshBlock *from, uint32_t *to)
{
  for (size_t k = 0; k < from->n; k++) {
    uint32_t a = from->node[2 * k], b = from->node[2 * k + 1];
    *to++ = v->e.node[a];
    *to++ = v->e.node[b];
    for (int i = 0; i < v->per_edge; i++) *to++ = enriched_on_line(&v->e, &v->table, v->per_edge, from->entity, a, b, i);
  }
}

static void write_cells(const Elevator *v, const MeshBlock *from, const uint32_t *first, uint32_t *to)
{
  HighOrder how = *v->how;
  int c = elem_corners(from->type), inside = added_inside(from->type, &how);
  for (size_t k = 0; k < from->n; k++) {
    Cell cell = {.corner = from->node + (size_t)c * k, .corners = c};
    for (int i = 0; i < c; i++) {
      *to++ = v->e.node[cell.corner[i]];
      cell.edge[i] = edge_table_find(&v->table, from->entity, cell.corner[i], cell.corner[(i + 1) % c]);
    }
    for (int i = 0; i < c; i++)
      for (int j = 0; j < v->per_edge; j++)
        *to++ = enriched_at(&v->e, &v->table, v->per_edge, from->entity, cell.corner[i], cell.corner[(i + 1) % c], j);
    if (!inside) continue;
    Vec3 node[ELEM_MAX_NODES], normal;
    high_order__nodes(v, &cell, node, &normal);
    for (int i = 0; i < inside; i++) {
      mesh_set_node(v->e.mesh, first[k] + (uint32_t)i, node[c * how.order + i], NAN);
      *to++ = first[k] + (uint32_t)i;
    }
  }
}

static void write_blocks(Elevator *v)
{
  for (size_t i = 0; i < v->m->nblock; i++) {
    const MeshBlock *b = &v->m->block[i];
    int dim = elem_dim(b->type);
    ElemType type = type_of(v->how, dim, elem_corners(b->type), v->how->incomplete);
    uint32_t *to = enriched_block(&v->e, b->entity, type, b->n);
    if (dim == 0)
      for (size_t k = 0; k < b->n; k++) to[k] = v->e.node[b->node[k]];
    else if (dim == 1)
      write_lines(v, b, to);
    else
      write_cells(v, b, v->e.cell[i], to);
  }
}

static double certified_minimum(const Elevator *v, const CellVec *cell)
{
  double min = INFINITY;
  for (size_t i = 0; i < cell->len; i++) {
    Vec3 node[ELEM_MAX_NODES], normal;
    const Cell *c = &cell->data[i];
    if (c->corners == 3 && !high_order__bent(v, c)) {
      min = fmin(min, 1);
      continue;
    }
    double lo, hi;
    high_order__nodes(v, c, node, &normal);
    jacobian_bounds(&v->basis[c->corners - 3], node, normal, 0.05, &lo, &hi);
    min = fmin(min, lo);
  }
  return min;
}

static Mesh *elevate(const Mesh *m, const HighOrder *how, const Model *model, HighOrderReport *report)
{
  Elevator v = {.m = m, .how = how, .per_edge = how->order - 1};
  edge_table_make(&v.table, m);
  size_t n = (size_t)v.per_edge * v.table.n;
  v.shift = mem_zalloc(n * sizeof *v.shift);
  v.u = mem_alloc(n * sizeof *v.u);
  v.bent = mem_zalloc(v.table.n);
  bezier_basis_init(&v.basis[0], type_of(how, 2, 3, false));
  bezier_basis_init(&v.basis[1], type_of(how, 2, 4, false));
  bend_edges(&v, model, report);
  CellVec cell = high_order__cells(&v);
  high_order__unfold(&v, &cell, report);
  report->min_jacobian = certified_minimum(&v, &cell);
  HighOrder wanted = *how;
  enrich(&v.e, m, &v.table, v.per_edge, added_inside, &wanted);
  place_edges(&v, model);
  write_blocks(&v);
  enrich_periodic(&v.e, m, &v.table, v.per_edge);
  Mesh *out = v.e.mesh;
  enriched_free(&v.e, m);
  vec_free(&cell);
  free(v.shift);
  free(v.u);
  free(v.bent);
  edge_table_free(&v.table);
  return out;
}

Mesh *mesh_set_order(const Mesh *m, const HighOrder *how, const Model *model, HighOrderReport *report, Diag *diag)
{
  *report = (HighOrderReport){.min_jacobian = INFINITY};
  Mesh *straight = high_order__corners(m);
  if (how->order <= 1) return straight;
  Mesh *out = elevate(straight, how, model, report);
  mesh_free(straight);
  if (report->straightened)
    diag_warning(diag, NO_LOC,
                 "%zu edges of order %d had to be drawn nearer to straight lines than their curves, or elements beside them "
                 "would be folded; a finer mesh there avoids it",
                 report->straightened, how->order);
  return out;
}
