// mesh2d.c - one plane face: boundary nodes to triangulation to refined and recombined mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh2d.h"

#include "base/map.h"
#include "base/thread.h"
#include "tri/refine.h"
#include "tri/tri.h"

// ---- numbering of the nodes of points and curves ------------------------------------------------------------------
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

static uint32_t point_node(const Model *m, int tag)
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
  if (i == 0) return point_node(m, c->begin);
  if (i + 1 == curves->curve[k].n) return point_node(m, c->end);
  return en->first[k] + (uint32_t)i - 1;
}

// ---- one face -------------------------------------------------------------------------------------------------------
typedef struct {
  const Mesh2dInput *in;
  const EdgeNodes *nodes;
  FaceMesh *face;
  Diag **diag;       // one collecting sink per face
  size_t *order;     // faces, largest first
  SizeEval **eval;   // one per worker
} Driver;

// The plane straight-line graph of a face. Local vertex i is global node node[i] at xy[2i], xy[2i+1].
typedef struct {
  Map local;         // global node -> local vertex
  U32Vec node;
  DoubleVec xy;
  U32Vec ends;       // 2 per segment, local vertices
  IntVec curve;      // per segment: tag of its curve
  Vec(bool) embedded;// per segment: inside the face, does not bound it
} Graph;

static void graph_free(Graph *g)
{
  map_free(&g->local);
  vec_free(&g->node);
  vec_free(&g->xy);
  vec_free(&g->ends);
  vec_free(&g->curve);
  vec_free(&g->embedded);
}

static uint32_t graph_vertex(Graph *g, const Face *f, const EdgeNodes *en, uint32_t node)
{
  bool added;
  uint32_t *slot = map_slot(&g->local, node, (uint32_t)g->node.len, &added);
  if (added) {
    Vec2 q = face_to_plane(f, en->xyz[node]);
    vec_push(&g->node, node);
    vec_push(&g->xy, q.x);
    vec_push(&g->xy, q.y);
  }
  return *slot;
}

static void graph_add_curve(Graph *g, const Driver *d, const Face *f, int tag, bool embedded)
{
  const Model *m = d->in->model;
  size_t k = mesh1d_index(d->in->curves, tag);
  const CurveMesh *cm = &d->in->curves->curve[k];
  for (size_t i = 0; i + 1 < cm->n; i++) {
    uint32_t a = graph_vertex(g, f, d->nodes, edge_nodes_at(d->nodes, m, d->in->curves, k, i));
    uint32_t b = graph_vertex(g, f, d->nodes, edge_nodes_at(d->nodes, m, d->in->curves, k, i + 1));
    vec_push(&g->ends, a);
    vec_push(&g->ends, b);
    vec_push(&g->curve, tag < 0 ? -tag : tag);
    vec_push(&g->embedded, embedded);
  }
}

static int compare_abs(const void *a, const void *b)
{
  int x = abs(*(const int *)a), y = abs(*(const int *)b);
  return (x > y) - (x < y);
}

// Boundary curves (one that the loops run along twice is a slit: it lies inside), embedded curves, embedded points.
static void graph_build(Graph *g, const Driver *d, const Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(d->in->model, f, &curve, &start);
  qsort(curve.data, curve.len, sizeof *curve.data, compare_abs);
  for (size_t i = 0, j; i < curve.len; i = j) {
    for (j = i; j < curve.len && abs(curve.data[j]) == abs(curve.data[i]);) j++;
    graph_add_curve(g, d, f, curve.data[i], (j - i) % 2 == 0);
  }
  for (size_t i = 0; i < f->embedded_curves.len; i++) {
    int tag = f->embedded_curves.data[i];
    if (!curve.len || !bsearch(&tag, curve.data, curve.len, sizeof tag, compare_abs)) graph_add_curve(g, d, f, tag, true);
  }
  for (size_t i = 0; i < f->embedded_points.len; i++) {
    uint32_t node = point_node(d->in->model, f->embedded_points.data[i]);
    if (node != NONE) graph_vertex(g, f, d->nodes, node);
  }
  vec_free(&curve);
  vec_free(&start);
}

static SrcLoc curve_loc(const Model *m, int tag)
{
  const Curve *c = model_curve(m, tag);
  return c ? c->loc : NO_LOC;
}

static void report_crossing(const Model *m, const Face *f, const Graph *g, const TriSegEvent *e, Diag *diag)
{
  int a = g->curve.data[e->a], b = e->b == NONE ? 0 : g->curve.data[e->b];
  Vec3 p = face_from_plane(f, (Vec2){e->p[0], e->p[1]});
  const char *what = e->what == TRI_SEG_CROSSES ? "crosses" : "runs along";
  if (a == b)
    diag_error(diag, curve_loc(m, a), "curve %d %s itself at (%g, %g, %g), on surface %d", a, what, p.x, p.y, p.z, f->tag);
  else
    diag_error(diag, curve_loc(m, a), "curve %d %s curve %d at (%g, %g, %g), on surface %d", a, what, b, p.x, p.y, p.z,
               f->tag);
  if (a != b && b) diag_note(diag, curve_loc(m, b), "curve %d is defined here", b);
}

