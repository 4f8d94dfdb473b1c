// boundary_layer_int.h - chains of columns, shared by the files of the boundary layers
// SPDX-License-Identifier: MIT
#ifndef MESH_BOUNDARY_LAYER_INT_H
#define MESH_BOUNDARY_LAYER_INT_H

#include "mesh/boundary_layer.h"

typedef struct {
  DoubleVec height;  // cumulative
  DoubleVec growth;  // of each layer: logarithm of its height against the first one's
  IntVec curves, fans, excluded;
  IntVec sized;      // points with first heights of their own ...
  DoubleVec first;   // ... namely these
  DoubleVec fan_size; // of each fan point; may be shorter
  bool quads;
} LayerField;

// What stands on one node. Of a fan all columns have one base.
typedef struct {
  uint32_t curve, index;  // node `index` of the mesh of the curve-th curve
  Vec2 base, dir;         // in the plane of the face; base + s * height * dir. dir is at least a unit long: its share along the
                          // normals of the segments beside it is 1
  double s;               // share of the thickness that it takes up, in [0, 1]
  double first;           // height of its first layer, if there is room for that
  bool collapsed;         // s = 0: all its nodes are the base
  bool open;              // the end of a chain whose column is a side of what is left of the face
  uint32_t on;            // curve that it lies on, or NONE
  bool on_end;            // at the end of that curve, not its begin
} Column;

// Consecutive columns, the face on the left; a closed chain goes on from the last to the first.
typedef struct {
  Vec(Column) col;
  bool closed, dropped;
  bool quads;        // the face is to become quadrangles
  const LayerField *field;
} Chain;

// A segment of the boundary (or an embedded point, with a == b).
typedef struct {
  Vec2 a, b;
  uint32_t curve;
  bool layered;            // replaced by layers
} Wall;

typedef struct {
  size_t face;
  bool quads;
  Vec(Chain) chain;
  Vec(Wall) wall;
} FaceLayers;

struct BoundaryLayers {
  LayerField *field;
  size_t nfield;
  FaceLayers *face; // nface of them, only faces with layers
  size_t nface;
};

typedef struct {
  const Model *m;
  const Options *opt;
  BoundaryLayers *b;
  Mesh1d *curves;
  Diag *diag;
} Planner;

static inline double chain__thickness(const Chain *c) { return vec_last(&c->field->height); }
static inline size_t chain__cells(const Chain *c) { return c->closed ? c->col.len : c->col.len - 1; }
static inline Column *chain__next(const Chain *c, size_t i) { return &c->col.data[(i + 1) % c->col.len]; }
static inline Vec2 column__top(const Chain *c, const Column *k)
{
  return vec2_add(k->base, vec2_scale(k->s * chain__thickness(c), k->dir));
}

// Cumulative heights of a column that takes up the share s of the thickness: field->height.len of them. The first is `first` and the
// others grow by one law, the steeper the more room there is; where not even equal heights fit, they are all equal and less.
void column__heights(const LayerField *f, double first, double s, double *height);

// The values of a BoundaryLayer field. False if it is of no use: an error says why. To be freed either way.
bool layer_field__read(LayerField *f, const FieldSet *fields, int id, Diag *diag);
void layer_field__free(LayerField *f);

// Whether a face is to have layers, and its chains and walls (boundary_layer_plan.c).
bool layers__wanted(const Planner *p, const Face *face);
void layers__plan_face(const Planner *p, FaceLayers *f, const Face *face);

// Give every column its factor: room between walls, leaning columns, gentle slopes, and at last exact checks. Factors only
// decrease: call again after others changed them.
void layers__find_room(FaceLayers *f);
void layers__settle(FaceLayers *f);

#endif
