// tri_minangle.c - guaranteed smallest angle by Delaunay refinement with segment splitting; Delaunay conformity
// SPDX-License-Identifier: MIT
//
// A skinny triangle gets a point on the Voronoi edge of its shortest side: its circumcentre, or the off-centre that is just good
// enough [Ungor04]. A point that would lie beyond a segment, or in the diametral circle of one, yields to a split of that segment
// [Ruppert95]. At input angles under 60 degrees, segments are split on concentric shells about the vertex, and a triangle whose
// shortest side joins two such segments on one shell is left alone [MPW03]. What theory does not cover, a bound on the lengths
// made, relative to the local feature size of the input, ends.
#include "base/base.h"
#include "tri/refine_int.h"

enum { NKEYS = 256 };
// No edge is made shorter than this part of the local feature size. Ruppert's constant is below 10 up to 25 degrees.
#define LEAST_PART (1. / 128)

// The least angle between segments at a vertex: under 60 degrees, where no promise holds; under 120, where one triangle may fill
// it, and is good if isosceles, which shells make it (else refinement at 33 degrees can go on toward a corner of 98); or more.
enum { MEET_WIDE, MEET_SHELLS, MEET_ACUTE };

typedef struct {
  TriId t;
  VertId v[3];
} Skinny;

typedef struct {
  Refiner *r;
  TriCavity c;
  double bound;     // (R/l)^2 above which a triangle is skinny
  double off;       // tangent that puts off-centres
  VertId given;     // vertices of the input
  Vec(double) lfs;  // by vertex: local feature size, at most
  U32Vec from, to;  // by vertex: ends of the input segment that it splits; NONE for others
  uint8_t *meet;    // by given vertex: how segments meet there inside the domain
  Vec(Skinny) stack[NKEYS];
  int top;
} MinAngle;

static double dist(const Tri *m, VertId a, VertId b) { return sqrt(metric_distance2(tri_xy(m, a), tri_xy(m, b))); }

// Shortest side (a half-edge of t) and the square of R over it.
static double radius_edge2(const Tri *m, TriId t, EdgeId *side)
{
  double least = INFINITY, area2;
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
    double d = metric_distance2(tri_xy(m, tri_org(m, e)), tri_xy(m, tri_dest(m, e)));
    if (d < least) least = d, *side = e;
  }
  return metric_radius2(tri_xy(m, m->vert[3 * t]), tri_xy(m, m->vert[3 * t + 1]), tri_xy(m, m->vert[3 * t + 2]), &area2) / least;
}

static void consider(MinAngle *q, TriId t)
{
  const Tri *m = q->r->m;
  if (!tri_is_inside(m, t)) return;
  EdgeId side;
  double x = radius_edge2(m, t, &side) / q->bound;
  if (x <= 1) return;
  int k = refine__key(x, 21, NKEYS);
  Skinny s = {t, {m->vert[3 * t], m->vert[3 * t + 1], m->vert[3 * t + 2]}};
  vec_push(&q->stack[k], s);
  if (k > q->top) q->top = k;
}

// The worst triangle that still exists, or NONE.
static TriId take(MinAngle *q)
{
  const Tri *m = q->r->m;
  for (; q->top >= 0; q->top--) {
    while (q->stack[q->top].len) {
      Skinny s = vec_pop(&q->stack[q->top]);
      if (memcmp(m->vert + 3 * (size_t)s.t, s.v, sizeof s.v) == 0 && tri_is_inside(m, s.t)) return s.t;
    }
  }
  return NONE;
}

// ---- the input ---------------------------------------------------------------------------------------------------

