// tri_bulk.c - many points at once: the merging of parts
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_bulk.h"

// ---- merging [Guibas85] ---------------------------------------------------------------------------------------------

// Is p right of l -> r?
static inline int turn(Bulk *m, VertId l, VertId r, VertId p)
{
  return orient2d_count(bulk_at(m, l), bulk_at(m, r), bulk_at(m, p), &m->count);
}

// The lower common tangent of the hulls. *hl: the hull edge that leaves its vertex on the left; *hr: on the
// right.
static void tangent(Bulk *m, VertId *l, EdgeId *hl, VertId *r, EdgeId *hr)
{
  for (bool moved = true; moved;) {
    moved = false;
    while (*hl != NONE) {
      VertId v = m->vert[*hl + 1];
      if (turn(m, *l, *r, v) >= 0) break;
      *hl = bulk_hull_next(m, *hl);
      *l = v;
      moved = true;
    }
    while (*hr != NONE) {
      EdgeId h = bulk_hull_prev(m, *hr);
      VertId v = m->vert[h];
      if (turn(m, *l, *r, v) >= 0) break;
      *hr = h;
      *r = v;
      moved = true;
    }
  }
}

static inline void copy_extreme(BulkHull *to, const BulkHull *from, int i)
{
  to->at[i] = from->at[i];
  to->v[i] = from->v[i];
  to->e[i] = from->e[i];
}

// The hull of the union. l and r are the upper vertex on the left and the lower one on the right, where hull
// edges are new: hl and hr, or NONE.
static inline BulkHull unite(const BulkHull *hull_l, const BulkHull *hull_r, int axis, VertId l, EdgeId hl, VertId r,
                             EdgeId hr)
{
  BulkHull x;
  const BulkHull *of[2] = {hull_l, hull_r};
  int low = 2 * axis, other = 2 - low;
  copy_extreme(&x, hull_l, low);
  copy_extreme(&x, hull_r, low + 1);
  // Of equally far ones along the other axis the right part's is rightmost, the lower part's lowest.
  const double *a = hull_l->at + other, *b = hull_r->at + other;
  int tie = axis == 0, lower = (b[0] < a[0]) | (tie & (b[0] == a[0])), upper = (b[1] > a[1]) | (tie & (b[1] == a[1]));
  copy_extreme(&x, of[lower], other);
  copy_extreme(&x, of[upper], other + 1);
  for (int i = 0; i < 4; i++) {
    x.e[i] = (x.v[i] == l) & (hl != NONE) ? hl : x.e[i];
    x.e[i] = (x.v[i] == r) & (hr != NONE) ? hr : x.e[i];
  }
  return x;
}

// ---- the tree of merges ---------------------------------------------------------------------------------------------

// A part whose halves are being built: where they meet, their hulls, and how many are missing. Then, while
// they are being merged: which is left along the axis, and the hull edges at the lower common tangent.
typedef struct {
  VertId mid;
  uint32_t parent; // 2 node + which, NONE: it is the whole
  uint8_t missing, axis, right;
  VertId low_r;
  EdgeId hl, hr;
  BulkHull hull[2];
} Node;

// A part to be built, and whose half it is.
typedef struct {
  VertId lo, hi;
  uint32_t parent;
} Part;

struct BulkWork {
  Vec(Node) nodes;
  U32Vec unused, ready;
  Vec(Part) parts; // to be built, the first last
  BulkHull whole;
};

static uint32_t new_node(struct BulkWork *w, VertId mid, uint32_t parent)
{
  uint32_t k;
  if (w->unused.len) k = vec_pop(&w->unused);
  else {
    vec_push(&w->nodes, (Node){0});
    k = (uint32_t)w->nodes.len - 1;
  }
  Node *d = &w->nodes.data[k];
  d->mid = mid, d->parent = parent, d->missing = 2;
  return k;
}

// Where the hull of parent's half goes.
static inline BulkHull *place_of(struct BulkWork *w, uint32_t parent)
{
  return parent == NONE ? &w->whole : &w->nodes.data[parent / 2].hull[parent & 1];
}

static inline void deliver(Bulk *m, struct BulkWork *w, uint32_t parent)
{
  if (parent == NONE || --w->nodes.data[parent / 2].missing) return;
  vec_push(&w->ready, parent / 2);
  m->waiting = true;
}

// Build a part, or divide it.
static void advance(Bulk *m, struct BulkWork *w, Part p)
{
  VertId mid = p.hi, n = p.hi - p.lo;
  if (n <= 3) *place_of(w, p.parent) = bulk_base(m, p.lo, p.hi);
  else if (n > 4 || m->incremental || !bulk_four(m, p.lo, place_of(w, p.parent))) {
    if (!m->incremental) mid = bulk_split(m, p.lo, p.hi);
    if (mid == p.hi) *place_of(w, p.parent) = bulk_insert(m, p.lo, p.hi);
  }
  if (mid == p.hi) {
    deliver(m, w, p.parent);
    return;
  }
  uint32_t k = new_node(w, mid, p.parent);
  vec_push(&w->parts, ((Part){mid, p.hi, 2 * k + 1}));
  vec_push(&w->parts, ((Part){p.lo, mid, 2 * k}));
}

