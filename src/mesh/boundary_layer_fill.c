// boundary_layer_fill.c - from planned columns to nodes, cells and the graph of the rest of the face
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/boundary_layer_int.h"

// Elements go to growing arrays that become those of the face.
typedef struct {
  const BoundaryLayers *b;
  const FaceLayers *f;
  const Mesh1d *curves;
  const EdgeNodes *en;
  const Face *face;
  FaceMesh *out;
  Vec(Vec3) own;
  DoubleVec own_xy; // in the plane
  U32Vec tri, quad;
  DoubleVec height; // of the column at hand
} Filler;

static const FaceLayers *layers_of(const BoundaryLayers *b, size_t k)
{
  for (size_t i = 0; b && i < b->nface; i++)
    if (b->face[i].face == k) return &b->face[i];
  return NULL;
}

static bool alive(const FaceLayers *f)
{
  for (size_t j = 0; j < f->chain.len; j++)
    if (!f->chain.data[j].dropped) return true;
  return false;
}

bool boundary_layers_on(const BoundaryLayers *b, size_t k)
{
  const FaceLayers *f = layers_of(b, k);
  return f && alive(f);
}

// ---- nodes -------------------------------------------------------------------------------------------------------------
static uint32_t node_on_curve(const Filler *f, uint32_t curve, bool from_end, size_t i)
{
  size_t n = f->curves->curve[curve].n;
  return edge_nodes_at(f->en, f->curves->model, f->curves, curve, from_end ? n - 1 - i : i);
}

// Columns without height. Where quadrangles only are wanted a column between two of them has no cell of four corners: it is left out, too.
static bool *flat_columns(const Chain *c)
{
  size_t ncol = c->col.len;
  bool *flat = mem_alloc(ncol * sizeof *flat);
  for (size_t i = 0; i < ncol; i++) flat[i] = c->col.data[i].collapsed || !(c->col.data[i].s > 0);
  for (size_t i = 0; i < ncol && c->quads; i++) {
    bool before = !c->closed && i == 0 ? true : flat[(i + ncol - 1) % ncol];
    bool after = !c->closed && i + 1 == ncol ? true : flat[(i + 1) % ncol];
    flat[i] |= before && after && c->col.data[i].on == NONE;
  }
  return flat;
}

// Ids of the nodes of a column: n + 1 of them from its base to its top.
static void column_nodes(Filler *f, const Chain *c, const Column *k, bool flat, uint32_t *id)
{
  size_t n = c->field->height.len;
  column__heights(c->field, k->first, k->s, f->height.data);
  id[0] = edge_nodes_at(f->en, f->curves->model, f->curves, k->curve, k->index);
  for (size_t i = 1; i <= n; i++) {
    if (flat) {
      id[i] = id[0];
    } else if (k->on != NONE) {
      id[i] = node_on_curve(f, k->on, k->on_end, i);
    } else {
      Vec2 q = vec2_add(k->base, vec2_scale(f->height.data[i - 1], k->dir));
      id[i] = (uint32_t)(f->en->n + f->own.len);
      vec_push(&f->own, face_from_plane(f->face, q));
      vec_push(&f->own_xy, q.x);
      vec_push(&f->own_xy, q.y);
    }
  }
}

// ---- cells --------------------------------------------------------------------------------------------------------------
static Vec3 place(const Filler *f, uint32_t id) { return id < f->en->n ? f->en->xyz[id] : f->own.data[id - f->en->n]; }

static void push_triangle(Filler *f, uint32_t a, uint32_t b, uint32_t c)
{
  vec_push(&f->tri, a);
  vec_push(&f->tri, b);
  vec_push(&f->tri, c);
}

static void push_cell(Filler *f, const uint32_t v[4], bool quads)
{
  uint32_t p[4];
  int n = 0;
  for (int i = 0; i < 4; i++)
    if (v[i] != v[(i + 1) % 4]) p[n++] = v[i];
  if (n == 3) push_triangle(f, p[0], p[1], p[2]);
  if (n != 4) return;
  if (quads) {
    for (int i = 0; i < 4; i++) vec_push(&f->quad, p[i]);
    return;
  }
  // The shorter diagonal; the one from the first corner of equal ones.
  if (vec3_distance(place(f, p[0]), place(f, p[2])) <= vec3_distance(place(f, p[1]), place(f, p[3]))) {
    push_triangle(f, p[0], p[1], p[2]);
    push_triangle(f, p[0], p[2], p[3]);
  } else {
    push_triangle(f, p[0], p[1], p[3]);
    push_triangle(f, p[1], p[2], p[3]);
  }
}

