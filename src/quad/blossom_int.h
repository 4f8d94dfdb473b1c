// blossom_int.h - the search structures of the matching solver, shared by its files
// SPDX-License-Identifier: MIT
#ifndef QUAD_BLOSSOM_INT_H
#define QUAD_BLOSSOM_INT_H

#include "base/base.h"
#include "base/mem.h"
#include "quad/blossom.h"

// Directed half of an edge; `rev` is the other half.
typedef struct {
  uint32_t head, tail, rev;
  int32_t cost;
} BlossomArc;

// A top-level node (a vertex or blossom inside no blossom) is outer (+) or inner (-) in a tree, or idle.
typedef enum { INNER = -1, IDLE = 0, OUTER = 1 } BlossomSign;

// Fields of a vertex, and, where the vertex is the label of a top-level node, of that node. Every vertex knows the label of
// the top-level node that holds it; shrinking keeps the label of the largest part, so that few vertices are renamed.
// The potential of v (its dual plus those of the blossoms that hold it) is
//   v.pot + l.off + l.sign * clock(l.tree)      with l the label of v.
// When a tree dies its clock stops: all its nodes are idle at once, and nobody has to visit them.
typedef struct {
  int64_t pot;
  int64_t off;
  uint32_t label;
  uint32_t tree;       // label
  int32_t sign;        // label: BlossomSign; means IDLE when the tree is dead
  uint32_t match;      // label: matched arc, from inside to outside; NONE for a free node
  uint32_t pred;       // label, inner: arc from inside to the outer node above it
  uint32_t node;       // label: the top-level node
  uint32_t start;      // first of its arcs
  uint32_t next;       // in the list of vertices of its blossom
  uint32_t mark;       // label: stamp of the search for a common ancestor
} BlossomVertex;

// A vertex (0 .. n-1) or a blossom (n ..) as a part of a blossom.
typedef struct {
  uint32_t sib;        // next part around the odd cycle
  uint32_t sib_prev;
  uint32_t sib_arc;    // arc from inside this part to the next
  uint32_t first, last;// its vertices: a stretch of a linked list
  uint32_t size;
  uint32_t label;      // of its vertices when it is top-level
  uint32_t child;      // blossom: one of the parts; unused blossom: the next unused one
  int64_t z;           // blossom: its dual when not top-level; when top-level, potential of the label - dual
} BlossomNode;

// A growing tree's duals change as time passes; a sleeping one's do not; a dead one is no tree any more.
typedef enum { GROWING, ASLEEP, DEAD } BlossomLife;

typedef struct {
  int64_t clock;       // growing: minus the time at which its clock would have shown 0; else what its clock shows
  uint32_t life;
  uint32_t volume;     // vertices taken in during this round
  uint32_t root;       // a vertex of the free node
  uint32_t contact;    // list of arcs from outer nodes of other trees to inner nodes of this one
} BlossomTree;

typedef struct {
  uint32_t arc, next;
} BlossomContact;

typedef struct {
  int64_t key;
  uint32_t what;       // arc, or narc + blossom whose dual runs out
} BlossomEvent;

typedef Vec(BlossomEvent) BlossomEvents;

// Monotone queue of events by time, first in first out among equals [Ahuja1990]: bucket b holds the keys that differ from
// the last one taken in bit b-1 at the highest.
typedef struct {
  int64_t last;
  size_t read;         // position in bucket 0
  uint64_t filled;     // bit b: bucket b+1 holds something
  BlossomEvents bucket[65];
} BlossomQueue;

typedef struct {
  const BlossomGraph *g;
  uint32_t n, narc;
  int64_t now;
  BlossomArc *arc;
  BlossomVertex *v;    // n + 1; v[n].start ends the arcs of the last vertex
  BlossomNode *node;
  size_t nnode, node_cap;
  uint32_t free_node;  // list of blossoms to be used again
  BlossomTree *tree;   // [0]: the tree of what never was in a tree; dead
  size_t ntrees, tree_cap;
  uint32_t ntree;      // trees alive
  uint32_t nawake;     // of them growing
  uint32_t cap;        // volume at which a tree falls asleep
  int64_t scale;       // unit of the duals over that of the costs
  int64_t unit;        // trees start, meet and fall asleep at multiples of this in the present round
  Vec(BlossomContact) contact;
  uint32_t free_contact;
  uint32_t stamp;
  U32Vec up_u, up_v;   // scratch: paths of a cycle
  U32Vec fresh;        // scratch: nodes whose edges are to be looked at
  BlossomQueue queue;
  BlossomStats stats;
  uint32_t *arc_edge;  // edge of each arc
} Blossom;

// Nearest common ancestor of x and y in one tree, in which above(ctx, x) is what x hangs on, NONE at the root. O(depth).
static inline uint32_t blossom__common_ancestor(const void *ctx, uint32_t (*above)(const void *ctx, uint32_t x), uint32_t x, uint32_t y)
{
  int64_t deeper = 0; // is x than y
  for (uint32_t k = above(ctx, x); k != NONE; k = above(ctx, k)) deeper++;
  for (uint32_t k = above(ctx, y); k != NONE; k = above(ctx, k)) deeper--;
  for (; deeper > 0; deeper--) x = above(ctx, x);
  for (; deeper < 0; deeper++) y = above(ctx, y);
  for (; x != y; x = above(ctx, x)) y = above(ctx, y);
  return x;
}

static inline int64_t blossom__clock(const Blossom *b, uint32_t tree)
{
  return b->tree[tree].clock + (b->tree[tree].life == GROWING ? b->now : 0);
}
static inline uint32_t blossom__top(const Blossom *b, uint32_t v) { return b->v[b->v[v].label].node; }
static inline BlossomSign blossom__sign(const Blossom *b, const BlossomVertex *label)
{
  return b->tree[label->tree].life == DEAD ? IDLE : (BlossomSign)label->sign;
}
static inline int64_t blossom__level(const Blossom *b, const BlossomVertex *label)
{
  return label->off + label->sign * blossom__clock(b, label->tree);
}
static inline int64_t blossom__pot(const Blossom *b, uint32_t v)
{
  return b->v[v].pot + blossom__level(b, &b->v[b->v[v].label]);
}
// Slack of an arc between different top-level nodes, in units of 1/scale as all duals.
static inline int64_t blossom__slack(const Blossom *b, const BlossomArc *a)
{
  return b->scale * (int64_t)a->cost - blossom__pot(b, a->tail) - blossom__pot(b, a->head);
}

void blossom__push(BlossomQueue *q, int64_t key, uint32_t what);
bool blossom__pop(BlossomQueue *q, BlossomEvent *e);
void blossom__drop(BlossomQueue *q); // all events

// From a matching over tight edges, and duals that are multiples of scale / 2, to an optimal fractional matching; one vertex of
// each odd cycle is left free.
void blossom__fractional_start(Blossom *b);

void blossom__plant(Blossom *b, uint32_t v);        // the free node that holds v becomes a sleeping tree
void blossom__wake(Blossom *b);                     // begin a round: all trees grow, from their free nodes
void blossom__arc_event(Blossom *b, uint32_t a);
void blossom__inner_event(Blossom *b, uint32_t x);
// Dissolve a top-level blossom into its parts with the matching of its cycle; labels and matches only.
void blossom__open(Blossom *b, uint32_t blossom);

#endif
