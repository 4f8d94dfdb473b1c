// vtk_read.c - reader of legacy VTK files: unstructured grids and polygons, ASCII and binary, versions 1 to 5
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>
#include <strings.h>

#include "out/cells.h"
#include "out/out_int.h"

typedef struct {
  Scan *s;
  bool binary;     // the data are; keyword lines never
  Cells c;
  bool cell_data;  // within CELL_DATA, else POINT_DATA or neither
  size_t tuples;   // of the section
} Reader;

typedef struct {
  int bytes;       // 0: unknown
  bool real, sign;
} Type;

static Type type_named(const char *name)
{
  static const struct { const char *name; Type t; } types[] = {
      {"char", {1, false, true}}, {"unsigned_char", {1, false, false}}, {"short", {2, false, true}},
      {"unsigned_short", {2, false, false}}, {"int", {4, false, true}}, {"unsigned_int", {4, false, false}},
      {"long", {8, false, true}}, {"unsigned_long", {8, false, false}}, {"vtktypeint64", {8, false, true}},
      {"vtktypeuint64", {8, false, false}}, {"vtktypeint32", {4, false, true}}, {"vtkIdType", {8, false, true}},
      {"float", {4, true, true}}, {"double", {8, true, true}},
  };
  for (size_t i = 0; i < ARRAY_LEN(types); i++)
    if (strcasecmp(types[i].name, name) == 0) return types[i].t;
  return (Type){0, false, false};
}

// One number of binary data, which are big-endian.
static double decode(const unsigned char *p, Type t, int64_t *integer)
{
  uint64_t v = 0;
  for (int i = 0; i < t.bytes; i++) v = v << 8 | p[i];
  if (t.real && t.bytes == 8) {
    double d;
    memcpy(&d, &v, sizeof d);
    return d;
  }
  if (t.real) {
    uint32_t u = (uint32_t)v;
    float f;
    memcpy(&f, &u, sizeof f);
    return (double)f;
  }
  int shift = 64 - 8 * t.bytes;
  *integer = t.sign ? (int64_t)(v << shift) >> shift : (int64_t)v;
  return (double)*integer;
}

// n numbers: to integers, to doubles, or nowhere.
static void read_array(Reader *r, size_t n, Type t, int64_t *ints, double *reals)
{
  Scan *s = r->s;
  if (!r->binary) {
    for (size_t i = 0; i < n && !s->failed; i++)
      if (ints && !t.real) {
        ints[i] = scan_i64(s, "an integer");
      } else {
        double v = scan_double(s, "a number");
        if (reals) reals[i] = v;
        if (ints) ints[i] = fabs(v) < 1e15 ? (int64_t)v : 0;
      }
    return;
  }
  const unsigned char *p = (const unsigned char *)scan_bytes(s, n * (size_t)t.bytes, "an array");
  for (size_t i = 0; p && i < n && (ints || reals); i++, p += t.bytes) {
    int64_t v = 0;
    double d = decode(p, t, &v);
    if (reals) reals[i] = d;
    if (ints) ints[i] = t.real ? (fabs(d) < 1e15 ? (int64_t)d : 0) : v;
  }
}

static size_t array_count(Reader *r, int64_t n, Type t, const char *what)
{
  return scan_count(r->s, n, r->binary ? (size_t)t.bytes : 2, what);
}

static Type read_type(Reader *r)
{
  char word[64];
  scan_word(r->s, word, sizeof word);
  Type t = type_named(word);
  if (!t.bytes) scan_error(r->s, "data type '%s' is not read", word);
  return t;
}

static void read_points(Reader *r)
{
  int64_t n = scan_range(r->s, 0, INT32_MAX, "number of points");
  Type t = read_type(r);
  scan_line(r->s);
  size_t k = r->s->failed ? 0 : array_count(r, 3 * n, t, "coordinates");
  vec_resize(&r->c.point, k);
  read_array(r, k, t, NULL, r->c.point.data);
}

