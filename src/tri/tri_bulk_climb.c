// tri_bulk_climb.c - many points at once: closing the gap between two parts
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_bulk.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

// Nearly all time of tri_build is spent here, and most of that on branches nobody can predict: left or right? So both sides
// are looked at together, in the two lanes of vectors (0 left, 1 right), all tests of a step are computed before the first branch,
// and the side is a number, not a branch. The code for a side s reads best with s = 0 in mind.
typedef double V2 __attribute__((vector_size(16)));
typedef int64_t M2 __attribute__((vector_size(16))); // of a comparison: -1 or 0

static inline V2 both(double x) { return (V2){x, x}; }
static inline V2 swapped(V2 v) { return (V2){v[1], v[0]}; }
static inline V2 magnitude(V2 v) { return (V2)((M2)v & INT64_MAX); }
static inline V2 choose(M2 m, V2 yes, V2 no) { return (V2)(((M2)yes & m) | ((M2)no & ~m)); }

// Bit i: lane i of a is greater.
static inline unsigned greater(V2 a, V2 b)
{
#ifdef __SSE2__
  return (unsigned)_mm_movemask_pd(_mm_cmpgt_pd(a, b));
#else
  return (a[0] > b[0] ? 1u : 0) | (a[1] > b[1] ? 2u : 0);
#endif
}

// The next vertices v above the base, on both sides. The hull edge h runs from v to the base's left end, or from its right
// end to v. Behind it is a triangle with the apex z; none, a bit for each side: it is a ghost.
typedef struct {
  V2 x, y, zx, zy;
  unsigned none;
} Flanks;

typedef struct {
  EdgeId h;
  VertId v, z;
} Flank;

// Half-edge after and before the one at place i in its triangle: NEXT >> 2 i & 3.
enum { NEXT = 1 | 2 << 2 | 0 << 4, PREVIOUS = 2 | 0 << 2 | 1 << 4 };

// The hull edge above h.
static inline EdgeId step(const Bulk *m, EdgeId h, uint32_t s) { return m->twin[h + 2 - s] - 1 - s; }

static inline void load(const Bulk *m, Flanks *f, Flank *g, EdgeId h, uint32_t s, M2 side)
{
  EdgeId twin = m->twin[h], t = twin / 3 * 3;
  VertId v = m->vert[h + s], z = m->vert[t + ((uint32_t)PREVIOUS >> 2 * (twin - t) & 3)];
  *g = (Flank){h, v, z};
  const double *p = bulk_at(m, v), *q = bulk_at(m, z == TRI_INF ? v : z);
  f->x = choose(side, both(p[0]), f->x);
  f->y = choose(side, both(p[1]), f->y);
  f->zx = choose(side, both(q[0]), f->zx);
  f->zy = choose(side, both(q[1]), f->zy);
  f->none = (f->none & ~(1u << s)) | (unsigned)(z == TRI_INF) << s;
}

// The hull edge of g goes: the triangle behind it, l -> v -> z, and its ghost are flipped; h becomes z -> l, and the ghost on
// v -> z takes the triangle's slot. On the right h: r -> v becomes r -> z, and the slot has z -> v.
static void peel(Bulk *m, const Flank *g, uint32_t s)
{
  uint32_t *vert = m->vert, *twin = m->twin;
  EdgeId h = g->h, behind = twin[h], t = behind / 3 * 3;
  uint32_t place = 2 * (behind - t), to_next = NEXT >> place & 3, to_previous = PREVIOUS >> place & 3;
  EdgeId inner = twin[t + (s ? to_next : to_previous)], outer = twin[t + (s ? to_previous : to_next)];
  EdgeId above = twin[h + 2 - s];
  vert[h + s] = g->z;
  vert[t + s] = g->v;
  vert[t + 1 - s] = g->z;
  vert[t + 2] = TRI_INF;
  bulk_link(m, h, inner);
  bulk_link(m, t, outer);
  bulk_link(m, t + 1 + s, h + 2 - s);
  bulk_link(m, t + 2 - s, above);
}

typedef enum { GO_LEFT, GO_RIGHT, PEEL_LEFT, PEEL_RIGHT, STOP } Action;

// What to do, when the filters cannot tell.
static NOINLINE Action decide(Bulk *m, const VertId base[2], Flank *const g[2])
{
  const double *l = bulk_at(m, base[0]), *r = bulk_at(m, base[1]);
  bool go[2];
  for (int s = 0; s < 2; s++) {
    go[s] = g[s]->h != NONE && orient2d_count(l, r, bulk_at(m, g[s]->v), &m->count) > 0;
    if (!go[s] || g[s]->z == TRI_INF) continue;
    if (incircle_perturbed(l, r, bulk_at(m, g[s]->v), bulk_at(m, g[s]->z), &m->count) > 0) return s ? PEEL_RIGHT : PEEL_LEFT;
  }
  if (!go[0]) return go[1] ? GO_RIGHT : STOP;
  if (!go[1]) return GO_LEFT;
  return incircle_perturbed(l, r, bulk_at(m, g[0]->v), bulk_at(m, g[1]->v), &m->count) > 0 ? GO_RIGHT : GO_LEFT;
}

