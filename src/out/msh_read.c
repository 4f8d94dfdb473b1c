// msh_read.c - reader of MSH 1, 2.x, 4.0 and 4.1, ASCII and binary: the file, and the sections that all versions share
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/msh_read_int.h"

// Nodes of the types of dimension 3; 0 for others.
static int volume_nodes(int type)
{
  static const uint8_t n[][2] = {{4, 4}, {5, 8}, {6, 6}, {7, 5}, {11, 10}, {12, 27}, {13, 18}, {14, 14}, {17, 20}, {18, 15},
                                 {19, 13}, {29, 20}, {30, 35}, {31, 56}, {92, 64}, {93, 125}, {90, 40}, {91, 75}, {118, 30}, {119, 55}};
  for (size_t i = 0; i < ARRAY_LEN(n); i++)
    if (n[i][0] == type) return n[i][1];
  return 0;
}

int msh_read__nodes(Reader *r, int type)
{
  int n = elem_nodes((ElemType)type);
  if (!n) n = volume_nodes(type);
  if (!n) scan_error(r->s, "element type %d is not known here", type);
  return n;
}

// ---- sections common to the versions ----------------------------------------------------------------------------------------
static void read_format(Reader *r)
{
  Scan *s = r->s;
  double v = scan_double(s, "the version");
  int type = (int)scan_range(s, 0, 1, "file type"), size = (int)scan_range(s, 4, 8, "data size");
  r->version = (int)lround(100 * v);
  scan_line(s);
  bool good = (r->version >= 200 && r->version <= 220) || r->version == 400 || r->version == 410;
  if (!s->failed && !good) scan_error(s, "MSH version %g is not read (1, 2, 2.1, 2.2, 4 and 4.1 are)", v);
  if (!s->failed && size != 8) scan_error(s, "data size %d is not read (8 is)", size);
  if (s->failed || !type) return;
  s->binary = true;
  int32_t one = scan_b32(s, "the byte-order mark");
  if (one == 0x01000000)
    s->swap = true;
  else if (one != 1)
    scan_error(s, "the byte-order mark is neither 1 nor 1 reversed");
}

// dim tag "name", the dimension missing before 2.1; always text.
static void read_names(Reader *r)
{
  Scan *s = r->s;
  bool binary = s->binary;
  s->binary = false;
  size_t n = scan_count(s, scan_i64(s, "the number of names"), 4, "names");
  for (size_t i = 0; i < n && !s->failed; i++) {
    int dim = r->version < 210 && r->version >= 200 ? 2 : (int)scan_range(s, 0, 3, "dimension");
    int tag = scan_int(s, "group tag");
    const char *from, *to;
    if (!scan_get_line(s, &from, &to)) {
      scan_error(s, "a name in quotes expected");
      break;
    }
    const char *open = memchr(from, '"', (size_t)(to - from)), *close = to;
    while (open && close > open + 1 && close[-1] != '"') close--;
    if (!open || close <= open + 1) {
      scan_error(s, "a name in quotes expected");
      break;
    }
    char *name = mem_alloc((size_t)(close - open));
    memcpy(name, open + 1, (size_t)(close - open - 2));
    name[close - open - 2] = 0;
    if (dim <= 2) import_group(&r->im, dim, abs(tag), name);
    free(name);
  }
  s->binary = binary;
}

static void set_affine(Reader *r, MeshPeriodic *p, size_t n)
{
  for (size_t i = 0; i < n; i++) {
    double v = get_double(r, "a number of the map");
    if (p && i < 16) p->affine[i] = v;
  }
  if (p) p->has_affine = n == 16;
}

