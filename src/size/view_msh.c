// view_msh.c - a view from the node data of an ASCII .msh file (versions 2 and 4)
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "size/field.h"

#include <ctype.h>
#include <math.h>

#include "base/number.h"
#include "size/field_int.h"

typedef struct {
  const char *s, *end, *begin;
  uint32_t file;
  Diag *diag;
  bool failed;
  Map node;             // tag -> index in xyz
  Vec(Vec3) xyz;
  DoubleVec value;      // of nodes, NAN where none is given
  Map element;          // tag -> index of its first entry in `corner`
  U32Vec corner;        // 1 + count, then the nodes of each element
} Msh;

static void fail(Msh *m, const char *what)
{
  if (m->failed) return;
  m->failed = true;
  SrcLoc loc = {m->file, 1, 1};
  for (const char *c = m->begin; c < m->s; c++) {
    loc.col++;
    if (*c == '\n') loc.line++, loc.col = 1;
  }
  diag_error(m->diag, loc, "%s", what);
}

static double number(Msh *m)
{
  double v = 0;
  while (m->s < m->end && isspace((unsigned char)*m->s)) m->s++;
  const char *after = number_read(m->s, m->end, &v);
  if (after == m->s) fail(m, "expected a number");
  m->s = after;
  return v;
}

// A count or a tag: an integer in [0, 2^31).
static uint32_t integer(Msh *m)
{
  double v = number(m);
  if (m->failed) return 0;
  if (!(v >= 0 && v < 2147483648.0)) return fail(m, "number out of range"), 0;
  return (uint32_t)v;
}

static void skip_line(Msh *m)
{
  while (m->s < m->end && *m->s != '\n') m->s++;
  m->s += m->s < m->end;
}

static void add_node(Msh *m, uint32_t tag, Vec3 p)
{
  map_set(&m->node, tag, (uint32_t)m->xyz.len);
  vec_push(&m->xyz, p);
  vec_push(&m->value, NAN);
}

static Vec3 point(Msh *m)
{
  Vec3 p;
  p.x = number(m);
  p.y = number(m);
  p.z = number(m);
  return p;
}

static void read_nodes(Msh *m, bool four)
{
  uint32_t blocks = integer(m);
  if (!four) {
    for (uint32_t i = 0; i < blocks && !m->failed; i++) {
      uint32_t tag = integer(m);
      add_node(m, tag, point(m));
    }
    return;
  }
  for (int i = 0; i < 3; i++) integer(m);
  for (uint32_t b = 0; b < blocks && !m->failed; b++) {
    uint32_t dim = integer(m);
    number(m);
    uint32_t parametric = integer(m), n = integer(m), first = (uint32_t)m->xyz.len;
    for (uint32_t i = 0; i < n && !m->failed; i++) add_node(m, integer(m), (Vec3){0, 0, 0});
    for (uint32_t i = 0; i < n && !m->failed; i++) {
      m->xyz.data[first + i] = point(m);
      for (uint32_t k = 0; parametric && k < dim; k++) number(m);
    }
  }
}

// Nodes of an element type, and how many of them are corners of a shape that a view has (0: none).
static void type_nodes(uint32_t type, uint32_t *nodes, uint32_t *corners)
{
  static const uint8_t count[] = {0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1, 8};
  *nodes = type < ARRAY_LEN(count) ? count[type] : 0;
  *corners = type == 1 || type == 8 ? 2 : type == 2 || type == 9 ? 3 : type == 3 || type == 10 || type == 16 ? 4 : 0;
}

static void add_element(Msh *m, uint32_t type, uint32_t tag)
{
  uint32_t nodes, corners, at = (uint32_t)m->corner.len;
  type_nodes(type, &nodes, &corners);
  if (corners) {
    map_set(&m->element, tag, at);
    vec_push(&m->corner, corners);
  }
  for (uint32_t i = 0; i < nodes && !m->failed; i++) {
    uint32_t v = map_get(&m->node, integer(m));
    if (i >= corners) continue;
    if (v == NONE) {
      fail(m, "element of a node that does not exist");
      return;
    }
    vec_push(&m->corner, v);
  }
}

static void read_elements(Msh *m, bool four)
{
  uint32_t blocks = integer(m);
  for (int i = 0; four && i < 3; i++) integer(m);
  for (uint32_t b = 0; b < blocks && !m->failed; b++) {
    if (four) {
      integer(m), number(m);
      uint32_t type = integer(m), n = integer(m), nodes, corners;
      type_nodes(type, &nodes, &corners);
      for (uint32_t i = 0; i < n && !m->failed; i++) {
        uint32_t tag = integer(m);
        if (nodes) add_element(m, type, tag);
        else skip_line(m);
      }
    } else {
      uint32_t tag = integer(m), type = integer(m), ntags = integer(m), nodes, corners;
      for (uint32_t i = 0; i < ntags && !m->failed; i++) number(m);
      type_nodes(type, &nodes, &corners);
      if (nodes) add_element(m, type, tag);
      else skip_line(m);
    }
  }
}

