// quad_meshes.h - triangle meshes of the unit square for tests and benches of quads: hexagonal, jittered, graded
// SPDX-License-Identifier: MIT
#ifndef QUAD_MESHES_H
#define QUAD_MESHES_H

#include "base/base.h"
#include "base/mem.h"
#include "base/rng.h"

#include <string.h>

typedef struct {
  DoubleVec xy;
  U32Vec tri;
} LatticeMesh;

// Rows of nearly equilateral triangles over the unit square: `rows` rows of about as many columns, odd rows shifted by half a
// column, their end triangles halved, as in the interior of a frontal mesh of the square. Interior points move by up to
// `jitter` of an edge; x is bent by `grade` (0: uniform). Counterclockwise.
static inline LatticeMesh lattice_mesh(uint32_t rows, double jitter, double grade, uint64_t seed)
{
  LatticeMesh m;
  memset(&m, 0, sizeof m);
  Rng rng = {seed};
  uint32_t cols = (uint32_t)((double)rows * 0.8660254 + 0.5), first[2] = {0, 0};
  cols = cols < 2 ? 2 : cols;
  double dx = 1.0 / cols, dy = 1.0 / rows;
  for (uint32_t r = 0; r <= rows; r++) {
    uint32_t odd = r % 2, here = (uint32_t)(m.xy.len / 2), n = cols + 1 + odd;
    for (uint32_t i = 0; i < n; i++) {
      double x = odd ? (i == 0 ? 0 : i == n - 1 ? 1 : (i - 0.5) * dx) : i * dx, y = r * dy;
      bool inside = r > 0 && r < rows && i > 0 && i < n - 1;
      x += inside ? jitter * dx * (2 * rng_double(&rng) - 1) : 0;
      y += inside ? jitter * dy * (2 * rng_double(&rng) - 1) : 0;
      vec_push(&m.xy, x + grade * x * (1 - x));
      vec_push(&m.xy, y);
    }
    uint32_t low = first[1 - odd], up = here;
    if (r > 0) {
      // The even row has one vertex less; walk along both.
      uint32_t a = odd ? low : up, b = odd ? up : low; // a: even row, b: odd row
      for (uint32_t i = 0; i <= cols; i++) {
        uint32_t t[2][3] = {{a + i, b + i + 1, b + i}, {a + i, a + i + 1, b + i + 1}};
        for (int k = 0; k < (i < cols ? 2 : 1); k++)
          for (int j = 0; j < 3; j++) vec_push(&m.tri, t[k][j]);
      }
    }
    first[odd] = here;
  }
  // Orientation by area, so that the walk above need not care.
  for (size_t t = 0; t < m.tri.len; t += 3) {
    const double *p = m.xy.data + 2 * (size_t)m.tri.data[t], *q = m.xy.data + 2 * (size_t)m.tri.data[t + 1];
    const double *s = m.xy.data + 2 * (size_t)m.tri.data[t + 2];
    if ((q[0] - p[0]) * (s[1] - p[1]) < (q[1] - p[1]) * (s[0] - p[0])) {
      uint32_t v = m.tri.data[t + 1];
      m.tri.data[t + 1] = m.tri.data[t + 2];
      m.tri.data[t + 2] = v;
    }
  }
  return m;
}

static inline void lattice_free(LatticeMesh *m)
{
  vec_free(&m->xy);
  vec_free(&m->tri);
}

#endif
