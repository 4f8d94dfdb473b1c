// surface.c - OFF, OBJ, PLY and STL: the elements of dimension 2 alone, written and read
// SPDX-License-Identifier: MIT
//
// Written here and not by a library: the one at hand passes coordinates through single precision and does not end on some
// damaged files. It reads ours in the tests.
#include "base/base.h"

#include <math.h>
#include <strings.h>

#include "base/str.h"
#include "out/import.h"
#include "out/out_int.h"

const char *surface__refuses(const Selection *s)
{
  for (size_t i = 0; i < s->nblock; i++)
    if (elem_order(s->mesh->block[s->block[i]].type) > 1) return "surface formats hold elements of order 1 only";
  return NULL;
}

// ---- writing --------------------------------------------------------------------------------------------------------------------
// With a prefix on each line.
typedef struct {
  const Selection *s;
  const char *prefix;
} PointItems;

static char *put_points(char *p, const void *ctx, size_t from, size_t to)
{
  const PointItems *t = ctx;
  size_t n = strlen(t->prefix);
  for (size_t k = from; k < to; k++) p = put_char(put_xyz((char *)memcpy(p, t->prefix, n) + n, select__xyz(t->s, k)), '\n');
  return p;
}

static void write_points(Writer *w, const Selection *s, const char *prefix)
{
  writer_items(w, s->nnode, 4 * NUMBER_MAX_TEXT, put_points, &(PointItems){s, prefix});
}

typedef struct {
  const Selection *s;
  const MeshBlock *block;
  const char *prefix;
  uint64_t base;
} FaceItems;

static char *put_faces(char *p, const void *ctx, size_t from, size_t to)
{
  const FaceItems *t = ctx;
  size_t n = (size_t)elem_corners(t->block->type);
  const uint32_t *node = t->block->node + from * n;
  for (size_t i = from; i < to; i++) {
    p = t->prefix ? put_char(p, t->prefix[0]) : put_u64(p, n);
    for (size_t a = 0; a < n; a++) p = put_u64(put_char(p, ' '), t->s->number[*node++] + t->base);
    p = put_char(p, '\n');
  }
  return p;
}

// "3 a b c" lines, or with a prefix in place of the count.
static void write_faces(Writer *w, const Selection *s, const MeshBlock *k, const char *prefix, uint64_t base)
{
  writer_items(w, k->n, 4 * NUMBER_MAX_TEXT, put_faces, &(FaceItems){s, k, prefix, base});
}

void off__write(Writer *w, const Selection *s, const OutOptions *o)
{
  (void)o;
  writer_printf(w, "OFF\n%zu %zu 0\n", s->nnode, s->nelem);
  write_points(w, s, "");
  for (size_t i = 0; i < s->nblock; i++) write_faces(w, s, &s->mesh->block[s->block[i]], NULL, 0);
}

static const MeshGroup *first_group(const Selection *s, const MeshBlock *k)
{
  const MeshEntity *e = &s->mesh->entity[k->entity];
  return e->physical.len ? mesh_find_group(s->mesh, e->dim, abs(e->physical.data[0])) : NULL;
}

void obj__write(Writer *w, const Selection *s, const OutOptions *o)
{
  (void)o;
  write_points(w, s, "v ");
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    const MeshGroup *g = first_group(s, k);
    char name[256];
    if (g) select__group_name(g, name, sizeof name);
    if (g) writer_printf(w, "g %s\n", name);
    write_faces(w, s, k, "f", 1);
  }
}

