// picture.c - PNG, SVG and PDF: the triangles, coloured by group or quality, boundary groups, legend and histogram
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <errno.h>
#include <math.h>

#include "mesh/mesh_edges.h"
#include "mesh/mesh_measure.h"
#include "out/canvas.h"
#include "out/out_int.h"

// Pale fills for faces, strong lines for boundary groups; both repeat when there are more groups.
static const Color face_colors[] = {
    {198, 219, 239, 255}, {253, 218, 180, 255}, {199, 233, 192, 255}, {218, 208, 235, 255}, {250, 208, 222, 255},
    {255, 242, 184, 255}, {190, 232, 226, 255}, {226, 216, 200, 255}, {215, 222, 228, 255}, {226, 240, 180, 255},
};
static const Color line_colors[] = {
    {200, 30, 45, 255},  {20, 90, 180, 255},  {20, 130, 70, 255},  {225, 115, 0, 255}, {125, 60, 160, 255},
    {0, 140, 150, 255},  {190, 40, 130, 255}, {120, 85, 50, 255},  {95, 120, 0, 255},  {70, 70, 200, 255},
};
static const Color ink = {35, 40, 48, 255}, gray = {105, 112, 122, 255}, edge_ink = {48, 60, 78, 255};

// Bad is dark red, good is light blue, by way of orange, pale yellow and green: distinct in gray too.
static Color ramp(double t)
{
  static const Color stop[] = {{140, 10, 40, 255}, {230, 90, 50, 255}, {254, 210, 110, 255}, {205, 232, 160, 255},
                               {140, 205, 195, 255}, {130, 178, 222, 255}};
  enum { N = (int)ARRAY_LEN(stop) - 1 };
  t = t > 0 ? fmin(t, 1) * N : 0; // NaN is 0
  int i = MIN((int)t, N - 1);
  double f = t - i;
  const Color a = stop[i], b = stop[i + 1];
  return (Color){(uint8_t)lround(a.r + f * (b.r - a.r)), (uint8_t)lround(a.g + f * (b.g - a.g)),
                 (uint8_t)lround(a.b + f * (b.b - a.b)), 255};
}

typedef struct {
  const Mesh *mesh;
  const OutOptions *o;
  Canvas *canvas;
  MeshEdges edges;
  double *xy;            // 2 per node: pixels
  double edge_px;        // typical edge in pixels
  double width, height;  // of the page
  double left, top, w, h;// where the mesh stands
  Vec3 u, v;             // axes of the view
  double lo_x, hi_y, scale;
  double legend_x, y;    // where the next legend line goes
  DoubleVec pts;         // scratch
  U32Vec start;
} Picture;

// ---- geometry to pixels ---------------------------------------------------------------------------------------------
// Axes of the plane to look at: the plane z = 0 unless the mesh faces elsewhere.
static void choose_axes(const Mesh *m, Vec3 *u, Vec3 *v)
{
  Vec3 n = mesh_area_vector(m, NONE);
  double len = vec3_length(n);
  *u = (Vec3){1, 0, 0};
  *v = (Vec3){0, 1, 0};
  if (len == 0 || fabs(n.z) > (1 - 1e-9) * len) return;
  n = vec3_scale(1 / len, n);
  Vec3 up = fabs(n.z) < 0.9 ? (Vec3){0, 0, 1} : (Vec3){0, 1, 0};
  *v = vec3_sub(up, vec3_scale(vec3_dot(up, n), n));
  *v = vec3_scale(1 / vec3_length(*v), *v);
  *u = vec3_cross(*v, n);
}

static void to_pixel(const Picture *p, Vec3 x, double to[2])
{
  to[0] = p->left + (vec3_dot(x, p->u) - p->lo_x) * p->scale;
  to[1] = p->top + (p->hi_y - vec3_dot(x, p->v)) * p->scale;
}

