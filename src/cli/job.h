// job.h - all that belongs to one input, from its options to its mesh
// SPDX-License-Identifier: MIT
#ifndef CLI_JOB_H
#define CLI_JOB_H

#include "base/stats.h"
#include "cli/cli.h"
#include "mesh/mesh.h"
#include "mesh/mesh1d.h"
#include "model/model.h"
#include "script/script.h"
#include "size/field.h"
#include "size/size.h"

// What a batch says of one input.
typedef struct {
  bool known;              // a mesh was made or read
  size_t nodes, lines, triangles, quads;
  double min_gamma;        // NAN without triangles
} JobSummary;

// Nothing is shared between jobs, so that a batch may run them in parallel.
typedef struct {
  const Cli *cli;
  const char *input;
  Options options;   // the command line's, then the script's
  Model *model;
  FieldSet *fields;
  Script *script;
  ScriptHost host;
  Diag *diag;
  Stats stats;
  Mesh1d *curves;
  Mesh *mesh;        // what -1, -2, `Mesh n;` or a mesh file gave; NULL before
  double *node_size; // wanted edge length at each node of mesh, or NULL
  int mesh_dim;      // of the last meshing; -1: none
  bool reshaped;     // and changed since by RefineMesh, SetOrder, RecombineMesh
  size_t failed_faces;
  double matching_seconds; // processor time of all matchings of triangles to quadrangles
  int threads;
  bool ended;        // the script said Exit
  bool reported;     // the report was printed
  FILE *out;         // what goes to standard output
  JobSummary *summary; // filled instead of printing the report as text; NULL: print it
} Job;

#endif
