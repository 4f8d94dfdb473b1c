// part_curves.c - curves divided in pieces of one part, and the seams between parts as curves
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/part_entities_int.h"

// ---- links ------------------------------------------------------------
static void add_lines(Division *d)
{
  const Mesh *m = d->m;
  for (uint32_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (elem_dim(k->type) != 1) continue;
    size_t nodes = (size_t)elem_nodes(k->type);
    for (size_t i = 0; i < k->n; i++) {
      const uint32_t *v = k->node + i * nodes;
      vec_push(&d->curves.link, ((Link){{v[0], v[1]},
                                        k->entity,
                                        part_sets__get(&d->sets, &k->part[i], 1),
                                        k->type,
                                        (uint32_t)(d->ids.base[b] + i),
                                        NONE}));
    }
  }
}

// Set of the part of a surface element.
static uint32_t part_of(const Division *d, uint32_t elem) { return d->piece[2].data[d->of[elem]].set; }

// The line along an edge of an element.
static ElemType line_type(ElemType t)
{
  static const ElemType lines[] = {ELEM_LINE2, ELEM_LINE3, ELEM_LINE4, ELEM_LINE5};
  return lines[elem_order(t) - 1];
}

// The corner of an element at which its edge of nodes a and b, in either order, begins.
static int corner_of_edge(const uint32_t *v, int corners, uint32_t a, uint32_t b)
{
  int c = 0;
  while (map_pair(v[c], v[(c + 1) % corners]) != map_pair(a, b)) c++;
  return c;
}

static void add_seam(Division *d, size_t i, size_t j)
{
  const EdgeUse *u = d->uses.use;
  while (u[i].elem < d->ids.surface0) i++;
  ElemType type;
  const uint32_t *v = elem_ids_nodes(&d->ids, d->m, u[i].elem, &type);
  int n = elem_corners(type), c = corner_of_edge(v, n, u[i].lower, u[i].upper);
  uint32_t set = part_of(d, u[i].elem);
  for (size_t k = i + 1; k < j; k++) set = part_sets__union(&d->sets, set, part_of(d, u[k].elem));
  vec_push(&d->seams.link, ((Link){{v[c], v[(c + 1) % n]},
                                   d->piece[2].data[d->of[u[i].elem]].entity,
                                   set,
                                   line_type(type),
                                   u[i].elem,
                                   NONE}));
}

// Edges whose surface elements are of different parts.
static void add_seams(Division *d)
{
  const EdgeUse *u = d->uses.use;
  for (size_t i = 0, j; i < d->uses.n; i = j) {
    j = edge_uses_end(&d->uses, i);
    uint32_t last = u[j - 1].elem; // surface elements stand last
    bool differ = false;
    for (size_t k = j - 1; k-- > i && u[k].elem >= d->ids.surface0;)
      differ |= part_of(d, u[k].elem) != part_of(d, last);
    if (differ) add_seam(d, i, j);
  }
}

static void index_links(Chains *c, size_t nnode)
{
  c->first = mem_alloc(nnode * sizeof *c->first);
  c->next = mem_alloc(2 * c->link.len * sizeof *c->next);
  if (nnode) memset(c->first, 0xff, nnode * sizeof *c->first);
  for (size_t k = 2 * c->link.len; k-- > 0;) {
    uint32_t *first = &c->first[c->link.data[k / 2].node[k % 2]];
    c->next[k] = *first;
    *first = (uint32_t)k;
  }
}

// ---- where pieces end ------------------------------------------------------------
static bool alike(const Link *a, const Link *b)
{
  return a->entity == b->entity && a->set == b->set && a->type == b->type;
}

// Everywhere but where exactly two links meet that are alike.
static bool is_end(const Chains *c, uint32_t node)
{
  uint32_t a = c->first[node], b = a == NONE ? NONE : c->next[a];
  if (a == NONE) return false;
  return b == NONE || c->next[b] != NONE || a / 2 == b / 2 ||
         !alike(&c->link.data[a / 2], &c->link.data[b / 2]);
}

// A seam may follow a curve, but ends where it meets or leaves one.
static bool leaves_curve(const Division *d, uint32_t node)
{
  if (d->curves.first[node] == NONE) return false;
  for (uint32_t k = d->seams.first[node]; k != NONE; k = d->seams.next[k]) {
    uint32_t other = d->seams.link.data[k / 2].node[1 - k % 2];
    bool along = false;
    for (uint32_t q = d->curves.first[node]; q != NONE && !along; q = d->curves.next[q])
      along = d->curves.link.data[q / 2].node[1 - q % 2] == other;
    if (!along) return true;
  }
  return false;
}

