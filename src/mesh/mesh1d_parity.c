// mesh1d_parity.c - even numbers of segments around faces that are to become quadrangles
// SPDX-License-Identifier: MIT
//
// A face can be cut into quadrangles only if its boundary has an even number of edges. Where that is not so the fewest and least
// noticeable curves get one segment more: a T-join in the graph whose vertices are the faces to be recombined, and outside, and whose
// edges are curves, taken on a spanning forest that prefers curves of many segments. Where single faces are recombined every curve
// around them gets an even number first, as in Gmsh, and with the full-quad methods, which halve the 1D mesh, a multiple of two or four.
#include "base/base.h"

#include <math.h>

#include "base/mem.h"
#include "mesh/mesh1d_int.h"

static bool is_free(const CurveWork *w)
{
  return !w->fixed && (w->rule == RULE_SIZE || w->rule == RULE_GRADED);
}

static bool is_structured(const Face *f)
{
  return f->transfinite || (f->extruded_curve && f->layers.n > 0);
}

static void round_up(Mesher1d *d, int tag, uint32_t multiple)
{
  uint32_t k = mesh1d_index(d->g, tag);
  if (k == NONE) return;
  CurveWork *w = &d->work[k];
  w->parity = true;
  if (is_free(w)) w->segments = (w->segments + multiple - 1) / multiple * multiple;
}

// Visit every curve on the boundary of a face; seams are met twice.
static void for_boundary(Mesher1d *d, const Face *f, void (*visit)(Mesher1d *d, int tag, uint32_t arg), uint32_t arg)
{
  for (int i = 0; i < f->nloop; i++) {
    const Loop *loop = model_loop(d->m, f->loop[i]);
    for (int k = 0; loop && k < loop->ncurve; k++) visit(d, loop->curve[k], arg);
  }
}

// ---- the graph of recombined faces -------------------------------------------------------------------------------------------

typedef struct {
  uint32_t a, b;    // faces; nface: outside
  uint32_t curve;
  uint32_t halved;  // faces that could be halved no more if the curve had an odd number
  uint32_t weight;  // segments: the more, the less one more is noticed
} Link;

static int by_weight(const void *p, const void *q)
{
  const Link *x = p, *y = q;
  if (x->halved != y->halved) return x->halved < y->halved ? -1 : 1;
  if (x->weight != y->weight) return x->weight > y->weight ? -1 : 1;
  return x->curve < y->curve ? -1 : x->curve > y->curve;
}

