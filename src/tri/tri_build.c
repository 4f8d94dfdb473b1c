// tri_build.c - the Delaunay triangulation of many points: order, duplicates, parts, threads
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_int.h"

#include "base/thread.h"
#include "geom/hilbert.h"
#include "tri/tri_bulk.h"

// ---- points in order ----------------------------------------------------------------------------------------------

typedef struct {
  double *xy;
  const uint32_t *order;
  double *to;
  size_t n;
  uint32_t *of;    // gets the place in the order of each point, or NULL
  uint32_t *found; // by chunk: the first point that is not finite, or NONE; then how many are equal to the one before
} Gather;

enum { GATHER_CHUNK = 1 << 16 };

static void check_chunk(void *ctx, size_t k, int worker)
{
  Gather *g = ctx;
  (void)worker;
  size_t end = MIN(g->n, (k + 1) * GATHER_CHUNK);
  g->found[k] = NONE;
  for (size_t i = end; i-- > k * GATHER_CHUNK;)
    if (!isfinite(g->xy[2 * i]) || !isfinite(g->xy[2 * i + 1])) g->found[k] = (uint32_t)i;
}

static void gather_chunk(void *ctx, size_t k, int worker)
{
  Gather *g = ctx;
  (void)worker;
  size_t end = MIN(g->n, (k + 1) * GATHER_CHUNK);
  for (size_t i = k * GATHER_CHUNK; i < end; i++) {
    const double *p = g->xy + 2 * (size_t)g->order[i];
    g->to[2 * i] = p[0];
    g->to[2 * i + 1] = p[1];
  }
}

// Points in order: number them and count those equal to the one before.
static void number_chunk(void *ctx, size_t k, int worker)
{
  Gather *g = ctx;
  (void)worker;
  size_t end = MIN(g->n, (k + 1) * GATHER_CHUNK);
  const double *p = g->to;
  uint32_t equal = 0;
  for (size_t i = k * GATHER_CHUNK; i < end; i++) {
    if (g->of) g->of[g->order[i]] = (uint32_t)i;
    if (i > 0) equal += p[2 * i] == p[2 * i - 2] && p[2 * i + 1] == p[2 * i - 1];
  }
  g->found[k] = equal;
}

// Back from g.to to where they came from.
static void copy_chunk(void *ctx, size_t k, int worker)
{
  Gather *g = ctx;
  (void)worker;
  size_t from = k * GATHER_CHUNK, end = MIN(g->n, from + GATHER_CHUNK);
  memcpy(g->xy + 2 * from, g->to + 2 * from, 2 * (end - from) * sizeof *g->to);
}

static int compare_u32(const void *a, const void *b)
{
  uint32_t x, y;
  memcpy(&x, a, sizeof x);
  memcpy(&y, b, sizeof y);
  return (x > y) - (x < y);
}

// Points sorted so that equal ones are neighbours: drop the later ones, from the keys too. of[] gets the place in the order
// without duplicates of each point.
static void drop_duplicates(double *xy, uint32_t *order, uint32_t *key, size_t n, uint32_t *of, U32Vec *duplicates)
{
  size_t k = 0, old = duplicates ? duplicates->len : 0;
  for (size_t i = 0; i < n; i++) {
    bool again = k > 0 && xy[2 * k - 2] == xy[2 * i] && xy[2 * k - 1] == xy[2 * i + 1];
    if (again && duplicates) vec_push(duplicates, order[i]);
    if (!again) {
      if (k != i) {
        xy[2 * k] = xy[2 * i];
        xy[2 * k + 1] = xy[2 * i + 1];
        key[k] = key[i];
      }
      k++;
    }
    if (of) of[order[i]] = (uint32_t)k - 1;
    if (!again) order[k - 1] = order[i];
  }
  if (duplicates && duplicates->len > old)
    qsort(duplicates->data + old, duplicates->len - old, sizeof *duplicates->data, compare_u32);
}

// ---- parts --------------------------------------------------------------------------------------------------------

