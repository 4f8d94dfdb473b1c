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
      double t = (p[0] - origin[0]) * (q[1] - origin[1]) - (p[1] - origin[1]) * (q[0] - origin[0]);
      check__sum_add(area, sign * t / 2);
    }
  }
}

// A loop of a face: curves from, ... to - 1 of its boundary, and the area they enclose.
typedef struct {
  size_t from, to;
  double area;
} Loop;
typedef Vec(Loop) Loops;

// Loops follow each other in the list; one ends where it comes back to its beginning. *size: sum of the terms of all.
static void find_loops(const Check *c, const CheckedFace *f, const double origin[2], Loops *out, double *size)
{
  const MeshEntity *e = &c->m->entity[f->entity];
  int start = 0;
  size_t from = 0;
  CompensatedSum loop = {0, 0, 0};
  for (size_t i = 0; i < e->boundary.len; i++) {
    int tag = e->boundary.data[i], sign = tag < 0 ? -1 : 1;
    uint32_t curve = mesh_find_entity(c->m, 1, abs(tag));
    const IntVec *ends = &c->m->entity[curve].boundary;
    int begin = ends->len ? abs(ends->data[0]) : 0, end = ends->len ? abs(ends->data[ends->len - 1]) : 0;
    if (!start) start = sign > 0 ? begin : end;
    add_curve(c, f, curve, sign, origin, &loop);
    if ((sign > 0 ? end : begin) != start && i + 1 < e->boundary.len) continue;
    vec_push(out, ((Loop){from, i + 1, fabs(loop.sum + loop.low)}));
    *size += loop.size;
    loop = (CompensatedSum){0, 0, 0};
    start = 0;
    from = i + 1;
  }
}

// The area of the largest loop less the others: holes may be run either way and be listed first.
static double area_less_holes(const Loops *loops, double *size)
{
  CompensatedSum sum = {0, 0, 0};
  double largest = 0;
  for (size_t i = 0; i < loops->len; i++) {
    check__sum_add(&sum, -loops->data[i].area);
    largest = fmax(largest, loops->data[i].area);
  }
  check__sum_add(&sum, largest);
  check__sum_add(&sum, largest);
  *size = fmax(*size, sum.size);
  return sum.sum + sum.low;
}

// Is p within the loop: does a ray to the right cross it an odd number of times?
static bool is_within(const Check *c, const CheckedFace *f, const Loop *loop, const double p[2])
{
  const Mesh *m = c->m;
  bool odd = false;
  for (size_t i = loop->from; i < loop->to; i++) {
    uint32_t b, last;
    blocks_of(m, mesh_find_entity(m, 1, abs(m->entity[f->entity].boundary.data[i])), &b, &last);
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
  for (size_t i = 0; i < loops->len; i++) {
    uint32_t b, last;
    blocks_of(m, mesh_find_entity(m, 1, abs(m->entity[f->entity].boundary.data[loops->data[i].from])), &b, &last);
    double q[2], r[2];
    check__project(c, f, m->block[b].node[0], q);
    check__project(c, f, m->block[b].node[1], r);
    const double middle[2] = {0.5 * (q[0] + r[0]), 0.5 * (q[1] + r[1])};
    int around = 0;
    for (size_t j = 0; j < loops->len; j++) around += j != i && is_within(c, f, &loops->data[j], middle);
    check__sum_add(&sum, around % 2 ? -loops->data[i].area : loops->data[i].area);
  }
  return sum.sum + sum.low;
}

void check__area(Check *c, const CheckedFace *f, const CompensatedSum *elements, const double origin[2])
{
  if (!boundary_known(c, f->entity)) return;
  Loops loops = {0};
  double size = 0;
  find_loops(c, f, origin, &loops, &size);
  double a = fabs(elements->sum + elements->low), b = fabs(area_less_holes(&loops, &size));
  // Each term is right to a few ulps of the products in it: those of elements are of the order of their area, except for
  // slivers; those of the polygon of the order of distance times edge. 1e-12 leaves room for slivers of aspect 1000.
  double tolerance = 1e-12 * fmax(elements->size, size);
  if (fabs(a - b) > tolerance && loops.len > 1) b = fabs(area_of_parts(c, f, &loops));
  if (fabs(a - b) > tolerance)
    check__report(c, RULE_AREA, false, check__on(f->entity),
                  "its elements add up to %.17g, its boundary encloses %.17g", a, b);
  vec_free(&loops);
}
