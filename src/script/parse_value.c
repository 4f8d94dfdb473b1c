// parse_value.c - what expressions are made of: literals, variables, calls, lists
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/parse_int.h"

#include "script/fold.h"
#include "script/function.h"

static bool is_open(int kind) { return kind == '(' || kind == '['; }
static bool is_close(int kind) { return kind == ')' || kind == ']'; }

static void expect_close(Parser *p)
{
  if (!is_close(p->tok.kind)) parse__expected(p, "')' or ']'");
  parse__advance(p);
  parse__close(p);
}

static void expect_open(Parser *p)
{
  if (!is_open(p->tok.kind)) parse__expected(p, "'(' or '['");
  parse__open(p);
  parse__advance(p);
}

static Node *number_node(Parser *p, SrcLoc loc, double v)
{
  Node *n = parse__node(p, NODE_NUMBER, loc, 0);
  n->number = v;
  return n;
}

static Node *text_node(Parser *p)
{
  Token t = parse__expect(p, TOK_STRING, "a string");
  Node *n = parse__node(p, NODE_STRING, t.loc, 0);
  n->text = parse__text(p, t);
  return n;
}

// name -> IDENTIFIER ("~" "{" number "}")... | "StringToName" "[" text "]" | IDENTIFIER "::" name
Node *parse__name(Parser *p)
{
  Token t = p->tok;
  if (parse__at_word(p, KW_StringToName)) {
    parse__advance(p);
    expect_open(p);
    Node *text = parse__expr(p);
    expect_close(p);
    return parse__node1(p, NODE_S2N, t.loc, text);
  }
  if (t.kind != TOK_WORD) parse__expected(p, "a name");
  if (keyword_reserved(t.word) && parse__peek(p).kind != '~')
    parse__fail(p, t.loc, "'%.*s' is a word of the language and cannot be a name here", (int)t.len, t.start);
  parse__advance(p);
  Node *name = parse__node(p, NODE_NAME, t.loc, 0);
  name->word = t.word;
  if (parse__accept(p, TOK_SCOPE)) {
    Node *in = parse__name(p);
    if (in->kind == NODE_SCOPED) parse__fail(p, t.loc, "name spaces cannot stand in one another");
    Node *scoped = parse__node1(p, NODE_SCOPED, t.loc, in);
    scoped->word = t.word;
    return scoped;
  }
  if (!parse__at(p, '~')) return name;
  size_t base = p->stack.len;
  vec_push(&p->stack, name);
  while (parse__accept(p, '~')) {
    parse__expect(p, '{', "'{' after '~'");
    parse__open(p);
    Node *e = parse__number(p);
    parse__close(p);
    parse__expect(p, '}', "'}'");
    vec_push(&p->stack, e);
  }
  return parse__collect(p, NODE_DYNAME, t.loc, base);
}

// items -> [expr ("," expr)...]
static void parse_items(Parser *p, int close)
{
  if (p->tok.kind == close || (close == ')' && is_close(p->tok.kind))) return;
  for (;;) {
    if (parse__at(p, '{')) {
      parse__fail(p, p->tok.loc, "a list cannot hold a list in braces; write its members without them");
    }
    Node *item = parse__expr(p);
    vec_push(&p->stack, item);
    if (!parse__accept(p, ',')) return;
    if (p->tok.kind == close) parse__fail(p, p->tok.loc, "a list must not end with a comma");
  }
}

// list -> "{" items "}" | "{" ":" "}" | expr
//
// Items that are lists are spliced; {:}, or "*", stands for all entities where `all`.
Node *parse__braces(Parser *p, bool all)
{
  Token open = parse__expect(p, '{', "'{'");
  parse__open(p);
  size_t base = p->stack.len;
  if (all && parse__at(p, TOK_RANGE)) {
    parse__advance(p);
    parse__expect(p, '}', "'}' after '{:'");
    parse__close(p);
    Node *n = parse__node(p, NODE_ALL, open.loc, 0);
    n->flags = NODE_IS_LIST;
    return n;
  }
  parse_items(p, '}');
  parse__close(p);
  if (p->tok.kind != '}') parse__expected(p, "',' or '}' in this list");
  parse__advance(p);
  Node *n = parse__collect(p, NODE_LIST, open.loc, base);
  n->flags = NODE_IS_LIST;
  return n;
}

Node *parse__braced_numbers(Parser *p, const char *what)
{
  if (!parse__at(p, '{')) parse__expected(p, what);
  return parse__braces(p, false);
}