// Local feature size at the input's vertices, as far as the triangles tell: the least side or altitude around.
static void input_features(MinAngle *q)
{
  const Tri *m = q->r->m;
  vec_resize(&q->lfs, m->nv);
  for (VertId v = 0; v < m->nv; v++) q->lfs.data[v] = INFINITY;
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    double a = dist(m, v[0], v[1]), b = dist(m, v[1], v[2]), c = dist(m, v[2], v[0]), area2;
    metric_radius2(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), &area2);
    double least = MIN(a, MIN(b, c)), altitude = area2 / MAX(a, MAX(b, c));
    for (int i = 0; i < 3; i++) q->lfs.data[v[i]] = MIN(q->lfs.data[v[i]], MIN(least, altitude));
  }
}

// Angles between consecutive segments around each vertex, on the sides that are inside the domain.
static void find_acute(MinAngle *q)
{
  const Tri *m = q->r->m;
  q->meet = mem_zalloc(m->nv);
  for (VertId v = 0; v < m->nv; v++) {
    EdgeId first = m->hint[v], e = first;
    if (first == NONE) continue;
    do { // start at a segment
      if (tri_is_segment(m, e)) break;
      e = tri_ccw(m, e);
    } while (e != first);
    if (!tri_is_segment(m, e)) continue;
    first = e;
    do {
      double angle = tri_wedge(m, &e); // outside does not matter: it is infinite there
      int how = angle < REFINE_ACUTE ? MEET_ACUTE : angle < 2.1 ? MEET_SHELLS : MEET_WIDE;
      if (how > q->meet[v]) q->meet[v] = (uint8_t)how;
    } while (e != first);
  }
}

// ---- splitting segments --------------------------------------------------------------------------------------------

static bool is_given(const MinAngle *q, VertId v) { return v < q->given; }

// Where to split uv, as a part of its length: in the middle, or on a shell about an end where segments meet at an angle.
static double where_to_split(const MinAngle *q, VertId u, VertId v, double len)
{
  bool au = is_given(q, u) && q->meet[u], av = is_given(q, v) && q->meet[v];
  if (au == av) return 0.5;
  double shell = exp2(floor(log2(len / 1.5))) / len; // in (1/3, 2/3]
  return au ? shell : 1 - shell;
}

// Are sizes of vertices to be told at the end, some of them carried from the boundary? Conformity is there before any.
static bool wants_sizes(const MinAngle *q) { return q->r->size && q->r->p->sizes_out; }
static bool carries_sizes(const MinAngle *q) { return wants_sizes(q) && q->r->carried; }

static void added_vertex(MinAngle *q, VertId v, double lfs, double carried, VertId from, VertId to)
{
  CHECK(v == q->lfs.len);
  if (wants_sizes(q)) refine__size_vertex(q->r, v, carried);
  vec_push(&q->lfs, lfs);
  vec_push(&q->from, from), vec_push(&q->to, to);
}

// Ends of the input segment that the segment uv is a part of.
static void input_ends(const MinAngle *q, VertId u, VertId v, VertId end[2])
{
  end[0] = u, end[1] = v;
  if (!is_given(q, u)) end[0] = q->from.data[u], end[1] = q->to.data[u];
  else if (!is_given(q, v)) end[0] = q->from.data[v], end[1] = q->to.data[v];
}

static double distance_to_segment(const double *p, const double *a, const double *b)
{
  double x = b[0] - a[0], y = b[1] - a[1], t = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y);
  t = t > 0 ? t < 1 ? t : 1 : 0;
  return hypot(a[0] + t * x - p[0], a[1] + t * y - p[1]);
}

// Local feature size at a new vertex: no more than that of a neighbour plus the distance to it; and of a vertex on a segment
// (whose input ends are `own`; NULL for others), than the distance to another segment that does not touch that one.
static double feature_at(const MinAngle *q, const double *p, const VertId *own)
{
  const Tri *m = q->r->m;
  double f = INFINITY;
  for (size_t i = 0; i < q->c.rim.len; i++) {
    EdgeId e = q->c.rim.data[i];
    VertId u = tri_org(m, e), v = tri_dest(m, e), end[2];
    if (u == TRI_INF) continue; // splitting a side of the hull
    double g = q->lfs.data[u] + sqrt(metric_distance2(p, tri_xy(m, u)));
    f = MIN(f, g);
    if (!own || v == TRI_INF || !tri_is_segment(m, e)) continue;
    input_ends(q, u, v, end);
    if (end[0] == own[0] || end[0] == own[1] || end[1] == own[0] || end[1] == own[1]) continue;
    g = distance_to_segment(p, tri_xy(m, u), tri_xy(m, v));
    f = MIN(f, g);
  }
  return f;
}

