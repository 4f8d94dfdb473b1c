// run_assign.c - assignments to variables, lists and texts; DefineConstant
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

#include "script/fold.h"
#include "script/function.h"

// a op= b for one number; false after reporting.
static bool combine(Script *s, int op, double *a, double b, SrcLoc loc)
{
  switch (op) {
  case '=': *a = b; return true;
  case TOK_ADD_TO: *a += b; return true;
  case TOK_SUB_FROM: *a -= b; return true;
  case TOK_MUL_BY: *a *= b; return true;
  case TOK_INC: *a += 1; return true;
  case TOK_DEC: *a -= 1; return true;
  case TOK_DIV_BY:
    if (b == 0) {
      script__error(s, loc, "division by zero");
      return false;
    }
    *a /= b;
    return true;
  default: UNREACHABLE();
  }
}

// ---- lists ---------------------------------------------

static uint64_t number_key(double x)
{
  x += 0.0; // -0 equals 0
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}

// Remove the first occurrence of each value, as many of a value as it stands there.
static void remove_values(Script *s, Variable *v, const DoubleVec *values, SrcLoc loc)
{
  if (!script__charge(s, (values->len + v->list.len) / 8, loc)) return;
  Map wanted = {0};
  bool added;
  for (size_t i = 0; i < values->len; i++)
    if (!isnan(values->data[i])) ++*map_slot(&wanted, number_key(values->data[i]), 0, &added);
  size_t kept = 0;
  for (size_t i = 0; i < v->list.len; i++) {
    uint32_t n = isnan(v->list.data[i]) ? NONE : map_get(&wanted, number_key(v->list.data[i]));
    if (n != NONE && n > 0)
      map_set(&wanted, number_key(v->list.data[i]), n - 1);
    else
      v->list.data[kept++] = v->list.data[i];
  }
  v->list.len = kept;
  map_free(&wanted);
}

static void make_list(Script *s, Variable *v)
{
  if (v->kind == VAR_LIST) return;
  double value = v->value;
  bool had = v->kind == VAR_SCALAR;
  variable__set_list(s, v, &value, had ? 1 : 0, NO_LOC);
}

static void assign_list(Script *s, Variable *v, int op, const DoubleVec *values, SrcLoc loc, bool forced)
{
  switch (op) {
  case '=':
    if (!forced && values->len == 1)
      variable__set_scalar(s, v, values->data[0]);
    else
      variable__set_list(s, v, values->data, values->len, loc);
    return;
  case TOK_ADD_TO:
    make_list(s, v);
    v->text_last = false;
    variable__append(s, v, values->data, values->len, loc);
    return;
  case TOK_SUB_FROM:
    make_list(s, v);
    remove_values(s, v, values, loc);
    return;
  default: script__error(s, loc, "a list knows =, += (append) and -= (remove) only");
  }
}

// ---- texts ---------------------------------------------

static bool is_texts(const Node *n)
{
  return n->kind == NODE_WHOLE || n->kind == NODE_LIST ||
         (n->kind == NODE_CALL && function_at(n->op)->type == FUNCTION_TEXTS);
}

static void assign_text(Script *s, uint32_t word, int op, const Node *value, bool list, SrcLoc loc)
{
  TextVec texts = {0};
  if (op == TOK_ADD_TO) {
    const Variable *v = script__variable(s, word);
    for (uint32_t i = 0; i < v->ntext; i++) vec_push(&texts, arena_strdup(&s->temp, v->text[i]));
  } else if (op != '=') {
    script__error(s, loc, "a text knows = and += only");
    return;
  }
  if (list || (is_texts(value) && value->kind != NODE_CALL))
    eval_texts(s, value, &texts);
  else
    vec_push(&texts, eval_text(s, value));
  if (op == TOK_ADD_TO && !list && texts.len == 2) { // s += "more" lengthens a text
    Str all = {0};
    str_append(&all, texts.data[0]);
    str_append(&all, texts.data[1]);
    texts.data[0] = arena_strdup(&s->temp, str_text(&all));
    texts.len = 1;
    str_free(&all);
  }
  size_t bytes = 0;
  for (size_t i = 0; i < texts.len; i++) bytes += strlen(texts.data[i]);
  if (script__charge(s, 2 * texts.len + bytes / 64, loc)) {
    if (s->held + bytes > LIMIT_MEMORY)
      script__error(s, loc, "the variables need more than %zu MB", LIMIT_MEMORY >> 20);
    else
      variable__set_texts(s, script__variable(s, word), texts.data, texts.len, list || texts.len != 1);
  }
  vec_free(&texts);
}

