// test_cross.c - cross fields: aligned, smooth, with the singularities that topology and sizes ask for
// SPDX-License-Identifier: MIT
#include "unit.h"

#include "base/mem.h"
#include "base/rng.h"
#include "quad/cross_field.h"
#include "tri/refine.h"

#include <math.h>

typedef struct {
  DoubleVec xy;
  U32Vec ends;
} Outline;

static void close_loop(Outline *o, size_t first)
{
  for (size_t i = first, end = o->xy.len / 2; i < end; i++) {
    vec_push(&o->ends, (uint32_t)i);
    vec_push(&o->ends, (uint32_t)(i + 1 < end ? i + 1 : first));
  }
}

static void polygon(Outline *o, const Vec2 *p, size_t n, double h)
{
  size_t first = o->xy.len / 2;
  for (size_t i = 0; i < n; i++) {
    Vec2 a = p[i], d = vec2_sub(p[(i + 1) % n], a);
    int k = (int)ceil(vec2_length(d) / h - 0.01);
    for (int j = 0; j < k; j++) vec_push(&o->xy, a.x + d.x * j / k), vec_push(&o->xy, a.y + d.y * j / k);
  }
  close_loop(o, first);
}

static void circle(Outline *o, Vec2 c, double radius, int n)
{
  size_t first = o->xy.len / 2;
  for (int i = 0; i < n; i++)
    vec_push(&o->xy, c.x + radius * cos(2 * M_PI * i / n)), vec_push(&o->xy, c.y + radius * sin(2 * M_PI * i / n));
  close_loop(o, first);
}

// A mesh of triangles inside the outline; the outline is consumed.
typedef struct {
  Tri tri;
  U32Vec corner;
} Inside;

static double longest(void *ctx, Vec2 p) { return (void)p, *(double *)ctx; }

static Inside mesh_inside(Outline *o, double h)
{
  Inside in = {.corner = {0}};
  tri_init(&in.tri);
  TriBuild how = {.reorder = false};
  assert_int_equal(tri_build(&in.tri, o->xy.data, o->xy.len / 2, &how), TRI_BUILD_GOOD);
  assert_int_equal(tri_insert_segments(&in.tri, o->ends.data, NULL, o->ends.len / 2, NULL), 0);
  tri_carve(&in.tri, &(TriCarve){.even_odd = true});
  TriRefineParams p = tri_refine_defaults();
  p.algorithm = REFINE_DELAUNAY, p.size = longest, p.size_ctx = &h;
  tri_refine(&in.tri, &p);
  for (TriId t = 0; t < in.tri.nt; t++)
    for (EdgeId e = 3 * t; tri_is_inside(&in.tri, t) && e < 3 * t + 3; e++) vec_push(&in.corner, in.tri.vert[e]);
  vec_free(&o->xy), vec_free(&o->ends);
  return in;
}

static CrossField *field_inside(const Inside *in, const double *size)
{
  CrossInput input = {in->tri.xy, in->tri.nv, in->corner.data, in->corner.len / 3, NULL, 0, size};
  return cross_field_new(&input);
}

static void inside_free(Inside *in)
{
  tri_free(&in->tri);
  vec_free(&in->corner);
}

// Singularities of index +1/4 and -1/4; their sum and the boundary's is the Euler characteristic [book §5.1.4].
static void count(const CrossField *f, size_t *plus, size_t *minus, long euler)
{
  const CrossSingularity *s;
  size_t n = cross_field_singularities(f, &s);
  long sum = cross_field_boundary_index4(f);
  *plus = *minus = 0;
  for (size_t i = 0; i < n; i++) {
    assert_true(s[i].index4 == 1 || s[i].index4 == -1);
    sum += s[i].index4;
    *(s[i].index4 > 0 ? plus : minus) += 1;
  }
  assert_int_equal(cross_field_euler(f), euler);
  assert_int_equal(sum, 4 * euler);
}

static double turned(double a, double b) { return fabs(remainder(a - b, M_PI / 2)); }

static void test_indices_sum_to_the_euler_characteristic(void **state)
{
  (void)state;
  const Vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, ell[] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const Vec2 triangle[] = {{0, 0}, {1, 0}, {0.5, 0.8660254037844386}};
  const struct {
    size_t plus, minus;
    long euler, corners;
  } want[] = {{4, 0, 1, 0}, {0, 0, 1, 4}, {0, 0, 1, 4}, {1, 0, 1, 3}, {0, 0, 0, 0}, {0, 4, 0, 4}};
  for (int k = 0; k < 6; k++) {
    Outline o = {0};
    switch (k) {
    case 0: circle(&o, (Vec2){0, 0}, 1, 60); break;
    case 1: polygon(&o, square, 4, 0.05); break;
    case 2: polygon(&o, ell, 6, 0.08); break;
    case 3: polygon(&o, triangle, 3, 0.05); break;
    case 4: circle(&o, (Vec2){0, 0}, 1, 60), circle(&o, (Vec2){0, 0}, 0.4, 30); break;
    default: polygon(&o, square, 4, 0.05), circle(&o, (Vec2){0.5, 0.5}, 0.2, 30);
    }
    Inside in = mesh_inside(&o, 0.08);
    CrossField *f = field_inside(&in, NULL);
    size_t plus, minus;
    count(f, &plus, &minus, want[k].euler);
    if (plus != want[k].plus || minus != want[k].minus) print_error("case %d: %zu of 1/4, %zu of -1/4\n", k, plus, minus);
    assert_true(plus == want[k].plus && minus == want[k].minus);
    assert_int_equal(cross_field_boundary_index4(f), want[k].corners);
    cross_field_free(f);
    inside_free(&in);
  }
}

