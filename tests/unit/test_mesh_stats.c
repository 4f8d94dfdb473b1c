// test_mesh_stats.c - the numbers of the report, against values known by hand
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>

#include "mesh/mesh_measure.h"
#include "mesh/mesh_shapes.h"
#include "mesh/mesh_stats.h"

#include "mesh_sample.h"

#define assert_near(a, b, tol) assert_true(fabs((a) - (b)) <= (tol))

static void counts_and_sizes_by_group(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(4, true, true);
  MeshStats s;
  mesh_stats_make(&s, m, NULL);
  assert_int_equal(s.triangles, 32);
  assert_int_equal(s.quads, 16);
  assert_int_equal(s.lines, 28);
  assert_int_equal(s.points, 6);
  assert_int_equal(s.nodes, 45);
  assert_near(s.area, 2, 1e-14);
  assert_near(s.length, 7, 1e-14);
  assert_int_equal(s.group.len, 8);
  const PartStats *wall = &s.group.data[1], *left = &s.group.data[5];
  assert_string_equal(wall->name, "wall");
  assert_int_equal(wall->elements, 8);
  assert_int_equal(wall->entities, 2);
  assert_near(wall->size, 2, 1e-14);
  assert_int_equal(left->elements, 32);
  assert_near(left->size, 1, 1e-14);
  assert_int_equal(s.entity.len, 15);
  assert_int_equal(s.gamma.n + s.eta.n, 48);
  assert_int_equal(s.angle.n, 48);
  size_t sum = 0;
  for (int i = 0; i < STATS_BINS; i++) sum += s.gamma.bin[i];
  assert_int_equal(sum, 32);
  assert_true(isnan(s.tau));
  assert_int_equal(s.nworst, 10);
  for (size_t i = 1; i < s.nworst; i++) assert_true(s.worst[i - 1].value <= s.worst[i].value);
  assert_true(s.worst[0].value == fmin(s.gamma.min, s.eta.min));
  mesh_stats_free(&s);
  mesh_free(m);
}

static Mesh *one_element(ElemType t, const double (*p)[2])
{
  Mesh *m = mesh_new();
  mesh_add_entity(m, 2, 1);
  uint32_t b = mesh_add_block(m, 0, t, 1);
  for (int i = 0; i < elem_corners(t); i++) m->block[b].node[i] = mesh_add_node(m, (Vec3){p[i][0], p[i][1], 0}, 0, NAN);
  return m;
}

// A rhombus of two triangles cut along its long or its short diagonal: opposite angles of 240 or of 120 degrees together.
static void shapes_and_the_maximum_principle(void **state)
{
  (void)state;
  const double r = sqrt(3);
  for (int cut = 0; cut < 2; cut++) {
    Mesh *m = mesh_new();
    mesh_add_entity(m, 2, 1);
    uint32_t b = mesh_add_block(m, 0, ELEM_TRI3, 2);
    const double p[4][2] = {{0, 0}, {r, -1}, {2 * r, 0}, {r, 1}};
    for (int i = 0; i < 4; i++) mesh_add_node(m, (Vec3){p[i][0], p[i][1], 0}, 0, NAN);
    memcpy(m->block[b].node, cut ? (uint32_t[]){0, 1, 3, 1, 2, 3} : (uint32_t[]){0, 1, 2, 0, 2, 3}, 6 * sizeof(uint32_t));
    MeshShapes s;
    mesh_shapes_make(&s, m);
    assert_int_equal(s.triangles, 2);
    assert_int_equal(s.inner_edges, 1);
    assert_int_equal(s.obtuse, cut ? 0 : 1);
    for (int i = 0; i < SHAPES && cut; i++) assert_near(s.min[i], 1, 1e-14); // equilateral
    if (!cut) assert_near(s.min[0], 1 / r, 1e-14);                            // 30 degrees
    if (!cut) assert_near(s.mean[3] * s.mean[3], s.mean[2], 1e-14);
    mesh_free(m);
  }
}

