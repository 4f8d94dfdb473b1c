// test_partition.c - parts of meshes: complete, balanced, the cut counted anew; what lies between them
// SPDX-License-Identifier: MIT
#include "unit.h"

#include "base/map.h"
#include "mesh/mesh_hash.h"
#include "mesh/mesh_join.h"
#include "mesh/part_entities.h"
#include "mesh/partition.h"
#include "mesh/partition_stats.h"

#include "mesh_sample.h"

static bool partition(Mesh *m, int n, int algorithm)
{
  Options o;
  Diag *d = diag_new(false);
  options_init(&o);
  o.Mesh_MetisAlgorithm = algorithm;
  bool good = mesh_partition(m, n, &o, d);
  assert_int_equal(diag_errors(d), !good);
  options_free(&o);
  diag_free(d);
  return good;
}

// The part of each element of dimension 2 on an edge, found the slow way.
static U32Vec parts_on_edge(const Mesh *m, uint32_t a, uint32_t b)
{
  U32Vec found = {0};
  for (size_t k = 0; k < m->nblock; k++) {
    const MeshBlock *q = &m->block[k];
    int n = elem_corners(q->type);
    for (size_t i = 0; elem_dim(q->type) == 2 && i < q->n; i++) {
      const uint32_t *v = q->node + i * (size_t)elem_nodes(q->type);
      for (int c = 0; c < n; c++)
        if (map_pair(v[c], v[(c + 1) % n]) == map_pair(a, b)) vec_push(&found, q->part[i]);
    }
  }
  return found;
}

static size_t count_cut(const Mesh *m)
{
  Map first = {0};
  size_t cut = 0;
  for (size_t k = 0; k < m->nblock; k++) {
    const MeshBlock *q = &m->block[k];
    int n = elem_corners(q->type);
    for (size_t i = 0; elem_dim(q->type) == 2 && i < q->n; i++) {
      const uint32_t *v = q->node + i * (size_t)elem_nodes(q->type);
      for (int c = 0; c < n; c++) {
        bool added;
        uint32_t *part = map_slot(&first, map_pair(v[c], v[(c + 1) % n]), q->part[i], &added);
        cut += !added && *part != q->part[i];
      }
    }
  }
  map_free(&first);
  return cut;
}

static void balanced_and_counted(void **state)
{
  (void)state;
  static const int parts[] = {2, 3, 7, 16};
  for (int kind = 0; kind < 16; kind++) {
    Mesh *m = sample_mesh(24, false, kind & 1);
    int n = parts[kind / 4], algorithm = 1 + kind / 2 % 2;
    assert_true(partition(m, n, algorithm));
    PartitionStats s;
    partition_stats_make(&s, m);
    assert_int_equal(s.n, n);
    assert_true(s.imbalance < 0.05);
    assert_true(s.least > 0);
    assert_int_equal(s.cut, count_cut(m));
    assert_int_equal(s.pieces, n);
    size_t elements = 0, cut = 0;
    for (uint32_t k = 0; k < s.n; k++) {
      elements += s.part[k].elements;
      cut += s.part[k].cut;
    }
    assert_int_equal(elements, mesh_count(m, 2));
    assert_int_equal(cut, 2 * s.cut);
    partition_stats_free(&s);
    mesh_free(m);
  }
}

static void lines_go_with_a_neighbour(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(8, false, true);
  assert_true(partition(m, 5, 0));
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; elem_dim(m->block[b].type) == 1 && i < m->block[b].n; i++) {
      U32Vec beside = parts_on_edge(m, m->block[b].node[2 * i], m->block[b].node[2 * i + 1]);
      bool found = false;
      for (size_t k = 0; k < beside.len; k++) found |= beside.data[k] == m->block[b].part[i];
      assert_true(found);
      vec_free(&beside);
    }
  mesh_free(m);
}

static void the_same_again(void **state)
{
  (void)state;
  Mesh *a = sample_mesh(20, true, true), *b = sample_mesh(20, true, true);
  assert_true(partition(a, 9, 2));
  assert_true(partition(b, 4, 1));
  assert_true(partition(b, 9, 2));
  for (size_t k = 0; k < a->nblock; k++)
    assert_memory_equal(a->block[k].part, b->block[k].part, a->block[k].n * sizeof(uint32_t));
  assert_true(partition(b, 1, 0));
  assert_int_equal(b->nparts, 0);
  assert_null(b->block[0].part);
  mesh_free(a);
  mesh_free(b);
}

