// boolean_number.c - Boolean operations: what keeps its number, as OpenCASCADE has it
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/boolean_int.h"

// ---- what stays
// -----------------------------------------------------------------------------------------------------------

// Where `from` stands on a curve, `to` takes its place.
static void replace_point(Model *m, Curve *c, int from, int to)
{
  Point *p = point__get(m, from), *q = point__get(m, to);
  model__forget_curve(m, c);
  for (int i = 0; i < c->npoint; i++) {
    if (c->point[i] != from) continue;
    c->point[i] = to;
    p->uses--;
    q->uses++;
  }
  int *end[2] = {&c->begin, &c->end};
  for (int i = 0; i < 2; i++) {
    if (*end[i] != from) continue;
    *end[i] = to;
    p->uses--;
    q->uses++;
  }
  vec_push(&m->dirty[1], c->tag);
}

// Is it of an input that stays as it is?
static bool belongs_to_kept(const Boolean *b, size_t source)
{
  for (size_t k = 0; k < b->bounds.data[source].len; k++)
    if (!b->input.data[b->bounds.data[source].data[k]].drop) return true;
  for (size_t k = 0; k < b->cutter.len; k++)
    if (b->cutter.data[k].tag == b->source.data[source] && !b->cutter.data[k].drop) return true;
  return false;
}

static void find_fresh(BooleanApply *a)
{
  const Boolean *b = a->b;
  for (size_t i = 0; i < b->source.len; i++) {
    if (!belongs_to_kept(b, i)) continue;
    for (int end = 0; end < 2; end++) {
      uint32_t v = boolean__node_near(b, end ? b->curve[i].q : b->curve[i].p);
      if (v != NONE && b->merged[v]) a->fresh[v] = true;
    }
  }
}

// The end points of curves stand at nodes. Of several at one node the first listed takes the place of all, if none stays as it is.
static void known_points(BooleanApply *a)
{
  Boolean *b = a->b;
  find_fresh(a);
  for (size_t i = 0; i < b->source.len; i++) {
    Curve *c = model_curve(b->m, b->source.data[i]);
    for (int end = 0; end < 2; end++) {
      uint32_t v = boolean__node_near(b, end ? b->curve[i].q : b->curve[i].p);
      int tag = end ? c->end : c->begin;
      if (v == NONE || a->point[v] == tag) continue;
      if (a->fresh[v]) {
        if (a->lc[v] == 0) a->lc[v] = point__get(b->m, tag)->lc;
        continue;
      }
      if (!a->point[v]) {
        a->point[v] = tag;
        continue;
      }
      replace_point(b->m, c, tag, a->point[v]);
      vec_push(&a->idle, tag);
    }
  }
}

bool boolean__reuses(const BooleanApply *a, const Run *r)
{
  return r->whole && !a->fresh[r->from] && !a->fresh[r->to];
}

// Its outlines are the boundary of the face, curve for curve: nothing happened to it.
static bool is_unchanged(const Boolean *b, size_t first, const Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(b->m, f, &curve, &start);
  size_t n = 0;
  bool same = true;
  for (size_t k = first;
       same && k < b->outline.len && b->outline.data[k].piece == b->outline.data[first].piece; k++)
    for (size_t i = 0; same && i < b->outline.data[k].run.len; i++, n++) {
      const Run *r = &b->outline.data[k].run.data[i];
      bool found = false;
      for (size_t j = 0; j < curve.len && r->whole && !found; j++)
        found = tag__abs(curve.data[j]) == b->source.data[r->curve];
      same = found;
    }
  same = same && n == curve.len;
  vec_free(&curve);
  vec_free(&start);
  return same;
}

static size_t unchanged_input(const Boolean *b, size_t first)
{
  for (size_t i = 0; i < b->input.len; i++)
    if (is_unchanged(b, first, b->input.data[i].face)) return i;
  return SIZE_MAX;
}

// ---- which numbers stay
// ------------------------------------------------------------------------------------------------------

// Measured. What nothing touched stays as it is. Else inputs go one after the other, objects first, each with
// its curves and points that nothing else has; one that comes out as one face gives it its number at once,
// but for unions. So a curve keeps its number if such a face has it when its last input goes.

static bool is_intact(const BooleanApply *a, const Run *r)
{
  return r->whole && !a->b->merged[r->from] && !a->b->merged[r->to];
}

Run boolean__inner_run(const Boolean *b, uint32_t edge) { return boolean__run_of(b, 2 * edge); }

bool boolean__is_inner(const Boolean *b, uint32_t edge, uint32_t piece)
{
  uint32_t f = b->a.face.data[b->a.cycle.data[2 * edge]], g = b->a.face.data[b->a.cycle.data[2 * edge + 1]];
  return b->op == BOOLEAN_FRAGMENTS && f == g && b->piece[f] == piece;
}

uint32_t boolean__piece_at(const Boolean *b, size_t k)
{
  return b->outline.data[b->listing.data[k].outline].piece;
}

