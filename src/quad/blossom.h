// blossom.h - exact minimum-cost perfect matching on a general graph, with a dual certificate
// SPDX-License-Identifier: MIT
//
// The linear program of [Edmonds1965], in its form with cuts:
//
//   minimize    sum c_e x_e             over x >= 0 with x(delta(v)) = 1 for each vertex v
//                                                 and  x(delta(B)) >= 1 for each odd set B ("blossom")
//   maximize    sum y_v + sum z_B       over z >= 0 with, for each edge e = uv,
//                                       slack_e = c_e - y_u - y_v - sum of z_B over the B that hold one end of e >= 0.
//
// A perfect matching and a feasible (y, z) are both optimal when matched edges have no slack and each B with z_B > 0 is
// left by exactly one matched edge; then both objectives are equal. All numbers are integers: duals are given times
// a power of two.
#ifndef QUAD_BLOSSOM_H
#define QUAD_BLOSSOM_H

#include "base/base.h"

typedef struct {
  uint32_t n;            // vertices, at most BLOSSOM_MAX_VERTICES
  uint32_t m;            // edges; parallel edges and loops are allowed (a loop is never matched)
  const uint32_t *edge;  // 2m ends
  const int32_t *cost;   // m, of absolute value at most BLOSSOM_MAX_COST
} BlossomGraph;

enum { BLOSSOM_MAX_VERTICES = 1 << 28, BLOSSOM_MAX_COST = 1 << 24 };

// What the search did; for benches and reports.
typedef struct {
  uint64_t start_free;                      // vertices the start left unmatched: one for each odd cycle of a fractional optimum
  uint64_t grow, shrink, expand, augment;   // steps of the trees
  uint64_t swept;                           // vertices taken into a tree, summed over all growths
  uint64_t region;                          // regions of tight edges taken into a tree
  uint64_t event, stale;                    // entries taken from the queue; those found out of date
  uint64_t settle;                          // vertices passed when free ones are brought together over tight edges
  uint64_t relabel;                         // vertices renamed by shrinking and expanding
} BlossomStats;

typedef struct {
  uint32_t unmatched;    // vertices without a mate; 0: the matching is perfect (and of minimum cost)
  int64_t cost;          // of the matched edges
  uint32_t *mate;        // n: the vertex matched to v, or NONE
  uint32_t *mate_edge;   // n: the edge that does it, or NONE
  int64_t scale;         // duals are given times this
  int64_t *y;            // n: duals of the vertices
  uint32_t nblossom;     // blossoms with z > 0, or that hold one
  int64_t *z;            // nblossom: likewise
  uint32_t *parent;      // n + nblossom: the smallest blossom that holds vertex v, or (at n + i) blossom i; as an index
                         // in [0, nblossom), or NONE. A blossom's index is smaller than that of what it holds.
  uint8_t *barrier;      // n, only if unmatched > 0, else NULL: 1 for the vertices of a set A such that the graph without
                         // A has |A| + unmatched components of odd size (Tutte and Berge): no matching is larger
  BlossomStats stats;
} BlossomResult;

// A minimum-cost perfect matching of g; where none exists, a matching of maximum cardinality and a barrier that proves it
// (its cost is then not the least). Free with blossom_free. Deterministic. Time near m log n on graphs of meshes; memory
// about 200 bytes a vertex and 40 an edge.
BlossomResult *blossom_solve(const BlossomGraph *g);
void blossom_free(BlossomResult *r);

typedef enum {
  BLOSSOM_OK,
  BLOSSOM_BAD_MATE,      // not a matching of the graph's edges, or its cost or count is wrong
  BLOSSOM_BAD_FAMILY,    // blossoms not nested, or of even size
  BLOSSOM_NEGATIVE_Z,
  BLOSSOM_NEGATIVE_SLACK,
  BLOSSOM_LOOSE_MATCH,   // a matched edge has slack
  BLOSSOM_LOOSE_BLOSSOM, // a blossom is not left by exactly one matched edge
  BLOSSOM_GAP,           // primal and dual objective differ
  BLOSSOM_BAD_BARRIER,   // the barrier does not prove that no matching is larger
} BlossomVerdict;

// Check r against g from nothing but their definitions: optimality if r is perfect, maximum cardinality if not. *where
// (may be NULL) is set to the vertex, edge or blossom that failed. O(m log n).
BlossomVerdict blossom_check(const BlossomGraph *g, const BlossomResult *r, uint32_t *where);
const char *blossom_verdict_text(BlossomVerdict v);

#endif
