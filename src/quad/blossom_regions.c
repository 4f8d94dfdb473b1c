// blossom_regions.c - all trees at once, on the graph of regions
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/blossom_regions.h"

// ---- trees

// A free vertex becomes a tree; its dual is rounded as in blossom_fraction.c.
static void plant(Regions *g, uint32_t port)
{
  uint32_t k = g->port.data[port].side / 2;
  Region *r = &g->region.data[k];
  g->port.data[port].pot &= -g->f->scale;
  regions__set_sign(g, r, OUTER);
  r->tree = k;
  r->link = r->pred = NONE;
  g->f->ntree++;
  vec_push(&g->f->list, k);
}

// Take the idle region at the head of the tight arc a into the tree of its tail.
static void grow(Regions *g, uint32_t a)
{
  const PortArc *x = &g->arc.data[a];
  uint32_t side = g->port.data[x->head].side;
  Region *r = &g->region.data[side / 2], *root;
  g->f->stats->region++;
  regions__set_sign(g, r, -regions__side_sign(side));
  r->tree = regions__of(g, x->tail)->tree;
  r->pred = x->rev;
  root = &g->region.data[r->tree];
  r->link = root->link;
  root->link = side / 2;
  vec_push(&g->f->list, side / 2);
}

// Watch the edges of an outer port.
static void scan_outer(Regions *g, uint32_t p)
{
  Frac *f = g->f;
  const Port *x = &g->port.data[p];
  int64_t pot = regions__dual(g, p);
  f->stats->swept++;
  for (uint32_t a = x->start; a < x->start + x->degree; a++) {
    const PortArc *y = &g->arc.data[a];
    if (y->head == NONE) continue;
    int s = regions__sign(g, y->head);
    if (s == INNER) continue;
    int64_t room = f->scale * (int64_t)y->cost - pot - regions__dual(g, y->head);
    if (room == 0 && s == IDLE && regions__of(g, y->head)->kind == REGION) grow(g, a);
    else blossom__push(f->queue, f->now + (s == OUTER ? room / 2 : room), a);
  }
}

static void scan_region(Regions *g, uint32_t k)
{
  const Region *r = &g->region.data[k];
  if (r->sign == IDLE) return;
  for (uint32_t p = r->first[r->sign == INNER]; p != NONE; p = g->port.data[p].next) scan_outer(g, p);
}

// The region k has become idle: outer ports around may reach it.
static void scan_idle(const Regions *g, uint32_t k)
{
  for (int side = 0; side < 2; side++)
    for (uint32_t p = g->region.data[k].first[side]; p != NONE; p = g->port.data[p].next)
      for (uint32_t a = g->port.data[p].start, end = a + g->port.data[p].degree; a < end; a++) {
        const PortArc *x = &g->arc.data[a];
        if (x->head != NONE && regions__sign(g, x->head) == OUTER)
          blossom__push(g->f->queue, g->f->now + regions__slack(g, x), x->rev);
      }
}

// All regions of a tree are idle again.
static void fell(Regions *g, uint32_t root)
{
  for (uint32_t k = root; k != NONE; k = g->region.data[k].link)
    regions__set_sign(g, &g->region.data[k], IDLE);
  if (--g->f->ntree == 0) return;
  for (uint32_t k = root; k != NONE; k = g->region.data[k].link) scan_idle(g, k);
}

// The region above the region k of ctx; NONE at the root.
static uint32_t above(const void *ctx, uint32_t k)
{
  const Regions *g = ctx;
  uint32_t pred = g->region.data[k].pred;
  return pred == NONE ? NONE : g->port.data[g->arc.data[pred].head].side / 2;
}

// Note the arcs that lead from the region k up to `top`.
static void note_path(Regions *g, uint32_t k, uint32_t top)
{
  for (; k != top; k = above(g, k)) vec_push(&g->path, g->region.data[k].pred);
}

static void match_path(Regions *g)
{
  for (size_t i = 0; i < g->path.len; i++) regions__pair_up(g, g->path.data[i]);
}

// ---- odd cycles found

// From region k up to `top`.
static void freeze(Regions *g, uint32_t k, uint32_t top, uint32_t cycle)
{
  for (;; k = above(g, k)) {
    Region *r = &g->region.data[k];
    if (r->kind != FOUND) r->role = r->sign;
    r->kind = FOUND;
    r->tree = cycle;
    if (k == top) return;
  }
}

static void thaw(Regions *g, uint32_t k, uint32_t top)
{
  for (;; k = above(g, k)) {
    g->region.data[k].kind = REGION;
    if (k == top) return;
  }
}

