// parse_constant.c - DefineConstant and the attributes of parameters; Struct
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/parse_int.h"

// ---- parameters ---------------------------------------------

// After the value: ["," ATTRIBUTE (number | text | "{" .. "}")]... close. Only Name and ReadOnly are kept.
// `comma`: the first comma has been read.
static Node *parameter_tail(Parser *p, Node *value, NodeKind kind, Node *target, SrcLoc loc, int close, bool comma)
{
  Node *name = NULL, *read_only = NULL;
  for (; p->tok.kind != close && !(close == ']' && parse__at(p, ')')); comma = false) {
    if (!comma) parse__expect(p, ',', close == '}' ? "',' or '}'" : "',' or ']'");
    if (p->tok.kind != TOK_WORD) parse__expected(p, "an attribute such as Name or Min");
    Token key = parse__advance(p);
    if (parse__at(p, '{')) { // Choices{1="one", 2}, GmshOption.. : any balanced text
      int depth = 0;
      do {
        if (p->tok.kind == TOK_END) parse__expected(p, "'}'");
        if (parse__at(p, '{')) depth++;
        if (parse__at(p, '}')) depth--;
        parse__advance(p);
      } while (depth > 0);
      continue;
    }
    Node *v = parse__expr(p);
    if (key.len == 4 && !memcmp(key.start, "Name", 4)) name = v;
    if (key.len == 8 && !memcmp(key.start, "ReadOnly", 8)) read_only = v;
  }
  parse__advance(p);
  size_t base = p->stack.len;
  if (kind == NODE_CONSTANT_ITEM) parse__push(p, target);
  parse__push(p, value);
  parse__push(p, name);
  parse__push(p, read_only);
  return parse__collect(p, kind, loc, base);
}

Node *parse__parameter_tail(Parser *p, Node *value, SrcLoc loc)
{
  return parameter_tail(p, value, NODE_PARAMETER, NULL, loc, ']', false);
}

// Is this word an attribute, or the next member of the list? A variable is followed by an operator, a comma or a bracket;
// attributes whose value may begin with a bracket or a sign are known by name.
static bool at_attribute(Parser *p)
{
  static const char *const names[] = {"Min", "Max", "Step", "Name", "ReadOnly", "Visible", "Label", "AutoCheck"};
  if (p->tok.kind != TOK_WORD) return false;
  int next = parse__peek(p).kind;
  if (next == TOK_STRING || next == TOK_NUMBER || next == TOK_WORD || next == '{') return true;
  if (next == '[' || next == '.') return false;
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (p->tok.len == strlen(names[i]) && !memcmp(p->tok.start, names[i], p->tok.len)) return next != '(' || i >= 3;
  return false;
}

// The value in braces: a list in braces, or members up to the first attribute.
static Node *parse_constant_value(Parser *p, Node *target, SrcLoc loc, bool list)
{
  parse__advance(p);
  parse__open(p);
  Token first = p->tok;
  Node *value = NULL;
  bool comma = false, braces = parse__at(p, '{');
  size_t base = p->stack.len;
  if (!parse__at(p, '}') && !at_attribute(p)) {
    parse__push(p, parse__expr(p));
    while (!braces && !comma && parse__accept(p, ',')) {
      comma = at_attribute(p);
      if (!comma) parse__push(p, parse__expr(p));
    }
    bool one = p->stack.len == base + 1 && (braces || !list);
    value = one ? p->stack.data[base] : parse__collect(p, NODE_LIST, first.loc, base);
    if (one) p->stack.len = base;
    if (!one) value->flags = NODE_IS_LIST;
  }
  Node *n = parameter_tail(p, value, NODE_CONSTANT_ITEM, target, loc, '}', comma);
  parse__close(p);
  return n;
}

