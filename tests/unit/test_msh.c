// test_msh.c - MSH files: what is written is read back the same, and malformed files are refused
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>
#include <unistd.h>

#include "base/file.h"
#include "base/rng.h"
#include "mesh/element.h"
#include "mesh/mesh_hash.h"
#include "out/formats.h"

#include "mesh_sample.h"

static const char *scratch(char *buf, size_t cap, const char *name)
{
  const char *dir = getenv("SCRATCH");
  snprintf(buf, cap, "%s/msh-%s", dir ? dir : "/tmp", name);
  return buf;
}

static char *written(const Mesh *m, const char *format, const OutOptions *o, size_t *len)
{
  char path[300];
  Diag *d = diag_new(true);
  assert_int_equal(out_write(m, scratch(path, sizeof path, format), format, o, d), EXIT_GOOD);
  diag_free(d);
  char *text = file_read(path, len);
  assert_non_null(text);
  unlink(path);
  return text;
}

static Mesh *round_trip(const Mesh *m, const char *format, const OutOptions *o)
{
  size_t len;
  char *text = written(m, format, o, &len);
  Diag *d = diag_new(true);
  Mesh *back = out_read_memory(text, len, "a.msh", NULL, d);
  assert_non_null(back);
  assert_int_equal(diag_count(d), 0);
  diag_free(d);
  free(text);
  return back;
}

static void assert_hash(const uint64_t a[2], const uint64_t b[2])
{
  char x[MESH_HASH_TEXT], y[MESH_HASH_TEXT];
  mesh_hash_print(a, x);
  mesh_hash_print(b, y);
  assert_string_equal(x, y);
}

// Each version and encoding gives back the mesh that was written, of the same hash, whatever the groups.
static void round_trips_keep_the_hash(void **state)
{
  (void)state;
  static const char *const formats[] = {"msh", "msh2", "msh1"};
  for (int kind = 0; kind < 8; kind++) {
    Mesh *m = sample_mesh(1 + (size_t)kind, kind & 1, kind & 2);
    OutOptions o = {.binary = kind & 4, .save_parametric = kind == 3};
    MeshHash want = mesh_hash(m, false);
    for (size_t f = 0; f < ARRAY_LEN(formats); f++) {
      Mesh *back = round_trip(m, formats[f], &o);
      MeshHash got = mesh_hash(back, false);
      assert_hash(got.shape, want.shape);
      assert_hash(got.groups, want.groups);
      if (f < 2) assert_hash(got.full, want.full);
      for (int dim = 0; dim < 3 && !(kind & 1); dim++) assert_int_equal(mesh_count(back, dim), mesh_count(m, dim));
      mesh_free(back);
    }
    mesh_free(m);
  }
}

// MSH 4.1 gives back the entities too: a second writing has the same bytes as the first.
static void msh4_twice_is_the_same_file(void **state)
{
  (void)state;
  for (int kind = 0; kind < 4; kind++) {
    Mesh *m = sample_mesh(4, false, kind & 2);
    vec_push(&m->entity[13].embedded, 5);
    OutOptions o = {.binary = kind & 1, .save_parametric = true};
    size_t a, b, none;
    char *first = written(m, "msh", &o, &a);
    m->entity[13].embedded.len = 0; // they leave no trace: gmsh would warn of tags that are no curves
    char *without = written(m, "msh", &o, &none);
    assert_int_equal(a, none);
    assert_memory_equal(first, without, a);
    free(without);
    Mesh *back = round_trip(m, "msh", &o);
    char *second = written(back, "msh", &o, &b);
    assert_int_equal(a, b);
    assert_memory_equal(first, second, a);
    free(first);
    free(second);
    mesh_free(m);
    mesh_free(back);
  }
}

static void periodic_links_are_kept(void **state)
{
  (void)state;
  static const char *const formats[] = {"msh", "msh2"};
  Mesh *m = sample_mesh(3, false, false);
  MeshPeriodic *p = mesh_add_periodic(m, 1, 3, 6);
  p->has_affine = true;
  for (int i = 0; i < 16; i++) p->affine[i] = i % 5 == 0;
  p->affine[3] = 2;
  for (uint32_t k = 0; k < 2; k++) {
    vec_push(&p->slave_node, 10 + k);
    vec_push(&p->master_node, 17 - k);
  }
  for (size_t f = 0; f < 2; f++)
    for (int binary = 0; binary < 2; binary++) {
      Mesh *back = round_trip(m, formats[f], &(OutOptions){.binary = binary});
      assert_int_equal(back->nperiodic, 1);
      assert_int_equal(back->periodic[0].tag, 3);
      assert_int_equal(back->periodic[0].master, 6);
      assert_int_equal(back->periodic[0].slave_node.len, 2);
      assert_int_equal(back->periodic[0].master_node.data[1], 16);
      assert_true(back->periodic[0].affine[3] == 2);
      mesh_free(back);
    }
  mesh_free(m);
}

