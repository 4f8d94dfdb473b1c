// json.h - write one JSON value, piece by piece
// SPDX-License-Identifier: MIT
#ifndef BASE_JSON_H
#define BASE_JSON_H

#include "base/base.h"
#include "base/str.h"

// Zero-initialize; the text grows in out (str_free it). Commas, indentation and escapes are taken care of. In an object name every
// value; in an array pass NULL as name. nan and infinities become null.
typedef struct {
  Str out;
  int depth;
  bool comma;
} Json;

void json_begin(Json *j, const char *name, char bracket); // '{' or '['
void json_end(Json *j, char bracket);                     // '}' or ']'
void json_number(Json *j, const char *name, double v);    // shortest text that reads back
void json_integer(Json *j, const char *name, long long v);
void json_bool(Json *j, const char *name, bool v);
// s: UTF-8, or Latin-1, which is converted; NULL gives null.
void json_string(Json *j, const char *name, const char *s);

#endif
