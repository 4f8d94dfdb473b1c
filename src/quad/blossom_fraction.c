// blossom_fraction.c - the start of the matching solver: the optimum of the linear program without blossoms
// SPDX-License-Identifier: MIT
//
// Its solutions are edges and odd cycles with half of each edge [Balinski1965]. On duals of meshes few cycles are left, and
// their number, not that of the free vertices of a greedy start, is what the search with blossoms has to do. There are no
// blossoms here: outer and inner nodes are single vertices, and a tree that closes an odd cycle is done. Three means take turns:
// small trees one by one, exchanges over tight edges (blossom_settle.c, blossom_forest.c), and all trees at once; where nearly
// all edges are tight, on a graph of regions (blossom_regions.c).
#include "base/base.h"
#include "quad/blossom_tight.h"

// Trees one by one: they stop at FIRST_CAP vertices swept, CAP_FACTOR times more from round to round, while a round sweeps
// no more than n. All at once: they stop at n.
enum { FIRST_CAP = 64, CAP_FACTOR = 3 };

// Few are free: less than one vertex in FEW.
enum { FEW = 4096 };

// ---- trees

static void set_sign(const Frac *f, uint32_t v, BlossomSign sign)
{
  FracVertex *x = &f->v[v];
  x->pot += (x->sign - (int)sign) * f->now;
  x->sign = sign;
}

// A free vertex becomes a tree. Duals of free vertices are kept multiples of `scale` at time 0: then two outer vertices always
// meet at a multiple of scale / 2.
static void plant(Frac *f, uint32_t v)
{
  f->v[v].pot &= -f->scale;
  set_sign(f, v, OUTER);
  f->v[v].tree = v;
  f->v[v].link = NONE;
  f->ntree++;
  vec_push(&f->list, v);
}

// Take the idle vertex at the head of the tight arc a, and its mate, into the tree of its tail.
static void grow(Frac *f, uint32_t a)
{
  uint32_t i = f->arc[a].head, o = frac__mate(f, i), tree = f->v[f->arc[a].tail].tree;
  f->stats->grow++;
  set_sign(f, i, INNER);
  set_sign(f, o, OUTER);
  f->v[i].pred = f->arc[a].rev;
  f->v[i].tree = f->v[o].tree = tree;
  f->v[o].link = f->v[tree].link;
  f->v[tree].link = o;
  vec_push(&f->list, o);
}

// Watch the edges of a new outer vertex.
static void scan_outer(Frac *f, uint32_t v)
{
  f->stats->swept++;
  for (uint32_t a = f->v[v].start; a < f->v[v + 1].start; a++) {
    const FracVertex *w = &f->v[f->arc[a].head];
    if (w->sign == INNER) continue;
    int64_t slack = frac__slack(f, a);
    if (slack == 0 && w->sign == IDLE && w->match != NONE) grow(f, a);
    else blossom__push(f->queue, f->now + (w->sign == OUTER ? slack / 2 : slack), a);
  }
}

// v has become idle: outer vertices around may reach it.
static void scan_idle(const Frac *f, uint32_t v)
{
  for (uint32_t a = f->v[v].start; a < f->v[v + 1].start; a++)
    if (f->v[f->arc[a].head].sign == OUTER) blossom__push(f->queue, f->now + frac__slack(f, a), f->arc[a].rev);
}

// All vertices of a tree are idle again.
static void fell(Frac *f, uint32_t root)
{
  for (uint32_t x = root; x != NONE; x = f->v[x].link) {
    if (x != root) set_sign(f, frac__mate(f, x), IDLE);
    set_sign(f, x, IDLE);
  }
  if (--f->ntree == 0) return;
  for (uint32_t x = root; x != NONE; x = f->v[x].link) {
    if (x != root) scan_idle(f, frac__mate(f, x));
    scan_idle(f, x);
  }
}

// Match the outer vertex x by arc a, or leave it single if that is NONE, and repair the path to its root.
static void flip_path(const Frac *f, uint32_t x, uint32_t a)
{
  for (;;) {
    uint32_t old = f->v[x].match;
    f->v[x].match = a;
    if (old == NONE) return;
    uint32_t i = f->arc[old].head;
    f->v[i].match = f->v[i].pred;
    a = f->arc[f->v[i].pred].rev;
    x = f->arc[a].tail;
  }
}

