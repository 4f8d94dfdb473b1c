// msh_read.c - reader of MSH 1, 2.x, 4.0 and 4.1, ASCII and binary
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/msh_read_int.h"

// Nodes of the types of dimension 3, which are skipped; 0 for others.
static int volume_nodes(int type)
{
  static const uint8_t n[][2] = {{4, 4}, {5, 8}, {6, 6}, {7, 5}, {11, 10}, {12, 27}, {13, 18}, {14, 14}, {17, 20}, {18, 15},
                                 {19, 13}, {29, 20}, {30, 35}, {31, 56}, {92, 64}, {93, 125}, {90, 40}, {91, 75}, {118, 30}, {119, 55}};
  for (size_t i = 0; i < ARRAY_LEN(n); i++)
    if (n[i][0] == type) return n[i][1];
  return 0;
}

// Nodes of a type, or 0 after an error.
static int nodes_of_type(Reader *r, int type)
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

// ---- MSH 1 and 2 --------------------------------------------------------------------------------------------------------------
static void read_nodes2(Reader *r, bool parametric)
{
  Scan *s = r->s;
  bool binary = s->binary;
  s->binary = false;
  int64_t count = scan_i64(s, "the number of nodes");
  scan_line(s);
  s->binary = binary;
  size_t n = scan_count(s, count, binary ? 28 : 8, "nodes");
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

static void add_element2(Reader *r, int type, int64_t physical, int64_t entity)
{
  if (physical < -INT32_MAX || physical > INT32_MAX || entity < -INT32_MAX || entity > INT32_MAX)
    scan_error(r->s, "a tag is out of range");
  import_element(&r->im, (ElemType)type, (int)entity, (int)physical);
}

// The tags beyond group and entity: how many parts, the element's own, and those that see it as a ghost cell;
// before 2.2 the part alone.
static void set_part2(Reader *r, const int64_t tag[4], int64_t ntags)
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
  int type = (int)scan_range(s, 1, 200, "element type"), n = nodes_of_type(r, type);
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
    set_part2(r, tag, ntags);
  }
  if (s->failed) return;
  if (volume_nodes(type)) {
    scan_line(s);
    r->im.volumes++;
    return;
  }
  add_element2(r, type, tag[0], tag[1]);
  for (int k = 0; k < n; k++) import_element_node(&r->im, (uint64_t)scan_i64(s, "a node"));
}

static void read_binary_elements(Reader *r, size_t n)
{
  Scan *s = r->s;
  for (size_t done = 0; done < n && !s->failed;) {
    int32_t type = scan_b32(s, "an element header"), count = scan_b32(s, "an element header"),
            ntags = scan_b32(s, "an element header");
    if (s->failed) return;
    int nodes = nodes_of_type(r, type);
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
      set_part2(r, tag, ntags);
      if (volume_nodes(type)) {
        scan_bytes(s, 4 * (size_t)nodes, "an element");
        r->im.volumes++;
        continue;
      }
      add_element2(r, type, tag[0], tag[1]);
      for (int k = 0; k < nodes; k++) import_element_node(&r->im, (uint64_t)scan_b32(s, "a node"));
    }
    done += (size_t)count;
  }
}

static void read_elements2(Reader *r)
{
  Scan *s = r->s;
  bool binary = s->binary;
  s->binary = false;
  int64_t count = scan_i64(s, "the number of elements");
  scan_line(s);
  s->binary = binary;
  size_t n = scan_count(s, count, 8, "elements");
  if (binary)
    read_binary_elements(r, n);
  else
    for (size_t i = 0; i < n && !s->failed; i++) read_ascii_element(r);
}

// ---- MSH 4 ----------------------------------------------------------------------------------------------------------------------
// Boundary of a face: signed curves; tags beyond the largest curve are embedded curves, raised by it.
static void part_embedded(MeshEntity *e, int largest_curve)
{
  size_t kept = 0;
  for (size_t i = 0; i < e->boundary.len; i++) {
    int tag = e->boundary.data[i];
    if (tag > largest_curve)
      vec_push(&e->embedded, tag - largest_curve);
    else
      e->boundary.data[kept++] = tag;
  }
  e->boundary.len = kept;
}

