// inp.c - Abaqus and CalculiX input files with element and node sets, written and read
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>
#include <strings.h>

#include "out/import.h"
#include "out/out_int.h"

static const struct {
  ElemType type;
  const char *name;
} names[] = {
    // The first name of a type is written; all are read, whatever letters follow ("CPS4R", "S3R").
    {ELEM_LINE2, "T3D2"}, {ELEM_LINE3, "T3D3"}, {ELEM_TRI3, "CPS3"}, {ELEM_QUAD4, "CPS4"}, {ELEM_TRI6, "CPS6"},
    {ELEM_QUAD8, "CPS8"}, {ELEM_QUAD9, "M3D9"}, {ELEM_LINE2, "T2D2"}, {ELEM_LINE2, "B21"}, {ELEM_LINE2, "B31"},
    {ELEM_LINE3, "T2D3"}, {ELEM_LINE3, "B22"}, {ELEM_LINE3, "B32"}, {ELEM_TRI3, "CPE3"}, {ELEM_QUAD4, "CPE4"},
    {ELEM_TRI6, "CPE6"}, {ELEM_QUAD8, "CPE8"}, {ELEM_TRI3, "CAX3"}, {ELEM_QUAD4, "CAX4"}, {ELEM_TRI6, "CAX6"},
    {ELEM_QUAD8, "CAX8"}, {ELEM_TRI6, "STRI65"}, {ELEM_TRI3, "M3D3"}, {ELEM_QUAD4, "M3D4"}, {ELEM_TRI6, "M3D6"},
    {ELEM_QUAD8, "M3D8"}, {ELEM_TRI3, "S3"}, {ELEM_QUAD4, "S4"}, {ELEM_TRI6, "S6"}, {ELEM_QUAD8, "S8"}, {ELEM_QUAD9, "S9"},
};

static const char *name_of(ElemType t)
{
  for (size_t i = 0; i < ARRAY_LEN(names); i++)
    if (names[i].type == t) return names[i].name;
  return NULL;
}

const char *inp__refuses(const Selection *s)
{
  for (size_t i = 0; i < s->nblock; i++)
    if (!name_of(s->mesh->block[s->block[i]].type)) return "Abaqus files hold elements of order 1 and 2 only";
  return NULL;
}

// A list of numbers, ten on a line.
typedef struct {
  Writer *w;
  size_t n;
} List;

static void list_add(List *l, uint64_t v)
{
  writer_u64(l->w, v);
  writer_str(l->w, ++l->n % 10 ? ", " : ",\n");
}

static void list_end(List *l)
{
  if (l->n % 10) writer_char(l->w, '\n');
}

static bool is_written(const MeshBlock *k, const OutOptions *o) { return !(o->no_elements >> elem_dim(k->type) & 1); }

static void write_elements(Writer *w, const Selection *s, const OutOptions *o)
{
  uint64_t number = s->elem0;
  const Mesh *m = s->mesh;
  writer_str(w, "******* E L E M E N T S *************\n");
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &m->block[s->block[i]];
    const MeshEntity *e = &m->entity[k->entity];
    int nodes = elem_nodes(k->type);
    if (!is_written(k, o)) continue;
    writer_printf(w, "*ELEMENT, type=%s, ELSET=%s%d\n", name_of(k->type), e->dim == 1 ? "Line" : "Surface", e->tag);
    for (size_t j = 0; j < k->n; j++) {
      char *p0 = writer_reserve(w, 320), *p = put_u64(p0, number++);
      for (int a = 0; a < nodes; a++) {
        *p++ = ',';
        p = put_u64(put_char(p, ' '), s->number[k->node[j * (size_t)nodes + (size_t)a]] + s->node0);
      }
      p = put_char(p, '\n');
      writer_commit(w, (size_t)(p - p0));
    }
  }
}

static void write_element_set(Writer *w, const Selection *s, const OutOptions *o, const MeshGroup *g)
{
  uint64_t number = s->elem0;
  List l = {w, 0};
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    bool in = select__in_group(&s->mesh->entity[k->entity], g);
    if (!is_written(k, o)) continue;
    for (size_t j = 0; j < k->n; j++, number++) {
      if (!in) continue;
      if (!l.n) {
        char name[256];
        select__group_name(g, name, sizeof name);
        writer_printf(w, "*ELSET,ELSET=%s\n", name);
      }
      list_add(&l, number);
    }
  }
  list_end(&l);
}

