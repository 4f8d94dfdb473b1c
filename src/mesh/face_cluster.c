// face_cluster.c - faces meshed as one triangulation, where boundary edges may have to be split
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/face_cluster.h"

#include "mesh/face_cluster_int.h"
#include "mesh/face_cross.h"
#include "tri/refine.h"

// Forget the last meshing.
static void clear(FaceCluster *p)
{
  face_graph_free(&p->graph);
  p->graph = (FaceGraph){0};
  vec_free(&p->first);
  tri_free(&p->tri);
  p->tri = (Tri){0};
  free(p->region);
  free(p->owner);
  p->region = p->owner = NULL;
  p->nregion = 0;
  vec_free(&p->curve);
  vec_free(&p->chain);
  vec_free(&p->start);
  vec_free(&p->on_curve);
  vec_free(&p->skinny);
  free(p->size);
  p->size = NULL;
  if (p->diag) diag_free(p->diag);
  p->diag = NULL;
}

void face_cluster_free(FaceCluster *p)
{
  clear(p);
  vec_free(&p->face);
}

// ---- splitting ----------------------------------------------------------------------------------------------------------
static bool is_fixed(const Curve *c)
{
  return c->transfinite || c->periodic_master || c->copy_of || c->layers.n > 0;
}

Vec3 face_cluster__place(const FaceCluster *p, VertId v)
{
  return face_from_plane(p->frame, (Vec2){tri_xy(&p->tri, v)[0], tri_xy(&p->tri, v)[1]});
}

// Parameter of vertex v on the curve of segment s.
static double vertex_parameter(const FaceCluster *p, uint32_t s, VertId v)
{
  const CurveMesh *cm = mesh1d_curve(p->curves, p->graph.curve.data[s]);
  uint32_t i = p->first.data[s];
  if (v == p->graph.ends.data[2 * s]) return cm->u[i];
  if (v == p->graph.ends.data[2 * s + 1]) return cm->u[i + 1];
  return p->on_curve.data[v];
}

static bool split_point(void *ctx, VertId u, VertId v, double at, Vec2 *point)
{
  FaceCluster *p = ctx;
  EdgeId e = tri_find_edge(&p->tri, u, v);
  if (e == NONE || !tri_is_segment(&p->tri, e)) return false;
  uint32_t s = p->tri.seg[e];
  const Curve *c = model_curve(p->in->model, p->graph.curve.data[s]);
  if (is_fixed(c) || map_get(p->held, (uint64_t)c->tag) != NONE) return false;
  double ua = vertex_parameter(p, s, u), ub = vertex_parameter(p, s, v);
  p->next_on_curve = ua + at * (ub - ua);
  if (curve_is_straight(p->in->model, c)) {
    const double *a = tri_xy(&p->tri, u), *b = tri_xy(&p->tri, v);
    *point = (Vec2){a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1])};
  } else {
    *point = face_to_plane(p->frame, curve_point(p->in->model, c, p->next_on_curve));
  }
  return true;
}

static void split_placed(void *ctx, VertId u, VertId v, VertId w)
{
  (void)u, (void)v;
  FaceCluster *p = ctx;
  while (p->on_curve.len <= w) vec_push(&p->on_curve, NAN);
  p->on_curve.data[w] = p->next_on_curve;
}

typedef struct {
  uint32_t seg;
  double u;
  VertId v;
} SplitVertex;
typedef Vec(SplitVertex) SplitVertices;

static int compare_splits(const void *a, const void *b)
{
  const SplitVertex *x = a, *y = b;
  if (x->seg != y->seg) return x->seg < y->seg ? -1 : 1;
  if (x->u != y->u) return x->u < y->u ? -1 : 1;
  return (x->v > y->v) - (x->v < y->v);
}

