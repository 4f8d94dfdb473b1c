// subcommand.c - meshgen check, hash and diff: what is done with meshes that exist
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/subcommand.h"

#include <unistd.h>

#include "base/json.h"
#include "base/number.h"
#include "base/str.h"
#include "cli/report.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_diff.h"
#include "mesh/mesh_hash.h"
#include "out/formats.h"

// The words after the subcommand that are not switches.
typedef struct {
  int argc;
  char **argv;
  Diag *diag;
  bool json, parts;
} Words;

static int read_status(ExitCode s) { return s == EXIT_GOOD ? EXIT_INPUT : (int)s; }

static void check_text(const char *path, const Mesh *m, const MeshReport *r)
{
  for (size_t i = 0; i < r->finding.len; i++) {
    const MeshFinding *f = &r->finding.data[i];
    char text[400];
    mesh_finding_print(f, text, sizeof text);
    printf("%s: %s: %s\n", path, f->warning ? "warning" : "error", text);
  }
  printf("%s: %zu nodes, %zu lines, %zu surface elements: ", path, m->nnode, mesh_count(m, 1), mesh_count(m, 2));
  if (r->errors || r->warnings)
    printf("%zu errors, %zu warnings\n", r->errors, r->warnings);
  else
    printf("valid\n");
}

static void json_finding(Json *j, const MeshFinding *f)
{
  json_begin(j, NULL, '{');
  json_string(j, "rule", mesh_rule_name(f->rule));
  json_string(j, "kind", f->warning ? "warning" : "error");
  json_integer(j, "dim", f->dim);
  json_integer(j, "tag", f->tag);
  json_integer(j, "element", (long long)f->element);
  json_begin(j, "at", '[');
  json_number(j, NULL, f->at.x);
  json_number(j, NULL, f->at.y);
  json_number(j, NULL, f->at.z);
  json_end(j, ']');
  json_string(j, "text", f->text);
  json_end(j, '}');
}

static void check_json(const char *path, const Mesh *m, const MeshReport *r)
{
  Json j = {0};
  json_begin(&j, NULL, '{');
  json_integer(&j, "report_version", REPORT_VERSION);
  json_string(&j, "file", path);
  json_bool(&j, "valid", r->errors == 0);
  json_integer(&j, "nodes", (long long)m->nnode);
  json_integer(&j, "lines", (long long)mesh_count(m, 1));
  json_integer(&j, "surface_elements", (long long)mesh_count(m, 2));
  json_integer(&j, "errors", (long long)r->errors);
  json_integer(&j, "warnings", (long long)r->warnings);
  json_begin(&j, "findings", '[');
  for (size_t i = 0; i < r->finding.len; i++) json_finding(&j, &r->finding.data[i]);
  json_end(&j, ']');
  json_end(&j, '}');
  printf("%s\n", str_text(&j.out));
  str_free(&j.out);
}

static int check_one(const char *path, const Words *w)
{
  ExitCode status = EXIT_GOOD;
  Mesh *m = out_read(path, NULL, 0, w->diag, &status);
  if (!m) return read_status(status);
  MeshReport report = {0};
  bool good = mesh_check(m, false, &report);
  (w->json ? check_json : check_text)(path, m, &report);
  mesh_report_free(&report);
  mesh_free(m);
  return good ? EXIT_GOOD : EXIT_INPUT;
}

static int hash_one(const char *path, const Words *w)
{
  ExitCode status = EXIT_GOOD;
  Mesh *m = out_read(path, NULL, 0, w->diag, &status);
  if (!m) return read_status(status);
  MeshHash h = mesh_hash(m, false);
  char text[MESH_HASH_TEXT];
  mesh_hash_print(h.full, text);
  printf("%s", text);
  if (w->parts) {
    mesh_hash_print(h.groups, text);
    printf(" %s", text);
    mesh_hash_print(h.shape, text);
    printf(" %s", text);
  }
  printf("  %s\n", path);
  mesh_free(m);
  return EXIT_GOOD;
}

static bool is_word(const char *word, const char *sw)
{
  return word[0] == '-' && strcmp(word + (word[1] == '-' ? 2 : 1), sw) == 0;
}

static int each_file(Words *w, const char *usage, int (*one)(const char *, const Words *))
{
  int worst = EXIT_GOOD, files = 0;
  bool may_json = one == check_one, words_only = false;
  const char **file = mem_alloc((size_t)w->argc * sizeof *file), *bad = NULL;
  for (int i = 0; i < w->argc && !bad; i++) {
    const char *word = w->argv[i];
    if (words_only || word[0] != '-' || !word[1])
      file[files++] = word;
    else if (strcmp(word, "--") == 0)
      words_only = true;
    else if (may_json && is_word(word, "json"))
      w->json = true;
    else if (!may_json && is_word(word, "parts"))
      w->parts = true;
    else
      bad = word;
  }
  if (bad || !files) {
    if (bad)
      diag_error(w->diag, NO_LOC, "unknown switch '%s'; usage: %s", bad, usage);
    else
      diag_error(w->diag, NO_LOC, "usage: %s", usage);
    worst = EXIT_USAGE;
  }
  for (int i = 0; i < files && !bad; i++) {
    int status = one(file[i], w);
    if (status > worst) worst = status;
  }
  free(file);
  return worst;
}

