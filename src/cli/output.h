// output.h - where a job's mesh goes and in what format
// SPDX-License-Identifier: MIT
#ifndef CLI_OUTPUT_H
#define CLI_OUTPUT_H

#include "cli/job.h"
#include "out/formats.h"

// What can be known wrong of inputs, outputs and format before any work is done: EXIT_USAGE after an error.
ExitCode output_check(const Cli *c, Diag *diag);

// What the job's options say to the writers.
OutOptions output_options(const Job *j);

// Write the job's mesh to path. format: a name, or NULL for what the command line, Mesh.Format or the extension say.
ExitCode output_mesh(Job *j, const char *path, const char *format);

// Write the mesh to every -o of the command line (a folder: under the input's name), or beside the input without any.
ExitCode output_all(Job *j);

// Write the model, unrolled, to the first -o or beside the input.
ExitCode output_model(Job *j);

#endif
