// picture_diff.c - pictures of what differs between two meshes
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <errno.h>
#include <math.h>

#include "out/picture_int.h"

static const Color diff_same = {226, 230, 236, 255}, diff_new = {250, 170, 70, 255}, diff_old = {30, 100, 200, 255};

// Surface elements of p's mesh that are (or are not) changed, as polygons.
static void push_changed(Picture *p, const uint8_t *changed, bool want)
{
  size_t at = 0;
  picture__begin_polygons(p);
  for (size_t b = 0; b < p->mesh->nblock; b++) {
    const MeshBlock *k = &p->mesh->block[b];
    for (size_t i = 0; i < k->n; i++, at++)
      if (elem_dim(k->type) == 2 && (changed[at] != 0) == want) picture__push_element(p, k, i);
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
        picture__to_pixel(p, mesh_xyz(old, v[c]), xy);
        picture__to_pixel(p, mesh_xyz(old, v[(c + 1) % corners]), xy + 2);
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
  picture__legend_text(p, ink, 17, true, d->verdict == DIFF_SAME ? "the same mesh" : "differences");
  p->y += 10;
  picture__legend_row(p, 2, diff_same, "in both");
  picture__print_count(count, sizeof count, d->nchanged[1], "element");
  snprintf(line, sizeof line, "only in the new: %s", count);
  picture__legend_row(p, 2, diff_new, line);
  picture__print_count(count, sizeof count, d->nchanged[0], "element");
  snprintf(line, sizeof line, "only in the old: %s", count);
  picture__legend_row(p, 1, diff_old, line);
  p->y += 8;
  if (d->moved) {
    picture__print_count(count, sizeof count, d->moved, "node");
    snprintf(line, sizeof line, "%s moved, at most %.3g", count, d->largest);
    picture__legend_text(p, gray, 13, false, line);
  }
}

static void draw_diff(Writer *w, CanvasKind kind, const Mesh *a, const Mesh *b, const MeshDiff *d, const OutOptions *o)
{
  Picture p = {.mesh = b, .o = o};
  picture__place_nodes(&p);
  picture__measure_edges(&p);
  mesh_edges_make(&p.edges, b);
  p.canvas = canvas_open(w, kind, p.width, p.height);
  if (picture__has_window(&p)) canvas_clip(p.canvas, p.left, p.top, p.w, p.h);
  push_changed(&p, d->changed[1], false);
  picture__fill(&p, diff_same, false);
  push_changed(&p, d->changed[1], true);
  picture__fill(&p, diff_new, false);
  picture__draw_edges(&p);
  picture__draw_curves(&p);
  draw_old(&p, a, d->changed[0]);
  if (d->largest > 0) {
    double at[2];
    picture__to_pixel(&p, d->to, at);
    canvas_circle(p.canvas, (Color){210, 0, 90, 255}, 2, at[0], at[1], fmin(20, fmax(7, p.edge_px)));
  }
  if (picture__has_window(&p)) canvas_end_clip(p.canvas);
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
  const char *lack = f->lacks ? f->lacks() : NULL;
  if (lack) {
    diag_error(diag, NO_LOC, "%s: %s", path, lack);
    return EXIT_ENVIRONMENT;
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
