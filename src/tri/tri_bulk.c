// tri_bulk.c - many points at once: incremental insertion in small parts, and the merging of parts
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_bulk.h"

// Everything here works on the final arrays. The part of the vertices [lo, hi) owns the triangle slots [2 lo, 2 hi - 2),
// just as many as it needs; merging two neighbouring parts uses the two slots between theirs. So nothing is allocated, the
// slots of a triangulation do not depend on threads, and there are no holes at the end.

static inline const double *at(const Bulk *m, VertId v) { return m->xy + 2 * (size_t)v; }
static inline EdgeId next3(EdgeId e) { return tri_next(e); }
static inline EdgeId prev3(EdgeId e) { return tri_prev(e); }

static inline void link(Bulk *m, EdgeId e, EdgeId f)
{
  m->twin[e] = f;
  m->twin[f] = e;
}

static inline void set3(Bulk *m, TriId t, VertId a, VertId b, VertId c)
{
  uint32_t *v = m->vert + 3 * (size_t)t;
  v[0] = a;
  v[1] = b;
  v[2] = c;
}

// ---- parts that are a line --------------------------------------------------------------------------------------

static int compare_points(const void *a, const void *b)
{
  const double *p = *(const double *const *)a, *q = *(const double *const *)b;
  return lex_compare(p, q);
}

// Two ghosts (a, b, inf) and (b, a, inf) for each edge of the vertices on one line: a chain glued to itself.
static EdgeId build_chain(Bulk *m, VertId lo, VertId hi)
{
  size_t n = hi - lo;
  const double **p = mem_alloc(n * sizeof *p);
  for (size_t i = 0; i < n; i++) p[i] = at(m, lo + (VertId)i);
  qsort(p, n, sizeof *p, compare_points);
  for (size_t i = 0; i + 1 < n; i++) {
    VertId a = (VertId)((p[i] - m->xy) / 2), b = (VertId)((p[i + 1] - m->xy) / 2);
    TriId s = 2 * lo + 2 * (TriId)i, t = s + 1;
    set3(m, s, a, b, TRI_INF);
    set3(m, t, b, a, TRI_INF);
    link(m, 3 * s, 3 * t);
    if (i > 0) { // b -> inf of the pair before with inf -> a of this one, on both sides
      link(m, 3 * (s - 2) + 1, 3 * s + 2);
      link(m, 3 * (t - 2) + 2, 3 * t + 1);
    }
  }
  TriId s = 2 * lo, last = 2 * hi - 4;
  link(m, 3 * s + 2, 3 * (s + 1) + 1);
  link(m, 3 * last + 1, 3 * (last + 1) + 2);
  free(p);
  return 3 * s;
}

// ---- incremental insertion ----------------------------------------------------------------------------------------

// A side a -> b of the growing cavity: the half-edge g beyond it, its ends and the apex d beyond, relative to the new point,
// with their squared distances from it; and whether the point is in the circle beyond. That is found when the side
// appears, before it is its turn, so that the tests of the two sides of one triangle run side by side.
typedef enum { BEYOND_OUT, BEYOND_IN, BEYOND_UNSURE, BEYOND_GHOST } Beyond;
typedef struct {
  EdgeId g;
  VertId a, b, d;
  double ax, ay, al, bx, by, bl, dx, dy, dl;
  Beyond beyond;
} Side;

struct BulkScratch {
  Vec(Side) sides;
  U32Vec slots;
};

// p in the circle of a ghost: the half plane beyond its hull edge, or between its ends.
static bool ghost_conflict(Bulk *m, VertId a, VertId b, const double *p)
{
  const double *q = at(m, a), *r = at(m, b);
  int s = orient2d_count(q, r, p, &m->count);
  if (s) return s > 0;
  return lex_compare(q, r) < 0 ? lex_compare(q, p) < 0 && lex_compare(p, r) < 0
                               : lex_compare(r, p) < 0 && lex_compare(p, q) < 0;
}

static NOINLINE bool any_ghost_conflict(Bulk *m, VertId a, VertId b, VertId c, const double *p)
{
  if (a == TRI_INF) return ghost_conflict(m, b, c, p);
  return b == TRI_INF ? ghost_conflict(m, c, a, p) : ghost_conflict(m, a, b, p);
}

