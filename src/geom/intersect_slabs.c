// intersect_slabs.c - segments against segments in a tree of vertical slabs: no input is quadratic unless its answer is
// SPDX-License-Identifier: MIT
//
// After [Balaban95], with a tree in the place of the sweep. The slabs of a level are bounded half-way between abscissae of ends, so
// that no end lies on a bound. Of the segments that span a slab (from side to side) a staircase is taken: each strictly above the one before
// on both sides, or equal to it. What crosses the staircase, of the others that span and of those that end inside, lies between
// two of its steps that are found by bisection. The others each cross a step, which pays for handing them down to both halves; a step is not
// handed down. A slab with one abscissa is cut there: in either part all segments span, and those that cross are the inversions
// between the orders at the sides; who meets on the line itself is read off the order there. Comparisons at a bound are exact.
#include "base/base.h"

#include "geom/intersect_int.h"

typedef struct {
  double u, v; // abscissa (u + v) / 2, which need not be a double
} Line;

typedef struct {
  const Seg *seg;
  uint32_t *first, *last; // index of the abscissa of either end
  double *x;              // the abscissae of ends, ascending
  uint32_t nx;
  size_t from, most, room; // pairs are ordered when there are `room`
  SegPairVec *out;
  bool all;
} Slabs;

static void report(Slabs *z, uint32_t i, uint32_t j)
{
  const Seg *s = &z->seg[i], *t = &z->seg[j];
  SegMeet how;
  if (!z->all || !intersect__meet(s, t, &how)) return;
  vec_push(z->out, ((SegPair){MIN(s->id, t->id), MAX(s->id, t->id), how}));
  if (z->out->len - z->from < z->room) return;
  intersect__order(z->out, z->from); // pairs that meet on a bound are found on either side of it
  z->all = z->out->len - z->from <= z->most;
  z->room = 2 * (z->out->len - z->from) + z->most;
}

// Side k of a slab: between the abscissae k - 1 and k.
static Line bound(const Slabs *z, uint32_t k) { return (Line){z->x[k - 1], z->x[k]}; }

static int order(const Slabs *z, uint32_t i, uint32_t j, Line at)
{
  const double *p = z->seg[i].p, *q = z->seg[j].p;
  return segments_order_at(p, p + 2, q, q + 2, at.u, at.v);
}

// ---- sorting ------------------------------------------------------------------------------------------------------------------

typedef struct {
  Line at, then; // order at the first line, where equal at the second, then as given
  bool cross;    // only at the first, and report what has to change places
} Sorting;

static void merge(Slabs *z, const Sorting *by, uint32_t *list, size_t half, size_t n, uint32_t *room)
{
  size_t i = 0, j = half, k = 0;
  while (i < half && j < n) {
    int s = order(z, list[i], list[j], by->at);
    if (s == 0 && !by->cross) s = order(z, list[i], list[j], by->then);
    for (size_t l = i; by->cross && s > 0 && l < half && z->all; l++) report(z, list[l], list[j]);
    room[k++] = s <= 0 ? list[i++] : list[j++];
  }
  while (i < half) room[k++] = list[i++];
  while (j < n) room[k++] = list[j++];
  memcpy(list, room, n * sizeof *list);
}

// Stable; room for n more.
static void sort(Slabs *z, const Sorting *by, uint32_t *list, size_t n, uint32_t *room)
{
  for (size_t width = 1; width < n; width *= 2)
    for (size_t from = 0; from + width < n; from += 2 * width) merge(z, by, list + from, width, MIN(2 * width, n - from), room);
}

// ---- a slab with ends inside ----------------------------------------------------------------------------------------------------

// Whether segment i spans the slab of the abscissae [from, to), and whether it has an end in it.
static bool spans(const Slabs *z, uint32_t i, uint32_t from, uint32_t to) { return z->first[i] < from && z->last[i] >= to; }
static bool ends_in(const Slabs *z, uint32_t i, uint32_t from, uint32_t to)
{
  return (z->first[i] >= from && z->first[i] < to) || (z->last[i] >= from && z->last[i] < to);
}

// Sign of step i over the end of segment s in the slab, or over where s meets the slab's side.
static int over(const Slabs *z, uint32_t step, uint32_t s, int side, uint32_t from, uint32_t to)
{
  uint32_t end = side ? z->last[s] : z->first[s];
  const double *p = z->seg[step].p;
  if (end >= from && end < to) return -orient2d(p, p + 2, z->seg[s].p + 2 * side);
  return order(z, step, s, bound(z, side ? to : from));
}