static void read_entity(Reader *r, int dim, int *largest_curve)
{
  int tag = get_int(r, "an entity tag");
  Vec3 lo = get_point(r), hi = dim || r->version == 400 ? get_point(r) : lo;
  if (r->s->failed) return;
  MeshEntity volume = {0}, *e = dim < 3 ? import_entity(&r->im, dim, tag) : &volume;
  e->lo = lo;
  e->hi = hi;
  get_tags(r, &e->physical, dim < 3, "a group tag");
  if (dim) get_tags(r, &e->boundary, dim < 3, "a boundary tag");
  if (dim == 1) *largest_curve = MAX(*largest_curve, tag);
  if (dim == 2) part_embedded(e, *largest_curve);
}

static void read_entities(Reader *r)
{
  size_t count[4];
  static const size_t bytes[4] = {36, 64, 64, 64};
  int largest_curve = 0;
  for (int dim = 0; dim < 4; dim++) count[dim] = get_count(r, 8, bytes[dim] - 8, "entities");
  for (int dim = 0; dim < 4; dim++)
    for (size_t i = 0; i < count[dim] && !r->s->failed; i++) read_entity(r, dim, &largest_curve);
}

// Header of a block: entity, a number that says what the block is of, count.
typedef struct {
  int dim, tag, kind;
  size_t n;
} BlockHead;

static BlockHead read_head(Reader *r, size_t text, size_t bytes, const char *what)
{
  BlockHead h = {0};
  int a = get_int(r, "a dimension"), b = get_int(r, "an entity tag");
  h.dim = r->version == 400 ? b : a;
  h.tag = r->version == 400 ? a : b;
  h.kind = get_int(r, "a block header");
  h.n = get_count(r, text, bytes, what);
  if (!r->s->failed && (h.dim < 0 || h.dim > 3)) scan_error(r->s, "dimension %d of a block", h.dim);
  if (r->s->failed) h.n = 0;
  return h;
}

// Place of the nodes' entity as import_node wants it: nodes in volumes are on no entity known here.
static void set_owner(Reader *r, BlockHead *h, int *dim, int *tag)
{
  const Piece *p = msh_pieces__find(r, h->dim, h->tag);
  *dim = p ? p->parent_dim : h->dim;
  *tag = p ? p->parent_tag : h->tag;
  if (*dim < 0 || *dim > 2) *dim = -1;
  if (p && p->ghosts) vec_push(&r->doubtful, ((NodeRange){r->im.mesh->nnode, h->n}));
}

static void read_node_block41(Reader *r, const BlockHead *h, int dim, int entity)
{
  Scan *s = r->s;
  int extra = h->kind ? h->dim : 0;
  if (!extra && msh__bulk_nodes(&r->im, h->n, dim, entity)) return;
  Scan tags = *s; // the numbers come before the coordinates, and mostly one by one
  uint64_t first = 0;
  bool dense = true;
  for (size_t i = 0; i < h->n && !s->failed; i++) {
    uint64_t tag = (uint64_t)get_size(r, "a node number");
    if (i == 0) first = tag;
    dense = dense && tag == first + i;
  }
  for (size_t i = 0; i < h->n && !s->failed; i++) {
    uint64_t tag = dense ? first + i : tags.binary ? scan_b64(&tags, "a node") : (uint64_t)scan_i64(&tags, "a node");
    Vec3 x = get_point(r);
    double u = NAN;
    for (int k = 0; k < extra; k++) {
      double v = get_double(r, "a parameter");
      if (k == 0 && h->dim == 1) u = v;
    }
    import_node(&r->im, tag, x, dim, entity, u);
  }
}

