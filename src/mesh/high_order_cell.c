// high_order_cell.c - nodes of curved elements from the displacements of their edges
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/high_order_int.h"

// Displacement at fraction t of edge e run from node `from`: the Lagrange polynomial through its nodes, 0 at both ends.
static Vec3 shift_at(const Elevator *v, uint32_t e, uint32_t from, double t)
{
  int p = v->how->order;
  if (v->table.edge[e].a != from) t = 1 - t;
  Vec3 sum = {0, 0, 0};
  for (int k = 1; k < p; k++) {
    double w = 1;
    for (int i = 0; i <= p; i++)
      if (i != k) w *= (p * t - i) / (double)(k - i);
    sum = vec3_add(sum, vec3_scale(w, v->shift[(size_t)v->per_edge * e + (size_t)k - 1]));
  }
  return sum;
}

// Edge displacements let into a triangle: each fades linearly towards the opposite corner [Szabo91]. On quadratic triangles this
// is the quadratic map itself.
static Vec3 shift_in_triangle(const Elevator *v, const uint32_t *corner, const uint32_t *edge, const double l[3])
{
  Vec3 sum = {0, 0, 0};
  for (int i = 0; i < 3; i++) {
    if (!v->bent[edge[i]]) continue;
    double a = l[i], b = l[(i + 1) % 3], d = b - a;
    if (a <= 0 || b <= 0) continue;
    sum = vec3_add(sum, vec3_scale(4 * a * b / (1 - d * d), shift_at(v, edge[i], corner[i], 0.5 * (1 + d))));
  }
  return sum;
}

static Vec3 shift_in_quad(const Elevator *v, const uint32_t *corner, const uint32_t *edge, double x, double y)
{
  const double along[4] = {x, y, 1 - x, 1 - y}, fade[4] = {1 - y, x, y, 1 - x};
  Vec3 sum = {0, 0, 0};
  for (int i = 0; i < 4; i++)
    if (v->bent[edge[i]]) sum = vec3_add(sum, vec3_scale(fade[i], shift_at(v, edge[i], corner[i], along[i])));
  return sum;
}

// All nodes of the complete element on `corner`, in the order of its type. O(p^3)
static void element_nodes(const Elevator *v, const BezierBasis *b, const uint32_t *corner, const uint32_t *edge, Vec3 *node)
{
  double p = b->order;
  Vec3 x[4];
  for (int i = 0; i < b->corners; i++) x[i] = mesh_xyz(v->m, corner[i]);
  for (int k = 0; k < b->n; k++) {
    double s = b->ij[k][0] / p, t = b->ij[k][1] / p;
    if (k < b->corners) {
      node[k] = x[k];
    } else if (b->corners == 3) {
      double l[3] = {1 - s - t, s, t};
      int first = k - 3, i = first / v->per_edge;
      Vec3 at = vec3_add(vec3_scale(l[0], x[0]), vec3_add(vec3_scale(l[1], x[1]), vec3_scale(l[2], x[2])));
      Vec3 d = i < 3 ? shift_at(v, edge[i], corner[i], (first % v->per_edge + 1) / p) : shift_in_triangle(v, corner, edge, l);
      node[k] = vec3_add(at, d);
    } else {
      Vec3 at = vec3_add(vec3_scale((1 - s) * (1 - t), x[0]), vec3_scale(s * (1 - t), x[1]));
      at = vec3_add(at, vec3_add(vec3_scale(s * t, x[2]), vec3_scale((1 - s) * t, x[3])));
      node[k] = vec3_add(at, shift_in_quad(v, corner, edge, s, t));
    }
  }
}

CellVec high_order__cells(const Elevator *v)
{
  CellVec cell = {0};
  for (size_t i = 0; i < v->m->nblock; i++) {
    const MeshBlock *b = &v->m->block[i];
    if (elem_dim(b->type) != 2) continue;
    int c = elem_corners(b->type);
    for (size_t k = 0; k < b->n; k++) {
      Cell x = {.corner = b->node + (size_t)c * k, .corners = c};
      for (int j = 0; j < c; j++) x.edge[j] = edge_table_find(&v->table, b->entity, x.corner[j], x.corner[(j + 1) % c]);
      vec_push(&cell, x);
    }
  }
  return cell;
}

bool high_order__bent(const Elevator *v, const Cell *c)
{
  for (int i = 0; i < c->corners; i++)
    if (v->bent[c->edge[i]]) return true;
  return false;
}

void high_order__nodes(const Elevator *v, const Cell *c, Vec3 *node, Vec3 *normal)
{
  Vec3 x[4];
  for (int i = 0; i < c->corners; i++) x[i] = mesh_xyz(v->m, c->corner[i]);
  *normal = corners_normal(x, c->corners);
  element_nodes(v, &v->basis[c->corners - 3], c->corner, c->edge, node);
}
