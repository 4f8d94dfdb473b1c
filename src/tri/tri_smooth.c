// tri_smooth.c - vertex repositioning: every vertex toward where the triangles around it are best
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/tri_star.h"

// How much the lengths of edges count against the shapes of triangles, in the worth of a position and in the ideal one.
// They let the efficiency index gain without the shapes losing.
#define LENGTH_WEIGHT 1.0
#define LENGTH_PULL 0.3

// What a position is worth, the less the better: the sum of 1/kappa_4^2 over the star and of l + 1/l - 2 over its edges; the
// largest 1/kappa_4^2; by what factor the edge worst in that is out of [2/3, 4/3], 1 if none is. Infinite if a triangle is not
// positive.
typedef struct {
  double sum, worst, range;
} Worth;

static Worth worth(const Star *s, double px, double py, double h, double *each)
{
  Worth w = {0, 0, 1};
  double shortest = METRIC_SHORT, longest = METRIC_LONG;
  double inv = 0.5 / h, ux = s->x[0] - px, uy = s->y[0] - py, lu = sqrt(ux * ux + uy * uy);
  for (int j = 0; j < s->n; j++) {
    double vx = s->x[j + 1] - px, vy = s->y[j + 1] - py, lv = sqrt(vx * vx + vy * vy);
    double d = ux * vy - uy * vx, b = s->base[j];
    double f = d > 0 ? lu * lv * b * (lu + lv + b) / (4 * d * d) : INFINITY;
    if (each) each[j] = f;
    double len = lu * (inv + s->inv[j]);
    w.sum += f + LENGTH_WEIGHT * (len + 1 / len - 2);
    w.worst = f > w.worst ? f : w.worst;
    shortest = len < shortest ? len : shortest;
    longest = len > longest ? len : longest;
    ux = vx, uy = vy, lu = lv;
  }
  if (shortest < METRIC_SHORT || longest > METRIC_LONG)
    w.range = MAX(longest / METRIC_LONG, METRIC_SHORT / shortest);
  return w;
}

// Is 1/kappa_4^2 below `limit` in the whole star with v at (px, py)? If so *worst is the largest; if not, *hard is a triangle where
// it is not: the first to look at next time.
static bool all_below(const Star *s, double px, double py, double limit, int *hard, double *worst)
{
  double largest = 0, ux = s->x[*hard] - px, uy = s->y[*hard] - py, lu = sqrt(ux * ux + uy * uy);
  for (int k = 0, j = *hard; k < s->n; k++, j = j + 1 < s->n ? j + 1 : 0) {
    double vx = s->x[j + 1] - px, vy = s->y[j + 1] - py, lv = sqrt(vx * vx + vy * vy);
    double d = ux * vy - uy * vx, b = s->base[j], f = lu * lv * b * (lu + lv + b) / (4 * d * d);
    if (!(d > 0 && f < limit)) {
      *hard = j;
      return false;
    }
    largest = f > largest ? f : largest;
    ux = vx, uy = vy, lu = lv;
  }
  *worst = largest;
  return true;
}

// The mean of the points that would make each triangle of the star equilateral, or nearly, with sides nearer to h; the bad ones
// weigh more.
static void ideal(const Star *s, double h, const double *each, double *p)
{
  double sx = 0, sy = 0, sw = 0;
  for (int j = 0; j < s->n; j++) {
    double w = each[j], k = 0.5 * METRIC_SQRT3 * (1 - LENGTH_PULL + LENGTH_PULL * h / s->base[j]);
    double dx = s->x[j + 1] - s->x[j], dy = s->y[j + 1] - s->y[j];
    sx += w * (0.5 * (s->x[j] + s->x[j + 1]) - k * dy);
    sy += w * (0.5 * (s->y[j] + s->y[j + 1]) + k * dx);
    sw += w;
  }
  p[0] = sx / sw, p[1] = sy / sw;
}

// What v brings along when it moves to p. The size carried from the boundary stays: moves are short.
static double size_moved(const Refiner *r, VertId v, const double *p)
{
  if (!r->p->size || r->keep_sizes) return r->size[v];
  double h = r->p->size(r->p->size_ctx, (Vec2){p[0], p[1]});
  return r->carried && r->carried[v] < h ? r->carried[v] : h;
}

static void move(Refiner *r, const Star *s, VertId v, const double *p, double h)
{
  double *at = r->m->xy + 2 * (size_t)v;
  double far = 0.01 * r->size[v];
  if (metric_distance2(at, p) > far * far) {
    r->awake[v] = 1;
    for (int j = 0; j < s->n; j++) r->awake[s->id[j]] = 1;
  }
  at[0] = p[0], at[1] = p[1];
  r->size[v] = h;
  r->stats->moves++;
}

bool refine__relocate(Refiner *r, VertId v)
{
  Star s;
  double each[STAR_RING], p[2];
  const double x = r->m->xy[2 * (size_t)v], y = r->m->xy[2 * (size_t)v + 1];
  if (!star_gather(r, v, &s)) return false;
  Worth w = worth(&s, x, y, r->size[v], each);
  if (!(w.worst < INFINITY)) return false; // flat but for rounding: it would weigh more than any place can bear
  ideal(&s, r->size[v], each, p);
  double limit = w.worst > r->floor ? w.worst : r->floor;
  for (int k = 0; k < 2; k++) {
    double h = size_moved(r, v, p);
    Worth n = worth(&s, p[0], p[1], h, NULL);
    // worst < 1e8 leaves the sign of every area beyond doubt in floating point.
    if (n.sum < w.sum && n.worst <= limit && n.worst < 1e8 && n.range <= w.range) {
      move(r, &s, v, p, h);
      return true;
    }
    p[0] = 0.5 * (p[0] + x), p[1] = 0.5 * (p[1] + y);
  }
  return false;
}

bool refine__relocate_worst(Refiner *r, VertId v)
{
  static const double way[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {.7, .7}, {-.7, .7}, {-.7, -.7}, {.7, -.7}};
  Star s;
  double p[2] = {r->m->xy[2 * (size_t)v], r->m->xy[2 * (size_t)v + 1]}, step = 0.2 * r->size[v];
  if (!star_gather(r, v, &s)) return false;
  Worth first = worth(&s, p[0], p[1], r->size[v], NULL);
  double best = first.worst;
  bool moved = false;
  int hard = 0;
  for (int k = 0; k < 20 && step > 0.01 * r->size[v]; k++) {
    int least = -1;
    for (int i = 0; i < 8; i++) {
      double limit = fmin(0.995 * best, 1e8);
      if (all_below(&s, p[0] + step * way[i][0], p[1] + step * way[i][1], limit, &hard, &best)) least = i;
    }
    if (least < 0) {
      step *= 0.5;
      continue;
    }
    p[0] += step * way[least][0], p[1] += step * way[least][1];
    moved = true;
  }
  if (!moved) return false;
  double h = size_moved(r, v, p);
  if (worth(&s, p[0], p[1], h, NULL).range > first.range) return false;
  move(r, &s, v, p, h);
  return true;
}

void refine__smooth(Refiner *r, int passes)
{
  Tri *m = r->m;
  for (int k = 0; k < passes; k++) {
    for (VertId v = 0; v < m->nv; v++) {
      if (!r->awake[v]) continue;
      r->awake[v] = 0;
      if (!r->fixed[v]) refine__relocate(r, v);
    }
  }
}
