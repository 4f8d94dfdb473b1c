// field.c - the record of size fields: types and options by name, values with their places
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "size/field.h"

#include <math.h>

#include "base/str.h"
#include "size/field_int.h"

#define FIELD(kind, name, old, help) static const FieldOption options_##kind[] = {
#define NUM(name, old, def, help) {name, old, FIELD_NUMBER, def, "", help},
#define INT(name, old, def, help) {name, old, FIELD_INTEGER, def, "", help},
#define BOOL(name, old, def, help) {name, old, FIELD_BOOLEAN, def, "", help},
#define STRING(name, old, text, help) {name, old, FIELD_STRING, 0, text, help},
#define PATH(name, old, help) {name, old, FIELD_PATH, 0, "", help},
#define LIST(name, old, help) {name, old, FIELD_LIST, 0, "", help},
#define END };
#include "size/field.def"

static const FieldType types[] = {
#define FIELD(kind, name, old, help) {name, old, options_##kind, (int)ARRAY_LEN(options_##kind), help},
#include "size/field.def"
};

const FieldType *field__type(FieldKind k)
{
  return &types[k];
}

static int find_type(const char *name)
{
  for (int k = 0; k < FIELD_KINDS; k++)
    if (!strcmp(types[k].name, name) || str_has_word(types[k].old, name)) return k;
  return -1;
}

static int find_option(const FieldType *t, const char *name)
{
  for (int i = 0; i < t->noption; i++)
    if (!strcmp(t->option[i].name, name) || str_has_word(t->option[i].old, name)) return i;
  return -1;
}

FieldSet *fields_new(void)
{
  FieldSet *f = mem_zalloc(sizeof *f);
  f->background_view = f->background = -1;
  return f;
}

static void field_release(Field *f)
{
  for (int i = 0; i < types[f->kind].noption; i++) {
    free(f->value[i].text);
    free(f->value[i].list);
  }
  free(f->value);
}

void fields_clear(FieldSet *f)
{
  for (size_t i = 0; i < f->field.len; i++) field_release(&f->field.data[i]);
  vec_clear(&f->field);
  vec_clear(&f->layer);
  f->background = -1;
  f->background_view = -1;
}

void fields_free(FieldSet *f)
{
  if (!f) return;
  fields_clear(f);
  for (size_t i = 0; i < f->view.len; i++) {
    View *v = &f->view.data[i];
    free(v->name);
    vec_free(&v->xyz);
    vec_free(&v->value);
    vec_free(&v->element);
  }
  for (size_t i = 0; i < f->text.len; i++) free(f->text.data[i]);
  vec_free(&f->text);
  vec_free(&f->view);
  vec_free(&f->field);
  vec_free(&f->layer);
  free(f);
}

// Index of the first field whose id is not below `id`.
static size_t lower_bound(const FieldSet *f, int id)
{
  size_t lo = 0, hi = f->field.len;
  while (lo < hi) {
    size_t mid = (lo + hi) / 2;
    if (f->field.data[mid].id < id) lo = mid + 1;
    else hi = mid;
  }
  return lo;
}

const Field *field__find(const FieldSet *f, int id)
{
  size_t i = lower_bound(f, id);
  return i < f->field.len && f->field.data[i].id == id ? &f->field.data[i] : NULL;
}

void fields_add_parts(FieldSet *f, int dim, int tag, const int *part, size_t n)
{
  const char *list = dim == 1 ? "CurvesList" : "SurfacesList";
  for (size_t i = 0; i < f->field.len; i++) {
    Field *field = &f->field.data[i];
    const FieldType *type = field__type(field->kind);
    for (int k = 0; k < type->noption; k++) {
      FieldValue *v = &field->value[k];
      if (type->option[k].kind != FIELD_LIST || strcmp(type->option[k].name, list) != 0) continue;
      size_t before = v->nlist;
      for (size_t j = 0; j < before; j++) {
        if (v->list[j] != tag && v->list[j] != -tag) continue;
        v->list = mem_realloc(v->list, (v->nlist + n) * sizeof *v->list);
        for (size_t q = 1; q < n; q++) v->list[v->nlist++] = part[q];
      }
    }
  }
}

