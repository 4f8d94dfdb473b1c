// test_mesh_check.c - the audit finds every kind of damage, where it is, and nothing in a good mesh
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>

#include "mesh/mesh_check.h"

#include "mesh_sample.h"

static void show(const MeshReport *r)
{
  char line[400];
  for (size_t i = 0; i < r->finding.len; i++) {
    mesh_finding_print(&r->finding.data[i], line, sizeof line);
    print_message("# %s%s\n", r->finding.data[i].warning ? "warning: " : "", line);
  }
}

static void good_meshes_pass(void **state)
{
  (void)state;
  for (int kind = 0; kind < 8; kind++) {
    Mesh *m = sample_mesh(1 + (size_t)kind, kind & 1, kind & 2);
    for (int strict = 0; strict < 2; strict++) {
      MeshReport r;
      bool good = mesh_check(m, strict, &r);
      if (!good || r.warnings) show(&r);
      assert_true(good);
      assert_int_equal(r.warnings, 0);
      mesh_report_free(&r);
    }
    mesh_free(m);
  }
}

// First node on an entity.
static uint32_t node_on(const Mesh *m, uint32_t entity)
{
  uint32_t i = 0;
  while (m->node_entity[i] != entity) i++;
  return i;
}

static uint32_t block_of(const Mesh *m, int dim, int tag)
{
  uint32_t e = mesh_find_entity(m, dim, tag), b = 0;
  while (m->block[b].entity != e) b++;
  return b;
}

// Check and demand errors of exactly this rule (RULE_COUNT: of none), and allow those of `also`, a bit mask.
static void expect(Mesh *m, bool strict, MeshRule rule, unsigned also, size_t count)
{
  MeshReport r;
  mesh_check(m, strict, &r);
  for (int k = 0; k < RULE_COUNT; k++) {
    bool fine = k == (int)rule ? (count ? r.count[k] == count : r.count[k] > 0) : r.count[k] == 0 || (also >> k & 1);
    if (!fine) {
      show(&r);
      fail_msg("rule %s: %zu findings (looking for %s)", mesh_rule_name((MeshRule)k), r.count[k], rule < RULE_COUNT ? mesh_rule_name(rule) : "none");
    }
  }
  mesh_report_free(&r);
  mesh_free(m);
}

static void indices(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(3, true, false);
  m->block[14].node[5] = (uint32_t)m->nnode;
  expect(m, true, RULE_INDEX, 0, 1);
  m = sample_mesh(3, true, false);
  m->node_entity[7] = 99;
  expect(m, false, RULE_INDEX, 0, 1);
}

static void coordinates(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(3, true, false);
  m->xyz[3 * 20] = NAN;
  expect(m, true, RULE_COORDINATE, 0, 1);
}

static void an_inverted_element(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(4, true, false);
  uint32_t v = node_on(m, 13);
  m->xyz[3 * (size_t)v] += 0.4; // beyond its neighbours
  expect(m, true, RULE_ORIENTATION, 0, 0);
}

static void a_flat_element(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(2, true, false);
  uint32_t v = node_on(m, 13);
  m->xyz[3 * (size_t)v] = 0; // onto the left side: two flat triangles, and a node within the boundary
  m->xyz[3 * (size_t)v + 1] = 0.25;
  MeshReport r;
  assert_false(mesh_check(m, true, &r));
  assert_true(r.count[RULE_DEGENERATE] > 0);
  mesh_report_free(&r);
  mesh_free(m);
}

static void a_concave_quadrangle(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(2, true, true);
  uint32_t v = node_on(m, 14);
  m->xyz[3 * (size_t)v] = 1.2;
  m->xyz[3 * (size_t)v + 1] = 0.2;
  MeshReport r;
  assert_false(mesh_check(m, true, &r));
  assert_int_equal(r.count[RULE_ORIENTATION], 1);
  assert_non_null(strstr(r.finding.data[0].text, "convex"));
  assert_int_equal(r.finding.data[0].tag, 2);
  mesh_report_free(&r);
  mesh_free(m);
}

