// tri.c - storage of a triangulation: slots, vertices, hints, compaction
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "tri/tri_int.h"

#include <math.h>

void tri_init(Tri *m)
{
  memset(m, 0, sizeof *m);
  m->free_list = NONE;
  m->last = NONE;
  m->dim = 255;
}

void tri_free(Tri *m)
{
  free(m->xy);
  free(m->vert);
  free(m->twin);
  free(m->flag);
  free(m->seg);
  free(m->region);
  free(m->hint);
  tri_init(m);
}

static void *copied(const void *data, size_t bytes)
{
  if (!data) return NULL;
  void *p = mem_alloc(bytes ? bytes : 1);
  memcpy(p, data, bytes);
  return p;
}

void tri_copy(Tri *to, const Tri *from)
{
  size_t nv = from->nv, nt = from->nt;
  *to = *from;
  to->cap_v = from->nv, to->cap_t = from->nt;
  to->xy = copied(from->xy, 2 * nv * sizeof *to->xy);
  to->vert = copied(from->vert, 3 * nt * sizeof *to->vert);
  to->twin = copied(from->twin, 3 * nt * sizeof *to->twin);
  to->flag = copied(from->flag, nt * sizeof *to->flag);
  to->seg = copied(from->seg, 3 * nt * sizeof *to->seg);
  to->region = copied(from->region, nt * sizeof *to->region);
  to->hint = copied(from->hint, nv * sizeof *to->hint);
  to->count = (PredCount){0};
  to->walks = to->walk_steps = to->cavity_triangles = 0;
}

static void resize(void *data, size_t old, size_t n, size_t size)
{
  void *p;
  memcpy(&p, data, sizeof p);
#ifdef STRESS
  void *q = mem_alloc(n * size); // arrays move on every growth
  if (p) memcpy(q, p, MIN(old, n) * size);
  free(p);
#else
  bool anew = old < n / 2; // so much larger that copying is little, and a block of its own better
  void *q = p && !anew ? mem_realloc(p, n * size) : mem_alloc_large(n * size);
  if (p && anew) {
    memcpy(q, p, old * size);
    free(p);
  }
#endif
  memcpy(data, &q, sizeof q);
}

static void resize_triangles(Tri *m, size_t n)
{
  CHECK(n <= UINT32_MAX / 3 - 1);
  resize(&m->vert, 3 * (size_t)m->cap_t, 3 * n, sizeof *m->vert);
  resize(&m->twin, 3 * (size_t)m->cap_t, 3 * n, sizeof *m->twin);
  resize(&m->flag, m->cap_t, n, sizeof *m->flag);
  if (m->seg) resize(&m->seg, 3 * (size_t)m->cap_t, 3 * n, sizeof *m->seg);
  if (m->region) resize(&m->region, m->cap_t, n, sizeof *m->region);
  m->cap_t = (uint32_t)n;
}

static void resize_vertices(Tri *m, size_t n)
{
  CHECK(n <= (size_t)TRI_MAX_VERTICES + 1);
  resize(&m->xy, 2 * (size_t)m->cap_v, 2 * n, sizeof *m->xy);
  if (m->hint) resize(&m->hint, m->cap_v, n, sizeof *m->hint);
  m->cap_v = (uint32_t)n;
}

void tri_reserve(Tri *m, size_t nv, size_t nt)
{
  if (nv > m->cap_v) resize_vertices(m, nv);
  if (nt > m->cap_t) resize_triangles(m, nt);
}

// The next capacity when an array of n is full.
static size_t grown(size_t n, size_t limit)
{
#ifdef STRESS
  return MIN(n + 1 + n / 256, limit);
#else
  return MIN(n + n / 2 + 16, limit);
#endif
}

TriId tri__new(Tri *m)
{
  TriId t = m->free_list;
  if (t != NONE) {
    m->free_list = m->twin[3 * (size_t)t];
    m->nfree--;
  } else {
    if (m->nt == m->cap_t) resize_triangles(m, MAX(grown(m->nt, UINT32_MAX / 3 - 1), (size_t)m->nt + 1));
    t = m->nt++;
  }
  m->flag[t] = 0;
  if (m->region) m->region[t] = 0;
  return t;
}

void tri__release(Tri *m, TriId t)
{
  m->flag[t] = TRI_FREE;
  m->vert[3 * (size_t)t] = m->vert[3 * (size_t)t + 1] = m->vert[3 * (size_t)t + 2] = TRI_INF;
  m->twin[3 * (size_t)t] = m->free_list;
  m->free_list = t;
  m->nfree++;
}

