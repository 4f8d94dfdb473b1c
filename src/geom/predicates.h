// predicates.h - exact signs: orientation, incircle, and their relatives, for every finite double
// SPDX-License-Identifier: MIT
#ifndef GEOM_PREDICATES_H
#define GEOM_PREDICATES_H

#include "base/base.h"

#include <math.h>

// Every predicate returns the exact sign (-1, 0, +1) of a polynomial of its coordinates, whatever finite doubles they
// are. A floating-point filter with a proven error bound settles nearly all calls in a few nanoseconds; then exact
// integer or expansion arithmetic; then, for coordinates whose exponents are too far apart for those, MPFR at a
// precision computed from the exponents. docs/internals/delaunay.md derives the bounds.

// How often the filter was not enough. Pass NULL where it does not matter.
typedef struct {
  uint64_t orient_slow;   // orient2d calls that left the filter
  uint64_t incircle_slow; // incircle calls that left the filter
  uint64_t expansion;     // slow calls that needed more than fixed-width integers
  uint64_t multiprecision;// slow calls that needed MPFR
  uint64_t ties;          // incircle calls whose exact value was 0, settled by the perturbation
} PredCount;

#ifdef __cplusplus
extern "C" {
#endif

// The exact signs without a filter; the inline functions below call them when the filter cannot tell.
int orient2d_slow(const double *a, const double *b, const double *c, PredCount *count);
int incircle_slow(const double *a, const double *b, const double *c, const double *d, PredCount *count);
// The tie-break of incircle_perturbed for four cocircular points, a b c counterclockwise: +1 or -1.
int incircle_tie(const double *a, const double *b, const double *c, const double *d, PredCount *count);

// MPFR alone: no filter, no expansions. The oracle of the tests, and the last stage of the functions above.
int orient2d_mp(const double *a, const double *b, const double *c);
int incircle_mp(const double *a, const double *b, const double *c, const double *d);
// As incircle_mp at a fixed precision (bits) that need not suffice: the book's 200 bits, to show where they fail.
int incircle_fixed(const double *a, const double *b, const double *c, const double *d, int bits);
int cross_mp(const double *a, const double *b, const double *c, const double *d);
int dot_mp(const double *a, const double *b, const double *p);

// Sign of (b - a) x (d - c): +1 if direction cd is counterclockwise of direction ab.
int cross_sign(const double *a, const double *b, const double *c, const double *d);
// +1 if p is strictly inside the circle with diameter ab, 0 on it, -1 outside: the sign of -(a - p).(b - p).
int in_diametral_circle(const double *a, const double *b, const double *p);

// As segments_order_at, which tries a filter first.
int segments_order_at_mp(const double *a, const double *b, const double *c, const double *d, double u, double v);

// How the closed segments ab and cd meet.
typedef enum {
  SEG_DISJOINT, // no common point
  SEG_CROSS,    // one point, interior to both
  SEG_TOUCH,    // one point, an end of one and interior to the other
  SEG_SHARE,    // one point, an end of both
  SEG_OVERLAP,  // collinear with more than one common point
} SegMeet;
SegMeet segments_meet(const double *a, const double *b, const double *c, const double *d);
// The point where the lines ab and cd cross, rounded (relative error of a few ulps of the segment lengths when they
// cross properly). Requires: not parallel.
void segments_point(const double *a, const double *b, const double *c, const double *d, double *p);

#ifdef __cplusplus
}
#endif

// Order by x, then y. -0 equals 0.
static inline int lex_compare(const double *a, const double *b)
{
  if (a[0] != b[0]) return a[0] < b[0] ? -1 : 1;
  return a[1] < b[1] ? -1 : a[1] > b[1];
}

// Bounds of the filters (derived in docs/internals/delaunay.md, after [Shewchuk97]); eps = 2^-53.
#define ORIENT_BOUND 3.3306690738754716e-16   // (3 + 16 eps) eps
#define ORIENT_TINY 0x1p-900                  // more than underflow can add; larger, as subnormal numbers are slow
#define INCIRCLE_BOUND 3.8e-16                // (10 + 96 eps) eps / 3, rounded up
#define INCIRCLE_TINY 0x1p-900                // times 1 + |lift|

