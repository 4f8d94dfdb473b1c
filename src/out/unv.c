// unv.c - I-DEAS universal files: nodes (2411), elements (2412), groups (2477), written and read
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/import.h"
#include "out/out_int.h"

static const struct {
  int number;
  ElemType type;
} types[] = {
    {21, ELEM_LINE2}, {24, ELEM_LINE3}, {91, ELEM_TRI3}, {92, ELEM_TRI6}, {94, ELEM_QUAD4}, {95, ELEM_QUAD8},
    // read too: rods and other beams, plane stress, plane strain and membrane elements
    {11, ELEM_LINE2}, {22, ELEM_LINE3}, {23, ELEM_LINE3}, {41, ELEM_TRI3}, {42, ELEM_TRI6}, {44, ELEM_QUAD4},
    {45, ELEM_QUAD8}, {51, ELEM_TRI3}, {52, ELEM_TRI6}, {54, ELEM_QUAD4}, {55, ELEM_QUAD8}, {61, ELEM_TRI3},
    {62, ELEM_TRI6}, {64, ELEM_QUAD4}, {65, ELEM_QUAD8}, {81, ELEM_TRI3}, {82, ELEM_TRI6}, {84, ELEM_QUAD4}, {85, ELEM_QUAD8},
};

static int number_of(ElemType t)
{
  for (size_t i = 0; i < ARRAY_LEN(types); i++)
    if (types[i].type == t) return types[i].number;
  return 0;
}

const char *unv__refuses(const Selection *s)
{
  for (size_t i = 0; i < s->nblock; i++)
    if (!number_of(s->mesh->block[s->block[i]].type)) return "UNV files hold elements of order 1 and incomplete quadrangles of order 2 only";
  return NULL;
}

// I-DEAS goes around the element: corner, middle of the edge, corner, ... Ours has the corners first. unv[i] = ours[perm[i]].
static int unv_order(ElemType t, uint8_t perm[ELEM_MAX_NODES])
{
  int n = elem_nodes(t), corners = elem_corners(t);
  for (int i = 0; i < n; i++) perm[i] = (uint8_t)i;
  if (n == corners) return n;
  if (corners == 2) {
    perm[1] = 2;
    perm[2] = 1;
    return n;
  }
  for (int i = 0; i < corners; i++) {
    perm[2 * i] = (uint8_t)i;
    perm[2 * i + 1] = (uint8_t)(corners + i);
  }
  return n;
}

// 25 columns, exponent D: 17 digits read back to the same double.
static char *put_d25(char *p, double v)
{
  int n = snprintf(p, 32, "%25.16E", v);
  for (int i = 0; i < n; i++)
    if (p[i] == 'E') p[i] = 'D';
  return p + n;
}

static void write_nodes(Writer *w, const Selection *s)
{
  writer_str(w, "    -1\n  2411\n");
  for (size_t k = 0; k < s->nnode; k++) {
    Vec3 x = select__xyz(s, k);
    char *p0 = writer_reserve(w, 200), *p = p0 + snprintf(p0, 100, "%10llu%10d%10d%10d\n", (unsigned long long)(k + s->node0), 1, 1, 11);
    p = put_d25(put_d25(put_d25(p, x.x), x.y), x.z);
    p = put_char(p, '\n');
    writer_commit(w, (size_t)(p - p0));
  }
  writer_str(w, "    -1\n");
}

static void write_elements(Writer *w, const Selection *s)
{
  uint64_t number = s->elem0;
  writer_str(w, "    -1\n  2412\n");
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    uint8_t perm[ELEM_MAX_NODES];
    int n = unv_order(k->type, perm), type = number_of(k->type);
    for (size_t j = 0; j < k->n; j++) {
      writer_printf(w, "%10llu%10d%10d%10d%10d%10d\n", (unsigned long long)number++, type, s->mesh->entity[k->entity].tag, 0, 7, n);
      if (type == 21 || type == 24) writer_printf(w, "%10d%10d%10d\n", 0, 0, 0);
      for (int a = 0; a < n; a++)
        writer_printf(w, "%10llu%s", (unsigned long long)(s->number[k->node[j * (size_t)n + perm[a]]] + s->node0),
                      a == n - 1 || a % 8 == 7 ? "\n" : "");
    }
  }
  writer_str(w, "    -1\n");
}

