// test_model.c - entities, tags, transforms, extrusion, coherence, groups
// SPDX-License-Identifier: MIT
//
// The tags in the tables below are those that Gmsh 4.8.4 prints for the same statements.
#include "unit.h"

#include "base/rng.h"
#include "base/str.h"
#include "model/model_check.h"
#include "model/model_edit.h"

static const double PI = 3.14159265358979323846;

typedef struct {
  Model *m;
  Diag *d;
} Fix;

static Fix setup(void) { return (Fix){model_new(), diag_new(false)}; }

static void teardown(Fix *f)
{
  model_free(f->m);
  diag_free(f->d);
}

static int point(Fix *f, int tag, double x, double y, double z)
{
  return model_add_point(f->m, tag, (Vec3){x, y, z}, 0.1, NO_LOC, f->d);
}

#define COUNT(...) (sizeof((int[]){__VA_ARGS__}) / sizeof(int))
#define CURVE(f, type, tag, ...) \
  model_add_curve((f)->m, type, tag, (int[]){__VA_ARGS__}, COUNT(__VA_ARGS__), NULL, NULL, 0, NO_LOC, (f)->d)
#define LINE(f, tag, a, b) CURVE(f, CURVE_LINE, tag, a, b)
#define LOOP(f, tag, ...) model_add_loop((f)->m, tag, (int[]){__VA_ARGS__}, COUNT(__VA_ARGS__), NO_LOC, (f)->d)
#define FACE(f, type, tag, ...) model_add_face((f)->m, type, tag, (int[]){__VA_ARGS__}, COUNT(__VA_ARGS__), NO_LOC, (f)->d)

static void expect_shapes(const ShapeVec *v, const int *dim_tag, size_t n)
{
  assert_int_equal(v->len, n);
  for (size_t i = 0; i < n; i++) {
    assert_int_equal(v->data[i].dim, dim_tag[2 * i]);
    assert_int_equal(v->data[i].tag, dim_tag[2 * i + 1]);
  }
}
#define EXPECT_SHAPES(v, ...) expect_shapes(v, (int[]){__VA_ARGS__}, COUNT(__VA_ARGS__) / 2)

static void expect_curve(const Model *m, int tag, CurveType type, const int *p, size_t n)
{
  const Curve *c = model_curve(m, tag);
  assert_non_null(c);
  assert_int_equal(c->type, type);
  assert_int_equal(c->npoint, n);
  for (size_t i = 0; i < n; i++) assert_int_equal(c->point[i], p[i]);
}
#define EXPECT_CURVE(m, tag, type, ...) expect_curve(m, tag, type, (int[]){__VA_ARGS__}, COUNT(__VA_ARGS__))

static void expect_boundary(const Model *m, int face, const int *c, size_t n)
{
  IntVec curve = {0}, start = {0};
  assert_non_null(model_face(m, face));
  face_boundary(m, model_face(m, face), &curve, &start);
  assert_int_equal(curve.len, n);
  for (size_t i = 0; i < n; i++) assert_int_equal(curve.data[i], c[i]);
  vec_free(&curve);
  vec_free(&start);
}
#define EXPECT_BOUNDARY(m, face, ...) expect_boundary(m, face, (int[]){__VA_ARGS__}, COUNT(__VA_ARGS__))

static void expect_news(const Model *m, int newp, int newl)
{
  assert_int_equal(model_new_tag(m, KIND_POINT), newp);
  assert_int_equal(model_new_tag(m, KIND_CURVE), newl);
  assert_int_equal(model_new_tag(m, KIND_FACE), newl);
  assert_int_equal(model_new_tag(m, KIND_LOOP), newl);
}

static void expect_message(const Diag *d, const char *part)
{
  for (size_t i = 0; i < diag_count(d); i++)
    if (strstr(diag_get(d, i)->text, part)) return;
  for (size_t i = 0; i < diag_count(d); i++) print_message("%s\n", diag_get(d, i)->text);
  fail_msg("no message says \"%s\"", part);
}

static Shape shape(int dim, int tag) { return (Shape){dim, tag}; }

static ShapeVec extrude(Fix *f, const Sweep *s, const Shape *list, size_t n)
{
  ShapeVec out = {0};
  assert_true(model_extrude(f->m, list, n, s, &out, NO_LOC, f->d));
  return out;
}

static Sweep shift(double x, double y, double z) { return (Sweep){.translate = true, .shift = {x, y, z}}; }
static Sweep turn(Vec3 axis, Vec3 centre, double angle)
{
  return (Sweep){.rotate = true, .axis = axis, .centre = centre, .angle = angle};
}

static void unit_square(Fix *f)
{
  point(f, 1, 0, 0, 0);
  point(f, 2, 1, 0, 0);
  point(f, 3, 1, 1, 0);
  point(f, 4, 0, 1, 0);
  for (int i = 1; i <= 4; i++) LINE(f, i, i, i % 4 + 1);
  LOOP(f, 5, 1, 2, 3, 4);
  FACE(f, FACE_PLANE, 6, 5);
}

// ---- tags -------------------------------------------------------------------------------------------------------------

static void extruded_line(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 0, 0, 0);
  point(&f, 2, 1, 0, 0);
  LINE(&f, 1, 1, 2);
  Sweep s = shift(0, 1, 0);
  ShapeVec o = extrude(&f, &s, (Shape[]){shape(1, 1)}, 1);
  EXPECT_SHAPES(&o, 1, 2, 2, 5, 1, 4, 1, -3);
  EXPECT_CURVE(f.m, 2, CURVE_LINE, 3, 4);
  EXPECT_CURVE(f.m, 3, CURVE_LINE, 1, 3);
  EXPECT_CURVE(f.m, 4, CURVE_LINE, 2, 4);
  EXPECT_BOUNDARY(f.m, 5, 1, 4, -2, -3);
  expect_news(f.m, 5, 6);
  point(&f, 99, 1, 1, 0);
  expect_news(f.m, 100, 6);
  LINE(&f, 20, 4, 99);
  model_coherence(f.m, f.d);
  expect_news(f.m, 5, 21);
  EXPECT_CURVE(f.m, 20, CURVE_LINE, 4, 4);
  vec_free(&o);
  Shape line = shape(1, 1), face = shape(2, 5);
  assert_true(model_duplicate(f.m, &line, 1, &o, NO_LOC, f.d));
  EXPECT_SHAPES(&o, 1, 21);
  expect_news(f.m, 9, 22);
  assert_true(model_duplicate(f.m, &face, 1, &o, NO_LOC, f.d));
  EXPECT_SHAPES(&o, 1, 21, 2, 22);
  expect_news(f.m, 25, 27);
  EXPECT_CURVE(f.m, 25, CURVE_LINE, 17, 18);
  EXPECT_BOUNDARY(f.m, 22, 23, 24, 25, 26);
  vec_free(&o);
  teardown(&f);
}

