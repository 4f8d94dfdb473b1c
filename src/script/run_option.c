// run_option.c - options as values and as targets of assignments
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

// "Category.Key" in two; false if that is not what it is.
static bool split(const char *name, char category[64], const char **key)
{
  const char *dot = strchr(name, '.');
  if (!dot || dot - name >= 64 || dot == name) return false;
  memcpy(category, name, (size_t)(dot - name));
  category[dot - name] = 0;
  *key = dot + 1;
  return true;
}

static const char *const categories[] = {"General",        "Geometry", "Mesh", "Solver",
                                         "PostProcessing", "View",     "Print"};

typedef enum { QUIETLY, TO_READ, TO_SET } FindMode;

static const OptRow *find(Script *s, const char *name, SrcLoc loc, FindMode report)
{
  char category[64];
  const char *key = "";
  if (!split(name, category, &key)) {
    if (report != QUIETLY) script__error(s, loc, "'%s' is not an option", name);
    return NULL;
  }
  const OptRow *row = options_find(category, key);
  if (row || report == QUIETLY) return row;
  for (size_t i = 0; i < ARRAY_LEN(categories); i++) {
    if (strcmp(category, categories[i]) != 0) continue;
    const char *near = options_nearest(category, key);
    if (!near && report == TO_SET) { // hardly a misspelling: an option of another version
      diag_warning(s->diag, loc, "unknown option '%s' is left out", name);
      return NULL;
    }
    script__error(s, loc, "unknown option '%s'%s%s%s%s%s", name, near ? "; did you mean '" : "",
                  near ? category : "", near ? "." : "", near ? near : "", near ? "'?" : "");
    return NULL;
  }
  const char *near = str_nearest(category, categories, ARRAY_LEN(categories));
  script__error(s, loc, "unknown option category '%s' in '%s'%s%s%s", category, name,
                near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
  return NULL;
}

bool option_is_text(Script *s, const Node *n)
{
  const OptRow *row = find(s, n->text, n->loc, QUIETLY);
  return row && row->kind == OPT_STR;
}

double option_number(Script *s, const Node *n)
{
  if (n->kid[0]) eval_number(s, n->kid[0]);
  const OptRow *row = find(s, n->text, n->loc, TO_READ);
  if (!row) return 0;
  double v;
  if (row->kind == OPT_STAT && s->host && s->host->statistic &&
      s->host->statistic(s->host->ctx, row->key, &v))
    return v;
  if (row->kind == OPT_STAT && !strcmp(row->category, "General")) { // the bounding box
    Box3 b = model_bounds(s->model);
    const double of[6] = {b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z};
    static const char *const keys[] = {"MinX", "MinY", "MinZ", "MaxX", "MaxY", "MaxZ"};
    for (int i = 0; i < 6; i++)
      if (!strcmp(row->key, keys[i])) return b.lo.x <= b.hi.x ? of[i] : 0;
  }
  if (row->kind == OPT_STR)
    script__error(s, n->loc, "the option '%s' is a text, a number is needed here", n->text);
  return options_get_number(s->options, row);
}

const char *option_text(Script *s, const Node *n)
{
  const OptRow *row = find(s, n->text, n->loc, TO_READ);
  if (!row) return "";
  if (!strcmp(n->text, "General.FileName") && s->first_file) return s->first_file;
  return options_get_string(s->options, row);
}

void script__sync_settings(Script *s)
{
  ModelSettings *m = model_settings(s->model);
  const Options *o = s->options;
  m->tolerance = o->Geometry_Tolerance;
  m->auto_coherence = o->Geometry_AutoCoherence;
  m->old_newreg = o->Geometry_OldNewReg;
  m->copy_meshing = o->Geometry_CopyMeshingMethod;
  m->return_lateral = o->Geometry_ExtrudeReturnLateralEntities;
  m->spline_points = o->Geometry_ExtrudeSplinePoints;
}

bool script__set_option(Script *s, const char *name, SrcLoc loc, int op, double value, const char *text)
{
  const OptRow *row = find(s, name, loc, loc.line ? TO_SET : TO_READ);
  if (!row) return false;
  if (row->kind == OPT_IGNORED && text) return true;
  if (row->kind == OPT_STR) {
    if (text) return options_set_string(s->options, row, text, loc, s->diag);
    script__error(s, loc, "the option '%s' needs a text", name);
    return false;
  }
  if (text) {
    script__error(s, loc, "the option '%s' needs a number, not a text", name);
    return false;
  }
  if (row->kind == OPT_STAT) {
    diag_warning(s->diag, loc, "'%s' can only be read; the value is left out", name); // files that list all options have these too
    return true;
  }
  double old = options_get_number(s->options, row), v = value;
  switch (op) {
  case TOK_ADD_TO: v = old + value; break;
  case TOK_SUB_FROM: v = old - value; break;
  case TOK_MUL_BY: v = old * value; break;
  case TOK_DIV_BY:
    if (value == 0) {
      script__error(s, loc, "division by zero");
      return false;
    }
    v = old / value;
    break;
  default: break;
  }
  bool ok = options_set_number(s->options, row, v, loc, s->diag);
  if (!ok) s->faults++;
  if (!strcmp(row->category, "Geometry")) script__sync_settings(s);
  return ok;
}

void run_option(Script *s, const Node *n)
{
  const Node *target = n->kid[0], *value = n->kid[1];
  if (struct_exists(s, target)) {
    script__error(s, target->loc, "the members of a Struct cannot be changed");
    return;
  }
  if (!strncmp(target->text, "View.", 5) || !strncmp(target->text, "PostProcessing.", 15) ||
      !strncmp(target->text, "Print.", 6) || !strncmp(target->text, "Solver.", 7) ||
      strstr(target->text, ".Color") ||
      strstr(target->text, "ColorTable")) // display and post-processing: of no interest, nor is the value
    return;
  if (target->kid[0]) eval_number(s, target->kid[0]);
  if (!value) {
    script__set_option(s, target->text, target->loc, TOK_ADD_TO, n->op == TOK_INC ? 1 : -1, NULL);
    return;
  }
  int faults = s->faults;
  if (eval_is_text(s, value)) {
    script__set_option(s, target->text, target->loc, '=', 0, eval_text(s, value));
    return;
  }
  double v = 0;
  if (node_is_list(value)) { // {r, g, b} and the like
    const OptRow *row = find(s, target->text, target->loc, TO_SET);
    if (row && row->kind != OPT_IGNORED)
      script__error(s, value->loc, "the option '%s' needs a number, not a list", target->text);
    return;
  }
  v = eval_number(s, value);
  if (s->faults == faults) script__set_option(s, target->text, target->loc, n->op, v, NULL);
}
