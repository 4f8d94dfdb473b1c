// out_int.h - what the writers and readers share: the selection, the format rows, fast number text
// SPDX-License-Identifier: MIT
#ifndef OUT_OUT_INT_H
#define OUT_OUT_INT_H

#include "base/base.h"
#include "base/decimal.h"
#include "base/diag.h"
#include "base/file.h"
#include "base/number.h"
#include "mesh/element.h"
#include "mesh/mesh.h"
#include "mesh/part_nodes.h"
#include "out/formats.h"
#include "out/import.h"
#include "out/scan.h"

// What the MSH formats add where a mesh is in parts (parts.c).
typedef struct {
  uint32_t nparts, part;  // part: the one a file is for; 0: all
  const Ghosts *ghosts;   // of the elements written, on the blocks of the mesh; NULL: none
  int ghost_tag;          // of the entity of ghost cells of part 1; those of others follow
  // Files of one part:
  uint64_t *first;        // per saved block: number of its first element less elem0; UINT64_MAX: ghost cells
  uint64_t *ghost_number; // the numbers of the ghost cells less elem0, in their order
  uint32_t *ghost_owner;  // and their parts
} PartFile;

// What of a mesh goes into a file (select.c).
typedef struct {
  const Mesh *mesh;
  bool grouped;        // only what is in a physical group
  bool *entity;        // per entity: its elements are saved
  uint32_t *number;    // per node of the mesh: position in the file from 0, or NONE
  uint32_t *node;      // inverse: nnode indices into the mesh's nodes, by entity
  size_t nnode;
  uint32_t *block;     // blocks saved, nblock of them, by entity then type
  size_t nblock, nelem;
  double scale;
  uint64_t node0, elem0; // first numbers
  const PartFile *parts; // or NULL; in a file for one part, number[] is that in the whole mesh
} Selection;

// flags: FORMAT_ORPHANS keeps nodes of saved entities that no saved element uses, if everything is saved.
void select__make(Selection *s, const Mesh *m, const OutOptions *o, unsigned flags);
void select__free(Selection *s);

// Write a selection as it is (formats.c), or a mesh in parts (parts.c).
ExitCode format__write(const Format *f, const Selection *s, const char *path, const OutOptions *o, Diag *d);
ExitCode parts__write(const Format *f, const Mesh *m, const char *path, const OutOptions *o, unsigned flags,
                      Diag *d);

enum {
  FORMAT_ORPHANS = 1,  // writes nodes that no element uses, when everything is saved
  FORMAT_NO_POINTS = 4,// has no elements of dimension 0
  FORMAT_SURFACE = 8,  // has elements of dimension 2 alone
  FORMAT_CELL_DATA = 16, // holds measures and parts of elements
  FORMAT_ALL = 2,      // the saving rule does not apply: pictures
};

struct Format {
  const char *name, *extensions, *help; // extensions separated by blanks, without the dot
  unsigned flags;
  void (*write)(Writer *w, const Selection *s, const OutOptions *o);
  int (*write_files)(const char *path, const Selection *s, const OutOptions *o); // instead: several files; errno
  const char *(*lacks)(void);                 // NULL or what this machine lacks to write it
  const char *(*refuses)(const Selection *s); // NULL or why this mesh cannot be written
  Mesh *(*read)(Scan s); // a whole file, from its beginning
  Mesh *(*read_files)(const char *path, Diag *d, ExitCode *status); // instead: several files
};

void msh1__write(Writer *w, const Selection *s, const OutOptions *o);
void msh2__write(Writer *w, const Selection *s, const OutOptions *o);
void msh4__write(Writer *w, const Selection *s, const OutOptions *o);
void vtk__write(Writer *w, const Selection *s, const OutOptions *o);
#define FORMAT_DECLARE(f)                                               \
  void f##__write(Writer *w, const Selection *s, const OutOptions *o); \
  const char *f##__refuses(const Selection *s);                         \
  Mesh *f##__read(Scan s);
