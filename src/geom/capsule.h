// capsule.h - balls, and the capsules around some of them that a tree of pieces of curves is made of
// SPDX-License-Identifier: MIT
#ifndef GEOM_CAPSULE_H
#define GEOM_CAPSULE_H

#include "base/base.h"

// A ball; for the ends of pieces and of capsules.
typedef struct {
  double c[3], r;
} Ball;

// All places within r of the segment from a to a + d: along a chain of pieces much tighter than a box.
typedef struct {
  double a[3], d[3], r;
} Capsule;

// A narrow capsule around n > 0 balls: its axis runs along their longest extent and through the middle of their width in the plane,
// and is as short as the width allows. O(n)
Capsule capsule_fit(const Ball *b, size_t n);

// The balls at both ends of a capsule to b[0], b[1]; how many: 0 if it is empty (r < 0), else 2.
size_t capsule_balls(const Capsule *c, Ball *b);

#endif
