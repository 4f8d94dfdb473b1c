// mesh2d_estimate.c - how many elements the faces will get, before they are meshed
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh2d_estimate.h"

#include <math.h>

#include "base/mem.h"
#include "base/thread.h"
#include "mesh/face_graph.h"
#include "mesh/face_quads.h"

// ---- the boundary of one face -----------------------------------------------------------------------------------------
typedef struct {
  Vec2 a, b;
  double length;
  int curve;
  bool embedded;
} Edge;

typedef struct {
  const Mesh2dInput *in;
  const Face *face;
  Vec(Edge) edge;
  Vec2 lo, hi;
} Outline;

static void add_curve(void *ctx, int tag, bool embedded)
{
  Outline *o = ctx;
  const CurveMesh *cm = mesh1d_curve(o->in->curves, tag);
  for (uint32_t i = 0; cm && i + 1 < cm->n; i++) {
    Edge e = {face_to_plane(o->face, cm->p[i]), face_to_plane(o->face, cm->p[i + 1]), 0, abs(tag), embedded};
    e.length = vec2_length(vec2_sub(e.b, e.a));
    if (!(e.length > 0)) continue;
    vec_push(&o->edge, e);
    o->lo = (Vec2){fmin(o->lo.x, fmin(e.a.x, e.b.x)), fmin(o->lo.y, fmin(e.a.y, e.b.y))};
    o->hi = (Vec2){fmax(o->hi.x, fmax(e.a.x, e.b.x)), fmax(o->hi.y, fmax(e.a.y, e.b.y))};
  }
}

static void add_point(void *ctx, uint32_t node) { (void)ctx, (void)node; }

static const Edge *shortest_edge(const Outline *o)
{
  const Edge *e = o->edge.data;
  for (size_t i = 1; i < o->edge.len; i++)
    if (o->edge.data[i].length < e->length) e = &o->edge.data[i];
  return e;
}

// ---- sampling ----------------------------------------------------------------------------------------------------------
// Where a line of the grid crosses an edge.
typedef struct {
  double at, length;
  uint32_t line;
  bool embedded;
} Crossing;
typedef Vec(Crossing) Crossings;

// n x n cells over the box of the outline; per cell whether its middle is inside, and the sum of the lengths of the boundary's edges
// seen from there along the axes, weighted by the inverse distance.
typedef struct {
  const Outline *o;
  size_t n;
  Vec2 step;
  bool *inside;
  double *sum, *weight;
} Grid;

static int compare_crossings(const void *a, const void *b)
{
  const Crossing *p = a, *q = b;
  if (p->line != q->line) return p->line < q->line ? -1 : 1;
  return (p->at > q->at) - (p->at < q->at);
}

// Crossings of the middle lines of the rows, or of the columns: x and y change places.
static void find_crossings(const Grid *g, bool columns, Crossings *c)
{
  double lo = columns ? g->o->lo.x : g->o->lo.y, step = columns ? g->step.x : g->step.y;
  for (size_t i = 0; i < g->o->edge.len; i++) {
    const Edge *e = &g->o->edge.data[i];
    Vec2 a = columns ? (Vec2){e->a.y, e->a.x} : e->a, b = columns ? (Vec2){e->b.y, e->b.x} : e->b;
    double first = ceil((fmin(a.y, b.y) - lo) / step - 0.5), last = ceil((fmax(a.y, b.y) - lo) / step - 0.5);
    for (double k = fmax(first, 0); k < last && k < (double)g->n; k++) {
      double t = (lo + (k + 0.5) * step - a.y) / (b.y - a.y);
      vec_push(c, ((Crossing){a.x + t * (b.x - a.x), e->length, (uint32_t)k, e->embedded}));
    }
  }
  if (c->len) qsort(c->data, c->len, sizeof *c->data, compare_crossings);
}

static void scan(Grid *g, bool columns)
{
  Crossings c = {0};
  find_crossings(g, columns, &c);
  double lo = columns ? g->o->lo.y : g->o->lo.x, step = columns ? g->step.y : g->step.x;
  for (size_t i = 0, k = 0; k < g->n; k++) {
    bool inside = false;
    for (size_t s = 0; s < g->n; s++) {
      double at = lo + ((double)s + 0.5) * step;
      for (; i < c.len && c.data[i].line == k && c.data[i].at <= at; i++) inside ^= !c.data[i].embedded;
      size_t cell = columns ? s * g->n + k : k * g->n + s;
      if (!columns) g->inside[cell] = inside;
      if (!inside || i == 0 || i == c.len) continue;
      double before = 1 / fmax(at - c.data[i - 1].at, 1e-3 * step), after = 1 / fmax(c.data[i].at - at, 1e-3 * step);
      g->sum[cell] += before * c.data[i - 1].length + after * c.data[i].length;
      g->weight[cell] += before + after;
    }
    while (i < c.len && c.data[i].line == k) i++;
  }
  vec_free(&c);
}

