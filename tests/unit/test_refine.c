// test_refine.c - refinement: the boundary stays, every triangle is positive, the shapes and sizes are as promised
// SPDX-License-Identifier: MIT
#include "unit.h"

#include "base/mem.h"
#include "base/rng.h"
#include "tri/refine.h"

typedef struct {
  DoubleVec xy;
  U32Vec ends;
  size_t slits; // segments from this one on do not bound
} Domain;

static void add_loop(Domain *d, const Vec2 *p, size_t n, double h)
{
  size_t first = d->xy.len / 2;
  for (size_t i = 0; i < n; i++) {
    Vec2 a = p[i], b = p[(i + 1) % n];
    int k = (int)fmax(1, ceil(vec2_length(vec2_sub(b, a)) / h - 0.01));
    for (int j = 0; j < k; j++) {
      vec_push(&d->xy, a.x + (b.x - a.x) * j / k);
      vec_push(&d->xy, a.y + (b.y - a.y) * j / k);
    }
  }
  size_t end = d->xy.len / 2;
  for (size_t i = first; i < end; i++) {
    vec_push(&d->ends, (uint32_t)i);
    vec_push(&d->ends, (uint32_t)(i + 1 < end ? i + 1 : first));
  }
}

static void add_circle(Domain *d, double x, double y, double radius, double h)
{
  size_t first = d->xy.len / 2;
  int n = (int)ceil(2 * M_PI * radius / h);
  for (int i = 0; i < n; i++) {
    vec_push(&d->xy, x + radius * cos(2 * M_PI * i / n));
    vec_push(&d->xy, y + radius * sin(2 * M_PI * i / n));
    vec_push(&d->ends, (uint32_t)(first + (size_t)i));
    vec_push(&d->ends, (uint32_t)(first + (size_t)(i + 1) % (size_t)n));
  }
}

static void add_segment(Domain *d, Vec2 a, Vec2 b) // both ends new vertices
{
  vec_push(&d->ends, (uint32_t)(d->xy.len / 2)), vec_push(&d->ends, (uint32_t)(d->xy.len / 2 + 1));
  vec_push(&d->xy, a.x), vec_push(&d->xy, a.y), vec_push(&d->xy, b.x), vec_push(&d->xy, b.y);
}

enum { SQUARE, DISC, HOLES, ELL, GAP, SPIKE, SLIT, POINTS, TOUCHING, NCASES };

static void make_domain(Domain *d, int which, double h)
{
  *d = (Domain){.slits = SIZE_MAX};
  Vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  switch (which) {
  case DISC: add_circle(d, 0.5, 0.5, 0.5, h); break;
  case HOLES:
    add_loop(d, square, 4, h);
    add_circle(d, 0.3, 0.3, 0.1, h / 2);
    add_circle(d, 0.7, 0.6, 0.15, h);
    break;
  case ELL: add_loop(d, (Vec2[]){{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}}, 6, h); break;
  case GAP:
    add_loop(d, square, 4, h);
    add_loop(d, (Vec2[]){{0.2, 0.003}, {0.8, 0.003}, {0.8, 0.5}, {0.2, 0.5}}, 4, h);
    break;
  case SPIKE: add_loop(d, (Vec2[]){{0, 0}, {1, 0}, {1, 0.08}, {0.12, 0.75}}, 4, h); break;
  case SLIT:
    add_loop(d, square, 4, h);
    d->slits = d->ends.len / 2;
    for (int i = 0; i < 5; i++) add_segment(d, (Vec2){0.3, 0.2 + 0.1 * i}, (Vec2){0.3 + 0.8 * h, 0.2 + 0.1 * i});
    break;
  case TOUCHING:
    add_loop(d, square, 4, h);
    add_loop(d, (Vec2[]){{0.2, 0.2}, {0.5, 0.5}, {0.2, 0.5}}, 3, h);
    break;
  default: add_loop(d, square, 4, h);
  }
  if (which == POINTS) { // embedded points
    Rng rng = {7};
    for (int i = 0; i < 20; i++) vec_push(&d->xy, rng_double(&rng)), vec_push(&d->xy, rng_double(&rng));
  }
}

