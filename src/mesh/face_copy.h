// face_copy.h - faces that take the mesh of another face: the far end of an extrusion with Layers, Periodic Surface
// SPDX-License-Identifier: MIT
#ifndef MESH_FACE_COPY_H
#define MESH_FACE_COPY_H

#include "base/base.h"
#include "mesh/edge_nodes.h"
#include "mesh/mesh2d.h"

// Index of the face whose mesh f is to copy; NONE if it has one of its own.
uint32_t face_copy_source(const Model *m, const Face *f);

// Carry the mesh `from` of that face over to f by the map that goes with it (or, between plane faces, by the one that the pairs of
// their curves determine). The nodes on the boundary of f are used where the images fall on them. False, and `out` untouched, if
// they do not fit one to one: then f is meshed on its own. O(n).
bool face_copy(const Mesh2dInput *in, const Face *f, const EdgeNodes *en, const FaceMesh *from, FaceMesh *out);

#endif
