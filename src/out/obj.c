// obj.c - writer and reader of Wavefront OBJ
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/surface_int.h"

void obj__write(Writer *w, const Selection *s, const OutOptions *o)
{
  (void)o;
  select__write_points(w, s, "v ");
  for (size_t i = 0; i < s->nblock; i++) {
    const MeshBlock *k = &s->mesh->block[s->block[i]];
    const MeshGroup *g = surface__group(s, k);
    char name[256];
    if (g) select__group_name(g, name, sizeof name);
    if (g) writer_printf(w, "g %s\n", name);
    surface__write_faces(w, s, k, "f", 1);
  }
}

// "f a b c", "f a/t b/t c/t", "f a//n ...", indices from 1 or from the end if negative.
static void obj_face(Import *im, Scan *s, const char *p, const char *to, int entity, int group)
{
  int64_t v[4], n = 0;
  while (p < to && !s->failed) {
    while (p < to && (unsigned char)*p <= ' ') p++;
    if (p == to) break;
    int64_t k = 0;
    const char *q = number_read_i64(p, to, &k);
    if (q == p || n == 4) {
      scan_error(s, q == p ? "a corner expected" : "a face of more than 4 corners");
      return;
    }
    v[n++] = k < 0 ? (int64_t)im->mesh->nnode + k + 1 : k;
    for (p = q; p < to && (unsigned char)*p > ' ';) p++;
  }
  surface__begin_face(im, n, entity, group);
  for (int64_t k = 0; k < n && !s->failed; k++) import_element_node(im, (uint64_t)v[k]);
}

Mesh *obj__read(Scan s)
{
  Import im;
  const char *from, *to;
  int group = 0;
  import_begin(&im, &s);
  while (!s.failed && surface__next_line(&s, &from, &to)) {
    bool blank = to - from > 1 && (from[1] == ' ' || from[1] == '\t');
    if (blank && from[0] == 'v') {
      Scan line = s;
      double x[3];
      line.p = from + 1;
      line.end = to;
      for (int k = 0; k < 3; k++) x[k] = scan_double(&line, "a coordinate");
      s.failed = line.failed;
      import_node(&im, im.mesh->nnode + 1, (Vec3){x[0], x[1], x[2]}, -1, 0, NAN);
    } else if (blank && from[0] == 'f') {
      obj_face(&im, &s, from + 1, to, MAX(group, 1), group);
    } else if (blank && from[0] == 'g') {
      char label[256];
      const char *p = from + 1;
      while (p < to && (unsigned char)*p <= ' ') p++;
      snprintf(label, sizeof label, "%.*s", (int)(to - p), p);
      group = *label ? import_group_named(&im, 2, label) : 0;
    }
  }
  if (!s.failed && !im.mesh->nnode) scan_error(&s, "no line begins with v");
  return import_finish(&im);
}
