// boolean_order.c - the order in which OpenCASCADE lists the faces that a Boolean operation makes, and the
// edges of each SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/boolean_int.h"

// Numbers are given in the order of these lists, so scripts depend on them. Measured: every input face is
// split by itself. Its entries are the pieces of its boundary in the order of its wires, then both directions
// of every edge inside it. Entries that hang together by their nodes are found breadth first. Where no node
// has more than two, that order is the wire; else the half-edges that leave each node in turn are followed
// round their face, and the wire lists that walk backwards. A face is the outer wire and the holes among the
// wires with the same face on their side. Dangling edges are left out.

typedef struct {
  Boolean *b;
  size_t input;
  bool flip;          // the interior is on the right of its boundary
  U32Vec entry;       // half-edges
  U32Vec loop;        // where each of its own wires begins among them, and where they end
  bool *avoid;        // per edge: dangling
  U32Vec *at;         // per node: ranks of the entries there
  bool *passed;       // per half-edge
  uint32_t *previous; // per half-edge, in its cycle
} Splitter;

typedef struct {
  uint32_t face;
  bool outer;
  U32Vec half;
} Wire;

typedef Vec(Wire) WireVec;

static uint32_t side_face(const Splitter *s, uint32_t half)
{
  const Arrangement *a = &s->b->a;
  return a->face.data[a->cycle.data[s->flip ? half ^ 1 : half]];
}

static uint32_t start_of(const Arrangement *a, uint32_t half)
{
  return half & 1 ? a->edge.data[half / 2].to : a->edge.data[half / 2].from;
}

// ---- entries
// ---------------------------------------------------------------------------------------------------------------

static void find_merged(Boolean *b)
{
  b->merged = mem_zalloc((b->a.node.len + 1) * sizeof *b->merged);
  int *tag = mem_zalloc((b->a.node.len + 1) * sizeof *tag);
  for (size_t k = 0; k < b->source.len; k++) {
    const Curve *c = model_curve(b->m, b->source.data[k]);
    const int end[2] = {c->begin, c->end};
    for (int i = 0; i < 2; i++) {
      uint32_t v = boolean__node_near(b, i ? b->curve[k].q : b->curve[k].p);
      if (v == NONE) continue;
      if (tag[v] && tag[v] != end[i]) b->merged[v] = true;
      tag[v] = end[i];
    }
  }
  free(tag);
}

// The edges of each source as half-edges that run along it, from its begin to its end.
void boolean__list_pieces(Boolean *b)
{
  find_merged(b);
  const Arrangement *a = &b->a;
  U32Vec *by_source = mem_zalloc((b->source.len + 1) * sizeof *by_source);
  b->pieces = mem_zalloc((b->source.len + 1) * sizeof *b->pieces);
  for (uint32_t e = 0; e < a->edge.len; e++) {
    vec_push(&by_source[a->edge.data[e].curve], e);
    for (size_t i = 0; i < a->edge.data[e].also.len; i++)
      vec_push(&by_source[a->edge.data[e].also.data[i]], e);
  }
  for (size_t k = 0; k < b->source.len; k++) {
    U32Vec *left = &by_source[k];
    uint32_t node = boolean__node_near(b, b->curve[k].p);
    while (left->len) {
      size_t best = left->len;
      for (size_t i = 0; i < left->len; i++) {
        const ArrEdge *e = &a->edge.data[left->data[i]];
        bool first = e->curve == k && e->u0 == 0;
        if (e->from != node && e->to != node) continue;
        if (best == left->len || (first && b->pieces[k].len == 0)) best = i;
      }
      if (best == left->len) best = 0; // not connected: merged by tolerance
      uint32_t e = left->data[best];
      bool back = a->edge.data[e].from != node;
      vec_push(&b->pieces[k], 2 * e + back);
      node = back ? a->edge.data[e].from : a->edge.data[e].to;
      memmove(left->data + best, left->data + best + 1, (left->len - best - 1) * sizeof *left->data);
      left->len--;
    }
    vec_free(left);
  }
  free(by_source);
}

