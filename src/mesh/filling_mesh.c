// filling_mesh.c - meshing a surface that is not plane in a plane that stands for its parameters
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/filling_mesh.h"

Vec3 face_map_point(const FaceMap *map, Vec2 q)
{
  if (!map->filling) return face_from_plane(map->face, q);
  Vec2 uv = filling_from_plane(map->filling, q);
  return filling_point(map->filling, uv.x, uv.y);
}

bool filling_wanted(Filling *s, const Model *m, const Face *f)
{
  return f->type == FACE_FILLING && !f->planar && !f->sphere && !f->embedded_curves.len && !f->embedded_points.len && filling_init(s, m, f);
}

void filling_place(const Filling *s, const Mesh2dInput *in, const Face *f, const EdgeNodes *en, FaceGraph *g)
{
  IntVec curve = {0}, start = {0};
  face_boundary(in->model, f, &curve, &start);
  for (int k = 0; k < s->n; k++) {
    int tag = curve.data[k];
    size_t index = mesh1d_index(in->curves, tag);
    const CurveMesh *cm = &in->curves->curve[index];
    for (size_t i = 0; i < cm->n; i++) {
      uint32_t v = map_get(&g->local, edge_nodes_at(en, in->model, in->curves, index, i));
      if (v == NONE) continue;
      Vec2 q = filling_to_plane(s, filling_side(s, k, tag > 0 ? cm->u[i] : 1 - cm->u[i]));
      g->xy.data[2 * v] = q.x;
      g->xy.data[2 * v + 1] = q.y;
    }
  }
  vec_free(&curve);
  vec_free(&start);
}

double filling_size(void *ctx, Vec2 q)
{
  const FaceMap *map = ctx;
  return size_in_face(map->eval, map->face, face_map_point(map, q));
}
