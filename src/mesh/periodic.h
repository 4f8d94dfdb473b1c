// periodic.h - pairs of nodes on periodic curves
// SPDX-License-Identifier: MIT
#ifndef MESH_PERIODIC_H
#define MESH_PERIODIC_H

#include "base/base.h"
#include "base/diag.h"
#include "mesh/mesh.h"
#include "model/model.h"

// Image of p under a row-major 4x4 affine map, summed in the order x, y, z, shift.
Vec3 periodic_image(const double affine[16], Vec3 p);
// Put node `slave` exactly on the image of node `master`.
void periodic_place(Mesh *m, const double affine[16], uint32_t slave, uint32_t master);

// Records of all curves with a master whose mesh they copy, and of the points at their ends. Nodes are paired in order along
// the curves (against it where the master was given with a minus sign); interior nodes of a curve with an affine map
// are moved to the exact images of their masters' (they were there to rounding). A curve whose count differs from its
// master's gives no record and a warning.
void periodic_add(Mesh *mesh, const Model *model, Diag *diag);

#endif
