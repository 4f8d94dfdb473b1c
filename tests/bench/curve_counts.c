// curve_counts.c - mesh the curves of .geo files; print total edges, with -v the count of every curve, or with -l how well the
// lengths of the edges fit the sizes, per file and in all, with the reason of every edge that does not (-L: curve by curve)
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "base/stats.h"
#include "geom/quadrature.h"
#include "geom/quality.h"
#include "mesh/mesh1d_int.h"
#include "script/script.h"

// `Mesh 1;` and its kin in a script: counts are all we want.
static bool ignore_mesh(void *ctx, MeshCommand what, double number, const char *text, SrcLoc loc)
{
  (void)ctx, (void)what, (void)number, (void)text, (void)loc;
  return true;
}

static bool ignore_save(void *ctx, const char *path, SrcLoc loc)
{
  (void)ctx, (void)path, (void)loc;
  return true;
}

// ---- adimensional lengths [book eq. 4.16, 4.17] -----------------------------------------------------------------------
// Why an edge is not within [2/3, 4/3] of the size.
typedef enum {
  WHY_SHORT,  // its curve is shorter than 2/3
  WHY_ROUND,  // its curve is 1.01 to 4/3 long: counts are rounded up
  WHY_LEAST,  // the least count of such a curve or loop
  WHY_EVEN,   // a count made even beside a face of quadrangles
  WHY_GROWTH, // its size is less, as sizes grow along curves by Mesh.SmoothRatio or Mesh.SizeGradation at most
  WHY_DROP,   // where sizes grow too fast, a node nearer than 0.3 of the size to the one before was dropped
  WHY_CROSS,  // halved, as it crossed another one
  WHY_NONE,
  WHYS
} Why;

static const char *const why_text[WHYS] = {
  "curves shorter than 2/3 of the size, which get one edge",
  "curves 1.01 to 4/3 long, which get two edges: counts are rounded up",
  "least counts of curves (Mesh.MinimumCircleNodes, ...) and of loops of one or two curves",
  "even counts beside faces of quadrangles",
  "sizes that may not grow faster along the curve (Mesh.SmoothRatio, Mesh.SizeGradation)",
  "nodes dropped where such sizes set them closer than 0.3 of the size",
  "edges halved where they crossed others",
  "no reason",
};

typedef struct {
  size_t files, curves, edges, good; // edges with a length in [2/3, 4/3]
  size_t raised;                     // curves with more or fewer edges than their size asks for: even counts, least counts, dropped nodes
  size_t long_edges, long_good;      // edges on the other curves of an adimensional length of at least 2
  double least, most, long_tau;      // among these
  size_t smooth;                     // others of these on which the size changes by less than SmoothRatio allows
  double uneven;                     // on these: the largest |length / (a/N) - 1|
  double tau_sum;
  size_t why[WHYS];
} Fit;

// What the boundary of faces asks of a curve.
typedef struct {
  uint32_t least;
  bool even;
} Demand;

typedef struct {
  const Model *m;
  const Curve *c;
  SizeEval *eval;
  double from, to;
} Stretch;

// |x'| / h over [from, to], as a function over [0, 1].
static void density(void *ctx, const double *t, size_t n, double *f)
{
  const Stretch *s = ctx;
  for (size_t i = 0; i < n; i++) {
    double u = s->from + t[i] * (s->to - s->from);
    f[i] = (s->to - s->from) * vec3_length(curve_deriv(s->m, s->c, u)) / size_on_curve(s->eval, s->c, u, curve_point(s->m, s->c, u));
  }
}

static double length_of(Stretch s)
{
  Integral q;
  integral_make(&q, density, &s, 4, 1e-10, 4096);
  double l = integral_total(&q);
  integral_free(&q);
  return l;
}

// The largest growth |dh/ds|, sampled.
static double steepest(const Stretch *s, uint32_t n)
{
  double most = 0, h0 = 0;
  Vec3 p0 = {0, 0, 0};
  uint32_t places = 8 * n;
  for (uint32_t i = 0; i <= places; i++) {
    double u = (double)i / places;
    Vec3 p = curve_point(s->m, s->c, u);
    double h = size_on_curve(s->eval, s->c, u, p);
    if (i) most = fmax(most, fabs(h - h0) / vec3_distance(p, p0));
    h0 = h, p0 = p;
  }
  return most;
}

// Curves whose count the size decides: none with a law, layers, or a copy.
static bool is_free(const Curve *c, const CurveMesh *cm)
{
  return cm->n >= 2 && c->transfinite <= 0 && !c->copy_of && !c->periodic_master && !(c->extruded_point && c->layers.n > 0);
}

static bool fits(double l) { return l >= 2.0 / 3 && l <= 4.0 / 3; }

