// msh_bulk.c - large blocks of MSH 4.1 read by several threads
// SPDX-License-Identifier: MIT
//
// Only as such files are mostly written: binary in the byte order of this machine, or text with one node or element on each line;
// numbers of nodes one after the other; no parameters. What is otherwise, or wrong, is left to the reader of single numbers.
#include "base/base.h"

#include <math.h>
#include <stdatomic.h>

#include "base/lines.h"
#include "base/thread.h"
#include "out/import.h"
#include "out/out_int.h"

enum { PART = 1 << 14 }; // nodes or elements of a binary block read at once

typedef struct {
  const char *p;      // the block's numbers of nodes, or its elements
  size_t n;
  uint64_t first;     // number of the first node
  const char *place;  // coordinates, if binary
  double *xyz;        // where they go
  size_t nodes;       // per element
  uint64_t tag0, nnode; // elements use nodes tag0 .. tag0 + nnode - 1
  uint32_t *to;       // where they go, as 0 ..
  atomic_bool odd;    // something is not as it mostly is
} Bulk;

static void note(Bulk *b, bool odd)
{
  if (odd) atomic_store_explicit(&b->odd, true, memory_order_relaxed);
}

static inline uint64_t load8(const char *p)
{
  uint64_t v;
  memcpy(&v, p, sizeof v);
  return v;
}

// ---- binary --------------------------------------------------------------------------------------------------------------
static void take_binary_nodes(void *ctx, size_t part, int worker)
{
  Bulk *b = ctx;
  size_t from = part * PART, to = MIN(b->n, from + PART);
  uint64_t differ = 0, special = 0;
  (void)worker;
  for (size_t i = from; i < to; i++) differ |= load8(b->p + 8 * i) ^ (b->first + i);
  memcpy(b->xyz + 3 * from, b->place + 24 * from, 24 * (to - from));
  for (size_t i = 3 * from; i < 3 * to; i++) special |= (load8((const char *)(b->xyz + i)) >> 52 & 0x7ff) + 1; // infinite: 0x800
  note(b, differ || special >> 11);
}

static inline uint64_t take_records(Bulk *b, size_t from, size_t to, size_t nodes)
{
  const char *p = b->p + 8 * (1 + nodes) * from;
  uint32_t *v = b->to + nodes * from;
  uint64_t beyond = 0;
  for (size_t i = from; i < to; i++, p += 8 * (1 + nodes))
    for (size_t k = 0; k < nodes; k++) {
      uint64_t node = load8(p + 8 * (1 + k)) - b->tag0;
      beyond |= node >= b->nnode;
      *v++ = (uint32_t)node;
    }
  return beyond;
}

static void take_binary_elements(void *ctx, size_t part, int worker)
{
  Bulk *b = ctx;
  size_t from = part * PART, to = MIN(b->n, from + PART);
  (void)worker;
  note(b, b->nodes == 3 ? take_records(b, from, to, 3) : take_records(b, from, to, b->nodes)); // 3: so that it unrolls
}

// ---- text ----------------------------------------------------------------------------------------------------------------
// The number after blanks on this line, or NULL.
static inline const char *take_number(const char *p, const char *end, uint64_t *v)
{
  while (p < end && (*p == ' ' || *p == '\t')) p++;
  if (end - p >= 8) {
    uint64_t text = decimal_load8(p);
    unsigned n = decimal_count_digits(text);
    *v = decimal_value(text, n);
    if (n - 1 < 7) return (unsigned char)p[n] <= ' ' ? p + n : NULL;
  }
  const char *from = p;
  for (*v = 0; p < end && (unsigned)(*p - '0') < 10 && p - from < 18; p++) *v = *v * 10 + (unsigned)(*p - '0');
  return p > from && p < end && (unsigned char)*p <= ' ' ? p : NULL;
}

