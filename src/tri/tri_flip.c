// tri_flip.c - flips, the flip algorithm, splits, moves and collapses
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_int.h"

static int orient(Tri *m, VertId a, VertId b, VertId c)
{
  return orient2d_count(tri_xy(m, a), tri_xy(m, b), tri_xy(m, c), &m->count);
}

bool tri_can_flip(Tri *m, EdgeId e)
{
  EdgeId g = m->twin[e];
  if (tri_is_segment(m, e) || tri_is_ghost(m, tri_of(e)) || tri_is_ghost(m, tri_of(g))) return false;
  VertId a = m->vert[e], b = m->vert[g], c = tri_apex(m, e), d = tri_apex(m, g);
  return orient(m, d, c, a) > 0 && orient(m, d, c, b) < 0;
}

//        c                 c
//      /   \             / | \      .
//     a --e- b    ->    a  ^  b     e runs d -> c
//      \ g /             \ | /
//        d                 d
void tri_flip(Tri *m, EdgeId e)
{
  EdgeId g = m->twin[e], en = tri_next(e), ep = tri_prev(e), gn = tri_next(g), gp = tri_prev(g);
  VertId a = m->vert[e], b = m->vert[g], c = m->vert[ep], d = m->vert[gp];
  EdgeId ca = m->twin[ep], db = m->twin[gp];
  DCHECK(ca != gp && db != ep); // not so between two finite triangles
  uint32_t seg_ca = tri_segment(m, ep), seg_db = tri_segment(m, gp), seg_bc = tri_segment(m, en),
           seg_ad = tri_segment(m, gn);
  // The new triangles: (e: d -> c, en: c -> a, ep: a -> d) and (g: c -> d, gn: d -> b, gp: b -> c).
  EdgeId bc = m->twin[en], ad = m->twin[gn];
  m->vert[e] = d;
  m->vert[en] = c;
  m->vert[ep] = a;
  m->vert[g] = c;
  m->vert[gn] = d;
  m->vert[gp] = b;
  tri__link(m, en, ca);
  tri__link(m, ep, ad);
  tri__link(m, gn, db);
  tri__link(m, gp, bc);
  TriId t = tri_of(e), u = tri_of(g);
  m->flag[t] &= TRI_OUTSIDE_FLAG;
  m->flag[u] &= TRI_OUTSIDE_FLAG;
  if (seg_ca != NONE) tri__set_segment(m, en, seg_ca);
  if (seg_ad != NONE) tri__set_segment(m, ep, seg_ad);
  if (seg_db != NONE) tri__set_segment(m, gn, seg_db);
  if (seg_bc != NONE) tri__set_segment(m, gp, seg_bc);
  if (m->hint) {
    m->hint[d] = e;
    m->hint[c] = en;
    m->hint[a] = ep;
    m->hint[b] = gp;
  }
}

bool tri_is_delaunay(Tri *m, EdgeId e)
{
  EdgeId g = m->twin[e];
  if (tri_is_segment(m, e)) return true;
  VertId a = m->vert[e], b = m->vert[g], c = tri_apex(m, e), d = tri_apex(m, g);
  if (a == TRI_INF || b == TRI_INF || c == TRI_INF || d == TRI_INF) return true;
  return incircle_perturbed(tri_xy(m, a), tri_xy(m, b), tri_xy(m, c), tri_xy(m, d), &m->count) < 0;
}

uint64_t tri_legalize(Tri *m, U32Vec *work)
{
  uint64_t flips = 0;
  while (work->len) {
    EdgeId e = vec_pop(work);
    if (tri_is_delaunay(m, e) || !tri_can_flip(m, e)) continue;
    EdgeId g = m->twin[e];
    tri_flip(m, e);
    flips++;
    vec_push(work, tri_next(e));
    vec_push(work, tri_prev(e));
    vec_push(work, tri_next(g));
    vec_push(work, tri_prev(g));
  }
  return flips;
}

uint64_t tri_legalize_all(Tri *m)
{
  U32Vec work = {0};
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (!tri_is_free(m, tri_of(e)) && e < m->twin[e]) vec_push(&work, e);
  uint64_t flips = tri_legalize(m, &work);
  vec_free(&work);
  return flips;
}

// A cavity of exactly these triangles, for splits without a circle in sight.
VertId tri_split_edge(Tri *m, const double p[2], EdgeId e)
{
  EdgeId g = m->twin[e];
  EdgeId outer[4] = {m->twin[tri_next(e)], m->twin[tri_prev(e)], m->twin[tri_next(g)], m->twin[tri_prev(g)]};
  bool ghost = tri_is_ghost(m, tri_of(e)) || tri_is_ghost(m, tri_of(g));
  if (ghost && orient2d_count(tri_xy(m, m->vert[e]), tri_xy(m, m->vert[g]), p, &m->count) != 0) return NONE;
  for (int i = 0; i < 4; i++) {
    VertId a = tri_dest(m, outer[i]), b = m->vert[outer[i]];
    if (a != TRI_INF && b != TRI_INF && orient2d_count(tri_xy(m, a), tri_xy(m, b), p, &m->count) <= 0) return NONE;
  }
  TriCavity c = {.p = {p[0], p[1]}, .seg = tri_segment(m, e), .split = 2, .tri_split = 1};
  vec_push(&c.tri, tri_of(e));
  vec_push(&c.tri, tri_of(g));
  for (int i = 0; i < 4; i++) vec_push(&c.rim, outer[i]);
  VertId v = tri_commit(m, &c);
  tri_cavity_free(&c);
  return v;
}