// An edge's length by the limited sizes at its nodes, between them linear.
static double graded_length(const CurveMesh *cm, uint32_t i)
{
  double a = cm->h[i], b = cm->h[i + 1], ds = vec3_distance(cm->p[i], cm->p[i + 1]), x = b / a - 1;
  return fabs(x) < 1e-8 ? ds / a : ds * log1p(x) / (b - a);
}

// Why edges of a curve of that length in sizes with n edges do not fit, if the sizes do not say it.
static Why reason(double sum, uint32_t n, const Demand *d, bool split)
{
  uint32_t want = (uint32_t)fmax(1, floor(sum + 0.99 + 1e-9)), base = MAX(want, d->least);
  if (n == want && n == 1 && sum < 2.0 / 3) return WHY_SHORT;
  if (n == want && n == 2 && sum < 4.0 / 3) return WHY_ROUND;
  if (n == d->least && n > want) return WHY_LEAST;
  if (d->even && n % 2 == 0 && n > base && n < base + 4) return WHY_EVEN;
  return split ? WHY_CROSS : WHY_NONE;
}

static void explain(Fit *fit, const Stretch *s, const CurveMesh *cm, const double *length, const Demand *d, bool split, bool list)
{
  uint32_t n = cm->n - 1;
  double sum = 0, graded = 0;
  for (uint32_t i = 0; i < n; i++) sum += length[i], graded += graded_length(cm, i);
  Why of_sizes = reason(sum, n, d, split), of_graded = reason(graded, n, d, split);
  for (uint32_t i = 0; i < n; i++) {
    if (fits(length[i])) continue;
    // By the rounding of counts: whichever sizes explain it. Else the limited sizes are what the edge fits.
    Why why = of_sizes != WHY_NONE ? of_sizes : of_graded;
    if (why == WHY_NONE && graded > sum * (1 + 1e-6))
      why = fits(graded_length(cm, i)) ? WHY_GROWTH : graded_length(cm, i) > 4.0 / 3 ? WHY_DROP : WHY_NONE;
    fit->why[why]++;
    if (list)
      printf("curve %d, edge %u of %u: %.4f (by limited sizes %.4f); the curve %.4f (%.4f): %s\n", s->c->tag, i + 1, n, length[i],
             graded_length(cm, i), sum, graded, why_text[why]);
  }
}

static void measure_curve(Fit *fit, Stretch s, const CurveMesh *cm, const Options *o, const Demand *d, bool split, bool list)
{
  uint32_t n = cm->n - 1;
  double sum = 0, lo = INFINITY, hi = 0, tau = 0, *length = mem_alloc(n * sizeof *length);
  size_t good = 0;
  for (uint32_t i = 0; i < n; i++) {
    s.from = cm->u[i], s.to = cm->u[i + 1];
    double l = length[i] = length_of(s);
    sum += l;
    lo = fmin(lo, l), hi = fmax(hi, l);
    good += fits(l);
    tau += quality_tau_term(l);
  }
  explain(fit, &s, cm, length, d, split, list);
  free(length);
  fit->tau_sum += tau;
  fit->curves++;
  fit->edges += n;
  fit->good += good;
  bool raised = n != fmax(1, floor(sum + 0.99));
  fit->raised += raised;
  if (sum >= 2 && !raised) {
    fit->long_edges += n;
    fit->long_good += good;
    fit->long_tau += tau;
    fit->least = fmin(fit->least, lo);
    fit->most = fmax(fit->most, hi);
  }
  if (!raised && steepest(&s, n) < 0.95 * (sqrt(o->Mesh_SmoothRatio) - 1)) {
    double mean = sum / n;
    fit->smooth++;
    fit->uneven = fmax(fit->uneven, fmax(hi / mean - 1, 1 - lo / mean));
  }
}

static void print_fit(const char *name, const Fit *f)
{
  printf("%s: %zu free curves, %zu edges, %.2f %% in [2/3, 4/3], tau %.4f; %zu curves have other counts than the size asks for; on the "
         "others of length 2 and more: %zu edges, %.2f %%, %.4f to %.4f, tau %.4f; %zu smooth curves, uneven by %.2g\n",
         name, f->curves, f->edges, 100 * (double)f->good / (double)MAX(f->edges, 1), exp(f->tau_sum / (double)MAX(f->edges, 1)),
         f->raised, f->long_edges, 100 * (double)f->long_good / (double)MAX(f->long_edges, 1), f->least, f->most,
         exp(f->long_tau / (double)MAX(f->long_edges, 1)), f->smooth, f->uneven);
}