// +1 if a, b, c make a left turn (counterclockwise), 0 if collinear, -1 for a right turn [book eq. 3.2].
static inline int orient2d_count(const double *a, const double *b, const double *c, PredCount *count)
{
  double l = (a[0] - c[0]) * (b[1] - c[1]), r = (a[1] - c[1]) * (b[0] - c[0]);
  double det = l - r, bound = ORIENT_BOUND * (fabs(l) + fabs(r)) + ORIENT_TINY;
  if (LIKELY(det > bound)) return 1;
  if (LIKELY(-det > bound)) return -1;
  return orient2d_slow(a, b, c, count);
}
static inline int orient2d(const double *a, const double *b, const double *c)
{
  return orient2d_count(a, b, c, NULL);
}

// a, b, c counterclockwise: +1 if d is inside their circle, 0 on it, -1 outside [book eq. 3.3]. Clockwise: negated.
static inline int incircle_count(const double *a, const double *b, const double *c, const double *d, PredCount *count)
{
  double ax = a[0] - d[0], ay = a[1] - d[1], bx = b[0] - d[0], by = b[1] - d[1], cx = c[0] - d[0], cy = c[1] - d[1];
  double al = ax * ax + ay * ay, bl = bx * bx + by * by, cl = cx * cx + cy * cy, s = al + bl + cl;
  double det = al * (bx * cy - cx * by) + bl * (cx * ay - ax * cy) + cl * (ax * by - bx * ay);
  double bound = INCIRCLE_BOUND * (s * s) + (INCIRCLE_TINY * s + INCIRCLE_TINY); // infinite before det can be
  if (LIKELY(det > bound)) return 1;
  if (LIKELY(-det > bound)) return -1;
  return incircle_slow(a, b, c, d, count);
}
static inline int incircle(const double *a, const double *b, const double *c, const double *d)
{
  return incircle_count(a, b, c, d, NULL);
}

// Which of the segments ab and cd is higher where x = (u + v) / 2: +1 if ab, 0 if they meet there. Requires a[0] < b[0], c[0] < d[0], and
// x within both. The filter: a height y = ay + (by - ay) (x - ax) / (bx - ax) is computed within 8 eps times (|ay| + |by|) times
// 1 + (|x| + |ax|) / (bx - ax), as each of its 6 operations loses eps of that at most.
static inline int segments_order_at(const double *a, const double *b, const double *c, const double *d, double u, double v)
{
  double x = u / 2 + v / 2, w0 = b[0] - a[0], w1 = d[0] - c[0];
  double y0 = a[1] + (b[1] - a[1]) * ((x - a[0]) / w0), y1 = c[1] + (d[1] - c[1]) * ((x - c[0]) / w1);
  double bound = 0x1p-49 * ((fabs(a[1]) + fabs(b[1])) * (1 + (fabs(x) + fabs(a[0])) / w0) +
                            (fabs(c[1]) + fabs(d[1])) * (1 + (fabs(x) + fabs(c[0])) / w1)) + 0x1p-1000;
  double gap = y0 - y1;
  if (LIKELY(gap > bound)) return 1;
  if (LIKELY(-gap > bound)) return -1;
  return segments_order_at_mp(a, b, c, d, u, v);
}

// incircle with ties broken by lifting every point by an infinitesimal of its own, the lexicographically larger point
// by the infinitely larger amount [book eq. 3.4-3.5]. Never 0. Requires a, b, c counterclockwise and d none of them.
static inline int incircle_perturbed(const double *a, const double *b, const double *c, const double *d,
                                     PredCount *count)
{
  int s = incircle_count(a, b, c, d, count);
  return LIKELY(s) ? s : incircle_tie(a, b, c, d, count);
}

#endif
