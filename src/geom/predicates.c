// predicates.c - the exact stages of the predicates: fixed-width integers, then expansions
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/predicates.h"

#include "geom/predicates_int.h"

// ---- integers ---------------------------------------------------------------------------------------------------
// A finite double is an integer times a power of two. When the coordinate differences of one call, in units of the
// lowest bit of any coordinate, stay below 2^61, the sign comes from plain 64, 128 and 256-bit integers. Differences
// are formed modulo 2^64, so only they need to fit, not the coordinates.

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 Uint128;

enum { EXPONENT_NONE = 4000 }; // of zero: above every exponent

static inline uint64_t bits_of(double x)
{
  uint64_t b;
  memcpy(&b, &x, sizeof b);
  return b;
}

// Exponent (biased, of the unit) of the lowest set bit of x.
static inline int low_exponent(double x)
{
  uint64_t b = bits_of(x), f = b & 0xfffffffffffffu;
  int e = (int)(b >> 52 & 0x7ff);
  if (e == 0) {
    if (f == 0) return EXPONENT_NONE;
    return 1 + __builtin_ctzll(f);
  }
  return f ? e + __builtin_ctzll(f) : e + 52;
}

// x in units of the exponent `low`, modulo 2^64.
static inline uint64_t to_units(double x, int low)
{
  uint64_t b = bits_of(x), f = b & 0xfffffffffffffu;
  int e = (int)(b >> 52 & 0x7ff);
  if (e == 0) e = 1;
  else f |= (uint64_t)1 << 52;
  int s = e - low;
  uint64_t u = s >= 64 || f == 0 ? 0 : s >= 0 ? f << s : f >> -s;
  return b >> 63 ? 0 - u : u;
}

// The n differences q[2i] - q[2i+1] in common units into d[]. Returns the bits of the largest, or -1 if some does not fit.
static int unit_differences(const double *q, int n, int64_t *d)
{
  int low = EXPONENT_NONE;
  double largest = 0;
  for (int i = 0; i < n; i++) {
    int u = low_exponent(q[2 * i]), v = low_exponent(q[2 * i + 1]);
    double f = fabs(q[2 * i] - q[2 * i + 1]);
    low = MIN(low, MIN(u, v));
    if (f > largest) largest = f;
  }
  if (largest == 0) {
    memset(d, 0, (size_t)n * sizeof *d);
    return 0;
  }
  int high = (int)(bits_of(largest) >> 52 & 0x7ff) + 53; // largest < 2^high units of exponent 0, rounding included
  int width = high - low + 1;
  if (high >= 0x7ff + 53 || width > 61) return -1;
  width = MAX(width, 0);
  for (int i = 0; i < n; i++) d[i] = (int64_t)(to_units(q[2 * i], low) - to_units(q[2 * i + 1], low));
  return width;
}

