// eval.c - values of expressions: numbers and lists
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

#include "base/stats.h"
#include "script/fold.h"
#include "script/function.h"

// ---- numbers ---------------------------------------------

static double variable_value(Script *s, uint32_t word, SrcLoc loc)
{
  const Variable *v = word == NONE ? NULL : script__variable(s, word);
  if (v && v->kind == VAR_NONE && !v->ntext) { // the number of a Struct
    char name[128];
    snprintf(name, sizeof name, "::%s", words_text(&s->words, word));
    const Variable *number = strlen(name) + 1 < sizeof name ? struct_find(s, name) : NULL;
    if (number) return number->value;
  }
  if (!v || v->kind == VAR_NONE) {
    if (v && v->ntext)
      script__error(s, loc, "'%s' is a text, a number is needed here", words_text(&s->words, word));
    else
      script__unknown(s, word, loc);
    return 0;
  }
  if (v->kind == VAR_SCALAR) return v->value;
  if (!v->list.len) script__error(s, loc, "the list '%s' is empty", words_text(&s->words, word));
  return variable__first(v);
}

static double element_value(Script *s, const Node *n)
{
  uint32_t word = script__word(s, n->kid[0]);
  const Variable *v = word == NONE ? NULL : script__variable(s, word);
  if (!v || v->kind == VAR_NONE) {
    if (v && v->ntext)
      script__error(s, n->loc, "'%s' is a text, a number is needed here", words_text(&s->words, word));
    else
      script__unknown(s, word, n->loc);
    return 0;
  }
  double index = eval_number(s, n->kid[1]);
  v = script__variable(s, word);
  size_t len = v->kind == VAR_SCALAR ? 1 : v->list.len;
  if (!(index > -1 && index < (double)len)) {
    script__error(s, n->loc, "'%s[%d]' does not exist: the list has %zu member%s, counted from 0",
                  words_text(&s->words, word), number_to_int(index), len, len == 1 ? "" : "s");
    return 0;
  }
  return v->kind == VAR_SCALAR ? v->value : v->list.data[(size_t)index];
}

static double postfix_value(Script *s, const Node *n)
{
  const Node *target = n->kid[0];
  double v = eval_number(s, target), step = n->op == TOK_INC ? 1 : -1;
  if (target->kind == NODE_OPTION) {
    script__set_option(s, target->text, n->loc, TOK_ADD_TO, step, NULL);
  } else if (target->kind == NODE_INDEX) {
    uint32_t word = script__word(s, target->kid[0]);
    Variable *var = word == NONE ? NULL : script__variable(s, word);
    int i = eval_int(s, target->kid[1]);
    if (var && var->kind == VAR_LIST && i >= 0 && (size_t)i < var->list.len) var->list.data[i] += step;
  } else {
    uint32_t word = script__word(s, target);
    Variable *var = word == NONE ? NULL : script__variable(s, word);
    if (var && var->kind == VAR_SCALAR) var->value += step;
  }
  return v;
}

static double binary_value(Script *s, const Node *n)
{
  double a = eval_number(s, n->kid[0]);
  switch (n->op) {
  case '+': return a + eval_number(s, n->kid[1]);
  case '-': return a - eval_number(s, n->kid[1]);
  case '*': return a * eval_number(s, n->kid[1]);
  case TOK_AND: return a != 0 && eval_number(s, n->kid[1]) != 0;
  case TOK_OR: return a != 0 || eval_number(s, n->kid[1]) != 0;
  default: break;
  }
  double b = eval_number(s, n->kid[1]);
  if ((n->op == '/' && b == 0) || (n->op == '%' && number_to_int(b) == 0)) {
    script__error(s, n->loc, "division by zero");
    return a;
  }
  return number_binary(n->op, a, b);
}

static double length_value(Script *s, const Node *n)
{
  uint32_t word = script__word(s, n->kid[0]);
  const Variable *v = word == NONE ? NULL : script__variable(s, word);
  if (!v || (v->kind == VAR_NONE && !v->ntext && !v->text_is_list)) {
    script__unknown(s, word, n->kid[0]->loc);
    return 0;
  }
  if (v->kind == VAR_NONE || v->text_last) return v->ntext;
  return v->kind == VAR_SCALAR ? 1 : (double)v->list.len;
}

