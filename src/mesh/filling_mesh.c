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
      Vec2 q = filling_to_plane(s, filling_side(s, k, tag >= 0 ? cm->u[i] : 1 - cm->u[i]));
      g->xy.data[2 * v] = q.x;
      g->xy.data[2 * v + 1] = q.y;
    }
  }
  vec_free(&curve);
  vec_free(&start);
}

// Length of the edges about the place t (in the sense of the loop) of the k-th side.
static double side_size(const FaceMap *map, int k, double t)
{
  const Filling *s = map->filling;
  const CurveMesh *cm = mesh1d_curve(map->curves, s->curve[k]->tag);
  if (!cm || cm->n < 2) return INFINITY;
  if (s->reversed[k]) t = 1 - t;
  uint32_t lo = 0, hi = cm->n - 1; // u[lo] <= t < u[hi]
  while (hi - lo > 1) {
    uint32_t mid = (lo + hi) / 2;
    if (cm->u[mid] <= t) lo = mid; else hi = mid;
  }
  return vec3_distance(cm->p[lo], cm->p[hi]);
}

static double boundary_size(const FaceMap *map, Vec2 uv)
{
  const Filling *s = map->filling;
  double away[4] = {uv.y, 1 - uv.x, 1 - uv.y, uv.x}, foot[4] = {uv.x, uv.y, 1 - uv.x, 1 - uv.y}, sum = 0, weight = 0;
  if (s->n == 3) {
    double c[3] = {1 - uv.x, uv.x - uv.y, uv.y};
    for (int k = 0; k < 3; k++) {
      double a = c[k], b = c[(k + 1) % 3];
      away[k] = c[(k + 2) % 3];
      foot[k] = a + b > 0 ? b / (a + b) : 0.5;
    }
  }
  for (int k = 0; k < s->n; k++) {
    double h = side_size(map, k, fmin(fmax(foot[k], 0), 1)), w = 1 / fmax(away[k], 1e-6);
    if (h == INFINITY) continue;
    sum += w * h;
    weight += w;
  }
  return weight > 0 ? sum / weight : INFINITY;
}

double filling_size(void *ctx, Vec2 q)
{
  const FaceMap *map = ctx;
  Vec2 uv = filling_from_plane(map->filling, q);
  double h = size_in_face(map->eval, map->face, filling_point(map->filling, uv.x, uv.y));
  if (map->curves) h = fmin(h, boundary_size(map, uv));
  return h / filling_stretch(map->filling, q);
}
