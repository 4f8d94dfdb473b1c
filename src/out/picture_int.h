// picture_int.h - what the files picture*.c share
// SPDX-License-Identifier: MIT
#ifndef OUT_PICTURE_INT_H
#define OUT_PICTURE_INT_H

#include "mesh/mesh_edges.h"
#include "mesh/mesh_measure.h"
#include "out/canvas.h"
#include "out/out_int.h"

enum { PICTURE_COLORS = 10 };
extern const Color picture__face_colors[PICTURE_COLORS], picture__line_colors[PICTURE_COLORS];
static const Color ink = {35, 40, 48, 255}, gray = {105, 112, 122, 255}, edge_ink = {48, 60, 78, 255};

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

enum { BINS = 40 };

typedef struct {
  Measure what;
  const char *name;
  double largest;    // of the measure: 1, or 60 or 90 degrees
  size_t count[BINS], n;
} Scale;

// picture_mesh.c
bool picture__has_window(const Picture *p); // only a part is drawn
void picture__place_nodes(Picture *p);   // choose the view and the page, and place the nodes on it
void picture__to_pixel(const Picture *p, Vec3 x, double to[2]);
void picture__measure_edges(Picture *p); // edge_px
Color picture__ramp(double t);           // of quality from 0 to 1
bool picture__has_elements(const Mesh *m, uint32_t entity);
// Collect elements as polygons, then fill them all; `together` without seams between them.
void picture__begin_polygons(Picture *p);
void picture__push_element(Picture *p, const MeshBlock *k, size_t i);
void picture__fill(Picture *p, Color c, bool together);
void picture__fill_by_group(Picture *p);
Scale picture__scale_of(const Picture *p); // of the measure that the options ask for; counts still 0
// The measure of every surface element, in order, counted into the scale's bins. The caller frees.
DoubleVec picture__measure(const Mesh *m, Scale *s);
void picture__fill_by_measure(Picture *p, Scale *s);
void picture__draw_edges(Picture *p);
void picture__draw_curves(Picture *p);

// picture_parts.c: parts in colours that differ between neighbours, the edges between them, and their names
void picture__fill_by_part(Picture *p);
void picture__draw_seams(Picture *p);
void picture__legend_parts(Picture *p);

// picture_legend.c: lines and boxes at p->y, which moves down
void picture__legend_text(Picture *p, Color c, double size, bool bold, const char *text);
void picture__print_count(char *to, size_t cap, size_t n, const char *what);
void picture__legend_title(Picture *p);
bool picture__legend_row(Picture *p, int dim, Color c, const char *name); // false: no room
void picture__legend_groups(Picture *p, int dim, const char *heading, const Color *color, size_t ncolor);
void picture__draw_histogram(Picture *p, const Scale *s);

#endif
