// test_size.c - size fields: expressions, distances, every type of field, faults and explanations
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>
#include <unistd.h>

#include "base/mem.h"
#include "base/rng.h"
#include "geom/cones.h"
#include "geom/nearest.h"
#include "model/model_edit.h"
#include "size/mathexpr.h"
#include "size/size.h"
#include "size/trig.h"

#define NEAR(a, b, tol) \
  do { \
    double a_ = (a), b_ = (b); \
    if (!(fabs(a_ - b_) <= (tol))) fail_msg("%s = %.17g, not %.17g", #a, a_, b_); \
  } while (0)

// ---- expressions ------------------------------------------------------------------------------------------------------

static double value_of(const char *text, double x, double y, double z)
{
  Str error = {0};
  int column;
  Expr *e = expr_compile(text, &error, &column);
  if (!e) fail_msg("%s: %s at %d", text, str_text(&error), column);
  double *scratch = mem_alloc((expr_scratch(e, 1) + 1) * sizeof *scratch), out;
  double f[8] = {10, 20, 30, 40, 50, 60, 70, 80};
  const double *field[8] = {f, f + 1, f + 2, f + 3, f + 4, f + 5, f + 6, f + 7};
  expr_eval(e, &x, &y, &z, field, 1, scratch, &out);
  free(scratch);
  expr_free(e);
  str_free(&error);
  return out;
}

static void expressions_have_their_values(void **state)
{
  (void)state;
  static const struct {
    const char *text;
    double value;
  } cases[] = {
    {"1+2*3", 7},          {"2^3^2", 512},        {"-2^2", -4},          {"5-2^2", 1},         {"7%4*2", 6},
    {"10%3", 1},           {"-7%4", -3},          {"med(1,5,3)", 3},     {"sum(1,2,3)", 6},    {"min(3,1,2)", 1},
    {"max(3,1,2)", 3},     {"fac(4)", 24},        {"deg(pi)", 180},      {"rad(180)", M_PI},   {"step(0)+step(-1)", 1},
    {"sign(-3)+sign(0)", 0}, {"round(2.5)", 3},   {"round(-2.5)", -2},   {"trunc(2.7)", 2},    {"floor(-0.5)", -1},
    {"ceil(0.5)", 1},      {"Cos(0)", 1},         {"Sqrt(16)", 4},       {"x*y+z", 10},        {"x^2", 4},
    {"x^3", 8},            {"x^0.5", M_SQRT2},    {"2^-1", 0.5},         {"F5+F2", 30},        {"(1<2)+(2<1)", 1},
    {"1e-2*.5", 0.005},    {"3.", 3},             {"abs(-x)", 2},        {"log(e)", 1},        {"atan2(1,1)*4", M_PI},
    {"x<3 && y>2", 1},     {"hypot(3,4)", 5},     {"-x^2", -4},          {"2*-3", -6},         {" 1 + ( 2 ) ", 3},
  };
  for (size_t i = 0; i < ARRAY_LEN(cases); i++) {
    double v = value_of(cases[i].text, 2, 3, 4);
    if (fabs(v - cases[i].value) > 1e-14 * fabs(v)) fail_msg("%s = %.17g, not %.17g", cases[i].text, v, cases[i].value);
  }
}

static void bad_expressions_say_where(void **state)
{
  (void)state;
  static const struct {
    const char *text;
    int column;
  } cases[] = {{"1+", 3}, {"", 1}, {"(1+2", 5}, {"1 2", 3}, {"sine(1)", 1}, {"x+q", 3}, {"sin(1,2)", 1}, {"atan2(1)", 1}, {"1+*2", 3}};
  for (size_t i = 0; i < ARRAY_LEN(cases); i++) {
    Str error = {0};
    int column = 0;
    Expr *e = expr_compile(cases[i].text, &error, &column);
    assert_null(e);
    assert_true(error.len > 0);
    if (column != cases[i].column) fail_msg("%s: column %d, not %d", cases[i].text, column, cases[i].column);
    str_free(&error);
  }
  char deep[2000];
  memset(deep, '(', sizeof deep - 1);
  deep[sizeof deep - 1] = 0;
  Str error = {0};
  int column;
  assert_null(expr_compile(deep, &error, &column));
  str_free(&error);
}

static void common_parts_are_computed_once(void **state)
{
  (void)state;
  Str error = {0};
  int column;
  Expr *a = expr_compile("sin(x+y)", &error, &column), *b = expr_compile("sin(x+y)*sin(y+x)+sin(x+y)", &error, &column);
  assert_int_equal(expr_length(a) + 2, expr_length(b));
  Expr *c = expr_compile("2*3+sin(0)", &error, &column);
  double v;
  assert_true(expr_constant(c, &v));
  NEAR(v, 6, 0);
  expr_free(a);
  expr_free(b);
  expr_free(c);
  static const struct {
    const char *text;
    bool minus;
  } power[] = {{"-x^2", true}, {"exp(-x^2)", true}, {"-(x^2)", false}, {"1-x^2", false}, {"x^-2", false}, {"-x*y^2", false}, {"2*-x^3", true}};
  for (size_t i = 0; i < ARRAY_LEN(power); i++) {
    a = expr_compile(power[i].text, &error, &column);
    assert_int_equal(expr_minus_power(a), power[i].minus);
    expr_free(a);
  }
}

// One place and many give the same bits.
static void one_place_is_as_many(void **state)
{
  (void)state;
  static const char *const text[] = {"0.1+0.08*sin(3*x)*cos(6*y)", "x^2.5+min(x,y,z,0.3)*F1-F2/7+step(x-y)", "F1", "y", "cos(1e6*x)+2*rand(x)",
                                     "(x+1)*(x+2)*(x+3)*(x+4)*(x+5)*(x+6)*(x+7)*(x+8)"};
  enum { N = 64 };
  Rng rng = {11};
  double x[N], y[N], z[N], f1[N], f2[N], many[N], one;
  for (int i = 0; i < N; i++)
    x[i] = 4 * rng_double(&rng), y[i] = rng_double(&rng) - 0.5, z[i] = rng_double(&rng), f1[i] = rng_double(&rng), f2[i] = 3;
  for (size_t k = 0; k < ARRAY_LEN(text); k++) {
    Str error = {0};
    int column;
    Expr *e = expr_compile(text[k], &error, &column);
    double *scratch = mem_alloc((expr_scratch(e, N) + 1) * sizeof *scratch);
    expr_eval(e, x, y, z, (const double *[]){f1, f2}, N, scratch, many);
    for (int i = 0; i < N; i++) {
      expr_eval(e, x + i, y + i, z + i, (const double *[]){f1 + i, f2 + i}, 1, scratch, &one);
      assert_memory_equal(&one, &many[i], sizeof one);
    }
    free(scratch);
    expr_free(e);
  }
}

static bool within_an_ulp(double v, long double exact)
{
  return exact == 0 ? v == 0 : fabsl((long double)v - exact) <= (long double)ldexp(1, ilogb((double)exact) - 52);
}

static void sines_are_within_an_ulp(void **state)
{
  (void)state;
  Rng rng = {12};
  for (int i = 0; i < 300000; i++) {
    double range = i % 3 == 0 ? 2e5 : i % 3 == 1 ? 20 : 1e-3, x = range * (rng_double(&rng) - 0.5);
    if (i % 7 == 0) x = floor(x) * M_PI_2; // where one of them nearly vanishes
    if (fabs(x) > TRIG_MOST) continue;
    assert_true(within_an_ulp(trig_sin(x), sinl((long double)x)));
    assert_true(within_an_ulp(trig_cos(x), cosl((long double)x)));
  }
  assert_true(trig_sin(0) == 0 && trig_cos(0) == 1 && isnan(trig_sin(INFINITY)) && isnan(trig_cos(NAN)));
  assert_true(trig_sin(1e22) == sin(1e22));
}

// ---- nearest ------------------------------------------------------------------------------------------------------------

static double segment_distance(Vec3 p, Vec3 a, Vec3 b)
{
  Vec3 d = vec3_sub(b, a), r = vec3_sub(p, a);
  double l2 = vec3_dot(d, d), t = l2 > 0 ? fmin(fmax(vec3_dot(r, d) / l2, 0), 1) : 0;
  return vec3_length(vec3_sub(r, vec3_scale(t, d)));
}

static void the_nearest_of_all_is_found(void **state)
{
  (void)state;
  enum { N = 500, QUERIES = 500 };
  Rng rng = {3};
  Nearest *n = nearest_new(NULL, NULL);
  Vec3 a[N], b[N];
  for (int i = 0; i < N; i++) {
    a[i] = (Vec3){rng_double(&rng), rng_double(&rng), i % 7 ? 0 : rng_double(&rng)};
    b[i] = i % 3 ? (Vec3){a[i].x + 0.1 * rng_double(&rng), a[i].y + 0.1 * rng_double(&rng), 0} : a[i];
    nearest_add(n, a[i], b[i], 0, (uint32_t)i, 0, 1);
  }
  nearest_build(n);
  uint32_t hint = NONE;
  for (int q = 0; q < QUERIES; q++) {
    Vec3 p = {2 * rng_double(&rng) - 0.5, 2 * rng_double(&rng) - 0.5, 0};
    double best = INFINITY;
    for (int i = 0; i < N; i++) best = fmin(best, segment_distance(p, a[i], b[i]));
    NearestHit hit = nearest_query(n, p, INFINITY, hint);
    NEAR(hit.distance, best, 1e-15);
    NEAR(segment_distance(p, a[hit.curve], b[hit.curve]), best, 1e-15);
    hint = hit.leaf;
    hit = nearest_query(n, p, best / 2, hint);
    assert_int_equal(hit.curve, NONE);
    assert_true(hit.distance == best / 2);
  }
  nearest_free(n);
}

// A chain far from the origin, asked without a hint, with a useless one and with the last: the distance is the same to the bit.
static void hints_do_not_change_a_distance(void **state)
{
  (void)state;
  enum { N = 3000, QUERIES = 2000 };
  Rng rng = {11};
  Nearest *n = nearest_new(NULL, NULL);
  Vec3 a[N + 1];
  for (int i = 0; i <= N; i++) a[i] = (Vec3){1e5 + 0.01 * i, -3e4 + sin(0.003 * i) + 0.02 * sin(1.7 * i), 7 + cos(0.002 * i)};
  for (int i = 0; i < N; i++) nearest_add(n, a[i], a[i + 1], 0, (uint32_t)i, 0, 1);
  nearest_build(n);
  uint32_t last = NONE;
  for (int q = 0; q < QUERIES; q++) {
    Vec3 p = {1e5 - 5 + 40 * rng_double(&rng), -3e4 - 3 + 6 * rng_double(&rng), 5 + 4 * rng_double(&rng)};
    double best = INFINITY;
    for (int i = 0; i < N; i++) best = fmin(best, segment_distance(p, a[i], a[i + 1]));
    NearestHit hit = nearest_query(n, p, INFINITY, NONE), again = nearest_query(n, p, INFINITY, (uint32_t)(q % 50));
    NEAR(hit.distance, best, 1e-10);
    assert_true(again.distance == hit.distance);
    again = nearest_query(n, p, INFINITY, last);
    assert_true(again.distance == hit.distance);
    last = again.leaf;
  }
  nearest_free(n);
}

static void cones_are_the_least_of_all(void **state)
{
  (void)state;
  enum { N = 300 };
  Rng rng = {5};
  Vec3 p[N];
  double h[N];
  for (int i = 0; i < N; i++) {
    p[i] = (Vec3){rng_double(&rng), rng_double(&rng), 0};
    h[i] = 0.01 + rng_double(&rng) * 0.3;
  }
  Cones *c = cones_new(p, h, N, 0.2);
  for (int q = 0; q < 500; q++) {
    Vec3 at = {rng_double(&rng), rng_double(&rng), 0};
    double best = 0.15;
    for (int i = 0; i < N; i++) best = fmin(best, h[i] + 0.2 * vec3_distance(p[i], at));
    NEAR(cones_at(c, at, 0.15), best, 1e-15);
  }
  cones_free(c);
  c = cones_new(NULL, NULL, 0, 1);
  NEAR(cones_at(c, (Vec3){0, 0, 0}, 7), 7, 0);
  cones_free(c);
}

// ---- fields on a small model -----------------------------------------------------------------------------------------------

typedef struct {
  Model *m;
  Options o;
  FieldSet *f;
  Diag *diag;
  SizeField *s;
  SizeEval *e;
} Set;

// Unit square 1..4 (curves 1..4, face 1), and a spline 5 and an arc 6 beside it.
static Set set_up(void)
{
  Set t = {.m = model_new(), .f = fields_new(), .diag = diag_new(false)};
  options_init(&t.o);
  double xy[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {3, 1}, {4, 0.3}, {2, 2}, {3, 2}, {2, 3}};
  for (int i = 0; i < 10; i++) model_add_point(t.m, i + 1, (Vec3){xy[i][0], xy[i][1], 0}, 0.1, NO_LOC, t.diag);
  for (int i = 0; i < 4; i++) model_add_curve(t.m, CURVE_LINE, i + 1, (int[]){i + 1, (i + 1) % 4 + 1}, 2, NULL, NULL, 0, NO_LOC, t.diag);
  model_add_curve(t.m, CURVE_SPLINE, 5, (int[]){5, 6, 7}, 3, NULL, NULL, 0, NO_LOC, t.diag);
  model_add_curve(t.m, CURVE_CIRCLE, 6, (int[]){9, 8, 10}, 3, NULL, NULL, 0, NO_LOC, t.diag);
  model_add_loop(t.m, 1, (int[]){1, 2, 3, 4}, 4, NO_LOC, t.diag);
  model_add_face(t.m, FACE_PLANE, 1, (int[]){1}, 1, NO_LOC, t.diag);
  assert_true(model_prepare(t.m, 1e-8, t.diag));
  return t;
}

static bool compile(Set *t, int background)
{
  size_eval_free(t->e);
  size_free(t->s);
  t->e = NULL;
  fields_set_background(t->f, background, NO_LOC);
  t->s = size_new(t->m, &t->o, t->f, t->diag);
  if (t->s) t->e = size_eval_new(t->s);
  return t->s != NULL;
}

static void tear_down(Set *t)
{
  size_eval_free(t->e);
  size_free(t->s);
  fields_free(t->f);
  options_free(&t->o);
  model_free(t->m);
  diag_free(t->diag);
}

static void num(Set *t, int id, const char *option, double v)
{
  if (!field_set_number(t->f, id, option, v, NO_LOC, t->diag)) fail_msg("option %s", option);
}

static void make(Set *t, int id, const char *type)
{
  if (!field_create(t->f, id, type, NO_LOC, t->diag)) fail_msg("type %s", type);
}

static void text(Set *t, int id, const char *option, const char *v)
{
  if (!field_set_string(t->f, id, option, v, NO_LOC, t->diag)) fail_msg("option %s", option);
}

static void list(Set *t, int id, const char *option, double a, double b)
{
  double v[2] = {a, b};
  if (!field_set_list(t->f, id, option, v, b ? 2 : 1, NO_LOC, t->diag)) fail_msg("option %s", option);
}

// The background field's value at (x, y) of face 1, below the model's diagonal.
static double at(Set *t, double x, double y)
{
  return size_in_face(t->e, model_face(t->m, 1), (Vec3){x, y, 0});
}

static void old_names_and_mistakes(void **state)
{
  (void)state;
  Set t = set_up();
  make(&t, 1, "Attractor");
  assert_string_equal(field_type(t.f, 1), "Distance");
  num(&t, 1, "NNodesByEdge", 50);
  NEAR(field_get_number(t.f, 1, "Sampling"), 50, 0);
  list(&t, 1, "EdgesList", 1, 2);
  size_t n;
  assert_true(field_get_list(t.f, 1, "CurvesList", &n)[1] == 2 && n == 2);
  make(&t, 2, "Threshold");
  num(&t, 2, "IField", 1), num(&t, 2, "LcMin", 0.5), num(&t, 2, "LcMax", 0.6);
  assert_int_equal(diag_errors(t.diag), 0);
  assert_false(field_create(t.f, 2, "Box", NO_LOC, t.diag));
  assert_false(field_create(t.f, 3, "Treshold", NO_LOC, t.diag));
  assert_non_null(strstr(diag_get(t.diag, diag_count(t.diag) - 1)->text, "'Threshold'"));
  assert_false(field_set_number(t.f, 2, "SizeMinn", 1, NO_LOC, t.diag));
  assert_non_null(strstr(diag_get(t.diag, diag_count(t.diag) - 1)->text, "'SizeMin'"));
  assert_false(field_set_string(t.f, 2, "SizeMin", "a", NO_LOC, t.diag));
  assert_false(field_set_number(t.f, 9, "SizeMin", 1, NO_LOC, t.diag));
  assert_int_equal(fields_max_id(t.f), 2);
  assert_true(field_delete(t.f, 2, NO_LOC, t.diag));
  assert_int_equal(fields_max_id(t.f), 1);
  tear_down(&t);
}

static void shapes_have_their_values(void **state)
{
  (void)state;
  Set t = set_up();
  make(&t, 1, "Box");
  num(&t, 1, "VIn", 0.1), num(&t, 1, "VOut", 0.3), num(&t, 1, "XMin", 0.2), num(&t, 1, "XMax", 0.4);
  num(&t, 1, "YMin", 0.2), num(&t, 1, "YMax", 0.4), num(&t, 1, "Thickness", 0.1);
  assert_true(compile(&t, 1));
  NEAR(at(&t, 0.3, 0.3), 0.1, 0);
  NEAR(at(&t, 0.4, 0.4), 0.1, 0);
  NEAR(at(&t, 0.45, 0.3), 0.2, 1e-15);
  NEAR(at(&t, 0.6, 0.3), 0.3, 0);
  make(&t, 2, "Ball");
  num(&t, 2, "VIn", 0.1), num(&t, 2, "VOut", 0.3), num(&t, 2, "Radius", 0.2), num(&t, 2, "XCenter", 0.5);
  assert_true(compile(&t, 2));
  NEAR(at(&t, 0.5, 0.1), 0.1, 0);
  NEAR(at(&t, 0.5, 0.21), 0.3, 0);
  make(&t, 3, "Cylinder");
  num(&t, 3, "VIn", 0.1), num(&t, 3, "VOut", 0.3), num(&t, 3, "Radius", 0.2), num(&t, 3, "XAxis", 0.5), num(&t, 3, "ZAxis", 0);
  assert_true(compile(&t, 3));
  NEAR(at(&t, 0.4, 0.1), 0.1, 0);
  NEAR(at(&t, 0.6, 0.1), 0.3, 0);
  NEAR(at(&t, 0.4, 0.3), 0.3, 0);
  make(&t, 4, "Frustum");
  num(&t, 4, "Z1", 0), num(&t, 4, "X2", 1), num(&t, 4, "InnerV2", 0.3), num(&t, 4, "OuterR1", 0.5), num(&t, 4, "OuterR2", 0.5);
  assert_true(compile(&t, 4));
  NEAR(at(&t, 0.5, 0), 0.2, 1e-15);
  NEAR(at(&t, 0, 0.25), 0.55, 1e-15);
  tear_down(&t);
}

static void thresholds_of_exact_distances(void **state)
{
  (void)state;
  Set t = set_up();
  make(&t, 1, "Distance");
  list(&t, 1, "CurvesList", 1, 6);
  list(&t, 1, "PointsList", 3, 0);
  assert_true(compile(&t, 1));
  NEAR(at(&t, 0.3, 0.2), 0.2, 1e-16);
  NEAR(at(&t, 0.9, 0.9), sqrt(0.02), 1e-15);
  NEAR(at(&t, 2.1, 2.1), 1 - sqrt(0.02), 1e-14); // inside the arc of radius 1 around (2,2)
  NEAR(at(&t, 3, 3), sqrt(2) - 1, 1e-14);
  make(&t, 2, "Threshold");
  num(&t, 2, "InField", 1), num(&t, 2, "DistMin", 0.1), num(&t, 2, "DistMax", 0.3);
  num(&t, 2, "SizeMin", 0.01), num(&t, 2, "SizeMax", 0.05);
  assert_true(compile(&t, 2));
  NEAR(at(&t, 0.3, 0.05), 0.01, 0);
  NEAR(at(&t, 0.3, 0.2), 0.03, 1e-16);
  NEAR(at(&t, 0.3, 0.5), 0.05, 0);
  num(&t, 2, "StopAtDistMax", 1);
  assert_true(compile(&t, 2));
  NEAR(at(&t, 0.3, 0.5), size_diagonal(t.s), 0);
  num(&t, 2, "Sigmoid", 1);
  assert_true(compile(&t, 2));
  NEAR(at(&t, 0.3, 0.2), 0.03, 1e-15);
  num(&t, 1, "Sampling", 3); // one point in the middle of each curve
  assert_true(compile(&t, 1));
  NEAR(at(&t, 0.1, 0), 0.4, 1e-15);
  tear_down(&t);
}

// The distance to a spline against many samples of it.
static void distance_to_a_spline_is_exact(void **state)
{
  (void)state;
  Set t = set_up();
  make(&t, 1, "Distance");
  list(&t, 1, "CurvesList", 5, 0);
  assert_true(compile(&t, 1));
  Rng rng = {9};
  const Curve *c = model_curve(t.m, 5);
  for (int q = 0; q < 200; q++) {
    Vec3 p = {2 + 2 * rng_double(&rng), 1.5 * rng_double(&rng) - 0.2, 0};
    double best = INFINITY;
    for (int i = 0; i <= 4000; i++) best = fmin(best, vec3_distance(p, curve_point(t.m, c, i / 4000.0)));
    double d = at(&t, p.x, p.y);
    assert_true(d <= best + 1e-15);
    NEAR(d, best, 1e-5);
    NEAR(d, vec3_distance(p, curve_point(t.m, c, curve_nearest(t.m, c, p))), 1e-12);
  }
  tear_down(&t);
}

static void fields_combine(void **state)
{
  (void)state;
  Set t = set_up();
  make(&t, 1, "MathEval"), text(&t, 1, "F", "0.1+0.2*x");
  make(&t, 2, "MathEval"), text(&t, 2, "F", "0.3-0.1*y + 0*F1");
  make(&t, 3, "Min"), list(&t, 3, "FieldsList", 1, 2);
  make(&t, 4, "Max"), list(&t, 4, "FieldsList", 1, 2);
  make(&t, 5, "Restrict"), num(&t, 5, "InField", 1), list(&t, 5, "CurvesList", 2, 0);
  make(&t, 6, "Constant"), num(&t, 6, "VIn", 0.01), list(&t, 6, "SurfacesList", 1, 0), num(&t, 6, "IncludeBoundary", 0);
  make(&t, 7, "Mean"), num(&t, 7, "InField", 1), num(&t, 7, "Delta", 0.05);
  make(&t, 8, "Gradient"), num(&t, 8, "InField", 2), num(&t, 8, "Delta", 0.01);
  make(&t, 9, "MathEval"), text(&t, 9, "F", "x*x+2*y*y");
  make(&t, 10, "Laplacian"), num(&t, 10, "InField", 9), num(&t, 10, "Delta", 0.01);
  make(&t, 11, "MathEval"), text(&t, 11, "F", "hypot(x-5,y)");
  make(&t, 12, "Curvature"), num(&t, 12, "InField", 11), num(&t, 12, "Delta", 0.001);
  make(&t, 13, "MaxEigenHessian"), num(&t, 13, "InField", 9), num(&t, 13, "Delta", 0.01);
  make(&t, 14, "Param"), num(&t, 14, "InField", 1), text(&t, 14, "FX", "y");
  make(&t, 15, "MathEvalAniso");
  text(&t, 15, "M11", "100"), text(&t, 15, "M12", "0"), text(&t, 15, "M13", "0");
  text(&t, 15, "M22", "400"), text(&t, 15, "M23", "0"), text(&t, 15, "M33", "1");
  assert_true(compile(&t, 3));
  NEAR(at(&t, 0.5, 0.5), 0.2, 1e-16);
  NEAR(at(&t, 1, 1), 0.2, 1e-16);
  assert_true(compile(&t, 4));
  NEAR(at(&t, 0.5, 0.5), 0.25, 1e-16);
  assert_true(compile(&t, 5));
  NEAR(at(&t, 0.5, 0.5), size_diagonal(t.s), 0);
  t.o.Mesh_MeshSizeFromPoints = false;
  assert_true(compile(&t, 5));
  NEAR(size_on_curve(t.e, model_curve(t.m, 2), 0.5, (Vec3){1, 0.5, 0}), 0.3, 1e-16);
  NEAR(size_at_point(t.e, model_point(t.m, 3)), 0.3, 1e-16);
  NEAR(size_on_curve(t.e, model_curve(t.m, 1), 0.5, (Vec3){0.5, 0, 0}), size_diagonal(t.s), 0);
  double h;
  assert_true(compile(&t, 6));
  NEAR(at(&t, 0.5, 0.5), 0.01, 0);
  assert_true(size_is_constant(t.s, model_face(t.m, 1), &h) && h == 0.01);
  assert_true(size_on_curve(t.e, model_curve(t.m, 1), 0.5, (Vec3){0.5, 0, 0}) > 1);
  assert_true(compile(&t, 7));
  NEAR(at(&t, 0.5, 0.5), 0.2, 1e-15);
  assert_true(compile(&t, 8));
  NEAR(at(&t, 0.5, 0.5), 0.1, 1e-12);
  assert_true(compile(&t, 10));
  NEAR(fmin(at(&t, 0.5, 0.5), 4), fmin(6, fmin(size_diagonal(t.s), 4)), 1e-9);
  assert_true(compile(&t, 12));
  NEAR(at(&t, 1, 0), 0.25, 1e-4);
  assert_true(compile(&t, 13));
  NEAR(at(&t, 0.2, 0.1), 4, 1e-7);
  assert_true(compile(&t, 14));
  NEAR(at(&t, 0.9, 0.5), 0.2, 1e-15);
  assert_true(compile(&t, 15));
  NEAR(at(&t, 0.9, 0.5), 0.05, 1e-15);
  assert_false(size_is_constant(t.s, model_face(t.m, 1), &h));
  tear_down(&t);
}

static void batches_equal_single_places(void **state)
{
  (void)state;
  Set t = set_up();
  make(&t, 1, "Distance"), list(&t, 1, "CurvesList", 5, 6);
  make(&t, 2, "MathEval"), text(&t, 2, "F", "0.01+F1*sin(x)^2+0.1*F1");
  make(&t, 3, "Threshold"), num(&t, 3, "InField", 1), num(&t, 3, "DistMin", 0.2), num(&t, 3, "DistMax", 0.9);
  make(&t, 4, "Min"), list(&t, 4, "FieldsList", 2, 3);
  assert_true(compile(&t, 4));
  enum { N = 300 };
  Vec3 p[N];
  double h[N];
  Rng rng = {2};
  for (int i = 0; i < N; i++) p[i] = (Vec3){4 * rng_double(&rng), 3 * rng_double(&rng), 0};
  size_in_face_batch(t.e, model_face(t.m, 1), p, N, h);
  for (int i = 0; i < N; i++) assert_true(h[i] == at(&t, p[i].x, p[i].y));
  tear_down(&t);
}

static void sizes_are_clamped_then_scaled(void **state)
{
  (void)state;
  Set t = set_up();
  t.o.Mesh_MeshSizeMax = 0.08;
  t.o.Mesh_MeshSizeFactor = 0.5;
  assert_true(compile(&t, -1));
  NEAR(size_at_point(t.e, model_point(t.m, 1)), 0.04, 1e-16);
  t.o.Mesh_MeshSizeMax = 1e22;
  t.o.Mesh_MeshSizeMin = 0.3;
  assert_true(compile(&t, -1));
  NEAR(size_at_point(t.e, model_point(t.m, 1)), 0.15, 1e-16);
  t.o.Mesh_MeshSizeMin = 0, t.o.Mesh_MeshSizeFactor = 1;
  t.o.Mesh_MeshSizeFromCurvature = 100;
  assert_true(compile(&t, -1));
  NEAR(size_on_curve(t.e, model_curve(t.m, 6), 0.5, (Vec3){0}), 2 * M_PI / 100, 1e-12);
  NEAR(size_at_point(t.e, model_point(t.m, 9)), 2 * M_PI / 100, 1e-12);
  NEAR(size_at_point(t.e, model_point(t.m, 1)), 0.1, 0);
  tear_down(&t);
}

static bool said(const Set *t, const char *what)
{
  for (size_t i = 0; i < diag_count(t->diag); i++)
    if (strstr(diag_get(t->diag, i)->text, what)) return true;
  return false;
}

static void bad_fields_are_reported(void **state)
{
  (void)state;
  Set t = set_up();
  make(&t, 1, "MathEval"), text(&t, 1, "F", "0.1/x - 0.1");
  make(&t, 2, "Min"), list(&t, 2, "FieldsList", 3, 0);
  make(&t, 3, "MathEval"), text(&t, 3, "F", "F2+1");
  make(&t, 4, "Threshold"), num(&t, 4, "InField", 77);
  make(&t, 5, "MathEval"), text(&t, 5, "F", "0.1+y*(");
  make(&t, 6, "MathEval"), text(&t, 6, "F", "0.1*sqrt(x-0.5)+0.1");
  assert_false(compile(&t, 2));
  assert_true(said(&t, "refers to itself"));
  assert_false(compile(&t, 4));
  assert_true(said(&t, "there is no field 77"));
  assert_false(compile(&t, 5));
  assert_true(said(&t, "option F"));
  assert_true(compile(&t, 1));
  double h = at(&t, 2, 0.5); // 0.05 - 0.1 < 0
  assert_true(h > 0 && isfinite(h));
  assert_true(size_eval_report(t.e, t.diag));
  assert_true(said(&t, "field 1 (MathEval)"));
  assert_true(said(&t, "(2, 0.5, 0)"));
  assert_false(size_eval_report(t.e, t.diag));
  at(&t, 0, 0.5); // infinite: no size there, no fault
  assert_false(size_eval_report(t.e, t.diag));
  assert_true(compile(&t, 6));
  h = at(&t, 0.1, 0.1);
  assert_true(h > 0 && isfinite(h));
  assert_true(size_eval_report(t.e, t.diag));
  assert_true(said(&t, "not a number"));
  tear_down(&t);
}

static void explanations_name_the_rule(void **state)
{
  (void)state;
  Set t = set_up();
  make(&t, 1, "MathEval"), text(&t, 1, "F", "0.1");
  make(&t, 2, "MathEval"), text(&t, 2, "F", "0.2");
  make(&t, 3, "Min"), list(&t, 3, "FieldsList", 2, 1);
  assert_true(compile(&t, 3));
  Str out = {0};
  size_explain(t.e, model_face(t.m, 1), (Vec3){0.5, 0.5, 0}, &out);
  assert_non_null(strstr(str_text(&out), "size 0.1 at (0.5, 0.5) in surface 1"));
  const char *one = strstr(str_text(&out), "Field[1]"), *two = strstr(str_text(&out), "Field[2]");
  assert_true(two && one && two < one);
  assert_non_null(strstr(one, "decides"));
  str_clear(&out);
  t.o.Mesh_MeshSizeMin = 0.5;
  assert_true(compile(&t, 3));
  size_explain(t.e, NULL, (Vec3){0.5, 0.5, 0}, &out);
  assert_non_null(strstr(str_text(&out), "Mesh.MeshSizeMin = 0.5  <- decides"));
  str_clear(&out);
  size_responsible(t.e, NULL, NULL, (Vec3){0.5, 0.5, 0}, &out);
  assert_string_equal(str_text(&out), "Mesh.MeshSizeMin");
  str_free(&out);
  tear_down(&t);
}

static void views_are_interpolated(void **state)
{
  (void)state;
  Set t = set_up();
  static const char pos[] = "View \"size\" { // comment\n"
                            "ST(0,0,0, 1,0,0, 0,1,0){0.1,0.2,0.3};\nSQ(1,0,0,2,0,0,2,1,0,1,1,0){0.2,0.2,0.4,0.4};\n"
                            "T2(0,0,0){\"text; {\"};\nVP(5,5,0){3,4,0};TP(-4,5,0){13,12,0,12,13,0,0,0,1};\nSS(0,0,0,1,0,0,0,1,0,0,0,1){1,1,1,1};};\n";
  assert_true(views_read_pos(t.f, "a.pos", pos, sizeof pos - 1, t.diag));
  fields_set_background_view(t.f, 0, NO_LOC);
  t.s = size_new(t.m, &t.o, t.f, t.diag);
  assert_non_null(t.s);
  t.e = size_eval_new(t.s);
  NEAR(at(&t, 0.25, 0.5), 0.1 + 0.025 + 0.1, 1e-15);
  NEAR(at(&t, 1.5, 0.5), 0.3, 1e-15);
  NEAR(at(&t, 0, -3), 0.1, 1e-15); // the nearest place
  NEAR(at(&t, 6, 6), size_diagonal(t.s), 0);
  NEAR(at(&t, -4, 5), 0.2, 1e-15); // the metric's eigenvalues are 25, 1 and 1
  assert_false(views_read_pos(t.f, "b.pos", "View \"x\" { ST(0,0,0){1}; };", 27, t.diag));
  assert_false(views_read_pos(t.f, "c.pos", "View \"x\" { SP(0,0,q){1}; };", 27, t.diag));
  make(&t, 1, "PostView"), num(&t, 1, "IView", 0), num(&t, 1, "UseClosest", 0);
  assert_true(compile(&t, 1));
  NEAR(at(&t, 0, -3), size_diagonal(t.s), 0);
  NEAR(at(&t, 0, 0), 0.1, 1e-15);
  make(&t, 2, "PostView"), num(&t, 2, "ViewIndex", 9);
  assert_false(compile(&t, 2));
  tear_down(&t);
}

static void grids_are_interpolated(void **state)
{
  (void)state;
  Set t = set_up();
  char path[] = "/tmp/meshgen-grid.XXXXXX";
  int fd = mkstemp(path);
  assert_true(fd >= 0);
  FILE *f = fdopen(fd, "w");
  fprintf(f, "0 0 0\n 1 1 1\n 3 2 1\n");
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 2; j++) fprintf(f, "%g ", 0.1 + 0.1 * i + 0.05 * j);
  fclose(f);
  make(&t, 1, "Structured"), text(&t, 1, "FileName", path), num(&t, 1, "TextFormat", 1);
  assert_true(compile(&t, 1));
  NEAR(at(&t, 0.5, 0.5), 0.1 + 0.05 + 0.025, 1e-15);
  NEAR(at(&t, 1.75, 0.25), 0.1 + 0.175 + 0.0125, 1e-15);
  NEAR(at(&t, 9, 0), 0.3, 1e-15);
  num(&t, 1, "SetOutsideValue", 1), num(&t, 1, "OutsideValue", 0.7);
  assert_true(compile(&t, 1));
  NEAR(at(&t, 9, 0), 0.7, 0);
  num(&t, 1, "TextFormat", 0);
  assert_false(compile(&t, 1));
  unlink(path);
  assert_false(compile(&t, 1));
  tear_down(&t);
}

