// boundary_layer_field.c - heights of layers, and the fields that ask for them
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <string.h>

#include "mesh/boundary_layer_int.h"

enum { MAX_LAYERS = 10000 };

// ---- heights ---------------------------------------------------------------------------------------------------------
size_t layer_heights(double size, double ratio, double thickness, double *height, size_t cap)
{
  size_t n = 0;
  double d = size, step = size;
  while (n < cap && d > 0 && d <= thickness * (1 + 1e-12)) {
    height[n++] = d;
    step *= ratio;
    if (!(step > 0) || d + step == d) break;
    d += step;
  }
  return n;
}

void layer_heights_beta(double thickness, double beta, size_t n, double *height)
{
  double a = (beta + 1) / (beta - 1);
  for (size_t k = 1; k <= n; k++) {
    double w = pow(a, 1 - (double)k / (double)n);
    height[k - 1] = k == n ? thickness : thickness * ((beta + 1) - (beta - 1) * w) / (w + 1);
  }
}

// Sum of first * growth^p over all layers, and its derivative by p.
static double sum_of_layers(const LayerField *f, double first, double p, double *slope)
{
  double sum = 0;
  *slope = 0;
  for (size_t k = 0; k < f->growth.len; k++) {
    double g = first * exp(p * f->growth.data[k]);
    sum += g;
    *slope += g * f->growth.data[k];
  }
  return sum;
}

void column__heights(const LayerField *f, double first, double s, double *height)
{
  size_t n = f->height.len;
  double total = s * vec_last(&f->height), p = 1, slope;
  bool even = total <= (double)n * first || !(vec_last(&f->growth) > 1e-9);
  for (int round = 0; round < 60 && !even; round++) { // Newton: the sum is convex in p
    double step = (sum_of_layers(f, first, p, &slope) - total) / slope;
    step = fmin(fmax(step, -1), 1);
    p = fmax(p - step, 0);
    if (fabs(step) < 1e-14) break;
  }
  double d = 0;
  for (size_t k = 0; k < n; k++) {
    d += even ? total / (double)n : first * exp(p * f->growth.data[k]);
    height[k] = d;
  }
  for (size_t k = 0; k < n; k++) // to the bit what was asked for where nothing stands against it, and never beyond the top
    height[k] = s == 1 && first == f->height.data[0] ? f->height.data[k] : k + 1 == n ? total : fmin(height[k], total);
}

// ---- fields ------------------------------------------------------------------------------------------------------------
static void copy_tags(IntVec *to, const FieldSet *fields, int id, const char *option)
{
  size_t n;
  const double *v = field_get_list(fields, id, option, &n);
  for (size_t i = 0; i < n; i++) vec_push(to, abs((int)v[i]));
}

// SizesList: pairs of a point and the first height there.
static bool read_sizes(LayerField *f, const FieldSet *fields, int id, Diag *diag)
{
  size_t n;
  const double *pair = field_get_list(fields, id, "SizesList", &n);
  for (size_t i = 0; i + 1 < n; i += 2) {
    vec_push(&f->sized, (int)pair[i]);
    vec_push(&f->first, pair[i + 1]);
    if (pair[i + 1] > 0) continue;
    diag_error(diag, field_loc(fields, id), "field %d: the first height at point %d is %g; it must be positive", id, (int)pair[i],
               pair[i + 1]);
    return false;
  }
  if (n % 2 == 0) return true;
  diag_error(diag, field_loc(fields, id), "field %d: SizesList has %zu numbers; it lists pairs of a point and a height", id, n);
  return false;
}

bool layer_field__read(LayerField *f, const FieldSet *fields, int id, Diag *diag)
{
  *f = (LayerField){0};
  const char *type = field_type(fields, id);
  if (!type || strcmp(type, "BoundaryLayer") != 0) {
    diag_error(diag, NO_LOC, "BoundaryLayer Field: field %d %s", id, type ? "is not of type BoundaryLayer" : "does not exist");
    return false;
  }
  copy_tags(&f->curves, fields, id, "CurvesList");
  copy_tags(&f->fans, fields, id, "FanPointsList");
  copy_tags(&f->excluded, fields, id, "ExcludedSurfacesList");
  size_t n;
  const double *size = field_get_list(fields, id, "FanPointsSizesList", &n);
  for (size_t i = 0; i < n; i++) vec_push(&f->fan_size, size[i]);
  f->quads = field_get_number(fields, id, "Quads") != 0;
  double thickness = field_get_number(fields, id, "Thickness"), first = field_get_number(fields, id, "Size");
  double ratio = field_get_number(fields, id, "Ratio"), beta = field_get_number(fields, id, "Beta");
  if (field_get_number(fields, id, "BetaLaw") != 0) {
    double layers = field_get_number(fields, id, "NbLayers");
    if (!(beta > 1) || !(layers >= 1) || layers > MAX_LAYERS) {
      diag_error(diag, field_loc(fields, id), "field %d: Beta must be above 1 and NbLayers between 1 and %d", id, MAX_LAYERS);
      return false;
    }
    vec_resize(&f->height, (size_t)layers);
    layer_heights_beta(thickness, beta, f->height.len, f->height.data);
  } else {
    vec_resize(&f->height, MAX_LAYERS);
    vec_resize(&f->height, layer_heights(first, ratio, thickness, f->height.data, MAX_LAYERS));
  }
  for (size_t k = 0; k < f->height.len; k++)
    vec_push(&f->growth, log((k ? f->height.data[k] - f->height.data[k - 1] : f->height.data[0]) / f->height.data[0]));
  if (!read_sizes(f, fields, id, diag)) return false;
  if (!f->height.len)
    diag_warning(diag, field_loc(fields, id), "field %d makes no layer: its first height, %g, is above its thickness, %g", id,
                 first, thickness);
  return true;
}

void layer_field__free(LayerField *f)
{
  vec_free(&f->height);
  vec_free(&f->growth);
  vec_free(&f->sized);
  vec_free(&f->first);
  vec_free(&f->curves);
  vec_free(&f->fans);
  vec_free(&f->excluded);
  vec_free(&f->fan_size);
}
