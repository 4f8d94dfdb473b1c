// unroll_mesh.c - how to mesh a model, as plain .geo
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/unroll_int.h"

// `What {tags} = ` or without the equals sign.
static void put_list_head(Writer *w, const char *what, const int *v, size_t n, const char *after)
{
  writer_str(w, what);
  writer_char(w, ' ');
  unroll__ints(w, v, n);
  writer_str(w, after);
}

static bool uniform(const Layers *l) { return l->n == 1; }

static void put_transfinite_curve(Writer *w, const Curve *c)
{
  int tag = c->law == LAW_BETA && c->coef < 0 ? -c->tag : c->tag;
  put_list_head(w, "Transfinite Curve", &tag, 1, " = ");
  writer_i64(w, c->transfinite);
  static const char *const law[] = {NULL, "Progression", "Bump", "Beta"};
  if (law[c->law]) {
    writer_str(w, " Using ");
    writer_str(w, law[c->law]);
    writer_char(w, ' ');
    writer_double(w, c->law == LAW_BETA ? fabs(c->coef) : c->coef);
  }
  writer_str(w, ";\n");
}

static void put_swept_curve(Writer *w, const Curve *c)
{
  if (c->transfinite || !c->extruded_point || !c->layers.n) return;
  if (uniform(&c->layers)) {
    put_list_head(w, "Transfinite Curve", &c->tag, 1, " = ");
    writer_i64(w, (int64_t)c->layers.count[0] + 1);
    writer_str(w, ";\n");
  } else {
    writer_printf(w, "// curve %d was extruded with %d layers of unequal elements\n", c->tag, c->layers.n);
  }
}

// Of a curve cut into parts: the nodes are shared out.
static void put_part_attributes(Unroll *r, const Curve *c)
{
  if (!c->transfinite && !c->reverse_mesh) return;
  int parts = 0;
  for (size_t k = map_get(&r->part, (uint64_t)c->tag); r->tag.data[k] >= 0; k++) parts++;
  if (c->transfinite) {
    writer_str(r->w, "Transfinite Curve ");
    unroll__curve_list(r, &c->tag, 1);
    writer_printf(r->w, " = %d;\n", MAX(2, (c->transfinite - 1 + parts / 2) / parts + 1));
  }
  if (c->reverse_mesh) {
    writer_str(r->w, "ReverseMesh Curve ");
    unroll__curve_list(r, &c->tag, 1);
    writer_str(r->w, ";\n");
  }
}

static void put_curve_attributes(Unroll *r)
{
  Writer *w = r->w;
  const Model *m = r->m;
  for (size_t i = 0; i < model_curves(m); i++) {
    const Curve *c = model_curve_at(m, i);
    if (r->part.len && map_get(&r->part, (uint64_t)c->tag) != NONE) {
      put_part_attributes(r, c);
      continue;
    }
    if (c->transfinite) put_transfinite_curve(w, c);
    put_swept_curve(w, c);
    if (c->reverse_mesh) put_list_head(w, "ReverseMesh Curve", &c->tag, 1, ";\n");
    if (c->degenerate) put_list_head(w, "Degenerated Curve", &c->tag, 1, ";\n");
    int master = c->periodic_master ? c->periodic_master : c->transfinite ? 0 : c->copy_of;
    if (!master) continue;
    put_list_head(w, "Periodic Curve", &c->tag, 1, " = ");
    unroll__ints(w, &master, 1);
    if (c->periodic_master && c->affine) {
      writer_str(w, " Affine ");
      unroll__doubles(w, c->affine, 16);
    }
    writer_str(w, ";\n");
  }
}

static void put_transfinite_face(Writer *w, const Face *f)
{
  static const char *const word[] = {"", " Right", " AlternateRight", " AlternateLeft"};
  put_list_head(w, "Transfinite Surface", &f->tag, 1, "");
  if (f->ncorner) {
    writer_str(w, " = ");
    unroll__ints(w, f->corner, (size_t)f->ncorner);
  }
  writer_str(w, word[f->arrangement]);
  writer_str(w, ";\n");
}

static void put_face_attributes(Unroll *r)
{
  Writer *w = r->w;
  const Model *m = r->m;
  for (size_t i = 0; i < model_faces(m); i++) {
    const Face *f = model_face_at(m, i);
    bool swept = f->extruded_curve && f->layers.n && uniform(&f->layers);
    if (f->transfinite || swept) put_transfinite_face(w, f);
    if (f->recombine || (swept && f->layers.recombine)) {
      put_list_head(w, "Recombine Surface", &f->tag, 1, "");
      if (f->recombine && f->recombine_angle != 45) {
        writer_str(w, " = ");
        writer_double(w, f->recombine_angle);
      }
      writer_str(w, ";\n");
    }
    const struct {
      const char *word;
      int value, none;
    } number[] = {{"Smoother Surface", f->smoother, 0},
                  {"MeshAlgorithm Surface", f->algorithm, 0},
                  {"MeshSizeFromBoundary Surface", f->size_from_boundary, -1}};
    for (size_t k = 0; k < ARRAY_LEN(number); k++) {
      if (number[k].value == number[k].none) continue;
      put_list_head(w, number[k].word, &f->tag, 1, " = ");
      writer_i64(w, number[k].value);
      writer_str(w, ";\n");
    }
    if (f->reverse_mesh) put_list_head(w, "ReverseMesh Surface", &f->tag, 1, ";\n");
    const IntVec *in[2] = {&f->embedded_points, &f->embedded_curves};
    for (int k = 0; k < 2; k++) {
      if (!in[k]->len) continue;
      writer_str(w, k ? "Curve " : "Point ");
      if (k)
        unroll__curve_list(r, in[k]->data, in[k]->len);
      else
        unroll__ints(w, in[k]->data, in[k]->len);
      writer_printf(w, " In Surface {%d};\n", f->tag);
    }
  }
}

static void put_compounds(Writer *w, const Model *m)
{
  for (int dim = 1; dim <= 2; dim++)
    for (int index = 1; index <= m->ncompound[dim]; index++) {
      IntVec tag = {0};
      for (size_t i = 0; dim == 1 && i < model_curves(m); i++)
        if (model_curve_at(m, i)->compound == index) vec_push(&tag, model_curve_at(m, i)->tag);
      for (size_t i = 0; dim == 2 && i < model_faces(m); i++)
        if (model_face_at(m, i)->compound == index) vec_push(&tag, model_face_at(m, i)->tag);
      if (tag.len) put_list_head(w, dim == 1 ? "Compound Curve" : "Compound Surface", tag.data, tag.len, ";\n");
      vec_free(&tag);
    }
}

void unroll__mesh(Unroll *r)
{
  put_curve_attributes(r);
  put_face_attributes(r);
  put_compounds(r->w, r->m);
}
