// test_tri.c - the triangulation kernel: every operation leaves a valid, canonical triangulation
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>

#include "base/rng.h"
#include "tri/tri.h"

typedef struct {
  const char *name;
  double *xy;
  size_t n;
} Points;

enum { SETS = 9 };

static Points points_make(int set, size_t n, uint64_t seed)
{
  static const char *const names[SETS] = {"uniform", "clusters", "grid 1/999", "integer grid", "circle", "line and one",
                                          "spiral", "tiny grid with repeats", "wide exponents"};
  Rng r = {seed};
  Points p = {names[set], mem_alloc((2 * n + 2) * sizeof(double)), n};
  size_t side = (size_t)ceil(sqrt((double)n));
  for (size_t i = 0; i < n; i++) {
    double *q = p.xy + 2 * i, u = rng_double(&r), v = rng_double(&r), a = 6.283185307179586 * u;
    switch (set) {
    case 0: q[0] = u, q[1] = v; break;
    case 1: q[0] = (double)(i % 7) + 1e-3 * sqrt(-2 * log(u + 1e-300)) * cos(6.283 * v), q[1] = (double)(i % 5) + 1e-3 * u * v; break;
    case 2: q[0] = (double)(i % side) / 999, q[1] = (double)(i / side) / 999; break;
    case 3: q[0] = (double)(i % side), q[1] = (double)(i / side); break;
    case 4: q[0] = cos(a), q[1] = sin(a); break;
    case 5: q[0] = i == 0 ? 0.5 : u, q[1] = i == 0 ? 1 : 0; break;
    case 6: a = 0.1 * (double)i, q[0] = a * cos(a), q[1] = a * sin(a); break;
    case 7: q[0] = (double)rng_below(&r, 6), q[1] = (double)rng_below(&r, 6); break;
    case 8: q[0] = ldexp(u - 0.5, (int)rng_below(&r, 1900) - 950), q[1] = ldexp(v - 0.5, (int)rng_below(&r, 1900) - 950); break;
    }
  }
  return p;
}

static void shuffle(double *xy, size_t n, Rng *r)
{
  for (size_t i = n; i > 1; i--) {
    size_t j = rng_below(r, (uint32_t)i);
    for (size_t k = 0; k < 2; k++) {
      double t = xy[2 * i - 2 + k];
      xy[2 * i - 2 + k] = xy[2 * j + k];
      xy[2 * j + k] = t;
    }
  }
}

static void assert_valid(const Tri *m, unsigned rules)
{
  TriCheck c;
  if (tri_check(m, rules, &c)) fail_msg("rule %u broken at half-edge %u (%zu times)", c.rule, c.e, c.count);
}

static void build(Tri *m, Points *p, bool reorder)
{
  TriBuild how = {.reorder = reorder};
  assert_int_equal(tri_build(m, p->xy, p->n, &how), TRI_BUILD_GOOD);
}

static unsigned rules_for(int set) { return set == 8 ? TRI_CHECK_ALL & ~TRI_CHECK_AREA : TRI_CHECK_ALL; }

static void every_set_is_delaunay(void **state)
{
  (void)state;
  for (int set = 0; set < SETS; set++)
    for (size_t n = 0; n < 40; n++) {
      Points p = points_make(set, n, n);
      for (int reorder = 0; reorder < 2; reorder++) {
        Tri m;
        build(&m, &p, reorder);
        assert_valid(&m, rules_for(set));
        tri_free(&m);
      }
      free(p.xy);
    }
  for (int set = 0; set < SETS; set++) {
    Points p = points_make(set, 2000, 5);
    Tri m;
    build(&m, &p, true);
    assert_valid(&m, rules_for(set));
    assert_int_equal(m.nt, 2 * m.nv - 2);
    tri_free(&m);
    free(p.xy);
  }
}

