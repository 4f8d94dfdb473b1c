// test_base.c - properties of the base folder: maps, arenas, numbers, writers, diagnostics, loops
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <errno.h>
#include <math.h>
#include <unistd.h>

#include "base/diag.h"
#include "base/file.h"
#include "base/json.h"
#include "base/lines.h"
#include "base/map.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/rng.h"
#include "base/str.h"
#include "base/thread.h"

static void map_agrees_with_an_array(void **state)
{
  (void)state;
  enum { KEYS = 500, STEPS = 20000 };
  uint32_t truth[KEYS];
  memset(truth, 0xff, sizeof truth);
  Map m = {0};
  Rng rng = {7};
  for (int i = 0; i < STEPS; i++) {
    uint32_t k = rng_below(&rng, KEYS), what = rng_below(&rng, 3);
    uint64_t key = (uint64_t)k * 0x100000001u;
    if (what == 0) {
      map_remove(&m, key);
      truth[k] = NONE;
    } else if (what == 1) {
      map_set(&m, key, (uint32_t)i);
      truth[k] = (uint32_t)i;
    }
    assert_int_equal(map_get(&m, key), truth[k]);
  }
  for (uint32_t k = 0; k < KEYS; k++) assert_int_equal(map_get(&m, (uint64_t)k * 0x100000001u), truth[k]);
  map_free(&m);
}

static void names_find_what_was_set(void **state)
{
  (void)state;
  Names m = {0};
  char buf[32];
  for (uint32_t i = 0; i < 1000; i++) {
    snprintf(buf, sizeof buf, "name%u", i);
    names_set(&m, buf, i);
  }
  for (uint32_t i = 0; i < 1000; i += 3) {
    snprintf(buf, sizeof buf, "name%u", i);
    names_remove(&m, buf);
  }
  for (uint32_t i = 0; i < 1000; i++) {
    snprintf(buf, sizeof buf, "name%u", i);
    assert_int_equal(names_get(&m, buf), i % 3 ? i : NONE);
  }
  names_free(&m);
}

static void numbers_read_back_to_the_same_bits(void **state)
{
  (void)state;
  Rng rng = {1};
  for (int i = 0; i < 200000; i++) {
    uint64_t bits = rng_next(&rng);
    double v, w;
    memcpy(&v, &bits, sizeof v);
    if (!isfinite(v)) continue;
    char buf[NUMBER_MAX_TEXT];
    size_t n = number_print(buf, v);
    assert_ptr_equal(number_read(buf, buf + n, &w), buf + n);
    assert_memory_equal(&v, &w, sizeof v);
  }
  static const struct { const char *text; double value; size_t used; } cases[] = {
      {"1e400", INFINITY, 5}, {"-1e400", -INFINITY, 6}, {"1e-400", 0, 6}, {"+2.5", 2.5, 4},
      {".5x", 0.5, 2},        {"12.", 12, 3},           {"1e3", 1000, 3}, {"x", 0, 0},
      {"+-1", 0, 0},          {"5e-324", 5e-324, 6}};
  for (size_t i = 0; i < ARRAY_LEN(cases); i++) {
    double v = 0;
    const char *s = cases[i].text;
    assert_int_equal(number_read(s, s + strlen(s), &v) - s, cases[i].used);
    assert_true(v == cases[i].value);
  }
}

static void writer_leaves_a_whole_file_or_none(void **state)
{
  (void)state;
  char path[] = "/tmp/meshgen-test-XXXXXX";
  int fd = mkstemp(path);
  assert_true(fd >= 0);
  close(fd);
  Writer *w = writer_open(path);
  assert_non_null(w);
  for (int i = 0; i < 100000; i++) writer_printf(w, "%d %s\n", i, "text");
  writer_abandon(w);
  size_t n;
  char *text = file_read(path, &n);
  assert_int_equal(n, 0);
  free(text);
  w = writer_open(path);
  for (uint64_t i = 0; i < 100000; i++) writer_u64(w, i), writer_char(w, '\n');
  assert_int_equal(writer_close(w), 0);
  text = file_read(path, &n);
  assert_int_equal(n, 588890 + 100000 - 100000);
  assert_memory_equal(text + n - 6, "99999\n", 6);
  free(text);
  unlink(path);
  assert_null(writer_open("/nonexistent-folder/x"));
  w = writer_open("/dev/full");
  assert_non_null(w);
  writer_str(w, "x");
  assert_int_not_equal(writer_close(w), 0);
}

// "i\n" for each item, and now and then a text of the full room.
static char *put_item(char *p, const void *ctx, size_t from, size_t to)
{
  for (size_t i = from; i < to; i++) {
    p += snprintf(p, 20, "%zu\n", i + *(const size_t *)ctx);
    if (i % 100 == 0) p = (char *)memset(p, 'x', 80) + 80;
  }
  return p;
}