static void fill_chain(Filler *f, const Chain *c, FaceGraph *g);

// ---- the rest of the face ------------------------------------------------------------------------------------------------
static uint32_t graph_vertex(FaceGraph *g, const Filler *f, uint32_t node)
{
  bool added;
  uint32_t *slot = map_slot(&g->local, node, (uint32_t)g->node.len, &added);
  if (added) {
    Vec2 q;
    if (node < f->en->n)
      q = face_to_plane(f->face, f->en->xyz[node]);
    else
      q = (Vec2){f->own_xy.data[2 * (node - f->en->n)], f->own_xy.data[2 * (node - f->en->n) + 1]};
    vec_push(&g->node, node);
    vec_push(&g->xy, q.x);
    vec_push(&g->xy, q.y);
  }
  return *slot;
}

static void add_segment(FaceGraph *g, const Filler *f, uint32_t a, uint32_t b, int curve, bool embedded)
{
  if (a == b) return;
  uint32_t va = graph_vertex(g, f, a), vb = graph_vertex(g, f, b);
  vec_push(&g->ends, va);
  vec_push(&g->ends, vb);
  vec_push(&g->curve, curve);
  vec_push(&g->embedded, embedded);
}

// The nodes of all columns of a chain, and what becomes of them.
typedef struct {
  const Chain *chain;
  uint32_t *id;     // n + 1 of each column
  uint8_t *sides;   // by column: on how many sides it bounds the rest of the face
  bool *tip;        // by cell: its triangle at the tip of a fan is half of a quadrangle that the cell before has made
  size_t n;         // layers
} Filling;

static const uint32_t *column_ids(const Filling *w, size_t i) { return w->id + i % w->chain->col.len * (w->n + 1); }

// The triangles at the tip of a fan of the cells i and i+1, as one quadrangle.
static bool join_tips(Filler *f, const Filling *w, size_t i)
{
  if (i + 1 >= chain__cells(w->chain)) return false;
  const uint32_t *a = column_ids(w, i), *b = column_ids(w, i + 1), *c = column_ids(w, i + 2);
  if (a[0] != b[0] || b[0] != c[0] || a[0] == a[1] || b[0] == b[1] || c[0] == c[1]) return false;
  const uint32_t quad[4] = {a[0], c[1], b[1], a[1]};
  push_cell(f, quad, true);
  w->tip[i + 1] = true;
  return true;
}

// The cells between the columns i and i+1 are left to the rest of the face.
static void leave_cells(Filler *f, const Filling *w, size_t i, int tag, FaceGraph *g)
{
  add_segment(g, f, column_ids(w, i)[0], column_ids(w, i + 1)[0], tag, false);
  w->sides[i % w->chain->col.len]++;
  w->sides[(i + 1) % w->chain->col.len]++;
}

// Cells between the columns i and i+1. Beside a column without height they are triangles that become ever thinner: where
// quadrangles only are wanted that corner is left to the rest of the face, and so is a cell of a fan whose tip has no other half.
static void fill_cells(Filler *f, const Filling *w, size_t i, FaceGraph *g)
{
  const Chain *c = w->chain;
  const uint32_t *a = column_ids(w, i), *b = column_ids(w, i + 1);
  int tag = model_curve_at(f->curves->model, c->col.data[i].curve)->tag;
  bool flat_a = a[0] == a[w->n], flat_b = b[0] == b[w->n];
  bool tip = w->tip[i] || (c->quads && join_tips(f, w, i));
  if (c->quads && !tip && (flat_a != flat_b || (a[0] == b[0] && !flat_a))) {
    leave_cells(f, w, i, tag, g);
    return;
  }
  for (size_t k = tip; k < w->n; k++) {
    const uint32_t v[4] = {a[k], b[k], b[k + 1], a[k + 1]};
    push_cell(f, v, c->field->quads || c->quads);
  }
  add_segment(g, f, a[w->n], b[w->n], tag, false);
}

