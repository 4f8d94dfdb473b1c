// intersect.c - segments against segments by a hierarchy of octagons
// SPDX-License-Identifier: MIT
//
// Rounding needs no margin: x + y and x - y are rounded monotonously, so if two segments share a point their intervals of
// rounded values overlap.
#include "base/base.h"

#include "geom/intersect_int.h"

#include "geom/hilbert.h"

enum { LEAF = 4 }; // segments per leaf
enum { STEPS_PER_SEGMENT = 50, STEPS_PER_PAIR = 50 }; // a chain takes 3 a segment, short edges all over the plane 2

// Intervals of x, y, x + y and x - y.
typedef struct {
  double lo[4], hi[4];
} Octagon;

typedef struct {
  Seg *seg;
  size_t n;
  Octagon *node;     // a complete binary tree: node 1 is the root, 2i and 2i+1 are below i
  size_t leaves;     // a power of two; leaf k is node leaves + k and has segments LEAF*k ..
  size_t most;
  SegPairVec *out;
  uint64_t steps;    // pairs of nodes to be looked at before the search is given up
  bool all;
} Matcher;

static Octagon octagon_of(const Seg *s)
{
  double a[4] = {s->p[0], s->p[1], s->p[0] + s->p[1], s->p[0] - s->p[1]};
  double b[4] = {s->p[2], s->p[3], s->p[2] + s->p[3], s->p[2] - s->p[3]};
  Octagon o;
  for (int i = 0; i < 4; i++) {
    o.lo[i] = MIN(a[i], b[i]);
    o.hi[i] = MAX(a[i], b[i]);
  }
  return o;
}

static void include(Octagon *o, const Octagon *p)
{
  for (int i = 0; i < 4; i++) {
    o->lo[i] = MIN(o->lo[i], p->lo[i]);
    o->hi[i] = MAX(o->hi[i], p->hi[i]);
  }
}

static Octagon empty_octagon(void)
{
  Octagon o;
  for (int i = 0; i < 4; i++) o.lo[i] = INFINITY, o.hi[i] = -INFINITY;
  return o;
}

static inline bool disjoint(const Octagon *a, const Octagon *b)
{
  // Bitwise: comparisons without branches.
  bool apart = false;
  for (int i = 0; i < 4; i++) apart |= (a->lo[i] > b->hi[i]) | (b->lo[i] > a->hi[i]);
  return apart;
}

static inline bool boxes_apart(const double *p, const double *q)
{
  return MAX(p[0], p[2]) < MIN(q[0], q[2]) || MAX(q[0], q[2]) < MIN(p[0], p[2]) || MAX(p[1], p[3]) < MIN(q[1], q[3]) ||
         MAX(q[1], q[3]) < MIN(p[1], p[3]);
}

bool intersect__meet(const Seg *s, const Seg *t, SegMeet *how)
{
  if (boxes_apart(s->p, t->p)) return false;
  // A chain's neighbours: only folding back on each other counts, and that needs three collinear points.
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++)
      if (s->v[i] == t->v[j] && orient2d(s->p + 2 * (1 - i), s->p + 2 * i, t->p + 2 * (1 - j)) != 0) return false;
  *how = segments_meet(s->p, s->p + 2, t->p, t->p + 2);
  return *how != SEG_DISJOINT && *how != SEG_SHARE;
}

static void match(Matcher *m, const Seg *s, const Seg *t)
{
  SegMeet how;
  if (!intersect__meet(s, t, &how)) return;
  if (m->out->len >= m->most) {
    m->all = false;
    return;
  }
  vec_push(m->out, ((SegPair){MIN(s->id, t->id), MAX(s->id, t->id), how}));
  m->steps += STEPS_PER_PAIR;
}

static void match_leaves(Matcher *m, size_t a, size_t b)
{
  size_t a1 = MIN(LEAF * (a + 1), m->n), b1 = MIN(LEAF * (b + 1), m->n);
  for (size_t i = LEAF * a; i < a1; i++)
    for (size_t j = a == b ? i + 1 : LEAF * b; j < b1; j++) match(m, &m->seg[i], &m->seg[j]);
}

