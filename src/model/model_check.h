// model_check.h - the invariants of a model, for tests
// SPDX-License-Identifier: MIT
#ifndef MODEL_MODEL_CHECK_H
#define MODEL_MODEL_CHECK_H

#include "base/str.h"
#include "model/model.h"

// Are all references alive, the counts of uses right, the tables in order, the sorted loops head to tail, the maxima not below any
// tag? coherent: and no two points coincide within tolerance of the extent, no two curves have the same control points, which
// holds right after model_coherence (quadratic: for small models). Appends a line to `why` for each violation, up to ten.
bool model_check(const Model *m, bool coherent, Str *why);

#endif