// Force the segments; false after errors. One message per pair of curves, three at most.
static bool recover(Tri *t, const Graph *g, const Model *m, const Face *f, Diag *diag)
{
  TriSegEvents events = {0};
  tri_insert_segments(t, g->ends.data, NULL, g->curve.len, &events);
  int said = 0;
  Map pairs = {0};
  for (size_t i = 0; i < events.len; i++) {
    const TriSegEvent *e = &events.data[i];
    if (e->what == TRI_SEG_CROSSES || e->what == TRI_SEG_OVERLAPS) {
      bool fresh;
      uint32_t ca = (uint32_t)g->curve.data[e->a], cb = e->b == NONE ? 0 : (uint32_t)g->curve.data[e->b];
      map_slot(&pairs, map_pair(ca, cb), 1, &fresh);
      if (fresh && said++ < 3) report_crossing(m, f, g, e, diag);
    } else if (e->what == TRI_SEG_VERTEX) {
      Vec3 p = face_from_plane(f, (Vec2){tri_xy(t, e->v)[0], tri_xy(t, e->v)[1]});
      if (said++ < 3)
        diag_error(diag, curve_loc(m, g->curve.data[e->a]),
                   "curve %d passes through a node that is not its own at (%g, %g, %g), on surface %d",
                   g->curve.data[e->a], p.x, p.y, p.z, f->tag);
    }
  }
  map_free(&pairs);
  vec_free(&events);
  return said == 0;
}

// Embedded points and curves must lie in the face: every segment and vertex needs a triangle of the face beside it.
static bool embedded_inside(const Tri *t, const Graph *g, const Face *f, Diag *diag)
{
  bool *seen = mem_zalloc((g->node.len + g->curve.len) * sizeof *seen), good = true;
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    for (EdgeId e = 3 * k; e < 3 * k + 3; e++) {
      if (t->vert[e] < g->node.len) seen[t->vert[e]] = true;
      if (tri_is_segment(t, e)) seen[g->node.len + t->seg[e]] = true;
    }
  }
  for (size_t i = 0; i < g->curve.len && good; i++) {
    if (seen[g->node.len + i]) continue;
    const double *p = &g->xy.data[2 * g->ends.data[2 * i]];
    Vec3 q = face_from_plane(f, (Vec2){p[0], p[1]});
    diag_error(diag, f->loc, "%s curve %d is outside surface %d near (%g, %g, %g)",
               g->embedded.data[i] ? "embedded" : "boundary", g->curve.data[i], f->tag, q.x, q.y, q.z);
    good = false;
  }
  for (size_t i = 0; i < g->node.len && good; i++) {
    if (seen[i]) continue;
    Vec3 q = face_from_plane(f, (Vec2){g->xy.data[2 * i], g->xy.data[2 * i + 1]});
    diag_error(diag, f->loc, "embedded point at (%g, %g, %g) is outside surface %d", q.x, q.y, q.z, f->tag);
    good = false;
  }
  free(seen);
  return good;
}

// Distinct nodes at one place cannot both be vertices: name the place.
static bool no_duplicates(const U32Vec *dup, const Graph *g, const Face *f, Diag *diag)
{
  if (!dup->len) return true;
  const double *p = &g->xy.data[2 * dup->data[0]];
  Vec3 q = face_from_plane(f, (Vec2){p[0], p[1]});
  diag_error(diag, f->loc, "surface %d has %zu nodes that coincide with others, the first at (%g, %g, %g)", f->tag,
             dup->len, q.x, q.y, q.z);
  diag_note(diag, NO_LOC, "curves that are to be joined must share their end points; Coherence; merges equal ones");
  return false;
}

// The empty mesh: boundary recovered, outside removed [book §4.4.1, §4.4.2].
static bool empty_mesh(Tri *t, const Graph *g, const Driver *d, const Face *f, Diag *diag)
{
  U32Vec dup = {0};
  TriBuild how = {.threads = 1, .duplicates = &dup};
  TriBuildResult r = tri_build(t, g->xy.data, g->node.len, &how);
  bool good = r == TRI_BUILD_GOOD;
  if (r == TRI_BUILD_NOT_FINITE)
    diag_error(diag, f->loc, "surface %d has a node whose coordinates are not finite numbers", f->tag);
  if (r == TRI_BUILD_TOO_MANY) diag_error(diag, f->loc, "surface %d has too many nodes", f->tag);
  good = good && no_duplicates(&dup, g, f, diag);
  vec_free(&dup);
  if (good && t->dim < 2) {
    diag_error(diag, f->loc, "surface %d has no area: all its boundary nodes lie on a line", f->tag);
    good = false;
  }
  good = good && recover(t, g, d->in->model, f, diag);
  if (good) {
    TriCarve carve = {.embedded = g->embedded.data, .even_odd = true};
    if (tri_carve(t, &carve) == 0) {
      diag_error(diag, f->loc, "surface %d has no area", f->tag);
      good = false;
    }
  }
  return good && embedded_inside(t, g, f, diag);
}

