// tri_optimize.c - optimization: flips by quality, valence repair, repositioning
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "tri/refine_int.h"

// A star is worth a visit if one of its triangles has 1/kappa_4^2 above this: a lattice is left alone.
#define GOOD 1.005

// Triangles of a mesh called small; triangles that one round of rework looks at.
enum { SMALL_FACE = 20000, REWORKED = 400 };

typedef struct {
  double sum, worst; // of 1/kappa_4^2
} Worth;

// Sum and largest over the triangles about four vertices.
static Worth patch_worth(const Tri *m, const VertId *q)
{
  Worth w = {0, 0};
  for (int k = 0; k < 4; k++) {
    EdgeId first = m->hint[q[k]], e = first;
    do {
      VertId b = tri_dest(m, e), c = tri_apex(m, e);
      bool seen = false;
      for (int i = 0; i < k; i++) seen |= b == q[i] || c == q[i];
      if (!seen && tri_is_inside(m, tri_of(e))) {
        double x = metric_quality(tri_xy(m, q[k]), tri_xy(m, b), tri_xy(m, c));
        double f = x > 0 ? 1 / x : INFINITY;
        w.sum += f;
        w.worst = f > w.worst ? f : w.worst;
      }
      e = tri_ccw(m, e);
    } while (e != first);
  }
  return w;
}

void refine__flip(Refiner *r, EdgeId e)
{
  Tri *m = r->m;
  r->excess[tri_org(m, e)]--, r->excess[tri_dest(m, e)]--;
  r->excess[tri_apex(m, e)]++, r->excess[tri_apex(m, m->twin[e])]++;
  tri_flip(m, e);
}

// An edge inside the domain, named once.
static inline bool flippable(const Tri *m, EdgeId e)
{
  return m->twin[e] > e && !(m->flag[tri_of(e)] & (TRI_OUTSIDE_FLAG | TRI_FREE)) && !tri_is_segment(m, e);
}

void refine__wake_around(Refiner *r, VertId v)
{
  const Tri *m = r->m;
  EdgeId first = m->hint[v], e = first;
  r->awake[v] = 1;
  do {
    VertId u = tri_dest(m, e);
    if (u != TRI_INF) r->awake[u] = 1;
    e = tri_ccw(m, e);
  } while (e != first);
}

// Would the triangles around the origin of e, moved onto its destination, have at least that quality and edges that short?
static bool collapse_is_good(const Refiner *r, EdgeId e, double least, double longest)
{
  const Tri *m = r->m;
  VertId b = tri_dest(m, e);
  const double *pb = tri_xy(m, b);
  for (EdgeId f = tri_ccw(m, e); f != e; f = tri_ccw(m, f)) {
    VertId c = tri_dest(m, f), d = tri_apex(m, f);
    if (metric_length(pb, tri_xy(m, c), r->size[b], r->size[c]) > longest) return false;
    if (d != b && metric_quality(pb, tri_xy(m, c), tri_xy(m, d)) < least) return false;
  }
  return true;
}

bool refine__collapse(Refiner *r, EdgeId e, double least, double longest)
{
  Tri *m = r->m;
  VertId a = tri_org(m, e), b = tri_dest(m, e);
  if (r->fixed[a] || !collapse_is_good(r, e, least, longest) || !tri_can_collapse(m, e)) return false;
  refine__wake_around(r, a);
  VertId c = tri_apex(m, e), d = tri_apex(m, m->twin[e]);
  if (!r->fixed[b]) r->excess[b] = (int16_t)(r->excess[b] + r->excess[a] + 2);
  if (!r->fixed[c]) r->excess[c]--;
  if (!r->fixed[d]) r->excess[d]--;
  tri_collapse(m, e);
  r->fixed[a] = true; // isolated now
  r->stats->collapses++;
  return true;
}

// What a trial may change: four vertices, to be put back.
typedef struct {
  VertId v[4];
  double xy[8], size[4];
  size_t moves;
} Saved;

