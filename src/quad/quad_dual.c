// quad_dual.c - the dual graph of a mesh of triangles, with the costs of merging them
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/quad_dual.h"
#include "geom/hilbert.h"
#include "quad/quad_int.h"

// Costs: 1 - eta in units of 1/COST_UNIT, eta taken with its sign so that of two bad quads the less bad is preferred.
// Leaving two neighbouring boundary triangles costs more than any rearrangement of quads can save nearby.
enum { COST_UNIT = 1 << 14, COST_EXTRA = 1 << 20, COST_ODD = 1 << 21 };

static void dual_edge(QuadDual *d, uint32_t u, uint32_t v, int cost, uint32_t side)
{
  vec_push(&d->edge, u);
  vec_push(&d->edge, v);
  vec_push(&d->cost, cost);
  vec_push(&d->side, side);
}

static void number_triangles(const QuadMesh *m, QuadDual *d)
{
  size_t ne = quad_mesh_elements(m);
  double *centre = mem_alloc((2 * ne + 1) * sizeof *centre);
  uint32_t *order = mem_alloc((ne + 1) * sizeof *order);
  d->rank = mem_alloc((ne + 1) * sizeof *d->rank);
  for (size_t e = 0; e < ne; e++) {
    const uint32_t *v = &m->vertex.data[4 * e];
    Vec2 a = m->xy.data[v[0]], b = m->xy.data[v[1]], c = m->xy.data[v[2]];
    centre[2 * e] = (a.x + b.x + c.x) / 3;
    centre[2 * e + 1] = (a.y + b.y + c.y) / 3;
  }
  hilbert_order(centre, ne, order);
  for (size_t i = 0; i < ne; i++) d->rank[order[i]] = quad_mesh_is_quad(m, order[i]) ? NONE : d->n++;
  free(centre);
  free(order);
}

// Extra edges [book §5.2.4]: between triangles that follow each other along the locked sides round a vertex. Turning round the
// vertex from one locked side to the next, the first and the last triangle of the fan are joined.
static void extra_edges(const QuadMesh *m, const uint32_t *twin, const uint8_t *locked, QuadDual *d)
{
  for (uint32_t s = 0; s < m->vertex.len; s++) {
    uint32_t e = s / 4;
    if (quad_mesh_is_quad(m, e) || s % 4 == 3 || !locked[s]) continue;
    // From side s, which leaves the vertex, turn counterclockwise until the side that comes back to it is locked.
    uint32_t f = e, in = 4 * e + (s % 4 + 2) % 3, steps = 0;
    while (!locked[in] && !quad_mesh_is_quad(m, twin[in] / 4) && steps++ < m->vertex.len) {
      f = twin[in] / 4;
      in = 4 * f + (twin[in] % 4 + 2) % 3;
    }
    if (f != e && locked[in]) dual_edge(d, d->rank[e], d->rank[f], COST_EXTRA, NONE);
  }
}

static uint32_t find(uint32_t *set, uint32_t x)
{
  while (set[x] != x) x = set[x] = set[set[x]];
  return x;
}

// One more vertex for each part with an odd number of triangles, joined to its triangles on locked sides: the one matched
// with it is left over. Returns the number of such parts.
static uint32_t odd_parts(const QuadMesh *m, const uint8_t *locked, QuadDual *d)
{
  uint32_t n = d->n, odd = 0;
  uint32_t *set = mem_alloc(((size_t)n + 1) * sizeof *set), *dummy = mem_alloc(((size_t)n + 1) * sizeof *dummy);
  uint8_t *parity = mem_zalloc((size_t)n + 1);
  for (uint32_t v = 0; v < n; v++) set[v] = v;
  for (size_t k = 0; k < d->side.len; k++) set[find(set, d->edge.data[2 * k])] = find(set, d->edge.data[2 * k + 1]);
  for (uint32_t v = 0; v < n; v++) parity[find(set, v)] ^= 1;
  for (uint32_t v = 0; v < n; v++) dummy[v] = set[v] == v && parity[v] ? d->n + odd++ : NONE;
  for (size_t e = 0; odd && e < quad_mesh_elements(m); e++) {
    if (d->rank[e] == NONE) continue;
    uint32_t part = dummy[find(set, d->rank[e])];
    if (part != NONE && (locked[4 * e] || locked[4 * e + 1] || locked[4 * e + 2]))
      dual_edge(d, d->rank[e], part, COST_ODD, NONE);
  }
  d->n += odd;
  free(set);
  free(dummy);
  free(parity);
  return odd;
}

void quad_dual_init(QuadDual *d, const QuadMesh *m, const uint32_t *twin)
{
  uint8_t *locked = quad__locked_sides(m, twin);
  *d = (QuadDual){0};
  number_triangles(m, d);
  for (uint32_t s = 0; s < m->vertex.len; s++) {
    uint32_t t = twin[s], q[4];
    if (t == NONE || t < s || locked[s] || quad_mesh_is_quad(m, s / 4) || quad_mesh_is_quad(m, t / 4)) continue;
    quad__merged(m, s, t, q);
    dual_edge(d, d->rank[s / 4], d->rank[t / 4], (int)lround(COST_UNIT * (1 - quad__eta(m, q))), s);
  }
  d->odd_parts = odd_parts(m, locked, d);
  extra_edges(m, twin, locked, d);
  free(locked);
}

BlossomGraph quad_dual_graph(const QuadDual *d)
{
  return (BlossomGraph){d->n, (uint32_t)d->cost.len, d->edge.data, d->cost.data};
}

void quad_dual_free(QuadDual *d)
{
  vec_free(&d->edge);
  vec_free(&d->cost);
  vec_free(&d->side);
  free(d->rank);
}
