// view.c - views: lists of points, segments, triangles and quadrangles with values, and the files they come from
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "size/field.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>

#include "base/file.h"
#include "base/number.h"
#include "size/field_int.h"
#include "size/size_int.h"

int view_begin(FieldSet *f, const char *name)
{
  View v = {.name = mem_strdup(name)};
  vec_push(&f->view, v);
  return (int)f->view.len - 1;
}

// ---- the list format ----------------------------------------------------------------------------------------------

// Corners by the second letter: of what a plane mesher can use; 3D elements are known and skipped.
static int shape_corners(char c)
{
  switch (c) {
  case 'P': return 1;
  case 'L': return 2;
  case 'T': return 3;
  case 'Q': return 4;
  case 'S': return -4;
  case 'H': return -8;
  case 'I': return -6;
  case 'Y': return -5;
  default: return 0;
  }
}

static int value_components(char c)
{
  return c == 'S' ? 1 : c == 'V' ? 3 : c == 'T' ? 9 : 0;
}

double size__of_value(const double *v, int n)
{
  double sum = 0;
  if (n == 1) return v[0];
  if (n == 9) {
    double l = size__largest_eigenvalue((double[6]){v[0], (v[1] + v[3]) / 2, (v[2] + v[6]) / 2, v[4], (v[5] + v[7]) / 2, v[8]}, false);
    return l > 0 ? 1 / sqrt(l) : 0;
  }
  for (int i = 0; i < n; i++) sum += v[i] * v[i];
  return sqrt(sum);
}

static void push_element(View *v, int corners, const double *xyz, const double *value, int components)
{
  ViewElement el = {(uint8_t)corners, (uint32_t)v->xyz.len};
  for (int i = 0; i < corners; i++) {
    vec_push(&v->xyz, ((Vec3){xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}));
    vec_push(&v->value, size__of_value(value + components * i, components));
  }
  vec_push(&v->element, el);
}

bool view_add_element(FieldSet *f, const char *type, const double *xyz, size_t nxyz, const double *value, size_t nvalue,
                      SrcLoc loc, Diag *diag)
{
  size_t len = strlen(type);
  int components = len >= 2 ? value_components(type[0]) : 0, corners = len >= 2 ? shape_corners(type[1]) : 0;
  if (!components || !corners || len > 3 || (len == 3 && type[2] != '2')) {
    diag_error(diag, loc, "unknown element type '%s' in a view", type);
    return false;
  }
  if (corners < 0) return true;
  // A second-order element ("ST2") has its corners first, which are enough for a size.
  size_t want = (size_t)corners * 3;
  if (nxyz < want || (len == 2 && nxyz != want)) {
    diag_error(diag, loc, "%s in a view needs %zu coordinates, not %zu", type, want, nxyz);
    return false;
  }
  if (nvalue < (size_t)(components * corners)) {
    diag_error(diag, loc, "%s in a view needs %d values, not %zu", type, components * corners, nvalue);
    return false;
  }
  CHECK(f->view.len > 0);
  push_element(&vec_last(&f->view), corners, xyz, value, components);
  return true;
}

// ---- .pos texts -----------------------------------------------------------------------------------------------------

typedef struct {
  const char *s, *end, *begin;
  uint32_t file;
  Diag *diag;
  FieldSet *f;
  DoubleVec xyz, value;
} Pos;

static SrcLoc pos_loc(const Pos *p)
{
  SrcLoc loc = {p->file, 1, 1};
  for (const char *c = p->begin; c < p->s; c++) {
    loc.col++;
    if (*c == '\n') loc.line++, loc.col = 1;
  }
  return loc;
}

static void skip_blanks(Pos *p)
{
  while (p->s < p->end) {
    if (isspace((unsigned char)*p->s)) {
      p->s++;
    } else if (p->s + 1 < p->end && p->s[0] == '/' && p->s[1] == '/') {
      while (p->s < p->end && *p->s != '\n') p->s++;
    } else if (p->s + 1 < p->end && p->s[0] == '/' && p->s[1] == '*') {
      p->s += 2;
      while (p->s < p->end && !(p->s[0] == '*' && p->s + 1 < p->end && p->s[1] == '/')) p->s++;
      p->s += p->s < p->end ? 2 : 0;
    } else {
      return;
    }
  }
}

static bool accept(Pos *p, char c)
{
  skip_blanks(p);
  if (p->s >= p->end || *p->s != c) return false;
  p->s++;
  return true;
}

static bool expect(Pos *p, char c)
{
  if (accept(p, c)) return true;
  if (p->s < p->end) diag_error(p->diag, pos_loc(p), "expected '%c' before '%c' in the view", c, *p->s);
  else diag_error(p->diag, pos_loc(p), "expected '%c' before the end of the view", c);
  return false;
}

static bool read_numbers(Pos *p, char close, DoubleVec *out)
{
  vec_clear(out);
  while (!accept(p, close)) {
    if (out->len && !expect(p, ',')) return false;
    skip_blanks(p);
    double v;
    const char *after = number_read(p->s, p->end, &v);
    if (after == p->s) return diag_error(p->diag, pos_loc(p), "expected a number in the view"), false;
    vec_push(out, v);
    p->s = after;
  }
  return true;
}

