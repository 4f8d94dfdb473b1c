// tri_lattice.c - repositioning of vertices that are to be corners of quads: toward where their neighbours along a cross want them
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/refine_int.h"

// Neighbours at less than 30 degrees from an axis of the cross are on that side; the others are across a diagonal.
#define SIDE 0.57735
// No triangle may get worse than this, in kappa_4 squared, unless it was: those of a square have 0.83.
#define LEAST_QUALITY 0.5

// The mean over the four sides of where the neighbours on each would have v; false if fewer than three sides have any.
static bool wanted_place(const Refiner *r, const RefineCross *x, VertId v, double *p)
{
  const Tri *m = r->m;
  const double *at = tri_xy(m, v), c = cos(x->angle[v]), s = sin(x->angle[v]);
  double sum[4][2] = {{0}};
  int n[4] = {0}, sides = 0;
  EdgeId first = m->hint[v], e = first;
  do {
    VertId u = tri_dest(m, e);
    const double *q = tri_xy(m, u);
    double dx = at[0] - q[0], dy = at[1] - q[1], d[2] = {c * dx + s * dy, c * dy - s * dx};
    int k = fabs(d[0]) > fabs(d[1]) ? 0 : 1, side = 2 * k + (d[k] > 0);
    if (fabs(d[1 - k]) < SIDE * fabs(d[k])) {
      double h = 2 / (1 / (r->size[u] * x->stretch[u]) + 1 / (r->size[v] * x->stretch[v]));
      sum[side][k] += copysign(h, d[k]) - d[k], sum[side][1 - k] -= d[1 - k];
      n[side]++;
    }
    e = tri_ccw(m, e);
  } while (e != first);
  double u = 0, w = 0;
  for (int k = 0; k < 4; k++)
    if (n[k]) u += sum[k][0] / n[k], w += sum[k][1] / n[k], sides++;
  if (sides < 3) return false;
  u /= sides, w /= sides;
  p[0] = at[0] + c * u - s * w, p[1] = at[1] + s * u + c * w;
  return fabs(u) + fabs(w) > 1e-4 * r->size[v];
}

// The worst triangle about v, if v were at p.
static double worst_about(const Tri *m, VertId v, const double *p)
{
  double worst = 1;
  EdgeId first = m->hint[v], e = first;
  do {
    worst = fmin(worst, metric_quality(p, tri_xy(m, tri_dest(m, e)), tri_xy(m, tri_apex(m, e))));
    e = tri_ccw(m, e);
  } while (e != first);
  return worst;
}

static void move(Refiner *r, RefineCross *x, VertId v, const double *p)
{
  if (!tri_move(r->m, v, p)) return;
  r->stats->moves++;
  if (!r->p->size && !r->p->cross) return;
  Vec2 q = {p[0], p[1]};
  if (r->p->cross)
    x->angle[v] = r->p->cross(r->p->cross_ctx, q, &x->near[v]);
  double h = r->p->size ? r->p->size(r->p->size_ctx, q) : INFINITY;
  r->size[v] = r->carried && r->carried[v] < h ? r->carried[v] : h;
}

void refine__lattice_smooth(Refiner *r, RefineCross *x, VertId given, int passes)
{
  Tri *m = r->m;
  tri_make_hints(m);
  for (int k = 0; k < passes; k++) {
    for (VertId v = given; v < m->nv; v++) {
      double p[2];
      if (m->hint[v] == NONE || !wanted_place(r, x, v, p)) continue;
      double worst = worst_about(m, v, tri_xy(m, v));
      if (worst_about(m, v, p) >= fmin(worst, LEAST_QUALITY)) move(r, x, v, p);
    }
    tri_legalize_all(m);
  }
  free(m->hint);
  m->hint = NULL;
}
