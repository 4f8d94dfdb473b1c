// subdivide.c - meshes made finer, or all quadrangles, by splitting every element
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/subdivide.h"

#include "mesh/edge_table.h"

typedef struct {
  const Mesh *m;
  Subdivision how;
  EdgeTable table;
  Enriched e;
  Vec3 *shift;   // per edge: from the middle of its chord to that of its curve
  double *share; // of it that is taken, 0 where there is none
} Splitter;

static int centres(ElemType type, void *how)
{
  return type == ELEM_QUAD4 || *(const Subdivision *)how != SUBDIVIDE_HALVE;
}

// ---- middles of edges on curves: not so far from their chords that parts of elements would turn over -----------------------
static Vec3 chord_middle(const Splitter *s, uint32_t e)
{
  return vec3_scale(0.5, vec3_add(mesh_xyz(s->m, s->table.edge[e].a), mesh_xyz(s->m, s->table.edge[e].b)));
}

static void find_shifts(Splitter *s, const Model *model)
{
  s->shift = mem_zalloc((s->table.n + 1) * sizeof *s->shift);
  s->share = mem_zalloc((s->table.n + 1) * sizeof *s->share);
  for (uint32_t i = 0; i < s->table.n; i++) {
    double u;
    const MeshEdge *e = &s->table.edge[i];
    s->shift[i] = vec3_sub(edge_table_point(&s->table, s->m, model, i, 0.5, &u), chord_middle(s, i));
    s->share[i] = vec3_length(s->shift[i]) > 1e-14 * vec3_distance(mesh_xyz(s->m, e->a), mesh_xyz(s->m, e->b));
  }
}

static double turn_at(Vec3 a, Vec3 b, Vec3 c, Vec3 normal)
{
  return vec3_dot(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)), normal);
}

// Would a part of the element turn over, or nearly so? edge: of its sides.
static bool has_bad_part(const Splitter *s, const uint32_t *v, const uint32_t *edge, size_t c)
{
  enum { LEAST = 50 }; // a part has at least this fraction of the element's area at each corner
  Vec3 p[4], q[4], sum = {0, 0, 0};
  for (size_t i = 0; i < c; i++) {
    p[i] = mesh_xyz(s->m, v[i]);
    q[i] = vec3_add(chord_middle(s, edge[i]), vec3_scale(s->share[edge[i]], s->shift[edge[i]]));
    sum = vec3_add(sum, p[i]);
  }
  Vec3 n = c == 3 ? vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0])) : vec3_cross(vec3_sub(p[2], p[0]), vec3_sub(p[3], p[1]));
  double least = vec3_dot(n, n) / LEAST;
  bool centred = c == 4 || s->how == SUBDIVIDE_QUADS;
  if (!centred && turn_at(q[0], q[1], q[2], n) < least) return true;
  Vec3 m = vec3_scale(1 / (double)c, sum);
  for (size_t i = 0; i < c; i++) {
    Vec3 next = q[i], before = q[(i + c - 1) % c];
    if (turn_at(p[i], next, before, n) < least) return true;
    if (centred && (turn_at(next, m, p[i], n) < least || turn_at(before, p[i], m, n) < least || turn_at(m, before, next, n) < least)) return true;
  }
  return false;
}

// Halve the shares of the bent sides of elements that have a bad part, until none has.
static void draw_nearer(Splitter *s)
{
  bool *halve = mem_zalloc(s->table.n + 1), changed = true;
  while (changed) {
    changed = false;
    for (size_t b = 0; b < s->m->nblock; b++) {
      const MeshBlock *k = &s->m->block[b];
      size_t c = (size_t)elem_corners(k->type);
      for (size_t i = 0; elem_dim(k->type) == 2 && i < k->n; i++) {
        const uint32_t *v = k->node + c * i;
        uint32_t edge[4];
        double most = 0;
        for (size_t j = 0; j < c; j++) {
          edge[j] = edge_table_find(&s->table, k->entity, v[j], v[(j + 1) % c]);
          most = fmax(most, s->share[edge[j]]);
        }
        if (!(most > 0) || !has_bad_part(s, v, edge, c)) continue;
        for (size_t j = 0; j < c; j++) halve[edge[j]] |= s->share[edge[j]] > 0;
      }
    }
    for (size_t i = 0; i < s->table.n; i++) {
      if (!halve[i]) continue;
      s->share[i] = s->share[i] > 1e-3 ? s->share[i] / 2 : 0;
      halve[i] = false;
      changed = true;
    }
  }
  free(halve);
}