static void empty_mesh(const Domain *d, Tri *m)
{
  tri_init(m);
  TriBuild how = {.reorder = false};
  assert_int_equal(tri_build(m, d->xy.data, d->xy.len / 2, &how), TRI_BUILD_GOOD);
  assert_int_equal(tri_insert_segments(m, d->ends.data, NULL, d->ends.len / 2, NULL), 0);
  bool *embedded = mem_zalloc(d->ends.len);
  for (size_t i = d->slits; i < d->ends.len / 2; i++) embedded[i] = true;
  tri_carve(m, &(TriCarve){.even_odd = true, .embedded = embedded});
  free(embedded);
}

static double area_inside(const Tri *m)
{
  double sum = 0;
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    const double *a = tri_xy(m, m->vert[3 * t]), *b = tri_xy(m, m->vert[3 * t + 1]), *c = tri_xy(m, m->vert[3 * t + 2]);
    sum += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  return sum;
}

static MeshQuality measure(const Tri *m, SizeAt size, void *ctx)
{
  U32Vec tri = {0};
  for (TriId t = 0; t < m->nt; t++)
    if (tri_is_inside(m, t))
      for (int i = 0; i < 3; i++) vec_push(&tri, m->vert[3 * t + i]);
  MeshQuality q = quality_measure(m->xy, m->nv, tri.data, tri.len / 3, size, ctx);
  vec_free(&tri);
  return q;
}

// What must hold after any refinement.
static void check_mesh(Tri *m, const Domain *d, double area)
{
  TriCheck c;
  size_t bad = tri_check(m, TRI_CHECK_LINKS | TRI_CHECK_ORIENT | TRI_CHECK_EULER | TRI_CHECK_AREA, &c);
  if (bad) print_error("rule %u at half-edge %u, %zu in all\n", c.rule, c.e, bad);
  assert_int_equal(bad, 0);
  assert_true(fabs(area_inside(m) - area) <= 1e-12 * area);
  assert_memory_equal(m->xy, d->xy.data, d->xy.len * sizeof(double));
  for (size_t i = 0; i < d->ends.len; i += 2) {
    EdgeId e = tri_find_edge(m, d->ends.data[i], d->ends.data[i + 1]);
    assert_true(e != NONE && tri_is_segment(m, e) && m->seg[e] == i / 2);
  }
}

static void test_every_strategy_keeps_the_boundary(void **state)
{
  (void)state;
  const RefineAlgorithm algorithms[] = {REFINE_ADAPT,   REFINE_EMPTY,      REFINE_DELAUNAY,
                                        REFINE_FRONTAL, REFINE_FRONT_QUAD, REFINE_PACK};
  for (int k = 0; k < NCASES; k++) {
    for (size_t a = 0; a < ARRAY_LEN(algorithms); a++) {
      for (int level = 0; level <= 2; level++) {
        Domain d;
        make_domain(&d, k, 0.04);
        Tri m;
        empty_mesh(&d, &m);
        double area = area_inside(&m);
        TriRefineParams p = tri_refine_defaults();
        p.algorithm = algorithms[a], p.optimize = level, p.smoothing = level > 0;
        TriRefineStats s = tri_refine(&m, &p);
        assert_int_equal(s.outcome, REFINE_DONE);
        check_mesh(&m, &d, area);
        tri_free(&m);
        vec_free(&d.xy), vec_free(&d.ends);
      }
    }
  }
}

static void test_optimization_never_worsens_the_worst(void **state)
{
  (void)state;
  for (int k = 0; k < NCASES; k++) {
    for (int a = REFINE_DELAUNAY; a <= REFINE_FRONTAL; a++) {
      double least[3];
      for (int level = 0; level <= 2; level++) {
        Domain d;
        make_domain(&d, k, 0.03);
        Tri m;
        empty_mesh(&d, &m);
        TriRefineParams p = tri_refine_defaults();
        p.algorithm = (RefineAlgorithm)a, p.optimize = level, p.smoothing = level > 0;
        tri_refine(&m, &p);
        least[level] = measure(&m, NULL, NULL).gamma_min;
        tri_free(&m);
        vec_free(&d.xy), vec_free(&d.ends);
      }
      // A triangle may get worse while its star gets better, but no further than 0.9.
      assert_true(least[1] >= fmin(least[0], 0.9) - 1e-12 && least[2] >= fmin(least[0], 0.9) - 1e-12);
    }
  }
}

static double wave(void *ctx, Vec2 p) { return *(double *)ctx * (0.1 + 0.08 * sin(3 * p.x) * cos(6 * p.y)); }
static double constant(void *ctx, Vec2 p) { return (void)p, *(double *)ctx; }

