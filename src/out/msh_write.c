// msh_write.c - sections that the MSH versions have in common
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/out_int.h"

void msh__write_format(Writer *w, const char *version, const OutOptions *o)
{
  writer_printf(w, "$MeshFormat\n%s %d 8\n", version, o->binary);
  if (o->binary) {
    const int32_t one = 1; // tells the byte order
    writer_bytes(w, &one, sizeof one);
    writer_char(w, '\n');
  }
  writer_str(w, "$EndMeshFormat\n");
}

// A name ends at the first quote in every reader known, so quotes inside become apostrophes.
static void write_name(Writer *w, const char *name)
{
  for (; *name; name++) writer_char(w, *name == '"' ? '\'' : (unsigned char)*name < ' ' ? ' ' : *name);
}

void msh__write_names(Writer *w, const Mesh *m)
{
  size_t n = 0;
  for (size_t i = 0; i < m->ngroup; i++) n += m->group[i].name != NULL;
  if (!n) return;
  writer_printf(w, "$PhysicalNames\n%zu\n", n);
  for (size_t i = 0; i < m->ngroup; i++) {
    if (!m->group[i].name) continue;
    writer_printf(w, "%d %d \"", m->group[i].dim, m->group[i].tag);
    write_name(w, m->group[i].name);
    writer_str(w, "\"\n");
  }
  writer_str(w, "$EndPhysicalNames\n");
}
