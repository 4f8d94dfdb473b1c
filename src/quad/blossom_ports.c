// blossom_ports.c - the graph of regions: its ports, and what matching does to them
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/blossom_regions.h"

// ---- the graph

static uint32_t new_region(Regions *g, RegionKind kind)
{
  vec_push(&g->region, ((Region){.kind = kind, .pred = NONE, .link = NONE, .first = {NONE, NONE}}));
  return (uint32_t)g->region.len - 1;
}

static void list_port(Regions *g, uint32_t p, uint32_t side)
{
  Port *port = g->port.data;
  uint32_t *first = &g->region.data[side / 2].first[side & 1];
  port[p].side = g->v[port[p].v].side = side;
  port[p].prev = NONE;
  port[p].next = *first;
  if (*first != NONE) port[*first].prev = p;
  *first = p;
}

static void unlist_port(Regions *g, uint32_t p)
{
  Port *port = g->port.data, *x = &port[p];
  if (x->prev == NONE) g->region.data[x->side / 2].first[x->side & 1] = x->next;
  else port[x->prev].next = x->next;
  if (x->next != NONE) port[x->next].prev = x->prev;
}

// Join the arc of port p that is arc a of its vertex to the port at its other end.
static void join(Regions *g, uint32_t p, uint32_t a)
{
  const Frac *f = g->f;
  const Port *x = &g->port.data[p];
  uint32_t w = f->arc[a].head, q = g->port_of[w];
  uint32_t here = x->start + (a - f->v[x->v].start);
  uint32_t there = g->port.data[q].start + (f->arc[a].rev - f->v[w].start);
  g->arc.data[here].head = q;
  g->arc.data[there].head = p;
  g->arc.data[here].rev = there;
  g->arc.data[there].rev = here;
}

// Make a port of v, and join it to those of other regions.
static void add_port(Regions *g, uint32_t v)
{
  const Frac *f = g->f;
  uint32_t from = f->v[v].start, to = f->v[v + 1].start;
  uint32_t p = (uint32_t)g->port.len, start = (uint32_t)g->arc.len;
  vec_push(&g->port, ((Port){.pot = f->v[v].pot, .v = v, .start = start, .degree = to - from}));
  g->port_of[v] = p;
  for (uint32_t a = from; a < to; a++) vec_push(&g->arc, ((PortArc){NONE, p, NONE, f->arc[a].cost}));
  for (uint32_t a = from; a < to; a++) {
    uint32_t w = f->arc[a].head;
    if (g->port_of[w] != NONE && g->v[w].side != (g->v[v].side ^ 1)) join(g, p, a);
  }
  list_port(g, p, g->v[v].side);
}

void regions__init(Regions *g, Frac *f, Tight *t, uint32_t nregion)
{
  *g = (Regions){.f = f, .v = t->v};
  for (uint32_t k = 0; k < nregion; k++) new_region(g, REGION);
  g->port_of = mem_alloc(((size_t)f->n + 1) * sizeof *g->port_of);
  for (uint32_t v = 0; v < f->n; v++) g->port_of[v] = NONE;
  for (uint32_t v = 0; v < f->n; v++) {
    bool out = f->v[v].match == NONE;
    if (out) g->region.data[g->v[v].side / 2].kind = frac__is_free(&f->v[v]) ? FREE : CYCLE;
    for (uint32_t a = f->v[v].start; !out && a < f->v[v + 1].start; a++)
      out = g->v[f->arc[a].head].side != (g->v[v].side ^ 1);
    if (out) add_port(g, v);
  }
}

// ---- matches

// A port leaves its region, and the vertex it was matched to stays behind. Vertices around it get to be
// ports.
static void take_out(Regions *g, uint32_t p)
{
  const Frac *f = g->f;
  uint32_t v = g->port.data[p].v, side = g->port.data[p].side, old = f->v[v].match;
  g->port.data[p].pot = regions__dual(g, p);
  unlist_port(g, p);
  g->v[v].side = NONE;
  for (uint32_t a = f->v[v].start; a < f->v[v + 1].start; a++) {
    uint32_t w = f->arc[a].head;
    if (g->v[w].side != (side ^ 1)) continue;
    if (g->port_of[w] == NONE) add_port(g, w);
    else join(g, p, a);
  }
  if (old == NONE) return;
  FracVertex *left = &f->v[f->arc[old].head];
  left->match = left->pred = NONE;
}

void regions__pair_up(Regions *g, uint32_t a)
{
  uint32_t x = g->arc.data[a].tail, y = g->arc.data[a].head, v = g->port.data[x].v;
  take_out(g, x);
  take_out(g, y);
  uint32_t k = new_region(g, REGION);
  list_port(g, x, 2 * k);
  list_port(g, y, 2 * k + 1);
  frac__match(g->f, g->f->v[v].start + (a - g->port.data[x].start));
}

void regions__open_cycle(Regions *g, uint32_t w)
{
  const Frac *f = g->f;
  frac__open_cycle(f, w);
  for (uint32_t x = f->arc[f->v[w].pred].head; x != w;) {
    uint32_t y = f->arc[f->v[x].pred].head, side = g->v[x].side;
    g->region.data[side / 2].kind = REGION;
    unlist_port(g, g->port_of[y]);
    list_port(g, g->port_of[y], side ^ 1);
    x = f->arc[f->v[y].pred].head;
  }
}

void regions__finish(Regions *g)
{
  const Frac *f = g->f;
  for (size_t k = 0; k < g->region.len; k++) regions__set_sign(g, &g->region.data[k], IDLE);
  for (size_t p = 0; p < g->port.len; p++) f->v[g->port.data[p].v].pot = g->port.data[p].pot;
  for (uint32_t v = 0; v < f->n; v++) {
    uint32_t side = g->v[v].side;
    f->v[v].pot += regions__side_sign(side) * g->region.data[side / 2].shift;
  }
  free(g->port_of);
  vec_free(&g->region);
  vec_free(&g->port);
  vec_free(&g->arc);
  vec_free(&g->cycle);
  vec_free(&g->path);
}
