// tri.h - triangulations of the plane: exact (constrained) Delaunay kernel and local modifications
// SPDX-License-Identifier: MIT
#ifndef TRI_TRI_H
#define TRI_TRI_H

#include "base/base.h"

#include "base/mem.h"
#include "geom/predicates.h"

// A triangulation is three flat arrays. Triangle t owns the half-edges 3t, 3t+1, 3t+2; half-edge e runs from vertex
// vert[e] to vert[next(e)], counterclockwise, and twin[e] is the half-edge of the neighbour that runs the other way.
//
//                 vert[3t+2]
//                     o                      next(e) : 3t -> 3t+1 -> 3t+2 -> 3t
//                    / \                     prev(e) : the other way round
//           3t+2 -> /   \ <- 3t+1            apex(e) = vert[prev(e)] : the vertex opposite to e
//                  /  t  \                   orient2d(org, dest, apex) > 0
//      vert[3t]   o-------o   vert[3t+1]
//                 3t ->                      tri_of(e) = e / 3
//          <- twin[3t] of the neighbour
//
// The outside of the convex hull is triangulated too, by ghost triangles on one vertex at infinity, TRI_INF: each hull
// edge a -> b (outside on its left) has the ghost (a, b, inf), in any rotation. So every half-edge has a twin, and with
// n vertices there are exactly 2n - 2 triangles, ghosts included. Points all on one line give ghosts only: two for each
// edge, each the other's twin.
//
// Triangles outside the domain (tri_carve) stay in the arrays, flagged, until tri_compact drops them.
typedef uint32_t VertId, TriId, EdgeId;

#define TRI_INF UINT32_MAX             // the vertex at infinity; every other vertex id is below TRI_MAX_VERTICES
#define TRI_MAX_VERTICES 0x3fffffffu

enum {                   // bits of flag[t]
  TRI_SEG_0 = 1,         // half-edge 3t lies on a segment (TRI_SEG_0 << i for 3t+i); both twins say so
  TRI_FREE = 8,          // the slot is on the free list; its other contents are void
  TRI_OUTSIDE_FLAG = 16, // not in the domain (tri_carve)
  TRI_USER_0 = 32, TRI_USER_1 = 64, TRI_USER_2 = 128, // for the caller; new triangles have them clear
};

typedef struct {
  double *xy;          // 2 * nv
  uint32_t *vert;      // 3 * nt
  uint32_t *twin;      // 3 * nt; in free slots twin[3t] links the free list
  uint8_t *flag;       // nt
  uint32_t *seg;       // 3 * nt, id of the segment that half-edge lies on; defined where the flag says so. NULL: none ever
  uint32_t *region;    // nt, label given by tri_carve, kept by all operations; NULL: no labels
  uint32_t *hint;      // nv, some half-edge with that origin, or NONE for isolated vertices; NULL until tri_make_hints
  uint32_t nv, nt;     // vertices; triangle slots in use or free
  uint32_t cap_v, cap_t;
  uint32_t free_list, nfree;
  EdgeId last;         // where the next walk starts when no hint is given
  uint8_t dim;         // 2; or 1 all points collinear, 0 one point, 255 no point
  PredCount count;
  uint64_t walks, walk_steps; // walks of insertions and tri_locate, and the edges they crossed
  uint64_t cavity_triangles;  // in the cavities of tri_build's insertions
  uint64_t merge_triangles, merge_flips; // made and flipped where tri_build merges parts
} Tri;

// ---- navigation -----------------------------------------------------------------------------------------------
static inline TriId tri_of(EdgeId e) { return e / 3; }
static inline EdgeId tri_next(EdgeId e) { return e % 3 == 2 ? e - 2 : e + 1; }
static inline EdgeId tri_prev(EdgeId e) { return e % 3 == 0 ? e + 2 : e - 1; }
static inline VertId tri_org(const Tri *m, EdgeId e) { return m->vert[e]; }
static inline VertId tri_dest(const Tri *m, EdgeId e) { return m->vert[tri_next(e)]; }
static inline VertId tri_apex(const Tri *m, EdgeId e) { return m->vert[tri_prev(e)]; }
static inline const double *tri_xy(const Tri *m, VertId v) { return m->xy + 2 * (size_t)v; }
static inline bool tri_is_ghost(const Tri *m, TriId t)
{
  const uint32_t *v = m->vert + 3 * (size_t)t;
  return (v[0] | v[1] | v[2]) > TRI_MAX_VERTICES;
}
static inline bool tri_is_free(const Tri *m, TriId t) { return m->flag[t] & TRI_FREE; }
static inline bool tri_is_outside(const Tri *m, TriId t) { return m->flag[t] & TRI_OUTSIDE_FLAG; }
// Neither free, nor a ghost, nor outside the domain: what a mesh consists of.
static inline bool tri_is_inside(const Tri *m, TriId t)
{
  return !(m->flag[t] & (TRI_FREE | TRI_OUTSIDE_FLAG)) && !tri_is_ghost(m, t);
}
static inline bool tri_is_segment(const Tri *m, EdgeId e) { return m->flag[e / 3] >> (e % 3) & 1; }
// Id of the segment under e, or NONE.
static inline uint32_t tri_segment(const Tri *m, EdgeId e) { return tri_is_segment(m, e) ? m->seg[e] : NONE; }
// Half-edges with one origin: counterclockwise and clockwise successor. Ghosts included, so it always closes.
static inline EdgeId tri_ccw(const Tri *m, EdgeId e) { return m->twin[tri_prev(e)]; }
static inline EdgeId tri_cw(const Tri *m, EdgeId e) { return tri_next(m->twin[e]); }

