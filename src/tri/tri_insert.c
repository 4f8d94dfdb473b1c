// tri_insert.c - cavities and balls: insertion into a (constrained) Delaunay triangulation
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_int.h"

// p on the line of ab: strictly between them?
static bool between(const double *a, const double *b, const double *p)
{
  return lex_compare(a, b) < 0 ? lex_compare(a, p) < 0 && lex_compare(p, b) < 0
                               : lex_compare(b, p) < 0 && lex_compare(p, a) < 0;
}

// Is p in the circle of the ghost on the hull edge a -> b (outside on its left)?
static bool ghost_conflict(Tri *m, VertId a, VertId b, const double *p)
{
  int s = orient2d_count(tri_xy(m, a), tri_xy(m, b), p, &m->count);
  return s ? s > 0 : between(tri_xy(m, a), tri_xy(m, b), p);
}

static bool conflict(Tri *m, VertId a, VertId b, VertId c, const double *p)
{
  if (UNLIKELY(tri__ghost3(a, b, c)))
    return a == TRI_INF ? ghost_conflict(m, b, c, p) : b == TRI_INF ? ghost_conflict(m, c, a, p)
                                                                    : ghost_conflict(m, a, b, p);
  return incircle_perturbed(tri_xy(m, a), tri_xy(m, b), tri_xy(m, c), p, &m->count) > 0;
}

bool tri__conflict(Tri *m, VertId a, VertId b, VertId c, VertId d)
{
  return d != TRI_INF && conflict(m, a, b, c, tri_xy(m, d));
}

bool tri__conflict_point(Tri *m, TriId t, const double p[2])
{
  const uint32_t *v = m->vert + 3 * (size_t)t;
  return conflict(m, v[0], v[1], v[2], p);
}

void tri_cavity_free(TriCavity *c)
{
  vec_free(&c->tri);
  vec_free(&c->rim);
  vec_free(&c->stack);
}

static void begin(TriCavity *c, const double p[2])
{
  c->p[0] = p[0];
  c->p[1] = p[1];
  c->seg = NONE;
  c->split = c->tri_split = 0;
  vec_clear(&c->tri);
  vec_clear(&c->rim);
  vec_clear(&c->stack);
}

// Depth first from the half-edges on the stack. The cavity is a tree of triangles (it has no vertex inside), and its sides
// are met in counterclockwise order. False if it is none, which cannot be in a constrained Delaunay triangulation.
static bool grow(Tri *m, TriCavity *c)
{
  while (c->stack.len) {
    EdgeId h = vec_pop(&c->stack), g = m->twin[h];
    TriId t = tri_of(g);
    if (!tri_is_segment(m, h) && tri__conflict_point(m, t, c->p)) {
      if (c->tri.len > m->nt) return false;
      vec_push(&c->tri, t);
      vec_push(&c->stack, tri_prev(g));
      vec_push(&c->stack, tri_next(g));
    } else vec_push(&c->rim, g);
  }
  return true;
}

// Does p see side k of the cavity? Sides to infinity are seen by construction.
static bool sees(Tri *m, const TriCavity *c, size_t k)
{
  VertId a = tri_dest(m, c->rim.data[k]), b = tri_org(m, c->rim.data[k]);
  return a == TRI_INF || b == TRI_INF || orient2d_count(tri_xy(m, a), tri_xy(m, b), c->p, &m->count) > 0;
}

static bool is_star(Tri *m, const TriCavity *c)
{
  for (size_t k = 0; k < c->rim.len; k++)
    if (!sees(m, c, k)) return false;
  return c->rim.len == c->tri.len + 2;
}

TriInsert tri_cavity(Tri *m, TriCavity *c, const double p[2], TriLoc loc, EdgeId e)
{
  if (loc == TRI_ON_VERTEX) return TRI_DUPLICATE;
  if (loc == TRI_ON_EDGE && tri_is_segment(m, e)) return TRI_ON_SEGMENT;
  begin(c, p);
  vec_push(&c->tri, tri_of(e));
  vec_push(&c->stack, tri_prev(e));
  vec_push(&c->stack, tri_next(e));
  vec_push(&c->stack, e);
  if (!grow(m, c)) return TRI_BLOCKED;
  DCHECK(is_star(m, c));
  return TRI_INSERTED;
}