static double constant_value(Script *s, const Node *n)
{
  switch (n->word) {
  case KW_newp: return model_new_tag(s->model, KIND_POINT);
  case KW_newl: return model_new_tag(s->model, KIND_CURVE);
  case KW_newll: return model_new_tag(s->model, KIND_LOOP);
  case KW_news: return model_new_tag(s->model, KIND_FACE);
  case KW_newsl: return model_new_tag(s->model, KIND_SURFACE_LOOP);
  case KW_newv: return model_new_tag(s->model, KIND_VOLUME);
  case KW_newreg: return model_new_tag(s->model, KIND_GROUP);
  case KW_newf: return fields_max_id(s->fields) + 1;
  case KW_Cpu: return time_cpu();
  case KW_Memory: return (double)mem_now() / (1024 * 1024);
  default: return 0; // TotalMemory, TestLevel: unknown here
  }
}

// DefineNumber[value, Name "..."]: the parameter's value if it has one already.
static double parameter_value(Script *s, const Node *n)
{
  double v = eval_number(s, n->kid[0]);
  if (!n->kid[1]) return v;
  const char *name = eval_text(s, n->kid[1]);
  bool read_only = n->kid[2] && eval_number(s, n->kid[2]) != 0;
  Parameter *p = script__parameter(s, name, false);
  if (p && !p->text && p->list.len && !read_only) return p->list.data[0];
  if (!p) p = script__parameter(s, name, true);
  vec_clear(&p->list);
  vec_push(&p->list, v);
  return v;
}

static double text_as_number(Script *s, const Node *n)
{
  script__error(s, n->loc, "a number is needed here, not a text");
  return 0;
}

double eval_number(Script *s, const Node *n)
{
  switch ((NodeKind)n->kind) {
  case NODE_NUMBER: return n->number;
  case NODE_NAME: {
    if (LIKELY(n->word < s->var.len && s->var.data[n->word].kind == VAR_SCALAR))
      return s->var.data[n->word].value;
    return variable_value(s, n->word, n->loc);
  }
  case NODE_DYNAME:
  case NODE_S2N: return variable_value(s, script__word(s, n), n->loc);
  case NODE_INDEX: return element_value(s, n);
  case NODE_BINARY:
    if (node_is_list(n)) break;
    return binary_value(s, n);
  case NODE_UNARY:
    if (node_is_list(n)) break;
    return n->op == '!' ? eval_number(s, n->kid[0]) == 0 : -eval_number(s, n->kid[0]);
  case NODE_TERNARY: return eval_number(s, n->kid[eval_number(s, n->kid[0]) != 0 ? 1 : 2]);
  case NODE_LENGTH: return length_value(s, n);
  case NODE_CALL:
    if (node_is_list(n)) break;
    return call_number(s, n);
  case NODE_CONSTANT: return constant_value(s, n);
  case NODE_OPTION:
    if (struct_exists(s, n)) return variable_value(s, script__word(s, n), n->loc);
    return option_number(s, n);
  case NODE_MEMBER: return variable_value(s, script__word(s, n), n->loc);
  case NODE_SCOPED: return n->op ? struct_list_number(s, n) : variable_value(s, script__word(s, n), n->loc);
  case NODE_STRUCT: return struct_value(s, n);
  case NODE_POSTFIX: return postfix_value(s, n);
  case NODE_PARAMETER: return n->op ? text_as_number(s, n) : parameter_value(s, n);
  case NODE_FIELD_OPTION: return field_get_number(s->fields, eval_int(s, n->kid[0]), n->text);
  case NODE_STRING: return text_as_number(s, n);
  default: break;
  }
  DoubleVec *v = script__take(s);
  eval_list(s, n, v);
  double first = v->len ? v->data[0] : 0;
  if (v->len != 1) script__error(s, n->loc, "a number is needed here, not a list");
  script__give(s, v);
  return first;
}

int eval_int(Script *s, const Node *n)
{
  double v = eval_number(s, n);
  if (!(fabs(v) < 2147483648.0)) {
    script__error(s, n->loc, "the number %g is too large here", v);
    return 0;
  }
  return (int)v;
}

Vec3 eval_vector(Script *s, const Node *n)
{
  DoubleVec *v = script__take(s);
  eval_list(s, n, v);
  Vec3 r = {0, 0, 0};
  if (v->len >= 3) r = (Vec3){v->data[0], v->data[1], v->data[2]};
  if (v->len != 3) script__error(s, n->loc, "a vector needs 3 components {x, y, z}; %zu given", v->len);
  script__give(s, v);
  return r;
}

// ---- lists ---------------------------------------------

