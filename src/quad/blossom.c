// blossom.c - minimum-cost perfect matching: start, queue of events, result
// SPDX-License-Identifier: MIT
//
// The primal-dual method of [Edmonds1965] with all trees growing at once: every free vertex is the root of an alternating
// tree, time is the amount by which the duals of those that grow have risen, and a monotone queue holds the moments at which
// edges get tight and blossoms run out. Events of one moment are taken first in first out, so that trees spread over tight
// edges like waves and share the ground among them. docs/internals/blossom.md tells why that matters more than anything.
#include "base/base.h"
#include "quad/blossom.h"
#include "quad/blossom_int.h"

enum { MAX_SCALE_BITS = 30, FIRST_CAP = 64, CAP_FACTOR = 3 };

// ---- the queue

void blossom__push(BlossomQueue *q, int64_t key, uint32_t what)
{
  uint64_t diff = (uint64_t)key ^ (uint64_t)q->last;
  DCHECK(key >= q->last);
  int k = diff ? 64 - __builtin_clzll(diff) : 0;
  if (k) q->filled |= (uint64_t)1 << (k - 1);
  vec_push(&q->bucket[k], ((BlossomEvent){key, what}));
}

bool blossom__pop(BlossomQueue *q, BlossomEvent *e)
{
  BlossomEvents *now = &q->bucket[0];
  if (q->read == now->len) {
    vec_clear(now);
    q->read = 0;
    if (!q->filled) return false;
    int k = __builtin_ctzll(q->filled) + 1;
    BlossomEvents from = q->bucket[k];
    int64_t least = from.data[0].key;
    for (size_t i = 1; i < from.len; i++) least = MIN(least, from.data[i].key);
    q->last = least;
    q->filled &= ~((uint64_t)1 << (k - 1));
    for (size_t i = 0; i < from.len; i++) blossom__push(q, from.data[i].key, from.data[i].what);
    q->bucket[k].len = 0;
  }
  *e = now->data[q->read++];
  return true;
}

void blossom__drop(BlossomQueue *q)
{
  for (size_t i = 0; i < ARRAY_LEN(q->bucket); i++) vec_clear(&q->bucket[i]);
  q->read = 0;
  q->filled = 0;
}

// ---- start

static void build_arcs(Blossom *b)
{
  const BlossomGraph *g = b->g;
  for (size_t e = 0; e < g->m; e++) {
    uint32_t u = g->edge[2 * e], v = g->edge[2 * e + 1];
    CHECK(u < g->n && v < g->n && g->cost[e] <= BLOSSOM_MAX_COST && g->cost[e] >= -BLOSSOM_MAX_COST);
    if (u == v) continue;
    b->v[u + 1].start++;
    b->v[v + 1].start++;
  }
  for (uint32_t v = 0; v < g->n; v++) b->v[v + 1].start += b->v[v].start;
  b->narc = b->v[g->n].start;
  b->arc = mem_alloc((size_t)b->narc * sizeof *b->arc);
  b->arc_edge = mem_alloc((size_t)b->narc * sizeof *b->arc_edge);
  uint32_t *at = mem_alloc(((size_t)g->n + 1) * sizeof *at);
  for (uint32_t v = 0; v < g->n; v++) at[v] = b->v[v].start;
  for (uint32_t e = 0; e < g->m; e++) {
    uint32_t u = g->edge[2 * (size_t)e], v = g->edge[2 * (size_t)e + 1];
    if (u == v) continue;
    uint32_t i = at[u]++, j = at[v]++;
    b->arc[i] = (BlossomArc){v, u, j, g->cost[e]};
    b->arc[j] = (BlossomArc){u, v, i, g->cost[e]};
    b->arc_edge[i] = b->arc_edge[j] = e;
  }
  free(at);
}

// The finest power of two by which costs can be multiplied without fear of overflow: no dual exceeds the sum of all costs.
// Each round of the search halves the unit of time once.
static int64_t choose_scale(const BlossomGraph *g)
{
  uint64_t most = 1;
  for (size_t e = 0; e < g->m; e++) {
    int64_t c = g->cost[e];
    most = MAX(most, (uint64_t)(c < 0 ? -c : c));
  }
  int bits = 62 - (64 - __builtin_clzll(most)) - (32 - __builtin_clz(g->n | 1));
  return (int64_t)1 << MIN(bits, MAX_SCALE_BITS);
}

