// explain.c - which rule fixed the size at a place, and messages about bad sizes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "size/size_int.h"

static const char *node_type(const Node *n)
{
  return n->field ? field__type(n->field->kind)->name : "background view";
}

static void name_node(const Node *n, Str *out)
{
  if (!n->field) str_printf(out, "the background view");
  else str_printf(out, "Field[%d] (%s, line %u)", n->field->id, node_type(n), n->field->loc.line);
}

// The node that the value of node k at p really comes from: through Min, Max, Restrict, Octree and Threshold's own.
static uint32_t source_of(SizeEval *e, uint32_t k, Where w, Vec3 p)
{
  const Node *n = &e->s->node[k];
  bool picks = n->ops == &ops_min || n->ops == &ops_max || n->ops == &ops_restrict || n->ops == &ops_same;
  if (!picks) return k;
  double v = size__at(e, k, w, p);
  for (uint32_t i = 0; i < n->nin; i++) {
    double x = size__at(e, n->in[i], w, p);
    if (x == v || (x != x && v != v)) return source_of(e, n->in[i], w, p);
  }
  return k;
}

// " at (x, y, z) on curve 3"
static void name_place(const Fault *f, Str *out)
{
  static const char *const what[] = {"point", "curve", "surface"};
  str_printf(out, "at (%g, %g, %g)", f->at.x, f->at.y, f->at.z);
  if (f->where.dim >= 0 && f->where.tag > 0) str_printf(out, " on %s %d", what[f->where.dim], f->where.tag);
}

// The field that a fault comes from, or NULL, and the place of what makes its values.
static const Field *field_of_fault(SizeEval *e, const Fault *f, SrcLoc *loc)
{
  const SizeField *s = e->s;
  const Node *n = s->root == NONE ? NULL : &s->node[source_of(e, s->root, f->where, f->at)];
  if (!n || !n->field) return NULL;
  *loc = n->field->kind == FIELD_MATHEVAL ? field__value(n->field, "F")->loc : n->field->loc;
  return n->field;
}

bool size_eval_report(SizeEval *e, Diag *diag)
{
  if (!e->fault.set) return false;
  e->fault.set = false;
  double v = e->fault.value;
  Str where = {0};
  name_place(&e->fault, &where);
  SrcLoc loc;
  const Field *f = field_of_fault(e, &e->fault, &loc);
  const char *type = f ? field__type(f->kind)->name : "", *option = f && f->kind == FIELD_MATHEVAL ? " F" : "";
  if (!f)
    diag_error(diag, NO_LOC, "the size %g %s is not positive", v, str_text(&where));
  else if (v != v)
    diag_error(diag, loc, "field %d (%s)%s is not a number %s", f->id, type, option, str_text(&where));
  else
    diag_error(diag, loc, "field %d (%s)%s gives the size %g %s; sizes must be positive (Mesh.MeshSizeMin can bound them)", f->id, type,
               option, v, str_text(&where));
  str_free(&where);
  return true;
}

bool size_eval_warn(SizeEval *e, Diag *diag)
{
  if (!e->infinite.set) return false;
  e->infinite.set = false;
  Str where = {0};
  name_place(&e->infinite, &where);
  SrcLoc loc;
  const Field *f = field_of_fault(e, &e->infinite, &loc);
  if (f)
    diag_warning(diag, loc, "field %d (%s)%s is infinite %s, as by a division by zero: it asks for no size there", f->id,
                 field__type(f->kind)->name, f->kind == FIELD_MATHEVAL ? " F" : "", str_text(&where));
  str_free(&where);
  return f != NULL;
}

// ---- explanations ------------------------------------------------------------------------------------------------------

static void explain_node(SizeEval *e, uint32_t k, Where w, Vec3 p, int depth, bool decides, Str *out)
{
  const Node *n = &e->s->node[k];
  double v = size__at(e, k, w, p);
  str_printf(out, "%*s", 2 * depth, "");
  name_node(n, out);
  str_printf(out, " = ");
  if (v >= NO_SIZE) str_printf(out, "no size");
  else str_printf(out, "%.6g", v);
  if (n->thresholds && n->thresholds == n->users && v >= n->far) str_printf(out, " or more");
  if (n->field && n->field->kind == FIELD_MATHEVAL) str_printf(out, "  [%s]", field__value(n->field, "F")->text);
  str_printf(out, "%s\n", decides ? "  <- decides" : "");
  if (depth > 40) return;
  bool picks = n->ops == &ops_min || n->ops == &ops_max, found = false;
  for (uint32_t i = 0; i < n->nin; i++) {
    bool this = decides && !found && (!picks || size__at(e, n->in[i], w, p) == v);
    found = found || (picks && this);
    explain_node(e, n->in[i], w, p, depth + 1, this, out);
  }
}

