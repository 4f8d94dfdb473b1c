// blossom_regions.c - all trees at once, on the graph whose nodes are regions of tight edges
// SPDX-License-Identifier: MIT
//
// In the regular parts of a mesh all edges are tight, and 95 vertices of 100 are in a few dozen regions. Vertices of a region
// have the same sign always, and edges inside of it need no watching. Only vertices with an edge to another region are
// looked at, the ports; a list of them is all that there is of a region.
//
// When two trees meet, the edges on the way that lead from region to region are matched, and both ends of each leave their
// regions; they are a region by themselves then. Whoever was matched to them is free, inside of its region, and nobody's
// concern until all is over. So a region is taken to have room for any number of paths. Where it has not, some of the free
// vertices stay free. The duals are feasible and matched edges tight whatever happens.
#include "base/base.h"
#include "quad/blossom_tight.h"

typedef enum { REGION, FREE, CYCLE } RegionKind;

typedef struct {
  int64_t shift;     // by which duals on side 0 have risen, and those on side 1 fallen, but for sign * now
  int32_t sign;      // BlossomSign of side 0
  uint32_t kind;     // FREE and CYCLE: a single vertex
  uint32_t tree;     // in a tree: the region of its root
  uint32_t link;     // next region of its tree
  uint32_t pred;     // in a tree: arc from the inner vertex it was entered at to the outer one above; NONE: the root
  uint32_t first[2]; // ports of each side
} Region;

typedef struct {
  int64_t pot;         // dual, but for its region's shift
  uint32_t v;          // the vertex
  uint32_t side;       // as of TightVertex
  uint32_t start;      // first of its arcs, in the vertex's order
  uint32_t degree;
  uint32_t next, prev; // ports of the same side
} Port;

// Arc of a port. Its head is NONE while that is on the other side of the same region.
typedef struct {
  uint32_t head, tail, rev;
  int32_t cost;
} PortArc;

typedef struct {
  Frac *f;
  TightVertex *v;
  uint32_t *port_of; // n: port of a vertex, or NONE
  Vec(Region) region;
  Vec(Port) port;
  Vec(PortArc) arc;
  U32Vec path;
} Regions;

static Region *region(const Regions *g, uint32_t port) { return &g->region.data[g->port.data[port].side / 2]; }
static int side_sign(uint32_t side) { return side & 1 ? -1 : 1; }
static int sign(const Regions *g, uint32_t port) { return side_sign(g->port.data[port].side) * region(g, port)->sign; }

static int64_t dual(const Regions *g, uint32_t port)
{
  const Region *r = region(g, port);
  return g->port.data[port].pot + side_sign(g->port.data[port].side) * (r->shift + r->sign * g->f->now);
}

static int64_t slack(const Regions *g, const PortArc *a)
{
  return g->f->scale * (int64_t)a->cost - dual(g, a->tail) - dual(g, a->head);
}

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
  uint32_t here = x->start + (a - f->v[x->v].start), there = g->port.data[q].start + (f->arc[a].rev - f->v[w].start);
  g->arc.data[here].head = q;
  g->arc.data[there].head = p;
  g->arc.data[here].rev = there;
  g->arc.data[there].rev = here;
}

// Make a port of v, and join it to those of other regions.
static void add_port(Regions *g, uint32_t v)
{
  const Frac *f = g->f;
  uint32_t from = f->v[v].start, to = f->v[v + 1].start, p = (uint32_t)g->port.len, start = (uint32_t)g->arc.len;
  vec_push(&g->port, ((Port){.pot = f->v[v].pot, .v = v, .start = start, .degree = to - from}));
  g->port_of[v] = p;
  for (uint32_t a = from; a < to; a++) vec_push(&g->arc, ((PortArc){NONE, p, NONE, f->arc[a].cost}));
  for (uint32_t a = from; a < to; a++) {
    uint32_t w = f->arc[a].head;
    if (g->port_of[w] != NONE && g->v[w].side != (g->v[v].side ^ 1)) join(g, p, a);
  }
  list_port(g, p, g->v[v].side);
}