static void read_periodic(Reader *r)
{
  Scan *s = r->s;
  // In MSH 2 this section is text even in binary files.
  bool binary = s->binary;
  if (r->version < 400) s->binary = false;
  size_t n = get_count(r, 6, 12, "periodic links");
  for (size_t i = 0; i < n && !s->failed; i++) {
    int dim = get_int(r, "dimension"), tag = get_int(r, "entity tag"), master = get_int(r, "entity tag");
    if (dim < 0 || dim > 2) {
      scan_error(s, "dimension %d of a periodic link", dim);
      break;
    }
    MeshPeriodic *p = mesh_add_periodic(r->im.mesh, dim, tag, master);
    if (r->version == 410) {
      set_affine(r, p, get_count(r, 2, 8, "numbers of the map"));
    } else if (!s->binary) {
      scan_space(s);
      if (scan_left(s) > 6 && memcmp(s->p, "Affine", 6) == 0) {
        s->p += 6;
        set_affine(r, p, 16);
      }
    }
    size_t pairs = get_count(r, 4, r->version == 410 ? 16 : 8, "node pairs");
    for (size_t k = 0; k < pairs && !s->failed; k++) {
      bool wide = r->version == 410;
      uint64_t a = (uint64_t)(wide ? get_size(r, "a node") : get_int(r, "a node"));
      uint64_t b = (uint64_t)(wide ? get_size(r, "a node") : get_int(r, "a node"));
      vec_push(&p->slave_node, import_find(&r->im, a));
      vec_push(&p->master_node, import_find(&r->im, b));
    }
  }
  s->binary = binary;
}

// ---- the file ---------------------------------------------------------------------------------------------------------------------
// End of section `name`: the next $End. Text after a complete section is no error, a missing end is.
static void read_end(Reader *r, const char *name)
{
  Scan *s = r->s;
  char want[80];
  if (s->failed) return;
  snprintf(want, sizeof want, r->version == 100 && strncmp(name, "Comments", 8) != 0 ? "$END%s" : "$End%s", name);
  bool binary = s->binary;
  s->binary = false;
  scan_space(s);
  size_t n = strlen(want);
  if (scan_left(s) < n || memcmp(s->p, want, n) != 0)
    scan_error(s, "%s expected", want);
  else
    scan_line(s);
  s->binary = binary;
}

// A section that is not read: its bytes may be anything, so its end is looked for everywhere.
static void skip_section(Reader *r, const char *name)
{
  Scan *s = r->s;
  char want[80];
  snprintf(want, sizeof want, "$End%s", name);
  const char *q = memmem(s->p, scan_left(s), want, strlen(want));
  if (!q) {
    scan_error(s, "section $%s does not end", name);
    return;
  }
  s->p = q;
}

static void read_section(Reader *r, const char *name)
{
  bool v4 = r->version >= 400, known_nodes = r->nodes_seen;
  if (!r->version) {
    scan_error(r->s, "$MeshFormat (or $NOD) expected before $%s", name);
  } else if (strcmp(name, "PhysicalNames") == 0) {
    read_names(r);
  } else if (strcmp(name, "Entities") == 0 && v4) {
    msh4_read__entities(r);
  } else if (strcmp(name, "PartitionedEntities") == 0 && v4) {
    msh_pieces__read(r);
  } else if (strcmp(name, "Nodes") == 0 || strcmp(name, "NOD") == 0 || strcmp(name, "ParametricNodes") == 0) {
    if (known_nodes) scan_error(r->s, "a second section $%s", name);
    r->nodes_seen = true;
    if (v4)
      msh4_read__nodes(r);
    else
      msh2_read__nodes(r, name[0] == 'P');
  } else if (strcmp(name, "Elements") == 0 || strcmp(name, "ELM") == 0) {
    if (v4)
      msh4_read__elements(r);
    else
      msh2_read__elements(r);
  } else if (strcmp(name, "Periodic") == 0) {
    read_periodic(r);
  } else {
    skip_section(r, name);
  }
}

// The name after '$' at the place of reading; what follows the name on its line is left alone.
static bool next_section(Scan *s, char *name, size_t cap)
{
  bool binary = s->binary;
  s->binary = false;
  bool found = scan_to(s, "$");
  if (found) {
    s->p++;
    scan_word(s, name, cap);
    scan_line(s);
  }
  s->binary = binary;
  return found;
}

Mesh *msh__read(Scan s)
{
  Reader r = {.s = &s};
  char section[64];
  import_begin(&r.im, &s);
  while (next_section(&s, section, sizeof section)) {
    if (strcmp(section, "MeshFormat") == 0) {
      if (r.version) scan_error(&s, "a second $MeshFormat");
      read_format(&r);
    } else {
      if (!r.version && strcmp(section, "NOD") == 0) r.version = 100;
      read_section(&r, section);
    }
    read_end(&r, section);
  }
  if (!s.failed && !r.version) scan_error(&s, "this is no MSH file: neither $MeshFormat nor $NOD");
  return msh_pieces__finish(&r);
}
