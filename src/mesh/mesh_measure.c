// mesh_measure.c - shape, size and place of single elements
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_measure.h"

#include "geom/quality.h"

static const double pi = 3.14159265358979323846;

int mesh_corners(const Mesh *m, const MeshBlock *k, size_t i, Vec3 p[4])
{
  int n = elem_corners(k->type);
  const uint32_t *v = k->node + i * (size_t)elem_nodes(k->type);
  for (int c = 0; c < n; c++) p[c] = mesh_xyz(m, v[c]);
  return n;
}

Vec3 mesh_center(const Mesh *m, const MeshBlock *k, size_t i)
{
  Vec3 p[4], s = {0, 0, 0};
  int n = mesh_corners(m, k, i, p);
  for (int c = 0; c < n; c++) s = vec3_add(s, p[c]);
  return vec3_scale(1. / n, s);
}

// Area vector of a polygon of three or four corners.
static Vec3 area_vector(const Vec3 *p, int n)
{
  Vec3 a = n == 3 ? vec3_sub(p[1], p[0]) : vec3_sub(p[2], p[0]);
  Vec3 b = n == 3 ? vec3_sub(p[2], p[0]) : vec3_sub(p[3], p[1]);
  return vec3_scale(0.5, vec3_cross(a, b));
}

double mesh_size_of(const Mesh *m, const MeshBlock *k, size_t i, Vec3 normal)
{
  Vec3 p[4];
  int n = mesh_corners(m, k, i, p);
  if (n == 1) return 0;
  if (n == 2) return vec3_distance(p[0], p[1]);
  Vec3 a = area_vector(p, n);
  double size = vec3_length(a);
  return vec3_dot(a, normal) < 0 ? -size : size;
}

// Sine and cosine, both times the same, of the angles at the corners of a quadrangle, against its own mean normal.
static void quad_corners(const Vec3 *p, double sine[4], double cosine[4])
{
  Vec3 n = area_vector(p, 4);
  for (int c = 0; c < 4; c++) {
    Vec3 a = vec3_sub(p[(c + 1) % 4], p[c]), b = vec3_sub(p[(c + 3) % 4], p[c]), x = vec3_cross(a, b);
    sine[c] = vec3_dot(x, n) < 0 ? -vec3_length(x) : vec3_length(x);
    cosine[c] = vec3_dot(a, b);
  }
}

// Degrees, in [0, 360).
static double angle_of(double sine, double cosine)
{
  double a = atan2(sine, cosine);
  return (a < 0 ? a + 2 * pi : a) * (180 / pi);
}

// Grows with the angle, from 0 to 4, and costs less.
static double turn_of(double sine, double cosine)
{
  double t = fabs(sine) / (fabs(sine) + fabs(cosine));
  if (sine >= 0) return cosine >= 0 ? t : 2 - t;
  return cosine < 0 ? 2 + t : 4 - t;
}

static void quad_angle_range(const Vec3 *p, double *least, double *largest)
{
  double sine[4], cosine[4], low = INFINITY, high = -INFINITY;
  int first = 0, last = 0;
  quad_corners(p, sine, cosine);
  for (int c = 0; c < 4; c++) {
    double t = turn_of(sine[c], cosine[c]);
    if (t < low) low = t, first = c;
    if (t > high) high = t, last = c;
  }
  *least = angle_of(sine[first], cosine[first]);
  *largest = angle_of(sine[last], cosine[last]);
}

double mesh_scaled_jacobian(const Mesh *m, const MeshBlock *k, size_t i)
{
  Vec3 p[4], e[4];
  double length[4], least = 1;
  mesh_corners(m, k, i, p);
  for (int c = 0; c < 4; c++) {
    e[c] = vec3_sub(p[(c + 1) % 4], p[c]);
    length[c] = vec3_length(e[c]);
  }
  Vec3 n = area_vector(p, 4);
  double size = vec3_length(n);
  if (!(size > 0)) return -1;
  for (int c = 0; c < 4; c++) {
    double scale = size * length[c] * length[(c + 3) % 4];
    if (!(scale > 0)) return -1;
    least = fmin(least, vec3_dot(vec3_cross(e[(c + 3) % 4], e[c]), n) / scale);
  }
  return least;
}

void mesh_angle_range(const Mesh *m, const MeshBlock *k, size_t i, double *least, double *largest)
{
  Vec3 p[4];
  double angle[3];
  if (mesh_corners(m, k, i, p) == 4) {
    quad_angle_range(p, least, largest);
    return;
  }
  quality_angles(shape_space(p[0], p[1], p[2], (Vec3){0, 0, 0}), angle);
  *least = fmin(angle[0], fmin(angle[1], angle[2]));
  *largest = fmax(angle[0], fmax(angle[1], angle[2]));
}

static const char *const measure_names[MEASURES] = {"gamma",  "angle",  "eta",    "jacobian", "kappa1",
                                                    "kappa2", "kappa3", "kappa4", "kappa5"};

const char *mesh_measure_name(Measure what) { return measure_names[what]; }

Measure mesh_measure_find(const char *name)
{
  int i = 0;
  while (i < MEASURES && strcmp(measure_names[i], name) != 0) i++;
  return (Measure)i;
}

static double measure_of_shape(TriShape t, Measure what)
{
  switch (what) {
  case MEASURE_JACOBIAN:
  case MEASURE_KAPPA1: return quality_kappa1(t);
  case MEASURE_KAPPA2: return quality_kappa2(t);
  case MEASURE_KAPPA4: return quality_kappa4(t);
  case MEASURE_KAPPA5: return quality_kappa5(t);
  case MEASURE_GAMMA:
  case MEASURE_KAPPA3:
  case MEASURE_ANGLE:
  case MEASURE_ETA:
  case MEASURES: break;
  }
  return quality_gamma(t);
}

double mesh_measure(const Mesh *m, const MeshBlock *k, size_t i, Measure what)
{
  Vec3 p[4];
  int n = elem_corners(k->type);
  if (n == 3 && what != MEASURE_ANGLE && what != MEASURE_ETA) {
    mesh_corners(m, k, i, p);
    return measure_of_shape(shape_space(p[0], p[1], p[2], (Vec3){0, 0, 0}), what);
  }
  if (n == 4 && what == MEASURE_JACOBIAN) return mesh_scaled_jacobian(m, k, i);
  double least, largest, ideal = n == 3 ? 60 : 90;
  mesh_angle_range(m, k, i, &least, &largest);
  if (what == MEASURE_ANGLE) return least;
  return fmax(0, 1 - fmax(largest - ideal, ideal - least) / ideal);
}

Vec3 mesh_area_vector(const Mesh *m, uint32_t entity)
{
  Vec3 sum = {0, 0, 0}, p[4];
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (elem_dim(k->type) != 2 || (entity != NONE && k->entity != entity)) continue;
    size_t nodes = (size_t)elem_nodes(k->type);
    int n = elem_corners(k->type);
    const uint32_t *v = k->node;
    for (size_t i = 0; i < k->n; i++, v += nodes) {
      for (int c = 0; c < n; c++) p[c] = mesh_xyz(m, v[c]);
      sum = vec3_add(sum, area_vector(p, n));
    }
  }
  return sum;
}
