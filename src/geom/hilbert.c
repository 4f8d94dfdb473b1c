// hilbert.c - order points along a Hilbert curve: integer keys and a radix sort
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/hilbert.h"

#include "base/mem.h"
#include "geom/predicates.h"

// Going down from the whole square, the curve in a quadrant is the parent's with the axes swapped (s) or both
// complemented (c). With u = s ^ c, the bits x, y of the next level change the state by
//   x == y:  u ^= c ^ !x        x != y:  c ^= u ^ x
// and the quadrant's number along the curve is 2 x' + (x' ^ y') for the bits x', y' seen in the state.
uint64_t hilbert_key(uint32_t x, uint32_t y)
{
  uint64_t key = 0;
  uint32_t u = 0, c = 0;
  for (int i = 31; i >= 0; i--) {
    uint32_t a = x >> i & 1, b = y >> i & 1, s = u ^ c, differ = a ^ b;
    uint32_t ra = a ^ (s & differ) ^ c; // x'; y' = x' ^ differ
    key = key << 2 | (2 * ra + differ);
    u ^= ~differ & (c ^ a ^ 1);
    c ^= differ & (u ^ a);
  }
  return key;
}

typedef struct {
  uint64_t key;
  uint32_t index;
} Item;

// Least significant digit first; passes in which all items agree are skipped.
static Item *radix_sort(Item *a, Item *b, size_t n)
{
  enum { BITS = 11, BUCKETS = 1 << BITS };
  uint32_t *count = mem_alloc(BUCKETS * sizeof *count);
  for (int shift = 0; shift < 64; shift += BITS) {
    memset(count, 0, BUCKETS * sizeof *count);
    for (size_t i = 0; i < n; i++) count[a[i].key >> shift & (BUCKETS - 1)]++;
    if (count[a[0].key >> shift & (BUCKETS - 1)] == n) continue;
    uint32_t sum = 0;
    for (int k = 0; k < BUCKETS; k++) {
      uint32_t c = count[k];
      count[k] = sum;
      sum += c;
    }
    for (size_t i = 0; i < n; i++) b[count[a[i].key >> shift & (BUCKETS - 1)]++] = a[i];
    Item *t = a;
    a = b;
    b = t;
  }
  free(count);
  return a;
}

static bool before(const double *xy, uint32_t i, uint32_t j)
{
  int s = lex_compare(xy + 2 * (size_t)i, xy + 2 * (size_t)j);
  return s ? s < 0 : i < j;
}

// Heap sort of order[0..n) by coordinates, then index.
static void sort_run(const double *xy, uint32_t *order, size_t n)
{
  for (size_t end = n, start = n / 2; end > 1;) {
    uint32_t v;
    if (start > 0) v = order[--start];
    else {
      v = order[--end];
      order[end] = order[0];
    }
    size_t i = start, k;
    while ((k = 2 * i + 1) < end) {
      if (k + 1 < end && before(xy, order[k], order[k + 1])) k++;
      if (!before(xy, v, order[k])) break;
      order[i] = order[k];
      i = k;
    }
    order[i] = v;
  }
}

void hilbert_order(const double *xy, size_t n, uint32_t *order)
{
  if (n == 0) return;
  double lo[2] = {xy[0], xy[1]}, hi[2] = {xy[0], xy[1]};
  for (size_t i = 0; i < n; i++)
    for (int k = 0; k < 2; k++) {
      double v = xy[2 * i + (size_t)k];
      if (v < lo[k]) lo[k] = v;
      if (v > hi[k]) hi[k] = v;
    }
  // Quarters, so that the width of the box cannot overflow.
  double w = MAX(hi[0] / 4 - lo[0] / 4, hi[1] / 4 - lo[1] / 4);
  Item *a = mem_alloc(n * sizeof *a), *b = mem_alloc(n * sizeof *b);
  for (size_t i = 0; i < n; i++) {
    uint32_t q[2];
    for (int k = 0; k < 2; k++) {
      double f = w > 0 ? (xy[2 * i + (size_t)k] / 4 - lo[k] / 4) / w : 0;
      q[k] = (uint32_t)(f * 4294967295.0);
    }
    a[i] = (Item){hilbert_key(q[0], q[1]), (uint32_t)i};
  }
  Item *sorted = radix_sort(a, b, n);
  for (size_t i = 0; i < n; i++) order[i] = sorted[i].index;
  for (size_t i = 0, j; i < n; i = j) {
    for (j = i + 1; j < n && sorted[j].key == sorted[i].key;) j++;
    if (j > i + 1) sort_run(xy, order + i, j - i);
  }
  free(a);
  free(b);
}
