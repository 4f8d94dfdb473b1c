// run.c - running statements: control flow, macros, files
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

#include <errno.h>

#include "base/file.h"

// ---- loops, branches, macros ---------------------------------------------

Flow run_block(Script *s, const Node *block)
{
  for (uint32_t i = 0; i < block->n; i++) {
    Flow flow = run_statement(s, block->kid[i]);
    if (flow != FLOW_NEXT) return flow;
  }
  return FLOW_NEXT;
}

static Flow run_for(Script *s, const Node *n)
{
  int faults = s->faults;
  uint32_t word = n->kid[0] ? script__word(s, n->kid[0]) : NONE;
  double from = eval_number(s, n->kid[1]), to = eval_number(s, n->kid[2]);
  double step = n->kid[3] ? eval_number(s, n->kid[3]) : 1;
  if (s->faults > faults) return s->stopped ? FLOW_STOP : FLOW_NEXT;
  if (step == 0 || !isfinite(step) || !isfinite(from) || !isfinite(to)) {
    script__error(s, n->loc,
                  step == 0 ? "the step of a loop cannot be 0" : "the bounds of a loop must be finite");
    return FLOW_NEXT;
  }
  double count = floor((to - from) / step) + 1;
  if (count > LIMIT_ITERATIONS) {
    script__error(s, n->loc, "this loop would run %.0f times (the limit is %d)", count, LIMIT_ITERATIONS);
    return FLOW_NEXT;
  }
  if (word != NONE) variable__set_scalar(s, script__variable(s, word), from);
  s->depth++;
  Flow flow = FLOW_NEXT;
  for (double i = from; step > 0 ? i <= to : i >= to;) {
    if (!script__charge(s, 1, n->loc))
      flow = FLOW_STOP;
    else
      flow = run_block(s, n->kid[4]);
    if (flow != FLOW_NEXT) break;
    i += step;
    if (word == NONE) continue;
    Variable *v = script__variable(s, word); // the body may have changed it
    if (v->kind != VAR_SCALAR) variable__set_scalar(s, v, variable__first(v));
    i = v->value += step;
  }
  s->depth--;
  return flow;
}

static Flow run_if(Script *s, const Node *n)
{
  uint32_t i = 0;
  for (; i + 1 < n->n; i += 2)
    if (eval_number(s, n->kid[i]) != 0) return run_block(s, n->kid[i + 1]);
  return i < n->n ? run_block(s, n->kid[i]) : FLOW_NEXT;
}

static uint32_t macro_word(Script *s, const Node *name)
{
  if (name->kind == NODE_NAME || name->kind == NODE_DYNAME || name->kind == NODE_S2N) {
    uint32_t word = script__word(s, name);
    if (word == NONE) return NONE;
    const Variable *v = script__variable(s, word);
    if (v->macro || !v->ntext) return word;
  }
  const char *text = eval_text(s, name); // a macro may be named by a text
  return words_intern(&s->words, text, strlen(text));
}

static void run_macro(Script *s, const Node *n)
{
  uint32_t word = n->kid[0]->kind == NODE_STRING ? macro_word(s, n->kid[0]) : script__word(s, n->kid[0]);
  if (word == NONE) return;
  Variable *v = script__variable(s, word);
  if (v->macro) {
    script__error(s, n->loc, "the macro '%s' exists already", words_text(&s->words, word));
    diag_note(s->diag, v->macro->loc, "it was defined here");
    return;
  }
  v->macro = (Node *)n;
}

