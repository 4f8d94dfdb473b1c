// quad_clean.c - topological clean-up of quad meshes, and bringing leftover triangles together
// SPDX-License-Identifier: MIT
//
// Every operation rewrites the elements around a few vertices, lets those vertices find better places, and is taken back
// unless the worst element there is no worse than before (or at least as good as a floor that is no better than the worst of
// the mesh). What it aims at is that vertices have their regular valence: 4 inside, on the boundary what the angle calls for.
#include "base/base.h"
#include "geom/predicates.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

enum { MAX_PATCH = 64, MAX_CORE = 8 };
static const double PI = 3.14159265358979323846, BAD = 0.3, GAIN = 0.01, HOPE = 0;

// The elements around some vertices (the core), before and after.
typedef struct {
  uint32_t element[MAX_PATCH];
  uint32_t corner[4 * MAX_PATCH]; // as they are to be; NONE first: removed
  size_t n;
  uint32_t core[MAX_CORE];
  size_t ncore;
  Vec2 old[MAX_CORE];
  double before;
  double energy;                  // sum of (1 - shape)^2 before
  bool strict;                    // the worst element has to get better
  bool neutral;                   // valences gain nothing: the energy has to fall
} Patch;

typedef struct {
  QuadMesh *m;
  QuadStars stars;
  uint32_t *twin;
  uint8_t *locked;
  uint8_t *boundary; // by vertex
  int *ideal;        // by vertex: regular valence
  uint8_t *touched;  // by vertex: something around it changed in this round
  double floor;
} Clean;

static int valence(const Clean *c, uint32_t v) { return (int)(c->stars.start[v + 1] - c->stars.start[v]); }

// ---- patches

static bool patch_begin(const Clean *c, Patch *p, const uint32_t *core, size_t ncore)
{
  const QuadMesh *m = c->m;
  p->n = 0;
  p->ncore = ncore;
  p->before = 1;
  p->strict = p->neutral = false;
  p->energy = 0;
  for (size_t i = 0; i < ncore; i++) {
    uint32_t v = core[i];
    if (c->touched[v]) return false;
    p->core[i] = v;
    p->old[i] = m->xy.data[v];
    for (uint32_t k = c->stars.start[v]; k < c->stars.start[v + 1]; k++) {
      uint32_t e = c->stars.at[k];
      size_t j = 0;
      while (j < p->n && p->element[j] != e) j++;
      if (j < p->n) continue;
      if (p->n == MAX_PATCH) return false;
      p->element[p->n] = e;
      for (int q = 0; q < 4; q++) p->corner[4 * p->n + (size_t)q] = m->vertex.data[4 * (size_t)e + (size_t)q];
      double shape = quad__shape(m->xy.data, &p->corner[4 * p->n]);
      p->before = fmin(p->before, shape);
      p->energy += (1 - shape) * (1 - shape);
      p->n++;
    }
  }
  return true;
}

static uint32_t *patch_element(Patch *p, uint32_t e)
{
  for (size_t i = 0; i < p->n; i++)
    if (p->element[i] == e) return &p->corner[4 * i];
  return NULL;
}

static void patch_replace(Patch *p, uint32_t from, uint32_t to)
{
  for (size_t i = 0; i < 4 * p->n; i++)
    if (p->corner[i] == from) p->corner[i] = to;
}

// The elements of the patch that hold v.
static size_t patch_star(const Patch *p, uint32_t v, uint32_t *corner)
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

static QuadScore patch_score(const Patch *p, const Vec2 *xy)
{
  QuadScore s = {1, 0};
  for (size_t i = 0; i < p->n; i++) {
    if (p->corner[4 * i] == NONE) continue;
    QuadScore one = quad__score(xy, &p->corner[4 * i], 1);
    s.worst = fmin(s.worst, one.worst);
    s.energy += one.energy;
  }
  return s;
}

static bool patch_valid(const Patch *p, const Vec2 *xy)
{
  for (size_t i = 0; i < p->n; i++)
    if (p->corner[4 * i] != NONE && !quad__convex(xy, &p->corner[4 * i])) return false;
  return true;
}

