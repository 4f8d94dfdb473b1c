// predicates_int.h - what predicates.c and predicates_mp.c share
// SPDX-License-Identifier: MIT
#ifndef GEOM_PREDICATES_INT_H
#define GEOM_PREDICATES_INT_H

#include "base/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// Sign of (q0 - q1)(q2 - q3) - (q4 - q5)(q6 - q7) by MPFR.
int predicates__products_mp(const double *q);

#ifdef __cplusplus
}
#endif

#endif
