// mesh_sample.h - a mesh made by hand for tests: two square faces that share a curve, with groups
// SPDX-License-Identifier: MIT
//
//      4---5---6---5---3     points 1..6, curves 1..7 (7 is the interface 5-6), faces 1 (left) and 2 (right);
//   6  |   1   7   2   | 3   face 2 is of quadrangles if asked for. Interior nodes are displaced a little, by a
//      1---1---5---2---2     fixed generator, so that coordinates have all their digits.
#ifndef MESH_SAMPLE_H
#define MESH_SAMPLE_H

#include "base/base.h"
#include "base/rng.h"
#include "mesh/mesh.h"

// Node of grid position (i, j), 0 <= i <= 2n, 0 <= j <= n, as numbered by sample_mesh.
typedef struct {
  uint32_t *at;
  size_t n;
} SampleGrid;

static inline uint32_t *sample_at(SampleGrid *g, size_t i, size_t j) { return &g->at[j * (2 * g->n + 1) + i]; }

static inline void sample_node(Mesh *m, SampleGrid *g, size_t i, size_t j, uint32_t entity, double u, Rng *rng)
{
  double h = 1.0 / (double)g->n, x = (double)i * h, y = (double)j * h;
  if (rng) {
    x += 0.2 * h * (rng_double(rng) - 0.5);
    y += 0.2 * h * (rng_double(rng) - 0.5);
  }
  *sample_at(g, i, j) = mesh_add_node(m, (Vec3){x, y, 0}, entity, u);
}

static inline void sample_entity(Mesh *m, int dim, int tag, int phys, const int *boundary, size_t nboundary, Vec3 lo, Vec3 hi)
{
  uint32_t index = mesh_add_entity(m, dim, tag);
  MeshEntity *e = &m->entity[index];
  if (phys) vec_push(&e->physical, phys);
  for (size_t i = 0; i < nboundary; i++) vec_push(&e->boundary, boundary[i]);
  e->lo = lo;
  e->hi = hi;
}

static inline void sample_entities(Mesh *m, bool groups)
{
  static const double p[6][2] = {{0, 0}, {2, 0}, {2, 1}, {0, 1}, {1, 0}, {1, 1}};
  static const int ends[7][2] = {{1, 5}, {5, 2}, {2, 3}, {3, 6}, {6, 4}, {4, 1}, {5, 6}};
  static const int loop[2][4] = {{1, 7, 5, 6}, {2, 3, 4, -7}};
  static const int curve_group[7] = {3, 3, -4, 0, 0, 5, 6};
  for (int i = 0; i < 6; i++) {
    Vec3 x = {p[i][0], p[i][1], 0};
    sample_entity(m, 0, i + 1, groups && i == 0 ? 9 : 0, NULL, 0, x, x);
  }
  for (int i = 0; i < 7; i++) {
    const double *a = p[ends[i][0] - 1], *b = p[ends[i][1] - 1];
    sample_entity(m, 1, i + 1, groups ? curve_group[i] : 0, (int[]){ends[i][0], -ends[i][1]}, 2,
                  (Vec3){fmin(a[0], b[0]), fmin(a[1], b[1]), 0}, (Vec3){fmax(a[0], b[0]), fmax(a[1], b[1]), 0});
  }
  for (int f = 0; f < 2; f++)
    sample_entity(m, 2, f + 1, groups ? f + 1 : 0, loop[f], 4, (Vec3){f, 0, 0}, (Vec3){f + 1, 1, 0});
  if (!groups) return;
  vec_push(&m->entity[13].physical, 7); // face 1 is in two groups
  mesh_add_group(m, 0, 9, "corner");
  mesh_add_group(m, 1, 3, "wall");
  mesh_add_group(m, 1, 4, NULL);
  mesh_add_group(m, 1, 5, "inlet");
  mesh_add_group(m, 1, 6, "the interface");
  mesh_add_group(m, 2, 1, "left side");
  mesh_add_group(m, 2, 2, "right");
  mesh_add_group(m, 2, 7, "also left");
}