// L lies strictly below R along the axis. Seen with the axis to the right; with axis y that is a turn by a
// quarter.
static void start(Bulk *m, Node *d, BulkRise *rise)
{
  // Halves of a cell are separated by a line, along the axis on which their keys differ. Without branches,
  // which would be mispredicted.
  const BulkHull *p = &d->hull[0], *q = &d->hull[1];
  int x = p->at[1] < q->at[0], x_back = q->at[1] < p->at[0], y_back = q->at[3] < p->at[2];
  int axis = !(x | x_back), back = x_back | (axis & y_back);
  d->axis = (uint8_t)axis;
  d->right = (uint8_t)!back;
  const BulkHull *hull_l = &d->hull[back], *hull_r = &d->hull[!back];
  VertId l = hull_l->v[2 * axis + 1], r = hull_r->v[2 * axis];
  EdgeId below_l = hull_l->e[2 * axis + 1], hr = hull_r->e[2 * axis];
  tangent(m, &l, &below_l, &r, &hr);
  EdgeId hl = below_l == NONE ? NONE : bulk_hull_prev(m, below_l);
  EdgeId below_r = hr == NONE ? NONE : bulk_hull_prev(m, hr);
  d->low_r = r;
  d->hl = hl, d->hr = hr;
  TriId bottom = 2 * d->mid - 2;
  bulk_set(m, bottom, r, l, TRI_INF);
  m->twin[3 * bottom] = 3 * bottom;                               // for now
  if (below_l != NONE) bulk_link(m, 3 * bottom + 1, below_l + 2); // l -> inf, inf -> l
  if (below_r != NONE) bulk_link(m, 3 * bottom + 2, below_r + 1); // inf -> r, r -> inf
  *rise = (BulkRise){{l, r}, {hl, hr}, 3 * bottom, NONE};
}

bool bulk_next(Bulk *m, BulkRise *rise)
{
  struct BulkWork *w = m->work;
  while (w->ready.len == 0) {
    if (w->parts.len == 0) {
      m->waiting = false;
      return false;
    }
    Part p = vec_pop(&w->parts);
    advance(m, w, p);
  }
  uint32_t k = vec_pop(&w->ready);
  start(m, &w->nodes.data[k], rise);
  rise->node = k;
  return true;
}

void bulk_done(Bulk *m, const BulkRise *rise)
{
  struct BulkWork *w = m->work;
  Node *d = &w->nodes.data[rise->node];
  EdgeId hl = rise->h[0], hr = rise->h[1];
  bool new_l = hl == NONE || hl != d->hl, new_r = hr == NONE || hr != d->hr; // l itself may come round again
  VertId l = rise->v[0], r = rise->v[1];
  TriId bottom = 2 * d->mid - 2, top = bottom + 1;
  bulk_set(m, top, l, r, TRI_INF);
  bulk_link(m, 3 * top, rise->base);
  bulk_link(m, 3 * top + 2, hl != NONE ? hl + 1 : 3 * bottom + 1); // inf -> l, l -> inf
  bulk_link(m, 3 * top + 1, hr != NONE ? hr + 2 : 3 * bottom + 2); // r -> inf, inf -> r
  *place_of(w, d->parent) = unite(&d->hull[!d->right], &d->hull[d->right], d->axis, l, new_l ? 3 * top : NONE, d->low_r,
                                  new_r ? 3 * bottom : NONE);
  deliver(m, w, d->parent);
  vec_push(&w->unused, rise->node);
}

// ---- the whole ------------------------------------------------------------------------------------------------------

VertId bulk_split(const Bulk *m, VertId lo, VertId hi)
{
  const uint32_t *key = m->key;
  uint32_t differ = key[lo] ^ key[hi - 1];
  if (differ == 0) return hi;
  int bit = 31 - __builtin_clz(differ);
  uint32_t first = key[hi - 1] >> bit << bit; // of the upper half
  while (hi - lo > BULK_KEYS_BEYOND) {
    VertId mid = lo + (hi - lo) / 2;
    if (key[mid] >= first) hi = mid + 1;
    else lo = mid;
  }
  VertId v = lo; // count: quicker than to search, and what comes after hi does not count
  for (int i = 0; i < BULK_KEYS_BEYOND; i++) v += key[lo + (VertId)i] < first;
  return v;
}

BulkHull bulk_build(Bulk *m, VertId lo, VertId hi)
{
  vec_push(&m->work->parts, ((Part){lo, hi, NONE}));
  m->waiting = true;
  bulk_climb(m);
  return m->work->whole;
}

BulkHull bulk_merge(Bulk *m, VertId mid, const BulkHull *p, const BulkHull *q)
{
  struct BulkWork *w = m->work;
  uint32_t k = new_node(w, mid, NONE);
  w->nodes.data[k].hull[0] = *p;
  w->nodes.data[k].hull[1] = *q;
  vec_push(&w->ready, k);
  m->waiting = true;
  bulk_climb(m);
  return w->whole;
}

void bulk_begin(Bulk *m)
{
  bulk__begin_insert(m);
  m->work = mem_zalloc(sizeof *m->work);
}

void bulk_end(Bulk *m)
{
  struct BulkWork *w = m->work;
  vec_free(&w->nodes);
  vec_free(&w->unused);
  vec_free(&w->ready);
  vec_free(&w->parts);
  free(w);
  bulk__end_insert(m);
}
