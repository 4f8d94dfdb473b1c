// mesh2d.c - one plane face: boundary nodes to triangulation to refined and recombined mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh2d.h"

#include "base/thread.h"
#include "mesh/face_copy.h"
#include "mesh/face_cross.h"
#include "mesh/face_graph.h"
#include "mesh/face_quads.h"
#include "mesh/filling_mesh.h"
#include "mesh/structured.h"
#include "tri/refine.h"
#include "tri/tri.h"

// ---- one face -------------------------------------------------------------------------------------------------------
typedef struct {
  const Mesh2dInput *in;
  const EdgeNodes *nodes;
  FaceMesh *face;
  Diag **diag;       // one collecting sink per face
  const size_t *order; // faces, largest first
  SizeEval **eval;   // one per worker
  uint32_t *source;  // per face: the one whose mesh it copies once that is there, or NONE
} Driver;

TriRefineParams mesh2d_refine_params(const Options *o, const Face *f, SizeInPlane *here)
{
  TriRefineParams p = tri_refine_defaults();
  int algorithm = f->algorithm ? f->algorithm : o->Mesh_Algorithm;
  switch (algorithm) {
  case 1: p.algorithm = REFINE_ADAPT; break;
  case 3: p.algorithm = REFINE_EMPTY; break;
  case 2:
  case 5: p.algorithm = REFINE_DELAUNAY; break;
  case 8:
  case 11: p.algorithm = REFINE_FRONT_QUAD; break;
  case 9: p.algorithm = REFINE_PACK; break;
  default: p.algorithm = REFINE_FRONTAL; break;
  }
  int extend = f->size_from_boundary >= 0 ? f->size_from_boundary : o->Mesh_MeshSizeExtendFromBoundary;
  p.extend_from_boundary = extend == 1 || extend == 2 || extend == -2;
  p.size = size_in_plane;
  p.size_ctx = here;
  p.smoothing = o->Mesh_Smoothing;
  p.optimize = o->Mesh_OptimizeLevel;
  p.max_triangles = (size_t)o->Mesh_MaxElements;
  if (p.algorithm == REFINE_EMPTY) p.smoothing = p.optimize = 0;
  return p;
}

// Vertices and triangles inside the face to node ids, after what boundary layers have put there.
static void extract(const Tri *t, const FaceGraph *g, const Driver *d, const FaceMap *map, const double *size, FaceMesh *out)
{
  uint32_t nlocal = (uint32_t)g->node.len, base = (uint32_t)d->nodes->n;
  uint32_t *id = mem_alloc(t->nv * sizeof *id);
  size_t ntri = 0;
  for (uint32_t v = 0; v < t->nv; v++) id[v] = v < nlocal ? g->node.data[v] : NONE;
  for (TriId k = 0; k < t->nt; k++) ntri += tri_is_inside(t, k);
  size_t before = out->nown, room = before + t->nv - nlocal;
  out->tri = mem_realloc(out->tri, 3 * (out->ntri + ntri) * sizeof *out->tri);
  out->own = mem_realloc(out->own, room * sizeof *out->own);
  out->size = mem_alloc(room * sizeof *out->size);
  for (size_t i = 0; i < before; i++) out->size[i] = NAN;
  for (TriId k = 0; k < t->nt; k++)
    if (tri_is_inside(t, k))
      for (EdgeId e = 3 * k; e < 3 * k + 3; e++)
        if (id[t->vert[e]] == NONE) id[t->vert[e]] = base; // used: numbered below, in order of vertices
  for (uint32_t v = nlocal; v < t->nv; v++) {
    if (id[v] == NONE) continue;
    id[v] = base + (uint32_t)out->nown;
    Vec2 q = {tri_xy(t, v)[0], tri_xy(t, v)[1]};
    out->size[out->nown] = map->filling ? size[v] * filling_stretch(map->filling, q) : size[v];
    out->own[out->nown++] = face_map_point(map, q);
  }
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    for (int i = 0; i < 3; i++) out->tri[3 * out->ntri + (size_t)i] = id[t->vert[3 * k + (uint32_t)i]];
    out->ntri++;
  }
  free(id);
}

