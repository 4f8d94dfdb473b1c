// decimal.c - digits of whole numbers to text and back, eight at a time
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/decimal.h"

char *decimal_put_large(char *p, uint64_t v)
{
  const uint64_t e8 = 100000000;
  if (v < e8) return decimal_put_u32(p, v);
  p = decimal_put_large(p, v / e8);
  decimal_store8(p, decimal_digits8(v % e8) | 0x3030303030303030);
  return p + 8;
}
