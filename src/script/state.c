// state.c - the running script's variables, parameters, limits and scratch memory
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

#include <stdarg.h>

#include "script/function.h"

void script__error(Script *s, SrcLoc loc, const char *fmt, ...)
{
  char text[1024];
  va_list ap;
  va_start(ap, fmt);
  vsnprintf(text, sizeof text, fmt, ap);
  va_end(ap);
  s->faults++;
  if (loc.line) { // what a loop runs into again and again is told a few times only
    enum { REPEATS = 3, HOPELESS = 100 };
    bool added;
    uint64_t key = (uint64_t)loc.file << 52 ^ (uint64_t)loc.line << 20 ^ loc.col;
    uint32_t times = ++*map_slot(&s->reported, key, 0, &added);
    if (times > HOPELESS) s->stopped = true;
    if (times > REPEATS && s->depth) return;
  }
  diag_error(s->diag, loc, "%s", text);
  if (diag_full(s->diag)) s->stopped = true;
}

bool script__charge(Script *s, uint64_t work, SrcLoc loc)
{
  if (s->depth == 0) return true;
  s->work += work;
  if (LIKELY(s->work <= LIMIT_WORK)) return true;
  if (!s->stopped) {
    script__error(s, loc, "the script does not come to an end: more than %d steps in loops and macros",
                  LIMIT_WORK);
    s->stopped = true;
  }
  return false;
}

// ---- variables ---------------------------------------------

Variable *script__variable(Script *s, uint32_t word)
{
  if (UNLIKELY(word >= s->var.len)) {
    size_t old = s->var.len;
    vec_resize(&s->var, MAX((size_t)word + 1, s->words.text.len));
    memset(s->var.data + old, 0, (s->var.len - old) * sizeof s->var.data[0]);
  }
  return &s->var.data[word];
}

const char *script__name_text(Script *s, const Node *name)
{
  if (name->kind == NODE_NAME) return words_text(&s->words, name->word);
  if (name->kind == NODE_S2N) return eval_text(s, name->kid[0]);
  if (name->kind != NODE_DYNAME) return struct_name_text(s, name);
  Str text = {0};
  str_append(&text, words_text(&s->words, name->kid[0]->word));
  for (uint32_t i = 1; i < name->n; i++) str_printf(&text, "_%d", eval_int(s, name->kid[i]));
  const char *copy = arena_strdup(&s->temp, str_text(&text));
  str_free(&text);
  return copy;
}

uint32_t script__word(Script *s, const Node *name)
{
  if (name->kind == NODE_NAME) return name->word;
  const char *text = script__name_text(s, name);
  if (!*text || strlen(text) > LIMIT_NAME) {
    script__error(s, name->loc, *text ? "this name is too long" : "a name cannot be empty");
    return NONE;
  }
  if (!script__charge(s, COST_ENTITY / 4, name->loc)) return NONE;
  uint32_t word = words_intern(&s->words, text, strlen(text));
  if (word == NONE) script__error(s, name->loc, "too many different names (the limit is %d)", LIMIT_SYMBOLS);
  return word;
}

void script__unknown(Script *s, uint32_t word, SrcLoc loc)
{
  s->faults++;
  if (word == NONE) return;
  Variable *v = script__variable(s, word);
  if (v->reported) return;
  v->reported = true;
  enum { MOST = 5000 };
  Vec(const char *) names = {0};
  for (size_t i = 0; i < s->var.len && names.len < MOST; i++)
    if (s->var.data[i].kind || s->var.data[i].ntext) vec_push(&names, words_text(&s->words, (uint32_t)i));
  const char *name = words_text(&s->words, word), *near = str_nearest(name, names.data, names.len);
  if (!near) near = function_nearest(name);
  const char *dot = strrchr(name, '.');
  if (dot || strchr(name, ':'))
    script__error(s, loc, dot ? "unknown member '%s' of a Struct" : "unknown Struct '%s'", name);
  else if (near && strcmp(near, name) != 0)
    script__error(s, loc, "unknown variable '%s'; did you mean '%s'?", name, near);
  else
    script__error(s, loc, "unknown variable '%s'", name);
  vec_free(&names);
}