// Steps that are not strictly below s on both sides, nor strictly above it on both: all of them meet s.
static void meet_steps(Slabs *z, const U32Vec *steps, uint32_t s, uint32_t from, uint32_t to)
{
  size_t lo = steps->len, hi = 0;
  for (int side = 0; side < 2; side++) {
    for (int above = 0; above < 2; above++) { // the first step not below s, then the first above it
      size_t a = above ? hi : 0, b = above ? steps->len : lo;
      while (a < b) {
        size_t mid = (a + b) / 2;
        if (over(z, steps->data[mid], s, side, from, to) < above) a = mid + 1;
        else b = mid;
      }
      if (above) hi = a;
      else lo = a;
    }
  }
  for (size_t k = lo; k < hi && z->all; k++) report(z, steps->data[k], s);
}

// Move the staircase out of `list`, which is ordered along the left side.
static void take_steps(Slabs *z, U32Vec *list, Line left, Line right, U32Vec *steps)
{
  size_t n = 0, run = 0; // run: the first step equal to the last
  for (size_t i = 0; i < list->len; i++) {
    uint32_t s = list->data[i];
    int l = 1, r = 1;
    if (steps->len) l = order(z, s, vec_last(steps), left), r = order(z, s, vec_last(steps), right);
    if (l != r || l < 0) {
      list->data[n++] = s;
      continue;
    }
    if (l > 0) run = steps->len;
    for (size_t k = run; k < steps->len && z->all; k++) report(z, steps->data[k], s);
    vec_push(steps, s);
  }
  list->len = n;
}

// ---- a slab with one abscissa ----------------------------------------------------------------------------------------------------

// Between a side of the slab and its abscissa, where all of `list` span.
static void cross_beside(Slabs *z, U32Vec *list, Line side, Line at)
{
  uint32_t *room = mem_alloc((list->len + 1) * sizeof *room);
  sort(z, &(Sorting){side, at, false}, list->data, list->len, room);
  for (size_t i = 0, run = 0; i < list->len; i++) {
    if (i && order(z, list->data[run], list->data[i], side) != 0) run = i;
    for (size_t k = run; k < i && z->all; k++) report(z, list->data[k], list->data[i]);
  }
  sort(z, &(Sorting){at, at, true}, list->data, list->len, room);
  free(room);
}

static bool passes(const Slabs *z, uint32_t i, uint32_t k) { return z->first[i] < k && z->last[i] > k; }

// Where segments of `list`, ordered along the line at abscissa k, are in one point: those that pass there meet all others.
static void meet_in_points(Slabs *z, const U32Vec *list, uint32_t k, Line at)
{
  for (size_t i = 0, end; i < list->len; i = end) {
    for (end = i + 1; end < list->len && order(z, list->data[i], list->data[end], at) == 0;) end++;
    for (size_t a = i; a < end; a++) {
      if (!passes(z, list->data[a], k)) continue;
      for (size_t b = i; b < end && z->all; b++)
        if (b > a || (b < a && !passes(z, list->data[b], k))) report(z, list->data[a], list->data[b]);
    }
  }
}

// The first of the list, ordered along a vertical line, that is not below the point there, or with `above` that is above it.
static size_t place_on_line(const Slabs *z, const U32Vec *list, const double *p, bool above)
{
  size_t a = 0, b = list->len;
  while (a < b) {
    size_t mid = (a + b) / 2;
    const double *q = z->seg[list->data[mid]].p;
    if (-orient2d(q, q + 2, p) < (int)above) a = mid + 1;
    else b = mid;
  }
  return a;
}

static void meet_verticals(Slabs *z, U32Vec *vertical, const U32Vec *list, uint32_t k)
{
  for (size_t i = 0; i < vertical->len; i++) {
    uint32_t s = vertical->data[i];
    const double *p = z->seg[s].p;
    size_t a0 = place_on_line(z, list, p, false), a1 = place_on_line(z, list, p, true);
    size_t b0 = place_on_line(z, list, p + 2, false), b1 = place_on_line(z, list, p + 2, true);
    for (size_t j = a0; j < b1 && z->all; j++) // at its ends only those that pass
      if ((j >= a1 && j < b0) || passes(z, list->data[j], k)) report(z, s, list->data[j]);
  }
}

static int by_begin(const void *a, const void *b)
{
  const Seg *s = *(const Seg *const *)a, *t = *(const Seg *const *)b;
  if (s->p[1] != t->p[1]) return s->p[1] < t->p[1] ? -1 : 1;
  return s->id < t->id ? -1 : s->id > t->id;
}

static void overlap_verticals(Slabs *z, const U32Vec *vertical)
{
  const Seg **s = mem_alloc((vertical->len + 1) * sizeof *s);
  for (size_t i = 0; i < vertical->len; i++) s[i] = &z->seg[vertical->data[i]];
  if (vertical->len) qsort(s, vertical->len, sizeof *s, by_begin);
  for (size_t i = 0; i < vertical->len; i++)
    for (size_t j = i + 1; j < vertical->len && s[j]->p[1] < s[i]->p[3] && z->all; j++)
      report(z, (uint32_t)(s[i] - z->seg), (uint32_t)(s[j] - z->seg));
  free(s);
}

