// import.c - gathers what a reader finds, in any order and with any numbers, into a Mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/import.h"

#include <math.h>

#include "mesh/partition.h"

void import_begin(Import *im, Scan *s)
{
  *im = (Import){.s = s, .mesh = mesh_new(), .dense = true};
}

void import_reserve_nodes(Import *im, size_t n)
{
  Mesh *m = im->mesh;
  size_t want = m->nnode + n;
  if (want > m->node_cap) {
    mem_grow(&m->xyz, &m->node_cap, want, 3 * sizeof *m->xyz);
    m->node_entity = mem_realloc(m->node_entity, m->node_cap * sizeof *m->node_entity);
    m->node_u = mem_realloc(m->node_u, m->node_cap * sizeof *m->node_u);
  }
}

static void own_nodes(Import *im, int dim, int entity)
{
  if (!im->owner.len || vec_last(&im->owner).dim != dim || vec_last(&im->owner).entity != entity)
    vec_push(&im->owner, ((ImportOwner){dim, entity, im->mesh->nnode}));
}

double *import_room(Import *im, uint64_t first, size_t n)
{
  Mesh *m = im->mesh;
  bool continues = m->nnode == 0 || first == im->tag0 + m->nnode;
  if (!im->dense || !continues || n >= NONE - 2 - m->nnode) return NULL;
  import_reserve_nodes(im, n);
  return m->xyz + 3 * m->nnode;
}

void import_filled(Import *im, uint64_t first, size_t n, int dim, int entity)
{
  Mesh *m = im->mesh;
  if (m->nnode == 0) im->tag0 = first;
  own_nodes(im, dim, entity);
  for (size_t i = 0; i < n; i++) m->node_u[m->nnode + i] = NAN;
  m->nnode += n; // node_entity is filled at the end
}

// The numbers stopped being consecutive: from now on they are looked up.
static void make_sparse(Import *im)
{
  im->dense = false;
  map_reserve(&im->index, im->mesh->nnode);
  for (size_t i = 0; i < im->mesh->nnode; i++) {
    map_set(&im->index, im->tag0 + i, (uint32_t)i);
    vec_push(&im->number, im->tag0 + i);
  }
}

void import_node_slow(Import *im, uint64_t tag, Vec3 x, int dim, int entity, double u)
{
  Mesh *m = im->mesh;
  if (m->nnode == m->node_cap) import_reserve_nodes(im, MAX(m->nnode, (size_t)64));
  if (m->nnode == 0) im->tag0 = tag;
  if (im->dense && tag != im->tag0 + m->nnode) make_sparse(im);
  if (!im->dense) {
    bool added;
    if (tag == UINT64_MAX) {
      scan_error(im->s, "node number out of range");
      return;
    }
    map_slot(&im->index, tag, (uint32_t)m->nnode, &added);
    if (!added) {
      scan_error(im->s, "node %llu is defined twice", (unsigned long long)tag);
      return;
    }
    vec_push(&im->number, tag);
  }
  if (m->nnode >= NONE - 2) {
    scan_error(im->s, "too many nodes");
    return;
  }
  own_nodes(im, dim, entity);
  mesh_add_node(m, x, 0, u);
}

uint32_t import_find_slow(Import *im, uint64_t tag)
{
  uint32_t i = im->dense || tag == UINT64_MAX ? NONE : map_get(&im->index, tag);
  if (i != NONE) return i;
  scan_error(im->s, "node %llu is not defined", (unsigned long long)tag);
  return 0;
}

static ImportRun *run_for(Import *im, ElemType type, int entity, int physical)
{
  if (im->run.len) {
    ImportRun *r = &vec_last(&im->run);
    if (!r->own && r->type == type && r->entity == entity && r->physical == physical && r->part == im->part)
      return r;
  }
  vec_push(&im->run, ((ImportRun){elem_dim(type), entity, physical, type, 0, im->node.len, NULL, im->part}));
  return &vec_last(&im->run);
}

void import_element(Import *im, ElemType type, int entity, int physical) { run_for(im, type, entity, physical)->n++; }

uint32_t *import_elements(Import *im, ElemType type, int entity, int physical, size_t n)
{
  uint32_t *own = mem_alloc(n * (size_t)elem_nodes(type) * sizeof *own);
  vec_push(&im->run, ((ImportRun){elem_dim(type), entity, physical, type, n, 0, own, im->part}));
  return own;
}

void import_drop(Import *im)
{
  free(vec_last(&im->run).own);
  im->run.len--;
}

void import_part(Import *im, int64_t part)
{
  if (part < 0 || part > IMPORT_MAX_PARTS) {
    scan_error(im->s, "part %lld: parts are 1 to %d", (long long)part, IMPORT_MAX_PARTS);
    return;
  }
  im->part = (uint32_t)part;
  im->nparts = MAX(im->nparts, im->part);
}

