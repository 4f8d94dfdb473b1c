// mesh_diff.c - what is different between two meshes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_diff.h"

#include "base/map.h"
#include "mesh/mesh_hash_int.h"
#include "mesh/mesh_measure.h"

// ---- which node is which ------------------------------------------------------------------------------------------------------
// Same blocks over the same node numbers?
static bool same_connectivity(const Mesh *a, const Mesh *b)
{
  if (a->nnode != b->nnode || a->nblock != b->nblock) return false;
  for (size_t k = 0; k < a->nblock; k++) {
    const MeshBlock *x = &a->block[k], *y = &b->block[k];
    const MeshEntity *e = &a->entity[x->entity], *f = &b->entity[y->entity];
    if (x->type != y->type || x->n != y->n || e->dim != f->dim || e->tag != f->tag) return false;
    if (memcmp(x->node, y->node, x->n * (size_t)elem_nodes(x->type) * sizeof *x->node) != 0) return false;
  }
  return true;
}

// Cell of a grid of spacing h that holds x + (i, j, k) cells.
static uint64_t cell_of(Vec3 x, double h, int i, int j, int k)
{
  double c[3] = {floor(x.x / h) + i, floor(x.y / h) + j, floor(x.z / h) + k};
  uint64_t key = 0;
  for (int d = 0; d < 3; d++) {
    uint64_t bits;
    memcpy(&bits, &c[d], sizeof bits);
    key = (key ^ bits ^ bits >> 29) * 0x9e3779b97f4a7c15u;
  }
  return key >> 1;
}

// Nodes of a that have no equal in b are matched with the nearest free one within tol. Cells of spacing 2 tol.
static void match_near(const Mesh *a, const Mesh *b, double tol, uint32_t *match, bool *taken)
{
  Map first = {0};
  uint32_t *next = mem_alloc(b->nnode * sizeof *next);
  bool added;
  for (uint32_t i = 0; i < b->nnode; i++) {
    if (taken[i]) continue;
    uint32_t *slot = map_slot(&first, cell_of(mesh_xyz(b, i), 2 * tol, 0, 0, 0), NONE, &added);
    next[i] = *slot;
    *slot = i;
  }
  for (uint32_t i = 0; i < a->nnode && first.len; i++) {
    if (match[i] != NONE) continue;
    Vec3 x = mesh_xyz(a, i);
    double best = tol;
    for (int c = 0; c < 27; c++)
      for (uint32_t k = map_get(&first, cell_of(x, 2 * tol, c % 3 - 1, c / 3 % 3 - 1, c / 9 - 1)); k != NONE; k = next[k]) {
        double r = vec3_distance(x, mesh_xyz(b, k));
        if (taken[k] || r > best || (r == best && match[i] != NONE && match[i] <= k)) continue;
        best = r;
        match[i] = k;
      }
    if (match[i] != NONE) taken[match[i]] = true;
  }
  map_free(&first);
  free(next);
}

// Per node of a its node in b or NONE. pa and pb: hashes of the coordinates.
static uint32_t *match_nodes(MeshDiff *d, const Mesh *a, const Mesh *b, const uint64_t *pa, const uint64_t *pb, double tol)
{
  uint32_t *match = mem_alloc(a->nnode * sizeof *match);
  d->same_numbering = same_connectivity(a, b);
  if (d->same_numbering) {
    for (uint32_t i = 0; i < a->nnode; i++) match[i] = i;
    return match;
  }
  Map place = {0};
  bool *taken = mem_zalloc(b->nnode), added;
  map_reserve(&place, b->nnode);
  for (uint32_t i = 0; i < b->nnode; i++) map_slot(&place, pb[i] >> 1, i, &added);
  for (uint32_t i = 0; i < a->nnode; i++) {
    uint32_t k = map_get(&place, pa[i] >> 1);
    match[i] = k != NONE && !taken[k] && vec3_distance(mesh_xyz(a, i), mesh_xyz(b, k)) == 0 ? k : NONE;
    if (match[i] != NONE) taken[k] = true;
  }
  map_free(&place);
  if (tol > 0) match_near(a, b, tol, match, taken);
  free(taken);
  return match;
}

static void measure_moves(MeshDiff *d, const Mesh *a, const Mesh *b, const uint32_t *match)
{
  size_t matched = 0;
  for (uint32_t i = 0; i < a->nnode; i++) {
    if (match[i] == NONE) continue;
    matched++;
    Vec3 from = mesh_xyz(a, i), to = mesh_xyz(b, match[i]);
    double r = vec3_distance(from, to);
    if (r == 0) continue;
    d->moved++;
    d->mean += r;
    if (r <= d->largest) continue;
    d->largest = r;
    d->from = from;
    d->to = to;
    d->moved_dim = a->entity[a->node_entity[i]].dim;
    d->moved_tag = a->entity[a->node_entity[i]].tag;
  }
  if (d->moved) d->mean /= (double)d->moved;
  d->alone[0] = a->nnode - matched;
  d->alone[1] = b->nnode - matched;
}