VertId tri_split_face(Tri *m, const double p[2], TriId t)
{
  TriCavity c = {.p = {p[0], p[1]}, .seg = NONE};
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++)
    if (orient2d_count(tri_xy(m, m->vert[e]), tri_xy(m, tri_dest(m, e)), p, &m->count) <= 0) return NONE;
  vec_push(&c.tri, t);
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) vec_push(&c.rim, m->twin[e]);
  VertId v = tri_commit(m, &c);
  tri_cavity_free(&c);
  return v;
}

bool tri_can_move(Tri *m, VertId v, const double p[2])
{
  EdgeId first = tri_edge_at(m, v), e = first;
  if (e == NONE) return false;
  do {
    VertId a = tri_dest(m, e), b = tri_apex(m, e);
    if (a == TRI_INF || b == TRI_INF) return false; // hull vertices stay, or the hull would not be convex
    if (orient2d_count(tri_xy(m, a), tri_xy(m, b), p, &m->count) <= 0) return false;
    e = tri_ccw(m, e);
  } while (e != first);
  return true;
}

bool tri_move(Tri *m, VertId v, const double p[2])
{
  if (!tri_can_move(m, v, p)) return false;
  m->xy[2 * (size_t)v] = p[0];
  m->xy[2 * (size_t)v + 1] = p[1];
  return true;
}

// Do the ends of e have common neighbours other than the two apexes?
static bool shares_more(const Tri *m, EdgeId e)
{
  VertId b = tri_dest(m, e), c = tri_apex(m, e), d = tri_apex(m, m->twin[e]);
  for (EdgeId f = tri_ccw(m, e); f != e; f = tri_ccw(m, f)) {
    VertId x = tri_dest(m, f);
    if (x != c && x != d && x != TRI_INF && tri_find_edge(m, x, b) != NONE) return true;
  }
  return false;
}

bool tri_can_collapse(Tri *m, EdgeId e)
{
  VertId a = m->vert[e], b = tri_dest(m, e);
  if (a == TRI_INF || b == TRI_INF) return false;
  int segments = 0;
  EdgeId f = e;
  do {
    if (tri_dest(m, f) == TRI_INF) return false;
    segments += tri_is_segment(m, f);
    f = tri_ccw(m, f);
  } while (f != e);
  if (segments != 0 && !(segments == 2 && tri_is_segment(m, e))) return false;
  // A segment may not become the twin side of another: the apex edges that merge must not both be segments.
  EdgeId g = m->twin[e];
  if (tri_is_segment(m, tri_next(e)) && tri_is_segment(m, tri_prev(e))) return false;
  if (tri_is_segment(m, tri_next(g)) && tri_is_segment(m, tri_prev(g))) return false;
  const double *p = tri_xy(m, b);
  for (f = tri_ccw(m, e); tri_of(f) != tri_of(g); f = tri_ccw(m, f))
    if (orient2d_count(tri_xy(m, tri_dest(m, f)), tri_xy(m, tri_apex(m, f)), p, &m->count) <= 0) return false;
  return !shares_more(m, e);
}

// Triangle of h disappears: its two other sides x and y become one edge.
static void zip(Tri *m, EdgeId h)
{
  EdgeId x = tri_next(h), y = tri_prev(h), fx = m->twin[x], fy = m->twin[y];
  uint32_t id = tri_segment(m, x) != NONE ? tri_segment(m, x) : tri_segment(m, y);
  tri__link(m, fx, fy);
  if (id != NONE) {
    tri__set_segment(m, fx, id);
    tri__set_segment(m, fy, id);
  }
  if (m->hint) m->hint[m->vert[y]] = fx;
}

void tri_collapse(Tri *m, EdgeId e)
{
  EdgeId g = m->twin[e];
  VertId a = m->vert[e], b = tri_dest(m, e);
  EdgeId keep = m->twin[tri_next(e)]; // c -> b; its next leaves b
  for (EdgeId f = tri_ccw(m, e); f != e; f = tri_ccw(m, f))
    if (f != tri_next(g)) m->vert[f] = b;
  zip(m, e);
  zip(m, g);
  if (m->hint) {
    m->hint[b] = tri_next(keep);
    m->hint[a] = NONE;
  }
  m->last = keep;
  tri__release(m, tri_of(e));
  tri__release(m, tri_of(g));
}
