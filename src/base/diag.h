// diag.h - messages to the user with source positions: errors, warnings, notes, and the log
// SPDX-License-Identifier: MIT
#ifndef BASE_DIAG_H
#define BASE_DIAG_H

#include "base/base.h"

// A place in a script: index of the file as given by diag_add_file, line and column from 1. Line 0: no place.
typedef struct {
  uint32_t file, line, col;
} SrcLoc;
#define NO_LOC ((SrcLoc){0, 0, 0})

typedef enum { DIAG_NOTE, DIAG_WARNING, DIAG_ERROR } DiagKind;

// What -v says (Gmsh's numbers): 0 nothing, 1 errors, 2 and warnings, 3 and Printf, 4 and info, 5 default, 99 debug.
enum { LOG_SILENT, LOG_ERROR, LOG_WARNING, LOG_PRINTF, LOG_INFO, LOG_DEFAULT, LOG_DEBUG = 99 };

// One message, kept for reports (--json) and for merging; text has no trailing newline.
typedef struct {
  DiagKind kind;
  SrcLoc loc;
  char *text;
  const char *format; // what it was made of: warnings of one format and place are like each other
} DiagMessage;

typedef struct Diag Diag;

// A sink that prints to stderr as messages arrive (print = true), or only collects (print = false; for workers
// and tests). Free with diag_free. Not thread-safe: give each worker a child and merge in a fixed order.
Diag *diag_new(bool print);
void diag_free(Diag *d);
// A printing sink with the settings of another, whose messages go to f: for inputs of a batch, which end in any order.
// What it counted is added to the other by diag_absorb, which prints `text` (what f got) and frees it.
Diag *diag_sibling(const Diag *d, FILE *f);
void diag_absorb(Diag *d, Diag *sibling, const char *text);
// A collecting sink that knows the parent's files. diag_merge reports its messages through the parent, in order,
// and frees it.
Diag *diag_child(const Diag *parent);
void diag_merge(Diag *parent, Diag *child);

void diag_set_level(Diag *d, int level); // of the -v scale; what is counted and kept does not depend on it
int diag_level(const Diag *d);
void diag_set_color(Diag *d, bool on);   // of what is printed
void diag_set_log(Diag *d, FILE *f);     // copy without colours of all that is printed; not owned; NULL for none
void diag_set_warnings_are_errors(Diag *d, bool on); // from now on

// Make a source text known, for carets. `text` is not copied and must outlive d. `from` is the place of
// the Include/Merge that named it, or NO_LOC. Returns the file index for SrcLoc (0 is reserved for "no file").
uint32_t diag_add_file(Diag *d, const char *name, const char *text, size_t len, SrcLoc from);
const char *diag_file_name(const Diag *d, uint32_t file);

// `name:line:col: error: text`, the source line, a caret, and the chain of inclusions and of open macro calls.
// With loc.line == 0 just `meshgen: error: text`. A note belongs to the message before it.
void diag_error(Diag *d, SrcLoc loc, const char *fmt, ...) PRINTF_LIKE(3, 4);
void diag_warning(Diag *d, SrcLoc loc, const char *fmt, ...) PRINTF_LIKE(3, 4);
void diag_note(Diag *d, SrcLoc loc, const char *fmt, ...) PRINTF_LIKE(3, 4);
// Name a macro call (or other frame) that messages are inside of; printed as "in macro 'f' called at ...".
void diag_push_frame(Diag *d, const char *what, SrcLoc at);
void diag_pop_frame(Diag *d);

// How many there were, those not printed included.
int diag_errors(const Diag *d);
int diag_warnings(const Diag *d);
enum { DIAG_MAX_ERRORS = 20, DIAG_MAX_WARNINGS = 100, DIAG_MAX_ALIKE = 3 };
// Of warnings that are alike (one statement in a loop, one list with many faults) DIAG_MAX_ALIKE are given; the others are counted,
// and diag_flush says how many they were. Warnings beyond DIAG_MAX_WARNINGS are counted, neither printed nor kept; one message
// says so. Children keep all.
void diag_flush(Diag *d);
// True once DIAG_MAX_ERRORS errors were given: whoever parses should stop. Further errors are counted, not printed.
bool diag_full(const Diag *d);
size_t diag_count(const Diag *d);
const DiagMessage *diag_get(const Diag *d, size_t i);

// Information at LOG_INFO (shown with -v 4 and up) and LOG_DEBUG; on stderr, one line each.
void log_info(Diag *d, const char *fmt, ...) PRINTF_LIKE(2, 3);
void log_debug(Diag *d, const char *fmt, ...) PRINTF_LIKE(2, 3);

// One status line rewritten in place, only when stderr is a terminal and the level is LOG_DEFAULT:
// "meshing  41 %  1234 triangles/s  3 s left". done of all (0: not known) things called `what`, since `began` of time_wall.
// Any message ends the line, and so does log_progress_end. Cheap to call often: at most ten updates a second are drawn, the
// first after half a second.
void log_progress(Diag *d, const char *stage, double done, double all, const char *what, double began);
void log_progress_end(Diag *d);

#endif
