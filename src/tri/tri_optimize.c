// tri_optimize.c - optimization: flips by quality, valence repair, repositioning
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/refine_int.h"

enum { MAX_PATCH = 256 };

// Edges at v more than the ideal six (at an interior vertex) or than its angle calls for (at one on segments).
static int excess(const Refiner *r, VertId v) { return (int)r->degree[v] - 6; }

typedef struct {
  double sum, worst;
} Worth;

// Sum and largest of 1/kappa_4^2 over the triangles about the four vertices.
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
        w.worst = fmax(w.worst, f);
      }
      e = tri_ccw(m, e);
    } while (e != first);
  }
  return w;
}

static void flip(Refiner *r, EdgeId e)
{
  Tri *m = r->m;
  r->degree[tri_org(m, e)]--, r->degree[tri_dest(m, e)]--;
  r->degree[tri_apex(m, e)]++, r->degree[tri_apex(m, m->twin[e])]++;
  tri_flip(m, e);
}

// Flip e if that brings the valences of its four vertices nearer to six and, after repositioning them, is better.
static bool repair_by_flip(Refiner *r, EdgeId e)
{
  Tri *m = r->m;
  EdgeId o = m->twin[e];
  VertId q[4] = {tri_org(m, e), tri_dest(m, e), tri_apex(m, e), tri_apex(m, o)};
  if (excess(r, q[0]) + excess(r, q[1]) - excess(r, q[2]) - excess(r, q[3]) < 3) return false;
  if (!tri_can_flip(m, e)) return false;
  Worth before = patch_worth(m, q);
  double xy[8], size[4];
  for (int k = 0; k < 4; k++) {
    xy[2 * k] = m->xy[2 * (size_t)q[k]], xy[2 * k + 1] = m->xy[2 * (size_t)q[k] + 1];
    size[k] = r->size[q[k]];
  }
  uint64_t moves = r->stats->moves;
  flip(r, e);
  double floor = r->floor;
  r->floor = INFINITY; // the flip may have made it bad at first
  for (int pass = 0; pass < 3; pass++)
    for (int k = 0; k < 4; k++)
      if (!r->fixed[q[k]]) refine__relocate(r, q[k]);
  r->floor = floor;
  Worth after = patch_worth(m, q);
  if (after.sum < before.sum && after.worst <= fmax(before.worst, r->floor)) {
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

static size_t quality_flips(Refiner *r)
{
  Tri *m = r->m;
  size_t n = 0;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    EdgeId o = m->twin[e];
    if (o < e || (m->flag[tri_of(e)] & (TRI_OUTSIDE_FLAG | TRI_FREE)) || tri_is_segment(m, e)) continue;
    const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
    const double *c = tri_xy(m, tri_apex(m, e)), *d = tri_xy(m, tri_apex(m, o));
    if (incircle(a, b, c, d) <= 0) continue;
    double q = fmin(metric_quality(a, b, c), metric_quality(b, a, d));
    if (fmin(metric_quality(c, d, b), metric_quality(d, c, a)) <= q + 1e-6) continue;
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
    if (m->twin[e] < e || (m->flag[tri_of(e)] & (TRI_OUTSIDE_FLAG | TRI_FREE)) || tri_is_segment(m, e)) continue;
    n += repair_by_flip(r, e);
  }
  return n;
}

static void count_degrees(Refiner *r)
{
  const Tri *m = r->m;
  r->degree = mem_zalloc(m->nv * sizeof *r->degree);
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (tri_is_inside(m, tri_of(e)) && r->degree[m->vert[e]] < 60000) r->degree[m->vert[e]]++;
  // a vertex on the boundary: as if it were inside a mesh that goes on
  for (VertId v = 0; v < m->nv; v++) if (r->fixed[v]) r->degree[v] = 6;
}

void refine__optimize(Refiner *r, int level)
{
  count_degrees(r);
  for (int k = 0; k < level; k++) {
    quality_flips(r);
    refine__smooth(r, 1);
    if (getenv("VR")) fprintf(stderr, "repaired %zu\n", repair_valences(r));
  }
}
