// lines.c - the lines of a text handed out to several threads
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/lines.h"

#include <pthread.h>

#include "base/thread.h"

enum { PIECE = 1 << 17 }; // bytes, so that what was counted is still near when it is read

typedef struct {
  const char *p, *end;
  size_t n, handed; // lines
  bool failed;
  LinesTake take;
  void *ctx;
  pthread_mutex_t lock;
} Lines;

// Newlines in len bytes: eight at a time, with one counter per byte of a word.
static size_t count_newlines(const char *p, size_t len)
{
  size_t n = 0, i = 0;
  while (len - i >= 8) {
    uint64_t sum = 0;
    size_t to = i + MIN((len - i) / 8, (size_t)255) * 8;
    for (; i < to; i += 8) {
      uint64_t x;
      memcpy(&x, p + i, sizeof x);
      x ^= 0x0a0a0a0a0a0a0a0a;
      sum += ~(((x & 0x7f7f7f7f7f7f7f7f) + 0x7f7f7f7f7f7f7f7f) | x | 0x7f7f7f7f7f7f7f7f) >> 7;
    }
    for (; sum; sum >>= 8) n += sum & 0xff;
  }
  for (; i < len; i++) n += p[i] == '\n';
  return n;
}

// The place after line n, or NULL.
static const char *skip_lines(const char *p, const char *end, size_t n)
{
  while (n-- && p) {
    p = memchr(p, '\n', (size_t)(end - p));
    p += p != NULL;
  }
  return p;
}

// The next piece is from..to, its lines first.. ; returns their number, 0 if there are none or something failed.
static size_t next_piece(Lines *l, const char **from, const char **to, size_t *first)
{
  pthread_mutex_lock(&l->lock);
  size_t left = l->failed ? 0 : l->n - l->handed, lines = 0;
  *from = l->p;
  *first = l->handed;
  if (left) {
    const char *soon = l->p + MIN((size_t)(l->end - l->p), (size_t)PIECE), *newline = memchr(soon, '\n', (size_t)(l->end - soon));
    *to = newline ? newline + 1 : l->end;
    lines = count_newlines(*from, (size_t)(*to - *from));
    if (lines > left) *to = skip_lines(*from, *to, lines = left);
    l->failed = lines == 0; // the text ends too soon
    l->p = *to;
    l->handed += lines;
  }
  pthread_mutex_unlock(&l->lock);
  return lines;
}

static void take_pieces(void *ctx, size_t i, int worker)
{
  Lines *l = ctx;
  const char *from, *to;
  size_t first, n;
  (void)i, (void)worker;
  while ((n = next_piece(l, &from, &to, &first)) != 0) {
    if (l->take(l->ctx, from, l->end, first, n) == to) continue;
    pthread_mutex_lock(&l->lock);
    l->failed = true;
    pthread_mutex_unlock(&l->lock);
  }
}

const char *lines_take(const char *p, const char *end, size_t n, int threads, LinesTake take, void *ctx)
{
  enum { LEAST = 1 << 14 }; // lines that are worth another thread
  threads = thread_count(threads);
  if (threads == 1 || n < LEAST) return take(ctx, p, end, 0, n);
  Lines l = {.p = p, .end = end, .n = n, .take = take, .ctx = ctx};
  pthread_mutex_init(&l.lock, NULL);
  thread_for((size_t)threads, threads, take_pieces, &l);
  pthread_mutex_destroy(&l.lock);
  return l.failed || l.handed < n ? NULL : l.p;
}