// constant -> name ["[" "]"] ["=" (expr | "{" [list | expr ("," expr)...] ["," ATTRIBUTE value]... "}")]
static Node *parse_constant_item(Parser *p)
{
  Token t = p->tok;
  Node *target = parse__name(p), *value = NULL, *n;
  bool list = parse__at(p, '[') || parse__at(p, '(');
  if (list) {
    parse__advance(p);
    if (!parse__accept(p, ']')) parse__expect(p, ')', "']'");
  }
  bool braced = parse__accept(p, '=') && parse__at(p, '{');
  if (braced) {
    n = parse_constant_value(p, target, t.loc, list);
  } else {
    if (p->tok.kind != ',' && p->tok.kind != ']' && p->tok.kind != ')' &&
        (p->tok.kind != TOK_WORD || p->last_end.line == p->tok.loc.line))
      value = parse__expr(p);
    size_t base = p->stack.len;
    parse__push(p, target);
    parse__push(p, value);
    parse__push(p, NULL);
    parse__push(p, NULL);
    n = parse__collect(p, NODE_CONSTANT_ITEM, t.loc, base);
  }
  n->op = list;
  return n;
}

// define_constant -> "DefineConstant" "[" constant [","]... "]" ";"
Node *parse__define_constant(Parser *p)
{
  Token t = parse__advance(p);
  if (!parse__accept(p, '[')) parse__expect(p, '(', "'['");
  size_t base = p->stack.len;
  while (!parse__at(p, ']') && !parse__at(p, ')')) {
    parse__push(p, parse_constant_item(p));
    while (parse__accept(p, ',')) continue;
  }
  parse__advance(p);
  parse__semicolon(p);
  return parse__collect(p, NODE_CONSTANTS, t.loc, base);
}

// ---- structures ---------------------------------------------

// true for Append, or AppendToExistingStruct, with or without a number
static bool append_mark(Token t)
{
  return (t.len == 6 && !memcmp(t.start, "Append", 6)) ||
         (t.len == 22 && !memcmp(t.start, "AppendToExistingStruct", 22));
}

// struct_item -> MEMBER (expr | list) | ("Append" | "AppendToExistingStruct") [number] | "Enum" | MEMBER
//
// A member without value only after "Enum". Returns what the item adds to the structure's STRUCT_ flags.
static int parse_struct_item(Parser *p, int so_far)
{
  if (p->tok.kind != TOK_WORD) parse__expected(p, "the name of a member or ']'");
  Token key = parse__advance(p);
  bool bare = parse__at(p, ',') || parse__at(p, ']');
  if (append_mark(key)) {
    Node *on = bare ? NULL : parse__number(p);
    return !on || on->kind != NODE_NUMBER || on->number != 0 ? STRUCT_APPEND : 0;
  }
  if (bare && key.len == 4 && !memcmp(key.start, "Enum", 4)) return STRUCT_ENUM;
  if ((bare && !(so_far & STRUCT_ENUM)) || parse__at(p, '='))
    parse__expected(p, "the value of this member, as in 'a 1'");
  Node *item = parse__node1(p, NODE_STRUCT_ITEM, key.loc, bare ? NULL : parse__list(p));
  item->text = parse__text(p, key);
  parse__push(p, item);
  return 0;
}

// struct -> "Struct" name ["(" "Append" ")"] "[" [struct_item ("," struct_item)...] "]"
Node *parse__struct(Parser *p)
{
  Token t = parse__advance(p);
  size_t base = p->stack.len;
  int flags = 0;
  parse__push(p, parse__name(p));
  if (parse__accept(p, '(')) {
    if (p->tok.kind != TOK_WORD || !append_mark(p->tok)) parse__expected(p, "'Append'");
    parse__advance(p);
    parse__expect(p, ')', "')'");
    flags = STRUCT_APPEND;
  }
  parse__expect(p, '[', "'['");
  parse__open(p);
  while (!parse__at(p, ']')) {
    flags |= parse_struct_item(p, flags);
    if (!parse__accept(p, ',')) break;
  }
  parse__expect(p, ']', "',' or ']'");
  parse__close(p);
  Node *n = parse__collect(p, NODE_STRUCT, t.loc, base);
  n->op = (uint16_t)flags;
  return n;
}
