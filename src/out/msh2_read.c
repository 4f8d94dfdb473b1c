// msh2_read.c - sections of nodes and elements of MSH 1 and 2, ASCII and binary
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/msh_read_int.h"

// A count, which is text in binary files, too.
static int64_t read_count(Scan *s, const char *what)
{
  bool binary = s->binary;
  s->binary = false;
  int64_t count = scan_i64(s, what);
  scan_line(s);
  s->binary = binary;
  return count;
}

void msh2_read__nodes(Reader *r, bool parametric)
{
  Scan *s = r->s;
  bool binary = s->binary;
  size_t n = scan_count(s, read_count(s, "the number of nodes"), binary ? 28 : 8, "nodes");
  import_reserve_nodes(&r->im, n);
  for (size_t i = 0; i < n && !s->failed; i++) {
    int64_t tag = binary ? scan_b32(s, "a node number") : scan_i64(s, "a node number");
    Vec3 x = get_point(r);
    int dim = -1, entity = 0;
    double u = NAN;
    if (parametric) {
      dim = get_int(r, "a dimension");
      entity = get_int(r, "an entity tag");
      if (dim == 1 || dim == 2) u = get_double(r, "a parameter");
      if (dim == 2) get_double(r, "a parameter");
      if (dim != 1) u = NAN;
      if (dim < 0 || dim > 2) dim = -1;
    }
    import_node(&r->im, (uint64_t)tag, x, dim, entity, u);
  }
}

static void add_element(Reader *r, int type, int64_t physical, int64_t entity)
{
  if (physical < -INT32_MAX || physical > INT32_MAX || entity < -INT32_MAX || entity > INT32_MAX)
    scan_error(r->s, "a tag is out of range");
  import_element(&r->im, (ElemType)type, (int)entity, (int)physical);
}

// The tags beyond group and entity: how many parts, the element's own, and those that see it as a ghost cell;
// before 2.2 the part alone.
static void set_part(Reader *r, const int64_t tag[4], int64_t ntags)
{
  if (r->version < 220)
    import_part(&r->im, ntags >= 3 ? tag[2] : 0);
  else
    import_part(&r->im, ntags >= 4 && tag[2] > 0 ? tag[3] : 0);
}

static void read_ascii_element(Reader *r)
{
  Scan *s = r->s;
  scan_i64(s, "an element number");
  int type = (int)scan_range(s, 1, 200, "element type"), n = msh_read__nodes(r, type);
  int64_t tag[4] = {0, 0, 0, 0};
  if (r->version == 100) {
    tag[0] = scan_i64(s, "a group");
    tag[1] = scan_i64(s, "an entity");
    if (scan_i64(s, "the number of nodes") != n) scan_error(s, "an element of type %d has %d nodes", type, n);
  } else {
    int64_t ntags = scan_range(s, 0, 1000, "number of tags");
    for (int64_t k = 0; k < ntags; k++) {
      int64_t t = scan_i64(s, "a tag");
      if (k < 4) tag[k] = t;
    }
    set_part(r, tag, ntags);
  }
  if (s->failed) return;
  if (msh_read__is_volume(type)) {
    scan_line(s);
    r->im.volumes++;
    return;
  }
  add_element(r, type, tag[0], tag[1]);
  for (int k = 0; k < n; k++) import_element_node(&r->im, (uint64_t)scan_i64(s, "a node"));
}

static void read_binary_elements(Reader *r, size_t n)
{
  Scan *s = r->s;
  for (size_t done = 0; done < n && !s->failed;) {
    int32_t type = scan_b32(s, "an element header"), count = scan_b32(s, "an element header"),
            ntags = scan_b32(s, "an element header");
    if (s->failed) return;
    int nodes = msh_read__nodes(r, type);
    if (count <= 0 || ntags < 0 || ntags > 1000 || (size_t)count > n - done) {
      scan_error(s, "an element header of %d elements with %d tags", count, ntags);
      return;
    }
    size_t size = (1 + (size_t)ntags + (size_t)nodes) * 4;
    scan_count(s, count, size, "elements");
    for (int32_t i = 0; i < count && !s->failed; i++) {
      int64_t tag[4] = {0, 0, 0, 0};
      scan_b32(s, "an element number");
      for (int32_t k = 0; k < ntags; k++) {
        int32_t t = scan_b32(s, "a tag");
        if (k < 4) tag[k] = t;
      }
      set_part(r, tag, ntags);
      if (msh_read__is_volume(type)) {
        scan_bytes(s, 4 * (size_t)nodes, "an element");
        r->im.volumes++;
        continue;
      }
      add_element(r, type, tag[0], tag[1]);
      for (int k = 0; k < nodes; k++) import_element_node(&r->im, (uint64_t)scan_b32(s, "a node"));
    }
    done += (size_t)count;
  }
}

void msh2_read__elements(Reader *r)
{
  Scan *s = r->s;
  size_t n = scan_count(s, read_count(s, "the number of elements"), 8, "elements");
  if (s->binary)
    read_binary_elements(r, n);
  else
    for (size_t i = 0; i < n && !s->failed; i++) read_ascii_element(r);
}