static void automatic_sizes_see_gaps(void **state)
{
  (void)state;
  Set t = set_up();
  // A slit of width 0.02 in the square: a hole just below the top.
  double y[4] = {0.9, 0.9, 0.98, 0.98}, x[4] = {0.2, 0.8, 0.8, 0.2};
  for (int i = 0; i < 4; i++) model_add_point(t.m, 20 + i, (Vec3){x[i], y[i], 0}, 0, NO_LOC, t.diag);
  for (int i = 0; i < 4; i++)
    model_add_curve(t.m, CURVE_LINE, 20 + i, (int[]){20 + i, 20 + (i + 1) % 4}, 2, NULL, NULL, 0, NO_LOC, t.diag);
  model_add_loop(t.m, 20, (int[]){20, 21, 22, 23}, 4, NO_LOC, t.diag);
  model_add_face(t.m, FACE_PLANE, 2, (int[]){1, 20}, 2, NO_LOC, t.diag);
  assert_true(model_prepare(t.m, 1e-8, t.diag));
  make(&t, 1, "AutomaticMeshSizeField");
  num(&t, 1, "hBulk", 0.2), num(&t, 1, "nPointsPerGap", 4), num(&t, 1, "gradation", 1.2);
  assert_true(compile(&t, 1));
  double in_gap = at(&t, 0.5, 0.99), below = at(&t, 0.5, 0.85), far = at(&t, 0.5, 0.3);
  assert_true(in_gap < 0.02 / 4 * 1.5 && in_gap > 0.02 / 4 * 0.9);
  assert_true(below > in_gap && far > below && far <= 0.2);
  // Slopes are limited.
  Rng rng = {4};
  for (int i = 0; i < 200; i++) {
    double ax = rng_double(&rng), ay = rng_double(&rng), bx = ax + 0.05 * rng_double(&rng), by = ay + 0.05 * rng_double(&rng);
    assert_true(fabs(at(&t, ax, ay) - at(&t, bx, by)) <= 0.2 * hypot(bx - ax, by - ay) + 1e-12);
  }
  tear_down(&t);
}

