// run_struct.c - structures: their definition, members and name spaces
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

// A member of a structure is a variable that no script can name otherwise: "S.a", or "Space::S.a". So is the
// structure's number in its name space, "Space::S", and the list of a name space's structures, "Space::";
// outside all name spaces these are "::S" and "::".

static const char *space_text(Script *s, uint32_t word) { return word == KW_COUNT ? "" : words_text(&s->words, word); }

static const char *printed(Script *s, const char *a, const char *b, const char *c)
{
  Str text = {0};
  str_printf(&text, "%s%s%s", a, b, c);
  const char *copy = arena_strdup(&s->temp, str_text(&text));
  str_free(&text);
  return copy;
}

const char *struct_name_text(Script *s, const Node *n)
{
  switch ((NodeKind)n->kind) {
  case NODE_OPTION: return n->text;
  case NODE_MEMBER: return printed(s, script__name_text(s, n->kid[0]), ".", n->text);
  case NODE_SCOPED: return printed(s, space_text(s, n->word), "::", script__name_text(s, n->kid[0]));
  default: return printed(s, "::", script__name_text(s, n), "");
  }
}

Variable *struct_find(Script *s, const char *text)
{
  uint32_t word = words_find(&s->words, text, strlen(text));
  if (word == NONE || word >= s->var.len) return NULL;
  Variable *v = &s->var.data[word];
  return v->kind != VAR_NONE || v->ntext ? v : NULL;
}

bool struct_exists(Script *s, const Node *option)
{
  const char *dot = strchr(option->text, '.');
  char name[128];
  if (!dot || dot - option->text >= (int)sizeof name - 3) return false;
  snprintf(name, sizeof name, "::%.*s", (int)(dot - option->text), option->text);
  return struct_find(s, name);
}

double struct_list_number(Script *s, const Node *n)
{
  if (n->op == 2) {
    script__error(s, n->loc, "NameStruct gives a text, a number is needed here");
    return 0;
  }
  const Variable *v = struct_find(s, printed(s, space_text(s, n->word), "::", ""));
  return v ? v->ntext : 0;
}

const char *struct_list_text(Script *s, const Node *n)
{
  const char *space = space_text(s, n->word);
  const Variable *v = struct_find(s, printed(s, space, "::", ""));
  int i = eval_int(s, n->kid[0]);
  if (v && i >= 1 && (uint32_t)i <= v->ntext) return arena_strdup(&s->temp, v->text[i - 1]);
  script__error(s, n->loc, "there is no Struct number %d %s%s; there are %u, counted from 1", i,
                *space ? "in name space " : "outside name spaces", space, v ? v->ntext : 0);
  return "";
}

// The variable of this name, made if need be; NULL after reporting.
static Variable *make(Script *s, const char *text, SrcLoc loc)
{
  if (strlen(text) > LIMIT_NAME) {
    script__error(s, loc, "this name is too long");
    return NULL;
  }
  if (!script__charge(s, COST_ENTITY, loc)) return NULL;
  uint32_t word = words_intern(&s->words, text, strlen(text));
  if (word != NONE) return script__variable(s, word);
  script__error(s, loc, "too many different names (the limit is %d)", LIMIT_SYMBOLS);
  return NULL;
}

// The hidden member ".": what the next member of an enumeration is worth.
static void set_scalar(Script *s, const char *text, double value, SrcLoc loc)
{
  Variable *v = make(s, text, loc);
  if (v) variable__set_scalar(s, v, value);
}

static void set_member(Script *s, const char *name, const Node *item)
{
  const Node *value = item->kid[0];
  const char *text = printed(s, name, ".", item->text), *counter = printed(s, name, ".", "");
  if (struct_find(s, text)) {
    script__error(s, item->loc, "the member '%s' of this Struct exists already", item->text);
    return;
  }
  if (!value) {
    const Variable *last = struct_find(s, counter);
    double next = last ? last->value : 0;
    set_scalar(s, text, next, item->loc);
    set_scalar(s, counter, next + 1, item->loc);
    return;
  }
  if (eval_is_text(s, value)) {
    TextVec texts = {0};
    eval_texts(s, value, &texts);
    Variable *v = make(s, text, item->loc);
    if (v && script__charge(s, texts.len, item->loc))
      variable__set_texts(s, v, texts.data, texts.len, texts.len != 1);
    vec_free(&texts);
    return;
  }
  DoubleVec *values = script__take(s);
  eval_list(s, value, values);
  Variable *v = make(s, text, item->loc);
  if (v && !node_is_list(value) && values->len == 1) {
    variable__set_scalar(s, v, values->data[0]);
    set_scalar(s, counter, values->data[0] + 1, item->loc);
  } else if (v) {
    variable__set_list(s, v, values->data, values->len, item->loc);
  }
  script__give(s, values);
}

// Enter a new structure in its name space, whose variable has the names as texts and the last number as value.
// The structure's number is that plus one, or its member Tag; it is the value of `marker` and of the member.
static bool enter(Script *s, const Node *n, const char *path, const char *marker)
{
  const Node *name = n->kid[0];
  bool scoped = name->kind == NODE_SCOPED;
  Variable *list = make(s, printed(s, scoped ? space_text(s, name->word) : "", "::", ""), name->loc);
  if (!list) return false;
  TextVec names = {0};
  for (uint32_t i = 0; i < list->ntext; i++) vec_push(&names, arena_strdup(&s->temp, list->text[i]));
  vec_push(&names, script__name_text(s, scoped ? name->kid[0] : name));
  double number = list->kind == VAR_SCALAR ? list->value + 1 : 1;
  bool ok = script__charge(s, names.len, name->loc), given = false;
  for (uint32_t i = 1; i < n->n; i++) {
    const Node *item = n->kid[i];
    if (strcmp(item->text, "Tag") != 0 || !item->kid[0]) continue;
    number = eval_number(s, item->kid[0]), given = true;
  }
  const char *space = printed(s, scoped ? space_text(s, name->word) : "", "::", "");
  list = make(s, space, name->loc); // evaluation may have moved it
  ok = ok && list;
  if (ok) variable__set_scalar(s, list, number), variable__set_texts(s, list, names.data, names.len, true);
  vec_free(&names);
  if (ok) set_scalar(s, marker, number, name->loc);
  if (ok && !given) set_scalar(s, printed(s, path, ".", "Tag"), number, name->loc);
  return ok;
}

double struct_value(Script *s, const Node *n)
{
  run_struct(s, n);
  const Variable *number = struct_find(s, struct_name_text(s, n->kid[0]));
  return number ? number->value : 0;
}

void run_struct(Script *s, const Node *n)
{
  const Node *name = n->kid[0];
  const char *marker = struct_name_text(s, name);
  const char *path = name->kind == NODE_SCOPED ? marker : script__name_text(s, name);
  bool known = struct_find(s, marker);
  if (known && !(n->op & STRUCT_APPEND)) {
    script__error(s, n->loc, "the Struct '%s' exists already; to add members, write Struct %s (Append) [ ... ];",
                  path, path);
    return;
  }
  if (!known && !enter(s, n, path, marker)) return;
  for (uint32_t i = 1; i < n->n; i++) set_member(s, path, n->kid[i]);
}
