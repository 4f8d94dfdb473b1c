// ply.c - writer and reader of PLY, ASCII and binary
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/surface_int.h"

void ply__write(Writer *w, const Selection *s, const OutOptions *o)
{
  writer_printf(w, "ply\nformat %s 1.0\nelement vertex %zu\nproperty double x\nproperty double y\nproperty double z\n"
                "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
                o->binary ? "binary_little_endian" : "ascii", s->nnode, s->nelem);
  if (!o->binary) {
    select__write_points(w, s, "");
    for (size_t i = 0; i < s->nblock; i++) surface__write_faces(w, s, &s->mesh->block[s->block[i]], NULL, 0);
    return;
  }
  for (size_t k = 0; k < s->nnode; k++) {
    const Vec3 x = select__xyz(s, k);
    memcpy(writer_reserve(w, sizeof x), &x, sizeof x);
    writer_commit(w, sizeof x);
  }
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    size_t n = (size_t)elem_corners(k->type);
    for (size_t j = 0; j < k->n; j++) {
      uint32_t v[4];
      for (size_t a = 0; a < n; a++) v[a] = s->number[k->node[j * n + a]];
      char *p = writer_reserve(w, 17);
      *p = (char)n;
      memcpy(p + 1, v, 4 * n);
      writer_commit(w, 1 + 4 * n);
    }
  }
}

// ---- reading ----------------------------------------------------------------------------------------------------------------------
enum { PLY_MAX_PROPERTIES = 64 };

typedef struct {
  int size, count;      // bytes; of the count if it is a list, else 0
  bool real, sign, csign;
  int role;             // 1, 2, 3: x, y, z; 4: the corners; 0: not wanted
} Property;

typedef struct {
  char name[32];
  int64_t n;
  int nproperty;
  Property property[PLY_MAX_PROPERTIES];
} Element;

static int ply_type(const char *word, bool *real, bool *sign)
{
  static const struct { const char *name; int size; bool real, sign; } types[] = {
      {"char", 1, false, true}, {"int8", 1, false, true}, {"uchar", 1, false, false}, {"uint8", 1, false, false},
      {"short", 2, false, true}, {"int16", 2, false, true}, {"ushort", 2, false, false}, {"uint16", 2, false, false},
      {"int", 4, false, true}, {"int32", 4, false, true}, {"uint", 4, false, false}, {"uint32", 4, false, false},
      {"float", 4, true, true}, {"float32", 4, true, true}, {"double", 8, true, true}, {"float64", 8, true, true},
  };
  for (size_t i = 0; i < ARRAY_LEN(types); i++) {
    if (strcmp(types[i].name, word) != 0) continue;
    *real = types[i].real;
    *sign = types[i].sign;
    return types[i].size;
  }
  return 0;
}

static double ply_number(Scan *s, int size, bool real, bool sign)
{
  if (!s->binary) return scan_double(s, "a number");
  const char *p = scan_bytes(s, (size_t)size, "a number");
  unsigned char b[8] = {0};
  for (int i = 0; p && i < size; i++) b[i] = (unsigned char)p[s->swap ? size - 1 - i : i];
  uint64_t u;
  memcpy(&u, b, 8);
  double v;
  float f;
  if (real && size == 8) {
    memcpy(&v, b, 8);
    return v;
  }
  if (real) {
    memcpy(&f, b, 4);
    return (double)f;
  }
  return sign ? (double)((int64_t)(u << (64 - 8 * size)) >> (64 - 8 * size)) : (double)u;
}

static void ply_property(Scan *s, Element *e)
{
  char word[64];
  bool ignored;
  if (e->nproperty == PLY_MAX_PROPERTIES) {
    scan_error(s, "more than %d properties", PLY_MAX_PROPERTIES);
    return;
  }
  Property *p = &e->property[e->nproperty++];
  *p = (Property){0};
  scan_word(s, word, sizeof word);
  if (strcmp(word, "list") == 0) {
    scan_word(s, word, sizeof word);
    p->count = ply_type(word, &ignored, &p->csign);
    if (!p->count || ignored) scan_error(s, "a list counted by '%s'", word);
    scan_word(s, word, sizeof word);
  }
  p->size = ply_type(word, &p->real, &p->sign);
  if (!p->size) scan_error(s, "a property of type '%s'", word);
  scan_word(s, word, sizeof word);
  if (!p->count && strlen(word) == 1 && word[0] >= 'x' && word[0] <= 'z') p->role = word[0] - 'x' + 1;
  if (p->count && (strcmp(word, "vertex_indices") == 0 || strcmp(word, "vertex_index") == 0)) p->role = 4;
}

// Returns the number of elements described.
static int ply_header(Scan *s, Element *e, int most)
{
  char word[64];
  int n = 0;
  bool binary = false;
  scan_word(s, word, sizeof word);
  if (strcmp(word, "ply") != 0) scan_error(s, "ply expected");
  for (scan_line(s); !s->failed; scan_line(s)) {
    scan_word(s, word, sizeof word);
    if (strcmp(word, "end_header") == 0) break;
    if (strcmp(word, "format") == 0) {
      scan_word(s, word, sizeof word);
      binary = strcmp(word, "ascii") != 0;
      s->swap = strcmp(word, "binary_big_endian") == 0;
    } else if (strcmp(word, "element") == 0 && n < most) {
      e[n] = (Element){.nproperty = 0};
      scan_word(s, e[n].name, sizeof e[n].name);
      e[n++].n = scan_range(s, 0, INT32_MAX, "count");
    } else if (strcmp(word, "property") == 0 && n) {
      ply_property(s, &e[n - 1]);
    } else if (!*word) {
      scan_error(s, "end_header expected");
    }
  }
  scan_line(s);
  s->binary = binary;
  return n;
}

// One vertex, face or other thing.
static void ply_item(Scan *s, Import *im, const Element *e, bool vertex, bool face)
{
  double x[3] = {0, 0, 0};
  for (int k = 0; k < e->nproperty && !s->failed; k++) {
    const Property *p = &e->property[k];
    double n = p->count ? ply_number(s, p->count, false, p->csign) : 1;
    if (!(n >= 0 && n <= 1e9)) {
      scan_error(s, "a list of %g things", n);
      return;
    }
    bool corners = face && p->role == 4;
    if (corners) surface__begin_face(im, (int64_t)n, 1, 0);
    for (int64_t i = 0; i < (int64_t)n && !s->failed; i++) {
      double v = ply_number(s, p->size, p->real, p->sign);
      if (corners) import_element_node(im, v >= 0 && v < 4e9 ? (uint64_t)v : UINT64_MAX);
      if (vertex && p->role >= 1 && p->role <= 3) x[p->role - 1] = v;
    }
  }
  if (!vertex || s->failed) return;
  if (!isfinite(x[0] + x[1] + x[2])) scan_error(s, "a coordinate is not finite");
  import_node(im, im->mesh->nnode, (Vec3){x[0], x[1], x[2]}, -1, 0, NAN);
}

Mesh *ply__read(Scan s)
{
  enum { MOST = 16 };
  Import im;
  import_begin(&im, &s);
  Element *e = mem_zalloc(MOST * sizeof *e);
  int n = ply_header(&s, e, MOST);
  for (int k = 0; k < n; k++) {
    bool vertex = strcmp(e[k].name, "vertex") == 0, face = strcmp(e[k].name, "face") == 0;
    if (!e[k].nproperty) continue;
    size_t count = scan_count(&s, e[k].n, 1, "elements");
    for (size_t i = 0; i < count && !s.failed; i++) ply_item(&s, &im, &e[k], vertex, face);
  }
  free(e);
  return import_finish(&im);
}
