// msh4_part.c - sections of MSH 4.1 for meshes in parts: $PartitionedEntities and $GhostElements
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/msh4_int.h"

static bool is_ghosts(const MeshEntity *t) { return t->parts.len && t->parent_dim < 0; }

static void write_entity(Enc *e, const Selection *s, const MeshEntity *t)
{
  Vec3 lo = vec3_scale(s->scale, t->lo), hi = vec3_scale(s->scale, t->hi);
  if (!(t->lo.x <= t->hi.x)) lo = hi = (Vec3){0, 0, 0};
  put_int(e, t->tag);
  put_int(e, t->parent_dim);
  put_int(e, t->parent_tag);
  put_tags(e, &t->parts);
  put_vec(e, s->scale < 0 && t->dim ? hi : lo);
  if (t->dim) put_vec(e, s->scale < 0 ? lo : hi);
  put_tags(e, &t->physical);
  if (t->dim) put_tags(e, &t->boundary);
  end_line(e);
}

// Entities of ghost cells: tag and part. All parts have one, or a file's own alone.
static void write_ghost_entities(Enc *e, const PartFile *p)
{
  uint32_t first = p->part ? p->part : 1, last = p->part ? p->part : p->nparts;
  put_size(e, p->ghosts ? last - first + 1 : 0);
  end_line(e);
  for (uint32_t k = first; p->ghosts && k <= last; k++) {
    put_int(e, p->ghost_tag + (int)k - 1);
    put_int(e, (int)k);
    end_line(e);
  }
}

void msh4_part__write_entities(Enc *e, const Selection *s)
{
  const Mesh *m = s->mesh;
  size_t count[3] = {0, 0, 0};
  for (size_t i = 0; i < m->nentity; i++)
    count[m->entity[i].dim] += m->entity[i].parts.len && !is_ghosts(&m->entity[i]);
  writer_str(e->w, "$PartitionedEntities\n");
  put_size(e, s->parts->nparts);
  end_line(e);
  write_ghost_entities(e, s->parts);
  for (int d = 0; d < 3; d++) put_size(e, count[d]);
  put_size(e, 0);
  end_line(e);
  for (size_t i = 0; i < m->nentity; i++)
    if (m->entity[i].parts.len && !is_ghosts(&m->entity[i])) write_entity(e, s, &m->entity[i]);
  writer_str(e->w, e->binary ? "\n$EndPartitionedEntities\n" : "$EndPartitionedEntities\n");
}

static void write_ghost(Enc *e, uint64_t number, uint32_t owner, const uint32_t *part, uint32_t n)
{
  put_size(e, number);
  put_int(e, (int)owner);
  put_size(e, n);
  for (uint32_t i = 0; i < n; i++) put_int(e, (int)part[i]);
  end_line(e);
}

// Of a file with all parts: every element that others see, with those that do.
static void write_all_ghosts(Enc *e, const Selection *s)
{
  const Ghosts *g = s->parts->ghosts;
  const Mesh *m = s->mesh;
  uint64_t *first = mem_alloc(m->nblock * sizeof *first), number = s->elem0;
  for (size_t i = 0; i < s->nblock; i++) {
    first[s->block[i]] = number;
    number += m->block[s->block[i]].n;
  }
  put_size(e, g->cell.len);
  end_line(e);
  for (size_t i = 0; i < g->cell.len; i++) {
    const GhostCell *c = &g->cell.data[i];
    write_ghost(e, first[c->block] + c->index, m->block[c->block].part[c->index], g->part.data + c->first,
                c->n);
  }
  free(first);
}

// Of a file for one part: the ghost cells of that part.
static void write_own_ghosts(Enc *e, const Selection *s)
{
  const PartFile *p = s->parts;
  size_t n = 0;
  for (size_t i = 0; i < s->nblock; i++)
    if (p->first[i] == UINT64_MAX) n += s->mesh->block[s->block[i]].n;
  put_size(e, n);
  end_line(e);
  for (size_t i = 0; i < n; i++)
    write_ghost(e, p->ghost_number[i] + s->elem0, p->ghost_owner[i], &p->part, 1);
}

void msh4_part__write_ghosts(Enc *e, const Selection *s)
{
  if (!s->parts->ghosts) return;
  writer_str(e->w, "$GhostElements\n");
  if (s->parts->part)
    write_own_ghosts(e, s);
  else
    write_all_ghosts(e, s);
  writer_str(e->w, e->binary ? "\n$EndGhostElements\n" : "$EndGhostElements\n");
}
