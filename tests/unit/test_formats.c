// test_formats.c - every format gives back what it can hold, and damaged files do no harm
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <math.h>
#include <unistd.h>

#include "base/file.h"
#include "base/rng.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_hash.h"
#include "mesh/mesh_stats.h"
#include "out/formats.h"

#include "mesh_sample.h"

static const char *scratch(char *buf, size_t cap, const char *name)
{
  const char *dir = getenv("SCRATCH");
  snprintf(buf, cap, "%s/formats.%s", dir ? dir : "/tmp", name);
  return buf;
}

static const char *extension(const char *format) { return strcmp(format, "triangle") == 0 ? "ele" : format; }

static Mesh *round_trip(const Mesh *m, const char *format, const OutOptions *o)
{
  char path[300];
  Diag *d = diag_new(true);
  scratch(path, sizeof path, extension(format));
  assert_int_equal(out_write(m, path, NULL, o, d), EXIT_GOOD);
  Mesh *back = out_read(path, NULL, 0, d, NULL);
  assert_non_null(back);
  assert_int_equal(diag_count(d), 0);
  diag_free(d);
  unlink(path);
  return back;
}

static void assert_hash(const uint64_t a[2], const uint64_t b[2], const char *what)
{
  char x[MESH_HASH_TEXT], y[MESH_HASH_TEXT];
  mesh_hash_print(a, x);
  mesh_hash_print(b, y);
  if (strcmp(x, y) != 0) fail_msg("%s: %s, not %s", what, x, y);
}

// What of a mesh a format can hold.
typedef struct {
  const char *name;
  bool points, lines, quads, groups, several, names;
  bool exact; // coordinates, to the bit
} Holds;

static const Holds holds[] = {
    {"msh", true, true, true, true, true, true, true},
    {"msh2", true, true, true, true, true, true, true},
    {"msh1", true, true, true, true, true, false, true},
    {"vtk", true, true, true, true, false, false, true},
    {"vtu", true, true, true, true, true, true, true},
    {"mesh", false, true, true, true, false, false, true},
    {"inp", false, true, true, false, false, false, true}, // groups by name, not by tag
    {"su2", false, false, true, false, false, false, true},
    {"unv", false, true, true, true, true, true, true},
    {"triangle", false, true, false, true, false, false, true},
    {"off", false, false, true, false, false, false, true},
    {"obj", false, false, true, false, false, false, true},
    {"ply", false, false, true, false, false, false, true},
    {"stl", false, false, false, false, false, false, true}, // if ASCII
};

// The sample without what the format cannot hold.
static Mesh *reduced(size_t n, const Holds *h, bool groups)
{
  Mesh *m = sample_mesh(n, groups && h->groups, h->quads);
  for (size_t b = 0; b < m->nblock; b++) {
    int dim = elem_dim(m->block[b].type);
    if ((dim == 0 && !h->points) || (dim == 1 && !h->lines)) m->block[b].n = 0;
  }
  for (size_t g = 0; g < m->ngroup; g++) {
    if (!h->names) free(m->group[g].name);
    if (!h->names) m->group[g].name = NULL;
    for (char *p = m->group[g].name; p && *p; p++)
      if (*p == ' ' && strcmp(h->name, "unv") == 0) *p = '_';
  }
  for (size_t e = 0; e < m->nentity; e++) {
    IntVec *p = &m->entity[e].physical;
    if (!h->several && p->len > 1) p->len = 1;
    for (size_t i = 0; i < p->len; i++)
      if (!h->several) p->data[i] = abs(p->data[i]);
    if (strcmp(h->name, "vtk") == 0 || strcmp(h->name, "vtu") == 0 || strcmp(h->name, "unv") == 0)
      for (size_t i = 0; i < p->len; i++) p->data[i] = abs(p->data[i]); // no signs
  }
  return m;
}

