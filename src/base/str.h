// str.h - string builder, and case-insensitive nearness for "did you mean"
// SPDX-License-Identifier: MIT
#ifndef BASE_STR_H
#define BASE_STR_H

#include "base/base.h"

// Growing NUL-terminated text. Zero-initialize; str_free when done. s.data is NULL while nothing was appended.
typedef struct {
  char *data;
  size_t len, cap;
} Str;

// Append; amortized O(length appended).
void str_append(Str *s, const char *text);
void str_append_n(Str *s, const char *text, size_t n);
void str_char(Str *s, char c);
void str_printf(Str *s, const char *fmt, ...) PRINTF_LIKE(2, 3);
void str_double(Str *s, double v); // shortest text that reads back
void str_clear(Str *s);            // to "", keeping the memory
void str_free(Str *s);
// The text, never NULL; valid until the next change.
const char *str_text(const Str *s);

// Damerau-Levenshtein distance without regard to case, or `limit`+1 if it is larger. O(limit * length).
int str_distance(const char *a, const char *b, int limit);

// The entry of names[n] nearest to `word` if near enough to be a likely misspelling, else NULL.
const char *str_nearest(const char *word, const char *const *names, size_t n);

// Is `word` one of the words of `list`, which blanks separate?
bool str_has_word(const char *list, const char *word);

#endif
