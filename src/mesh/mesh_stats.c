// mesh_stats.c - what the report says of a mesh: counts and sizes by group and entity, quality, worst elements
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_stats.h"

#include "geom/quality.h"
#include "mesh/mesh_edges.h"
#include "mesh/mesh_measure.h"

#define DEGREES 57.295779513082321

// ---- distributions ------------------------------------------------------------------------------------------------------------
static void spread_add(MeasureStats *s, double v)
{
  s->min = s->n ? fmin(s->min, v) : v;
  s->max = s->n ? fmax(s->max, v) : v;
  s->mean += v; // divided at the end
  s->n++;
  double t = v / s->range * STATS_BINS;
  s->bin[t > 0 ? MIN((size_t)t, (size_t)STATS_BINS - 1) : 0]++;
}

// The k-th smallest of v[0..n), by quickselect with the middle of three.
static double kth(double *v, size_t n, size_t k)
{
  size_t lo = 0, hi = n - 1;
  while (lo < hi) {
    double a = v[lo], b = v[(lo + hi) / 2], c = v[hi];
    double pivot = fmax(fmin(a, b), fmin(fmax(a, b), c));
    size_t i = lo, j = hi;
    for (;;) {
      while (v[i] < pivot) i++;
      while (v[j] > pivot) j--;
      if (i >= j) break;
      double t = v[i];
      v[i++] = v[j];
      v[j--] = t;
    }
    if (k <= j)
      hi = j;
    else
      lo = j + 1;
  }
  return v[k];
}

static void spread_finish(MeasureStats *s, DoubleVec *values)
{
  if (s->n) s->mean /= (double)s->n;
  if (values->len) s->p5 = kth(values->data, values->len, (size_t)(0.05 * (double)(values->len - 1)));
  vec_free(values);
}

// ---- elements -------------------------------------------------------------------------------------------------------------------
typedef struct {
  MeshStats *s;
  const Mesh *m;
  DoubleVec gamma, eta, angle;
  uint64_t number; // of the element at hand
} Pass;

static void note_worst(Pass *p, const MeshBlock *k, size_t i, double value)
{
  MeshStats *s = p->s;
  if (s->nworst == STATS_WORST && !(value < s->worst[STATS_WORST - 1].value)) return;
  size_t at = s->nworst < STATS_WORST ? s->nworst++ : STATS_WORST - 1;
  for (; at > 0 && s->worst[at - 1].value > value; at--) s->worst[at] = s->worst[at - 1];
  s->worst[at] = (WorstElement){value, k->type, p->m->entity[k->entity].tag, p->number + i + 1, mesh_center(p->m, k, i)};
}

static void note_edge(MeshStats *s, double length)
{
  s->edge_min = fmin(s->edge_min, length);
  s->edge_max = fmax(s->edge_max, length);
}

// Area of the element.
static double pass_triangle(Pass *p, const MeshBlock *k, size_t i, Vec3 normal)
{
  Vec3 x[4];
  mesh_corners(p->m, k, i, x);
  TriShape t = shape_space(x[0], x[1], x[2], normal);
  double gamma = quality_gamma(t);
  double a2 = t.a * t.a, b2 = t.b * t.b, c2 = t.c * t.c, sum = a2 + b2 + c2;
  double least = fmin(a2, fmin(b2, c2)), most = fmax(a2, fmax(b2, c2)), sine = 4 * fabs(t.area);
  double angle = atan2(sine, sum - 2 * least) * DEGREES; // opposite to the shortest side
  p->s->angle_max = fmax(p->s->angle_max, atan2(sine, sum - 2 * most) * DEGREES);
  note_edge(p->s, sqrt(least));
  note_edge(p->s, sqrt(most));
  vec_push(&p->gamma, gamma);
  vec_push(&p->angle, angle);
  spread_add(&p->s->gamma, gamma);
  spread_add(&p->s->angle, angle);
  note_worst(p, k, i, gamma);
  p->s->triangles++;
  return fabs(t.area);
}

static double pass_quad(Pass *p, const MeshBlock *k, size_t i, Vec3 normal)
{
  double least, most, eta = mesh_measure(p->m, k, i, MEASURE_ETA), area = mesh_size_of(p->m, k, i, normal);
  Vec3 x[4];
  mesh_corners(p->m, k, i, x);
  mesh_angle_range(p->m, k, i, &least, &most);
  for (int c = 0; c < 4; c++) note_edge(p->s, vec3_distance(x[c], x[(c + 1) % 4]));
  if (area < 0) eta = -eta;
  p->s->angle_max = fmax(p->s->angle_max, most);
  vec_push(&p->eta, eta);
  vec_push(&p->angle, least);
  spread_add(&p->s->eta, eta);
  spread_add(&p->s->angle, least);
  note_worst(p, k, i, eta);
  p->s->quads++;
  return fabs(area);
}

