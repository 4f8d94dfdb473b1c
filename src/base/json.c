// json.c - write one JSON value, piece by piece
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/json.h"

#include <math.h>

static bool is_utf8(const char *s)
{
  const unsigned char *p = (const unsigned char *)s;
  while (*p) {
    int more = *p < 0x80 ? 0 : *p >= 0xc2 && *p < 0xe0 ? 1 : *p >= 0xe0 && *p < 0xf0 ? 2 : *p >= 0xf0 && *p < 0xf5 ? 3 : -1;
    if (more < 0) return false;
    for (p++; more > 0; more--, p++)
      if ((*p & 0xc0) != 0x80) return false;
  }
  return true;
}

static void quote(Str *o, const char *s)
{
  bool utf8 = is_utf8(s);
  str_char(o, '"');
  for (; *s; s++) {
    unsigned char c = (unsigned char)*s;
    if (c == '"' || c == '\\')
      str_printf(o, "\\%c", c);
    else if (c < ' ' || (c >= 0x80 && !utf8))
      str_printf(o, "\\u%04x", c);
    else
      str_char(o, *s);
  }
  str_char(o, '"');
}

static void before(Json *j, const char *name)
{
  if (j->comma) str_char(&j->out, ',');
  if (j->depth) {
    str_char(&j->out, '\n');
    for (int i = 0; i < j->depth; i++) str_append(&j->out, "  ");
  }
  if (name) {
    quote(&j->out, name);
    str_append(&j->out, ": ");
  }
  j->comma = true;
}

void json_begin(Json *j, const char *name, char bracket)
{
  before(j, name);
  str_char(&j->out, bracket);
  j->depth++;
  j->comma = false;
}

void json_end(Json *j, char bracket)
{
  bool empty = !j->comma;
  j->depth--;
  if (!empty) {
    str_char(&j->out, '\n');
    for (int i = 0; i < j->depth; i++) str_append(&j->out, "  ");
  }
  str_char(&j->out, bracket);
  j->comma = true;
}

void json_number(Json *j, const char *name, double v)
{
  before(j, name);
  if (isfinite(v))
    str_double(&j->out, v);
  else
    str_append(&j->out, "null");
}

void json_integer(Json *j, const char *name, long long v)
{
  before(j, name);
  str_printf(&j->out, "%lld", v);
}

void json_bool(Json *j, const char *name, bool v)
{
  before(j, name);
  str_append(&j->out, v ? "true" : "false");
}

void json_string(Json *j, const char *name, const char *s)
{
  before(j, name);
  if (s)
    quote(&j->out, s);
  else
    str_append(&j->out, "null");
}
