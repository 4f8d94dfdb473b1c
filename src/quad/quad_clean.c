// quad_clean.c - topological clean-up of quad meshes
// SPDX-License-Identifier: MIT
//
// Every operation rewrites the elements around a few vertices and is kept only if quad__patch_end finds them better: by shapes,
// lengths of edges, and valences (4 inside, on the boundary what the angle calls for). Vertices of the wrong valence and the corners of bad
// elements ask for operations around them, and so does everything around an operation, until there is none left to ask.
#include "base/base.h"
#include "quad/quad_patch.h"

// An operation may make valences worse by so much, if shapes and lengths gain.
enum { WORSE = 2, MAX_RING = 12, FIRST_ROUNDS = 2, AGAIN = 20 };
// Square of a way, over that of the diagonal of an element there, that makes another look worth while.
#define FAR2 2e-2
// The same for one diagonal that is clearly shorter than the other.
#define SHORT2 0.72

typedef struct {
  QuadEdit d;
  QuadReport *report;
} Clean;

// ---- valences

// What irregularity costs: squares, so that one vertex of valence 6 is worse than two of 5.
static int cost_of(const QuadEdit *d, uint32_t v, int change)
{
  int val = d->count.data[v] + change, off = val - d->ideal.data[v], least = d->boundary.data[v] ? 1 : 3;
  return val < least ? 100 : off * off;
}

// What is gained where the valence of v[i] changes by change[i].
static int gain_of(const QuadEdit *d, const uint32_t *v, const int *change, int n)
{
  int gain = 0;
  for (int i = 0; i < n; i++) gain += cost_of(d, v[i], 0) - cost_of(d, v[i], change[i]);
  return gain;
}

// ---- operations

// A vertex with two quads: one quad without it.
static bool remove_doublet(Clean *c, uint32_t v)
{
  QuadEdit *d = &c->d;
  QuadMesh *m = d->m;
  const uint32_t *at = quad__around(d, v);
  QuadPatch p;
  if (quad__count(d, v) != 2 || d->boundary.data[v] || m->fixed.data[v]) return false;
  if (!quad_mesh_is_quad(m, at[0]) || !quad_mesh_is_quad(m, at[1]) || !quad__patch_begin(d, &p, &v, 1)) return false;
  uint32_t *a = quad__patch_element(&p, at[0]), *b = quad__patch_element(&p, at[1]), far = NONE;
  for (int k = 0; k < 4; k++)
    if (b[k] == v) far = b[(k + 2) % 4];
  for (int k = 0; k < 4; k++)
    if (a[k] == far) return false;
  for (int k = 0; k < 4; k++)
    if (a[k] == v) a[k] = far;
  for (int k = 0; k < 4; k++) b[k] = NONE;
  p.ncore = 0;
  p.gain = 100;
  bool kept = quad__patch_end(d, &p);
  c->report->doublets += kept;
  return kept;
}

// Besides b and d, no vertex is joined to both a and c, and no element but the quad holds both.
static bool may_close(const QuadEdit *e, uint32_t q, const uint32_t v[4])
{
  for (uint32_t k = 0; k < quad__count(e, v[0]); k++) {
    uint32_t f = quad__around(e, v[0])[k];
    const uint32_t *w = &e->m->vertex.data[4 * (size_t)f];
    for (int j = 0; j < 4; j++) {
      if (w[j] == NONE || w[j] == v[0]) continue;
      if (w[j] == v[2] && f != q) return false;
      if (w[j] != v[1] && w[j] != v[3] && w[j] != v[2] && quad__joined(e, v[0], w[j]) && quad__joined(e, v[2], w[j])) return false;
    }
  }
  return true;
}

// Closing a good quad along its longer diagonal is in vain, nearly always, if valences do not gain.
static bool is_worth_closing(const Vec2 *xy, const uint32_t v[4], int gain)
{
  Vec2 joined = vec2_sub(xy[v[0]], xy[v[2]]), other = vec2_sub(xy[v[1]], xy[v[3]]);
  if (gain > 0 || vec2_dot(joined, joined) < SHORT2 * vec2_dot(other, other)) return true;
  return quad__skew(xy, v) > PATCH_BAD;
}

