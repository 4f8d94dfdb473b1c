// face_copy.c - faces that take the mesh of another face: the far end of an extrusion with Layers, Periodic Surface
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/face_copy.h"

#include "base/map.h"
#include "geom/nearest.h"
#include "mesh/structured.h"

// How far an image may be from the node it falls on, against the shortest edge of the boundary.
#define SHARE_OF_EDGE 1e-3

uint32_t face_copy_source(const Model *m, const Face *f)
{
  int tag = f->periodic_master ? f->periodic_master : f->copy_of;
  if (!tag || f->transfinite || (f->extruded_curve && f->layers.n)) return NONE;
  for (size_t k = 0; k < model_faces(m); k++)
    if (model_face_at(m, k)->tag == tag) return model_face_at(m, k) == f ? NONE : (uint32_t)k;
  return NONE;
}

// ---- the map ---------------------------------------------------------------------------------------------------------------
// From the plane of the source to the plane of f: z to scale z + shift as complex numbers, of the conjugate if `mirror`; or in space.
typedef struct {
  const double *affine; // or NULL
  const Face *from, *to;
  bool mirror;
  Vec2 scale, shift;
} Carry;

static Vec2 times(Vec2 a, Vec2 b) { return (Vec2){a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }

static Vec3 carry(const Carry *c, Vec3 p)
{
  const double *a = c->affine;
  if (a)
    return (Vec3){a[0] * p.x + a[1] * p.y + a[2] * p.z + a[3], a[4] * p.x + a[5] * p.y + a[6] * p.z + a[7],
                  a[8] * p.x + a[9] * p.y + a[10] * p.z + a[11]};
  Vec2 q = face_to_plane(c->from, p);
  if (c->mirror) q.y = -q.y;
  return face_from_plane(c->to, vec2_add(times(c->scale, q), c->shift));
}

typedef struct {
  Vec3 from, to;
} PlacePair;
typedef Vec(PlacePair) PlacePairs;

// The ends of the curves of f and of those they copy.
static void pairs_of_curves(const Model *m, const Face *f, PlacePairs *pairs)
{
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  for (size_t i = 0; i < curve.len; i++) {
    const Curve *c = model_curve(m, curve.data[i]);
    int master = c->periodic_master ? c->periodic_master : c->copy_of;
    const Curve *o = master ? model_curve(m, master) : NULL;
    if (!o) continue;
    int begin = master >= 0 ? o->begin : o->end, end = master >= 0 ? o->end : o->begin;
    vec_push(pairs, ((PlacePair){model_point(m, begin)->xyz, model_point(m, c->begin)->xyz}));
    vec_push(pairs, ((PlacePair){model_point(m, end)->xyz, model_point(m, c->end)->xyz}));
  }
  vec_free(&curve);
  vec_free(&start);
}

// Turn, scale and shift (or mirror first) by the two pairs whose sources are farthest from each other's; good if all pairs agree.
static bool fit(Carry *c, const PlacePairs *pairs)
{
  size_t far = 0;
  for (size_t i = 1; i < pairs->len; i++)
    if (vec3_distance(pairs->data[i].from, pairs->data[0].from) > vec3_distance(pairs->data[far].from, pairs->data[0].from)) far = i;
  if (!far) return false;
  Vec2 a = face_to_plane(c->from, pairs->data[0].from), b = face_to_plane(c->from, pairs->data[far].from);
  Vec2 p = face_to_plane(c->to, pairs->data[0].to), q = face_to_plane(c->to, pairs->data[far].to);
  if (c->mirror) a.y = -a.y, b.y = -b.y;
  Vec2 d = vec2_sub(b, a), e = vec2_sub(q, p);
  double l = vec2_dot(d, d);
  c->scale = (Vec2){vec2_dot(d, e) / l, vec2_cross(d, e) / l};
  c->shift = vec2_sub(p, times(c->scale, a));
  for (size_t i = 0; i < pairs->len; i++)
    if (vec3_distance(carry(c, pairs->data[i].from), pairs->data[i].to) > 1e-6 * sqrt(l)) return false;
  return true;
}

static bool find_map(const Model *m, const Face *from, const Face *f, Carry *c)
{
  *c = (Carry){.affine = f->copy_map, .from = from, .to = f};
  if (c->affine) return true;
  if (!from->planar || !f->planar) return false;
  PlacePairs pairs = {0};
  pairs_of_curves(m, f, &pairs);
  bool good = fit(c, &pairs);
  if (!good) {
    c->mirror = true;
    good = fit(c, &pairs);
  }
  vec_free(&pairs);
  return good;
}

// ---- nodes -----------------------------------------------------------------------------------------------------------------
static void push_curve_nodes(const Mesh2dInput *in, const EdgeNodes *en, int tag, Map *seen, U32Vec *node, double *shortest)
{
  uint32_t k = mesh1d_index(in->curves, tag);
  size_t n = k == NONE ? 0 : in->curves->curve[k].n;
  for (size_t i = 0; i < n; i++) {
    bool fresh;
    uint32_t v = edge_nodes_at(en, in->model, in->curves, k, i);
    map_slot(seen, v, (uint32_t)node->len, &fresh);
    if (fresh) vec_push(node, v);
    if (i) *shortest = fmin(*shortest, vec3_distance(in->curves->curve[k].p[i], in->curves->curve[k].p[i - 1]));
  }
}

// Distinct nodes of the curves that bound f, and (`all`) of what is embedded in it.
static void nodes_of_face(const Mesh2dInput *in, const EdgeNodes *en, const Face *f, bool all, U32Vec *node, double *shortest)
{
  IntVec curve = {0}, start = {0};
  Map seen = {0};
  face_boundary(in->model, f, &curve, &start);
  for (size_t i = 0; i < curve.len; i++) push_curve_nodes(in, en, curve.data[i], &seen, node, shortest);
  for (size_t i = 0; all && i < f->embedded_curves.len; i++)
    push_curve_nodes(in, en, f->embedded_curves.data[i], &seen, node, shortest);
  for (size_t i = 0; all && i < f->embedded_points.len; i++) {
    bool fresh;
    uint32_t v = edge_nodes_point(in->model, f->embedded_points.data[i]);
    if (v == NONE) continue;
    map_slot(&seen, v, 0, &fresh);
    if (fresh) vec_push(node, v);
  }
  map_free(&seen);
  vec_free(&curve);
  vec_free(&start);
}

// Nodes of points and curves of the source to those of f where the images fall on them. False unless each node of f is hit once, and
// each on the boundary of the source has one.
static bool match_nodes(const Mesh2dInput *in, const EdgeNodes *en, const Carry *c, Map *to)
{
  U32Vec theirs = {0}, mine = {0}, bound = {0};
  double shortest = INFINITY, unused = INFINITY;
  nodes_of_face(in, en, c->from, true, &theirs, &unused);
  nodes_of_face(in, en, c->from, false, &bound, &unused);
  nodes_of_face(in, en, c->to, true, &mine, &shortest);
  Nearest *tree = nearest_new(NULL, NULL);
  for (size_t i = 0; i < mine.len; i++) {
    Vec3 p = en->xyz[mine.data[i]];
    nearest_add(tree, p, p, 0, (uint32_t)i, 0, 0);
  }
  nearest_build(tree);
  bool *hit = mem_zalloc(mine.len + 1), good = mine.len > 0 && bound.len <= mine.len;
  size_t hits = 0;
  for (size_t i = 0; i < theirs.len && good; i++) {
    NearestHit h = nearest_query(tree, carry(c, en->xyz[theirs.data[i]]), SHARE_OF_EDGE * shortest, NONE);
    bool on_boundary = i < bound.len; // listed first, in the same order
    good = h.curve == NONE ? !on_boundary : !hit[h.curve];
    if (!good || h.curve == NONE) continue;
    hit[h.curve] = true;
    hits++;
    map_set(to, theirs.data[i], mine.data[h.curve]);
  }
  nearest_free(tree);
  free(hit);
  good = good && hits == mine.len;
  vec_free(&theirs);
  vec_free(&mine);
  vec_free(&bound);
  return good;
}

// ---- the copy ----------------------------------------------------------------------------------------------------------------
typedef struct {
  const EdgeNodes *en;
  const FaceMesh *from;
  const Carry *carry;
  const Map *to;
  Vec(Vec3) extra; // nodes embedded in the source alone
  Map extra_at;
} Copy;

static uint32_t image(Copy *c, uint32_t v)
{
  if (v >= c->en->n) return v;
  uint32_t w = map_get(c->to, v);
  if (w != NONE) return w;
  bool fresh;
  uint32_t *slot = map_slot(&c->extra_at, v, (uint32_t)(c->en->n + c->from->nown + c->extra.len), &fresh);
  if (fresh) vec_push(&c->extra, carry(c->carry, c->en->xyz[v]));
  return *slot;
}

static uint32_t *copy_cells(Copy *c, const uint32_t *cell, size_t n, size_t corners, bool turned)
{
  uint32_t *out = mem_alloc(corners * n * sizeof *out);
  for (size_t i = 0; i < n; i++)
    for (size_t k = 0; k < corners; k++) out[corners * i + (turned ? (corners - k) % corners : k)] = image(c, cell[corners * i + k]);
  return out;
}

// Does the image of the source's normal point against that of f?
static bool is_turned(const Carry *c)
{
  const Face *g = c->from;
  Vec3 o = carry(c, g->origin), u = vec3_sub(carry(c, vec3_add(g->origin, g->axis_u)), o);
  Vec3 v = vec3_sub(carry(c, vec3_add(g->origin, g->axis_v)), o);
  return vec3_dot(vec3_cross(u, v), c->to->normal) < 0;
}

bool face_copy(const Mesh2dInput *in, const Face *f, const EdgeNodes *en, const FaceMesh *from, FaceMesh *out)
{
  Carry c;
  Map to = {0};
  uint32_t source = face_copy_source(in->model, f);
  bool good = source != NONE && !from->failed && find_map(in->model, model_face_at(in->model, source), f, &c) &&
              match_nodes(in, en, &c, &to);
  if (!good) {
    map_free(&to);
    return false;
  }
  Copy copy = {.en = en, .from = from, .carry = &c, .to = &to};
  FaceMesh r = {.nown = from->nown, .ntri = from->ntri, .nquad = from->nquad};
  bool turned = is_turned(&c);
  r.tri = copy_cells(&copy, from->tri, from->ntri, 3, turned);
  r.quad = copy_cells(&copy, from->quad, from->nquad, 4, turned);
  r.own = mem_alloc((r.nown + copy.extra.len) * sizeof *r.own);
  for (size_t i = 0; i < r.nown; i++) r.own[i] = carry(&c, from->own[i]);
  for (size_t i = 0; i < copy.extra.len; i++) r.own[r.nown++] = copy.extra.data[i];
  if (from->size) {
    r.size = mem_alloc(r.nown * sizeof *r.size);
    for (size_t i = 0; i < r.nown; i++) r.size[i] = i < from->nown ? from->size[i] : NAN;
  }
  vec_free(&copy.extra);
  map_free(&copy.extra_at);
  map_free(&to);
  good = !f->planar || face_mesh_valid(&r, f, en);
  if (good)
    *out = r;
  else
    face_mesh_free(&r);
  return good;
}
