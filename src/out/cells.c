// cells.c - unstructured grids of VTK as arrays, and their way into a mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/cells.h"

#include <math.h>
#include <strings.h>

#include "out/out_int.h"

void cells_free(Cells *c)
{
  vec_free(&c->point);
  vec_free(&c->connectivity);
  vec_free(&c->offset);
  vec_free(&c->type);
  vec_free(&c->group);
  vec_free(&c->entity);
  vec_free(&c->part);
}

int cells_array_kind(const char *name)
{
  static const char *const groups[] = {"CellEntityIds", "gmsh:physical", "medit:ref", "PhysicalIds"};
  static const char *const entities[] = {"GeometricalEntityIds", "gmsh:geometrical"};
  for (size_t i = 0; i < ARRAY_LEN(groups); i++)
    if (strcasecmp(name, groups[i]) == 0) return 1;
  for (size_t i = 0; i < ARRAY_LEN(entities); i++)
    if (strcasecmp(name, entities[i]) == 0) return 2;
  return strcasecmp(name, "partition") == 0 ? 3 : 0;
}

// Type of a cell of so many points; 0 if it is none of ours, -1 if it is of dimension 3.
static int type_of(int64_t vtk, int64_t points)
{
  static const ElemType all[] = {ELEM_POINT, ELEM_LINE2, ELEM_TRI3, ELEM_QUAD4, ELEM_LINE3, ELEM_TRI6, ELEM_QUAD8, ELEM_QUAD9,
                                 ELEM_LINE4, ELEM_LINE5, ELEM_TRI10, ELEM_TRI15, ELEM_QUAD16, ELEM_QUAD25};
  if ((vtk >= 10 && vtk <= 14) || (vtk >= 24 && vtk <= 29 && vtk != 28) || (vtk >= 71 && vtk <= 74)) return -1;
  for (size_t i = 0; i < ARRAY_LEN(all); i++) {
    bool lagrange = (vtk == 68 && elem_dim(all[i]) == 1) || (vtk == 69 && elem_corners(all[i]) == 3) ||
                    (vtk == 70 && elem_corners(all[i]) == 4);
    if (elem_nodes(all[i]) == points && (vtk__cell_type(all[i]) == vtk || lagrange)) return all[i];
  }
  return 0;
}

static void import_cell(Cells *c, Import *im, size_t i)
{
  int64_t from = c->offset.data[i], to = c->offset.data[i + 1], vtk = c->type.data[i];
  if (from < 0 || to < from || (uint64_t)to > c->connectivity.len) {
    scan_error(im->s, "cell %zu lies outside of the connectivity", i);
    return;
  }
  const int64_t *v = c->connectivity.data + from;
  int64_t group = c->group.len ? c->group.data[i] : 0, entity = c->entity.len ? c->entity.data[i] : 0;
  int g = group > 0 && group <= INT32_MAX ? (int)group : 0, e = entity > 0 && entity <= INT32_MAX ? (int)entity : MAX(g, 1);
  int64_t n = to - from;
  if (c->part.len) import_part(im, c->part.data[i]);
  int t = type_of(vtk, n);
  // Poly-vertices, polylines and triangle strips are several elements; polygons of 3 and 4 are ours.
  ElemType part = vtk == 2 ? ELEM_POINT : vtk == 4 ? ELEM_LINE2 : vtk == 6 ? ELEM_TRI3 : 0;
  if (vtk == 7 && (n == 3 || n == 4)) t = n == 3 ? ELEM_TRI3 : ELEM_QUAD4;
  if (vtk == 8 && n == 4) t = ELEM_QUAD4;
  if (part) {
    int k = elem_nodes(part);
    for (int64_t j = 0; j + k <= n; j++) {
      import_element(im, part, e, g);
      for (int a = 0; a < k; a++) import_element_node(im, (uint64_t)v[j + (part == ELEM_TRI3 && j % 2 && a < 2 ? 1 - a : a)]);
    }
    return;
  }
  if (t < 0) {
    im->volumes++;
    return;
  }
  if (!t) {
    scan_error(im->s, "cell %zu: VTK type %lld with %lld points is not read", i, (long long)vtk, (long long)n);
    return;
  }
  uint8_t perm[ELEM_MAX_NODES];
  int64_t node[ELEM_MAX_NODES];
  vtk__order((ElemType)t, perm);
  for (int a = 0; a < n; a++) node[perm[a]] = v[a];
  if (vtk == 8) {
    node[2] = v[3];
    node[3] = v[2];
  }
  import_element(im, (ElemType)t, e, g);
  for (int a = 0; a < n; a++) import_element_node(im, (uint64_t)node[a]);
}

void cells_import(Cells *c, Import *im)
{
  size_t n = c->type.len;
  if (!im->s->failed && n && c->offset.len != n + 1) scan_error(im->s, "%zu cells, but types for %zu", c->offset.len ? c->offset.len - 1 : 0, n);
  if (!im->s->failed && c->group.len && c->group.len != n) scan_error(im->s, "groups for %zu of %zu cells", c->group.len, n);
  if (!im->s->failed && c->entity.len && c->entity.len != n) scan_error(im->s, "entities for %zu of %zu cells", c->entity.len, n);
  if (!im->s->failed && c->part.len && c->part.len != n)
    scan_error(im->s, "parts for %zu of %zu cells", c->part.len, n);
  if (!im->s->failed) {
    import_reserve_nodes(im, c->point.len / 3);
    for (size_t i = 0; i + 2 < c->point.len; i += 3) {
      Vec3 x = {c->point.data[i], c->point.data[i + 1], c->point.data[i + 2]};
      if (!isfinite(x.x + x.y + x.z)) scan_error(im->s, "point %zu is not finite", i / 3);
      import_node(im, i / 3, x, -1, 0, NAN);
    }
  }
  for (size_t i = 0; i < n && !im->s->failed; i++) import_cell(c, im, i);
  cells_free(c);
}
