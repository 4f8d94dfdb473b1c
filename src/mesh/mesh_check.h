// mesh_check.h - the audit: is this a valid mesh? Independent of whatever made it
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH_CHECK_H
#define MESH_MESH_CHECK_H

#include "mesh/mesh.h"

typedef enum {
  RULE_INDEX,             // numbers of nodes and entities exist, types fit dimensions, lists are in order
  RULE_COORDINATE,        // coordinates are finite
  RULE_ORIENTATION,       // elements of a face all turn the same way, exactly; quadrangles are convex
  RULE_DEGENERATE,        // no element has collinear corners or a node twice, exactly
  RULE_DUPLICATE_NODE,    // no two nodes have the same coordinates
  RULE_ORPHAN_NODE,       // every node is in an element
  RULE_DUPLICATE_ELEMENT, // no two elements have the same corners
  RULE_EDGE,              // in a face an edge has one element on each side, or one and a boundary
  RULE_T_JUNCTION,        // no node lies within a boundary edge; a warning where it belongs to something not joined to it
  RULE_HOLE,              // the boundary of a face lies on its curves
  RULE_LOST_EDGE,         // every line element is an edge of the faces that its curve bounds or is embedded in
  RULE_CLASSIFICATION,    // nodes of an element are on its entity or on what bounds it
  RULE_GROUP,             // groups exist, have elements, and are not named alike
  RULE_EULER,             // V - E + F of a face is 2 minus the number of its boundary cycles
  RULE_INDEX_SUM,         // the indices of the vertices of a face of quadrangles add up to that [book eq. 1.9]
  RULE_AREA,              // areas of a face's elements add up to the area within its line elements
  RULE_PERIODIC,          // paired nodes are images of each other
  RULE_COUNT
} MeshRule;

typedef struct {
  MeshRule rule;
  bool warning;         // not wrong, but nothing that meshgen would write
  int dim, tag;         // entity; tag 0 if it concerns none
  uint64_t element;     // number, counted from 1 in the order of the blocks; 0 if it concerns none
  uint32_t node;        // index, or NONE
  Vec3 at;              // where
  char text[160];       // what, without the place
} MeshFinding;

typedef struct {
  Vec(MeshFinding) finding; // the first MESH_CHECK_MAX of each rule, by rule, then in the order of the mesh
  size_t count[RULE_COUNT]; // all of them
  size_t errors, warnings;
} MeshReport;

enum { MESH_CHECK_MAX = 20 };

// strict: a mesh as the mesher makes it, complete and with the boundary of every entity known: whatever is missing is an error.
// Not strict: any mesh that was read; what cannot be known (curves that were not saved) is not asked for, and orphan nodes
// are warnings. True without errors. O(n) expected. Release with mesh_report_free.
bool mesh_check(const Mesh *m, bool strict, MeshReport *report);
void mesh_report_free(MeshReport *report);

// "duplicate-node", "t-junction", ...
const char *mesh_rule_name(MeshRule rule);
// "duplicate-node: face 3, element 12, at (1, 2): text"; at most cap bytes.
void mesh_finding_print(const MeshFinding *f, char *to, size_t cap);

#endif
