// compound_curve.c - curves that are meshed as one (Compound Curve): chains, and the shape of a chain
// SPDX-License-Identifier: MIT
//
// The curve of least tag leads: until the model is edited again it runs from one end of the chain to the other, as Bezier pieces of one
// degree, and the others have no mesh. The chain's parameter is in proportion to the length of its curves, and on each to its own.
#include "base/base.h"

#include "model/curve_int.h"

// ---- who goes with whom ---------------------------------------------------------------------------------------------------
// What is at a point: how many ends of curves, and two of the curves.
typedef struct {
  int ends;
  Curve *curve[2];
} Meeting;

typedef struct {
  Model *m;
  Map at;                // point tag -> meeting
  Vec(Meeting) meeting;
  Map kept;              // points that something needs
  Map single;            // curves that must stay on their own
} Joiner;

static Meeting *meeting_at(Joiner *j, int point)
{
  bool fresh;
  uint32_t *slot = map_slot(&j->at, (uint64_t)point, (uint32_t)j->meeting.len, &fresh);
  if (fresh) vec_push(&j->meeting, (Meeting){0});
  return &j->meeting.data[*slot];
}

static void add_end(Joiner *j, Curve *c, int point)
{
  Meeting *at = meeting_at(j, point);
  if (at->ends < 2) at->curve[at->ends] = c;
  at->ends++;
}

static void keep_alone(Joiner *j, int curve) { map_set(&j->single, (uint64_t)tag__abs(curve), 1); }
static void keep_point(Joiner *j, int point) { map_set(&j->kept, (uint64_t)point, 1); }

// Faces that need their curves as they are, and points and curves inside faces.
static void look_at_face(Joiner *j, const Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(j->m, f, &curve, &start);
  for (size_t i = 0; i < curve.len; i++)
    if (f->type == FACE_FILLING || f->extruded_curve || f->copy_of || f->periodic_master) keep_alone(j, curve.data[i]);
  for (size_t i = 0; i < f->embedded_curves.len; i++) keep_alone(j, f->embedded_curves.data[i]);
  for (size_t i = 0; i < f->embedded_points.len; i++) keep_point(j, f->embedded_points.data[i]);
  for (int i = 0; i < f->ncorner; i++) keep_point(j, f->corner[i]);
  vec_free(&curve);
  vec_free(&start);
}

static void look_around(Joiner *j)
{
  Model *m = j->m;
  for (size_t k = 0; k < model_curves(m); k++) {
    Curve *c = model_curve_at(m, k);
    if (c->dissolved) continue;
    add_end(j, c, c->begin);
    add_end(j, c, c->end);
    if (c->periodic_master) keep_alone(j, c->periodic_master);
    if (c->copy_of) keep_alone(j, c->copy_of);
  }
  for (size_t k = 0; k < model_faces(m); k++) look_at_face(j, model_face_at(m, k));
  for (size_t k = 0; k < model_groups(m); k++) {
    const Group *g = model_group_at(m, k);
    for (size_t i = 0; g->dim == 0 && i < g->entity.len; i++) keep_point(j, tag__abs(g->entity.data[i]));
  }
}

static bool may_join(const Joiner *j, const Curve *c)
{
  return c->compound > 0 && !c->joined && !c->transfinite && !c->periodic_master && !c->copy_of && !(c->extruded_point && c->layers.n) &&
         !c->degenerate && !c->dissolved && !c->sphere && c->begin != c->end && map_get(&j->single, (uint64_t)c->tag) == NONE;
}

// The curve that goes on beyond `point` where nothing but it and c end, or NULL.
static Curve *beyond(Joiner *j, const Curve *c, int point)
{
  const Meeting *at = meeting_at(j, point);
  if (at->ends != 2 || map_get(&j->kept, (uint64_t)point) != NONE) return NULL;
  Curve *d = at->curve[0] == c ? at->curve[1] : at->curve[0];
  bool good = may_join(j, d) && d->compound == c->compound && d->reverse_mesh == c->reverse_mesh && model__same_groups(j->m, 1, c->tag, d->tag);
  return good ? d : NULL;
}

// From the curve on, forwards or backwards, as far as it goes: signed tags, in the order met. The curves are marked as joined to `leader`.
static void follow(Joiner *j, Curve *leader, bool forwards, IntVec *out)
{
  Curve *c = leader;
  int point = forwards ? c->end : c->begin;
  for (Curve *d; (d = beyond(j, c, point)); c = d) {
    bool along = (d->begin == point) == forwards;
    vec_push(out, along ? d->tag : -d->tag);
    d->joined = leader->tag;
    point = d->begin == point ? d->end : d->begin;
  }
}

// ---- the chain's shape -----------------------------------------------------------------------------------------------------
enum { DEGREE = 5, ARC_PIECES_PER_TURN = 128 };

typedef struct {
  Vec(Vec3) control;  // DEGREE + 1 for each piece, forwards
  DoubleVec knot;     // where each piece ends
} PiecesVec;

// A Bezier piece as one of degree DEGREE.
static void push_piece(PiecesVec *p, const Vec3 *b, int degree, bool backwards, double end)
{
  Vec3 x[DEGREE + 1];
  for (int i = 0; i <= degree; i++) x[i] = b[backwards ? degree - i : i];
  for (int n = degree; n < DEGREE; n++) { // raised by one
    x[n + 1] = x[n];
    for (int i = n; i > 0; i--) {
      double f = (double)i / (n + 1);
      x[i] = vec3_add(vec3_scale(f, x[i - 1]), vec3_scale(1 - f, x[i]));
    }
  }
  for (int i = 0; i <= DEGREE; i++) vec_push(&p->control, x[i]);
  vec_push(&p->knot, end);
}

