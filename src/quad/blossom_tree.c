// blossom_tree.c - alternating trees: growing, shrinking and expanding blossoms, augmenting
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/blossom_int.h"

// Put a label into a tree with a sign, or out of all trees (tree 0, IDLE); its potential stays what it is.
static void set_sign(const Blossom *b, BlossomVertex *l, uint32_t tree, BlossomSign sign)
{
  l->off = blossom__level(b, l) - (int)sign * blossom__clock(b, tree);
  l->tree = tree;
  l->sign = sign;
}

// ---- events
//
// What is always true: for each arc from an outer node of a growing tree to another node, except an inner one of the same
// tree, there is an entry in the queue no later than the moment when something can happen there, or, if it leads to an inner
// node of another growing tree (nothing can happen while both grow), an entry in the contact list of that tree.

static void add_contact(Blossom *b, uint32_t tree, uint32_t a)
{
  uint32_t c = b->free_contact;
  if (c != NONE) b->free_contact = b->contact.data[c].next;
  else {
    c = (uint32_t)b->contact.len;
    vec_push(&b->contact, ((BlossomContact){0, 0}));
  }
  b->contact.data[c] = (BlossomContact){a, b->tree[tree].contact};
  b->tree[tree].contact = c;
}

// Note when the outer node at the tail of a, whose tree grows, can do something with what is at its head; pv is the
// potential of the tail.
static inline void watch_arc(Blossom *b, uint32_t a, uint32_t own_label, int64_t pv)
{
  const BlossomArc *arc = &b->arc[a];
  const BlossomVertex *w = &b->v[arc->head];
  if (w->label == own_label) return;
  const BlossomVertex *l = &b->v[w->label];
  const BlossomTree *t = &b->tree[l->tree];
  int sign = t->life == DEAD ? IDLE : l->sign;
  if (sign == INNER) {
    if (l->tree == b->v[own_label].tree) return;
    if (t->life == GROWING) {
      add_contact(b, l->tree, a);
      return;
    }
  }
  int64_t slack = b->scale * (int64_t)arc->cost - pv - (w->pot + blossom__level(b, l));
  DCHECK(slack >= 0);
  if (sign == OUTER && t->life == GROWING) slack = slack / 2 & -b->unit;
  blossom__push(&b->queue, b->now + slack, a);
}

// The vertices first .. last of one outer node of a growing tree: watch their edges.
static void scan_outer(Blossom *b, uint32_t first, uint32_t last)
{
  uint32_t label = b->v[first].label;
  for (uint32_t v = first;; v = b->v[v].next) {
    int64_t pv = blossom__pot(b, v);
    for (uint32_t a = b->v[v].start; a < b->v[v + 1].start; a++) watch_arc(b, a, label, pv);
    b->stats.swept++;
    if (v == last) break;
  }
}

// The vertices first .. last have become idle while their tree lives: outer nodes around may reach them.
static void scan_idle(Blossom *b, uint32_t first, uint32_t last)
{
  for (uint32_t v = first;; v = b->v[v].next) {
    for (uint32_t a = b->v[v].start; a < b->v[v + 1].start; a++) {
      const BlossomVertex *l = &b->v[b->v[b->arc[a].head].label];
      if (l->sign == OUTER && b->tree[l->tree].life == GROWING)
        blossom__push(&b->queue, b->now + blossom__slack(b, &b->arc[a]), b->arc[a].rev);
    }
    if (v == last) break;
  }
}

static void watch_inner(Blossom *b, uint32_t x, uint32_t label)
{
  if (x < b->n) return;
  int64_t z = blossom__level(b, &b->v[label]) - b->node[x].z;
  DCHECK(z >= 0);
  blossom__push(&b->queue, b->now + z, b->narc + x);
}

// The tree stops growing for good (DEAD) or for this round (ASLEEP).
static void stop_tree(Blossom *b, uint32_t tree, BlossomLife life)
{
  BlossomTree *t = &b->tree[tree];
  if (t->life == GROWING) {
    t->clock += b->now;
    b->nawake--;
  }
  t->life = life;
  b->ntree -= life == DEAD;
  uint32_t c = t->contact;
  t->contact = NONE;
  while (c != NONE) {
    BlossomContact *k = &b->contact.data[c];
    uint32_t a = k->arc, next = k->next;
    const BlossomVertex *l = &b->v[b->v[b->arc[a].tail].label];
    k->next = b->free_contact;
    b->free_contact = c;
    c = next;
    if (l->sign == OUTER && b->tree[l->tree].life == GROWING)
      watch_arc(b, a, b->v[b->arc[a].tail].label, blossom__pot(b, b->arc[a].tail));
  }
}