static Saved save(const Refiner *r, const VertId *v)
{
  Saved s = {.moves = r->stats->moves};
  for (int k = 0; k < 4; k++) {
    s.v[k] = v[k];
    s.xy[2 * k] = r->m->xy[2 * (size_t)v[k]], s.xy[2 * k + 1] = r->m->xy[2 * (size_t)v[k] + 1];
    s.size[k] = r->size[v[k]];
  }
  return s;
}

static void restore(Refiner *r, const Saved *s)
{
  for (int k = 0; k < 4; k++) {
    r->m->xy[2 * (size_t)s->v[k]] = s->xy[2 * k], r->m->xy[2 * (size_t)s->v[k] + 1] = s->xy[2 * k + 1];
    r->size[s->v[k]] = s->size[k];
  }
  r->stats->moves = s->moves;
}

// Flip e and reposition its four vertices; keep that if the triangles around are better: in sum and, above the floor, none worse
// than the worst; or, if `worst`, the worst of them by 2 %.
static bool try_flip(Refiner *r, EdgeId e, bool worst)
{
  Tri *m = r->m;
  VertId q[4] = {tri_org(m, e), tri_dest(m, e), tri_apex(m, e), tri_apex(m, m->twin[e])};
  if (!tri_can_flip(m, e)) return false;
  Worth before = patch_worth(m, q);
  Saved saved = save(r, q);
  double floor = r->floor;
  refine__flip(r, e);
  r->floor = INFINITY; // the flip may have made them bad at first
  for (int pass = 0; pass < 3; pass++)
    for (int k = 0; k < 4; k++)
      if (!r->fixed[q[k]] && (!worst || pass < 1 || !refine__relocate_worst(r, q[k]))) refine__relocate(r, q[k]);
  r->floor = floor;
  Worth after = patch_worth(m, q);
  bool good = worst ? after.worst < 0.98 * before.worst
                    : after.sum < before.sum && after.worst <= (before.worst > floor ? before.worst : floor);
  if (good) {
    r->stats->flips++;
    return true;
  }
  restore(r, &saved);
  refine__flip(r, e);
  return false;
}

