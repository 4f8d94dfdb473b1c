// parse.c - the parser's tools: tokens, nodes, errors and recovery, blocks
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/parse_int.h"

#include <stdarg.h>

#include "script/limits.h"

void parser_init(Parser *p, Diag *diag, Words *words, uint32_t file, const char *text, size_t len)
{
  *p = (Parser){.diag = diag, .words = words};
  lexer_init(&p->lexer, words, file, text, len);
  p->tok = lexer_next(&p->lexer);
  p->last_end = p->tok.loc;
}

void parser_free(Parser *p)
{
  vec_free(&p->stack);
  str_free(&p->error);
}

// ---- errors ---------------------------------------------

void parse__fail(Parser *p, SrcLoc loc, const char *fmt, ...)
{
  char text[512];
  va_list ap;
  va_start(ap, fmt);
  vsnprintf(text, sizeof text, fmt, ap);
  va_end(ap);
  str_clear(&p->error);
  str_append(&p->error, text);
  p->error_loc = loc;
  longjmp(*p->on_error, 1);
}

static void describe(const Parser *p, const Token *t, Str *out)
{
  if (t->kind == TOK_END)
    str_append(out, "the end of the file");
  else if (t->kind == TOK_STRING)
    str_append(out, "a string");
  else
    str_printf(out, "'%.*s'", (int)MIN(t->len, (size_t)40), t->start);
  if (t->kind == TOK_WORD && keyword_reserved(t->word) && p->lexer.words)
    str_append(out, ", a word of the language");
}

void parse__expected(Parser *p, const char *what)
{
  if (p->tok.kind == TOK_BAD) parse__fail(p, p->tok.loc, "%s", p->lexer.problem);
  Str found = {0};
  describe(p, &p->tok, &found);
  char text[128];
  snprintf(text, sizeof text, "%s", str_text(&found));
  str_free(&found);
  parse__fail(p, p->tok.loc, "expected %s, found %s", what, text);
}

// ---- tokens ---------------------------------------------

Token parse__advance(Parser *p)
{
  Token t = p->tok;
  p->last_end = t.loc;
  p->last_end.col += (uint32_t)t.len;
  p->tok = lexer_next(&p->lexer);
  return t;
}

bool parse__accept(Parser *p, int kind)
{
  if (p->tok.kind != kind) return false;
  parse__advance(p);
  return true;
}

Token parse__expect(Parser *p, int kind, const char *what)
{
  if (p->tok.kind != kind) parse__expected(p, what);
  return parse__advance(p);
}

bool parse__accept_word(Parser *p, Keyword k)
{
  if (!parse__at_word(p, k)) return false;
  parse__advance(p);
  return true;
}

Token parse__peek(const Parser *p)
{
  Lexer ahead = p->lexer;
  return lexer_next(&ahead);
}

void parse__open(Parser *p)
{
  if (++p->nesting + p->blocks > LIMIT_NESTING)
    parse__fail(p, p->tok.loc, "nested too deeply (the limit is %d)", LIMIT_NESTING);
}

void parse__close(Parser *p) { p->nesting--; }

void parse__semicolon(Parser *p)
{
  if (parse__accept(p, ';')) return;
  if (p->tok.kind == TOK_END || p->tok.loc.line != p->last_end.line) { // the next statement is probably sound
    diag_error(p->diag, p->last_end, "expected ';' at the end of this statement");
    return;
  }
  parse__expected(p, "';'");
}

// ---- nodes ---------------------------------------------

Node *parse__node(Parser *p, NodeKind kind, SrcLoc loc, uint32_t nkids)
{
  Node *n = arena_alloc(p->arena, sizeof *n + nkids * sizeof n->kid[0]);
  n->kind = (uint8_t)kind;
  n->loc = loc;
  n->n = nkids;
  return n;
}