static void write_node_set(Writer *w, const Selection *s, const MeshGroup *g, uint8_t *mark)
{
  List l = {w, 0};
  memset(mark, 0, s->nnode);
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    if (!select__in_group(&s->mesh->entity[k->entity], g)) continue;
    for (size_t j = 0; j < k->n * (size_t)elem_nodes(k->type); j++) mark[s->number[k->node[j]]] = 1;
  }
  for (size_t k = 0; k < s->nnode; k++) {
    if (!mark[k]) continue;
    if (!l.n) {
      char name[256];
      select__group_name(g, name, sizeof name);
      writer_printf(w, "*NSET,NSET=%s\n", name);
    }
    list_add(&l, k + s->node0);
  }
  list_end(&l);
}

void inp__write(Writer *w, const Selection *s, const OutOptions *o)
{
  writer_printf(w, "*Heading\n %.200s\n*NODE\n", o->title ? o->title : "meshgen");
  for (size_t k = 0; k < s->nnode; k++) {
    Vec3 x = select__xyz(s, k);
    const double c[3] = {x.x, x.y, x.z};
    char *p0 = writer_reserve(w, 160), *p = put_u64(p0, k + s->node0);
    for (int i = 0; i < 3; i++) {
      *p++ = ',';
      p = put_double(put_char(p, ' '), c[i]);
    }
    p = put_char(p, '\n');
    writer_commit(w, (size_t)(p - p0));
  }
  write_elements(w, s, o);
  const Mesh *m = s->mesh;
  for (size_t g = 0; g < m->ngroup; g++)
    if (!(o->no_element_sets >> m->group[g].dim & 1)) write_element_set(w, s, o, &m->group[g]);
  uint8_t *mark = mem_alloc(s->nnode);
  for (size_t g = 0; g < m->ngroup; g++)
    if (o->node_sets >> m->group[g].dim & 1) write_node_set(w, s, &m->group[g], mark);
  free(mark);
}

// ---- reading ------------------------------------------------------------------------------------------------------------------
// Elements wait until the sets are known; an element of k sets is given to the importer k times.
typedef struct {
  uint32_t set; // index of its *ELEMENT's ELSET
  ElemType type;
  size_t first; // of its nodes
} Waiting;

typedef struct {
  char *name;
  int tag[3];      // entity tag by dimension, 0 while it has none
} Set;

typedef struct {
  Scan *s;
  Import im;
  Vec(Waiting) element;
  Vec(uint64_t) node;
  Map number;             // of elements
  Vec(Set) set;
  Names set_index;
  Vec(uint64_t) member;   // element << 32 | set
  int next_tag;
} Reader;

static uint32_t set_named(Reader *r, const char *name)
{
  char upper[256];
  size_t i = 0;
  for (; name[i] && i + 1 < sizeof upper; i++) upper[i] = (char)(name[i] >= 'a' && name[i] <= 'z' ? name[i] - 32 : name[i]);
  upper[i] = 0;
  uint32_t k = names_get(&r->set_index, upper);
  if (k != NONE) return k;
  vec_push(&r->set, ((Set){.name = mem_strdup(name)}));
  names_set(&r->set_index, upper, (uint32_t)(r->set.len - 1));
  return (uint32_t)(r->set.len - 1);
}

// Value of a parameter of a keyword line, "" if it has none; false if the parameter is not there.
static bool parameter(const char *from, const char *to, const char *key, char *value, size_t cap)
{
  size_t n = strlen(key);
  value[0] = 0;
  while (from < to) {
    while (from < to && *from != ',') from++;
    if (from == to) return false;
    for (from++; from < to && (unsigned char)*from <= ' ';) from++;
    if ((size_t)(to - from) < n || strncasecmp(from, key, n) != 0) continue;
    const char *q = from + n, *end;
    while (q < to && (unsigned char)*q <= ' ') q++;
    if (q == to || *q == ',') return true;
    if (*q != '=') continue;
    for (q++; q < to && ((unsigned char)*q <= ' ' || *q == '"');) q++;
    for (end = q; end < to && *end != ',';) end++;
    while (end > q && ((unsigned char)end[-1] <= ' ' || end[-1] == '"')) end--;
    snprintf(value, cap, "%.*s", (int)(end - q), q);
    return true;
  }
  return false;
}

