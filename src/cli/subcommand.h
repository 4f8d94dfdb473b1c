// subcommand.h - meshgen check, hash and diff: what is done with meshes that exist
// SPDX-License-Identifier: MIT
#ifndef CLI_SUBCOMMAND_H
#define CLI_SUBCOMMAND_H

#include "base/base.h"
#include "base/diag.h"

// True if argv[1] names a subcommand, which was then run, or nearly names one, which was said; *status is the exit status.
bool subcommand_run(int argc, char **argv, Diag *diag, int *status);

#endif
