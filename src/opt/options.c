// options.c - the option table: look-up, checked setting, defaults
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "opt/options.h"

#include <math.h>
#include <strings.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/str.h"

static const OptRow rows[] = {
#define ROW(kind, category, key, def, lo, hi, allowed, synonyms, sw, metavar, help)                                  \
  {#category, #key, kind, offsetof(Options, category##_##key), def, lo, hi, allowed, synonyms, sw, metavar, help},
#define NUM(c, k, def, lo, hi, allowed, synonyms, sw, metavar, help)                                                 \
  ROW(OPT_NUM, c, k, def, lo, hi, allowed, synonyms, sw, metavar, help)
#define INT(c, k, def, lo, hi, allowed, synonyms, sw, metavar, help)                                                 \
  ROW(OPT_INT, c, k, def, lo, hi, allowed, synonyms, sw, metavar, help)
#define BOOL(c, k, def, lo, hi, allowed, synonyms, sw, metavar, help)                                                \
  ROW(OPT_BOOL, c, k, def, lo, hi, allowed, synonyms, sw, metavar, help)
#define STAT(c, k, help) ROW(OPT_STAT, c, k, 0, -INFINITY, INFINITY, "", "", "", "", help)
#define STR(c, k, help) ROW(OPT_STR, c, k, 0, 0, 0, "", "", "", "", help)
#include "opt/options.def"
#define IGNORED(c, k)                                                                                                \
  {#c, #k, OPT_IGNORED, offsetof(Options, ignored) + IGNORED_##c##_##k * sizeof(double), 0, -INFINITY, INFINITY,      \
   "", "", "", "", ""},
#include "opt/ignored.def"
};

// Whatever belongs to a view, a colour or the printing of pictures: accepted, kept nowhere.
static const OptRow display_row = {"View", "", OPT_IGNORED, SIZE_MAX, 0, 0, 0, "", "", "", "", ""};

const OptRow *options_rows(size_t *n)
{
  *n = ARRAY_LEN(rows);
  return rows;
}

const OptRow *options_find(const char *category, const char *key)
{
  static const char *const display[] = {"View", "PostProcessing", "Print", "Solver", "Plugin"};
  for (size_t i = 0; i < ARRAY_LEN(display); i++)
    if (strcmp(category, display[i]) == 0) return &display_row;
  if (strncmp(key, "Color.", 6) == 0) return &display_row;
  for (size_t i = 0; i < ARRAY_LEN(rows); i++)
    if (strcmp(rows[i].key, key) == 0 && strcmp(rows[i].category, category) == 0) return &rows[i];
  for (size_t i = 0; i < ARRAY_LEN(rows); i++)
    if (rows[i].synonyms[0] && strcmp(rows[i].category, category) == 0 && str_has_word(rows[i].synonyms, key))
      return &rows[i];
  return NULL;
}

const OptRow *options_find_switch(const char *sw)
{
  for (size_t i = 0; i < ARRAY_LEN(rows); i++)
    if (rows[i].sw[0] && strcmp(rows[i].sw, sw) == 0) return &rows[i];
  return NULL;
}

const char *options_nearest(const char *category, const char *key)
{
  const char *names[ARRAY_LEN(rows)];
  size_t n = 0;
  for (size_t i = 0; i < ARRAY_LEN(rows); i++)
    if (strcmp(rows[i].category, category) == 0) names[n++] = rows[i].key;
  return str_nearest(key, names, n);
}

static double *number_at(const Options *o, const OptRow *row)
{
  return (double *)((char *)(uintptr_t)o + row->offset);
}

double options_get_number(const Options *o, const OptRow *row)
{
  if (row->offset == SIZE_MAX) return 0;
  const char *p = (const char *)o + row->offset;
  switch (row->kind) {
  case OPT_NUM:
  case OPT_STAT:
  case OPT_IGNORED: return *(const double *)(const void *)p;
  case OPT_INT: return *(const int *)(const void *)p;
  case OPT_BOOL: return *(const bool *)p;
  case OPT_STR: return 0;
  }
  UNREACHABLE();
}

const char *options_get_string(const Options *o, const OptRow *row)
{
  if (row->kind != OPT_STR) return "";
  const char *s = *(char *const *)(const void *)((const char *)o + row->offset);
  return s ? s : "";
}

static bool is_allowed(const char *allowed, double value)
{
  const char *p = allowed, *end = allowed + strlen(allowed);
  while (p < end) {
    double v = 0;
    p = number_read(p, end, &v);
    if (v == value) return true;
    if (p < end) p++;
  }
  return false;
}

static void store(Options *o, const OptRow *row, double value)
{
  char *p = (char *)o + row->offset;
  switch (row->kind) {
  case OPT_NUM:
  case OPT_STAT:
  case OPT_IGNORED: *number_at(o, row) = value; break;
  case OPT_INT: *(int *)(void *)p = (int)value; break;
  case OPT_BOOL: *(bool *)p = value != 0; break;
  case OPT_STR: break;
  }
}

bool options_set_number(Options *o, const OptRow *row, double value, SrcLoc loc, Diag *diag)
{
  if (row->offset == SIZE_MAX) return true;
  if (row->kind == OPT_STR) {
    diag_error(diag, loc, "option %s.%s is a text, not a number", row->category, row->key);
    return false;
  }
  if (row->kind == OPT_STAT) {
    diag_error(diag, loc, "option %s.%s can only be read", row->category, row->key);
    return false;
  }
  if (row->kind == OPT_IGNORED) {
    store(o, row, value);
    return true;
  }
  if (row->kind == OPT_INT) value = trunc(value);
  if (row->kind == OPT_BOOL && isfinite(value)) value = value != 0;
  if (row->allowed[0] && !is_allowed(row->allowed, value)) {
    diag_error(diag, loc, "%g is not a value of %s.%s; it takes one of %s", value, row->category, row->key,
               row->allowed);
    return false;
  }
  if (!(value >= row->lo && value <= row->hi)) {
    diag_error(diag, loc, "%g is out of range for %s.%s: %g to %g", value, row->category, row->key, row->lo,
               row->hi);
    return false;
  }
  store(o, row, value);
  return true;
}

bool options_set_string(Options *o, const OptRow *row, const char *value, SrcLoc loc, Diag *diag)
{
  if (row->kind == OPT_IGNORED) return true;
  if (row->kind != OPT_STR) {
    diag_error(diag, loc, "option %s.%s is a number, not a text", row->category, row->key);
    return false;
  }
  char **s = (char **)(void *)((char *)o + row->offset);
  char *copy = mem_strdup(value);
  free(*s);
  *s = copy;
  return true;
}

void options_init(Options *o)
{
  memset(o, 0, sizeof *o);
  for (size_t i = 0; i < ARRAY_LEN(rows); i++) store(o, &rows[i], rows[i].def);
}

void options_copy(Options *to, const Options *from)
{
  *to = *from;
  for (size_t i = 0; i < ARRAY_LEN(rows); i++) {
    if (rows[i].kind != OPT_STR) continue;
    char **s = (char **)(void *)((char *)to + rows[i].offset);
    if (*s) *s = mem_strdup(*s);
  }
}

void options_free(Options *o)
{
  for (size_t i = 0; i < ARRAY_LEN(rows); i++) {
    if (rows[i].kind != OPT_STR) continue;
    char **s = (char **)(void *)((char *)o + rows[i].offset);
    free(*s);
    *s = NULL;
  }
}

int options_algorithm(const char *name)
{
  static const struct { const char *name; int number; } names[] = {
      {"meshadapt", 1}, {"iso", 1},      {"auto", 2},    {"initial2d", 3}, {"del2d", 5},  {"tri", 5},
      {"delaunay", 5},  {"front2d", 6},  {"frontal", 6}, {"bamg", 7},      {"delquad", 8}, {"pack", 9},
      {"quadqs", 11},   {"frontopt2d", 12}};
  for (size_t i = 0; i < ARRAY_LEN(names); i++)
    if (strcasecmp(names[i].name, name) == 0) return names[i].number;
  return 0;
}
