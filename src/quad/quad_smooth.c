// quad_smooth.c - moving vertices: never to the harm of the worst element around
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "geom/predicates.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

static const double PI = 3.14159265358979323846;

// ---- shapes

static double triangle_shape(Vec2 a, Vec2 b, Vec2 c)
{
  Vec2 p[3] = {a, b, c};
  double worst = 0;
  for (int i = 0; i < 3; i++) {
    Vec2 u = vec2_sub(p[(i + 1) % 3], p[i]), v = vec2_sub(p[(i + 2) % 3], p[i]);
    worst = fmax(worst, fabs(PI / 3 - atan2(vec2_cross(u, v), vec2_dot(u, v))));
  }
  return 1 - 3 / PI * worst;
}

double quad__shape(const Vec2 *xy, const uint32_t *v)
{
  if (v[3] == NONE) return triangle_shape(xy[v[0]], xy[v[1]], xy[v[2]]);
  // The corner furthest from a right angle has the largest |cosine|; one arcsine for all, while the quad is convex.
  double most = 0;
  for (int i = 0; i < 4; i++) {
    Vec2 at = xy[v[i]], p = vec2_sub(xy[v[(i + 1) % 4]], at), q = vec2_sub(xy[v[(i + 3) % 4]], at);
    double dot = vec2_dot(p, q), size = vec2_dot(p, p) * vec2_dot(q, q);
    if (vec2_cross(p, q) <= 0 || size <= 0) return quad_eta_signed(xy[v[0]], xy[v[1]], xy[v[2]], xy[v[3]]);
    most = fmax(most, dot * dot / size);
  }
  return 1 - 2 / PI * asin(fmin(1, sqrt(most)));
}

bool quad__convex(const Vec2 *xy, const uint32_t *v)
{
  int n = v[3] == NONE ? 3 : 4;
  for (int i = 0; i < n; i++)
    if (orient2d(&xy[v[i]].x, &xy[v[(i + 1) % n]].x, &xy[v[(i + 2) % n]].x) <= 0) return false;
  return true;
}

QuadScore quad__score(const Vec2 *xy, const uint32_t *corner, size_t n)
{
  QuadScore s = {1, 0};
  for (size_t i = 0; i < n; i++) {
    double shape = quad__shape(xy, corner + 4 * i);
    s.worst = fmin(s.worst, shape);
    s.energy += (1 - shape) * (1 - shape);
  }
  return s;
}

// ---- stars

QuadStars quad__stars(const QuadMesh *m)
{
  size_t nv = m->xy.len, ns = m->vertex.len;
  QuadStars s = {mem_zalloc((nv + 2) * sizeof *s.start), mem_alloc((ns + 1) * sizeof *s.at)};
  for (size_t i = 0; i < ns; i++)
    if (m->vertex.data[i] != NONE) s.start[m->vertex.data[i] + 2]++;
  for (size_t v = 0; v < nv; v++) s.start[v + 2] += s.start[v + 1];
  for (size_t i = 0; i < ns; i++)
    if (m->vertex.data[i] != NONE) s.at[s.start[m->vertex.data[i] + 1]++] = (uint32_t)(i / 4);
  return s;
}

void quad__stars_free(QuadStars *s)
{
  free(s->start);
  free(s->at);
}

// ---- moving one vertex

// Better: the worst improves, or stays (or remains above the floor) while the energy falls.
enum { QUICK_STEPS = 2 };
static const double LEAST_GAIN = 1e-9;

static bool better(QuadScore a, QuadScore b, double floor)
{
  if (a.worst > b.worst + LEAST_GAIN && b.worst < floor) return true;
  return (a.worst >= b.worst || a.worst >= floor) && a.energy < b.energy - LEAST_GAIN;
}

// The score, given up as soon as it cannot be better than `best` any more.
static bool score_better(const Vec2 *xy, const uint32_t *corner, size_t n, QuadScore best, double floor, QuadScore *s)
{
  *s = (QuadScore){1, 0};
  for (size_t i = 0; i < n; i++) {
    double shape = quad__shape(xy, corner + 4 * i);
    s->worst = fmin(s->worst, shape);
    s->energy += (1 - shape) * (1 - shape);
    if (best.worst < floor ? s->worst < best.worst : s->worst < floor || s->energy >= best.energy - LEAST_GAIN) return false;
  }
  return better(*s, best, floor);
}

static bool try_point(Vec2 *xy, uint32_t v, const uint32_t *corner, size_t n, Vec2 p, double floor, QuadScore *best)
{
  Vec2 old = xy[v];
  xy[v] = p;
  QuadScore s;
  bool good = score_better(xy, corner, n, *best, floor, &s);
  for (size_t i = 0; good && i < n; i++) good = s.worst > 1e-6 || quad__convex(xy, corner + 4 * i);
  if (good) *best = s;
  else xy[v] = old;
  return good;
}