static size_t place_middles(Splitter *s, const Model *model)
{
  size_t straightened = 0;
  find_shifts(s, model);
  bool *bent = mem_zalloc(s->table.n + 1);
  for (size_t i = 0; i < s->table.n; i++) bent[i] = s->share[i] > 0;
  draw_nearer(s);
  for (uint32_t i = 0; i < s->table.n; i++) {
    double u;
    Vec3 p = edge_table_point(&s->table, s->m, model, i, 0.5, &u);
    bool drawn = bent[i] && s->share[i] < 1;
    if (drawn) p = vec3_add(chord_middle(s, i), vec3_scale(s->share[i], s->shift[i]));
    mesh_set_node(s->e.mesh, s->e.edge[i], p, drawn ? NAN : u);
    straightened += drawn;
  }
  free(bent);
  free(s->shift);
  free(s->share);
  return straightened;
}

// ---- nodes ---------------------------------------------------------------------------------------------------------------------
static size_t place_nodes(Splitter *s, const Model *model)
{
  Mesh *out = s->e.mesh;
  size_t straightened = s->how == SUBDIVIDE_BARYCENTRIC ? 0 : place_middles(s, model);
  for (size_t b = 0; b < s->m->nblock; b++) {
    const MeshBlock *from = &s->m->block[b];
    if (elem_dim(from->type) != 2 || !centres(from->type, &s->how)) continue;
    size_t c = (size_t)elem_corners(from->type);
    for (size_t k = 0; k < from->n; k++) {
      Vec3 sum = {0, 0, 0};
      for (size_t i = 0; i < c; i++) sum = vec3_add(sum, mesh_xyz(s->m, from->node[c * k + i]));
      mesh_set_node(out, s->e.cell[b][k], vec3_scale(1 / (double)c, sum), NAN);
    }
  }
  return straightened;
}

static uint32_t middle(const Splitter *s, uint32_t entity, uint32_t a, uint32_t b)
{
  return enriched_at(&s->e, &s->table, 1, entity, a, b, 0);
}

static uint32_t *add_block(Splitter *s, const MeshBlock *from, ElemType type, size_t parts)
{
  return enriched_block(&s->e, from->entity, type, parts * from->n);
}

static uint32_t *put3(uint32_t *to, uint32_t a, uint32_t b, uint32_t c)
{
  to[0] = a;
  to[1] = b;
  to[2] = c;
  return to + 3;
}

static uint32_t *put4(uint32_t *to, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
  to[0] = a;
  to[1] = b;
  to[2] = c;
  to[3] = d;
  return to + 4;
}

static void split_lines(Splitter *s, const MeshBlock *from)
{
  bool halve = s->how != SUBDIVIDE_BARYCENTRIC;
  uint32_t *to = add_block(s, from, ELEM_LINE2, halve ? 2 : 1);
  for (size_t k = 0; k < from->n; k++) {
    uint32_t a = from->node[2 * k], b = from->node[2 * k + 1];
    *to++ = s->e.node[a];
    if (halve) {
      *to++ = enriched_on_line(&s->e, &s->table, 1, from->entity, a, b, 0);
      to[0] = to[-1];
      to++;
    }
    *to++ = s->e.node[b];
  }
}

