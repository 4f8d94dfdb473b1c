// output.c - where a job's mesh goes and in what format
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/output.h"

#include <errno.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/map.h"
#include "base/str.h"
#include "model/unroll.h"

// ---- options to the writers -----------------------------------------------------------------------------------------
// A bit per dimension of Mesh.SaveGroupsOf...: 0 none, positive all, negative those whose decimal digit is not 0 (-10: curves).
static unsigned dimensions(int option)
{
  if (option >= 0) return option ? 7 : 0;
  int digits = -option;
  return (digits % 10 ? 1u : 0) | (digits / 10 % 10 ? 2u : 0) | (digits / 100 % 10 ? 4u : 0);
}

OutOptions output_options(const Job *j)
{
  const Options *o = &j->options;
  const Cli *c = j->cli;
  return (OutOptions){.binary = o->Mesh_Binary,
                      .save_all = o->Mesh_SaveAll,
                      .no_orphans = o->Mesh_SaveWithoutOrphans,
                      .save_parametric = o->Mesh_SaveParametric,
                      .scaling = o->Mesh_ScalingFactor,
                      .first_node = (uint64_t)o->Mesh_FirstNodeTag,
                      .first_element = (uint64_t)o->Mesh_FirstElementTag,
                      .element_tag = o->Mesh_SaveElementTagType,
                      .node_sets = dimensions(o->Mesh_SaveGroupsOfNodes),
                      .no_element_sets = ~dimensions(o->Mesh_SaveGroupsOfElements),
                      .no_elements = o->Mesh_SaveGroupsOfElements < 0 ? ~dimensions(o->Mesh_SaveGroupsOfElements) : 0,
                      .no_part_topology = !o->Mesh_PartitionCreateTopology,
                      .part_groups = o->Mesh_PartitionCreatePhysicals && !o->Mesh_PartitionOldStyleMsh2,
                      .part_new_style = !o->Mesh_PartitionOldStyleMsh2,
                      .part_ghosts = o->Mesh_PartitionCreateGhostCells,
                      .part_split = o->Mesh_PartitionSplitMeshFiles,
                      .stl_solids = o->Mesh_StlOneSolidPerSurface,
                      .cell_data = c->cell_data,
                      .sync = c->sync,
                      .color = c->color_by,
                      .width = c->width,
                      .window = {c->window[0], c->window[1], c->window[2], c->window[3]},
                      .mark_worst = c->mark_worst,
                      .histogram = c->histogram,
                      .threads = j->threads};
}

// ---- formats and names ------------------------------------------------------------------------------------------------
// The .msh format of Mesh.MshFileVersion.
static const char *msh_name(double version) { return version >= 3 ? "msh4" : version >= 2 ? "msh2" : "msh1"; }

// Name of the format numbered so in Mesh.Format; NULL: by extension.
static const char *format_of_number(int number)
{
  static const struct { int number; const char *name; } numbered[] = {
      {1, "msh"}, {2, "unv"}, {16, "vtk"}, {27, "stl"}, {30, "mesh"}, {39, "inp"}, {40, "ply"}, {42, "su2"}, {53, "off"}, {57, "obj"}};
  for (size_t i = 0; i < ARRAY_LEN(numbered); i++)
    if (numbered[i].number == number) return numbered[i].name;
  return NULL;
}

// The format that was asked for, else that of the path; NULL if the extension names none.
static const char *format_for(const Job *j, const char *path, const char *name)
{
  if (!name) name = j->cli->format;
  if (name && strcasecmp(name, "auto") == 0) name = NULL;
  if (!name) name = format_of_number(j->options.Mesh_Format);
  const Format *f = name ? format_find(name) : strcmp(path, "-") == 0 ? format_find("msh") : format_of_path(path);
  if (!f) return name;
  return strcmp(format_name(f), "msh") == 0 ? msh_name(j->options.Mesh_MshFileVersion) : format_name(f);
}

ExitCode output_mesh(Job *j, const char *path, const char *format)
{
  OutOptions o = output_options(j);
  return out_write(j->mesh, path, format_for(j, path, format), &o, j->diag);
}