// Algorithms that are not there yet are replaced, and said so.
static void warn_of_algorithm(const Face *f, const Options *o, Diag *diag)
{
  int a = f->algorithm ? f->algorithm : o->Mesh_Algorithm;
  if (a == 7)
    diag_warning(diag, f->loc, "surface %d: algorithm 7 (BAMG) is not available; Frontal-Delaunay is used", f->tag);
  if (a == 11)
    diag_warning(diag, f->loc, "surface %d: algorithm 11 (quasi-structured) is not available; Frontal-Delaunay for quads is used", f->tag);
}

// The sizes given at embedded points bound what their vertices carry; NULL without any. The caller frees the array.
static double *embedded_sizes(const Driver *d, const Face *f, const FaceGraph *g, SizeEval *eval)
{
  double *size = NULL;
  for (size_t i = 0; i < f->embedded_points.len; i++) {
    const Point *p = model_point(d->in->model, f->embedded_points.data[i]);
    uint32_t node = p && p->lc < LC_UNSET ? edge_nodes_point(d->in->model, p->tag) : NONE;
    uint32_t v = node == NONE ? NONE : map_get(&g->local, node);
    if (v == NONE) continue;
    if (!size) {
      size = mem_alloc(g->node.len * sizeof *size);
      for (size_t j = 0; j < g->node.len; j++) size[j] = INFINITY;
    }
    size[v] = (g->coarse ? 2 : 1) * size_at_point(eval, p) * face_plane_scale(f, face_to_plane(f, p->xyz));
  }
  return size;
}

// A face that is not meshed together with its neighbours must leave their common curves alone, whatever angle is wanted.
static bool keep_whole(void *ctx, VertId u, VertId v, double at, Vec2 *point)
{
  (void)ctx, (void)u, (void)v, (void)at, (void)point;
  return false;
}

// One way to mesh a face.
typedef struct {
  bool coarse;     // every second boundary node is left out, and put back at the end
  double finer;    // what sizes inside are multiplied by
  bool adapt;      // by MeshAdapt, whatever the algorithm
  size_t excess;   // result: triangles left for want of pairs that are convex
} Attempt;

// Sizes in the plane of a face that is a filling, which are not the lengths on it.
static void set_filling_sizes(TriRefineParams *p, FaceMap *map, const Mesh1d *curves)
{
  if (p->extend_from_boundary) map->curves = curves;
  p->extend_from_boundary = false;
  p->size = filling_size;
  p->size_ctx = map;
}

// Refine the empty mesh t, which was made of g, and turn it into the mesh of the face. False as try_plane_face.
static bool fill_plane_face(const Driver *d, const FaceGraph *g, FaceMap *map, Tri *t, Attempt *attempt, FaceMesh *out, Diag *diag)
{
  const Options *o = d->in->options;
  const Face *f = map->face;
  SizeInPlane here = {map->eval, f, 0};
  TriRefineParams p = mesh2d_refine_params(o, f, &here);
  if (attempt->adapt) p.algorithm = REFINE_ADAPT;
  if (map->filling) set_filling_sizes(&p, map, d->in->curves);
  ScaledSize scaled = {p.size, p.size_ctx, face_quads_size_factor(f, o, g->coarse) * attempt->finer};
  if (scaled.factor != 1) {
    p.size = size_scaled;
    p.size_ctx = &scaled;
    p.carried_factor = attempt->finer * face_quads_single_factor(o, g->coarse); // a coarse boundary is of double size itself
  }
  double *sizes = NULL, *bound = embedded_sizes(d, f, g, map->eval);
  p.vertex_size = bound;
  p.sizes_out = &sizes;
  if (!map->filling && !face_is_recombined(f, o)) p.min_angle = o->Mesh_MinimumAngle;
  p.split = keep_whole;
  FaceCross cross = {0};
  face_cross_prepare(&cross, t, &p);
  TriRefineStats s = tri_refine(t, &p);
  free(bound);
  face_cross_free(&cross);
  if (!attempt->coarse) size_eval_report(map->eval, diag);
  bool valid = true;
  if (s.outcome == REFINE_LIMIT) {
    diag_error(diag, f->loc, "surface %d would have more than %zu triangles (Mesh.MaxElements, -max_elements)", f->tag,
               p.max_triangles);
    out->failed = true;
  } else if (face_is_recombined(f, o)) {
    for (size_t v = 0; v < t->nv; v++) sizes[v] /= scaled.factor / attempt->finer;
    FaceTriangles from = {t, g, map, {sizes, scaled.size, scaled.ctx, p.extend_from_boundary}};
    valid = face_quads(&from, o, (uint32_t)d->nodes->n, out, &attempt->excess, diag);
  } else {
    extract(t, g, d, map, sizes, out);
  }
  free(sizes);
  return valid;
}

