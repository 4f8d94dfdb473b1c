// polygons.h - cells of any number of corners, in the formats that hold such
// SPDX-License-Identifier: MIT
#ifndef OUT_POLYGONS_H
#define OUT_POLYGONS_H

#include "base/base.h"
#include "base/diag.h"

// Cell k has the corners corner[start[k] .. start[k+1]), nodes counterclockwise, and the number id[k], written as cell data
// where the format has such. Cells without corners are left out.
typedef struct {
  const double *xy; // 2 * nnode
  size_t nnode;
  const uint32_t *start, *corner, *id;
  size_t ncell;
} Polygons;

// Does this format (a name of the table in formats.h) hold polygons? vtk, off, obj and ply do.
bool polygons_format(const char *format);
// Write them, as text. EXIT_GOOD, or EXIT_ENVIRONMENT after an error through d; then the target is as it was.
ExitCode polygons_write(const Polygons *p, const char *path, const char *format, Diag *d);

#endif
