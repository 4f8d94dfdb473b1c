// heal_faces.c - faces whose loops cross or that lie on each other: each gets the cells of the arrangement that are its own
// SPDX-License-Identifier: MIT
//
// A place is in a loop if the loop runs around it an odd number of times, and in a face if it is in an odd number of its parts. A
// part is a loop; loops that meet make one part: what is in one of them, and if the outer loop is among them what is in that and
// in none of the others. What is in a face of a higher
// tag in the same plane too belongs to that one alone: later faces lie on top.
#include "base/base.h"

#include "mesh/heal_faces.h"

#include "mesh/face_graph.h"
#include "model/model_edit.h"

// Loops of the face (set 0), and all those of each of the faces above it (set 1).
typedef struct {
  uint32_t part;   // set 0: index of the part; set 1: NONE
  bool outer;      // the first of set 0
  bool inside;     // state of the walk: the place is in it
} Ring;

typedef struct {
  bool outer_in;
  bool has_outer;
  uint32_t in;     // rings other than the outer one that the place is in
} Part;

typedef struct {
  Vec(Ring) ring;
  Vec(Part) part;
  U32Vec face_of;  // of rings of set 1: index in `above`
  U32Vec above;    // rings of each face above that the place is in
  U32Vec use_ring, use_next; // chains of rings by curve
  Map use;         // tag of a curve -> first of its chain
  uint32_t odd;    // parts the place is in
  uint32_t covered; // faces above the place is in
} Overlay;

static void overlay_free(Overlay *o)
{
  vec_free(&o->ring);
  vec_free(&o->part);
  vec_free(&o->face_of);
  vec_free(&o->above);
  vec_free(&o->use_ring);
  vec_free(&o->use_next);
  map_free(&o->use);
}

static void add_use(Overlay *o, int tag, uint32_t ring)
{
  bool fresh;
  uint32_t *slot = map_slot(&o->use, (uint64_t)abs(tag), NONE, &fresh);
  vec_push(&o->use_next, *slot);
  vec_push(&o->use_ring, ring);
  *slot = (uint32_t)o->use_ring.len - 1;
}

static uint32_t find(U32Vec *up, uint32_t i)
{
  while (up->data[i] != i) i = up->data[i] = up->data[up->data[i]];
  return i;
}

// Loops with a common point are in one part.
static void join_loops(const Model *m, const Face *f, U32Vec *up)
{
  Map at = {0};
  for (int k = 0; k < f->nloop; k++) vec_push(up, (uint32_t)k);
  for (int k = 0; k < f->nloop; k++) {
    const Loop *l = model_loop(m, f->loop[k]);
    for (int i = 0; l && i < 2 * l->ncurve; i++) {
      const Curve *c = model_curve(m, l->curve[i / 2]);
      bool fresh;
      uint32_t *first = map_slot(&at, (uint64_t)(i % 2 ? c->end : c->begin), (uint32_t)k, &fresh);
      uint32_t a = find(up, *first), b = find(up, (uint32_t)k);
      up->data[MAX(a, b)] = MIN(a, b);
    }
  }
  map_free(&at);
}

static void add_own_rings(Overlay *o, const Model *m, const Face *f)
{
  U32Vec up = {0};
  join_loops(m, f, &up);
  for (int k = 0; k < f->nloop; k++) vec_push(&o->part, ((Part){.has_outer = k == 0}));
  for (int k = 0; k < f->nloop; k++) {
    const Loop *l = model_loop(m, f->loop[k]);
    vec_push(&o->ring, ((Ring){find(&up, (uint32_t)k), k == 0, false}));
    vec_push(&o->face_of, NONE);
    for (int i = 0; l && i < l->ncurve; i++) add_use(o, l->curve[i], (uint32_t)o->ring.len - 1);
  }
  vec_free(&up);
}

// A face above is healed already: what an odd number of its curves surround.
static void add_face_above(Overlay *o, const Model *m, const Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  vec_push(&o->ring, ((Ring){NONE, false, false}));
  vec_push(&o->face_of, (uint32_t)o->above.len);
  vec_push(&o->above, 0);
  for (size_t i = 0; i < curve.len; i++) add_use(o, curve.data[i], (uint32_t)o->ring.len - 1);
  vec_free(&curve);
  vec_free(&start);
}