static inline int sign_of_i128(Int128 x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// A signed 256-bit sum of products, as four words in two's complement.
typedef struct {
  uint64_t w[4];
} Int256;

// s += l * c
static void add_product(Int256 *s, Uint128 l, Int128 c)
{
  bool negative = c < 0;
  Uint128 u = negative ? (Uint128)0 - (Uint128)c : (Uint128)c;
  uint64_t l0 = (uint64_t)l, l1 = (uint64_t)(l >> 64), u0 = (uint64_t)u, u1 = (uint64_t)(u >> 64);
  Uint128 p00 = (Uint128)l0 * u0, p01 = (Uint128)l0 * u1, p10 = (Uint128)l1 * u0, p11 = (Uint128)l1 * u1;
  Uint128 mid = (p00 >> 64) + (uint64_t)p01 + (uint64_t)p10;
  Uint128 high = p11 + (p01 >> 64) + (p10 >> 64) + (mid >> 64);
  uint64_t w[4] = {(uint64_t)p00, (uint64_t)mid, (uint64_t)high, (uint64_t)(high >> 64)};
  Uint128 carry = negative;
  for (int i = 0; i < 4; i++) {
    carry += (Uint128)s->w[i] + (negative ? ~w[i] : w[i]);
    s->w[i] = (uint64_t)carry;
    carry >>= 64;
  }
}

// Sign of the incircle determinant of the differences d = {ax ay bx by cx cy}, each below 2^61 in magnitude.
static int incircle_units(const int64_t *d, int width)
{
  Int128 bc = (Int128)d[2] * d[5] - (Int128)d[4] * d[3];
  Int128 ca = (Int128)d[4] * d[1] - (Int128)d[0] * d[5];
  Int128 ab = (Int128)d[0] * d[3] - (Int128)d[2] * d[1];
  Int128 al = (Int128)d[0] * d[0] + (Int128)d[1] * d[1];
  Int128 bl = (Int128)d[2] * d[2] + (Int128)d[3] * d[3];
  Int128 cl = (Int128)d[4] * d[4] + (Int128)d[5] * d[5];
  if (width <= 30) return sign_of_i128(al * bc + bl * ca + cl * ab); // 3 * 2^61 * 2^61 < 2^127
  Int256 s = {{0, 0, 0, 0}};
  add_product(&s, (Uint128)al, bc);
  add_product(&s, (Uint128)bl, ca);
  add_product(&s, (Uint128)cl, ab);
  if (s.w[3] >> 63) return -1;
  return (s.w[0] | s.w[1] | s.w[2] | s.w[3]) != 0;
}

// ---- expansions [Shewchuk97] --------------------------------------------------------------------------------------
// A number as an exact sum of doubles that do not overlap, smallest first, zeros left out. Exact as long as nothing
// over- or underflows, which the callers make sure of by the exponents.

static inline void two_sum(double a, double b, double *hi, double *lo)
{
  double s = a + b, bb = s - a;
  *lo = (a - (s - bb)) + (b - bb);
  *hi = s;
}

static inline void two_product(double a, double b, double *hi, double *lo)
{
  const double splitter = 134217729; // 2^27 + 1
  double c = splitter * a, ah = c - (c - a), al = a - ah;
  double d = splitter * b, bh = d - (d - b), bl = b - bh;
  double p = a * b;
  *lo = al * bl - (((p - ah * bh) - al * bh) - ah * bl);
  *hi = p;
}

// h = e + b; returns the length. h may be e.
static int expansion_grow(int n, const double *e, double b, double *h)
{
  int k = 0;
  double q = b;
  for (int i = 0; i < n; i++) {
    double lo;
    two_sum(q, e[i], &q, &lo);
    if (lo != 0) h[k++] = lo;
  }
  if (q != 0) h[k++] = q;
  return k;
}

// h = e + f, by adding the components one by one. h must not overlap f. h may be e.
static int expansion_add(int n, const double *e, int m, const double *f, double *h)
{
  int k = n;
  if (h != e) memcpy(h, e, (size_t)n * sizeof *h);
  for (int i = 0; i < m; i++) k = expansion_grow(k, h, f[i], h);
  return k;
}

// h = e * b, at most 2n components.
static int expansion_scale(int n, const double *e, double b, double *h)
{
  int k = 0;
  double q = 0;
  for (int i = 0; i < n; i++) {
    double hi, lo, s;
    two_product(e[i], b, &hi, &lo);
    two_sum(q, lo, &s, &lo);
    if (lo != 0) h[k++] = lo;
    two_sum(hi, s, &q, &lo);
    if (lo != 0) h[k++] = lo;
  }
  if (q != 0) h[k++] = q;
  return k;
}

enum { MAX_PRODUCT = 32 }; // components of the factors of the longest product

// h = e * f, at most 2nm components; n, m <= MAX_PRODUCT.
static int expansion_multiply(int n, const double *e, int m, const double *f, double *h)
{
  double t[2 * MAX_PRODUCT];
  int k = 0;
  for (int i = 0; i < m; i++) {
    int l = expansion_scale(n, e, f[i], t);
    k = expansion_add(k, h, l, t, h);
  }
  return k;
}

static int expansion_difference(double a, double b, double *h)
{
  double hi, lo;
  int k = 0;
  two_sum(a, -b, &hi, &lo);
  if (lo != 0) h[k++] = lo;
  if (hi != 0) h[k++] = hi;
  return k;
}

static void expansion_negate(int n, double *e)
{
  for (int i = 0; i < n; i++) e[i] = -e[i];
}

static int expansion_sign(int n, const double *e)
{
  if (n == 0) return 0;
  return e[n - 1] > 0 ? 1 : -1;
}

// h = p q - r s of expansions of at most 2 components; at most 16 components.
static int expansion_cross(const double *p, int np, const double *q, int nq, const double *r, int nr, const double *s,
                           int ns, double *h)
{
  double t[8];
  int k = expansion_multiply(np, p, nq, q, h);
  int l = expansion_multiply(nr, r, ns, s, t);
  expansion_negate(l, t);
  return expansion_add(k, h, l, t, h);
}

// Are all of q[0..n) zero or of magnitude in [2^lo, 2^hi)?
static bool exponents_within(const double *q, int n, int lo, int hi)
{
  for (int i = 0; i < n; i++) {
    int e = (int)(bits_of(q[i]) >> 52 & 0x7ff) - 1023;
    if (q[i] != 0 && (e < lo || e >= hi)) return false;
  }
  return true;
}

// ---- predicates ---------------------------------------------------------------------------------------------------

// Sign of (q0 - q1)(q2 - q3) - (q4 - q5)(q6 - q7). A term of the expansion is a multiple of 2^(2 (-450 - 53)).
static int sign_of_products(const double *q, PredCount *count)
{
  int64_t d[4];
  if (unit_differences(q, 4, d) >= 0) return sign_of_i128((Int128)d[0] * d[1] - (Int128)d[2] * d[3]);
  if (!exponents_within(q, 8, -450, 450)) {
    if (count) count->multiprecision++;
    return predicates__products_mp(q);
  }
  if (count) count->expansion++;
  double e[4][2], h[32];
  int n[4];
  for (int i = 0; i < 4; i++) n[i] = expansion_difference(q[2 * i], q[2 * i + 1], e[i]);
  int k = expansion_cross(e[0], n[0], e[1], n[1], e[2], n[2], e[3], n[3], h);
  return expansion_sign(k, h);
}

int orient2d_slow(const double *a, const double *b, const double *c, PredCount *count)
{
  if (count) count->orient_slow++;
  double q[8] = {a[0], c[0], b[1], c[1], a[1], c[1], b[0], c[0]};
  return sign_of_products(q, count);
}

int cross_sign(const double *a, const double *b, const double *c, const double *d)
{
  double l = (b[0] - a[0]) * (d[1] - c[1]), r = (b[1] - a[1]) * (d[0] - c[0]);
  double det = l - r, bound = ORIENT_BOUND * (fabs(l) + fabs(r)) + ORIENT_TINY;
  if (det > bound) return 1;
  if (-det > bound) return -1;
  double q[8] = {b[0], a[0], d[1], c[1], b[1], a[1], d[0], c[0]};
  return sign_of_products(q, NULL);
}

int in_diametral_circle(const double *a, const double *b, const double *p)
{
  double l = (a[0] - p[0]) * (b[0] - p[0]), r = (a[1] - p[1]) * (b[1] - p[1]);
  double dot = l + r, bound = ORIENT_BOUND * (fabs(l) + fabs(r)) + ORIENT_TINY;
  if (dot > bound) return -1;
  if (-dot > bound) return 1;
  double q[8] = {p[0], a[0], b[0], p[0], a[1], p[1], b[1], p[1]};
  return sign_of_products(q, NULL);
}

// The incircle determinant as an expansion. Its terms are multiples of 2^(4 (-200 - 53)).
static int incircle_expansion(const double *q)
{
  double e[6][2], cross[3][16], lift[3][16], t[8], prod[512], sum[1536];
  int n[6], k = 0;
  for (int i = 0; i < 6; i++) n[i] = expansion_difference(q[2 * i], q[2 * i + 1], e[i]);
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, l = (i + 2) % 3; // lift of i times cross of j and l
    int nc = expansion_cross(e[2 * j], n[2 * j], e[2 * l + 1], n[2 * l + 1], e[2 * l], n[2 * l], e[2 * j + 1],
                             n[2 * j + 1], cross[i]);
    int nl = expansion_multiply(n[2 * i], e[2 * i], n[2 * i], e[2 * i], lift[i]);
    int nt = expansion_multiply(n[2 * i + 1], e[2 * i + 1], n[2 * i + 1], e[2 * i + 1], t);
    nl = expansion_add(nl, lift[i], nt, t, lift[i]);
    int np = expansion_multiply(nl, lift[i], nc, cross[i], prod);
    k = expansion_add(k, sum, np, prod, sum);
  }
  return expansion_sign(k, sum);
}

