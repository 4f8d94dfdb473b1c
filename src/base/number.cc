// number.cc - numbers to text and back: the C++ library's <charconv> behind a C interface
// SPDX-License-Identifier: MIT
#include "base/number.h"

#include <charconv>
#include <cmath>
#include <system_error>

#include "base/decimal.h"

size_t number_print(char *to, double v)
{
  return (size_t)(std::to_chars(to, to + NUMBER_MAX_TEXT, v).ptr - to);
}

size_t number_print_u64(char *to, uint64_t v)
{
  return (size_t)(decimal_put_u64(to, v) - to);
}

const char *number_read(const char *s, const char *end, double *v)
{
  const char *p = s < end && *s == '+' ? s + 1 : s;
  if (p != s && p < end && *p == '-') return s;
  std::from_chars_result r = std::from_chars(p, end, *v);
  if (r.ec == std::errc::invalid_argument) return s;
  if (r.ec == std::errc::result_out_of_range) {
    // <charconv> leaves *v alone: decide between overflow and underflow by strtod, which is exact but slower.
    char buf[512];
    size_t n = (size_t)(r.ptr - p);
    if (n >= sizeof buf) n = sizeof buf - 1;
    memcpy(buf, p, n);
    buf[n] = 0;
    *v = strtod(buf, NULL);
  }
  return r.ptr;
}

const char *number_read_i64(const char *s, const char *end, int64_t *v)
{
  const char *p = s < end && *s == '+' ? s + 1 : s;
  std::from_chars_result r = std::from_chars(p, end, *v);
  return r.ec == std::errc() ? r.ptr : s;
}