// Close the quad q by joining its corners k and k+2 to one vertex (a diamond where both have valence 3).
static bool close_quad(Clean *c, uint32_t q, uint32_t k)
{
  QuadEdit *d = &c->d;
  QuadMesh *m = d->m;
  uint32_t v[4];
  for (uint32_t i = 0; i < 4; i++) v[i] = m->vertex.data[4 * q + (k + i) % 4];
  if (m->fixed.data[v[0]]) {
    uint32_t t = v[0];
    v[0] = v[2], v[2] = t, t = v[1], v[1] = v[3], v[3] = t;
  }
  if (m->fixed.data[v[0]] || quad__count(d, v[1]) < 2 || quad__count(d, v[3]) < 2) return false;
  int n0 = (int)quad__count(d, v[0]), change[4] = {4 - n0, -1, n0 - 2, -1}; // v[0] will not be: it costs nothing
  int gain = gain_of(d, v, change, 4);
  QuadPatch p;
  if (gain < 0 || !is_worth_closing(m->xy.data, v, gain) || !may_close(d, q, v) || !quad__patch_begin(d, &p, v, 4)) return false;
  p.gain = gain;
  uint32_t *gone = quad__patch_element(&p, q);
  for (int i = 0; i < 4; i++) gone[i] = NONE;
  quad__patch_replace(&p, v[0], v[2]);
  if (!m->fixed.data[v[2]]) m->xy.data[v[2]] = vec2_scale(0.5, vec2_add(m->xy.data[v[0]], m->xy.data[v[2]]));
  bool kept = quad__patch_end(d, &p);
  c->report->collapses += kept;
  return kept;
}

// Turn the edge ab of the quads e and f to one of the two other diagonals of the hexagon around it.
static bool turn_edge(Clean *c, uint32_t e, uint32_t f, uint32_t a, uint32_t b, uint32_t way)
{
  QuadEdit *d = &c->d;
  uint32_t h[6], first = way ? 2 : 1;
  const uint32_t *x = &d->m->vertex.data[4 * (size_t)e], *y = &d->m->vertex.data[4 * (size_t)f];
  for (uint32_t i = 0; i < 4; i++) // the hexagon from b round to a, and on: its edge h[0] h[3] is to be h[1] h[4] or h[2] h[5]
    for (uint32_t j = 0; j < 3; j++) {
      if (x[i] == b && x[(i + 3) % 4] == a) h[j] = x[(i + j) % 4];
      if (y[i] == a && y[(i + 3) % 4] == b) h[3 + j] = y[(i + j) % 4];
    }
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < i; j++)
      if (h[i] == h[j]) return false;
  uint32_t end[4] = {h[0], h[3], h[first], h[first + 3]};
  int gain = gain_of(d, end, (const int[4]){-1, -1, 1, 1}, 4);
  if (gain < -WORSE || quad__joined(d, end[2], end[3])) return false;
  uint32_t was[8], is[8];
  for (uint32_t i = 0; i < 4; i++) {
    was[i] = x[i], was[4 + i] = y[i];
    is[i] = h[(first + i) % 6], is[4 + i] = h[(first + 3 + i) % 6];
  }
  QuadPatch p;
  if (quad__is_hopeless(d, was, is, 2, gain) || !quad__patch_begin(d, &p, h, 6)) return false;
  p.gain = gain;
  memcpy(quad__patch_element(&p, e), is, 4 * sizeof *is);
  memcpy(quad__patch_element(&p, f), is + 4, 4 * sizeof *is);
  bool kept = quad__patch_end(d, &p);
  c->report->flips += kept;
  return kept;
}

// Neighbours of v in the interior, counterclockwise, and the element after each. 0 if there are too many.
static uint32_t ring_of(const QuadEdit *d, uint32_t v, uint32_t *to, uint32_t *element)
{
  uint32_t n = quad__count(d, v), next[MAX_RING];
  if (n > MAX_RING) return 0;
  for (uint32_t i = 0; i < n; i++) {
    element[i] = quad__around(d, v)[i];
    const uint32_t *w = &d->m->vertex.data[4 * (size_t)element[i]];
    uint32_t k = w[3] == NONE ? 3 : 4;
    for (uint32_t j = 0; j < k; j++)
      if (w[j] == v) to[i] = w[(j + 1) % k], next[i] = w[(j + k - 1) % k];
  }
  for (uint32_t i = 0; i + 1 < n; i++)
    for (uint32_t j = i + 1; j < n; j++)
      if (to[j] == next[i]) {
        uint32_t t = to[i + 1], u = next[i + 1], w = element[i + 1];
        to[i + 1] = to[j], next[i + 1] = next[j], element[i + 1] = element[j];
        to[j] = t, next[j] = u, element[j] = w;
        break;
      }
  return n;
}

