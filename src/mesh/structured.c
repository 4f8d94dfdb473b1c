// structured.c - transfinite faces: corners, sides, grid
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/structured.h"

#include "geom/predicates.h"
#include "mesh/filling.h"
#include "mesh/grid.h"

// ---- the boundary --------------------------------------------------------------------------------------------------
// The closed boundary of a face of one loop: node ids in order, and their parameters on its filling.
typedef struct {
  U32Vec node;
  Vec(Vec2) param;  // empty unless asked for and the filling has four curves
  size_t ncurve;
  U32Vec curve_at;  // position where each curve begins
  bool first_backwards; // the loop runs its first curve against its sense
} FaceLoop;

static void push_curve(FaceLoop *l, const Mesh2dInput *in, const EdgeNodes *en, const Filling *s, int tag)
{
  size_t k = mesh1d_index(in->curves, tag), side = l->ncurve++;
  const CurveMesh *cm = &in->curves->curve[k];
  vec_push(&l->curve_at, (uint32_t)l->node.len);
  for (size_t i = 0; i + 1 < cm->n; i++) {
    size_t at = tag >= 0 ? i : cm->n - 1 - i;
    vec_push(&l->node, edge_nodes_at(en, in->model, in->curves, k, at));
    if (s) vec_push(&l->param, filling_side(s, (int)side, tag >= 0 ? cm->u[at] : 1 - cm->u[at]));
  }
}

// False if the face has more than one closed loop. Free with face_loop_free.
static bool face_loop_make(FaceLoop *l, const Mesh2dInput *in, const Face *f, const EdgeNodes *en, bool params)
{
  *l = (FaceLoop){0};
  Filling s;
  if (params && !filling_init(&s, in->model, f)) params = false;
  if (params && s.n == 3) params = false; // a grid in its parameters would not be one of the corners chosen
  IntVec curve = {0}, start = {0};
  face_boundary(in->model, f, &curve, &start);
  bool good = start.len == 2;
  l->first_backwards = good && curve.data[0] < 0;
  for (size_t i = 0; i < curve.len && good; i++) push_curve(l, in, en, params ? &s : NULL, curve.data[i]);
  vec_free(&curve);
  vec_free(&start);
  return good;
}

static void face_loop_free(FaceLoop *l)
{
  vec_free(&l->node);
  vec_free(&l->param);
  vec_free(&l->curve_at);
}

static Vec3 node_place(const EdgeNodes *en, const FaceMesh *fm, uint32_t id)
{
  return id < en->n ? en->xyz[id] : fm->own[id - en->n];
}

// Where a node is seen from the face's upper side. In a plane of constant z these are the coordinates themselves, so signs are exact.
static void look_at_node(const Face *f, Vec3 x, double to[2])
{
  if (!f->sphere && f->normal.x == 0 && f->normal.y == 0) {
    to[0] = f->normal.z < 0 ? -x.x : x.x;
    to[1] = x.y;
    return;
  }
  Vec2 q = face_to_plane(f, x);
  to[0] = q.x;
  to[1] = q.y;
}

static bool elements_valid(const FaceMesh *fm, const Face *f, const EdgeNodes *en, const uint32_t *v, size_t n, int corners)
{
  for (size_t k = 0; k < n; k++, v += corners) {
    double p[4][2];
    for (int i = 0; i < corners; i++) look_at_node(f, node_place(en, fm, v[i]), p[i]);
    for (int i = 0; i < (corners == 4 ? 4 : 1); i++)
      if (orient2d(p[i], p[(i + 1) % corners], p[(i + 2) % corners]) <= 0) return false;
  }
  return true;
}

bool face_mesh_valid(const FaceMesh *fm, const Face *f, const EdgeNodes *en)
{
  return elements_valid(fm, f, en, fm->tri, fm->ntri, 3) && elements_valid(fm, f, en, fm->quad, fm->nquad, 4);
}