// Half-edges first .. end-1, of triangles in the domain, that name an edge with an end awake. Without branches that depend on the mesh.
static size_t edges_awake(const Refiner *r, EdgeId first, EdgeId end, EdgeId *list)
{
  const Tri *m = r->m;
  size_t n = 0;
  for (TriId t = tri_of(first); 3 * t < end; t++) {
    if (m->flag[t] & (TRI_OUTSIDE_FLAG | TRI_FREE)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t, *o = m->twin + 3 * (size_t)t;
    unsigned a = r->awake[v[0]], b = r->awake[v[1]], c = r->awake[v[2]], inner = ~(unsigned)m->flag[t];
    if (!(a | b | c)) continue;
    EdgeId e = 3 * t;
    list[n] = e, n += ((a | b) != 0) & (o[0] > e) & (e >= first) & inner;
    list[n] = e + 1, n += ((b | c) != 0) & (o[1] > e + 1) & (e + 1 >= first) & inner >> 1;
    list[n] = e + 2, n += ((c | a) != 0) & (o[2] > e + 2) & inner >> 2;
  }
  return n;
}

// Is edge e not locally Delaunay, and both triangles better when it is turned?
static bool flip_is_good(Tri *m, EdgeId e)
{
  const double *a = tri_xy(m, tri_org(m, e)), *b = tri_xy(m, tri_dest(m, e));
  const double *c = tri_xy(m, tri_apex(m, e)), *d = tri_xy(m, tri_apex(m, m->twin[e]));
  if (LIKELY(incircle(a, b, c, d) <= 0)) return false;
  double q = metric_quality(a, b, c), s = metric_quality(b, a, d), worse = q < s ? q : s;
  if (metric_quality(c, d, b) <= worse + 1e-6 || metric_quality(d, c, a) <= worse + 1e-6) return false;
  return tri_can_flip(m, e);
}

size_t refine__flips(Refiner *r)
{
  enum { BLOCK = 3 * 64 };
  Tri *m = r->m;
  EdgeId list[BLOCK + 1], end = 3 * m->nt;
  size_t n = 0;
  for (EdgeId e = 0, next; e < end; e = next) {
    next = MIN(end, e - e % 3 + BLOCK);
    size_t count = edges_awake(r, e, next, list);
    for (size_t i = 0; i < count; i++) {
      if (LIKELY(!flip_is_good(m, list[i]))) continue;
      refine__flip(r, list[i]);
      n++;
      next = list[i] + 1; // the flip changed what the edges after it are
      break;
    }
  }
  r->stats->flips += n;
  return n;
}

static size_t repair_valences(Refiner *r)
{
  Tri *m = r->m;
  size_t n = 0;
  for (TriId t = 0; t < m->nt; t++) {
    if (m->flag[t] & (TRI_OUTSIDE_FLAG | TRI_FREE)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    if (MAX(r->excess[v[0]], MAX(r->excess[v[1]], r->excess[v[2]])) < 1) continue;
    for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
      if (!flippable(m, e)) continue;
      int a = r->excess[tri_org(m, e)], b = r->excess[tri_dest(m, e)];
      if (a + b < 1) continue; // the apexes have at least -1 each but where a triangle is very bad
      int c = r->excess[tri_apex(m, e)], d = r->excess[tri_apex(m, m->twin[e])];
      if (a + b - c - d >= 3) n += try_flip(r, e, false);
    }
  }
  return n;
}

typedef struct {
  double quality;
  TriId t;
  VertId v[3];
} Bad;

static int worse_first(const void *a, const void *b)
{
  const Bad *x = a, *y = b;
  if (x->quality != y->quality) return x->quality < y->quality ? -1 : 1;
  return (x->t > y->t) - (x->t < y->t);
}

static double quality_of(const Tri *m, TriId t)
{
  const uint32_t *v = m->vert + 3 * (size_t)t;
  return metric_quality(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]));
}

// Collapse the shortest edge of t if that makes better triangles.
static bool collapse_shortest(Refiner *r, TriId t)
{
  Tri *m = r->m;
  EdgeId best = NONE;
  double least = INFINITY;
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
    double d = metric_distance2(tri_xy(m, tri_org(m, e)), tri_xy(m, tri_dest(m, e)));
    if (d < least && !tri_is_segment(m, e)) least = d, best = e;
  }
  if (best == NONE) return false;
  double quality = 1.1 * quality_of(m, t);
  VertId kept = tri_dest(m, best);
  if (!refine__collapse(r, best, quality, METRIC_LONG)) {
    kept = tri_org(m, best);
    if (!refine__collapse(r, m->twin[best], quality, METRIC_LONG)) return false;
  }
  if (!r->fixed[kept]) refine__relocate_worst(r, kept), refine__relocate(r, kept);
  return true;
}

// Something for triangle t: its vertices, then its edges.
static bool mend(Refiner *r, TriId t, double mended)
{
  Tri *m = r->m;
  bool moved = false;
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++)
    if (!r->fixed[m->vert[e]]) moved |= refine__relocate_worst(r, m->vert[e]);
  if (quality_of(m, t) > mended) return true;
  for (EdgeId e = 3 * t; e < 3 * t + 3; e++)
    if (!tri_is_segment(m, e) && try_flip(r, e, true)) return true;
  return moved || collapse_shortest(r, t);
}

