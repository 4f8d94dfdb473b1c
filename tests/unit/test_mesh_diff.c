// test_mesh_diff.c - comparison: the same up to numbering, moved, changed, groups added, lost and renamed
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>
#include <unistd.h>

#include "mesh/mesh_diff.h"
#include "out/formats.h"

#include "mesh_sample.h"

// The same mesh with its nodes numbered the other way round.
static Mesh *renumbered(size_t n)
{
  Mesh *m = sample_mesh(n, true, true);
  size_t last = m->nnode - 1;
  for (size_t i = 0; i <= last / 2; i++) {
    for (size_t k = 0; k < 3; k++) {
      double t = m->xyz[3 * i + k];
      m->xyz[3 * i + k] = m->xyz[3 * (last - i) + k];
      m->xyz[3 * (last - i) + k] = t;
    }
    uint32_t e = m->node_entity[i];
    m->node_entity[i] = m->node_entity[last - i];
    m->node_entity[last - i] = e;
  }
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; i < m->block[b].n * (size_t)elem_nodes(m->block[b].type); i++)
      m->block[b].node[i] = (uint32_t)last - m->block[b].node[i];
  return m;
}

static void the_same_up_to_numbering(void **state)
{
  (void)state;
  Mesh *a = sample_mesh(5, true, true), *b = renumbered(5);
  MeshDiff d;
  mesh_diff_make(&d, a, b, 0);
  assert_int_equal(d.verdict, DIFF_SAME);
  assert_int_equal(d.nchanged[0] + d.nchanged[1] + d.entity.len + d.group.len, 0);
  mesh_diff_free(&d);
  mesh_free(a);
  mesh_free(b);
}

static void one_node_moved(void **state)
{
  (void)state;
  for (int how = 0; how < 3; how++) { // by number; renumbered and near; renumbered and not within the tolerance
    Mesh *a = sample_mesh(5, true, true), *b = how ? renumbered(5) : sample_mesh(5, true, true);
    uint32_t v = 0;
    while (b->node_entity[v] != 13) v++;
    b->xyz[3 * (size_t)v] += 1e-6;
    MeshDiff d;
    mesh_diff_make(&d, a, b, how == 2 ? 1e-7 : 1e-5);
    assert_int_equal(d.verdict, how == 2 ? DIFF_DIFFERENT : DIFF_WITHIN);
    assert_int_equal(d.nchanged[0], d.nchanged[1]);
    assert_true(d.nchanged[0] > 0);
    assert_int_equal(d.entity.len, 1);
    assert_int_equal(d.entity.data[0].tag, 1);
    assert_int_equal(d.alone[0], how == 2);
    assert_int_equal(d.moved, how < 2);
    if (how < 2) assert_true(fabs(d.largest - 1e-6) < 1e-12 && d.moved_dim == 2 && d.moved_tag == 1);
    mesh_diff_free(&d);
    mesh_free(a);
    mesh_free(b);
  }
}

static void groups(void **state)
{
  (void)state;
  Mesh *a = sample_mesh(4, true, false), *b = sample_mesh(4, true, false);
  // b: "wall" is renamed, "inlet" has tag 50, "right" is gone and "outlet" is new
  free(b->group[1].name);
  b->group[1].name = mem_strdup("WALL");
  b->group[3].tag = 50;
  b->entity[11].physical.data[0] = 50;
  b->group[6].tag = 77;
  free(b->group[6].name);
  b->group[6].name = mem_strdup("outlet");
  b->entity[14].physical.data[0] = 77;
  MeshDiff d;
  mesh_diff_make(&d, a, b, 0);
  assert_int_equal(d.verdict, DIFF_DIFFERENT);
  assert_int_equal(d.nchanged[0], 0);
  static const GroupChange want[] = {GROUP_RENAMED, GROUP_RETAGGED, GROUP_LOST, GROUP_ADDED};
  assert_int_equal(d.group.len, 4);
  for (size_t i = 0; i < 4; i++) assert_int_equal(d.group.data[i].change, want[i]);
  assert_string_equal(d.group.data[3].name[1], "outlet");
  mesh_diff_free(&d);
  mesh_free(a);
  mesh_free(b);
}

static void pictures_of_differences(void **state)
{
  (void)state;
  Mesh *a = sample_mesh(6, true, false), *b = sample_mesh(6, true, false);
  uint32_t v = 0;
  while (b->node_entity[v] != 13) v++;
  b->xyz[3 * (size_t)v] += 0.02;
  MeshDiff d;
  Diag *diag = diag_new(true);
  mesh_diff_make(&d, a, b, 0);
  const char *dir = getenv("SCRATCH");
  static const char *const ext[] = {"png", "svg", "pdf"};
  for (size_t i = 0; i < 3; i++) {
    char path[300];
    snprintf(path, sizeof path, "%s/diff.%s", dir ? dir : "/tmp", ext[i]);
    assert_int_equal(out_write_diff(a, b, &d, path, &(OutOptions){0}, diag), EXIT_GOOD);
    assert_int_equal(access(path, R_OK), 0);
    if (dir || i) unlink(path);
  }
  mesh_diff_free(&d);
  diag_free(diag);
  mesh_free(a);
  mesh_free(b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_same_up_to_numbering),
      cmocka_unit_test(one_node_moved),
      cmocka_unit_test(groups),
      cmocka_unit_test(pictures_of_differences),
  };
  return unit_run(tests);
}