// Everything as seen from the left end of the base: is v left of l -> r, and z in the circle of l, r, v; and is the right v in the
// circle of the left one?
static inline int filter(V2 bx, V2 by, const Flanks *f, unsigned has)
{
  V2 lx = {bx[0], bx[0]}, ly = {by[0], by[0]}, ux = both(bx[1] - bx[0]), uy = both(by[1] - by[0]), ul = ux * ux + uy * uy;
  V2 ax = f->x - lx, ay = f->y - ly, al = ax * ax + ay * ay;
  V2 zx = f->zx - lx, zy = f->zy - ly, zl = zx * zx + zy * zy;
  V2 p = ux * ay, q = uy * ax, up = p - q, up_tol = ORIENT_BOUND * (magnitude(p) + magnitude(q)) + ORIENT_TINY;
  V2 in = al * (ux * zy - zx * uy) - zl * up + ul * (zx * ay - ax * zy);
  V2 s = al + zl + ul, in_tol = INCIRCLE_BOUND * (s * s) + (INCIRCLE_TINY * s + INCIRCLE_TINY);
  V2 c = al * swapped(up), d = ax * swapped(ay);
  double t = al[0] + al[1] + ul[0], cross = c[0] - c[1] + ul[0] * (d[1] - d[0]);
  double cross_tol = INCIRCLE_BOUND * (t * t) + (INCIRCLE_TINY * t + INCIRCLE_TINY);
  unsigned go = greater(up, up_tol) & has, stay = greater(-up, up_tol) | ~has;
  unsigned off = greater(in, in_tol) & ~f->none & go, keep = greater(-in, in_tol) | f->none | stay;
  unsigned sure = (go | stay) & (off | keep) & 3;
  int right = cross > cross_tol, left = -cross > cross_tol;
  if (UNLIKELY((sure != 3) | ((go == 3) & !(left | right)))) return -1;
  if (off) return off == 2 ? PEEL_RIGHT : PEEL_LEFT;
  if (!go) return STOP;
  return (go == 2) | ((go == 3) & right) ? GO_RIGHT : GO_LEFT;
}

void bulk_climb(Bulk *m, BulkRise *rise)
{
  static const M2 sides[2] = {{-1, 0}, {0, -1}};
  VertId end[2] = {rise->v[0], rise->v[1]};
  const double *l = bulk_at(m, end[0]), *r = bulk_at(m, end[1]);
  EdgeId base = rise->base;
  V2 bx = {l[0], r[0]}, by = {l[1], r[1]};
  Flanks f = {0}, ahead = {0}; // those after them are loaded ahead
  Flank g[2][2], *now[2] = {g[0], g[1]}, *then[2] = {g[0] + 1, g[1] + 1};
  unsigned has = 0;
  for (uint32_t s = 0; s < 2; s++) {
    now[s]->h = rise->h[s];
    if (rise->h[s] == NONE) continue;
    has |= 1u << s;
    load(m, &f, now[s], rise->h[s], s, sides[s]);
    load(m, &ahead, then[s], step(m, rise->h[s], s), s, sides[s]);
  }
  uint32_t steps = 0;
  int flips = 0;
  for (;;) {
    int action = filter(bx, by, &f, has);
    if (UNLIKELY(action < 0)) action = (int)decide(m, end, now);
    if (action == STOP) break;
    uint32_t s = (uint32_t)action & 1;
    M2 side = sides[s];
    Flank *w = now[s];
    EdgeId h = w->h;
    flips += action >> 1;
    steps++;
    if (action & 2) {
      peel(m, w, s);
      load(m, &f, w, h, s, side);
    } else { // ghost v -> l becomes (v, l, r)
      m->vert[h + 2] = end[1 - s];
      bulk_link(m, h + 1 + s, base); // l -> r
      base = h + 2 - s;              // r -> v
      end[s] = w->v;
      bx = choose(side, f.x, bx);
      by = choose(side, f.y, by);
      f.x = choose(side, ahead.x, f.x);
      f.y = choose(side, ahead.y, f.y);
      f.zx = choose(side, ahead.zx, f.zx);
      f.zy = choose(side, ahead.zy, f.zy);
      f.none = (ahead.none & 1u << s) | (f.none & ~(1u << s));
      now[s] = then[s];
      then[s] = w;
      h = now[s]->h;
    }
    load(m, &ahead, then[s], step(m, h, s), s, side);
  }
  m->merged += steps - (uint32_t)flips;
  m->flipped += (uint64_t)flips;
  *rise = (BulkRise){{end[0], end[1]}, {now[0]->h, now[1]->h}, base};
}