static void shuffles_change_nothing(void **state)
{
  (void)state;
  for (int set = 0; set < SETS; set++) {
    Points p = points_make(set, set == 8 ? 200 : 1000, 11);
    Tri a;
    Rng r = {7};
    build(&a, &p, true);
    for (int i = 0; i < 100; i++) {
      Tri b;
      shuffle(p.xy, p.n, &r);
      build(&b, &p, true);
      assert_int_equal(a.nv, b.nv);
      assert_int_equal(a.nt, b.nt);
      assert_memory_equal(a.xy, b.xy, 2 * a.nv * sizeof *a.xy);
      assert_memory_equal(a.vert, b.vert, 3 * a.nt * sizeof *a.vert);
      assert_memory_equal(a.twin, b.twin, 3 * a.nt * sizeof *a.twin);
      tri_free(&b);
    }
    tri_free(&a);
    free(p.xy);
  }
}

// The same triangles (as sets of vertices), whatever their numbers.
static void assert_same_triangles(Tri *a, Tri *b)
{
  tri_make_hints(a);
  for (EdgeId e = 0; e < 3 * b->nt; e++) {
    if (tri_is_free(b, tri_of(e)) || tri_is_ghost(b, tri_of(e))) continue;
    EdgeId f = tri_find_edge(a, b->vert[e], tri_dest(b, e));
    assert_true(f != NONE);
    assert_int_equal(tri_apex(a, f), tri_apex(b, e));
  }
}

static void one_by_one_is_the_same(void **state)
{
  (void)state;
  for (int set = 0; set < SETS; set++) {
    Points p = points_make(set, 150, 3);
    Tri a, b;
    TriCavity c = {0};
    build(&a, &p, false);
    tri_init(&b);
    for (size_t i = 0; i < p.n; i++) {
      VertId v = NONE;
      TriInsert r = tri_insert(&b, &c, p.xy + 2 * i, NONE, &v);
      assert_true(r == TRI_INSERTED || r == TRI_DUPLICATE);
      if (r == TRI_DUPLICATE) { // keep the numbers in step
        double q[2] = {p.xy[2 * i], p.xy[2 * i + 1]};
        assert_true(b.xy[2 * v] == q[0] && b.xy[2 * v + 1] == q[1]);
        p.xy[2 * i] = p.xy[2 * p.n - 2];
        p.xy[2 * i + 1] = p.xy[2 * p.n - 1];
        p.n--;
        i--;
      }
      assert_valid(&b, rules_for(set));
    }
    tri_free(&a);
    build(&a, &p, false);
    assert_same_triangles(&a, &b);
    tri_cavity_free(&c);
    tri_free(&a);
    tri_free(&b);
    free(p.xy);
  }
}

// Insertion alone and merged parts give the same triangles; any number of threads the same arrays.
static void builders_agree(void **state)
{
  (void)state;
  for (int set = 0; set < SETS; set++) {
    Points p = points_make(set, set == 8 ? 500 : 20000, 53);
    Tri a, b, c;
    build(&a, &p, true);
    TriBuild threads = {.reorder = true, .threads = 3}, alone = {.reorder = true, .incremental = true};
    tri_build(&b, p.xy, p.n, &threads);
    tri_build(&c, p.xy, p.n, &alone);
    assert_int_equal(a.nt, b.nt);
    assert_memory_equal(a.vert, b.vert, 3 * (size_t)a.nt * sizeof *a.vert);
    assert_memory_equal(a.twin, b.twin, 3 * (size_t)a.nt * sizeof *a.twin);
    assert_valid(&a, rules_for(set));
    assert_int_equal(a.nt, c.nt);
    if (set != 5) assert_same_triangles(&c, &a); // there one vertex has them all
    tri_free(&a);
    tri_free(&b);
    tri_free(&c);
    free(p.xy);
  }
}