// The header of a data section: texts, real and integer tags. Components and count are the second and third integer.
static void data_header(Msh *m, uint32_t *components, uint32_t *count)
{
  uint32_t n = integer(m);
  skip_line(m);
  for (uint32_t i = 0; i < n && m->s < m->end; i++) skip_line(m);
  n = integer(m);
  for (uint32_t i = 0; i < n && !m->failed; i++) number(m);
  n = integer(m);
  *components = *count = 0;
  for (uint32_t i = 0; i < n && !m->failed; i++) {
    double v = number(m);
    if (i == 1 && v >= 1 && v <= 9) *components = (uint32_t)v;
    if (i == 2 && v >= 0 && v < 2147483648.0) *count = (uint32_t)v;
  }
  if (!*components) fail(m, "a data section needs 1 to 9 components");
}

static double read_value(Msh *m, uint32_t components)
{
  double v[9];
  for (uint32_t i = 0; i < components; i++) v[i] = number(m);
  return size__of_value(v, (int)components);
}

static void read_node_data(Msh *m)
{
  uint32_t components, count;
  data_header(m, &components, &count);
  for (uint32_t i = 0; i < count && !m->failed; i++) {
    uint32_t v = map_get(&m->node, integer(m));
    double x = read_value(m, components);
    if (v != NONE) m->value.data[v] = x;
  }
}

static void push_corners(View *v, const Msh *m, uint32_t at, const double *value)
{
  uint32_t n = m->corner.data[at];
  ViewElement el = {(uint8_t)n, (uint32_t)v->xyz.len};
  for (uint32_t i = 0; i < n; i++) {
    uint32_t node = m->corner.data[at + 1 + i];
    vec_push(&v->xyz, m->xyz.data[node]);
    vec_push(&v->value, value ? value[i] : m->value.data[node]);
  }
  vec_push(&v->element, el);
}

static void read_element_node_data(Msh *m, View *v)
{
  uint32_t components, count;
  data_header(m, &components, &count);
  for (uint32_t i = 0; i < count && !m->failed; i++) {
    uint32_t at = map_get(&m->element, integer(m)), n = integer(m);
    double value[4] = {0};
    for (uint32_t k = 0; k < n && !m->failed; k++) {
      double x = read_value(m, components);
      if (k < 4) value[k] = x;
    }
    if (at != NONE && n >= m->corner.data[at] && !m->failed) push_corners(v, m, at, value);
  }
}

// Elements all of whose corners have a value.
static void take_node_values(const Msh *m, View *v)
{
  for (size_t at = 0; at < m->corner.len; at += 1 + m->corner.data[at]) {
    bool all = true;
    for (uint32_t i = 0; i < m->corner.data[at]; i++) all = all && !isnan(m->value.data[m->corner.data[at + 1 + i]]);
    if (all) push_corners(v, m, (uint32_t)at, NULL);
  }
}

static bool section(const Msh *m, const char *name)
{
  size_t n = strlen(name);
  return (size_t)(m->end - m->s) > n && !memcmp(m->s, name, n) && isspace((unsigned char)m->s[n]);
}

bool view__read_msh(FieldSet *f, const char *name, const char *text, size_t len, Diag *diag)
{
  Msh m = {.s = text, .begin = text, .end = text + len, .diag = diag};
  m.file = diag_add_file(diag, name, text, len, NO_LOC);
  View *v = &f->view.data[view_begin(f, name)];
  bool four = false, data = false;
  while (m.s < m.end && !m.failed) {
    if (section(&m, "$MeshFormat")) {
      skip_line(&m);
      four = number(&m) >= 4;
      if (integer(&m) != 0) fail(&m, "a background mesh has to be an ASCII file");
    } else if (section(&m, "$Nodes")) {
      skip_line(&m), read_nodes(&m, four);
    } else if (section(&m, "$Elements")) {
      skip_line(&m), read_elements(&m, four);
    } else if (section(&m, "$NodeData")) {
      skip_line(&m), read_node_data(&m), data = true;
    } else if (section(&m, "$ElementNodeData")) {
      skip_line(&m), read_element_node_data(&m, v);
    }
    if (!m.failed) skip_line(&m);
  }
  if (data && !m.failed) take_node_values(&m, v);
  if (!m.failed && !v->element.len) fail(&m, "the file has no $NodeData or $ElementNodeData to take sizes from");
  map_free(&m.node);
  map_free(&m.element);
  vec_free(&m.xyz);
  vec_free(&m.value);
  vec_free(&m.corner);
  return !m.failed;
}