void ply__write(Writer *w, const Selection *s, const OutOptions *o)
{
  writer_printf(w, "ply\nformat %s 1.0\nelement vertex %zu\nproperty double x\nproperty double y\nproperty double z\n"
                "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
                o->binary ? "binary_little_endian" : "ascii", s->nnode, s->nelem);
  if (!o->binary) {
    write_points(w, s, "");
    for (size_t i = 0; i < s->nblock; i++) write_faces(w, s, &s->mesh->block[s->block[i]], NULL, 0);
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

// ---- STL: every facet with its normal and its corners in full --------------------------------------------------------------------
// Normals have single precision, in the text too.
typedef struct {
  float x, y, z;
} Normal;

static inline Normal normal_of(const Vec3 p[3])
{
  Vec3 n = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
  double len = vec3_length(n), f = len > 0 ? 1 / len : 0;
  return (Normal){(float)(f * n.x) + 0, (float)(f * n.y) + 0, (float)(f * n.z) + 0}; // + 0: no -0
}

// What is printed again and again: the corners' text, of which corner k has text[start[k]..start[k+1]-1].
typedef struct {
  char *text;
  size_t *start;
} CornerTexts;

static CornerTexts corner_texts(const Selection *s)
{
  CornerTexts t;
  enum { LINE = 3 * NUMBER_MAX_TEXT + 16 };
  size_t cap = LINE, used = 0;
  t.text = mem_alloc(cap);
  t.start = mem_alloc((s->nnode + 1) * sizeof *t.start);
  for (size_t k = 0; k < s->nnode; k++) {
    if (cap - used < LINE) mem_grow(&t.text, &cap, cap + LINE, 1);
    t.start[k] = used;
    used = (size_t)(put_char(put_xyz((char *)memcpy(t.text + used, "    vertex ", 11) + 11, select__xyz(s, k)), '\n') - t.text);
  }
  t.start[s->nnode] = used;
  return t;
}

static void corner_texts_free(CornerTexts *t)
{
  free(t->text);
  free(t->start);
}

// Facets of a block; quadrangles are split along their first diagonal.
typedef struct {
  const Selection *s;
  const MeshBlock *block;
  const CornerTexts *corner; // NULL for binary
} FacetItems;

static size_t facets_of(const MeshBlock *k) { return k->n * (size_t)(elem_corners(k->type) - 2); }

// Corners of facet i, by their place in the file.
static inline void facet_corners(const FacetItems *t, size_t i, size_t corners, uint32_t node[3])
{
  const uint32_t *number = t->s->number, *v = t->block->node + (corners == 3 ? i : i / 2) * corners;
  size_t half = corners == 3 ? 0 : i % 2;
  node[0] = number[v[0]];
  node[1] = number[v[1 + half]];
  node[2] = number[v[2 + half]];
}

static inline Normal facet_normal(const Selection *s, const uint32_t node[3], Vec3 x[3])
{
  for (int i = 0; i < 3; i++) x[i] = select__xyz(s, node[i]);
  return normal_of(x);
}

static char *put_facets(char *p, const void *ctx, size_t from, size_t to)
{
  const FacetItems *t = ctx;
  Normal last = {NAN, 0, 0};
  char head[128]; // of the last facet: its neighbours often lie in the same plane
  size_t head_len = 0, corners = (size_t)elem_corners(t->block->type);
  for (size_t f = from; f < to; f++) {
    uint32_t node[3];
    Vec3 x[3];
    facet_corners(t, f, corners, node);
    Normal n = facet_normal(t->s, node, x);
    if (memcmp(&n, &last, sizeof n) != 0) {
      last = n;
      head_len = (size_t)snprintf(head, sizeof head, "facet normal %g %g %g\n  outer loop\n", (double)n.x, (double)n.y, (double)n.z);
    }
    p = (char *)memcpy(p, head, head_len) + head_len;
    for (int i = 0; i < 3; i++) {
      size_t begin = t->corner->start[node[i]], len = t->corner->start[node[i] + 1] - begin;
      p = (char *)memcpy(p, t->corner->text + begin, len) + len;
    }
    p = (char *)memcpy(p, "  endloop\nendfacet\n", 19) + 19;
  }
  return p;
}

static char *put_binary_facets(char *p, const void *ctx, size_t from, size_t to)
{
  const FacetItems *t = ctx;
  size_t corners = (size_t)elem_corners(t->block->type);
  for (size_t i = from; i < to; i++, p += 50) {
    uint32_t node[3];
    Vec3 x[3];
    facet_corners(t, i, corners, node);
    Normal n = facet_normal(t->s, node, x);
    const float f[12] = {n.x, n.y, n.z, (float)x[0].x, (float)x[0].y, (float)x[0].z, (float)x[1].x, (float)x[1].y, (float)x[1].z,
                         (float)x[2].x, (float)x[2].y, (float)x[2].z};
    memcpy(p, f, 48);
    p[48] = p[49] = 0;
  }
  return p;
}

static void stl_binary(Writer *w, const Selection *s)
{
  char head[80] = "meshgen";
  uint32_t n = 0;
  for (size_t i = 0; i < s->nblock; i++) n += (uint32_t)facets_of(&s->mesh->block[s->block[i]]);
  writer_bytes(w, head, sizeof head);
  writer_bytes(w, &n, sizeof n);
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    writer_items(w, facets_of(k), 50, put_binary_facets, &(FacetItems){s, k, NULL});
  }
}

void stl__write(Writer *w, const Selection *s, const OutOptions *o)
{
  if (o->binary) {
    stl_binary(w, s);
    return;
  }
  char name[256] = "meshgen", last[256] = "";
  enum { ROOM = 800 }; // of a facet
  CornerTexts corner = corner_texts(s);
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    const MeshGroup *g = first_group(s, k);
    if (o->stl_solids == 1) snprintf(name, sizeof name, "Surface%d", s->mesh->entity[k->entity].tag);
    if (o->stl_solids == 2 && g) select__group_name(g, name, sizeof name);
    if (strcmp(name, last) != 0) {
      if (i) writer_printf(w, "endsolid %s\n", last);
      writer_printf(w, "solid %s\n", name);
      memcpy(last, name, sizeof last);
    }
    writer_items(w, facets_of(k), ROOM, put_facets, &(FacetItems){s, k, &corner});
  }
  corner_texts_free(&corner);
  writer_printf(w, "%sendsolid %s\n", s->nblock ? "" : "solid meshgen\n", name);
}

