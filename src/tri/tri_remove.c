// tri_remove.c - removal of a vertex
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_int.h"

// A corner of the hole: its vertex, and the outer half-edge of the side to the next corner.
typedef struct {
  VertId v;
  EdgeId outer;
} Corner;
typedef Vec(Corner) Corners;

static int turn(Tri *m, VertId a, VertId b, VertId c)
{
  return orient2d_count(tri_xy(m, a), tri_xy(m, b), tri_xy(m, c), &m->count);
}

// May corner i be cut off: a left turn, and no other corner in the closed triangle?
static bool is_ear(Tri *m, const Corners *h, size_t i)
{
  size_t n = h->len;
  VertId a = h->data[(i + n - 1) % n].v, b = h->data[i].v, c = h->data[(i + 1) % n].v;
  if (a == TRI_INF || b == TRI_INF || c == TRI_INF || turn(m, a, b, c) <= 0) return false;
  for (size_t k = 0; k < n; k++) {
    VertId d = h->data[k].v;
    if (d == a || d == b || d == c || d == TRI_INF) continue;
    if (turn(m, a, b, d) >= 0 && turn(m, b, c, d) >= 0 && turn(m, c, a, d) >= 0) return false;
  }
  return true;
}

// Triangle t on the sides of corners i and j = i + 1, then corner j goes and corner i gets the third side.
static void cut(Tri *m, Corners *h, size_t i, TriId t, const TriSide *side)
{
  size_t n = h->len, j = (i + 1) % n, k = (i + 2) % n;
  VertId v[3] = {h->data[i].v, h->data[j].v, h->data[k].v};
  EdgeId out[2] = {h->data[i].outer, h->data[j].outer}, e = 3 * t;
  bool ghost = tri__ghost3(v[0], v[1], v[2]);
  m->flag[t] = ghost ? side->ghost : side->finite;
  if (m->region) m->region[t] = ghost ? 0 : side->region;
  for (uint32_t s = 0; s < 3; s++) {
    m->vert[e + s] = v[s];
    if (m->hint && v[s] != TRI_INF) m->hint[v[s]] = e + s;
  }
  for (uint32_t s = 0; s < 2; s++) {
    tri__link(m, e + s, out[s]);
    if (tri_is_segment(m, out[s])) tri__set_segment(m, e + s, m->seg[out[s]]);
  }
  h->data[i].outer = e + 2;
  memmove(h->data + j, h->data + j + 1, (n - 1 - j) * sizeof *h->data);
  h->len--;
}

// The sides of the hole that v leaves, counterclockwise, and its triangles. False if v may not go.
static bool open_hole(const Tri *m, VertId v, Corners *hole, U32Vec *tris)
{
  EdgeId first = m->hint[v], e = first;
  bool hull = false, line = true; // only a line remains
  if (e == NONE) return false;
  do {
    VertId a = tri_dest(m, e), b = tri_apex(m, e);
    if (tri_is_segment(m, e)) return false;
    EdgeId out = m->twin[tri_next(e)];
    vec_push(hole, ((Corner){a, out}));
    vec_push(tris, tri_of(e));
    if (a == TRI_INF) hull = true;
    if (a != TRI_INF && b != TRI_INF && !tri_is_ghost(m, tri_of(out))) line = false;
    e = tri_ccw(m, e);
  } while (e != first);
  return !(hull && line);
}

static void fill_hole(Tri *m, Corners *hole, const U32Vec *tris, const TriSide *side)
{
  size_t used = 0;
  for (bool any = true; any && hole->len > 3;) {
    any = false;
    for (size_t j = 0; j < hole->len && hole->len > 3; j++)
      if (is_ear(m, hole, j)) {
        cut(m, hole, (j + hole->len - 1) % hole->len, tris->data[used++], side);
        any = true;
      }
  }
  while (hole->len > 3) { // what is left is convex toward the outside: a fan at infinity
    size_t i = 0;
    while (hole->data[i].v != TRI_INF) i++;
    cut(m, hole, i, tris->data[used++], side);
  }
  TriId t = tris->data[used++];
  EdgeId last = hole->data[2].outer;
  cut(m, hole, 0, t, side);
  tri__link(m, 3 * t + 2, last);
  if (tri_is_segment(m, last)) tri__set_segment(m, 3 * t + 2, m->seg[last]);
  for (; used < tris->len; used++) tri__release(m, tris->data[used]);
}

bool tri_remove(Tri *m, VertId v)
{
  Corners hole = {0};
  U32Vec tris = {0}, work = {0};
  bool good = open_hole(m, v, &hole, &tris);
  if (good) {
    TriSide side = tri__side_of(m, tris.data, tris.len);
    fill_hole(m, &hole, &tris, &side);
    m->hint[v] = NONE;
    for (size_t i = 0; i + 2 < tris.len; i++)
      for (EdgeId e = 3 * tris.data[i]; e < 3 * tris.data[i] + 3; e++) vec_push(&work, e);
    tri_legalize(m, &work);
    m->last = 3 * tris.data[0];
  }
  vec_free(&hole);
  vec_free(&tris);
  vec_free(&work);
  return good;
}
