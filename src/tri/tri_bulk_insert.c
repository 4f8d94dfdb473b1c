// tri_bulk_insert.c - many points at once: incremental insertion
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/rng.h"
#include "tri/tri_bulk.h"

// A side a -> b of the growing cavity: the half-edge g beyond it, its ends and the apex d beyond, relative to
// the new point, with their squared distances from it; and whether the point is in the circle beyond. That is
// found when the side appears, before it is its turn, so that the tests of the two sides of one triangle run
// side by side.
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
  const double *q = bulk_at(m, a), *r = bulk_at(m, b);
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
  int s = incircle_slow(bulk_at(m, a), bulk_at(m, b), bulk_at(m, c), p, &m->count);
  return (s ? s : incircle_tie(bulk_at(m, a), bulk_at(m, b), bulk_at(m, c), p, &m->count)) > 0;
}

// Is p strictly right of b -> c? Their coordinates relative to p, and the vertices for the exact answer.
static inline bool right_of(Bulk *m, double bx, double by, double cx, double cy, VertId b, VertId c, const double *p)
{
  double l = bx * cy, r = by * cx, det = l - r, bound = ORIENT_BOUND * (fabs(l) + fabs(r)) + ORIENT_TINY;
  if (LIKELY(det > bound)) return false;
  if (LIKELY(-det > bound)) return true;
  return orient2d_slow(bulk_at(m, b), bulk_at(m, c), p, &m->count) < 0;
}

typedef struct {
  double x, y;
  VertId v;
} Corner;

static inline Corner corner(const Bulk *m, VertId v, const double *p)
{
  const double *q = bulk_at(m, v);
  return (Corner){q[0] - p[0], q[1] - p[1], v};
}

static inline double lift(const Corner *c) { return c->x * c->x + c->y * c->y; }

// Look beyond side s, whose d, dx, dy and dl are not set yet.
static inline void look(const Bulk *m, Side *s, const double *p)
{
  s->d = m->vert[tri_prev(s->g)];
  if (UNLIKELY((s->a | s->b | s->d) > TRI_MAX_VERTICES)) {
    s->dx = s->dy = s->dl = 0;
    if (s->d != TRI_INF) {
      Corner c = corner(m, s->d, p);
      s->dx = c.x, s->dy = c.y, s->dl = lift(&c);
    }
    s->beyond = BEYOND_GHOST;
    return;
  }
  const double *q = bulk_at(m, s->d);
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
  s[0] = (Side){.g = m->twin[tri_prev(e)], .a = c->v, .b = a->v, .ax = c->x, .ay = c->y, .al = cl, .bx = a->x, .by = a->y, .bl = al};
  s[1] = (Side){.g = m->twin[tri_next(e)], .a = b->v, .b = c->v, .ax = b->x, .ay = b->y, .al = bl, .bx = c->x, .by = c->y, .bl = cl};
  s[2] = (Side){.g = m->twin[e], .a = a->v, .b = b->v, .ax = a->x, .ay = a->y, .al = al, .bx = b->x, .by = b->y, .bl = bl};
  for (int i = 0; i < 3; i++) look(m, &s[i], p);
}

