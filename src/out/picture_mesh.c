// picture_mesh.c - the mesh of a picture: where nodes are on the page, elements filled by group or by quality, edges and curves
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/picture_int.h"

// Pale fills for faces, strong lines for boundary groups; both repeat when there are more groups.
const Color picture__face_colors[PICTURE_COLORS] = {
    {198, 219, 239, 255}, {253, 218, 180, 255}, {199, 233, 192, 255}, {218, 208, 235, 255}, {250, 208, 222, 255},
    {255, 242, 184, 255}, {190, 232, 226, 255}, {226, 216, 200, 255}, {215, 222, 228, 255}, {226, 240, 180, 255},
};
const Color picture__line_colors[PICTURE_COLORS] = {
    {200, 30, 45, 255},  {20, 90, 180, 255},  {20, 130, 70, 255},  {225, 115, 0, 255}, {125, 60, 160, 255},
    {0, 140, 150, 255},  {190, 40, 130, 255}, {120, 85, 50, 255},  {95, 120, 0, 255},  {70, 70, 200, 255},
};

// Bad is dark red, good is light blue, by way of orange, pale yellow and green: distinct in gray too.
Color picture__ramp(double t)
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

void picture__to_pixel(const Picture *p, Vec3 x, double to[2])
{
  to[0] = p->left + (vec3_dot(x, p->u) - p->lo_x) * p->scale;
  to[1] = p->top + (p->hi_y - vec3_dot(x, p->v)) * p->scale;
}

bool picture__has_window(const Picture *p) { return p->o->window[0] < p->o->window[2] && p->o->window[1] < p->o->window[3]; }

void picture__place_nodes(Picture *p)
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
  if (picture__has_window(p)) {
    memcpy(lo, p->o->window, sizeof lo);
    memcpy(hi, p->o->window + 2, sizeof hi);
  }
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
  for (size_t i = 0; i < m->nnode; i++) picture__to_pixel(p, mesh_xyz(m, (uint32_t)i), p->xy + 2 * i);
}

static bool is_seen(const Picture *p, uint32_t node)
{
  const double *x = p->xy + 2 * (size_t)node;
  if (!picture__has_window(p)) return true;
  return x[0] >= p->left && x[0] <= p->left + p->w && x[1] >= p->top && x[1] <= p->top + p->h;
}

// Of the elements that begin within the picture.
void picture__measure_edges(Picture *p)
{
  double area = 0;
  size_t n = 0;
  for (size_t b = 0; b < p->mesh->nblock; b++) {
    const MeshBlock *k = &p->mesh->block[b];
    if (elem_dim(k->type) != 2) continue;
    for (size_t i = 0; i < k->n; i++) {
      const uint32_t *v = k->node + i * (size_t)elem_nodes(k->type);
      int c = elem_corners(k->type);
      double s = 0;
      if (!is_seen(p, v[0])) continue;
      n++;
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

void picture__begin_polygons(Picture *p)
{
  vec_clear(&p->pts);
  vec_clear(&p->start);
  vec_push(&p->start, 0);
}

static void end_polygon(Picture *p) { vec_push(&p->start, (uint32_t)(p->pts.len / 2)); }

void picture__fill(Picture *p, Color c, bool together)
{
  canvas_polygons(p->canvas, c, p->pts.data, p->start.data, p->start.len - 1, together);
}

void picture__push_element(Picture *p, const MeshBlock *k, size_t i)
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

bool picture__has_elements(const Mesh *m, uint32_t entity)
{
  for (size_t b = 0; b < m->nblock; b++)
    if (m->block[b].entity == entity && m->block[b].n) return true;
  return false;
}

void picture__fill_by_group(Picture *p)
{
  for (uint32_t f = 0; f < p->mesh->nentity; f++) {
    if (p->mesh->entity[f].dim != 2 || !picture__has_elements(p->mesh, f)) continue;
    picture__begin_polygons(p);
    push_loops(p, f);
    picture__fill(p, picture__face_colors[color_index(p->mesh, f) % ARRAY_LEN(picture__face_colors)], true);
  }
}

// ---- colour by a measure ---------------------------------------------------------------------------------------------
Scale picture__scale_of(const Picture *p)
{
  static const char *const titles[MEASURES] = {"quality gamma", "smallest angle", "quality eta", "scaled Jacobian", "kappa 1",
                                               "kappa 2",       "kappa 3",        "kappa 4",     "kappa 5"};
  size_t quads = 0, triangles = 0;
  for (size_t b = 0; b < p->mesh->nblock; b++) {
    if (elem_corners(p->mesh->block[b].type) == 4) quads += p->mesh->block[b].n;
    if (elem_corners(p->mesh->block[b].type) == 3) triangles += p->mesh->block[b].n;
  }
  Measure what = p->o->color > 0 ? (Measure)(p->o->color - 1) : MEASURE_GAMMA;
  if (what == MEASURE_GAMMA && quads && !triangles) what = MEASURE_ETA; // which is what gamma is of quadrangles
  return (Scale){.what = what, .name = titles[what], .largest = what != MEASURE_ANGLE ? 1 : quads ? 90 : 60};
}

static int bin_of(const Scale *s, double value)
{
  double t = value / s->largest * BINS;
  return !(t > 0) ? 0 : t >= BINS ? BINS - 1 : (int)t;
}

// The measure of every surface element, in order, counted into the scale's bins. The caller frees.
DoubleVec picture__measure(const Mesh *m, Scale *s)
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

void picture__fill_by_measure(Picture *p, Scale *s)
{
  const Mesh *m = p->mesh;
  DoubleVec value = picture__measure(m, s);
  for (int bin = 0; bin < BINS; bin++) {
    if (!s->count[bin]) continue;
    picture__begin_polygons(p);
    size_t at = 0;
    for (size_t b = 0; b < m->nblock; b++)
      if (elem_dim(m->block[b].type) == 2)
        for (size_t i = 0; i < m->block[b].n; i++)
          if (bin_of(s, value.data[at++]) == bin) picture__push_element(p, &m->block[b], i);
    picture__fill(p, picture__ramp((bin + 0.5) / BINS), false);
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

void picture__draw_edges(Picture *p)
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
void picture__draw_curves(Picture *p)
{
  const Mesh *m = p->mesh;
  for (int grouped = 0; grouped < 2; grouped++)
    for (size_t b = 0; b < m->nblock; b++) {
      const MeshBlock *k = &m->block[b];
      const MeshEntity *e = &m->entity[k->entity];
      if (elem_dim(k->type) != 1 || grouped != (e->physical.len > 0)) continue;
      vec_clear(&p->pts);
      push_lines(p, k);
      Color c = grouped ? picture__line_colors[color_index(m, k->entity) % ARRAY_LEN(picture__line_colors)] : ink;
      canvas_segments(p->canvas, c, grouped ? 3.2 : 1.8, p->pts.data, p->pts.len / 4);
    }
}
