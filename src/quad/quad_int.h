// quad_int.h - what the files of this folder share
// SPDX-License-Identifier: MIT
#ifndef QUAD_QUAD_INT_H
#define QUAD_QUAD_INT_H

#include "base/map.h"
#include "geom/quality_quad.h"
#include "quad/quad_mesh.h"

// 1 for each side that no merge may remove: boundary and locked edges. 4 entries an element; the caller frees it.
uint8_t *quad__locked_sides(const QuadMesh *m, const uint32_t *twin);

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

// Shape of any element on one scale: eta of a quad; of a triangle 1 - 3/pi max |pi/3 - angle|.
double quad__shape(const Vec2 *xy, const uint32_t *corner);

// Exact: every corner of the element turns left.
bool quad__convex(const Vec2 *xy, const uint32_t *corner);

// Elements around each vertex: at[start[v] .. start[v+1]). Free both.
typedef struct {
  uint32_t *start, *at;
} QuadStars;
QuadStars quad__stars(const QuadMesh *m);
void quad__stars_free(QuadStars *s);

// How good a set of elements is: first the worst, then the sum of squares of what is missing to 1.
typedef struct {
  double worst, energy;
} QuadScore;
// Of the elements corner[4n].
QuadScore quad__score(const Vec2 *xy, const uint32_t *corner, size_t n);
// Move v to a better place for the n elements corner[4n] around it, in `steps` steps of a pattern search that begins with the
// middle of its neighbours; the worst of them never gets worse than it was or than the floor. True if v moved.
bool quad__improve(Vec2 *xy, uint32_t v, const uint32_t *corner, size_t n, int steps, double floor);

// Elements above this may lose shape to the gain of others, but never beyond the worst of the whole mesh: that is the floor.
static const double QUAD_GOOD_SHAPE = 0.5;
double quad__floor(const QuadMesh *m);

#endif
