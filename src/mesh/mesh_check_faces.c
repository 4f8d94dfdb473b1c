// mesh_check_faces.c - the audit: orientation of elements, area and Euler characteristic of each face
// SPDX-License-Identifier: MIT
//
// A plane face is looked at along the axis nearest to its normal: dropping a coordinate keeps collinearity and the side of a
// line as they are, so the signs stay exact.
#include "base/base.h"

#include "mesh/mesh_check_int.h"

#include "geom/predicates.h"
#include "mesh/mesh_measure.h"

typedef struct {
  uint32_t entity, first, last;  // blocks first .. last-1
  int i, j;                      // coordinates kept
  int sign;                      // of the normal along the one dropped
  bool plane;
  size_t bad;                    // half-edges without a proper twin
} Face;

// Sum with the rounding errors carried along (Neumaier): its error is a few units in the last place of the sum of |terms|.
typedef struct {
  double sum, low, size;
} Sum;

static void sum_add(Sum *s, double x)
{
  double t = s->sum + x;
  s->low += fabs(s->sum) >= fabs(x) ? (s->sum - t) + x : (x - t) + s->sum;
  s->sum = t;
  s->size += fabs(x);
}

// Sign of the face's normal along z, by the majority of a sample.
static int turn_in_xy(const Mesh *m, const Face *f)
{
  enum { SAMPLE = 255 };
  int sum = 0;
  for (uint32_t b = f->first; b < f->last; b++) {
    const MeshBlock *k = &m->block[b];
    for (size_t i = 0; i < k->n; i += k->n / SAMPLE + 1) {
      const uint32_t *v = k->node + i * (size_t)elem_nodes(k->type);
      sum += orient2d(m->xyz + 3 * (size_t)v[0], m->xyz + 3 * (size_t)v[1], m->xyz + 3 * (size_t)v[2]);
    }
  }
  return sum < 0 ? -1 : 1;
}

// A face is plane if no corner is farther from its plane than 1e-6 of its size: then no fold can hide in the projection.
static void look_at(Check *c, Face *f)
{
  const Mesh *m = c->m;
  bool flat = true;
  double z = m->xyz[3 * (size_t)m->block[f->first].node[0] + 2];
  for (uint32_t b = f->first; flat && b < f->last; b++)
    for (size_t i = 0; flat && i < m->block[b].n * (size_t)elem_nodes(m->block[b].type); i++)
      flat = m->xyz[3 * (size_t)m->block[b].node[i] + 2] == z;
  if (flat) {
    *f = (Face){f->entity, f->first, f->last, 0, 1, turn_in_xy(m, f), true, 0};
    return;
  }
  Vec3 n = mesh_area_vector(m, f->entity);
  double a[3] = {n.x, n.y, n.z}, len = vec3_length(n), size;
  int drop = fabs(a[2]) >= fabs(a[0]) && fabs(a[2]) >= fabs(a[1]) ? 2 : fabs(a[0]) >= fabs(a[1]) ? 0 : 1;
  f->i = drop == 0 ? 1 : 0;
  f->j = drop == 2 ? 1 : 2;
  f->sign = (a[drop] < 0 ? -1 : 1) * (drop == 1 ? -1 : 1);
  f->plane = len > 0;
  if (!f->plane) return;
  n = vec3_scale(1 / len, n);
  Vec3 origin = mesh_xyz(m, m->block[f->first].node[0]);
  double off = 0;
  size = sqrt(len);
  for (uint32_t b = f->first; b < f->last; b++) {
    const MeshBlock *k = &m->block[b];
    size_t count = k->n * (size_t)elem_nodes(k->type);
    for (size_t i = 0; i < count; i++) off = fmax(off, fabs(vec3_dot(n, vec3_sub(mesh_xyz(m, k->node[i]), origin))));
  }
  f->plane = off <= 1e-6 * size;
}

static void project(const Check *c, const Face *f, uint32_t node, double p[2])
{
  p[0] = c->m->xyz[3 * (size_t)node + (size_t)f->i];
  p[1] = c->m->xyz[3 * (size_t)node + (size_t)f->j];
}