// The hash does not see the order of nodes, of elements and of corners; it sees everything else.
static void the_hash_ignores_order_only(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(4, true, true);
  MeshHash want = mesh_hash(m, false), got;
  for (size_t b = 0; b < m->nblock; b++) {
    MeshBlock *k = &m->block[b];
    size_t n = (size_t)elem_nodes(k->type);
    for (size_t i = 0; i < k->n / 2; i++)
      for (size_t j = 0; j < n; j++) {
        uint32_t *x = k->node + i * n + j, *y = k->node + (k->n - 1 - i) * n + j, t = *x;
        *x = *y;
        *y = t;
      }
    if (elem_dim(k->type) == 2)
      for (size_t i = 0; i < k->n; i++) {
        uint32_t first = k->node[i * n];
        memmove(k->node + i * n, k->node + i * n + 1, (n - 1) * sizeof first);
        k->node[i * n + n - 1] = first;
      }
  }
  got = mesh_hash(m, false);
  assert_hash(got.full, want.full);
  m->xyz[3 * (m->nnode - 1)] = nextafter(m->xyz[3 * (m->nnode - 1)], 9);
  got = mesh_hash(m, false);
  assert_true(got.shape[0] != want.shape[0] && got.full[1] != want.full[1]);
  m->xyz[3 * (m->nnode - 1)] = nextafter(m->xyz[3 * (m->nnode - 1)], -9);
  m->entity[14].physical.data[0] = 7;
  got = mesh_hash(m, false);
  assert_hash(got.shape, want.shape);
  assert_true(got.groups[0] != want.groups[0]);
  mesh_free(m);
}

// For every type: a symmetry maps the lattice onto itself, and reversing twice is nothing.
static void symmetries_are_permutations(void **state)
{
  (void)state;
  for (int t = 1; t < 40; t++) {
    int n = elem_nodes((ElemType)t), corners = elem_corners((ElemType)t);
    if (!n) continue;
    uint8_t once[ELEM_MAX_NODES], total[ELEM_MAX_NODES];
    for (int i = 0; i < n; i++) total[i] = (uint8_t)i;
    for (int r = 0; r < MAX(corners, 1); r++) {
      assert_int_equal(elem_symmetry((ElemType)t, 1, false, once), n);
      uint8_t next[ELEM_MAX_NODES];
      for (int i = 0; i < n; i++) next[i] = total[once[i]];
      memcpy(total, next, sizeof total);
    }
    for (int i = 0; i < n && corners > 2; i++) assert_int_equal(total[i], i);
    elem_symmetry((ElemType)t, 0, true, once);
    for (int i = 0; i < n; i++) assert_int_equal(once[once[i]], i);
    if (corners > 2) assert_int_equal(once[0], 0);
    if (corners == 3) assert_int_equal(once[1], 2);
  }
  uint8_t perm[ELEM_MAX_NODES];
  elem_symmetry(ELEM_TRI6, 0, true, perm);
  assert_memory_equal(perm, ((const uint8_t[]){0, 2, 1, 5, 4, 3}), 6);
  elem_symmetry(ELEM_QUAD9, 1, false, perm);
  assert_memory_equal(perm, ((const uint8_t[]){1, 2, 3, 0, 5, 6, 7, 4, 8}), 9);
}

// A mesh of one element of every type goes through every version.
static void all_types_are_kept(void **state)
{
  (void)state;
  static const char *const formats[] = {"msh", "msh2", "msh1"};
  Rng rng = {3};
  Mesh *m = mesh_new();
  for (int dim = 0; dim < 3; dim++) mesh_add_entity(m, dim, 4);
  for (int t = 1; t < 40; t++) {
    if (!elem_nodes((ElemType)t)) continue;
    for (int i = 0; i < elem_nodes((ElemType)t); i++)
      mesh_add_node(m, (Vec3){rng_double(&rng), rng_double(&rng), rng_double(&rng)}, (uint32_t)elem_dim((ElemType)t), NAN);
  }
  uint32_t at = 0;
  for (int t = 1; t < 40; t++)
    if (elem_nodes((ElemType)t)) {
      uint32_t b = mesh_add_block(m, (uint32_t)elem_dim((ElemType)t), (ElemType)t, 1);
      for (int i = 0; i < elem_nodes((ElemType)t); i++) m->block[b].node[i] = at++;
    }
  MeshHash want = mesh_hash(m, false);
  for (size_t f = 0; f < ARRAY_LEN(formats); f++)
    for (int binary = 0; binary < 2; binary++) {
      Mesh *back = round_trip(m, formats[f], &(OutOptions){.binary = binary});
      assert_hash(mesh_hash(back, false).full, want.full);
      mesh_free(back);
    }
  mesh_free(m);
}

static Mesh *read_text(const char *text, int errors)
{
  Diag *d = diag_new(false);
  Mesh *m = out_read_memory(text, strlen(text), "a.msh", "msh", d);
  assert_int_equal(diag_errors(d), errors);
  diag_free(d);
  return m;
}

