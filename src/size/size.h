// size.h - how large elements should be, anywhere: point sizes, curvature, fields, bounds and factor in one place
// SPDX-License-Identifier: MIT
//
//   size(entity, x) = factor * clamp(min(D, point sizes, curvature, background field at x), MeshSizeMin, MeshSizeMax)
//
// D is the diagonal of the model's box. Point sizes count on points and curves only (linear in the parameter u of a curve); in
// faces they arrive through the lengths of the boundary edges (MeshSizeExtendFromBoundary), which is the refiner's business.
#ifndef SIZE_SIZE_H
#define SIZE_SIZE_H

#include "base/base.h"
#include "base/diag.h"
#include "base/str.h"
#include "geom/vec.h"
#include "model/model.h"
#include "opt/options.h"
#include "size/field.h"

// Everything needed to evaluate, made once from a prepared model; read only afterwards, so threads may share it.
typedef struct SizeField SizeField;
// What one thread evaluates with: scratch memory, last found places, and the first fault met. Not to be shared.
typedef struct SizeEval SizeEval;

// Compile the background field and all it refers to (expressions to bytecode, distances to search trees). model, options and
// fields must outlive the result and stay as they are; fields may be NULL. NULL after errors (missing or cyclic field
// references, bad expressions, unreadable files, empty Distance), which are reported at the option's place.
SizeField *size_new(const Model *model, const Options *options, const FieldSet *fields, Diag *diag);
void size_free(SizeField *s); // NULL is fine

// What one thread needs to evaluate s, which must outlive it: several may evaluate the same s at once.
SizeEval *size_eval_new(const SizeField *s);
void size_eval_free(SizeEval *e);

// The size at a point entity, on a curve at parameter u (p = curve_point(u)), and inside a face. Always finite and > 0: where
// a field gives nan, 0 or less, that field is left out there and a fault is noted.
double size_at_point(SizeEval *e, const Point *point);
double size_on_curve(SizeEval *e, const Curve *c, double u, Vec3 p);
double size_in_face(SizeEval *e, const Face *f, Vec3 p);
// The same for n places; much faster for costly fields. u and p have n entries.
void size_on_curve_batch(SizeEval *e, const Curve *c, const double *u, const Vec3 *p, size_t n, double *h);
void size_in_face_batch(SizeEval *e, const Face *f, const Vec3 *p, size_t n, double *h);

// True when size_in_face is the same everywhere in f, which is then in *h: no field varies there, and calls can be spared.
bool size_is_constant(const SizeField *s, const Face *f, double *h);

// For callbacks of the form double (*)(void *ctx, Vec2 p): the size in the plane of a face; p in face coordinates.
typedef struct {
  SizeEval *eval;
  const Face *face;
  double constant; // 0 before the first call; then the size there if it is the same all over the face, else -1
} SizeInPlane;
double size_in_plane(void *ctx, Vec2 p); // ctx: a SizeInPlane
void size_in_plane_batch(void *ctx, const Vec2 *p, size_t n, double *h);

// Report the first fault noted since the last call (field, option's line, place), if any, and forget it. Returns true if
// there was one. For messages that do not depend on threads call it once per entity, with a child sink merged in order.
bool size_eval_report(SizeEval *e, Diag *diag);

// The same for the first place where the background field was infinite, as a division by zero makes it, and so asked for no size: a
// warning. Not "no size" (1e22).
bool size_eval_warn(SizeEval *e, Diag *diag);

bool size_has_field(const SizeField *s);  // a background field or view
double size_diagonal(const SizeField *s); // D
// Whether Mesh.SizeGradation limits sizes, and its slope alpha - 1; else 0 (curves then use SmoothRatio).
double size_gradation(const SizeField *s);

// Limit the growth of sizes inside faces too: from now on size_in_face is at most h[i] + slope * |x - p[i]| for the n places given
// (nodes of curves with their graded sizes), and for samples of the background field taken as densely as its sizes. No effect
// unless Mesh.SizeGradation is set. No evaluator may exist yet. O(n + samples), at most 2^20 of them a face.
void size_limit_growth(SizeField *s, const Vec3 *p, const double *h, size_t n);

// The face of lowest tag that contains p (on its boundary as on curves of 32 chords), or NULL: for explanations.
const Face *size_face_at(const Model *m, Vec3 p);
// Which rule fixed the size at a place of the plane of f (NULL: of any entity), as an indented text through the tree of fields.
void size_explain(SizeEval *e, const Face *f, Vec3 p, Str *out);
// The name of what gives the smallest size at p: "Field[3] (Threshold), line 12", "MeshSizeMax", ...; if points do and p is on the curve c
// (else NULL), those at its ends.
void size_responsible(SizeEval *e, const Face *f, const Curve *c, Vec3 p, Str *out);

#endif
