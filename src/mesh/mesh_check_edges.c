// mesh_check_edges.c - the audit: edges shared properly, line elements among them, holes and T-junctions
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/mesh_check_int.h"

// ---- line elements ----------------------------------------------------------------------------------------------------------
// Per entity: is it a curve that a face lists?
static bool *listed_curves(const Mesh *m)
{
  bool *listed = mem_zalloc(m->nentity + 1);
  for (size_t i = 0; i < m->nentity; i++) {
    const MeshEntity *f = &m->entity[i];
    for (size_t k = 0; f->dim == 2 && k < f->boundary.len + f->embedded.len; k++) {
      uint32_t e = mesh_find_entity(m, 1, abs(k < f->boundary.len ? f->boundary.data[k] : f->embedded.data[k - f->boundary.len]));
      if (e != NONE) listed[e] = true;
    }
  }
  return listed;
}

// Curves between the same points may have one line each between the same nodes, if one of them is known to be in no face: the faces
// are looked at with the other.
static bool may_share(const Check *c, const bool *listed, uint32_t a, uint32_t b)
{
  return c->strict && a != b && !(listed[a] && listed[b]);
}

// Gather the line elements; on_line marks their ends.
static void gather_lines(Check *c, uint8_t *on_line)
{
  const Mesh *m = c->m;
  bool *listed = listed_curves(m);
  for (uint32_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    if (elem_dim(k->type) != 1) continue;
    for (size_t i = 0; i < k->n; i++) {
      const uint32_t *v = k->node + i * (size_t)elem_nodes(k->type);
      bool added;
      uint32_t *slot = map_slot(&c->line, map_pair(v[0], v[1]), (uint32_t)c->line_block.len, &added);
      if (v[0] == v[1])
        check__report(c, RULE_DEGENERATE, false, (Place){k->entity, b, i, v[0], mesh_xyz(m, v[0])},
                      "both ends are node %llu", number_of(c, v[0]));
      else if (!added && may_share(c, listed, k->entity, check__line_curve(c, *slot))) {
        if (listed[k->entity]) *slot = (uint32_t)c->line_block.len;
      } else if (!added)
        check__report(c, RULE_DUPLICATE_ELEMENT, !c->strict && k->entity != check__line_curve(c, *slot),
                      (Place){k->entity, b, i, NONE, check__middle(m, v[0], v[1])},
                      "curve %d has a line between nodes %llu and %llu too",
                      m->entity[check__line_curve(c, *slot)].tag, number_of(c, v[0]), number_of(c, v[1]));
      vec_push(&c->line_block, b);
      vec_push(&c->line_index, (uint32_t)i);
      on_line[v[0]] = on_line[v[1]] = 1;
    }
  }
  free(listed);
}

// ---- half-edges ---------------------------------------------------------------------------------------------------------------
static void scan_block(Check *c, CheckedEdges *s, uint32_t b)
{
  const MeshBlock *k = &c->m->block[b];
  size_t corners = (size_t)elem_corners(k->type), nodes = (size_t)elem_nodes(k->type), h = c->edges.base[b];
  for (size_t i = 0; i < k->n; i++) {
    const uint32_t *v = k->node + i * nodes;
    for (size_t a = 0; a < corners; a++, h++) {
      uint32_t p = v[a], q = v[a + 1 == corners ? 0 : a + 1], twin = c->edges.twin[h];
      if (UNLIKELY(twin == NONE)) {
        vec_push(&s->boundary, map_pair(p, q));
        vec_push(&s->half, (uint32_t)h);
      }
      if (LIKELY(!(s->on_line[p] & s->on_line[q]))) continue;
      uint32_t line = map_get(&c->line, map_pair(p, q));
      if (line != NONE) vec_push(&s->use, (uint64_t)line << 32 | k->entity);
    }
  }
}

static uint64_t corner_key(const MeshBlock *k, size_t i)
{
  uint64_t sum = 0;
  int corners = elem_corners(k->type);
  const uint32_t *v = k->node + i * (size_t)elem_nodes(k->type);
  for (int a = 0; a < corners; a++) {
    uint64_t z = v[a] * 0x9e3779b97f4a7c15u;
    sum += (z ^ z >> 29) * 0xbf58476d1ce4e5b9u;
  }
  return sum >> 1;
}