// Open the edges from v to its neighbours i and i+k: v keeps the k elements between them, a new vertex takes the others, and a new quad
// lies between the two. The contrary of closing.
static bool open_edges(Clean *c, uint32_t v, uint32_t i, uint32_t k)
{
  QuadEdit *d = &c->d;
  QuadMesh *m = d->m;
  uint32_t to[MAX_RING], element[MAX_RING], n = ring_of(d, v, to, element);
  if (n < 4 || i >= n) return false;
  uint32_t j = (i + k) % n, end[3] = {v, to[i], to[j]};
  int after = (int)(n - k) + 1 - 4, gain = gain_of(d, end, (const int[3]){(int)k + 1 - (int)n, 1, 1}, 3) - after * after;
  QuadPatch p;
  if (gain < -WORSE || quad__is_locked(d, v, to[i]) || quad__is_locked(d, v, to[j])) return false;
  Vec2 at = m->xy.data[v];
  uint32_t w = quad__edit_add_vertex(d, at, &v, 1), q = quad__edit_add_element(d), core[4] = {v, to[i], to[j], w};
  bool kept = quad__patch_begin(d, &p, core, 4) && p.n < PATCH_ELEMENTS;
  if (kept) {
    p.gain = gain;
    Vec2 mean[2] = {{0, 0}, {0, 0}};
    for (uint32_t s = 1; s < n; s++)
      if (s != k) mean[s > k] = vec2_add(mean[s > k], vec2_scale(1.0 / (s > k ? n - k - 1 : k - 1), m->xy.data[to[(i + s) % n]]));
    for (uint32_t s = k; s < n; s++) {
      uint32_t *x = quad__patch_element(&p, element[(i + s) % n]);
      for (int t = 0; t < 4; t++)
        if (x[t] == v) x[t] = w;
    }
    uint32_t quad[4] = {to[i], v, to[j], w};
    p.element[p.n] = q;
    for (size_t t = 0; t < 4; t++) p.corner[4 * p.n + t] = quad[t];
    p.n++;
    for (int s = 0; s < 2; s++) m->xy.data[s ? w : v] = vec2_add(vec2_scale(0.7, at), vec2_scale(0.3, mean[s]));
    kept = quad__patch_end(d, &p);
  }
  if (!kept) quad__edit_drop_vertex(d), vec_push(&d->dead, q);
  c->report->opened += kept;
  return kept;
}

// ---- what to do where

static bool turn_edges_at(Clean *c, uint32_t v)
{
  const QuadMesh *m = c->d.m;
  for (uint32_t i = 0; i < quad__count(&c->d, v); i++) {
    uint32_t e = quad__around(&c->d, v)[i];
    if (!quad_mesh_is_quad(m, e)) continue;
    for (uint32_t j = 0; j < 4; j++) {
      uint32_t a = m->vertex.data[4 * e + j], b = m->vertex.data[4 * e + (j + 1) % 4], f = quad__across(&c->d, e, a, b);
      if (f == NONE || !quad_mesh_is_quad(m, f) || quad__is_locked(&c->d, a, b)) continue;
      if (turn_edge(c, e, f, a, b, 0) || turn_edge(c, e, f, a, b, 1)) return true;
    }
  }
  return false;
}

static bool close_quads_at(Clean *c, uint32_t v)
{
  for (uint32_t i = 0; i < quad__count(&c->d, v); i++) {
    uint32_t e = quad__around(&c->d, v)[i];
    if (quad_mesh_is_quad(c->d.m, e) && (close_quad(c, e, 0) || close_quad(c, e, 1))) return true;
  }
  return false;
}

static bool open_edges_at(Clean *c, uint32_t v)
{
  uint32_t n = quad__count(&c->d, v);
  if (c->d.boundary.data[v] || c->d.m->fixed.data[v] || n < 4 || n > MAX_RING) return false;
  for (uint32_t k = 2; 2 * k <= n; k++)
    for (uint32_t i = 0; i < n; i++)
      if (open_edges(c, v, i, k)) return true;
  return false;
}

