// model.h - the boundary representation: points, curves, loops, faces and groups, as a script makes them
// SPDX-License-Identifier: MIT
//
// Entities are known by (dimension, tag), tag > 0; each dimension has its own tag space, loops and physical groups too.
// A curve has a sense: it runs from its begin to its end point as its parameter u goes from 0 to 1; a negative curve tag
// means the curve run backwards. A loop lists signed curve tags, head to tail. A face's first loop is its outer boundary,
// the others are holes; its normal is the right-hand normal of the outer loop. Lengths are in model units, angles in
// radians. Points carry the size wanted there (lc), LC_UNSET if none.
#ifndef MODEL_MODEL_H
#define MODEL_MODEL_H

#include "base/base.h"
#include "base/diag.h"
#include "base/mem.h"
#include "geom/vec.h"

#define LC_UNSET 1e22 // Gmsh's "no size given"

// A sphere drawn in the plane of its stereographic projection: (x, y) of the plane stands for
// centre + radius (-2x, -2y, 1 - q) / (1 + q),  q = x^2 + y^2 (PolarSphere; conformal).
typedef struct {
  int tag, centre_point, pole_point;
  Vec3 centre;
  double radius;
} PolarSphere;

typedef struct {
  int tag;
  uint32_t uses; // by curves; kept by model_edit.h, as the counts below
  Vec3 xyz;
  double lc;    // > 0, or LC_UNSET
  const PolarSphere *sphere; // given by coordinates in its plane; else NULL
  SrcLoc loc;   // the statement that made it
} Point;

typedef enum {
  CURVE_LINE,      // 2 control points
  CURVE_POLYLINE,  // Line with more than 2 points; u uniform per segment
  CURVE_CIRCLE,    // {start, centre, end}, arc shorter than pi (or exactly pi, in the given plane)
  CURVE_ELLIPSE,   // {start, centre, point on the major axis, end}
  CURVE_SPLINE,    // uniform Catmull-Rom through all points
  CURVE_BSPLINE,   // cubic, uniform knots, clamped; periodic if first == last
  CURVE_BEZIER,    // one Bezier of degree n-1
  CURVE_NURBS,     // non-uniform B-spline with `knot`
} CurveType;

typedef enum { LAW_UNIFORM, LAW_PROGRESSION, LAW_BUMP, LAW_BETA } TransfiniteLaw;

// An arc  centre + cos t a + sin t b,  t from t0 to t1, up to a full turn (OpenCASCADE's circles and ellipses).
typedef struct {
  Vec3 centre, a, b;
  double t0, t1;
} Arc;

// A spline by its Bezier pieces, which cover [0, 1] between the knots; control holds npiece * (degree + 1) points.
typedef struct {
  int degree, npiece;
  bool smooth;  // degree 3, and twice differentiable where pieces meet; or one piece
  double *knot; // npiece + 1
  Vec3 *control;
} Pieces;

// Layers of an extrusion (Layers{{n..},{h..}}): counts per layer and cumulative heights, ending at 1. n == 0: none given.
typedef struct {
  int n;
  int *count;
  double *height;
  bool recombine;
} Layers;

typedef struct {
  int tag;
  CurveType type;
  int *point;             // control point tags, npoint of them
  int npoint;
  int begin, end;         // point tags
  double *knot;           // CURVE_NURBS
  int nknot;
  bool has_plane;         // Circle/Ellipse ... Plane {n}
  Vec3 plane;
  const PolarSphere *sphere; // drawn in its plane, as all its points are (never circles, ellipses); else NULL
  Arc *arc;               // CURVE_CIRCLE, CURVE_ELLIPSE given by numbers: then point is {start, end}; else NULL
  Pieces *pieces;         // part of a spline that was split (model_split_curve_at), or OpenCASCADE's spline: then point is {start, end}
  SrcLoc loc;

  // how to mesh it
  int transfinite;        // number of nodes, ends included; 0: by size
  TransfiniteLaw law;
  double coef;            // ratio, bump or beta; applies from begin to end
  int periodic_master;    // signed tag of the curve whose mesh is copied; 0: none
  const double *affine;   // periodic by this map (row-major 4x4) from master to this; NULL: by parameter
  int copy_of;            // signed tag of the curve whose mesh an extrusion with Layers copies here; 0: none
  int extruded_point;     // point tag swept to make this curve, 0: none; then `layers` may prescribe its nodes, from its begin on
  Layers layers;
  int compound;           // > 0: member of the compound curve of this index (Compound Curve {...})
  bool reverse_mesh;      // Reverse Curve
  bool degenerate;        // Degenerated Curve
  bool dissolved;         // between two faces of a Compound Surface: has no mesh (made by model_prepare)
  int joined;             // tag of the curve that this one is meshed with as one (Compound Curve), its own if it is that curve, which then
                          // runs from end to end of the chain; or 0
  void *shape;            // evaluation data of curve_*.c, made by model_prepare
  uint32_t uses, in_loops; // by faces, by loops
} Curve;

