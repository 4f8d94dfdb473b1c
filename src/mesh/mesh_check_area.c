// mesh_check_area.c - the audit: the area of each plane face against that within its curves
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_check_int.h"

#include "geom/predicates.h"

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
static void add_curve(const Check *c, const CheckedFace *f, uint32_t curve, int sign, const double origin[2], CompensatedSum *area)
{
  const Mesh *m = c->m;
  uint32_t b, last;
  blocks_of(m, curve, &b, &last);
  for (; b < last; b++) {
    const MeshBlock *k = &m->block[b];
    for (size_t i = 0; i < k->n; i++) {
      const uint32_t *v = k->node + i * (size_t)elem_nodes(k->type);
      double p[2], q[2];
      check__project(c, f, v[0], p);
      check__project(c, f, v[1], q);
      double along[2] = {sign * (q[0] - p[0]), sign * (q[1] - p[1])};
      check__add_cross(area, (double[]){p[0] - origin[0], p[1] - origin[1]}, along);
    }
  }
}

// A loop of a face that comes to no point twice: curves from, ... to - 1 of a list, and the area they enclose.
typedef struct {
  size_t from, to;
  double area;
} Loop;

typedef struct {
  IntVec curve; // signed tags
  Vec(Loop) loop;
  double size; // sum of the terms of all
} Loops;

static void loops_free(Loops *l)
{
  vec_free(&l->curve);
  vec_free(&l->loop);
}

static void add_loop(const Check *c, const CheckedFace *f, const double origin[2], const int *tag, size_t n, Loops *out)
{
  CompensatedSum area = {0, 0, 0};
  Loop l = {out->curve.len, out->curve.len + n, 0};
  for (size_t i = 0; i < n; i++) {
    add_curve(c, f, mesh_find_entity(c->m, 1, abs(tag[i])), tag[i] < 0 ? -1 : 1, origin, &area);
    vec_push(&out->curve, tag[i]);
  }
  l.area = fabs(area.sum + area.low);
  vec_push(&out->loop, l);
  out->size += area.size;
}

static int end_of(const Mesh *m, int tag, bool last)
{
  const IntVec *ends = &m->entity[mesh_find_entity(m, 1, abs(tag))].boundary;
  return ends->len ? abs(ends->data[last == (tag > 0) ? ends->len - 1 : 0]) : 0;
}

// Follow the curves, and take out a loop wherever they come back to a point on the way: loops may touch themselves, run along slits and
// back, and round holes at the end of these either way.
static void find_loops(const Check *c, const CheckedFace *f, const double origin[2], Loops *out)
{
  const IntVec *boundary = &c->m->entity[f->entity].boundary;
  IntVec way = {0};
  Map at = {0}; // point -> curves before it on the way
  for (size_t i = 0; i < boundary->len; i++) {
    int tag = boundary->data[i];
    if (!way.len) map_set(&at, (uint64_t)end_of(c->m, tag, false), 0);
    vec_push(&way, tag);
    uint64_t point = (uint64_t)end_of(c->m, tag, true);
    uint32_t from = map_get(&at, point);
    if (from < way.len) {
      bool slit = way.len - from == 2 && way.data[from] == -tag;
      if (!slit) add_loop(c, f, origin, way.data + from, way.len - from, out);
      if (!from) map_set(&at, point, NONE);
      for (size_t k = from; k + 1 < way.len; k++) map_set(&at, (uint64_t)end_of(c->m, way.data[k], true), NONE);
      way.len = from;
    } else {
      map_set(&at, point, (uint32_t)way.len);
    }
  }
  if (way.len) add_loop(c, f, origin, way.data, way.len, out);
  vec_free(&way);
  map_free(&at);
}

// The area of the largest loop less the others: holes may be run either way and be listed first.
static double area_less_holes(const Loops *loops)
{
  CompensatedSum sum = {0, 0, 0};
  double largest = 0;
  for (size_t i = 0; i < loops->loop.len; i++) {
    check__sum_add(&sum, -loops->loop.data[i].area);
    largest = fmax(largest, loops->loop.data[i].area);
  }
  check__sum_add(&sum, largest);
  check__sum_add(&sum, largest);
  return sum.sum + sum.low;
}

// Is p within the loop: does a ray to the right cross it an odd number of times?
static bool is_within(const Check *c, const CheckedFace *f, const int *curve, size_t n, const double p[2])
{
  const Mesh *m = c->m;
  bool odd = false;
  for (size_t i = 0; i < n; i++) {
    uint32_t b, last;
    blocks_of(m, mesh_find_entity(m, 1, abs(curve[i])), &b, &last);
    for (; b < last; b++)
      for (size_t k = 0; k < m->block[b].n; k++) {
        const uint32_t *v = m->block[b].node + k * (size_t)elem_nodes(m->block[b].type);
        double q[2], r[2];
        check__project(c, f, v[0], q);
        check__project(c, f, v[1], r);
        if ((q[1] <= p[1]) == (r[1] <= p[1])) continue;
        odd ^= (orient2d(q, r, p) > 0) == (r[1] > q[1]);
      }
  }
  return odd;
}

// The same for faces of several parts: loops within an even number of others count, those within an odd number are holes. Quadratic in
// the number of loops, so only asked where the other is not what the elements say.
static double area_of_parts(const Check *c, const CheckedFace *f, const Loops *loops)
{
  const Mesh *m = c->m;
  CompensatedSum sum = {0, 0, 0};
  for (size_t i = 0; i < loops->loop.len; i++) {
    const Loop *l = loops->loop.data + i;
    uint32_t b, last;
    blocks_of(m, mesh_find_entity(m, 1, abs(loops->curve.data[l->from])), &b, &last);
    double q[2], r[2];
    check__project(c, f, m->block[b].node[0], q);
    check__project(c, f, m->block[b].node[1], r);
    const double middle[2] = {0.5 * (q[0] + r[0]), 0.5 * (q[1] + r[1])};
    int around = 0;
    for (const Loop *o = loops->loop.data; o < loops->loop.data + loops->loop.len; o++)
      around += o != l && is_within(c, f, loops->curve.data + o->from, o->to - o->from, middle);
    check__sum_add(&sum, around % 2 ? -l->area : l->area);
  }
  return sum.sum + sum.low;
}

void check__area(Check *c, const CheckedFace *f, const CompensatedSum *elements, const double origin[2])
{
  if (!boundary_known(c, f->entity)) return;
  Loops loops = {0};
  find_loops(c, f, origin, &loops);
  double a = fabs(elements->sum + elements->low), b = fabs(area_less_holes(&loops));
  // Each term is right to a few ulps of the products in it: those of elements are of the order of their area, except for
  // slivers; those of the polygon of the order of distance times edge. 1e-12 leaves room for slivers of aspect 1000.
  double tolerance = 1e-12 * fmax(elements->size, loops.size);
  if (fabs(a - b) > tolerance && loops.loop.len > 1) b = fabs(area_of_parts(c, f, &loops));
  if (fabs(a - b) > tolerance)
    check__report(c, RULE_AREA, false, check__on(f->entity),
                  "its elements add up to %.17g, its boundary encloses %.17g", a, b);
  loops_free(&loops);
}
