// mathexpr_eval.c - an interpreter of expressions over arrays
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "size/mathexpr_int.h"

// A number in [0,1) that only depends on the place.
static double scatter(double x, double y, double z)
{
  uint64_t h = 0x9e3779b97f4a7c15u, bits;
  double v[3] = {x, y, z};
  for (int i = 0; i < 3; i++) {
    memcpy(&bits, &v[i], sizeof bits);
    h = (h ^ bits) * 0xbf58476d1ce4e5b9u;
    h ^= h >> 29;
  }
  return (double)(h >> 11) * 0x1p-53;
}

// One loop per operation: the switch is outside of it.
#define LOOP1(OP) \
  case OP: \
    for (size_t i = 0; i < n; i++) to[i] = expr_apply1(OP, a[i]); \
    break;
#define LOOP2(OP) \
  case OP: \
    for (size_t i = 0; i < n; i++) to[i] = expr_apply2(OP, a[i], b[i]); \
    break;

static void run(const Instr *in, const double *a, const double *b, const double *const place[3], size_t n, double *to)
{
  switch (in->op) {
  case OP_CONST:
  case OP_INPUT: break;
  case OP_RAND:
    for (size_t i = 0; i < n; i++) to[i] = a[i] * scatter(place[0][i], place[1][i], place[2][i]);
    break;
  case OP_SIN: trig_batch(a, n, 0, to); break;
  case OP_COS: trig_batch(a, n, 1, to); break;
  LOOP2(OP_ADD) LOOP2(OP_SUB) LOOP2(OP_MUL) LOOP2(OP_DIV) LOOP2(OP_POW) LOOP2(OP_MOD) LOOP2(OP_LT) LOOP2(OP_GT)
  LOOP2(OP_LE) LOOP2(OP_GE) LOOP2(OP_EQ) LOOP2(OP_NE) LOOP2(OP_AND) LOOP2(OP_OR) LOOP2(OP_MIN) LOOP2(OP_MAX)
  LOOP2(OP_ATAN2) LOOP2(OP_HYPOT)
  LOOP1(OP_NEG) LOOP1(OP_ABS) LOOP1(OP_ACOS) LOOP1(OP_ASIN) LOOP1(OP_ATAN) LOOP1(OP_COSH) LOOP1(OP_DEG)
  LOOP1(OP_EXP) LOOP1(OP_FAC) LOOP1(OP_LOG) LOOP1(OP_LOG10) LOOP1(OP_RAD) LOOP1(OP_ROUND) LOOP1(OP_SIGN)
  LOOP1(OP_SINH) LOOP1(OP_SQRT) LOOP1(OP_STEP) LOOP1(OP_TAN) LOOP1(OP_TANH) LOOP1(OP_ATANH) LOOP1(OP_TRUNC)
  LOOP1(OP_FLOOR) LOOP1(OP_CEIL)
  }
}

enum { MOST_PLACES = 64 };

// At one place: values in one small array, no loops within instructions.
static double evaluate_one(const Expr *e, const double *place, const double *const *field)
{
  double v[MOST_PLACES];
  size_t n = 3;
  memcpy(v, place, 3 * sizeof *v);
  for (size_t k = 0; k < e->field.len; k++) v[n++] = *field[k];
  for (size_t k = 0; k < e->number.len; k++) v[n++] = e->number.data[k];
  for (const Instr *in = e->code.data, *end = in + e->code.len; in < end; in++)
    v[in->to] = in->op == OP_RAND   ? v[in->a] * scatter(v[0], v[1], v[2])
                : expr_is_binary(in->op) ? expr_apply2(in->op, v[in->a], v[in->b])
                                    : expr_apply1(in->op, v[in->a]);
  return v[e->result];
}

void expr_eval(const Expr *e, const double *x, const double *y, const double *z, const double *const *field, size_t n,
               double *scratch, double *out)
{
  const double *place[3] = {x, y, z};
  uint32_t ninput = (uint32_t)(3 + e->field.len);
  if (n == 1 && ninput + e->nreg <= MOST_PLACES) {
    *out = evaluate_one(e, (double[3]){*x, *y, *z}, field);
    return;
  }
#define OPERAND(k) ((k) < 3 ? place[k] : (k) < ninput ? field[(k) - 3] : scratch + (size_t)((k) - ninput) * n)
  for (size_t k = 0; k < e->number.len; k++)
    for (size_t i = 0; i < n; i++) scratch[k * n + i] = e->number.data[k];
  for (size_t i = 0; i < e->code.len; i++) {
    const Instr *in = &e->code.data[i];
    run(in, OPERAND(in->a), OPERAND(in->b), place, n, scratch + (size_t)(in->to - ninput) * n);
  }
  memcpy(out, OPERAND(e->result), n * sizeof *out);
#undef OPERAND
}