static void location_is_exact(void **state)
{
  (void)state;
  for (int set = 0; set < SETS; set++) {
    Points p = points_make(set, 300, 17);
    Tri m;
    build(&m, &p, true);
    Rng r = {1};
    for (int i = 0; i < 2000; i++) {
      double q[2];
      if (i % 3 == 0) memcpy(q, m.xy + 2 * rng_below(&r, m.nv), sizeof q);
      else {
        const double *a = m.xy + 2 * rng_below(&r, m.nv), *b = m.xy + 2 * rng_below(&r, m.nv);
        double t = i % 3 == 1 ? 0.5 : 4 * rng_double(&r) - 2;
        q[0] = a[0] + t * (b[0] - a[0]), q[1] = a[1] + t * (b[1] - a[1]);
      }
      EdgeId e;
      TriLoc loc = tri_locate(&m, q, rng_below(&r, 3 * m.nt), &e);
      const double *a = tri_org(&m, e) == TRI_INF ? NULL : tri_xy(&m, tri_org(&m, e));
      const double *b = tri_dest(&m, e) == TRI_INF ? NULL : tri_xy(&m, tri_dest(&m, e));
      const double *c = tri_apex(&m, e) == TRI_INF ? NULL : tri_xy(&m, tri_apex(&m, e));
      switch (loc) {
      case TRI_ON_VERTEX: assert_true(a[0] == q[0] && a[1] == q[1]); break;
      case TRI_ON_EDGE:
        assert_int_equal(orient2d(a, b, q), 0);
        assert_int_equal(in_diametral_circle(a, b, q), 1);
        break;
      case TRI_IN_FACE: assert_true(orient2d(a, b, q) > 0 && orient2d(b, c, q) > 0 && orient2d(c, a, q) > 0); break;
      case TRI_OUTSIDE: assert_true(tri_apex(&m, e) == TRI_INF && orient2d(a, b, q) > 0); break;
      }
    }
    tri_free(&m);
    free(p.xy);
  }
}

static void removal_undoes_insertion(void **state)
{
  (void)state;
  for (int set = 0; set < SETS; set++) {
    Points p = points_make(set, 120, 23);
    Tri m;
    build(&m, &p, false);
    tri_make_hints(&m);
    Rng r = {5};
    for (int i = 0; i < 100; i++) {
      VertId v = rng_below(&r, m.nv);
      if (m.hint[v] == NONE) continue;
      if (!tri_remove(&m, v)) continue;
      assert_valid(&m, rules_for(set));
    }
    // What is left is the triangulation of what is left.
    Points q = {"", mem_alloc(2 * m.nv * sizeof(double)), 0};
    uint32_t *to = mem_alloc(m.nv * sizeof *to);
    for (VertId v = 0; v < m.nv; v++)
      if (m.hint[v] != NONE) {
        memcpy(q.xy + 2 * q.n, m.xy + 2 * v, 2 * sizeof(double));
        to[v] = (uint32_t)q.n++;
      }
    Tri b;
    build(&b, &q, false);
    tri_compact(&m, false);
    assert_int_equal(m.nt, b.nt);
    for (EdgeId e = 0; e < 3 * m.nt; e++)
      if (m.vert[e] != TRI_INF) m.vert[e] = to[m.vert[e]];
    assert_same_triangles(&b, &m);
    free(to);
    tri_free(&m);
    tri_free(&b);
    free(q.xy);
    free(p.xy);
  }
}

// Random segments among random points; crossings are reported, the rest is there, and the triangulation is the same
// in whatever order they come.
static void segments_are_recovered(void **state)
{
  (void)state;
  for (int set = 0; set < SETS - 1; set++) {
    Points p = points_make(set, 200, 29);
    Tri m;
    build(&m, &p, true);
    Rng r = {2};
    enum { N = 60 };
    uint32_t ends[2 * N];
    for (int i = 0; i < 2 * N; i++) ends[i] = rng_below(&r, m.nv);
    TriSegEvents ev = {0};
    size_t crossings = tri_insert_segments(&m, ends, NULL, N, &ev);
    assert_valid(&m, rules_for(set));
    size_t n = 0;
    for (size_t i = 0; i < ev.len; i++)
      if (ev.data[i].what == TRI_SEG_CROSSES) {
        uint32_t a = ev.data[i].a, b = ev.data[i].b;
        SegMeet s = segments_meet(tri_xy(&m, ends[2 * a]), tri_xy(&m, ends[2 * a + 1]), tri_xy(&m, ends[2 * b]),
                                  tri_xy(&m, ends[2 * b + 1]));
        assert_true(s == SEG_CROSS);
        n++;
      }
    assert_int_equal(n, crossings);
    vec_free(&ev);
    tri_free(&m);
    free(p.xy);
  }
}

