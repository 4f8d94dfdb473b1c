// part_entities_int.h - what the files part_*.c that divide entities share
// SPDX-License-Identifier: MIT
#ifndef MESH_PART_ENTITIES_INT_H
#define MESH_PART_ENTITIES_INT_H

#include "base/map.h"
#include "mesh/cell_graph.h"
#include "mesh/part_entities.h"

// Distinct ascending lists of parts: set i is part[start[i]] up to part[start[i + 1]].
typedef struct {
  U32Vec start, part;
  Map index;
} PartSets;

// Index of the set of n ascending parts, new or old.
uint32_t part_sets__get(PartSets *s, const uint32_t *part, uint32_t n);
// Parts of both, merged.
uint32_t part_sets__union(PartSets *s, uint32_t a, uint32_t b);
void part_sets__free(PartSets *s);
static inline const uint32_t *part_sets__at(const PartSets *s, uint32_t set, uint32_t *n)
{
  *n = s->start.data[set + 1] - s->start.data[set];
  return s->part.data + s->start.data[set];
}

// An entity of parts in the making.
typedef struct {
  uint32_t entity; // of m: its parent
  uint32_t set;    // its parts
  bool between;    // it lies between parts, and has the elements node[first ..] of type `type`
  ElemType type;
  size_t first, n;  // in nodes; in elements
  uint32_t ends[2]; // of a curve: pieces of dimension 0 it runs from and to; NONE if it is closed or has none
} Piece;

// A line of a curve, or an edge between parts: what pieces of curves are made of.
typedef struct {
  uint32_t node[2];
  uint32_t entity, set; // neighbours of equal entity, set and type are one piece
  ElemType type;        // of the line
  uint32_t elem;        // the line, or a surface element that has the edge
  uint32_t piece;       // once known
} Link;

// Links with, per node, those there: first[v], then next[2 * link + end] coded alike as 2 * link + end; in
// order of the links.
typedef struct {
  Vec(Link) link;
  uint32_t *first, *next;
} Chains;

// Of what bounds a piece of a surface: a piece of a curve, counted from 1, negative if it runs the other way.
typedef struct {
  uint32_t surface;
  int curve;
} Bound;

typedef struct {
  const Mesh *m;
  bool topology;
  ElemIds ids;
  EdgeUses uses;
  PartSets sets;
  Vec(Piece) piece[3];  // by dimension
  uint32_t *of;         // per element: its piece
  uint32_t *node_piece; // per node: the piece it is classified on, or NONE
  uint8_t *node_dim;    // and that one's dimension
  Chains curves, seams;
  bool *ends;          // per node: pieces of curves and seams end here
  uint32_t *end_piece; // per node: piece of dimension 0 that seams end at; NONE: they do not
  U32Vec node;         // of elements between parts
  Vec(Bound) bound;    // by surface piece
} Division;

// In this order. Pieces of surfaces, by entity, part and first element.
void division__surfaces(Division *d);
// Pieces of curves, by entity; with topology also seams, behind them, and where both end.
void division__curves(Division *d);
// Nodes onto pieces; pieces of points, then the points at which pieces and seams end.
void division__nodes(Division *d);
// What bounds the pieces of surfaces.
void division__bounds(Division *d);

#endif
