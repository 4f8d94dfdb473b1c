// cairo_load.h - the functions of cairo that pictures are drawn with, loaded when one is drawn
// SPDX-License-Identifier: MIT
//
// Loading cairo and the twenty libraries behind it takes longer than meshing a small model, and most runs draw nothing.
#ifndef OUT_CAIRO_LOAD_H
#define OUT_CAIRO_LOAD_H

#include <cairo-pdf.h>
#include <cairo.h>

#include "base/base.h"

// Each name without its prefix cairo_.
#define CAIRO_FUNCTIONS(X)                                                                                                   \
  X(arc) X(clip) X(close_path) X(create) X(destroy) X(fill) X(image_surface_create) X(line_to) X(move_to) X(new_sub_path)    \
  X(pdf_surface_create_for_stream) X(pdf_surface_set_metadata) X(rectangle) X(restore) X(save) X(select_font_face)           \
  X(set_antialias) X(set_fill_rule) X(set_font_size) X(set_line_cap) X(set_line_join) X(set_line_width) X(set_source_rgba)   \
  X(show_text) X(stroke) X(surface_destroy) X(surface_finish) X(surface_flush) X(surface_write_to_png_stream) X(text_extents)

typedef struct {
#define CAIRO_MEMBER(name) __typeof__(&cairo_##name) name;
  CAIRO_FUNCTIONS(CAIRO_MEMBER)
#undef CAIRO_MEMBER
} Cairo;

// False if the library is not there or lacks one of them. It stays loaded: fontconfig keeps memory of it.
bool cairo_load(Cairo *to);

#endif