static void as_many_parts_as_elements(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(3, false, false);
  assert_false(partition(m, 37, 0));
  assert_int_equal(m->nparts, 0);
  for (int n = 20; n <= 36; n++) { // METIS leaves parts empty
    assert_true(partition(m, n, 1 + n % 2));
    PartitionStats s;
    partition_stats_make(&s, m);
    assert_true(s.least >= 1);
    partition_stats_free(&s);
  }
  mesh_free(m);
}

static void weights(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(24, false, true); // 1152 triangles and 576 quadrangles
  Options o;
  options_init(&o);
  o.Mesh_PartitionQuadWeight = 6;
  o.Mesh_PartitionTriWeight = 1;
  Diag *d = diag_new(false);
  assert_true(mesh_partition(m, 4, &o, d));
  PartitionStats s;
  partition_stats_make(&s, m);
  for (uint32_t k = 0; k < 4; k++) assert_in_range(s.part[k].triangles + 6 * s.part[k].quads, 1100, 1210);
  partition_stats_free(&s);
  options_free(&o);
  diag_free(d);
  mesh_free(m);
}

// ---- ghosts ------------------------------------------------------------
static bool share_a_node(const Mesh *m, const MeshBlock *a, size_t i, const MeshBlock *b, size_t j)
{
  (void)m;
  for (int p = 0; p < elem_corners(a->type); p++)
    for (int q = 0; q < elem_corners(b->type); q++)
      if (a->node[i * (size_t)elem_nodes(a->type) + (size_t)p] ==
          b->node[j * (size_t)elem_nodes(b->type) + (size_t)q])
        return true;
  return false;
}

static void ghosts_are_neighbours_over_nodes(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(6, false, true);
  assert_true(partition(m, 5, 0));
  Ghosts g;
  ghosts_make(&g, m);
  size_t at = 0;
  for (uint32_t b = 0; b < m->nblock; b++)
    for (uint32_t i = 0; elem_dim(m->block[b].type) == 2 && i < m->block[b].n; i++) {
      bool seen[6] = {false};
      for (size_t c = 0; c < m->nblock; c++)
        for (size_t j = 0; elem_dim(m->block[c].type) == 2 && j < m->block[c].n; j++)
          if (share_a_node(m, &m->block[b], i, &m->block[c], j)) seen[m->block[c].part[j]] = true;
      seen[m->block[b].part[i]] = false;
      uint32_t n = 0;
      for (uint32_t k = 1; k <= 5; k++) {
        if (!seen[k]) continue;
        assert_true(at < g.cell.len && g.cell.data[at].block == b && g.cell.data[at].index == i);
        assert_int_equal(g.part.data[g.cell.data[at].first + n++], k);
      }
      if (!n) continue;
      assert_int_equal(g.cell.data[at].n, n);
      at++;
    }
  assert_int_equal(at, g.cell.len);
  ghosts_free(&g);
  mesh_free(m);
}

// ---- entities of parts ------------------------------------------------------------
static bool has_part(const MeshEntity *e, uint32_t part)
{
  for (size_t i = 0; i < e->parts.len; i++)
    if ((uint32_t)e->parts.data[i] == part) return true;
  return false;
}

// Toggle the edge in the set: what is left are edges seen an odd number of times.
static void toggle(Map *set, U32Vec *node, uint32_t a, uint32_t b)
{
  uint32_t *count = map_slot(set, map_pair(a, b), 0, &(bool){false});
  ++*count;
  vec_push(node, a);
  vec_push(node, b);
}

// The edges that bound a piece of a surface are just those of the curves it lists.
static void check_bounds(const Mesh *d, uint32_t surface)
{
  Map own = {0}, listed = {0};
  U32Vec own_node = {0}, listed_node = {0};
  for (size_t b = 0; b < d->nblock; b++) {
    const MeshBlock *k = &d->block[b];
    int n = elem_corners(k->type);
    for (size_t i = 0; k->entity == surface && i < k->n; i++)
      for (int c = 0; c < n; c++)
        toggle(&own, &own_node, k->node[i * (size_t)n + (size_t)c],
               k->node[i * (size_t)n + (size_t)((c + 1) % n)]);
  }
  const IntVec *bound = &d->entity[surface].boundary;
  for (size_t i = 0; i < bound->len; i++) {
    uint32_t curve = mesh_find_entity(d, 1, abs(bound->data[i]));
    assert_true(curve != NONE);
    for (size_t b = 0; b < d->nblock; b++)
      for (size_t j = 0; d->block[b].entity == curve && j < d->block[b].n; j++)
        toggle(&listed, &listed_node, d->block[b].node[2 * j], d->block[b].node[2 * j + 1]);
  }
  for (size_t i = 0; i < own_node.len; i += 2) {
    uint64_t key = map_pair(own_node.data[i], own_node.data[i + 1]);
    assert_int_equal(map_get(&own, key) % 2, map_get(&listed, key) != NONE);
  }
  for (size_t i = 0; i < listed_node.len; i += 2)
    assert_int_equal(map_get(&own, map_pair(listed_node.data[i], listed_node.data[i + 1])), 1);
  map_free(&own);
  map_free(&listed);
  vec_free(&own_node);
  vec_free(&listed_node);
}