static void free_list(Script *s, Variable *v)
{
  s->held -= v->list.cap * sizeof(double);
  vec_free(&v->list);
}

static void free_texts(Script *s, Variable *v)
{
  for (uint32_t i = 0; i < v->ntext; i++) {
    s->held -= strlen(v->text[i]) + 1;
    free(v->text[i]);
  }
  free(v->text);
  v->text = NULL;
  v->ntext = 0;
}

void variable__clear(Script *s, Variable *v)
{
  free_list(s, v);
  free_texts(s, v);
  v->kind = VAR_NONE;
  v->text_last = v->fixed = v->reported = false;
}

void variable__set_scalar(Script *s, Variable *v, double value)
{
  if (v->kind == VAR_LIST) free_list(s, v);
  v->kind = VAR_SCALAR;
  v->value = value;
  v->text_last = false;
}

bool variable__append(Script *s, Variable *v, const double *value, size_t n, SrcLoc loc)
{
  if (v->list.len + n > LIMIT_LIST) {
    script__error(s, loc, "this list would have %zu members (the limit is %d)", v->list.len + n, LIMIT_LIST);
    return false;
  }
  if (!script__charge(s, n / 8, loc)) return false;
  s->held -= v->list.cap * sizeof(double);
  vec_reserve(&v->list, v->list.len + n);
  s->held += v->list.cap * sizeof(double);
  if (s->held > LIMIT_MEMORY) {
    script__error(s, loc, "the variables need more than %zu MB", LIMIT_MEMORY >> 20);
    s->stopped = true;
    return false;
  }
  if (n) memcpy(v->list.data + v->list.len, value, n * sizeof *value);
  v->list.len += n;
  return true;
}

bool variable__set_list(Script *s, Variable *v, const double *value, size_t n, SrcLoc loc)
{
  v->kind = VAR_LIST;
  v->text_last = false;
  v->list.len = 0;
  return variable__append(s, v, value, n, loc);
}

void variable__set_texts(Script *s, Variable *v, const char *const *text, size_t n, bool list)
{
  char **copy = mem_alloc(n * sizeof *copy);
  for (size_t i = 0; i < n; i++) {
    copy[i] = mem_strdup(text[i]);
    s->held += strlen(copy[i]) + 1;
  }
  free_texts(s, v);
  v->text = copy;
  v->ntext = (uint32_t)n;
  v->text_is_list = list;
  v->text_last = true;
}

// ---- parameters ---------------------------------------------

Parameter *script__parameter(Script *s, const char *name, bool make)
{
  while (*name == '/') name++;
  uint32_t i = names_get(&s->parameter_names, name);
  if (i != NONE) return &s->parameters.data[i];
  if (!make) return NULL;
  Parameter p = {.name = mem_strdup(name)};
  names_set(&s->parameter_names, name, (uint32_t)s->parameters.len);
  vec_push(&s->parameters, p);
  return &vec_last(&s->parameters);
}

// ---- scratch ---------------------------------------------

DoubleVec *script__take(Script *s)
{
  if (s->spare_used == s->spare.len) vec_push(&s->spare, mem_zalloc(sizeof(DoubleVec)));
  DoubleVec *v = s->spare.data[s->spare_used++];
  v->len = 0;
  return v;
}

void script__give(Script *s, DoubleVec *v)
{
  DCHECK(s->spare.data[s->spare_used - 1] == v);
  enum { KEEP = 100000 };
  if (v->cap > KEEP) vec_free(v);
  s->spare_used--;
}

char *script__path(Script *s, const char *name)
{
  const char *slash = s->file ? strrchr(s->file, '/') : NULL;
  if (name[0] == '/' || !slash) return arena_strdup(&s->temp, name);
  size_t dir = (size_t)(slash - s->file) + 1, len = strlen(name);
  char *path = arena_alloc(&s->temp, dir + len + 1);
  memcpy(path, s->file, dir);
  memcpy(path + dir, name, len);
  return path;
}
