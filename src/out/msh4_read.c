// msh4_read.c - sections of entities, nodes and elements of MSH 4.0 and 4.1, ASCII and binary
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/msh_read_int.h"

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

void msh4_read__entities(Reader *r)
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

// The parameters of a node: n of them, of which that on a curve is kept; NAN for others.
static double read_parameters(Reader *r, int n, int dim)
{
  double u = NAN;
  for (int k = 0; k < n; k++) {
    double v = get_double(r, "a parameter");
    if (k == 0 && dim == 1) u = v;
  }
  return u;
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
    import_node(&r->im, tag, x, dim, entity, read_parameters(r, extra, h->dim));
  }
}

void msh4_read__nodes(Reader *r)
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
      import_node(&r->im, (uint64_t)tag, x, dim, entity, read_parameters(r, h.kind ? h.dim : 0, h.dim));
    }
  }
  if (!s->failed && r->im.mesh->nnode != total)
    scan_error(s, "%zu nodes were announced, %zu are there", total, r->im.mesh->nnode);
}

// A block of elements of dimension 3, which are only counted.
static void skip_volumes(Reader *r, const BlockHead *h, size_t size)
{
  Scan *s = r->s;
  r->im.volumes += h->n;
  if (s->binary) {
    s->p += size * h->n;
    return;
  }
  scan_line(s);
  for (size_t i = 0; i < h->n; i++) scan_line(s);
}

static void read_one_by_one(Reader *r, size_t n, int nodes, uint32_t *to)
{
  Scan *s = r->s;
  bool wide = r->version == 410;
  for (size_t i = 0; i < n && !s->failed; i++) {
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
}

static void read_element_block(Reader *r, const BlockHead *h)
{
  Scan *s = r->s;
  int nodes = msh_read__nodes(r, h->kind);
  bool wide = r->version == 410, volume = msh_read__is_volume(h->kind);
  size_t size = (wide ? 8 : 4) * (1 + (size_t)nodes); // of an element in binary
  if (s->failed) return;
  if (!volume && elem_dim((ElemType)h->kind) != h->dim) {
    scan_error(s, "elements of type %d in an entity of dimension %d", h->kind, h->dim);
    return;
  }
  if (s->binary && h->n > scan_left(s) / size) {
    scan_error(s, "the file ends within a block of %zu elements", h->n);
    return;
  }
  if (volume) {
    skip_volumes(r, h, size);
    return;
  }
  if (!s->binary && scan_count(s, (int64_t)h->n, 2 * (1 + (size_t)nodes), "elements") != h->n) return;
  const Piece *piece = msh_pieces__find(r, h->dim, h->tag);
  import_part(&r->im, piece ? piece->part : 0);
  uint32_t *to = import_elements(&r->im, (ElemType)h->kind, piece ? piece->parent_tag : h->tag, 0, h->n);
  if (!wide || !msh__bulk_elements(&r->im, h->n, (size_t)nodes, to)) read_one_by_one(r, h->n, nodes, to);
  if (piece && piece->foreign) import_drop(&r->im);
}

void msh4_read__elements(Reader *r)
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
