// lanes.h - two numbers at once
// SPDX-License-Identifier: MIT
#ifndef QUAD_LANES_H
#define QUAD_LANES_H

#include <math.h>

// Two numbers side by side: operators work on both at once.
typedef double Lanes __attribute__((vector_size(16)));
typedef long long LaneMask __attribute__((vector_size(16)));

static inline Lanes lanes_of(double x) { return (Lanes){x, x}; }
static inline Lanes lanes_pick(LaneMask which, Lanes a, Lanes b) { return (Lanes)((which & (LaneMask)a) | (~which & (LaneMask)b)); }
static inline Lanes lanes_max(Lanes a, Lanes b) { return lanes_pick(a > b, a, b); }
static inline Lanes lanes_sqrt(Lanes a) { return (Lanes){sqrt(a[0]), sqrt(a[1])}; }
// The second of a and the first of b.
static inline Lanes lanes_shift(Lanes a, Lanes b) { return (Lanes){a[1], b[0]}; }

#endif
