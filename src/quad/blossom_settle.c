// blossom_settle.c - free vertices are brought together over tight edges
// SPDX-License-Identifier: MIT
//
// A free vertex moves over a tight edge and the matched edge behind it: the two are exchanged. Here all of them move towards
// each other at once, along distances found by one breadth-first search; those whose aim another one took first are
// stuck where it was, and much nearer to the next one when the distances are made anew.
#include "base/base.h"
#include "quad/blossom_frac.h"

typedef struct {
  U32Vec root;  // free vertices that may still find a partner
  U32Vec near;  // those of them that the search reached, nearest first
  U32Vec cycle; // vertices that are or were on odd cycles
  U32Vec trace; // unmatched arcs a free vertex has moved over
} Settle;

// A search gives up when it has gone on for GIVE_UP times its way to the last free vertex reached, and n / SURE_PART.
enum { GIVE_UP = 2, SURE_PART = 64 };

static bool tight(const Frac *f, uint32_t a) { return frac__slack(f, a) == 0; }

// What the search will come to soon, on its way from list[k] to its mate, its arcs, and their heads.
static inline void prefetch(const Frac *f, size_t k)
{
  const uint32_t *x = f->list.data + k;
  if (k + 24 >= f->list.len) return;
  __builtin_prefetch(&f->v[x[24]]);
  if (f->v[x[16]].match != NONE) __builtin_prefetch(&f->arc[f->v[x[16]].match]);
  if (f->v[x[8]].match != NONE) __builtin_prefetch(&f->v[frac__mate(f, x[8])]);
  if (f->v[x[4]].match != NONE) __builtin_prefetch(&f->arc[f->v[frac__mate(f, x[4])].start]);
  if (f->v[x[2]].match == NONE) return;
  uint32_t i = frac__mate(f, x[2]);
  for (uint32_t a = f->v[i].start; a < f->v[i + 1].start; a++) __builtin_prefetch(&f->v[f->arc[a].head]);
}

// The vertices at tight edges of x, but those seen and `but`, are at a distance.
static void spread(Frac *f, uint32_t x, uint32_t but, uint32_t dist)
{
  for (uint32_t a = f->v[x].start; a < f->v[x + 1].start; a++) {
    uint32_t y = f->arc[a].head;
    FracVertex *w = &f->v[y];
    if (y == but || w->mark == f->stamp || frac__on_cycle(w) || !tight(f, a)) continue;
    w->mark = f->stamp;
    w->dist = dist;
    vec_push(&f->list, y);
  }
}

// Distances to single vertices and odd cycles; s->near.
static void measure(Frac *f, Settle *s, bool all)
{
  f->stamp++;
  vec_clear(&f->list);
  vec_clear(&s->near);
  for (size_t k = 0; k < s->root.len; k++) spread(f, s->root.data[k], NONE, 0);
  for (size_t k = 0; k < s->cycle.len; k++)
    if (frac__on_cycle(&f->v[s->cycle.data[k]])) spread(f, s->cycle.data[k], NONE, 0);
  size_t last = f->list.len, sure = f->n / SURE_PART;
  for (size_t k = 0; k < f->list.len && s->near.len < s->root.len && (all || k < GIVE_UP * last + sure); k++) {
    uint32_t x = f->list.data[k];
    prefetch(f, k);
    if (f->v[x].match == NONE) {
      vec_push(&s->near, x);
      last = k;
    } else spread(f, frac__mate(f, x), x, f->v[x].dist + 1);
  }
  f->stats->settle += f->list.len;
}

// Move the free vertex x over ever smaller distances. Returns where it is stuck, or NONE if it has a partner now.
static uint32_t walk(Frac *f, Settle *s, uint32_t x)
{
  vec_clear(&s->trace);
  for (;;) {
    uint32_t best = NONE, least = f->v[x].dist;
    for (uint32_t a = f->v[x].start; a < f->v[x + 1].start; a++) {
      uint32_t y = f->arc[a].head;
      if (!tight(f, a)) continue;
      if (f->v[y].match == NONE) {
        if (frac__on_cycle(&f->v[y])) frac__open_cycle(f, y);
        frac__match(f, a);
        return NONE;
      }
      const FracVertex *m = &f->v[frac__mate(f, y)];
      if (m->mark != f->stamp || m->dist >= least) continue;
      least = m->dist;
      best = a;
    }
    if (best == NONE) return x;
    vec_push(&s->trace, best);
    x = frac__mate(f, f->arc[best].head);
    frac__match(f, best);
    f->v[x].match = f->v[x].pred = NONE;
  }
}

static uint32_t tight_arc(const Frac *f, uint32_t x, uint32_t y)
{
  for (uint32_t a = f->v[x].start; a < f->v[x + 1].start; a++)
    if (f->arc[a].head == y && tight(f, a)) return a;
  return NONE;
}

// If a walk from r ended in sight of r, there is an odd cycle.
static bool close_walk(const Frac *f, Settle *s, uint32_t r, uint32_t x)
{
  uint32_t close = s->trace.len ? tight_arc(f, x, r) : NONE;
  if (close == NONE) return false;
  for (size_t k = 0; k < s->trace.len; k++) {
    uint32_t a = s->trace.data[k], u = f->arc[a].tail, y = f->arc[a].head;
    f->v[u].pred = a;
    f->v[y].pred = tight_arc(f, y, k + 1 < s->trace.len ? f->arc[s->trace.data[k + 1]].tail : x);
    f->v[u].match = f->v[y].match = NONE;
    vec_push(&s->cycle, u);
    vec_push(&s->cycle, y);
  }
  f->v[x].pred = close;
  vec_push(&s->cycle, x);
  return true;
}

// All that were reached walk, nearest first. Returns how many are free no more; the others are s->root.
static size_t walk_all(Frac *f, Settle *s)
{
  size_t left = 0;
  vec_clear(&s->root);
  for (size_t k = 0; k < s->near.len; k++) {
    uint32_t r = s->near.data[k];
    if (!frac__is_free(&f->v[r])) continue;
    uint32_t x = walk(f, s, r);
    if (x != NONE && !close_walk(f, s, r, x)) vec_push(&s->root, x);
  }
  for (size_t k = 0; k < s->root.len; k++)
    if (frac__is_free(&f->v[s->root.data[k]])) s->root.data[left++] = s->root.data[k];
  s->root.len = left;
  return s->near.len - left;
}

void frac__settle(Frac *f)
{
  Settle s = {0};
  f->stamp = MAX(f->stamp, f->n);
  for (uint32_t v = 0; v < f->n; v++) {
    if (frac__is_free(&f->v[v])) vec_push(&s.root, v);
    if (frac__on_cycle(&f->v[v])) vec_push(&s.cycle, v);
  }
  for (bool first = true; s.root.len; first = false) {
    measure(f, &s, first);
    if (walk_all(f, &s) == 0) break;
  }
  vec_clear(&f->list);
  vec_free(&s.root);
  vec_free(&s.near);
  vec_free(&s.cycle);
  vec_free(&s.trace);
}
