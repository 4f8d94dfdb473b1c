// delaunay.h - meshgen -delaunay: triangulate points and segments from a file
// SPDX-License-Identifier: MIT
#ifndef CLI_DELAUNAY_H
#define CLI_DELAUNAY_H

#include "base/base.h"
#include "cli/cli.h"

// Read the one input, triangulate, write the outputs (default: the input's name with .msh), report.
ExitCode delaunay_run(const Cli *c, Diag *diag);

#endif