static bool same_corners(const MeshBlock *k, size_t i, const MeshBlock *l, size_t j)
{
  int n = elem_corners(k->type), found = 0;
  const uint32_t *v = k->node + i * (size_t)elem_nodes(k->type), *w = l->node + j * (size_t)elem_nodes(l->type);
  if (n != elem_corners(l->type)) return false;
  for (int a = 0; a < n; a++)
    for (int b = 0; b < n; b++) found += v[a] == w[b];
  return found == n;
}

// An element of which every edge is bad may be there twice. Rare, so its cost does not matter.
static void check_bad_edges(Check *c)
{
  const Mesh *m = c->m;
  Map edge = {0}, element = {0};
  Vec(HalfEdge) seen = {0};
  bool added;
  for (uint32_t b = 0; b < m->nblock; b++) {
    const MeshBlock *k = &m->block[b];
    size_t corners = elem_dim(k->type) == 2 ? (size_t)elem_corners(k->type) : 0;
    for (size_t i = 0; corners && i < k->n; i++) {
      size_t bad = 0, h = c->edges.base[b] + i * corners;
      for (size_t a = 0; a < corners; a++) bad += c->edges.twin[h + a] == EDGE_BAD;
      if (LIKELY(!bad)) continue;
      if (bad == corners) {
        uint32_t *slot = map_slot(&element, corner_key(k, i), (uint32_t)seen.len, &added);
        const HalfEdge *other = added ? NULL : &seen.data[*slot];
        if (other && same_corners(k, i, &m->block[other->block], other->element))
          check__report(c, RULE_DUPLICATE_ELEMENT, false,
                        (Place){k->entity, b, i, NONE,
                                check__middle(m, k->node[i * (size_t)elem_nodes(k->type)],
                                       k->node[i * (size_t)elem_nodes(k->type) + 1])},
                        "element %zu has the same corners", c->number[other->block] + other->element + 1);
        if (added) vec_push(&seen, ((HalfEdge){.block = b, .element = i}));
      }
      for (size_t a = 0; a < corners; a++) {
        if (c->edges.twin[h + a] != EDGE_BAD) continue;
        HalfEdge e = mesh_edges_at(&c->edges, m, h + a);
        map_slot(&edge, map_pair(e.a, e.b), 0, &added);
        if (added)
          check__report(
              c, RULE_EDGE, false, (Place){k->entity, b, i, NONE, check__middle(m, e.a, e.b)},
              "edge of nodes %llu and %llu has more than two elements, or two that run it the same way",
              number_of(c, e.a), number_of(c, e.b));
      }
    }
  }
  map_free(&edge);
  map_free(&element);
  vec_free(&seen);
}

// ---- holes ------------------------------------------------------------------------------------------------------------------------
// Whether the boundary of each face is known and has lines.
static bool *closed_faces(const Check *c)
{
  const Mesh *m = c->m;
  bool *has_lines = mem_zalloc(m->nentity), *closed = mem_zalloc(m->nentity);
  for (size_t b = 0; b < m->nblock; b++)
    if (elem_dim(m->block[b].type) == 1 && m->block[b].n) has_lines[m->block[b].entity] = true;
  for (uint32_t f = 0; f < m->nentity; f++) {
    const MeshEntity *t = &m->entity[f];
    closed[f] = t->dim == 2 && (t->boundary.len > 0 || c->strict);
    for (size_t i = 0; closed[f] && i < t->boundary.len; i++) {
      uint32_t e = mesh_find_entity(m, 1, abs(t->boundary.data[i]));
      closed[f] = e != NONE && has_lines[e];
    }
  }
  free(has_lines);
  return closed;
}

static bool bounds(const MeshEntity *face, int curve)
{
  for (size_t i = 0; i < face->boundary.len; i++)
    if (abs(face->boundary.data[i]) == curve) return true;
  return face->boundary.len == 0;
}

static void check_holes(Check *c, const CheckedEdges *s)
{
  const Mesh *m = c->m;
  bool *closed = closed_faces(c);
  for (size_t i = 0; i < s->half.len; i++) {
    HalfEdge e = mesh_edges_at(&c->edges, m, s->half.data[i]);
    uint32_t face = m->block[e.block].entity, line = map_get(&c->line, s->boundary.data[i]);
    if (!closed[face]) continue;
    if (line == NONE)
      check__report(c, RULE_HOLE, false, (Place){face, e.block, e.element, NONE, check__middle(m, e.a, e.b)},
                    "nothing is beyond the edge of nodes %llu and %llu, which is on no curve",
                    number_of(c, e.a), number_of(c, e.b));
    else if (!bounds(&m->entity[face], m->entity[check__line_curve(c, line)].tag))
      check__report(c, RULE_HOLE, false, (Place){face, e.block, e.element, NONE, check__middle(m, e.a, e.b)},
                    "it ends at curve %d, which does not bound it", m->entity[check__line_curve(c, line)].tag);
  }
  free(closed);
}

