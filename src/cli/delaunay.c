// delaunay.c - meshgen -delaunay: triangulate points and segments from a file
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/delaunay.h"

#include <math.h>

#include "base/json.h"
#include "base/stats.h"
#include "mesh/mesh.h"
#include "out/formats.h"
#include "out/points_read.h"
#include "out/polygons.h"
#include "tri/tri.h"

typedef struct {
  const Cli *cli;
  Diag *diag;
  PointsFile file;
  Tri tri;
  uint32_t *vertex_of;   // of each point of the file
  size_t duplicates, points;
  double cpu, wall;      // of the triangulation alone
  uint32_t triangles;
} Delaunay;

static ExitCode report_crossings(Delaunay *d, const TriSegEvents *ev)
{
  for (size_t i = 0; i < ev->len; i++) {
    const TriSegEvent *e = &ev->data[i];
    if (e->what == TRI_SEG_CROSSES)
      diag_error(d->diag, NO_LOC, "%s: segments %u and %u (counted from 1) cross at (%.17g, %.17g)", d->cli->inputs.data[0],
                 e->a + 1, e->b + 1, e->p[0], e->p[1]);
  }
  return EXIT_INPUT;
}

static ExitCode insert_segments(Delaunay *d)
{
  PointsFile *f = &d->file;
  for (size_t i = 0; i < f->ends.len; i++) f->ends.data[i] = d->vertex_of[f->ends.data[i]];
  TriSegEvents ev = {0};
  size_t crossings = tri_insert_segments(&d->tri, f->ends.data, NULL, f->ends.len / 2, &ev);
  ExitCode status = crossings ? report_crossings(d, &ev) : EXIT_GOOD;
  vec_free(&ev);
  return status;
}

static ExitCode triangulate(Delaunay *d)
{
  PointsFile *f = &d->file;
  size_t n = d->points = f->xy.len / 2;
  double cpu = time_cpu(), wall = time_wall();
  d->vertex_of = mem_alloc(n * sizeof *d->vertex_of);
  TriBuild how = {.reorder = true, .take = true, .threads = d->cli->options.General_NumThreads,
                  .incremental = d->cli->insertion, .vertex_of = d->vertex_of};
  TriBuildResult r = tri_build(&d->tri, f->xy.data, n, &how);
  f->xy.data = NULL;
  f->xy.len = f->xy.cap = 0;
  if (r != TRI_BUILD_GOOD) {
    diag_error(d->diag, NO_LOC, "%s: %s", d->cli->inputs.data[0],
               r == TRI_BUILD_TOO_MANY ? "there are too many points" : "a coordinate is not finite");
    return EXIT_INPUT;
  }
  d->duplicates = n - d->tri.nv;
  ExitCode status = f->ends.len ? insert_segments(d) : EXIT_GOOD;
  TriCarve carve = {.concavities = f->ends.len == 0, .holes = f->holes.data, .nholes = f->holes.len / 2,
                    .regions = f->regions.data, .labels = f->labels.data, .nregions = f->labels.len};
  d->triangles = tri_carve(&d->tri, &carve);
  d->cpu = time_cpu() - cpu;
  d->wall = time_wall() - wall;
  if (d->duplicates)
    diag_warning(d->diag, NO_LOC, "%s: %zu points are equal to earlier ones and were left out", d->cli->inputs.data[0],
                 d->duplicates);
  return status;
}

// ---- the mesh -----------------------------------------------------------------------------------------------------------

// Vertices become nodes in the order of the file.
static uint32_t *add_nodes(Delaunay *d, Mesh *m, uint32_t entity)
{
  uint32_t *node = mem_alloc(d->tri.nv * sizeof *node);
  for (VertId v = 0; v < d->tri.nv; v++) node[v] = NONE;
  for (size_t i = 0; i < d->points; i++) {
    VertId v = d->vertex_of[i];
    if (node[v] != NONE) continue;
    const double *p = tri_xy(&d->tri, v);
    node[v] = mesh_add_node(m, (Vec3){p[0], p[1], d->file.z.len ? d->file.z.data[i] : 0}, entity, NAN);
  }
  return node;
}

static void set_box(Mesh *m)
{
  Box3 b = box3_empty();
  for (uint32_t k = 0; k < m->nnode; k++) b = box3_with(b, mesh_xyz(m, k));
  for (size_t i = 0; i < m->nentity; i++) m->entity[i].lo = b.lo, m->entity[i].hi = b.hi;
}

