// mesh_check_lost.c - the audit: line elements that should be edges of a face and are not
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_check_int.h"

static int u64_order(const void *x, const void *y)
{
  const uint64_t *a = x, *b = y;
  return *a < *b ? -1 : *a > *b;
}

void check__sort(U64Vec *v)
{
  if (v->len) qsort(v->data, v->len, sizeof *v->data, u64_order);
}

size_t check__count(const U64Vec *sorted, uint64_t x)
{
  size_t lo = 0, hi = sorted->len, n = 0;
  while (lo < hi) {
    size_t mid = (lo + hi) / 2;
    if (sorted->data[mid] < x) lo = mid + 1; else hi = mid;
  }
  while (lo + n < sorted->len && sorted->data[lo + n] == x) n++;
  return n;
}

static bool face_has_elements(const Check *c, uint32_t face)
{
  size_t lo = 0, hi = c->m->nblock; // first block of entity >= face
  while (lo < hi) {
    size_t mid = (lo + hi) / 2;
    if (c->m->block[mid].entity < face) lo = mid + 1; else hi = mid;
  }
  return lo < c->m->nblock && c->m->block[lo].entity == face;
}

// Is this a mesh in parts of which some are elsewhere?
static bool lacks_parts(const Mesh *m)
{
  bool *here = mem_zalloc(m->nparts * sizeof *here), lacks = false;
  for (size_t b = 0; m->nparts && b < m->nblock; b++)
    for (size_t i = 0; elem_dim(m->block[b].type) == 2 && i < m->block[b].n; i++)
      here[m->block[b].part[i] - 1] = true;
  for (uint32_t k = 0; k < m->nparts; k++) lacks = lacks || !here[k];
  free(here);
  return lacks;
}

// curve << 32 | face, once for each element of the face that each line of the curve must have: one per listing in the
// boundary, two where the curve is embedded.
static void wanted_uses(const Check *c, U64Vec *wanted)
{
  const Mesh *m = c->m;
  if (lacks_parts(m)) return;
  for (uint32_t f = 0; f < m->nentity; f++) {
    const MeshEntity *t = &m->entity[f];
    if (t->dim != 2 || !face_has_elements(c, f)) continue;
    for (size_t i = 0; i < t->boundary.len + t->embedded.len; i++) {
      bool embedded = i >= t->boundary.len;
      uint32_t e = mesh_find_entity(m, 1, embedded ? abs(t->embedded.data[i - t->boundary.len]) : abs(t->boundary.data[i]));
      for (int k = 0; e != NONE && k < 1 + embedded; k++) vec_push(wanted, (uint64_t)e << 32 | f);
    }
  }
  check__sort(wanted);
}

// A line that no element of the face has, of a curve that the loops of the face run along twice: a slit that was lost, or nothing if
// two holes lie beside it.
typedef struct {
  uint32_t line, face, next; // next one at the same node
  bool within;
} Between;

typedef struct {
  Vec(Between) list;
  Map at; // face << 32 | node -> an index into the list
} Betweens;

static bool is_embedded(const Check *c, uint32_t face, uint32_t curve)
{
  const IntVec *embedded = &c->m->entity[face].embedded;
  for (size_t i = 0; i < embedded->len; i++)
    if (abs(embedded->data[i]) == c->m->entity[curve].tag) return true;
  return false;
}

static void report_lost(Check *c, uint32_t line, uint32_t face, size_t has, size_t n)
{
  const uint32_t *v = check__line_nodes(c, line);
  check__report(c, RULE_LOST_EDGE, false,
                (Place){check__line_curve(c, line), c->line_block.data[line], c->line_index.data[line], NONE, check__middle(c->m, v[0], v[1])}, "it is an edge of %zu elements of face %d, not of %zu: nodes %llu and %llu", has,
                c->m->entity[face].tag, n, number_of(c, v[0]), number_of(c, v[1]));
}

static void add_between(const Check *c, uint32_t line, uint32_t face, Betweens *to)
{
  const uint32_t *v = check__line_nodes(c, line);
  for (int i = 0; i < 2; i++) { // seen from either end
    uint32_t *slot = map_slot(&to->at, (uint64_t)face << 32 | v[i], NONE, NULL);
    vec_push(&to->list, ((Between){.line = line, .face = face, .next = *slot}));
    *slot = (uint32_t)to->list.len - 1;
  }
}

