// run_define.c - entities and physical groups
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

// Where the messages of a statement go whose arguments were wrong: the model shall remember the refusal, the
// user has been told already.
static Diag *sink(Script *s, int faults, Diag **quiet)
{
  *quiet = s->faults > faults ? diag_child(s->diag) : NULL;
  return *quiet ? *quiet : s->diag;
}

bool eval_tag(Script *s, const Node *n, int *tag)
{
  int faults = s->faults;
  *tag = eval_int(s, n);
  if (s->faults > faults) return false;
  if (*tag >= 0) return true;
  script__error(s, n->loc, "a tag must be positive, not %d", *tag);
  return false;
}

static void define_point(Script *s, const Node *n, int tag)
{
  const Node *list = n->kid[1];
  double c[5] = {0, 0, 0, 0, 0};
  size_t count = 0;
  bool plain = list->kind == NODE_LIST && list->n <= 5;
  for (uint32_t i = 0; plain && i < list->n; i++) plain = !node_is_list(list->kid[i]);
  if (plain) {
    for (count = 0; count < list->n; count++) c[count] = eval_number(s, list->kid[count]);
  } else {
    DoubleVec *v = script__take(s);
    eval_list(s, list, v);
    count = v->len;
    if (count) memcpy(c, v->data, MIN(count, ARRAY_LEN(c)) * sizeof c[0]);
    script__give(s, v);
  }
  if (count < 3 || count > 5) {
    script__error(s, list->loc,
                  "a point needs 3 coordinates {x, y, z}, or 4 numbers with the mesh size; %zu given", count);
    if (count > 5) return;
  }
  if (count > 3 && c[3] < 0) diag_warning(s->diag, list->loc, "the mesh size %g is negative: the point has none", c[3]);
  double f = s->options->Geometry_ScalingFactor;
  model_add_point(s->model, tag, (Vec3){f * c[0], f * c[1], f * c[2]}, count > 3 ? f * c[3] : 0, n->loc,
                  s->diag);
}

static CurveType curve_type(uint32_t word)
{
  switch (word) {
  case KW_Line: return CURVE_LINE;
  case KW_Circle: return CURVE_CIRCLE;
  case KW_Ellipse: return CURVE_ELLIPSE;
  case KW_Spline: return CURVE_SPLINE;
  case KW_BSpline: return CURVE_BSPLINE;
  case KW_Bezier: return CURVE_BEZIER;
  case KW_Nurbs: return CURVE_NURBS;
  default: UNREACHABLE();
  }
}

static void define_curve(Script *s, const Node *n, int tag)
{
  int faults = s->faults;
  IntVec points = {0};
  DoubleVec knots = {0};
  Vec3 plane;
  const Vec3 *normal = NULL;
  Diag *quiet;
  eval_ints(s, n->kid[1], n->op ? 1 : 0, &points);
  if (n->op) { // Compound Spline
    int samples = n->n > 2 && n->kid[2] ? eval_int(s, n->kid[2]) : 5;
    Diag *diag = sink(s, faults, &quiet);
    model_add_compound_spline(s->model, curve_type(n->word), tag, points.data, points.len, samples, n->loc,
                              diag);
  } else {
    if (n->word == KW_Nurbs) {
      if (n->n < 4)
        script__error(s, n->loc, "Nurbs needs 'Knots {..} Order n'");
      else
        eval_list(s, n->kid[2], &knots);
    } else if (n->n > 2) {
      plane = eval_vector(s, n->kid[2]);
      normal = &plane;
    }
    Diag *diag = sink(s, faults, &quiet);
    model_add_curve(s->model, curve_type(n->word), tag, points.data, points.len, normal, knots.data,
                    knots.len, n->loc, diag);
  }
  diag_free(quiet);
  vec_free(&points);
  vec_free(&knots);
}

static bool fills_plane(Model *m, int loop)
{
  const Loop *l = model_loop(m, loop);
  return model_settings(m)->opencascade && l && l->ncurve != 3 && l->ncurve != 4;
}