// A curve runs from its first point to its second: their nodes are the only ones that one line alone has. Or
// both are the same.
static void check_ends(const Mesh *d, uint32_t curve)
{
  uint32_t *uses = mem_zalloc(d->nnode * sizeof *uses);
  for (size_t b = 0; b < d->nblock; b++)
    for (size_t i = 0; d->block[b].entity == curve && i < 2 * d->block[b].n; i++) uses[d->block[b].node[i]]++;
  const IntVec *ends = &d->entity[curve].boundary;
  assert_true(ends->len == 0 || (ends->len == 2 && ends->data[0] > 0 && ends->data[1] < 0));
  for (size_t k = 0; ends->len && ends->data[0] != -ends->data[1] && k < 2; k++) {
    uint32_t point = mesh_find_entity(d, 0, abs(ends->data[k])), b = 0;
    assert_true(point != NONE);
    while (b < d->nblock && d->block[b].entity != point) b++;
    assert_true(b < d->nblock);
    uses[d->block[b].node[0]]++;
  }
  for (size_t v = 0; v < d->nnode; v++) assert_true(uses[v] == 0 || uses[v] == 2);
  free(uses);
}

static void check_seam(const Mesh *m, const Mesh *d, const MeshBlock *k)
{
  const MeshEntity *e = &d->entity[k->entity];
  assert_int_equal(e->parent_dim, 2);
  for (size_t i = 0; i < k->n; i++) {
    U32Vec beside = parts_on_edge(m, k->node[2 * i], k->node[2 * i + 1]);
    assert_int_equal(beside.len, 2);
    assert_int_equal(e->parts.len, 2);
    for (size_t j = 0; j < 2; j++) assert_true(has_part(e, beside.data[j]));
    assert_true(beside.data[0] != beside.data[1]);
    vec_free(&beside);
  }
}

// Parts as nobody would choose them: a face each, or anything anywhere, so that parts touch in single nodes.
static void part_by_hand(Mesh *m, int n, Rng *random)
{
  m->nparts = (uint32_t)n;
  for (size_t b = 0; b < m->nblock; b++) {
    MeshBlock *k = &m->block[b];
    k->part = mem_zalloc(k->n * sizeof *k->part);
    for (size_t i = 0; elem_dim(k->type) == 2 && i < k->n; i++)
      k->part[i] = random ? 1 + (uint32_t)(rng_double(random) * n) : k->entity == m->nentity - 1 ? 2 : 1;
  }
  assert_true(mesh_complete_parts(m));
}

static void pieces_conform(void **state)
{
  (void)state;
  Rng random = {3};
  for (int kind = 0; kind < 24; kind++) {
    Mesh *m = sample_mesh(7, kind & 1, kind & 2);
    if (kind < 12)
      assert_true(partition(m, 3 + 5 * (kind / 4), 1 + kind % 2));
    else
      part_by_hand(m, 2 + kind / 20, kind < 16 ? NULL : &random);
    Mesh *d = mesh_part_entities(m, &(PartEntityOptions){.topology = true});
    size_t own[3] = {0, 0, 0}, seams = 0;
    for (size_t b = 0; b < d->nblock; b++) {
      const MeshBlock *k = &d->block[b];
      const MeshEntity *e = &d->entity[k->entity];
      int dim = elem_dim(k->type);
      assert_int_equal(dim, e->dim);
      if (!k->part) {
        assert_true(e->parent_dim > e->dim);
        seams += dim == 1 ? k->n : 0;
        if (dim == 1) check_seam(m, d, k);
        continue;
      }
      own[dim] += k->n;
      assert_int_equal(e->parent_dim, dim);
      assert_true(mesh_find_entity(m, dim, e->parent_tag) != NONE);
      for (size_t i = 0; i < k->n; i++) assert_true(e->parts.len == 1 && has_part(e, k->part[i]));
    }
    for (int dim = 0; dim < 3; dim++) assert_int_equal(own[dim], mesh_count(m, dim));
    assert_int_equal(seams, count_cut(m));
    for (uint32_t e = 0; e < d->nentity; e++) {
      if (d->entity[e].parts.len && d->entity[e].dim == 2) check_bounds(d, e);
      if (d->entity[e].parts.len && d->entity[e].dim == 1) check_ends(d, e);
    }
    for (size_t v = 0; v < d->nnode; v++) assert_true(d->entity[d->node_entity[v]].parts.len > 0);
    mesh_free(d);
    mesh_free(m);
  }
}

