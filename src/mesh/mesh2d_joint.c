// mesh2d_joint.c - faces of one plane meshed as one triangulation, where boundary edges may have to be split
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh2d_joint.h"

#include "mesh/face_cross.h"
#include "mesh/face_graph.h"
#include "tri/refine.h"

// The faces of one plane, their common graph and triangulation.
typedef struct {
  const Mesh2dInput *in;
  Mesh1d *curves;
  const EdgeNodes *nodes;
  const Map *held;   // tags of curves that must stay whole
  Vec(size_t) face;  // indices of the faces of the plane
  const Face *frame; // the first of them: its plane coordinates are everybody's
  FaceGraph graph;
  U32Vec first;      // per segment: index of its edge in its curve's mesh
  Tri tri;
  uint32_t *region;  // per triangle of the empty mesh
  size_t nregion;
  uint32_t *owner;   // per region: index into face, or NONE
} Plane;

static void plane_free(Plane *p)
{
  vec_free(&p->face);
  face_graph_free(&p->graph);
  vec_free(&p->first);
  tri_free(&p->tri);
  free(p->region);
  free(p->owner);
}

static bool same_plane(const Face *f, const Face *g, double tolerance)
{
  Vec3 d = vec3_sub(f->origin, g->origin);
  return vec3_length(vec3_cross(f->normal, g->normal)) <= 1e-9 && fabs(vec3_dot(d, f->normal)) <= tolerance;
}

// ---- which region belongs to which face -----------------------------------------------------------------------------
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
static void find_regions(Plane *p)
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

static void region_edges(const Plane *p, RegionEdges *out)
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
static bool claim_regions(Plane *p, size_t k, const RegionEdges *edges, const size_t *begin)
{
  const Face *f = model_face_at(p->in->model, p->face.data[k]);
  Map odd = {0};
  bounding_curves(p->in->model, f, &odd);
  uint8_t *side = mem_alloc(p->nregion); // 0 outside f, 1 inside, 2 not seen yet
  memset(side, 2, p->nregion);
  U32Vec stack = {0};
  vec_push(&stack, 0);
  side[0] = 0;
  uint32_t other = NONE;
  while (stack.len) {
    uint32_t r = vec_pop(&stack);
    if (side[r]) {
      if (p->owner[r] != NONE) other = p->owner[r];
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
  if (other == NONE) return true;
  diag_error(p->in->diag, f->loc, "surfaces %d and %d overlap; they cannot be refined together",
             model_face_at(p->in->model, p->face.data[other])->tag, f->tag);
  return false;
}

static bool assign_regions(Plane *p)
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

// ---- splitting ----------------------------------------------------------------------------------------------------------
static bool is_fixed(const Curve *c)
{
  return c->transfinite || c->periodic_master || c->copy_of || c->layers.n > 0;
}

static Vec3 vertex_place(const Plane *p, VertId v)
{
  return face_from_plane(p->frame, (Vec2){tri_xy(&p->tri, v)[0], tri_xy(&p->tri, v)[1]});
}

// Parameter of vertex v on the curve of segment s.
static double vertex_parameter(const Plane *p, const Curve *c, uint32_t s, VertId v)
{
  const CurveMesh *cm = mesh1d_curve(p->curves, c->tag);
  uint32_t i = p->first.data[s];
  if (v == p->graph.ends.data[2 * s]) return cm->u[i];
  if (v == p->graph.ends.data[2 * s + 1]) return cm->u[i + 1];
  return curve_nearest(p->in->model, c, vertex_place(p, v));
}

static bool split_point(void *ctx, VertId u, VertId v, double at, Vec2 *point)
{
  Plane *p = ctx;
  EdgeId e = tri_find_edge(&p->tri, u, v);
  if (e == NONE || !tri_is_segment(&p->tri, e)) return false;
  uint32_t s = p->tri.seg[e];
  const Curve *c = model_curve(p->in->model, p->graph.curve.data[s]);
  if (is_fixed(c) || map_get(p->held, (uint64_t)c->tag) != NONE) return false;
  if (curve_is_straight(p->in->model, c)) {
    const double *a = tri_xy(&p->tri, u), *b = tri_xy(&p->tri, v);
    *point = (Vec2){a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1])};
    return true;
  }
  double ua = vertex_parameter(p, c, s, u), ub = vertex_parameter(p, c, s, v);
  *point = face_to_plane(p->frame, curve_point(p->in->model, c, ua + at * (ub - ua)));
  return true;
}