static void read_nodes4(Reader *r)
{
  Scan *s = r->s;
  size_t blocks = get_count(r, 8, 20, "blocks"), total = get_count(r, 8, 28, "nodes");
  if (r->version == 410) {
    get_size(r, "the least node number");
    get_size(r, "the largest node number");
  }
  import_reserve_nodes(&r->im, total);
  for (size_t b = 0; b < blocks && !s->failed; b++) {
    BlockHead h = read_head(r, 8, r->version == 410 ? 32 : 28, "nodes");
    int dim, entity;
    set_owner(r, &h, &dim, &entity);
    if (r->version == 410) {
      read_node_block41(r, &h, dim, entity);
      continue;
    }
    for (size_t i = 0; i < h.n && !s->failed; i++) {
      int64_t tag = s->binary ? scan_b32(s, "a node") : scan_i64(s, "a node number");
      Vec3 x = get_point(r);
      double u = NAN;
      for (int k = 0; k < (h.kind ? h.dim : 0); k++) {
        double v = get_double(r, "a parameter");
        if (k == 0 && h.dim == 1) u = v;
      }
      import_node(&r->im, (uint64_t)tag, x, dim, entity, u);
    }
  }
  if (!s->failed && r->im.mesh->nnode != total)
    scan_error(s, "%zu nodes were announced, %zu are there", total, r->im.mesh->nnode);
}

static void read_element_block(Reader *r, const BlockHead *h)
{
  Scan *s = r->s;
  int nodes = nodes_of_type(r, h->kind);
  bool wide = r->version == 410, volume = volume_nodes(h->kind) != 0;
  if (s->failed) return;
  if (!volume && elem_dim((ElemType)h->kind) != h->dim) {
    scan_error(s, "elements of type %d in an entity of dimension %d", h->kind, h->dim);
    return;
  }
  if (s->binary) {
    size_t size = (wide ? 8 : 4) * (1 + (size_t)nodes);
    if (h->n > scan_left(s) / size) {
      scan_error(s, "the file ends within a block of %zu elements", h->n);
      return;
    }
    if (volume) s->p += size * h->n;
  } else if (volume) {
    scan_line(s);
    for (size_t i = 0; i < h->n; i++) scan_line(s);
  }
  if (volume) {
    r->im.volumes += h->n;
    return;
  }
  if (!s->binary && scan_count(s, (int64_t)h->n, 2 * (1 + (size_t)nodes), "elements") != h->n) return;
  const Piece *piece = msh_pieces__find(r, h->dim, h->tag);
  import_part(&r->im, piece ? piece->part : 0);
  uint32_t *to = import_elements(&r->im, (ElemType)h->kind, piece ? piece->parent_tag : h->tag, 0, h->n);
  bool done = wide && msh__bulk_elements(&r->im, h->n, (size_t)nodes, to);
  for (size_t i = 0; !done && i < h->n && !s->failed; i++) {
    if (!s->binary)
      scan_i64(s, "an element number");
    else if (wide)
      scan_b64(s, "an element");
    else
      scan_b32(s, "an element");
    for (int k = 0; k < nodes; k++) {
      uint64_t tag = !s->binary ? (uint64_t)scan_i64(s, "a node") : wide ? scan_b64(s, "a node") : (uint32_t)scan_b32(s, "a node");
      *to++ = import_find(&r->im, tag);
    }
  }
  if (piece && piece->foreign) import_drop(&r->im);
}

static void read_elements4(Reader *r)
{
  Scan *s = r->s;
  size_t blocks = get_count(r, 8, 20, "blocks");
  int64_t total = get_size(r, "the number of elements");
  if (r->version == 410) {
    get_size(r, "the least element number");
    get_size(r, "the largest element number");
  }
  int64_t found = 0;
  for (size_t b = 0; b < blocks && !s->failed; b++) {
    BlockHead h = read_head(r, 4, 8, "elements");
    read_element_block(r, &h);
    found += (int64_t)h.n;
  }
  if (!s->failed && found != total)
    scan_error(s, "%lld elements were announced, %lld are there", (long long)total, (long long)found);
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
    read_entities(r);
  } else if (strcmp(name, "PartitionedEntities") == 0 && v4) {
    msh_pieces__read(r);
  } else if (strcmp(name, "Nodes") == 0 || strcmp(name, "NOD") == 0 || strcmp(name, "ParametricNodes") == 0) {
    if (known_nodes) scan_error(r->s, "a second section $%s", name);
    r->nodes_seen = true;
    if (v4)
      read_nodes4(r);
    else
      read_nodes2(r, name[0] == 'P');
  } else if (strcmp(name, "Elements") == 0 || strcmp(name, "ELM") == 0) {
    if (v4)
      read_elements4(r);
    else
      read_elements2(r);
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
