// tri_segment.c - recovery of segments by flips
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_int.h"

// One edge that crosses the segment a -> b being recovered: its half-edge from the right of the segment to the left, in a
// list ordered from a to b.
typedef struct {
  EdgeId h;
  uint32_t prev, next;
} Crossing;

typedef struct {
  Tri *m;
  VertId a, b; // the part of the segment that is being recovered
  Vec(Crossing) list;
  uint32_t head;
  U32Vec work; // half-edges whose triangles changed
} Recovery;

static int side(Recovery *r, VertId v)
{
  Tri *m = r->m;
  return orient2d_count(tri_xy(m, r->a), tri_xy(m, r->b), tri_xy(m, v), &m->count);
}

// Sign of the distance from the line ab of u less that of v.
static int compare_height(const Recovery *r, VertId u, VertId v)
{
  const Tri *m = r->m;
  return cross_sign(tri_xy(m, r->a), tri_xy(m, r->b), tri_xy(m, v), tri_xy(m, u));
}

static VertId left_end(const Recovery *r, uint32_t k) { return tri_dest(r->m, r->list.data[k].h); }

static void unlink_crossing(Recovery *r, uint32_t k)
{
  Crossing *c = &r->list.data[k];
  if (c->prev != NONE) r->list.data[c->prev].next = c->next;
  else r->head = c->next;
  if (c->next != NONE) r->list.data[c->next].prev = c->prev;
}

// Flip crossing k. Its place in the list keeps the new edge if that crosses too.
static void flip_crossing(Recovery *r, uint32_t k)
{
  Tri *m = r->m;
  Crossing *c = &r->list.data[k];
  EdgeId e = c->h, g = m->twin[e];
  // The next crossing's half-edge is in the second triangle: it is found again from its twin, which stays.
  EdgeId beyond = c->next != NONE ? m->twin[r->list.data[c->next].h] : NONE;
  tri_flip(m, e);
  if (beyond != NONE) r->list.data[c->next].h = m->twin[beyond];
  EdgeId touched[5] = {e, tri_next(e), tri_prev(e), tri_next(g), tri_prev(g)};
  for (int i = 0; i < 5; i++) vec_push(&r->work, touched[i]);
  VertId from = m->vert[e], to = m->vert[g];
  bool crosses = from != r->a && from != r->b && to != r->a && to != r->b && side(r, from) != side(r, to);
  if (!crosses) unlink_crossing(r, k);
  else c->h = side(r, from) < 0 ? e : g;
}

// The crossings whose left end is that of k: first and last of them.
static void range_of(const Recovery *r, uint32_t k, uint32_t *first, uint32_t *last)
{
  VertId y = left_end(r, k);
  *first = *last = k;
  while (r->list.data[*first].prev != NONE && left_end(r, r->list.data[*first].prev) == y)
    *first = r->list.data[*first].prev;
  while (r->list.data[*last].next != NONE && left_end(r, r->list.data[*last].next) == y)
    *last = r->list.data[*last].next;
}

// Flip until no edge crosses. Take a left vertex y whose neighbours along the left side of the channel are not farther
// from the segment, the one before strictly nearer. Let x_1 .. x_d be the right ends of its crossing edges. Then some
// y x_i can be flipped: y is a convex corner of each quadrilateral, and were every x_i reflex, the chain from the left
// neighbour through x_1 .. x_d to the right one would be concave and lie beyond its chord, but the neighbours are left of
// the segment or on it and the x_i right of it. Every flip takes an edge away from y without giving any other
// vertex of the left side more than y lost; so y is soon free, the left side has one vertex less, and it all ends.
static void remove_crossings(Recovery *r)
{
  uint32_t k = r->head;
  while (r->head != NONE) {
    uint32_t first, last;
    range_of(r, k, &first, &last);
    VertId y = left_end(r, k);
    uint32_t before = r->list.data[first].prev, after = r->list.data[last].next;
    if (after != NONE && compare_height(r, left_end(r, after), y) > 0) {
      k = after;
      continue;
    }
    if (before != NONE && compare_height(r, left_end(r, before), y) >= 0) {
      k = before;
      continue;
    }
    for (bool any = true; any;) { // until y has no crossing edge left
      any = false;
      uint32_t start = before == NONE ? r->head : r->list.data[before].next;
      bool flipped = false;
      for (uint32_t i = start, next; i != after; i = next) {
        next = r->list.data[i].next;
        if (left_end(r, i) != y) continue;
        if (tri_can_flip(r->m, r->list.data[i].h)) {
          flip_crossing(r, i);
          flipped = true;
        } else any = true;
      }
      CHECK(flipped || !any);
    }
    k = before != NONE ? before : r->head;
  }
}

// What the ray from a toward b meets first.
typedef enum { RAY_VERTEX, RAY_CROSSES } Ray;

// Turn around a: *e is the edge from a along the segment, or the first edge that crosses it (right to left).
static Ray leave(Recovery *r, EdgeId *e)
{
  Tri *m = r->m;
  EdgeId first = m->hint[r->a], f = first;
  do {
    VertId x = tri_dest(m, f);
    if (x == r->b) {
      *e = f;
      return RAY_VERTEX;
    }
    f = tri_ccw(m, f);
  } while (f != first);
  const double *a = tri_xy(m, r->a), *b = tri_xy(m, r->b);
  do {
    VertId x = tri_dest(m, f), y = tri_apex(m, f);
    if (x != TRI_INF) {
      int s = side(r, x);
      if (s == 0 && (lex_compare(a, tri_xy(m, x)) < 0) == (lex_compare(a, b) < 0)) {
        *e = f;
        return RAY_VERTEX;
      }
      if (s < 0 && y != TRI_INF && side(r, y) > 0) {
        *e = tri_next(f);
        return RAY_CROSSES;
      }
    }
    f = tri_ccw(m, f);
  } while (f != first);
  UNREACHABLE();
}

