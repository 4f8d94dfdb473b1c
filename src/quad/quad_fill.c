// quad_fill.c - quads that no moving of vertices can help: five in the place of one
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "quad/quad_int.h"
#include "quad/quad_mesh.h"

// How many times better the worst quad of a ring must be than the one that it replaces.
static const double CLEARLY = 1.5;

// A quad inside the quad p[0 .. 3], its corner i on the way from a centre to p[i], and four more between the sides of both. All are
// convex if the inner one is, where the centre sees all corners: then even a corner of 180 degrees or more is cut in two.
typedef struct {
  Vec2 xy[8];           // p, then the inner corners
  uint32_t corner[4 * 5];
} Ring;

static void ring_init(Ring *r, const Vec2 *xy, const uint32_t *v)
{
  for (uint32_t i = 0; i < 4; i++) {
    uint32_t j = (i + 1) % 4, quad[4] = {i, j, 4 + j, 4 + i};
    r->xy[i] = xy[v[i]];
    for (uint32_t k = 0; k < 4; k++) r->corner[4 * i + k] = quad[k];
    r->corner[16 + i] = 4 + i;
  }
}

static void ring_place(Ring *r, Vec2 centre, uint32_t far, double share, double far_share)
{
  for (uint32_t i = 0; i < 4; i++)
    r->xy[4 + i] = vec2_add(centre, vec2_scale(i == far ? far_share : share, vec2_sub(r->xy[i], centre)));
}

static bool ring_valid(const Ring *r)
{
  for (int i = 0; i < 5; i++)
    if (!quad__convex(r->xy, r->corner + 4 * i)) return false;
  return true;
}

// The best of the places on a small grid of shares and centres, then improved. False if none is valid.
static bool ring_search(Ring *r)
{
  Ring best = *r;
  double worst = 1;
  Vec2 mean = vec2_scale(0.25, vec2_add(vec2_add(r->xy[0], r->xy[1]), vec2_add(r->xy[2], r->xy[3])));
  for (uint32_t far = 0; far < 4; far++)
    for (int c = 0; c < 4; c++) {
      Vec2 along = vec2_sub(r->xy[(far + 2) % 4], r->xy[far]);
      Vec2 centre = c == 0 ? mean : vec2_add(r->xy[far], vec2_scale(0.2 + 0.1 * c, along));
      for (int s = 3; s <= 6; s++)
        for (int f = s; f <= 9; f++) {
          ring_place(r, centre, far, 0.1 * s, 0.1 * f);
          double now = quad__score(r->xy, NULL, r->corner, 5).worst;
          if (now >= worst || !ring_valid(r)) continue;
          best = *r;
          worst = now;
        }
    }
  *r = best;
  for (int sweep = 0; worst < 1 && sweep < 8; sweep++)
    for (uint32_t i = 0; i < 4; i++) {
      uint32_t star[4 * 3];
      for (uint32_t k = 0; k < 4; k++) {
        star[k] = r->corner[4 * i + k];
        star[4 + k] = r->corner[4 * ((i + 3) % 4) + k];
        star[8 + k] = r->corner[16 + k];
      }
      quad__improve(r->xy, NULL, 4 + i, star, 3, 3, quad__skew_of_shape(QUAD_GOOD_SHAPE));
    }
  return worst < 1 && ring_valid(r);
}

size_t quad_fill_bad(QuadMesh *m, double min_eta, double better)
{
  size_t ne = quad_mesh_elements(m), filled = 0;
  for (size_t e = 0; e < ne; e++) {
    uint32_t v[8];
    for (size_t i = 0; i < 4; i++) v[i] = m->vertex.data[4 * e + i];
    if (v[3] == NONE || (quad__convex(m->xy.data, v) && quad__eta(m, v) >= min_eta)) continue;
    Ring r;
    ring_init(&r, m->xy.data, v);
    double least = fmax(better, CLEARLY * quad__eta(m, v));
    if (!ring_search(&r) || quad__score(r.xy, NULL, r.corner, 5).worst > quad__skew_of_shape(least)) continue;
    for (uint32_t i = 4; i < 8; i++) v[i] = quad__add_vertex(m, r.xy[i], v, 4);
    for (size_t i = 0; i < 16; i++) vec_push(&m->vertex, v[r.corner[i]]);
    for (size_t i = 0; i < 4; i++) m->vertex.data[4 * e + i] = v[4 + i];
    filled++;
  }
  return filled;
}
