// mesh_hash.h - a fingerprint of a mesh that does not depend on format or numbering
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH_HASH_H
#define MESH_MESH_HASH_H

#include "mesh/mesh.h"

// Equal for meshes of the same elements at the same places (coordinates to the bit, -0 being 0), whatever the order of
// nodes, elements and corners (up to rotation) and the numbers of nodes, elements and entities. Orientation counts: that of
// the element, reversed where its first group has it with a minus sign. Nodes of no element and parameters do not count.
typedef struct {
  uint64_t shape[2];  // elements and places alone
  uint64_t groups[2]; // and which element is in which group (dimension and tag)
  uint64_t full[2];   // and the names of the groups that have elements: what "the hash of a mesh" means
} MeshHash;

// Of what the saving rule selects. O(n).
MeshHash mesh_hash(const Mesh *m, bool save_all);

enum { MESH_HASH_TEXT = 33 };
// 32 hexadecimal digits and a NUL.
void mesh_hash_print(const uint64_t h[2], char to[MESH_HASH_TEXT]);

#endif