static void init(Blossom *b, const BlossomGraph *g)
{
  CHECK(g->n <= BLOSSOM_MAX_VERTICES && g->m < UINT32_MAX / 4);
  *b = (Blossom){.g = g, .n = g->n, .free_node = NONE, .free_contact = NONE, .scale = choose_scale(g)};
  b->v = mem_zalloc(((size_t)g->n + 1) * sizeof *b->v);
  build_arcs(b);
  b->nnode = g->n;
  b->node_cap = (size_t)g->n + g->n / 8 + 16;
  b->node = mem_alloc(b->node_cap * sizeof *b->node);
  for (uint32_t v = 0; v < g->n; v++) {
    BlossomVertex *x = &b->v[v];
    x->label = x->node = v;
    x->match = x->pred = x->next = NONE;
    b->node[v] = (BlossomNode){.sib = NONE, .sib_prev = NONE, .sib_arc = NONE, .first = v, .last = v, .size = 1,
                               .label = v, .child = NONE};
  }
}

static void reach(uint32_t *order, uint8_t *seen, uint32_t *len, uint32_t v)
{
  if (seen[v]) return;
  seen[v] = 1;
  order[(*len)++] = v;
}

// Vertices in order of a breadth-first search from those that have not three edges: the boundary triangles of a mesh.
static uint32_t *wave_order(const Blossom *b)
{
  uint32_t *order = mem_alloc(((size_t)b->n + 1) * sizeof *order), len = 0;
  uint8_t *seen = mem_zalloc((size_t)b->n + 1);
  for (uint32_t s = 0; s < b->n; s++)
    if (b->v[s + 1].start - b->v[s].start != 3) reach(order, seen, &len, s);
  for (uint32_t s = 0, i = 0; s < b->n; s++) {
    if (i == len) reach(order, seen, &len, s);
    for (; i < len; i++)
      for (uint32_t a = b->v[order[i]].start; a < b->v[order[i] + 1].start; a++) reach(order, seen, &len, b->arc[a].head);
  }
  free(seen);
  return order;
}

// Raise the dual of v until an edge is tight; match it along one if that can be.
static void greedy_vertex(Blossom *b, uint32_t v)
{
  int64_t room = INT64_MAX;
  uint32_t best = NONE;
  for (uint32_t a = b->v[v].start; a < b->v[v + 1].start; a++) {
    int64_t slack = b->scale * (int64_t)b->arc[a].cost - b->v[v].pot - b->v[b->arc[a].head].pot;
    if (slack < room || (slack == room && b->v[b->arc[best].head].match != NONE)) best = a, room = slack;
  }
  if (best == NONE) return;
  b->v[v].pot += room;
  uint32_t w = b->arc[best].head;
  if (b->v[v].match == NONE && b->v[w].match == NONE) {
    b->v[v].match = best;
    b->v[w].match = b->arc[best].rev;
  }
}

// Duals: half the cheapest edge, then as high as the neighbours allow, in the order of a wave that crosses the graph: it
// leaves few vertices unmatched behind (about one in 200 on meshes, where an arbitrary order leaves one in 4).
static void greedy_start(Blossom *b)
{
  for (uint32_t v = 0; v < b->n; v++) {
    int32_t least = b->v[v].start < b->v[v + 1].start ? INT32_MAX : 0;
    for (uint32_t a = b->v[v].start; a < b->v[v + 1].start; a++) least = MIN(least, b->arc[a].cost);
    b->v[v].pot = b->scale / 2 * (int64_t)least;
  }
  uint32_t *order = wave_order(b);
  for (uint32_t i = 0; i < b->n; i++) greedy_vertex(b, order[i]);
  free(order);
}

// ---- search

static void plant_all(Blossom *b)
{
  for (uint32_t v = 0; v < b->n; v++) b->stats.start_free += b->v[v].match == NONE;
  b->tree_cap = 2 * b->stats.start_free + 1;
  b->ntrees = 1;
  b->tree = mem_alloc(b->tree_cap * sizeof *b->tree);
  b->tree[0] = (BlossomTree){.life = DEAD, .contact = NONE};
  for (uint32_t v = 0; v < b->n; v++)
    if (b->v[v].match == NONE) blossom__plant(b, v);
}

// A tree that has taken in more than `cap` vertices sleeps until the next round, and the cap grows from round to round: no
// tree can take all the ground and be dissolved with all of it again and again.
static void search(Blossom *b)
{
  BlossomEvent e;
  plant_all(b);
  b->unit = b->scale / 4;
  b->cap = FIRST_CAP;
  for (bool last = false; b->ntree > 0 && !last; b->cap *= CAP_FACTOR, b->unit /= 2) {
    last = b->cap > b->n || b->unit == 1;
    if (last) b->cap = UINT32_MAX;
    blossom__wake(b);
    while (b->nawake > 0 && blossom__pop(&b->queue, &e)) {
      b->now = e.key;
      b->stats.event++;
      if (e.what < b->narc) blossom__arc_event(b, e.what);
      else blossom__inner_event(b, e.what - b->narc);
    }
    blossom__drop(&b->queue);
  }
}