// ---- diff: exits as diff(1) does --------------------------------------------------------------------------------------------
enum { DIFF_EXIT_SAME = 0, DIFF_EXIT_DIFFERENT = 1, DIFF_EXIT_TROUBLE = 2 };

typedef struct {
  const char *file[2];
  const char *picture; // or NULL
  double tol;
  bool json;
} DiffRequest;

static bool parse_diff(const Words *w, DiffRequest *r)
{
  int files = 0;
  for (int i = 0; i < w->argc; i++) {
    const char *word = w->argv[i];
    const char *sw = word[0] == '-' && word[1] ? word + (word[1] == '-' ? 2 : 1) : NULL;
    bool has_next = i + 1 < w->argc;
    if (!sw && files < 2)
      r->file[files++] = word;
    else if (sw && strcmp(sw, "json") == 0)
      r->json = true;
    else if (sw && strcmp(sw, "o") == 0 && has_next)
      r->picture = w->argv[++i];
    else if (sw && strcmp(sw, "tol") == 0 && has_next) {
      const char *t = w->argv[++i], *end = t + strlen(t);
      if (number_read(t, end, &r->tol) != end || !(r->tol >= 0)) return false;
    } else
      return false;
  }
  return files == 2;
}

static void diff_text(const MeshDiff *d)
{
  static const char *const dims[] = {"point", "curve", "surface"};
  printf("nodes: %zu and %zu, %zu and %zu without a partner, %zu moved\n", d->nodes[0], d->nodes[1], d->alone[0], d->alone[1],
         d->moved);
  if (d->moved)
    printf("moved: %g at most, from (%.9g, %.9g, %.9g) to (%.9g, %.9g, %.9g) on %s %d; %g on average\n", d->largest, d->from.x,
           d->from.y, d->from.z, d->to.x, d->to.y, d->to.z, dims[d->moved_dim], d->moved_tag, d->mean);
  printf("elements: %zu and %zu changed\n", d->nchanged[0], d->nchanged[1]);
  for (size_t i = 0; i < d->group.len; i++) {
    const GroupDiff *g = &d->group.data[i];
    const char *name = g->name[1] ? g->name[1] : g->name[0];
    printf("group of %ss %d%s%s%s: %s; elements %zu and %zu, size %.9g and %.9g\n", dims[g->dim], g->tag[1] ? g->tag[1] : g->tag[0],
           name ? " '" : "", name ? name : "", name ? "'" : "", mesh_diff_change(g->change), g->elements[0], g->elements[1],
           g->size[0], g->size[1]);
  }
  for (size_t i = 0; i < d->entity.len; i++) {
    const EntityDiff *e = &d->entity.data[i];
    printf("%s %d: elements %zu and %zu, %zu and %zu changed; size %.9g and %.9g; %zu nodes moved, %g at most", dims[e->dim], e->tag,
           e->elements[0], e->elements[1], e->changed[0], e->changed[1], e->size[0], e->size[1], e->moved, e->largest);
    if (e->dim == 2) printf("; least quality %.4f and %.4f", e->quality[0], e->quality[1]);
    putchar('\n');
  }
}

static void json_two(Json *j, const char *name, double a, double b)
{
  json_begin(j, name, '[');
  json_number(j, NULL, a);
  json_number(j, NULL, b);
  json_end(j, ']');
}

