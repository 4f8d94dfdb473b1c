// parse_expr.c - expressions: operators, ranges, lists
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/parse_int.h"

#include "script/fold.h"

static Node *parse_unary(Parser *p);

enum {
  LEVEL_TERNARY,
  LEVEL_OR,
  LEVEL_AND,
  LEVEL_EQUAL,
  LEVEL_LESS,
  LEVEL_SUM,
  LEVEL_PRODUCT,
  LEVEL_BITS,
  LEVEL_UNARY
};

static int level_of(int kind)
{
  switch (kind) {
  case TOK_OR: return LEVEL_OR;
  case TOK_AND: return LEVEL_AND;
  case TOK_EQ:
  case TOK_NE: return LEVEL_EQUAL;
  case '<':
  case '>':
  case TOK_LE:
  case TOK_GE:
  case TOK_SHIFT_LEFT:
  case TOK_SHIFT_RIGHT: return LEVEL_LESS;
  case '+':
  case '-': return LEVEL_SUM;
  case '*':
  case '/':
  case '%': return LEVEL_PRODUCT;
  case '|':
  case '&': return LEVEL_BITS;
  default: return -1;
  }
}

static Node *binary_node(Parser *p, Token op, Node *a, Node *b)
{
  bool la = node_is_list(a), lb = node_is_list(b), sum = op.kind == '+' || op.kind == '-';
  if ((la || lb) && !(la && lb && sum) && !(!la && lb && op.kind == '*'))
    parse__fail(p, op.loc, "a list can only be negated, or scaled by a number on its left (2 * l[])");
  Node *n = parse__node2(p, NODE_BINARY, op.loc, a, b);
  n->op = (uint16_t)op.kind;
  if (lb) {
    n->flags = NODE_IS_LIST;
    return n;
  }
  return fold_constant(p, n);
}

// power -> primary ["^" unary]
static Node *parse_power(Parser *p)
{
  Node *a = parse__primary(p);
  if (!parse__at(p, '^')) return a;
  Token op = parse__advance(p);
  parse__open(p);
  Node *b = parse_unary(p);
  parse__close(p);
  return binary_node(p, op, a, b);
}

// unary -> ("-" | "+" | "!") unary | power
static Node *parse_unary(Parser *p)
{
  Token op = p->tok;
  if (op.kind != '-' && op.kind != '+' && op.kind != '!') return parse_power(p);
  parse__advance(p);
  parse__open(p);
  Node *e = parse_unary(p);
  parse__close(p);
  if (op.kind == '+') return e;
  if (op.kind == '!' && node_is_list(e)) parse__fail(p, op.loc, "'!' needs a number, not a list");
  Node *n = parse__node1(p, NODE_UNARY, op.loc, e);
  n->op = (uint16_t)op.kind;
  if (node_is_list(e)) {
    n->flags = NODE_IS_LIST;
    return n;
  }
  return fold_constant(p, n);
}

// or -> or OPERATOR or | unary
//
// The operators from loose to tight: || && (== !=) (< <= > >= << >>) (+ -) (* / %) (| &); they associate to
// the left.
static Node *parse_level(Parser *p, int level)
{
  if (level == LEVEL_UNARY) return parse_unary(p);
  Node *a = parse_unary(p);
  // precedence climbing: fold everything that binds at least as tightly as `level`
  for (;;) {
    int l = level_of(p->tok.kind);
    if (l < level) return a;
    Token op = parse__advance(p);
    Node *b = parse_level(p, l + 1);
    a = binary_node(p, op, a, b);
  }
}

// ternary -> or ["?" ternary ":" ternary]
static Node *parse_ternary(Parser *p)
{
  Node *a = parse_level(p, LEVEL_OR);
  if (!parse__at(p, '?')) return a;
  Token op = parse__advance(p);
  parse__open(p);
  Node *yes = parse_ternary(p);
  parse__expect(p, TOK_RANGE, "':' of the conditional '? :'");
  Node *no = parse_ternary(p);
  parse__close(p);
  Node *n = parse__node3(p, NODE_TERNARY, op.loc, a, yes, no);
  if (node_is_list(yes) || node_is_list(no))
    parse__fail(p, op.loc, "'? :' chooses between numbers, not lists");
  return fold_constant(p, n);
}

// expr -> ternary [":" ternary [":" ternary]]
Node *parse__expr(Parser *p)
{
  Node *a = parse_ternary(p);
  if (!parse__at(p, TOK_RANGE)) return a;
  Token op = parse__advance(p);
  Node *to = parse_ternary(p), *step = NULL;
  if (parse__accept(p, TOK_RANGE)) step = parse_ternary(p);
  if (node_is_list(a) || node_is_list(to) || (step && node_is_list(step)))
    parse__fail(p, op.loc, "the bounds of a range are numbers, not lists");
  Node *n = parse__node3(p, NODE_RANGE, op.loc, a, to, step);
  n->flags = NODE_IS_LIST;
  return n;
}

Node *parse__number(Parser *p)
{
  SrcLoc loc = p->tok.loc;
  Node *n = parse_ternary(p);
  if (node_is_list(n) && n->kind != NODE_WHOLE) parse__fail(p, loc, "a number is needed here, not a list");
  return n;
}

Node *parse__list(Parser *p) { return parse__expr(p); }

Node *parse__list_or_all(Parser *p)
{
  Token t = p->tok;
  if (t.kind == '{') {
    if (parse__peek(p).kind == TOK_RANGE) return parse__braces(p, true);
    return parse__expr(p);
  }
  if (t.kind == TOK_STRING) {
    bool star = t.len == 1 && *t.start == '*', all = t.len == 3 && !memcmp(t.start, "all", 3);
    if (!star && !all) parse__fail(p, t.loc, "expected a list, or \"*\" for all");
    parse__advance(p);
    Node *n = parse__node(p, NODE_ALL, t.loc, 0);
    n->flags = NODE_IS_LIST;
    return n;
  }
  return parse__expr(p);
}

// The right side of an assignment: {..} may hold texts, {:} and all else an expression may be.
Node *parse__list_value(Parser *p)
{
  if (p->tok.kind == '{' && parse__peek(p).kind == TOK_RANGE) return parse__braces(p, true);
  return parse__expr(p);
}
