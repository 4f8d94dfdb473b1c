// quad_repair.c - bringing leftover triangles together in pairs
// SPDX-License-Identifier: MIT
//
// From a triangle over free edges to another one there is a way through quads. Either the triangle is moved along it, from quad to quad,
// until the two can be put together; or a row of new vertices is laid along it, one on every edge that it crosses: both triangles get a
// fourth corner, quads crossed straight become two, and quads where the way turns become three.
#include "base/base.h"
#include "quad/quad_patch.h"

enum { SETTLE = 30, TARGETS = 6, LONGEST = 1000 };

typedef struct {
  QuadEdit d;
  U32Vec from;   // by element: where the search came from; NONE: it did not
  U32Vec queue;
  U32Vec path;   // elements of the way, the first and the last a triangle
  U32Vec corner; // of them, as they are to be
} Repair;

// ---- the way

static uint32_t corners(const uint32_t *v) { return v[3] == NONE ? 3 : 4; }

static const uint32_t *element(const Repair *r, uint32_t e) { return &r->d.m->vertex.data[4 * (size_t)e]; }

static bool is_triangle(const Repair *r, uint32_t e) { return element(r, e)[0] != NONE && element(r, e)[3] == NONE; }

// The index in v of the free edge that w runs the other way; NONE if there is none. At the loose end of an embedded curve two elements
// share two edges, of which one is locked.
static uint32_t shared_side(const QuadEdit *d, const uint32_t *v, const uint32_t *w)
{
  uint32_t n = corners(v), k = corners(w);
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = 0; j < k; j++)
      if (v[i] == w[(j + 1) % k] && v[(i + 1) % n] == w[j] && !quad__is_locked(d, v[i], w[j])) return i;
  return NONE;
}

static void trace(Repair *r, uint32_t e)
{
  vec_clear(&r->path);
  for (; r->from.data[e] != e; e = r->from.data[e]) vec_push(&r->path, e);
  vec_push(&r->path, e);
  for (size_t i = 0, j = r->path.len; i + 1 < j; i++) {
    uint32_t x = r->path.data[i];
    r->path.data[i] = r->path.data[--j];
    r->path.data[j] = x;
  }
}

// The ways from triangle t to others, the shortest first; tries some until one succeeds.
static bool search_ways(Repair *r, uint32_t t, bool (*attempt)(Repair *))
{
  const QuadEdit *d = &r->d;
  vec_clear(&r->queue);
  vec_push(&r->queue, t);
  while (r->from.len < d->m->vertex.len / 4) vec_push(&r->from, NONE);
  r->from.data[t] = t;
  int targets = 0;
  bool done = false;
  for (size_t i = 0; i < r->queue.len && !done && targets < TARGETS; i++) {
    uint32_t e = r->queue.data[i], v[4];
    memcpy(v, element(r, e), sizeof v);
    for (uint32_t k = 0, n = corners(v); k < n && !done && targets < TARGETS; k++) {
      uint32_t a = v[k], b = v[(k + 1) % n], f = quad__is_locked(d, a, b) ? NONE : quad__across(d, e, a, b);
      if (f == NONE || r->from.data[f] != NONE) continue;
      r->from.data[f] = e;
      if (!is_triangle(r, f)) {
        vec_push(&r->queue, f);
        continue;
      }
      trace(r, f);
      r->from.data[f] = NONE;
      targets++;
      done = attempt(r);
    }
  }
  for (size_t i = 0; i < r->queue.len; i++) r->from.data[r->queue.data[i]] = NONE;
  return done;
}

// ---- moving a triangle along it

// The triangle t and the quad q share an edge: make of them a quad (at t) and a triangle (at q) that has the edge of q towards `next`.
// False if no valid way exists.
static bool step_triangle(const QuadEdit *d, uint32_t *t, uint32_t *q, const uint32_t *next)
{
  const Vec2 *xy = d->m->xy.data;
  uint32_t s = shared_side(d, t, q), w = shared_side(d, q, t), o = shared_side(d, q, next), p[5], best = NONE;
  if (s == NONE || o == NONE || o == w) return false;
  p[0] = t[(s + 2) % 3];
  for (uint32_t i = 0; i < 4; i++) p[1 + i] = q[(w + 1 + i) % 4];
  // Pentagon p[0 .. 4]; the way out is the edge p[j] p[j+1].
  uint32_t j = 1 + (o + 4 - (w + 1)) % 4;
  double least = 2;
  for (uint32_t ear = j; ear <= j + 1; ear++) {
    uint32_t tri[4] = {p[(ear + 4) % 5], p[ear % 5], p[(ear + 1) % 5], NONE};
    uint32_t quad[4] = {p[(ear + 1) % 5], p[(ear + 2) % 5], p[(ear + 3) % 5], p[(ear + 4) % 5]};
    double skew = fmax(quad__skew(xy, tri), quad__skew(xy, quad));
    if (skew < least && quad__convex(xy, tri) && quad__convex(xy, quad)) best = ear, least = skew;
  }
  if (best == NONE) return false;
  for (uint32_t i = 0; i < 4; i++) {
    t[i] = p[(best + 1 + i) % 5];
    q[i] = i < 3 ? p[(best + 4 + i) % 5] : NONE;
  }
  return true;
}

