// stats.h - what each stage took: wall and processor time, memory, counters
// SPDX-License-Identifier: MIT
#ifndef BASE_STATS_H
#define BASE_STATS_H

#include "base/base.h"

typedef struct {
  const char *name;  // not owned; a literal
  int depth;         // stages nest
  double wall, cpu;  // seconds, children included
  size_t peak;       // bytes of the process's peak resident set at its end
} Stage;

enum { STATS_MAX_STAGES = 64 };

typedef struct {
  Stage stage[STATS_MAX_STAGES]; // in order of their beginning; a stage begun twice adds up
  int n, depth, open[16];
  double wall0[16], cpu0[16];
} Stats;

// Begin and end a stage; also tells check_context. Further stages than there is room for are dropped.
void stage_begin(Stats *s, const char *name);
void stage_end(Stats *s);

// Seconds since some fixed moment: of the clock, and of this process's processor time.
double time_wall(void);
double time_cpu(void);
double time_thread(void); // of this thread alone

#endif
