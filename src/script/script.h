// script.h - run a .geo script: text in, calls on Model, Options and FieldSet out
// SPDX-License-Identifier: MIT
//
// A Script holds what outlives one file: the symbol table, macros, and the values given by -setnumber and its
// kin. Files run statement by statement in the order of the text. An error is reported with its place and
// parsing goes on at the next statement, until DIAG_MAX_ERRORS were given. Nothing is aborted and nothing is
// written here: the caller asks diag_errors() before it goes on.
#ifndef SCRIPT_SCRIPT_H
#define SCRIPT_SCRIPT_H

#include "base/base.h"
#include "base/diag.h"
#include "base/str.h"
#include "model/model.h"
#include "opt/options.h"

typedef struct FieldSet FieldSet;
typedef struct Script Script;

// The mesh operations a script may ask for at once, in the middle of its text.
typedef enum {
  MESH_GENERATE,    // Mesh n;            number: dimension
  MESH_REFINE,      // RefineMesh;
  MESH_BARYCENTRIC, // BarycentricRefineMesh;
  MESH_RECOMBINE,   // RecombineMesh;
  MESH_SET_ORDER,   // SetOrder n;        number: order
  MESH_OPTIMIZE,    // OptimizeMesh "x";  text: method
  MESH_RENUMBER_NODES,
  MESH_RENUMBER_ELEMENTS,
  MESH_PARTITION, // PartitionMesh n;   number: parts
  MESH_DELETE,    // Delete Meshes; Delete Mesh; Delete All;
} MeshCommand;

// What the program around the language does for it. `ctx` is passed back. A NULL member means "not possible
// here": the script's statement is then an error. Functions that return bool report their own errors (at loc)
// before returning false.
typedef struct {
  void *ctx;
  bool (*mesh)(void *ctx, MeshCommand what, double number, const char *text, SrcLoc loc);
  // Save "f"; Print "f"; the path is resolved against the script's folder.
  bool (*save)(void *ctx, const char *path, SrcLoc loc);
  // Merge of a file that is not .geo, .opt or a list of views.
  bool (*merge)(void *ctx, const char *path, SrcLoc loc);
  void (*print)(void *ctx, const char *text); // a line of Printf, without newline
  // Mesh.NbNodes and its kin, of the mesh as it is now.
  bool (*statistic)(void *ctx, const char *key, double *value);
  bool (*system)(void *ctx, const char *command, SrcLoc loc); // SystemCall; NULL unless the user allowed it
  // May a script write (Printf > file) or read back this path? NULL: only below the working folder.
  bool (*may_write)(void *ctx, const char *path);
} ScriptHost;

// How a run ended. SCRIPT_EXIT: `Exit;` or `Exit n;` was met: the program is to end now (script_exit_code).
typedef enum { SCRIPT_DONE, SCRIPT_NO_FILE, SCRIPT_EXIT } ScriptEnd;

// Nothing is copied or owned: all outlive the Script. host may be NULL (no upward calls at all). The texts of the
// files belong to the Script: keep it as long as messages with places in them may come.
Script *script_new(Model *model, Options *options, FieldSet *fields, Diag *diag, const ScriptHost *host);
void script_free(Script *s);

// Values from the command line (-setnumber NAME V and so on), by the name's form: Category.Key an option, a
// name with '/' a parameter of DefineConstant, else a variable that DefineConstant leaves alone and a plain
// assignment overrides. false after an error (unknown option, value out of range).
bool script_set_number(Script *s, const char *name, double value);
bool script_set_string(Script *s, const char *name, const char *value);
bool script_set_list(Script *s, const char *name, const double *value, size_t n);

// Forget the variables that text run so far has made (-string, -option), as opening the first file does; what
// script_set_* has set stays.
void script_forget_variables(Script *s);

// Run a file, or text under a name that messages give. Relative paths inside are resolved against the folder
// of the file that names them. SCRIPT_NO_FILE: the file could not be read, errno is set and nothing was
// reported. Linear in the text.
ScriptEnd script_run_file(Script *s, const char *path);
ScriptEnd script_run_text(Script *s, const char *name, const char *text, size_t len);
// n of `Exit n;`; -1 for `Exit;`, which leaves the choice to the caller.
int script_exit_code(const Script *s);

// Append the syntax tree of a text, one S-expression a statement; errors go to diag. For tests and -dump_ast.
void script_dump_ast(Diag *diag, const char *name, const char *text, size_t len, Str *out);

#endif
