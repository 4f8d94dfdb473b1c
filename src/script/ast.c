// ast.c - printing of syntax trees
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/ast.h"

const char *node_kind_name(NodeKind kind)
{
  static const char *const names[] = {
#define X(kind) #kind,
      NODE_KINDS(X)
#undef X
  };
  return names[kind];
}

static void print_op(int op, Str *out)
{
  static const struct {
    int op;
    const char *text;
  } names[] = {{TOK_ADD_TO, "+="},     {TOK_SUB_FROM, "-="},   {TOK_MUL_BY, "*="}, {TOK_DIV_BY, "/="},
               {TOK_INC, "++"},        {TOK_DEC, "--"},        {TOK_EQ, "=="},     {TOK_NE, "!="},
               {TOK_LE, "<="},         {TOK_GE, ">="},         {TOK_AND, "&&"},    {TOK_OR, "||"},
               {TOK_SHIFT_LEFT, "<<"}, {TOK_SHIFT_RIGHT, ">>"}};
  if (op < 256) {
    str_char(out, (char)op);
    return;
  }
  for (size_t i = 0; i < ARRAY_LEN(names); i++)
    if (names[i].op == op) str_append(out, names[i].text);
}

static bool has_word(const Node *n)
{
  switch ((NodeKind)n->kind) {
  case NODE_NAME:
  case NODE_SCOPED:
  case NODE_CALL:
  case NODE_CONSTANT:
  case NODE_TRANSFORM:
  case NODE_BOUNDARY:
  case NODE_BOOLEAN:
  case NODE_DEFINE:
  case NODE_EMBED:
  case NODE_TRANSFINITE:
  case NODE_MESH_SET:
  case NODE_PERIODIC:
  case NODE_DELETE:
  case NODE_VISIBILITY:
  case NODE_COHERENCE:
  case NODE_PRINT:
  case NODE_FIELD_USE:
  case NODE_COMMAND: return n->word != KW_COUNT;
  default: return false;
  }
}

static bool has_text(const Node *n)
{
  switch ((NodeKind)n->kind) {
  case NODE_STRING:
  case NODE_OPTION:
  case NODE_MEMBER:
  case NODE_STRUCT_ITEM:
  case NODE_FIELD_OPTION:
  case NODE_PLUGIN_OPTION:
  case NODE_FIELD:
  case NODE_VIEW_ITEM:
  case NODE_UNSUPPORTED:
  case NODE_FAULT: return true;
  default: return false;
  }
}

void node_print(const Node *n, const Words *words, Str *out)
{
  if (!n) {
    str_append(out, "()");
    return;
  }
  if (n->kind == NODE_NUMBER) {
    str_double(out, n->number);
    return;
  }
  if (n->kind == NODE_NAME) {
    str_append(out, words_text(words, n->word));
    return;
  }
  str_char(out, '(');
  if (n->kind == NODE_BINARY || n->kind == NODE_UNARY || n->kind == NODE_POSTFIX || n->kind == NODE_ASSIGN) {
    if (n->kind == NODE_ASSIGN) str_append(out, "ASSIGN ");
    print_op(n->op, out);
  } else {
    str_append(out, node_kind_name(n->kind));
  }
  if (has_word(n)) str_printf(out, " %s", words_text(words, n->word));
  if (has_text(n)) str_printf(out, " \"%s\"", n->text);
  switch ((NodeKind)n->kind) {
  case NODE_ENTITIES:
  case NODE_IN_BOX:
  case NODE_BOX_OF:
  case NODE_SHAPE:
  case NODE_EXTRUDE:
  case NODE_PHYSICAL:
  case NODE_EMBED:
  case NODE_TRANSFINITE:
  case NODE_MESH_SET:
  case NODE_PERIODIC:
  case NODE_COMPOUND: str_printf(out, " %d", n->op); break;
  default: break;
  }
  if (n->flags & LIST_PHYSICAL && (n->kind == NODE_SHAPE || n->kind == NODE_ENTITIES))
    str_append(out, " physical");
  for (uint32_t i = 0; i < n->n; i++) {
    str_char(out, ' ');
    node_print(n->kid[i], words, out);
  }
  str_char(out, ')');
}
