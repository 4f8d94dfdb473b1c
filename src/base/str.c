// str.c - string builder, and case-insensitive nearness for "did you mean"
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/str.h"

#include <ctype.h>
#include <stdarg.h>

#include "base/mem.h"
#include "base/number.h"

void str_append_n(Str *s, const char *text, size_t n)
{
  mem_grow(&s->data, &s->cap, s->len + n + 1, 1);
  if (n) memcpy(s->data + s->len, text, n);
  s->len += n;
  s->data[s->len] = 0;
}

void str_append(Str *s, const char *text)
{
  str_append_n(s, text, strlen(text));
}

void str_char(Str *s, char c)
{
  str_append_n(s, &c, 1);
}

void str_printf(Str *s, const char *fmt, ...)
{
  va_list ap, again;
  va_start(ap, fmt);
  va_copy(again, ap);
  int n = vsnprintf(NULL, 0, fmt, ap);
  if (n > 0) {
    mem_grow(&s->data, &s->cap, s->len + (size_t)n + 1, 1);
    vsnprintf(s->data + s->len, (size_t)n + 1, fmt, again);
    s->len += (size_t)n;
  }
  va_end(again);
  va_end(ap);
}

void str_double(Str *s, double v)
{
  char buf[NUMBER_MAX_TEXT];
  str_append_n(s, buf, number_print(buf, v));
}

void str_clear(Str *s)
{
  s->len = 0;
  if (s->data) s->data[0] = 0;
}

void str_free(Str *s)
{
  free(s->data);
  *s = (Str){0};
}

const char *str_text(const Str *s)
{
  return s->data ? s->data : "";
}

int str_distance(const char *a, const char *b, int limit)
{
  enum { LONGEST = 64 };
  int n = (int)strlen(a), m = (int)strlen(b);
  if (n > LONGEST || m > LONGEST || n - m > limit || m - n > limit) return limit + 1;
  int row[3][LONGEST + 1];
  int *before = row[0], *last = row[1], *now = row[2];
  for (int j = 0; j <= m; j++) last[j] = j;
  for (int i = 1; i <= n; i++) {
    now[0] = i;
    for (int j = 1; j <= m; j++) {
      int ca = tolower((unsigned char)a[i - 1]), cb = tolower((unsigned char)b[j - 1]);
      int d = last[j - 1] + (ca != cb);
      d = MIN(d, MIN(last[j], now[j - 1]) + 1);
      if (i > 1 && j > 1 && ca == tolower((unsigned char)b[j - 2]) &&
          cb == tolower((unsigned char)a[i - 2]))
        d = MIN(d, before[j - 2] + 1);
      now[j] = d;
    }
    int *t = before;
    before = last;
    last = now;
    now = t;
  }
  return MIN(last[m], limit + 1);
}

const char *str_nearest(const char *word, const char *const *names, size_t n)
{
  int limit = MIN(3, (int)strlen(word) / 3);
  const char *best = NULL;
  for (size_t i = 0; i < n; i++) {
    int d = str_distance(word, names[i], limit);
    if (d > limit) continue;
    best = names[i];
    if (d == 0) break;
    limit = d - 1;
  }
  return best;
}

bool str_has_word(const char *list, const char *word)
{
  size_t n = strlen(word);
  for (const char *p = list; *p;) {
    size_t k = strcspn(p, " ");
    if (k == n && memcmp(p, word, n) == 0) return true;
    p += k;
    while (*p == ' ') p++;
  }
  return false;
}
