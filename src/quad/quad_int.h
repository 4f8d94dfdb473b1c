// quad_int.h - what the files of this folder share
// SPDX-License-Identifier: MIT
#ifndef QUAD_QUAD_INT_H
#define QUAD_QUAD_INT_H

#include "base/map.h"
#include "geom/quality_quad.h"
#include "quad/quad_mesh.h"

// 1 for each side that no merge may remove: boundary and locked edges. 4 entries an element; the caller frees it.
uint8_t *quad__locked_sides(const QuadMesh *m, const uint32_t *twin);

// A new vertex at p, free to move; what size is wanted there is the mean of what the n vertices around[] say.
uint32_t quad__add_vertex(QuadMesh *m, Vec2 p, const uint32_t *around, uint32_t n);

// The quad a, o', b, o of two triangles that share the edge of side s (a -> b, o opposite) and its twin t.
static inline void quad__merged(const QuadMesh *m, uint32_t s, uint32_t t, uint32_t q[4])
{
  const uint32_t *v = m->vertex.data;
  q[0] = v[s];
  q[1] = v[t / 4 * 4 + (t % 4 + 2) % 3];
  q[2] = v[s / 4 * 4 + (s % 4 + 1) % 3];
  q[3] = v[s / 4 * 4 + (s % 4 + 2) % 3];
}

static inline double quad__eta(const QuadMesh *m, const uint32_t q[4])
{
  const Vec2 *p = m->xy.data;
  return quad_eta_signed(p[q[0]], p[q[1]], p[q[2]], p[q[3]]);
}

// Skew of an element: sin^2 of how far its worst corner is from a right angle; of a triangle, of 3/2 times how far from 60 degrees, so
// that both are 0 at best and 1 where a corner is straight; up to 2 where it is reentrant, 3 where corners coincide. It takes neither
// roots nor arcs.
static inline double quad__corner_skew(Vec2 u, Vec2 w)
{
  double dot = vec2_dot(u, w), size = vec2_dot(u, u) * vec2_dot(w, w);
  if (size <= 0) return 3;
  double c2 = dot * dot / size;
  return vec2_cross(u, w) > 0 ? c2 : 2 - c2;
}
// What an edge of a wrong length costs beside an element of a wrong shape: more loses angles, less sizes.
static const double QUAD_LENGTH_WEIGHT = 0.2;
double quad__triangle_skew(Vec2 a, Vec2 b, Vec2 c);
double quad__skew(const Vec2 *xy, const uint32_t *corner);
// Shape of any element on one scale: eta of a quad; of a triangle 1 - 3/pi max |pi/3 - angle|. Skew and shape, each from the other.
double quad__shape(const Vec2 *xy, const uint32_t *corner);
double quad__skew_of_shape(double shape);
// (1 - shape)^2, by the first terms of the series of its arcsine squared: a convex function that grows with the skew.
static inline double quad__skew_energy(double s)
{
  return 4 / (3.14159265358979323846 * 3.14159265358979323846) * s * (1 + s * (1.0 / 3 + s * (8.0 / 45 + s * (4.0 / 35))));
}

// Every corner of the element turns left: of a triangle exactly, of a quadrangle by more than its coordinates are rounded.
bool quad__convex(const Vec2 *xy, const uint32_t *corner);

// The linear size, but never less than half or more than twice what it is at its vertex.
static inline double quad__size_at(const QuadSize *s, Vec2 p)
{
  double h = s->h + s->slope.x * (p.x - s->at.x) + s->slope.y * (p.y - s->at.y);
  return h < 0.5 * s->h ? 0.5 * s->h : h > 2 * s->h ? 2 * s->h : h;
}

// Elements around each vertex: at[start[v] .. start[v+1]). Free both.
typedef struct {
  uint32_t *start, *at;
} QuadStars;
QuadStars quad__stars(const QuadMesh *m);
void quad__stars_free(QuadStars *s);

// How good a set of elements is: first the worst skew, then the sum of squares of what is missing to 1.
typedef struct {
  double worst, energy;
} QuadScore;
// Of the elements corner[4n]; edges of wrong length count, too, half with each element, where size (by vertex) is not NULL.
QuadScore quad__score(const Vec2 *xy, const QuadSize *size, const uint32_t *corner, size_t n);
// Move v to a better place for the n elements corner[4n] around it, at most 64: better angles and, where size (by vertex) is not NULL,
// edges more as long as wanted, in up to `steps` steps. The worst skew of them never gets worse than it was or than the floor. More
// than two steps search longer. True if v moved.
bool quad__improve(Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n, int steps, double floor);

// The same in one long step towards right angles everywhere, not only in the worst corners, which is taken unless an element gets
// worse than the floor by it: many such passes bring a mesh into shape, quad__improve takes what is left. Short steps are left out.
bool quad__relax(Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n, double floor);

// The same for the worst element alone, at length, and although some may stay or become turned over.
bool quad__untangle(Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n);

// Elements of less skew than this may lose shape to the gain of others, but never beyond the worst of the whole mesh: that is the floor.
static const double QUAD_GOOD_SHAPE = 0.5;
double quad__floor(const QuadMesh *m);

#endif