static void check_element(Check *c, const Face *f, uint32_t b, size_t i, double p[4][2], int corners)
{
  const MeshBlock *k = &c->m->block[b];
  int worst = 1;
  for (int a = 0; a < (corners == 3 ? 1 : 4); a++) {
    int s = f->sign * orient2d(p[a], p[(a + 1) % corners], p[(a + 2) % corners]);
    worst = MIN(worst, s);
  }
  if (LIKELY(worst > 0)) return;
  double area = mesh_size_of(c->m, k, i, mesh_area_vector(c->m, f->entity));
  if (worst == 0)
    check__report(c, RULE_DEGENERATE, false, f->entity, b, i, NONE, mesh_center(c->m, k, i), "three corners are collinear");
  else if (corners == 4 && area > 0)
    check__report(c, RULE_ORIENTATION, false, f->entity, b, i, NONE, mesh_center(c->m, k, i), "the quadrangle is not convex");
  else
    check__report(c, RULE_ORIENTATION, false, f->entity, b, i, NONE, mesh_center(c->m, k, i),
                  "it turns the other way than its face (area %.6g)", area);
}

// Orientation of the elements, and the sum of their projected areas.
static void check_elements(Check *c, const Face *f, Sum *area)
{
  for (uint32_t b = f->first; b < f->last; b++) {
    const MeshBlock *k = &c->m->block[b];
    int corners = elem_corners(k->type), nodes = elem_nodes(k->type);
    for (size_t i = 0; i < k->n; i++) {
      double p[4][2];
      const uint32_t *v = k->node + i * (size_t)nodes;
      for (int a = 0; a < corners; a++) project(c, f, v[a], p[a]);
      check_element(c, f, b, i, p, corners);
      const double *q = p[corners - 1];
      double t = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
      if (corners == 4) t += (p[2][0] - p[0][0]) * (q[1] - p[0][1]) - (p[2][1] - p[0][1]) * (q[0] - p[0][0]);
      sum_add(area, t / 2);
    }
  }
}

// Elements of a face that is not plane: only that they are not flat.
static void check_flat(Check *c, const Face *f)
{
  for (uint32_t b = f->first; b < f->last; b++)
    for (size_t i = 0; i < c->m->block[b].n; i++)
      if (mesh_size_of(c->m, &c->m->block[b], i, (Vec3){0, 0, 0}) == 0)
        check__report(c, RULE_DEGENERATE, false, f->entity, b, i, NONE, mesh_center(c->m, &c->m->block[b], i), "its area is 0");
}

// Times the curve is listed in the boundary of the face, and the sum of its signs.
static int times_listed(const MeshEntity *f, int curve, int *sign)
{
  int n = 0;
  *sign = 0;
  for (size_t i = 0; i < f->boundary.len; i++)
    if (abs(f->boundary.data[i]) == curve) {
      n++;
      *sign += f->boundary.data[i] < 0 ? -1 : 1;
    }
  return n;
}

// True if every bounding curve is known and has line elements, so that the boundary can be asked for.
static bool boundary_known(const Check *c, uint32_t face)
{
  const MeshEntity *f = &c->m->entity[face];
  for (size_t i = 0; i < f->boundary.len; i++) {
    uint32_t e = mesh_find_entity(c->m, 1, abs(f->boundary.data[i]));
    if (e == NONE || !c->curve_lines[e]) return false;
  }
  return f->boundary.len > 0;
}

// Blocks of an entity: the first, and one past the last.
static void blocks_of(const Mesh *m, uint32_t entity, uint32_t *first, uint32_t *last)
{
  uint32_t lo = 0, hi = (uint32_t)m->nblock;
  while (lo < hi) {
    uint32_t mid = lo + (hi - lo) / 2;
    if (m->block[mid].entity < entity)
      lo = mid + 1;
    else
      hi = mid;
  }
  for (*first = hi = lo; hi < m->nblock && m->block[hi].entity == entity;) hi++;
  *last = hi;
}

