// tri_bulk_climb.c - many points at once: closing the gaps between parts, several side by side
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_bulk.h"

#if defined __SSE2__
#include <immintrin.h>
#endif

// Nearly all time of tri_build is spent here. A step of a climb waits for the one before it: three loads,
// each of them from where the one before says, and a long sum; and then nobody can predict what it will do:
// left or right, is an edge peeled? So several merges climb at once, one step of each in turn. All tests of
// the steps of a group of merges are computed in the lanes of vectors, two for each merge (2k left, 2k + 1
// right), whatever their outcome; the side is a number, not a branch.
enum { GROUP = 4, MERGES = 8, SIDES = 2 * MERGES, GROUP_SIDES = 2 * GROUP };

#if defined __AVX512F__
enum { WIDTH = 8 };
#define SHUFFLE(v, a, b) __builtin_shufflevector(v, v, a, b, a + 2, b + 2, a + 4, b + 4, a + 6, b + 6)
#elif defined __AVX__
enum { WIDTH = 4 };
#define SHUFFLE(v, a, b) __builtin_shufflevector(v, v, a, b, a + 2, b + 2)
#else
enum { WIDTH = 2 };
#define SHUFFLE(v, a, b) __builtin_shufflevector(v, v, a, b)
#endif
typedef double V __attribute__((vector_size(WIDTH * sizeof(double))));
typedef int64_t M __attribute__((vector_size(WIDTH * sizeof(double)))); // of a comparison: -1 or 0

static inline V swapped(V v) { return SHUFFLE(v, 1, 0); }
static inline V lefts(V v) { return SHUFFLE(v, 0, 0); }
static inline V rights(V v) { return SHUFFLE(v, 1, 1); }
static inline V magnitude(V v) { return (V)((M)v & INT64_MAX); }

// Bit i: lane i of a is greater.
static inline unsigned greater(V a, V b)
{
#if defined __AVX512F__
  return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ);
#elif defined __AVX__
  return (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_GT_OQ));
#elif defined __SSE2__
  return (unsigned)_mm_movemask_pd(_mm_cmpgt_pd(a, b));
#else
  return (a[0] > b[0] ? 1u : 0) | (a[1] > b[1] ? 2u : 0);
#endif
}

// The state of all climbs. For each side: an end of the base, with coordinates bx, by; the hull edge h above
// it, from the next vertex v (x, y) to the base's left end, or from its right end to v; and the apex z (zx,
// zy) of the triangle behind h. If that is a ghost, z's test is lost by `out`, which then is infinite, else
// 0. Bits of has, one a side: there is a hull edge.
typedef struct {
  double x[SIDES], y[SIDES], zx[SIDES], zy[SIDES], out[SIDES], bx[SIDES], by[SIDES];
  VertId end[SIDES], v[SIDES], z[SIDES];
  EdgeId h[SIDES], base[MERGES];
  uint32_t node[MERGES];
  unsigned has;
  uint64_t triangles, flips;
} Climb;

// Half-edge after and before the one at place i in its triangle: NEXT >> 2 i & 3.
enum { NEXT = 1 | 2 << 2 | 0 << 4, PREVIOUS = 2 | 0 << 2 | 1 << 4 };

// Side i looks at hull edge h.
static inline void look(const Bulk *m, Climb *c, uint32_t i, EdgeId h)
{
  EdgeId twin = m->twin[h], t = twin / 3 * 3;
  VertId v = m->vert[h + (i & 1)], z = m->vert[t + ((uint32_t)PREVIOUS >> 2 * (twin - t) & 3)];
  const double *p = bulk_at(m, v), *q = bulk_at(m, z == TRI_INF ? v : z);
  c->h[i] = h, c->v[i] = v, c->z[i] = z;
  c->x[i] = p[0], c->y[i] = p[1];
  c->zx[i] = q[0], c->zy[i] = q[1];
  c->out[i] = z == TRI_INF ? (double)INFINITY : 0.0;
}

// The hull edge of side i goes: the triangle behind it, l -> v -> z, and its ghost are flipped; h becomes z
// -> l, and the ghost on v -> z takes the triangle's slot. On the right h: r -> v becomes r -> z, and the
// slot has z -> v.
static inline void peel(Bulk *m, Climb *c, uint32_t i)
{
  uint32_t *vert = m->vert, *twin = m->twin, s = i & 1;
  VertId v = c->v[i], z = c->z[i];
  EdgeId h = c->h[i], behind = twin[h], t = behind / 3 * 3;
  uint32_t place = 2 * (behind - t), to_next = NEXT >> place & 3, to_previous = PREVIOUS >> place & 3;
  EdgeId inner = twin[t + (s ? to_next : to_previous)], outer = twin[t + (s ? to_previous : to_next)];
  EdgeId above = twin[h + 2 - s];
  vert[h + s] = z;
  vert[t + s] = v;
  vert[t + 1 - s] = z;
  vert[t + 2] = TRI_INF;
  bulk_link(m, h, inner);
  bulk_link(m, t, outer);
  bulk_link(m, t + 1 + s, h + 2 - s);
  bulk_link(m, t + 2 - s, above);
  look(m, c, i, h);
}

