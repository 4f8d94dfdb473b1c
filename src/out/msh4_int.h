// msh4_int.h - numbers of MSH 4 files in either encoding, and the sections that meshes in parts add
// SPDX-License-Identifier: MIT
#ifndef OUT_MSH4_INT_H
#define OUT_MSH4_INT_H

#include "out/out_int.h"

// One number in either encoding. In ASCII every number is followed by a blank except where end_line follows.
typedef struct {
  Writer *w;
  bool binary, first;
} Enc;

static inline void blank(Enc *e)
{
  if (!e->first) writer_char(e->w, ' ');
  e->first = false;
}

static inline void put_int(Enc *e, int v)
{
  const int32_t b = v;
  if (e->binary) {
    writer_bytes(e->w, &b, sizeof b);
    return;
  }
  blank(e);
  writer_i64(e->w, v);
}

static inline void put_size(Enc *e, uint64_t v)
{
  if (e->binary) {
    writer_bytes(e->w, &v, sizeof v);
    return;
  }
  blank(e);
  writer_u64(e->w, v);
}

static inline void put_real(Enc *e, double v)
{
  if (e->binary) {
    writer_bytes(e->w, &v, sizeof v);
    return;
  }
  blank(e);
  writer_double(e->w, v);
}

static inline void put_vec(Enc *e, Vec3 v)
{
  put_real(e, v.x);
  put_real(e, v.y);
  put_real(e, v.z);
}

static inline void end_line(Enc *e)
{
  if (!e->binary) writer_char(e->w, '\n');
  e->first = true;
}

static inline void put_tags(Enc *e, const IntVec *a)
{
  put_size(e, a->len);
  for (size_t i = 0; i < a->len; i++) put_int(e, a->data[i]);
}

// $PartitionedEntities and $GhostElements (msh4_part.c).
void msh4_part__write_entities(Enc *e, const Selection *s);
void msh4_part__write_ghosts(Enc *e, const Selection *s);

#endif