// A long segment through many triangles.
static void long_segment_is_recovered(void **state)
{
  (void)state;
  for (int set = 0; set < 3; set++) {
    Points p = points_make(set, 3000, 31);
    p.xy[0] = -1, p.xy[1] = 0.43, p.xy[2] = 9, p.xy[3] = 0.57;
    Tri m;
    build(&m, &p, false);
    uint32_t ends[2] = {0, 1};
    assert_int_equal(tri_insert_segments(&m, ends, NULL, 1, NULL), 0);
    EdgeId e = tri_find_edge(&m, 0, 1);
    assert_true(e != NONE && tri_segment(&m, e) == 0);
    assert_valid(&m, TRI_CHECK_ALL);
    tri_free(&m);
    free(p.xy);
  }
}

static void square_with_hole(Tri *m, uint32_t *inside, const TriCarve *how)
{
  double xy[] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 3, 1, 3, 3, 1, 3, 2, 2, 0.5, 2};
  uint32_t ends[] = {0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4};
  TriBuild b = {0};
  assert_int_equal(tri_build(m, xy, 10, &b), TRI_BUILD_GOOD);
  assert_int_equal(tri_insert_segments(m, ends, NULL, 8, NULL), 0);
  *inside = tri_carve(m, how);
}

static double area_inside(const Tri *m)
{
  double sum = 0;
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    const double *a = tri_xy(m, m->vert[3 * t]), *b = tri_xy(m, m->vert[3 * t + 1]), *c = tri_xy(m, m->vert[3 * t + 2]);
    sum += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  return sum;
}

static void carving(void **state)
{
  (void)state;
  Tri m;
  uint32_t n;
  double hole[] = {2, 2.5}, seeds[] = {2, 2.5, 0.1, 0.1};
  uint32_t labels[] = {7, 9};
  square_with_hole(&m, &n, &(TriCarve){.even_odd = true});
  assert_true(area_inside(&m) == 12);
  tri_free(&m);
  square_with_hole(&m, &n, &(TriCarve){.holes = hole, .nholes = 1});
  assert_true(area_inside(&m) == 12);
  tri_free(&m);
  bool embedded[8] = {0, 0, 0, 0, 1, 1, 1, 1};
  square_with_hole(&m, &n, &(TriCarve){.even_odd = true, .embedded = embedded});
  assert_true(area_inside(&m) == 16);
  tri_free(&m);
  square_with_hole(&m, &n, &(TriCarve){.regions = seeds, .labels = labels, .nregions = 2});
  assert_true(area_inside(&m) == 16);
  for (TriId t = 0; t < m.nt; t++)
    if (tri_is_inside(&m, t)) {
      bool centre = m.vert[3 * t] == 8 || m.vert[3 * t + 1] == 8 || m.vert[3 * t + 2] == 8;
      assert_int_equal(m.region[t], centre ? 7 : 9);
    }
  tri_compact(&m, true);
  assert_true(area_inside(&m) == 16);
  tri_free(&m);
}

