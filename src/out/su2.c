// su2.c - SU2 meshes with markers, written and read
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/import.h"
#include "out/out_int.h"

const char *su2__refuses(const Selection *s)
{
  for (size_t i = 0; i < s->nblock; i++)
    if (elem_order(s->mesh->block[s->block[i]].type) > 1) return "SU2 files hold elements of order 1 only";
  return select__not_flat(s) ? "SU2 files of dimension 2 hold meshes of the plane z = 0 only" : NULL;
}

static size_t write_cells(Writer *w, const Selection *s, const MeshBlock *k, size_t number, bool numbered)
{
  int vtk = vtk__cell_type(k->type);
  size_t nodes = (size_t)elem_nodes(k->type);
  for (size_t i = 0; i < k->n; i++) {
    char *p0 = writer_reserve(w, 128), *p = put_u64(p0, (uint64_t)vtk);
    p = put_node_numbers(p, s, k->node + i * nodes, NULL, nodes, 0);
    if (numbered) p = put_u64(put_char(p, ' '), number++);
    p = put_char(p, '\n');
    writer_commit(w, (size_t)(p - p0));
  }
  return number;
}

static size_t marker_lines(const Selection *s, const MeshGroup *g)
{
  size_t n = 0;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    if (select__in_group(&s->mesh->entity[k->entity], g)) n += k->n;
  }
  return n;
}

void su2__write(Writer *w, const Selection *s, const OutOptions *o)
{
  const Mesh *m = s->mesh;
  size_t cells = 0, number = 0, markers = 0;
  (void)o;
  for (size_t i = 0; i < s->nblock; i++)
    if (elem_dim(m->block[s->block[i]].type) == 2) cells += m->block[s->block[i]].n;
  writer_printf(w, "NDIME= 2\nNELEM= %zu\n", cells);
  for (size_t i = 0; i < s->nblock; i++)
    if (elem_dim(m->block[s->block[i]].type) == 2) number = write_cells(w, s, &m->block[s->block[i]], number, true);
  writer_printf(w, "NPOIN= %zu\n", s->nnode);
  for (size_t k = 0; k < s->nnode; k++) {
    Vec3 x = select__xyz(s, k);
    char *p0 = writer_reserve(w, 128), *p = put_char(put_double(p0, x.x), ' ');
    p = put_char(put_u64(put_char(put_double(p, x.y), ' '), k), '\n');
    writer_commit(w, (size_t)(p - p0));
  }
  for (size_t g = 0; g < m->ngroup; g++) markers += m->group[g].dim == 1 && marker_lines(s, &m->group[g]) > 0;
  writer_printf(w, "NMARK= %zu\n", markers);
  for (size_t g = 0; g < m->ngroup; g++) {
    size_t n = m->group[g].dim == 1 ? marker_lines(s, &m->group[g]) : 0;
    if (!n) continue;
    char name[256];
    select__group_name(&m->group[g], name, sizeof name);
    writer_printf(w, "MARKER_TAG= %s\nMARKER_ELEMS= %zu\n", name, n);
    for (size_t i = 0; i < s->nblock; i++)
      if (select__in_group(&m->entity[m->block[s->block[i]].entity], &m->group[g])) write_cells(w, s, &m->block[s->block[i]], 0, false);
  }
}

// ---- reading ----------------------------------------------------------------------------------------------------------------
// Step over n lines.
static void skip_lines(Scan *s, size_t n)
{
  while (n-- && s->p < s->end) scan_line(s);
}

static bool keyword(const char *from, const char *to, const char *key, const char **value)
{
  size_t n = strlen(key);
  if ((size_t)(to - from) < n || memcmp(from, key, n) != 0) return false;
  while (from + n < to && (from[n] == ' ' || from[n] == '\t')) from++;
  if (from + n >= to || from[n] != '=') return false;
  for (*value = from + n + 1; *value < to && (unsigned char)**value <= ' ';) ++*value;
  return true;
}

static size_t value_count(Scan *s, const char *value, const char *to, const char *what)
{
  int64_t n = 0;
  if (number_read_i64(value, to, &n) == value) scan_error(s, "the number of %s expected", what);
  return scan_count(s, n, 3, what);
}

static void read_cells(Import *im, Scan *s, size_t n, int dim, int entity, int physical)
{
  for (size_t i = 0; i < n && !s->failed; i++) {
    int64_t vtk = scan_i64(s, "a cell type");
    ElemType t = vtk == 3 ? ELEM_LINE2 : vtk == 5 ? ELEM_TRI3 : vtk == 9 ? ELEM_QUAD4 : ELEM_POINT;
    if (elem_dim(t) != dim) {
      scan_error(s, "a cell of type %lld where dimension %d is due", (long long)vtk, dim);
      return;
    }
    import_element(im, t, entity, physical);
    for (int a = 0; a < elem_nodes(t); a++) import_element_node(im, (uint64_t)scan_i64(s, "a point"));
    scan_line(s);
  }
}

static void read_points(Import *im, Scan *s, size_t n)
{
  import_reserve_nodes(im, n);
  for (size_t i = 0; i < n && !s->failed; i++) {
    double x = scan_double(s, "a coordinate"), y = scan_double(s, "a coordinate");
    scan_line(s); // the number that may follow is the position anyway
    import_node(im, i, (Vec3){x, y, 0}, -1, 0, NAN);
  }
}

static void read_marker(Import *im, Scan *s, const char *name, size_t len, int index, size_t n)
{
  char *copy = mem_alloc(len + 1);
  memcpy(copy, name, len);
  copy[len] = 0;
  int tag = import_group_named(im, 1, copy);
  free(copy);
  read_cells(im, s, n, 1, index, tag);
}

Mesh *su2__read(Scan s)
{
  Scan cells = s;
  Import im;
  size_t ncell = 0;
  int markers = 0;
  const char *from, *to, *value, *name = NULL, *name_end = NULL;
  import_begin(&im, &s);
  while (scan_get_line(&s, &from, &to)) {
    const char *comment = memchr(from, '%', (size_t)(to - from));
    if (comment) to = comment;
    if (keyword(from, to, "NDIME", &value)) {
      if (*value != '2') scan_error(&s, "only meshes of dimension 2 are read");
    } else if (keyword(from, to, "NELEM", &value)) {
      ncell = value_count(&s, value, to, "elements");
      cells.p = s.p;
      skip_lines(&s, ncell);
    } else if (keyword(from, to, "NPOIN", &value)) {
      read_points(&im, &s, value_count(&s, value, to, "points"));
    } else if (keyword(from, to, "MARKER_TAG", &value)) {
      name = value;
      name_end = to;
      while (name_end > name && (unsigned char)name_end[-1] <= ' ') name_end--;
    } else if (keyword(from, to, "MARKER_ELEMS", &value)) {
      if (!name) scan_error(&s, "MARKER_ELEMS before MARKER_TAG");
      else read_marker(&im, &s, name, (size_t)(name_end - name), ++markers, value_count(&s, value, to, "elements"));
    }
  }
  if (!s.failed && !ncell) scan_error(&s, "no NELEM= in this file");
  if (!s.failed) {
    Scan end = s;
    s.p = cells.p;
    read_cells(&im, &s, ncell, 2, 1, 0);
    if (!s.failed) s = end;
  }
  return import_finish(&im);
}