static void without_topology(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(7, true, true);
  assert_true(partition(m, 6, 0));
  Mesh *d = mesh_part_entities(m, &(PartEntityOptions){.groups = true});
  assert_int_equal(mesh_count(d, 1), mesh_count(m, 1));
  for (uint32_t e = 0; e < d->nentity; e++) {
    if (!d->entity[e].parts.len) continue;
    assert_int_equal(d->entity[e].dim, d->entity[e].parent_dim);
    for (uint32_t f = 0; f < e; f++) // one piece for each entity and part
      assert_false(d->entity[f].parts.len && d->entity[f].dim == d->entity[e].dim &&
                   d->entity[f].parent_tag == d->entity[e].parent_tag &&
                   d->entity[f].parts.data[0] == d->entity[e].parts.data[0]);
    for (size_t i = 0; i < d->entity[e].physical.len; i++) {
      const MeshGroup *g = mesh_find_group(d, d->entity[e].dim, abs(d->entity[e].physical.data[i]));
      assert_true(g && strncmp(g->name, "_part{", 6) == 0);
    }
  }
  mesh_free(d);
  mesh_free(m);
}

// ---- parts apart and together ------------------------------------------------------------
static void apart_and_together(void **state)
{
  (void)state;
  for (int kind = 0; kind < 4; kind++) {
    enum { PARTS = 5 };
    Mesh *m = sample_mesh(9, true, kind & 1), *part[PARTS];
    assert_true(partition(m, PARTS, 0));
    uint32_t *local = mem_alloc(m->nnode * sizeof *local);
    memset(local, 0xff, m->nnode * sizeof *local);
    for (uint32_t k = 0; k < PARTS; k++) {
      PartOnly only;
      mesh_part_only(&only, m, k + 1, NULL, 0, local);
      for (size_t b = 0; b < only.mesh->nblock; b++)
        for (size_t i = 0; i < only.mesh->block[b].n; i++)
          assert_int_equal(only.mesh->block[b].part[i], k + 1);
      part[k] = only.mesh;
      only.mesh = NULL;
      part_only_free(&only);
    }
    if (kind & 2) part[2]->xyz[0] += 1; // not of one mesh any more
    unsigned long long number;
    Mesh *joined = mesh_join(part, PARTS, &number);
    if (kind & 2) {
      assert_null(joined);
    } else {
      MeshHash a = mesh_hash(m, false), b = mesh_hash(joined, false);
      assert_memory_equal(a.full, b.full, sizeof a.full);
      assert_int_equal(joined->nnode, m->nnode);
      assert_int_equal(count_cut(joined), count_cut(m));
    }
    mesh_free(joined);
    for (int k = 0; k < PARTS; k++) mesh_free(part[k]);
    free(local);
    mesh_free(m);
  }
}

static void elements_without_a_part(void **state)
{
  (void)state;
  Mesh *m = sample_mesh(5, false, false);
  assert_true(partition(m, 3, 0));
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; elem_dim(m->block[b].type) < 2 && i < m->block[b].n; i++) m->block[b].part[i] = 0;
  assert_true(mesh_complete_parts(m));
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; i < m->block[b].n; i++) assert_in_range(m->block[b].part[i], 1, 3);
  m->block[m->nblock - 1].part[0] = 0;
  assert_false(mesh_complete_parts(m));
  assert_int_equal(m->nparts, 0);
  mesh_free(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(balanced_and_counted),
      cmocka_unit_test(lines_go_with_a_neighbour),
      cmocka_unit_test(the_same_again),
      cmocka_unit_test(as_many_parts_as_elements),
      cmocka_unit_test(weights),
      cmocka_unit_test(ghosts_are_neighbours_over_nodes),
      cmocka_unit_test(pieces_conform),
      cmocka_unit_test(without_topology),
      cmocka_unit_test(apart_and_together),
      cmocka_unit_test(elements_without_a_part),
  };
  return unit_run(tests);
}