static NOINLINE bool slow_conflict(Bulk *m, VertId a, VertId b, VertId c, const double *p)
{
  int s = incircle_slow(at(m, a), at(m, b), at(m, c), p, &m->count);
  return (s ? s : incircle_tie(at(m, a), at(m, b), at(m, c), p, &m->count)) > 0;
}

// Is p strictly right of b -> c? Their coordinates relative to p, and the vertices for the exact answer.
static inline bool right_of(Bulk *m, double bx, double by, double cx, double cy, VertId b, VertId c, const double *p)
{
  double l = bx * cy, r = by * cx, det = l - r, bound = ORIENT_BOUND * (fabs(l) + fabs(r)) + ORIENT_TINY;
  if (LIKELY(det > bound)) return false;
  if (LIKELY(-det > bound)) return true;
  return orient2d_slow(at(m, b), at(m, c), p, &m->count) < 0;
}

typedef struct {
  double x, y;
  VertId v;
} Corner;

static inline Corner corner(const Bulk *m, VertId v, const double *p)
{
  const double *q = at(m, v);
  return (Corner){q[0] - p[0], q[1] - p[1], v};
}

static inline double lift(const Corner *c) { return c->x * c->x + c->y * c->y; }

// Look beyond side s, whose d, dx, dy and dl are not set yet.
static inline void look(const Bulk *m, Side *s, const double *p)
{
  s->d = m->vert[prev3(s->g)];
  if (UNLIKELY((s->a | s->b | s->d) > TRI_MAX_VERTICES)) {
    s->dx = s->dy = s->dl = 0;
    if (s->d != TRI_INF) {
      Corner c = corner(m, s->d, p);
      s->dx = c.x, s->dy = c.y, s->dl = lift(&c);
    }
    s->beyond = BEYOND_GHOST;
    return;
  }
  const double *q = at(m, s->d);
  double dx = q[0] - p[0], dy = q[1] - p[1], dl = dx * dx + dy * dy;
  double det = s->bl * (s->ax * dy - s->ay * dx) + s->al * (dx * s->by - dy * s->bx) + dl * (s->bx * s->ay - s->by * s->ax);
  double sum = s->al + s->bl + dl, bound = INCIRCLE_BOUND * (sum * sum) + (INCIRCLE_TINY * sum + INCIRCLE_TINY);
  int in = det > bound, out = -det > bound;
  s->dx = dx, s->dy = dy, s->dl = dl;
  s->beyond = (Beyond)(in | (((in | out) ^ 1) << 1));
}

static inline bool is_in(Bulk *m, const Side *s, const double *p)
{
  if (LIKELY(s->beyond <= BEYOND_IN)) return s->beyond == BEYOND_IN;
  return s->beyond == BEYOND_UNSURE ? slow_conflict(m, s->b, s->a, s->d, p) : any_ghost_conflict(m, s->b, s->a, s->d, p);
}

// Start the cavity from its first triangle (e: a -> b, then b -> c, c -> a).
static inline void open_first(Bulk *m, EdgeId e, const Corner *a, const Corner *b, const Corner *c, const double *p)
{
  Side *s = m->scratch->sides.data;
  double al = lift(a), bl = lift(b), cl = lift(c);
  s[0] = (Side){.g = m->twin[prev3(e)], .a = c->v, .b = a->v, .ax = c->x, .ay = c->y, .al = cl, .bx = a->x, .by = a->y, .bl = al};
  s[1] = (Side){.g = m->twin[next3(e)], .a = b->v, .b = c->v, .ax = b->x, .ay = b->y, .al = bl, .bx = c->x, .by = c->y, .bl = cl};
  s[2] = (Side){.g = m->twin[e], .a = a->v, .b = b->v, .ax = a->x, .ay = a->y, .al = al, .bx = b->x, .by = b->y, .bl = bl};
  for (int i = 0; i < 3; i++) look(m, &s[i], p);
}

