// batch.h - several inputs in one call: over the threads, one line of summary each, one exit status
// SPDX-License-Identifier: MIT
#ifndef CLI_BATCH_H
#define CLI_BATCH_H

#include "cli/cli.h"

// Run every input of c. What each says (messages, Printf, --json) is printed in the order of the inputs, whole, as soon as those
// before it are done, followed by its line of summary; a line with totals ends the batch. The lines go to standard output, with
// --json to standard error. Returns the least exit status that is not 0, or 0.
ExitCode batch_run(const Cli *c, Diag *diag);

#endif