void face_mesh_from_grid(FaceMesh *out, const GridCells *g, bool quads)
{
  out->tri = mem_alloc((quads ? 3 * g->nv * g->fan : 6 * g->nu * g->nv) * sizeof *out->tri);
  if (quads) {
    out->quad = mem_alloc(4 * g->nu * g->nv * sizeof *out->quad);
    out->nquad = grid_quads(g, out->tri, &out->ntri, out->quad);
  } else {
    out->ntri = grid_triangles(g, out->tri);
  }
}

// ---- corners ---------------------------------------------------------------------------------------------------------
// The boundary turned so that it begins at the first corner and goes on to the second.
typedef struct {
  const Mesh2dInput *in;
  const Face *f;
  const EdgeNodes *en;
  Diag *diag;
  FaceLoop loop;
  size_t n;           // nodes
  uint32_t *node;     // turned copies, one more than n: the first again
  Vec2 *param;        // or NULL
  size_t corner[5];   // positions; corner[0] = 0, then ascending; one past the last: n
  int ncorner;
  bool mirror;        // turned against the loop
  size_t nu, nv;
} Patch;

static bool refuse(const Patch *p, const char *why)
{
  diag_warning(p->diag, p->f->loc, "surface %d cannot be transfinite (%s): it is meshed as the others", p->f->tag, why);
  return false;
}

// Corner node ids in the order given, or the places where curves meet.
static bool corner_nodes(Patch *p, uint32_t id[4])
{
  const Face *f = p->f;
  p->ncorner = f->ncorner;
  for (int k = 0; k < f->ncorner && k < 4; k++) {
    id[k] = edge_nodes_point(p->in->model, f->corner[k]);
    bool there = false;
    for (size_t i = 0; i < p->loop.node.len && !there; i++) there = p->loop.node.data[i] == id[k];
    if (!there) {
      diag_warning(p->diag, f->loc, "surface %d cannot be transfinite (its corner, point %d, is not on its boundary)", f->tag,
                   f->corner[k]);
      return false;
    }
  }
  if (f->ncorner) return f->ncorner == 3 || f->ncorner == 4 || refuse(p, "it must have 3 or 4 corners");
  size_t n = 0;
  for (size_t k = 0; k < p->loop.ncurve; k++) {
    size_t at = p->loop.curve_at.data[k], next = k + 1 < p->loop.ncurve ? p->loop.curve_at.data[k + 1] : p->loop.node.len;
    if (at == next) continue; // a curve without length
    if (n < 4) id[n] = p->loop.node.data[at];
    n++;
  }
  p->ncorner = (int)n;
  if (p->loop.first_backwards && (n == 3 || n == 4)) { // as Gmsh: from the begin of the first curve, along it
    const uint32_t as_run[4] = {id[0], id[1], id[2], id[n == 4 ? 3 : 2]};
    id[0] = as_run[1];
    id[1] = as_run[0];
    id[2] = as_run[3];
    id[3] = as_run[2];
  }
  if (n == 3 || n == 4) return true;
  diag_warning(p->diag, f->loc, "surface %d cannot be transfinite (it has %zu curves and no 3 or 4 corners were named)", f->tag, n);
  return false;
}

static bool is_corner(uint32_t v, const uint32_t *id, int n)
{
  for (int k = 0; k < n; k++)
    if (id[k] == v) return true;
  return false;
}

static void turn(Patch *p, size_t start, bool backwards)
{
  size_t n = p->n;
  bool params = p->loop.param.len > 0;
  p->mirror = backwards;
  for (size_t i = 0; i <= n; i++) {
    size_t at = backwards ? (start + 2 * n - i) % n : (start + i) % n;
    p->node[i] = p->loop.node.data[at];
    if (params) p->param[i] = p->loop.param.data[at];
  }
}

