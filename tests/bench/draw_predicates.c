// draw_predicates.c - Figures 3.7 and 3.8 of the book: the orientation test near a line, naive and exact
// SPDX-License-Identifier: MIT
//   draw_predicates out.png     Left and middle: naive, as O(a, b, c) and as O(c, b, a); right: exact.
#include "base/base.h"

#include <cairo.h>

#include "geom/predicates.h"

enum { SIDE = 256, SCALE = 2, GAP = 16 };

static int naive(const double *a, const double *b, const double *c)
{
  volatile double l = (b[0] - a[0]) * (c[1] - a[1]), r = (b[1] - a[1]) * (c[0] - a[0]); // kept apart: no fused operation
  return (l > r) - (l < r);
}

static void panel(cairo_t *cr, double x0, int which)
{
  const double b[2] = {12, 12}, c[2] = {24, 24};
  long count[3] = {0, 0, 0};
  for (int j = 0; j < SIDE; j++)
    for (int i = 0; i < SIDE; i++) {
      double a[2] = {0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53};
      int s = which == 0 ? naive(a, b, c) : which == 1 ? naive(c, b, a) : orient2d(a, b, c);
      count[s + 1]++;
      if (s < 0) cairo_set_source_rgb(cr, 0.25, 0.62, 0.35);
      else if (s > 0) cairo_set_source_rgb(cr, 0.78, 0.27, 0.23);
      else cairo_set_source_rgb(cr, 0.98, 0.83, 0.25);
      cairo_rectangle(cr, x0 + SCALE * i, GAP + SCALE * (SIDE - 1 - j), SCALE, SCALE);
      cairo_fill(cr);
    }
  static const char *const name[] = {"naive O(a,b,c)", "naive O(c,b,a)", "exact"};
  printf("%-16s right %6ld  on the line %6ld  left %6ld\n", name[which], count[0], count[1], count[2]);
}

int main(int argc, char **argv)
{
  if (argc != 2) return EXIT_USAGE;
  int width = 3 * SCALE * SIDE + 4 * GAP, height = SCALE * SIDE + 2 * GAP;
  cairo_surface_t *s = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  cairo_t *cr = cairo_create(s);
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_paint(cr);
  for (int k = 0; k < 3; k++) panel(cr, GAP + k * (SCALE * SIDE + GAP), k);
  bool good = cairo_surface_write_to_png(s, argv[1]) == CAIRO_STATUS_SUCCESS;
  cairo_destroy(cr);
  cairo_surface_destroy(s);
  return good ? EXIT_GOOD : EXIT_ENVIRONMENT;
}
