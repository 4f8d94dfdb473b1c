// diag.c - messages to the user with source positions: errors, warnings, notes, and the log
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/diag.h"

#include <math.h>
#include <stdarg.h>
#include <unistd.h>

#include "base/map.h"
#include "base/mem.h"
#include "base/stats.h"
#include "base/str.h"

typedef struct {
  char *name;
  const char *text;
  size_t len;
  SrcLoc from;
} SourceFile;

typedef struct {
  char *what;
  SrcLoc at;
} Frame;

// Warnings of one format at one place: how many came, and the text of the first one that was held back.
typedef struct {
  SrcLoc loc;
  size_t n;
  char *text;
} Alike;

struct Diag {
  bool print, color, werror;
  int level, errors, warnings;
  FILE *log, *stream;
  const Diag *parent; // of a child: where file indices below first_file are found
  uint32_t first_file;
  bool line_open; // a progress line is on the terminal
  double last_progress; // of time_wall
  bool last_shown; // the message before was printed (notes follow it)
  bool dropped;    // the message before was a warning too many (its notes go with it)
  int given;       // warnings that were not held back
  Vec(Alike) alike;
  Map alike_at;    // place and format -> its index there
  Vec(SourceFile) files;
  Vec(Frame) frames;
  Vec(DiagMessage) messages;
};

Diag *diag_new(bool print)
{
  Diag *d = mem_zalloc(sizeof *d);
  d->print = print;
  d->level = LOG_DEFAULT;
  d->first_file = 1;
  return d;
}

static void end_progress(Diag *d)
{
  if (!d->line_open) return;
  fputs("\r\033[K", stderr);
  d->line_open = false;
}

// Without the colours.
static void put_plain(FILE *f, const char *text)
{
  for (const char *p = text; *p; p++)
    if (*p == '\033')
      p += strcspn(p, "m");
    else
      fputc(*p, f);
}

static void emit(Diag *d, const char *text)
{
  end_progress(d);
  fputs(text, d->stream ? d->stream : stderr);
  if (d->log) put_plain(d->log, text);
}

Diag *diag_sibling(const Diag *d, FILE *f)
{
  Diag *s = diag_new(true);
  s->stream = f;
  s->level = d->level;
  s->werror = d->werror;
  s->color = d->color;
  return s;
}

void diag_absorb(Diag *d, Diag *sibling, const char *text)
{
  if (text && *text) emit(d, text);
  d->errors += sibling->errors;
  d->warnings += sibling->warnings;
  diag_free(sibling);
}

Diag *diag_child(const Diag *parent)
{
  Diag *d = diag_new(false);
  d->parent = parent;
  d->level = parent->level;
  d->first_file = parent->first_file + (uint32_t)parent->files.len;
  return d;
}

void diag_free(Diag *d)
{
  if (!d) return;
  for (size_t i = 0; i < d->files.len; i++) free(d->files.data[i].name);
  for (size_t i = 0; i < d->frames.len; i++) free(d->frames.data[i].what);
  for (size_t i = 0; i < d->messages.len; i++) free(d->messages.data[i].text);
  vec_free(&d->files);
  vec_free(&d->frames);
  vec_free(&d->messages);
  for (size_t i = 0; i < d->alike.len; i++) free(d->alike.data[i].text);
  vec_free(&d->alike);
  map_free(&d->alike_at);
  free(d);
}

void diag_set_level(Diag *d, int level) { d->level = level; }
int diag_level(const Diag *d) { return d->level; }
void diag_set_color(Diag *d, bool on) { d->color = on; }
void diag_set_log(Diag *d, FILE *f) { d->log = f; }
void diag_set_warnings_are_errors(Diag *d, bool on) { d->werror = on; }

uint32_t diag_add_file(Diag *d, const char *name, const char *text, size_t len, SrcLoc from)
{
  SourceFile f = {.name = mem_strdup(name), .text = text, .len = len, .from = from};
  vec_push(&d->files, f);
  return d->first_file + (uint32_t)d->files.len - 1;
}

static const SourceFile *source(const Diag *d, uint32_t file)
{
  while (d && file < d->first_file) d = d->parent;
  if (!d || !file || file - d->first_file >= d->files.len) return NULL;
  return &d->files.data[file - d->first_file];
}

const char *diag_file_name(const Diag *d, uint32_t file)
{
  const SourceFile *f = source(d, file);
  return f ? f->name : "";
}