// The share of tau in the cost is measured by the sizes at the vertices, which these meshes take from their boundary.
static double efficiency(const Tri *m, const double *size)
{
  double sum = 0, n = 0;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    if (!tri_is_inside(m, tri_of(e))) continue;
    VertId a = tri_org(m, e), b = tri_dest(m, e);
    double l = hypot(tri_xy(m, a)[0] - tri_xy(m, b)[0], tri_xy(m, a)[1] - tri_xy(m, b)[1]);
    double w = tri_is_segment(m, e) ? 1 : 0.5;
    sum += w * quality_tau_term(l * (size[a] + size[b]) / (2 * size[a] * size[b])), n += w;
  }
  return exp(sum / n);
}

// Polishing (faces of some thousand triangles) and rework (larger ones) gain in the mean, in lengths or in the smallest angle, and
// the worst triangle is never worse than behind the front.
static void test_small_faces_are_polished(void **state)
{
  (void)state;
  const double h[] = {0.2, 0.1, 0.05, 0.012}; // the last one is too large to be polished
  const int which[] = {SQUARE, DISC, HOLES, ELL, SPIKE};
  for (size_t i = 0; i < ARRAY_LEN(h) * ARRAY_LEN(which); i++) {
    MeshQuality q[2];
    double tau[2];
    for (int level = 0; level < 2; level++) {
      Domain d;
      make_domain(&d, which[i / ARRAY_LEN(h)], h[i % ARRAY_LEN(h)]);
      Tri m;
      empty_mesh(&d, &m);
      double area = area_inside(&m), *size = NULL;
      TriRefineParams p = tri_refine_defaults();
      p.optimize = p.smoothing = level, p.sizes_out = &size;
      tri_refine(&m, &p);
      check_mesh(&m, &d, area);
      q[level] = measure(&m, NULL, NULL), tau[level] = efficiency(&m, size);
      free(size);
      tri_free(&m);
      vec_free(&d.xy), vec_free(&d.ends);
    }
    assert_true(q[1].gamma_min >= q[0].gamma_min - 1e-12);
    assert_true(q[1].angle_min >= q[0].angle_min - 0.1);
    assert_true(tau[1] + q[1].gamma_mean >= tau[0] + q[0].gamma_mean - 1e-3);
  }
}

// A strip from (0, 0) to (1, w), its points ever farther from each other.
static void add_graded_strip(Domain *d, double w, double first, double growth)
{
  DoubleVec x = {0};
  for (double at = 0, step = first; at < 1 - step / 2; at += step, step *= growth) vec_push(&x, at);
  vec_push(&x, 1);
  for (size_t i = 0; i < x.len; i++) vec_push(&d->xy, x.data[i]), vec_push(&d->xy, 0);
  for (size_t i = x.len; i-- > 0;) vec_push(&d->xy, x.data[i]), vec_push(&d->xy, w);
  uint32_t n = 2 * (uint32_t)x.len;
  for (uint32_t i = 0; i < n; i++) vec_push(&d->ends, i), vec_push(&d->ends, (i + 1) % n);
  vec_free(&x);
}

// The mean length of the two segments at each vertex of a single loop.
static double *lengths_at_vertices(const Domain *d)
{
  size_t n = d->xy.len / 2;
  double *h = mem_zalloc(n * sizeof *h);
  for (size_t i = 0; i < n; i++) {
    const double *a = d->xy.data + 2 * i, *b = d->xy.data + 2 * ((i + 1) % n);
    double l = hypot(b[0] - a[0], b[1] - a[1]) / 2;
    h[i] += l, h[(i + 1) % n] += l;
  }
  return h;
}

