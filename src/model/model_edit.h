// model_edit.h - changing the model: what the statements of a script do to it
// SPDX-License-Identifier: MIT
//
// Tags come out as Gmsh gives them, since scripts rely on them. Every change takes the place of the statement and reports
// the user's mistakes there; it returns false (or 0) after an error, and the model is as before. What was refused is
// remembered, so that statements that mention it later are refused without a second message.
#ifndef MODEL_MODEL_EDIT_H
#define MODEL_MODEL_EDIT_H

#include "model/model.h"

// ---- settings: the Geometry.* options that change what statements do; the caller sets them as the script does --------
typedef struct {
  double tolerance;        // Geometry.Tolerance, 1e-8; coincidence of points for coherence
  int auto_coherence;      // Geometry.AutoCoherence, 1: coherence after every transform and extrusion
  bool old_newreg;         // Geometry.OldNewReg, 1: one number series for curves, loops, faces, ... and groups
  bool copy_meshing;       // Geometry.CopyMeshingMethod, 0: Duplicata copies mesh attributes
  bool return_lateral;     // Geometry.ExtrudeReturnLateralEntities, 1
  int spline_points;       // Geometry.ExtrudeSplinePoints, 5
  bool opencascade;        // SetFactory("OpenCASCADE"): tags taken by statements themselves count per dimension, copies of
                           // a surface share their ends, no coherence after transforms
} ModelSettings;
ModelSettings *model_settings(Model *m);

// ---- lists of shapes --------------------------------------------------------------------------------------------------
typedef struct {
  int dim, tag; // dim 0..3; a curve's or face's tag may be negative where orientation matters
} Shape;
typedef Vec(Shape) ShapeVec;

// Append all tags of a dimension (0..3) in ascending order: `Curve{:}`.
void model_all(const Model *m, int dim, IntVec *out);
bool model_has(const Model *m, int dim, int tag); // sign ignored

// ---- tags ---------------------------------------------------------------------------------------------------------------
typedef enum { KIND_POINT, KIND_CURVE, KIND_LOOP, KIND_FACE, KIND_SURFACE_LOOP, KIND_VOLUME, KIND_GROUP, KIND_COUNT } Kind;
int model_max_tag(const Model *m, Kind k);
void model_set_max_tag(Model *m, Kind k, int tag); // SetMaxTag
// newp, newc, newll, news, newsl, newv; KIND_GROUP: newreg. By settings.old_newreg.
int model_new_tag(const Model *m, Kind k);

// ---- making -------------------------------------------------------------------------------------------------------------
// The tag given must be >= 0 and new, or -1 for the next one. They return the tag, or -1 after an error.
int model_add_point(Model *m, int tag, Vec3 xyz, double lc, SrcLoc loc, Diag *diag); // lc <= 0: none
// PolarSphere(tag) = {centre, pole}: from now on the first two coordinates of points are those of its plane. Returns tag or -1.
int model_set_polar_sphere(Model *m, int tag, int centre, int pole, SrcLoc loc, Diag *diag);
bool model_has_polar_sphere(const Model *m);
// type as written: CURVE_LINE with more than 2 points becomes CURVE_POLYLINE; CURVE_ELLIPSE with 3 points has its start on the
// major axis. plane: NULL, or the normal of `Plane {..}`. knot: only for CURVE_NURBS.
int model_add_curve(Model *m, CurveType type, int tag, const int *point, size_t npoint, const Vec3 *plane,
                    const double *knot, size_t nknot, SrcLoc loc, Diag *diag);
// Compound Spline|BSpline(tag) = {curves} Using n: a spline through n samples a curve (adds the points).
int model_add_compound_spline(Model *m, CurveType type, int tag, const int *curve, size_t ncurve, int samples, SrcLoc loc,
                              Diag *diag);
// Curves may be listed in any order, and may be made after the loop (an unknown one is an error once a face uses the loop).
int model_add_loop(Model *m, int tag, const int *curve, size_t ncurve, SrcLoc loc, Diag *diag);
int model_add_face(Model *m, FaceType type, int tag, const int *loop, size_t nloop, SrcLoc loc, Diag *diag);
// OpenCASCADE's plane shapes, with its tags (points and curves of their own; -1 or the tag given is the face's or the curve's).
// Rectangle: lower left corner, sizes of any sign but 0, radius of the corners or 0. Disk: one closed curve.
int model_add_rectangle(Model *m, int tag, Vec3 corner, double dx, double dy, double radius, SrcLoc loc, Diag *diag);
int model_add_disk(Model *m, int tag, Vec3 centre, double rx, double ry, SrcLoc loc, Diag *diag);
// Circle/Ellipse(tag) = {x, y, z, r | rx, ry, from, to}: an arc in the plane z, counter-clockwise, of up to 2 pi (then closed); or the
// same arc run backwards.
int model_add_arc(Model *m, int tag, Vec3 centre, double rx, double ry, double from, double to, bool backwards, SrcLoc loc,
                  Diag *diag);
