// test_options.c - the option table is consistent, and setting is checked
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>

#include "opt/options.h"

static void every_row_is_found_and_its_default_is_in_range(void **state)
{
  (void)state;
  size_t n;
  const OptRow *rows = options_rows(&n);
  Options o;
  options_init(&o);
  Diag *d = diag_new(false);
  for (size_t i = 0; i < n; i++) {
    assert_ptr_equal(options_find(rows[i].category, rows[i].key), &rows[i]);
    if (rows[i].kind == OPT_NUM || rows[i].kind == OPT_INT || rows[i].kind == OPT_BOOL) {
      assert_true(options_get_number(&o, &rows[i]) == rows[i].def);
      assert_true(options_set_number(&o, &rows[i], rows[i].def, NO_LOC, d));
      assert_true(rows[i].help[0] != 0);
    }
    if (rows[i].sw[0]) assert_ptr_equal(options_find_switch(rows[i].sw), &rows[i]);
  }
  diag_free(d);
  options_free(&o);
}

static void values_out_of_range_are_refused(void **state)
{
  (void)state;
  Options o;
  options_init(&o);
  Diag *d = diag_new(false);
  assert_false(options_set_number(&o, options_find("Mesh", "Algorithm"), 77, NO_LOC, d));
  assert_non_null(strstr(diag_get(d, 0)->text, "1 2 3 5 6"));
  assert_int_equal(o.Mesh_Algorithm, 6);
  assert_false(options_set_number(&o, options_find("Mesh", "MeshSizeFactor"), 0, NO_LOC, d));
  assert_false(options_set_number(&o, options_find("Mesh", "MeshSizeFactor"), NAN, NO_LOC, d));
  assert_false(options_set_number(&o, options_find("Mesh", "NbNodes"), 1, NO_LOC, d));
  assert_true(options_set_number(&o, options_find("Mesh", "CharacteristicLengthFactor"), 0.5, NO_LOC, d));
  assert_true(o.Mesh_MeshSizeFactor == 0.5);
  assert_true(options_set_number(&o, options_find("Mesh", "Algorithm"), 5.7, NO_LOC, d));
  assert_int_equal(o.Mesh_Algorithm, 5);
  assert_null(options_find("Mesh", "Algoritm"));
  assert_string_equal(options_nearest("Mesh", "Algoritm"), "Algorithm");
  assert_non_null(options_find("View", "Visible"));
  assert_true(options_set_number(&o, options_find("Geometry", "PointNumbers"), 1, NO_LOC, d));
  assert_true(options_get_number(&o, options_find("Geometry", "PointNumbers")) == 1);
  diag_free(d);
  options_free(&o);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_row_is_found_and_its_default_is_in_range),
      cmocka_unit_test(values_out_of_range_are_refused),
  };
  return unit_run(tests);
}