static bool improve_at(Clean *c, uint32_t v)
{
  return remove_doublet(c, v) || close_quads_at(c, v) || turn_edges_at(c, v) || open_edges_at(c, v);
}

// ---- rounds

// Vertices that may find better places, and those that have gone far since they were last looked at.
typedef struct {
  uint8_t *awake, *moved;
  size_t room;
} Relax;

static void make_room(Relax *x, size_t nv)
{
  if (nv <= x->room) return;
  x->awake = mem_realloc(x->awake, 2 * nv);
  x->moved = mem_realloc(x->moved, 2 * nv);
  memset(x->awake + x->room, 1, 2 * nv - x->room);
  memset(x->moved + x->room, 1, 2 * nv - x->room);
  x->room = 2 * nv;
}

static void wake_star(Relax *x, const uint32_t *star, size_t n)
{
  for (size_t i = 0; i < 4 * n; i++)
    if (star[i] != NONE) x->awake[star[i]] = 1;
}

static void relax(QuadEdit *d, Relax *x, int passes)
{
  QuadMesh *m = d->m;
  uint32_t star[4 * PATCH_ELEMENTS];
  for (int pass = 0; pass < passes; pass++)
    for (uint32_t v = 0; v < m->xy.len; v++) {
      size_t n = quad__count(d, v);
      if (!x->awake[v] || m->fixed.data[v] || n > PATCH_ELEMENTS) continue;
      x->awake[v] = 0;
      for (size_t i = 0; i < n; i++) memcpy(&star[4 * i], &m->vertex.data[4 * (size_t)quad__around(d, v)[i]], 4 * sizeof *star);
      Vec2 old = m->xy.data[v];
      if (!n || !quad__relax(m->xy.data, m->size.len ? m->size.data : NULL, v, star, n, d->floor)) continue;
      wake_star(x, star, n);
      Vec2 way = vec2_sub(m->xy.data[v], old), edge = vec2_sub(m->xy.data[star[0]], m->xy.data[star[2]]);
      if (vec2_dot(way, way) > FAR2 * vec2_dot(edge, edge)) x->moved[v] = 1;
    }
}

// Vertices of the wrong valence, and corners of bad elements, where something near has moved.
static void enqueue_irregular(QuadEdit *d, Relax *x)
{
  const QuadMesh *m = d->m;
  for (uint32_t v = 0; v < m->xy.len; v++) {
    bool near = x->moved[v];
    for (uint32_t i = 0; i < quad__count(d, v) && !near; i++)
      for (int k = 0; k < 4; k++) {
        uint32_t w = m->vertex.data[4 * (size_t)quad__around(d, v)[i] + (size_t)k];
        near |= w != NONE && x->moved[w];
      }
    if (near && quad__count(d, v) && quad__count(d, v) != d->ideal.data[v]) quad__enqueue(d, v);
  }
  memset(x->moved, 0, x->room);
}

// Work off the queue; operations enqueue what is around them. Returns how many were done.
static size_t run(Clean *c, Relax *x)
{
  QuadEdit *d = &c->d;
  size_t done = 0, most = AGAIN * d->m->xy.len;
  for (size_t i = 0; i < d->queue.len && i < most; i++) {
    uint32_t v = d->queue.data[i];
    d->queued.data[v] = 0;
    make_room(x, d->m->xy.len);
    x->awake[v] = 1;
    if (!quad__count(d, v) || quad__count(d, v) == d->ideal.data[v] || !improve_at(c, v)) continue;
    done++;
    quad__enqueue(d, v);
  }
  while (d->queue.len) d->queued.data[vec_pop(&d->queue)] = 0;
  return done;
}

void quad_clean(QuadMesh *m, int rounds, QuadReport *report)
{
  size_t before = m->xy.len;
  Clean c = {.report = report};
  Relax x = {0};
  quad__edit_begin(&c.d, m);
  make_room(&x, m->xy.len);
  for (int r = 0; r < rounds; r++) {
    enqueue_irregular(&c.d, &x);
    if (!run(&c, &x)) break;
    make_room(&x, m->xy.len);
    relax(&c.d, &x, r < FIRST_ROUNDS ? 2 : 1); // most changes are made in the first rounds
  }
  free(x.awake);
  free(x.moved);
  quad__edit_end(&c.d);
  report->removed += before > m->xy.len ? before - m->xy.len : 0;
}