MeshEntity *import_entity(Import *im, int dim, int tag)
{
  Box3 none = box3_empty();
  vec_push(&im->entity, ((MeshEntity){.dim = dim, .tag = tag, .lo = none.lo, .hi = none.hi}));
  return &vec_last(&im->entity);
}

void import_group(Import *im, int dim, int tag, const char *name)
{
  for (size_t i = 0; i < im->mesh->ngroup; i++) {
    MeshGroup *g = &im->mesh->group[i];
    if (g->dim != dim || g->tag != tag) continue;
    if (!g->name && name && *name) g->name = mem_strdup(name);
    return;
  }
  mesh_add_group(im->mesh, dim, tag, name && *name ? name : NULL);
}

int import_group_named(Import *im, int dim, const char *name)
{
  int largest = 0;
  for (size_t i = 0; i < im->mesh->ngroup; i++) {
    const MeshGroup *g = &im->mesh->group[i];
    if (g->dim != dim) continue;
    if (g->name && strcmp(g->name, name) == 0) return g->tag;
    largest = MAX(largest, g->tag);
  }
  mesh_add_group(im->mesh, dim, largest + 1, name);
  return largest + 1;
}

// ---- groups told per element ----------------------------------------------------------------------------------------------
// In formats of this kind an element of several groups stands there several times, and elements of one entity may be in
// different groups. Equal elements become one; each set of groups of an entity becomes an entity.

typedef struct {
  uint32_t key[4];    // least nodes of the element, ascending: enough to tell nearly all apart
  size_t run, index;  // which element
} Copy;

static const uint32_t *nodes_of_run(const Import *im, const ImportRun *r) { return r->own ? r->own : im->node.data + r->first; }

static const uint32_t *nodes_of(const Import *im, const Copy *c)
{
  const ImportRun *r = &im->run.data[c->run];
  return nodes_of_run(im, r) + c->index * (size_t)elem_nodes(r->type);
}

static int copy_order(const void *x, const void *y)
{
  const Copy *a = x, *b = y;
  for (int i = 0; i < 4; i++)
    if (a->key[i] != b->key[i]) return a->key[i] < b->key[i] ? -1 : 1;
  if (a->run != b->run) return a->run < b->run ? -1 : 1;
  return a->index < b->index ? -1 : a->index > b->index;
}

static int place_order(const void *x, const void *y)
{
  const Copy *a = x, *b = y;
  if (a->run != b->run) return a->run < b->run ? -1 : 1;
  return a->index < b->index ? -1 : a->index > b->index;
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

// Merge the runs of one entity (all of one dimension and tag) whose groups differ.
static void merge_entity(Import *im, const size_t *runs, size_t nruns, Merged *out, int *next_tag)
{
  const ImportRun *first = &im->run.data[runs[0]];
  int dim = first->dim, tag = first->entity;
  Vec(Copy) copy = {0};
  for (size_t i = 0; i < nruns; i++)
    for (size_t k = 0; k < im->run.data[runs[i]].n; k++) {
      Copy c = {.run = runs[i], .index = k};
      copy_key(im, &c);
      vec_push(&copy, c);
    }
  qsort(copy.data, copy.len, sizeof *copy.data, copy_order);
  // Each class of equal elements is told by its first copy; its groups are kept in a flat list.
  Vec(Copy) unique = {0};
  IntVec groups = {0};
  bool *taken = mem_zalloc(copy.len);
  for (size_t i = 0; i < copy.len; i++) {
    if (taken[i]) continue;
    ElemType type = im->run.data[copy.data[i].run].type;
    Copy c = copy.data[i];
    c.key[0] = (uint32_t)groups.len;
    if (im->run.data[c.run].physical) vec_push(&groups, im->run.data[c.run].physical);
    for (size_t j = i + 1; j < copy.len && memcmp(copy.data[j].key, copy.data[i].key, sizeof c.key) == 0; j++) {
      const ImportRun *r = &im->run.data[copy.data[j].run];
      int sign = taken[j] || r->type != type ? 0 : same_element(im, type, &copy.data[i], &copy.data[j]);
      bool seen = r->physical == im->run.data[c.run].physical; // a true duplicate stays one, for the audit to find
      if (!sign || seen || !r->physical) continue;
      taken[j] = true;
      vec_push(&groups, sign * r->physical);
    }
    c.key[1] = (uint32_t)groups.len;
    vec_push(&unique, c);
  }
  qsort(unique.data, unique.len, sizeof *unique.data, place_order);
  out->sets.len = 0;
  for (size_t i = 0; i < unique.len; i++) {
    const Copy *c = &unique.data[i];
    IntVec g = {groups.data + c->key[0], c->key[1] - c->key[0], 0};
    add_merged(im, out, c, tag_of_set(&out->sets, &g, tag, next_tag));
  }
  for (size_t i = 0; i < out->sets.len; i++) {
    GroupSet *s = &out->sets.data[i];
    import_entity(im, dim, s->tag)->physical = s->groups;
  }
  free(taken);
  vec_free(&copy);
  vec_free(&unique);
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

static void free_runs(Import *im)
{
  for (size_t i = 0; i < im->run.len; i++) free(im->run.data[i].own);
  vec_free(&im->run);
  vec_free(&im->node);
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
    memcpy(out->node.data + out->node.len, nodes_of_run(im, r), n * sizeof *out->node.data);
    out->node.len += n;
  }
  vec_push(&out->run, copy);
}

// Give every entity its groups, where groups are told per element.
static void resolve_groups(Import *im)
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
  free_runs(im);
  im->node = out.node;
  im->run.data = out.run.data;
  im->run.len = out.run.len;
  im->run.cap = out.run.cap;
}

