// mem.h - heap memory that never fails to the caller, growable arrays, bump arenas
// SPDX-License-Identifier: MIT
#ifndef BASE_MEM_H
#define BASE_MEM_H

#include "base/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// malloc/calloc/realloc that do not return on failure: they print one line and exit(EXIT_ENVIRONMENT) after
// removing the temporary files of base/file.h. n may be 0. The caller frees with free().
void *mem_alloc(size_t n);
void *mem_zalloc(size_t n);
void *mem_realloc(void *p, size_t n);
char *mem_strdup(const char *s);
// As mem_alloc, for arrays of many megabytes that are visited all over: asks the system for large pages where it has them.
void *mem_alloc_large(size_t n);

// Make room for `want` elements of `size` bytes in the array *data of capacity *cap (doubling; capacity 1 first
// in the stress build so that arrays move on every growth). Aborts as mem_alloc does. Amortized O(1).
void mem_grow(void *data, size_t *cap, size_t want, size_t size);

// Bytes of the process's peak resident set so far, and of the present one.
size_t mem_peak(void);
size_t mem_now(void);

#ifdef __cplusplus
}
#endif

// Growable array. Declare `Vec(double) v = {0};`, append with vec_push(&v, x), index v.data[i], i < v.len.
// The vec owns data; release with vec_free(&v).
#define Vec(T)     \
  struct {         \
    T *data;       \
    size_t len, cap; \
  }
#define vec_reserve(v, n)                                                              \
  ((size_t)(n) > (v)->cap ? mem_grow(&(v)->data, &(v)->cap, (size_t)(n), sizeof *(v)->data) \
                          : (void)0)
#define vec_push(v, x) (vec_reserve(v, (v)->len + 1), (void)((v)->data[(v)->len++] = (x)))
#define vec_resize(v, n) (vec_reserve(v, n), (void)((v)->len = (size_t)(n)))
#define vec_pop(v) ((v)->data[--(v)->len])
#define vec_last(v) ((v)->data[(v)->len - 1])
#define vec_clear(v) ((void)((v)->len = 0))
#define vec_free(v) (free((v)->data), (v)->data = NULL, (void)((v)->len = (v)->cap = 0))

typedef Vec(double) DoubleVec;
typedef Vec(int) IntVec;
typedef Vec(uint32_t) U32Vec;

// Bump arena: everything dies together. Zero-initialize before first use.
typedef struct ArenaBlock ArenaBlock;
typedef struct {
  ArenaBlock *head;
  size_t used; // bytes handed out, for accounting
} Arena;

#ifdef __cplusplus
extern "C" {
#endif

// n bytes, zeroed, aligned for any type; owned by the arena until arena_free.
void *arena_alloc(Arena *a, size_t n);
// Copies owned by the arena.
void *arena_dup(Arena *a, const void *p, size_t n);
char *arena_strdup(Arena *a, const char *s);
char *arena_strndup(Arena *a, const char *s, size_t n);
void arena_free(Arena *a);
// As arena_free, but keeps one block for what comes next: for arenas emptied often.
void arena_reset(Arena *a);

#ifdef __cplusplus
}
#endif

#endif
