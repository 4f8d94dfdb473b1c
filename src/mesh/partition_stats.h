// partition_stats.h - what the report says of a partition: sizes of the parts, edges between them, neighbours
// SPDX-License-Identifier: MIT
#ifndef MESH_PARTITION_STATS_H
#define MESH_PARTITION_STATS_H

#include "mesh/mesh.h"

typedef struct {
  size_t lines, triangles, quads; // elements
  size_t elements;                // of the largest dimension, those with ghosts; what `imbalance` speaks of
  size_t cut;                     // edges shared with other parts
  size_t ghosts;                  // elements of other parts with a node of this one's
  uint32_t neighbours;            // parts that have a node in common with it
  uint32_t pieces;                // components joined by edges; 1 is best
} PartInfo;

typedef struct {
  uint32_t n;
  PartInfo *part;         // of part 1, 2, ...
  size_t least, most;     // elements of a part
  double mean, imbalance; // most / mean - 1
  size_t cut;             // edges between elements of different parts
  size_t shared_nodes;    // corner nodes of several parts
  uint32_t neighbours;    // the most that a part has
  uint32_t pieces;        // of all parts; n if each hangs together
} PartitionStats;

// m is partitioned. O(n). Release with partition_stats_free.
void partition_stats_make(PartitionStats *s, const Mesh *m);
void partition_stats_free(PartitionStats *s);

#endif