static TriRefineParams refine_params(const Driver *d, const Face *f, SizeInPlane *here)
{
  const Options *o = d->in->options;
  TriRefineParams p = tri_refine_defaults();
  int algorithm = f->algorithm ? f->algorithm : o->Mesh_Algorithm;
  switch (algorithm) {
  case 1: p.algorithm = REFINE_ADAPT; break;
  case 3: p.algorithm = REFINE_EMPTY; break;
  case 2:
  case 5: p.algorithm = REFINE_DELAUNAY; break;
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

// Vertices and triangles inside the face to node ids.
static void extract(const Tri *t, const Graph *g, const Driver *d, const Face *f, FaceMesh *out)
{
  uint32_t nlocal = (uint32_t)g->node.len, base = (uint32_t)d->nodes->n;
  uint32_t *id = mem_alloc(t->nv * sizeof *id);
  size_t ntri = 0;
  for (uint32_t v = 0; v < t->nv; v++) id[v] = v < nlocal ? g->node.data[v] : NONE;
  for (TriId k = 0; k < t->nt; k++) ntri += tri_is_inside(t, k);
  out->tri = mem_alloc(3 * ntri * sizeof *out->tri);
  out->own = mem_alloc((t->nv - nlocal) * sizeof *out->own);
  for (TriId k = 0; k < t->nt; k++)
    if (tri_is_inside(t, k))
      for (EdgeId e = 3 * k; e < 3 * k + 3; e++)
        if (id[t->vert[e]] == NONE) id[t->vert[e]] = base; // used: numbered below, in order of vertices
  for (uint32_t v = nlocal; v < t->nv; v++) {
    if (id[v] == NONE) continue;
    id[v] = base + (uint32_t)out->nown;
    out->own[out->nown++] = face_from_plane(f, (Vec2){tri_xy(t, v)[0], tri_xy(t, v)[1]});
  }
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    for (int i = 0; i < 3; i++) out->tri[3 * out->ntri + (size_t)i] = id[t->vert[3 * k + (uint32_t)i]];
    out->ntri++;
  }
  free(id);
}

static void mesh_plane_face(const Driver *d, const Face *f, SizeEval *eval, FaceMesh *out, Diag *diag)
{
  Graph g = {0};
  graph_build(&g, d, f);
  Tri t;
  tri_init(&t);
  if (empty_mesh(&t, &g, d, f, diag)) {
    SizeInPlane here = {eval, f};
    TriRefineParams p = refine_params(d, f, &here);
    TriRefineStats s = tri_refine(&t, &p);
    size_eval_report(eval, diag);
    if (s.outcome == REFINE_LIMIT) {
      diag_error(diag, f->loc, "surface %d would have more than %zu triangles (Mesh.MaxElements, -max_elements)", f->tag,
                 p.max_triangles);
      out->failed = true;
    } else {
      extract(&t, &g, d, f, out);
    }
  } else {
    out->failed = true;
  }
  tri_free(&t);
  graph_free(&g);
}

// ---- all faces --------------------------------------------------------------------------------------------------------
static void mesh_one(void *ctx, size_t i, int worker)
{
  Driver *d = ctx;
  size_t k = d->order[i];
  const Face *f = model_face_at(d->in->model, k);
  check_context("mesh 2D", f->tag);
  mesh_plane_face(d, f, d->eval[worker], &d->face[k], d->diag[k]);
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

size_t mesh2d_run(const Mesh2dInput *in, const EdgeNodes *nodes, FaceMesh *face)
{
  size_t n = model_faces(in->model), failed = 0;
  int workers = thread_count(in->threads);
  Driver d = {in, nodes, face, mem_alloc(n * sizeof(Diag *)), order_of_faces(in), mem_alloc((size_t)workers * sizeof(SizeEval *))};
  for (int w = 0; w < workers; w++) d.eval[w] = size_eval_new(in->size);
  for (size_t k = 0; k < n; k++) {
    face[k] = (FaceMesh){0};
    d.diag[k] = diag_child(in->diag);
  }
  thread_for(n, in->threads, mesh_one, &d);
  for (size_t k = 0; k < n; k++) {
    diag_merge(in->diag, d.diag[k]);
    failed += face[k].failed;
  }
  for (int w = 0; w < workers; w++) size_eval_free(d.eval[w]);
  free(d.eval);
  free(d.diag);
  free(d.order);
  return failed;
}

void face_mesh_free(FaceMesh *f)
{
  free(f->own);
  free(f->tri);
  free(f->quad);
  *f = (FaceMesh){0};
}
