// msh_pieces.c - entities of parts in MSH 4 files, put back on the entities they are pieces of
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_join.h"
#include "out/msh_read_int.h"

static uint64_t piece_key(int dim, int tag) { return (uint64_t)dim << 32 | (uint32_t)tag; }

const Piece *msh_pieces__find(const Reader *r, int dim, int tag)
{
  uint32_t i = r->piece.len ? map_get(&r->pieces, piece_key(dim, tag)) : NONE;
  return i == NONE ? NULL : &r->piece.data[i];
}

static void add_piece(Reader *r, int dim, int tag, Piece p)
{
  bool added;
  map_slot(&r->pieces, piece_key(dim, tag), (uint32_t)r->piece.len, &added);
  if (!added) scan_error(r->s, "entity %d of dimension %d is defined twice", tag, dim);
  vec_push(&r->piece, p);
}

static void read_piece(Reader *r, int dim)
{
  IntVec part = {0}, ignored = {0};
  int tag = get_int(r, "an entity tag");
  Piece p = {.parent_dim = get_int(r, "a dimension")};
  p.parent_tag = get_int(r, "an entity tag");
  get_tags(r, &part, true, "a part");
  get_point(r);
  if (dim || r->version == 400) get_point(r);
  get_tags(r, &ignored, false, "a group tag");
  if (dim) get_tags(r, &ignored, false, "a boundary tag");
  if (part.len) import_part(&r->im, part.data[0]);
  p.part = r->im.part;
  p.foreign = p.parent_dim != dim || !part.len;
  if (!r->s->failed) add_piece(r, dim, tag, p);
  vec_free(&part);
}

void msh_pieces__read(Reader *r)
{
  size_t count[4];
  import_part(&r->im, get_size(r, "the number of parts"));
  size_t ghosts = get_count(r, 4, 8, "ghost entities");
  IntVec ghost = {0};
  for (size_t i = 0; i < ghosts && !r->s->failed; i++) {
    vec_push(&ghost, get_int(r, "an entity tag"));
    get_int(r, "a part");
  }
  for (int dim = 0; dim < 4; dim++) count[dim] = get_count(r, 8, 40, "entities");
  for (int dim = 0; dim < 4; dim++)
    for (size_t i = 0; i < count[dim] && !r->s->failed; i++) read_piece(r, dim);
  // Ghost entities are told by their tags alone: they are of the largest dimension that has elements, and
  // named after all others.
  for (size_t i = 0; i < ghost.len && !r->s->failed; i++)
    for (int dim = count[3] ? 3 : count[2] ? 2 : 1; dim >= 1; dim--)
      if (!msh_pieces__find(r, dim, ghost.data[i])) {
        add_piece(r, dim, ghost.data[i], (Piece){.parent_dim = -1, .foreign = true, .ghosts = true});
        break;
      }
  vec_free(&ghost);
  import_part(&r->im, 0);
}

// Groups of parts are named after them, and mean nothing once the parts' entities are gone.
static void drop_part_groups(Mesh *m)
{
  size_t kept = 0;
  for (size_t g = 0; g < m->ngroup; g++)
    if (m->group[g].name && strncmp(m->group[g].name, "_part{", 6) == 0)
      free(m->group[g].name);
    else
      m->group[kept++] = m->group[g];
  m->ngroup = kept;
}

Mesh *msh_pieces__finish(Reader *r)
{
  Mesh *m = import_finish(&r->im);
  if (m && r->piece.len) drop_part_groups(m);
  if (m && r->doubtful.len) {
    bool *doubtful = mem_zalloc(m->nnode * sizeof *doubtful);
    for (size_t i = 0; i < r->doubtful.len; i++)
      memset(doubtful + r->doubtful.data[i].first, true, r->doubtful.data[i].n * sizeof *doubtful);
    mesh_drop_unused(m, doubtful);
    free(doubtful);
  }
  map_free(&r->pieces);
  vec_free(&r->piece);
  vec_free(&r->doubtful);
  return m;
}