static const char *base_name(const char *path)
{
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

// Path without its extension, with another one. The caller frees.
static char *with_extension(const char *path, const char *extension)
{
  const char *base = base_name(path), *dot = strrchr(base, '.');
  size_t stem = dot && dot != base ? (size_t)(dot - path) : strlen(path);
  Str s = {0};
  str_append_n(&s, path, stem);
  str_printf(&s, ".%s", extension);
  return s.data;
}

// The extension of a format's files where no name was given.
static const char *extension_of(const char *format)
{
  if (strncmp(format, "msh", 3) == 0) return "msh";
  return strcmp(format, "triangle") == 0 ? "node" : format;
}

static const char *input_name(const char *input) { return strcmp(input, "-") == 0 ? "stdin" : input; }

static bool is_folder(const char *path)
{
  struct stat st;
  return stat(path, &st) == 0 && S_ISDIR(st.st_mode);
}

// folder/<name of the input>.<extension>. The caller frees.
static char *in_folder(const char *folder, const char *input, const char *extension)
{
  char *name = with_extension(base_name(input_name(input)), extension);
  Str s = {0};
  str_printf(&s, "%s%s%s", folder, folder[strlen(folder) - 1] == '/' ? "" : "/", name);
  free(name);
  return s.data;
}

static bool same_file(const char *a, const char *b)
{
  struct stat x, y;
  return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

// To a name that meshgen chose: never over the input.
static ExitCode write_named(Job *j, char *path)
{
  ExitCode status = EXIT_USAGE;
  if (same_file(path, j->input))
    diag_error(j->diag, NO_LOC, "%s would be replaced by its own conversion; say -o %s if you mean it", path, path);
  else
    status = output_mesh(j, path, NULL);
  free(path);
  return status;
}

ExitCode output_all(Job *j)
{
  ExitCode status = EXIT_GOOD;
  const char *extension = extension_of(format_for(j, ".msh", NULL));
  stage_begin(&j->stats, "write");
  if (!j->cli->outputs.len) status = write_named(j, with_extension(input_name(j->input), extension));
  for (size_t i = 0; i < j->cli->outputs.len && status == EXIT_GOOD; i++) {
    const char *path = j->cli->outputs.data[i];
    status = is_folder(path) ? write_named(j, in_folder(path, j->input, extension)) : output_mesh(j, path, NULL);
  }
  stage_end(&j->stats);
  return status;
}

static int write_unrolled(const Job *j, const char *path)
{
  Writer *w = writer_open(path);
  if (!w) return errno;
  model_unroll(j->model, w);
  return writer_close(w);
}

ExitCode output_model(Job *j)
{
  if (!model_prepare(j->model, j->options.Geometry_Tolerance, j->diag)) return EXIT_INPUT;
  const char *given = j->cli->outputs.len ? j->cli->outputs.data[0] : NULL;
  char *path = !given              ? with_extension(input_name(j->input), "geo_unrolled")
               : is_folder(given) ? in_folder(given, j->input, "geo_unrolled")
                                  : mem_strdup(given);
  int error = write_unrolled(j, path);
  if (error) diag_error(j->diag, NO_LOC, "%s: %s", path, strerror(error));
  free(path);
  return error ? EXIT_ENVIRONMENT : EXIT_GOOD;
}

// ---- the request --------------------------------------------------------------------------------------------------------
// A batch into a folder needs inputs of different names.
static ExitCode check_names(const Cli *c, Diag *diag)
{
  Names seen = {0};
  ExitCode status = EXIT_GOOD;
  for (size_t i = 0; i < c->inputs.len && status == EXIT_GOOD; i++) {
    char *name = with_extension(base_name(input_name(c->inputs.data[i])), "");
    uint32_t other = names_get(&seen, name);
    if (other != NONE) {
      diag_error(diag, NO_LOC, "'%s' and '%s' would be written to the same file", c->inputs.data[other], c->inputs.data[i]);
      status = EXIT_USAGE;
    }
    names_set(&seen, name, (uint32_t)i);
    free(name);
  }
  names_free(&seen);
  return status;
}

static void unknown_extension(const char *path, Diag *diag)
{
  Str known = {0};
  const Format *f;
  for (size_t k = 0; (f = format_at(k)) != NULL; k++)
    if (format_writes(f)) str_printf(&known, "%s%s", k ? ", " : "", format_name(f));
  diag_error(diag, NO_LOC, "%s: the extension names no known format; name one with -format: %s", path, str_text(&known));
  str_free(&known);
}

static ExitCode check_output(const Cli *c, const char *path, Diag *diag)
{
  bool folder = is_folder(path), by_extension = (!c->format || strcasecmp(c->format, "auto") == 0) &&
                                                c->action != CMD_MESH0 && !format_of_number(c->options.Mesh_Format);
  if (!*path) {
    diag_error(diag, NO_LOC, "-o needs a file name, not an empty word");
    return EXIT_USAGE;
  }
  if (c->inputs.len > 1 && !c->merge && !folder) {
    diag_error(diag, NO_LOC, "with several inputs -o must name an existing folder, not '%s'", path);
    return EXIT_USAGE;
  }
  if (by_extension && !folder && strcmp(path, "-") != 0 && !format_of_path(path)) {
    unknown_extension(path, diag);
    return EXIT_USAGE;
  }
  return EXIT_GOOD;
}

ExitCode output_check(const Cli *c, Diag *diag)
{
  if (!c->inputs.len) {
    diag_error(diag, NO_LOC, "no input file; see meshgen -help");
    return EXIT_USAGE;
  }
  if (c->format && strcasecmp(c->format, "auto") != 0 && !format_find(c->format)) {
    const char *names[64];
    size_t n = 0;
    for (const Format *f; n < ARRAY_LEN(names) && (f = format_at(n)) != NULL; n++) names[n] = format_name(f);
    const char *near = str_nearest(c->format, names, n);
    diag_error(diag, NO_LOC, "unknown format '%s'%s%s%s", c->format, near ? "; did you mean '" : "; meshgen -list_formats prints those there are",
               near ? near : "", near ? "'?" : "");
    return EXIT_USAGE;
  }
  ExitCode status = EXIT_GOOD;
  for (size_t i = 0; i < c->outputs.len && status == EXIT_GOOD; i++) {
    status = check_output(c, c->outputs.data[i], diag);
    for (size_t k = 0; k < i && status == EXIT_GOOD; k++)
      if (strcmp(c->outputs.data[i], c->outputs.data[k]) == 0) {
        diag_error(diag, NO_LOC, "-o %s is said twice", c->outputs.data[i]);
        status = EXIT_USAGE;
      }
  }
  if (status == EXIT_GOOD && c->inputs.len > 1 && !c->merge && c->outputs.len) status = check_names(c, diag);
  return status;
}
