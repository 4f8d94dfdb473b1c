// tri_metric.h - every length, circle and ideal point that refinement measures, in one place
// SPDX-License-Identifier: MIT
//
// Refinement asks this header how long an edge is, how large a circle, and where an ideal point lies, and decides by nothing else.
// Here the metric is isotropic, I / h^2 with h a scalar at each vertex.
#ifndef TRI_TRI_METRIC_H
#define TRI_TRI_METRIC_H

#include "base/base.h"

#include <math.h>

// Edges between these adimensional lengths satisfy the size field [book §4.2].
#define METRIC_SHORT (2. / 3)
#define METRIC_LONG (4. / 3)
#define METRIC_SQRT3 1.7320508075688772

static inline double metric_distance2(const double *a, const double *b)
{
  double x = b[0] - a[0], y = b[1] - a[1];
  return x * x + y * y;
}

// Adimensional length of ab from the sizes at its ends [book eq. 4.15], by the trapezoidal rule on 1/h.
static inline double metric_length(const double *a, const double *b, double ha, double hb)
{
  return sqrt(metric_distance2(a, b)) * (ha + hb) / (2 * ha * hb);
}

// Mean of 1/h along an edge over which h is linear, ln(hb / ha) / (hb - ha), by Simpson's rule: within 0.2 % where the sizes differ by
// a factor of two, 3 % at four; the trapezoidal rule is 8 and 35 % above. Small faces grade that much from edge to edge, and a mesh
// polished by too long lengths has its edges too short.
static inline double metric_density(double ha, double hb)
{
  double s = ha + hb, p = ha * hb;
  return (s * s + 8 * p) / (6 * p * s);
}

// The length of ab with it.
static inline double metric_length_graded(const double *a, const double *b, double ha, double hb)
{
  return sqrt(metric_distance2(a, b)) * metric_density(ha, hb);
}

// Squared circumradius of abc; huge for flat triangles. *area2 is twice the signed area.
static inline double metric_radius2(const double *a, const double *b, const double *c, double *area2)
{
  double x = b[0] - a[0], y = b[1] - a[1], u = c[0] - a[0], v = c[1] - a[1], w = c[0] - b[0], z = c[1] - b[1];
  double d = x * v - y * u;
  *area2 = d;
  double s = (x * x + y * y) * (u * u + v * v) * (w * w + z * z);
  return s / (4 * d * d + 1e-300);
}

// Circumcentre of abc. Not finite for flat triangles.
static inline void metric_centre(const double *a, const double *b, const double *c, double *p)
{
  double x = b[0] - a[0], y = b[1] - a[1], u = c[0] - a[0], v = c[1] - a[1];
  double l = x * x + y * y, k = u * u + v * v, d = 0.5 / (x * v - y * u);
  p[0] = a[0] + (v * l - y * k) * d;
  p[1] = a[1] + (x * k - u * l) * d;
}

// Distance from the middle of ab to the ideal point before it, when edges of length h are wanted and the circumcentre of the
// triangle on ab lies at distance q > 0: a point of the Voronoi edge of ab, so that a and b are its nearest vertices [Rebay93].
// The height does not depend on the length of ab: Rebay's choice, which makes the two new sides h long, lowers the point where ab
// is long, and so amplifies a ripple of the front by up to sqrt(3) at each layer, until rounding errors have become disorder.
static inline double metric_height(double q, double h)
{
  double d = 0.5 * METRIC_SQRT3 * h;
  return d < 1.25 * q ? d : q;
}

// kappa_4 of the triangle [book eq. 4.13] squared, with the sign of the area: smooth but for the sign, and no square root but
// those of the three lengths.
static inline double metric_quality(const double *a, const double *b, const double *c)
{
  double x = b[0] - a[0], y = b[1] - a[1], u = c[0] - a[0], v = c[1] - a[1], w = c[0] - b[0], z = c[1] - b[1];
  double d = x * v - y * u, l = sqrt(x * x + y * y), m = sqrt(u * u + v * v), n = sqrt(w * w + z * z);
  double s = l * m * n * (l + m + n);
  return s > 0 ? 4 * d * fabs(d) / s : 0;
}

// Is that at least `least` beyond doubt? No square root and no division: with s the sum of the squared lengths, l m n (l + m + n) is
// at most s^2 / 3, with equality for equilateral triangles.
static inline bool metric_is_surely(const double *a, const double *b, const double *c, double least)
{
  double x = b[0] - a[0], y = b[1] - a[1], u = c[0] - a[0], v = c[1] - a[1], w = c[0] - b[0], z = c[1] - b[1];
  double d = x * v - y * u, s = (x * x + y * y) + (u * u + v * v) + (w * w + z * z);
  return d > 0 && 12 * (1 - 1e-9) * (d * d) > least * (s * s);
}

#endif
