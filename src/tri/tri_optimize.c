// tri_optimize.c - optimization: flips by quality, valence repair, repositioning
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/refine_int.h"

// A star is worth a visit if one of its triangles has 1/kappa_4^2 above this: a lattice is left alone.
#define GOOD 1.005

typedef struct {
  double sum, worst; // of 1/kappa_4^2
} Worth;

// Sum and largest over the triangles about four vertices.
static Worth patch_worth(const Tri *m, const VertId *q)
{
  Worth w = {0, 0};
  for (int k = 0; k < 4; k++) {
    EdgeId first = m->hint[q[k]], e = first;
    do {
      VertId b = tri_dest(m, e), c = tri_apex(m, e);
      bool seen = false;
      for (int i = 0; i < k; i++) seen |= b == q[i] || c == q[i];
      if (!seen && tri_is_inside(m, tri_of(e))) {
        double x = metric_quality(tri_xy(m, q[k]), tri_xy(m, b), tri_xy(m, c));
        double f = x > 0 ? 1 / x : INFINITY;
        w.sum += f;
        w.worst = f > w.worst ? f : w.worst;
      }
      e = tri_ccw(m, e);
    } while (e != first);
  }
  return w;
}

static void flip(Refiner *r, EdgeId e)
{
  Tri *m = r->m;
  r->excess[tri_org(m, e)]--, r->excess[tri_dest(m, e)]--;
  r->excess[tri_apex(m, e)]++, r->excess[tri_apex(m, m->twin[e])]++;
  tri_flip(m, e);
}

// An edge inside the domain, named once.
static inline bool flippable(const Tri *m, EdgeId e)
{
  return m->twin[e] > e && !(m->flag[tri_of(e)] & (TRI_OUTSIDE_FLAG | TRI_FREE)) && !tri_is_segment(m, e);
}

// Flip e if that brings the valences of its four vertices nearer to what they should be and, after repositioning them, the
// triangles around are better.
static bool repair_by_flip(Refiner *r, EdgeId e)
{
  Tri *m = r->m;
  VertId q[4] = {tri_org(m, e), tri_dest(m, e), tri_apex(m, e), tri_apex(m, m->twin[e])};
  if (!tri_can_flip(m, e)) return false;
  Worth before = patch_worth(m, q);
  double xy[8], size[4];
  for (int k = 0; k < 4; k++) {
    xy[2 * k] = m->xy[2 * (size_t)q[k]], xy[2 * k + 1] = m->xy[2 * (size_t)q[k] + 1];
    size[k] = r->size[q[k]];
  }
  size_t moves = r->stats->moves;
  double floor = r->floor;
  flip(r, e);
  r->floor = INFINITY; // the flip may have made them bad at first
  for (int pass = 0; pass < 3; pass++)
    for (int k = 0; k < 4; k++)
      if (!r->fixed[q[k]]) refine__relocate(r, q[k]);
  r->floor = floor;
  Worth after = patch_worth(m, q);
  if (after.sum < before.sum && after.worst <= (before.worst > floor ? before.worst : floor)) {
    r->stats->flips++;
    return true;
  }
  for (int k = 0; k < 4; k++) {
    m->xy[2 * (size_t)q[k]] = xy[2 * k], m->xy[2 * (size_t)q[k] + 1] = xy[2 * k + 1];
    r->size[q[k]] = size[k];
  }
  r->stats->moves = moves;
  flip(r, e);
  return false;
}

size_t refine__flips(Refiner *r)
{
  Tri *m = r->m;
  size_t n = 0;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    if (!flippable(m, e)) continue;
    EdgeId o = m->twin[e];
    if (!(r->awake[tri_org(m, e)] | r->awake[tri_dest(m, e)])) continue;
    const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
    const double *c = tri_xy(m, tri_apex(m, e)), *d = tri_xy(m, tri_apex(m, o));
    if (incircle(a, b, c, d) <= 0) continue;
    double q = metric_quality(a, b, c), s = metric_quality(b, a, d), worse = q < s ? q : s;
    if (metric_quality(c, d, b) <= worse + 1e-6 || metric_quality(d, c, a) <= worse + 1e-6) continue;
    if (!tri_can_flip(m, e)) continue;
    flip(r, e);
    n++;
  }
  r->stats->flips += n;
  return n;
}

static size_t repair_valences(Refiner *r)
{
  Tri *m = r->m;
  size_t n = 0;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    if (!flippable(m, e)) continue;
    int a = r->excess[tri_org(m, e)], b = r->excess[tri_dest(m, e)];
    if (a + b < 1) continue; // the apexes have at least -1 each but where a triangle is very bad
    int c = r->excess[tri_apex(m, e)], d = r->excess[tri_apex(m, m->twin[e])];
    if (a + b - c - d >= 3) n += repair_by_flip(r, e);
  }
  return n;
}

// Edges at a vertex more than six; of vertices on segments, whose angles decide, nothing is known.
static void count_excess(Refiner *r)
{
  const Tri *m = r->m;
  r->excess = mem_alloc(r->cap_v * sizeof *r->excess);
  for (VertId v = 0; v < m->nv; v++) r->excess[v] = -6;
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (tri_is_inside(m, tri_of(e)) && r->excess[m->vert[e]] < 10000) r->excess[m->vert[e]]++;
  for (VertId v = 0; v < m->nv; v++)
    if (r->fixed[v]) r->excess[v] = 0;
}

void refine__prepare(Refiner *r, VertId given)
{
  Tri *m = r->m;
  tri_make_hints(m);
  free(r->fixed), free(r->awake), free(r->excess);
  r->fixed = mem_zalloc(r->cap_v * sizeof *r->fixed);
  r->awake = mem_zalloc(r->cap_v * sizeof *r->awake);
  double worst = 1;
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    double q = metric_quality(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]));
    if (q * GOOD < 1) r->awake[v[0]] = r->awake[v[1]] = r->awake[v[2]] = 1;
    if (q < worst) worst = q;
    for (EdgeId e = 3 * t; e < 3 * t + 3; e++)
      if (tri_is_segment(m, e)) r->fixed[tri_org(m, e)] = r->fixed[tri_dest(m, e)] = true;
  }
  for (VertId v = 0; v < m->nv; v++)
    if (v < given || m->hint[v] == NONE) r->fixed[v] = true;
  // A triangle may get worse while its star gets better, down to 0.9, but none below the worst of all.
  r->floor = worst < 0.9 ? 1 / 0.9 : 1 / worst;
  count_excess(r);
}

void refine__optimize(Refiner *r, int level)
{
  if (level <= 0) return;
  int rounds = level == 1 ? 2 : 8;
  for (int k = 0; k < rounds; k++) {
    size_t flips = refine__flips(r) + repair_valences(r);
    size_t moves = r->stats->moves;
    refine__smooth(r, 1);
    if (flips == 0 && r->stats->moves == moves) break;
  }
}