// False, with nothing said and nothing made, if a coarse attempt gives no valid mesh: the coarse polygon of a curve of few edges may
// overlap itself or be far from the curve.
static bool try_plane_face(const Driver *d, size_t k, SizeEval *eval, Attempt *attempt, FaceMesh *out, Diag *diag)
{
  const Face *f = model_face_at(d->in->model, k);
  FaceGraph g = {.coarse = attempt->coarse};
  Filling filling;
  FaceMap map = {f, filling_wanted(&filling, d->in->model, f) ? &filling : NULL, eval, NULL};
  if (boundary_layers_on(d->in->layers, k))
    boundary_layers_fill(d->in->layers, k, d->in->curves, d->nodes, out, &g);
  else
    face_graph_add(&g, d->in->model, f, d->in->curves, d->nodes);
  if (map.filling) filling_place(&filling, d->in, f, d->nodes, &g);
  bool valid = true;
  Tri t;
  tri_init(&t);
  if (face_graph_mesh(&g, d->in->model, f, &t, diag))
    valid = fill_plane_face(d, &g, &map, &t, attempt, out, diag);
  else if (attempt->coarse)
    valid = false;
  else
    out->failed = true;
  tri_free(&t);
  face_graph_free(&g);
  return valid;
}

// Where triangles are left because nothing convex can be made of them, as in strips between edges much longer than the strip is wide,
// smaller or other ones may do. If not, the first attempt stands.
static void mesh_fine_enough(const Driver *d, size_t k, SizeEval *eval, FaceMesh *out, Diag *diag)
{
  static const Attempt way[] = {{.finer = 1}, {.finer = 0.7}, {.finer = 0.7, .adapt = true}, {.finer = 0.5}, {.finer = 0.5, .adapt = true}};
  FaceMesh first = {0};
  Diag *said = NULL;
  for (size_t i = 0; i < ARRAY_LEN(way); i++) {
    Attempt attempt = way[i];
    FaceMesh mesh = {0};
    Diag *now = diag_child(diag);
    try_plane_face(d, k, eval, &attempt, &mesh, now);
    bool good = !mesh.failed && attempt.excess == 0;
    if (i == 0 || good) {
      face_mesh_free(&first);
      diag_free(said);
      first = mesh;
      said = now;
      if (good || mesh.failed) break;
    } else {
      face_mesh_free(&mesh);
      diag_free(now);
    }
  }
  *out = first;
  diag_merge(diag, said);
}