static void diff_json(const MeshDiff *d)
{
  static const char *const verdicts[] = {"same", "within", "different"};
  Json j = {0};
  json_begin(&j, NULL, '{');
  json_integer(&j, "report_version", REPORT_VERSION);
  json_string(&j, "verdict", verdicts[d->verdict]);
  json_begin(&j, "hash", '[');
  for (int i = 0; i < 2; i++) {
    char text[MESH_HASH_TEXT];
    mesh_hash_print(d->hash[i].full, text);
    json_string(&j, NULL, text);
  }
  json_end(&j, ']');
  json_two(&j, "nodes", (double)d->nodes[0], (double)d->nodes[1]);
  json_two(&j, "nodes_without_partner", (double)d->alone[0], (double)d->alone[1]);
  json_integer(&j, "nodes_moved", (long long)d->moved);
  json_number(&j, "largest_move", d->largest);
  json_number(&j, "mean_move", d->mean);
  json_two(&j, "elements_changed", (double)d->nchanged[0], (double)d->nchanged[1]);
  json_begin(&j, "groups", '[');
  for (size_t i = 0; i < d->group.len; i++) {
    const GroupDiff *g = &d->group.data[i];
    json_begin(&j, NULL, '{');
    json_integer(&j, "dim", g->dim);
    json_two(&j, "tag", g->tag[0], g->tag[1]);
    json_string(&j, "name_before", g->name[0]);
    json_string(&j, "name_after", g->name[1]);
    json_string(&j, "change", mesh_diff_change(g->change));
    json_two(&j, "elements", (double)g->elements[0], (double)g->elements[1]);
    json_two(&j, "size", g->size[0], g->size[1]);
    json_end(&j, '}');
  }
  json_end(&j, ']');
  json_begin(&j, "entities", '[');
  for (size_t i = 0; i < d->entity.len; i++) {
    const EntityDiff *e = &d->entity.data[i];
    json_begin(&j, NULL, '{');
    json_integer(&j, "dim", e->dim);
    json_integer(&j, "tag", e->tag);
    json_two(&j, "elements", (double)e->elements[0], (double)e->elements[1]);
    json_two(&j, "changed", (double)e->changed[0], (double)e->changed[1]);
    json_two(&j, "size", e->size[0], e->size[1]);
    json_integer(&j, "nodes_moved", (long long)e->moved);
    json_number(&j, "largest_move", e->largest);
    if (e->dim == 2) json_two(&j, "least_quality", e->quality[0], e->quality[1]);
    json_end(&j, '}');
  }
  json_end(&j, ']');
  json_end(&j, '}');
  printf("%s\n", str_text(&j.out));
  str_free(&j.out);
}

static int diff_meshes(const DiffRequest *r, const Mesh *a, const Mesh *b, Diag *diag)
{
  static const char *const verdicts[] = {"the same mesh", "the same mesh within the tolerance", "different meshes"};
  MeshDiff d = {0};
  mesh_diff_make(&d, a, b, r->tol);
  int status = d.verdict == DIFF_DIFFERENT ? DIFF_EXIT_DIFFERENT : DIFF_EXIT_SAME;
  if (r->json) {
    diff_json(&d);
  } else {
    printf("%s and %s: %s%s\n", r->file[0], r->file[1], verdicts[d.verdict],
           d.verdict == DIFF_SAME && !d.same_numbering ? ", numbered differently" : "");
    if (d.verdict != DIFF_SAME) diff_text(&d);
  }
  if (r->picture && out_write_diff(a, b, &d, r->picture, &(OutOptions){0}, diag) != EXIT_GOOD) status = DIFF_EXIT_TROUBLE;
  mesh_diff_free(&d);
  return status;
}

static int run_diff(Words *w)
{
  DiffRequest r = {0};
  if (!parse_diff(w, &r)) {
    diag_error(w->diag, NO_LOC, "usage: meshgen diff a.msh b.msh [-tol t] [-json] [-o picture]");
    return DIFF_EXIT_TROUBLE;
  }
  ExitCode read = EXIT_GOOD;
  Mesh *a = out_read(r.file[0], NULL, 0, w->diag, &read);
  Mesh *b = a ? out_read(r.file[1], NULL, 0, w->diag, &read) : NULL;
  int status = a && b ? diff_meshes(&r, a, b, w->diag) : DIFF_EXIT_TROUBLE;
  mesh_free(a);
  mesh_free(b);
  return status;
}

static int run_check(Words *w) { return each_file(w, "meshgen check [-json] file.msh ...", check_one); }
static int run_hash(Words *w) { return each_file(w, "meshgen hash [-parts] file.msh ...", hash_one); }

static const struct {
  const char *name;
  int (*run)(Words *);
} subcommands[] = {{"check", run_check}, {"hash", run_hash}, {"diff", run_diff}};

// A first word that is no file but nearly a subcommand, with words to follow.
static bool misspelt(const char *word, Diag *diag)
{
  const char *names[ARRAY_LEN(subcommands)];
  for (size_t i = 0; i < ARRAY_LEN(subcommands); i++) names[i] = subcommands[i].name;
  const char *near = strchr(word, '.') || access(word, F_OK) == 0 ? NULL : str_nearest(word, names, ARRAY_LEN(names));
  if (near) diag_error(diag, NO_LOC, "unknown subcommand '%s'; did you mean 'meshgen %s'?", word, near);
  return near != NULL;
}

bool subcommand_run(int argc, char **argv, Diag *diag, int *status)
{
  for (size_t i = 0; argc > 1 && i < ARRAY_LEN(subcommands); i++) {
    if (strcmp(argv[1], subcommands[i].name) != 0) continue;
    Words w = {argc - 2, argv + 2, diag, false, false};
    *status = subcommands[i].run(&w);
    return true;
  }
  *status = EXIT_USAGE;
  return argc > 2 && misspelt(argv[1], diag);
}
