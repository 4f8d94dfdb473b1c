// cli.c - the command line: words to a Cli, driven by the tables of commands.def and options.def
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/cli.h"

#include <unistd.h>

#include "base/number.h"
#include "base/str.h"

typedef struct {
  Cli *c;
  int argc, at;
  char **argv;
  Diag *diag;
  ExitCode status;
} Walk;

static void usage_error(Walk *w, const char *fmt, const char *a, const char *b)
{
  Str s = {0};
  for (const char *p = fmt; *p; p++) {
    if (*p == '%')
      str_append(&s, a), a = b;
    else
      str_char(&s, *p);
  }
  diag_error(w->diag, NO_LOC, "%s", str_text(&s));
  str_free(&s);
  w->status = EXIT_USAGE;
}

static const char *next_word(Walk *w, const char *sw)
{
  if (w->at + 1 >= w->argc) {
    usage_error(w, "-% needs an argument; see meshgen -help", sw, "");
    return NULL;
  }
  return w->argv[++w->at];
}

static bool next_number(Walk *w, const char *sw, double *value)
{
  const char *s = next_word(w, sw);
  if (!s) return false;
  const char *end = s + strlen(s);
  if (*s && number_read(s, end, value) == end) return true;
  usage_error(w, "-% needs a number, not '%'", sw, s);
  return false;
}

static void set_option(Walk *w, const OptRow *row, double value)
{
  if (!options_set_number(&w->c->options, row, value, NO_LOC, w->diag) && w->status == EXIT_GOOD)
    w->status = EXIT_INPUT;
}

static void set_named(Walk *w, const char *key, double value)
{
  set_option(w, options_find("Mesh", key), value);
}

// -setnumber/-setstring NAME V: an option when the name has a dot, otherwise something of the script.
static void set_name(Walk *w, bool number)
{
  const char *name = next_word(w, number ? "setnumber" : "setstring");
  if (!name) return;
  double value = 0;
  const char *text = NULL;
  if (number ? !next_number(w, "setnumber", &value) : !(text = next_word(w, "setstring"))) return;
  const char *dot = strchr(name, '.');
  if (dot && !strchr(name, '/') && !strchr(name, '[')) {
    char category[64];
    snprintf(category, sizeof category, "%.*s", (int)(dot - name), name);
    const OptRow *row = options_find(category, dot + 1);
    if (!row) {
      const char *key = options_nearest(category, dot + 1);
      char near[160];
      snprintf(near, sizeof near, "%s.%s", category, key ? key : "");
      usage_error(w, key ? "unknown option '%'; did you mean '%'?" : "unknown option '%'", name, near);
      return;
    }
    if (number)
      set_option(w, row, value);
    else if (!options_set_string(&w->c->options, row, text, NO_LOC, w->diag))
      w->status = EXIT_INPUT;
    return;
  }
  Setting s = {.kind = number ? SETTING_NUMBER : SETTING_STRING, .name = name, .text = text, .n = number};
  if (number) {
    s.value = mem_alloc(sizeof(double));
    s.value[0] = value;
  }
  vec_push(&w->c->settings, s);
}

static void set_list(Walk *w)
{
  const char *name = next_word(w, "setlist");
  double n = 0;
  if (!name || !next_number(w, "setlist", &n)) return;
  if (!(n >= 0 && n <= w->argc)) {
    usage_error(w, "-setlist %: the number of values must follow the name", name, "");
    return;
  }
  Setting s = {.kind = SETTING_LIST, .name = name, .n = (size_t)n, .value = mem_alloc((size_t)n * sizeof(double))};
  for (size_t i = 0; i < s.n && w->status == EXIT_GOOD; i++) next_number(w, "setlist", &s.value[i]);
  vec_push(&w->c->settings, s);
}

static void add_text(Walk *w, SettingKind kind, const char *sw)
{
  Setting s = {.kind = kind, .text = next_word(w, sw)};
  if (s.text) vec_push(&w->c->settings, s);
}