// The triangles of kappa_4^2 below `mended`, the worst first, each for its own sake alone. Returns how many got better.
static size_t mend_worst(Refiner *r, double mended)
{
  Tri *m = r->m;
  Vec(Bad) bad = {0};
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    if (r->fixed[v[0]] && r->fixed[v[1]] && r->fixed[v[2]]) continue;
    if (metric_is_surely(tri_xy(m, v[0]), tri_xy(m, v[1]), tri_xy(m, v[2]), mended)) continue;
    Bad b = {quality_of(m, t), t, {v[0], v[1], v[2]}};
    if (b.quality < mended) vec_push(&bad, b);
  }
  if (bad.len) qsort(bad.data, bad.len, sizeof *bad.data, worse_first);
  size_t n = 0;
  for (size_t i = 0; i < bad.len; i++) {
    const Bad *b = &bad.data[i];
    if (memcmp(m->vert + 3 * (size_t)b->t, b->v, sizeof b->v) == 0) n += mend(r, b->t, mended);
  }
  vec_free(&bad);
  return n;
}

void refine__prepare(Refiner *r, VertId given)
{
  Tri *m = r->m;
  tri_make_hints(m);
  free(r->fixed), free(r->awake), free(r->excess);
  r->fixed = mem_zalloc(r->cap_v * sizeof *r->fixed);
  r->awake = mem_zalloc(r->cap_v * sizeof *r->awake);
  r->excess = mem_alloc(r->cap_v * sizeof *r->excess);
  for (VertId v = 0; v < m->nv; v++) r->excess[v] = -6;
  double worst = 1;
  for (TriId t = 0; t < m->nt; t++) {
    if (!tri_is_inside(m, t)) continue;
    const uint32_t *v = m->vert + 3 * (size_t)t;
    const double *a = tri_xy(m, v[0]), *b = tri_xy(m, v[1]), *c = tri_xy(m, v[2]);
    double q = metric_is_surely(a, b, c, MAX(worst, 1 / GOOD)) ? 1 : metric_quality(a, b, c);
    if (q * GOOD < 1) r->awake[v[0]] = r->awake[v[1]] = r->awake[v[2]] = 1;
    if (q < worst) worst = q;
    for (EdgeId e = 3 * t; e < 3 * t + 3; e++) {
      if (r->excess[m->vert[e]] < 10000) r->excess[m->vert[e]]++;
      if (tri_is_segment(m, e)) r->fixed[tri_org(m, e)] = r->fixed[tri_dest(m, e)] = true;
    }
  }
  for (VertId v = 0; v < m->nv; v++) {
    if (v < given || m->hint[v] == NONE) r->fixed[v] = true;
    if (r->fixed[v]) r->excess[v] = 0;
  }
  // A triangle may get worse while its star gets better, down to 0.9, but none below the worst of all.
  r->floor = worst < 0.9 ? 1 / 0.9 : 1 / worst;
  r->worst = 1 / worst;
}

void refine__optimize(Refiner *r, int level)
{
  if (level <= 0) return;
  if (r->p->algorithm == REFINE_FRONT_QUAD || r->p->algorithm == REFINE_PACK) { // right angles are meant to be: only the worst
    for (int k = 0; k < 2 * level && mend_worst(r, 0.66); k++) continue;
    return;
  }
  // Valence repair costs as much as the insertion where half of the vertices are irregular, next to nothing behind a front.
  bool valences = level > 1 || r->p->algorithm == REFINE_FRONTAL;
  int rounds = level > 1 ? 8 : valences ? 2 : 0;
  if (rounds == 0) {
    refine__flips(r);
    refine__smooth(r, 1);
    refine__flips(r);
  }
  for (int k = 0; k < rounds; k++) {
    size_t flips = refine__flips(r) + repair_valences(r);
    size_t moves = r->stats->moves;
    refine__smooth(r, 1);
    if (flips == 0 && r->stats->moves == moves) break;
  }
  double mended = valences ? 0.8 : 0.66;
  for (int k = 0; k < 2 * level && mend_worst(r, mended); k++) continue;
  // Small faces are polished afterwards. In large ones only what mending left is tried, that the cost stays out of sight.
  if (r->m->nt >= SMALL_FACE) refine__rework(r, mended, REWORKED, 2);
  else if (r->m->nt >= REFINE_POLISHED) refine__rework(r, 0.87, REWORKED, 2 + level);
}
