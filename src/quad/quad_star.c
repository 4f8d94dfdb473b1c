// quad_star.c - the elements around one vertex: right angles and edges of the wanted length, and which way they are
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/quad_star.h"

// Of an element the worst corner counts, but all three that move with the vertex decide which way it goes: lengths count more there, too.
static const double LEAST_GAIN = 2e-5, STEP_LENGTH_WEIGHT = 3 * 0.2;

// ---- making one

// The corners b, c, a of an element that holds v. False if it does not.
static bool wing_of(const uint32_t *element, uint32_t v, uint32_t bca[3])
{
  uint32_t k = element[3] == NONE ? 3 : 4, j = 0;
  while (j < k && element[j] != v) j++;
  for (uint32_t i = 0; i < 3; i++) bca[i] = element[(j + 1 + i) % k];
  if (k == 3) bca[2] = bca[1];
  return j < k;
}

static Lanes inverse_length(Lanes x, Lanes y)
{
  Lanes l2 = x * x + y * y;
  return lanes_pick(l2 > 0, 1 / lanes_sqrt(l2), lanes_of(0));
}

static void wings_init(Wings *w, const Vec2 *xy, const QuadSize *size, const uint32_t *p, const uint32_t *q)
{
  const Vec2 b[2] = {xy[p[0]], xy[q[0]]}, c[2] = {xy[p[1]], xy[q[1]]}, a[2] = {xy[p[2]], xy[q[2]]};
  w->bx = (Lanes){b[0].x, b[1].x}, w->by = (Lanes){b[0].y, b[1].y};
  w->ax = (Lanes){a[0].x, a[1].x}, w->ay = (Lanes){a[0].y, a[1].y};
  Lanes cx = {c[0].x, c[1].x}, cy = {c[0].y, c[1].y};
  Lanes ux = cx - w->bx, uy = cy - w->by, vx = cx - w->ax, vy = cy - w->ay;
  Lanes us = inverse_length(ux, uy), vs = inverse_length(vx, vy);
  w->bcx = ux * us, w->bcy = uy * us, w->acx = vx * vs, w->acy = vy * vs;
  Lanes dot = w->bcx * w->acx + w->bcy * w->acy, c2 = dot * dot;
  w->opposite = lanes_pick(w->acx * w->bcy - w->acy * w->bcx > 0, c2, 2 - c2);
  w->h = size ? (Lanes){quad__size_at(&size[p[0]], b[0]), quad__size_at(&size[q[0]], b[1])} : lanes_of(0);
  w->wanted = lanes_of(0);
  w->live = lanes_of(1);
}

// Lane i of w is a triangle: its c was taken to be a.
static void make_triangle(Wings *w, int i)
{
  w->acx[i] = -w->bcx[i], w->acy[i] = -w->bcy[i];
  w->opposite[i] = 0;
  w->wanted[i] = 0.5;
}

bool star_init(Star *s, const Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n)
{
  uint32_t bca[3 * STAR_WINGS + 3];
  if (n > STAR_WINGS) return false;
  s->n = 0;
  s->triangle = 0;
  s->at = xy[v];
  s->size = size && size[v].h > 0 ? &size[v] : NULL;
  for (size_t i = 0; i < n; i++) {
    if (!wing_of(corner + 4 * i, v, bca + 3 * s->n)) continue;
    if (corner[4 * i + 3] == NONE) s->triangle |= (uint64_t)1 << s->n;
    s->n++;
  }
  for (size_t i = 0; i < s->n; i += 2) {
    const uint32_t *p = bca + 3 * i, *q = i + 1 < s->n ? p + 3 : p;
    wings_init(&s->wings[i / 2], xy, s->size ? size : NULL, p, q);
    if (p == q) s->wings[i / 2].live[1] = 0;
  }
  for (size_t i = 0; s->triangle >> i; i++)
    if (s->triangle >> i & 1) make_triangle(&s->wings[i / 2], (int)(i % 2));
  return s->n > 0;
}

// ---- what it is worth

// The worst of three corners: at p, b and a.
static inline Lanes skews(const Wings *w, Lanes dx, Lanes dy, Lanes ex, Lanes ey, Lanes ib, Lanes ia)
{
  Lanes dot = dx * ex + dy * ey, t = dot * dot * ib * ia;
  t = lanes_pick(dx * ey - dy * ex > 0, t, 2 - t);
  dot = dx * w->bcx + dy * w->bcy;
  Lanes u = dot * dot * ib;
  u = lanes_pick(dx * w->bcy - dy * w->bcx > 0, u, 2 - u);
  dot = ex * w->acx + ey * w->acy;
  Lanes v = dot * dot * ia;
  v = lanes_pick(ex * w->acy - ey * w->acx < 0, v, 2 - v);
  return lanes_max(lanes_max(t, u), lanes_max(v, w->opposite));
}

static Lanes with_triangles(const Star *s, size_t i, Vec2 p, Lanes skew)
{
  const Wings *w = &s->wings[i / 2];
  for (int k = 0; k < 2; k++)
    if (s->triangle >> (i + (size_t)k) & 1) skew[k] = quad__triangle_skew(p, (Vec2){w->bx[k], w->by[k]}, (Vec2){w->ax[k], w->ay[k]});
  return skew;
}

