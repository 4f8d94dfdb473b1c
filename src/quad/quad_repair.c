// quad_repair.c - bringing leftover triangles together
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

// Way from the triangle t over free sides to the nearest other triangle: elements in path, t first. False if there is none.
static bool nearest_triangle(const QuadMesh *m, const uint32_t *twin, const uint8_t *locked, uint32_t t, uint32_t *from,
                             U32Vec *queue, U32Vec *path)
{
  vec_clear(queue);
  vec_clear(path);
  vec_push(queue, t);
  from[t] = t;
  uint32_t found = NONE;
  for (size_t i = 0; i < queue->len && found == NONE; i++) {
    uint32_t e = queue->data[i];
    for (uint32_t k = 0; k < quad_mesh_corners(m, e) && found == NONE; k++) {
      uint32_t s = 4 * e + k, f = twin[s] == NONE || locked[s] ? NONE : twin[s] / 4;
      if (f == NONE || from[f] != NONE) continue;
      from[f] = e;
      vec_push(queue, f);
      if (!quad_mesh_is_quad(m, f)) found = f;
    }
  }
  for (uint32_t e = found; e != NONE && e != t; e = from[e]) vec_push(path, e);
  if (found != NONE) vec_push(path, t);
  for (size_t i = 0; i < queue->len; i++) from[queue->data[i]] = NONE;
  for (size_t i = 0, j = path->len; i + 1 < j; i++) {
    uint32_t x = path->data[i];
    path->data[i] = path->data[--j];
    path->data[j] = x;
  }
  return found != NONE;
}

// Side of e whose edge is also one of f, or NONE.
static uint32_t shared_side(const QuadMesh *m, uint32_t e, uint32_t f)
{
  uint32_t n = quad_mesh_corners(m, e), k = quad_mesh_corners(m, f);
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = 0; j < k; j++)
      if (m->vertex.data[4 * e + i] == m->vertex.data[4 * f + (j + 1) % k] &&
          m->vertex.data[4 * e + (i + 1) % n] == m->vertex.data[4 * f + j])
        return 4 * e + i;
  return NONE;
}

// The triangle t and the quad q share an edge: make of them a quad (at t) and a triangle (at q) that has the edge of q
// towards `next`. False if no valid way exists.
static bool step_triangle(QuadMesh *m, uint32_t t, uint32_t q, uint32_t next)
{
  uint32_t s = shared_side(m, t, q), w = shared_side(m, q, t), o = shared_side(m, q, next), p[5];
  if (s == NONE || o == NONE || o == w) return false;
  p[0] = m->vertex.data[4 * t + (s % 4 + 2) % 3];
  for (uint32_t i = 0; i < 4; i++) p[1 + i] = m->vertex.data[4 * q + (w % 4 + 1 + i) % 4];
  // Pentagon p[0 .. 4]; the way out is the edge p[j] p[j+1].
  uint32_t j = 1 + (o + 4 - (w + 1)) % 4, best = NONE;
  double score = 0;
  for (uint32_t ear = j; ear <= j + 1; ear++) {
    uint32_t tri[4] = {p[(ear + 4) % 5], p[ear % 5], p[(ear + 1) % 5], NONE};
    uint32_t quad[4] = {p[(ear + 1) % 5], p[(ear + 2) % 5], p[(ear + 3) % 5], p[(ear + 4) % 5]};
    double shape = fmin(quad__shape(m->xy.data, tri), quad__shape(m->xy.data, quad));
    if (shape > score && quad__convex(m->xy.data, tri) && quad__convex(m->xy.data, quad)) best = ear, score = shape;
  }
  if (best == NONE) return false;
  uint32_t tri[4] = {p[(best + 4) % 5], p[best % 5], p[(best + 1) % 5], NONE};
  for (uint32_t i = 0; i < 4; i++) {
    m->vertex.data[4 * t + i] = p[(best + 1 + i) % 5];
    m->vertex.data[4 * q + i] = tri[i];
  }
  return true;
}

static bool join_triangles(QuadMesh *m, uint32_t s, uint32_t t)
{
  uint32_t e = shared_side(m, s, t), f = shared_side(m, t, s), q[4];
  if (e == NONE || f == NONE) return false;
  quad__merged(m, e, f, q);
  if (!quad__convex(m->xy.data, q)) return false;
  for (uint32_t i = 0; i < 4; i++) m->vertex.data[4 * s + i] = q[i], m->vertex.data[4 * t + i] = NONE;
  return true;
}

void quad_repair(QuadMesh *m, QuadReport *report)
{
  U32Vec queue = {0}, path = {0};
  bool again = quad_mesh_triangles(m) >= 2;
  while (again) {
    size_t ne = quad_mesh_elements(m);
    uint32_t *twin = quad_mesh_twins(m), *from = mem_alloc((ne + 1) * sizeof *from);
    uint8_t *locked = quad__locked_sides(m, twin);
    for (size_t e = 0; e < ne; e++) from[e] = NONE;
    again = false;
    for (uint32_t t = 0; t < ne && !again; t++) {
      if (quad_mesh_is_quad(m, t) || !nearest_triangle(m, twin, locked, t, from, &queue, &path)) continue;
      bool good = true;
      size_t i = 0;
      while (good && i + 2 < path.len) {
        good = step_triangle(m, path.data[i], path.data[i + 1], path.data[i + 2]);
        i += good;
      }
      again = good && join_triangles(m, path.data[i], path.data[i + 1]);
      report->repaired += again;
      if (!again && i > 0) break; // the mesh has changed: look again from the beginning would not end; give up
    }
    free(twin);
    free(from);
    free(locked);
    if (again) quad_mesh_compact(m);
  }
  vec_free(&queue);
  vec_free(&path);
}
