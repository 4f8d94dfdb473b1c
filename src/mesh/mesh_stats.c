// mesh_stats.c - what the report says of a mesh: counts and sizes by group and entity, quality, worst elements
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_stats.h"

#include "base/map.h"
#include "geom/quality.h"
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
  DoubleVec gamma, eta, jacobian, angle;
  double largest[2]; // cosine and sine of the largest angle of a triangle so far, both times the same
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
  double cosine = sum - 2 * most; // of the largest angle, in the same unit as its sine
  if (cosine * p->largest[1] < p->largest[0] * sine || p->s->triangles == 0) {
    p->largest[0] = cosine;
    p->largest[1] = sine;
    p->s->angle_max = fmax(p->s->angle_max, atan2(sine, cosine) * DEGREES);
  }
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
  double jacobian = mesh_scaled_jacobian(p->m, k, i);
  if (area < 0) eta = -eta;
  if (area < 0) jacobian = -fabs(jacobian);
  p->s->angle_max = fmax(p->s->angle_max, most);
  vec_push(&p->eta, eta);
  vec_push(&p->jacobian, jacobian);
  vec_push(&p->angle, least);
  spread_add(&p->s->eta, eta);
  spread_add(&p->s->jacobian, jacobian);
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
    if (m->group[g].dim > 2) continue; // of volumes, which have no mesh
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

// What each node sees of the elements around it.
typedef struct {
  uint8_t *degree, *quad; // elements, and quadrangles among them
  uint64_t *open;         // 0 if the edges that leave it and those that arrive are the same, face by face: then it is inside a face
} Around;

// A sum of these over edges that leave, less one over those that arrive, vanishes if they are the same (or else by a chance of 2^-64).
static uint64_t edge_mark(uint32_t node, uint32_t face)
{
  uint64_t z = (node + ((uint64_t)face << 32)) * 0x9e3779b97f4a7c15u;
  return (z ^ z >> 31) * 0xbf58476d1ce4e5b9u;
}

static void look_around(const Mesh *m, Around *a)
{
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (elem_dim(k->type) != 2) continue;
    size_t corners = (size_t)elem_corners(k->type), nodes = (size_t)elem_nodes(k->type);
    for (size_t i = 0; i < k->n; i++) {
      const uint32_t *v = k->node + i * nodes;
      uint64_t mark[4];
      for (size_t c = 0; c < corners; c++) mark[c] = edge_mark(v[c], k->entity);
      for (size_t c = 0; c < corners; c++) {
        uint32_t p = v[c];
        if (a->degree[p] < 255) a->degree[p]++;
        if (corners == 4) a->quad[p]++;
        a->open[p] += mark[c + 1 == corners ? 0 : c + 1] - mark[c ? c - 1 : corners - 1];
      }
    }
  }
}

// Every edge of every face once: an edge inside it is run both ways, and counts where it runs upwards; one that runs downwards counts
// if nothing runs it upwards, which is only to be asked where both its ends are on the boundary.
typedef struct {
  const Mesh *m;
  const double *size;
  const Around *around;
  Map up;        // edges of the face at hand between nodes of its boundary that are run upwards
  U32Vec down;   // pairs: those run downwards
  double sum;
  size_t n;
} EdgeSum;

static void add_edge(EdgeSum *s, uint32_t p, uint32_t q)
{
  s->sum += tau_of_edge(s->m, s->size, p, q);
  s->n++;
}

static void sum_block(EdgeSum *s, const MeshBlock *k)
{
  size_t corners = (size_t)elem_corners(k->type), nodes = (size_t)elem_nodes(k->type);
  for (size_t i = 0; i < k->n; i++)
    for (size_t c = 0; c < corners; c++) {
      uint32_t p = k->node[i * nodes + c], q = k->node[i * nodes + (c + 1 == corners ? 0 : c + 1)];
      bool rim = s->around->open[p] && s->around->open[q];
      if (p < q) {
        add_edge(s, p, q);
        if (rim) map_set(&s->up, map_pair(p, q), 1);
      } else if (rim) {
        vec_push(&s->down, p);
        vec_push(&s->down, q);
      }
    }
}

static double efficiency(const Mesh *m, const double *size, const Around *around)
{
  EdgeSum s = {.m = m, .size = size, .around = around};
  for (size_t b = 0; b < m->nblock; b++) {
    if (elem_dim(m->block[b].type) == 2) sum_block(&s, &m->block[b]);
    if (b + 1 < m->nblock && m->block[b + 1].entity == m->block[b].entity) continue; // the same face goes on
    for (size_t i = 0; i < s.down.len; i += 2)
      if (map_get(&s.up, map_pair(s.down.data[i], s.down.data[i + 1])) == NONE) add_edge(&s, s.down.data[i], s.down.data[i + 1]);
    vec_clear(&s.down);
    map_free(&s.up);
  }
  vec_free(&s.down);
  map_free(&s.up);
  return s.n ? exp(s.sum / (double)s.n) : NAN;
}

static void pass_edges(MeshStats *s, const Mesh *m, const double *size)
{
  Around a = {mem_zalloc(m->nnode + 1), mem_zalloc(m->nnode + 1), mem_zalloc((m->nnode + 1) * sizeof *a.open)};
  look_around(m, &a);
  for (size_t i = 0; i < m->nnode; i++)
    if (a.degree[i] && !a.open[i]) {
      s->interior++;
      // Between triangles and quadrangles both angles count: six triangles, four quadrangles, or three and two.
      int turn = 2 * (a.degree[i] - a.quad[i]) + 3 * a.quad[i];
      s->irregular += turn != 12;
    }
  s->tau = size ? efficiency(m, size, &a) : NAN;
  free(a.degree);
  free(a.quad);
  free(a.open);
}

void mesh_stats_make(MeshStats *s, const Mesh *m, const double *size)
{
  *s = (MeshStats){.nodes = m->nnode, .edge_min = INFINITY};
  Pass p = {.s = s, .m = m};
  size_t quads = 0;
  for (size_t b = 0; b < m->nblock; b++) quads += elem_corners(m->block[b].type) == 4 ? m->block[b].n : 0;
  s->gamma.range = s->eta.range = s->jacobian.range = 1;
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
  spread_finish(&s->jacobian, &p.jacobian);
  spread_finish(&s->angle, &p.angle);
  sum_groups(s, m);
  pass_edges(s, m, size);
}

void mesh_stats_free(MeshStats *s)
{
  vec_free(&s->group);
  vec_free(&s->entity);
}