// ---- reading ----------------------------------------------------------------------------------------------------------------------
static void face_begin(Import *im, int64_t corners, int entity, int group)
{
  if (corners != 3 && corners != 4)
    scan_error(im->s, "a face of %lld corners (3 and 4 are read)", (long long)corners);
  else
    import_element(im, corners == 3 ? ELEM_TRI3 : ELEM_QUAD4, entity, group);
}

// The next line that is neither empty nor a comment.
static bool next_line(Scan *s, const char **from, const char **to)
{
  while (scan_get_line(s, from, to))
    if (*from < *to && **from != '#') return true;
  return false;
}

Mesh *off__read(Scan s)
{
  Import im;
  const char *from, *to;
  import_begin(&im, &s);
  if (!next_line(&s, &from, &to) || to - from < 3 || memcmp(from, "OFF", 3) != 0) scan_error(&s, "OFF expected");
  else if (to - from > 3) s.p = from + 3; // the counts are on the same line
  while (!s.failed) { // to the counts
    const char *p = s.p;
    scan_space(&s);
    if (s.p < s.end && *s.p == '#') scan_line(&s);
    else if (s.p == p || s.p >= s.end || *s.p != '#') break;
  }
  size_t nodes = scan_count(&s, scan_i64(&s, "the number of points"), 5, "points");
  size_t faces = scan_count(&s, scan_i64(&s, "the number of faces"), 5, "faces");
  scan_line(&s);
  import_reserve_nodes(&im, nodes);
  for (size_t i = 0; i < nodes && !s.failed; i++) {
    double x[3];
    for (int k = 0; k < 3; k++) x[k] = scan_double(&s, "a coordinate");
    scan_line(&s); // normals and colours
    import_node(&im, i, (Vec3){x[0], x[1], x[2]}, -1, 0, NAN);
  }
  for (size_t f = 0; f < faces && !s.failed; f++) {
    int64_t n = scan_i64(&s, "a number of corners");
    face_begin(&im, n, 1, 0);
    for (int64_t k = 0; k < n && !s.failed; k++) import_element_node(&im, (uint64_t)scan_i64(&s, "a corner"));
    scan_line(&s);
  }
  return import_finish(&im);
}

