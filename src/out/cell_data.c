// cell_data.c - quality measures of the elements, beside the mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/out_int.h"

bool cell_data__next(const OutOptions *o, Measure *what)
{
  while (*what < MEASURES && !(o->cell_data >> *what & 1)) ++*what;
  return *what < MEASURES;
}

static double value_of(const Mesh *m, const MeshBlock *k, size_t i, Measure what)
{
  return elem_dim(k->type) == 2 ? mesh_measure(m, k, i, what) : 0;
}

double *cell_data__values(const Selection *s, Measure what)
{
  double *v = mem_alloc(s->nelem * sizeof *v);
  size_t n = 0;
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    for (size_t j = 0; j < k->n; j++) v[n++] = value_of(s->mesh, k, j, what);
  }
  return v;
}

static void write_value(Writer *w, bool binary, uint64_t number, double value)
{
  char *p0 = writer_reserve(w, 64), *p = p0;
  if (binary) {
    int32_t n = (int32_t)number;
    p = (char *)memcpy(p, &n, sizeof n) + sizeof n;
    p = (char *)memcpy(p, &value, sizeof value) + sizeof value;
  } else {
    p = put_char(put_double(put_char(put_u64(p, number), ' '), value), '\n');
  }
  writer_commit(w, (size_t)(p - p0));
}

void msh__write_element_data(Writer *w, const Selection *s, const NumberedBlock *block, size_t n, const OutOptions *o)
{
  const Mesh *m = s->mesh;
  size_t count = 0;
  for (size_t i = 0; i < n; i++) count += m->block[block[i].block].n * block[i].copies;
  for (Measure what = 0; count && cell_data__next(o, &what); what++) {
    writer_printf(w, "$ElementData\n1\n\"%s\"\n1\n0\n3\n0\n1\n%zu\n", mesh_measure_name(what), count);
    for (size_t i = 0; i < n; i++) {
      const MeshBlock *k = &m->block[block[i].block];
      for (size_t j = 0; j < k->n; j++) {
        double value = value_of(m, k, j, what);
        for (size_t c = 0; c < block[i].copies; c++) write_value(w, o->binary, block[i].first + j * block[i].copies + c, value);
      }
    }
    writer_str(w, o->binary ? "\n$EndElementData\n" : "$EndElementData\n");
  }
}