// Polishing moves vertices by trial: each must end with the size of the place it has, linear on the empty mesh.
static void test_vertices_have_the_sizes_of_their_places(void **state)
{
  (void)state;
  size_t inner = 0;
  for (int k = 0; k < 40; k++) {
    Domain d = {.slits = SIZE_MAX};
    add_graded_strip(&d, 0.25 + 0.005 * k, 0.1, 1.05 + 0.01 * k);
    Tri m, empty;
    empty_mesh(&d, &m), empty_mesh(&d, &empty);
    double *h = lengths_at_vertices(&d), *size = NULL;
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = k % 2 ? REFINE_ADAPT : REFINE_FRONTAL;
    p.sizes_out = &size;
    tri_refine(&m, &p);
    for (VertId v = (VertId)(d.xy.len / 2); v < m.nv; v++) {
      EdgeId e;
      assert_int_not_equal(tri_locate(&empty, tri_xy(&m, v), NONE, &e), TRI_OUTSIDE);
      const uint32_t *c = empty.vert + 3 * (size_t)tri_of(e);
      const double *a = tri_xy(&empty, c[0]), *b = tri_xy(&empty, c[1]), *g = tri_xy(&empty, c[2]), *q = tri_xy(&m, v);
      double whole = (b[0] - a[0]) * (g[1] - a[1]) - (b[1] - a[1]) * (g[0] - a[0]);
      double s = ((q[0] - a[0]) * (g[1] - a[1]) - (q[1] - a[1]) * (g[0] - a[0])) / whole;
      double t = ((b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0])) / whole;
      double wanted = h[c[0]] * (1 - s - t) + h[c[1]] * s + h[c[2]] * t;
      assert_true(fabs(size[v] - wanted) < 1e-9 * wanted);
      inner++;
    }
    free(size), free(h);
    tri_free(&m), tri_free(&empty);
    vec_free(&d.xy), vec_free(&d.ends);
  }
  assert_true(inner > 100);
}

// Where slivers cannot be helped, as between steps of a strip, points brought in for them would cost more than they mend.
static void test_strips_of_one_row_stay_as_they_are(void **state)
{
  (void)state;
  Domain d = {.slits = SIZE_MAX};
  enum { STEPS = 6 };
  for (int i = 0; i <= STEPS; i++) {
    vec_push(&d.xy, 3 * i), vec_push(&d.xy, 0);
    if (i < STEPS) vec_push(&d.xy, 3 * i + 0.03), vec_push(&d.xy, 0), vec_push(&d.xy, 3 * i + 1.5), vec_push(&d.xy, 0);
  }
  for (int i = STEPS; i >= 0; i--) vec_push(&d.xy, 3 * i), vec_push(&d.xy, 0.8);
  uint32_t n = (uint32_t)(d.xy.len / 2);
  for (uint32_t i = 0; i < n; i++) vec_push(&d.ends, i), vec_push(&d.ends, (i + 1) % n);
  Tri m;
  empty_mesh(&d, &m);
  MeshQuality before = measure(&m, constant, &(double){1.5});
  TriRefineParams p = tri_refine_defaults();
  tri_refine(&m, &p);
  MeshQuality after = measure(&m, constant, &(double){1.5});
  assert_int_equal(m.nv, n);
  assert_true(after.gamma_mean >= before.gamma_mean - 1e-12);
  tri_free(&m);
  vec_free(&d.xy), vec_free(&d.ends);
}

static void test_quality_of_the_square(void **state)
{
  (void)state;
  double h = 0.0125;
  const struct {
    RefineAlgorithm algorithm;
    double least, mean, tau, six;
  } want[] = {{REFINE_FRONTAL, 0.85, 0.997, 0.985, 0.96}, {REFINE_DELAUNAY, 0.60, 0.96, 0.89, 0.55}, {REFINE_ADAPT, 0.55, 0.955, 0.89, 0.5}};
  for (size_t k = 0; k < ARRAY_LEN(want); k++) {
    Domain d;
    make_domain(&d, SQUARE, h);
    Tri m;
    empty_mesh(&d, &m);
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = want[k].algorithm;
    tri_refine(&m, &p);
    check_mesh(&m, &d, 1);
    MeshQuality q = measure(&m, constant, &h);
    if (q.gamma_min < want[k].least || q.gamma_mean < want[k].mean || q.tau < want[k].tau || q.valence6 < want[k].six)
      fail_msg("algorithm %d: gamma %g %g tau %g six %g", (int)p.algorithm, q.gamma_min, q.gamma_mean, q.tau, q.valence6);
    double ideal = 4 / (sqrt(3) * h * h);
    assert_true((double)q.ntri > 0.85 * ideal && (double)q.ntri < 1.15 * ideal);
    tri_free(&m);
    vec_free(&d.xy), vec_free(&d.ends);
  }
}

static void test_sizes_of_a_field_are_met(void **state)
{
  (void)state;
  double scale = 0.25;
  for (int k = 0; k < 2; k++) {
    Domain d;
    make_domain(&d, SQUARE, 0.02);
    Tri m;
    empty_mesh(&d, &m);
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = k ? REFINE_FRONTAL : REFINE_DELAUNAY;
    p.size = wave, p.size_ctx = &scale, p.extend_from_boundary = false;
    tri_refine(&m, &p);
    check_mesh(&m, &d, 1);
    MeshQuality q = measure(&m, wave, &scale);
    assert_true(q.tau > 0.88 && q.gamma_mean > 0.94);
    tri_free(&m);
    vec_free(&d.xy), vec_free(&d.ends);
  }
}

