// medit.c - Medit .mesh files (ASCII), written and read
// SPDX-License-Identifier: MIT
//
// Every element has one number, its reference: the entity's tag, or with element_tag 2 its first group's. Read back, a
// positive reference is both.
#include "base/base.h"

#include <math.h>

#include "out/import.h"
#include "out/out_int.h"

static const struct {
  const char *keyword;
  ElemType type;
} sections[] = {
    {"Edges", ELEM_LINE2}, {"EdgesP2", ELEM_LINE3}, {"Triangles", ELEM_TRI3}, {"TrianglesP2", ELEM_TRI6},
    {"Quadrilaterals", ELEM_QUAD4}, {"QuadrilateralsQ2", ELEM_QUAD9},
};

static bool holds(ElemType t)
{
  bool found = t == ELEM_POINT;
  for (size_t i = 0; i < ARRAY_LEN(sections); i++) found |= sections[i].type == t;
  return found;
}

const char *medit__refuses(const Selection *s)
{
  for (size_t i = 0; i < s->nblock; i++)
    if (!holds(s->mesh->block[s->block[i]].type)) return "Medit files hold elements of order 1 and complete ones of order 2 only";
  return NULL;
}

const char *medit__refuses_2d(const Selection *s)
{
  return select__not_flat(s) ? "two-dimensional Medit files hold plane meshes, z = 0, only" : medit__refuses(s);
}

static void write_section(Writer *w, const Selection *s, const OutOptions *o, size_t section)
{
  size_t n = 0;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    if (k->type == sections[section].type) n += k->n;
  }
  if (!n) return;
  writer_printf(w, " %s\n %zu\n", sections[section].keyword, n);
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    if (k->type != sections[section].type) continue;
    int tag = select__tag(&s->mesh->entity[k->entity], o);
    size_t nodes = (size_t)elem_nodes(k->type);
    for (size_t j = 0; j < k->n; j++) {
      char *p0 = writer_reserve(w, 320), *p = p0;
      p = put_node_numbers(p, s, k->node + j * nodes, NULL, nodes, 1);
      p = put_u64(put_char(p, ' '), (uint64_t)tag);
      p = put_char(p, '\n');
      writer_commit(w, (size_t)(p - p0));
    }
  }
}

static void write_file(Writer *w, const Selection *s, const OutOptions *o, int dim)
{
  writer_printf(w, " MeshVersionFormatted 2\n Dimension\n %d\n Vertices\n %zu\n", dim, s->nnode);
  for (size_t k = 0; k < s->nnode; k++) {
    Vec3 x = select__xyz(s, k);
    char *p0 = writer_reserve(w, 160), *p = p0;
    p = put_double(put_char(p, ' '), x.x);
    p = put_double(put_char(p, ' '), x.y);
    if (dim == 3) p = put_double(put_char(p, ' '), x.z);
    p = put_u64(put_char(p, ' '), (uint64_t)select__tag(&s->mesh->entity[s->mesh->node_entity[s->node[k]]], o));
    p = put_char(p, '\n');
    writer_commit(w, (size_t)(p - p0));
  }
  for (size_t k = 0; k < ARRAY_LEN(sections); k++) write_section(w, s, o, k);
  writer_str(w, " End\n");
}

void medit__write(Writer *w, const Selection *s, const OutOptions *o) { write_file(w, s, o, 3); }
void medit__write_2d(Writer *w, const Selection *s, const OutOptions *o) { write_file(w, s, o, 2); }

// Blanks, line ends and comments.
static void skip(Scan *s)
{
  for (;;) {
    scan_space(s);
    if (s->p >= s->end || *s->p != '#') return;
    scan_line(s);
  }
}

static void read_elements(Import *im, Scan *s, ElemType type)
{
  int nodes = elem_nodes(type);
  size_t n = scan_count(s, scan_i64(s, "a count"), 4, "elements");
  int64_t v[ELEM_MAX_NODES];
  for (size_t i = 0; i < n && !s->failed; i++) {
    for (int a = 0; a < nodes; a++) v[a] = scan_i64(s, "a vertex");
    int ref = scan_int(s, "a reference");
    if (s->failed) return;
    import_element(im, type, abs(ref), ref > 0 ? ref : 0);
    for (int a = 0; a < nodes; a++) import_element_node(im, (uint64_t)v[a]);
  }
}

static void read_vertices(Import *im, Scan *s, int dim)
{
  size_t n = scan_count(s, scan_i64(s, "a count"), 6, "vertices");
  import_reserve_nodes(im, n);
  for (size_t i = 0; i < n && !s->failed; i++) {
    double x = scan_double(s, "a coordinate"), y = scan_double(s, "a coordinate"), z = dim == 3 ? scan_double(s, "a coordinate") : 0;
    scan_double(s, "a reference");
    import_node(im, i + 1, (Vec3){x, y, z}, -1, 0, NAN);
  }
}

// Numbers up to the next keyword.
static void skip_section(Scan *s)
{
  skip(s);
  while (s->p < s->end && !((*s->p >= 'A' && *s->p <= 'Z') || (*s->p >= 'a' && *s->p <= 'z'))) {
    scan_line(s);
    skip(s);
  }
}

Mesh *medit__read(Scan s)
{
  Import im;
  int dim = 3;
  bool known = false;
  import_begin(&im, &s);
  for (skip(&s); s.p < s.end; skip(&s)) {
    char word[64];
    scan_word(&s, word, sizeof word);
    size_t k = 0;
    while (k < ARRAY_LEN(sections) && strcmp(word, sections[k].keyword) != 0) k++;
    if (k < ARRAY_LEN(sections))
      read_elements(&im, &s, sections[k].type);
    else if (strcmp(word, "MeshVersionFormatted") == 0)
      known = scan_range(&s, 1, 4, "version") > 0;
    else if (strcmp(word, "Dimension") == 0)
      dim = (int)scan_range(&s, 2, 3, "dimension");
    else if (strcmp(word, "Vertices") == 0)
      read_vertices(&im, &s, dim);
    else if (strcmp(word, "End") == 0)
      break;
    else
      skip_section(&s);
  }
  if (!s.failed && !known) scan_error(&s, "this is no Medit file: no MeshVersionFormatted");
  return import_finish(&im);
}