int incircle_slow(const double *a, const double *b, const double *c, const double *d, PredCount *count)
{
  if (count) count->incircle_slow++;
  double q[12] = {a[0], d[0], a[1], d[1], b[0], d[0], b[1], d[1], c[0], d[0], c[1], d[1]};
  int64_t u[6];
  int width = unit_differences(q, 6, u);
  if (width >= 0) return incircle_units(u, width);
  if (!exponents_within(q, 12, -200, 230)) {
    if (count) count->multiprecision++;
    return incircle_mp(a, b, c, d);
  }
  if (count) count->expansion++;
  return incircle_expansion(q);
}

int incircle_tie(const double *a, const double *b, const double *c, const double *d, PredCount *count)
{
  if (count) count->ties++;
  const double *p[4] = {a, b, c, d};
  for (int i = 0; i < 3; i++)
    for (int j = 3; j > i; j--)
      if (lex_compare(p[j], p[j - 1]) > 0) {
        const double *t = p[j];
        p[j] = p[j - 1];
        p[j - 1] = t;
      }
  for (int i = 0; i < 4; i++) { // largest perturbation first
    int s = p[i] == a   ? orient2d_count(b, c, d, count)
            : p[i] == b ? orient2d_count(c, a, d, count)
            : p[i] == c ? orient2d_count(a, b, d, count)
                        : -1;
    if (s) return s;
  }
  UNREACHABLE();
}