// The curves of one loop in the order of its wire, signed as in the loop.
static void wire_order(const int *curve, size_t n, const Loop *l, IntVec *out)
{
  vec_clear(out);
  for (int i = 0; l && l->wire && i < l->nwire; i++)
    for (size_t k = 0; k < n; k++)
      if (tag__abs(curve[k]) == l->wire[i]) {
        vec_push(out, curve[k]);
        break;
      }
  if (out->len == n) return;
  vec_clear(out);
  for (size_t k = 0; k < n; k++) vec_push(out, curve[k]);
}

static void boundary_entries(Splitter *s)
{
  Boolean *b = s->b;
  const Face *f = b->input.data[s->input].face;
  IntVec curve = {0}, start = {0}, order = {0};
  face_boundary(b->m, f, &curve, &start);
  double area = 0;
  for (size_t k = 0; k + 1 < start.len; k++) {
    vec_push(&s->loop, (uint32_t)s->entry.len);
    const Loop *l = start.len - 1 == (size_t)f->nloop ? model_loop(b->m, f->loop[k]) : NULL;
    wire_order(curve.data + start.data[k], (size_t)(start.data[k + 1] - start.data[k]), l, &order);
    for (size_t i = 0; i < order.len; i++) {
      const U32Vec *p = &b->pieces[map_get(&b->index, (uint64_t)tag__abs(order.data[i]))];
      for (size_t j = 0; j < p->len; j++) vec_push(&s->entry, p->data[j] ^ (order.data[i] < 0));
    }
    for (size_t i = s->loop.data[k]; k == 0 && i < s->entry.len; i++)
      area += boolean__run_area(b, s->entry.data[i]);
  }
  vec_push(&s->loop, (uint32_t)s->entry.len);
  s->flip = area < 0;
  vec_free(&curve);
  vec_free(&start);
  vec_free(&order);
}

static void inner_entries(Splitter *s)
{
  const Boolean *b = s->b;
  for (size_t k = 0; k < b->source.len; k++)
    for (size_t i = 0; i < b->pieces[k].len; i++) {
      uint32_t h = b->pieces[k].data[i] & ~1u;
      if (b->a.edge.data[h / 2].curve != k) continue;
      if (!boolean__inside(b, side_face(s, h), s->input) ||
          !boolean__inside(b, side_face(s, h ^ 1), s->input))
        continue;
      uint32_t along = b->pieces[k].data[i];
      vec_push(&s->entry, along);
      vec_push(&s->entry, along ^ 1);
    }
}

static void find_dangling(Splitter *s)
{
  const Arrangement *a = &s->b->a;
  uint32_t *degree = mem_zalloc((a->node.len + 1) * sizeof *degree);
  bool *counted = mem_zalloc((a->edge.len + 1) * sizeof *counted);
  for (size_t i = 0; i < s->entry.len; i++) {
    const ArrEdge *e = &a->edge.data[s->entry.data[i] / 2];
    if (counted[s->entry.data[i] / 2]) continue;
    counted[s->entry.data[i] / 2] = true;
    degree[e->from]++;
    degree[e->to]++;
  }
  for (bool more = true; more;) {
    more = false;
    for (size_t i = 0; i < s->entry.len; i++) {
      uint32_t k = s->entry.data[i] / 2;
      const ArrEdge *e = &a->edge.data[k];
      if (s->avoid[k] || (degree[e->from] > 1 && degree[e->to] > 1)) continue;
      s->avoid[k] = more = true;
      degree[e->from]--;
      degree[e->to]--;
    }
  }
  size_t n = 0;
  for (size_t i = 0; i < s->entry.len; i++)
    if (!s->avoid[s->entry.data[i] / 2]) s->entry.data[n++] = s->entry.data[i];
  s->entry.len = n;
  free(degree);
  free(counted);
}

// ---- wires
// -------------------------------------------------------------------------------------------------------------------