// Let the core find better places, then keep the new elements or take everything back.
static bool patch_end(Clean *c, Patch *p)
{
  QuadMesh *m = c->m;
  uint32_t corner[4 * MAX_PATCH];
  double enough = fmin(p->before, c->floor);
  if (p->before >= c->floor) enough = c->floor;
  if (p->strict) enough = p->before + GAIN;
  bool moved = true;
  for (int sweep = 0; sweep < 4 && moved; sweep++) {
    moved = false;
    for (size_t i = 0; i < p->ncore; i++) {
      if (m->fixed.data[p->core[i]]) continue;
      size_t n = patch_star(p, p->core[i], corner);
      if (n) moved |= quad__improve(m->xy.data, p->core[i], corner, n, sweep < 2 ? 3 : 5, c->floor);
    }
  }
  QuadScore now = patch_score(p, m->xy.data);
  bool gained = !p->neutral || now.energy < p->energy - GAIN;
  if (now.worst < enough || !gained || !patch_valid(p, m->xy.data)) {
    for (size_t i = 0; i < p->ncore; i++) m->xy.data[p->core[i]] = p->old[i];
    return false;
  }
  for (size_t i = 0; i < p->n; i++) {
    uint32_t *v = &m->vertex.data[4 * (size_t)p->element[i]];
    for (int k = 0; k < 4; k++) {
      if (v[k] != NONE) c->touched[v[k]] = 1;
      v[k] = p->corner[4 * i + (size_t)k];
      if (v[k] != NONE) c->touched[v[k]] = 1;
    }
  }
  return true;
}

// ---- operations

// What irregularity costs: squares, so that one vertex of valence 6 is worse than two of 5.
static int cost_of(const Clean *c, uint32_t v, int val)
{
  int d = val - c->ideal[v], least = c->boundary[v] ? 1 : 3;
  return val < least ? 100 : d * d;
}

// A bad element justifies what valences would not, if it gets better by it.
static bool is_bad(const Clean *c, uint32_t e)
{
  return quad__shape(c->m->xy.data, &c->m->vertex.data[4 * (size_t)e]) < BAD;
}

// A vertex with two quads: one quad without it.
static bool remove_doublet(Clean *c, uint32_t v)
{
  const uint32_t *at = &c->stars.at[c->stars.start[v]];
  QuadMesh *m = c->m;
  Patch p;
  if (valence(c, v) != 2 || c->boundary[v] || m->fixed.data[v]) return false;
  if (!quad_mesh_is_quad(m, at[0]) || !quad_mesh_is_quad(m, at[1])) return false;
  if (!patch_begin(c, &p, &v, 1)) return false;
  uint32_t *a = patch_element(&p, at[0]), *b = patch_element(&p, at[1]), far = NONE;
  for (int k = 0; k < 4; k++)
    if (b[k] == v) far = b[(k + 2) % 4];
  for (int k = 0; k < 4; k++)
    if (a[k] == far) return false;
  for (int k = 0; k < 4; k++)
    if (a[k] == v) a[k] = far;
  for (int k = 0; k < 4; k++) b[k] = NONE;
  p.ncore = 0;
  return patch_end(c, &p);
}

// True if x is joined to y by an edge of some element around x.
static bool joined(const Clean *c, uint32_t x, uint32_t y)
{
  for (uint32_t k = c->stars.start[x]; k < c->stars.start[x + 1]; k++) {
    const uint32_t *v = &c->m->vertex.data[4 * (size_t)c->stars.at[k]];
    int n = v[3] == NONE ? 3 : 4;
    for (int j = 0; j < n; j++)
      if (v[j] == x && (v[(j + 1) % n] == y || v[(j + n - 1) % n] == y)) return true;
  }
  return false;
}

