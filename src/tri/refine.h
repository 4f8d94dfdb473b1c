// refine.h - from the empty mesh to a mesh: point placement, optimization, smoothing, guaranteed angles
// SPDX-License-Identifier: MIT
#ifndef TRI_REFINE_H
#define TRI_REFINE_H

#include "base/base.h"
#include "geom/quality.h"
#include "tri/tri.h"

// Strategies of [book §4.4.3], numbered as Mesh.Algorithm.
typedef enum {
  REFINE_ADAPT = 1,    // split long edges, collapse short ones, flip, relocate
  REFINE_EMPTY = 3,    // add no vertex (optimization may still flip)
  REFINE_DELAUNAY = 5, // circumcentres of the triangles of the largest adimensional size
  REFINE_FRONTAL = 6,  // ideal points in front of active edges
  REFINE_FRONT_QUAD = 8, // lattices of right-angled triangles along `cross`, the largest gap first [Remacle13]
  REFINE_PACK = 9,     // the same, spreading from the boundary in layers [Baudouin14]
} RefineAlgorithm;

// How tri_refine ended.
typedef enum {
  REFINE_DONE,
  REFINE_LIMIT,     // max_triangles reached: a valid mesh, coarser than asked for
  REFINE_CANCELLED, // the callback said so: a valid mesh, unfinished
} RefineOutcome;

// Angles between segments under this, in radians, are input angles that min_angle cannot mend: 60 degrees, and what rounding may add.
#define REFINE_ACUTE 1.0472

// A triangle left below min_angle, and the vertex where segments meet at under 60 degrees that is the cause; NONE: something else,
// such as a segment that must stay whole.
typedef struct {
  TriId tri;
  VertId corner;
} TriSkinny;
typedef Vec(TriSkinny) TriSkinnyVec;

typedef struct {
  RefineAlgorithm algorithm;

  // Wanted edge length at a point of the face, positive; NULL: only the boundary's.
  SizeAt size;
  void *size_ctx;
  // Let sizes extend from the boundary into the face: each initial vertex carries the mean length of the segments at it (without
  // segments, of its shortest edge), interpolated linearly; the wanted size is the smaller of this and size().
  // Always on where size is NULL.
  bool extend_from_boundary;
  double carried_factor; // what all carried sizes are multiplied by; 0: as they are
  // Upper bound of the carried size of each initial vertex, such as the size asked for at an embedded point; NULL: none.
  // The caller owns it; as many entries as the triangulation has vertices.
  const double *vertex_size;

  // REFINE_FRONT_QUAD and REFINE_PACK: angle of a cross at a point, in radians, modulo a right angle; NULL: 0. *near is a hint, NONE or what the call for a
  // place nearby left there; cross_near gives one for each initial vertex, or is NULL.
  double (*cross)(void *ctx, Vec2 p, uint32_t *near);
  void *cross_ctx;
  const uint32_t *cross_near;

  int smoothing;   // passes of Laplacian smoothing that never make a worst triangle worse; Mesh.Smoothing
  int optimize;    // 0 none, 1 flips and repositioning, 2 also valence repair until nothing improves
  size_t max_triangles; // 0: what 32-bit indices hold

  // Guaranteed smallest angle in degrees, 0 for none (tri_minangle.c). Segments are split where they must be.
  double min_angle;
  // Split every segment whose diametral circle holds a vertex, before anything else [book §4.4.1].
  bool conforming;
  // Where to put the new vertex when the segment from u to v is split near its parameter `at` in (0,1) of the straight segment;
  // NULL puts it on the straight segment. Returns false where the segment must not be split.
  bool (*split)(void *ctx, VertId u, VertId v, double at, Vec2 *point);
  // Told after each split which vertex it is; may be NULL. Vertices of splits are never renumbered.
  void (*placed)(void *ctx, VertId u, VertId v, VertId w);
  void *split_ctx;
  // Gets the triangles left below min_angle, in the order of their ids, in an array that the caller frees; NULL: not wanted.
  TriSkinnyVec *skinny_out;

  // Gets the wanted edge length at each vertex, boundary sizes included, in an array that the caller frees; NULL: not wanted.
  double **sizes_out;

  // Called now and then with the share done; true cancels.
  bool (*cancel)(void *ctx, double done);
  void *cancel_ctx;
} TriRefineParams;

typedef struct {
  RefineOutcome outcome;
  size_t inserted;   // vertices added in the interior
  size_t split;      // vertices added on segments
  size_t flips, moves, collapses; // by the optimization (and by MeshAdapt)
  size_t skinny;     // triangles left below min_angle: no rule may split them
} TriRefineStats;

// The defaults: frontal, extending from the boundary, one smoothing pass, optimization of level 1.
TriRefineParams tri_refine_defaults(void);

// Refine a constrained and carved triangulation in place. Segments stay edges of the mesh, whole unless split as said above.
// Every decision on topology is exact and the result depends on the arguments alone. About 0.3 us per triangle; small faces, which are
// polished, take milliseconds.
TriRefineStats tri_refine(Tri *m, const TriRefineParams *p);

#endif