typedef struct {
  int tag;
  int *curve;             // signed curve tags, ncurve of them, head to tail after model_prepare
  int ncurve;
  bool sorted, reported, lost; // head to tail; the user was told what is wrong with it; one of its curves was deleted
  const int *wire;        // after a Boolean operation: the tags in OpenCASCADE's order, nwire of them; else NULL
  int nwire;
  SrcLoc loc;
} Loop;

typedef enum { FACE_PLANE, FACE_FILLING } FaceType; // Plane Surface; 3/4-sided Surface (Coons)

typedef enum {
  ARRANGE_LEFT, ARRANGE_RIGHT, ARRANGE_ALTERNATE_RIGHT, ARRANGE_ALTERNATE_LEFT
} TransfiniteArrangement;

typedef struct {
  int tag;
  FaceType type;
  int wire;               // the number of its first wire among OpenCASCADE's, or 0
  int *loop;              // signed loop tags (as written), nloop of them; a negative outer loop reverses the face
  int nloop;
  uint32_t uses;          // by volumes
  SrcLoc loc;

  // how to mesh it
  bool transfinite;
  int corner[4], ncorner; // point tags; 0: default
  TransfiniteArrangement arrangement;
  int smoother;           // Smoother Surface: elliptic iterations, 0: option
  bool recombine;
  double recombine_angle; // degrees, default 45
  int algorithm;          // Mesh.Algorithm for this face, 0: the option's
  int size_from_boundary; // MeshSizeFromBoundary: 0, 1, or -1 for the option's
  int extruded_curve;     // signed tag of the curve swept to make this face, 0: none; with `layers`
  int extruded_side[2];   // signed tags of the curves swept by its begin and end point (0: degenerate)
  int extruded_top;       // tag of the copy of extruded_curve at the far end
  Layers layers;
  int periodic_master;    // tag of the face whose mesh is copied (Periodic Surface); 0: none
  int copy_of;            // the same of an extrusion with Layers, whose far end this is
  const double *copy_map; // by this map (row-major 4x4) from the other face to this; NULL: as the pairs of their curves say
  int compound;
  bool reverse_mesh;      // Reverse Surface
  IntVec embedded_points, embedded_curves;

  // geometry, made by model_prepare
  const PolarSphere *sphere; // all boundary curves are on it: face_to_plane is its projection then, in units of length at the pole
  Vec3 origin, axis_u, axis_v, normal; // orthonormal frame of the face's plane; (0,0,0),x,y,z when it lies in z = 0
                                       // (a clockwise outer loop there has normal -z, axis_u = x and axis_v = -y)
  int united;             // tag of the face that this one is meshed with as one (Compound Surface), its own if it is that face; or 0
  bool planar;            // all boundary points are in that plane within Geometry.Tolerance
} Face;

// A physical group. Its tag space is per dimension. name is NULL when it has none.
typedef struct {
  int dim, tag;
  char *name;
  IntVec entity;          // tags, negative where the user wrote so (elements reversed on saving)
  SrcLoc loc;
} Group;

typedef struct Model Model;

// ---- life -------------------------------------------------------------------------------------------------------
Model *model_new(void);
void model_free(Model *m);
// Curve `shape`s, face frames, planarity, loops sorted and closed, groups checked: everything the mesher needs. To be called
// after the last change and before evaluating curves; errors (open loop with the gap's coordinates, unknown entities,
// arcs that are none, ...) are reported with the statement's place. tolerance: Geometry.Tolerance. Returns false if there
// was an error. O(n log n). May be called again after further changes.
bool model_prepare(Model *m, double tolerance, Diag *diag);
// Has an edit since then taken away what curves of a Compound Curve are evaluated with?
bool model_needs_prepare(const Model *m);

// ---- reading ------------------------------------------------------------------------------------------------------
// All entities of a kind in ascending order of tag: n and the k-th. Pointers stay valid until the next change of the model.
size_t model_points(const Model *m);
Point *model_point_at(const Model *m, size_t k);
size_t model_curves(const Model *m);
Curve *model_curve_at(const Model *m, size_t k);
size_t model_loops(const Model *m);
Loop *model_loop_at(const Model *m, size_t k);
size_t model_faces(const Model *m);
Face *model_face_at(const Model *m, size_t k);
// By tag; sign ignored. NULL if there is none. O(1).
Point *model_point(const Model *m, int tag);
Curve *model_curve(const Model *m, int tag);
Loop *model_loop(const Model *m, int tag);
Face *model_face(const Model *m, int tag);
// Groups ordered by (dim, tag).
size_t model_groups(const Model *m);
Group *model_group_at(const Model *m, size_t k);
Group *model_group(const Model *m, int dim, int tag);