static void every_format_gives_back_what_it_holds(void **state)
{
  (void)state;
  for (size_t f = 0; f < ARRAY_LEN(holds); f++)
    for (int kind = 0; kind < 4; kind++) {
      const Holds *h = &holds[f];
      Mesh *m = reduced(3, h, kind & 1);
      OutOptions o = {.binary = kind & 2, .element_tag = kind & 1 ? 2 : 1};
      Mesh *back = round_trip(m, h->name, &o);
      MeshHash want = mesh_hash(m, false), got = mesh_hash(back, false);
      if (!h->exact || (strcmp(h->name, "stl") == 0 && o.binary)) {
        assert_int_equal(mesh_count(back, 2), mesh_count(m, 2));
      } else {
        assert_hash(got.shape, want.shape, h->name);
        if ((kind & 1) && h->groups) assert_hash(got.groups, want.groups, h->name);
        if ((kind & 1) && h->groups) assert_hash(got.full, want.full, h->name);
      }
      mesh_free(m);
      mesh_free(back);
    }
}

// Groups that are known by name alone: elements and sizes of each.
static void groups_by_name(void **state)
{
  (void)state;
  static const char *const formats[] = {"inp", "su2", "unv", "msh", "vtu"};
  for (size_t f = 0; f < ARRAY_LEN(formats); f++) {
    Mesh *m = sample_mesh(4, true, true), *back = round_trip(m, formats[f], &(OutOptions){.node_sets = 7});
    MeshStats a, b;
    mesh_stats_make(&a, m, NULL);
    mesh_stats_make(&b, back, NULL);
    size_t found = 0;
    for (size_t i = 0; i < a.group.len; i++) {
      const PartStats *x = &a.group.data[i];
      char name[100];
      snprintf(name, sizeof name, "%s", x->name ? x->name : "PhysicalLine4");
      for (char *p = name; *p; p++)
        if (*p == ' ' && f < 3) *p = '_';
      for (size_t j = 0; j < b.group.len; j++) {
        const PartStats *y = &b.group.data[j];
        if (y->dim != x->dim || strcmp(y->name ? y->name : "PhysicalLine4", name) != 0) continue;
        found++;
        assert_int_equal(x->elements, y->elements);
        assert_true(fabs(x->size - y->size) < 1e-14);
      }
    }
    assert_int_equal(found, strcmp(formats[f], "su2") == 0 ? 4 : f < 3 ? 7 : 8);
    mesh_stats_free(&a);
    mesh_stats_free(&b);
    mesh_free(m);
    mesh_free(back);
  }
}

// Elements of order 2 and more, where the format has them.
static void high_order(void **state)
{
  (void)state;
  static const struct { const char *format; ElemType types[8]; } cases[] = {
      {"vtk", {ELEM_LINE3, ELEM_LINE4, ELEM_TRI6, ELEM_TRI10, ELEM_TRI15, ELEM_QUAD8, ELEM_QUAD9, ELEM_QUAD16}},
      {"vtu", {ELEM_LINE3, ELEM_LINE5, ELEM_TRI6, ELEM_TRI10, ELEM_QUAD8, ELEM_QUAD9, ELEM_QUAD16, ELEM_QUAD25}},
      {"mesh", {ELEM_LINE3, ELEM_TRI6, ELEM_QUAD9}},
      {"inp", {ELEM_LINE3, ELEM_TRI6, ELEM_QUAD8, ELEM_QUAD9}},
      {"unv", {ELEM_LINE3, ELEM_TRI6, ELEM_QUAD8}},
      {"triangle", {ELEM_TRI6}},
  };
  for (size_t c = 0; c < ARRAY_LEN(cases); c++) {
    Rng rng = {5};
    Mesh *m = mesh_new();
    for (int dim = 1; dim < 3; dim++) mesh_add_entity(m, dim, dim);
    for (size_t k = 0; k < 8 && cases[c].types[k]; k++) {
      ElemType t = cases[c].types[k];
      uint32_t b = mesh_add_block(m, elem_dim(t) == 1 ? 0 : 1, t, 1);
      for (int i = 0; i < elem_nodes(t); i++)
        m->block[b].node[i] = mesh_add_node(m, (Vec3){rng_double(&rng), rng_double(&rng), 0}, m->block[b].entity, NAN);
    }
    for (int binary = 0; binary < 2; binary++) {
      Mesh *back = round_trip(m, cases[c].format, &(OutOptions){.binary = binary});
      assert_hash(mesh_hash(back, false).shape, mesh_hash(m, false).shape, cases[c].format);
      mesh_free(back);
    }
    mesh_free(m);
  }
}