static void place_nodes(Picture *p)
{
  const Mesh *m = p->mesh;
  choose_axes(m, &p->u, &p->v);
  double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
  p->xy = mem_alloc(2 * m->nnode * sizeof *p->xy);
  for (size_t i = 0; i < m->nnode; i++) {
    Vec3 x = mesh_xyz(m, (uint32_t)i);
    const double c[2] = {vec3_dot(x, p->u), vec3_dot(x, p->v)};
    for (int k = 0; k < 2; k++) {
      lo[k] = fmin(lo[k], c[k]);
      hi[k] = fmax(hi[k], c[k]);
    }
  }
  if (!m->nnode) lo[0] = lo[1] = hi[0] = hi[1] = 0;
  double dx = hi[0] - lo[0], dy = hi[1] - lo[1], page = p->o->width ? p->o->width : 1400;
  double legend = fmax(240, 0.21 * page), margin = 28;
  double room_x = page - legend - 3 * margin, room_y = 0.8 * page;
  double s = fmin(dx > 0 ? room_x / dx : INFINITY, dy > 0 ? room_y / dy : INFINITY);
  if (!isfinite(s)) s = 1;
  p->w = dx * s;
  p->h = dy * s;
  p->left = margin;
  p->top = margin;
  p->legend_x = p->left + p->w + margin;
  p->width = ceil(p->legend_x + legend + margin / 2);
  p->height = ceil(fmax(p->h, 330) + 2 * margin);
  p->top += fmax(0, (p->height - 2 * margin - p->h) / 2);
  p->lo_x = lo[0];
  p->hi_y = hi[1];
  p->scale = s;
  for (size_t i = 0; i < m->nnode; i++) to_pixel(p, mesh_xyz(m, (uint32_t)i), p->xy + 2 * i);
}

static void measure_edges(Picture *p)
{
  double area = 0;
  size_t n = 0;
  for (size_t b = 0; b < p->mesh->nblock; b++) {
    const MeshBlock *k = &p->mesh->block[b];
    if (elem_dim(k->type) != 2) continue;
    n += k->n;
    for (size_t i = 0; i < k->n; i++) {
      const uint32_t *v = k->node + i * (size_t)elem_nodes(k->type);
      int c = elem_corners(k->type);
      double s = 0;
      for (int j = 0; j < c; j++) {
        const double *a = p->xy + 2 * (size_t)v[j], *q = p->xy + 2 * (size_t)v[(j + 1) % c];
        s += a[0] * q[1] - a[1] * q[0];
      }
      area += fabs(s) / 2;
    }
  }
  p->edge_px = n ? 1.5 * sqrt(area / (double)n) : 100;
}

// ---- elements ------------------------------------------------------------------------------------------------------
static void push_point(Picture *p, uint32_t node)
{
  vec_push(&p->pts, p->xy[2 * (size_t)node]);
  vec_push(&p->pts, p->xy[2 * (size_t)node + 1]);
}

// Nodes of edge c of an element in order, without the last one: the corner and the nodes within the edge.
static int edge_nodes(const MeshBlock *k, size_t element, int c, uint32_t to[4])
{
  int within = elem_order(k->type) - 1;
  const uint32_t *v = k->node + element * (size_t)elem_nodes(k->type);
  to[0] = v[c];
  for (int i = 0; i < within; i++) to[1 + i] = v[elem_corners(k->type) + c * within + i];
  return 1 + within;
}

static void begin_polygons(Picture *p)
{
  vec_clear(&p->pts);
  vec_clear(&p->start);
  vec_push(&p->start, 0);
}

static void end_polygon(Picture *p) { vec_push(&p->start, (uint32_t)(p->pts.len / 2)); }

static void fill(Picture *p, Color c, bool together)
{
  canvas_polygons(p->canvas, c, p->pts.data, p->start.data, p->start.len - 1, together);
}

static void push_element(Picture *p, const MeshBlock *k, size_t i)
{
  uint32_t v[4];
  for (int c = 0; c < elem_corners(k->type); c++) {
    int n = edge_nodes(k, i, c, v);
    for (int j = 0; j < n; j++) push_point(p, v[j]);
  }
  end_polygon(p);
}

// Boundary half-edge that begins where h ends: among those out of that node, next[] chains them.
static size_t take_next(const uint32_t *first, uint32_t *next, bool *used, const HalfEdge *e, size_t h)
{
  for (uint32_t k = first[e[h].b]; k != NONE; k = next[k])
    if (!used[k]) return k;
  return SIZE_MAX;
}

