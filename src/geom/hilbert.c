// hilbert.c - order points along a Hilbert curve: integer keys and a radix sort
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/hilbert.h"

#include "base/mem.h"
#include "base/thread.h"
#include "geom/predicates.h"

enum {
  LEVELS = 16,      // of the curve; two bits of the key each
  BLOCK = 256,      // points whose keys are computed side by side
  CHUNK = 1 << 16,  // points handed to a thread at a time
  RADIX = 256,
};

// Going down from the whole square, the curve in a quadrant is the parent's with the axes swapped (s) or both
// complemented (c). With u = s ^ c, the bits x, y of the next level change the state by
//   x == y:  u ^= c ^ !x        x != y:  c ^= u ^ x
// and the quadrant's number along the curve is 2 x' + (x' ^ y') for the bits x', y' seen in the state.
// The loop over the points is the inner one, in a function of its own, which gcc vectorizes.
static NOINLINE void next_level(const uint32_t *restrict x, const uint32_t *restrict y, int level, uint32_t *restrict u,
                                uint32_t *restrict c, uint32_t *restrict key)
{
  for (int i = 0; i < BLOCK; i++) {
    uint32_t a = x[i] >> level & 1, differ = a ^ (y[i] >> level & 1);
    uint32_t seen = a ^ ((u[i] ^ c[i]) & differ) ^ c[i];
    key[i] = key[i] << 2 | seen << 1 | differ;
    u[i] ^= ~differ & (c[i] ^ a ^ 1) & 1;
    c[i] ^= differ & (u[i] ^ a);
  }
}

static void keys_of_block(const uint32_t *restrict x, const uint32_t *restrict y, uint32_t *restrict key)
{
  uint32_t u[BLOCK] = {0}, c[BLOCK] = {0};
  memset(key, 0, BLOCK * sizeof *key);
  for (int level = LEVELS - 1; level >= 0; level--) next_level(x, y, level, u, c, key);
}

// An item to sort: key in the upper half, index of the point in the lower.
typedef struct {
  const double *xy;
  uint64_t *a, *b;            // items, and as much scratch
  size_t n;
  double lo[2], hi[2], width; // bounding box
  double scale;               // 1, or 1/4 when the width would overflow
  double (*box)[4];           // of each chunk
  uint32_t (*count)[RADIX];   // of each chunk; then where its items go
  uint32_t bucket[RADIX + 1];
  uint32_t *order, *key; // of hilbert_sort
} Sort;

static size_t chunk_end(const Sort *s, size_t k) { return MIN(s->n, (k + 1) * CHUNK); }

static void chunk_box(void *ctx, size_t k, int worker)
{
  Sort *s = ctx;
  (void)worker;
  const double *p = s->xy + 2 * (size_t)(uint32_t)s->a[k * CHUNK];
  double lx = p[0], ly = p[1], hx = p[0], hy = p[1];
  for (size_t i = k * CHUNK; i < chunk_end(s, k); i++) {
    const double *q = s->xy + 2 * (size_t)(uint32_t)s->a[i];
    lx = q[0] < lx ? q[0] : lx;
    ly = q[1] < ly ? q[1] : ly;
    hx = q[0] > hx ? q[0] : hx;
    hy = q[1] > hy ? q[1] : hy;
  }
  s->box[k][0] = lx, s->box[k][1] = ly, s->box[k][2] = hx, s->box[k][3] = hy;
}

static void chunk_keys(void *ctx, size_t k, int worker)
{
  Sort *s = ctx;
  (void)worker;
  uint32_t x[BLOCK] = {0}, y[BLOCK] = {0}, key[BLOCK];
  memset(s->count[k], 0, sizeof s->count[k]);
  double f = s->scale, lx = s->lo[0] * f, ly = s->lo[1] * f;
  for (size_t i = k * CHUNK; i < chunk_end(s, k); i += BLOCK) {
    size_t m = MIN((size_t)BLOCK, chunk_end(s, k) - i);
    for (size_t j = 0; j < m; j++) { // monotonous in the coordinates, so cells are separated by lines
      const double *q = s->xy + 2 * (size_t)(uint32_t)s->a[i + j];
      x[j] = (uint32_t)(int32_t)((q[0] * f - lx) / s->width * 65535.0);
      y[j] = (uint32_t)(int32_t)((q[1] * f - ly) / s->width * 65535.0);
    }
    keys_of_block(x, y, key);
    for (size_t j = 0; j < m; j++) {
      s->a[i + j] = (uint64_t)key[j] << 32 | (uint32_t)s->a[i + j];
      s->count[k][key[j] >> 24]++;
    }
  }
}

static void chunk_scatter(void *ctx, size_t k, int worker)
{
  Sort *s = ctx;
  (void)worker;
  uint32_t *to = s->count[k];
  for (size_t i = k * CHUNK; i < chunk_end(s, k); i++) s->b[to[s->a[i] >> 56]++] = s->a[i];
}

static void insertion_sort(uint64_t *a, size_t n)
{
  for (size_t i = 1; i < n; i++) {
    uint64_t v = a[i];
    size_t j = i;
    for (; j > 0 && a[j - 1] > v; j--) a[j] = a[j - 1];
    a[j] = v;
  }
}

static void order_items(const double *xy, uint64_t *a, uint64_t *b, size_t n, int threads);

