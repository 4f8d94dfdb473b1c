// rng.h - small seeded generator: equal seeds, equal numbers, on every machine
// SPDX-License-Identifier: MIT
#ifndef BASE_RNG_H
#define BASE_RNG_H

#include "base/base.h"

typedef struct {
  uint64_t state;
} Rng;

// splitmix64
static inline uint64_t rng_next(Rng *r)
{
  uint64_t z = (r->state += 0x9e3779b97f4a7c15u);
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

// In [0, 1), 53 bits.
static inline double rng_double(Rng *r)
{
  return (double)(rng_next(r) >> 11) * 0x1p-53;
}

// In [0, n), n > 0; the bias of the remainder is below n / 2^64.
static inline uint32_t rng_below(Rng *r, uint32_t n)
{
  return (uint32_t)(rng_next(r) % n);
}

#endif
