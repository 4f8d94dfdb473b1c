// extruded.c - faces swept by a curve with Layers: the curve's nodes carried along
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/filling.h"
#include "mesh/grid.h"
#include "mesh/structured.h"

// A swept face as a grid: i along the swept curve, j through the layers.
typedef struct {
  const Mesh2dInput *in;
  const Face *f;
  const EdgeNodes *en;
  size_t nu, nv;
  size_t source, top;          // curves by index
  bool source_back, top_back;  // run against their own sense
  size_t side[2];              // by index; NONE at the axis
  bool side_back[2];
  bool mirror;                 // the loop runs the swept curve against i
} Sweeping;

static const CurveMesh *mesh_of(const Sweeping *s, size_t k) { return &s->in->curves->curve[k]; }

static uint32_t node_at(const Sweeping *s, size_t k, bool back, size_t i)
{
  return edge_nodes_at(s->en, s->in->model, s->in->curves, k, back ? mesh_of(s, k)->n - 1 - i : i);
}

static size_t layer_count(const Layers *l)
{
  size_t n = 0;
  for (int k = 0; k < l->n; k++) n += (size_t)l->count[k];
  return n;
}

// Normalized height of the j-th row.
static double layer_height(const Layers *l, size_t j)
{
  double from = 0;
  for (int k = 0; k < l->n; k++) {
    size_t count = (size_t)l->count[k];
    if (j <= count) return from + (l->height[k] - from) * (double)j / (double)count;
    j -= count;
    from = l->height[k];
  }
  return from;
}

// Does the face's boundary run along curve `tag` forwards (+1), backwards (-1), not at all (0)?
static int sense_in_loop(const Model *m, const Face *f, int tag)
{
  IntVec curve = {0}, start = {0};
  int sense = 0;
  face_boundary(m, f, &curve, &start);
  for (size_t i = 0; i < curve.len && !sense; i++)
    if (abs(curve.data[i]) == abs(tag)) sense = curve.data[i] >= 0 ? 1 : -1;
  vec_free(&curve);
  vec_free(&start);
  return sense;
}

// A side curve must join the right ends of the swept curve and its copy; find its sense.
static bool set_side(Sweeping *s, int which, int tag)
{
  const Model *m = s->in->model;
  uint32_t from = node_at(s, s->source, s->source_back, which ? s->nu : 0);
  uint32_t to = node_at(s, s->top, s->top_back, which ? s->nu : 0);
  s->side[which] = tag ? mesh1d_index(s->in->curves, tag) : NONE;
  if (s->side[which] == NONE) return from == to;
  const Curve *c = model_curve_at(m, s->side[which]);
  uint32_t a = edge_nodes_point(m, c->begin), b = edge_nodes_point(m, c->end);
  s->side_back[which] = a != from;
  return mesh_of(s, s->side[which])->n == s->nv + 1 && ((a == from && b == to) || (b == from && a == to));
}

// Curves, counts and senses; false if they do not fit.
static bool set_up(Sweeping *s)
{
  const Face *f = s->f;
  s->source = mesh1d_index(s->in->curves, f->extruded_curve);
  s->top = mesh1d_index(s->in->curves, f->extruded_top);
  if (s->source == NONE || s->top == NONE || mesh_of(s, s->source)->n < 2) return false;
  s->nu = mesh_of(s, s->source)->n - 1;
  s->nv = layer_count(&f->layers);
  if (mesh_of(s, s->top)->n != s->nu + 1 || s->nv < 1) return false;
  s->source_back = f->extruded_curve < 0;
  int sense = sense_in_loop(s->in->model, f, f->extruded_curve);
  s->mirror = (sense < 0) != s->source_back;
  // The copy was made in the sense of its source unless it was merged with a curve that runs the other way.
  const bool senses[2] = {s->source_back, !s->source_back};
  for (int k = 0; k < 2; k++) {
    s->top_back = senses[k];
    if (set_side(s, 0, f->extruded_side[0]) && set_side(s, 1, f->extruded_side[1])) return sense != 0;
  }
  return false;
}

// Have the two ends moved straight, but not by the same vector?
static bool swept_by_normals(const Sweeping *s)
{
  Vec3 shift[2];
  for (int k = 0; k < 2; k++) {
    if (s->side[k] == NONE) return false;
    const Curve *c = model_curve_at(s->in->model, s->side[k]);
    if (c->type != CURVE_LINE) return false;
    shift[k] = vec3_sub(s->en->xyz[node_at(s, s->side[k], s->side_back[k], s->nv)], s->en->xyz[node_at(s, s->side[k], s->side_back[k], 0)]);
  }
  const CurveMesh *cm = mesh_of(s, s->source);
  Vec3 p = cm->p[cm->n / 2], q = mesh_of(s, s->top)->p[s->source_back == s->top_back ? cm->n / 2 : cm->n - 1 - cm->n / 2];
  double tolerance = 1e-9 * vec3_length(shift[0]);
  return vec3_distance(shift[0], shift[1]) > tolerance || vec3_distance(vec3_sub(q, p), shift[0]) > 1e-6 * vec3_length(shift[0]);
}

// The motion that the face was swept by, read off a side: along a straight line, along normals (nodes go straight to their copies),
// about the centre of an arc; another (a screw) is followed by the interpolation of the filling.
typedef struct {
  enum { SWEEP_LINE, SWEEP_NORMALS, SWEEP_ARC, SWEEP_OTHER } kind;
  Vec3 shift, centre, axis;
  double angle;
  Filling filling;
  int source_side; // of the filling
} Motion;