// ---- postfix and primary ---------------------------------------------

// option -> CATEGORY ["[" number "]"] "." KEY ["." KEY]
// member -> name "." MEMBER
//
// Whether S.a is an option or a member of a Struct shows when the script runs.
static Node *parse_option(Parser *p, Node *name, Node *index)
{
  if (name->kind != NODE_NAME) {
    parse__expect(p, '.', "'.'");
    if (p->tok.kind != TOK_WORD) parse__expected(p, "the name of a member");
    Token t = parse__advance(p);
    Node *n = parse__node1(p, NODE_MEMBER, name->loc, name);
    n->text = parse__text(p, t);
    return n;
  }
  Str key = {0};
  while (parse__accept(p, '.')) {
    if (p->tok.kind != TOK_WORD) {
      str_free(&key);
      parse__expected(p, "the name of an option");
    }
    Token t = parse__advance(p);
    if (key.len) str_char(&key, '.');
    str_append_n(&key, t.start, t.len);
  }
  Node *n = parse__node1(p, NODE_OPTION, name->loc, index);
  uint32_t category = name->word;
  n->op = 0;
  // word and text share a union: the category stands before the key, "Mesh.Algorithm"
  const char *c = words_text(p->words, category);
  char *text = arena_alloc(p->arena, strlen(c) + key.len + 2);
  memcpy(text, c, strlen(c));
  text[strlen(c)] = '.';
  memcpy(text + strlen(c) + 1, str_text(&key), key.len);
  str_free(&key);
  n->text = text;
  return n;
}

