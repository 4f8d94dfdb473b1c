// face_quads.h - recombining the triangles of a face to quadrangles
// SPDX-License-Identifier: MIT
#ifndef MESH_FACE_QUADS_H
#define MESH_FACE_QUADS_H

#include "mesh/filling_mesh.h"
#include "mesh/mesh2d.h"

// Is face f to be recombined, by its own attribute or by Mesh.RecombineAll?
bool face_is_recombined(const Face *f, const Options *o);

// Do the full-quad methods apply to f: asked for, and has every one of its curves an even number of edges? Then its graph is to be
// made of every second node (FaceGraph.coarse), and the mesh is of double size until every element is split.
bool face_is_split(const Model *m, const Face *f, const Mesh1d *curves, const Options *o);

// Size of the triangles over the wanted size of the quadrangles. Two equilateral triangles of side H make a rhombus with the
// area of a square of side sqrt(sqrt(3)/2) H, which smoothing turns it into; splitting every element halves that, and makes three
// quadrangles of a triangle that is single.
double face_quads_size_factor(const Face *f, const Options *o, bool coarse);
// The part of it that single triangles ask for. It is what sizes extended from the boundary are multiplied by: meshes are more regular
// where triangles are as long there as the edges of the boundary.
double face_quads_single_factor(const Options *o, bool coarse);

// Edge lengths wanted in the plane of the face.
typedef struct {
  const double *vertex;  // at each vertex of the triangulation
  SizeAt at;             // anywhere; NULL: only known at vertices
  void *ctx;
  bool extended;         // what the boundary carries inside is at the vertices, too, and bounds what `at` says
} FaceSizes;

// A face in triangles: its triangulation, and the graph that this was made from.
typedef struct {
  const Tri *tri;
  const FaceGraph *graph;
  const FaceMap *map;
  FaceSizes sizes;
} FaceTriangles;

// What extract is for triangles: those that are inside, recombined, appended to out. base: the number of nodes of points and curves.
// Warns where triangles remain although quadrangles only were asked for; *excess are those
// that no odd number of edges explains. False, with out as it was, if the graph is coarse and the nodes left out, put back on the curves,
// turn elements over: then the face is to be meshed with all its boundary nodes.
bool face_quads(const FaceTriangles *from, const Options *o, uint32_t base, FaceMesh *out, size_t *excess, Diag *diag);

#endif
