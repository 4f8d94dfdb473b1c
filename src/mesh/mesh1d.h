// mesh1d.h - the nodes on every curve: by size, by law or as copies; free of crossings
// SPDX-License-Identifier: MIT
#ifndef MESH_MESH1D_H
#define MESH_MESH1D_H

#include "base/base.h"
#include "base/diag.h"
#include "geom/vec.h"
#include "model/model.h"
#include "opt/options.h"
#include "size/size.h"

// Nodes of one curve from its begin to its end point, both included: n >= 2 of them, n-1 edges, u strictly increasing from 0 to
// 1 and p[0], p[n-1] the end points' own coordinates. n == 0: the curve has no mesh (degenerate, or not longer than
// Mesh.ToleranceEdgeLength), and its ends are one place.
typedef struct {
  uint32_t n;
  double *u;  // parameters; the array has room for n
  Vec3 *p;    // positions
  double *h;  // wanted (graded) size at each node, factor included
} CurveMesh;

typedef struct {
  const Model *model;
  size_t ncurve;      // == model_curves(model)
  CurveMesh *curve;   // in the order of model_curve_at
  // what was done, for the report
  uint32_t rounds;    // of splitting crossing edges
  uint32_t nsplit;    // edges split in them
} Mesh1d;

// Mesh all curves [book §4.3]: counts and places by the size integral as Gmsh's rules have them, transfinite laws, layers of
// extrusions, copies (periodic, extruded) after their masters, even counts where faces are recombined; then crossing edges are
// split and snapped to their curves. Curves are meshed in parallel; the result does not depend on it. NULL after errors
// (crossing curves, bad periodicity, too many elements), which name the curves and their places. Free with mesh1d_free.
Mesh1d *mesh1d_new(const Model *m, const Options *opt, const SizeField *size, Diag *diag);
void mesh1d_free(Mesh1d *g); // NULL is fine

// A place where a curve has to be cut because another one (or itself) is there: at parameter u, `at`, where `point` stands if
// that is not 0.
typedef struct {
  int curve, point;
  double u;
  Vec3 at;
} CurveMeeting;
typedef Vec(CurveMeeting) CurveMeetings;

// The same, but curves that meet and may be split do not make an error: then NULL, and `meet` says where. May be split: embedded
// curves that meet each other or that touch the boundary from inside; with Mesh.Heal all.
Mesh1d *mesh1d_try(const Model *m, const Options *opt, const SizeField *size, CurveMeetings *meet, Diag *diag);

// Mesh all curves, splitting them in the model (and in the lists of curves of the fields) where they meet, until none does; at
// most Mesh.MaxRetries times. *size gets the sizes of the model as it then is (size_free), also where NULL is returned. heal.c
Mesh1d *mesh1d_heal(Model *m, const Options *opt, FieldSet *fields, SizeField **size, Diag *diag);

// Mesh of the curve of that tag (sign ignored); NULL if there is no such curve. O(1).
CurveMesh *mesh1d_curve(const Mesh1d *g, int tag);
// Index k of a curve's mesh, as in model_curve_at; NONE if there is no such curve. O(log n).
uint32_t mesh1d_index(const Mesh1d *g, int tag);

// Put a node between nodes i and i+1 of curve k at parameter u (strictly between theirs), or with u < 0 where it halves the
// edge's length along the curve. Returns its index i+1. Faces that were handed the old nodes must be told. O(n).
uint32_t mesh1d_split(Mesh1d *g, size_t k, uint32_t i, double u);

// Replace the mesh of curve k (structured meshes, boundary layers): n parameters, 0 first and 1 last. Copied.
void mesh1d_set(Mesh1d *g, size_t k, const double *u, uint32_t n);

// With Mesh.SizeGradation: let the sizes at all nodes limit those inside faces (size_limit_growth).
void mesh1d_limit_faces(const Mesh1d *g, SizeField *size);

// The transfinite laws: fill s[n] with the fractions of the length of n nodes, 0 first and 1 last. coef as on Curve.
void law_fractions(TransfiniteLaw law, double coef, uint32_t n, double *s);

// Parameters of n places on c at the fractions s[n] of its length (ascending, in [0,1]), to 1e-12 of the length.
void curve_at_fractions(const Model *m, const Curve *c, const double *s, uint32_t n, double *u);

#endif
