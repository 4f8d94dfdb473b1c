// boolean.c - union, intersection, difference and fragments of plane faces
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "geom/arrangement.h"
#include "model/boolean_int.h"

// ---- input: faces, and curves that cut ------------------------------------------------------------------------------------

static bool take_curve(Boolean *b, int tag)
{
  tag = tag__abs(tag);
  bool added;
  uint32_t *slot = map_slot(&b->index, (uint64_t)tag, (uint32_t)b->source.len, &added);
  if (!added) return *slot != NONE;
  Curve *c = model_curve(b->m, tag);
  if (!c || !curve__build(b->m, c, b->diag)) return false;
  vec_push(&b->source, tag);
  U32Vec none = {0};
  vec_push(&b->bounds, none);
  return true;
}

static bool take_face(Boolean *b, int tag, bool tool, bool drop)
{
  Face *f = model_face(b->m, tag);
  for (size_t i = 0; i < b->input.len; i++)
    if (b->input.data[i].face == f) { // listed twice, perhaps on both sides
      *(tool ? &b->input.data[i].tool : &b->input.data[i].object) = true;
      b->input.data[i].drop |= drop;
      return true;
    }
  uint32_t rank = (uint32_t)b->input.len;
  vec_push(&b->input, ((BooleanInput){.face = f, .tag = f->tag, .object = !tool, .tool = tool, .drop = drop}));
  for (int k = 0; k < f->nloop; k++) {
    Loop *l = model_loop(b->m, f->loop[k]);
    if (!l || loop__sort(b->m, l, false, b->diag) != LOOP_OK) return false;
    for (int i = 0; i < l->ncurve; i++)
      if (!take_curve(b, l->curve[i])) return false;
  }
  if (!face__build(b->m, f, b->m->set.tolerance, b->diag)) return false;
  IntVec curve = {0}, start = {0};
  face_boundary(b->m, f, &curve, &start);
  for (size_t i = 0; i < curve.len; i++) vec_push(&b->bounds.data[map_get(&b->index, (uint64_t)tag__abs(curve.data[i]))], rank);
  vec_free(&curve);
  vec_free(&start);
  return true;
}

static bool take(Boolean *b, const Shape *shape, size_t n, bool tool, bool drop, const char *word)
{
  for (size_t i = 0; i < n; i++) {
    const Shape *s = &shape[i];
    if (!model_has(b->m, s->dim, s->tag)) {
      if (!model__refused(b->m, dim__kind(s->dim), s->tag))
        diag_error(b->diag, b->loc, "%s of %s %d, which does not exist", word, dim__name(s->dim), s->tag);
      return false;
    }
    if (s->dim == 2) {
      if (!take_face(b, s->tag, tool, drop)) return false;
    } else if (s->dim == 1 && b->op == BOOLEAN_FRAGMENTS) {
      if (!take_curve(b, s->tag)) return false;
      vec_push(&b->cutter, ((Cutter){tag__abs(s->tag), drop}));
    } else if (s->dim == 0 && b->op == BOOLEAN_FRAGMENTS) {
      vec_push(&b->point, tag__abs(s->tag));
      vec_push(&b->place, point__get(b->m, tag__abs(s->tag))->xyz);
    } else {
      diag_error(b->diag, b->loc, "%s works on plane surfaces here (BooleanFragments on curves and points too), not on %s %d", word,
                 dim__name(s->dim), s->tag);
      return false;
    }
  }
  return true;
}