QuadScore star_score(const Star *s, Vec2 p)
{
  Lanes worst = lanes_of(0), energy = lanes_of(0), least = lanes_of(INFINITY);
  double h = s->size ? quad__size_at(s->size, p) : 0;
  for (size_t i = 0; i < s->n; i += 2) {
    const Wings *w = &s->wings[i / 2];
    Lanes dx = w->bx - p.x, dy = w->by - p.y, ex = w->ax - p.x, ey = w->ay - p.y;
    Lanes lb = dx * dx + dy * dy, la = ex * ex + ey * ey, inverse = 1 / (lb * la), ib = la * inverse, ia = lb * inverse;
    Lanes skew = skews(w, dx, dy, ex, ey, ib, ia);
    if (s->triangle >> i & 3) skew = with_triangles(s, i, p, skew);
    least = lanes_pick(lb * la < least, lb * la, least);
    worst = lanes_max(skew, worst);
    Lanes e = 4 / (M_PI * M_PI) * skew * (1 + skew * (1.0 / 3 + skew * (8.0 / 45 + skew * (4.0 / 35))));
    if (s->size) {
      Lanes g = 0.5 * (h + w->h), g2 = g * g;
      e += QUAD_LENGTH_WEIGHT * 0.25 * (lb / g2 + g2 * ib - 2);
    }
    energy += w->live * e;
  }
  if (!(fmin(least[0], least[1]) > 0)) return (QuadScore){3, INFINITY};
  return (QuadScore){worst[0] > worst[1] ? worst[0] : worst[1], energy[0] + energy[1]};
}

static bool better(QuadScore a, QuadScore b, double floor)
{
  if (b.worst > floor && a.worst < b.worst - LEAST_GAIN) return true;
  return (a.worst <= b.worst || a.worst <= floor) && a.energy < b.energy - LEAST_GAIN;
}

bool star_try(Star *s, Vec2 p, double floor)
{
  QuadScore now = star_score(s, p);
  if (!better(now, s->best, floor)) return false;
  s->best = now;
  s->at = p;
  return true;
}

// ---- where to go

// Sums of a least-squares problem in two unknowns.
typedef struct {
  Lanes xx, xy, yy, x, y;
} Normal;

static inline void add_residual(Normal *q, Lanes weight, Lanes r, Lanes gx, Lanes gy)
{
  Lanes wx = weight * gx, wy = weight * gy;
  q->xx += wx * gx, q->xy += wx * gy, q->yy += wy * gy;
  q->x += r * wx, q->y += r * wy;
}

// The cosine of the corner between the direction (tx, ty) to the vertex, at distance 1/il, and the fixed direction (fx, fy).
static inline void add_side_corner(Normal *q, const Wings *w, Lanes tx, Lanes ty, Lanes il, Lanes fx, Lanes fy)
{
  Lanes cosine = tx * fx + ty * fy;
  add_residual(q, w->live, cosine - w->wanted, il * (fx - cosine * tx), il * (fy - cosine * ty));
}

static inline void add_length(Normal *q, const Star *s, const Wings *w, Lanes ux, Lanes uy, Lanes ib, double h)
{
  Lanes ig = 1 / (0.5 * (h + w->h)), r = ig / ib, ir = 1 / r, f = -0.5 * (1 + ir * ir); // sinh of log(l/h)
  Lanes sx = ig * (ux + 0.5 * r * s->size->slope.x), sy = ig * (uy + 0.5 * r * s->size->slope.y);
  add_residual(q, STEP_LENGTH_WEIGHT * w->live, 0.5 * (r - ir), f * sx, f * sy);
}

bool star_newton(const Star *s, Vec2 *step)
{
  Normal q = {0};
  double h = s->size ? quad__size_at(s->size, s->at) : 0;
  for (size_t i = 0; i < s->n; i += 2) {
    const Wings *w = &s->wings[i / 2];
    Lanes ux = w->bx - s->at.x, uy = w->by - s->at.y, vx = w->ax - s->at.x, vy = w->ay - s->at.y;
    Lanes ib = 1 / lanes_sqrt(ux * ux + uy * uy), ia = 1 / lanes_sqrt(vx * vx + vy * vy);
    ux *= ib, uy *= ib, vx *= ia, vy *= ia;
    Lanes cosine = ux * vx + uy * vy;
    Lanes gx = ib * (cosine * ux - vx) + ia * (cosine * vx - ux), gy = ib * (cosine * uy - vy) + ia * (cosine * vy - uy);
    add_residual(&q, w->live, cosine - w->wanted, gx, gy);
    add_side_corner(&q, w, -ux, -uy, ib, w->bcx, w->bcy);
    add_side_corner(&q, w, -vx, -vy, ia, w->acx, w->acy);
    if (s->size) add_length(&q, s, w, ux, uy, ib, h);
  }
  double xx = q.xx[0] + q.xx[1], xy = q.xy[0] + q.xy[1], yy = q.yy[0] + q.yy[1], x = q.x[0] + q.x[1], y = q.y[0] + q.y[1];
  double d = xx * yy - xy * xy;
  if (!(d > 1e-12 * (xx + yy) * (xx + yy))) return false;
  *step = (Vec2){-(yy * x - xy * y) / d, -(xx * y - xy * x) / d};
  return isfinite(step->x) && isfinite(step->y);
}

Vec2 star_mean(const Star *s)
{
  Lanes x = lanes_of(0), y = lanes_of(0);
  for (size_t i = 0; i < s->n; i += 2) {
    const Wings *w = &s->wings[i / 2];
    x += w->live * (w->bx + w->ax), y += w->live * (w->by + w->ay);
  }
  return vec2_scale(0.5 / (double)s->n, (Vec2){x[0] + x[1], y[0] + y[1]});
}

double star_reach(const Star *s)
{
  double most = 0;
  for (size_t i = 0; i < s->n; i++) {
    const Wings *w = &s->wings[i / 2];
    size_t k = i % 2;
    Vec2 a = {w->ax[k] - s->at.x, w->ay[k] - s->at.y}, b = {w->bx[k] - s->at.x, w->by[k] - s->at.y};
    most = fmax(most, fmax(vec2_dot(a, a), vec2_dot(b, b)));
  }
  return sqrt(most);
}
