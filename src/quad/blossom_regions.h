// blossom_regions.h - the graph whose nodes are regions of tight edges: structures shared by its two files
// SPDX-License-Identifier: MIT
//
// In the regular parts of a mesh all edges are tight, and 95 vertices of 100 are in a few dozen regions.
// Vertices of a region have the same sign always, and edges inside of it need no watching. Only vertices
// with an edge to another region are looked at, the ports; a list of them is all that there is of a region.
//
// When two trees meet, the edges on the way that lead from region to region are matched, and both ends of
// each leave their regions; they are a region by themselves then. Whoever was matched to them is free,
// inside of its region, and nobody's concern until all is over. So a region is taken to have room for any
// number of paths. Where it has not, some of the free vertices stay free. The duals are feasible and matched
// edges tight whatever happens.
#ifndef QUAD_BLOSSOM_REGIONS_H
#define QUAD_BLOSSOM_REGIONS_H

#include "quad/blossom_tight.h"

typedef enum {
  REGION, // as found by tight__regions, or a pair matched since
  FREE,  // a single vertex
  CYCLE, // a vertex of an odd cycle
  FOUND, // one of the regions that an odd cycle found by a tree passes through
} RegionKind;

typedef struct {
  int64_t shift;     // by which duals on side 0 have risen, and those on side 1 fallen, but for sign * now
  int32_t sign;      // BlossomSign of side 0
  int32_t role;      // FOUND: its sign when the cycle was found
  uint32_t kind;
  uint32_t tree;     // in a tree: the region of its root; FOUND: its cycle
  uint32_t link;     // next region of its tree
  uint32_t pred;     // in a tree, or FOUND: arc from the inner vertex it was entered at to the outer one
                     // above; NONE: the root
  uint32_t first[2]; // ports of each side
} Region;

typedef struct {
  int64_t pot;         // dual, but for its region's shift
  uint32_t v;          // the vertex
  uint32_t side;       // as of TightVertex
  uint32_t start;      // first of its arcs, in the vertex's order
  uint32_t degree;
  uint32_t next, prev; // ports of the same side
} Port;

// Arc of a port. Its head is NONE while that is on the other side of the same region.
typedef struct {
  uint32_t head, tail, rev;
  int32_t cost;
} PortArc;

// An odd cycle through regions: from both ends of `arc` up to the region `top`.
typedef struct {
  uint32_t arc, top;
} FoundCycle;

typedef struct {
  Frac *f;
  TightVertex *v;
  uint32_t *port_of; // n: port of a vertex, or NONE
  Vec(Region) region;
  Vec(Port) port;
  Vec(PortArc) arc;
  Vec(FoundCycle) cycle;
  U32Vec path;
} Regions;

static inline int regions__side_sign(uint32_t side) { return side & 1 ? -1 : 1; }
static inline uint32_t regions__at(const Regions *g, uint32_t port) { return g->port.data[port].side / 2; }
static inline Region *regions__of(const Regions *g, uint32_t port)
{
  return &g->region.data[regions__at(g, port)];
}
// What a region's fields say of side 0 holds for the port times this.
static inline int regions__port_sign(const Regions *g, uint32_t port)
{
  return regions__side_sign(g->port.data[port].side);
}
static inline int regions__sign(const Regions *g, uint32_t port)
{
  return regions__port_sign(g, port) * regions__of(g, port)->sign;
}

static inline int64_t regions__dual(const Regions *g, uint32_t port)
{
  const Region *r = regions__of(g, port);
  return g->port.data[port].pot + regions__port_sign(g, port) * (r->shift + r->sign * g->f->now);
}

static inline int64_t regions__slack(const Regions *g, const PortArc *a)
{
  return g->f->scale * (int64_t)a->cost - regions__dual(g, a->tail) - regions__dual(g, a->head);
}

static inline void regions__set_sign(const Regions *g, Region *r, int s)
{
  r->shift += (r->sign - s) * g->f->now;
  r->sign = s;
}

// The graph of the regions that t has, `nregion` of them, with the duals of f; release with regions__finish. O(arcs).
void regions__init(Regions *g, Frac *f, Tight *t, uint32_t nregion);
// Give duals to the vertices of f, and release g.
void regions__finish(Regions *g);
// The ends of a tight arc between regions that are idle are matched, and a region by themselves. Whoever was
// matched to them stays behind, free.
void regions__pair_up(Regions *g, uint32_t arc);
// The odd cycle through the vertex w is opened there; its other vertices are pairs.
void regions__open_cycle(Regions *g, uint32_t w);

#endif
