// unroll.c - a model written as plain .geo
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/unroll.h"

#include "model/unroll_int.h"

enum { WIDTH = 100 };

void unroll__ints(Writer *w, const int *v, size_t n)
{
  size_t col = 20;
  writer_char(w, '{');
  for (size_t i = 0; i < n; i++) {
    char text[16];
    int len = snprintf(text, sizeof text, "%d", v[i]);
    if (i) {
      writer_str(w, col > WIDTH ? ",\n  " : ", ");
      col = col > WIDTH ? 2 : col + 2;
    }
    writer_bytes(w, text, (size_t)len);
    col += (size_t)len;
  }
  writer_char(w, '}');
}

void unroll__doubles(Writer *w, const double *v, size_t n)
{
  writer_char(w, '{');
  for (size_t i = 0; i < n; i++) {
    if (i) writer_str(w, i % 8 ? ", " : ",\n  ");
    writer_double(w, v[i]);
  }
  writer_char(w, '}');
}

static void put_vec(Writer *w, Vec3 v) { unroll__doubles(w, (double[]){v.x, v.y, v.z}, 3); }

static void put_head(Writer *w, const char *what, int tag)
{
  writer_str(w, what);
  writer_char(w, '(');
  writer_i64(w, tag);
  writer_str(w, ") = ");
}

// ---- arcs by numbers --------------------------------------------------------------------------------------------------------

static int fresh_point(Unroll *r, Vec3 x)
{
  put_head(r->w, "Point", ++r->point);
  put_vec(r->w, x);
  writer_str(r->w, ";\n");
  return r->point;
}

static Vec3 on_arc(const Arc *a, double t)
{
  return vec3_add(a->centre, vec3_add(vec3_scale(cos(t), a->a), vec3_scale(sin(t), a->b)));
}

// Where to cut, as fractions, the end included. Circles evenly; an ellipse at its axes (at angle `axis`), since its ends and centre do
// not give an arc whose ends mirror each other in an axis.
static int arc_cuts(const Arc *a, bool circle, double axis, double cut[6])
{
  double turn = a->t1 - a->t0, half_pi = 1.57079632679489662;
  int n = 0;
  if (circle) {
    int parts = fabs(turn) < 3.14 ? 1 : (int)ceil(fabs(turn) / 2.2);
    for (n = 0; n < parts; n++) cut[n] = (n + 1.0) / parts;
    return n;
  }
  double mirror = fabs(sin(a->t0 + a->t1 - 2 * axis) * sin(turn)); // 0 where the ends mirror
  if (fabs(turn) >= 3.14 || mirror < 1e-3) {
    double first = (a->t0 - axis) / half_pi, last = (a->t1 - axis) / half_pi;
    for (int k = (int)floor(fmin(first, last)); k <= (int)ceil(fmax(first, last)) && n < 5; k++) {
      double f = (k - first) / (last - first);
      if (f > 1e-6 && f < 1 - 1e-6) cut[n++] = f;
    }
    for (int i = 0; turn < 0 && i < n / 2; i++) {
      double t = cut[i];
      cut[i] = cut[n - 1 - i];
      cut[n - 1 - i] = t;
    }
  }
  cut[n++] = 1;
  return n;
}

static void put_arc(Unroll *r, const Curve *c)
{
  const Arc *a = c->arc;
  double la = vec3_dot(a->a, a->a), lb = vec3_dot(a->b, a->b), ab = vec3_dot(a->a, a->b), cut[6];
  bool circle = fabs(la - lb) <= 1e-12 * la && fabs(ab) <= 1e-12 * la;
  double at = circle ? 0 : atan2(2 * ab, la - lb) / 2; // of the longest of the conjugate radii
  int n = arc_cuts(a, circle, at, cut), centre = fresh_point(r, a->centre), from = c->begin;
  int axis = circle ? centre : fresh_point(r, on_arc(a, at));
  if (n > 1) map_set(&r->part, (uint64_t)c->tag, (uint32_t)r->tag.len);
  for (int i = 0; i < n; i++) {
    int to = i + 1 == n ? c->end : fresh_point(r, on_arc(a, a->t0 + (a->t1 - a->t0) * cut[i])), tag = n == 1 ? c->tag : ++r->next;
    put_head(r->w, circle ? "Circle" : "Ellipse", tag);
    int round[3] = {from, centre, to}, oval[4] = {from, centre, axis, to};
    unroll__ints(r->w, circle ? round : oval, circle ? 3 : 4);
    writer_str(r->w, ";\n");
    if (n > 1) vec_push(&r->tag, tag);
    from = to;
  }
  if (n > 1) vec_push(&r->tag, -1);
}

