// points_read.c - point sets and straight-line graphs to triangulate: .xyz, and Triangle's .node and .poly
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/points_read.h"

#include <errno.h>
#include <math.h>
#include <strings.h>

#include "base/file.h"
#include "base/number.h"

typedef struct {
  const char *name, *p, *end; // p: in the line being read, or where the next one begins
  const char *line_end;
  size_t line;
  int64_t first; // index of the first point, 0 or 1
  bool failed;
  Diag *diag;
} Reader;

static void fail(Reader *r, const char *what)
{
  if (!r->failed) diag_error(r->diag, NO_LOC, "%s:%zu: %s", r->name, r->line, what);
  r->failed = true;
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == ','; }

// Go to the next line with something on it. False at the end of the file.
static bool next_line(Reader *r)
{
  while (!r->failed && r->p < r->end) {
    r->line++;
    const char *nl = memchr(r->p, '\n', (size_t)(r->end - r->p));
    r->line_end = nl ? nl : r->end;
    while (r->p < r->line_end && is_blank(*r->p)) r->p++;
    if (r->p < r->line_end && *r->p != '#') return true;
    r->p = nl ? nl + 1 : r->end;
  }
  return false;
}

static void end_line(Reader *r) { r->p = r->line_end < r->end ? r->line_end + 1 : r->end; }

static bool at_end(Reader *r)
{
  while (r->p < r->line_end && is_blank(*r->p)) r->p++;
  return r->p >= r->line_end || *r->p == '#';
}

static double number(Reader *r, const char *what)
{
  double v = 0;
  char text[80];
  if (r->failed) return 0;
  if (at_end(r)) {
    snprintf(text, sizeof text, "%s is missing", what);
    fail(r, text);
    return 0;
  }
  const char *q = number_read(r->p, r->line_end, &v);
  if (q == r->p || (q < r->line_end && !is_blank(*q) && *q != '#') || !isfinite(v)) {
    snprintf(text, sizeof text, "%s is not a finite number", what);
    fail(r, text);
    return 0;
  }
  r->p = q;
  return v;
}

static int64_t integer(Reader *r, int64_t lo, int64_t hi, const char *what)
{
  double v = number(r, what);
  char text[120];
  if (!r->failed && (v != floor(v) || v < (double)lo || v > (double)hi)) {
    snprintf(text, sizeof text, "%s is not a whole number from %lld to %lld", what, (long long)lo, (long long)hi);
    fail(r, text);
  }
  return r->failed ? lo : (int64_t)v;
}

// The line that must come next.
static void expect_line(Reader *r, const char *what)
{
  char text[80];
  if (r->failed || next_line(r)) return;
  snprintf(text, sizeof text, "the file ends before %s", what);
  fail(r, text);
}

static void read_xyz(Reader *r, PointsFile *f)
{
  while (next_line(r)) {
    double x = number(r, "x"), y = number(r, "y");
    vec_push(&f->xy, x);
    vec_push(&f->xy, y);
    if (!at_end(r)) vec_push(&f->z, number(r, "z"));
    end_line(r);
  }
  if (f->z.len != f->xy.len / 2) vec_clear(&f->z);
}

// The section of points. Returns their number.
static size_t read_points(Reader *r, PointsFile *f)
{
  expect_line(r, "the number of points");
  size_t n = (size_t)integer(r, 0, 0x3fffffff, "the number of points");
  if (!at_end(r)) integer(r, 2, 2, "the dimension");
  end_line(r);
  for (size_t i = 0; i < n && !r->failed; i++) {
    expect_line(r, "the last point");
    int64_t k = integer(r, 0, 0x3fffffff, "the point's index");
    if (i == 0) r->first = k;
    if (!r->failed && ((i == 0 && k > 1) || k != r->first + (int64_t)i)) fail(r, "points must be numbered from 0 or 1");
    double x = number(r, "x"), y = number(r, "y");
    vec_push(&f->xy, x);
    vec_push(&f->xy, y);
    end_line(r);
  }
  return n;
}

