// cross_field.c - crosses by diffusion and normalization in turns, on linear finite elements
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "quad/cross_field.h"

#include <math.h>
#include <string.h>

#include "base/map.h"
#include "base/mem.h"

// The field minimizes the Dirichlet energy among vectors of length one, as far as that is possible: diffuse for a time, make the
// length one again, and so on with shorter and shorter times [Viertel19]. A harmonic field alone will not do: in a disc it is z^4,
// with one singularity of index one in the middle, where four of 1/4 that keep their distance have less energy.
#define FIRST_TIME 0.03 // of the area
#define TIME_RATIO 0.7
enum { STEPS = 12, MAX_ITERATIONS = 2000 };
#define TOLERANCE 1e-4 // of the residual, against that of a start from zero

static const double PI = 3.14159265358979323846;

struct CrossField {
  size_t nv, ntri;
  double *xy;          // 2 nv
  double *u;           // 2 nv: cos 4a, sin 4a
  uint32_t *tri, *twin; // 3 ntri; twin NONE on the boundary
  uint32_t *at;        // nv
  uint8_t *fixed;      // nv
  Vec(CrossSingularity) singularity;
  long boundary4, euler;
};

// ---- the mesh

static void find_twins(CrossField *f)
{
  Map side = {0};
  size_t edges = 0, used = 0;
  f->twin = mem_alloc((3 * f->ntri + 1) * sizeof *f->twin);
  for (uint32_t e = 0; e < 3 * f->ntri; e++) {
    uint32_t a = f->tri[e], b = f->tri[e % 3 == 2 ? e - 2 : e + 1];
    bool first;
    uint32_t *other = map_slot(&side, map_pair(a, b), e, &first);
    f->twin[e] = first ? NONE : *other;
    if (!first) f->twin[*other] = e;
    edges += first;
    if (f->at[a] == NONE) f->at[a] = e / 3, used++;
  }
  map_free(&side);
  f->euler = (long)used - (long)edges + (long)f->ntri;
}

static Vec2 point(const CrossField *f, uint32_t v) { return (Vec2){f->xy[2 * (size_t)v], f->xy[2 * (size_t)v + 1]}; }

// ---- alignment

// Sum of the crosses of the sides at each vertex.
static void add_side(CrossField *f, uint32_t a, uint32_t b)
{
  Vec2 d = vec2_sub(point(f, b), point(f, a));
  double angle = 4 * atan2(d.y, d.x), c = cos(angle), s = sin(angle);
  uint32_t v[2] = {a, b};
  for (int i = 0; i < 2; i++) {
    f->u[2 * (size_t)v[i]] += c, f->u[2 * (size_t)v[i] + 1] += s;
    f->fixed[v[i]] = 1;
  }
}

// The right angles by which the boundary turns, over all its vertices: what its mean crosses do not follow.
static long turns(const CrossField *f)
{
  long sum = 0;
  double *angle = mem_zalloc((f->nv + 1) * sizeof *angle); // inside the mesh at each boundary vertex
  uint8_t *fans = mem_zalloc(f->nv + 1);                   // parts of the mesh that meet there
  for (uint32_t e = 0; e < 3 * f->ntri; e++) {
    uint32_t t = e - e % 3;
    Vec2 p = point(f, f->tri[e]), a = vec2_sub(point(f, f->tri[t + (e + 1) % 3]), p), b = vec2_sub(point(f, f->tri[t + (e + 2) % 3]), p);
    angle[f->tri[e]] += atan2(vec2_cross(a, b), vec2_dot(a, b));
    fans[f->tri[e]] = (uint8_t)(fans[f->tri[e]] + (f->twin[e] == NONE));
  }
  for (size_t v = 0; v < f->nv; v++)
    if (fans[v]) sum += lround((fans[v] * PI - angle[v]) / (PI / 2));
  free(angle);
  free(fans);
  return sum;
}

static void align(CrossField *f, const uint32_t *aligned, size_t naligned)
{
  for (uint32_t e = 0; e < 3 * f->ntri; e++)
    if (f->twin[e] == NONE) add_side(f, f->tri[e], f->tri[e % 3 == 2 ? e - 2 : e + 1]);
  for (size_t i = 0; i < naligned; i++) add_side(f, aligned[2 * i], aligned[2 * i + 1]);
  for (size_t v = 0; v < f->nv; v++) {
    double *u = f->u + 2 * v, len = sqrt(u[0] * u[0] + u[1] * u[1]);
    if (f->at[v] == NONE) f->fixed[v] = 1;
    if (!f->fixed[v]) continue;
    // Sides that cancel each other say nothing: the cross is free there.
    f->fixed[v] = len > 0.1 || f->at[v] == NONE;
    double scale = len > 0.1 ? 1 / len : 0;
    u[0] *= scale, u[1] *= scale;
  }
}

