// blossom_tight.c - a small copy of the tight edges, and the regions they connect
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/blossom_tight.h"

void tight__init(const Frac *f, Tight *t)
{
  uint32_t n = f->n;
  t->v = mem_alloc(((size_t)n + 1) * sizeof *t->v);
  t->start = mem_alloc(((size_t)n + 1) * sizeof *t->start);
  t->head = mem_alloc(((size_t)f->v[n].start + 1) * sizeof *t->head);
  for (uint32_t v = 0; v < n; v++) t->v[v].side = NONE;
}

void tight__release(Tight *t)
{
  free(t->v);
  free(t->start);
  free(t->head);
}

void tight__read(const Frac *f, Tight *t)
{
  uint32_t used = 0;
  for (uint32_t v = 0; v < f->n; v++) {
    const FracVertex *x = &f->v[v];
    t->v[v].mate = x->match == NONE ? NONE : frac__mate(f, v);
    t->v[v].mark = frac__on_cycle(x) ? ON_CYCLE : 0;
    t->start[v] = used;
    for (uint32_t a = x->start; a < f->v[v + 1].start; a++)
      if (frac__slack(f, a) == 0) t->head[used++] = f->arc[a].head;
  }
  t->start[f->n] = used;
}

void tight__write(const Frac *f, const Tight *t)
{
  for (uint32_t v = 0; v < f->n; v++) {
    FracVertex *x = &f->v[v];
    uint32_t w = t->v[v].mate, a = x->match;
    if (w == NONE) {
      x->match = NONE;
      if (t->v[v].mark != ON_CYCLE) x->pred = NONE;
    } else if (v < w && (a == NONE || f->arc[a].head != w || f->v[w].match != f->arc[a].rev))
      frac__match(f, tight__arc(f, v, w));
  }
}

uint32_t tight__count_free(const Frac *f, const Tight *t)
{
  uint32_t n = 0;
  for (uint32_t v = 0; v < f->n; v++) n += t->v[v].mate == NONE && t->v[v].mark != ON_CYCLE;
  return n;
}

void tight__clear_marks(const Frac *f, const Tight *t)
{
  for (uint32_t v = 0; v < f->n; v++)
    if (t->v[v].mark != ON_CYCLE) t->v[v].mark = 0;
}

void tight__close(const Frac *f, const Tight *t, uint32_t v, uint32_t next)
{
  f->v[v].pred = tight__arc(f, v, next);
  f->v[v].match = t->v[v].mate = NONE;
  t->v[v].mark = ON_CYCLE;
}

void tight__open_cycle(const Frac *f, const Tight *t, uint32_t w)
{
  frac__open_cycle(f, w);
  t->v[w].mark = 0;
  for (uint32_t x = f->arc[f->v[w].pred].head; x != w; x = f->arc[f->v[x].pred].head) {
    t->v[x].mate = frac__mate(f, x);
    t->v[x].mark = 0;
  }
}

// ---- regions: strongly connected parts [Tarjan1972], in the form of [Pearce2016]

// A vertex whose ways are being followed.
typedef struct {
  uint32_t v;
  uint32_t at;    // next of its tight edges
  uint32_t first; // its mark when it was entered
} Visit;

typedef struct {
  Tight *t;
  uint32_t entered, part; // next marks for vertices entered, and for parts found
  Vec(Visit) visit;
  U32Vec stack;
} Parts;

static void enter(Parts *p, uint32_t v)
{
  p->t->v[v].mark = p->entered;
  vec_push(&p->visit, ((Visit){v, p->t->start[v], p->entered++}));
}

// Go on from the last vertex entered, to one that is entered next, or back.
static void advance(Parts *p)
{
  Visit *visit = &p->visit.data[p->visit.len - 1];
  TightVertex *v = p->t->v, *x = &v[visit->v];
  for (uint32_t end = p->t->start[visit->v + 1]; visit->at < end; visit->at++) {
    uint32_t w = p->t->head[visit->at], u = v[w].mate;
    if (u == NONE || w == x->mate) continue;
    if (v[u].mark == 0) {
      enter(p, u);
      return;
    }
    x->mark = MIN(x->mark, v[u].mark);
  }
  uint32_t low = x->mark;
  if (low < visit->first) vec_push(&p->stack, visit->v);
  else {
    p->entered--;
    while (p->stack.len && v[p->stack.data[p->stack.len - 1]].mark >= low) {
      v[vec_pop(&p->stack)].mark = p->part;
      p->entered--;
    }
    x->mark = p->part--;
  }
  p->visit.len--;
}

// Number the parts from the greatest mark down. Returns the least.
static uint32_t strong_parts(const Frac *f, Tight *t)
{
  Parts p = {.t = t, .entered = 1, .part = UINT32_MAX - 1};
  for (uint32_t v = 0; v < f->n; v++) t->v[v].mark = 0;
  for (uint32_t v = 0; v < f->n; v++) {
    if (t->v[v].mark) continue;
    for (enter(&p, v); p.visit.len;) advance(&p);
  }
  vec_free(&p.visit);
  vec_free(&p.stack);
  return p.part + 1;
}

// By symmetry the mates of a part are a part. Where the two are the same, there are odd cycles, and each
// pair is a region.
uint32_t tight__regions(const Frac *f, Tight *t)
{
  uint32_t least = strong_parts(f, t), nregion = 0, nparts = UINT32_MAX - least;
  uint32_t *side = mem_alloc(((size_t)nparts + 1) * sizeof *side);
  for (uint32_t i = 0; i < nparts; i++) side[i] = NONE;
  for (uint32_t v = 0; v < f->n; v++) {
    TightVertex *x = &t->v[v];
    uint32_t p = x->mark - least, q = x->mate == NONE ? NONE : t->v[x->mate].mark - least;
    if (q == NONE) x->side = 2 * nregion++;
    else if (p == q) x->side = x->mate < v ? t->v[x->mate].side + 1 : 2 * nregion++;
    else {
      if (side[p] == NONE) {
        side[p] = 2 * nregion++;
        side[q] = side[p] + 1;
      }
      x->side = side[p];
    }
  }
  free(side);
  return nregion;
}
