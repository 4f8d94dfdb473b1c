// check.c - assertions with levels, and the abort that says where
// SPDX-License-Identifier: MIT
#include "base/base.h"

static _Thread_local struct {
  const char *stage;
  long entity;
} context;

void check_context(const char *stage, long entity)
{
  context.stage = stage;
  context.entity = entity;
}

void check_failed(const char *file, int line, const char *cond)
{
  fflush(stdout);
  fprintf(stderr, "meshgen: internal error: %s:%d: %s\n", file, line, cond);
  if (context.stage)
    fprintf(stderr, "meshgen: while in stage '%s', entity %ld\n", context.stage, context.entity);
  fprintf(stderr, "meshgen: this is a bug; please report it with the input file\n");
  abort();
}