// The vertices that refinement has put on segments, in order along each.
static void find_splits(const FaceCluster *p, SplitVertices *out)
{
  const Tri *t = &p->tri;
  for (EdgeId e = 0; e < 3 * t->nt; e++) {
    if (tri_is_free(t, tri_of(e)) || !tri_is_segment(t, e) || t->vert[e] < p->graph.node.len) continue;
    uint32_t s = t->seg[e];
    vec_push(out, ((SplitVertex){s, p->on_curve.data[t->vert[e]], t->vert[e]}));
  }
  if (out->len) qsort(out->data, out->len, sizeof *out->data, compare_splits);
  size_t n = 0;
  for (size_t i = 0; i < out->len; i++)
    if (!n || out->data[n - 1].v != out->data[i].v) out->data[n++] = out->data[i];
  out->len = n;
}

// Give the curves their new nodes, and list the vertices of each from begin to end.
static void update_curves(FaceCluster *p, const SplitVertices *splits)
{
  const FaceGraph *g = &p->graph;
  DoubleVec u = {0};
  size_t at = 0;
  for (uint32_t s = 0; s < g->curve.len;) {
    uint32_t end = s;
    const Curve *c = model_curve(p->in->model, g->curve.data[s]);
    const CurveMesh *cm = mesh1d_curve(p->curves, c->tag);
    vec_clear(&u);
    vec_push(&p->start, (uint32_t)p->chain.len);
    vec_push(&p->curve, c->tag);
    for (; end < g->curve.len && g->curve.data[end] == c->tag; end++) {
      vec_push(&u, cm->u[p->first.data[end]]);
      vec_push(&p->chain, g->ends.data[2 * end]);
      for (; at < splits->len && splits->data[at].seg == end; at++) {
        vec_push(&u, splits->data[at].u);
        vec_push(&p->chain, splits->data[at].v);
      }
    }
    vec_push(&u, 1);
    vec_push(&p->chain, g->ends.data[2 * end - 1]);
    if (u.len != cm->n) mesh1d_set(p->curves, mesh1d_index(p->curves, c->tag), u.data, (uint32_t)u.len);
    s = end;
  }
  vec_push(&p->start, (uint32_t)p->chain.len);
  vec_free(&u);
}

// ---- one triangulation --------------------------------------------------------------------------------------------------
static void build_graph(FaceCluster *p)
{
  p->graph.frame = p->frame;
  for (size_t k = 0; k < p->face.len; k++)
    face_graph_add(&p->graph, p->in->model, model_face_at(p->in->model, p->face.data[k]), p->curves, p->nodes);
  const IntVec *curve = &p->graph.curve;
  for (uint32_t s = 0, i = 0; s < curve->len; s++, i++) {
    if (s && curve->data[s] != curve->data[s - 1]) i = 0;
    vec_push(&p->first, i);
  }
}

// The empty mesh: every triangle inside carries the face that owns it, counted from 1, as its region.
static bool empty_mesh(FaceCluster *p)
{
  Tri *t = &p->tri;
  tri_init(t);
  build_graph(p);
  if (!face_graph_recover(&p->graph, p->in->model, p->frame, t, p->diag) || !face_cluster__regions(p) ||
      !face_cluster__embedded_inside(p))
    return false;
  t->region = mem_realloc(t->region, t->cap_t * sizeof *t->region);
  for (TriId k = 0; k < t->nt; k++) {
    if (tri_is_free(t, k)) continue;
    uint32_t owner = p->owner[p->region[k]];
    t->region[k] = owner == NONE ? 0 : owner + 1;
    if (owner == NONE || tri_is_ghost(t, k)) t->flag[k] |= TRI_OUTSIDE_FLAG;
    else t->flag[k] &= (uint8_t)~TRI_OUTSIDE_FLAG;
  }
  tri_make_hints(t);
  return true;
}

static ClusterOutcome refine(FaceCluster *p)
{
  const Options *o = p->in->options;
  SizeEval *eval = size_eval_new(p->in->size);
  SizeInPlane here = {eval, p->frame, 0};
  TriRefineParams r = mesh2d_refine_params(o, p->frame, &here);
  r.min_angle = o->Mesh_MinimumAngle;
  r.conforming = o->Mesh_ConformingDelaunay;
  r.split = split_point;
  r.placed = split_placed;
  r.split_ctx = p;
  r.skinny_out = &p->skinny;
  r.sizes_out = &p->size;
  FaceCross cross = {0};
  face_cross_prepare(&cross, &p->tri, &r);
  TriRefineStats s = tri_refine(&p->tri, &r);
  face_cross_free(&cross);
  size_eval_report(eval, p->diag);
  size_eval_free(eval);
  if (s.outcome != REFINE_LIMIT) return CLUSTER_DONE;
  diag_error(p->diag, p->frame->loc, "more than %zu triangles (Mesh.MaxElements, -max_elements)", r.max_triangles);
  return CLUSTER_LIMIT;
}

