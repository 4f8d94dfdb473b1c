// mesh_check_faces.c - the audit: orientation of elements and Euler characteristic of each face
// SPDX-License-Identifier: MIT
//
// A plane face is looked at along the axis nearest to its normal: dropping a coordinate keeps collinearity and the side of a
// line as they are, so the signs stay exact.
#include "base/base.h"

#include "mesh/mesh_check_int.h"

#include "geom/predicates.h"
#include "mesh/mesh_measure.h"

// Sign of the face's normal along z, by the majority of a sample.
static int turn_in_xy(const Mesh *m, const CheckedFace *f)
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
static void look_at(Check *c, CheckedFace *f)
{
  const Mesh *m = c->m;
  bool flat = true;
  double z = m->xyz[3 * (size_t)m->block[f->first].node[0] + 2];
  for (uint32_t b = f->first; flat && b < f->last; b++)
    for (size_t i = 0; flat && i < m->block[b].n * (size_t)elem_nodes(m->block[b].type); i++)
      flat = m->xyz[3 * (size_t)m->block[b].node[i] + 2] == z;
  if (flat) {
    *f = (CheckedFace){f->entity, f->first, f->last, 0, 1, turn_in_xy(m, f), true, 0};
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

static void check_element(Check *c, const CheckedFace *f, uint32_t b, size_t i, double p[4][2], int corners)
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
    check__report(c, RULE_DEGENERATE, false, (Place){f->entity, b, i, NONE, mesh_center(c->m, k, i)},
                  "three corners are collinear");
  else if (corners == 4 && area > 0)
    check__report(c, RULE_ORIENTATION, false, (Place){f->entity, b, i, NONE, mesh_center(c->m, k, i)},
                  "the quadrangle is not convex");
  else
    check__report(c, RULE_ORIENTATION, false, (Place){f->entity, b, i, NONE, mesh_center(c->m, k, i)},
                  "it turns the other way than its face (area %.6g)", area);
}

// Orientation of the elements, and the sum of their projected areas.
static void check_elements(Check *c, const CheckedFace *f, CompensatedSum *area)
{
  for (uint32_t b = f->first; b < f->last; b++) {
    const MeshBlock *k = &c->m->block[b];
    int corners = elem_corners(k->type), nodes = elem_nodes(k->type);
    for (size_t i = 0; i < k->n; i++) {
      double p[4][2];
      const uint32_t *v = k->node + i * (size_t)nodes;
      for (int a = 0; a < corners; a++) check__project(c, f, v[a], p[a]);
      check_element(c, f, b, i, p, corners);
      for (int a = 1; a + 1 < corners; a++)
        check__add_cross(area, (double[]){p[a][0] - p[0][0], p[a][1] - p[0][1]}, (double[]){p[a + 1][0] - p[0][0], p[a + 1][1] - p[0][1]});
    }
  }
}

// Elements of a face that is not plane: only that they are not flat.
static void check_flat(Check *c, const CheckedFace *f)
{
  for (uint32_t b = f->first; b < f->last; b++)
    for (size_t i = 0; i < c->m->block[b].n; i++)
      if (mesh_size_of(c->m, &c->m->block[b], i, (Vec3){0, 0, 0}) == 0)
        check__report(c, RULE_DEGENERATE, false,
                      (Place){f->entity, b, i, NONE, mesh_center(c->m, &c->m->block[b], i)}, "its area is 0");
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

// Cycles of the bounding curves as a graph of points; a curve listed twice is within the face, or between holes, and bounds nothing.
// SIZE_MAX if the ends of a curve are not known.
static size_t curve_cycles(const Check *c, const MeshEntity *f)
{
  Map map = {0}, odd = {0};
  U32Vec pair = {0};
  bool known = true;
  for (size_t i = 0; i < f->boundary.len; i++) *map_slot(&odd, (uint64_t)abs(f->boundary.data[i]), 0, NULL) ^= 1;
  for (size_t i = 0; i < f->boundary.len && known; i++) {
    uint32_t *counts = map_slot(&odd, (uint64_t)abs(f->boundary.data[i]), 0, NULL);
    if (!*counts) continue;
    *counts = 0; // once
    uint32_t e = mesh_find_entity(c->m, 1, abs(f->boundary.data[i]));
    const IntVec *ends = e == NONE ? NULL : &c->m->entity[e].boundary;
    known = ends && (ends->len == 2 || ends->len == 1);
    if (!known) break;
    vec_push(&pair, local_index(&map, (uint64_t)abs(ends->data[0])));
    vec_push(&pair, local_index(&map, (uint64_t)abs(ends->data[ends->len - 1])));
  }
  size_t n = known ? cycles(&pair, map.len) : SIZE_MAX;
  map_free(&map);
  map_free(&odd);
  vec_free(&pair);
  return n;
}

// Pieces of the face: elements that hang together by common nodes, or by common edges.
static long pieces(const Check *c, const CheckedFace *f, bool by_nodes)
{
  const Mesh *m = c->m;
  size_t begin = c->edges.base[f->first], n = c->edges.base[f->last] - begin, at = 0;
  Map first = {0}; // node -> a half-edge that leaves it
  U32Vec pair = {0}; // of half-edges: those of an element, of an edge, of a node
  for (uint32_t b = f->first; b < f->last; b++) {
    const MeshBlock *k = &m->block[b];
    size_t corners = (size_t)elem_corners(k->type), nodes = (size_t)elem_nodes(k->type);
    for (size_t i = 0; i < k->n * corners; i++, at++) {
      size_t h = at, o = i % corners ? at - 1 : at + corners - 1, twin = c->edges.twin[begin + at];
      vec_push(&pair, (uint32_t)h), vec_push(&pair, (uint32_t)o);
      if (twin < EDGE_BAD) vec_push(&pair, (uint32_t)h), vec_push(&pair, (uint32_t)(twin - begin));
      if (!by_nodes) continue;
      uint32_t *seen = map_slot(&first, k->node[i / corners * nodes + i % corners], (uint32_t)h, NULL);
      vec_push(&pair, (uint32_t)h), vec_push(&pair, *seen);
    }
  }
  long joined = (long)(pair.len / 2) - (long)cycles(&pair, n);
  vec_free(&pair);
  map_free(&first);
  return (long)n - joined;
}

static void check_euler(Check *c, CheckedFace *f, uint32_t *stamp)
{
  const Mesh *m = c->m;
  long v = 0, e = 0, n = 0, borders = 0, sides = 0;
  Map map = {0};
  U32Vec pair = {0};
  for (uint32_t b = f->first; b < f->last; b++) {
    const MeshBlock *k = &m->block[b];
    size_t corners = (size_t)elem_corners(k->type), nodes = (size_t)elem_nodes(k->type), h = c->edges.base[b];
    n += (long)k->n;
    sides += (long)(k->n * corners);
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
          borders++;
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
  if (wanted != SIZE_MAX && wanted != loops)
    check__report(c, RULE_EULER, false, check__on(f->entity),
                  "its elements have %zu boundary cycles, its curves %zu", loops, wanted);
  long chi = v - e + n;
  // Of one piece: 2 - loops. Of several, or of some that meet in a point: what lies between the cycles, and in how many components.
  bool fits = !f->plane || chi == 2 - (long)loops || chi == pieces(c, f, true) + pieces(c, f, false) - (long)loops;
  if (!fits)
    check__report(c, RULE_EULER, false, check__on(f->entity),
                  "V - E + F = %ld - %ld + %ld = %ld does not go with %zu boundary cycles", v, e, n, chi,
                  loops);
  // The indices of the vertices of a face of quadrangles: 4 less the elements and the boundary edges at each [book §5.1.4].
  long index4 = 4 * v - sides - 2 * borders;
  long wanted4 = 4 * (fits ? chi : 2 - (long)loops);
  if (sides == 4 * n && index4 != wanted4)
    check__report(c, RULE_INDEX_SUM, false, check__on(f->entity),
                  "the indices of the vertices add up to %ld/4, which should be %ld/4", index4, wanted4);
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
    CheckedFace f = {.entity = m->block[b].entity, .first = b, .last = end};
    CompensatedSum area = {0, 0, 0};
    double origin[2];
    look_at(c, &f);
    check__project(c, &f, m->block[b].node[0], origin);
    if (f.plane) {
      check_elements(c, &f, &area);
      check__area(c, &f, &area, origin);
    } else {
      check_flat(c, &f);
    }
    check_euler(c, &f, stamp);
  }
  free(stamp);
  free(c->curve_lines);
  c->curve_lines = NULL;
}