FORMAT_DECLARE(medit)
void medit__write_2d(Writer *w, const Selection *s, const OutOptions *o); // without z: FreeFEM reads this
const char *medit__refuses_2d(const Selection *s);
FORMAT_DECLARE(su2)
FORMAT_DECLARE(inp)
FORMAT_DECLARE(unv)
FORMAT_DECLARE(vtu)
FORMAT_DECLARE(off)
FORMAT_DECLARE(obj)
FORMAT_DECLARE(ply)
FORMAT_DECLARE(stl)
const char *surface__refuses(const Selection *s);
Mesh *vtk__read(Scan s);
int triangle__write(const char *path, const Selection *s, const OutOptions *o);
const char *triangle__refuses(const Selection *s);
Mesh *triangle__read(const char *path, Diag *d, ExitCode *status);
void png__write(Writer *w, const Selection *s, const OutOptions *o);
void svg__write(Writer *w, const Selection *s, const OutOptions *o);
void pdf__write(Writer *w, const Selection *s, const OutOptions *o);
const char *picture__lacks(void); // of PNG and PDF

Mesh *msh__read(Scan s);

// Blocks of MSH 4.1 read at once, the n nodes of one and the n elements of `nodes` nodes each of another. False, and nothing is
// done, where they are not as such files mostly are: then they are to be read number by number.
bool msh__bulk_nodes(Import *im, size_t n, int dim, int entity);
bool msh__bulk_elements(Import *im, size_t n, size_t nodes, uint32_t *to);

// $PhysicalNames of the MSH formats; nothing if no group has a name.
void msh__write_names(Writer *w, const Mesh *m);
// Quality measures as data of elements (OutOptions.cell_data). Steps *what, from 0, to the next one wanted; false after the last.
bool cell_data__next(const OutOptions *o, Measure *what);
// Of the elements selected, in their order; 0 for points and lines. The caller frees.
double *cell_data__values(const Selection *s, Measure what);
// A block as a file numbers its elements: copy c of element i is first + i * copies + c.
typedef struct {
  uint32_t block;
  uint64_t first;
  size_t copies;
} NumberedBlock;
// $ElementData of the MSH formats: one for each measure wanted, of all elements (readers want none left out), 0 on points and lines.
void msh__write_element_data(Writer *w, const Selection *s, const NumberedBlock *block, size_t n, const OutOptions *o);
// $MeshFormat with the byte-order mark of binary files.
void msh__write_format(Writer *w, const char *version, const OutOptions *o);

// The one tag of formats with one: the entity's, or its first group's.
int select__tag(const MeshEntity *e, const OutOptions *o);
// A line "x y z" for each node, after the prefix.
void select__write_points(Writer *w, const Selection *s, const char *prefix);
// True if a node is out of the plane z = 0.
bool select__not_flat(const Selection *s);
bool select__in_group(const MeshEntity *e, const MeshGroup *g);
// Name of a group as one word: blanks and the like become underscores; PhysicalLine<tag> and so on if it has none.
void select__group_name(const MeshGroup *g, char *to, size_t cap);

// VTK's number of an element type, 0 if it has none, and its order of nodes: vtk[i] = ours[perm[i]].
int vtk__cell_type(ElemType t);
int vtk__order(ElemType t, uint8_t perm[ELEM_MAX_NODES]);
const char *vtk__refuses(const Selection *s);

// First physical tag of an entity without its sign, or 0.
static inline int select__physical(const MeshEntity *e)
{
  return e->physical.len ? abs(e->physical.data[0]) : 0;
}
// Element ids are shown by position in the file: nodes of the mesh to numbers in the file.
static inline Vec3 select__xyz(const Selection *s, size_t k)
{
  return vec3_scale(s->scale, mesh_xyz(s->mesh, s->node[k]));
}

// Decimal text at p; these return its end and may write to NUMBER_MAX_TEXT bytes.
static inline char *put_u64(char *p, uint64_t v) { return decimal_put_u64(p, v); }
static inline char *put_double(char *p, double v)
{
  if (v == 0 && !signbit(v)) {
    *p = '0';
    return p + 1;
  }
  return p + number_print(p, v);
}
static inline char *put_char(char *p, char c)
{
  *p = c;
  return p + 1;
}
// "x y z"; room for 3 numbers.
static inline char *put_xyz(char *p, Vec3 x)
{
  p = put_double(p, x.x);
  p = put_double(put_char(p, ' '), x.y);
  return put_double(put_char(p, ' '), x.z);
}
// The numbers of an element's n nodes in the file, counted from `base`, a blank before each; in the order `perm` unless that is NULL.
static inline char *put_node_numbers(char *p, const Selection *s, const uint32_t *node, const uint8_t *perm, size_t n, uint64_t base)
{
  for (size_t i = 0; i < n; i++) p = put_u64(put_char(p, ' '), s->number[node[perm ? perm[i] : i]] + base);
  return p;
}

#endif
