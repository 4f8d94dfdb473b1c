// scan.h - reading numbers and words from a file held in memory; the first error is reported with its place
// SPDX-License-Identifier: MIT
#ifndef OUT_SCAN_H
#define OUT_SCAN_H

#include "base/base.h"
#include "base/decimal.h"
#include "base/diag.h"
#include "base/number.h"

// After an error p stands at end, so that every loop over the input ends.
typedef struct {
  const char *p, *end, *begin;
  const char *name;
  Diag *diag;
  bool failed, binary; // binary: errors name the byte, not the line
  bool swap;           // the file's byte order is not ours
  int threads;         // that may read; 0: one per processor
} Scan;

// Report `name:line: text` (or `name: byte n: text`), once; further calls do nothing.
void scan_error(Scan *s, const char *fmt, ...) PRINTF_LIKE(2, 3);

// scan_double and scan_i64 below: numbers, after blanks and line ends; an error naming `what` if there is none.
double scan_double_slow(Scan *s, const char *what);
int64_t scan_i64_slow(Scan *s, const char *what);
// In [lo, hi], or an error.
int64_t scan_range(Scan *s, int64_t lo, int64_t hi, const char *what);
int scan_int(Scan *s, const char *what);

// Skip blanks and line ends; the rest of the line; to the next line that begins with `word` (false at the end).
void scan_space(Scan *s);
void scan_line(Scan *s);
bool scan_to(Scan *s, const char *word);
// The next word, at most cap - 1 bytes of it, or "" at the end.
void scan_word(Scan *s, char *to, size_t cap);
// The next line without its end and surrounding blanks, as a slice. False at the end of the file.
bool scan_get_line(Scan *s, const char **from, const char **to);

// n bytes of binary data, or NULL after an error.
const char *scan_bytes(Scan *s, size_t n, const char *what);
int32_t scan_b32(Scan *s, const char *what);
uint64_t scan_b64(Scan *s, const char *what);
double scan_bdouble(Scan *s, const char *what);

// Refuse a count of things of at least `size` bytes each that the rest of the file cannot hold. Returns n, or 0 after an error.
size_t scan_count(Scan *s, int64_t n, size_t size, const char *what);

static inline size_t scan_left(const Scan *s) { return (size_t)(s->end - s->p); }

// The third coordinate is nearly always a bare 0.
static inline double scan_double(Scan *s, const char *what)
{
  const char *p = s->p;
  while (p < s->end && (unsigned char)*p <= ' ') p++;
  if (s->end - p < 2 || p[0] != '0' || (unsigned char)p[1] > ' ') return scan_double_slow(s, what);
  s->p = p + 1;
  return 0;
}

static inline int64_t scan_i64(Scan *s, const char *what)
{
  const char *p = s->p;
  while (p < s->end && (unsigned char)*p <= ' ') p++;
  if (s->end - p >= 8) {
    uint64_t text = decimal_load8(p);
    unsigned n = decimal_count_digits(text);
    if (n - 1 < 7 && (unsigned char)p[n] <= ' ') {
      s->p = p + n;
      return (int64_t)decimal_value(text, n);
    }
  }
  uint64_t v = 0;
  const char *from = p;
  while (p < s->end && (unsigned)(*p - '0') < 10 && p - from < 18) v = 10 * v + (unsigned)(*p++ - '0');
  if (p == from || (p < s->end && (unsigned char)*p > ' ')) return scan_i64_slow(s, what);
  s->p = p;
  return (int64_t)v;
}

#endif