// Depth-first over pairs of nodes of one level. False if it takes too long.
static bool match_all(Matcher *m)
{
  typedef struct {
    uint32_t a, b;
  } Pair;
  Vec(Pair) stack = {0};
  vec_push(&stack, ((Pair){1, 1}));
  for (; stack.len && m->all && m->steps; m->steps--) {
    Pair p = vec_pop(&stack);
    if (p.a != p.b && disjoint(&m->node[p.a], &m->node[p.b])) continue;
    if (p.a >= m->leaves) {
      match_leaves(m, p.a - m->leaves, p.b - m->leaves);
      continue;
    }
    vec_push(&stack, ((Pair){2 * p.a, 2 * p.b}));
    vec_push(&stack, ((Pair){2 * p.a, 2 * p.b + 1}));
    vec_push(&stack, ((Pair){2 * p.a + 1, 2 * p.b + 1}));
    if (p.a != p.b) vec_push(&stack, ((Pair){2 * p.a + 1, 2 * p.b}));
  }
  bool done = !stack.len || !m->all;
  vec_free(&stack);
  return done;
}

static void build(Matcher *m, const double *xy, const uint32_t *end, size_t n)
{
  double *mid = mem_alloc(2 * n * sizeof *mid);
  uint32_t *order = mem_alloc(n * sizeof *order);
  for (size_t i = 0; i < n; i++) {
    const double *a = xy + 2 * (size_t)end[2 * i], *b = xy + 2 * (size_t)end[2 * i + 1];
    mid[2 * i] = a[0] / 2 + b[0] / 2;
    mid[2 * i + 1] = a[1] / 2 + b[1] / 2;
  }
  hilbert_order(mid, n, order);
  free(mid);
  m->seg = mem_alloc(n * sizeof *m->seg);
  for (size_t k = 0; k < n; k++) {
    size_t i = order[k];
    const double *a = xy + 2 * (size_t)end[2 * i], *b = xy + 2 * (size_t)end[2 * i + 1];
    if (a[0] == b[0] && a[1] == b[1]) continue;
    bool back = lex_compare(a, b) > 0;
    const double *p = back ? b : a, *q = back ? a : b;
    m->seg[m->n++] = (Seg){{p[0], p[1], q[0], q[1]}, {end[2 * i + back], end[2 * i + !back]}, (uint32_t)i};
  }
  free(order);
  for (m->leaves = 1; m->leaves * LEAF < m->n;) m->leaves *= 2;
  m->node = mem_alloc(2 * m->leaves * sizeof *m->node);
  for (size_t k = 0; k < m->leaves; k++) {
    Octagon o = empty_octagon();
    for (size_t i = LEAF * k; i < MIN(LEAF * (k + 1), m->n); i++) {
      Octagon s = octagon_of(&m->seg[i]);
      include(&o, &s);
    }
    m->node[m->leaves + k] = o;
  }
  for (size_t k = m->leaves - 1; k > 0; k--) {
    m->node[k] = m->node[2 * k];
    include(&m->node[k], &m->node[2 * k + 1]);
  }
}

static int by_segments(const void *p, const void *q)
{
  const SegPair *x = p, *y = q;
  if (x->a != y->a) return x->a < y->a ? -1 : 1;
  return x->b < y->b ? -1 : x->b > y->b;
}

void intersect__order(SegPairVec *out, size_t from)
{
  if (out->len <= from) return;
  qsort(out->data + from, out->len - from, sizeof *out->data, by_segments);
  size_t n = from + 1;
  for (size_t i = n; i < out->len; i++)
    if (by_segments(&out->data[i], &out->data[n - 1]) != 0) out->data[n++] = out->data[i];
  out->len = n;
}

bool segments_intersect(const double *xy, const uint32_t *end, size_t n, size_t most, SegPairVec *out)
{
  if (n < 2) return true;
  size_t before = out->len;
  Matcher m = {.most = before + most, .out = out, .all = true, .steps = STEPS_PER_SEGMENT * (uint64_t)n};
  build(&m, xy, end, n);
  if (match_all(&m)) {
    intersect__order(out, before);
  } else {
    out->len = before;
    m.all = intersect__by_slabs(m.seg, m.n, most, out);
  }
  free(m.seg);
  free(m.node);
  return m.all;
}