static inline void sample_elements(Mesh *m, SampleGrid *g, bool quads)
{
  size_t n = g->n;
  // Begin of each curve on the grid, and its direction.
  const size_t from[7][2] = {{0, 0}, {n, 0}, {2 * n, 0}, {2 * n, n}, {n, n}, {0, n}, {n, 0}};
  static const int step[7][2] = {{1, 0}, {1, 0}, {0, 1}, {-1, 0}, {-1, 0}, {0, -1}, {0, 1}};
  static const size_t corner[6][2] = {{0, 0}, {2, 0}, {2, 1}, {0, 1}, {1, 0}, {1, 1}};
  for (uint32_t e = 0; e < 6; e++) {
    uint32_t b = mesh_add_block(m, e, ELEM_POINT, 1);
    m->block[b].node[0] = *sample_at(g, corner[e][0] * n, corner[e][1] * n);
  }
  for (uint32_t c = 0; c < 7; c++) {
    uint32_t b = mesh_add_block(m, 6 + c, ELEM_LINE2, n), *v = m->block[b].node;
    for (size_t k = 0; k < n; k++)
      for (size_t s = 0; s < 2; s++)
        *v++ = *sample_at(g, (size_t)((int)from[c][0] + step[c][0] * (int)(k + s)),
                          (size_t)((int)from[c][1] + step[c][1] * (int)(k + s)));
  }
  for (uint32_t f = 0; f < 2; f++) {
    bool quad = quads && f == 1;
    uint32_t block = mesh_add_block(m, 13 + f, quad ? ELEM_QUAD4 : ELEM_TRI3, quad ? n * n : 2 * n * n);
    uint32_t *v = m->block[block].node;
    for (size_t j = 0; j < n; j++)
      for (size_t i = f * n; i < (f + 1) * n; i++) {
        uint32_t a = *sample_at(g, i, j), b = *sample_at(g, i + 1, j), c = *sample_at(g, i + 1, j + 1),
                 d = *sample_at(g, i, j + 1);
        const uint32_t q[4] = {a, b, c, d}, t[6] = {a, b, c, a, c, d};
        memcpy(v, quad ? q : t, (quad ? 4 : 6) * sizeof *v);
        v += quad ? 4 : 6;
      }
  }
}

// n >= 1 cells along each side of a face: 4 n^2 triangles, or 2 n^2 and n^2 quadrangles.
static inline Mesh *sample_mesh(size_t n, bool groups, bool quads)
{
  static const size_t corner[6][2] = {{0, 0}, {2, 0}, {2, 1}, {0, 1}, {1, 0}, {1, 1}};
  Mesh *m = mesh_new();
  SampleGrid g = {mem_alloc((2 * n + 1) * (n + 1) * sizeof(uint32_t)), n};
  Rng rng = {7};
  sample_entities(m, groups);
  for (uint32_t e = 0; e < 6; e++) sample_node(m, &g, corner[e][0] * n, corner[e][1] * n, e, NAN, NULL);
  for (size_t k = 1; k < n; k++) sample_node(m, &g, k, 0, 6, (double)k / (double)n, NULL);
  for (size_t k = 1; k < n; k++) sample_node(m, &g, n + k, 0, 7, (double)k / (double)n, NULL);
  for (size_t k = 1; k < n; k++) sample_node(m, &g, 2 * n, k, 8, (double)k / (double)n, NULL);
  for (size_t k = n - 1; k > 0; k--) sample_node(m, &g, n + k, n, 9, (double)(n - k) / (double)n, NULL);
  for (size_t k = n - 1; k > 0; k--) sample_node(m, &g, k, n, 10, (double)(n - k) / (double)n, NULL);
  for (size_t k = n - 1; k > 0; k--) sample_node(m, &g, 0, k, 11, (double)(n - k) / (double)n, NULL);
  for (size_t k = 1; k < n; k++) sample_node(m, &g, n, k, 12, (double)k / (double)n, NULL);
  for (uint32_t f = 0; f < 2; f++)
    for (size_t j = 1; j < n; j++)
      for (size_t i = f * n + 1; i < (f + 1) * n; i++) sample_node(m, &g, i, j, 13 + f, NAN, &rng);
  sample_elements(m, &g, quads);
  free(g.at);
  return m;
}

#endif
