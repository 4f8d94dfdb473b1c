// options.h - every option, its value, and the table that describes it
// SPDX-License-Identifier: MIT
//
// options.def holds one row per option; it expands to the members of Options (opt->Mesh_MeshSizeFactor), to the
// defaults, to the look-up table, to help texts and to the manual page.
#ifndef OPT_OPTIONS_H
#define OPT_OPTIONS_H

#include "base/base.h"
#include "base/diag.h"

enum {
#define IGNORED(category, key) IGNORED_##category##_##key,
#include "opt/ignored.def"
#undef IGNORED
  OPT_IGNORED_COUNT
};

typedef struct {
#define NUM(category, key, def, lo, hi, allowed, synonyms, sw, metavar, help) double category##_##key;
#define INT(category, key, def, lo, hi, allowed, synonyms, sw, metavar, help) int category##_##key;
#define BOOL(category, key, def, lo, hi, allowed, synonyms, sw, metavar, help) bool category##_##key;
#define STAT(category, key, help) double category##_##key;
#define STR(category, key, help) char *category##_##key;
#include "opt/options.def"
#undef NUM
#undef INT
#undef BOOL
#undef STAT
#undef STR
  double ignored[OPT_IGNORED_COUNT];
} Options;

typedef enum { OPT_NUM, OPT_INT, OPT_BOOL, OPT_STAT, OPT_STR, OPT_IGNORED } OptKind;

typedef struct {
  const char *category, *key;
  OptKind kind;
  size_t offset;          // of the member in Options
  double def, lo, hi;
  const char *allowed;    // "" or the values allowed, separated by blanks
  const char *synonyms;   // deprecated keys, separated by blanks
  const char *sw;         // command-line switch without the dash, or ""
  const char *metavar, *help;
} OptRow;

// Defaults. The strings of an Options belong to it; release with options_free.
void options_init(Options *o);
void options_free(Options *o);
void options_copy(Options *to, const Options *from); // to is uninitialized before

// All rows, ordered by category and key within kinds.
const OptRow *options_rows(size_t *n);

// Row of Category.Key, deprecated spellings included; NULL if there is no such option. Options of views, of colours and of
// printing have a row too (OPT_IGNORED). O(log n).
const OptRow *options_find(const char *category, const char *key);
const OptRow *options_find_switch(const char *sw);
// A key of the category that `key` is probably a misspelling of, or NULL.
const char *options_nearest(const char *category, const char *key);

// Set with type, range and allowed values checked: false after an error at loc that names the range. NaN is refused.
bool options_set_number(Options *o, const OptRow *row, double value, SrcLoc loc, Diag *diag);
bool options_set_string(Options *o, const OptRow *row, const char *value, SrcLoc loc, Diag *diag);
double options_get_number(const Options *o, const OptRow *row); // 0 for strings
const char *options_get_string(const Options *o, const OptRow *row); // "" for numbers

// Number of a 2D algorithm by its command-line name (meshadapt, auto, initial2d, del2d, front2d, ...), or 0.
int options_algorithm(const char *name);

#endif