static uint32_t label_of(const Tri *t, TriId k) { return t->region ? t->region[k] : 0; }

static int compare_labels(const void *a, const void *b)
{
  uint32_t x, y;
  memcpy(&x, a, sizeof x);
  memcpy(&y, b, sizeof y);
  return (x > y) - (x < y);
}

static uint32_t *new_block(Mesh *m, uint32_t entity, ElemType type, size_t n)
{
  uint32_t k = mesh_add_block(m, entity, type, n);
  return m->block[k].node;
}

// Sort and drop repeated ones.
static void make_unique(U32Vec *v)
{
  if (v->len) qsort(v->data, v->len, sizeof *v->data, compare_labels);
  size_t n = 0;
  for (size_t i = 0; i < v->len; i++)
    if (n == 0 || v->data[n - 1] != v->data[i]) v->data[n++] = v->data[i];
  v->len = n;
}

// The labels in use, ascending; 0, for what has none, comes last.
static void collect_labels(const Delaunay *d, U32Vec *labels)
{
  for (size_t i = 0; i < d->file.labels.len; i++) vec_push(labels, d->file.labels.data[i]);
  make_unique(labels);
  bool unlabelled = labels->len == 0;
  for (TriId k = 0; k < d->tri.nt && !unlabelled; k++) unlabelled = tri_is_inside(&d->tri, k) && label_of(&d->tri, k) == 0;
  if (unlabelled) vec_push(labels, 0);
}

// The boundary marks in use, likewise.
static void collect_marks(const Delaunay *d, U32Vec *marks)
{
  const Tri *t = &d->tri;
  for (EdgeId e = 0; e < 3 * t->nt; e++)
    if (tri_is_segment(t, e) && e < t->twin[e]) vec_push(marks, d->file.marks.data[t->seg[e]]);
  make_unique(marks);
  if (marks->len == 0 || marks->data[0] != 0) return;
  memmove(marks->data, marks->data + 1, (marks->len - 1) * sizeof *marks->data);
  marks->data[marks->len - 1] = 0;
}

// An entity for each label, numbered by it; what has none gets the next number. Returns the first.
static uint32_t add_entities(Mesh *m, int dim, const U32Vec *labels)
{
  uint32_t first = NONE;
  for (size_t i = 0; i < labels->len; i++) {
    uint32_t tag = labels->data[i] ? labels->data[i] : i > 0 ? labels->data[i - 1] + 1 : 1;
    uint32_t entity = mesh_add_entity(m, dim, (int)tag);
    if (i == 0) first = entity;
  }
  return first;
}

static void add_segments(const Delaunay *d, Mesh *m, uint32_t entity, uint32_t mark, const uint32_t *node)
{
  const Tri *t = &d->tri;
  size_t n = 0;
  for (int pass = 0; pass < 2; pass++) {
    uint32_t *to = pass ? new_block(m, entity, ELEM_LINE2, n) : NULL;
    for (EdgeId e = 0; e < 3 * t->nt; e++) {
      if (!tri_is_segment(t, e) || e > t->twin[e] || d->file.marks.data[t->seg[e]] != mark) continue;
      if (!pass) n++;
      else *to++ = node[tri_org(t, e)], *to++ = node[tri_dest(t, e)];
    }
  }
}

static void add_triangles(const Delaunay *d, Mesh *m, uint32_t entity, uint32_t label, const uint32_t *node)
{
  const Tri *t = &d->tri;
  size_t n = 0;
  for (TriId k = 0; k < t->nt; k++) n += tri_is_inside(t, k) && label_of(t, k) == label;
  if (n == 0) return;
  uint32_t *to = new_block(m, entity, ELEM_TRI3, n);
  for (TriId k = 0; k < t->nt; k++)
    if (tri_is_inside(t, k) && label_of(t, k) == label)
      for (uint32_t i = 0; i < 3; i++) *to++ = node[t->vert[3 * (size_t)k + i]];
}

static Mesh *mesh_of_triangles(Delaunay *d)
{
  Mesh *m = mesh_new();
  U32Vec labels = {0}, marks = {0};
  collect_marks(d, &marks);
  collect_labels(d, &labels);
  uint32_t curve = add_entities(m, 1, &marks), face = add_entities(m, 2, &labels);
  uint32_t *node = add_nodes(d, m, face);
  for (size_t i = 0; i < marks.len; i++) add_segments(d, m, curve + (uint32_t)i, marks.data[i], node);
  for (size_t i = 0; i < labels.len; i++) add_triangles(d, m, face + (uint32_t)i, labels.data[i], node);
  set_box(m);
  free(node);
  vec_free(&labels);
  vec_free(&marks);
  return m;
}

