// hilbert.h - order points along a Hilbert curve
// SPDX-License-Identifier: MIT
#ifndef GEOM_HILBERT_H
#define GEOM_HILBERT_H

#include "base/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// Position along the Hilbert curve of the cell (x, y) of a 2^32 x 2^32 grid [book §3.3.4].
uint64_t hilbert_key(uint32_t x, uint32_t y);

// Fill order[0..n) with the indices of the points xy[2n] along the curve over their bounding square; points in one cell
// by x, then y, then index. So equal points are neighbours, and the sequence of coordinates does not depend on the order
// of the input. Coordinates must be finite. O(n).
void hilbert_order(const double *xy, size_t n, uint32_t *order);

#ifdef __cplusplus
}
#endif

#endif
