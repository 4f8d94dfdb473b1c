// attribute.c - how entities are to be meshed
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_int.h"

// Entities of a list that exist; one warning a statement names the first that does not.
typedef struct {
  const Model *m;
  Kind kind;
  const char *what;
  SrcLoc loc;
  Diag *diag;
  bool warned;
} List;

static void *member(List *l, int tag)
{
  void *item = table__get(model__table(l->m, l->kind), tag__abs(tag));
  if (item || l->warned || model__refused(l->m, l->kind, tag)) return item;
  l->warned = true;
  diag_warning(l->diag, l->loc, "%s: there is no %s %d", l->what, kind__name(l->kind), tag__abs(tag));
  return NULL;
}

void model_set_size(Model *m, const int *point, size_t n, double lc)
{
  for (size_t i = 0; i < n; i++) {
    Point *p = model_point(m, point[i]);
    if (p) p->lc = lc > 0 && lc < LC_UNSET ? lc : LC_UNSET;
  }
}

bool model_set_transfinite_curve(Model *m, const int *curve, size_t n, int nodes, TransfiniteLaw law, double coef, SrcLoc loc,
                                 Diag *diag)
{
  List l = {m, KIND_CURVE, "Transfinite Curve", loc, diag, false};
  for (size_t i = 0; i < n; i++) {
    Curve *c = member(&l, curve[i]);
    if (!c) continue;
    c->transfinite = MAX(nodes, 2);
    c->law = law;
    c->coef = coef;
    if (curve[i] < 0 && law == LAW_PROGRESSION && coef > 0) c->coef = 1 / coef;
    if (curve[i] < 0 && law == LAW_BETA) c->coef = -coef;
  }
  return !l.warned;
}

bool model_set_transfinite_face(Model *m, const int *face, size_t n, const int *corner, size_t ncorner,
                                TransfiniteArrangement arrangement, SrcLoc loc, Diag *diag)
{
  if (ncorner && ncorner != 3 && ncorner != 4) {
    diag_error(diag, loc, "Transfinite Surface needs 3 or 4 corner points, not %zu", ncorner);
    return false;
  }
  List l = {m, KIND_FACE, "Transfinite Surface", loc, diag, false};
  List points = {m, KIND_POINT, "Transfinite Surface", loc, diag, false};
  for (size_t k = 0; k < ncorner; k++)
    if (!member(&points, corner[k])) return false;
  for (size_t i = 0; i < n; i++) {
    Face *f = member(&l, face[i]);
    if (!f) continue;
    f->transfinite = true;
    f->arrangement = arrangement;
    if (f->ncorner && !ncorner) m->ncorners--;
    if (!f->ncorner && ncorner) m->ncorners++;
    f->ncorner = (int)ncorner;
    for (size_t k = 0; k < ncorner; k++) f->corner[k] = tag__abs(corner[k]);
  }
  return !l.warned;
}

bool model_set_recombine(Model *m, const int *face, size_t n, double angle, SrcLoc loc, Diag *diag)
{
  List l = {m, KIND_FACE, "Recombine Surface", loc, diag, false};
  for (size_t i = 0; i < n; i++) {
    Face *f = member(&l, face[i]);
    if (!f) continue;
    f->recombine = true;
    f->recombine_angle = angle;
  }
  return !l.warned;
}

bool model_set_smoother(Model *m, const int *face, size_t n, int iterations, SrcLoc loc, Diag *diag)
{
  List l = {m, KIND_FACE, "Smoother Surface", loc, diag, false};
  for (size_t i = 0; i < n; i++) {
    Face *f = member(&l, face[i]);
    if (f) f->smoother = MAX(iterations, 0);
  }
  return !l.warned;
}

bool model_set_algorithm(Model *m, const int *face, size_t n, int algorithm, SrcLoc loc, Diag *diag)
{
  List l = {m, KIND_FACE, "MeshAlgorithm Surface", loc, diag, false};
  for (size_t i = 0; i < n; i++) {
    Face *f = member(&l, face[i]);
    if (f) f->algorithm = algorithm;
  }
  return !l.warned;
}

bool model_set_size_from_boundary(Model *m, const int *face, size_t n, int value, SrcLoc loc, Diag *diag)
{
  List l = {m, KIND_FACE, "MeshSizeFromBoundary Surface", loc, diag, false};
  for (size_t i = 0; i < n; i++) {
    Face *f = member(&l, face[i]);
    if (f) f->size_from_boundary = value;
  }
  return !l.warned;
}

bool model_set_reverse(Model *m, int dim, const int *tag, size_t n, SrcLoc loc, Diag *diag)
{
  List l = {m, dim__kind(dim), "ReverseMesh", loc, diag, false};
  for (size_t i = 0; i < n; i++) {
    void *item = member(&l, tag[i]);
    if (item && dim == 1) ((Curve *)item)->reverse_mesh = true;
    if (item && dim == 2) ((Face *)item)->reverse_mesh = true;
  }
  return !l.warned;
}

bool model_set_degenerate(Model *m, const int *curve, size_t n, SrcLoc loc, Diag *diag)
{
  List l = {m, KIND_CURVE, "Degenerated Curve", loc, diag, false};
  for (size_t i = 0; i < n; i++) {
    Curve *c = member(&l, curve[i]);
    if (c) c->degenerate = true;
  }
  return !l.warned;
}

