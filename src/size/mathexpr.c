// mathexpr.c - a parser that emits shared, folded nodes; a register allocator
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "size/mathexpr_int.h"

#include <ctype.h>
#include <strings.h>

#include "base/map.h"
#include "base/number.h"

typedef struct {
  Op op;
  uint32_t a, b; // nodes; of OP_INPUT a is the input
  double value;
} ExprNode;

// ---- nodes ----------------------------------------------------------------------------------------------------------------

typedef struct {
  const char *s, *end, *text;
  Vec(ExprNode) node;
  Map seen;
  IntVec field;
  Str *error;
  int column, depth;
  bool failed;
  bool power, minus_power; // the last operand is a power; a minus stands before one
} Builder;

enum { MAX_NODES = 100000, MAX_NESTING = 200 };

static uint32_t fail_at(Builder *b, const char *at, const char *what)
{
  if (b->failed) return 0;
  b->failed = true;
  b->column = (int)(at - b->text) + 1;
  str_printf(b->error, "%s", what);
  return 0;
}

static uint32_t constant(Builder *b, double v)
{
  for (uint32_t i = 0; i < b->node.len && b->node.len < 1000; i++)
    if (b->node.data[i].op == OP_CONST && !memcmp(&b->node.data[i].value, &v, sizeof v)) return i;
  vec_push(&b->node, ((ExprNode){OP_CONST, 0, 0, v}));
  return (uint32_t)b->node.len - 1;
}

static uint32_t shared_node(Builder *b, Op op, uint32_t x, uint32_t y)
{
  bool fresh;
  uint32_t *k = map_slot(&b->seen, (uint64_t)op << 48 | (uint64_t)x << 24 | y, (uint32_t)b->node.len, &fresh);
  if (!fresh) return *k;
  if (b->node.len >= MAX_NODES) return fail_at(b, b->s, "the expression is too long");
  vec_push(&b->node, ((ExprNode){op, x, y, 0}));
  return (uint32_t)b->node.len - 1;
}

static bool is_const(const Builder *b, uint32_t k, double *v)
{
  *v = b->node.data[k].value;
  return b->node.data[k].op == OP_CONST;
}

static uint32_t emit1(Builder *b, Op op, uint32_t x)
{
  double v;
  if (b->failed) return 0;
  if (op != OP_RAND && is_const(b, x, &v)) return constant(b, expr_apply1(op, v));
  return shared_node(b, op, x, 0);
}

static uint32_t emit2(Builder *b, Op op, uint32_t x, uint32_t y)
{
  double v, w;
  if (b->failed) return 0;
  bool cx = is_const(b, x, &v), cy = is_const(b, y, &w);
  if (cx && cy) return constant(b, expr_apply2(op, v, w));
  if (op == OP_POW && cy && w == 1) return x;
  if (op == OP_POW && cy && w == 2) return shared_node(b, OP_MUL, x, x);
  if (op == OP_POW && cy && w == 3) return shared_node(b, OP_MUL, shared_node(b, OP_MUL, x, x), x);
  if (op == OP_POW && cy && w == 0.5) return shared_node(b, OP_SQRT, x, 0);
  // Commutative ones in one order, so that they are found again.
  bool commutes = op == OP_ADD || op == OP_MUL;
  return commutes && x > y ? shared_node(b, op, y, x) : shared_node(b, op, x, y);
}

// ---- parser -----------------------------------------------------------------------------------------------------------------

static void skip(Builder *b)
{
  while (isspace((unsigned char)*b->s)) b->s++;
}

static bool accept(Builder *b, const char *op)
{
  skip(b);
  size_t n = strlen(op);
  if (strncmp(b->s, op, n)) return false;
  b->s += n;
  return true;
}

static uint32_t parse(Builder *b);

static uint32_t field_input(Builder *b, int id)
{
  for (size_t i = 0; i < b->field.len; i++)
    if (b->field.data[i] == id) return shared_node(b, OP_INPUT, (uint32_t)(3 + i), 0);
  vec_push(&b->field, id);
  return shared_node(b, OP_INPUT, (uint32_t)(2 + b->field.len), 0);
}

static const struct {
  const char *name;
  Op op;
  int args; // -1: one or more
} functions[] = {
  {"abs", OP_ABS, 1},     {"fabs", OP_ABS, 1},   {"acos", OP_ACOS, 1},   {"asin", OP_ASIN, 1},   {"atan", OP_ATAN, 1},
  {"atan2", OP_ATAN2, 2}, {"atanh", OP_ATANH, 1}, {"ceil", OP_CEIL, 1},  {"cos", OP_COS, 1},     {"cosh", OP_COSH, 1},
  {"deg", OP_DEG, 1},     {"exp", OP_EXP, 1},    {"fac", OP_FAC, 1},     {"floor", OP_FLOOR, 1}, {"hypot", OP_HYPOT, 2},
  {"log", OP_LOG, 1},     {"log10", OP_LOG10, 1}, {"ln", OP_LOG, 1},     {"max", OP_MAX, -1},    {"med", OP_DIV, -1},
  {"min", OP_MIN, -1},    {"mod", OP_MOD, 2},    {"fmod", OP_MOD, 2},    {"pow", OP_POW, 2},     {"rad", OP_RAD, 1},
  {"rand", OP_RAND, 1},   {"round", OP_ROUND, 1}, {"sign", OP_SIGN, 1},  {"sin", OP_SIN, 1},     {"sinh", OP_SINH, 1},
  {"sqrt", OP_SQRT, 1},   {"step", OP_STEP, 1},  {"sum", OP_ADD, -1},    {"tan", OP_TAN, 1},     {"tanh", OP_TANH, 1},
  {"trunc", OP_TRUNC, 1},
};

