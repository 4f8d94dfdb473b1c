// canvas.h - what pictures are drawn with: a raster or PDF surface of cairo, or SVG text
// SPDX-License-Identifier: MIT
//
// Pixels, y downwards. SVG is written here and not by cairo because its text stays text, its paths are shorter, and its bytes
// do not depend on how many surfaces the process made before.
#ifndef OUT_CANVAS_H
#define OUT_CANVAS_H

#include "base/base.h"
#include "base/file.h"

typedef struct {
  uint8_t r, g, b, a;
} Color;

typedef enum { CANVAS_PNG, CANVAS_SVG, CANVAS_PDF } CanvasKind;
typedef struct Canvas Canvas;

// NULL, or why pictures of this kind cannot be made here.
const char *canvas_lacks(CanvasKind kind);
// A white page; NULL if canvas_lacks. Nothing is written to w before canvas_close, except by SVG.
Canvas *canvas_open(Writer *w, CanvasKind kind, double width, double height);
void canvas_close(Canvas *c);

// What is drawn between the two is seen within the rectangle only.
void canvas_clip(Canvas *c, double x, double y, double width, double height);
void canvas_end_clip(Canvas *c);

// Fill n closed polygons; polygon i has the points start[i] .. start[i+1]-1 of xy. together: one path with the even-odd
// rule, so that polygons inside others are holes; else each by itself, without seams between neighbours.
void canvas_polygons(Canvas *c, Color fill, const double *xy, const uint32_t *start, size_t n, bool together);
// n segments, 4 numbers each, with round ends.
void canvas_segments(Canvas *c, Color color, double width, const double *xy, size_t n);
void canvas_rect(Canvas *c, Color fill, double x, double y, double width, double height);
void canvas_circle(Canvas *c, Color color, double width, double x, double y, double radius);
// align: 0 left, 1 centre, 2 right of x; y is the baseline.
void canvas_text(Canvas *c, Color color, double x, double y, double size, int align, bool bold, const char *text);

#endif