static inline const char *take_coordinate(const char *p, const char *end, double *v)
{
  while (p < end && (*p == ' ' || *p == '\t')) p++;
  if (end - p >= 2 && p[0] == '0' && (unsigned char)p[1] <= ' ') {
    *v = 0;
    return p + 1;
  }
  const char *q = number_read(p, end, v);
  return q > p && q < end && (unsigned char)*q <= ' ' && isfinite(*v) ? q : NULL;
}

static inline const char *take_line_end(const char *p, const char *end)
{
  while (p < end && (*p == ' ' || *p == '\r' || *p == '\t')) p++;
  return p < end && *p == '\n' ? p + 1 : NULL;
}

static const char *take_numbers(void *ctx, const char *p, const char *end, size_t first, size_t n)
{
  Bulk *b = ctx;
  for (size_t i = first; i < first + n && p; i++) {
    uint64_t v;
    if (!(p = take_number(p, end, &v)) || v != b->first + i) return NULL;
    p = take_line_end(p, end);
  }
  return p;
}

static const char *take_places(void *ctx, const char *p, const char *end, size_t first, size_t n)
{
  Bulk *b = ctx;
  double *x = b->xyz + 3 * first;
  for (size_t i = 0; i < n && p; i++) {
    for (int k = 0; k < 3; k++)
      if (!(p = take_coordinate(p, end, x++))) return NULL;
    p = take_line_end(p, end);
  }
  return p;
}

static const char *take_elements(void *ctx, const char *p, const char *end, size_t first, size_t n)
{
  Bulk *b = ctx;
  uint32_t *to = b->to + b->nodes * first;
  for (size_t i = 0; i < n && p; i++) {
    uint64_t v;
    if (!(p = take_number(p, end, &v))) return NULL;
    for (size_t k = 0; k < b->nodes; k++) {
      if (!(p = take_number(p, end, &v)) || v - b->tag0 >= b->nnode) return NULL;
      *to++ = (uint32_t)(v - b->tag0);
    }
    p = take_line_end(p, end);
  }
  return p;
}

// ---- blocks ----------------------------------------------------------------------------------------------------------------
bool msh__bulk_nodes(Import *im, size_t n, int dim, int entity)
{
  Scan *s = im->s;
  Bulk b = {.n = n};
  if (s->swap || n == 0) return false;
  if (s->binary) {
    if (scan_left(s) / 32 < n) return false;
    b.p = s->p;
    b.first = load8(b.p);
    b.place = b.p + 8 * n;
  } else {
    b.p = take_line_end(s->p, s->end);
    if (!b.p || !take_number(b.p, s->end, &b.first)) return false;
  }
  if (!(b.xyz = import_room(im, b.first, n))) return false;
  const char *end = b.p + 32 * n;
  if (s->binary) {
    thread_for((n + PART - 1) / PART, s->threads, take_binary_nodes, &b);
  } else {
    end = lines_take(b.p, s->end, n, s->threads, take_numbers, &b);
    if (end) end = lines_take(end, s->end, n, s->threads, take_places, &b);
  }
  if (!end || b.odd) return false;
  import_filled(im, b.first, n, dim, entity);
  s->p = end;
  return true;
}

bool msh__bulk_elements(Import *im, size_t n, size_t nodes, uint32_t *to)
{
  Scan *s = im->s;
  Bulk b = {.p = s->p, .n = n, .nodes = nodes, .to = to, .tag0 = im->tag0, .nnode = im->mesh->nnode};
  if (s->swap || !im->dense || n == 0) return false;
  const char *end = s->p;
  if (s->binary) {
    if (scan_left(s) / (8 * (1 + nodes)) < n) return false;
    thread_for((n + PART - 1) / PART, s->threads, take_binary_elements, &b);
    end += 8 * (1 + nodes) * n;
  } else {
    end = take_line_end(s->p, s->end);
    if (end) end = lines_take(end, s->end, n, s->threads, take_elements, &b);
  }
  if (!end || b.odd) return false;
  s->p = end;
  return true;
}
