// pipeline.c - from an input file to its outputs: script, model, curves, faces, audit, files, report
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/pipeline.h"

#include <errno.h>
#include <math.h>

#include "base/file.h"
#include "base/str.h"
#include "cli/batch.h"
#include "cli/host.h"
#include "cli/job_mesh.h"
#include "cli/output.h"
#include "cli/report.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_join.h"
#include "model/model_edit.h"
#include "out/formats.h"

static void job_init(Job *j, const Cli *c, const char *input, Diag *diag, int threads)
{
  *j = (Job){.cli = c, .input = input, .diag = diag, .mesh_dim = -1, .threads = threads};
  options_copy(&j->options, &c->options);
  options_set_string(&j->options, options_find("General", "FileName"), input, NO_LOC, diag);
  j->model = model_new();
  j->fields = fields_new();
  j->host = host_of_job(j);
  j->script = script_new(j->model, &j->options, j->fields, diag, &j->host);
}

static void job_free(Job *j)
{
  job_mesh_drop(j);
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
    *j->summary = (JobSummary){true, j->mesh->nnode, mesh_count(j->mesh, 1), mesh_count_corners(j->mesh, 3),
                               mesh_count_corners(j->mesh, 4), NAN};
  return status;
}

// -part and Mesh.NbPartitions; without them what a script or a file has divided stays so.
static bool partition_if_asked(Job *j)
{
  return j->options.Mesh_NbPartitions < 1 || job_mesh_partition(j, j->options.Mesh_NbPartitions);
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
  if (j->cli->action == CMD_REFINE) job_mesh_split(j, SUBDIVIDE_HALVE);
  if (j->cli->action == CMD_BARYCENTRIC) job_mesh_split(j, SUBDIVIDE_BARYCENTRIC);
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
  if (!there && !job_mesh_generate(j, action_dim(action))) return EXIT_INPUT;
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
  diag_flush(diag);
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