static Node *parse_index(Parser *p, Node *name)
{
  SrcLoc loc = name->loc;
  expect_open(p);
  if (is_close(p->tok.kind)) {
    expect_close(p);
    Node *n = parse__node1(p, NODE_WHOLE, loc, name);
    n->flags = NODE_IS_LIST;
    return n;
  }
  Node *index = parse__expr(p);
  if (parse__at(p, ',')) {
    if (name->kind == NODE_NAME) {
      const char *near = function_nearest(words_text(p->words, name->word));
      parse__fail(p, loc, "unknown function '%s'%s%s%s", words_text(p->words, name->word),
                  near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    }
  }
  expect_close(p);
  Node *n = parse__node2(p, node_is_list(index) ? NODE_SUBLIST : NODE_INDEX, loc, name, index);
  if (node_is_list(index)) n->flags = NODE_IS_LIST;
  return n;
}

// target -> name ["[" [expr] "]"] | option | member ["[" [number] "]"]
// variable -> target ["++" | "--"]
static Node *parse_variable(Parser *p)
{
  Node *name = parse__name(p), *n = name;
  if (is_open(p->tok.kind)) n = parse_index(p, name);
  if (parse__at(p, '.')) {
    n = parse_option(p, name, n->kind == NODE_INDEX ? n->kid[1] : NULL);
    if (is_open(p->tok.kind) && !(n->kind == NODE_OPTION && n->kid[0])) n = parse_index(p, n);
  }
  if (parse__at(p, TOK_INC) || parse__at(p, TOK_DEC)) {
    Token op = parse__advance(p);
    n = parse__node1(p, NODE_POSTFIX, op.loc, n);
    n->op = (uint16_t)op.kind;
  }
  return n;
}

// call -> FUNCTION "(" [expr ("," expr)...] ")"
static Node *parse_call(Parser *p, const FunctionRow *f)
{
  Token t = parse__advance(p);
  size_t base = p->stack.len;
  if (f->max_args == 0 && !is_open(p->tok.kind)) { // CurrentDir and the like
    Node *n = parse__collect(p, NODE_CALL, t.loc, base);
    n->word = t.word;
    n->op = (uint16_t)function_index(f);
    return n;
  }
  expect_open(p);
  if (f->takes_name) {
    Node *name = parse__name(p);
    if (parse__at(p, '.')) name = parse_option(p, name, NULL);
    if (is_open(p->tok.kind)) { // Exists(l[])
      expect_open(p);
      if (!is_close(p->tok.kind)) parse__expr(p);
      expect_close(p);
    }
    vec_push(&p->stack, name);
    while (parse__accept(p, ',')) {
      Node *e = parse__expr(p);
      vec_push(&p->stack, e);
    }
  } else if (!is_close(p->tok.kind)) {
    do {
      Node *e = parse__at(p, '{') && f->takes_lists ? parse__braces(p, false) : parse__expr(p);
      vec_push(&p->stack, e);
    } while (parse__accept(p, ','));
  }
  expect_close(p);
  size_t given = p->stack.len - base;
  if (given < (size_t)f->min_args || given > (size_t)f->max_args)
    parse__fail(p, t.loc, "%s takes %d%s%.0d argument%s, not %zu", words_text(p->words, t.word), f->min_args,
                f->max_args == f->min_args    ? ""
                : f->max_args >= FUNCTION_ANY ? " or more"
                                              : " to ",
                f->max_args == f->min_args || f->max_args >= FUNCTION_ANY ? 0 : f->max_args,
                f->max_args == 1 ? "" : "s", given);
  Node *n = parse__collect(p, NODE_CALL, t.loc, base);
  n->word = t.word;
  n->op = (uint16_t)function_index(f);
  bool lists = f->type == FUNCTION_LIST || f->type == FUNCTION_TEXTS;
  if (f->type == FUNCTION_SAME) lists = n->n == 1 && node_is_list(n->kid[0]);
  if (lists) n->flags = NODE_IS_LIST;
  return lists ? n : fold_constant(p, n);
}

// entities -> ["Physical"] entity "{" items "}" | entity "In" "BoundingBox" "{" items "}" | "BoundingBox"
//              entity "{" items "}"
// entity -> "Point" | "Curve" | "Line" | "Surface" | "Volume"
static Node *parse_entities(Parser *p)
{
  SrcLoc loc = p->tok.loc;
  bool physical = parse__accept_word(p, KW_Physical);
  int dim = parse__dimension(p);
  if (dim < 0) parse__expected(p, "Point, Curve, Surface or Volume");
  parse__advance(p);
  Node *n;
  if (!physical && parse__accept_word(p, KW_In)) {
    if (!parse__accept_word(p, KW_BoundingBox)) parse__expected(p, "'BoundingBox'");
    n = parse__node1(p, NODE_IN_BOX, loc, parse__braced_numbers(p, "'{'"));
  } else if (parse__at(p, '{')) {
    n = parse__node1(p, NODE_ENTITIES, loc, parse__braces(p, true));
  } else if (parse__at(p, TOK_STRING)) { // Surface "*", the old form of Surface{:}
    n = parse__node1(p, NODE_ENTITIES, loc, parse__list_or_all(p));
  } else {
    parse__expected(p, "'{'");
  }
  n->op = (uint16_t)dim;
  n->flags = NODE_IS_LIST | (physical ? LIST_PHYSICAL : 0);
  return n;
}

// parameter_value -> ("DefineNumber" | "DefineString") "[" expr ["," ATTRIBUTE expr]... "]"
static Node *parse_parameter(Parser *p)
{
  Token t = parse__advance(p);
  expect_open(p);
  Node *value = parse__expr(p);
  Node *n = parse__parameter_tail(p, value, t.loc);
  parse__close(p);
  n->op = t.word == KW_DefineString;
  return n;
}

// vector -> "{" x "," y "," z "}" | "(" x "," y "," z ")" | vector ("+" | "-") vector | "-" vector
static Node *parse_parenthesis(Parser *p)
{
  Token open = parse__advance(p);
  parse__open(p);
  Node *e = parse__expr(p);
  if (parse__at(p, ',')) { // (x, y, z), a vector
    size_t base = p->stack.len;
    vec_push(&p->stack, e);
    while (parse__accept(p, ',')) {
      Node *item = parse__expr(p);
      vec_push(&p->stack, item);
    }
    e = parse__collect(p, NODE_LIST, open.loc, base);
    e->flags = NODE_IS_LIST;
  }
  parse__expect(p, ')', "')'");
  parse__close(p);
  return e;
}

// length -> "#" (name | member) "[" "]"
static Node *parse_length(Parser *p)
{
  Token hash = parse__advance(p);
  Node *name = parse__name(p);
  if (parse__at(p, '.')) name = parse_option(p, name, NULL);
  expect_open(p);
  expect_close(p);
  return parse__node1(p, NODE_LENGTH, hash.loc, name);
}

// Field[n].Key as a value
static Node *parse_field_option(Parser *p)
{
  Token t = parse__advance(p);
  expect_open(p);
  Node *id = parse__number(p);
  expect_close(p);
  parse__expect(p, '.', "'.' and the name of a field's option");
  if (p->tok.kind != TOK_WORD) parse__expected(p, "the name of a field's option");
  Token key = parse__advance(p);
  Node *n = parse__node1(p, NODE_FIELD_OPTION, t.loc, id);
  n->text = parse__text(p, key);
  return n;
}

// struct_list -> "DimNameSpace" "[" [NAME] "]" | "NameStruct" "[" [NAME "::"] "#" number "]"
static Node *parse_struct_list(Parser *p)
{
  Token t = parse__advance(p);
  expect_open(p);
  Node *n = parse__node(p, NODE_SCOPED, t.loc, 1);
  n->word = KW_COUNT;
  n->op = (uint16_t)(t.word == KW_DimNameSpace ? 1 : 2);
  if (!is_close(p->tok.kind) && !parse__at(p, '#')) {
    n->word = parse__expect(p, TOK_WORD, "the name of a name space").word;
    if (n->op == 2) parse__expect(p, TOK_SCOPE, "'::' and '#' with the number of a Struct");
  }
  if (n->op == 2) {
    parse__expect(p, '#', "'#' and the number of a Struct");
    n->kid[0] = parse__number(p);
  }
  expect_close(p);
  return n;
}

static Node *parse_word(Parser *p)
{
  Token t = p->tok;
  if (t.word >= KW_COUNT) return parse_variable(p);
  const FunctionRow *f = function_find(t.word);
  if (f) return parse_call(p, f);
  Node *command = parse__command(p);
  if (command) return command;
  switch (t.word) {
  case KW_Pi: parse__advance(p); return number_node(p, t.loc, 3.14159265358979323846);
  case KW_GMSH_MAJOR_VERSION: parse__advance(p); return number_node(p, t.loc, 4);
  case KW_GMSH_MINOR_VERSION: parse__advance(p); return number_node(p, t.loc, 15);
  case KW_GMSH_PATCH_VERSION: parse__advance(p); return number_node(p, t.loc, 0);
  case KW_MPI_Size: parse__advance(p); return number_node(p, t.loc, 1);
  case KW_MPI_Rank: parse__advance(p); return number_node(p, t.loc, 0);
  case KW_newp:
  case KW_newl:
  case KW_newll:
  case KW_news:
  case KW_newsl:
  case KW_newv:
  case KW_newf:
  case KW_newreg:
  case KW_Cpu:
  case KW_Memory:
  case KW_TotalMemory:
  case KW_TestLevel: {
    parse__advance(p);
    Node *n = parse__node(p, NODE_CONSTANT, t.loc, 0);
    n->word = t.word;
    return n;
  }
  case KW_Point:
  case KW_Line:
  case KW_Surface:
  case KW_Volume:
  case KW_Physical: return parse_entities(p);
  case KW_BoundingBox: {
    parse__advance(p);
    Node *of = parse_entities(p);
    Node *n = parse__node1(p, NODE_BOX_OF, t.loc, of->kid[0]);
    n->op = of->op;
    n->flags = NODE_IS_LIST;
    return n;
  }
  case KW_DefineNumber:
  case KW_DefineString: return parse_parameter(p);
  case KW_Field: return parse_field_option(p);
  case KW_StringToName: return parse_variable(p);
  case KW_Struct:
    if (parse__peek(p).kind == TOK_WORD) return parse__struct(p);
    break;
  case KW_DimNameSpace:
  case KW_NameStruct:
    if (is_open(parse__peek(p).kind)) return parse_struct_list(p);
    break;
  default: break;
  }
  if (!keyword_reserved(t.word)) return parse_variable(p);
  parse__expected(p, "a value");
}

// primary -> NUMBER | STRING | CONSTANT | variable | call | length | entities | transform | extrude
//           | boundary | boolean | split | parameter_value | struct_list | struct | "(" expr ")" | "{" items "}"
//           | vector
Node *parse__primary(Parser *p)
{
  Token t = p->tok;
  switch (t.kind) {
  case TOK_NUMBER: parse__advance(p); return number_node(p, t.loc, t.number);
  case TOK_STRING: return text_node(p);
  case TOK_WORD: return parse_word(p);
  case '(': return parse_parenthesis(p);
  case '{': return parse__braces(p, false);
  case '#': return parse_length(p);
  case '[': parse__fail(p, t.loc, "a list stands in braces, {1, 2, 3}, not in brackets");
  default: parse__expected(p, "a value");
  }
}