// Blanks, commas, line ends and comment lines before the next number; false at the next keyword or the end.
static bool next_number(Scan *s)
{
  for (;;) {
    while (s->p < s->end && ((unsigned char)*s->p <= ' ' || *s->p == ',')) s->p++;
    if (s->p >= s->end) return false;
    if (*s->p != '*') return true;
    if (s->end - s->p < 2 || s->p[1] != '*') return false;
    scan_line(s);
  }
}

static int64_t number(Scan *s, const char *what)
{
  next_number(s);
  return scan_i64_slow(s, what);
}

static void read_nodes(Reader *r)
{
  Scan *s = r->s;
  while (next_number(s) && !s->failed) {
    const char *line = s->p;
    int64_t tag = number(s, "a node number");
    double x[3] = {0, 0, 0};
    const char *eol = memchr(line, '\n', (size_t)(s->end - line));
    if (!eol) eol = s->end;
    for (int i = 0; i < 3 && !s->failed; i++) {
      while (s->p < eol && ((unsigned char)*s->p <= ' ' || *s->p == ',')) s->p++;
      if (s->p >= eol) break;
      x[i] = scan_double(s, "a coordinate");
    }
    if (!s->failed) scan_line(s);
    import_node(&r->im, (uint64_t)tag, (Vec3){x[0], x[1], x[2]}, -1, 0, NAN);
  }
}

static ElemType type_named(const char *name)
{
  size_t best = 0;
  ElemType t = 0;
  for (size_t i = 0; i < ARRAY_LEN(names); i++) {
    size_t n = strlen(names[i].name);
    if (n > best && strncasecmp(name, names[i].name, n) == 0 && !(name[n] >= '0' && name[n] <= '9')) {
      best = n;
      t = names[i].type;
    }
  }
  return t;
}

static void read_elements(Reader *r, const char *from, const char *to)
{
  Scan *s = r->s;
  char type[64], set[256];
  parameter(from, to, "TYPE", type, sizeof type);
  if (!parameter(from, to, "ELSET", set, sizeof set)) snprintf(set, sizeof set, "%s", "");
  ElemType t = type_named(type);
  if (!t) {
    if (*type == 'C' || *type == 'c') {
      // Solids and the like: left out, their lines skipped.
      while (next_number(s)) scan_line(s);
      r->im.volumes++;
      return;
    }
    scan_error(s, "element type '%s' is not read", type);
    return;
  }
  uint32_t index = set_named(r, set);
  while (next_number(s) && !s->failed) {
    int64_t tag = number(s, "an element number");
    bool added;
    if (tag < 0) scan_error(s, "element number %lld", (long long)tag);
    if (s->failed) return;
    map_slot(&r->number, (uint64_t)tag, (uint32_t)r->element.len, &added);
    if (!added) scan_error(s, "element %lld is defined twice", (long long)tag);
    vec_push(&r->element, ((Waiting){index, t, r->node.len}));
    for (int a = 0; a < elem_nodes(t); a++) vec_push(&r->node, (uint64_t)number(s, "a node"));
  }
}

static void add_member(Reader *r, int64_t tag, uint32_t set)
{
  uint32_t e = tag < 0 ? NONE : map_get(&r->number, (uint64_t)tag);
  if (e != NONE) vec_push(&r->member, (uint64_t)e << 32 | set);
}

