// model_int.h - what the files of this folder share: the tables behind a Model
// SPDX-License-Identifier: MIT
#ifndef MODEL_MODEL_INT_H
#define MODEL_MODEL_INT_H

#include "base/map.h"
#include "model/model_edit.h"

// Entities of one kind by tag. Items begin with `int tag` and never move, so pointers live until the item is removed.
// Tags near the number of items are found in an array, the others in a map.
typedef struct {
  size_t size;            // bytes of an item
  Vec(char *) chunks;
  uint32_t used;          // slots handed out
  U32Vec vacant;          // slots given back
  U32Vec dense;           // tag -> slot + 1
  Map sparse;             // tag -> slot, for tags beyond `dense`
  U32Vec order;           // slots by ascending tag, when `ordered`
  bool ordered;
  size_t live;
} Table;
enum { TABLE_CHUNK = 512, DEAD_TAG = INT32_MIN };

void table__init(Table *t, size_t size);
void table__free(Table *t);
uint32_t table__find(const Table *t, int tag);  // slot or NONE
void *table__get(const Table *t, int tag);      // item or NULL
void *table__add(Table *t, int tag);            // zeroed but for the tag, which must be new
void table__remove(Table *t, int tag);
void table__sort(Table *t);                     // make `order` valid
void *table__at(const Table *t, size_t k);      // k-th by tag
static inline void *table__slot(const Table *t, uint32_t s)
{
  return t->chunks.data[s / TABLE_CHUNK] + (size_t)(s % TABLE_CHUNK) * t->size;
}

// Slots chained by a 64-bit hash; equality is the caller's to test.
typedef struct {
  Map head;    // hash -> first slot
  U32Vec next; // by slot
} Chains;
void chains__link(Chains *c, uint64_t hash, uint32_t slot);
void chains__unlink(Chains *c, uint64_t hash, uint32_t slot);
void chains__clear(Chains *c);
uint64_t hash__mix(uint64_t h, uint64_t v);

typedef struct {
  int tag;
  int *face; // signed tags
  int nface;
  bool hidden;
  SrcLoc loc;
} SurfaceLoop;

typedef struct {
  int tag;
  int *face; // signed tags of all its boundary
  int nface;
  uint32_t uses;
  SrcLoc loc;
} Volume;

typedef struct {
  int tag;
  Vec3 xyz;
} MovedPoint;

typedef struct {
  int tag, begin, end;      // its own ends
} JoinedCurve;

// Loops of faces that no script named (copies, extrusions) have tags from here on; they count for no maximum.
enum { HIDDEN_LOOP = 1 << 30 };

typedef struct {
  int number, face;
  const int *curve;   // signed, ncurve of them, in the arena
  const SrcLoc *made; // where each was made: their numbers may be others' later
  int ncurve;
} NumberedWire;

struct Model {
  ModelSettings set;
  const PolarSphere *sphere; // in whose plane points are given now; in the arena
  Arena arena;              // control points, knots, loops
  Table point, curve, loop, hidden, face, surface_loop, volume;
  int max[KIND_COUNT];
  Vec(Group *) group[4];    // by dim, ascending tags
  Names group_name;         // "dim name" -> tag
  Map refused;              // kind << 32 | tag of what was reported and not made
  int ncompound[3];
  Vec(NumberedWire) wire;           // numbers that OpenCASCADE's shapes gave to their boundaries, ascending
  // coherence: what changed since it last ran, and the indexes of the rest
  IntVec dirty[4];          // tags of points, curves, faces, (volumes)
  IntVec changed_face;      // scratch
  IntVec pending_loop;      // loops that did not sort yet
  IntVec layered;           // curves with copy_of
  size_t nperiodic;         // curves with a periodic master
  size_t ncopied;           // at least so many faces take the mesh of another; 0: none
  Chains cell, curve_key, face_key;
  double cell_size, cell_diagonal;
  Box3 extent;              // of all points there ever were
  bool cell_on, curve_on, face_on;
  size_t nembedded, ncorners; // faces that have them
  Vec(JoinedCurve) joint;   // curves that lead a chain while prepared
  bool parted;              // there were some, and an edit came
  Vec(MovedPoint) moved;    // points that stand at the start of a closed curve while prepared; their own places
};