static bool in_part(const Part *p)
{
  return p->has_outer ? p->outer_in && !p->in : p->in > 0;
}

// The walk crosses a curve, one way or the other.
static void cross(Overlay *o, int tag)
{
  for (uint32_t i = map_get(&o->use, (uint64_t)tag); i != NONE; i = o->use_next.data[i]) {
    uint32_t k = o->use_ring.data[i];
    Ring *r = &o->ring.data[k];
    r->inside = !r->inside;
    if (r->part == NONE) {
      o->covered = r->inside ? o->covered + 1 : o->covered - 1;
      continue;
    }
    Part *p = &o->part.data[r->part];
    o->odd -= in_part(p);
    if (r->outer) p->outer_in = r->inside;
    else p->in = r->inside ? p->in + 1 : p->in - 1;
    o->odd += in_part(p);
  }
}

// Which triangles are the face's: a depth-first walk from infinity that keeps count of what it is in. O(triangles).
static uint8_t *walk(Overlay *o, const Tri *t, const FaceGraph *g)
{
  enum { SEEN = 1, INSIDE = 2 };
  uint8_t *state = mem_zalloc(t->nt);
  U32Vec path = {0}, next = {0}; // edges entered by (NONE first), and the next of three edges to try
  TriId at = 0;
  while (at < t->nt && (tri_is_free(t, at) || !tri_is_ghost(t, at))) at++;
  if (at == t->nt) return state;
  state[at] = SEEN;
  vec_push(&path, NONE);
  vec_push(&next, 0);
  while (path.len) {
    uint32_t *k = &vec_last(&next);
    if (*k == 3) {
      EdgeId e = vec_pop(&path);
      next.len--;
      if (e == NONE) break;
      if (tri_is_segment(t, e)) cross(o, g->curve.data[t->seg[e]]);
      at = tri_of(t->twin[e]);
      continue;
    }
    EdgeId e = t->twin[3 * at + (*k)++];
    if (state[tri_of(e)] & SEEN) continue;
    if (tri_is_segment(t, e)) cross(o, g->curve.data[t->seg[e]]);
    at = tri_of(e);
    state[at] = (uint8_t)(SEEN | (o->odd % 2 && !o->covered && !tri_is_ghost(t, at) ? INSIDE : 0));
    vec_push(&path, e);
    vec_push(&next, 0);
  }
  vec_free(&path);
  vec_free(&next);
  for (TriId k = 0; k < t->nt; k++) state[k] = (state[k] & INSIDE) != 0;
  return state;
}

// Number the pieces of the face, that hang together through edges that do not bound it: triangles with inside[] != 0 get 1, 2, ...
// Returns their number.
static uint32_t *number_pieces(const Tri *t, const uint8_t *inside, uint32_t *npiece)
{
  uint32_t *piece = mem_zalloc(((size_t)t->nt + 1) * sizeof *piece);
  U32Vec stack = {0};
  *npiece = 0;
  for (TriId k = 0; k < t->nt; k++) {
    if (!inside[k] || piece[k]) continue;
    piece[k] = ++*npiece;
    vec_push(&stack, k);
    while (stack.len) {
      TriId at = vec_pop(&stack);
      for (EdgeId e = 3 * at; e < 3 * at + 3; e++) {
        TriId next = tri_of(t->twin[e]);
        if (!inside[next] || piece[next]) continue;
        piece[next] = *npiece;
        vec_push(&stack, next);
      }
    }
  }
  vec_free(&stack);
  return piece;
}

// The pieces on both sides of each curve, 0 where there is none, at side[2 * slot] (left) and [2 * slot + 1].
typedef struct {
  Map slot;        // tag of a curve -> index
  U32Vec side;
} Sides;