// ---- segments -------------------------------------------------------------------------------------------------------

static SegMeet collinear_meet(const double *a, const double *b, const double *c, const double *d)
{
  const double *lo1 = a, *hi1 = b, *lo2 = c, *hi2 = d;
  if (lex_compare(lo1, hi1) > 0) lo1 = b, hi1 = a;
  if (lex_compare(lo2, hi2) > 0) lo2 = d, hi2 = c;
  const double *lo = lex_compare(lo1, lo2) > 0 ? lo1 : lo2, *hi = lex_compare(hi1, hi2) < 0 ? hi1 : hi2;
  int s = lex_compare(lo, hi);
  if (s > 0) return SEG_DISJOINT;
  if (s < 0) return SEG_OVERLAP;
  bool end1 = lex_compare(lo, a) == 0 || lex_compare(lo, b) == 0;
  bool end2 = lex_compare(lo, c) == 0 || lex_compare(lo, d) == 0;
  return end1 && end2 ? SEG_SHARE : SEG_TOUCH;
}

SegMeet segments_meet(const double *a, const double *b, const double *c, const double *d)
{
  int c1 = orient2d(a, b, c), d1 = orient2d(a, b, d), a2 = orient2d(c, d, a), b2 = orient2d(c, d, b);
  if (c1 == 0 && d1 == 0 && a2 == 0 && b2 == 0) return collinear_meet(a, b, c, d);
  if (c1 * d1 > 0 || a2 * b2 > 0) return SEG_DISJOINT;
  if (c1 * d1 < 0 && a2 * b2 < 0) return SEG_CROSS;
  // Some end lies on the other's line, and within it.
  return (c1 == 0 || d1 == 0) && (a2 == 0 || b2 == 0) ? SEG_SHARE : SEG_TOUCH;
}

void segments_point(const double *a, const double *b, const double *c, const double *d, double *p)
{
  double ux = b[0] - a[0], uy = b[1] - a[1], vx = d[0] - c[0], vy = d[1] - c[1];
  double t = ((c[0] - a[0]) * vy - (c[1] - a[1]) * vx) / (ux * vy - uy * vx);
  p[0] = a[0] + t * ux;
  p[1] = a[1] + t * uy;
}
