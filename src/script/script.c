// script.c - the script as a whole: life, values from the command line, printing
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/script.h"

#include "script/eval_int.h"

Script *script_new(Model *model, Options *options, FieldSet *fields, Diag *diag, const ScriptHost *host)
{
  Script *s = mem_zalloc(sizeof *s);
  s->model = model;
  s->options = options;
  s->fields = fields;
  s->diag = diag;
  s->host = host;
  s->exit_code = -1;
  words_init(&s->words);
  return s;
}

void script_free(Script *s)
{
  if (!s) return;
  for (size_t i = 0; i < s->var.len; i++) variable__clear(s, &s->var.data[i]);
  for (size_t i = 0; i < s->parameters.len; i++) {
    free(s->parameters.data[i].name);
    free(s->parameters.data[i].text);
    vec_free(&s->parameters.data[i].list);
  }
  for (size_t i = 0; i < s->kept.len; i++) arena_free(&s->kept.data[i]);
  for (size_t i = 0; i < s->sources.len; i++) free(s->sources.data[i]);
  for (size_t i = 0; i < s->spare.len; i++) {
    vec_free(s->spare.data[i]);
    free(s->spare.data[i]);
  }
  names_free(&s->parameter_names);
  vec_free(&s->parameters);
  vec_free(&s->var);
  vec_free(&s->kept);
  vec_free(&s->sources);
  vec_free(&s->spare);
  words_free(&s->words);
  map_free(&s->reported);
  arena_free(&s->temp);
  free(s);
}

ScriptEnd script_run_file(Script *s, const char *path)
{
  if (s->exiting) return SCRIPT_EXIT;
  return run_file(s, path, NO_LOC);
}

ScriptEnd script_run_text(Script *s, const char *name, const char *text, size_t len)
{
  if (s->exiting) return SCRIPT_EXIT;
  char *copy = mem_alloc(len + 1);
  memcpy(copy, text, len);
  copy[len] = 0;
  return run_source(s, name, copy, len, NO_LOC);
}

int script_exit_code(const Script *s) { return s->exit_code; }

// -setnumber and its kin: what kind of thing the name is.
typedef enum { NAME_OPTION, NAME_PARAMETER, NAME_VARIABLE } NameKind;

static NameKind kind_of_name(const char *name)
{
  return strchr(name, '/') ? NAME_PARAMETER : strchr(name, '.') ? NAME_OPTION : NAME_VARIABLE;
}

static bool set_option_by_name(Script *s, const char *name, double value, const char *text)
{
  char plain[200]; // View[0].Visible is View.Visible
  size_t n = 0;
  bool index = false;
  for (const char *p = name; *p && n + 1 < sizeof plain; p++) {
    index = *p == '[' || (index && *p != ']');
    if (!index && *p != ']') plain[n++] = *p;
  }
  plain[n] = 0;
  return script__set_option(s, plain, NO_LOC, '=', value, text);
}

static Variable *fixed_variable(Script *s, const char *name)
{
  uint32_t word = words_intern(&s->words, name, strlen(name));
  if (word == NONE || keyword_reserved(word) || !*name) {
    script__error(s, NO_LOC, "'%s' cannot be the name of a variable", name);
    return NULL;
  }
  Variable *v = script__variable(s, word);
  v->fixed = true;
  return v;
}

bool script_set_list(Script *s, const char *name, const double *value, size_t n)
{
  if (kind_of_name(name) == NAME_PARAMETER) {
    Parameter *p = script__parameter(s, name, true);
    vec_resize(&p->list, n);
    if (n) memcpy(p->list.data, value, n * sizeof *value);
    return true;
  }
  Variable *v = fixed_variable(s, name);
  return v && variable__set_list(s, v, value, n, NO_LOC);
}

bool script_set_number(Script *s, const char *name, double value)
{
  if (kind_of_name(name) == NAME_OPTION) return set_option_by_name(s, name, value, NULL);
  if (kind_of_name(name) == NAME_PARAMETER) return script_set_list(s, name, &value, 1);
  Variable *v = fixed_variable(s, name);
  if (v) variable__set_scalar(s, v, value);
  return v != NULL;
}

bool script_set_string(Script *s, const char *name, const char *value)
{
  if (kind_of_name(name) == NAME_OPTION) return set_option_by_name(s, name, 0, value);
  if (kind_of_name(name) == NAME_PARAMETER) {
    Parameter *p = script__parameter(s, name, true);
    free(p->text);
    p->text = mem_strdup(value);
    return true;
  }
  Variable *v = fixed_variable(s, name);
  if (v) variable__set_texts(s, v, &value, 1, false);
  return v != NULL;
}

void script_forget_variables(Script *s)
{
  for (size_t i = 0; i < s->var.len; i++) {
    Variable *v = &s->var.data[i];
    v->macro = NULL;
    if (!v->fixed) variable__clear(s, v);
  }
}

void script_dump_ast(Diag *diag, const char *name, const char *text, size_t len, Str *out)
{
  Words words;
  words_init(&words);
  Parser p;
  Arena tree = {0};
  parser_init(&p, diag, &words, diag_add_file(diag, name, text, len, NO_LOC), text, len);
  for (NextKind next = NEXT_STATEMENT; next != NEXT_END && !diag_full(diag);) {
    Node *n;
    next = parse_next(&p, &tree, &n);
    if (next == NEXT_IF || next == NEXT_ELSEIF) str_append(out, next == NEXT_IF ? "If " : "ElseIf ");
    if (next == NEXT_ELSE) str_append(out, "Else");
    if (next == NEXT_ENDIF) str_append(out, "EndIf");
    if (n) node_print(n, &words, out);
    if (next != NEXT_END) str_char(out, '\n');
    arena_reset(&tree);
  }
  arena_free(&tree);
  parser_free(&p);
  words_free(&words);
}