bool model_set_compound(Model *m, int dim, const int *tag, size_t n, SrcLoc loc, Diag *diag)
{
  List l = {m, dim__kind(dim), dim == 1 ? "Compound Curve" : "Compound Surface", loc, diag, false};
  if (dim != 1 && dim != 2) return true;
  int index = ++m->ncompound[dim];
  for (size_t i = 0; i < n; i++) {
    void *item = member(&l, tag[i]);
    if (item && dim == 1) ((Curve *)item)->compound = index;
    if (item && dim == 2) ((Face *)item)->compound = index;
  }
  return !l.warned;
}

bool model_set_periodic_curves(Model *m, const int *slave, const int *master, size_t n, const Affine *affine, SrcLoc loc,
                               Diag *diag)
{
  List l = {m, KIND_CURVE, "Periodic Curve", loc, diag, false};
  const double *map = affine ? arena_dup(&m->arena, affine->m, sizeof affine->m) : NULL;
  for (size_t i = 0; i < n; i++) {
    Curve *c = member(&l, slave[i]);
    if (!c || !member(&l, master[i])) continue;
    if (tag__abs(slave[i]) == tag__abs(master[i])) {
      if (!affine) diag_warning(diag, loc, "curve %d cannot be periodic with itself: it is left as it is", c->tag);
      continue; // on the axis of a rotation, say
    }
    if (!c->periodic_master) m->nperiodic++;
    c->periodic_master = slave[i] < 0 ? -master[i] : master[i];
    c->affine = map;
  }
  return !l.warned;
}

// Does the map take the control points of `o` to those of `c`, in order or (backwards) against it?
static bool is_image(const Model *m, const Affine *a, const Curve *c, const Curve *o, bool backwards, double tolerance)
{
  if (c->type != o->type || c->npoint != o->npoint) return false;
  for (int i = 0; i < c->npoint; i++) {
    int k = !backwards                                       ? i
            : c->type == CURVE_ELLIPSE && (i == 1 || i == 2) ? i
                                                             : c->npoint - 1 - i;
    Vec3 p = affine_apply(a, model_point(m, o->point[k])->xyz);
    if (vec3_distance(p, model_point(m, c->point[i])->xyz) > tolerance) return false;
  }
  return true;
}

// Make the curves of f periodic with those of its master that the map takes to them; what has no image is left alone.
static bool pair_curves(Model *m, const Face *f, const Affine *affine, SrcLoc loc, Diag *diag)
{
  IntVec mine = {0}, theirs = {0}, start = {0}, slave = {0}, master = {0};
  double tolerance = 1e-6 * vec3_distance(m->extent.lo, m->extent.hi);
  face_boundary(m, f, &mine, &start);
  face_boundary(m, model_face(m, f->periodic_master), &theirs, &start);
  for (size_t i = 0; i < mine.len; i++) {
    const Curve *c = model_curve(m, mine.data[i]);
    for (size_t k = 0; k < theirs.len && !c->periodic_master; k++) {
      const Curve *o = model_curve(m, theirs.data[k]);
      bool same = is_image(m, affine, c, o, false, tolerance);
      if (o == c || (!same && !is_image(m, affine, c, o, true, tolerance))) continue;
      vec_push(&slave, c->tag);
      vec_push(&master, same ? o->tag : -o->tag);
      break;
    }
  }
  bool good = model_set_periodic_curves(m, slave.data, master.data, slave.len, affine, loc, diag);
  vec_free(&mine);
  vec_free(&theirs);
  vec_free(&start);
  vec_free(&slave);
  vec_free(&master);
  return good;
}

bool model_set_periodic_face(Model *m, int slave, int master, const int *slave_edge, const int *master_edge, size_t n,
                             const Affine *affine, SrcLoc loc, Diag *diag)
{
  List l = {m, KIND_FACE, "Periodic Surface", loc, diag, false};
  Face *f = member(&l, slave);
  if (!f || !member(&l, master)) return false;
  if (tag__abs(slave) == tag__abs(master)) return model_set_periodic_curves(m, slave_edge, master_edge, n, affine, loc, diag);
  f->periodic_master = tag__abs(master);
  f->copy_map = affine ? arena_dup(&m->arena, affine->m, sizeof affine->m) : NULL;
  m->ncopied++;
  if (affine && !n) return pair_curves(m, f, affine, loc, diag);
  return model_set_periodic_curves(m, slave_edge, master_edge, n, affine, loc, diag);
}

bool model_embed(Model *m, int dim, const int *tag, size_t n, int face, SrcLoc loc, Diag *diag)
{
  Face *f = model_face(m, face);
  if (!f) {
    if (!model__refused(m, KIND_FACE, face))
      diag_error(diag, loc, "cannot embed in surface %d: it does not exist", tag__abs(face));
    return false;
  }
  Kind k = dim__kind(dim);
  if (f->embedded_points.len + f->embedded_curves.len == 0 && n) m->nembedded++;
  for (size_t i = 0; i < n; i++) {
    int t = tag__abs(tag[i]);
    if (!model_has(m, dim, t)) {
      if (!model__refused(m, k, t))
        diag_error(diag, loc, "cannot embed %s %d in surface %d: it does not exist", kind__name(k), t, f->tag);
      return false;
    }
    if (dim == 0)
      vec_push(&f->embedded_points, t);
    else
      vec_push(&f->embedded_curves, t);
  }
  return true;
}

void model_delete_embedded(Model *m, const int *face, size_t n)
{
  for (size_t i = 0; i < n; i++) {
    Face *f = model_face(m, face[i]);
    if (!f) continue;
    if (f->embedded_points.len + f->embedded_curves.len) m->nembedded--;
    vec_clear(&f->embedded_points);
    vec_clear(&f->embedded_curves);
  }
}
