// plane_shape.c - rectangles, disks and arcs by numbers, as OpenCASCADE makes them
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_int.h"

#define PI 3.14159265358979323846

static int corner_point(Model *m, double x, double y, double z, SrcLoc loc)
{
  int tag = model__next_tag(m, KIND_POINT);
  point__make(m, tag, (Vec3){x, y, z}, 0, loc);
  return tag;
}

static int side_line(Model *m, int a, int b, SrcLoc loc)
{
  int tag = model__next_tag(m, KIND_CURVE), point[2] = {a, b};
  curve__make(m, tag, CURVE_LINE, point, 2, a, b, loc);
  return tag;
}

static int side_arc(Model *m, int tag, int from, int to, Arc arc, SrcLoc loc)
{
  int point[2] = {from, to};
  bool circle = vec3_length(arc.a) == vec3_length(arc.b);
  Curve *c = curve__make(m, tag, circle ? CURVE_CIRCLE : CURVE_ELLIPSE, point, 2, from, to, loc);
  c->arc = arena_dup(&m->arena, &arc, sizeof arc);
  return tag;
}

static int face_of(Model *m, int tag, const int *curve, int n, SrcLoc loc)
{
  int loop = loop__make_hidden(m, curve, n, loc);
  face__make(m, tag, FACE_PLANE, &loop, 1, loc);
  wire__note(m, tag);
  return tag;
}

int model_add_rectangle(Model *m, int tag, Vec3 o, double dx, double dy, double radius, SrcLoc loc, Diag *diag)
{
  model__unprepare(m);
  tag = tag__claim(m, KIND_FACE, tag == -1 ? model__next_tag(m, KIND_FACE) : tag, loc, diag);
  if (tag < 0) return -1;
  double r = fabs(radius);
  if (!(dx != 0) || !(dy != 0) || !isfinite(dx) || !isfinite(dy) || !isfinite(o.x + o.y + o.z)) {
    diag_error(diag, loc, "Rectangle %d has no area: its sides are %g and %g", tag, dx, dy);
    model__refuse(m, KIND_FACE, tag);
    return -1;
  }
  if (2 * r >= fmin(fabs(dx), fabs(dy))) {
    diag_error(diag, loc, "the corners of Rectangle %d, of radius %g, do not fit its sides %g and %g", tag, r, dx, dy);
    model__refuse(m, KIND_FACE, tag);
    return -1;
  }
  double x0 = fmin(o.x, o.x + dx), y0 = fmin(o.y, o.y + dy), x1 = fmax(o.x, o.x + dx), y1 = fmax(o.y, o.y + dy);
  int p[8], c[8];
  if (r == 0) {
    const double x[4] = {x0, x1, x1, x0}, y[4] = {y0, y0, y1, y1};
    for (int i = 0; i < 4; i++) p[i] = corner_point(m, x[i], y[i], o.z, loc);
    for (int i = 0; i < 4; i++) c[i] = side_line(m, p[i], p[(i + 1) % 4], loc);
    return face_of(m, tag, c, 4, loc);
  }
  const double x[8] = {x0 + r, x1 - r, x1, x1, x1 - r, x0 + r, x0, x0}, y[8] = {y0, y0, y0 + r, y1 - r, y1, y1, y1 - r, y0 + r};
  const double cx[4] = {x1 - r, x1 - r, x0 + r, x0 + r}, cy[4] = {y0 + r, y1 - r, y1 - r, y0 + r};
  for (int i = 0; i < 8; i++) p[i] = corner_point(m, x[i], y[i], o.z, loc);
  for (int i = 0; i < 4; i++) {
    c[2 * i] = side_line(m, p[2 * i], p[2 * i + 1], loc);
    Arc arc = {{cx[i], cy[i], o.z}, {r, 0, 0}, {0, r, 0}, (i - 1) * PI / 2, i * PI / 2};
    c[2 * i + 1] = side_arc(m, model__next_tag(m, KIND_CURVE), p[2 * i + 1], p[(2 * i + 2) % 8], arc, loc);
  }
  return face_of(m, tag, c, 8, loc);
}

int model_add_disk(Model *m, int tag, Vec3 centre, double rx, double ry, SrcLoc loc, Diag *diag)
{
  tag = tag__claim(m, KIND_FACE, tag == -1 ? model__next_tag(m, KIND_FACE) : tag, loc, diag);
  if (tag < 0) return -1;
  int curve = model_add_arc(m, model__next_tag(m, KIND_CURVE), centre, rx, ry, 0, 2 * PI, false, loc, diag);
  if (curve < 0) {
    model__refuse(m, KIND_FACE, tag);
    return -1;
  }
  return face_of(m, tag, &curve, 1, loc);
}

int model_add_arc(Model *m, int tag, Vec3 centre, double rx, double ry, double from, double to, bool backwards, SrcLoc loc, Diag *diag)
{
  model__unprepare(m);
  tag = tag__claim(m, KIND_CURVE, tag == -1 ? model__next_tag(m, KIND_CURVE) : tag, loc, diag);
  if (tag < 0) return -1;
  if (!(rx > 0) || !(ry > 0) || !isfinite(rx + ry + centre.x + centre.y + centre.z + from + to)) {
    diag_error(diag, loc, "arc %d needs positive radii, not %g and %g", tag, rx, ry);
    model__refuse(m, KIND_CURVE, tag);
    return -1;
  }
  double turn = to - from;
  while (turn <= 0) turn += 2 * PI;
  if (turn > 2 * PI * (1 + 1e-12)) {
    diag_error(diag, loc, "arc %d turns by %g, more than once round", tag, turn);
    model__refuse(m, KIND_CURVE, tag);
    return -1;
  }
  bool closed = turn > 2 * PI * (1 - 1e-12);
  if (closed) turn = 2 * PI;
  Arc arc = {centre, {rx, 0, 0}, {0, ry, 0}, from, from + turn};
  if (backwards) {
    arc = (Arc){centre, {rx, 0, 0}, {0, -ry, 0}, -from - turn, -from};
    double swap = from;
    from = to;
    to = swap;
  }
  int begin = corner_point(m, centre.x + rx * cos(from), centre.y + ry * sin(from), centre.z, loc), end = begin;
  if (!closed) end = corner_point(m, centre.x + rx * cos(to), centre.y + ry * sin(to), centre.z, loc);
  return side_arc(m, tag, begin, end, arc, loc);
}
