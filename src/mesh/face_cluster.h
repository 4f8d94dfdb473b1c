// face_cluster.h - faces meshed as one triangulation, where boundary edges may have to be split
// SPDX-License-Identifier: MIT
#ifndef MESH_FACE_CLUSTER_H
#define MESH_FACE_CLUSTER_H

#include "base/base.h"
#include "mesh/face_graph.h"
#include "mesh/mesh2d.h"

typedef Vec(size_t) FaceVec; // indices of faces

// Faces of one plane that are refined together, so that what one of them does to a common curve the others see. Set the first
// group of members and the faces, zero the rest; release with face_cluster_free.
typedef struct {
  const Mesh2dInput *in;
  Mesh1d *curves;        // changed by face_cluster_mesh
  const EdgeNodes *nodes;
  const Map *held;       // tags of curves that must stay whole
  FaceVec face;
  const Face *frame;     // the first of them: its plane coordinates are everybody's

  FaceGraph graph;
  U32Vec first;          // per segment: index of its edge in its curve's mesh
  Tri tri;
  uint32_t *region;      // per triangle of the empty mesh
  size_t nregion;
  uint32_t *owner;       // per region: index into face, or NONE
  IntVec curve;          // tags of the curves bounding or embedded
  U32Vec chain, start;   // vertices of curve i from its begin to its end: chain[start[i]] to chain[start[i + 1] - 1]
  DoubleVec on_curve;    // per vertex that split an edge of a curve: its parameter there
  double next_on_curve;  // of the vertex that is being placed
  double *size;          // per vertex: the wanted edge length
  TriSkinnyVec skinny;   // triangles below the smallest angle
  Diag *diag;            // errors and warnings of the last meshing
} FaceCluster;

typedef enum {
  CLUSTER_DONE,
  CLUSTER_BAD,   // no valid empty mesh: faces overlap, nodes coincide, curves cross
  CLUSTER_LIMIT, // more triangles than allowed
} ClusterOutcome;

void face_cluster_free(FaceCluster *c); // what it holds, not c itself

// Mesh the faces, anew if they were meshed before: the empty mesh, refinement by the options (Mesh.MinimumAngle,
// Mesh.ConformingDelaunay), optimization. The curves get the nodes that were put on them; `nodes`, which must be that of the curves
// as they were, is not changed. Messages go to c->diag, a child of in->diag.
ClusterOutcome face_cluster_mesh(FaceCluster *c);

// The triangles of each face, into face[] as mesh2d_run does. `nodes` is that of the curves as they are now, which must not have
// changed since the cluster was meshed.
void face_cluster_extract(const FaceCluster *c, const EdgeNodes *nodes, FaceMesh *face);

// Say on in->diag how many triangles are below the smallest angle, and at which input angles, or what else holds them.
void face_cluster_say_skinny(const FaceCluster *c);

#endif
