// nearest.c - a complete binary tree of boxes over pieces in Hilbert order, searched depth first, nearer child first
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/nearest.h"

#include "base/mem.h"
#include "geom/hilbert.h"

enum { LEAF = 4, MAX_LEVELS = 40 };

// What the search reads, one cache line; and the rest.
typedef struct {
  Vec3 a, d;       // begin and difference
  double inverse;  // 1 / |d|^2, 0 for a point
  double bulge;
} Piece;

typedef struct {
  double u0, u1;
  uint32_t curve;
} Origin;

typedef struct {
  double lo[3], hi[3];
} Box;

// The boxes of both children of a node, rounded outwards, in one cache line.
typedef struct {
  float lo[2][3], hi[2][3];
} Pair;

struct Nearest {
  NearestOnPiece on_piece;
  void *ctx;
  Vec(Piece) piece;
  Vec(Origin) origin;
  Pair *node;      // 1 is the root, children of i are 2i and 2i+1; leaf k is node leaves + k
  size_t leaves;
  double zero2;    // a squared distance that is rounding only
};

Nearest *nearest_new(NearestOnPiece on_piece, void *ctx)
{
  Nearest *n = mem_zalloc(sizeof *n);
  n->on_piece = on_piece;
  n->ctx = ctx;
  return n;
}

void nearest_free(Nearest *n)
{
  if (!n) return;
  vec_free(&n->piece);
  vec_free(&n->origin);
  free(n->node);
  free(n);
}

size_t nearest_count(const Nearest *n)
{
  return n->piece.len;
}

void nearest_add(Nearest *n, Vec3 a, Vec3 b, double bulge, uint32_t curve, double u0, double u1)
{
  Vec3 d = vec3_sub(b, a);
  double l2 = vec3_dot(d, d);
  vec_push(&n->piece, ((Piece){a, d, l2 > 0 ? 1 / l2 : 0, bulge}));
  vec_push(&n->origin, ((Origin){u0, u1, curve}));
}

static void include(Box *b, const double *lo, const double *hi)
{
  for (int i = 0; i < 3; i++) {
    b->lo[i] = MIN(b->lo[i], lo[i]);
    b->hi[i] = MAX(b->hi[i], hi[i]);
  }
}

static Box box_of(const Piece *p)
{
  double a[3] = {p->a.x, p->a.y, p->a.z}, d[3] = {p->d.x, p->d.y, p->d.z};
  Box b;
  for (int i = 0; i < 3; i++) {
    b.lo[i] = MIN(a[i], a[i] + d[i]) - p->bulge;
    b.hi[i] = MAX(a[i], a[i] + d[i]) + p->bulge;
  }
  return b;
}

static void sort_pieces(Nearest *n)
{
  size_t count = n->piece.len;
  double *mid = mem_alloc(2 * (count + 1) * sizeof *mid);
  uint32_t *order = mem_alloc((count + 1) * sizeof *order);
  for (size_t i = 0; i < count; i++) {
    const Piece *p = &n->piece.data[i];
    mid[2 * i] = p->a.x + p->d.x / 2;
    mid[2 * i + 1] = p->a.y + p->d.y / 2;
  }
  if (count) hilbert_order(mid, count, order);
  Piece *piece = mem_alloc((count + 1) * sizeof *piece);
  Origin *origin = mem_alloc((count + 1) * sizeof *origin);
  for (size_t i = 0; i < count; i++) {
    piece[i] = n->piece.data[order[i]];
    origin[i] = n->origin.data[order[i]];
  }
  free(n->piece.data);
  free(n->origin.data);
  n->piece.data = piece;
  n->origin.data = origin;
  n->piece.cap = n->origin.cap = count + 1;
  free(mid);
  free(order);
}

static float round_down(double v)
{
  float f = (float)v;
  return (double)f > v ? nextafterf(f, -INFINITY) : f;
}

static float round_up(double v)
{
  float f = (float)v;
  return (double)f < v ? nextafterf(f, INFINITY) : f;
}

void nearest_build(Nearest *n)
{
  size_t count = n->piece.len;
  sort_pieces(n);
  for (n->leaves = 1; n->leaves * LEAF < count;) n->leaves *= 2;
  Box *box = mem_alloc(2 * n->leaves * sizeof *box);
  for (size_t k = 0; k < n->leaves; k++) {
    Box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = LEAF * k; i < MIN(LEAF * (k + 1), count); i++) {
      Box p = box_of(&n->piece.data[i]);
      include(&b, p.lo, p.hi);
    }
    box[n->leaves + k] = b;
  }
  n->node = mem_alloc(n->leaves * sizeof *n->node);
  for (size_t k = n->leaves - 1; k > 0; k--) {
    box[k] = box[2 * k];
    include(&box[k], box[2 * k + 1].lo, box[2 * k + 1].hi);
    for (int c = 0; c < 2; c++) {
      for (int i = 0; i < 3; i++) {
        n->node[k].lo[c][i] = round_down(box[2 * k + (size_t)c].lo[i]);
        n->node[k].hi[c][i] = round_up(box[2 * k + (size_t)c].hi[i]);
      }
    }
  }
  double most = 0;
  for (int i = 0; count && i < 3; i++) most = MAX(most, MAX(fabs(box[1].lo[i]), fabs(box[1].hi[i])));
  n->zero2 = (4e-16 * most) * (4e-16 * most);
  free(box);
}

// Squared distance from p to the box of a child; infinite for an empty one.
static inline double box_distance2(const Pair *b, int c, const double p[3])
{
  double sum = 0;
  for (int i = 0; i < 3; i++) {
    double d = MAX(MAX((double)b->lo[c][i] - p[i], p[i] - (double)b->hi[c][i]), 0);
    sum += d * d;
  }
  return sum;
}

