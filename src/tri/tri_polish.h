// tri_polish.h - polishing small faces: all edges by trial (tri_polish.c), the smallest angle (tri_sharpen.c), figures
// SPDX-License-Identifier: MIT
#ifndef TRI_TRI_POLISH_H
#define TRI_TRI_POLISH_H

#include "base/base.h"
#include "tri/tri_star.h"
#include "tri/tri_trial.h"

// How much lengths, and the sine of the smallest angle, count against shapes; all three are means over the mesh.
#define POLISH_LENGTHS 3.0
#define POLISH_ANGLE 0.2
// How much the square of 1/gamma - 1 counts against 1 - gamma: bad triangles.
#define POLISH_TAIL 15.0
// Squared sine of 45.5 degrees: a smallest angle beyond that is worth nothing more.
#define POLISH_SINE2 0.5087
// 1/kappa_4^2 that any triangle may have, if the mesh had one as bad.
#define POLISH_TOLERATED (1 / 0.7)
// A mean that falls short of the reference by less than this is as good.
#define POLISH_SLACK 5e-4

// The mesh of a face in the figures that a report prints, its sizes those of the field. gamma is kappa_4^2.
typedef struct {
  double gamma, fifth; // mean and 5th percentile over the triangles
  double sine2;        // squared sine of the smallest angle, of the triangles with a vertex that is free to move; 1 without any
  double length;       // mean of polish__length over the edges: minus the logarithm of the efficiency index
  double shape;        // mean over the triangles of what their shape costs
  double worst;        // largest 1/gamma
} PolishFigures;

// What polishing is for.
typedef struct {
  PolishFigures reference;        // of a mesh that is there already: no figure is to be worse
  double bound;                   // 1/gamma that no triangle is to exceed
  double more_gamma, more_length; // factors by which the two means count more than usual
} PolishGoal;

typedef struct {
  PolishFigures figures;
  double cost; // for choosing among several meshes of a face
} PolishedMesh;

typedef struct {
  Refiner *r;
  Trial trial;
  RefineField *field;
  const PolishGoal *goal;
  double shape, length, loss; // means over the mesh when it was last measured: costs of shapes and lengths, 1 - gamma
  double more_gamma, more_length; // the factors of the goal, and more while a mean falls short
  double weight;        // of a length against a shape in sums, so that they compare as the means do
  double tail;          // of the square of 1/gamma - 1 against 1 - gamma
  double lift;          // of the smallest sine in sums
  double floor;         // 1/kappa_4^2 that triangles may rise to
  uint64_t work, budget; // positions of a vertex measured, and at most
  U32Vec changed, tried; // by vertex and by half-edge: at which of the changes kept
  uint32_t now;
} Polish;

// ---- tri_polish.c
// For small faces: vertices moved, edges flipped, collapsed and split by trial for the mean shape, the efficiency index and the
// smallest angle of the whole, until nothing helps or `budget` positions of vertices have been measured (0.1 us each). Operations may
// make triangles as bad as gamma 0.7; strict: none worse than r->worst either. Collapses leave isolated vertices.
PolishedMesh refine__polish(Refiner *r, RefineField *field, const PolishGoal *goal, bool strict, uint64_t budget);
// The size wanted at p, where vertex v is to go.
double polish__size(Polish *q, VertId v, const double *p);

// ---- tri_sharpen.c
// Raise the smallest angle of the mesh while that is worth what it costs.
void polish__sharpen(Polish *q);
// Squared sine of the smallest angle of the triangles with a vertex that is free to move; 1 without any.
double polish__sine2(const Refiner *r);

// ---- tri_figures.c
// Of the mesh as it is. O(n log n).
PolishFigures polish__figures(const Refiner *r);
// What a mesh with these figures costs: means, the smallest angle, and far more where one is worse than the reference.
double polish__cost(const PolishFigures *f, const PolishFigures *reference);

// How far gamma = 1/f is from 1, `mean` times, and more the worse it is; below gamma 1/2 the second part levels off (at 4 times what it is
// there): slivers that the boundary leaves no way round would outweigh the rest of the mesh.
static inline double polish__badness(double f, double mean, double tail)
{
  return mean * (1 - 1 / f) + tail * (f < 2 ? (f - 1) * (f - 1) : 5 - 8 / f);
}

// What a triangle costs that has 1/kappa_4^2 = f; steeply more beyond the bound.
static inline double polish__shape(const Polish *q, double f)
{
  return polish__badness(f, q->more_gamma, q->tail) + 10 * (f > q->goal->bound ? f - q->goal->bound : 0);
}

// What an edge of that adimensional length costs: its part in the efficiency index [book eq. 4.16].
static inline double polish__length(double l)
{
  return l < 1 ? 1 - l : 1 - 1 / l;
}

#endif
