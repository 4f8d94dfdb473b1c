// fold.c - folding of constant expressions
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/fold.h"

#include "script/function.h"

static bool constant_value(const Node *n, double *v)
{
  double a = n->n > 0 ? n->kid[0]->number : 0, b = n->n > 1 ? n->kid[1]->number : 0;
  switch ((NodeKind)n->kind) {
  case NODE_UNARY: *v = n->op == '!' ? !a : -a; return true;
  case NODE_BINARY:
    if ((n->op == '/' && b == 0) || (n->op == '%' && number_to_int(b) == 0)) return false;
    *v = number_binary(n->op, a, b);
    return true;
  case NODE_TERNARY: *v = a != 0 ? b : n->kid[2]->number; return true;
  case NODE_CALL: {
    const FunctionRow *f = function_at(n->op);
    if (f->f1) *v = f->f1(a);
    if (f->f2) *v = f->f2(a, b);
    return f->f1 || f->f2;
  }
  default: return false;
  }
}

Node *fold_constant(Parser *p, Node *n)
{
  (void)p;
  for (uint32_t i = 0; i < n->n; i++)
    if (n->kid[i]->kind != NODE_NUMBER) return n;
  double v;
  if (!n->n || !constant_value(n, &v)) return n;
  n->kind = NODE_NUMBER;
  n->n = 0;
  n->height = 0;
  n->number = v;
  return n;
}