bool field_exists(const FieldSet *f, int id)
{
  return field__find(f, id) != NULL;
}

int fields_max_id(const FieldSet *f)
{
  return f->field.len ? vec_last(&f->field).id : 0;
}

SrcLoc field_loc(const FieldSet *f, int id)
{
  const Field *x = field__find(f, id);
  return x ? x->loc : NO_LOC;
}

static void report_unknown_type(const char *type, SrcLoc loc, Diag *diag)
{
  const char *name[FIELD_KINDS];
  for (int k = 0; k < FIELD_KINDS; k++) name[k] = types[k].name;
  const char *near = str_nearest(type, name, FIELD_KINDS);
  if (!strcmp(type, "ExternalProcess"))
    diag_error(diag, loc, "field type 'ExternalProcess' is refused: a size field cannot run commands");
  else if (near) diag_error(diag, loc, "unknown field type '%s'; did you mean '%s'?", type, near);
  else diag_error(diag, loc, "unknown field type '%s'", type);
}

bool field_create(FieldSet *f, int id, const char *type, SrcLoc loc, Diag *diag)
{
  int kind = find_type(type);
  if (kind < 0) return report_unknown_type(type, loc, diag), false;
  if (id < 0) return diag_error(diag, loc, "field id %d is negative", id), false;
  const Field *old = field__find(f, id);
  if (old) {
    diag_error(diag, loc, "field %d exists already", id);
    diag_note(diag, old->loc, "it was made here");
    return false;
  }
  const FieldType *t = &types[kind];
  Field x = {.id = id, .kind = (FieldKind)kind, .loc = loc};
  x.value = mem_zalloc((size_t)t->noption * sizeof *x.value);
  for (int i = 0; i < t->noption; i++) {
    x.value[i].number = t->option[i].def;
    x.value[i].text = mem_strdup(t->option[i].text);
    x.value[i].loc = loc;
  }
  size_t at = lower_bound(f, id);
  vec_push(&f->field, x);
  memmove(f->field.data + at + 1, f->field.data + at, (f->field.len - 1 - at) * sizeof x);
  f->field.data[at] = x;
  return true;
}

bool field_delete(FieldSet *f, int id, SrcLoc loc, Diag *diag)
{
  size_t i = lower_bound(f, id);
  if (i == f->field.len || f->field.data[i].id != id) {
    diag_error(diag, loc, "cannot delete field %d: there is none", id);
    return false;
  }
  field_release(&f->field.data[i]);
  memmove(f->field.data + i, f->field.data + i + 1, (f->field.len - 1 - i) * sizeof(Field));
  f->field.len--;
  return true;
}

static void report_unknown_option(const Field *x, const char *option, SrcLoc loc, Diag *diag)
{
  const FieldType *t = &types[x->kind];
  const char *name[64];
  CHECK(t->noption <= 64);
  for (int i = 0; i < t->noption; i++) name[i] = t->option[i].name;
  const char *near = str_nearest(option, name, (size_t)t->noption);
  if (near)
    diag_error(diag, loc, "field %d (%s) has no option '%s'; did you mean '%s'?", x->id, t->name, option, near);
  else diag_error(diag, loc, "field %d (%s) has no option '%s'", x->id, t->name, option);
}

// The option of a field, for writing; NULL after an error.
static FieldValue *target(FieldSet *f, int id, const char *option, const FieldOption **row, SrcLoc loc, Diag *diag)
{
  const Field *x = field__find(f, id);
  if (!x) return diag_error(diag, loc, "there is no field %d", id), NULL;
  int i = find_option(&types[x->kind], option);
  if (i < 0) return report_unknown_option(x, option, loc, diag), NULL;
  *row = &types[x->kind].option[i];
  return &x->value[i];
}