static char *items_written(int threads, size_t n, size_t *len)
{
  char path[] = "/tmp/meshgen-test-XXXXXX";
  close(mkstemp(path));
  Writer *w = writer_open(path);
  writer_threads(w, threads);
  writer_str(w, "before\n");
  size_t offset = 5;
  writer_items(w, n, 100, put_item, &offset);
  writer_str(w, "after\n");
  writer_items(w, n, 100, put_item, &offset);
  assert_int_equal(writer_close(w), 0);
  char *text = file_read(path, len);
  unlink(path);
  return text;
}

static void items_are_the_same_bytes_whatever_the_threads(void **state)
{
  (void)state;
  for (size_t n = 0; n < 200000; n = 7 * n + 50) {
    size_t len[2];
    char *one = items_written(1, n, &len[0]);
    for (int threads = 2; threads < 5; threads++) {
      char *more = items_written(threads, n, &len[1]);
      assert_int_equal(len[0], len[1]);
      assert_memory_equal(one, more, len[0]);
      free(more);
    }
    free(one);
  }
  Writer *w = writer_open("/dev/full");
  size_t offset = 0;
  writer_threads(w, 2);
  writer_items(w, 200000, 100, put_item, &offset);
  assert_int_equal(writer_close(w), ENOSPC);
}

// Lines "<number>\n" into an array; a line that begins otherwise is not taken.
static const char *take_number_lines(void *ctx, const char *p, const char *end, size_t first, size_t n)
{
  int64_t *to = ctx;
  for (size_t i = first; i < first + n; i++) {
    const char *q = number_read_i64(p, end, &to[i]);
    if (q == p || q == end || *q != '\n') return NULL;
    p = q + 1;
  }
  return p;
}

static void lines_are_taken_once_each_by_any_threads(void **state)
{
  (void)state;
  enum { LINES = 100000 };
  Str text = {0};
  int64_t *got = mem_zalloc(LINES * sizeof *got);
  for (int i = 0; i < LINES; i++) str_printf(&text, "%d\n", 7 * i);
  str_append_n(&text, "$End\n", 5);
  const char *end = text.data + text.len;
  for (int threads = 1; threads <= 4; threads++) {
    memset(got, 0xff, LINES * sizeof *got);
    assert_ptr_equal(lines_take(text.data, end, LINES, threads, take_number_lines, got), end - 5);
    for (int i = 0; i < LINES; i++) assert_int_equal(got[i], 7 * i);
    assert_null(lines_take(text.data, end - 6, LINES, threads, take_number_lines, got)); // the last newline is missing
    char *middle = text.data + text.len / 2, was = *middle;
    *middle = 'x';
    assert_null(lines_take(text.data, end, LINES, threads, take_number_lines, got));
    *middle = was;
  }
  free(got);
  str_free(&text);
}

static void arena_memory_is_zeroed_and_apart(void **state)
{
  (void)state;
  Arena a = {0};
  unsigned char *p[200];
  for (size_t i = 0; i < 200; i++) {
    p[i] = arena_alloc(&a, i * 997 % 3000 + 1);
    for (size_t j = 0; j < i * 997 % 3000 + 1; j++) assert_int_equal(p[i][j], 0);
    memset(p[i], (int)i, i * 997 % 3000 + 1);
  }
  for (size_t i = 0; i < 200; i++)
    for (size_t j = 0; j < i * 997 % 3000 + 1; j++) assert_int_equal(p[i][j], (unsigned char)i);
  arena_free(&a);
}

static void nearest_names_are_suggested(void **state)
{
  (void)state;
  static const char *const names[] = {"Algorithm", "MeshSizeMax", "MeshSizeMin", "RecombineAll"};
  assert_string_equal(str_nearest("Algoritm", names, 4), "Algorithm");
  assert_string_equal(str_nearest("MeshSizeMxa", names, 4), "MeshSizeMax");
  assert_string_equal(str_nearest("recombineall", names, 4), "RecombineAll");
  assert_null(str_nearest("Banana", names, 4));
  assert_int_equal(str_distance("kitten", "sitting", 5), 3);
  assert_int_equal(str_distance("ab", "ba", 5), 1);
}

static void diagnostics_are_counted_and_merged_in_order(void **state)
{
  (void)state;
  Diag *d = diag_new(false);
  static const char text[] = "Point(1) = {0,0};\nLine(2) = {1,2};\n";
  uint32_t f = diag_add_file(d, "a.geo", text, sizeof text - 1, NO_LOC);
  Diag *c = diag_child(d);
  diag_warning(c, (SrcLoc){f, 1, 1}, "odd %d", 1);
  diag_error(c, (SrcLoc){f, 2, 1}, "bad %s", "thing");
  diag_merge(d, c);
  assert_int_equal(diag_errors(d), 1);
  assert_int_equal(diag_warnings(d), 1);
  assert_string_equal(diag_get(d, 1)->text, "bad thing");
  assert_string_equal(diag_file_name(d, f), "a.geo");
  for (int i = 0; i < 30; i++) diag_error(d, NO_LOC, "more");
  assert_true(diag_full(d));
  assert_int_equal(diag_errors(d), 31);
  diag_free(d);
}

