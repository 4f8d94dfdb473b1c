// formats.h - the table of file formats: finding one by name or extension, writing and reading meshes
// SPDX-License-Identifier: MIT
#ifndef OUT_FORMATS_H
#define OUT_FORMATS_H

#include "base/base.h"
#include "base/diag.h"
#include "mesh/mesh.h"
#include "mesh/mesh_diff.h"
#include "mesh/mesh_measure.h"

// What the options say about writing. Zero is a good default for every member.
typedef struct {
  bool binary;               // where the format has a binary variant
  bool save_all;             // elements that are in no physical group too
  bool no_orphans;           // leave out nodes of no element where the format would have them (MSH 4)
  bool save_parametric;      // parameters of nodes on curves (MSH)
  double scaling;            // of written coordinates; 0 means 1
  uint64_t first_node, first_element; // smallest numbers; 0 means 1
  int element_tag;           // for formats with one tag: 0, 1 elementary, 2 physical, 3 part
  // inp and unv, a bit per dimension of a group:
  unsigned node_sets;        // gets a set of nodes
  unsigned no_element_sets;  // gets no set of elements
  unsigned no_elements;      // its elements are not written at all (inp)
  int stl_solids;            // 0 one solid, 1 one per face, 2 one per group
  const char *title;         // line of text in formats that have one; NULL for the program's name
  unsigned cell_data;        // bit k: the values of Measure k of all elements, 0 on points and lines (MSH 2 and 4, VTK, VTU)
  bool sync;                 // wait until the file is on the disk
  // meshes in parts (mesh/partition.h)
  bool no_part_topology;     // MSH: entities of parts need not hang together; none between parts
  bool part_groups;          // MSH: groups of parts, in MSH 2 if part_new_style
  bool part_new_style;       // MSH 2: elements are on entities of parts
  bool part_ghosts;          // MSH: ghost cells
  bool part_split;           // a file for each part: name_1.msh, ...
  int threads;               // as for thread_for; never changes a byte
  // pictures
  int color;                 // 0: by group; COLOR_BY_PART; else 1 + a Measure
  int width;                 // pixels; 0 means 1400
  double window[4];          // least x and y, then largest, of what is drawn; all 0: the whole mesh
  int mark_worst;            // elements of least quality to mark with a ring
  bool histogram;            // at the right: of gamma where groups are coloured; a coloured measure always has its own
} OutOptions;

enum { COLOR_BY_PART = -1 };

typedef struct Format Format;

// By name ("msh2", "vtk", ...), case-insensitive, or by the extension of a path; NULL if there is none.
const Format *format_find(const char *name);
const Format *format_of_path(const char *path);
const char *format_name(const Format *f);
const char *format_help(const Format *f); // one line
const char *format_extensions(const Format *f); // separated by blanks, without the dot
bool format_writes(const Format *f);
bool format_reads(const Format *f);
// The k-th row of the table, NULL after the last one.
const Format *format_at(size_t k);

// Write the part of m that the saving rule selects. format: a name, or NULL or "auto" for the path's extension. Path "-"
// is standard output. What goes wrong is reported to d: EXIT_USAGE for an unknown format, EXIT_ENVIRONMENT for what the
// system refuses, EXIT_INPUT when the mesh cannot be said in that format; then the target is as it was.
ExitCode out_write(const Mesh *m, const char *path, const char *format, const OutOptions *o, Diag *d);

// Warn, once, of surface elements (or curve elements of a mesh without surfaces) that the saving rule drops.
void out_warn_dropped(const Mesh *m, const OutOptions *o, Diag *d);

// Picture (.png, .svg, .pdf) of b, with the elements that a lacks filled and those that only a has outlined.
ExitCode out_write_diff(const Mesh *a, const Mesh *b, const MeshDiff *d, const char *path, const OutOptions *o, Diag *diag);

// Read a mesh: format as for out_write, told from the contents when the extension does not say. NULL after an error that
// gives line or byte offset. *status (may be NULL) gets EXIT_ENVIRONMENT or EXIT_INPUT then. The caller frees with mesh_free.
// threads: 0 for one per processor.
Mesh *out_read(const char *path, const char *format, int threads, Diag *d, ExitCode *status);
// The same from memory; name is for messages.
Mesh *out_read_memory(const char *text, size_t len, const char *name, const char *format, Diag *d);

#endif
