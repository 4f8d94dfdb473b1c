// mesh2d_estimate.h - are the faces worth beginning: sizes that are none, and too many elements, found before meshing
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH2D_ESTIMATE_H
#define MESH_MESH2D_ESTIMATE_H

#include "mesh/mesh2d.h"

// False, with an error, where the sizes inside a face are bad (not positive, not a number) or the elements expected in all faces are more
// than twice Mesh.MaxElements. The error names the estimate, the face of most elements and what makes its smallest size.
// Between the limit and twice that the refiner's own count decides.
//
// Expected are, copies included: in transfinite and extruded faces the cells that the counts on their curves make, and in plane
// faces the integral of 4 / (sqrt(3) h^2) over midpoints of a grid (1 / h^2 where quadrangles are made), h the smaller of
// size_in_face and what the boundary hands on. A face that cannot matter, even if it had triangles of its shortest edge all over, is
// not sampled. Fillings that are neither count 0. Mostly within 25 % of what comes out, seldom off by half: where sizes change within
// less than the grid's cells, which are at most a hundredth as many as the elements expected.
// O(edges on the boundaries + elements / 100).
bool mesh2d_is_affordable(const Mesh2dInput *in);

#endif
