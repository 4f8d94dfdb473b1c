// test_number.cc - whole numbers to text and back against the C++ library
#include <charconv>
#include <cstring>
#include <initializer_list>

extern "C" {
#include "unit.h"
}

#include "base/decimal.h"
#include "base/number.h"

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
      cmocka_unit_test(whole_numbers_are_printed_and_read_eight_digits_at_a_time),
  };
  return unit_run(tests);
}