static void read_segments(Reader *r, PointsFile *f)
{
  expect_line(r, "the number of segments");
  size_t n = (size_t)integer(r, 0, 0x3fffffff, "the number of segments");
  int64_t last = r->first + (int64_t)(f->xy.len / 2) - 1;
  end_line(r);
  for (size_t i = 0; i < n && !r->failed; i++) {
    expect_line(r, "the last segment");
    integer(r, 0, 0x3fffffff, "the segment's index");
    for (int k = 0; k < 2; k++) vec_push(&f->ends, (uint32_t)(integer(r, r->first, last, "the segment's end") - r->first));
    int64_t mark = at_end(r) ? 0 : integer(r, INT32_MIN, INT32_MAX, "the segment's boundary mark");
    vec_push(&f->marks, mark > 0 ? (uint32_t)mark : 0);
    end_line(r);
  }
}

static void read_seeds(Reader *r, PointsFile *f)
{
  if (!next_line(r)) return; // the section of holes may be left out
  size_t n = (size_t)integer(r, 0, 0x3fffffff, "the number of holes");
  end_line(r);
  for (size_t i = 0; i < n && !r->failed; i++) {
    expect_line(r, "the last hole");
    number(r, "the hole's index");
    for (int k = 0; k < 2; k++) vec_push(&f->holes, number(r, "a coordinate of the hole"));
    end_line(r);
  }
  if (!next_line(r)) return;
  n = (size_t)integer(r, 0, 0x3fffffff, "the number of regions");
  end_line(r);
  for (size_t i = 0; i < n && !r->failed; i++) {
    expect_line(r, "the last region");
    number(r, "the region's index");
    for (int k = 0; k < 2; k++) vec_push(&f->regions, number(r, "a coordinate of the region"));
    double label = at_end(r) ? 0 : number(r, "the region's attribute");
    vec_push(&f->labels, label == floor(label) && label >= 1 && label < 1e9 ? (uint32_t)label : (uint32_t)i + 1);
    end_line(r);
  }
}

static bool has_extension(const char *path, const char *ext)
{
  const char *dot = strrchr(path, '.');
  return dot && strcasecmp(dot, ext) == 0;
}

static ExitCode open_reader(Reader *r, const char *path, char **text, Diag *d)
{
  size_t len;
  *text = file_read(path, &len);
  if (!*text) {
    diag_error(d, NO_LOC, "%s: %s", path, strerror(errno));
    return EXIT_ENVIRONMENT;
  }
  *r = (Reader){.name = path, .p = *text, .end = *text + len, .line_end = *text, .diag = d};
  return EXIT_GOOD;
}

// The points of x.poly that stand in x.node; the numbering carries over.
static ExitCode read_sibling(Reader *poly, const char *path, PointsFile *f, Diag *d)
{
  char *node = mem_strdup(path), *text;
  memcpy(node + strlen(node) - 5, ".node", 5);
  Reader r;
  ExitCode status = open_reader(&r, node, &text, d);
  if (status == EXIT_GOOD) {
    read_points(&r, f);
    poly->first = r.first;
    if (r.failed) status = EXIT_INPUT;
  }
  free(text);
  free(node);
  return status;
}

ExitCode points_read(const char *path, PointsFile *f, Diag *d)
{
  memset(f, 0, sizeof *f);
  char *text;
  Reader r;
  ExitCode status = open_reader(&r, path, &text, d);
  if (status != EXIT_GOOD) return status;
  if (has_extension(path, ".node")) read_points(&r, f);
  else if (has_extension(path, ".poly")) {
    if (read_points(&r, f) == 0 && !r.failed) status = read_sibling(&r, path, f, d);
    if (status == EXIT_GOOD) {
      read_segments(&r, f);
      read_seeds(&r, f);
    }
  } else read_xyz(&r, f);
  free(text);
  if (status == EXIT_GOOD && f->xy.len == 0) {
    r.line = MAX(r.line, (size_t)1); // of an empty file
    fail(&r, "the file ends without a point");
  }
  return r.failed ? EXIT_INPUT : status;
}

void points_free(PointsFile *p)
{
  vec_free(&p->xy);
  vec_free(&p->z);
  vec_free(&p->ends);
  vec_free(&p->marks);
  vec_free(&p->holes);
  vec_free(&p->regions);
  vec_free(&p->labels);
}