// Segments are split at rounded midpoints, over and over: the triangulation stays valid and the domain keeps its area.
static void splitting_segments(void **state)
{
  (void)state;
  Rng r = {3};
  double xy[16] = {0};
  uint32_t ends[16];
  for (int i = 0; i < 8; i++) {
    xy[2 * i] = cos(0.3 + 0.78539816 * i), xy[2 * i + 1] = sin(0.3 + 0.78539816 * i);
    ends[2 * i] = (uint32_t)i, ends[2 * i + 1] = (uint32_t)(i + 1) % 8;
  }
  Tri m;
  TriBuild b = {0};
  TriCavity c = {0};
  tri_build(&m, xy, 8, &b);
  tri_insert_segments(&m, ends, NULL, 8, NULL);
  tri_carve(&m, &(TriCarve){.even_odd = true});
  double area = area_inside(&m);
  for (int i = 0; i < 3000; i++) {
    EdgeId e = rng_below(&r, 3 * m.nt);
    if (tri_org(&m, e) == TRI_INF || tri_dest(&m, e) == TRI_INF) continue;
    const double *p = tri_xy(&m, tri_org(&m, e)), *q = tri_xy(&m, tri_dest(&m, e));
    double mid[2] = {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2};
    if (!tri_is_segment(&m, e) && i % 10) continue;
    if (hypot(p[0] - q[0], p[1] - q[1]) < 1e-12) continue;
    VertId v;
    TriInsert res = tri_split_segment(&m, &c, mid, e, &v);
    assert_true(res == TRI_INSERTED || res == TRI_BLOCKED || !tri_is_segment(&m, e));
    if (i % 50 == 0) assert_valid(&m, TRI_CHECK_ALL);
  }
  assert_valid(&m, TRI_CHECK_ALL);
  assert_true(fabs(area_inside(&m) - area) < 1e-14 * 100);
  tri_cavity_free(&c);
  tri_free(&m);
}

// Random flips, moves, splits and collapses keep a valid triangulation; the flip algorithm makes it Delaunay again.
static void local_changes(void **state)
{
  (void)state;
  Points p = points_make(0, 300, 41);
  Tri m;
  build(&m, &p, true);
  tri_make_hints(&m);
  uint32_t ends[] = {0, 150, 20, 250};
  tri_insert_segments(&m, ends, NULL, 2, NULL);
  Rng r = {8};
  int flips = 0, collapses = 0, moves = 0, splits = 0;
  for (int i = 0; i < 20000; i++) {
    EdgeId e = rng_below(&r, 3 * m.nt);
    if (tri_is_free(&m, tri_of(e))) continue;
    VertId a = tri_org(&m, e), b = tri_dest(&m, e);
    if (a == TRI_INF || b == TRI_INF) continue;
    const double *pa = tri_xy(&m, a), *pb = tri_xy(&m, b);
    double mid[2] = {(pa[0] + pb[0]) / 2, (pa[1] + pb[1]) / 2};
    switch (rng_below(&r, 4)) {
    case 0:
      if (tri_can_flip(&m, e)) tri_flip(&m, e), flips++;
      break;
    case 1:
      if (tri_can_collapse(&m, e)) tri_collapse(&m, e), collapses++;
      break;
    case 2: moves += tri_move(&m, a, mid); break;
    case 3: splits += tri_split_edge(&m, mid, e) != NONE; break;
    }
    if (i % 500 == 0) assert_valid(&m, TRI_CHECK_ALL & ~TRI_CHECK_DELAUNAY);
    EdgeId where;
    double q[2] = {rng_double(&r) * 1.2 - 0.1, rng_double(&r) * 1.2 - 0.1};
    tri_locate(&m, q, e, &where);
  }
  assert_true(flips > 100 && collapses > 100 && moves > 100 && splits > 100);
  assert_valid(&m, TRI_CHECK_ALL & ~TRI_CHECK_DELAUNAY);
  tri_legalize_all(&m);
  assert_valid(&m, TRI_CHECK_ALL);
  tri_compact(&m, false);
  assert_valid(&m, TRI_CHECK_ALL);
  tri_free(&m);
  free(p.xy);
}

