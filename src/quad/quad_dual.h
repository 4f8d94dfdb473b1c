// quad_dual.h - the dual graph of a mesh of triangles: what the matching is asked
// SPDX-License-Identifier: MIT
#ifndef QUAD_QUAD_DUAL_H
#define QUAD_QUAD_DUAL_H

#include "quad/blossom.h"
#include "quad/quad_mesh.h"

// The graph of [book §5.2.4]: a vertex for each triangle (numbered along a Hilbert curve: the solver likes neighbours in the
// graph to be neighbours in memory), an edge for each free edge between two of them, extra edges along locked sides, and one
// more vertex for each part with an odd number of triangles.
typedef struct {
  U32Vec edge;        // 2 by edge: its ends
  IntVec cost;        // by edge
  U32Vec side;        // by edge: a side of the mesh to merge over; NONE for extra edges
  uint32_t n;         // vertices
  uint32_t *rank;     // by element: vertex of the graph, NONE for quads
  uint32_t odd_parts; // parts with an odd number of triangles
} QuadDual;

// twin as of quad_mesh_twins(m). Free with quad_dual_free. O(n log n).
void quad_dual_init(QuadDual *d, const QuadMesh *m, const uint32_t *twin);
// A view of d, for the solver.
BlossomGraph quad_dual_graph(const QuadDual *d);
void quad_dual_free(QuadDual *d);

#endif
