// file.h - reading whole files, and writing files that are either complete or absent
// SPDX-License-Identifier: MIT
#ifndef BASE_FILE_H
#define BASE_FILE_H

#include "base/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// Whole file (or standard input when path is "-") into a fresh buffer with a NUL after the last byte.
// Returns the buffer (caller frees) and its length in *len; NULL with errno set on failure (EFBIG over 4 GiB, of a device 64 MiB).
char *file_read(const char *path, size_t *len);

// A whole file to look at: mapped where that saves copying it, else read. A NUL follows the last byte.
typedef struct {
  const char *text;
  size_t len;
  bool mapped;
} FileView;

// As file_read. False with errno set on failure; release with file_view_close. While a file is mapped, whoever makes it shorter
// makes the system send SIGBUS.
bool file_view_open(FileView *v, const char *path);
void file_view_close(FileView *v);

// A buffered writer. The bytes go to a temporary beside the target; writer_close moves it into place, so that
// a reader sees the old file or the complete new one, never a part. "-" writes to standard output, and what is
// not a regular file (a device, a pipe) is written directly.
typedef struct Writer Writer;

// NULL with errno set when the temporary cannot be made. `path` is copied.
Writer *writer_open(const char *path);

// These collect errors; nothing needs checking before writer_close.
void writer_bytes(Writer *w, const void *p, size_t n);
void writer_str(Writer *w, const char *s);
void writer_printf(Writer *w, const char *fmt, ...) PRINTF_LIKE(2, 3);
void writer_char(Writer *w, char c);
void writer_u64(Writer *w, uint64_t v); // decimal
void writer_i64(Writer *w, int64_t v);
void writer_double(Writer *w, double v); // shortest decimal text that reads back to v

// Room for n bytes (n <= 64 KiB) at the returned address; follow with writer_commit of the bytes used. The fast path.
char *writer_reserve(Writer *w, size_t n);
void writer_commit(Writer *w, size_t n);

// Prints items from .. to-1 at p; returns the end. It depends on its arguments alone.
typedef char *(*WriterPut)(char *p, const void *ctx, size_t from, size_t to);
// n items in order, each of at most `room` bytes (which put may write to; room <= 4 KiB). Many of them are printed by several
// threads; the bytes are the same whatever their number.
void writer_items(Writer *w, size_t n, size_t room, WriterPut put, const void *ctx);
// How many threads that may be; 1 if this is not called, 0: one per processor.
void writer_threads(Writer *w, int threads);

// Have writer_close wait until the bytes are on the disk: the file then survives a loss of power too.
void writer_sync(Writer *w);

// Flush, rename. 0, or the errno of the first thing that went wrong, in which case nothing is left behind
// and an old file of that name is untouched. Frees w.
int writer_close(Writer *w);

// Give up: remove the temporary, leave the target as it was. Frees w.
void writer_abandon(Writer *w);

// Remove all temporaries of open writers; async-signal-safe, for signal handlers and out-of-memory exits.
void file_remove_temporaries(void);

#ifdef __cplusplus
}
#endif

#endif
