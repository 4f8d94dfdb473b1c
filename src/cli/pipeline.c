// pipeline.c - from an input file to its outputs: script, model, curves, faces, audit, files, report
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/pipeline.h"

#include <errno.h>
#include <math.h>

#include "base/file.h"
#include "base/str.h"
#include "cli/batch.h"
#include "cli/output.h"
#include "cli/report.h"
#include "mesh/boundary_layer.h"
#include "mesh/high_order.h"
#include "mesh/mesh2d.h"
#include "mesh/mesh2d_estimate.h"
#include "mesh/mesh2d_joint.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_join.h"
#include "mesh/mesh_stats.h"
#include "mesh/partition.h"
#include "mesh/periodic.h"
#include "mesh/subdivide.h"
#include "model/model_edit.h"
#include "out/formats.h"

// ---- meshing ----------------------------------------------------------------------------------------------------------
static void drop_mesh(Job *j)
{
  mesh_free(j->mesh);
  j->mesh = NULL;
  free(j->node_size);
  j->node_size = NULL;
  mesh1d_free(j->curves);
  j->curves = NULL;
  j->mesh_dim = -1;
}

// Divide the mesh in n parts, or take its partition away; false after an error.
static bool partition(Job *j, int n)
{
  stage_begin(&j->stats, "partition");
  bool good = mesh_partition(j->mesh, n, &j->options, j->diag);
  stage_end(&j->stats);
  return good;
}

// The mesh of the job becomes another one, in as many parts; sizes at its nodes are no longer known.
static void replace_mesh(Job *j, Mesh *mesh)
{
  uint32_t parts = j->mesh->nparts;
  mesh_free(j->mesh);
  j->mesh = mesh;
  free(j->node_size);
  j->node_size = NULL;
  if (parts && !mesh->nparts) partition(j, (int)parts);
}

// Curves must be there to place nodes on them.
static void make_curves_ready(Job *j)
{
  if (model_needs_prepare(j->model)) model_prepare(j->model, j->options.Geometry_Tolerance, j->diag);
}

static void set_order(Job *j, int order)
{
  make_curves_ready(j);
  HighOrder how = {.order = order, .incomplete = j->options.Mesh_SecondOrderIncomplete, .linear = j->options.Mesh_SecondOrderLinear};
  HighOrderReport r;
  stage_begin(&j->stats, "high order");
  replace_mesh(j, mesh_set_order(j->mesh, &how, j->model, &r, j->diag));
  stage_end(&j->stats);
  if (order > 1)
    log_info(j->diag, "order %d: %zu curved edges, %zu elements unfolded, least Jacobian %.3g", order, r.curved, r.folded,
             r.min_jacobian);
}

static void subdivide(Job *j, Subdivision how)
{
  make_curves_ready(j);
  stage_begin(&j->stats, "subdivide");
  replace_mesh(j, mesh_subdivide(j->mesh, how, j->options.Mesh_SecondOrderLinear ? NULL : j->model, j->diag));
  stage_end(&j->stats);
}

// What follows the meshing of the faces: pairs of periodic nodes, subdivision, order.
static void finish_mesh(Job *j, int dim)
{
  if (dim >= 1) periodic_add(j->mesh, j->model, j->diag);
  if (dim >= 2 && j->options.Mesh_SubdivisionAlgorithm == 1) subdivide(j, SUBDIVIDE_QUADS);
  if (dim >= 2 && j->options.Mesh_SubdivisionAlgorithm == 3) subdivide(j, SUBDIVIDE_BARYCENTRIC);
  if (dim >= 1 && j->options.Mesh_ElementOrder > 1) set_order(j, j->options.Mesh_ElementOrder);
}

// The estimate before meshing knows nothing of what is refined for angles.
static bool few_enough(const Job *j, const FaceMesh *face, size_t n)
{
  double total = 0;
  for (size_t k = 0; k < n; k++) total += (double)(face[k].ntri + face[k].nquad);
  if (total <= j->options.Mesh_MaxElements || j->cli->keep_going) return true;
  diag_error(j->diag, NO_LOC, "the surfaces have %.0f elements, more than Mesh.MaxElements = %g (-max_elements)", total,
             j->options.Mesh_MaxElements);
  return false;
}

