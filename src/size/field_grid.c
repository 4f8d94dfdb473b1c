// field_grid.c - fields by tables: Structured (a regular grid in a file) and PostView (a view)
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>

#include "base/file.h"
#include "base/number.h"
#include "size/size_int.h"

// ---- Structured ---------------------------------------------------------------------------------------------------------

typedef struct {
  double origin[3], step[3];
  int32_t n[3];
  double *value; // z fastest
  bool set_outside;
  double outside;
} Grid;

// The file as named, or else beside the script that names it.
static char *read_beside(const Diag *diag, const FieldValue *v, size_t *len)
{
  char *text = file_read(v->text, len);
  const char *script = v->loc.line ? diag_file_name(diag, v->loc.file) : NULL, *slash = script ? strrchr(script, '/') : NULL;
  if (text || !slash || v->text[0] == '/') return text;
  Str path = {0};
  str_append_n(&path, script, (size_t)(slash - script) + 1);
  str_append(&path, v->text);
  int first = errno;
  text = file_read(str_text(&path), len);
  if (!text) errno = first;
  str_free(&path);
  return text;
}

static const char *next_number(const char *s, const char *end, double *v)
{
  while (s < end && isspace((unsigned char)*s)) s++;
  const char *after = number_read(s, end, v);
  return after == s ? NULL : after;
}

static bool sane_counts(Grid *g, size_t *total)
{
  *total = 1;
  for (int i = 0; i < 3; i++) {
    if (g->n[i] < 1 || (g->step[i] <= 0 && g->n[i] > 1)) return false;
    *total *= (size_t)g->n[i];
    if (*total > (size_t)1 << 31) return false;
  }
  return true;
}

static bool parse_text(Grid *g, const char *s, const char *end, size_t *total)
{
  double head[9];
  for (int i = 0; i < 9; i++)
    if (!(s = next_number(s, end, &head[i]))) return false;
  for (int i = 0; i < 3; i++) {
    g->origin[i] = head[i], g->step[i] = head[3 + i];
    if (!(head[6 + i] >= 1 && head[6 + i] < 2e9)) return false;
    g->n[i] = (int32_t)head[6 + i];
  }
  if (!sane_counts(g, total) || *total > (size_t)(end - s)) return false;
  g->value = mem_alloc(*total * sizeof *g->value);
  for (size_t i = 0; i < *total; i++)
    if (!(s = next_number(s, end, &g->value[i]))) return false;
  return true;
}

static bool parse_binary(Grid *g, const char *s, size_t len, size_t *total)
{
  enum { HEAD = 6 * 8 + 3 * 4 };
  if (len < HEAD) return false;
  memcpy(g->origin, s, 24);
  memcpy(g->step, s + 24, 24);
  memcpy(g->n, s + 48, 12);
  if (!sane_counts(g, total) || len < HEAD + *total * 8) return false;
  g->value = mem_alloc(*total * sizeof *g->value);
  memcpy(g->value, s + HEAD, *total * 8);
  return true;
}

static bool build_structured(SizeField *s, Node *n, Diag *diag)
{
  (void)s;
  Grid *g = n->data = mem_zalloc(sizeof *g);
  const FieldValue *v = field__value(n->field, "FileName");
  g->set_outside = field__number(n->field, "SetOutsideValue") != 0;
  g->outside = field__number(n->field, "OutsideValue");
  size_t len, total;
  char *text = read_beside(diag, v, &len);
  if (!text) {
    diag_error(diag, v->loc, "field %d (Structured): cannot read '%s': %s", n->field->id, v->text, strerror(errno));
    return false;
  }
  bool is_text = field__number(n->field, "TextFormat") != 0;
  bool good = is_text ? parse_text(g, text, text + len, &total) : parse_binary(g, text, len, &total);
  free(text);
  if (!good)
    diag_error(diag, v->loc, "field %d (Structured): '%s' is not a %s grid: origin, steps, counts, values", n->field->id, v->text,
               is_text ? "text" : "binary");
  return good;
}

static void release_grid(Node *n)
{
  Grid *g = n->data;
  if (g) free(g->value);
}

static double grid_at(const Grid *g, const double p[3])
{
  int32_t i[3];
  double t[3];
  for (int k = 0; k < 3; k++) {
    double x = g->n[k] > 1 ? (p[k] - g->origin[k]) / g->step[k] : 0, top = g->n[k] - 1;
    if (g->set_outside && (x < 0 || x > top)) return g->outside;
    x = fmin(fmax(x, 0), top);
    i[k] = MIN((int32_t)x, MAX(g->n[k] - 2, 0));
    t[k] = x - i[k];
  }
  double sum = 0;
  for (int c = 0; c < 8; c++) {
    double w = 1;
    size_t at = 0;
    for (int k = 0; k < 3; k++) {
      bool up = c >> k & 1;
      w *= up ? t[k] : 1 - t[k];
      at = at * (size_t)g->n[k] + (size_t)MIN(i[k] + up, g->n[k] - 1);
    }
    if (w > 0) sum += w * g->value[at];
  }
  return sum;
}

static void eval_structured(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  (void)e, (void)w;
  for (size_t i = 0; i < count; i++) out[i] = grid_at(n->data, (double[3]){p->x[i], p->y[i], p->z[i]});
}

const FieldOps ops_structured = {build_structured, eval_structured, release_grid, NULL};

// ---- PostView: the value at the nearest place of the nearest element -------------------------------------------------------

typedef struct {
  const View *view;
  Nearest *tree;     // elements as balls
  bool crop, closest;
  double near;       // a place not farther than this from an element is in it
} ViewSearch;

