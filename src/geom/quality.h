// quality.h - shape measures of triangles, adimensional lengths of edges, and their summary over a mesh
// SPDX-License-Identifier: MIT
#ifndef GEOM_QUALITY_H
#define GEOM_QUALITY_H

#include "base/base.h"
#include "geom/vec.h"

// What every shape measure needs of a triangle: its side lengths, and its area, negative when it is inverted.
typedef struct {
  double a, b, c; // lengths of the sides opposite to the first, second and third vertex
  double area;
} TriShape;

// In the plane.
TriShape shape_plane(Vec2 p, Vec2 q, Vec2 r);
// In space; the area has the sign of the triangle's normal against `normal`, or is positive if normal is (0,0,0).
TriShape shape_space(Vec3 p, Vec3 q, Vec3 r, Vec3 normal);

// The measures of [book §4.1.3]: 1 for the equilateral triangle, 0 for a flat one, negative for an inverted one (2 and 3
// take the sign of the area too). 0 if two vertices coincide.
double quality_kappa1(TriShape t); // 2/sqrt(3) times the sine of the smallest angle
double quality_kappa2(TriShape t); // sqrt(3) times inscribed diameter over longest side
double quality_kappa3(TriShape t); // twice inscribed over circumscribed diameter: gamma
double quality_kappa4(TriShape t); // square root of kappa3; smooth: what optimization maximizes [book eq. 4.13]
double quality_kappa5(TriShape t); // tells caps from needles [book eq. 4.14]

// gamma = 4 sin A sin B sin C / (sin A + sin B + sin C), which is twice inscribed over circumscribed radius, kappa3.
static inline double quality_gamma(TriShape t) { return quality_kappa3(t); }

// Interior angles in degrees at the first, second and third vertex.
void quality_angles(TriShape t, double angle[3]);

// True if the two angles that see the edge pq from r and from s (on either side) add up to more than 180 degrees, which costs
// linear elements the discrete maximum principle [book §4.1.2].
bool quality_breaks_maximum_principle(Vec2 p, Vec2 q, Vec2 r, Vec2 s);

// A size field: the wanted edge length at a point, positive.
typedef double (*SizeAt)(void *ctx, Vec2 p);

// Sizes multiplied by a factor: size_scaled as a SizeAt, with this as its ctx.
typedef struct {
  SizeAt size;
  void *ctx;
  double factor;
} ScaledSize;

static inline double size_scaled(void *ctx, Vec2 p)
{
  const ScaledSize *s = (const ScaledSize *)ctx;
  return s->factor * s->size(s->ctx, p);
}

// Adimensional length of the segment pq: the integral of dl/h [book eq. 4.15], by Gauss-Legendre of order 5 on panels halved until
// two levels agree to 1e-6 (at most 2^10 panels). About 9 evaluations of h for a smooth field.
double quality_edge_length(Vec2 p, Vec2 q, SizeAt h, void *ctx);
// tau_e of [book eq. 4.16] from an adimensional length: 0 at length 1, in (-1, 0] always.
static inline double quality_tau_term(double len) { return len < 1 ? len - 1 : 1 / len - 1; }

// What a report says of a plane mesh.
typedef struct {
  size_t ntri, nedge, nvert;
  double gamma_min, gamma_p5, gamma_mean; // p5: the value that 5 % of the triangles are below
  double angle_min, angle_max;            // degrees
  uint32_t worst;                         // triangle of the smallest gamma, the first of equals; NONE without triangles
  double area;                            // sum of the signed areas
  size_t ninverted;                       // triangles of area <= 0
  size_t nmaximum;                        // interior edges that break the discrete maximum principle
  double valence6;                        // share of interior vertices with six edges; 1 if there are none
  double tau;                             // efficiency index; 1 without a size field
} MeshQuality;

// Measure ntri triangles tri[3*ntri] over points xy[2*nvert]. h may be NULL. O(n log n).
MeshQuality quality_measure(const double *xy, size_t nvert, const uint32_t *tri, size_t ntri, SizeAt h, void *ctx);

#endif
