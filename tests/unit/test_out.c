// test_out.c - the saving rule, the format table and the writers
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>
#include <unistd.h>

#include "base/file.h"
#include "out/formats.h"

#include "mesh_sample.h"

// Path in the scratch folder of the test run.
static const char *scratch(char *buf, size_t cap, const char *name)
{
  const char *dir = getenv("SCRATCH");
  snprintf(buf, cap, "%s/out-%s", dir ? dir : "/tmp", name);
  return buf;
}

static char *written(const Mesh *m, const char *format, const OutOptions *o, size_t *len)
{
  char path[300];
  Diag *d = diag_new(false);
  assert_int_equal(out_write(m, scratch(path, sizeof path, format), format, o, d), EXIT_GOOD);
  assert_int_equal(diag_errors(d), 0);
  diag_free(d);
  char *text = file_read(path, len);
  assert_non_null(text);
  unlink(path);
  return text;
}

static void only_elements_of_groups_are_saved(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(1, true, false);
  size_t len;
  OutOptions o = {0};
  char *text = written(m, "msh2", &o, &len);
  // 1 point, 2 + 1 + 1 + 1 lines in groups, face 1's two triangles twice, face 2's two once.
  assert_non_null(strstr(text, "$Elements\n12\n"));
  // the curve in the group with a minus sign is written reversed: curve 3 runs from point 2 (node 2) to point 3 (node 3)
  assert_non_null(strstr(text, " 1 2 4 3 3 2\n"));
  assert_non_null(strstr(text, "1 6 \"the interface\"\n"));
  free(text);
  o.save_all = true;
  text = written(m, "msh2", &o, &len);
  assert_non_null(strstr(text, "$Elements\n17\n")); // each once, and no physical tag, as Gmsh does
  assert_null(strstr(text, " 2 2 7 "));
  free(text);
  mesh_free(m);
}

static void dropped_faces_are_warned_of(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(2, true, false);
  Diag *d = diag_new(false);
  out_warn_dropped(m, &(OutOptions){0}, d);
  assert_int_equal(diag_count(d), 0);
  vec_clear(&m->entity[14].physical);
  out_warn_dropped(m, &(OutOptions){0}, d);
  assert_int_equal(diag_warnings(d), 1);
  assert_non_null(strstr(diag_get(d, 0)->text, "8 of 16 surface elements are dropped"));
  out_warn_dropped(m, &(OutOptions){.save_all = true}, d);
  assert_int_equal(diag_warnings(d), 1);
  diag_free(d);
  mesh_free(m);
}

static void formats_are_found_by_name_and_extension(void **state)
{
  (void)state;
  for (size_t k = 0; format_at(k); k++) {
    assert_ptr_equal(format_find(format_name(format_at(k))), format_at(k));
    assert_true(format_help(format_at(k))[0] != 0);
  }
  assert_string_equal(format_name(format_of_path("a.b/c.MSH2")), "msh2");
  assert_null(format_of_path("a.msh/c"));
  assert_null(format_find("foo"));
  Mesh *m = sample_mesh(1, false, false);
  Diag *d = diag_new(false);
  assert_int_equal(out_write(m, "/tmp/x.foo", NULL, &(OutOptions){0}, d), EXIT_USAGE);
  assert_int_equal(out_write(m, "/nowhere/x.msh", NULL, &(OutOptions){0}, d), EXIT_ENVIRONMENT);
  assert_int_equal(out_write(m, "/dev/full", "msh", &(OutOptions){0}, d), EXIT_ENVIRONMENT);
  assert_int_equal(diag_errors(d), 3);
  diag_free(d);
  mesh_free(m);
}

static void writing_is_repeatable(void **state)
{
  (void)state;
  static const char *const names[] = {"msh", "msh2", "msh1", "vtk", "svg", "png", "pdf"};
  Mesh *m = sample_mesh(5, true, true);
  for (size_t i = 0; i < ARRAY_LEN(names); i++) {
    size_t a, b;
    OutOptions o = {.binary = i % 2, .mark_worst = 3};
    char *x = written(m, names[i], &o, &a), *y = written(m, names[i], &o, &b);
    assert_int_equal(a, b);
    assert_memory_equal(x, y, a);
    free(x);
    free(y);
  }
  mesh_free(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(only_elements_of_groups_are_saved),
      cmocka_unit_test(dropped_faces_are_warned_of),
      cmocka_unit_test(formats_are_found_by_name_and_extension),
      cmocka_unit_test(writing_is_repeatable),
  };
  return unit_run(tests);
}
