// mesh.h - the result: nodes and elements classified on the entities they discretize, self-sufficient for the writers
// SPDX-License-Identifier: MIT
//
// A Mesh knows nothing of curves as maps: it carries copies of the entities' tags, bounding boxes, boundaries and groups, so that
// a mesh read from a file and one made from a model are the same kind of thing.
//
// Numbering is Gmsh's: entities by dimension, then ascending tag; nodes of points first, then interior nodes of each curve
// from begin to end, then interior nodes of each face; elements in blocks by (dimension, tag, type).
#ifndef MESH_MESH_H
#define MESH_MESH_H

#include "base/base.h"
#include "base/mem.h"
#include "geom/vec.h"

// Element types: the numbers of the MSH formats.
typedef enum {
  ELEM_LINE2 = 1, ELEM_TRI3 = 2, ELEM_QUAD4 = 3, ELEM_LINE3 = 8, ELEM_TRI6 = 9, ELEM_QUAD9 = 10, ELEM_POINT = 15,
  ELEM_QUAD8 = 16, ELEM_TRI9 = 20, ELEM_TRI10 = 21, ELEM_TRI15 = 23, ELEM_LINE4 = 26, ELEM_LINE5 = 27,
  ELEM_QUAD16 = 36, ELEM_QUAD25 = 37, ELEM_QUAD12 = 39
} ElemType;

// Corner order is counter-clockwise about the face's normal:
//
//   2            3-----2        second order: corners, then edge nodes in the order of the edges 0-1, 1-2, 2(-3)-0,
//   |\           |     |        then the interior; lines: both ends, then the interior from the first to the second.
//   | \          |     |
//   0--1         0-----1

int elem_dim(ElemType t) CONST_FUNCTION;     // 0, 1, 2; -1 for an unknown type
int elem_nodes(ElemType t) CONST_FUNCTION;   // nodes per element; 0 for an unknown type
int elem_corners(ElemType t) CONST_FUNCTION; // 1, 2, 3 or 4
int elem_order(ElemType t) CONST_FUNCTION;   // polynomial order
const char *elem_name(ElemType t);  // "triangle", "6-node triangle", ...

typedef struct {
  int dim, tag;
  Vec3 lo, hi;             // bounding box
  IntVec physical;         // physical tags, negative where the group was defined with the negative entity
  IntVec boundary;         // signed tags of the bounding entities of dimension dim-1 (a curve's: begin, then -end)
  IntVec embedded;         // tags of curves embedded in a face
  // Of a piece of another entity, in some parts of the mesh (mesh/part_entities.h); else `parts` is empty.
  int parent_dim, parent_tag;
  IntVec parts;            // ascending
  bool saved;              // its elements are saved although it is in no group
} MeshEntity;

typedef struct {
  int dim, tag;
  char *name;              // NULL if it has none
} MeshGroup;

typedef struct {
  uint32_t entity;         // index into entity[]
  ElemType type;
  size_t n;                // number of elements
  uint32_t *node;          // n * elem_nodes(type) indices into the node arrays
  uint32_t *part;          // n parts, from 1, where the mesh is partitioned; else NULL
} MeshBlock;

typedef struct {
  int dim, tag, master;    // entity pair
  bool has_affine;
  double affine[16];       // row-major, from master to slave
  U32Vec slave_node, master_node;
} MeshPeriodic;

typedef struct {
  // nodes, structure of arrays
  size_t nnode, node_cap;
  double *xyz;             // 3 per node
  uint32_t *node_entity;   // index into entity[]: the entity it is classified on
  double *node_u;          // parameter on the curve; NAN elsewhere
  uint64_t node_shift;     // in the file it was read from, nodes are numbered index + 1 + node_shift (modulo 2^64: from 0 by -1),
  uint64_t *node_number;   // or so, if this is not NULL

  size_t nentity, entity_cap;
  MeshEntity *entity;      // by dim, then tag
  size_t nblock, block_cap;
  MeshBlock *block;        // by entity index, then type
  size_t ngroup, group_cap;
  bool volumes_grouped; // a group has volumes: they are no entities here, but decide what is saved
  MeshGroup *group;        // by dim, then tag; every physical tag in entity[].physical is here
  size_t nperiodic, periodic_cap;
  MeshPeriodic *periodic;
  uint32_t nparts;         // of a partition (mesh/partition.h); 0: none
} Mesh;

Mesh *mesh_new(void);        // empty; owned by the caller
void mesh_free(Mesh *m);     // NULL is fine

// Building. Indices are returned; entities must be added in order of (dim, tag), blocks in order of (entity, type).
uint32_t mesh_add_entity(Mesh *m, int dim, int tag);
uint32_t mesh_add_node(Mesh *m, Vec3 p, uint32_t entity, double u);
// n nodes of an entity that is no curve. Returns the index of the first.
uint32_t mesh_add_nodes(Mesh *m, const Vec3 *p, size_t n, uint32_t entity);
// Room for n elements of a type on an entity; the caller fills block[].node. Returns the index of the block.
uint32_t mesh_add_block(Mesh *m, uint32_t entity, ElemType type, size_t n);
// The same with the nodes at hand, which are the mesh's from now on.
uint32_t mesh_take_block(Mesh *m, uint32_t entity, ElemType type, size_t n, uint32_t *node);
void mesh_add_group(Mesh *m, int dim, int tag, const char *name); // name may be NULL; copied
MeshPeriodic *mesh_add_periodic(Mesh *m, int dim, int tag, int master); // valid until the next one

uint32_t mesh_find_entity(const Mesh *m, int dim, int tag); // index or NONE; O(log n)
const MeshGroup *mesh_find_group(const Mesh *m, int dim, int tag); // or NULL; O(ngroup)
size_t mesh_count(const Mesh *m, int dim);                  // elements of a dimension
size_t mesh_count_corners(const Mesh *m, int corners);      // of any order: 3 triangles, 4 quadrangles
// True if some entity, a volume included, is in a physical group: then only elements of such entities are saved, unless all are asked for.
bool mesh_is_grouped(const Mesh *m);
static inline Vec3 mesh_xyz(const Mesh *m, uint32_t n)
{
  return (Vec3){m->xyz[3 * (size_t)n], m->xyz[3 * (size_t)n + 1], m->xyz[3 * (size_t)n + 2]};
}
// Move a node to p, at parameter u of its curve (NAN if it is not on one).
static inline void mesh_set_node(Mesh *m, uint32_t n, Vec3 p, double u)
{
  m->xyz[3 * (size_t)n] = p.x;
  m->xyz[3 * (size_t)n + 1] = p.y;
  m->xyz[3 * (size_t)n + 2] = p.z;
  m->node_u[n] = u;
}
// The number of a node for people: that in its file.
static inline unsigned long long mesh_node_number(const Mesh *m, uint32_t i)
{
  return m->node_number ? m->node_number[i] : m->node_shift + i + 1;
}

#endif
