// mathexpr_int.h - what the compiler of expressions hands to their interpreter
// SPDX-License-Identifier: MIT
#ifndef SIZE_MATHEXPR_INT_H
#define SIZE_MATHEXPR_INT_H

#include "size/mathexpr.h"

#include <math.h>

#include "base/mem.h"
#include "size/trig.h"

typedef enum {
  OP_CONST, OP_INPUT, // x, y, z are inputs 0, 1, 2; fields follow
  OP_ADD, OP_SUB, OP_MUL, OP_DIV, OP_POW, OP_MOD, OP_LT, OP_GT, OP_LE, OP_GE, OP_EQ, OP_NE, OP_AND, OP_OR, OP_MIN, OP_MAX,
  OP_ATAN2, OP_HYPOT,
  OP_NEG, OP_ABS, OP_ACOS, OP_ASIN, OP_ATAN, OP_COS, OP_COSH, OP_DEG, OP_EXP, OP_FAC, OP_LOG, OP_LOG10, OP_RAD, OP_ROUND,
  OP_SIGN, OP_SIN, OP_SINH, OP_SQRT, OP_STEP, OP_TAN, OP_TANH, OP_ATANH, OP_TRUNC, OP_FLOOR, OP_CEIL, OP_RAND,
} Op;

typedef struct {
  Op op;
  uint32_t to, a, b; // operand places: inputs first, then registers
} Instr;

struct Expr {
  Vec(Instr) code;
  DoubleVec number; // constants: the first registers
  IntVec field;
  uint32_t nreg;
  uint32_t result; // operand place
  bool constant, minus_power;
  double value;
};

static inline bool expr_is_binary(Op op)
{
  return op >= OP_ADD && op <= OP_HYPOT;
}

static inline double expr_factorial(double v)
{
  double f = 1;
  for (int i = 2; i <= v && i <= 170; i++) f *= i;
  return v > 170 ? INFINITY : f;
}

static inline double expr_apply2(Op op, double a, double b)
{
  switch (op) {
  case OP_ADD: return a + b;
  case OP_SUB: return a - b;
  case OP_MUL: return a * b;
  case OP_DIV: return a / b;
  case OP_POW: return pow(a, b);
  case OP_MOD: return fmod(a, b);
  case OP_LT: return a < b;
  case OP_GT: return a > b;
  case OP_LE: return a <= b;
  case OP_GE: return a >= b;
  case OP_EQ: return a == b;
  case OP_NE: return a != b;
  case OP_AND: return a != 0 && b != 0;
  case OP_OR: return a != 0 || b != 0;
  case OP_MIN: return a < b ? a : b;
  case OP_MAX: return a > b ? a : b;
  case OP_ATAN2: return atan2(a, b);
  case OP_HYPOT: return hypot(a, b);
  default: UNREACHABLE();
  }
}

static inline double expr_apply1(Op op, double v)
{
  switch (op) {
  case OP_NEG: return -v;
  case OP_ABS: return fabs(v);
  case OP_ACOS: return acos(v);
  case OP_ASIN: return asin(v);
  case OP_ATAN: return atan(v);
  case OP_COS: return trig_cos(v);
  case OP_COSH: return cosh(v);
  case OP_DEG: return v * 180 / M_PI;
  case OP_EXP: return exp(v);
  case OP_FAC: return expr_factorial(v);
  case OP_LOG: return log(v);
  case OP_LOG10: return log10(v);
  case OP_RAD: return v * M_PI / 180;
  case OP_ROUND: return trunc(v + 0.5);
  case OP_SIGN: return v < 0 ? -1 : 1;
  case OP_SIN: return trig_sin(v);
  case OP_SINH: return sinh(v);
  case OP_SQRT: return sqrt(v);
  case OP_STEP: return v < 0 ? 0 : 1;
  case OP_TAN: return tan(v);
  case OP_TANH: return tanh(v);
  case OP_ATANH: return atanh(v);
  case OP_TRUNC: return trunc(v);
  case OP_FLOOR: return floor(v);
  case OP_CEIL: return ceil(v);
  default: UNREACHABLE();
  }
}

#endif
