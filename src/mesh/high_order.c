// high_order.c - elements of order 2 to 4 with nodes on the curves, none of them folded
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/high_order.h"

#include "mesh/edge_table.h"
#include "mesh/jacobian.h"

// A curved mesh is its straight one and, for every edge, the displacements of its order-1 nodes from the straight places.
typedef struct {
  const Mesh *m;
  const HighOrder *how;
  EdgeTable table;
  int per_edge;
  Vec3 *shift;       // per_edge per edge, from a to b
  double *u;         // parameters of the same nodes, NAN where not on a curve
  bool *bent;        // per edge: has a displacement
  BezierBasis basis[2]; // of triangles and quadrangles
  Enriched e;
} Elevator;

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

// ---- surface elements, flat ---------------------------------------------------------------------------------------
typedef struct {
  const uint32_t *corner;
  uint32_t edge[4];
  int corners;
} Cell;
typedef Vec(Cell) CellVec;

static CellVec cells_of(const Elevator *v)
{
  CellVec cell = {0};
  for (size_t i = 0; i < v->m->nblock; i++) {
    const MeshBlock *b = &v->m->block[i];
    if (elem_dim(b->type) != 2) continue;
    int c = elem_corners(b->type);
    for (size_t k = 0; k < b->n; k++) {
      Cell x = {.corner = b->node + (size_t)c * k, .corners = c};
      for (int j = 0; j < c; j++) x.edge[j] = edge_table_find(&v->table, x.corner[j], x.corner[(j + 1) % c]);
      vec_push(&cell, x);
    }
  }
  return cell;
}

static bool cell_bent(const Elevator *v, const Cell *c)
{
  for (int i = 0; i < c->corners; i++)
    if (v->bent[c->edge[i]]) return true;
  return false;
}

static void cell_nodes(const Elevator *v, const Cell *c, Vec3 *node, Vec3 *normal)
{
  Vec3 x[4];
  for (int i = 0; i < c->corners; i++) x[i] = mesh_xyz(v->m, c->corner[i]);
  *normal = corners_normal(x, c->corners);
  element_nodes(v, &v->basis[c->corners - 3], c->corner, c->edge, node);
}