static void consider_new(MinAngle *q)
{
  for (size_t i = 0; i < q->c.tri.len; i++) consider(q, q->c.tri.data[i]);
}

static bool split_segment(MinAngle *q, EdgeId e)
{
  Tri *m = q->r->m;
  VertId u = tri_org(m, e), v = tri_dest(m, e);
  double len = dist(m, u, v);
  if (!(0.4 * len > LEAST_PART * MIN(q->lfs.data[u], q->lfs.data[v]))) return false;
  double at = where_to_split(q, u, v, len);
  const double *a = tri_xy(m, u), *b = tri_xy(m, v);
  Vec2 p = {a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1])};
  if (q->r->p->split && !q->r->p->split(q->r->p->split_ctx, u, v, at, &p)) return false;
  if (tri_cavity_split(m, &q->c, (double[]){p.x, p.y}, e) != TRI_INSERTED) return false;
  VertId own[2];
  input_ends(q, u, v, own);
  double lfs = feature_at(q, (double[]){p.x, p.y}, own);
  double carried = carries_sizes(q) ? (1 - at) * q->r->carried[u] + at * q->r->carried[v] : 0;
  VertId w = tri_commit(m, &q->c);
  added_vertex(q, w, lfs, carried, own[0], own[1]);
  q->r->stats->split++;
  if (q->r->p->placed) q->r->p->placed(q->r->p->split_ctx, u, v, w);
  consider_new(q);
  return true;
}

// ---- skinny triangles ----------------------------------------------------------------------------------------------

// Do u and v, of which neither or one is an input vertex, lie on two segments that meet at an acute input vertex, at one distance
// from it, and under 60 degrees from each other? Then their distance is the input's doing. That vertex, or NONE.
static VertId shell_centre(const MinAngle *q, VertId u, VertId v)
{
  if (is_given(q, u) || is_given(q, v) || q->from.data[u] == NONE || q->from.data[v] == NONE) return NONE;
  const VertId eu[2] = {q->from.data[u], q->to.data[u]}, ev[2] = {q->from.data[v], q->to.data[v]};
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) {
      if (eu[i] != ev[j] || eu[1 - i] == ev[1 - j] || q->meet[eu[i]] != MEET_ACUTE) continue;
      double a = dist(q->r->m, eu[i], u), b = dist(q->r->m, eu[i], v);
      if (fabs(a - b) < 1e-3 * a && dist(q->r->m, u, v) < 1.001 * a) return eu[i];
    }
  return NONE;
}

// Is the angle opposite to the shortest side one between two input segments?
static bool is_input_angle(const MinAngle *q, EdgeId side)
{
  const Tri *m = q->r->m;
  VertId v = tri_apex(m, side);
  return is_given(q, v) && q->meet[v] == MEET_ACUTE && tri_is_segment(m, tri_next(side)) && tri_is_segment(m, tri_prev(side));
}

static bool excused(const MinAngle *q, EdgeId side)
{
  const Tri *m = q->r->m;
  return is_input_angle(q, side) || shell_centre(q, tri_org(m, side), tri_dest(m, side)) != NONE;
}