void unroll__curve_list(Unroll *r, const int *v, size_t n)
{
  if (!r->part.len) {
    unroll__ints(r->w, v, n);
    return;
  }
  IntVec all = {0};
  for (size_t i = 0; i < n; i++) {
    uint32_t at = map_get(&r->part, (uint64_t)tag__abs(v[i]));
    if (at == NONE) {
      vec_push(&all, v[i]);
      continue;
    }
    size_t from = all.len;
    for (size_t k = at; r->tag.data[k] >= 0; k++) vec_push(&all, v[i] < 0 ? -r->tag.data[k] : r->tag.data[k]);
    for (size_t a = from, b = all.len; v[i] < 0 && a < b--; a++) {
      int t = all.data[a];
      all.data[a] = all.data[b];
      all.data[b] = t;
    }
  }
  unroll__ints(r->w, all.data, all.len);
  vec_free(&all);
}

// ---- points, curves -------------------------------------------------------------------------------------------------------

static double last_places(double x, int n)
{
  for (; n > 0; n--) x = nextafter(x, INFINITY);
  for (; n < 0; n++) x = nextafter(x, -INFINITY);
  return x;
}

static Vec3 own_place(const Model *m, const Point *p)
{
  for (size_t i = 0; i < m->moved.len; i++)
    if (m->moved.data[i].tag == p->tag) return m->moved.data[i].xyz;
  return p->xyz;
}

// Some plane coordinates whose image is x to the last bit, near those computed from x, which may miss it by rounding; x was given
// by such, unless it was moved.
static Vec2 plane_of(const PolarSphere *s, Vec3 x)
{
  enum { REACH = 12 }; // last places
  Vec2 near = polar_plane(s, x);
  for (int r = 0; r <= REACH; r++)
    for (int i = -r; i <= r; i++)
      for (int j = -r; j <= r; j += abs(i) == r || j == r ? 1 : 2 * r) {
        Vec2 q = {last_places(near.x, i), last_places(near.y, j)};
        Vec3 y = polar_point(s, q);
        if (y.x == x.x && y.y == x.y && y.z == x.z) return q;
      }
  return near;
}

// The points given in the plane of a sphere, or those of space.
static void put_points(Writer *w, const Model *m, const PolarSphere *sphere)
{
  for (size_t i = 0; i < model_points(m); i++) {
    const Point *p = model_point_at(m, i);
    if (p->sphere != sphere) continue;
    Vec3 x = own_place(m, p);
    if (sphere) {
      Vec2 q = plane_of(sphere, x);
      x = (Vec3){q.x, q.y, 0};
    }
    double v[4] = {x.x, x.y, x.z, p->lc};
    put_head(w, "Point", p->tag);
    unroll__doubles(w, v, p->lc < LC_UNSET ? 4 : 3);
    writer_str(w, ";\n");
  }
}

// Centre and pole: the points they were given by, if they are there yet, or others.
static void put_pair(Unroll *r, const PolarSphere *s, IntVec *pair)
{
  const Point *c = model_point(r->m, s->centre_point), *p = model_point(r->m, s->pole_point);
  bool centred = c && vec3_distance(c->xyz, s->centre) == 0;
  bool polar = p && fabs(vec3_distance(p->xyz, s->centre) - s->radius) <= 1e-15 * s->radius;
  vec_push(pair, centred ? c->tag : fresh_point(r, s->centre));
  vec_push(pair, polar ? p->tag : fresh_point(r, (Vec3){s->centre.x, s->centre.y, s->centre.z + s->radius}));
}

// All that is given in space first, since a sphere counts for all points after it.
static void put_all_points(Unroll *r)
{
  Vec(const PolarSphere *) sphere = {0};
  IntVec pair = {0};
  put_points(r->w, r->m, NULL);
  for (size_t i = 0; i < model_points(r->m); i++) {
    const PolarSphere *s = model_point_at(r->m, i)->sphere;
    bool known = !s;
    for (size_t k = 0; k < sphere.len && !known; k++) known = sphere.data[k] == s;
    if (known) continue;
    vec_push(&sphere, s);
    put_pair(r, s, &pair);
  }
  for (size_t k = 0; k < sphere.len; k++) {
    put_head(r->w, "PolarSphere", sphere.data[k]->tag);
    unroll__ints(r->w, pair.data + 2 * k, 2);
    writer_str(r->w, ";\n");
    put_points(r->w, r->m, sphere.data[k]);
  }
  vec_free(&sphere);
  vec_free(&pair);
}

