// intersect.h - all pairs of segments of the plane that meet where they should not
// SPDX-License-Identifier: MIT
#ifndef GEOM_INTERSECT_H
#define GEOM_INTERSECT_H

#include "base/base.h"
#include "base/mem.h"
#include "geom/predicates.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  uint32_t a, b;  // segments, a < b
  SegMeet how;    // SEG_CROSS, SEG_TOUCH or SEG_OVERLAP
} SegPair;
typedef Vec(SegPair) SegPairVec;

// Append to out, ordered by (a, b), the pairs among n segments that have a common point other than a common end. Segment i joins
// the vertices end[2i] and end[2i+1] of xy. Exact for all finite doubles. Segments whose ends coincide are left out. At most `most`
// pairs are looked for; false if there may be more. A hierarchy of octagons over the segments in Hilbert order is matched
// against itself; where that takes more than some hundred steps a segment (long segments side by side) a tree of slabs is searched
// instead. O((n log n + k) log n).
bool segments_intersect(const double *xy, const uint32_t *end, size_t n, size_t most, SegPairVec *out);

#ifdef __cplusplus
}
#endif

#endif