// "CELLS n size" with counts among the indices, or since 5.0 two arrays, OFFSETS and CONNECTIVITY. Polygons alike.
static void read_cells(Reader *r, int64_t type)
{
  Scan *s = r->s;
  int64_t n = scan_range(s, 0, INT64_MAX / 16, "number of cells"), size = scan_range(s, 0, INT64_MAX / 16, "size of the cells");
  scan_line(s);
  const char *at = s->p;
  char word[32];
  scan_word(s, word, sizeof word);
  size_t first = r->c.offset.len ? r->c.offset.len - 1 : 0, base = r->c.connectivity.len;
  if (strcasecmp(word, "OFFSETS") == 0) {
    Type t = read_type(r);
    scan_line(s);
    size_t k = s->failed ? 0 : array_count(r, n, t, "offsets");
    vec_resize(&r->c.offset, first + k);
    read_array(r, k, t, r->c.offset.data + first, NULL);
    for (size_t i = first; i < first + k; i++) r->c.offset.data[i] += (int64_t)base;
    scan_word(s, word, sizeof word);
    if (!s->failed && strcasecmp(word, "CONNECTIVITY") != 0) scan_error(s, "CONNECTIVITY expected");
    t = read_type(r);
    scan_line(s);
    size = (int64_t)(s->failed ? 0 : array_count(r, size, t, "indices"));
    vec_resize(&r->c.connectivity, base + (size_t)size);
    read_array(r, (size_t)size, t, r->c.connectivity.data + base, NULL);
    n--;
  } else {
    Type t = {4, false, true};
    s->p = at;
    size_t k = array_count(r, size, t, "indices");
    int64_t *flat = mem_alloc(k * sizeof *flat);
    read_array(r, k, t, flat, NULL);
    if (!r->c.offset.len) vec_push(&r->c.offset, 0);
    size_t p = 0;
    for (int64_t i = 0; i < n && !s->failed; i++) {
      if (p >= k || flat[p] < 0 || (uint64_t)flat[p] > k - p - 1) {
        scan_error(s, "cell %lld does not fit in the %zu numbers of CELLS", (long long)i, k);
        break;
      }
      for (int64_t j = 0; j < flat[p]; j++) vec_push(&r->c.connectivity, flat[p + 1 + (size_t)j]);
      vec_push(&r->c.offset, (int64_t)r->c.connectivity.len);
      p += 1 + (size_t)flat[p];
    }
    free(flat);
  }
  for (int64_t i = 0; type && i < n && !s->failed; i++) vec_push(&r->c.type, type);
}

static void read_types(Reader *r)
{
  Type t = {4, false, true};
  int64_t n = scan_i64(r->s, "number of cells");
  scan_line(r->s);
  size_t k = array_count(r, n, t, "cell types");
  vec_resize(&r->c.type, k);
  read_array(r, k, t, r->c.type.data, NULL);
}

// An array of attributes: kept if it holds groups or entities of cells.
static void read_attribute(Reader *r, const char *name, size_t components, size_t tuples, Type t)
{
  Scan *s = r->s;
  if (s->failed || !t.bytes) return;
  if (components > 1000) {
    scan_error(s, "%zu components", components);
    return;
  }
  size_t n = array_count(r, (int64_t)(components * tuples), t, "values");
  int kind = r->cell_data && components == 1 ? cells_array_kind(name) : 0;
  int64_t *to = NULL;
  if (kind == 1) {
    vec_resize(&r->c.group, n);
    to = r->c.group.data;
  } else if (kind == 2) {
    vec_resize(&r->c.entity, n);
    to = r->c.entity.data;
  } else if (kind == 3) {
    vec_resize(&r->c.part, n);
    to = r->c.part.data;
  }
  read_array(r, n, t, to, NULL);
}

static void read_scalars(Reader *r)
{
  Scan *s = r->s;
  char name[128], word[128];
  scan_word(s, name, sizeof name);
  Type t = read_type(r);
  const char *from = s->p, *to;
  int64_t components = 1;
  scan_line(s);
  to = s->p;
  while (from < to && (unsigned char)*from <= ' ') from++;
  if (from < to) number_read_i64(from, to, &components);
  const char *at = s->p;
  scan_word(s, word, sizeof word);
  if (strcasecmp(word, "LOOKUP_TABLE") == 0)
    scan_line(s);
  else
    s->p = at;
  read_attribute(r, name, (size_t)MAX(components, (int64_t)0), r->tuples, t);
}

