// face_cluster_say.c - messages on angles that a cluster of faces does not reach
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/face_cluster_int.h"

enum { LISTED = 10 };

// Name the curves that meet at vertex v inside a face at under 60 degrees: as many as `left` allows in the log, all as notes, which
// the JSON report lists. Returns how many there are.
static size_t say_acute(const FaceCluster *p, VertId v, size_t left)
{
  const Tri *t = &p->tri;
  EdgeId first = t->hint[v];
  while (!tri_is_segment(t, first)) first = tri_ccw(t, first); // an acute vertex has segments
  EdgeId e = first;
  size_t n = 0;
  do {
    EdgeId from = e;
    double angle = tri_wedge(t, &e);
    if (angle < REFINE_ACUTE) {
      Vec3 at = face_cluster__place(p, v);
      Diag *d = p->in->diag;
      const Curve *c = model_curve(p->in->model, p->graph.curve.data[t->seg[from]]);
      int other = p->graph.curve.data[t->seg[e]];
      double degrees = angle * (180 / M_PI);
      if (n++ < left)
        log_info(d, "  curves %d and %d meet at (%g, %g, %g) at %.4g degrees", c->tag, other, at.x, at.y, at.z, degrees);
      diag_note(d, c->loc, "curves %d and %d meet at (%g, %g, %g) at %.4g degrees: triangles there have angles below %g", c->tag,
                other, at.x, at.y, at.z, degrees, p->in->options->Mesh_MinimumAngle);
    }
  } while (e != first);
  return n;
}

void face_cluster_say_skinny(const FaceCluster *p)
{
  const TriSkinnyVec *skinny = &p->skinny;
  if (!skinny->len) return;
  Diag *d = p->in->diag;
  const double wanted = p->in->options->Mesh_MinimumAngle;
  uint8_t *seen = mem_zalloc(p->tri.nv);
  size_t places = 0, stuck = 0;
  TriId example = NONE;
  for (size_t i = 0; i < skinny->len; i++) {
    TriSkinny s = skinny->data[i];
    if (s.corner != NONE) seen[s.corner] = 1;
    else if (!stuck++) example = s.tri;
  }
  if (skinny->len > stuck)
    log_info(d, "%zu triangles have an angle below %g degrees, at input angles under 60 degrees", skinny->len - stuck, wanted);
  for (VertId v = 0; v < p->tri.nv; v++)
    if (seen[v]) places += say_acute(p, v, places < LISTED ? LISTED - places : 0);
  if (places > LISTED) log_info(d, "  and %zu more", places - LISTED);
  if (stuck) {
    Vec3 at = face_cluster__place(p, p->tri.vert[3 * (size_t)example]);
    diag_warning(d, p->frame->loc,
                 "%zu triangles have an angle below %g degrees where boundary edges may not be split any more, the first at (%g, %g, %g)",
                 stuck, wanted, at.x, at.y, at.z);
  }
  free(seen);
}