static bool cell_good(const Elevator *v, const Cell *c)
{
  if (!cell_bent(v, c)) return true; // as good as the straight one
  Vec3 node[ELEM_MAX_NODES], normal;
  cell_nodes(v, c, node, &normal);
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

// ---- repair ---------------------------------------------------------------------------------------------------
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

static bool on_curve(const Elevator *v, uint32_t e) { return v->m->entity[v->table.edge[e].entity].dim == 1; }

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
        if (!on_curve(v, e)) vec_push(&edges, e);
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
        if (on_curve(v, c->edge[k]) && !curves) continue;
        if (on_curve(v, c->edge[k]) && v->bent[c->edge[k]]) touched[c->edge[k]] = true;
        scale_edge(v, c->edge[k], flat ? 0 : on_curve(v, c->edge[k]) ? 0.75 : 0.5);
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

static void repair(Elevator *v, const CellVec *cell, HighOrderReport *report)
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

// ---- output ------------------------------------------------------------------------------------------------------
static void set_node(Mesh *m, uint32_t n, Vec3 p, double u)
{
  m->xyz[3 * (size_t)n] = p.x;
  m->xyz[3 * (size_t)n + 1] = p.y;
  m->xyz[3 * (size_t)n + 2] = p.z;
  m->node_u[n] = u;
}

static void place_edges(Elevator *v, const Model *model)
{
  for (uint32_t e = 0; e < v->table.n; e++) {
    const MeshEdge *edge = &v->table.edge[e];
    for (int k = 0; k < v->per_edge; k++) {
      size_t i = (size_t)v->per_edge * e + (size_t)k;
      double s = (k + 1) / (double)v->how->order, u;
      Vec3 p;
      if (on_curve(v, e) && v->u[i] >= 0) { // on the curve itself, not on a sum that rounds
        p = edge_table_point(&v->table, v->m, v->how->linear ? NULL : model, e, s, &u);
      } else {
        p = vec3_add(vec3_scale(1 - s, mesh_xyz(v->m, edge->a)), vec3_scale(s, mesh_xyz(v->m, edge->b)));
        p = vec3_add(p, v->shift[i]);
      }
      set_node(v->e.mesh, v->e.edge[e] + (uint32_t)k, p, v->u[i]);
    }
  }
}

static void write_lines(const Elevator *v, const MeshBlock *from, uint32_t *to)
{
  for (size_t k = 0; k < from->n; k++) {
    uint32_t a = from->node[2 * k], b = from->node[2 * k + 1];
    *to++ = v->e.node[a];
    *to++ = v->e.node[b];
    for (int i = 0; i < v->per_edge; i++) *to++ = enriched_at(&v->e, &v->table, v->per_edge, a, b, i);
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
      cell.edge[i] = edge_table_find(&v->table, cell.corner[i], cell.corner[(i + 1) % c]);
    }
    for (int i = 0; i < c; i++)
      for (int j = 0; j < v->per_edge; j++)
        *to++ = enriched_at(&v->e, &v->table, v->per_edge, cell.corner[i], cell.corner[(i + 1) % c], j);
    if (!inside) continue;
    Vec3 node[ELEM_MAX_NODES], normal;
    cell_nodes(v, &cell, node, &normal);
    for (int i = 0; i < inside; i++) {
      set_node(v->e.mesh, first[k] + (uint32_t)i, node[c * how.order + i], NAN);
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

static int none_inside(ElemType type, void *ctx)
{
  (void)type;
  (void)ctx;
  return 0;
}

// The corners alone: a mesh of order 1 without the nodes that only higher order needs.
static Mesh *corners_only(const Mesh *m)
{
  bool *used = mem_zalloc(m->nnode);
  Mesh straight = *m;
  straight.block = mem_alloc(m->nblock * sizeof *straight.block);
  for (size_t i = 0; i < m->nblock; i++) {
    const MeshBlock *b = &m->block[i];
    int dim = elem_dim(b->type), c = elem_corners(b->type), per = elem_nodes(b->type);
    ElemType type = dim < 1 ? ELEM_POINT : dim == 1 ? ELEM_LINE2 : c == 3 ? ELEM_TRI3 : ELEM_QUAD4;
    straight.block[i] = (MeshBlock){b->entity, type, b->n, mem_alloc((size_t)c * b->n * sizeof(uint32_t))};
    for (size_t k = 0; k < b->n; k++)
      for (int j = 0; j < c; j++) {
        uint32_t v = b->node[(size_t)per * k + (size_t)j];
        straight.block[i].node[(size_t)c * k + (size_t)j] = v;
        used[v] = true;
      }
  }
  // Squeeze out the others.
  Mesh *out = NULL;
  EdgeTable none = {0};
  Enriched e;
  U32Vec id = {0};
  straight.xyz = mem_alloc(3 * m->nnode * sizeof *straight.xyz);
  straight.node_entity = mem_alloc(m->nnode * sizeof *straight.node_entity);
  straight.node_u = mem_alloc(m->nnode * sizeof *straight.node_u);
  straight.nnode = 0;
  for (size_t n = 0; n < m->nnode; n++) {
    vec_push(&id, used[n] ? (uint32_t)straight.nnode : NONE);
    if (!used[n]) continue;
    size_t to = straight.nnode++;
    for (int k = 0; k < 3; k++) straight.xyz[3 * to + (size_t)k] = m->xyz[3 * n + (size_t)k];
    straight.node_entity[to] = m->node_entity[n];
    straight.node_u[to] = m->node_u[n];
  }
  for (size_t i = 0; i < m->nblock; i++)
    for (size_t k = 0; k < straight.block[i].n * (size_t)elem_nodes(straight.block[i].type); k++)
      straight.block[i].node[k] = id.data[straight.block[i].node[k]];
  straight.nperiodic = 0;
  enrich(&e, &straight, &none, 0, none_inside, NULL);
  out = e.mesh;
  for (size_t i = 0; i < m->nblock; i++) {
    const MeshBlock *b = &straight.block[i];
    uint32_t *to = enriched_block(&e, b->entity, b->type, b->n);
    for (size_t k = 0; k < b->n * (size_t)elem_nodes(b->type); k++) to[k] = e.node[b->node[k]];
  }
  for (size_t r = 0; r < m->nperiodic; r++) {
    const MeshPeriodic *old = &m->periodic[r];
    MeshPeriodic *p = mesh_add_periodic(out, old->dim, old->tag, old->master);
    p->has_affine = old->has_affine;
    for (int k = 0; k < 16; k++) p->affine[k] = old->affine[k];
    for (size_t i = 0; i < old->slave_node.len; i++) {
      uint32_t s = id.data[old->slave_node.data[i]], t = id.data[old->master_node.data[i]];
      if (s == NONE || t == NONE) continue;
      vec_push(&p->slave_node, e.node[s]);
      vec_push(&p->master_node, e.node[t]);
    }
  }
  enriched_free(&e, m);
  for (size_t i = 0; i < m->nblock; i++) free(straight.block[i].node);
  free(straight.block);
  free(straight.xyz);
  free(straight.node_entity);
  free(straight.node_u);
  free(used);
  vec_free(&id);
  return out;
}

static double certified_minimum(const Elevator *v, const CellVec *cell)
{
  double min = INFINITY;
  for (size_t i = 0; i < cell->len; i++) {
    Vec3 node[ELEM_MAX_NODES], normal;
    const Cell *c = &cell->data[i];
    if (c->corners == 3 && !cell_bent(v, c)) {
      min = fmin(min, 1);
      continue;
    }
    double lo, hi;
    cell_nodes(v, c, node, &normal);
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
  CellVec cell = cells_of(&v);
  repair(&v, &cell, report);
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
  Mesh *straight = corners_only(m);
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