static bool in_one_plane(Boolean *b, const char *word)
{
  const Face *f = &b->frame;
  if (b->input.len)
    b->frame = *b->input.data[0].face;
  else
    plane__of_curves(b->m, b->source.data, b->source.len, &b->frame);
  double size = vec3_distance(b->m->extent.lo, b->m->extent.hi);
  for (size_t i = 0; i < b->input.len; i++)
    if (!b->input.data[i].face->planar || b->input.data[i].face->sphere) {
      diag_error(b->diag, b->loc, "%s: surface %d is not plane", word, b->input.data[i].tag);
      return false;
    }
  for (size_t i = 0; i < b->source.len; i++) {
    const Curve *c = model_curve(b->m, b->source.data[i]);
    for (int k = 0; k <= 8; k++) {
      Vec3 d = vec3_sub(curve_point(b->m, c, k / 8.0), f->origin);
      if (fabs(vec3_dot(d, f->normal)) <= 1e-7 * size) continue;
      if (b->input.len)
        diag_error(b->diag, b->loc, "%s: curve %d is not in the plane of surface %d; all must be in one plane", word, c->tag, f->tag);
      else
        diag_error(b->diag, b->loc, "%s: curve %d is not in the plane of the others; all must be in one plane", word, c->tag);
      return false;
    }
  }
  return true;
}

static Vec2 direction(const Face *f, Vec3 d) { return (Vec2){vec3_dot(d, f->axis_u), vec3_dot(d, f->axis_v)}; }

static void take_spline(Boolean *b, const Curve *c, const CurveShape *h, ArrCurve *k)
{
  const Face *f = &b->frame;
  bool chords = h->degree > ARR_MOST_DEGREE;
  int per = chords ? 2 : h->degree + 1, n = h->degree == 1 && h->uniform ? h->npiece : MAX(64, 16 * h->npiece);
  int npiece = chords ? n : h->npiece;
  Vec2 *point = arena_alloc(&b->arena, ((size_t)n + 1) * sizeof *point);
  Vec2 *control = arena_alloc(&b->arena, (size_t)(npiece * per) * sizeof *control);
  double *knot = arena_alloc(&b->arena, ((size_t)npiece + 1) * sizeof *knot);
  for (int i = 0; i <= n; i++) point[i] = face_to_plane(f, curve_point(b->m, c, (double)i / n));
  for (int i = 0; i < npiece * per; i++) control[i] = chords ? point[i / 2 + i % 2] : face_to_plane(f, h->control[i]);
  for (int i = 0; i <= npiece; i++) knot[i] = chords ? (double)i / n : h->knot[i];
  *k = (ArrCurve){.kind = ARR_SPLINE, .p = k->p, .q = k->q, .control = control, .point = point, .knot = knot, .degree = per - 1,
                  .npiece = npiece, .npoint = (size_t)n + 1};
}

static ArrCurve plane_curve(Boolean *b, const Curve *c)
{
  const Face *f = &b->frame;
  const CurveShape *h = c->shape;
  ArrCurve k = {.kind = ARR_LINE, .p = face_to_plane(f, curve__begin(b->m, c)), .q = face_to_plane(f, curve__end(b->m, c))};
  if (!h || h->straight) return k;
  if (h->kind == SHAPE_ARC) {
    k.kind = ARR_ARC;
    k.c = face_to_plane(f, h->centre);
    k.a = direction(f, h->a);
    k.b = direction(f, h->b);
    k.t0 = h->t0;
    k.t1 = h->t1;
    return k;
  }
  take_spline(b, c, h, &k);
  return k;
}

// ---- which faces of the arrangement lie in which inputs ----------------------------------------------------------------------

bool boolean__inside(const Boolean *b, uint32_t face, size_t input)
{
  return b->in[face * b->words + input / 64] >> (input % 64) & 1;
}

static void toggle(const Boolean *b, uint64_t *set, uint32_t curve)
{
  const U32Vec *v = &b->bounds.data[curve];
  for (size_t i = 0; i < v->len; i++) set[v->data[i] / 64] ^= UINT64_C(1) << (v->data[i] % 64);
}