typedef struct {
  uint32_t seg;
  double along; // share of the chord of the 1D edge
  VertId v;
} SplitVertex;
typedef Vec(SplitVertex) SplitVertices;

static int compare_splits(const void *a, const void *b)
{
  const SplitVertex *x = a, *y = b;
  if (x->seg != y->seg) return x->seg < y->seg ? -1 : 1;
  if (x->along != y->along) return x->along < y->along ? -1 : 1;
  return (x->v > y->v) - (x->v < y->v);
}

// The vertices that refinement has put on segments, in order along each.
static void find_splits(const Plane *p, SplitVertices *out)
{
  const Tri *t = &p->tri;
  for (EdgeId e = 0; e < 3 * t->nt; e++) {
    if (tri_is_free(t, tri_of(e)) || !tri_is_segment(t, e) || t->vert[e] < p->graph.node.len) continue;
    uint32_t s = t->seg[e];
    const double *a = tri_xy(t, p->graph.ends.data[2 * s]), *b = tri_xy(t, p->graph.ends.data[2 * s + 1]);
    const double *q = tri_xy(t, t->vert[e]);
    double dx = b[0] - a[0], dy = b[1] - a[1];
    SplitVertex x = {s, ((q[0] - a[0]) * dx + (q[1] - a[1]) * dy) / (dx * dx + dy * dy), t->vert[e]};
    vec_push(out, x);
  }
  if (out->len) qsort(out->data, out->len, sizeof *out->data, compare_splits);
  size_t n = 0;
  for (size_t i = 0; i < out->len; i++)
    if (!n || out->data[n - 1].v != out->data[i].v) out->data[n++] = out->data[i];
  out->len = n;
}

// Give the curves their new nodes; chain[] lists the vertices of every changed curve from begin to end.
static void update_curves(Plane *p, const SplitVertices *splits, U32Vec *chain, U32Vec *chain_start, IntVec *changed)
{
  const FaceGraph *g = &p->graph;
  DoubleVec u = {0};
  size_t at = 0;
  for (uint32_t s = 0; s < g->curve.len;) {
    uint32_t end = s;
    const Curve *c = model_curve(p->in->model, g->curve.data[s]);
    const CurveMesh *cm = mesh1d_curve(p->curves, c->tag);
    vec_clear(&u);
    vec_push(chain_start, (uint32_t)chain->len);
    vec_push(changed, c->tag);
    for (; end < g->curve.len && g->curve.data[end] == c->tag; end++) {
      vec_push(&u, cm->u[p->first.data[end]]);
      vec_push(chain, g->ends.data[2 * end]);
      for (; at < splits->len && splits->data[at].seg == end; at++) {
        double ua = cm->u[p->first.data[end]], ub = cm->u[p->first.data[end] + 1];
        double x = curve_is_straight(p->in->model, c) ? ua + splits->data[at].along * (ub - ua)
                                                      : vertex_parameter(p, c, end, splits->data[at].v);
        vec_push(&u, x);
        vec_push(chain, splits->data[at].v);
      }
    }
    vec_push(&u, 1);
    vec_push(chain, g->ends.data[2 * end - 1]);
    if (u.len != cm->n) mesh1d_set(p->curves, mesh1d_index(p->curves, c->tag), u.data, (uint32_t)u.len);
    s = end;
  }
  vec_push(chain_start, (uint32_t)chain->len);
  vec_free(&u);
}

// ---- one plane ------------------------------------------------------------------------------------------------------------
static void build_graph(Plane *p)
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

// ---- where the angle is not reached -------------------------------------------------------------------------------------
enum { LISTED = 10 };

