// run_shape.c - lists of shapes, and the commands on them
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

void eval_shapes(Script *s, const Node *shapes, ShapeVec *out)
{
  IntVec tags = {0};
  for (uint32_t i = 0; i < shapes->n; i++) {
    const Node *k = shapes->kid[i];
    if (k->kind != NODE_SHAPE) {
      eval_command(s, k, out);
      continue;
    }
    int dim = k->op;
    vec_clear(&tags);
    if (k->flags & LIST_PHYSICAL) {
      IntVec groups = {0};
      if (k->kid[0]->kind == NODE_ALL)
        for (size_t g = 0; g < model_groups(s->model); g++) {
          const Group *group = model_group_at(s->model, g);
          if (group->dim == dim) vec_push(&groups, group->tag);
        }
      else
        eval_ints(s, k->kid[0], -1, &groups);
      for (size_t g = 0; g < groups.len; g++)
        if (!model_group_members(s->model, dim, groups.data[g], &tags))
          script__error(s, k->loc, "there is no physical group %d of this dimension", groups.data[g]);
      vec_free(&groups);
    } else {
      eval_ints(s, k->kid[0], dim, &tags);
    }
    for (size_t t = 0; t < tags.len; t++) vec_push(out, ((Shape){dim, tags.data[t]}));
  }
  vec_free(&tags);
}

// ---- transformations ---------------------------------------------

static bool affine_of_list(Script *s, const Node *n, Affine *a)
{
  DoubleVec *v = script__take(s);
  eval_list(s, n, v);
  bool ok = v->len == 12 || v->len == 16;
  if (ok) {
    *a = affine_translation((Vec3){0, 0, 0});
    memcpy(a->m, v->data, 12 * sizeof(double));
  } else {
    script__error(s, n->loc, "an affine map needs 12 or 16 numbers, row by row; %zu given", v->len);
  }
  script__give(s, v);
  return ok;
}

static bool transform_map(Script *s, const Node *n, Affine *a)
{
  int faults = s->faults;
  switch (n->word) {
  case KW_Translate: *a = affine_translation(eval_vector(s, n->kid[0])); break;
  case KW_Rotate: {
    Vec3 axis = eval_vector(s, n->kid[0]), centre = eval_vector(s, n->kid[1]);
    double angle = eval_number(s, n->kid[2]);
    if (s->faults == faults && vec3_length(axis) == 0)
      script__error(s, n->kid[0]->loc, "the axis of a rotation cannot be {0, 0, 0}");
    else
      *a = affine_rotation(axis, centre, angle);
    break;
  }
  case KW_Symmetry: {
    DoubleVec *v = script__take(s);
    eval_list(s, n->kid[0], v);
    if (v->len != 4)
      script__error(s, n->kid[0]->loc, "a plane of symmetry needs 4 numbers {a, b, c, d}; %zu given", v->len);
    else if (v->data[0] == 0 && v->data[1] == 0 && v->data[2] == 0)
      script__error(s, n->kid[0]->loc, "the normal of a plane of symmetry cannot be {0, 0, 0}");
    else
      *a = affine_symmetry(v->data[0], v->data[1], v->data[2], v->data[3]);
    script__give(s, v);
    break;
  }
  case KW_Dilate: {
    Vec3 centre = eval_vector(s, n->kid[0]), factor;
    if (node_is_list(n->kid[1])) {
      factor = eval_vector(s, n->kid[1]);
    } else {
      double f = eval_number(s, n->kid[1]);
      factor = (Vec3){f, f, f};
    }
    *a = affine_dilation(centre, factor);
    break;
  }
  case KW_Affine: affine_of_list(s, n->kid[0], a); break;
  default: UNREACHABLE();
  }
  return s->faults == faults;
}

static bool charge_shapes(Script *s, size_t n, SrcLoc loc)
{
  return script__charge(s, (uint64_t)n * 2 * COST_ENTITY, loc);
}

static void transform(Script *s, const Node *n, ShapeVec *out)
{
  int faults = s->faults;
  Affine map;
  if (n->word != KW_Duplicata && !transform_map(s, n, &map)) return;
  ShapeVec shapes = {0};
  eval_shapes(s, n->kid[3], &shapes);
  if (s->faults == faults && charge_shapes(s, shapes.len, n->loc)) {
    if (n->word == KW_Duplicata) {
      model_duplicate(s->model, shapes.data, shapes.len, out, n->loc, s->diag);
    } else if (model_transform(s->model, shapes.data, shapes.len, &map, n->loc, s->diag)) {
      for (size_t i = 0; i < shapes.len; i++) vec_push(out, shapes.data[i]);
    }
  }
  vec_free(&shapes);
}

// ---- extrusion ---------------------------------------------