static uint32_t root_of(uint32_t *parent, uint32_t v)
{
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

// Segments of copies are those of their master.
static uint32_t segments_of(Mesher1d *d, uint32_t k)
{
  for (int steps = 0; steps < 1000 && k != NONE && d->work[k].rule == RULE_COPY; steps++) {
    const Curve *c = d->work[k].c;
    k = mesh1d_index(d->g, c->copy_of ? c->copy_of : c->periodic_master);
  }
  return k == NONE || d->work[k].rule == RULE_COPY ? 0 : d->work[k].segments;
}

static void freeze(Mesher1d *d, int tag, uint32_t arg)
{
  (void)arg;
  uint32_t k = mesh1d_index(d->g, tag);
  if (k != NONE) d->work[k].fixed = true;
}

typedef struct {
  uint32_t nface;
  uint32_t *side;   // 2 per curve: the faces it bounds, nface for outside
  uint8_t *used;    // times the curve occurs on boundaries
  uint8_t *odd;     // per face (and outside): its boundary count is odd
  uint8_t *halved;  // per face (and outside): a full-quad method can have it, as all its curves have even numbers
} FaceGraph;

static bool full_quad(const Mesher1d *d) { return d->opt->Mesh_RecombinationAlgorithm >= 2; }

static bool becomes_quads(const Mesher1d *d, const Face *f)
{
  return (d->opt->Mesh_RecombineAll || (f->recombine && d->opt->Mesh_RecombinationAlgorithm != 0)) && !is_structured(f);
}

static void collect(Mesher1d *d, FaceGraph *fg)
{
  for (uint32_t f = 0; f < fg->nface; f++) {
    const Face *face = model_face_at(d->m, f);
    bool wanted = becomes_quads(d, face);
    fg->halved[f] = wanted && full_quad(d);
    for (int i = 0; i < face->nloop; i++) {
      const Loop *loop = model_loop(d->m, face->loop[i]);
      for (int k = 0; loop && k < loop->ncurve; k++) {
        uint32_t c = mesh1d_index(d->g, loop->curve[k]);
        if (c == NONE) continue;
        if (wanted) fg->odd[f] ^= segments_of(d, c) & 1;
        if (segments_of(d, c) & 1) fg->halved[f] = 0;
        if (fg->used[c] < 2) fg->side[2 * c + fg->used[c]] = wanted ? f : fg->nface;
        if (fg->used[c] < 3) fg->used[c]++;
      }
    }
  }
}

// Take each vertex of the forest away from its leaves inwards; an odd one takes its edge to the rest.
static void join_on_forest(Mesher1d *d, FaceGraph *fg, const Link *tree, size_t ntree)
{
  uint32_t nv = fg->nface + 1;
  uint32_t *degree = mem_zalloc(nv * sizeof *degree), *sum = mem_zalloc(nv * sizeof *sum);
  for (size_t i = 0; i < ntree; i++) {
    // The exclusive or of the tree edges at a vertex names the last one left.
    degree[tree[i].a]++, degree[tree[i].b]++;
    sum[tree[i].a] ^= (uint32_t)i, sum[tree[i].b] ^= (uint32_t)i;
  }
  U32Vec leaf = {0};
  for (uint32_t v = 0; v < fg->nface; v++)
    if (degree[v] == 1) vec_push(&leaf, v);
  while (leaf.len) {
    uint32_t v = vec_pop(&leaf);
    if (degree[v] != 1) continue;
    const Link *l = &tree[sum[v]];
    uint32_t o = l->a == v ? l->b : l->a;
    if (fg->odd[v]) {
      d->work[l->curve].segments++;
      fg->odd[v] ^= 1, fg->odd[o] ^= 1;
    }
    degree[v] = 0;
    degree[o]--;
    sum[o] ^= sum[v];
    if (degree[o] == 1 && o < fg->nface) vec_push(&leaf, o);
  }
  vec_free(&leaf);
  free(degree);
  free(sum);
}

static void settle_globally(Mesher1d *d)
{
  // Opposite sides of structured faces have to stay equal.
  for (size_t f = 0; f < model_faces(d->m); f++)
    if (is_structured(model_face_at(d->m, f))) for_boundary(d, model_face_at(d->m, f), freeze, 0);
  size_t nc = d->g->ncurve;
  FaceGraph fg = {.nface = (uint32_t)model_faces(d->m)};
  fg.side = mem_alloc((2 * nc + 1) * sizeof *fg.side);
  for (size_t i = 0; i < 2 * nc; i++) fg.side[i] = fg.nface;
  fg.used = mem_zalloc(nc + 1);
  fg.odd = mem_zalloc(fg.nface + 1);
  fg.halved = mem_zalloc(fg.nface + 1);
  collect(d, &fg);
  // The master of a copy changes both at once: it stays as it is.
  uint8_t *has_copy = mem_zalloc(nc + 1);
  for (size_t k = 0; k < nc; k++) {
    if (d->work[k].rule != RULE_COPY) continue;
    const Curve *c = d->work[k].c;
    uint32_t master = mesh1d_index(d->g, c->copy_of ? c->copy_of : c->periodic_master);
    if (master != NONE) has_copy[master] = 1;
  }
  Vec(Link) link = {0};
  for (uint32_t k = 0; k < nc; k++) {
    uint32_t a = fg.side[2 * k], b = fg.side[2 * k + 1];
    if (fg.used[k] == 0 || fg.used[k] > 2 || a == b || has_copy[k] || !is_free(&d->work[k])) continue;
    vec_push(&link, ((Link){a, b, k, fg.halved[a] + fg.halved[b], d->work[k].segments}));
  }
  if (link.len) qsort(link.data, link.len, sizeof *link.data, by_weight);
  uint32_t *parent = mem_alloc((fg.nface + 1) * sizeof *parent);
  for (uint32_t v = 0; v <= fg.nface; v++) parent[v] = v;
  size_t ntree = 0;
  for (size_t i = 0; i < link.len; i++) {
    uint32_t a = root_of(parent, link.data[i].a), b = root_of(parent, link.data[i].b);
    if (a == b) continue;
    parent[MAX(a, b)] = MIN(a, b);
    link.data[ntree++] = link.data[i];
  }
  join_on_forest(d, &fg, link.data, ntree);
  for (size_t k = 0; k < nc && d->opt->Mesh_RecombineAll && !full_quad(d); k++) d->work[k].parity = fg.used[k] > 0;
  for (uint32_t f = 0; f < fg.nface; f++)
    if (fg.odd[f])
      diag_warning(d->diag, model_face_at(d->m, f)->loc,
                   "face %d cannot become quadrangles only: the prescribed counts around it add up to an odd number",
                   model_face_at(d->m, f)->tag);
  free(has_copy);
  free(parent);
  free(fg.side);
  free(fg.used);
  free(fg.odd);
  free(fg.halved);
  vec_free(&link);
}

void mesh1d__settle_parity(Mesher1d *d)
{
  int method = d->opt->Mesh_RecombinationAlgorithm;
  bool all = d->opt->Mesh_RecombineAll;
  uint32_t multiple = method == 2 || method == 4 ? 4 : 2;
  bool some = all;
  for (size_t k = 0; k < model_faces(d->m) && !(all && !full_quad(d)); k++) {
    const Face *f = model_face_at(d->m, k);
    if (!all && (!f->recombine || method == 0)) continue;
    for_boundary(d, f, round_up, multiple);
    some = true;
  }
  if (some) settle_globally(d);
}
