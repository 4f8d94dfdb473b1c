// picture.c - PNG, SVG and PDF: the mesh coloured by group or quality, boundary groups, legend and histogram
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/picture_int.h"

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
  picture__place_nodes(&p);
  picture__measure_edges(&p);
  mesh_edges_make(&p.edges, p.mesh);
  p.canvas = canvas_open(w, kind, p.width, p.height);
  Scale scale = picture__scale_of(&p);
  if (picture__has_window(&p)) canvas_clip(p.canvas, p.left, p.top, p.w, p.h);
  bool by_part = o->color == COLOR_BY_PART && p.mesh->nparts, by_measure = o->color > 0;
  if (by_measure)
    picture__fill_by_measure(&p, &scale);
  else if (by_part)
    picture__fill_by_part(&p);
  else
    picture__fill_by_group(&p);
  picture__draw_edges(&p);
  if (by_part) picture__draw_seams(&p);
  picture__draw_curves(&p);
  if (!by_measure && o->histogram) {
    DoubleVec value = picture__measure(p.mesh, &scale);
    vec_free(&value);
  }
  if (o->mark_worst) mark_worst(&p, scale.what);
  if (picture__has_window(&p)) canvas_end_clip(p.canvas);
  picture__legend_title(&p);
  if (by_measure || o->histogram) picture__draw_histogram(&p, &scale);
  if (by_part) picture__legend_parts(&p);
  if (!by_measure && !by_part)
    picture__legend_groups(&p, 2, "Faces", picture__face_colors, ARRAY_LEN(picture__face_colors));
  picture__legend_groups(&p, 1, "Boundaries", picture__line_colors, ARRAY_LEN(picture__line_colors));
  canvas_close(p.canvas);
  mesh_edges_free(&p.edges);
  free(p.xy);
  vec_free(&p.pts);
  vec_free(&p.start);
}

const char *picture__lacks(void) { return canvas_lacks(CANVAS_PNG); }
void png__write(Writer *w, const Selection *s, const OutOptions *o) { draw(w, CANVAS_PNG, s, o); }
void svg__write(Writer *w, const Selection *s, const OutOptions *o) { draw(w, CANVAS_SVG, s, o); }
void pdf__write(Writer *w, const Selection *s, const OutOptions *o) { draw(w, CANVAS_PDF, s, o); }
