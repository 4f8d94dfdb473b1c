// face_cross.c - the cross field that the meshes made for quads follow, on a triangulation that is to be refined
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/face_cross.h"

#include <math.h>

// The mesh of the field has triangles of good shape, and about this many along the shorter side of a square at least.
enum { ACROSS = 24 };
#define ANGLE 22.0
// So many triangles at most: a sliver, which would take as many as it is longer than wide, keeps some of bad shape.
enum { MOST = 10000, MOST_PER_VERTEX = 50 };

// Sizes of that mesh: small where the wanted size changes, though not much smaller than this.
typedef struct {
  const TriRefineParams *p;
  double longest;
} Background;
#define SIZES 5.0    // edges are at least so many wanted sizes long, unless the boundary asks for less
#define CHANGE 0.3   // and otherwise the logarithm of the size changes by no more than about this along them

static double background_size(void *ctx, Vec2 p)
{
  const Background *b = ctx;
  if (!b->p->size) return b->longest;
  double h = b->p->size(b->p->size_ctx, p), x = b->p->size(b->p->size_ctx, (Vec2){p.x + h, p.y}),
         y = b->p->size(b->p->size_ctx, (Vec2){p.x, p.y + h}), change = (fabs(log(x / h)) + fabs(log(y / h))) / h;
  if (!(h < b->longest) || !(change > 0)) return b->longest;
  return fmin(b->longest, fmax(SIZES * h, CHANGE / change));
}

// The linear function in triangle t with those values at its corners, at p in it.
static double interpolate(const Tri *m, TriId t, const double *value, const double *p)
{
  double sum = 0, whole = 0;
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
    EdgeId o = tri_next(e);
    const double *a = tri_xy(m, m->vert[o]), *b = tri_xy(m, tri_dest(m, o));
    double w = fmax(0, (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]));
    sum += w * value[m->vert[e]], whole += w;
  }
  return whole > 0 ? sum / whole : value[m->vert[3 * t]];
}

// The triangle at half-edge e that a point was located in, or beside it the one of the domain: splits of boundary segments lie on the
// edge, or by rounding beyond.
static TriId triangle_at(const Tri *m, EdgeId e)
{
  TriId t = tri_of(e);
  for (EdgeId s = 3 * t; s < 3 * t + 3 && !tri_is_inside(m, t); s++)
    if (tri_is_inside(m, tri_of(m->twin[s]))) return tri_of(m->twin[s]);
  for (EdgeId s = 3 * t; s < 3 * t + 3 && tri_is_ghost(m, t); s++)
    if (!tri_is_ghost(m, tri_of(m->twin[s]))) return tri_of(m->twin[s]);
  return t;
}

static double inside_area(const Tri *t)
{
  double sum = 0;
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    const double *a = tri_xy(t, t->vert[3 * k]), *b = tri_xy(t, t->vert[3 * k + 1]), *c = tri_xy(t, t->vert[3 * k + 2]);
    sum += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  return sum;
}

static void refine_copy(Tri *copy, const TriRefineParams *q)
{
  Background b = {q, sqrt(inside_area(copy)) / ACROSS};
  TriRefineParams p = tri_refine_defaults();
  p.algorithm = REFINE_DELAUNAY;
  p.size = background_size;
  p.size_ctx = &b;
  p.extend_from_boundary = false;
  p.smoothing = p.optimize = 0;
  p.min_angle = ANGLE;
  p.max_triangles = MOST + MOST_PER_VERTEX * (size_t)copy->nv;
  tri_refine(copy, &p);
}

// Sizes wanted at the vertices of the mesh of the field: what is carried into the face, linear in the triangles of the empty mesh,
// or less.
static double *wanted_sizes(const Tri *mesh, const Tri *empty, const TriRefineParams *q)
{
  double *size = mem_alloc((mesh->nv + 1) * sizeof *size), *carried = NULL;
  Tri copy;
  tri_copy(&copy, empty);
  if (q->extend_from_boundary || !q->size) {
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = REFINE_EMPTY;
    p.smoothing = p.optimize = 0;
    p.vertex_size = q->vertex_size;
    p.sizes_out = &carried;
    tri_refine(&copy, &p);
  }
  for (VertId v = 0; v < mesh->nv; v++) {
    const double *p = tri_xy(mesh, v);
    EdgeId e;
    size[v] = INFINITY;
    if (carried && v < empty->nv) size[v] = carried[v];
    else if (carried) tri_locate(&copy, p, NONE, &e), size[v] = interpolate(&copy, triangle_at(&copy, e), carried, p);
    if (q->size) size[v] = fmin(size[v], q->size(q->size_ctx, (Vec2){p[0], p[1]}));
  }
  tri_free(&copy);
  free(carried);
  return size;
}

static CrossField *field_on(const Tri *t, const double *size)
{
  U32Vec tri = {0}, aligned = {0};
  for (TriId k = 0; k < t->nt; k++) {
    if (!tri_is_inside(t, k)) continue;
    for (EdgeId e = 3 * k; e < 3 * k + 3; e++) {
      vec_push(&tri, t->vert[e]);
      if (!tri_is_segment(t, e) || t->twin[e] < e || !tri_is_inside(t, tri_of(t->twin[e]))) continue;
      vec_push(&aligned, t->vert[e]);
      vec_push(&aligned, tri_dest(t, e));
    }
  }
  CrossInput in = {t->xy, t->nv, tri.data, tri.len / 3, aligned.data, aligned.len / 2, size};
  CrossField *f = cross_field_new(&in);
  vec_free(&tri);
  vec_free(&aligned);
  return f;
}

static double direction(void *ctx, Vec2 p, uint32_t *near) { return cross_field_angle(ctx, p, near); }

void face_cross_prepare(FaceCross *c, const Tri *t, TriRefineParams *p)
{
  if (p->algorithm != REFINE_FRONT_QUAD && p->algorithm != REFINE_PACK) return;
  Tri mesh;
  tri_copy(&mesh, t);
  refine_copy(&mesh, p);
  double *size = wanted_sizes(&mesh, t, p);
  c->field = field_on(&mesh, size);
  free(size);
  tri_free(&mesh);
  for (uint32_t v = 0; v < t->nv; v++) vec_push(&c->near, cross_field_at_vertex(c->field, v));
  p->cross = direction;
  p->cross_ctx = c->field;
  p->cross_near = c->near.data;
}

void face_cross_free(FaceCross *c)
{
  cross_field_free(c->field);
  vec_free(&c->near);
}
