// import_groups.c - groups that a file tells per element become groups of entities
// SPDX-License-Identifier: MIT
//
// In formats of this kind an element of several groups stands there several times, and elements of one entity may be in
// different groups. Equal elements become one; each set of groups of an entity becomes an entity.
#include "base/base.h"

#include "out/import_int.h"

typedef struct {
  uint32_t key[4];    // least nodes of the element, ascending: enough to tell nearly all apart
  size_t run, index;  // which element
} Copy;
typedef Vec(Copy) Copies;

// An element with all its groups.
typedef struct {
  Copy copy;         // the first of it
  uint32_t from, to; // its groups in a list of all
} Element;
typedef Vec(Element) Elements;

static const uint32_t *nodes_of(const Import *im, const Copy *c)
{
  const ImportRun *r = &im->run.data[c->run];
  return import__run_nodes(im, r) + c->index * (size_t)elem_nodes(r->type);
}

static int place_order(const void *x, const void *y)
{
  const Copy *a = x, *b = y;
  if (a->run != b->run) return a->run < b->run ? -1 : 1;
  return a->index < b->index ? -1 : a->index > b->index;
}

static int element_order(const void *x, const void *y)
{
  const Element *a = x, *b = y;
  return place_order(&a->copy, &b->copy);
}

static int copy_order(const void *x, const void *y)
{
  const Copy *a = x, *b = y;
  for (int i = 0; i < 4; i++)
    if (a->key[i] != b->key[i]) return a->key[i] < b->key[i] ? -1 : 1;
  return place_order(a, b);
}

// Corner nodes, ascending.
static void copy_key(const Import *im, Copy *c)
{
  const uint32_t *v = nodes_of(im, c);
  int n = elem_corners(im->run.data[c->run].type);
  for (int i = 0; i < 4; i++) {
    uint32_t x = i < n ? v[i] : NONE;
    int j = i;
    for (; j > 0 && c->key[j - 1] > x; j--) c->key[j] = c->key[j - 1];
    c->key[j] = x;
  }
}

// -1 if b is a reversed, 1 if it is a as it stands or rotated, 0 if they only share their corners.
static int same_element(const Import *im, ElemType type, const Copy *a, const Copy *b)
{
  const uint32_t *v = nodes_of(im, a), *w = nodes_of(im, b);
  int corners = elem_corners(type), rotations = corners > 2 ? corners : 1;
  for (int flip = 0; flip < 2; flip++)
    for (int r = 0; r < rotations; r++) {
      uint8_t perm[ELEM_MAX_NODES];
      int n = elem_symmetry(type, r, flip, perm), i = 0;
      while (i < n && w[i] == v[perm[i]]) i++;
      if (i == n) return flip && corners > 1 ? -1 : 1;
    }
  return 0;
}

typedef struct {
  IntVec groups;  // signed, in the order of the file
  int tag;
} GroupSet;

typedef Vec(GroupSet) GroupSets;

// Tag of the entity for elements in exactly these groups: the file's for the first set, a new one for others.
static int tag_of_set(GroupSets *sets, const IntVec *groups, int tag, int *next_tag)
{
  for (size_t i = 0; i < sets->len; i++) {
    const IntVec *g = &sets->data[i].groups;
    if (g->len == groups->len && (g->len == 0 || memcmp(g->data, groups->data, g->len * sizeof *g->data) == 0))
      return sets->data[i].tag;
  }
  GroupSet s = {.tag = sets->len ? (*next_tag)++ : tag};
  for (size_t i = 0; i < groups->len; i++) vec_push(&s.groups, groups->data[i]);
  vec_push(sets, s);
  return s.tag;
}

static void copy_out(Import *im, U32Vec *node, ImportRun *to, const Copy *c)
{
  int n = elem_nodes(to->type);
  const uint32_t *v = nodes_of(im, c);
  for (int i = 0; i < n; i++) vec_push(node, v[i]);
  to->n++;
}

typedef struct {
  U32Vec node;
  Vec(ImportRun) run;
  GroupSets sets;
} Merged;

static void add_merged(Import *im, Merged *out, const Copy *c, int tag)
{
  ElemType type = im->run.data[c->run].type;
  uint32_t part = im->run.data[c->run].part;
  const ImportRun *last = out->run.len ? &vec_last(&out->run) : NULL;
  if (!last || last->type != type || last->entity != tag || last->part != part)
    vec_push(&out->run, ((ImportRun){elem_dim(type), tag, 0, type, 0, out->node.len, NULL, part}));
  copy_out(im, &out->node, &vec_last(&out->run), c);
}

// All elements of the runs, in copy_order.
static Copies sorted_copies(const Import *im, const size_t *runs, size_t nruns)
{
  Copies copy = {0};
  for (size_t i = 0; i < nruns; i++)
    for (size_t k = 0; k < im->run.data[runs[i]].n; k++) {
      Copy c = {.run = runs[i], .index = k};
      copy_key(im, &c);
      vec_push(&copy, c);
    }
  qsort(copy.data, copy.len, sizeof *copy.data, copy_order);
  return copy;
}

