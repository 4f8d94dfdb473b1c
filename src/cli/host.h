// host.h - what a script may ask the program for in the middle of its text: meshing, saving, printing, statistics, commands
// SPDX-License-Identifier: MIT
#ifndef CLI_HOST_H
#define CLI_HOST_H

#include "cli/job.h"

// The callbacks of a job's script. They act on j, which must not move.
ScriptHost host_of_job(Job *j);

#endif
