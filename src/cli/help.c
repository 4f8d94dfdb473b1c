// help.c - help, manual page section and shell completion, all from the tables
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/cli.h"

#include "base/number.h"
#include "base/str.h"

const char meshgen_version[] = "0.1.0";

typedef struct {
  const char *title; // of a group that begins here, or NULL
  int id;
} HelpRow;

static const HelpRow help_rows[] = {
#define GROUP(title) {title, -1},
#define CMD(id, names, nargs, metavar, help) {NULL, CMD_##id},
#include "cli/commands.def"
#undef GROUP
#undef CMD
};

static void print_row(FILE *f, const char *names, const char *metavar, const char *help, const char *option)
{
  char left[64];
  snprintf(left, sizeof left, "-%.*s %s", (int)strcspn(names, " "), names, metavar);
  fprintf(f, "  %-26s %s", left, help);
  if (option) fprintf(f, " (%s)", option);
  fputc('\n', f);
}

void help_print_usage(FILE *f)
{
  fprintf(f, "meshgen %s - a mesher of plane models\n\n"
             "Usage: meshgen [switches] file.geo ...\n"
             "       meshgen check|hash file.msh ...     meshgen diff a.msh b.msh     meshgen a.msh -o b.vtu\n\n"
             "Examples:\n"
             "  meshgen -2 plate.geo                        write plate.msh\n"
             "  meshgen -2 plate.geo -clscale 0.5 -o fine.vtk\n"
             "  meshgen -2 plate.geo -setnumber R 0.3 -o plate.msh -o plate.png\n",
          meshgen_version);
}

void help_print(FILE *f)
{
  help_print_usage(f);
  for (size_t i = 0; i < ARRAY_LEN(help_rows); i++) {
    if (help_rows[i].title) {
      fprintf(f, "\n%s:\n", help_rows[i].title);
      continue;
    }
    const Command *c = &commands[help_rows[i].id];
    if (c->help[0]) print_row(f, c->names, c->metavar, c->help, NULL);
  }
  fprintf(f, "\nOptions with a switch (all of them: -help_options):\n");
  size_t n;
  const OptRow *rows = options_rows(&n);
  for (size_t i = 0; i < n; i++) {
    if (!rows[i].sw[0] || strcmp(rows[i].sw, "algo") == 0) continue;
    char name[96];
    snprintf(name, sizeof name, "%s.%s", rows[i].category, rows[i].key);
    print_row(f, rows[i].sw, rows[i].metavar, rows[i].help, name);
  }
  fprintf(f, "\nEvery switch may be written with two dashes. Exit status: 0 good, 1 error in script, option or geometry,\n"
             "2 usage, 3 file or memory, 4 written although a face failed (-keep_going).\n");
}

void help_print_options(FILE *f, const Options *o)
{
  size_t n;
  const OptRow *rows = options_rows(&n);
  for (size_t i = 0; i < n; i++) {
    const OptRow *r = &rows[i];
    if (r->kind == OPT_IGNORED) continue;
    if (r->kind == OPT_STR) {
      fprintf(f, "%s.%s = \"%s\"; // %s\n", r->category, r->key, options_get_string(o, r), r->help);
      continue;
    }
    char text[NUMBER_MAX_TEXT + 1];
    text[number_print(text, options_get_number(o, r))] = 0;
    fprintf(f, "%s.%s = %s; // %s%s\n", r->category, r->key, text, r->help, r->kind == OPT_STAT ? " (read-only)" : "");
  }
}

void help_print_formats(FILE *f)
{
  const Format *row;
  for (size_t k = 0; (row = format_at(k)) != NULL; k++) {
    char how[3] = {format_reads(row) ? 'r' : '-', format_writes(row) ? 'w' : '-', 0};
    fprintf(f, "%-9s %s  %-15s %s\n", format_name(row), how, format_extensions(row), format_help(row));
  }
}

static void man_escape(FILE *f, const char *s)
{
  if (*s == '.' || *s == '\'') fputs("\\&", f);
  for (; *s; s++) {
    if (*s == '-' || *s == '\\') fputc('\\', f);
    fputc(*s, f);
  }
}

static void man_row(FILE *f, const char *names, const char *metavar, const char *help, const OptRow *row)
{
  fprintf(f, ".TP\n.B \\-%.*s", (int)strcspn(names, " "), names);
  if (metavar[0]) {
    fputs(" \\fI", f);
    man_escape(f, metavar);
    fputs("\\fR", f);
  }
  fputc('\n', f);
  man_escape(f, help);
  if (row) fprintf(f, "\n(%s.%s, default %g)", row->category, row->key, row->def);
  fputs(".\n", f);
}

void help_print_man(FILE *f)
{
  for (size_t i = 0; i < ARRAY_LEN(help_rows); i++) {
    if (help_rows[i].title) {
      fprintf(f, ".SS %s\n", help_rows[i].title);
      continue;
    }
    const Command *c = &commands[help_rows[i].id];
    if (c->help[0]) man_row(f, c->names, c->metavar, c->help, NULL);
  }
  fputs(".SS Options with a switch\n", f);
  size_t n;
  const OptRow *rows = options_rows(&n);
  for (size_t i = 0; i < n; i++)
    if (rows[i].sw[0] && strcmp(rows[i].sw, "algo") != 0)
      man_row(f, rows[i].sw, rows[i].metavar, rows[i].help, &rows[i]);
  fputs(".SS Options set by scripts or \\-setnumber\n", f);
  for (size_t i = 0; i < n; i++) {
    if (rows[i].sw[0] || rows[i].kind == OPT_IGNORED) continue;
    fprintf(f, ".TP\n.B %s.%s\n", rows[i].category, rows[i].key);
    man_escape(f, rows[i].help);
    if (rows[i].kind == OPT_NUM || rows[i].kind == OPT_INT || rows[i].kind == OPT_BOOL)
      fprintf(f, " (default %g)", rows[i].def);
    fputs(".\n", f);
  }
}

static void each_switch(Str *out, const char *before, const char *after)
{
  for (size_t i = 0; i < CMD_COUNT; i++)
    if (commands[i].help[0])
      str_printf(out, "%s%.*s%s", before, (int)strcspn(commands[i].names, " "), commands[i].names, after);
  size_t n;
  const OptRow *rows = options_rows(&n);
  for (size_t i = 0; i < n; i++)
    if (rows[i].sw[0] && strcmp(rows[i].sw, "algo") != 0) str_printf(out, "%s%s%s", before, rows[i].sw, after);
}

bool help_print_completion(FILE *f, const char *shell)
{
  Str s = {0};
  if (strcmp(shell, "bash") == 0) {
    str_append(&s, "_meshgen() {\n  local cur=${COMP_WORDS[COMP_CWORD]}\n  case $cur in\n  -*) COMPREPLY=($(compgen -W \"");
    each_switch(&s, "-", " ");
    str_append(&s, "\" -- \"$cur\")) ;;\n  *) COMPREPLY=($(compgen -f -- \"$cur\")) ;;\n  esac\n}\n"
                   "complete -o filenames -F _meshgen meshgen\n");
  } else if (strcmp(shell, "zsh") == 0) {
    str_append(&s, "#compdef meshgen\n_arguments \\\n");
    each_switch(&s, "  '*-", "' \\\n");
    str_append(&s, "  '*:file:_files'\n");
  } else if (strcmp(shell, "fish") == 0) {
    each_switch(&s, "complete -c meshgen -o ", "\n");
  }
  bool known = s.len > 0;
  fputs(str_text(&s), f);
  str_free(&s);
  return known;
}