// Members of a group: elements, and its nodes if they are asked for. body is called with kind 8 or 7 and the number.
static size_t each_member(const Selection *s, const MeshGroup *g, bool elements, bool nodes, Writer *w)
{
  size_t n = 0;
  uint64_t number = s->elem0;
  uint8_t *mark = nodes ? mem_zalloc(s->nnode) : NULL;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    bool in = select__in_group(&s->mesh->entity[k->entity], g);
    for (size_t j = 0; j < k->n; j++, number++) {
      if (!in || !elements) continue;
      if (w) writer_printf(w, "%10d%10llu%10d%10d%s", 8, (unsigned long long)number, 0, 0, n % 2 ? "\n" : "");
      n++;
    }
    for (size_t j = 0; in && mark && j < k->n * (size_t)elem_nodes(k->type); j++) mark[s->number[k->node[j]]] = 1;
  }
  for (size_t k = 0; mark && k < s->nnode; k++) {
    if (!mark[k]) continue;
    if (w) writer_printf(w, "%10d%10llu%10d%10d%s", 7, (unsigned long long)(k + s->node0), 0, 0, n % 2 ? "\n" : "");
    n++;
  }
  if (w && n % 2) writer_char(w, '\n');
  free(mark);
  return n;
}

void unv__write(Writer *w, const Selection *s, const OutOptions *o)
{
  const Mesh *m = s->mesh;
  write_nodes(w, s);
  write_elements(w, s);
  bool open = false;
  for (size_t g = 0; g < m->ngroup; g++) {
    bool elements = !(o->no_element_sets >> m->group[g].dim & 1), nodes = o->node_sets >> m->group[g].dim & 1;
    size_t n = each_member(s, &m->group[g], elements, nodes, NULL);
    if (!n) continue;
    char name[256];
    select__group_name(&m->group[g], name, sizeof name);
    if (!open) writer_str(w, "    -1\n  2477\n");
    open = true;
    writer_printf(w, "%10d%10d%10d%10d%10d%10d%10d%10zu\n%s\n", m->group[g].tag, 0, 0, 0, 0, 0, 0, n, name);
    each_member(s, &m->group[g], elements, nodes, w);
  }
  if (open) writer_str(w, "    -1\n");
}

// ---- reading --------------------------------------------------------------------------------------------------------------------
typedef struct {
  ElemType type;
  int entity;
  size_t first;
} Waiting;

typedef struct {
  uint32_t element, group; // index into group[]
} Member;

typedef struct {
  int tag;
  char *name;
} Group;

typedef struct {
  Scan *s;
  Import im;
  Vec(Waiting) element;
  Vec(uint64_t) node;
  Map number;
  Vec(Member) member;
  Vec(Group) group;
} Reader;

// At a line that is just -1?
static bool at_end(Scan *s)
{
  const char *p = s->p;
  while (p < s->end && (unsigned char)*p <= ' ') p++;
  bool end = p >= s->end || (s->end - p >= 2 && p[0] == '-' && p[1] == '1' && (s->end - p == 2 || (unsigned char)p[2] <= ' '));
  return end;
}

static void read_nodes(Reader *r)
{
  Scan *s = r->s;
  while (!at_end(s) && !s->failed) {
    int64_t tag = scan_i64(s, "a node number");
    for (int i = 0; i < 3; i++) scan_i64(s, "a coordinate system");
    double x = scan_double(s, "a coordinate"), y = scan_double(s, "a coordinate"), z = scan_double(s, "a coordinate");
    import_node(&r->im, (uint64_t)tag, (Vec3){x, y, z}, -1, 0, NAN);
  }
}

static void read_elements(Reader *r)
{
  Scan *s = r->s;
  while (!at_end(s) && !s->failed) {
    int64_t tag = scan_range(s, 0, INT64_MAX - 1, "element number"), type = scan_i64(s, "an element type");
    int entity = scan_int(s, "a property");
    for (int i = 0; i < 2; i++) scan_i64(s, "a material");
    int64_t n = scan_range(s, 1, 1000, "number of nodes");
    ElemType t = 0;
    for (size_t i = 0; i < ARRAY_LEN(types); i++)
      if (types[i].number == type) t = types[i].type;
    if (type >= 11 && type < 40)
      for (int i = 0; i < 3; i++) scan_i64(s, "a beam's section");
    if (s->failed) return;
    if (!t) {
      if (type < 100) scan_error(s, "element type %lld is not read", (long long)type);
      for (int64_t a = 0; a < n; a++) scan_i64(s, "a node");
      r->im.volumes++;
      continue;
    }
    if (n != elem_nodes(t)) {
      scan_error(s, "an element of type %lld with %lld nodes", (long long)type, (long long)n);
      return;
    }
    bool added;
    map_slot(&r->number, (uint64_t)tag, (uint32_t)r->element.len, &added);
    if (!added) scan_error(s, "element %lld is defined twice", (long long)tag);
    vec_push(&r->element, ((Waiting){t, entity > 0 ? entity : 1, r->node.len}));
    uint8_t perm[ELEM_MAX_NODES];
    unv_order(t, perm);
    size_t first = r->node.len;
    vec_resize(&r->node, first + (size_t)n);
    for (int64_t a = 0; a < n; a++) r->node.data[first + perm[a]] = (uint64_t)scan_i64(s, "a node");
  }
}