// What one face comes to, and where it is densest.
typedef struct {
  double elements, density, h;
  Vec2 at;
  int curve;    // whose edges make it so, or 0: the size there
} Estimate;

enum { BATCH_OF_CELLS = 64, FIRST_GRID = 16, LAST_GRID = 2048 };

static void take_cells(Grid *g, const size_t *cell, const Vec2 *at, size_t n, SizeInPlane *size, bool extend, Estimate *e)
{
  double h[BATCH_OF_CELLS];
  size_in_plane_batch(size, at, n, h);
  for (size_t i = 0; i < n; i++) {
    bool handed = extend && g->weight[cell[i]] > 0 && g->sum[cell[i]] / g->weight[cell[i]] < h[i];
    if (handed) h[i] = g->sum[cell[i]] / g->weight[cell[i]];
    double density = 4 / (sqrt(3) * h[i] * h[i]);
    e->elements += density * g->step.x * g->step.y;
    if (density > e->density) *e = (Estimate){e->elements, density, h[i], at[i], handed};
  }
}

static Estimate sample_face(const Outline *o, size_t n, SizeInPlane *size, bool extend)
{
  Grid g = {.o = o, .n = n, .step = {(o->hi.x - o->lo.x) / (double)n, (o->hi.y - o->lo.y) / (double)n}};
  Estimate e = {0};
  if (!(g.step.x > 0 && g.step.y > 0)) return e;
  g.inside = mem_zalloc(n * n * sizeof *g.inside);
  g.sum = mem_zalloc(n * n * sizeof *g.sum);
  g.weight = mem_zalloc(n * n * sizeof *g.weight);
  scan(&g, false);
  if (extend) scan(&g, true);
  size_t cell[BATCH_OF_CELLS], m = 0;
  Vec2 at[BATCH_OF_CELLS];
  for (size_t k = 0; k < n * n; k++) {
    if (g.inside[k]) {
      cell[m] = k;
      at[m++] = (Vec2){o->lo.x + ((double)(k % n) + 0.5) * g.step.x, o->lo.y + ((double)(k / n) + 0.5) * g.step.y};
    }
    if (m == BATCH_OF_CELLS || (m && k + 1 == n * n)) take_cells(&g, cell, at, m, size, extend, &e), m = 0;
  }
  free(g.inside);
  free(g.sum);
  free(g.weight);
  return e;
}

// Finer grids until two agree, as long as cells are few against elements.
static Estimate sample_finer(const Outline *o, SizeInPlane *size, bool extend)
{
  Estimate e = sample_face(o, FIRST_GRID, size, extend);
  for (size_t n = 2 * FIRST_GRID + 1; n <= LAST_GRID && 100 * (double)(n * n) < e.elements; n = 2 * n + 1) { // no common lines
    double before = e.elements;
    e = sample_face(o, n, size, extend);
    if (fabs(e.elements - before) < 0.02 * before) break;
  }
  return e;
}

// ---- one face ----------------------------------------------------------------------------------------------------------
// The cells of a grid between three or four curves; 0 if the face is not of that kind.
static double grid_elements(const Mesh2dInput *in, const Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(in->model, f, &curve, &start);
  double n[4] = {0}, cells = 0;
  if (start.len == 2 && (curve.len == 3 || curve.len == 4)) {
    for (size_t i = 0; i < curve.len; i++) {
      const CurveMesh *cm = mesh1d_curve(in->curves, curve.data[i]);
      n[i] = cm && cm->n ? cm->n - 1 : 0;
    }
    cells = curve.len == 4 ? n[0] * n[1] : n[0] * fmin(n[1], fmax(n[0], n[2]));
  }
  vec_free(&curve);
  vec_free(&start);
  return face_is_recombined(f, in->options) ? cells : 2 * cells;
}

// So few even if all of the box were covered by triangles of the shortest edge: true, with that bound.
static bool is_small(const Outline *o, const SizeField *size, bool extend, double limit, Estimate *e)
{
  double h;
  const Edge *least = shortest_edge(o);
  if (!size_is_constant(size, o->face, &h) || o->face->sphere) return false;
  if (extend) h = fmin(h, least->length);
  e->elements = 4 / (sqrt(3) * h * h) * (o->hi.x - o->lo.x) * (o->hi.y - o->lo.y);
  return e->elements < limit;
}

typedef struct {
  const Mesh2dInput *in;
  Estimate *estimate; // per face
  SizeEval **eval;    // per worker
  Diag **sink;        // per face, made where its sizes are bad
} Estimator;

