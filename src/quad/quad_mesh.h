// quad_mesh.h - plane meshes of triangles and quadrangles, and what turns the first into the second
// SPDX-License-Identifier: MIT
#ifndef QUAD_QUAD_MESH_H
#define QUAD_QUAD_MESH_H

#include "base/base.h"
#include "base/mem.h"
#include "geom/vec.h"

// Element e has the corners vertex[4e .. 4e+3], counterclockwise; a triangle has NONE at 4e+3. Edge i of an element runs
// from corner i to the next. An edge with one element is a boundary edge.
// The wanted edge length about a vertex, linear: h + slope (p - at).
typedef struct {
  Vec2 at, slope;
  double h;             // 0: not known
} QuadSize;

typedef struct {
  Vec(Vec2) xy;
  Vec(QuadSize) size;   // by vertex; empty: no sizes are known
  Vec(uint8_t) fixed;   // by vertex: 1 if it must not be moved or removed (on a curve, or embedded)
  U32Vec from;          // by vertex: which one it was when the mesh was made; NONE for a new one
  U32Vec parent;        // 2 by vertex: the ends of the edge that a new vertex halves (as numbered in `from`); else NONE, NONE
  U32Vec vertex;        // 4 by element
  U32Vec locked;        // edges, by their ends, that must stay besides boundary edges: embedded curves
} QuadMesh;

// A mesh of ntri triangles tri[3*ntri], counterclockwise, over nv points xy[2*nv]. fixed[nv] may be NULL: then the ends of
// boundary and locked edges are fixed; they always are. locked[2*nlocked] are edges by their ends. All is copied.
void quad_mesh_init(QuadMesh *m, const double *xy, const uint8_t *fixed, size_t nv, const uint32_t *tri, size_t ntri,
                    const uint32_t *locked, size_t nlocked);
void quad_mesh_free(QuadMesh *m);
// Tell the edge length wanted at each vertex (in the end, where elements are split) of a mesh of triangles that nothing has changed
// yet. O(n).
void quad_mesh_set_sizes(QuadMesh *m, const double *h);
// The wanted edge length about vertex v, at the place p near it; NAN if it is not known.
double quad_mesh_size(const QuadMesh *m, uint32_t v, Vec2 p);

static inline size_t quad_mesh_elements(const QuadMesh *m) { return m->vertex.len / 4; }
static inline bool quad_mesh_is_quad(const QuadMesh *m, size_t e) { return m->vertex.data[4 * e + 3] != NONE; }
static inline uint32_t quad_mesh_corners(const QuadMesh *m, size_t e) { return quad_mesh_is_quad(m, e) ? 4 : 3; }
size_t quad_mesh_triangles(const QuadMesh *m); // of the elements; O(n)

// For each side 4e+i of each element the side 4f+j of its neighbour, or NONE; sides of more than two elements get NONE.
// twin has 4 entries an element; the caller frees it. O(n).
uint32_t *quad_mesh_twins(const QuadMesh *m);

// Drop elements with NONE as first corner and vertices that no element uses and that are not fixed; keeps the order. O(n).
void quad_mesh_compact(QuadMesh *m);

// ---- recombination ----------------------------------------------------------------------------------------------

typedef enum {          // numbered as Mesh.RecombinationAlgorithm
  QUAD_GREEDY = 0,      // best pair first [book §5.2.1], then short exchanges for single triangles; some remain
  QUAD_BLOSSOM = 1,     // minimum-cost perfect matching [book §5.2.4]
  QUAD_FULL_GREEDY = 2, // greedy, then every element split into quads: no triangle remains; made for a mesh of double size
  QUAD_FULL_BLOSSOM = 3,
  QUAD_SPLIT = 4,       // only split: three quads for each triangle
} QuadAlgorithm;