// With -keep_going faces grow until they meet the limit, each on its own.
static void mesh_faces(Job *j, const SizeField *size, EdgeNodes *en, const BoundaryLayers *layers)
{
  size_t n = model_faces(j->model);
  FaceMesh *face = mem_zalloc(n * sizeof *face);
  Mesh2dInput in = {.model = j->model, .options = &j->options, .size = size, .curves = j->curves, .layers = layers,
                    .diag = j->diag, .threads = j->threads};
  stage_begin(&j->stats, "estimate");
  bool affordable = j->cli->keep_going || mesh2d_is_affordable(&in);
  stage_end(&j->stats);
  if (!affordable) {
    free(face);
    return;
  }
  bool joint = j->options.Mesh_MinimumAngle > 0 || j->options.Mesh_ConformingDelaunay;
  stage_begin(&j->stats, "mesh 2D");
  j->failed_faces = joint ? mesh2d_joint_run(&in, j->curves, en, face) : mesh2d_run(&in, en, face);
  stage_end(&j->stats);
  for (size_t k = 0; k < n; k++) j->matching_seconds += face[k].matching_seconds;
  if ((!j->failed_faces || j->cli->keep_going) && few_enough(j, face, n)) {
    stage_begin(&j->stats, "assemble");
    j->mesh = mesh_assemble(j->model, j->curves, en, face, &j->options);
    j->node_size = mesh_assemble_sizes(j->model, j->curves, en, face);
    stage_end(&j->stats);
  }
  for (size_t k = 0; k < n; k++) face_mesh_free(&face[k]);
  free(face);
}

// Mesh up to a dimension; false after an error that leaves no mesh.
static bool generate(Job *j, int dim)
{
  drop_mesh(j);
  j->reshaped = false;
  stage_begin(&j->stats, "model");
  if (j->options.Mesh_Heal) model_coherence(j->model, j->diag); // duplicates of points leave loops open otherwise
  bool good = model_prepare(j->model, j->options.Geometry_Tolerance, j->diag);
  stage_end(&j->stats);
  if (!good) return false;
  if (dim == 3) log_info(j->diag, "volumes are not meshed: meshing points, curves and surfaces only");
  SizeField *size;
  stage_begin(&j->stats, "mesh 1D");
  j->curves = mesh1d_heal(j->model, &j->options, j->fields, &size, j->diag);
  if (j->curves && dim >= 2) mesh1d_limit_faces(j->curves, size);
  stage_end(&j->stats);
  if (j->curves && j->curves->rounds)
    log_info(j->diag, "edges on curves crossed: %u of them halved in %u rounds, none crosses now", j->curves->nsplit, j->curves->rounds);
  if (j->curves) {
    EdgeNodes en;
    BoundaryLayers *layers = dim >= 2 ? boundary_layers_new(j->model, j->fields, &j->options, j->curves, j->diag) : NULL;
    edge_nodes_init(&en, j->model, j->curves);
    if (dim >= 2)
      mesh_faces(j, size, &en, layers);
    else
      j->mesh = mesh_assemble(j->model, dim >= 1 ? j->curves : NULL, &en, NULL, &j->options);
    edge_nodes_free(&en);
    boundary_layers_free(layers);
  }
  size_free(size);
  if (j->mesh) j->mesh_dim = MIN(dim, 2);
  if (j->mesh) finish_mesh(j, dim);
  return j->mesh != NULL;
}

// ---- what a script may ask for in the middle ------------------------------------------------------------------------
// Split every element, whatever the order of the mesh, which stays.
static void split_elements(Job *j, Subdivision how)
{
  int order = 1;
  for (size_t i = 0; i < j->mesh->nblock; i++) order = MAX(order, elem_order(j->mesh->block[i].type));
  if (order > 1) set_order(j, 1);
  subdivide(j, how);
  if (order > 1) set_order(j, order);
}

// RecombineMesh: the faces are meshed once more, to be recombined.
static bool recombine(Job *j)
{
  int all = j->options.Mesh_RecombineAll;
  j->options.Mesh_RecombineAll = 1;
  bool good = generate(j, j->mesh_dim);
  j->options.Mesh_RecombineAll = all;
  j->reshaped = true;
  return good;
}