// Collect the crossing edges from half-edge h on, up to the first vertex on the segment, which becomes r->b. Returns NONE,
// or the first half-edge of them that is a segment itself.
static EdgeId collect(Recovery *r, EdgeId h)
{
  Tri *m = r->m;
  vec_clear(&r->list);
  r->head = 0;
  for (;;) {
    if (tri_is_segment(m, h)) return h;
    uint32_t k = (uint32_t)r->list.len;
    vec_push(&r->list, ((Crossing){h, k ? k - 1 : NONE, NONE}));
    if (k) r->list.data[k - 1].next = k;
    EdgeId g = m->twin[h];
    VertId w = tri_apex(m, g);
    int s = w == r->b ? 0 : side(r, w);
    if (s == 0) {
      r->b = w;
      return NONE;
    }
    h = s > 0 ? tri_next(g) : tri_prev(g);
  }
}

static void report(TriSegEvents *events, TriSegWhat what, uint32_t a, uint32_t b, VertId v, const double *p)
{
  if (!events) return;
  vec_push(events, ((TriSegEvent){what, a, b, v, {p[0], p[1]}}));
}

static void mark(Recovery *r, EdgeId e, uint32_t id, TriSegEvents *events)
{
  Tri *m = r->m;
  if (tri_is_segment(m, e)) {
    report(events, TRI_SEG_OVERLAPS, id, m->seg[e], m->vert[e], tri_xy(m, m->vert[e]));
    return;
  }
  tri__set_segment(m, e, id);
  tri__set_segment(m, m->twin[e], id);
}

// The segment from u to v; false if it crosses another.
static bool insert_segment(Recovery *r, VertId u, VertId v, uint32_t id, TriSegEvents *events)
{
  Tri *m = r->m;
  if (u == v) report(events, TRI_SEG_EMPTY, id, NONE, u, tri_xy(m, u));
  for (r->a = u; r->a != v; r->a = r->b) {
    r->b = v;
    EdgeId e;
    if (leave(r, &e) == RAY_VERTEX) r->b = tri_dest(m, e);
    else {
      EdgeId other = collect(r, e);
      if (other != NONE) {
        double p[2];
        VertId c = m->vert[other], d = tri_dest(m, other);
        segments_point(tri_xy(m, u), tri_xy(m, v), tri_xy(m, c), tri_xy(m, d), p);
        report(events, TRI_SEG_CROSSES, id, m->seg[other], NONE, p);
        return false;
      }
      remove_crossings(r);
      e = tri_find_edge(m, r->a, r->b);
      CHECK(e != NONE);
    }
    mark(r, e, id, events);
    tri_legalize(m, &r->work);
    if (r->b != v) report(events, TRI_SEG_VERTEX, id, NONE, r->b, tri_xy(m, r->b));
  }
  return true;
}

// Points on one line: every edge between neighbours is there, in two ghosts.
static EdgeId chain_edge(Tri *m, VertId a, VertId b)
{
  EdgeId first = m->hint[a], e = first;
  bool up = lex_compare(tri_xy(m, a), tri_xy(m, b)) < 0;
  do {
    VertId x = tri_dest(m, e);
    if (x != TRI_INF && (lex_compare(tri_xy(m, a), tri_xy(m, x)) < 0) == up) return e;
    e = tri_ccw(m, e);
  } while (e != first);
  UNREACHABLE();
}

static void insert_in_chain(Recovery *r, VertId u, VertId v, uint32_t id, TriSegEvents *events)
{
  Tri *m = r->m;
  if (u == v) report(events, TRI_SEG_EMPTY, id, NONE, u, tri_xy(m, u));
  for (VertId a = u; a != v;) {
    EdgeId e = chain_edge(m, a, v);
    mark(r, e, id, events);
    a = tri_dest(m, e);
    if (a != v) report(events, TRI_SEG_VERTEX, id, NONE, a, tri_xy(m, a));
  }
}

// Segments mostly follow one another, but through arrays too large for the caches: fetch ahead what one will touch.
static void prefetch(const Tri *m, const uint32_t *ends, size_t i, size_t n)
{
  enum { HINT_AHEAD = 24, FACE_AHEAD = 12 };
  if (i + HINT_AHEAD < n) __builtin_prefetch(&m->hint[ends[2 * (i + HINT_AHEAD)]]);
  EdgeId e = i + FACE_AHEAD < n ? m->hint[ends[2 * (i + FACE_AHEAD)]] : NONE;
  if (e == NONE) return;
  __builtin_prefetch(&m->vert[e]);
  __builtin_prefetch(&m->twin[e]);
  __builtin_prefetch(&m->seg[e], 1);
  __builtin_prefetch(&m->flag[e / 3], 1);
}

size_t tri_insert_segments(Tri *m, const uint32_t *ends, const uint32_t *ids, size_t n, TriSegEvents *events)
{
  Recovery r = {.m = m};
  size_t crossings = 0;
  tri__make_segments(m);
  tri_make_hints(m);
  for (size_t i = 0; i < n; i++) {
    uint32_t id = ids ? ids[i] : (uint32_t)i;
    prefetch(m, ends, i, n);
    if (m->dim == 2) crossings += !insert_segment(&r, ends[2 * i], ends[2 * i + 1], id, events);
    else insert_in_chain(&r, ends[2 * i], ends[2 * i + 1], id, events);
  }
  vec_free(&r.list);
  vec_free(&r.work);
  return crossings;
}
