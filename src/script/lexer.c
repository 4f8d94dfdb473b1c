// lexer.c - cuts a text into tokens
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/token.h"

#include "base/number.h"
#include "script/limits.h"

enum { BLANK = 1, DIGIT = 2, LETTER = 4, SIGN = 8 };

// clang-format off
static const unsigned char class_of[256] = {
  [' '] = BLANK, ['\t'] = BLANK, ['\r'] = BLANK, ['\f'] = BLANK, ['\v'] = BLANK, [0] = BLANK,
  ['0'] = DIGIT, DIGIT, DIGIT, DIGIT, DIGIT, DIGIT, DIGIT, DIGIT, DIGIT, DIGIT,
  ['A'] = LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER,
  LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER,
  ['a'] = LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER,
  LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER, LETTER,
  ['_'] = LETTER,
  ['+'] = SIGN, ['-'] = SIGN, ['*'] = SIGN, ['/'] = SIGN, ['%'] = SIGN, ['^'] = SIGN, ['('] = SIGN, [')'] = SIGN,
  ['['] = SIGN, [']'] = SIGN, ['{'] = SIGN, ['}'] = SIGN, [','] = SIGN, [';'] = SIGN, ['.'] = SIGN, ['#'] = SIGN,
  ['~'] = SIGN, ['!'] = SIGN, ['<'] = SIGN, ['>'] = SIGN, ['='] = SIGN, ['&'] = SIGN, ['|'] = SIGN, ['?'] = SIGN,
  [':'] = SIGN,
};
// clang-format on

static bool is(char c, int classes) { return class_of[(unsigned char)c] & classes; }

void lexer_init(Lexer *l, Words *words, uint32_t file, const char *text, size_t len)
{
  *l = (Lexer){.at = text, .end = text + len, .line_start = text, .file = file, .line = 1, .words = words};
  if (len >= 3 && !memcmp(text, "\xef\xbb\xbf", 3)) l->at = l->line_start = text + 3;
}

static SrcLoc place(const Lexer *l)
{
  return (SrcLoc){l->file, l->line, (uint32_t)(l->at - l->line_start) + 1};
}

static void new_line(Lexer *l)
{
  l->line++;
  l->line_start = l->at;
}

// Past blanks and comments. An unfinished comment is reported by returning false with at at its beginning.
static bool skip_blanks(Lexer *l)
{
  while (l->at < l->end) {
    char c = *l->at;
    if (is(c, BLANK)) {
      l->at++;
    } else if (c == '\n') {
      l->at++;
      new_line(l);
    } else if (c == '/' && l->at + 1 < l->end && l->at[1] == '/') {
      const char *eol = memchr(l->at, '\n', (size_t)(l->end - l->at));
      l->at = eol ? eol : l->end;
    } else if (c == '/' && l->at + 1 < l->end && l->at[1] == '*') {
      Lexer open = *l;
      for (l->at += 2;;) {
        if (l->end - l->at < 2) {
          *l = open;
          return false;
        }
        if (l->at[0] == '*' && l->at[1] == '/') break;
        if (*l->at++ == '\n') new_line(l);
      }
      l->at += 2;
    } else {
      return true;
    }
  }
  return true;
}

static Token bad(Lexer *l, Token t, const char *problem)
{
  t.kind = TOK_BAD;
  t.len = (size_t)(l->at - t.start);
  l->problem = problem;
  return t;
}

// The value of digits[.digits] without exponent: exact when the digits are an integer below 2^53 and the
// power of ten is exact too; otherwise left to number_read.
static double decimal_value(const char *s, const char *end, bool simple)
{
  static const double tens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  double v = 0;
  if (simple && end - s <= 17) {
    uint64_t m = 0;
    const char *dot = NULL;
    for (const char *p = s; p < end; p++) {
      if (*p == '.')
        dot = p;
      else
        m = 10 * m + (uint64_t)(*p - '0');
    }
    if (m <= (uint64_t)1 << 53) return dot ? (double)m / tens[end - dot - 1] : (double)m;
  }
  if (end[-1] == '.') end--;
  number_read(s, end, &v);
  return v;
}