static bool host_mesh(void *ctx, MeshCommand what, double number, const char *text, SrcLoc loc)
{
  Job *j = ctx;
  (void)text;
  switch (what) {
  case MESH_GENERATE: return generate(j, number < 1 ? 0 : number < 2 ? 1 : number < 3 ? 2 : 3);
  case MESH_DELETE: drop_mesh(j); return true;
  case MESH_RENUMBER_NODES:
  case MESH_RENUMBER_ELEMENTS: return true; // always numbered consecutively
  case MESH_OPTIMIZE: return true;          // every mesh is optimized as it is made
  case MESH_REFINE:
  case MESH_BARYCENTRIC:
  case MESH_RECOMBINE:
  case MESH_SET_ORDER:
  case MESH_PARTITION: break;
  }
  if (!j->mesh) {
    diag_warning(j->diag, loc, "there is no mesh yet, so nothing is done: say Mesh 2; before");
    return true;
  }
  if (what == MESH_RECOMBINE) return recombine(j);
  j->reshaped = true;
  if (what == MESH_SET_ORDER) {
    if (number >= 1 && number < HIGH_ORDER_MAX + 1) return set_order(j, (int)number), true;
    diag_error(j->diag, loc, "SetOrder: the order must be 1 to %d", HIGH_ORDER_MAX);
    return false;
  }
  if (what == MESH_REFINE || what == MESH_BARYCENTRIC) {
    split_elements(j, what == MESH_REFINE ? SUBDIVIDE_HALVE : SUBDIVIDE_BARYCENTRIC);
    return true;
  }
  if (number >= 0 && number <= INT32_MAX) return partition(j, (int)number);
  diag_error(j->diag, loc, "PartitionMesh: the number of parts must be 0 or more, not %g", number);
  return false;
}

static bool host_save(void *ctx, const char *path, SrcLoc loc)
{
  Job *j = ctx;
  if (!j->mesh) {
    diag_warning(j->diag, loc, "Save: there is no mesh yet, so nothing is written: say Mesh 2; before");
    return true;
  }
  const Format *f = format_of_path(path);
  return output_mesh(j, path, f ? format_name(f) : "msh") == EXIT_GOOD;
}

static void host_print(void *ctx, const char *text)
{
  Job *j = ctx;
  if (diag_level(j->diag) >= LOG_PRINTF) fprintf(j->out, "%s\n", text);
}

// Surface elements of so many corners.
static size_t count_corners(const Mesh *m, int corners)
{
  size_t n = 0;
  for (size_t b = 0; b < m->nblock; b++)
    if (elem_corners(m->block[b].type) == corners && elem_dim(m->block[b].type) == 2) n += m->block[b].n;
  return n;
}

// Least, mean and largest quality: gamma of triangles, eta of quadrangles.
static void qualities(const Mesh *m, double to[3])
{
  MeshStats s;
  mesh_stats_make(&s, m, NULL);
  size_t n = s.gamma.n + s.eta.n;
  to[0] = !s.gamma.n ? s.eta.min : !s.eta.n ? s.gamma.min : fmin(s.gamma.min, s.eta.min);
  to[1] = n ? (s.gamma.mean * (double)s.gamma.n + s.eta.mean * (double)s.eta.n) / (double)n : 0;
  to[2] = fmax(s.gamma.n ? s.gamma.max : 0, s.eta.n ? s.eta.max : 0);
  mesh_stats_free(&s);
}

static bool host_statistic(void *ctx, const char *key, double *value)
{
  Job *j = ctx;
  static const char *const quality[] = {"MinQuality", "AvgQuality", "MaxQuality"};
  if (!j->mesh) return false;
  if (strcmp(key, "NbNodes") == 0)
    *value = (double)j->mesh->nnode;
  else if (strcmp(key, "NbTriangles") == 0)
    *value = (double)count_corners(j->mesh, 3);
  else if (strcmp(key, "NbQuadrangles") == 0)
    *value = (double)count_corners(j->mesh, 4);
  else if (strcmp(key, "CpuTime") == 0)
    *value = time_cpu();
  else {
    size_t i = 0;
    while (i < ARRAY_LEN(quality) && strcmp(key, quality[i]) != 0) i++;
    if (i == ARRAY_LEN(quality)) return false;
    double q[3];
    qualities(j->mesh, q);
    *value = q[i];
  }
  return true;
}

