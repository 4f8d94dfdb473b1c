// test_arrangement.c - faces of lines, arcs and splines: Euler's formula, areas, and what lies in what
// SPDX-License-Identifier: MIT
#include "unit.h"

#include "geom/arrangement.h"

#define PI 3.14159265358979323846

static ArrCurve line(double x0, double y0, double x1, double y1)
{
  return (ArrCurve){.kind = ARR_LINE, .p = {x0, y0}, .q = {x1, y1}};
}

static ArrCurve ellipse(double x, double y, double a, double b, double from, double to)
{
  ArrCurve c = {.kind = ARR_ARC, .c = {x, y}, .a = {a, 0}, .b = {0, b}, .t0 = from, .t1 = to};
  c.p = (Vec2){x + a * cos(from), y + b * sin(from)};
  c.q = to - from > 2 * PI * (1 - 1e-12) ? c.p : (Vec2){x + a * cos(to), y + b * sin(to)};
  return c;
}

static ArrCurve circle(double x, double y, double r) { return ellipse(x, y, r, r, 0, 2 * PI); }

static uint32_t root(uint32_t *p, uint32_t i)
{
  while (p[i] != i) i = p[i] = p[p[i]];
  return i;
}

// V - E + F = 1 + C; all cycles' areas sum to nothing; positive areas less holes are positive.
static double check(const Arrangement *a, size_t faces)
{
  uint32_t *parent = mem_alloc((a->node.len + 1) * sizeof *parent), components = 0;
  bool *used = mem_zalloc(a->node.len + 1);
  for (uint32_t i = 0; i < a->node.len; i++) parent[i] = i;
  for (size_t e = 0; e < a->edge.len; e++) {
    used[a->edge.data[e].from] = used[a->edge.data[e].to] = true;
    parent[root(parent, a->edge.data[e].from)] = root(parent, a->edge.data[e].to);
  }
  size_t nodes = 0;
  for (uint32_t i = 0; i < a->node.len; i++) {
    nodes += used[i];
    components += used[i] && root(parent, i) == i;
  }
  assert_int_equal(a->nface, faces);
  assert_int_equal(nodes + a->nface, 1 + components + a->edge.len);
  double sum = 0, outer = 0;
  for (size_t k = 0; k < a->first.len; k++) {
    sum += a->area.data[k];
    if (!a->face.data[k]) outer -= a->area.data[k];
  }
  assert_true(fabs(sum) < 1e-12 * (1 + outer));
  free(parent);
  free(used);
  return outer; // the area of all bounded faces
}

static double area_of(const ArrCurve *c, size_t n, size_t faces)
{
  Arrangement a = {0};
  arrangement_build(&a, c, n, 1e-9);
  double area = check(&a, faces);
  arrangement_free(&a);
  return area;
}

static void squares(void **state)
{
  (void)state;
  ArrCurve one[] = {line(0, 0, 1, 0), line(1, 0, 1, 1), line(1, 1, 0, 1), line(0, 1, 0, 0)};
  assert_true(fabs(area_of(one, 4, 2) - 1) < 1e-14);
  ArrCurve cross[] = {line(0, 0, 2, 0), line(2, 0, 2, 2), line(2, 2, 0, 2), line(0, 2, 0, 0), line(-1, 1, 3, 1), line(1, -1, 1, 3)};
  assert_true(fabs(area_of(cross, 6, 5) - 4) < 1e-14);
  // overlapping sides, one within the other
  ArrCurve beside[] = {line(0, 0, 2, 0), line(2, 0, 2, 2), line(2, 2, 0, 2), line(0, 2, 0, 0),
                       line(2, .5, 3, .5), line(3, .5, 3, 1), line(3, 1, 2, 1), line(2, 1, 2, .5)};
  assert_true(fabs(area_of(beside, 8, 3) - 4.5) < 1e-14);
}

