// parse.h - tokens to syntax trees
// SPDX-License-Identifier: MIT
#ifndef SCRIPT_PARSE_H
#define SCRIPT_PARSE_H

#include <setjmp.h>

#include "base/mem.h"
#include "base/str.h"
#include "script/ast.h"
#include "script/token.h"

typedef struct {
  Lexer lexer;
  Token tok;       // the next token
  SrcLoc last_end; // one past the token before
  Diag *diag;
  Words *words;
  Arena *arena;        // where the nodes go
  Vec(Node *) stack;   // kids being collected
  int nesting, blocks; // braces open; For, If and Macro open
  bool in_macro;
  bool has_macro;       // a Macro was met: the tree must be kept
  bool fatal;           // nested too deeply: stop parsing this text
  int stray_braces;     // after a syntax error: '}' that may still come
  bool merge_marks;     // <<<<<<< was met and reported
  uint32_t failed_word; // after a syntax error: the word the statement began with, or NONE
  jmp_buf *on_error;
  SrcLoc error_loc;
  Str error; // text of the syntax error
} Parser;

// Parse text[len], which diag knows as `file` and which, like words and diag, must outlive the parser.
void parser_init(Parser *p, Diag *diag, Words *words, uint32_t file, const char *text, size_t len);
void parser_free(Parser *p);

// What comes next at the top level. If and its kin are left to the caller, so that a branch not taken need
// not parse.
typedef enum { NEXT_STATEMENT, NEXT_IF, NEXT_ELSEIF, NEXT_ELSE, NEXT_ENDIF, NEXT_END } NextKind;

// Parse one statement at the top level into `arena`. NEXT_STATEMENT: *out is the statement, NULL after a
// syntax error, which was reported; the text up to the next ';' is then skipped. NEXT_IF, NEXT_ELSEIF: *out
// is the condition (NULL after an error). O(length).
NextKind parse_next(Parser *p, Arena *arena, Node **out);
// After a condition that is false: skip to the ElseIf, Else or EndIf that belongs to it, which becomes the
// next token; with to_end to the EndIf. false at the end of the text.
bool parse_skip_branch(Parser *p, bool to_end);

#endif