static void add_wire(Splitter *s, WireVec *out, const uint32_t *half, size_t n, bool backwards)
{
  Wire w = {.face = side_face(s, half[0])};
  double area = 0;
  for (size_t i = 0; i < n; i++) {
    vec_push(&w.half, half[backwards ? n - 1 - i : i]);
    area += boolean__run_area(s->b, half[i]);
  }
  w.outer = (area > 0) != s->flip;
  vec_push(out, w);
}

// The half-edge that follows on the way round the face at its side.
static uint32_t follow(const Splitter *s, uint32_t half)
{
  const Arrangement *a = &s->b->a;
  uint32_t h;
  if (!s->flip) {
    for (h = a->next.data[half]; s->avoid[h / 2];) h = a->next.data[h ^ 1];
    return h;
  }
  for (h = s->previous[half ^ 1]; s->avoid[h / 2];) h = s->previous[h ^ 1];
  return h ^ 1;
}

static bool is_regular(const Splitter *s, const U32Vec *block)
{
  for (size_t i = 0; i < block->len; i++)
    for (int end = 0; end < 2; end++) {
      uint32_t h = s->entry.data[block->data[i]];
      const U32Vec *at = &s->at[start_of(&s->b->a, h ^ (uint32_t)end)];
      if (at->len != 2) return false;
      if (at->data[0] != at->data[1] && s->entry.data[at->data[0]] / 2 == s->entry.data[at->data[1]] / 2)
        return false;
    }
  return true;
}

static void walk_block(Splitter *s, const U32Vec *block, WireVec *out)
{
  const Arrangement *a = &s->b->a;
  U32Vec path = {0};
  for (size_t i = 0; i < block->len; i++)
    for (int end = 0; end < 2; end++) {
      const ArrEdge *e = &a->edge.data[s->entry.data[block->data[i]] / 2];
      uint32_t node = end ? e->to : e->from;
      for (size_t k = 0; k < s->at[node].len; k++) {
        uint32_t h = s->entry.data[s->at[node].data[k]];
        if (start_of(a, h) != node || s->passed[h]) continue;
        vec_clear(&path);
        for (uint32_t g = h; !s->passed[g]; g = follow(s, g)) {
          s->passed[g] = true;
          vec_push(&path, g);
        }
        add_wire(s, out, path.data, path.len, true);
      }
    }
  vec_free(&path);
}

// Entries that hang together with this one, breadth first.
static void gather_block(const Splitter *s, uint32_t first, bool *taken, U32Vec *block)
{
  const Arrangement *a = &s->b->a;
  vec_clear(block);
  vec_push(block, first);
  taken[first] = true;
  for (size_t i = 0; i < block->len; i++)
    for (int end = 0; end < 2; end++) {
      const ArrEdge *e = &a->edge.data[s->entry.data[block->data[i]] / 2];
      const U32Vec *at = &s->at[end ? e->to : e->from];
      for (size_t k = 0; k < at->len; k++) {
        if (taken[at->data[k]]) continue;
        taken[at->data[k]] = true;
        vec_push(block, at->data[k]);
      }
    }
}

static void split_wires(Splitter *s, WireVec *out)
{
  Boolean *b = s->b;
  for (uint32_t i = 0; i < s->entry.len; i++) {
    const ArrEdge *e = &b->a.edge.data[s->entry.data[i] / 2];
    vec_push(&s->at[e->from], i);
    vec_push(&s->at[e->to], i);
  }
  bool *taken = mem_zalloc((s->entry.len + 1) * sizeof *taken);
  WireVec walked = {0};
  U32Vec block = {0}, half = {0};
  for (uint32_t i = 0; i < s->entry.len; i++) {
    if (taken[i]) continue;
    gather_block(s, i, taken, &block);
    if (!is_regular(s, &block)) {
      walk_block(s, &block, &walked);
      continue;
    }
    vec_clear(&half);
    for (size_t k = 0; k < block.len; k++) vec_push(&half, s->entry.data[block.data[k]]);
    add_wire(s, out, half.data, half.len, false);
  }
  for (size_t i = 0; i < walked.len; i++) vec_push(out, walked.data[i]);
  vec_free(&walked);
  vec_free(&block);
  vec_free(&half);
  free(taken);
  for (size_t v = 0; v < b->a.node.len; v++) vec_clear(&s->at[v]);
}