typedef struct {
  double d2;
  uint32_t piece, leaf;
  double u;
} Best;

static void try_leaf(const Nearest *n, uint32_t leaf, Vec3 p, Best *best)
{
  size_t end = MIN((size_t)LEAF * (leaf + 1), n->piece.len);
  for (size_t i = (size_t)LEAF * leaf; i < end; i++) {
    const Piece *q = &n->piece.data[i];
    Vec3 r = vec3_sub(p, q->a);
    double t = vec3_dot(r, q->d) * q->inverse;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    Vec3 off = vec3_sub(r, vec3_scale(t, q->d));
    double d2 = vec3_dot(off, off), u = t;
    if (q->bulge > 0) {
      double least = sqrt(d2) - q->bulge;
      if (least > 0 && least * least >= best->d2) continue;
      const Origin *o = &n->origin.data[i];
      d2 = n->on_piece(n->ctx, o->curve, o->u0, o->u1, p, &u);
    }
    if (d2 < best->d2) *best = (Best){d2, (uint32_t)i, leaf, u};
  }
}

NearestHit nearest_query(const Nearest *n, Vec3 p, double limit, uint32_t leaf)
{
  Best best = {limit * limit, NONE, NONE, 0};
  double at[3] = {p.x, p.y, p.z};
  uint32_t skip = leaf < n->leaves ? leaf : NONE;
  if (skip != NONE) try_leaf(n, skip, p, &best);
  if (n->leaves == 1 && skip == NONE) try_leaf(n, 0, p, &best);
  struct {
    uint32_t node;
    double d2;
  } stack[2 * MAX_LEVELS];
  int top = 0;
  if (n->leaves > 1 && best.d2 > n->zero2) stack[top].node = 1, stack[top++].d2 = 0;
  while (top && best.d2 > n->zero2) {
    uint32_t k = stack[--top].node;
    if (stack[top].d2 >= best.d2) continue;
    // Down to a leaf, keeping the farther children for later.
    while (k < n->leaves) {
      double l = box_distance2(&n->node[k], 0, at), r = box_distance2(&n->node[k], 1, at);
      bool left = l <= r;
      double far = left ? r : l, near = left ? l : r;
      if (far < best.d2) stack[top].node = 2 * k + left, stack[top++].d2 = far;
      if (near >= best.d2) break;
      k = 2 * k + !left;
    }
    if (k >= n->leaves && k - n->leaves != skip) try_leaf(n, (uint32_t)(k - n->leaves), p, &best);
  }
  if (best.piece == NONE) return (NearestHit){limit, NONE, 0, leaf};
  const Origin *o = &n->origin.data[best.piece];
  // Of a straight piece u is the fraction of its length.
  double u = n->piece.data[best.piece].bulge > 0 ? best.u : o->u0 + best.u * (o->u1 - o->u0);
  return (NearestHit){sqrt(best.d2), o->curve, u, best.leaf};
}

// ---- rays -----------------------------------------------------------------------------------------------------------------

// Whether the ray p + t dir, t in [0, limit], meets the box.
static bool ray_meets(const Pair *b, int c, const double p[3], const double dir[3], double limit)
{
  double t0 = 0, t1 = limit;
  for (int i = 0; i < 3; i++) {
    double lo = (double)b->lo[c][i] - p[i], hi = (double)b->hi[c][i] - p[i];
    if (dir[i] == 0) {
      if (lo > 0 || hi < 0) return false;
      continue;
    }
    t0 = fmax(t0, fmin(lo / dir[i], hi / dir[i]));
    t1 = fmin(t1, fmax(lo / dir[i], hi / dir[i]));
  }
  // Boxes of planar pieces are flat across the plane: a rounding error there must not lose a hit.
  return t0 <= t1 * (1 + 1e-12) + 1e-300;
}

NearestHit nearest_ray(const Nearest *n, Vec3 p, Vec3 dir, Vec3 side, double from, double limit)
{
  double at[3] = {p.x, p.y, p.z}, d[3] = {dir.x, dir.y, dir.z}, best = limit;
  NearestHit hit = {limit, NONE, 0, NONE};
  for (int i = 0; i < 3; i++)
    if (fabs(d[i]) < 1e-14) d[i] = 0;
  uint32_t stack[2 * MAX_LEVELS];
  int top = 0;
  stack[top++] = 1;
  while (top) {
    uint32_t k = stack[--top];
    if (k < n->leaves) {
      for (int c = 0; c < 2; c++)
        if (ray_meets(&n->node[k], c, at, d, best)) stack[top++] = 2 * k + (uint32_t)c;
      continue;
    }
    size_t first = LEAF * (k - n->leaves), end = MIN(first + LEAF, n->piece.len);
    for (size_t i = first; i < end; i++) {
      const Piece *q = &n->piece.data[i];
      Vec3 r = vec3_sub(q->a, p);
      double y0 = vec3_dot(r, side), y1 = y0 + vec3_dot(q->d, side), x0 = vec3_dot(r, dir), x1 = x0 + vec3_dot(q->d, dir);
      if ((y0 > 0 && y1 > 0) || (y0 < 0 && y1 < 0) || y0 == y1) continue;
      double x = x0 + (x1 - x0) * (y0 / (y0 - y1));
      if (x <= from || x >= best) continue;
      best = x;
      const Origin *o = &n->origin.data[i];
      hit = (NearestHit){x, o->curve, o->u0 + (o->u1 - o->u0) * (y0 / (y0 - y1)), k - (uint32_t)n->leaves};
    }
  }
  return hit;
}