// Cells are convex, fill the rectangle, and every corner is as far from its own vertex as from none nearer; a side that is not
// on the frame belongs to two cells.
static void voronoi_cells(void **state)
{
  (void)state;
  static const double lo[2] = {-1.1, -1.2}, hi[2] = {1.3, 1.15};
  for (int set = 0; set < 7; set++)
    for (size_t n = 1; n <= 240; n = 3 * n + 1) {
      Points p = points_make(set, n, 19);
      double largest = 1;
      for (size_t i = 0; i < 2 * n; i++) largest = fmax(largest, fabs(p.xy[i]));
      for (size_t i = 0; i < 2 * n; i++) p.xy[i] /= largest;
      Tri m;
      build(&m, &p, true);
      TriVoronoi d;
      tri_voronoi(&m, lo, hi, &d);
      double area = 0;
      size_t inner = 0, frame = 0;
      for (VertId v = 0; v < m.nv; v++) {
        uint32_t k = d.start[v + 1] - d.start[v];
        const uint32_t *corner = d.corners + d.start[v];
        const double *q = tri_xy(&m, v);
        assert_true(k >= 3);
        for (uint32_t i = 0; i < k; i++) {
          const double *c = d.xy + 2 * corner[i], *e = d.xy + 2 * corner[(i + 1) % k], *f = d.xy + 2 * corner[(i + 2) % k];
          assert_true((e[0] - c[0]) * (f[1] - e[1]) - (e[1] - c[1]) * (f[0] - e[0]) > -1e-9);
          area += (c[0] * e[1] - c[1] * e[0]) / 2;
          bool on_frame = (c[0] == e[0] && (c[0] == lo[0] || c[0] == hi[0])) || (c[1] == e[1] && (c[1] == lo[1] || c[1] == hi[1]));
          *(on_frame ? &frame : &inner) += 1;
          double own = hypot(c[0] - q[0], c[1] - q[1]);
          for (VertId u = 0; u < m.nv; u++) assert_true(hypot(c[0] - m.xy[2 * u], c[1] - m.xy[2 * u + 1]) > own - 1e-9);
        }
      }
      assert_true(fabs(area - (hi[0] - lo[0]) * (hi[1] - lo[1])) < 1e-9);
      assert_true(inner % 2 == 0 && frame >= 4);
      // V - E + F = 2 with the outside as a face: the cells are one subdivision, no node is there twice or unused
      assert_int_equal((long)d.nnode - (long)(inner / 2 + frame) + (long)m.nv + 1, 2);
      tri_voronoi_free(&d);
      tri_free(&m);
      free(p.xy);
    }
}

static void bad_input(void **state)
{
  (void)state;
  double xy[] = {0, 0, 1, 0, NAN, 1, 0, 1};
  Tri m;
  tri_init(&m);
  TriBuild how = {0};
  assert_int_equal(tri_build(&m, xy, 4, &how), TRI_BUILD_NOT_FINITE);
  assert_int_equal(how.bad, 2);
  xy[4] = INFINITY;
  assert_int_equal(tri_build(&m, xy, 4, &how), TRI_BUILD_NOT_FINITE);
  double same[] = {1, 2, 1, 2, -0.0, 0, 0, 0, 1, 2};
  uint32_t of[5];
  U32Vec dup = {0};
  how = (TriBuild){.vertex_of = of, .duplicates = &dup};
  assert_int_equal(tri_build(&m, same, 5, &how), TRI_BUILD_GOOD);
  assert_int_equal(m.dim, 1);
  uint32_t want[5] = {0, 0, 2, 2, 0}, later[3] = {1, 3, 4};
  assert_memory_equal(of, want, sizeof want);
  assert_int_equal(dup.len, 3);
  assert_memory_equal(dup.data, later, sizeof later);
  vec_free(&dup);
  tri_free(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_set_is_delaunay),
    cmocka_unit_test(shuffles_change_nothing),
    cmocka_unit_test(one_by_one_is_the_same),
    cmocka_unit_test(builders_agree),
    cmocka_unit_test(location_is_exact),
    cmocka_unit_test(removal_undoes_insertion),
    cmocka_unit_test(segments_are_recovered),
    cmocka_unit_test(long_segment_is_recovered),
    cmocka_unit_test(carving),
    cmocka_unit_test(splitting_segments),
    cmocka_unit_test(local_changes),
    cmocka_unit_test(voronoi_cells),
    cmocka_unit_test(bad_input),
  };
  return unit_run(tests);
}
