// quality_quad.h - shape measures of quadrilaterals
// SPDX-License-Identifier: MIT
#ifndef GEOM_QUALITY_QUAD_H
#define GEOM_QUALITY_QUAD_H

#include "base/base.h"
#include "geom/vec.h"

// eta = 1 - 2/pi max |pi/2 - angle| [book eq. 5.5] without its lower bound of 0: 1 for a rectangle, 0 or less where an angle
// is 0 or >= pi, at least -2.
double quad_eta_signed(Vec2 a, Vec2 b, Vec2 c, Vec2 d);
// [book eq. 5.5]: in [0, 1].
static inline double quad_eta(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
  double eta = quad_eta_signed(a, b, c, d);
  return eta > 0 ? eta : 0;
}

// Smallest over the corners of the cross product of the two edge directions there: 1 for a rectangle, <= 0 if the quad is not
// strictly convex. -1 where corners coincide.
double quad_scaled_jacobian(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

#endif
