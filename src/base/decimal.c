// decimal.c - digits of numbers to text and back, eight at a time
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/decimal.h"

#include <math.h>

__extension__ typedef unsigned __int128 Wide;

typedef struct {
  uint64_t hi, lo;
} Power;

// 5^k in 128 bits with the highest one set: exact.
static const Power power[] = {
    {0x8000000000000000, 0x0000000000000000}, {0xa000000000000000, 0x0000000000000000},
    {0xc800000000000000, 0x0000000000000000}, {0xfa00000000000000, 0x0000000000000000},
    {0x9c40000000000000, 0x0000000000000000}, {0xc350000000000000, 0x0000000000000000},
    {0xf424000000000000, 0x0000000000000000}, {0x9896800000000000, 0x0000000000000000},
    {0xbebc200000000000, 0x0000000000000000}, {0xee6b280000000000, 0x0000000000000000},
    {0x9502f90000000000, 0x0000000000000000}, {0xba43b74000000000, 0x0000000000000000},
    {0xe8d4a51000000000, 0x0000000000000000}, {0x9184e72a00000000, 0x0000000000000000},
    {0xb5e620f480000000, 0x0000000000000000}, {0xe35fa931a0000000, 0x0000000000000000},
    {0x8e1bc9bf04000000, 0x0000000000000000}, {0xb1a2bc2ec5000000, 0x0000000000000000},
    {0xde0b6b3a76400000, 0x0000000000000000}, {0x8ac7230489e80000, 0x0000000000000000},
    {0xad78ebc5ac620000, 0x0000000000000000}, {0xd8d726b7177a8000, 0x0000000000000000},
    {0x878678326eac9000, 0x0000000000000000}, {0xa968163f0a57b400, 0x0000000000000000},
    {0xd3c21bcecceda100, 0x0000000000000000}, {0x84595161401484a0, 0x0000000000000000},
    {0xa56fa5b99019a5c8, 0x0000000000000000}, {0xcecb8f27f4200f3a, 0x0000000000000000},
    {0x813f3978f8940984, 0x4000000000000000}, {0xa18f07d736b90be5, 0x5000000000000000},
    {0xc9f2c9cd04674ede, 0xa400000000000000}, {0xfc6f7c4045812296, 0x4d00000000000000},
    {0x9dc5ada82b70b59d, 0xf020000000000000}, {0xc5371912364ce305, 0x6c28000000000000},
    {0xf684df56c3e01bc6, 0xc732000000000000}, {0x9a130b963a6c115c, 0x3c7f400000000000},
    {0xc097ce7bc90715b3, 0x4b9f100000000000}, {0xf0bdc21abb48db20, 0x1e86d40000000000},
    {0x96769950b50d88f4, 0x1314448000000000}, {0xbc143fa4e250eb31, 0x17d955a000000000},
    {0xeb194f8e1ae525fd, 0x5dcfab0800000000}, {0x92efd1b8d0cf37be, 0x5aa1cae500000000},
    {0xb7abc627050305ad, 0xf14a3d9e40000000}, {0xe596b7b0c643c719, 0x6d9ccd05d0000000},
    {0x8f7e32ce7bea5c6f, 0xe4820023a2000000}, {0xb35dbf821ae4f38b, 0xdda2802c8a800000},
    {0xe0352f62a19e306e, 0xd50b2037ad200000}, {0x8c213d9da502de45, 0x4526f422cc340000},
    {0xaf298d050e4395d6, 0x9670b12b7f410000}, {0xdaf3f04651d47b4c, 0x3c0cdd765f114000},
    {0x88d8762bf324cd0f, 0xa5880a69fb6ac800}, {0xab0e93b6efee0053, 0x8eea0d047a457a00},
    {0xd5d238a4abe98068, 0x72a4904598d6d880}, {0x85a36366eb71f041, 0x47a6da2b7f864750},
    {0xa70c3c40a64e6c51, 0x999090b65f67d924}, {0xd0cf4b50cfe20765, 0xfff4b4e3f741cf6d},
};

char *decimal_put_large(char *p, uint64_t v)
{
  const uint64_t e8 = 100000000;
  if (v < e8) return decimal_put_u32(p, v);
  p = decimal_put_large(p, v / e8);
  decimal_store8(p, decimal_digits8(v % e8) | 0x3030303030303030);
  return p + 8;
}

// The whole part of g * c / 2^128, its last bit set if there is a rest.
static uint64_t round_to_odd(Power g, uint64_t c)
{
  Wide low = (Wide)g.lo * c, high = (Wide)g.hi * c + (low >> 64);
  return (uint64_t)(high >> 64) | ((uint64_t)high | (uint64_t)low ? 1 : 0);
}