static bool host_system(void *ctx, const char *command, SrcLoc loc)
{
  Job *j = ctx;
  fflush(j->out);
  if (system(command) == 0) return true;
  diag_warning(j->diag, loc, "the command failed: %s", command);
  return true;
}

// ---- one input --------------------------------------------------------------------------------------------------------
static void job_init(Job *j, const Cli *c, const char *input, Diag *diag, int threads)
{
  *j = (Job){.cli = c, .input = input, .diag = diag, .mesh_dim = -1, .threads = threads};
  options_copy(&j->options, &c->options);
  options_set_string(&j->options, options_find("General", "FileName"), input, NO_LOC, diag);
  j->model = model_new();
  j->fields = fields_new();
  j->host = (ScriptHost){.ctx = j, .mesh = host_mesh, .save = host_save, .print = host_print, .statistic = host_statistic,
                         .system = c->allow_system ? host_system : NULL};
  j->script = script_new(j->model, &j->options, j->fields, diag, &j->host);
}

static void job_free(Job *j)
{
  drop_mesh(j);
  script_free(j->script);
  fields_free(j->fields);
  model_free(j->model);
  options_free(&j->options);
}

static ExitCode run_script_file(Job *j, const char *path)
{
  switch (script_run_file(j->script, path)) {
  case SCRIPT_DONE: break;
  case SCRIPT_EXIT: j->ended = true; break;
  case SCRIPT_NO_FILE:
    diag_error(j->diag, NO_LOC, "%s: %s", path, strerror(errno));
    return EXIT_ENVIRONMENT;
  }
  return diag_errors(j->diag) ? EXIT_INPUT : EXIT_GOOD;
}

static ExitCode apply_settings(Job *j)
{
  ExitCode status = EXIT_GOOD;
  for (size_t i = 0; i < j->cli->settings.len && status == EXIT_GOOD; i++) {
    const Setting *s = &j->cli->settings.data[i];
    bool good = true;
    switch (s->kind) {
    case SETTING_NUMBER: good = script_set_number(j->script, s->name, s->value[0]); break;
    case SETTING_STRING: good = script_set_string(j->script, s->name, s->text); break;
    case SETTING_LIST: good = script_set_list(j->script, s->name, s->value, s->n); break;
    case SETTING_TEXT: script_run_text(j->script, "-string", s->text, strlen(s->text)); break;
    case SETTING_FILE: status = run_script_file(j, s->text); break;
    }
    if (status == EXIT_GOOD && (!good || diag_errors(j->diag))) status = EXIT_INPUT;
  }
  script_forget_variables(j->script);
  return status;
}

static bool is_mesh_file(const char *path)
{
  const Format *f = format_of_path(path);
  return f && format_reads(f) && strcmp(path, "-") != 0;
}

// Audit what this program made. What is wrong is an error, or with -keep_going a warning.
static bool audit(Job *j)
{
  MeshReport report = {0};
  stage_begin(&j->stats, "audit");
  bool good = mesh_check(j->mesh, true, &report);
  stage_end(&j->stats);
  enum { SHOWN = 5 };
  size_t shown = 0;
  for (size_t i = 0; i < report.finding.len && shown < SHOWN; i++) {
    const MeshFinding *f = &report.finding.data[i];
    if (f->warning) continue;
    char text[400];
    mesh_finding_print(f, text, sizeof text);
    if (j->cli->keep_going)
      diag_warning(j->diag, NO_LOC, "audit: %s", text);
    else
      diag_error(j->diag, NO_LOC, "audit: %s", text);
    shown++;
  }
  if (report.errors > shown) diag_note(j->diag, NO_LOC, "and %zu more", report.errors - shown);
  mesh_report_free(&report);
  return good;
}