static void own_wires(Splitter *s, WireVec *out)
{
  for (size_t k = 0; k + 1 < s->loop.len; k++)
    if (s->loop.data[k + 1] > s->loop.data[k])
      add_wire(s, out, s->entry.data + s->loop.data[k], s->loop.data[k + 1] - s->loop.data[k], false);
}

// ---- the result
// ----------------------------------------------------------------------------------------------------------------

static uint32_t outline_of(const Boolean *b, uint32_t piece)
{
  for (uint32_t k = 0; k < b->outline.len; k++)
    if (b->outline.data[k].piece == piece) return k;
  return NONE;
}

static void list_wire(Boolean *b, Listing *l, const Wire *w)
{
  vec_push(&l->wire, (uint32_t)l->run.len);
  for (size_t i = 0; i < w->half.len; i++) vec_push(&l->run, boolean__run_of(b, w->half.data[i]));
}

static void list_face(Boolean *b, const WireVec *wires, const U32Vec *holes, size_t w)
{
  Listing l = {.outline = outline_of(b, wires->data[w].face)};
  list_wire(b, &l, &wires->data[w]);
  for (size_t k = 0; k < holes->len; k++)
    if (wires->data[holes->data[k]].face == wires->data[w].face) list_wire(b, &l, &wires->data[holes->data[k]]);
  vec_push(&l.wire, (uint32_t)l.run.len);
  vec_push(&b->listing, l);
}

// ---- holes ----------------------------------------------------------------------------------------------------------
// The holes of a face that is split are found in the order of the Morton codes of their boxes' centres, on a grid
// of 1024 x 1024 over all of them.

typedef struct {
  uint32_t wire, code;
  Vec2 lo, hi;
} Hole;

static void find_box(const Boolean *b, const Wire *w, Hole *h)
{
  enum { SAMPLES = 64 };
  h->lo = (Vec2){INFINITY, INFINITY};
  h->hi = (Vec2){-INFINITY, -INFINITY};
  for (size_t i = 0; i < w->half.len; i++) {
    const ArrEdge *e = &b->a.edge.data[w->half.data[i] / 2];
    int n = b->curve[e->curve].kind == ARR_LINE ? 1 : SAMPLES;
    for (int k = 0; k <= n; k++) {
      Vec2 p = arr_curve_at(&b->curve[e->curve], e->u0 + (e->u1 - e->u0) * k / n);
      h->lo = (Vec2){fmin(h->lo.x, p.x), fmin(h->lo.y, p.y)};
      h->hi = (Vec2){fmax(h->hi.x, p.x), fmax(h->hi.y, p.y)};
    }
  }
}

static uint32_t cell_of(double lo, double hi, double from, double to)
{
  const double cells = 1024;
  double x = to > from ? ((lo + hi) / 2 - from) / (to - from) * cells : 0;
  return (uint32_t)fmax(0, fmin(cells - 1, x));
}

static uint32_t spread(uint32_t x) // its bits at the even places
{
  uint32_t out = 0;
  for (int i = 0; i < 10; i++) out |= (x >> i & 1) << (2 * i);
  return out;
}

static int compare_holes(const void *x, const void *y)
{
  const Hole *a = x, *b = y;
  return a->code != b->code ? (a->code > b->code) - (a->code < b->code) : (a->wire > b->wire) - (a->wire < b->wire);
}