// Skip { ... } with nesting and strings, from before the brace.
static bool skip_braces(Pos *p)
{
  int depth = 0;
  for (skip_blanks(p); p->s < p->end; p->s++) {
    if (*p->s == '"') {
      const char *q = memchr(p->s + 1, '"', (size_t)(p->end - p->s - 1));
      if (!q) break;
      p->s = q;
    } else if (*p->s == '{') {
      depth++;
    } else if (*p->s == '}' && --depth == 0) {
      p->s++;
      return true;
    }
  }
  diag_error(p->diag, pos_loc(p), "unclosed '{' in the view");
  return false;
}

static size_t read_word(Pos *p, char *to, size_t cap)
{
  skip_blanks(p);
  size_t n = 0;
  while (p->s < p->end && (isalnum((unsigned char)*p->s) || *p->s == '_')) {
    if (n + 1 < cap) to[n++] = *p->s;
    p->s++;
  }
  to[n] = 0;
  return n;
}

static bool read_entry(Pos *p)
{
  char word[32];
  const char *at = p->s;
  if (!read_word(p, word, sizeof word)) return diag_error(p->diag, pos_loc(p), "expected an element in the view"), false;
  bool text = !strcmp(word, "T2") || !strcmp(word, "T3");
  if (text || !strcmp(word, "TIME") || !strcmp(word, "INTERPOLATION_SCHEME")) {
    if (text && (!expect(p, '(') || !read_numbers(p, ')', &p->xyz))) return false;
    return skip_braces(p) && expect(p, ';');
  }
  if (!expect(p, '(') || !read_numbers(p, ')', &p->xyz)) return false;
  if (!expect(p, '{') || !read_numbers(p, '}', &p->value) || !expect(p, ';')) return false;
  const char *end = p->s;
  p->s = at;
  skip_blanks(p);
  // The place is only computed for a message: count errors around the call instead of a line number per element.
  int corners = strlen(word) == 2 ? shape_corners(word[1]) : 0, comp = value_components(word[0]);
  bool plain = corners > 0 && comp && p->xyz.len == (size_t)corners * 3 && p->value.len >= (size_t)(corners * comp);
  bool good = true, solid = strlen(word) <= 3 && comp && word[1] && shape_corners(word[1]) < 0;
  if (solid) return p->s = end, true;
  if (plain) push_element(&vec_last(&p->f->view), corners, p->xyz.data, p->value.data, comp);
  else
    good = view_add_element(p->f, word, p->xyz.data, p->xyz.len, p->value.data, p->value.len, pos_loc(p), p->diag);
  p->s = end;
  return good;
}

static bool read_view(Pos *p)
{
  skip_blanks(p);
  if (p->s >= p->end || *p->s != '"') return expect(p, '"');
  const char *name = p->s + 1, *q = memchr(name, '"', (size_t)(p->end - name));
  if (!q) return diag_error(p->diag, pos_loc(p), "unclosed name of a view"), false;
  char *copy = mem_alloc((size_t)(q - name) + 1);
  memcpy(copy, name, (size_t)(q - name));
  copy[q - name] = 0;
  view_begin(p->f, copy);
  free(copy);
  p->s = q + 1;
  if (!expect(p, '{')) return false;
  while (!accept(p, '}'))
    if (!read_entry(p)) return false;
  accept(p, ';');
  return true;
}

bool views_read_pos(FieldSet *f, const char *name, const char *text, size_t len, Diag *diag)
{
  Pos p = {.s = text, .begin = text, .end = text + len, .diag = diag, .f = f};
  p.file = diag_add_file(diag, name, text, len, NO_LOC);
  bool good = true;
  char word[32];
  for (skip_blanks(&p); good && p.s < p.end; skip_blanks(&p)) {
    if (read_word(&p, word, sizeof word) && !strcmp(word, "View") && (skip_blanks(&p), p.s < p.end && *p.s == '"')) {
      good = read_view(&p);
      continue;
    }
    while (p.s < p.end && *p.s != ';') p.s++; // another statement: not ours
    p.s += p.s < p.end;
  }
  vec_free(&p.xyz);
  vec_free(&p.value);
  return good;
}

// ---- -bgm -----------------------------------------------------------------------------------------------------------

bool fields_read_background(FieldSet *f, const char *path, Diag *diag)
{
  size_t len;
  char *text = file_read(path, &len);
  if (!text) return diag_error(diag, NO_LOC, "cannot read '%s': %s", path, strerror(errno)), false;
  vec_push(&f->text, text); // messages may quote it
  size_t before = f->view.len;
  bool msh = len >= 11 && !memcmp(text, "$MeshFormat", 11);
  if (!(msh ? view__read_msh(f, path, text, len, diag) : views_read_pos(f, path, text, len, diag))) return false;
  if (f->view.len == before) return diag_error(diag, NO_LOC, "'%s' has no view to take sizes from", path), false;
  fields_set_background_view(f, (int)f->view.len - 1, NO_LOC);
  return true;
}
