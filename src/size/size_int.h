// size_int.h - the compiled form of fields and how one thread evaluates it, shared inside this folder
// SPDX-License-Identifier: MIT
#ifndef SIZE_SIZE_INT_H
#define SIZE_SIZE_INT_H

#include "geom/cones.h"
#include "geom/nearest.h"
#include "size/field_int.h"
#include "size/size.h"

#define NO_SIZE 1e22 // what a field says where it wants nothing

enum { BATCH = 64 }; // places evaluated together: registers of an expression then stay in the first cache

// On which entity a place lies; dim -1: unknown.
typedef struct {
  int dim, tag;
} Where;

// Up to BATCH places. `serial` is the same for the same places, for values shared between fields.
typedef struct {
  const double *x, *y, *z;
  uint64_t serial;
} Places;

typedef struct Node Node;
typedef struct FieldOps FieldOps;

struct Node {
  const Field *field;   // NULL for the background view
  const FieldOps *ops;
  uint32_t *in;         // other nodes it refers to, in the order of its options
  uint32_t nin;
  bool shared;          // referred to more than once: its values are kept
  uint32_t users, thresholds; // fields that refer to it, and Thresholds among them
  double far;           // the largest DistMax of those
  void *data;           // of its kind
};

// What a kind of field does. Evaluation writes n <= BATCH values.
struct FieldOps {
  bool (*build)(SizeField *s, Node *n, Diag *diag);                  // reads options; false after errors
  void (*eval)(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out);
  void (*release)(Node *n);                                          // NULL: nothing to release but data
  bool (*constant)(const SizeField *s, const Node *n, Where w, double *value); // NULL: varies
};

typedef struct OpenField OpenField;

struct SizeField {
  const Model *model;
  const Options *options;
  const FieldSet *fields;
  double diagonal, factor, lo, hi, per_turn, gradation;
  bool from_points, parametric;
  Node *node;           // referred-to nodes before those that refer to them
  uint32_t nnode, cap_node;
  uint32_t root;        // the background field's node, or NONE
  U32Vec curve_first, curve_list; // curves at the k-th point: curve_list[curve_first[k] .. curve_first[k+1])
  Cones *cones;         // Mesh.SizeGradation in faces; NULL: none
  // while compiling
  Map node_of;          // field id -> node
  const OpenField *open;
};

typedef struct {
  uint64_t serial;
  Where where;
  double value[BATCH];
} Memo;

// A size that is none, and where.
typedef struct {
  bool set;
  const Field *field;
  double value;
  Vec3 at;
  Where where;
} Fault;

struct SizeEval {
  const SizeField *s;
  uint64_t serial;
  Memo *memo;           // per node; allocated where shared
  uint32_t *hint;       // per node: where the last search ended
  double *stack;        // scratch: taken and given back in order
  size_t used, cap;
  Vec(double *) spare;  // older stacks still in use
  Fault fault, infinite; // the first one each
};

// Scratch of n doubles. Take `size_t mark = size__mark(e)` before and size__release(e, mark) when done, in nested order.
double *size__scratch(SizeEval *e, size_t n);
static inline size_t size__mark(const SizeEval *e) { return e->used; }
static inline void size__release(SizeEval *e, size_t mark) { e->used = mark; }

// Values of node k at count <= BATCH places.
void size__eval(SizeEval *e, uint32_t k, Where w, const Places *p, size_t count, double *out);
// Value of node k at one place.
double size__at(SizeEval *e, uint32_t k, Where w, Vec3 p);

// Build the node of a field and of all that it refers to: program.c. NONE after an error.
uint32_t size__compile(SizeField *s, int id, SrcLoc from, Diag *diag);
uint32_t size__compile_view(SizeField *s, int index, SrcLoc from, Diag *diag);
// For build functions: the node of another field, appended to n->in. False after an error (reported). Call with the node's
// index, since nodes move.
bool size__refer(SizeField *s, Node *n, int id, SrcLoc loc, Diag *diag);

// Sizes by points, curvature and D alone, before clamping.
double size__of_curve(const SizeField *s, const Curve *c, double u);

// A search tree for pieces of the model's curves (by index), to be built when they are added: pieces.c
Nearest *size__pieces_new(const Model *m);
void size__add_curve(Nearest *n, const Model *m, uint32_t k);
uint32_t size__curve_index(const Model *m, int tag); // NONE if there is none; sign ignored

// Of a symmetric 3x3 matrix given by rows of its upper half; of the absolute values if asked.
double size__largest_eigenvalue(const double m[6], bool absolute);

extern const FieldOps ops_threshold, ops_box, ops_ball, ops_cylinder, ops_frustum, ops_min, ops_max, ops_restrict, ops_constant,
    ops_mean, ops_gradient, ops_curvature, ops_laplacian, ops_hessian, ops_lonlat, ops_same, ops_math, ops_metric, ops_param,
    ops_distance, ops_extend, ops_layer, ops_attractor_aniso, ops_structured, ops_view, ops_automatic;

#endif