static uint32_t parse_call(Builder *b, const char *name, const char *at)
{
  const char *names[ARRAY_LEN(functions)];
  for (size_t i = 0; i < ARRAY_LEN(functions); i++) {
    names[i] = functions[i].name;
    if (strcasecmp(name, functions[i].name)) continue;
    uint32_t v = parse(b), count = 1;
    int want = functions[i].args;
    while (accept(b, ",")) {
      uint32_t next = parse(b);
      Op op = functions[i].op == OP_DIV ? OP_ADD : functions[i].op;
      if (want == 1 || (want == 2 && count == 2)) return fail_at(b, at, "too many arguments");
      v = emit2(b, op, v, next);
      count++;
    }
    if (want == 2 && count != 2) return fail_at(b, at, "two arguments are needed");
    if (!accept(b, ")")) return fail_at(b, b->s, "expected ')'");
    if (want == 1) return emit1(b, functions[i].op, v);
    return functions[i].op == OP_DIV ? emit2(b, OP_DIV, v, constant(b, count)) : v;
  }
  const char *near = str_nearest(name, names, ARRAY_LEN(functions));
  fail_at(b, at, near ? "unknown function; did you mean " : "unknown function");
  if (near) str_printf(b->error, "'%s'?", near);
  return 0;
}

static uint32_t parse_name(Builder *b)
{
  const char *at = b->s;
  char name[64];
  size_t n = 0;
  while (isalnum((unsigned char)*b->s) || *b->s == '_') {
    if (n + 1 < sizeof name) name[n++] = *b->s;
    b->s++;
  }
  name[n] = 0;
  if (accept(b, "(")) return parse_call(b, name, at);
  if (!strcasecmp(name, "x")) return shared_node(b, OP_INPUT, 0, 0);
  if (!strcasecmp(name, "y")) return shared_node(b, OP_INPUT, 1, 0);
  if (!strcasecmp(name, "z")) return shared_node(b, OP_INPUT, 2, 0);
  if (!strcasecmp(name, "pi")) return constant(b, M_PI);
  if (!strcasecmp(name, "e")) return constant(b, M_E);
  if (name[0] == 'F' && n > 1 && n < 10 && strspn(name + 1, "0123456789") == n - 1)
    return field_input(b, (int)strtol(name + 1, NULL, 10));
  fail_at(b, at, "unknown name '");
  str_printf(b->error, "%s' (known are x, y, z, pi, e, and F1, F2, ... for other fields)", name);
  return 0;
}

static uint32_t parse_primary(Builder *b)
{
  skip(b);
  if (accept(b, "(")) {
    uint32_t v = parse(b);
    return accept(b, ")") ? v : fail_at(b, b->s, "expected ')'");
  }
  if (isdigit((unsigned char)*b->s) || *b->s == '.') {
    double v;
    const char *after = number_read(b->s, b->end, &v);
    if (after == b->s) return fail_at(b, b->s, "expected a number");
    b->s = after;
    return constant(b, v);
  }
  if (isalpha((unsigned char)*b->s) || *b->s == '_') return parse_name(b);
  return fail_at(b, b->s, *b->s ? "expected a number, a name or '('" : "the expression ends too early");
}

static uint32_t parse_unary(Builder *b);

static uint32_t parse_power(Builder *b)
{
  uint32_t v = parse_primary(b);
  bool power = accept(b, "^");
  if (power) v = emit2(b, OP_POW, v, parse_unary(b));
  b->power = power;
  return v;
}

static uint32_t parse_unary(Builder *b)
{
  if (++b->depth > MAX_NESTING) return fail_at(b, b->s, "the expression is nested too deeply");
  uint32_t v;
  if (accept(b, "-")) v = emit1(b, OP_NEG, parse_unary(b)), b->minus_power |= b->power;
  else if (accept(b, "+")) v = parse_unary(b);
  else v = parse_power(b);
  b->depth--;
  return v;
}

static uint32_t parse_product(Builder *b)
{
  uint32_t v = parse_unary(b);
  while (!b->failed) {
    if (accept(b, "*")) v = emit2(b, OP_MUL, v, parse_unary(b));
    else if (accept(b, "/")) v = emit2(b, OP_DIV, v, parse_unary(b));
    else if (accept(b, "%")) v = emit2(b, OP_MOD, v, parse_unary(b));
    else break;
  }
  return v;
}