static void order_holes(const Boolean *b, const WireVec *wires, bool split, U32Vec *out)
{
  Vec(Hole) hole = {0};
  Vec2 lo = {INFINITY, INFINITY}, hi = {-INFINITY, -INFINITY};
  for (uint32_t w = 0; w < wires->len; w++) {
    if (wires->data[w].outer) continue;
    Hole h = {.wire = w};
    find_box(b, &wires->data[w], &h);
    lo = (Vec2){fmin(lo.x, h.lo.x), fmin(lo.y, h.lo.y)};
    hi = (Vec2){fmax(hi.x, h.hi.x), fmax(hi.y, h.hi.y)};
    vec_push(&hole, h);
  }
  for (size_t i = 0; i < hole.len && split; i++) {
    Hole *h = &hole.data[i];
    h->code = spread(cell_of(h->lo.x, h->hi.x, lo.x, hi.x)) | spread(cell_of(h->lo.y, h->hi.y, lo.y, hi.y)) << 1;
  }
  if (hole.len) qsort(hole.data, hole.len, sizeof *hole.data, compare_holes);
  for (size_t i = 0; i < hole.len; i++) vec_push(out, hole.data[i].wire);
  vec_free(&hole);
}

// Faces of a union are listed by their outlines, from this half-edge on.
static void list_union(Boolean *b, uint32_t half)
{
  uint32_t piece = boolean__piece_of(b, half), first = outline_of(b, piece);
  Listing l = {.outline = first};
  for (size_t k = first; k < b->outline.len && b->outline.data[k].piece == piece; k++) {
    const Outline *o = &b->outline.data[k];
    size_t at = 0;
    for (size_t i = 0; i < o->run.len; i++)
      if (o->run.data[i].edge == half / 2) at = i;
    vec_push(&l.wire, (uint32_t)l.run.len);
    for (size_t i = 0; i < o->run.len; i++) vec_push(&l.run, o->run.data[(at + i) % o->run.len]);
  }
  vec_push(&l.wire, (uint32_t)l.run.len);
  vec_push(&b->listing, l);
}

// True: something is inside the input, so that it was split.
static bool input_wires(Boolean *b, Splitter *s, WireVec *out)
{
  vec_clear(&s->entry);
  vec_clear(&s->loop);
  boundary_entries(s);
  size_t own = s->entry.len;
  inner_entries(s);
  memset(s->avoid, 0, b->a.edge.len * sizeof *s->avoid);
  memset(s->passed, 0, 2 * b->a.edge.len * sizeof *s->passed);
  if (s->entry.len == own) {
    own_wires(s, out);
    return false;
  }
  find_dangling(s);
  split_wires(s, out);
  return true;
}

static void list_input(Boolean *b, Splitter *s, bool *seen)
{
  WireVec wires = {0};
  U32Vec holes = {0};
  bool split = input_wires(b, s, &wires);
  order_holes(b, &wires, split, &holes);
  for (size_t w = 0; w < wires.len; w++) {
    uint32_t f = wires.data[w].face;
    if (!wires.data[w].outer || b->piece[f] == NONE) continue;
    b->input.data[s->input].images++;
    if (seen[f]) continue;
    seen[f] = true;
    list_face(b, &wires, &holes, w);
  }
  vec_free(&holes);
  for (size_t w = 0; w < wires.len; w++) vec_free(&wires.data[w].half);
  vec_free(&wires);
}

// ---- unions
// ---------------------------------------------------------------------------------------------------------------------

// Faces that a union joins are found across their edges, breadth first in the order of their wires; the first
// edge that stays is where the outline of all begins.
static void join_from(Boolean *b, const WireVec *wires, const uint32_t *wire_of, uint32_t face, bool *seen)
{
  U32Vec list = {0};
  vec_push(&list, face);
  seen[face] = true;
  uint32_t first = NONE;
  for (size_t i = 0; i < list.len; i++)
    for (size_t w = wire_of[list.data[i]]; w < wires->len && wires->data[w].face == list.data[i]; w++)
      for (size_t k = 0; k < wires->data[w].half.len; k++) {
        uint32_t h = wires->data[w].half.data[k], f = b->a.face.data[b->a.cycle.data[h]];
        uint32_t g = b->a.face.data[b->a.cycle.data[h ^ 1]], other = f == list.data[i] ? g : f;
        if (b->piece[other] != b->piece[face]) {
          if (first == NONE) first = f == list.data[i] ? h : h ^ 1;
        } else if (!seen[other]) {
          seen[other] = true;
          vec_push(&list, other);
        }
      }
  if (first != NONE) list_union(b, first);
  vec_free(&list);
}