// Name the curves that meet at vertex v inside a face at under 60 degrees: as many as `left` allows in the log, all as notes, which
// the JSON report lists. Returns how many there are.
static size_t say_acute(const Plane *p, VertId v, size_t left)
{
  const Tri *t = &p->tri;
  EdgeId first = t->hint[v];
  while (!tri_is_segment(t, first)) first = tri_ccw(t, first); // an acute vertex has segments
  EdgeId e = first;
  size_t n = 0;
  do {
    EdgeId from = e;
    double angle = tri_wedge(t, &e);
    if (angle < M_PI / 3) {
      Vec3 at = vertex_place(p, v);
      Diag *d = p->in->diag;
      const Curve *c = model_curve(p->in->model, p->graph.curve.data[t->seg[from]]);
      int other = p->graph.curve.data[t->seg[e]];
      double degrees = angle * (180 / M_PI);
      if (n++ < left)
        log_info(d, "  curves %d and %d meet at (%g, %g, %g) at %.4g degrees", c->tag, other, at.x, at.y, at.z, degrees);
      diag_note(d, c->loc, "curves %d and %d meet at (%g, %g, %g) at %.4g degrees: triangles there have angles below %g", c->tag,
                other, at.x, at.y, at.z, degrees, p->in->options->Mesh_MinimumAngle);
    }
  } while (e != first);
  return n;
}

// Say how many triangles are below the angle, and at which input angles, or what else holds them.
static void say_skinny(const Plane *p, const TriSkinnyVec *skinny)
{
  if (!skinny->len) return;
  Diag *d = p->in->diag;
  const double wanted = p->in->options->Mesh_MinimumAngle;
  uint8_t *seen = mem_zalloc(p->tri.nv);
  size_t places = 0, stuck = 0;
  TriId example = NONE;
  for (size_t i = 0; i < skinny->len; i++) {
    TriSkinny s = skinny->data[i];
    if (s.corner != NONE) seen[s.corner] = 1;
    else if (!stuck++) example = s.tri;
  }
  if (skinny->len > stuck)
    log_info(d, "%zu triangles have an angle below %g degrees, at input angles under 60 degrees", skinny->len - stuck, wanted);
  for (VertId v = 0; v < p->tri.nv; v++)
    if (seen[v]) places += say_acute(p, v, places < LISTED ? LISTED - places : 0);
  if (places > LISTED) log_info(d, "  and %zu more", places - LISTED);
  if (stuck) {
    Vec3 at = vertex_place(p, p->tri.vert[3 * (size_t)example]);
    diag_warning(d, p->frame->loc,
                 "%zu triangles have an angle below %g degrees where boundary edges may not be split any more, the first at (%g, %g, %g)",
                 stuck, wanted, at.x, at.y, at.z);
  }
  free(seen);
}

static bool mesh_plane(Plane *p)
{
  const Options *o = p->in->options;
  tri_init(&p->tri);
  build_graph(p);
  if (!face_graph_recover(&p->graph, p->in->model, p->frame, &p->tri, p->in->diag) || !assign_regions(p)) return false;
  Tri *t = &p->tri;
  t->region = mem_realloc(t->region, t->cap_t * sizeof *t->region);
  for (TriId k = 0; k < t->nt; k++) {
    if (tri_is_free(t, k)) continue;
    uint32_t owner = p->owner[p->region[k]];
    t->region[k] = owner == NONE ? 0 : owner + 1;
    if (owner == NONE || tri_is_ghost(t, k)) t->flag[k] |= TRI_OUTSIDE_FLAG;
    else t->flag[k] &= (uint8_t)~TRI_OUTSIDE_FLAG;
  }
  tri_make_hints(t);
  SizeEval *eval = size_eval_new(p->in->size);
  SizeInPlane here = {eval, p->frame};
  TriRefineParams r = mesh2d_refine_params(o, p->frame, &here);
  r.min_angle = o->Mesh_MinimumAngle;
  r.conforming = o->Mesh_ConformingDelaunay;
  r.split = split_point;
  r.split_ctx = p;
  TriSkinnyVec skinny = {0};
  r.skinny_out = &skinny;
  FaceCross cross = {0};
  face_cross_prepare(&cross, t, &r);
  TriRefineStats s = tri_refine(t, &r);
  face_cross_free(&cross);
  size_eval_report(eval, p->in->diag);
  size_eval_free(eval);
  if (s.outcome == REFINE_DONE) say_skinny(p, &skinny);
  vec_free(&skinny);
  if (s.outcome == REFINE_LIMIT) {
    diag_error(p->in->diag, p->frame->loc, "more than %zu triangles (Mesh.MaxElements, -max_elements)", r.max_triangles);
    return false;
  }
  return true;
}

