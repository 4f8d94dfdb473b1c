// mesh2d_joint.c - faces whose boundary edges may be split, kept conforming
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh2d_joint.h"

#include "mesh/face_cluster.h"

static bool same_plane(const Face *f, const Face *g, double tolerance)
{
  Vec3 d = vec3_sub(f->origin, g->origin);
  return vec3_length(vec3_cross(f->normal, g->normal)) <= 1e-9 && fabs(vec3_dot(d, f->normal)) <= tolerance;
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

// Face k was meshed by rules of its own, and no boundary edge of it was split: say where its triangles are below the angle.
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
               "surface %d (%s) keeps its boundary edges: %zu triangles have an angle below %g degrees, the least %.4g at (%g, %g, %g)",
               face->tag, boundary_layers_on(in->layers, k) ? "with boundary layers" : "structured or not plane", n, wanted, worst,
               at.x, at.y, at.z);
}

// ---- clusters -----------------------------------------------------------------------------------------------------------
typedef struct {
  FaceCluster faces;
  IntVec curves;   // indices of the curves in and around the faces
  uint32_t meshed; // when
  bool failed;
} Cluster;

typedef struct {
  const Mesh2dInput *in;
  Mesh1d *curves;
  EdgeNodes *nodes;
  Map held;             // tags of curves that must stay whole
  Vec(Cluster) cluster;
  uint32_t *changed;    // per curve: when it was last given nodes
  uint32_t now;         // counts meshings of clusters
} Joint;

static void push_curve(void *ctx, int tag, bool embedded)
{
  (void)embedded;
  IntVec *out = ctx;
  vec_push(out, abs(tag));
}

static void no_point(void *ctx, uint32_t node) { (void)ctx, (void)node; }

static void curves_of_face(const Joint *j, size_t k, IntVec *out)
{
  face_graph_visit(j->in->model, model_face_at(j->in->model, k), &(FaceVisitor){push_curve, no_point}, out);
}

static Cluster *add_cluster(Joint *j)
{
  Cluster c = {.faces = {.in = j->in, .curves = j->curves, .nodes = j->nodes, .held = &j->held}};
  vec_push(&j->cluster, c);
  return &vec_last(&j->cluster);
}

static void add_face(const Joint *j, Cluster *c, size_t face)
{
  if (!c->faces.face.len) c->faces.frame = model_face_at(j->in->model, face);
  vec_push(&c->faces.face, face);
  IntVec tags = {0};
  curves_of_face(j, face, &tags);
  for (size_t i = 0; i < tags.len; i++) vec_push(&c->curves, (int)mesh1d_index(j->curves, tags.data[i]));
  vec_free(&tags);
}

