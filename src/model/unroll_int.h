// unroll_int.h - what the files that write a model as plain .geo share
// SPDX-License-Identifier: MIT
#ifndef MODEL_UNROLL_INT_H
#define MODEL_UNROLL_INT_H

#include "base/file.h"
#include "model/model_int.h"

// Plain .geo has arcs below pi only, through points: OpenCASCADE's arcs get a centre (and an axis point), and those of pi or more
// become several curves, with tags beyond all others.
typedef struct {
  Writer *w;
  const Model *m;
  Map part;        // curve tag -> index of its parts in `tag`, -1 at their end
  IntVec tag;
  int point, next; // last tags given out
} Unroll;

void unroll__ints(Writer *w, const int *v, size_t n); // `{a, b, c}`, broken over lines
void unroll__doubles(Writer *w, const double *v, size_t n);
void unroll__curve_list(Unroll *r, const int *v, size_t n); // with the parts in the place of what was cut

void unroll__mesh(Unroll *r); // how to mesh curves and faces
#endif
