// cells.h - unstructured grids of VTK as arrays, and their way into a mesh; shared by the readers of both VTK formats
// SPDX-License-Identifier: MIT
#ifndef OUT_CELLS_H
#define OUT_CELLS_H

#include "base/mem.h"
#include "out/import.h"

typedef struct {
  DoubleVec point;          // 3 per point
  Vec(int64_t) connectivity;// of all cells
  Vec(int64_t) offset;      // ncell + 1: where each cell begins
  Vec(int64_t) type;        // VTK's numbers
  Vec(int64_t) group;       // per cell; empty if the file does not say
  Vec(int64_t) entity;
  Vec(int64_t) part;        // of a mesh in parts
} Cells;

// Points and cells to nodes and elements, with every index checked. Frees the arrays.
void cells_import(Cells *c, Import *im);
void cells_free(Cells *c);
// Does an array of this name hold groups (1), entities (2), parts (3), or none of these (0)?
int cells_array_kind(const char *name);

#endif