// ---- linear elements: mass + time * stiffness, by rows of free vertices

typedef struct {
  CrossField *f;
  uint32_t *start, *column; // rows: the neighbours of each vertex
  double *weight;           // of each neighbour: cotangents
  double *turn;             // of each neighbour: cosine and sine of four times what the cross turns on the way from there
  double *diagonal, *mass;  // by vertex
  double *r, *z, *p, *q, *b; // 2 nv each
  double time, share;       // the matrix is share * mass + time * stiffness
} System;

static double cotangent(Vec2 at, Vec2 a, Vec2 b)
{
  Vec2 u = vec2_sub(a, at), w = vec2_sub(b, at);
  double c = vec2_cross(u, w), d = vec2_dot(u, w);
  return c > 1e-12 * fabs(d) ? d / c : 0; // a flat triangle has no say
}

// d(log h)/dn times the length of half-edge e, n to its left, from the triangle there.
static double slope_across(const CrossField *f, uint32_t e, const double *log_size)
{
  uint32_t t = e - e % 3, va = f->tri[e], vb = f->tri[t + (e + 1) % 3], vc = f->tri[t + (e + 2) % 3];
  Vec2 a = point(f, va), ab = vec2_sub(point(f, vb), a), ac = vec2_sub(point(f, vc), a);
  double area = vec2_cross(ab, ac), l2 = vec2_dot(ab, ab), x = vec2_dot(ab, ac) / l2;
  return area > 0 ? (log_size[vc] - log_size[va] - x * (log_size[vb] - log_size[va])) * l2 / area : 0;
}

// What a cross turns by along half-edge e if the quads are to have the sizes as well as right angles: a conformal map with
// derivative h exp(i a) has da/dt = -d(log h)/dn.
static double turn_along(const CrossField *f, uint32_t e, const double *log_size)
{
  double left = slope_across(f, e, log_size);
  return f->twin[e] == NONE ? -left : -0.5 * (left - slope_across(f, f->twin[e], log_size));
}

static void entry(System *s, uint32_t k, uint32_t column, double weight, double turn)
{
  s->column[k] = column;
  s->weight[k] = weight;
  s->turn[2 * k] = cos(turn), s->turn[2 * k + 1] = sin(turn);
}

static void assemble(System *s, const double *log_size)
{
  CrossField *f = s->f;
  size_t n = f->nv;
  s->start = mem_zalloc((n + 2) * sizeof *s->start);
  s->diagonal = mem_zalloc((n + 1) * sizeof *s->diagonal);
  s->mass = mem_zalloc((n + 1) * sizeof *s->mass);
  uint32_t *fill = mem_zalloc((n + 1) * sizeof *fill);
  for (uint32_t e = 0; e < 3 * f->ntri; e++) {
    uint32_t a = f->tri[e], b = f->tri[e % 3 == 2 ? e - 2 : e + 1];
    if (f->twin[e] == NONE || f->twin[e] > e) s->start[a + 1]++, s->start[b + 1]++;
  }
  for (size_t v = 0; v < n; v++) s->start[v + 1] += s->start[v];
  s->column = mem_alloc((s->start[n] + 1) * sizeof *s->column);
  s->weight = mem_alloc((s->start[n] + 1) * sizeof *s->weight);
  s->turn = mem_alloc((2 * (size_t)s->start[n] + 1) * sizeof *s->turn);
  for (uint32_t e = 0; e < 3 * f->ntri; e++) {
    uint32_t t = e - e % 3, a = f->tri[e], b = f->tri[t + (e + 1) % 3], c = f->tri[t + (e + 2) % 3], o = f->twin[e];
    Vec2 pa = point(f, a), pb = point(f, b), pc = point(f, c);
    s->mass[a] += fabs(vec2_cross(vec2_sub(pb, pa), vec2_sub(pc, pa))) / 6;
    if (o != NONE && o < e) continue;
    double w = 0.5 * cotangent(pc, pa, pb);
    if (o != NONE) w += 0.5 * cotangent(point(f, f->tri[o - o % 3 + (o + 2) % 3]), pb, pa);
    w = fmax(w, 0); // keeps the maximum principle where the mesh is not Delaunay
    s->diagonal[a] += w, s->diagonal[b] += w;
    double turn = log_size ? 4 * turn_along(f, e, log_size) : 0;
    entry(s, s->start[a] + fill[a]++, b, w, -turn);
    entry(s, s->start[b] + fill[b]++, a, w, turn);
  }
  free(fill);
  s->r = mem_zalloc((2 * n + 1) * sizeof *s->r), s->z = mem_zalloc((2 * n + 1) * sizeof *s->z);
  s->p = mem_zalloc((2 * n + 1) * sizeof *s->p), s->q = mem_zalloc((2 * n + 1) * sizeof *s->q);
  s->b = mem_zalloc((2 * n + 1) * sizeof *s->b);
}