static void finish_slab(Slabs *z, uint32_t k, const U32Vec *spanning, const U32Vec *ending)
{
  U32Vec part[4] = {{0}}; // left, right of the abscissa, on it, vertical there
  Line at = {z->x[k], z->x[k]};
  for (size_t i = 0; i < spanning->len + ending->len; i++) {
    uint32_t s = i < spanning->len ? spanning->data[i] : ending->data[i - spanning->len];
    if (z->first[s] < k) vec_push(&part[0], s);
    if (z->last[s] > k) vec_push(&part[1], s);
    if (z->first[s] < z->last[s]) vec_push(&part[2], s);
    else vec_push(&part[3], s);
  }
  if (part[0].len > 1) cross_beside(z, &part[0], bound(z, k), at);
  if (part[1].len > 1) cross_beside(z, &part[1], bound(z, k + 1), at);
  uint32_t *room = mem_alloc((part[2].len + 1) * sizeof *room);
  sort(z, &(Sorting){at, at, false}, part[2].data, part[2].len, room);
  free(room);
  meet_in_points(z, &part[2], k, at);
  meet_verticals(z, &part[3], &part[2], k);
  overlap_verticals(z, &part[3]);
  for (int i = 0; i < 4; i++) vec_free(&part[i]);
}

// ---- the tree ---------------------------------------------------------------------------------------------------------------------

// The slab of the abscissae [from, to), with what spans it and is not yet a step above, and what ends in it; frees both lists.
static void search(Slabs *z, uint32_t from, uint32_t to, U32Vec *spanning, U32Vec *ending)
{
  if (to - from == 1 || !z->all) {
    if (z->all) finish_slab(z, from, spanning, ending);
    vec_free(spanning);
    vec_free(ending);
    return;
  }
  if (spanning->len) {
    Line left = bound(z, from), right = bound(z, to);
    uint32_t *room = mem_alloc(spanning->len * sizeof *room);
    U32Vec steps = {0};
    sort(z, &(Sorting){left, right, false}, spanning->data, spanning->len, room);
    free(room);
    take_steps(z, spanning, left, right, &steps);
    for (size_t i = 0; i < spanning->len; i++) meet_steps(z, &steps, spanning->data[i], from, to);
    for (size_t i = 0; i < ending->len; i++) meet_steps(z, &steps, ending->data[i], from, to);
    vec_free(&steps);
  }
  uint32_t mid = from + (to - from) / 2, side[3] = {from, mid, to};
  U32Vec span[2] = {{0}}, end[2] = {{0}};
  for (int h = 0; h < 2; h++) {
    for (size_t i = 0; i < spanning->len; i++) vec_push(&span[h], spanning->data[i]);
    for (size_t i = 0; i < ending->len; i++) {
      if (ends_in(z, ending->data[i], side[h], side[h + 1])) vec_push(&end[h], ending->data[i]);
      else if (spans(z, ending->data[i], side[h], side[h + 1])) vec_push(&span[h], ending->data[i]);
    }
  }
  vec_free(spanning);
  vec_free(ending);
  for (int h = 0; h < 2; h++) search(z, side[h], side[h + 1], &span[h], &end[h]);
}

static int by_value(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y;
}

static uint32_t index_of(const Slabs *z, double x)
{
  uint32_t a = 0, b = z->nx - 1;
  while (a < b) {
    uint32_t mid = a + (b - a) / 2;
    if (z->x[mid] < x) a = mid + 1;
    else b = mid;
  }
  return a;
}

bool intersect__by_slabs(const Seg *seg, size_t n, size_t most, SegPairVec *out)
{
  Slabs z = {.seg = seg, .from = out->len, .most = most, .room = 2 * most + 1, .out = out, .all = true};
  z.x = mem_alloc((2 * n + 1) * sizeof *z.x);
  z.first = mem_alloc((n + 1) * sizeof *z.first);
  z.last = mem_alloc((n + 1) * sizeof *z.last);
  for (size_t i = 0; i < n; i++) z.x[2 * i] = seg[i].p[0], z.x[2 * i + 1] = seg[i].p[2];
  qsort(z.x, 2 * n, sizeof *z.x, by_value);
  for (size_t i = 0; i < 2 * n; i++)
    if (i == 0 || z.x[i] != z.x[z.nx - 1]) z.x[z.nx++] = z.x[i];
  U32Vec spanning = {0}, ending = {0};
  for (size_t i = 0; i < n; i++) {
    z.first[i] = index_of(&z, seg[i].p[0]);
    z.last[i] = index_of(&z, seg[i].p[2]);
    vec_push(&ending, (uint32_t)i);
  }
  search(&z, 0, z.nx, &spanning, &ending);
  intersect__order(out, z.from);
  if (out->len - z.from > most) z.all = false, out->len = z.from + most;
  free(z.x);
  free(z.first);
  free(z.last);
  return z.all;
}