static void read_set(Reader *r, const char *from, const char *to)
{
  Scan *s = r->s;
  char name[256], ignored[8];
  if (!parameter(from, to, "ELSET", name, sizeof name)) {
    scan_error(s, "*ELSET without ELSET=");
    return;
  }
  bool generate = parameter(from, to, "GENERATE", ignored, sizeof ignored);
  uint32_t set = set_named(r, name);
  while (next_number(s) && !s->failed) {
    if ((*s->p < '0' || *s->p > '9') && *s->p != '-') { // the name of another set: its elements
      const char *a, *b;
      scan_get_line(s, &a, &b);
      snprintf(name, sizeof name, "%.*s", (int)(b - a), a);
      uint32_t other = set_named(r, name);
      for (size_t e = 0; e < r->element.len; e++)
        if (r->element.data[e].set == other) vec_push(&r->member, (uint64_t)e << 32 | set);
      continue;
    }
    int64_t a = number(s, "an element number"), b = a, step = 1;
    if (generate) {
      b = number(s, "the last element");
      if (!s->failed) {
        const char *eol = memchr(s->p, '\n', scan_left(s));
        const char *p = s->p;
        while (p < s->end && (*p == ' ' || *p == ',')) p++;
        if (p < (eol ? eol : s->end) && *p >= '0' && *p <= '9') step = number(s, "the step");
      }
      if (step <= 0 || b - a > (int64_t)1 << 31) {
        scan_error(s, "a range from %lld to %lld by %lld", (long long)a, (long long)b, (long long)step);
        return;
      }
    }
    for (int64_t t = a; t <= b && !s->failed; t += step) add_member(r, t, set);
  }
}

static int member_order(const void *x, const void *y)
{
  const uint64_t *a = x, *b = y;
  return *a < *b ? -1 : *a > *b;
}

// "Surface12" is entity 12; other names get the next free tags.
static int entity_of(Reader *r, uint32_t set, int dim)
{
  Set *s = &r->set.data[set];
  if (s->tag[dim]) return s->tag[dim];
  const char *prefix = dim == 1 ? "Line" : "Surface";
  size_t n = strlen(prefix);
  int64_t tag = 0;
  if (strncasecmp(s->name, prefix, n) == 0) {
    const char *end = s->name + strlen(s->name);
    if (number_read_i64(s->name + n, end, &tag) != end || tag <= 0 || tag >= 1000000000) tag = 0;
  }
  return s->tag[dim] = tag ? (int)tag : r->next_tag++;
}

static void give_elements(Reader *r)
{
  if (r->member.len) qsort(r->member.data, r->member.len, sizeof *r->member.data, member_order);
  size_t at = 0;
  for (size_t e = 0; e < r->element.len && !r->s->failed; e++) {
    const Waiting *w = &r->element.data[e];
    int dim = elem_dim(w->type), entity = entity_of(r, w->set, dim);
    size_t copies = 0;
    for (;; at++) {
      bool member = at < r->member.len && r->member.data[at] >> 32 == e;
      if (!member && copies) break;
      int group = member ? import_group_named(&r->im, dim, r->set.data[(uint32_t)r->member.data[at]].name) : 0;
      import_element(&r->im, w->type, entity, group);
      for (int a = 0; a < elem_nodes(w->type); a++) import_element_node(&r->im, r->node.data[w->first + (size_t)a]);
      copies++;
      if (!member) break;
    }
  }
}

Mesh *inp__read(Scan s)
{
  Reader r = {.s = &s, .next_tag = 1000000000};
  const char *from, *to;
  size_t keywords = 0;
  import_begin(&r.im, &s);
  while (scan_get_line(&s, &from, &to)) {
    if (to - from < 2 || from[0] != '*' || from[1] == '*') continue;
    const char *end = memchr(from, ',', (size_t)(to - from));
    size_t n = (size_t)((end ? end : to) - from - 1);
    keywords++;
    if (n == 4 && strncasecmp(from + 1, "NODE", 4) == 0)
      read_nodes(&r);
    else if (n == 7 && strncasecmp(from + 1, "ELEMENT", 7) == 0)
      read_elements(&r, from, to);
    else if (n == 5 && strncasecmp(from + 1, "ELSET", 5) == 0)
      read_set(&r, from, to);
  }
  if (!s.failed && !keywords) scan_error(&s, "this is no Abaqus file: no line begins with a keyword");
  if (!s.failed) give_elements(&r);
  for (size_t i = 0; i < r.set.len; i++) free(r.set.data[i].name);
  vec_free(&r.set);
  vec_free(&r.element);
  vec_free(&r.node);
  vec_free(&r.member);
  names_free(&r.set_index);
  map_free(&r.number);
  return import_finish(&r.im);
}
