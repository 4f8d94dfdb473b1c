// lines.h - the lines of a text handed out to several threads
// SPDX-License-Identifier: MIT
#ifndef BASE_LINES_H
#define BASE_LINES_H

#include "base/base.h"

// Take the n lines at p, the first of which is line `first`; memory up to end may be looked at. Returns the place after their
// last newline, or NULL if something is not as expected.
typedef const char *(*LinesTake)(void *ctx, const char *p, const char *end, size_t first, size_t n);

// Have the n lines at p taken, in pieces whose extent depends on the number of threads (0: one per processor). Returns the place
// after them, or NULL if the text is shorter or a piece was not taken as it is; then others may have been, or not.
const char *lines_take(const char *p, const char *end, size_t n, int threads, LinesTake take, void *ctx);

#endif