static void define_surface(Script *s, const Node *n, int tag)
{
  int faults = s->faults;
  IntVec tags = {0};
  Diag *quiet;
  eval_ints(s, n->kid[1], -1, &tags);
  Diag *diag = sink(s, faults, &quiet);
  switch (n->word) {
  case KW_Wire:
  case KW_Loop:
    if (n->op == 1)
      model_add_loop(s->model, tag, tags.data, tags.len, n->loc, diag);
    else
      model_add_surface_loop(s->model, tag, tags.data, tags.len, n->loc, diag);
    break;
  case KW_Plane: model_add_face(s->model, FACE_PLANE, tag, tags.data, tags.len, n->loc, diag); break;
  case KW_Surface:
    if (n->n > 2 && !model_has_polar_sphere(s->model))
      diag_warning(s->diag, n->loc, "'In Sphere' is not supported: surface %d is filled between its curves",
                   tag);
    // with holes it can only be plane; OpenCASCADE fills any loop
    model_add_face(s->model, tags.len > 1 || (tags.len && fills_plane(s->model, tags.data[0])) ? FACE_PLANE : FACE_FILLING, tag, tags.data, tags.len, n->loc,
                   diag);
    break;
  case KW_Volume:
    if (!s->volumes_noted) log_info(s->diag, "volumes are kept for their faces, and not meshed");
    s->volumes_noted = true;
    model_add_volume(s->model, tag, tags.data, tags.len, n->loc, diag);
    break;
  default: UNREACHABLE();
  }
  diag_free(quiet);
  vec_free(&tags);
}

// ---- OpenCASCADE's flat shapes, made of points, lines and arcs
// ---------------------------------------------

// Rectangle(n) = {x, y, z, dx, dy [, radius of the corners]}
static void define_rectangle(Script *s, const Node *n, int tag, const DoubleVec *v)
{
  if (v->len < 5 || v->len > 6) {
    script__error(
        s, n->loc,
        "a Rectangle needs {x, y, z, dx, dy} and perhaps the radius of its corners; %zu numbers given",
        v->len);
    return;
  }
  model_add_rectangle(s->model, tag, (Vec3){v->data[0], v->data[1], v->data[2]}, v->data[3], v->data[4],
                      v->len > 5 ? v->data[5] : 0, n->loc, s->diag);
}

// Disk(n) = {x, y, z, rx [, ry]}
static void define_disk(Script *s, const Node *n, int tag, const DoubleVec *v)
{
  if (v->len < 4 || v->len > 5) {
    script__error(s, n->loc, "a Disk needs {x, y, z, rx} and perhaps ry; %zu numbers given", v->len);
    return;
  }
  model_add_disk(s->model, tag, (Vec3){v->data[0], v->data[1], v->data[2]}, v->data[3], v->len > 4 ? v->data[4] : v->data[3],
                 n->loc, s->diag);
}

static bool needs_opencascade(Script *s, const Node *n)
{
  if (model_settings(s->model)->opencascade) return true;
  script__error(s, n->loc, "%s needs SetFactory(\"OpenCASCADE\"); first", words_text(&s->words, n->word));
  return false;
}

static void define_flat(Script *s, const Node *n, int tag)
{
  if (!needs_opencascade(s, n)) return;
  int faults = s->faults;
  DoubleVec *v = script__take(s);
  eval_list(s, n->kid[1], v);
  if (s->faults == faults) {
    if (n->word == KW_Rectangle)
      define_rectangle(s, n, tag, v);
    else
      define_disk(s, n, tag, v);
  }
  script__give(s, v);
}

