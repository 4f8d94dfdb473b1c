// fuzz_mesh.c - any bytes are a mesh file of any format: no crash, no hang, memory in proportion to the bytes
// SPDX-License-Identifier: MIT
//
// The first byte chooses the format. What is read is audited, measured and hashed too. With clang: CONFIG=fuzz and
// -fsanitize=fuzzer.
#include "base/base.h"

#include "mesh/mesh_check.h"
#include "mesh/mesh_hash.h"
#include "mesh/mesh_stats.h"
#include "mesh/part_entities.h"
#include "mesh/partition_stats.h"
#include "out/formats.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// What reports and files say of the parts.
static void use_parts(const Mesh *m)
{
  PartitionStats s;
  partition_stats_make(&s, m);
  partition_stats_free(&s);
  mesh_free(mesh_part_entities(m, &(PartEntityOptions){.topology = true, .groups = true}));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static const char *const formats[] = {"msh", "vtk", "vtu", "mesh", "inp", "su2", "unv", "off", "obj", "ply", "stl"};
  if (size < 1) return 0;
  char *text = malloc(size);
  if (!text) return 0;
  memcpy(text, data + 1, size - 1);
  text[size - 1] = 0;
  Diag *diag = diag_new(false);
  Mesh *m = out_read_memory(text, size - 1, "fuzz", formats[data[0] % ARRAY_LEN(formats)], diag);
  if (m) {
    MeshReport r;
    MeshStats s;
    mesh_check(m, false, &r);
    mesh_stats_make(&s, m, NULL);
    mesh_hash(m, true);
    if (m->nparts) use_parts(m);
    mesh_stats_free(&s);
    mesh_report_free(&r);
  }
  mesh_free(m);
  diag_free(diag);
  free(text);
  return 0;
}
