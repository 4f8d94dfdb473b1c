// point_sets.h - the point sets on which triangulations are timed
// SPDX-License-Identifier: MIT
#ifndef BENCH_POINT_SETS_H
#define BENCH_POINT_SETS_H

#include "base/base.h"

#include <math.h>

#include "base/rng.h"

enum { POINT_SETS = 7 };
static const char *const point_set_names[POINT_SETS] = {"uniform", "clusters", "grid i/999", "integer grid", "circle",
                                                        "line and one beside", "spiral"};

// n points of set s into xy[2n], in an order as drawn (the grids: by rows).
static inline void point_set_fill(int s, size_t n, double *xy)
{
  Rng r = {12345};
  size_t side = (size_t)ceil(sqrt((double)n));
  for (size_t i = 0; i < n; i++) {
    double *q = xy + 2 * i, u = rng_double(&r), v = rng_double(&r), a = 6.283185307179586 * u;
    double radius = 0.01 * sqrt(-2 * log(1 - v));
    size_t c = i % 100;
    double k = (double)i / (double)n;
    switch (s) {
    case 0: q[0] = u, q[1] = v; break;
    case 1: // 100 Gaussian clusters of sizes 1 : 100
      q[0] = fmod(0.7548776662466927 * (double)c, 1) + radius * cos(a) / (double)(c + 1);
      q[1] = fmod(0.5698402909980532 * (double)c, 1) + radius * sin(a) / (double)(c + 1);
      break;
    case 2: q[0] = (double)(i % side) / (double)(side - 1), q[1] = (double)(i / side) / (double)(side - 1); break;
    case 3: q[0] = (double)(i % side), q[1] = (double)(i / side); break;
    case 4: q[0] = cos(a), q[1] = sin(a); break;
    case 5: q[0] = i == 0 ? 0.5 : u, q[1] = i == 0 ? 1 : 0; break;
    case 6: a = 2 * 3.141592653589793 * sqrt((double)n) * 0.5 * sqrt(k), q[0] = sqrt(k) * cos(a), q[1] = sqrt(k) * sin(a); break;
    }
  }
}

#endif
