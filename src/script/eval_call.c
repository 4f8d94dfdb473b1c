// eval_call.c - the functions
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/eval_int.h"

#include <ctype.h>
#include <time.h>
#include <unistd.h>

#include "base/file.h"
#include "base/number.h"
#include "script/fold.h"
#include "script/function.h"

// ---- numbers ---------------------------------------------

static double name_exists(Script *s, const Node *name)
{
  if (struct_find(s, script__name_text(s, name))) return 1;
  return name->kind != NODE_OPTION && struct_find(s, struct_name_text(s, name)); // a Struct
}

static double find_members(Script *s, const Node *n)
{
  DoubleVec *a = script__take(s), *b = script__take(s);
  eval_list(s, n->kid[0], a);
  eval_list(s, n->kid[1], b);
  double found = 0;
  if (script__charge(s, a->len * b->len / 8, n->loc) && a->len * b->len <= 10u * LIMIT_WORK)
    for (size_t i = 0; i < a->len; i++)
      for (size_t j = 0; j < b->len; j++) found += a->data[i] == b->data[j];
  script__give(s, b);
  script__give(s, a);
  return found;
}

static double server_number(Script *s, const Node *n)
{
  const Parameter *p = script__parameter(s, eval_text(s, n->kid[0]), false);
  if (p && !p->text && p->list.len) return p->list.data[0];
  return n->n > 1 ? eval_number(s, n->kid[1]) : 0;
}

// The numbers that rand() of the GNU C library gives from its first seed on, over RAND_MAX, as scripts with Rand were seen by their
// authors: x[i] = x[i - 3] + x[i - 31] on 32 bits, of which the last is dropped, after 310 steps unused.
static double random_share(Script *s)
{
  uint32_t *x = s->random;
  if (!s->random_at) {
    x[0] = 1;
    for (int i = 1; i < 31; i++) x[i] = (uint32_t)(16807ull * x[i - 1] % 2147483647u);
    for (s->random_at = 34; s->random_at < 344; s->random_at++) x[s->random_at % 31] += x[(s->random_at + 28) % 31];
  }
  uint32_t i = s->random_at++ % 31;
  if (s->random_at == 344 + 31) s->random_at = 344;
  x[i] += x[(i + 28) % 31];
  return (x[i] >> 1) / 2147483647.0;
}

double call_number(Script *s, const Node *n)
{
  const FunctionRow *f = function_at(n->op);
  if (f->f1) return f->f1(eval_number(s, n->kid[0]));
  if (f->f2) {
    double a = eval_number(s, n->kid[0]), b = eval_number(s, n->kid[1]);
    return f->f2(a, b);
  }
  switch (n->word) {
  case KW_Rand: return eval_number(s, n->kid[0]) * random_share(s);
  case KW_Exists: return name_exists(s, n->kid[0]);
  case KW_GetForced: {
    if (name_exists(s, n->kid[0])) return eval_number(s, n->kid[0]);
    return n->n > 1 ? eval_number(s, n->kid[1]) : 0;
  }
  case KW_FileExists: return access(script__path(s, eval_text(s, n->kid[0])), R_OK) == 0;
  case KW_GetNumber: return server_number(s, n);
  case KW_GetValue: return eval_number(s, n->kid[1]);
  case KW_Find: return find_members(s, n);
  case KW_StrFind: return strstr(eval_text(s, n->kid[0]), eval_text(s, n->kid[1])) != NULL;
  case KW_StrLen: return (double)strlen(eval_text(s, n->kid[0]));
  case KW_StrCmp: {
    int c = strcmp(eval_text(s, n->kid[0]), eval_text(s, n->kid[1]));
    return c < 0 ? -1 : c > 0;
  }
  case KW_TextAttributes: return 0;
  default: break;
  }
  script__error(s, n->loc, "%s gives a text, a number is needed here", words_text(&s->words, n->word));
  return 0;
}

// ---- lists ---------------------------------------------

static void spaced(Script *s, const Node *n, DoubleVec *out)
{
  double a = eval_number(s, n->kid[0]), b = eval_number(s, n->kid[1]), count = eval_number(s, n->kid[2]);
  if (!(count >= 0 && count + (double)out->len <= LIMIT_LIST)) {
    script__error(s, n->loc, "%s of %g members (the limit is %d)", words_text(&s->words, n->word), count,
                  LIMIT_LIST);
    return;
  }
  int m = (int)count;
  if (!script__charge(s, (uint64_t)m / 8, n->loc)) return;
  for (int i = 0; i < m; i++) {
    double x = m == 1 ? a : a + (b - a) * i / (m - 1);
    vec_push(out, n->word == KW_LogSpace ? pow(10, x) : x);
  }
}

// How far from its lowest point a chain of parameter c is h higher.
static double reach(double c, double h)
{
  double e = h / c;
  return c * log1p(e + sqrt(e * (e + 2))); // acosh(1 + e)
}

