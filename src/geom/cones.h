// cones.h - the largest function of limited slope below given values at given places
// SPDX-License-Identifier: MIT
#ifndef GEOM_CONES_H
#define GEOM_CONES_H

#include "base/base.h"
#include "geom/vec.h"

// f(x) = min over i of h[i] + slope |x - p[i]|: what limiting the growth of sizes known at places makes of the space between.
typedef struct Cones Cones;

// The arrays are copied; n may be 0 (then f is infinite). O(n).
Cones *cones_new(const Vec3 *p, const double *h, size_t n, double slope);
void cones_free(Cones *c); // NULL is fine
// f at p if it is below `limit`, else `limit`. Expected O(log n): a tree of boxes with their least values, best first by bounds.
double cones_at(const Cones *c, Vec3 p, double limit);

#endif