static void test_a_disc_keeps_its_singularities_apart(void **state)
{
  (void)state;
  Outline o = {0};
  circle(&o, (Vec2){0, 0}, 1, 100);
  Inside in = mesh_inside(&o, 0.05);
  CrossField *f = field_inside(&in, NULL);
  const CrossSingularity *s;
  assert_int_equal(cross_field_singularities(f, &s), 4);
  for (int i = 0; i < 4; i++) {
    double r = hypot(s[i].p.x, s[i].p.y);
    assert_true(r > 0.6 && r < 0.85); // the corners of a square; of least energy at (3/5)^(1/8) of the radius or within
    for (int j = 0; j < i; j++) assert_true(hypot(s[i].p.x - s[j].p.x, s[i].p.y - s[j].p.y) > 0.8);
  }
  cross_field_free(f);
  inside_free(&in);
}

static void test_crosses_follow_the_boundary(void **state)
{
  (void)state;
  Outline o = {0};
  circle(&o, (Vec2){0, 0}, 1, 80), circle(&o, (Vec2){0.1, 0}, 0.5, 50);
  Inside in = mesh_inside(&o, 0.08);
  CrossField *f = field_inside(&in, NULL);
  for (uint32_t v = 0; v < 130; v++) {
    Vec2 p = {in.tri.xy[2 * v], in.tri.xy[2 * v + 1]};
    uint32_t near = cross_field_at_vertex(f, v);
    double radial = v < 80 ? atan2(p.y, p.x) : atan2(p.y, p.x - 0.1);
    assert_true(turned(cross_field_angle(f, p, &near), radial) < 1e-9);
  }
  cross_field_free(f);
  inside_free(&in);
}

static void test_a_tilted_square_has_tilted_crosses(void **state)
{
  (void)state;
  double a = 0.3, c = cos(a), s = sin(a);
  Outline o = {0};
  polygon(&o, (Vec2[]){{0, 0}, {c, s}, {c - s, s + c}, {-s, c}}, 4, 0.1);
  Inside in = mesh_inside(&o, 0.1);
  CrossField *f = field_inside(&in, NULL);
  Rng rng = {3};
  for (int i = 0; i < 500; i++) {
    double x = rng_double(&rng), y = rng_double(&rng);
    uint32_t near = NONE;
    assert_true(turned(cross_field_angle(f, (Vec2){c * x - s * y, s * x + c * y}, &near), a) < 1e-3);
    assert_true(near < in.corner.len / 3);
  }
  cross_field_free(f);
  inside_free(&in);
}

// Sizes proportional to the distance from a point ask for a polar grid: crosses turn with the angle, in a part of it that has no
// boundary of its own to say so, and four singularities come where the sizes stop shrinking.
static void test_crosses_turn_as_sizes_ask(void **state)
{
  (void)state;
  Outline o = {0};
  polygon(&o, (Vec2[]){{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 4, 0.05);
  Inside in = mesh_inside(&o, 0.05);
  double *size = mem_alloc(in.tri.nv * sizeof *size);
  for (VertId v = 0; v < in.tri.nv; v++)
    size[v] = 0.1 * fmin(0.7, fmax(0.2, hypot(in.tri.xy[2 * v], in.tri.xy[2 * v + 1])));
  CrossField *f = field_inside(&in, size);
  size_t plus, minus;
  count(f, &plus, &minus, 1);
  assert_true(plus == 4 && minus == 4);
  for (int i = 0; i < 24; i++) {
    double a = 2 * M_PI * i / 24;
    uint32_t near = NONE;
    assert_true(turned(cross_field_angle(f, (Vec2){0.4 * cos(a), 0.4 * sin(a)}, &near), a) < 0.12);
  }
  free(size);
  cross_field_free(f);
  inside_free(&in);
}

static void test_degenerate_input(void **state)
{
  (void)state;
  CrossField *none = cross_field_new(&(CrossInput){0});
  uint32_t near = NONE;
  assert_true(cross_field_angle(none, (Vec2){0, 0}, &near) == 0);
  assert_int_equal(cross_field_at_vertex(none, 0), NONE);
  cross_field_free(none);
  const double xy[] = {0, 0, 1, 0, 0, 1, 9, 9};
  const uint32_t tri[] = {0, 1, 2};
  CrossField *one = cross_field_new(&(CrossInput){xy, 4, tri, 1, NULL, 0, NULL}); // vertex 3 is in no triangle
  near = NONE;
  assert_true(isfinite(cross_field_angle(one, (Vec2){0.2, 0.2}, &near)) && near == 0);
  assert_true(isfinite(cross_field_angle(one, (Vec2){5, 5}, &near)) && near == 0);
  assert_int_equal(cross_field_at_vertex(one, 3), NONE);
  assert_int_equal(cross_field_euler(one), 1);
  cross_field_free(one);
  cross_field_free(NULL);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_indices_sum_to_the_euler_characteristic),
      cmocka_unit_test(test_a_disc_keeps_its_singularities_apart),
      cmocka_unit_test(test_crosses_follow_the_boundary),
      cmocka_unit_test(test_a_tilted_square_has_tilted_crosses),
      cmocka_unit_test(test_crosses_turn_as_sizes_ask),
      cmocka_unit_test(test_degenerate_input),
  };
  return unit_run(tests);
}