static void rotated_lines(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 1, 0, 0);
  point(&f, 2, 2, 0, 0);
  LINE(&f, 1, 1, 2);
  Sweep s = turn((Vec3){0, 0, 1}, (Vec3){0, 0, 0}, PI / 2);
  int count = 5;
  double height = 1;
  s.layers = (Layers){1, &count, &height, true};
  ShapeVec o = extrude(&f, &s, (Shape[]){shape(1, 1)}, 1);
  EXPECT_SHAPES(&o, 1, 2, 2, 5, 1, 4, 1, -3);
  expect_news(f.m, 9, 6);
  EXPECT_CURVE(f.m, 3, CURVE_CIRCLE, 1, 8, 3);
  EXPECT_CURVE(f.m, 4, CURVE_CIRCLE, 2, 8, 4);
  assert_int_equal(model_curve(f.m, 3)->extruded_point, 1);
  assert_int_equal(model_curve(f.m, 3)->layers.count[0], 5);
  assert_int_equal(model_curve(f.m, 2)->copy_of, 1);
  vec_free(&o);

  point(&f, 100, 0, 0, 3); // one end on the axis: a triangle
  point(&f, 101, 1, 0, 3);
  LINE(&f, 100, 100, 101);
  s.layers.n = 0;
  o = extrude(&f, &s, (Shape[]){shape(1, 100)}, 1);
  EXPECT_SHAPES(&o, 1, 101, 2, 103, 1, 102);
  EXPECT_BOUNDARY(f.m, 103, 100, 102, -101);
  vec_free(&o);

  point(&f, 200, 5, 0, 3);
  point(&f, 201, 6, 0, 3);
  LINE(&f, 200, 200, 201);
  s.translate = true; // a screw: sides are splines through five more points
  s.shift = (Vec3){0, 0, 1};
  o = extrude(&f, &s, (Shape[]){shape(1, 200)}, 1);
  EXPECT_SHAPES(&o, 1, 201, 2, 204, 1, 203, 1, -202);
  EXPECT_CURVE(f.m, 202, CURVE_SPLINE, 200, 206, 207, 208, 209, 202);
  EXPECT_CURVE(f.m, 203, CURVE_SPLINE, 201, 211, 212, 213, 214, 203);
  assert_true(fabs(model_point(f.m, 207)->xyz.x - 4.045084971874736) < 1e-14);
  assert_true(fabs(model_point(f.m, 207)->xyz.z - 3.4) < 1e-14);
  vec_free(&o);
  teardown(&f);
}

static void extruded_faces(void **state)
{
  (void)state;
  Fix f = setup();
  unit_square(&f);
  Sweep s = shift(0, 0, 1);
  ShapeVec o = extrude(&f, &s, (Shape[]){shape(2, 6)}, 1);
  EXPECT_SHAPES(&o, 2, 28, 3, 1, 2, 15, 2, 19, 2, 23, 2, 27);
  expect_news(f.m, 15, 29);
  vec_free(&o);
  s = turn((Vec3){0, 1, 0}, (Vec3){3, 0, 0}, PI / 2);
  o = extrude(&f, &s, (Shape[]){shape(2, 28)}, 1);
  EXPECT_SHAPES(&o, 2, 50, 3, 2, 2, 37, 2, 41, 2, 45, 2, 49);
  expect_news(f.m, 47, 51);
  EXPECT_CURVE(f.m, 44, CURVE_CIRCLE, 14, 46, 24);
  EXPECT_BOUNDARY(f.m, 49, 11, 35, -33, -44);
  EXPECT_BOUNDARY(f.m, 50, 30, 31, 32, 33);
  vec_free(&o);

  Shape v[] = {{3, 1}, {3, 2}}, fs[] = {{2, 6}, {2, 15}};
  assert_true(model_boundary(f.m, v, 1, false, true, &o, NO_LOC, f.d));
  EXPECT_SHAPES(&o, 2, -6, 2, 28, 2, 15, 2, 19, 2, 23, 2, 27);
  vec_free(&o);
  assert_true(model_boundary(f.m, v, 2, true, true, &o, NO_LOC, f.d));
  EXPECT_SHAPES(&o, 2, -6, 2, 15, 2, 19, 2, 23, 2, 27, 2, 37, 2, 41, 2, 45, 2, 49, 2, 50);
  vec_free(&o);
  assert_true(model_boundary(f.m, fs, 2, true, true, &o, NO_LOC, f.d));
  EXPECT_SHAPES(&o, 1, 2, 1, 3, 1, 4, 1, -8, 1, -13, 1, 14);
  vec_free(&o);
  assert_true(model_points_of(f.m, fs, 2, &o, NO_LOC, f.d));
  EXPECT_SHAPES(&o, 0, 1, 0, 2, 0, 3, 0, 4, 0, 1, 0, 2, 0, 5, 0, 6);
  vec_free(&o);
  assert_true(model_prepare(f.m, 1e-8, f.d));
  assert_true(model_face(f.m, 15)->planar);
  assert_true(model_face(f.m, 37)->planar);
  assert_false(model_face(f.m, 41)->planar);
  teardown(&f);
}

