// bench_tables.c - Tables 3.1 and 3.2 of the book with our columns: steps of the walk, size of the cavity, seconds
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/stats.h"
#include "geom/hilbert.h"
#include "point_sets.h"
#include "tri/tri.h"

static void row(const char *name, size_t n, const Tri *m, uint64_t cavity, double seconds)
{
  printf("| %s | %zu | %.2f | %.2f | %.4f | %.5f |\n", name, n, (double)m->walk_steps / (double)MAX(m->walks, 1u),
         (double)cavity / (double)MAX(m->walks, 1u), seconds,
         (double)(m->count.orient_slow + m->count.incircle_slow) / (double)n);
}

// Of the new triangles around the vertex just made, the one in whose sector q lies: 3t+2 is the spoke at its vertex.
static EdgeId facing(const Tri *m, const TriCavity *c, VertId v, const double *q)
{
  for (size_t k = 0; k < c->tri.len; k++) {
    EdgeId rim = 3 * c->tri.data[k];
    VertId a = tri_org(m, rim), b = tri_dest(m, rim);
    if (a == TRI_INF || b == TRI_INF) continue;
    if (orient2d(tri_xy(m, v), tri_xy(m, a), q) >= 0 && orient2d(tri_xy(m, v), tri_xy(m, b), q) < 0) return rim;
  }
  return NONE;
}

// One by one in some order; walks start from the same triangle, or from the last one made (with
// `sector`: from that of its triangles that faces the point). With `around`, into the
// triangulation of three points around all (the book's super-triangle), else into that of the first three.
static void one_by_one(const char *name, size_t n, const double *xy, const uint32_t *order, EdgeId start, bool around, bool sector)
{
  Tri m;
  TriCavity c = {0};
  uint64_t cavity = 0;
  double t = time_cpu(), first[6] = {-2, -2, 5, -2, 0.5, 7};
  TriBuild how = {0};
  for (size_t i = 0; i < 3 && !around; i++) memcpy(first + 2 * i, xy + 2 * (size_t)order[i], 2 * sizeof *first);
  if (tri_build(&m, first, 3, &how) != TRI_BUILD_GOOD) exit(1);
  m.walks = m.walk_steps = 0;
  for (size_t i = around ? 0 : 3; i < n; i++) {
    const double *p = xy + 2 * (size_t)order[i];
    EdgeId e;
    EdgeId from = sector && c.tri.len ? facing(&m, &c, m.nv - 1, p) : NONE;
    TriLoc loc = tri_locate(&m, p, from != NONE ? from : start, &e);
    if (tri_cavity(&m, &c, p, loc, e) != TRI_INSERTED) continue;
    cavity += c.tri.len;
    tri_commit(&m, &c);
  }
  row(name, n, &m, cavity, time_cpu() - t);
  tri_cavity_free(&c);
  tri_free(&m);
}

// Biased randomized insertion order: each point is in the last round with probability 1/2, in the one before with 1/4,
// and so on; within a round along the curve.
static void brio_order(size_t n, const uint32_t *curve, uint32_t *order)
{
  Rng r = {99};
  uint8_t *round = mem_alloc(n);
  for (size_t i = 0; i < n; i++) round[i] = (uint8_t)__builtin_ctzll(rng_next(&r) | (uint64_t)1 << 12);
  size_t k = 0;
  for (int level = 12; level >= 0; level--)
    for (size_t i = 0; i < n; i++)
      if (round[i] == level) order[k++] = curve[i];
  free(round);
}

static void unsorted(size_t n, const double *xy)
{
  uint32_t *order = mem_alloc(n * sizeof *order);
  for (size_t i = 0; i < n; i++) order[i] = (uint32_t)i;
  one_by_one("as given", n, xy, order, 0, false, false);
  free(order);
}

enum { PLAIN, AROUND, BRIO, BRIO_SECTOR };
static const char *const way_names[] = {"Hilbert, one by one", "Hilbert, in a super-triangle", "BRIO rounds, one by one",
                                        "BRIO rounds, from the sector"};

static void along_curve(size_t n, const double *xy, int way)
{
  uint32_t *curve = mem_alloc(n * sizeof *curve), *order = mem_alloc(n * sizeof *order);
  hilbert_order(xy, n, curve);
  brio_order(n, curve, order);
  one_by_one(way_names[way], n, xy, way >= BRIO ? order : curve, NONE, way == AROUND, way == BRIO_SECTOR);
  free(curve);
  free(order);
}

static void sorted(size_t n, double *xy, bool incremental)
{
  Tri m;
  TriBuild how = {.reorder = true, .threads = 1, .incremental = incremental};
  double t = time_cpu();
  if (tri_build(&m, xy, n, &how) != TRI_BUILD_GOOD) exit(1);
  row(incremental ? "Hilbert, tri_build incremental" : "tri_build", n, &m, m.cavity_triangles, time_cpu() - t);
  tri_free(&m);
}

int main(void)
{
  printf("| order | n | steps | cavity | CPU s | filter misses a point |\n|---|---|---|---|---|---|\n");
  for (int pass = 0; pass < 7; pass++)
    for (size_t n = 1000; n <= (pass ? 1000000 : 100000); n *= 10) {
      double *xy = mem_alloc(2 * n * sizeof *xy);
      point_set_fill(0, n, xy);
      if (pass == 0) unsorted(n, xy);
      else if (pass < 5) along_curve(n, xy, pass - 1);
      else sorted(n, xy, pass == 5);
      free(xy);
    }
  return 0;
}