// ---- odd cycles

// The outer vertex above an outer one of ctx; NONE at the root.
static uint32_t above(const void *ctx, uint32_t outer)
{
  const Frac *f = ctx;
  return f->v[outer].match == NONE ? NONE : f->arc[f->v[frac__mate(f, outer)].pred].head;
}

// The arc a joins two outer vertices of what was one tree: the root goes up to their common ancestor, and the cycle from there
// to the tail of a, over a, and back stays.
static void make_cycle(const Frac *f, uint32_t a)
{
  uint32_t u = f->arc[a].tail, v = f->arc[a].head, top = blossom__common_ancestor(f, above, u, v), x = top;
  f->stats->shrink++;
  flip_path(f, top, NONE);
  f->v[u].pred = a;
  for (uint32_t o = u; o != top;) {
    uint32_t i = frac__mate(f, o), p = f->v[i].pred;
    f->v[i].pred = f->v[i].match;
    o = f->arc[p].head;
    f->v[o].pred = f->arc[p].rev;
  }
  for (uint32_t o = v; o != top; o = above(f, o)) f->v[o].pred = f->v[o].match;
  do {
    f->v[x].match = NONE;
    x = f->arc[f->v[x].pred].head;
  } while (x != top);
}

void frac__open_cycle(const Frac *f, uint32_t w)
{
  for (uint32_t x = f->arc[f->v[w].pred].head; x != w;) {
    uint32_t a = f->v[x].pred, next = f->arc[f->v[f->arc[a].head].pred].head;
    frac__match(f, a);
    x = next;
  }
}

// ---- what the queue brings

// The tight arc a leads from an outer vertex to one of another tree, or to a free idle vertex or an odd cycle.
static void augment(Frac *f, uint32_t a)
{
  uint32_t x = f->arc[a].tail, y = f->arc[a].head;
  FracVertex *w = &f->v[y];
  bool outer = w->sign == OUTER;
  f->stats->augment++;
  fell(f, f->v[x].tree);
  if (outer) {
    fell(f, w->tree);
    flip_path(f, y, f->arc[a].rev);
  } else {
    if (frac__on_cycle(w)) frac__open_cycle(f, y);
    w->match = f->arc[a].rev;
  }
  flip_path(f, x, a);
}

static void arc_event(Frac *f, uint32_t a)
{
  if (f->v[f->arc[a].tail].sign != OUTER) a = f->arc[a].rev;
  const FracVertex *u = &f->v[f->arc[a].tail], *w = &f->v[f->arc[a].head];
  f->stats->stale++;
  if (u->sign != OUTER || w->sign == INNER || frac__slack(f, a) != 0) return; // what changed has noted it anew
  f->stats->stale--;
  if (w->sign == IDLE && w->match != NONE) grow(f, a);
  else if (w->sign == OUTER && w->tree == u->tree) {
    fell(f, u->tree);
    make_cycle(f, a);
  } else augment(f, a);
}

// What the search will come to soon, on its way from list[k] to its arcs and their heads.
static inline void prefetch(const Frac *f, size_t k)
{
  const uint32_t *x = f->list.data + k;
  if (k + 16 >= f->list.len) return;
  __builtin_prefetch(&f->v[x[16]]);
  __builtin_prefetch(&f->arc[f->v[x[8]].start]);
  for (uint32_t a = f->v[x[4]].start; a < f->v[x[4] + 1].start; a++) __builtin_prefetch(&f->v[f->arc[a].head]);
}