static Token read_number(Lexer *l, Token t)
{
  const char *p = l->at;
  bool dot = false, simple = true;
  while (p < l->end && is(*p, DIGIT)) p++;
  if (p < l->end && *p == '.') { // "1..." is the range token after 1
    dot = !(l->end - p >= 3 && p[1] == '.' && p[2] == '.');
    if (dot) {
      p++;
      while (p < l->end && is(*p, DIGIT)) p++;
    }
  }
  if (p < l->end && (*p == 'e' || *p == 'E')) {
    const char *q = p + 1;
    if (q < l->end && (*q == '+' || *q == '-')) q++;
    if (q < l->end && is(*q, DIGIT)) {
      while (q < l->end && is(*q, DIGIT)) q++;
      p = q;
      simple = false;
    }
  }
  t.kind = TOK_NUMBER;
  t.len = (size_t)(p - l->at);
  t.number = decimal_value(l->at, p, simple);
  l->at = p;
  if (l->at < l->end && (is(*l->at, LETTER) || (*l->at == '.' && dot))) {
    while (l->at < l->end && (is(*l->at, LETTER | DIGIT) || *l->at == '.')) l->at++;
    return bad(l, t, "this is not a number");
  }
  return t;
}

static Token read_word(Lexer *l, Token t)
{
  const char *p = l->at;
  while (p < l->end && is(*p, LETTER | DIGIT)) p++;
  t.len = (size_t)(p - l->at);
  l->at = p;
  if (t.len > LIMIT_NAME) return bad(l, t, "this name is too long");
  t.kind = TOK_WORD;
  t.word = words_intern(l->words, t.start, t.len);
  return t.word == NONE ? bad(l, t, "too many different names") : t;
}

static Token read_string(Lexer *l, Token t)
{
  char quote = *l->at;
  Lexer open = *l;
  const char *p = memchr(l->at + 1, quote, (size_t)(l->end - l->at - 1));
  if (!p) {
    l->at = open.at + 1;
    return bad(l, t, "this string has no end");
  }
  for (l->at++; l->at < p;)
    if (*l->at++ == '\n') new_line(l);
  t.kind = TOK_STRING;
  t.start++;
  t.len = (size_t)(p - t.start);
  l->at = p + 1;
  return t.len > LIMIT_STRING ? bad(l, t, "this string is too long") : t;
}

static int double_token(char a, char b)
{
  switch (a) {
  case '+': return b == '=' ? TOK_ADD_TO : b == '+' ? TOK_INC : 0;
  case '-': return b == '=' ? TOK_SUB_FROM : b == '-' ? TOK_DEC : 0;
  case '*': return b == '=' ? TOK_MUL_BY : 0;
  case '/': return b == '=' ? TOK_DIV_BY : 0;
  case '=': return b == '=' ? TOK_EQ : 0;
  case '!': return b == '=' ? TOK_NE : 0;
  case '<': return b == '=' ? TOK_LE : b == '<' ? TOK_SHIFT_LEFT : 0;
  case '>': return b == '=' ? TOK_GE : b == '>' ? TOK_SHIFT_RIGHT : 0;
  case '&': return b == '&' ? TOK_AND : 0;
  case '|': return b == '|' ? TOK_OR : 0;
  case ':': return b == ':' ? TOK_SCOPE : 0;
  default: return 0;
  }
}

static const char *problem_of(char c)
{
  if ((unsigned char)c >= 128) return "letters beyond ASCII may stand in strings and comments only";
  if (c == '$' || c == '@') return "is this the placeholder of a template that was not filled in?";
  if (c == '\\') return "a backslash means nothing here; a comment begins with //";
  if (c == '`') return "a backquote means nothing here; strings stand in \"..\"";
  return "this character means nothing here";
}

static Token read_sign(Lexer *l, Token t)
{
  char c = *l->at;
  if (c == '.' && l->end - l->at >= 3 && l->at[1] == '.' && l->at[2] == '.') {
    l->at += 3;
    t.kind = TOK_RANGE;
    t.len = 3;
    return t;
  }
  int two = l->end - l->at >= 2 ? double_token(c, l->at[1]) : 0;
  t.len = two ? 2 : 1;
  l->at += t.len;
  t.kind = two ? two : c == ':' ? TOK_RANGE : c;
  if (!is(c, SIGN)) {
    while ((unsigned char)c >= 128 && l->at < l->end && (unsigned char)*l->at >= 128) l->at++;
    return bad(l, t, problem_of(c));
  }
  return t;
}

Token lexer_next(Lexer *l)
{
  bool complete = skip_blanks(l);
  Token t = {.kind = TOK_END, .loc = place(l), .start = l->at};
  if (!complete) {
    l->at = l->end;
    return bad(l, t, "this comment has no end");
  }
  if (l->at >= l->end) return t;
  char c = *l->at;
  if (is(c, LETTER)) return read_word(l, t);
  if (is(c, DIGIT) || (c == '.' && l->at + 1 < l->end && is(l->at[1], DIGIT))) return read_number(l, t);
  if (c == '"' || c == '\'') return read_string(l, t);
  return read_sign(l, t);
}
