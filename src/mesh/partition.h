// partition.h - a mesh divided in parts for computers that work together: by METIS, on the dual graph
// SPDX-License-Identifier: MIT
//
// A partition is a number from 1 to Mesh.nparts for each element (MeshBlock.part). Nodes have none: those of
// several parts are what the parts have in common.
#ifndef MESH_PARTITION_H
#define MESH_PARTITION_H

#include "base/diag.h"
#include "mesh/mesh.h"
#include "opt/options.h"

// Divide m in n parts of about equal weight with few edges between them, as the options say (Mesh.Metis...,
// Mesh.Partition...Weight). Lines and points go with a surface element beside them. No part is empty; pieces
// that METIS leaves apart from the rest of their part join a neighbour where the balance allows. n of 0 and 1
// take an older partition away. The same mesh and options give the same parts. False after an error (fewer
// elements than parts), which leaves the mesh as it was. Most of the time is METIS's.
bool mesh_partition(Mesh *m, int n, const Options *o, Diag *d);

// Lines and points of part 0 get that of an element they go with. False, and m is not partitioned any more,
// if others have none.
bool mesh_complete_parts(Mesh *m);

#endif
