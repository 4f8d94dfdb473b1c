// boundary_layer.h - layers of thin cells along curves (BoundaryLayer Field)
// SPDX-License-Identifier: MIT
//
// In every face beside a curve of a field's CurvesList (unless the face is excluded) a column of nodes stands on each node of the
// curve, along the averaged normal, at the heights the field asks for. Columns that would meet others, or come too near to the
// rest of the boundary, are shortened: their layers grow less, and if that is not enough are lower from the first on; so cells never
// overlap and never turn over.
//
// At a point of FanPointsList where the boundary turns away from the face by more than a straight angle, and where it turns by more
// than 150 degrees anyway, a fan of columns stands on one node. Where the layer ends at a straight curve the last column lies on
// that curve, whose nodes are changed accordingly; at other ends the layers run together in the end point, or end openly where
// the boundary goes on nearly straight or turns away. An embedded curve of the list has layers on both sides, and a fan round an end
// that stands free; where it begins on the boundary the layers of both go on into each other.
//
// In a face that becomes quadrangles no cell is a triangle: fans have an even number of cells, two of which share a quadrangle at the
// tip, layers end openly at curves that leave at more than 50 degrees, and the corner beside a column without height is left out.
#ifndef MESH_BOUNDARY_LAYER_H
#define MESH_BOUNDARY_LAYER_H

#include "base/base.h"
#include "base/diag.h"
#include "mesh/edge_nodes.h"
#include "mesh/face_graph.h"
#include "mesh/mesh1d.h"
#include "model/model.h"
#include "opt/options.h"
#include "size/field.h"

typedef struct BoundaryLayers BoundaryLayers;

// Plan the layers of all faces, and put their nodes on the straight curves where they end (changes `curves`). NULL if no field asks for
// layers. Warns of columns that cannot stand at all. O(n log n) for n nodes if the layers are thin against the model.
BoundaryLayers *boundary_layers_new(const Model *m, const FieldSet *fields, const Options *opt, Mesh1d *curves, Diag *diag);
void boundary_layers_free(BoundaryLayers *b); // NULL is fine

// Does the k-th face of the model have layers? b may be NULL.
bool boundary_layers_on(const BoundaryLayers *b, size_t k);

// Cells of the layers of the k-th face into `out` (own nodes, triangles, quadrangles), and the graph of what is left of it: the tops of the
// layers in the place of the curves. g zero-initialized.
void boundary_layers_fill(const BoundaryLayers *b, size_t k, const Mesh1d *curves, const EdgeNodes *en, FaceMesh *out, FaceGraph *g);

// Cumulative heights of the layers: size, size(1 + ratio), ... while not above thickness, at most `cap`. Returns their number.
size_t layer_heights(double size, double ratio, double thickness, double *height, size_t cap);
// n heights by the Beta law (a Roberts transform), clustered at the wall the more, the nearer beta > 1 is to 1.
void layer_heights_beta(double thickness, double beta, size_t n, double *height);

#endif
