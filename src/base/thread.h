// thread.h - parallel loops whose results do not depend on the number of threads
// SPDX-License-Identifier: MIT
#ifndef BASE_THREAD_H
#define BASE_THREAD_H

#include "base/base.h"

// Call body(ctx, i, worker) for i = 0 .. n-1 on `threads` threads (0: one per processor; 1: in the caller, in order).
// Items are handed out in order of i, so put the largest first. `worker` in [0, threads) picks scratch memory. The
// body must write only what belongs to item i or to its worker, and results must be merged by the caller in order of i.
void thread_for(size_t n, int threads, void (*body)(void *ctx, size_t i, int worker), void *ctx);

// Number of workers thread_for(…, threads, …) would use.
int thread_count(int threads);

#endif