static void mark_ends(Division *d)
{
  const Mesh *m = d->m;
  for (uint32_t v = 0; v < m->nnode; v++) {
    bool linked = d->curves.first[v] != NONE || d->seams.first[v] != NONE;
    d->ends[v] = linked && (m->entity[m->node_entity[v]].dim == 0 || is_end(&d->curves, v) ||
                            is_end(&d->seams, v) || leaves_curve(d, v));
  }
}

// ---- pieces ------------------------------------------------------------
typedef struct {
  Division *d;
  Chains *c;
  bool between;
} Walk;

// Nodes of a seam from end to end: the corners, then the nodes within the edge as they stand in its element.
static void push_seam_nodes(Division *d, const Link *l)
{
  ElemType type;
  const uint32_t *v = elem_ids_nodes(&d->ids, d->m, l->elem, &type);
  int n = elem_corners(type), within = elem_order(type) - 1, c = corner_of_edge(v, n, l->node[0], l->node[1]);
  vec_push(&d->node, l->node[0]);
  vec_push(&d->node, l->node[1]);
  for (int i = 0; i < within; i++)
    vec_push(&d->node, v[n + c * within + (v[c] == l->node[0] ? i : within - 1 - i)]);
}

// Take the links from `link` on, entered at its end `from`, up to a node where pieces end, or all around.
static void walk(Walk *w, size_t link, int from)
{
  Division *d = w->d;
  Link *l = &w->c->link.data[link];
  Piece p = {.entity = l->entity,
             .set = l->set,
             .between = w->between,
             .type = l->type,
             .first = d->node.len,
             .ends = {NONE, NONE}};
  uint32_t piece = (uint32_t)d->piece[1].len, begin = l->node[from], end = begin;
  int entered = from;
  for (;;) {
    l->piece = piece;
    p.n++;
    if (w->between && from) {
      uint32_t t = l->node[0]; // seams run as they are walked
      l->node[0] = l->node[1];
      l->node[1] = t;
    }
    end = w->between ? l->node[1] : l->node[1 - from];
    if (w->between)
      push_seam_nodes(d, l);
    else
      d->of[l->elem] = piece;
    if (d->ends[end] || end == begin) break;
    uint32_t k = w->c->first[end];
    if (w->c->link.data[k / 2].piece != NONE) k = w->c->next[k];
    if (k == NONE || w->c->link.data[k / 2].piece != NONE) break;
    l = &w->c->link.data[k / 2];
    from = l->node[0] == end ? 0 : 1;
  }
  bool forwards = w->between || entered == 0;
  if (d->ends[begin])
    p.ends[forwards ? 0 : 1] = begin; // nodes for now: pieces of points are still to be made
  if (d->ends[end]) p.ends[forwards ? 1 : 0] = end;
  vec_push(&d->piece[1], p);
}

// Links first .. last-1: from ends, forwards if they begin there, and last those that are closed.
static void walk_all(Walk *w, size_t first, size_t last)
{
  for (int pass = 0; pass < 3; pass++)
    for (size_t i = first; i < last; i++) {
      const Link *l = &w->c->link.data[i];
      if (l->piece == NONE && (pass == 2 || w->d->ends[l->node[pass]])) walk(w, i, pass == 1);
    }
}

// Without topology: one piece for each curve and part, in the order of first lines.
static void pieces_by_part(Division *d)
{
  Map seen = {0};
  for (size_t i = 0; i < d->curves.link.len; i++) {
    Link *l = &d->curves.link.data[i];
    bool added;
    l->piece = *map_slot(&seen, (uint64_t)l->entity << 32 | l->set, (uint32_t)d->piece[1].len, &added);
    if (added) vec_push(&d->piece[1], ((Piece){.entity = l->entity, .set = l->set, .ends = {NONE, NONE}}));
    d->of[l->elem] = l->piece;
  }
  map_free(&seen);
}

void division__curves(Division *d)
{
  add_lines(d);
  if (d->topology) add_seams(d);
  index_links(&d->curves, d->m->nnode);
  index_links(&d->seams, d->m->nnode);
  if (!d->topology) {
    pieces_by_part(d);
    return;
  }
  mark_ends(d);
  for (size_t i = 0, j; i < d->curves.link.len; i = j) {
    for (j = i; j < d->curves.link.len && d->curves.link.data[j].entity == d->curves.link.data[i].entity;)
      j++;
    walk_all(&(Walk){d, &d->curves, false}, i, j);
  }
  walk_all(&(Walk){d, &d->seams, true}, 0, d->seams.link.len);
}