static void read_groups(Reader *r)
{
  Scan *s = r->s;
  while (!at_end(s) && !s->failed) {
    int64_t head[8];
    for (int i = 0; i < 8; i++) head[i] = scan_i64(s, "a group's header");
    scan_line(s);
    const char *from, *to;
    if (!scan_get_line(s, &from, &to)) scan_error(s, "the name of a group expected");
    if (s->failed) return;
    char *name = mem_alloc((size_t)(to - from) + 1);
    memcpy(name, from, (size_t)(to - from));
    name[to - from] = 0;
    static const char *const unnamed[] = {"PhysicalPoint", "PhysicalLine", "PhysicalSurface"};
    for (size_t k = 0; k < ARRAY_LEN(unnamed); k++)
      if (strncmp(name, unnamed[k], strlen(unnamed[k])) == 0 && strtol(name + strlen(unnamed[k]), NULL, 10) == head[0]) name[0] = 0;
    vec_push(&r->group, ((Group){(int)MIN(MAX(head[0], (int64_t)1), (int64_t)INT32_MAX), name}));
    size_t n = scan_count(s, head[7], 8, "members");
    for (size_t i = 0; i < n && !s->failed; i++) {
      int64_t kind = scan_i64(s, "a member's kind"), tag = scan_i64(s, "a member");
      for (int k = 0; k < 2; k++) scan_i64(s, "a member");
      uint32_t e = tag < 0 ? NONE : map_get(&r->number, (uint64_t)tag);
      if (kind == 8 && e != NONE) vec_push(&r->member, ((Member){e, (uint32_t)(r->group.len - 1)}));
    }
  }
}

static int member_order(const void *x, const void *y)
{
  const Member *a = x, *b = y;
  if (a->element != b->element) return a->element < b->element ? -1 : 1;
  return (a->group > b->group) - (a->group < b->group);
}

static void give_elements(Reader *r)
{
  if (r->member.len) qsort(r->member.data, r->member.len, sizeof *r->member.data, member_order);
  size_t at = 0;
  for (uint32_t e = 0; e < r->element.len && !r->s->failed; e++) {
    const Waiting *w = &r->element.data[e];
    size_t copies = 0;
    for (;; at++) {
      bool member = at < r->member.len && r->member.data[at].element == e;
      if (!member && copies) break;
      const Group *g = member ? &r->group.data[r->member.data[at].group] : NULL;
      if (g) import_group(&r->im, elem_dim(w->type), g->tag, g->name);
      import_element(&r->im, w->type, w->entity, g ? g->tag : 0);
      for (int a = 0; a < elem_nodes(w->type); a++) import_element_node(&r->im, r->node.data[w->first + (size_t)a]);
      copies++;
      if (!member) break;
    }
  }
}

Mesh *unv__read(Scan s)
{
  Reader r = {.s = &s};
  size_t sections = 0;
  import_begin(&r.im, &s);
  while (!s.failed) {
    scan_space(&s);
    if (s.p >= s.end) break;
    if (!at_end(&s)) {
      scan_error(&s, "the -1 that begins a data set expected");
      break;
    }
    scan_line(&s);
    int64_t set = scan_i64(&s, "the number of a data set");
    scan_line(&s);
    sections++;
    if (set == 2411 || set == 781)
      read_nodes(&r);
    else if (set == 2412 || set == 780)
      read_elements(&r);
    else if (set == 2477 || set == 2467 || set == 2452 || set == 2435)
      read_groups(&r);
    while (!s.failed && !at_end(&s)) scan_line(&s);
    scan_space(&s);
    if (!s.failed && s.p >= s.end) scan_error(&s, "data set %lld does not end", (long long)set);
    scan_line(&s);
  }
  if (!s.failed && !sections) scan_error(&s, "this is no universal file: no data set");
  if (!s.failed) give_elements(&r);
  for (size_t i = 0; i < r.group.len; i++) free(r.group.data[i].name);
  vec_free(&r.group);
  vec_free(&r.element);
  vec_free(&r.node);
  vec_free(&r.member);
  map_free(&r.number);
  return import_finish(&r.im);
}
