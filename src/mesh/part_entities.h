// part_entities.h - a partitioned mesh on entities of its parts, as MSH 4 files have it
// SPDX-License-Identifier: MIT
//
// Each entity is divided in pieces that lie in one part; they are entities of the same dimension with new
// tags, the old one being their parent, whose groups they share. With topology a piece hangs together, and
// what lies between parts is there too: curves whose parent is a surface and points whose parent is a curve
// or surface, with the parts that meet there. The elements of those are not the mesh's: lines along the edges
// between the parts (seams), and points at the ends of these. Pieces of surfaces are then bounded by pieces
// of curves and by seams, and these by points, as everywhere.
#ifndef MESH_PART_ENTITIES_H
#define MESH_PART_ENTITIES_H

#include "mesh/mesh.h"
#include "mesh/part_nodes.h"

typedef struct {
  bool topology; // connected pieces, with curves and points between parts
  bool groups;   // a group of its own for each combination of parts and groups: _part{1,2}_physical{3}_dim{1}
} PartEntityOptions;

// m's nodes, in their order, on entities of its parts; the old entities are there too, without elements, and
// with the nodes that no element uses. Elements of m keep their parts; those between parts have none
// (MeshBlock.part is NULL). The caller frees. O(n).
Mesh *mesh_part_entities(const Mesh *m, const PartEntityOptions *o);

// What the computer of one part needs of m, as a mesh of its own.
typedef struct {
  Mesh *mesh;      // node_number: the nodes' positions in m, from 1
  U32Vec block_of; // per block: that of m whose elements it has, all in their order; NONE: some of them, or
                   // ghost cells
  U32Vec ghost_of; // per ghost cell, in the order of the last blocks: its index in the list of ghosts
  Ghosts ghosts;   // of the elements of `mesh`: which other parts see them
} PartOnly;

// If m is on entities of its parts: the elements of those that lie in `part` or beside it; else the elements
// of the part. Entities of no part are all kept. ghosts: those of m, or NULL. With a ghost_tag the ghost
// cells of the part are there too, on a last entity of that tag whose parent_dim is -1. local is scratch: a
// NONE per node of m, and left so.
void mesh_part_only(PartOnly *out, const Mesh *m, uint32_t part, const Ghosts *ghosts, int ghost_tag,
                    uint32_t *local);
void part_only_free(PartOnly *p);

#endif