// The arc a joins two outer ports of one tree: there is an odd cycle from there up to the regions' common
// ancestor. The root is matched, and a free vertex is left in that region. Duals on the cycle stay as they
// are until another tree comes to it.
static void find_cycle(Regions *g, uint32_t a)
{
  uint32_t x = regions__at(g, g->arc.data[a].tail), y = regions__at(g, g->arc.data[a].head);
  uint32_t root = g->region.data[x].tree, top = blossom__common_ancestor(g, above, x, y), cycle = (uint32_t)g->cycle.len;
  g->f->stats->shrink++;
  vec_push(&g->cycle, ((FoundCycle){a, top}));
  vec_clear(&g->path);
  note_path(g, top, root);
  freeze(g, x, top, cycle);
  freeze(g, y, top, cycle);
  fell(g, root);
  match_path(g);
}

// Is region k on the way from the port up to `top`?
static bool on_branch(const Regions *g, uint32_t port, uint32_t k, uint32_t top)
{
  uint32_t l = regions__at(g, port);
  while (l != k && l != top) l = above(g, l);
  return l == k;
}

// Note the arcs of the cycle over which a tree that has come to the port gets to the free vertex: up to the
// top if it came to what was outer, else down and round.
static void note_cycle(Regions *g, uint32_t port)
{
  uint32_t k = regions__at(g, port);
  FoundCycle c = g->cycle.data[g->region.data[k].tree];
  uint32_t x = g->arc.data[c.arc].tail, y = g->arc.data[c.arc].head;
  if (regions__port_sign(g, port) * g->region.data[k].role == OUTER) note_path(g, k, c.top);
  else {
    bool first = on_branch(g, x, k, c.top);
    note_path(g, regions__at(g, first ? x : y), k);
    vec_push(&g->path, c.arc);
    note_path(g, regions__at(g, first ? y : x), c.top);
  }
  thaw(g, regions__at(g, x), c.top);
  thaw(g, regions__at(g, y), c.top);
}

// ---- what the queue brings

// The tight arc a leads from an outer port to one of another tree, or to a free vertex or odd cycle that is
// idle.
static void augment(Regions *g, uint32_t a)
{
  uint32_t x = g->arc.data[a].tail, y = g->arc.data[a].head;
  uint32_t from = regions__of(g, x)->tree, to = regions__of(g, y)->tree;
  bool outer = regions__sign(g, y) == OUTER;
  g->f->stats->augment++;
  vec_clear(&g->path);
  vec_push(&g->path, a);
  note_path(g, regions__at(g, x), from);
  if (outer) note_path(g, regions__at(g, y), to);
  fell(g, from);
  if (outer) fell(g, to);
  else if (regions__of(g, y)->kind == CYCLE) regions__open_cycle(g, g->port.data[y].v);
  else if (regions__of(g, y)->kind == FOUND) note_cycle(g, y);
  match_path(g);
}

static void arc_event(Regions *g, uint32_t a)
{
  if (regions__sign(g, g->arc.data[a].tail) != OUTER) a = g->arc.data[a].rev;
  const PortArc *x = &g->arc.data[a];
  int s = regions__sign(g, x->head);
  // What changed has noted it anew.
  if (regions__sign(g, x->tail) != OUTER || s == INNER || regions__slack(g, x) != 0) return;
  const Region *from = regions__of(g, x->tail), *to = regions__of(g, x->head);
  if (s == IDLE && to->kind == REGION) grow(g, a);
  else if (s == OUTER && from->tree == to->tree) find_cycle(g, a);
  else augment(g, a);
}

// What the search will come to soon, on its way from list[k] to its ports and their arcs.
static inline void prefetch(const Regions *g, size_t k)
{
  const U32Vec *list = &g->f->list;
  if (k + 12 >= list->len) return;
  __builtin_prefetch(&g->region.data[list->data[k + 12]]);
  for (int step = 4; step <= 8; step += 4) {
    const Region *r = &g->region.data[list->data[k + step]];
    uint32_t p = r->first[r->sign == INNER];
    if (p == NONE) continue;
    if (step == 8) __builtin_prefetch(&g->port.data[p]);
    else __builtin_prefetch(&g->arc.data[g->port.data[p].start]);
  }
}

static void run(Regions *g)
{
  Frac *f = g->f;
  BlossomEvent e;
  for (;;) {
    for (; f->read < f->list.len; f->read++) {
      prefetch(g, f->read);
      scan_region(g, f->list.data[f->read]);
    }
    if (f->ntree == 0 || !blossom__pop(f->queue, &e)) break;
    vec_clear(&f->list);
    f->read = 0;
    f->now = e.key;
    f->stats->event++;
    arc_event(g, e.what);
  }
  blossom__drop(f->queue);
  vec_clear(&f->list);
  f->read = 0;
  f->ntree = 0;
}

void frac__grow_regions(Frac *f, Tight *t, uint32_t nregion)
{
  Regions g;
  regions__init(&g, f, t, nregion);
  f->now = f->queue->last = 0;
  for (uint32_t p = 0; p < g.port.len; p++)
    if (regions__of(&g, p)->kind == FREE) plant(&g, p);
  run(&g);
  regions__finish(&g);
}
