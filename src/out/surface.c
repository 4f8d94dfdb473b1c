// surface.c - what OFF, OBJ, PLY and STL share: they hold the elements of dimension 2 alone
// SPDX-License-Identifier: MIT
//
// These formats are written and read here and not by a library: the one at hand passes coordinates through single precision and does
// not end on some damaged files. It reads ours in the tests.
#include "base/base.h"

#include "out/surface_int.h"

const char *surface__refuses(const Selection *s)
{
  for (size_t i = 0; i < s->nblock; i++)
    if (elem_order(s->mesh->block[s->block[i]].type) > 1) return "surface formats hold elements of order 1 only";
  return NULL;
}

typedef struct {
  const Selection *s;
  const MeshBlock *block;
  const char *prefix;
  uint64_t base;
} FaceItems;

static char *put_faces(char *p, const void *ctx, size_t from, size_t to)
{
  const FaceItems *t = ctx;
  size_t n = (size_t)elem_corners(t->block->type);
  const uint32_t *node = t->block->node + from * n;
  for (size_t i = from; i < to; i++, node += n) {
    p = t->prefix ? put_char(p, t->prefix[0]) : put_u64(p, n);
    p = put_char(put_node_numbers(p, t->s, node, NULL, n, t->base), '\n');
  }
  return p;
}

void surface__write_faces(Writer *w, const Selection *s, const MeshBlock *k, const char *prefix, uint64_t base)
{
  writer_items(w, k->n, 4 * NUMBER_MAX_TEXT, put_faces, &(FaceItems){s, k, prefix, base});
}

const MeshGroup *surface__group(const Selection *s, const MeshBlock *k)
{
  const MeshEntity *e = &s->mesh->entity[k->entity];
  return e->physical.len ? mesh_find_group(s->mesh, e->dim, abs(e->physical.data[0])) : NULL;
}
