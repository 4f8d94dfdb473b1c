// loop.c - curve loops head to tail
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_int.h"

// The curves at each point, as chains over the ends of the listed curves: end 2*i is where curve i begins as written,
// 2*i + 1 where it ends. Chains keep the listed order.
typedef struct {
  const Model *m;
  const int *curve;
  int n;
  Map at;         // point tag -> first end
  U32Vec next;    // by end
  bool *used;
} Ends;

static int end_point(const Ends *e, uint32_t end)
{
  int c = e->curve[end / 2];
  return end & 1 ? curve__to(e->m, c) : curve__from(e->m, c);
}

static void ends_build(Ends *e, const Model *m, const int *curve, int n)
{
  *e = (Ends){.m = m, .curve = curve, .n = n};
  e->used = mem_zalloc((size_t)n * sizeof *e->used);
  vec_resize(&e->next, 2 * (size_t)n);
  for (uint32_t k = 2 * (uint32_t)n; k-- > 0;) {
    bool added;
    uint32_t *head = map_slot(&e->at, (uint64_t)(uint32_t)end_point(e, k), k, &added);
    e->next.data[k] = added ? NONE : *head;
    *head = k;
  }
}

static void ends_free(Ends *e)
{
  map_free(&e->at);
  vec_free(&e->next);
  free(e->used);
}

// First unused end at `point` that leaves forward (or, with flip, any). NONE if there is none.
static uint32_t leaving(Ends *e, int point, bool flip)
{
  bool added;
  uint32_t *head = map_slot(&e->at, (uint64_t)(uint32_t)point, NONE, &added);
  while (*head != NONE && e->used[*head / 2]) *head = e->next.data[*head];
  uint32_t other = NONE;
  for (uint32_t k = *head; k != NONE; k = e->next.data[k]) {
    if (e->used[k / 2]) continue;
    if (!(k & 1)) return k;
    if (other == NONE) other = k;
  }
  return flip ? other : NONE;
}

// Chain all curves into closed loops; `out` gets signed tags, `flips` how many run against their sign. Returns the tag of
// the curve (signed) at which the chain broke, or 0 when everything closed.
static int chain(Ends *e, bool flip, IntVec *out, IntVec *flipped)
{
  vec_clear(out);
  vec_clear(flipped);
  memset(e->used, 0, (size_t)e->n * sizeof *e->used);
  int next_start = 0;
  while (out->len < (size_t)e->n) {
    while (e->used[next_start]) next_start++;
    uint32_t end = 2 * (uint32_t)next_start;
    int start = end_point(e, end), here;
    do {
      e->used[end / 2] = true;
      int c = e->curve[end / 2];
      if (end & 1) vec_push(flipped, c);
      vec_push(out, end & 1 ? -c : c);
      here = end_point(e, end ^ 1);
      if (here == start) break;
      end = leaving(e, here, flip);
    } while (end != NONE);
    if (here != start) return vec_last(out) ? vec_last(out) : e->curve[0];
  }
  return 0;
}

static void adopt(Model *m, Loop *l, const IntVec *out)
{
  if (out->len) memmove(l->curve, out->data, out->len * sizeof(int));
  l->sorted = true;
  for (int i = 0; i < l->ncurve; i++) model_curve(m, l->curve[i])->in_loops++;
}

// Two curves at the same ends' chain, of which one is listed twice, cannot close: say which.
static bool report_twice(const Loop *l, Diag *diag)
{
  Map seen = {0};
  for (int i = 0; i < l->ncurve; i++) {
    uint64_t key = (uint64_t)tag__abs(l->curve[i]);
    if (map_get(&seen, key) != NONE) {
      diag_error(diag, l->loc, "curve loop %d is not closed: it lists curve %d twice", l->tag, tag__abs(l->curve[i]));
      map_free(&seen);
      return true;
    }
    map_set(&seen, key, 1);
  }
  map_free(&seen);
  return false;
}

// Points that an odd number of the listed curve ends touch: where the chain is open, in order of appearance.
static void odd_points(const Ends *e, IntVec *point, IntVec *curve)
{
  Map degree = {0};
  for (uint32_t k = 0; k < 2 * (uint32_t)e->n; k++) {
    bool added;
    uint32_t *d = map_slot(&degree, (uint64_t)(uint32_t)end_point(e, k), 0, &added);
    (*d)++;
  }
  for (uint32_t k = 0; k < 2 * (uint32_t)e->n; k++) {
    uint64_t key = (uint64_t)(uint32_t)end_point(e, k);
    if (map_get(&degree, key) % 2 == 0) continue;
    map_set(&degree, key, 0);
    vec_push(point, (int)key);
    vec_push(curve, tag__abs(e->curve[k / 2]));
  }
  map_free(&degree);
}

// Loops that extrusions made have no number of their own to speak of.
static void name_of(const Loop *l, char name[32])
{
  if (l->tag >= HIDDEN_LOOP) snprintf(name, 32, "the boundary of a surface");
  else snprintf(name, 32, "curve loop %d", l->tag);
}

