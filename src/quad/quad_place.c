// quad_place.c - a better place for one vertex: right angles and edges of the wanted length, never to the harm of the worst element
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

// What an edge of a wrong length costs beside an element of a wrong shape, where a vertex is moved and where sets of elements are compared.
// Larger weights lose angles, smaller ones sizes.
static const double MOVE_WEIGHT = 0.15, LENGTH_WEIGHT = 0.2, LEAST_GAIN = 1e-6;
enum { QUICK_STEPS = 2, UNTANGLE_STEPS = 4, MAX_WINGS = 64 };

// An element about the vertex: its corners after (b), before (a) and, of a quad, opposite (c).
typedef struct {
  Vec2 a, b, c;
  double ha, hb;  // wanted size at a and b; 0: not known
  double skew_c;  // of the corner c, which stays as it is
  bool triangle;
} Wing;

typedef struct {
  Wing wing[MAX_WINGS];
  size_t n;
  Vec2 at;                    // where the vertex is
  const QuadSize *size;       // NULL: not known
  double weight;
  QuadScore best;
} Star;

// ---- what a star is worth

static inline double length_energy(double l2, double h2)
{
  // sinh^2 of log(l/h): too long and too short by the same ratio cost the same.
  return 0.25 * (l2 / h2 + h2 / l2 - 2);
}

static inline double wing_skew(const Wing *w, Vec2 p)
{
  if (w->triangle) return quad__triangle_skew(p, w->b, w->a);
  Vec2 pa = vec2_sub(w->a, p), pb = vec2_sub(w->b, p), ba = vec2_sub(w->c, w->b), ca = vec2_sub(w->c, w->a);
  double s = quad__corner_skew(pb, pa), t = quad__corner_skew(ba, vec2_scale(-1, pb)), u = quad__corner_skew(vec2_scale(-1, pa), ca);
  s = s > t ? s : t;
  s = s > u ? s : u;
  return s > w->skew_c ? s : w->skew_c;
}

QuadScore quad__score(const Vec2 *xy, const QuadSize *size, const uint32_t *corner, size_t n)
{
  QuadScore s = {0, 0};
  for (size_t i = 0; i < n; i++) {
    const uint32_t *c = corner + 4 * i;
    double skew = quad__skew(xy, c);
    s.worst = skew > s.worst ? skew : s.worst;
    s.energy += quad__skew_energy(skew);
    for (uint32_t j = 0, k = c[3] == NONE ? 3 : 4; size && j < k; j++) {
      uint32_t a = c[j], b = c[(j + 1) % k];
      double h = 0.5 * (quad__size_at(&size[a], xy[a]) + quad__size_at(&size[b], xy[b]));
      Vec2 e = vec2_sub(xy[b], xy[a]);
      if (h > 0) s.energy += 0.5 * LENGTH_WEIGHT * length_energy(vec2_dot(e, e), h * h);
    }
  }
  return s;
}

// Score with the vertex at p; false as soon as it is known to be no better than s->best (unless `full`).
static bool star_score(const Star *s, Vec2 p, double floor, bool full, QuadScore *score)
{
  QuadScore now = {0, 0};
  double h = s->size ? quad__size_at(s->size, p) : 0;
  for (size_t i = 0; i < s->n; i++) {
    const Wing *w = &s->wing[i];
    double skew = wing_skew(w, p);
    now.worst = skew > now.worst ? skew : now.worst;
    now.energy += quad__skew_energy(skew);
    if (s->size) {
      double ga = 0.5 * (h + w->ha), gb = 0.5 * (h + w->hb);
      Vec2 pa = vec2_sub(w->a, p), pb = vec2_sub(w->b, p);
      now.energy += s->weight * (length_energy(vec2_dot(pa, pa), ga * ga) + length_energy(vec2_dot(pb, pb), gb * gb));
    }
    if (full) continue;
    if (s->best.worst > floor ? now.worst > s->best.worst : now.worst > floor || now.energy >= s->best.energy) return false;
  }
  *score = now;
  return true;
}

// Better: the worst improves, or stays (or remains below the floor) while the energy falls.
static bool better(QuadScore a, QuadScore b, double floor)
{
  if (b.worst > floor && a.worst < b.worst - LEAST_GAIN) return true;
  return (a.worst <= b.worst || a.worst <= floor) && a.energy < b.energy - LEAST_GAIN;
}

static bool star_try(Star *s, Vec2 p, double floor)
{
  QuadScore now;
  if (!star_score(s, p, floor, false, &now) || !better(now, s->best, floor)) return false;
  s->best = now;
  s->at = p;
  return true;
}

static bool star_init(Star *s, const Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n)
{
  if (n > MAX_WINGS) return false;
  s->n = 0;
  s->at = xy[v];
  s->size = size && size[v].h > 0 ? &size[v] : NULL;
  s->weight = 0.5 * MOVE_WEIGHT;
  for (size_t i = 0; i < n; i++) {
    const uint32_t *c = corner + 4 * i;
    uint32_t k = c[3] == NONE ? 3 : 4;
    for (uint32_t j = 0; j < k; j++) {
      if (c[j] != v) continue;
      uint32_t b = c[(j + 1) % k], a = c[(j + k - 1) % k];
      Wing *w = &s->wing[s->n++];
      *w = (Wing){.a = xy[a], .b = xy[b], .triangle = k == 3};
      if (k == 4) {
        w->c = xy[c[(j + 2) % 4]];
        w->skew_c = quad__corner_skew(vec2_sub(w->a, w->c), vec2_sub(w->b, w->c));
      }
      if (s->size) w->ha = quad__size_at(&size[a], w->a), w->hb = quad__size_at(&size[b], w->b);
      break;
    }
  }
  return s->n > 0;
}

// ---- where to go

