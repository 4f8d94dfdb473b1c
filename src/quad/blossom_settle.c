// blossom_settle.c - free vertices are brought together over tight edges
// SPDX-License-Identifier: MIT
//
// A free vertex moves over a tight edge and the matched edge behind it: the two are exchanged. Here all of
// them move towards each other at once, along distances found by one breadth-first search; those whose aim
// another one took first are stuck where it was, and much nearer to the next one when the distances are made
// anew. The search waits for memory more than for anything; so it works on a copy of mates and tight edges,
// which is much smaller.
#include "base/base.h"
#include "quad/blossom_frac.h"

// What a search needs of a vertex. Its level is `base` + the number of matched edges between it and the
// nearest single vertex or odd cycle; less than `base`: not reached.
typedef struct {
  uint32_t mate;  // NONE: free, or on an odd cycle
  uint32_t level; // ON_CYCLE: no search enters it
} SettleVertex;

#define ON_CYCLE UINT32_MAX

typedef struct {
  SettleVertex *v;
  uint32_t *start; // n + 1: tight edges of v lead to head[start[v]] .. head[start[v + 1] - 1]
  uint32_t *head;
  uint32_t base, next_base; // levels of the present search, and of the next one
  U32Vec root;  // free vertices that may still find a partner
  U32Vec near;  // those of them that the search reached, nearest first
  U32Vec cycle; // vertices that are or were on odd cycles
  U32Vec trace; // unmatched arcs a free vertex has moved over
} Settle;

// A search gives up when it has gone on for GIVE_UP times its way to the last free vertex reached, and
// n / SURE_PART.
enum { GIVE_UP = 2, SURE_PART = 64 };

static bool tight(const Frac *f, uint32_t a) { return frac__slack(f, a) == 0; }

static void settle_init(const Frac *f, Settle *s)
{
  uint32_t n = f->n, used = 0;
  *s = (Settle){.next_base = 1};
  s->v = mem_alloc(((size_t)n + 1) * sizeof *s->v);
  s->start = mem_alloc(((size_t)n + 1) * sizeof *s->start);
  s->head = mem_alloc(((size_t)f->v[n].start + 1) * sizeof *s->head);
  for (uint32_t v = 0; v < n; v++) {
    const FracVertex *x = &f->v[v];
    s->v[v] = (SettleVertex){.mate = x->match == NONE ? NONE : frac__mate(f, v)};
    if (frac__is_free(x)) vec_push(&s->root, v);
    if (frac__on_cycle(x)) {
      vec_push(&s->cycle, v);
      s->v[v].level = ON_CYCLE;
    }
    s->start[v] = used;
    for (uint32_t a = x->start; a < f->v[v + 1].start; a++)
      if (tight(f, a)) s->head[used++] = f->arc[a].head;
  }
  s->start[n] = used;
}

static void settle_release(Settle *s)
{
  free(s->v);
  free(s->start);
  free(s->head);
  vec_free(&s->root);
  vec_free(&s->near);
  vec_free(&s->cycle);
  vec_free(&s->trace);
}

// What the search will come to soon, on its way from list[k] to its tight edges and their heads.
static inline void prefetch(const Frac *f, const Settle *s, size_t k)
{
  const uint32_t *x = f->list.data + k;
  if (k + 24 >= f->list.len) return;
  __builtin_prefetch(&s->start[x[24]]);
  __builtin_prefetch(&s->head[s->start[x[16]]]);
  for (uint32_t i = s->start[x[8]]; i < s->start[x[8] + 1]; i++) __builtin_prefetch(&s->v[s->head[i]]);
}

// The vertices at tight edges of x, but those seen, are at a level; the search goes on from their mates.
static inline void spread(Frac *f, Settle *s, uint32_t x, uint32_t level)
{
  for (uint32_t i = s->start[x]; i < s->start[x + 1]; i++) {
    SettleVertex *w = &s->v[s->head[i]];
    if (w->level >= s->base) continue;
    w->level = level;
    vec_push(w->mate == NONE ? &s->near : &f->list, w->mate == NONE ? s->head[i] : w->mate);
  }
}