static bool motion_of(const Sweeping *s, Motion *motion)
{
  const Model *m = s->in->model;
  int which = s->side[0] != NONE ? 0 : 1;
  const Curve *c = model_curve_at(m, s->side[which]);
  bool back = s->side_back[which];
  Motion r = {.kind = SWEEP_OTHER};
  bool found = true;
  Vec3 a = model_point(m, back ? c->end : c->begin)->xyz, b = model_point(m, back ? c->begin : c->end)->xyz;
  if (swept_by_normals(s)) {
    r.kind = SWEEP_NORMALS;
  } else if (c->type == CURVE_LINE) {
    r.kind = SWEEP_LINE;
    r.shift = vec3_sub(b, a);
  } else if (c->type == CURVE_CIRCLE && c->npoint == 3 && model_point(m, c->point[1])) {
    r.kind = SWEEP_ARC;
    r.centre = model_point(m, c->point[1])->xyz;
    Vec3 along = vec3_scale(back ? -1 : 1, curve_deriv(m, c, back ? 1 : 0));
    r.axis = vec3_cross(vec3_sub(a, r.centre), along);
    r.axis = vec3_scale(1 / vec3_length(r.axis), r.axis);
    r.angle = curve_angle(m, c);
  } else if ((found = filling_init(&r.filling, m, s->f) && r.filling.n == 4)) {
    for (int k = 0; k < r.filling.n; k++)
      if (r.filling.curve[k]->tag == abs(s->f->extruded_curve)) r.source_side = k;
  }
  *motion = r;
  return found;
}

static Vec3 rotate(const Motion *r, Vec3 p, double angle)
{
  Vec3 d = vec3_sub(p, r->centre);
  double c = cos(angle), s = sin(angle), h = vec3_dot(d, r->axis) * (1 - c);
  Vec3 q = vec3_add(vec3_scale(c, d), vec3_scale(s, vec3_cross(r->axis, d)));
  return vec3_add(r->centre, vec3_add(q, vec3_scale(h, r->axis)));
}

// Place of node i of the swept curve when it has come to height h.
static Vec3 carried(const Sweeping *s, const Motion *r, size_t i, double h)
{
  Vec3 p = s->en->xyz[node_at(s, s->source, s->source_back, i)];
  switch (r->kind) {
  case SWEEP_NORMALS: {
    Vec3 q = s->en->xyz[node_at(s, s->top, s->top_back, i)];
    return vec3_add(p, vec3_scale(h, vec3_sub(q, p)));
  }
  case SWEEP_LINE: return vec3_add(p, vec3_scale(h, r->shift));
  case SWEEP_ARC: return rotate(r, p, h * r->angle);
  case SWEEP_OTHER: break;
  }
  const CurveMesh *cm = mesh_of(s, s->source);
  double u = cm->u[s->source_back ? cm->n - 1 - i : i]; // in the curve's own sense
  if (r->filling.reversed[r->source_side]) u = 1 - u;   // in the loop's
  Vec2 q = filling_side(&r->filling, r->source_side, u);
  switch (r->source_side) {
  case 0: q.y = h; break;
  case 1: q.x = 1 - h; break;
  case 2: q.y = 1 - h; break;
  default: q.x = h; break;
  }
  return filling_point(&r->filling, q.x, q.y);
}

// Row i of the grid: the swept curve's nodes, run so that a point on the axis comes first.
static bool fill(const Sweeping *s, FaceMesh *out)
{
  Motion motion;
  if (!motion_of(s, &motion)) return false;
  bool flip = s->side[1] == NONE && s->side[0] != NONE, fan = flip || s->side[0] == NONE;
  size_t nu = s->nu, nv = s->nv;
  uint32_t *id = mem_alloc((nu + 1) * (nv + 1) * sizeof *id), base = (uint32_t)s->en->n;
  out->own = mem_alloc(nu * nv * sizeof *out->own);
  for (size_t i = 0; i <= nu; i++)
    for (size_t j = 0; j <= nv; j++) {
      uint32_t *to = &id[(flip ? nu - i : i) * (nv + 1) + j];
      int end = i == 0 ? 0 : i == nu ? 1 : -1;
      if (j == 0 || (end >= 0 && s->side[end] == NONE))
        *to = node_at(s, s->source, s->source_back, i);
      else if (j == nv)
        *to = node_at(s, s->top, s->top_back, i);
      else if (end >= 0)
        *to = node_at(s, s->side[end], s->side_back[end], j);
      else {
        *to = base + (uint32_t)out->nown;
        out->own[out->nown++] = carried(s, &motion, i, layer_height(&s->f->layers, j));
      }
    }
  bool quads = s->f->layers.recombine || s->f->recombine || s->in->options->Mesh_RecombineAll;
  face_mesh_from_grid(out, &(GridCells){nu, nv, id, flip ? ARRANGE_LEFT : ARRANGE_RIGHT, fan, s->mirror != flip}, quads);
  free(id);
  return true;
}

bool extruded_face(const Mesh2dInput *in, const Face *f, const EdgeNodes *en, FaceMesh *out, Diag *diag)
{
  if (!f->extruded_curve || !f->layers.n) return false;
  Sweeping s = {.in = in, .f = f, .en = en};
  bool fits = set_up(&s) && (s.side[0] != NONE || s.side[1] != NONE) && !f->embedded_curves.len && !f->embedded_points.len;
  fits = fits && fill(&s, out);
  if (fits && f->planar && !face_mesh_valid(out, f, en)) {
    face_mesh_free(out);
    fits = false;
  }
  if (!fits)
    diag_warning(diag, f->loc, "surface %d cannot be meshed in the layers of its extrusion (the curves around it do not have "
                 "the nodes for that, or cells would be folded): it is meshed as the others", f->tag);
  return fits;
}