// Walk from the finite triangle of half-edge e to the one of p and open it; returns the triangle.
static TriId walk(Bulk *m, const double *p, EdgeId e)
{
  Corner a = corner(m, m->vert[e], p), b = corner(m, m->vert[next3(e)], p), c = corner(m, m->vert[prev3(e)], p);
  static const Corner nowhere = {0, 0, TRI_INF};
  m->walks++;
  if (right_of(m, a.x, a.y, b.x, b.y, a.v, b.v, p)) { // turn the triangle so that this side becomes b -> c
    Corner t = c;
    c = b, b = a, a = t;
    e = prev3(e);
    goto over_bc;
  }
  for (;;) { // p is not right of e: a -> b
    if (right_of(m, b.x, b.y, c.x, c.y, b.v, c.v, p)) {
    over_bc:
      e = m->twin[next3(e)]; // c -> b
      a = c;
    } else if (right_of(m, c.x, c.y, a.x, a.y, c.v, a.v, p)) {
      e = m->twin[prev3(e)]; // a -> c
      b = c;
    } else break;
    VertId d = m->vert[prev3(e)];
    m->steps++;
    if (d == TRI_INF) {
      open_first(m, e, &a, &b, &nowhere, p);
      return e / 3;
    }
    c = corner(m, d, p);
  }
  open_first(m, e, &a, &b, &c, p);
  return e / 3;
}

// Insert vertex v with two fresh slots, starting from the finite triangle of e. Triangles of the cavity are replaced while it
// is still being explored: a side that turns out to be on its boundary gets its new triangle at once. Returns a half-edge of
// a finite new triangle.
static EdgeId insert(Bulk *m, VertId v, EdgeId e, TriId fresh)
{
  const double *p = at(m, v);
  struct BulkScratch *w = m->scratch;
  uint32_t *vert = m->vert, *twin = m->twin;
  TriId t = walk(m, p, e);
  size_t ns = 3, nf = 3;
  uint32_t *slots = w->slots.data;
  slots[0] = fresh + 1;
  slots[1] = fresh;
  slots[2] = t;
  m->cavity++;
  EdgeId first = NONE, last = NONE, finite = NONE;
  Side s = w->sides.data[--ns];
  for (;;) {
    EdgeId g = s.g;
    if (is_in(m, &s, p)) {
      m->cavity++;
      if (UNLIKELY(ns + 2 > w->sides.cap)) vec_reserve(&w->sides, ns + 2);
      if (UNLIKELY(nf + 2 > w->slots.cap)) {
        w->slots.len = nf;
        vec_reserve(&w->slots, nf + 2);
        slots = w->slots.data;
      }
      Side *later = &w->sides.data[ns++]; // d -> b; now a -> d
      later->g = twin[prev3(g)], later->a = s.d, later->b = s.b;
      later->ax = s.dx, later->ay = s.dy, later->al = s.dl, later->bx = s.bx, later->by = s.by, later->bl = s.bl;
      s.g = twin[next3(g)], s.b = s.d;
      s.bx = s.dx, s.by = s.dy, s.bl = s.dl;
      look(m, &s, p);
      look(m, later, p);
      slots[nf++] = g / 3;
      continue;
    }
    TriId k = slots[--nf];
    EdgeId h = 3 * k;
    vert[h] = s.a;
    vert[h + 1] = s.b;
    vert[h + 2] = v;
    twin[h] = g;
    twin[g] = h;
    if (last != NONE) {
      twin[last + 1] = h + 2;
      twin[h + 2] = last + 1;
    } else first = h;
    last = h;
    if (LIKELY((s.a | s.b) <= TRI_MAX_VERTICES)) finite = h;
    if (ns == 0) break;
    s = w->sides.data[--ns];
  }
  link(m, last + 1, first + 2);
  return finite;
}