static void nodes(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(3, true, false);
  mesh_add_node(m, (Vec3){0.123, 0.5, 0}, 13, NAN);
  expect(m, true, RULE_ORPHAN_NODE, 0, 1);
  // The right face gets its own copy of a node of the interface: it comes apart there.
  m = sample_mesh(3, true, false);
  uint32_t v = node_on(m, 12), copy = mesh_add_node(m, mesh_xyz(m, v), 14, NAN);
  uint32_t b = block_of(m, 2, 2);
  for (size_t i = 0; i < 3 * m->block[b].n; i++)
    if (m->block[b].node[i] == v) m->block[b].node[i] = copy;
  expect(m, true, RULE_DUPLICATE_NODE, 1u << RULE_LOST_EDGE | 1u << RULE_HOLE | 1u << RULE_EULER, 1);
}

static void an_element_twice(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(3, true, false);
  MeshBlock *k = &m->block[block_of(m, 2, 1)];
  memcpy(k->node + 3, k->node + 30, 3 * sizeof *k->node);
  expect(m, false, RULE_DUPLICATE_ELEMENT, 1u << RULE_EDGE | 1u << RULE_HOLE | 1u << RULE_LOST_EDGE | 1u << RULE_AREA, 1);
}

static void remove_element(Mesh *m, int tag, size_t i)
{
  MeshBlock *k = &m->block[block_of(m, 2, tag)];
  memmove(k->node + 3 * i, k->node + 3 * (i + 1), 3 * (k->n - i - 1) * sizeof *k->node);
  k->n--;
}

static void a_hole(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(5, true, false);
  remove_element(m, 1, 24); // in the middle
  expect(m, true, RULE_HOLE, 1u << RULE_AREA | 1u << RULE_EULER, 3);
  m = sample_mesh(5, false, false); // as read: every curve is known, so holes are found as well
  remove_element(m, 1, 24);
  expect(m, false, RULE_HOLE, 1u << RULE_AREA, 3);
}

static void a_lost_edge(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(4, true, false);
  vec_push(&m->entity[13].embedded, 3); // a curve that is not in face 1 at all
  expect(m, true, RULE_LOST_EDGE, 0, 4);
}