// ---- putting it together ------------------------------------------------------------------------------------------------
static int entity_order(const void *x, const void *y)
{
  const MeshEntity *a = x, *b = y;
  return a->dim != b->dim ? (a->dim < b->dim ? -1 : 1) : (a->tag > b->tag) - (a->tag < b->tag);
}

// Entities that only elements or nodes name are made too; each (dim, tag) is there once.
static void make_entities(Import *im)
{
  Mesh *m = im->mesh;
  Map seen = {0};
  bool added;
  for (size_t i = 0; i < im->entity.len; i++) {
    const MeshEntity *e = &im->entity.data[i];
    map_slot(&seen, (uint64_t)e->dim << 32 | (uint32_t)e->tag, 0, &added);
    if (!added) scan_error(im->s, "entity %d of dimension %d is defined twice", e->tag, e->dim);
  }
  for (size_t i = 0; i < im->run.len; i++) {
    const ImportRun *r = &im->run.data[i];
    map_slot(&seen, (uint64_t)r->dim << 32 | (uint32_t)r->entity, 0, &added);
    if (added) import_entity(im, r->dim, r->entity);
  }
  for (size_t i = 0; i < im->owner.len; i++) {
    const ImportOwner *o = &im->owner.data[i];
    added = false;
    if (o->dim >= 0) map_slot(&seen, (uint64_t)o->dim << 32 | (uint32_t)o->entity, 0, &added);
    if (added) import_entity(im, o->dim, o->entity);
  }
  map_free(&seen);
  if (!im->entity.len && m->nnode) import_entity(im, 0, 1); // a file of nodes alone
  if (im->entity.len) qsort(im->entity.data, im->entity.len, sizeof *im->entity.data, entity_order);
  m->entity = im->entity.data;
  m->nentity = im->entity.len;
  m->entity_cap = im->entity.cap;
  im->entity.data = NULL;
}

typedef struct {
  uint32_t entity;
  ElemType type;
  size_t run;
} RunKey;

static int key_order(const void *x, const void *y)
{
  const RunKey *a = x, *b = y;
  if (a->entity != b->entity) return a->entity < b->entity ? -1 : 1;
  if (a->type != b->type) return a->type < b->type ? -1 : 1;
  return a->run < b->run ? -1 : a->run > b->run;
}

// Parts of the last block's elements, which are those of the runs.
static void set_parts(Import *im, const RunKey *key, size_t nkey)
{
  MeshBlock *k = &im->mesh->block[im->mesh->nblock - 1];
  if (!im->nparts) return;
  k->part = mem_alloc(k->n * sizeof *k->part);
  uint32_t *to = k->part;
  for (size_t i = 0; i < nkey; i++) {
    const ImportRun *r = &im->run.data[key[i].run];
    for (size_t j = 0; j < r->n; j++) *to++ = r->part;
  }
}

// The elements of runs of one entity and type, in the order of the file.
static void make_block(Import *im, const RunKey *key, size_t nkey)
{
  ImportRun *first = &im->run.data[key->run];
  if (nkey == 1 && first->own) {
    mesh_take_block(im->mesh, key->entity, key->type, first->n, first->own);
    first->own = NULL;
    set_parts(im, key, nkey);
    return;
  }
  size_t total = 0;
  for (size_t k = 0; k < nkey; k++) total += im->run.data[key[k].run].n;
  uint32_t b = mesh_add_block(im->mesh, key->entity, key->type, total), *to = im->mesh->block[b].node;
  for (size_t k = 0; k < nkey; k++) {
    const ImportRun *r = &im->run.data[key[k].run];
    size_t count = r->n * (size_t)elem_nodes(r->type);
    if (count) memcpy(to, nodes_of_run(im, r), count * sizeof *to);
    to += count;
  }
  set_parts(im, key, nkey);
}

