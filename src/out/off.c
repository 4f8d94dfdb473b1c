// off.c - writer and reader of OFF
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/surface_int.h"

void off__write(Writer *w, const Selection *s, const OutOptions *o)
{
  (void)o;
  writer_printf(w, "OFF\n%zu %zu 0\n", s->nnode, s->nelem);
  select__write_points(w, s, "");
  for (size_t i = 0; i < s->nblock; i++) surface__write_faces(w, s, &s->mesh->block[s->block[i]], NULL, 0);
}

Mesh *off__read(Scan s)
{
  Import im;
  const char *from, *to;
  import_begin(&im, &s);
  if (!surface__next_line(&s, &from, &to) || to - from < 3 || memcmp(from, "OFF", 3) != 0) scan_error(&s, "OFF expected");
  else if (to - from > 3) s.p = from + 3; // the counts are on the same line
  while (!s.failed) { // to the counts
    const char *p = s.p;
    scan_space(&s);
    if (s.p < s.end && *s.p == '#') scan_line(&s);
    else if (s.p == p || s.p >= s.end || *s.p != '#') break;
  }
  size_t nodes = scan_count(&s, scan_i64(&s, "the number of points"), 5, "points");
  size_t faces = scan_count(&s, scan_i64(&s, "the number of faces"), 5, "faces");
  scan_line(&s);
  import_reserve_nodes(&im, nodes);
  for (size_t i = 0; i < nodes && !s.failed; i++) {
    double x[3];
    for (int k = 0; k < 3; k++) x[k] = scan_double(&s, "a coordinate");
    scan_line(&s); // normals and colours
    import_node(&im, i, (Vec3){x[0], x[1], x[2]}, -1, 0, NAN);
  }
  for (size_t f = 0; f < faces && !s.failed; f++) {
    int64_t n = scan_i64(&s, "a number of corners");
    surface__begin_face(&im, n, 1, 0);
    for (int64_t k = 0; k < n && !s.failed; k++) import_element_node(&im, (uint64_t)scan_i64(&s, "a corner"));
    scan_line(&s);
  }
  return import_finish(&im);
}