// What Green's formula about `origin` gives for the line elements of a curve, run backwards if sign < 0.
static void add_curve(const Check *c, const Face *f, uint32_t curve, int sign, const double origin[2], Sum *area)
{
  const Mesh *m = c->m;
  uint32_t b, last;
  blocks_of(m, curve, &b, &last);
  for (; b < last; b++) {
    const MeshBlock *k = &m->block[b];
    for (size_t i = 0; i < k->n; i++) {
      const uint32_t *v = k->node + i * (size_t)elem_nodes(k->type);
      double p[2], q[2];
      project(c, f, v[0], p);
      project(c, f, v[1], q);
      double t = (p[0] - origin[0]) * (q[1] - origin[1]) - (p[1] - origin[1]) * (q[0] - origin[0]);
      sum_add(area, sign * t / 2);
    }
  }
}

// The area within the line elements of the bounding curves: that of the largest loop less the others, since holes may be run
// either way and be listed first. Loops follow each other in the list; one ends where it comes back to its beginning.
static void add_polygon(const Check *c, const Face *f, const double origin[2], Sum *area)
{
  const MeshEntity *e = &c->m->entity[f->entity];
  double largest = 0;
  int start = 0;
  Sum loop = {0, 0, 0};
  for (size_t i = 0; i < e->boundary.len; i++) {
    int tag = e->boundary.data[i], sign = tag < 0 ? -1 : 1;
    uint32_t curve = mesh_find_entity(c->m, 1, abs(tag));
    const IntVec *ends = &c->m->entity[curve].boundary;
    int begin = ends->len ? abs(ends->data[0]) : 0, end = ends->len ? abs(ends->data[ends->len - 1]) : 0;
    if (!start) start = sign > 0 ? begin : end;
    add_curve(c, f, curve, sign, origin, &loop);
    if ((sign > 0 ? end : begin) != start && i + 1 < e->boundary.len) continue;
    double a = fabs(loop.sum + loop.low);
    sum_add(area, -a);
    area->size += loop.size;
    largest = fmax(largest, a);
    loop = (Sum){0, 0, 0};
    start = 0;
  }
  sum_add(area, largest);
  sum_add(area, largest);
}

static void check_area(Check *c, const Face *f, const Sum *elements, const double origin[2])
{
  if (!boundary_known(c, f->entity)) return;
  Sum polygon = {0, 0, 0};
  add_polygon(c, f, origin, &polygon);
  double a = fabs(elements->sum + elements->low), b = fabs(polygon.sum + polygon.low);
  // Each term is right to a few ulps of the products in it: those of elements are of the order of their area, except for
  // slivers; those of the polygon of the order of distance times edge. 1e-12 leaves room for slivers of aspect 1000.
  double tolerance = 1e-12 * fmax(elements->size, polygon.size);
  if (fabs(a - b) > tolerance)
    check__report(c, RULE_AREA, false, f->entity, NONE, 0, NONE, (Vec3){NAN, NAN, NAN},
                  "its elements add up to %.17g, its boundary encloses %.17g", a, b);
}

// ---- Euler characteristic ---------------------------------------------------------------------------------------------------
// Independent cycles E - V + C of a graph given by pairs of vertex numbers below nvert.
static size_t cycles(const U32Vec *pair, size_t nvert)
{
  uint32_t *up = mem_alloc(nvert * sizeof *up);
  for (size_t i = 0; i < nvert; i++) up[i] = (uint32_t)i;
  size_t n = 0;
  for (size_t k = 0; k + 1 < pair->len; k += 2) {
    uint32_t a = pair->data[k], b = pair->data[k + 1];
    while (up[a] != a) a = up[a] = up[up[a]];
    while (up[b] != b) b = up[b] = up[up[b]];
    if (a == b)
      n++;
    else
      up[a] = b;
  }
  free(up);
  return n;
}

static uint32_t local_index(Map *map, uint64_t key)
{
  bool added;
  return *map_slot(map, key, (uint32_t)map->len, &added);
}