static double dot_size(void *ctx, Vec2 p)
{
  (void)ctx;
  return hypot(p.x - 0.53, p.y - 0.45) < 0.03 ? 0.002 : 0.1;
}

static void test_a_small_dip_of_the_field_is_not_missed(void **state)
{
  (void)state;
  const RefineAlgorithm algorithms[] = {REFINE_DELAUNAY, REFINE_FRONTAL, REFINE_FRONT_QUAD, REFINE_PACK};
  for (int k = 0; k < 4; k++) {
    Domain d;
    make_domain(&d, SQUARE, 0.1);
    Tri m;
    empty_mesh(&d, &m);
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = algorithms[k];
    p.size = dot_size, p.extend_from_boundary = false;
    tri_refine(&m, &p);
    check_mesh(&m, &d, 1);
    size_t near = 0;
    for (VertId v = 0; v < m.nv; v++) near += hypot(m.xy[2 * v] - 0.53, m.xy[2 * v + 1] - 0.45) < 0.03;
    assert_true(near > 500); // about 820 of spacing 0.002 fit, 707 on a square lattice
    tri_free(&m);
    vec_free(&d.xy), vec_free(&d.ends);
  }
}

// In a square whose sides are cut in n, lattices along the axes from all sides are one: n * n cells of two triangles.
static void test_lattices_of_a_square_are_one(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    Domain d;
    make_domain(&d, SQUARE, 1. / 37);
    Tri m;
    empty_mesh(&d, &m);
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = k ? REFINE_PACK : REFINE_FRONT_QUAD;
    tri_refine(&m, &p);
    check_mesh(&m, &d, 1);
    assert_int_equal(m.nv, 38 * 38);
    for (size_t i = 0; i < 2 * (size_t)m.nv; i++) assert_true(fabs(37 * m.xy[i] - round(37 * m.xy[i])) < 1e-9);
    tri_free(&m);
    vec_free(&d.xy), vec_free(&d.ends);
  }
}

static double radial_cross(void *ctx, Vec2 p, uint32_t *near)
{
  *near += *near != NONE; // hints of the caller are handed on, whatever they are
  return (void)ctx, atan2(p.y - 0.5, p.x - 0.5);
}

// Between two circles, with crosses along the radii and sizes that grow with the radius, the mesh is a polar grid.
static void test_lattices_follow_the_crosses(void **state)
{
  (void)state;
  Domain d = {.slits = SIZE_MAX};
  int n = 60;
  add_circle(&d, 0.5, 0.5, 0.5, 2 * M_PI * 0.5 / n * 1.0001);
  add_circle(&d, 0.5, 0.5, 0.2, 2 * M_PI * 0.2 / n * 1.0001);
  for (int k = 0; k < 2; k++) {
    Tri m;
    empty_mesh(&d, &m);
    double area = area_inside(&m);
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = k ? REFINE_PACK : REFINE_FRONT_QUAD;
    p.cross = radial_cross;
    tri_refine(&m, &p);
    check_mesh(&m, &d, area);
    size_t on_rays = 0;
    for (VertId v = 0; v < m.nv; v++) {
      double a = atan2(m.xy[2 * v + 1] - 0.5, m.xy[2 * v] - 0.5) * n / (2 * M_PI);
      on_rays += fabs(a - round(a)) < 0.1;
    }
    if (on_rays < 0.9 * m.nv) fail_msg("%zu of %u vertices are on rays", on_rays, m.nv);
    tri_free(&m);
  }
  vec_free(&d.xy), vec_free(&d.ends);
}

static void test_equal_runs_give_equal_arrays(void **state)
{
  (void)state;
  Tri m[2];
  Domain d;
  make_domain(&d, HOLES, 0.02);
  for (int k = 0; k < 2; k++) {
    empty_mesh(&d, &m[k]);
    TriRefineParams p = tri_refine_defaults();
    tri_refine(&m[k], &p);
  }
  assert_int_equal(m[0].nv, m[1].nv);
  assert_int_equal(m[0].nt, m[1].nt);
  assert_memory_equal(m[0].xy, m[1].xy, 2 * m[0].nv * sizeof(double));
  assert_memory_equal(m[0].vert, m[1].vert, 3 * m[0].nt * sizeof(uint32_t));
  tri_free(&m[0]), tri_free(&m[1]);
  vec_free(&d.xy), vec_free(&d.ends);
}

