// tri_front_quad.c - points on lattices along a cross field: triangles with right angles, which pair to quads
// SPDX-License-Identifier: MIT
//
// In the norm L-infinity of the axes of a cross, a right-angled isosceles triangle with legs along the axes is equilateral. So the
// ideal neighbours of a vertex are the four points at distance h along its cross [Remacle13]. Each vertex proposes them; a proposal
// is taken where no vertex is nearer than a part of h in that norm, which the cavity of the point in the constrained Delaunay
// triangulation tells: the nearest vertices in sight are on its rim. Proposals wait in order of size (Frontal-Delaunay for quads)
// or of age (packing of parallelograms, [Baudouin14]).
#include "base/base.h"
#include "tri/refine_int.h"

// No vertex closer than this part of h, in the norm of the cross.
#define CLEARANCE 0.65
// A vertex within this part of h of where a neighbour of p along an axis would be has a say in where p is to be.
#define SUPPORT 0.35
// What remains is refined while its adimensional size is above this: a hole that lacks one point of a lattice has sqrt(3).
#define HOLE 1.68

enum { SMOOTHING = 5 };
enum { NKEYS = 352 }; // 8 keys to the octave of the squared size

typedef struct {
  double cosine, sine;
} Axes;

typedef struct {
  Refiner *r;
  bool by_age;
  uint32_t cap_v;
  RefineCross x;      // by vertex
  EdgeId *edge;       // by vertex: some half-edge with that origin
  int top;            // no stack above this one has entries
  U32Vec stack[NKEYS]; // of proposals, 4 v + k: the neighbour of v in direction k of its cross
  U32Vec queue;       // by age
  size_t head;
} Lattice;

static Axes axes_of(double angle) { return (Axes){cos(angle), sin(angle)}; }

// The vector from a to b in the axes.
static void along(Axes x, const double *a, const double *b, double *d)
{
  double u = b[0] - a[0], v = b[1] - a[1];
  d[0] = x.cosine * u + x.sine * v, d[1] = x.cosine * v - x.sine * u;
}

static void direction(Axes x, uint32_t k, double *d)
{
  double c = x.cosine, s = x.sine;
  d[0] = k == 0 ? c : k == 1 ? -s : k == 2 ? -c : s;
  d[1] = k == 0 ? s : k == 1 ? c : k == 2 ? -s : -c;
}

static double cross_at(const Lattice *l, const double *p, uint32_t *near)
{
  const TriRefineParams *q = l->r->p;
  return q->cross ? q->cross(q->cross_ctx, (Vec2){p[0], p[1]}, near) : 0;
}

static void grow(Lattice *l)
{
  uint32_t n = l->r->cap_v;
  if (n <= l->cap_v) return;
  l->x.angle = mem_realloc(l->x.angle, n * sizeof *l->x.angle);
  l->x.stretch = mem_realloc(l->x.stretch, n * sizeof *l->x.stretch);
  l->x.near = mem_realloc(l->x.near, n * sizeof *l->x.near);
  l->edge = mem_realloc(l->edge, n * sizeof *l->edge);
  l->cap_v = n;
}

// ---- sizes

// Boundary edges are a whole number to each curve, so not exactly as long as wanted; a lattice that kept to the wanted length
// would drift against theirs. Their ratio is carried into the face, as sizes are.
static void initial_stretch(Lattice *l)
{
  const Tri *m = l->r->m;
  double *sum = mem_zalloc((m->nv + 1) * sizeof *sum);
  uint32_t *n = mem_zalloc((m->nv + 1) * sizeof *n);
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    if (!tri_is_inside(m, tri_of(e)) || !tri_is_segment(m, e)) continue;
    VertId v[2] = {tri_org(m, e), tri_dest(m, e)};
    double length = log(metric_length(tri_xy(m, v[0]), tri_xy(m, v[1]), l->r->size[v[0]], l->r->size[v[1]]));
    for (int i = 0; i < 2; i++) sum[v[i]] += length, n[v[i]]++;
  }
  for (VertId v = 0; v < m->nv; v++) l->x.stretch[v] = n[v] ? exp(fmax(-0.3, fmin(0.3, sum[v] / n[v]))) : 1;
  free(sum);
  free(n);
}