static void set_algorithm(Walk *w)
{
  const char *name = next_word(w, "algo");
  if (!name) return;
  int n = options_algorithm(name);
  if (!n && name[0] >= '0' && name[0] <= '9') {
    double v = 0;
    if (number_read(name, name + strlen(name), &v) == name + strlen(name)) {
      set_named(w, "Algorithm", v);
      return;
    }
  }
  if (!n)
    usage_error(w, "unknown 2D algorithm '%'; it is one of meshadapt, auto, initial2d, del2d, front2d, delquad, pack", name,
                "");
  else
    set_named(w, "Algorithm", n);
}

// Option of the weight of elements called so; NULL if there are none such. Those of volumes mean nothing here.
static const char *weight_key(const char *name)
{
  static const struct { const char *name, *key; } known[] = {
      {"line", "PartitionLineWeight"}, {"tri", "PartitionTriWeight"}, {"quad", "PartitionQuadWeight"},
      {"tet", "PartitionTetWeight"},   {"hex", "PartitionHexWeight"}, {"pri", "PartitionPrismWeight"},
      {"pyr", "PartitionPyramidWeight"}, {"trih", "PartitionTrihedronWeight"}};
  for (size_t i = 0; i < ARRAY_LEN(known); i++)
    if (strcmp(known[i].name, name) == 0) return known[i].key;
  return NULL;
}

static void set_part_weights(Walk *w)
{
  do {
    const char *name = next_word(w, "part_weight"), *key = name ? weight_key(name) : NULL;
    double v = 0;
    if (!name) return;
    if (!key) {
      usage_error(w, "-part_weight takes line, tri or quad and a number, not '%'", name, "");
      return;
    }
    if (!next_number(w, "part_weight", &v)) return;
    set_named(w, key, v);
  } while (w->at + 1 < w->argc && weight_key(w->argv[w->at + 1]));
}

static void set_color(Walk *w)
{
  static const char *const when[] = {"never", "always", "auto"};
  const char *s = next_word(w, "color");
  for (int i = 0; s && i < 3; i++)
    if (strcmp(s, when[i]) == 0) {
      w->c->color = i;
      return;
    }
  if (s) usage_error(w, "-color takes auto, always or never, not '%'", s, "");
}

static void set_color_by(Walk *w)
{
  const char *s = next_word(w, "color_by");
  if (!s) return;
  Measure what = mesh_measure_find(s);
  if (what < MEASURES) w->c->color_by = 1 + (int)what;
  else if (strcmp(s, "group") == 0) w->c->color_by = 0;
  else if (strcmp(s, "partition") == 0) w->c->color_by = COLOR_BY_PART;
  else usage_error(w, "-color_by takes group, partition, gamma, angle, eta, jacobian or kappa1 to kappa5, not '%'", s, "");
}

// Names of measures with commas between.
static void set_cell_data(Walk *w)
{
  const char *s = next_word(w, "cell_data");
  while (s && *s) {
    char name[16];
    size_t n = strcspn(s, ",");
    snprintf(name, sizeof name, "%.*s", (int)MIN(n, sizeof name - 1), s);
    Measure what = mesh_measure_find(name);
    if (what < MEASURES) w->c->cell_data |= 1u << what;
    else usage_error(w, "-cell_data takes a list of gamma, angle, eta, jacobian and kappa1 to kappa5, not '%'", name, "");
    s += n + (s[n] == ',');
  }
}

// x0,y0,x1,y1: two opposite corners.
static void set_window(Walk *w)
{
  const char *s = next_word(w, "window");
  double *v = w->c->window, x[4];
  char rest;
  if (!s) return;
  if (sscanf(s, "%lf,%lf,%lf,%lf%c", &x[0], &x[1], &x[2], &x[3], &rest) != 4 || !(x[0] != x[2]) || !(x[1] != x[3]) ||
      !isfinite(x[0] + x[1] + x[2] + x[3])) {
    usage_error(w, "-window needs two opposite corners x0,y0,x1,y1, not '%'", s, "");
    return;
  }
  for (int k = 0; k < 2; k++) {
    v[k] = fmin(x[k], x[k + 2]);
    v[k + 2] = fmax(x[k], x[k + 2]);
  }
}

static void next_int(Walk *w, const char *sw, int lo, int hi, int *value)
{
  double v = 0;
  if (!next_number(w, sw, &v)) return;
  if (v >= lo && v <= hi && v == (int)v) {
    *value = (int)v;
    return;
  }
  char range[64];
  snprintf(range, sizeof range, "%d to %d", lo, hi);
  usage_error(w, "-% needs a whole number from %", sw, range);
}