// A square of two triangles, and a curve from corner 2 to 4 that its loop runs along there and back.
static Mesh *square_with_slit(bool lost)
{
  static const double at[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  static const int end[5][2] = {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {2, 4}};
  Mesh *m = mesh_new();
  Vec3 lo = {0, 0, 0}, hi = {1, 1, 0};
  for (int i = 0; i < 4; i++) sample_entity(m, 0, i + 1, 0, NULL, 0, lo, hi);
  for (int i = 0; i < 5; i++) sample_entity(m, 1, i + 1, 0, (int[]){end[i][0], -end[i][1]}, 2, lo, hi);
  sample_entity(m, 2, 1, 0, (int[]){1, 5, -5, 2, 3, 4}, 6, lo, hi);
  for (uint32_t i = 0; i < 4; i++) mesh_add_node(m, (Vec3){at[i][0], at[i][1], 0}, i, NAN);
  for (uint32_t i = 0; i < 9; i++) {
    uint32_t b = mesh_add_block(m, i, i < 4 ? ELEM_POINT : ELEM_LINE2, 1);
    m->block[b].node[0] = i < 4 ? i : (uint32_t)end[i - 4][0] - 1;
    if (i >= 4) m->block[b].node[1] = (uint32_t)end[i - 4][1] - 1;
  }
  static const uint32_t along[6] = {0, 1, 3, 1, 2, 3}, across[6] = {0, 1, 2, 0, 2, 3};
  uint32_t b = mesh_add_block(m, 9, ELEM_TRI3, 2);
  memcpy(m->block[b].node, lost ? across : along, sizeof along);
  return m;
}

// What a loop runs along twice is a slit, or lies between two holes and is in no element.
static void a_lost_slit(void **state)
{
  (void)state;
  expect(square_with_slit(false), true, RULE_COUNT, 0, 0);
  expect(square_with_slit(true), true, RULE_LOST_EDGE, 0, 1);
  Mesh *m = sample_mesh(4, true, false);
  vec_push(&m->entity[13].boundary, 3); // beside face 1, for all that its elements tell
  vec_push(&m->entity[13].boundary, -3);
  vec_push(&m->entity[13].boundary, 7); // a side that is listed three times is a side
  vec_push(&m->entity[13].boundary, -7);
  expect(m, true, RULE_COUNT, 0, 0);
}

// The interface is coarser on the right: its nodes hang.
static void a_t_junction(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(1, false, false);
  // Halve the interface for face 1 only: its triangles are (1, 5, 6), (1, 6, 4).
  uint32_t v = mesh_add_node(m, (Vec3){1, 0.5, 0}, 13, NAN);
  MeshBlock *k = &m->block[block_of(m, 2, 1)];
  k->node = mem_realloc(k->node, 9 * sizeof *k->node);
  assert_int_equal(k->node[2], 5);
  k->node[2] = v;
  k->node[6] = k->node[0];
  k->node[7] = v;
  k->node[8] = 5;
  k->n = 3;
  expect(m, false, RULE_T_JUNCTION, 1u << RULE_HOLE | 1u << RULE_LOST_EDGE, 1);
}

static void classification(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(3, true, false);
  m->node_entity[node_on(m, 13)] = 14;
  expect(m, true, RULE_CLASSIFICATION, 0, 0);
}

static void groups(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(3, true, false);
  vec_push(&m->entity[13].physical, 88);
  expect(m, true, RULE_GROUP, 0, 1);
  m = sample_mesh(3, true, false);
  mesh_add_group(m, 2, 89, "right");
  expect(m, true, RULE_GROUP, 0, 2); // named twice, and empty
}

static void periodic(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(3, false, false);
  MeshPeriodic *p = mesh_add_periodic(m, 1, 3, 6);
  p->has_affine = true;
  for (int i = 0; i < 16; i++) p->affine[i] = i % 5 == 0;
  p->affine[3] = 2.5; // should be 2
  vec_push(&p->slave_node, 1);
  vec_push(&p->master_node, 0);
  expect(m, true, RULE_PERIODIC, 0, 1);
}

// Faces in any plane are judged the same.
static void turned_in_space(void **state)
{
  (void)state;
  static const double axes[4][6] = {{1, 0, 0, 0, 0, 1}, {0, 1, 0, 0, 0, 1}, {0.6, 0.8, 0, -0.48, 0.36, 0.8}, {0, 0, 1, 1, 0, 0}};
  for (int t = 0; t < 4; t++)
    for (int damage = 0; damage < 2; damage++) {
      Mesh *m = sample_mesh(4, false, false);
      if (damage) m->xyz[3 * (size_t)node_on(m, 13)] += 0.4;
      for (size_t i = 0; i < m->nnode; i++) {
        double x = m->xyz[3 * i], y = m->xyz[3 * i + 1];
        for (int k = 0; k < 3; k++) m->xyz[3 * i + (size_t)k] = x * axes[t][k] + y * axes[t][3 + k];
      }
      for (size_t e = 0; e < m->nentity; e++) { // boxes that say nothing
        m->entity[e].lo = (Vec3){-9, -9, -9};
        m->entity[e].hi = (Vec3){9, 9, 9};
      }
      MeshReport r;
      assert_true(mesh_check(m, true, &r) == !damage);
      assert_true(!damage || r.count[RULE_ORIENTATION] > 0);
      mesh_report_free(&r);
      mesh_free(m);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(good_meshes_pass), cmocka_unit_test(indices),          cmocka_unit_test(coordinates),
      cmocka_unit_test(an_inverted_element), cmocka_unit_test(a_flat_element), cmocka_unit_test(a_concave_quadrangle),
      cmocka_unit_test(nodes),            cmocka_unit_test(an_element_twice), cmocka_unit_test(a_hole),
      cmocka_unit_test(a_lost_edge),      cmocka_unit_test(a_t_junction),     cmocka_unit_test(classification),
      cmocka_unit_test(groups),           cmocka_unit_test(a_lost_slit),      cmocka_unit_test(periodic),         cmocka_unit_test(turned_in_space),
  };
  return unit_run(tests);
}