static void assign_text_element(Script *s, uint32_t word, double index, const char *text, SrcLoc loc)
{
  enum { MOST = 100000 };
  Variable *v = script__variable(s, word);
  if (!(index > -1 && index < MOST)) {
    script__error(s, loc, "the index %g is out of range", index);
    return;
  }
  uint32_t i = (uint32_t)index;
  TextVec texts = {0};
  for (uint32_t k = 0; k < MAX(v->ntext, i + 1); k++) vec_push(&texts, k < v->ntext ? v->text[k] : "");
  texts.data[i] = text;
  if (script__charge(s, texts.len, loc)) variable__set_texts(s, v, texts.data, texts.len, true);
  vec_free(&texts);
}

// ---- elements ---------------------------------------------

static void assign_element(Script *s, uint32_t word, double index, int op, double value, SrcLoc loc)
{
  Variable *v = script__variable(s, word);
  if (v->kind == VAR_SCALAR) {
    script__error(s, loc, "'%s' is not a list; make it one first: %s[] = {%g}", words_text(&s->words, word),
                  words_text(&s->words, word), v->value);
    return;
  }
  if (v->kind == VAR_NONE) {
    if (op != '=') {
      script__unknown(s, word, loc);
      return;
    }
    variable__set_list(s, v, NULL, 0, loc);
  }
  if (!(index > -1 && index < LIMIT_LIST)) {
    script__error(s, loc, "the index %g is out of range (the limit is %d)", index, LIMIT_LIST);
    return;
  }
  size_t i = (size_t)index;
  if (i >= v->list.len) {
    static const double zeros[256];
    while (v->list.len <= i)
      if (!variable__append(s, v, zeros, MIN(ARRAY_LEN(zeros), i + 1 - v->list.len), loc)) return;
  }
  combine(s, op, &v->list.data[i], value, loc);
}

static void assign_elements(Script *s, const Node *n, uint32_t word)
{
  const Node *target = n->kid[0];
  DoubleVec *index = script__take(s), *value = script__take(s);
  eval_list(s, target->kid[1], index);
  if (n->kid[1]) eval_list(s, n->kid[1], value);
  if (index->len != value->len)
    script__error(s, target->loc, "%zu indices, but %zu values", index->len, value->len);
  else
    for (size_t i = 0; i < index->len; i++)
      assign_element(s, word, index->data[i], n->op, value->data[i], target->loc);
  script__give(s, value);
  script__give(s, index);
}

// ---- the statement ---------------------------------------------

static void assign_name(Script *s, const Node *n, uint32_t word, bool whole)
{
  const Node *value = n->kid[1];
  SrcLoc loc = n->kid[0]->loc;
  Variable *v = script__variable(s, word);
  if (!value) { // x++ x--
    if (v->kind == VAR_SCALAR)
      v->value += n->op == TOK_INC ? 1 : -1;
    else if (v->kind == VAR_NONE)
      script__unknown(s, word, loc);
    else
      script__error(s, loc, "'%s' is a list and cannot be counted up or down", words_text(&s->words, word));
    return;
  }
  if (!node_is_list(value) && !whole) {
    if (value->kind == NODE_STRING ||
        (value->kind != NODE_NUMBER && value->kind != NODE_BINARY && eval_is_text(s, value))) {
      assign_text(s, word, n->op, value, false, loc);
      return;
    }
    double x = eval_number(s, value);
    v = script__variable(s, word);
    if (n->op == '=') {
      variable__set_scalar(s, v, x);
      return;
    }
    if (v->kind == VAR_SCALAR) {
      combine(s, n->op, &v->value, x, n->loc);
      return;
    }
    if (v->kind == VAR_NONE) {
      script__unknown(s, word, loc);
      return;
    }
    DoubleVec *one = script__take(s);
    vec_push(one, x);
    assign_list(s, v, n->op, one, loc, true);
    script__give(s, one);
    return;
  }
  if (eval_is_text(s, value)) {
    assign_text(s, word, n->op, value, whole, loc);
    return;
  }
  DoubleVec *values = script__take(s);
  eval_list(s, value, values);
  v = script__variable(s, word);
  if (v->kind == VAR_NONE && n->op != '=' && !whole)
    script__unknown(s, word, loc);
  else if (v->kind == VAR_SCALAR && n->op != '=' && !whole) {
    if (values->len == 1)
      combine(s, n->op, &v->value, values->data[0], n->loc);
    else
      script__error(s, loc, "'%s' is a number: one value is needed, not %zu", words_text(&s->words, word),
                    values->len);
  } else
    assign_list(s, v, n->op, values, loc, whole);
  script__give(s, values);
}

