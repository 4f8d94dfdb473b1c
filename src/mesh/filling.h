// filling.h - the surface that fills three or four curves (Surface, Ruled Surface): transfinite interpolation of them
// SPDX-License-Identifier: MIT
//
//          c3                 Four curves: u runs along the first, v along the second; the surface is the sum of the two
//    4 <---------- 3          ruled ones less the bilinear one [Gordon73].
//  c4|             ^ c2
//    v             |          Three curves: the parameters are those of the triangle (0,0), (1,0), (1,1), whose corners are the
//    1 ----------> 2          ends of the curves; each corner sends its two curves, and the three are blended by barycentric
//          c1                 coordinates [Perronnet98].
#ifndef MESH_FILLING_H
#define MESH_FILLING_H

#include "base/base.h"
#include "geom/vec.h"
#include "model/model.h"

typedef struct {
  const Model *model;
  int n;                // 3 or 4 curves
  const Curve *curve[4];
  bool reversed[4];
  Vec3 corner[4];       // where each begins
  bool sphere;          // arcs about one centre that are not in one plane: the surface is drawn onto their sphere
  Vec3 centre;
  double radius;
  bool turned;          // a curve turned about an axis (Extrude): the surface of revolution, at `axis` through `centre`
  Vec3 axis;            // of unit length; the first curve is the one that is turned ...
  double angle;         // ... by so much
  int apex;             // with 3 curves: the corner on the axis, 0 or 1
  Vec2 flat[4];         // corners of the plane polygon that stands for it, of about its size (filling_to_plane)
} Filling;

// False if the face is not one loop of 3 or 4 curves.
bool filling_init(Filling *s, const Model *m, const Face *f);
Vec3 filling_point(const Filling *s, double u, double v);
// Parameters of the place t (0 to 1, in the sense of the loop) on the k-th side.
Vec2 filling_side(const Filling *s, int k, double t);
// Between parameters and a plane polygon with sides about as long as the curves, where the surface is meshed if it is not plane.
Vec2 filling_to_plane(const Filling *s, Vec2 uv);
Vec2 filling_from_plane(const Filling *s, Vec2 q);
// How much longer lengths are on the surface than in that plane, near q: the root of the ratio of areas, between 0.1 and 10.
double filling_stretch(const Filling *s, Vec2 q);

#endif