static void settle(Parser *p, Node *n)
{
  unsigned height = 0;
  for (uint32_t i = 0; i < n->n; i++)
    if (n->kid[i]) height = MAX(height, n->kid[i]->height + 1u);
  if (height > LIMIT_EXPRESSION)
    parse__fail(p, n->loc, "this expression is too long or too deep (the limit is %d operations)",
                LIMIT_EXPRESSION);
  n->height = (uint16_t)height;
}

Node *parse__node1(Parser *p, NodeKind kind, SrcLoc loc, Node *a)
{
  Node *n = parse__node(p, kind, loc, 1);
  n->kid[0] = a;
  settle(p, n);
  return n;
}

Node *parse__node2(Parser *p, NodeKind kind, SrcLoc loc, Node *a, Node *b)
{
  Node *n = parse__node(p, kind, loc, 2);
  n->kid[0] = a;
  n->kid[1] = b;
  settle(p, n);
  return n;
}

Node *parse__node3(Parser *p, NodeKind kind, SrcLoc loc, Node *a, Node *b, Node *c)
{
  Node *n = parse__node(p, kind, loc, 3);
  n->kid[0] = a;
  n->kid[1] = b;
  n->kid[2] = c;
  settle(p, n);
  return n;
}

Node *parse__collect(Parser *p, NodeKind kind, SrcLoc loc, size_t base)
{
  Node *n = parse__node(p, kind, loc, (uint32_t)(p->stack.len - base));
  if (n->n) memcpy(n->kid, p->stack.data + base, n->n * sizeof n->kid[0]);
  p->stack.len = base;
  settle(p, n);
  return n;
}

char *parse__text(Parser *p, Token t) { return arena_strndup(p->arena, t.start, t.len); }

int parse__dimension(const Parser *p)
{
  if (p->tok.kind != TOK_WORD) return -1;
  switch (p->tok.word) {
  case KW_Point: return 0;
  case KW_Line: return 1;
  case KW_Surface: return 2;
  case KW_Volume: return 3;
  default: return -1;
  }
}

// ---- recovery and blocks ---------------------------------------------

static bool is_block_word(const Token *t)
{
  if (t->kind != TOK_WORD) return false;
  switch (t->word) {
  case KW_For:
  case KW_EndFor:
  case KW_If:
  case KW_ElseIf:
  case KW_Else:
  case KW_EndIf:
  case KW_Macro:
  case KW_Return: return true;
  default: return false;
  }
}

// Does a '}' follow on the line of the next token?
static bool brace_follows(const Parser *p)
{
  Lexer ahead = p->lexer;
  for (Token t = p->tok; t.kind != TOK_END && t.loc.line == p->tok.loc.line; t = lexer_next(&ahead))
    if (t.kind == '}') return true;
  return false;
}

// Go on after the next ';', but past a list of shapes in braces, of which `open` are open; or at a word that
// begins or ends a block if it is the first of its line.
static void recover(Parser *p, int open)
{
  uint32_t line = p->tok.loc.line;
  while (p->tok.kind != TOK_END) {
    if (is_block_word(&p->tok) && p->tok.loc.line != line) break;
    Token t = parse__advance(p);
    line = t.loc.line;
    if (t.kind == '{') open++;
    bool closed = t.kind == '}' && open > 0 && --open == 0;
    if (closed && p->tok.loc.line != line && !parse__at(p, ';')) break;
    if (t.kind == ';' && (!open || !(parse__at(p, '}') || (p->tok.loc.line == line && brace_follows(p)))))
      break;
  }
  p->stray_braces = open;
}

