// mesh_shapes.c - the shape measures of [book §4.1] over the triangles of a mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_shapes.h"

#include "geom/quality.h"
#include "mesh/mesh_edges.h"
#include "mesh/mesh_measure.h"

static void add_triangle(MeshShapes *s, TriShape t)
{
  const double kappa[SHAPES] = {quality_kappa1(t), quality_kappa2(t), quality_kappa3(t), quality_kappa4(t), quality_kappa5(t)};
  for (int i = 0; i < SHAPES; i++) {
    s->min[i] = s->triangles ? fmin(s->min[i], kappa[i]) : kappa[i];
    s->mean[i] += kappa[i]; // divided at the end
  }
  s->triangles++;
}

static void add_block(MeshShapes *s, const Mesh *m, const MeshBlock *k)
{
  Vec3 normal = mesh_area_vector(m, k->entity), x[4];
  for (size_t i = 0; i < k->n; i++) {
    mesh_corners(m, k, i, x);
    add_triangle(s, shape_space(x[0], x[1], x[2], normal));
  }
}

// Cosine and sine, both times the same, of the angle at corner c of triangle i.
static void angle_at(const Mesh *m, const MeshBlock *k, size_t i, size_t c, double *cosine, double *sine)
{
  Vec3 x[4];
  mesh_corners(m, k, i, x);
  Vec3 u = vec3_sub(x[(c + 1) % 3], x[c]), v = vec3_sub(x[(c + 2) % 3], x[c]);
  *cosine = vec3_dot(u, v);
  *sine = vec3_length(vec3_cross(u, v));
}

// Do the angles opposite to half-edge h of triangle i of block b and to its twin sum to more than pi? Two right angles (a grid) give
// zero but for rounding, and zero is not more.
static bool is_obtuse(const Mesh *m, size_t b, size_t i, size_t c, HalfEdge twin)
{
  double ca, sa, cb, sb;
  angle_at(m, &m->block[b], i, (c + 2) % 3, &ca, &sa);
  angle_at(m, &m->block[twin.block], twin.element, (twin.corner + 2) % 3, &cb, &sb);
  return sa * cb + ca * sb < -1e-12 * (fabs(sa * cb) + fabs(ca * sb) + sa * sb);
}

static void count_edges(MeshShapes *s, const Mesh *m)
{
  MeshEdges e;
  mesh_edges_make(&e, m);
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (elem_dim(k->type) != 2 || elem_corners(k->type) != 3) continue;
    for (size_t h = e.base[b], i = 0; i < k->n; i++)
      for (size_t c = 0; c < 3; c++, h++) {
        uint32_t twin = e.twin[h];
        if (twin == NONE || twin == EDGE_BAD || twin < h) continue;
        HalfEdge o = mesh_edges_at(&e, m, twin);
        if (elem_corners(m->block[o.block].type) != 3) continue;
        s->inner_edges++;
        s->obtuse += is_obtuse(m, b, i, c, o);
      }
  }
  mesh_edges_free(&e);
}

void mesh_shapes_make(MeshShapes *s, const Mesh *m)
{
  *s = (MeshShapes){0};
  for (size_t b = 0; b < m->nblock; b++)
    if (elem_dim(m->block[b].type) == 2 && elem_corners(m->block[b].type) == 3) add_block(s, m, &m->block[b]);
  for (int i = 0; i < SHAPES && s->triangles; i++) s->mean[i] /= (double)s->triangles;
  if (s->triangles) count_edges(s, m);
}