static void extruded_face_with_hole(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 1, 0, 0);
  point(&f, 2, 2, 0, 0);
  point(&f, 3, 2, 1, 0);
  point(&f, 4, 1, 1, 0);
  point(&f, 5, 1.2, .2, 0);
  point(&f, 6, 1.5, .2, 0);
  point(&f, 7, 1.5, .7, 0);
  for (int i = 1; i <= 4; i++) LINE(&f, i, i, i % 4 + 1);
  LINE(&f, 5, 5, 6);
  LINE(&f, 6, 6, 7);
  LINE(&f, 7, 7, 5);
  LOOP(&f, 1, 1, 2, 3, 4);
  LOOP(&f, 2, 5, 6, 7);
  FACE(&f, FACE_PLANE, 1, 1, 2);
  FACE(&f, FACE_PLANE, 2, -2);
  EXPECT_BOUNDARY(f.m, 1, 1, 2, 3, 4, -7, -6, -5);
  EXPECT_BOUNDARY(f.m, 2, -7, -6, -5);
  Sweep s = shift(0, 0, 1);
  ShapeVec o = extrude(&f, &s, (Shape[]){shape(2, 1), shape(2, 2)}, 2);
  EXPECT_SHAPES(&o, 2, 44, 3, 1, 2, 19, 2, 23, 2, 27, 2, 31, 2, 35, 2, 39, 2, 43, 2, 61, 3, 2, 2, 35, 2, 39, 2, 43);
  expect_news(f.m, 30, 62);
  EXPECT_BOUNDARY(f.m, 35, -7, 34, -13, -33);
  EXPECT_BOUNDARY(f.m, 44, 9, 10, 11, 12, 13, 14, 15);
  vec_free(&o);
  s = turn((Vec3){0, 1, 0}, (Vec3){0, 0, 0}, PI / 4);
  o = extrude(&f, &s, (Shape[]){shape(2, 1)}, 1);
  EXPECT_SHAPES(&o, 2, 98, 3, 3, 2, 73, 2, 77, 2, 81, 2, 85, 2, 89, 2, 93, 2, 97);
  expect_news(f.m, 98, 99);
  EXPECT_CURVE(f.m, 92, CURVE_CIRCLE, 6, 95, 51);
  assert_true(model_prepare(f.m, 1e-8, f.d));
  IntVec curve = {0}, start = {0};
  face_boundary(f.m, model_face(f.m, 98), &curve, &start);
  assert_int_equal(start.len, 3); // two closed parts in one hidden loop
  assert_int_equal(start.data[1], 4);
  vec_free(&curve);
  vec_free(&start);
  vec_free(&o);
  teardown(&f);
}

static void sweeps_that_stay(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 1, 0, 0);
  point(&f, 2, 2, 0, 0);
  point(&f, 4, 0, 0, 0);
  point(&f, 5, 0, 0, 1);
  LINE(&f, 1, 1, 2);
  LINE(&f, 50, 4, 5);
  Sweep s = turn((Vec3){0, 0, 1}, (Vec3){0, 0, 0}, PI / 2);
  ShapeVec o = extrude(&f, &s, (Shape[]){shape(1, 50), shape(0, 4)}, 2);
  EXPECT_SHAPES(&o, 1, 50, 0, 4);
  vec_free(&o);
  s = shift(0, 0, 0);
  o = extrude(&f, &s, (Shape[]){shape(1, 1)}, 1);
  EXPECT_SHAPES(&o, 1, 1);
  vec_free(&o);
  s = turn((Vec3){0, 0, 1}, (Vec3){0, 0, 0}, 4);
  Shape one = shape(1, 1);
  ShapeVec none = {0};
  assert_false(model_extrude(f.m, &one, 1, &s, &none, NO_LOC, f.d));
  expect_message(f.d, "an arc turns by pi at most");
  teardown(&f);
}

static void several_at_once(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 0, 0, 0);
  point(&f, 2, 1, 0, 1);
  point(&f, 3, 1, 1, 1);
  point(&f, 4, 0, 1, 0);
  point(&f, 5, .5, 1, 0);
  LINE(&f, 1, 1, 2);
  LINE(&f, 2, 2, 3);
  LINE(&f, 4, 4, 1);
  model_set_max_tag(f.m, KIND_POINT, 57);
  model_set_max_tag(f.m, KIND_CURVE, 98);
  int counts[2] = {2, 3};
  double heights[2] = {.5, 1};
  Sweep s = shift(0, 0, 10);
  s.layers = (Layers){2, counts, heights, true};
  ShapeVec o = extrude(&f, &s, (Shape[]){shape(1, 4), shape(1, 1), shape(0, 5)}, 3);
  EXPECT_SHAPES(&o, 1, 99, 2, 102, 1, 101, 1, -100, 1, 103, 2, 106, 1, 105, 1, -101, 0, 62, 1, 107);
  expect_news(f.m, 63, 108);
  EXPECT_CURVE(f.m, 105, CURVE_LINE, 2, 61);
  vec_free(&o);
  teardown(&f);
}

static void coherence_of_curves_and_groups(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 1, 0, 0);
  point(&f, 2, 0, 0, 0);
  point(&f, 3, -1, 0, 0);
  point(&f, 4, 0, 1, 0);
  CURVE(&f, CURVE_CIRCLE, 1, 1, 2, 3);
  CURVE(&f, CURVE_CIRCLE, 2, 1, 2, 4);
  Vec3 down = {0, 0, -1};
  model_add_curve(f.m, CURVE_CIRCLE, 3, (int[]){1, 2, 4}, 3, &down, NULL, 0, NO_LOC, f.d);
  model_add_curve(f.m, CURVE_CIRCLE, 4, (int[]){1, 2, 3}, 3, &down, NULL, 0, NO_LOC, f.d);
  CURVE(&f, CURVE_SPLINE, 5, 1, 4, 3);
  CURVE(&f, CURVE_LINE, 8, 1, 4, 3);
  CURVE(&f, CURVE_LINE, 9, 3, 4, 1);
  CURVE(&f, CURVE_SPLINE, 10, 3, 4, 1);
  CURVE(&f, CURVE_CIRCLE, 11, 4, 2, 1);
  CURVE(&f, CURVE_ELLIPSE, 13, 1, 2, 1, 4);
  CURVE(&f, CURVE_ELLIPSE, 14, 1, 2, 4);
  LOOP(&f, 32, -8, 5);
  FACE(&f, FACE_PLANE, 33, 32);
  LOOP(&f, 34, 9, 5);
  FACE(&f, FACE_PLANE, 35, 34);
  model_group_edit(f.m, 1, 1, NULL, GROUP_SET, (int[]){9, -11, 3, 10, 5}, 5, NO_LOC, f.d);
  model_group_edit(f.m, 2, 2, NULL, GROUP_SET, (int[]){33, 35}, 2, NO_LOC, f.d);
  model_coherence(f.m, f.d);
  assert_non_null(model_curve(f.m, 4)); // the other half circle (Gmsh merges it with 1)
  assert_null(model_curve(f.m, 3));
  assert_null(model_curve(f.m, 9));
  assert_null(model_curve(f.m, 14));
  assert_null(model_face(f.m, 35));
  assert_int_equal(model_faces(f.m), 1);
  const int *e = model_group(f.m, 1, 1)->entity.data;
  assert_int_equal(e[0], -8);
  assert_int_equal(e[1], 2);
  assert_int_equal(e[2], 2);
  assert_int_equal(e[3], -5);
  assert_true(model_prepare(f.m, 1e-8, f.d));
  assert_int_equal(model_group(f.m, 1, 1)->entity.len, 3); // each once
  assert_int_equal(model_group(f.m, 2, 2)->entity.len, 1);
  teardown(&f);
}

