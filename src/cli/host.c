// host.c - what a script may ask the program for in the middle of its text: meshing, saving, printing, statistics, commands
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/host.h"

#include <math.h>

#include "cli/job_mesh.h"
#include "cli/output.h"
#include "mesh/high_order.h"
#include "mesh/mesh_stats.h"
#include "out/formats.h"

static bool host_mesh(void *ctx, MeshCommand what, double number, const char *text, SrcLoc loc)
{
  Job *j = ctx;
  (void)text;
  switch (what) {
  case MESH_GENERATE: return job_mesh_generate(j, number < 1 ? 0 : number < 2 ? 1 : number < 3 ? 2 : 3);
  case MESH_DELETE: job_mesh_drop(j); return true;
  case MESH_RENUMBER_NODES:
  case MESH_RENUMBER_ELEMENTS: return true; // always numbered consecutively
  case MESH_OPTIMIZE: return true;          // every mesh is optimized as it is made
  case MESH_REFINE:
  case MESH_BARYCENTRIC:
  case MESH_RECOMBINE:
  case MESH_SET_ORDER:
  case MESH_PARTITION: break;
  }
  if (!j->mesh) {
    diag_warning(j->diag, loc, "there is no mesh yet, so nothing is done: say Mesh 2; before");
    return true;
  }
  if (what == MESH_RECOMBINE) return job_mesh_recombine(j);
  j->reshaped = true;
  if (what == MESH_SET_ORDER) {
    if (number >= 1 && number < HIGH_ORDER_MAX + 1) return job_mesh_set_order(j, (int)number), true;
    diag_error(j->diag, loc, "SetOrder: the order must be 1 to %d", HIGH_ORDER_MAX);
    return false;
  }
  if (what == MESH_REFINE || what == MESH_BARYCENTRIC) {
    job_mesh_split(j, what == MESH_REFINE ? SUBDIVIDE_HALVE : SUBDIVIDE_BARYCENTRIC);
    return true;
  }
  if (number >= 0 && number <= INT32_MAX) return job_mesh_partition(j, (int)number);
  diag_error(j->diag, loc, "PartitionMesh: the number of parts must be 0 or more, not %g", number);
  return false;
}

static bool host_save(void *ctx, const char *path, SrcLoc loc)
{
  Job *j = ctx;
  if (!j->mesh) {
    diag_warning(j->diag, loc, "Save: there is no mesh yet, so nothing is written: say Mesh 2; before");
    return true;
  }
  const Format *f = format_of_path(path);
  return output_mesh(j, path, f ? format_name(f) : "msh") == EXIT_GOOD;
}

static void host_print(void *ctx, const char *text)
{
  Job *j = ctx;
  if (diag_level(j->diag) >= LOG_PRINTF) fprintf(j->out, "%s\n", text);
}

// Least, mean and largest quality: gamma of triangles, eta of quadrangles.
static void qualities(const Mesh *m, double to[3])
{
  MeshStats s;
  mesh_stats_make(&s, m, NULL);
  size_t n = s.gamma.n + s.eta.n;
  to[0] = !s.gamma.n ? s.eta.min : !s.eta.n ? s.gamma.min : fmin(s.gamma.min, s.eta.min);
  to[1] = n ? (s.gamma.mean * (double)s.gamma.n + s.eta.mean * (double)s.eta.n) / (double)n : 0;
  to[2] = fmax(s.gamma.n ? s.gamma.max : 0, s.eta.n ? s.eta.max : 0);
  mesh_stats_free(&s);
}

static bool host_statistic(void *ctx, const char *key, double *value)
{
  Job *j = ctx;
  static const char *const quality[] = {"MinQuality", "AvgQuality", "MaxQuality"};
  if (!j->mesh) return false;
  if (strcmp(key, "NbNodes") == 0)
    *value = (double)j->mesh->nnode;
  else if (strcmp(key, "NbTriangles") == 0)
    *value = (double)mesh_count_corners(j->mesh, 3);
  else if (strcmp(key, "NbQuadrangles") == 0)
    *value = (double)mesh_count_corners(j->mesh, 4);
  else if (strcmp(key, "CpuTime") == 0)
    *value = time_cpu();
  else {
    size_t i = 0;
    while (i < ARRAY_LEN(quality) && strcmp(key, quality[i]) != 0) i++;
    if (i == ARRAY_LEN(quality)) return false;
    double q[3];
    qualities(j->mesh, q);
    *value = q[i];
  }
  return true;
}

static bool host_system(void *ctx, const char *command, SrcLoc loc)
{
  Job *j = ctx;
  fflush(j->out);
  if (system(command) == 0) return true;
  diag_warning(j->diag, loc, "the command failed: %s", command);
  return true;
}

ScriptHost host_of_job(Job *j)
{
  return (ScriptHost){.ctx = j, .mesh = host_mesh, .save = host_save, .print = host_print, .statistic = host_statistic,
                      .system = j->cli->allow_system ? host_system : NULL};
}
