// quality.c - shape measures of triangles, adimensional lengths of edges, and their summary over a mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "geom/quality.h"

#include "base/map.h"
#include "base/mem.h"

#define SQRT3 1.7320508075688772
#define DEGREES 57.295779513082321 // per radian

TriShape shape_plane(Vec2 p, Vec2 q, Vec2 r)
{
  Vec2 u = vec2_sub(q, p), v = vec2_sub(r, p), w = vec2_sub(r, q);
  return (TriShape){vec2_length(w), vec2_length(v), vec2_length(u), 0.5 * vec2_cross(u, v)};
}

TriShape shape_space(Vec3 p, Vec3 q, Vec3 r, Vec3 normal)
{
  Vec3 n = vec3_cross(vec3_sub(q, p), vec3_sub(r, p));
  double area = 0.5 * vec3_length(n);
  if (vec3_dot(n, normal) < 0) area = -area;
  return (TriShape){vec3_distance(q, r), vec3_distance(r, p), vec3_distance(p, q), area};
}

void quality_angles(TriShape t, double angle[3])
{
  // tan A = 4 area / (b^2 + c^2 - a^2) is good at both ends of the range, where the arc cosine is not.
  double a2 = t.a * t.a, b2 = t.b * t.b, c2 = t.c * t.c, s = 4 * fabs(t.area);
  angle[0] = atan2(s, b2 + c2 - a2) * DEGREES;
  angle[1] = atan2(s, c2 + a2 - b2) * DEGREES;
  angle[2] = atan2(s, a2 + b2 - c2) * DEGREES;
}

double quality_kappa1(TriShape t)
{
  double longest = fmax(t.a, fmax(t.b, t.c)), shortest = fmin(t.a, fmin(t.b, t.c));
  double middle = t.a + t.b + t.c - longest - shortest;
  // The smallest angle lies between the two longer sides.
  double d = longest * middle;
  return d > 0 ? 2 / SQRT3 * (2 * t.area / d) : 0;
}

double quality_kappa2(TriShape t)
{
  double d = (t.a + t.b + t.c) * fmax(t.a, fmax(t.b, t.c));
  return d > 0 ? SQRT3 * 4 * t.area / d : 0;
}

double quality_kappa3(TriShape t)
{
  double d = t.a * t.b * t.c * (t.a + t.b + t.c);
  return d > 0 ? 16 * t.area * fabs(t.area) / d : 0;
}

double quality_kappa4(TriShape t)
{
  double d = t.a * t.b * t.c * (t.a + t.b + t.c);
  return d > 0 ? 4 * t.area / sqrt(d) : 0;
}

double quality_kappa5(TriShape t)
{
  double c = cbrt(t.a * t.b * t.c);
  return c > 0 ? 4 / SQRT3 * t.area / (c * c) : 0;
}

bool quality_breaks_maximum_principle(Vec2 p, Vec2 q, Vec2 r, Vec2 s)
{
  Vec2 rp = vec2_sub(p, r), rq = vec2_sub(q, r), sp = vec2_sub(p, s), sq = vec2_sub(q, s);
  double cr = fabs(vec2_cross(rp, rq)), cs = fabs(vec2_cross(sp, sq));
  // The sum of the angles exceeds pi exactly if sin(alpha + beta) < 0.
  double sine = cr * vec2_dot(sp, sq) + cs * vec2_dot(rp, rq);
  // Four points on a circle (a square of a grid) give zero but for rounding, and zero is no violation.
  return sine < -1e-12 * (fabs(cr * vec2_dot(sp, sq)) + fabs(cs * vec2_dot(rp, rq)) + cr * cs);
}

// Three-point Gauss-Legendre of 1/h over the part [s, t] of the segment, times its length fraction.
static double gauss(Vec2 p, Vec2 d, double s, double t, SizeAt h, void *ctx)
{
  static const double node = 0.77459666924148338; // sqrt(3/5)
  double m = 0.5 * (s + t), r = 0.5 * (t - s) * node;
  double f0 = 1 / h(ctx, vec2_add(p, vec2_scale(m - r, d)));
  double f1 = 1 / h(ctx, vec2_add(p, vec2_scale(m, d)));
  double f2 = 1 / h(ctx, vec2_add(p, vec2_scale(m + r, d)));
  return (t - s) * (5 * f0 + 8 * f1 + 5 * f2) / 18;
}

static double integrate(Vec2 p, Vec2 d, double s, double t, double whole, int depth, SizeAt h, void *ctx)
{
  double m = 0.5 * (s + t);
  double left = gauss(p, d, s, m, h, ctx), right = gauss(p, d, m, t, h, ctx);
  if (depth == 0 || fabs(left + right - whole) <= 1e-6 * fabs(left + right)) return left + right;
  return integrate(p, d, s, m, left, depth - 1, h, ctx) + integrate(p, d, m, t, right, depth - 1, h, ctx);
}

