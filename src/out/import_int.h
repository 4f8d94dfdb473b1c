// import_int.h - what the files import*.c share: the steps from what was gathered to a mesh
// SPDX-License-Identifier: MIT
#ifndef OUT_IMPORT_INT_H
#define OUT_IMPORT_INT_H

#include "out/import.h"

// Nodes of the elements of a run.
static inline const uint32_t *import__run_nodes(const Import *im, const ImportRun *r)
{
  return r->own ? r->own : im->node.data + r->first;
}
// All runs are forgotten, with their nodes. import_finish.c
void import__free_runs(Import *im);

// Give every entity its groups, where groups are told per element: equal elements become one, and each set of groups that elements
// of an entity are in becomes an entity. O(n log n) for the entities whose elements disagree; others are not looked at.
void import__resolve_groups(Import *im);

#endif
