// tri_smooth.c - vertex repositioning: every vertex toward where the triangles around it are best
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/refine_int.h"

enum { MAX_RING = 32 }; // vertices with more neighbours stay where they are

// The star of an interior vertex, for trying positions. Around v the ring of neighbours x, y counterclockwise (ring[n] = ring[0]).
typedef struct {
  int n;
  VertId id[MAX_RING + 1];
  double x[MAX_RING + 1], y[MAX_RING + 1];
  double base[MAX_RING];     // length of the side from ring j to j+1
} Star;

// What a position is worth: the sum and the largest of 1/kappa_4^2 over the star; infinite if a triangle is not positive.
typedef struct {
  double sum, worst;
} Worth;

static bool gather(const Tri *m, VertId v, Star *s)
{
  EdgeId first = m->hint[v], e = first;
  int n = 0;
  do {
    if (n == MAX_RING) return false;
    VertId u = tri_dest(m, e);
    s->id[n] = u;
    s->x[n] = m->xy[2 * (size_t)u], s->y[n] = m->xy[2 * (size_t)u + 1];
    n++;
    e = tri_ccw(m, e);
  } while (e != first);
  s->n = n;
  s->id[n] = s->id[0], s->x[n] = s->x[0], s->y[n] = s->y[0];
  for (int j = 0; j < n; j++) {
    double u = s->x[j + 1] - s->x[j], w = s->y[j + 1] - s->y[j];
    s->base[j] = sqrt(u * u + w * w);
  }
  return true;
}

static Worth worth(const Star *s, double px, double py, double *each)
{
  Worth w = {0, 0};
  double ux = s->x[0] - px, uy = s->y[0] - py, lu = sqrt(ux * ux + uy * uy);
  for (int j = 0; j < s->n; j++) {
    double vx = s->x[j + 1] - px, vy = s->y[j + 1] - py, lv = sqrt(vx * vx + vy * vy);
    double d = ux * vy - uy * vx, b = s->base[j];
    double f = d > 0 ? lu * lv * b * (lu + lv + b) / (4 * d * d) : INFINITY;
    if (each) each[j] = f;
    w.sum += f;
    w.worst = f > w.worst ? f : w.worst;
    ux = vx, uy = vy, lu = lv;
  }
  return w;
}

// The mean of the points that would make each triangle of the star equilateral, the bad ones weighing more.
static void ideal(const Star *s, const double *each, double *p)
{
  double sx = 0, sy = 0, sw = 0;
  for (int j = 0; j < s->n; j++) {
    double w = each[j];
    double dx = s->x[j + 1] - s->x[j], dy = s->y[j + 1] - s->y[j];
    sx += w * (0.5 * (s->x[j] + s->x[j + 1]) - 0.5 * METRIC_SQRT3 * dy);
    sy += w * (0.5 * (s->y[j] + s->y[j + 1]) + 0.5 * METRIC_SQRT3 * dx);
    sw += w;
  }
  p[0] = sx / sw, p[1] = sy / sw;
}

// Would v at p with size h keep every edge in [2/3, 4/3], or at least no further from it than before?
static bool lengths_kept(const Refiner *r, const Star *s, VertId v, const double *p, double h)
{
  const double *old = tri_xy(r->m, v);
  double h0 = r->size[v];
  for (int j = 0; j < s->n; j++) {
    double q[2] = {s->x[j], s->y[j]}, hq = r->size[s->id[j]];
    double l = metric_length(p, q, h, hq);
    if (l >= METRIC_SHORT && l <= METRIC_LONG) continue;
    double k = metric_length(old, q, h0, hq);
    if (l < METRIC_SHORT ? l < k : l > k) return false;
  }
  return true;
}

// Improve the position of v. True if it moved.
bool refine__relocate(Refiner *r, VertId v)
{
  Tri *m = r->m;
  Star s;
  double each[MAX_RING], p[2], x = m->xy[2 * (size_t)v], y = m->xy[2 * (size_t)v + 1];
  if (!gather(m, v, &s)) return false;
  Worth w = worth(&s, x, y, each);
  if (w.worst < 1.0005) return false;
  ideal(&s, each, p);
  double limit = fmax(w.worst, r->floor);
  for (int k = 0; k < 2; k++) {
    Worth n = worth(&s, p[0], p[1], NULL);
    if (n.sum < w.sum && n.worst <= limit) {
      double h = r->size[v];
      if (r->p->size) {
        h = r->p->size(r->p->size_ctx, (Vec2){p[0], p[1]});
        if (r->carried) h = fmin(h, r->carried[v]);
      }
      if (lengths_kept(r, &s, v, p, h)) {
        m->xy[2 * (size_t)v] = p[0], m->xy[2 * (size_t)v + 1] = p[1];
        r->size[v] = h;
        r->stats->moves++;
        return true;
      }
    }
    p[0] = 0.5 * (p[0] + x), p[1] = 0.5 * (p[1] + y);
  }
  return false;
}

void refine__smooth(Refiner *r, int passes)
{
  Tri *m = r->m;
  for (int k = 0; k < passes; k++)
    for (VertId v = 0; v < m->nv; v++)
      if (m->hint[v] != NONE && !r->fixed[v]) refine__relocate(r, v);
}
