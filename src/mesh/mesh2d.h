// mesh2d.h - meshing the faces of a model whose curves are meshed
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH2D_H
#define MESH_MESH2D_H

#include "base/base.h"
#include "base/diag.h"
#include "mesh/mesh.h"
#include "mesh/mesh1d.h"
#include "model/model.h"
#include "opt/options.h"
#include "size/size.h"

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
  bool failed;          // an error was reported
} FaceMesh;

// Everything mesh2d needs to know; all outlive the call.
typedef struct {
  const Model *model;       // prepared
  const Options *options;
  const SizeField *size;
  const Mesh1d *curves;
  Diag *diag;
  int threads;
} Mesh2dInput;

// Mesh every face: the largest first, in parallel, results and messages in ascending order of tag. face[] gets one
// entry per face of the model (model_face_at); free with mesh2d_free. Returns the number of faces that failed.
size_t mesh2d_run(const Mesh2dInput *in, const EdgeNodes *nodes, FaceMesh *face);
void face_mesh_free(FaceMesh *f);

// Number the nodes of points and curves.
void edge_nodes_init(EdgeNodes *en, const Model *m, const Mesh1d *curves);
void edge_nodes_free(EdgeNodes *en);
// Id of the i-th node of the k-th curve of the model, i from 0 (its begin) to n-1 (its end).
uint32_t edge_nodes_at(const EdgeNodes *en, const Model *m, const Mesh1d *curves, size_t k, size_t i);

// Put points, curves and faces together: entities with their boxes, boundaries and groups, nodes, elements. face may be NULL
// (only curves), curves too (only points). With keep_orientation elements of faces with normal -z stay clockwise.
Mesh *mesh_assemble(const Model *m, const Mesh1d *curves, const EdgeNodes *en, const FaceMesh *face,
                    bool keep_orientation);

#endif
