// mesh_hash_int.h - hashes of nodes and of single elements, for the comparison of meshes
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH_HASH_INT_H
#define MESH_MESH_HASH_INT_H

#include "mesh/mesh_hash.h"

// Hash of every node's coordinates; the caller frees.
uint64_t *mesh_hash__points(const Mesh *m);
// As mesh_hash with these hashes of nodes. each, if not NULL, has room for all elements of the mesh and gets the hash of each
// that is saved, in the order of the blocks.
MeshHash mesh_hash__of(const Mesh *m, bool save_all, const uint64_t *node, uint64_t *each);

#endif