// Three-dimensional things: kept for tags, boundaries and groups; never meshed.
int model_add_surface_loop(Model *m, int tag, const int *face, size_t nface, SrcLoc loc, Diag *diag);
int model_add_volume(Model *m, int tag, const int *surface_loop, size_t n, SrcLoc loc, Diag *diag);
size_t model_volumes(const Model *m);

// ---- physical groups ---------------------------------------------------------------------------------------------------
typedef enum { GROUP_SET, GROUP_ADD, GROUP_REMOVE } GroupOp;
// Physical Point|Curve|Surface|Volume (dim 0..3) of `tag` (or -1 with a name: the group of that name, or a new one) =, +=, -= a list of
// signed tags. name may be NULL. Returns the tag, or -1 after an error. Unknown members are reported by model_prepare.
int model_group_edit(Model *m, int dim, int tag, const char *name, GroupOp op, const int *entity, size_t n, SrcLoc loc,
                     Diag *diag);
// Members of a group, `Physical Curve{3}` as a list or in a list of shapes; false if there is no such group.
bool model_group_members(const Model *m, int dim, int tag, IntVec *out);
void model_delete_groups(Model *m);                       // Delete Physicals

// ---- transforms ---------------------------------------------------------------------------------------------------------
typedef struct {
  double m[16]; // row-major 4x4, last row 0 0 0 1
} Affine;
Affine affine_translation(Vec3 d);
Affine affine_rotation(Vec3 axis, Vec3 centre, double angle); // right-handed; axis need not be of unit length
Affine affine_symmetry(double a, double b, double c, double d); // at the plane ax + by + cz + d = 0
Affine affine_dilation(Vec3 centre, Vec3 factor);
Vec3 affine_apply(const Affine *a, Vec3 p);
// Move the points under the shapes, each once; then coherence (settings). Linear in the shapes, plus coherence's n log n.
bool model_transform(Model *m, const Shape *shape, size_t n, const Affine *a, SrcLoc loc, Diag *diag);
// Duplicata: append the copies to out, in order. No coherence.
bool model_duplicate(Model *m, const Shape *shape, size_t n, ShapeVec *out, SrcLoc loc, Diag *diag);
// Merge equal points, curves, faces; the lowest tag survives, also in groups. O(n log n).
void model_coherence(Model *m, Diag *diag);
// Move the points to where the first is, then coherence. False (reported) if one does not exist.
bool model_join_points(Model *m, const int *point, size_t n, SrcLoc loc, Diag *diag);

// ---- Boolean operations on plane faces -----------------------------------------------------------------------------------
typedef enum { BOOLEAN_UNION, BOOLEAN_INTERSECTION, BOOLEAN_DIFFERENCE, BOOLEAN_FRAGMENTS } BooleanOp;
typedef struct {
  const Shape *shape; // faces of one plane; for fragments curves in it too
  size_t n;
  bool drop;          // Delete: the shapes go, with what of their boundaries nothing else uses
} BooleanSide;
// Append the faces of the result (and, of curves among the shapes, their pieces). An input that comes out as one face keeps its tag
// when it is dropped; tag: that of the first new face, or -1. Curves and points are shared by neighbours; those that are whole stay,
// with their tags. Fragments of curves alone are cut in the same way. Errors leave the model as it was.
bool model_boolean(Model *m, BooleanOp op, const BooleanSide *object, const BooleanSide *tool, int tag, ShapeVec *out, SrcLoc loc,
                   Diag *diag);
// Coherence under OpenCASCADE: all faces, or all curves where there is no face, are cut where they meet and share what is common.
// False, the model as it was: there are volumes, or (with a warning) not all are in one plane.
bool model_fragment_all(Model *m, SrcLoc loc, Diag *diag);

// ---- extrusion -----------------------------------------------------------------------------------------------------------
typedef struct {
  bool translate, rotate; // both: a screw; neither: curves along their normals in the plane, to their right, by layers in lengths
  Vec3 shift;
  Vec3 axis, centre;      // of the rotation
  double angle;
  Layers layers;          // n == 0: geometry only; copied
} Sweep;
// Append what Gmsh's Extrude returns: per shape its copy, the swept body, and (settings) the lateral ones.
bool model_extrude(Model *m, const Shape *shape, size_t n, const Sweep *sweep, ShapeVec *out, SrcLoc loc, Diag *diag);