static void add_fit(Fit *to, const Fit *f)
{
  to->files++;
  to->curves += f->curves;
  to->edges += f->edges;
  to->good += f->good;
  to->raised += f->raised;
  to->long_edges += f->long_edges;
  to->long_good += f->long_good;
  to->long_tau += f->long_tau;
  to->least = fmin(to->least, f->least);
  to->most = fmax(to->most, f->most);
  to->smooth += f->smooth;
  to->uneven = fmax(to->uneven, f->uneven);
  to->tau_sum += f->tau_sum;
  for (int i = 0; i < WHYS; i++) to->why[i] += f->why[i];
}

static void print_reasons(const Fit *f)
{
  printf("edges of other lengths, by reason:\n");
  for (int i = 0; i < WHYS; i++) printf("%8zu  %s\n", f->why[i], why_text[i]);
}

static Demand *demands(const Mesh1d *g, const Options *o)
{
  Demand *d = mem_zalloc((g->ncurve + 1) * sizeof *d);
  for (size_t k = 0; k < g->ncurve; k++) d[k].least = mesh1d__least_segments(g->model, o, model_curve_at(g->model, k));
  for (size_t k = 0; k < model_faces(g->model); k++) {
    const Face *f = model_face_at(g->model, k);
    for (int i = 0; i < f->nloop; i++) {
      const Loop *loop = model_loop(g->model, f->loop[i]);
      for (int j = 0; loop && j < loop->ncurve; j++) {
        uint32_t c = mesh1d_index(g, loop->curve[j]);
        if (c == NONE) continue;
        d[c].even |= o->Mesh_RecombineAll || f->recombine;
        if (loop->ncurve <= 2) d[c].least = MAX(d[c].least, loop->ncurve == 1 ? 3u : 2u);
      }
    }
  }
  return d;
}

static void measure_file(const char *path, const Mesh1d *g, const SizeField *size, const Options *o, bool list, Fit *total)
{
  Fit fit = {.least = INFINITY};
  Demand *d = demands(g, o);
  SizeEval *eval = size_eval_new(size);
  for (size_t k = 0; k < g->ncurve; k++) {
    const Curve *c = model_curve_at(g->model, k);
    if (is_free(c, &g->curve[k]))
      measure_curve(&fit, (Stretch){g->model, c, eval, 0, 1}, &g->curve[k], o, &d[k], g->nsplit && c->type != CURVE_LINE, list);
  }
  free(d);
  size_eval_free(eval);
  if (!fit.curves) return;
  print_fit(path, &fit);
  add_fit(total, &fit);
}

static int run(const char *path, bool verbose, bool list, Fit *lengths)
{
  Diag *diag = diag_new(true);
  Model *m = model_new();
  Options o;
  options_init(&o);
  FieldSet *f = fields_new();
  ScriptHost host = {.mesh = ignore_mesh, .save = ignore_save};
  Script *s = script_new(m, &o, f, diag, &host);
  double t0 = time_cpu();
  script_run_file(s, path);
  bool good = diag_errors(diag) == 0 && model_prepare(m, o.Geometry_Tolerance, diag);
  double t1 = time_cpu();
  SizeField *size = good ? size_new(m, &o, f, diag) : NULL;
  double t2 = time_cpu();
  Mesh1d *g = size ? mesh1d_new(m, &o, size, diag) : NULL;
  double t3 = time_cpu();
  size_t total = 0;
  for (size_t k = 0; g && k < g->ncurve; k++) {
    if (g->curve[k].n) total += g->curve[k].n - 1;
    if (verbose) printf("%d %d\n", model_curve_at(m, k)->tag, g->curve[k].n ? (int)g->curve[k].n - 1 : 0);
  }
  if (g && g->rounds) printf("%u rounds, %u edges halved\n", g->rounds, g->nsplit);
  if (g && lengths) measure_file(path, g, size, &o, list, lengths);
  else if (g) printf("%s %zu edges, read %.3f size %.3f mesh %.3f s\n", path, total, t1 - t0, t2 - t1, t3 - t2);
  else printf("%s failed\n", path);
  mesh1d_free(g);
  size_free(size);
  script_free(s);
  fields_free(f);
  options_free(&o);
  model_free(m);
  diag_free(diag);
  return g == NULL;
}

int main(int argc, char **argv)
{
  bool verbose = argc > 1 && !strcmp(argv[1], "-v"), list = argc > 1 && !strcmp(argv[1], "-L");
  bool lengths = list || (argc > 1 && !strcmp(argv[1], "-l"));
  Fit total = {.least = INFINITY};
  int bad = 0;
  for (int i = 1 + (verbose || lengths); i < argc; i++) bad += run(argv[i], verbose, list, lengths ? &total : NULL);
  if (lengths) print_fit("all", &total), print_reasons(&total);
  return bad != 0;
}
