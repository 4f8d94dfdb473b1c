// run_mesh.c - how to mesh: sizes, transfinite, recombination, embedding, fields, views
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

void run_mesh_size(Script *s, const Node *n)
{
  int faults = s->faults;
  IntVec points = {0};
  eval_ints(s, n->kid[0], 0, &points);
  double lc = eval_number(s, n->kid[1]);
  if (lc < 0) diag_warning(s->diag, n->loc, "the mesh size %g is negative: the points have none", lc);
  if (s->faults == faults) model_set_size(s->model, points.data, points.len, lc);
  vec_free(&points);
}

// ---- transfinite ---------------------------------------------

static void transfinite_curve(Script *s, const Node *n)
{
  int faults = s->faults;
  TransfiniteLaw law = LAW_UNIFORM;
  double coef = n->kid[2] ? eval_number(s, n->kid[2]) : 1;
  switch (n->word) {
  case KW_COUNT: break;
  case KW_Progression:
  case KW_Power: law = LAW_PROGRESSION; break;
  case KW_Bump: law = LAW_BUMP; break;
  case KW_Beta: law = LAW_BETA; break;
  default: script__error(s, n->loc, "Using %s is not supported", words_text(&s->words, n->word)); return;
  }
  IntVec curves = {0};
  eval_ints(s, n->kid[0], 1, &curves);
  int nodes = eval_int(s, n->kid[1]);
  enum { MOST = 10 * 1000 * 1000 };
  if (nodes > MOST)
    script__error(s, n->kid[1]->loc, "%d nodes on a curve are too many (the limit is %d)", nodes, MOST);
  if (s->faults == faults)
    model_set_transfinite_curve(s->model, curves.data, curves.len, nodes, law, coef, n->loc, s->diag);
  vec_free(&curves);
}

static void transfinite_surface(Script *s, const Node *n)
{
  int faults = s->faults;
  IntVec faces = {0}, corners = {0};
  eval_ints(s, n->kid[0], 2, &faces);
  if (n->kid[1]) eval_ints(s, n->kid[1], 0, &corners);
  TransfiniteArrangement a = ARRANGE_LEFT;
  switch (n->word) {
  case KW_COUNT:
  case KW_Left: break;
  case KW_Right: a = ARRANGE_RIGHT; break;
  case KW_AlternateLeft: a = ARRANGE_ALTERNATE_LEFT; break;
  case KW_Alternate:
  case KW_AlternateRight: a = ARRANGE_ALTERNATE_RIGHT; break;
  default:
    diag_warning(s->diag, n->loc, "unknown arrangement '%s', taken as Alternate",
                 words_text(&s->words, n->word));
    a = ARRANGE_ALTERNATE_RIGHT;
  }
  if (corners.len > 4 && s->faults == faults)
    script__error(s, n->kid[1]->loc, "a transfinite surface has 3 or 4 corners, not %zu", corners.len);
  if (s->faults == faults)
    model_set_transfinite_face(s->model, faces.data, faces.len, corners.data, corners.len, a, n->loc,
                               s->diag);
  vec_free(&faces);
  vec_free(&corners);
}

void run_transfinite(Script *s, const Node *n)
{
  if (n->op == 1) transfinite_curve(s, n);
  if (n->op == 2) transfinite_surface(s, n);
}

// ---- other attributes ---------------------------------------------

void run_mesh_set(Script *s, const Node *n)
{
  int faults = s->faults;
  IntVec tags = {0};
  eval_ints(s, n->kid[0], n->op, &tags);
  double value = n->kid[1] ? eval_number(s, n->kid[1]) : 0;
  if (s->faults == faults) {
    Model *m = s->model;
    int *t = tags.data;
    size_t k = tags.len;
    switch (n->word) {
    case KW_Recombine:
      if (n->op == 2) model_set_recombine(m, t, k, n->kid[1] ? value : 45, n->loc, s->diag);
      break;
    case KW_Smoother:
      if (n->op == 2) model_set_smoother(m, t, k, eval_int(s, n->kid[1]), n->loc, s->diag);
      break;
    case KW_MeshAlgorithm:
      if (n->op == 2) model_set_algorithm(m, t, k, eval_int(s, n->kid[1]), n->loc, s->diag);
      break;
    case KW_MeshSizeFromBoundary:
      if (n->op == 2) model_set_size_from_boundary(m, t, k, eval_int(s, n->kid[1]), n->loc, s->diag);
      break;
    case KW_ReverseMesh:
      if (n->op == 1 || n->op == 2) model_set_reverse(m, n->op, t, k, n->loc, s->diag);
      break;
    case KW_ReorientMesh:
      diag_warning(s->diag, n->loc, "'ReorientMesh' is left out: volumes are not meshed, and surfaces are turned as their loops are");
      break;
    case KW_Degenerated:
      if (n->op == 1) model_set_degenerate(m, t, k, n->loc, s->diag);
      break;
    case KW_RelocateMesh: break; // nodes lie on the geometry already
    default: UNREACHABLE();
    }
  }
  vec_free(&tags);
}