static uint32_t parse_sum(Builder *b)
{
  uint32_t v = parse_product(b);
  while (!b->failed) {
    if (accept(b, "+")) v = emit2(b, OP_ADD, v, parse_product(b));
    else if (accept(b, "-")) v = emit2(b, OP_SUB, v, parse_product(b));
    else break;
  }
  return v;
}

static uint32_t parse_comparison(Builder *b)
{
  static const struct {
    const char *text;
    Op op;
  } ops[] = {{"<=", OP_LE}, {">=", OP_GE}, {"==", OP_EQ}, {"!=", OP_NE}, {"<", OP_LT}, {">", OP_GT}};
  uint32_t v = parse_sum(b);
  for (size_t i = 0; i < ARRAY_LEN(ops) && !b->failed; i++) {
    if (!accept(b, ops[i].text)) continue;
    v = emit2(b, ops[i].op, v, parse_sum(b));
    i = (size_t)-1; // another one may follow
  }
  return v;
}

static uint32_t parse(Builder *b)
{
  uint32_t v = parse_comparison(b);
  while (!b->failed) {
    if (accept(b, "&&")) v = emit2(b, OP_AND, v, parse_comparison(b));
    else if (accept(b, "||")) v = emit2(b, OP_OR, v, parse_comparison(b));
    else break;
  }
  return v;
}

// ---- registers ------------------------------------------------------------------------------------------------------------------

// Nodes needed for the result, in their order, which is one of evaluation. Constants have the first registers for good; another one is
// free again after its last use.
static void generate(Builder *b, uint32_t root, Expr *e)
{
  size_t n = b->node.len;
  uint32_t ninput = (uint32_t)(3 + b->field.len);
  uint32_t *last = mem_zalloc(n * sizeof *last), *place = mem_alloc(n * sizeof *place); // last: index + 1 of the last user
  U32Vec spare = {0};
  last[root] = (uint32_t)n + 1;
  for (size_t i = n; i-- > 0;) {
    const ExprNode *x = &b->node.data[i];
    if (!last[i] || x->op == OP_CONST || x->op == OP_INPUT) continue;
    if (!last[x->a]) last[x->a] = (uint32_t)i + 1;
    if (expr_is_binary(x->op) && !last[x->b]) last[x->b] = (uint32_t)i + 1;
  }
  for (size_t i = 0; i < n; i++) {
    const ExprNode *x = &b->node.data[i];
    if (x->op == OP_INPUT) place[i] = x->a;
    if (x->op != OP_CONST || !last[i]) continue;
    place[i] = ninput + e->nreg++;
    vec_push(&e->number, x->value);
  }
  uint32_t reusable = ninput + e->nreg;
  for (size_t i = 0; i < n; i++) {
    const ExprNode *x = &b->node.data[i];
    if (!last[i] || x->op == OP_INPUT || x->op == OP_CONST) continue;
    Instr in = {x->op, 0, place[x->a], expr_is_binary(x->op) ? place[x->b] : 0};
    // The target is chosen before operands are freed: loops may then assume that it is none of them.
    in.to = spare.len ? vec_pop(&spare) : ninput + e->nreg++;
    place[i] = in.to;
    if (last[x->a] == i + 1 && in.a >= reusable) vec_push(&spare, in.a);
    if (expr_is_binary(x->op) && x->b != x->a && last[x->b] == i + 1 && in.b >= reusable) vec_push(&spare, in.b);
    vec_push(&e->code, in);
  }
  e->result = place[root];
  e->constant = b->node.data[root].op == OP_CONST;
  e->value = b->node.data[root].value;
  free(last);
  free(place);
  vec_free(&spare);
}

Expr *expr_compile(const char *text, Str *error, int *column)
{
  Builder b = {.s = text, .text = text, .end = text + strlen(text), .error = error};
  Expr *e = NULL;
  uint32_t root = parse(&b);
  skip(&b);
  if (!b.failed && *b.s) fail_at(&b, b.s, "this is not expected here");
  *column = b.column;
  if (!b.failed) {
    e = mem_zalloc(sizeof *e);
    generate(&b, root, e);
    e->field = b.field;
    e->minus_power = b.minus_power;
  } else {
    vec_free(&b.field);
  }
  vec_free(&b.node);
  map_free(&b.seen);
  return e;
}

void expr_free(Expr *e)
{
  if (!e) return;
  vec_free(&e->code);
  vec_free(&e->number);
  vec_free(&e->field);
  free(e);
}

size_t expr_fields(const Expr *e, const int **id)
{
  *id = e->field.data;
  return e->field.len;
}

bool expr_constant(const Expr *e, double *value)
{
  *value = e->value;
  return e->constant;
}

bool expr_minus_power(const Expr *e)
{
  return e->minus_power;
}

size_t expr_scratch(const Expr *e, size_t n)
{
  return e->nreg * n;
}

size_t expr_length(const Expr *e)
{
  return e->number.len + e->code.len;
}
