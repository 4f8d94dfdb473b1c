// formats.c - the table of file formats: finding one by name or extension, writing and reading meshes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/formats.h"

#include <errno.h>
#include <strings.h>
#include <sys/stat.h>

#include "out/out_int.h"

// Several names may share an extension: the first row that has it is taken.
static const Format table[] = {
    {.name = "msh", .extensions = "msh", .help = "MSH 4.1, ASCII or binary", .flags = FORMAT_ORPHANS | FORMAT_CELL_DATA,
     .write = msh4__write, .read = msh__read},
    {.name = "msh4", .extensions = "msh4", .help = "the same", .flags = FORMAT_ORPHANS | FORMAT_CELL_DATA,
     .write = msh4__write, .read = msh__read},
    {.name = "msh41", .extensions = "msh41", .help = "the same", .flags = FORMAT_ORPHANS | FORMAT_CELL_DATA,
     .write = msh4__write, .read = msh__read},
    {.name = "msh2", .extensions = "msh2", .help = "MSH 2.2, ASCII or binary", .flags = FORMAT_CELL_DATA, .write = msh2__write, .read = msh__read},
    {.name = "msh22", .extensions = "msh22", .help = "the same", .flags = FORMAT_CELL_DATA, .write = msh2__write, .read = msh__read},
    {.name = "msh1", .extensions = "msh1", .help = "MSH 1", .write = msh1__write, .read = msh__read},
    {.name = "vtk", .extensions = "vtk", .help = "legacy VTK, ASCII or binary", .flags = FORMAT_CELL_DATA,
     .write = vtk__write, .refuses = vtk__refuses, .read = vtk__read},
    {.name = "vtu", .extensions = "vtu", .help = "VTK XML, compressed", .flags = FORMAT_CELL_DATA, .write = vtu__write, .refuses = vtu__refuses, .read = vtu__read},
    {.name = "mesh", .extensions = "mesh", .help = "Medit", .flags = FORMAT_NO_POINTS, .write = medit__write,
     .refuses = medit__refuses, .read = medit__read},
    {.name = "mesh2d", .extensions = "mesh2d", .help = "Medit without z, as FreeFEM reads it", .flags = FORMAT_NO_POINTS,
     .write = medit__write_2d, .refuses = medit__refuses_2d, .read = medit__read},
    {.name = "inp", .extensions = "inp", .help = "Abaqus and CalculiX, with element sets", .flags = FORMAT_NO_POINTS,
     .write = inp__write, .refuses = inp__refuses, .read = inp__read},
    {.name = "su2", .extensions = "su2", .help = "SU2 with markers", .flags = FORMAT_NO_POINTS, .write = su2__write,
     .refuses = su2__refuses, .read = su2__read},
    {.name = "unv", .extensions = "unv", .help = "I-DEAS universal file with groups", .flags = FORMAT_NO_POINTS,
     .write = unv__write, .refuses = unv__refuses, .read = unv__read},
    {.name = "triangle", .extensions = "node ele poly", .help = "the program Triangle's .node, .ele and .poly, together",
     .flags = FORMAT_NO_POINTS, .write_files = triangle__write, .refuses = triangle__refuses, .read_files = triangle__read},
    {.name = "off", .extensions = "off", .help = "OFF, surface elements alone", .flags = FORMAT_SURFACE, .write = off__write,
     .refuses = surface__refuses, .read = off__read},
    {.name = "obj", .extensions = "obj", .help = "Wavefront OBJ, surface elements alone", .flags = FORMAT_SURFACE,
     .write = obj__write, .refuses = surface__refuses, .read = obj__read},
    {.name = "ply", .extensions = "ply", .help = "PLY, ASCII or binary, surface elements alone", .flags = FORMAT_SURFACE,
     .write = ply__write, .refuses = surface__refuses, .read = ply__read},
    {.name = "stl", .extensions = "stl", .help = "STL, ASCII or binary, surface elements alone", .flags = FORMAT_SURFACE,
     .write = stl__write, .refuses = surface__refuses, .read = stl__read},
    {.name = "png", .extensions = "png", .help = "picture of the mesh", .flags = FORMAT_ALL, .write = png__write, .lacks = picture__lacks},
    {.name = "svg", .extensions = "svg", .help = "picture of the mesh", .flags = FORMAT_ALL, .write = svg__write},
    {.name = "pdf", .extensions = "pdf", .help = "picture of the mesh", .flags = FORMAT_ALL, .write = pdf__write, .lacks = picture__lacks},
};

const Format *format_at(size_t k) { return k < ARRAY_LEN(table) ? &table[k] : NULL; }
const char *format_name(const Format *f) { return f->name; }
const char *format_help(const Format *f) { return f->help; }
const char *format_extensions(const Format *f) { return f->extensions; }
bool format_writes(const Format *f) { return f->write || f->write_files; }
bool format_reads(const Format *f) { return f->read || f->read_files; }

const Format *format_find(const char *name)
{
  for (size_t i = 0; i < ARRAY_LEN(table); i++)
    if (strcasecmp(table[i].name, name) == 0) return &table[i];
  return NULL;
}

static bool has_word(const char *words, const char *word)
{
  size_t n = strlen(word);
  for (const char *p = words; *p;) {
    size_t len = strcspn(p, " ");
    if (len == n && strncasecmp(p, word, n) == 0) return true;
    p += len + (p[len] == ' ');
  }
  return false;
}

const Format *format_of_path(const char *path)
{
  const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
  if (!dot || !dot[1]) return NULL;
  for (size_t i = 0; i < ARRAY_LEN(table); i++)
    if (has_word(table[i].extensions, dot + 1)) return &table[i];
  return NULL;
}

