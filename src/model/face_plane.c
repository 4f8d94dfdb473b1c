// face_plane.c - boundaries of faces and the planes they lie in
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/curve_int.h"

// A loop as one face uses it: the outer one as written, a hole the other way round, each reversed once more by a negative
// sign (so that holes listed counter-clockwise come out clockwise).
static void push_loop(const Model *m, int loop, bool outer, IntVec *curve)
{
  const Loop *l = model_loop(m, loop);
  if (!l) return;
  bool forward = outer == (loop >= 0);
  for (int i = 0; i < l->ncurve; i++) {
    int tag = forward ? l->curve[i] : -l->curve[l->ncurve - 1 - i], joined = m->joint.len ? model_curve(m, tag)->joined : 0;
    if (!joined || joined == tag__abs(tag)) vec_push(curve, tag);
  }
}

void face_boundary(const Model *m, const Face *f, IntVec *curve, IntVec *start)
{
  vec_clear(curve);
  vec_clear(start);
  for (int i = 0; i < f->nloop; i++) {
    size_t from = curve->len;
    push_loop(m, f->loop[i], i == 0, curve);
    vec_push(start, (int)from);
    int first = curve->len > from ? curve__from(m, curve->data[from]) : 0;
    for (size_t k = from; k + 1 < curve->len; k++) {
      if (curve__to(m, curve->data[k]) != first) continue;
      vec_push(start, (int)k + 1); // a closed part ends here
      first = curve__from(m, curve->data[k + 1]);
    }
  }
  vec_push(start, (int)curve->len);
}

// ---- samples ------------------------------------------------------------------------------------------------------------

typedef Vec(Vec3) Vec3Vec;

// Points along one closed part: begin of every curve and, on curved ones, enough between to see their shape.
static void sample(const Model *m, const int *curve, size_t n, Vec3Vec *out)
{
  for (size_t i = 0; i < n; i++) {
    const Curve *c = model_curve(m, curve[i]);
    const CurveShape *h = c->shape;
    int steps = !h || h->straight ? 1 : h->kind == SHAPE_ARC ? 16 : h->degree == 1 ? h->npiece : 8 * MIN(h->npiece, 4096);
    for (int k = 0; k < steps; k++) {
      double u = (double)k / steps;
      vec_push(out, curve_point(m, c, curve[i] < 0 ? 1 - u : u));
    }
  }
}

// Newell's vector: twice the area times the normal.
static Vec3 newell(const Vec3 *p, size_t n)
{
  Vec3 sum = {0, 0, 0};
  for (size_t i = 1; i + 1 < n; i++)
    sum = vec3_add(sum, vec3_cross(vec3_sub(p[i], p[0]), vec3_sub(p[i + 1], p[0])));
  return sum;
}

// ---- the frame ------------------------------------------------------------------------------------------------------------

static bool same_coordinate(const Vec3Vec *p, int d)
{
  for (size_t i = 1; i < p->len; i++) {
    double a = d == 0 ? p->data[0].x : d == 1 ? p->data[0].y : p->data[0].z;
    double b = d == 0 ? p->data[i].x : d == 1 ? p->data[i].y : p->data[i].z;
    if (a != b) return false;
  }
  return true;
}

