// quad_place.c - a better place for one vertex: right angles and edges of the wanted length, never to the harm of the worst element
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

// What an edge of a wrong length costs beside an element of a wrong shape: more loses angles, less sizes.
static const double LENGTH_WEIGHT = 0.2, LEAST_GAIN = 2e-5;
enum { QUICK_STEPS = 2, UNTANGLE_STEPS = 4, MAX_WINGS = 64 };

// A neighbour of the vertex.
typedef struct {
  Vec2 at;
  double h;       // wanted size there; 0: not known
  double times;   // in how many elements: edges count half with each
} Spoke;

// An element about the vertex, between the spokes b (first, counterclockwise) and a, with the opposite corner c of a quad.
typedef struct {
  uint32_t a, b;
  Vec2 bc, ac;    // from the spokes to c, or to each other in a triangle; of length 1
  double skew_c;  // of the corner c, which stays as it is
  bool triangle;
} Wing;

typedef struct {
  Spoke spoke[2 * MAX_WINGS];
  Wing wing[MAX_WINGS];
  size_t n, nspoke;
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

// Skew of a corner whose sides have the length 1 already.
static inline double unit_skew(Vec2 u, Vec2 w)
{
  double dot = vec2_dot(u, w), c2 = dot * dot;
  return vec2_cross(u, w) > 0 ? c2 : 2 - c2;
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

// Directions from p to the ends of the spokes, and their lengths. False if p is at one of them.
static bool spokes_from(const Star *s, Vec2 p, Vec2 *dir, double *length)
{
  for (size_t i = 0; i < s->nspoke; i++) {
    Vec2 d = vec2_sub(s->spoke[i].at, p);
    length[i] = sqrt(vec2_dot(d, d));
    if (!(length[i] > 0)) return false;
    dir[i] = vec2_scale(1 / length[i], d);
  }
  return true;
}

// Score with the vertex at p; false as soon as it is known to be no better than s->best (unless `full`).
static bool star_score(const Star *s, Vec2 p, double floor, bool full, QuadScore *score)
{
  QuadScore now = {0, 0};
  Vec2 dir[2 * MAX_WINGS];
  double length[2 * MAX_WINGS];
  if (!spokes_from(s, p, dir, length)) {
    *score = (QuadScore){3, INFINITY};
    return full;
  }
  for (size_t i = 0; i < s->n; i++) {
    const Wing *w = &s->wing[i];
    double skew = w->skew_c;
    if (w->triangle) {
      skew = quad__triangle_skew(p, s->spoke[w->b].at, s->spoke[w->a].at);
    } else {
      double t = unit_skew(dir[w->b], dir[w->a]), u = unit_skew(w->bc, vec2_scale(-1, dir[w->b]));
      double v = unit_skew(vec2_scale(-1, dir[w->a]), w->ac);
      t = t > u ? t : u;
      t = t > v ? t : v;
      skew = skew > t ? skew : t;
    }
    now.worst = skew > now.worst ? skew : now.worst;
    now.energy += quad__skew_energy(skew);
    if (!full && (s->best.worst > floor ? now.worst > s->best.worst : now.worst > floor || now.energy >= s->best.energy)) return false;
  }
  double h = s->size ? quad__size_at(s->size, p) : 0;
  for (size_t i = 0; i < s->nspoke && s->size; i++) {
    double g = 0.5 * (h + s->spoke[i].h);
    now.energy += s->weight * s->spoke[i].times * length_energy(length[i] * length[i], g * g);
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

static uint32_t spoke_to(Star *s, const Vec2 *xy, const QuadSize *size, uint32_t v, uint32_t *known)
{
  uint32_t i = 0;
  while (i < s->nspoke && known[i] != v) i++;
  if (i == s->nspoke) {
    known[s->nspoke++] = v;
    s->spoke[i] = (Spoke){xy[v], s->size ? quad__size_at(&size[v], xy[v]) : 0, 0};
  }
  s->spoke[i].times++;
  return i;
}

static Vec2 direction(Vec2 from, Vec2 to)
{
  Vec2 d = vec2_sub(to, from);
  double l = vec2_length(d);
  return l > 0 ? vec2_scale(1 / l, d) : d;
}

static bool star_init(Star *s, const Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n)
{
  if (n > MAX_WINGS) return false;
  uint32_t known[2 * MAX_WINGS];
  s->n = s->nspoke = 0;
  s->at = xy[v];
  s->size = size && size[v].h > 0 ? &size[v] : NULL;
  s->weight = 0.5 * LENGTH_WEIGHT;
  for (size_t i = 0; i < n; i++) {
    const uint32_t *q = corner + 4 * i;
    uint32_t k = q[3] == NONE ? 3 : 4, j = 0;
    while (j < k && q[j] != v) j++;
    if (j == k) continue;
    uint32_t b = q[(j + 1) % k], a = q[(j + k - 1) % k], c = q[(j + 2) % k];
    Wing *w = &s->wing[s->n++];
    *w = (Wing){.a = spoke_to(s, xy, size, a, known), .b = spoke_to(s, xy, size, b, known), .triangle = k == 3};
    w->bc = direction(xy[b], xy[c]);
    w->ac = direction(xy[a], k == 3 ? xy[b] : xy[c]);
    w->skew_c = k == 4 ? quad__corner_skew(vec2_sub(xy[a], xy[c]), vec2_sub(xy[b], xy[c])) : 0;
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

// The cosine of the corner between the direction `to` p, at distance l, and the fixed direction f, less `wanted`, where p moves.
static inline void add_side_corner(Normal *q, Vec2 to, double l, Vec2 f, double wanted)
{
  double cosine = vec2_dot(to, f);
  add_residual(q, 1, cosine - wanted, vec2_scale(1 / l, vec2_sub(f, vec2_scale(cosine, to))));
}

// One step of Gauss and Newton for the cosines of all corners and the lengths of the edges at the vertex.
static bool newton_step(const Star *s, Vec2 *step)
{
  Normal q = {0};
  Vec2 dir[2 * MAX_WINGS];
  double length[2 * MAX_WINGS];
  if (!spokes_from(s, s->at, dir, length)) return false;
  for (size_t i = 0; i < s->n; i++) {
    const Wing *w = &s->wing[i];
    double wanted = w->triangle ? 0.5 : 0, la = length[w->a], lb = length[w->b];
    Vec2 a = dir[w->a], b = dir[w->b];
    double cosine = vec2_dot(a, b);
    Vec2 g = vec2_add(vec2_scale(1 / lb, vec2_sub(vec2_scale(cosine, b), a)), vec2_scale(1 / la, vec2_sub(vec2_scale(cosine, a), b)));
    add_residual(&q, 1, cosine - wanted, g);
    add_side_corner(&q, vec2_scale(-1, b), lb, w->bc, wanted);
    add_side_corner(&q, vec2_scale(-1, a), la, w->ac, wanted);
  }
  double h = s->size ? quad__size_at(s->size, s->at) : 0;
  for (size_t i = 0; i < s->nspoke && s->size; i++) { // sinh of log(l/h)
    double g = 0.5 * (h + s->spoke[i].h), r = length[i] / g;
    Vec2 slope = vec2_add(vec2_scale(1 / g, dir[i]), vec2_scale(0.5 * r / g, s->size->slope));
    add_residual(&q, s->weight * s->spoke[i].times, 0.5 * (r - 1 / r), vec2_scale(-0.5 * (1 + 1 / (r * r)), slope));
  }
  double d = q.xx * q.yy - q.xy * q.xy;
  if (!(d > 1e-12 * (q.xx + q.yy) * (q.xx + q.yy))) return false;
  *step = (Vec2){-(q.yy * q.x - q.xy * q.y) / d, -(q.xx * q.y - q.xy * q.x) / d};
  return isfinite(step->x) && isfinite(step->y);
}

static Vec2 neighbour_mean(const Star *s)
{
  Vec2 sum = {0, 0};
  for (size_t i = 0; i < s->nspoke; i++) sum = vec2_add(sum, vec2_scale(s->spoke[i].times, s->spoke[i].at));
  return vec2_scale(0.5 / (double)s->n, sum);
}

static double reach(const Star *s)
{
  double most = 0;
  for (size_t i = 0; i < s->nspoke; i++) most = fmax(most, vec2_length(vec2_sub(s->spoke[i].at, s->at)));
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
  bool again = moved && steps == 1; // the next call goes on from here
  if ((s.best.worst > floor && !again) || steps > QUICK_STEPS) moved |= search(&s, steps, floor);
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