bool field_set_number(FieldSet *f, int id, const char *option, double value, SrcLoc loc, Diag *diag)
{
  const FieldOption *row;
  FieldValue *v = target(f, id, option, &row, loc, diag);
  if (!v) return false;
  switch (row->kind) {
  case FIELD_NUMBER: break;
  case FIELD_INTEGER: value = trunc(value); break;
  case FIELD_BOOLEAN: value = value != 0; break;
  case FIELD_LIST: return field_set_list(f, id, option, &value, 1, loc, diag);
  case FIELD_STRING:
  case FIELD_PATH:
    diag_error(diag, loc, "option '%s' of field %d is a text, not a number", row->name, id);
    return false;
  }
  if (isnan(value) || (row->kind == FIELD_INTEGER && fabs(value) > 1e9)) {
    diag_error(diag, loc, "option '%s' of field %d cannot be %g", row->name, id, value);
    return false;
  }
  v->number = value;
  v->given = true;
  v->loc = loc;
  return true;
}

bool field_set_string(FieldSet *f, int id, const char *option, const char *value, SrcLoc loc, Diag *diag)
{
  const FieldOption *row;
  FieldValue *v = target(f, id, option, &row, loc, diag);
  if (!v) return false;
  if (row->kind != FIELD_STRING && row->kind != FIELD_PATH) {
    diag_error(diag, loc, "option '%s' of field %d is a %s, not a text", row->name, id,
               row->kind == FIELD_LIST ? "list" : "number");
    return false;
  }
  free(v->text);
  v->text = mem_strdup(value);
  v->given = true;
  v->loc = loc;
  return true;
}

bool field_set_list(FieldSet *f, int id, const char *option, const double *value, size_t n, SrcLoc loc, Diag *diag)
{
  const FieldOption *row;
  FieldValue *v = target(f, id, option, &row, loc, diag);
  if (!v) return false;
  if (row->kind != FIELD_LIST) {
    if (n == 1 && row->kind != FIELD_STRING && row->kind != FIELD_PATH)
      return field_set_number(f, id, option, value[0], loc, diag);
    diag_error(diag, loc, "option '%s' of field %d is not a list", row->name, id);
    return false;
  }
  double *copy = mem_alloc((n + 1) * sizeof *copy);
  for (size_t i = 0; i < n; i++) copy[i] = value[i];
  free(v->list);
  v->list = copy;
  v->nlist = n;
  v->given = true;
  v->loc = loc;
  return true;
}

// ---- reading back ---------------------------------------------------------------------------------------------

const char *field_type(const FieldSet *f, int id)
{
  const Field *x = field__find(f, id);
  return x ? types[x->kind].name : NULL;
}

static const FieldValue *look_up(const FieldSet *f, int id, const char *option)
{
  const Field *x = field__find(f, id);
  int i = x ? find_option(&types[x->kind], option) : -1;
  return i < 0 ? NULL : &x->value[i];
}

double field_get_number(const FieldSet *f, int id, const char *option)
{
  const FieldValue *v = look_up(f, id, option);
  return v ? v->number : NAN;
}

const double *field_get_list(const FieldSet *f, int id, const char *option, size_t *n)
{
  const FieldValue *v = look_up(f, id, option);
  *n = v ? v->nlist : 0;
  return v ? v->list : NULL;
}

const FieldValue *field__value(const Field *f, const char *name)
{
  int i = find_option(&types[f->kind], name);
  CHECK(i >= 0);
  return &f->value[i];
}

double field__number(const Field *f, const char *name)
{
  return field__value(f, name)->number;
}

// ---- what is used ----------------------------------------------------------------------------------------------

void fields_set_background(FieldSet *f, int id, SrcLoc loc)
{
  f->background = id;
  f->background_loc = loc;
  f->background_view = -1;
}

void fields_set_background_view(FieldSet *f, int index, SrcLoc loc)
{
  f->background_view = index;
  f->background_view_loc = loc;
}

void fields_set_boundary_layers(FieldSet *f, const double *id, size_t n, SrcLoc loc)
{
  (void)loc;
  for (size_t i = 0; i < n; i++) {
    bool known = !(fabs(id[i]) < 1e9);
    for (size_t k = 0; k < f->layer.len && !known; k++) known = f->layer.data[k] == (int)id[i];
    if (!known) vec_push(&f->layer, (int)id[i]);
  }
}

size_t fields_boundary_layers(const FieldSet *f, const int **id)
{
  *id = f->layer.data;
  return f->layer.len;
}