// In a coordinate plane: axes along the coordinates, so that plane coordinates are the points' own, bit for bit.
static bool coordinate_frame(Face *f, const Vec3Vec *p, Vec3 normal)
{
  const Vec3 e[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double n[3] = {normal.x, normal.y, normal.z};
  for (int d = 2; d >= 0; d--) {
    if (n[d] == 0 || !same_coordinate(p, d)) continue;
    double at = d == 0 ? p->data[0].x : d == 1 ? p->data[0].y : p->data[0].z;
    double sign = n[d] < 0 ? -1 : 1;
    f->origin = at == 0 ? (Vec3){0, 0, 0} : vec3_scale(at, e[d]);
    f->normal = (Vec3){sign * e[d].x + 0.0, sign * e[d].y + 0.0, sign * e[d].z + 0.0};
    f->axis_u = e[(d + 1) % 3];
    Vec3 v = e[(d + 2) % 3];
    f->axis_v = (Vec3){sign * v.x + 0.0, sign * v.y + 0.0, sign * v.z + 0.0};
    return true;
  }
  return false;
}

static void general_frame(Face *f, const Vec3Vec *p, Vec3 normal)
{
  Vec3 c = {0, 0, 0};
  for (size_t i = 0; i < p->len; i++) c = vec3_add(c, p->data[i]);
  f->origin = vec3_scale(1.0 / (double)p->len, c);
  f->normal = vec3_scale(1 / vec3_length(normal), normal);
  Vec3 a = {fabs(f->normal.x), fabs(f->normal.y), fabs(f->normal.z)};
  Vec3 e = a.x <= a.y && a.x <= a.z ? (Vec3){1, 0, 0} : a.y <= a.z ? (Vec3){0, 1, 0} : (Vec3){0, 0, 1};
  Vec3 u = vec3_sub(e, vec3_scale(vec3_dot(e, f->normal), f->normal));
  f->axis_u = vec3_scale(1 / vec3_length(u), u);
  f->axis_v = vec3_cross(f->normal, f->axis_u);
}

static double off_plane(const Face *f, const Vec3Vec *p)
{
  double most = 0;
  for (size_t i = 0; i < p->len; i++) most = fmax(most, fabs(vec3_dot(vec3_sub(p->data[i], f->origin), f->normal)));
  return most;
}

static double extent(const Vec3Vec *p, double *largest)
{
  Box3 b = box3_empty();
  for (size_t i = 0; i < p->len; i++) b = box3_with(b, p->data[i]);
  *largest = fmax(fmax(fmax(fabs(b.lo.x), fabs(b.hi.x)), fmax(fabs(b.lo.y), fabs(b.hi.y))), fmax(fabs(b.lo.z), fabs(b.hi.z)));
  return vec3_distance(b.lo, b.hi);
}

// A hidden loop with the curves of `loop` as an outer loop runs through them, but `len` of them from `first` on (counted from the
// end when negative) in front.
static int part_first(Model *m, const Face *f, int loop, int first, int len)
{
  IntVec all = {0}, turned = {0};
  push_loop(m, loop, true, &all);
  if (first < 0) first += (int)all.len;
  for (int i = 0; i < len; i++) vec_push(&turned, all.data[first + i]);
  for (int i = 0; i < (int)all.len; i++)
    if (i < first || i >= first + len) vec_push(&turned, all.data[i]);
  int tag = loop__make_hidden(m, turned.data, (int)turned.len, f->loc);
  vec_free(&all);
  vec_free(&turned);
  return tag;
}

// The closed part that encloses most becomes the first of the first loop: holes may be listed before, or inside one Loop.
static void outer_first(Model *m, Face *f)
{
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  size_t parts = start.len - 1, best = 0;
  double most = -1;
  for (size_t i = 0; i < parts && parts > 1; i++) {
    Vec3Vec p = {0};
    sample(m, curve.data + start.data[i], (size_t)(start.data[i + 1] - start.data[i]), &p);
    double a = vec3_length(newell(p.data, p.len));
    if (a > most * (1 + 1e-12)) {
      most = a;
      best = i;
    }
    vec_free(&p);
  }
  if (best) {
    int loop = 0, begin = 0;
    while (start.data[best] >= begin + model_loop(m, f->loop[loop])->ncurve) begin += model_loop(m, f->loop[loop++])->ncurve;
    int t = f->loop[loop], first = start.data[best] - begin, len = start.data[best + 1] - start.data[best];
    if (len < model_loop(m, t)->ncurve) t = part_first(m, f, t, loop == 0 ? first : -first - len, len);
    memmove(f->loop + 1, f->loop, (size_t)loop * sizeof *f->loop);
    f->loop[0] = t;
  }
  vec_free(&curve);
  vec_free(&start);
}

static bool curves_are_built(const Model *m, const IntVec *curve)
{
  for (size_t i = 0; i < curve->len; i++) {
    const Curve *c = model_curve(m, curve->data[i]);
    if (!c || (c->type != CURVE_LINE && !c->shape)) return false;
  }
  return true;
}

// A loop that crosses itself may have no area in sum, yet lie in a plane: that of three of its points. False if they are all on
// a line.
static bool any_normal(const Vec3Vec *p, double size, Vec3 *n)
{
  for (size_t i = 1; i < p->len; i++) {
    Vec3 d = vec3_sub(p->data[i], p->data[0]);
    if (!(vec3_length(d) > 1e-9 * size)) continue;
    for (size_t j = i + 1; j < p->len; j++) {
      *n = vec3_cross(d, vec3_sub(p->data[j], p->data[0]));
      if (vec3_length(*n) > 1e-13 * size * size) return true;
    }
    return false;
  }
  return false;
}

// The sphere on which all the curves were drawn, if there is one.
static const PolarSphere *common_sphere(const Model *m, const IntVec *curve)
{
  const PolarSphere *s = curve->len ? model_curve(m, curve->data[0])->sphere : NULL;
  for (size_t i = 1; s && i < curve->len; i++)
    if (model_curve(m, curve->data[i])->sphere != s) return NULL;
  return s;
}

// Curve 0 where it would have to be -0: a hole is listed against its loop, and loops may need turning.
static bool needs_zero_backwards(const Model *m, const Face *f)
{
  for (int k = 0; k < f->nloop; k++) {
    const Loop *l = model_loop(m, f->loop[k]);
    bool forward = (k == 0) == (f->loop[k] >= 0);
    for (int i = 0; l && i < l->ncurve; i++)
      if (l->curve[i] == 0 && (!forward || curve__to(m, 0) != curve__from(m, l->curve[(i + 1) % l->ncurve]))) return true;
  }
  return false;
}

bool face__build(Model *m, Face *f, double tolerance, Diag *diag)
{
  if (model_curve(m, 0) && needs_zero_backwards(m, f)) {
    diag_error(diag, f->loc, "surface %d: its boundary runs along curve 0 backwards, and 0 has no sign; give the curve another number",
               f->tag);
    return false;
  }
  IntVec curve = {0}, start = {0};
  face_boundary(m, f, &curve, &start);
  bool good = curves_are_built(m, &curve);
  if (good && f->type == FACE_PLANE && start.len > 2) {
    outer_first(m, f);
    face_boundary(m, f, &curve, &start);
  }
  Vec3Vec p = {0};
  f->planar = false;
  f->sphere = good ? common_sphere(m, &curve) : NULL;
  if (good && !f->sphere) {
    sample(m, curve.data, (size_t)start.data[1], &p);
    double largest, size = extent(&p, &largest);
    Vec3 n = newell(p.data, p.len);
    bool flat = vec3_length(n) > 1e-13 * size * size || any_normal(&p, size, &n);
    if (!flat) n = (Vec3){0, 0, 1};
    sample(m, curve.data + start.data[1], curve.len - (size_t)start.data[1], &p);
    if (!coordinate_frame(f, &p, n)) general_frame(f, &p, n);
    double off = off_plane(f, &p);
    f->planar = flat && off <= tolerance * size + 8 * 2.2e-16 * largest;
    if (!flat && f->type == FACE_PLANE) {
      diag_error(diag, f->loc, "the outer loop %d of surface %d lies on a line and encloses no area", tag__abs(f->loop[0]), f->tag);
      good = false;
    } else if (f->type == FACE_PLANE && off > 1e-3 * size) {
      diag_warning(diag, f->loc, "surface %d is not plane: its boundary is up to %.6g off its mean plane", f->tag, off);
    }
  }
  vec_free(&p);
  vec_free(&curve);
  vec_free(&start);
  return good;
}

// The plane that the curves lie in, or nearly; for curves of one line some plane through it, that of x and y if it can be.
void plane__of_curves(const Model *m, const int *curve, size_t n, Face *frame)
{
  Vec3Vec p = {0};
  for (size_t i = 0; i < n; i++) {
    sample(m, &curve[i], 1, &p);
    vec_push(&p, curve_point(m, model_curve(m, curve[i]), 1));
  }
  double largest, size = extent(&p, &largest), far = -1;
  Vec3 normal = {0, 0, 1}, d = {0, 0, 0};
  size_t end = 0;
  for (size_t i = 1; i < p.len; i++)
    if (vec3_distance(p.data[i], p.data[0]) > vec3_distance(p.data[end], p.data[0])) end = i;
  if (p.len) d = vec3_sub(p.data[end], p.data[0]);
  if (fabs(d.z) > 1e-9 * size) normal = vec3_cross(d, fabs(d.x) > fabs(d.y) ? (Vec3){0, 1, 0} : (Vec3){1, 0, 0});
  for (size_t i = 1; i < p.len; i++) { // of the point farthest from that line
    Vec3 c = vec3_cross(d, vec3_sub(p.data[i], p.data[0]));
    if (vec3_length(c) <= fmax(far, 1e-9 * size * size)) continue;
    far = vec3_length(c);
    normal = c;
  }
  if (normal.z < 0) normal = vec3_scale(-1, normal);
  if (!coordinate_frame(frame, &p, normal)) general_frame(frame, &p, normal);
  vec_free(&p);
}

// ---- filling faces ----------------------------------------------------------------------------------------------------------

static Vec3 along(const Model *m, int curve, double u)
{
  return curve_point(m, model_curve(m, curve), curve < 0 ? 1 - u : u);
}

int face_filling_sides(const Model *m, const Face *f, int side[4])
{
  const Loop *l = model_loop(m, f->loop[0]);
  bool forward = f->loop[0] >= 0;
  int n = l->ncurve;
  // a face swept from a curve whose end stays: that end is the corner without a side
  int first = n == 3 && f->extruded_curve && f->extruded_side[0] && !f->extruded_side[1] ? 1 : 0;
  for (int i = 0; i < n && i < 4; i++) {
    int k = (i + first) % n;
    side[i] = forward ? l->curve[k] : -l->curve[n - 1 - k];
  }
  return n;
}

Vec3 face_filling_point(const Model *m, const Face *f, double s, double t)
{
  int c[4], n = face_filling_sides(m, f, c);
  Vec3 p0 = along(m, c[0], 0), p1 = along(m, c[1], 0), p2 = along(m, c[2], 0), p3 = n == 4 ? along(m, c[3], 0) : p0;
  Vec3 bottom = along(m, c[0], s), right = along(m, c[1], t), top = along(m, c[2], 1 - s);
  Vec3 left = n == 4 ? along(m, c[3], 1 - t) : p0;
  Vec3 ruled = vec3_add(vec3_add(vec3_scale(1 - t, bottom), vec3_scale(t, top)),
                        vec3_add(vec3_scale(1 - s, left), vec3_scale(s, right)));
  Vec3 corner = vec3_add(vec3_add(vec3_scale((1 - s) * (1 - t), p0), vec3_scale(s * (1 - t), p1)),
                         vec3_add(vec3_scale(s * t, p2), vec3_scale((1 - s) * t, p3)));
  return vec3_sub(ruled, corner);
}
