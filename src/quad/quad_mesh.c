// quad_mesh.c - plane meshes of triangles and quadrangles: making them, neighbours, compaction
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

static void fix_edge(QuadMesh *m, uint32_t a, uint32_t b) { m->fixed.data[a] = m->fixed.data[b] = 1; }

void quad_mesh_init(QuadMesh *m, const double *xy, const uint8_t *fixed, size_t nv, const uint32_t *tri, size_t ntri,
                    const uint32_t *locked, size_t nlocked)
{
  *m = (QuadMesh){0};
  vec_resize(&m->xy, nv);
  vec_resize(&m->fixed, nv);
  vec_resize(&m->from, nv);
  vec_resize(&m->parent, 2 * nv);
  vec_resize(&m->vertex, 4 * ntri);
  for (size_t v = 0; v < nv; v++) {
    m->xy.data[v] = (Vec2){xy[2 * v], xy[2 * v + 1]};
    m->fixed.data[v] = fixed && fixed[v];
    m->from.data[v] = (uint32_t)v;
    m->parent.data[2 * v] = m->parent.data[2 * v + 1] = NONE;
  }
  for (size_t t = 0; t < ntri; t++) {
    for (int i = 0; i < 3; i++) m->vertex.data[4 * t + i] = tri[3 * t + i];
    m->vertex.data[4 * t + 3] = NONE;
  }
  for (size_t k = 0; k < nlocked; k++) {
    vec_push(&m->locked, locked[2 * k]);
    vec_push(&m->locked, locked[2 * k + 1]);
    fix_edge(m, locked[2 * k], locked[2 * k + 1]);
  }
  uint32_t *twin = quad_mesh_twins(m);
  for (size_t t = 0; t < ntri; t++)
    for (uint32_t i = 0; i < 3; i++)
      if (twin[4 * t + i] == NONE) fix_edge(m, tri[3 * t + i], tri[3 * t + (i + 1) % 3]);
  free(twin);
}

void quad_mesh_free(QuadMesh *m)
{
  vec_free(&m->xy);
  vec_free(&m->size);
  vec_free(&m->fixed);
  vec_free(&m->from);
  vec_free(&m->parent);
  vec_free(&m->vertex);
  vec_free(&m->locked);
}

// Slopes are the means of those of the triangles around, weighted by area.
void quad_mesh_set_sizes(QuadMesh *m, const double *h)
{
  size_t nv = m->xy.len;
  double *area = mem_zalloc((nv + 1) * sizeof *area);
  vec_resize(&m->size, nv);
  for (size_t v = 0; v < nv; v++) m->size.data[v] = (QuadSize){.at = m->xy.data[v], .h = isfinite(h[v]) && h[v] > 0 ? h[v] : 0};
  for (size_t e = 0; e < m->vertex.len; e += 4) {
    const uint32_t *v = &m->vertex.data[e];
    Vec2 p = m->xy.data[v[0]], a = vec2_sub(m->xy.data[v[1]], p), b = vec2_sub(m->xy.data[v[2]], p);
    double x = h[v[1]] - h[v[0]], y = h[v[2]] - h[v[0]];
    Vec2 turned = {x * b.y - y * a.y, y * a.x - x * b.x}; // the slope, times twice the area
    for (int i = 0; i < 3 && isfinite(turned.x) && isfinite(turned.y); i++) {
      m->size.data[v[i]].slope = vec2_add(m->size.data[v[i]].slope, turned);
      area[v[i]] += vec2_cross(a, b);
    }
  }
  for (size_t v = 0; v < nv; v++) m->size.data[v].slope = vec2_scale(area[v] > 0 ? 1 / area[v] : 0, m->size.data[v].slope);
  free(area);
}

double quad_mesh_size(const QuadMesh *m, uint32_t v, Vec2 p)
{
  return m->size.len && m->size.data[v].h > 0 ? quad__size_at(&m->size.data[v], p) : NAN;
}

uint32_t quad__add_vertex(QuadMesh *m, Vec2 p, const uint32_t *around, uint32_t n)
{
  QuadSize mean = {.at = p};
  for (uint32_t i = 0; i < n && m->size.len; i++) {
    const QuadSize *s = &m->size.data[around[i]];
    mean.h += quad__size_at(s, p) / n;
    mean.slope = vec2_add(mean.slope, vec2_scale(1.0 / n, s->slope));
  }
  if (m->size.len) vec_push(&m->size, mean);
  vec_push(&m->xy, p);
  vec_push(&m->fixed, 0);
  vec_push(&m->from, NONE);
  vec_push(&m->parent, NONE);
  vec_push(&m->parent, NONE);
  return (uint32_t)m->xy.len - 1;
}

size_t quad_mesh_triangles(const QuadMesh *m)
{
  size_t n = 0;
  for (size_t e = 0; e < quad_mesh_elements(m); e++) n += !quad_mesh_is_quad(m, e);
  return n;
}