static void positive(Walk *w, const char *sw, double *value, double unit)
{
  double v = 0;
  if (!next_number(w, sw, &v)) return;
  if (v > 0)
    *value = v * unit;
  else
    usage_error(w, "-% needs a positive number", sw, "");
}

static void do_command(Walk *w, CommandId id)
{
  Cli *c = w->c;
  const char *s;
  double v = 0;
  switch (id) {
  case CMD_MESH0: case CMD_MESH1: case CMD_MESH2: case CMD_MESH3: case CMD_SAVE: case CMD_PARSE: case CMD_DUMP_AST: case CMD_REFINE:
  case CMD_BARYCENTRIC: case CMD_DELAUNAY: case CMD_HELP: case CMD_HELP_OPTIONS: case CMD_VERSION: case CMD_INFO:
  case CMD_DUMP_MAN: case CMD_LIST_FORMATS:
    c->action = id;
    c->action_given = true;
    break;
  case CMD_COMPLETION:
    c->action = id;
    c->action_given = true;
    c->shell = next_word(w, "completion");
    break;
  case CMD_VORONOI: c->voronoi = true; break;
  case CMD_INSERTION: c->insertion = true; break;
  case CMD_OUTPUT:
    if ((s = next_word(w, "o")) != NULL) vec_push(&c->outputs, s);
    break;
  case CMD_FORMAT: c->format = next_word(w, "format"); break;
  case CMD_BINARY: set_named(w, "Binary", 1); break;
  case CMD_SAVE_ALL: set_named(w, "SaveAll", 1); break;
  case CMD_SAVE_PARAMETRIC: set_named(w, "SaveParametric", 1); break;
  case CMD_SAVE_TOPOLOGY: set_named(w, "SaveTopology", 1); break;
  case CMD_KEEP_GOING: c->keep_going = true; break;
  case CMD_JSON: c->json = true; break;
  case CMD_REQUIRE:
    if ((s = next_word(w, "require")) != NULL) vec_push(&c->require, s);
    break;
  case CMD_FULL_REPORT: c->full_report = true; break;
  case CMD_NO_REPORT: c->report = false; break;
  case CMD_COLOR_BY: set_color_by(w); break;
  case CMD_CELL_DATA: set_cell_data(w); break;
  case CMD_MARK_WORST: next_int(w, "mark_worst", 0, 50, &c->mark_worst); break;
  case CMD_HISTOGRAM: c->histogram = true; break;
  case CMD_WINDOW: set_window(w); break;
  case CMD_WIDTH: next_int(w, "width", 200, 20000, &c->width); break;
  case CMD_SYNC: c->sync = true; break;
  case CMD_MERGE: c->merge = true; break;
  case CMD_EXPLAIN_SIZE: c->explain = next_word(w, "explain_size"); break;
  case CMD_ALGO: set_algorithm(w); break;
  case CMD_HEAL: set_named(w, "Heal", 1); break;
  case CMD_QUAD:
    set_named(w, "RecombineAll", 1);
    set_named(w, "RecombinationAlgorithm", 2);
    break;
  case CMD_PART_NO_TOPO: set_named(w, "PartitionCreateTopology", 0); break;
  case CMD_PART_NO_GHOSTS: set_named(w, "PartitionCreateGhostCells", 0); break;
  case CMD_PART_NO_PHYSICALS: set_named(w, "PartitionCreatePhysicals", 0); break;
  case CMD_PART_WEIGHT: set_part_weights(w); break;
  case CMD_SETNUMBER: set_name(w, true); break;
  case CMD_SETSTRING: set_name(w, false); break;
  case CMD_SETLIST: set_list(w); break;
  case CMD_STRING: add_text(w, SETTING_TEXT, "string"); break;
  case CMD_OPTION_FILE: add_text(w, SETTING_FILE, "option"); break;
  case CMD_BGM: c->bgm = next_word(w, "bgm"); break;
  case CMD_VERBOSITY:
    if (next_number(w, "v", &v)) set_option(w, options_find("General", "Verbosity"), v);
    break;
  case CMD_LOG: c->log = next_word(w, "log"); break;
  case CMD_COLOR: set_color(w); break;
  case CMD_WERROR: c->werror = true; break;
  case CMD_TIME_LIMIT: positive(w, "time_limit", &c->time_limit, 1); break;
  case CMD_MAX_MEMORY: positive(w, "max_memory", &c->max_memory, 1 << 20); break;
  case CMD_ALLOW_SYSTEM: c->allow_system = true; break;
  case CMD_IGNORED0: break;
  case CMD_IGNORED1: next_word(w, "..."); break;
  case CMD_COUNT: UNREACHABLE();
  }
}