// The gap: the open end first met, and the open end nearest to it.
static void report_gap(const Ends *e, const Loop *l, Diag *diag)
{
  IntVec point = {0}, curve = {0};
  char name[32];
  odd_points(e, &point, &curve);
  name_of(l, name);
  if (point.len < 2) {
    diag_error(diag, l->loc, "%s is not closed: its curves do not follow one another", name);
  } else {
    Vec3 p = model_point(e->m, point.data[0])->xyz;
    size_t best = 1;
    double least = INFINITY;
    for (size_t i = 1; i < point.len; i++) {
      double d = vec3_distance(p, model_point(e->m, point.data[i])->xyz);
      if (d < least) {
        least = d;
        best = i;
      }
    }
    Vec3 q = model_point(e->m, point.data[best])->xyz;
    diag_error(diag, l->loc,
               "%s is not closed: curve %d ends at point %d (%.10g, %.10g, %.10g) and curve %d at point %d "
               "(%.10g, %.10g, %.10g), %.6g apart",
               name, curve.data[0], point.data[0], p.x, p.y, p.z, curve.data[best], point.data[best], q.x, q.y, q.z, least);
    if (least == 0)
      diag_note(diag, model_point(e->m, point.data[best])->loc, "the two points coincide; 'Coherence;' makes them one");
  }
  vec_free(&point);
  vec_free(&curve);
}

static void report_flips(const Loop *l, const IntVec *flipped, Diag *diag)
{
  int c = flipped->data[0];
  if (flipped->len == 1)
    diag_warning(diag, l->loc, "curve loop %d: curve %d runs the other way round; taken as %d", l->tag, c, -c);
  else
    diag_warning(diag, l->loc, "curve loop %d: %zu curves run the other way round (the first is %d); their signs are changed",
                 l->tag, flipped->len, c);
}

// The opposite loop when most curves were against the first.
static void reverse_if_fewer(const Loop *l, IntVec *out, IntVec *flipped)
{
  if (2 * flipped->len <= (size_t)l->ncurve) return;
  for (size_t i = 0, j = out->len; i < j--; i++) {
    int t = out->data[i];
    out->data[i] = -out->data[j];
    out->data[j] = -t; // when i == j this gives -t as well
  }
  Map was = {0};
  for (size_t i = 0; i < flipped->len; i++) map_set(&was, (uint64_t)(uint32_t)flipped->data[i], 1);
  vec_clear(flipped);
  for (int i = 0; i < l->ncurve; i++)
    if (map_get(&was, (uint64_t)(uint32_t)l->curve[i]) == NONE) vec_push(flipped, l->curve[i]);
  map_free(&was);
}

// The common case: as listed, each curve begins where the one before ends, and the start is met at the very end only.
static bool in_order(const Model *m, const Loop *l)
{
  int start = curve__from(m, l->curve[0]);
  for (int i = 0; i < l->ncurve; i++) {
    int to = curve__to(m, l->curve[i]);
    if ((to == start) != (i + 1 == l->ncurve)) return false;
    if (i + 1 < l->ncurve && to != curve__from(m, l->curve[i + 1])) return false;
  }
  return true;
}

LoopState loop__sort(Model *m, Loop *l, bool quiet, Diag *diag)
{
  if (l->sorted) return LOOP_OK;
  for (int i = 0; i < l->ncurve; i++)
    if (!model_curve(m, l->curve[i])) return LOOP_UNKNOWN_CURVE;
  if (in_order(m, l)) {
    IntVec same = {l->curve, (size_t)l->ncurve, 0};
    adopt(m, l, &same);
    return LOOP_OK;
  }
  Ends e;
  ends_build(&e, m, l->curve, l->ncurve);
  IntVec out = {0}, flipped = {0};
  LoopState state = LOOP_OK;
  if (chain(&e, false, &out, &flipped) == 0) {
    adopt(m, l, &out);
  } else {
    state = LOOP_OPEN;
    ends_free(&e);
    ends_build(&e, m, l->curve, l->ncurve);
    if (chain(&e, true, &out, &flipped) == 0) {
      reverse_if_fewer(l, &out, &flipped);
      if (!m->set.opencascade) report_flips(l, &flipped, diag); // whose loops have no signs
      adopt(m, l, &out);
      state = LOOP_OK;
    } else if (!quiet && !l->reported) {
      l->reported = true;
      if (!report_twice(l, diag)) report_gap(&e, l, diag);
    }
  }
  vec_free(&out);
  vec_free(&flipped);
  ends_free(&e);
  return state;
}

bool loop__verify(Model *m, Loop *l, Diag *diag)
{
  if (!l->sorted) return loop__sort(m, l, false, diag) == LOOP_OK;
  if (in_order(m, l)) return true;
  l->sorted = false; // the curves count this loop already
  for (int i = 0; i < l->ncurve; i++) model_curve(m, l->curve[i])->in_loops--;
  return loop__sort(m, l, false, diag) == LOOP_OK;
}
