// blossom_forest.c - alternating trees over tight edges, while duals stay
// SPDX-License-Identifier: MIT
//
// What settling leaves is mostly free vertices that can reach nothing but themselves, by an odd cycle. One
// forest, grown from all of them in breadth-first order, finds it.
#include "base/base.h"
#include "quad/blossom_tight.h"

// Marks: base + 2 * tree for inner vertices, 1 more for outer ones; less than base: not in the present
// forest.
typedef struct {
  Frac *f;
  Tight *t;
  uint32_t *up;    // n: of an inner vertex, the outer one above it
  U32Vec root;
  uint8_t *done;   // for each root: its tree has found something
  uint32_t base;
} Forest;

static uint32_t tree_of(const Forest *s, uint32_t x) { return (s->t->v[x].mark - s->base) / 2; }

// The outer vertex above an outer one of the forest ctx; NONE at the root.
static uint32_t above(const void *ctx, uint32_t outer)
{
  const Forest *s = ctx;
  uint32_t inner = s->t->v[outer].mate;
  return inner == NONE ? NONE : s->up[inner];
}

static void match(const Forest *s, uint32_t x, uint32_t y)
{
  s->t->v[x].mate = y;
  s->t->v[y].mate = x;
}

// Match the outer vertex x with y, or leave it single if that is NONE, and repair the path to its root.
static void flip_path(const Forest *s, uint32_t x, uint32_t y)
{
  for (;;) {
    uint32_t i = s->t->v[x].mate;
    if (y == NONE) s->t->v[x].mate = NONE;
    else match(s, x, y);
    if (i == NONE) return;
    y = i;
    x = s->up[i];
  }
}

// The outer vertices x and y of one tree are joined by a tight edge: the cycle stays that goes up from each
// of them to their common ancestor.
static void make_cycle(const Forest *s, uint32_t x, uint32_t y)
{
  uint32_t top = blossom__common_ancestor(s, above, x, y), next = y;
  flip_path(s, top, NONE);
  for (uint32_t o = x, i; o != top; o = s->up[i]) { // from top down to x, and over to y
    i = s->t->v[o].mate;
    tight__close(s->f, s->t, o, next);
    tight__close(s->f, s->t, i, o);
    next = i;
  }
  tight__close(s->f, s->t, top, next);
  for (uint32_t o = y, i; o != top; o = s->up[i]) {
    i = s->t->v[o].mate;
    tight__close(s->f, s->t, o, i);
    tight__close(s->f, s->t, i, s->up[i]);
  }
}

// The tree of x meets the single vertex y, or the outer vertex y of a tree.
static void meet(const Forest *s, uint32_t x, uint32_t y)
{
  uint32_t t = tree_of(s, x);
  s->done[t] = 1;
  if (s->t->v[y].mark == ON_CYCLE) {
    tight__open_cycle(s->f, s->t, y);
    flip_path(s, x, y);
  } else if (tree_of(s, y) == t) make_cycle(s, x, y);
  else {
    s->done[tree_of(s, y)] = 1;
    flip_path(s, y, NONE);
    flip_path(s, x, NONE);
    match(s, x, y);
  }
}

static void scan(const Forest *s, uint32_t x)
{
  const Tight *t = s->t;
  uint32_t mark = t->v[x].mark;
  for (uint32_t i = t->start[x]; i < t->start[x + 1]; i++) {
    TightVertex *w = &t->v[t->head[i]];
    if (w->mark < s->base) {
      w->mark = mark - 1;
      s->up[t->head[i]] = x;
      t->v[w->mate].mark = mark;
      vec_push(&s->f->list, w->mate);
    } else if (w->mark == ON_CYCLE || ((w->mark & 1) && !s->done[tree_of(s, t->head[i])])) {
      meet(s, x, t->head[i]);
      return;
    }
  }
}

static void plant(Forest *s)
{
  const TightVertex *v = s->t->v;
  vec_clear(&s->root);
  for (uint32_t x = 0; x < s->f->n; x++)
    if (v[x].mate == NONE && v[x].mark != ON_CYCLE) vec_push(&s->root, x);
  vec_clear(&s->f->list);
  for (size_t k = 0; k < s->root.len; k++) {
    s->t->v[s->root.data[k]].mark = s->base + 2 * (uint32_t)k + 1;
    vec_push(&s->f->list, s->root.data[k]);
  }
}

// Returns how many trees have found something.
static size_t grow_forest(Forest *s)
{
  const U32Vec *list = &s->f->list;
  plant(s);
  s->done = mem_zalloc(s->root.len + 1);
  for (size_t k = 0; k < list->len; k++) {
    tight__prefetch(s->t, list, k);
    uint32_t x = list->data[k], mark = s->t->v[x].mark; // it may be on a cycle by now, or have been
    if (mark >= s->base && (mark & 1) && mark != ON_CYCLE && !s->done[tree_of(s, x)]) scan(s, x);
  }
  size_t found = 0;
  for (size_t k = 0; k < s->root.len; k++) found += s->done[k];
  free(s->done);
  s->f->stats->settle += list->len;
  s->base += 2 * (uint32_t)s->root.len;
  return found;
}

void tight__forest(Frac *f, Tight *t)
{
  Forest s = {.f = f, .t = t, .base = 2};
  s.up = mem_alloc(((size_t)f->n + 1) * sizeof *s.up);
  while (grow_forest(&s) > s.root.len / 8) {}
  vec_clear(&f->list);
  tight__clear_marks(f, t);
  free(s.up);
  vec_free(&s.root);
}
