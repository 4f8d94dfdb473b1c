// test_grid.c - transfinite interpolation, cell patterns, elliptic smoothing
// SPDX-License-Identifier: MIT
#include "unit.h"

#include "base/mem.h"
#include "base/rng.h"
#include "mesh/grid.h"

enum { NU = 7, NV = 5 };

static Vec3 warp(double x, double y) // a smooth one-to-one map of the unit square
{
  return (Vec3){x + 0.2 * sin(2 * y), y + 0.15 * x * x, 0.1 * x * y};
}

typedef struct {
  Vec3 bottom[NU + 1], top[NU + 1], right[NV + 1], left[NV + 1];
} Sides;

static GridSides sides_of(Sides *s, Vec3 (*map)(double, double))
{
  for (int i = 0; i <= NU; i++) {
    s->bottom[i] = map(i / (double)NU, 0);
    s->top[i] = map(i / (double)NU, 1);
  }
  for (int j = 0; j <= NV; j++) {
    s->right[j] = map(1, j / (double)NV);
    s->left[j] = map(0, j / (double)NV);
  }
  return (GridSides){NU, NV, s->bottom, s->right, s->top, s->left};
}

static Vec3 shear(double x, double y) { return (Vec3){3 * x + y, 2 * y - x, 0.5 * x}; }

static void coons_reproduces_affine_maps_and_its_boundary(void **state)
{
  (void)state;
  Sides s;
  GridSides g = sides_of(&s, shear);
  double u[NU + 1], v[NV + 1];
  Vec3 node[(NU + 1) * (NV + 1)];
  grid_lengths(s.bottom, NU, u);
  grid_mean_lengths(s.left, s.right, NV, v);
  grid_coons(&g, u, v, node);
  for (int i = 0; i <= NU; i++)
    for (int j = 0; j <= NV; j++)
      assert_true(vec3_distance(node[i * (NV + 1) + j], shear(i / (double)NU, j / (double)NV)) < 1e-14);
  g = sides_of(&s, warp);
  grid_coons(&g, u, v, node);
  for (int i = 0; i <= NU; i++) {
    assert_memory_equal(&node[i * (NV + 1)], &s.bottom[i], sizeof(Vec3));
    assert_memory_equal(&node[i * (NV + 1) + NV], &s.top[i], sizeof(Vec3));
  }
  for (int j = 0; j <= NV; j++) assert_memory_equal(&node[NU * (NV + 1) + j], &s.right[j], sizeof(Vec3));
}

static void triangular_grid_reproduces_affine_maps(void **state)
{
  (void)state;
  enum { N = 6 };
  Vec3 a[N + 1], b[N + 1], c[N + 1], node[(N + 1) * (N + 1)];
  for (int k = 0; k <= N; k++) {
    a[k] = shear(k / (double)N, 0);
    c[k] = shear(k / (double)N, k / (double)N);
    b[k] = shear(1, k / (double)N);
  }
  grid_triangle(N, a, b, c, node);
  for (int i = 0; i <= N; i++)
    for (int j = 0; j <= i; j++)
      assert_true(vec3_distance(node[i * (N + 1) + j], shear(i / (double)N, j / (double)N)) < 1e-13);
}

// Sum of signed areas of triangles with ids into a flat grid.
static double area_of(const uint32_t *tri, size_t n, const Vec3 *p, int *negative)
{
  double sum = 0;
  for (size_t k = 0; k < n; k++) {
    Vec3 a = p[tri[3 * k]], b = p[tri[3 * k + 1]], c = p[tri[3 * k + 2]];
    double area = 0.5 * vec3_cross(vec3_sub(b, a), vec3_sub(c, a)).z;
    sum += area;
    *negative += area <= 0;
  }
  return sum;
}

