// face_cluster_int.h - what the files face_cluster*.c share
// SPDX-License-Identifier: MIT
#ifndef MESH_FACE_CLUSTER_INT_H
#define MESH_FACE_CLUSTER_INT_H

#include "mesh/face_cluster.h"

// Label the regions into which segments cut the plane and find the face that each belongs to. False if faces overlap.
bool face_cluster__regions(FaceCluster *c);

// Does every embedded curve lie in its face? Says where one does not.
bool face_cluster__embedded_inside(const FaceCluster *c);

// Place of vertex v in space.
Vec3 face_cluster__place(const FaceCluster *c, VertId v);

#endif