// Walk from the finite triangle of half-edge e to the one of p and open it; returns the triangle.
static TriId walk(Bulk *m, const double *p, EdgeId e)
{
  Corner a = corner(m, m->vert[e], p), b = corner(m, m->vert[tri_next(e)], p), c = corner(m, m->vert[tri_prev(e)], p);
  static const Corner nowhere = {0, 0, TRI_INF};
  m->walks++;
  if (right_of(m, a.x, a.y, b.x, b.y, a.v, b.v, p)) { // turn the triangle so that this side becomes b -> c
    Corner t = c;
    c = b, b = a, a = t;
    e = tri_prev(e);
    goto over_bc;
  }
  for (;;) { // p is not right of e: a -> b
    if (right_of(m, b.x, b.y, c.x, c.y, b.v, c.v, p)) {
    over_bc:
      e = m->twin[tri_next(e)]; // c -> b
      a = c;
    } else if (right_of(m, c.x, c.y, a.x, a.y, c.v, a.v, p)) {
      e = m->twin[tri_prev(e)]; // a -> c
      b = c;
    } else break;
    VertId d = m->vert[tri_prev(e)];
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

// Insert vertex v with two fresh slots, starting from the finite triangle of e. Triangles of the cavity are
// replaced while it is still being explored: a side that turns out to be on its boundary gets its new
// triangle at once. Returns a half-edge of a finite new triangle.
static EdgeId insert(Bulk *m, VertId v, EdgeId e, TriId fresh)
{
  const double *p = bulk_at(m, v);
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
      later->g = twin[tri_prev(g)], later->a = s.d, later->b = s.b;
      later->ax = s.dx, later->ay = s.dy, later->al = s.dl, later->bx = s.bx, later->by = s.by, later->bl = s.bl;
      s.g = twin[tri_next(g)], s.b = s.d;
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
  bulk_link(m, last + 1, first + 2);
  return finite;
}

// Turn a ghost so that its hull edge comes first.
static void turn_ghost(Bulk *m, TriId t)
{
  uint32_t *v = m->vert + 3 * (size_t)t, *w = m->twin + 3 * (size_t)t;
  int first = v[0] == TRI_INF ? 1 : v[1] == TRI_INF ? 2 : 0;
  uint32_t vert[3], twin[3];
  for (int i = 0; i < 3; i++) vert[i] = v[(first + i) % 3], twin[i] = w[(first + i) % 3];
  for (int i = 0; i < 3; i++) {
    v[i] = vert[i];
    bulk_link(m, 3 * t + (EdgeId)i, twin[i]);
  }
}

// Of the new triangles around the vertex just inserted, one in whose sector q lies, if it is finite; else e,
// one of them. Their half-edges 3t are on the boundary of the cavity.
static EdgeId facing(Bulk *m, EdgeId e, const double *q)
{
  const double *p = bulk_at(m, m->vert[e + 2]);
  EdgeId f = e;
  do {
    VertId a = m->vert[f], b = m->vert[f + 1];
    if ((a | b) <= TRI_MAX_VERTICES && orient2d_count(p, bulk_at(m, a), q, &m->count) >= 0 &&
        orient2d_count(p, bulk_at(m, b), q, &m->count) < 0)
      return f;
    f = m->twin[f + 1] - 2;
  } while (f != e);
  return e;
}

// Vertex v's round: the last with probability 1/2, the one before with 1/4, and so on.
enum { ROUNDS = 12 };

static int round_of(VertId v)
{
  Rng r = {v};
  return ROUNDS - __builtin_ctzll(rng_next(&r) | (uint64_t)1 << ROUNDS);
}

BulkHull bulk_insert(Bulk *m, VertId lo, VertId hi)
{
  VertId k = lo + 2;
  while (k < hi && orient2d_count(bulk_at(m, lo), bulk_at(m, lo + 1), bulk_at(m, k), &m->count) == 0) k++;
  if (k >= hi) return bulk_chain(m, lo, hi);
  bulk_triangle(m, 2 * lo, lo, lo + 1, k);
  EdgeId e = 6 * lo;
  TriId fresh = 2 * lo + 4;
  for (int round = m->incremental ? 0 : ROUNDS; round <= ROUNDS; round++)
    for (VertId v = lo + 2; v < hi; v++) {
      if (v == k || (m->incremental && round_of(v) != round)) continue;
      if (m->incremental && fresh > 2 * lo + 4) e = facing(m, e, bulk_at(m, v));
      e = insert(m, v, e, fresh);
      fresh += 2;
    }
  EdgeId h = NONE;
  for (TriId t = 2 * lo; t < 2 * hi - 2; t++) {
    const uint32_t *v = m->vert + 3 * (size_t)t;
    if ((v[0] | v[1] | v[2]) <= TRI_MAX_VERTICES) continue;
    turn_ghost(m, t);
    h = 3 * t;
  }
  return bulk_extremes(m, h);
}

void bulk__begin_insert(Bulk *m)
{
  m->scratch = mem_zalloc(sizeof *m->scratch);
  vec_reserve(&m->scratch->sides, 64);
  vec_reserve(&m->scratch->slots, 64);
}

void bulk__end_insert(Bulk *m)
{
  vec_free(&m->scratch->sides);
  vec_free(&m->scratch->slots);
  free(m->scratch);
}
