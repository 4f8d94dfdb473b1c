// mesh1d_cross.c - crossings of the 1D mesh
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh1d_int.h"

bool mesh1d_untangle(Mesh1d *g, const Options *opt, Diag *diag)
{
  (void)g, (void)opt, (void)diag;
  return true;
}
