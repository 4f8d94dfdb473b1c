// quad_patch.h - changing a quad mesh in a few elements at a time, with a judgement on each change
// SPDX-License-Identifier: MIT
#ifndef QUAD_QUAD_PATCH_H
#define QUAD_QUAD_PATCH_H

#include "base/map.h"
#include "quad/quad_int.h"

// A mesh under change. Dead elements have NONE as first corner until quad__edit_end compacts the mesh.
typedef struct {
  QuadMesh *m;
  U32Vec start, pool;     // elements around v: pool[start[v] .. start[v] + count[v]), room for room[v]
  Vec(uint8_t) count, room;
  Vec(uint8_t) boundary;  // by vertex
  Vec(uint8_t) ideal;     // by vertex: regular number of elements: 4 inside, on the boundary what the angle calls for
  Map locked;             // edges that must stay
  U32Vec dead;            // elements to use again
  U32Vec queue;           // vertices around which something has changed
  Vec(uint8_t) queued;
  double floor;           // skew that elements may get to the gain of others
} QuadEdit;

// Begin to change m, which must not be changed otherwise until the end; O(n).
void quad__edit_begin(QuadEdit *d, QuadMesh *m);
void quad__edit_end(QuadEdit *d);
// A new vertex as of quad__add_vertex, with no elements yet; the last one added is dropped again.
uint32_t quad__edit_add_vertex(QuadEdit *d, Vec2 p, const uint32_t *around, uint32_t n);
void quad__edit_drop_vertex(QuadEdit *d);
// A dead element.
uint32_t quad__edit_add_element(QuadEdit *d);
static inline uint32_t quad__count(const QuadEdit *d, uint32_t v) { return d->count.data[v]; }
static inline const uint32_t *quad__around(const QuadEdit *d, uint32_t v) { return d->pool.data + d->start.data[v]; }
// Put v at the end of the queue, unless it is there.
void quad__enqueue(QuadEdit *d, uint32_t v);
// The other element at the edge ab of element e; NONE on the boundary.
uint32_t quad__across(const QuadEdit *d, uint32_t e, uint32_t a, uint32_t b);
bool quad__is_locked(const QuadEdit *d, uint32_t a, uint32_t b);
// True if x is joined to y by an edge.
bool quad__joined(const QuadEdit *d, uint32_t x, uint32_t y);
// n elements are to have the corners corner[4n], NONE first: none. Has every vertex room for the elements it is to have?
bool quad__has_room(QuadEdit *d, const uint32_t *element, const uint32_t *corner, size_t n);
// Make them so, and enqueue all vertices of them, whatever that is worth.
void quad__replace(QuadEdit *d, const uint32_t *element, const uint32_t *corner, size_t n);

// Skew of elements that must change, a shape of 0.3.
#define PATCH_BAD 0.794

enum { PATCH_ELEMENTS = 64, PATCH_CORE = 8 };

// The elements around some vertices (the core), before and after.
typedef struct {
  uint32_t element[PATCH_ELEMENTS];
  uint32_t corner[4 * PATCH_ELEMENTS]; // as they are to be; NONE first: removed
  size_t n;
  uint32_t core[PATCH_CORE];           // vertices that may look for better places
  size_t ncore;
  Vec2 old[PATCH_CORE];
  QuadScore before;
  int gain;                            // what the numbers of elements around vertices gain, in squares of their differences
} QuadPatch;

// All elements around the core. False if there are too many.
bool quad__patch_begin(const QuadEdit *d, QuadPatch *p, const uint32_t *core, size_t ncore);
// Where the corners of element e of the patch are written.
uint32_t *quad__patch_element(QuadPatch *p, uint32_t e);
void quad__patch_replace(QuadPatch *p, uint32_t from, uint32_t to);
// Would quad__patch_end give up at once, as n elements was[4n] become is[4n] and no others change?
bool quad__is_hopeless(const QuadEdit *d, const uint32_t *was, const uint32_t *is, size_t n, int gain);
// Let the core find better places, then keep the new elements if they are better by valences and energy, and none is worse than the worst
// was or than the floor; or if the worst was bad and has got better. Else take everything back. True if kept.
bool quad__patch_end(QuadEdit *d, QuadPatch *p);

#endif