// Half circles are told apart by their plane only.
static bool needs_plane(const Model *m, const Curve *c)
{
  if (c->arc || !c->has_plane || (c->type != CURVE_CIRCLE && c->type != CURVE_ELLIPSE)) return false;
  Vec3 o = model_point(m, c->point[1])->xyz;
  Vec3 a = vec3_sub(model_point(m, c->point[0])->xyz, o), b = vec3_sub(model_point(m, c->point[c->npoint - 1])->xyz, o);
  return vec3_length(vec3_cross(a, b)) <= 1e-9 * vec3_length(a) * vec3_length(b);
}

// ---- splines by pieces --------------------------------------------------------------------------------------------------

// The blossom of a cubic Bezier piece over [a, b].
static Vec3 cubic_blossom(const Vec3 *control, double a, double b, const double u[3])
{
  Vec3 d[4];
  memcpy(d, control, sizeof d);
  for (int r = 0; r < 3; r++) {
    double f = (u[r] - a) / (b - a);
    for (int i = 0; i < 3 - r; i++) d[i] = vec3_add(vec3_scale(1 - f, d[i]), vec3_scale(f, d[i + 1]));
  }
  return d[0];
}

// Inner control points and knots of the B-spline that a smooth spline is: single knots.
static void smooth_controls(const Pieces *p, Vec3 *inner, DoubleVec *knot)
{
  int n = p->npiece;
  for (int i = -3; i <= n + 3; i++) vec_push(knot, p->knot[MIN(MAX(i, 0), n)]);
  for (int j = 1; j < n + 2; j++) {
    int k = MIN(j - 1, n - 1);
    inner[j - 1] = cubic_blossom(p->control + 4 * (size_t)k, p->knot[k], p->knot[k + 1], knot->data + j + 1);
  }
}

// Of any pieces: every joint as many times as the degree.
static void all_controls(const Pieces *p, Vec3 *inner, DoubleVec *knot)
{
  int d = p->degree, n = 0;
  vec_push(knot, 0);
  for (int k = 0; k <= p->npiece; k++)
    for (int i = 0; i < d; i++) vec_push(knot, p->knot[k]);
  vec_push(knot, 1);
  for (int k = 0; k < p->npiece; k++)
    for (int i = k ? 0 : 1; i < d; i++) inner[n++] = p->control[k * (d + 1) + i];
}

// A Nurbs, or a Bezier, with points of its own between the ends.
static void put_spline(Unroll *r, const Curve *c)
{
  const Pieces *p = c->pieces;
  bool smooth = p->smooth && p->degree == 3 && p->npiece > 1;
  int n = smooth ? p->npiece + 1 : p->npiece * p->degree - 1;
  Vec3 *inner = mem_alloc(((size_t)n + 1) * sizeof *inner);
  DoubleVec knot = {0};
  IntVec point = {0};
  if (smooth) smooth_controls(p, inner, &knot);
  else all_controls(p, inner, &knot);
  vec_push(&point, c->begin);
  for (int i = 0; i < n; i++) vec_push(&point, fresh_point(r, inner[i]));
  vec_push(&point, c->end);
  put_head(r->w, p->npiece > 1 ? "Nurbs" : "Bezier", c->tag);
  unroll__ints(r->w, point.data, point.len);
  if (p->npiece > 1) {
    writer_str(r->w, " Knots ");
    unroll__doubles(r->w, knot.data, knot.len);
    writer_printf(r->w, " Order %d", p->degree);
  }
  writer_str(r->w, ";\n");
  free(inner);
  vec_free(&knot);
  vec_free(&point);
}

static void put_curves(Unroll *r)
{
  Writer *w = r->w;
  const Model *m = r->m;
  static const char *const word[] = {"Line", "Line", "Circle", "Ellipse", "Spline", "BSpline", "Bezier", "Nurbs"};
  for (size_t i = 0; i < model_curves(m); i++) {
    const Curve *c = model_curve_at(m, i);
    if (c->arc) {
      put_arc(r, c);
      continue;
    }
    if (c->pieces) {
      put_spline(r, c);
      continue;
    }
    put_head(w, word[c->type], c->tag);
    unroll__ints(w, c->point, (size_t)c->npoint);
    if (needs_plane(m, c)) {
      writer_str(w, " Plane ");
      put_vec(w, c->plane);
    }
    if (c->type == CURVE_NURBS) {
      writer_str(w, " Knots ");
      unroll__doubles(w, c->knot, (size_t)c->nknot);
      writer_printf(w, " Order %d", c->nknot - c->npoint - 1);
    }
    writer_str(w, ";\n");
  }
}