// The loops that bound a face, as polygons: half-edges without a twin, chained head to tail.
static void push_loops(Picture *p, uint32_t face)
{
  const Mesh *m = p->mesh;
  Vec(HalfEdge) e = {0};
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t h = p->edges.base[b]; m->block[b].entity == face && h < p->edges.base[b + 1]; h++)
      if (p->edges.twin[h] == NONE) vec_push(&e, mesh_edges_at(&p->edges, m, h));
  uint32_t *first = mem_alloc(m->nnode * sizeof *first), *next = mem_alloc(e.len * sizeof *next);
  bool *used = mem_zalloc(e.len);
  for (size_t i = 0; i < e.len; i++) first[e.data[i].a] = first[e.data[i].b] = NONE;
  for (size_t i = e.len; i-- > 0;) {
    next[i] = first[e.data[i].a];
    first[e.data[i].a] = (uint32_t)i;
  }
  for (size_t i = 0; i < e.len; i++) {
    if (used[i]) continue;
    for (size_t k = i; k != SIZE_MAX; k = take_next(first, next, used, e.data, k)) {
      uint32_t v[4];
      used[k] = true;
      int n = edge_nodes(&m->block[e.data[k].block], e.data[k].element, (int)e.data[k].corner, v);
      for (int j = 0; j < n; j++) push_point(p, v[j]);
    }
    end_polygon(p);
  }
  free(first);
  free(next);
  free(used);
  vec_free(&e);
}

// Index of the colour of a face: that of its first group if it has one, else its own.
static size_t color_index(const Mesh *m, uint32_t entity)
{
  const MeshEntity *e = &m->entity[entity];
  size_t index = 0;
  if (e->physical.len) {
    for (size_t g = 0; g < m->ngroup; g++) {
      if (m->group[g].dim != e->dim) continue;
      if (m->group[g].tag == abs(e->physical.data[0])) return index;
      index++;
    }
    return 0;
  }
  for (size_t g = 0; g < m->ngroup; g++) index += m->group[g].dim == e->dim;
  for (size_t i = 0; i < entity; i++) index += m->entity[i].dim == e->dim && !m->entity[i].physical.len;
  return index;
}

static bool has_elements(const Mesh *m, uint32_t entity)
{
  for (size_t b = 0; b < m->nblock; b++)
    if (m->block[b].entity == entity && m->block[b].n) return true;
  return false;
}

static void fill_by_group(Picture *p)
{
  for (uint32_t f = 0; f < p->mesh->nentity; f++) {
    if (p->mesh->entity[f].dim != 2 || !has_elements(p->mesh, f)) continue;
    begin_polygons(p);
    push_loops(p, f);
    fill(p, face_colors[color_index(p->mesh, f) % ARRAY_LEN(face_colors)], true);
  }
}

// ---- colour by a measure ---------------------------------------------------------------------------------------------
enum { BINS = 40 };

typedef struct {
  Measure what;
  const char *name;
  double largest;    // of the measure: 1, or 60 or 90 degrees
  size_t count[BINS], n;
} Scale;

static Scale scale_of(const Picture *p)
{
  static const char *const titles[MEASURES] = {"quality gamma", "smallest angle", "quality eta", "scaled Jacobian", "kappa 1",
                                               "kappa 2",       "kappa 3",        "kappa 4",     "kappa 5"};
  size_t quads = 0, triangles = 0;
  for (size_t b = 0; b < p->mesh->nblock; b++) {
    if (elem_corners(p->mesh->block[b].type) == 4) quads += p->mesh->block[b].n;
    if (elem_corners(p->mesh->block[b].type) == 3) triangles += p->mesh->block[b].n;
  }
  Measure what = p->o->color ? (Measure)(p->o->color - 1) : MEASURE_GAMMA;
  if (what == MEASURE_GAMMA && quads && !triangles) what = MEASURE_ETA; // which is what gamma is of quadrangles
  return (Scale){.what = what, .name = titles[what], .largest = what != MEASURE_ANGLE ? 1 : quads ? 90 : 60};
}

static int bin_of(const Scale *s, double value)
{
  double t = value / s->largest * BINS;
  return !(t > 0) ? 0 : t >= BINS ? BINS - 1 : (int)t;
}

// The measure of every surface element, in order, counted into the scale's bins. The caller frees.
static DoubleVec measure(const Mesh *m, Scale *s)
{
  DoubleVec value = {0};
  for (size_t b = 0; b < m->nblock; b++)
    if (elem_dim(m->block[b].type) == 2)
      for (size_t i = 0; i < m->block[b].n; i++) {
        vec_push(&value, mesh_measure(m, &m->block[b], i, s->what));
        s->count[bin_of(s, vec_last(&value))]++;
      }
  s->n = value.len;
  return value;
}