// ---- T-junctions --------------------------------------------------------------------------------------------------------------------
// A grid over the nodes of edges that one element alone has, in the two longer directions of their box.
typedef struct {
  const Check *c;
  U32Vec node, next;   // nodes in it, and the next one of the same cell
  Map cell;
  double size, lo[3];
  int i, j;
} Grid;

static uint64_t cell_key(const Grid *g, Vec3 p, int di, int dj)
{
  const double x[3] = {p.x, p.y, p.z};
  // Cells are edges long and edges few enough, so that 31 bits do for each direction.
  double a = fmin(floor((x[g->i] - g->lo[g->i]) / g->size), 2e9), b = fmin(floor((x[g->j] - g->lo[g->j]) / g->size), 2e9);
  return (uint64_t)(uint32_t)((int64_t)a + di + 2) << 32 | (uint32_t)((int64_t)b + dj + 2);
}

static void grid_make(Grid *g, const Check *c, const U32Vec *half)
{
  const Mesh *m = c->m;
  Box3 box = box3_empty();
  double total = 0;
  g->c = c;
  for (size_t k = 0; k < half->len; k++) {
    HalfEdge e = mesh_edges_at(&c->edges, m, half->data[k]);
    Vec3 a = mesh_xyz(m, e.a), b = mesh_xyz(m, e.b);
    box = box3_with(box3_with(box, a), b);
    total += vec3_distance(a, b);
  }
  double d[3] = {box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z};
  int drop = d[2] <= d[0] && d[2] <= d[1] ? 2 : d[0] <= d[1] ? 0 : 1;
  g->i = drop == 0 ? 1 : 0;
  g->j = drop == 2 ? 1 : 2;
  memcpy(g->lo, &box.lo, sizeof g->lo);
  g->size = fmax(total / (double)half->len, 1e-9 * fmax(d[g->i], d[g->j]));
  if (!(g->size > 0)) g->size = 1;
  Map seen = {0};
  for (size_t k = 0; k < half->len; k++) {
    HalfEdge e = mesh_edges_at(&c->edges, m, half->data[k]);
    bool added;
    map_slot(&seen, e.a, 0, &added);
    for (int end = 0; end < 2; end++) {
      uint32_t v = end ? e.b : e.a;
      if (end) map_slot(&seen, v, 0, &added);
      if (!added) continue;
      uint32_t *slot = map_slot(&g->cell, cell_key(g, mesh_xyz(m, v), 0, 0), NONE, &added);
      vec_push(&g->node, v);
      vec_push(&g->next, *slot);
      *slot = (uint32_t)(g->node.len - 1);
    }
  }
  map_free(&seen);
}

// A node within the open segment pq, at most 1e-9 of its length beside it; NONE if there is none. Hanging nodes are seldom
// collinear to the last bit, since their coordinates were rounded: they are a few ulps off, a millionth of this tolerance.
static uint32_t node_within(const Grid *g, uint32_t p, uint32_t q)
{
  const Mesh *m = g->c->m;
  Vec3 a = mesh_xyz(m, p), d = vec3_sub(mesh_xyz(m, q), a);
  double len = vec3_length(d);
  size_t steps = (size_t)fmin(ceil(2 * len / g->size), 1e6);
  for (size_t s = 0; s <= steps; s++) {
    Vec3 x = vec3_add(a, vec3_scale((double)s / (double)MAX(steps, (size_t)1), d));
    for (int n = 0; n < 9; n++)
      for (uint32_t k = map_get(&g->cell, cell_key(g, x, n % 3 - 1, n / 3 - 1)); k != NONE; k = g->next.data[k]) {
        uint32_t v = g->node.data[k];
        Vec3 r = vec3_sub(mesh_xyz(m, v), a);
        double t = vec3_dot(r, d) / (len * len);
        if (v == p || v == q || !(t > 1e-9 && t < 1 - 1e-9)) continue;
        if (vec3_length(vec3_sub(r, vec3_scale(t, d))) <= 1e-9 * len) return v;
      }
  }
  return NONE;
}

typedef struct {
  HalfEdge edge;
  uint32_t node;
  bool line;   // the edge is on a curve
  bool inside; // the node is one of the face's own
} Junction;
typedef Vec(Junction) JunctionVec;

