// tri_field.c - the size that extends from the boundary, anywhere in the face: linear on the empty mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/refine_int.h"

void refine__field_take(RefineField *f, const Refiner *r)
{
  *f = (RefineField){0};
  if (!r->carried) return;
  tri_copy(&f->empty, r->m);
  f->size = mem_alloc(r->m->nv * sizeof *f->size);
  memcpy(f->size, r->carried, r->m->nv * sizeof *f->size);
}

void refine__field_free(RefineField *f)
{
  if (f->size) tri_free(&f->empty);
  free(f->size);
}

double refine__linear(const Tri *m, const double *at_vertex, TriId t, const double *p)
{
  const uint32_t *v = m->vert + 3 * (size_t)t;
  const double *a = tri_xy(m, v[0]), *b = tri_xy(m, v[1]), *c = tri_xy(m, v[2]);
  double x = b[0] - a[0], y = b[1] - a[1], u = c[0] - a[0], w = c[1] - a[1], s = p[0] - a[0], q = p[1] - a[1];
  double d = 1 / (x * w - y * u), f = (s * w - q * u) * d, g = (x * q - y * s) * d;
  double ha = at_vertex[v[0]], hb = at_vertex[v[1]], hc = at_vertex[v[2]], h = ha + f * (hb - ha) + g * (hc - ha);
  // p may lie outside of t, and rounding makes weights below 0: what the corners say bounds what comes out.
  return fmax(fmin(ha, fmin(hb, hc)), fmin(h, fmax(ha, fmax(hb, hc))));
}

double refine__field_at(RefineField *f, const double *p)
{
  EdgeId e;
  if (!f->size || tri_locate(&f->empty, p, NONE, &e) == TRI_OUTSIDE) return INFINITY;
  return refine__linear(&f->empty, f->size, tri_of(e), p);
}

double refine__wanted(RefineField *f, const Refiner *r, const double *p, double otherwise)
{
  double h = refine__field_at(f, p);
  if (r->p->size) h = fmin(h, r->p->size(r->p->size_ctx, (Vec2){p[0], p[1]}));
  return isfinite(h) ? h : otherwise;
}

void refine__field_apply(RefineField *f, Refiner *r)
{
  for (VertId v = 0; v < r->m->nv; v++)
    if (!r->fixed[v]) r->size[v] = refine__wanted(f, r, tri_xy(r->m, v), r->size[v]);
}