// The first triangle, counterclockwise, with its three ghosts in slots t .. t + 3.
static void build_first(Bulk *m, TriId t, VertId a, VertId b, VertId c)
{
  if (orient2d(at(m, a), at(m, b), at(m, c)) < 0) {
    VertId d = b;
    b = c;
    c = d;
  }
  set3(m, t, a, b, c);
  set3(m, t + 1, b, a, TRI_INF);
  set3(m, t + 2, c, b, TRI_INF);
  set3(m, t + 3, a, c, TRI_INF);
  for (uint32_t i = 0; i < 3; i++) {
    EdgeId ghost = 3 * (t + 1 + i), after = 3 * (t + 1 + (i + 1) % 3);
    link(m, 3 * t + i, ghost);
    link(m, ghost + 2, after + 1); // inf -> dest with dest -> inf
  }
}

static EdgeId hull_next(const Bulk *m, EdgeId h) { return next3(m->twin[next3(h)]); }
static EdgeId hull_prev(const Bulk *m, EdgeId h) { return prev3(m->twin[prev3(h)]); }

// Is p more extreme than q in the sense of BulkHull?
static bool beats(const double *p, const double *q, int which)
{
  int axis = which >> 1;
  if (p[axis] != q[axis]) return (p[axis] > q[axis]) == (which & 1);
  return axis == 0 ? p[1] < q[1] : p[0] > q[0];
}

static BulkHull extremes(const Bulk *m, EdgeId h)
{
  BulkHull x = {{h, h, h, h}};
  for (EdgeId f = hull_next(m, h); f != h; f = hull_next(m, f))
    for (int i = 0; i < 4; i++)
      if (beats(at(m, m->vert[f]), at(m, m->vert[x.e[i]]), i)) x.e[i] = f;
  return x;
}

static BulkHull build_incremental(Bulk *m, VertId lo, VertId hi)
{
  if (hi - lo < 2) return (BulkHull){{NONE, NONE, NONE, NONE}};
  VertId k = lo + 2;
  while (k < hi && orient2d_count(at(m, lo), at(m, lo + 1), at(m, k), &m->count) == 0) k++;
  if (k == hi) return extremes(m, build_chain(m, lo, hi));
  build_first(m, 2 * lo, lo, lo + 1, k);
  EdgeId e = 6 * lo;
  TriId fresh = 2 * lo + 4;
  for (VertId v = lo + 2; v < hi; v++) {
    if (v == k) continue;
    e = insert(m, v, e, fresh);
    fresh += 2;
  }
  // Some vertex's ghost: look from the end, where new slots went.
  EdgeId g = 3 * (2 * hi - 2) - 1;
  while (m->vert[g] != TRI_INF) g--;
  return extremes(m, next3(g));
}

// ---- merging [Guibas85] ---------------------------------------------------------------------------------------------

static inline int turn(Bulk *m, VertId a, VertId b, VertId c)
{
  return orient2d_count(at(m, a), at(m, b), at(m, c), &m->count);
}

static inline bool in_circle(Bulk *m, VertId a, VertId b, VertId c, VertId d)
{
  return incircle_perturbed(at(m, a), at(m, b), at(m, c), at(m, d), &m->count) > 0;
}

// Edge h of the hull goes: the triangle behind it, with apex z, and its ghost are flipped. h: a -> b becomes z -> b when
// keep_dest, and the ghost on a -> z takes the triangle's slot; else h becomes a -> z, and the slot has z -> b.
static void peel(Bulk *m, EdgeId h, bool keep_dest)
{
  EdgeId t = m->twin[h], hn = next3(h), hp = prev3(h), tn = next3(t), tp = prev3(t); // t: b -> a, tn: a -> z, tp: z -> b
  VertId a = m->vert[h], b = m->vert[hn], z = m->vert[tp];
  EdgeId az = m->twin[tn], zb = m->twin[tp];
  if (keep_dest) {
    EdgeId up = m->twin[hp]; // a -> inf of the hull edge before
    m->vert[h] = z;
    m->vert[t] = a, m->vert[tn] = z, m->vert[tp] = TRI_INF;
    link(m, h, zb);
    link(m, t, az);
    link(m, tn, hp);
    link(m, tp, up);
  } else {
    EdgeId up = m->twin[hn]; // inf -> b of the hull edge after
    m->vert[hn] = z;
    m->vert[t] = z, m->vert[tn] = b, m->vert[tp] = TRI_INF;
    link(m, h, az);
    link(m, t, zb);
    link(m, tp, hn);
    link(m, tn, up);
  }
}