// ---- growing

void blossom__plant(Blossom *b, uint32_t v)
{
  if (b->ntrees == b->tree_cap) mem_grow(&b->tree, &b->tree_cap, b->ntrees + 1, sizeof *b->tree);
  b->ntree++;
  b->tree[b->ntrees] = (BlossomTree){.life = ASLEEP, .contact = NONE, .root = v};
  set_sign(b, &b->v[b->v[v].label], b->ntrees++, OUTER);
}

static void grow(Blossom *b, uint32_t a)
{
  uint32_t tree = b->v[b->v[b->arc[a].tail].label].tree;
  uint32_t li = b->v[b->arc[a].head].label;
  BlossomVertex *inner = &b->v[li];
  uint32_t lo = b->v[b->arc[inner->match].head].label;
  BlossomVertex *outer = &b->v[lo];
  b->stats.grow++;
  inner->pred = b->arc[a].rev;
  set_sign(b, inner, tree, INNER);
  watch_inner(b, inner->node, li);
  set_sign(b, outer, tree, OUTER);
  const BlossomNode *no = &b->node[outer->node];
  if (outer->node < b->n) scan_outer(b, lo, lo);
  else scan_outer(b, no->first, no->last);
  b->tree[tree].volume += outer->node < b->n ? 1 : no->size;
  if (b->tree[tree].volume > b->cap) stop_tree(b, tree, ASLEEP);
}

// All sleeping trees give back their ground, and grow anew from their free nodes.
void blossom__wake(Blossom *b)
{
  size_t n = b->ntrees;
  for (uint32_t t = 1; t < n; t++) {
    if (b->tree[t].life != ASLEEP) continue;
    stop_tree(b, t, DEAD);
    blossom__plant(b, b->tree[t].root);
  }
  for (uint32_t t = (uint32_t)n; t < b->ntrees; t++) {
    b->tree[t].clock = -b->now;
    b->tree[t].life = GROWING;
  }
  b->nawake = b->ntree;
  vec_clear(&b->contact);
  b->free_contact = NONE;
  for (uint32_t t = (uint32_t)n; t < b->ntrees; t++) {
    const BlossomNode *x = &b->node[blossom__top(b, b->tree[t].root)];
    scan_outer(b, x->first, x->last);
  }
}

// ---- augmenting

// Match the outer node that holds the tail of a along a, and repair the path to its root.
static void flip_path(Blossom *b, uint32_t a)
{
  for (;;) {
    BlossomVertex *outer = &b->v[b->v[b->arc[a].tail].label];
    uint32_t old = outer->match;
    outer->match = a;
    if (old == NONE) return;
    BlossomVertex *inner = &b->v[b->v[b->arc[old].head].label];
    inner->match = inner->pred;
    a = b->arc[inner->pred].rev;
  }
}

static void augment(Blossom *b, uint32_t a)
{
  uint32_t tu = b->v[b->v[b->arc[a].tail].label].tree, tv = b->v[b->v[b->arc[a].head].label].tree;
  b->stats.augment++;
  flip_path(b, a);
  flip_path(b, b->arc[a].rev);
  stop_tree(b, tu, DEAD);
  stop_tree(b, tv, DEAD);
}

// ---- shrinking

// The arc from a node towards its root: the match of an outer one, `pred` of an inner one.
static uint32_t up_arc(const Blossom *b, uint32_t label)
{
  return b->v[label].sign == OUTER ? b->v[label].match : b->v[label].pred;
}

// Nearest common ancestor of two outer nodes of one tree (all by labels), climbing from both in turn: O(length of the cycle).
static uint32_t common_ancestor(Blossom *b, uint32_t x, uint32_t y)
{
  b->stamp++;
  for (;;) {
    if (x != NONE) {
      if (b->v[x].mark == b->stamp) return x;
      b->v[x].mark = b->stamp;
      uint32_t a = up_arc(b, x);
      x = a == NONE ? NONE : b->v[b->arc[a].head].label;
    }
    uint32_t t = x;
    x = y;
    y = t;
    DCHECK(x != NONE || y != NONE);
  }
}

static uint32_t new_blossom(Blossom *b)
{
  if (b->free_node != NONE) {
    uint32_t x = b->free_node;
    b->free_node = b->node[x].child;
    return x;
  }
  if (b->nnode == b->node_cap) mem_grow(&b->node, &b->node_cap, b->nnode + 1, sizeof *b->node);
  return (uint32_t)b->nnode++;
}

static void climb(const Blossom *b, uint32_t x, uint32_t top, U32Vec *path)
{
  vec_clear(path);
  for (; x != top; x = b->v[b->arc[up_arc(b, x)].head].label) vec_push(path, x);
}