// digits * 10^exponent
typedef struct {
  uint64_t digits;
  int exponent;
} Decimal;

// The shortest decimal in the interval of what is read as c * 2^q, of these the nearest to it [Giulietti20]. c < 2^53, q < 0.
// All candidates are looked at, as which of them it is cannot be foreseen.
static Decimal shortest(uint64_t c, int q, bool lower_is_closer)
{
  int k = (q * 1262611 - (lower_is_closer ? 524031 : 0)) >> 22; // floor(log10(2^q)), or of 3/4 2^q
  int h = q + ((-k * 1741647) >> 19) + 1;
  Power g = power[-k];
  uint64_t odd = c & 1, low = round_to_odd(g, (4 * c - 2 + lower_is_closer) << h) + odd, v = round_to_odd(g, (4 * c) << h),
           high = round_to_odd(g, (4 * c + 2) << h) - odd, s = v / 4, tens = s / 10, rest = v & 3;
  uint64_t tens_under = low <= 40 * tens, tens_over = 40 * tens + 40 <= high;
  uint64_t under = low <= 4 * s, over = 4 * s + 4 <= high, nearer = (rest > 2) | ((rest == 2) & s);
  uint64_t one = s + (under != over ? over : nearer), ten = tens + tens_over;
  bool shorter = tens_under != tens_over;
  return (Decimal){shorter ? ten : one, k + shorter};
}

// 17 digits with leading zeros at to, which has room for 24.
static void put_digits17(char *to, uint64_t digits)
{
  const uint64_t e8 = 100000000;
  uint64_t upper = digits / e8, first = upper / e8;
  to[0] = (char)('0' + first);
  decimal_store8(to + 1, decimal_digits8(upper - first * e8) | 0x3030303030303030);
  decimal_store8(to + 9, decimal_digits8(digits - upper * e8) | 0x3030303030303030);
}

// Zeros at the end of n > 1 digits, at least one of which is none; memory before them may be read.
static int count_zeros(const char *digits, int n)
{
  uint64_t last = decimal_load8(digits + n - 8) ^ 0x3030303030303030;
  int zeros = 0;
  while (!last) {
    zeros += 8;
    last = decimal_load8(digits + n - 8 - zeros) ^ 0x3030303030303030;
  }
  return zeros + __builtin_clzll(last) / 8;
}

// d.ddde-xx
static size_t print_scientific(char *to, const char *digits, int n, int exponent)
{
  char *p = to;
  *p++ = digits[0];
  if (n > 1) {
    *p++ = '.';
    memcpy(p, digits + 1, 16);
    p += n - 1;
  }
  unsigned e = (unsigned)abs(exponent);
  *p++ = 'e';
  *p++ = exponent < 0 ? '-' : '+';
  *p++ = (char)('0' + e / 10);
  *p++ = (char)('0' + e % 10);
  return (size_t)(p - to);
}

// n digits times 10^exponent as <charconv> writes them: the shorter of the two notations, the fixed one if both are equal.
static size_t print_decimal(char *to, const char *digits, int n, int exponent)
{
  int single = n == 1;
  if (exponent < -(n + 3) + single || exponent > 5 - single) return print_scientific(to, digits, n, exponent + n - 1);
  int whole = n + exponent; // digits before the dot
  if (whole <= 0) {
    memcpy(to, "0.000000", 8);
    memcpy(to + 2 - whole, digits, 17);
    return (size_t)(2 - whole + n);
  }
  memcpy(to, digits, 17);
  if (exponent >= 0) {
    memset(to + n, '0', 5);
    return (size_t)whole;
  }
  to[whole] = '.';
  memcpy(to + whole + 1, digits + whole, 16);
  return (size_t)(n + 1);
}

size_t decimal_print(char *to, double v)
{
  uint64_t bits;
  memcpy(&bits, &v, sizeof bits);
  const double a = fabs(v);
  if (!((a >= 1e-38 && a < 0x1p53) || a == 0)) return 0;
  size_t sign = bits >> 63;
  *to = '-';
  to += sign;
  uint64_t fraction = bits & 0xfffffffffffff, whole = (uint64_t)a;
  if (whole == 0 && a == 0) {
    *to = '0';
    return sign + 1;
  }
  Decimal d = (double)whole == a ? (Decimal){whole, 0}
                                 : shortest(fraction | (uint64_t)1 << 52, (int)(bits >> 52 & 0x7ff) - 1075, fraction == 0);
  char text[48];
  put_digits17(text + 8, d.digits);
  char *digits = text + 8 + (text[8] == '0');
  while (*digits == '0') digits++;
  int n = (int)(text + 25 - digits), zeros = count_zeros(digits, n);
  return sign + print_decimal(to, digits, n - zeros, d.exponent + zeros);
}
