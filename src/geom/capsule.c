// capsule.c - a narrow capsule around balls
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/capsule.h"

#include <math.h>

static double ball_gap(const Ball *b, const double c[3])
{
  double x = b->c[0] - c[0], y = b->c[1] - c[1], z = b->c[2] - c[2];
  return x * x + y * y + z * z;
}

static size_t farthest(const Ball *b, size_t n, const double c[3])
{
  size_t best = 0;
  double most = -1;
  for (size_t i = 0; i < n; i++) {
    double d2 = ball_gap(&b[i], c);
    if (d2 > most) most = d2, best = i;
  }
  return best;
}

// Place along the axis (unit, from o) and squared distance from it.
static double along(const Ball *b, const double o[3], const double axis[3], double *off2)
{
  double r[3], t = 0;
  for (int i = 0; i < 3; i++) r[i] = b->c[i] - o[i], t += r[i] * axis[i];
  *off2 = 0;
  for (int i = 0; i < 3; i++) *off2 += (r[i] - t * axis[i]) * (r[i] - t * axis[i]);
  return t;
}

Capsule capsule_fit(const Ball *b, size_t n)
{
  const Ball *p = &b[farthest(b, n, b[0].c)], *q = &b[farthest(b, n, p->c)];
  double o[3], axis[3], length = sqrt(ball_gap(p, q->c)), left = 0, right = 0, r = 0, off2;
  if (!(length > 0)) {
    for (size_t i = 0; i < n; i++) r = MAX(r, b[i].r);
    return (Capsule){{p->c[0], p->c[1], p->c[2]}, {0, 0, 0}, r};
  }
  for (int i = 0; i < 3; i++) o[i] = p->c[i], axis[i] = (q->c[i] - p->c[i]) / length;
  for (size_t i = 0; i < n; i++) {
    double w = (b[i].c[1] - o[1]) * axis[0] - (b[i].c[0] - o[0]) * axis[1];
    left = MAX(left, w + b[i].r), right = MIN(right, w - b[i].r);
  }
  o[0] -= axis[1] * (left + right) / 2, o[1] += axis[0] * (left + right) / 2;
  for (size_t i = 0; i < n; i++) {
    along(&b[i], o, axis, &off2);
    r = MAX(r, sqrt(off2) + b[i].r);
  }
  double t0 = INFINITY, t1 = -INFINITY;
  for (size_t i = 0; i < n; i++) {
    double t = along(&b[i], o, axis, &off2), s = sqrt(MAX((r - b[i].r) * (r - b[i].r) - off2, 0));
    t0 = MIN(t0, t + s), t1 = MAX(t1, t - s);
  }
  if (t0 > t1) { // one ball: its centre, and as far as it must reach
    double centre[3];
    for (int i = 0; i < 3; i++) centre[i] = o[i] + axis[i] * (t0 + t1) / 2;
    r = 0;
    for (size_t i = 0; i < n; i++) r = MAX(r, sqrt(ball_gap(&b[i], centre)) + b[i].r);
    return (Capsule){{centre[0], centre[1], centre[2]}, {0, 0, 0}, r};
  }
  Capsule c = {.r = r};
  for (int i = 0; i < 3; i++) c.a[i] = o[i] + t0 * axis[i], c.d[i] = (t1 - t0) * axis[i];
  return c;
}

size_t capsule_balls(const Capsule *c, Ball *b)
{
  if (c->r < 0) return 0;
  b[0] = (Ball){{c->a[0], c->a[1], c->a[2]}, c->r};
  b[1] = (Ball){{c->a[0] + c->d[0], c->a[1] + c->d[1], c->a[2] + c->d[2]}, c->r};
  return 2;
}