static void order_union(Boolean *b, Splitter *s, bool *seen)
{
  WireVec all = {0}, wires = {0};
  uint32_t *wire_of = mem_alloc((b->a.nface + 1) * sizeof *wire_of);
  for (uint32_t f = 0; f <= b->a.nface; f++) wire_of[f] = NONE;
  for (s->input = 0; s->input < b->input.len; s->input++) {
    vec_clear(&wires);
    input_wires(b, s, &wires);
    for (size_t w = 0; w < wires.len; w++) {
      uint32_t f = wires.data[w].face;
      if (wires.data[w].outer && b->piece[f] != NONE && wire_of[f] == NONE) {
        wire_of[f] = (uint32_t)all.len;
        vec_push(&all, wires.data[w]);
        wires.data[w].half = (U32Vec){0};
        for (size_t k = 0; k < wires.len; k++) {
          if (wires.data[k].outer || wires.data[k].face != f) continue;
          vec_push(&all, wires.data[k]);
          wires.data[k].half = (U32Vec){0};
        }
      }
    }
    for (size_t w = 0; w < wires.len; w++) vec_free(&wires.data[w].half);
  }
  for (size_t w = 0; w < all.len; w++)
    if (!seen[all.data[w].face]) join_from(b, &all, wire_of, all.data[w].face, seen);
  for (size_t w = 0; w < all.len; w++) vec_free(&all.data[w].half);
  vec_free(&all);
  vec_free(&wires);
  free(wire_of);
}

void boolean__list_as_input(Boolean *b, size_t listed, size_t input)
{
  Splitter s = {.b = b, .input = input};
  boundary_entries(&s);
  Listing *l = &b->listing.data[listed];
  vec_clear(&l->run);
  vec_clear(&l->wire);
  for (size_t k = 0; k + 1 < s.loop.len; k++) {
    vec_push(&l->wire, (uint32_t)l->run.len);
    for (size_t i = s.loop.data[k]; i < s.loop.data[k + 1]; i++)
      vec_push(&l->run, boolean__run_of(b, s.entry.data[i]));
  }
  vec_push(&l->wire, (uint32_t)l->run.len);
  vec_free(&s.entry);
  vec_free(&s.loop);
}

// Does any face of this piece of a union lie in the input?
static bool piece_is_in(const Boolean *b, uint32_t piece, size_t input)
{
  for (uint32_t f = 1; f < b->a.nface; f++)
    if (b->piece[f] == piece && boolean__inside(b, f, input)) return true;
  return false;
}

void boolean__order(Boolean *b)
{
  size_t nedge = b->a.edge.len, nnode = b->a.node.len;
  Splitter s = {.b = b};
  s.avoid = mem_zalloc((nedge + 1) * sizeof *s.avoid);
  s.passed = mem_zalloc((2 * nedge + 1) * sizeof *s.passed);
  s.at = mem_zalloc((nnode + 1) * sizeof *s.at);
  s.previous = mem_alloc((2 * nedge + 1) * sizeof *s.previous);
  for (uint32_t h = 0; h < 2 * nedge; h++) s.previous[b->a.next.data[h]] = h;
  bool *seen = mem_zalloc((b->a.nface + 1) * sizeof *seen);
  if (b->op == BOOLEAN_UNION)
    order_union(b, &s, seen);
  else
    for (s.input = 0; s.input < b->input.len; s.input++) list_input(b, &s, seen);
  for (size_t i = 0; b->op == BOOLEAN_UNION && i < b->input.len; i++)
    for (size_t k = 0; k < b->listing.len; k++)
      b->input.data[i].images += piece_is_in(b, b->outline.data[b->listing.data[k].outline].piece, i);
  for (size_t v = 0; v < nnode; v++) vec_free(&s.at[v]);
  vec_free(&s.entry);
  vec_free(&s.loop);
  free(s.avoid);
  free(s.passed);
  free(s.at);
  free(s.previous);
  free(seen);
}