// Write what was asked for, then report: on standard output, unless a mesh goes there.
static ExitCode write_and_report(Job *j, bool wanted)
{
  OutOptions o = output_options(j);
  bool to_stdout = false;
  for (size_t i = 0; i < j->cli->outputs.len; i++) to_stdout = to_stdout || strcmp(j->cli->outputs.data[i], "-") == 0;
  out_warn_dropped(j->mesh, &o, j->diag);
  ExitCode status = output_all(j);
  if (status == EXIT_GOOD && wanted)
    status = report_print(j, j->node_size, to_stdout ? stderr : j->out);
  else if (j->summary)
    *j->summary = (JobSummary){true, j->mesh->nnode, mesh_count(j->mesh, 1), count_corners(j->mesh, 3), count_corners(j->mesh, 4), NAN};
  return status;
}

// -part and Mesh.NbPartitions; without them what a script or a file has divided stays so.
static bool partition_if_asked(Job *j)
{
  return j->options.Mesh_NbPartitions < 1 || partition(j, j->options.Mesh_NbPartitions);
}

static ExitCode finish(Job *j)
{
  if (!j->mesh->nnode) diag_warning(j->diag, NO_LOC, "%s: there is nothing to mesh: the mesh is empty", j->input);
  bool good = j->mesh_dim < 0 || audit(j);
  if (!good && !j->cli->keep_going) return EXIT_INPUT;
  if (!partition_if_asked(j)) return EXIT_INPUT;
  ExitCode status = write_and_report(j, true);
  if (status == EXIT_GOOD && (!good || j->failed_faces)) status = EXIT_PARTIAL;
  return status;
}

// -explain_size x,y: on standard output.
static ExitCode explain_size(Job *j)
{
  double x, y;
  char rest;
  if (sscanf(j->cli->explain, "%lf,%lf%c", &x, &y, &rest) != 2) {
    diag_error(j->diag, NO_LOC, "-explain_size needs two numbers: x,y");
    return EXIT_USAGE;
  }
  if (j->options.Mesh_Heal) model_coherence(j->model, j->diag);
  if (!model_prepare(j->model, j->options.Geometry_Tolerance, j->diag)) return EXIT_INPUT;
  SizeField *size = size_new(j->model, &j->options, j->fields, j->diag);
  if (!size) return EXIT_INPUT;
  SizeEval *e = size_eval_new(size);
  Str text = {0};
  size_explain(e, size_face_at(j->model, (Vec3){x, y, 0}), (Vec3){x, y, 0}, &text);
  fputs(str_text(&text), j->out);
  ExitCode status = size_eval_report(e, j->diag) ? EXIT_INPUT : EXIT_GOOD;
  str_free(&text);
  size_eval_free(e);
  size_free(size);
  return status;
}

static int action_dim(CommandId action) { return action == CMD_MESH1 ? 1 : action == CMD_MESH3 ? 3 : 2; }

static void split_if_asked(Job *j)
{
  if (j->cli->action == CMD_REFINE) split_elements(j, SUBDIVIDE_HALVE);
  if (j->cli->action == CMD_BARYCENTRIC) split_elements(j, SUBDIVIDE_BARYCENTRIC);
}

// -dump_ast: the text is parsed, and not run.
static ExitCode dump_tree(Job *j)
{
  size_t len;
  char *text = file_read(j->input, &len);
  if (!text) {
    diag_error(j->diag, NO_LOC, "%s: %s", j->input, strerror(errno));
    return EXIT_ENVIRONMENT;
  }
  Str out = {0};
  script_dump_ast(j->diag, j->input, text, len, &out);
  fwrite(str_text(&out), 1, out.len, j->out);
  str_free(&out);
  free(text);
  return diag_errors(j->diag) ? EXIT_INPUT : EXIT_GOOD;
}