// ---- deleting, splitting ---------------------------------------------------------------------------------------------------
// What higher entities use stays, silently, and unknown tags are ignored, as in Gmsh. recursive: boundaries too.
void model_delete(Model *m, const Shape *shape, size_t n, bool recursive);
void model_delete_all(Model *m); // Delete Model / Delete All: everything but the settings
// Delete a curve that no face uses, and let groups forget it.
void model_forget_curve(Model *m, int tag);
void model_forget_face(Model *m, int tag); // one that no volume uses
// Split Curve {tag} Point {p..}: new curves, appended to out; loops and groups follow.
bool model_split_curve(Model *m, int tag, const int *point, size_t n, IntVec *out, SrcLoc loc, Diag *diag);
// Cut a prepared curve at the parameters u[] (ascending, inside (0, 1)), where the points point[] stand (within the tolerance).
// Exact for every type of curve. The first part keeps the tag; all parts, in order, are appended to `part`. Loops, groups and
// lists of embedded curves follow; counts of a transfinite curve are shared out by length.
// What made the curve a copy of another, or another a copy of it, is dropped. The model must be prepared again. O(model).
typedef struct {
  double u;
  int point;
} CurveCut;
void model_split_curve_at(Model *m, int tag, const CurveCut *cut, size_t n, IntVec *part);
// Bound a face by other curves (signed tags, head to tail, one closed loop after the other), and embed others in it.
typedef struct {
  IntVec bounds, curves, points; // bounding curves, embedded curves and points
} FaceBoundary;
void model_set_face_boundary(Model *m, int face, const FaceBoundary *b);
// A new plane face of those curves, meshed as `face` is and in the same groups. Returns its tag.
int model_add_face_part(Model *m, int face, const FaceBoundary *b);

// ---- queries ---------------------------------------------------------------------------------------------------------------
// Boundary / CombinedBoundary of shapes. oriented: with signs (Gmsh before 4.15, and OrientedBoundary).
bool model_boundary(const Model *m, const Shape *shape, size_t n, bool combined, bool oriented, ShapeVec *out, SrcLoc loc,
                    Diag *diag);
bool model_points_of(const Model *m, const Shape *shape, size_t n, ShapeVec *out, SrcLoc loc, Diag *diag);
// Tags of a dimension whose bounding box lies in the closed box, ascending: `Curve In BoundingBox{..}`.
void model_in_box(Model *m, int dim, Box3 box, IntVec *out);
// Box around shapes; empty if they are none. False (reported) if one does not exist.
bool model_box_of(Model *m, const Shape *shape, size_t n, Box3 *box, SrcLoc loc, Diag *diag);

// ---- mesh attributes of entities; unknown tags give one warning a statement ---------------------------------------------------
void model_set_size(Model *m, const int *point, size_t n, double lc); // MeshSize {..} = lc; unknown points are ignored
// A negative curve tag inverts a progression or beta. nodes < 2 counts as 2.
bool model_set_transfinite_curve(Model *m, const int *curve, size_t n, int nodes, TransfiniteLaw law, double coef, SrcLoc loc,
                                 Diag *diag);
bool model_set_transfinite_face(Model *m, const int *face, size_t n, const int *corner, size_t ncorner,
                                TransfiniteArrangement arrangement, SrcLoc loc, Diag *diag);
bool model_set_recombine(Model *m, const int *face, size_t n, double angle, SrcLoc loc, Diag *diag); // degrees
bool model_set_smoother(Model *m, const int *face, size_t n, int iterations, SrcLoc loc, Diag *diag);
bool model_set_algorithm(Model *m, const int *face, size_t n, int algorithm, SrcLoc loc, Diag *diag);
bool model_set_size_from_boundary(Model *m, const int *face, size_t n, int value, SrcLoc loc, Diag *diag);
bool model_set_reverse(Model *m, int dim, const int *tag, size_t n, SrcLoc loc, Diag *diag); // Reverse Curve|Surface
bool model_set_degenerate(Model *m, const int *curve, size_t n, SrcLoc loc, Diag *diag);
bool model_set_compound(Model *m, int dim, const int *tag, size_t n, SrcLoc loc, Diag *diag); // Compound Curve|Surface {..}
// Periodic Curve {slave} = {master}, signed tags; affine NULL: by parameter.
bool model_set_periodic_curves(Model *m, const int *slave, const int *master, size_t n, const Affine *affine, SrcLoc loc,
                               Diag *diag);
// Periodic Surface slave {..} = master {..}; without edges the map says which curves go together.
bool model_set_periodic_face(Model *m, int slave, int master, const int *slave_edge, const int *master_edge, size_t n,
                             const Affine *affine, SrcLoc loc, Diag *diag);
// Point|Curve {..} In Surface {face}.
bool model_embed(Model *m, int dim, const int *tag, size_t n, int face, SrcLoc loc, Diag *diag);
void model_delete_embedded(Model *m, const int *face, size_t n);

#endif
