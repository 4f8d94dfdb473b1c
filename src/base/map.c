// map.c - open-addressing maps from 64-bit keys and from strings to 32-bit values
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/map.h"

#include "base/mem.h"

#define NO_KEY UINT64_MAX

static size_t hash_u64(uint64_t x) // splitmix64's finalizer
{
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9u;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebu;
  return (size_t)(x ^ x >> 31);
}

static size_t find(const Map *m, uint64_t key)
{
  size_t i = hash_u64(key) & (m->cap - 1);
  while (m->keys[i] != key && m->keys[i] != NO_KEY) i = (i + 1) & (m->cap - 1);
  return i;
}

static void rehash(Map *m, size_t cap)
{
  Map old = *m;
  m->cap = cap;
  m->keys = mem_alloc(cap * sizeof *m->keys);
  m->values = mem_alloc(cap * sizeof *m->values);
  memset(m->keys, 0xff, cap * sizeof *m->keys);
  for (size_t i = 0; i < old.cap; i++) {
    if (old.keys[i] == NO_KEY) continue;
    size_t j = find(m, old.keys[i]);
    m->keys[j] = old.keys[i];
    m->values[j] = old.values[i];
  }
  free(old.keys);
  free(old.values);
}

void map_reserve(Map *m, size_t n)
{
  size_t cap = MAX(m->cap, (size_t)16);
  while (cap * 3 / 4 < n + 1) cap *= 2;
  if (cap > m->cap) rehash(m, cap);
}

uint32_t map_get(const Map *m, uint64_t key)
{
  if (!m->cap) return NONE;
  size_t i = find(m, key);
  return m->keys[i] == NO_KEY ? NONE : m->values[i];
}

uint32_t *map_slot(Map *m, uint64_t key, uint32_t fresh, bool *added)
{
  DCHECK(key != NO_KEY);
  if ((m->len + 1) * 4 > m->cap * 3) rehash(m, m->cap ? m->cap * 2 : 16);
  size_t i = find(m, key);
  bool absent = m->keys[i] == NO_KEY;
  if (absent) {
    m->keys[i] = key;
    m->values[i] = fresh;
    m->len++;
  }
  if (added) *added = absent;
  return &m->values[i];
}

void map_set(Map *m, uint64_t key, uint32_t value)
{
  *map_slot(m, key, value, NULL) = value;
}

void map_remove(Map *m, uint64_t key)
{
  if (!m->cap) return;
  size_t mask = m->cap - 1, i = find(m, key);
  if (m->keys[i] == NO_KEY) return;
  m->len--;
  for (size_t j = i;;) { // close the gap, so that no tombstones are needed
    j = (j + 1) & mask;
    if (m->keys[j] == NO_KEY) break;
    size_t home = hash_u64(m->keys[j]) & mask;
    if (((j - home) & mask) < ((j - i) & mask)) continue;
    m->keys[i] = m->keys[j];
    m->values[i] = m->values[j];
    i = j;
  }
  m->keys[i] = NO_KEY;
}

void map_free(Map *m)
{
  free(m->keys);
  free(m->values);
  *m = (Map){0};
}

static uint32_t hash_text(const char *s) // FNV-1a
{
  uint32_t h = 2166136261u;
  for (; *s; s++) h = (h ^ (unsigned char)*s) * 16777619u;
  return h;
}

static size_t names_find(const Names *m, const char *key, uint32_t hash)
{
  size_t i = hash & (m->cap - 1);
  while (m->slots[i].key && (m->slots[i].hash != hash || strcmp(m->slots[i].key, key) != 0))
    i = (i + 1) & (m->cap - 1);
  return i;
}

uint32_t names_get(const Names *m, const char *key)
{
  if (!m->cap) return NONE;
  size_t i = names_find(m, key, hash_text(key));
  return m->slots[i].key ? m->slots[i].value : NONE;
}

static void names_grow(Names *m)
{
  Names old = *m;
  m->cap = old.cap ? old.cap * 2 : 16;
  m->slots = mem_zalloc(m->cap * sizeof *m->slots);
  for (size_t i = 0; i < old.cap; i++)
    if (old.slots[i].key) m->slots[names_find(m, old.slots[i].key, old.slots[i].hash)] = old.slots[i];
  free(old.slots);
}

void names_set(Names *m, const char *key, uint32_t value)
{
  if ((m->len + 1) * 4 > m->cap * 3) names_grow(m);
  uint32_t hash = hash_text(key);
  size_t i = names_find(m, key, hash);
  if (!m->slots[i].key) {
    m->slots[i].key = mem_strdup(key);
    m->slots[i].hash = hash;
    m->len++;
  }
  m->slots[i].value = value;
}

void names_remove(Names *m, const char *key)
{
  if (!m->cap) return;
  size_t mask = m->cap - 1, i = names_find(m, key, hash_text(key));
  if (!m->slots[i].key) return;
  free(m->slots[i].key);
  m->len--;
  for (size_t j = i;;) {
    j = (j + 1) & mask;
    if (!m->slots[j].key) break;
    size_t home = m->slots[j].hash & mask;
    if (((j - home) & mask) < ((j - i) & mask)) continue;
    m->slots[i] = m->slots[j];
    i = j;
  }
  m->slots[i].key = NULL;
}

void names_free(Names *m)
{
  for (size_t i = 0; i < m->cap; i++) free(m->slots[i].key);
  free(m->slots);
  *m = (Names){0};
}
