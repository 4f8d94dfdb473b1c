// blossom_tight.h - a small copy of the tight edges, and what is done on it while duals stay
// SPDX-License-Identifier: MIT
#ifndef QUAD_BLOSSOM_TIGHT_H
#define QUAD_BLOSSOM_TIGHT_H

#include "quad/blossom_frac.h"

// What a search over tight edges needs of a vertex.
typedef struct {
  uint32_t mate; // NONE: free, or on an odd cycle
  uint32_t mark; // of the search; ON_CYCLE outside of searches for regions: on an odd cycle
  uint32_t side; // 2 * region + 0 or 1; NONE: there are no regions yet
} TightVertex;

#define ON_CYCLE UINT32_MAX

// A region is a set of matched pairs, one of each on side 0 and its mate on side 1, such that every vertex
// of a side can be reached from every other one by moving over a tight edge to the other side and back over
// a matched edge. So a tree that takes in one of its pairs takes in all of them, at once and with the same
// signs. What is free or on an odd cycle is a region by itself.
typedef struct {
  TightVertex *v;  // n
  uint32_t *start; // n + 1: tight edges of v lead to head[start[v]] .. head[start[v + 1] - 1]
  uint32_t *head;
} Tight;

// Room for the vertices and arcs of f, without regions; what is in it comes with tight__read.
void tight__init(const Frac *f, Tight *t);
void tight__release(Tight *t);
// Take mates and tight edges from f; marks are 0.
void tight__read(const Frac *f, Tight *t);
// Give mates to f. Cycles are in f already.
void tight__write(const Frac *f, const Tight *t);
uint32_t tight__count_free(const Frac *f, const Tight *t);
// Set all marks to 0, but those on odd cycles.
void tight__clear_marks(const Frac *f, const Tight *t);
// v is on an odd cycle from now on, before `next`.
void tight__close(const Frac *f, const Tight *t, uint32_t v, uint32_t next);
// Match the vertices of the odd cycle through w, but w.
void tight__open_cycle(const Frac *f, const Tight *t, uint32_t w);

// The tight arc from x to y, or NONE.
static inline uint32_t tight__arc(const Frac *f, uint32_t x, uint32_t y)
{
  for (uint32_t a = f->v[x].start; a < f->v[x + 1].start; a++)
    if (f->arc[a].head == y && frac__slack(f, a) == 0) return a;
  return NONE;
}

// What a search will come to soon, on its way from list[k] to its tight edges and their heads.
static inline void tight__prefetch(const Tight *t, const U32Vec *list, size_t k)
{
  const uint32_t *x = list->data + k;
  if (k + 24 >= list->len) return;
  __builtin_prefetch(&t->start[x[24]]);
  __builtin_prefetch(&t->head[t->start[x[16]]]);
  for (uint32_t i = t->start[x[8]]; i < t->start[x[8] + 1]; i++) __builtin_prefetch(&t->v[t->head[i]]);
}

// Find the regions; they are numbered from 0. Returns how many there are. O(n), nearly.
uint32_t tight__regions(const Frac *f, Tight *t);

// Match free vertices as far as tight edges allow; nearly maximal: a free vertex may be left that
// could have been matched. If `within`, only over edges between the two sides of a region.
void tight__settle(Frac *f, Tight *t, bool within);

// What tight__settle leaves: free vertices that see an odd cycle of tight edges are put on it, and some that
// see each other are matched.
void tight__forest(Frac *f, Tight *t);

// All trees at once, on the graph of regions: from free vertices, until each has met something. Paths are
// matched only between regions; inside of them they leave pairs of free vertices, for which there are tight
// ways across the region. All vertices are idle before and after, and sides of t are kept up.
void frac__grow_regions(Frac *f, Tight *t, uint32_t nregion);

#endif
