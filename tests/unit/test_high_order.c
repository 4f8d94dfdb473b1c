// test_high_order.c - subdivision, high order and periodic pairs of meshes made by hand on a model of arcs
// SPDX-License-Identifier: MIT
#include "unit.h"

#include <string.h>

#include "mesh/high_order.h"
#include "mesh/jacobian.h"
#include "mesh/periodic.h"
#include "mesh/subdivide.h"
#include "model/model_edit.h"

static Diag *quiet(void) { return diag_new(false); }

// A disc of radius 1 in four arcs; points 1 (centre), 2 to 5 on the axes.
static Model *disc_model(Diag *diag)
{
  Model *m = model_new();
  model_add_point(m, 1, (Vec3){0, 0, 0}, 1, NO_LOC, diag);
  for (int k = 0; k < 4; k++) {
    const double x[] = {1, 0, -1, 0};
    model_add_point(m, 2 + k, (Vec3){x[k], x[(k + 3) % 4], 0}, 1, NO_LOC, diag);
  }
  int loop[4];
  for (int k = 0; k < 4; k++) {
    const int p[3] = {2 + k, 1, 2 + (k + 1) % 4};
    loop[k] = model_add_curve(m, CURVE_CIRCLE, 1 + k, p, 3, NULL, NULL, 0, NO_LOC, diag);
  }
  int l = model_add_loop(m, 1, loop, 4, NO_LOC, diag);
  model_add_face(m, FACE_PLANE, 1, &l, 1, NO_LOC, diag);
  assert_true(model_prepare(m, 1e-8, diag));
  return m;
}

// The disc in four triangles about the centre, or with n nodes inside each arc.
static Mesh *disc_mesh(const Model *m, int inside)
{
  Mesh *mesh = mesh_new();
  for (int t = 1; t <= 5; t++) mesh_add_entity(mesh, 0, t);
  for (int t = 1; t <= 4; t++) mesh_add_entity(mesh, 1, t);
  uint32_t face = mesh_add_entity(mesh, 2, 1);
  for (uint32_t t = 0; t < 5; t++) {
    mesh_add_node(mesh, model_point(m, (int)t + 1)->xyz, t, NAN);
    uint32_t b = mesh_add_block(mesh, t, ELEM_POINT, 1);
    mesh->block[b].node[0] = t;
  }
  U32Vec rim = {0};
  for (uint32_t k = 0; k < 4; k++) {
    uint32_t b = mesh_add_block(mesh, 5 + k, ELEM_LINE2, (size_t)inside + 1), last = 1 + k;
    for (int i = 1; i <= inside + 1; i++) {
      double u = i / (inside + 1.0);
      uint32_t next = i <= inside ? mesh_add_node(mesh, curve_point(m, model_curve_at(m, k), u), 5 + k, u) : 1 + (k + 1) % 4;
      mesh->block[b].node[2 * i - 2] = last;
      mesh->block[b].node[2 * i - 1] = next;
      vec_push(&rim, last);
      last = next;
    }
  }
  uint32_t b = mesh_add_block(mesh, face, ELEM_TRI3, rim.len);
  for (size_t i = 0; i < rim.len; i++) {
    uint32_t *to = mesh->block[b].node + 3 * i;
    to[0] = 0;
    to[1] = rim.data[i];
    to[2] = rim.data[(i + 1) % rim.len];
  }
  mesh_add_group(mesh, 2, 7, "disc");
  vec_push(&mesh->entity[face].physical, 7);
  vec_free(&rim);
  return mesh;
}

static void nodes_are_in_order_of_entities(const Mesh *m)
{
  for (size_t i = 1; i < m->nnode; i++) assert_true(m->node_entity[i - 1] <= m->node_entity[i]);
  for (size_t i = 0; i < m->nnode; i++)
    if (i > 0 && m->node_entity[i] == m->node_entity[i - 1] && m->entity[m->node_entity[i]].dim == 1)
      assert_true(m->node_u[i] > m->node_u[i - 1]);
}

static double area_of(const Mesh *m)
{
  double sum = 0;
  for (size_t i = 0; i < m->nblock; i++) {
    const MeshBlock *b = &m->block[i];
    if (elem_dim(b->type) != 2) continue;
    for (size_t k = 0; k < b->n; k++) {
      Vec3 x[4];
      for (int c = 0; c < elem_corners(b->type); c++) x[c] = mesh_xyz(m, b->node[k * (size_t)elem_nodes(b->type) + (size_t)c]);
      Vec3 n = corners_normal(x, elem_corners(b->type));
      assert_true(n.z > 0);
      sum += 0.5 * n.z;
    }
  }
  return sum;
}