static void extended_and_layer_sizes(void **state)
{
  (void)state;
  Set t = set_up();
  make(&t, 1, "Extend"), list(&t, 1, "CurvesList", 1, 0), num(&t, 1, "DistMax", 0.5), num(&t, 1, "SizeMax", 0.3), num(&t, 1, "Power", 1);
  assert_true(compile(&t, 1));
  NEAR(at(&t, 0.5, 0), 0.1, 1e-12);
  NEAR(at(&t, 0.5, 0.25), 0.2, 1e-12);
  NEAR(at(&t, 0.5, 0.9), 0.3, 1e-12);
  make(&t, 2, "BoundaryLayer"), list(&t, 2, "EdgesList", 1, 0), num(&t, 2, "hwall_n", 0.01), num(&t, 2, "thickness", 0.2);
  num(&t, 2, "ratio", 1.5), num(&t, 2, "hfar", 0.05);
  assert_true(compile(&t, 2));
  NEAR(at(&t, 0.5, 0), 0.01, 1e-12);
  NEAR(at(&t, 0.5, 0.04), 0.03, 1e-12);
  NEAR(at(&t, 0.5, 0.2), 0.05, 1e-12);
  NEAR(at(&t, 0.5, 0.4), size_diagonal(t.s), 0);
  tear_down(&t);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(expressions_have_their_values),
    cmocka_unit_test(bad_expressions_say_where),
    cmocka_unit_test(common_parts_are_computed_once),
    cmocka_unit_test(one_place_is_as_many),
    cmocka_unit_test(sines_are_within_an_ulp),
    cmocka_unit_test(the_nearest_of_all_is_found),
    cmocka_unit_test(hints_do_not_change_a_distance),
    cmocka_unit_test(cones_are_the_least_of_all),
    cmocka_unit_test(old_names_and_mistakes),
    cmocka_unit_test(shapes_have_their_values),
    cmocka_unit_test(thresholds_of_exact_distances),
    cmocka_unit_test(distance_to_a_spline_is_exact),
    cmocka_unit_test(fields_combine),
    cmocka_unit_test(batches_equal_single_places),
    cmocka_unit_test(sizes_are_clamped_then_scaled),
    cmocka_unit_test(bad_fields_are_reported),
    cmocka_unit_test(explanations_name_the_rule),
    cmocka_unit_test(views_are_interpolated),
    cmocka_unit_test(grids_are_interpolated),
    cmocka_unit_test(automatic_sizes_see_gaps),
    cmocka_unit_test(extended_and_layer_sizes),
  };
  return unit_run(tests);
}
