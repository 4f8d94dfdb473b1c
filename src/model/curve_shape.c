// curve_shape.c - from control points to evaluation data: arcs, and splines as Bezier pieces
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/curve_int.h"

#define PI 3.14159265358979323846

void curve__release(Curve *c)
{
  CurveShape *h = c->shape;
  if (!h) return;
  free(h->knot);
  free(h->control);
  free(h);
  c->shape = NULL;
}

static Vec3 control(const Model *m, const Curve *c, int i)
{
  Vec3 x = point__get(m, c->point[i])->xyz;
  if (!c->sphere) return x;
  Vec2 p = polar_plane(c->sphere, x);
  return (Vec3){p.x, p.y, 0};
}

static CurveShape *new_shape(const Model *m, const Curve *c, ShapeKind kind)
{
  CurveShape *h = mem_zalloc(sizeof *h);
  h->kind = kind;
  h->begin = point__get(m, c->begin)->xyz;
  h->end = point__get(m, c->end)->xyz;
  return h;
}

// ---- pieces -----------------------------------------------------------------------------------------------------------

static CurveShape *new_pieces(const Model *m, const Curve *c, int degree, int npiece)
{
  CurveShape *h = new_shape(m, c, SHAPE_PIECES);
  h->degree = degree;
  h->npiece = npiece;
  h->uniform = true;
  h->knot = mem_alloc(((size_t)npiece + 1) * sizeof *h->knot);
  for (int i = 0; i <= npiece; i++) h->knot[i] = (double)i / npiece;
  h->control = mem_alloc((size_t)npiece * (size_t)(degree + 1) * sizeof *h->control);
  return h;
}

static CurveShape *polyline(const Model *m, const Curve *c)
{
  CurveShape *h = new_pieces(m, c, 1, c->npoint - 1);
  for (int i = 0; i + 1 < c->npoint; i++) {
    h->control[2 * i] = control(m, c, i);
    h->control[2 * i + 1] = control(m, c, i + 1);
  }
  return h;
}

static Vec3 mix(double f, Vec3 a, Vec3 b) // a + f (b - a)
{
  return vec3_add(a, vec3_scale(f, vec3_sub(b, a)));
}

// Uniform Catmull-Rom: tangents (P[i+1] - P[i-1]) / 2, ghosts 2 P0 - P1 at the ends, neighbours around a closed curve.
static CurveShape *catmull_rom(const Model *m, const Curve *c)
{
  int n = c->npoint;
  bool closed = c->point[0] == c->point[n - 1] && n > 2;
  CurveShape *h = new_pieces(m, c, 3, n - 1);
  for (int i = 0; i + 1 < n; i++) {
    Vec3 p1 = control(m, c, i), p2 = control(m, c, i + 1);
    Vec3 p0 = i ? control(m, c, i - 1) : closed ? control(m, c, n - 2) : vec3_sub(vec3_scale(2, p1), p2);
    Vec3 p3 = i + 2 < n ? control(m, c, i + 2) : closed ? control(m, c, 1) : vec3_sub(vec3_scale(2, p2), p1);
    Vec3 *b = h->control + 4 * i;
    b[0] = p1;
    b[1] = vec3_add(p1, vec3_scale(1.0 / 6, vec3_sub(p2, p0)));
    b[2] = vec3_sub(p2, vec3_scale(1.0 / 6, vec3_sub(p3, p1)));
    b[3] = p2;
  }
  return h;
}

static CurveShape *bezier(const Model *m, const Curve *c)
{
  CurveShape *h = new_pieces(m, c, c->npoint - 1, 1);
  for (int i = 0; i < c->npoint; i++) h->control[i] = control(m, c, i);
  return h;
}

