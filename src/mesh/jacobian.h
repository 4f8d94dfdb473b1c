// jacobian.h - certified bounds of the Jacobian of curved elements
// SPDX-License-Identifier: MIT
#ifndef MESH_JACOBIAN_H
#define MESH_JACOBIAN_H

#include "base/base.h"
#include "mesh/element.h"
#include "mesh/mesh.h"

// What turns the nodes of a complete element type (order 1 to 4) into Bezier control points.
typedef struct {
  ElemType type;
  int corners, order, n;
  uint8_t ij[ELEM_MAX_NODES][2];
  double to_bezier[ELEM_MAX_NODES][ELEM_MAX_NODES]; // control point a = sum over nodes b of to_bezier[a][b] * node b
} BezierBasis;
void bezier_basis_init(BezierBasis *b, ElemType complete);

// Bounds of the Jacobian determinant (of the map from the reference element, seen along `normal`) over the whole element,
// relative to that of the straight element with the same corners on average: lo <= min <= hi <= 1 or so; 1 everywhere for
// an affine triangle. The determinant is a polynomial, and lies within its Bezier coefficients; the element is halved until the
// bounds differ by at most `gap` or 0 is on neither side of doubt (lo > 0 or hi <= 0) [Johnen13]. O(p^4).
void jacobian_bounds(const BezierBasis *b, const Vec3 *node, Vec3 normal, double gap, double *lo, double *hi);
// lo > 0, found with the least work.
bool jacobian_positive(const BezierBasis *b, const Vec3 *node, Vec3 normal);

// Twice the vector area of an element's straight polygon of 3 or 4 corners.
Vec3 corners_normal(const Vec3 *corner, int corners);

#endif