const Command commands[CMD_COUNT] = {
#define GROUP(title)
#define CMD(id, names, nargs, metavar, help) {CMD_##id, names, nargs, metavar, help, NULL},
#include "cli/commands.def"
#undef GROUP
#undef CMD
};

static void unknown_switch(Walk *w, const char *sw)
{
  const char *names[CMD_COUNT + 256];
  char first[CMD_COUNT][32];
  size_t n = 0, nrow;
  for (size_t i = 0; i < CMD_COUNT; i++) {
    if (!commands[i].help[0]) continue;
    snprintf(first[i], sizeof first[i], "%.*s", (int)strcspn(commands[i].names, " "), commands[i].names);
    names[n++] = first[i];
  }
  const OptRow *rows = options_rows(&nrow);
  for (size_t i = 0; i < nrow && n < ARRAY_LEN(names); i++)
    if (rows[i].sw[0]) names[n++] = rows[i].sw;
  const char *near = str_nearest(sw, names, n);
  usage_error(w, near ? "unknown switch '-%'; did you mean '-%'?" : "unknown switch '-%'; see meshgen -help", sw, near);
}

static void do_switch(Walk *w, const char *sw)
{
  for (size_t i = 0; i < CMD_COUNT; i++)
    if (str_has_word(commands[i].names, sw)) {
      do_command(w, commands[i].id);
      return;
    }
  const OptRow *row = options_find_switch(sw);
  if (!row) {
    unknown_switch(w, sw);
    return;
  }
  double v = 1;
  if (row->metavar[0] && !next_number(w, sw, &v)) return;
  set_option(w, row, v);
}

static bool is_switch(const char *name)
{
  for (size_t i = 0; i < CMD_COUNT; i++)
    if (commands[i].help[0] && str_has_word(commands[i].names, name)) return true;
  return options_find_switch(name) != NULL;
}

// A word that is neither a file nor looks like one: a switch without its dash, or an argument of one that takes none, as the 2 of
// -optimize 2. What looks like a file is an input, and is missed when it is read.
static void take_input(Walk *w, const char *word)
{
  const char *before = w->argv[w->at - 1];
  double number;
  if (!*word)
    usage_error(w, "an empty word is no input file", "", "");
  else if (strpbrk(word, "./") || access(word, F_OK) == 0)
    vec_push(&w->c->inputs, word);
  else if (w->at > 1 && before[0] == '-' && before[1] && *number_read(word, word + strlen(word), &number) == 0)
    usage_error(w, "% takes no number, and there is no file '%'", before, word);
  else if (is_switch(word))
    usage_error(w, "there is no file '%'; did you mean -%?", word, word);
  else
    vec_push(&w->c->inputs, word);
}

ExitCode cli_parse(Cli *c, int argc, char **argv, Diag *diag)
{
  *c = (Cli){.action = CMD_MESH2, .report = true, .color = 2};
  options_init(&c->options);
  Walk w = {c, argc, 1, argv, diag, EXIT_GOOD};
  bool words_only = false;
  for (; w.at < argc && w.status != EXIT_USAGE; w.at++) {
    const char *word = argv[w.at];
    if (words_only || strcmp(word, "-") == 0)
      vec_push(&c->inputs, word);
    else if (word[0] != '-')
      take_input(&w, word);
    else if (strcmp(word, "--") == 0)
      words_only = true;
    else
      do_switch(&w, word + (word[1] == '-' ? 2 : 1));
  }
  return w.status;
}

void cli_free(Cli *c)
{
  for (size_t i = 0; i < c->settings.len; i++) free(c->settings.data[i].value);
  vec_free(&c->settings);
  vec_free(&c->inputs);
  vec_free(&c->outputs);
  vec_free(&c->require);
  options_free(&c->options);
}