static void fill_by_measure(Picture *p, Scale *s)
{
  const Mesh *m = p->mesh;
  DoubleVec value = measure(m, s);
  for (int bin = 0; bin < BINS; bin++) {
    if (!s->count[bin]) continue;
    begin_polygons(p);
    size_t at = 0;
    for (size_t b = 0; b < m->nblock; b++)
      if (elem_dim(m->block[b].type) == 2)
        for (size_t i = 0; i < m->block[b].n; i++)
          if (bin_of(s, value.data[at++]) == bin) push_element(p, &m->block[b], i);
    fill(p, ramp((bin + 0.5) / BINS), false);
  }
  vec_free(&value);
}

// ---- lines -----------------------------------------------------------------------------------------------------------
static void push_polyline(Picture *p, const uint32_t *v, int n)
{
  for (int j = 0; j + 1 < n; j++) {
    push_point(p, v[j]);
    push_point(p, v[j + 1]);
  }
}

static void draw_edges(Picture *p)
{
  const Mesh *m = p->mesh;
  if (p->edge_px < 1.2) return; // a gray haze would hide the colours
  vec_clear(&p->pts);
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t h = p->edges.base[b]; h < p->edges.base[b + 1]; h++) {
      uint32_t twin = p->edges.twin[h], v[5];
      if (twin < EDGE_BAD && twin < h) continue;
      HalfEdge e = mesh_edges_at(&p->edges, m, h);
      int n = edge_nodes(&m->block[b], e.element, (int)e.corner, v);
      v[n++] = e.b;
      push_polyline(p, v, n);
    }
  Color c = edge_ink;
  c.a = (uint8_t)fmin(210, 70 + 16 * p->edge_px);
  canvas_segments(p->canvas, c, fmax(0.2, fmin(1.0, 0.045 * p->edge_px + 0.15)), p->pts.data, p->pts.len / 4);
}

// Line elements of a curve along their nodes: ends are first, the interior follows.
static void push_lines(Picture *p, const MeshBlock *k)
{
  int nodes = elem_nodes(k->type);
  for (size_t i = 0; i < k->n; i++) {
    const uint32_t *v = k->node + i * (size_t)nodes;
    uint32_t w[5] = {v[0]};
    for (int j = 2; j < nodes; j++) w[j - 1] = v[j];
    w[nodes - 1] = v[1];
    push_polyline(p, w, nodes);
  }
}

// Curves without a group first, in dark gray, then those with one in its colour.
static void draw_curves(Picture *p)
{
  const Mesh *m = p->mesh;
  for (int grouped = 0; grouped < 2; grouped++)
    for (size_t b = 0; b < m->nblock; b++) {
      const MeshBlock *k = &m->block[b];
      const MeshEntity *e = &m->entity[k->entity];
      if (elem_dim(k->type) != 1 || grouped != (e->physical.len > 0)) continue;
      vec_clear(&p->pts);
      push_lines(p, k);
      Color c = grouped ? line_colors[color_index(m, k->entity) % ARRAY_LEN(line_colors)] : ink;
      canvas_segments(p->canvas, c, grouped ? 3.2 : 1.8, p->pts.data, p->pts.len / 4);
    }
}

// ---- legend ------------------------------------------------------------------------------------------------------------
static void legend_text(Picture *p, Color c, double size, bool bold, const char *text)
{
  p->y += 1.55 * size;
  canvas_text(p->canvas, c, p->legend_x, p->y, size, 0, bold, text);
}

// Digits in groups of three.
static void print_count(char *to, size_t cap, size_t n, const char *what)
{
  char digits[24];
  int len = snprintf(digits, sizeof digits, "%zu", n), k = 0;
  char out[40];
  for (int i = 0; i < len; i++) {
    if (i && (len - i) % 3 == 0) out[k++] = ' ';
    out[k++] = digits[i];
  }
  out[k] = 0;
  snprintf(to, cap, "%s %s%s", out, what, n == 1 ? "" : "s");
}

