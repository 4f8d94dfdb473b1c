// face_cross.h - the cross field that the meshes made for quads follow, on a triangulation that is to be refined
// SPDX-License-Identifier: MIT
#ifndef MESH_FACE_CROSS_H
#define MESH_FACE_CROSS_H

#include "base/base.h"
#include "quad/cross_field.h"
#include "tri/refine.h"

// Zero-initialize; release with face_cross_free, after the refinement.
typedef struct {
  CrossField *field;
  U32Vec near; // a triangle of the field at each vertex of the triangulation
} FaceCross;

// If p asks for a strategy that follows a cross field, make one for the empty mesh t: on a graded mesh of its own, a copy of t
// refined as far as good shapes need, so that it has few triangles where the boundary is far. All segments are sides of crosses.
// p is told to use it. O(n^1.5) in the vertices of that mesh.
void face_cross_prepare(FaceCross *c, const Tri *t, TriRefineParams *p);
void face_cross_free(FaceCross *c);

#endif
