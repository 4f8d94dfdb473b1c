// mesh_measure.h - shape, size and place of single elements
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH_MEASURE_H
#define MESH_MESH_MEASURE_H

#include "mesh/mesh.h"

typedef enum {
  MEASURE_GAMMA, // triangles: inscribed over circumscribed radius, doubled; quadrangles: eta [docs/quality-measures.md]
  MEASURE_ANGLE, // smallest angle, degrees
  MEASURE_ETA,   // 1 - largest deviation of an angle from 60 (90) degrees over 60 (90); not below 0
  MEASURE_JACOBIAN, // scaled Jacobian of quadrangles; triangles: kappa 1
  MEASURE_KAPPA1,   // of triangles [book §4.1]; quadrangles: eta
  MEASURE_KAPPA2,
  MEASURE_KAPPA3,
  MEASURE_KAPPA4,
  MEASURE_KAPPA5,
  MEASURES,
} Measure;

// "gamma", "angle", "eta", "jacobian", "kappa1" ... "kappa5". The other way round, MEASURES for a name that there is not.
const char *mesh_measure_name(Measure what);
Measure mesh_measure_find(const char *name);

// Corners of element i of block k as points; returns their number.
int mesh_corners(const Mesh *m, const MeshBlock *k, size_t i, Vec3 p[4]);
Vec3 mesh_center(const Mesh *m, const MeshBlock *k, size_t i); // mean of the corners

// Length of a line element, area of a surface element, of the straight-sided element of its corners; 0 for points. An area
// has the sign of the element's orientation against `normal`, or is positive if normal is (0,0,0).
double mesh_size_of(const Mesh *m, const MeshBlock *k, size_t i, Vec3 normal);
// A measure of a surface element's corners.
double mesh_measure(const Mesh *m, const MeshBlock *k, size_t i, Measure what);
// The least, over the corners of a quadrangle, of the cross product of the directions of the two edges there, along the normal of its
// area vector: 1 for a rectangle, 0 or less if it is not strictly convex; -1 where corners coincide.
double mesh_scaled_jacobian(const Mesh *m, const MeshBlock *k, size_t i);
// Smallest and largest interior angle in degrees.
void mesh_angle_range(const Mesh *m, const MeshBlock *k, size_t i, double *least, double *largest);

// Sum of the area vectors of the surface elements of entity (all of them when entity is NONE): its direction is the
// normal of a plane face and its length the area.
Vec3 mesh_area_vector(const Mesh *m, uint32_t entity);

#endif