static void quote_line(Str *out, const SourceFile *f, SrcLoc loc)
{
  const char *p = f->text, *end = f->text + f->len;
  for (uint32_t line = 1; line < loc.line; line++) {
    p = memchr(p, '\n', (size_t)(end - p));
    if (!p) return;
    p++;
  }
  const char *eol = memchr(p, '\n', (size_t)(end - p));
  if (!eol) eol = end;
  if (eol > p && eol[-1] == '\r') eol--;
  enum { WIDEST = 160 };
  size_t len = (size_t)(eol - p), col = loc.col ? loc.col - 1 : 0, skip = 0;
  if (col > len) col = len;
  if (col > WIDEST - 40) skip = col - (WIDEST - 60);
  size_t shown = MIN(len - skip, (size_t)WIDEST);
  str_append(out, "  ");
  for (size_t i = 0; i < shown; i++) {
    char c = p[skip + i];
    str_char(out, (unsigned char)c < ' ' && c != '\t' ? '?' : c);
  }
  str_append(out, "\n  ");
  for (size_t i = skip; i < col; i++) str_char(out, p[i] == '\t' ? '\t' : ' ');
  str_append(out, "^\n");
}

static void print_message(Diag *d, const DiagMessage *m)
{
  static const char *const names[] = {"note", "warning", "error"};
  static const char *const colors[] = {"\033[36m", "\033[35m", "\033[31m"};
  bool shown = m->kind == DIAG_ERROR     ? d->level >= LOG_ERROR && d->errors <= DIAG_MAX_ERRORS
               : m->kind == DIAG_WARNING ? d->level >= LOG_WARNING
                                         : d->last_shown;
  d->last_shown = shown;
  if (!shown || !d->print) return;
  Str out = {0};
  const SourceFile *f = source(d, m->loc.file);
  if (f && m->loc.line)
    str_printf(&out, "%s:%u:%u: ", f->name, m->loc.line, m->loc.col);
  else
    str_printf(&out, "%s: ", f ? f->name : "meshgen");
  const char *on = d->color ? colors[m->kind] : "", *off = d->color ? "\033[0m" : "";
  str_printf(&out, "%s%s:%s %s\n", on, names[m->kind], off, m->text);
  if (f && m->loc.line) quote_line(&out, f, m->loc);
  if (m->kind != DIAG_NOTE) {
    for (size_t i = d->frames.len; i-- > 0;) {
      const Frame *fr = &d->frames.data[i];
      str_printf(&out, "  in %s called at %s:%u:%u\n", fr->what, diag_file_name(d, fr->at.file), fr->at.line,
                 fr->at.col);
    }
    for (const SourceFile *g = f; g && g->from.line; g = source(d, g->from.file))
      str_printf(&out, "  included from %s:%u:%u\n", diag_file_name(d, g->from.file), g->from.line, g->from.col);
  }
  emit(d, str_text(&out));
  str_free(&out);
}

static Alike *find_alike(Diag *d, const char *like, SrcLoc loc)
{
  const uint64_t prime = 1099511628211; // FNV-1a
  uint64_t key = 14695981039346656037u;
  for (const char *p = like; *p; p++) key = (key ^ (unsigned char)*p) * prime;
  key = (((key ^ loc.file) * prime ^ loc.line) * prime ^ loc.col) * prime;
  bool added;
  uint32_t *at = map_slot(&d->alike_at, key, (uint32_t)d->alike.len, &added);
  if (added) vec_push(&d->alike, ((Alike){loc, 0, NULL}));
  return &d->alike.data[*at];
}

// A warning like several before: counted only. Those without a place are said each time.
static bool held_back(Diag *d, const char *like, SrcLoc loc, const char *text)
{
  if (d->parent || !like || !loc.line) return false;
  Alike *a = find_alike(d, like, loc);
  if (++a->n <= DIAG_MAX_ALIKE) return false;
  if (a->n == DIAG_MAX_ALIKE + 1) a->text = mem_strdup(text);
  return true;
}

static void deliver(Diag *d, DiagKind kind, SrcLoc loc, const char *like, char *text)
{
  if (kind == DIAG_WARNING && d->werror) kind = DIAG_ERROR;
  if (kind == DIAG_ERROR) d->errors++;
  if (kind == DIAG_WARNING) d->warnings++;
  bool held = kind == DIAG_WARNING && held_back(d, like, loc, text);
  if (kind == DIAG_WARNING && !held) d->given++;
  if (kind != DIAG_NOTE) d->dropped = held || (kind == DIAG_WARNING && d->given > DIAG_MAX_WARNINGS && !d->parent);
  if (d->dropped) {
    free(text);
    if (kind == DIAG_NOTE || held || d->given > DIAG_MAX_WARNINGS + 1) return;
    text = mem_strdup("there are more warnings, which are not shown");
    loc = NO_LOC;
  }
  DiagMessage m = {kind, loc, text, like};
  vec_push(&d->messages, m);
  print_message(d, &vec_last(&d->messages));
}

