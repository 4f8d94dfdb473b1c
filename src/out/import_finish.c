// import_finish.c - what was gathered becomes a mesh: entities, blocks, nodes on their entities, boxes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/partition.h"
#include "out/import_int.h"

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
    if (count) memcpy(to, import__run_nodes(im, r), count * sizeof *to);
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

void import__free_runs(Import *im)
{
  for (size_t i = 0; i < im->run.len; i++) free(im->run.data[i].own);
  vec_free(&im->run);
  vec_free(&im->node);
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
  import__free_runs(im);
  map_free(&im->index);
}

Mesh *import_finish(Import *im)
{
  Mesh *m = im->mesh;
  if (!im->s->failed) import__resolve_groups(im);
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
