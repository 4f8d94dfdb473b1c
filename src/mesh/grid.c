// grid.c - structured meshes on plain arrays: transfinite interpolation, cell patterns, elliptic smoothing
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/grid.h"

static void normalize(double *w, size_t n)
{
  double total = w[n];
  for (size_t k = 0; k <= n; k++) w[k] = total > 0 ? w[k] / total : (double)k / (double)n;
  w[n] = 1;
}

void grid_lengths(const Vec3 *p, size_t n, double *w)
{
  w[0] = 0;
  for (size_t k = 0; k < n; k++) w[k + 1] = w[k] + vec3_distance(p[k], p[k + 1]);
  normalize(w, n);
}

void grid_mean_lengths(const Vec3 *p, const Vec3 *q, size_t n, double *w)
{
  w[0] = 0;
  for (size_t k = 0; k < n; k++)
    w[k + 1] = w[k] + 0.5 * (vec3_distance(p[k], p[k + 1]) + vec3_distance(q[k], q[k + 1]));
  normalize(w, n);
}

// One coordinate of the blend; `corner` holds s1, s2, s3, s4.
static double blend(double b, double r, double t, double l, const double corner[4], double u, double v)
{
  return (1 - u) * l + u * r + (1 - v) * b + v * t -
         ((1 - u) * (1 - v) * corner[0] + u * (1 - v) * corner[1] + u * v * corner[2] + (1 - u) * v * corner[3]);
}

void grid_coons(const GridSides *s, const double *u, const double *v, Vec3 *node)
{
  size_t nu = s->nu, nv = s->nv;
  Vec3 c[4] = {s->bottom[0], s->bottom[nu], s->top[nu], s->top[0]};
  double cx[4], cy[4], cz[4];
  for (int k = 0; k < 4; k++) {
    cx[k] = c[k].x;
    cy[k] = c[k].y;
    cz[k] = c[k].z;
  }
  for (size_t i = 0; i <= nu; i++) {
    Vec3 b = s->bottom[i], t = s->top[i], *row = node + i * (nv + 1);
    for (size_t j = 0; j <= nv; j++) {
      Vec3 r = s->right[j], l = s->left ? s->left[j] : s->bottom[0];
      if (i == 0)
        row[j] = l;
      else if (i == nu)
        row[j] = r;
      else if (j == 0)
        row[j] = b;
      else if (j == nv)
        row[j] = t;
      else
        row[j] = (Vec3){blend(b.x, r.x, t.x, l.x, cx, u[i], v[j]), blend(b.y, r.y, t.y, l.y, cy, u[i], v[j]),
                        blend(b.z, r.z, t.z, l.z, cz, u[i], v[j])};
    }
  }
}

// Each corner sends the two sides that meet there, run parallel to themselves, weighted by the barycentric coordinate.
void grid_triangle(size_t n, const Vec3 *s12, const Vec3 *s23, const Vec3 *s13, Vec3 *node)
{
  Vec3 v1 = s12[0], v2 = s12[n], v3 = s13[n];
  for (size_t i = 0; i <= n; i++) {
    for (size_t j = 0; j <= i; j++) {
      size_t a = n - i, b = i - j, c = j; // barycentric coordinates times n of s1, s2, s3
      Vec3 p = vec3_scale((double)a, vec3_sub(vec3_add(s12[b], s13[c]), v1));
      p = vec3_add(p, vec3_scale((double)b, vec3_sub(vec3_add(s23[c], s12[n - a]), v2)));
      p = vec3_add(p, vec3_scale((double)c, vec3_sub(vec3_add(s13[n - a], s23[n - b]), v3)));
      p = vec3_scale(1 / (double)n, p);
      if (c == 0) p = s12[i];
      if (b == 0) p = s13[i];
      if (a == 0) p = s23[j];
      node[i * (n + 1) + j] = p;
    }
  }
}