typedef struct {
  double d2, value;
} OnElement;

static OnElement on_segment(const Vec3 *x, const double *v, Vec3 p)
{
  Vec3 d = vec3_sub(x[1], x[0]), r = vec3_sub(p, x[0]);
  double l2 = vec3_dot(d, d), t = l2 > 0 ? fmin(fmax(vec3_dot(r, d) / l2, 0), 1) : 0;
  Vec3 off = vec3_sub(r, vec3_scale(t, d));
  return (OnElement){vec3_dot(off, off), v[0] + t * (v[1] - v[0])};
}

static OnElement nearer(OnElement a, OnElement b)
{
  return b.d2 < a.d2 ? b : a;
}

static OnElement on_triangle(const Vec3 *x, const double *v, Vec3 p)
{
  Vec3 a = vec3_sub(x[1], x[0]), b = vec3_sub(x[2], x[0]), r = vec3_sub(p, x[0]), n = vec3_cross(a, b);
  double n2 = vec3_dot(n, n);
  if (n2 > 0) {
    double s = vec3_dot(vec3_cross(r, b), n) / n2, t = vec3_dot(vec3_cross(a, r), n) / n2;
    if (s >= 0 && t >= 0 && s + t <= 1) {
      double h = vec3_dot(r, n);
      return (OnElement){h * h / n2, v[0] + s * (v[1] - v[0]) + t * (v[2] - v[0])};
    }
  }
  OnElement best = on_segment(x, v, p);
  best = nearer(best, on_segment(x + 1, v + 1, p));
  return nearer(best, on_segment((Vec3[2]){x[2], x[0]}, (double[2]){v[2], v[0]}, p));
}

static OnElement on_element(const View *view, uint32_t k, Vec3 p)
{
  const ViewElement *el = &view->element.data[k];
  const Vec3 *x = view->xyz.data + el->first;
  const double *v = view->value.data + el->first;
  switch (el->ncorner) {
  case 1: return (OnElement){vec3_dot(vec3_sub(p, x[0]), vec3_sub(p, x[0])), v[0]};
  case 2: return on_segment(x, v, p);
  case 3: return on_triangle(x, v, p);
  default:
    return nearer(on_triangle(x, v, p), on_triangle((Vec3[3]){x[0], x[2], x[3]}, (double[3]){v[0], v[2], v[3]}, p));
  }
}

static double distance_to_element(void *ctx, uint32_t k, double u0, double u1, Vec3 p, double *u)
{
  (void)u1;
  *u = u0;
  return on_element(ctx, k, p).d2;
}

static bool find_view(SizeField *s, Node *n, ViewSearch *d, Diag *diag)
{
  int index = s->fields->background_view;
  d->crop = d->closest = true;
  SrcLoc loc = s->fields->background_view_loc;
  if (n->field) {
    const FieldValue *tag = field__value(n->field, "ViewTag");
    index = (int)field__number(n->field, "ViewIndex");
    if (tag->given && tag->number >= 0) index = (int)tag->number - 1; // views are tagged from 1 in their order
    d->crop = field__number(n->field, "CropNegativeValues") != 0;
    d->closest = field__number(n->field, "UseClosest") != 0;
    loc = n->field->loc;
  }
  size_t count = s->fields->view.len;
  if (index < 0 || (size_t)index >= count) {
    diag_error(diag, loc, "there is no View[%d]: %zu views are known", index, count);
    return false;
  }
  d->view = &s->fields->view.data[index];
  if (d->view->element.len) return true;
  diag_error(diag, loc, "View[%d] has no points, lines, triangles or quadrangles to take sizes from", index);
  return false;
}

static bool build_view(SizeField *s, Node *n, Diag *diag)
{
  ViewSearch *d = n->data = mem_zalloc(sizeof *d);
  if (!find_view(s, n, d, diag)) return false;
  d->near = 1e-6 * s->diagonal;
  d->tree = nearest_new(distance_to_element, (void *)(uintptr_t)d->view);
  for (uint32_t k = 0; k < d->view->element.len; k++) {
    const ViewElement *el = &d->view->element.data[k];
    const Vec3 *x = d->view->xyz.data + el->first;
    Vec3 c = {0, 0, 0};
    double r = 0;
    for (int i = 0; i < el->ncorner; i++) c = vec3_add(c, vec3_scale(1.0 / el->ncorner, x[i]));
    for (int i = 0; i < el->ncorner; i++) r = fmax(r, vec3_distance(c, x[i]));
    nearest_add(d->tree, c, c, r * (1 + 1e-12) + 1e-300, k, 0, 0);
  }
  nearest_build(d->tree);
  return true;
}

static void release_view(Node *n)
{
  ViewSearch *d = n->data;
  if (d) nearest_free(d->tree);
}

static void eval_view(SizeEval *e, const Node *n, Where w, const Places *p, size_t count, double *out)
{
  (void)w;
  const ViewSearch *d = n->data;
  uint32_t *hint = &e->hint[n - e->s->node];
  for (size_t i = 0; i < count; i++) {
    Vec3 at = {p->x[i], p->y[i], p->z[i]};
    NearestHit hit = nearest_query(d->tree, at, INFINITY, *hint);
    *hint = hit.leaf;
    out[i] = hit.curve == NONE || (!d->closest && hit.distance > d->near) ? NO_SIZE : on_element(d->view, hit.curve, at).value;
    if (d->crop && out[i] <= 0) out[i] = NO_SIZE;
  }
}

const FieldOps ops_view = {build_view, eval_view, release_view, NULL};
