// field_math.c - fields by expressions: MathEval, MathEvalAniso, Param
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "size/mathexpr.h"
#include "size/size_int.h"

enum { MOST_EXPRS = 6 };

typedef struct {
  Expr *e[MOST_EXPRS];
  uint32_t first[MOST_EXPRS]; // index in node.in of each one's first field
} Exprs;

// The expression of an option, and its fields as inputs; false after an error.
static bool take(SizeField *s, Node *n, int i, const char *option, Diag *diag)
{
  Exprs *d = n->data;
  const FieldValue *v = field__value(n->field, option);
  Str error = {0};
  int column;
  d->e[i] = expr_compile(v->text, &error, &column);
  d->first[i] = n->nin;
  if (!d->e[i])
    diag_error(diag, v->loc, "field %d (%s): option %s = \"%.200s\": %s (at character %d)", n->field->id,
               field__type(n->field->kind)->name, option, v->text, str_text(&error), column);
  else if (expr_minus_power(d->e[i]))
    diag_warning(diag, v->loc, "field %d (%s): in %s = \"%s\" the power comes before the minus, -x^2 is -(x^2); Gmsh reads (-x)^2: write parentheses",
                 n->field->id, field__type(n->field->kind)->name, option, v->text);
  str_free(&error);
  const int *id;
  size_t count = d->e[i] ? expr_fields(d->e[i], &id) : 0;
  for (size_t k = 0; k < count; k++)
    if (!size__refer(s, n, id[k], v->loc, diag)) return false;
  return d->e[i] != NULL;
}

// Values of the i-th expression.
static void values(SizeEval *e, const Node *n, int i, Where w, const Places *p, size_t count, double *out)
{
  const Exprs *d = n->data;
  const int *id;
  size_t fields = expr_fields(d->e[i], &id), mark = size__mark(e);
  double *buffer = size__scratch(e, fields * count + expr_scratch(d->e[i], count));
  enum { MOST_DIRECT = 16 };
  const double *direct[MOST_DIRECT], **in = direct;
  if (fields > MOST_DIRECT) in = mem_alloc(fields * sizeof *in);
  for (size_t k = 0; k < fields; k++) {
    size__eval(e, n->in[d->first[i] + k], w, p, count, buffer + k * count);
    in[k] = buffer + k * count;
  }
  expr_eval(d->e[i], p->x, p->y, p->z, in, count, buffer + fields * count, out);
  if (in != direct) free(in);
  size__release(e, mark);
}

static void release(Node *n)
{
  Exprs *d = n->data;
  for (int i = 0; d && i < MOST_EXPRS; i++) expr_free(d->e[i]);
}

// ---- MathEval -----------------------------------------------------------------------------------------------------------

static bool build_math(SizeField *s, Node *n, Diag *diag)
{
  n->data = mem_zalloc(sizeof(Exprs));
  return take(s, n, 0, "F", diag);
}

static void eval_math(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  values(e, n, 0, w, p, count, out);
}

static bool constant_math(const SizeField *s, const Node *n, Where w, double *value)
{
  (void)s, (void)w;
  const Exprs *d = n->data;
  return expr_constant(d->e[0], value);
}

const FieldOps ops_math = {build_math, eval_math, release, constant_math};

// ---- MathEvalAniso: of the metric the smallest size, 1/sqrt of its largest eigenvalue -------------------------------------

static bool build_metric(SizeField *s, Node *n, Diag *diag)
{
  static const char *const option[MOST_EXPRS] = {"M11", "M12", "M13", "M22", "M23", "M33"};
  n->data = mem_zalloc(sizeof(Exprs));
  for (int i = 0; i < MOST_EXPRS; i++)
    if (!take(s, n, i, option[i], diag)) return false;
  return true;
}

static void eval_metric(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  double m[MOST_EXPRS][BATCH];
  for (int i = 0; i < MOST_EXPRS; i++) values(e, n, i, w, p, count, m[i]);
  for (size_t i = 0; i < count; i++) {
    double l = size__largest_eigenvalue((double[6]){m[0][i], m[1][i], m[2][i], m[3][i], m[4][i], m[5][i]}, false);
    out[i] = 1 / sqrt(l);
  }
}

const FieldOps ops_metric = {build_metric, eval_metric, release, NULL};

// ---- Param: another place's value -------------------------------------------------------------------------------------------

static bool build_param(SizeField *s, Node *n, Diag *diag)
{
  static const char *const option[3] = {"FX", "FY", "FZ"};
  n->data = mem_zalloc(sizeof(Exprs));
  const FieldValue *in = field__value(n->field, "InField");
  if (!size__refer(s, n, (int)in->number, in->loc, diag)) return false;
  for (int i = 0; i < 3; i++)
    if (*field__value(n->field, option[i])->text && !take(s, n, i, option[i], diag)) return false;
  return true;
}

static void eval_param(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  const Exprs *d = n->data;
  const double *from[3] = {p->x, p->y, p->z};
  size_t mark = size__mark(e);
  double *moved = size__scratch(e, 3 * count);
  for (int i = 0; i < 3; i++) {
    if (d->e[i]) values(e, n, i, w, p, count, moved + (size_t)i * count);
    else memcpy(moved + (size_t)i * count, from[i], count * sizeof *moved);
  }
  Places q = {moved, moved + count, moved + 2 * count, ++e->serial};
  size__eval(e, n->in[0], w, &q, count, out);
  size__release(e, mark);
}

const FieldOps ops_param = {build_param, eval_param, release, NULL};
