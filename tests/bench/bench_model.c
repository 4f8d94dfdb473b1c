// bench_model.c - building, transforming and merging large models
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "base/file.h"
#include "base/stats.h"
#include "model/model_edit.h"
#include "model/unroll.h"

static double started;
static size_t memory;

static void begin(void)
{
  started = time_cpu();
  memory = mem_now();
}

static void end(const char *what, size_t n)
{
  double t = time_cpu() - started;
  printf("%-52s %8.3f s %7.0f ns each %6.0f bytes each\n", what, t, 1e9 * t / (double)n,
         (double)(mem_now() - memory) / (double)n);
}

// A polygon of n points and lines, one loop, one face.
static void polygon(size_t n)
{
  Model *m = model_new();
  Diag *d = diag_new(true);
  begin();
  for (size_t i = 0; i < n; i++) {
    double a = 6.283185307179586 * (double)i / (double)n;
    model_add_point(m, (int)i + 1, (Vec3){cos(a), sin(a), 0}, .1, NO_LOC, d);
  }
  end("points", n);
  begin();
  for (size_t i = 0; i < n; i++)
    model_add_curve(m, CURVE_LINE, (int)i + 1, (int[]){(int)i + 1, (int)((i + 1) % n) + 1}, 2, NULL, NULL, 0, NO_LOC, d);
  end("lines", n);
  begin();
  IntVec all = {0};
  model_all(m, 1, &all);
  model_add_loop(m, 1, all.data, all.len, NO_LOC, d);
  model_add_face(m, FACE_PLANE, 1, (int[]){1}, 1, NO_LOC, d);
  end("one loop, one face", n);
  begin();
  model_prepare(m, 1e-8, d);
  end("model_prepare", n);
  begin();
  Affine a = affine_rotation((Vec3){0, 0, 1}, (Vec3){0, 0, 0}, 1);
  Shape s = {2, 1};
  model_settings(m)->auto_coherence = 0;
  model_transform(m, &s, 1, &a, NO_LOC, d);
  end("rotate the face", n);
  begin();
  model_coherence(m, d);
  end("first coherence", n);
  begin();
  Writer *w = writer_open("/dev/null");
  model_unroll(m, w);
  writer_close(w);
  end("unroll", n);
  vec_free(&all);
  model_free(m);
  diag_free(d);
}

// n unit squares in a row, each copied from the first and moved: coherence after every one.
static void row(size_t n)
{
  Model *m = model_new();
  Diag *d = diag_new(true);
  begin();
  model_add_point(m, 1, (Vec3){0, 0, 0}, 0, NO_LOC, d);
  model_add_point(m, 2, (Vec3){0, 1, 0}, 0, NO_LOC, d);
  int edge = model_add_curve(m, CURVE_LINE, 1, (int[]){1, 2}, 2, NULL, NULL, 0, NO_LOC, d);
  for (size_t i = 0; i < n; i++) { // each square is extruded from the last one's far side
    ShapeVec out = {0};
    Shape s = {1, edge};
    Sweep w = {.translate = true, .shift = {1, 0, 0}};
    model_extrude(m, &s, 1, &w, &out, NO_LOC, d);
    edge = out.data[0].tag;
    vec_free(&out);
  }
  end("extrusions, coherence after each", n);
  model_free(m);
  m = model_new();
  begin();
  model_add_point(m, 1, (Vec3){0, 0, 0}, 0, NO_LOC, d);
  model_add_point(m, 2, (Vec3){1, 0, 0}, 0, NO_LOC, d);
  model_add_curve(m, CURVE_LINE, 1, (int[]){1, 2}, 2, NULL, NULL, 0, NO_LOC, d);
  for (size_t i = 1; i < n; i++) {
    ShapeVec out = {0};
    Shape s = {1, 1};
    model_duplicate(m, &s, 1, &out, NO_LOC, d);
    Affine a = affine_translation((Vec3){(double)i, 0, 0});
    model_transform(m, out.data, out.len, &a, NO_LOC, d);
    vec_free(&out);
  }
  end("copies moved, coherence after each", n);
  model_free(m);
  diag_free(d);
}

int main(int argc, char **argv)
{
  size_t n = argc > 1 ? (size_t)strtoull(argv[1], NULL, 10) : 1000000;
  polygon(n);
  row(n / 10);
  row(n / 100);
  return 0;
}