// A curve may survive as the reverse of curve 1, and layers then count from its other end.
static void merged_into_a_reverse(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 0, 0, 0);
  point(&f, 2, 0, 1, 0);
  point(&f, 3, 1, 0, 0);
  LINE(&f, 1, 2, 1); // runs against what the extrusion of point 1 will make
  int counts[2] = {2, 3};
  double heights[2] = {.25, 1};
  Sweep s = shift(0, 1, 0);
  s.layers = (Layers){2, counts, heights, false};
  LINE(&f, 5, 1, 3);
  ShapeVec o = extrude(&f, &s, (Shape[]){shape(1, 5)}, 1);
  EXPECT_BOUNDARY(f.m, o.data[1].tag, 5, o.data[2].tag, -o.data[0].tag, 1);
  const Curve *c = model_curve(f.m, 1);
  assert_int_equal(c->extruded_point, 1);
  assert_int_equal(c->layers.count[0], 3);
  assert_true(c->layers.height[0] == .75 && c->layers.height[1] == 1);
  vec_free(&o);
  teardown(&f);
}

static void coherence_tolerance(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 0, 0, 0);
  point(&f, 2, 10000, 0, 0);
  point(&f, 3, 10000, 1e-5, 0);
  point(&f, 4, 0, 1e-9, 0);
  point(&f, 5, 0, 5e-7, 0);
  LINE(&f, 1, 1, 2);
  model_coherence(f.m, f.d);
  expect_news(f.m, 3, 2);
  teardown(&f);
}

// Copies shifted side by side, one transform a copy: the grid of squares must come out conforming and in linear time.
static void coherence_is_incremental(void **state)
{
  (void)state;
  Fix f = setup();
  unit_square(&f);
  for (int i = 1; i < 300; i++) {
    ShapeVec copy = {0};
    Shape s = shape(2, 6);
    model_duplicate(f.m, &s, 1, &copy, NO_LOC, f.d);
    Affine a = affine_translation((Vec3){i, 0, 0});
    model_transform(f.m, copy.data, copy.len, &a, NO_LOC, f.d);
    vec_free(&copy);
  }
  assert_int_equal(model_faces(f.m), 300);
  assert_int_equal(model_curves(f.m), 1 + 3 * 300);
  assert_int_equal(model_points(f.m), 2 * 301);
  assert_true(model_prepare(f.m, 1e-8, f.d));
  assert_int_equal(diag_count(f.d), 0);
  teardown(&f);
}

static void deleting(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 0, 0, 0);
  point(&f, 2, 1, 0, 0);
  point(&f, 3, 1, 1, 0);
  point(&f, 40, 0, 1, 0);
  point(&f, 41, 0, 5, 0);
  LINE(&f, 1, 1, 2);
  LINE(&f, 2, 2, 3);
  LINE(&f, 3, 3, 40);
  LINE(&f, 40, 40, 1);
  model_delete(f.m, (Shape[]){{0, 41}}, 1, false);
  expect_news(f.m, 41, 41);
  model_delete(f.m, (Shape[]){{0, 40}}, 1, false); // in use
  assert_non_null(model_point(f.m, 40));
  LOOP(&f, 50, 1, 2, 3, 40);
  FACE(&f, FACE_PLANE, 60, 50);
  model_delete(f.m, (Shape[]){{1, 1}, {2, 60}}, 2, false); // the curve first: in use
  assert_non_null(model_curve(f.m, 1));
  assert_null(model_face(f.m, 60));
  FACE(&f, FACE_PLANE, 60, 50);
  model_delete(f.m, (Shape[]){{2, 60}, {2, 999}}, 2, true);
  assert_int_equal(model_curves(f.m), 0);
  assert_int_equal(model_points(f.m), 0);
  teardown(&f);
}

// A loop outlives its curve; a new curve of that tag gives it a new meaning, but nobody complains unless a surface uses it.
static void deleted_curve_in_loop(void **state)
{
  (void)state;
  Fix f = setup();
  unit_square(&f);
  model_delete(f.m, (Shape[]){{2, 6}, {1, 4}}, 2, false);
  assert_int_equal(model_new_tag(f.m, KIND_CURVE), 6);
  point(&f, 9, -1, .5, 0);
  LINE(&f, 4, 4, 9);
  LINE(&f, 10, 9, 1);
  LOOP(&f, 11, 1, 2, 3, 4, 10);
  FACE(&f, FACE_PLANE, 6, 11);
  assert_true(model_prepare(f.m, 1e-8, f.d));
  assert_int_equal(diag_count(f.d), 0);
  FACE(&f, FACE_PLANE, 7, 5);
  assert_false(model_prepare(f.m, 1e-8, f.d));
  expect_message(f.d, "curve loop 5 is not closed");
  teardown(&f);
}

