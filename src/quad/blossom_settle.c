// blossom_settle.c - free vertices are brought together over tight edges
// SPDX-License-Identifier: MIT
//
// A free vertex moves over a tight edge and the matched edge behind it: the two are exchanged. Here all of
// them move towards each other, along distances found by one breadth-first search for all. Most find their
// aim taken by another; they go on along distances that they correct for themselves as they go
// [Goldberg1988], for a while, and then distances are made anew.
#include "base/base.h"
#include "quad/blossom_tight.h"

// The mark of a vertex is its level: `base` + the number of matched edges between it and the nearest aim;
// less than `base`: not reached.
typedef struct {
  Frac *f;
  Tight *t;
  bool within;  // only between the sides of regions: those on side 0 move, and those on side 1 are the aims
  uint32_t base, next_base; // levels of the present search, and of the next one
  U32Vec mover; // free vertices that may still find a partner
  U32Vec near;  // those of them that the search reached, nearest first
  U32Vec aim;   // free vertices that the search starts from, if they are others than the movers
  U32Vec cycle; // vertices that are or were on odd cycles: aims as well
} Settle;

// A search gives up when it has gone on for GIVE_UP times its way to the last mover reached, and n /
// SURE_PART. A mover gives up when it has corrected n / PATIENCE distances.
enum { GIVE_UP = 2, SURE_PART = 64, PATIENCE = 1024 };

static void init(Settle *s)
{
  const Frac *f = s->f;
  for (uint32_t v = 0; v < f->n; v++) {
    const TightVertex *x = &s->t->v[v];
    if (x->mate != NONE) continue;
    if (x->mark != ON_CYCLE) vec_push(s->within && (x->side & 1) ? &s->aim : &s->mover, v);
    else if (!s->within) vec_push(&s->cycle, v);
  }
}

static bool joined(const Settle *s, uint32_t x, uint32_t y)
{
  return !s->within || s->t->v[y].side == (s->t->v[x].side ^ 1);
}

// The vertices at tight edges of x, but those seen, are at a level; the search goes on from their mates.
static inline void spread(Settle *s, uint32_t x, uint32_t level)
{
  const Tight *t = s->t;
  for (uint32_t i = t->start[x]; i < t->start[x + 1]; i++) {
    TightVertex *w = &t->v[t->head[i]];
    if (w->mark >= s->base || !joined(s, x, t->head[i])) continue;
    w->mark = level;
    vec_push(w->mate == NONE ? &s->near : &s->f->list, w->mate == NONE ? t->head[i] : w->mate);
  }
}

// A new range of levels; all are given back before they run out.
static void start_levels(Settle *s)
{
  if (s->next_base >= ON_CYCLE / 2) {
    tight__clear_marks(s->f, s->t);
    s->next_base = 1;
  }
  s->base = s->next_base;
}

static void spread_from_aims(Settle *s)
{
  const Tight *t = s->t;
  const U32Vec *aim = s->within ? &s->aim : &s->mover;
  for (size_t k = 0; k < aim->len; k++)
    if (t->v[aim->data[k]].mate == NONE) spread(s, aim->data[k], s->base);
  for (size_t k = 0; k < s->cycle.len; k++)
    if (t->v[s->cycle.data[k]].mark == ON_CYCLE) spread(s, s->cycle.data[k], s->base);
}

// Levels of all that the search reaches; s->near. list: mates of what was reached, in breadth-first order.
static void measure(Settle *s, bool all)
{
  Frac *f = s->f;
  start_levels(s);
  vec_clear(&f->list);
  vec_clear(&s->near);
  spread_from_aims(s);
  size_t last = f->list.len, end = last, found = s->near.len, sure = f->n / SURE_PART;
  uint32_t level = s->base + 1;
  for (size_t k = 0; k < f->list.len && s->near.len < s->mover.len; k++) {
    if (!all && k >= GIVE_UP * last + sure) break;
    if (k == end) {
      end = f->list.len;
      level++;
    }
    tight__prefetch(s->t, &f->list, k);
    spread(s, f->list.data[k], level);
    if (s->near.len == found) continue;
    found = s->near.len;
    last = f->list.len;
  }
  s->next_base = level + 1;
  f->stats->settle += f->list.len;
}

static void match(const Settle *s, uint32_t x, uint32_t y)
{
  s->t->v[x].mate = y;
  s->t->v[y].mate = x;
}

// ---- moves

// From x, by the tight edge whose far mate has the least level: to be matched at the end of that edge if the
// vertex there is single. NONE: there is no way.
static uint32_t best_way(const Settle *s, uint32_t x, uint32_t from, uint32_t *least)
{
  const Tight *t = s->t;
  uint32_t best = NONE;
  *least = ON_CYCLE;
  for (uint32_t i = t->start[x]; i < t->start[x + 1]; i++) {
    uint32_t y = t->head[i], m = t->v[y].mate;
    if (y == from || !joined(s, x, y)) continue;
    if (m == NONE) return y;
    if (t->v[m].mark < s->base || t->v[m].mark >= *least) continue;
    *least = t->v[m].mark;
    best = y;
  }
  return best;
}

// Move the free vertex x. Returns where it has given up, or NONE if it is free no more.
static uint32_t walk(Settle *s, uint32_t x)
{
  TightVertex *v = s->t->v;
  uint32_t patience = s->f->n / PATIENCE, from = NONE, least;
  for (;;) {
    uint32_t y = best_way(s, x, from, &least);
    if (y != NONE && v[y].mate == NONE) {
      if (v[y].mark == ON_CYCLE) tight__open_cycle(s->f, s->t, y);
      match(s, x, y);
      return NONE;
    }
    if (y == NONE || least >= v[x].mark) {
      if (y == NONE || patience-- == 0) return x;
      v[x].mark = least + 1;
      s->next_base = MAX(s->next_base, least + 2);
    }
    uint32_t next = v[y].mate;
    match(s, x, y);
    v[next].mate = NONE;
    from = y;
    x = next;
  }
}

// All that were reached move, nearest first. Returns how many are free no more; the others are s->mover.
static size_t walk_all(Settle *s)
{
  const TightVertex *v = s->t->v;
  size_t left = 0;
  vec_clear(&s->mover);
  for (size_t k = 0; k < s->near.len; k++) {
    uint32_t r = s->near.data[k];
    if (v[r].mate != NONE) continue;
    uint32_t x = walk(s, r);
    if (x != NONE) vec_push(&s->mover, x);
  }
  for (size_t k = 0; k < s->mover.len; k++) {
    uint32_t x = s->mover.data[k];
    if (v[x].mate == NONE) s->mover.data[left++] = x;
  }
  s->mover.len = left;
  return s->near.len - left;
}

void tight__settle(Frac *f, Tight *t, bool within)
{
  Settle s = {.f = f, .t = t, .within = within, .next_base = 1};
  init(&s);
  for (bool all = true; s.mover.len; all = within) {
    measure(&s, all);
    if (walk_all(&s) == 0) break;
  }
  vec_clear(&f->list);
  tight__clear_marks(f, t);
  vec_free(&s.mover);
  vec_free(&s.near);
  vec_free(&s.aim);
  vec_free(&s.cycle);
}
