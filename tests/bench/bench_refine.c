// bench_refine.c - the strategies of refinement on domains of its own making: time, quality, pictures
// SPDX-License-Identifier: MIT
//
//   bench_refine CASE H [-algo N] [-smooth N] [-opt N] [-angle A] [-reps N] [-png FILE] [-zoom X Y R] [-noextend]
//
// CASE: square | rect (1 x 3, h = H (0.1 + 0.08 sin 3x cos 6y)) | disc | holes | ell | gap | spike | star | file:PATH
// Prints a line of figures; with -reps the time is the median.
#include "base/base.h"

#include "base/mem.h"
#include "base/rng.h"
#include "base/stats.h"
#include "geom/quality.h"
#include "tri/refine.h"

#include <cairo.h>
#include <math.h>

static double number(const char *s) { return strtod(s, NULL); }

typedef struct {
  const char *name;
  double h;
  SizeAt size;        // NULL: uniform h on the boundary, nothing inside
  DoubleVec xy;       // boundary points
  U32Vec ends;        // segments
} Domain;

static double rect_size(void *ctx, Vec2 p)
{
  return ((Domain *)ctx)->h * (0.1 + 0.08 * sin(3 * p.x) * cos(6 * p.y));
}
static double uniform_size(void *ctx, Vec2 p)
{
  (void)p;
  return ((Domain *)ctx)->h;
}

// Points of a straight side by equal steps of the integral of dl/h, without its last end.
static void side(Domain *d, Vec2 a, Vec2 b)
{
  enum { FINE = 4000 };
  SizeAt size = d->size ? d->size : uniform_size;
  double *sum = mem_alloc((FINE + 1) * sizeof *sum);
  Vec2 u = vec2_sub(b, a);
  double step = vec2_length(u) / FINE;
  sum[0] = 0;
  for (int i = 1; i <= FINE; i++)
    sum[i] = sum[i - 1] + step / size(d, vec2_add(a, vec2_scale((i - 0.5) / FINE, u)));
  int n = (int)ceil(sum[FINE] - 0.01);
  if (n < 1) n = 1;
  for (int k = 0, i = 0; k < n; k++) {
    double want = sum[FINE] * k / n;
    while (i < FINE - 1 && sum[i + 1] < want) i++;
    double t = (i + (want - sum[i]) / (sum[i + 1] - sum[i])) / FINE;
    Vec2 p = vec2_add(a, vec2_scale(t, u));
    vec_push(&d->xy, p.x), vec_push(&d->xy, p.y);
  }
  free(sum);
}

static void close_loop(Domain *d, size_t first)
{
  size_t n = d->xy.len / 2;
  for (size_t i = first; i < n; i++) {
    vec_push(&d->ends, (uint32_t)i);
    vec_push(&d->ends, (uint32_t)(i + 1 < n ? i + 1 : first));
  }
}

static void polygon(Domain *d, const Vec2 *p, size_t n)
{
  size_t first = d->xy.len / 2;
  for (size_t i = 0; i < n; i++) side(d, p[i], p[(i + 1) % n]);
  close_loop(d, first);
}

static void circle(Domain *d, Vec2 c, double radius)
{
  size_t first = d->xy.len / 2;
  int n = (int)ceil(2 * M_PI * radius / d->h - 0.01);
  if (n < 7) n = 7;
  for (int i = 0; i < n; i++) {
    vec_push(&d->xy, c.x + radius * cos(2 * M_PI * i / n));
    vec_push(&d->xy, c.y + radius * sin(2 * M_PI * i / n));
  }
  close_loop(d, first);
}

// Loops of points from a file: "x y" lines, loops parted by empty lines.
static bool read_loops(Domain *d, const char *path)
{
  FILE *f = fopen(path, "r");
  if (!f) return false;
  char line[256];
  Vec(Vec2) p = {0};
  bool more = true;
  while (more) {
    Vec2 v;
    more = fgets(line, sizeof line, f) != NULL;
    if (more && sscanf(line, "%lf %lf", &v.x, &v.y) == 2) {
      vec_push(&p, v);
    } else if (p.len) {
      polygon(d, p.data, p.len);
      vec_clear(&p);
    }
  }
  vec_free(&p);
  fclose(f);
  return true;
}