static void group_tags(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 0, 0, 0);
  point(&f, 2, 1, 0, 0);
  point(&f, 3, 1, 1, 0);
  for (int i = 1; i <= 3; i++) LINE(&f, i, i, i % 3 + 1);
  int one = 1, two = 2, three = 3, minus = -3;
  Model *m = f.m;
  assert_int_equal(model_group_edit(m, 1, -1, "a", GROUP_SET, &one, 1, NO_LOC, f.d), 1);
  assert_int_equal(model_group_edit(m, 1, -1, "a", GROUP_ADD, &two, 1, NO_LOC, f.d), 1);
  assert_int_equal(model_group_edit(m, 0, -1, "a", GROUP_SET, &one, 1, NO_LOC, f.d), 3);
  assert_int_equal(model_group_edit(m, 1, -1, "b", GROUP_SET, &minus, 1, NO_LOC, f.d), 4);
  assert_int_equal(model_group_edit(m, 2, 10, "a", GROUP_SET, &one, 1, NO_LOC, f.d), 10);
  assert_int_equal(model_group_edit(m, 1, -1, "a", GROUP_REMOVE, &one, 1, NO_LOC, f.d), 1);
  assert_int_equal(model_group_edit(m, 1, -1, "c", GROUP_SET, &minus, 1, NO_LOC, f.d), 12);
  assert_int_equal(model_group_edit(m, 1, -1, "c", GROUP_REMOVE, &three, 1, NO_LOC, f.d), 12);
  assert_int_equal(model_group_edit(m, 1, -1, "d", GROUP_REMOVE, &three, 1, NO_LOC, f.d), -1);
  assert_int_equal(model_group_edit(m, 1, -1, "e", GROUP_SET, &three, 1, NO_LOC, f.d), 15);
  assert_int_equal(model_group(m, 1, 12)->entity.len, 1);
  assert_int_equal(model_group_edit(m, 1, 15, NULL, GROUP_SET, &three, 1, NO_LOC, f.d), -1);
  expect_message(f.d, "physical curve 15 exists already");
  assert_int_equal(model_group_edit(m, 1, -1, "f", GROUP_SET, (int[]){1, 77, 1}, 3, NO_LOC, f.d), 16);
  assert_int_equal(model_group_edit(m, 1, -1, "inlett", GROUP_SET, &one, 1, NO_LOC, f.d), 17);
  assert_int_equal(model_group_edit(m, 1, -1, "inlet", GROUP_ADD, &one, 1, NO_LOC, f.d), -1);
  expect_message(f.d, "did you mean \"inlett\"?");
  model_prepare(m, 1e-8, f.d);
  expect_message(f.d, "names curve 77, which does not exist");
  assert_int_equal(model_group(m, 1, 16)->entity.len, 1);
  for (size_t i = 1; i < model_groups(m); i++) {
    const Group *a = model_group_at(m, i - 1), *b = model_group_at(m, i);
    assert_true(a->dim < b->dim || (a->dim == b->dim && a->tag < b->tag));
  }
  teardown(&f);
}

// ---- mistakes -----------------------------------------------------------------------------------------------------------

static void mistakes(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 0, 0, 0);
  point(&f, 2, 1, 0, 0);
  assert_int_equal(point(&f, 2, 5, 5, 5), -1);
  expect_message(f.d, "point 2 exists already");
  assert_int_equal(LINE(&f, 8, 1, 99), -1);
  expect_message(f.d, "Line 8 uses point 99, which does not exist (there are 2, the largest is 2)");
  int before = diag_errors(f.d);
  LOOP(&f, 9, 8);
  assert_int_equal(FACE(&f, FACE_PLANE, 9, 9), -1); // said already what is wrong with 8
  assert_int_equal(diag_errors(f.d), before);
  assert_int_equal(CURVE(&f, CURVE_CIRCLE, 11, 1, 2), -1);
  expect_message(f.d, "Circle 11 needs 3 points");
  assert_int_equal(FACE(&f, FACE_PLANE, 12, 77), -1);
  expect_message(f.d, "surface 12 uses curve loop 77");
  assert_int_equal(point(&f, -5, 0, 0, 0), -1);
  expect_message(f.d, "between 0 and");
  assert_int_equal(model_add_point(f.m, 50, (Vec3){NAN, 0, 0}, 0, NO_LOC, f.d), -1);
  expect_message(f.d, "not finite");
  Shape s = shape(1, 78);
  Affine a = affine_rotation((Vec3){0, 0, 0}, (Vec3){0, 0, 0}, 1), id = affine_translation((Vec3){1, 0, 0});
  assert_false(model_transform(f.m, &s, 1, &a, NO_LOC, f.d));
  expect_message(f.d, "no finite coefficients");
  assert_false(model_transform(f.m, &s, 1, &id, NO_LOC, f.d));
  expect_message(f.d, "cannot transform curve 78: it does not exist");
  teardown(&f);
}

static void open_loops(void **state)
{
  (void)state;
  Fix f = setup();
  unit_square(&f);
  point(&f, 10, 0, .999, 0);
  LINE(&f, 11, 3, 10);
  LOOP(&f, 12, 1, 2, 11, 4);
  FACE(&f, FACE_PLANE, 13, 12);
  assert_int_equal(diag_count(f.d), 0); // coherence might still close it
  assert_false(model_prepare(f.m, 1e-8, f.d));
  expect_message(f.d, "curve loop 12 is not closed: curve 11 ends at point 10 (0, 0.999, 0) and curve 4 at point 4 (0, 1, 0), "
                      "0.001 apart");
  teardown(&f);

  f = setup();
  unit_square(&f);
  LOOP(&f, 20, 3, 1, -2, 4); // any order; one sign is wrong
  FACE(&f, FACE_PLANE, 21, 20);
  expect_message(f.d, "curve loop 20: curve -2 runs the other way round; taken as 2");
  EXPECT_BOUNDARY(f.m, 21, 3, 4, 1, 2);
  LOOP(&f, 22, -1, 2, 3, 4); // the first is the wrong one
  FACE(&f, FACE_PLANE, 23, 22);
  EXPECT_BOUNDARY(f.m, 23, 2, 3, 4, 1);
  LOOP(&f, 24, 1, 2, 3, 4, 4);
  FACE(&f, FACE_PLANE, 25, 24);
  assert_false(model_prepare(f.m, 1e-8, f.d));
  expect_message(f.d, "it lists curve 4 twice");
  teardown(&f);
}

// A loop whose points only coherence brings together.
static void loop_closed_by_coherence(void **state)
{
  (void)state;
  Fix f = setup();
  double x[4] = {0, 1, 1, 0}, y[4] = {0, 0, 1, 1};
  for (int i = 0; i < 4; i++) {
    point(&f, 2 * i + 1, x[i], y[i], 0);
    point(&f, 2 * i + 2, x[(i + 1) % 4], y[(i + 1) % 4], 0);
    LINE(&f, i + 1, 2 * i + 1, 2 * i + 2);
  }
  LOOP(&f, 1, 1, 2, 3, 4);
  FACE(&f, FACE_PLANE, 1, 1);
  model_coherence(f.m, f.d);
  assert_int_equal(model_points(f.m), 4);
  assert_true(model_prepare(f.m, 1e-8, f.d));
  assert_int_equal(diag_count(f.d), 0);
  teardown(&f);
}

// ---- planes -------------------------------------------------------------------------------------------------------------