// The acute vertex of the input that keeps the triangle of `side`, its shortest, skinny: the one that excuses it, else a corner of
// the triangle or the end of an input segment that a corner lies on; NONE if there is none.
static VertId acute_vertex(const MinAngle *q, EdgeId side)
{
  const Tri *m = q->r->m;
  if (is_input_angle(q, side)) return tri_apex(m, side);
  VertId centre = shell_centre(q, tri_org(m, side), tri_dest(m, side));
  if (centre != NONE) return centre;
  TriId t = tri_of(side);
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++)
    if (is_given(q, m->vert[e]) && q->meet[m->vert[e]] == MEET_ACUTE) return m->vert[e];
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
    VertId v = m->vert[e];
    if (q->from.data[v] == NONE) continue;
    if (q->meet[q->from.data[v]] == MEET_ACUTE) return q->from.data[v];
    if (q->meet[q->to.data[v]] == MEET_ACUTE) return q->to.data[v];
  }
  return NONE;
}

static void count_skinny(MinAngle *q)
{
  const Tri *m = q->r->m;
  TriSkinnyVec *out = q->r->p->skinny_out;
  for (TriId t = 0; t < m->nt; t++) {
    EdgeId side;
    if (!tri_is_inside(m, t) || radius_edge2(m, t, &side) <= q->bound) continue;
    q->r->stats->skinny++;
    TriSkinny s = {t, acute_vertex(q, side)};
    if (out) vec_push(out, s);
  }
}

// The circumcentre, or the point before the shortest side under which it is seen at the angle wanted, if that is nearer.
static void off_centre(const MinAngle *q, EdgeId side, double *p)
{
  const Tri *m = q->r->m;
  const double *a = tri_xy(m, tri_org(m, side)), *b = tri_xy(m, tri_dest(m, side)), *c = tri_xy(m, tri_apex(m, side));
  metric_centre(a, b, c, p);
  double mid[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  double d = sqrt(metric_distance2(mid, p)), limit = q->off * sqrt(metric_distance2(a, b));
  if (d <= limit) return;
  for (int i = 0; i < 2; i++) p[i] = mid[i] + (p[i] - mid[i]) * (limit / d);
}

// Split what p would encroach upon, among the sides of its cavity. Returns how many sides it encroaches on; *split how many were.
static int yield_to_segments(MinAngle *q, const double *p, int *split)
{
  Tri *m = q->r->m;
  U32Vec ends = {0}; // splitting one changes half-edge ids: go by vertices
  for (size_t i = 0; i < q->c.rim.len; i++) {
    EdgeId e = q->c.rim.data[i];
    if (!tri_is_segment(m, e)) continue;
    const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
    if ((a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]) < 0)
      vec_push(&ends, tri_org(m, e)), vec_push(&ends, tri_dest(m, e));
  }
  *split = 0;
  for (size_t i = 0; i < ends.len; i += 2) {
    EdgeId e = tri_find_edge(m, ends.data[i], ends.data[i + 1]);
    if (e != NONE && tri_is_segment(m, e)) *split += split_segment(q, e);
  }
  int n = (int)ends.len / 2;
  vec_free(&ends);
  return n;
}

static bool too_near(const MinAngle *q, const double *p, double lfs)
{
  double least = INFINITY;
  for (size_t i = 0; i < q->c.rim.len; i++) {
    double d = metric_distance2(p, tri_xy(q->r->m, tri_org(q->r->m, q->c.rim.data[i])));
    if (d < least) least = d;
  }
  return sqrt(least) < LEAST_PART * lfs;
}

// Do something about triangle t; false if nothing can be done.
static bool improve(MinAngle *q, TriId t)
{
  Tri *m = q->r->m;
  EdgeId side = NONE, e, blocked;
  double p[2];
  radius_edge2(m, t, &side);
  if (excused(q, side)) return false;
  off_centre(q, side, p);
  if (!isfinite(p[0]) || !isfinite(p[1])) return false;
  TriId at = refine__walk(m, p, t, &blocked);
  if (at == NONE) return split_segment(q, blocked);
  TriLoc loc = tri_locate(m, p, 3 * at, &e);
  if (loc == TRI_ON_VERTEX || loc == TRI_OUTSIDE) return false;
  if (loc == TRI_ON_EDGE && tri_is_segment(m, e)) return split_segment(q, e);
  if (tri_cavity(m, &q->c, p, loc, e) != TRI_INSERTED) return false;
  int split;
  if (yield_to_segments(q, p, &split)) return split > 0;
  double lfs = feature_at(q, p, NULL);
  if (too_near(q, p, lfs)) return false;
  double carried = carries_sizes(q) ? refine__linear(m, q->r->carried, at, p) : 0;
  added_vertex(q, tri_commit(m, &q->c), lfs, carried, NONE, NONE);
  q->r->stats->inserted++;
  consider_new(q);
  return true;
}

