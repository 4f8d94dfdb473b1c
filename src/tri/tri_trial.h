// tri_trial.h - a change about one edge that can be undone: what rework and polish try before they keep it
// SPDX-License-Identifier: MIT
//
// A trial may change the triangles about the four vertices of an edge and nothing else. These are saved before, so that whatever was
// done is undone by putting the records back.
#ifndef TRI_TRI_TRIAL_H
#define TRI_TRI_TRIAL_H

#include "base/base.h"
#include "tri/refine_int.h"

enum { TRIAL_PATCH = 96 }; // triangles of a patch at most

typedef struct {
  TriId t;
  uint32_t vert[3], twin[3], seg[3], region;
  uint8_t flag;
} SavedTriangle;

typedef struct {
  VertId v;
  double xy[2], size, carried;
  EdgeId hint;
  int16_t excess;
  bool fixed;
} SavedVertex;

typedef struct {
  Refiner *r;
  VertId core[5]; // vertices that may move
  int ncore;
  int npatch, ntri;  // the first npatch triangles are the patch, then come its neighbours and the next free ones
  int nvert;
  SavedTriangle tri[3 * TRIAL_PATCH + 4];
  SavedVertex vertex[3 * TRIAL_PATCH];
  uint32_t nt, nv, nfree;
  TriId free_list;
  EdgeId last;
  TriRefineStats stats;
} Trial;

typedef enum { TRIAL_SETTLE, TRIAL_FLIP, TRIAL_COLLAPSE, TRIAL_COLLAPSE_BACK, TRIAL_SPLIT, TRIAL_COUNT } TrialOperation;

// Save the patch about edge e, whose four vertices become the core. False if it is too large; nothing is to be restored then.
// Takes hints. About 1 us.
bool refine__trial_save(Trial *s, Refiner *r, EdgeId e);
// As it was when it was saved.
void refine__trial_restore(Trial *s);
// The triangles of the patch as it is now into out[TRIAL_PATCH + 8]. Returns how many.
int refine__trial_patch(const Trial *s, TriId *out);
// The operation on the saved edge e, with nothing moved; a split adds its vertex to the core. False, and nothing changed, if it cannot be.
bool refine__trial_apply(Trial *s, EdgeId e, TrialOperation op);
// Flip inside the patch what makes the worse of two triangles better.
void refine__trial_flips(Trial *s);

#endif
