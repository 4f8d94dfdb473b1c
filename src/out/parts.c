// parts.c - meshes in parts as files: on entities of the parts, in one file or in one for each part
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/str.h"
#include "mesh/part_entities.h"
#include "out/out_int.h"

typedef struct {
  const Format *f;
  const OutOptions *o;
  unsigned flags;
  Diag *d;
  const Mesh *mesh; // as written: on entities of the parts, or as it came
  bool msh;         // parts and ghosts are told
  Ghosts ghosts;
  Selection all; // of the whole mesh
  PartFile file;
} Output;

// Tag of the entity of ghost cells of part 1: above all surfaces (curves, in a mesh of curves).
static int ghost_tag(const Mesh *m)
{
  int tag = 0, dim = mesh_count(m, 2) ? 2 : 1;
  for (size_t i = 0; i < m->nentity; i++)
    if (m->entity[i].dim == dim) tag = MAX(tag, m->entity[i].tag);
  return tag + 1;
}

// Only elements that are written are ghost cells.
static void keep_saved(Ghosts *g, const Selection *s)
{
  size_t kept = 0;
  bool *saved = mem_zalloc(s->mesh->nblock * sizeof *saved);
  for (size_t i = 0; i < s->nblock; i++) saved[s->block[i]] = true;
  for (size_t i = 0; i < g->cell.len; i++)
    if (saved[g->cell.data[i].block]) g->cell.data[kept++] = g->cell.data[i];
  g->cell.len = kept;
  free(saved);
}

static ExitCode write_whole(Output *w, const char *path)
{
  if (w->msh) w->all.parts = &w->file;
  return format__write(w->f, &w->all, path, w->o, w->d);
}

// name_k.extension; the caller frees.
static char *path_of_part(const char *path, uint32_t part)
{
  const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
  size_t stem = dot && dot != base ? (size_t)(dot - path) : strlen(path);
  Str s = {0};
  str_append_n(&s, path, stem);
  str_printf(&s, "_%u%s", part, path + stem);
  return s.data;
}

// Numbers of nodes and elements become those of the whole mesh.
static void number_as_whole(Output *w, Selection *s, const PartOnly *only, PartFile *file)
{
  const Mesh *m = w->mesh;
  uint64_t *first = mem_alloc(m->nblock * sizeof *first), number = 0;
  for (size_t i = 0; i < w->all.nblock; i++) {
    first[w->all.block[i]] = number;
    number += m->block[w->all.block[i]].n;
  }
  for (size_t k = 0; k < s->nnode; k++)
    s->number[s->node[k]] = w->all.number[only->mesh->node_number[s->node[k]] - 1];
  file->first = mem_alloc(s->nblock * sizeof *file->first);
  for (size_t i = 0; i < s->nblock; i++) {
    uint32_t of = only->block_of.data[s->block[i]];
    file->first[i] = of == NONE ? UINT64_MAX : first[of];
  }
  file->ghost_number = mem_alloc(only->ghost_of.len * sizeof *file->ghost_number);
  file->ghost_owner = mem_alloc(only->ghost_of.len * sizeof *file->ghost_owner);
  for (size_t i = 0; i < only->ghost_of.len; i++) {
    const GhostCell *c = &w->ghosts.cell.data[only->ghost_of.data[i]];
    file->ghost_number[i] = first[c->block] + c->index;
    file->ghost_owner[i] = m->block[c->block].part[c->index];
  }
  free(first);
}

static ExitCode write_part(Output *w, const char *path, uint32_t part, uint32_t *local)
{
  PartOnly only;
  PartFile file = w->file;
  bool msh4 = w->f->write == msh4__write;
  const Ghosts *ghosts = w->file.ghosts;
  mesh_part_only(&only, w->mesh, part, ghosts, msh4 && ghosts ? w->file.ghost_tag + (int)part - 1 : 0, local);
  Selection s;
  select__make(&s, only.mesh, w->o, w->flags);
  file.part = part;
  if (ghosts) file.ghosts = &only.ghosts;
  if (w->msh) {
    number_as_whole(w, &s, &only, &file);
    s.parts = &file;
  }
  char *name = path_of_part(path, part);
  ExitCode status = format__write(w->f, &s, name, w->o, w->d);
  free(name);
  select__free(&s);
  free(file.first);
  free(file.ghost_number);
  free(file.ghost_owner);
  part_only_free(&only);
  return status;
}

static ExitCode write_split(Output *w, const char *path)
{
  ExitCode status = EXIT_GOOD;
  if (strcmp(path, "-") == 0) {
    diag_error(w->d, NO_LOC, "one file per part (-part_split) needs a name for them, not standard output");
    return EXIT_USAGE;
  }
  uint32_t *local = mem_alloc(w->mesh->nnode * sizeof *local);
  if (w->mesh->nnode) memset(local, 0xff, w->mesh->nnode * sizeof *local);
  for (uint32_t k = 1; k <= w->mesh->nparts && status == EXIT_GOOD; k++)
    status = write_part(w, path, k, local);
  free(local);
  return status;
}

ExitCode parts__write(const Format *f, const Mesh *m, const char *path, const OutOptions *o, unsigned flags,
                      Diag *d)
{
  bool msh2 = f->write == msh2__write, msh4 = f->write == msh4__write;
  if (!(flags & FORMAT_CELL_DATA) && o->element_tag != 3 && !o->part_split)
    diag_warning(d, NO_LOC, "%s: format %s has no room for the parts", path, format_name(f));
  if (msh4 && o->part_split && o->cell_data)
    diag_warning(d, NO_LOC, "%s: files of single parts get no measures of elements (-cell_data)", path);
  bool entities = msh4 || (msh2 && o->part_new_style) || (!msh2 && o->element_tag == 3);
  PartEntityOptions how = {.topology = (msh2 || msh4) && !o->no_part_topology,
                           .groups = (msh2 || msh4) && o->part_groups};
  Mesh *made = entities ? mesh_part_entities(m, &how) : NULL;
  Output w = {.f = f, .o = o, .flags = flags, .d = d, .mesh = made ? made : m, .msh = msh2 || msh4};
  select__make(&w.all, w.mesh, o, flags);
  w.file = (PartFile){.nparts = m->nparts, .ghost_tag = ghost_tag(w.mesh)};
  if (o->part_ghosts && w.msh) {
    ghosts_make(&w.ghosts, w.mesh);
    keep_saved(&w.ghosts, &w.all);
    w.file.ghosts = &w.ghosts;
  }
  ExitCode status = o->part_split ? write_split(&w, path) : write_whole(&w, path);
  select__free(&w.all);
  ghosts_free(&w.ghosts);
  mesh_free(made);
  return status;
}