static bool stop_at_once(void *ctx, double done) { return (void)ctx, (void)done, true; }

static void test_limits_and_cancellation(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    Domain d;
    make_domain(&d, SQUARE, 0.005);
    Tri m;
    empty_mesh(&d, &m);
    TriRefineParams p = tri_refine_defaults();
    if (k) p.cancel = stop_at_once;
    else p.max_triangles = 5000;
    TriRefineStats s = tri_refine(&m, &p);
    assert_int_equal(s.outcome, k ? REFINE_CANCELLED : REFINE_LIMIT);
    assert_true(m.nt < 50000);
    check_mesh(&m, &d, 1);
    tri_free(&m);
    vec_free(&d.xy), vec_free(&d.ends);
  }
}

// ---- guaranteed angles ----

// A star-shaped polygon with spikes and notches; every third one has a copy of itself, shrunk a little, as a hole.
static void random_polygon(Domain *d, Rng *rng, bool gap)
{
  Vec2 p[24];
  size_t n = 5 + rng_below(rng, 19);
  for (size_t i = 0; i < n; i++) {
    double a = 2 * M_PI * ((double)i + 0.8 * rng_double(rng)) / (double)n, r = 0.03 + rng_double(rng);
    p[i] = (Vec2){r * cos(a), r * sin(a)};
  }
  *d = (Domain){.slits = SIZE_MAX};
  add_loop(d, p, n, 1e9);
  if (!gap) return;
  for (size_t i = 0; i < n; i++) p[i] = vec2_scale(0.97, p[i]);
  add_loop(d, p, n, 1e9);
}

static double angle_between(Vec2 a, Vec2 o, Vec2 b)
{
  Vec2 u = vec2_sub(a, o), v = vec2_sub(b, o);
  return atan2(fabs(vec2_cross(u, v)), vec2_dot(u, v)) * 180 / M_PI;
}

static double distance_to(Vec2 p, Vec2 a, Vec2 b)
{
  Vec2 d = vec2_sub(b, a);
  return fabs(vec2_cross(d, vec2_sub(p, a))) / vec2_length(d);
}

// Is the triangle between the two sides of an input angle under 60 degrees: two of its vertices on them, or one at the tip?
static bool at_sharp_angle(const Domain *d, const Vec2 *t)
{
  Vec2 *p = (Vec2 *)(void *)d->xy.data;
  for (size_t i = 0; i < d->ends.len; i += 2) { // segments follow each other around each loop
    size_t j = 0;
    while (d->ends.data[j + 1] != d->ends.data[i]) j += 2;
    Vec2 o = p[d->ends.data[i]], a = p[d->ends.data[j]], b = p[d->ends.data[i + 1]];
    if (angle_between(a, o, b) >= 60.001) continue;
    int on_a = 0, on_b = 0;
    for (int k = 0; k < 3; k++) on_a += distance_to(t[k], o, a) < 1e-9, on_b += distance_to(t[k], o, b) < 1e-9;
    if (on_a && on_b) return true;
  }
  return false;
}

// Sizes at all vertices, those carried into the domain between the least and the largest at the `given` ones.
static void check_carried(const double *size, VertId given, VertId all)
{
  double least = INFINITY, most = 0;
  for (VertId v = 0; v < given; v++) least = fmin(least, size[v]), most = fmax(most, size[v]);
  for (VertId v = given; v < all; v++)
    if (!(size[v] >= (1 - 1e-9) * least && size[v] <= (1 + 1e-9) * most)) fail_msg("size %g outside [%g, %g]", size[v], least, most);
}