static bool find_corners(Patch *p)
{
  uint32_t id[4];
  if (!corner_nodes(p, id)) return false;
  size_t n = p->n = p->loop.node.len, start = 0;
  p->node = mem_alloc((n + 1) * sizeof *p->node);
  p->param = p->loop.param.len ? mem_alloc((n + 1) * sizeof *p->param) : NULL;
  while (p->loop.node.data[start] != id[0]) start++;
  size_t next = 1;
  while (next < n && !is_corner(p->loop.node.data[(start + next) % n], id, p->ncorner)) next++;
  uint32_t found = p->loop.node.data[(start + next) % n];
  turn(p, start, found == id[p->ncorner - 1] && found != id[1]);
  int count = 0;
  for (size_t i = 0; i < n; i++)
    if (is_corner(p->node[i], id, p->ncorner)) {
      if (count < 4) p->corner[count] = i;
      count++;
    }
  if (count != p->ncorner) return refuse(p, "its corners are not distinct places of its boundary");
  p->corner[count] = n;
  return true;
}

static size_t side_count(const Patch *p, int k) { return p->corner[k + 1] - p->corner[k]; }

// With three corners the first must have sides of equal counts: begin with the one that has.
static void choose_apex(Patch *p)
{
  size_t c[3] = {side_count(p, 0), side_count(p, 1), side_count(p, 2)};
  int first = c[0] == c[2] ? 0 : c[0] == c[1] ? 1 : c[1] == c[2] ? 2 : 0;
  if (first == 0) return;
  size_t shift = p->corner[first], n = p->n;
  uint32_t *node = mem_alloc((n + 1) * sizeof *node);
  Vec2 *param = p->param ? mem_alloc((n + 1) * sizeof *param) : NULL;
  for (size_t i = 0; i <= n; i++) {
    node[i] = p->node[(i + shift) % n];
    if (param) param[i] = p->param[(i + shift) % n];
  }
  free(p->node);
  free(p->param);
  p->node = node;
  p->param = param;
  for (int k = 0; k < 3; k++) p->corner[k + 1] = p->corner[k] + c[(k + first) % 3];
}

static bool match_sides(Patch *p)
{
  if (p->ncorner == 3) choose_apex(p);
  size_t a = side_count(p, 0), b = side_count(p, 1), c = side_count(p, 2), d = p->ncorner == 4 ? side_count(p, 3) : 0;
  p->nu = a;
  p->nv = b;
  if (p->ncorner == 4 && a == c && b == d) return true;
  if (p->ncorner == 3 && a == c) return true;
  if (p->ncorner == 4)
    diag_warning(p->diag, p->f->loc,
                 "surface %d cannot be transfinite: its opposite sides have %zu and %zu, %zu and %zu elements: it is meshed as "
                 "the others",
                 p->f->tag, a, c, b, d);
  else
    diag_warning(p->diag, p->f->loc,
                 "surface %d cannot be transfinite: its three sides have %zu, %zu and %zu elements, and no two are equal: it is "
                 "meshed as the others",
                 p->f->tag, a, b, c);
  return false;
}

// ---- the grid ---------------------------------------------------------------------------------------------------------
// Node ids of the whole grid: the boundary's, and new ones inside. Interior nodes are numbered in the order (i, j).
static uint32_t *grid_ids(const Patch *p, size_t *nown)
{
  size_t nu = p->nu, nv = p->nv, n = p->n;
  uint32_t *id = mem_alloc((nu + 1) * (nv + 1) * sizeof *id), next = (uint32_t)p->en->n;
  for (size_t i = 0; i <= nu; i++)
    for (size_t j = 0; j <= nv; j++) {
      uint32_t *to = &id[i * (nv + 1) + j];
      if (i == 0)
        *to = p->ncorner == 3 ? p->node[0] : p->node[n - j];
      else if (i == nu)
        *to = p->node[nu + j];
      else if (j == 0)
        *to = p->node[i];
      else if (j == nv)
        *to = p->node[p->corner[2] + nu - i];
      else
        *to = next++;
    }
  *nown = next - p->en->n;
  return id;
}

