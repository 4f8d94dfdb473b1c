// edge_nodes.h - numbering of the nodes of points and curves, and the mesh of one face on top of it
// SPDX-License-Identifier: MIT
#ifndef MESH_EDGE_NODES_H
#define MESH_EDGE_NODES_H

#include "base/base.h"
#include "geom/vec.h"
#include "mesh/mesh1d.h"
#include "model/model.h"

// Nodes of points and curves, numbered as the final mesh will have them: the node of the k-th point of the model is k, then
// follow the interior nodes of each curve from begin to end.
typedef struct {
  size_t n;
  Vec3 *xyz;
  uint32_t *first; // of the k-th curve: id of its first interior node
} EdgeNodes;

// Mesh of one face. Node ids below EdgeNodes.n are those of points and curves, id - n indexes `own`.
typedef struct {
  Vec3 *own;
  size_t nown;
  uint32_t *tri, *quad; // 3 * ntri, 4 * nquad, counter-clockwise about the face's normal
  size_t ntri, nquad;
  double *size;         // wanted edge length at each own node; NULL where there was no size field
  bool failed;          // an error was reported
  double matching_seconds; // processor time of the matching of triangles to quadrangles
} FaceMesh;

void face_mesh_free(FaceMesh *f); // its arrays, not f itself

// Number the nodes of points and curves.
void edge_nodes_init(EdgeNodes *en, const Model *m, const Mesh1d *curves);
void edge_nodes_free(EdgeNodes *en);
// Id of the i-th node of the k-th curve of the model, i from 0 (its begin) to n-1 (its end).
uint32_t edge_nodes_at(const EdgeNodes *en, const Model *m, const Mesh1d *curves, size_t k, size_t i);

// Id of the node of a model point; NONE if there is no such point. O(log n).
uint32_t edge_nodes_point(const Model *m, int tag);

#endif