// ---- the cells ----------------------------------------------------------------------------------------------------------

// The rectangle that the cells fill: the box of the points with a tenth of its diagonal around it. False if numbers overflow.
static bool frame_of(const Tri *t, double lo[2], double hi[2])
{
  lo[0] = lo[1] = INFINITY, hi[0] = hi[1] = -INFINITY;
  for (size_t i = 0; i < 2 * (size_t)t->nv; i++) {
    lo[i % 2] = fmin(lo[i % 2], t->xy[i]);
    hi[i % 2] = fmax(hi[i % 2], t->xy[i]);
  }
  double margin = 0.1 * hypot(hi[0] - lo[0], hi[1] - lo[1]);
  if (margin == 0) margin = fmax(1, 0.1 * fmax(fabs(lo[0]), fabs(lo[1]))); // one point
  for (int k = 0; k < 2; k++) lo[k] -= margin, hi[k] += margin;
  return isfinite((hi[0] - lo[0]) * (hi[0] - lo[0]) + (hi[1] - lo[1]) * (hi[1] - lo[1]));
}

// The sides of the cells as lines, for formats without polygons. Each inner side has two cells; the one that runs up takes it.
static Mesh *mesh_of_sides(const Tri *t, const TriVoronoi *v)
{
  Mesh *m = mesh_new();
  uint32_t entity = mesh_add_entity(m, 1, 1);
  for (size_t i = 0; i < v->nnode; i++) mesh_add_node(m, (Vec3){v->xy[2 * i], v->xy[2 * i + 1], 0}, entity, NAN);
  const double *lo = v->xy + 6, *hi = v->xy + 2; // corners 3 and 1
  U32Vec line = {0};
  for (VertId k = 0; k < t->nv; k++)
    for (uint32_t i = v->start[k]; i < v->start[k + 1]; i++) {
      uint32_t a = v->corners[i], b = v->corners[i + 1 < v->start[k + 1] ? i + 1 : v->start[k]];
      const double *p = v->xy + 2 * (size_t)a, *q = v->xy + 2 * (size_t)b;
      bool on_frame = (p[0] == q[0] && (p[0] == lo[0] || p[0] == hi[0])) || (p[1] == q[1] && (p[1] == lo[1] || p[1] == hi[1]));
      if (a > b && !on_frame) continue;
      vec_push(&line, a);
      vec_push(&line, b);
    }
  if (line.len) memcpy(new_block(m, entity, ELEM_LINE2, line.len / 2), line.data, line.len * sizeof *line.data);
  set_box(m);
  vec_free(&line);
  return m;
}

// ---- output ---------------------------------------------------------------------------------------------------------------

// What is written: a mesh, and the cells if they were asked for, for the formats that hold polygons.
typedef struct {
  Mesh *mesh;
  Polygons cells; // xy is NULL when there are none
} Product;

static ExitCode write_output(Delaunay *d, const Product *what, const char *path)
{
  const Options *opt = &d->cli->options;
  OutOptions o = {.save_all = true, .binary = opt->Mesh_Binary, .threads = opt->General_NumThreads};
  const char *name = d->cli->format;
  if (!name || strcmp(name, "auto") == 0) {
    const Format *f = format_of_path(path);
    name = f ? format_name(f) : "msh";
  }
  if (what->cells.xy && polygons_format(name)) return polygons_write(&what->cells, path, name, d->diag);
  if (strcmp(name, "msh") == 0 || strcmp(name, "msh4") == 0) name = opt->Mesh_MshFileVersion >= 3 ? "msh4" : "msh2";
  return out_write(what->mesh, path, name, &o, d->diag);
}

static ExitCode write_outputs(Delaunay *d, const Product *what)
{
  const Cli *c = d->cli;
  ExitCode status = EXIT_GOOD;
  for (size_t i = 0; i < c->outputs.len && status == EXIT_GOOD; i++) status = write_output(d, what, c->outputs.data[i]);
  if (c->outputs.len == 0) {
    const char *in = c->inputs.data[0], *slash = strrchr(in, '/'), *dot = strrchr(slash ? slash : in, '.');
    size_t n = dot ? (size_t)(dot - in) : strlen(in);
    char *path = mem_alloc(n + 5);
    memcpy(path, in, n);
    memcpy(path + n, ".msh", 5);
    status = write_output(d, what, path);
    free(path);
  }
  return status;
}

