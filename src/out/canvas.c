// canvas.c - what pictures are drawn with: a raster or PDF surface of cairo, or SVG text
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/canvas.h"

#include <math.h>

#include "base/mem.h"
#include "base/number.h"
#include "out/cairo_load.h"

struct Canvas {
  Writer *w;
  CanvasKind kind;
  Cairo cairo; // the library, but for SVG
  cairo_surface_t *surface; // NULL for SVG
  cairo_t *cr;
};

static cairo_status_t emit(void *w, const unsigned char *data, unsigned length)
{
  writer_bytes(w, data, length);
  return CAIRO_STATUS_SUCCESS;
}

const char *canvas_lacks(CanvasKind kind)
{
  Cairo cairo;
  if (kind == CANVAS_SVG || cairo_load(&cairo)) return NULL;
  return "PNG and PDF are drawn by the library libcairo.so.2, which cannot be loaded (SVG needs none)";
}

Canvas *canvas_open(Writer *w, CanvasKind kind, double width, double height)
{
  Canvas *c = mem_zalloc(sizeof *c);
  c->w = w;
  c->kind = kind;
  if (kind != CANVAS_SVG && !cairo_load(&c->cairo)) {
    free(c);
    return NULL;
  }
  if (kind == CANVAS_SVG) {
    writer_printf(w, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" "
                  "height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" font-family=\"DejaVu Sans,Helvetica,Arial,sans-serif\">\n",
                  width, height, width, height);
  } else if (kind == CANVAS_PDF) {
    c->surface = c->cairo.pdf_surface_create_for_stream(emit, w, width, height);
    // A fixed date: equal meshes give equal bytes.
    c->cairo.pdf_surface_set_metadata(c->surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  } else {
    c->surface = c->cairo.image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
  }
  if (c->surface) {
    c->cr = c->cairo.create(c->surface);
    c->cairo.set_line_cap(c->cr, CAIRO_LINE_CAP_ROUND);
    c->cairo.set_line_join(c->cr, CAIRO_LINE_JOIN_ROUND);
  }
  canvas_rect(c, (Color){255, 255, 255, 255}, 0, 0, width, height);
  return c;
}

void canvas_close(Canvas *c)
{
  if (c->kind == CANVAS_SVG) writer_str(c->w, "</svg>\n");
  if (c->kind == CANVAS_PNG) {
    c->cairo.surface_flush(c->surface);
    c->cairo.surface_write_to_png_stream(c->surface, emit, c->w);
  }
  if (c->cr) c->cairo.destroy(c->cr);
  if (c->surface) {
    c->cairo.surface_finish(c->surface);
    c->cairo.surface_destroy(c->surface);
  }
  free(c);
}

void canvas_clip(Canvas *c, double x, double y, double width, double height)
{
  if (c->kind == CANVAS_SVG) {
    writer_printf(c->w, "<clipPath id=\"window\"><rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\"/></clipPath>\n"
                  "<g clip-path=\"url(#window)\">\n", x, y, width, height);
    return;
  }
  c->cairo.save(c->cr);
  c->cairo.rectangle(c->cr, x, y, width, height);
  c->cairo.clip(c->cr);
}

void canvas_end_clip(Canvas *c)
{
  if (c->kind == CANVAS_SVG)
    writer_str(c->w, "</g>\n");
  else
    c->cairo.restore(c->cr);
}

static void set_color(Canvas *c, Color k)
{
  c->cairo.set_source_rgba(c->cr, k.r / 255., k.g / 255., k.b / 255., k.a / 255.);
}

static void svg_color(Canvas *c, const char *attribute, Color k)
{
  writer_printf(c->w, " %s=\"#%02x%02x%02x\"", attribute, k.r, k.g, k.b);
  if (k.a != 255) writer_printf(c->w, " %s-opacity=\"%.3g\"", attribute, k.a / 255.);
}

// Hundredths of a pixel as decimal text with a leading separator where SVG needs one.
static void svg_number(Writer *w, long hundredths, bool blank)
{
  char *p0 = writer_reserve(w, 32), *p = p0;
  unsigned long v = hundredths < 0 ? (unsigned long)-hundredths : (unsigned long)hundredths;
  if (hundredths < 0)
    *p++ = '-';
  else if (blank)
    *p++ = ' ';
  if (v >= 100 || v == 0) p += number_print_u64(p, v / 100);
  if (v % 100) {
    *p++ = '.';
    *p++ = (char)('0' + v % 100 / 10);
    if (v % 10) *p++ = (char)('0' + v % 10);
  }
  writer_commit(w, (size_t)(p - p0));
}

// Pen of a relative SVG path: differences of rounded positions, so that errors do not add up.
typedef struct {
  long x, y;
} Pen;

static void svg_to(Writer *w, Pen *pen, const double *xy, char command)
{
  long x = lround(100 * xy[0]), y = lround(100 * xy[1]);
  if (command) writer_char(w, command);
  svg_number(w, x - pen->x, !command);
  svg_number(w, y - pen->y, true);
  pen->x = x;
  pen->y = y;
}

static void svg_polygons(Canvas *c, Color fill, const double *xy, const uint32_t *start, size_t n, bool together)
{
  if (!n) return;
  writer_str(c->w, "<path fill-rule=\"evenodd\"");
  svg_color(c, "fill", fill);
  if (!together) {
    svg_color(c, "stroke", fill);
    writer_str(c->w, " stroke-width=\".3\" stroke-linejoin=\"round\"");
  }
  writer_str(c->w, " d=\"");
  Pen pen = {0, 0};
  for (size_t i = 0; i < n; i++) {
    Pen begin = {lround(100 * xy[2 * start[i]]), lround(100 * xy[2 * start[i] + 1])};
    for (uint32_t k = start[i]; k < start[i + 1]; k++)
      svg_to(c->w, &pen, xy + 2 * k, k == start[i] ? 'm' : k == start[i] + 1 ? 'l' : 0);
    writer_char(c->w, 'z');
    pen = begin;
  }
  writer_str(c->w, "\"/>\n");
}

void canvas_polygons(Canvas *c, Color fill, const double *xy, const uint32_t *start, size_t n, bool together)
{
  if (c->kind == CANVAS_SVG) {
    svg_polygons(c, fill, xy, start, n, together);
    return;
  }
  set_color(c, fill);
  c->cairo.set_fill_rule(c->cr, CAIRO_FILL_RULE_EVEN_ODD);
  if (!together) c->cairo.set_antialias(c->cr, CAIRO_ANTIALIAS_NONE);
  for (size_t i = 0; i < n; i++) {
    for (uint32_t k = start[i]; k < start[i + 1]; k++)
      if (k == start[i])
        c->cairo.move_to(c->cr, xy[2 * k], xy[2 * k + 1]);
      else
        c->cairo.line_to(c->cr, xy[2 * k], xy[2 * k + 1]);
    c->cairo.close_path(c->cr);
    if (!together) c->cairo.fill(c->cr);
  }
  if (together) c->cairo.fill(c->cr);
  c->cairo.set_antialias(c->cr, CAIRO_ANTIALIAS_DEFAULT);
}

void canvas_segments(Canvas *c, Color color, double width, const double *xy, size_t n)
{
  if (!n) return;
  if (c->kind == CANVAS_SVG) {
    writer_str(c->w, "<path fill=\"none\" stroke-linecap=\"round\"");
    svg_color(c, "stroke", color);
    writer_printf(c->w, " stroke-width=\"%.3g\" d=\"", width);
    Pen pen = {0, 0};
    for (size_t i = 0; i < n; i++) {
      bool joined = i && xy[4 * i] == xy[4 * i - 2] && xy[4 * i + 1] == xy[4 * i - 1];
      if (!joined) svg_to(c->w, &pen, xy + 4 * i, 'm');
      svg_to(c->w, &pen, xy + 4 * i + 2, joined ? 0 : 'l');
    }
    writer_str(c->w, "\"/>\n");
    return;
  }
  // A translucent line must not be darker where strokes overlap, so they are few paths; the cost of a path grows faster
  // than its length, so they are not one.
  enum { PER_PATH = 64 };
  set_color(c, color);
  c->cairo.set_line_width(c->cr, width);
  for (size_t i = 0; i < n; i++) {
    c->cairo.move_to(c->cr, xy[4 * i], xy[4 * i + 1]);
    c->cairo.line_to(c->cr, xy[4 * i + 2], xy[4 * i + 3]);
    if (i % PER_PATH == PER_PATH - 1) c->cairo.stroke(c->cr);
  }
  c->cairo.stroke(c->cr);
}

void canvas_rect(Canvas *c, Color fill, double x, double y, double width, double height)
{
  if (c->kind == CANVAS_SVG) {
    writer_printf(c->w, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\"", x, y, width, height);
    svg_color(c, "fill", fill);
    writer_str(c->w, "/>\n");
    return;
  }
  set_color(c, fill);
  c->cairo.rectangle(c->cr, x, y, width, height);
  c->cairo.fill(c->cr);
}

void canvas_circle(Canvas *c, Color color, double width, double x, double y, double radius)
{
  if (c->kind == CANVAS_SVG) {
    writer_printf(c->w, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"none\" stroke-width=\"%.3g\"", x, y, radius, width);
    svg_color(c, "stroke", color);
    writer_str(c->w, "/>\n");
    return;
  }
  set_color(c, color);
  c->cairo.set_line_width(c->cr, width);
  c->cairo.new_sub_path(c->cr);
  c->cairo.arc(c->cr, x, y, radius, 0, 6.283185307179586);
  c->cairo.stroke(c->cr);
}

// Control bytes and what is not UTF-8 become '?', so that any name is printable.
static void clean_text(const char *text, char *to, size_t cap)
{
  size_t n = 0;
  const unsigned char *p = (const unsigned char *)text;
  while (*p && n + 5 < cap) {
    int extra = *p < 0x80 ? 0 : *p >= 0xc2 && *p < 0xe0 ? 1 : *p >= 0xe1 && *p < 0xed ? 2 : -1;
    bool good = *p >= ' ' && *p != 0x7f && extra >= 0;
    for (int i = 1; good && i <= extra; i++) good = (p[i] & 0xc0) == 0x80;
    if (!good) {
      to[n++] = '?';
      p++;
      continue;
    }
    for (int i = 0; i <= extra; i++) to[n++] = (char)*p++;
  }
  to[n] = 0;
}

void canvas_text(Canvas *c, Color color, double x, double y, double size, int align, bool bold, const char *text)
{
  static const char *const anchors[] = {"start", "middle", "end"};
  char clean[512];
  clean_text(text, clean, sizeof clean);
  if (c->kind == CANVAS_SVG) {
    writer_printf(c->w, "<text x=\"%.2f\" y=\"%.2f\" font-size=\"%.3g\" text-anchor=\"%s\"%s", x, y, size, anchors[align],
                  bold ? " font-weight=\"bold\"" : "");
    svg_color(c, "fill", color);
    writer_char(c->w, '>');
    for (const char *p = clean; *p; p++)
      if (*p == '<')
        writer_str(c->w, "&lt;");
      else if (*p == '&')
        writer_str(c->w, "&amp;");
      else
        writer_char(c->w, *p);
    writer_str(c->w, "</text>\n");
    return;
  }
  set_color(c, color);
  c->cairo.select_font_face(c->cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                            bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  c->cairo.set_font_size(c->cr, size);
  cairo_text_extents_t ext;
  c->cairo.text_extents(c->cr, clean, &ext);
  c->cairo.move_to(c->cr, x - ext.x_advance * align / 2, y);
  c->cairo.show_text(c->cr, clean);
}
