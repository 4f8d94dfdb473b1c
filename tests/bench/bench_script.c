// bench_script.c - how fast scripts are read: a generated file of points and lines, and a long loop
// SPDX-License-Identifier: MIT
//
// Usage: bench_script [POINTS]. Prints seconds of processor time (least of 3 runs), megabytes a second and
// peak memory.
#include "base/base.h"

#include "base/mem.h"
#include "base/rng.h"
#include "base/stats.h"
#include "base/str.h"
#include "model/model_edit.h"
#include "script/script.h"
#include "size/field.h"

static double run(const char *text, size_t len, size_t *points)
{
  Model *model = model_new();
  Options options;
  options_init(&options);
  FieldSet *fields = fields_new();
  Diag *diag = diag_new(true);
  Script *s = script_new(model, &options, fields, diag, NULL);
  double t = time_cpu();
  script_run_text(s, "bench", text, len);
  t = time_cpu() - t;
  *points = model_points(model);
  script_free(s);
  diag_free(diag);
  fields_free(fields);
  options_free(&options);
  model_free(model);
  return t;
}

static void measure(const char *what, const Str *text)
{
  double best = 1e300;
  size_t points = 0;
  for (int i = 0; i < 3; i++) {
    double t = run(str_text(text), text->len, &points);
    if (t < best) best = t;
  }
  printf("%-28s %8.1f MB  %7.3f s  %7.1f MB/s  %9zu points  peak %5.0f MB\n", what, (double)text->len / 1e6,
         best, (double)text->len / 1e6 / best, points, (double)mem_peak() / 1e6);
}

int main(int argc, char **argv)
{
  int n = argc > 1 ? (int)strtol(argv[1], NULL, 10) : 1000000;
  Str text = {0};
  str_append(&text, "x = 0; y = 0;\nFor i In {1:1e7}\n  x = x + i*2;\n  y += 1;\nEndFor\n");
  measure("loop of 10^7 iterations", &text);
  str_clear(&text);
  Rng rng = {1};
  for (int i = 1; i <= n; i++)
    str_printf(&text, "Point(%d) = {%.9g, %.9g, 0, 0.1};\n", i, rng_double(&rng), rng_double(&rng));
  for (int i = 1; i <= n; i++) str_printf(&text, "Line(%d) = {%d, %d};\n", i, i, i % n + 1);
  measure("points and lines", &text);
  str_free(&text);
  return 0;
}