// Besides b and d, no vertex is joined to both a and c, and no element but the quad holds both.
static bool may_close(const Clean *c, uint32_t q, uint32_t a, uint32_t b, uint32_t cc, uint32_t d)
{
  for (uint32_t k = c->stars.start[a]; k < c->stars.start[a + 1]; k++) {
    uint32_t e = c->stars.at[k];
    const uint32_t *v = &c->m->vertex.data[4 * (size_t)e];
    for (int j = 0; j < 4; j++) {
      if (v[j] == NONE || v[j] == a) continue;
      if (v[j] == cc && e != q) return false;
      if (v[j] != b && v[j] != d && v[j] != cc && joined(c, a, v[j]) && joined(c, cc, v[j])) return false;
    }
  }
  return true;
}

// Close the quad q by joining its corners k and k+2 to one vertex (a diamond where both have valence 3).
static bool close_quad(Clean *c, uint32_t q, int k)
{
  QuadMesh *m = c->m;
  const uint32_t *v = &m->vertex.data[4 * (size_t)q];
  uint32_t a = v[k], b = v[(k + 1) % 4], cc = v[(k + 2) % 4], d = v[(k + 3) % 4];
  if (m->fixed.data[a]) {
    uint32_t t = a;
    a = cc, cc = t, t = b, b = d, d = t;
  }
  if (m->fixed.data[a]) return false;
  int va = valence(c, a), vc = valence(c, cc), vb = valence(c, b), vd = valence(c, d);
  int before = cost_of(c, a, va) + cost_of(c, cc, vc) + cost_of(c, b, vb) + cost_of(c, d, vd);
  int after = cost_of(c, cc, va + vc - 2) + cost_of(c, b, vb - 1) + cost_of(c, d, vd - 1);
  bool strict = after >= before;
  if ((strict && (after >= 100 || !is_bad(c, q))) || !may_close(c, q, a, b, cc, d)) return false;
  Patch p;
  uint32_t core[4] = {cc, a, b, d};
  if (!patch_begin(c, &p, core, 4)) return false;
  p.strict = strict;
  uint32_t *gone = patch_element(&p, q);
  for (int i = 0; i < 4; i++) gone[i] = NONE;
  patch_replace(&p, a, cc);
  if (!m->fixed.data[cc]) m->xy.data[cc] = vec2_scale(0.5, vec2_add(m->xy.data[a], m->xy.data[cc]));
  return patch_end(c, &p);
}

// Turn the edge of side s to one of the two other diagonals of the hexagon around it.
static bool turn_edge(Clean *c, uint32_t s, int way)
{
  QuadMesh *m = c->m;
  uint32_t t = c->twin[s], e = s / 4, f = t / 4, h[6];
  for (uint32_t i = 0; i < 3; i++) {
    h[i] = m->vertex.data[4 * e + (s % 4 + 1 + i) % 4]; // from the end of s round to its beginning
    h[3 + i] = m->vertex.data[4 * f + (t % 4 + 1 + i) % 4];
  }
  // The hexagon h[0] .. h[5] has the edge h[0] h[3]; the new one is h[1] h[4] or h[2] h[5].
  uint32_t p0 = h[0], p3 = h[3], n0 = h[way ? 2 : 1], n1 = h[way ? 5 : 4];
  int before = 0, after = 0;
  before = cost_of(c, p0, valence(c, p0)) + cost_of(c, p3, valence(c, p3)) + cost_of(c, n0, valence(c, n0)) +
           cost_of(c, n1, valence(c, n1));
  after = cost_of(c, p0, valence(c, p0) - 1) + cost_of(c, p3, valence(c, p3) - 1) + cost_of(c, n0, valence(c, n0) + 1) +
          cost_of(c, n1, valence(c, n1) + 1);
  // Equal valences: a pair of irregular vertices moves together, if the shapes gain.
  bool neutral = after == before && before > 0 && after < 100, strict = after >= before && !neutral;
  if ((strict && (after >= 100 || (!is_bad(c, e) && !is_bad(c, f)))) || joined(c, n0, n1)) return false;
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < i; j++)
      if (h[i] == h[j]) return false;
  Patch p;
  if (!patch_begin(c, &p, h, 6)) return false;
  p.strict = strict;
  p.neutral = neutral;
  uint32_t *a = patch_element(&p, e), *b = patch_element(&p, f), first = way ? 2 : 1;
  for (uint32_t i = 0; i < 4; i++) {
    a[i] = h[(first + i) % 6];
    b[i] = h[(first + 3 + i) % 6];
  }
  // Most neutral turns are hopeless; do not search for places there.
  if (neutral && fmin(quad__shape(m->xy.data, a), quad__shape(m->xy.data, b)) < HOPE) return false;
  return patch_end(c, &p);
}

