// nearest.c - a complete binary tree of capsules over pieces in Hilbert order, searched depth first from the best leaf known
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/nearest.h"

#include "base/mem.h"
#include "geom/hilbert.h"

enum { LEAF = 4, MAX_LEVELS = 40, PIECES_PER_START = 4 };

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

// A ball; for the ends of pieces and of capsules.
typedef struct {
  double c[3], r;
} Ball;

// All places within r of the segment from a to a + d: along a chain of pieces much tighter than a box.
typedef struct {
  double a[3], d[3], r;
} Capsule;

// The capsules of both children of a node in one cache line. Rounding of a and d is in r, which is negative where there is no
// piece; inverse is 1 / |d|^2.
typedef struct {
  float a[2][3], d[2][3], inverse[2], r[2];
} Pair;

// A cell of a grid over the pieces: the nearest leaf to its centre, and how far it is. A search without a good hint starts there.
typedef struct {
  uint32_t leaf;
  float distance;
} Start;

struct Nearest {
  NearestOnPiece on_piece;
  void *ctx;
  Vec(Piece) piece;
  Vec(Origin) origin;
  void *block;     // of memory, with the nodes on cache lines
  Pair *node;      // 1 is the root, children of i are 2i and 2i+1; leaf k is node leaves + k
  size_t leaves;
  double zero2;    // a squared distance that is rounding only
  Start *start;    // rows of cells of this size from origin; NULL: too few pieces
  double origin_x, origin_y, middle_z, cell;
  uint32_t columns, rows;
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
  free(n->block);
  free(n->start);
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

// A narrow capsule around n > 0 balls: its axis runs along their longest extent and through the middle of their width in the plane,
// and is as short as the width allows.
static Capsule fit(const Ball *b, size_t n)
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

enum { FIT_PIECES = 256 }; // above that capsules are fitted to those of the children

static size_t piece_balls(const Nearest *n, size_t first, size_t end, Ball *b)
{
  size_t k = 0;
  for (size_t i = first; i < end; i++) {
    const Piece *p = &n->piece.data[i];
    b[k++] = (Ball){{p->a.x, p->a.y, p->a.z}, p->bulge};
    b[k++] = (Ball){{p->a.x + p->d.x, p->a.y + p->d.y, p->a.z + p->d.z}, p->bulge};
  }
  return k;
}

static size_t capsule_balls(const Capsule *c, Ball *b)
{
  if (c->r < 0) return 0;
  b[0] = (Ball){{c->a[0], c->a[1], c->a[2]}, c->r};
  b[1] = (Ball){{c->a[0] + c->d[0], c->a[1] + c->d[1], c->a[2] + c->d[2]}, c->r};
  return 2;
}

// Rounded to floats; r grows by what that moves the axis and by the rounding of the search.
static void store(Pair *to, int c, const Capsule *from)
{
  double moved = 0, l2 = 0, most = 0;
  for (int i = 0; i < 3; i++) {
    float a = to->a[c][i] = (float)from->a[i], d = to->d[c][i] = (float)from->d[i];
    double e = fabs((double)a - from->a[i]) + fabs((double)d - from->d[i]);
    moved += e;
    l2 += (double)d * (double)d;
    most = MAX(most, fabs(from->a[i]) + fabs(from->d[i]));
  }
  bool tiny = l2 < 1e-30; // its inverse may be no float: the foot is then taken at a
  to->inverse[c] = tiny ? 0 : (float)(1 / l2);
  if (tiny) moved += sqrt(l2);
  // The axis ends at most `moved` away; an inverse rounded to a float misses the foot by 6e-8 of the length.
  to->r[c] = from->r < 0 ? -1 : (float)((from->r + moved + 1e-7 * sqrt(l2) + 1e-14 * most) * (1 + 1e-6));
}

// Squared distance from p to the axis of a child's capsule.
static inline double axis_distance2(const Pair *b, int c, Vec3 p)
{
  Vec3 r = {p.x - (double)b->a[c][0], p.y - (double)b->a[c][1], p.z - (double)b->a[c][2]};
  Vec3 d = {(double)b->d[c][0], (double)b->d[c][1], (double)b->d[c][2]};
  double t = vec3_dot(r, d) * (double)b->inverse[c];
  t = MIN(MAX(t, 0), 1);
  Vec3 off = vec3_sub(r, vec3_scale(t, d));
  return vec3_dot(off, off);
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

static Vec3 start_centre(const Nearest *n, uint32_t column, uint32_t row)
{
  return (Vec3){n->origin_x + (column + 0.5) * n->cell, n->origin_y + (row + 0.5) * n->cell, n->middle_z};
}

static uint32_t clamped(double v, uint32_t count)
{
  return v > 0 ? v < count ? (uint32_t)v : count - 1 : 0;
}

// Whether all of a leaf is farther than `reach` from p.
static bool leaf_is_beyond(const Nearest *n, uint32_t leaf, Vec3 p, double reach)
{
  size_t k = n->leaves + leaf;
  const Pair *b = &n->node[k / 2];
  reach += (double)b->r[k % 2];
  return axis_distance2(b, (int)(k % 2), p) > reach * reach;
}

// The leaf to look at first: the hint if p is in its capsule; else of the hint and of the cell of p the one that is surely nearer.
static uint32_t first_leaf(const Nearest *n, Vec3 p, uint32_t hint)
{
  if (!n->start) return hint < n->leaves ? hint : n->leaves == 1 ? 0 : NONE;
  if (hint < n->leaves && !leaf_is_beyond(n, hint, p, 0)) return hint;
  uint32_t column = clamped((p.x - n->origin_x) / n->cell, n->columns), row = clamped((p.y - n->origin_y) / n->cell, n->rows);
  const Start *s = &n->start[(size_t)row * n->columns + column];
  if (hint >= n->leaves) return s->leaf;
  double reach = vec3_length(vec3_sub(p, start_centre(n, column, row))) + (double)s->distance;
  return leaf_is_beyond(n, hint, p, reach) ? s->leaf : hint;
}

// Capsules are compared by their axes, d^2 < (reach + r)^2, which spares a root in each.
NearestHit nearest_query(const Nearest *n, Vec3 p, double limit, uint32_t leaf)
{
  Best best = {limit * limit, NONE, NONE, 0};
  uint32_t skip = first_leaf(n, p, leaf);
  if (skip != NONE) try_leaf(n, skip, p, &best);
  double reach = best.piece == NONE ? limit : sqrt(best.d2);
  struct {
    uint32_t node;
    float r;
    double d2;
  } stack[2 * MAX_LEVELS];
  int top = 0;
  if (n->leaves > 1) stack[top].node = 1, stack[top].r = INFINITY, stack[top++].d2 = 0;
  while (top && best.d2 > n->zero2) {
    uint32_t k = stack[--top].node;
    double least = reach + (double)stack[top].r;
    if (stack[top].d2 >= least * least) continue;
    // Down to a leaf, keeping the farther children for later.
    while (k < n->leaves) {
      const Pair *b = &n->node[k];
      double l = axis_distance2(b, 0, p), r = axis_distance2(b, 1, p);
      double rl = reach + (double)b->r[0], rr = reach + (double)b->r[1];
      bool in_l = !(l >= rl * rl) && !(b->r[0] < 0), in_r = !(r >= rr * rr) && !(b->r[1] < 0); // nan, beyond floats: look
      if (in_l && in_r) {
        int far = l <= r;
        stack[top].node = 2 * k + (uint32_t)far, stack[top].r = b->r[far], stack[top++].d2 = far ? r : l;
        k = 2 * k + !far;
      } else if (in_l || in_r) {
        k = 2 * k + in_r;
      } else {
        break;
      }
    }
    if (k < n->leaves || k - n->leaves == skip) continue;
    double before = best.d2;
    try_leaf(n, (uint32_t)(k - n->leaves), p, &best);
    if (best.d2 < before) reach = sqrt(best.d2);
  }
  if (best.piece == NONE) return (NearestHit){limit, NONE, 0, leaf};
  const Origin *o = &n->origin.data[best.piece];
  // Of a straight piece u is the fraction of its length.
  double u = n->piece.data[best.piece].bulge > 0 ? best.u : o->u0 + best.u * (o->u1 - o->u0);
  return (NearestHit){sqrt(best.d2), o->curve, u, best.leaf};
}

// ---- building the tree --------------------------------------------------------------------------------------------------------

// A grid of cells, each with the leaf nearest to its centre.
static void make_starts(Nearest *n)
{
  size_t count = n->piece.len;
  double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY}, most = 0;
  for (size_t i = 0; i < count; i++) {
    const Piece *p = &n->piece.data[i];
    double at[3] = {p->a.x + p->d.x / 2, p->a.y + p->d.y / 2, p->a.z + p->d.z / 2};
    for (int k = 0; k < 3; k++) lo[k] = MIN(lo[k], at[k]), hi[k] = MAX(hi[k], at[k]);
  }
  for (int k = 0; count && k < 3; k++) most = MAX(most, MAX(fabs(lo[k]), fabs(hi[k])));
  n->zero2 = (4e-16 * most) * (4e-16 * most);
  double w = hi[0] - lo[0], h = hi[1] - lo[1], longer = MAX(w, h), shorter = MIN(w, h), cells = (double)count / PIECES_PER_START;
  // As many square cells as wanted, if need be in one row.
  double cell = MAX(sqrt(longer * shorter / cells), longer / cells);
  if (n->leaves < 4 || !(cell > 0) || !isfinite(longer / cell)) return;
  n->origin_x = lo[0], n->origin_y = lo[1], n->middle_z = (lo[2] + hi[2]) / 2, n->cell = cell;
  n->columns = (uint32_t)(w / cell) + 1, n->rows = (uint32_t)(h / cell) + 1;
  Start *start = mem_alloc((size_t)n->columns * n->rows * sizeof *start);
  uint32_t leaf = NONE;
  for (size_t k = 0; k < (size_t)n->columns * n->rows; k++) { // to and fro, so that the last leaf is a good hint
    uint32_t row = (uint32_t)(k / n->columns), i = (uint32_t)(k % n->columns), column = row % 2 ? n->columns - 1 - i : i;
    NearestHit hit = nearest_query(n, start_centre(n, column, row), INFINITY, leaf);
    leaf = hit.leaf;
    start[(size_t)row * n->columns + column] = (Start){leaf, (float)hit.distance};
  }
  n->start = start;
}

void nearest_build(Nearest *n)
{
  size_t count = n->piece.len, width = LEAF;
  sort_pieces(n);
  for (n->leaves = 1; n->leaves * LEAF < count;) n->leaves *= 2;
  Capsule *capsule = mem_alloc(2 * n->leaves * sizeof *capsule);
  Ball ball[2 * FIT_PIECES];
  for (size_t level = n->leaves; level > 0; level /= 2, width *= 2) {
    for (size_t k = level; k < 2 * level; k++) {
      size_t first = width * (k - level), end = MIN(first + width, count), nball;
      if (first >= count) nball = 0;
      else if (width <= FIT_PIECES) nball = piece_balls(n, first, end, ball);
      else nball = capsule_balls(&capsule[2 * k], ball), nball += capsule_balls(&capsule[2 * k + 1], ball + nball);
      capsule[k] = nball ? fit(ball, nball) : (Capsule){.r = -1};
    }
  }
  n->block = mem_alloc((n->leaves + 1) * sizeof *n->node);
  n->node = (Pair *)(((uintptr_t)n->block + sizeof *n->node - 1) / sizeof *n->node * sizeof *n->node);
  for (size_t k = n->leaves - 1; k > 0; k--)
    for (int c = 0; c < 2; c++) store(&n->node[k], c, &capsule[2 * k + (size_t)c]);
  free(capsule);
  make_starts(n);
}

// ---- rays -----------------------------------------------------------------------------------------------------------------

// Whether the ray from p in direction dir, up to limit, may meet a capsule in the plane of dir and side.
static bool ray_meets(const Pair *b, int c, Vec3 p, Vec3 dir, Vec3 side, double limit)
{
  Vec3 r = {(double)b->a[c][0] - p.x, (double)b->a[c][1] - p.y, (double)b->a[c][2] - p.z};
  Vec3 d = {(double)b->d[c][0], (double)b->d[c][1], (double)b->d[c][2]};
  double y0 = vec3_dot(r, side), y1 = y0 + vec3_dot(d, side), x0 = vec3_dot(r, dir), x1 = x0 + vec3_dot(d, dir);
  double reach = (double)b->r[c];
  return MIN(y0, y1) <= reach && MAX(y0, y1) >= -reach && MIN(x0, x1) - reach <= limit && MAX(x0, x1) >= -reach;
}

NearestHit nearest_ray(const Nearest *n, Vec3 p, Vec3 dir, Vec3 side, double from, double limit)
{
  double best = limit;
  NearestHit hit = {limit, NONE, 0, NONE};
  uint32_t stack[2 * MAX_LEVELS];
  int top = 0;
  stack[top++] = 1;
  while (top) {
    uint32_t k = stack[--top];
    if (k < n->leaves) {
      for (int c = 0; c < 2; c++)
        if (ray_meets(&n->node[k], c, p, dir, side, best)) stack[top++] = 2 * k + (uint32_t)c;
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