static void range_list(Script *s, const Node *n, DoubleVec *out)
{
  double a = eval_number(s, n->kid[0]), b = eval_number(s, n->kid[1]);
  double step = n->kid[2] ? eval_number(s, n->kid[2]) : b < a ? -1 : 1;
  if (step == 0 || !isfinite(a) || !isfinite(b) || !isfinite(step)) {
    script__error(s, n->loc,
                  step == 0 ? "the step of a range cannot be 0" : "the bounds of a range must be finite");
    return;
  }
  double count = floor((b - a) / step) + 1;
  if (count < 0) count = 0;
  if ((double)out->len + count > LIMIT_LIST) {
    script__error(s, n->loc, "this range has %.0f members (the limit is %d)", count, LIMIT_LIST);
    return;
  }
  if (!script__charge(s, (uint64_t)count / 8, n->loc)) return;
  size_t most = out->len + (size_t)count + 1; // a sum may end one sooner or later than the quotient says
  for (double x = a; (step > 0 ? x <= b : x >= b) && out->len < most; x += step) {
    vec_push(out, x);
    if (x + step == x) break;
  }
}

static void whole_list(Script *s, const Node *n, DoubleVec *out)
{
  uint32_t word = script__word(s, n->kid[0]);
  const Variable *v = word == NONE ? NULL : script__variable(s, word);
  if (!v || v->kind == VAR_NONE) {
    if (v && v->ntext)
      script__error(s, n->loc, "'%s' holds texts, numbers are needed here", words_text(&s->words, word));
    else
      script__unknown(s, word, n->loc);
    return;
  }
  if (v->kind == VAR_SCALAR) {
    vec_push(out, v->value);
    return;
  }
  if (!script__charge(s, v->list.len / 8, n->loc)) return;
  size_t at = out->len, len = v->list.len;
  vec_resize(out, at + len);
  if (len) memcpy(out->data + at, v->list.data, len * sizeof(double));
}

static void sublist(Script *s, const Node *n, DoubleVec *out)
{
  DoubleVec *index = script__take(s);
  eval_list(s, n->kid[1], index);
  uint32_t word = script__word(s, n->kid[0]);
  const Variable *v = word == NONE ? NULL : script__variable(s, word);
  if (!v || v->kind == VAR_NONE) {
    script__unknown(s, word, n->loc);
  } else {
    size_t len = v->kind == VAR_SCALAR ? 1 : v->list.len;
    for (size_t i = 0; i < index->len; i++) {
      double k = index->data[i];
      if (k > -1 && k < (double)len) {
        vec_push(out, v->kind == VAR_SCALAR ? v->value : v->list.data[(size_t)k]);
        continue;
      }
      script__error(s, n->loc, "'%s[%d]' does not exist: the list has %zu member%s, counted from 0",
                    words_text(&s->words, word), number_to_int(k), len, len == 1 ? "" : "s");
      break;
    }
  }
  script__give(s, index);
}

static void binary_list(Script *s, const Node *n, DoubleVec *out)
{
  size_t at = out->len;
  if (n->op == '*') {
    double f = eval_number(s, n->kid[0]);
    eval_list(s, n->kid[1], out);
    for (size_t i = at; i < out->len; i++) out->data[i] *= f;
    return;
  }
  DoubleVec *b = script__take(s);
  eval_list(s, n->kid[0], out);
  eval_list(s, n->kid[1], b);
  if (out->len - at != b->len)
    script__error(s, n->loc, "lists of %zu and %zu members cannot be added", out->len - at, b->len);
  else
    for (size_t i = 0; i < b->len; i++) out->data[at + i] += n->op == '+' ? b->data[i] : -b->data[i];
  script__give(s, b);
}

static void group_tags(const Script *s, int dim, IntVec *out)
{
  for (size_t k = 0; k < model_groups(s->model); k++) {
    const Group *g = model_group_at(s->model, k);
    if (g->dim == dim) vec_push(out, g->tag);
  }
}

// Point{n} gives coordinates, Curve{:} all tags, Physical Curve{n} the members of groups, Physical Curve{:} their tags.
static void entities_list(Script *s, const Node *n, DoubleVec *out)
{
  IntVec tags = {0};
  int dim = n->op;
  if ((n->flags & LIST_PHYSICAL) && n->kid[0]->kind == NODE_ALL) {
    group_tags(s, dim, &tags);
  } else if (n->flags & LIST_PHYSICAL) {
    IntVec group = {0};
    eval_ints(s, n->kid[0], -1, &group);
    for (size_t i = 0; i < group.len; i++)
      if (!model_group_members(s->model, dim, group.data[i], &tags))
        script__error(s, n->loc, "there is no physical group %d of this dimension", group.data[i]);
    vec_free(&group);
  } else if (n->kid[0]->kind == NODE_ALL) {
    model_all(s->model, dim, &tags);
  } else if (dim == 0) {
    IntVec points = {0};
    eval_ints(s, n->kid[0], 0, &points);
    for (size_t i = 0; i < points.len; i++) {
      const Point *p = model_point(s->model, points.data[i]);
      if (!p) {
        script__error(s, n->loc, "there is no point %d", points.data[i]);
        continue;
      }
      vec_push(out, p->xyz.x);
      vec_push(out, p->xyz.y);
      vec_push(out, p->xyz.z);
    }
    vec_free(&points);
  } else {
    script__error(s, n->loc, "only Point{n} has coordinates; tags are given by Curve{:} or Surface{:}");
  }
  for (size_t i = 0; i < tags.len; i++) vec_push(out, tags.data[i]);
  script__charge(s, tags.len / 8, n->loc);
  vec_free(&tags);
}

