// edge_table.h - the distinct edges of a mesh, and copies of a mesh with room for nodes on its edges and in its elements
// SPDX-License-Identifier: MIT
#ifndef MESH_EDGE_TABLE_H
#define MESH_EDGE_TABLE_H

#include "base/base.h"
#include "base/map.h"
#include "mesh/mesh.h"
#include "model/model.h"

// An edge belongs to the curve that has a line element there, and then runs as the curve does, from parameter ua to ub (NAN
// where the mesh does not know them); else to the first face that has it, and runs from the smaller node to the larger. Edges of loose
// curves, which no face lists though faces list curves, are their own: a face may have another edge between the same nodes. Two faces
// have an edge each between the same nodes where it has elements on either side in both.
typedef struct {
  uint32_t a, b;
  uint32_t entity;
  double ua, ub;
} MeshEdge;

typedef struct {
  Map index; // map_pair of the nodes -> edge
  size_t n, cap;
  MeshEdge *edge;
  bool *loose;     // per entity
  Map *own;        // per entity, NULL if no face has any: map_pair -> edges within it beside those of `index`
  size_t nentity;
  Map loose_index; // entity << 32 | first node of its line element -> edge
} EdgeTable;

// The edges of all elements (corner to corner), those of curves first, each in order of first appearance. O(n) expected.
void edge_table_make(EdgeTable *t, const Mesh *m);
void edge_table_free(EdgeTable *t);
// The edge between a and b of face `entity` (NONE: of any face), or of a curve that faces list; or NONE.
uint32_t edge_table_find(const EdgeTable *t, uint32_t entity, uint32_t a, uint32_t b);

// Position at fraction s of an edge: on its curve at the parameter between its ends, if it has one and `model` is not NULL; else
// on the straight line.
Vec3 edge_table_point(const EdgeTable *t, const Mesh *m, const Model *model, uint32_t e, double s, double *u);

// A copy of m without elements in the making: entities, groups, and nodes numbered anew in the order of entities (on curves from
// begin to end), with per_edge nodes added to each edge and cell_nodes(type) to each surface element. The caller sets the
// places of the added ones, adds blocks, and frees the arrays with enriched_free; mesh is then its own.
typedef struct {
  Mesh *mesh;
  uint32_t *node;  // of each old node
  uint32_t *edge;  // of each edge: its first added node; the others follow, from a to b
  uint32_t **cell; // per block (NULL but for surface elements), per element: its first added node, the others follow
} Enriched;
void enrich(Enriched *out, const Mesh *m, const EdgeTable *t, int per_edge, int (*cell_nodes)(ElemType, void *), void *ctx);
void enriched_free(Enriched *e, const Mesh *m);
// The k-th (0 ..) of the nodes added to the edge of face `entity` from node a to node b of the old mesh, counted from a.
uint32_t enriched_at(const Enriched *e, const EdgeTable *t, int per_edge, uint32_t entity, uint32_t a, uint32_t b, int k);
uint32_t enriched_on_line(const Enriched *e, const EdgeTable *t, int per_edge, uint32_t curve, uint32_t a, uint32_t b, int k);
// Add a block and return its nodes, to be filled.
uint32_t *enriched_block(Enriched *e, uint32_t entity, ElemType type, size_t n);
// Carry the periodic pairs over: old nodes, and added ones where the master has the edge too. Added slaves of pairs that have
// an affine map are moved to the images of their masters, bit for bit.
void enrich_periodic(const Enriched *e, const Mesh *m, const EdgeTable *t, int per_edge);

#endif