static void what_cannot_be_said_is_refused(void **state)
{
  (void)state;
  static const char *const formats[] = {"su2", "triangle", "off", "stl", "unv", "mesh", "vtk", "inp"};
  Mesh *m = mesh_new();
  mesh_add_entity(m, 2, 1);
  uint32_t b = mesh_add_block(m, 0, ELEM_QUAD12, 1);
  for (int i = 0; i < 12; i++) m->block[b].node[i] = mesh_add_node(m, (Vec3){i, i * i, 1}, 0, NAN);
  for (size_t f = 0; f < ARRAY_LEN(formats); f++) {
    char path[300];
    Diag *d = diag_new(false);
    assert_int_equal(out_write(m, scratch(path, sizeof path, "x"), formats[f], &(OutOptions){0}, d), EXIT_INPUT);
    assert_int_equal(diag_errors(d), 1);
    assert_int_not_equal(access(path, F_OK), 0);
    diag_free(d);
  }
  mesh_free(m);
}

// Written meshes are valid when read back: also an audit of the readers.
static void read_meshes_pass_the_audit(void **state)
{
  (void)state;
  for (size_t f = 0; f + 1 < ARRAY_LEN(holds); f++) {
    Mesh *m = sample_mesh(4, true, holds[f].quads), *back = round_trip(m, holds[f].name, &(OutOptions){0});
    MeshReport r;
    bool good = mesh_check(back, false, &r);
    char line[300] = "";
    if (r.finding.len) mesh_finding_print(&r.finding.data[0], line, sizeof line);
    if (!good || (r.warnings && holds[f].names)) fail_msg("%s: %s", holds[f].name, line);
    mesh_report_free(&r);
    mesh_free(m);
    mesh_free(back);
  }
}

static void damaged_files_do_no_harm(void **state)
{
  (void)state;
  Rng rng = {1};
  for (size_t f = 0; f < ARRAY_LEN(holds); f++)
    for (int binary = 0; binary < 2; binary++) {
      const Holds *h = &holds[f];
      Mesh *m = reduced(2, h, true);
      char path[300];
      Diag *quiet = diag_new(false);
      scratch(path, sizeof path, extension(h->name));
      assert_int_equal(out_write(m, path, NULL, &(OutOptions){.binary = binary}, quiet), EXIT_GOOD);
      diag_free(quiet);
      size_t len;
      char *text = file_read(path, &len);
      for (int trial = 0; trial < 300; trial++) {
        size_t n = trial < 150 ? len * (size_t)trial / 150 : len;
        char *copy = mem_alloc(n + 1);
        memcpy(copy, text, n);
        copy[n] = 0;
        for (int k = 0; trial >= 150 && k < 1 + trial % 4; k++)
          copy[rng_below(&rng, (uint32_t)n)] = trial % 2 ? "0-9 \n,"[rng_below(&rng, 6)] : (char)rng_next(&rng);
        Diag *d = diag_new(false);
        Mesh *back;
        if (strcmp(h->name, "triangle") == 0) { // of three files, this one is damaged
          FILE *file = fopen(path, "wb");
          fwrite(copy, 1, n, file);
          fclose(file);
          back = out_read(path, NULL, 0, d, NULL);
        } else {
          back = out_read_memory(copy, n, "damaged", h->name, d);
        }
        assert_true(back || diag_errors(d) == 1);
        mesh_free(back);
        diag_free(d);
        free(copy);
      }
      free(text);
      mesh_free(m);
    }
}

