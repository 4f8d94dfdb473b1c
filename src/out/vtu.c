// vtu.c - writer of VTK XML unstructured grids (.vtu): appended raw data in zlib blocks
// SPDX-License-Identifier: MIT
//
// Cell arrays: CellEntityIds (first group or -1), CellEntityIds2, ... where elements are in several groups, and
// GeometricalEntityIds. Field arrays, one for each group that has a name, hold its tag and dimension.
#include "base/base.h"

#include <zlib.h>

#include "out/out_int.h"

const char *vtu__refuses(const Selection *s) { return vtk__refuses(s); }

enum { BLOCK = 1 << 18 };

typedef Vec(unsigned char) Bytes;

// Append the blocks of an array: their number and sizes, then the compressed bytes.
static void append_array(Bytes *out, const void *data, size_t n)
{
  size_t blocks = (n + BLOCK - 1) / BLOCK, at = out->len;
  vec_resize(out, at + (3 + blocks) * 8);
  uint64_t head[3] = {blocks, BLOCK, n % BLOCK};
  memcpy(out->data + at, head, sizeof head);
  for (size_t b = 0; b < blocks; b++) {
    size_t from = b * BLOCK, len = MIN((size_t)BLOCK, n - from);
    uLongf room = compressBound(len);
    vec_reserve(out, out->len + room);
    // Level 1: coordinates hardly compress, and indices do at any level.
    compress2(out->data + out->len, &room, (const Bytef *)data + from, len, 1);
    uint64_t size = room;
    memcpy(out->data + at + (3 + b) * 8, &size, 8);
    out->len += room;
  }
}

static void write_name(Writer *w, const char *name)
{
  for (; *name; name++)
    if (*name == '&')
      writer_str(w, "&amp;");
    else if (*name == '<')
      writer_str(w, "&lt;");
    else if (*name == '>')
      writer_str(w, "&gt;");
    else if (*name == '"')
      writer_str(w, "&quot;");
    else
      writer_char(w, (unsigned char)*name < ' ' ? ' ' : *name);
}

static void declare(Writer *w, const char *type, const char *name, int components, size_t offset)
{
  writer_printf(w, "        <DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%zu\"/>\n",
                type, name, components, offset);
}

static void append_points(Bytes *out, const Selection *s)
{
  double *x = mem_alloc(3 * s->nnode * sizeof *x);
  for (size_t k = 0; k < s->nnode; k++) {
    Vec3 p = select__xyz(s, k);
    memcpy(x + 3 * k, &p, sizeof p);
  }
  append_array(out, x, 3 * s->nnode * sizeof *x);
  free(x);
}

// Connectivity, offsets and types, with the offset of each in the appended data.
static void append_cells(Bytes *out, const Selection *s, size_t at[3])
{
  const Mesh *m = s->mesh;
  size_t total = 0, n = 0, c = 0;
  for (size_t i = 0; i < s->nblock; i++) total += m->block[s->block[i]].n * (size_t)elem_nodes(m->block[s->block[i]].type);
  int64_t *node = mem_alloc(total * sizeof *node), *end = mem_alloc(s->nelem * sizeof *end);
  uint8_t *type = mem_alloc(s->nelem);
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &m->block[s->block[i]];
    uint8_t perm[ELEM_MAX_NODES];
    int nodes = vtk__order(k->type, perm);
    for (size_t j = 0; j < k->n; j++) {
      for (int a = 0; a < nodes; a++) node[c++] = s->number[k->node[j * (size_t)nodes + perm[a]]];
      end[n] = (int64_t)c;
      type[n++] = (uint8_t)vtk__cell_type(k->type);
    }
  }
  at[0] = out->len;
  append_array(out, node, total * sizeof *node);
  at[1] = out->len;
  append_array(out, end, n * sizeof *end);
  at[2] = out->len;
  append_array(out, type, n);
  free(node);
  free(end);
  free(type);
}

// The which-th group of every element (0 first), or with which = -1 its entity.
static void append_tags(Bytes *out, const Selection *s, int which)
{
  int32_t *tag = mem_alloc(s->nelem * sizeof *tag);
  size_t n = 0;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    const MeshEntity *e = &s->mesh->entity[k->entity];
    int32_t v = which < 0 ? e->tag : (size_t)which < e->physical.len ? abs(e->physical.data[which]) : -1;
    for (size_t j = 0; j < k->n; j++) tag[n++] = v;
  }
  append_array(out, tag, n * sizeof *tag);
  free(tag);
}

static void append_parts(Bytes *out, const Selection *s)
{
  int32_t *part = mem_alloc(s->nelem * sizeof *part);
  size_t n = 0;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    for (size_t j = 0; j < k->n; j++) part[n++] = (int32_t)k->part[j];
  }
  append_array(out, part, n * sizeof *part);
  free(part);
}

static void write_fields(Writer *w, const Mesh *m)
{
  bool any = false;
  for (size_t g = 0; g < m->ngroup; g++) {
    if (!m->group[g].name) continue;
    if (!any) writer_str(w, "    <FieldData>\n");
    any = true;
    writer_str(w, "      <DataArray type=\"Int32\" Name=\"");
    write_name(w, m->group[g].name);
    writer_printf(w, "\" NumberOfComponents=\"2\" NumberOfTuples=\"1\" format=\"ascii\">%d %d</DataArray>\n", m->group[g].tag,
                  m->group[g].dim);
  }
  if (any) writer_str(w, "    </FieldData>\n");
}

void vtu__write(Writer *w, const Selection *s, const OutOptions *o)
{
  Bytes data = {0};
  size_t cells[3], most = 0, at;
  for (size_t i = 0; i < s->nblock; i++) most = MAX(most, s->mesh->entity[s->mesh->block[s->block[i]].entity].physical.len);
  writer_str(w, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
                "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <UnstructuredGrid>\n");
  write_fields(w, s->mesh);
  writer_printf(w, "    <Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n      <Points>\n", s->nnode, s->nelem);
  declare(w, "Float64", "Points", 3, 0);
  append_points(&data, s);
  append_cells(&data, s, cells);
  writer_str(w, "      </Points>\n      <Cells>\n");
  declare(w, "Int64", "connectivity", 1, cells[0]);
  declare(w, "Int64", "offsets", 1, cells[1]);
  declare(w, "UInt8", "types", 1, cells[2]);
  writer_str(w, "      </Cells>\n      <CellData>\n");
  for (size_t k = 0; k < most; k++) {
    char name[40];
    snprintf(name, sizeof name, k ? "CellEntityIds%zu" : "CellEntityIds", k + 1);
    at = data.len;
    append_tags(&data, s, (int)k);
    declare(w, "Int32", name, 1, at);
  }
  at = data.len;
  append_tags(&data, s, -1);
  declare(w, "Int32", "GeometricalEntityIds", 1, at);
  if (s->mesh->nparts) {
    at = data.len;
    append_parts(&data, s);
    declare(w, "Int32", "partition", 1, at);
  }
  for (Measure what = 0; cell_data__next(o, &what); what++) {
    double *value = cell_data__values(s, what);
    at = data.len;
    append_array(&data, value, s->nelem * sizeof *value);
    declare(w, "Float64", mesh_measure_name(what), 1, at);
    free(value);
  }
  writer_str(w, "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_");
  writer_bytes(w, data.data, data.len);
  writer_str(w, "\n  </AppendedData>\n</VTKFile>\n");
  vec_free(&data);
}
