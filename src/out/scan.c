// scan.c - reading numbers and words from a file held in memory; the first error is reported with its place
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/scan.h"

#include <math.h>
#include <stdarg.h>

void scan_error(Scan *s, const char *fmt, ...)
{
  if (s->failed) return;
  char text[400];
  va_list ap;
  va_start(ap, fmt);
  vsnprintf(text, sizeof text, fmt, ap);
  va_end(ap);
  if (s->binary) {
    diag_error(s->diag, NO_LOC, "%s: byte %zu: %s", s->name, (size_t)(s->p - s->begin), text);
  } else {
    size_t line = 1;
    for (const char *q = s->begin; q < s->p; q++) line += *q == '\n';
    diag_error(s->diag, NO_LOC, "%s:%zu: %s", s->name, line, text);
  }
  s->failed = true;
  s->p = s->end;
}

void scan_space(Scan *s)
{
  while (s->p < s->end && (unsigned char)*s->p <= ' ') s->p++;
}

void scan_line(Scan *s)
{
  const char *q = memchr(s->p, '\n', scan_left(s));
  s->p = q ? q + 1 : s->end;
}

static void expected(Scan *s, const char *what)
{
  char word[40];
  const char *at;
  scan_space(s);
  at = s->p;
  scan_word(s, word, sizeof word);
  s->p = at;
  if (*word)
    scan_error(s, "%s expected, found '%s'", what, word);
  else
    scan_error(s, "%s expected, found the end of the file", what);
}

double scan_double_slow(Scan *s, const char *what)
{
  double v = 0;
  scan_space(s);
  const char *q = number_read(s->p, s->end, &v);
  // Fortran writes 1.0D+00: read the mantissa, then the exponent as if it were E.
  if (q > s->p && q < s->end && (*q == 'D' || *q == 'd')) {
    int64_t e = 0;
    const char *r = number_read_i64(q + 1, s->end, &e);
    if (r > q + 1) {
      char buf[64];
      int n = snprintf(buf, sizeof buf, "%.*se%lld", (int)MIN(q - s->p, 40), s->p, (long long)e);
      number_read(buf, buf + n, &v);
      q = r;
    }
  }
  if (q == s->p || (q < s->end && (unsigned char)*q > ' ' && *q != ',')) {
    expected(s, what);
    return 0;
  }
  if (!isfinite(v)) scan_error(s, "%s is not a finite number", what);
  s->p = q;
  return v;
}

int64_t scan_i64_slow(Scan *s, const char *what)
{
  int64_t v = 0;
  scan_space(s);
  const char *q = number_read_i64(s->p, s->end, &v);
  if (q == s->p || (q < s->end && (unsigned char)*q > ' ' && *q != ',')) {
    expected(s, what);
    return 0;
  }
  s->p = q;
  return v;
}

int64_t scan_range(Scan *s, int64_t lo, int64_t hi, const char *what)
{
  int64_t v = scan_i64(s, what);
  if (v < lo || v > hi) {
    scan_error(s, "%s %lld is out of range", what, (long long)v);
    return lo;
  }
  return v;
}

int scan_int(Scan *s, const char *what) { return (int)scan_range(s, INT32_MIN + 1, INT32_MAX, what); }

bool scan_to(Scan *s, const char *word)
{
  size_t n = strlen(word);
  while (s->p < s->end) {
    if (scan_left(s) >= n && memcmp(s->p, word, n) == 0) return true;
    scan_line(s);
  }
  return false;
}

void scan_word(Scan *s, char *to, size_t cap)
{
  size_t n = 0;
  scan_space(s);
  for (; s->p < s->end && (unsigned char)*s->p > ' '; s->p++)
    if (n + 1 < cap) to[n++] = *s->p;
  to[n] = 0;
}

bool scan_get_line(Scan *s, const char **from, const char **to)
{
  if (s->p >= s->end) return false;
  *from = s->p;
  scan_line(s);
  *to = s->p;
  while (*to > *from && (unsigned char)(*to)[-1] <= ' ') --*to;
  while (*from < *to && (unsigned char)**from <= ' ') ++*from;
  return true;
}

const char *scan_bytes(Scan *s, size_t n, const char *what)
{
  if (scan_left(s) < n) {
    scan_error(s, "the file ends within %s", what);
    return NULL;
  }
  const char *p = s->p;
  s->p += n;
  return p;
}

int32_t scan_b32(Scan *s, const char *what)
{
  uint32_t v = 0;
  const char *p = scan_bytes(s, sizeof v, what);
  if (p) memcpy(&v, p, sizeof v);
  return (int32_t)(s->swap ? __builtin_bswap32(v) : v);
}

uint64_t scan_b64(Scan *s, const char *what)
{
  uint64_t v = 0;
  const char *p = scan_bytes(s, sizeof v, what);
  if (p) memcpy(&v, p, sizeof v);
  return s->swap ? __builtin_bswap64(v) : v;
}

double scan_bdouble(Scan *s, const char *what)
{
  uint64_t b = scan_b64(s, what);
  double v;
  memcpy(&v, &b, sizeof v);
  if (!isfinite(v)) scan_error(s, "%s is not a finite number", what);
  return v;
}

size_t scan_count(Scan *s, int64_t n, size_t size, const char *what)
{
  if (s->failed) return 0;
  if (n < 0 || (uint64_t)n > scan_left(s) / size || n >= NONE - 1) {
    scan_error(s, "%lld %s do not fit in what is left of the file", (long long)n, what);
    return 0;
  }
  return (size_t)n;
}
