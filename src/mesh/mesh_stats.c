// mesh_stats.c - what the report says of a mesh: counts and sizes by group and entity, quality, worst elements
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_stats.h"

#include "base/map.h"
#include "geom/quality.h"
#include "mesh/mesh_measure.h"

#define DEGREES 57.295779513082321

enum { TANGENT_CELLS = 64 };

// ---- distributions ------------------------------------------------------------------------------------------------------------
// Part number t, of those from 0: below and above, and where t is no number, the first and the last.
static size_t part_of(double t, size_t parts)
{
  return t > 0 ? MIN((size_t)t, parts - 1) : 0;
}

static void spread_add(MeasureStats *s, double v)
{
  if (s->n == 0 || v < s->min) s->min = v;
  if (s->n == 0 || v > s->max) s->max = v;
  s->mean += v; // divided at the end
  s->n++;
  s->bin[part_of(v / s->range * STATS_BINS, STATS_BINS)]++;
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

// The k-th smallest of v[0..n), which lie in lo .. hi: from the part of 4096 that has it. v is left in another order.
static double kth_of_many(double *v, size_t n, size_t k, double lo, double hi)
{
  enum { PARTS = 4096 };
  if (n < 4 * PARTS) return kth(v, n, k);
  if (!(hi > lo)) return lo;
  uint32_t *count = mem_zalloc(PARTS * sizeof *count);
  double scale = PARTS / (hi - lo);
  for (size_t i = 0; i < n; i++) count[part_of((v[i] - lo) * scale, PARTS)]++;
  size_t part = 0, m = 0;
  for (; count[part] <= k; part++) k -= count[part];
  for (size_t i = 0; i < n; i++)
    if (part_of((v[i] - lo) * scale, PARTS) == part) v[m++] = v[i];
  free(count);
  return kth(v, m, k);
}

static void spread_finish(MeasureStats *s, DoubleVec *values)
{
  if (s->n) s->mean /= (double)s->n;
  if (values->len) s->p5 = kth_of_many(values->data, values->len, (size_t)(0.05 * (double)(values->len - 1)), s->min, s->max);
  vec_free(values);
}

// ---- elements -------------------------------------------------------------------------------------------------------------------
typedef struct {
  MeshStats *s;
  const Mesh *m;
  DoubleVec gamma, eta, jacobian;
  double smallest[2], largest[2]; // cosine and sine of the smallest and of the largest angle of a triangle so far, both times the same
  double edge2_min, edge2_max;    // squared lengths
  double edge[STATS_BINS];        // tangents where the bins of angles begin
  uint8_t cell[2 * TANGENT_CELLS]; // the bin that each piece of the tangents from 0 to 2 begins in
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

static void note_edge(Pass *p, double squared)
{
  if (squared < p->edge2_min) p->edge2_min = squared;
  if (squared > p->edge2_max) p->edge2_max = squared;
}

// Corners of some triangles and what follows from them, an array each, so that the compiler can measure several at a time.
enum { BATCH = 64 };
typedef struct {
  double x[3][BATCH], y[3][BATCH], z[3][BATCH];
  double nz[BATCH], off[BATCH];     // the area vector, doubled: along z, and what it has beside
  double area[BATCH], gamma[BATCH]; // the latter with the sign of the area against the face's normal
  double least[BATCH], most[BATCH]; // squared lengths of sides
  double sine[BATCH], cosine_least[BATCH], cosine_most[BATCH]; // of the smallest and of the largest angle, all times the same
} Triangles;

static void gather(Triangles *t, const Mesh *m, const MeshBlock *k, size_t first, size_t n)
{
  size_t nodes = (size_t)elem_nodes(k->type);
  const uint32_t *v = k->node + first * nodes;
  for (size_t i = 0; i < n; i++, v += nodes)
    for (int c = 0; c < 3; c++) {
      const double *x = m->xyz + 3 * (size_t)v[c];
      t->x[c][i] = x[0];
      t->y[c][i] = x[1];
      t->z[c][i] = x[2];
    }
}

static inline double square(double x, double y, double z) { return x * x + y * y + z * z; }

// The smallest angle is opposite to the shortest side; tan A = 4 area / (b^2 + c^2 - a^2).
static void measure(Triangles *t, Vec3 normal)
{
  for (size_t i = 0; i < BATCH; i++) {
    double ux = t->x[1][i] - t->x[0][i], uy = t->y[1][i] - t->y[0][i], uz = t->z[1][i] - t->z[0][i];
    double vx = t->x[2][i] - t->x[0][i], vy = t->y[2][i] - t->y[0][i], vz = t->z[2][i] - t->z[0][i];
    double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    t->nz[i] = nz;
    t->off[i] = fabs(nx) + fabs(ny);
    double a2 = square(t->x[2][i] - t->x[1][i], t->y[2][i] - t->y[1][i], t->z[2][i] - t->z[1][i]);
    double b2 = square(vx, vy, vz), c2 = square(ux, uy, uz), sum = a2 + b2 + c2;
    double a = sqrt(a2), b = sqrt(b2), c = sqrt(c2), n = sqrt(square(nx, ny, nz)), d = a * b * c * (a + b + c);
    double gamma = d > 0 ? 4 * n * n / d : 0;
    t->area[i] = 0.5 * n;
    t->gamma[i] = nx * normal.x + ny * normal.y + nz * normal.z < 0 ? -gamma : gamma;
    double low = b2 < c2 ? b2 : c2, high = b2 < c2 ? c2 : b2;
    low = a2 < low ? a2 : low;
    high = a2 > high ? a2 : high;
    t->least[i] = low;
    t->most[i] = high;
    t->sine[i] = 2 * n;
    t->cosine_least[i] = sum - 2 * low;
    t->cosine_most[i] = sum - 2 * high;
  }
}

// The angle's bin from its tangent, without the angle.
static void angle_add(Pass *p, double sine, double cosine)
{
  double tangent = sine / cosine;
  size_t bin = part_of(tangent * TANGENT_CELLS, 2 * TANGENT_CELLS); // tangents are below 2
  bin = p->cell[bin];
  while (bin + 1 < STATS_BINS && tangent >= p->edge[bin + 1]) bin++;
  p->s->angle.bin[bin]++;
  p->s->angle.n++;
  if (cosine * p->smallest[1] > p->smallest[0] * sine || p->s->angle.n == 1) {
    p->smallest[0] = cosine;
    p->smallest[1] = sine;
    p->s->angle.min = fmin(p->s->angle.min, atan2(sine, cosine) * DEGREES);
  }
}

static void add_triangle(Pass *p, const MeshBlock *k, size_t element, const Triangles *t, size_t i)
{
  MeshStats *s = p->s;
  angle_add(p, t->sine[i], t->cosine_least[i]);
  if (t->cosine_most[i] * p->largest[1] < p->largest[0] * t->sine[i] || s->triangles == 0) {
    p->largest[0] = t->cosine_most[i];
    p->largest[1] = t->sine[i];
    s->angle_max = fmax(s->angle_max, atan2(t->sine[i], t->cosine_most[i]) * DEGREES);
  }
  note_edge(p, t->least[i]);
  note_edge(p, t->most[i]);
  p->gamma.data[p->gamma.len++] = t->gamma[i];
  spread_add(&s->gamma, t->gamma[i]);
  note_worst(p, k, element, t->gamma[i]);
  s->triangles++;
}

// The area of the block's triangles. `level` is told the sum of their area vectors along z, or NAN if they have another direction too.
static double pass_triangles(Pass *p, const MeshBlock *k, Vec3 normal, double *level)
{
  Triangles t = {0};
  double area = 0, nz = 0, off = 0;
  vec_reserve(&p->gamma, p->gamma.len + k->n);
  for (size_t first = 0; first < k->n; first += BATCH) {
    size_t n = MIN(k->n - first, (size_t)BATCH);
    gather(&t, p->m, k, first, n);
    measure(&t, normal);
    for (size_t i = 0; i < n; i++) {
      add_triangle(p, k, first + i, &t, i);
      area += t.area[i];
      nz += t.nz[i];
      off += t.off[i];
    }
  }
  *level = off == 0 ? nz : NAN;
  return area;
}

// The same, without knowing the normal of their face. Most faces are level and seen from above: that is tried first, which spares a pass.
static double pass_face_of_triangles(Pass *p, const MeshBlock *k)
{
  MeshStats before = *p->s;
  Pass again = *p;
  const MeshBlock *end = p->m->block + p->m->nblock;
  bool alone = (k == p->m->block || k[-1].entity != k->entity) && (k + 1 == end || k[1].entity != k->entity);
  double level, area = pass_triangles(p, k, (Vec3){0, 0, 1}, &level);
  if (alone && level > 0) return area;
  again.gamma.data = p->gamma.data;
  again.gamma.cap = p->gamma.cap;
  *p = again;
  *p->s = before;
  return pass_triangles(p, k, mesh_area_vector(p->m, k->entity), &level);
}

static double pass_quad(Pass *p, const MeshBlock *k, size_t i, Vec3 normal)
{
  double least, most, area = mesh_size_of(p->m, k, i, normal);
  Vec3 x[4];
  mesh_corners(p->m, k, i, x);
  mesh_angle_range(p->m, k, i, &least, &most);
  double eta = fmax(0, 1 - fmax(most - 90, 90 - least) / 90);
  for (int c = 0; c < 4; c++) {
    Vec3 d = vec3_sub(x[(c + 1) % 4], x[c]);
    note_edge(p, vec3_dot(d, d));
  }
  double jacobian = mesh_scaled_jacobian(p->m, k, i);
  if (area < 0) eta = -eta;
  if (area < 0) jacobian = -fabs(jacobian);
  p->s->angle_max = fmax(p->s->angle_max, most);
  p->s->angle.min = fmin(p->s->angle.min, least);
  p->s->angle.bin[part_of(least / p->s->angle.range * STATS_BINS, STATS_BINS)]++;
  p->s->angle.n++;
  vec_push(&p->eta, eta);
  vec_push(&p->jacobian, jacobian);
  spread_add(&p->s->eta, eta);
  spread_add(&p->s->jacobian, jacobian);
  note_worst(p, k, i, eta);
  p->s->quads++;
  return fabs(area);
}

// Length or area of a block's elements; measures those of dimension 2.
static double pass_block(Pass *p, const MeshBlock *k)
{
  double size = 0;
  int dim = elem_dim(k->type);
  bool triangles = dim == 2 && elem_corners(k->type) == 3;
  if (triangles) size = pass_face_of_triangles(p, k);
  Vec3 normal = dim == 2 && !triangles ? mesh_area_vector(p->m, k->entity) : (Vec3){0, 0, 0};
  for (size_t i = 0; i < k->n && !triangles; i++)
    if (dim == 1)
      size += mesh_size_of(p->m, k, i, normal);
    else if (dim == 2)
      size += pass_quad(p, k, i, normal);
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
  // ln(1 + r) / r loses no digits through log1p; for small r the first terms of its series are as good.
  double mean = fabs(r) < 1e-4 ? 1 - r * (1. / 2 - r * (1. / 3 - r * (1. / 4))) : log1p(r) / r;
  return quality_tau_term(len / h0 * mean);
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
  for (size_t i = 0; i < k->n && !isnan(s->sum); i++) // where sizes are not known nothing is
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

static void pass_begin(Pass *p)
{
  p->edge2_min = INFINITY;
  for (int b = 0; b < STATS_BINS; b++) {
    double angle = p->s->angle.range * b / STATS_BINS;
    p->edge[b] = angle > 70 ? 2 : tan(angle / DEGREES); // no smallest angle of a triangle is above 60
  }
  for (int c = 0, b = 0; c < 2 * TANGENT_CELLS; c++) {
    while (b + 1 < STATS_BINS && (double)c / TANGENT_CELLS >= p->edge[b + 1]) b++;
    p->cell[c] = (uint8_t)b;
  }
}

void mesh_stats_make(MeshStats *s, const Mesh *m, const double *size)
{
  *s = (MeshStats){.nodes = m->nnode};
  Pass p = {.s = s, .m = m};
  s->gamma.range = s->eta.range = s->jacobian.range = 1;
  s->angle.range = mesh_count_corners(m, 4) ? 90 : 60;
  s->angle.min = 90;
  pass_begin(&p);
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
  s->edge_min = p.edge2_min <= p.edge2_max ? sqrt(p.edge2_min) : 0;
  s->edge_max = sqrt(p.edge2_max);
  if (!s->angle.n) s->angle.min = 0;
  spread_finish(&s->gamma, &p.gamma);
  spread_finish(&s->eta, &p.eta);
  spread_finish(&s->jacobian, &p.jacobian);
  sum_groups(s, m);
  pass_edges(s, m, size);
}

void mesh_stats_free(MeshStats *s)
{
  vec_free(&s->group);
  vec_free(&s->entity);
}