// One quadrangle, or two corners and the centre as a triangle, for each corner of each element.
static uint32_t *split_about_centres(const Splitter *s, const MeshBlock *from, const uint32_t *cell, uint32_t *to)
{
  size_t c = (size_t)elem_corners(from->type);
  for (size_t k = 0; k < from->n; k++)
    for (size_t i = 0; i < c; i++) {
      const uint32_t *v = from->node + c * k;
      uint32_t here = v[i], next = v[(i + 1) % c], before = v[(i + c - 1) % c];
      if (s->how == SUBDIVIDE_BARYCENTRIC)
        to = put3(to, s->e.node[here], s->e.node[next], cell[k]);
      else
        to = put4(to, s->e.node[here], middle(s, from->entity, here, next), cell[k], middle(s, from->entity, before, here));
    }
  return to;
}

static void halve_triangles(Splitter *s, const MeshBlock *from)
{
  const uint32_t f = from->entity;
  uint32_t *to = add_block(s, from, ELEM_TRI3, 4);
  for (size_t k = 0; k < from->n; k++) {
    const uint32_t *v = from->node + 3 * k, *id = s->e.node;
    uint32_t ab = middle(s, f, v[0], v[1]), bc = middle(s, f, v[1], v[2]), ca = middle(s, f, v[2], v[0]);
    to = put3(to, id[v[0]], ab, ca);
    to = put3(to, ab, id[v[1]], bc);
    to = put3(to, ca, bc, id[v[2]]);
    to = put3(to, ab, bc, ca);
  }
}

static void split_entity(Splitter *s, size_t first, size_t end)
{
  // The triangles and quadrangles of one face come in up to two blocks, and may end in one of a single type.
  ElemType one = s->how == SUBDIVIDE_QUADS ? ELEM_QUAD4 : ELEM_TRI3;
  const MeshBlock *b = &s->m->block[first];
  if (s->how == SUBDIVIDE_HALVE) {
    for (size_t i = first; i < end; i++, b++)
      if (b->type == ELEM_TRI3)
        halve_triangles(s, b);
      else
        split_about_centres(s, b, s->e.cell[i], add_block(s, b, ELEM_QUAD4, 4));
    return;
  }
  size_t n = 0;
  for (size_t i = first; i < end; i++) n += s->m->block[i].n * (size_t)elem_corners(s->m->block[i].type);
  uint32_t *to = enriched_block(&s->e, b->entity, one, n);
  for (size_t i = first; i < end; i++) to = split_about_centres(s, &s->m->block[i], s->e.cell[i], to);
}

Mesh *mesh_subdivide(const Mesh *m, Subdivision how, const Model *model, Diag *diag)
{
  Splitter s = {.m = m, .how = how};
  int per_edge = how != SUBDIVIDE_BARYCENTRIC;
  edge_table_make(&s.table, m);
  enrich(&s.e, m, &s.table, per_edge, centres, &how);
  size_t straightened = place_nodes(&s, model);
  if (straightened)
    diag_warning(diag, NO_LOC,
                 "%zu edges had to be halved nearer to straight lines than their curves, or elements beside them would be folded; a "
                 "finer mesh there avoids it",
                 straightened);
  for (size_t i = 0, j; i < m->nblock; i = j) {
    const MeshBlock *b = &m->block[i];
    for (j = i + 1; j < m->nblock && m->block[j].entity == b->entity;) j++;
    if (elem_dim(b->type) == 0) {
      uint32_t *to = add_block(&s, b, ELEM_POINT, 1);
      for (size_t k = 0; k < b->n; k++) to[k] = s.e.node[b->node[k]];
    } else if (elem_dim(b->type) == 1) {
      split_lines(&s, b);
    } else {
      split_entity(&s, i, j);
    }
  }
  enrich_periodic(&s.e, m, &s.table, per_edge);
  enriched_free(&s.e, m);
  edge_table_free(&s.table);
  return s.e.mesh;
}
