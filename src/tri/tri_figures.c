// tri_figures.c - what the mesh of a small face is worth, in the figures that a report prints
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/tri_polish.h"

// What is worse than the reference counts this much; of the 5th percentile and the smallest angle, which vary more, only a share.
#define MISSING 30.0
#define OF_WORST 0.3

static int smaller_first(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double mean_length_cost(const Refiner *r)
{
  const Tri *m = r->m;
  double sum = 0, n = 0;
  for (EdgeId e = 0; e < 3 * m->nt; e++) {
    if (!tri_is_inside(m, tri_of(e))) continue;
    double share = tri_is_segment(m, e) ? 1 : 0.5;
    VertId a = tri_org(m, e), b = tri_dest(m, e);
    sum += share * polish__length(metric_length_graded(tri_xy(m, a), tri_xy(m, b), r->size[a], r->size[b]));
    n += share;
  }
  return n > 0 ? sum / n : 0;
}

PolishFigures polish__figures(const Refiner *r)
{
  const Tri *m = r->m;
  PolishFigures out = {.length = mean_length_cost(r), .sine2 = polish__sine2(r), .worst = 1, .gamma = 1, .fifth = 1};
  Vec(double) gamma = {0};
  double sum = 0, badness = 0;
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    double g = metric_quality(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]));
    vec_push(&gamma, g);
    sum += g, badness += polish__badness(1 / g, 1, POLISH_TAIL);
  }
  if (gamma.len) {
    qsort(gamma.data, gamma.len, sizeof *gamma.data, smaller_first);
    out.worst = 1 / gamma.data[0], out.fifth = gamma.data[(gamma.len + 19) / 20 - 1];
    out.gamma = sum / (double)gamma.len, out.shape = badness / (double)gamma.len;
  }
  vec_free(&gamma);
  return out;
}

double polish__cost(const PolishFigures *f, const PolishFigures *reference)
{
  double sine = sqrt(fmin(POLISH_SINE2, f->sine2)), wanted = sqrt(fmin(POLISH_SINE2, reference->sine2));
  double missing = fmax(0, reference->gamma - f->gamma) + fmax(0, f->length - reference->length) +
                   OF_WORST * (fmax(0, reference->fifth - f->fifth) + fmax(0, wanted - sine));
  return f->shape + POLISH_LENGTHS * f->length + POLISH_ANGLE * (sqrt(POLISH_SINE2) - sine) + MISSING * missing;
}
