// import.c - gathers what a reader finds, in any order and with any numbers, into a Mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/import.h"

#include <math.h>


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