// Mean of the vertices joined to v, and the length of the longest edge there.
static Vec2 neighbour_mean(const Vec2 *xy, uint32_t v, const uint32_t *corner, size_t n, double *reach)
{
  Vec2 sum = {0, 0};
  size_t count = 0;
  *reach = 0;
  for (size_t i = 0; i < n; i++) {
    const uint32_t *c = corner + 4 * i;
    int k = c[3] == NONE ? 3 : 4;
    for (int j = 0; j < k; j++) {
      if (c[j] != v) continue;
      Vec2 p = xy[c[(j + 1) % k]], q = xy[c[(j + k - 1) % k]];
      sum = vec2_add(sum, vec2_add(p, q));
      count += 2;
      *reach = fmax(*reach, vec2_length(vec2_sub(p, xy[v])));
    }
  }
  return count ? vec2_scale(1.0 / (double)count, sum) : xy[v];
}

bool quad__improve(Vec2 *xy, uint32_t v, const uint32_t *corner, size_t n, int steps, double floor)
{
  static const double dir[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0.7, 0.7}, {-0.7, 0.7}, {-0.7, -0.7}, {0.7, -0.7}};
  QuadScore best = quad__score(xy, corner, n);
  double step;
  Vec2 mean = neighbour_mean(xy, v, corner, n, &step);
  bool moved = try_point(xy, v, corner, n, mean, floor, &best);
  if (!moved) moved = try_point(xy, v, corner, n, vec2_scale(0.5, vec2_add(mean, xy[v])), floor, &best);
  if (moved && best.worst >= floor && steps <= QUICK_STEPS) return true; // the next pass goes on from here
  step *= 0.2;
  for (int k = 0; k < steps; k++) {
    bool any = false;
    for (int d = 0; d < 8; d++)
      any |= try_point(xy, v, corner, n, (Vec2){xy[v].x + step * dir[d][0], xy[v].y + step * dir[d][1]}, floor, &best);
    moved |= any;
    if (!any) step /= 2;
  }
  return moved;
}

// ---- the whole mesh

static size_t collect_star(const QuadMesh *m, const QuadStars *s, uint32_t v, uint32_t *corner, size_t max)
{
  size_t n = s->start[v + 1] - s->start[v];
  if (n > max) return 0;
  for (size_t i = 0; i < n; i++)
    for (int k = 0; k < 4; k++) corner[4 * i + (size_t)k] = m->vertex.data[4 * (size_t)s->at[s->start[v] + i] + (size_t)k];
  return n;
}

typedef struct {
  double shape;
  uint32_t element;
} Ranked;

static int worse_first(const void *a, const void *b)
{
  const Ranked *p = a, *q = b;
  if (p->shape != q->shape) return p->shape < q->shape ? -1 : 1;
  return p->element < q->element ? -1 : p->element > q->element;
}

enum { MAX_STAR = 32, WORST_STEPS = 6 };

// The corners of bad elements, worst element first, with a longer search.
static void improve_worst(QuadMesh *m, const QuadStars *s, double floor)
{
  Vec(Ranked) bad = {0};
  uint32_t corner[4 * MAX_STAR];
  for (uint32_t e = 0; e < quad_mesh_elements(m); e++) {
    double shape = quad__shape(m->xy.data, &m->vertex.data[4 * (size_t)e]);
    if (shape < QUAD_GOOD_SHAPE) vec_push(&bad, ((Ranked){shape, e}));
  }
  if (bad.len) qsort(bad.data, bad.len, sizeof *bad.data, worse_first);
  for (size_t i = 0; i < bad.len; i++)
    for (int k = 0; k < 4; k++) {
      uint32_t v = m->vertex.data[4 * (size_t)bad.data[i].element + (size_t)k];
      if (v == NONE || m->fixed.data[v]) continue;
      size_t n = collect_star(m, s, v, corner, MAX_STAR);
      if (n) quad__improve(m->xy.data, v, corner, n, WORST_STEPS, floor);
    }
  vec_free(&bad);
}

double quad__floor(const QuadMesh *m)
{
  double worst = 1;
  for (size_t e = 0; e < quad_mesh_elements(m); e++) worst = fmin(worst, quad__shape(m->xy.data, &m->vertex.data[4 * e]));
  return fmax(worst, QUAD_GOOD_SHAPE);
}

void quad_smooth(QuadMesh *m, int passes)
{
  double floor = quad__floor(m);
  QuadStars s = quad__stars(m);
  uint32_t corner[4 * MAX_STAR];
  uint8_t *still = mem_zalloc(m->xy.len + 1); // vertices that did not move in the last pass, nor their neighbours
  for (int pass = 0; pass < passes; pass++) {
    for (uint32_t v = 0; v < m->xy.len; v++) {
      if (m->fixed.data[v] || (pass > 0 && still[v])) continue;
      still[v] = 1;
      size_t n = collect_star(m, &s, v, corner, MAX_STAR);
      if (n && quad__improve(m->xy.data, v, corner, n, 2, floor))
        for (size_t i = 0; i < 4 * n; i++)
          if (corner[i] != NONE) still[corner[i]] = 0;
    }
    improve_worst(m, &s, floor);
  }
  free(still);
  quad__stars_free(&s);
}