// ---- life -----------------------------------------------------------------------------------------------------
void tri_init(Tri *m);  // empty; all zero but the sentinels
void tri_copy(Tri *to, const Tri *from); // to is released with tri_free; no counts
void tri_free(Tri *m);  // releases the arrays and leaves it as tri_init does
// Room for so many vertices and triangle slots in all. Amortized doubling happens by itself.
void tri_reserve(Tri *m, size_t nv, size_t nt);
// Make m->hint (O(nt)); every operation keeps it up from then on.
void tri_make_hints(Tri *m);
// Some half-edge with origin v; O(1) with hints, else O(nt). NONE for an isolated vertex.
EdgeId tri_edge_at(const Tri *m, VertId v);
// The half-edge a -> b, or NONE. O(degree of a), with hints.
EdgeId tri_find_edge(const Tri *m, VertId a, VertId b);
// The angle from segment *e counterclockwise to the next segment with its origin, which *e becomes (the same one if there is no
// other). INFINITY if a part of it is not inside the domain. O(triangles between).
double tri_wedge(const Tri *m, EdgeId *e);
// Squeeze out free slots; with drop_outside also ghosts and triangles outside the domain, whose neighbours get twin NONE
// (then only reading is allowed). Keeps the order of triangles. O(nt).
void tri_compact(Tri *m, bool drop_outside);
// Bytes of the arrays.
size_t tri_bytes(const Tri *m);

// ---- building -------------------------------------------------------------------------------------------------
typedef struct {
  bool reorder;         // number the vertices along a Hilbert curve (fast for many points) instead of as given
  bool take;            // xy came from malloc and becomes the triangulation's: no copy is made
  int threads;          // 0: one per processor; the result never depends on it
  bool incremental;     // by insertion alone, as the book does, in rounds along the curve, instead of by merged parts: slower
  uint32_t *vertex_of;  // n entries filled with the vertex of each point, or NULL. Of equal points the first is the vertex
  U32Vec *duplicates;   // the later ones of equal points are appended, ascending; or NULL
  uint32_t bad;         // on TRI_BUILD_NOT_FINITE the index of the point
} TriBuild;
typedef enum { TRI_BUILD_GOOD, TRI_BUILD_NOT_FINITE, TRI_BUILD_TOO_MANY } TriBuildResult;

// The Delaunay triangulation of n points into m (from tri_init). It is unique: cocircular points are settled by
// incircle_perturbed, so any order of the points gives the same triangles, and with reorder the same arrays. Without
// reorder the duplicates are isolated vertices. n may be 0. With `take`, xy is freed or kept also on failure.
// Expected O(n log n) for points that are not clustered too wildly [Guibas85]; by insertion [book §3.3], [Bowyer81],
// [Watson81] with about 1.5 walk steps and 4 cavity triangles a point.
TriBuildResult tri_build(Tri *m, double *xy, size_t n, TriBuild *how);

// ---- location -------------------------------------------------------------------------------------------------
typedef enum {
  TRI_IN_FACE,   // strictly inside; *e is a half-edge of that triangle
  TRI_ON_EDGE,   // strictly inside edge *e
  TRI_ON_VERTEX, // equal to the origin of *e
  TRI_OUTSIDE,   // outside the convex hull; *e belongs to a ghost whose hull edge p sees
} TriLoc;
// Where p is. The walk starts at half-edge `start` (NONE: where the last one ended). Ends on every triangulation,
// Delaunay or not: a visibility walk, which after many steps becomes a straight one [Devillers02]. Sets m->last.
// Requires dim == 2.
TriLoc tri_locate(Tri *m, const double p[2], EdgeId start, EdgeId *e);