// Merge the parts [lo, mid) and [mid, hi), one of which (`first_low`: the first) lies strictly below the other along the axis.
// Returns the hull of the union.
static BulkHull merge(Bulk *m, VertId lo, VertId mid, const BulkHull *p, const BulkHull *q, int axis, bool first_low)
{
  // Seen with the axis to the right: L is left, R right. With axis y that is a turn by a quarter.
  const BulkHull *hull_l = first_low ? p : q, *hull_r = first_low ? q : p;
  EdgeId hl = hull_l->e[2 * axis + 1], hr = hull_r->e[2 * axis]; // hl: hull edge into l on the gap's side; hr: out of r
  VertId l, r;
  EdgeId below_l = NONE, below_r = NONE; // hull edge out of l, and into r, on the lower side
  if (hl != NONE) {
    below_l = hl;
    l = m->vert[below_l];
  } else l = first_low ? lo : mid;
  if (hr != NONE) {
    r = m->vert[hr];
  } else r = first_low ? mid : lo;
  // The lower common tangent: nothing right of l -> r.
  for (bool moved = true; moved;) {
    moved = false;
    while (below_l != NONE && turn(m, l, r, m->vert[next3(below_l)]) < 0) {
      below_l = hull_next(m, below_l);
      l = m->vert[below_l];
      moved = true;
    }
    while (hr != NONE) {
      EdgeId h = hull_prev(m, hr);
      if (turn(m, l, r, m->vert[h]) >= 0) break;
      hr = h;
      r = m->vert[hr];
      moved = true;
    }
  }
  if (hr != NONE) below_r = hull_prev(m, hr);
  if (below_l != NONE) hl = hull_prev(m, below_l);
  VertId vertex_l[4], vertex_r[4]; // the extreme ones, before half-edges change their origins
  for (int i = 0; i < 4; i++) {
    vertex_l[i] = hl == NONE ? l : m->vert[hull_l->e[i]];
    vertex_r[i] = hr == NONE ? r : m->vert[hull_r->e[i]];
  }
  const VertId low_r = r;
  bool new_l = hl == NONE, new_r = hr == NONE; // the hull edge that leaves the upper l, the lower r, is a new one
  TriId bottom = 2 * mid - 2, top = bottom + 1;
  set3(m, bottom, r, l, TRI_INF);
  if (below_l != NONE) link(m, 3 * bottom + 1, prev3(below_l)); // l -> inf, inf -> l
  if (below_r != NONE) link(m, 3 * bottom + 2, next3(below_r)); // inf -> r, r -> inf
  EdgeId base = 3 * bottom; // runs r -> l, below the edge l r that is being left upward
  for (;;) {
    bool left = hl != NONE && turn(m, l, r, m->vert[hl]) > 0;
    bool right = hr != NONE && turn(m, l, r, m->vert[next3(hr)]) > 0;
    if (!left && !right) break;
    if (left)
      for (;;) {
        VertId z = m->vert[prev3(m->twin[hl])];
        if (z == TRI_INF || !in_circle(m, l, r, m->vert[hl], z)) break;
        peel(m, hl, true);
      }
    if (right)
      for (;;) {
        VertId z = m->vert[prev3(m->twin[hr])];
        if (z == TRI_INF || !in_circle(m, l, r, m->vert[next3(hr)], z)) break;
        peel(m, hr, false);
      }
    if (!left || (right && in_circle(m, l, r, m->vert[hl], m->vert[next3(hr)]))) { // ghost r -> w becomes (r, w, l)
      EdgeId h = hr, above = hull_next(m, hr);
      VertId w = m->vert[next3(h)];
      m->vert[prev3(h)] = l;
      link(m, prev3(h), base); // l -> r
      base = next3(h);         // w -> l
      r = w;
      hr = above;
      new_r = true;
    } else { // ghost z -> l becomes (z, l, r)
      EdgeId h = hl, above = hull_prev(m, hl);
      VertId z = m->vert[h];
      m->vert[prev3(h)] = r;
      link(m, next3(h), base); // l -> r
      base = prev3(h);         // r -> z
      l = z;
      hl = above;
      new_l = true;
    }
  }
  set3(m, top, l, r, TRI_INF);
  link(m, 3 * top, base);
  if (hl != NONE) link(m, 3 * top + 2, next3(hl)); // inf -> l, l -> inf
  else link(m, 3 * top + 2, 3 * bottom + 1);
  if (hr != NONE) link(m, 3 * top + 1, prev3(hr)); // r -> inf, inf -> r
  else link(m, 3 * top + 1, 3 * bottom + 2);
  // The extreme vertices of the union. The hull edge that leaves one is new only at two tangent points.
  BulkHull x;
  for (int i = 0; i < 4; i++) {
    EdgeId el = hull_l->e[i], er = hull_r->e[i];
    VertId vl = vertex_l[i], vr = vertex_r[i];
    if (beats(at(m, vl), at(m, vr), i)) x.e[i] = vl == l && new_l ? 3 * top : el;
    else x.e[i] = vr == low_r && new_r ? 3 * bottom : er;
  }
  return x;
}