typedef struct {
  QuadAlgorithm algorithm;
  double angle;         // degrees; greedy merges no pair with a corner that differs more from a right angle. Default 45
  int cleanup;          // rounds of topological clean-up, 0: none
  int smoothing;        // passes of smoothing, 0: none
  double min_eta;       // quads worse than this at the end, and any that is not convex, are replaced by five better ones where that can
                        // be; the greedy method cuts them into two triangles, the others only those that are not convex
  // Where the middle of the boundary or locked edge ab (as numbered in `from`) is on the geometry; the full-quad variants ask
  // it for each such edge. NULL, or false returned: halfway.
  bool (*middle)(void *ctx, uint32_t a, uint32_t b, Vec2 *p);
  void *ctx;
} QuadParams;

typedef struct {
  size_t quads, triangles;  // at the end
  size_t repaired;          // pairs of triangles left by the matching and brought together afterwards
  size_t odd_parts;         // parts of the mesh, connected over free edges, with an odd number of triangles: one is left in each
  double matching_seconds;  // processor time of the matching and of its check
  int64_t matching_cost;
  size_t removed;           // vertices removed by the clean-up
  size_t flips, collapses, doublets, opened;
  size_t filled;            // bad quads replaced by five
  size_t cut;               // bad quads cut into triangles again
  size_t inverted;          // elements at the end that are not strictly convex: only where `middle` puts a vertex across them
} QuadReport;

// Greedy 45 degrees, Blossom, clean-up and smoothing on.
QuadParams quad_params_default(void);

// Turn a mesh of triangles into quads. Boundary and locked edges stay edges (halved by the full-quad variants), fixed vertices
// stay where they are, nothing is ever inverted (but see QuadReport.inverted), and the worst element is not worse after clean-up
// and smoothing than before them. Deterministic. `report` may be NULL.
void quad_recombine(QuadMesh *m, const QuadParams *p, QuadReport *report);

// The steps of it, for tests and for meshes that have quads already.
void quad_match_greedy(QuadMesh *m, double angle);
void quad_match_blossom(QuadMesh *m, QuadReport *report);
void quad_repair(QuadMesh *m, QuadReport *report);   // bring leftover triangles of one part together in pairs
// Put a smaller quad and four around it in the place of each quad that is not convex or worse than min_eta, where that gives five
// that are clearly better than it was and not worse than `better`; returns how many.
size_t quad_fill_bad(QuadMesh *m, double min_eta, double better);
size_t quad_cut_bad(QuadMesh *m, double min_eta);    // returns how many quads were cut
void quad_clean(QuadMesh *m, int rounds, QuadReport *report);
void quad_smooth(QuadMesh *m, int passes);

// ---- audit ------------------------------------------------------------------------------------------------------

typedef enum {
  QUAD_GOOD,
  QUAD_BAD_INDEX,     // corner out of range or twice in one element
  QUAD_BAD_EDGE,      // an edge of more than two elements, or run through twice in one direction
  QUAD_INVERTED,      // a corner of a quad is not strictly convex, or a triangle not positively oriented (exact)
  QUAD_BAD_INDEX_SUM, // the indices of the vertices do not add up to the Euler characteristic [book eq. 5.3, §5.1.4]
} QuadVerdict;

typedef struct {
  size_t quads, triangles, vertices, edges, boundary_vertices;
  long euler;                      // vertices - edges + elements
  size_t valence[2][8];            // vertices by number of elements (7: 7 and more): [0] interior, [1] boundary
  size_t irregular;                // interior vertices whose valence is not 4 (all-quad meshes)
  size_t interior;
  long index_sum4;                 // four times the sum of the indices; equals 4 euler in an all-quad mesh
  double eta_min, eta_mean, eta_p5; // of the quads; 1 if there are none
  double jacobian_min;
  uint32_t worst;                  // quad with the least eta
} QuadQuality;

// Check orientation (exactly), conformity and the sum of indices; *where is the element or vertex that failed. O(n).
QuadVerdict quad_check(const QuadMesh *m, uint32_t *where);
const char *quad_verdict_text(QuadVerdict v);
QuadQuality quad_measure(const QuadMesh *m);

#endif