static void warnings_are_kept_up_to_a_number_and_all_counted(void **state)
{
  (void)state;
  Diag *d = diag_new(false);
  for (int i = 0; i < 3 * DIAG_MAX_WARNINGS; i++) {
    diag_warning(d, NO_LOC, "again");
    diag_note(d, NO_LOC, "its note");
  }
  assert_int_equal(diag_warnings(d), 3 * DIAG_MAX_WARNINGS);
  assert_int_equal(diag_count(d), 2 * DIAG_MAX_WARNINGS + 1);
  assert_non_null(strstr(diag_get(d, diag_count(d) - 1)->text, "more warnings"));
  diag_error(d, NO_LOC, "an error");
  diag_note(d, NO_LOC, "its note");
  assert_int_equal(diag_count(d), 2 * DIAG_MAX_WARNINGS + 3);
  diag_free(d);
}

static void warnings_alike_at_one_place_are_said_together(void **state)
{
  (void)state;
  Diag *d = diag_new(false);
  SrcLoc here = {1, 7, 3}, there = {1, 8, 3};
  for (int i = 0; i < DIAG_MAX_ALIKE + 2; i++) {
    diag_warning(d, here, "no curve %d", i);
    diag_note(d, here, "its note");
  }
  for (int i = 0; i < DIAG_MAX_ALIKE; i++) diag_warning(d, there, "no curve %d", i);
  diag_warning(d, here, "another thing");
  assert_int_equal(diag_warnings(d), 2 * DIAG_MAX_ALIKE + 3);
  assert_int_equal(diag_count(d), 3 * DIAG_MAX_ALIKE + 1);
  diag_flush(d);
  assert_int_equal(diag_count(d), 3 * DIAG_MAX_ALIKE + 2);
  assert_string_equal(diag_get(d, diag_count(d) - 1)->text, "2 more warnings like those here; the first: no curve 3");
  diag_flush(d); // once
  assert_int_equal(diag_count(d), 3 * DIAG_MAX_ALIKE + 2);
  diag_warning(d, here, "no curve %d", 1); // and from the start again
  assert_int_equal(diag_count(d), 3 * DIAG_MAX_ALIKE + 3);
  diag_free(d);
}

static void json_is_well_formed(void **state)
{
  (void)state;
  Json j = {0};
  json_begin(&j, NULL, '{');
  json_number(&j, "a", 0.1);
  json_string(&j, "b", "x\"\\\n\xe9");
  json_begin(&j, "c", '[');
  json_integer(&j, NULL, -3);
  json_bool(&j, NULL, true);
  json_end(&j, ']');
  json_begin(&j, "d", '[');
  json_end(&j, ']');
  json_number(&j, "e", NAN);
  json_end(&j, '}');
  assert_string_equal(str_text(&j.out), "{\n  \"a\": 0.1,\n  \"b\": \"x\\\"\\\\\\u000a\\u00e9\",\n  \"c\": [\n    -3,\n    true\n  ],\n"
                                        "  \"d\": [],\n  \"e\": null\n}");
  str_free(&j.out);
}

static void add_one(void *ctx, size_t i, int worker)
{
  (void)worker;
  ((int *)ctx)[i]++;
}

static void parallel_loop_visits_each_item_once(void **state)
{
  (void)state;
  static int hits[10000];
  for (int threads = 1; threads <= 4; threads++) {
    memset(hits, 0, sizeof hits);
    thread_for(ARRAY_LEN(hits), threads, add_one, hits);
    for (size_t i = 0; i < ARRAY_LEN(hits); i++) assert_int_equal(hits[i], 1);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(map_agrees_with_an_array),
      cmocka_unit_test(names_find_what_was_set),
      cmocka_unit_test(numbers_read_back_to_the_same_bits),
      cmocka_unit_test(writer_leaves_a_whole_file_or_none),
      cmocka_unit_test(items_are_the_same_bytes_whatever_the_threads),
      cmocka_unit_test(lines_are_taken_once_each_by_any_threads),
      cmocka_unit_test(arena_memory_is_zeroed_and_apart),
      cmocka_unit_test(nearest_names_are_suggested),
      cmocka_unit_test(diagnostics_are_counted_and_merged_in_order),
      cmocka_unit_test(warnings_are_kept_up_to_a_number_and_all_counted),
      cmocka_unit_test(warnings_alike_at_one_place_are_said_together),
      cmocka_unit_test(json_is_well_formed),
      cmocka_unit_test(parallel_loop_visits_each_item_once),
  };
  return unit_run(tests);
}