static void legend_title(Picture *p)
{
  const Mesh *m = p->mesh;
  char line[80];
  p->y = 22;
  if (p->o->title) legend_text(p, ink, 19, true, p->o->title);
  size_t tri = 0, quad = 0, lines = mesh_count(m, 1);
  for (size_t b = 0; b < m->nblock; b++) {
    if (elem_corners(m->block[b].type) == 3) tri += m->block[b].n;
    if (elem_corners(m->block[b].type) == 4) quad += m->block[b].n;
  }
  struct { size_t n; const char *what; } row[] = {{tri, "triangle"}, {quad, "quadrangle"}, {lines, "line"}, {m->nnode, "node"}};
  for (size_t i = 0; i < ARRAY_LEN(row); i++) {
    if (!row[i].n) continue;
    print_count(line, sizeof line, row[i].n, row[i].what);
    legend_text(p, gray, 14, false, line);
  }
  p->y += 12;
}

// One row: a swatch (face) or a stroke (curve) and a name. False when there is no more room.
static bool legend_row(Picture *p, int dim, Color c, const char *name)
{
  if (p->y > p->height - 60) return false;
  p->y += 23;
  double y = p->y - 5;
  if (dim == 2) {
    canvas_rect(p->canvas, edge_ink, p->legend_x, y - 8, 24, 16);
    canvas_rect(p->canvas, c, p->legend_x + 0.8, y - 7.2, 22.4, 14.4);
  } else {
    canvas_segments(p->canvas, c, 4, (double[]){p->legend_x + 2, y, p->legend_x + 22, y}, 1);
  }
  canvas_text(p->canvas, ink, p->legend_x + 34, p->y, 14, 0, false, name);
  return true;
}

// Is the group the first one of an entity with elements, so that its colour is in the picture?
static bool group_is_drawn(const Mesh *m, int dim, int tag)
{
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshEntity *e = &m->entity[m->block[b].entity];
    if (e->dim == dim && m->block[b].n && e->physical.len && abs(e->physical.data[0]) == tag) return true;
  }
  return false;
}

// Groups of a dimension, and for faces those in no group too.
static void legend_groups(Picture *p, int dim, const char *heading, const Color *color, size_t ncolor)
{
  const Mesh *m = p->mesh;
  size_t index = 0, rows = 0, left_out = 0;
  double heading_y = p->y;
  for (size_t g = 0; g < m->ngroup; g++) {
    if (m->group[g].dim != dim) continue;
    size_t k = index++;
    if (!group_is_drawn(m, dim, m->group[g].tag)) continue;
    char name[300];
    if (m->group[g].name)
      snprintf(name, sizeof name, "%s", m->group[g].name);
    else
      snprintf(name, sizeof name, "group %d", m->group[g].tag);
    if (!rows) p->y += 24;
    if (legend_row(p, dim, color[k % ncolor], name)) rows++; else left_out++;
  }
  for (uint32_t e = 0; dim == 2 && e < m->nentity; e++) {
    if (m->entity[e].dim != dim || m->entity[e].physical.len || !has_elements(m, e)) continue;
    char name[60];
    snprintf(name, sizeof name, "face %d", m->entity[e].tag);
    if (!rows) p->y += 24;
    if (legend_row(p, dim, color[index++ % ncolor], name)) rows++; else left_out++;
  }
  if (rows) canvas_text(p->canvas, ink, p->legend_x, heading_y + 20, 14, 0, true, heading);
  if (left_out) {
    char line[60];
    snprintf(line, sizeof line, "and %zu more", left_out);
    legend_text(p, gray, 13, false, line);
  }
  if (rows) p->y += 14;
}

static void draw_histogram(Picture *p, const Scale *s)
{
  double w = p->width - p->legend_x - 22, h = 110, x = p->legend_x;
  size_t most = 1;
  for (int i = 0; i < BINS; i++) most = MAX(most, s->count[i]);
  legend_text(p, ink, 14, true, s->name);
  p->y += 10;
  for (int i = 0; i < BINS; i++) {
    double bar = h * sqrt((double)s->count[i] / (double)most); // the square root shows the few bad ones too
    if (s->count[i])
      canvas_rect(p->canvas, ramp((i + 0.5) / BINS), x + i * w / BINS, p->y + h - fmax(bar, 1), w / BINS - 0.6, fmax(bar, 1));
  }
  p->y += h + 2;
  for (int i = 0; i < BINS; i++) canvas_rect(p->canvas, ramp((i + 0.5) / BINS), x + i * w / BINS, p->y, w / BINS + 0.2, 8);
  for (int i = 0; i <= 4; i++) {
    char text[32];
    snprintf(text, sizeof text, "%g", s->largest * i / 4);
    canvas_text(p->canvas, gray, x + w * i / 4, p->y + 22, 12, i == 0 ? 0 : i == 4 ? 2 : 1, false, text);
  }
  p->y += 34;
}

