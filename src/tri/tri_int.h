// tri_int.h - shared inside src/tri
// SPDX-License-Identifier: MIT
#ifndef TRI_TRI_INT_H
#define TRI_TRI_INT_H

#include "base/base.h"

#include "tri/tri.h"

static inline bool tri__ghost3(VertId a, VertId b, VertId c) { return (a | b | c) > TRI_MAX_VERTICES; }

static inline void tri__link(Tri *m, EdgeId e, EdgeId f)
{
  m->twin[e] = f;
  m->twin[f] = e;
}

// A triangle slot: from the free list, else new. flag 0, everything else undefined. May move the arrays.
TriId tri__new(Tri *m);
void tri__release(Tri *m, TriId t);
// A new vertex at p. May move the arrays.
VertId tri__new_vertex(Tri *m, const double p[2]);

// Is vertex d in conflict with the triangle (a, b, c), that is inside its (perturbed) circle? Any of the four may be
// TRI_INF; the circle of a ghost is the open half plane beyond its hull edge, and the edge's open interior.
bool tri__conflict(Tri *m, VertId a, VertId b, VertId c, VertId d);
// The same for triangle t and a point that need not be a vertex.
bool tri__conflict_point(Tri *m, TriId t, const double p[2]);

// What the new triangles in place of t[0..n) inherit: outside flags of finite triangles and ghosts, and the label.
typedef struct {
  uint8_t finite, ghost;
  uint32_t region;
} TriSide;
TriSide tri__side_of(const Tri *m, const uint32_t *t, size_t n);

static inline void tri__set_segment(Tri *m, EdgeId e, uint32_t id)
{
  m->flag[e / 3] |= (uint8_t)(TRI_SEG_0 << e % 3);
  m->seg[e] = id;
}
static inline void tri__clear_segment(Tri *m, EdgeId e) { m->flag[e / 3] &= (uint8_t) ~(TRI_SEG_0 << e % 3); }
// Copy the segment state of half-edge `from` to `to`.
static inline void tri__copy_segment(Tri *m, EdgeId to, EdgeId from)
{
  if (tri_is_segment(m, from)) tri__set_segment(m, to, m->seg[from]);
  else tri__clear_segment(m, to);
}
void tri__make_segments(Tri *m); // allocate m->seg
void tri__make_regions(Tri *m);  // allocate m->region, all 0

#endif