// alpha x_uu - 2 beta x_uv + gamma x_vv = 0 with alpha = |x_v|^2, beta = x_u . x_v, gamma = |x_u|^2, by central differences.
static Vec3 winslow(const Vec3 *p, size_t row)
{
  Vec3 du = vec3_scale(0.5, vec3_sub(p[row], *(p - row))), dv = vec3_scale(0.5, vec3_sub(p[1], p[-1]));
  double alpha = vec3_dot(dv, dv), beta = vec3_dot(du, dv), gamma = vec3_dot(du, du);
  if (!(alpha + gamma > 0)) return *p;
  Vec3 cross = vec3_sub(vec3_sub(p[row + 1], *(p - row + 1)), vec3_sub(p[row - 1], *(p - row - 1)));
  Vec3 sum = vec3_add(vec3_scale(alpha, vec3_add(p[row], *(p - row))), vec3_scale(gamma, vec3_add(p[1], p[-1])));
  return vec3_scale(0.5 / (alpha + gamma), vec3_sub(sum, vec3_scale(0.5 * beta, cross)));
}

void grid_smooth(size_t nu, size_t nv, Vec3 *node, int passes)
{
  for (int pass = 0; pass < passes; pass++)
    for (size_t i = 1; i < nu; i++)
      for (size_t j = 1; j < nv; j++) {
        Vec3 *p = node + i * (nv + 1) + j;
        *p = winslow(p, nv + 1);
      }
}

static uint32_t *put3(uint32_t *t, bool mirror, uint32_t a, uint32_t b, uint32_t c)
{
  t[0] = a;
  t[1] = mirror ? c : b;
  t[2] = mirror ? b : c;
  return t + 3;
}

// Is the diagonal of cell (i, j) the one from its first to its third corner?
static bool first_to_third(TransfiniteArrangement how, size_t i, size_t j)
{
  switch (how) {
  case ARRANGE_LEFT: return false;
  case ARRANGE_RIGHT: return true;
  case ARRANGE_ALTERNATE_RIGHT: return (i + j) % 2 == 1;
  case ARRANGE_ALTERNATE_LEFT: return (i + j) % 2 == 0;
  }
  UNREACHABLE();
}

// The triangles of the cells of i = 0, if they are a fan.
static uint32_t *put_fan(const GridCells *g, uint32_t *t)
{
  const uint32_t *id = g->id + g->nv + 1;
  for (size_t j = 0; g->fan && j < g->nv; j++) t = put3(t, g->mirror, g->id[0], id[j], id[j + 1]);
  return t;
}

size_t grid_triangles(const GridCells *g, uint32_t *tri)
{
  size_t nv = g->nv;
  bool mirror = g->mirror;
  uint32_t *t = put_fan(g, tri);
  for (size_t i = g->fan; i < g->nu; i++) {
    for (size_t j = 0; j < nv; j++) {
      const uint32_t *a = g->id + i * (nv + 1) + j, *b = a + nv + 1;
      if (first_to_third(g->how, i, j)) {
        t = put3(t, mirror, a[0], b[0], b[1]);
        t = put3(t, mirror, b[1], a[1], a[0]);
      } else {
        t = put3(t, mirror, a[0], b[0], a[1]);
        t = put3(t, mirror, a[1], b[0], b[1]);
      }
    }
  }
  return (size_t)(t - tri) / 3;
}

size_t grid_quads(const GridCells *g, uint32_t *tri, size_t *ntri, uint32_t *quad)
{
  size_t nv = g->nv;
  bool mirror = g->mirror;
  uint32_t *q = quad;
  *ntri = (size_t)(put_fan(g, tri) - tri) / 3;
  for (size_t i = g->fan; i < g->nu; i++) {
    for (size_t j = 0; j < nv; j++, q += 4) {
      const uint32_t *a = g->id + i * (nv + 1) + j, *b = a + nv + 1;
      q[0] = a[0];
      q[1] = mirror ? a[1] : b[0];
      q[2] = b[1];
      q[3] = mirror ? b[0] : a[1];
    }
  }
  return (size_t)(q - quad) / 4;
}

size_t grid_triangle_cells(size_t n, const uint32_t *id, bool mirror, uint32_t *tri)
{
  uint32_t *t = tri;
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j <= i; j++) {
      const uint32_t *a = id + i * (n + 1) + j, *b = a + n + 1;
      t = put3(t, mirror, a[0], b[0], b[1]);
      if (j < i) t = put3(t, mirror, a[0], b[1], a[1]);
    }
  }
  return (size_t)(t - tri) / 3;
}