// Until there are no trees, or nothing can happen, or `most` vertices are swept.
static void run(Frac *f, uint64_t most)
{
  BlossomEvent e;
  uint64_t swept = f->stats->swept;
  for (;;) {
    for (; f->read < f->list.len && f->stats->swept - swept < most; f->read++) {
      prefetch(f, f->read);
      if (f->v[f->list.data[f->read]].sign == OUTER) scan_outer(f, f->list.data[f->read]);
    }
    if (f->ntree == 0 || f->stats->swept - swept >= most || !blossom__pop(f->queue, &e)) break;
    vec_clear(&f->list);
    f->read = 0;
    f->now = e.key;
    f->stats->event++;
    arc_event(f, e.what);
  }
  blossom__drop(f->queue);
  vec_clear(&f->list);
  f->read = 0;
}

static void start_clock(Frac *f) { f->now = f->queue->last = 0; }

// One tree alone, until it has found something or swept `most` vertices.
static void grow_alone(Frac *f, uint32_t root, uint64_t most)
{
  start_clock(f);
  plant(f, root);
  run(f, most);
  if (f->ntree) fell(f, root);
}

static void grow_together(Frac *f)
{
  start_clock(f);
  for (uint32_t v = 0; v < f->n; v++)
    if (frac__is_free(&f->v[v])) plant(f, v);
  run(f, f->n);
  for (uint32_t v = 0; v < f->n; v++) set_sign(f, v, IDLE);
  f->ntree = 0;
}

// ---- all together

static uint32_t count_free(const Frac *f)
{
  uint32_t n = 0;
  for (uint32_t v = 0; v < f->n; v++) n += frac__is_free(&f->v[v]);
  return n;
}

static void round_alone(Frac *f, uint64_t cap)
{
  for (uint32_t v = 0; v < f->n; v++)
    if (frac__is_free(&f->v[v])) grow_alone(f, v, cap);
}

static uint32_t rounds_alone(Frac *f, uint32_t left)
{
  for (uint64_t cap = FIRST_CAP; left && (cap == FIRST_CAP || left * cap <= f->n); cap *= CAP_FACTOR) {
    round_alone(f, cap);
    left = count_free(f);
  }
  return left;
}

// Match what tight edges allow; in regions first if there are any. Few that are left see hardly anything but odd cycles.
static uint32_t settle(Frac *f, Tight *t, bool regions)
{
  tight__read(f, t);
  if (regions) tight__settle(f, t, true);
  if (!regions || tight__count_free(f, t) > f->n / FEW) tight__settle(f, t, false);
  tight__forest(f, t);
  tight__write(f, t);
  return count_free(f);
}

// Are nearly all edges tight?
static bool is_dense(const Frac *f, const Tight *t) { return t->start[f->n] >= f->v[f->n].start / 10 * 9; }

// Turns with regions as long as they help, then turns without, until nothing is left, or they change nothing.
static void solve(Frac *f)
{
  uint32_t left = count_free(f), before = NONE;
  if (left == 0) return;
  Tight t;
  tight__init(f, &t);
  left = rounds_alone(f, left);
  left = settle(f, &t, false);
  while (left && left < before && is_dense(f, &t)) {
    before = left;
    frac__grow_regions(f, &t, tight__regions(f, &t));
    left = settle(f, &t, true);
  }
  for (before = NONE; left && left != before;) {
    before = left;
    grow_together(f);
    left = count_free(f);
    left = rounds_alone(f, left);
    left = settle(f, &t, false);
  }
  tight__release(&t);
}

void blossom__fractional_start(Blossom *b)
{
  Frac f = {.arc = b->arc, .n = b->n, .scale = b->scale, .queue = &b->queue, .stats = &b->stats};
  f.v = mem_alloc(((size_t)b->n + 1) * sizeof *f.v);
  for (uint32_t v = 0; v <= b->n; v++)
    f.v[v] = (FracVertex){.pot = b->v[v].pot, .start = b->v[v].start, .match = b->v[v].match, .pred = NONE};
  solve(&f);
  start_clock(&f);
  for (uint32_t v = 0; v < b->n; v++)
    if (frac__on_cycle(&f.v[v])) {
      frac__open_cycle(&f, v);
      f.v[v].pred = NONE;
    }
  for (uint32_t v = 0; v < b->n; v++) {
    b->v[v].pot = f.v[v].pot;
    b->v[v].match = f.v[v].match;
  }
  free(f.v);
  vec_free(&f.list);
}
