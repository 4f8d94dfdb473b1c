// pipeline.h - from an input file to its outputs: script, model, curves, faces, audit, files, report
// SPDX-License-Identifier: MIT
#ifndef CLI_PIPELINE_H
#define CLI_PIPELINE_H

#include "cli/job.h"

// Run one input. What it prints goes to out, and to summary (may be NULL) instead of a report as text.
ExitCode pipeline_run_one(const Cli *c, const char *input, Diag *diag, int threads, FILE *out, JobSummary *summary);

// Run everything the command line asks for. Messages go to diag. Returns the exit status.
ExitCode pipeline_run(const Cli *c, Diag *diag);

#endif