// Parse a statement; after a syntax error recover and return NULL with p->error set.
static Node *guarded_statement(Parser *p)
{
  jmp_buf here, *outer = p->on_error;
  size_t base = p->stack.len;
  int nesting = p->nesting, blocks = p->blocks;
  bool in_macro = p->in_macro;
  Node *volatile n = NULL;
  p->on_error = &here;
  p->failed_word = p->tok.kind == TOK_WORD ? p->tok.word : NONE;
  if (setjmp(here) == 0) {
    n = parse__statement(p);
  } else if (p->fatal && outer) {
    longjmp(*outer, 1);
  } else {
    n = NULL;
    int open = MAX(0, p->nesting - nesting);
    p->stack.len = base;
    p->nesting = nesting;
    p->blocks = blocks;
    p->in_macro = in_macro;
    recover(p, open);
  }
  p->on_error = outer;
  return n;
}

bool parse__ends_block(const Parser *p)
{
  if (p->tok.kind == TOK_END) return true;
  if (p->tok.kind != TOK_WORD) return false;
  switch (p->tok.word) {
  case KW_EndFor:
  case KW_ElseIf:
  case KW_Else:
  case KW_EndIf: return true;
  case KW_Return: return p->in_macro;
  default: return false;
  }
}

// block -> [statement]...
//
// Statements up to the word that ends the block. A syntax error becomes a FAULT, reported when it is reached:
// a branch that is never taken may hold anything.
static Node *parse_block(Parser *p)
{
  size_t base = p->stack.len;
  SrcLoc loc = p->tok.loc;
  p->fatal = ++p->blocks + p->nesting > LIMIT_NESTING;
  if (p->fatal) parse__fail(p, loc, "blocks nested too deeply (the limit is %d)", LIMIT_NESTING);
  while (!parse__ends_block(p)) {
    Node *n = guarded_statement(p);
    if (!n) {
      n = parse__node(p, NODE_FAULT, p->error_loc, 0);
      n->text = arena_strdup(p->arena, str_text(&p->error));
    }
    vec_push(&p->stack, n);
  }
  p->blocks--;
  Node *block = parse__node(p, NODE_BLOCK, loc, (uint32_t)(p->stack.len - base));
  if (block->n) memcpy(block->kid, p->stack.data + base, block->n * sizeof block->kid[0]);
  p->stack.len = base;
  return block;
}

void parse__superfluous_semicolon(Parser *p)
{
  if (!parse__at(p, ';') || p->tok.loc.line != p->last_end.line) return;
  diag_warning(p->diag, p->tok.loc, "this ';' is superfluous (a syntax error for Gmsh)");
  parse__advance(p);
}

static void end_block(Parser *p, Keyword k, SrcLoc begin, const char *what, const char *end)
{
  if (parse__accept_word(p, k)) {
    parse__superfluous_semicolon(p);
    return;
  }
  parse__fail(p, begin, "this %s has no %s", what, end);
}

// for -> "For" name "In" "{" number ":" number [":" number] "}" block "EndFor" | "For" "(" number ":" number
//         [":" number] ")" block "EndFor"
static Node *parse_for(Parser *p)
{
  Token begin = parse__advance(p);
  Node *n = parse__node(p, NODE_FOR, begin.loc, 5);
  int close = ')';
  if (!parse__accept(p, '(')) {
    n->kid[0] = parse__name(p);
    if (!parse__accept_word(p, KW_In)) parse__expected(p, "'In'");
    parse__expect(p, '{', "'{'");
    close = '}';
  }
  n->kid[1] = parse__number(p);
  parse__expect(p, TOK_RANGE, "':' between the bounds of the loop");
  n->kid[2] = parse__number(p);
  if (parse__accept(p, TOK_RANGE)) n->kid[3] = parse__number(p);
  parse__expect(p, close, close == '}' ? "'}'" : "')'");
  bool in_macro = p->in_macro;
  p->in_macro = false;
  n->kid[4] = parse_block(p);
  p->in_macro = in_macro;
  end_block(p, KW_EndFor, begin.loc, "For", "EndFor");
  return n;
}

