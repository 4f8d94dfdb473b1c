// field_int.h - the records of a FieldSet, shared inside this folder
// SPDX-License-Identifier: MIT
#ifndef SIZE_FIELD_INT_H
#define SIZE_FIELD_INT_H

#include "base/map.h"
#include "base/mem.h"
#include "geom/vec.h"
#include "size/field.h"

typedef enum {
#define FIELD(kind, name, old, help) FIELD_##kind,
#include "size/field.def"
  FIELD_KINDS
} FieldKind;

typedef struct {
  double number;
  char *text;
  double *list;
  size_t nlist;
  bool given;   // set by the user
  SrcLoc loc;   // where
} FieldValue;

typedef struct {
  int id;
  FieldKind kind;
  SrcLoc loc;
  FieldValue *value; // one per option of the type
} Field;

// A view: simplices and quadrangles with a value at each corner.
typedef struct {
  uint8_t ncorner;   // 1 point, 2 segment, 3 triangle, 4 quadrangle
  uint32_t first;    // of its corners in xyz and value
} ViewElement;
typedef struct {
  char *name;
  Vec(Vec3) xyz;
  DoubleVec value;
  Vec(ViewElement) element;
} View;

struct FieldSet {
  Vec(Field) field;  // ascending ids
  Vec(View) view;
  int background;
  SrcLoc background_loc;
  int background_view; // index, or -1
  SrcLoc background_view_loc;
  IntVec layer;
  Vec(char *) text; // of files read, kept for messages
};

const FieldType *field__type(FieldKind k);
// The field of that id, or NULL. O(log n).
const Field *field__find(const FieldSet *f, int id);
// Value of an option by its current name, which must exist.
const FieldValue *field__value(const Field *f, const char *name);
double field__number(const Field *f, const char *name);

// Append a view of the $NodeData and $ElementNodeData of an ASCII MSH 2 or 4 text. False after an error, reported.
bool view__read_msh(FieldSet *f, const char *name, const char *text, size_t len, Diag *diag);

// The size that values at a place of a view stand for: a number itself, a vector's length, of a tensor (9, by rows), which is a metric,
// the smallest size. 0 for a tensor that allows any.
double size__of_value(const double *v, int n);

#endif