static CurveShape *periodic_bspline(const Model *m, const Curve *c)
{
  int n = c->npoint - 1;
  CurveShape *h = new_pieces(m, c, 3, n);
  for (int i = 0; i < n; i++) {
    Vec3 p0 = control(m, c, (i + n - 1) % n), p1 = control(m, c, i), p2 = control(m, c, (i + 1) % n);
    Vec3 p3 = control(m, c, (i + 2) % n), *b = h->control + 4 * i;
    b[1] = mix(1.0 / 3, p1, p2);
    b[2] = mix(2.0 / 3, p1, p2);
    b[0] = vec3_scale(0.5, vec3_add(mix(2.0 / 3, p0, p1), b[1]));
    b[3] = vec3_scale(0.5, vec3_add(b[2], mix(1.0 / 3, p2, p3)));
  }
  return h;
}

// Value of the blossom of the polynomial on span k at the arguments: `low` times t0, then t1 (de Boor's triangle).
static Vec3 blossom(const Vec3 *p, const double *knot, int degree, int k, int low, double t0, double t1, Vec3 *d)
{
  for (int i = 0; i <= degree; i++) d[i] = p[k - degree + i];
  for (int r = 1; r <= degree; r++) {
    double x = r <= low ? t0 : t1;
    for (int i = degree; i >= r; i--) {
      int j = k - degree + i;
      double wide = knot[j + degree + 1 - r] - knot[j];
      d[i] = mix(wide > 0 ? (x - knot[j]) / wide : 0, d[i - 1], d[i]);
    }
  }
  return d[degree];
}

// Pieces between distinct knots. u covers [knot[0], knot[last]]: beyond the first and last full span its polynomial goes on.
static CurveShape *bspline_pieces(const Model *m, const Curve *c, const double *knot, int nknot)
{
  int n = c->npoint, degree = nknot - n - 1, npiece = 0;
  for (int k = degree; k < n; k++) npiece += knot[k] < knot[k + 1];
  if (!npiece) return NULL;
  CurveShape *h = new_pieces(m, c, degree, npiece);
  Vec3 *p = mem_alloc((size_t)n * sizeof *p), *d = mem_alloc((size_t)(degree + 1) * sizeof *d);
  for (int i = 0; i < n; i++) p[i] = control(m, c, i);
  double first = knot[0], last = knot[nknot - 1];
  int piece = 0;
  h->uniform = false;
  for (int k = degree; k < n; k++) {
    if (!(knot[k] < knot[k + 1])) continue;
    double t0 = piece ? knot[k] : first, t1 = piece + 1 == npiece ? last : knot[k + 1];
    for (int j = 0; j <= degree; j++)
      h->control[piece * (degree + 1) + j] = blossom(p, knot, degree, k, degree - j, t0, t1, d);
    h->knot[piece] = piece ? (t0 - first) / (last - first) : 0;
    piece++;
  }
  h->knot[npiece] = 1;
  free(p);
  free(d);
  return h;
}

// Clamped, uniform inside; up to four points this is the Bezier curve.
static CurveShape *clamped_bspline(const Model *m, const Curve *c)
{
  int n = c->npoint;
  if (n <= 4) return bezier(m, c);
  double *knot = mem_alloc(((size_t)n + 4) * sizeof *knot);
  for (int i = 0; i < n + 4; i++) knot[i] = i < 4 ? 0 : i < n ? i - 3 : n - 3;
  CurveShape *h = bspline_pieces(m, c, knot, n + 4);
  free(knot);
  return h;
}

// All control points on the segment between the ends, in order.
static bool pieces_straight(const CurveShape *h)
{
  Vec3 d = vec3_sub(h->end, h->begin);
  double dd = vec3_dot(d, d), before = 0;
  if (!(dd > 0)) return false;
  for (int i = 0; i < h->npiece * (h->degree + 1); i++) {
    Vec3 p = vec3_sub(h->control[i], h->begin);
    double along = vec3_dot(p, d) / dd;
    if (along < before - 1e-15 || along > 1 + 1e-15) return false;
    if (vec3_length(vec3_cross(p, d)) > 4e-16 * dd) return false;
    before = along;
  }
  return true;
}

// ---- arcs -------------------------------------------------------------------------------------------------------------

typedef struct {
  Vec3 centre, x, y; // the plane's axes: x towards the start
  double start[2], end[2];
} ArcPlane;

