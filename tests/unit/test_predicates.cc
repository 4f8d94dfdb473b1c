// test_predicates.cc - signs equal CGAL's exact ones and MPFR's, on random and adversarial coordinates
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Gmpq.h>

#include <cmath>

#include "unit.h" // after CGAL: its macros would get in the way

extern "C" {
#include "base/rng.h"
#include "geom/predicates.h"
}

typedef CGAL::Simple_cartesian<CGAL::Gmpq> Exact;

enum { KINDS = 10 };

// n coordinates of a kind that is hard in its own way.
static void draw(int kind, Rng *r, double *q, int n)
{
  static const double special[] = {0, -0.0, 1e300, -1e300, 5e-324, 1, -1, 1e-300, 1.7976931348623157e308, -1.7976931348623157e308};
  double base = rng_double(r);
  for (int i = 0; i < n; i++) switch (kind) {
    case 0: q[i] = rng_double(r); break;                                                 // general position
    case 1: q[i] = rng_below(r, 5); break;                                               // small grid
    case 2: q[i] = rng_below(r, 1000) / 999.0; break;                                    // rounded grid
    case 3: q[i] = 0.5 + rng_below(r, 16) * 0x1p-53; break;                              // neighbours by ulps
    case 4: q[i] = ldexp((double)rng_below(r, 64), -1074 + (int)rng_below(r, 4)); break; // subnormal
    case 5: q[i] = ldexp(1.0 + rng_below(r, 7), 1000 + (int)rng_below(r, 21)); break;    // near overflow
    case 6: q[i] = ldexp(rng_double(r) - 0.5, (int)rng_below(r, 2000) - 1000); break;    // any exponent
    case 7: q[i] = ldexp(rng_double(r) - 0.5, (int)rng_below(r, 100) - 50); break;       // exponents somewhat apart
    case 8: q[i] = special[rng_below(r, 10)]; break;
    case 9: // near a circle or a line through all, an ulp here or there
      q[i] = i % 2 == 0 ? cos(base + i) : sin(base + i - 1);
      if (rng_below(r, 3) == 0) q[i] = nextafter(q[i], rng_below(r, 2) ? 2 : -2);
      break;
    }
}

// Cases of each kind; $PREDICATE_CASES is their number in all, for the long tier.
static long cases(long n)
{
  const char *all = getenv("PREDICATE_CASES");
  return all ? strtol(all, NULL, 10) / KINDS : n;
}

static void equal_to_cgal(void **)
{
  Rng r = {3};
  for (int kind = 0; kind < KINDS; kind++)
    for (long i = 0; i < cases(2000); i++) {
      double q[8];
      draw(kind, &r, q, 8);
      Exact::Point_2 p[4];
      for (int k = 0; k < 4; k++) p[k] = Exact::Point_2(CGAL::Gmpq(q[2 * k]), CGAL::Gmpq(q[2 * k + 1]));
      assert_int_equal(orient2d(q, q + 2, q + 4), (int)CGAL::orientation(p[0], p[1], p[2]));
      int turn = orient2d(q, q + 2, q + 4);
      if (turn) { // CGAL's test is of the oriented circle too
        assert_int_equal(incircle(q, q + 2, q + 4, q + 6), (int)CGAL::side_of_oriented_circle(p[0], p[1], p[2], p[3]));
        assert_int_equal(in_diametral_circle(q, q + 2, q + 4), -(int)CGAL::angle(p[0], p[2], p[1]));
      }
    }
}

static void equal_to_mpfr(void **)
{
  Rng r = {4};
  for (int kind = 0; kind < KINDS; kind++)
    for (long i = 0; i < cases(30000); i++) {
      double q[8];
      draw(kind, &r, q, 8);
      assert_int_equal(orient2d(q, q + 2, q + 4), orient2d_mp(q, q + 2, q + 4));
      assert_int_equal(incircle(q, q + 2, q + 4, q + 6), incircle_mp(q, q + 2, q + 4, q + 6));
      if (i % 8) continue;
      assert_int_equal(cross_sign(q, q + 2, q + 4, q + 6), cross_mp(q, q + 2, q + 4, q + 6));
      assert_int_equal(in_diametral_circle(q, q + 2, q + 4), -dot_mp(q, q + 2, q + 4));
    }
}

// Swapping two arguments changes the sign; the perturbed test too, and it is never 0.
static void antisymmetric(void **)
{
  Rng r = {5};
  for (int kind = 0; kind < KINDS; kind++)
    for (int i = 0; i < 3000; i++) {
      double q[8];
      draw(kind, &r, q, 8);
      const double *a = q, *b = q + 2, *c = q + 4, *d = q + 6;
      assert_int_equal(orient2d(a, b, c), -orient2d(b, a, c));
      assert_int_equal(orient2d(a, b, c), orient2d(b, c, a));
      assert_int_equal(incircle(a, b, c, d), -incircle(b, a, c, d));
      if (orient2d(a, b, c) <= 0 || !lex_compare(a, d) || !lex_compare(b, d) || !lex_compare(c, d)) continue;
      int s = incircle_perturbed(a, b, c, d, NULL);
      assert_true(s == 1 || s == -1);
      assert_int_equal(s, incircle_perturbed(b, c, a, d, NULL));
      // Seen from the other triangle of the same quadrilateral the answer is the same.
      if (orient2d(b, a, d) > 0) assert_int_equal(s, incircle_perturbed(b, a, d, c, NULL));
    }
}

// Three points of a circle of radius 2^150 about the origin, and one that is beyond it by far less than 200 bits can tell.
static void two_hundred_bits_are_not_enough(void **)
{
  const double big = 0x1p150, a[2] = {big, 0}, b[2] = {0, big}, c[2] = {-big, 0}, d[2] = {0x1p-250, -big};
  assert_int_equal(incircle_fixed(a, b, c, d, 200), 1); // says inside
  assert_int_equal(incircle_mp(a, b, c, d), -1);
  assert_int_equal(incircle(a, b, c, d), -1);
  assert_int_equal(incircle_fixed(a, b, c, d, 2000), -1);
}

static void meetings(void **)
{
  const double a[2] = {0, 0}, b[2] = {4, 0}, c[2] = {2, -1}, d[2] = {2, 1}, e[2] = {2, 0}, f[2] = {6, 0}, g[2] = {5, 1};
  assert_int_equal(segments_meet(a, b, c, d), SEG_CROSS);
  assert_int_equal(segments_meet(a, b, e, d), SEG_TOUCH);
  assert_int_equal(segments_meet(a, b, b, g), SEG_SHARE);
  assert_int_equal(segments_meet(a, b, b, f), SEG_SHARE);
  assert_int_equal(segments_meet(a, b, e, f), SEG_OVERLAP);
  assert_int_equal(segments_meet(a, e, b, f), SEG_DISJOINT);
  assert_int_equal(segments_meet(a, b, f, g), SEG_DISJOINT);
  double p[2];
  segments_point(a, b, c, d, p);
  assert_true(p[0] == 2 && p[1] == 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(equal_to_cgal),
    cmocka_unit_test(equal_to_mpfr),
    cmocka_unit_test(antisymmetric),
    cmocka_unit_test(two_hundred_bits_are_not_enough),
    cmocka_unit_test(meetings),
  };
  return unit_run(tests);
}
