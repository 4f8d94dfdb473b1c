// grid.h - structured meshes on plain arrays: transfinite interpolation, cell patterns, elliptic smoothing
// SPDX-License-Identifier: MIT
//
// A grid has nu x nv cells and (nu+1)(nv+1) nodes; node (i, j) is entry i*(nv+1) + j.
//
//   s4 --- top ---> s3     i runs from s1 to s2, j from s2 to s3. A grid with three corners is one whose side i = 0 is the
//   ^               ^      single point s1 (then s4 = s1, and the nodes (0, j) are all that point).
//  left   cells   right
//   |               |      A triangular grid (grid_triangle) has n steps on each side; node (i, j), 0 <= j <= i <= n, is
//   s1 -- bottom -> s2     entry i*(n+1) + j: row i is parallel to the side from s2 to s3, and s1 is row 0.
#ifndef MESH_GRID_H
#define MESH_GRID_H

#include "base/base.h"
#include "geom/vec.h"
#include "model/model.h"

// The four sides as arrays of nu+1 (bottom, top) and nv+1 (right, left) points. With three corners `left` may be NULL.
typedef struct {
  size_t nu, nv;
  const Vec3 *bottom, *right, *top, *left;
} GridSides;

// Accumulated lengths of a polygon of n+1 points, divided by the total: w[0] = 0, w[n] = 1 (k/n if the total is 0).
void grid_lengths(const Vec3 *p, size_t n, double *w);
// The same of the average of two polygons.
void grid_mean_lengths(const Vec3 *p, const Vec3 *q, size_t n, double *w);

// Coons interpolation: the boundary blended by the weights u[0..nu] and v[0..nv], into node[(nu+1)*(nv+1)]. The sides are
// copied bit for bit; an affine map of the sides maps the grid. O(nodes). [Gordon73]
void grid_coons(const GridSides *s, const double *u, const double *v, Vec3 *node);
// The same on a triangular grid from sides of n+1 points: s1 to s2, s2 to s3, s1 to s3; into node[(n+1)*(n+1)], of which
// (i, j) with j <= i are set. [Perronnet98]
void grid_triangle(size_t n, const Vec3 *s12, const Vec3 *s23, const Vec3 *s13, Vec3 *node);

// Gauss-Seidel sweeps of the elliptic grid equations (Winslow): interior nodes move so that both families of lines become
// harmonic functions of the place [Winslow66]. O(passes * nodes).
void grid_smooth(size_t nu, size_t nv, Vec3 *node, int passes);

// The cells of a grid whose nodes have the ids id[], laid out as the nodes are.
typedef struct {
  size_t nu, nv;
  const uint32_t *id;
  TransfiniteArrangement how;  // of the diagonals
  bool fan;                    // three corners: the cells of i = 0 are one triangle each
  bool mirror;                 // every element is turned over; else counter-clockwise when s1, s2, s3 are
} GridCells;
// To triangles, 6 ids a cell, in the order (i, j) with j fastest, or to quadrangles, 4 ids. The triangles of a fan come first: in
// tri[] also when the others are quadrangles. Number of elements returned.
size_t grid_triangles(const GridCells *g, uint32_t *tri);
size_t grid_quads(const GridCells *g, uint32_t *tri, size_t *ntri, uint32_t *quad);
// The n*n triangles of a triangular grid.
size_t grid_triangle_cells(size_t n, const uint32_t *id, bool mirror, uint32_t *tri);

#endif
