// curve_counts.c - mesh the curves of .geo files; print total edges, with -v the count of every curve, or with -l how well the
// lengths of the edges fit the sizes, per file and in all
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>

#include "base/stats.h"
#include "geom/quadrature.h"
#include "geom/quality.h"
#include "mesh/mesh1d.h"
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
typedef struct {
  size_t files, curves, edges, good; // edges with a length in [2/3, 4/3]
  size_t raised;                     // curves with more or fewer edges than their size asks for: even counts, least counts, dropped nodes
  size_t long_edges, long_good;      // edges on the other curves of an adimensional length of at least 2
  double least, most, long_tau;      // among these
  size_t smooth;                     // others of these on which the size changes by less than SmoothRatio allows
  double uneven;                     // on these: the largest |length / (a/N) - 1|
  double tau_sum;
} Fit;

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

static void measure_curve(Fit *fit, Stretch s, const CurveMesh *cm, const Options *o)
{
  uint32_t n = cm->n - 1;
  double sum = 0, lo = INFINITY, hi = 0, tau = 0;
  size_t good = 0;
  for (uint32_t i = 0; i < n; i++) {
    s.from = cm->u[i], s.to = cm->u[i + 1];
    double l = length_of(s);
    sum += l;
    lo = fmin(lo, l), hi = fmax(hi, l);
    good += l >= 2.0 / 3 && l <= 4.0 / 3;
    tau += quality_tau_term(l);
  }
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
}

static void measure_file(const char *path, const Mesh1d *g, const SizeField *size, const Options *o, Fit *total)
{
  Fit fit = {.least = INFINITY};
  SizeEval *eval = size_eval_new(size);
  for (size_t k = 0; k < g->ncurve; k++) {
    const Curve *c = model_curve_at(g->model, k);
    if (is_free(c, &g->curve[k])) measure_curve(&fit, (Stretch){g->model, c, eval, 0, 1}, &g->curve[k], o);
  }
  size_eval_free(eval);
  if (!fit.curves) return;
  print_fit(path, &fit);
  add_fit(total, &fit);
}

static int run(const char *path, bool verbose, Fit *lengths)
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
  if (g && lengths) measure_file(path, g, size, &o, lengths);
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
  bool verbose = argc > 1 && !strcmp(argv[1], "-v"), lengths = argc > 1 && !strcmp(argv[1], "-l");
  Fit total = {.least = INFINITY};
  int bad = 0;
  for (int i = 1 + (verbose || lengths); i < argc; i++) bad += run(argv[i], verbose, lengths ? &total : NULL);
  if (lengths) print_fit("all", &total);
  return bad != 0;
}
