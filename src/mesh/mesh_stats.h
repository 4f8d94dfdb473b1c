// mesh_stats.h - what the report says of a mesh: counts and sizes by group and entity, quality, worst elements
// SPDX-License-Identifier: MIT
//
// The measures are defined in docs/quality-measures.md. Straight-sided elements of the corners are measured.
#ifndef MESH_MESH_STATS_H
#define MESH_MESH_STATS_H

#include "mesh/mesh.h"

enum { STATS_BINS = 20, STATS_WORST = 10 };

typedef struct {
  size_t n;
  double min, p5, mean, max; // p5: 5 % of the elements are below; all 0 if n is 0
  double range;              // the histogram spans 0 .. range
  size_t bin[STATS_BINS];
} MeasureStats;

// Elements of a group or of an entity.
typedef struct {
  int dim, tag;
  const char *name;          // of the group, NULL if none; belongs to the mesh
  size_t elements, entities;
  double size;               // length or area; 0 in dimension 0
} PartStats;

typedef struct {
  double value;              // gamma of a triangle, eta of a quadrangle
  ElemType type;
  int tag;                   // of its face
  uint64_t element;          // number, counted from 1 in the order of the blocks
  Vec3 at;                   // centre
} WorstElement;

typedef struct {
  size_t nodes, points, lines, triangles, quads;
  int order;                 // largest order of an element
  Vec3 lo, hi;               // bounding box of the nodes
  double length, area;       // of all line and of all surface elements
  MeasureStats gamma;        // triangles
  MeasureStats eta;          // quadrangles
  MeasureStats jacobian;     // scaled Jacobian of quadrangles
  MeasureStats angle;        // smallest angle of each surface element, degrees; only n, min and the histogram
  double angle_max;          // largest angle of any
  double edge_min, edge_max; // lengths of element edges
  size_t irregular;          // interior nodes of faces whose number of elements is not 6 (triangles) or 4 (quadrangles)
  size_t interior;           // interior nodes
  double tau;                // efficiency index [book eq. 4.16]; NAN without sizes
  WorstElement worst[STATS_WORST];
  size_t nworst;
  Vec(PartStats) group;      // by dimension and tag
  Vec(PartStats) entity;     // those with elements, by dimension and tag
} MeshStats;

// size: wanted edge length at each node, or NULL. Along an edge it is taken linear between its ends, so that its
// adimensional length is exact: len * ln(h1/h0) / (h1 - h0). O(n). Release with mesh_stats_free.
void mesh_stats_make(MeshStats *s, const Mesh *m, const double *size);
void mesh_stats_free(MeshStats *s);

#endif
