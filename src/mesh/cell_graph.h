// cell_graph.h - the dual graph of a mesh: its elements as vertices, joined where they share an edge
// SPDX-License-Identifier: MIT
#ifndef MESH_CELL_GRAPH_H
#define MESH_CELL_GRAPH_H

#include "mesh/edge_uses.h"

// The vertices (cells) are the surface elements and the lines that are no edge of one (in a mesh of neither,
// the points). Surface elements are joined across edges, whatever their entities; lines through their nodes,
// to each other and to one surface element. Every other element goes with a cell: a line with the first
// surface element that has it as an edge, a point with the first cell at its node, or with the first of all.
typedef struct {
  size_t n;        // cells: first all surface elements in their order, then lines, then points
  uint32_t *elem;  // per cell: its element, as numbered by ids
  uint32_t *cell;  // per element: the cell it is or goes with
  uint32_t *start; // n + 1 entries: where the neighbours of a cell begin
  uint32_t *next;  // the neighbours, each once
} CellGraph;

// O(n) for nodes of bounded degree.
void cell_graph_make(CellGraph *g, const Mesh *m, const ElemIds *ids, const EdgeUses *uses);
void cell_graph_free(CellGraph *g);
// The same from the mesh alone; ids is made too, to be freed by the caller.
void cell_graph_of_mesh(CellGraph *g, ElemIds *ids, const Mesh *m);

// Label the cells by connected components among cells of equal label (label NULL: all are equal), in order of
// first cells. Returns their number.
uint32_t cell_graph_components(const CellGraph *g, const uint32_t *label, uint32_t *component);

#endif