// True if the elements and groups are the same over matched nodes.
static bool same_over(const Mesh *a, const Mesh *b, const uint32_t *match, const uint64_t *pb)
{
  uint64_t *na = mem_alloc(a->nnode * sizeof *na);
  for (uint32_t i = 0; i < a->nnode; i++) na[i] = match[i] == NONE ? i : pb[match[i]];
  MeshHash x = mesh_hash__of(a, false, na, NULL), y = mesh_hash__of(b, false, pb, NULL);
  free(na);
  return memcmp(x.full, y.full, sizeof x.full) == 0;
}

// ---- elements -----------------------------------------------------------------------------------------------------------------------
static size_t count_elements(const Mesh *m)
{
  size_t n = 0;
  for (size_t b = 0; b < m->nblock; b++) n += m->block[b].n;
  return n;
}

// Elements of `of` that are not among `in` (by hash, each used once).
static void mark_changed(MeshDiff *d, int side, const uint64_t *of, size_t n, const uint64_t *in, size_t nin)
{
  Map count = {0};
  bool added;
  map_reserve(&count, nin);
  for (size_t i = 0; i < nin; i++) ++*map_slot(&count, in[i] >> 1, 0, &added);
  d->changed[side] = mem_zalloc(n);
  for (size_t i = 0; i < n; i++) {
    uint32_t *slot = map_slot(&count, of[i] >> 1, 0, &added);
    if (*slot)
      --*slot;
    else
      d->changed[side][i] = 1;
    d->nchanged[side] += d->changed[side][i];
  }
  map_free(&count);
}

// ---- entities -----------------------------------------------------------------------------------------------------------------------
static EntityDiff *entity_row(MeshDiff *d, Map *index, int dim, int tag)
{
  bool added;
  uint32_t *slot = map_slot(index, (uint64_t)dim << 32 | (uint32_t)tag, (uint32_t)d->entity.len, &added);
  if (added) vec_push(&d->entity, ((EntityDiff){.dim = dim, .tag = tag}));
  return &d->entity.data[*slot];
}

static int entity_order(const void *x, const void *y)
{
  const EntityDiff *a = x, *b = y;
  return a->dim != b->dim ? (a->dim > b->dim) - (a->dim < b->dim) : (a->tag > b->tag) - (a->tag < b->tag);
}

static void add_side(MeshDiff *d, Map *index, const Mesh *m, int side)
{
  size_t at = 0;
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    EntityDiff *e = entity_row(d, index, m->entity[k->entity].dim, m->entity[k->entity].tag);
    e->elements[side] += k->n;
    for (size_t i = 0; i < k->n; i++, at++) {
      e->changed[side] += d->changed[side][at];
      if (e->dim < 2) continue;
      double q = mesh_measure(m, k, i, elem_corners(k->type) == 3 ? MEASURE_GAMMA : MEASURE_ETA);
      e->quality[side] = e->quality[side] == 0 ? q : fmin(e->quality[side], q);
    }
  }
  for (size_t i = 0; i < d->stats[side].entity.len; i++) {
    const PartStats *p = &d->stats[side].entity.data[i];
    entity_row(d, index, p->dim, p->tag)->size[side] = p->size;
  }
}

static void compare_entities(MeshDiff *d, const Mesh *a, const Mesh *b, const uint32_t *match)
{
  Map index = {0};
  add_side(d, &index, a, 0);
  add_side(d, &index, b, 1);
  for (uint32_t i = 0; i < a->nnode; i++) {
    if (match[i] == NONE) continue;
    double r = vec3_distance(mesh_xyz(a, i), mesh_xyz(b, match[i]));
    if (r == 0) continue;
    const MeshEntity *on = &a->entity[a->node_entity[i]];
    EntityDiff *e = entity_row(d, &index, on->dim, on->tag);
    e->moved++;
    e->largest = fmax(e->largest, r);
  }
  map_free(&index);
  size_t kept = 0;
  for (size_t i = 0; i < d->entity.len; i++) {
    const EntityDiff e = d->entity.data[i];
    if (e.elements[0] != e.elements[1] || e.changed[0] || e.changed[1] || e.moved) d->entity.data[kept++] = e;
  }
  d->entity.len = kept;
  if (kept) qsort(d->entity.data, kept, sizeof *d->entity.data, entity_order);
}

