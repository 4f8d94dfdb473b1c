// quad_patch.c - changing a quad mesh in a few elements at a time, with a judgement on each change
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/quad_patch.h"

// In energy: what a vertex with one element too many or too few costs; what an element is worth, as without that fewer elements would
// always seem better; and what a change must gain to be made.
static const double PI = 3.14159265358979323846, VALENCE = 0.1, ELEMENT = 0.33, GAIN = 0.01;
// Changes that cost so much before vertices look for better places, and after they did so once, are given up; and those that lack more
// than the last search for places has gained.
static const double HOPELESS = 0.8, DOUBTFUL = 0.3;
enum { SPARE_ROOM = 4, LEAST_ROOM = 8, SWEEPS = 4 };

static const QuadSize *sizes(const QuadMesh *m) { return m->size.len ? m->size.data : NULL; }

// ---- the mesh under change

static void make_room(QuadEdit *d, uint32_t room)
{
  vec_push(&d->start, (uint32_t)d->pool.len);
  vec_push(&d->count, 0);
  vec_push(&d->room, (uint8_t)room);
  vec_resize(&d->pool, d->pool.len + room);
}

// Regular valence of boundary vertices: the angle inside in right angles, at least 1.
static void ideal_valences(QuadEdit *d)
{
  const QuadMesh *m = d->m;
  double *angle = mem_zalloc((m->xy.len + 1) * sizeof *angle);
  uint32_t *twin = quad_mesh_twins(m);
  for (size_t s = 0; s < m->vertex.len; s++) {
    size_t e = s / 4, n = quad_mesh_corners(m, e), k = s % 4;
    if (k < n && twin[s] == NONE) d->boundary.data[m->vertex.data[s]] = d->boundary.data[m->vertex.data[4 * e + (k + 1) % n]] = 1;
  }
  for (size_t s = 0; s < m->vertex.len; s++) {
    size_t e = s / 4, n = quad_mesh_corners(m, e), k = s % 4;
    const uint32_t *v = &m->vertex.data[4 * e];
    if (k >= n || !d->boundary.data[v[k]]) continue;
    Vec2 at = m->xy.data[v[k]], u = vec2_sub(m->xy.data[v[(k + 1) % n]], at), w = vec2_sub(m->xy.data[v[(k + n - 1) % n]], at);
    angle[v[k]] += fabs(atan2(vec2_cross(u, w), vec2_dot(u, w)));
  }
  for (size_t v = 0; v < m->xy.len; v++) d->ideal.data[v] = d->boundary.data[v] ? (uint8_t)MAX(1, lround(angle[v] / (PI / 2))) : 4;
  free(angle);
  free(twin);
}

void quad__edit_begin(QuadEdit *d, QuadMesh *m)
{
  size_t nv = m->xy.len;
  *d = (QuadEdit){.m = m, .floor = quad__floor(m)};
  QuadStars s = quad__stars(m);
  for (size_t v = 0; v < nv; v++) {
    uint32_t n = MIN(s.start[v + 1] - s.start[v], 250u); // more cannot be changed
    make_room(d, MAX(n + SPARE_ROOM, LEAST_ROOM));
    for (uint32_t i = 0; i < n; i++) d->pool.data[d->start.data[v] + i] = s.at[s.start[v] + i];
    d->count.data[v] = (uint8_t)n;
    vec_push(&d->boundary, 0);
    vec_push(&d->ideal, 4);
    vec_push(&d->queued, 0);
  }
  quad__stars_free(&s);
  ideal_valences(d);
  for (size_t k = 0; k + 1 < m->locked.len; k += 2) map_set(&d->locked, map_pair(m->locked.data[k], m->locked.data[k + 1]), 1);
}

void quad__edit_end(QuadEdit *d)
{
  vec_free(&d->start);
  vec_free(&d->pool);
  vec_free(&d->count);
  vec_free(&d->room);
  vec_free(&d->boundary);
  vec_free(&d->ideal);
  vec_free(&d->dead);
  vec_free(&d->queue);
  vec_free(&d->queued);
  map_free(&d->locked);
  quad_mesh_compact(d->m);
}

uint32_t quad__edit_add_vertex(QuadEdit *d, Vec2 p, const uint32_t *around, uint32_t n)
{
  uint32_t v = quad__add_vertex(d->m, p, around, n);
  make_room(d, LEAST_ROOM);
  vec_push(&d->boundary, 0);
  vec_push(&d->ideal, 4);
  vec_push(&d->queued, 0);
  return v;
}