// A few items of one cell: by coordinates; equal ones stay by index.
static void sort_by_coordinates(const double *xy, uint64_t *a, size_t n)
{
  for (size_t i = 1; i < n; i++) {
    uint64_t v = a[i];
    const double *p = xy + 2 * (size_t)(uint32_t)v;
    size_t j = i;
    for (; j > 0 && lex_compare(xy + 2 * (size_t)(uint32_t)a[j - 1], p) > 0; j--) a[j] = a[j - 1];
    a[j] = v;
  }
}

// Items of one cell keep its key in their upper halves.
static void sort_ties(const double *xy, uint64_t *a, uint64_t *b, size_t n)
{
  enum { FEW = 12 };
  if (n <= FEW) {
    sort_by_coordinates(xy, a, n);
    return;
  }
  uint64_t key = a[0] >> 32 << 32;
  for (size_t i = 0; i < n; i++) a[i] = (uint32_t)a[i];
  order_items(xy, a, b, n, 1);
  for (size_t i = 0; i < n; i++) a[i] = key | (uint32_t)a[i];
}

// Items of one value of the top byte, from b to a: by the other three bytes of the key, then ties.
static void sort_bucket(void *ctx, size_t k, int worker)
{
  Sort *s = ctx;
  (void)worker;
  size_t from = s->bucket[k], n = s->bucket[k + 1] - from;
  uint64_t *src = s->b + from, *dst = s->a + from;
  if (n <= 48) {
    memcpy(dst, src, n * sizeof *dst);
    insertion_sort(dst, n);
  } else {
    uint32_t count[3][RADIX] = {{0}};
    for (size_t i = 0; i < n; i++)
      for (int d = 0; d < 3; d++) count[d][src[i] >> (32 + 8 * d) & (RADIX - 1)]++;
    for (int d = 0; d < 3; d++) {
      uint32_t sum = 0;
      for (int v = 0; v < RADIX; v++) {
        uint32_t c = count[d][v];
        count[d][v] = sum;
        sum += c;
      }
      for (size_t i = 0; i < n; i++) dst[count[d][src[i] >> (32 + 8 * d) & (RADIX - 1)]++] = src[i];
      uint64_t *t = src;
      src = dst;
      dst = t;
    }
  }
  uint64_t *a = s->a + from;
  for (size_t i = 0, j; i < n; i = j) {
    for (j = i + 1; j < n && a[j] >> 32 == a[i] >> 32;) j++;
    if (j > i + 1) sort_ties(s->xy, a + i, s->b + from + i, j - i);
  }
}

// Order items a[0..n), whose upper halves are 0 and lower halves ascend among equal points; b is scratch.
static void order_items(const double *xy, uint64_t *a, uint64_t *b, size_t n, int threads)
{
  if (n < 2) return;
  size_t chunks = (n + CHUNK - 1) / CHUNK;
  Sort s = {.xy = xy, .a = a, .b = b, .n = n, .scale = 1};
  s.box = mem_alloc(chunks * sizeof *s.box);
  s.count = mem_alloc(chunks * sizeof *s.count);
  thread_for(chunks, threads, chunk_box, &s);
  for (size_t k = 0; k < chunks; k++)
    for (int i = 0; i < 2; i++) {
      if (k == 0 || s.box[k][i] < s.lo[i]) s.lo[i] = s.box[k][i];
      if (k == 0 || s.box[k][2 + i] > s.hi[i]) s.hi[i] = s.box[k][2 + i];
    }
  s.width = MAX(s.hi[0] - s.lo[0], s.hi[1] - s.lo[1]);
  if (!isfinite(s.width)) {
    s.scale = 0.25;
    s.width = MAX(s.hi[0] / 4 - s.lo[0] / 4, s.hi[1] / 4 - s.lo[1] / 4);
  }
  if (s.width > 0) { // else all equal
    thread_for(chunks, threads, chunk_keys, &s);
    uint32_t sum = 0;
    for (int v = 0; v < RADIX; v++) {
      s.bucket[v] = sum;
      for (size_t k = 0; k < chunks; k++) {
        uint32_t c = s.count[k][v];
        s.count[k][v] = sum;
        sum += c;
      }
    }
    s.bucket[RADIX] = sum;
    thread_for(chunks, threads, chunk_scatter, &s);
    thread_for(RADIX, threads, sort_bucket, &s);
  }
  free(s.box);
  free(s.count);
}

static void chunk_number(void *ctx, size_t k, int worker)
{
  Sort *s = ctx;
  (void)worker;
  for (size_t i = k * CHUNK; i < chunk_end(s, k); i++) s->a[i] = i;
}

static void chunk_result(void *ctx, size_t k, int worker)
{
  Sort *s = ctx;
  (void)worker;
  for (size_t i = k * CHUNK; i < chunk_end(s, k); i++) {
    s->order[i] = (uint32_t)s->a[i];
    if (s->key) s->key[i] = (uint32_t)(s->a[i] >> 32);
  }
}

void hilbert_sort(const double *xy, size_t n, uint32_t *order, uint32_t *key, uint64_t *scratch, int threads)
{
  uint64_t *a = scratch ? scratch : mem_alloc_large(2 * n * sizeof *a);
  Sort s = {.a = a, .n = n, .order = order, .key = key};
  size_t chunks = (n + CHUNK - 1) / CHUNK;
  if (n <= CHUNK) threads = 1;
  thread_for(chunks, threads, chunk_number, &s);
  order_items(xy, a, a + n, n, threads);
  thread_for(chunks, threads, chunk_result, &s);
  if (!scratch) free(a);
}

void hilbert_order(const double *xy, size_t n, uint32_t *order) { hilbert_sort(xy, n, order, NULL, NULL, 1); }