// Catenary[x0, x1, y0, y1, lowest, n]: heights at n places evenly between the ends, which are not among them.
static void catenary(Script *s, const Node *n, DoubleVec *out)
{
  double v[6];
  for (int i = 0; i < 6; i++) v[i] = eval_number(s, n->kid[i]);
  double width = fabs(v[1] - v[0]), left = v[2] - v[4], right = v[3] - v[4];
  if (!(left >= 0 && right >= 0 && left + right > 0 && width > 0 && isfinite(width + left + right))) {
    script__error(s, n->loc, "there is no chain from (%g, %g) to (%g, %g) whose lowest point is at %g", v[0], v[2], v[1], v[3], v[4]);
    return;
  }
  if (!(v[5] >= 0 && v[5] + (double)out->len <= LIMIT_LIST)) {
    script__error(s, n->loc, "Catenary of %g members (the limit is %d)", v[5], LIMIT_LIST);
    return;
  }
  double lo = -700, hi = 700; // logarithms of c; the span grows with c
  for (int i = 0; i < 100; i++) {
    double mid = (lo + hi) / 2;
    *(reach(exp(mid), left) + reach(exp(mid), right) < width ? &lo : &hi) = mid;
  }
  double c = exp((lo + hi) / 2), at = -reach(c, left);
  int count = (int)v[5];
  if (!script__charge(s, (uint64_t)count, n->loc)) return;
  for (int i = 1; i <= count; i++) {
    double half = (at + width * i / (count + 1)) / (2 * c);
    vec_push(out, v[4] + 2 * c * sinh(half) * sinh(half));
  }
}

static int compare_doubles(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y;
}

static void unique(Script *s, const Node *n, DoubleVec *out)
{
  size_t at = out->len, kept = at;
  eval_list(s, n->kid[0], out);
  if (!script__charge(s, 2 * (out->len - at), n->loc)) return;
  if (out->len > at) qsort(out->data + at, out->len - at, sizeof(double), compare_doubles);
  for (size_t i = at; i < out->len; i++)
    if (i == at || out->data[i] != out->data[i - 1]) out->data[kept++] = out->data[i];
  out->len = kept;
}

static void list_from_file(Script *s, const Node *n, DoubleVec *out)
{
  const char *path = script__path(s, eval_text(s, n->kid[0]));
  size_t len;
  char *text = file_read(path, &len);
  if (!text) {
    script__error(s, n->loc, "cannot read '%s'", path);
    return;
  }
  const char *end = text + len;
  for (const char *p = text; p < end && out->len < LIMIT_LIST;) {
    double v;
    const char *q = number_read(p, end, &v);
    if (q == p) {
      p++;
      continue;
    }
    vec_push(out, v);
    p = q;
  }
  free(text);
}

void call_list(Script *s, const Node *n, DoubleVec *out)
{
  switch (n->word) {
  case KW_LinSpace:
  case KW_LogSpace: spaced(s, n, out); return;
  case KW_Unique: unique(s, n, out); return;
  case KW_ListFromFile: list_from_file(s, n, out); return;
  case KW_List:
    for (uint32_t i = 0; i < n->n; i++) eval_list(s, n->kid[i], out);
    return;
  case KW_Abs:
  case KW_Fabs: {
    size_t at = out->len;
    eval_list(s, n->kid[0], out);
    for (size_t i = at; i < out->len; i++) out->data[i] = fabs(out->data[i]);
    return;
  }
  case KW_Catenary: catenary(s, n, out); return;
  default:
    script__error(s, n->loc, "%s gives texts, numbers are needed here", words_text(&s->words, n->word));
  }
}

// ---- texts ---------------------------------------------

static const char *keep(Script *s, Str *text)
{
  const char *copy = arena_strndup(&s->temp, str_text(text), text->len);
  str_free(text);
  return copy;
}

static const char *concatenated(Script *s, const Node *n)
{
  TextVec parts = {0};
  for (uint32_t i = 0; i < n->n; i++) eval_texts(s, n->kid[i], &parts);
  Str all = {0};
  for (size_t i = 0; i < parts.len; i++) str_append(&all, parts.data[i]);
  vec_free(&parts);
  if (all.len > LIMIT_STRING || !script__charge(s, all.len / 64, n->loc)) {
    if (all.len > LIMIT_STRING)
      script__error(s, n->loc, "this text would have %zu bytes (the limit is %d)", all.len, LIMIT_STRING);
    str_clear(&all);
  }
  return keep(s, &all);
}

static const char *formatted(Script *s, const Node *n)
{
  const char *format = eval_text(s, n->kid[0]);
  DoubleVec *v = script__take(s);
  for (uint32_t i = 1; i < n->n; i++) eval_list(s, n->kid[i], v);
  Str out = {0};
  format_numbers(s, n->loc, format, v->data, v->len, &out);
  script__give(s, v);
  return keep(s, &out);
}

