// words.c - interned identifiers and the keyword list
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/token.h"

#include "script/limits.h"

typedef struct {
  const char *text;
  uint16_t meaning;
  bool reserved;
} KeywordRow;

static const KeywordRow keywords[KW_COUNT] = {
#define RESERVED(word) {#word, KW_##word, true},
#define SOFT(word) {#word, KW_##word, false},
#define SYNONYM(word, meaning) {#word, KW_##meaning, true},
#include "script/keywords.def"
#undef RESERVED
#undef SOFT
#undef SYNONYM
};

bool keyword_reserved(uint32_t word)
{
  return word < KW_COUNT && keywords[word].reserved;
}

static uint32_t hash_text(const char *s, size_t n)
{
  uint32_t h = 2166136261u;
  for (size_t i = 0; i < n; i++) h = (h ^ (unsigned char)s[i]) * 16777619u;
  return h ^ h >> 15;
}

static uint32_t *find_slot(const Words *w, const char *s, size_t n, uint32_t h)
{
  for (size_t i = h & (w->cap - 1);; i = (i + 1) & (w->cap - 1)) {
    uint32_t id = w->slot[i];
    if (id == NONE) return &w->slot[i];
    if (w->hash.data[id] == h && !strncmp(w->text.data[id], s, n) && !w->text.data[id][n]) return &w->slot[i];
  }
}

static void grow(Words *w)
{
  free(w->slot);
  w->cap = w->cap ? 2 * w->cap : 2048;
  w->slot = mem_alloc(w->cap * sizeof *w->slot);
  memset(w->slot, 0xff, w->cap * sizeof *w->slot);
  for (uint32_t id = 0; id < w->text.len; id++) {
    const char *s = w->text.data[id];
    *find_slot(w, s, strlen(s), w->hash.data[id]) = id;
  }
}

static uint32_t meaning_of(uint32_t id)
{
  return id < KW_COUNT ? keywords[id].meaning : id;
}

uint32_t words_find(const Words *w, const char *s, size_t n)
{
  uint32_t id = *find_slot(w, s, n, hash_text(s, n));
  return id == NONE ? NONE : meaning_of(id);
}

uint32_t words_intern(Words *w, const char *s, size_t n)
{
  uint32_t h = hash_text(s, n), *slot = find_slot(w, s, n, h), id = *slot;
  if (id != NONE) return meaning_of(id);
  if (w->text.len >= LIMIT_SYMBOLS) return NONE;
  id = (uint32_t)w->text.len;
  *slot = id;
  vec_push(&w->text, arena_strndup(&w->arena, s, n));
  vec_push(&w->hash, h);
  if (2 * w->text.len > w->cap) grow(w);
  return meaning_of(id);
}

void words_init(Words *w)
{
  *w = (Words){0};
  grow(w);
  for (int i = 0; i < KW_COUNT; i++) words_intern(w, keywords[i].text, strlen(keywords[i].text));
  words_intern(w, "", 0); // so that no name has the id KW_COUNT, which means "no word" in the tree
}

void words_free(Words *w)
{
  vec_free(&w->text);
  vec_free(&w->hash);
  free(w->slot);
  arena_free(&w->arena);
}
