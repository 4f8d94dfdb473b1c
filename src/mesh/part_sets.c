// part_sets.c - distinct lists of parts
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/part_entities_int.h"

static bool is_set(const PartSets *s, uint32_t set, const uint32_t *part, uint32_t n)
{
  uint32_t len;
  const uint32_t *p = part_sets__at(s, set, &len);
  return len == n && memcmp(p, part, n * sizeof *p) == 0;
}

uint32_t part_sets__get(PartSets *s, const uint32_t *part, uint32_t n)
{
  uint64_t key = n;
  for (uint32_t i = 0; i < n; i++) key = (key ^ part[i]) * 0x9e3779b97f4a7c15u + (key >> 29);
  key >>= 1; // never UINT64_MAX
  if (!s->start.len) vec_push(&s->start, 0);
  uint32_t there;
  while ((there = map_get(&s->index, key)) != NONE) {
    if (is_set(s, there, part, n)) return there;
    key = (key + 1) & (UINT64_MAX >> 1); // another list has this key
  }
  uint32_t set = (uint32_t)s->start.len - 1;
  map_set(&s->index, key, set);
  for (uint32_t i = 0; i < n; i++) vec_push(&s->part, part[i]);
  vec_push(&s->start, (uint32_t)s->part.len);
  return set;
}

uint32_t part_sets__union(PartSets *s, uint32_t a, uint32_t b)
{
  uint32_t na, nb, n = 0, i = 0, j = 0;
  if (a == b) return a;
  const uint32_t *p = part_sets__at(s, a, &na), *q = part_sets__at(s, b, &nb);
  uint32_t *both = mem_alloc((na + nb) * sizeof *both);
  while (i < na || j < nb) {
    uint32_t x = j >= nb || (i < na && p[i] < q[j]) ? p[i] : q[j];
    both[n++] = x;
    i += i < na && p[i] == x;
    j += j < nb && q[j] == x;
  }
  uint32_t set = part_sets__get(s, both, n);
  free(both);
  return set;
}

void part_sets__free(PartSets *s)
{
  vec_free(&s->start);
  vec_free(&s->part);
  map_free(&s->index);
}