// ---- entries -------------------------------------------------------------------------------------------------------

static void begin(MinAngle *q, Refiner *r, VertId given)
{
  *q = (MinAngle){.r = r, .given = given, .top = -1};
  tri_make_hints(r->m);
  input_features(q);
  find_acute(q);
  vec_reserve(&q->from, r->m->nv), vec_reserve(&q->to, r->m->nv);
  for (VertId v = 0; v < r->m->nv; v++) vec_push(&q->from, NONE), vec_push(&q->to, NONE);
}

static void finish(MinAngle *q)
{
  for (int k = 0; k < NKEYS; k++) vec_free(&q->stack[k]);
  vec_free(&q->lfs), vec_free(&q->from), vec_free(&q->to);
  free(q->meet);
  tri_cavity_free(&q->c);
}

void refine__min_angle(Refiner *r, double degrees, VertId given)
{
  Tri *m = r->m;
  MinAngle q;
  // The input is what was given; what was placed since can be taken as input as well: it is far from everything.
  (void)given;
  begin(&q, r, m->nv);
  double a = degrees * (M_PI / 180);
  q.bound = 1 / (4 * sin(a) * sin(a));
  q.off = 0.475 / tan(0.5 * a); // 5 % nearer than just good enough, as [Ungor04] advises
  for (TriId t = 0; t < m->nt; t++) consider(&q, t);
  TriId t;
  while ((t = take(&q)) != NONE && refine__go_on(r)) {
    VertId v[3] = {m->vert[3 * t], m->vert[3 * t + 1], m->vert[3 * t + 2]};
    if (improve(&q, t) && memcmp(v, m->vert + 3 * (size_t)t, sizeof v) == 0) consider(&q, t);
  }
  count_skinny(&q);
  finish(&q);
}

// Is segment e (one of its sides) encroached: is an apex inside its diametral circle?
static bool encroached(const Tri *m, EdgeId e)
{
  for (int k = 0; k < 2; k++, e = m->twin[e])
    if (tri_is_inside(m, tri_of(e)) &&
        in_diametral_circle(tri_xy(m, tri_org(m, e)), tri_xy(m, tri_dest(m, e)), tri_xy(m, tri_apex(m, e))) > 0)
      return true;
  return false;
}

void refine__conform(Refiner *r)
{
  Tri *m = r->m;
  MinAngle q;
  begin(&q, r, m->nv);
  q.bound = INFINITY; // no triangle is skinny
  U32Vec work = {0};
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (m->twin[e] > e && tri_is_segment(m, e)) vec_push(&work, tri_org(m, e)), vec_push(&work, tri_dest(m, e));
  while (work.len && refine__go_on(r)) {
    VertId v = vec_pop(&work), u = vec_pop(&work);
    EdgeId e = tri_find_edge(m, u, v);
    if (e == NONE || !tri_is_segment(m, e) || !encroached(m, e) || !split_segment(&q, e)) continue;
    // The halves, and the segments that the new vertex may encroach upon: those opposite to it.
    VertId w = m->nv - 1;
    vec_push(&work, u), vec_push(&work, w), vec_push(&work, w), vec_push(&work, v);
    for (size_t i = 0; i < q.c.tri.len; i++) {
      EdgeId o = 3 * q.c.tri.data[i];
      if (tri_is_segment(m, o)) vec_push(&work, tri_org(m, o)), vec_push(&work, tri_dest(m, o));
    }
  }
  vec_free(&work);
  finish(&q);
}