// A new range of levels; all are given back before they run out.
static void start_levels(const Frac *f, Settle *s)
{
  if (s->next_base >= ON_CYCLE - f->n - 1) {
    for (uint32_t v = 0; v < f->n; v++)
      if (s->v[v].level != ON_CYCLE) s->v[v].level = 0;
    s->next_base = 1;
  }
  s->base = s->next_base;
}

// Distances to single vertices and odd cycles; s->near. list: mates of what was reached, in breadth-first
// order.
static void measure(Frac *f, Settle *s, bool all)
{
  start_levels(f, s);
  vec_clear(&f->list);
  vec_clear(&s->near);
  for (size_t k = 0; k < s->root.len; k++) spread(f, s, s->root.data[k], s->base);
  for (size_t k = 0; k < s->cycle.len; k++)
    if (frac__on_cycle(&f->v[s->cycle.data[k]])) spread(f, s, s->cycle.data[k], s->base);
  size_t last = f->list.len, end = last, found = s->near.len, sure = f->n / SURE_PART;
  uint32_t level = s->base + 1;
  for (size_t k = 0; k < f->list.len && s->near.len < s->root.len; k++) {
    if (!all && k >= GIVE_UP * last + sure) break;
    if (k == end) {
      end = f->list.len;
      level++;
    }
    prefetch(f, s, k);
    spread(f, s, f->list.data[k], level);
    if (s->near.len == found) continue;
    found = s->near.len;
    last = f->list.len;
  }
  s->next_base = level + 1;
  f->stats->settle += f->list.len;
}

// frac__match and frac__open_cycle, kept in step in the copy.
static void match(const Frac *f, const Settle *s, uint32_t a)
{
  uint32_t u = f->arc[a].tail, w = f->arc[a].head;
  frac__match(f, a);
  s->v[u].mate = w;
  s->v[w].mate = u;
}

static void open_cycle(const Frac *f, const Settle *s, uint32_t w)
{
  frac__open_cycle(f, w);
  s->v[w].level = 0;
  for (uint32_t x = f->arc[f->v[w].pred].head; x != w; x = f->arc[f->v[x].pred].head)
    s->v[x] = (SettleVertex){.mate = frac__mate(f, x)};
}

// Move the free vertex x over ever smaller distances. Returns where it is stuck, or NONE if it has a partner.
static uint32_t walk(const Frac *f, Settle *s, uint32_t x)
{
  vec_clear(&s->trace);
  for (;;) {
    uint32_t best = NONE, least = s->v[x].level;
    for (uint32_t a = f->v[x].start; a < f->v[x + 1].start; a++) {
      uint32_t y = f->arc[a].head;
      if (!tight(f, a)) continue;
      if (f->v[y].match == NONE) {
        if (frac__on_cycle(&f->v[y])) open_cycle(f, s, y);
        match(f, s, a);
        return NONE;
      }
      const SettleVertex *m = &s->v[s->v[y].mate];
      if (m->level < s->base || m->level >= least) continue;
      least = m->level;
      best = a;
    }
    if (best == NONE) return x;
    vec_push(&s->trace, best);
    x = frac__mate(f, f->arc[best].head);
    match(f, s, best);
    f->v[x].match = f->v[x].pred = s->v[x].mate = NONE;
  }
}

// v is on an odd cycle now, and `pred` leads to the next vertex.
static void close_at(const Frac *f, Settle *s, uint32_t v, uint32_t pred)
{
  f->v[v].pred = pred;
  f->v[v].match = NONE;
  s->v[v] = (SettleVertex){.mate = NONE, .level = ON_CYCLE};
  vec_push(&s->cycle, v);
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
    close_at(f, s, u, a);
    close_at(f, s, y, tight_arc(f, y, k + 1 < s->trace.len ? f->arc[s->trace.data[k + 1]].tail : x));
  }
  close_at(f, s, x, close);
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
  Settle s;
  settle_init(f, &s);
  for (bool first = true; s.root.len; first = false) {
    measure(f, &s, first);
    if (walk_all(f, &s) == 0) break;
  }
  vec_clear(&f->list);
  settle_release(&s);
}