static double stretch_at(const Lattice *l, const double *p, TriId t)
{
  const Tri *m = l->r->m;
  const uint32_t *v = m->vert + 3 * (size_t)t;
  double sum = 0, whole = 0;
  for (int i = 0; i < 3; i++) {
    const double *a = tri_xy(m, v[(i + 1) % 3]), *b = tri_xy(m, v[(i + 2) % 3]);
    double w = fmax(0, (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]));
    sum += w * l->x.stretch[v[i]], whole += w;
  }
  return whole > 0 ? sum / whole : 1;
}

// ---- proposals

// The half-edge with origin v whose triangle the direction d enters; NONE where that is outside.
static EdgeId wedge(const Lattice *l, VertId v, const double *d)
{
  const Tri *m = l->r->m;
  const double *p = tri_xy(m, v);
  EdgeId first = l->edge[v], e = first;
  do {
    if (tri_is_inside(m, tri_of(e))) {
      const double *a = tri_xy(m, tri_dest(m, e)), *b = tri_xy(m, tri_apex(m, e));
      if ((a[0] - p[0]) * d[1] - (a[1] - p[1]) * d[0] >= 0 && d[0] * (b[1] - p[1]) - d[1] * (b[0] - p[0]) > 0) return e;
    }
    e = tri_ccw(m, e);
  } while (e != first);
  return NONE;
}

// Is there a vertex joined to v near p, where v would have a neighbour?
static bool is_taken(const Lattice *l, VertId v, const double *p, Axes x, double h)
{
  const Tri *m = l->r->m;
  EdgeId first = l->edge[v], e = first;
  do {
    VertId u = tri_dest(m, e);
    double d[2];
    if (u != TRI_INF) {
      along(x, p, tri_xy(m, u), d);
      if (fmax(fabs(d[0]), fabs(d[1])) < CLEARANCE * h) return true;
    }
    e = tri_ccw(m, e);
  } while (e != first);
  return false;
}

static int key_of(const Lattice *l, EdgeId e)
{
  const Tri *m = l->r->m;
  const uint32_t *v = m->vert + 3 * (size_t)tri_of(e);
  double area2, h = (l->r->size[v[0]] + l->r->size[v[1]] + l->r->size[v[2]]) / 3;
  double r2 = metric_radius2(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), &area2);
  return refine__key(fmax(1, 2 * r2 / (h * h)), 20, NKEYS);
}

static void wait(Lattice *l, uint32_t proposal, int key)
{
  vec_push(&l->stack[key], proposal);
  if (key > l->top) l->top = key;
}

static void propose(Lattice *l, VertId v)
{
  Axes x = axes_of(l->x.angle[v]);
  for (uint32_t k = 0; k < 4; k++) {
    double d[2];
    direction(x, k, d);
    EdgeId e = wedge(l, v, d);
    if (e == NONE) continue;
    if (l->by_age) vec_push(&l->queue, 4 * v + k);
    else wait(l, 4 * v + k, key_of(l, e));
  }
}

// The next proposal and the half-edge of its vertex that it lies beside; NONE when there is none.
static uint32_t take(Lattice *l, EdgeId *e)
{
  double d[2];
  while (l->by_age && l->head < l->queue.len) {
    uint32_t q = l->queue.data[l->head++];
    direction(axes_of(l->x.angle[q / 4]), q % 4, d);
    if ((*e = wedge(l, q / 4, d)) != NONE) return q;
  }
  for (; l->top >= 0; l->top--) {
    while (l->stack[l->top].len) {
      uint32_t q = vec_pop(&l->stack[l->top]);
      direction(axes_of(l->x.angle[q / 4]), q % 4, d);
      if ((*e = wedge(l, q / 4, d)) == NONE) continue;
      int key = key_of(l, *e);
      if (key >= l->top) return q;
      vec_push(&l->stack[key], q); // triangles get smaller while it waits
    }
  }
  return NONE;
}

