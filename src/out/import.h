// import.h - gathers what a reader finds, in any order and with any numbers, into a Mesh
// SPDX-License-Identifier: MIT
#ifndef OUT_IMPORT_H
#define OUT_IMPORT_H

#include "base/map.h"
#include "mesh/element.h"
#include "mesh/mesh.h"
#include "out/scan.h"

// Elements that followed each other with the same type, entity and group.
typedef struct {
  int dim, entity, physical; // physical: 0 for none, or where the entity tells
  ElemType type;
  size_t n, first;           // elements; where in Import.node their nodes begin
  uint32_t *own;             // or their nodes, if they came all at once
  uint32_t part;             // of a mesh in parts; 0: not told
} ImportRun;

// Nodes that followed each other on the same entity; dim -1 if the file does not say which.
typedef struct {
  int dim, entity;
  size_t first;
} ImportOwner;

typedef struct {
  Scan *s;
  Mesh *mesh;               // nodes are added to it as they come
  Vec(ImportOwner) owner;   // by first node
  uint64_t tag0;            // nodes are numbered tag0, tag0 + 1, ... as long as dense
  bool dense;
  Map index;                // of node tags, once they are not dense
  Vec(uint64_t) number;     // and these tags
  U32Vec node;              // nodes of the elements of the runs that have none of their own
  Vec(ImportRun) run;
  Vec(MeshEntity) entity;   // that the file describes
  size_t volumes;           // elements of dimension 3, left out
  uint32_t part, nparts;    // of the elements to come; the largest so far: 0 in a mesh that is not in parts
} Import;

// Begin with an empty mesh. Errors go to s; end with import_finish.
void import_begin(Import *im, Scan *s);

// import_node where it is not as it mostly is.
void import_node_slow(Import *im, uint64_t tag, Vec3 x, int dim, int entity, double u);
// Add a node: its number, place, the entity the file puts it on (dim -1 if it does not say) and its parameter there or NAN.
static inline void import_node(Import *im, uint64_t tag, Vec3 x, int dim, int entity, double u)
{
  Mesh *m = im->mesh;
  size_t i = m->nnode;
  const ImportOwner *o = im->owner.len ? &vec_last(&im->owner) : NULL;
  if (!o || o->dim != dim || o->entity != entity || !im->dense || tag != im->tag0 + i || i == m->node_cap) {
    import_node_slow(im, tag, x, dim, entity, u);
    return;
  }
  m->xyz[3 * i] = x.x;
  m->xyz[3 * i + 1] = x.y;
  m->xyz[3 * i + 2] = x.z;
  m->node_u[i] = u;
  m->nnode++; // node_entity is filled at the end
}
// Room for n more nodes, so that arrays need not grow one by one.
void import_reserve_nodes(Import *im, size_t n);
// Room for the coordinates of n nodes numbered first, first + 1, ..., or NULL if these do not continue those there are. Nothing is
// added before import_filled, which takes the same numbers.
double *import_room(Import *im, uint64_t first, size_t n);
void import_filled(Import *im, uint64_t first, size_t n, int dim, int entity);
uint32_t import_find_slow(Import *im, uint64_t tag);
// Index of a node by its tag; an error if there is none.
static inline uint32_t import_find(Import *im, uint64_t tag)
{
  uint64_t k = tag - im->tag0;
  return im->dense && k < im->mesh->nnode ? (uint32_t)k : import_find_slow(im, tag);
}

// Begin an element: follow with elem_nodes(type) calls of import_element_node. A type of 0 or of dimension 3 is not allowed.
void import_element(Import *im, ElemType type, int entity, int physical);
static inline void import_element_node(Import *im, uint64_t tag) { vec_push(&im->node, import_find(im, tag)); }
// Room for the nodes of n elements to come in this run, at the returned address.
uint32_t *import_elements(Import *im, ElemType type, int entity, int physical, size_t n);

// Take back what the last import_elements began.
void import_drop(Import *im);
// The part of the elements to come (0: not told), of at most IMPORT_MAX_PARTS.
enum { IMPORT_MAX_PARTS = 1000000 };
void import_part(Import *im, int64_t part);

// Describe an entity; valid until the next one. The caller may fill its box, groups and boundary.
MeshEntity *import_entity(Import *im, int dim, int tag);
// A group, or, for one that is there without one, its name; name may be NULL or empty.
void import_group(Import *im, int dim, int tag, const char *name);
// Tag of the group of that name and dimension, made with the next free tag if it is new.
int import_group_named(Import *im, int dim, const char *name);

// Put all in order. Returns the mesh, or NULL if the scan failed; frees the rest.
Mesh *import_finish(Import *im);

#endif
