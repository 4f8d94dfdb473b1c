// element.c - node order of the element types as lattice points, and their symmetries
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/element.h"

typedef struct {
  int n, want; // nodes so far, nodes of the type
  uint8_t (*ij)[2];
} Lattice;

static void add(Lattice *l, int i, int j)
{
  if (l->n == l->want) return; // incomplete types end with the edges
  l->ij[l->n][0] = (uint8_t)i;
  l->ij[l->n++][1] = (uint8_t)j;
}

// Nodes of the triangle of order p whose first corner is (o, o): corners, edges, then the triangle within.
static void add_triangle(Lattice *l, int o, int p)
{
  add(l, o, o);
  if (p == 0) return;
  add(l, o + p, o);
  add(l, o, o + p);
  for (int k = 1; k < p; k++) add(l, o + k, o);
  for (int k = 1; k < p; k++) add(l, o + p - k, o + k);
  for (int k = 1; k < p; k++) add(l, o, o + p - k);
  if (p >= 3) add_triangle(l, o + 1, p - 3);
}

static void add_quad(Lattice *l, int o, int p)
{
  add(l, o, o);
  if (p == 0) return;
  add(l, o + p, o);
  add(l, o + p, o + p);
  add(l, o, o + p);
  for (int k = 1; k < p; k++) add(l, o + k, o);
  for (int k = 1; k < p; k++) add(l, o + p, o + k);
  for (int k = 1; k < p; k++) add(l, o + p - k, o + p);
  for (int k = 1; k < p; k++) add(l, o, o + p - k);
  if (p >= 2) add_quad(l, o + 1, p - 2);
}

int elem_lattice(ElemType t, uint8_t ij[ELEM_MAX_NODES][2])
{
  Lattice l = {0, elem_nodes(t), ij};
  int p = elem_order(t);
  switch (elem_corners(t)) {
  case 1: add(&l, 0, 0); break;
  case 2:
    add(&l, 0, 0);
    add(&l, p, 0);
    for (int k = 1; k < p; k++) add(&l, k, 0);
    break;
  case 3: add_triangle(&l, 0, p); break;
  case 4: add_quad(&l, 0, p); break;
  }
  return l.n;
}

// Where the symmetry takes lattice point (i, j).
static void map_point(int corners, int p, int rotation, bool flip, int *i, int *j)
{
  if (corners == 2) {
    if (flip) *i = p - *i;
    return;
  }
  if (flip) {
    int s = *i;
    *i = *j;
    *j = s;
  }
  for (int r = 0; r < rotation; r++) {
    int s = *i;
    *i = corners == 3 ? p - *i - *j : p - *j;
    *j = s;
  }
}

int elem_symmetry(ElemType t, int rotation, bool flip, uint8_t perm[ELEM_MAX_NODES])
{
  uint8_t ij[ELEM_MAX_NODES][2];
  int n = elem_lattice(t, ij), corners = elem_corners(t), p = elem_order(t);
  for (int a = 0; a < n; a++) {
    int i = ij[a][0], j = ij[a][1], b = 0;
    map_point(corners, p, rotation, flip, &i, &j);
    while (ij[b][0] != i || ij[b][1] != j) b++;
    perm[a] = (uint8_t)b;
  }
  return n;
}

