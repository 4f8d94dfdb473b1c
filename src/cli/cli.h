// cli.h - the command line: what was asked for, parsed from the words
// SPDX-License-Identifier: MIT
#ifndef CLI_CLI_H
#define CLI_CLI_H

#include "base/base.h"
#include "base/diag.h"
#include "base/mem.h"
#include "opt/options.h"
#include "out/formats.h"

typedef enum {
#define GROUP(title)
#define CMD(id, names, nargs, metavar, help) CMD_##id,
#include "cli/commands.def"
#undef GROUP
#undef CMD
  CMD_COUNT
} CommandId;

typedef struct {
  CommandId id;
  const char *names; // separated by blanks, the documented one first
  int nargs;         // -1: setlist's count follows
  const char *metavar, *help;
  const char *group; // title of the group the row stands in
} Command;

extern const Command commands[CMD_COUNT];

// A definition of the command line that the script's symbol table gets before the file is read.
typedef enum { SETTING_NUMBER, SETTING_STRING, SETTING_LIST, SETTING_TEXT, SETTING_FILE } SettingKind;
typedef struct {
  SettingKind kind;
  const char *name, *text; // text of the value, of the script, or of the file's name
  double *value;           // SETTING_NUMBER: 1, SETTING_LIST: n of them; owned
  size_t n;
} Setting;

typedef struct {
  CommandId action;      // CMD_MESH2 unless said otherwise
  bool action_given;
  Vec(const char *) inputs, outputs, require;
  const char *format;    // or NULL
  Vec(Setting) settings;
  const char *bgm, *log, *shell, *explain;
  bool json, report, full_report, keep_going, allow_system, werror, voronoi, insertion, sync, histogram, merge;
  int color_by;       // 0: by group; COLOR_BY_PART; else 1 + a Measure
  unsigned cell_data; // bit k: Measure k
  int width, mark_worst; // of pictures: pixels, elements; 0: default, none
  double window[4];      // of pictures: x0, y0, x1, y1; all 0: the whole mesh
  int color;             // 0 never, 1 always, 2 auto
  double time_limit;     // seconds, 0: none
  double max_memory;     // bytes, 0: none
  Options options;       // defaults, changed by the switches in their order
} Cli;

// Parse argv[1..]. The strings of argv must outlive c. Returns EXIT_GOOD, or EXIT_USAGE (EXIT_INPUT for an option value out
// of range) after an error through diag. Release with cli_free in any case.
ExitCode cli_parse(Cli *c, int argc, char **argv, Diag *diag);
void cli_free(Cli *c);

// help.c: texts made from the tables.
void help_print_usage(FILE *f); // the first lines of the help
void help_print(FILE *f);
void help_print_options(FILE *f, const Options *o);
void help_print_formats(FILE *f);
void help_print_man(FILE *f);
// False for an unknown shell.
bool help_print_completion(FILE *f, const char *shell);
extern const char meshgen_version[];

#endif
