// polygons.c - cells of any number of corners, in the formats that hold such
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/polygons.h"

#include <errno.h>

#include "out/out_int.h"

static size_t corners_of(const Polygons *p, size_t k) { return p->start[k + 1] - p->start[k]; }

static size_t cells_in_use(const Polygons *p)
{
  size_t n = 0;
  for (size_t k = 0; k < p->ncell; k++) n += corners_of(p, k) > 0;
  return n;
}

static void put_points(Writer *w, const Polygons *p, const char *prefix)
{
  for (size_t i = 0; i < p->nnode; i++) {
    writer_str(w, prefix);
    char *at = writer_reserve(w, 96), *end = put_char(put_double(at, p->xy[2 * i]), ' ');
    end = put_double(end, p->xy[2 * i + 1]);
    memcpy(end, " 0\n", 3);
    writer_commit(w, (size_t)(end + 3 - at));
  }
}

// A line a cell: the prefix, or without one the number of corners, then the corners from `base` on.
static void put_cells(Writer *w, const Polygons *p, const char *prefix, uint64_t base)
{
  for (size_t k = 0; k < p->ncell; k++) {
    if (corners_of(p, k) == 0) continue;
    if (prefix) writer_str(w, prefix);
    else writer_u64(w, corners_of(p, k));
    for (uint32_t i = p->start[k]; i < p->start[k + 1]; i++) {
      writer_char(w, ' ');
      writer_u64(w, p->corner[i] + base);
    }
    writer_char(w, '\n');
  }
}

static void write_vtk(Writer *w, const Polygons *p)
{
  enum { VTK_POLYGON = 7 };
  size_t n = cells_in_use(p);
  writer_printf(w, "# vtk DataFile Version 3.0\nmeshgen\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %zu double\n", p->nnode);
  put_points(w, p, "");
  writer_printf(w, "CELLS %zu %zu\n", n, n + p->start[p->ncell]);
  put_cells(w, p, NULL, 0);
  writer_printf(w, "CELL_TYPES %zu\n", n);
  for (size_t k = 0; k < n; k++) writer_printf(w, "%d\n", VTK_POLYGON);
  writer_printf(w, "CELL_DATA %zu\nSCALARS point int 1\nLOOKUP_TABLE default\n", n);
  for (size_t k = 0; k < p->ncell; k++) {
    if (corners_of(p, k) == 0) continue;
    writer_u64(w, p->id[k]);
    writer_char(w, '\n');
  }
}

static void write_off(Writer *w, const Polygons *p)
{
  writer_printf(w, "OFF\n%zu %zu 0\n", p->nnode, cells_in_use(p));
  put_points(w, p, "");
  put_cells(w, p, NULL, 0);
}

static void write_obj(Writer *w, const Polygons *p)
{
  put_points(w, p, "v ");
  put_cells(w, p, "f", 1);
}

static void write_ply(Writer *w, const Polygons *p)
{
  writer_printf(w, "ply\nformat ascii 1.0\nelement vertex %zu\nproperty double x\nproperty double y\nproperty double z\n"
                   "element face %zu\nproperty list uint uint vertex_indices\nend_header\n", p->nnode, cells_in_use(p));
  put_points(w, p, "");
  put_cells(w, p, NULL, 0);
}

typedef struct {
  const char *name;
  void (*write)(Writer *w, const Polygons *p);
} PolygonFormat;

static const PolygonFormat formats[] = {{"vtk", write_vtk}, {"off", write_off}, {"obj", write_obj}, {"ply", write_ply}};

static const PolygonFormat *find(const char *name)
{
  for (size_t i = 0; i < ARRAY_LEN(formats); i++)
    if (strcmp(formats[i].name, name) == 0) return &formats[i];
  return NULL;
}

bool polygons_format(const char *format) { return find(format) != NULL; }

ExitCode polygons_write(const Polygons *p, const char *path, const char *format, Diag *d)
{
  Writer *w = writer_open(path);
  int error = w ? 0 : errno;
  if (w) {
    find(format)->write(w, p);
    error = writer_close(w);
  }
  if (error) diag_error(d, NO_LOC, "%s: %s", path, strerror(error));
  return error ? EXIT_ENVIRONMENT : EXIT_GOOD;
}
