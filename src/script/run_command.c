// run_command.c - commands: messages, files, and what is passed to the program around the script
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

#include <errno.h>
#include <unistd.h>

#include "base/file.h"

// ---- messages ---------------------------------------------

// Is the folder of `path`, links followed, `root` or below it?
static bool lies_below(const char *path, const char *root)
{
  const char *slash = strrchr(path, '/');
  char *dir = slash ? mem_strdup(path) : mem_strdup("./");
  if (slash) dir[slash - path + 1] = 0;
  char *real = realpath(dir, NULL), *top = realpath(root, NULL);
  size_t n = top ? strlen(top) : 0;
  bool below = real && top && !strncmp(real, top, n) && (real[n] == 0 || real[n] == '/' || n == 1);
  const char *name = slash ? slash + 1 : path;
  if (!strcmp(name, "..") || !strcmp(name, ".") || !*name) below = false;
  char link[4];
  if (readlink(path, link, sizeof link) >= 0) below = false;
  free(dir);
  free(real);
  free(top);
  return below;
}

static bool may_write(Script *s, const char *path)
{
  if (s->host && s->host->may_write) return s->host->may_write(s->host->ctx, path);
  if (lies_below(path, ".")) return true;
  const char *slash = s->first_file ? strrchr(s->first_file, '/') : NULL;
  if (!slash) return false;
  char *home = mem_strdup(s->first_file);
  home[slash - s->first_file + 1] = 0;
  bool ok = lies_below(path, home);
  free(home);
  return ok;
}

static void print_to_file(Script *s, const Node *n, const char *text)
{
  const char *path = script__path(s, eval_text(s, n->kid[1]));
  if (!may_write(s, path)) {
    script__error(s, n->loc, "writing to '%s' is not allowed: it lies outside the working folder", path);
    return;
  }
  if (!script__charge(s, 100 + strlen(text) / 16, n->loc)) return;
  FILE *f = fopen(path, n->op == '>' ? "w" : "a");
  bool ok = f && fprintf(f, "%s\n", text) >= 0;
  if (f && fclose(f) != 0) ok = false;
  if (!ok) script__error(s, n->loc, "cannot write to '%s': %s", path, strerror(errno));
}

void run_print(Script *s, const Node *n)
{
  int faults = s->faults;
  const char *format = eval_text(s, n->kid[0]);
  DoubleVec *v = script__take(s);
  for (uint32_t i = 2; i < n->n; i++) eval_list(s, n->kid[i], v);
  Str text = {0};
  if (v->len || strchr(format, '%'))
    format_numbers(s, n->loc, format, v->data, v->len, &text);
  else
    str_append(&text, format);
  script__give(s, v);
  if (s->faults == faults) {
    if (n->op)
      print_to_file(s, n, str_text(&text));
    else if (n->word == KW_Error)
      script__error(s, n->loc, "%s", str_text(&text));
    else if (n->word == KW_Warning)
      diag_warning(s->diag, n->loc, "%s", str_text(&text));
    else if (s->host && s->host->print && script__charge(s, 4 + text.len / 32, n->loc))
      s->host->print(s->host->ctx, str_text(&text));
  }
  str_free(&text);
}

// ---- files ---------------------------------------------

static bool ends_with(const char *text, const char *end)
{
  size_t n = strlen(text), m = strlen(end);
  return n >= m && !strcmp(text + n - m, end);
}

static void read_views(Script *s, const char *path, SrcLoc loc)
{
  size_t len;
  char *text = file_read(path, &len);
  if (!text) {
    script__error(s, loc, "cannot read '%s': %s", path, strerror(errno));
    return;
  }
  vec_push(&s->sources, text);
  if (!views_read_pos(s->fields, path, text, len, s->diag)) s->faults++;
}

static Flow include(Script *s, const Node *n)
{
  const char *name = eval_text(s, n->kid[0]);
  char *path = mem_strdup(script__path(s, name));
  SrcLoc loc = n->kid[0]->loc;
  Flow flow = FLOW_NEXT;
  bool script = n->word == KW_Include || ends_with(path, ".geo") || ends_with(path, ".opt") ||
                ends_with(path, ".geo_unrolled") || ends_with(path, ".i");
  if (!*name) {
    script__error(s, loc, "the name of a file is missing");
  } else if (!script && ends_with(path, ".pos")) {
    read_views(s, path, loc);
  } else if (!script && access(path, R_OK) == 0) {
    if (!s->host || !s->host->merge)
      script__error(s, loc, "cannot merge '%s' here", path);
    else if (!s->host->merge(s->host->ctx, path, loc))
      s->faults++;
  } else if (s->includes >= LIMIT_INCLUDES) {
    script__error(s, loc, "files include one another too deeply (the limit is %d); does '%s' include itself?",
                  LIMIT_INCLUDES, name);
    s->stopped = true;
  } else {
    script__charge(s, 1000, loc);
    ScriptEnd end = run_file(s, path, n->loc);
    if (end == SCRIPT_NO_FILE) script__error(s, loc, "cannot read '%s': %s", path, strerror(errno));
    if (end == SCRIPT_EXIT || s->stopped) flow = FLOW_STOP;
  }
  free(path);
  return flow;
}

// ---- the program around ---------------------------------------------