// Join the parts with labels x and y by the arc from x to y.
static void link_sib(Blossom *b, uint32_t x, uint32_t arc, uint32_t y)
{
  uint32_t nx = b->v[x].node, ny = b->v[y].node;
  b->node[nx].sib = ny;
  b->node[nx].sib_arc = arc;
  b->node[ny].sib_prev = nx;
}

// Link the odd cycle closed by a: down from the ancestor to the tail of a, over a, and up again.
static void link_cycle(Blossom *b, uint32_t anc, uint32_t a)
{
  uint32_t x = anc;
  for (size_t i = b->up_u.len; i-- > 0;) {
    link_sib(b, x, b->arc[up_arc(b, b->up_u.data[i])].rev, b->up_u.data[i]);
    x = b->up_u.data[i];
  }
  for (size_t i = 0; i < b->up_v.len; i++) {
    link_sib(b, x, a, b->up_v.data[i]);
    x = b->up_v.data[i];
    a = up_arc(b, x);
  }
  link_sib(b, x, a, anc);
}

// Take the part x into the blossom s whose label is `label`; its vertices are appended to those of s.
static void absorb(Blossom *b, uint32_t s, uint32_t x, uint32_t label)
{
  BlossomNode *nx = &b->node[x], *ns = &b->node[s];
  BlossomVertex *l = &b->v[nx->label];
  if (x >= b->n) nx->z = blossom__level(b, l) - nx->z;
  if (l->sign == INNER) {
    set_sign(b, l, l->tree, OUTER);
    vec_push(&b->fresh, x);
  }
  if (nx->label != label) {
    int64_t shift = l->off - b->v[label].off;
    b->stats.relabel += nx->size;
    for (uint32_t v = nx->first;; v = b->v[v].next) {
      b->v[v].pot += shift;
      b->v[v].label = label;
      if (v == nx->last) break;
    }
  }
  if (ns->size) b->v[ns->last].next = nx->first;
  else ns->first = nx->first;
  ns->last = nx->last;
  ns->size += nx->size;
}

// The odd cycle that the arc a closes in a tree becomes a blossom; its inner parts turn outer.
static void shrink(Blossom *b, uint32_t a)
{
  uint32_t u = b->v[b->arc[a].tail].label, v = b->v[b->arc[a].head].label, anc = common_ancestor(b, u, v);
  b->stats.shrink++;
  climb(b, u, anc, &b->up_u);
  climb(b, v, anc, &b->up_v);
  link_cycle(b, anc, a);
  uint32_t s = new_blossom(b), base = b->v[anc].node, big = base, tree = b->v[anc].tree;
  for (uint32_t x = b->node[base].sib; x != base; x = b->node[x].sib)
    if (b->node[x].size > b->node[big].size) big = x;
  uint32_t label = b->node[big].label, match = b->v[anc].match;
  b->node[s] = (BlossomNode){.sib = NONE, .sib_prev = NONE, .sib_arc = NONE, .label = label, .child = base};
  vec_clear(&b->fresh);
  // The part whose label stays turns first, so that the others are shifted against its final offset.
  if (b->v[label].sign == INNER) {
    set_sign(b, &b->v[label], tree, OUTER);
    vec_push(&b->fresh, big);
  }
  uint32_t x = base;
  do {
    absorb(b, s, x, label);
    x = b->node[x].sib;
  } while (x != base);
  b->v[label].node = s;
  b->v[label].match = match;
  b->node[s].z = blossom__level(b, &b->v[label]);
  for (size_t i = 0; i < b->fresh.len; i++) {
    const BlossomNode *part = &b->node[b->fresh.data[i]];
    b->tree[tree].volume += part->size;
    scan_outer(b, part->first, part->last);
  }
}

// ---- expanding

// Give the parts of blossom s back their labels; they keep its sign and potential.
static void split_labels(Blossom *b, uint32_t s)
{
  uint32_t label = b->node[s].label, x = b->node[s].child;
  const BlossomVertex *own = &b->v[label];
  int64_t level = blossom__level(b, own);
  do {
    BlossomNode *nx = &b->node[x];
    BlossomVertex *l = &b->v[nx->label];
    l->node = x;
    if (x >= b->n) nx->z = level - nx->z;
    if (nx->label != label) {
      l->off = own->off;
      l->sign = own->sign;
      l->tree = own->tree;
      b->stats.relabel += nx->size;
      for (uint32_t v = nx->first;; v = b->v[v].next) {
        b->v[v].label = nx->label;
        if (v == nx->last) break;
      }
    }
    x = nx->sib;
  } while (x != b->node[s].child);
}