typedef struct {
  Vec3 *bottom, *right, *top, *left;
} SideArrays;

static Vec3 *side_array(const Patch *p, size_t from, size_t n, bool backwards, bool params)
{
  Vec3 *side = mem_alloc((n + 1) * sizeof *side);
  for (size_t k = 0; k <= n; k++) {
    size_t at = backwards ? from + n - k : from + k;
    side[k] = params ? (Vec3){p->param[at].x, p->param[at].y, 0} : p->en->xyz[p->node[at]];
  }
  return side;
}

static SideArrays side_arrays(const Patch *p, bool params)
{
  SideArrays s = {side_array(p, 0, p->nu, false, params), side_array(p, p->corner[1], p->nv, false, params),
                  side_array(p, p->corner[2], p->nu, true, params), NULL};
  if (p->ncorner == 4) s.left = side_array(p, p->corner[3], p->nv, true, params);
  return s;
}

static void side_arrays_free(SideArrays *s)
{
  free(s->bottom);
  free(s->right);
  free(s->top);
  free(s->left);
}

static void interpolate(const Patch *p, Vec3 *node)
{
  double *u = mem_alloc((p->nu + 1) * sizeof *u), *v = mem_alloc((p->nv + 1) * sizeof *v);
  SideArrays s = side_arrays(p, false);
  if (p->ncorner == 4)
    grid_lengths(s.bottom, p->nu, u);
  else
    grid_mean_lengths(s.bottom, s.top, p->nu, u);
  grid_lengths(s.right, p->nv, v);
  if (p->param) {
    side_arrays_free(&s);
    s = side_arrays(p, true);
  }
  grid_coons(&(GridSides){p->nu, p->nv, s.bottom, s.right, s.top, s.left}, u, v, node);
  side_arrays_free(&s);
  free(u);
  free(v);
}

// Places of the grid's nodes to the own nodes of the face, from the parameter plane if the face is a filling. `own` may be `node`: none
// moves up, since own nodes are numbered as the grid runs.
static void store_nodes(const Patch *p, const Vec3 *node, Vec3 *own)
{
  Filling s;
  if (p->param) filling_init(&s, p->in->model, p->f);
  for (size_t i = 1, at = 0; i < p->nu; i++)
    for (size_t j = 1; j < p->nv; j++, at++) {
      Vec3 q = node[i * (p->nv + 1) + j];
      own[at] = p->param ? filling_point(&s, q.x, q.y) : q;
    }
}

static bool wants_quads(const Patch *p) { return p->f->recombine || p->in->options->Mesh_RecombineAll; }

static int smoothing_passes(const Patch *p)
{
  if (p->ncorner != 4) return 0;
  if (p->f->smoother > 0) return p->f->smoother;
  int smoothing = p->in->options->Mesh_Smoothing;
  return smoothing > 1 ? smoothing : 0;
}

enum { UNFOLD_ROUNDS = 8, UNFOLD_PASSES = 25 };

// Pass after pass over a grid whose cells are folded, until they are not.
static bool unfold(const Patch *p, FaceMesh *out)
{
  Vec3 *node = mem_alloc((p->nu + 1) * (p->nv + 1) * sizeof *node);
  bool valid = false;
  interpolate(p, node);
  grid_smooth(p->nu, p->nv, node, smoothing_passes(p));
  for (int round = 0; round < UNFOLD_ROUNDS && !valid; round++) {
    grid_smooth(p->nu, p->nv, node, UNFOLD_PASSES);
    store_nodes(p, node, out->own);
    valid = face_mesh_valid(out, p->f, p->en);
  }
  free(node);
  return valid;
}

