// mem.c - heap memory that never fails to the caller, growable arrays, bump arenas
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/mem.h"

#include <stdalign.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include "base/file.h"

static NORETURN void out_of_memory(size_t n)
{
  file_remove_temporaries();
  fprintf(stderr, "meshgen: error: out of memory (%zu bytes wanted)\n", n);
  _Exit(EXIT_ENVIRONMENT);
}

// Large blocks stand on large pages, where the system has them: fewer page faults. A page half used is worth one.
static const size_t large_page = (size_t)2 << 20, large_block = (size_t)1 << 20;

// Only advice: without it all is as well, but slower.
static void advise_large(void *p, size_t n)
{
#ifdef MADV_HUGEPAGE
  uintptr_t from = ((uintptr_t)p + large_page - 1) / large_page * large_page, to = ((uintptr_t)p + n) / large_page * large_page;
  if (from < to) madvise((void *)from, to - from, MADV_HUGEPAGE);
#else
  (void)p, (void)n;
#endif
}

void *mem_alloc_large(size_t n)
{
  if (n < large_block) return mem_alloc(n);
  size_t whole = (n + large_page - 1) / large_page * large_page;
  void *p = aligned_alloc(large_page, whole);
  if (!p) out_of_memory(n);
  advise_large(p, whole - n <= large_page - large_block ? whole : n);
  return p;
}

void *mem_alloc(size_t n)
{
  if (n >= large_block) return mem_alloc_large(n);
  void *p = malloc(n ? n : 1);
  if (!p) out_of_memory(n);
  return p;
}

void *mem_zalloc(size_t n)
{
  void *p = calloc(1, n ? n : 1);
  if (!p) out_of_memory(n);
  return p;
}

void *mem_realloc(void *p, size_t n)
{
  if (!p) return mem_alloc(n);
  p = realloc(p, n ? n : 1);
  if (!p) out_of_memory(n);
  if (n >= large_page) advise_large(p, n);
  return p;
}

char *mem_strdup(const char *s)
{
  size_t n = strlen(s) + 1;
  return memcpy(mem_alloc(n), s, n);
}

void mem_grow(void *data, size_t *cap, size_t want, size_t size)
{
  if (want <= *cap) return;
#ifdef STRESS
  size_t c = want + want / 256; // every growth moves the array
#else
  size_t c = MAX(*cap * 2, MAX(want, (size_t)8));
#endif
  if (c > SIZE_MAX / 2 / size) out_of_memory(SIZE_MAX);
  void *p;
  memcpy(&p, data, sizeof p);
#ifdef STRESS
  void *q = mem_alloc(c * size);
  if (p) memcpy(q, p, *cap * size);
  free(p);
  p = q;
#else
  p = mem_realloc(p, c * size);
#endif
  memcpy(data, &p, sizeof p);
  *cap = c;
}

size_t mem_peak(void)
{
  struct rusage u;
  if (getrusage(RUSAGE_SELF, &u) != 0) return 0;
  return (size_t)u.ru_maxrss * 1024;
}

size_t mem_now(void)
{
  FILE *f = fopen("/proc/self/statm", "r");
  if (!f) return 0;
  unsigned long total = 0, resident = 0;
  int n = fscanf(f, "%lu %lu", &total, &resident);
  fclose(f);
  return n == 2 ? (size_t)resident * 4096 : 0;
}

struct ArenaBlock {
  ArenaBlock *next;
  size_t used, cap;
  alignas(max_align_t) unsigned char bytes[];
};

#ifdef STRESS
enum { ARENA_BLOCK = 64 };
#else
enum { ARENA_BLOCK = 64 * 1024 };
#endif

void *arena_alloc(Arena *a, size_t n)
{
  const size_t align = alignof(max_align_t);
  n = (n + align - 1) / align * align;
  ArenaBlock *b = a->head;
  if (!b || b->cap - b->used < n) {
    size_t cap = MAX(n, (size_t)ARENA_BLOCK);
    b = mem_alloc(sizeof *b + cap);
    b->used = 0;
    b->cap = cap;
    if (a->head && n > ARENA_BLOCK / 4) { // a large object does not end the current block
      b->next = a->head->next;
      a->head->next = b;
    } else {
      b->next = a->head;
      a->head = b;
    }
  }
  void *p = b->bytes + b->used;
  b->used += n;
  a->used += n;
  return memset(p, 0, n);
}

void *arena_dup(Arena *a, const void *p, size_t n)
{
  void *q = arena_alloc(a, n);
  if (n) memcpy(q, p, n);
  return q;
}

char *arena_strndup(Arena *a, const char *s, size_t n)
{
  char *q = arena_alloc(a, n + 1);
  if (n) memcpy(q, s, n);
  return q;
}

char *arena_strdup(Arena *a, const char *s)
{
  return arena_strndup(a, s, strlen(s));
}

void arena_free(Arena *a)
{
  for (ArenaBlock *b = a->head, *next; b; b = next) {
    next = b->next;
    free(b);
  }
  a->head = NULL;
  a->used = 0;
}

void arena_reset(Arena *a)
{
  ArenaBlock *keep = a->head;
  if (keep && keep->cap == ARENA_BLOCK) {
    a->head = keep->next;
    arena_free(a);
    keep->next = NULL;
    keep->used = 0;
    a->head = keep;
  } else {
    arena_free(a);
  }
}
