// nearest.c - a complete binary tree of capsules over pieces in Hilbert order, searched depth first from the best leaf known
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/nearest.h"

#include "base/mem.h"
#include "geom/capsule.h"
#include "geom/hilbert.h"

enum { LEAF = 8, MAX_LEVELS = 40, PIECES_PER_START = 4 };

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

// The capsules of both children of a node in one cache line. Rounding of a and d is in r, which is negative where there is no
// piece; inverse is 1 / |d|^2.
typedef struct {
  float a[3][2], d[3][2], inverse[2], r[2]; // [coordinate][child]
} Pair;

enum { ENTRIES = 4 };

// A cell of a grid over the pieces: the nearest leaf to its centre, and how far it is. A search without a good hint starts there. And
// nodes (0: none) below which all is that may be nearest to any place in the circle around the cell: it need not begin at the root.
typedef struct {
  uint32_t leaf;
  float distance;
  uint32_t entry[ENTRIES];
} Start;

struct Nearest {
  NearestOnPiece on_piece;
  void *ctx;
  Vec(Piece) piece;
  Vec(Origin) origin;
  void *block;     // of memory, with the nodes on cache lines
  Pair *node;      // 1 is the root, children of i are 2i and 2i+1; leaf k is node leaves + k
  size_t leaves;
  bool bent;       // some pieces are
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
  n->bent |= bulge > 0;
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

// Rounded to floats; r grows by what that moves the axis and by the rounding of the search.
static void store(Pair *to, int c, const Capsule *from)
{
  double moved = 0, l2 = 0, most = 0;
  for (int i = 0; i < 3; i++) {
    float a = to->a[i][c] = (float)from->a[i], d = to->d[i][c] = (float)from->d[i];
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

// Two lanes. Compilers make branches of a clamp in scalars, and which side of a segment a place is on cannot be predicted.
typedef double V2 __attribute__((vector_size(16)));
typedef int64_t M2 __attribute__((vector_size(16))); // of a comparison: -1 or 0
typedef float F2 __attribute__((vector_size(8)));

static inline V2 clamp01(V2 t)
{
  t = (V2)((M2)t & (t > 0));
  M2 below = t < 1;
  return (V2)(((M2)t & below) | ((M2)(V2){1, 1} & ~below));
}

// Squared distance from p to the axis of a child's capsule.
static inline double axis_distance2(const Pair *b, int c, Vec3 p)
{
  Vec3 r = {p.x - (double)b->a[0][c], p.y - (double)b->a[1][c], p.z - (double)b->a[2][c]};
  Vec3 d = {(double)b->d[0][c], (double)b->d[1][c], (double)b->d[2][c]};
  double t = vec3_dot(r, d) * (double)b->inverse[c];
  t = clamp01((V2){t, t})[0];
  Vec3 off = vec3_sub(r, vec3_scale(t, d));
  return vec3_dot(off, off);
}

static inline V2 lanes(const float *f)
{
  F2 v;
  memcpy(&v, f, sizeof v);
  return __builtin_convertvector(v, V2);
}

// The same of both children.
static inline V2 axis_distances2(const Pair *b, Vec3 p)
{
  V2 dx = lanes(b->d[0]), dy = lanes(b->d[1]), dz = lanes(b->d[2]);
  V2 x = p.x - lanes(b->a[0]), y = p.y - lanes(b->a[1]), z = p.z - lanes(b->a[2]);
  V2 t = clamp01((x * dx + y * dy + z * dz) * lanes(b->inverse));
  x -= t * dx, y -= t * dy, z -= t * dz;
  return x * x + y * y + z * z;
}

typedef struct {
  double d2;
  uint32_t piece, leaf;
  double u;
} Best;

// Of bent pieces the chord is looked at first.
static void try_bent(const Nearest *n, const double *chord2, const double *t, size_t first, size_t end, uint32_t leaf, Vec3 p, Best *best)
{
  for (size_t i = first; i < end; i++) {
    double d2 = chord2[i - first], u = t[i - first], bulge = n->piece.data[i].bulge, least = sqrt(d2) - bulge;
    if (least > 0 && least * least >= best->d2) continue;
    const Origin *o = &n->origin.data[i];
    if (bulge > 0) d2 = n->on_piece(n->ctx, o->curve, o->u0, o->u1, p, &u);
    if (d2 < best->d2) *best = (Best){d2, (uint32_t)i, leaf, u};
  }
}

static void try_leaf(const Nearest *n, uint32_t leaf, Vec3 p, Best *best)
{
  size_t first = (size_t)LEAF * leaf, end = MIN(first + LEAF, n->piece.len), nearest = 0;
  V2 t2[LEAF / 2] = {{0, 0}};
  double t[LEAF], d2[LEAF], least = INFINITY;
  for (size_t i = first; i < end; i++) {
    const Piece *q = &n->piece.data[i];
    t2[(i - first) / 2][(i - first) % 2] = vec3_dot(vec3_sub(p, q->a), q->d) * q->inverse;
  }
  for (size_t k = 0; k < LEAF / 2; k++) t2[k] = clamp01(t2[k]);
  memcpy(t, t2, sizeof t);
  for (size_t i = first; i < end; i++) {
    const Piece *q = &n->piece.data[i];
    Vec3 off = vec3_sub(vec3_sub(p, q->a), vec3_scale(t[i - first], q->d));
    d2[i - first] = vec3_dot(off, off);
  }
  if (n->bent) {
    try_bent(n, d2, t, first, end, leaf, p, best);
    return;
  }
  for (size_t k = 0; k < end - first; k++)
    if (d2[k] < least) least = d2[k], nearest = k;
  if (least < best->d2) *best = (Best){least, (uint32_t)(first + nearest), leaf, t[nearest]};
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

// The cell of p, or the nearest one.
static const Start *start_of(const Nearest *n, Vec3 p, Vec3 *centre)
{
  uint32_t column = clamped((p.x - n->origin_x) / n->cell, n->columns), row = clamped((p.y - n->origin_y) / n->cell, n->rows);
  *centre = start_centre(n, column, row);
  return &n->start[(size_t)row * n->columns + column];
}

// The leaf to look at first: the hint if p is in its capsule; else of the hint and of the cell of p (at `from`, `away` from its centre)
// the one that is surely nearer.
static uint32_t first_leaf(const Nearest *n, const Start *from, double away, Vec3 p, uint32_t hint)
{
  if (!from) return hint < n->leaves ? hint : n->leaves == 1 ? 0 : NONE;
  if (hint >= n->leaves) return from->leaf;
  return leaf_is_beyond(n, hint, p, away + (double)from->distance) ? from->leaf : hint;
}

// Squared radius of the circle around a cell, a little more than half its diagonal.
static inline double cell_radius2(const Nearest *n) { return 0.51 * n->cell * n->cell; }

// Capsules are compared by their axes, d^2 < (reach + r)^2, which spares a root in each.
NearestHit nearest_query(const Nearest *n, Vec3 p, double limit, uint32_t leaf)
{
  Best best = {limit * limit, NONE, NONE, 0};
  bool hinted = leaf < n->leaves && n->start && !leaf_is_beyond(n, leaf, p, 0);
  Vec3 centre = {0, 0, 0};
  const Start *from = n->start && !hinted ? start_of(n, p, &centre) : NULL;
  Vec3 off = vec3_sub(p, centre);
  double away2 = vec3_dot(off, off);
  uint32_t skip = first_leaf(n, from, from ? sqrt(away2) : 0, p, leaf);
  if (skip != NONE) try_leaf(n, skip, p, &best);
  double reach = best.piece == NONE ? limit : sqrt(best.d2);
  struct {
    uint32_t node;
    float r;
    double d2;
  } stack[2 * MAX_LEVELS];
  int top = 0;
  if (from && away2 <= cell_radius2(n)) {
    for (int i = 0; i < ENTRIES && from->entry[i]; i++) {
      uint32_t k = from->entry[i];
      if (k > 1) stack[top].r = n->node[k / 2].r[k % 2], stack[top].d2 = axis_distance2(&n->node[k / 2], (int)(k % 2), p);
      else stack[top].r = INFINITY, stack[top].d2 = 0;
      stack[top++].node = k;
    }
  } else if (n->leaves > 1) {
    stack[top].node = 1, stack[top].r = INFINITY, stack[top++].d2 = 0;
  }
  while (top && best.d2 > n->zero2) {
    uint32_t k = stack[--top].node;
    double least = reach + (double)stack[top].r;
    if (stack[top].d2 >= least * least) continue;
    // Down to a leaf, keeping the farther children for later.
    while (k < n->leaves) {
      const Pair *b = &n->node[k];
      V2 d2 = axis_distances2(b, p);
      double l = d2[0], r = d2[1];
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

// Whether a node has a piece within `reach` of p, as far as its capsule tells.
static bool node_is_within(const Nearest *n, uint32_t k, Vec3 p, double reach)
{
  const Pair *b = &n->node[k / 2];
  int c = (int)(k % 2);
  reach += (double)b->r[c];
  return !(b->r[c] < 0) && !(axis_distance2(b, c, p) > reach * reach);
}

// What is nearest to a place at most `radius` from the centre is at most 2 * radius farther from the centre than what is nearest to that.
static void find_entries(const Nearest *n, Vec3 centre, double radius, Start *s)
{
  double reach = ((double)s->distance + 2 * radius) * (1 + 1e-6);
  int count = 1;
  s->entry[0] = 1;
  for (int i = 0; i < count;) {
    uint32_t k = s->entry[i];
    bool l = k < n->leaves && node_is_within(n, 2 * k, centre, reach), r = k < n->leaves && node_is_within(n, 2 * k + 1, centre, reach);
    if (l && r && count < ENTRIES) s->entry[i] = 2 * k, s->entry[count++] = 2 * k + 1;
    else if (l != r) s->entry[i] = 2 * k + r;
    else i++;
  }
}

// A grid of cells, each with the leaf nearest to its centre and the nodes to start from.
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
    Vec3 centre = start_centre(n, column, row);
    NearestHit hit = nearest_query(n, centre, INFINITY, leaf);
    leaf = hit.leaf;
    Start *s = &start[(size_t)row * n->columns + column];
    *s = (Start){leaf, (float)hit.distance, {0}};
    find_entries(n, centre, sqrt(cell_radius2(n)), s);
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
      capsule[k] = nball ? capsule_fit(ball, nball) : (Capsule){.r = -1};
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
  Vec3 r = {(double)b->a[0][c] - p.x, (double)b->a[1][c] - p.y, (double)b->a[2][c] - p.z};
  Vec3 d = {(double)b->d[0][c], (double)b->d[1][c], (double)b->d[2][c]};
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