// The upper part of the tree of cells: one leaf for one thread, else enough to go round. Its leaves are built one by one, then
// the halves of each level are joined from the lowest up. Where it is cut makes no difference to the triangulation.
enum { MAX_NODES = 512, MAX_DEPTH = 12, TASKS = 16, SMALL_TASK = 2048 };

typedef struct {
  VertId lo, hi, mid; // mid: where its halves meet, if it has any
  int child[2];       // -1: none, it is built in one go
  int depth;
  BulkHull hull;
} Node;

typedef struct {
  Bulk *worker;
  Node node[MAX_NODES];
  int n, todo[MAX_NODES];
} Tree;

static int add_node(Tree *t, VertId lo, VertId hi, int depth, size_t task)
{
  int k = t->n++;
  Node *d = &t->node[k];
  *d = (Node){.lo = lo, .hi = hi, .child = {-1, -1}, .depth = depth};
  if (hi - lo <= task || depth == MAX_DEPTH || t->n + 2 * (MAX_DEPTH - depth) + 2 > MAX_NODES) return k;
  d->mid = bulk_split(t->worker, lo, hi);
  if (d->mid == hi) return k;
  int first = add_node(t, lo, d->mid, depth + 1, task), second = add_node(t, d->mid, hi, depth + 1, task);
  d->child[0] = first;
  d->child[1] = second;
  return k;
}

static void build_node(void *ctx, size_t i, int worker)
{
  Tree *t = ctx;
  Node *d = &t->node[t->todo[i]];
  d->hull = bulk_build(&t->worker[worker], d->lo, d->hi);
}

static void merge_node(void *ctx, size_t i, int worker)
{
  Tree *t = ctx;
  Node *d = &t->node[t->todo[i]];
  d->hull = bulk_merge(&t->worker[worker], d->mid, &t->node[d->child[0]].hull, &t->node[d->child[1]].hull);
}

static bool is_task(const Node *d) { return d->child[0] < 0; }

static void build_tree(Tree *t, int threads)
{
  size_t n = 0;
  for (int k = 0; k < t->n; k++) { // the largest first
    if (!is_task(&t->node[k])) continue;
    size_t j = n++;
    uint32_t size = t->node[k].hi - t->node[k].lo;
    for (; j > 0 && t->node[t->todo[j - 1]].hi - t->node[t->todo[j - 1]].lo < size; j--)
      t->todo[j] = t->todo[j - 1];
    t->todo[j] = k;
  }
  thread_for(n, threads, build_node, t);
  for (int depth = MAX_DEPTH; depth >= 0; depth--) {
    n = 0;
    for (int k = 0; k < t->n; k++)
      if (t->node[k].depth == depth && !is_task(&t->node[k])) t->todo[n++] = k;
    if (n) thread_for(n, threads, merge_node, t);
  }
}

static void triangulate(Tri *m, const double *xy, const uint32_t *key, size_t n, int threads, bool incremental)
{
  threads = n > SMALL_TASK ? thread_count(threads) : 1;
  Bulk *b = mem_zalloc((size_t)threads * sizeof *b);
  for (int i = 0; i < threads; i++) {
    b[i] = (Bulk){.xy = xy, .key = key, .vert = m->vert, .twin = m->twin, .incremental = incremental};
    bulk_begin(&b[i]);
  }
  Tree *t = mem_alloc(sizeof *t);
  t->worker = b;
  t->n = 0;
  add_node(t, 0, (VertId)n, 0, incremental || threads == 1 ? n : MAX(n / (TASKS * (size_t)threads), (size_t)SMALL_TASK));
  build_tree(t, threads);
  free(t);
  for (int i = 0; i < threads; i++) {
    m->count.orient_slow += b[i].count.orient_slow;
    m->count.incircle_slow += b[i].count.incircle_slow;
    m->count.expansion += b[i].count.expansion;
    m->count.multiprecision += b[i].count.multiprecision;
    m->count.ties += b[i].count.ties;
    m->walks += b[i].walks;
    m->walk_steps += b[i].steps;
    m->cavity_triangles += b[i].cavity;
    m->merge_triangles += b[i].merged;
    m->merge_flips += b[i].flipped;
    bulk_end(&b[i]);
  }
  free(b);
}