// The sides of the triangle of h but h itself, onto the stack.
static bool grow_beside(Tri *m, TriCavity *c, EdgeId h)
{
  vec_push(&c->tri, tri_of(h));
  vec_push(&c->stack, tri_prev(h));
  vec_push(&c->stack, tri_next(h));
  return grow(m, c);
}

TriInsert tri_cavity_split(Tri *m, TriCavity *c, const double p[2], EdgeId e)
{
  const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
  if (lex_compare(a, p) == 0 || lex_compare(b, p) == 0) return TRI_DUPLICATE;
  if (!tri_is_segment(m, e)) { // nothing is to be kept: a point like any other
    TriLoc loc = tri_locate(m, p, e, &e);
    return tri_cavity(m, c, p, loc, e);
  }
  int side = orient2d_count(a, b, p, &m->count);
  if (side < 0) e = m->twin[e];
  if (side != 0 && !tri__conflict_point(m, tri_of(e), p)) return TRI_BLOCKED;
  begin(c, p);
  c->seg = tri_segment(m, e);
  if (side != 0 && !tri__conflict_point(m, tri_of(m->twin[e]), p)) {
    // Left of e by a rounding error, and the triangle beyond (a ghost, or very flat) is as Delaunay as before: the edge
    // stays, and a sliver beyond the new pieces fills the gap.
    c->split = NONE;
    vec_push(&c->rim, m->twin[e]);
    if (!grow_beside(m, c, e)) return TRI_BLOCKED;
    c->tri_split = (uint32_t)c->tri.len;
  } else {
    if (!grow_beside(m, c, e)) return TRI_BLOCKED;
    c->split = (uint32_t)c->rim.len;
    c->tri_split = (uint32_t)c->tri.len;
    if (!grow_beside(m, c, m->twin[e])) return TRI_BLOCKED;
  }
  return is_star(m, c) ? TRI_INSERTED : TRI_BLOCKED;
}

// The new triangles of one side of a cavity inherit from it.
TriSide tri__side_of(const Tri *m, const uint32_t *t, size_t n)
{
  TriSide s = {0, 0, 0};
  bool finite = false, ghost = false;
  for (size_t i = 0; i < n && !(finite && ghost); i++) {
    uint8_t f = m->flag[t[i]] & TRI_OUTSIDE_FLAG;
    if (tri_is_ghost(m, t[i])) {
      if (!ghost) s.ghost = f;
      ghost = true;
    } else {
      if (!finite) {
        s.finite = f;
        s.region = m->region ? m->region[t[i]] : 0;
      }
      finite = true;
    }
  }
  if (!finite) s.finite = s.ghost;
  return s;
}

// Triangle t = (a, b, v) on the outer half-edge g.
static void set_triangle(Tri *m, TriId t, EdgeId g, VertId v, const TriSide *side)
{
  size_t e = 3 * (size_t)t;
  VertId a = tri_dest(m, g), b = m->vert[g];
  m->vert[e] = a;
  m->vert[e + 1] = b;
  m->vert[e + 2] = v;
  tri__link(m, (EdgeId)e, g);
  m->flag[t] = tri__ghost3(a, b, v) ? side->ghost : side->finite;
  if (tri_is_segment(m, g)) tri__set_segment(m, (EdgeId)e, m->seg[g]);
  if (m->region) m->region[t] = side->region;
  if (m->hint && a != TRI_INF) m->hint[a] = (EdgeId)e;
}

// The half-edge p -> a of the new triangle on rim[k], and its twin, become a part of segment c->seg.
static void mark_spoke(Tri *m, const TriCavity *c, EdgeId e)
{
  if (c->seg == NONE) return;
  tri__set_segment(m, e, c->seg);
  tri__set_segment(m, m->twin[e], c->seg);
}

