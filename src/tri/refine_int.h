// refine_int.h - what the strategies of refinement share: sizes, the insertion engine, queues
// SPDX-License-Identifier: MIT
#ifndef TRI_REFINE_INT_H
#define TRI_REFINE_INT_H

#include "base/base.h"
#include "base/mem.h"
#include "tri/refine.h"
#include "tri/tri_metric.h"

#include <string.h>

// Bits of flag[t] while refining.
enum {
  REFINE_SMALL = TRI_USER_0, // the triangle's adimensional size is within the limit
  REFINE_STUCK = TRI_USER_1, // no point can be placed for it
};

// One side of the cavity of a new point, counterclockwise; the new triangle on it is (a, next side's a, point).
typedef struct {
  VertId a;
  EdgeId outer;  // the half-edge outside the cavity
  uint32_t seg;  // id of the segment on it; used if is_seg
  TriId tri;     // the new triangle, after the commit
  bool is_seg;
} RimSide;

typedef Vec(RimSide) RimVec;

// Key of x >= 1 for stacks: grows with the logarithm of x, which the leading bits of a float are; 2^(23 - shift) keys an octave.
static inline int refine__key(double x, int shift, int nkeys)
{
  float f = (float)fmin(x, 1e38), one = 1;
  uint32_t bits, base;
  memcpy(&bits, &f, sizeof bits);
  memcpy(&base, &one, sizeof base);
  if (!(f > 1)) return 0;
  uint32_t k = (bits - base) >> shift;
  return k < (uint32_t)nkeys ? (int)k : nkeys - 1;
}

// Triangles of a face called large: its mesh is out of the caches, and the order of insertions minds that.
#define REFINE_LARGE 2e5

typedef struct {
  Tri *m;
  const TriRefineParams *p;
  TriRefineStats *stats;
  double *size;     // by vertex: wanted edge length
  double *carried;  // by vertex: size carried from the boundary; NULL where only the callback counts
  uint32_t cap_v;   // entries of the two
  size_t max_vertices;
  double expected;  // triangles, from refine__reserve
  uint64_t ticks;

  // For the optimization, by vertex.
  bool *fixed;      // not to move: given, on a segment, or isolated
  uint8_t *awake;   // its star is worth a visit
  int16_t *excess;  // edges more than six; 0 where fixed
  bool keep_sizes;  // a vertex that moves keeps its size: for trials, which the size field would make slow
  double floor;     // 1/kappa_4^2 that a triangle may rise to while its star gets better
  double worst;     // 1/kappa_4^2 of the worst triangle before the optimization

  // The cavity being built.
  double at[2];
  RimVec rim;
  U32Vec dead, stack;
} Refiner;

// ---- tri_refine.c
// Sizes of the vertices of the empty mesh; arrays that refine__release frees.
void refine__initial_sizes(Refiner *r);
// Estimate the number of triangles from these, and make room for them, so that growing arrays need not be copied; only what is used of
// it costs memory.
void refine__reserve(Refiner *r);
// Size wanted at p, which lies in (or near) triangle t; *carried gets the interpolated boundary size if that is in use.
double refine__size_at(Refiner *r, const double *p, TriId t, double *carried);
// The size of a vertex that refine__commit has not added, which `carried` is carried to.
void refine__size_vertex(Refiner *r, VertId v, double carried);
// What the size callback says in the middle of triangle t.
double refine__size_inside(const Refiner *r, TriId t);
// Triangle that holds p, walking from t. NONE if a segment is in the way, the half-edge *blocked.
TriId refine__walk(const Tri *m, const double *p, TriId t, EdgeId *blocked);
// Collect the constrained Delaunay cavity of p in triangle t. False if p is on a vertex or a segment, or too near to one
// (seen under more than a right angle, while `clear`).
bool refine__cavity(Refiner *r, const double *p, TriId t, bool clear);
// Replace it by the ball of p; r->rim tells the new triangles.
VertId refine__commit(Refiner *r, double size, double carried);
// Room for one more vertex, and nobody wants to stop.
bool refine__go_on(Refiner *r);

// ---- strategies
// The limit at which the efficiency index is highest.
#define REFINE_LIMIT_SIZE 1.36
// Refine triangles whose adimensional size, sqrt(3) R / h, is above the limit; those flagged as small are within it.
void refine__delaunay(Refiner *r, double limit);
// Square of the adimensional size of t over that of the limit; by the sizes at its corners and, where these say it is small, inside.
double refine__excess2(const Refiner *r, double limit, TriId t);
void refine__frontal(Refiner *r);
void refine__front_quad(Refiner *r, bool by_age);