static void plane_frames(void **state)
{
  (void)state;
  Fix f = setup();
  unit_square(&f);
  LOOP(&f, 7, -4, -3, -2, -1);
  FACE(&f, FACE_PLANE, 8, 7);
  assert_true(model_prepare(f.m, 1e-8, f.d));
  const Face *ccw = model_face(f.m, 6), *cw = model_face(f.m, 8);
  Vec3 p = {0.1, 0.7, 0};
  Vec2 a = face_to_plane(ccw, p), b = face_to_plane(cw, p);
  assert_true(a.x == 0.1 && a.y == 0.7 && b.x == 0.1 && b.y == -0.7);
  assert_true(ccw->normal.z == 1 && cw->normal.z == -1 && ccw->planar && cw->planar);
  Affine r = affine_rotation((Vec3){1, 2, 3}, (Vec3){.3, 0, 1}, 1.1);
  Shape s = shape(2, 6);
  assert_true(model_transform(f.m, &s, 1, &r, NO_LOC, f.d));
  assert_true(model_prepare(f.m, 1e-8, f.d));
  const Face *t = model_face(f.m, 6);
  assert_true(t->planar);
  for (int i = 1; i <= 4; i++) {
    Vec3 q = model_point(f.m, i)->xyz;
    assert_true(vec3_distance(q, face_from_plane(t, face_to_plane(t, q))) < 1e-15);
  }
  assert_true(fabs(vec3_length(t->axis_u) - 1) < 1e-15 && fabs(vec3_dot(t->axis_u, t->axis_v)) < 1e-15);
  assert_true(vec3_distance(vec3_cross(t->axis_u, t->axis_v), t->normal) < 1e-15);
  teardown(&f);
}

// Hole listed before the outer loop, and outer loop and hole in one Curve Loop.
static void outer_loop_is_found(void **state)
{
  (void)state;
  Fix f = setup();
  unit_square(&f);
  point(&f, 11, .2, .2, 0);
  point(&f, 12, .4, .2, 0);
  point(&f, 13, .4, .4, 0);
  LINE(&f, 11, 11, 12);
  LINE(&f, 12, 12, 13);
  LINE(&f, 13, 13, 11);
  LOOP(&f, 20, 11, 12, 13);
  LOOP(&f, 21, 12, 13, 11, 3, 2, 4, 1);
  FACE(&f, FACE_PLANE, 30, 20, 5);
  FACE(&f, FACE_PLANE, 31, 21);
  FACE(&f, FACE_PLANE, 32, -21);
  assert_true(model_prepare(f.m, 1e-8, f.d));
  for (int tag = 30; tag <= 32; tag++) {
    IntVec curve = {0}, start = {0};
    face_boundary(f.m, model_face(f.m, tag), &curve, &start);
    assert_int_equal(start.len, 3);
    assert_int_equal(start.data[1], 4);
    assert_int_equal(start.data[2], 7);
    for (int i = 0; i < 4; i++) assert_true(abs(curve.data[i]) <= 4);
    vec_free(&curve);
    vec_free(&start);
  }
  assert_true(model_face(f.m, 31)->normal.z == 1);
  assert_true(model_face(f.m, 32)->normal.z == -1);
  teardown(&f);
}

static void filling(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 0, 0, 0);
  point(&f, 2, 1, 0, 0);
  point(&f, 3, 1, 1, 1);
  point(&f, 4, 0, 1, 0);
  for (int i = 1; i <= 4; i++) LINE(&f, i, i, i % 4 + 1);
  LOOP(&f, 5, 1, 2, 3, 4);
  FACE(&f, FACE_FILLING, 6, 5);
  assert_true(model_prepare(f.m, 1e-8, f.d));
  const Face *g = model_face(f.m, 6);
  assert_false(g->planar);
  Vec3 c = face_filling_point(f.m, g, .5, .5); // z = x y on this patch
  assert_true(vec3_distance(c, (Vec3){.5, .5, .25}) < 1e-15);
  c = face_filling_point(f.m, g, 1, .3);
  assert_true(vec3_distance(c, (Vec3){1, .3, .3}) < 1e-15);
  teardown(&f);
}

// ---- half circles under transforms ----------------------------------------------------------------------------------------

static void half_circle_follows(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 1, 0, 0);
  point(&f, 2, 0, 0, 0);
  point(&f, 3, -1, 0, 0);
  CURVE(&f, CURVE_CIRCLE, 1, 1, 2, 3);
  Shape one = shape(1, 1);
  ShapeVec copy = {0};
  model_duplicate(f.m, &one, 1, &copy, NO_LOC, f.d);
  Affine mirror = affine_symmetry(0, 1, 0, 0);
  assert_true(model_transform(f.m, copy.data, 1, &mirror, NO_LOC, f.d));
  assert_int_equal(model_curves(f.m), 2); // the lower half is another curve
  assert_true(model_prepare(f.m, 1e-8, f.d));
  Vec3 p = curve_point(f.m, model_curve(f.m, copy.data[0].tag), .5);
  assert_true(vec3_distance(p, (Vec3){0, -1, 0}) < 1e-15);
  vec_clear(&copy);
  model_duplicate(f.m, &one, 1, &copy, NO_LOC, f.d);
  Affine turned = affine_rotation((Vec3){1, 0, 0}, (Vec3){0, 0, 0}, PI / 2);
  assert_true(model_transform(f.m, copy.data, 1, &turned, NO_LOC, f.d));
  assert_true(model_prepare(f.m, 1e-8, f.d));
  p = curve_point(f.m, model_curve(f.m, copy.data[0].tag), .5);
  assert_true(vec3_distance(p, (Vec3){0, 0, 1}) < 1e-15);
  vec_free(&copy);
  teardown(&f);
}