void quad__edit_drop_vertex(QuadEdit *d)
{
  QuadMesh *m = d->m;
  d->pool.len = vec_pop(&d->start);
  d->count.len--, d->room.len--, d->boundary.len--, d->ideal.len--, d->queued.len--;
  m->xy.len--, m->fixed.len--, m->from.len--, m->parent.len -= 2;
  if (m->size.len) m->size.len--;
}

uint32_t quad__edit_add_element(QuadEdit *d)
{
  if (d->dead.len) return vec_pop(&d->dead);
  for (int i = 0; i < 4; i++) vec_push(&d->m->vertex, NONE);
  return (uint32_t)(d->m->vertex.len / 4 - 1);
}

void quad__enqueue(QuadEdit *d, uint32_t v)
{
  if (d->queued.data[v]) return;
  d->queued.data[v] = 1;
  vec_push(&d->queue, v);
}

uint32_t quad__across(const QuadEdit *d, uint32_t e, uint32_t a, uint32_t b)
{
  const uint32_t *at = quad__around(d, a);
  for (uint32_t i = 0; i < quad__count(d, a); i++) {
    const uint32_t *v = &d->m->vertex.data[4 * (size_t)at[i]];
    uint32_t n = v[3] == NONE ? 3 : 4;
    for (uint32_t j = 0; j < n && at[i] != e; j++) {
      uint32_t w = v[(j + 1) % n];
      if ((v[j] == a && w == b) || (v[j] == b && w == a)) return at[i];
    }
  }
  return NONE;
}

bool quad__is_locked(const QuadEdit *d, uint32_t a, uint32_t b)
{
  return d->locked.len && map_get(&d->locked, map_pair(a, b)) != NONE;
}

bool quad__joined(const QuadEdit *d, uint32_t x, uint32_t y) { return quad__across(d, NONE, x, y) != NONE; }

// ---- patches

bool quad__patch_begin(const QuadEdit *d, QuadPatch *p, const uint32_t *core, size_t ncore)
{
  const QuadMesh *m = d->m;
  p->n = 0;
  p->ncore = ncore;
  p->gain = 0;
  for (size_t i = 0; i < ncore; i++) {
    p->core[i] = core[i];
    p->old[i] = m->xy.data[core[i]];
    for (uint32_t k = 0; k < quad__count(d, core[i]); k++) {
      uint32_t e = quad__around(d, core[i])[k];
      size_t j = 0;
      while (j < p->n && p->element[j] != e) j++;
      if (j < p->n) continue;
      if (p->n == PATCH_ELEMENTS) return false;
      for (size_t q = 0; q < 4; q++) p->corner[4 * p->n + q] = m->vertex.data[4 * (size_t)e + q];
      p->element[p->n++] = e;
    }
  }
  p->before = quad__score(m->xy.data, sizes(m), p->corner, p->n);
  return true;
}

uint32_t *quad__patch_element(QuadPatch *p, uint32_t e)
{
  for (size_t i = 0; i < p->n; i++)
    if (p->element[i] == e) return &p->corner[4 * i];
  return NULL;
}

void quad__patch_replace(QuadPatch *p, uint32_t from, uint32_t to)
{
  for (size_t i = 0; i < 4 * p->n; i++)
    if (p->corner[i] == from) p->corner[i] = to;
}

// The elements of the patch that hold v.
static size_t patch_star(const QuadPatch *p, uint32_t v, uint32_t *corner)
{
  size_t n = 0;
  for (size_t i = 0; i < p->n; i++) {
    const uint32_t *c = &p->corner[4 * i];
    if (c[0] == NONE || (c[0] != v && c[1] != v && c[2] != v && c[3] != v)) continue;
    for (int k = 0; k < 4; k++) corner[4 * n + (size_t)k] = c[k];
    n++;
  }
  return n;
}

static bool patch_valid(const QuadPatch *p, const Vec2 *xy)
{
  for (size_t i = 0; i < p->n; i++)
    if (p->corner[4 * i] != NONE && !quad__convex(xy, &p->corner[4 * i])) return false;
  return true;
}

// Count one element more (by 1) or less (by -1) at its corners. False if a vertex has no room for so many.
static bool count_element(QuadEdit *d, const uint32_t *corner, int by)
{
  bool room = true;
  for (int k = 0; k < 4 && corner[0] != NONE; k++) {
    if (corner[k] == NONE) continue;
    d->count.data[corner[k]] = (uint8_t)(d->count.data[corner[k]] + by);
    room &= d->count.data[corner[k]] <= d->room.data[corner[k]];
  }
  return room;
}

