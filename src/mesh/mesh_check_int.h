// mesh_check_int.h - shared by the files of the audit
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH_CHECK_INT_H
#define MESH_MESH_CHECK_INT_H

#include <math.h>

#include "base/map.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_edges.h"

typedef struct {
  const Mesh *m;
  bool strict;
  MeshReport *r;
  size_t *number;      // of the first element of each block, from 0
  uint8_t *used;       // per node: 1 if by an element, 2 if by a surface element and those have been marked
  // curves
  Map line;            // pair of end nodes -> index of the line element, over all blocks of dimension 1
  Vec(uint32_t) line_block;
  Vec(uint32_t) line_index;   // element within the block
  size_t *curve_lines; // per entity: line elements on it
  MeshEdges edges;
} Check;

// Call body for each face with a stamp for each node, which is the face where an element of the face has the node.
void check__stamp_faces(const Check *c, void (*body)(void *ctx, uint32_t face, const uint32_t *stamp), void *ctx);

typedef Vec(uint64_t) U64Vec;

// Where line elements are among the edges of elements, and the edges that one element alone has.
typedef struct {
  U64Vec use;        // line << 32 | face, for every half-edge that lies on a line element
  U64Vec boundary;   // map_pair of every half-edge without a twin
  U32Vec half;       // those half-edges
  uint8_t *on_line;
} CheckedEdges;

// A face that is looked at.
typedef struct {
  uint32_t entity, first, last;  // blocks first .. last-1
  int i, j;                      // coordinates kept
  int sign;                      // of the normal along the one dropped
  bool plane;
  size_t bad;                    // half-edges without a proper twin
} CheckedFace;

// Sum with the rounding errors carried along (Neumaier): its error is a few units in the last place of the sum of |terms|.
typedef struct {
  double sum, low, size;
} CompensatedSum;

static inline void check__sum_add(CompensatedSum *s, double x)
{
  double t = s->sum + x;
  s->low += fabs(s->sum) >= fabs(x) ? (s->sum - t) + x : (x - t) + s->sum;
  s->sum = t;
  s->size += fabs(x);
}

// Adds half of a x b. The products are right to half an ulp, so that `size` counts a thousandth of them at least: more would be
// blamed on slivers than they can help.
static inline void check__add_cross(CompensatedSum *s, const double a[2], const double b[2])
{
  double x = a[0] * b[1], y = a[1] * b[0], t = (x - y) / 2, size = s->size;
  check__sum_add(s, t);
  s->size = size + fmax(fabs(t), 0.5e-3 * (fabs(x) + fabs(y)));
}

static inline void check__project(const Check *c, const CheckedFace *f, uint32_t node, double p[2])
{
  p[0] = c->m->xyz[3 * (size_t)node + (size_t)f->i];
  p[1] = c->m->xyz[3 * (size_t)node + (size_t)f->j];
}

// What a finding is about; entity, block and node may be NONE, at NAN.
typedef struct {
  uint32_t entity, block;
  size_t element; // within the block
  uint32_t node;
  Vec3 at;
} Place;
static inline Place check__on(uint32_t entity) { return (Place){entity, NONE, 0, NONE, {NAN, NAN, NAN}}; }
// Add a finding.
void check__report(Check *c, MeshRule rule, bool warning, Place where, const char *fmt, ...) PRINTF_LIKE(5, 6);
// The area that the elements of a plane face add up to against that which its curves enclose. origin: near the face, in its plane.
void check__area(Check *c, const CheckedFace *f, const CompensatedSum *elements, const double origin[2]);
void check__faces(Check *c);      // orientation, area, Euler characteristic
void check__conformity(Check *c); // edges, lost edges, holes, T-junctions

// Line elements that should be edges of a face and are not. Sorts s->use.
void check__lost(Check *c, CheckedEdges *s);
void check__sort(U64Vec *v);
size_t check__count(const U64Vec *sorted, uint64_t x);

static inline Vec3 check__middle(const Mesh *m, uint32_t a, uint32_t b)
{
  return vec3_scale(0.5, vec3_add(mesh_xyz(m, a), mesh_xyz(m, b)));
}

// Of a line element, as an index over all of them: the entity it is on, and its nodes.
static inline uint32_t check__line_curve(const Check *c, uint32_t line) { return c->m->block[c->line_block.data[line]].entity; }

static inline const uint32_t *check__line_nodes(const Check *c, uint32_t line)
{
  const MeshBlock *k = &c->m->block[c->line_block.data[line]];
  return k->node + c->line_index.data[line] * (size_t)elem_nodes(k->type);
}

// The number of a node in messages: that in its file.
static inline unsigned long long number_of(const Check *c, uint32_t node) { return mesh_node_number(c->m, node); }

#endif
