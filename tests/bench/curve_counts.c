// curve_counts.c - mesh the curves of .geo files; print total edges, or with -v the count of every curve
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/stats.h"
#include "mesh/mesh1d.h"
#include "script/script.h"

// `Mesh 1;` and its kin in a script: counts are all we want.
static bool ignore_mesh(void *ctx, MeshCommand what, double number, const char *text, SrcLoc loc)
{
  (void)ctx, (void)what, (void)number, (void)text, (void)loc;
  return true;
}

static bool ignore_save(void *ctx, const char *path, SrcLoc loc)
{
  (void)ctx, (void)path, (void)loc;
  return true;
}

static int run(const char *path, bool verbose)
{
  Diag *diag = diag_new(true);
  Model *m = model_new();
  Options o;
  options_init(&o);
  FieldSet *f = fields_new();
  ScriptHost host = {.mesh = ignore_mesh, .save = ignore_save};
  Script *s = script_new(m, &o, f, diag, &host);
  double t0 = time_cpu();
  script_run_file(s, path);
  bool good = diag_errors(diag) == 0 && model_prepare(m, o.Geometry_Tolerance, diag);
  double t1 = time_cpu();
  SizeField *size = good ? size_new(m, &o, f, diag) : NULL;
  double t2 = time_cpu();
  Mesh1d *g = size ? mesh1d_new(m, &o, size, diag) : NULL;
  double t3 = time_cpu();
  size_t total = 0;
  for (size_t k = 0; g && k < g->ncurve; k++) {
    if (g->curve[k].n) total += g->curve[k].n - 1;
    if (verbose) printf("%d %d\n", model_curve_at(m, k)->tag, g->curve[k].n ? (int)g->curve[k].n - 1 : 0);
  }
  if (g && g->rounds) printf("%u rounds, %u edges halved\n", g->rounds, g->nsplit);
  if (g) printf("%s %zu edges, read %.3f size %.3f mesh %.3f s\n", path, total, t1 - t0, t2 - t1, t3 - t2);
  else printf("%s failed\n", path);
  mesh1d_free(g);
  size_free(size);
  script_free(s);
  fields_free(f);
  options_free(&o);
  model_free(m);
  diag_free(diag);
  return g == NULL;
}

int main(int argc, char **argv)
{
  bool verbose = argc > 1 && !strcmp(argv[1], "-v");
  int bad = 0;
  for (int i = 1 + verbose; i < argc; i++) bad += run(argv[i], verbose);
  return bad != 0;
}
