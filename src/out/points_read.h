// points_read.h - point sets and straight-line graphs to triangulate: .xyz, and Triangle's .node and .poly
// SPDX-License-Identifier: MIT
#ifndef OUT_POINTS_READ_H
#define OUT_POINTS_READ_H

#include "base/base.h"
#include "base/diag.h"
#include "base/mem.h"

typedef struct {
  DoubleVec xy;          // 2 per point
  DoubleVec z;           // 1 per point of an .xyz file with three columns, else empty
  U32Vec ends;           // 2 per segment: indices of points
  U32Vec marks;          // 1 per segment: its boundary mark, 0 if the file gives none (or one below 1)
  DoubleVec holes;       // 2 per hole
  DoubleVec regions;     // 2 per region
  U32Vec labels;         // 1 per region
} PointsFile;

// Read a .xyz, .node or .poly file (by its extension; anything else as .xyz): numbers apart by blanks or commas, lines
// that begin with # left out. A .poly without points takes them from the .node beside it. EXIT_GOOD, or an error through
// d with the line: EXIT_INPUT (nothing to read, a number that is missing, nan or infinite, an index out of range) or
// EXIT_ENVIRONMENT. Release with points_free in any case.
ExitCode points_read(const char *path, PointsFile *out, Diag *d);
void points_free(PointsFile *p);

#endif
