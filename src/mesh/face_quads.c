// face_quads.c - recombining the triangles of a face to quadrangles
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/face_quads.h"

#include <math.h>

#include "quad/quad_mesh.h"

// The share of triangles that the greedy method leaves single on a coarse mesh.
static const double GREEDY_SINGLE = 0.2;

bool face_is_recombined(const Face *f, const Options *o) { return f->recombine || o->Mesh_RecombineAll; }

bool face_is_split(const Model *m, const Face *f, const Mesh1d *curves, const Options *o)
{
  if (!face_is_recombined(f, o) || o->Mesh_RecombinationAlgorithm < QUAD_FULL_GREEDY) return false;
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  for (size_t i = 0; i < f->embedded_curves.len; i++) vec_push(&curve, f->embedded_curves.data[i]);
  bool even = true;
  for (size_t i = 0; i < curve.len && even; i++) even = curves->curve[mesh1d_index(curves, curve.data[i])].n % 2 == 1;
  vec_free(&curve);
  vec_free(&start);
  return even;
}

// Algorithms 8 and 9 make triangles that are halves of squares, the others equilateral ones. Split, a pair becomes four quadrangles and a
// single triangle three; without, triangles that the greedy method leaves are not made larger for it.
double face_quads_single_factor(const Options *o, bool coarse)
{
  int r = o->Mesh_RecombinationAlgorithm;
  double single = !coarse ? 0 : r == QUAD_SPLIT ? 1 : r == QUAD_FULL_GREEDY ? GREEDY_SINGLE : 0;
  return sqrt((2 + single) / 2);
}

double face_quads_size_factor(const Face *f, const Options *o, bool coarse)
{
  int a = f->algorithm ? f->algorithm : o->Mesh_Algorithm, r = o->Mesh_RecombinationAlgorithm;
  if (!face_is_recombined(f, o)) return 1;
  double per_square = a == 8 || a == 9 ? 2 : sqrt(3);
  if (!coarse) return r == QUAD_GREEDY ? 1 : sqrt(2 / per_square);
  return 2 * face_quads_single_factor(o, coarse) * sqrt(2 / per_square);
}

// ---- in -----------------------------------------------------------------------------------------------------------------
typedef struct {
  FaceTriangles in;
  QuadMesh mesh;
} Work;

static void take_triangles(Work *w)
{
  const Tri *t = w->in.tri;
  U32Vec tri = {0}, locked = {0};
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    for (EdgeId e = 3 * k; e < 3 * k + 3; e++) {
      vec_push(&tri, t->vert[e]);
      if (!tri_is_segment(t, e) || t->twin[e] < e || !tri_is_inside(t, tri_of(t->twin[e]))) continue;
      vec_push(&locked, t->vert[e]);
      vec_push(&locked, tri_dest(t, e));
    }
  }
  uint8_t *fixed = mem_zalloc(t->nv);
  memset(fixed, 1, w->in.graph->node.len);
  quad_mesh_init(&w->mesh, t->xy, fixed, t->nv, tri.data, tri.len / 3, locked.data, locked.len / 2);
  quad_mesh_set_sizes(&w->mesh, w->in.sizes.vertex);
  free(fixed);
  vec_free(&tri);
  vec_free(&locked);
}

// The node in the middle of a boundary edge of the coarse mesh, which every second node has left out.
static bool middle_place(void *ctx, uint32_t a, uint32_t b, Vec2 *p)
{
  const Work *w = ctx;
  uint32_t i = map_get(&w->in.graph->middle, map_pair(a, b));
  if (i == NONE) return false;
  *p = (Vec2){w->in.graph->middle_xy.data[2 * (size_t)i], w->in.graph->middle_xy.data[2 * (size_t)i + 1]};
  return true;
}

static QuadParams quad_params(const Face *f, const Options *o, Work *w)
{
  QuadParams p = quad_params_default();
  int a = o->Mesh_RecombinationAlgorithm;
  if (!w->in.graph->coarse && a >= QUAD_FULL_GREEDY) a = QUAD_BLOSSOM; // a curve with an odd number of edges cannot be halved
  p.algorithm = (QuadAlgorithm)a;
  p.angle = f->recombine_angle > 0 ? f->recombine_angle : 45;
  p.cleanup = o->Mesh_RecombineOptimizeTopology;
  if (!o->Mesh_RecombineNodeRepositioning) p.smoothing = 0;
  p.min_eta = o->Mesh_RecombineMinimumQuality;
  p.middle = middle_place;
  p.ctx = w;
  return p;
}