static inline int tag__abs(int tag) { return tag < 0 ? -tag : tag; }
static inline Point *point__get(const Model *m, int tag) { return table__get(&m->point, tag); }

const char *kind__name(Kind k);    // "point", "curve", "curve loop", "surface", ...
const char *dim__name(int dim);    // "point", "curve", "surface", "volume"
void model__note_tag(Model *m, Kind k, int tag); // raise the maximum
void model__refuse(Model *m, Kind k, int tag);
bool model__refused(const Model *m, Kind k, int tag);
// Fewer maxima after removal of `tag`: walk down to the largest one there is.
void model__recount(Model *m, Kind k);
Table *model__table(const Model *m, Kind k);
static inline Kind dim__kind(int dim)
{
  static const Kind k[4] = {KIND_POINT, KIND_CURVE, KIND_FACE, KIND_VOLUME};
  return k[dim];
}
void model__restore_points(Model *m);
void model__part_curves(Model *m); // undo model__join_curves; curves that led have no shape until they are prepared again
// Take back what preparing did to points and curves, if it did anything: edits see the model as it was written.
static inline void model__unprepare(Model *m)
{
  if (m->joint.len) model__part_curves(m);
  if (m->moved.len) model__restore_points(m);
}

int model__next_tag(const Model *m, Kind k); // of what a statement makes by itself: model_new_tag, but for OpenCASCADE
int tag__claim(Model *m, Kind k, int tag, SrcLoc loc, Diag *diag); // the tag to use, or -1 after an error

// edit.c: entities without checks, for copies and extrusions. The arrays are copied into the arena.
Point *point__make(Model *m, int tag, Vec3 xyz, double lc, SrcLoc loc);
Curve *curve__make(Model *m, int tag, CurveType type, const int *point, int npoint, int begin, int end, SrcLoc loc);
int loop__make_open(Model *m, const int *curve, int ncurve, SrcLoc loc); // curves in any order, not sorted yet
int loop__make_hidden(Model *m, const int *curve, int ncurve, SrcLoc loc);
Face *face__make(Model *m, int tag, FaceType type, const int *loop, int nloop, SrcLoc loc);
void face__copy_meshing(Face *to, const Face *from); // how to mesh, but for a structured mesh and a turned one
Volume *volume__make(Model *m, int tag, const int *face, int nface, SrcLoc loc);
void curve__drop(Model *m, int tag); // remove, with its uses of points
void face__drop(Model *m, int tag);  // remove, with its uses of curves
void face__drop_whole(Model *m, int tag); // with its loops too, but for those of other faces, where that is OpenCASCADE's way
void face__drop_loops(Model *m, Face *f); // its loops, but for named ones of other faces, and its uses of curves: it has none then
void face__count_uses(Model *m, const Face *f, int delta);
static inline int curve__from(const Model *m, int signed_tag)
{
  const Curve *c = table__get(&m->curve, tag__abs(signed_tag));
  return signed_tag < 0 ? c->end : c->begin;
}
static inline int curve__to(const Model *m, int signed_tag) // number 0 is a number: it runs forward
{
  const Curve *c = table__get(&m->curve, tag__abs(signed_tag));
  return signed_tag < 0 ? c->begin : c->end;
}

// coherence.c. Merged: old tag -> surviving signed tag of what a run removed, per dimension 0..2.
typedef struct {
  Map to[3];      // value: tag << 1 | negative
  IntVec gone[3]; // the old tags, in the order they were found
} Merged;
void merged__free(Merged *g);
int merged__tag(const Merged *g, int dim, int tag); // follows; sign kept and combined
void model__merge(Model *m, Merged *report);
void model__point_moves(Model *m, Point *p, Vec3 to); // keeps the index of places
void model__forget_point(Model *m, Point *p);
void model__forget_curve(Model *m, Curve *c);
void model__forget_face(Model *m, Face *f);
void model__index_free(Model *m);