static size_t root(size_t *parent, size_t i)
{
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Join faces of one plane that have a curve in common; each set by its first face.
static size_t *join_faces(const Joint *j, const FaceVec *which, double tolerance)
{
  size_t *parent = mem_alloc((which->len + 1) * sizeof *parent);
  Vec(const Face *) plane = {0};
  Map first = {0}; // (plane, curve) -> face
  IntVec curves = {0};
  for (size_t i = 0; i < which->len; i++) {
    const Face *f = model_face_at(j->in->model, which->data[i]);
    uint32_t p = 0;
    while (p < plane.len && !same_plane(plane.data[p], f, tolerance)) p++;
    if (p == plane.len) vec_push(&plane, f);
    parent[i] = i;
    vec_clear(&curves);
    curves_of_face(j, which->data[i], &curves);
    for (size_t c = 0; c < curves.len; c++) {
      size_t other = *map_slot(&first, (uint64_t)p << 32 | (uint32_t)curves.data[c], (uint32_t)i, NULL);
      size_t a = root(parent, other), b = root(parent, i);
      parent[MAX(a, b)] = MIN(a, b);
    }
  }
  for (size_t i = 0; i < which->len; i++) parent[i] = root(parent, i);
  vec_free(&curves);
  map_free(&first);
  vec_free(&plane);
  return parent;
}

static void make_clusters(Joint *j, const FaceVec *which)
{
  Box3 box = model_bounds(j->in->model);
  size_t *set = join_faces(j, which, j->in->options->Geometry_Tolerance * vec3_distance(box.lo, box.hi));
  for (size_t i = 0; i < which->len; i++) {
    size_t first = set[i];
    if (first == i) { // the cluster's number takes the place of its first face
      set[i] = j->cluster.len;
      add_face(j, add_cluster(j), which->data[i]);
    } else {
      set[i] = set[first];
      add_face(j, &j->cluster.data[set[i]], which->data[i]);
    }
  }
  free(set);
}

// ---- rounds -------------------------------------------------------------------------------------------------------------
// Were curves of the cluster changed after time t by another one?
static bool changed_since(const Joint *j, const Cluster *c, uint32_t t)
{
  for (size_t i = 0; i < c->curves.len; i++)
    if (j->changed[c->curves.data[i]] > t) return true;
  return false;
}

// Faces that cannot be in one triangulation (they overlap, or nodes of theirs coincide) are meshed one by one.
static void divide(Joint *j, size_t k)
{
  FaceVec faces = j->cluster.data[k].faces.face;
  j->cluster.data[k].faces.face = (FaceVec){0};
  j->cluster.data[k].curves.len = 0; // left empty, and never meshed again
  for (size_t i = 0; i < faces.len; i++) add_face(j, add_cluster(j), faces.data[i]);
  vec_free(&faces);
}

static void mesh_cluster(Joint *j, size_t k)
{
  Cluster *c = &j->cluster.data[k];
  uint32_t *before = mem_alloc((c->curves.len + 1) * sizeof *before);
  for (size_t i = 0; i < c->curves.len; i++) before[i] = j->curves->curve[c->curves.data[i]].n;
  ClusterOutcome outcome = face_cluster_mesh(&c->faces);
  c->meshed = ++j->now;
  for (size_t i = 0; i < c->curves.len; i++)
    if (j->curves->curve[c->curves.data[i]].n != before[i]) j->changed[c->curves.data[i]] = c->meshed;
  free(before);
  c->failed = outcome != CLUSTER_DONE;
  if (outcome == CLUSTER_BAD && c->faces.face.len > 1) divide(j, k);
}

// Mesh every cluster whose curves have changed since it was meshed; those of which another has changed a curve in this round wait
// for the next, since `nodes` are those of the round's beginning. Returns how many were meshed or wait.
static size_t one_round(Joint *j)
{
  uint32_t begin = j->now;
  size_t busy = 0;
  for (size_t k = 0; k < j->cluster.len; k++) {
    Cluster *c = &j->cluster.data[k];
    if (!c->faces.face.len || c->failed || (c->meshed && !changed_since(j, c, c->meshed))) continue;
    busy++;
    if (!changed_since(j, c, begin)) mesh_cluster(j, k);
  }
  edge_nodes_free(j->nodes);
  edge_nodes_init(j->nodes, j->in->model, j->curves);
  return busy;
}

// Rounds until no cluster changes a curve of another. A curve only gains nodes, and what refines one side is fine enough for the
// other but near small angles: two or three rounds are usual.
enum { ROUNDS = 50 };

static bool settle(Joint *j)
{
  for (int i = 0; i < ROUNDS; i++)
    if (!one_round(j)) return true;
  diag_error(j->in->diag, NO_LOC, "faces that share curves go on splitting them for each other after %d rounds", ROUNDS);
  return false;
}

// ---- entry --------------------------------------------------------------------------------------------------------------
// Curves with prescribed nodes stay whole, and so do those that they are copies of.
static void hold_masters(const Model *m, Map *held)
{
  for (size_t k = 0; k < model_curves(m); k++) {
    const Curve *c = model_curve_at(m, k);
    int master = c->copy_of ? c->copy_of : c->periodic_master;
    if (master) map_set(held, (uint64_t)abs(master), 1);
  }
}

static void sort_faces(Joint *j, FaceVec *apart, FaceVec *together)
{
  for (size_t k = 0; k < model_faces(j->in->model); k++) {
    const Face *f = model_face_at(j->in->model, k);
    if (is_apart(j->in, k)) {
      hold_curves(j->in->model, f, &j->held);
      vec_push(apart, k);
      continue;
    }
    if (f->recombine || j->in->options->Mesh_RecombineAll)
      diag_warning(j->in->diag, f->loc, "surface %d stays in triangles: a smallest angle is promised for triangles only", f->tag);
    vec_push(together, k);
  }
}

// Results and messages of the clusters. Returns the number of faces that failed.
static size_t finish_clusters(Joint *j, bool settled, FaceMesh *face)
{
  size_t failed = 0;
  for (size_t k = 0; k < j->cluster.len; k++) {
    Cluster *c = &j->cluster.data[k];
    if (c->faces.face.len) {
      bool bad = !settled || c->failed;
      if (c->faces.diag) diag_merge(j->in->diag, c->faces.diag), c->faces.diag = NULL;
      for (size_t i = 0; i < c->faces.face.len && bad; i++) face[c->faces.face.data[i]].failed = true;
      if (bad) failed += c->faces.face.len;
      else face_cluster_extract(&c->faces, j->nodes, face), face_cluster_say_skinny(&c->faces);
    }
    face_cluster_free(&c->faces);
    vec_free(&c->curves);
  }
  return failed;
}

size_t mesh2d_joint_run(const Mesh2dInput *in, Mesh1d *curves, EdgeNodes *nodes, FaceMesh *face)
{
  Joint j = {.in = in, .curves = curves, .nodes = nodes};
  FaceVec apart = {0}, together = {0};
  for (size_t k = 0; k < model_faces(in->model); k++) face[k] = (FaceMesh){0};
  j.changed = mem_zalloc((model_curves(in->model) + 1) * sizeof *j.changed);
  hold_masters(in->model, &j.held);
  sort_faces(&j, &apart, &together);
  make_clusters(&j, &together);
  size_t failed = finish_clusters(&j, settle(&j), face);
  if (!failed) {
    failed = mesh2d_run_some(in, nodes, apart.data, apart.len, face);
    for (size_t i = 0; i < apart.len && in->options->Mesh_MinimumAngle > 0; i++)
      if (!face[apart.data[i]].failed) say_apart(in, nodes, apart.data[i], &face[apart.data[i]]);
  }
  vec_free(&j.cluster);
  map_free(&j.held);
  free(j.changed);
  vec_free(&apart);
  vec_free(&together);
  return failed;
}
