// face_cluster_regions.c - which parts of the plane belong to which face of a cluster
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/face_cluster_int.h"

typedef struct {
  uint32_t a, b;
  int curve;
} RegionEdge;
typedef Vec(RegionEdge) RegionEdges;

static int compare_region_edges(const void *x, const void *y)
{
  const RegionEdge *p = x, *q = y;
  if (p->a != q->a) return p->a < q->a ? -1 : 1;
  if (p->b != q->b) return p->b < q->b ? -1 : 1;
  return (p->curve > q->curve) - (p->curve < q->curve);
}

// Label the parts into which the segments cut the plane; part 0 is the outside.
static void find_regions(FaceCluster *p)
{
  const Tri *t = &p->tri;
  p->region = mem_alloc(t->nt * sizeof *p->region);
  memset(p->region, 0xff, t->nt * sizeof *p->region);
  U32Vec stack = {0};
  for (int pass = 0; pass < 2; pass++)
    for (TriId k = 0; k < t->nt; k++) {
      if (tri_is_free(t, k) || p->region[k] != NONE || (pass == 0 && (!tri_is_ghost(t, k) || p->nregion))) continue;
      uint32_t id = (uint32_t)p->nregion++;
      p->region[k] = id;
      vec_push(&stack, k);
      while (stack.len) {
        TriId s = vec_pop(&stack);
        for (EdgeId e = 3 * s; e < 3 * s + 3; e++) {
          TriId o = tri_of(t->twin[e]);
          if (tri_is_segment(t, e) || p->region[o] != NONE) continue;
          p->region[o] = id;
          vec_push(&stack, o);
        }
      }
    }
  vec_free(&stack);
}

static void region_edges(const FaceCluster *p, RegionEdges *out)
{
  const Tri *t = &p->tri;
  for (EdgeId e = 0; e < 3 * t->nt; e++) {
    if (tri_is_free(t, tri_of(e)) || !tri_is_segment(t, e)) continue;
    RegionEdge r = {p->region[tri_of(e)], p->region[tri_of(t->twin[e])], p->graph.curve.data[t->seg[e]]};
    if (r.a != r.b) vec_push(out, r);
  }
  qsort(out->data, out->len, sizeof *out->data, compare_region_edges);
  size_t n = 0;
  for (size_t i = 0; i < out->len; i++)
    if (!n || compare_region_edges(&out->data[n - 1], &out->data[i]) != 0) out->data[n++] = out->data[i];
  out->len = n;
}

// Tags of the curves that bound f: those its loops run along an odd number of times.
static void bounding_curves(const Model *m, const Face *f, Map *out)
{
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  for (size_t i = 0; i < curve.len; i++) {
    uint32_t *n = map_slot(out, (uint64_t)abs(curve.data[i]), 0, NULL);
    *n ^= 1;
  }
  vec_free(&curve);
  vec_free(&start);
}

// Give f the regions that an odd number of its curves separate from the outside. False when one has an owner.
static bool claim_regions(FaceCluster *p, size_t k, const RegionEdges *edges, const size_t *begin)
{
  const Face *f = model_face_at(p->in->model, p->face.data[k]);
  Map odd = {0};
  bounding_curves(p->in->model, f, &odd);
  uint8_t *side = mem_alloc(p->nregion); // 0 outside f, 1 inside, 2 not seen yet
  memset(side, 2, p->nregion);
  U32Vec stack = {0};
  vec_push(&stack, 0);
  side[0] = 0;
  bool good = true;
  while (stack.len) {
    uint32_t r = vec_pop(&stack);
    if (side[r]) {
      good = good && p->owner[r] == NONE;
      p->owner[r] = (uint32_t)k;
    }
    for (size_t i = begin[r]; i < begin[r + 1]; i++) {
      const RegionEdge *e = &edges->data[i];
      if (side[e->b] != 2) continue;
      side[e->b] = side[r] ^ (map_get(&odd, (uint64_t)e->curve) == 1);
      vec_push(&stack, e->b);
    }
  }
  vec_free(&stack);
  free(side);
  map_free(&odd);
  return good;
}

// Segments of curve `tag`, which the k-th face embeds, without a triangle of the face beside them: name the first.
static bool lies_in(const FaceCluster *p, size_t k, int tag, const uint32_t *beside)
{
  for (size_t s = 0; s < p->graph.curve.len; s++) {
    if (p->graph.curve.data[s] != tag || beside[2 * s] == k || beside[2 * s + 1] == k) continue;
    const double *q = tri_xy(&p->tri, p->graph.ends.data[2 * s]);
    Vec3 at = face_from_plane(p->frame, (Vec2){q[0], q[1]});
    const Face *f = model_face_at(p->in->model, p->face.data[k]);
    diag_error(p->diag, f->loc, "embedded curve %d is outside surface %d near (%g, %g, %g)", tag, f->tag, at.x, at.y, at.z);
    return false;
  }
  return true;
}

bool face_cluster__embedded_inside(const FaceCluster *p)
{
  const Tri *t = &p->tri;
  size_t n = 2 * p->graph.curve.len;
  uint32_t *beside = mem_alloc((n + 1) * sizeof *beside); // owners of the triangles on either side of each segment
  memset(beside, 0xff, n * sizeof *beside);
  for (EdgeId e = 0; e < 3 * t->nt; e++) {
    if (tri_is_free(t, tri_of(e)) || !tri_is_segment(t, e)) continue;
    beside[2 * (size_t)t->seg[e]] = p->owner[p->region[tri_of(e)]];
    beside[2 * (size_t)t->seg[e] + 1] = p->owner[p->region[tri_of(t->twin[e])]];
  }
  bool good = true;
  for (size_t k = 0; k < p->face.len && good; k++) {
    const IntVec *embedded = &model_face_at(p->in->model, p->face.data[k])->embedded_curves;
    for (size_t i = 0; i < embedded->len && good; i++) good = lies_in(p, k, abs(embedded->data[i]), beside);
  }
  free(beside);
  return good;
}

bool face_cluster__regions(FaceCluster *p)
{
  find_regions(p);
  RegionEdges edges = {0};
  region_edges(p, &edges);
  size_t *begin = mem_zalloc((p->nregion + 1) * sizeof *begin);
  for (size_t i = 0; i < edges.len; i++) begin[edges.data[i].a + 1]++;
  for (size_t r = 0; r < p->nregion; r++) begin[r + 1] += begin[r];
  p->owner = mem_alloc(p->nregion * sizeof *p->owner);
  memset(p->owner, 0xff, p->nregion * sizeof *p->owner);
  bool good = true;
  for (size_t k = 0; k < p->face.len && good; k++) good = claim_regions(p, k, &edges, begin);
  free(begin);
  vec_free(&edges);
  return good;
}
