// map.h - open-addressing maps from 64-bit keys and from strings to 32-bit values
// SPDX-License-Identifier: MIT
#ifndef BASE_MAP_H
#define BASE_MAP_H

#include "base/base.h"

// uint64 -> uint32. Zero-initialize; map_free when done. The key UINT64_MAX is not allowed. There is no way to iterate:
// nothing may depend on the order of a hash table.
typedef struct {
  uint64_t *keys;
  uint32_t *values;
  size_t len, cap;
} Map;

// Value of key, or NONE. Expected O(1).
uint32_t map_get(const Map *m, uint64_t key);
// Set key to value, new or old.
void map_set(Map *m, uint64_t key, uint32_t value);
// The slot of key, made with value `fresh` if it was absent (*added says so). Valid until the next change.
uint32_t *map_slot(Map *m, uint64_t key, uint32_t fresh, bool *added);
void map_remove(Map *m, uint64_t key);
void map_reserve(Map *m, size_t n);
void map_free(Map *m);

// Key of an unordered pair of 32-bit ids, such as the end nodes of an edge.
static inline uint64_t map_pair(uint32_t a, uint32_t b)
{
  return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

// String -> uint32, keys copied into the map. Zero-initialize; names_free when done.
typedef struct {
  struct { char *key; uint32_t hash, value; } *slots;
  size_t len, cap;
} Names;

// Each in expected O(length of the key). names_set replaces the value of a key that is there; names_remove of one that is not does
// nothing.
uint32_t names_get(const Names *m, const char *key); // or NONE
void names_set(Names *m, const char *key, uint32_t value);
void names_remove(Names *m, const char *key);
void names_free(Names *m);

#endif