// From the unbounded face, which is in none, across edges: each changes the inputs that it bounds.
static bool classify(Boolean *b)
{
  const Arrangement *a = &b->a;
  b->words = (b->input.len + 63) / 64;
  b->in = mem_zalloc((a->nface * b->words + 1) * sizeof *b->in);
  bool *known = mem_zalloc(a->nface * sizeof *known), good = true;
  uint64_t *set = mem_alloc((b->words + 1) * sizeof *set);
  known[0] = true;
  for (bool more = true; more;) {
    more = false;
    for (uint32_t h = 0; h < 2 * a->edge.len && good; h++) {
      uint32_t f = a->face.data[a->cycle.data[h]], g = a->face.data[a->cycle.data[h ^ 1]];
      if (!known[f]) continue;
      memcpy(set, b->in + f * b->words, b->words * sizeof *set);
      const ArrEdge *e = &a->edge.data[h / 2];
      toggle(b, set, e->curve);
      for (size_t i = 0; i < e->also.len; i++) toggle(b, set, e->also.data[i]);
      uint64_t *to = b->in + g * b->words;
      if (known[g]) {
        good = memcmp(to, set, b->words * sizeof *set) == 0;
        continue;
      }
      memcpy(to, set, b->words * sizeof *set);
      known[g] = more = true;
    }
    more = more && good;
  }
  free(set);
  free(known);
  return good;
}

static bool wanted(const Boolean *b, uint32_t face)
{
  bool object = false, tool = false;
  for (size_t i = 0; i < b->input.len; i++)
    if (boolean__inside(b, face, i)) {
      object |= b->input.data[i].object;
      tool |= b->input.data[i].tool;
    }
  switch (b->op) {
  case BOOLEAN_UNION:
  case BOOLEAN_FRAGMENTS: return object || tool;
  case BOOLEAN_INTERSECTION: return object && tool;
  case BOOLEAN_DIFFERENCE: return object && !tool;
  }
  UNREACHABLE();
}

