// knots.h - which piece of a spline a parameter is on
// SPDX-License-Identifier: MIT
#ifndef GEOM_KNOTS_H
#define GEOM_KNOTS_H

// Of n pieces between the n + 1 increasing knots the last one that does not begin beyond u; the first if all do. O(log n)
static inline int knots_piece(const double *knot, int n, double u)
{
  int a = 0, b = n - 1;
  while (a < b) {
    int mid = (a + b + 1) / 2;
    if (knot[mid] <= u)
      a = mid;
    else
      b = mid - 1;
  }
  return a;
}

#endif