static void test_angles_are_guaranteed(void **state)
{
  (void)state;
  Rng rng = {11};
  for (int k = 0; k < 500; k++) {
    Domain d;
    random_polygon(&d, &rng, k % 3 == 2);
    Tri m;
    empty_mesh(&d, &m);
    double area = area_inside(&m);
    TriRefineParams p = tri_refine_defaults();
    double *size = NULL;
    p.algorithm = REFINE_EMPTY, p.min_angle = k % 2 ? 30 : 25, p.sizes_out = &size;
    VertId given = m.nv;
    TriRefineStats s = tri_refine(&m, &p);
    check_carried(size, given, m.nv);
    free(size);
    assert_int_equal(s.outcome, REFINE_DONE);
    assert_int_equal(tri_check(&m, TRI_CHECK_ALL, NULL), 0);
    assert_true(fabs(area_inside(&m) - area) <= 1e-9 * area);
    for (TriId t = 0; t < m.nt; t++) {
      if (!tri_is_inside(&m, t)) continue;
      Vec2 v[3];
      for (int i = 0; i < 3; i++) v[i] = (Vec2){m.xy[2 * m.vert[3 * t + (uint32_t)i]], m.xy[2 * m.vert[3 * t + (uint32_t)i] + 1]};
      double a[3];
      quality_angles(shape_plane(v[0], v[1], v[2]), a);
      if (fmin(a[0], fmin(a[1], a[2])) < p.min_angle - 1e-9 && !at_sharp_angle(&d, v))
        fail_msg("polygon %d: angle %g at (%g, %g)", k, fmin(a[0], fmin(a[1], a[2])), v[0].x, v[0].y);
    }
    tri_free(&m);
    vec_free(&d.xy), vec_free(&d.ends);
  }
}

static double slope(void *ctx, Vec2 p) { return (void)ctx, 0.1 + 0.05 * p.x; }

// Vertices that are made for the angle have sizes like all others.
static void test_sizes_of_vertices_for_angles(void **state)
{
  (void)state;
  Rng rng = {23};
  for (int k = 0; k < 20; k++) {
    Domain d;
    random_polygon(&d, &rng, k % 2);
    Tri m;
    empty_mesh(&d, &m);
    double *size = NULL;
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = REFINE_EMPTY, p.min_angle = 30, p.size = slope, p.sizes_out = &size, p.extend_from_boundary = false, p.conforming = k % 4 == 0;
    TriRefineStats s = tri_refine(&m, &p);
    assert_true(s.inserted + s.split > 0);
    for (VertId v = 0; v < m.nv; v++)
      if (!(fabs(size[v] - slope(NULL, (Vec2){m.xy[2 * v], m.xy[2 * v + 1]})) < 1e-12))
        fail_msg("polygon %d, vertex %u of %u: size %g, not %g", k, v, m.nv, size[v], slope(NULL, (Vec2){m.xy[2 * v], m.xy[2 * v + 1]}));
    free(size);
    tri_free(&m);
    vec_free(&d.xy), vec_free(&d.ends);
  }
}

static bool split_outward(void *ctx, VertId u, VertId v, double at, Vec2 *point)
{
  (void)u, (void)v, (void)at;
  double r = hypot(point->x - 0.5, point->y - 0.5);
  *point = (Vec2){0.5 + (point->x - 0.5) * 0.5 / r, 0.5 + (point->y - 0.5) * 0.5 / r};
  ++*(int *)ctx;
  return true;
}

static void test_splits_follow_the_curve(void **state)
{
  (void)state;
  Domain d;
  make_domain(&d, DISC, 0.3);
  add_loop(&d, (Vec2[]){{0.5, 0.02}, {0.52, 0.5}, {0.5, 0.5}}, 3, 9);
  Tri m;
  empty_mesh(&d, &m);
  int calls = 0;
  TriRefineParams p = tri_refine_defaults();
  p.min_angle = 28, p.split = split_outward, p.split_ctx = &calls;
  TriRefineStats s = tri_refine(&m, &p);
  assert_true(s.split > 0 && calls >= (int)s.split);
  assert_int_equal(tri_check(&m, TRI_CHECK_LINKS | TRI_CHECK_ORIENT | TRI_CHECK_EULER, NULL), 0);
  tri_free(&m);
  vec_free(&d.xy), vec_free(&d.ends);
}

enum { HINT = 1000 };

static double hinted_cross(void *ctx, Vec2 p, uint32_t *near)
{
  const VertId given = *(VertId *)ctx;
  assert_true(*near == NONE || (*near >= HINT && *near < HINT + given));
  return p.x;
}

// There are hints for the vertices given, and none for those that conformity adds before the crosses are asked for.
static void test_conforming_vertices_have_no_hints(void **state)
{
  (void)state;
  Rng rng = {6};
  for (int k = 0; k < 20; k++) {
    Domain d;
    random_polygon(&d, &rng, false);
    Tri m;
    empty_mesh(&d, &m);
    VertId given = m.nv;
    uint32_t *hint = mem_alloc(given * sizeof *hint);
    for (VertId v = 0; v < given; v++) hint[v] = HINT + v;
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = k % 2 ? REFINE_PACK : REFINE_FRONT_QUAD, p.conforming = true;
    p.cross = hinted_cross, p.cross_ctx = &given, p.cross_near = hint;
    tri_refine(&m, &p);
    assert_int_equal(tri_check(&m, TRI_CHECK_LINKS | TRI_CHECK_ORIENT | TRI_CHECK_EULER, NULL), 0);
    free(hint);
    tri_free(&m);
    vec_free(&d.xy), vec_free(&d.ends);
  }
}

