// high_order_unfold.c - no element of a curved mesh stays folded
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/high_order_int.h"

static bool cell_good(const Elevator *v, const Cell *c)
{
  if (!high_order__bent(v, c)) return true; // as good as the straight one
  Vec3 node[ELEM_MAX_NODES], normal;
  high_order__nodes(v, c, node, &normal);
  return jacobian_positive(&v->basis[c->corners - 3], node, normal);
}

// Ids of the folded ones.
static U32Vec folded_cells(const Elevator *v, const CellVec *cell)
{
  U32Vec bad = {0};
  for (size_t i = 0; i < cell->len; i++)
    if (!cell_good(v, &cell->data[i])) vec_push(&bad, (uint32_t)i);
  return bad;
}

// Edges meet in cells: cells[start[e]] .. cells[start[e+1]].
typedef struct {
  uint32_t *start, *cells;
} Around;

static void around_make(Around *a, size_t nedge, const CellVec *cell)
{
  size_t total = 0;
  a->start = mem_zalloc((nedge + 2) * sizeof *a->start);
  for (size_t i = 0; i < cell->len; i++)
    for (int k = 0; k < cell->data[i].corners; k++, total++) a->start[cell->data[i].edge[k] + 2]++;
  for (size_t e = 0; e < nedge; e++) a->start[e + 2] += a->start[e + 1];
  a->cells = mem_alloc(total * sizeof *a->cells);
  for (size_t i = 0; i < cell->len; i++)
    for (int k = 0; k < cell->data[i].corners; k++) a->cells[a->start[cell->data[i].edge[k] + 1]++] = (uint32_t)i;
}

static Vec3 edge_vector(const Elevator *v, uint32_t e)
{
  return vec3_sub(mesh_xyz(v->m, v->table.edge[e].b), mesh_xyz(v->m, v->table.edge[e].a));
}

static Vec3 edge_middle(const Elevator *v, uint32_t e)
{
  return vec3_scale(0.5, vec3_add(mesh_xyz(v->m, v->table.edge[e].b), mesh_xyz(v->m, v->table.edge[e].a)));
}

// How much edge f of a cell has to say about edge e: more if near and parallel. On quadrangles only the opposite edge counts.
static double influence(const Elevator *v, const Cell *c, int e, int f)
{
  if (c->corners == 4 && (e - f) % 2 != 0) return 0;
  Vec3 d = edge_vector(v, c->edge[e]), g = edge_vector(v, c->edge[f]);
  Vec3 to = vec3_sub(edge_middle(v, c->edge[f]), edge_middle(v, c->edge[e]));
  double along = vec3_dot(d, g), cos2 = along * along / (vec3_dot(d, d) * vec3_dot(g, g));
  return cos2 * cos2 / vec3_dot(to, to);
}

// A free edge takes the mean of the displacements of the edges it shares cells with.
static void relax_edge(Elevator *v, const CellVec *cell, const Around *a, uint32_t e)
{
  Vec3 sum[HIGH_ORDER_MAX - 1] = {{0, 0, 0}};
  double weight = 0;
  for (uint32_t i = a->start[e]; i < a->start[e + 1]; i++) {
    const Cell *c = &cell->data[a->cells[i]];
    int own = 0;
    while (c->edge[own] != e) own++;
    for (int k = 0; k < c->corners; k++) {
      uint32_t f = c->edge[k];
      double w = k == own ? 0 : influence(v, c, own, k);
      bool against = vec3_dot(edge_vector(v, e), edge_vector(v, f)) < 0;
      weight += w;
      for (int j = 0; j < v->per_edge && w > 0; j++) {
        int from = against ? v->per_edge - 1 - j : j;
        sum[j] = vec3_add(sum[j], vec3_scale(w, v->shift[(size_t)v->per_edge * f + (size_t)from]));
      }
    }
  }
  for (int j = 0; j < v->per_edge && weight > 0; j++)
    v->shift[(size_t)v->per_edge * e + (size_t)j] = vec3_scale(1 / weight, sum[j]);
  v->bent[e] = true;
}

