// test_halfedge.cc - OpenMesh as the oracle: manifold surfaces, boundary loops, Euler characteristic, and its own readers
// SPDX-License-Identifier: MIT
// OpenMesh has names that are macros of base/base.h, so it comes first.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include <sstream>
#include <string>
#include <vector>

extern "C" {
#include "unit.h"

#include "base/file.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_edges.h"
#include "out/formats.h"
#include "quad/quad_mesh.h"
#include "quad_meshes.h"
}

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>

typedef OpenMesh::PolyMesh_ArrayKernelT<> HalfEdgeMesh;

namespace {

// A wavy square of 2 n^2 triangles, of which `holes` inner ones are left out.
Mesh *square_with_holes(size_t n, size_t holes)
{
  Mesh *m = mesh_new();
  uint32_t face = mesh_add_entity(m, 2, 1);
  for (size_t j = 0; j <= n; j++)
    for (size_t i = 0; i <= n; i++) {
      Vec3 p = {static_cast<double>(i), static_cast<double>(j) + 0.3 * std::sin(static_cast<double>(i)), 0};
      mesh_add_node(m, p, face, NAN);
    }
  std::vector<uint32_t> v;
  for (size_t j = 0; j < n; j++)
    for (size_t i = 0; i < n; i++) {
      uint32_t a = static_cast<uint32_t>(j * (n + 1) + i), b = a + 1, d = a + static_cast<uint32_t>(n) + 1, c = d + 1;
      bool hole = i % 3 == 1 && j % 3 == 1 && holes > 0 && holes--;
      for (uint32_t k : {a, b, c}) v.push_back(k);
      if (!hole)
        for (uint32_t k : {a, c, d}) v.push_back(k);
    }
  uint32_t block = mesh_add_block(m, face, ELEM_TRI3, v.size() / 3);
  std::copy(v.begin(), v.end(), m->block[block].node);
  return m;
}

// Load into half-edges; false if a face cannot be added because the surface is not manifold there.
bool load(HalfEdgeMesh &h, const Mesh *m)
{
  for (size_t i = 0; i < m->nnode; i++)
    h.add_vertex(OpenMesh::Vec3f(static_cast<float>(m->xyz[3 * i]), static_cast<float>(m->xyz[3 * i + 1]), 0));
  for (size_t b = 0; b < m->nblock; b++) {
    const size_t n = static_cast<size_t>(elem_nodes(m->block[b].type));
    for (size_t i = 0; i < m->block[b].n; i++) {
      std::vector<OpenMesh::VertexHandle> corner;
      for (size_t a = 0; a < n; a++) corner.push_back(h.vertex_handle(m->block[b].node[i * n + a]));
      if (!h.add_face(corner).is_valid()) return false;
    }
  }
  return true;
}

size_t boundary_loops(const HalfEdgeMesh &h)
{
  std::vector<bool> seen(h.n_halfedges());
  size_t n = 0;
  for (auto e : h.halfedges()) {
    if (!h.is_boundary(e) || seen[static_cast<size_t>(e.idx())]) continue;
    n++;
    for (OpenMesh::HalfedgeHandle k = e; !seen[static_cast<size_t>(k.idx())]; k = h.next_halfedge_handle(k))
      seen[static_cast<size_t>(k.idx())] = true;
  }
  return n;
}

// Our twins are its opposites, and boundary edges are the same ones.
void twins_agree(void **)
{
  for (size_t holes = 0; holes < 5; holes++) {
    Mesh *m = square_with_holes(9, holes);
    HalfEdgeMesh h;
    assert_true(load(h, m));
    MeshEdges e;
    mesh_edges_make(&e, m);
    size_t boundary = 0, ours = 0;
    for (auto k : h.halfedges()) boundary += h.is_boundary(k);
    for (size_t k = 0; k < e.n; k++) {
      HalfEdge x = mesh_edges_at(&e, m, k);
      auto there = h.find_halfedge(h.vertex_handle(x.a), h.vertex_handle(x.b));
      assert_true(there.is_valid());
      bool open = h.is_boundary(h.opposite_halfedge_handle(there));
      assert_true(open == (e.twin[k] == NONE));
      ours += open;
      if (open) continue;
      HalfEdge y = mesh_edges_at(&e, m, e.twin[k]);
      assert_true(y.a == x.b && y.b == x.a);
      assert_int_equal(e.twin[e.twin[k]], k);
    }
    assert_int_equal(ours, boundary);
    assert_int_equal(boundary_loops(h), 1 + holes);
    long chi = static_cast<long>(h.n_vertices()) - static_cast<long>(h.n_edges()) + static_cast<long>(h.n_faces());
    assert_int_equal(chi, 2 - static_cast<long>(boundary_loops(h)));
    MeshReport r;
    assert_true(mesh_check(m, false, &r)); // which counts V - E + F and boundary cycles by itself
    mesh_report_free(&r);
    mesh_edges_free(&e);
    mesh_free(m);
  }
}

// What OpenMesh refuses, the audit refuses.
void complex_edges_are_found_by_both(void **)
{
  omerr().disable();
  for (size_t which = 0; which < 32; which++) {
    Mesh *m = square_with_holes(4, 0);
    uint32_t *v = m->block[0].node + 3 * which;
    std::swap(v[0], v[1]); // turned over
    HalfEdgeMesh h;
    bool manifold = load(h, m);
    MeshReport r;
    bool good = mesh_check(m, false, &r);
    assert_true(!manifold && !good);
    assert_true(r.count[RULE_EDGE] > 0 && r.count[RULE_ORIENTATION] == 1);
    mesh_report_free(&r);
    mesh_free(m);
  }
}

// Its readers read what we write.
void reads_our_files(void **)
{
  Mesh *m = square_with_holes(8, 2);
  for (const char *ext : {"off", "obj", "ply", "stl"})
    for (bool binary : {false, true}) {
      if (binary && (std::string(ext) == "off" || std::string(ext) == "obj")) continue;
      const char *dir = getenv("SCRATCH");
      const std::string path = std::string(dir ? dir : "/tmp") + "/halfedge." + ext;
      Diag *d = diag_new(true);
      OutOptions o = {};
      o.binary = binary;
      assert_int_equal(out_write(m, path.c_str(), nullptr, &o, d), EXIT_GOOD);
      diag_free(d);
      HalfEdgeMesh h;
      OpenMesh::IO::Options options = binary ? OpenMesh::IO::Options::Binary : OpenMesh::IO::Options::Default;
      assert_true(OpenMesh::IO::read_mesh(h, path, options));
      assert_int_equal(h.n_faces(), m->block[0].n);
      assert_int_equal(h.n_vertices(), m->nnode);
      assert_int_equal(boundary_loops(h), 3);
      unlink(path.c_str());
    }
  mesh_free(m);
}

// A square with a hole (no triangle with a corner in a disc), recombined by each method: OpenMesh takes every element in, finds the
// Euler characteristic of a ring, 0, and so do the indices of the vertices.
void test_quads_are_manifold(void **)
{
  for (int method = QUAD_GREEDY; method <= QUAD_SPLIT; method++) {
    LatticeMesh lm = lattice_mesh(22, 0.15, 0.3, 5);
    std::vector<uint32_t> tri;
    for (size_t t = 0; t < lm.tri.len; t += 3) {
      bool inside = false;
      for (size_t i = t; i < t + 3; i++)
        inside |= std::hypot(lm.xy.data[2 * lm.tri.data[i]] - 0.55, lm.xy.data[2 * lm.tri.data[i] + 1] - 0.5) < 0.17;
      if (!inside) tri.insert(tri.end(), lm.tri.data + t, lm.tri.data + t + 3);
    }
    QuadMesh m;
    quad_mesh_init(&m, lm.xy.data, NULL, lm.xy.len / 2, tri.data(), tri.size() / 3, NULL, 0);
    quad_mesh_compact(&m);
    QuadParams p = quad_params_default();
    p.algorithm = static_cast<QuadAlgorithm>(method);
    quad_recombine(&m, &p, NULL);
    uint32_t where = 0;
    assert_int_equal(quad_check(&m, &where), QUAD_GOOD);
    HalfEdgeMesh h;
    for (size_t v = 0; v < m.xy.len; v++)
      h.add_vertex(OpenMesh::Vec3f(static_cast<float>(m.xy.data[v].x), static_cast<float>(m.xy.data[v].y), 0));
    for (size_t e = 0; e < quad_mesh_elements(&m); e++) {
      std::vector<HalfEdgeMesh::VertexHandle> corner;
      for (uint32_t i = 0; i < quad_mesh_corners(&m, e); i++) corner.push_back(h.vertex_handle(m.vertex.data[4 * e + i]));
      assert_true(h.add_face(corner).is_valid());
    }
    long boundary_nodes = 0;
    for (HalfEdgeMesh::VertexHandle v : h.vertices()) {
      assert_true(h.is_manifold(v) && !h.is_isolated(v));
      boundary_nodes += h.is_boundary(v);
    }
    QuadQuality q = quad_measure(&m);
    assert_int_equal(static_cast<long>(h.n_vertices()) - static_cast<long>(h.n_edges()) + static_cast<long>(h.n_faces()), 0);
    assert_int_equal(q.euler, 0);
    assert_int_equal(q.boundary_vertices, boundary_nodes);
    if (q.triangles == 0) assert_int_equal(q.index_sum4, 0);
    quad_mesh_free(&m);
    lattice_free(&lm);
  }
}

// A mesh file: its surface elements make a manifold, whose Euler characteristic is 2 for each component less 1 for each boundary loop,
// and is `wanted`.
int examine(const char *path, long wanted)
{
  Diag *d = diag_new(true);
  ExitCode status;
  Mesh *m = out_read(path, NULL, 0, d, &status);
  diag_free(d);
  if (!m) return 2;
  HalfEdgeMesh h;
  for (size_t i = 0; i < m->nnode; i++) h.add_vertex(OpenMesh::Vec3f(0, 0, 0)); // only what is joined to what matters
  bool manifold = true;
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock &k = m->block[b];
    const size_t corners = static_cast<size_t>(elem_corners(k.type)), nodes = static_cast<size_t>(elem_nodes(k.type));
    for (size_t i = 0; elem_dim(k.type) == 2 && i < k.n; i++) {
      std::vector<OpenMesh::VertexHandle> v;
      for (size_t a = 0; a < corners; a++) v.push_back(h.vertex_handle(k.node[i * nodes + a]));
      manifold = manifold && h.add_face(v).is_valid();
    }
  }
  mesh_free(m);
  std::vector<bool> seen(h.n_vertices());
  long vertices = 0, components = 0;
  std::vector<OpenMesh::VertexHandle> stack;
  for (auto v : h.vertices()) {
    if (h.is_isolated(v)) continue;
    vertices++;
    manifold = manifold && h.is_manifold(v);
    if (seen[static_cast<size_t>(v.idx())]) continue;
    components++;
    seen[static_cast<size_t>(v.idx())] = true;
    stack.push_back(v);
    while (!stack.empty()) {
      auto at = stack.back();
      stack.pop_back();
      for (auto w : h.vv_range(at)) {
        if (seen[static_cast<size_t>(w.idx())]) continue;
        seen[static_cast<size_t>(w.idx())] = true;
        stack.push_back(w);
      }
    }
  }
  long chi = vertices - static_cast<long>(h.n_edges()) + static_cast<long>(h.n_faces());
  std::printf("%s: %s, chi %ld, %ld components, %zu loops\n", path, manifold ? "manifold" : "not manifold", chi, components, boundary_loops(h));
  return manifold && chi == wanted && chi == 2 * components - static_cast<long>(boundary_loops(h)) ? 0 : 1;
}

} // namespace

// Without arguments the tests; with FILE CHI a look at a file, for scripts.
int main(int argc, char **argv)
{
  if (argc == 3) return examine(argv[1], std::strtol(argv[2], NULL, 10));
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(twins_agree),
      cmocka_unit_test(complex_edges_are_found_by_both),
      cmocka_unit_test(reads_our_files),
      cmocka_unit_test(test_quads_are_manifold),
  };
  return unit_run(tests);
}
