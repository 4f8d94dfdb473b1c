// base.h - types, sentinels and macros that every file may use; included first by every .c
// SPDX-License-Identifier: MIT
#ifndef BASE_BASE_H
#define BASE_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The one "no such index" value of every 32-bit index space (VertId, TriId, EdgeId, NodeId, ...).
#define NONE UINT32_MAX

#define ARRAY_LEN(a) (sizeof(a) / sizeof((a)[0]))
#define MIN(a, b) ((a) < (b) ? (a) : (b))
#define MAX(a, b) ((a) > (b) ? (a) : (b))

#define PRINTF_LIKE(fmt, args) __attribute__((format(printf, fmt, args)))
#define NORETURN __attribute__((noreturn))
#define NOINLINE __attribute__((noinline))
#define LIKELY(x) __builtin_expect(!!(x), 1)
#define UNLIKELY(x) __builtin_expect(!!(x), 0)
#define UNUSED __attribute__((unused))
#define CONST_FUNCTION __attribute__((const)) // the result depends on the arguments alone: loops need call it but once

// Exit codes of the program (docs/architecture.md). `meshgen diff` alone uses diff(1)'s.
typedef enum {
  EXIT_GOOD = 0,       // everything asked for was done
  EXIT_INPUT = 1,      // error in script, option or geometry; nothing written
  EXIT_USAGE = 2,      // wrong command line
  EXIT_ENVIRONMENT = 3,// file, memory, disk
  EXIT_PARTIAL = 4,    // -keep_going: written although a face failed or the audit found something
} ExitCode;

#include "base/banned.h"
#include "base/check.h"

#endif