static void mesh_command(Script *s, const Node *n, MeshCommand what)
{
  int faults = s->faults;
  double number = 0;
  const char *text = "";
  if (n->n && eval_is_text(s, n->kid[0]))
    text = eval_text(s, n->kid[0]);
  else if (n->n)
    number = eval_number(s, n->kid[0]);
  if (s->faults > faults) return;
  if (!s->host || !s->host->mesh) {
    script__error(s, n->loc, "%s is not possible here", words_text(&s->words, n->word));
    return;
  }
  if (!script__charge(s, 100 * 1000, n->loc)) return;
  if (!s->host->mesh(s->host->ctx, what, number, text, n->loc)) s->faults++;
}

static void save(Script *s, const Node *n)
{
  int faults = s->faults;
  if (!n->n) {
    script__error(s, n->loc, "%s needs the name of a file", words_text(&s->words, n->word));
    return;
  }
  const char *path = script__path(s, eval_text(s, n->kid[0]));
  if (s->faults > faults) return;
  if (!s->host || !s->host->save) {
    script__error(s, n->loc, "%s is not possible here", words_text(&s->words, n->word));
    return;
  }
  if (!script__charge(s, 100 * 1000, n->loc)) return;
  if (!s->host->save(s->host->ctx, path, n->loc)) s->faults++;
}

static void system_call(Script *s, const Node *n)
{
  const char *command = n->n ? eval_text(s, n->kid[0]) : "";
  if (!s->host || !s->host->system)
    script__error(s, n->loc, "%s is not allowed: a script may run programs only under -allow_system",
                  words_text(&s->words, n->word));
  else if (!s->host->system(s->host->ctx, command, n->loc))
    s->faults++;
}

static void set_factory(Script *s, const Node *n)
{
  const char *name = n->n ? eval_text(s, n->kid[0]) : "";
  ModelSettings *m = model_settings(s->model);
  if (!strcmp(name, "OpenCASCADE"))
    m->opencascade = true;
  else if (!strcmp(name, "Built-in"))
    m->opencascade = false;
  else
    script__error(s, n->loc,
                  "unknown kernel \"%s\": \"Built-in\" and, for plane shapes, \"OpenCASCADE\" are known",
                  name);
  script__sync_settings(s);
}

static void set_parameter(Script *s, const Node *n)
{
  if (n->n != 2) {
    script__error(s, n->loc, "%s needs a name and a value", words_text(&s->words, n->word));
    return;
  }
  const char *name = eval_text(s, n->kid[0]);
  if (n->word == KW_SetString) {
    script_set_string(s, strchr(name, '/') ? name : arena_strdup(&s->temp, name), eval_text(s, n->kid[1]));
    return;
  }
  double v = eval_number(s, n->kid[1]);
  Parameter *p = script__parameter(s, name, true);
  vec_clear(&p->list);
  vec_push(&p->list, v);
}

static void set_max_tag(Script *s, const Node *n)
{
  static const Kind kinds[] = {KIND_POINT, KIND_CURVE, KIND_FACE, KIND_VOLUME};
  model_set_max_tag(s->model, kinds[n->op], eval_int(s, n->kid[0]));
}

static Flow leave(Script *s, const Node *n)
{
  if (n->n) s->exit_code = eval_int(s, n->kid[0]) & 255;
  s->exiting = s->stopped = true;
  return FLOW_STOP;
}

Flow run_command(Script *s, const Node *n)
{
  switch (n->word) {
  case KW_Call: return run_call(s, n);
  case KW_Include:
  case KW_Merge:
  case KW_MergeWithBoundingBox:
  case KW_MergeFile:
  case KW_Open:
  case KW_OpenProject:
    if (n->n) return include(s, n);
    script__error(s, n->loc, "%s needs the name of a file", words_text(&s->words, n->word));
    break;
  case KW_Save:
  case KW_Print: save(s, n); break;
  case KW_System:
  case KW_SystemCall:
  case KW_NonBlockingSystemCall: system_call(s, n); break;
  case KW_Mesh: mesh_command(s, n, MESH_GENERATE); break;
  case KW_RefineMesh: mesh_command(s, n, MESH_REFINE); break;
  case KW_BarycentricRefineMesh: mesh_command(s, n, MESH_BARYCENTRIC); break;
  case KW_RecombineMesh: mesh_command(s, n, MESH_RECOMBINE); break;
  case KW_SetOrder: mesh_command(s, n, MESH_SET_ORDER); break;
  case KW_OptimizeMesh: mesh_command(s, n, MESH_OPTIMIZE); break;
  case KW_RenumberMeshNodes: mesh_command(s, n, MESH_RENUMBER_NODES); break;
  case KW_RenumberMeshElements: mesh_command(s, n, MESH_RENUMBER_ELEMENTS); break;
  case KW_PartitionMesh: mesh_command(s, n, MESH_PARTITION); break;
  case KW_SetFactory: set_factory(s, n); break;
  case KW_SetNumber:
  case KW_SetString: set_parameter(s, n); break;
  case KW_SetMaxTag: set_max_tag(s, n); break;
  case KW_NewModel:
    model_delete_all(s->model);
    fields_clear(s->fields);
    break;
  case KW_Exit: return leave(s, n);
  case KW_Abort: s->aborted = true; return FLOW_STOP;
  case KW_UndefineConstant:
  case KW_SyncModel:
  case KW_BoundingBox:
  case KW_Sleep:
  case KW_Draw:
  case KW_SetChanged:
  case KW_SetName:
  case KW_UnsplitWindow: break; // nothing to do in a batch run
  default: UNREACHABLE();
  }
  return FLOW_NEXT;
}