static void estimate_one(void *ctx, size_t k, int worker)
{
  const Estimator *d = ctx;
  const Mesh2dInput *in = d->in;
  const Face *f = model_face_at(in->model, k);
  Estimate *e = &d->estimate[k];
  bool grid = f->transfinite || (f->extruded_curve && f->layers.n > 0);
  if (grid) e->elements = grid_elements(in, f);
  if ((grid && e->elements > 0) || !f->planar || (f->united && f->united != f->tag)) return;
  static const FaceVisitor visitor = {add_curve, add_point};
  Outline o = {.in = in, .face = f, .lo = {INFINITY, INFINITY}, .hi = {-INFINITY, -INFINITY}};
  face_graph_visit(in->model, f, &visitor, &o);
  SizeInPlane size = {d->eval[worker], f, 0};
  bool extend = mesh2d_refine_params(in->options, f, &size).extend_from_boundary;
  double limit = in->options->Mesh_MaxElements / (100 * (double)model_faces(in->model));
  if (o.edge.len && !is_small(&o, in->size, extend, limit, e)) {
    *e = sample_finer(&o, &size, extend);
    if (e->curve) e->curve = shortest_edge(&o)->curve;
    if (face_is_recombined(f, in->options)) e->elements *= sqrt(3) / 4;
  }
  Diag *sink = diag_child(in->diag);
  if (size_eval_report(size.eval, sink)) d->sink[k] = sink;
  else diag_free(sink);
  vec_free(&o.edge);
}

static double estimate_all(Estimator *d)
{
  const Mesh2dInput *in = d->in;
  size_t n = model_faces(in->model);
  int workers = thread_count(in->threads);
  d->estimate = mem_zalloc((n + 1) * sizeof *d->estimate);
  d->sink = mem_zalloc((n + 1) * sizeof *d->sink);
  d->eval = mem_alloc((size_t)workers * sizeof *d->eval);
  for (int i = 0; i < workers; i++) d->eval[i] = size_eval_new(in->size);
  thread_for(n, in->threads, estimate_one, d);
  for (int i = 0; i < workers; i++) size_eval_free(d->eval[i]);
  free(d->eval);
  double total = 0;
  for (size_t k = 0; k < n; k++) total += d->estimate[k].elements;
  return total;
}

// What was met in the first face of bad sizes; true if there was one.
static bool merge_messages(Estimator *d)
{
  bool bad = false;
  for (size_t k = 0; k < model_faces(d->in->model); k++) {
    if (!d->sink[k]) continue;
    if (!bad) diag_merge(d->in->diag, d->sink[k]);
    else diag_free(d->sink[k]);
    bad = true;
  }
  free(d->sink);
  return bad;
}

// ---- the limit ------------------------------------------------------------------------------------------------------------
static void explain(const Mesh2dInput *in, const Face *f, const Estimate *e)
{
  if (!(e->density > 0)) {
    diag_note(in->diag, f->loc, "by the numbers of edges on its curves");
    return;
  }
  Str why = {0};
  SizeEval *eval = size_eval_new(in->size);
  Vec3 p = face_from_plane(f, e->at);
  const Curve *c = e->curve ? model_curve(in->model, e->curve) : NULL;
  if (c) {
    const CurveMesh *cm = mesh1d_curve(in->curves, e->curve);
    size_responsible(eval, NULL, c, curve_point(in->model, c, 0.5), &why);
    diag_note(in->diag, c->loc, "sizes come from its boundary, where curve %d has %u edges: fixed by %s", e->curve, cm->n - 1,
              str_text(&why));
  } else {
    size_responsible(eval, f, NULL, p, &why);
    diag_note(in->diag, NO_LOC, "at (%g, %g) the size %g is fixed by %s", p.x, p.y, e->h / face_plane_scale(f, e->at), str_text(&why));
  }
  size_eval_free(eval);
  str_free(&why);
}

bool mesh2d_is_affordable(const Mesh2dInput *in)
{
  static const double margin = 2;
  Estimator d = {.in = in};
  double total = estimate_all(&d), limit = in->options->Mesh_MaxElements;
  if (merge_messages(&d)) {
    free(d.estimate);
    return false;
  }
  log_debug(in->diag, "about %.3g elements are expected in the faces", total);
  bool good = total <= margin * limit;
  size_t worst = 0;
  for (size_t k = 1; !good && k < model_faces(in->model); k++)
    if (d.estimate[k].elements > d.estimate[worst].elements) worst = k;
  if (!good) {
    const Face *f = model_face_at(in->model, worst);
    diag_error(in->diag, f->loc,
               "the surfaces would get about %.3g elements, more than Mesh.MaxElements = %g (-max_elements); surface %d alone %.3g", total,
               limit, f->tag, d.estimate[worst].elements);
    explain(in, f, &d.estimate[worst]);
  }
  free(d.estimate);
  return good;
}