static uint8_t dimension(const Tri *m)
{
  if (m->nt == 0) return m->nv == 0 ? 255 : 0;
  for (TriId t = 0; t < m->nt; t++)
    if (!tri_is_ghost(m, t)) return 2;
  return 1;
}

// The vertices get the numbers of the points as given, and the coordinates in that order.
static void number_as_given(Tri *m, double *xy, size_t n, const uint32_t *order, const TriBuild *how)
{
  for (size_t e = 0; e < 3 * (size_t)m->nt; e++)
    if (m->vert[e] != TRI_INF) m->vert[e] = order[m->vert[e]];
  if (how->vertex_of)
    for (size_t i = 0; i < n; i++) how->vertex_of[i] = order[how->vertex_of[i]];
  if (how->take) m->xy = xy;
  else {
    m->xy = mem_alloc(2 * n * sizeof *m->xy);
    if (n) memcpy(m->xy, xy, 2 * n * sizeof *m->xy);
  }
  m->nv = m->cap_v = (uint32_t)n;
}

TriBuildResult tri_build(Tri *m, double *xy, size_t n, TriBuild *how)
{
  size_t chunks = (n + GATHER_CHUNK - 1) / GATHER_CHUNK;
  Gather g = {.xy = xy, .n = n, .of = how->vertex_of, .found = mem_alloc(chunks * sizeof *g.found)};
  thread_for(chunks, how->threads, check_chunk, &g);
  how->bad = NONE;
  for (size_t k = chunks; k-- > 0;) how->bad = MIN(how->bad, g.found[k]);
  TriBuildResult bad = n > TRI_MAX_VERTICES ? TRI_BUILD_TOO_MANY : how->bad != NONE ? TRI_BUILD_NOT_FINITE : TRI_BUILD_GOOD;
  if (bad != TRI_BUILD_GOOD) {
    if (how->take) free(xy);
    free(g.found);
    return bad;
  }
  tri_init(m);
  // The arrays to come serve as scratch memory of the sort: fresh pages are dear.
  tri_reserve(m, 0, MAX(n > 1 ? 2 * n - 2 : 0, (size_t)4));
  uint64_t *scratch = (void *)m->twin;
  uint32_t *order = how->reorder ? m->vert : mem_alloc(n * sizeof *order);
  uint32_t *key = mem_alloc((n + BULK_KEYS_BEYOND) * sizeof *key);
  hilbert_sort(xy, n, order, key, scratch, how->threads);
  bool in_place = how->reorder && how->take;
  double *sorted = in_place ? (void *)m->twin : mem_alloc_large(2 * n * sizeof *sorted);
  g.order = order, g.to = sorted;
  thread_for(chunks, how->threads, gather_chunk, &g);
  if (in_place) {
    thread_for(chunks, how->threads, copy_chunk, &g);
    g.to = sorted = xy;
  }
  thread_for(chunks, how->threads, number_chunk, &g);
  size_t nd = n;
  for (size_t k = 0; k < chunks; k++) nd -= g.found[k];
  free(g.found);
  if (nd < n) drop_duplicates(sorted, order, key, n, how->vertex_of, how->duplicates);
  size_t nt = nd > 1 ? 2 * nd - 2 : 0;
  m->nt = (uint32_t)nt;
  memset(m->flag, 0, m->cap_t * sizeof *m->flag);
  memset(key + nd, 0xff, BULK_KEYS_BEYOND * sizeof *key);
  if (nd > 1) triangulate(m, sorted, key, nd, how->threads, how->incremental);
  free(key);
  if (how->reorder) {
    m->xy = sorted;
    m->nv = m->cap_v = (uint32_t)nd;
  } else {
    number_as_given(m, xy, n, order, how);
    free(order);
    free(sorted);
  }
  m->dim = dimension(m);
  m->last = nt ? 0 : NONE;
  return TRI_BUILD_GOOD;
}