static void split_and_compound(void **state)
{
  (void)state;
  Fix f = setup();
  point(&f, 1, 0, 0, 0);
  point(&f, 2, 1, 0, 0);
  point(&f, 3, 1, 1, 0);
  point(&f, 4, 0, 1, 0);
  point(&f, 5, .5, 1, 0);
  point(&f, 6, .7, 2, 0);
  LINE(&f, 1, 1, 2);
  LINE(&f, 2, 2, 3);
  CURVE(&f, CURVE_SPLINE, 3, 3, 6, 5, 4);
  LINE(&f, 4, 4, 1);
  LOOP(&f, 50, 1, 2, 3, 4);
  FACE(&f, FACE_PLANE, 60, 50);
  model_group_edit(f.m, 1, 7, "b", GROUP_SET, (int[]){1, -3}, 2, NO_LOC, f.d);
  IntVec out = {0};
  assert_true(model_split_curve(f.m, 3, (int[]){5, 6}, 2, &out, NO_LOC, f.d));
  assert_int_equal(out.len, 3);
  expect_news(f.m, 7, 64);
  EXPECT_CURVE(f.m, 61, CURVE_SPLINE, 3, 6);
  EXPECT_CURVE(f.m, 63, CURVE_SPLINE, 5, 4);
  EXPECT_BOUNDARY(f.m, 60, 1, 2, 61, 62, 63, 4);
  assert_null(model_curve(f.m, 3));
  const Group *g = model_group(f.m, 1, 7);
  assert_int_equal(g->entity.len, 4);
  assert_int_equal(g->entity.data[1], -63);
  assert_int_equal(model_add_compound_spline(f.m, CURVE_SPLINE, 80, (int[]){1, 2}, 2, 4, NO_LOC, f.d), 80);
  expect_news(f.m, 13, 81);
  EXPECT_CURVE(f.m, 80, CURVE_SPLINE, 1, 7, 8, 9, 2, 10, 11, 12, 3);
  assert_true(model_prepare(f.m, 1e-8, f.d));
  // a closed curve: the last part goes round
  CURVE(&f, CURVE_SPLINE, 90, 1, 2, 3, 4, 5, 1);
  vec_clear(&out);
  assert_true(model_split_curve(f.m, 90, (int[]){1, 4}, 2, &out, NO_LOC, f.d));
  EXPECT_CURVE(f.m, out.data[0], CURVE_SPLINE, 4, 5, 1);
  EXPECT_CURVE(f.m, out.data[1], CURVE_SPLINE, 1, 2, 3, 4);
  assert_true(model_split_curve(f.m, out.data[1], (int[]){1, 3, 4}, 3, &out, NO_LOC, f.d));
  assert_int_equal(out.len, 4);
  vec_free(&out);
  teardown(&f);
}

// OpenCASCADE's plane shapes: tags as Gmsh 4.8.4 gives them.
static void plane_shapes(void **state)
{
  (void)state;
  Fix f = setup();
  Model *m = f.m;
  model_settings(m)->opencascade = true;
  point(&f, 1, 0, 0, 0);
  assert_int_equal(model_add_rectangle(m, 1, (Vec3){0, 0, 0}, 2, 1, 0, NO_LOC, f.d), 1);
  expect_news(m, 6, 5);
  assert_int_equal(model_add_disk(m, 2, (Vec3){5, 0, 0}, 1, 1, NO_LOC, f.d), 2);
  expect_news(m, 7, 6);
  assert_int_equal(model_add_disk(m, 3, (Vec3){9, 0, 0}, 2, 1, NO_LOC, f.d), 3);
  model_add_arc(m, 20, (Vec3){0, 5, 0}, 1, 1, 0, 2 * PI, false, NO_LOC, f.d);
  model_add_arc(m, 21, (Vec3){0, 9, 0}, 1, 1, 0, PI / 2, false, NO_LOC, f.d);
  model_add_arc(m, 22, (Vec3){0, 13, 0}, 1, 1, 0, 2 * PI, false, NO_LOC, f.d);
  model_add_arc(m, 23, (Vec3){0, 13, 0}, 1, 1, PI / 4, 3 * PI / 2, false, NO_LOC, f.d);
  model_add_arc(m, 24, (Vec3){0, 19, 0}, 2, 1, 0, 2 * PI, false, NO_LOC, f.d);
  model_add_arc(m, 25, (Vec3){0, 24, 0}, 2, 1, PI / 4, PI, false, NO_LOC, f.d);
  expect_news(m, 17, 26);
  assert_int_equal(model_add_rectangle(m, 9, (Vec3){20, 0, 0}, 2, 1, .2, NO_LOC, f.d), 9);
  expect_news(m, 25, 34);
  EXPECT_BOUNDARY(m, 9, 26, 27, 28, 29, 30, 31, 32, 33);
  LOOP(&f, 7, 20);
  FACE(&f, FACE_PLANE, 10, 7);
  ShapeVec copy = {0};
  Shape s[] = {{2, 1}, {2, 3}};
  assert_true(model_duplicate(m, s, 1, &copy, NO_LOC, f.d));
  assert_int_equal(copy.data[0].tag, 11);
  expect_news(m, 29, 38);
  vec_clear(&copy);
  assert_true(model_duplicate(m, s + 1, 1, &copy, NO_LOC, f.d));
  Affine a = affine_rotation((Vec3){1, 0, 0}, (Vec3){9, 0, 0}, PI / 2), b = affine_dilation((Vec3){9, 0, 0}, (Vec3){1, 1, 2});
  assert_true(model_transform(m, copy.data, 1, &a, NO_LOC, f.d) && model_transform(m, copy.data, 1, &b, NO_LOC, f.d));
  assert_true(model_prepare(m, 1e-8, f.d));
  const Curve *disk = model_curve(m, 5), *oval = model_curve(m, 38);
  assert_true(fabs(curve_length(m, disk) - 2 * PI) < 1e-14 && fabs(curve_angle(m, disk) - 2 * PI) < 1e-15);
  assert_true(fabs(curve_length(m, oval) - 4 * PI) < 1e-13); // a circle of radius 2 now
  assert_true(fabs(curve_curvature(m, oval, .3) - .5) < 1e-13);
  assert_true(vec3_distance(curve_point(m, oval, .25), (Vec3){9, 0, 2}) < 1e-14);
  Box3 box = curve_bounds(m, model_curve(m, 23));
  assert_true(fabs(box.lo.x + 1) < 1e-15 && fabs(box.hi.x - sqrt(.5)) < 1e-15 && fabs(box.lo.y - 12) < 1e-15 && fabs(box.hi.y - 14) < 1e-15);
  assert_true(fabs(curve_nearest(m, disk, (Vec3){5, -3, 0}) - .75) < 1e-15);
  assert_int_equal(diag_count(f.d), 0);
  vec_free(&copy);
  teardown(&f);
}