// Bounding box of all geometry (points used by nothing included), as Gmsh takes it for its default size; empty if no entity.
Box3 model_bounds(const Model *m);

// Signed curve tags of a face: outer loop first, as sorted and with its sign applied, then the holes the other way round (as
// Gmsh lists them; a negative sign turns a hole back). The arrays belong to the
// caller (vec_free) and are overwritten. `start` gets the index at which each closed loop begins and the total: start.len - 1 closed loops (more
// than nloop where one Loop lists several closed ones; then the one around the others comes first).
void face_boundary(const Model *m, const Face *f, IntVec *curve, IntVec *start);

// The curves that bound f and all faces united with it, but for those that dissolve: loop after loop,
// and then those that are between united faces and stay, forth and back. O(faces + curves squared).
void face_boundary_united(const Model *m, const Face *f, IntVec *curve);

// ---- curves as maps from u in [0,1] (curve.c) ----------------------------------------------------------------------
// Position and derivatives with respect to u. Exact formulas; O(1) after model_prepare (Bezier O(n)). At u = 0 and 1 the
// position is the end points' own, bit for bit.
Vec3 curve_point(const Model *m, const Curve *c, double u);
Vec3 curve_deriv(const Model *m, const Curve *c, double u);
Vec3 curve_deriv2(const Model *m, const Curve *c, double u);
double curve_curvature(const Model *m, const Curve *c, double u); // |x' x x''| / |x'|^3, 0 where x' = 0
double curve_length(const Model *m, const Curve *c);              // to 1e-12 relative or better
Box3 curve_bounds(const Model *m, const Curve *c);                // exact up to rounding
// Parameter of the point of c nearest to p (global minimum to 1e-12 of the curve's length).
double curve_nearest(const Model *m, const Curve *c, Vec3 p);
// True when the curve is one straight segment, whatever its type.
bool curve_is_straight(const Model *m, const Curve *c);
double curve_angle(const Model *m, const Curve *c); // of circle and ellipse arcs, radians; 0 for others

// ---- the plane of a face ---------------------------------------------------------------------------------------------
static inline Vec3 polar_point(const PolarSphere *s, Vec2 p)
{
  double q = p.x * p.x + p.y * p.y, f = s->radius / (1 + q);
  return (Vec3){s->centre.x - 2 * f * p.x, s->centre.y - 2 * f * p.y, s->centre.z + f * (1 - q)};
}
static inline Vec2 polar_plane(const PolarSphere *s, Vec3 x) // x need not be on the sphere: the ray from the centre counts
{
  Vec3 d = vec3_sub(x, s->centre);
  double w = -1 / (vec3_length(d) + d.z);
  return (Vec2){w * d.x + 0.0, w * d.y + 0.0};
}
// On a sphere the plane is conformal only: this many times a length there is the length in the plane. 1 for plane faces.
static inline double face_plane_scale(const Face *f, Vec2 q)
{
  return f->sphere ? 1 + (q.x * q.x + q.y * q.y) / (4 * f->sphere->radius * f->sphere->radius) : 1;
}
static inline Vec2 face_to_plane(const Face *f, Vec3 p)
{
  if (f->sphere) return vec2_scale(2 * f->sphere->radius, polar_plane(f->sphere, p));
  Vec3 d = vec3_sub(p, f->origin);
  return (Vec2){vec3_dot(d, f->axis_u), vec3_dot(d, f->axis_v)};
}
static inline Vec3 face_from_plane(const Face *f, Vec2 q)
{
  if (f->sphere) return polar_point(f->sphere, vec2_scale(0.5 / f->sphere->radius, q));
  return vec3_add(f->origin, vec3_add(vec3_scale(q.x, f->axis_u), vec3_scale(q.y, f->axis_v)));
}

// FACE_FILLING: signed tags of its 3 or 4 sides, head to tail. The corner where the first begins has no side when they are 3.
int face_filling_sides(const Model *m, const Face *f, int side[4]);
// The Coons patch of the sides: s runs along the first, t along the second; with 3 sides s = 0 is the corner.
Vec3 face_filling_point(const Model *m, const Face *f, double s, double t);

#endif