ClusterOutcome face_cluster_mesh(FaceCluster *p)
{
  clear(p);
  p->diag = diag_child(p->in->diag);
  if (!empty_mesh(p)) return CLUSTER_BAD;
  ClusterOutcome outcome = refine(p);
  if (outcome != CLUSTER_DONE) return outcome;
  SplitVertices splits = {0};
  find_splits(p, &splits);
  update_curves(p, &splits);
  vec_free(&splits);
  return CLUSTER_DONE;
}

// ---- to the faces -------------------------------------------------------------------------------------------------------
// Node ids of the vertices that are on points and curves; NONE for others.
static uint32_t *known_nodes(const FaceCluster *p, const EdgeNodes *nodes)
{
  uint32_t *id = mem_alloc((p->tri.nv + 1) * sizeof *id);
  for (uint32_t v = 0; v < p->tri.nv; v++) id[v] = NONE;
  for (size_t v = 0; v < p->graph.node.len; v++)
    if (p->graph.node.data[v] < model_points(p->in->model)) id[v] = p->graph.node.data[v];
  for (size_t c = 0; c < p->curve.len; c++) {
    size_t k = mesh1d_index(p->curves, p->curve.data[c]);
    for (uint32_t i = p->start.data[c]; i < p->start.data[c + 1]; i++)
      id[p->chain.data[i]] = edge_nodes_at(nodes, p->in->model, p->curves, k, i - p->start.data[c]);
  }
  return id;
}

// Make room in the meshes of the faces. owner[v] gets the face, as an index into p->face, of a vertex without a node.
static void make_room(const FaceCluster *p, const uint32_t *id, uint32_t *owner, FaceMesh *face)
{
  const Tri *t = &p->tri;
  size_t *count = mem_zalloc(2 * p->face.len * sizeof *count), *own = count + p->face.len;
  memset(owner, 0xff, t->nv * sizeof *owner);
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    count[t->region[k] - 1]++;
    for (EdgeId e = 3 * k; e < 3 * k + 3; e++)
      if (id[t->vert[e]] == NONE) owner[t->vert[e]] = t->region[k] - 1;
  }
  for (uint32_t v = 0; v < t->nv; v++)
    if (owner[v] != NONE) own[owner[v]]++;
  for (size_t k = 0; k < p->face.len; k++) {
    FaceMesh *f = &face[p->face.data[k]];
    *f = (FaceMesh){.own = mem_alloc(own[k] * sizeof *f->own),
                    .size = mem_alloc(own[k] * sizeof *f->size),
                    .tri = mem_alloc(3 * count[k] * sizeof *f->tri)};
  }
  free(count);
}

void face_cluster_extract(const FaceCluster *p, const EdgeNodes *nodes, FaceMesh *face)
{
  const Tri *t = &p->tri;
  uint32_t *id = known_nodes(p, nodes), *owner = mem_alloc((t->nv + 1) * sizeof *owner);
  make_room(p, id, owner, face);
  for (uint32_t v = 0; v < t->nv; v++) {
    if (owner[v] == NONE) continue;
    FaceMesh *f = &face[p->face.data[owner[v]]];
    id[v] = (uint32_t)(nodes->n + f->nown);
    f->size[f->nown] = p->size[v];
    f->own[f->nown++] = face_cluster__place(p, v);
  }
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    size_t which = p->face.data[t->region[k] - 1];
    FaceMesh *f = &face[which];
    bool mirror = vec3_dot(model_face_at(p->in->model, which)->normal, p->frame->normal) < 0;
    for (uint32_t i = 0; i < 3; i++) f->tri[3 * f->ntri + (mirror ? (3 - i) % 3 : i)] = id[t->vert[3 * k + i]];
    f->ntri++;
  }
  free(owner);
  free(id);
}
