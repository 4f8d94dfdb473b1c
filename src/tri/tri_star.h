// tri_star.h - the star of an interior vertex, laid out for trying positions of it
// SPDX-License-Identifier: MIT
#ifndef TRI_TRI_STAR_H
#define TRI_TRI_STAR_H

#include "base/base.h"
#include "tri/refine_int.h"

enum { STAR_RING = 32 }; // vertices with more neighbours stay where they are

// The neighbours counterclockwise, the first again at the end.
typedef struct {
  int n;
  VertId id[STAR_RING + 1];
  double x[STAR_RING + 1], y[STAR_RING + 1];
  double inv[STAR_RING + 1]; // half of 1/h there
  double base[STAR_RING];    // length of the side from neighbour j to j+1
  double h[STAR_RING + 1];   // sizes at neighbours
} Star;

// False if there are too many.
static inline bool star_gather(const Refiner *r, VertId v, Star *s)
{
  const Tri *m = r->m;
  EdgeId first = m->hint[v], e = first;
  int n = 0;
  do {
    if (n == STAR_RING) return false;
    VertId u = tri_dest(m, e);
    s->id[n] = u;
    s->x[n] = m->xy[2 * (size_t)u], s->y[n] = m->xy[2 * (size_t)u + 1];
    s->h[n] = r->size[u], s->inv[n] = 0.5 / r->size[u];
    n++;
    e = tri_ccw(m, e);
  } while (e != first);
  s->n = n;
  s->id[n] = s->id[0], s->x[n] = s->x[0], s->y[n] = s->y[0], s->h[n] = s->h[0], s->inv[n] = s->inv[0];
  for (int j = 0; j < n; j++) {
    double u = s->x[j + 1] - s->x[j], w = s->y[j + 1] - s->y[j];
    s->base[j] = sqrt(u * u + w * w);
  }
  return true;
}

#endif