static bool fill_grid(const Patch *p, FaceMesh *out)
{
  Vec3 *node = out->own = mem_alloc((p->nu + 1) * (p->nv + 1) * sizeof *node);
  uint32_t *id = grid_ids(p, &out->nown);
  interpolate(p, node);
  grid_smooth(p->nu, p->nv, node, smoothing_passes(p));
  store_nodes(p, node, out->own);
  face_mesh_from_grid(out, &(GridCells){p->nu, p->nv, id, p->f->arrangement, p->ncorner == 3, p->mirror}, wants_quads(p));
  free(id);
  if (!p->f->planar || face_mesh_valid(out, p->f, p->en) || (p->ncorner == 4 && unfold(p, out))) return true;
  face_mesh_free(out);
  return refuse(p, "its cells would be folded");
}

// Three sides of equal counts, as a triangular grid (Mesh.TransfiniteTri).
static bool fill_triangle(const Patch *p, FaceMesh *out)
{
  size_t n = p->nu;
  SideArrays s = side_arrays(p, p->param != NULL);
  Vec3 *node = mem_alloc((n + 1) * (n + 1) * sizeof *node);
  uint32_t *id = mem_alloc((n + 1) * (n + 1) * sizeof *id), next = (uint32_t)p->en->n;
  grid_triangle(n, s.bottom, s.right, s.top, node);
  side_arrays_free(&s);
  Filling filling;
  if (p->param) filling_init(&filling, p->in->model, p->f);
  out->own = mem_alloc(n * n / 2 * sizeof *out->own);
  for (size_t i = 0; i <= n; i++)
    for (size_t j = 0; j <= i; j++) {
      size_t k = i * (n + 1) + j;
      if (j == 0)
        id[k] = p->node[i];
      else if (i == n)
        id[k] = p->node[n + j];
      else if (j == i)
        id[k] = p->node[3 * n - i];
      else {
        id[k] = next++;
        out->own[out->nown++] = p->param ? filling_point(&filling, node[k].x, node[k].y) : node[k];
      }
    }
  out->tri = mem_alloc(3 * n * n * sizeof *out->tri);
  out->ntri = grid_triangle_cells(n, id, p->mirror, out->tri);
  free(node);
  free(id);
  if (!p->f->planar || face_mesh_valid(out, p->f, p->en)) return true;
  face_mesh_free(out);
  return refuse(p, "its cells would be folded");
}

// What is inside the face has no place in a grid: named, so that the user can say which of the two is meant.
static bool refuse_embedded(const Patch *p)
{
  const IntVec *point = &p->f->embedded_points, *curve = &p->f->embedded_curves;
  char why[120];
  size_t n = point->len + curve->len;
  const char *kind = curve->len ? "curve" : "point";
  int first = curve->len ? curve->data[0] : point->data[0];
  if (n == 1)
    snprintf(why, sizeof why, "%s %d is embedded in it", kind, abs(first));
  else
    snprintf(why, sizeof why, "%s %d and %zu more points and curves are embedded in it", kind, abs(first), n - 1);
  return refuse(p, why);
}

bool structured_face(const Mesh2dInput *in, const Face *f, const EdgeNodes *en, FaceMesh *out, Diag *diag)
{
  if (!f->transfinite) return false;
  Patch p = {.in = in, .f = f, .en = en, .diag = diag};
  if (f->embedded_points.len || f->embedded_curves.len) return refuse_embedded(&p);
  bool good = face_loop_make(&p.loop, in, f, en, f->type == FACE_FILLING);
  if (!good) refuse(&p, "it has holes");
  good = good && p.loop.node.len >= 3 && find_corners(&p) && match_sides(&p);
  if (good) {
    bool triangular = p.ncorner == 3 && in->options->Mesh_TransfiniteTri && p.nu == p.nv && !wants_quads(&p);
    good = triangular ? fill_triangle(&p, out) : fill_grid(&p, out);
  }
  face_loop_free(&p.loop);
  free(p.node);
  free(p.param);
  return good;
}
