// eval_text.c - values of expressions: texts, and formats
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

#include "script/function.h"

bool eval_is_text(Script *s, const Node *n)
{
  if (n->kind == NODE_OPTION && !struct_exists(s, n)) return option_is_text(s, n);
  switch ((NodeKind)n->kind) {
  case NODE_STRING: return true;
  case NODE_CALL: {
    FunctionType t = function_at(n->op)->type;
    return t == FUNCTION_TEXT || t == FUNCTION_TEXTS;
  }
  case NODE_NAME:
  case NODE_DYNAME:
  case NODE_S2N:
  case NODE_OPTION:
  case NODE_MEMBER:
  case NODE_INDEX:
  case NODE_WHOLE: {
    const Node *name = n->kind == NODE_INDEX || n->kind == NODE_WHOLE ? n->kid[0] : n;
    uint32_t word = script__word(s, name);
    if (word == NONE) return false;
    const Variable *v = script__variable(s, word);
    return (v->ntext || v->text_is_list) && (v->kind == VAR_NONE || v->text_last);
  }
  case NODE_LIST: return n->n && eval_is_text(s, n->kid[0]);
  case NODE_PARAMETER: return n->op;
  case NODE_SCOPED: return n->op == 2;
  case NODE_TERNARY: return eval_is_text(s, n->kid[1]);
  default: return false;
  }
}

// Only groups have names.
static const char *entity_name(Script *s, const Node *n)
{
  int dim = n->op, tag = eval_int(s, n->kid[0]->n ? n->kid[0]->kid[0] : n->kid[0]);
  const Group *g = n->flags & LIST_PHYSICAL ? model_group(s->model, dim, tag) : NULL;
  return g && g->name ? g->name : "";
}

static const char *variable_text(Script *s, const Node *name, int index)
{
  uint32_t word = script__word(s, name);
  const Variable *v = word == NONE ? NULL : script__variable(s, word);
  if (v && index >= 0 && (uint32_t)index < v->ntext) return arena_strdup(&s->temp, v->text[index]);
  if (v && v->ntext)
    script__error(s, name->loc, "'%s[%d]' does not exist: the list has %u members",
                  words_text(&s->words, word), index, v->ntext);
  else if (v && v->kind)
    script__error(s, name->loc, "'%s' is a number, a text is needed here", words_text(&s->words, word));
  else
    script__unknown(s, word, name->loc);
  return "";
}

static const char *parameter_text(Script *s, const Node *n)
{
  const char *v = eval_text(s, n->kid[0]);
  if (!n->kid[1]) return v;
  const char *name = eval_text(s, n->kid[1]);
  bool read_only = n->kid[2] && eval_number(s, n->kid[2]) != 0;
  Parameter *p = script__parameter(s, name, false);
  if (p && p->text && !read_only) return arena_strdup(&s->temp, p->text);
  if (!p) p = script__parameter(s, name, true);
  free(p->text);
  p->text = mem_strdup(v);
  return v;
}

static const char *joined(Script *s, const Node *n)
{
  TextVec parts = {0};
  eval_texts(s, n, &parts);
  Str all = {0};
  for (size_t i = 0; i < parts.len; i++) {
    if (i) str_char(&all, '\n');
    str_append(&all, parts.data[i]);
  }
  const char *text = arena_strdup(&s->temp, str_text(&all));
  str_free(&all);
  vec_free(&parts);
  return text;
}

const char *eval_text(Script *s, const Node *n)
{
  switch ((NodeKind)n->kind) {
  case NODE_STRING: return n->text;
  case NODE_NAME:
  case NODE_DYNAME:
  case NODE_S2N: return variable_text(s, n, 0);
  case NODE_INDEX: return variable_text(s, n->kid[0], eval_int(s, n->kid[1]));
  case NODE_WHOLE:
  case NODE_LIST:
    if (eval_is_text(s, n)) return joined(s, n);
    break;
  case NODE_CALL: {
    FunctionType t = function_at(n->op)->type;
    if (t == FUNCTION_TEXT) return call_text(s, n);
    if (t == FUNCTION_TEXTS) return joined(s, n);
    break;
  }
  case NODE_PARAMETER:
    if (n->op) return parameter_text(s, n);
    break;
  case NODE_MEMBER: return variable_text(s, n, 0);
  case NODE_SCOPED:
    if (n->op == 2) return struct_list_text(s, n);
    break;
  case NODE_OPTION:
    if (struct_exists(s, n)) return variable_text(s, n, 0);
    if (option_is_text(s, n)) return option_text(s, n);
    break;
  case NODE_ENTITIES: return entity_name(s, n);
  case NODE_TERNARY: return eval_text(s, n->kid[eval_number(s, n->kid[0]) != 0 ? 1 : 2]);
  default: break;
  }
  script__error(s, n->loc, "a text is needed here, not a number");
  return "";
}

