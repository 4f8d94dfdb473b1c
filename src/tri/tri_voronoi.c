// tri_voronoi.c - the Voronoi diagram as the dual of a Delaunay triangulation, cut to a rectangle
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri.h"

#include <math.h>

// Sides of the rectangle counterclockwise from the lower one; side k ends in corner k, which is node k.
enum { LOWER, RIGHT, UPPER, LEFT, NO_SIDE };

typedef struct {
  const Tri *m;
  double lo[2], hi[2];
  uint32_t *class_of;  // nt: the triangle that stands for all with the same circle
  uint32_t *node_of;   // nt: node of the centre of a class that is in the rectangle, or NONE
  uint32_t *end;       // 2 * 3 nt: nodes in which the Voronoi edge across a half-edge begins and ends, or NONE. The one
                       // across e runs from the centre on its right to the one on its left
  DoubleVec xy;
  Vec(uint8_t) side;   // of each node
} Voronoi;

static uint32_t add_node(Voronoi *d, double x, double y, uint8_t side)
{
  vec_push(&d->xy, x);
  vec_push(&d->xy, y);
  vec_push(&d->side, side);
  return (uint32_t)d->side.len - 1;
}

static bool is_finite_edge(const Tri *m, EdgeId e) { return tri_org(m, e) != TRI_INF && tri_dest(m, e) != TRI_INF; }

static bool has_circle(const Tri *m, TriId t) { return !tri_is_free(m, t) && !tri_is_ghost(m, t); }

static uint32_t find_class(Voronoi *d, TriId t)
{
  while (d->class_of[t] != t) t = d->class_of[t] = d->class_of[d->class_of[t]];
  return t;
}

// Neighbours whose four points are on one circle, exactly, share their centre: that of the lowest triangle.
static void join_circles(Voronoi *d)
{
  const Tri *m = d->m;
  for (TriId t = 0; t < m->nt; t++) d->class_of[t] = t;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    EdgeId f = m->twin[e];
    if (!has_circle(m, tri_of(e)) || f < e || !has_circle(m, tri_of(f))) continue;
    const uint32_t *v = m->vert + 3 * (size_t)tri_of(e);
    if (incircle(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), tri_xy(m, tri_apex(m, f))) != 0) continue;
    uint32_t a = find_class(d, tri_of(e)), b = find_class(d, tri_of(f));
    d->class_of[MAX(a, b)] = MIN(a, b);
  }
}

// Circumcentre of a, b, c, relative to a for accuracy.
static void circumcentre(const double *a, const double *b, const double *c, double *o)
{
  double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
  double bl = bx * bx + by * by, cl = cx * cx + cy * cy, d = 2 * (bx * cy - by * cx);
  o[0] = a[0] + (cy * bl - by * cl) / d;
  o[1] = a[1] + (bx * cl - cx * bl) / d;
}

static void place_centres(Voronoi *d)
{
  const Tri *m = d->m;
  for (TriId t = 0; t < m->nt; t++) {
    d->node_of[t] = NONE;
    if (!has_circle(m, t) || find_class(d, t) != t) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    double c[2];
    circumcentre(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), c);
    if (c[0] > d->lo[0] && c[0] < d->hi[0] && c[1] > d->lo[1] && c[1] < d->hi[1]) d->node_of[t] = add_node(d, c[0], c[1], NO_SIDE);
  }
}

// Where on the bisector of half-edge e, mid + t n with n its left normal, the centre left of it is: half the cotangent of the
// angle at the apex; infinity beside a ghost.
static double centre_on_bisector(const Tri *m, EdgeId e)
{
  if (tri_apex(m, e) == TRI_INF) return INFINITY;
  const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e)), *c = tri_xy(m, tri_apex(m, e));
  double ax = a[0] - c[0], ay = a[1] - c[1], bx = b[0] - c[0], by = b[1] - c[1];
  return (ax * bx + ay * by) / (2 * (ax * by - ay * bx));
}

// The part of the bisector p + t n that is in the rectangle, and the sides through which it enters and leaves.
static void cut(const Voronoi *d, const double p[2], const double n[2], double t[2], uint8_t side[2])
{
  t[0] = -INFINITY, t[1] = INFINITY;
  side[0] = side[1] = NO_SIDE;
  for (int k = 0; k < 2; k++) {
    if (n[k] == 0) {
      if (p[k] < d->lo[k] || p[k] > d->hi[k]) t[1] = -INFINITY;
      continue;
    }
    double low = (d->lo[k] - p[k]) / n[k], high = (d->hi[k] - p[k]) / n[k];
    uint8_t at_low = k == 0 ? LEFT : LOWER, at_high = k == 0 ? RIGHT : UPPER;
    bool up = n[k] > 0;
    double enter = up ? low : high, leave = up ? high : low;
    if (enter > t[0]) t[0] = enter, side[0] = up ? at_low : at_high;
    if (leave < t[1]) t[1] = leave, side[1] = up ? at_high : at_low;
  }
}

static uint32_t node_on_side(Voronoi *d, const double p[2], const double n[2], double t, uint8_t side)
{
  double x = fmin(fmax(p[0] + t * n[0], d->lo[0]), d->hi[0]), y = fmin(fmax(p[1] + t * n[1], d->lo[1]), d->hi[1]);
  switch (side) {
  case LOWER: y = d->lo[1]; break;
  case RIGHT: x = d->hi[0]; break;
  case UPPER: y = d->hi[1]; break;
  default: x = d->lo[0]; break;
  }
  return add_node(d, x, y, side);
}