// ---- worst elements ---------------------------------------------------------------------------------------------------
enum { MAX_MARKS = 50 };

static void mark_worst(Picture *p, Measure what)
{
  const Mesh *m = p->mesh;
  struct { double value; uint32_t block; size_t element; } worst[MAX_MARKS];
  size_t want = MIN((size_t)MAX(p->o->mark_worst, 0), (size_t)MAX_MARKS), n = 0;
  for (uint32_t b = 0; want && b < m->nblock; b++)
    for (size_t i = 0; elem_dim(m->block[b].type) == 2 && i < m->block[b].n; i++) {
      double value = mesh_measure(m, &m->block[b], i, what);
      if (n == want && !(value < worst[n - 1].value)) continue;
      size_t at = n < want ? n++ : n - 1;
      for (; at > 0 && worst[at - 1].value > value; at--) worst[at] = worst[at - 1];
      worst[at].value = value;
      worst[at].block = b;
      worst[at].element = i;
    }
  for (size_t k = n; k-- > 0;) {
    const MeshBlock *b = &m->block[worst[k].block];
    double x = 0, y = 0;
    int corners = elem_corners(b->type);
    for (int c = 0; c < corners; c++) {
      uint32_t v = b->node[worst[k].element * (size_t)elem_nodes(b->type) + (size_t)c];
      x += p->xy[2 * (size_t)v] / corners;
      y += p->xy[2 * (size_t)v + 1] / corners;
    }
    double r = fmin(22, fmax(7, p->edge_px));
    canvas_circle(p->canvas, (Color){255, 255, 255, 255}, 4, x, y, r);
    canvas_circle(p->canvas, (Color){210, 0, 90, 255}, 2, x, y, r);
    if (k == 0) {
      char text[48];
      snprintf(text, sizeof text, "%.3g", worst[k].value);
      canvas_rect(p->canvas, (Color){255, 255, 255, 220}, x + r + 2, y - r * 0.4 - 12, 9.0 * (double)strlen(text), 16);
      canvas_text(p->canvas, (Color){170, 0, 70, 255}, x + r + 4, y - r * 0.4, 13, 0, true, text);
    }
  }
}

static void draw(Writer *w, CanvasKind kind, const Selection *s, const OutOptions *o)
{
  Picture p = {.mesh = s->mesh, .o = o};
  place_nodes(&p);
  measure_edges(&p);
  mesh_edges_make(&p.edges, p.mesh);
  p.canvas = canvas_open(w, kind, p.width, p.height);
  Scale scale = scale_of(&p);
  if (!o->color)
    fill_by_group(&p);
  else
    fill_by_measure(&p, &scale);
  draw_edges(&p);
  draw_curves(&p);
  if (!o->color && o->histogram) {
    DoubleVec value = measure(p.mesh, &scale);
    vec_free(&value);
  }
  if (o->mark_worst) mark_worst(&p, scale.what);
  legend_title(&p);
  if (o->color || o->histogram) draw_histogram(&p, &scale);
  if (!o->color) legend_groups(&p, 2, "Faces", face_colors, ARRAY_LEN(face_colors));
  legend_groups(&p, 1, "Boundaries", line_colors, ARRAY_LEN(line_colors));
  canvas_close(p.canvas);
  mesh_edges_free(&p.edges);
  free(p.xy);
  vec_free(&p.pts);
  vec_free(&p.start);
}

void png__write(Writer *w, const Selection *s, const OutOptions *o) { draw(w, CANVAS_PNG, s, o); }
void svg__write(Writer *w, const Selection *s, const OutOptions *o) { draw(w, CANVAS_SVG, s, o); }
void pdf__write(Writer *w, const Selection *s, const OutOptions *o) { draw(w, CANVAS_PDF, s, o); }

// ---- differences --------------------------------------------------------------------------------------------------------------
static const Color diff_same = {226, 230, 236, 255}, diff_new = {250, 170, 70, 255}, diff_old = {30, 100, 200, 255};

