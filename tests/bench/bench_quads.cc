// bench_quads.cc - time of the matching solver against LEMON's, on dual graphs of meshes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "../unit/dual_graphs.h"

extern "C" {
#include "base/diag.h"
#include "geom/quality.h"
#include "mesh/mesh.h"
#include "out/formats.h"
}

static double cpu()
{
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static QuadMesh read_mesh(const char *path)
{
  Diag *diag = diag_new(true);
  ExitCode status;
  Mesh *mesh = out_read(path, NULL, 0, diag, &status);
  if (!mesh) std::exit(3);
  std::vector<double> xy;
  std::vector<uint32_t> tri;
  for (size_t v = 0; v < mesh->nnode; v++) xy.insert(xy.end(), {mesh->xyz[3 * v], mesh->xyz[3 * v + 1]});
  for (size_t b = 0; b < mesh->nblock; b++)
    if (mesh->block[b].type == ELEM_TRI3) tri.insert(tri.end(), mesh->block[b].node, mesh->block[b].node + 3 * mesh->block[b].n);
  QuadMesh m;
  quad_mesh_init(&m, xy.data(), NULL, mesh->nnode, tri.data(), tri.size() / 3, NULL, 0);
  for (size_t b = 0; b < mesh->nblock; b++)
    for (size_t i = 0; mesh->block[b].type == ELEM_QUAD4 && i < 4 * mesh->block[b].n; i++) vec_push(&m.vertex, mesh->block[b].node[i]);
  mesh_free(mesh);
  diag_free(diag);
  return m;
}

// The dual graph of the triangles of a mesh file.
static Graph file_graph(const char *path)
{
  QuadMesh m = read_mesh(path);
  Graph g = dual_graph(&m);
  quad_mesh_free(&m);
  return g;
}

// Sizes wanted: of geo/seed_rectangle.geo, or the same everywhere.
static double rectangle_size(void *, Vec2 p) { return 0.1 + 0.08 * std::sin(3 * p.x) * std::cos(6 * p.y); }
static double even_size(void *h, Vec2) { return *static_cast<double *>(h); }

// Efficiency index over all edges.
static double efficiency(const QuadMesh *m, SizeAt size, void *ctx)
{
  uint32_t *twin = quad_mesh_twins(m);
  double sum = 0;
  size_t n = 0;
  for (uint32_t s = 0; s < m->vertex.len; s++) {
    uint32_t e = s / 4, k = quad_mesh_corners(m, e);
    if (s % 4 >= k || (twin[s] != NONE && twin[s] < s)) continue;
    sum += quality_tau_term(quality_edge_length(m->xy.data[m->vertex.data[s]], m->xy.data[m->vertex.data[4 * e + (s % 4 + 1) % k]], size, ctx));
    n++;
  }
  std::free(twin);
  return std::exp(sum / static_cast<double>(n));
}

// What a mesh of quads is worth, whoever made it.
static int measure(const char *name, const char *path, const char *sizes)
{
  QuadMesh m = read_mesh(path);
  QuadQuality q = quad_measure(&m);
  std::printf("%-10s %8zu quads %6zu triangles   eta min %.3f 5%% %.3f mean %.3f   scaled Jacobian %.3f   irregular %.1f %%", name,
              q.quads, q.triangles, q.eta_min, q.eta_p5, q.eta_mean, q.jacobian_min, 100.0 * (double)q.irregular / (double)q.interior);
  if (q.triangles == 0) std::printf("   indices %ld/4, chi %ld", q.index_sum4, q.euler);
  double h = std::strtod(sizes, NULL);
  std::printf("   tau %.3f\n", h > 0 ? efficiency(&m, even_size, &h) : efficiency(&m, rectangle_size, NULL));
  quad_mesh_free(&m);
  return 0;
}

static bool bench(const char *name, const Graph &g, double lemon_most)
{
  BlossomGraph view = g.view();
  double solved = 1e9, checked = 0;
  bool good = true;
  BlossomResult *r = NULL;
  for (int run = 0; run < (g.n < 300000 ? 3 : 1) && good; run++) {
    blossom_free(r);
    double t = cpu();
    r = blossom_solve(&view);
    solved = std::min(solved, cpu() - t);
    t = cpu();
    good = blossom_check(&view, r, NULL) == BLOSSOM_OK && r->unmatched == 0;
    checked = cpu() - t;
  }
  std::printf("%-28s %9u %9.4f %9.4f", name, g.n, solved, checked);
  int64_t cost = r->cost;
  double lemon = 0;
  if (g.n <= lemon_most) cost = lemon_cost(g, cpu, &lemon);
  if (lemon > 0) std::printf(" %9.4f %7.1f", lemon, lemon / solved);
  else std::printf(" %9s %7s", "-", "-");
  std::printf(" %8.1f%s\n", (double)r->stats.swept / g.n, !good ? "  NOT OPTIMAL" : cost == r->cost ? "" : "  COSTS DIFFER");
  std::fflush(stdout);
  good = good && cost == r->cost;
  blossom_free(r);
  return good;
}

// Arguments: largest number of triangles of lattices, and up to which LEMON is run; then mesh files. Or: measure NAME FILE SIZE,
// the size a number or "rectangle" for that of geo/seed_rectangle.geo.
int main(int argc, char **argv)
{
  if (argc == 5 && std::strcmp(argv[1], "measure") == 0) return measure(argv[2], argv[3], argv[4]);
  double most = argc > 1 ? std::strtod(argv[1], NULL) : 3e5, lemon_most = argc > 2 ? std::strtod(argv[2], NULL) : 3.5e4;
  std::printf("%-28s %9s %9s %9s %9s %7s %8s\n", "graph", "triangles", "solve s", "check s", "LEMON s", "ratio", "swept/n");
  bool good = true;
  for (int i = 3; i < argc; i++) {
    const char *name = std::strrchr(argv[i], '/');
    good &= bench(name ? name + 1 : argv[i], file_graph(argv[i]), lemon_most);
  }
  for (double jitter : {0.01, 0.2})
    for (double n = 1000; n <= most; n *= std::sqrt(10.0)) {
      char name[64];
      std::snprintf(name, sizeof name, "lattice, jitter %g", jitter);
      good &= bench(name, mesh_graph((uint32_t)std::lround(std::sqrt(n / 1.732)), jitter, 0, 1), lemon_most);
    }
  return good ? 0 : 1;
}