// Vertices to nodes as renumbered, then triangles to their faces.
static void extract_plane(const Plane *p, const EdgeNodes *nodes, const U32Vec *chain, const U32Vec *start,
                          const IntVec *changed, FaceMesh *face)
{
  const Tri *t = &p->tri;
  uint32_t *id = mem_alloc(t->nv * sizeof *id);
  for (uint32_t v = 0; v < t->nv; v++) id[v] = NONE;
  for (size_t v = 0; v < p->graph.node.len; v++)
    if (p->graph.node.data[v] < model_points(p->in->model)) id[v] = p->graph.node.data[v];
  for (size_t c = 0; c < changed->len; c++) {
    size_t k = mesh1d_index(p->curves, changed->data[c]);
    for (uint32_t i = start->data[c]; i < start->data[c + 1]; i++)
      id[chain->data[i]] = edge_nodes_at(nodes, p->in->model, p->curves, k, i - start->data[c]);
  }
  uint32_t *count = mem_zalloc(p->face.len * sizeof *count), *owner = mem_alloc(t->nv * sizeof *owner);
  memset(owner, 0xff, t->nv * sizeof *owner);
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    count[t->region[k] - 1]++;
    for (EdgeId e = 3 * k; e < 3 * k + 3; e++)
      if (id[t->vert[e]] == NONE) owner[t->vert[e]] = t->region[k] - 1;
  }
  size_t *own = mem_zalloc(p->face.len * sizeof *own);
  for (uint32_t v = 0; v < t->nv; v++)
    if (owner[v] != NONE) own[owner[v]]++;
  for (size_t k = 0; k < p->face.len; k++) {
    FaceMesh *f = &face[p->face.data[k]];
    f->own = mem_alloc(own[k] * sizeof *f->own);
    f->tri = mem_alloc(3 * (size_t)count[k] * sizeof *f->tri);
  }
  for (uint32_t v = 0; v < t->nv; v++) {
    if (owner[v] == NONE) continue;
    FaceMesh *f = &face[p->face.data[owner[v]]];
    id[v] = (uint32_t)(nodes->n + f->nown);
    f->own[f->nown++] = vertex_place(p, v);
  }
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    FaceMesh *f = &face[p->face.data[t->region[k] - 1]];
    bool mirror = vec3_dot(model_face_at(p->in->model, p->face.data[t->region[k] - 1])->normal, p->frame->normal) < 0;
    for (uint32_t i = 0; i < 3; i++) f->tri[3 * f->ntri + (mirror ? (3 - i) % 3 : i)] = id[t->vert[3 * k + i]];
    f->ntri++;
  }
  free(own);
  free(owner);
  free(count);
  free(id);
}

// Is face k meshed by rules of its own?
static bool is_apart(const Mesh2dInput *in, size_t k)
{
  const Face *f = model_face_at(in->model, k);
  return f->united || f->transfinite || (f->extruded_curve && f->layers.n > 0) || (f->type == FACE_FILLING && !f->planar) ||
         boundary_layers_on(in->layers, k);
}

static void hold_curves(const Model *m, const Face *f, Map *held)
{
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  for (size_t i = 0; i < curve.len; i++) map_set(held, (uint64_t)abs(curve.data[i]), 1);
  vec_free(&curve);
  vec_free(&start);
}

// Face k was meshed by rules of its own, which know no smallest angle: say where its triangles are below it.
static void say_apart(const Mesh2dInput *in, const EdgeNodes *nodes, size_t k, const FaceMesh *f)
{
  const double wanted = in->options->Mesh_MinimumAngle;
  size_t n = 0;
  double worst = wanted;
  Vec3 at = {0};
  for (size_t i = 0; i < f->ntri; i++) {
    Vec3 x[3];
    for (int j = 0; j < 3; j++) {
      uint32_t id = f->tri[3 * i + j];
      x[j] = id < nodes->n ? nodes->xyz[id] : f->own[id - nodes->n];
    }
    double least = 180;
    Vec3 where = x[0];
    for (int j = 0; j < 3; j++) {
      Vec3 a = vec3_sub(x[(j + 1) % 3], x[j]), b = vec3_sub(x[(j + 2) % 3], x[j]);
      double angle = atan2(vec3_length(vec3_cross(a, b)), vec3_dot(a, b)) * (180 / M_PI);
      if (angle < least) least = angle, where = x[j];
    }
    if (least < wanted - 1e-9) n++;
    if (least < worst) worst = least, at = where;
  }
  if (!n) return;
  const Face *face = model_face_at(in->model, k);
  diag_warning(in->diag, face->loc,
               "surface %d (%s) is meshed without a smallest angle: %zu triangles have less than %g degrees, the least %.4g at (%g, %g, %g)",
               face->tag, boundary_layers_on(in->layers, k) ? "with boundary layers" : "structured or not plane", n, wanted, worst,
               at.x, at.y, at.z);
}