static void in_box_list(Script *s, const Node *n, DoubleVec *out)
{
  DoubleVec *v = script__take(s);
  eval_list(s, n->kid[0], v);
  if (v->len != 6) {
    script__error(s, n->loc, "a bounding box needs 6 numbers {xmin,ymin,zmin, xmax,ymax,zmax}; %zu given",
                  v->len);
  } else {
    const double *b = v->data;
    IntVec tags = {0};
    const Model *m = s->model;
    script__charge(s, n->op == 0 ? model_points(m) : n->op == 1 ? model_curves(m) : model_faces(m), n->loc);
    model_in_box(s->model, n->op, (Box3){{b[0], b[1], b[2]}, {b[3], b[4], b[5]}}, &tags);
    for (size_t i = 0; i < tags.len; i++) vec_push(out, tags.data[i]);
    vec_free(&tags);
  }
  script__give(s, v);
}

static void box_of_list(Script *s, const Node *n, DoubleVec *out)
{
  IntVec tags = {0};
  ShapeVec shapes = {0};
  Box3 box;
  eval_ints(s, n->kid[0], n->op, &tags);
  for (size_t i = 0; i < tags.len; i++) vec_push(&shapes, ((Shape){n->op, tags.data[i]}));
  if (model_box_of(s->model, shapes.data, shapes.len, &box, n->loc, s->diag)) {
    const double b[6] = {box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z};
    for (int i = 0; i < 6; i++) vec_push(out, b[i]);
  } else {
    s->faults++;
  }
  vec_free(&tags);
  vec_free(&shapes);
}

static void command_list(Script *s, const Node *n, DoubleVec *out)
{
  ShapeVec shapes = {0};
  eval_command(s, n, &shapes);
  for (size_t i = 0; i < shapes.len; i++) vec_push(out, shapes.data[i].tag);
  vec_free(&shapes);
}

void eval_list(Script *s, const Node *n, DoubleVec *out)
{
  switch ((NodeKind)n->kind) {
  case NODE_LIST:
    for (uint32_t i = 0; i < n->n; i++) {
      const Node *k = n->kid[i];
      if (node_is_list(k))
        eval_list(s, k, out);
      else
        vec_push(out, eval_number(s, k));
    }
    script__charge(s, n->n / 4, n->loc);
    return;
  case NODE_RANGE: range_list(s, n, out); return;
  case NODE_WHOLE: whole_list(s, n, out); return;
  case NODE_SUBLIST: sublist(s, n, out); return;
  case NODE_ENTITIES: entities_list(s, n, out); return;
  case NODE_IN_BOX: in_box_list(s, n, out); return;
  case NODE_BOX_OF: box_of_list(s, n, out); return;
  case NODE_TRANSFORM:
  case NODE_EXTRUDE:
  case NODE_BOUNDARY:
  case NODE_BOOLEAN:
  case NODE_SPLIT:
  case NODE_UNSUPPORTED: command_list(s, n, out); return;
  case NODE_ALL: script__error(s, n->loc, "{:} stands for all entities and has no meaning here"); return;
  case NODE_UNARY:
    if (!node_is_list(n)) break;
    size_t at = out->len;
    eval_list(s, n->kid[0], out);
    for (size_t i = at; i < out->len; i++) out->data[i] = -out->data[i];
    return;
  case NODE_BINARY:
    if (!node_is_list(n)) break;
    binary_list(s, n, out);
    return;
  case NODE_CALL:
    if (!node_is_list(n)) break;
    call_list(s, n, out);
    return;
  default: break;
  }
  vec_push(out, eval_number(s, n));
}

void eval_ints(Script *s, const Node *n, int dim, IntVec *out)
{
  if (n->kind == NODE_ALL && dim >= 0) {
    model_all(s->model, dim, out);
    return;
  }
  DoubleVec *v = script__take(s);
  eval_list(s, n, v);
  vec_reserve(out, out->len + v->len);
  for (size_t i = 0; i < v->len; i++) {
    double x = v->data[i];
    if (fabs(x) < 2147483648.0)
      vec_push(out, (int)x);
    else
      script__error(s, n->loc, "%g cannot be a tag", x);
  }
  script__charge(s, v->len, n->loc);
  script__give(s, v);
}
