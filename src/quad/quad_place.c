// quad_place.c - a better place for one vertex: right angles and edges of the wanted length, never to the harm of the worst element
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/quad_star.h"

enum { QUICK_STEPS = 2, UNTANGLE_STEPS = 4, TRIES = 3 };
// Steps are too long on purpose: deformations that reach over many elements take fewer passes (successive over-relaxation).
static const double LONG_STEP = 1.4, FREE_STEP = 1.6, SHORTER = 0.5;
// A step of less than this, in squares of a diagonal of an element there, is not worth while.
static const double LEAST_STEP2 = 1e-5;

// Pattern search, for stars too bad for anything smoother.
static bool search(Star *s, int steps, double floor)
{
  static const double dir[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0.7, 0.7}, {-0.7, 0.7}, {-0.7, -0.7}, {0.7, -0.7}};
  double step = 0.2 * star_reach(s);
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
  if (!star_newton(s, &step)) return false;
  double length = LONG_STEP;
  for (int k = 0; k < TRIES; k++, length *= SHORTER)
    if (star_try(s, vec2_add(s->at, vec2_scale(length, step)), floor)) return true;
  return false;
}

static bool improve(Star *s, Vec2 *xy, uint32_t v, const uint32_t *corner, size_t n, int steps, double floor)
{
  s->best = star_score(s, s->at);
  bool moved = false;
  if (s->best.worst > floor) moved = star_try(s, star_mean(s), floor);
  for (int k = 0; k < steps && descend(s, floor); k++) moved = true;
  bool again = moved && steps == 1; // the next call goes on from here
  if ((s->best.worst > floor && !again) || steps > QUICK_STEPS) moved |= search(s, steps, floor);
  if (!moved) return false;
  Vec2 old = xy[v];
  xy[v] = s->at;
  for (size_t i = 0; i < n && s->best.worst > 1 - 1e-9; i++)
    if (!quad__convex(xy, corner + 4 * i)) {
      xy[v] = old;
      return false;
    }
  return true;
}

bool quad__improve(Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n, int steps, double floor)
{
  Star s;
  return star_init(&s, xy, size, v, corner, n) && improve(&s, xy, v, corner, n, steps, floor);
}

bool quad__relax(Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n, double floor)
{
  Star s;
  Vec2 step, edge = vec2_sub(xy[corner[2]], xy[corner[0]]);
  if (!star_init(&s, xy, size, v, corner, n)) return false;
  if (!star_newton(&s, &step) || vec2_dot(step, step) < LEAST_STEP2 * vec2_dot(edge, edge)) return false;
  Vec2 p = vec2_add(s.at, vec2_scale(FREE_STEP, step));
  if (floor > 1 - 1e-9 || star_score(&s, p).worst > floor) return improve(&s, xy, v, corner, n, 1, floor);
  xy[v] = p;
  return true;
}

bool quad__untangle(Vec2 *xy, const QuadSize *size, uint32_t v, const uint32_t *corner, size_t n)
{
  Star s;
  if (!star_init(&s, xy, size, v, corner, n)) return false;
  s.best = star_score(&s, s.at);
  bool moved = star_try(&s, star_mean(&s), 0);
  moved |= search(&s, UNTANGLE_STEPS, 0);
  xy[v] = s.at;
  return moved;
}
