// periodic.c - pairs of nodes on periodic curves
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/periodic.h"

Vec3 periodic_image(const double a[16], Vec3 p)
{
  return (Vec3){a[0] * p.x + a[1] * p.y + a[2] * p.z + a[3], a[4] * p.x + a[5] * p.y + a[6] * p.z + a[7],
                a[8] * p.x + a[9] * p.y + a[10] * p.z + a[11]};
}

void periodic_place(Mesh *m, const double affine[16], uint32_t slave, uint32_t master)
{
  Vec3 p = periodic_image(affine, mesh_xyz(m, master));
  m->xyz[3 * (size_t)slave] = p.x;
  m->xyz[3 * (size_t)slave + 1] = p.y;
  m->xyz[3 * (size_t)slave + 2] = p.z;
}

// The nodes along a curve from its begin to its end.
static U32Vec nodes_along(const Mesh *m, int tag, bool reversed_elements)
{
  U32Vec node = {0};
  uint32_t entity = mesh_find_entity(m, 1, tag);
  for (size_t i = 0; i < m->nblock; i++) {
    const MeshBlock *b = &m->block[i];
    if (b->entity != entity || elem_dim(b->type) != 1) continue;
    for (size_t k = 0; k < b->n; k++) {
      if (k == 0) vec_push(&node, b->node[reversed_elements]);
      vec_push(&node, b->node[2 * k + !reversed_elements]);
    }
  }
  return node;
}

static void set_affine(MeshPeriodic *p, const double *affine)
{
  p->has_affine = affine != NULL;
  for (int k = 0; k < 16; k++) p->affine[k] = affine ? affine[k] : k % 5 == 0;
}

static void add_curve(Mesh *mesh, const Model *model, const Curve *c, Diag *diag)
{
  const Curve *master = model_curve(model, c->periodic_master);
  if (!master) return;
  U32Vec mine = nodes_along(mesh, c->tag, c->reverse_mesh), theirs = nodes_along(mesh, master->tag, master->reverse_mesh);
  if (mine.len != theirs.len)
    diag_warning(diag, c->loc, "curve %d has %zu nodes, its periodic master %d has %zu: no pairs are written", c->tag,
                 mine.len, master->tag, theirs.len);
  if (mine.len && mine.len == theirs.len) {
    MeshPeriodic *p = mesh_add_periodic(mesh, 1, c->tag, master->tag);
    set_affine(p, c->affine);
    for (size_t i = 0; i < mine.len; i++) {
      uint32_t m = theirs.data[c->periodic_master < 0 ? theirs.len - 1 - i : i];
      vec_push(&p->slave_node, mine.data[i]);
      vec_push(&p->master_node, m);
    }
  }
  vec_free(&mine);
  vec_free(&theirs);
}

// How many masters stand between a curve and one that is nobody's slave (a ring of masters counts as far as it was followed).
static size_t depth_of(const Model *model, const Curve *c)
{
  size_t depth = 0;
  while (c && c->periodic_master && depth <= model_curves(model)) {
    c = model_curve(model, c->periodic_master);
    depth++;
  }
  return depth;
}

// Interior nodes of slaves to the images of their masters', masters first.
static void place_all(Mesh *mesh, const Model *model, size_t first)
{
  size_t deepest = 0;
  for (size_t k = 0; k < model_curves(model); k++) deepest = MAX(deepest, depth_of(model, model_curve_at(model, k)));
  for (size_t d = 1; d <= deepest; d++)
    for (size_t r = first; r < mesh->nperiodic; r++) {
      const MeshPeriodic *p = &mesh->periodic[r];
      if (!p->has_affine || p->dim != 1 || depth_of(model, model_curve(model, p->tag)) != d) continue;
      for (size_t i = 1; i + 1 < p->slave_node.len; i++)
        periodic_place(mesh, p->affine, p->slave_node.data[i], p->master_node.data[i]);
    }
}

typedef struct {
  int slave, master;
  const double *affine;
} PointPair;
typedef Vec(PointPair) PointPairs;

static void add_pair(PointPairs *pairs, int slave, int master, const double *affine)
{
  if (slave == master) return;
  for (size_t i = 0; i < pairs->len; i++)
    if (pairs->data[i].slave == slave) return; // the first curve that says so wins
  vec_push(pairs, ((PointPair){slave, master, affine}));
}

static int compare_pairs(const void *a, const void *b)
{
  const PointPair *x = a, *y = b;
  return (x->slave > y->slave) - (x->slave < y->slave);
}

void periodic_add(Mesh *mesh, const Model *model, Diag *diag)
{
  PointPairs pairs = {0};
  size_t before = mesh->nperiodic;
  for (size_t k = 0; k < model_curves(model); k++) {
    const Curve *c = model_curve_at(model, k), *master;
    if (!c->periodic_master || !(master = model_curve(model, c->periodic_master))) continue;
    bool turned = c->periodic_master < 0;
    add_pair(&pairs, c->begin, turned ? master->end : master->begin, c->affine);
    add_pair(&pairs, c->end, turned ? master->begin : master->end, c->affine);
  }
  if (pairs.len) qsort(pairs.data, pairs.len, sizeof *pairs.data, compare_pairs);
  for (size_t i = 0; i < pairs.len; i++) {
    uint32_t slave = mesh_find_entity(mesh, 0, pairs.data[i].slave), master = mesh_find_entity(mesh, 0, pairs.data[i].master);
    if (slave == NONE || master == NONE) continue;
    MeshPeriodic *p = mesh_add_periodic(mesh, 0, pairs.data[i].slave, pairs.data[i].master);
    set_affine(p, pairs.data[i].affine);
    vec_push(&p->slave_node, slave); // the node of the k-th point is k, and so is its entity
    vec_push(&p->master_node, master);
  }
  for (size_t k = 0; k < model_curves(model); k++) {
    const Curve *c = model_curve_at(model, k);
    if (c->periodic_master) add_curve(mesh, model, c, diag);
  }
  place_all(mesh, model, before);
  vec_free(&pairs);
}
