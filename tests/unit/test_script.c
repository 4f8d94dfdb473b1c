// test_script.c - runs tests/script/*/*.geo and compares what they print and report with their `// expect`
// comments SPDX-License-Identifier: MIT
//
//   Printf("%g", 1+1);     // expect: 2
//   x = y;                 // expect error: unknown variable 'y'
//   // expect warning: ..., // expect note: ... likewise; the text need only be contained in the message of
//   that line
//   // prepare for meshing: also what is said when the model is checked as a whole
//   // expect model: points 4, curves 4, loops 1, faces 1, volumes 0, groups 0      (at the end of the run)
//   // given number NAME 3  (before the run: -setnumber), given string NAME TEXT, given list NAME 1 2 3,
//   given text GEO-TEXT
//
// Printed lines are compared in order. Whatever is not announced fails. With arguments: runs these files
// only.
#include "base/base.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/str.h"
#include "model/model_edit.h"
#include "script/script.h"
#include "size/field.h"

typedef enum { EXPECT_PRINT, EXPECT_ERROR, EXPECT_WARNING, EXPECT_NOTE, EXPECT_MODEL } ExpectKind;

typedef struct {
  ExpectKind kind;
  uint32_t line;
  char *text;
  bool met;
} Expect;

typedef struct {
  Vec(char *) printed;
  Vec(Expect) expect;
} Case;

static int tests, failures;

static void result(bool ok, const char *path, uint32_t line, const char *what)
{
  printf("%s %d - %s:%u %s\n", ok ? "ok" : "not ok", ++tests, path, line, what);
  failures += !ok;
}

// ---- the host: everything asked for is printed in brackets ---------------------------------------------

static void record(Case *c, const char *text) { vec_push(&c->printed, mem_strdup(text)); }

static void host_print(void *ctx, const char *text) { record(ctx, text); }

static bool host_mesh(void *ctx, MeshCommand what, double number, const char *text, SrcLoc loc)
{
  static const char *const names[] = {"generate",  "refine",   "barycentric",    "recombine",
                                      "order",     "optimize", "renumber nodes", "renumber elements",
                                      "partition", "delete"};
  (void)loc;
  char line[200];
  snprintf(line, sizeof line, "[%s %g%s]", names[what], number, text);
  record(ctx, line);
  return true;
}