static void test_conforming_segments_have_empty_circles(void **state)
{
  (void)state;
  Rng rng = {5};
  for (int k = 0; k < 50; k++) {
    Domain d;
    random_polygon(&d, &rng, false);
    Tri m;
    empty_mesh(&d, &m);
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = REFINE_EMPTY, p.conforming = true, p.optimize = 0;
    tri_refine(&m, &p);
    size_t left = 0;
    for (EdgeId e = 0; e < 3 * m.nt; e++)
      if (tri_is_segment(&m, e) && tri_is_inside(&m, tri_of(e)))
        left += in_diametral_circle(tri_xy(&m, tri_org(&m, e)), tri_xy(&m, tri_dest(&m, e)), tri_xy(&m, tri_apex(&m, e))) > 0;
    assert_int_equal(left, 0);
    assert_int_equal(tri_check(&m, TRI_CHECK_ALL, NULL), 0);
    tri_free(&m);
    vec_free(&d.xy), vec_free(&d.ends);
  }
}

// Faces of more than 200,000 triangles are refined by region and in rows: still everywhere, and as well as small ones.
static void test_large_faces_are_refined_everywhere(void **state)
{
  (void)state;
  for (int a = REFINE_DELAUNAY; a <= REFINE_FRONTAL; a++) {
    Domain d;
    make_domain(&d, HOLES, 0.003);
    Tri m;
    empty_mesh(&d, &m);
    double area = area_inside(&m), *size = NULL, largest = 0;
    TriRefineParams p = tri_refine_defaults();
    p.algorithm = (RefineAlgorithm)a, p.optimize = p.smoothing = 0, p.sizes_out = &size;
    TriRefineStats s = tri_refine(&m, &p);
    assert_true(s.inserted > 100000);
    check_mesh(&m, &d, area);
    assert_int_equal(tri_check(&m, TRI_CHECK_DELAUNAY, NULL), 0);
    for (EdgeId e = 0; e < 3 * m.nt; e++) {
      if (!tri_is_inside(&m, tri_of(e))) continue;
      VertId u = tri_org(&m, e), v = tri_dest(&m, e);
      double l = hypot(tri_xy(&m, u)[0] - tri_xy(&m, v)[0], tri_xy(&m, u)[1] - tri_xy(&m, v)[1]);
      largest = fmax(largest, l * (size[u] + size[v]) / (2 * size[u] * size[v]));
    }
    assert_true(largest < 1.6);
    assert_true(measure(&m, NULL, NULL).gamma_mean > (a == REFINE_DELAUNAY ? 0.9 : 0.98));
    free(size);
    tri_free(&m);
    vec_free(&d.xy), vec_free(&d.ends);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_every_strategy_keeps_the_boundary),
      cmocka_unit_test(test_optimization_never_worsens_the_worst),
      cmocka_unit_test(test_small_faces_are_polished),
      cmocka_unit_test(test_vertices_have_the_sizes_of_their_places),
      cmocka_unit_test(test_strips_of_one_row_stay_as_they_are),
      cmocka_unit_test(test_quality_of_the_square),
      cmocka_unit_test(test_sizes_of_a_field_are_met),
      cmocka_unit_test(test_a_small_dip_of_the_field_is_not_missed),
      cmocka_unit_test(test_lattices_of_a_square_are_one),
      cmocka_unit_test(test_lattices_follow_the_crosses),
      cmocka_unit_test(test_equal_runs_give_equal_arrays),
      cmocka_unit_test(test_limits_and_cancellation),
      cmocka_unit_test(test_sizes_of_vertices_for_angles),
      cmocka_unit_test(test_angles_are_guaranteed),
      cmocka_unit_test(test_splits_follow_the_curve),
      cmocka_unit_test(test_conforming_vertices_have_no_hints),
      cmocka_unit_test(test_conforming_segments_have_empty_circles),
      cmocka_unit_test(test_large_faces_are_refined_everywhere),
  };
  return unit_run(tests);
}