VertId tri__new_vertex(Tri *m, const double p[2])
{
  double x = p[0], y = p[1]; // p may lie in m->xy
  if (m->nv == m->cap_v) resize_vertices(m, MAX(grown(m->nv, (size_t)TRI_MAX_VERTICES + 1), (size_t)m->nv + 1));
  VertId v = m->nv++;
  m->xy[2 * (size_t)v] = x;
  m->xy[2 * (size_t)v + 1] = y;
  if (m->hint) m->hint[v] = NONE;
  return v;
}

void tri__make_segments(Tri *m)
{
  if (!m->seg) m->seg = mem_alloc_large(3 * (size_t)m->cap_t * sizeof *m->seg);
}

void tri__make_regions(Tri *m)
{
  if (!m->region) m->region = mem_zalloc(m->cap_t * sizeof *m->region);
}

void tri_make_hints(Tri *m)
{
  if (m->hint) return;
  m->hint = mem_alloc_large(m->cap_v * sizeof *m->hint);
  for (VertId v = 0; v < m->nv; v++) m->hint[v] = NONE;
  for (EdgeId e = 3 * m->nt; e-- > 0;)
    if (m->vert[e] != TRI_INF && !tri_is_free(m, tri_of(e))) m->hint[m->vert[e]] = e;
}

EdgeId tri_edge_at(const Tri *m, VertId v)
{
  if (m->hint) return m->hint[v];
  for (EdgeId e = 0; e < 3 * m->nt; e++)
    if (m->vert[e] == v && !tri_is_free(m, tri_of(e))) return e;
  return NONE;
}

EdgeId tri_find_edge(const Tri *m, VertId a, VertId b)
{
  EdgeId first = tri_edge_at(m, a), e = first;
  if (e == NONE) return NONE;
  do {
    if (tri_dest(m, e) == b) return e;
    e = tri_ccw(m, e);
  } while (e != first);
  return NONE;
}

static bool dropped(const Tri *m, TriId t, bool drop_outside)
{
  return tri_is_free(m, t) || (drop_outside && !tri_is_inside(m, t));
}

double tri_wedge(const Tri *m, EdgeId *e)
{
  double angle = 0;
  do {
    if (tri_is_inside(m, tri_of(*e))) {
      const double *o = tri_xy(m, tri_org(m, *e)), *a = tri_xy(m, tri_dest(m, *e)), *b = tri_xy(m, tri_apex(m, *e));
      double x = a[0] - o[0], y = a[1] - o[1], u = b[0] - o[0], w = b[1] - o[1];
      angle += atan2(x * w - y * u, x * u + y * w);
    } else {
      angle = INFINITY;
    }
    *e = tri_ccw(m, *e);
  } while (!tri_is_segment(m, *e));
  return angle;
}

void tri_compact(Tri *m, bool drop_outside)
{
  uint32_t *to = mem_alloc(m->nt * sizeof *to), n = 0;
  for (TriId t = 0; t < m->nt; t++) to[t] = dropped(m, t, drop_outside) ? NONE : n++;
  for (TriId t = 0; t < m->nt; t++) {
    TriId u = to[t];
    if (u == NONE) continue;
    for (size_t i = 0; i < 3; i++) {
      size_t from = 3 * (size_t)t + i, dest = 3 * (size_t)u + i;
      EdgeId g = m->twin[from];
      m->vert[dest] = m->vert[from];
      m->twin[dest] = g == NONE || to[g / 3] == NONE ? NONE : 3 * to[g / 3] + g % 3;
      if (m->seg) m->seg[dest] = m->seg[from];
    }
    m->flag[u] = m->flag[t];
    if (m->region) m->region[u] = m->region[t];
  }
  free(to);
  m->nt = n;
  m->free_list = NONE;
  m->nfree = 0;
  m->last = n ? 0 : NONE;
  if (m->hint) {
    free(m->hint);
    m->hint = NULL;
    tri_make_hints(m);
  }
}

size_t tri_bytes(const Tri *m)
{
  size_t t = 3 * sizeof *m->vert + 3 * sizeof *m->twin + sizeof *m->flag;
  if (m->seg) t += 3 * sizeof *m->seg;
  if (m->region) t += sizeof *m->region;
  return m->cap_t * t + m->cap_v * (2 * sizeof *m->xy + (m->hint ? sizeof *m->hint : 0));
}