static void system_free(System *s)
{
  free(s->start), free(s->column), free(s->weight), free(s->turn), free(s->diagonal), free(s->mass);
  free(s->r), free(s->z), free(s->p), free(s->q), free(s->b);
}

// y = A x in the rows of free vertices.
static void multiply(const System *s, const double *x, double *y)
{
  for (size_t v = 0; v < s->f->nv; v++) {
    if (s->f->fixed[v]) continue;
    double d = s->share * s->mass[v] + s->time * s->diagonal[v], y0 = d * x[2 * v], y1 = d * x[2 * v + 1];
    for (uint32_t k = s->start[v]; k < s->start[v + 1]; k++) {
      double w = s->time * s->weight[k];
      const double *o = x + 2 * (size_t)s->column[k], *r = s->turn + 2 * (size_t)k;
      y0 -= w * (r[0] * o[0] - r[1] * o[1]), y1 -= w * (r[0] * o[1] + r[1] * o[0]);
    }
    y[2 * v] = y0, y[2 * v + 1] = y1;
  }
}

static double precondition(System *s)
{
  double sum = 0;
  for (size_t v = 0; v < s->f->nv; v++) {
    if (s->f->fixed[v]) continue;
    double d = s->share * s->mass[v] + s->time * s->diagonal[v], inverse = d > 0 ? 1 / d : 0;
    for (size_t i = 2 * v; i < 2 * v + 2; i++) {
      s->z[i] = s->r[i] * inverse;
      sum += s->z[i] * s->r[i];
    }
  }
  return sum;
}

// Solve A u = share * mass * old, u given on fixed vertices, by conjugate gradients from the present u.
static void solve(System *s)
{
  CrossField *f = s->f;
  double *u = f->u, size = 0;
  multiply(s, u, s->q);
  for (size_t v = 0; v < f->nv; v++) {
    if (f->fixed[v]) continue;
    double d = s->share * s->mass[v] + s->time * s->diagonal[v];
    size += 2 * d;
    for (size_t i = 2 * v; i < 2 * v + 2; i++) s->r[i] = s->b[i] - s->q[i];
  }
  double rz = precondition(s), limit = TOLERANCE * TOLERANCE * size;
  memcpy(s->p, s->z, 2 * f->nv * sizeof *s->p);
  for (int k = 0; k < MAX_ITERATIONS && rz > limit; k++) {
    multiply(s, s->p, s->q);
    double pq = 0;
    for (size_t v = 0; v < f->nv; v++)
      if (!f->fixed[v]) pq += s->p[2 * v] * s->q[2 * v] + s->p[2 * v + 1] * s->q[2 * v + 1];
    if (!(pq > 0)) break;
    double step = rz / pq;
    for (size_t v = 0; v < f->nv; v++)
      for (size_t i = 2 * v; !f->fixed[v] && i < 2 * v + 2; i++) u[i] += step * s->p[i], s->r[i] -= step * s->q[i];
    double next = precondition(s), turn = next / rz;
    rz = next;
    for (size_t v = 0; v < f->nv; v++)
      for (size_t i = 2 * v; !f->fixed[v] && i < 2 * v + 2; i++) s->p[i] = s->z[i] + turn * s->p[i];
  }
}

static void normalize(CrossField *f)
{
  for (size_t v = 0; v < f->nv; v++) {
    double *u = f->u + 2 * v, len = sqrt(u[0] * u[0] + u[1] * u[1]);
    if (len > 1e-12) u[0] /= len, u[1] /= len;
    else u[0] = 1, u[1] = 0;
  }
}

static void diffuse(CrossField *f, const double *log_size)
{
  System s = {.f = f};
  assemble(&s, log_size);
  double area = 0;
  for (size_t v = 0; v < f->nv; v++) area += s.mass[v];
  s.share = 0, s.time = 1; // harmonic to begin with
  solve(&s);
  normalize(f);
  s.share = 1, s.time = FIRST_TIME * area;
  for (int k = 0; k < STEPS; k++, s.time *= TIME_RATIO) {
    for (size_t i = 0; i < 2 * f->nv; i++) s.b[i] = s.mass[i / 2] * f->u[i];
    solve(&s);
    normalize(f);
  }
  system_free(&s);
}

