// select.c - the saving rule: which elements and nodes of a mesh go into a file, and in what order
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/out_int.h"

// Nodes of saved elements marked 0, the others NONE. Orphans are kept only where all entities are saved: then it is all nodes.
static void mark_nodes(Selection *s, bool keep_orphans)
{
  const Mesh *m = s->mesh;
  memset(s->number, keep_orphans ? 0 : 0xff, m->nnode * sizeof *s->number);
  for (size_t b = 0; !keep_orphans && b < s->nblock; b++) {
    const MeshBlock *k = &m->block[s->block[b]];
    size_t n = k->n * (size_t)elem_nodes(k->type);
    for (size_t i = 0; i < n; i++) s->number[k->node[i]] = 0;
  }
}

// Number the marked nodes by entity, keeping their order within each: a counting sort.
static void number_nodes(Selection *s)
{
  const Mesh *m = s->mesh;
  size_t *start = mem_zalloc((m->nentity + 1) * sizeof *start);
  for (size_t i = 0; i < m->nnode; i++)
    if (s->number[i] == 0) start[m->node_entity[i] + 1]++;
  for (size_t e = 0; e < m->nentity; e++) start[e + 1] += start[e];
  s->nnode = start[m->nentity];
  s->node = mem_alloc(s->nnode * sizeof *s->node);
  for (size_t i = 0; i < m->nnode; i++)
    if (s->number[i] == 0) {
      size_t k = start[m->node_entity[i]]++;
      s->number[i] = (uint32_t)k;
      s->node[k] = (uint32_t)i;
    }
  free(start);
}

void select__make(Selection *s, const Mesh *m, const OutOptions *o, unsigned flags)
{
  int least = flags & FORMAT_SURFACE ? 2 : flags & FORMAT_NO_POINTS ? 1 : 0; // dimension
  *s = (Selection){.mesh = m, .scale = o->scaling == 0 ? 1 : o->scaling};
  s->node0 = o->first_node ? o->first_node : 1;
  s->elem0 = o->first_element ? o->first_element : 1;
  s->grouped = !o->save_all && mesh_is_grouped(m);
  s->entity = mem_alloc(m->nentity * sizeof *s->entity);
  for (size_t e = 0; e < m->nentity; e++)
    s->entity[e] = !s->grouped || m->entity[e].physical.len > 0 || m->entity[e].saved;
  s->block = mem_alloc(m->nblock * sizeof *s->block);
  for (size_t b = 0; b < m->nblock; b++)
    if (s->entity[m->block[b].entity] && m->block[b].n && elem_dim(m->block[b].type) >= least) {
      s->block[s->nblock++] = (uint32_t)b;
      s->nelem += m->block[b].n;
    }
  s->number = mem_alloc(m->nnode * sizeof *s->number);
  mark_nodes(s, (flags & FORMAT_ORPHANS) && !s->grouped);
  number_nodes(s);
}

void select__free(Selection *s)
{
  free(s->entity);
  free(s->number);
  free(s->node);
  free(s->block);
}

void out_warn_dropped(const Mesh *m, const OutOptions *o, Diag *d)
{
  static const char *const kind[] = {"Point", "Curve", "Surface"};
  if (o->save_all || !mesh_is_grouped(m)) return;
  int dim = mesh_count(m, 2) ? 2 : 1;
  size_t dropped = 0, entities = 0, all = mesh_count(m, dim);
  int first = 0;
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshEntity *e = &m->entity[m->block[b].entity];
    if (e->dim != dim || e->physical.len || !m->block[b].n) continue;
    if (!dropped) first = e->tag;
    if (!b || m->block[b - 1].entity != m->block[b].entity || !dropped) entities++;
    dropped += m->block[b].n;
  }
  if (!dropped) return;
  const char *what = dim == 2 ? "surface elements" : "line elements";
  if (dropped == all)
    diag_warning(d, NO_LOC, "all %zu %s are dropped on saving: there are physical groups, but no Physical %s "
                 "(-save_all saves everything)", all, what, kind[dim]);
  else
    diag_warning(d, NO_LOC, "%zu of %zu %s are dropped on saving: %s %d%s in no Physical %s (-save_all saves "
                 "everything)", dropped, all, what, dim == 2 ? "face" : "curve", first,
                 entities > 1 ? " and others are" : " is", kind[dim]);
}

int select__tag(const MeshEntity *e, const OutOptions *o)
{
  if (o->element_tag == 3) return e->parts.len ? e->parts.data[0] : 0;
  return o->element_tag == 2 ? select__physical(e) : e->tag;
}

bool select__not_flat(const Selection *s)
{
  for (size_t k = 0; k < s->nnode; k++)
    if (s->mesh->xyz[3 * (size_t)s->node[k] + 2] != 0) return true;
  return false;
}

bool select__in_group(const MeshEntity *e, const MeshGroup *g)
{
  for (size_t i = 0; e->dim == g->dim && i < e->physical.len; i++)
    if (abs(e->physical.data[i]) == g->tag) return true;
  return false;
}

void select__group_name(const MeshGroup *g, char *to, size_t cap)
{
  static const char *const unnamed[] = {"PhysicalPoint", "PhysicalLine", "PhysicalSurface"};
  if (g->name && *g->name)
    snprintf(to, cap, "%s", g->name);
  else
    snprintf(to, cap, "%s%d", unnamed[g->dim], g->tag);
  for (char *p = to; *p; p++)
    if ((unsigned char)*p <= ' ' || *p == ',' || *p == '"' || *p == '=' || *p == '%') *p = '_';
}

// ---- points, a line each ----------------------------------------------------------------------------------------------
typedef struct {
  const Selection *s;
  const char *prefix;
} PointItems;

static char *put_points(char *p, const void *ctx, size_t from, size_t to)
{
  const PointItems *t = ctx;
  size_t n = strlen(t->prefix);
  for (size_t k = from; k < to; k++) {
    if (n) p = (char *)memcpy(p, t->prefix, n) + n;
    p = put_char(put_xyz(p, select__xyz(t->s, k)), '\n');
  }
  return p;
}

void select__write_points(Writer *w, const Selection *s, const char *prefix)
{
  writer_items(w, s->nnode, 4 * NUMBER_MAX_TEXT, put_points, &(PointItems){s, prefix});
}
