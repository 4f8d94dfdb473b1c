// msh_read_int.h - what the readers of MSH files share: state, numbers, entities of parts
// SPDX-License-Identifier: MIT
#ifndef OUT_MSH_READ_INT_H
#define OUT_MSH_READ_INT_H

#include "base/map.h"
#include "out/import.h"
#include "out/out_int.h"

// An entity of some parts of the mesh. What is on it goes to its parent, but for what is not the mesh's own:
// ghost cells, and what lies between parts.
typedef struct {
  int parent_dim, parent_tag;
  uint32_t part;
  bool foreign, ghosts;
} Piece;

typedef struct {
  size_t first, n;
} NodeRange;

typedef struct {
  Scan *s;
  Import im;
  Map pieces; // piece_key -> index in piece
  Vec(Piece) piece;
  Vec(NodeRange) doubtful; // nodes on ghost cells: they stay if other elements have them
  int version;             // 100 times the version: 100, 200, 220, 400, 410
  bool nodes_seen;
} Reader;

// One number in either encoding.
static inline int get_int(Reader *r, const char *what)
{
  return r->s->binary ? scan_b32(r->s, what) : scan_int(r->s, what);
}
static inline int64_t get_size(Reader *r, const char *what)
{
  return r->s->binary ? (int64_t)scan_b64(r->s, what) : scan_i64(r->s, what);
}
static inline double get_double(Reader *r, const char *what)
{
  return r->s->binary ? scan_bdouble(r->s, what) : scan_double(r->s, what);
}
static inline Vec3 get_point(Reader *r)
{
  double x = get_double(r, "a coordinate"), y = get_double(r, "a coordinate"),
         z = get_double(r, "a coordinate");
  return (Vec3){x, y, z};
}
// A count of things of at least `text` bytes each in ASCII and `bytes` in binary.
static inline size_t get_count(Reader *r, size_t text, size_t bytes, const char *what)
{
  return scan_count(r->s, get_size(r, "a count"), r->s->binary ? bytes : text, what);
}

static inline void get_tags(Reader *r, IntVec *to, bool keep, const char *what)
{
  size_t n = get_count(r, 2, 4, what);
  for (size_t i = 0; i < n && !r->s->failed; i++) {
    int tag = get_int(r, what);
    if (keep && tag) vec_push(to, tag);
  }
}

// Nodes of any element type, or 0 after an error (msh_read.c).
int msh_read__nodes(Reader *r, int type);
// Is a type that has nodes one of dimension 3, which are skipped?
static inline bool msh_read__is_volume(int type) { return !elem_nodes((ElemType)type); }

// Sections $Nodes, $NOD or $ParametricNodes, and $Elements or $ELM, of MSH 1 and 2 (msh2_read.c).
void msh2_read__nodes(Reader *r, bool parametric);
void msh2_read__elements(Reader *r);
// $Entities, $Nodes and $Elements of MSH 4 (msh4_read.c).
void msh4_read__entities(Reader *r);
void msh4_read__nodes(Reader *r);
void msh4_read__elements(Reader *r);

// Entities of parts (msh_pieces.c). The piece that an entity is, or NULL.
const Piece *msh_pieces__find(const Reader *r, int dim, int tag);
// $PartitionedEntities.
void msh_pieces__read(Reader *r);
// The mesh, as import_finish has it, without what only pieces had: the nodes of ghost cells, groups of parts.
// Frees the pieces.
Mesh *msh_pieces__finish(Reader *r);

#endif
