// pending.c
// SPDX-License-Identifier: MIT
#include "base/base.h"
#include "size/size_int.h"
static bool build(SizeField *s, Node *n, Diag *diag)
{
  (void)s;
  diag_error(diag, n->field ? n->field->loc : NO_LOC, "field type not available yet");
  return false;
}
#define P(x) const FieldOps x = {build, NULL, NULL, NULL};
P(ops_distance) P(ops_extend) P(ops_layer) P(ops_attractor_aniso) P(ops_structured) P(ops_view) P(ops_automatic)