// Length or area of a block's elements; measures those of dimension 2.
static double pass_block(Pass *p, const MeshBlock *k)
{
  double size = 0;
  int dim = elem_dim(k->type);
  Vec3 normal = dim == 2 ? mesh_area_vector(p->m, k->entity) : (Vec3){0, 0, 0};
  for (size_t i = 0; i < k->n; i++)
    if (dim == 1)
      size += mesh_size_of(p->m, k, i, normal);
    else if (dim == 2)
      size += elem_corners(k->type) == 3 ? pass_triangle(p, k, i, normal) : pass_quad(p, k, i, normal);
  p->s->order = MAX(p->s->order, elem_order(k->type));
  if (dim == 0) p->s->points += k->n;
  if (dim == 1) p->s->lines += k->n;
  if (dim == 1) p->s->length += size;
  if (dim == 2) p->s->area += size;
  p->number += k->n;
  return size;
}

// ---- groups ------------------------------------------------------------------------------------------------------------------------
static bool in_group(const MeshEntity *e, const MeshGroup *g)
{
  for (size_t i = 0; e->dim == g->dim && i < e->physical.len; i++)
    if (abs(e->physical.data[i]) == g->tag) return true;
  return false;
}

static void sum_groups(MeshStats *s, const Mesh *m)
{
  for (size_t g = 0; g < m->ngroup; g++) {
    PartStats part = {.dim = m->group[g].dim, .tag = m->group[g].tag, .name = m->group[g].name};
    for (size_t i = 0; i < s->entity.len; i++) {
      const PartStats *e = &s->entity.data[i];
      if (e->dim != part.dim || !in_group(&m->entity[mesh_find_entity(m, e->dim, e->tag)], &m->group[g])) continue;
      part.elements += e->elements;
      part.size += e->size;
      part.entities++;
    }
    vec_push(&s->group, part);
  }
}

// ---- edges --------------------------------------------------------------------------------------------------------------------------
static double tau_of_edge(const Mesh *m, const double *size, uint32_t a, uint32_t b)
{
  double h0 = size[a], h1 = size[b], len = vec3_distance(mesh_xyz(m, a), mesh_xyz(m, b)), r = h1 / h0 - 1;
  // ln(1 + r) / r loses no digits through log1p; its limit at 0 is 1.
  return quality_tau_term(len / h0 * (r == 0 ? 1 : log1p(r) / r));
}

static void pass_edges(MeshStats *s, const Mesh *m, const double *size)
{
  MeshEdges e;
  mesh_edges_make(&e, m);
  uint8_t *degree = mem_zalloc(m->nnode), *boundary = mem_zalloc(m->nnode), *quad = mem_zalloc(m->nnode);
  double sum = 0;
  size_t n = 0;
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    size_t corners = (size_t)elem_corners(k->type), nodes = (size_t)elem_nodes(k->type), h = e.base[b];
    bool surface = elem_dim(k->type) == 2;
    for (size_t i = 0; surface && i < k->n; i++)
      for (size_t c = 0; c < corners; c++, h++) {
        uint32_t p = k->node[i * nodes + c], q = k->node[i * nodes + (c + 1) % corners], twin = e.twin[h];
        if (degree[p] < 255) degree[p]++;
        if (corners == 4) quad[p]++;
        if (twin >= EDGE_BAD) boundary[p] = boundary[q] = 1;
        if (size && (twin == EDGE_BAD || twin == NONE || h < twin)) {
          sum += tau_of_edge(m, size, p, q);
          n++;
        }
      }
  }
  for (size_t i = 0; i < m->nnode; i++)
    if (degree[i] && !boundary[i]) {
      s->interior++;
      // Between triangles and quadrangles both angles count: six triangles, four quadrangles, or three and two.
      int turn = 2 * (degree[i] - quad[i]) + 3 * quad[i];
      s->irregular += turn != 12;
    }
  s->tau = size && n ? exp(sum / (double)n) : NAN;
  free(degree);
  free(boundary);
  free(quad);
  mesh_edges_free(&e);
}

void mesh_stats_make(MeshStats *s, const Mesh *m, const double *size)
{
  *s = (MeshStats){.nodes = m->nnode, .edge_min = INFINITY};
  Pass p = {.s = s, .m = m};
  size_t quads = 0;
  for (size_t b = 0; b < m->nblock; b++) quads += elem_corners(m->block[b].type) == 4 ? m->block[b].n : 0;
  s->gamma.range = s->eta.range = 1;
  s->angle.range = quads ? 90 : 60;
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    const MeshEntity *e = &m->entity[k->entity];
    double part = pass_block(&p, k);
    if (!s->entity.len || vec_last(&s->entity).dim != e->dim || vec_last(&s->entity).tag != e->tag)
      vec_push(&s->entity, ((PartStats){.dim = e->dim, .tag = e->tag, .entities = 1}));
    vec_last(&s->entity).elements += k->n;
    vec_last(&s->entity).size += part;
  }
  Box3 box = box3_empty();
  for (size_t i = 0; i < m->nnode; i++) box = box3_with(box, mesh_xyz(m, (uint32_t)i));
  s->lo = box.lo;
  s->hi = box.hi;
  if (!(s->edge_min <= s->edge_max)) s->edge_min = 0;
  spread_finish(&s->gamma, &p.gamma);
  spread_finish(&s->eta, &p.eta);
  spread_finish(&s->angle, &p.angle);
  sum_groups(s, m);
  pass_edges(s, m, size);
}

void mesh_stats_free(MeshStats *s)
{
  vec_free(&s->group);
  vec_free(&s->entity);
}
