// eval_int.h - the running script: its state, and what the files of the evaluator share
// SPDX-License-Identifier: MIT
//
// Evaluation reports an error with its place and goes on with 0, "" or an empty list, as the statement after
// may be sound; `faults` counts these, so that a statement can tell whether its arguments are worth acting
// on.
#ifndef SCRIPT_EVAL_INT_H
#define SCRIPT_EVAL_INT_H

#include <math.h>

#include "base/map.h"
#include "model/model_edit.h"
#include "script/limits.h"
#include "script/parse.h"
#include "script/script.h"
#include "size/field.h"

typedef enum { VAR_NONE, VAR_SCALAR, VAR_LIST } VarKind;

// What an identifier stands for. A number and a text of the same name live side by side; `text_last` says
// which was set last.
typedef struct {
  uint8_t kind;                        // VarKind
  bool text_last, text_is_list, fixed; // fixed: set from the command line
  bool reported;                       // as unknown, once
  uint32_t ntext;
  double value;   // VAR_SCALAR
  DoubleVec list; // VAR_LIST
  char **text;
  Node *macro;
} Variable;

// A named value of DefineConstant, DefineNumber and their kin.
typedef struct {
  char *name, *text; // text NULL: a number or list
  DoubleVec list;
} Parameter;

typedef Vec(const char *) TextVec;

struct Script {
  Model *model;
  Options *options;
  FieldSet *fields;
  Diag *diag;
  const ScriptHost *host;
  Words words;
  Vec(Variable) var; // by word
  Names parameter_names;
  Vec(Parameter) parameters;
  Vec(Arena) kept;        // trees that macros live in
  Vec(char *) sources;    // texts of the files read
  Arena temp;             // texts of the statement being run
  Vec(DoubleVec *) spare; // vectors for reuse
  size_t spare_used;
  ShapeVec shape_pool;
  uint32_t random[31], random_at; // of Rand
  Map reported;  // errors by place
  uint64_t work; // see LIMIT_WORK
  size_t held;   // bytes in variables, see LIMIT_MEMORY
  int depth;     // loops and macro calls open
  int calls, includes, faults;
  bool stopped, aborted; // stopped: run nothing more; aborted: leave this file
  bool exiting, volumes_noted;
  int exit_code;
  const char *file;       // the file being run
  const char *first_file; // the one that included all others
};

typedef enum { FLOW_NEXT, FLOW_RETURN, FLOW_STOP } Flow;

// ---- state (state.c) ---------------------------------------------
void script__error(Script *s, SrcLoc loc, const char *fmt, ...) PRINTF_LIKE(3, 4); // and count a fault
// Add work; false after reporting that the script does too much. What stands outside loops is free.
bool script__charge(Script *s, uint64_t work, SrcLoc loc);
Variable *script__variable(Script *s, uint32_t word);
uint32_t script__word(Script *s, const Node *name); // of NAME, DYNAME, S2N; NONE after an error
const char *script__name_text(Script *s, const Node *name);
void script__unknown(Script *s, uint32_t word, SrcLoc loc); // report an unknown variable, once each
void variable__clear(Script *s, Variable *v);
void variable__set_scalar(Script *s, Variable *v, double value);
bool variable__set_list(Script *s, Variable *v, const double *value, size_t n, SrcLoc loc);
void variable__set_texts(Script *s, Variable *v, const char *const *text, size_t n, bool list);
static inline double variable__first(const Variable *v)
{
  return v->kind == VAR_SCALAR ? v->value : v->list.len ? v->list.data[0] : 0;
}
// Append values to a list, within LIMIT_LIST and LIMIT_MEMORY.
bool variable__append(Script *s, Variable *v, const double *value, size_t n, SrcLoc loc);
Parameter *script__parameter(Script *s, const char *name, bool make);
DoubleVec *script__take(Script *s); // an empty vector; give back in reverse order
void script__give(Script *s, DoubleVec *v);
char *script__path(Script *s, const char *name); // relative to the folder of the running file; in s->temp

// ---- values (eval.c, eval_text.c, eval_call.c) ---------------------------------------------
double eval_number(Script *s, const Node *n);
void eval_list(Script *s, const Node *n, DoubleVec *out); // appends
void eval_ints(Script *s, const Node *n, int dim,
               IntVec *out); // appends; ALL: the tags of dim (dim < 0: an error)
int eval_int(Script *s, const Node *n);
Vec3 eval_vector(Script *s, const Node *n); // exactly 3
bool eval_is_text(Script *s, const Node *n);
const char *eval_text(Script *s, const Node *n); // in s->temp, or elsewhere until the statement ends
void eval_texts(Script *s, const Node *n, TextVec *out);
void eval_shapes(Script *s, const Node *shapes, ShapeVec *out);
void eval_command(Script *s, const Node *command, ShapeVec *out); // TRANSFORM EXTRUDE BOUNDARY BOOLEAN SPLIT
bool eval_tag(Script *s, const Node *n, int *tag); // false, reported, unless it is one
double call_number(Script *s, const Node *n);
void call_list(Script *s, const Node *n, DoubleVec *out);
const char *call_text(Script *s, const Node *n);
void call_texts(Script *s, const Node *n, TextVec *out);
// Apply a C format to numbers; %% and no format at all as Gmsh does.
void format_numbers(Script *s, SrcLoc loc, const char *format, const double *value, size_t n, Str *out);
double option_number(Script *s, const Node *n);
const char *option_text(Script *s, const Node *n);
bool option_is_text(Script *s, const Node *n);

// ---- structures (run_struct.c) ---------------------------------------------
// The name under which the value of S.a, of Space::S, or of a Struct S is kept; in s->temp, or the tree's.
const char *struct_name_text(Script *s, const Node *n);
Variable *struct_find(Script *s, const char *text);      // NULL if there is none of this name
bool struct_exists(Script *s, const Node *option);       // is the category of this option a Struct?
double struct_list_number(Script *s, const Node *n);     // DimNameSpace
const char *struct_list_text(Script *s, const Node *n);  // NameStruct

// ---- statements ---------------------------------------------
Flow run_statement(Script *s, const Node *n);
Flow run_block(Script *s, const Node *block);
Flow run_call(Script *s, const Node *n);
ScriptEnd run_file(Script *s, const char *path, SrcLoc from);
// Run a text that belongs to the script from now on.
ScriptEnd run_source(Script *s, const char *name, char *text, size_t len, SrcLoc from);
void run_assign(Script *s, const Node *n);
void run_constants(Script *s, const Node *n);
void run_struct(Script *s, const Node *n);
double struct_value(Script *s, const Node *n); // the same as a value: its number
void run_option(Script *s, const Node *n);
void run_print(Script *s, const Node *n);
void run_define(Script *s, const Node *n);
void run_physical(Script *s, const Node *n);
void run_embed(Script *s, const Node *n);
void run_mesh_size(Script *s, const Node *n);
void run_transfinite(Script *s, const Node *n);
void run_mesh_set(Script *s, const Node *n);
void run_periodic(Script *s, const Node *n);
void run_compound(Script *s, const Node *n);
void run_delete(Script *s, const Node *n);
void run_coherence(Script *s, const Node *n);
void run_field(Script *s, const Node *n);
void run_field_use(Script *s, const Node *n);
void run_field_option(Script *s, const Node *n);
void run_view(Script *s, const Node *n);
Flow run_command(Script *s, const Node *n);
bool script__set_option(Script *s, const char *name, SrcLoc loc, int op, double value, const char *text);
void script__sync_settings(Script *s); // the model's settings from the Geometry options

#endif
