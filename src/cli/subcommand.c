// subcommand.c - meshgen check, hash and diff: what is done with meshes that exist
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/subcommand.h"

#include "mesh/mesh_check.h"
#include "mesh/mesh_hash.h"
#include "out/formats.h"

// The words after the subcommand that are not switches.
typedef struct {
  int argc;
  char **argv;
  Diag *diag;
} Words;

static int read_status(ExitCode s) { return s == EXIT_GOOD ? EXIT_INPUT : (int)s; }

static int check_one(const char *path, Diag *diag)
{
  ExitCode status = EXIT_GOOD;
  Mesh *m = out_read(path, NULL, diag, &status);
  if (!m) return read_status(status);
  MeshReport report = {0};
  bool good = mesh_check(m, false, &report);
  for (size_t i = 0; i < report.finding.len; i++) {
    const MeshFinding *f = &report.finding.data[i];
    char text[400];
    mesh_finding_print(f, text, sizeof text);
    printf("%s: %s: %s\n", path, f->warning ? "warning" : "error", text);
  }
  printf("%s: %zu nodes, %zu lines, %zu surface elements: ", path, m->nnode, mesh_count(m, 1), mesh_count(m, 2));
  if (report.errors || report.warnings)
    printf("%zu errors, %zu warnings\n", report.errors, report.warnings);
  else
    printf("valid\n");
  mesh_report_free(&report);
  mesh_free(m);
  return good ? EXIT_GOOD : EXIT_INPUT;
}

static int hash_one(const char *path, Diag *diag)
{
  ExitCode status = EXIT_GOOD;
  Mesh *m = out_read(path, NULL, diag, &status);
  if (!m) return read_status(status);
  MeshHash h = mesh_hash(m, false);
  char text[MESH_HASH_TEXT];
  mesh_hash_print(h.full, text);
  printf("%s  %s\n", text, path);
  mesh_free(m);
  return EXIT_GOOD;
}

static int each_file(const Words *w, const char *usage, int (*one)(const char *, Diag *))
{
  int worst = EXIT_GOOD;
  if (w->argc == 0) {
    diag_error(w->diag, NO_LOC, "usage: %s", usage);
    return EXIT_USAGE;
  }
  for (int i = 0; i < w->argc; i++) {
    if (w->argv[i][0] == '-' && w->argv[i][1]) {
      diag_error(w->diag, NO_LOC, "unknown switch '%s'; usage: %s", w->argv[i], usage);
      return EXIT_USAGE;
    }
    int s = one(w->argv[i], w->diag);
    if (s > worst) worst = s;
  }
  return worst;
}

static int run_check(const Words *w) { return each_file(w, "meshgen check file.msh ...", check_one); }
static int run_hash(const Words *w) { return each_file(w, "meshgen hash file.msh ...", hash_one); }

static const struct {
  const char *name;
  int (*run)(const Words *);
} subcommands[] = {{"check", run_check}, {"hash", run_hash}};

bool subcommand_run(int argc, char **argv, Diag *diag, int *status)
{
  for (size_t i = 0; argc > 1 && i < ARRAY_LEN(subcommands); i++) {
    if (strcmp(argv[1], subcommands[i].name) != 0) continue;
    Words w = {argc - 2, argv + 2, diag};
    *status = subcommands[i].run(&w);
    return true;
  }
  return false;
}