// The format asked for, or NULL after an error.
static const Format *choose(const char *path, const char *format, Diag *d)
{
  bool automatic = !format || !*format || strcasecmp(format, "auto") == 0;
  const Format *f = automatic ? format_of_path(path) : format_find(format);
  if (!f && automatic && strcmp(path, "-") == 0) return format_find("msh");
  if (!f && automatic)
    diag_error(d, NO_LOC, "'%s': no format has this extension (name one with -format)", path);
  else if (!f)
    diag_error(d, NO_LOC, "unknown mesh format '%s'", format);
  return f;
}

// 0 or errno.
static int write_file(const Format *f, const Selection *s, const char *path, const OutOptions *o)
{
  if (f->write_files) return f->write_files(path, s, o);
  Writer *w = writer_open(path);
  if (!w) return errno;
  if (o->sync) writer_sync(w);
  writer_threads(w, o->threads);
  f->write(w, s, o);
  return writer_close(w);
}

ExitCode format__write(const Format *f, const Selection *s, const char *path, const OutOptions *o, Diag *d)
{
  const char *why = f->refuses ? f->refuses(s) : NULL;
  int error = why ? 0 : write_file(f, s, path, o);
  if (why) diag_error(d, NO_LOC, "%s: %s", path, why);
  if (error) diag_error(d, NO_LOC, "%s: %s", path, strerror(error));
  return why ? EXIT_INPUT : error ? EXIT_ENVIRONMENT : EXIT_GOOD;
}

ExitCode out_write(const Mesh *m, const char *path, const char *format, const OutOptions *o, Diag *d)
{
  const Format *f = choose(path, format, d);
  if (!f) return EXIT_USAGE;
  if (!format_writes(f)) {
    diag_error(d, NO_LOC, "format %s can be read, not written", f->name);
    return EXIT_USAGE;
  }
  const char *lack = f->lacks ? f->lacks() : NULL;
  if (lack) {
    diag_error(d, NO_LOC, "%s: %s", path, lack);
    return EXIT_ENVIRONMENT;
  }
  struct stat st;
  if (f->write_files && (strcmp(path, "-") == 0 || (stat(path, &st) == 0 && !S_ISREG(st.st_mode)))) {
    diag_error(d, NO_LOC, "%s: format %s is several files and needs a name for them", path, f->name);
    return EXIT_USAGE;
  }
  if (o->cell_data && !(f->flags & (FORMAT_CELL_DATA | FORMAT_ALL)))
    diag_warning(d, NO_LOC, "%s: format %s has no room for the measures of elements (-cell_data)", path, f->name);
  OutOptions options = *o;
  if (f->flags & FORMAT_ALL) options.save_all = true;
  unsigned flags = o->no_orphans ? f->flags & ~(unsigned)FORMAT_ORPHANS : f->flags;
  if (m->nparts && !(f->flags & FORMAT_ALL)) return parts__write(f, m, path, &options, flags, d);
  Selection s;
  select__make(&s, m, &options, flags);
  ExitCode status = format__write(f, &s, path, &options, d);
  select__free(&s);
  return status;
}

// The format of a file by how it begins, where the extension does not tell; NULL if it is none that is known.
static const Format *sniff(const char *text, size_t len)
{
  if (len >= 4 && memcmp(text, "$Mes", 4) == 0) return format_find("msh");
  if (len >= 4 && memcmp(text, "$NOD", 4) == 0) return format_find("msh");
  if (len >= 9 && memmem(text, MIN(len, (size_t)400), "<VTKFile", 8)) return format_find("vtu");
  if (len >= 14 && memcmp(text, "# vtk DataFile", 14) == 0) return format_find("vtk");
  return NULL;
}

static const Format *choose_reader(const char *path, const char *format, const char *text, size_t len, Diag *d)
{
  const Format *f;
  if (format && *format && strcasecmp(format, "auto") != 0) {
    f = format_find(format);
    if (!f) diag_error(d, NO_LOC, "unknown mesh format '%s'", format);
  } else {
    f = sniff(text, len);
    if (!f) f = format_of_path(path);
    const char *dot = strrchr(path, '.');
    if (!f && dot && strcasecmp(dot, ".geo") == 0)
      diag_error(d, NO_LOC, "%s is a script, not a mesh: meshgen -2 makes a mesh of it", path);
    else if (!f)
      diag_error(d, NO_LOC, "'%s': the format of this file is not known; its extension should tell", path);
  }
  if (f && !format_reads(f)) {
    diag_error(d, NO_LOC, "'%s': format %s can be written, not read", path, f->name);
    f = NULL;
  }
  return f;
}

static Scan whole(const char *text, size_t len, const char *name, int threads, Diag *d)
{
  return (Scan){.p = text, .end = text + len, .begin = text, .name = name, .diag = d, .threads = threads};
}

Mesh *out_read_memory(const char *text, size_t len, const char *name, const char *format, Diag *d)
{
  const Format *f = choose_reader(name, format, text, len, d);
  return f && f->read ? f->read(whole(text, len, name, 1, d)) : NULL;
}

Mesh *out_read(const char *path, const char *format, int threads, Diag *d, ExitCode *status)
{
  ExitCode ignored;
  if (!status) status = &ignored;
  *status = EXIT_GOOD;
  FileView v;
  if (!file_view_open(&v, path)) {
    diag_error(d, NO_LOC, "%s: %s", path, strerror(errno));
    *status = EXIT_ENVIRONMENT;
    return NULL;
  }
  const Format *f = choose_reader(path, format, v.text, v.len, d);
  Mesh *m = NULL;
  if (f && f->read) m = f->read(whole(v.text, v.len, path, threads, d));
  else if (f) m = f->read_files(path, d, status);
  if (!m && *status == EXIT_GOOD) *status = EXIT_INPUT;
  file_view_close(&v);
  return m;
}
