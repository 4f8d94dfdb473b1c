// triangle.c - files of the program Triangle: .node, .ele and .poly, written and read together
// SPDX-License-Identifier: MIT
//
// Boundary markers of nodes and segments, and attributes of triangles, are entity tags, or with element_tag 2 tags of the
// first group. Read back, a positive number is both. Middle nodes of a 6-node triangle are opposite to the corners there.
#include "base/base.h"

#include <errno.h>
#include <math.h>

#include "out/import.h"
#include "out/out_int.h"

const char *triangle__refuses(const Selection *s)
{
  int nodes = 0;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    if (elem_dim(k->type) < 2) continue;
    if (k->type != ELEM_TRI3 && k->type != ELEM_TRI6) return "Triangle's files hold triangles of order 1 and 2 only";
    if (nodes && nodes != elem_nodes(k->type)) return "Triangle's files hold triangles of one order";
    nodes = elem_nodes(k->type);
  }
  return select__not_flat(s) ? "Triangle's files hold meshes of the plane z = 0 only" : NULL;
}

static const uint8_t six[6] = {0, 1, 2, 4, 5, 3}; // theirs[i] = ours[six[i]]

// Path of a sibling: the same base with another extension, to be freed.
static char *sibling(const char *path, const char *ext)
{
  const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
  size_t n = dot ? (size_t)(dot - path) : strlen(path);
  char *to = mem_alloc(n + strlen(ext) + 2);
  memcpy(to, path, n);
  snprintf(to + n, strlen(ext) + 2, ".%s", ext);
  return to;
}

static void write_node_file(Writer *w, const Selection *s, const OutOptions *o)
{
  writer_printf(w, "%zu 2 0 1\n", s->nnode);
  for (size_t k = 0; k < s->nnode; k++) {
    Vec3 x = select__xyz(s, k);
    const MeshEntity *e = &s->mesh->entity[s->mesh->node_entity[s->node[k]]];
    char *p0 = writer_reserve(w, 128), *p = put_char(put_u64(p0, k + s->node0), ' ');
    p = put_char(put_double(p, x.x), ' ');
    p = put_char(put_double(p, x.y), ' ');
    p = put_char(put_u64(p, e->dim == 2 ? 0 : (uint64_t)select__tag(e, o)), '\n');
    writer_commit(w, (size_t)(p - p0));
  }
}

static void write_ele_file(Writer *w, const Selection *s, const OutOptions *o)
{
  size_t n = 0, number = s->elem0;
  int nodes = 3;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    if (elem_dim(k->type) < 2) continue;
    n += k->n;
    nodes = elem_nodes(k->type);
  }
  writer_printf(w, "%zu %d 1\n", n, nodes);
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    if (elem_dim(k->type) < 2) continue;
    uint64_t tag = (uint64_t)select__tag(&s->mesh->entity[k->entity], o);
    for (size_t j = 0; j < k->n; j++) {
      char *p0 = writer_reserve(w, 192), *p = put_u64(p0, number++);
      p = put_node_numbers(p, s, k->node + j * (size_t)nodes, six, (size_t)nodes, s->node0);
      p = put_char(put_u64(put_char(p, ' '), tag), '\n');
      writer_commit(w, (size_t)(p - p0));
    }
  }
}

static void write_poly_file(Writer *w, const Selection *s, const OutOptions *o)
{
  size_t n = 0, number = 1;
  for (size_t i = 0; i < s->nblock; i++)
    if (elem_dim(s->mesh->block[s->block[i]].type) == 1) n += s->mesh->block[s->block[i]].n;
  writer_printf(w, "0 2 0 1\n%zu 1\n", n);
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    if (elem_dim(k->type) != 1) continue;
    for (size_t j = 0; j < k->n; j++) {
      const uint32_t *v = k->node + j * (size_t)elem_nodes(k->type);
      writer_printf(w, "%zu %llu %llu %d\n", number++, (unsigned long long)(s->number[v[0]] + s->node0),
                    (unsigned long long)(s->number[v[1]] + s->node0), select__tag(&s->mesh->entity[k->entity], o));
    }
  }
  writer_str(w, "0\n");
}

int triangle__write(const char *path, const Selection *s, const OutOptions *o)
{
  static const char *const ext[] = {"node", "ele", "poly"};
  void (*const body[])(Writer *, const Selection *, const OutOptions *) = {write_node_file, write_ele_file, write_poly_file};
  Writer *w[3] = {NULL, NULL, NULL};
  int error = 0;
  for (int i = 0; i < 3 && !error; i++) {
    char *name = sibling(path, ext[i]);
    w[i] = writer_open(name);
    if (!w[i]) error = errno;
    free(name);
    if (w[i] && o->sync) writer_sync(w[i]);
    if (w[i]) body[i](w[i], s, o);
  }
  for (int i = 0; i < 3; i++) {
    if (w[i] && error) writer_abandon(w[i]);
    if (w[i] && !error) error = writer_close(w[i]);
  }
  return error;
}