static void make_blocks(Import *im)
{
  size_t n = im->run.len;
  RunKey *key = mem_alloc(n * sizeof *key);
  for (size_t i = 0; i < n; i++)
    key[i] = (RunKey){mesh_find_entity(im->mesh, im->run.data[i].dim, im->run.data[i].entity), im->run.data[i].type, i};
  if (n) qsort(key, n, sizeof *key, key_order);
  for (size_t i = 0, j; i < n; i = j) {
    for (j = i; j < n && key[j].entity == key[i].entity && key[j].type == key[i].type;) j++;
    make_block(im, key + i, j - i);
  }
  free(key);
}

// A node the file puts on no entity is on the one of least dimension whose elements use it.
static void classify_nodes(Import *im)
{
  Mesh *m = im->mesh;
  bool told = true; // of all nodes, as in MSH 4
  for (size_t i = 0; i < im->owner.len; i++) {
    const ImportOwner *o = &im->owner.data[i];
    uint32_t e = o->dim < 0 ? NONE : mesh_find_entity(m, o->dim, o->entity);
    size_t end = i + 1 < im->owner.len ? im->owner.data[i + 1].first : m->nnode;
    for (size_t k = o->first; k < end; k++) m->node_entity[k] = e;
    told = told && e != NONE;
  }
  if (told) return;
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    size_t n = k->n * (size_t)elem_nodes(k->type);
    for (size_t i = 0; i < n; i++)
      if (m->node_entity[k->node[i]] == NONE) m->node_entity[k->node[i]] = k->entity;
  }
  for (size_t i = 0; i < m->nnode; i++)
    if (m->node_entity[i] == NONE) m->node_entity[i] = (uint32_t)(m->nentity - 1);
}

static int group_order(const void *x, const void *y)
{
  const MeshGroup *a = x, *b = y;
  return a->dim != b->dim ? (a->dim < b->dim ? -1 : 1) : (a->tag > b->tag) - (a->tag < b->tag);
}

// Boxes that the file does not give, from the nodes of the elements.
static void fill_boxes(Mesh *m)
{
  bool *empty = mem_alloc(m->nentity * sizeof *empty);
  for (size_t e = 0; e < m->nentity; e++) empty[e] = !(m->entity[e].lo.x <= m->entity[e].hi.x);
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    MeshEntity *e = &m->entity[k->entity];
    if (!empty[k->entity]) continue;
    Box3 box = {e->lo, e->hi};
    size_t n = k->n * (size_t)elem_nodes(k->type);
    for (size_t i = 0; i < n; i++) box = box3_with(box, mesh_xyz(m, k->node[i]));
    e->lo = box.lo;
    e->hi = box.hi;
  }
  free(empty);
}

static void free_import(Import *im)
{
  for (size_t i = 0; im->entity.data && i < im->entity.len; i++) {
    vec_free(&im->entity.data[i].physical);
    vec_free(&im->entity.data[i].boundary);
    vec_free(&im->entity.data[i].embedded);
  }
  vec_free(&im->entity);
  vec_free(&im->owner);
  vec_free(&im->number);
  free_runs(im);
  map_free(&im->index);
}

Mesh *import_finish(Import *im)
{
  Mesh *m = im->mesh;
  if (!im->s->failed) resolve_groups(im);
  if (!im->s->failed) make_entities(im);
  if (!im->s->failed) {
    make_blocks(im);
    classify_nodes(im);
    for (size_t e = 0; e < m->nentity; e++)
      for (size_t i = 0; i < m->entity[e].physical.len; i++)
        import_group(im, m->entity[e].dim, abs(m->entity[e].physical.data[i]), NULL);
    if (m->ngroup) qsort(m->group, m->ngroup, sizeof *m->group, group_order);
    fill_boxes(m);
    m->node_shift = im->tag0 - 1;
    m->node_number = im->number.data;
    im->number.data = NULL;
    m->nparts = im->nparts;
    if (m->nparts && !mesh_complete_parts(m))
      diag_warning(im->s->diag, NO_LOC, "%s: not every element is in a part, so the parts are left out",
                   im->s->name);
    if (im->volumes)
      diag_warning(im->s->diag, NO_LOC, "%s: %zu elements of dimension 3 are left out", im->s->name, im->volumes);
  }
  bool failed = im->s->failed;
  free_import(im);
  if (failed) {
    mesh_free(m);
    return NULL;
  }
  return m;
}
