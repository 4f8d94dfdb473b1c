// fold.h - arithmetic of the language, and the folding of constant expressions
// SPDX-License-Identifier: MIT
#ifndef SCRIPT_FOLD_H
#define SCRIPT_FOLD_H

#include <math.h>

#include "script/parse.h"

// Truncated toward zero and clamped to the range of int; NaN gives 0.
static inline int number_to_int(double v)
{
  return v >= 2147483647.0 ? 2147483647 : v <= -2147483648.0 ? -2147483647 - 1 : v == v ? (int)v : 0;
}

// a op b for every operator but those that can fail: '/' and '%' want b (truncated, for '%') not 0.
static inline double number_binary(int op, double a, double b)
{
  switch (op) {
  case '+': return a + b;
  case '-': return a - b;
  case '*': return a * b;
  case '/': return a / b;
  case '^': return pow(a, b);
  case '%': return number_to_int(b) == -1 ? 0 : number_to_int(a) % number_to_int(b);
  case '|': return number_to_int(a) | number_to_int(b);
  case '&': return number_to_int(a) & number_to_int(b);
  case TOK_SHIFT_LEFT: return (int)((unsigned)number_to_int(a) << (number_to_int(b) & 31));
  case TOK_SHIFT_RIGHT: return number_to_int(a) >> (number_to_int(b) & 31);
  case '<': return a < b;
  case '>': return a > b;
  case TOK_LE: return a <= b;
  case TOK_GE: return a >= b;
  case TOK_EQ: return a == b;
  case TOK_NE: return a != b;
  case TOK_AND: return a != 0 && b != 0;
  case TOK_OR: return a != 0 || b != 0;
  default: UNREACHABLE();
  }
}

// n, or a NUMBER in its place if n is an operation on numbers alone that cannot fail.
Node *fold_constant(Parser *p, Node *n);

#endif
