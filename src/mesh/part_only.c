// part_only.c - what the computer of one part needs of a mesh, as a mesh of its own
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/part_entities.h"

typedef struct {
  PartOnly *out;
  const Mesh *m;
  uint32_t part;
  uint32_t *entity; // of m's, their index in the new mesh, or NONE
  uint32_t *local;  // of m's nodes, NONE if not (yet) there
  U32Vec node;      // m's nodes in the new mesh
  const Ghosts *ghosts;
  size_t ghost; // the next one
} Extract;

static bool in_part(const MeshEntity *e, uint32_t part)
{
  for (size_t i = 0; i < e->parts.len; i++)
    if ((uint32_t)e->parts.data[i] == part) return true;
  return false;
}

static void copy_ints(IntVec *to, const IntVec *from)
{
  for (size_t i = 0; i < from->len; i++) vec_push(to, from->data[i]);
}

// Of what bounds a piece, what is there: pieces of curves may end at points of other parts.
static void keep_bounds_here(const Mesh *m, MeshEntity *e)
{
  size_t kept = 0;
  for (size_t i = 0; i < e->boundary.len; i++)
    if (mesh_find_entity(m, e->dim - 1, abs(e->boundary.data[i])) != NONE)
      e->boundary.data[kept++] = e->boundary.data[i];
  e->boundary.len = kept;
}

static void copy_entities(Extract *x)
{
  for (size_t i = 0; i < x->m->nentity; i++) {
    const MeshEntity *from = &x->m->entity[i];
    x->entity[i] = NONE;
    if (from->parts.len && !in_part(from, x->part)) continue;
    x->entity[i] = mesh_add_entity(x->out->mesh, from->dim, from->tag);
    MeshEntity *to = &x->out->mesh->entity[x->entity[i]];
    *to = *from;
    to->physical = to->boundary = to->embedded = to->parts = (IntVec){0};
    copy_ints(&to->physical, &from->physical);
    copy_ints(&to->boundary, &from->boundary);
    copy_ints(&to->embedded, &from->embedded);
    copy_ints(&to->parts, &from->parts);
  }
  for (size_t i = 0; i < x->out->mesh->nentity; i++)
    if (x->out->mesh->entity[i].parts.len) keep_bounds_here(x->out->mesh, &x->out->mesh->entity[i]);
}

// Index of a node in the new mesh, on its entity if that is there, else on `entity`.
static uint32_t local_node(Extract *x, uint32_t node, uint32_t entity)
{
  if (x->local[node] != NONE) return x->local[node];
  uint32_t own = x->entity[x->m->node_entity[node]];
  bool here = own != NONE;
  vec_push(&x->node, node);
  return x->local[node] = mesh_add_node(x->out->mesh, mesh_xyz(x->m, node), here ? own : entity,
                                        here ? x->m->node_u[node] : NAN);
}

static void take_element(Extract *x, const MeshBlock *from, size_t i, uint32_t entity, uint32_t *to)
{
  size_t n = (size_t)elem_nodes(from->type);
  for (size_t c = 0; c < n; c++) to[c] = local_node(x, from->node[i * n + c], entity);
}

// If the element of m is a ghost cell of other parts, so is it in the new mesh. Elements come in order.
static void carry_ghost(Extract *x, uint32_t block, size_t index, uint32_t to_block, size_t to_index)
{
  const Ghosts *g = x->ghosts;
  const GhostCell *c = NULL;
  for (; g && x->ghost < g->cell.len; x->ghost++) {
    c = &g->cell.data[x->ghost];
    if (c->block > block || (c->block == block && c->index >= index)) break;
  }
  if (!g || x->ghost == g->cell.len || c->block != block || c->index != index) return;
  Ghosts *to = &x->out->ghosts;
  vec_push(&to->cell, ((GhostCell){to_block, (uint32_t)to_index, (uint32_t)to->part.len, c->n}));
  for (uint32_t i = 0; i < c->n; i++) vec_push(&to->part, g->part.data[c->first + i]);
}

// Elements of a block that belong to the part: all of a piece's, of other entities those of the part.
static void copy_block(Extract *x, uint32_t b)
{
  const MeshBlock *from = &x->m->block[b];
  uint32_t entity = x->entity[from->entity];
  bool whole = x->m->entity[from->entity].parts.len > 0;
  size_t count = whole ? from->n : 0, n = (size_t)elem_nodes(from->type);
  if (entity == NONE || (!whole && !from->part)) return;
  for (size_t i = 0; !whole && i < from->n; i++) count += from->part[i] == x->part;
  if (!count) return;
  uint32_t k = mesh_add_block(x->out->mesh, entity, from->type, count), *to = x->out->mesh->block[k].node;
  uint32_t *part = from->part ? mem_alloc(count * sizeof *part) : NULL;
  size_t done = 0;
  for (size_t i = 0; i < from->n; i++) {
    if (!whole && from->part[i] != x->part) continue;
    take_element(x, from, i, entity, to + done * n);
    if (part) part[done] = from->part[i];
    carry_ghost(x, b, i, k, done++);
  }
  x->out->mesh->block[k].part = part;
  vec_push(&x->out->block_of, whole ? b : NONE);
}