// ---- loops, faces, volumes --------------------------------------------------------------------------------------------------

static void put_loop(Unroll *r, int tag, const Loop *l)
{
  put_head(r->w, "Curve Loop", tag);
  unroll__curve_list(r, l->curve, (size_t)l->ncurve);
  writer_str(r->w, ";\n");
}

static bool loops_are_sorted(const Model *m, const Face *f)
{
  for (int i = 0; i < f->nloop; i++) {
    const Loop *l = model_loop(m, f->loop[i]);
    if (!l || !l->sorted) return false;
  }
  return true;
}

static bool is_hidden(int loop) { return tag__abs(loop) >= HIDDEN_LOOP; }

// All loops, then all faces. Hidden loops get tags beyond all others, in the order of their faces.
static void put_faces(Unroll *r)
{
  Writer *w = r->w;
  const Model *m = r->m;
  int fresh = r->next;
  for (size_t i = 0; i < model_loops(m); i++)
    if (model_loop_at(m, i)->sorted) put_loop(r, model_loop_at(m, i)->tag, model_loop_at(m, i));
  int next = fresh;
  for (size_t i = 0; i < model_faces(m); i++) {
    const Face *f = model_face_at(m, i);
    for (int k = 0; loops_are_sorted(m, f) && k < f->nloop; k++)
      if (is_hidden(f->loop[k])) put_loop(r, ++next, model_loop(m, f->loop[k]));
  }
  IntVec loop = {0};
  next = fresh;
  for (size_t i = 0; i < model_faces(m); i++) {
    const Face *f = model_face_at(m, i);
    if (!loops_are_sorted(m, f)) continue;
    vec_clear(&loop);
    for (int k = 0; k < f->nloop; k++) {
      int tag = is_hidden(f->loop[k]) ? ++next : tag__abs(f->loop[k]);
      vec_push(&loop, f->loop[k] < 0 ? -tag : tag);
    }
    put_head(w, f->type == FACE_PLANE ? "Plane Surface" : "Surface", f->tag);
    unroll__ints(w, loop.data, loop.len);
    writer_str(w, ";\n");
  }
  vec_free(&loop);
  IntVec volume = {0};
  model_all(m, 3, &volume);
  for (size_t i = 0; i < volume.len; i++) {
    const Volume *v = table__get(&m->volume, volume.data[i]);
    IntVec face = {0};
    for (int k = 0; k < v->nface; k++) vec_push(&face, tag__abs(v->face[k]));
    put_head(w, "Surface Loop", v->tag);
    unroll__ints(w, face.data, face.len);
    writer_str(w, ";\n");
    put_head(w, "Volume", v->tag);
    unroll__ints(w, &v->tag, 1);
    writer_str(w, ";\n");
    vec_free(&face);
  }
  vec_free(&volume);
}

// ---- groups -------------------------------------------------------------------------------------------------------------------

static void put_groups(Unroll *r)
{
  Writer *w = r->w;
  const Model *m = r->m;
  static const char *const word[] = {"Point", "Curve", "Surface", "Volume"};
  for (size_t i = 0; i < model_groups(m); i++) {
    const Group *g = model_group_at(m, i);
    if (!g->name && !g->entity.len) continue; // says nothing
    writer_printf(w, "Physical %s(", word[g->dim]);
    if (g->name) {
      char quote = strchr(g->name, '"') ? '\'' : '"';
      writer_char(w, quote);
      writer_str(w, g->name);
      writer_char(w, quote);
      writer_str(w, ", ");
    }
    writer_i64(w, g->tag);
    writer_str(w, ") = ");
    if (g->dim == 1)
      unroll__curve_list(r, g->entity.data, g->entity.len);
    else
      unroll__ints(w, g->entity.data, g->entity.len);
    writer_str(w, ";\n");
  }
}

void model_unroll(const Model *m, Writer *w)
{
  Unroll r = {.w = w, .m = m, .point = model_max_tag(m, KIND_POINT)};
  for (int k = KIND_CURVE; k < KIND_COUNT; k++) r.next = MAX(r.next, model_max_tag(m, (Kind)k));
  put_all_points(&r);
  put_curves(&r);
  put_faces(&r);
  unroll__mesh(&r);
  put_groups(&r);
  map_free(&r.part);
  vec_free(&r.tag);
}