static void fill_chain(Filler *f, const Chain *c, FaceGraph *g)
{
  size_t n = c->field->height.len, ncol = c->col.len;
  Filling w = {.chain = c, .n = n, .id = mem_alloc(ncol * (n + 1) * sizeof *w.id), .sides = mem_zalloc(ncol),
               .tip = mem_zalloc((ncol + 1) * sizeof *w.tip)};
  bool *flat = flat_columns(c);
  vec_resize(&f->height, n);
  for (size_t i = 0; i < ncol; i++) {
    column_nodes(f, c, &c->col.data[i], flat[i], w.id + i * (n + 1));
    w.sides[i] += c->col.data[i].open;
  }
  for (size_t i = 0; i < chain__cells(c); i++) fill_cells(f, &w, i, g);
  for (size_t i = 0; i < ncol; i++) {
    if (!w.sides[i]) continue;
    const uint32_t *a = column_ids(&w, i);
    int tag = model_curve_at(f->curves->model, c->col.data[i].curve)->tag;
    for (size_t k = 0; k < n; k++) add_segment(g, f, a[k], a[k + 1], tag, w.sides[i] == 2);
  }
  free(w.id);
  free(w.sides);
  free(w.tip);
  free(flat);
}

// Nodes at the two ends of each curve that columns have taken.
typedef struct {
  uint32_t *skip;  // per curve and end: edges to leave out; NONE - 1 at the begin: all of them
  uint8_t *column; // per curve and end: columns there. An embedded curve with a column on one side bounds the rest on the other
} Taken;
#define ALL (NONE - 1)

typedef struct {
  FaceGraph *g;
  const Filler *f;
  const Taken *taken;
} Rest;

static void add_curve(void *ctx, int tag, bool embedded)
{
  const Rest *r = ctx;
  const uint32_t *skip = r->taken->skip;
  uint32_t k = mesh1d_index(r->f->curves, tag);
  size_t n = r->f->curves->curve[k].n;
  if (n < 2 || skip[2 * k] == ALL) return;
  bool one_sided[2] = {embedded && r->taken->column[2 * k] == 1, embedded && r->taken->column[2 * k + 1] == 1};
  for (size_t i = 0; i + 1 < n; i++) {
    bool at_begin = i < skip[2 * k], at_end = i + 1 + skip[2 * k + 1] >= n;
    if ((at_begin && !one_sided[0]) || (at_end && !one_sided[1])) continue;
    add_segment(r->g, r->f, node_on_curve(r->f, k, false, i), node_on_curve(r->f, k, false, i + 1), abs(tag),
                embedded && !at_begin && !at_end);
  }
}

static void add_point(void *ctx, uint32_t node)
{
  const Rest *r = ctx;
  graph_vertex(r->g, r->f, node);
}

static void mark_taken(const Filler *f, Taken *t)
{
  t->skip = mem_zalloc(2 * (f->curves->ncurve + 1) * sizeof *t->skip);
  t->column = mem_zalloc(2 * (f->curves->ncurve + 1) * sizeof *t->column);
  for (size_t j = 0; j < f->f->chain.len; j++) {
    const Chain *c = &f->f->chain.data[j];
    if (c->dropped) continue;
    for (size_t i = 0; i < c->col.len; i++) {
      const Column *k = &c->col.data[i];
      t->skip[2 * k->curve] = ALL;
      if (k->on == NONE || !(k->s > 0)) continue;
      t->skip[2 * k->on + k->on_end] = (uint32_t)c->field->height.len;
      t->column[2 * k->on + k->on_end]++;
    }
  }
}

void boundary_layers_fill(const BoundaryLayers *b, size_t k, const Mesh1d *curves, const EdgeNodes *en, FaceMesh *out, FaceGraph *g)
{
  Filler f = {.b = b, .f = layers_of(b, k), .curves = curves, .en = en, .face = model_face_at(curves->model, k), .out = out};
  Taken taken;
  mark_taken(&f, &taken);
  for (size_t j = 0; j < f.f->chain.len; j++)
    if (!f.f->chain.data[j].dropped) fill_chain(&f, &f.f->chain.data[j], g);
  static const FaceVisitor visitor = {add_curve, add_point};
  Rest rest = {g, &f, &taken};
  face_graph_visit(curves->model, f.face, &visitor, &rest);
  free(taken.skip);
  free(taken.column);
  vec_free(&f.own_xy);
  vec_free(&f.height);
  out->own = f.own.data;
  out->nown = f.own.len;
  out->tri = f.tri.data;
  out->ntri = f.tri.len / 3;
  out->quad = f.quad.data;
  out->nquad = f.quad.len / 4;
}