// The area within the boundary nodes of face k; NAN if they bound nothing valid.
static double area_within(const Driver *d, size_t k, Diag *diag)
{
  const Face *f = model_face_at(d->in->model, k);
  FaceGraph g = {0};
  face_graph_add(&g, d->in->model, f, d->in->curves, d->nodes);
  Tri t;
  tri_init(&t);
  double sum = face_graph_mesh(&g, d->in->model, f, &t, diag) ? 0 : NAN;
  for (TriId i = 0; sum >= 0 && i < t.nt; i++) {
    if (!tri_is_inside(&t, i)) continue;
    const double *a = tri_xy(&t, t.vert[3 * i]), *b = tri_xy(&t, t.vert[3 * i + 1]), *c = tri_xy(&t, t.vert[3 * i + 2]);
    sum += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  tri_free(&t);
  face_graph_free(&g);
  return sum;
}

static double area_of(const Driver *d, const Face *f, const FaceMesh *mesh)
{
  double sum = 0;
  for (size_t n = 3; n <= 4; n++)
    for (size_t i = 0; i < (n == 3 ? mesh->ntri : mesh->nquad); i++) {
      const uint32_t *id = n == 3 ? mesh->tri + 3 * i : mesh->quad + 4 * i;
      Vec2 p[4];
      for (size_t k = 0; k < n; k++)
        p[k] = face_to_plane(f, id[k] < d->nodes->n ? d->nodes->xyz[id[k]] : mesh->own[id[k] - d->nodes->n]);
      for (size_t k = 1; k + 1 < n; k++) sum += 0.5 * vec2_cross(vec2_sub(p[k], p[0]), vec2_sub(p[k + 1], p[0]));
    }
  return sum;
}

// A coarse polygon may have a hole on its other side, or a corner of another loop: what is made of it does not fill the face then.
static bool fills_face(const Driver *d, size_t k, const FaceMesh *mesh)
{
  Diag *ignored = diag_child(d->in->diag);
  double want = area_within(d, k, ignored), has = area_of(d, model_face_at(d->in->model, k), mesh);
  diag_free(ignored);
  return !(fabs(has - want) > 1e-9 * fabs(want)) || mesh->failed;
}

static void mesh_plane_face(const Driver *d, size_t k, SizeEval *eval, FaceMesh *out, Diag *diag)
{
  const Face *f = model_face_at(d->in->model, k);
  warn_of_algorithm(f, d->in->options, diag);
  Filling filling;
  if (!boundary_layers_on(d->in->layers, k) && !filling_wanted(&filling, d->in->model, f) &&
      face_is_split(d->in->model, f, d->in->curves, d->in->options)) {
    Diag *said = diag_child(diag);
    Attempt attempt = {.coarse = true, .finer = 1};
    bool valid = try_plane_face(d, k, eval, &attempt, out, said);
    if (valid && !fills_face(d, k, out)) {
      face_mesh_free(out);
      *out = (FaceMesh){0};
      valid = false;
    }
    if (valid) {
      diag_merge(diag, said);
      size_eval_report(eval, diag); // after a failure the next attempt says it
      return;
    }
    diag_free(said);
  }
  mesh_fine_enough(d, k, eval, out, diag);
}

// ---- all faces --------------------------------------------------------------------------------------------------------
static void mesh_one(void *ctx, size_t i, int worker)
{
  Driver *d = ctx;
  size_t k = d->order[i];
  const Face *f = model_face_at(d->in->model, k);
  if (d->source[k] != NONE || (f->united && f->united != f->tag)) return; // its elements are those of another face
  check_context("mesh 2D", f->tag);
  if (structured_face(d->in, f, d->nodes, &d->face[k], d->diag[k])) return;
  if (extruded_face(d->in, f, d->nodes, &d->face[k], d->diag[k])) return;
  mesh_plane_face(d, k, d->eval[worker], &d->face[k], d->diag[k]);
}

// Copies after their sources; those that do not fit, and those that would wait for each other, are meshed on their own.
static void mesh_copies(Driver *d, size_t n)
{
  size_t left = 0;
  for (size_t i = 0; i < n; i++) left += d->source[d->order[i]] != NONE;
  while (left) {
    size_t before = left, waiting = NONE;
    for (size_t i = 0; i < n; i++) {
      size_t k = d->order[i], from = d->source[k];
      if (from == NONE) continue;
      waiting = k;
      if (d->source[from] != NONE) continue;
      bool copied = face_copy(d->in, model_face_at(d->in->model, k), d->nodes, &d->face[from], &d->face[k]);
      d->source[k] = NONE;
      if (!copied) mesh_one(d, i, 0);
      left--;
    }
    if (left == before) { // a ring
      d->source[waiting] = NONE;
      left--;
      for (size_t i = 0; i < n; i++)
        if (d->order[i] == waiting) mesh_one(d, i, 0);
    }
  }
}

typedef struct {
  double work;
  size_t face;
} Work;

static int compare_work(const void *a, const void *b)
{
  const Work *x = a, *y = b;
  if (x->work != y->work) return x->work > y->work ? -1 : 1;
  return (x->face > y->face) - (x->face < y->face);
}

// Largest first, by the number of boundary edges squared, as the number of triangles goes.
static size_t *order_of_faces(const Mesh2dInput *in)
{
  size_t n = model_faces(in->model), *order = mem_alloc(n * sizeof *order);
  Work *work = mem_alloc(n * sizeof *work);
  for (size_t k = 0; k < n; k++) {
    IntVec curve = {0}, start = {0};
    face_boundary(in->model, model_face_at(in->model, k), &curve, &start);
    double edges = 0;
    for (size_t i = 0; i < curve.len; i++)
      edges += (double)in->curves->curve[mesh1d_index(in->curves, curve.data[i])].n;
    work[k] = (Work){edges, k};
    vec_free(&curve);
    vec_free(&start);
  }
  qsort(work, n, sizeof *work, compare_work);
  for (size_t k = 0; k < n; k++) order[k] = work[k].face;
  free(work);
  return order;
}

// Copies among the n faces which[] of others among them.
static uint32_t *sources_of_copies(const Mesh2dInput *in, const size_t *which, size_t n)
{
  size_t all = model_faces(in->model);
  uint32_t *source = mem_alloc((all + 1) * sizeof *source);
  bool *here = mem_zalloc(all + 1);
  for (size_t i = 0; i < n; i++) here[which[i]] = true;
  for (size_t k = 0; k < all; k++) {
    const Face *f = model_face_at(in->model, k);
    bool asked = here[k] && (f->copy_of || f->periodic_master) && !boundary_layers_on(in->layers, k);
    source[k] = asked ? face_copy_source(in->model, f) : NONE;
    if (source[k] != NONE && !here[source[k]]) source[k] = NONE;
  }
  free(here);
  return source;
}

size_t mesh2d_run_some(const Mesh2dInput *in, const EdgeNodes *nodes, const size_t *which, size_t n, FaceMesh *face)
{
  int workers = thread_count(in->threads);
  Driver d = {.in = in,
              .nodes = nodes,
              .face = face,
              .diag = mem_zalloc((model_faces(in->model) + 1) * sizeof(Diag *)),
              .order = which,
              .eval = mem_alloc((size_t)workers * sizeof(SizeEval *))};
  for (int w = 0; w < workers; w++) d.eval[w] = size_eval_new(in->size);
  for (size_t i = 0; i < n; i++) {
    face[which[i]] = (FaceMesh){0};
    d.diag[which[i]] = diag_child(in->diag);
  }
  d.source = sources_of_copies(in, which, n);
  thread_for(n, in->threads, mesh_one, &d);
  mesh_copies(&d, n);
  free(d.source);
  size_t failed = 0;
  for (size_t k = 0; k < model_faces(in->model); k++) {
    if (!d.diag[k]) continue;
    diag_merge(in->diag, d.diag[k]);
    failed += face[k].failed;
  }
  for (int w = 0; w < workers; w++) size_eval_free(d.eval[w]);
  free(d.eval);
  free(d.diag);
  return failed;
}

size_t mesh2d_run(const Mesh2dInput *in, const EdgeNodes *nodes, FaceMesh *face)
{
  size_t *order = order_of_faces(in);
  size_t failed = mesh2d_run_some(in, nodes, order, model_faces(in->model), face);
  free(order);
  return failed;
}
