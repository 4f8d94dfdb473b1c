// picture_legend.c - what stands beside the mesh of a picture: counts, groups, histogram
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "out/picture_int.h"

void picture__legend_text(Picture *p, Color c, double size, bool bold, const char *text)
{
  p->y += 1.55 * size;
  canvas_text(p->canvas, c, p->legend_x, p->y, size, 0, bold, text);
}

// Digits in groups of three.
void picture__print_count(char *to, size_t cap, size_t n, const char *what)
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

void picture__legend_title(Picture *p)
{
  const Mesh *m = p->mesh;
  char line[80];
  p->y = 22;
  if (p->o->title) picture__legend_text(p, ink, 19, true, p->o->title);
  struct { size_t n; const char *what; } row[] = {{mesh_count_corners(m, 3), "triangle"}, {mesh_count_corners(m, 4), "quadrangle"},
                                                  {mesh_count(m, 1), "line"}, {m->nnode, "node"}};
  for (size_t i = 0; i < ARRAY_LEN(row); i++) {
    if (!row[i].n) continue;
    picture__print_count(line, sizeof line, row[i].n, row[i].what);
    picture__legend_text(p, gray, 14, false, line);
  }
  p->y += 12;
}

// One row: a swatch (face) or a stroke (curve) and a name. False when there is no more room.
bool picture__legend_row(Picture *p, int dim, Color c, const char *name)
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
void picture__legend_groups(Picture *p, int dim, const char *heading, const Color *color, size_t ncolor)
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
    if (picture__legend_row(p, dim, color[k % ncolor], name)) rows++; else left_out++;
  }
  for (uint32_t e = 0; dim == 2 && e < m->nentity; e++) {
    if (m->entity[e].dim != dim || m->entity[e].physical.len || !picture__has_elements(m, e)) continue;
    char name[60];
    snprintf(name, sizeof name, "face %d", m->entity[e].tag);
    if (!rows) p->y += 24;
    if (picture__legend_row(p, dim, color[index++ % ncolor], name)) rows++; else left_out++;
  }
  if (rows) canvas_text(p->canvas, ink, p->legend_x, heading_y + 20, 14, 0, true, heading);
  if (left_out) {
    char line[60];
    snprintf(line, sizeof line, "and %zu more", left_out);
    picture__legend_text(p, gray, 13, false, line);
  }
  if (rows) p->y += 14;
}

void picture__draw_histogram(Picture *p, const Scale *s)
{
  double w = p->width - p->legend_x - 22, h = 110, x = p->legend_x;
  size_t most = 1;
  for (int i = 0; i < BINS; i++) most = MAX(most, s->count[i]);
  picture__legend_text(p, ink, 14, true, s->name);
  p->y += 10;
  for (int i = 0; i < BINS; i++) {
    double bar = h * sqrt((double)s->count[i] / (double)most); // the square root shows the few bad ones too
    if (s->count[i])
      canvas_rect(p->canvas, picture__ramp((i + 0.5) / BINS), x + i * w / BINS, p->y + h - fmax(bar, 1), w / BINS - 0.6, fmax(bar, 1));
  }
  p->y += h + 2;
  for (int i = 0; i < BINS; i++) canvas_rect(p->canvas, picture__ramp((i + 0.5) / BINS), x + i * w / BINS, p->y, w / BINS + 0.2, 8);
  for (int i = 0; i <= 4; i++) {
    char text[32];
    snprintf(text, sizeof text, "%g", s->largest * i / 4);
    canvas_text(p->canvas, gray, x + w * i / 4, p->y + 22, 12, i == 0 ? 0 : i == 4 ? 2 : 1, false, text);
  }
  p->y += 34;
}
