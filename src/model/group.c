// group.c - physical groups
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "base/str.h"
#include "model/model_int.h"

static void name_key(char *to, size_t size, int dim, const char *name)
{
  snprintf(to, size, "%d %s", dim, name);
}

static int tag_of_name(const Model *m, int dim, const char *name)
{
  size_t n = strlen(name) + 4;
  char *key = mem_alloc(n);
  name_key(key, n, dim, name);
  uint32_t tag = names_get(&m->group_name, key);
  free(key);
  return tag == NONE ? -1 : (int)tag;
}

static void set_name(Model *m, Group *g, const char *name)
{
  size_t n = strlen(name) + 4;
  char *key = mem_alloc(n);
  name_key(key, n, g->dim, name);
  names_set(&m->group_name, key, (uint32_t)g->tag);
  free(key);
  free(g->name);
  g->name = mem_strdup(name);
}

// Index of the first group of dim with a tag not below `tag`.
static size_t lower(const Model *m, int dim, int tag)
{
  size_t a = 0, b = m->group[dim].len;
  while (a < b) {
    size_t mid = (a + b) / 2;
    if (m->group[dim].data[mid]->tag < tag)
      a = mid + 1;
    else
      b = mid;
  }
  return a;
}

static Group *find(const Model *m, int dim, int tag)
{
  size_t i = lower(m, dim, tag);
  return i < m->group[dim].len && m->group[dim].data[i]->tag == tag ? m->group[dim].data[i] : NULL;
}

size_t model_groups(const Model *m)
{
  return m->group[0].len + m->group[1].len + m->group[2].len + m->group[3].len;
}

Group *model_group_at(const Model *m, size_t k)
{
  int d = 0;
  while (k >= m->group[d].len) k -= m->group[d++].len;
  return m->group[d].data[k];
}

Group *model_group(const Model *m, int dim, int tag) { return dim < 0 || dim > 3 ? NULL : find(m, dim, tag); }

static Group *make(Model *m, int dim, int tag, SrcLoc loc)
{
  Group *g = mem_zalloc(sizeof *g);
  g->dim = dim;
  g->tag = tag;
  g->loc = loc;
  size_t i = lower(m, dim, tag);
  vec_push(&m->group[dim], g);
  Group **a = m->group[dim].data;
  memmove(a + i + 1, a + i, (m->group[dim].len - 1 - i) * sizeof *a);
  a[i] = g;
  model__note_tag(m, KIND_GROUP, tag);
  return g;
}

static void remove_members(Group *g, const int *entity, size_t n)
{
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < g->entity.len; j++)
      if (g->entity.data[j] == entity[i]) {
        memmove(g->entity.data + j, g->entity.data + j + 1, (g->entity.len - 1 - j) * sizeof(int));
        g->entity.len--;
        break;
      }
}

static void unknown_group(const Model *m, int dim, int tag, const char *name, const char *op, SrcLoc loc, Diag *diag)
{
  if (!name) {
    diag_error(diag, loc, "there is no physical %s %d to change with '%s'; the first statement needs '='", dim__name(dim), tag,
               op);
    return;
  }
  const char **names = mem_alloc((m->group[dim].len + 1) * sizeof *names);
  size_t n = 0;
  for (size_t i = 0; i < m->group[dim].len; i++)
    if (m->group[dim].data[i]->name) names[n++] = m->group[dim].data[i]->name;
  const char *near = str_nearest(name, names, n);
  if (near)
    diag_error(diag, loc, "there is no physical %s \"%s\" to change with '%s'; did you mean \"%s\"?", dim__name(dim), name, op,
               near);
  else
    diag_error(diag, loc, "there is no physical %s \"%s\" to change with '%s'; the first statement needs '='", dim__name(dim),
               name, op);
  free(names);
}

int model_group_edit(Model *m, int dim, int tag, const char *name, GroupOp op, const int *entity, size_t n, SrcLoc loc,
                     Diag *diag)
{
  CHECK(dim >= 0 && dim <= 3);
  if (name && !*name) name = NULL;
  if (tag < 0) { // a name alone uses up a tag, as in Gmsh, even if the group has one already
    int next = ++m->max[KIND_GROUP];
    if (name) tag = tag_of_name(m, dim, name);
    if (tag < 0) tag = next;
  }
  Group *g = find(m, dim, tag);
  if (op == GROUP_SET) {
    if (g) {
      diag_error(diag, loc, "physical %s %d exists already; use '+=' to add to it", dim__name(dim), tag);
      diag_note(diag, g->loc, "it was made here");
      return -1;
    }
    g = make(m, dim, tag, loc);
  } else if (!g) {
    unknown_group(m, dim, tag, name, op == GROUP_ADD ? "+=" : "-=", loc, diag);
    return -1;
  }
  if (name && (!g->name || strcmp(g->name, name) != 0)) set_name(m, g, name);
  if (op == GROUP_REMOVE)
    remove_members(g, entity, n);
  else
    for (size_t i = 0; i < n; i++) vec_push(&g->entity, entity[i]);
  return tag;
}

bool model_group_members(const Model *m, int dim, int tag, IntVec *out)
{
  const Group *g = model_group(m, dim, tag);
  if (!g) return false;
  for (size_t i = 0; i < g->entity.len; i++) vec_push(out, g->entity.data[i]);
  return true;
}

void model_delete_groups(Model *m)
{
  for (int d = 0; d < 4; d++) {
    for (size_t i = 0; i < m->group[d].len; i++) {
      free(m->group[d].data[i]->name);
      vec_free(&m->group[d].data[i]->entity);
      free(m->group[d].data[i]);
    }
    vec_clear(&m->group[d]);
  }
  names_free(&m->group_name);
  m->group_name = (Names){0};
}