// The plane of start and end about the centre, turned so that the way from start to end is below pi; when they are in line
// with the centre, the plane that was given (z = 0 by default).
static bool arc_plane(const Model *m, const Curve *c, ArcPlane *a, Diag *diag)
{
  const char *word = c->type == CURVE_CIRCLE ? "circle" : "ellipse";
  if (c->point[0] == c->point[c->npoint - 1]) {
    diag_error(diag, c->loc, "%s arc %d runs from point %d to itself; an arc is shorter than a half turn: make a full turn of two or "
                             "more", word, c->tag, c->point[0]);
    return false;
  }
  a->centre = control(m, c, 1);
  Vec3 s = vec3_sub(control(m, c, 0), a->centre), e = vec3_sub(control(m, c, c->npoint - 1), a->centre);
  double ls = vec3_length(s), le = vec3_length(e);
  if (!(ls > 0) || !(le > 0)) {
    diag_error(diag, c->loc, "%s arc %d has its %s at its centre", word, c->tag, ls > 0 ? "end" : "start");
    return false;
  }
  Vec3 n = vec3_cross(vec3_scale(1 / ls, s), vec3_scale(1 / le, e));
  if (vec3_length(n) < 1e-15) n = c->has_plane ? c->plane : (Vec3){0, 0, 1};
  double ln = vec3_length(n);
  if (!(ln > 0)) {
    diag_error(diag, c->loc, "the plane of %s arc %d has a normal of length 0", word, c->tag);
    return false;
  }
  n = vec3_scale(1 / ln, n);
  a->x = vec3_scale(1 / ls, s);
  a->y = vec3_cross(n, a->x);
  double ly = vec3_length(a->y);
  if (!(ly > 1e-10)) {
    diag_error(diag, c->loc, "%s arc %d is a half circle, and the plane {%g, %g, %g} does not contain it; write 'Plane {nx, ny, nz}' "
                             "after it", word, c->tag, n.x, n.y, n.z);
    return false;
  }
  a->y = vec3_scale(1 / ly, a->y);
  a->start[0] = ls;
  a->start[1] = 0;
  a->end[0] = vec3_dot(e, a->x);
  a->end[1] = vec3_dot(e, a->y);
  return true;
}

static CurveShape *circle(const Model *m, const Curve *c, Diag *diag)
{
  ArcPlane p;
  if (!arc_plane(m, c, &p, diag)) return NULL;
  double r1 = p.start[0], r2 = hypot(p.end[0], p.end[1]), off = fabs(r1 - r2) / (r1 + r2);
  if (off > 0.1) {
    diag_error(diag, c->loc, "the ends of circle arc %d are not on one circle: start point %d is %.10g from the centre %d, end "
                             "point %d is %.10g", c->tag, c->point[0], r1, c->point[1], c->point[2], r2);
    return NULL;
  }
  if (off > 1e-3)
    diag_warning(diag, c->loc, "circle arc %d misses its end point %d: it is %.6g from the centre, the start %.6g", c->tag,
                 c->point[2], r2, r1);
  CurveShape *h = new_shape(m, c, SHAPE_ARC);
  h->circle = true;
  h->centre = p.centre;
  h->a = vec3_scale(r1, p.x);
  h->b = vec3_scale(r1, p.y);
  h->t0 = 0;
  h->t1 = fabs(atan2(p.end[1], p.end[0]));
  return h;
}