// Equal elements become one, told by its first copy; its groups are appended to `groups`. In the order of the file.
static Elements find_elements(const Import *im, const Copies *copy, IntVec *groups)
{
  Elements element = {0};
  bool *taken = mem_zalloc(copy->len);
  for (size_t i = 0; i < copy->len; i++) {
    const Copy *c = &copy->data[i];
    if (taken[i]) continue;
    const ImportRun *first = &im->run.data[c->run];
    Element e = {.copy = *c, .from = (uint32_t)groups->len};
    if (first->physical) vec_push(groups, first->physical);
    for (size_t j = i + 1; j < copy->len && memcmp(copy->data[j].key, c->key, sizeof c->key) == 0; j++) {
      const ImportRun *r = &im->run.data[copy->data[j].run];
      int sign = taken[j] || r->type != first->type ? 0 : same_element(im, first->type, c, &copy->data[j]);
      bool seen = r->physical == first->physical; // a true duplicate stays one, for the audit to find
      if (!sign || seen || !r->physical) continue;
      taken[j] = true;
      vec_push(groups, sign * r->physical);
    }
    e.to = (uint32_t)groups->len;
    vec_push(&element, e);
  }
  free(taken);
  qsort(element.data, element.len, sizeof *element.data, element_order);
  return element;
}

// Merge the runs of one entity (all of one dimension and tag) whose groups differ.
static void merge_entity(Import *im, const size_t *runs, size_t nruns, Merged *out, int *next_tag)
{
  int dim = im->run.data[runs[0]].dim, tag = im->run.data[runs[0]].entity;
  IntVec groups = {0};
  Copies copy = sorted_copies(im, runs, nruns);
  Elements element = find_elements(im, &copy, &groups);
  out->sets.len = 0;
  for (size_t i = 0; i < element.len; i++) {
    const Element *e = &element.data[i];
    IntVec g = {groups.data + e->from, e->to - e->from, 0};
    add_merged(im, out, &e->copy, tag_of_set(&out->sets, &g, tag, next_tag));
  }
  for (size_t i = 0; i < out->sets.len; i++) {
    GroupSet *s = &out->sets.data[i];
    import_entity(im, dim, s->tag)->physical = s->groups;
  }
  vec_free(&copy);
  vec_free(&element);
  vec_free(&groups);
}

static int run_order(const Import *im, size_t a, size_t b)
{
  const ImportRun *x = &im->run.data[a], *y = &im->run.data[b];
  if (x->dim != y->dim) return x->dim < y->dim ? -1 : 1;
  if (x->entity != y->entity) return x->entity < y->entity ? -1 : 1;
  return 0;
}

// Indices of the runs by dimension and entity, in the order of the file within: a merge sort.
static size_t *sort_runs(const Import *im)
{
  size_t n = im->run.len, *a = mem_alloc(n * sizeof *a), *b = mem_alloc(n * sizeof *b);
  for (size_t i = 0; i < n; i++) a[i] = i;
  for (size_t w = 1; w < n; w *= 2) {
    for (size_t lo = 0; lo < n; lo += 2 * w) {
      size_t mid = MIN(lo + w, n), hi = MIN(lo + 2 * w, n), i = lo, j = mid;
      for (size_t k = lo; k < hi; k++) b[k] = i < mid && (j >= hi || run_order(im, a[i], a[j]) <= 0) ? a[i++] : a[j++];
    }
    size_t *t = a;
    a = b;
    b = t;
  }
  free(b);
  return a;
}

// Take a run over as it is.
static void keep_run(const Import *im, Merged *out, ImportRun *r)
{
  ImportRun copy = *r;
  r->own = NULL;
  if (!copy.own) {
    size_t n = copy.n * (size_t)elem_nodes(copy.type);
    copy.first = out->node.len;
    vec_reserve(&out->node, out->node.len + n);
    memcpy(out->node.data + out->node.len, import__run_nodes(im, r), n * sizeof *out->node.data);
    out->node.len += n;
  }
  vec_push(&out->run, copy);
}

// Give every entity its groups, where groups are told per element.
void import__resolve_groups(Import *im)
{
  int next_tag[3] = {1, 1, 1};
  bool any = false;
  for (size_t i = 0; i < im->run.len; i++) {
    const ImportRun *r = &im->run.data[i];
    next_tag[r->dim] = MAX(next_tag[r->dim], r->entity + 1);
    if (r->physical) {
      any = true;
      import_group(im, r->dim, abs(r->physical), NULL);
    }
  }
  if (!any) return;
  size_t *order = sort_runs(im);
  Merged out = {0};
  for (size_t i = 0, j; i < im->run.len; i = j) {
    bool differ = false;
    const ImportRun *r = &im->run.data[order[i]];
    for (j = i; j < im->run.len && run_order(im, order[i], order[j]) == 0; j++)
      differ |= im->run.data[order[j]].physical != r->physical;
    int dim = r->dim;
    if (differ) {
      merge_entity(im, order + i, j - i, &out, &next_tag[dim]);
      continue;
    }
    MeshEntity *e = import_entity(im, dim, r->entity);
    if (r->physical) vec_push(&e->physical, r->physical);
    for (size_t k = i; k < j; k++) keep_run(im, &out, &im->run.data[order[k]]);
  }
  free(order);
  vec_free(&out.sets);
  import__free_runs(im);
  im->node = out.node;
  im->run.data = out.run.data;
  im->run.len = out.run.len;
  im->run.cap = out.run.cap;
}