static ExitCode write_triangles(Delaunay *d)
{
  Product what = {.mesh = mesh_of_triangles(d)};
  ExitCode status = write_outputs(d, &what);
  mesh_free(what.mesh);
  return status;
}

// Cells bear the number of their point in the file, from 1.
static ExitCode write_cells(Delaunay *d)
{
  double lo[2], hi[2];
  if (!frame_of(&d->tri, lo, hi)) {
    diag_error(d->diag, NO_LOC, "%s: the coordinates are too large for Voronoi cells", d->cli->inputs.data[0]);
    return EXIT_INPUT;
  }
  TriVoronoi v;
  tri_voronoi(&d->tri, lo, hi, &v);
  uint32_t *id = mem_alloc(d->tri.nv * sizeof *id);
  for (size_t i = d->points; i-- > 0;) id[d->vertex_of[i]] = (uint32_t)i + 1;
  Product what = {mesh_of_sides(&d->tri, &v),
                  {.xy = v.xy, .nnode = v.nnode, .start = v.start, .corner = v.corners, .id = id, .ncell = d->tri.nv}};
  ExitCode status = write_outputs(d, &what);
  mesh_free(what.mesh);
  free(id);
  tri_voronoi_free(&v);
  return status;
}

static void report(const Delaunay *d)
{
  const Tri *t = &d->tri;
  double steps = t->walks ? (double)t->walk_steps / (double)t->walks : 0;
  double cavity = t->walks ? (double)t->cavity_triangles / (double)t->walks : 0;
  if (d->cli->json) {
    Json j = {0};
    json_begin(&j, NULL, '{');
    json_begin(&j, "delaunay", '{');
    json_integer(&j, "points", (long long)d->points);
    json_integer(&j, "duplicates", (long long)d->duplicates);
    json_integer(&j, "triangles", d->triangles);
    json_number(&j, "walk_steps", steps);
    json_number(&j, "cavity", cavity);
    json_integer(&j, "insertions", (long long)t->walks);
    json_integer(&j, "merge_triangles", (long long)t->merge_triangles);
    json_integer(&j, "merge_flips", (long long)t->merge_flips);
    json_integer(&j, "orient_filter_misses", (long long)t->count.orient_slow);
    json_integer(&j, "incircle_filter_misses", (long long)t->count.incircle_slow);
    json_integer(&j, "multiprecision", (long long)t->count.multiprecision);
    json_integer(&j, "ties", (long long)t->count.ties);
    json_number(&j, "cpu_seconds", d->cpu);
    json_number(&j, "wall_seconds", d->wall);
    json_integer(&j, "peak_bytes", (long long)mem_peak());
    json_end(&j, '}');
    json_end(&j, '}');
    printf("%s\n", str_text(&j.out));
    str_free(&j.out);
  } else if (d->cli->report)
    printf("%zu points, %u triangles in %.3g s (%.3g s of processor time)\n"
           "merging: %llu triangles made, %llu flipped; %llu insertions: %.2f walk steps, %.2f triangles a cavity\n"
           "filters missed: %llu orientations, %llu circles, %llu to MPFR; ties: %llu\n",
           d->points, d->triangles, d->wall, d->cpu, (unsigned long long)t->merge_triangles,
           (unsigned long long)t->merge_flips, (unsigned long long)t->walks, steps, cavity,
           (unsigned long long)t->count.orient_slow,
           (unsigned long long)t->count.incircle_slow, (unsigned long long)t->count.multiprecision,
           (unsigned long long)t->count.ties);
}

ExitCode delaunay_run(const Cli *c, Diag *diag)
{
  Delaunay d = {.cli = c, .diag = diag};
  if (c->inputs.len != 1) {
    diag_error(diag, NO_LOC, "-delaunay takes one file of points");
    return EXIT_USAGE;
  }
  tri_init(&d.tri);
  ExitCode status = points_read(c->inputs.data[0], &d.file, diag);
  if (status == EXIT_GOOD) status = triangulate(&d);
  if (status == EXIT_GOOD) status = c->voronoi ? write_cells(&d) : write_triangles(&d);
  if (status == EXIT_GOOD) report(&d);
  free(d.vertex_of);
  tri_free(&d.tri);
  points_free(&d.file);
  return status;
}