// "f a b c", "f a/t b/t c/t", "f a//n ...", indices from 1 or from the end if negative.
static void obj_face(Import *im, Scan *s, const char *p, const char *to, int entity, int group)
{
  int64_t v[4], n = 0;
  while (p < to && !s->failed) {
    while (p < to && (unsigned char)*p <= ' ') p++;
    if (p == to) break;
    int64_t k = 0;
    const char *q = number_read_i64(p, to, &k);
    if (q == p || n == 4) {
      scan_error(s, q == p ? "a corner expected" : "a face of more than 4 corners");
      return;
    }
    v[n++] = k < 0 ? (int64_t)im->mesh->nnode + k + 1 : k;
    for (p = q; p < to && (unsigned char)*p > ' ';) p++;
  }
  face_begin(im, n, entity, group);
  for (int64_t k = 0; k < n && !s->failed; k++) import_element_node(im, (uint64_t)v[k]);
}

Mesh *obj__read(Scan s)
{
  Import im;
  const char *from, *to;
  int group = 0;
  import_begin(&im, &s);
  while (!s.failed && next_line(&s, &from, &to)) {
    bool blank = to - from > 1 && (from[1] == ' ' || from[1] == '\t');
    if (blank && from[0] == 'v') {
      Scan line = s;
      double x[3];
      line.p = from + 1;
      line.end = to;
      for (int k = 0; k < 3; k++) x[k] = scan_double(&line, "a coordinate");
      s.failed = line.failed;
      import_node(&im, im.mesh->nnode + 1, (Vec3){x[0], x[1], x[2]}, -1, 0, NAN);
    } else if (blank && from[0] == 'f') {
      obj_face(&im, &s, from + 1, to, MAX(group, 1), group);
    } else if (blank && from[0] == 'g') {
      char label[256];
      const char *p = from + 1;
      while (p < to && (unsigned char)*p <= ' ') p++;
      snprintf(label, sizeof label, "%.*s", (int)(to - p), p);
      group = *label ? import_group_named(&im, 2, label) : 0;
    }
  }
  if (!s.failed && !im.mesh->nnode) scan_error(&s, "no line begins with v");
  return import_finish(&im);
}

// ---- PLY --------------------------------------------------------------------------------------------------------------------------
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
    if (corners) face_begin(im, (int64_t)n, 1, 0);
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

// ---- STL --------------------------------------------------------------------------------------------------------------------------
// Points of equal coordinates are one: buckets of equal hash, chained.
typedef struct {
  Map first;
  U32Vec next;
} PointMap;

static uint32_t point_of(PointMap *map, Import *im, Vec3 x)
{
  double c[3] = {x.x + 0.0, x.y + 0.0, x.z + 0.0};
  uint64_t b[3], h = 0;
  bool added;
  memcpy(b, c, sizeof b);
  for (int i = 0; i < 3; i++) h = (h ^ b[i] ^ b[i] >> 31) * 0x9e3779b97f4a7c15u;
  uint32_t *slot = map_slot(&map->first, h >> 1, NONE, &added);
  for (uint32_t k = *slot; k != NONE; k = map->next.data[k]) {
    Vec3 y = mesh_xyz(im->mesh, k);
    if (x.x == y.x && x.y == y.y && x.z == y.z) return k;
  }
  uint32_t k = (uint32_t)im->mesh->nnode;
  vec_push(&map->next, *slot);
  *slot = k;
  import_node(im, k, x, -1, 0, NAN);
  return k;
}

