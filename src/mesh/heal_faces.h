// heal_faces.h - faces whose loops cross or that lie on each other: each gets the cells of the arrangement that are its own
// SPDX-License-Identifier: MIT
#ifndef MESH_HEAL_FACES_H
#define MESH_HEAL_FACES_H

#include "base/base.h"
#include "mesh/mesh1d.h"

// Curves that meet have common points, and their meshes do not cross (mesh1d_heal). Bound every plane face by the curves between
// its cells and the rest, with the face on the left, and embed those with its cells on both sides. A cell of the arrangement of the
// curves belongs to the face of the highest tag that has it. A cell is in a loop that runs around it an odd number of
// times, and in a face if it is in an odd number of its parts: loops, or loops that meet - then their union, or what they leave of the
// outer loop. A face in several pieces becomes as
// many faces; the first keeps the tag, the others are in the same groups and in the same lists of fields (may be NULL). Parts of their curves
// that are in no face then are deleted. *changed gets the number of faces
// bounded by other curves than before; then the model must be prepared and its curves meshed again. A face of which
// nothing is left is deleted, with a warning. False after errors: a boundary that cannot be triangulated. O(n log n) a face, times the faces above it.
bool heal_faces(Model *m, FieldSet *fields, const Mesh1d *curves, Diag *diag, size_t *changed);

#endif
