// intersect_int.h - what both ways to find meeting segments share
// SPDX-License-Identifier: MIT
#ifndef GEOM_INTERSECT_INT_H
#define GEOM_INTERSECT_INT_H

#include "geom/intersect.h"

typedef struct {
  double p[4];       // ax ay bx by, a before b by lex_compare
  uint32_t v[2], id; // ends, index in the caller's order
} Seg;

// Whether two segments have a common point that is not just a common end; its kind in *how. By the exact predicates.
bool intersect__meet(const Seg *s, const Seg *t, SegMeet *how);
// Order the pairs from `from` on by (a, b) and leave each out but once.
void intersect__order(SegPairVec *out, size_t from);

// segments_intersect by slabs (intersect_slabs.c), for n segments of positive length: O((n log n + k) log n) whatever they are.
bool intersect__by_slabs(const Seg *seg, size_t n, size_t most, SegPairVec *out);

#endif
