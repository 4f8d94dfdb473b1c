// partition_repair.c - parts that METIS leaves empty, and pieces it leaves apart from their part
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/partition_int.h"

#include <math.h>

uint64_t *parts__weights(const Parts *p)
{
  uint64_t *w = mem_zalloc(p->n * sizeof *w);
  for (size_t c = 0; c < p->g->n; c++) w[p->part[c]] += parts__weight(p, c);
  return w;
}

// The last cell that a search through a part reaches from its first cell: without it, what the search reached
// hangs together.
static uint32_t last_reached(const Parts *p, uint32_t part, uint32_t *queue, bool *seen)
{
  uint32_t first = 0;
  while (p->part[first] != part) first++;
  size_t n = 0;
  queue[n++] = first;
  seen[first] = true;
  for (size_t k = 0; k < n; k++)
    for (uint32_t i = p->g->start[queue[k]]; i < p->g->start[queue[k] + 1]; i++) {
      uint32_t c = p->g->next[i];
      if (seen[c] || p->part[c] != part) continue;
      seen[c] = true;
      queue[n++] = c;
    }
  for (size_t k = 0; k < n; k++) seen[queue[k]] = false;
  return queue[n - 1];
}

void parts__fill_empty(Parts *p)
{
  uint32_t *count = mem_zalloc(p->n * sizeof *count);
  for (size_t c = 0; c < p->g->n; c++) count[p->part[c]]++;
  uint32_t *queue = mem_alloc(p->g->n * sizeof *queue);
  bool *seen = mem_zalloc(p->g->n * sizeof *seen);
  for (uint32_t k = 0; k < p->n; k++) {
    if (count[k]) continue;
    uint32_t most = 0;
    for (uint32_t q = 1; q < p->n; q++)
      if (count[q] > count[most]) most = q;
    p->part[last_reached(p, most, queue, seen)] = k;
    count[most]--;
    count[k]++;
  }
  free(count);
  free(queue);
  free(seen);
}

// ---- pieces apart ------------------------------------------------------------
typedef struct {
  Parts *p;
  double limit;
  uint64_t *weight;       // of parts
  uint32_t *component, n; // of cells; components in all
  uint64_t *size;         // weight of components
  uint32_t *main;         // per part: its heaviest component
  uint32_t *first, *next; // cells of a component, as lists
  uint32_t *shared;       // per part, all 0 between uses: edges shared with the piece at hand
} Pieces;

static void find_pieces(Pieces *s)
{
  const Parts *p = s->p;
  s->n = cell_graph_components(p->g, p->part, s->component);
  memset(s->first, 0xff, s->n * sizeof *s->first);
  memset(s->size, 0, s->n * sizeof *s->size);
  memset(s->main, 0xff, p->n * sizeof *s->main);
  for (uint32_t c = (uint32_t)p->g->n; c-- > 0;) {
    uint32_t k = s->component[c];
    s->next[c] = s->first[k];
    s->first[k] = c;
    s->size[k] += parts__weight(p, c);
  }
  for (uint32_t k = 0; k < s->n; k++) {
    uint32_t *main = &s->main[p->part[s->first[k]]];
    if (*main == NONE || s->size[k] > s->size[*main]) *main = k;
  }
}

// The part that a piece shares most edges with, the lightest of several, or NONE.
static uint32_t best_neighbour(const Pieces *s, uint32_t piece)
{
  const Parts *p = s->p;
  const CellGraph *g = p->g;
  uint32_t own = p->part[s->first[piece]], best = NONE;
  for (int pass = 0; pass < 3; pass++)
    for (uint32_t c = s->first[piece]; c != NONE; c = s->next[c])
      for (uint32_t i = g->start[c]; i < g->start[c + 1]; i++) {
        uint32_t q = p->part[g->next[i]];
        if (q == own) continue;
        if (pass == 0) s->shared[q]++;
        if (pass == 2) s->shared[q] = 0;
        if (pass != 1 || q == best) continue;
        bool better = best == NONE || s->shared[q] > s->shared[best];
        if (!better && s->shared[q] == s->shared[best])
          better = s->weight[q] != s->weight[best] ? s->weight[q] < s->weight[best] : q < best;
        if (better) best = q;
      }
  return best;
}

static bool move_piece(Pieces *s, uint32_t piece)
{
  Parts *p = s->p;
  uint32_t to = best_neighbour(s, piece), own = p->part[s->first[piece]];
  if (to == NONE || (double)(s->weight[to] + s->size[piece]) > s->limit) return false;
  s->weight[own] -= s->size[piece];
  s->weight[to] += s->size[piece];
  for (uint32_t c = s->first[piece]; c != NONE; c = s->next[c]) p->part[c] = to;
  return true;
}

void parts__join_pieces(Parts *p, double limit)
{
  enum { ROUNDS = 10 };
  size_t n = p->g->n;
  Pieces s = {.p = p, .limit = limit, .weight = parts__weights(p)};
  for (uint32_t k = 0; k < p->n; k++) s.limit = fmax(s.limit, (double)s.weight[k]);
  s.component = mem_alloc(n * sizeof *s.component);
  s.size = mem_alloc(n * sizeof *s.size);
  s.first = mem_alloc(n * sizeof *s.first);
  s.next = mem_alloc(n * sizeof *s.next);
  s.main = mem_alloc(p->n * sizeof *s.main);
  s.shared = mem_zalloc(p->n * sizeof *s.shared);
  bool moved = true;
  for (int round = 0; moved && round < ROUNDS; round++) {
    moved = false;
    find_pieces(&s);
    for (uint32_t k = 0; k < s.n; k++)
      if (k != s.main[p->part[s.first[k]]]) moved |= move_piece(&s, k);
  }
  free(s.weight);
  free(s.component);
  free(s.size);
  free(s.first);
  free(s.next);
  free(s.main);
  free(s.shared);
}