// The base moves up to the v of side i: ghost v -> l becomes the triangle (v, l, r), or r -> v becomes (r, v,
// l).
static inline void go(Bulk *m, Climb *c, uint32_t i)
{
  uint32_t s = i & 1;
  EdgeId h = c->h[i], above = m->twin[h + 2 - s] - 1 - s;
  m->vert[h + 2] = c->end[i ^ 1];
  bulk_link(m, h + 1 + s, c->base[i / 2]); // l -> r
  c->base[i / 2] = h + 2 - s;              // r -> v
  c->end[i] = c->v[i];
  c->bx[i] = c->x[i], c->by[i] = c->y[i];
  look(m, c, i, above);
}

typedef enum { GO_LEFT, GO_RIGHT, PEEL_LEFT, PEEL_RIGHT, STOP } Action;

// What merge k has to do, when the filters cannot tell.
static NOINLINE Action decide(Bulk *m, const Climb *c, uint32_t k)
{
  const uint32_t i = 2 * k, j = i + 1;
  const double *l = bulk_at(m, c->end[i]), *r = bulk_at(m, c->end[j]);
  bool up[2];
  for (uint32_t s = 0; s < 2; s++) {
    up[s] = c->has >> (i + s) & 1 && orient2d_count(l, r, bulk_at(m, c->v[i + s]), &m->count) > 0;
    if (!up[s] || c->z[i + s] == TRI_INF) continue;
    if (incircle_perturbed(l, r, bulk_at(m, c->v[i + s]), bulk_at(m, c->z[i + s]), &m->count) > 0)
      return s ? PEEL_RIGHT : PEEL_LEFT;
  }
  if (!up[0]) return up[1] ? GO_RIGHT : STOP;
  if (!up[1]) return GO_LEFT;
  return incircle_perturbed(l, r, bulk_at(m, c->v[i]), bulk_at(m, c->v[j]), &m->count) > 0 ? GO_RIGHT : GO_LEFT;
}

// Signs of the tests, a bit for each side of a group: is v left of l -> r; is z in the circle of l, r, v; is
// the other side's v in the circle of this one's. Yes and no; neither: the filter cannot tell.
typedef struct {
  unsigned up, not_up, in, not_in, other, not_other;
} Signs;

// Everything as seen from the left end of the base.
static inline Signs test(const Climb *c, uint32_t first)
{
  Signs sign = {0, 0, 0, 0, 0, 0};
  for (uint32_t j = 0; j < GROUP_SIDES; j += WIDTH) {
    const uint32_t i = first + j;
    V bx, by, x, y, z, w, o;
    memcpy(&bx, c->bx + i, sizeof bx), memcpy(&by, c->by + i, sizeof by);
    memcpy(&x, c->x + i, sizeof x), memcpy(&y, c->y + i, sizeof y);
    memcpy(&z, c->zx + i, sizeof z), memcpy(&w, c->zy + i, sizeof w);
    memcpy(&o, c->out + i, sizeof o);
    V lx = lefts(bx), ly = lefts(by), ux = rights(bx) - lx, uy = rights(by) - ly, ul = ux * ux + uy * uy;
    V ax = x - lx, ay = y - ly, al = ax * ax + ay * ay;
    V zx = z - lx, zy = w - ly, zl = zx * zx + zy * zy;
    V p = ux * ay, q = uy * ax, up = p - q, up_tol = ORIENT_BOUND * (magnitude(p) + magnitude(q)) + ORIENT_TINY;
    V in = al * (ux * zy - zx * uy) - zl * up + ul * (zx * ay - ax * zy);
    V s = al + zl + ul, in_tol = INCIRCLE_BOUND * (s * s) + (INCIRCLE_TINY * s + INCIRCLE_TINY);
    V a = al * swapped(up), b = ax * swapped(ay), other = (a - swapped(a)) + ul * (swapped(b) - b);
    V t = (al + swapped(al)) + ul, other_tol = INCIRCLE_BOUND * (t * t) + (INCIRCLE_TINY * t + INCIRCLE_TINY);
    sign.up |= greater(up, up_tol) << j, sign.not_up |= greater(-up, up_tol) << j;
    sign.in |= greater(in, in_tol) << j, sign.not_in |= greater(o - in, in_tol) << j;
    sign.other |= greater(other, other_tol) << j, sign.not_other |= greater(-other, other_tol) << j;
  }
  return sign;
}