static void find_sides(const Tri *t, const FaceGraph *g, const uint32_t *piece, Sides *s)
{
  for (EdgeId e = 0; e < 3 * t->nt; e++) {
    if (tri_is_free(t, tri_of(e)) || !tri_is_segment(t, e)) continue;
    uint32_t k = t->seg[e];
    bool fresh;
    uint32_t at = *map_slot(&s->slot, (uint64_t)g->curve.data[k], (uint32_t)s->side.len / 2, &fresh);
    if (fresh) vec_resize(&s->side, s->side.len + 2);
    s->side.data[2 * at + (tri_org(t, e) != g->ends.data[2 * k])] = piece[tri_of(e)];
  }
}

// Signed tags in closed chains, each from the first curve left over on.
static void chain_up(const Model *m, const IntVec *curve, IntVec *out)
{
  Map at = {0};
  U32Vec next = {0};
  bool *used = mem_zalloc(curve->len + 1);
  vec_resize(&next, curve->len);
  for (size_t i = curve->len; i-- > 0;) {
    const Curve *c = model_curve(m, curve->data[i]);
    bool fresh;
    uint32_t *slot = map_slot(&at, (uint64_t)(curve->data[i] < 0 ? c->end : c->begin), NONE, &fresh);
    next.data[i] = *slot;
    *slot = (uint32_t)i;
  }
  for (size_t first = 0; first < curve->len; first++) {
    for (uint32_t i = (uint32_t)first; i != NONE && !used[i];) {
      used[i] = true;
      vec_push(out, curve->data[i]);
      const Curve *c = model_curve(m, curve->data[i]);
      i = map_get(&at, (uint64_t)(curve->data[i] < 0 ? c->begin : c->end));
      while (i != NONE && used[i]) i = next.data[i];
    }
  }
  free(used);
  vec_free(&next);
  map_free(&at);
}

static int by_tag(const void *a, const void *b)
{
  int x = abs(*(const int *)a), y = abs(*(const int *)b);
  return (x > y) - (x < y);
}

// Whether the boundary as it is listed is the one found.
static bool same_boundary(const Model *m, const Face *f, const IntVec *found, const FaceBoundary *b)
{
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  bool same = curve.len == found->len && b->curves.len == f->embedded_curves.len && b->points.len == f->embedded_points.len;
  if (same && curve.len) qsort(curve.data, curve.len, sizeof *curve.data, by_tag);
  for (size_t i = 0; same && i < curve.len; i++) same = curve.data[i] == found->data[i];
  vec_free(&curve);
  vec_free(&start);
  return same;
}

typedef struct {
  Model *m;
  const Mesh1d *curves;
  const EdgeNodes *nodes;
  FieldSet *fields;
  Diag *diag;
  IntVec tag;       // of the plane faces, ascending; new ones behind
  Vec(Box3) box;    // their boxes
  size_t changed;
  Map was;          // tags of curves of faces that got others
} Healer;

static bool same_place(const Face *a, const Face *b)
{
  Vec2 o = face_to_plane(a, b->origin);
  double off = vec3_distance(face_from_plane(a, o), b->origin), across = fabs(vec3_dot(a->normal, b->normal));
  double size = 1 + vec3_length(a->origin) + vec3_length(b->origin);
  return b->type == FACE_PLANE && b->planar && across > 1 - 1e-9 && off <= 1e-9 * size;
}

static Box3 face_box(const Model *m, const Face *f)
{
  Box3 box = box3_empty();
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  for (size_t i = 0; i < curve.len; i++) {
    Box3 b = curve_bounds(m, model_curve(m, curve.data[i]));
    box = box3_with(box3_with(box, b.lo), b.hi);
  }
  vec_free(&curve);
  vec_free(&start);
  return box;
}

