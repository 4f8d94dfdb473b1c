// element.h - node order of the element types as lattice points, and their symmetries
// SPDX-License-Identifier: MIT
#ifndef MESH_ELEMENT_H
#define MESH_ELEMENT_H

#include "mesh/mesh.h"

enum { ELEM_MAX_NODES = 25 };

// Lattice coordinates (i, j) of each node, 0 .. order: the reference triangle's corners are (0,0), (p,0), (0,p), the
// quadrangle's (0,0), (p,0), (p,p), (0,p); a line has j = 0. Returns the number of nodes, 0 for an unknown type.
int elem_lattice(ElemType t, uint8_t ij[ELEM_MAX_NODES][2]);

// perm such that new[i] = old[perm[i]] describes the same element with corner `rotation` first and, if `flip`, the
// opposite orientation (about that corner). For lines only flip counts. Returns the number of nodes.
int elem_symmetry(ElemType t, int rotation, bool flip, uint8_t perm[ELEM_MAX_NODES]);

#endif
