// cones.c - lower envelope of equal cones by branch and bound
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/cones.h"

#include "base/mem.h"
#include "geom/hilbert.h"

enum { LEAF = 4, MAX_LEVELS = 40 };

typedef struct {
  Vec3 p;
  double h;
} Apex;

typedef struct {
  double lo[3], hi[3], h; // box, least value in it
} Bound;

struct Cones {
  Apex *apex;
  size_t n, leaves;
  Bound *node; // 1 is the root, children of i are 2i and 2i+1
  double slope;
};

static void include(Bound *a, const Bound *b)
{
  for (int i = 0; i < 3; i++) {
    a->lo[i] = MIN(a->lo[i], b->lo[i]);
    a->hi[i] = MAX(a->hi[i], b->hi[i]);
  }
  a->h = MIN(a->h, b->h);
}

Cones *cones_new(const Vec3 *p, const double *h, size_t n, double slope)
{
  Cones *c = mem_zalloc(sizeof *c);
  c->n = n;
  c->slope = slope;
  c->apex = mem_alloc((n + 1) * sizeof *c->apex);
  double *xy = mem_alloc((2 * n + 1) * sizeof *xy);
  uint32_t *order = mem_alloc((n + 1) * sizeof *order);
  for (size_t i = 0; i < n; i++) xy[2 * i] = p[i].x, xy[2 * i + 1] = p[i].y;
  if (n) hilbert_order(xy, n, order);
  for (size_t i = 0; i < n; i++) c->apex[i] = (Apex){p[order[i]], h[order[i]]};
  free(xy);
  free(order);
  for (c->leaves = 1; c->leaves * LEAF < n;) c->leaves *= 2;
  c->node = mem_alloc(2 * c->leaves * sizeof *c->node);
  for (size_t k = 0; k < c->leaves; k++) {
    Bound b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, INFINITY};
    for (size_t i = LEAF * k; i < MIN(LEAF * (k + 1), n); i++) {
      Vec3 q = c->apex[i].p;
      Bound one = {{q.x, q.y, q.z}, {q.x, q.y, q.z}, c->apex[i].h};
      include(&b, &one);
    }
    c->node[c->leaves + k] = b;
  }
  for (size_t k = c->leaves - 1; k > 0; k--) {
    c->node[k] = c->node[2 * k];
    include(&c->node[k], &c->node[2 * k + 1]);
  }
  return c;
}

void cones_free(Cones *c)
{
  if (!c) return;
  free(c->apex);
  free(c->node);
  free(c);
}

static double bound_at(const Bound *b, const double p[3], double slope)
{
  double sum = 0;
  for (int i = 0; i < 3; i++) {
    double d = MAX(MAX(b->lo[i] - p[i], p[i] - b->hi[i]), 0);
    sum += d * d;
  }
  return b->h + slope * sqrt(sum);
}

double cones_at(const Cones *c, Vec3 p, double limit)
{
  double at[3] = {p.x, p.y, p.z}, best = limit;
  struct {
    uint32_t node;
    double bound;
  } stack[2 * MAX_LEVELS];
  int top = 0;
  stack[top].node = 1, stack[top++].bound = bound_at(&c->node[1], at, c->slope);
  while (top) {
    uint32_t k = stack[--top].node;
    if (!(stack[top].bound < best)) continue;
    while (k < c->leaves) {
      double l = bound_at(&c->node[2 * k], at, c->slope), r = bound_at(&c->node[2 * k + 1], at, c->slope);
      bool left = l <= r;
      double far = left ? r : l, near = left ? l : r;
      if (far < best) stack[top].node = 2 * k + left, stack[top++].bound = far;
      if (!(near < best)) break;
      k = 2 * k + !left;
    }
    if (k < c->leaves) continue;
    size_t first = LEAF * (k - c->leaves), end = MIN(first + LEAF, c->n);
    for (size_t i = first; i < end; i++)
      best = fmin(best, c->apex[i].h + c->slope * vec3_distance(c->apex[i].p, p));
  }
  return best;
}