// x^2/f1^2 + y^2/f2^2 = 1 through start and end, in axes turned to the third point.
static CurveShape *ellipse(const Model *m, const Curve *c, Diag *diag)
{
  ArcPlane p;
  if (!arc_plane(m, c, &p, diag)) return NULL;
  Vec3 d = vec3_sub(control(m, c, 2), p.centre);
  double mx = vec3_dot(d, p.x), my = vec3_dot(d, p.y), ml = hypot(mx, my);
  if (!(ml > 1e-12 * vec3_length(d)) || !(ml > 0)) { // the centre itself is a way to say: the start is on an axis
    mx = ml = 1;
    my = 0;
  }
  mx /= ml;
  my /= ml;
  double x1 = p.start[0] * mx, y1 = -p.start[0] * my;
  double x2 = p.end[0] * mx + p.end[1] * my, y2 = -p.end[0] * my + p.end[1] * mx;
  double det = x1 * x1 * y2 * y2 - x2 * x2 * y1 * y1;
  double scale = (x1 * x1 + y1 * y1) * (x2 * x2 + y2 * y2);
  double s1 = (y2 * y2 - y1 * y1) / det, s2 = (x1 * x1 - x2 * x2) / det; // 1/f1^2, 1/f2^2
  if (!(fabs(det) > 1e-14 * scale) || !(s1 > 0) || !(s2 > 0) || !isfinite(s1) || !isfinite(s2)) {
    diag_error(diag, c->loc, "no ellipse with centre %d and an axis towards point %d passes through the ends %d and %d of arc %d",
               c->point[1], c->point[2], c->point[0], c->point[3], c->tag);
    return NULL;
  }
  double f1 = 1 / sqrt(s1), f2 = 1 / sqrt(s2);
  CurveShape *h = new_shape(m, c, SHAPE_ARC);
  h->centre = p.centre;
  h->a = vec3_scale(f1, vec3_add(vec3_scale(mx, p.x), vec3_scale(my, p.y)));
  h->b = vec3_scale(f2, vec3_add(vec3_scale(-my, p.x), vec3_scale(mx, p.y)));
  h->t0 = atan2(y1 / f2, x1 / f1);
  h->t1 = atan2(y2 / f2, x2 / f1);
  if (h->t1 <= h->t0) h->t1 += 2 * PI;
  return h;
}

// ---- all --------------------------------------------------------------------------------------------------------------

static CurveShape *given_arc(const Model *m, const Curve *c)
{
  CurveShape *h = new_shape(m, c, SHAPE_ARC);
  h->centre = c->arc->centre;
  h->a = c->arc->a;
  h->b = c->arc->b;
  h->t0 = c->arc->t0;
  h->t1 = c->arc->t1;
  double a = vec3_length(h->a), b = vec3_length(h->b);
  h->circle = fabs(a - b) <= 1e-13 * a && fabs(vec3_dot(h->a, h->b)) <= 1e-13 * a * b;
  return h;
}

static CurveShape *given_pieces(const Model *m, const Curve *c)
{
  const Pieces *p = c->pieces;
  CurveShape *h = new_pieces(m, c, p->degree, p->npiece);
  h->uniform = p->npiece == 1;
  memcpy(h->knot, p->knot, ((size_t)p->npiece + 1) * sizeof *h->knot);
  memcpy(h->control, p->control, (size_t)p->npiece * (size_t)(p->degree + 1) * sizeof *h->control);
  return h;
}

bool curve__build(Model *m, Curve *c, Diag *diag)
{
  curve__release(c);
  CurveShape *h = NULL;
  if (c->pieces) h = given_pieces(m, c);
  else switch (c->type) {
  case CURVE_LINE: return true;
  case CURVE_POLYLINE: h = polyline(m, c); break;
  case CURVE_CIRCLE: h = c->arc ? given_arc(m, c) : circle(m, c, diag); break;
  case CURVE_ELLIPSE: h = c->arc ? given_arc(m, c) : ellipse(m, c, diag); break;
  case CURVE_SPLINE: h = catmull_rom(m, c); break;
  case CURVE_BSPLINE:
    h = c->point[0] == c->point[c->npoint - 1] && c->npoint > 2 ? periodic_bspline(m, c) : clamped_bspline(m, c);
    break;
  case CURVE_BEZIER: h = bezier(m, c); break;
  case CURVE_NURBS:
    h = bspline_pieces(m, c, c->knot, c->nknot);
    if (!h) diag_error(diag, c->loc, "the knots of Nurbs %d leave no span", c->tag);
    break;
  }
  if (!h) return false;
  if (c->sphere)
    sphere__lift(c->sphere, h);
  else
    h->straight = h->kind == SHAPE_PIECES && pieces_straight(h);
  c->shape = h;
  return true;
}
