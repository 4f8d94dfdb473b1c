// field.h - size fields and views as a script declares them: types, options, references
// SPDX-License-Identifier: MIT
//
// A FieldSet only records and checks names and kinds; nothing is evaluated before size_new (size/size.h), so options may be set in
// any order and refer to fields that come later. Field ids are >= 0. Old spellings of types and options are accepted.
#ifndef SIZE_FIELD_H
#define SIZE_FIELD_H

#include "base/base.h"
#include "base/diag.h"

typedef struct FieldSet FieldSet;

FieldSet *fields_new(void);    // without fields; owned by the caller
void fields_free(FieldSet *f); // NULL is fine

// ---- fields -------------------------------------------------------------------------------------------------------
// All of these report at loc what is wrong (unknown type or option with the nearest name, id in use, wrong kind of value) and
// then return false, leaving the set as it was.
bool field_create(FieldSet *f, int id, const char *type, SrcLoc loc, Diag *diag);
bool field_set_number(FieldSet *f, int id, const char *option, double value, SrcLoc loc, Diag *diag);
bool field_set_string(FieldSet *f, int id, const char *option, const char *value, SrcLoc loc, Diag *diag);
// For options that are lists; a list of one number is also accepted for an option that is a number.
bool field_set_list(FieldSet *f, int id, const char *option, const double *value, size_t n, SrcLoc loc, Diag *diag);
bool field_delete(FieldSet *f, int id, SrcLoc loc, Diag *diag);
void fields_clear(FieldSet *f); // Delete All / Delete Model: fields and background; views stay

// The curve or surface (dim 1, 2) `tag` was cut in n parts, the first of which keeps the tag: the others join it in the lists of
// all fields.
void fields_add_parts(FieldSet *f, int dim, int tag, const int *part, size_t n);

bool field_exists(const FieldSet *f, int id); // O(log n)
int fields_max_id(const FieldSet *f); // 0 if there is none; newf is one more

// Reading back, defaults included, by current or old name. Unknown id or option: NULL, NAN, or an empty list.
const char *field_type(const FieldSet *f, int id); // current name, as "Distance" for an "Attractor"
double field_get_number(const FieldSet *f, int id, const char *option);
const double *field_get_list(const FieldSet *f, int id, const char *option, size_t *n); // owned by the set
SrcLoc field_loc(const FieldSet *f, int id);

// Background Field = id; the last one wins, -1 for none. Whether it exists is checked by size_new (a warning).
void fields_set_background(FieldSet *f, int id, SrcLoc loc);
// BoundaryLayer Field = {ids}: these too, besides those of former calls.
void fields_set_boundary_layers(FieldSet *f, const double *id, size_t n, SrcLoc loc);
size_t fields_boundary_layers(const FieldSet *f, const int **id);

// ---- views: values on points, segments, triangles, quadrangles --------------------------------------------------------
// Begin a view; elements are added to the newest. Returns its index (View[i]).
int view_begin(FieldSet *f, const char *name);
// One element of the list format: type as "ST" (S scalar, V vector, T tensor; P point, L line, T triangle, Q quadrangle, and
// the 3D ones, which are ignored), its corner coordinates x,y,z,x,y,z,... and its values (components per corner; further time
// steps follow and are ignored). Of vectors and tensors the norm is taken. False (reported) if the numbers do not fit.
bool view_add_element(FieldSet *f, const char *type, const double *xyz, size_t nxyz, const double *value, size_t nvalue,
                      SrcLoc loc, Diag *diag);
// A whole .pos text: `View "name" { ST(..){..}; ... };` any number of times, T2/T3 texts and interpolation schemes skipped. Much
// faster than parsing it as a script. Returns false after an error, reported in the file `name`.
bool views_read_pos(FieldSet *f, const char *name, const char *text, size_t len, Diag *diag);
// Background Mesh View[index].
void fields_set_background_view(FieldSet *f, int index, SrcLoc loc);
// -bgm: read a .pos or an ASCII .msh with $NodeData or $ElementNodeData, and make its last view the background. False (reported).
bool fields_read_background(FieldSet *f, const char *path, Diag *diag);

// ---- the table of types, for help and documentation -------------------------------------------------------------------
typedef enum { FIELD_NUMBER, FIELD_INTEGER, FIELD_BOOLEAN, FIELD_STRING, FIELD_PATH, FIELD_LIST } FieldOptionKind;
typedef struct {
  const char *name, *old; // current name, and old ones separated by blanks
  FieldOptionKind kind;
  double def;
  const char *text;       // default of strings
  const char *help;
} FieldOption;
typedef struct {
  const char *name, *old;
  const FieldOption *option; // noption of them
  int noption;
  const char *help;
} FieldType;

#endif