// ---- singularities

static double turn_between(const double *u, const double *w) { return atan2(u[0] * w[1] - u[1] * w[0], u[0] * w[0] + u[1] * w[1]); }

static void find_singularities(CrossField *f)
{
  for (size_t t = 0; t < f->ntri; t++) {
    const uint32_t *v = f->tri + 3 * t;
    const double *a = f->u + 2 * (size_t)v[0], *b = f->u + 2 * (size_t)v[1], *c = f->u + 2 * (size_t)v[2];
    // Each edge is turned along in one direction only, so that both its triangles see the same.
    double sum = 0;
    for (int i = 0; i < 3; i++) {
      const double *x = i == 0 ? a : i == 1 ? b : c, *y = i == 0 ? b : i == 1 ? c : a;
      sum += v[i] < v[(i + 1) % 3] ? turn_between(x, y) : -turn_between(y, x);
    }
    int index4 = (int)lround(sum / (2 * PI));
    Vec2 pa = point(f, v[0]), pb = point(f, v[1]), pc = point(f, v[2]);
    CrossSingularity s = {{(pa.x + pb.x + pc.x) / 3, (pa.y + pb.y + pc.y) / 3}, index4};
    if (index4) vec_push(&f->singularity, s);
  }
}

// ---- interface

static CrossField *copy_mesh(const CrossInput *in)
{
  CrossField *f = mem_zalloc(sizeof *f);
  f->nv = in->nv, f->ntri = in->ntri;
  f->xy = mem_alloc((2 * f->nv + 1) * sizeof *f->xy);
  f->tri = mem_alloc((3 * f->ntri + 1) * sizeof *f->tri);
  if (f->nv) memcpy(f->xy, in->xy, 2 * f->nv * sizeof *f->xy);
  if (f->ntri) memcpy(f->tri, in->tri, 3 * f->ntri * sizeof *f->tri);
  f->u = mem_zalloc((2 * f->nv + 1) * sizeof *f->u);
  f->fixed = mem_zalloc(f->nv + 1);
  f->at = mem_alloc((f->nv + 1) * sizeof *f->at);
  for (size_t v = 0; v < f->nv; v++) f->at[v] = NONE;
  find_twins(f);
  return f;
}

CrossField *cross_field_new(const CrossInput *in)
{
  CrossField *f = copy_mesh(in);
  double *log_size = in->size ? mem_alloc((f->nv + 1) * sizeof *log_size) : NULL;
  for (size_t v = 0; in->size && v < f->nv; v++) log_size[v] = log(in->size[v]);
  align(f, in->aligned, in->naligned);
  f->boundary4 = turns(f);
  diffuse(f, log_size);
  free(log_size);
  find_singularities(f);
  return f;
}

void cross_field_free(CrossField *f)
{
  if (!f) return;
  free(f->xy), free(f->tri), free(f->twin), free(f->u), free(f->fixed), free(f->at);
  vec_free(&f->singularity);
  free(f);
}

uint32_t cross_field_at_vertex(const CrossField *f, uint32_t v) { return v < f->nv ? f->at[v] : NONE; }

double cross_field_angle(const CrossField *f, Vec2 p, uint32_t *near)
{
  if (!f->ntri) return 0;
  uint32_t t = *near < f->ntri ? *near : 0, from = NONE;
  double w[3];
  for (size_t steps = 0; steps <= f->ntri; steps++) {
    uint32_t out = NONE;
    for (uint32_t i = 0; i < 3; i++) {
      Vec2 a = point(f, f->tri[3 * t + (i + 1) % 3]), b = point(f, f->tri[3 * t + (i + 2) % 3]);
      uint32_t e = 3 * t + (i + 1) % 3;
      w[i] = vec2_cross(vec2_sub(b, a), vec2_sub(p, a));
      if (w[i] < 0 && e != from && f->twin[e] != NONE && out == NONE) out = e;
    }
    if (out == NONE) break;
    from = f->twin[out];
    t = from / 3;
  }
  *near = t;
  double c = 0, s = 0;
  for (int i = 0; i < 3; i++) {
    uint32_t v = f->tri[3 * t + (uint32_t)i];
    w[i] = fmax(w[i], 0);
    c += w[i] * f->u[2 * (size_t)v], s += w[i] * f->u[2 * (size_t)v + 1];
  }
  return atan2(s, c) / 4;
}

size_t cross_field_singularities(const CrossField *f, const CrossSingularity **s)
{
  *s = f->singularity.data;
  return f->singularity.len;
}

long cross_field_boundary_index4(const CrossField *f) { return f->boundary4; }
long cross_field_euler(const CrossField *f) { return f->euler; }