static bool all_intact(const BooleanApply *a, size_t k)
{
  const Boolean *b = a->b;
  const Listing *l = &b->listing.data[k];
  bool good = true;
  for (size_t i = 0; i < l->run.len && good; i++) good = is_intact(a, &l->run.data[i]);
  for (uint32_t e = 0; e < b->a.edge.len && good; e++)
    good = !boolean__is_inner(b, e, boolean__piece_at(b, k));
  return good;
}

static bool all_reused(const BooleanApply *a, size_t k)
{
  const Listing *l = &a->b->listing.data[k];
  bool good = true;
  for (size_t i = 0; i < l->run.len && good; i++) good = boolean__reuses(a, &l->run.data[i]);
  return good;
}

static bool is_untouched(const BooleanApply *a, size_t k)
{
  const Boolean *b = a->b;
  size_t in = 0;
  for (size_t i = 0; i < b->input.len; i++) in += boolean__inside(b, boolean__piece_at(b, k), i);
  bool both = b->op == BOOLEAN_INTERSECTION && b->input.len == 2 && b->input.data[0].drop && b->input.data[1].drop;
  return (in == 1 || both) && all_intact(a, k);
}

static void find_kept(BooleanApply *a, bool numbered)
{
  const Boolean *b = a->b;
  for (size_t k = 0; k < b->listing.len; k++) {
    a->same[k] = unchanged_input(b, b->listing.data[k].outline);
    if (a->same[k] == SIZE_MAX) continue;
    a->kept[k] = !numbered && (b->input.data[a->same[k]].drop ? is_untouched(a, k) : all_reused(a, k));
    if (all_intact(a, k)) boolean__list_as_input(a->b, k, a->same[k]);
  }
}

static void find_owners(BooleanApply *a, bool numbered)
{
  const Boolean *b = a->b;
  for (size_t k = 0; k < b->listing.len; k++) a->owner[k] = a->kept[k] ? (uint32_t)a->same[k] : NONE;
  for (size_t i = 0; i < b->input.len && !numbered && b->op != BOOLEAN_UNION; i++) {
    if (!b->input.data[i].drop || b->input.data[i].images != 1) continue;
    for (size_t k = 0; k < b->listing.len; k++) {
      if (!boolean__inside(b, boolean__piece_at(b, k), i)) continue;
      if (a->owner[k] == NONE) a->owner[k] = (uint32_t)i;
      break;
    }
  }
}

// Of shapes that only share an edge, or lie in each other, Gmsh 4.8.4 keeps the pieces under their numbers, beside their union,
// which later versions number as the first of them.
static void find_owners_of_union(BooleanApply *a, bool numbered)
{
  const Boolean *b = a->b;
  for (size_t i = 0; i < b->input.len && !numbered && b->op == BOOLEAN_UNION; i++) {
    uint32_t only = NONE, n = 0;
    for (uint32_t f = 1; f < b->a.nface; f++)
      if (boolean__inside(b, f, i)) only = f, n++;
    if (!b->input.data[i].drop || n != 1) continue;
    for (size_t k = 0; k < b->listing.len; k++)
      if (a->owner[k] == NONE && b->piece[only] == boolean__piece_at(b, k)) a->owner[k] = (uint32_t)i;
  }
}

// When the last input that a curve bounds goes (1 + rank; 0: never), cutting curves last of all.
static size_t last_use(const Boolean *b, size_t source)
{
  size_t last = 0;
  for (size_t k = 0; k < b->bounds.data[source].len; k++) {
    uint32_t i = b->bounds.data[source].data[k];
    if (b->input.data[i].drop) last = MAX(last, (size_t)i + 1);
  }
  for (size_t k = 0; k < b->cutter.len; k++)
    if (b->cutter.data[k].tag == b->source.data[source] && b->cutter.data[k].drop)
      last = b->input.len + 1 + k;
  return last;
}

static void keep_curves(BooleanApply *a)
{
  const Boolean *b = a->b;
  for (size_t k = 0; k < b->cutter.len; k++) { // cutting curves that nothing cut
    uint32_t source = map_get(&b->index, (uint64_t)b->cutter.data[k].tag);
    if (b->pieces[source].len != 1) continue;
    Run r = boolean__run_of(b, b->pieces[source].data[0]);
    if (is_intact(a, &r) && r.curve == source) a->keep_curve[source] = true;
  }
  for (size_t k = 0; k < b->listing.len; k++) {
    if (a->owner[k] == NONE) continue;
    const Listing *l = &b->listing.data[k];
    for (size_t i = 0; i < l->run.len; i++) {
      const Run *r = &l->run.data[i];
      if (a->kept[k] || (is_intact(a, r) && last_use(b, r->curve) > a->owner[k] + 1))
        a->keep_curve[r->curve] = true;
    }
    for (uint32_t e = 0; e < b->a.edge.len; e++) {
      Run r = boolean__inner_run(b, e);
      if (boolean__is_inner(b, e, boolean__piece_at(b, k)) && is_intact(a, &r)) a->keep_curve[r.curve] = true;
    }
  }
}

void boolean__plan(BooleanApply *a, bool numbered)
{
  known_points(a);
  find_kept(a, numbered);
  find_owners(a, numbered);
  find_owners_of_union(a, numbered);
  keep_curves(a);
}