static const char *replaced(Script *s, const Node *n)
{
  const char *in = eval_text(s, n->kid[0]), *old = eval_text(s, n->kid[1]), *new = eval_text(s, n->kid[2]);
  size_t step = strlen(old);
  if (!step) return in;
  Str out = {0};
  for (const char *hit; (hit = strstr(in, old)) != NULL; in = hit + step) {
    str_append_n(&out, in, (size_t)(hit - in));
    str_append(&out, new);
    if (out.len > LIMIT_STRING) {
      script__error(s, n->loc, "this text would have more than %d bytes", LIMIT_STRING);
      str_clear(&out);
      return keep(s, &out);
    }
  }
  str_append(&out, in);
  script__charge(s, out.len / 64, n->loc);
  return keep(s, &out);
}

static const char *part_of(Script *s, const Node *n)
{
  const char *text = eval_text(s, n->kid[0]);
  size_t len = strlen(text);
  double from = eval_number(s, n->kid[1]), count = n->n > 2 ? eval_number(s, n->kid[2]) : (double)len;
  if (!(from >= 0 && from <= (double)len)) return "";
  size_t at = (size_t)from, want = count < 0 ? 0 : count > (double)len ? len : (size_t)count;
  return arena_strndup(&s->temp, text + at, MIN(want, len - at));
}

static const char *in_case(Script *s, const Node *n)
{
  char *text = arena_strdup(&s->temp, eval_text(s, n->kid[0]));
  for (char *p = text; *p; p++) {
    unsigned char c = (unsigned char)*p;
    if (n->word == KW_UpperCase)
      *p = (char)toupper(c);
    else if (n->word == KW_LowerCase || (p > text && p[-1] != ' ' && p[-1] != '_'))
      *p = (char)tolower(c);
  }
  return text;
}

static const char *without_extension(Script *s, const char *path)
{
  const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
  if (!dot || (slash && dot < slash)) return path;
  return arena_strndup(&s->temp, path, (size_t)(dot - path));
}

static const char *folder_of(Script *s, const char *path)
{
  const char *slash = strrchr(path, '/');
  return slash ? arena_strndup(&s->temp, path, (size_t)(slash - path) + 1) : "";
}

static const char *absolute(Script *s, const char *path)
{
  char *real = realpath(path, NULL);
  if (!real) return path;
  const char *copy = arena_strdup(&s->temp, real);
  free(real);
  return copy;
}

const char *call_text(Script *s, const Node *n)
{
  switch (n->word) {
  case KW_StrCat: return concatenated(s, n);
  case KW_Sprintf: return formatted(s, n);
  case KW_StrReplace: return replaced(s, n);
  case KW_StrSub: return part_of(s, n);
  case KW_StrChoice: return eval_text(s, n->kid[eval_number(s, n->kid[0]) != 0 ? 1 : 2]);
  case KW_UpperCase:
  case KW_LowerCase:
  case KW_LowerCaseIn: return in_case(s, n);
  case KW_StrPrefix: return without_extension(s, eval_text(s, n->kid[0]));
  case KW_StrRelative: {
    const char *path = eval_text(s, n->kid[0]), *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
  }
  case KW_DirName: return folder_of(s, eval_text(s, n->kid[0]));
  case KW_AbsolutePath: return absolute(s, script__path(s, eval_text(s, n->kid[0])));
  case KW_FixRelativePath: return script__path(s, eval_text(s, n->kid[0]));
  case KW_CurrentDirectory: {
    const char *dir = folder_of(s, s->file ? s->file : "");
    return *dir ? dir : "./";
  }
  case KW_CurrentFileName: {
    const char *slash = s->file ? strrchr(s->file, '/') : NULL;
    return slash ? slash + 1 : s->file ? s->file : "";
  }
  case KW_GetEnv: {
    const char *v = getenv(eval_text(s, n->kid[0]));
    return v ? v : "";
  }
  case KW_GetString: {
    const Parameter *p = script__parameter(s, eval_text(s, n->kid[0]), false);
    if (p && p->text) return arena_strdup(&s->temp, p->text);
    return n->n > 1 ? eval_text(s, n->kid[1]) : "";
  }
  case KW_GetForcedStr:
    if (name_exists(s, n->kid[0])) return eval_text(s, n->kid[0]);
    return n->n > 1 ? eval_text(s, n->kid[1]) : "";
  case KW_GetStringValue: return eval_text(s, n->kid[1]);
  case KW_NameToString: return script__name_text(s, n->kid[0]);
  case KW_Today: {
    char text[64];
    time_t now = time(NULL);
    struct tm tm;
    localtime_r(&now, &tm);
    strftime(text, sizeof text, "%a %b %e %H:%M:%S %Y", &tm);
    return arena_strdup(&s->temp, text);
  }
  case KW_OnelabAction: return "compute";
  case KW_GmshExecutableName:
    return s->options->General_ExecutableFileName ? s->options->General_ExecutableFileName : "meshgen";
  default: UNREACHABLE();
  }
}

void call_texts(Script *s, const Node *n, TextVec *out)
{
  for (uint32_t i = 0; i < n->n; i++) eval_texts(s, n->kid[i], out);
}
