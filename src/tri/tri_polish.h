// tri_polish.h - the two halves of polishing: all edges by trial (tri_polish.c), the smallest angle (tri_sharpen.c)
// SPDX-License-Identifier: MIT
#ifndef TRI_TRI_POLISH_H
#define TRI_TRI_POLISH_H

#include "base/base.h"
#include "tri/tri_star.h"
#include "tri/tri_trial.h"

// How much lengths, and the sine of the smallest angle, count against shapes; all three are means over the mesh.
#define POLISH_LENGTHS 3.0
#define POLISH_ANGLE 0.2
// Squared sine of 45.5 degrees: a smallest angle beyond that is worth nothing more.
#define POLISH_SINE2 0.5087

typedef struct {
  Refiner *r;
  Trial trial;
  RefineField *field;
  double shape, length; // means over the mesh when it was last measured
  double weight;        // of a length against a shape in sums, so that they compare as the means do
  double lift;          // of the smallest sine in sums
  double floor;         // 1/kappa_4^2 that triangles may rise to
  uint64_t work, budget; // positions of a vertex measured, and at most
  U32Vec changed, tried; // by vertex and by half-edge: at which of the changes kept
  uint32_t now;
} Polish;

// What a triangle costs that has 1/kappa_4^2 = f: how far gamma is from 1, and more the worse it is.
static inline double polish__shape(double f)
{
  return 1 - 1 / f + 15 * (f - 1) * (f - 1);
}

// What an edge of that adimensional length costs: its part in the efficiency index [book eq. 4.16].
static inline double polish__length(double l)
{
  return l < 1 ? 1 - l : 1 - 1 / l;
}

// The size wanted at p, where vertex v is to go.
double polish__size(Polish *q, VertId v, const double *p);
// Raise the smallest angle of the mesh while that is worth what it costs. Returns its squared sine, of the triangles with a vertex
// that is free to move; 1 without any.
double polish__sharpen(Polish *q);

#endif