// What each merge of the group has to do.
static inline void choose(Bulk *m, const Climb *c, uint32_t first, uint8_t action[GROUP])
{
  // By the bits of up (1, 2), in (4, 8) and other (16).
  static const uint8_t table[32] = {
    STOP, GO_LEFT, GO_RIGHT, GO_LEFT,  STOP, PEEL_LEFT, GO_RIGHT, PEEL_LEFT,
    STOP, GO_LEFT, PEEL_RIGHT, PEEL_RIGHT, STOP, PEEL_LEFT, PEEL_RIGHT, PEEL_LEFT,
    STOP, GO_LEFT, GO_RIGHT, GO_RIGHT, STOP, PEEL_LEFT, GO_RIGHT, PEEL_LEFT,
    STOP, GO_LEFT, PEEL_RIGHT, PEEL_RIGHT, STOP, PEEL_LEFT, PEEL_RIGHT, PEEL_LEFT,
  };
  const unsigned all = (1u << GROUP_SIDES) - 1, left = all / 3;
  Signs s = test(c, first);
  unsigned has = c->has >> first, up = s.up & has, stay = s.not_up | ~has;
  unsigned unsure = ~((up | stay) & (s.in | s.not_in | stay)) & all;
  unsure = ((unsure | unsure >> 1) | (up & up >> 1 & ~(s.other | s.not_other))) & left;
  for (uint32_t k = 0; k < GROUP; k++)
    action[k] = table[(up >> 2 * k & 3) | (s.in >> 2 * k & 3) << 2 | (s.other >> 2 * k & 1) << 4];
  if (UNLIKELY(unsure))
    for (uint32_t k = 0; k < GROUP; k++)
      if (unsure >> 2 * k & 1) action[k] = (uint8_t)decide(m, c, first / 2 + k);
}

// Merge k begins where r says.
static void begin(const Bulk *m, Climb *c, uint32_t k, const BulkRise *r)
{
  c->node[k] = r->node;
  c->base[k] = r->base;
  for (uint32_t s = 0; s < 2; s++) {
    const uint32_t i = 2 * k + s;
    const double *p = bulk_at(m, r->v[s]);
    c->end[i] = r->v[s];
    c->bx[i] = p[0], c->by[i] = p[1];
    c->h[i] = r->h[s];
    c->has &= ~(1u << i);
    if (r->h[s] != NONE) {
      c->has |= 1u << i;
      look(m, c, i, r->h[s]);
    } else c->x[i] = c->zx[i] = p[0], c->y[i] = c->zy[i] = p[1], c->out[i] = 0;
  }
}

// Merge k is done, if there is one; and a new one begins, if there is one. Returns by how much the number of
// merges changes.
static NOINLINE int change(Bulk *m, Climb *c, uint32_t k)
{
  int change = 0;
  const uint32_t i = 2 * k, j = i + 1;
  if (c->node[k] != NONE) {
    BulkRise done = {{c->end[i], c->end[j]}, {c->h[i], c->h[j]}, c->base[k], c->node[k]};
    bulk_done(m, &done);
    change--;
    c->node[k] = NONE;
    c->has &= ~(3u << i);
  }
  BulkRise next;
  if (!bulk_next(m, &next)) return change;
  begin(m, c, k, &next);
  return change + 1;
}

void bulk_climb(Bulk *m)
{
  _Alignas(64) Climb c = {.has = 0};
  memset(c.node, 0xff, sizeof c.node);
  int merges = 0;
  do
    for (uint32_t first = 0; first < SIDES; first += GROUP_SIDES) {
      uint8_t action[GROUP];
      choose(m, &c, first, action);
      for (uint32_t k = 0; k < GROUP; k++) {
        const uint32_t a = action[k], i = first + 2 * k + (a & 1);
        if (UNLIKELY(a == STOP)) {
          if (m->waiting || c.node[first / 2 + k] != NONE) merges += change(m, &c, first / 2 + k);
        } else if (a & 2) peel(m, &c, i), c.flips++;
        else go(m, &c, i), c.triangles++;
      }
    }
  while (merges > 0);
  m->merged += c.triangles;
  m->flipped += c.flips;
}