static bool join_triangles(const QuadEdit *d, uint32_t *t, uint32_t *u)
{
  uint32_t s = shared_side(d, t, u), w = shared_side(d, u, t);
  if (s == NONE || w == NONE) return false;
  uint32_t q[4] = {t[s], u[(w + 2) % 3], t[(s + 1) % 3], t[(s + 2) % 3]};
  if (!quad__convex(d->m->xy.data, q)) return false;
  for (uint32_t i = 0; i < 4; i++) t[i] = q[i], u[i] = NONE;
  return true;
}

static bool move_along(Repair *r)
{
  const uint32_t *path = r->path.data;
  size_t n = r->path.len;
  if (n > LONGEST) return false;
  vec_resize(&r->corner, 4 * n);
  uint32_t *c = r->corner.data;
  for (size_t i = 0; i < n; i++) memcpy(&c[4 * i], element(r, path[i]), 4 * sizeof *c);
  for (size_t i = 0; i + 2 < n; i++)
    if (!step_triangle(&r->d, &c[4 * i], &c[4 * i + 4], &c[4 * i + 8])) return false;
  if (!join_triangles(&r->d, &c[4 * n - 8], &c[4 * n - 4]) || !quad__has_room(&r->d, path, c, n)) return false;
  quad__replace(&r->d, path, c, n);
  return true;
}

// ---- a row of new vertices along it

// Give one element of the way a vertex on side `in` and one on side `out`; NONE: it ends here. Writes the elements it becomes: 1 to 3.
static size_t divide(const uint32_t *v, uint32_t in, uint32_t m, uint32_t out, uint32_t o, uint32_t centre, uint32_t *to)
{
  uint32_t n = corners(v);
#define V(i) v[(in + (i)) % n]
  if (out == NONE) {
    const uint32_t q[4] = {V(0), m, V(1), V(2)};
    memcpy(to, q, sizeof q);
    return 1;
  }
  uint32_t turn = (out + n - in) % n;
  const uint32_t straight[8] = {V(0), m, o, V(3), m, V(1), V(2), o};
  const uint32_t left[12] = {V(0), m, centre, V(3), m, V(1), o, centre, o, V(2), V(3), centre};
  const uint32_t right[12] = {m, V(1), V(2), centre, V(2), V(3), o, centre, o, V(0), m, centre};
#undef V
  memcpy(to, turn == 2 ? straight : turn == 1 ? left : right, (turn == 2 ? 8 : 12) * sizeof *to);
  return turn == 2 ? 2 : 3;
}

// A row under construction, so that it can be taken back.
typedef struct {
  U32Vec element, old; // elements, and 4 corners each as they were
  U32Vec vertex;       // those that look for places: new ones and the corners around
  Vec(Vec2) at;        // where they were
  U32Vec bad;          // elements around that were turned over before
} Row;

static void row_free(Row *w)
{
  vec_free(&w->element);
  vec_free(&w->old);
  vec_free(&w->vertex);
  vec_free(&w->at);
  vec_free(&w->bad);
}

static bool holds(const U32Vec *list, uint32_t x)
{
  for (size_t i = 0; i < list->len; i++)
    if (list->data[i] == x) return true;
  return false;
}

static void row_vertex(const Repair *r, Row *w, uint32_t v)
{
  if (holds(&w->vertex, v)) return;
  vec_push(&w->vertex, v);
  vec_push(&w->at, r->d.m->xy.data[v]);
}

// Write n elements, 3 at most, to[4n], the first in the place of e. False if a vertex has no room for them.
static bool row_replace(Repair *r, Row *w, uint32_t e, const uint32_t *to, size_t n)
{
  uint32_t id[3];
  for (size_t i = 0; i < n; i++) {
    id[i] = i ? quad__edit_add_element(&r->d) : e;
    vec_push(&w->element, id[i]);
    for (size_t k = 0; k < 4; k++) vec_push(&w->old, element(r, id[i])[k]);
  }
  if (!quad__has_room(&r->d, id, to, n)) return false;
  quad__replace(&r->d, id, to, n);
  return true;
}