typedef struct {
  const Mesh *m;
  JunctionVec *found;
} Junctions;

static bool is_on_curve(const Mesh *m, uint32_t node, const MeshEntity *curve)
{
  const MeshEntity *at = &m->entity[m->node_entity[node]];
  bool ends = false;
  for (size_t i = 0; at->dim == 0 && i < curve->boundary.len; i++) ends |= abs(curve->boundary.data[i]) == at->tag;
  return at == curve || ends;
}

// Does the edge lie on a curve: is there a line, or, since files may leave out lines, are both its nodes on one that bounds its face?
static bool is_on_curve_of_face(const Check *c, const HalfEdge *e)
{
  const Mesh *m = c->m;
  const MeshEntity *face = &m->entity[m->block[e->block].entity];
  bool found = map_get(&c->line, map_pair(e->a, e->b)) != NONE;
  for (size_t i = 0; !found && i < face->boundary.len; i++) {
    uint32_t k = mesh_find_entity(m, 1, abs(face->boundary.data[i]));
    found = k != NONE && is_on_curve(m, e->a, &m->entity[k]) && is_on_curve(m, e->b, &m->entity[k]);
  }
  return found;
}

// Which nodes are in the face of the edge they lie in.
static void find_own_nodes(void *ctx, uint32_t face, const uint32_t *stamp)
{
  const Junctions *to = ctx;
  for (size_t i = 0; i < to->found->len; i++) {
    Junction *j = &to->found->data[i];
    if (to->m->block[j->edge.block].entity == face && stamp[j->node] == face) j->inside = true;
  }
}

// A node within an edge is an error where the mesh contradicts itself: the node is of the same face, or the edge is on no curve. An edge
// on a curve is complete by that curve's mesh; then the node is of something that lies there without being joined.
static void report_junctions(Check *c, JunctionVec *found)
{
  if (found->len) check__stamp_faces(c, find_own_nodes, &(Junctions){c->m, found});
  for (size_t i = 0; i < found->len; i++) {
    const Junction *j = &found->data[i];
    bool apart = j->line && !j->inside;
    check__report(c, RULE_T_JUNCTION, apart,
                  (Place){c->m->block[j->edge.block].entity, j->edge.block, j->edge.element, j->node,
                          mesh_xyz(c->m, j->node)},
                  "node %llu%s lies within the edge of nodes %llu and %llu", number_of(c, j->node),
                  apart ? ", not joined to it," : "", number_of(c, j->edge.a), number_of(c, j->edge.b));
  }
}

static void check_junctions(Check *c, CheckedEdges *s)
{
  const Mesh *m = c->m;
  // Edges that two faces share are no boundary of their union.
  U64Vec sorted = {0};
  U32Vec alone = {0};
  vec_reserve(&sorted, s->boundary.len);
  for (size_t i = 0; i < s->boundary.len; i++) vec_push(&sorted, s->boundary.data[i]);
  check__sort(&sorted);
  for (size_t i = 0; i < s->half.len; i++)
    if (check__count(&sorted, s->boundary.data[i]) == 1) vec_push(&alone, s->half.data[i]);
  vec_free(&sorted);
  JunctionVec found = {0};
  if (alone.len) {
    Grid g = {0};
    grid_make(&g, c, &alone);
    for (size_t i = 0; i < alone.len; i++) {
      HalfEdge e = mesh_edges_at(&c->edges, m, alone.data[i]);
      uint32_t v = node_within(&g, e.a, e.b);
      if (v != NONE) vec_push(&found, ((Junction){.edge = e, .node = v, .line = is_on_curve_of_face(c, &e)}));
    }
    vec_free(&g.node);
    vec_free(&g.next);
    map_free(&g.cell);
  }
  report_junctions(c, &found);
  vec_free(&found);
  vec_free(&alone);
}

void check__conformity(Check *c)
{
  const Mesh *m = c->m;
  CheckedEdges s = {.on_line = mem_zalloc(m->nnode)};
  gather_lines(c, s.on_line);
  for (uint32_t b = 0; b < m->nblock; b++)
    if (elem_dim(m->block[b].type) == 2) scan_block(c, &s, b);
  check_bad_edges(c);
  check__lost(c, &s);
  check_holes(c, &s);
  if (!c->r->count[RULE_COORDINATE]) check_junctions(c, &s);
  free(s.on_line);
  vec_free(&s.use);
  vec_free(&s.boundary);
  vec_free(&s.half);
  vec_free(&c->line_block);
  vec_free(&c->line_index);
  map_free(&c->line);
}