// ---- out ----------------------------------------------------------------------------------------------------------------
// Node ids of the vertices: those of the graph, middles of its segments, and own nodes, which are appended to out.
static uint32_t *number_vertices(const Work *w, uint32_t base, FaceMesh *out)
{
  const QuadMesh *q = &w->mesh;
  size_t n = q->xy.len, before = out->nown;
  uint32_t *id = mem_alloc(n * sizeof *id), nlocal = (uint32_t)w->in.graph->node.len;
  bool *used = mem_zalloc(n * sizeof *used);
  for (size_t i = 0; i < q->vertex.len; i++)
    if (q->vertex.data[i] != NONE) used[q->vertex.data[i]] = true;
  out->own = mem_realloc(out->own, (before + n) * sizeof *out->own);
  out->size = mem_realloc(out->size, (before + n) * sizeof *out->size);
  for (size_t i = 0; i < before; i++) out->size[i] = NAN;
  for (size_t v = 0; v < n; v++) {
    uint32_t from = q->from.data[v], a = q->parent.data[2 * v], b = q->parent.data[2 * v + 1];
    uint32_t middle = from == NONE && a != NONE ? map_get(&w->in.graph->middle, map_pair(a, b)) : NONE;
    id[v] = NONE;
    if (!used[v]) continue;
    if (from < nlocal) {
      id[v] = w->in.graph->node.data[from];
    } else if (middle != NONE) {
      id[v] = w->in.graph->middle_node.data[middle];
    } else {
      id[v] = base + (uint32_t)out->nown;
      Vec2 p = q->xy.data[v];
      double h = w->in.sizes.extended ? quad_mesh_size(q, (uint32_t)v, p) : INFINITY;
      if (w->in.sizes.at) h = fmin(h, w->in.sizes.at(w->in.sizes.ctx, p));
      out->size[out->nown] = w->in.map->filling ? h * filling_stretch(w->in.map->filling, p) : h;
      out->own[out->nown++] = face_map_point(w->in.map, q->xy.data[v]);
    }
  }
  free(used);
  return id;
}

static void put_elements(const QuadMesh *q, const uint32_t *id, FaceMesh *out)
{
  size_t n = quad_mesh_elements(q), ntri = quad_mesh_triangles(q);
  out->tri = mem_realloc(out->tri, 3 * (out->ntri + ntri) * sizeof *out->tri);
  out->quad = mem_realloc(out->quad, 4 * (out->nquad + n - ntri) * sizeof *out->quad);
  for (size_t e = 0; e < n; e++) {
    bool quad = quad_mesh_is_quad(q, e);
    uint32_t *to = quad ? &out->quad[4 * out->nquad++] : &out->tri[3 * out->ntri++];
    for (size_t i = 0; i < (quad ? 4u : 3u); i++) to[i] = id[q->vertex.data[4 * e + i]];
  }
}

bool face_quads(const FaceTriangles *from, const Options *o, uint32_t base, FaceMesh *out, size_t *excess, Diag *diag)
{
  Work w = {.in = *from};
  const Face *f = from->map->face;
  take_triangles(&w);
  QuadParams p = quad_params(f, o, &w);
  QuadReport report = {0};
  quad_recombine(&w.mesh, &p, &report);
  if (report.inverted && from->graph->coarse) {
    quad_mesh_free(&w.mesh);
    return false;
  }
  bool said = p.algorithm != QUAD_GREEDY && o->Mesh_SubdivisionAlgorithm != 1; // which splits them all
  if (report.triangles && said)
    diag_warning(diag, f->loc, "surface %d keeps %zu triangle%s: %s", f->tag, report.triangles,
                 report.triangles == 1 ? "" : "s",
                 report.cut                              ? "quadrangles there would not be convex"
                 : report.triangles > report.odd_parts ? "there are no pairs that would be convex quadrangles"
                                                         : "its boundary has an odd number of edges");
  *excess = said && report.triangles > report.odd_parts ? report.triangles - report.odd_parts : 0;
  out->matching_seconds = report.matching_seconds;
  uint32_t *id = number_vertices(&w, base, out);
  put_elements(&w.mesh, id, out);
  free(id);
  quad_mesh_free(&w.mesh);
  return true;
}
