// tri_bulk.h - the engine of tri_build: points in Hilbert order to triangles, by parts
// SPDX-License-Identifier: MIT
#ifndef TRI_TRI_BULK_H
#define TRI_TRI_BULK_H

#include "base/base.h"

#include "tri/tri.h"

#define NOINLINE __attribute__((noinline))

// What one worker needs; several work on the same arrays at different vertices.
typedef struct {
  const double *xy;      // of the vertices in order along the Hilbert curve, all different
  const uint32_t *key;   // their cells on the curve, ascending
  uint32_t *vert, *twin; // room for 2n - 2 triangles
  uint32_t leaf;         // parts up to so many vertices are built by insertion
  PredCount count;
  uint64_t walks, steps, cavity;
  struct BulkScratch *scratch;
} Bulk;
void bulk_begin(Bulk *m); // makes the scratch memory
void bulk_end(Bulk *m);

// The vertices [lo, hi) of one cell of the curve's quadtree. Bits of the key above `bit` agree.
typedef struct {
  VertId lo, hi;
  int8_t bit;      // the next bit of the key to split by, from 31 down
  uint8_t u, c, x; // state of the curve, and the first bit of a quadrant that has been halved
} BulkCell;

// The hull edges (of ghosts, the outside on their left) that leave the leftmost, rightmost, lowest and highest vertex; of
// equally far ones the lowest and, for the last two, the rightmost, so that it is a corner. All NONE for one vertex.
typedef struct {
  EdgeId e[4];
} BulkHull;

// The Delaunay triangulation of a cell, in the slots [2 lo, 2 hi - 2).
BulkHull bulk_build(Bulk *m, const BulkCell *cell);
void bulk_split(const Bulk *m, const BulkCell *cell, BulkCell half[2]);
// Join the two halves of a cell, neither empty.
BulkHull bulk_merge(Bulk *m, const BulkCell *cell, const BulkCell half[2], const BulkHull *p, const BulkHull *q);

#endif
