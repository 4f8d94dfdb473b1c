// face_graph.h - the plane straight-line graph of a face, and the empty mesh made of it
// SPDX-License-Identifier: MIT
#ifndef MESH_FACE_GRAPH_H
#define MESH_FACE_GRAPH_H

#include "base/base.h"
#include "base/map.h"
#include "base/mem.h"
#include "mesh/edge_nodes.h"
#include "tri/tri.h"

// Vertex i is node node[i] at xy[2i], xy[2i+1] in the plane of the face; segment s runs from vertex ends[2s] to ends[2s+1].
// Zero-initialize; release with face_graph_free.
typedef struct {
  Map local;          // node -> vertex
  U32Vec node;
  DoubleVec xy;
  U32Vec ends;
  IntVec curve;       // per segment: tag of its curve
  Vec(bool) embedded; // per segment: inside the face, does not bound it
  Map has_curve;      // tags of the curves added so far
  const Face *frame;  // whose plane coordinates xy are, if not those of the face added: set before adding

  // coarse: set before curves are added, whose numbers of edges must be even. Segments then join every second node, and the nodes
  // between are kept: middle[map_pair(ends)] is the index of node middle_node[] at middle_xy[].
  bool coarse;
  Map middle;
  U32Vec middle_node;
  DoubleVec middle_xy;
} FaceGraph;

// What a mesh of f must have as edges and nodes: its boundary curves in the order of their tags (one that the loops run along twice, a
// slit or what two holes have in common, counts as embedded), then embedded curves, then embedded points, by node.
typedef struct {
  void (*curve)(void *ctx, int tag, bool embedded);
  void (*point)(void *ctx, uint32_t node);
} FaceVisitor;
void face_graph_visit(const Model *m, const Face *f, const FaceVisitor *v, void *ctx);

// Add boundary curves, embedded curves and points of f. Curves that are there already are not added again. nodes and curves are those of the model's 1D mesh.
void face_graph_add(FaceGraph *g, const Model *m, const Face *f, const Mesh1d *curves, const EdgeNodes *nodes);
void face_graph_free(FaceGraph *g);

// The empty mesh of f [book §4.4.1, §4.4.2]: Delaunay triangulation of the vertices, segments recovered by flips, outside flagged.
// t from tri_init; vertex ids are the graph's, segment ids too. False after errors (crossing or overlapping curves, coinciding
// nodes, embedded entities outside, no area), which name curves and places.
bool face_graph_mesh(const FaceGraph *g, const Model *m, const Face *f, Tri *t, Diag *diag);

// The first half of that: triangulate and recover the segments; nothing is carved.
bool face_graph_recover(const FaceGraph *g, const Model *m, const Face *f, Tri *t, Diag *diag);

#endif
