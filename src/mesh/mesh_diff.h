// mesh_diff.h - what is different between two meshes
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH_DIFF_H
#define MESH_MESH_DIFF_H

#include "mesh/mesh_hash.h"
#include "mesh/mesh_stats.h"

typedef enum {
  DIFF_SAME,      // equal up to numbering: the same hash
  DIFF_WITHIN,    // the same elements and groups over nodes that moved by at most the tolerance
  DIFF_DIFFERENT
} DiffVerdict;

typedef enum { GROUP_SAME, GROUP_ADDED, GROUP_LOST, GROUP_RENAMED, GROUP_RETAGGED, GROUP_CHANGED } GroupChange;

typedef struct {
  int dim;
  int tag[2];               // 0 where it is not there
  const char *name[2];      // belongs to the meshes; NULL if it has none
  size_t elements[2];
  double size[2];           // length or area
  GroupChange change;       // GROUP_CHANGED: the same name and tag, other elements or another size
} GroupDiff;

typedef struct {
  int dim, tag;
  size_t elements[2];
  size_t changed[2];        // elements that the other mesh has not
  double size[2];
  size_t moved;             // nodes on it that moved
  double largest;           // the farthest they did
  double quality[2];        // smallest gamma or eta of a face; 0 for others
} EntityDiff;

typedef struct {
  DiffVerdict verdict;
  MeshHash hash[2];
  bool same_numbering;      // nodes and elements correspond by their numbers
  size_t nodes[2];
  size_t alone[2];          // nodes of one mesh that are matched with none of the other
  size_t moved;             // matched nodes that are not at the same place
  double largest, mean;     // distances of those
  Vec3 from, to;            // where the one that moved farthest was and is
  int moved_dim, moved_tag; // its entity
  MeshStats stats[2];
  uint8_t *changed[2];      // per element in the order of the blocks: not in the other mesh
  size_t nchanged[2];
  Vec(EntityDiff) entity;   // those that differ, by dimension and tag
  Vec(GroupDiff) group;     // those that differ, by dimension and tag
} MeshDiff;

// Compare b with a, what the saving rule selects of both. Nodes correspond by number if both meshes have the same elements
// over the same numbers, else by place: those of equal coordinates, then nearest ones within tol. O(n) expected; release
// with mesh_diff_free, while the meshes live.
void mesh_diff_make(MeshDiff *d, const Mesh *a, const Mesh *b, double tol);
void mesh_diff_free(MeshDiff *d);

const char *mesh_diff_change(GroupChange c); // "added", "lost", ...

#endif
