// surface.c - surface formats: the elements of dimension 2 alone, as polygons of their corners
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/import.h"
#include "out/out_int.h"
#include "out/surface_io.h"

const char *surface__refuses(const Selection *s)
{
  for (size_t i = 0; i < s->nblock; i++)
    if (elem_order(s->mesh->block[s->block[i]].type) > 1) return "surface formats hold elements of order 1 only";
  return NULL;
}

// Text of the file, to be freed; NULL and *why.
static char *make(const Selection *s, const char *ext, bool binary, size_t *len, const char **why)
{
  const Mesh *m = s->mesh;
  SurfacePolygons p = {.nnode = s->nnode};
  size_t corners = 0;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &m->block[s->block[i]];
    p.nface += k->n;
    corners += k->n * (size_t)elem_corners(k->type);
  }
  p.xyz = mem_alloc(3 * p.nnode * sizeof *p.xyz);
  p.start = mem_alloc((p.nface + 1) * sizeof *p.start);
  p.vertex = mem_alloc(corners * sizeof *p.vertex);
  for (size_t k = 0; k < s->nnode; k++) {
    Vec3 x = select__xyz(s, k);
    memcpy(p.xyz + 3 * k, &x, sizeof x);
  }
  size_t f = 0, at = 0;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &m->block[s->block[i]];
    int n = elem_corners(k->type);
    for (size_t j = 0; j < k->n; j++) {
      p.start[f++] = (uint32_t)at;
      for (int a = 0; a < n; a++) p.vertex[at++] = s->number[k->node[j * (size_t)n + (size_t)a]];
    }
  }
  p.start[f] = (uint32_t)at;
  char *text = NULL;
  *why = surface_write(&p, ext, binary, &text, len);
  free(p.xyz);
  free(p.start);
  free(p.vertex);
  return text;
}

static const char *write_as(Writer *w, const Selection *s, const OutOptions *o, const char *ext)
{
  size_t len;
  const char *why;
  char *text = make(s, ext, o->binary, &len, &why);
  if (text) writer_bytes(w, text, len);
  free(text);
  return why;
}

static Mesh *read_as(const char *text, size_t len, const char *name, Diag *d, const char *ext)
{
  Scan s = {.p = text, .end = text + len, .begin = text, .name = name, .diag = d, .binary = true};
  Import im;
  SurfacePolygons p = {0};
  import_begin(&im, &s);
  const char *why = surface_read(&p, ext, text, len);
  if (why) scan_error(&s, "%s", why);
  for (size_t i = 0; !why && i < p.nnode && !s.failed; i++) {
    const double *x = p.xyz + 3 * i;
    if (!isfinite(x[0] + x[1] + x[2])) scan_error(&s, "point %zu is not finite", i + 1);
    import_node(&im, i + 1, (Vec3){x[0], x[1], x[2]}, -1, 0, NAN);
  }
  for (size_t f = 0; !why && f < p.nface && !s.failed; f++) {
    uint32_t n = p.start[f + 1] - p.start[f];
    if (n != 3 && n != 4) {
      scan_error(&s, "face %zu has %u corners; 3 and 4 are read", f + 1, n);
      break;
    }
    import_element(&im, n == 3 ? ELEM_TRI3 : ELEM_QUAD4, 1, 0);
    for (uint32_t k = 0; k < n; k++) import_element_node(&im, p.vertex[p.start[f] + k] + 1u);
  }
  free(p.xyz);
  free(p.start);
  free(p.vertex);
  return import_finish(&im);
}

#define SURFACE_FORMAT(ext)                                                                                        \
  const char *ext##__write_or(Writer *w, const Selection *s, const OutOptions *o) { return write_as(w, s, o, #ext); } \
  Mesh *ext##__read(const char *text, size_t len, const char *name, Diag *d) { return read_as(text, len, name, d, #ext); }
SURFACE_FORMAT(off)
SURFACE_FORMAT(obj)
SURFACE_FORMAT(ply)
SURFACE_FORMAT(stl)
