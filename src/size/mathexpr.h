// mathexpr.h - expressions of x, y, z and of other fields, compiled once and evaluated for many places at a time
// SPDX-License-Identifier: MIT
#ifndef SIZE_MATHEXPR_H
#define SIZE_MATHEXPR_H

#include "base/base.h"
#include "base/str.h"

typedef struct Expr Expr;

// Compile `text`; NULL with a message in *error and the column (from 1) of the mistake in *column. Operators by falling
// binding: ^ (right to left), unary -, * / %, + -, < > <= >= == !=, &&, ||. Equal subexpressions are computed once, constant ones
// never. Free with expr_free.
Expr *expr_compile(const char *text, Str *error, int *column);
void expr_free(Expr *e); // NULL is fine

// The fields F<n> it mentions, each once, in the order of their first mention.
size_t expr_fields(const Expr *e, const int **id);
// True if it is the same everywhere.
bool expr_constant(const Expr *e, double *value);
// True if a minus stands before a power, as in -x^2: that is -(x^2) here, as in mathematics, and (-x)^2 in Gmsh.
bool expr_minus_power(const Expr *e);
// Doubles of scratch for expr_eval of n places.
size_t expr_scratch(const Expr *e, size_t n);
size_t expr_length(const Expr *e); // instructions

// out[i] for n places; field[k] are the n values of the k-th field. out may not overlap the inputs.
void expr_eval(const Expr *e, const double *x, const double *y, const double *z, const double *const *field, size_t n,
               double *scratch, double *out);

#endif