static bool make_domain(Domain *d)
{
  if (!strncmp(d->name, "file:", 5)) return read_loops(d, d->name + 5);
  if (!strcmp(d->name, "square")) {
    polygon(d, (Vec2[]){{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 4);
  } else if (!strcmp(d->name, "rect")) {
    d->size = rect_size;
    polygon(d, (Vec2[]){{0, 0}, {1, 0}, {1, 3}, {0, 3}}, 4);
  } else if (!strcmp(d->name, "disc")) {
    circle(d, (Vec2){0, 0}, 1);
  } else if (!strcmp(d->name, "holes")) {
    polygon(d, (Vec2[]){{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 4);
    circle(d, (Vec2){0.5, 0.5}, 0.25);
    circle(d, (Vec2){1.2, 0.3}, 0.1);
    polygon(d, (Vec2[]){{1.5, 0.5}, {1.8, 0.6}, {1.6, 0.8}}, 3);
  } else if (!strcmp(d->name, "ell")) {
    polygon(d, (Vec2[]){{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 6);
  } else if (!strcmp(d->name, "gap")) {
    polygon(d, (Vec2[]){{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 4);
    polygon(d, (Vec2[]){{0.5, 0.01}, {1.5, 0.01}, {1.5, 0.5}, {0.5, 0.5}}, 4);
  } else if (!strcmp(d->name, "spike")) {
    polygon(d, (Vec2[]){{0, 0}, {4, 0}, {4, 0.35}, {0.5, 3}}, 4);
  } else if (!strcmp(d->name, "star")) {
    Vec2 p[24];
    for (int i = 0; i < 24; i++)
      p[i] = vec2_scale(i % 2 ? 0.5 : 1.0, (Vec2){cos(i * M_PI / 12), sin(i * M_PI / 12)});
    polygon(d, p, 24);
  } else {
    return false;
  }
  return true;
}

static void empty_mesh(const Domain *d, Tri *m)
{
  tri_init(m);
  TriBuild how = {.reorder = false};
  CHECK(tri_build(m, d->xy.data, d->xy.len / 2, &how) == TRI_BUILD_GOOD);
  CHECK(tri_insert_segments(m, d->ends.data, NULL, d->ends.len / 2, NULL) == 0);
  tri_carve(m, &(TriCarve){.even_odd = true});
}

static void inside(const Tri *m, U32Vec *tri)
{
  vec_clear(tri);
  for (TriId t = 0; t < m->nt; t++)
    if (tri_is_inside(m, t))
      for (int i = 0; i < 3; i++) vec_push(tri, m->vert[3 * t + i]);
}

static void colour(cairo_t *c, double gamma)
{
  // White for equilateral, through yellow to red at gamma 0.6 and below.
  double f = fmin(1, fmax(0, (1 - gamma) / 0.4));
  cairo_set_source_rgb(c, 1, 1 - 0.9 * fmax(0, f - 0.25) / 0.75, 1 - fmin(1, 3 * f));
}

static void picture(const Tri *m, const U32Vec *tri, const char *file, Vec2 centre, double radius)
{
  enum { SIDE = 1400 };
  cairo_surface_t *s = cairo_image_surface_create(CAIRO_FORMAT_RGB24, SIDE, SIDE);
  cairo_t *c = cairo_create(s);
  cairo_set_source_rgb(c, 0.8, 0.8, 0.85);
  cairo_paint(c);
  cairo_translate(c, SIDE / 2., SIDE / 2.);
  double k = SIDE / (2 * radius);
  cairo_scale(c, k, -k);
  cairo_translate(c, -centre.x, -centre.y);
  uint32_t *valence = mem_zalloc(m->nv * sizeof *valence);
  bool *rim = mem_zalloc(m->nv);
  cairo_set_line_width(c, 0.6 / k);
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    Vec2 p[3];
    for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
      VertId v = m->vert[e];
      p[e % 3] = (Vec2){m->xy[2 * v], m->xy[2 * v + 1]};
      valence[v]++;
      if (tri_is_segment(m, e)) rim[v] = rim[tri_dest(m, e)] = true;
    }
    cairo_move_to(c, p[0].x, p[0].y), cairo_line_to(c, p[1].x, p[1].y), cairo_line_to(c, p[2].x, p[2].y);
    cairo_close_path(c);
    colour(c, quality_gamma(shape_plane(p[0], p[1], p[2])));
    cairo_fill_preserve(c);
    cairo_set_source_rgb(c, 0.3, 0.3, 0.3);
    cairo_stroke(c);
  }
  double side = sqrt(4 * radius * radius / (tri->len / 6. + 1));
  for (VertId v = 0; v < m->nv; v++) {
    if (rim[v] || valence[v] == 6 || valence[v] == 0) continue;
    cairo_set_source_rgb(c, valence[v] > 6, valence[v] == 7 ? 0.4 : 0, valence[v] < 6);
    cairo_arc(c, m->xy[2 * v], m->xy[2 * v + 1], fmax(2.5 / k, 0.12 * side), 0, 7);
    cairo_fill(c);
  }
  cairo_surface_write_to_png(s, file);
  cairo_destroy(c);
  cairo_surface_destroy(s);
  free(valence), free(rim);
}

static int by_value(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
  if (argc < 3) {
    puts("bench_refine CASE H [options]; see the head of tests/bench/bench_refine.c");
    return 2;
  }
  Domain d = {.name = argv[1], .h = number(argv[2])};
  TriRefineParams p = tri_refine_defaults();
  const char *png = NULL;
  Vec2 centre = {NAN, NAN};
  double radius = 0;
  int reps = 1;
  bool extend = true;
  for (int i = 3; i < argc; i++) {
    if (!strcmp(argv[i], "-algo")) p.algorithm = (RefineAlgorithm)number(argv[++i]);
    else if (!strcmp(argv[i], "-smooth")) p.smoothing = (int)number(argv[++i]);
    else if (!strcmp(argv[i], "-opt")) p.optimize = (int)number(argv[++i]);
    else if (!strcmp(argv[i], "-angle")) p.min_angle = number(argv[++i]);
    else if (!strcmp(argv[i], "-reps")) reps = (int)number(argv[++i]);
    else if (!strcmp(argv[i], "-png")) png = argv[++i];
    else if (!strcmp(argv[i], "-noextend")) extend = false;
    else if (!strcmp(argv[i], "-zoom")) {
      centre.x = number(argv[i + 1]), centre.y = number(argv[i + 2]), radius = number(argv[i + 3]);
      i += 3;
    }
  }
  if (!make_domain(&d)) return 2;
  p.size = d.size, p.size_ctx = &d;
  p.extend_from_boundary = extend && !d.size;
  double *time = mem_alloc((size_t)reps * sizeof *time), built = 0;
  Tri m;
  TriRefineStats stats = {0};
  for (int k = 0; k < reps; k++) {
    if (k) tri_free(&m);
    double t0 = time_cpu();
    empty_mesh(&d, &m);
    double t1 = time_cpu();
    stats = tri_refine(&m, &p);
    time[k] = time_cpu() - t1;
    built = t1 - t0;
  }
  qsort(time, (size_t)reps, sizeof *time, by_value);
  size_t wrong = tri_check(&m, TRI_CHECK_LINKS | TRI_CHECK_ORIENT | TRI_CHECK_EULER, NULL);
  U32Vec tri = {0};
  inside(&m, &tri);
  MeshQuality q = quality_measure(m.xy, m.nv, tri.data, tri.len / 3, d.size ? d.size : uniform_size, &d);
  printf("%s %g algo %d: %zu tri, empty %.3f s, refine %.3f s (%.2f us/tri), gamma min %.3f p5 %.3f mean %.4f, "
         "angles %.1f %.1f, valence6 %.2f%%, tau %.4f, dmp %zu, ins %zu flips %zu moves %zu coll %zu, skinny %zu, check %zu, %zu MB\n",
         d.name, d.h, (int)p.algorithm, q.ntri, built, time[reps / 2], 1e6 * time[reps / 2] / (double)q.ntri, q.gamma_min,
         q.gamma_p5, q.gamma_mean, q.angle_min, q.angle_max, 100 * q.valence6, q.tau, q.nmaximum, stats.inserted, stats.flips,
         stats.moves, stats.collapses, stats.skinny, wrong + q.ninverted, mem_peak() >> 20);
  if (png) {
    Vec2 lo = {INFINITY, INFINITY}, hi = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < d.xy.len; i += 2) {
      lo = (Vec2){fmin(lo.x, d.xy.data[i]), fmin(lo.y, d.xy.data[i + 1])};
      hi = (Vec2){fmax(hi.x, d.xy.data[i]), fmax(hi.y, d.xy.data[i + 1])};
    }
    if (radius == 0) {
      centre = vec2_scale(0.5, vec2_add(lo, hi));
      radius = 0.51 * fmax(hi.x - lo.x, hi.y - lo.y);
    }
    picture(&m, &tri, png, centre, radius);
  }
  tri_free(&m);
  vec_free(&tri), vec_free(&d.xy), vec_free(&d.ends);
  free(time);
  return wrong != 0;
}
