// unroll.h - a model written as plain .geo
// SPDX-License-Identifier: MIT
#ifndef MODEL_UNROLL_H
#define MODEL_UNROLL_H

#include "base/file.h"
#include "model/model.h"

// Statements with literal numbers only, from which meshgen and Gmsh both read the same model: points with sizes, curves, loops,
// surfaces, volumes, physical groups, and how to mesh them. Numbers are written so that they read back bit for bit. Uniform Layers of
// an extrusion become the equal transfinite counts; layers of several heights have no plain form and are noted in a comment.
// What model_prepare refused (open loops) is left out. Linear time.
void model_unroll(const Model *m, Writer *w);

#endif