static void cells_cover_the_square_in_every_arrangement(void **state)
{
  (void)state;
  uint32_t id[(NU + 1) * (NV + 1)], tri[6 * NU * NV];
  Vec3 p[(NU + 1) * (NV + 1)];
  for (uint32_t k = 0; k < ARRAY_LEN(id); k++) {
    id[k] = k;
    p[k] = (Vec3){(double)(k / (NV + 1)), (double)(k % (NV + 1)), 0};
  }
  for (int how = ARRANGE_LEFT; how <= ARRANGE_ALTERNATE_LEFT; how++) {
    int negative = 0;
    assert_int_equal(grid_triangles(&(GridCells){NU, NV, id, (TransfiniteArrangement)how, false, false}, tri), 2 * NU * NV);
    assert_true(fabs(area_of(tri, 2 * NU * NV, p, &negative) - NU * NV) < 1e-12);
    assert_int_equal(negative, 0);
    grid_triangles(&(GridCells){NU, NV, id, (TransfiniteArrangement)how, false, true}, tri);
    assert_true(fabs(area_of(tri, 2 * NU * NV, p, &negative) + NU * NV) < 1e-12);
    assert_int_equal(negative, 2 * NU * NV);
  }
  // Left: the diagonal joins the second and the fourth corner of the cell.
  grid_triangles(&(GridCells){NU, NV, id, ARRANGE_LEFT, false, false}, tri);
  const uint32_t left[6] = {0, NV + 1, 1, 1, NV + 1, NV + 2};
  assert_memory_equal(tri, left, sizeof left);
  grid_triangles(&(GridCells){NU, NV, id, ARRANGE_RIGHT, false, false}, tri);
  const uint32_t right[6] = {0, NV + 1, NV + 2, NV + 2, 1, 0};
  assert_memory_equal(tri, right, sizeof right);
}

static void three_corners_make_a_fan(void **state)
{
  (void)state;
  uint32_t id[(NU + 1) * (NV + 1)], tri[6 * NU * NV], quad[4 * NU * NV];
  for (uint32_t k = 0; k < ARRAY_LEN(id); k++) id[k] = k <= NV ? 0 : k;
  assert_int_equal(grid_triangles(&(GridCells){NU, NV, id, ARRANGE_LEFT, true, false}, tri), NV + 2 * (NU - 1) * NV);
  for (int j = 0; j < NV; j++) assert_int_equal(tri[3 * j], 0);
  size_t ntri;
  assert_int_equal(grid_quads(&(GridCells){NU, NV, id, .fan = true}, tri, &ntri, quad), (NU - 1) * NV);
  assert_int_equal(ntri, NV);
  assert_int_equal(grid_triangle_cells(4, id, false, tri), 16);
}

// A grid that is conformal already is a fixed point; a disturbed one comes back to it.
static void smoothing_converges_to_the_conformal_grid(void **state)
{
  (void)state;
  enum { N = 12 };
  Vec3 node[(N + 1) * (N + 1)], exact[(N + 1) * (N + 1)];
  Rng r = {7};
  for (int i = 0; i <= N; i++)
    for (int j = 0; j <= N; j++) {
      bool inside = i > 0 && i < N && j > 0 && j < N;
      Vec3 p = {i / (double)N, j / (double)N, 0};
      exact[i * (N + 1) + j] = p;
      if (inside) p = vec3_add(p, (Vec3){0.03 * (rng_double(&r) - 0.5), 0.03 * (rng_double(&r) - 0.5), 0});
      node[i * (N + 1) + j] = p;
    }
  grid_smooth(N, N, node, 400);
  for (size_t k = 0; k < ARRAY_LEN(node); k++) assert_true(vec3_distance(node[k], exact[k]) < 1e-10);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(coons_reproduces_affine_maps_and_its_boundary),
      cmocka_unit_test(triangular_grid_reproduces_affine_maps),
      cmocka_unit_test(cells_cover_the_square_in_every_arrangement),
      cmocka_unit_test(three_corners_make_a_fan),
      cmocka_unit_test(smoothing_converges_to_the_conformal_grid),
  };
  return unit_run(tests);
}
