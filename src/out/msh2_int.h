// msh2_int.h - how MSH 2 lists the elements of a block, in parts or not
// SPDX-License-Identifier: MIT
#ifndef OUT_MSH2_INT_H
#define OUT_MSH2_INT_H

#include "out/out_int.h"

// Elements of one block as this version lists them.
typedef struct {
  const MeshBlock *block;
  const MeshEntity *entity;
  int copies;   // how often each element is written
  bool grouped; // physical tags are written
  uint8_t reversed[ELEM_MAX_NODES];
  int nodes;
} Run;

static inline int physical_of(const Run *r, int copy)
{
  return r->grouped ? r->entity->physical.data[copy] : 0;
}

// The elements of a mesh in parts, numbered from `number` on (msh2_part.c).
void msh2_part__write_run(Writer *w, const Selection *s, const Run *r, uint64_t number, bool binary);

#endif