static void unknown_macro(Script *s, uint32_t word, SrcLoc loc)
{
  Vec(const char *) names = {0};
  for (size_t i = 0; i < s->var.len; i++)
    if (s->var.data[i].macro) vec_push(&names, words_text(&s->words, (uint32_t)i));
  const char *near = str_nearest(words_text(&s->words, word), names.data, names.len);
  script__error(s, loc, "unknown macro '%s'%s%s%s", words_text(&s->words, word),
                near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
  vec_free(&names);
}

Flow run_call(Script *s, const Node *n)
{
  enum { FRAMES = 8 };
  uint32_t word = macro_word(s, n->kid[0]);
  if (word == NONE) return FLOW_NEXT;
  const Node *macro = script__variable(s, word)->macro;
  if (!macro) {
    unknown_macro(s, word, n->kid[0]->loc);
    return FLOW_NEXT;
  }
  if (s->calls >= LIMIT_CALLS) {
    script__error(s, n->loc, "macros call one another too deeply (the limit is %d calls)", LIMIT_CALLS);
    return FLOW_STOP;
  }
  bool frame = s->calls < FRAMES;
  if (frame) {
    char what[100];
    snprintf(what, sizeof what, "macro '%.80s'", words_text(&s->words, word));
    diag_push_frame(s->diag, what, n->loc);
  }
  s->calls++;
  s->depth++;
  Flow flow = run_block(s, macro->kid[1]);
  s->depth--;
  s->calls--;
  if (frame) diag_pop_frame(s->diag);
  return flow == FLOW_RETURN ? FLOW_NEXT : flow;
}

// ---- one statement ---------------------------------------------

static void run_value(Script *s, const Node *n)
{
  ShapeVec out = {0};
  eval_command(s, n->kid[0], &out);
  vec_free(&out);
}

static void run_fault(Script *s, const Node *n)
{
  Node *fault = (Node *)n;
  if (fault->flags & FAULT_REPORTED) return;
  fault->flags |= FAULT_REPORTED;
  script__error(s, n->loc, "%s", n->text);
}

Flow run_statement(Script *s, const Node *n)
{
  if (s->stopped || s->aborted || !script__charge(s, 1, n->loc)) return FLOW_STOP;
  if (s->temp.used) arena_reset(&s->temp);
  switch ((NodeKind)n->kind) {
  case NODE_ASSIGN: run_assign(s, n); break;
  case NODE_DEFINE: run_define(s, n); break;
  case NODE_FOR: return run_for(s, n);
  case NODE_IF: return run_if(s, n);
  case NODE_BLOCK: return run_block(s, n);
  case NODE_MACRO: run_macro(s, n); break;
  case NODE_RETURN:
    if (s->calls) return FLOW_RETURN;
    script__error(s, n->loc, "this Return belongs to no Macro");
    break;
  case NODE_VALUE: run_value(s, n); break;
  case NODE_PHYSICAL: run_physical(s, n); break;
  case NODE_EMBED: run_embed(s, n); break;
  case NODE_MESH_SIZE: run_mesh_size(s, n); break;
  case NODE_TRANSFINITE: run_transfinite(s, n); break;
  case NODE_MESH_SET: run_mesh_set(s, n); break;
  case NODE_PERIODIC: run_periodic(s, n); break;
  case NODE_COMPOUND: run_compound(s, n); break;
  case NODE_DELETE: run_delete(s, n); break;
  case NODE_VISIBILITY: break; // everything is meshed, seen or not
  case NODE_COHERENCE: run_coherence(s, n); break;
  case NODE_PRINT: run_print(s, n); break;
  case NODE_FIELD: run_field(s, n); break;
  case NODE_FIELD_USE: run_field_use(s, n); break;
  case NODE_BACKGROUND_VIEW: fields_set_background_view(s->fields, eval_int(s, n->kid[0]), n->loc); break;
  case NODE_VIEW: run_view(s, n); break;
  case NODE_CONSTANTS: run_constants(s, n); break;
  case NODE_STRUCT: run_struct(s, n); break;
  case NODE_COMMAND: return run_command(s, n);
  case NODE_UNSUPPORTED:
    if (n->op)
      diag_warning(s->diag, n->loc, "%s", n->text);
    else
      script__error(s, n->loc, "%s", n->text);
    break;
  case NODE_FAULT: run_fault(s, n); break;
  default: UNREACHABLE();
  }
  return s->stopped || s->aborted ? FLOW_STOP : FLOW_NEXT;
}

// ---- files ---------------------------------------------

typedef struct {
  Script *s;
  Parser p;
  Arena tree;      // of the statement being run
  Vec(SrcLoc) ifs; // branches open at the top level
} Run;

static bool condition(Run *r, const Node *n)
{
  if (r->s->temp.used) arena_reset(&r->s->temp);
  return n && eval_number(r->s, n) != 0;
}

// Past branches that are not taken, to the first that is, or past the EndIf.
static void seek_branch(Run *r)
{
  for (;;) {
    Node *n;
    if (!parse_skip_branch(&r->p, false)) return; // the end of the text reports the open If
    switch (parse_next(&r->p, &r->tree, &n)) {
    case NEXT_ELSEIF:
      if (condition(r, n)) return;
      break;
    case NEXT_ELSE: return;
    case NEXT_ENDIF: r->ifs.len--; return;
    default: UNREACHABLE();
    }
  }
}

// A branch that was taken has ended at ElseIf or Else: past the EndIf.
static void leave_branch(Run *r)
{
  Node *n;
  if (!parse_skip_branch(&r->p, true)) return;
  parse_next(&r->p, &r->tree, &n);
  r->ifs.len--;
}

static void renew_tree(Run *r)
{
  if (!r->p.has_macro) {
    arena_reset(&r->tree);
    return;
  }
  vec_push(&r->s->kept, r->tree);
  r->tree = (Arena){0};
  r->p.has_macro = false;
}

static void run_text(Run *r)
{
  Script *s = r->s;
  while (!s->stopped && !s->aborted) {
    Node *n;
    SrcLoc at = r->p.tok.loc;
    NextKind next = parse_next(&r->p, &r->tree, &n);
    if (diag_full(s->diag) || r->p.fatal) break;
    switch (next) {
    case NEXT_STATEMENT:
      if (n)
        run_statement(s, n);
      else if (r->p.failed_word != NONE &&
               r->p.failed_word >= KW_COUNT) // x = <error>: do not complain about x again
        script__variable(s, r->p.failed_word)->reported = true;
      break;
    case NEXT_IF:
      vec_push(&r->ifs, at);
      if (!condition(r, n)) seek_branch(r);
      break;
    case NEXT_ELSEIF:
    case NEXT_ELSE:
      if (r->ifs.len)
        leave_branch(r);
      else
        script__error(s, at, "this %s has no If", next == NEXT_ELSE ? "Else" : "ElseIf");
      break;
    case NEXT_ENDIF:
      if (r->ifs.len)
        r->ifs.len--;
      else
        script__error(s, at, "this EndIf has no If");
      break;
    case NEXT_END:
      if (r->ifs.len) script__error(s, vec_last(&r->ifs), "this If has no EndIf");
      return;
    }
    renew_tree(r);
  }
  if (diag_full(s->diag) || r->p.fatal) s->stopped = true;
}

// Run a text that belongs to the script from now on.
ScriptEnd run_source(Script *s, const char *name, char *text, size_t len, SrcLoc from)
{
  vec_push(&s->sources, text);
  uint32_t file = diag_add_file(s->diag, name, text, len, from);
  char *own = mem_strdup(name);
  const char *outer = s->file, *outer_first = s->first_file;
  s->file = own;
  if (!s->first_file) s->first_file = own;
  Run r = {.s = s};
  parser_init(&r.p, s->diag, &s->words, file, text, len);
  script__sync_settings(s);
  run_text(&r);
  s->aborted = false;
  parser_free(&r.p);
  if (r.p.has_macro)
    vec_push(&s->kept, r.tree);
  else
    arena_free(&r.tree);
  vec_free(&r.ifs);
  s->file = outer;
  s->first_file = outer_first;
  free(own);
  return s->exiting ? SCRIPT_EXIT : SCRIPT_DONE;
}

ScriptEnd run_file(Script *s, const char *path, SrcLoc from)
{
  size_t len;
  char *text = file_read(path, &len);
  if (!text) return SCRIPT_NO_FILE;
  s->includes++;
  ScriptEnd end = run_source(s, path, text, len, from);
  s->includes--;
  return end;
}
