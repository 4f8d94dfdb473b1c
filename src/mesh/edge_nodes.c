// edge_nodes.c - numbering of the nodes of points and curves, and the mesh of one face on top of it
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/edge_nodes.h"

void edge_nodes_init(EdgeNodes *en, const Model *m, const Mesh1d *curves)
{
  size_t np = model_points(m), nc = model_curves(m), n = np;
  en->first = mem_alloc((nc + 1) * sizeof *en->first);
  for (size_t k = 0; k < nc; k++) {
    en->first[k] = (uint32_t)n;
    if (curves->curve[k].n > 2) n += curves->curve[k].n - 2;
  }
  en->first[nc] = (uint32_t)n;
  en->n = n;
  en->xyz = mem_alloc(n * sizeof *en->xyz);
  for (size_t k = 0; k < np; k++) en->xyz[k] = model_point_at(m, k)->xyz;
  for (size_t k = 0; k < nc; k++)
    for (size_t i = 1; i + 1 < curves->curve[k].n; i++) en->xyz[en->first[k] + i - 1] = curves->curve[k].p[i];
}

void edge_nodes_free(EdgeNodes *en)
{
  free(en->xyz);
  free(en->first);
}

uint32_t edge_nodes_point(const Model *m, int tag)
{
  size_t lo = 0, hi = model_points(m);
  while (lo < hi) {
    size_t mid = (lo + hi) / 2;
    if (model_point_at(m, mid)->tag < tag)
      lo = mid + 1;
    else
      hi = mid;
  }
  return lo < model_points(m) && model_point_at(m, lo)->tag == tag ? (uint32_t)lo : NONE;
}

uint32_t edge_nodes_at(const EdgeNodes *en, const Model *m, const Mesh1d *curves, size_t k, size_t i)
{
  const Curve *c = model_curve_at(m, k);
  if (i == 0) return edge_nodes_point(m, c->begin);
  if (i + 1 == curves->curve[k].n) return edge_nodes_point(m, c->end);
  return en->first[k] + (uint32_t)i - 1;
}

void face_mesh_free(FaceMesh *f)
{
  free(f->own);
  free(f->size);
  free(f->tri);
  free(f->quad);
  *f = (FaceMesh){0};
}