static void build(Regions *g, uint32_t nregion)
{
  const Frac *f = g->f;
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

// ---- trees

static void set_sign(const Regions *g, Region *r, int s)
{
  r->shift += (r->sign - s) * g->f->now;
  r->sign = s;
}

// As plant of single vertices.
static void plant(Regions *g, uint32_t port)
{
  uint32_t k = g->port.data[port].side / 2;
  Region *r = &g->region.data[k];
  g->port.data[port].pot &= -g->f->scale;
  set_sign(g, r, OUTER);
  r->tree = k;
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
  set_sign(g, r, -side_sign(side));
  r->tree = region(g, x->tail)->tree;
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
  int64_t pot = dual(g, p);
  f->stats->swept++;
  for (uint32_t a = x->start; a < x->start + x->degree; a++) {
    const PortArc *y = &g->arc.data[a];
    if (y->head == NONE) continue;
    int s = sign(g, y->head);
    if (s == INNER) continue;
    int64_t room = f->scale * (int64_t)y->cost - pot - dual(g, y->head);
    if (room == 0 && s == IDLE && region(g, y->head)->kind == REGION) grow(g, a);
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
        if (x->head != NONE && sign(g, x->head) == OUTER)
          blossom__push(g->f->queue, g->f->now + slack(g, x), x->rev);
      }
}

static void fell(Regions *g, uint32_t root)
{
  for (uint32_t k = root; k != NONE; k = g->region.data[k].link) set_sign(g, &g->region.data[k], IDLE);
  bool last = --g->f->ntree == 0;
  for (uint32_t k = root, next; k != NONE; k = next) {
    next = g->region.data[k].link;
    g->region.data[k].link = g->region.data[k].pred = NONE;
    if (!last) scan_idle(g, k);
  }
}

// ---- what the queue brings

// A port leaves its region, and the vertex it was matched to stays behind. Vertices around it get to be ports.
static void take_out(Regions *g, uint32_t p)
{
  const Frac *f = g->f;
  uint32_t v = g->port.data[p].v, side = g->port.data[p].side, old = f->v[v].match;
  g->port.data[p].pot = dual(g, p);
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

// The ends of a tight arc between regions that are idle are a region by themselves, and matched.
static void pair_up(Regions *g, uint32_t a)
{
  uint32_t x = g->arc.data[a].tail, y = g->arc.data[a].head, v = g->port.data[x].v;
  take_out(g, x);
  take_out(g, y);
  uint32_t k = new_region(g, REGION);
  list_port(g, x, 2 * k);
  list_port(g, y, 2 * k + 1);
  frac__match(g->f, g->f->v[v].start + (a - g->port.data[x].start));
}

// The odd cycle through the vertex w is opened there; its other vertices are pairs.
static void open_cycle(Regions *g, uint32_t w)
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

static void collect_path(Regions *g, uint32_t port)
{
  for (uint32_t a = region(g, port)->pred; a != NONE; a = region(g, g->arc.data[a].head)->pred) vec_push(&g->path, a);
}

// The tight arc a leads from an outer port to one of another tree, or to a free vertex or odd cycle that is idle.
static void augment(Regions *g, uint32_t a)
{
  uint32_t x = g->arc.data[a].tail, y = g->arc.data[a].head;
  bool outer = sign(g, y) == OUTER;
  g->f->stats->augment++;
  vec_clear(&g->path);
  vec_push(&g->path, a);
  collect_path(g, x);
  if (outer) collect_path(g, y);
  fell(g, region(g, x)->tree);
  if (outer) fell(g, region(g, y)->tree);
  else if (region(g, y)->kind == CYCLE) open_cycle(g, g->port.data[y].v);
  for (size_t i = 0; i < g->path.len; i++) pair_up(g, g->path.data[i]);
}

// A tree that meets itself has found an odd cycle. It is over, and its root waits for another tree.
static void arc_event(Regions *g, uint32_t a)
{
  if (sign(g, g->arc.data[a].tail) != OUTER) a = g->arc.data[a].rev;
  const PortArc *x = &g->arc.data[a];
  int s = sign(g, x->head);
  if (sign(g, x->tail) != OUTER || s == INNER || slack(g, x) != 0) return; // what changed has noted it anew
  const Region *from = region(g, x->tail), *to = region(g, x->head);
  if (s == IDLE && to->kind == REGION) grow(g, a);
  else if (s == OUTER && from->tree == to->tree) fell(g, from->tree);
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

// Give duals to vertices.
static void finish(Regions *g)
{
  const Frac *f = g->f;
  for (size_t k = 0; k < g->region.len; k++) set_sign(g, &g->region.data[k], IDLE);
  for (size_t p = 0; p < g->port.len; p++) f->v[g->port.data[p].v].pot = g->port.data[p].pot;
  for (uint32_t v = 0; v < f->n; v++) {
    uint32_t side = g->v[v].side;
    f->v[v].pot += side_sign(side) * g->region.data[side / 2].shift;
  }
}

void frac__grow_regions(Frac *f, Tight *t, uint32_t nregion)
{
  Regions g = {.f = f, .v = t->v};
  build(&g, nregion);
  f->now = f->queue->last = 0;
  for (uint32_t p = 0; p < g.port.len; p++)
    if (region(&g, p)->kind == FREE) plant(&g, p);
  run(&g);
  finish(&g);
  free(g.port_of);
  vec_free(&g.region);
  vec_free(&g.port);
  vec_free(&g.arc);
  vec_free(&g.path);
}