// ---- points

// Cavity of p, the walk starting at t. False where no vertex can be.
static bool open_cavity(Lattice *l, const double *p, TriId *t)
{
  EdgeId blocked;
  if (!isfinite(p[0]) || !isfinite(p[1])) return false;
  const Tri *m = l->r->m;
  *t = refine__walk(m, p, *t, &blocked);
  if (*t == NONE) return false;
  for (EdgeId e = 3 * *t; e < 3 * *t + 3; e++) { // on a lattice, points often meet vertices exactly; no circle can tell then
    const double *a = tri_xy(m, m->vert[e]);
    if (a[0] == p[0] && a[1] == p[1]) return false;
  }
  return refine__cavity(l->r, p, *t, true);
}

// The mean of where the vertices around p would have it; false if that is p. The cavity of p is open.
static bool agree(const Lattice *l, double *p, Axes x, double h)
{
  const Refiner *r = l->r;
  double sum[2] = {0, 0};
  int n = 0;
  for (size_t i = 0; i < r->rim.len; i++) {
    double d[2];
    along(x, tri_xy(r->m, r->rim.data[i].a), p, d);
    d[0] /= h, d[1] /= h;
    int k = fabs(d[0]) > fabs(d[1]) ? 0 : 1;
    if (fabs(fabs(d[k]) - 1) > SUPPORT || fabs(d[1 - k]) > SUPPORT) continue;
    sum[k] += copysign(1, d[k]) - d[k], sum[1 - k] -= d[1 - k];
    n++;
  }
  if (n < 2) return false;
  double u = sum[0] * h / n, v = sum[1] * h / n;
  if (fabs(u) + fabs(v) < 1e-3 * h) return false;
  p[0] += x.cosine * u - x.sine * v, p[1] += x.sine * u + x.cosine * v;
  return true;
}

static bool is_clear(const Lattice *l, const double *p, Axes x, double h)
{
  const Refiner *r = l->r;
  for (size_t i = 0; i < r->rim.len; i++) {
    double d[2];
    along(x, p, tri_xy(r->m, r->rim.data[i].a), d);
    if (fmax(fabs(d[0]), fabs(d[1])) < CLEARANCE * h) return false;
  }
  return true;
}

static void insert(Lattice *l, const double *p, TriId t, uint32_t near, double angle, double h, double carried)
{
  Refiner *r = l->r;
  double stretch = stretch_at(l, p, t);
  VertId v = refine__commit(r, h, carried);
  grow(l);
  l->x.near[v] = near;
  l->x.angle[v] = angle;
  l->x.stretch[v] = stretch;
  for (size_t i = 0; i < r->rim.len; i++) {
    const RimSide *s = &r->rim.data[i];
    l->edge[s->a] = 3 * s->tri;
    l->edge[v] = 3 * s->tri + 2;
  }
  propose(l, v);
}

// Take up proposal q beside half-edge e.
static void try_proposal(Lattice *l, uint32_t q, EdgeId e)
{
  Refiner *r = l->r;
  const Tri *m = r->m;
  VertId v = q / 4;
  const double *at = tri_xy(m, v);
  TriId t = tri_of(e);
  Axes x = axes_of(l->x.angle[v]);
  double d[2], half[2], p[2], carried;
  direction(x, q % 4, d);
  double h = r->size[v] * l->x.stretch[v];
  for (int i = 0; i < 2; i++) p[i] = at[i] + h * d[i], half[i] = at[i] + 0.5 * h * d[i];
  if (is_taken(l, v, p, x, h)) return;
  // Size and direction of the edge to be made are those of its middle.
  uint32_t near = l->x.near[v];
  x = axes_of(l->x.angle[v] + remainder(cross_at(l, half, &near) - l->x.angle[v], 0.5 * 3.14159265358979323846));
  direction(x, q % 4, d);
  h = refine__size_at(r, half, t, &carried) * l->x.stretch[v];
  for (int i = 0; i < 2; i++) p[i] = at[i] + h * d[i];
  if (!open_cavity(l, p, &t)) return;
  if (agree(l, p, x, h) && !open_cavity(l, p, &t)) return;
  double angle = cross_at(l, p, &near);
  h = refine__size_at(r, p, t, &carried);
  if (is_clear(l, p, x, h * stretch_at(l, p, t))) insert(l, p, t, near, angle, h, carried);
}

