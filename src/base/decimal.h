// decimal.h - digits of whole numbers to text and back, eight at a time
// SPDX-License-Identifier: MIT
#ifndef BASE_DECIMAL_H
#define BASE_DECIMAL_H

#include "base/base.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { DECIMAL_ROOM = 24 }; // bytes that printing may write to, whatever the length of the text

// As decimal_put_u64.
char *decimal_put_large(char *p, uint64_t v);

#ifdef __cplusplus
}
#endif

// The eight decimal digits of v < 10^8, the first in the lowest byte.
static inline uint64_t decimal_digits8(uint64_t v)
{
  uint64_t four = v / 10000 | (v % 10000) << 32;
  uint64_t hundreds = ((four * 10486) >> 20) & 0x7f0000007f, two = hundreds | (four - 100 * hundreds) << 16;
  uint64_t tens = ((two * 103) >> 10) & 0x000f000f000f000f;
  return tens | (two - 10 * tens) << 8;
}

// Store the lowest byte of v first, on any machine.
static inline void decimal_store8(char *to, uint64_t v)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  v = __builtin_bswap64(v);
#endif
  memcpy(to, &v, sizeof v);
}

static inline uint64_t decimal_load8(const char *from)
{
  uint64_t v;
  memcpy(&v, from, sizeof v);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  v = __builtin_bswap64(v);
#endif
  return v;
}

static inline char *decimal_put_u32(char *p, uint64_t v) // v < 10^8
{
  uint64_t d = decimal_digits8(v);
  unsigned skip = (unsigned)__builtin_ctzll(d | (uint64_t)1 << 56) & ~7u; // leading zeros, but for the last digit
  decimal_store8(p, (d | 0x3030303030303030) >> skip);
  return p + (8 - skip / 8);
}

// Text of v at p; returns its end. Writes to DECIMAL_ROOM bytes.
static inline char *decimal_put_u64(char *p, uint64_t v)
{
  return v < 100000000 ? decimal_put_u32(p, v) : decimal_put_large(p, v);
}

// How many of the eight bytes at the low end of `text` are digits, before the first that is not.
static inline unsigned decimal_count_digits(uint64_t text)
{
  uint64_t x = text ^ 0x3030303030303030, other = (((x & 0x7f7f7f7f7f7f7f7f) + 0x7676767676767676) | x) & 0x8080808080808080;
  return other ? (unsigned)__builtin_ctzll(other) / 8 : 8;
}

// Value of eight digits, the first in the lowest byte.
static inline uint64_t decimal_value8(uint64_t text)
{
  uint64_t v = text & 0x0f0f0f0f0f0f0f0f;
  v = (v * 10 + (v >> 8)) & 0x00ff00ff00ff00ff;
  v = (v * 100 + (v >> 16)) & 0x0000ffff0000ffff;
  return (v * 10000 + (v >> 32)) & 0xffffffff;
}

// Value of the first n <= 8 digits of `text`.
static inline uint64_t decimal_value(uint64_t text, unsigned n)
{
  return n ? decimal_value8(text << (64 - 8 * n)) : 0;
}

#endif