// ---- insertion ------------------------------------------------------------------------------------------------
// The cavity of a point: the triangles whose circle contains it, reached without crossing a segment [book §3.1.2].
// Zero-initialize once and reuse: no allocation per point. Valid until the triangulation changes.
typedef struct {
  double p[2];
  U32Vec tri;      // the triangles. After tri_commit: the new ones, tri[k] on rim[k]
  U32Vec rim;      // outer half-edges of the boundary, counterclockwise: edge k of the cavity runs from
                   // dest(rim[k]) to org(rim[k]); the new triangle on it is (dest(rim[k]), org(rim[k]), p)
  uint32_t seg;    // id of the segment being split, or NONE
  uint32_t split;  // splitting: p is joined to the ends dest(rim[0]) and dest(rim[split]); NONE: to both ends of rim[0]
  uint32_t tri_split; // splitting: tri[0 .. tri_split) are on one side of the edge, the others beyond; else 0
  U32Vec stack;    // scratch
} TriCavity;
void tri_cavity_free(TriCavity *c);

typedef enum {
  TRI_INSERTED,   // done (tri_cavity: can be done)
  TRI_DUPLICATE,  // there is a vertex at p; nothing changed
  TRI_ON_SEGMENT, // p lies on a segment, and splitting was not asked for; nothing changed
  TRI_BLOCKED,    // p does not see its whole cavity (splitting a segment at a point beside it); nothing changed
} TriInsert;
// Collect the cavity of p that tri_locate found at (loc, e). No change to m; O(cavity). On TRI_ON_EDGE of a segment:
// TRI_ON_SEGMENT.
TriInsert tri_cavity(Tri *m, TriCavity *c, const double p[2], TriLoc loc, EdgeId e);
// Collect the cavity of p that splits the segment under e. p need not be exactly on it (it is a rounded point); it must see
// the cavity on both sides, else TRI_BLOCKED. If e is no segment: as tri_locate and tri_cavity.
TriInsert tri_cavity_split(Tri *m, TriCavity *c, const double p[2], EdgeId e);
// Replace the cavity by the ball of its point: the new vertex, whose id is returned. c->tri tells the new triangles,
// slots of old ones first; vertex p is vert[3*tri[k]+2]. Region labels, outside flags and segments are kept; the two
// halves of a split segment bear its id. The triangulation stays constrained Delaunay if it was.
VertId tri_commit(Tri *m, TriCavity *c);

// Locate, cavity, commit. *v: the new or the old vertex (on TRI_ON_SEGMENT unchanged). Works in any dimension (a point
// that makes a collinear set two-dimensional, and any in dim < 2, costs O(nv)).
TriInsert tri_insert(Tri *m, TriCavity *c, const double p[2], EdgeId start, VertId *v);
// Split the segment (or edge) under e at p and restore the Delaunay property.
TriInsert tri_split_segment(Tri *m, TriCavity *c, const double p[2], EdgeId e, VertId *v);

// ---- local changes that need not keep the Delaunay property -----------------------------------------------------
// Can edge e be flipped: not a segment, no ghost beside it, and the four vertices strictly convex?
bool tri_can_flip(Tri *m, EdgeId e);
// Turn the edge in its quadrilateral: e = ab with apexes c (left) and d (right) becomes dc. Requires tri_can_flip.
// e stays the id of the new edge: org d, dest c. Keeps flags, ids of the outer edges, hints. User bits are cleared.
void tri_flip(Tri *m, EdgeId e);
// Is e locally Delaunay, or a segment, or on the hull?
bool tri_is_delaunay(Tri *m, EdgeId e);
// The flip algorithm [book §2.2.6]: flip from the edges of `work` outward until every edge is a segment or locally
// Delaunay. work is consumed. Returns the number of flips.
uint64_t tri_legalize(Tri *m, U32Vec *work);
// The same from all edges: the constrained Delaunay triangulation out of any triangulation.
uint64_t tri_legalize_all(Tri *m);
// Split edge e at p into four triangles without looking at circles. p must see the four outer edges (exact), else NONE
// and nothing changed. The halves of a segment bear its id. Returns the new vertex.
VertId tri_split_edge(Tri *m, const double p[2], EdgeId e);
// Split triangle t at p (strictly inside, else NONE) into three.
VertId tri_split_face(Tri *m, const double p[2], TriId t);
// Would moving v to p keep every triangle around it positive (exact)? tri_move does it if so.
bool tri_can_move(Tri *m, VertId v, const double p[2]);
bool tri_move(Tri *m, VertId v, const double p[2]);
// Would collapsing e = ab onto b (a disappears) keep the surface and every triangle positive? Refused for: an a on
// segments, unless e is one and the only other segment at a continues it (tri_collapse then moves the side to b, exact
// collinearity is not asked for); an edge whose ends share more than the two apexes; hull vertices a.
bool tri_can_collapse(Tri *m, EdgeId e);
// Do it. a becomes an isolated vertex, two triangle slots become free. Requires tri_can_collapse and hints.
void tri_collapse(Tri *m, EdgeId e);

