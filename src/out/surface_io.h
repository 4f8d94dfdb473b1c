// surface_io.h - OFF, OBJ, PLY and STL by way of the OpenMesh library
// SPDX-License-Identifier: MIT
#ifndef OUT_SURFACE_IO_H
#define OUT_SURFACE_IO_H

#include "base/base.h"

// Polygons over points: face i has the corners vertex[start[i]] .. vertex[start[i+1]-1].
typedef struct {
  double *xyz;      // 3 * nnode
  uint32_t *start;  // nface + 1
  uint32_t *vertex;
  size_t nnode, nface;
} SurfacePolygons;

#ifdef __cplusplus
extern "C" {
#endif

// Text of a file with extension ext ("off", "obj", "ply", "stl"); *text is malloc'ed. NULL, or why not: the library's half-edges
// hold manifold surfaces only.
const char *surface_write(const SurfacePolygons *p, const char *ext, bool binary, char **text, size_t *len);
// Polygons of such a file, malloc'ed arrays. NULL, or why not.
const char *surface_read(SurfacePolygons *p, const char *ext, const char *text, size_t len);

#ifdef __cplusplus
}
#endif

#endif