// Cycles of the bounding curves as a graph of points; a curve listed both ways is within the face and bounds nothing.
// SIZE_MAX if the ends of a curve are not known.
static size_t curve_cycles(const Check *c, const MeshEntity *f)
{
  Map map = {0};
  U32Vec pair = {0};
  bool known = true;
  for (size_t i = 0; i < f->boundary.len && known; i++) {
    int sign, n = times_listed(f, abs(f->boundary.data[i]), &sign);
    if (n > 1 && sign == 0) continue;
    uint32_t e = mesh_find_entity(c->m, 1, abs(f->boundary.data[i]));
    const IntVec *ends = e == NONE ? NULL : &c->m->entity[e].boundary;
    known = ends && (ends->len == 2 || ends->len == 1);
    if (!known) break;
    vec_push(&pair, local_index(&map, (uint64_t)abs(ends->data[0])));
    vec_push(&pair, local_index(&map, (uint64_t)abs(ends->data[ends->len - 1])));
  }
  size_t n = known ? cycles(&pair, map.len) : SIZE_MAX;
  map_free(&map);
  vec_free(&pair);
  return n;
}

static void check_euler(Check *c, Face *f, uint32_t *stamp)
{
  const Mesh *m = c->m;
  long v = 0, e = 0, n = 0;
  Map map = {0};
  U32Vec pair = {0};
  for (uint32_t b = f->first; b < f->last; b++) {
    const MeshBlock *k = &m->block[b];
    size_t corners = (size_t)elem_corners(k->type), nodes = (size_t)elem_nodes(k->type), h = c->edges.base[b];
    n += (long)k->n;
    for (size_t i = 0; i < k->n; i++) {
      const uint32_t *w = k->node + i * nodes;
      for (size_t a = 0; a < corners; a++, h++) {
        if (stamp[w[a]] != f->entity) {
          stamp[w[a]] = f->entity;
          v++;
        }
        uint32_t twin = c->edges.twin[h];
        if (twin == EDGE_BAD)
          f->bad++;
        else if (twin == NONE) {
          e++;
          vec_push(&pair, local_index(&map, w[a]));
          vec_push(&pair, local_index(&map, w[a + 1 == corners ? 0 : a + 1]));
        } else if (h < twin)
          e++;
      }
    }
  }
  size_t loops = cycles(&pair, map.len);
  map_free(&map);
  vec_free(&pair);
  if (f->bad) return; // told by the rule on edges
  const MeshEntity *t = &m->entity[f->entity];
  size_t wanted = c->strict && t->boundary.len ? curve_cycles(c, t) : SIZE_MAX;
  Vec3 nowhere = {NAN, NAN, NAN};
  if (wanted != SIZE_MAX && wanted != loops)
    check__report(c, RULE_EULER, false, f->entity, NONE, 0, NONE, nowhere,
                  "its elements have %zu boundary cycles, its curves %zu", loops, wanted);
  long chi = v - e + n;
  // Not strict: the face may be of several parts, each of which adds 2.
  bool good = c->strict ? chi == 2 - (long)loops : (chi + (long)loops) % 2 == 0 || !f->plane;
  if (!good && f->plane)
    check__report(c, RULE_EULER, false, f->entity, NONE, 0, NONE, nowhere,
                  "V - E + F = %ld - %ld + %ld = %ld with %zu boundary cycles: it is not in one piece", v, e, n, chi, loops);
}

void check__faces(Check *c)
{
  const Mesh *m = c->m;
  uint32_t *stamp = mem_alloc(m->nnode * sizeof *stamp);
  memset(stamp, 0xff, m->nnode * sizeof *stamp);
  c->curve_lines = mem_zalloc(m->nentity * sizeof *c->curve_lines);
  for (size_t b = 0; b < m->nblock; b++)
    if (elem_dim(m->block[b].type) == 1) c->curve_lines[m->block[b].entity] += m->block[b].n;
  for (uint32_t b = 0, end; b < m->nblock; b = end) {
    for (end = b + 1; end < m->nblock && m->block[end].entity == m->block[b].entity;) end++;
    if (elem_dim(m->block[b].type) != 2 || !m->block[b].n) continue;
    Face f = {.entity = m->block[b].entity, .first = b, .last = end};
    Sum area = {0, 0, 0};
    double origin[2];
    look_at(c, &f);
    project(c, &f, m->block[b].node[0], origin);
    if (f.plane) {
      check_elements(c, &f, &area);
      check_area(c, &f, &area, origin);
    } else {
      check_flat(c, &f);
    }
    check_euler(c, &f, stamp);
  }
  free(stamp);
  free(c->curve_lines);
  c->curve_lines = NULL;
}
