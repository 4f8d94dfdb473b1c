// bench_size.c - what sizes and the 1D mesh cost: crossings of 10^6 edges, distances among 10^5 curves, MathEval, a coastline
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "base/mem.h"
#include "base/rng.h"
#include "base/stats.h"
#include "geom/intersect.h"
#include "mesh/mesh1d.h"
#include "model/model_edit.h"

// A closed rough line of n points around the unit circle that does not cross itself.
static void coast_point(uint32_t i, uint32_t n, double *x, double *y)
{
  double a = 2 * M_PI * i / n, r = 1 + 0.1 * sin(7 * a) + 0.02 * sin(61 * a) + 0.003 * sin(997 * a);
  *x = r * cos(a);
  *y = r * sin(a);
}

// n long segments side by side, a millionth apart, of two directions that do not meet; and one across all.
static void bench_long(uint32_t n)
{
  double *xy = mem_alloc(4 * (n + 1) * sizeof *xy);
  uint32_t *end = mem_alloc(2 * (n + 1) * sizeof *end);
  for (uint32_t i = 0; i <= n; i++) {
    double y = 1e-6 * i, across = i == n;
    memcpy(xy + 4 * i, (double[4]){0.3 * across, across ? -1 : y, across ? 0.4 : 1, across ? 2 : y + (i < n / 2 ? 0.3 : 0.31)}, 4 * sizeof *xy);
    end[2 * i] = 2 * i, end[2 * i + 1] = 2 * i + 1;
  }
  SegPairVec pairs = {0};
  double t = time_cpu();
  segments_intersect(xy, end, n + 1, 10000000, &pairs);
  printf("crossings of %7u long side by side   %8.3f s cpu, %zu pairs\n", n, time_cpu() - t, pairs.len);
  vec_free(&pairs);
  free(xy);
  free(end);
}

static void bench_crossings(void)
{
  enum { N = 1000000 };
  double *xy = mem_alloc(2 * N * sizeof *xy);
  uint32_t *end = mem_alloc(2 * N * sizeof *end);
  for (uint32_t i = 0; i < N; i++) {
    coast_point(i, N, xy + 2 * i, xy + 2 * i + 1);
    end[2 * i] = i;
    end[2 * i + 1] = (i + 1) % N;
  }
  SegPairVec pairs = {0};
  double t = time_cpu();
  segments_intersect(xy, end, N, 1000, &pairs);
  printf("crossings of a chain of 10^6 edges      %8.3f s cpu, %zu pairs\n", time_cpu() - t, pairs.len);
  Rng rng = {1};
  for (uint32_t i = 0; i < N; i++) { // scattered short edges, about one crossing in three edges
    xy[2 * i] = rng_double(&rng), xy[2 * i + 1] = rng_double(&rng);
  }
  double *s = mem_alloc(4 * N * sizeof *s);
  for (uint32_t i = 0; i < N; i++) {
    s[4 * i] = xy[2 * i], s[4 * i + 1] = xy[2 * i + 1];
    s[4 * i + 2] = xy[2 * i] + 0.001 * (rng_double(&rng) - 0.5), s[4 * i + 3] = xy[2 * i + 1] + 0.001 * (rng_double(&rng) - 0.5);
    end[2 * i] = 2 * i, end[2 * i + 1] = 2 * i + 1;
  }
  vec_clear(&pairs);
  t = time_cpu();
  segments_intersect(s, end, N, 10000000, &pairs);
  printf("crossings of 10^6 scattered edges       %8.3f s cpu, %zu pairs\n", time_cpu() - t, pairs.len);
  vec_free(&pairs);
  free(s);
  free(xy);
  free(end);
}

static Model *coast_model(uint32_t n, Diag *diag)
{
  Model *m = model_new();
  double x, y;
  for (uint32_t i = 0; i < n; i++) {
    coast_point(i, n, &x, &y);
    model_add_point(m, (int)i + 1, (Vec3){x, y, 0}, 0, NO_LOC, diag);
  }
  int *loop = mem_alloc(n * sizeof *loop);
  for (uint32_t i = 0; i < n; i++)
    loop[i] = model_add_curve(m, CURVE_LINE, (int)i + 1, (int[]){(int)i + 1, (int)(i + 1) % (int)n + 1}, 2, NULL, NULL, 0, NO_LOC, diag);
  model_add_loop(m, 1, loop, n, NO_LOC, diag);
  model_add_face(m, FACE_PLANE, 1, (int[]){1}, 1, NO_LOC, diag);
  free(loop);
  CHECK(model_prepare(m, 1e-8, diag));
  return m;
}