size_t mesh2d_joint_run(const Mesh2dInput *in, Mesh1d *curves, EdgeNodes *nodes, FaceMesh *face)
{
  const Model *m = in->model;
  size_t n = model_faces(m), nplane = 0, failed = 0;
  Map held = {0};
  Vec(size_t) apart = {0};
  Box3 box = model_bounds(m);
  double tolerance = in->options->Geometry_Tolerance * vec3_distance(box.lo, box.hi);
  Plane *plane = mem_zalloc((n + 1) * sizeof *plane);
  for (size_t k = 0; k < n; k++) {
    const Face *f = model_face_at(m, k);
    face[k] = (FaceMesh){0};
    if (is_apart(in, k)) {
      hold_curves(m, f, &held);
      vec_push(&apart, k);
      continue;
    }
    if (f->recombine || in->options->Mesh_RecombineAll)
      diag_warning(in->diag, f->loc, "surface %d stays in triangles: a smallest angle is promised for triangles only", f->tag);
    size_t i = 0;
    while (i < nplane && !same_plane(plane[i].frame, f, tolerance)) i++;
    if (i == nplane) plane[nplane++] = (Plane){.in = in, .curves = curves, .nodes = nodes, .held = &held, .frame = f};
    vec_push(&plane[i].face, k);
  }
  U32Vec *chain = mem_zalloc((nplane + 1) * sizeof *chain), *start = mem_zalloc((nplane + 1) * sizeof *start);
  IntVec *changed = mem_zalloc((nplane + 1) * sizeof *changed);
  for (size_t i = 0; i < nplane; i++) {
    if (!mesh_plane(&plane[i])) {
      for (size_t k = 0; k < plane[i].face.len; k++) face[plane[i].face.data[k]].failed = true;
      failed += plane[i].face.len;
      continue;
    }
    SplitVertices splits = {0};
    find_splits(&plane[i], &splits);
    update_curves(&plane[i], &splits, &chain[i], &start[i], &changed[i]);
    vec_free(&splits);
  }
  // A curve of two planes must have come out the same in both.
  Map length = {0};
  for (size_t i = 0; i < nplane && !failed; i++)
    for (size_t c = 0; c < changed[i].len && !failed; c++) {
      uint32_t len = start[i].data[c + 1] - start[i].data[c];
      if (*map_slot(&length, (uint64_t)changed[i].data[c], len, NULL) == len) continue;
      diag_error(in->diag, model_curve(m, changed[i].data[c])->loc,
                 "curve %d would be split differently for the two planes that meet there", changed[i].data[c]);
      failed = n;
    }
  map_free(&length);
  if (!failed) {
    edge_nodes_free(nodes);
    edge_nodes_init(nodes, m, curves);
    for (size_t i = 0; i < nplane; i++)
      extract_plane(&plane[i], nodes, &chain[i], &start[i], &changed[i], face);
    failed = mesh2d_run_some(in, nodes, apart.data, apart.len, face);
    for (size_t i = 0; i < apart.len && in->options->Mesh_MinimumAngle > 0; i++)
      if (!face[apart.data[i]].failed) say_apart(in, nodes, apart.data[i], &face[apart.data[i]]);
  }
  map_free(&held);
  vec_free(&apart);
  for (size_t i = 0; i < nplane; i++) {
    plane_free(&plane[i]);
    vec_free(&chain[i]);
    vec_free(&start[i]);
    vec_free(&changed[i]);
  }
  free(chain);
  free(start);
  free(changed);
  free(plane);
  return failed;
}
