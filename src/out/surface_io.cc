// surface_io.cc - OFF, OBJ, PLY and STL by way of the OpenMesh library
// SPDX-License-Identifier: MIT
// The library grows its arrays by vectors that it leaves unset, and gcc says so at the end of its inlining.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
// OpenMesh has names that are macros of base/base.h, so it comes first.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include <sstream>
#include <string>
#include <vector>

#include "out/surface_io.h"

namespace {

struct Traits : OpenMesh::DefaultTraits {
  typedef OpenMesh::Vec3d Point;
  typedef OpenMesh::Vec3d Normal;
};
typedef OpenMesh::PolyMesh_ArrayKernelT<Traits> HalfEdgeMesh;

// The library writes its complaints to std::cerr; ours go through Diag.
void be_quiet()
{
  omerr().disable();
  omlog().disable();
  omout().disable();
}

bool fill(HalfEdgeMesh &mesh, const SurfacePolygons *p)
{
  std::vector<OpenMesh::VertexHandle> corner;
  for (size_t i = 0; i < p->nnode; i++) mesh.add_vertex(OpenMesh::Vec3d(p->xyz[3 * i], p->xyz[3 * i + 1], p->xyz[3 * i + 2]));
  for (size_t f = 0; f < p->nface; f++) {
    corner.clear();
    for (uint32_t k = p->start[f]; k < p->start[f + 1]; k++) corner.push_back(mesh.vertex_handle(p->vertex[k]));
    if (!mesh.add_face(corner).is_valid()) return false;
  }
  return true;
}

} // namespace

const char *surface_write(const SurfacePolygons *p, const char *ext, bool binary, char **text, size_t *len)
{
  be_quiet();
  try {
    HalfEdgeMesh mesh;
    if (!fill(mesh, p)) return "the surface is not manifold, or neighbours are oriented differently, which this format's library cannot hold";
    OpenMesh::IO::Options options = OpenMesh::IO::Options::Default;
    if (binary) options += OpenMesh::IO::Options::Binary;
    if (std::string(ext) == "stl") {
      mesh.request_face_normals();
      mesh.update_face_normals();
      options += OpenMesh::IO::Options::FaceNormal;
    }
    std::string kind = std::string(".") + ext;
    if (kind == ".stl") kind = binary ? ".stlb" : ".stla";
    std::ostringstream os(std::ios::binary);
    if (!OpenMesh::IO::write_mesh(mesh, os, kind, options, 17)) return "the library could not write it";
    const std::string s = os.str();
    *text = static_cast<char *>(malloc(s.size() + 1));
    if (!*text) return "out of memory";
    memcpy(*text, s.data(), s.size());
    *len = s.size();
    return nullptr;
  } catch (const std::exception &) {
    return "the library could not write it";
  }
}

const char *surface_read(SurfacePolygons *p, const char *ext, const char *text, size_t len)
{
  be_quiet();
  try {
    HalfEdgeMesh mesh;
    std::istringstream is(std::string(text, len), std::ios::binary);
    OpenMesh::IO::Options options = OpenMesh::IO::Options::Default;
    std::string kind = std::string(".") + ext;
    if (kind == ".stl") kind = len >= 5 && memcmp(text, "solid", 5) == 0 ? ".stla" : ".stlb";
    if (!OpenMesh::IO::read_mesh(mesh, is, kind, options)) return "the library could not read it";
    size_t corners = 0;
    for (auto f : mesh.faces()) corners += mesh.valence(f);
    p->nnode = mesh.n_vertices();
    p->nface = mesh.n_faces();
    p->xyz = static_cast<double *>(malloc(3 * p->nnode * sizeof(double) + 1));
    p->start = static_cast<uint32_t *>(malloc((p->nface + 1) * sizeof(uint32_t)));
    p->vertex = static_cast<uint32_t *>(malloc(corners * sizeof(uint32_t) + 1));
    if (!p->xyz || !p->start || !p->vertex) return "out of memory";
    for (auto v : mesh.vertices())
      for (int k = 0; k < 3; k++) p->xyz[3 * static_cast<size_t>(v.idx()) + static_cast<size_t>(k)] = mesh.point(v)[static_cast<size_t>(k)];
    uint32_t at = 0;
    size_t n = 0;
    for (auto f : mesh.faces()) {
      p->start[n++] = at;
      for (auto v : mesh.fv_range(f)) p->vertex[at++] = static_cast<uint32_t>(v.idx());
    }
    p->start[n] = at;
    return nullptr;
  } catch (const std::exception &) {
    return "the library could not read it";
  }
}