// Ends of the Voronoi edge across e. An end is the centre beside e if that is in the rectangle, else where the bisector
// meets a side, else there is none.
static void cut_edge(Voronoi *d, EdgeId e)
{
  const Tri *m = d->m;
  EdgeId f = m->twin[e];
  TriId left = tri_of(e), right = tri_of(f);
  uint32_t *end = d->end + 2 * (size_t)e;
  bool both = has_circle(m, left) && has_circle(m, right);
  if (both && find_class(d, left) == find_class(d, right)) return; // of no length
  uint32_t a = has_circle(m, right) ? d->node_of[find_class(d, right)] : NONE;
  uint32_t b = has_circle(m, left) ? d->node_of[find_class(d, left)] : NONE;
  if (a == NONE || b == NONE) {
    const double *p = tri_xy(m, tri_org(m, e)), *q = tri_xy(m, tri_dest(m, e));
    double mid[2] = {p[0] / 2 + q[0] / 2, p[1] / 2 + q[1] / 2}, n[2] = {p[1] - q[1], q[0] - p[0]}, t[2];
    uint8_t side[2];
    cut(d, mid, n, t, side);
    if (a == NONE && b == NONE && !(fmax(t[0], -centre_on_bisector(m, f)) < fmin(t[1], centre_on_bisector(m, e)))) return;
    if (a == NONE) a = node_on_side(d, mid, n, t[0], side[0]);
    if (b == NONE) b = node_on_side(d, mid, n, t[1], side[1]);
  }
  end[0] = a, end[1] = b;
}

// Along the frame from node a, where the cell leaves the rectangle, to b, where it comes back: the corners between.
static void follow_frame(const Voronoi *d, uint32_t a, uint32_t b, U32Vec *corners)
{
  uint8_t from = d->side.data[a], to = d->side.data[b];
  const double *p = d->xy.data + 2 * (size_t)a, *q = d->xy.data + 2 * (size_t)b;
  uint32_t along = from % 2; // lower and upper sides run along x
  bool ahead = from == LOWER || from == RIGHT ? q[along] >= p[along] : q[along] <= p[along];
  if (from == to && ahead) return;
  do {
    vec_push(corners, from);
    from = (from + 1) % 4;
  } while (from != to);
}

static void add_corner(U32Vec *corners, size_t first, uint32_t node)
{
  if (corners->len == first || corners->data[corners->len - 1] != node) vec_push(corners, node);
}

// The cell of the origin of `first`, counterclockwise.
static void add_cell(const Voronoi *d, EdgeId first, U32Vec *corners)
{
  const Tri *m = d->m;
  size_t begin = corners->len;
  EdgeId e = first;
  do {
    bool turned = e > m->twin[e];
    const uint32_t *end = d->end + 2 * (size_t)(turned ? m->twin[e] : e);
    if (is_finite_edge(m, e) && end[0] != NONE) {
      uint32_t from = end[turned], to = end[!turned];
      if (corners->len > begin && corners->data[corners->len - 1] != from)
        follow_frame(d, corners->data[corners->len - 1], from, corners);
      add_corner(corners, begin, from);
      add_corner(corners, begin, to);
    }
    e = tri_ccw(m, e);
  } while (e != first);
  if (corners->len == begin) {
    for (uint32_t k = 0; k < 4; k++) vec_push(corners, k);
  } else if (corners->data[begin] == corners->data[corners->len - 1]) corners->len--;
  else follow_frame(d, corners->data[corners->len - 1], corners->data[begin], corners);
}

static void frame(Voronoi *d)
{
  add_node(d, d->hi[0], d->lo[1], LOWER);
  add_node(d, d->hi[0], d->hi[1], RIGHT);
  add_node(d, d->lo[0], d->hi[1], UPPER);
  add_node(d, d->lo[0], d->lo[1], LEFT);
}

void tri_voronoi(const Tri *m, const double lo[2], const double hi[2], TriVoronoi *out)
{
  size_t ne = 3 * (size_t)m->nt;
  Voronoi d = {.m = m, .lo = {lo[0], lo[1]}, .hi = {hi[0], hi[1]}};
  d.class_of = mem_alloc(m->nt * sizeof *d.class_of);
  d.node_of = mem_alloc(m->nt * sizeof *d.node_of);
  d.end = mem_alloc(2 * ne * sizeof *d.end);
  EdgeId *at = mem_alloc(m->nv * sizeof *at);
  for (VertId v = 0; v < m->nv; v++) at[v] = NONE;
  for (size_t i = 0; i < 2 * ne; i++) d.end[i] = NONE;
  frame(&d);
  join_circles(&d);
  place_centres(&d);
  for (EdgeId e = 0; e < ne; e++) {
    if (tri_is_free(m, tri_of(e)) || !is_finite_edge(m, e)) continue;
    at[tri_org(m, e)] = e;
    if (e < m->twin[e]) cut_edge(&d, e);
  }
  U32Vec corners = {0};
  out->start = mem_alloc(((size_t)m->nv + 1) * sizeof *out->start);
  for (VertId v = 0; v < m->nv; v++) {
    out->start[v] = (uint32_t)corners.len;
    if (at[v] != NONE) add_cell(&d, at[v], &corners);
    else if (m->nv == 1) for (uint32_t k = 0; k < 4; k++) vec_push(&corners, k);
  }
  out->start[m->nv] = (uint32_t)corners.len;
  out->corners = corners.data;
  out->xy = d.xy.data;
  out->nnode = (uint32_t)d.side.len;
  vec_free(&d.side);
  free(at);
  free(d.end);
  free(d.node_of);
  free(d.class_of);
}

void tri_voronoi_free(TriVoronoi *v)
{
  free(v->xy);
  free(v->start);
  free(v->corners);
}