static void measures_of_known_shapes(void **state)
{
  (void)state;
  Mesh *m = one_element(ELEM_TRI3, (const double[][2]){{0, 0}, {2, 0}, {1, sqrt(3)}});
  assert_near(mesh_measure(m, m->block, 0, MEASURE_GAMMA), 1, 1e-15);
  assert_near(mesh_measure(m, m->block, 0, MEASURE_ANGLE), 60, 1e-13);
  double *size = (double[]){2, 2, 2};
  MeshStats s;
  mesh_stats_make(&s, m, size);
  assert_near(s.tau, 1, 1e-15);
  mesh_stats_free(&s);
  size = (double[]){4, 4, 4}; // every edge half of what is wanted: tau_e = -1/2
  mesh_stats_make(&s, m, size);
  assert_near(s.tau, exp(-0.5), 1e-15);
  mesh_stats_free(&s);
  size = (double[]){1, 1, 1}; // twice: 1/2 - 1
  mesh_stats_make(&s, m, size);
  assert_near(s.tau, exp(-0.5), 1e-15);
  mesh_stats_free(&s);
  mesh_free(m);

  // Scaled Jacobian: the sine of a parallelogram's angle, negative at a reentrant corner.
  m = one_element(ELEM_QUAD4, (const double[][2]){{0, 0}, {3, 0}, {4, 1}, {1, 1}});
  mesh_stats_make(&s, m, NULL);
  assert_int_equal(s.jacobian.n, 1);
  assert_near(s.jacobian.min, sqrt(0.5), 1e-15);
  mesh_stats_free(&s);
  mesh_free(m);
  m = one_element(ELEM_QUAD4, (const double[][2]){{0, 0}, {2, -1}, {1, 0}, {2, 1}});
  assert_near(mesh_scaled_jacobian(m, m->block, 0), -1, 1e-15);
  mesh_free(m);

  m = one_element(ELEM_TRI3, (const double[][2]){{0, 0}, {1, 0}, {0, 1}});
  mesh_stats_make(&s, m, NULL);
  assert_near(s.gamma.min, 4 * 0.5 / (1 + sqrt(2)), 1e-15); // 4 sin sin sin / sum of sines, at 90, 45, 45 degrees
  assert_near(s.angle.min, 45, 1e-13);
  assert_near(s.angle_max, 90, 1e-13);
  assert_near(s.edge_max, sqrt(2), 1e-15);
  mesh_stats_free(&s);
  mesh_free(m);

  m = one_element(ELEM_QUAD4, (const double[][2]){{0, 0}, {1, 0}, {1.5, 1}, {0.5, 1}});
  double least = atan2(1, 0.5) * 180 / 3.14159265358979323846;
  assert_near(mesh_measure(m, m->block, 0, MEASURE_ANGLE), least, 1e-13);
  assert_near(mesh_measure(m, m->block, 0, MEASURE_ETA), least / 90, 1e-14);
  mesh_free(m);
  m = one_element(ELEM_QUAD4, (const double[][2]){{0, 0}, {1, 0}, {0.2, 0.2}, {0, 1}}); // not convex
  assert_true(mesh_measure(m, m->block, 0, MEASURE_ETA) == 0);
  mesh_free(m);
}

// p5 against sorting, irregular nodes on a grid of which every interior node has six triangles.
static void distribution_and_valence(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(80, false, false);
  MeshStats s;
  mesh_stats_make(&s, m, NULL);
  assert_int_equal(s.irregular, 0);
  assert_int_equal(s.interior, 2 * 79 * 79);
  size_t below = 0, n = 0, bin[STATS_BINS] = {0};
  double sum = 0, angle = 180;
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; elem_dim(m->block[b].type) == 2 && i < m->block[b].n; i++, n++) {
      double g = mesh_measure(m, &m->block[b], i, MEASURE_GAMMA);
      below += g < s.gamma.p5;
      sum += g;
      double a = mesh_measure(m, &m->block[b], i, MEASURE_ANGLE);
      bin[(int)(a / 60 * STATS_BINS)]++;
      angle = fmin(angle, a);
    }
  assert_int_equal(below, (size_t)(0.05 * (double)(n - 1)));
  assert_near(s.gamma.mean, sum / (double)n, 1e-13);
  assert_near(s.angle.min, angle, 1e-12);
  for (int i = 0; i < STATS_BINS; i++) assert_int_equal(s.angle.bin[i], bin[i]);
  mesh_stats_free(&s);
  mesh_free(m);
  m = sample_mesh(3, false, true);
  mesh_stats_make(&s, m, NULL);
  assert_int_equal(s.irregular, 0);
  mesh_stats_free(&s);
  mesh_free(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(counts_and_sizes_by_group),
      cmocka_unit_test(shapes_and_the_maximum_principle),
      cmocka_unit_test(measures_of_known_shapes),
      cmocka_unit_test(distribution_and_valence),
  };
  return unit_run(tests);
}
