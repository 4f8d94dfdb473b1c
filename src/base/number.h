// number.h - numbers to text and back, independent of the locale, exact both ways
// SPDX-License-Identifier: MIT
#ifndef BASE_NUMBER_H
#define BASE_NUMBER_H

#include "base/base.h"

enum { NUMBER_MAX_TEXT = 40 };

#ifdef __cplusplus
extern "C" {
#endif

// Shortest decimal text that reads back to exactly v ("0.1", "1e-09", "-0", "nan", "inf"); not NUL-terminated.
// Needs NUMBER_MAX_TEXT bytes. Returns the number of bytes. About 40 ns.
size_t number_print(char *to, double v);
size_t number_print_u64(char *to, uint64_t v);

// Read a double at s, before end; leading blanks are not skipped, a leading '+' is accepted. Returns the first byte
// not used (s itself if there is no number). Overflow gives +-inf and underflow the nearest (denormal or 0) value.
const char *number_read(const char *s, const char *end, double *v);
const char *number_read_i64(const char *s, const char *end, int64_t *v);

#ifdef __cplusplus
}
#endif

#endif