static const char *base_name(const char *path)
{
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

static bool host_save(void *ctx, const char *path, SrcLoc loc)
{
  (void)loc;
  char line[200];
  snprintf(line, sizeof line, "[save %s]", base_name(path));
  record(ctx, line);
  return true;
}

static bool host_merge(void *ctx, const char *path, SrcLoc loc)
{
  (void)loc;
  char line[200];
  snprintf(line, sizeof line, "[merge %s]", base_name(path));
  record(ctx, line);
  return true;
}

static bool host_statistic(void *ctx, const char *key, double *value)
{
  (void)ctx;
  *value = 42;
  return !strcmp(key, "NbNodes");
}

// ---- expectations ---------------------------------------------

static void read_expectations(Case *c, const char *text)
{
  static const struct {
    const char *mark;
    ExpectKind kind;
  } marks[] = {{"// expect: ", EXPECT_PRINT},
               {"// expect error: ", EXPECT_ERROR},
               {"// expect warning: ", EXPECT_WARNING},
               {"// expect note: ", EXPECT_NOTE},
               {"// expect model: ", EXPECT_MODEL}};
  uint32_t line = 1;
  for (const char *p = text; *p; line++) {
    const char *eol = strchr(p, '\n');
    size_t len = eol ? (size_t)(eol - p) : strlen(p);
    char *copy = mem_alloc(len + 1);
    memcpy(copy, p, len);
    copy[len] = 0;
    if (len && copy[len - 1] == '\r') copy[len - 1] = 0;
    for (char *hit = strstr(copy, "// expect"); hit;) { // several on a line are possible
      char *next = strstr(hit + 1, " // expect");
      if (next) *next++ = 0;
      for (size_t i = 0; i < ARRAY_LEN(marks); i++) {
        size_t n = strlen(marks[i].mark);
        if (strncmp(hit, marks[i].mark, n) != 0) continue;
        Expect e = {marks[i].kind, line, mem_strdup(hit + n), false};
        vec_push(&c->expect, e);
      }
      hit = next;
    }
    free(copy);
    p += len + (eol != NULL);
  }
}

static void apply_given(Script *s, const char *text)
{
  for (const char *p = strstr(text, "// given "); p; p = strstr(p + 1, "// given ")) {
    char kind[20], name[100], rest[400] = "";
    if (sscanf(p, "// given %19s %99s %399[^\n]", kind, name, rest) < 2) continue;
    if (!strcmp(kind, "number")) script_set_number(s, name, strtod(rest, NULL));
    if (!strcmp(kind, "string")) script_set_string(s, name, rest);
    if (!strcmp(kind, "list")) {
      double v[16];
      size_t n = 0;
      char *q = rest, *next;
      for (double x; n < 16 && (x = strtod(q, &next), next != q); q = next) v[n++] = x;
      script_set_list(s, name, v, n);
    }
    if (!strcmp(kind, "text")) {
      Str all = {0};
      str_printf(&all, "%s %s", name, rest);
      script_run_text(s, "given", str_text(&all), all.len);
      script_forget_variables(s);
      str_free(&all);
    }
  }
}

static void check_printed(Case *c, const char *path)
{
  size_t at = 0;
  for (size_t i = 0; i < c->expect.len; i++) {
    Expect *e = &c->expect.data[i];
    if (e->kind != EXPECT_PRINT) continue;
    const char *got = at < c->printed.len ? c->printed.data[at] : "(nothing)";
    e->met = !strcmp(got, e->text);
    if (!e->met) printf("# expected \"%s\", printed \"%s\"\n", e->text, got);
    result(e->met, path, e->line, e->text);
    at++;
  }
  for (; at < c->printed.len; at++) {
    printf("# not announced: \"%s\"\n", c->printed.data[at]);
    result(false, path, 0, "printed more than announced");
  }
}

static void check_messages(Case *c, const char *path, const Diag *diag)
{
  static const ExpectKind kind_of[] = {EXPECT_NOTE, EXPECT_WARNING, EXPECT_ERROR};
  for (size_t k = 0; k < diag_count(diag); k++) {
    const DiagMessage *m = diag_get(diag, k);
    Expect *e = NULL;
    for (size_t i = 0; i < c->expect.len && !e; i++) {
      Expect *x = &c->expect.data[i];
      if (x->kind == kind_of[m->kind] && !x->met && x->line == m->loc.line && strstr(m->text, x->text)) e = x;
    }
    if (e) {
      e->met = true;
      printf("# said: %s\n", m->text); // read by tests/script/run_messages.sh
      result(true, path, e->line, e->text);
      continue;
    }
    printf("# line %u col %u: %s\n", m->loc.line, m->loc.col, m->text);
    result(false, path, m->loc.line, "message not announced");
  }
  for (size_t i = 0; i < c->expect.len; i++) {
    const Expect *e = &c->expect.data[i];
    if (e->kind >= EXPECT_ERROR && e->kind <= EXPECT_NOTE && !e->met) result(false, path, e->line, e->text);
  }
}

static void check_model(Case *c, const char *path, const Model *m)
{
  for (size_t i = 0; i < c->expect.len; i++) {
    const Expect *e = &c->expect.data[i];
    if (e->kind != EXPECT_MODEL) continue;
    static const char *const kinds[] = {"points", "curves", "loops", "faces", "volumes", "groups"};
    const size_t counts[] = {model_points(m), model_curves(m),  model_loops(m),
                             model_faces(m),  model_volumes(m), model_groups(m)};
    bool ok = true;
    for (size_t k = 0; k < ARRAY_LEN(kinds); k++) {
      const char *hit = strstr(e->text, kinds[k]);
      if (!hit) continue;
      size_t want = (size_t)strtol(hit + strlen(kinds[k]), NULL, 10);
      if (want == counts[k]) continue;
      printf("# expected %zu %s, got %zu\n", want, kinds[k], counts[k]);
      ok = false;
    }
    result(ok, path, e->line, e->text);
  }
}

static void run_case(const char *path)
{
  size_t len;
  char *text = file_read(path, &len);
  if (!text) {
    result(false, path, 0, "cannot be read");
    return;
  }
  Case c = {0};
  read_expectations(&c, text);
  Model *model = model_new();
  Options options;
  options_init(&options);
  FieldSet *fields = fields_new();
  Diag *diag = diag_new(false);
  ScriptHost host = {.ctx = &c,
                     .mesh = host_mesh,
                     .save = host_save,
                     .merge = host_merge,
                     .print = host_print,
                     .statistic = host_statistic};
  Script *s = script_new(model, &options, fields, diag, &host);
  apply_given(s, text);
  if (script_run_file(s, path) == SCRIPT_EXIT) {
    char line[40];
    snprintf(line, sizeof line, "[exit %d]", script_exit_code(s));
    record(&c, line);
  }
  if (strstr(text, "// prepare for meshing")) model_prepare(model, 1e-8, diag);
  check_printed(&c, path);
  check_messages(&c, path, diag);
  check_model(&c, path, model);
  script_free(s);
  diag_free(diag);
  fields_free(fields);
  options_free(&options);
  model_free(model);
  for (size_t i = 0; i < c.printed.len; i++) free(c.printed.data[i]);
  for (size_t i = 0; i < c.expect.len; i++) free(c.expect.data[i].text);
  vec_free(&c.printed);
  vec_free(&c.expect);
  free(text);
}

// A file of trees: the source, a line "---", and what script_dump_ast makes of it.
static void run_tree(const char *path)
{
  size_t len;
  char *text = file_read(path, &len), *mark = text ? strstr(text, "\n---\n") : NULL;
  if (!mark) {
    result(false, path, 0, "has no line ---");
    free(text);
    return;
  }
  Diag *diag = diag_new(false);
  Str out = {0};
  script_dump_ast(diag, path, text, (size_t)(mark - text) + 1, &out);
  bool same = !strcmp(str_text(&out), mark + 5);
  if (!same) printf("# got:\n%s# expected:\n%s", str_text(&out), mark + 5);
  result(same && !diag_errors(diag), path, 1, "the tree");
  str_free(&out);
  diag_free(diag);
  free(text);
}

static void run_folder(const char *dir)
{
  struct dirent **entry;
  int n = scandir(dir, &entry, NULL, alphasort);
  for (int i = 0; i < n; i++) {
    const char *name = entry[i]->d_name;
    size_t len = strlen(name);
    Str path = {0};
    str_printf(&path, "%s/%s", dir, name);
    struct stat st;
    if (name[0] != '.' && name[0] != '_' && stat(str_text(&path), &st) == 0) {
      if (S_ISDIR(st.st_mode))
        run_folder(str_text(&path));
      else if (len > 4 && !strcmp(name + len - 4, ".geo"))
        run_case(str_text(&path));
      else if (len > 4 && !strcmp(name + len - 4, ".ast"))
        run_tree(str_text(&path));
    }
    str_free(&path);
    free(entry[i]);
  }
  if (n >= 0) free(entry);
}

int main(int argc, char **argv)
{
  const char *root = getenv("ROOT");
  if (root && chdir(root) != 0) return 1;
  for (int i = 1; i < argc; i++) run_case(argv[i]);
  if (argc == 1) run_folder("tests/script");
  printf("1..%d\n", tests);
  return failures > 0;
}