void blossom__open(Blossom *b, uint32_t s)
{
  uint32_t match = b->v[b->node[s].label].match;
  split_labels(b, s);
  uint32_t base = match == NONE ? b->node[s].child : blossom__top(b, b->arc[match].tail);
  b->v[b->node[base].label].match = match;
  for (uint32_t x = b->node[base].sib; x != base;) {
    uint32_t y = b->node[x].sib;
    b->v[b->node[x].label].match = b->node[x].sib_arc;
    b->v[b->node[y].label].match = b->arc[b->node[x].sib_arc].rev;
    x = b->node[y].sib;
  }
  b->node[s].child = b->free_node;
  b->free_node = s;
}

// The parts from the one where the tree comes in to the base, which is matched outside, stay in the tree, inner and outer in
// turn along the matched way round.
static void keep_path(Blossom *b, uint32_t tree, uint32_t pred, uint32_t base)
{
  uint32_t x = blossom__top(b, b->arc[pred].tail);
  bool forward = x != base && b->v[b->node[x].label].match == b->node[x].sib_arc;
  for (bool inner = true;; inner = !inner) {
    BlossomNode *nx = &b->node[x];
    set_sign(b, &b->v[nx->label], tree, inner ? INNER : OUTER);
    if (inner) {
      b->v[nx->label].pred = pred;
      watch_inner(b, x, nx->label);
    }
    if (x == base) break;
    // The arc by which the next part looks back at this one.
    pred = forward ? b->arc[nx->sib_arc].rev : b->node[nx->sib_prev].sib_arc;
    x = forward ? nx->sib : nx->sib_prev;
  }
}

// An inner blossom whose dual is 0. Parts off the path become idle.
static void expand(Blossom *b, uint32_t s)
{
  const BlossomVertex *l = &b->v[b->node[s].label];
  uint32_t pred = l->pred, match = l->match, tree = l->tree, some = b->node[s].child, x = some;
  b->stats.expand++;
  blossom__open(b, s);
  do {
    set_sign(b, &b->v[b->node[x].label], 0, IDLE);
    x = b->node[x].sib;
  } while (x != some);
  keep_path(b, tree, pred, blossom__top(b, b->arc[match].tail));
  do {
    const BlossomNode *nx = &b->node[x];
    BlossomSign sign = blossom__sign(b, &b->v[nx->label]);
    if (sign == OUTER) {
      b->tree[tree].volume += nx->size;
      scan_outer(b, nx->first, nx->last);
    } else if (sign == IDLE) scan_idle(b, nx->first, nx->last);
    x = nx->sib;
  } while (x != some);
}

// ---- what the queue brings

void blossom__inner_event(Blossom *b, uint32_t x)
{
  const BlossomVertex *l = &b->v[b->node[x].label];
  if (l->node == x && l->sign == INNER && b->tree[l->tree].life == GROWING && blossom__level(b, l) == b->node[x].z)
    expand(b, x);
  else b->stats.stale++;
}

// Something may have happened to the ends of a since it was noted. If its tail grows no more, its head may be an outer node
// that had relied on this entry.
void blossom__arc_event(Blossom *b, uint32_t a)
{
  const BlossomVertex *lu = &b->v[b->v[b->arc[a].tail].label], *lv = &b->v[b->v[b->arc[a].head].label];
  if (lu->sign != OUTER || b->tree[lu->tree].life != GROWING) {
    const BlossomVertex *t = lu;
    lu = lv;
    lv = t;
    a = b->arc[a].rev;
  }
  BlossomSign sv = blossom__sign(b, lv);
  bool own = lu->tree == lv->tree;
  b->stats.stale++;
  if (lu == lv || lu->sign != OUTER || b->tree[lu->tree].life != GROWING || (own && sv == INNER)) return;
  int64_t slack = blossom__slack(b, &b->arc[a]);
  if (slack > 0) {
    // Two growing trees with one unit between them: let one wait for the other.
    if (slack == b->unit && sv == OUTER && b->tree[lv->tree].life == GROWING) stop_tree(b, lv->tree, ASLEEP);
    watch_arc(b, a, b->v[b->arc[a].tail].label, blossom__pot(b, b->arc[a].tail));
    return;
  }
  b->stats.stale--;
  if (sv == IDLE) grow(b, a);
  else if (sv == OUTER && own) shrink(b, a);
  else if (sv == OUTER) augment(b, a);
  else if (b->tree[lv->tree].life == ASLEEP) stop_tree(b, lu->tree, ASLEEP);
  else add_contact(b, lv->tree, a);
}
