// mesh2d.h - meshing the faces of a model whose curves are meshed
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH2D_H
#define MESH_MESH2D_H

#include "base/base.h"
#include "base/diag.h"
#include "mesh/boundary_layer.h"
#include "mesh/edge_nodes.h"
#include "mesh/mesh.h"
#include "mesh/mesh1d.h"
#include "model/model.h"
#include "opt/options.h"
#include "size/size.h"
#include "tri/refine.h"

// Everything mesh2d needs to know; all outlive the call.
typedef struct {
  const Model *model;       // prepared
  const Options *options;
  const SizeField *size;
  const Mesh1d *curves;
  const BoundaryLayers *layers; // planned on the curves; NULL: none
  Diag *diag;
  int threads;
} Mesh2dInput;

// Mesh every face: the largest first, in parallel, results and messages in ascending order of tag. face[] gets one
// entry per face of the model (model_face_at); free each with face_mesh_free. Returns the number of faces that failed.
size_t mesh2d_run(const Mesh2dInput *in, const EdgeNodes *nodes, FaceMesh *face);
// The same for the n faces which[] (indices); the other entries of face[] are left alone.
size_t mesh2d_run_some(const Mesh2dInput *in, const EdgeNodes *nodes, const size_t *which, size_t n, FaceMesh *face);

// The refinement that options and the face's own attributes ask for; `here` evaluates sizes and must outlive the use.
TriRefineParams mesh2d_refine_params(const Options *o, const Face *f, SizeInPlane *here);

// Put points, curves and faces together: entities with their boxes, boundaries and groups, nodes, elements. face may be NULL
// (only curves), curves too (only points). Mesh.KeepOrientation leaves elements of faces with normal -z clockwise; Geometry.OrientedPhysicals
// lets negative members of groups reverse elements.
// The arrays of elements move from face[] to the mesh.
Mesh *mesh_assemble(const Model *m, const Mesh1d *curves, const EdgeNodes *en, FaceMesh *face, const Options *o);

// Wanted edge length at each node of that mesh, for the efficiency index; NAN where none is known. The caller frees.
double *mesh_assemble_sizes(const Model *m, const Mesh1d *curves, const EdgeNodes *en, const FaceMesh *face);

#endif
