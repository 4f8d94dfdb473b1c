// tri_sharpen.c - the smallest angle of a small face: vertices of the sharpest triangles move while that is worth what it costs
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/tri_polish.h"

enum { ROUNDS = 12, STEPS = 30 };
#define NEARLY 0.01 // squared sines this near to the smallest are raised with it

// Squared sine of the smallest angle, from the sides and twice the area.
static inline double sine2(double a, double b, double c, double area2)
{
  double p = a * b * c / fmin(a, fmin(b, c));
  return area2 > 0 ? area2 * area2 / (p * p) : 0;
}

static double sine2_of(const Tri *m, TriId t)
{
  const uint32_t *v = m->vert + 3 * (size_t)t;
  const double *a = tri_xy(m, v[0]), *b = tri_xy(m, v[1]), *c = tri_xy(m, v[2]);
  double d = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return sine2(sqrt(metric_distance2(a, b)), sqrt(metric_distance2(b, c)), sqrt(metric_distance2(c, a)), d);
}

static bool is_fixed(const Refiner *r, TriId t)
{
  const uint32_t *v = r->m->vert + 3 * (size_t)t;
  return r->fixed[v[0]] && r->fixed[v[1]] && r->fixed[v[2]];
}

// Squared sine of the smallest angle, largest 1/kappa_4^2, how far out of [2/3, 4/3], cost.
typedef struct {
  double sine2, worst, range, sum;
} Sharpness;

static Sharpness sharpness(Polish *q, const Star *s, double px, double py, double h)
{
  Sharpness w = {1, 0, 1, 0};
  double ux = s->x[0] - px, uy = s->y[0] - py, lu = sqrt(ux * ux + uy * uy);
  q->work++;
  for (int j = 0; j < s->n; j++) {
    double vx = s->x[j + 1] - px, vy = s->y[j + 1] - py, lv = sqrt(vx * vx + vy * vy);
    double d = ux * vy - uy * vx, b = s->base[j];
    double f = d > 0 ? lu * lv * b * (lu + lv + b) / (4 * d * d) : INFINITY;
    double l = lu * metric_density(h, s->h[j]);
    w.sine2 = fmin(w.sine2, sine2(lu, lv, b, d));
    w.worst = fmax(w.worst, f);
    w.range = fmax(w.range, l > METRIC_LONG ? l / METRIC_LONG : METRIC_SHORT / l);
    w.sum += polish__shape(q, f) + q->weight * polish__length(l);
    ux = vx, uy = vy, lu = lv;
  }
  return w;
}

// Pattern search for vertex v; true if it moved.
static bool sharpen(Polish *q, VertId v)
{
  static const double way[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {.7, .7}, {-.7, .7}, {-.7, -.7}, {.7, -.7}};
  Refiner *r = q->r;
  Star s;
  double *at = r->m->xy + 2 * (size_t)v, p[2] = {at[0], at[1]}, h = r->size[v], step = 0.1 * h;
  if (!star_gather(r, v, &s)) return false;
  Sharpness best = sharpness(q, &s, p[0], p[1], h), start = best;
  for (int k = 0; k < STEPS && step > 0.002 * h;) {
    int i = 0;
    for (; i < 8; i++) {
      double x = p[0] + step * way[i][0], y = p[1] + step * way[i][1];
      Sharpness n = sharpness(q, &s, x, y, h);
      if (n.sine2 <= best.sine2 + 1e-5 || n.worst > start.worst || n.range > start.range) continue;
      if (n.sum - best.sum >= q->lift * (sqrt(n.sine2) - sqrt(best.sine2))) continue;
      p[0] = x, p[1] = y, best = n;
      break;
    }
    if (i == 8) step *= 0.5;
    else k++;
  }
  if (p[0] == at[0] && p[1] == at[1]) return false;
  h = polish__size(q, v, p);
  if (sharpness(q, &s, p[0], p[1], h).range > start.range) return false;
  at[0] = p[0], at[1] = p[1];
  r->size[v] = h;
  r->stats->moves++;
  return true;
}

double polish__sine2(const Refiner *r)
{
  const Tri *m = r->m;
  double least = 1;
  for (TriId t = 0; t < m->nt; t++)
    if (tri_is_inside(m, t) && !is_fixed(r, t)) least = fmin(least, sine2_of(m, t));
  return least;
}

void polish__sharpen(Polish *q)
{
  Refiner *r = q->r;
  const Tri *m = r->m;
  bool moved = true;
  double least = polish__sine2(r);
  for (int k = 0; k < ROUNDS && moved && least < POLISH_SINE2; k++) {
    moved = false;
    for (TriId t = 0; t < m->nt; t++) {
      if (!tri_is_inside(m, t) || sine2_of(m, t) > least + NEARLY) continue;
      for (EdgeId e = 3 * t; e < 3 * t + 3; e++)
        if (!r->fixed[m->vert[e]]) moved |= sharpen(q, m->vert[e]);
    }
    least = polish__sine2(r);
  }
}