// ---- tri_lattice.c
// What the meshes for quads know of each vertex.
typedef struct {
  double *angle;   // of its cross
  double *stretch; // length of the boundary's edges nearby over the size wanted there
  uint32_t *near;  // hint for the callback `cross`
} RefineCross;
// Passes of repositioning along the crosses over the vertices from `given` on; keeps the triangulation Delaunay.
void refine__lattice_smooth(Refiner *r, RefineCross *x, VertId given, int passes);
// MeshAdapt: first the points, then, after refine__prepare, the sweeps. These leave isolated vertices and stale `excess`.
void refine__saturate(Refiner *r);
void refine__adapt(Refiner *r);

// ---- tri_minangle.c
// Bring every angle to `degrees` where the input lets it. The triangulation must be constrained Delaunay, with hints.
void refine__min_angle(Refiner *r, double degrees, VertId given);
// Split segments until no diametral circle holds a vertex.
void refine__conform(Refiner *r);

// ---- tri_renumber.c
// Number triangles, and vertices from `first` on, along a Hilbert curve; of these, isolated ones go. Drops the hints. O(n).
void refine__renumber(Refiner *r, VertId first);
// Number vertices from `first` on anew without the isolated ones. Keeps the hints. O(n).
void refine__drop_isolated(Refiner *r, VertId first);

// ---- optimization
// Make hints and the arrays by vertex. The first `given` vertices are not to move.
void refine__prepare(Refiner *r, VertId given);
// Passes of repositioning over the vertices awake.
void refine__smooth(Refiner *r, int passes);
// Collapse e onto its destination if the triangles made have at least the quality and edges the length given. The origin becomes
// isolated.
bool refine__collapse(Refiner *r, EdgeId e, double least_quality, double longest);
void refine__wake_around(Refiner *r, VertId v);
// Flip edges that are not locally Delaunay, near vertices awake, where the worse triangle gets better. Returns how many.
size_t refine__flips(Refiner *r);
// Improve the position of interior vertex v; true if it moved.
bool refine__relocate(Refiner *r, VertId v);
// The same for the worst triangle around v alone, by pattern search. Dearer.
bool refine__relocate_worst(Refiner *r, VertId v);
// Flip e, which may be flipped.
void refine__flip(Refiner *r, EdgeId e);
// Arrays by vertex keep up with a new vertex of the triangulation, free to move.
void refine__added_vertex(Refiner *r, VertId v, double size, double carried);
// The worst `most` triangles below `least` (kappa_4^2) by trials of flips, collapses and splits, in rounds while that helps.
// About 100 us for a triangle. Collapses leave isolated vertices.
void refine__rework(Refiner *r, double least, size_t most, int rounds);
void refine__optimize(Refiner *r, int level);

// ---- tri_field.c
// The size that extends from the boundary, linear on the empty mesh: it does not depend on the order of insertions.
typedef struct {
  Tri empty;
  double *size; // at its vertices; NULL: no size extends
} RefineField;
void refine__field_take(RefineField *f, const Refiner *r); // before the first insertion
void refine__field_free(RefineField *f);
// Sizes by the field at the vertices that are free to move.
void refine__field_apply(RefineField *f, Refiner *r);
double refine__field_at(RefineField *f, const double *p); // INFINITY where no size extends
// The size wanted at p, of the boundary and of the callback; `otherwise` where none says.
double refine__wanted(RefineField *f, const Refiner *r, const double *p, double otherwise);
// Value at p of what is linear on triangle t, within the values at its corners.
double refine__linear(const Tri *m, const double *at_vertex, TriId t, const double *p);

// ---- tri_attempt.c
enum { REFINE_POLISHED = 3000 }; // slots for triangles of a face that is small
// The face meshed and optimized from the empty mesh that r has, whose vertices are `given`. If it is small, meshes of several scales are
// compared and the best ones polished; in none that is kept is 1/gamma of the worst triangle a sixtieth above that of the first one before
// it was optimized, or more.
void refine__make_mesh(Refiner *r, VertId given);
// Everything but the mesh.
void refine__release(Refiner *r);

#endif