// ---- groups -------------------------------------------------------------------------------------------------------------------------
// The group of b that is g of a: of the same name, or else of the same tag unless that one's name is one of a's.
static const PartStats *partner(const MeshStats *in, const MeshStats *own, const PartStats *g)
{
  const PartStats *by_tag = NULL;
  for (size_t i = 0; i < in->group.len; i++) {
    const PartStats *x = &in->group.data[i];
    if (x->dim != g->dim) continue;
    if (x->name && g->name && strcmp(x->name, g->name) == 0) return x;
    if (x->tag == g->tag) by_tag = x;
  }
  for (size_t i = 0; by_tag && by_tag->name && i < own->group.len; i++) {
    const PartStats *y = &own->group.data[i];
    if (y->dim == g->dim && y->tag != g->tag && y->name && strcmp(y->name, by_tag->name) == 0) return NULL;
  }
  return by_tag;
}

static void compare_groups(MeshDiff *d)
{
  const MeshStats *a = &d->stats[0], *b = &d->stats[1];
  for (size_t i = 0; i < a->group.len; i++) {
    const PartStats *x = &a->group.data[i], *y = partner(b, a, x);
    GroupDiff g = {.dim = x->dim, .tag = {x->tag, y ? y->tag : 0}, .name = {x->name, y ? y->name : NULL},
                   .elements = {x->elements, y ? y->elements : 0}, .size = {x->size, y ? y->size : 0}};
    bool same_name = y && (x->name ? y->name && strcmp(x->name, y->name) == 0 : !y->name);
    g.change = !y ? GROUP_LOST : !same_name ? GROUP_RENAMED : x->tag != y->tag ? GROUP_RETAGGED
               : x->elements != y->elements || fabs(x->size - y->size) > 1e-12 * x->size ? GROUP_CHANGED : GROUP_SAME;
    if (g.change != GROUP_SAME) vec_push(&d->group, g);
  }
  for (size_t i = 0; i < b->group.len; i++) {
    const PartStats *y = &b->group.data[i];
    const PartStats *x = partner(a, b, y);
    if (x) continue;
    vec_push(&d->group, ((GroupDiff){.dim = y->dim, .tag = {0, y->tag}, .name = {NULL, y->name}, .elements = {0, y->elements},
                                     .size = {0, y->size}, .change = GROUP_ADDED}));
  }
}

const char *mesh_diff_change(GroupChange c)
{
  switch (c) {
  case GROUP_SAME: return "same";
  case GROUP_ADDED: return "added";
  case GROUP_LOST: return "lost";
  case GROUP_RENAMED: return "renamed";
  case GROUP_RETAGGED: return "other tag";
  case GROUP_CHANGED: return "changed";
  }
  UNREACHABLE();
}

void mesh_diff_make(MeshDiff *d, const Mesh *a, const Mesh *b, double tol)
{
  *d = (MeshDiff){.nodes = {a->nnode, b->nnode}};
  uint64_t *pa = mesh_hash__points(a), *pb = mesh_hash__points(b);
  size_t na = count_elements(a), nb = count_elements(b);
  uint64_t *ea = mem_zalloc(na * sizeof *ea), *eb = mem_zalloc(nb * sizeof *eb);
  d->hash[0] = mesh_hash__of(a, false, pa, ea);
  d->hash[1] = mesh_hash__of(b, false, pb, eb);
  bool same = memcmp(d->hash[0].full, d->hash[1].full, sizeof d->hash[0].full) == 0;
  mesh_stats_make(&d->stats[0], a, NULL);
  mesh_stats_make(&d->stats[1], b, NULL);
  uint32_t *match = match_nodes(d, a, b, pa, pb, tol);
  if (same) {
    d->verdict = DIFF_SAME;
    d->changed[0] = mem_zalloc(na);
    d->changed[1] = mem_zalloc(nb);
  } else {
    measure_moves(d, a, b, match);
    bool within = tol > 0 && d->largest <= tol && same_over(a, b, match, pb);
    d->verdict = within ? DIFF_WITHIN : DIFF_DIFFERENT;
    mark_changed(d, 0, ea, na, eb, nb);
    mark_changed(d, 1, eb, nb, ea, na);
    compare_entities(d, a, b, match);
    compare_groups(d);
  }
  free(match);
  free(pa);
  free(pb);
  free(ea);
  free(eb);
}

void mesh_diff_free(MeshDiff *d)
{
  for (int side = 0; side < 2; side++) {
    mesh_stats_free(&d->stats[side]);
    free(d->changed[side]);
  }
  vec_free(&d->entity);
  vec_free(&d->group);
}
