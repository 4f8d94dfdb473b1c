// test_number.cc - numbers to text against the C++ library
#include <charconv>
#include <cstring>
#include <initializer_list>

extern "C" {
#include "unit.h"
}

#include "base/decimal.h"
#include "base/number.h"
#include "base/rng.h"

static void same_text(double v)
{
  char ours[NUMBER_MAX_TEXT], theirs[64];
  size_t n = number_print(ours, v), want = (size_t)(std::to_chars(theirs, theirs + sizeof theirs, v).ptr - theirs);
  assert_int_equal(n, want);
  assert_memory_equal(ours, theirs, n);
}

static double of_bits(uint64_t bits)
{
  double v;
  memcpy(&v, &bits, sizeof v);
  return v;
}

static void doubles_are_printed_as_the_library_does(void **)
{
  Rng rng = {7};
  for (int i = 0; i < 300000; i++) {
    uint64_t r = rng_next(&rng), exponent = (1023 - 130 + r % 190) << 52, fraction = rng_next(&rng) >> 12;
    same_text(of_bits(exponent | fraction | r >> 63 << 63));
    same_text((double)(r >> 11) * 0x1p-53);
    same_text((double)(r % 100000) * (i % 2 ? 1e-3 : 1e-7));
    same_text((double)(int64_t)(r >> (r % 64)));
  }
  for (uint64_t e = 1; e < 2047; e++) // next to a power of two, where the gap below is half of that above
    for (int64_t d = -2; d <= 2; d++) same_text(of_bits((e << 52) + (uint64_t)d));
  for (double v : {0., -0., 0.1, 1e-4, 1e-5, 0.00012, 100000., 1e5 + 1, 1e6, 123456789., 9007199254740991., 9007199254740992., 1e22})
    same_text(v);
}

static void whole_numbers_are_printed_and_read_eight_digits_at_a_time(void **)
{
  uint64_t v = 1;
  for (int digits = 1; digits <= 19; digits++, v *= 10)
    for (uint64_t k : {v - 1, v, v + 1, 3 * v}) {
      char ours[NUMBER_MAX_TEXT], theirs[32];
      size_t n = (size_t)(decimal_put_u64(ours, k) - ours), want = (size_t)(std::to_chars(theirs, theirs + sizeof theirs, k).ptr - theirs);
      assert_int_equal(n, want);
      assert_memory_equal(ours, theirs, n);
      if (n > 7) continue;
      memcpy(ours + n, " 9999999", 8);
      assert_int_equal(decimal_count_digits(decimal_load8(ours)), n);
      assert_int_equal(decimal_value(decimal_load8(ours), (unsigned)n), k);
    }
}

int main()
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(doubles_are_printed_as_the_library_does),
      cmocka_unit_test(whole_numbers_are_printed_and_read_eight_digits_at_a_time),
  };
  return unit_run(tests);
}