static void boxes(void **state)
{
  (void)state;
  Fix f = setup();
  unit_square(&f);
  point(&f, 7, .5, .5, 0);
  CURVE(&f, CURVE_CIRCLE, 9, 1, 7, 2);
  IntVec in = {0};
  model_in_box(f.m, 1, (Box3){{0, -.1, 0}, {1, .5, 0}}, &in);
  assert_int_equal(in.len, 1); // the arc dips to y = 1/2 - 1/sqrt 2
  assert_int_equal(in.data[0], 1);
  vec_clear(&in);
  model_in_box(f.m, 1, (Box3){{0, -.21, 0}, {1, .5, 0}}, &in);
  assert_int_equal(in.len, 2);
  vec_clear(&in);
  model_in_box(f.m, 0, (Box3){{0, 0, 0}, {1, 0, 0}}, &in);
  assert_int_equal(in.len, 2);
  Box3 b;
  Shape s = shape(2, 6);
  assert_true(model_box_of(f.m, &s, 1, &b, NO_LOC, f.d));
  assert_true(b.lo.x == 0 && b.hi.y == 1 && b.hi.z == 0);
  vec_free(&in);
  teardown(&f);
}

// Random statements on a small grid, where everything meets everything: after each, all counts of uses are right and all
// references live; after coherence nothing is double.
static int any(Rng *r, const Model *m, int dim)
{
  IntVec all = {0};
  model_all(m, dim, &all);
  int tag = all.len ? all.data[rng_below(r, (uint32_t)all.len)] : 1 + (int)rng_below(r, 5);
  vec_free(&all);
  return tag;
}

static Vec3 grid_vector(Rng *r)
{
  return (Vec3){(double)rng_below(r, 4), (double)rng_below(r, 4), (double)rng_below(r, 2)};
}

static void make_something(Fix *f, Rng *r)
{
  Vec3 x = grid_vector(r);
  int a = any(r, f->m, 0), b = any(r, f->m, 0), c = any(r, f->m, 0);
  switch (rng_below(r, 5)) {
  case 0: model_add_point(f->m, -1, x, 0, NO_LOC, f->d); break;
  case 1: LINE(f, -1, a, b); break;
  case 2: CURVE(f, CURVE_SPLINE, -1, a, b, c); break;
  case 3: {
    if (a == b || b == c || a == c) break;
    int l[3] = {LINE(f, -1, a, b), LINE(f, -1, b, c), LINE(f, -1, c, a)};
    if (l[0] < 0 || l[1] < 0 || l[2] < 0) break;
    int loop = LOOP(f, -1, l[2], l[0], rng_below(r, 3) ? l[1] : -l[1]);
    if (loop > 0) FACE(f, rng_below(r, 2) ? FACE_PLANE : FACE_FILLING, -1, loop);
    break;
  }
  case 4: model_group_edit(f->m, 1, -1, NULL, GROUP_SET, (int[]){any(r, f->m, 1), -any(r, f->m, 1)}, 2, NO_LOC, f->d); break;
  }
}

static bool change_something(Fix *f, Rng *r)
{
  int dim = (int)rng_below(r, 3);
  Shape s[2] = {{dim, any(r, f->m, dim)}, {1, any(r, f->m, 1)}};
  ShapeVec out = {0};
  IntVec parts = {0};
  bool coherent = false;
  switch (rng_below(r, 6)) {
  case 0: {
    Affine a = affine_translation(grid_vector(r));
    coherent = model_transform(f->m, s, 1 + rng_below(r, 2), &a, NO_LOC, f->d);
    break;
  }
  case 1: model_duplicate(f->m, s, 1, &out, NO_LOC, f->d); break;
  case 2: {
    Sweep w = shift(1, 0, 0);
    if (rng_below(r, 2)) w = turn((Vec3){0, 0, 1}, (Vec3){1, 1, 0}, PI / 2);
    coherent = model_extrude(f->m, s, 1, &w, &out, NO_LOC, f->d) && out.len; // what does not exist is passed over
    break;
  }
  case 3: model_delete(f->m, s, 2, rng_below(r, 2)); break;
  case 4: {
    const Curve *c = model_curve(f->m, s[1].tag);
    if (c && c->npoint > 2) model_split_curve(f->m, c->tag, &c->point[1], 1, &parts, NO_LOC, f->d);
    break;
  }
  case 5:
    model_coherence(f->m, f->d);
    coherent = true;
    break;
  }
  vec_free(&parts);
  vec_free(&out);
  return coherent;
}

static void random_statements(void **state)
{
  (void)state;
  for (uint64_t seed = 0; seed < 200; seed++) {
    Fix f = setup();
    Rng r = {seed};
    for (int step = 0; step < 120 && model_curves(f.m) < 120; step++) {
      bool coherent = false;
      if (rng_below(&r, 2))
        make_something(&f, &r);
      else
        coherent = change_something(&f, &r);
      Str why = {0};
      if (!model_check(f.m, coherent, &why)) fail_msg("seed %d, step %d:\n%s", (int)seed, step, str_text(&why));
      str_free(&why);
    }
    model_prepare(f.m, 1e-8, f.d);
    Str why = {0};
    if (!model_check(f.m, false, &why)) fail_msg("seed %d, prepared:\n%s", (int)seed, str_text(&why));
    str_free(&why);
    teardown(&f);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(extruded_line),
    cmocka_unit_test(rotated_lines),
    cmocka_unit_test(extruded_faces),
    cmocka_unit_test(extruded_face_with_hole),
    cmocka_unit_test(sweeps_that_stay),
    cmocka_unit_test(several_at_once),
    cmocka_unit_test(coherence_of_curves_and_groups),
    cmocka_unit_test(merged_into_a_reverse),
    cmocka_unit_test(coherence_tolerance),
    cmocka_unit_test(coherence_is_incremental),
    cmocka_unit_test(deleting),
    cmocka_unit_test(deleted_curve_in_loop),
    cmocka_unit_test(group_tags),
    cmocka_unit_test(mistakes),
    cmocka_unit_test(open_loops),
    cmocka_unit_test(loop_closed_by_coherence),
    cmocka_unit_test(plane_frames),
    cmocka_unit_test(outer_loop_is_found),
    cmocka_unit_test(filling),
    cmocka_unit_test(half_circle_follows),
    cmocka_unit_test(split_and_compound),
    cmocka_unit_test(boxes),
    cmocka_unit_test(plane_shapes),
    cmocka_unit_test(random_statements),
  };
  return unit_run(tests);
}