// ---- result

// The inner nodes of trees that can grow no more are single vertices, and their neighbours in trees are outer nodes, which
// hold odd numbers of vertices and touch each other nowhere.
static void find_barrier(const Blossom *b, BlossomResult *r)
{
  r->barrier = mem_zalloc(b->n);
  for (uint32_t v = 0; v < b->n; v++) r->barrier[v] = blossom__sign(b, &b->v[b->v[v].label]) == INNER;
}

// Open the blossoms from the outside in; what is left in v[].pot and off are the vertices' own duals once the blossoms'
// are taken away.
static void open_all(Blossom *b, BlossomResult *r)
{
  U32Vec todo = {0}, above = {0}, parent = {0};
  Vec(int64_t) z = {0};
  for (uint32_t v = 0; v < b->n; v++)
    if (b->v[v].label == v && b->v[v].node >= b->n) {
      vec_push(&todo, b->v[v].node);
      vec_push(&above, NONE);
    }
  while (todo.len) {
    uint32_t s = vec_pop(&todo), up = vec_pop(&above), first = b->node[s].child, id = (uint32_t)z.len;
    int64_t dual = blossom__level(b, &b->v[b->node[s].label]) - b->node[s].z;
    vec_push(&z, dual);
    vec_push(&parent, up);
    blossom__open(b, s);
    uint32_t x = first;
    do {
      uint32_t l = b->node[x].label;
      b->v[l].off -= dual;
      if (x < b->n) r->parent[x] = id;
      else {
        b->node[x].z -= dual;
        vec_push(&todo, x);
        vec_push(&above, id);
      }
      x = b->node[x].sib;
    } while (x != first);
  }
  vec_free(&todo);
  vec_free(&above);
  r->nblossom = (uint32_t)z.len;
  r->z = z.data;
  r->parent = mem_realloc(r->parent, ((size_t)b->n + z.len) * sizeof *r->parent);
  for (size_t i = 0; i < parent.len; i++) r->parent[b->n + i] = parent.data[i];
  vec_free(&parent);
}

static void read_mates(const Blossom *b, BlossomResult *r)
{
  for (uint32_t v = 0; v < b->n; v++) {
    uint32_t a = b->v[v].match;
    r->mate[v] = a == NONE ? NONE : b->arc[a].head;
    r->mate_edge[v] = a == NONE ? NONE : b->arc_edge[a];
    r->unmatched += a == NONE;
    if (a != NONE && v < r->mate[v]) r->cost += b->arc[a].cost;
    r->y[v] = blossom__pot(b, v);
  }
}

static void release(Blossom *b)
{
  free(b->arc);
  free(b->arc_edge);
  free(b->v);
  free(b->node);
  free(b->tree);
  vec_free(&b->contact);
  vec_free(&b->up_u);
  vec_free(&b->up_v);
  vec_free(&b->fresh);
  for (size_t i = 0; i < ARRAY_LEN(b->queue.bucket); i++) vec_free(&b->queue.bucket[i]);
}

BlossomResult *blossom_solve(const BlossomGraph *g)
{
  Blossom b;
  init(&b, g);
  greedy_start(&b);
  blossom__fractional_start(&b);
  search(&b);
  BlossomResult *r = mem_zalloc(sizeof *r);
  r->mate = mem_alloc((size_t)g->n * sizeof *r->mate);
  r->mate_edge = mem_alloc((size_t)g->n * sizeof *r->mate_edge);
  r->y = mem_alloc((size_t)g->n * sizeof *r->y);
  r->parent = mem_alloc((size_t)g->n * sizeof *r->parent);
  for (uint32_t v = 0; v < g->n; v++) r->parent[v] = NONE;
  if (b.ntree > 0) find_barrier(&b, r);
  open_all(&b, r);
  read_mates(&b, r);
  r->scale = b.scale;
  r->stats = b.stats;
  release(&b);
  return r;
}

void blossom_free(BlossomResult *r)
{
  if (!r) return;
  free(r->mate);
  free(r->mate_edge);
  free(r->y);
  free(r->z);
  free(r->parent);
  free(r->barrier);
  free(r);
}
