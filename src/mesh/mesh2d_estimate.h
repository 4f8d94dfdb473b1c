// mesh2d_estimate.h - how many elements the faces will get, before they are meshed
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH2D_ESTIMATE_H
#define MESH_MESH2D_ESTIMATE_H

#include "mesh/mesh2d.h"

// Elements expected in all faces, copies included: cells of transfinite and extruded faces as the counts on their curves have them,
// and in plane faces the integral of 4 / (sqrt(3) h^2) over midpoints of a grid (1 / h^2 where quadrangles are made), h the
// smaller of size_in_face and what the boundary hands on. Faces bounded by so few and long edges that they cannot matter are bounded
// from above instead, so the result is only good as a guess from Mesh.MaxElements / 100 on. Fillings that are neither count 0.
// Mostly within 25 % of what comes out, seldom off by half: where sizes change within less than the grid's cells, which are at most
// a hundredth as many as the elements expected. O(edges on the boundaries + elements / 100).
double mesh2d_estimate(const Mesh2dInput *in);

// False if that is more than twice Mesh.MaxElements: an error then names the estimate, the face of most elements and what
// makes its smallest size. Between the two the refiner's own limit decides.
bool mesh2d_is_affordable(const Mesh2dInput *in);

#endif
