// bench_io.c - time to write, read, hash, audit and compare a mesh of a million triangles
// SPDX-License-Identifier: MIT
// Usage: bench_io FOLDER [n]. Prints medians of 5 runs, of the clock and of the processor, in seconds; leaves the files there.
#include "base/base.h"

#include <math.h>

#include "base/stats.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_diff.h"
#include "mesh/mesh_hash.h"
#include "mesh/mesh_stats.h"
#include "out/formats.h"

#include "../unit/mesh_sample.h"

enum { RUNS = 5 };

typedef struct {
  Mesh *mesh, *other;
  const char *path;
  bool binary;
  Diag *diag;
} Bench;

static int order(const void *x, const void *y)
{
  const double *a = x, *b = y;
  return (*a > *b) - (*a < *b);
}

static void measure(const char *what, void (*body)(Bench *), Bench *b)
{
  double wall[RUNS], cpu[RUNS];
  for (int i = 0; i < RUNS; i++) {
    double w = time_wall(), c = time_cpu();
    body(b);
    wall[i] = time_wall() - w;
    cpu[i] = time_cpu() - c;
  }
  qsort(wall, RUNS, sizeof *wall, order);
  qsort(cpu, RUNS, sizeof *cpu, order);
  printf("%-24s wall %.3f  cpu %.3f\n", what, wall[RUNS / 2], cpu[RUNS / 2]);
}

static void write_file(Bench *b) { out_write(b->mesh, b->path, NULL, &(OutOptions){.binary = b->binary}, b->diag); }
static void read_file(Bench *b) { mesh_free(out_read(b->path, NULL, 0, b->diag, NULL)); }
static void hash(Bench *b) { mesh_hash(b->mesh, false); }

static void audit(Bench *b)
{
  MeshReport r;
  if (!mesh_check(b->mesh, true, &r)) printf("the sample is not valid\n");
  mesh_report_free(&r);
}

static void stats(Bench *b)
{
  MeshStats s;
  mesh_stats_make(&s, b->mesh, NULL);
  mesh_stats_free(&s);
}

static void diff(Bench *b)
{
  MeshDiff d;
  mesh_diff_make(&d, b->mesh, b->other, 1e-6);
  mesh_diff_free(&d);
}

int main(int argc, char **argv)
{
  static const char *const formats[] = {"msh", "msh2", "vtk", "vtu", "unv", "inp", "stl", "svg", "png"};
  const char *folder = argc > 1 ? argv[1] : "/tmp";
  size_t n = argc > 2 ? (size_t)strtol(argv[2], NULL, 10) : 500;
  Bench b = {.mesh = sample_mesh(n, false, false), .other = sample_mesh(n, false, false), .diag = diag_new(true)};
  b.other->xyz[3 * (b.other->nnode - 1)] += 1e-7;
  printf("%zu triangles, %zu nodes\n", mesh_count(b.mesh, 2), b.mesh->nnode);
  for (size_t f = 0; f < ARRAY_LEN(formats); f++)
    for (int binary = 0; binary < (f < 3 ? 2 : 1); binary++) {
      char path[400], what[60];
      snprintf(path, sizeof path, "%s/bench_io%s.%s", folder, binary ? "_bin" : "", formats[f]);
      b.path = path;
      b.binary = binary;
      snprintf(what, sizeof what, "write %s%s", formats[f], binary ? " binary" : "");
      measure(what, write_file, &b);
      snprintf(what, sizeof what, "read %s%s", formats[f], binary ? " binary" : "");
      if (format_reads(format_of_path(path))) measure(what, read_file, &b);
    }
  measure("hash", hash, &b);
  measure("audit", audit, &b);
  measure("quality report", stats, &b);
  measure("diff of two in memory", diff, &b);
  mesh_free(b.mesh);
  mesh_free(b.other);
  diag_free(b.diag);
  return 0;
}