static void circles(void **state)
{
  (void)state;
  ArrCurve apart[] = {circle(0, 0, 1), circle(5, 0, 2)};
  assert_true(fabs(area_of(apart, 2, 3) - 5 * PI) < 1e-12);
  ArrCurve nested[] = {circle(0, 0, 3), circle(.1, 0, 2), circle(0, .2, 1)};
  assert_true(fabs(area_of(nested, 3, 4) - 9 * PI) < 1e-12);
  ArrCurve lens[] = {circle(0, 0, 1), circle(1, 0, 1)};
  assert_true(fabs(area_of(lens, 2, 4) - (2 * PI - (2 * PI / 3 - sqrt(3) / 2))) < 1e-12);
  ArrCurve touching[] = {circle(0, 0, 1), circle(3, 0, 2)};
  assert_true(fabs(area_of(touching, 2, 3) - 5 * PI) < 1e-12);
  ArrCurve inside[] = {circle(0, 0, 2), circle(1, 0, 1)}; // touching from within
  assert_true(fabs(area_of(inside, 2, 3) - 4 * PI) < 1e-12);
  ArrCurve tangent[] = {circle(0, 0, 1), line(-3, 1, 3, 1)};
  assert_true(fabs(area_of(tangent, 2, 2) - PI) < 1e-12);
  ArrCurve same[] = {circle(0, 0, 1), ellipse(0, 0, 1, 1, 1, 1 + 2 * PI)};
  assert_true(fabs(area_of(same, 2, 2) - PI) < 1e-12);
  ArrCurve four[] = {ellipse(0, 0, 2, 1, 0, 2 * PI), ellipse(0, 0, 1, 2, 0, 2 * PI)};
  assert_true(area_of(four, 2, 6) > 2 * PI);
}

static void dangling(void **state)
{
  (void)state;
  ArrCurve spur[] = {circle(0, 0, 1), line(0, 0, 3, 0), line(5, 5, 6, 6)};
  assert_true(fabs(area_of(spur, 3, 2) - PI) < 1e-12);
}

enum { SAMPLES = 64 };

// One cubic Bezier piece; its samples are put into `sample`.
static ArrCurve cubic(const Vec2 control[4], Vec2 sample[SAMPLES + 1])
{
  static const double knot[2] = {0, 1};
  for (int i = 0; i <= SAMPLES; i++) {
    double t = (double)i / SAMPLES, w[4] = {(1 - t) * (1 - t) * (1 - t), 3 * t * (1 - t) * (1 - t), 3 * t * t * (1 - t), t * t * t};
    sample[i] = (Vec2){0, 0};
    for (int k = 0; k < 4; k++) sample[i] = vec2_add(sample[i], vec2_scale(w[k], control[k]));
  }
  return (ArrCurve){.kind = ARR_SPLINE, .p = control[0], .q = control[3], .control = control, .point = sample, .knot = knot, .degree = 3,
                    .npiece = 1, .npoint = SAMPLES + 1};
}

static void splines(void **state)
{
  (void)state;
  static const Vec2 arch[4] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}}, wave[4] = {{-.5, .2}, {1, 2}, {0, -2}, {1.5, .6}};
  Vec2 one[SAMPLES + 1], two[SAMPLES + 1];
  ArrCurve c[] = {cubic(arch, one), line(0, 0, 1, 0), line(.5, -1, .5, 1), circle(.5, .4, .2), cubic(wave, two)};
  assert_true(fabs(area_of(c, 2, 2) - .6) < 1e-14);
  Arrangement a = {0};
  arrangement_build(&a, c, 3, 1e-9);
  check(&a, 3);
  for (size_t k = 0; k < a.first.len; k++)
    if (a.face.data[k]) assert_true(fabs(a.area.data[k] - .3) < 1e-14);
  arrangement_free(&a);
  memset(&a, 0, sizeof a);
  assert_true(fabs(area_of(c, 4, 5) - .6) < 1e-12);
  arrangement_build(&a, c, 5, 1e-9);
  check(&a, a.nface);
  assert_true(a.nface >= 9); // the wave crosses the line, the arch, the circle
  arrangement_free(&a);
  ArrCurve again[] = {cubic(arch, one), cubic(arch, two), line(1, 0, 0, 0)}; // the same one twice
  assert_true(fabs(area_of(again, 3, 2) - .6) < 1e-14);
}

// Random lines through a square: Euler holds, and the areas sum to the square's.
static void random_lines(void **state)
{
  (void)state;
  uint64_t seed = 7;
  for (int run = 0; run < 40; run++) {
    ArrCurve c[24] = {line(0, 0, 1, 0), line(1, 0, 1, 1), line(1, 1, 0, 1), line(0, 1, 0, 0)};
    for (int i = 4; i < 24; i++) {
      double v[4];
      for (int k = 0; k < 4; k++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        v[k] = (double)(seed >> 11) / 9007199254740992.0;
      }
      c[i] = i % 3 ? line(v[0], v[1], v[2], v[3]) : circle(.3 + .4 * v[0], .3 + .4 * v[1], .05 + .24 * v[2]);
    }
    Arrangement a = {0};
    arrangement_build(&a, c, 24, 1e-10);
    assert_true(fabs(check(&a, a.nface) - 1) < 1e-12);
    arrangement_free(&a);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(squares), cmocka_unit_test(circles), cmocka_unit_test(dangling),
    cmocka_unit_test(splines), cmocka_unit_test(random_lines),
  };
  return unit_run(tests);
}