static void add_facet(PointMap *map, Import *im, const Vec3 p[3], int solid, int group)
{
  uint32_t v[3];
  if (im->s->failed) return;
  for (int i = 0; i < 3; i++) {
    if (!isfinite(p[i].x + p[i].y + p[i].z)) scan_error(im->s, "a coordinate is not finite");
    if (im->s->failed) return;
    v[i] = point_of(map, im, p[i]);
  }
  import_element(im, ELEM_TRI3, solid, group);
  for (int i = 0; i < 3; i++) import_element_node(im, v[i]);
}

static void read_stl_binary(Scan *s, Import *im, PointMap *map)
{
  s->binary = true;
  scan_bytes(s, 80, "the header");
  size_t n = scan_count(s, (int64_t)(uint32_t)scan_b32(s, "the number of facets"), 50, "facets");
  for (size_t i = 0; i < n && !s->failed; i++) {
    float f[12];
    Vec3 p[3];
    memcpy(f, scan_bytes(s, 50, "a facet"), sizeof f);
    for (int k = 0; k < 3; k++) p[k] = (Vec3){(double)f[3 + 3 * k], (double)f[4 + 3 * k], (double)f[5 + 3 * k]};
    add_facet(map, im, p, 1, 0);
  }
}

// Each solid is an entity; where there are several, each is a group of its name.
static void read_stl_text(Scan *s, Import *im, PointMap *map, size_t solids)
{
  char word[64];
  int solid = 0, group = 0;
  for (scan_word(s, word, sizeof word); *word && !s->failed; scan_word(s, word, sizeof word)) {
    if (strcasecmp(word, "solid") == 0) {
      const char *from, *to;
      char label[256];
      solid++;
      if (!scan_get_line(s, &from, &to)) break;
      snprintf(label, sizeof label, "%.*s", (int)(to - from), from);
      group = solids > 1 && *label ? import_group_named(im, 2, label) : 0;
    } else if (strcasecmp(word, "facet") == 0) {
      Vec3 p[3];
      scan_line(s);
      scan_line(s); // outer loop
      for (int i = 0; i < 3 && !s->failed; i++) {
        scan_word(s, word, sizeof word);
        if (strcasecmp(word, "vertex") != 0) scan_error(s, "vertex expected, found '%s'", word);
        double x = scan_double(s, "a coordinate"), y = scan_double(s, "a coordinate"), z = scan_double(s, "a coordinate");
        p[i] = (Vec3){x, y, z};
      }
      add_facet(map, im, p, MAX(solid, 1), group);
    } else if (strcasecmp(word, "endsolid") == 0) {
      scan_line(s);
    } else if (strcasecmp(word, "endloop") != 0 && strcasecmp(word, "endfacet") != 0) {
      scan_error(s, "'%s' is not known", word);
    }
  }
}

static size_t count_solids(Scan s)
{
  size_t n = 0;
  for (; s.p < s.end; scan_line(&s))
    if (scan_left(&s) > 5 && strncasecmp(s.p, "solid", 5) == 0) n++;
  return n;
}

Mesh *stl__read(Scan s)
{
  Import im;
  PointMap map = {0};
  import_begin(&im, &s);
  // Binary files may begin with "solid" too; their length tells.
  uint32_t n = 0;
  size_t len = scan_left(&s);
  if (len >= 84) memcpy(&n, s.p + 80, sizeof n);
  bool binary = len < 5 || strncasecmp(s.p, "solid", 5) != 0 || (len >= 84 && len == 84 + 50 * (size_t)n);
  if (binary)
    read_stl_binary(&s, &im, &map);
  else
    read_stl_text(&s, &im, &map, count_solids(s));
  map_free(&map.first);
  vec_free(&map.next);
  return import_finish(&im);
}