double quality_edge_length(Vec2 p, Vec2 q, SizeAt h, void *ctx)
{
  Vec2 d = vec2_sub(q, p);
  return vec2_length(d) * integrate(p, d, 0, 1, gauss(p, d, 0, 1, h, ctx), 9, h, ctx);
}

static int compare_doubles(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

typedef struct {
  const double *xy;
  const uint32_t *tri;
  size_t ntri;
  Map first;         // edge -> half-edge that named it first
  uint32_t *valence; // edges at a vertex
  bool *rim;         // vertex on an edge of one triangle only (or of more than two)
  uint32_t *twin;    // half-edge -> its opposite, NONE at the rim
} Census;

static Vec2 point(const Census *c, uint32_t v) { return (Vec2){c->xy[2 * (size_t)v], c->xy[2 * (size_t)v + 1]}; }

static size_t next_in_triangle(size_t e) { return e % 3 == 2 ? e - 2 : e + 1; }

static void census_edges(Census *c, MeshQuality *q)
{
  for (size_t e = 0; e < 3 * c->ntri; e++) {
    uint32_t a = c->tri[e], b = c->tri[next_in_triangle(e)];
    bool added;
    uint32_t *slot = map_slot(&c->first, map_pair(a, b), (uint32_t)e, &added);
    c->twin[e] = NONE;
    if (added) {
      c->valence[a]++, c->valence[b]++;
      q->nedge++;
    } else {
      c->twin[e] = *slot;
      c->twin[*slot] = (uint32_t)e;
    }
  }
  for (size_t e = 0; e < 3 * c->ntri; e++)
    if (c->twin[e] == NONE) c->rim[c->tri[e]] = c->rim[c->tri[next_in_triangle(e)]] = true;
}

static void measure_shapes(const Census *c, MeshQuality *q)
{
  double *gamma = mem_alloc(c->ntri * sizeof *gamma), sum = 0;
  q->gamma_min = INFINITY, q->angle_min = 180, q->angle_max = 0, q->worst = NONE;
  for (size_t t = 0; t < c->ntri; t++) {
    TriShape s = shape_plane(point(c, c->tri[3 * t]), point(c, c->tri[3 * t + 1]), point(c, c->tri[3 * t + 2]));
    double angle[3];
    quality_angles(s, angle);
    for (int i = 0; i < 3; i++) {
      q->angle_min = fmin(q->angle_min, angle[i]);
      q->angle_max = fmax(q->angle_max, angle[i]);
    }
    gamma[t] = quality_gamma(s);
    if (gamma[t] < q->gamma_min) q->gamma_min = gamma[t], q->worst = (uint32_t)t;
    sum += gamma[t];
    q->area += s.area;
    q->ninverted += !(s.area > 0);
  }
  if (c->ntri) {
    q->gamma_mean = sum / (double)c->ntri;
    qsort(gamma, c->ntri, sizeof *gamma, compare_doubles);
    q->gamma_p5 = gamma[c->ntri / 20];
  } else {
    q->gamma_min = q->gamma_mean = q->gamma_p5 = 1;
    q->angle_min = q->angle_max = 60;
  }
  free(gamma);
}

static void measure_edges(const Census *c, MeshQuality *q, SizeAt h, void *ctx)
{
  double sum = 0;
  for (size_t e = 0; e < 3 * c->ntri; e++) {
    if (c->twin[e] != NONE && c->twin[e] < e) continue;
    Vec2 a = point(c, c->tri[e]), b = point(c, c->tri[next_in_triangle(e)]);
    if (h) sum += quality_tau_term(quality_edge_length(a, b, h, ctx));
    if (c->twin[e] == NONE) continue;
    Vec2 r = point(c, c->tri[next_in_triangle(next_in_triangle(e))]);
    Vec2 s = point(c, c->tri[next_in_triangle(next_in_triangle(c->twin[e]))]);
    q->nmaximum += quality_breaks_maximum_principle(a, b, r, s);
  }
  q->tau = q->nedge ? exp(sum / (double)q->nedge) : 1;
}

MeshQuality quality_measure(const double *xy, size_t nvert, const uint32_t *tri, size_t ntri, SizeAt h, void *ctx)
{
  MeshQuality q = {.ntri = ntri};
  Census c = {.xy = xy, .tri = tri, .ntri = ntri};
  c.valence = mem_zalloc(nvert * sizeof *c.valence);
  c.rim = mem_zalloc(nvert * sizeof *c.rim);
  c.twin = mem_alloc(3 * ntri * sizeof *c.twin);
  map_reserve(&c.first, 3 * ntri / 2 + 16);
  census_edges(&c, &q);
  measure_shapes(&c, &q);
  measure_edges(&c, &q, h, ctx);
  size_t interior = 0, six = 0;
  for (size_t v = 0; v < nvert; v++) {
    if (c.valence[v] == 0) continue;
    q.nvert++;
    if (c.rim[v]) continue;
    interior++;
    six += c.valence[v] == 6;
  }
  q.valence6 = interior ? (double)six / (double)interior : 1;
  map_free(&c.first);
  free(c.valence), free(c.rim), free(c.twin);
  return q;
}