// ---- rounds

// Regular valence of boundary vertices: the angle inside in right angles, at least 1.
static void ideal_valences(Clean *c)
{
  const QuadMesh *m = c->m;
  double *angle = mem_zalloc((m->xy.len + 1) * sizeof *angle);
  for (size_t s = 0; s < m->vertex.len; s++) {
    size_t e = s / 4, n = quad_mesh_corners(m, e), k = s % 4;
    if (k >= n) continue;
    const uint32_t *v = &m->vertex.data[4 * e];
    Vec2 at = m->xy.data[v[k]], u = vec2_sub(m->xy.data[v[(k + 1) % n]], at), w = vec2_sub(m->xy.data[v[(k + n - 1) % n]], at);
    angle[v[k]] += fabs(atan2(vec2_cross(u, w), vec2_dot(u, w)));
    if (c->twin[s] == NONE) c->boundary[v[k]] = c->boundary[v[(k + 1) % n]] = 1;
  }
  for (size_t v = 0; v < m->xy.len; v++) c->ideal[v] = c->boundary[v] ? MAX(1, (int)lround(angle[v] / (PI / 2))) : 4;
  free(angle);
}

static void clean_begin(Clean *c, QuadMesh *m)
{
  size_t nv = m->xy.len + 1;
  *c = (Clean){.m = m, .stars = quad__stars(m), .twin = quad_mesh_twins(m), .floor = quad__floor(m)};
  c->locked = quad__locked_sides(m, c->twin);
  c->boundary = mem_zalloc(nv);
  c->touched = mem_zalloc(nv);
  c->ideal = mem_alloc(nv * sizeof *c->ideal);
  ideal_valences(c);
}

static void clean_end(Clean *c)
{
  quad__stars_free(&c->stars);
  free(c->twin);
  free(c->locked);
  free(c->boundary);
  free(c->touched);
  free(c->ideal);
  quad_mesh_compact(c->m);
}

static size_t remove_doublets(QuadMesh *m)
{
  Clean c;
  size_t n = 0;
  clean_begin(&c, m);
  for (uint32_t v = 0; v < m->xy.len; v++) n += remove_doublet(&c, v);
  clean_end(&c);
  return n;
}

static size_t close_quads(QuadMesh *m)
{
  Clean c;
  size_t n = 0;
  clean_begin(&c, m);
  for (uint32_t e = 0; e < quad_mesh_elements(m); e++)
    if (quad_mesh_is_quad(m, e) && (close_quad(&c, e, 0) || close_quad(&c, e, 1))) n++;
  clean_end(&c);
  return n;
}

static size_t turn_edges(QuadMesh *m)
{
  Clean c;
  size_t n = 0;
  clean_begin(&c, m);
  for (uint32_t s = 0; s < m->vertex.len; s++) {
    uint32_t t = c.twin[s];
    if (t == NONE || t < s || c.locked[s] || !quad_mesh_is_quad(m, s / 4) || !quad_mesh_is_quad(m, t / 4)) continue;
    if (c.touched[m->vertex.data[s]] || c.touched[m->vertex.data[t]]) continue;
    if (turn_edge(&c, s, 0) || turn_edge(&c, s, 1)) n++;
  }
  clean_end(&c);
  return n;
}

void quad_clean(QuadMesh *m, int rounds, QuadReport *report)
{
  size_t before = m->xy.len;
  for (int r = 0; r < rounds; r++) {
    size_t doublets = remove_doublets(m), closed = close_quads(m), turned = turn_edges(m);
    report->doublets += doublets;
    report->collapses += closed;
    report->flips += turned;
    quad_smooth(m, 2);
    if (doublets + closed + turned == 0) break;
  }
  report->removed += before - m->xy.len;
}

// ---- leftover triangles

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