// if -> "If" "(" number ")" block ["ElseIf" "(" number ")" block]... ["Else" block] "EndIf"
static Node *parse_if(Parser *p)
{
  Token begin = p->tok;
  size_t base = p->stack.len;
  bool in_macro = p->in_macro;
  p->in_macro = false; // a Return in here leaves the macro, it does not end its text
  while (parse__at_word(p, KW_If) || parse__at_word(p, KW_ElseIf)) {
    if (p->stack.len > base && parse__at_word(p, KW_If)) break;
    parse__advance(p);
    Node *condition = parse__number(p);
    vec_push(&p->stack, condition);
    Node *block = parse_block(p);
    vec_push(&p->stack, block);
  }
  if (parse__accept_word(p, KW_Else)) {
    Node *block = parse_block(p);
    vec_push(&p->stack, block);
  }
  p->in_macro = in_macro;
  end_block(p, KW_EndIf, begin.loc, "If", "EndIf");
  Node *n = parse__node(p, NODE_IF, begin.loc, (uint32_t)(p->stack.len - base));
  memcpy(n->kid, p->stack.data + base, n->n * sizeof n->kid[0]);
  p->stack.len = base;
  return n;
}

// macro -> ("Macro" | "Function") (name | text) block "Return"
static Node *parse_macro(Parser *p)
{
  Token begin = parse__advance(p);
  if (p->in_macro) parse__fail(p, begin.loc, "a macro inside a macro: the one before has no Return");
  Node *name = parse__at(p, TOK_STRING) ? parse__expr(p) : parse__name(p);
  p->in_macro = p->has_macro = true;
  Node *block = parse_block(p);
  p->in_macro = false;
  end_block(p, KW_Return, begin.loc, "Macro", "Return");
  Node *n = parse__node(p, NODE_MACRO, begin.loc, 2);
  n->kid[0] = name;
  n->kid[1] = block;
  return n;
}

Node *parse__block_statement(Parser *p)
{
  switch (p->tok.word) {
  case KW_For: return parse_for(p);
  case KW_If: return parse_if(p);
  case KW_Macro: return parse_macro(p);
  default: UNREACHABLE();
  }
}

// The condition after If or ElseIf, or NULL after a syntax error.
static Node *guarded_condition(Parser *p)
{
  jmp_buf here, *outer = p->on_error;
  Node *volatile n = NULL;
  p->on_error = &here;
  if (setjmp(here) == 0) {
    parse__advance(p);
    n = parse__number(p);
  } else {
    n = NULL;
    p->stack.len = 0;
    p->nesting = 0;
  }
  p->on_error = outer;
  return n;
}

NextKind parse_next(Parser *p, Arena *arena, Node **out)
{
  p->arena = arena;
  *out = NULL;
  if (p->tok.kind == TOK_END) return NEXT_END;
  uint32_t word = p->tok.kind == TOK_WORD ? p->tok.word : KW_COUNT;
  if (word == KW_Else || word == KW_EndIf) {
    parse__advance(p);
    if (word == KW_EndIf) parse__superfluous_semicolon(p);
    return word == KW_Else ? NEXT_ELSE : NEXT_ENDIF;
  }
  bool branch = word == KW_If || word == KW_ElseIf;
  *out = branch ? guarded_condition(p) : guarded_statement(p);
  if (!*out) diag_error(p->diag, p->error_loc, "%s", str_text(&p->error));
  return !branch ? NEXT_STATEMENT : word == KW_If ? NEXT_IF : NEXT_ELSEIF;
}

bool parse_skip_branch(Parser *p, bool to_end)
{
  for (int depth = 0; p->tok.kind != TOK_END; parse__advance(p)) {
    if (p->tok.kind != TOK_WORD) continue;
    switch (p->tok.word) {
    case KW_If: depth++; break;
    case KW_ElseIf:
    case KW_Else:
      if (!depth && !to_end) return true;
      break;
    case KW_EndIf:
      if (!depth--) return true;
      break;
    default: break;
    }
  }
  return false;
}
