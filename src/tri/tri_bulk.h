// tri_bulk.h - the engine of tri_build: points in Hilbert order to triangles, by parts
// SPDX-License-Identifier: MIT
#ifndef TRI_TRI_BULK_H
#define TRI_TRI_BULK_H

#include "base/base.h"

#include "tri/tri.h"

#define NOINLINE __attribute__((noinline))

enum { BULK_KEYS_BEYOND = 16 };

// What one worker needs; several work on the same arrays at different vertices. The part of the vertices [lo,
// hi) owns the triangle slots [2 lo, 2 hi - 2), just as many as it needs; merging two neighbouring parts uses
// the two slots between theirs. So nothing is allocated, the slots of a triangulation do not depend on
// threads, and there are no holes at the end. A ghost in a finished part has its hull edge first: half-edges
// 3t (a -> b), 3t + 1 (b -> inf), 3t + 2 (inf -> a).
typedef struct {
  const double *xy;      // of the vertices in order along the Hilbert curve, all different
  const uint32_t *key;   // their cells on the curve, ascending, and BULK_KEYS_BEYOND more that are not less than any
  uint32_t *vert, *twin; // room for 2n - 2 triangles
  bool incremental;      // all by insertion, in rounds of doubling size along the curve
  PredCount count;
  uint64_t walks, steps, cavity, merged, flipped;
  struct BulkScratch *scratch;
  struct BulkWork *work;
  bool waiting; // bulk_next may have a merge
  char apart[128]; // workers count in cache lines of their own
} Bulk;
void bulk_begin(Bulk *m); // makes the scratch memory
void bulk_end(Bulk *m);

// The outermost vertices of a part: leftmost, rightmost, lowest, highest, of equally far ones the lowest and,
// for the last two, the rightmost, so that they are corners; how far they are; and the hull edges (of ghosts,
// the outside on their left) that leave them, NONE for a single vertex.
typedef struct {
  double at[4];
  VertId v[4];
  EdgeId e[4];
} BulkHull;

// The Delaunay triangulation of the vertices [lo, hi), all those of one cell of the curve's quadtree (or of
// half a cell).
BulkHull bulk_build(Bulk *m, VertId lo, VertId hi);
// Where the halves of such a cell meet, strictly between lo and hi; hi if all vertices have the same key.
VertId bulk_split(const Bulk *m, VertId lo, VertId hi);
// Join the two halves of a cell, neither empty.
BulkHull bulk_merge(Bulk *m, VertId mid, const BulkHull *p, const BulkHull *q);

// A merge: the edge v[0] v[1] from which it rises, left and right; the next hull edges on both sides, h[0]
// into v[0] and h[1] out of v[1] (NONE: a single vertex); and the half-edge v[1] -> v[0] below.
typedef struct {
  VertId v[2];
  EdgeId h[2], base;
  uint32_t node; // of the tree of merges
} BulkRise;
// The next merge whose parts are done, at its lower common tangent; false: there is none at the moment.
bool bulk_next(Bulk *m, BulkRise *rise);
// It has come to its upper common tangent.
void bulk_done(Bulk *m, const BulkRise *rise);
// From the lower common tangents to the upper ones, until bulk_next has no more: peel off what is not
// Delaunay any more, and fill the gaps (tri_bulk_climb.c).
void bulk_climb(Bulk *m);

// The same by insertion, for any vertices, not only a cell's (tri_bulk_insert.c).
BulkHull bulk_insert(Bulk *m, VertId lo, VertId hi);
void bulk__begin_insert(Bulk *m); // its scratch memory, of bulk_begin and bulk_end
void bulk__end_insert(Bulk *m);

// Four vertices from lo on; false, and nothing is done: three are on one line. One to three vertices; any
// number on one line; and the extreme vertices, given a hull edge (tri_bulk_base.c).
bool bulk_four(Bulk *m, VertId lo, BulkHull *hull);
BulkHull bulk_base(Bulk *m, VertId lo, VertId hi);
BulkHull bulk_chain(Bulk *m, VertId lo, VertId hi);
BulkHull bulk_extremes(const Bulk *m, EdgeId h);
// A triangle of three vertices that are not on one line in slot t, ghosts in the three after it: their hull
// edges are b -> a, c -> b and a -> c if a, b, c is counterclockwise, else with a and b exchanged.
void bulk_triangle(Bulk *m, TriId t, VertId a, VertId b, VertId c);

static inline const double *bulk_at(const Bulk *m, VertId v) { return m->xy + 2 * (size_t)v; }

static inline void bulk_link(Bulk *m, EdgeId e, EdgeId f)
{
  m->twin[e] = f;
  m->twin[f] = e;
}

static inline void bulk_set(Bulk *m, TriId t, VertId a, VertId b, VertId c)
{
  uint32_t *v = m->vert + 3 * (size_t)t;
  v[0] = a;
  v[1] = b;
  v[2] = c;
}

// Neighbours of hull edge h, counterclockwise seen from outside: the one that leaves its end, and that
// reaches its origin.
static inline EdgeId bulk_hull_next(const Bulk *m, EdgeId h) { return m->twin[h + 1] - 2; }
static inline EdgeId bulk_hull_prev(const Bulk *m, EdgeId h) { return m->twin[h + 2] - 1; }

#endif