// ---- the whole ------------------------------------------------------------------------------------------------------

void bulk_begin(Bulk *m)
{
  m->scratch = mem_zalloc(sizeof *m->scratch);
  vec_reserve(&m->scratch->sides, 64);
  vec_reserve(&m->scratch->slots, 64);
}

void bulk_end(Bulk *m)
{
  vec_free(&m->scratch->sides);
  vec_free(&m->scratch->slots);
  free(m->scratch);
}

// First vertex of [lo, hi) whose key has the bit set.
static VertId key_split(const uint32_t *key, VertId lo, VertId hi, int bit)
{
  while (lo < hi) {
    VertId mid = lo + (hi - lo) / 2;
    if (key[mid] >> bit & 1) hi = mid;
    else lo = mid + 1;
  }
  return lo;
}

BulkHull bulk_build(Bulk *m, const BulkCell *cell)
{
  if (cell->hi - cell->lo <= m->leaf || cell->bit < 0) return build_incremental(m, cell->lo, cell->hi);
  BulkCell half[2];
  bulk_split(m, cell, half);
  if (half[0].hi == half[0].lo) return bulk_build(m, &half[1]);
  if (half[1].hi == half[1].lo) return bulk_build(m, &half[0]);
  BulkHull p = bulk_build(m, &half[0]), q = bulk_build(m, &half[1]);
  return bulk_merge(m, cell, half, &p, &q);
}

// The first bit of a quadrant's number says on which side the quadrant is along one axis, the second along the other
// (geom/hilbert.c explains the state u, c).
void bulk_split(const Bulk *m, const BulkCell *cell, BulkCell half[2])
{
  VertId mid = key_split(m->key, cell->lo, cell->hi, cell->bit);
  half[0] = half[1] = *cell;
  half[0].hi = half[1].lo = mid;
  for (int i = 0; i < 2; i++) {
    half[i].bit = (int8_t)(cell->bit - 1);
    if (cell->bit & 1) {
      half[i].x = (uint8_t)i;
      continue;
    }
    // x' = half.x, y' = x' ^ i; undo the state to get the raw bits
    uint8_t xs = cell->x, ys = (uint8_t)(cell->x ^ i), s = cell->u ^ cell->c;
    uint8_t a = (uint8_t)((s ? ys : xs) ^ cell->c), differ = (uint8_t)i;
    half[i].u ^= (uint8_t)((differ ^ 1) & (cell->c ^ a ^ 1));
    half[i].c ^= (uint8_t)(differ & (cell->u ^ a));
  }
}

BulkHull bulk_merge(Bulk *m, const BulkCell *cell, const BulkCell half[2], const BulkHull *p, const BulkHull *q)
{
  uint8_t s = cell->u ^ cell->c; // axes swapped
  bool first_bit = cell->bit & 1;
  int axis = first_bit ? s : !s;
  bool low = (first_bit ? 0 : cell->x) == cell->c; // the first half has y' = x' at the second bit
  return merge(m, cell->lo, half[1].lo, p, q, axis, low);
}
