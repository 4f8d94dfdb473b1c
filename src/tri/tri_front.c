// tri_front.c - Frontal-Delaunay refinement: ideal points in front of active edges, inserted by Bowyer-Watson
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/refine_int.h"

// A triangle is small when its adimensional size, sqrt(3) R / h [book eq. 4.19], is at most this. The front runs between small
// triangles and the others.
#define LIMIT 1.2247448713915890

// A front edge: half-edge e of a triangle that is not small, with a segment or a small triangle on the other side. Stale when
// the vertices of e are no longer a and b.
typedef struct {
  EdgeId e;
  VertId a, b;
} FrontEdge;

// Front edges wait in stacks by the size of their triangle, largest first: fronts then leave the finest places first, where a
// dislocation costs least, and one front outruns the others where the size is uniform, so that one lattice fills the face.
// The first layer along the segments goes before the rest, so that every boundary has triangles aligned with it.
// In large faces, triangles 16 times as large as they may be, and larger, are all alike: before the open middle of the face the latest edge
// goes first, and rows are laid one beside the other. Largest first jumps between the places where the largest empty circle touches
// the front, which are out of the caches then.
enum { NKEYS = 704, ALIKE = 129, HEAD_START = 64 }; // 16 keys to the octave of the squared size

typedef struct {
  Refiner *r;
  int nkeys; // of edges that are not segments
  int top; // no stack above this one has entries
  DoubleVec excess; // of the triangles just made
  Vec(FrontEdge) stack[NKEYS];
} Front;

// Square of the adimensional size of t over that of the limit.
static double excess2(const Refiner *r, TriId t)
{
  const Tri *m = r->m;
  const uint32_t *v = m->vert + 3 * (size_t)t;
  double area2, h = (r->size[v[0]] + r->size[v[1]] + r->size[v[2]]) / 3;
  double r2 = metric_radius2(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), &area2);
  return 3 * r2 / (LIMIT * LIMIT * h * h);
}

// Is t, whose excess2 is x, small?
static bool is_small(const Refiner *r, TriId t, double x)
{
  if (x > 1 || !r->p->size) return x <= 1;
  // Small by the sizes at its corners: ask inside, lest a dip of the field be missed.
  const uint32_t *v = r->m->vert + 3 * (size_t)t;
  double h = (r->size[v[0]] + r->size[v[1]] + r->size[v[2]]) / 3, g = refine__size_inside(r, t);
  return x * h * h <= g * g;
}

// e is a front edge, of a triangle whose excess2 is x.
static void push(Front *f, EdgeId e, double x)
{
  const Tri *m = f->r->m;
  FrontEdge edge = {e, tri_org(m, e), tri_dest(m, e)};
  int k = refine__key(x, 19, f->nkeys);
  if (tri_is_segment(m, e)) k += HEAD_START;
  vec_push(&f->stack[k], edge);
  if (k > f->top) f->top = k;
}

// Next front edge that is still one, or NONE.
static EdgeId take(Front *f)
{
  const Tri *m = f->r->m;
  for (; f->top >= 0; f->top--) {
    while (f->stack[f->top].len) {
      FrontEdge g = vec_pop(&f->stack[f->top]);
      TriId t = tri_of(g.e);
      if (m->vert[g.e] != g.a || tri_dest(m, g.e) != g.b) continue;
      if (m->flag[t] & (REFINE_SMALL | TRI_FREE)) continue;
      if (tri_is_segment(m, g.e) || m->flag[tri_of(m->twin[g.e])] & REFINE_SMALL) return g.e;
    }
  }
  return NONE;
}

// The ideal point before front edge e. False if the triangle there is obtuse at its apex: then another side must do.
static bool ideal_point(const Front *f, EdgeId e, double *p)
{
  Refiner *r = f->r;
  const Tri *m = r->m;
  VertId va = tri_org(m, e), vb = tri_dest(m, e);
  const double *a = tri_xy(m, va), *b = tri_xy(m, vb), *c = tri_xy(m, tri_apex(m, e));
  double centre[2];
  metric_centre(a, b, c, centre);
  double mid[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  double len = sqrt(metric_distance2(a, b)), nx = (a[1] - b[1]) / len, ny = (b[0] - a[0]) / len;
  double q = (centre[0] - mid[0]) * nx + (centre[1] - mid[1]) * ny;
  if (!(q > 0.1 * len) || !isfinite(q)) return false;
  double h = 0.5 * (r->size[va] + r->size[vb]), d = metric_height(q, h), ignored;
  // The edges to be made are half as far away as the point.
  double half[2] = {mid[0] + 0.5 * d * nx, mid[1] + 0.5 * d * ny};
  d = metric_height(q, refine__size_at(r, half, tri_of(e), &ignored));
  p[0] = mid[0] + d * nx, p[1] = mid[1] + d * ny;
  return true;
}

static void advance(Front *f)
{
  Refiner *r = f->r;
  Tri *m = r->m;
  vec_clear(&f->excess);
  for (size_t i = 0; i < r->rim.len; i++) {
    TriId t = r->rim.data[i].tri;
    double x = excess2(r, t);
    if (is_small(r, t, x)) m->flag[t] |= REFINE_SMALL;
    vec_push(&f->excess, x);
  }
  for (size_t i = 0; i < r->rim.len; i++) {
    RimSide *s = &r->rim.data[i];
    if (m->flag[s->tri] & REFINE_SMALL) {
      TriId over = tri_of(s->outer);
      if (!s->is_seg && !(m->flag[over] & REFINE_SMALL)) push(f, s->outer, excess2(r, over));
      continue;
    }
    for (EdgeId e = 3 * s->tri; e < 3 * s->tri + 3; e++)
      if (tri_is_segment(m, e) || m->flag[tri_of(m->twin[e])] & REFINE_SMALL) push(f, e, f->excess.data[i]);
  }
}

static void start(Front *f)
{
  Refiner *r = f->r;
  Tri *m = r->m;
  for (TriId t = 0; t < m->nt; t++)
    if (tri_is_inside(m, t) && is_small(r, t, excess2(r, t))) m->flag[t] |= REFINE_SMALL;
  for (EdgeId e = 3 * m->nt; e-- > 0;) { // stacks: so the first edges come first
    TriId t = tri_of(e);
    if (!tri_is_inside(m, t) || m->flag[t] & REFINE_SMALL) continue;
    if (tri_is_segment(m, e) || m->flag[tri_of(m->twin[e])] & REFINE_SMALL) push(f, e, excess2(r, t));
  }
}

void refine__frontal(Refiner *r)
{
  Front f = {.r = r, .nkeys = r->expected > REFINE_LARGE ? ALIKE : NKEYS - HEAD_START, .top = -1};
  start(&f);
  EdgeId e;
  while ((e = take(&f)) != NONE && refine__go_on(r)) {
    double p[2], carried;
    if (!ideal_point(&f, e, p)) continue;
    EdgeId blocked;
    TriId t = refine__walk(r->m, p, tri_of(e), &blocked);
    if (t == NONE || !refine__cavity(r, p, t, true)) continue;
    double h = refine__size_at(r, p, t, &carried);
    refine__commit(r, h, carried);
    advance(&f);
  }
  for (int k = 0; k < NKEYS; k++) vec_free(&f.stack[k]);
  vec_free(&f.excess);
  // What no front reached: obtuse corners, gaps between fronts.
  refine__delaunay(r, REFINE_LIMIT_SIZE);
}
