// blossom_frac.h - the fractional matching the solver starts from: structures shared by its files
// SPDX-License-Identifier: MIT
#ifndef QUAD_BLOSSOM_FRAC_H
#define QUAD_BLOSSOM_FRAC_H

#include "quad/blossom_int.h"

// A vertex is matched, free, or on an odd cycle whose edges are tight and count half. Its dual is pot + sign * now.
typedef struct {
  int64_t pot;
  uint32_t start; // first of its arcs
  uint32_t match; // matched arc, from the vertex; NONE if it is free or on an odd cycle
  uint32_t pred;  // inner: arc to the outer vertex above it; on an odd cycle: arc to the next vertex; free: NONE
  uint32_t tree;  // outer or inner: root of its tree
  uint32_t link;  // outer: next outer vertex of its tree
  int32_t sign;   // BlossomSign; mates are inner and outer, or both idle
} FracVertex;

typedef struct {
  const BlossomArc *arc;
  FracVertex *v;     // n + 1
  uint32_t n;
  int64_t scale;     // as of Blossom
  int64_t now;
  uint32_t ntree;    // trees alive
  U32Vec list;       // breadth-first order of a search; `read` of them are done
  size_t read;
  BlossomQueue *queue;
  BlossomStats *stats;
} Frac;

static inline int64_t frac__slack(const Frac *f, uint32_t a)
{
  const FracVertex *u = &f->v[f->arc[a].tail], *w = &f->v[f->arc[a].head];
  return f->scale * (int64_t)f->arc[a].cost - (u->pot + u->sign * f->now) - (w->pot + w->sign * f->now);
}
static inline bool frac__is_free(const FracVertex *v) { return v->match == NONE && v->pred == NONE; }
static inline bool frac__on_cycle(const FracVertex *v) { return v->match == NONE && v->pred != NONE; }
static inline uint32_t frac__mate(const Frac *f, uint32_t v) { return f->arc[f->v[v].match].head; }
static inline void frac__match(const Frac *f, uint32_t a)
{
  f->v[f->arc[a].tail].match = a;
  f->v[f->arc[a].head].match = f->arc[a].rev;
}

// Match the vertices of the odd cycle through w, but w.
void frac__open_cycle(const Frac *f, uint32_t w);

#endif