void eval_texts(Script *s, const Node *n, TextVec *out)
{
  if (n->kind == NODE_CALL && function_at(n->op)->type == FUNCTION_TEXTS) {
    call_texts(s, n, out);
    return;
  }
  if (n->kind == NODE_LIST) {
    for (uint32_t i = 0; i < n->n; i++) eval_texts(s, n->kid[i], out);
    return;
  }
  if (n->kind == NODE_WHOLE) {
    uint32_t word = script__word(s, n->kid[0]);
    const Variable *v = word == NONE ? NULL : script__variable(s, word);
    if (v && (v->ntext || v->text_is_list)) {
      for (uint32_t i = 0; i < v->ntext; i++) vec_push(out, arena_strdup(&s->temp, v->text[i]));
      script__charge(s, v->ntext, n->loc);
      return;
    }
  }
  vec_push(out, eval_text(s, n));
}

// ---- formats ---------------------------------------------

// One conversion at f[0] == '%'. Returns past it, NULL if it is none that numbers can have, or f if it is too wide.
static const char *convert(const char *f, double v, Str *out)
{
  char spec[32];
  size_t n = 0;
  const char *p = f + 1;
  spec[n++] = '%';
  while (*p && strchr("-+ #0", *p) && n < 8) spec[n++] = *p++;
  int width = 0, precision = 0;
  while (*p >= '0' && *p <= '9' && width < 1000) width = 10 * width + (spec[n++] = *p++) - '0';
  if (*p == '.') {
    spec[n++] = *p++;
    while (*p >= '0' && *p <= '9' && precision < 1000) precision = 10 * precision + (spec[n++] = *p++) - '0';
  }
  if (width > 500 || precision > 100) return f;
  while (*p == 'l' || *p == 'h') p++;
  if (*p && strchr("gGeEfFaA", *p)) {
    spec[n++] = *p;
    spec[n] = 0;
    char text[1024];
    snprintf(text, sizeof text, spec, v);
    str_append(out, text);
    return p + 1;
  }
  if (*p && strchr("diuxXo", *p)) { // Gmsh prints garbage for these
    spec[n++] = 'l';
    spec[n++] = 'l';
    spec[n++] = *p;
    spec[n] = 0;
    char text[1024];
    long long i = fabs(v) < 9e18 ? (long long)v : 0;
    snprintf(text, sizeof text, spec, i);
    str_append(out, text);
    return p + 1;
  }
  return NULL;
}

void format_numbers(Script *s, SrcLoc loc, const char *format, const double *value, size_t n, Str *out)
{
  size_t used = 0;
  bool any = false;
  for (const char *f = format; *f;) {
    if (*f != '%') {
      const char *next = strchr(f, '%');
      size_t len = next ? (size_t)(next - f) : strlen(f);
      str_append_n(out, f, len);
      f += len;
      continue;
    }
    if (f[1] == '%') {
      str_char(out, '%');
      f += 2;
      continue;
    }
    any = true;
    if (used == n && n) {
      script__error(s, loc, "too few numbers for this format: %zu given", n);
      return;
    }
    const char *next = n ? convert(f, value[used++], out) : NULL;
    if (next == f) {
      script__error(s, loc, "this format has a number wider than 500 characters or with more than 100 digits");
      return;
    }
    if (!next) { // Gmsh prints it as it is, or garbage
      if (n)
        diag_warning(s->diag, loc, "'%%%c' in this format is not for numbers, and stays as it is; %%g, %%e and %%f are", f[1] ? f[1] : ' ');
      else if (f[1] && strchr("gGeEfFaAdiuxXo", f[1]))
        diag_warning(s->diag, loc, "no numbers for this format: '%%%c' stays as it is", f[1]);
      str_char(out, '%');
      next = f + 1;
    }
    f = next;
  }
  if (!any) {
    for (size_t i = 0; i < n && out->len < LIMIT_STRING; i++) str_printf(out, " [%zu]%g", i, value[i]);
  } else if (used < n) {
    script__error(s, loc, "too many numbers for this format: it uses %zu of %zu", used, n);
  }
}