// Layers{n} or Layers{{n..},{h..}} into the arrays given, which must outlive *layers.
static bool eval_layers(Script *s, const Node *n, IntVec *count, DoubleVec *height, Layers *layers)
{
  eval_ints(s, n->kid[0], -1, count);
  if (n->kid[1])
    eval_list(s, n->kid[1], height);
  else if (count->len == 1)
    vec_push(height, 1);
  if (count->len != height->len) {
    script__error(s, n->loc, "%zu numbers of layers, but %zu heights", count->len, height->len);
    return false;
  }
  for (size_t i = 0; i < count->len; i++)
    if (count->data[i] < 0 || count->data[i] > LIMIT_LIST) {
      script__error(s, n->loc, "%d layers are not possible", count->data[i]);
      return false;
    }
  layers->n = count->len == 1 && count->data[0] == 0 ? 0 : (int)count->len; // 0 layers: as if not given
  layers->count = count->data;
  layers->height = height->data;
  return true;
}

static void note_volumes(Script *s)
{
  if (s->volumes_noted) return;
  s->volumes_noted = true;
  log_info(s->diag, "volumes are kept for their faces, and not meshed");
}

static void extrude(Script *s, const Node *n, ShapeVec *out)
{
  int faults = s->faults;
  Sweep sweep = {.translate = n->op & 1, .rotate = n->op & 2};
  if (n->kid[0]) sweep.shift = eval_vector(s, n->kid[0]);
  if (sweep.rotate) {
    sweep.axis = eval_vector(s, n->kid[1]);
    sweep.centre = eval_vector(s, n->kid[2]);
    sweep.angle = eval_number(s, n->kid[3]);
  }
  IntVec count = {0};
  DoubleVec height = {0};
  ShapeVec shapes = {0};
  eval_shapes(s, n->kid[4], &shapes);
  bool ok = true;
  if (n->kid[5]) ok = eval_layers(s, n->kid[5], &count, &height, &sweep.layers);
  sweep.layers.recombine = n->kid[6] && eval_number(s, n->kid[6]) != 0;
  for (size_t i = 0; i < shapes.len; i++)
    if (shapes.data[i].dim == 2) note_volumes(s);
  if (ok && s->faults == faults && charge_shapes(s, 8 * shapes.len, n->loc))
    if (!model_extrude(s->model, shapes.data, shapes.len, &sweep, out, n->loc, s->diag)) s->faults++;
  vec_free(&shapes);
  vec_free(&count);
  vec_free(&height);
}

// ---- queries ---------------------------------------------

static void boundary(Script *s, const Node *n, ShapeVec *out)
{
  ShapeVec shapes = {0};
  eval_shapes(s, n->kid[0], &shapes);
  bool combined = n->word == KW_CombinedBoundary || n->word == KW_OrientedCombinedBoundary;
  bool oriented = n->word == KW_OrientedBoundary || n->word == KW_OrientedCombinedBoundary;
  bool ok = n->word == KW_PointsOf
                ? model_points_of(s->model, shapes.data, shapes.len, out, n->loc, s->diag)
                : model_boundary(s->model, shapes.data, shapes.len, combined, oriented, out, n->loc, s->diag);
  if (!ok) s->faults++;
  script__charge(s, shapes.len, n->loc);
  vec_free(&shapes);
}

static void split(Script *s, const Node *n, ShapeVec *out)
{
  IntVec curve = {0}, point = {0}, made = {0};
  eval_ints(s, n->kid[0], 1, &curve);
  eval_ints(s, n->kid[1], 0, &point);
  for (size_t i = 0; i < curve.len; i++)
    model_split_curve(s->model, curve.data[i], point.data, point.len, &made, n->loc, s->diag);
  for (size_t i = 0; i < made.len; i++) vec_push(out, ((Shape){1, made.data[i]}));
  vec_free(&curve);
  vec_free(&point);
  vec_free(&made);
}

static BooleanOp boolean_op(uint32_t word)
{
  switch (word) {
  case KW_BooleanUnion: return BOOLEAN_UNION;
  case KW_BooleanIntersection: return BOOLEAN_INTERSECTION;
  case KW_BooleanDifference: return BOOLEAN_DIFFERENCE;
  case KW_BooleanFragments: return BOOLEAN_FRAGMENTS;
  default: UNREACHABLE();
  }
}

static void boolean(Script *s, const Node *n, ShapeVec *out)
{
  if (!model_settings(s->model)->opencascade) {
    script__error(s, n->loc, "%s needs SetFactory(\"OpenCASCADE\"); first", words_text(&s->words, n->word));
    return;
  }
  int faults = s->faults, tag = -1;
  if (n->kid[0] && !eval_tag(s, n->kid[0], &tag)) return;
  ShapeVec object = {0}, tool = {0};
  eval_shapes(s, n->kid[1], &object);
  eval_shapes(s, n->kid[2], &tool);
  uint64_t work = (object.len + tool.len) * (object.len + tool.len);
  if (s->faults == faults && script__charge(s, work + COST_ENTITY * (object.len + tool.len), n->loc)) {
    BooleanSide a = {object.data, object.len, n->op & 1}, b = {tool.data, tool.len, n->op & 2};
    if (!model_boolean(s->model, boolean_op(n->word), &a, &b, tag, out, n->loc, s->diag)) s->faults++;
  }
  vec_free(&object);
  vec_free(&tool);
}

