// quad_check.c - audit of quad meshes, and what a report says of them
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "geom/predicates.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

static const double *point(const QuadMesh *m, uint32_t v) { return &m->xy.data[v].x; }

static QuadVerdict check_element(const QuadMesh *m, size_t e)
{
  uint32_t n = quad_mesh_corners(m, e);
  const uint32_t *v = &m->vertex.data[4 * e];
  for (uint32_t i = 0; i < n; i++) {
    if (v[i] >= m->xy.len) return QUAD_BAD_INDEX;
    for (uint32_t j = 0; j < i; j++)
      if (v[i] == v[j]) return QUAD_BAD_INDEX;
  }
  for (uint32_t i = 0; i < n; i++)
    if (orient2d(point(m, v[i]), point(m, v[(i + 1) % n]), point(m, v[(i + 2) % n])) <= 0) return QUAD_INVERTED;
  return QUAD_GOOD;
}

typedef struct {
  uint64_t edge;
  uint32_t side;
} Side;

static int compare_sides(const void *a, const void *b)
{
  const Side *p = a, *q = b;
  if (p->edge != q->edge) return p->edge < q->edge ? -1 : 1;
  return p->side < q->side ? -1 : p->side > q->side;
}

// All sides with their edge, sorted.
static Side *sorted_sides(const QuadMesh *m, size_t *n)
{
  Vec(Side) side = {0};
  vec_reserve(&side, m->vertex.len);
  for (uint32_t s = 0; s < m->vertex.len; s++) {
    uint32_t e = s / 4, c = quad_mesh_corners(m, e);
    if (s % 4 >= c) continue;
    vec_push(&side, ((Side){map_pair(m->vertex.data[s], m->vertex.data[4 * e + (s % 4 + 1) % c]), s}));
  }
  if (side.len) qsort(side.data, side.len, sizeof *side.data, compare_sides);
  *n = side.len;
  return side.data;
}

static QuadVerdict check_edges(const QuadMesh *m, uint32_t *where)
{
  size_t n;
  Side *side = sorted_sides(m, &n);
  QuadVerdict verdict = QUAD_GOOD;
  for (size_t i = 0; i + 1 < n; i++) {
    if (side[i].edge != side[i + 1].edge) continue;
    bool same_way = m->vertex.data[side[i].side] == m->vertex.data[side[i + 1].side];
    if (same_way || (i + 2 < n && side[i + 2].edge == side[i].edge)) {
      *where = side[i].side / 4;
      verdict = QUAD_BAD_EDGE;
      break;
    }
  }
  free(side);
  return verdict;
}

QuadVerdict quad_check(const QuadMesh *m, uint32_t *where)
{
  uint32_t ignored;
  if (!where) where = &ignored;
  for (size_t e = 0; e < quad_mesh_elements(m); e++) {
    QuadVerdict v = check_element(m, e);
    *where = (uint32_t)e;
    if (v != QUAD_GOOD) return v;
  }
  QuadVerdict verdict = check_edges(m, where);
  if (verdict != QUAD_GOOD) return verdict;
  QuadQuality q = quad_measure(m);
  *where = NONE;
  return q.triangles == 0 && q.index_sum4 != 4 * q.euler ? QUAD_BAD_INDEX_SUM : QUAD_GOOD;
}

const char *quad_verdict_text(QuadVerdict v)
{
  switch (v) {
  case QUAD_GOOD: return "good";
  case QUAD_BAD_INDEX: return "an element has a corner twice or one that does not exist";
  case QUAD_BAD_EDGE: return "an edge has more than two elements or two of opposite orientation";
  case QUAD_INVERTED: return "an element is inverted or not convex";
  case QUAD_BAD_INDEX_SUM: return "the indices of the vertices do not add up to the Euler characteristic";
  }
  UNREACHABLE();
}

static int compare_doubles(const void *a, const void *b)
{
  double p = *(const double *)a, q = *(const double *)b;
  return (p > q) - (p < q);
}

static void measure_shapes(const QuadMesh *m, QuadQuality *q)
{
  double *eta = mem_alloc((q->quads + 1) * sizeof *eta), sum = 0;
  size_t n = 0;
  q->eta_min = q->eta_mean = q->eta_p5 = q->jacobian_min = 1;
  for (size_t e = 0; e < quad_mesh_elements(m); e++) {
    if (!quad_mesh_is_quad(m, e)) continue;
    const uint32_t *v = &m->vertex.data[4 * e];
    const Vec2 *p = m->xy.data;
    eta[n] = fmax(quad__eta(m, v), 0);
    q->jacobian_min = fmin(q->jacobian_min, quad_scaled_jacobian(p[v[0]], p[v[1]], p[v[2]], p[v[3]]));
    if (n == 0 || eta[n] < q->eta_min) q->worst = (uint32_t)e, q->eta_min = eta[n];
    sum += eta[n++];
  }
  if (n) {
    qsort(eta, n, sizeof *eta, compare_doubles);
    q->eta_mean = sum / (double)n;
    q->eta_p5 = eta[n / 20];
  }
  free(eta);
}

// The regular valence is 4 inside and 2 on the boundary [book §5.1.4], that is 4 less the number of boundary edges: so the
// sum holds even where the boundary passes through a vertex several times.
static void measure_vertices(const QuadMesh *m, QuadQuality *q)
{
  size_t nv = m->xy.len, nside;
  uint32_t *valence = mem_zalloc((nv + 1) * sizeof *valence), *ends = mem_zalloc((nv + 1) * sizeof *ends);
  Side *side = sorted_sides(m, &nside);
  for (size_t s = 0; s < m->vertex.len; s++)
    if (m->vertex.data[s] != NONE) valence[m->vertex.data[s]]++;
  for (size_t i = 0; i < nside; i++) {
    bool pair = i + 1 < nside && side[i].edge == side[i + 1].edge;
    if (!pair) {
      ends[(uint32_t)side[i].edge]++;
      ends[side[i].edge >> 32]++;
    }
    i += pair;
    q->edges++;
  }
  for (size_t v = 0; v < nv; v++) {
    if (valence[v] == 0) continue;
    q->vertices++;
    q->boundary_vertices += ends[v] > 0;
    q->interior += ends[v] == 0;
    q->valence[ends[v] > 0][MIN(valence[v], 7u)]++;
    q->irregular += ends[v] == 0 && valence[v] != 4;
    q->index_sum4 += ends[v] == 0 ? 4 - (long)valence[v] : 4 - (long)ends[v] - (long)valence[v];
  }
  free(valence);
  free(ends);
  free(side);
}

QuadQuality quad_measure(const QuadMesh *m)
{
  QuadQuality q = {.worst = NONE};
  q.triangles = quad_mesh_triangles(m);
  q.quads = quad_mesh_elements(m) - q.triangles;
  measure_vertices(m, &q);
  measure_shapes(m, &q);
  q.euler = (long)q.vertices - (long)q.edges + (long)(q.quads + q.triangles);
  return q;
}
