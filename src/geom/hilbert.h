// hilbert.h - order points along a Hilbert curve
// SPDX-License-Identifier: MIT
#ifndef GEOM_HILBERT_H
#define GEOM_HILBERT_H

#include "base/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// Fill order[0..n) with the indices of the points xy[2n] along the Hilbert curve [book §3.3.4] over their bounding square, and key[0..n)
// (may be NULL) with the cells in that order, ascending. Points in one cell follow a curve over their own square, and so on
// down; equal points are neighbours, by index. scratch: 2n words, or NULL. The sequence of coordinates does not depend on the order of the
// input, nor on threads (0: one per processor). Coordinates must be finite. O(n) but for absurd ranges of exponents.
void hilbert_sort(const double *xy, size_t n, uint32_t *order, uint32_t *key, uint64_t *scratch, int threads);

// The same with one thread and without the cells.
void hilbert_order(const double *xy, size_t n, uint32_t *order);

#ifdef __cplusplus
}
#endif

#endif
