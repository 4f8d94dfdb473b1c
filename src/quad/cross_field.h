// cross_field.h - a smooth field of crosses on a plane mesh of triangles, aligned with its boundary
// SPDX-License-Identifier: MIT
#ifndef QUAD_CROSS_FIELD_H
#define QUAD_CROSS_FIELD_H

#include "base/base.h"
#include "geom/vec.h"

// A cross is four directions at right angles, known by the angle of one of them; (cos 4a, sin 4a) is the same for all four. The
// field is this vector at each vertex, linear in between, and as smooth as it can be of length one: the quads of a good mesh
// follow it, and its singularities are where their vertices cannot all have four edges [book §5.1.2].
typedef struct CrossField CrossField;

typedef struct {
  Vec2 p;     // middle of the triangle it is in
  int index4; // four times its index: 1 where three edges meet, -1 where five do
} CrossSingularity;

// What the field is made for. xy[2*nv] are points, tri[3*ntri] triangles, counterclockwise. Boundary edges, those of one triangle,
// and the edges aligned[2*naligned] are sides of the crosses; where the sides at a vertex do not agree, the cross there is their mean.
typedef struct {
  const double *xy;
  size_t nv;
  const uint32_t *tri;
  size_t ntri;
  const uint32_t *aligned;
  size_t naligned;
  // Edge lengths wanted at each vertex; NULL: the same everywhere. A conformal map with derivative h exp(i a) has quads with right
  // angles and sides h; so the crosses turn as its a does, by -d(log h)/dn to the length, as far as singularities let them.
  const double *size;
} CrossInput;

// The field; nothing of the input is kept. O(n^1.5) with a small constant: a dozen solutions of a sparse system by conjugate
// gradients, each starting from the last [Viertel19].
CrossField *cross_field_new(const CrossInput *in);
void cross_field_free(CrossField *f); // NULL is fine

// A triangle at vertex v, or NONE.
uint32_t cross_field_at_vertex(const CrossField *f, uint32_t v);
// Angle of a cross at p, in radians within [-pi/4, pi/4]. The search starts at triangle *near and leaves there the one it ended
// in: that of p, or where the boundary stood in the way. Any number of threads may ask. O(triangles on the way).
double cross_field_angle(const CrossField *f, Vec2 p, uint32_t *near);

// The singularities in order of triangles; they belong to the field. Returns how many.
size_t cross_field_singularities(const CrossField *f, const CrossSingularity **s);
// Four times the index of the boundary: the right angles by which it turns at its vertices, each rounded. With four times the
// indices of the singularities it adds up to four times the Euler characteristic [book §5.1.4] wherever no vertex turns by an odd
// multiple of 45 degrees, and no aligned edge is inside.
long cross_field_boundary_index4(const CrossField *f);
long cross_field_euler(const CrossField *f); // vertices in use - edges + triangles

#endif
