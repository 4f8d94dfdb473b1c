// stl.c - writer and reader of STL, ASCII and binary: every facet with its normal and its corners in full
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>
#include <strings.h>

#include "base/map.h"
#include "out/surface_int.h"

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
    const MeshGroup *g = surface__group(s, k);
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
