// quad_smooth.c - moving vertices: never to the harm of the worst element around
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

// ---- stars

QuadStars quad__stars(const QuadMesh *m)
{
  size_t nv = m->xy.len, ns = m->vertex.len;
  QuadStars s = {mem_zalloc((nv + 2) * sizeof *s.start), mem_alloc((ns + 1) * sizeof *s.at)};
  for (size_t i = 0; i < ns; i++)
    if (m->vertex.data[i] != NONE) s.start[m->vertex.data[i] + 2]++;
  for (size_t v = 0; v < nv; v++) s.start[v + 2] += s.start[v + 1];
  for (size_t i = 0; i < ns; i++)
    if (m->vertex.data[i] != NONE) s.at[s.start[m->vertex.data[i] + 1]++] = (uint32_t)(i / 4);
  return s;
}

void quad__stars_free(QuadStars *s)
{
  free(s->start);
  free(s->at);
}

// ---- the whole mesh

static size_t collect_star(const QuadMesh *m, const QuadStars *s, uint32_t v, uint32_t *corner, size_t max)
{
  size_t n = s->start[v + 1] - s->start[v];
  if (n > max) return 0;
  for (size_t i = 0; i < n; i++)
    for (int k = 0; k < 4; k++) corner[4 * i + (size_t)k] = m->vertex.data[4 * (size_t)s->at[s->start[v] + i] + (size_t)k];
  return n;
}

typedef struct {
  double skew;
  uint32_t element;
} Ranked;

static int worse_first(const void *a, const void *b)
{
  const Ranked *p = a, *q = b;
  if (p->skew != q->skew) return p->skew > q->skew ? -1 : 1;
  return p->element < q->element ? -1 : p->element > q->element;
}

enum { MAX_STAR = 32, WORST_STEPS = 6, EXACT_PASSES = 1 };

// `steps` of quad__improve; 0: quad__relax instead.
static bool improve(QuadMesh *m, const QuadStars *s, uint32_t v, int steps, double floor, uint32_t *corner, size_t *n)
{
  const QuadSize *size = m->size.len ? m->size.data : NULL;
  *n = collect_star(m, s, v, corner, MAX_STAR);
  if (!*n) return false;
  return steps ? quad__improve(m->xy.data, size, v, corner, *n, steps, floor) : quad__relax(m->xy.data, size, v, corner, *n, floor);
}

// The corners of bad elements, worst element first, with a longer search.
static void improve_worst(QuadMesh *m, const QuadStars *s, double floor)
{
  Vec(Ranked) bad = {0};
  uint32_t corner[4 * MAX_STAR];
  double good = quad__skew_of_shape(QUAD_GOOD_SHAPE);
  for (uint32_t e = 0; e < quad_mesh_elements(m); e++) {
    double skew = quad__skew(m->xy.data, &m->vertex.data[4 * (size_t)e]);
    if (skew > good) vec_push(&bad, ((Ranked){skew, e}));
  }
  if (bad.len) qsort(bad.data, bad.len, sizeof *bad.data, worse_first);
  for (size_t i = 0; i < bad.len; i++)
    for (int k = 0; k < 4; k++) {
      uint32_t v = m->vertex.data[4 * (size_t)bad.data[i].element + (size_t)k];
      size_t n;
      if (v != NONE && !m->fixed.data[v]) improve(m, s, v, WORST_STEPS, floor, corner, &n);
    }
  vec_free(&bad);
}

double quad__floor(const QuadMesh *m)
{
  double worst = 0, good = quad__skew_of_shape(QUAD_GOOD_SHAPE);
  for (size_t e = 0; e < quad_mesh_elements(m); e++) worst = fmax(worst, quad__skew(m->xy.data, &m->vertex.data[4 * e]));
  return fmin(worst, good);
}

void quad_smooth(QuadMesh *m, int passes)
{
  double floor = quad__floor(m);
  QuadStars s = quad__stars(m);
  uint32_t corner[4 * MAX_STAR];
  uint8_t *still = mem_zalloc(m->xy.len + 1); // vertices that did not move in the last pass, nor their neighbours
  for (int pass = 0; pass < passes; pass++) {
    for (uint32_t v = 0; v < m->xy.len; v++) {
      if (m->fixed.data[v] || (pass > 0 && still[v])) continue;
      still[v] = 1;
      size_t n;
      if (improve(m, &s, v, passes - pass <= EXACT_PASSES, floor, corner, &n))
        for (size_t i = 0; i < 4 * n; i++)
          if (corner[i] != NONE) still[corner[i]] = 0;
    }
    improve_worst(m, &s, floor);
  }
  free(still);
  quad__stars_free(&s);
}
