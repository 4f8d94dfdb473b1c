// coherence_point.c - merging points in one place, which are found by the cells of a grid
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/coherence_int.h"

static int64_t cell_index(const Model *m, double x)
{
  if (m->cell_size > 0) return (int64_t)floor(fmax(-9e18, fmin(9e18, x / m->cell_size)));
  x += 0.0; // -0 and 0 are one place
  int64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}

static uint64_t cell_hash(int64_t i, int64_t j, int64_t k)
{
  return hash__mix(hash__mix(hash__mix(0, (uint64_t)i), (uint64_t)j), (uint64_t)k);
}

static uint64_t cell_of(const Model *m, Vec3 p)
{
  return cell_hash(cell_index(m, p.x), cell_index(m, p.y), cell_index(m, p.z));
}

static uint32_t point_slot(const Model *m, int tag) { return table__find(&m->point, tag); }

void model__point_moves(Model *m, Point *p, Vec3 to)
{
  if (m->cell_on) {
    uint32_t s = point_slot(m, p->tag);
    chains__unlink(&m->cell, cell_of(m, p->xyz), s);
    chains__link(&m->cell, cell_of(m, to), s);
  }
  p->xyz = to;
  m->extent = box3_with(m->extent, to);
  vec_push(&m->dirty[0], p->tag);
}

void model__forget_point(Model *m, Point *p)
{
  if (m->cell_on) chains__unlink(&m->cell, cell_of(m, p->xyz), point_slot(m, p->tag));
}

// The point of the lowest tag, other than p, within tol of p in each coordinate; NULL if there is none.
static Point *coincident(const Model *m, const Point *p, double tol)
{
  int64_t lo[3], hi[3];
  double x[3] = {p->xyz.x, p->xyz.y, p->xyz.z};
  for (int d = 0; d < 3; d++) {
    lo[d] = cell_index(m, x[d] - tol);
    hi[d] = cell_index(m, x[d] + tol);
    if (m->cell_size <= 0) hi[d] = lo[d];
  }
  Point *best = NULL;
  for (int64_t i = lo[0]; i <= hi[0]; i++)
    for (int64_t j = lo[1]; j <= hi[1]; j++)
      for (int64_t k = lo[2]; k <= hi[2]; k++) {
        uint32_t s = map_get(&m->cell.head, cell_hash(i, j, k) & ~(uint64_t)1);
        for (; s != NONE; s = m->cell.next.data[s]) {
          Point *q = table__slot(&m->point, s);
          if (q == p || fabs(q->xyz.x - x[0]) > tol || fabs(q->xyz.y - x[1]) > tol || fabs(q->xyz.z - x[2]) > tol) continue;
          if (!best || q->tag < best->tag) best = q;
        }
      }
  return best;
}

// (Re)build the grid when there is none or the model outgrew it, else add the new points.
static double prepare_cells(Model *m)
{
  double diagonal = m->point.live ? vec3_distance(m->extent.lo, m->extent.hi) : 0;
  double tol = m->set.tolerance * diagonal;
  if (m->cell_on && diagonal <= 2 * m->cell_diagonal && tol <= m->cell_size / 2) {
    for (size_t i = 0; i < m->dirty[0].len; i++) {
      const Point *p = point__get(m, m->dirty[0].data[i]);
      uint32_t s = p ? point_slot(m, p->tag) : NONE;
      if (!p) continue;
      chains__unlink(&m->cell, cell_of(m, p->xyz), s);
      chains__link(&m->cell, cell_of(m, p->xyz), s);
    }
    return tol;
  }
  chains__clear(&m->cell);
  m->cell_on = true;
  m->cell_diagonal = diagonal;
  m->cell_size = 8 * tol;
  map_reserve(&m->cell.head, m->point.live);
  vec_clear(&m->dirty[0]);
  table__sort(&m->point);
  for (size_t i = 0; i < m->point.live; i++) {
    const Point *p = table__at(&m->point, i);
    chains__link(&m->cell, cell_of(m, p->xyz), m->point.order.data[i]);
    vec_push(&m->dirty[0], p->tag);
  }
  return tol;
}

static void find_equal_points(Model *m, Merged *g)
{
  double tol = prepare_cells(m);
  coherence__sort_unique(&m->dirty[0]);
  for (size_t i = 0; i < m->dirty[0].len; i++) {
    Point *p = point__get(m, m->dirty[0].data[i]);
    if (!p || merged__tag(g, 0, p->tag) != p->tag) continue;
    for (Point *q = coincident(m, p, tol); q; q = coincident(m, p, tol)) {
      Point *gone = q->tag < p->tag ? p : q, *stays = gone == p ? q : p;
      model__forget_point(m, gone);
      coherence__record(g, 0, gone->tag, stays->tag);
      if (gone == p) break;
    }
  }
}

static bool curve_follows(Model *m, Curve *c, const Merged *g)
{
  bool change = merged__tag(g, 0, c->begin) != c->begin || merged__tag(g, 0, c->end) != c->end;
  for (int i = 0; i < c->npoint && !change; i++) change = merged__tag(g, 0, c->point[i]) != c->point[i];
  if (!change) return false;
  model__forget_curve(m, c);
  int *ref[2] = {&c->begin, &c->end};
  for (int i = 0; i < c->npoint + 2; i++) {
    int *tag = i < c->npoint ? &c->point[i] : ref[i - c->npoint];
    point__get(m, *tag)->uses--;
    *tag = merged__tag(g, 0, *tag);
    point__get(m, *tag)->uses++;
  }
  if (c->extruded_point) c->extruded_point = merged__tag(g, 0, c->extruded_point);
  return true;
}

static void point_lists_follow(Model *m, const Merged *g)
{
  coherence__groups_follow(m, 0, g);
  if (!m->ncorners && !m->nembedded) return;
  for (uint32_t s = 0; s < m->face.used; s++) {
    Face *f = table__slot(&m->face, s);
    if (f->tag == DEAD_TAG) continue;
    coherence__replace(g, 0, f->corner, (size_t)f->ncorner);
    coherence__replace(g, 0, f->embedded_points.data, f->embedded_points.len);
  }
}

void coherence__points(Model *m, Merged *g)
{
  find_equal_points(m, g);
  if (!g->gone[0].len) {
    vec_clear(&m->dirty[0]);
    return;
  }
  coherence__sort_unique(&m->dirty[1]);
  for (size_t i = 0; i < m->dirty[1].len; i++) {
    Curve *c = table__get(&m->curve, m->dirty[1].data[i]);
    if (c) curve_follows(m, c, g);
  }
  // What was merged is nearly always new, and so are the curves on it: look further only if a use is left.
  uint64_t uses = 0;
  for (size_t i = 0; i < g->gone[0].len; i++) uses += point__get(m, g->gone[0].data[i])->uses;
  for (uint32_t s = 0; uses > 0 && s < m->curve.used; s++) {
    Curve *c = table__slot(&m->curve, s);
    if (c->tag != DEAD_TAG && curve_follows(m, c, g)) vec_push(&m->dirty[1], c->tag);
  }
  point_lists_follow(m, g);
  for (size_t i = 0; i < g->gone[0].len; i++) table__remove(&m->point, g->gone[0].data[i]);
  coherence__recount(m, KIND_POINT);
  vec_clear(&m->dirty[0]);
}