void run_embed(Script *s, const Node *n)
{
  if (n->word == KW_Volume) return; // volumes are not meshed
  int faults = s->faults;
  IntVec tags = {0}, faces = {0};
  eval_ints(s, n->kid[0], n->op, &tags);
  eval_ints(s, n->kid[1], 2, &faces);
  if (n->op > 1)
    script__error(s, n->loc, "only points and curves can be embedded in a surface");
  else
    for (size_t i = 0; i < faces.len && s->faults == faults; i++)
      model_embed(s->model, n->op, tags.data, tags.len, faces.data[i], n->loc, s->diag);
  vec_free(&tags);
  vec_free(&faces);
}

void run_compound(Script *s, const Node *n)
{
  IntVec tags = {0};
  int faults = s->faults;
  eval_ints(s, n->kid[0], n->op, &tags);
  if (n->op < 3 && s->faults == faults) model_set_compound(s->model, n->op, tags.data, tags.len, n->loc, s->diag);
  vec_free(&tags);
}

// ---- fields and views ---------------------------------------------

void run_field(Script *s, const Node *n)
{
  int faults = s->faults, id = eval_int(s, n->kid[0]);
  if (!script__charge(s, COST_FIELD, n->loc)) return;
  if (s->faults == faults && !field_create(s->fields, id, n->text, n->loc, s->diag)) s->faults++;
}

void run_field_use(Script *s, const Node *n)
{
  int faults = s->faults;
  DoubleVec *v = script__take(s);
  eval_list(s, n->kid[0], v);
  if (s->faults == faults) {
    if (n->word == KW_BoundaryLayer)
      fields_set_boundary_layers(s->fields, v->data, v->len, n->loc);
    else if (v->len == 1)
      fields_set_background(s->fields, eval_int(s, n->kid[0]), n->loc);
    else
      script__error(s, n->loc, "the background field is one field; combine several with a Min field");
  }
  script__give(s, v);
}

void run_field_option(Script *s, const Node *n)
{
  const Node *target = n->kid[0], *value = n->kid[1];
  int faults = s->faults, id = eval_int(s, target->kid[0]);
  if (!value) return; // Field[n].Action;
  if (eval_is_text(s, value)) {
    const char *text = eval_text(s, value);
    if (s->faults == faults) field_set_string(s->fields, id, target->text, text, target->loc, s->diag);
  } else if (node_is_list(value)) {
    DoubleVec *v = script__take(s);
    eval_list(s, value, v);
    if (s->faults == faults)
      field_set_list(s->fields, id, target->text, v->data, v->len, target->loc, s->diag);
    script__give(s, v);
  } else {
    double v = eval_number(s, value);
    if (s->faults == faults) field_set_number(s->fields, id, target->text, v, target->loc, s->diag);
  }
}

void run_view(Script *s, const Node *n)
{
  view_begin(s->fields, eval_text(s, n->kid[0]));
  DoubleVec *xyz = script__take(s), *value = script__take(s);
  for (uint32_t i = 1; i < n->n && !s->stopped; i++) {
    const Node *item = n->kid[i];
    bool text = !strcmp(item->text, "T2") || !strcmp(item->text, "T3");
    if (!item->kid[0] || text || strlen(item->text) != 2) continue;
    vec_clear(xyz);
    vec_clear(value);
    eval_list(s, item->kid[0], xyz);
    eval_list(s, item->kid[1], value);
    if (!view_add_element(s->fields, item->text, xyz->data, xyz->len, value->data, value->len, item->loc,
                          s->diag))
      break;
  }
  script__give(s, value);
  script__give(s, xyz);
}