static void row_undo(Repair *r, const Row *w)
{
  for (size_t i = w->element.len; i-- > 0;) quad__replace(&r->d, &w->element.data[i], &w->old.data[4 * i], 1);
  for (size_t i = 0; i < w->vertex.len; i++) r->d.m->xy.data[w->vertex.data[i]] = w->at.data[i];
}

static bool row_lay(Repair *r, Row *w)
{
  uint32_t mid = NONE, a = NONE, b = NONE, was[4];
  for (size_t i = 0; i < r->path.len; i++) {
    uint32_t e = r->path.data[i], v[4], in = 0, out = NONE, next = NONE, to[12];
    memcpy(v, element(r, e), sizeof v);
    for (uint32_t k = 0; k < corners(v); k++) row_vertex(r, w, v[k]);
    if (i + 1 < r->path.len) {
      out = shared_side(&r->d, v, element(r, r->path.data[i + 1]));
      uint32_t ends[2] = {v[out], v[(out + 1) % corners(v)]};
      Vec2 p = vec2_scale(0.5, vec2_add(r->d.m->xy.data[ends[0]], r->d.m->xy.data[ends[1]]));
      next = quad__edit_add_vertex(&r->d, p, ends, 2);
      row_vertex(r, w, next);
    }
    for (uint32_t k = 0; i > 0 && k < corners(v); k++)
      if (v[k] == b && v[(k + 1) % corners(v)] == a) in = k;
    if (next != NONE) a = v[out], b = v[(out + 1) % corners(v)];
    uint32_t centre = NONE;
    if (i > 0 && out != NONE && (out + 4 - in) % 4 != 2) {
      Vec2 p = {0, 0};
      for (int k = 0; k < 4; k++) p = vec2_add(p, vec2_scale(0.25, r->d.m->xy.data[v[k]]));
      centre = quad__edit_add_vertex(&r->d, p, v, 4);
      row_vertex(r, w, centre);
    }
    memcpy(was, v, sizeof was);
    size_t n = i == 0 ? divide(was, out, next, NONE, NONE, NONE, to) : divide(was, in, mid, out, next, centre, to);
    if (!row_replace(r, w, e, to, n)) return false;
    mid = next;
  }
  return true;
}

static void note_bad(const Repair *r, Row *w)
{
  for (size_t i = 1; i + 1 < r->path.len; i++)
    for (int k = 0; k < 4; k++) {
      uint32_t v = element(r, r->path.data[i])[k];
      for (uint32_t j = 0; j < quad__count(&r->d, v); j++) {
        uint32_t e = quad__around(&r->d, v)[j];
        if (!quad__convex(r->d.m->xy.data, element(r, e)) && !holds(&w->bad, e) && !holds(&r->path, e)) vec_push(&w->bad, e);
      }
    }
}

// Everything around the row looks for better places until all is convex that was before.
static bool row_settle(Repair *r, const Row *w)
{
  QuadMesh *m = r->d.m;
  const QuadSize *size = m->size.len ? m->size.data : NULL;
  uint32_t star[4 * PATCH_ELEMENTS];
  for (int sweep = 0; sweep < SETTLE; sweep++) {
    bool good = true;
    for (size_t i = 0; i < w->vertex.len; i++) {
      uint32_t v = w->vertex.data[i], n = quad__count(&r->d, v);
      if (n > PATCH_ELEMENTS) return false;
      for (uint32_t k = 0; k < n; k++) {
        memcpy(&star[4 * k], element(r, quad__around(&r->d, v)[k]), 4 * sizeof *star);
        good = good && (quad__convex(m->xy.data, &star[4 * k]) || holds(&w->bad, quad__around(&r->d, v)[k]));
      }
      if (!m->fixed.data[v]) quad__untangle(m->xy.data, size, v, star, n);
    }
    if (good && sweep > 1) return true;
  }
  return false;
}

static bool lay_row(Repair *r)
{
  if (r->path.len < 3 || r->path.len > LONGEST) return false;
  Row w = {0};
  note_bad(r, &w);
  bool good = row_lay(r, &w) && row_settle(r, &w);
  if (!good) row_undo(r, &w);
  row_free(&w);
  return good;
}

// ---- all triangles

void quad_repair(QuadMesh *m, QuadReport *report)
{
  if (quad_mesh_triangles(m) < 2) return;
  Repair r = {0};
  quad__edit_begin(&r.d, m);
  bool (*const attempts[])(Repair *) = {move_along, lay_row};
  for (size_t a = 0; a < 2; a++)
    for (uint32_t t = 0; t < m->vertex.len / 4; t++)
      if (is_triangle(&r, t) && search_ways(&r, t, attempts[a])) report->repaired++;
  quad__edit_end(&r.d);
  vec_free(&r.from);
  vec_free(&r.queue);
  vec_free(&r.path);
  vec_free(&r.corner);
}
