// parse_int.h - what the files of the parser share
// SPDX-License-Identifier: MIT
#ifndef SCRIPT_PARSE_INT_H
#define SCRIPT_PARSE_INT_H

#include "script/parse.h"

// Report a syntax error at loc and leave for the statement's recovery point.
NORETURN void parse__fail(Parser *p, SrcLoc loc, const char *fmt, ...) PRINTF_LIKE(3, 4);
// The same with "expected <what>, found <token>".
NORETURN void parse__expected(Parser *p, const char *what);

Token parse__advance(Parser *p); // returns the token that was next
bool parse__accept(Parser *p, int kind);
Token parse__expect(Parser *p, int kind, const char *what);
static inline bool parse__at(const Parser *p, int kind) { return p->tok.kind == kind; }
static inline bool parse__at_word(const Parser *p, Keyword k)
{
  return p->tok.kind == TOK_WORD && p->tok.word == k;
}
bool parse__accept_word(Parser *p, Keyword k);
Token parse__peek(const Parser *p); // the token after the next
void parse__open(Parser *p);        // count a brace; fails beyond LIMIT_NESTING
void parse__close(Parser *p);

Node *parse__node(Parser *p, NodeKind kind, SrcLoc loc, uint32_t nkids);
Node *parse__node1(Parser *p, NodeKind kind, SrcLoc loc, Node *a);
Node *parse__node2(Parser *p, NodeKind kind, SrcLoc loc, Node *a, Node *b);
Node *parse__node3(Parser *p, NodeKind kind, SrcLoc loc, Node *a, Node *b, Node *c);
// A node whose kids are what was pushed on p->stack since `base`.
Node *parse__collect(Parser *p, NodeKind kind, SrcLoc loc, size_t base);
char *parse__text(Parser *p, Token t);
// 0..3 for Point, Line/Curve, Surface, Volume, else -1.
int parse__dimension(const Parser *p);

Node *parse__expr(Parser *p);        // any expression, number, list or text
Node *parse__number(Parser *p);      // not a list
Node *parse__list(Parser *p);        // a list, or a number taken as a list of one
Node *parse__list_value(Parser *p);  // the right side of an assignment
Node *parse__list_or_all(Parser *p); // also {:} and a string "*"
Node *parse__braced_numbers(Parser *p, const char *what);
Node *parse__primary(Parser *p);          // a value without operators around it
Node *parse__braces(Parser *p, bool all); // {a, b, ...}; {:} too if `all`
Node *parse__name(Parser *p);             // identifier, name~{..}, StringToName[..]
Node *parse__command(Parser *p);          // Translate.. Extrude.. Boundary.. or NULL if none begins here
Node *parse__shapes(Parser *p);           // { Point{..}; ... }
Node *parse__parameter_tail(Parser *p, Node *value, SrcLoc loc);
Node *parse__statement(Parser *p);       // one statement with its ';'; fails through p->on_error
Node *parse__block_statement(Parser *p); // For, If or Macro, the next token
Node *parse__define_constant(Parser *p);
Node *parse__struct(Parser *p);
Node *parse__view(Parser *p, SrcLoc loc);
Node *parse__unsupported(Parser *p, Token t, const char *why); // the rest of a statement that begins with t
Node *parse__word_node(Parser *p, NodeKind kind, SrcLoc loc, uint32_t word,
                       size_t base); // collect, with a word
void parse__push(Parser *p, Node *n);
Node *parse__tag(Parser *p); // "(" number ")"
Node *parse__definition(Parser *p, Token kind, uint32_t word, int op);
Node *parse__entity(Parser *p);
Node *parse__physical(Parser *p);
Node *parse__surface_of_kind(Parser *p, Token t);
Node *parse__compound(Parser *p);
Node *parse__delete(Parser *p, bool recursive);
Node *parse__visibility(Parser *p);
Node *parse__coherence(Parser *p);
Node *parse__set_max_tag(Parser *p);
Node *parse__transfinite(Parser *p);
Node *parse__mesh_set(Parser *p);
Node *parse__mesh_size(Parser *p);
Node *parse__periodic(Parser *p);
Node *parse__field(Parser *p);
Node *parse__plugin(Parser *p);
Node *parse__background(Parser *p);
bool parse__ends_block(const Parser *p);
void parse__semicolon(Parser *p);             // the end of a statement
void parse__superfluous_semicolon(Parser *p); // a ';' after something that needs none: a warning

#endif
