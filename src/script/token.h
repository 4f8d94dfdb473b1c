// token.h - words, tokens, and the lexer that cuts a text into them
// SPDX-License-Identifier: MIT
#ifndef SCRIPT_TOKEN_H
#define SCRIPT_TOKEN_H

#include "base/base.h"
#include "base/diag.h"
#include "base/mem.h"

// The keywords; their ids are the first of every word table. A SYNONYM's id is not used: it reads as its
// meaning.
typedef enum {
#define RESERVED(word) KW_##word,
#define SOFT(word) KW_##word,
#define SYNONYM(word, meaning) SPELLING_##word,
#include "script/keywords.def"
#undef RESERVED
#undef SOFT
#undef SYNONYM
  KW_COUNT // also: no word
} Keyword;

// May the word be no name of a variable?
bool keyword_reserved(uint32_t word);

// Interned identifiers: equal texts have equal ids, counted from 0 in order of first appearance, keywords
// first.
typedef struct {
  Vec(char *) text;
  U32Vec hash;
  uint32_t *slot;
  size_t cap;
  Arena arena;
} Words;

// With the keywords; release with words_free.
void words_init(Words *w);
void words_free(Words *w);
// Id of s[n]; synonyms give the id of their meaning. NONE if LIMIT_SYMBOLS words are known. Expected O(n).
uint32_t words_intern(Words *w, const char *s, size_t n);
// As above, but NONE for a word not seen before.
uint32_t words_find(const Words *w, const char *s, size_t n);
static inline const char *words_text(const Words *w, uint32_t id) { return w->text.data[id]; }

// Kinds above 255; a single-character token is its character.
typedef enum {
  TOK_END = 256,
  TOK_NUMBER,
  TOK_WORD,
  TOK_STRING,
  TOK_BAD,
  TOK_RANGE, // ':' or "..."
  TOK_SCOPE, // ::
  TOK_ADD_TO,
  TOK_SUB_FROM,
  TOK_MUL_BY,
  TOK_DIV_BY, // += -= *= /=
  TOK_INC,
  TOK_DEC,
  TOK_EQ,
  TOK_NE,
  TOK_LE,
  TOK_GE,
  TOK_AND,
  TOK_OR,
  TOK_SHIFT_LEFT,
  TOK_SHIFT_RIGHT,
} TokenKind;

typedef struct {
  int kind;
  SrcLoc loc;
  uint32_t word;     // TOK_WORD: id
  double number;     // TOK_NUMBER
  const char *start; // its text; of a TOK_STRING without the quotes
  size_t len;
} Token;

// Reads [at, end). Copying a Lexer saves its place.
typedef struct {
  const char *at, *end, *line_start;
  uint32_t file, line;
  Words *words;
  const char *problem; // of the last TOK_BAD: what is wrong
} Lexer;

// text must outlive the lexer. Bytes above 127 may stand in strings and comments only. A byte order mark is
// skipped.
void lexer_init(Lexer *l, Words *words, uint32_t file, const char *text, size_t len);
// The next token; TOK_END for ever at the end. Amortized O(length).
Token lexer_next(Lexer *l);

#endif