void diag_flush(Diag *d)
{
  d->dropped = false;
  for (size_t i = 0; i < d->alike.len; i++) {
    Alike *a = &d->alike.data[i];
    if (!a->text) continue;
    d->last_shown = d->level >= LOG_WARNING;
    size_t more = a->n - DIAG_MAX_ALIKE;
    if (more == 1)
      diag_note(d, a->loc, "one more warning like those here: %s", a->text);
    else
      diag_note(d, a->loc, "%zu more warnings like those here; the first: %s", more, a->text);
    free(a->text);
  }
  vec_clear(&d->alike);
  map_free(&d->alike_at);
}

static char *format(const char *fmt, va_list ap)
{
  va_list again;
  va_copy(again, ap);
  int n = vsnprintf(NULL, 0, fmt, ap);
  char *s = mem_alloc((size_t)MAX(n, 0) + 1);
  vsnprintf(s, (size_t)MAX(n, 0) + 1, fmt, again);
  va_end(again);
  return s;
}

#define DELIVER(kind)                          \
  va_list ap;                                  \
  va_start(ap, fmt);                           \
  deliver(d, kind, loc, fmt, format(fmt, ap)); \
  va_end(ap)

void diag_error(Diag *d, SrcLoc loc, const char *fmt, ...) { DELIVER(DIAG_ERROR); }
void diag_warning(Diag *d, SrcLoc loc, const char *fmt, ...) { DELIVER(DIAG_WARNING); }
void diag_note(Diag *d, SrcLoc loc, const char *fmt, ...) { DELIVER(DIAG_NOTE); }

void diag_merge(Diag *parent, Diag *child)
{
  for (size_t i = 0; i < child->messages.len; i++) {
    DiagMessage *m = &child->messages.data[i];
    deliver(parent, m->kind, m->loc, m->format, m->text);
    m->text = NULL;
  }
  diag_free(child);
}

void diag_push_frame(Diag *d, const char *what, SrcLoc at)
{
  Frame f = {mem_strdup(what), at};
  vec_push(&d->frames, f);
}

void diag_pop_frame(Diag *d)
{
  CHECK(d->frames.len);
  free(vec_pop(&d->frames).what);
}

int diag_errors(const Diag *d) { return d->errors; }
int diag_warnings(const Diag *d) { return d->warnings; }
bool diag_full(const Diag *d) { return d->errors >= DIAG_MAX_ERRORS; }
size_t diag_count(const Diag *d) { return d->messages.len; }
const DiagMessage *diag_get(const Diag *d, size_t i) { return &d->messages.data[i]; }

static void log_line(Diag *d, const char *fmt, va_list ap)
{
  if (!d->print) return;
  char *s = format(fmt, ap);
  Str out = {0};
  str_printf(&out, "%s\n", s);
  emit(d, str_text(&out));
  str_free(&out);
  free(s);
}

void log_info(Diag *d, const char *fmt, ...)
{
  if (d->level < LOG_INFO) return;
  va_list ap;
  va_start(ap, fmt);
  log_line(d, fmt, ap);
  va_end(ap);
}

void log_debug(Diag *d, const char *fmt, ...)
{
  if (d->level < LOG_DEBUG) return;
  va_list ap;
  va_start(ap, fmt);
  log_line(d, fmt, ap);
  va_end(ap);
}

static bool progress_wanted(const Diag *d)
{
  return d->print && !d->stream && d->level >= LOG_DEFAULT && isatty(2);
}

void log_progress_end(Diag *d) { end_progress(d); }

void log_progress(Diag *d, const char *stage, double done, double all, const char *what, double began)
{
  if (!progress_wanted(d)) return;
  double now = time_wall(), spent = now - began;
  if (spent < 0.5 || now - d->last_progress < 0.1) return;
  d->last_progress = now;
  d->line_open = true;
  double rate = done / spent;
  fprintf(stderr, "\r%s", stage);
  if (all > 0) fprintf(stderr, " %3.0f %%", 100 * fmin(1, done / all));
  fprintf(stderr, "  %.3g %s  %.3g %s/s", done, what, rate, what);
  if (all > done && rate > 0) fprintf(stderr, "  %.2g s left", (all - done) / rate);
  fputs("\033[K", stderr);
}