// An element listed once per group is one element of several groups; another set of groups is another entity.
static void groups_per_element_are_gathered(void **state)
{
  (void)state;
  Mesh *m = read_text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nany\n$EndComments\n"
                      "$Nodes\n4\n10 0 0 0\n20 1 0 0\n5 1 1 0\n7 0 1 0\n$EndNodes\n"
                      "$Elements\n5\n1 2 2 1 6 10 20 5\n2 2 2 2 6 5 20 10\n3 2 2 1 6 10 5 7\n4 1 2 0 3 10 20\n5 15 3 8 2 0 7\n"
                      "$EndElements\n", 0);
  assert_non_null(m);
  assert_int_equal(mesh_count(m, 2), 2);
  assert_int_equal(mesh_count(m, 1), 1);
  uint32_t a = mesh_find_entity(m, 2, 6), b = mesh_find_entity(m, 2, 7);
  assert_int_equal(m->entity[a].physical.len, 2);
  assert_int_equal(m->entity[a].physical.data[1], -2);
  assert_int_equal(m->entity[b].physical.len, 1);
  assert_int_equal(m->ngroup, 3);
  assert_int_equal(mesh_node_number(m, 2), 5);
  assert_int_equal(m->node_entity[3], 0); // on the point
  mesh_free(m);
}

static void errors_name_the_line(void **state)
{
  (void)state;
  static const struct { const char *text, *want; } bad[] = {
      {"", "neither"},
      {"$MeshFormat\n3 0 8\n$EndMeshFormat\n", "a.msh:3: MSH version 3"},
      {"$MeshFormat\n4.1 0 8\n", "a.msh:3: $EndMeshFormat expected"},
      {"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n99999999\n1 0 0 0\n$EndNodes\n", "do not fit"},
      {"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 zero 0\n$EndNodes\n", "a.msh:6: a coordinate expected, found 'zero'"},
      {"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 nan 0\n$EndNodes\n", "not a finite"},
      {"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n1 0 1 0\n$EndNodes\n", "defined twice"},
      {"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 15 2 0 1 2\n$EndElements\n",
       "node 2 is not defined"},
      {"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 99 2 0 1 2\n$EndElements\n",
       "type 99"},
      {"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Foo\n", "does not end"},
      {"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Elements\n1 1 1 1\n2 1 1 1\n1 1 2\n$EndElements\n", "type 1 in an entity of dimension 2"},
  };
  for (size_t i = 0; i < ARRAY_LEN(bad); i++) {
    Diag *d = diag_new(false);
    assert_null(out_read_memory(bad[i].text, strlen(bad[i].text), "a.msh", "msh", d));
    assert_int_equal(diag_errors(d), 1);
    if (!strstr(diag_get(d, 0)->text, bad[i].want)) fail_msg("'%s' lacks '%s'", diag_get(d, 0)->text, bad[i].want);
    diag_free(d);
  }
}

// Truncated and corrupted files: an error or a mesh, never a crash. (Run under the sanitizers too.)
static void damaged_files_do_no_harm(void **state)
{
  (void)state;
  static const char *const formats[] = {"msh", "msh2", "msh1"};
  Rng rng = {1};
  Mesh *m = sample_mesh(2, true, true);
  for (size_t f = 0; f < ARRAY_LEN(formats); f++)
    for (int binary = 0; binary < 2; binary++) {
      size_t len;
      char *text = written(m, formats[f], &(OutOptions){.binary = binary}, &len);
      for (int trial = 0; trial < 600; trial++) {
        size_t n = trial < 300 ? len * (size_t)trial / 300 : len;
        char *copy = mem_alloc(n + 1);
        memcpy(copy, text, n);
        copy[n] = 0;
        for (int k = 0; trial >= 300 && k < 1 + trial % 4; k++)
          copy[rng_below(&rng, (uint32_t)n)] = trial % 2 ? "0-9 $\n"[rng_below(&rng, 6)] : (char)rng_next(&rng);
        Diag *d = diag_new(false);
        Mesh *back = out_read_memory(copy, n, "a.msh", "msh", d);
        // A file cut between two sections cannot be told from a complete one.
        if (trial < 300 && back) assert_true(mesh_count(back, 2) == 0 || mesh_count(back, 2) == mesh_count(m, 2));
        assert_true(back || diag_errors(d) == 1);
        mesh_free(back);
        diag_free(d);
        free(copy);
      }
      free(text);
    }
  mesh_free(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(round_trips_keep_the_hash),
      cmocka_unit_test(msh4_twice_is_the_same_file),
      cmocka_unit_test(periodic_links_are_kept),
      cmocka_unit_test(the_hash_ignores_order_only),
      cmocka_unit_test(symmetries_are_permutations),
      cmocka_unit_test(all_types_are_kept),
      cmocka_unit_test(groups_per_element_are_gathered),
      cmocka_unit_test(errors_name_the_line),
      cmocka_unit_test(damaged_files_do_no_harm),
  };
  return unit_run(tests);
}