void eval_command(Script *s, const Node *n, ShapeVec *out)
{
  switch ((NodeKind)n->kind) {
  case NODE_TRANSFORM: transform(s, n, out); return;
  case NODE_EXTRUDE: extrude(s, n, out); return;
  case NODE_BOUNDARY: boundary(s, n, out); return;
  case NODE_BOOLEAN: boolean(s, n, out); return;
  case NODE_SPLIT: split(s, n, out); return;
  case NODE_UNSUPPORTED: script__error(s, n->loc, "%s", n->text); return;
  default: UNREACHABLE();
  }
}

// ---- deleting, merging ---------------------------------------------

static void delete_variable(Script *s, const Node *name)
{
  uint32_t word = script__word(s, name);
  if (word == NONE) return;
  Variable *v = script__variable(s, word);
  if (v->kind == VAR_NONE && !v->ntext)
    script__unknown(s, word, name->loc);
  else
    variable__clear(s, v);
}

static void delete_mesh(Script *s, SrcLoc loc)
{
  if (s->host && s->host->mesh) s->host->mesh(s->host->ctx, MESH_DELETE, 0, "", loc);
}

void run_delete(Script *s, const Node *n)
{
  ShapeVec shapes = {0};
  switch (n->word) {
  case KW_COUNT:
    eval_shapes(s, n->kid[0], &shapes);
    model_delete(s->model, shapes.data, shapes.len, n->op);
    break;
  case KW_Embedded: {
    IntVec faces = {0};
    eval_shapes(s, n->kid[0], &shapes);
    for (size_t i = 0; i < shapes.len; i++)
      if (shapes.data[i].dim == 2) vec_push(&faces, shapes.data[i].tag);
    model_delete_embedded(s->model, faces.data, faces.len);
    vec_free(&faces);
    break;
  }
  case KW_Field: field_delete(s->fields, eval_int(s, n->kid[0]), n->loc, s->diag); break;
  case KW_View:
  case KW_Empty:
  case KW_Options: break;
  case KW_Physicals: model_delete_groups(s->model); break;
  case KW_Mesh:
  case KW_Meshes: delete_mesh(s, n->loc); break;
  case KW_Model:
  case KW_All:
    delete_mesh(s, n->loc);
    model_delete_all(s->model);
    if (s->fields) fields_clear(s->fields);
    break;
  case KW_Variables:
    for (size_t i = 0; i < s->var.len; i++) variable__clear(s, &s->var.data[i]);
    break;
  default: delete_variable(s, n->kid[0]);
  }
  vec_free(&shapes);
}

void run_coherence(Script *s, const Node *n)
{
  if (n->word == KW_Mesh || !script__charge(s, COST_ENTITY * (uint64_t)model_points(s->model) / 4, n->loc)) return;
  if (n->n) {
    IntVec point = {0};
    eval_ints(s, n->kid[0], 0, &point);
    if (!model_join_points(s->model, point.data, point.len, n->loc, s->diag)) s->faults++;
    vec_free(&point);
    return;
  }
  if (!model_settings(s->model)->opencascade || !model_fragment_all(s->model, n->loc, s->diag)) model_coherence(s->model, s->diag);
}

// ---- periodicity: here for its maps ---------------------------------------------

static bool periodic_map(Script *s, const Node *n, Affine *a)
{
  if (n->word == KW_Translate) {
    *a = affine_translation(eval_vector(s, n->kid[2]));
    return true;
  }
  if (n->word == KW_Rotate) {
    Vec3 axis = eval_vector(s, n->kid[2]), centre = eval_vector(s, n->kid[3]);
    *a = affine_rotation(axis, centre, eval_number(s, n->kid[4]));
    return true;
  }
  return n->word == KW_Affine && affine_of_list(s, n->kid[2], a);
}

void run_periodic(Script *s, const Node *n)
{
  int faults = s->faults;
  IntVec slave = {0}, master = {0}, slave_edge = {0}, master_edge = {0};
  Affine map;
  bool mapped = periodic_map(s, n, &map);
  eval_ints(s, n->kid[0], n->op, &slave);
  eval_ints(s, n->kid[1], n->op, &master);
  if (n->op == 2 && n->word == KW_COUNT && n->kid[2]) eval_ints(s, n->kid[2], 1, &slave_edge);
  if (n->op == 2 && n->word == KW_COUNT && n->kid[3]) eval_ints(s, n->kid[3], 1, &master_edge);
  if (slave.len != master.len || slave_edge.len != master_edge.len)
    script__error(s, n->loc, "%zu periodic entities, but %zu masters", slave.len, master.len);
  else if (s->faults == faults && n->op == 1)
    model_set_periodic_curves(s->model, slave.data, master.data, slave.len, mapped ? &map : NULL, n->loc,
                              s->diag);
  else if (s->faults == faults && n->op == 2)
    for (size_t i = 0; i < slave.len; i++)
      model_set_periodic_face(s->model, slave.data[i], master.data[i], slave_edge.data, master_edge.data,
                              slave_edge.len, mapped ? &map : NULL, n->loc, s->diag);
  vec_free(&slave);
  vec_free(&master);
  vec_free(&slave_edge);
  vec_free(&master_edge);
}