// Remove vertex v and fill the hole so that a (constrained) Delaunay triangulation stays one. false, and nothing
// changed, if v is on a segment. Requires dim == 2 and hints. O(d^2), d its degree. v becomes isolated.
bool tri_remove(Tri *m, VertId v);

// ---- segments ---------------------------------------------------------------------------------------------------
typedef enum {
  TRI_SEG_CROSSES,  // segment a crosses segment b inside both, at p; the part of `a` that crosses is not in the triangulation
  TRI_SEG_OVERLAPS, // a runs along b, which keeps the edge
  TRI_SEG_EMPTY,    // both ends of a are the same vertex
  TRI_SEG_VERTEX,   // a passes exactly through vertex v: it was split there (not an error)
} TriSegWhat;
typedef struct {
  TriSegWhat what;
  uint32_t a, b; // ids of the segments; b is NONE where there is no other
  VertId v;
  double p[2];
} TriSegEvent;
typedef Vec(TriSegEvent) TriSegEvents;

// Force the edges ends[2i] -> ends[2i+1] (vertex ids) into the triangulation with id ids[i] (NULL: id i), by flips
// [book §4.4.1], then flip to the constrained Delaunay triangulation, which again is unique. What is remarkable is
// appended to `events` (may be NULL) in order of i. Returns the number of crossings. Makes hints.
// O(crossed edges ^ 2) for one segment at worst, O(1) when the edge is there already.
size_t tri_insert_segments(Tri *m, const uint32_t *ends, const uint32_t *ids, size_t n, TriSegEvents *events);

// ---- domain -----------------------------------------------------------------------------------------------------
typedef struct {
  const bool *embedded;      // by segment id: the segment is inside the domain, it does not bound it; NULL: none is
  bool concavities;          // no segment bounds: the convex hull is the domain (seeds still apply)
  const double *holes;       // 2 * nholes points: what can be reached from there is outside too
  size_t nholes;
  const double *regions;     // 2 * nregions points: what can be reached is labelled with labels[i]
  const uint32_t *labels;
  size_t nregions;
  bool even_odd;             // a triangle is inside if an odd number of bounding segments separate it from infinity;
                             // otherwise: all that cannot be reached from infinity and the holes
} TriCarve;
// Set TRI_OUTSIDE_FLAG on every triangle not in the domain (ghosts included), clear it elsewhere, and label regions
// (unlabelled triangles get 0) [book §4.4.2]. Returns the number of triangles inside. O(nt).
uint32_t tri_carve(Tri *m, const TriCarve *how);

// ---- checks, dual ---------------------------------------------------------------------------------------------------
enum {
  TRI_CHECK_LINKS = 1,      // ids in range; twin of twin; twins share both vertices; free list; hints; flags agree
  TRI_CHECK_ORIENT = 2,     // every finite triangle counterclockwise, exactly; the hull convex
  TRI_CHECK_EULER = 4,      // V - E + F == 2 with the vertex at infinity; one ball of triangles at each vertex
  TRI_CHECK_DELAUNAY = 8,   // every edge locally Delaunay (perturbed) unless it is a segment
  TRI_CHECK_AREA = 16,      // the areas add up to that of the hull within rounding
  TRI_CHECK_ALL = 31,
};
typedef struct {
  unsigned rule; // the TRI_CHECK_ bit broken first, 0 if none
  EdgeId e;      // where
  size_t count;  // violations in all
} TriCheck;
// Validate by the rules asked for; returns the number of violations, and in *out (may be NULL) the first. O(nt).
size_t tri_check(const Tri *m, unsigned rules, TriCheck *out);

// The Voronoi diagram, dual of a Delaunay triangulation without segments [book §2.1], within the rectangle lo..hi, which has
// every vertex strictly inside. The cell of vertex v has the corners corners[start[v] .. start[v+1]), nodes counterclockwise;
// cells share nodes and fill the rectangle. Nodes 0 to 3 are its corners. Points on one circle share one node, exactly.
// Isolated vertices (duplicates) have empty cells. O(nt). The caller frees with tri_voronoi_free.
typedef struct {
  double *xy;                // 2 * nnode
  uint32_t *start, *corners; // nv + 1; sum
  uint32_t nnode;
} TriVoronoi;
void tri_voronoi(const Tri *m, const double lo[2], const double hi[2], TriVoronoi *out);
void tri_voronoi_free(TriVoronoi *v);

#endif
