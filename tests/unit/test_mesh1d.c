// test_mesh1d.c - curves meshed by the size integral, by laws, as copies; parity; crossings
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>

#include "base/rng.h"
#include "geom/quadrature.h"
#include "mesh/mesh1d_int.h"
#include "model/model_edit.h"

#define NEAR(a, b, tol) \
  do { \
    double a_ = (a), b_ = (b); \
    if (!(fabs(a_ - b_) <= (tol))) fail_msg("%s = %.17g, not %.17g", #a, a_, b_); \
  } while (0)

typedef struct {
  Model *m;
  Options o;
  FieldSet *f;
  Diag *diag;
  SizeField *s;
  Mesh1d *g;
} Case;

static Case begin(void)
{
  Case t = {.m = model_new(), .f = fields_new(), .diag = diag_new(false)};
  options_init(&t.o);
  return t;
}

static void end(Case *t)
{
  mesh1d_free(t->g);
  size_free(t->s);
  fields_free(t->f);
  options_free(&t->o);
  model_free(t->m);
  diag_free(t->diag);
}

static int point(Case *t, int tag, double x, double y, double lc)
{
  return model_add_point(t->m, tag, (Vec3){x, y, 0}, lc, NO_LOC, t->diag);
}

static int curve(Case *t, CurveType type, int tag, int n, const int *p)
{
  return model_add_curve(t->m, type, tag, p, (size_t)n, NULL, NULL, 0, NO_LOC, t->diag);
}

static void line(Case *t, int tag, int a, int b)
{
  curve(t, CURVE_LINE, tag, 2, (int[]){a, b});
}

static void face(Case *t, int tag, int n, const int *c)
{
  model_add_loop(t->m, tag, c, (size_t)n, NO_LOC, t->diag);
  model_add_face(t->m, FACE_PLANE, tag, (int[]){tag}, 1, NO_LOC, t->diag);
}

static bool run(Case *t)
{
  mesh1d_free(t->g);
  size_free(t->s);
  t->g = NULL;
  if (!model_prepare(t->m, 1e-8, t->diag)) fail_msg("model: %s", diag_get(t->diag, 0)->text);
  t->s = size_new(t->m, &t->o, t->f, t->diag);
  assert_non_null(t->s);
  t->g = mesh1d_new(t->m, &t->o, t->s, t->diag);
  return t->g != NULL;
}

static uint32_t segments(const Case *t, int tag)
{
  const CurveMesh *cm = mesh1d_curve(t->g, tag);
  return cm->n ? cm->n - 1 : 0;
}

static void square(Case *t, double lc, int first)
{
  double x[4] = {0, 1, 1, 0}, y[4] = {0, 0, 1, 1};
  for (int i = 0; i < 4; i++) point(t, first + i, x[i], y[i], lc);
  for (int i = 0; i < 4; i++) line(t, first + i, first + i, first + (i + 1) % 4);
}

// ---- quadrature ---------------------------------------------------------------------------------------------------------

static void wave(void *ctx, const double *t, size_t n, double *f)
{
  double k = *(double *)ctx;
  for (size_t i = 0; i < n; i++) f[i] = 2 + sin(k * t[i]);
}

static double wave_sum(double k, double t)
{
  return 2 * t + (1 - cos(k * t)) / k;
}

static void integrals_and_their_inverses(void **state)
{
  (void)state;
  for (double k = 1; k < 300; k *= 7) {
    Integral q;
    integral_make(&q, wave, &k, 4, 1e-10, 1 << 16);
    NEAR(integral_total(&q), wave_sum(k, 1), 1e-10);
    double target[50], t[50];
    for (int i = 0; i < 50; i++) target[i] = integral_total(&q) * i / 49;
    integral_inverse(&q, target, 50, t);
    for (int i = 0; i < 50; i++) {
      NEAR(wave_sum(k, t[i]), target[i], 1e-9);
      NEAR(integral_upto(&q, t[i]), target[i], 1e-12);
    }
    NEAR(integral_value(&q, 0.37), 2 + sin(0.37 * k), 1e-4);
    integral_free(&q);
  }
}

static void step(void *ctx, const double *t, size_t n, double *f)
{
  (void)ctx;
  for (size_t i = 0; i < n; i++) f[i] = t[i] < 1 / M_PI ? 100 : 1;
}

static void jumps_are_found(void **state)
{
  (void)state;
  Integral q;
  integral_make(&q, step, NULL, 16, 1e-9, 1 << 16);
  NEAR(integral_total(&q), 100 / M_PI + 1 - 1 / M_PI, 1e-8);
  integral_free(&q);
}

// ---- laws ---------------------------------------------------------------------------------------------------------------

static void laws_are_as_specified(void **state)
{
  (void)state;
  double s[64];
  law_fractions(LAW_PROGRESSION, 1.5, 6, s);
  for (int i = 1; i < 5; i++) NEAR((s[i + 1] - s[i]) / (s[i] - s[i - 1]), 1.5, 1e-12);
  law_fractions(LAW_PROGRESSION, 1 / 1.5, 6, s);
  for (int i = 1; i < 5; i++) NEAR((s[i + 1] - s[i]) / (s[i] - s[i - 1]), 1 / 1.5, 1e-12);
  // Measured: 7 nodes, b = 0.1; b = 5 on length 2.
  law_fractions(LAW_BUMP, 0.1, 7, s);
  double a[3] = {0.0587, 0.156, 0.2853}, b[3] = {0.5452, 0.2614, 0.1934};
  for (int i = 0; i < 3; i++) NEAR(s[i + 1] - s[i], a[i], 6e-5);
  law_fractions(LAW_BUMP, 5, 7, s);
  for (int i = 0; i < 3; i++) NEAR(2 * (s[i + 1] - s[i]), b[i], 6e-5);
  law_fractions(LAW_BETA, 1.05, 11, s);
  for (int i = 1; i < 10; i++) assert_true(s[i + 1] - s[i] > s[i] - s[i - 1]);
  double coefs[] = {1, 0, -3, INFINITY};
  for (size_t k = 0; k < ARRAY_LEN(coefs); k++) {
    law_fractions(LAW_PROGRESSION, coefs[k], 5, s);
    for (int i = 0; i < 5; i++) NEAR(s[i], i / 4.0, 0);
  }
  double many[2000];
  for (double r = 0.1; r < 10; r *= 1.3) {
    law_fractions(LAW_PROGRESSION, r, 2000, many);
    for (int i = 1; i < 2000; i++) assert_true(many[i] >= many[i - 1]);
    assert_true(many[0] == 0 && many[1999] == 1);
  }
}

// ---- by size ----------------------------------------------------------------------------------------------------------------

static void counts_are_gmshs(void **state)
{
  (void)state;
  // Line of length 1: size, size at the other end, segments by Gmsh 4.8.4.
  static const struct {
    double a, b;
    uint32_t n;
  } cases[] = {{0.1, 0.1, 10}, {0.3, 0.3, 4}, {0.09995, 0.09995, 10}, {0.0985, 0.0985, 11}, {5, 5, 1}, {0.1, 2, 4}, {2, 0.1, 3},
               {0.1, 0.3, 6}};
  for (size_t i = 0; i < ARRAY_LEN(cases); i++) {
    Case t = begin();
    point(&t, 1, 0, 0, cases[i].a), point(&t, 2, 1, 0, cases[i].b);
    line(&t, 1, 1, 2);
    assert_true(run(&t));
    if (segments(&t, 1) != cases[i].n) fail_msg("%g %g: %u segments", cases[i].a, cases[i].b, segments(&t, 1));
    end(&t);
  }
}

// Adimensional length of every edge by fine Simpson sums.
static double edge_length(const Case *t, SizeEval *e, const Curve *c, double u0, double u1)
{
  enum { N = 2000 };
  double sum = 0;
  for (int i = 0; i <= N; i++) {
    double u = u0 + (u1 - u0) * i / N;
    double f = vec3_length(curve_deriv(t->m, c, u)) / size_on_curve(e, c, u, curve_point(t->m, c, u));
    sum += f * (i == 0 || i == N ? 1 : i % 2 ? 4 : 2);
  }
  return sum * (u1 - u0) / N / 3;
}

static void edges_have_equal_adimensional_length(void **state)
{
  (void)state;
  Case t = begin();
  point(&t, 1, 0, 0, 0), point(&t, 2, 3, 1, 0), point(&t, 3, 4, 3, 0), point(&t, 4, 6, 0, 0), point(&t, 5, 8, 2, 0);
  curve(&t, CURVE_SPLINE, 1, 5, (int[]){1, 2, 3, 4, 5});
  curve(&t, CURVE_BSPLINE, 2, 5, (int[]){1, 2, 3, 4, 5});
  curve(&t, CURVE_BEZIER, 3, 5, (int[]){1, 2, 3, 4, 5});
  line(&t, 4, 1, 5);
  point(&t, 6, 2, 0, 0), point(&t, 7, 0, 2, 0);
  curve(&t, CURVE_CIRCLE, 5, 3, (int[]){6, 1, 7});
  t.o.Mesh_MeshSizeFromPoints = false;
  field_create(t.f, 1, "MathEval", NO_LOC, t.diag);
  field_set_string(t.f, 1, "F", "0.1+0.02*sin(3*x)*cos(2*y)", NO_LOC, t.diag);
  fields_set_background(t.f, 1, NO_LOC);
  assert_true(run(&t));
  SizeEval *e = size_eval_new(t.s);
  for (int tag = 1; tag <= 5; tag++) {
    const CurveMesh *cm = mesh1d_curve(t.g, tag);
    const Curve *c = model_curve(t.m, tag);
    double n = cm->n - 1, total = 0, tau = 0;
    for (uint32_t i = 0; i + 1 < cm->n; i++) total += edge_length(&t, e, c, cm->u[i], cm->u[i + 1]);
    assert_true(total <= n + 1e-6 && total >= n - 1);
    for (uint32_t i = 0; i + 1 < cm->n; i++) {
      double l = edge_length(&t, e, c, cm->u[i], cm->u[i + 1]);
      NEAR(l, total / n, 2e-9);
      assert_true(l > 2.0 / 3 && l < 4.0 / 3);
      tau += l < 1 ? l - 1 : 1 / l - 1;
    }
    assert_true(exp(tau / n) > 0.98);
    assert_true(cm->u[0] == 0 && cm->u[cm->n - 1] == 1);
    NEAR(vec3_distance(cm->p[0], model_point(t.m, c->begin)->xyz), 0, 0);
    NEAR(vec3_distance(cm->p[cm->n - 1], model_point(t.m, c->end)->xyz), 0, 0);
  }
  size_eval_free(e);
  end(&t);
}

static void threads_do_not_show(void **state)
{
  (void)state;
  double *first = NULL;
  size_t total = 0;
  for (int threads = 1; threads <= 3; threads += 2) {
    Case t = begin();
    t.o.General_NumThreads = threads;
    Rng rng = {11};
    for (int i = 1; i <= 60; i++) point(&t, i, rng_double(&rng) * 10, rng_double(&rng) * 10, 0.05 + rng_double(&rng));
    for (int i = 1; i < 58; i++) curve(&t, CURVE_SPLINE, i, 4, (int[]){i, i + 1, i + 2, i + 3});
    assert_true(run(&t));
    size_t at = 0;
    for (size_t k = 0; k < t.g->ncurve; k++) at += t.g->curve[k].n;
    if (threads == 1) first = malloc(at * sizeof *first), total = at;
    assert_int_equal(at, total);
    at = 0;
    for (size_t k = 0; k < t.g->ncurve; k++) {
      for (uint32_t i = 0; i < t.g->curve[k].n; i++, at++) {
        if (threads == 1) first[at] = t.g->curve[k].u[i];
        else assert_true(first[at] == t.g->curve[k].u[i]);
      }
    }
    end(&t);
  }
  free(first);
}

static void least_counts(void **state)
{
  (void)state;
  Case t = begin();
  point(&t, 1, 0, 0, 100), point(&t, 2, 1, 0, 100), point(&t, 3, -1, 0, 100), point(&t, 4, 0, 1, 100);
  curve(&t, CURVE_CIRCLE, 1, 3, (int[]){2, 1, 4});
  curve(&t, CURVE_SPLINE, 2, 3, (int[]){2, 4, 3});
  line(&t, 3, 3, 2);
  curve(&t, CURVE_SPLINE, 4, 5, (int[]){2, 4, 3, 1, 2}); // closed
  face(&t, 1, 2, (int[]){2, 3});
  assert_true(run(&t));
  assert_int_equal(segments(&t, 1), 2); // int(0.99 + 6/4)
  assert_int_equal(segments(&t, 2), 2);
  assert_int_equal(segments(&t, 3), 2); // of a loop of two curves
  end(&t);
}

static void gradation_of_the_whole_mesh(void **state)
{
  (void)state;
  Case t = begin();
  point(&t, 1, 0, 0, 0.01), point(&t, 2, 1, 0, 1), point(&t, 3, 2, 0, 1), point(&t, 4, 3, 0, 1);
  for (int i = 1; i < 4; i++) line(&t, i, i, i + 1);
  t.o.Mesh_SizeGradation = 1.2;
  assert_true(run(&t));
  double before = 0;
  for (int tag = 1; tag < 4; tag++) {
    const CurveMesh *cm = mesh1d_curve(t.g, tag);
    for (uint32_t i = 0; i + 1 < cm->n; i++) {
      double d = vec3_distance(cm->p[i], cm->p[i + 1]);
      assert_true(fabs(cm->h[i + 1] - cm->h[i]) <= 0.2 * d * (1 + 1e-9));
      // Neighbouring edges, also of two curves, differ by no more than the growth over them and rounding to whole numbers.
      if (before > 0) assert_true(d / before < 1.45 && before / d < 1.45);
      before = d;
    }
  }
  end(&t);
}

static void gradation_reaches_into_faces(void **state)
{
  (void)state;
  Case t = begin();
  square(&t, 0.2, 1);
  model_set_size(t.m, (int[]){1}, 1, 0.01);
  face(&t, 1, 4, (int[]){1, 2, 3, 4});
  t.o.Mesh_SizeGradation = 1.15;
  field_create(t.f, 1, "Ball", NO_LOC, t.diag); // a jump of the field
  field_set_number(t.f, 1, "VIn", 0.02, NO_LOC, t.diag);
  field_set_number(t.f, 1, "Radius", 0.1, NO_LOC, t.diag);
  field_set_number(t.f, 1, "XCenter", 0.6, NO_LOC, t.diag);
  field_set_number(t.f, 1, "YCenter", 0.6, NO_LOC, t.diag);
  fields_set_background(t.f, 1, NO_LOC);
  assert_true(run(&t));
  mesh1d_limit_faces(t.g, t.s);
  SizeEval *e = size_eval_new(t.s);
  const Face *f = model_face(t.m, 1);
  NEAR(size_in_face(e, f, (Vec3){0.6, 0.6, 0}), 0.02, 1e-15);
  assert_true(size_in_face(e, f, (Vec3){0.001, 0.001, 0}) < 0.011);
  Rng rng = {8};
  for (int i = 0; i < 2000; i++) {
    Vec3 a = {rng_double(&rng), rng_double(&rng), 0}, b = {a.x + 0.2 * rng_double(&rng), a.y + 0.2 * rng_double(&rng), 0};
    double ha = size_in_face(e, f, a), hb = size_in_face(e, f, b);
    // Exact away from the jump, whose samples are as far apart as the size in it.
    assert_true(fabs(ha - hb) <= 0.15 * vec3_distance(a, b) + 0.15 * 0.03);
  }
  size_eval_free(e);
  end(&t);
}

// ---- prescribed -------------------------------------------------------------------------------------------------------------

static void transfinite_and_copies(void **state)
{
  (void)state;
  Case t = begin();
  square(&t, 0.1, 1);
  face(&t, 1, 4, (int[]){1, 2, 3, 4});
  model_set_transfinite_curve(t.m, (int[]){1}, 1, 7, LAW_PROGRESSION, 1.3, NO_LOC, t.diag);
  Affine up = affine_translation((Vec3){0, 1, 0});
  model_set_periodic_curves(t.m, (int[]){3}, (int[]){-1}, 1, &up, NO_LOC, t.diag);
  model_set_periodic_curves(t.m, (int[]){4}, (int[]){-2}, 1, NULL, NO_LOC, t.diag);
  assert_true(run(&t));
  const CurveMesh *a = mesh1d_curve(t.g, 1), *b = mesh1d_curve(t.g, 3);
  assert_int_equal(a->n, 7);
  assert_int_equal(b->n, 7);
  for (uint32_t i = 0; i < 7; i++) {
    NEAR(a->p[i].x, b->p[6 - i].x, 1e-14);
    NEAR(b->p[i].y, 1, 0);
  }
  NEAR((a->u[2] - a->u[1]) / (a->u[1] - a->u[0]), 1.3, 1e-12);
  assert_int_equal(segments(&t, 4), segments(&t, 2));
  end(&t);

  t = begin(); // a map that does not fit
  square(&t, 0.1, 1);
  Affine away = affine_translation((Vec3){0, 0.5, 0});
  model_set_periodic_curves(t.m, (int[]){3}, (int[]){-1}, 1, &away, NO_LOC, t.diag);
  if (model_prepare(t.m, 1e-8, t.diag)) assert_false(run(&t));
  assert_true(diag_errors(t.diag) > 0);
  end(&t);
}

static void extruded_layers(void **state)
{
  (void)state;
  Case t = begin();
  point(&t, 1, 0, 0, 0.1), point(&t, 2, 1, 0, 0.1);
  line(&t, 1, 1, 2);
  Sweep s = {.translate = true, .shift = {0, 2, 0}};
  int count[2] = {3, 2};
  double height[2] = {0.75, 1};
  s.layers = (Layers){2, count, height, false};
  ShapeVec out = {0};
  assert_true(model_extrude(t.m, &(Shape){1, 1}, 1, &s, &out, NO_LOC, t.diag));
  assert_true(run(&t));
  const CurveMesh *top = mesh1d_curve(t.g, out.data[0].tag), *side = mesh1d_curve(t.g, out.data[2].tag);
  assert_int_equal(top->n, 11);
  assert_int_equal(side->n, 6);
  double want[6] = {0, 0.25, 0.5, 0.75, 0.875, 1};
  for (int i = 0; i < 6; i++) NEAR(side->u[i], want[i], 1e-15);
  vec_free(&out);
  end(&t);
}

static void recombined_faces_have_even_boundaries(void **state)
{
  (void)state;
  Rng rng = {21};
  for (int round = 0; round < 30; round++) {
    Case t = begin();
    enum { N = 4 }; // a grid of N x N squares with odd sizes
    for (int j = 0; j <= N; j++)
      for (int i = 0; i <= N; i++) point(&t, 1 + i + (N + 1) * j, i + 0.3 * rng_double(&rng), j + 0.3 * rng_double(&rng), 0.1 + 0.2 * rng_double(&rng));
    for (int j = 0; j <= N; j++)
      for (int i = 0; i <= N; i++) {
        int p = 1 + i + (N + 1) * j;
        if (i < N) line(&t, p, p, p + 1);
        if (j < N) line(&t, 100 + p, p, p + N + 1);
      }
    for (int j = 0; j < N; j++)
      for (int i = 0; i < N; i++) {
        int p = 1 + i + (N + 1) * j;
        face(&t, p, 4, (int[]){p, 100 + p + 1, -(p + N + 1), -(100 + p)});
      }
    assert_true(run(&t));
    size_t before = 0, after = 0;
    for (size_t k = 0; k < t.g->ncurve; k++) before += t.g->curve[k].n;
    t.o.Mesh_RecombineAll = true;
    assert_true(run(&t));
    for (size_t k = 0; k < t.g->ncurve; k++) after += t.g->curve[k].n;
    for (size_t k = 0; k < model_loops(t.m); k++) {
      const Loop *l = model_loop_at(t.m, k);
      uint32_t sum = 0;
      for (int i = 0; i < l->ncurve; i++) sum += segments(&t, l->curve[i]);
      assert_int_equal(sum % 2, 0);
    }
    assert_true(after >= before && after - before <= N * N);
    end(&t);
  }
  Case t = begin();
  square(&t, 0.11, 1);
  face(&t, 1, 4, (int[]){1, 2, 3, 4});
  model_set_recombine(t.m, (int[]){1}, 1, 45, NO_LOC, t.diag);
  assert_true(run(&t));
  for (int i = 1; i <= 4; i++) assert_int_equal(segments(&t, i), 10);
  t.o.Mesh_RecombinationAlgorithm = 2;
  assert_true(run(&t));
  for (int i = 1; i <= 4; i++) assert_int_equal(segments(&t, i), 12);
  end(&t);
}

static void degenerate_curves_have_no_mesh(void **state)
{
  (void)state;
  Case t = begin();
  square(&t, 0.1, 1);
  t.o.Mesh_ToleranceEdgeLength = 2;
  assert_true(run(&t));
  for (int i = 1; i <= 4; i++) assert_int_equal(mesh1d_curve(t.g, i)->n, 0);
  end(&t);
}

static void too_many_elements_are_refused(void **state)
{
  (void)state;
  Case t = begin();
  point(&t, 1, 0, 0, 1e-6), point(&t, 2, 1, 0, 1e-6);
  line(&t, 1, 1, 2);
  t.o.Mesh_MaxElements = 1e5;
  assert_false(run(&t));
  assert_non_null(strstr(diag_get(t.diag, 0)->text, "curve 1 alone 1e+06"));
  end(&t);
}

static void splitting_keeps_order(void **state)
{
  (void)state;
  Case t = begin();
  point(&t, 1, 0, 0, 1), point(&t, 2, 3, 1, 1), point(&t, 3, 4, 3, 1);
  curve(&t, CURVE_SPLINE, 1, 3, (int[]){1, 2, 3});
  assert_true(run(&t));
  CurveMesh *cm = mesh1d_curve(t.g, 1);
  uint32_t n = cm->n;
  assert_int_equal(mesh1d_split(t.g, 0, 1, -1), 2);
  assert_int_equal(cm->n, n + 1);
  for (uint32_t i = 1; i < cm->n; i++) assert_true(cm->u[i] > cm->u[i - 1]);
  double l = 0, r = 0; // both parts have the same length
  for (int i = 0; i < 1000; i++) {
    double a = cm->u[1] + (cm->u[2] - cm->u[1]) * i / 1000, b = cm->u[1] + (cm->u[2] - cm->u[1]) * (i + 1) / 1000;
    l += vec3_distance(curve_point(t.m, model_curve(t.m, 1), a), curve_point(t.m, model_curve(t.m, 1), b));
    a = cm->u[2] + (cm->u[3] - cm->u[2]) * i / 1000, b = cm->u[2] + (cm->u[3] - cm->u[2]) * (i + 1) / 1000;
    r += vec3_distance(curve_point(t.m, model_curve(t.m, 1), a), curve_point(t.m, model_curve(t.m, 1), b));
  }
  NEAR(l, r, 1e-6);
  end(&t);
}

// ---- crossings ----------------------------------------------------------------------------------------------------------------

// A disk in a disk, eccentric, a thousandth apart at one place: coarse edges cross there.
static void close_circles_are_untangled(void **state)
{
  (void)state;
  Case t = begin();
  point(&t, 1, 0, 0, 1), point(&t, 2, 1, 0, 1), point(&t, 3, -1, 0, 1), point(&t, 4, 0, 1, 1), point(&t, 5, 0, -1, 1);
  int around[4] = {2, 4, 3, 5};
  for (int i = 0; i < 4; i++) curve(&t, CURVE_CIRCLE, i + 1, 3, (int[]){around[i], 1, around[(i + 1) % 4]});
  // Turned by a little, so that its nodes do not stand behind those of the large one.
  double r = 0.9, cx = 0.099, a0 = 0.35;
  point(&t, 10, cx, 0, 1);
  for (int i = 0; i < 4; i++) point(&t, 11 + i, cx + r * cos(a0 + i * M_PI / 2), r * sin(a0 + i * M_PI / 2), 1);
  for (int i = 0; i < 4; i++) curve(&t, CURVE_CIRCLE, i + 11, 3, (int[]){11 + i, 10, 11 + (i + 1) % 4});
  model_add_loop(t.m, 1, (int[]){1, 2, 3, 4}, 4, NO_LOC, t.diag);
  model_add_loop(t.m, 2, (int[]){11, 12, 13, 14}, 4, NO_LOC, t.diag);
  model_add_face(t.m, FACE_PLANE, 1, (int[]){1, 2}, 2, NO_LOC, t.diag);
  assert_true(run(&t));
  assert_true(t.g->rounds >= 1 && t.g->nsplit >= 1);
  uint32_t rounds = t.g->rounds;
  assert_true(mesh1d__untangle(t.g, &t.o, NULL, t.diag));
  assert_int_equal(t.g->rounds, rounds);
  // All nodes are on their circles.
  for (int i = 11; i <= 14; i++) {
    const CurveMesh *cm = mesh1d_curve(t.g, i);
    for (uint32_t k = 0; k < cm->n; k++) NEAR(hypot(cm->p[k].x - cx, cm->p[k].y), r, 1e-14);
  }
  end(&t);
}

static void true_crossings_are_errors(void **state)
{
  (void)state;
  Case t = begin(); // a bow tie
  point(&t, 1, 0, 0, 0.3), point(&t, 2, 1, 1, 0.3), point(&t, 3, 1, 0, 0.3), point(&t, 4, 0, 1, 0.3);
  for (int i = 1; i <= 4; i++) line(&t, i, i, i % 4 + 1);
  face(&t, 1, 4, (int[]){1, 2, 3, 4});
  assert_false(run(&t));
  assert_non_null(strstr(diag_get(t.diag, 0)->text, "curve 3 crosses curve 1 at (0.5, 0.5)"));
  end(&t);

  t = begin(); // an arc through a line
  point(&t, 1, -2, 0, 0.3), point(&t, 2, 2, 0, 0.3), point(&t, 3, 0, -3, 0.3);
  point(&t, 4, 0, 0.5, 0), point(&t, 5, 1, 0.5, 0.3), point(&t, 6, 0, 1.5, 0.3), point(&t, 7, -0.8, -0.1, 0.3);
  line(&t, 1, 1, 2), line(&t, 2, 2, 3), line(&t, 3, 3, 1);
  curve(&t, CURVE_CIRCLE, 4, 3, (int[]){5, 4, 7});
  face(&t, 1, 3, (int[]){1, 2, 3});
  model_embed(t.m, 1, (int[]){4}, 1, 1, NO_LOC, t.diag);
  assert_false(run(&t));
  assert_non_null(strstr(diag_get(t.diag, 0)->text, "curve 4, embedded in surface 1, leaves it through curve 1 at ("));
  end(&t);

  t = begin(); // a line along another
  square(&t, 0.3, 1);
  face(&t, 1, 4, (int[]){1, 2, 3, 4});
  point(&t, 9, 0.5, 0, 0.3), point(&t, 10, 0.7, 0, 0.3);
  line(&t, 9, 9, 10);
  model_embed(t.m, 1, (int[]){9}, 1, 1, NO_LOC, t.diag);
  assert_false(run(&t));
  assert_non_null(strstr(diag_get(t.diag, 0)->text, "curve 9 overlaps curve 1"));
  end(&t);

  t = begin(); // the same two faces apart do not disturb each other
  square(&t, 0.3, 1);
  face(&t, 1, 4, (int[]){1, 2, 3, 4});
  square(&t, 0.2, 11);
  face(&t, 2, 4, (int[]){11, 12, 13, 14});
  assert_true(run(&t));
  end(&t);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(integrals_and_their_inverses),
    cmocka_unit_test(jumps_are_found),
    cmocka_unit_test(laws_are_as_specified),
    cmocka_unit_test(counts_are_gmshs),
    cmocka_unit_test(edges_have_equal_adimensional_length),
    cmocka_unit_test(threads_do_not_show),
    cmocka_unit_test(least_counts),
    cmocka_unit_test(gradation_of_the_whole_mesh),
    cmocka_unit_test(gradation_reaches_into_faces),
    cmocka_unit_test(transfinite_and_copies),
    cmocka_unit_test(extruded_layers),
    cmocka_unit_test(recombined_faces_have_even_boundaries),
    cmocka_unit_test(degenerate_curves_have_no_mesh),
    cmocka_unit_test(too_many_elements_are_refused),
    cmocka_unit_test(splitting_keeps_order),
    cmocka_unit_test(close_circles_are_untangled),
    cmocka_unit_test(true_crossings_are_errors),
  };
  return unit_run(tests);
}