// ---- the whole

static void start(Lattice *l)
{
  Refiner *r = l->r;
  const Tri *m = r->m;
  grow(l);
  initial_stretch(l);
  for (VertId v = 0; v < m->nv; v++) l->edge[v] = NONE;
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (!tri_is_free(m, tri_of(e)) && m->vert[e] != TRI_INF) l->edge[m->vert[e]] = e;
  for (VertId v = 0; v < m->nv; v++) {
    l->x.near[v] = r->p->cross_near ? r->p->cross_near[v] : NONE;
    l->x.angle[v] = cross_at(l, tri_xy(m, v), &l->x.near[v]);
  }
  for (VertId v = m->nv; v-- > 0;) // stacks: so the first come first
    if (l->edge[v] != NONE) propose(l, v);
}

static void run(Lattice *l)
{
  uint32_t q;
  EdgeId e;
  while ((q = take(l, &e)) != NONE && refine__go_on(l->r)) try_proposal(l, q, e);
}

// Start anew from the middles of holes, such as dips of the size field that no lattice has met. Returns how many there were.
static size_t seed_holes(Lattice *l)
{
  Refiner *r = l->r;
  const Tri *m = r->m;
  size_t n = 0;
  for (TriId t = 0; t < m->nt && r->stats->outcome == REFINE_DONE; t++) {
    if (!tri_is_inside(m, t) || refine__excess2(r, HOLE, t) <= 1) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    double p[2], carried;
    metric_centre(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), p);
    uint32_t near = l->x.near[v[0]];
    TriId at = t;
    if (!open_cavity(l, p, &at)) continue;
    double angle = cross_at(l, p, &near), h = refine__size_at(r, p, at, &carried);
    insert(l, p, at, near, angle, h, carried);
    run(l);
    n++;
  }
  return n;
}

// What there is to know of vertices from `first` on, which were placed by other means.
static void learn(Lattice *l, VertId first)
{
  const Tri *m = l->r->m;
  grow(l);
  for (VertId v = first; v < m->nv; v++) l->x.near[v] = NONE, l->x.stretch[v] = 1;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    VertId v = m->vert[e], u;
    if (!tri_is_inside(m, tri_of(e)) || v < first || (u = tri_dest(m, e)) >= first || l->x.near[v] != NONE) continue;
    l->x.near[v] = l->x.near[u];
    l->x.stretch[v] = l->x.stretch[u];
  }
  for (VertId v = first; v < m->nv; v++) l->x.angle[v] = cross_at(l, tri_xy(m, v), &l->x.near[v]);
}

void refine__front_quad(Refiner *r, bool by_age)
{
  Lattice l = {.r = r, .by_age = by_age, .top = -1};
  VertId given = r->m->nv;
  start(&l);
  run(&l);
  while (seed_holes(&l)) continue;
  for (int k = 0; k < NKEYS; k++) vec_free(&l.stack[k]);
  vec_free(&l.queue);
  VertId placed = r->m->nv;
  refine__delaunay(r, HOLE);
  learn(&l, placed);
  refine__lattice_smooth(r, &l.x, given, SMOOTHING);
  free(l.x.angle), free(l.x.stretch), free(l.x.near), free(l.edge);
}
