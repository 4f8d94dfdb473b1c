// tri_optimize.c - flips and valence repair
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/refine_int.h"

static void quality_flips(Refiner *r)
{
  Tri *m = r->m;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    EdgeId o = m->twin[e];
    if (o < e || tri_is_segment(m, e) || (m->flag[tri_of(e)] & (TRI_OUTSIDE_FLAG | TRI_FREE))) continue;
    const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
    const double *c = tri_xy(m, tri_apex(m, e)), *d = tri_xy(m, tri_apex(m, o));
    if (incircle(a, b, c, d) <= 0) continue;
    double q = fmin(metric_quality(a, b, c), metric_quality(b, a, d));
    if (fmin(metric_quality(c, d, b), metric_quality(d, c, a)) <= q + 1e-6) continue;
    if (!tri_can_flip(m, e)) continue;
    tri_flip(m, e);
    r->stats->flips++;
  }
}

void refine__optimize(Refiner *r, int level)
{
  for (int k = 0; k < level; k++) {
    quality_flips(r);
    refine__smooth(r, 1);
  }
}
