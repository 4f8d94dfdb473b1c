// quad_star.h - the elements around one vertex, and what they are worth where it moves
// SPDX-License-Identifier: MIT
#ifndef QUAD_QUAD_STAR_H
#define QUAD_QUAD_STAR_H

#include "quad/lanes.h"
#include "quad/quad_int.h"

// An element about the vertex is a wing: it lies between the neighbours b (first, counterclockwise) and a, with the opposite corner c
// of a quad. Here are two of them.
typedef struct {
  Lanes bx, by, ax, ay;
  Lanes bcx, bcy, acx, acy; // from b and from a to c, or to each other in a triangle; of length 1
  Lanes opposite;           // skew of the corner c, which stays as it is
  Lanes h;                  // wanted size at b; 0: not known
  Lanes wanted;             // cosine of the corners: 0 in a quad, 1/2 in a triangle
  Lanes live;               // 1; 0 where there is no wing
} Wings;

enum { STAR_WINGS = 64 };

typedef struct {
  Wings wings[STAR_WINGS / 2];
  size_t n;               // wings
  uint64_t triangle;      // bit i: wing i is a triangle
  Vec2 at;                // where the vertex is
  const QuadSize *size;   // NULL: not known
  QuadScore best;
} Star;

// The star of v of the n elements corner[4n]; size (by vertex) may be NULL. False if there are too many, or none that holds v. `best`
// is set by the caller.
bool star_init(Star *s, const Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n);

// Score with the vertex at p; energy includes edges of the wrong length, each once for both elements at it.
QuadScore star_score(const Star *s, Vec2 p);
// Move the vertex to p if that is better: the worst improves, or stays (or remains below the floor) while the energy falls.
bool star_try(Star *s, Vec2 p, double floor);
// One step of Gauss and Newton for the cosines of all corners and the lengths of the edges at the vertex.
bool star_newton(const Star *s, Vec2 *step);
Vec2 star_mean(const Star *s);     // of the neighbours
double star_reach(const Star *s);  // distance of the farthest neighbour

#endif