static void on_circle(const Mesh *m)
{
  for (size_t i = 0; i < m->nnode; i++) {
    if (m->entity[m->node_entity[i]].dim != 1) continue;
    assert_true(fabs(vec3_length(mesh_xyz(m, (uint32_t)i)) - 1) < 1e-14);
  }
}

static void halving_keeps_to_the_curves(void **state)
{
  (void)state;
  Diag *diag = quiet();
  Model *model = disc_model(diag);
  Mesh *m = disc_mesh(model, 0);
  double last = area_of(m);
  for (int level = 1; level <= 4; level++) {
    Mesh *fine = mesh_subdivide(m, SUBDIVIDE_HALVE, model, NULL);
    mesh_free(m);
    m = fine;
    size_t n = (size_t)1 << level;
    assert_int_equal(mesh_count(m, 1), 4 * n);
    assert_int_equal(mesh_count(m, 2), 4 * n * n);
    nodes_are_in_order_of_entities(m);
    on_circle(m);
    double area = area_of(m), error = 3.14159265358979 - area;
    assert_true(error > 0 && error < 0.3 * (3.14159265358979 - last)); // a quarter each time
    last = area;
  }
  assert_string_equal(m->group[0].name, "disc");
  mesh_free(m);
  model_free(model);
  diag_free(diag);
}

static void subdivisions_have_the_counts_they_should(void **state)
{
  (void)state;
  Diag *diag = quiet();
  Model *model = disc_model(diag);
  Mesh *m = disc_mesh(model, 2); // 12 triangles, 13 nodes, 24 edges
  double area = area_of(m);
  Mesh *quads = mesh_subdivide(m, SUBDIVIDE_QUADS, NULL, NULL);
  assert_int_equal(mesh_count_corners(quads, 4), 36);
  assert_int_equal(mesh_count_corners(quads, 3), 0);
  assert_int_equal(quads->nnode, 13 + 24 + 12);
  assert_int_equal(mesh_count(quads, 1), 24);
  assert_true(fabs(area_of(quads) - area) < 1e-14);
  Mesh *again = mesh_subdivide(quads, SUBDIVIDE_HALVE, NULL, NULL);
  assert_int_equal(mesh_count_corners(again, 4), 144);
  assert_true(fabs(area_of(again) - area) < 1e-13);
  Mesh *bary = mesh_subdivide(m, SUBDIVIDE_BARYCENTRIC, model, NULL);
  assert_int_equal(mesh_count_corners(bary, 3), 36);
  assert_int_equal(mesh_count(bary, 1), 12);
  assert_int_equal(bary->nnode, 25);
  assert_true(fabs(area_of(bary) - area) < 1e-14);
  nodes_are_in_order_of_entities(quads);
  nodes_are_in_order_of_entities(bary);
  mesh_free(m);
  mesh_free(quads);
  mesh_free(again);
  mesh_free(bary);
  model_free(model);
  diag_free(diag);
}

static void every_order_curves_and_unfolds(void **state)
{
  (void)state;
  Diag *diag = quiet();
  Model *model = disc_model(diag);
  for (int order = 1; order <= 4; order++)
    for (int incomplete = 0; incomplete <= 1; incomplete++)
      for (int quads = 0; quads <= 1; quads++) {
        Mesh *m = disc_mesh(model, 1);
        if (quads) {
          Mesh *q = mesh_subdivide(m, SUBDIVIDE_QUADS, model, NULL);
          mesh_free(m);
          m = q;
        }
        HighOrder how = {.order = order, .incomplete = incomplete};
        HighOrderReport r;
        Mesh *high = mesh_set_order(m, &how, model, &r, diag);
        nodes_are_in_order_of_entities(high);
        on_circle(high);
        if (order > 1) assert_true(r.min_jacobian > 0);
        assert_int_equal(r.straightened, 0);
        assert_int_equal(mesh_count(high, 2), mesh_count(m, 2));
        assert_int_equal(elem_order(high->block[high->nblock - 1].type), order);
        Mesh *low = mesh_set_order(high, &(HighOrder){.order = 1}, model, &r, diag);
        assert_int_equal(low->nnode, m->nnode);
        assert_memory_equal(low->xyz, m->xyz, 3 * m->nnode * sizeof *m->xyz);
        mesh_free(low);
        mesh_free(high);
        mesh_free(m);
      }
  assert_int_equal(diag_warnings(diag), 0);
  model_free(model);
  diag_free(diag);
}