#if CHECK_LEVEL >= 3
// The stress build validates the whole triangulation after each change while it is small, then after every thousandth.
static void validate(const Tri *m)
{
  TriCheck bad;
  if ((m->nt <= 2000 || m->nv % 1000 == 0) && tri_check(m, TRI_CHECK_LINKS | TRI_CHECK_ORIENT | TRI_CHECK_EULER, &bad))
    CHECK(bad.rule != TRI_CHECK_LINKS && bad.rule != TRI_CHECK_ORIENT && bad.rule != TRI_CHECK_EULER);
}
#else
static void validate(const Tri *m) { (void)m; }
#endif

VertId tri_commit(Tri *m, TriCavity *c)
{
  size_t n = c->rim.len, old = c->tri.len;
  CHECK(n == old + 2);
  TriSide side[2] = {{0, 0, 0}, {0, 0, 0}};
  side[0] = side[1] = tri__side_of(m, c->tri.data, c->tri_split ? c->tri_split : old);
  bool sliver = c->tri_split && c->split == NONE;
  if (sliver) { // rim[0] is beyond the edge, the rest on this side
    TriId beyond = tri_of(c->rim.data[0]);
    side[0] = tri__side_of(m, &beyond, 1);
  } else if (c->tri_split) side[1] = tri__side_of(m, c->tri.data + c->tri_split, old - c->tri_split);
  size_t border = sliver ? 1 : c->tri_split ? c->split : n;
  VertId v = tri__new_vertex(m, c->p);
  vec_push(&c->tri, tri__new(m));
  vec_push(&c->tri, tri__new(m));
  const uint32_t *t = c->tri.data;
  if (sliver) tri__clear_segment(m, c->rim.data[0]);
  for (size_t k = 0; k < n; k++) set_triangle(m, t[k], c->rim.data[k], v, &side[k >= border]);
  for (size_t k = 0; k < n; k++) tri__link(m, 3 * t[k] + 1, 3 * t[k + 1 < n ? k + 1 : 0] + 2);
  if (c->tri_split) { // p -> start of rim[0], and to the other end
    mark_spoke(m, c, 3 * t[0] + 2);
    mark_spoke(m, c, sliver ? 3 * t[0] + 1 : 3 * t[c->split] + 2);
  }
  if (m->hint) m->hint[v] = 3 * t[0] + 2;
  m->last = 3 * t[n - 1];
  validate(m);
  return v;
}

// A point for a triangulation that has no triangle yet: build it anew with the point in it.
static TriInsert insert_low(Tri *m, const double p[2], VertId *v)
{
  for (VertId u = 0; u < m->nv; u++)
    if (lex_compare(tri_xy(m, u), p) == 0) {
      *v = u;
      return TRI_DUPLICATE;
    }
  size_t n = (size_t)m->nv + 1;
  double *xy = mem_alloc(2 * n * sizeof *xy);
  if (n > 1) memcpy(xy, m->xy, 2 * (n - 1) * sizeof *xy);
  xy[2 * n - 2] = p[0];
  xy[2 * n - 1] = p[1];
  bool hints = m->hint != NULL;
  tri_free(m);
  TriBuild how = {.take = true, .threads = 1};
  CHECK(tri_build(m, xy, n, &how) == TRI_BUILD_GOOD);
  if (hints) tri_make_hints(m);
  *v = (VertId)n - 1;
  return TRI_INSERTED;
}

TriInsert tri_insert(Tri *m, TriCavity *c, const double p[2], EdgeId start, VertId *v)
{
  if (m->dim != 2) return insert_low(m, p, v);
  EdgeId e;
  TriLoc loc = tri_locate(m, p, start, &e);
  TriInsert r = tri_cavity(m, c, p, loc, e);
  if (r == TRI_INSERTED) *v = tri_commit(m, c);
  else if (r == TRI_DUPLICATE) *v = tri_org(m, e);
  return r;
}

TriInsert tri_split_segment(Tri *m, TriCavity *c, const double p[2], EdgeId e, VertId *v)
{
  TriInsert r = tri_cavity_split(m, c, p, e);
  if (r == TRI_INSERTED) *v = tri_commit(m, c);
  return r;
}
