// stats.c - what each stage took: wall and processor time, memory, counters
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/stats.h"

#include <time.h>

#include "base/mem.h"

static double seconds(clockid_t id)
{
  struct timespec t;
  clock_gettime(id, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double time_wall(void) { return seconds(CLOCK_MONOTONIC); }
double time_cpu(void) { return seconds(CLOCK_PROCESS_CPUTIME_ID); }
double time_thread(void) { return seconds(CLOCK_THREAD_CPUTIME_ID); }

void stage_begin(Stats *s, const char *name)
{
  check_context(name, -1);
  CHECK(s->depth < (int)ARRAY_LEN(s->open));
  int i = 0;
  while (i < s->n && !(strcmp(s->stage[i].name, name) == 0 && s->stage[i].depth == s->depth)) i++;
  if (i == s->n) {
    if (s->n < STATS_MAX_STAGES)
      s->stage[s->n++] = (Stage){.name = name, .depth = s->depth};
    else
      i = -1;
  }
  s->open[s->depth] = i;
  s->wall0[s->depth] = time_wall();
  s->cpu0[s->depth] = time_cpu();
  s->depth++;
}

void stage_end(Stats *s)
{
  CHECK(s->depth > 0);
  int i = s->open[--s->depth];
  if (i < 0) return;
  Stage *g = &s->stage[i];
  g->wall += time_wall() - s->wall0[s->depth];
  g->cpu += time_cpu() - s->cpu0[s->depth];
  g->peak = mem_peak();
  check_context(s->depth && s->open[s->depth - 1] >= 0 ? s->stage[s->open[s->depth - 1]].name : NULL, -1);
}
