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

// The lower common tangent of the hulls. *hl: the hull edge that leaves its vertex on the left; *hr: on the right.
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

// The hull of the union. l and r are the upper vertex on the left and the lower one on the right, where hull edges are new:
// hl and hr, or NONE.
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

// Merge left and right: L lies strictly below R along the axis. Seen with the axis to the right; with axis y that is a turn by
// a quarter.
static BulkHull merge(Bulk *m, VertId mid, const BulkHull *hull_l, const BulkHull *hull_r, int axis)
{
  VertId l = hull_l->v[2 * axis + 1], r = hull_r->v[2 * axis];
  EdgeId below_l = hull_l->e[2 * axis + 1], hr = hull_r->e[2 * axis];
  tangent(m, &l, &below_l, &r, &hr);
  EdgeId hl = below_l == NONE ? NONE : bulk_hull_prev(m, below_l);
  EdgeId below_r = hr == NONE ? NONE : bulk_hull_prev(m, hr);
  const VertId low_r = r;
  TriId bottom = 2 * mid - 2, top = bottom + 1;
  bulk_set(m, bottom, r, l, TRI_INF);
  m->twin[3 * bottom] = 3 * bottom;                               // for now
  if (below_l != NONE) bulk_link(m, 3 * bottom + 1, below_l + 2); // l -> inf, inf -> l
  if (below_r != NONE) bulk_link(m, 3 * bottom + 2, below_r + 1); // inf -> r, r -> inf
  BulkRise rise = {{l, r}, {hl, hr}, 3 * bottom};
  bulk_climb(m, &rise);
  bool new_l = hl == NONE || rise.h[0] != hl, new_r = hr == NONE || rise.h[1] != hr; // l itself may come round again
  l = rise.v[0], r = rise.v[1];
  hl = rise.h[0], hr = rise.h[1];
  bulk_set(m, top, l, r, TRI_INF);
  bulk_link(m, 3 * top, rise.base);
  bulk_link(m, 3 * top + 2, hl != NONE ? hl + 1 : 3 * bottom + 1); // inf -> l, l -> inf
  bulk_link(m, 3 * top + 1, hr != NONE ? hr + 2 : 3 * bottom + 2); // r -> inf, inf -> r
  return unite(hull_l, hull_r, axis, l, new_l ? 3 * top : NONE, low_r, new_r ? 3 * bottom : NONE);
}

BulkHull bulk_merge(Bulk *m, VertId mid, const BulkHull *p, const BulkHull *q)
{
  // Halves of a cell are separated by a line, along the axis on which their keys differ. Without branches, which would
  // be mispredicted.
  int x = p->at[1] < q->at[0], x_back = q->at[1] < p->at[0], y_back = q->at[3] < p->at[2];
  int axis = !(x | x_back), back = x_back | (axis & y_back);
  const BulkHull *of[2] = {p, q};
  return merge(m, mid, of[back], of[!back], axis);
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
  if (hi - lo <= 3) return bulk_base(m, lo, hi);
  VertId mid = m->incremental ? hi : bulk_split(m, lo, hi);
  if (mid == hi) return bulk_insert(m, lo, hi);
  BulkHull p = bulk_build(m, lo, mid), q = bulk_build(m, mid, hi);
  return bulk_merge(m, mid, &p, &q);
}