static bool is_ghost_in(const Ghosts *g, const GhostCell *cell, uint32_t part)
{
  for (uint32_t i = 0; i < cell->n; i++)
    if (g->part.data[cell->first + i] == part) return true;
  return false;
}

// One block for each type.
static void add_ghosts(Extract *x, const Ghosts *g, int tag)
{
  Mesh *out = x->out->mesh;
  U32Vec cell = {0};
  int dim = 0;
  for (uint32_t i = 0; i < g->cell.len; i++)
    if (is_ghost_in(g, &g->cell.data[i], x->part)) {
      vec_push(&cell, i);
      dim = elem_dim(x->m->block[g->cell.data[i].block].type);
    }
  if (cell.len) {
    uint32_t entity = mesh_add_entity(out, dim, tag);
    out->entity[entity].parent_dim = -1;
    out->entity[entity].saved = true;
    vec_push(&out->entity[entity].parts, (int)x->part);
    for (ElemType type = ELEM_LINE2; type <= ELEM_QUAD12; type++) {
      size_t count = 0, n = (size_t)elem_nodes(type);
      for (size_t i = 0; i < cell.len; i++)
        count += x->m->block[g->cell.data[cell.data[i]].block].type == type;
      if (!count) continue;
      uint32_t k = mesh_add_block(out, entity, type, count), *to = out->block[k].node;
      vec_push(&x->out->block_of, NONE);
      for (size_t i = 0; i < cell.len; i++) {
        const GhostCell *c = &g->cell.data[cell.data[i]];
        if (x->m->block[c->block].type != type) continue;
        take_element(x, &x->m->block[c->block], c->index, entity, to);
        vec_push(&x->out->ghost_of, cell.data[i]);
        to += n;
      }
    }
  }
  vec_free(&cell);
}

// Pairs of which both nodes are there.
static void copy_pairs(Extract *x)
{
  for (size_t i = 0; i < x->m->nperiodic; i++) {
    const MeshPeriodic *from = &x->m->periodic[i];
    MeshPeriodic *to = NULL;
    for (size_t k = 0; k < from->slave_node.len; k++) {
      uint32_t a = x->local[from->slave_node.data[k]], b = x->local[from->master_node.data[k]];
      if (a == NONE || b == NONE) continue;
      if (!to) {
        to = mesh_add_periodic(x->out->mesh, from->dim, from->tag, from->master);
        to->has_affine = from->has_affine;
        memcpy(to->affine, from->affine, sizeof to->affine);
      }
      vec_push(&to->slave_node, a);
      vec_push(&to->master_node, b);
    }
  }
}

void mesh_part_only(PartOnly *out, const Mesh *m, uint32_t part, const Ghosts *ghosts, int ghost_tag,
                    uint32_t *local)
{
  *out = (PartOnly){.mesh = mesh_new()};
  Extract x = {.out = out,
               .m = m,
               .part = part,
               .ghosts = ghosts,
               .entity = mem_alloc(m->nentity * sizeof(uint32_t)),
               .local = local};
  out->mesh->nparts = m->nparts;
  copy_entities(&x);
  for (size_t g = 0; g < m->ngroup; g++)
    mesh_add_group(out->mesh, m->group[g].dim, m->group[g].tag, m->group[g].name);
  out->mesh->volumes_grouped = m->volumes_grouped;
  for (uint32_t b = 0; b < m->nblock; b++) copy_block(&x, b);
  if (ghosts && ghost_tag) add_ghosts(&x, ghosts, ghost_tag);
  copy_pairs(&x);
  out->mesh->node_number = mem_alloc(x.node.len * sizeof *out->mesh->node_number);
  for (size_t i = 0; i < x.node.len; i++) {
    out->mesh->node_number[i] = (uint64_t)x.node.data[i] + 1;
    local[x.node.data[i]] = NONE;
  }
  vec_free(&x.node);
  free(x.entity);
}

void part_only_free(PartOnly *p)
{
  mesh_free(p->mesh);
  vec_free(&p->block_of);
  vec_free(&p->ghost_of);
  ghosts_free(&p->ghosts);
}
