// file.c - reading whole files, and writing files that are either complete or absent
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/thread.h"

char *file_read(const char *path, size_t *len)
{
  int fd = strcmp(path, "-") == 0 ? 0 : open(path, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return NULL;
  struct stat st;
  size_t most = UINT32_MAX;
  size_t cap = 1 << 16, n = 0;
  if (fstat(fd, &st) == 0) {
    if (S_ISDIR(st.st_mode)) {
      if (fd) close(fd);
      errno = EISDIR;
      return NULL;
    }
    if (S_ISREG(st.st_mode)) cap = (size_t)st.st_size + 1;
    if (S_ISCHR(st.st_mode)) most = 1 << 26; // /dev/zero has no end
  }
  char *buf = mem_alloc(cap + 1);
  for (;;) {
    if (n == cap) buf = mem_realloc(buf, (cap *= 2) + 1);
    ssize_t r = read(fd, buf + n, MIN(cap - n, (size_t)1 << 30));
    if (r < 0 && errno == EINTR) continue;
    if (r > 0 && (n += (size_t)r) > most) {
      r = -1;
      errno = EFBIG;
    }
    if (r < 0) {
      int e = errno;
      free(buf);
      if (fd) close(fd);
      errno = e;
      return NULL;
    }
    if (r == 0) break;
  }
  if (fd) close(fd);
  buf[n] = 0;
  *len = n;
  return buf;
}

bool file_view_open(FileView *v, const char *path)
{
  enum { WORTH = 1 << 20 };
  struct stat st;
  int fd = strcmp(path, "-") == 0 ? -1 : open(path, O_RDONLY | O_CLOEXEC);
  bool fits = fd >= 0 && fstat(fd, &st) == 0 && S_ISREG(st.st_mode) && st.st_size >= WORTH && st.st_size <= UINT32_MAX &&
              st.st_size % sysconf(_SC_PAGESIZE) != 0; // the rest of the last page is zero: the NUL
  void *p = fits ? mmap(NULL, (size_t)st.st_size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, fd, 0) : MAP_FAILED;
  if (fd >= 0) close(fd);
  if (p != MAP_FAILED) {
    *v = (FileView){p, (size_t)st.st_size, true};
    return true;
  }
  *v = (FileView){0};
  v->text = file_read(path, &v->len);
  return v->text != NULL;
}

void file_view_close(FileView *v)
{
  void *p = (void *)(uintptr_t)v->text;
  if (v->mapped)
    munmap(p, v->len);
  else
    free(p);
}

enum { WRITER_BUF = 1 << 18, MAX_TEMPORARIES = 64, PATH_CAP = 4096 };

struct Writer {
  int fd, error, slot; // slot in temporaries[], or -1 when written directly
  int threads;
  char **part; // a buffer of PART bytes per thread, once several print
  bool sync;
  size_t used;
  char *target;
  char buf[WRITER_BUF];
};

// Names of the temporaries of open writers, so that a signal handler can remove them. The one piece of
// process-wide state: it mirrors the file system.
static struct {
  volatile bool in_use;
  char path[PATH_CAP];
} temporaries[MAX_TEMPORARIES];
static pthread_mutex_t temporaries_lock = PTHREAD_MUTEX_INITIALIZER;

void file_remove_temporaries(void)
{
  for (int i = 0; i < MAX_TEMPORARIES; i++)
    if (temporaries[i].in_use) unlink(temporaries[i].path);
}

static int open_temporary(const char *path, int *slot)
{
  pthread_mutex_lock(&temporaries_lock);
  int i = 0, fd = -1;
  while (i < MAX_TEMPORARIES && temporaries[i].in_use) i++;
  if (i == MAX_TEMPORARIES)
    errno = EMFILE;
  else if (snprintf(temporaries[i].path, PATH_CAP, "%s.tmpXXXXXX", path) >= PATH_CAP)
    errno = ENAMETOOLONG;
  else {
    temporaries[i].in_use = true; // before there is a file: a signal may come as soon as there is
    fd = mkstemp(temporaries[i].path);
    temporaries[i].in_use = fd >= 0;
    *slot = i;
  }
  pthread_mutex_unlock(&temporaries_lock);
  return fd;
}

Writer *writer_open(const char *path)
{
  struct stat st;
  int fd, slot = -1;
  if (strcmp(path, "-") == 0)
    fd = dup(1);
  else if (stat(path, &st) == 0 && !S_ISREG(st.st_mode))
    fd = open(path, O_WRONLY | O_CLOEXEC);
  else {
    if (stat(path, &st) == 0 && access(path, W_OK) != 0) return NULL;
    fd = open_temporary(path, &slot);
  }
  if (fd < 0) return NULL;
  if (slot >= 0) {
    mode_t mask = umask(0);
    umask(mask);
    (void)!fchmod(fd, stat(path, &st) == 0 ? st.st_mode & 0777 : 0666 & ~mask);
  }
  Writer *w = mem_alloc(sizeof *w);
  w->fd = fd;
  w->error = 0;
  w->threads = 1;
  w->part = NULL;
  w->sync = false;
  w->slot = slot;
  w->used = 0;
  w->target = mem_strdup(path);
  return w;
}

static void write_all(Writer *w, const char *p, size_t n)
{
  while (n && !w->error) {
    ssize_t r = write(w->fd, p, MIN(n, (size_t)1 << 30));
    if (r < 0) {
      if (errno != EINTR) w->error = errno;
      continue;
    }
    p += r;
    n -= (size_t)r;
  }
}

static void flush(Writer *w)
{
  write_all(w, w->buf, w->used);
  w->used = 0;
}

void writer_bytes(Writer *w, const void *p, size_t n)
{
  if (n > WRITER_BUF - w->used) flush(w);
  if (n > WRITER_BUF) {
    write_all(w, p, n);
    return;
  }
  memcpy(w->buf + w->used, p, n);
  w->used += n;
}

char *writer_reserve(Writer *w, size_t n)
{
  if (n > WRITER_BUF - w->used) flush(w);
  return w->buf + w->used;
}

void writer_commit(Writer *w, size_t n)
{
  w->used += n;
}

// ---- many items ------------------------------------------------------------------------------------------------------------
enum { BATCH = 1 << 13, PART = 1 << 19 }; // bytes of room taken at once by one thread, and by each of several

void writer_threads(Writer *w, int threads) { w->threads = thread_count(threads); }

typedef struct {
  Writer *w;
  size_t n, per_part, turn; // turn: the part to be written next
  WriterPut put;
  const void *ctx;
  pthread_mutex_t lock;
  pthread_cond_t turned;
} Items;

// Parts are handed out in order, so that whoever waits for its turn waits for one that is being printed.
static void print_part(void *ctx, size_t i, int worker)
{
  Items *t = ctx;
  char **part = &t->w->part[worker];
  if (!*part) *part = mem_alloc(PART);
  size_t from = i * t->per_part;
  char *end = t->put(*part, t->ctx, from, MIN(t->n, from + t->per_part));
  pthread_mutex_lock(&t->lock);
  while (t->turn != i) pthread_cond_wait(&t->turned, &t->lock);
  write_all(t->w, *part, (size_t)(end - *part));
  t->turn++;
  pthread_cond_broadcast(&t->turned);
  pthread_mutex_unlock(&t->lock);
}

static void print_parts(Writer *w, size_t n, size_t room, WriterPut put, const void *ctx)
{
  Items t = {.w = w, .n = n, .per_part = PART / room, .put = put, .ctx = ctx};
  flush(w);
  if (!w->part) w->part = mem_zalloc((size_t)w->threads * sizeof *w->part);
  pthread_mutex_init(&t.lock, NULL);
  pthread_cond_init(&t.turned, NULL);
  thread_for((n + t.per_part - 1) / t.per_part, w->threads, print_part, &t);
  pthread_mutex_destroy(&t.lock);
  pthread_cond_destroy(&t.turned);
}

void writer_items(Writer *w, size_t n, size_t room, WriterPut put, const void *ctx)
{
  enum { WORTH = 4 }; // parts
  if (w->threads > 1 && n / (PART / room) >= WORTH) {
    print_parts(w, n, room, put, ctx);
    return;
  }
  size_t batch = BATCH / room;
  for (size_t from = 0; from < n; from += batch) {
    char *p = writer_reserve(w, BATCH);
    writer_commit(w, (size_t)(put(p, ctx, from, MIN(n, from + batch)) - p));
  }
}

void writer_str(Writer *w, const char *s)
{
  writer_bytes(w, s, strlen(s));
}

void writer_char(Writer *w, char c)
{
  if (w->used == WRITER_BUF) flush(w);
  w->buf[w->used++] = c;
}

void writer_u64(Writer *w, uint64_t v)
{
  writer_commit(w, number_print_u64(writer_reserve(w, NUMBER_MAX_TEXT), v));
}

void writer_i64(Writer *w, int64_t v)
{
  if (v < 0) writer_char(w, '-');
  writer_u64(w, v < 0 ? -(uint64_t)v : (uint64_t)v);
}

void writer_double(Writer *w, double v)
{
  writer_commit(w, number_print(writer_reserve(w, NUMBER_MAX_TEXT), v));
}

void writer_printf(Writer *w, const char *fmt, ...)
{
  va_list ap, again;
  va_start(ap, fmt);
  va_copy(again, ap);
  char *p = writer_reserve(w, 1024);
  int n = vsnprintf(p, 1024, fmt, ap);
  if (n < 1024) {
    w->used += (size_t)MAX(n, 0);
  } else {
    char *big = mem_alloc((size_t)n + 1);
    vsnprintf(big, (size_t)n + 1, fmt, again);
    writer_bytes(w, big, (size_t)n);
    free(big);
  }
  va_end(again);
  va_end(ap);
}

static void forget(Writer *w, bool remove)
{
  if (w->slot >= 0) {
    if (remove) unlink(temporaries[w->slot].path);
    temporaries[w->slot].in_use = false;
  }
  for (int i = 0; w->part && i < w->threads; i++) free(w->part[i]);
  free(w->part);
  free(w->target);
  free(w);
}

void writer_sync(Writer *w) { w->sync = true; }

int writer_close(Writer *w)
{
  flush(w);
  if (w->sync && !w->error && w->slot >= 0 && fsync(w->fd) != 0 && errno != EINVAL) w->error = errno;
  if (close(w->fd) != 0 && !w->error) w->error = errno;
  if (!w->error && w->slot >= 0 && rename(temporaries[w->slot].path, w->target) != 0) w->error = errno;
  int error = w->error;
  forget(w, error != 0);
  return error;
}

void writer_abandon(Writer *w)
{
  close(w->fd);
  forget(w, true);
}