// Crossings of the ray to the right of q with the loops of f, in its plane.
static int count_crossings(const Model *m, const Face *f, Vec2 q)
{
  enum { CHORDS = 32 };
  int n = 0;
  for (int i = 0; i < f->nloop; i++) {
    const Loop *loop = model_loop(m, f->loop[i]);
    for (int k = 0; loop && k < loop->ncurve; k++) {
      const Curve *c = model_curve(m, loop->curve[k]);
      if (!c) continue;
      Vec2 a = face_to_plane(f, curve_point(m, c, 0));
      for (int j = 1; j <= CHORDS; j++) {
        Vec2 b = face_to_plane(f, curve_point(m, c, (double)j / CHORDS));
        if ((a.y > q.y) != (b.y > q.y) && a.x + (b.x - a.x) * ((q.y - a.y) / (b.y - a.y)) > q.x) n++;
        a = b;
      }
    }
  }
  return n;
}

const Face *size_face_at(const Model *m, Vec3 p)
{
  for (size_t k = 0; k < model_faces(m); k++) {
    const Face *f = model_face_at(m, k);
    if (f->planar && count_crossings(m, f, face_to_plane(f, p)) % 2) return f;
  }
  return NULL;
}

static const char *bound_in_force(const SizeField *s, double wish)
{
  if (wish < s->lo) return "Mesh.MeshSizeMin";
  return wish > s->hi ? "Mesh.MeshSizeMax" : NULL;
}

void size_explain(SizeEval *e, const Face *f, Vec3 p, Str *out)
{
  const SizeField *s = e->s;
  Where w = {f ? 2 : -1, f ? f->tag : 0};
  double field = s->root == NONE ? NO_SIZE : size__at(e, s->root, w, p), wish = fmin(s->diagonal, field);
  const char *bound = bound_in_force(s, wish);
  str_printf(out, "size %.6g at (%g, %g)", fmin(fmax(wish, s->lo), s->hi) * s->factor, p.x, p.y);
  if (f) str_printf(out, " in surface %d", f->tag);
  str_printf(out, "\n");
  str_printf(out, "  diagonal of the model = %.6g%s\n", s->diagonal, !bound && !(field < s->diagonal) ? "  <- decides" : "");
  if (s->root != NONE) explain_node(e, s->root, w, p, 1, !bound && field < s->diagonal, out);
  else str_printf(out, "  no background field\n");
  if (s->lo > 0) str_printf(out, "  Mesh.MeshSizeMin = %.6g%s\n", s->lo, wish < s->lo ? "  <- decides" : "");
  if (s->hi < LC_UNSET) str_printf(out, "  Mesh.MeshSizeMax = %.6g%s\n", s->hi, wish > s->hi ? "  <- decides" : "");
  if (s->factor != 1) str_printf(out, "  times Mesh.MeshSizeFactor = %.6g\n", s->factor);
}

// The ends of a curve (NULL: unknown) with their sizes.
static void name_points(const SizeField *s, const Curve *c, Str *out)
{
  str_printf(out, "the sizes of points");
  for (int i = 0; c && i < 2; i++) {
    const Point *p = model_point(s->model, i ? c->end : c->begin);
    str_printf(out, "%s %d", i ? " and" : "", p->tag);
    if (p->lc < LC_UNSET) str_printf(out, " (%g)", p->lc);
    else str_printf(out, " (none given)");
  }
}

void size_responsible(SizeEval *e, const Face *f, const Curve *c, Vec3 p, Str *out)
{
  const SizeField *s = e->s;
  Where w = {f ? 2 : -1, f ? f->tag : 0};
  double field = s->root == NONE ? NO_SIZE : size__at(e, s->root, w, p), wish = fmin(s->diagonal, field);
  const char *bound = bound_in_force(s, wish);
  if (bound) str_printf(out, "%s", bound);
  else if (s->root != NONE && field < s->diagonal) name_node(&s->node[source_of(e, s->root, w, p)], out);
  else if (s->from_points) name_points(s, c, out);
  else str_printf(out, "the model's diagonal");
  if (s->factor < 1) str_printf(out, " times Mesh.MeshSizeFactor = %g", s->factor);
}
