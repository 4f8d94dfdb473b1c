// wire.c - the boundaries of OpenCASCADE's shapes under their numbers, which Plane Surface takes as if they were curve loops
// SPDX-License-Identifier: MIT
//
// Rectangle, Disk, copies and swept faces number their wires one after the other, from the largest number of a wire or a curve loop
// on; faces that are moved do so again. A wire stays when its face is deleted and its curves are not; Boolean operations leave none.
#include "base/base.h"

#include "model/model_int.h"

// Its curves are still the ones that it was made of.
static bool lives(const Model *m, const NumberedWire *w)
{
  if (!w->ncurve) return false; // gone with its face
  for (int i = 0; i < w->ncurve; i++) {
    const Curve *c = model_curve(m, w->curve[i]);
    if (!c || c->loc.line != w->made[i].line || c->loc.col != w->made[i].col || c->loc.file != w->made[i].file) return false;
  }
  return true;
}

static void purge(Model *m)
{
  size_t n = 0;
  for (size_t i = 0; i < m->wire.len; i++)
    if (lives(m, &m->wire.data[i])) m->wire.data[n++] = m->wire.data[i];
  m->wire.len = n;
}

static void run_along(Model *m, NumberedWire *w, const Loop *l)
{
  w->ncurve = l->ncurve;
  w->curve = arena_dup(&m->arena, l->curve, (size_t)l->ncurve * sizeof *l->curve);
  SrcLoc *made = arena_alloc(&m->arena, (size_t)l->ncurve * sizeof *made);
  for (int i = 0; i < l->ncurve; i++) made[i] = model_curve(m, l->curve[i])->loc;
  w->made = made;
}

void wire__note(Model *m, int face)
{
  if (!m->set.opencascade) return;
  Face *f = model_face(m, face);
  for (int k = 0; k < f->nloop; k++) {
    while (m->wire.len && !lives(m, &m->wire.data[m->wire.len - 1])) m->wire.len--;
    int last = m->wire.len ? m->wire.data[m->wire.len - 1].number : 0;
    NumberedWire w = {.number = MAX(last, m->max[KIND_LOOP]) + 1, .face = face};
    run_along(m, &w, model_loop(m, f->loop[k]));
    vec_push(&m->wire, w);
    if (k == 0) f->wire = w.number;
  }
}

// Where the wires of a face begin in the list; its end if there are none. O(log n)
static size_t first_of(const Model *m, const Face *f)
{
  size_t lo = 0, hi = f->wire ? m->wire.len : 0;
  while (lo < hi) {
    size_t mid = lo + (hi - lo) / 2;
    if (m->wire.data[mid].number < f->wire)
      lo = mid + 1;
    else
      hi = mid;
  }
  return f->wire ? lo : m->wire.len;
}

void wire__forget(Model *m, int face)
{
  for (size_t i = first_of(m, model_face(m, face)); i < m->wire.len && m->wire.data[i].face == face; i++) m->wire.data[i].ncurve = 0;
}

int wire__loop(Model *m, int number, SrcLoc loc)
{
  if (!m->set.opencascade) return 0;
  purge(m);
  for (size_t i = 0; i < m->wire.len; i++)
    if (m->wire.data[i].number == number) return loop__make_hidden(m, m->wire.data[i].curve, m->wire.data[i].ncurve, loc);
  return 0;
}