// Plugins are post-processing. Those that change meshes, or views that may give sizes, cannot be left out in
// silence.
static void run_plugin(Script *s, const Node *n)
{
  static const char *const vital[] = {"Crack",    "NewView",          "Distance",
                                      "MathEval", "ModifyComponents", "SimplePartition",
                                      "Scal2Vec", "Triangulate",      "Smooth"};
  const char *dot = strchr(n->kid[0]->text, '.');
  int len = (int)(dot - n->kid[0]->text);
  if (strcmp(dot, ".Run") != 0) return;
  for (size_t i = 0; i < ARRAY_LEN(vital); i++) {
    if ((size_t)len != strlen(vital[i]) || strncmp(n->kid[0]->text, vital[i], (size_t)len) != 0) continue;
    script__error(s, n->loc, "Plugin(%s) is not supported", vital[i]);
    return;
  }
  diag_warning(s->diag, n->loc, "Plugin(%.*s) is left out: there is no post-processing here", len,
               n->kid[0]->text);
}

void run_assign(Script *s, const Node *n)
{
  const Node *target = n->kid[0], *name = target;
  switch ((NodeKind)target->kind) {
  case NODE_OPTION: run_option(s, n); return;
  case NODE_FIELD_OPTION: run_field_option(s, n); return;
  case NODE_PLUGIN_OPTION: {
    run_plugin(s, n);
    return;
  }
  case NODE_WHOLE:
  case NODE_INDEX:
  case NODE_SUBLIST: name = target->kid[0]; break;
  default: break;
  }
  uint32_t word = script__word(s, name);
  if (word == NONE) return;
  switch ((NodeKind)target->kind) {
  case NODE_INDEX: {
    double index = eval_number(s, target->kid[1]);
    if (n->kid[1] && eval_is_text(s, n->kid[1])) {
      assign_text_element(s, word, index, eval_text(s, n->kid[1]), target->loc);
      return;
    }
    double value = n->kid[1] ? eval_number(s, n->kid[1]) : 0;
    assign_element(s, word, index, n->op, value, target->loc);
    return;
  }
  case NODE_SUBLIST: assign_elements(s, n, word); return;
  default: assign_name(s, n, word, target->kind == NODE_WHOLE);
  }
}

// ---- DefineConstant ---------------------------------------------

static void define_text(Script *s, const Node *item, uint32_t word, const char *parameter, bool read_only)
{
  const Node *value = item->kid[1];
  const char *text = eval_text(s, value);
  Parameter *p = parameter ? script__parameter(s, parameter, false) : NULL;
  if (p && p->text && !read_only) {
    text = arena_strdup(&s->temp, p->text);
  } else if (parameter) {
    p = script__parameter(s, parameter, true);
    free(p->text);
    p->text = mem_strdup(text);
  }
  if (item->op && !parameter) {
    assign_text(s, word, '=', value, true, item->loc);
    return;
  }
  variable__set_texts(s, script__variable(s, word), &text, 1, item->op);
}

static void define_numbers(Script *s, const Node *item, uint32_t word, const char *parameter, bool read_only)
{
  const Node *value = item->kid[1];
  DoubleVec *v = script__take(s);
  if (value)
    eval_list(s, value, v);
  else if (!item->op)
    vec_push(v, 0);
  if (parameter) {
    Parameter *p = script__parameter(s, parameter, false);
    if (p && !p->text && !read_only) {
      vec_resize(v, p->list.len);
      if (p->list.len) memcpy(v->data, p->list.data, p->list.len * sizeof(double));
    } else {
      p = script__parameter(s, parameter, true);
      vec_resize(&p->list, v->len);
      if (v->len) memcpy(p->list.data, v->data, v->len * sizeof(double));
    }
  }
  Variable *var = script__variable(s, word);
  if (item->op || v->len != 1)
    variable__set_list(s, var, v->data, v->len, item->loc);
  else
    variable__set_scalar(s, var, v->data[0]);
  script__give(s, v);
}

void run_constants(Script *s, const Node *n)
{
  for (uint32_t i = 0; i < n->n; i++) {
    const Node *item = n->kid[i];
    uint32_t word = script__word(s, item->kid[0]);
    if (word == NONE) continue;
    const Variable *v = script__variable(s, word);
    bool text = item->kid[1] && eval_is_text(s, item->kid[1]);
    if (text ? v->ntext > 0 : v->kind != VAR_NONE) continue; // what exists wins, and so does -setnumber
    const char *parameter = item->kid[2] ? eval_text(s, item->kid[2]) : NULL;
    bool read_only = item->kid[3] && eval_number(s, item->kid[3]) != 0;
    if (text)
      define_text(s, item, word, parameter, read_only);
    else
      define_numbers(s, item, word, parameter, read_only);
  }
}
