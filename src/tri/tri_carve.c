// tri_carve.c - which triangles are in the domain, and in which region
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_int.h"

static bool bounds(const Tri *m, EdgeId e, const bool *embedded)
{
  return tri_is_segment(m, e) && !(embedded && embedded[m->seg[e]]);
}

// Visit all that can be reached from the triangles on `stack` (marked already) without crossing a bounding segment. What lies
// beyond such segments is appended to `beyond`, if given.
static void flood(const Tri *m, const bool *embedded, uint8_t *seen, U32Vec *stack, U32Vec *reached, U32Vec *beyond)
{
  while (stack->len) {
    TriId t = vec_pop(stack);
    vec_push(reached, t);
    for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
      TriId u = tri_of(m->twin[e]);
      if (seen[u]) continue;
      if (bounds(m, e, embedded)) {
        if (beyond) vec_push(beyond, u);
        continue;
      }
      seen[u] = 1;
      vec_push(stack, u);
    }
  }
}

static void set_outside(Tri *m, U32Vec *reached, bool outside)
{
  for (size_t i = 0; i < reached->len; i++) {
    uint8_t *f = &m->flag[reached->data[i]];
    *f = (uint8_t)(outside ? *f | TRI_OUTSIDE_FLAG : *f & ~TRI_OUTSIDE_FLAG);
  }
  vec_clear(reached);
}

// The triangle at a seed point, or NONE if it is outside the hull.
static TriId seed_triangle(Tri *m, const double *p)
{
  EdgeId e;
  if (m->dim != 2 || !isfinite(p[0]) || !isfinite(p[1])) return NONE;
  return tri_locate(m, p, NONE, &e) == TRI_OUTSIDE ? NONE : tri_of(e);
}

static void push_ghosts(const Tri *m, uint8_t *seen, U32Vec *stack)
{
  for (TriId t = 0; t < m->nt; t++)
    if (!tri_is_free(m, t) && tri_is_ghost(m, t)) {
      seen[t] = 1;
      vec_push(stack, t);
    }
}

static void label_regions(Tri *m, const TriCarve *how, uint8_t *seen, U32Vec *stack, U32Vec *reached)
{
  if (how->nregions == 0) return;
  tri__make_regions(m);
  memset(m->region, 0, m->nt * sizeof *m->region);
  memset(seen, 0, m->nt);
  for (size_t i = 0; i < how->nregions; i++) {
    TriId t = seed_triangle(m, how->regions + 2 * i);
    if (t == NONE || seen[t]) continue; // the first seed in a region names it
    seen[t] = 1;
    vec_push(stack, t);
    flood(m, how->embedded, seen, stack, reached, NULL);
    for (size_t k = 0; k < reached->len; k++) m->region[reached->data[k]] = how->labels[i];
    vec_clear(reached);
  }
}

uint32_t tri_carve(Tri *m, const TriCarve *how)
{
  uint8_t *seen = mem_zalloc(m->nt);
  U32Vec stack = {0}, reached = {0}, beyond = {0};
  for (TriId t = 0; t < m->nt; t++) m->flag[t] &= (uint8_t)~TRI_OUTSIDE_FLAG;
  push_ghosts(m, seen, &stack);
  if (how->concavities) {
    while (stack.len) vec_push(&reached, vec_pop(&stack));
    set_outside(m, &reached, true);
  }
  flood(m, how->embedded, seen, &stack, &reached, how->even_odd ? &beyond : NULL);
  set_outside(m, &reached, true);
  for (bool outside = false; beyond.len; outside = !outside) { // one level of nesting each time
    while (beyond.len) {
      TriId t = vec_pop(&beyond);
      if (!seen[t]) {
        seen[t] = 1;
        vec_push(&stack, t);
      }
    }
    flood(m, how->embedded, seen, &stack, &reached, &beyond);
    set_outside(m, &reached, outside);
  }
  for (size_t i = 0; i < how->nholes; i++) {
    TriId t = seed_triangle(m, how->holes + 2 * i);
    if (t == NONE || tri_is_outside(m, t)) continue;
    memset(seen, 0, m->nt);
    seen[t] = 1;
    vec_push(&stack, t);
    flood(m, how->embedded, seen, &stack, &reached, NULL);
    set_outside(m, &reached, true);
  }
  label_regions(m, how, seen, &stack, &reached);
  uint32_t inside = 0;
  for (TriId t = 0; t < m->nt; t++) inside += tri_is_inside(m, t);
  free(seen);
  vec_free(&stack);
  vec_free(&reached);
  vec_free(&beyond);
  return inside;
}