// Sums of a least-squares problem in two unknowns.
typedef struct {
  double xx, xy, yy, x, y;
} Normal;

static inline void add_residual(Normal *q, double weight, double r, Vec2 g)
{
  q->xx += weight * g.x * g.x, q->xy += weight * g.x * g.y, q->yy += weight * g.y * g.y;
  q->x += weight * r * g.x, q->y += weight * r * g.y;
}

// The cosine of the corner at b between p and c, less `wanted`, where p moves.
static inline void add_side_corner(Normal *q, Vec2 p, Vec2 b, Vec2 c, double wanted)
{
  Vec2 e = vec2_sub(p, b), f = vec2_sub(c, b);
  double e2 = vec2_dot(e, e), l = sqrt(e2 * vec2_dot(f, f)), cosine = vec2_dot(e, f) / l;
  add_residual(q, 1, cosine - wanted, vec2_sub(vec2_scale(1 / l, f), vec2_scale(cosine / e2, e)));
}

static inline void add_length(Normal *q, const Star *s, Vec2 p, Vec2 a, double ha, double h)
{
  Vec2 e = vec2_sub(p, a);
  double l = vec2_length(e), g = 0.5 * (ha + h), r = l / g;
  add_residual(q, s->weight, 0.5 * (r - 1 / r), vec2_scale(0.5 * (1 + 1 / (r * r)), vec2_sub(vec2_scale(1 / (l * g), e), vec2_scale(0.5 * r / g, s->size->slope))));
}

// One step of Gauss and Newton for the cosines of all corners and the lengths of the edges at the vertex.
static bool newton_step(const Star *s, Vec2 *step)
{
  Normal q = {0};
  Vec2 p = s->at;
  double h = s->size ? quad__size_at(s->size, p) : 0;
  for (size_t i = 0; i < s->n; i++) {
    const Wing *w = &s->wing[i];
    double wanted = w->triangle ? 0.5 : 0;
    Vec2 e = vec2_sub(w->b, p), f = vec2_sub(w->a, p);
    double e2 = vec2_dot(e, e), f2 = vec2_dot(f, f), l = sqrt(e2 * f2), cosine = vec2_dot(e, f) / l;
    Vec2 along = vec2_add(vec2_scale(cosine / e2, e), vec2_scale(cosine / f2, f));
    add_residual(&q, 1, cosine - wanted, vec2_sub(along, vec2_scale(1 / l, vec2_add(e, f))));
    add_side_corner(&q, p, w->b, w->triangle ? w->a : w->c, wanted);
    add_side_corner(&q, p, w->a, w->triangle ? w->b : w->c, wanted);
    if (s->size) {
      add_length(&q, s, p, w->a, w->ha, h);
      add_length(&q, s, p, w->b, w->hb, h);
    }
  }
  double d = q.xx * q.yy - q.xy * q.xy;
  if (!(d > 1e-12 * (q.xx + q.yy) * (q.xx + q.yy))) return false;
  *step = (Vec2){-(q.yy * q.x - q.xy * q.y) / d, -(q.xx * q.y - q.xy * q.x) / d};
  return isfinite(step->x) && isfinite(step->y);
}

static Vec2 neighbour_mean(const Star *s)
{
  Vec2 sum = {0, 0};
  for (size_t i = 0; i < s->n; i++) sum = vec2_add(sum, vec2_add(s->wing[i].a, s->wing[i].b));
  return vec2_scale(0.5 / (double)s->n, sum);
}

static double reach(const Star *s)
{
  double most = 0;
  for (size_t i = 0; i < s->n; i++) most = fmax(most, vec2_length(vec2_sub(s->wing[i].a, s->at)));
  return most;
}

// Pattern search, for stars too bad for anything smoother.
static bool search(Star *s, int steps, double floor)
{
  static const double dir[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0.7, 0.7}, {-0.7, 0.7}, {-0.7, -0.7}, {0.7, -0.7}};
  double step = 0.2 * reach(s);
  bool moved = false;
  for (int k = 0; k < steps; k++) {
    bool any = false;
    for (int d = 0; d < 8; d++) any |= star_try(s, (Vec2){s->at.x + step * dir[d][0], s->at.y + step * dir[d][1]}, floor);
    moved |= any;
    if (!any) step /= 2;
  }
  return moved;
}

static bool descend(Star *s, double floor)
{
  Vec2 step;
  if (!newton_step(s, &step)) return false;
  for (int k = 0; k < 3; k++, step = vec2_scale(0.4, step))
    if (star_try(s, vec2_add(s->at, step), floor)) return true;
  return false;
}

bool quad__improve(Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n, int steps, double floor)
{
  Star s;
  if (!star_init(&s, xy, size, v, corner, n)) return false;
  star_score(&s, s.at, floor, true, &s.best);
  bool moved = false;
  if (s.best.worst > floor) moved = star_try(&s, neighbour_mean(&s), floor);
  for (int k = 0; k < steps && descend(&s, floor); k++) moved = true;
  if (s.best.worst > floor || steps > QUICK_STEPS) moved |= search(&s, steps, floor);
  if (!moved) return false;
  Vec2 old = xy[v];
  xy[v] = s.at;
  for (size_t i = 0; i < n && s.best.worst > 1 - 1e-9; i++)
    if (!quad__convex(xy, corner + 4 * i)) {
      xy[v] = old;
      return false;
    }
  return true;
}

bool quad__untangle(Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n)
{
  Star s;
  if (!star_init(&s, xy, size, v, corner, n)) return false;
  star_score(&s, s.at, 0, true, &s.best);
  bool moved = star_try(&s, neighbour_mean(&s), 0);
  moved |= search(&s, UNTANGLE_STEPS, 0);
  xy[v] = s.at;
  return moved;
}
