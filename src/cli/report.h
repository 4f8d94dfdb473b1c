// report.h - what was made and how good it is: text for people, JSON for programs, conditions for CI
// SPDX-License-Identifier: MIT
#ifndef CLI_REPORT_H
#define CLI_REPORT_H

#include "cli/job.h"

// Of what --json prints (docs/report.md). Grows when a program that reads it would have to change.
enum { REPORT_VERSION = 2 };

// Print the report of j's mesh to f (nothing at -v 0, nor in a batch, whose summary gets it; one JSON object with --json, of which
// docs/report.md has the schema), then check the -require conditions: EXIT_INPUT and an error per condition that does not hold, EXIT_USAGE for one that cannot be read.
// node_size: wanted edge length at each node for the efficiency index, or NULL.
ExitCode report_print(Job *j, const double *node_size, FILE *f);

// The report of an input that ended without a mesh to report on, as one JSON object: why is in its messages.
void report_failure(const Job *j, ExitCode status, FILE *f);

#endif
