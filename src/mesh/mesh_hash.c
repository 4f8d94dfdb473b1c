// mesh_hash.c - a fingerprint of a mesh that does not depend on format or numbering
// SPDX-License-Identifier: MIT
//
// Each node is hashed from its coordinates, each element from its nodes' hashes in a canonical rotation, and the elements'
// hashes are added up: addition does not know an order.
#include "base/base.h"

#include "mesh/mesh_hash.h"

#include "mesh/element.h"
#include "mesh/mesh_hash_int.h"

static uint64_t mix(uint64_t z)
{
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

static uint64_t chain(uint64_t h, uint64_t x) { return mix((h ^ x) + 0x9e3779b97f4a7c15u); }

static uint64_t double_bits(double v)
{
  uint64_t b;
  v += 0.0; // -0 becomes 0
  memcpy(&b, &v, sizeof b);
  return b;
}

static void add(uint64_t sum[2], uint64_t h)
{
  sum[0] += mix(h ^ 0x5851f42d4c957f2du);
  sum[1] += mix(h ^ 0x14057b7ef767814fu);
}

typedef struct {
  uint8_t perm[2][4][ELEM_MAX_NODES]; // [reversed][rotation]
  int n, corners;
} Symmetries;

static void make_symmetries(Symmetries *s, ElemType t)
{
  s->corners = elem_corners(t);
  for (int flip = 0; flip < 2; flip++) {
    uint8_t all[4][ELEM_MAX_NODES];
    for (int r = 0; r < 4; r++) s->n = elem_symmetry(t, s->corners > 2 ? r % s->corners : 0, flip, all[r]);
    for (int c = 0; c < 4; c++) {
      memcpy(s->perm[flip][c], all[0], sizeof all[0]);
      // The rotation whose first corner is the c-th corner of the unrotated one.
      for (int r = 0; r < s->corners && c < s->corners; r++)
        if (all[r][0] == all[0][c]) memcpy(s->perm[flip][c], all[r], sizeof all[r]);
    }
  }
}

enum { BATCH = 16 };

// Hashes of up to BATCH elements, reversed if flip, each from the corner of least hash on. What one waits for another fills: a hash is a chain of
// products, but the elements' are independent.
static void hash_elements(const Symmetries *s, bool flip, const uint64_t *node, const uint32_t *v, size_t n, uint64_t seed,
                          uint64_t h[BATCH])
{
  const uint8_t *perm[BATCH];
  for (size_t e = 0; e < n; e++) {
    const uint32_t *w = v + e * (size_t)s->n;
    const uint8_t *corner = s->perm[flip][0];
    uint64_t least = node[w[corner[0]]];
    int r = 0;
    for (int c = 1; s->corners > 2 && c < s->corners; c++) { // no branch on what is as good as random
      uint64_t x = node[w[corner[c]]];
      r = x < least ? c : r;
      least = x < least ? x : least;
    }
    perm[e] = s->perm[flip][r];
    h[e] = seed;
  }
  for (int i = 0; i < s->n; i++)
    for (size_t e = 0; e < n; e++) h[e] = chain(h[e], node[v[e * (size_t)s->n + perm[e][i]]]);
}

// each (may be NULL) gets the hash of every element.
static void hash_block(const Mesh *m, const MeshBlock *k, const uint64_t *node, MeshHash *sum, uint64_t *each)
{
  static const int none[1] = {0};
  const IntVec *physical = &m->entity[k->entity].physical;
  const int *group = physical->len ? physical->data : none;
  size_t ngroup = MAX(physical->len, (size_t)1);
  bool wanted[2] = {false, false};
  for (size_t g = 0; g < ngroup; g++) wanted[group[g] < 0] = true;
  Symmetries s;
  make_symmetries(&s, k->type);
  uint64_t seed = mix((uint64_t)k->type);
  for (size_t first = 0; first < k->n; first += BATCH) {
    uint64_t h[2][BATCH];
    size_t n = MIN(k->n - first, (size_t)BATCH);
    for (int flip = 0; flip < 2; flip++)
      if (wanted[flip]) hash_elements(&s, flip, node, k->node + first * (size_t)s.n, n, seed, h[flip]);
    const uint64_t *shape = h[group[0] < 0];
    for (size_t e = 0; e < n; e++) add(sum->shape, shape[e]);
    if (each) memcpy(each + first, shape, n * sizeof *each);
    for (size_t g = 0; g < ngroup; g++)
      for (size_t e = 0; e < n; e++) add(sum->groups, chain(h[group[g] < 0][e], (uint64_t)abs(group[g])));
  }
}

static void hash_names(const Mesh *m, uint64_t sum[2])
{
  for (size_t g = 0; g < m->ngroup; g++) {
    bool used = false;
    for (size_t b = 0; b < m->nblock && m->group[g].name && !used; b++) {
      const MeshEntity *e = &m->entity[m->block[b].entity];
      for (size_t i = 0; m->block[b].n && e->dim == m->group[g].dim && i < e->physical.len; i++)
        used |= abs(e->physical.data[i]) == m->group[g].tag;
    }
    if (!used) continue;
    uint64_t h = chain((uint64_t)m->group[g].dim, (uint64_t)m->group[g].tag);
    for (const char *p = m->group[g].name; *p; p++) h = chain(h, (unsigned char)*p);
    add(sum, h);
  }
}

uint64_t *mesh_hash__points(const Mesh *m)
{
  uint64_t *node = mem_alloc(m->nnode * sizeof *node);
  for (size_t i = 0; i < m->nnode; i++) {
    const double *x = m->xyz + 3 * i;
    node[i] = chain(chain(chain(1, double_bits(x[0])), double_bits(x[1])), double_bits(x[2]));
  }
  return node;
}

MeshHash mesh_hash__of(const Mesh *m, bool save_all, const uint64_t *node, uint64_t *each)
{
  MeshHash sum = {{0, 0}, {0, 0}, {0, 0}};
  bool all = save_all || !mesh_is_grouped(m);
  for (size_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (all || m->entity[k->entity].physical.len) hash_block(m, k, node, &sum, each);
    if (each) each += k->n;
  }
  uint64_t names[2] = {0, 0};
  hash_names(m, names);
  for (int i = 0; i < 2; i++) {
    sum.groups[i] = chain(sum.groups[i], sum.shape[i]);
    sum.full[i] = chain(sum.groups[i], names[i]);
  }
  return sum;
}

MeshHash mesh_hash(const Mesh *m, bool save_all)
{
  uint64_t *node = mesh_hash__points(m);
  MeshHash h = mesh_hash__of(m, save_all, node, NULL);
  free(node);
  return h;
}

void mesh_hash_print(const uint64_t h[2], char to[MESH_HASH_TEXT])
{
  snprintf(to, MESH_HASH_TEXT, "%016llx%016llx", (unsigned long long)h[0], (unsigned long long)h[1]);
}
