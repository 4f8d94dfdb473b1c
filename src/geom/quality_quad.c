// quality_quad.c - shape measures of quadrilaterals
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "geom/quality_quad.h"

static const double PI = 3.14159265358979323846;

static double corner(Vec2 prev, Vec2 at, Vec2 next)
{
  Vec2 u = vec2_sub(next, at), v = vec2_sub(prev, at);
  double angle = atan2(vec2_cross(u, v), vec2_dot(u, v));
  return angle < 0 ? angle + 2 * PI : angle;
}

// Interior angles at a, b, c, d in radians, in [0, 2 pi): over pi where the corner is reentrant or the quad inverted.
// 0 where two neighbouring corners coincide.
static void angles_of(Vec2 a, Vec2 b, Vec2 c, Vec2 d, double angle[4])
{
  angle[0] = corner(d, a, b);
  angle[1] = corner(a, b, c);
  angle[2] = corner(b, c, d);
  angle[3] = corner(c, d, a);
}

double quad_eta_signed(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
  double angle[4], worst = 0;
  angles_of(a, b, c, d, angle);
  for (int i = 0; i < 4; i++) worst = fmax(worst, fabs(PI / 2 - angle[i]));
  return 1 - 2 / PI * worst;
}

double quad_scaled_jacobian(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
  Vec2 p[4] = {a, b, c, d};
  double least = 1;
  for (int i = 0; i < 4; i++) {
    Vec2 u = vec2_sub(p[(i + 1) % 4], p[i]), v = vec2_sub(p[(i + 3) % 4], p[i]);
    double len = vec2_length(u) * vec2_length(v);
    least = fmin(least, len > 0 ? vec2_cross(u, v) / len : -1);
  }
  return least;
}