// Surface elements of p's mesh that are (or are not) changed, as polygons.
static void push_changed(Picture *p, const uint8_t *changed, bool want)
{
  size_t at = 0;
  begin_polygons(p);
  for (size_t b = 0; b < p->mesh->nblock; b++) {
    const MeshBlock *k = &p->mesh->block[b];
    for (size_t i = 0; i < k->n; i++, at++)
      if (elem_dim(k->type) == 2 && (changed[at] != 0) == want) push_element(p, k, i);
  }
}

// Outlines of the elements that only the old mesh has.
static void draw_old(Picture *p, const Mesh *old, const uint8_t *changed)
{
  size_t at = 0;
  vec_clear(&p->pts);
  for (size_t b = 0; b < old->nblock; b++) {
    const MeshBlock *k = &old->block[b];
    int corners = elem_corners(k->type);
    for (size_t i = 0; i < k->n; i++, at++) {
      if (elem_dim(k->type) != 2 || !changed[at]) continue;
      const uint32_t *v = k->node + i * (size_t)elem_nodes(k->type);
      for (int c = 0; c < corners; c++) {
        double xy[4];
        to_pixel(p, mesh_xyz(old, v[c]), xy);
        to_pixel(p, mesh_xyz(old, v[(c + 1) % corners]), xy + 2);
        for (int j = 0; j < 4; j++) vec_push(&p->pts, xy[j]);
      }
    }
  }
  canvas_segments(p->canvas, diff_old, fmax(0.4, fmin(1.4, 0.08 * p->edge_px)), p->pts.data, p->pts.len / 4);
}

static void diff_legend(Picture *p, const MeshDiff *d)
{
  char line[120], count[60];
  p->y = 22;
  legend_text(p, ink, 17, true, d->verdict == DIFF_SAME ? "the same mesh" : "differences");
  p->y += 10;
  legend_row(p, 2, diff_same, "in both");
  print_count(count, sizeof count, d->nchanged[1], "element");
  snprintf(line, sizeof line, "only in the new: %s", count);
  legend_row(p, 2, diff_new, line);
  print_count(count, sizeof count, d->nchanged[0], "element");
  snprintf(line, sizeof line, "only in the old: %s", count);
  legend_row(p, 1, diff_old, line);
  p->y += 8;
  if (d->moved) {
    print_count(count, sizeof count, d->moved, "node");
    snprintf(line, sizeof line, "%s moved, at most %.3g", count, d->largest);
    legend_text(p, gray, 13, false, line);
  }
}

static void draw_diff(Writer *w, CanvasKind kind, const Mesh *a, const Mesh *b, const MeshDiff *d, const OutOptions *o)
{
  Picture p = {.mesh = b, .o = o};
  place_nodes(&p);
  measure_edges(&p);
  mesh_edges_make(&p.edges, b);
  p.canvas = canvas_open(w, kind, p.width, p.height);
  push_changed(&p, d->changed[1], false);
  fill(&p, diff_same, false);
  push_changed(&p, d->changed[1], true);
  fill(&p, diff_new, false);
  draw_edges(&p);
  draw_curves(&p);
  draw_old(&p, a, d->changed[0]);
  if (d->largest > 0) {
    double at[2];
    to_pixel(&p, d->to, at);
    canvas_circle(p.canvas, (Color){210, 0, 90, 255}, 2, at[0], at[1], fmin(20, fmax(7, p.edge_px)));
  }
  diff_legend(&p, d);
  canvas_close(p.canvas);
  mesh_edges_free(&p.edges);
  free(p.xy);
  vec_free(&p.pts);
  vec_free(&p.start);
}

ExitCode out_write_diff(const Mesh *a, const Mesh *b, const MeshDiff *d, const char *path, const OutOptions *o, Diag *diag)
{
  const Format *f = format_of_path(path);
  if (!f || !(f->flags & FORMAT_ALL)) {
    diag_error(diag, NO_LOC, "'%s': differences are painted as .png, .svg or .pdf", path);
    return EXIT_USAGE;
  }
  Writer *w = writer_open(path);
  int error = w ? 0 : errno;
  if (w) {
    draw_diff(w, strcmp(f->name, "png") == 0 ? CANVAS_PNG : strcmp(f->name, "svg") == 0 ? CANVAS_SVG : CANVAS_PDF, a, b, d, o);
    error = writer_close(w);
  }
  if (error) diag_error(diag, NO_LOC, "%s: %s", path, strerror(error));
  return error ? EXIT_ENVIRONMENT : EXIT_GOOD;
}
