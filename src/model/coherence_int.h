// coherence_int.h - what the files that merge equal entities share
// SPDX-License-Identifier: MIT
#ifndef MODEL_COHERENCE_INT_H
#define MODEL_COHERENCE_INT_H

#include "model/model_int.h"

// `gone` is now the signed tag `stays`.
void coherence__record(Merged *g, int dim, int gone, int stays);
void coherence__replace(const Merged *g, int dim, int *tag, size_t n); // n signed tags by those that stay
void coherence__groups_follow(Model *m, int dim, const Merged *g);
void coherence__sort_unique(IntVec *v); // ascending, each once
int coherence__by_value(const void *a, const void *b); // of ints, for qsort
void coherence__recount(Model *m, Kind k); // numbers of what was merged are free again, but with OldNewReg = 0

// Find what is equal among what changed (m->dirty), and have all that names it follow. Points first, then curves, then faces.
void coherence__points(Model *m, Merged *g);
void coherence__faces(Model *m, Merged *g);

#endif