// The edges not on curves of the cells within `rings` of the folded ones, in the order they are met: nearest first.
static U32Vec region_of(const Elevator *v, const CellVec *cell, const Around *a, const U32Vec *bad, int rings)
{
  U32Vec edges = {0}, front = {0}, next = {0};
  bool *seen = mem_zalloc(cell->len), *taken = mem_zalloc(v->table.n);
  for (size_t i = 0; i < bad->len; i++) {
    vec_push(&front, bad->data[i]);
    seen[bad->data[i]] = true;
  }
  for (int r = 0; r < rings; r++) {
    vec_clear(&next);
    for (size_t i = 0; i < front.len; i++) {
      const Cell *c = &cell->data[front.data[i]];
      for (int k = 0; k < c->corners; k++) {
        uint32_t e = c->edge[k];
        if (taken[e]) continue;
        taken[e] = true;
        if (!high_order__on_curve(v, e)) vec_push(&edges, e);
        for (uint32_t j = a->start[e]; j < a->start[e + 1]; j++)
          if (!seen[a->cells[j]]) {
            seen[a->cells[j]] = true;
            vec_push(&next, a->cells[j]);
          }
      }
    }
    U32Vec swap = front;
    front = next;
    next = swap;
  }
  free(seen);
  free(taken);
  vec_free(&front);
  vec_free(&next);
  return edges;
}

static void scale_edge(Elevator *v, uint32_t e, double f)
{
  for (int k = 0; k < v->per_edge; k++) {
    Vec3 *s = &v->shift[(size_t)v->per_edge * e + (size_t)k];
    *s = vec3_scale(f, *s);
  }
  if (f == 0) v->bent[e] = false;
}

// Draw the edges of the folded cells nearer to straight until none is folded: free ones first, then those of curves.
static void straighten(Elevator *v, const CellVec *cell, HighOrderReport *report)
{
  bool *touched = mem_zalloc(v->table.n);
  for (int round = 0;; round++) {
    U32Vec bad = folded_cells(v, cell);
    bool curves = round >= 6, flat = round >= 40;
    for (size_t i = 0; i < bad.len; i++) {
      const Cell *c = &cell->data[bad.data[i]];
      for (int k = 0; k < c->corners; k++) {
        if (high_order__on_curve(v, c->edge[k]) && !curves) continue;
        if (high_order__on_curve(v, c->edge[k]) && v->bent[c->edge[k]]) touched[c->edge[k]] = true;
        scale_edge(v, c->edge[k], flat ? 0 : high_order__on_curve(v, c->edge[k]) ? 0.75 : 0.5);
      }
    }
    size_t left = bad.len;
    vec_free(&bad);
    if (!left || round > 60) break; // beyond 60 all edges of bad cells are straight: what is left was folded before
  }
  for (size_t e = 0; e < v->table.n; e++) {
    report->straightened += touched[e];
    for (int k = 0; k < v->per_edge && touched[e]; k++) v->u[(size_t)v->per_edge * e + (size_t)k] = NAN;
  }
  free(touched);
}

void high_order__unfold(Elevator *v, const CellVec *cell, HighOrderReport *report)
{
  U32Vec bad = folded_cells(v, cell);
  report->folded = bad.len;
  if (bad.len) {
    Around a;
    around_make(&a, v->table.n, cell);
    for (int rings = 3; bad.len && rings <= 48; rings *= 2) {
      U32Vec edges = region_of(v, cell, &a, &bad, rings);
      for (int sweep = 0; sweep < 4 * rings; sweep++)
        for (size_t i = 0; i < edges.len; i++) relax_edge(v, cell, &a, edges.data[i]);
      vec_free(&edges);
      vec_free(&bad);
      bad = folded_cells(v, cell);
    }
    free(a.start);
    free(a.cells);
    if (bad.len) straighten(v, cell, report);
  }
  vec_free(&bad);
}