bool quad__has_room(QuadEdit *d, const uint32_t *element, const uint32_t *corner, size_t n)
{
  bool room = true;
  for (size_t i = 0; i < n; i++) count_element(d, &d->m->vertex.data[4 * (size_t)element[i]], -1);
  for (size_t i = 0; i < n; i++) room &= count_element(d, corner + 4 * i, 1);
  for (size_t i = 0; i < n; i++) count_element(d, corner + 4 * i, -1);
  for (size_t i = 0; i < n; i++) count_element(d, &d->m->vertex.data[4 * (size_t)element[i]], 1);
  return room;
}

// Once over the core. True if any vertex moved.
static bool find_places(QuadEdit *d, const QuadPatch *p, int steps)
{
  QuadMesh *m = d->m;
  uint32_t corner[4 * PATCH_ELEMENTS];
  bool moved = false;
  for (size_t i = 0; i < p->ncore; i++) {
    if (m->fixed.data[p->core[i]]) continue;
    size_t n = patch_star(p, p->core[i], corner);
    if (n) moved |= quad__improve(m->xy.data, sizes(m), p->core[i], corner, n, steps, d->floor);
  }
  return moved;
}

static void take_out(QuadEdit *d, uint32_t v, uint32_t e)
{
  uint32_t *at = d->pool.data + d->start.data[v], n = d->count.data[v], i = 0;
  while (at[i] != e) i++;
  for (; i + 1 < n; i++) at[i] = at[i + 1];
  d->count.data[v]--;
}

void quad__replace(QuadEdit *d, const uint32_t *element, const uint32_t *corner, size_t n)
{
  for (size_t i = 0; i < n; i++) {
    const uint32_t *v = &d->m->vertex.data[4 * (size_t)element[i]];
    for (int k = 0; k < 4; k++)
      if (v[0] != NONE && v[k] != NONE) take_out(d, v[k], element[i]), quad__enqueue(d, v[k]);
  }
  for (size_t i = 0; i < n; i++) {
    uint32_t *v = &d->m->vertex.data[4 * (size_t)element[i]];
    bool lived = v[0] != NONE;
    for (size_t k = 0; k < 4; k++) v[k] = corner[4 * i + k];
    if (v[0] == NONE && lived) vec_push(&d->dead, element[i]);
    for (int k = 0; k < 4; k++) {
      if (v[0] == NONE || v[k] == NONE) continue;
      d->pool.data[d->start.data[v[k]] + d->count.data[v[k]]++] = element[i];
      quad__enqueue(d, v[k]);
    }
  }
}

// The score of all elements, or of some that alone have more energy than `most`.
static QuadScore patch_score(const QuadPatch *p, const QuadMesh *m, double most)
{
  QuadScore s = {0, 0};
  for (size_t i = 0; i < p->n && s.energy <= most; i++) {
    if (p->corner[4 * i] == NONE) continue;
    QuadScore one = quad__score(m->xy.data, sizes(m), &p->corner[4 * i], 1);
    s.worst = fmax(s.worst, one.worst);
    s.energy += one.energy;
  }
  return s;
}

bool quad__is_hopeless(const QuadEdit *d, const uint32_t *was, const uint32_t *is, size_t n, int gain)
{
  QuadScore a = quad__score(d->m->xy.data, sizes(d->m), was, n);
  if (a.worst > PATCH_BAD) return false;
  return quad__score(d->m->xy.data, sizes(d->m), is, n).energy > a.energy + VALENCE * gain + HOPELESS;
}

bool quad__patch_end(QuadEdit *d, QuadPatch *p)
{
  Vec2 *xy = d->m->xy.data;
  double limit = p->before.energy + VALENCE * p->gain;
  for (size_t i = 0; i < p->n; i++)
    limit -= ELEMENT * ((d->m->vertex.data[4 * (size_t)p->element[i]] != NONE) - (p->corner[4 * i] != NONE));
  const bool bad = p->before.worst > PATCH_BAD;
  bool keep = false, moved = true;
  double last = INFINITY;
  for (int sweep = 0; sweep <= SWEEPS && moved && !keep; sweep++) {
    QuadScore now = patch_score(p, d->m, bad ? INFINITY : limit + HOPELESS);
    bool better = now.worst <= fmax(p->before.worst, d->floor) && now.energy < limit - GAIN;
    keep = (better || (bad && now.worst < p->before.worst - GAIN)) && patch_valid(p, xy);
    if (!bad && now.energy > limit + (sweep ? fmin(DOUBTFUL, last - now.energy) : HOPELESS)) break;
    last = now.energy;
    moved = !keep && sweep < SWEEPS && find_places(d, p, sweep ? 2 : 1);
  }
  keep = keep && quad__has_room(d, p->element, p->corner, p->n);
  if (keep) quad__replace(d, p->element, p->corner, p->n);
  else
    for (size_t i = 0; i < p->ncore; i++) xy[p->core[i]] = p->old[i];
  return keep;
}