static void read_field(Reader *r)
{
  Scan *s = r->s;
  char name[128];
  scan_word(s, name, sizeof name);
  int64_t arrays = scan_range(s, 0, 100000, "number of arrays");
  for (int64_t i = 0; i < arrays && !s->failed; i++) {
    scan_word(s, name, sizeof name);
    if (strcasecmp(name, "METADATA") == 0) { // a block that ends with an empty line
      const char *a, *b;
      scan_line(s);
      while (scan_get_line(s, &a, &b) && a < b) continue;
      i--;
      continue;
    }
    int64_t components = scan_range(s, 0, 1000000, "number of components"), tuples = scan_range(s, 0, INT32_MAX, "number of tuples");
    Type t = read_type(r);
    scan_line(s);
    read_attribute(r, name, (size_t)components, (size_t)tuples, t);
  }
}

// Attributes of known sizes that are not kept.
static bool read_other(Reader *r, const char *word)
{
  static const struct { const char *word; size_t components; } other[] = {{"VECTORS", 3}, {"NORMALS", 3}, {"TENSORS", 9}};
  char name[128];
  for (size_t i = 0; i < ARRAY_LEN(other); i++) {
    if (strcasecmp(word, other[i].word) != 0) continue;
    scan_word(r->s, name, sizeof name);
    Type t = read_type(r);
    scan_line(r->s);
    read_attribute(r, "", other[i].components, r->tuples, t);
    return true;
  }
  return false;
}

static void read_keyword(Reader *r, const char *word)
{
  Scan *s = r->s;
  const char *a, *b;
  if (strcasecmp(word, "POINTS") == 0)
    read_points(r);
  else if (strcasecmp(word, "CELLS") == 0)
    read_cells(r, 0);
  else if (strcasecmp(word, "CELL_TYPES") == 0)
    read_types(r);
  else if (strcasecmp(word, "VERTICES") == 0)
    read_cells(r, 2);
  else if (strcasecmp(word, "LINES") == 0)
    read_cells(r, 4);
  else if (strcasecmp(word, "POLYGONS") == 0)
    read_cells(r, 7);
  else if (strcasecmp(word, "CELL_DATA") == 0 || strcasecmp(word, "POINT_DATA") == 0) {
    r->cell_data = strcasecmp(word, "CELL_DATA") == 0;
    r->tuples = (size_t)scan_range(s, 0, INT32_MAX, "number of values");
    scan_line(s);
  } else if (strcasecmp(word, "SCALARS") == 0)
    read_scalars(r);
  else if (strcasecmp(word, "FIELD") == 0)
    read_field(r);
  else if (strcasecmp(word, "METADATA") == 0) {
    scan_line(s);
    while (scan_get_line(s, &a, &b) && a < b) continue;
  } else if (!read_other(r, word))
    scan_error(s, "keyword '%s' is not read", word);
}

Mesh *vtk__read(Scan s)
{
  Reader r = {.s = &s};
  Import im;
  char word[128];
  const char *from, *to;
  import_begin(&im, &s);
  if (scan_left(&s) < 14 || memcmp(s.p, "# vtk DataFile", 14) != 0) scan_error(&s, "this is no legacy VTK file");
  scan_line(&s);
  scan_line(&s);
  if (!s.failed && scan_get_line(&s, &from, &to)) r.binary = to - from == 6 && strncasecmp(from, "BINARY", 6) == 0;
  scan_word(&s, word, sizeof word);
  if (!s.failed && strcasecmp(word, "DATASET") != 0) scan_error(&s, "DATASET expected");
  scan_word(&s, word, sizeof word);
  if (!s.failed && strcasecmp(word, "UNSTRUCTURED_GRID") != 0 && strcasecmp(word, "POLYDATA") != 0)
    scan_error(&s, "data set '%s' is not read (UNSTRUCTURED_GRID and POLYDATA are)", word);
  for (scan_word(&s, word, sizeof word); *word && !s.failed; scan_word(&s, word, sizeof word)) read_keyword(&r, word);
  if (!s.failed)
    cells_import(&r.c, &im);
  else
    cells_free(&r.c);
  return import_finish(&im);
}
