// mesh_join.h - parts of a mesh, read from files of their own, put together again; nodes left out
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH_JOIN_H
#define MESH_MESH_JOIN_H

#include "mesh/mesh.h"

// Take out the nodes of which unused[] says true and that no element uses. Their numbers stay with the
// others.
void mesh_drop_unused(Mesh *m, const bool *unused);

// One mesh of the elements of n meshes, whose nodes are told by their numbers: the same number is the same
// node, entities and groups are told by dimension and tag. Elements of equal nodes, entity and type that
// several meshes have are there once. Returns NULL and in *number the node that two meshes have at different
// places. The caller frees. O(n log n).
Mesh *mesh_join(Mesh *const *part, size_t n, unsigned long long *number);

#endif
