// mesh1d_untangle_int.h - what the files mesh1d_untangle*.c share
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH1D_UNTANGLE_INT_H
#define MESH_MESH1D_UNTANGLE_INT_H

#include "geom/intersect.h"
#include "mesh/mesh1d_int.h"

// A plane with faces in it.
typedef struct {
  const Face *frame;
  U32Vec face, curve; // indices; curves ascending and each once
} Plane;
typedef Vec(Plane) PlaneVec;

typedef struct {
  Mesh1d *g;
  const Options *opt;
  Diag *diag;
  CurveMeetings *meet;  // where curves may be split; NULL: nowhere
  double near;          // curves nearer than this meet
  double at_end;        // a place nearer to an end than this is the end, where curves are split
  PlaneVec plane;
  U32Vec *faces_of, *bounds_of; // per curve, ascending: the faces it is on, and those of them that it bounds
  uint8_t **split;      // per curve: edges to be halved in this round, or NULL
  int reported;
} Untangler;

// ---- mesh1d_untangle_planes.c
// Fill plane, faces_of and bounds_of.
void untangle__find_planes(Untangler *t);
void untangle__free_planes(Untangler *t);
// Have two ascending lists an entry in common?
bool untangle__lists_meet(const U32Vec *x, const U32Vec *y);
// Are two curves, by their indices, on a face in common?
bool untangle__share_a_face(const Untangler *t, uint32_t a, uint32_t b);
// Whether two curves are split where they meet. Healing splits all; else embedded ones are, unless one of them would leave the face
// through the other, which bounds it.
bool untangle__may_split(const Untangler *t, uint32_t a, uint32_t b, SegMeet how);

// ---- mesh1d_untangle_curves.c
enum { UNTANGLE_MOST_REPORTED = 10 };

// A part of a curve.
typedef struct {
  const Curve *c;
  double lo, hi; // its parameters
} Piece;

// Two curves that are at the same place.
typedef struct {
  uint32_t a, b; // their indices
  SegMeet how;
  double u, v;   // their parameters there; u < 0: not known
  Vec3 at;
} Meeting;

// Do the two curves of *m meet within these pieces of theirs, elsewhere than at a common end? Then u, v and at say where.
bool untangle__pieces_meet(const Untangler *t, const Face *frame, const Piece *a, const Piece *b, Meeting *m);
// Curves that truly meet: they are noted to be split there if they may be, else it is an error. Where ends lie on the other curve,
// only that is cut.
void untangle__curves_meet(Untangler *t, const Face *frame, const Meeting *m);
// If the point lies on the curve away from its ends, the curve is to be cut there; true then.
bool untangle__meet_at_point(Untangler *t, const Curve *c, int point);
// The same of both ends of each of two curves on the other one; true if there is anything to cut.
bool untangle__meet_at_ends(Untangler *t, const Curve *a, const Curve *b);
// The same of the points that faces embed, on all their curves. O(points times curves), of boxes.
bool untangle__meet_embedded_points(Untangler *t);

static inline bool untangle__is_line(const Curve *c) { return c->type == CURVE_LINE; }

#endif
