// tri_delaunay.c - refinement by circumcentres of the triangles of the largest adimensional size
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "geom/hilbert.h"
#include "tri/refine_int.h"

#include <string.h>

enum { NKEYS = 250 };

// In large faces the triangles that are not far from their size wait by region, and one region is finished before the next: the last
// sweeps, in which 15 of 16 points are placed, then stay in the caches. Regions are cells of a grid along a Hilbert curve.
enum { LOCAL = 2, REGION = 1 << 14 }; // keys, two octaves each, that wait by region; triangles of a region, about
typedef struct {
  U32Vec (*stack)[LOCAL]; // by region; NULL: the face is small
  uint32_t *at;           // by cell: its region
  uint32_t side, now;     // cells on a side of the grid; the region that is being finished
  double lo[2], scale;    // a corner of the face, and cells to the unit
} Regions;

typedef struct {
  Refiner *r;
  double limit;  // a triangle is refined while its adimensional size, sqrt(3) R / h [book eq. 4.19], is above this
  uint8_t *key;  // by triangle: 1 + the key it waits with, 0 if it does not
  uint32_t cap;
  int top;       // no stack above this one has entries
  U32Vec stack[NKEYS];
  Regions regions;
} Queue;

static void make_regions(Regions *g, const Refiner *r)
{
  const Tri *m = r->m;
  if (r->expected < REFINE_LARGE) return;
  g->side = 1;
  while ((double)g->side * g->side * REGION < r->expected) g->side *= 2;
  double hi[2] = {-INFINITY, -INFINITY};
  g->lo[0] = g->lo[1] = INFINITY;
  for (VertId v = 0; v < m->nv; v++)
    for (int i = 0; i < 2; i++) {
      double x = tri_xy(m, v)[i];
      g->lo[i] = fmin(g->lo[i], x), hi[i] = fmax(hi[i], x);
    }
  g->scale = g->side / fmax(hi[0] - g->lo[0], hi[1] - g->lo[1]);
  size_t n = (size_t)g->side * g->side;
  g->stack = mem_zalloc(n * sizeof *g->stack);
  g->at = mem_alloc(n * sizeof *g->at);
  double *xy = mem_alloc(2 * n * sizeof *xy);
  uint32_t *order = mem_alloc(n * sizeof *order);
  for (size_t i = 0; i < n; i++) xy[2 * i] = (double)(i % g->side), xy[2 * i + 1] = (double)(i / g->side);
  hilbert_order(xy, n, order);
  for (uint32_t k = 0; k < n; k++) g->at[order[k]] = k;
  free(xy), free(order);
}

// Where a triangle at p waits: in the region there, or in the present one if that is done.
static uint32_t region_at(const Regions *g, const double *p)
{
  uint32_t x = (uint32_t)((p[0] - g->lo[0]) * g->scale), y = (uint32_t)((p[1] - g->lo[1]) * g->scale);
  uint32_t k = g->at[MIN(y, g->side - 1) * g->side + MIN(x, g->side - 1)];
  return MAX(k, g->now);
}

double refine__excess2(const Refiner *r, double limit, TriId t)
{
  const Tri *m = r->m;
  const uint32_t *v = m->vert + 3 * (size_t)t;
  double area2, h = (r->size[v[0]] + r->size[v[1]] + r->size[v[2]]) / 3;
  double x = 3 * metric_radius2(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), &area2) / (limit * limit * h * h);
  if (x > 1 || !r->p->size) return x;
  double g = refine__size_inside(r, t);
  return g < h ? x * (h * h) / (g * g) : x;
}

static void consider(Queue *q, TriId t)
{
  if (t >= q->cap) {
    uint32_t cap = q->r->m->cap_t;
    q->key = mem_realloc(q->key, cap);
    memset(q->key + q->cap, 0, cap - q->cap);
    q->cap = cap;
  }
  double x = refine__excess2(q->r, q->limit, t);
  q->key[t] = 0;
  if (x <= 1) return;
  int k = refine__key(x, 24, NKEYS);
  q->key[t] = (uint8_t)(k + 1);
  if (k < LOCAL && q->regions.stack) {
    const Tri *m = q->r->m;
    vec_push(&q->regions.stack[region_at(&q->regions, tri_xy(m, m->vert[3 * (size_t)t + 2]))][k], t);
    return;
  }
  vec_push(&q->stack[k], t);
  if (k > q->top) q->top = k;
}

// The latest triangle of those that wait in s with that key; NONE if none does.
static TriId latest(Queue *q, U32Vec *s, int key)
{
  while (s->len) {
    TriId t = vec_pop(s);
    if (q->key[t] != key + 1) continue; // the slot holds another triangle by now
    q->key[t] = 0;
    return t;
  }
  return NONE;
}

// The next triangle, the largest (of about equals the latest, which lies near the last one); NONE when there is none.
static TriId take(Queue *q)
{
  TriId t;
  for (; q->top >= 0; q->top--)
    if ((t = latest(q, &q->stack[q->top], q->top)) != NONE) return t;
  Regions *g = &q->regions;
  for (; g->stack && g->now < g->side * g->side; g->now++)
    for (int k = LOCAL - 1; k >= 0; k--) {
      if ((t = latest(q, &g->stack[g->now][k], k)) != NONE) return t;
      vec_free(&g->stack[g->now][k]);
    }
  return NONE;
}

static bool try_point(Queue *q, const double *p, TriId near)
{
  Refiner *r = q->r;
  if (!isfinite(p[0]) || !isfinite(p[1])) return false;
  EdgeId blocked;
  TriId t = refine__walk(r->m, p, near, &blocked);
  if (t == NONE) return false;
  if (!refine__cavity(r, p, t, true)) return false;
  double carried, h = refine__size_at(r, p, t, &carried);
  refine__commit(r, h, carried);
  for (size_t i = 0; i < r->rim.len; i++) consider(q, r->rim.data[i].tri);
  return true;
}

// The circumcentre lies across a segment: halve the longest edge that is not one, if its halves are not too short.
static bool try_middle(Queue *q, TriId t)
{
  const Tri *m = q->r->m;
  EdgeId best = NONE;
  double longest = 1.4;
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
    VertId a = tri_org(m, e), b = tri_dest(m, e);
    double len = metric_length(tri_xy(m, a), tri_xy(m, b), q->r->size[a], q->r->size[b]);
    if (tri_is_segment(m, e) || len <= longest) continue;
    longest = len, best = e;
  }
  if (best == NONE) return false;
  const double *a = tri_xy(m, tri_org(m, best)), *b = tri_xy(m, tri_dest(m, best));
  double p[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  return try_point(q, p, t);
}

void refine__delaunay(Refiner *r, double limit)
{
  Tri *m = r->m;
  Queue q = {.r = r, .limit = limit, .top = -1};
  uint32_t n = m->nt;
  make_regions(&q.regions, r);
  for (TriId t = 0; t < n; t++)
    if (!(m->flag[t] & REFINE_SMALL) && tri_is_inside(m, t)) consider(&q, t);
  TriId t;
  while ((t = take(&q)) != NONE && refine__go_on(r)) {
    const uint32_t *v = m->vert + 3 * (size_t)t;
    double p[2];
    metric_centre(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), p);
    if (!try_point(&q, p, t)) try_middle(&q, t);
  }
  for (int k = 0; k < NKEYS; k++) vec_free(&q.stack[k]);
  for (uint32_t k = 0; q.regions.stack && k < q.regions.side * q.regions.side; k++)
    for (int i = 0; i < LOCAL; i++) vec_free(&q.regions.stack[k][i]);
  free(q.key), free(q.regions.stack), free(q.regions.at);
}
