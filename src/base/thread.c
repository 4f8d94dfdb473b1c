// thread.c - parallel loops whose results do not depend on the number of threads
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/thread.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

enum { MAX_THREADS = 256 };

typedef struct {
  size_t n;
  atomic_size_t next;
  void (*body)(void *, size_t, int);
  void *ctx;
} Loop;

typedef struct {
  Loop *loop;
  int worker;
} Share;

static void *work(void *arg)
{
  Share *s = arg;
  for (;;) {
    size_t i = atomic_fetch_add_explicit(&s->loop->next, 1, memory_order_relaxed);
    if (i >= s->loop->n) return NULL;
    s->loop->body(s->loop->ctx, i, s->worker);
  }
}

int thread_count(int threads)
{
  if (threads <= 0) threads = (int)sysconf(_SC_NPROCESSORS_ONLN);
  return MAX(1, MIN(threads, (int)MAX_THREADS));
}

void thread_for(size_t n, int threads, void (*body)(void *ctx, size_t i, int worker), void *ctx)
{
  threads = (int)MIN((size_t)thread_count(threads), MAX(n, (size_t)1));
  if (threads == 1) {
    for (size_t i = 0; i < n; i++) body(ctx, i, 0);
    return;
  }
  Loop loop = {.n = n, .body = body, .ctx = ctx};
  atomic_init(&loop.next, 0);
  pthread_t id[MAX_THREADS];
  Share share[MAX_THREADS];
  int started = 0;
  for (int k = 1; k < threads; k++) {
    share[started] = (Share){&loop, k};
    if (pthread_create(&id[started], NULL, work, &share[started]) != 0) break; // fewer will do
    started++;
  }
  Share mine = {&loop, 0};
  work(&mine);
  for (int k = 0; k < started; k++) pthread_join(id[k], NULL);
}