// Nanoseconds of one evaluation in the face, at scattered places and along a path, by batches and one by one.
static void bench_field(const char *name, const SizeField *s, const Face *f, double lo, double hi)
{
  enum { N = 1000000 };
  Vec3 *p = mem_alloc(N * sizeof *p);
  double *h = mem_alloc(N * sizeof *h), sum = 0;
  SizeEval *e = size_eval_new(s);
  Rng rng = {5};
  for (int path = 0; path < 2; path++) {
    for (int i = 0; i < N; i++) {
      double a = 40 * M_PI * i / N, r = (hi - lo) * i / N;
      p[i] = path ? (Vec3){r * cos(a), r * sin(a), 0}
                  : (Vec3){lo + (hi - lo) * rng_double(&rng), lo + (hi - lo) * rng_double(&rng), 0};
    }
    double t = time_cpu();
    size_in_face_batch(e, f, p, N, h);
    double batch = time_cpu() - t;
    t = time_cpu();
    for (int i = 0; i < N; i++) sum += size_in_face(e, f, p[i]);
    double single = time_cpu() - t;
    printf("%-24s %-14s %8.1f ns in batches, %8.1f ns one by one\n", name, path ? "along a path" : "scattered", batch / N * 1e9,
           single / N * 1e9);
  }
  if (sum == 0) printf("\n");
  size_eval_free(e);
  free(p);
  free(h);
}

static void set(FieldSet *f, int id, const char *option, double v, Diag *diag)
{
  CHECK(field_set_number(f, id, option, v, NO_LOC, diag));
}

static void bench_coast(uint32_t n)
{
  Diag *diag = diag_new(true);
  Options o;
  options_init(&o);
  o.Mesh_MeshSizeFromPoints = false;
  double t = time_cpu();
  Model *m = coast_model(n, diag);
  printf("coastline of %u curves: model          %8.3f s cpu\n", n, time_cpu() - t);
  FieldSet *f = fields_new();
  field_create(f, 1, "Distance", NO_LOC, diag);
  double *all = mem_alloc(n * sizeof *all);
  for (uint32_t i = 0; i < n; i++) all[i] = i + 1;
  field_set_list(f, 1, "CurvesList", all, n, NO_LOC, diag);
  field_create(f, 2, "Threshold", NO_LOC, diag);
  set(f, 2, "InField", 1, diag), set(f, 2, "DistMin", 0.01, diag), set(f, 2, "DistMax", 0.5, diag);
  set(f, 2, "SizeMin", 2e-5, diag), set(f, 2, "SizeMax", 0.1, diag);
  fields_set_background(f, 1, NO_LOC);
  SizeField *s = size_new(m, &o, f, diag);
  bench_field("Distance to all", s, model_face_at(m, 0), -1.2, 1.2);
  size_free(s);
  fields_set_background(f, 2, NO_LOC);
  double w = time_wall();
  t = time_cpu();
  s = size_new(m, &o, f, diag);
  Mesh1d *g = mesh1d_new(m, &o, s, diag);
  size_t edges = 0;
  for (size_t k = 0; g && k < g->ncurve; k++) edges += g->curve[k].n - 1;
  printf("coastline sized by Distance/Threshold: 1D %6.3f s cpu, %.3f s wall, %zu edges\n", time_cpu() - t, time_wall() - w, edges);
  mesh1d_free(g);
  size_free(s);
  field_create(f, 3, "MathEval", NO_LOC, diag);
  field_set_string(f, 3, "F", "0.1+0.08*sin(3*x)*cos(6*y)", NO_LOC, diag);
  fields_set_background(f, 3, NO_LOC);
  s = size_new(m, &o, f, diag);
  bench_field("MathEval sin cos", s, model_face_at(m, 0), -1.2, 1.2);
  size_free(s);
  free(all);
  fields_free(f);
  options_free(&o);
  model_free(m);
  diag_free(diag);
}

int main(void)
{
  bench_crossings();
  bench_long(10000);
  bench_long(100000);
  bench_long(1000000);
  bench_coast(100000);
  return 0;
}
