// quad_shape.c - how good elements are: skew, shape and score
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "geom/predicates.h"
#include "quad/lanes.h"
#include "quad/quad_int.h"

#include <float.h>

static const double PI = 3.14159265358979323846;

// Of the corner between u and w of a triangle: sin^2 of 3/2 times how far it is from 60 degrees, as cos 3x = 4 cos^3 x - 3 cos x.
static double sixty_skew(Vec2 u, Vec2 w)
{
  double size = vec2_dot(u, u) * vec2_dot(w, w);
  if (size <= 0) return 3;
  double c = vec2_dot(u, w) / sqrt(size), s = 0.5 * (1 + c * (4 * c * c - 3));
  if (vec2_cross(u, w) <= 0) return c >= 0.5 ? 2 - s : 2;
  return c >= -0.5 ? s : 2 - s;
}

double quad__triangle_skew(Vec2 a, Vec2 b, Vec2 c)
{
  Vec2 u = vec2_sub(b, a), v = vec2_sub(c, b), w = vec2_sub(a, c);
  return fmax(sixty_skew(u, vec2_scale(-1, w)), fmax(sixty_skew(v, vec2_scale(-1, u)), sixty_skew(w, vec2_scale(-1, v))));
}

static inline double length_energy(double l2, double h2)
{
  // sinh^2 of log(l/h): too long and too short by the same ratio cost the same.
  return 0.25 * (l2 / h2 + h2 / l2 - 2);
}

static QuadScore triangle_score(const Vec2 *xy, const QuadSize *size, const uint32_t *c)
{
  double skew = quad__triangle_skew(xy[c[0]], xy[c[1]], xy[c[2]]);
  QuadScore s = {skew, quad__skew_energy(skew)};
  for (uint32_t j = 0; size && j < 3; j++) {
    uint32_t a = c[j], b = c[(j + 1) % 3];
    double h = 0.5 * (quad__size_at(&size[a], xy[a]) + quad__size_at(&size[b], xy[b]));
    Vec2 e = vec2_sub(xy[b], xy[a]);
    if (h > 0) s.energy += 0.5 * QUAD_LENGTH_WEIGHT * length_energy(vec2_dot(e, e), h * h);
  }
  return s;
}

// The corners between the sides u and w, both by 1/length^2.
static inline Lanes corner_skews(Lanes ux, Lanes uy, Lanes wx, Lanes wy, Lanes iu, Lanes iw)
{
  Lanes dot = ux * wx + uy * wy, c2 = dot * dot * (iu * iw);
  return lanes_pick(ux * wy - uy * wx > 0, c2, 2 - c2);
}

// Sides are taken two at a time: s from the corners 0 and 1, t from 2 and 3.
static QuadScore quad_score(const Vec2 *xy, const QuadSize *size, const uint32_t *c)
{
  const Vec2 p = xy[c[0]], q = xy[c[1]], r = xy[c[2]], o = xy[c[3]];
  Lanes x01 = {p.x, q.x}, x12 = {q.x, r.x}, x23 = {r.x, o.x}, x30 = {o.x, p.x};
  Lanes y01 = {p.y, q.y}, y12 = {q.y, r.y}, y23 = {r.y, o.y}, y30 = {o.y, p.y};
  Lanes sx = x12 - x01, sy = y12 - y01, tx = x30 - x23, ty = y30 - y23;
  Lanes ls = sx * sx + sy * sy, lt = tx * tx + ty * ty, both = ls * lt, inverse = 1 / both, is = lt * inverse, it = ls * inverse;
  if (!(both[0] > 0 && both[1] > 0)) return (QuadScore){3, INFINITY};
  Lanes mx = lanes_shift(sx, tx), my = lanes_shift(sy, ty), im = lanes_shift(is, it); // sides 1 and 2, then 3 and 0
  Lanes nx = lanes_shift(tx, sx), ny = lanes_shift(ty, sy), in = lanes_shift(it, is);
  Lanes most = lanes_max(corner_skews(sx, sy, mx, my, is, im), corner_skews(tx, ty, nx, ny, it, in));
  QuadScore score = {most[0] > most[1] ? most[0] : most[1], 0};
  score.energy = quad__skew_energy(score.worst);
  if (!size) return score;
  Lanes h01 = {quad__size_at(&size[c[0]], p), quad__size_at(&size[c[1]], q)};
  Lanes h23 = {quad__size_at(&size[c[2]], r), quad__size_at(&size[c[3]], o)};
  Lanes gs = 0.5 * (h01 + lanes_shift(h01, h23)), gt = 0.5 * (h23 + lanes_shift(h23, h01));
  gs *= gs, gt *= gt;
  Lanes e = lanes_pick(gs > 0, ls / gs + gs * is - 2, lanes_of(0)) + lanes_pick(gt > 0, lt / gt + gt * it - 2, lanes_of(0));
  score.energy += 0.5 * QUAD_LENGTH_WEIGHT * 0.25 * (e[0] + e[1]);
  return score;
}

QuadScore quad__score(const Vec2 *xy, const QuadSize *size, const uint32_t *corner, size_t n)
{
  QuadScore s = {0, 0};
  for (size_t i = 0; i < n; i++) {
    const uint32_t *c = corner + 4 * i;
    QuadScore one = c[3] == NONE ? triangle_score(xy, size, c) : quad_score(xy, size, c);
    s.worst = one.worst > s.worst ? one.worst : s.worst;
    s.energy += one.energy;
  }
  return s;
}

double quad__skew(const Vec2 *xy, const uint32_t *v)
{
  return v[3] == NONE ? quad__triangle_skew(xy[v[0]], xy[v[1]], xy[v[2]]) : quad_score(xy, NULL, v).worst;
}

double quad__skew_of_shape(double shape)
{
  double s = sin(PI / 2 * (1 - shape));
  return shape >= 0 ? s * s : fmin(2 - s * s, 2);
}

double quad__shape(const Vec2 *xy, const uint32_t *v)
{
  double skew = quad__skew(xy, v);
  return skew <= 1 ? 1 - 2 / PI * asin(sqrt(skew)) : skew <= 2 ? -(1 - 2 / PI * asin(sqrt(2 - skew))) : -1;
}

// Corners of quadrangles are held farther from flat than coordinates are rounded, or what comes after, such as halving, may fold them:
// 8 ulps of the largest coordinate times the longer side. That is more than the error of the area, since sides are at most 2 sqrt(2) times
// as long as coordinates are large.
static bool turns_left(Vec2 a, Vec2 b, Vec2 c)
{
  Vec2 u = vec2_sub(b, a), w = vec2_sub(c, b);
  double size = fmax(fmax(fmax(fabs(a.x), fabs(a.y)), fmax(fabs(b.x), fabs(b.y))), fmax(fabs(c.x), fabs(c.y)));
  double side = fmax(fabs(u.x) + fabs(u.y), fabs(w.x) + fabs(w.y));
  return vec2_cross(u, w) > 8 * DBL_EPSILON * size * side;
}

bool quad__convex(const Vec2 *xy, const uint32_t *v)
{
  if (v[3] == NONE) return orient2d(&xy[v[0]].x, &xy[v[1]].x, &xy[v[2]].x) > 0;
  for (int i = 0; i < 4; i++)
    if (!turns_left(xy[v[i]], xy[v[(i + 1) % 4]], xy[v[(i + 2) % 4]])) return false;
  return true;
}