// ---- reading ------------------------------------------------------------------------------------------------------------------
// Numbers with comments from '#' to the end of a line between them.
static void skip(Scan *s)
{
  for (;;) {
    scan_space(s);
    if (s->p >= s->end || *s->p != '#') return;
    scan_line(s);
  }
}

static int64_t get(Scan *s, const char *what)
{
  skip(s);
  return scan_i64(s, what);
}

static void read_nodes(Import *im, Scan *s, size_t n)
{
  int64_t dim = get(s, "the dimension"), attributes = get(s, "the number of attributes"), markers = get(s, "the number of markers");
  if (!s->failed && (dim != 2 || attributes < 0 || markers < 0 || attributes + markers > 1000)) scan_error(s, "nodes of dimension %lld", (long long)dim);
  import_reserve_nodes(im, n);
  for (size_t i = 0; i < n && !s->failed; i++) {
    int64_t tag = get(s, "a node number");
    double x = scan_double(s, "a coordinate"), y = scan_double(s, "a coordinate");
    for (int64_t k = 0; k < attributes + markers; k++) scan_double(s, "an attribute");
    import_node(im, (uint64_t)tag, (Vec3){x, y, 0}, -1, 0, NAN);
  }
}

static void read_triangles(Import *im, Scan *s)
{
  size_t n = scan_count(s, get(s, "the number of triangles"), 6, "triangles");
  int64_t nodes = get(s, "the nodes of a triangle"), attributes = get(s, "the number of attributes");
  if (!s->failed && ((nodes != 3 && nodes != 6) || attributes < 0 || attributes > 1000)) scan_error(s, "triangles of %lld nodes", (long long)nodes);
  for (size_t i = 0; i < n && !s->failed; i++) {
    int64_t v[6];
    int tag = 0;
    get(s, "a triangle's number");
    for (int a = 0; a < nodes; a++) v[six[a]] = scan_i64(s, "a node");
    for (int64_t k = 0; k < attributes; k++) {
      double t = scan_double(s, "an attribute");
      if (k == 0 && t > 0 && t < 2e9) tag = (int)t;
    }
    if (s->failed) return;
    import_element(im, nodes == 3 ? ELEM_TRI3 : ELEM_TRI6, MAX(tag, 1), tag);
    for (int a = 0; a < nodes; a++) import_element_node(im, (uint64_t)v[a]);
  }
}

static void read_poly(Import *im, Scan *s)
{
  size_t n = scan_count(s, get(s, "the number of nodes"), 5, "nodes");
  if (n)
    read_nodes(im, s, n);
  else
    for (int i = 0; i < 3; i++) get(s, "the form of the nodes");
  n = scan_count(s, get(s, "the number of segments"), 6, "segments");
  int64_t markers = get(s, "the number of markers");
  for (size_t i = 0; i < n && !s->failed; i++) {
    get(s, "a segment's number");
    int64_t a = scan_i64(s, "a node"), b = scan_i64(s, "a node");
    int tag = 0;
    for (int64_t k = 0; k < markers && k < 1000; k++) tag = scan_int(s, "a marker");
    if (s->failed) return;
    import_element(im, ELEM_LINE2, MAX(tag, 1), MAX(tag, 0));
    import_element_node(im, (uint64_t)a);
    import_element_node(im, (uint64_t)b);
  }
}

// Run body on a sibling file if it is there.
static bool with_file(Import *im, Scan *s, const char *path, const char *ext, void (*body)(Import *, Scan *), char **keep)
{
  char *name = sibling(path, ext);
  size_t len;
  char *text = s->failed ? NULL : file_read(name, &len);
  if (text) {
    *s = (Scan){.p = text, .end = text + len, .begin = text, .name = name, .diag = s->diag};
    body(im, s);
    s->name = path;
  }
  free(name);
  *keep = text;
  return text != NULL;
}

static void read_node_file(Import *im, Scan *s) { read_nodes(im, s, scan_count(s, get(s, "the number of nodes"), 5, "nodes")); }

Mesh *triangle__read(const char *path, Diag *d, ExitCode *status)
{
  Scan s = {.name = path, .diag = d};
  Import im;
  char *text[3];
  import_begin(&im, &s);
  bool node = with_file(&im, &s, path, "node", read_node_file, &text[0]);
  bool poly = with_file(&im, &s, path, "poly", read_poly, &text[1]);
  bool ele = with_file(&im, &s, path, "ele", read_triangles, &text[2]);
  if (!s.failed && !node && !poly && !ele) {
    diag_error(d, NO_LOC, "%s: %s", path, strerror(ENOENT));
    s.failed = true;
    *status = EXIT_ENVIRONMENT;
  }
  Mesh *m = import_finish(&im);
  for (int i = 0; i < 3; i++) free(text[i]);
  return m;
}
