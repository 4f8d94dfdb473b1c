// nearest.h - the nearest of many pieces of curves (points, segments, bent pieces) to a place, exactly
// SPDX-License-Identifier: MIT
#ifndef GEOM_NEAREST_H
#define GEOM_NEAREST_H

#include "base/base.h"
#include "geom/vec.h"

// Pieces are added, then the tree is built, then any number of threads may ask. A bent piece is given by its chord, a bound on how
// far it leaves the chord, and its curve and parameters, with which the owner's function finds the nearest point on it.
typedef struct Nearest Nearest;

// Distance squared from p to the piece of `curve` between parameters u0 and u1; its nearest parameter to *u.
typedef double (*NearestOnPiece)(void *ctx, uint32_t curve, double u0, double u1, Vec3 p, double *u);

Nearest *nearest_new(NearestOnPiece on_piece, void *ctx); // NULL, NULL if there are no bent pieces
void nearest_free(Nearest *n);                            // NULL is fine
void nearest_add(Nearest *n, Vec3 a, Vec3 b, double bulge, uint32_t curve, double u0, double u1); // bulge 0: straight
size_t nearest_count(const Nearest *n);                   // pieces added
// Order the pieces along a Hilbert curve, make capsules over them and a grid of starts for searches. O(n log n).
void nearest_build(Nearest *n);

typedef struct {
  double distance;
  uint32_t curve;  // of the nearest piece, NONE if there is none within the limit
  double u;        // its parameter there
  uint32_t leaf;   // hint for a place nearby
} NearestHit;

// The nearest piece to p not farther than `limit` (INFINITY: any); hit.distance is `limit` if there is none. `leaf` is that of a
// hit nearby, or NONE; it changes the time, and which of equally near pieces is found. O(log n) for scattered pieces; among 10^5 a
// third of a microsecond along a path, about one at places all over.
NearestHit nearest_query(const Nearest *n, Vec3 p, double limit, uint32_t leaf);

// Where a ray from p in the unit direction `dir` first meets a piece in the plane of dir and `side` (unit, perpendicular): distance and
// curve, taking chords for pieces and leaving out hits nearer than `from`; `limit` and NONE if nothing is met before.
NearestHit nearest_ray(const Nearest *n, Vec3 p, Vec3 dir, Vec3 side, double from, double limit);

#endif