// A quintic through the position and two derivatives at either end: of pieces this short it is within 1e-13 of the radius.
static void push_arc_piece(PiecesVec *p, const CurveShape *h, double t0, double t1, double end)
{
  Vec3 b[DEGREE + 1];
  double w = t1 - t0;
  for (int side = 0; side < 2; side++) {
    double t = side ? t1 : t0, sign = side ? -1 : 1;
    Vec3 r = vec3_add(vec3_scale(cos(t), h->a), vec3_scale(sin(t), h->b));
    Vec3 d = vec3_scale(w / DEGREE, vec3_sub(vec3_scale(cos(t), h->b), vec3_scale(sin(t), h->a)));
    Vec3 x = vec3_add(h->centre, r), *to = side ? b + DEGREE : b;
    int step = side ? -1 : 1;
    to[0] = x;
    to[step] = vec3_add(x, vec3_scale(sign, d));
    to[2 * step] = vec3_add(vec3_add(x, vec3_scale(2 * sign, d)), vec3_scale(-w * w / (DEGREE * (DEGREE - 1)), r));
  }
  push_piece(p, b, DEGREE, false, end);
}

// The pieces of one curve of the chain, over the parameters from .. to.
static void push_curve(PiecesVec *p, const Model *m, const Curve *c, bool backwards, double from, double to)
{
  const CurveShape *h = c->shape;
  double w = to - from;
  if (!h) {
    Vec3 b[2] = {curve__begin(m, c), curve__end(m, c)};
    push_piece(p, b, 1, backwards, to);
  } else if (h->kind == SHAPE_ARC) {
    int n = MAX((int)ceil(fabs(h->t1 - h->t0) / (2 * 3.14159265358979323846) * ARC_PIECES_PER_TURN), 1);
    double a = backwards ? h->t1 : h->t0, b = backwards ? h->t0 : h->t1;
    for (int i = 0; i < n; i++)
      push_arc_piece(p, h, a + (b - a) * i / n, a + (b - a) * (i + 1) / n, i + 1 == n ? to : from + w * (i + 1) / n);
  } else {
    for (int i = 0; i < h->npiece; i++) {
      int at = backwards ? h->npiece - 1 - i : i;
      double end = backwards ? 1 - h->knot[at] : h->knot[at + 1];
      push_piece(p, shape__control(h, at), h->degree, backwards, i + 1 == h->npiece ? to : from + w * end);
    }
  }
}

static CurveShape *chain_shape(const Model *m, const IntVec *chain)
{
  PiecesVec p = {{0}, {0}};
  double total = 0, at = 0;
  for (size_t i = 0; i < chain->len; i++) total += curve_length(m, model_curve(m, chain->data[i]));
  vec_push(&p.knot, 0);
  for (size_t i = 0; i < chain->len; i++) {
    const Curve *c = model_curve(m, chain->data[i]);
    double next = at + curve_length(m, c) / total;
    push_curve(&p, m, c, chain->data[i] < 0, at, i + 1 == chain->len ? 1 : next);
    at = next;
  }
  CurveShape *h = mem_zalloc(sizeof *h);
  h->kind = SHAPE_PIECES;
  h->begin = point__get(m, curve__from(m, chain->data[0]))->xyz;
  h->end = point__get(m, curve__to(m, vec_last(chain)))->xyz;
  h->degree = DEGREE;
  h->npiece = (int)p.knot.len - 1;
  h->knot = p.knot.data;
  h->control = p.control.data;
  return h;
}

// ---- all -----------------------------------------------------------------------------------------------------------------------
static void join(Joiner *j, Curve *leader)
{
  IntVec ahead = {0}, behind = {0}, chain = {0};
  leader->joined = leader->tag;
  follow(j, leader, true, &ahead);
  follow(j, leader, false, &behind);
  for (size_t i = behind.len; i-- > 0;) vec_push(&chain, behind.data[i]);
  vec_push(&chain, leader->tag);
  for (size_t i = 0; i < ahead.len; i++) vec_push(&chain, ahead.data[i]);
  if (chain.len > 1) {
    CurveShape *h = chain_shape(j->m, &chain);
    vec_push(&j->m->joint, ((JoinedCurve){leader->tag, leader->begin, leader->end}));
    int begin = curve__from(j->m, chain.data[0]), end = curve__to(j->m, vec_last(&chain));
    leader->begin = begin;
    leader->end = end;
    curve__release(leader);
    leader->shape = h;
  } else {
    leader->joined = 0;
  }
  vec_free(&ahead);
  vec_free(&behind);
  vec_free(&chain);
}

void model__join_curves(Model *m, Diag *diag)
{
  if (!m->ncompound[1]) return;
  Joiner j = {.m = m};
  look_around(&j);
  for (size_t k = 0; k < model_curves(m); k++) {
    Curve *c = model_curve_at(m, k);
    if (c->joined || !c->compound) continue;
    if (may_join(&j, c)) join(&j, c);
    if (!c->joined)
      diag_warning(diag, c->loc, "curve %d of a compound is meshed on its own: at its ends are other curves, points or groups that need them, "
                   "or its nodes are prescribed", c->tag);
  }
  map_free(&j.at);
  vec_free(&j.meeting);
  map_free(&j.kept);
  map_free(&j.single);
}

void model__part_curves(Model *m)
{
  if (!m->joint.len) return;
  for (size_t k = 0; k < m->joint.len; k++) {
    const JoinedCurve *was = &m->joint.data[k];
    Curve *c = table__get(&m->curve, was->tag);
    if (!c) continue;
    c->begin = was->begin;
    c->end = was->end;
    curve__release(c);
  }
  for (size_t k = 0; k < model_curves(m); k++) model_curve_at(m, k)->joined = 0;
  vec_clear(&m->joint);
  m->parted = true;
}