static ExitCode run_geo(Job *j)
{
  CommandId action = j->cli->action;
  if (action == CMD_DUMP_AST) return dump_tree(j);
  ExitCode status = apply_settings(j);
  if (status != EXIT_GOOD) return status;
  stage_begin(&j->stats, "script");
  status = run_script_file(j, j->input);
  stage_end(&j->stats);
  if (j->ended && status == EXIT_GOOD && script_exit_code(j->script) > 0) return (ExitCode)script_exit_code(j->script);
  if (status != EXIT_GOOD || j->ended || action == CMD_PARSE) return status;
  if (j->cli->bgm && !fields_read_background(j->fields, j->cli->bgm, j->diag)) return EXIT_INPUT;
  if (j->cli->explain) {
    status = explain_size(j);
    if (status != EXIT_GOOD || !j->cli->action_given) return status; // a question alone makes no mesh
  }
  if (action == CMD_MESH0) return output_model(j);
  if (action == CMD_SAVE || action == CMD_REFINE || action == CMD_BARYCENTRIC) {
    if (!j->mesh) diag_error(j->diag, NO_LOC, "the script makes no mesh (as Mesh 2; does)");
    if (!j->mesh) return EXIT_INPUT;
    split_if_asked(j);
    return finish(j);
  }
  // What the script has made of its mesh (RefineMesh, SetOrder, ...) stays.
  bool there = j->reshaped && j->mesh && j->mesh_dim >= MIN(action_dim(action), 2);
  if (!there && !generate(j, action_dim(action))) return EXIT_INPUT;
  if (diag_errors(j->diag) && !j->cli->keep_going) return EXIT_INPUT;
  return finish(j);
}

// -merge: all the inputs as one mesh; NULL after an error.
static Mesh *read_merged(Job *j, ExitCode *status)
{
  size_t n = j->cli->inputs.len, read = 0;
  Mesh **part = mem_zalloc(n * sizeof *part), *joined = NULL;
  const char *const *file = j->cli->inputs.data;
  while (read < n && (part[read] = out_read(file[read], NULL, j->threads, j->diag, status)) != NULL) read++;
  unsigned long long node;
  if (read == n && !(joined = mesh_join(part, n, &node))) {
    diag_error(j->diag, NO_LOC, "-merge: node %llu is not at the same place in all files: they are not of one mesh",
               node);
    *status = EXIT_INPUT;
  }
  for (size_t i = 0; i < read; i++) mesh_free(part[i]);
  free(part);
  return joined;
}

// A mesh that exists is converted, or reported on; only switches that speak of meshes apply.
static ExitCode run_mesh_file(Job *j)
{
  ExitCode status = EXIT_INPUT;
  stage_begin(&j->stats, "read");
  j->mesh = j->cli->merge ? read_merged(j, &status) : out_read(j->input, NULL, j->threads, j->diag, &status);
  stage_end(&j->stats);
  if (!j->mesh) return status;
  bool wanted = j->cli->json || j->cli->require.len;
  if (!j->cli->outputs.len && !j->cli->format) {
    if (wanted && !partition_if_asked(j)) return EXIT_INPUT;
    if (wanted) return report_print(j, NULL, j->out);
    diag_error(j->diag, NO_LOC, "%s is a mesh: say where to write it (-o file) or use meshgen check", j->input);
    return EXIT_USAGE;
  }
  split_if_asked(j);
  if (!partition_if_asked(j)) return EXIT_INPUT;
  return write_and_report(j, wanted);
}

ExitCode pipeline_run_one(const Cli *c, const char *input, Diag *diag, int threads, FILE *out, JobSummary *summary)
{
  Job j;
  job_init(&j, c, input, diag, threads);
  j.out = out;
  j.summary = summary;
  ExitCode status = is_mesh_file(input) ? run_mesh_file(&j) : run_geo(&j);
  if (status == EXIT_GOOD && diag_errors(diag)) status = EXIT_INPUT;
  if (status != EXIT_GOOD && c->json && !j.reported) report_failure(&j, status, out);
  job_free(&j);
  return status;
}

ExitCode pipeline_run(const Cli *c, Diag *diag)
{
  ExitCode status = output_check(c, diag);
  if (status != EXIT_GOOD) return status;
  if (c->inputs.len > 1 && !c->merge) return batch_run(c, diag);
  for (size_t i = 0; c->inputs.len > 1 && i < c->inputs.len; i++)
    if (!is_mesh_file(c->inputs.data[i])) {
      diag_error(diag, NO_LOC, "-merge puts mesh files together, and '%s' is none", c->inputs.data[i]);
      return EXIT_USAGE;
    }
  return pipeline_run_one(c, c->inputs.data[0], diag, c->options.General_NumThreads, stdout, NULL);
}