static uint32_t root(uint32_t *parent, uint32_t i)
{
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// piece[face]: the face of the result it belongs to, named after one of its members; NONE if it is not wanted. In a union wanted
// neighbours are one piece.
static void gather(Boolean *b)
{
  const Arrangement *a = &b->a;
  b->piece = mem_alloc(a->nface * sizeof *b->piece);
  for (uint32_t f = 0; f < a->nface; f++) b->piece[f] = f && wanted(b, f) ? f : NONE;
  if (b->op != BOOLEAN_UNION) return;
  uint32_t *parent = mem_alloc(a->nface * sizeof *parent);
  for (uint32_t f = 0; f < a->nface; f++) parent[f] = f;
  for (uint32_t h = 0; h < 2 * a->edge.len; h += 2) {
    uint32_t f = a->face.data[a->cycle.data[h]], g = a->face.data[a->cycle.data[h ^ 1]];
    if (b->piece[f] != NONE && b->piece[g] != NONE) parent[root(parent, f)] = root(parent, g);
  }
  for (uint32_t f = 0; f < a->nface; f++)
    if (b->piece[f] != NONE) b->piece[f] = root(parent, f);
  free(parent);
}

uint32_t boolean__piece_of(const Boolean *b, uint32_t half) { return b->piece[b->a.face.data[b->a.cycle.data[half]]]; }

static bool bounds_piece(const Boolean *b, uint32_t half) { return boolean__piece_of(b, half) != NONE && boolean__piece_of(b, half) != boolean__piece_of(b, half ^ 1); }

// ---- the outlines of the pieces -----------------------------------------------------------------------------------------------

Run boolean__run_of(const Boolean *b, uint32_t half)
{
  const ArrEdge *e = &b->a.edge.data[half / 2];
  bool back = half & 1;
  for (size_t i = 0; i < e->also.len && !(e->u0 == 0 && e->u1 == 1); i++) { // of curves that coincide there, one that is whole
    const U32Vec *p = &b->pieces[e->also.data[i]];
    if (p->len != 1 || b->merged[e->from] || b->merged[e->to]) continue;
    bool turned = (half ^ p->data[0]) & 1;
    return (Run){.curve = e->also.data[i], .edge = half / 2, .back = turned, .from = back ? e->to : e->from,
                 .to = back ? e->from : e->to, .u0 = turned ? 1 : 0, .u1 = turned ? 0 : 1, .whole = true};
  }
  Run r = {.curve = e->curve, .edge = half / 2, .back = back, .from = back ? e->to : e->from, .to = back ? e->from : e->to,
           .u0 = back ? e->u1 : e->u0, .u1 = back ? e->u0 : e->u1};
  r.whole = e->u0 == 0 && e->u1 == 1;
  return r;
}

// In a union, runs of one straight line, arc or spline that meet where nothing else does become one.
static bool joins(const Boolean *b, const Run *x, const Run *y)
{
  if (b->op != BOOLEAN_UNION || x->to != y->from || b->degree[x->to] != 2 || x->from == y->to) return false;
  const ArrCurve *c = &b->curve[x->curve], *d = &b->curve[y->curve];
  if (c->kind != ARR_LINE && x->curve == y->curve && x->back == y->back) return x->u1 == y->u0;
  if (c->kind != ARR_LINE || d->kind != ARR_LINE) return false;
  const Vec2 *p = b->a.node.data;
  Vec2 s = vec2_sub(p[x->to], p[x->from]), t = vec2_sub(p[y->to], p[y->from]);
  return fabs(vec2_cross(s, t)) <= 1e-9 * vec2_length(s) * vec2_length(t) && vec2_dot(s, t) > 0;
}

// What is made of several runs ends at new points, so that its neighbours change too.
static void join_runs(const Boolean *b, Outline *o)
{
  bool *made = mem_zalloc(o->run.len + 1);
  size_t n = 0;
  for (size_t i = 0; i < o->run.len; i++) {
    if (n && joins(b, &o->run.data[n - 1], &o->run.data[i])) {
      Run *r = &o->run.data[n - 1];
      r->to = o->run.data[i].to;
      r->u1 = o->run.data[i].u1;
      r->whole = false;
      made[n - 1] = true;
    } else {
      o->run.data[n++] = o->run.data[i];
    }
  }
  if (n > 1 && joins(b, &o->run.data[n - 1], &o->run.data[0])) { // across the start
    Run *r = &o->run.data[0], *l = &o->run.data[n - 1];
    r->from = l->from;
    r->u0 = l->u0;
    r->whole = false;
    made[0] = true;
    n--;
  }
  o->run.len = n;
  for (size_t i = 0; i < n; i++)
    if (made[i]) b->merged[o->run.data[i].from] = b->merged[o->run.data[i].to] = true;
  free(made);
}

double boolean__run_area(const Boolean *b, uint32_t half) // of chords: only its sign and order of magnitude count
{
  const ArrEdge *e = &b->a.edge.data[half / 2];
  const ArrCurve *c = &b->curve[e->curve];
  double sum = 0;
  for (int i = 0; i < 64; i++)
    sum += vec2_cross(arr_curve_at(c, e->u0 + (e->u1 - e->u0) * i / 64), arr_curve_at(c, e->u0 + (e->u1 - e->u0) * (i + 1) / 64)) / 2;
  return half & 1 ? -sum : sum;
}

static Outline outline(Boolean *b, uint32_t half, bool *seen)
{
  Outline o = {.piece = boolean__piece_of(b, half)};
  uint32_t h = half;
  do {
    seen[h] = true;
    vec_push(&o.run, boolean__run_of(b, h));
    o.area += boolean__run_area(b, h);
    for (h = b->a.next.data[h]; !bounds_piece(b, h) || boolean__piece_of(b, h) != o.piece;) h = b->a.next.data[h ^ 1];
  } while (h != half);
  join_runs(b, &o);
  return o;
}

static int compare_outlines(const void *x, const void *y)
{
  const Outline *a = x, *b = y;
  if (a->piece != b->piece) return a->piece < b->piece ? -1 : 1;
  return (a->area < b->area) - (a->area > b->area); // the outer one first
}

static void trace(Boolean *b)
{
  size_t nh = 2 * b->a.edge.len;
  bool *seen = mem_zalloc((nh + 1) * sizeof *seen);
  b->degree = mem_zalloc((b->a.node.len + 1) * sizeof *b->degree);
  for (uint32_t h = 0; h < nh; h++) {
    if (!bounds_piece(b, h)) continue;
    b->degree[b->a.edge.data[h / 2].from]++;
    b->degree[b->a.edge.data[h / 2].to]++;
  }
  for (uint32_t h = 0; h < nh; h++)
    if (bounds_piece(b, h) && !seen[h]) {
      Outline o = outline(b, h, seen);
      vec_push(&b->outline, o);
    }
  if (b->outline.len) qsort(b->outline.data, b->outline.len, sizeof *b->outline.data, compare_outlines);
  free(seen);
}

uint32_t boolean__node_near(const Boolean *b, Vec2 p)
{
  for (uint32_t v = 0; v < b->a.node.len; v++)
    if (vec2_length(vec2_sub(b->a.node.data[v], p)) <= b->tol) return v;
  return NONE;
}

// ---- all ------------------------------------------------------------------------------------------------------------------------

static void boolean_free(Boolean *b)
{
  arrangement_free(&b->a);
  for (size_t i = 0; i < b->bounds.len; i++) vec_free(&b->bounds.data[i]);
  for (size_t i = 0; i < b->outline.len; i++) vec_free(&b->outline.data[i].run);
  vec_free(&b->outline);
  vec_free(&b->bounds);
  vec_free(&b->input);
  vec_free(&b->cutter);
  vec_free(&b->point);
  vec_free(&b->place);
  vec_free(&b->at_node);
  for (size_t k = 0; k < b->listing.len; k++) {
    vec_free(&b->listing.data[k].run);
    vec_free(&b->listing.data[k].wire);
  }
  vec_free(&b->listing);
  for (size_t i = 0; b->pieces && i < b->source.len; i++) vec_free(&b->pieces[i]);
  free(b->pieces);
  free(b->merged);
  vec_free(&b->source);
  map_free(&b->index);
  free(b->curve);
  free(b->in);
  free(b->piece);
  free(b->degree);
  arena_free(&b->arena);
}

static bool compute(Boolean *b, const char *word)
{
  if (!in_one_plane(b, word)) return false;
  b->curve = mem_alloc((b->source.len + 1) * sizeof *b->curve);
  for (size_t i = 0; i < b->source.len; i++) b->curve[i] = plane_curve(b, model_curve(b->m, b->source.data[i]));
  b->tol = fmax(b->m->set.tolerance, 1e-9) * vec3_distance(b->m->extent.lo, b->m->extent.hi);
  arrangement_build(&b->a, b->curve, b->source.len, b->tol);
  if (!classify(b)) {
    diag_error(b->diag, b->loc, "%s: the boundaries of the surfaces meet in a way that was not resolved", word);
    return false;
  }
  gather(b);
  boolean__list_pieces(b);
  trace(b);
  boolean__order(b);
  return true;
}

// ---- points among the shapes of fragments ---------------------------------------------------------------------------------
enum { SAMPLES = 64 }; // of a bent curve: a point nearer to it than these tell is the mesher's to see

static bool crosses_ray(Vec2 p, Vec2 a, Vec2 b)
{
  return (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
}

typedef enum { POINT_OUTSIDE, POINT_IN_FACE, POINT_AT_CORNER } PointPlace;

// Where a point of its plane is: inside or on the boundary of the face, by crossings of that with a ray; or at the end of a curve.
static PointPlace place_of(const Boolean *b, const Face *f, Vec3 p)
{
  Model *m = b->m;
  Vec2 q = face_to_plane(f, p);
  IntVec curve = {0}, start = {0};
  bool inside = false, on = false, corner = false;
  face_boundary(m, f, &curve, &start);
  for (size_t i = 0; i < curve.len && !corner; i++) {
    const Curve *c = model_curve(m, curve.data[i]);
    corner = vec3_distance(curve_point(m, c, 0), p) <= b->tol || vec3_distance(curve_point(m, c, 1), p) <= b->tol;
    on |= vec3_distance(curve_point(m, c, curve_nearest(m, c, p)), p) <= b->tol;
    int n = curve_is_straight(m, c) ? 1 : SAMPLES;
    for (int k = 0; k < n; k++)
      inside ^= crosses_ray(q, face_to_plane(f, curve_point(m, c, k / (double)n)), face_to_plane(f, curve_point(m, c, (k + 1) / (double)n)));
  }
  vec_free(&curve);
  vec_free(&start);
  return corner ? POINT_AT_CORNER : inside || on ? POINT_IN_FACE : POINT_OUTSIDE;
}

static bool build(Boolean *b, Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(b->m, f, &curve, &start);
  bool good = true;
  for (size_t i = 0; i < curve.len; i++) good = good && curve__build(b->m, model_curve(b->m, curve.data[i]), b->diag);
  vec_free(&curve);
  vec_free(&start);
  return good && face__build(b->m, f, b->m->set.tolerance, b->diag);
}

// Points in faces of the result are embedded there; all are part of what is returned.
static void embed_points(Boolean *b, ShapeVec *out, size_t first)
{
  size_t n = out->len;
  if (!b->point.len) return;
  for (size_t k = first; k < n; k++)
    if (out->data[k].dim == 2 && !build(b, model_face(b->m, out->data[k].tag))) return;
  for (size_t i = 0; i < b->point.len; i++) {
    int tag = b->point.data[i];
    Vec3 p = b->place.data[i];
    bool gone = !point__get(b->m, tag); // an end of curves, with another number now
    if (gone) {
      uint32_t v = boolean__node_near(b, face_to_plane(&b->frame, p));
      if (v == NONE || v >= b->at_node.len || !(tag = b->at_node.data[v])) continue;
    }
    for (size_t k = first; k < n && !gone; k++) {
      Face *f = out->data[k].dim == 2 ? model_face(b->m, out->data[k].tag) : NULL;
      if (!f || vec3_distance(face_from_plane(f, face_to_plane(f, p)), p) > b->tol) continue;
      PointPlace place = place_of(b, f, p);
      if (place == POINT_OUTSIDE) continue;
      if (place == POINT_AT_CORNER) break; // it is there already
      if (!f->embedded_points.len && !f->embedded_curves.len) b->m->nembedded++;
      vec_push(&f->embedded_points, tag);
      break;
    }
    vec_push(out, ((Shape){0, tag}));
  }
}

bool model_boolean(Model *m, BooleanOp op, const BooleanSide *object, const BooleanSide *tool, int tag, ShapeVec *out, SrcLoc loc,
                   Diag *diag)
{
  static const char *const words[] = {"BooleanUnion", "BooleanIntersection", "BooleanDifference", "BooleanFragments"};
  model__unprepare(m);
  Boolean b = {.m = m, .op = op, .loc = loc, .diag = diag};
  bool good = take(&b, object->shape, object->n, false, object->drop, words[op]) &&
              take(&b, tool->shape, tool->n, true, tool->drop, words[op]);
  if (good && b.input.len == 0 && b.cutter.len == 0) {
    diag_error(diag, loc, op == BOOLEAN_FRAGMENTS ? "%s needs surfaces or curves" : "%s needs surfaces", words[op]);
    good = false;
  }
  size_t first = out->len;
  good = good && compute(&b, words[op]) && boolean__apply(&b, tag, out);
  if (good) embed_points(&b, out, first);
  boolean_free(&b);
  return good;
}

bool model_fragment_all(Model *m, SrcLoc loc, Diag *diag)
{
  IntVec tag = {0};
  int dim = model_volumes(m) ? 3 : 2;
  if (dim == 2) model_all(m, dim, &tag);
  if (dim == 2 && !tag.len) model_all(m, dim = 1, &tag);
  ShapeVec all = {0}, out = {0};
  for (size_t i = 0; i < tag.len; i++) vec_push(&all, ((Shape){dim, tag.data[i]}));
  vec_free(&tag);
  bool good = false;
  if (all.len) {
    Diag *quiet = diag_child(diag);
    good = model_boolean(m, BOOLEAN_FRAGMENTS, &(BooleanSide){all.data, all.len, true}, &(BooleanSide){0}, -1, &out, loc, quiet);
    if (good) {
      diag_merge(diag, quiet);
    } else {
      diag_warning(diag, loc, "Coherence merges only what is equal here, it cuts nothing: %s",
                   diag_count(quiet) ? diag_get(quiet, 0)->text : "the boundaries are not closed");
      diag_free(quiet);
    }
  }
  vec_free(&all);
  vec_free(&out);
  return good;
}
