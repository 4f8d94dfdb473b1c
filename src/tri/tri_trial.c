// tri_trial.c - a change about one edge that can be undone
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/tri_trial.h"

// ---- saving and restoring ------------------------------------------------------------------------------------------

static bool save_triangle(Trial *s, TriId t)
{
  const Tri *m = s->r->m;
  for (int i = 0; i < s->ntri; i++)
    if (s->tri[i].t == t) return true;
  if (s->ntri == (int)ARRAY_LEN(s->tri)) return false;
  SavedTriangle *x = &s->tri[s->ntri++];
  x->t = t, x->flag = m->flag[t], x->region = m->region ? m->region[t] : 0;
  for (int i = 0; i < 3; i++)
    x->vert[i] = m->vert[3 * t + (uint32_t)i], x->twin[i] = m->twin[3 * t + (uint32_t)i], x->seg[i] = m->seg[3 * t + (uint32_t)i];
  return true;
}

static bool save_vertex(Trial *s, VertId v)
{
  const Refiner *r = s->r;
  if (v == TRI_INF) return true;
  for (int i = 0; i < s->nvert; i++)
    if (s->vertex[i].v == v) return true;
  if (s->nvert == (int)ARRAY_LEN(s->vertex)) return false;
  s->vertex[s->nvert++] = (SavedVertex){v, {tri_xy(r->m, v)[0], tri_xy(r->m, v)[1]}, r->size[v], r->carried ? r->carried[v] : 0,
                                        r->m->hint[v], r->excess[v], r->fixed[v]};
  return true;
}

bool refine__trial_save(Trial *s, Refiner *r, EdgeId e)
{
  Tri *m = r->m;
  s->r = r, s->npatch = s->ntri = s->nvert = 0, s->ncore = 4;
  s->core[0] = tri_org(m, e), s->core[1] = tri_dest(m, e), s->core[2] = tri_apex(m, e), s->core[3] = tri_apex(m, m->twin[e]);
  for (int k = 0; k < 4; k++) {
    EdgeId first = m->hint[s->core[k]], f = first;
    do {
      if (tri_is_inside(m, tri_of(f)) && (s->ntri >= TRIAL_PATCH || !save_triangle(s, tri_of(f)))) return false;
      f = tri_ccw(m, f);
    } while (f != first);
  }
  s->npatch = s->ntri;
  for (int i = 0; i < s->npatch; i++)
    for (EdgeId f = 3 * s->tri[i].t; f < 3 * s->tri[i].t + 3; f++)
      if (!save_vertex(s, m->vert[f]) || !save_triangle(s, tri_of(m->twin[f]))) return false;
  TriId next = m->free_list;
  for (uint32_t k = 0; k < 2 && k < m->nfree; k++, next = m->twin[3 * (size_t)next])
    if (!save_triangle(s, next)) return false;
  s->nt = m->nt, s->nv = m->nv, s->nfree = m->nfree, s->free_list = m->free_list, s->last = m->last, s->stats = *r->stats;
  return true;
}

void refine__trial_restore(Trial *s)
{
  Refiner *r = s->r;
  Tri *m = r->m;
  for (int i = 0; i < s->ntri; i++) {
    const SavedTriangle *x = &s->tri[i];
    m->flag[x->t] = x->flag;
    if (m->region) m->region[x->t] = x->region;
    for (uint32_t k = 0; k < 3; k++)
      m->vert[3 * x->t + k] = x->vert[k], m->twin[3 * x->t + k] = x->twin[k], m->seg[3 * x->t + k] = x->seg[k];
  }
  for (int i = 0; i < s->nvert; i++) {
    const SavedVertex *x = &s->vertex[i];
    m->xy[2 * (size_t)x->v] = x->xy[0], m->xy[2 * (size_t)x->v + 1] = x->xy[1];
    r->size[x->v] = x->size, m->hint[x->v] = x->hint, r->excess[x->v] = x->excess, r->fixed[x->v] = x->fixed;
    if (r->carried) r->carried[x->v] = x->carried;
  }
  m->nt = s->nt, m->nv = s->nv, m->nfree = s->nfree, m->free_list = s->free_list, m->last = s->last, *r->stats = s->stats;
  s->ncore = 4;
}

int refine__trial_patch(const Trial *s, TriId *out)
{
  const Tri *m = s->r->m;
  int n = 0;
  for (int i = 0; i < s->ntri; i++) {
    bool was_free = s->tri[i].flag & TRI_FREE;
    if ((i < s->npatch || was_free) && tri_is_inside(m, s->tri[i].t)) out[n++] = s->tri[i].t;
  }
  for (TriId t = s->nt; t < m->nt; t++)
    if (tri_is_inside(m, t)) out[n++] = t;
  return n;
}

// ---- operations ----------------------------------------------------------------------------------------------------

static bool split(Trial *s, EdgeId e)
{
  Refiner *r = s->r;
  Tri *m = r->m;
  const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
  double p[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}, carried;
  if (m->nv >= r->max_vertices) return false;
  double h = refine__size_at(r, p, tri_of(e), &carried);
  VertId v = tri_split_edge(m, p, e);
  if (v == NONE) return false;
  refine__added_vertex(r, v, h, carried);
  r->stats->inserted++;
  s->core[s->ncore++] = v;
  return true;
}

static bool collapse(Trial *s, EdgeId e)
{
  Refiner *r = s->r;
  Tri *m = r->m;
  VertId a = tri_org(m, e);
  if (r->fixed[a] || !tri_can_collapse(m, e)) return false;
  tri_collapse(m, e);
  r->fixed[a] = true; // isolated now
  r->stats->collapses++;
  return true;
}

bool refine__trial_apply(Trial *s, EdgeId e, TrialOperation op)
{
  switch (op) {
  case TRIAL_SETTLE: return true;
  case TRIAL_FLIP:
    if (!tri_can_flip(s->r->m, e)) return false;
    refine__flip(s->r, e);
    s->r->stats->flips++;
    return true;
  case TRIAL_COLLAPSE: return collapse(s, e);
  case TRIAL_COLLAPSE_BACK: return collapse(s, s->r->m->twin[e]);
  case TRIAL_SPLIT: return split(s, e);
  case TRIAL_COUNT: break;
  }
  return false;
}

static bool in_patch(const TriId *tri, int n, TriId t)
{
  for (int i = 0; i < n; i++)
    if (tri[i] == t) return true;
  return false;
}

void refine__trial_flips(Trial *s)
{
  Tri *m = s->r->m;
  TriId tri[TRIAL_PATCH + 8];
  int n = refine__trial_patch(s, tri);
  for (int i = 0; i < n; i++)
    for (EdgeId e = 3 * tri[i]; e < 3 * tri[i] + 3; e++) {
      EdgeId g = m->twin[e];
      if (tri_is_segment(m, e) || !in_patch(tri, n, tri_of(g))) continue;
      const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
      const double *c = tri_xy(m, tri_apex(m, e)), *d = tri_xy(m, tri_apex(m, g));
      double now = MIN(metric_quality(a, b, c), metric_quality(b, a, d));
      if (MIN(metric_quality(c, d, b), metric_quality(d, c, a)) <= now + 1e-6 || !tri_can_flip(m, e)) continue;
      refine__flip(s->r, e);
      s->r->stats->flips++;
    }
}