static bool boxes_meet(Box3 a, Box3 b)
{
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

// Tags of the curves of the graph, ascending.
static void graph_curves(const FaceGraph *g, IntVec *all)
{
  for (size_t i = 0; i < g->curve.len; i++)
    if (!i || g->curve.data[i] != g->curve.data[i - 1]) vec_push(all, g->curve.data[i]);
  if (all->len) qsort(all->data, all->len, sizeof *all->data, by_tag);
}

// What bounds piece p and what is embedded in it; `bounds` gets the signed tags ascending, b->bounds the same in chains.
static void boundary_of_piece(const Healer *h, const FaceGraph *g, const Sides *s, uint32_t p, IntVec *bounds, FaceBoundary *b)
{
  IntVec all = {0};
  graph_curves(g, &all);
  for (size_t i = 0; i < all.len; i++) {
    uint32_t at = map_get(&s->slot, (uint64_t)all.data[i]);
    if (at == NONE) continue;
    bool left = s->side.data[2 * at] == p, right = s->side.data[2 * at + 1] == p;
    if (left && right) vec_push(&b->curves, all.data[i]);
    else if (left || right) vec_push(bounds, left ? all.data[i] : -all.data[i]);
  }
  vec_free(&all);
  chain_up(h->m, bounds, &b->bounds);
}

// The piece that an embedded point lies in, or 0.
static uint32_t piece_at(const Healer *h, const FaceGraph *g, const Tri *t, const uint32_t *piece, int point)
{
  uint32_t v = map_get(&g->local, edge_nodes_point(h->m, point));
  for (EdgeId e = 0; e < 3 * t->nt; e++)
    if (!tri_is_free(t, tri_of(e)) && t->vert[e] == v && piece[tri_of(e)]) return piece[tri_of(e)];
  return 0;
}

// Embedded curves and points that are in no piece are left out.
static void warn_of_lost(const Healer *h, const Face *f, const FaceGraph *g, const Tri *t, const Sides *s, const uint32_t *piece)
{
  for (size_t k = 0; k < f->embedded_curves.len; k++) {
    int tag = f->embedded_curves.data[k];
    uint32_t at = map_get(&s->slot, (uint64_t)tag);
    if (at != NONE && (s->side.data[2 * at] || s->side.data[2 * at + 1])) continue;
    diag_warning(h->diag, model_curve(h->m, tag)->loc, "curve %d, embedded in surface %d, lies outside it and is left out of it", tag,
                 f->tag);
  }
  for (size_t k = 0; k < f->embedded_points.len; k++)
    if (!piece_at(h, g, t, piece, f->embedded_points.data[k]))
      diag_warning(h->diag, f->loc, "point %d, embedded in surface %d, lies outside it and is left out", f->embedded_points.data[k],
                   f->tag);
}

static void drop_face(Healer *h, const Face *f, const FaceGraph *g)
{
  diag_warning(h->diag, f->loc, "nothing is left of surface %d, others lie on all of it: it goes", f->tag);
  for (size_t i = 0; i < g->curve.len; i++) map_set(&h->was, (uint64_t)g->curve.data[i], 1);
  model_forget_face(h->m, f->tag);
  h->changed++;
}

// Give the face its pieces. What was embedded is shared out among them.
static void set_pieces(Healer *h, Face *f, const FaceGraph *g, const Tri *t, const Sides *s, const uint32_t *piece, uint32_t npiece)
{
  IntVec part = {0}, points = {0};
  bool changed = npiece > 1;
  Box3 box = face_box(h->m, f);
  warn_of_lost(h, f, g, t, s, piece);
  for (size_t k = 0; k < f->embedded_points.len; k++) vec_push(&points, f->embedded_points.data[k]);
  for (uint32_t p = 1; p <= npiece; p++) {
    FaceBoundary b = {0};
    IntVec bounds = {0};
    boundary_of_piece(h, g, s, p, &bounds, &b);
    for (size_t k = 0; k < points.len; k++)
      if (piece_at(h, g, t, piece, points.data[k]) == p) vec_push(&b.points, points.data[k]);
    changed = changed || !same_boundary(h->m, f, &bounds, &b);
    if (p == 1 && changed) model_set_face_boundary(h->m, f->tag, &b);
    vec_push(&part, p == 1 ? f->tag : model_add_face_part(h->m, f->tag, &b));
    if (p > 1) {
      vec_push(&h->tag, vec_last(&part));
      vec_push(&h->box, box);
    }
    vec_free(&bounds);
    vec_free(&b.bounds);
    vec_free(&b.curves);
    vec_free(&b.points);
  }
  for (size_t i = 0; changed && i < g->curve.len; i++) map_set(&h->was, (uint64_t)g->curve.data[i], 1);
  if (h->fields && part.len > 1) fields_add_parts(h->fields, 2, f->tag, part.data, part.len);
  h->changed += changed;
  vec_free(&part);
  vec_free(&points);
}

// The curves of the face and of those above it, and what is in which.
static void gather(const Healer *h, size_t k, FaceGraph *g, Overlay *o)
{
  const Face *f = model_face(h->m, h->tag.data[k]);
  g->frame = f;
  face_graph_add(g, h->m, f, h->curves, h->nodes);
  add_own_rings(o, h->m, f);
  for (size_t i = k + 1; i < h->tag.len; i++) {
    const Face *b = model_face(h->m, h->tag.data[i]);
    if (!b || !same_place(f, b) || !boxes_meet(h->box.data[i], h->box.data[k])) continue;
    face_graph_add(g, h->m, b, h->curves, h->nodes);
    add_face_above(o, h->m, b);
  }
}

// False after an error.
static bool heal_face(Healer *h, size_t k)
{
  Face *f = model_face(h->m, h->tag.data[k]);
  FaceGraph g = {0};
  Overlay o = {0};
  gather(h, k, &g, &o);
  Tri t;
  tri_init(&t);
  bool good = face_graph_recover(&g, h->m, f, &t, h->diag);
  if (good) {
    Sides s = {0};
    uint32_t npiece;
    uint8_t *inside = walk(&o, &t, &g);
    uint32_t *piece = number_pieces(&t, inside, &npiece);
    find_sides(&t, &g, piece, &s);
    if (!npiece) drop_face(h, f, &g);
    else set_pieces(h, f, &g, &t, &s, piece, npiece);
    map_free(&s.slot);
    vec_free(&s.side);
    free(piece);
    free(inside);
  }
  tri_free(&t);
  overlay_free(&o);
  face_graph_free(&g);
  return good;
}

// Parts of curves that bounded faces, or were embedded in them, and are in none any more, go.
static void drop_unused(Healer *h)
{
  Map used = {0};
  IntVec curve = {0}, start = {0}, gone = {0};
  for (size_t k = 0; k < model_faces(h->m); k++) {
    const Face *f = model_face_at(h->m, k);
    face_boundary(h->m, f, &curve, &start);
    for (size_t i = 0; i < curve.len; i++) map_set(&used, (uint64_t)abs(curve.data[i]), 1);
    for (size_t i = 0; i < f->embedded_curves.len; i++) map_set(&used, (uint64_t)abs(f->embedded_curves.data[i]), 1);
  }
  for (size_t k = 0; k < model_curves(h->m); k++) {
    uint64_t tag = (uint64_t)model_curve_at(h->m, k)->tag;
    if (map_get(&h->was, tag) != NONE && map_get(&used, tag) == NONE) vec_push(&gone, (int)tag);
  }
  for (size_t i = 0; i < gone.len; i++) model_forget_curve(h->m, gone.data[i]);
  if (gone.len) log_info(h->diag, "%zu parts of curves bound no surface and are left out", gone.len);
  map_free(&used);
  vec_free(&curve);
  vec_free(&start);
  vec_free(&gone);
}

bool heal_faces(Model *m, FieldSet *fields, const Mesh1d *curves, Diag *diag, size_t *changed)
{
  EdgeNodes nodes;
  edge_nodes_init(&nodes, m, curves);
  Healer h = {.m = m, .curves = curves, .nodes = &nodes, .fields = fields, .diag = diag};
  for (size_t k = 0; k < model_faces(m); k++) {
    const Face *f = model_face_at(m, k);
    if (f->type != FACE_PLANE || !f->planar) continue;
    vec_push(&h.tag, f->tag);
    vec_push(&h.box, face_box(m, f));
  }
  bool good = true;
  for (size_t k = h.tag.len; k-- > 0 && good;) good = heal_face(&h, k); // faces on top first
  *changed = h.changed;
  if (good) drop_unused(&h);
  map_free(&h.was);
  vec_free(&h.tag);
  vec_free(&h.box);
  edge_nodes_free(&nodes);
  return good;
}