static Mesh *read_text(const char *format, const char *text)
{
  Diag *d = diag_new(true);
  Mesh *m = out_read_memory(text, strlen(text), "a", format, d);
  assert_non_null(m);
  diag_free(d);
  return m;
}

// Files as other programs write them.
static void dialects(void **state)
{
  (void)state;
  Mesh *m = read_text("inp", "** comment\n*Node, NSET=Nall\n 1, 0.,0.\n 2,1.,0.\n 3,1.,1.,0.\n 4, 0.,1.0D0,0\n"
                             "*Element, TYPE=CPS3R, ELSET=\"All of it\"\n10,1,2,3\n11, 1,3,\n 4\n"
                             "*Elset, elset=some, generate\n10,11,1\n*ELSET,ELSET=one\n11\n*STEP\n*End Step\n");
  assert_int_equal(mesh_count(m, 2), 2);
  assert_int_equal(m->ngroup, 2);
  assert_int_equal(m->nentity, 2);
  mesh_free(m);
  m = read_text("mesh", "MeshVersionFormatted 1\nDimension 2\n# four\nVertices\n3\n0 0 1\n1 0 1\n0 1 2\nTriangles 1\n1 2 3 5\n"
                        "Corners\n1\n1\nEnd\n");
  assert_int_equal(mesh_count(m, 2), 1);
  assert_int_equal(m->entity[0].physical.data[0], 5);
  mesh_free(m);
  m = read_text("su2", "% comment\nNDIME = 2\nNELEM= 1\n5 0 1 2 0\nNPOIN= 3 3\n0 0 0\n1 0 1\n0 1 2\nNMARK= 1\nMARKER_TAG= wall % here\n"
                       "MARKER_ELEMS= 1\n3 0 1\n");
  assert_int_equal(mesh_count(m, 1), 1);
  assert_string_equal(m->group[0].name, "wall");
  mesh_free(m);
  m = read_text("vtk", "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0\n1 1 0 0 1 0\n"
                       "METADATA\nINFORMATION 0\n\nCELLS 3 6\nOFFSETS vtktypeint64\n0 3 6\nCONNECTIVITY vtktypeint64\n0 1 2\n0 2 3\n"
                       "CELL_TYPES 2\n5\n5\nCELL_DATA 2\nFIELD FieldData 1\ngmsh:physical 1 2 int\n4 5\nPOINT_DATA 4\nSCALARS f float\n"
                       "LOOKUP_TABLE default\n1 2 3 4\n");
  assert_int_equal(mesh_count(m, 2), 2);
  assert_int_equal(m->ngroup, 2);
  mesh_free(m);
  m = read_text("vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 0 1 0 0 1 1 0 0 1 0\nPOLYGONS 1 5\n4 0 1 2 3\n");
  assert_int_equal(mesh_count_corners(m, 4), 1);
  mesh_free(m);
  m = read_text("vtu", "<?xml version='1.0'?><VTKFile type='UnstructuredGrid' byte_order='LittleEndian'><UnstructuredGrid>"
                       "<Piece NumberOfPoints='3' NumberOfCells='1'><Points><DataArray type='Float32' NumberOfComponents='3' format='ascii'>"
                       "0 0 0 1 0 0 0 1 0</DataArray></Points><Cells><DataArray type='Int32' Name='connectivity' format='binary'>"
                       "DAAAAAAAAAABAAAAAgAAAA==</DataArray><DataArray type='Int32' Name='offsets' format='ascii'>3</DataArray>"
                       "<DataArray type='UInt8' Name='types' format='ascii'>5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>");
  assert_int_equal(mesh_count(m, 2), 1);
  assert_int_equal(m->block[0].node[2], 2);
  mesh_free(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_format_gives_back_what_it_holds),
      cmocka_unit_test(groups_by_name),
      cmocka_unit_test(high_order),
      cmocka_unit_test(what_cannot_be_said_is_refused),
      cmocka_unit_test(read_meshes_pass_the_audit),
      cmocka_unit_test(dialects),
      cmocka_unit_test(damaged_files_do_no_harm),
  };
  return unit_run(tests);
}