// Join the sides start[v] .. start[v+1] of `list`, all with v as their smaller end, to pairs.
static void join_sides(const QuadMesh *m, const uint32_t *list, uint32_t n, uint32_t *twin)
{
  for (uint32_t i = 0; i < n; i++) {
    uint32_t s = list[i], e = s / 4, c = quad_mesh_corners(m, e);
    uint32_t a = m->vertex.data[s], b = m->vertex.data[4 * e + (s % 4 + 1) % c], found = NONE, count = 0;
    for (uint32_t j = 0; j < n; j++) {
      uint32_t t = list[j], f = t / 4, d = quad_mesh_corners(m, f);
      uint32_t p = m->vertex.data[t], q = m->vertex.data[4 * f + (t % 4 + 1) % d];
      if (j != i && ((p == b && q == a) || (p == a && q == b))) {
        count++;
        if (p == b) found = t;
      }
    }
    twin[s] = count == 1 ? found : NONE;
  }
}

uint32_t *quad_mesh_twins(const QuadMesh *m)
{
  size_t ne = quad_mesh_elements(m), nv = m->xy.len;
  uint32_t *twin = mem_alloc((4 * ne + 1) * sizeof *twin), *start = mem_zalloc((nv + 2) * sizeof *start);
  uint32_t *list = mem_alloc((4 * ne + 1) * sizeof *list);
  for (int pass = 0; pass < 2; pass++) {
    for (uint32_t s = 0; s < 4 * ne; s++) {
      uint32_t e = s / 4, c = quad_mesh_corners(m, e);
      if (pass == 0) twin[s] = NONE;
      if (s % 4 >= c || m->vertex.data[4 * (size_t)e] == NONE) continue;
      uint32_t least = MIN(m->vertex.data[s], m->vertex.data[4 * e + (s % 4 + 1) % c]);
      if (pass == 0) start[least + 2]++;
      else list[start[least + 1]++] = s;
    }
    if (pass == 0)
      for (size_t v = 0; v < nv; v++) start[v + 2] += start[v + 1];
  }
  for (size_t v = 0; v < nv; v++) join_sides(m, list + start[v], start[v + 1] - start[v], twin);
  free(start);
  free(list);
  return twin;
}

void quad_mesh_compact(QuadMesh *m)
{
  size_t nv = m->xy.len, out = 0, kept = 0;
  uint32_t *number = mem_alloc((nv + 1) * sizeof *number);
  for (size_t v = 0; v < nv; v++) number[v] = m->fixed.data[v] ? 0 : NONE;
  for (size_t e = 0; e < quad_mesh_elements(m); e++) {
    if (m->vertex.data[4 * e] == NONE) continue;
    for (int i = 0; i < 4; i++) {
      uint32_t v = m->vertex.data[4 * kept + i] = m->vertex.data[4 * e + i];
      if (v != NONE) number[v] = 0;
    }
    kept++;
  }
  vec_resize(&m->vertex, 4 * kept);
  for (size_t v = 0; v < nv; v++) {
    if (number[v] == NONE) continue;
    m->xy.data[out] = m->xy.data[v];
    if (m->size.len) m->size.data[out] = m->size.data[v];
    m->fixed.data[out] = m->fixed.data[v];
    m->from.data[out] = m->from.data[v];
    m->parent.data[2 * out] = m->parent.data[2 * v];
    m->parent.data[2 * out + 1] = m->parent.data[2 * v + 1];
    number[v] = (uint32_t)out++;
  }
  vec_resize(&m->xy, out);
  if (m->size.len) vec_resize(&m->size, out);
  vec_resize(&m->fixed, out);
  vec_resize(&m->from, out);
  vec_resize(&m->parent, 2 * out);
  for (size_t i = 0; i < m->vertex.len; i++)
    if (m->vertex.data[i] != NONE) m->vertex.data[i] = number[m->vertex.data[i]];
  for (size_t i = 0; i < m->locked.len; i++) m->locked.data[i] = number[m->locked.data[i]];
  free(number);
}

uint8_t *quad__locked_sides(const QuadMesh *m, const uint32_t *twin)
{
  size_t ne = quad_mesh_elements(m);
  uint8_t *locked = mem_zalloc(4 * ne + 1);
  Map map = {0};
  for (size_t k = 0; k + 1 < m->locked.len; k += 2) map_set(&map, map_pair(m->locked.data[k], m->locked.data[k + 1]), 1);
  for (size_t s = 0; s < 4 * ne; s++) {
    size_t e = s / 4;
    if (s % 4 >= quad_mesh_corners(m, e)) continue;
    uint32_t a = m->vertex.data[s], b = m->vertex.data[4 * e + (s % 4 + 1) % quad_mesh_corners(m, e)];
    locked[s] = twin[s] == NONE || (map.len && map_get(&map, map_pair(a, b)) != NONE);
  }
  map_free(&map);
  return locked;
}
