// surface_int.h - what OFF, OBJ, PLY and STL share: lines of points and faces, faces that are read
// SPDX-License-Identifier: MIT
#ifndef OUT_SURFACE_INT_H
#define OUT_SURFACE_INT_H

#include "out/import.h"
#include "out/out_int.h"

// A line "3 a b c" or "4 a b c d" for each element of a block, nodes counted from base; with a prefix, that stands for the count.
void surface__write_faces(Writer *w, const Selection *s, const MeshBlock *k, const char *prefix, uint64_t base);
// The first group of a block's entity, or NULL.
const MeshGroup *surface__group(const Selection *s, const MeshBlock *k);

// Begin a face of so many corners, as import_element does; an error where that is no triangle or quadrangle.
static inline void surface__begin_face(Import *im, int64_t corners, int entity, int group)
{
  if (corners != 3 && corners != 4)
    scan_error(im->s, "a face of %lld corners (3 and 4 are read)", (long long)corners);
  else
    import_element(im, corners == 3 ? ELEM_TRI3 : ELEM_QUAD4, entity, group);
}
// The next line that is neither empty nor a comment; false at the end of the file.
static inline bool surface__next_line(Scan *s, const char **from, const char **to)
{
  while (scan_get_line(s, from, to))
    if (*from < *to && **from != '#') return true;
  return false;
}

#endif
