// vec.h - points and vectors of the plane and of space, and axis-aligned boxes
// SPDX-License-Identifier: MIT
#ifndef GEOM_VEC_H
#define GEOM_VEC_H

#include "base/base.h"

#include <math.h>

typedef struct {
  double x, y;
} Vec2;

typedef struct {
  double x, y, z;
} Vec3;

static inline Vec2 vec2_add(Vec2 a, Vec2 b) { return (Vec2){a.x + b.x, a.y + b.y}; }
static inline Vec2 vec2_sub(Vec2 a, Vec2 b) { return (Vec2){a.x - b.x, a.y - b.y}; }
static inline Vec2 vec2_scale(double f, Vec2 a) { return (Vec2){f * a.x, f * a.y}; }
static inline double vec2_dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
static inline double vec2_cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
static inline double vec2_length(Vec2 a) { return sqrt(a.x * a.x + a.y * a.y); }

static inline Vec3 vec3_add(Vec3 a, Vec3 b) { return (Vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline Vec3 vec3_sub(Vec3 a, Vec3 b) { return (Vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline Vec3 vec3_scale(double f, Vec3 a) { return (Vec3){f * a.x, f * a.y, f * a.z}; }
static inline double vec3_dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Vec3 vec3_cross(Vec3 a, Vec3 b)
{
  return (Vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline double vec3_length(Vec3 a) { return sqrt(vec3_dot(a, a)); }
static inline double vec3_distance(Vec3 a, Vec3 b) { return vec3_length(vec3_sub(a, b)); }

// Axis-aligned box; empty when lo.x > hi.x, as box3_empty() gives it.
typedef struct {
  Vec3 lo, hi;
} Box3;

static inline Box3 box3_empty(void)
{
  return (Box3){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}
static inline Box3 box3_with(Box3 b, Vec3 p)
{
  return (Box3){{p.x < b.lo.x ? p.x : b.lo.x, p.y < b.lo.y ? p.y : b.lo.y, p.z < b.lo.z ? p.z : b.lo.z},
                {p.x > b.hi.x ? p.x : b.hi.x, p.y > b.hi.y ? p.y : b.hi.y, p.z > b.hi.z ? p.z : b.hi.z}};
}

#endif