// A ring of thin cells along the arcs, thinner than the arcs rise over their chords: folded unless the layers follow.
static void thin_layers_follow_their_curve(void **state)
{
  (void)state;
  Diag *diag = quiet();
  Model *model = disc_model(diag);
  Mesh *mesh = mesh_new();
  for (int t = 1; t <= 5; t++) mesh_add_entity(mesh, 0, t);
  for (int t = 1; t <= 4; t++) mesh_add_entity(mesh, 1, t);
  uint32_t face = mesh_add_entity(mesh, 2, 1);
  for (uint32_t t = 0; t < 5; t++) mesh_add_node(mesh, model_point(model, (int)t + 1)->xyz, t, NAN);
  for (uint32_t k = 0; k < 4; k++) {
    uint32_t b = mesh_add_block(mesh, 5 + k, ELEM_LINE2, 1);
    mesh->block[b].node[0] = 1 + k;
    mesh->block[b].node[1] = 1 + (k + 1) % 4;
  }
  enum { LAYERS = 24 };
  uint32_t ring[4] = {1, 2, 3, 4}, cell[4 * 4 * LAYERS], *to = cell;
  for (int l = 1; l <= LAYERS; l++) {
    uint32_t next[4];
    for (uint32_t k = 0; k < 4; k++)
      next[k] = mesh_add_node(mesh, vec3_scale(1 + 0.02 * l * l, mesh_xyz(mesh, 1 + k)), face, NAN);
    for (uint32_t k = 0; k < 4; k++) {
      *to++ = ring[k];
      *to++ = next[k];
      *to++ = next[(k + 1) % 4];
      *to++ = ring[(k + 1) % 4];
    }
    memcpy(ring, next, sizeof ring);
  }
  uint32_t b = mesh_add_block(mesh, face, ELEM_QUAD4, 4 * LAYERS);
  memcpy(mesh->block[b].node, cell, sizeof cell);
  for (int order = 2; order <= 4; order++) {
    HighOrder how = {.order = order};
    HighOrderReport r;
    Mesh *high = mesh_set_order(mesh, &how, model, &r, diag);
    assert_true(r.folded > 0);
    assert_true(r.min_jacobian > 0);
    assert_int_equal(r.straightened, 0);
    on_circle(high);
    mesh_free(high);
  }
  mesh_free(mesh);
  model_free(model);
  diag_free(diag);
}

static void periodic_pairs_survive(void **state)
{
  (void)state;
  Diag *diag = quiet();
  Model *model = disc_model(diag);
  const int slave = 3, master = 1;
  Affine turn = affine_rotation((Vec3){0, 0, 1}, (Vec3){0, 0, 0}, 3.14159265358979323846);
  assert_true(model_set_periodic_curves(model, &slave, &master, 1, &turn, NO_LOC, diag));
  assert_true(model_prepare(model, 1e-8, diag));
  Mesh *m = disc_mesh(model, 3);
  periodic_add(m, model, diag);
  assert_int_equal(m->nperiodic, 3); // two points and the curve
  Mesh *fine = mesh_subdivide(m, SUBDIVIDE_HALVE, model, NULL);
  HighOrder how = {.order = 3};
  HighOrderReport r;
  Mesh *high = mesh_set_order(fine, &how, model, &r, diag);
  const Mesh *all[] = {m, fine, high};
  const size_t count[] = {5, 9, 25};
  for (size_t k = 0; k < 3; k++) {
    const MeshPeriodic *p = &all[k]->periodic[2];
    assert_int_equal(p->slave_node.len, count[k]);
    for (size_t i = 0; i < p->slave_node.len; i++) {
      Vec3 image = periodic_image(p->affine, mesh_xyz(all[k], p->master_node.data[i]));
      Vec3 there = mesh_xyz(all[k], p->slave_node.data[i]);
      assert_true(vec3_distance(image, there) < 1e-14);
      if (all[k]->entity[all[k]->node_entity[p->slave_node.data[i]]].dim == 1)
        assert_memory_equal(&image, &there, sizeof image);
    }
  }
  mesh_free(m);
  mesh_free(fine);
  mesh_free(high);
  model_free(model);
  diag_free(diag);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(halving_keeps_to_the_curves),
      cmocka_unit_test(subdivisions_have_the_counts_they_should),
      cmocka_unit_test(every_order_curves_and_unfolds),
      cmocka_unit_test(thin_layers_follow_their_curve),
      cmocka_unit_test(periodic_pairs_survive),
  };
  return unit_run(tests);
}