// transform_occ.c: model_transform for OpenCASCADE, of curves and faces that there are.
// wire.c; all do nothing for the built-in kernel. note: a face gives numbers to its wires.
void wire__note(Model *m, int face);
void wire__forget(Model *m, int face);
int wire__loop(Model *m, int number, SrcLoc loc); // a hidden loop along the wire of this number, or 0
// The boundary of a face (of face_boundary) in the order in which OpenCASCADE lists its wires; and hidden loops that remember it.
void face__wires(const Model *m, const Face *f, const IntVec *curve, const IntVec *start, IntVec *out);
int *loop__make_parts(Model *m, const IntVec *curve, const IntVec *start, const IntVec *wire, SrcLoc loc); // start->len - 1 of them
bool transform__opencascade(Model *m, const Shape *shape, size_t n, const Affine *a, Diag *diag);

// extrude_occ.c: model_extrude for OpenCASCADE, of shapes that there are, by a translation or a rotation.
void extrude__opencascade(Model *m, const Shape *shape, size_t n, const Sweep *sweep, const Affine *full, const Layers *layers,
                          ShapeVec *out, SrcLoc loc, Diag *diag);

// split.c
// Put `part` (head to tail, signed) in the place of curve `tag` in loops, groups and lists of embedded curves.
void model__replace_curve(Model *m, int tag, const IntVec *part);
Pieces *pieces__through(Model *m, const Vec3 *x, int n); // twice differentiable, knots in equal steps
Pieces *pieces__copy(Model *m, const Pieces *p, bool back);

// spline.c: OpenCASCADE's Spline, BSpline or Bezier of a claimed tag, through or by points that exist. A closed BSpline begins at a new
// point. False after an error.
bool spline__add(Model *m, CurveType type, int tag, const int *point, size_t npoint, SrcLoc loc, Diag *diag);

// transform.c
void model__transform_shape(Model *m, int dim, int tag, const Affine *a);
int model__copy_point(Model *m, int tag, SrcLoc loc);
int model__copy_curve(Model *m, int signed_tag, SrcLoc loc);
int model__copy_face(Model *m, int signed_tag, SrcLoc loc);
void model__move_points(Model *m, const int *tag, size_t n, const Affine *a);

// loop.c
typedef enum { LOOP_OK, LOOP_OPEN, LOOP_UNKNOWN_CURVE } LoopState;
// Bring the curves head to tail. A curve whose sign is wrong is turned round, with a warning. When the loop does not close it
// stays as it is, and the gap is reported unless `quiet` (coherence may still close it).
LoopState loop__sort(Model *m, Loop *l, bool quiet, Diag *diag);
// Sorted once, still head to tail? Re-sorts if merged points made it possible; else reports the gap.
bool loop__verify(Model *m, Loop *l, Diag *diag);

// curve_shape.c
bool curve__build(Model *m, Curve *c, Diag *diag);
void curve__release(Curve *c);

// sphere.c
const PolarSphere *sphere__of_points(const Model *m, const int *point, int n); // of them all, or NULL

// compound.c: set Face.united and Curve.dissolved. Plane faces of one compound and one plane are united across curves that bound nothing
// else and are in no group, if they are in the same groups. tolerance: Geometry.Tolerance. O(curves * groups), if there are compounds.
void model__unite_faces(Model *m, double tolerance, Diag *diag);

bool model__same_groups(const Model *m, int dim, int a, int b); // are both in the same groups of that dimension?

// compound_curve.c: set Curve.joined, and make the leaders' shapes, ends and parameters those of their chains: curves of a Compound Curve whose
// common points bound nothing else, are needed by nothing, and that are in the same groups. O(curves * groups), if there are compounds.
void model__join_curves(Model *m, Diag *diag);

// face_plane.c
bool face__build(Model *m, Face *f, double tolerance, Diag *diag);
void plane__of_curves(const Model *m, const int *curve, size_t n, Face *frame); // built ones; only the axes of the frame are set

#endif