// Circle(n) = {x, y, z, r [, from, to]} and Ellipse(n) = {x, y, z, rx, ry [, from, to]} of OpenCASCADE.
static void define_centred_arc(Script *s, const Node *n, int tag)
{
  int faults = s->faults;
  DoubleVec *v = script__take(s);
  eval_list(s, n->kid[1], v);
  size_t radii = n->word == KW_Circle ? 1 : 2;
  if (s->faults == faults && v->len != 3 + radii && v->len != 5 + radii) {
    script__error(s, n->loc, "%s needs {x, y, z, %s} and perhaps two angles; %zu numbers given", words_text(&s->words, n->word),
                  radii == 1 ? "r" : "rx, ry", v->len);
  } else if (s->faults == faults) {
    const double *x = v->data;
    bool angles = v->len > 3 + radii;
    double full = 2 * 3.14159265358979323846, from = angles ? x[3 + radii] : 0, to = angles ? x[4 + radii] : full;
    bool backwards = radii == 1 && !(from == 0 && to == full); // as OpenCASCADE's circle arcs by angles run
    model_add_arc(s->model, tag, (Vec3){x[0], x[1], x[2]}, x[3], x[2 + radii], from, to, backwards, n->loc, s->diag);
  }
  script__give(s, v);
}

static void define_polar_sphere(Script *s, const Node *n, int tag)
{
  int faults = s->faults;
  IntVec points = {0};
  eval_ints(s, n->kid[1], 0, &points);
  if (s->faults == faults && points.len != 2)
    script__error(s, n->loc, "PolarSphere needs two points {centre, pole}; %zu given", points.len);
  else if (s->faults == faults)
    model_set_polar_sphere(s->model, tag, points.data[0], points.data[1], n->loc, s->diag);
  vec_free(&points);
}

void run_define(Script *s, const Node *n)
{
  int tag;
  if (!eval_tag(s, n->kid[0], &tag)) return;
  if (!script__charge(s, COST_ENTITY, n->loc)) return;
  switch (n->word) {
  case KW_Point: define_point(s, n, tag); return;
  case KW_Circle:
  case KW_Ellipse: {
    uint32_t given = n->kid[1]->kind == NODE_LIST ? n->kid[1]->n : 0;
    if (model_settings(s->model)->opencascade && (n->word == KW_Circle ? given >= 4 : given >= 5)) {
      define_centred_arc(s, n, tag);
      return;
    }
    define_curve(s, n, tag);
    return;
  }
  case KW_Line:
  case KW_Spline:
  case KW_BSpline:
  case KW_Bezier:
  case KW_Nurbs: define_curve(s, n, tag); return;
  case KW_Rectangle:
  case KW_Disk: define_flat(s, n, tag); return;
  case KW_PolarSphere: define_polar_sphere(s, n, tag); return;
  case KW_Wire:
    if (needs_opencascade(s, n)) define_surface(s, n, tag);
    return;
  default: define_surface(s, n, tag);
  }
}

// ---- physical groups ---------------------------------------------

void run_physical(Script *s, const Node *n)
{
  int faults = s->faults, tag = -1, dim = n->op;
  const char *name = NULL;
  if (eval_is_text(s, n->kid[0])) {
    name = eval_text(s, n->kid[0]);
    if (n->kid[1]) tag = eval_int(s, n->kid[1]);
  } else {
    tag = eval_int(s, n->kid[0]);
    if (n->kid[1])
      script__error(s, n->kid[1]->loc,
                    "a physical group is given by number, by name, or by \"name\", number");
  }
  if (s->faults == faults && tag < 0 && !(name && !n->kid[1])) {
    script__error(s, n->kid[0]->loc, "a tag must be positive, not %d", tag);
    return;
  }
  IntVec tags = {0};
  eval_ints(s, n->kid[2], dim, &tags);
  static const GroupOp ops[] = {GROUP_SET, GROUP_ADD, GROUP_REMOVE};
  if (s->faults == faults && script__charge(s, COST_GROUP, n->loc))
    model_group_edit(s->model, dim, tag, name, ops[n->flags], tags.data, tags.len, n->loc, s->diag);
  vec_free(&tags);
}