// Does the line leave node v between the sides to nodes a and b of a corner?
static bool leaves_within(const Check *c, uint32_t line, uint32_t v, uint32_t a, uint32_t b)
{
  const uint32_t *ends = check__line_nodes(c, line);
  Vec3 o = mesh_xyz(c->m, v), x = vec3_sub(mesh_xyz(c->m, a), o), y = vec3_sub(mesh_xyz(c->m, b), o);
  Vec3 w = vec3_sub(mesh_xyz(c->m, ends[0] == v ? ends[1] : ends[0]), o), normal = vec3_cross(x, y);
  return vec3_dot(vec3_cross(x, w), normal) > 0 && vec3_dot(vec3_cross(w, y), normal) > 0;
}

// Those that run into elements of their face are lost.
static void check_between(Check *c, Betweens *b)
{
  const Mesh *m = c->m;
  for (uint32_t k = 0; b->list.len && k < m->nblock; k++) {
    const MeshBlock *block = &m->block[k];
    size_t corners = elem_dim(block->type) == 2 ? (size_t)elem_corners(block->type) : 0, nodes = (size_t)elem_nodes(block->type);
    for (size_t i = 0; corners && i < block->n; i++) {
      const uint32_t *v = block->node + i * nodes;
      for (size_t a = 0; a < corners; a++)
        for (uint32_t x = map_get(&b->at, (uint64_t)block->entity << 32 | v[a]); x != NONE; x = b->list.data[x].next)
          b->list.data[x].within |= leaves_within(c, b->list.data[x].line, v[a], v[(a + 1) % corners], v[(a + corners - 1) % corners]);
    }
  }
  for (size_t i = 0; i < b->list.len; i += 2)
    if (b->list.data[i].within || b->list.data[i + 1].within) report_lost(c, b->list.data[i].line, b->list.data[i].face, 0, 2);
  vec_free(&b->list);
  map_free(&b->at);
}

// 2 marks the nodes of surface elements.
static void mark_surface_nodes(Check *c)
{
  const Mesh *m = c->m;
  for (size_t b = 0; b < m->nblock; b++)
    if (elem_dim(m->block[b].type) == 2)
      for (size_t i = 0; i < m->block[b].n * (size_t)elem_nodes(m->block[b].type); i++) c->used[m->block[b].node[i]] = 2;
}

void check__lost(Check *c, CheckedEdges *s)
{
  bool marked = false; // most meshes have no lines that lie loose
  const Mesh *m = c->m;
  U64Vec wanted = {0};
  Betweens between = {0};
  wanted_uses(c, &wanted);
  check__sort(&s->use);
  for (uint32_t l = 0; l < c->line_block.len; l++) {
    uint32_t curve = check__line_curve(c, l);
    const uint32_t *v = check__line_nodes(c, l);
    size_t k = 0, hi = wanted.len;
    while (k < hi) {
      size_t mid = (k + hi) / 2;
      if (wanted.data[mid] < (uint64_t)curve << 32) k = mid + 1; else hi = mid;
    }
    bool listed = k < wanted.len && wanted.data[k] >> 32 == curve;
    for (size_t n; k < wanted.len && wanted.data[k] >> 32 == curve; k += n) {
      uint32_t face = (uint32_t)wanted.data[k];
      n = check__count(&wanted, wanted.data[k]);
      const size_t sides = n > 2 ? 2 - n % 2 : n; // what is run along three times bounds the face like what is run along once
      size_t has = check__count(&s->use, (uint64_t)l << 32 | face);
      if (has == 0 && sides == 2 && !is_embedded(c, face, curve)) add_between(c, l, face, &between);
      else if (has < sides) report_lost(c, l, face, has, sides);
    }
    if (listed || c->strict || c->edges.n == 0) continue; // curves that no face lists are known to be free
    size_t lo = 0, up = s->use.len; // any use of this line at all?
    while (lo < up) {
      size_t mid = (lo + up) / 2;
      if (s->use.data[mid] < (uint64_t)l << 32) lo = mid + 1; else up = mid;
    }
    bool free_line = !(lo < s->use.len && s->use.data[lo] >> 32 == l);
    if (free_line && !marked) mark_surface_nodes(c);
    marked |= free_line;
    if (free_line && c->used[v[0]] == 2 && c->used[v[1]] == 2)
      check__report(c, RULE_LOST_EDGE, true,
                    (Place){curve, c->line_block.data[l], c->line_index.data[l], NONE, check__middle(m, v[0], v[1])}, "it is no edge of a surface element: nodes %llu and %llu",
                    number_of(c, v[0]), number_of(c, v[1]));
  }
  check_between(c, &between);
  vec_free(&wanted);
}

